/* lom/water.h - water: the parameters of its models, as the scene file's [water] table gives them. */
#ifndef LOM_WATER_H
#define LOM_WATER_H

#include <lom/image.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- what the richer models add: [water.waves], [water.optics], [water.foam] ---- */

typedef enum lom_waves_kind {
    LOM_WAVES_NONE,
    LOM_WAVES_GERSTNER,
    LOM_WAVES_SEA,
    LOM_WAVES_FLOW /* a river: ripples of the normal map, carried by a flow that the terrain and the level make */
} lom_waves_kind;

/* The waves on the surface. Gerstner: `count` trochoids of geometrically spaced lengths about one direction. Sea: the
 * cascades of lom/sea.h. An angle is measured from +x towards +z and says where the waves travel to. */
typedef struct lom_water_waves {
    uint32_t given;
    int kind;         /* lom_waves_kind */
    double direction; /* radians */
    int seed;
    double height;          /* Gerstner: four standard deviations of the surface, metres */
    double length[2];       /* Gerstner: the longest and the shortest wave, metres */
    int count;              /* Gerstner: 1..LOM_MAX_WAVES */
    double steepness;       /* Gerstner: 0 sines .. 1 the sum of all waves touches a cusp somewhere, never a loop */
    double spread;          /* Gerstner: standard deviation of the waves' directions, radians */
    int spectrum;           /* sea: lom_spectrum_kind */
    const char *wind_level; /* sea: a name of the Beaufort scale, or NULL: wind_speed */
    double wind_speed;      /* sea: m/s at 10 m */
    double fetch, depth;    /* sea: metres; depth 0 is deep water */
    double height_scale;    /* sea: factor on the heights */
    double choppiness;      /* sea: factor on the horizontal displacement */
    int cascades, size;     /* sea: how many, and samples a side of each */
    double speed;           /* flow: its mean, m/s */
    double cell;            /* displaced: pixels between the vertices of the mesh */
    double patch;           /* sea: metres of the largest cascade; 0: six peak wavelengths */
} lom_water_waves;

typedef enum lom_fresnel { LOM_FRESNEL_EXACT, LOM_FRESNEL_SCHLICK, LOM_FRESNEL_DOT } lom_fresnel;

/* Names of water after N. G. Jerlov, Marine Optics (1976), table XXVII; pure water after Pope and Fry (1997). */
typedef enum lom_water_type {
    LOM_WATER_PURE,
    LOM_WATER_I, /* the clearest oceans */
    LOM_WATER_IA,
    LOM_WATER_IB,
    LOM_WATER_II,
    LOM_WATER_III,
    LOM_WATER_1C, /* coasts, from clear to turbid */
    LOM_WATER_3C,
    LOM_WATER_5C,
    LOM_WATER_7C,
    LOM_WATER_TYPE_COUNT
} lom_water_type;

typedef struct lom_water_optics {
    uint32_t given;
    double index;         /* of refraction, water against air */
    int fresnel;          /* lom_fresnel */
    int type;             /* lom_water_type */
    double absorption[3]; /* 1/m of red, green, blue; the reader has put the type's here when the file gives none */
    double scatter[3]; /* radiance of bottomless water, in parts of a white surface's under the same light; likewise */
    double roughness;  /* mean square slope of the ripples that the waves do not contain */
    double glitter;    /* factor on the sun's reflection */
    double reach;      /* parts of the picture that a bent lookup may be away from its pixel, 0..1 */
    int steps;         /* of a march against the scene's depth */
    double caustics;   /* 0: none .. 1: the light on the bed as the waves focus it */
    double caustics_size; /* metres a side of the square in front of the eye in which they are computed */
    int caustics_texels;  /* a side of it */
    double opacity;       /* of the tinted quad */
} lom_water_optics;

typedef struct lom_water_foam {
    uint32_t given;
    double amount;      /* 0: no foam .. 1 */
    double threshold;   /* Jacobian below which waves break */
    double window;      /* seconds that foam lasts: it is the decaying sum of what broke in them */
    double shore_depth; /* metres of water that the shore's foam reaches to; 0: none */
    double tile;        /* metres of one repetition of its pattern */
} lom_water_foam;

/* ---- [shallow]: the surface as a height field that flows over the terrain (lom/shallow.h) ---- */

typedef struct lom_shallow_spring {
    uint32_t given;
    double position[2], radius; /* x and z, metres */
    double rate;                /* m^3/s */
} lom_shallow_spring;

typedef struct lom_shallow_body {
    uint32_t given;
    const char *entity; /* that it goes with, or NULL */
    double position[2], half[2], heading, draft;
    double time, duration, every; /* of dipping in, seconds; duration 0: it is always in the water */
    size_t followed;              /* number of the entity, plus one; 0: none */
} lom_shallow_body;

typedef struct lom_shallow_water {
    uint32_t given;
    double position[2], size[2]; /* of the region; the reader has put the water's here when the file gives none */
    int cells;                   /* along the longer side */
    double start;                /* seconds: when it stands still at the level */
    double step, friction, implicitness;
    int edge; /* lom_shallow_edge */
    lom_shallow_spring *springs;
    size_t spring_count;
    lom_shallow_body *bodies;
    size_t body_count;
} lom_shallow_water;

/* Waves that come in to a shore: one period, whose crests turn and rise over the bed and break. */
typedef struct lom_water_surf {
    uint32_t given;
    double height;    /* metres where they reach the terrain; 0: there are none */
    double period;    /* seconds */
    double direction; /* radians, as of lom_water_waves */
    double variation; /* of the heights, in groups of crests and along them: 0 none .. 0.9 */
} lom_water_surf;

/* The planar lake. Its nine steps can be switched one by one (spec: reflection, refraction, projection, flow, normals,
 * fresnel, specular, tint, soft shore); docs/scene.md says what each switch does. Filled by lom_read_scene, which
 * keeps every range stated there. Strings belong to the scene. */
typedef struct lom_water_params {
    uint32_t given;     /* nonzero when the scene has a [water] table */
    bool enabled;       /* false: no water is drawn although there is a table */
    double level;       /* y of the surface, metres */
    double position[2]; /* x, z of the middle of the quad, metres */
    double size[2];     /* extent along x and z, metres, above 0 (the reader has put the terrain's size here when the
                           file gives none) */

    bool reflection; /* 1: the mirrored scene is rendered and looked up; else color is what is reflected */
    bool refraction; /* 2: the scene below is rendered and looked up; else color is what is seen below */
    bool projection; /* 3: lookups at the fragment's own place on the screen; else at the quad's own coordinates */
    bool flow;       /* 4: the flow map displaces the lookups and moves the normals */
    bool normals;    /* 5: the normal map perturbs the normal; else it is (0, 1, 0) */
    bool fresnel;    /* 6: reflection and refraction mixed by the angle of view; else half and half */
    bool specular;   /* 7: the highlight of the light is added */
    bool tint;       /* 8: tint_color is mixed in */
    bool soft_shore; /* 9: alpha falls to 0 where the water is shallow */

    const char *normal_map;   /* path; NULL: flat water */
    const char *flow_map;     /* path; NULL: made from the normal map, smoothstep(0.2, 0.8, 1 - n) a channel */
    double tile;              /* metres that one repetition of the two maps covers */
    double flow_strength;     /* largest displacement of a lookup, in parts of the picture */
    double flow_speed;        /* repetitions of the maps per second */
    double normal_up;         /* the factor on the up component: 3 is the published one; larger is calmer */
    double reflectivity;      /* 0..1, the share of the reflection at grazing angles */
    double fresnel_power;     /* exponent on dot(to_camera, normal) */
    double shininess;         /* Phong exponent */
    double specular_strength; /* factor on the highlight */
    double color[3];          /* linear; stands in for a picture that is switched off */
    double tint_color[3];     /* linear */
    double tint_amount;       /* 0..1 */
    double shore_depth;       /* metres of water at which it is fully there */
    double clip_offset; /* metres by which the two clip planes reach over the surface, against gaps at the shore */

    lom_water_waves waves;
    lom_water_optics optics;
    lom_water_foam foam;
} lom_water_params;

enum { LOM_MAX_WAVES = 64 };

/* ---- trochoids: the waves of kind "gerstner", for programs ---- */

/* One wave. With t = number (direction . (x, z)) + 2 pi phase - rate time, the water at rest at (x, z) stands
 * amplitude cos t above the level and -across sin t along the direction from its place: a circle when both are equal
 * (Gerstner 1809), an ellipse when across is less (Fournier and Reeves 1986). */
typedef struct lom_trochoid {
    double direction[2]; /* unit vector, x and z */
    double number;       /* rad/m */
    double rate;         /* rad/s: sqrt(9.80665 number), that of deep water */
    double phase;        /* turns, 0 <= phase < 1 */
    double amplitude;    /* metres */
    double across;       /* metres, 0 <= across <= amplitude */
} lom_trochoid;

/* The sum of across times number over all waves is where crests stand: below 1 they are round, at 1 they touch a cusp
 * where all of them meet, above 1 they would loop. */
typedef struct lom_trochoid_report {
    double asked;     /* the sum that height and steepness ask for */
    double steepness; /* the sum that the waves have: at most 1 */
    int limited;      /* waves whose horizontal motion is less than what was asked for */
} lom_trochoid_report;

/* The trochoids that `waves` describes (height 0..100, lengths 1e-3..1e5 with the longest first, count
 * 1..LOM_MAX_WAVES, steepness 0..1, finite angles), into out[0 .. count - 1]; report may be NULL. Returns how many:
 * waves->count, or 0 where the height is 0; -1, with a sentence and nothing written, when a number is out of its range
 * or is none. */
int lom_make_trochoids(const lom_water_waves *waves, lom_trochoid out[LOM_MAX_WAVES], lom_trochoid_report *report,
                       lom_error *error);

typedef struct lom_trochoid_point {
    double place[3];  /* metres, y from the level */
    double normal[3]; /* unit vector, y above or at 0 */
    double jacobian;  /* of the horizontal motion: the area of a piece of water in parts of its area at rest, never
                         below 0 for the waves of lom_make_trochoids */
} lom_trochoid_point;

/* Where the water is that rests at (x, z), in double, for |x|, |z| <= 1e7 and |time| <= 1e9. A wave's phase is rounded
 * by less than 1e-15 (number (|x| + |z|) + rate |time|) radians: 1e-8 m of a wave of 10 m, 1 m high, at 10^7 m. */
lom_trochoid_point lom_trochoids_at(const lom_trochoid *trochoids, int count, double x, double z, double time);

/* Attenuation (1/m) and the radiance of bottomless water (parts of white) at 650, 550 and 475 nm, for red, green and
 * blue. Attenuation is Jerlov's of downward irradiance (table XXVII), which for pure water is its absorption. The
 * radiance is 0.33 b / a (Gordon, Brown, Jacobs 1975): b, the light scattered back, is half of Morel's (1974) molecular
 * 0.00288 (wavelength / 500 nm)^-4.32 plus our estimate of the particles' for the type. */
void lom_water_type_optics(lom_water_type type, double absorption[3], double scatter[3]);

/* ---- made: the maps of the planar lake ---- */

typedef struct lom_normal_map_desc {
    int size; /* pixels a side, 128..4096, a multiple of 4; 0: 512 */
    uint64_t seed;
    double roughness; /* root of the mean squared slope; 0: 0.42 */
} lom_normal_map_desc;
/* Waves with a wind, which repeat without a seam, RGB8: red and green are the normal's components along x (right) and z
 * (down the picture) * 0.5 + 0.5, blue the one that points up. */
lom_image *lom_make_normal_map(const lom_normal_map_desc *desc, lom_error *error);
/* The flow map that belongs to a normal map: smoothstep(0.2, 0.8, 1 - n) for each channel, RGB8. */
lom_image *lom_make_flow_map(const lom_image *normal_map, lom_error *error);

#ifdef __cplusplus
}
#endif

#endif
