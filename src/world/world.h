/* A scene as renderers need it, without a device: its files read once, its entities placed, their materials resolved;
 * and what moves, at a moment.
 *
 * In: a scene, which outlives its world. Invariant: what is here is decided here alone, so every renderer shows the
 * same things at the same places with the same materials. */
#ifndef LOM_WORLD_WORLD_H
#define LOM_WORLD_WORLD_H

#include "scene/scene_water.h"
#include "world/files.h"

#include <lom/scene.h>

/* A material in which nothing is left open. */
struct lom_world_material {
    double ambient[3], diffuse[3], specular[3], shininess, emissive[3];
    const char *texture; /* path of the picture that multiplies ambient and diffuse; NULL: white */
    const char *emissive_map, *specular_map, *gloss_map; /* the same of emissive, specular and shininess */
    const char *normal_map;                              /* NULL: normals are the mesh's */
    double opacity;
    const char *opacity_map;  /* path of the picture that multiplies it; NULL: 1 */
    bool opacity_is_in_alpha; /* of that picture, not in its red */
};

struct lom_world_part {    /* the triangles of one material */
    uint32_t first, count; /* indices */
    struct lom_world_material material;
    struct lom_world_material back; /* of a two-sided entity */
};

/* Whether something may be seen through a part of an entity. */
static inline bool lom_is_transparent(const struct lom_world_part *part, const lom_entity *entity)
{
    return part->material.opacity < 1 || part->material.opacity_map != NULL ||
           (entity->two_sided && (part->back.opacity < 1 || part->back.opacity_map != NULL));
}

/* A visible entity. */
struct lom_world_entity {
    const lom_entity *entity;
    const lom_mesh *mesh;         /* shared by all that name the same file */
    struct lom_world_part *parts; /* one a part of the mesh */
    lom_vec3 home;                /* where it was put, on the ground if it stands on it, before it moves, */
    double home_size;             /* and the longest side of its bounds there, metres */
    bool is_hidden;               /* the camera is in it */
};

struct lom_world_mesh {
    const char *path; /* the scene's */
    lom_mesh *mesh;   /* NULL: another world's now */
};

struct lom_world_picture {
    char *path;
    lom_image *image; /* RGBA8, or RGBA16 where the file has more than 8 bits; NULL: released */
    size_t heights;   /* not 0: it is made of the heights in the file that so much of the path names, */
    float bump;       /* with this bump */
};

struct lom_world {
    const lom_scene *scene;
    lom_warnings warnings; /* of the meshes and their maps */
    lom_image *height_map; /* as in the file; NULL: there is no terrain, or it was released */
    float *heights;        /* of the bed */
    struct lom_bed bed;    /* heights NULL: there is no terrain */
    struct lom_world_mesh *meshes;
    size_t mesh_count, mesh_capacity;
    struct lom_world_entity *entities; /* in the scene's order */
    size_t entity_count;
    struct lom_world_picture *pictures;
    size_t picture_count, picture_capacity;
    const struct lom_world *before; /* while it is made: what it takes over; else NULL */
    struct lom_files *files;        /* read ahead, for it and what is loaded of it to take; or NULL */
};

/* Reads the height map, the meshes and the maps that the meshes' materials name, where `files` (or NULL) does not have
 * them; it is the world's until world->files is set to NULL. A map of a mesh that cannot be read is left out with a
 * warning. NULL on failure; freed with lom_free_world. */
struct lom_world *lom_create_world(const lom_scene *scene, struct lom_files *files, lom_error *error);
void lom_free_world(struct lom_world *world); /* NULL is allowed */

/* The same of a scene of which there was another world before: meshes with the paths of that one's, and with
 * shares_ground the heights, are shared with it instead of read. Until lom_part_worlds neither may be freed. */
struct lom_world *lom_create_world_after(const lom_scene *scene, const struct lom_world *before, bool shares_ground,
                                         struct lom_files *files, lom_error *error);
/* What both have is from now on the first one's, and the other can only be freed. NULL is allowed. */
void lom_part_worlds(const struct lom_world *owner, struct lom_world *other);
/* The world of another scene, which has the same terrain and the same entities but for their names and their key
 * frames: nothing of the scene before is looked at any more. */
void lom_follow_scene(struct lom_world *world, const lom_scene *scene);
/* The terrain's height map, read again when it was released; NULL without one, and on failure. */
const lom_image *lom_world_height_map(struct lom_world *world, lom_error *error);

/* The site of the waves of a water of the scene (lom_water_of); it points into the world. */
struct lom_wave_site lom_world_wave_site(const struct lom_world *world, size_t number);

/* ---- pictures (pictures.c) ---- */

/* The picture of a file, decoded once: it stays the world's until it is released. NULL on failure. */
const lom_image *lom_world_picture(struct lom_world *world, const char *path, lom_error *error);
/* The flow map that is made from a water's normal map, for water that flows and names none. The normal map is then
 * decoded too. NULL on failure. */
const lom_image *lom_world_made_flow(struct lom_world *world, const char *normal_map, lom_error *error);
/* Frees what a caller has made its own; asked for again, it is decoded again. NULL and paths never asked for are
 * allowed. */
void lom_release_world_picture(struct lom_world *world, const char *path);
/* Frees all pictures and the height map. */
void lom_release_world_files(struct lom_world *world);
/* The six faces of a sky box (+x, -x, +y, -y, +z, -z) as the slices of an RGBA8 image, which is the caller's. Faces are
 * squares of one size; taken from `files` (or NULL) where it has them. NULL on failure. */
lom_image *lom_read_sky_faces(const lom_sky_params *sky, struct lom_files *files, lom_error *error);

/* ---- a moment (moment.c) ---- */

/* Where an entity is. */
struct lom_placement {
    lom_mat4 world_from_model, normal_from_model;
    lom_box bounds; /* in the world */
};

/* A lamp that shines. */
struct lom_placed_lamp {
    const lom_lamp *lamp;                       /* the scene's */
    lom_vec3 position;                          /* in the world */
    lom_vec3 direction;                         /* unit: the way its light travels */
    double ambient[3], diffuse[3], specular[3]; /* times its intensity */
    double reach;                               /* metres; no less than 1e300: it has no end */
};

struct lom_moment {
    double time;
    lom_scene scene;   /* the world's, its light that of the time; the entities' tables are as in the file */
    lom_vec3 to_light; /* unit: from the scene to the sun */
    lom_camera_view camera;
    struct lom_placement *placements; /* one an entity of the world */
    struct lom_placed_lamp *lamps;    /* those that shine, in the scene's order */
    size_t lamp_count, lamp_capacity;
};

/* The world at a time in seconds, from the time alone. The moment is zero at first, or one of the same world before:
 * then nothing is allocated but for lamps that are more than before. False on failure: an entity whose matrix is singular, or memory. Freed with
 * lom_free_moment, also after a failure. */
bool lom_world_at(const struct lom_world *world, double time, struct lom_moment *moment, lom_error *error);
void lom_free_moment(struct lom_moment *moment);
/* Whether the light, a lamp or a visible entity has key frames: what does not move is the same at all times. */
bool lom_world_moves(const struct lom_world *world);
/* Its lamps (lamps.c), once its entities are placed. False without memory. */
bool lom_place_lamps(const struct lom_world *world, struct lom_moment *moment, lom_error *error);
/* The pictures that tell what a lamp with a shadow sees: along which unit axes, and the tangent of half their field of view
 * (the same both ways). One along the middle of a cone of up to 60 degrees; six along the world's axes (+x, -x, +y, -y,
 * +z, -z) for wider ones and points. */
enum { LOM_LAMP_FACES = 6 };
struct lom_lamp_faces {
    int count;
    double tangent;
    lom_vec3 axis[LOM_LAMP_FACES];
};
struct lom_lamp_faces lom_find_lamp_faces(const struct lom_placed_lamp *lamp);
/* The metres that a lamp with a shadow leaves open before it, on the way that goes from it along a unit vector: what is
 * nearer than lom_lamp.shadow_from along the axis of the face which sees it. */
double lom_lamp_clearance(const struct lom_placed_lamp *lamp, lom_vec3 away);
/* An entity at a place; false when its matrix is singular. */
bool lom_place_entity(const struct lom_world_entity *entity, lom_vec3 position, lom_vec3 rotation,
                      struct lom_placement *placement, lom_error *error);

#endif
