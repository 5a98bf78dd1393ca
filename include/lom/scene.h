/* lom/scene.h - a scene: what a scene file (TOML 1.0, docs/scene.md) says, checked and ready to be rendered.
 *
 * Files have degrees, the structs radians; lengths are metres. Every number is finite and inside the range that
 * docs/scene.md names. Every string belongs to the scene and lives until lom_free_scene; a path is resolved against the
 * scene file's folder and named a file that was there when the scene was read. Optional strings are NULL when absent.
 * Each table's struct starts with `given`: 0 when the file has no such table. */
#ifndef LOM_SCENE_H
#define LOM_SCENE_H

#include <lom/cloud.h>
#include <lom/fixed.h>
#include <lom/fluid.h>
#include <lom/geometry.h>
#include <lom/particles.h>
#include <lom/sky.h>
#include <lom/water.h>

LOM_API_BEGIN

/* ---- [output] ---- */

typedef enum lom_transfer { LOM_TRANSFER_SRGB, LOM_TRANSFER_NAIVE } lom_transfer;
typedef enum lom_output_format { LOM_OUTPUT_RGB8, LOM_OUTPUT_RGB16, LOM_OUTPUT_RGB32F } lom_output_format;

/* From linear light to the light of the picture: cut off at 1 (not in RGB32F), or a curve that bends towards 1. */
typedef enum lom_curve { LOM_CURVE_CLAMP, LOM_CURVE_REINHARD, LOM_CURVE_FILMIC, LOM_CURVE_ACES } lom_curve;

/* Edges as one sample a pixel draws them, or mixed with what lies beyond them (lom_smooth_edges). */
typedef enum lom_output_edges { LOM_EDGES_SHARP, LOM_EDGES_SMOOTH } lom_output_edges;

typedef struct lom_output {
    bool present;
    int width, height;        /* pixels, 1..LOM_MAX_SIZE */
    lom_transfer transfer;    /* naive: textures are not decoded and the output is not encoded */
    lom_output_format format; /* the samples; the kind of file comes from its extension */
    int frames;               /* how many frames the animation has, from 1 */
    double fps;               /* frame n shows the time n / fps, in seconds */
    int samples;              /* a pixel: 1, 2, 4, 8, 16 (lom/pipeline.h); 0: 1 */
    bool sample_shading;      /* each of them is shaded */
    lom_output_edges edges;   /* with one sample */
    double exposure;          /* stops, -10..10: light is multiplied by 2 to this power, before the curve */
    lom_curve curve;
    double white; /* what LOM_CURVE_REINHARD and LOM_CURVE_FILMIC show as 1, from 1, exposure applied */
} lom_output;

/* ---- [camera] ---- */

typedef enum lom_projection {
    LOM_PROJECTION_PERSPECTIVE,
    LOM_PROJECTION_ORTHOGRAPHIC, /* parallel rays straight ahead */
    LOM_PROJECTION_OBLIQUE /* parallel rays at a slant: what faces the camera keeps its shape, what recedes is drawn
                                    along an angle */
} lom_projection;

typedef struct lom_camera_key { /* [[camera.key]]; times rise strictly from key to key */
    bool present;
    double time; /* seconds */
    lom_vec3 position, target;
    double field_of_view; /* radians, vertical */
    double height;        /* metres of a parallel projection */
} lom_camera_key;

typedef enum lom_person {
    LOM_PERSON_THIRD, /* behind the entity, turned by its heading alone */
    LOM_PERSON_FIRST  /* in it: turned as it is, and it is not drawn */
} lom_person;

typedef enum lom_interpolation { LOM_INTERPOLATION_LINEAR, LOM_INTERPOLATION_SMOOTH } lom_interpolation;

typedef struct lom_camera {
    bool present;
    lom_vec3 position, target, up; /* up has unit length */
    double yaw, pitch, roll;       /* radians, as in the file; the reader has worked them into target and up */
    double field_of_view;          /* radians, vertical, 0.01 to 179 degrees */
    double near_plane;             /* metres, above 0 */
    lom_projection projection;
    double height;                   /* of parallel projections: metres that the picture is high */
    double far_plane;                /* of parallel projections: metres, beyond near_plane */
    double foreshortening;           /* oblique: length of receding lines in parts of their own, 0..4 */
    double receding_angle;           /* oblique, radians: their way in the picture, 0 right, pi / 2 up */
    lom_interpolation interpolation; /* between the keys */
    lom_camera_key *keys;
    size_t key_count;   /* 0: a camera that stands still */
    const char *follow; /* name of an entity, or NULL: position, target, up and keys are then in its coordinates, whose
                           -z is ahead */
    size_t followed;    /* 1 + its index; 0: none */
    lom_person person;
} lom_camera;

/* ---- [[view]] ---- */

enum { LOM_MAX_VIEWS = 8 };
#define LOM_MAIN_VIEW "main" /* the name of the picture that [camera] takes */

typedef struct lom_picture_view { /* another look at the same scene, in a rectangle of the picture */
    bool present;
    const char *name;    /* unique, not LOM_MAIN_VIEW */
    double rectangle[4]; /* x, y, width, height in parts of the picture's, from its top left corner; within it */
    bool mirrored;       /* left and right are exchanged */
    bool visible;
    lom_camera camera; /* never a first person */
} lom_picture_view;

/* The camera at one moment, and what its pictures are made by. The zero of what is behind near_plane is a
 * perspective. */
typedef struct lom_camera_view {
    lom_vec3 position, target, up;
    double field_of_view, near_plane;
    lom_projection projection;
    double height, far_plane; /* metres; of parallel projections alone */
    double shear[2];          /* oblique: metres right and up a metre of depth (lom_oblique) */
} lom_camera_view;

/* From the view to clip space, for a picture that is `aspect` times as wide as high: lom_perspective, lom_orthographic
 * or lom_oblique. */
lom_mat4 lom_camera_projection(const lom_camera_view *camera, double aspect);
/* Where its rays start (parallel: those of the picture's middle): the position, from which an oblique camera's eye is
 * moved across the view axis so far that the target stays in the middle. */
lom_vec3 lom_camera_eye(const lom_camera_view *camera);
/* From the world to the view: lom_look_at from that eye. */
lom_mat4 lom_camera_look(const lom_camera_view *camera);
/* Metres along the view axis of what has this (reversed) depth, above 0; near_plane at 1. */
double lom_camera_distance(const lom_camera_view *camera, double depth);

/* ---- [light] ---- */

typedef struct lom_light_key { /* [[light.key]]; times rise strictly from key to key */
    bool present;
    double time;               /* seconds */
    double azimuth, elevation; /* radians */
    double color[3], intensity;
} lom_light_key;

typedef struct lom_light {
    bool present;
    lom_vec3 direction;        /* unit vector, the way the light travels: from the sun towards the scene */
    double azimuth, elevation; /* radians, of the sun as in the file; already worked into direction */
    double color[3];           /* linear; multiplied by intensity it is the light's diffuse and specular colour */
    double intensity;
    double ambient[3]; /* linear, ambient light on what faces up, not multiplied by intensity */
    double ground[3];  /* linear, ambient light on what faces down; between them by the cosine to up */
    lom_light_key *keys;
    size_t key_count; /* 0: a sun that stands still */
} lom_light;

/* ---- [[lamp]] ---- */

typedef struct lom_lamp_key { /* [[lamp.key]]; times rise strictly from key to key */
    bool present;
    double time; /* seconds */
    lom_vec3 position, direction;
    double intensity;
} lom_lamp_key;

typedef enum lom_lamp_kind {
    LOM_LAMP_POINT,   /* light to all sides of its position */
    LOM_LAMP_SPOT,    /* within a cone about its direction */
    LOM_LAMP_INFINITE /* from everywhere against its direction, with the same strength at every place */
} lom_lamp_kind;

/* A light beside the sun. At d metres its colours are multiplied by 1 / (attenuation[0] + attenuation[1] d +
 * attenuation[2] d^2), within the cone of a spot by max(-L.D, 0)^exponent too. */
typedef struct lom_lamp {
    bool present;
    const char *name;   /* NULL when it has none; unique in the scene */
    lom_lamp_kind kind; /* follows from which of position, direction and cutoff the file gives */
    lom_vec3 position;  /* metres; in the followed entity's coordinates when it follows one */
    lom_vec3 direction; /* unit vector, the way the light travels */
    double ambient[3], diffuse[3], specular[3]; /* linear, each multiplied by intensity */
    double intensity;
    double attenuation[3]; /* constant, linear 1/m, quadratic 1/m^2; not all 0. The file's range is worked into it */
    double range;          /* metres, as in the file; 0: none */
    double reach;          /* metres from which there is no light; 0: where no colour is above 1/1000 */
    double cutoff;         /* radians from the middle of the cone to its edge: to pi / 2, or pi: light to all sides */
    double softness;       /* radians inside the edge over which light begins; at most cutoff */
    double exponent;
    bool on;
    bool shadow;        /* opaque entities and terrain keep its light off what is behind them */
    double shadow_from; /* metres from it, along the axis of a map's face, nearer than which nothing does */
    lom_interpolation interpolation; /* between the keys */
    lom_lamp_key *keys;
    size_t key_count;   /* 0: it does not change */
    const char *follow; /* name of an entity, or NULL */
    size_t followed;    /* 1 + its index; 0: none */
} lom_lamp;

/* ---- [haze] ---- */

/* Air that scatters: of a colour at the end of a path, exp(-optical depth) is left, and the air's colour fills the
 * rest. Extinction is density up to the height base, and density exp(-(y - base) / height) above. */
typedef struct lom_haze {
    bool present;         /* else the air is clear */
    double density[3];    /* 1 / m at base, red, green and blue */
    double color[3];      /* linear */
    double base, height;  /* metres; height 0: the same at every height */
    double glow[3];       /* linear, added to the colour towards the sun */
    double glow_exponent; /* on the cosine between the path and the sun */
} lom_haze;

/* ---- materials ---- */

typedef struct lom_scene_material {
    bool present;
    bool has_ambient, has_diffuse, has_specular, has_shininess; /* false: an entity's mesh keeps its own */
    bool has_emissive, has_bump, has_opacity;
    double ambient[3], diffuse[3], specular[3]; /* linear factors */
    double emissive[3];                         /* linear: light of its own */
    double shininess;                           /* Phong exponent */
    double bump;                                /* as of lom_material */
    const char *texture; /* colour texture that multiplies ambient and diffuse; NULL: the mesh's own */
    const char *emissive_map, *specular_map, *gloss_map, *normal_map; /* likewise, of emissive, specular, shininess */
    double opacity;          /* of an entity: the share of what is behind it that it hides; below 1 it is transparent */
    const char *opacity_map; /* multiplies opacity; NULL: the mesh's own */
} lom_scene_material;

/* ---- [terrain] ---- */

typedef enum lom_mapping { LOM_MAPPING_PLANAR, LOM_MAPPING_TRIPLANAR } lom_mapping;

typedef struct lom_terrain_layer { /* [[terrain.layer]]: painted over the layers before it where its ranges hold */
    bool present;
    const char *map;
    double tile;                   /* metres of one repetition; 0: once over the whole terrain */
    double from_height, to_height; /* metres above y = 0; -+1e9 when the file names no bound */
    double from_slope, to_slope;   /* radians from flat (0) to upright (pi/2) */
    double blend;                  /* metres of height over which the layer fades in and out at its height bounds */
    double slope_blend;            /* radians, the same at its slope bounds */
    double grain;                  /* how far the brightness of what lies under it moves its bounds; 0: not at all */
    lom_mapping mapping;           /* from above, or from three sides */
} lom_terrain_layer;

typedef struct lom_terrain {
    bool present;
    const char *height_map;
    double size[2];         /* width along x and length along z, metres; the terrain is centred on x = z = 0 */
    double position[2];     /* x and z of that middle in the file's coordinates: taken off all places of the scene */
    double height;          /* metres from black to white */
    double base;            /* y of black, metres */
    const char *texture;    /* colour texture, or NULL */
    double tile;            /* metres of one repetition; 0: once over the whole terrain */
    const char *detail_map; /* brightness detail: the colour is multiplied by 2 * detail; or NULL */
    double detail_tile;     /* metres of one repetition */
    const char *normal_map; /* perturbs the terrain's normal, tiled like the detail map; or NULL */
    lom_scene_material material;
    lom_terrain_layer *layers;
    size_t layer_count;
} lom_terrain;

/* ---- [[entity]] ---- */

typedef struct lom_entity_key { /* [[entity.key]]; times rise strictly from key to key */
    bool present;
    double time; /* seconds */
    lom_vec3 position, rotation;
} lom_entity_key;

typedef struct lom_entity {
    bool present;
    const char *name;  /* NULL when it has none; unique in the scene */
    const char *mesh;  /* OBJ file */
    lom_vec3 position; /* metres; y is above the terrain when on_ground is set */
    lom_vec3 rotation; /* radians: model = T Rz Ry Rx S */
    lom_vec3 scale;    /* no component is 0 */
    lom_scene_material material;
    lom_scene_material back; /* of back sides, over what the front sides have */
    bool two_sided;          /* back sides are seen, too; true where the file has a table of them and says no other */
    bool on_ground, visible;
    int line_width;                  /* of the mesh's lines, pixels of the picture, 1..64 */
    double point_size;               /* of its points, pixels of the picture; from 2 on they are discs */
    bool alpha_to_coverage;          /* of the texture's alpha (lom/pipeline.h) */
    lom_interpolation interpolation; /* between the keys */
    lom_entity_key *keys;
    size_t key_count; /* 0: it stands still */
} lom_entity;

/* Where an entity is at one moment. */
typedef struct lom_entity_place {
    lom_vec3 position, rotation;
} lom_entity_place;

/* ---- [quality]: the dials ---- */

typedef enum lom_shading { LOM_SHADING_PHONG, LOM_SHADING_GOURAUD, LOM_SHADING_FLAT } lom_shading;
/* What a surface makes of a light: Lambert's cosine with Phong's or Blinn's highlight, or tones by thresholds. */
typedef enum lom_reflection { LOM_REFLECTION_PHONG, LOM_REFLECTION_BLINN_PHONG, LOM_REFLECTION_TOON } lom_reflection;
typedef enum lom_texture_filter {
    LOM_TEXTURE_TRILINEAR,
    LOM_TEXTURE_BILINEAR, /* linear within the nearest level */
    LOM_TEXTURE_NEAREST
} lom_texture_filter;

/* Edges of triangles as lines over the picture: none; those that no surface hides; all. */
typedef enum lom_wireframe { LOM_WIREFRAME_OFF, LOM_WIREFRAME_VISIBLE, LOM_WIREFRAME_ALL } lom_wireframe;

typedef struct lom_reference_quality { /* [quality.reference] */
    bool present;
    int samples; /* of a pixel */
    int depth;   /* crossings of water that a path may have */
    double sun;  /* radians: the radius of the sun's disc as water shows it */
} lom_reference_quality;

typedef struct lom_quality {
    bool present;
    lom_water_model water;
    lom_cloud_model clouds;
    double cloud_error;       /* of an optical depth, in parts of the greatest one of that length: bounds the step */
    double cloud_stop;        /* a ray stops when less than this share of the light behind comes through */
    int cloud_octaves;        /* of multiple scattering, 1..8 */
    bool cloud_jitter;        /* samples are shifted along the ray by a table of blue noise */
    double cloud_light_scale; /* voxels of the light's grid a voxel of the density, along each axis */
    bool spray;               /* the drops of [[spray]] are drawn */
    bool fluid;               /* the liquids of [[fluid]] are */
    lom_impostor_rule impostors;
    lom_impostor_dials impostor;
    lom_shading shading;
    lom_reflection reflection;
    double toon_thresholds[3], toon_tones[3]; /* cosines that rise, and what is reflected from each on */
    lom_texture_filter texture_filter;
    int anisotropy;          /* probes a sample of ground and entities, at most; 1 to 16 */
    lom_filtering filtering; /* of 8-bit textures, targets too */
    lom_filtering march;     /* of the volumes and media of clouds */
    bool mipmaps;            /* false: the finest level alone */
    double reflection_scale; /* size of the reflection picture in parts of the output's, each axis, above 0 to 1 */
    double refraction_scale; /* the same of the refraction picture */
    int refraction_samples;  /* of its pixels, at most output.samples: 1, 2, 4, 8, 16; 0: 1 */
    lom_reference_quality reference;
    bool lamp_tiles;          /* lamps are looked at only near where they reach; changes no byte */
    bool scissor;             /* pictures are drawn only where lookups can reach; changes no byte */
    double terrain_error;     /* pixels that terrain may be off where it is drawn coarser; 0: full density */
    double terrain_composite; /* pixels that a texel of the picture of all layers may cover; 0: layers are sampled */
    bool tessellation;      /* terrain is cut by tessellation, each edge by its own error, instead of block by block */
    bool terrain_shadows;   /* terrain keeps the sun off what lies behind it */
    int entity_shadows;     /* texels a side of the maps of what entities keep the sun off; 0: they do not */
    int lamp_shadows;       /* texels a side of the maps of lamps with a shadow; 0: they throw none */
    int lamp_shadow_maps;   /* of a frame, at most; lamps that come later throw no shadow */
    int shadow_cascades;    /* maps of the view that entities keep the sun off; 1: two, sorted by what casts */
    double shadow_split;    /* of the cascades: 0: of equal depths, 1: of equal ratios */
    double normals;         /* metres of the lines that show the normals of entities' vertices; 0: none */
    bool ambient_occlusion; /* terrain gets ambient light only from the sky it sees */
    lom_wireframe wireframe;
    double wireframe_color[3]; /* linear */
} lom_quality;

/* ---- the scene ---- */

/* Places are metres from the middle of the terrain: the reader has taken terrain.position off every x and z, so that a
 * scene is drawn as exactly far from the origin as at it. */
typedef struct lom_scene {
    bool present;
    const char *title; /* or NULL */
    lom_output output;
    lom_camera camera;
    lom_light light;
    lom_lamp *lamps; /* [[lamp]] */
    size_t lamp_count;
    lom_haze haze;       /* clear air when given is 0 */
    lom_terrain terrain; /* there is none when given is 0 */
    lom_sky_params sky;
    lom_water_params water;         /* [water], or the first [[water]]; drawn when given is not 0 and enabled is set */
    lom_water_params *other_waters; /* of [[water]] those behind the first */
    size_t other_water_count;       /* at most LOM_MAX_OTHER_WATERS */
    lom_water_surf surf;            /* of the first water: when its height is not 0 waves come in to the terrain */
    lom_shallow_water shallow;      /* of the first water: when given is not 0 it flows */
    lom_water_wake *wakes;          /* [[wake]], on the first water */
    size_t wake_count;              /* at most LOM_MAX_WAKES */
    lom_clouds clouds;
    lom_quality quality;
    lom_entity *entities;
    size_t entity_count;
    lom_cloud *cloud; /* [[cloud]] */
    size_t cloud_count;
    lom_spray *sprays; /* [[spray]] */
    size_t spray_count;
    lom_fluid_params *fluids;        /* [[fluid]] */
    size_t fluid_count;              /* at most LOM_MAX_FLUIDS */
    lom_picture_view *views;         /* [[view]] */
    size_t view_count;               /* at most LOM_MAX_VIEWS */
    const char *path;                /* of the scene file, as it was named */
    struct lom_scene_memory *memory; /* what the strings and arrays live in */
} lom_scene;

/* Reads and checks a scene file ("-" is standard input; its files are then relative to the working folder). An
 * override is "KEY=VALUE", applied in order after the file: KEY is a dotted path like "water.level",
 * "entity.0.position" or "entity.boat.visible" (arrays of tables by index or by name), VALUE is a TOML value; what
 * is none is taken as a string. Or it is "@FILE": a scene file of settings (relative to the working folder; "@-" is
 * standard input), whose tables are laid over the scene's: what it says replaces what the scene says, an array of
 * tables all of it, and files that it names are relative to the scene's folder. NULL on failure; the error names
 * file, line and column, or the override. Freed with lom_free_scene. */
lom_scene *lom_read_scene(const char *path, const char *const *overrides, size_t override_count, lom_error *error);
/* The same from memory; path serves the messages and its folder the relative file names. */
lom_scene *lom_decode_scene(const char *text, size_t size, const char *path, const char *const *overrides,
                            size_t override_count, lom_error *error);
void lom_free_scene(lom_scene *scene);

/* A place of the scene in the coordinates of its file: terrain.position is added. */
lom_vec3 lom_place_in_file(const lom_scene *scene, lom_vec3 place);

/* Every file the scene names, the scene file first, each once: what --watch looks at. The list belongs to the scene. */
const char *const *lom_scene_files(const lom_scene *scene, size_t *count);

/* The camera at a time in seconds, from the time alone. Before the first key it is the first, after the last the last.
 * Smooth is the cubic Hermite curve whose slope at a key is that of the parabola through it and its two neighbours
 * (Catmull-Rom when the times are equally far apart); it reproduces any motion that is quadratic in time. */
lom_camera_view lom_scene_camera_at(const lom_scene *scene, double time);
/* The same of one of its views. */
lom_camera_view lom_scene_view_camera_at(const lom_scene *scene, const lom_picture_view *view, double time);
/* The light at a time: azimuth, elevation, colour and intensity go straight from key to key. */
lom_light lom_scene_light_at(const lom_scene *scene, double time);
/* A lamp at a time, with what its keys say of position, direction and intensity; what it follows is left out. Smooth as
 * of the camera; a direction between keys is turned to unit length, and is the lamp's own where they cancel. */
lom_lamp lom_scene_lamp_at(const lom_lamp *lamp, double time);
/* An entity at a time; smooth as of the camera. */
lom_entity_place lom_scene_entity_at(const lom_entity *entity, double time);
/* The way sunlight travels from where the sun stands. */
lom_vec3 lom_sunlight_direction(double azimuth, double elevation);

/* docs/scene.md, made from the tables of keys; data is NULL on failure. */
lom_bytes lom_write_scene_documentation(lom_error *error);

LOM_API_END

#endif
