/* Entities as they are drawn: meshes in their places, and maps of the shadows that they throw. */
#ifndef LOM_RENDER_ENTITIES_ENTITIES_H
#define LOM_RENDER_ENTITIES_ENTITIES_H

#include "pipeline/draw_again.h"
#include "render/scene_view.h"
#include "render/sun_view.h"
#include "world/world.h"

struct frame;
struct lom_entity_uniforms;

/* A thing by its distance from the eye, in the pass at hand (transparent.c): an entity, or a triangle of one. */
struct lom_distant {
    uint32_t number, part; /* of the entity; or the triangle's first index, and which of the materials it has */
    double distance;       /* of its middle: what grows with it */
};

/* Where a view's rays come from. */
struct lom_order {
    lom_vec3 eye, ahead;
    bool parallel;
};

/* A triangle's first index, and the part that it is of. */
struct lom_listed_triangle {
    uint32_t number, part;
};

/* What of an entity is transparent. */
struct lom_transparent {
    struct lom_listed_triangle *listed; /* in the mesh's order */
    struct lom_distant *triangles;      /* twice as many: where they are sorted, too */
    const struct lom_distant *sorted;   /* of those; NULL: not yet */
    uint32_t *indices;                  /* in the order of drawing */
    struct lom_order seen_from;         /* of that order, */
    lom_mat4 place;                     /* and where the entity was */
    struct lom_held_draw *held;         /* of each material, in the pass at hand */
    size_t count;
};

struct lom_drawn_entity {
    const struct lom_world_entity *source;
    const struct lom_placement *at;         /* in the frame */
    struct lom_material_uniform *materials; /* one a part */
    struct lom_material_uniform *backs;     /* behind them, of a two-sided entity; else NULL */
    uint32_t *edges;                        /* of its mesh, for a wireframe; NULL without */
    size_t edge_count;                      /* indices, two each */
    bool shares_edges;                      /* with an entity before it */
    unsigned shadow_maps;                   /* that it is drawn into in this frame: sun_map.h */
    struct lom_transparent transparent;
};

/* A map of what entities keep the sun off. */
struct lom_entity_shadow {
    lom_texture *map;
    struct lom_near_blocks near; /* of the map */
    bool falls;                  /* on something, in this frame */
    struct lom_sun_map at;
    uint64_t made_for;
};

struct lom_drawn_entities {
    struct lom_drawn_entity *items;
    size_t count;
    struct lom_distant *order; /* twice as many */
    struct lom_entity_shadow shadows[LOM_ENTITY_SHADOWS];
    bool cascaded; /* they are cascades of the view */
};

bool lom_load_entities(lom_renderer *renderer, lom_error *error);
/* Whether any of it is opaque and drawn: what is transparent throws no shadow. */
bool lom_throws_shadow(const struct lom_drawn_entity *entity);
/* Makes the maps of their shadows. */
bool lom_prepare_entities(struct frame *f, lom_error *error);
/* Draws what is opaque of those that a pass sees. */
void lom_draw_entities(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_culler *culler,
                       const struct lom_view_uniform *uniform);
/* Draws what is transparent of them, from the farthest to the nearest, over what the pass has; the number of them. */
size_t lom_draw_transparent_entities(lom_renderer *renderer, const struct lom_scene_view *view,
                                     const struct lom_culler *culler, const struct lom_view_uniform *uniform);
size_t lom_count_transparent_entities(const lom_renderer *renderer, const struct lom_culler *culler);
/* The same in a pass over a picture that `pass` has drawn, of the same view, with its depth: over what is opaque, and the
 * clouds. */
bool lom_draw_transparent_over(struct frame *f, const struct lom_scene_view *view, lom_pass_desc pass);
/* The frame's: beyond the level of its water, before that is drawn over them; and, a stage, all that is nearer, or all. */
bool lom_draw_transparent_beyond(struct frame *f);
bool lom_draw_transparent(struct frame *f, lom_error *error);
/* The triangles of an entity that are transparent, when its materials are loaded. */
bool lom_list_transparent(struct lom_drawn_entity *entity, lom_error *error);
void lom_free_entities(lom_renderer *renderer);
/* The maps of their shadows are made anew by the next frame. */
void lom_drop_entity_shadows(lom_renderer *renderer);

/* Whether one of them would be drawn; whether any. */
bool lom_shows_entity(const struct lom_drawn_entity *entity, const struct lom_culler *culler);
bool lom_shows_entities(const lom_renderer *renderer, const struct lom_culler *culler);
/* The maps of the sun's shadow, for places less the eye. */
struct lom_sun_shadow_uniform lom_entity_shadow_uniform(const struct lom_drawn_entities *entities, lom_vec3 eye);
/* What the draws of an entity have in common; the uniforms' material is not set. */
lom_draw_desc lom_begin_entity(const lom_renderer *renderer, const struct lom_drawn_entity *entity,
                               const struct lom_scene_view *view, const struct lom_view_uniform *uniform,
                               struct lom_entity_uniforms *uniforms);
/* Whether a matrix turns what it places inside out, by a negative scale. */
bool lom_is_mirroring(const lom_mat4 *m);
/* Draws the depth of what is opaque of an entity, both sides of its faces, into the pass that has begun. */
void lom_draw_caster(lom_renderer *renderer, const struct lom_drawn_entity *entity, const lom_mat4 *clip_from_world);

#endif
