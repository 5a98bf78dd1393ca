/* lom/water.h - water: the parameters of its models, as the scene file's [water] table gives them. */
#ifndef LOM_WATER_H
#define LOM_WATER_H

#include <lom/image.h>
#include <lom/waves.h>

LOM_API_BEGIN

/* ---- what the richer models add: [water.optics]; [water.waves] and [water.foam] are in lom/waves.h ---- */

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
    bool present;
    double index; /* of refraction, water against air */
    lom_fresnel fresnel;
    lom_water_type type;
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

/* How water is drawn: quality.water. */
typedef enum lom_water_model {                       /* from cheap to exact, but for the default, which comes first */
                               LOM_WATER_DISPLACED,  /* waves as a mesh, light bent by Snell's law */
                               LOM_WATER_TINTED,     /* a quad of one colour */
                               LOM_WATER_PLANAR,     /* a quad with pictures of the scene above and below */
                               LOM_WATER_NORMAL_MAP, /* waves as normals on two triangles */
                               LOM_WATER_MARCHED,    /* waves met by a ray for each pixel */
                               LOM_WATER_REFERENCE   /* rays in double precision through the whole frame */
} lom_water_model;

enum { LOM_MAX_OTHER_WATERS = 7 }; /* of a scene, beside the first */

/* The planar lake. Its nine steps can be switched one by one (the switches 1 to 9 below); docs/scene.md says what each switch does. Filled by lom_read_scene, which
 * keeps every range stated there. Strings belong to the scene. */
typedef struct lom_water_params {
    bool present;       /* the scene has a [water] table */
    const char *name;   /* or NULL; unique in the scene */
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

/* Attenuation (1/m) and the radiance of bottomless water (parts of white) at 650, 550 and 475 nm, for red, green and
 * blue. Attenuation is Jerlov's of downward irradiance (table XXVII), which for pure water is its absorption. The
 * radiance is 0.33 b / a (Gordon, Brown, Jacobs 1975): b, the light scattered back, is half of Morel's (1974) molecular
 * 0.00288 (wavelength / 500 nm)^-4.32 plus our estimate of the particles' for the type. */
void lom_water_type_optics(lom_water_type type, double absorption[3], double scatter[3]);

/* ---- made: the maps of the planar lake ---- */

typedef struct lom_normal_map_desc {
    int size; /* pixels a side, 128..4096, a multiple of 4; 0: 512 */
    uint64_t seed;
    double roughness; /* root of the mean squared slope, 0..1000; 0: 0.42 */
} lom_normal_map_desc;
/* Waves with a wind, which repeat without a seam, RGB8: red and green are the normal's components along x (right) and z
 * (down the picture) * 0.5 + 0.5, blue the one that points up. */
lom_image *lom_make_normal_map(const lom_normal_map_desc *desc, lom_error *error);
/* The flow map that belongs to a normal map: smoothstep(0.2, 0.8, 1 - n) for each channel, RGB8. */
lom_image *lom_make_flow_map(const lom_image *normal_map, lom_error *error);

LOM_API_END

#endif
