/* Drops as they are drawn. */
#ifndef LOM_RENDER_SPRAY_SPRAY_H
#define LOM_RENDER_SPRAY_SPRAY_H

#include "spray/hits.h"

#include <lom/render.h>

struct frame;

/* Drops that a worker moves at a time. */
enum { LOM_DROPS_TOGETHER = 512 };

/* What drops need in a frame: room for all of them. */
struct lom_drawn_spray {
    size_t capacity;                  /* drops of visible emitters; 0: none */
    struct lom_sprite_reach *reaches; /* of the pieces of an emitter */
    struct lom_sprite *sprites;
    float *depth;
    float *state[2]; /* of drops that bounce; NULL: there are none */
    uint32_t *order, *scratch;
    struct lom_hits *hits; /* of each emitter of the scene whose source is not its segment; NULL: of none */
    size_t hits_count;
};

bool lom_load_spray(lom_renderer *renderer, lom_error *error);
/* Moves the drops and draws them over all, a step of the plan. */
/* The states of an emitter's drops that bounce, into state[0] of the renderer's; false with an error on the device. */
bool lom_bounce_drops(struct frame *f, const lom_spray *spray, const lom_emitter *emitter);
bool lom_draw_spray(struct frame *f, lom_error *error);
void lom_free_spray(lom_renderer *renderer);

/* Drops of the visible emitters; 0 where quality.spray is off. */
size_t lom_count_drops(const lom_scene *scene);

#endif
