/* What a renderer loads from a scene and what its frames leave behind, as parts that can be made anew one by one; and
 * which keys of a scene each part is loaded for. */
#ifndef LOM_RENDER_ROOMS_H
#define LOM_RENDER_ROOMS_H

#include "render/renderer.h"

enum {
    LOM_PART_HEIGHTS = 1 << 0,  /* of the terrain, in the world */
    LOM_PART_TEXTURES = 1 << 1, /* of pictures, wherever they are used */
    LOM_PART_SKY = 1 << 2,
    LOM_PART_SUN = 1 << 3, /* its picture */
    LOM_PART_GROUND = 1 << 4,
    LOM_PART_GROUND_MAPS = 1 << 5,
    LOM_PART_ENTITIES = 1 << 6, /* in the world and as they are drawn */
    LOM_PART_WATER_MAPS = 1 << 7,
    LOM_PART_FOAM = 1 << 8,
    LOM_PART_BED = 1 << 9,
    LOM_PART_WAVES = 1 << 10,
    LOM_PART_CLOUDS = 1 << 11,
    LOM_PART_SPRAY = 1 << 12,
    LOM_PART_FOLLOWED = 1 << 13,     /* the waves of bodies that go with an entity */
    LOM_PART_OTHER_WATERS = 1 << 14, /* all that a scene's waters beside the first have */
    LOM_PART_FLUIDS = 1 << 15,
    LOM_PARTS_LOADED = (1 << 16) - 1,
    /* What frames make for the frames after them. */
    LOM_PART_GROUND_SHADOW = 1 << 16,
    LOM_PART_ENTITY_SHADOWS = 1 << 17,
    LOM_PART_CAUSTICS = 1 << 18,
    LOM_PART_CLOUD_LIGHT = 1 << 19,
    LOM_PART_TARGETS = 1 << 20,
    LOM_PART_GROUND_LAYERS = 1 << 21, /* composed */
    LOM_PART_LAMP_SHADOWS = 1 << 22,
    LOM_PARTS_ALL = (1 << 23) - 1
};

/* A part that is loaded: the members of a renderer that are its own, from which load makes it when they are zeros. */
struct lom_room {
    unsigned part;
    const char *name;
    size_t offset, size;
    bool (*exists)(const lom_scene *scene); /* whether there is anything to load */
    bool (*load)(lom_renderer *renderer, lom_error *error);
    void (*free)(lom_renderer *renderer); /* also after a load that failed; the members are of no use then */
};

enum { LOM_ROOMS = 13 };
extern const struct lom_room lom_rooms[LOM_ROOMS]; /* in the order in which they are loaded */

/* Loads these parts of the renderer's world. */
bool lom_load_rooms(lom_renderer *renderer, unsigned parts, lom_error *error);
void lom_free_rooms(lom_renderer *renderer, unsigned parts);
/* Frees what frames have made of these parts, which the next frame makes again. */
void lom_drop_made(lom_renderer *renderer, unsigned parts);

/* renderer.c: the rest of a renderer that has a world: its moment, these parts, or the reference instead. */
bool lom_load_renderer(lom_renderer *renderer, unsigned parts, lom_error *error);
bool lom_is_traced(const lom_scene *scene);

/* A row of the table of what keys are loaded for (key_parts.c): paths of keys without the numbers of elements, and of
 * tables, whose own path stands for whether the file has them and how many; with ".*" all that is below, too. */
struct lom_key_row {
    unsigned parts; /* 0: the keys are looked up in each frame alone */
    const char *names;
};
extern const struct lom_key_row lom_key_rows[];
extern const size_t lom_key_row_count;

/* The rows that name a path; the parts of the first, all where there is none. */
int lom_find_key_parts(const char *path, unsigned *parts);
struct lom_difference {
    bool any;       /* a key differs */
    bool ends_run;  /* one that a run of impostors does not look at in each frame */
    unsigned parts; /* what is to be made anew: also what is made from that, less what neither scene has */
};
struct lom_difference lom_difference_between(const lom_scene *before, const lom_scene *after);

#endif
