/* What a renderer holds: the scene's files as meshes and textures, and the targets of its passes. */
#ifndef LOM_RENDER_RENDERER_H
#define LOM_RENDER_RENDERER_H

#include "cloud/impostor.h"
#include "render/ground.h"
#include "render/surface.h"
#include "scene/scene_water.h"
#include "spray/spray.h"
#include "water/surface.h"
#include "water/water_models.h"
#include "waves/wave_field.h"

#include <lom/reference.h>
#include <lom/sea.h>
#include <lom/render.h>

struct lom_cached_texture {
    const char *path; /* the scene's string, or one of the mesh's materials' */
    bool color;
    lom_texture *texture;
};

struct lom_loaded_part { /* the triangles of one material */
    uint32_t first, count;
    struct lom_material_uniform material;
};

struct lom_loaded_entity {
    const lom_entity *entity;
    lom_mesh *mesh; /* NULL where another entity owns it, or nothing is drawn */
    const lom_mesh *drawn;
    struct lom_loaded_part *parts;
    lom_mat4 world_from_model, normal_from_model;
    lom_box bounds;   /* in the world */
    lom_vec3 home;    /* where it was put, before it moves, */
    double home_size; /* and the longest side of its bounds there */
    bool is_hidden;   /* the camera is in it */
    int shadow_map;   /* that it is drawn into in this frame; -1: none */
};

/* What clouds let through of the sun, over a plane: the shadows that fall on the ground and the water. */
struct lom_ground_shadow {
    lom_texture *texture;
    bool falls;        /* on something, in this frame */
    double s[4], t[4]; /* texture coordinates of a place (x, y, z, 1) */
    uint64_t made_for;
};

/* A map of what entities keep the sun off. */
struct lom_entity_shadow {
    lom_texture *map;
    bool falls; /* on something, in this frame */
    lom_mat4 clip_from_world;
    double texel; /* metres */
    uint64_t made_for;
};

/* A cloud's picture between frames: in one part, or in a far and a near one (the aircraft is between them). */
struct lom_impostor {
    struct lom_plate plate;
    bool is_made, is_small, is_around; /* small: not drawn; around: the cloud is about the eye */
    int parts;
    double cut;                             /* of two parts: metres along the plate's axis from its eye */
    double sun[3], phase;                   /* of the light and of the shapes when it was made */
    lom_texture *marched[2], *magnified[2]; /* magnified: NULL when the marched picture is shown as it is */
};

/* The light a cloud's plates were last made for. */
struct lom_cloud_sun {
    double to_light[3], color[3];
    double allowance; /* radians the sun may move from there */
};

/* The impostors of the frame's eye and of its mirror image in the water, one a cloud; a function of the frames drawn
 * since the run began. */
struct lom_impostors {
    struct lom_impostor *of_eye[2]; /* NULL until needed */
    struct lom_cloud_sun *suns;
    int swept;                /* grids of light, in this frame */
    bool continues;           /* this frame follows the one before in a run */
    int frame, width, height; /* of the last frame */
};

/* What drops need in a frame: room for all of them, and a picture of them. */
struct lom_spray_memory {
    size_t capacity; /* drops of visible emitters; 0: none */
    lom_particle *particles;
    struct lom_sprite *sprites;
    float *depth;
    uint32_t *order, *indices;
    lom_texture *layer; /* a target */
};

struct lom_renderer {
    lom_scene moment;       /* the scene at the time of the frame: its light moves */
    const lom_scene *scene; /* moment, for those who read it */
    lom_device *device;
    lom_warnings warnings;    /* of the meshes and their textures */
    lom_reference *reference; /* instead of all that follows, where the water's model is the reference */

    struct lom_cached_texture *textures;
    size_t texture_count, texture_capacity;
    char **paths; /* made for materials' maps */
    size_t path_count, path_capacity;

    lom_texture *sky, *sun, *normal_map, *flow_map;
    struct lom_ground ground;                       /* blocks are NULL when the scene has no terrain */
    float brightness_below[LOM_MAX_TERRAIN_LAYERS]; /* mean of the picture below a layer with grain, above 0 */
    struct lom_loaded_entity *entities;
    size_t entity_count;
    struct lom_cloud_set *clouds; /* NULL: none */
    struct lom_ground_shadow ground_shadow;
    struct lom_entity_shadow entity_shadows[LOM_ENTITY_SHADOWS];
    struct lom_impostors impostors;
    struct lom_spray_memory spray;

    lom_texture *foam; /* its pattern, or NULL */
    lom_texture *bed;  /* heights of the terrain, a texel a vertex, for caustics; or NULL */
    lom_texture *photons, *caustics;
    struct lom_wave_site wave_site;
    struct lom_wave_field *waves; /* of water with waves; or NULL */
    struct lom_polar_mesh polar;  /* of displaced water */

    /* targets, remade when the size changes */
    int width, height, target_width, target_height;
    lom_texture *color, *depth, *mask, *reflection, *reflection_depth, *refraction, *refraction_depth;
};

/* The texture of a picture, loaded once; color: it holds colours (sRGB-encoded unless the scene's transfer is naive).
 */
lom_texture *lom_load_texture(lom_renderer *renderer, const char *path, bool color, lom_error *error);
/* The same once it is loaded; NULL for a NULL path. */
lom_texture *lom_find_texture(const lom_renderer *renderer, const char *path, bool color);
/* Terrain, entities with their materials, the water's maps. */
bool lom_load_terrain(lom_renderer *renderer, lom_error *error);
bool lom_load_entities(lom_renderer *renderer, lom_error *error);
/* Puts the light and the entities that move where they are at a time. */
void lom_move_scene(lom_renderer *renderer, double time);
bool lom_load_water(lom_renderer *renderer, lom_error *error);
/* The terrain's heights as a texture, where caustics need them. */
bool lom_load_bed(lom_renderer *renderer, lom_error *error);
/* What water with waves needs. */
bool lom_load_waves(lom_renderer *renderer, lom_error *error);
/* frame_spray.c: room for the drops of the scene. */
bool lom_load_spray(lom_renderer *renderer, lom_error *error);
void lom_free_spray(lom_renderer *renderer);
/* load_clouds.c */
bool lom_load_scene_clouds(lom_renderer *renderer, lom_error *error);
void lom_free_scene_clouds(lom_renderer *renderer);
void lom_free_impostors(lom_renderer *renderer); /* their textures are the device's */

/* The light that the water's waves focus on what is below its level, over a square of x and z. */
struct lom_caustics {
    const lom_texture *map; /* NULL: none */
    double corner[2], size, level;
    double strength, fade; /* metres below the level over which they appear */
    double lod_scale;      /* texels of the map a pixel covers, per metre of distance */
};

/* How a pass looks at the scene. */
struct lom_scene_view {
    lom_mat4 projection, view;
    lom_vec3 eye;
    double plane[4]; /* only what has plane . (p, 1) >= 0; (0, 0, 0, 1): everything */
    bool mirrored;   /* front faces are clockwise */
    bool sky;
    struct lom_caustics caustics;
};

/* What a pass can show of a box. */
struct lom_culler {
    lom_frustum frustum;
    const double *plane; /* of the view */
    lom_vec3 eye;
};
bool lom_is_visible(const struct lom_culler *culler, const lom_box *box);
void lom_draw_ground(lom_renderer *renderer, const struct lom_culler *culler, const struct lom_view_uniform *view,
                     lom_vec3 eye, bool mirrored);
/* Draws terrain, entities and sky into the pass that has begun; what is outside the view or behind the plane costs
 * nothing. */
void lom_draw_scene(lom_renderer *renderer, const struct lom_scene_view *view);
/* Draws the depth of an entity, both sides of its faces, into the pass that has begun. */
void lom_draw_caster(lom_renderer *renderer, const struct lom_loaded_entity *entity, const lom_mat4 *clip_from_world);
/* Whether any of it but the sky would be drawn. */
bool lom_shows_scene(const lom_renderer *renderer, const struct lom_scene_view *view);
struct lom_light_uniform lom_scene_light(const lom_scene *scene);
/* The same for places less the eye, with the shadows of clouds and terrain that the frame has made. */
struct lom_light_uniform lom_renderer_light(const lom_renderer *renderer, lom_vec3 eye);
/* From places less the eye to clip space: the view's rotation alone, since it takes the eye to 0. */
lom_mat4 lom_clip_from_offset(const lom_mat4 *projection, const lom_mat4 *view);
/* The haze for places less an eye at this height; mirrored: the eye below the water's plane from which its reflection
 * is drawn. */
struct lom_haze_uniform lom_scene_haze(const lom_scene *scene, double eye_height, bool mirrored);
/* The bytes of those targets that every frame has, and of the picture: no more than they will take. */
uint64_t lom_target_bytes(const lom_scene *scene, int width, int height, int target_width, int target_height);
/* Makes the targets for a frame of this size of which target_width x target_height is drawn. */
bool lom_make_targets(lom_renderer *renderer, int width, int height, int target_width, int target_height,
                      lom_error *error);
/* A drawn picture, which is freed, in the scene's output format; NULL stays NULL. */
lom_image *lom_output_image(const lom_scene *scene, lom_image *drawn, lom_error *error);

#endif
