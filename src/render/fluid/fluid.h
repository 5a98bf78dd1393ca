/* Liquids as they are drawn: each with its particles as far as they have been run, and its surface. */
#ifndef LOM_RENDER_FLUID_FLUID_H
#define LOM_RENDER_FLUID_FLUID_H

#include <lom/render.h>

struct frame;

struct lom_drawn_fluid {
    lom_fluid *fluid; /* NULL: not begun */
    lom_mesh *mesh;   /* after the steps of `meshed`; NULL: none */
    int64_t meshed;
};

struct lom_drawn_fluids {
    struct lom_drawn_fluid *items; /* by the scene's number */
    size_t count;
    uint64_t run; /* steps, all together */
};

bool lom_load_fluids(lom_renderer *renderer, lom_error *error);
void lom_free_fluids(lom_renderer *renderer);
/* Liquids that are drawn; 0 where quality.fluid is off. */
size_t lom_count_fluids(const lom_scene *scene);
/* Pixels of a frame of this height that a bent ray may be off. */
int lom_fluid_reach(int height);
/* Steps liquids to the frame's time and draws them over what is opaque: steps of the plan. */
bool lom_draw_fluids(struct frame *f, lom_error *error);

#endif
