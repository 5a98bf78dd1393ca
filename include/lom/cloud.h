/* lom/cloud.h - clouds: volumes of density that are made by kind and seed, and how a scene's clouds are lit and drawn.
 *
 * A cloud's volume is an image with depth: x to the right, y up (row 0 is the lowest), z towards the viewer; a voxel is
 * the density at its centre, 0 to 1. docs/clouds.md derives every model; formulas are named by the paper they come
 * from.
 */
#ifndef LOM_CLOUD_H
#define LOM_CLOUD_H

#include <lom/geometry.h>
#include <lom/transfer.h>

LOM_API_BEGIN

/* ---- made: volumes of density ---- */

/* What a kind is when nothing else is said. */
typedef struct lom_cloud_kind {
    const char *name;         /* "cumulus_congestus" */
    const char *abbreviation; /* "Cu con", "" when it has none */
    const char *text;         /* a sentence */
    double low, high;         /* range of the base, metres above sea level; both 0: it has none */
    double size[3];           /* metres along x, y, z */
    int voxels[3];
    double extinction; /* 1/m where the density is 1 */
} lom_cloud_kind;

/* The kinds, from 0; NULL behind the last. */
const lom_cloud_kind *lom_cloud_kind_at(size_t index);
/* By name or abbreviation, case as written; NULL (and an error that suggests the nearest name) when there is none. */
const lom_cloud_kind *lom_find_cloud_kind(const char *name, lom_error *error);
/* Height of the base of a cloud of which nothing is told, metres: halfway up the kind's range; 0 if it has none. */
double lom_base_of_kind(const lom_cloud_kind *kind);

typedef struct lom_cloud_desc {
    const char *kind;
    int width, height, depth; /* voxels, 1..LOM_MAX_VOLUME; 0: the kind's */
    uint64_t seed;
} lom_cloud_desc;
/* A volume of density, R16, the same bytes everywhere. NULL on failure; freed with lom_free_image. */
lom_image *lom_make_cloud(const lom_cloud_desc *desc, lom_error *error);

/* The reference work's lighting in advance (docs/clouds.md, Light): gray in RGB, the density as alpha, RGBA8. From each
 * voxel that holds something steps of 1 / longest side are taken towards the light (in the box's axes, any length)
 * until the volume is left or the sum of the densities met, of 0..255, times `lighter`, is above 250; then the count of
 * steps is multiplied by dark_light. The mean is the sum over the count: gray is 255 where it is below 100 or no voxel
 * was met, else 255 - mean (at least 0). NULL on failure. */
lom_image *lom_light_cloud_in_advance(const lom_image *density, const double to_light[3], double lighter,
                                      double dark_light, lom_error *error);
/* A flat cloud, RGBA8 of size x size (8..1024): a round shape times noise of four octaves (32, 64, 128 and 256 cells at
 * a size of 256 and more), eaten into by detail, with gray that darkens towards the base. NULL on failure. */
lom_image *lom_make_cloud_picture(int size, uint64_t seed, lom_error *error);
/* A round puff, white, RGBA8 of size x size (8..1024): its opacity is (1 - r^2)^2, r the distance from the middle in
 * parts of half a side, times noise of the same octaves about 1. NULL on failure. */
lom_image *lom_make_cloud_puff(int size, uint64_t seed, lom_error *error);
/* The noise of the model "layers": R8, 1 + 3 times the sum of Perlin noise at 4, 8, 16 and 32 cells a side, each of half
 * the weight, in parts of 2.5 and cut to 0..1; it tiles without a seam. size as above; NULL on failure. */
lom_image *lom_make_cloud_noise(int size, uint64_t seed, lom_error *error);

/* ---- [[cloud]] ---- */

typedef struct lom_cloud_transfer { /* [[cloud.transfer_function]]: values do not fall */
    bool present;
    double value, extinction, color[3]; /* as in lom_transfer_point */
} lom_cloud_transfer;

typedef struct lom_cloud {
    bool present;
    const char *name; /* NULL when it has none; unique in the scene */
    const char *kind; /* one that lom_find_cloud_kind knows; NULL when file is set */
    const char *file; /* a volume of density of the user's, or NULL */
    double voxels[3]; /* of the made volume, or of a raw file; 0: the kind's */
    int seed;
    lom_vec3 position;  /* metres: the middle of the base of its box */
    double middle[2];   /* its x and z, if the file names them; the reader has put them there */
    double size[3];     /* metres along x, y, z; the reader has put the kind's where the file names none */
    double yaw;         /* radians about y, counter-clockwise seen from above */
    double density;     /* factor on the volume's density */
    double extinction;  /* 1/m where the volume's density is 1; the kind's where the file names none */
    double detail;      /* 0..1: how far tiling noise eats into thin parts */
    double detail_size; /* metres of one repetition of that noise */
    bool visible;
    lom_cloud_transfer *transfer;
    size_t transfer_count; /* at most LOM_MAX_TRANSFER; 0: extinction is the density, white */
    lom_volume_look look;  /* of it */
} lom_cloud;

/* ---- [clouds]: the light and the air that all clouds share ---- */

typedef enum lom_cloud_phase {
    LOM_PHASE_DUAL = 0, /* blend of two Henyey-Greenstein lobes */
    LOM_PHASE_HENYEY_GREENSTEIN,
    LOM_PHASE_RAYLEIGH,
    LOM_PHASE_ISOTROPIC
} lom_cloud_phase;

typedef enum lom_cloud_original_light {
    LOM_ORIGINAL_COMBINED = 0, /* in advance and in real time */
    LOM_ORIGINAL_ADVANCE,
    LOM_ORIGINAL_REAL_TIME,
    LOM_ORIGINAL_NONE
} lom_cloud_original_light;

typedef struct lom_cloud_wind { /* [[clouds.wind]]: heights rise strictly */
    bool present;
    double height;    /* metres */
    double speed;     /* m/s */
    double direction; /* radians, where it blows to: 0 is +x, a quarter turn +z */
    double gust;      /* m/s, amplitude of a sine that is added to the speed */
    double gust_period;
} lom_cloud_wind;

typedef struct lom_cloud_mix { /* [[clouds.mix]]: what a sky of many is made of */
    bool present;
    const char *kind; /* one that lom_find_cloud_kind knows */
    double share;     /* of the clouds, in parts of the sum of all shares */
} lom_cloud_mix;

enum {
    LOM_MAX_SKY = 4096, /* clouds that [clouds] makes */
    LOM_MAX_MIX = 16,
    LOM_MAX_SKY_SHAPES = 16,
    LOM_MAX_METAR_LAYERS = 8
};

/* A group of clouds of an aerodrome's report. */
typedef struct lom_metar_layer {
    double oktas;     /* eighths of the sky: FEW 1.5, SCT 3.5, BKN 6, OVC and VV 8 */
    double base;      /* metres above the aerodrome; negative: not measured */
    const char *kind; /* cumulonimbus, cumulus_congestus (TCU), or by height and amount */
} lom_metar_layer;

/* The clouds of METAR text (WMO-No. 306, FM 15): groups such as "FEW030 BKN120CB", heights in hundreds of feet; NSC,
 * NCD, SKC, CLR and CAVOK tell that there are none. Text that begins with METAR or SPECI may be a whole report: its other
 * groups are passed over, and what follows RMK, NOSIG, BECMG or TEMPO. Returns the number of layers, in the order of the
 * text; -1 with a sentence when a group is no such thing or there are too many. */
int lom_parse_metar(const char *text, lom_metar_layer layer[LOM_MAX_METAR_LAYERS], lom_error *error);

typedef struct lom_clouds {
    bool present;
    lom_cloud_phase phase;
    double forward, backward, blend;     /* mean cosines of the lobes (-1..1) and the share of the backward one */
    double silver, silver_spread;        /* strength of the silver lining and 1 - mean cosine of its lobe */
    double albedo;                       /* share of light that an encounter scatters, 0..1 */
    double brightness;                   /* factor on the sun's light in clouds */
    double sky[3], ground[3];            /* linear radiance from above and from below */
    double haze_color[3], haze_distance; /* metres after which a share of 1/e of a cloud is left; 0: clear air */
    bool shadows;                        /* clouds shadow one another, the ground and the water */
    double shadow_strength;              /* 0..1, of those on the ground and the water */
    lom_cloud_original_light original_light;
    double lighter, dark_light; /* the original's constants of lighting in advance */
    lom_cloud_wind *winds;      /* by height; between two their ways are mixed */
    size_t wind_count;          /* 0: calm */
    double evolve; /* seconds in which the small shapes of clouds become others; 0: they stay as they are */
    double swell;  /* 0..1, how much clouds grow and shrink meanwhile, in twice that time */
    /* a sky of many; the reader has added them to the scene's clouds */
    int count;          /* 0..LOM_MAX_SKY; 0: as many as `oktas` or `metar` need */
    double oktas;       /* 0..8, eighths of the area that are covered, seen from above */
    const char *metar;  /* a report that lom_parse_metar reads, or NULL */
    int seed, shapes;   /* shapes: of each kind, 1..LOM_MAX_SKY_SHAPES; clouds of one shape share their volume */
    double area[2];     /* metres along x and z in which the middles of clouds are */
    double middle[2];   /* its x and z, if the file names them; the reader has put them there */
    double sizes[2];    /* least and largest, in parts of the kind's */
    double voxels;      /* along each axis, in parts of the kind's, above 0 to 1 */
    double base;        /* metres; negative: each kind's, drawn from its range */
    lom_cloud_mix *mix; /* mix_count 0: cumulus of fair weather */
    size_t mix_count;
} lom_clouds;

/* ---- quality.clouds ---- */

typedef enum lom_cloud_model {
    LOM_CLOUDS_OCTAVES = 0, /* marched; octaves of multiple scattering */
    LOM_CLOUDS_FORWARD,     /* marched; Harris's multiple forward scattering */
    LOM_CLOUDS_SINGLE,      /* marched; light that was scattered once */
    LOM_CLOUDS_ORIGINAL,    /* the reference work's fixed steps and light */
    LOM_CLOUDS_BILLBOARD,   /* a flat picture */
    LOM_CLOUDS_OFF,
    LOM_CLOUDS_REFERENCE, /* random paths in double precision, as part of the reference's picture */
    LOM_CLOUDS_SPRITES,   /* many soft billboards, each turned at random */
    LOM_CLOUDS_GROUPS,    /* a group of billboards with pictures of whole clouds */
    LOM_CLOUDS_LAYERS     /* a level sheet a cloud: four pictures over one another */
} lom_cloud_model;

/* ---- quality.impostors and [quality.impostor] ---- */

typedef enum lom_impostor_rule {
    LOM_IMPOSTORS_OFF = 0,   /* every cloud is marched in every frame */
    LOM_IMPOSTORS_REFERENCE, /* the reference work's refresh rule and sizes of plates */
    LOM_IMPOSTORS_BOUNDED    /* a plate is made anew when its error in pixels passes a bound */
} lom_impostor_rule;

typedef struct lom_impostor_dials {
    bool present;
    double bound;                    /* pixels; of the bounded rule */
    double scale;                    /* texels a pixel of the frame, of the bounded rule, above 0 to 4 */
    double inside_scale;             /* the same of the plate of a cloud around the eye, above 0 to 1 */
    double sun;                      /* radians the sun may move before a plate is made anew */
    int largest;                     /* texels along a plate's edge */
    int largest_reference, smallest; /* the reference rule's: a plate of `smallest` or less is not drawn */
    bool two_pass;                   /* plates coarser than the frame are magnified in two passes */
    bool misting;                    /* clouds near the eye fade to 0.8 of their opacity */
    bool culling;                    /* clouds outside the view cost nothing; off changes no byte */
    bool lod;                        /* off: every plate has the largest size */
} lom_impostor_dials;

LOM_API_END

#endif
