/* Edges of a frame that are smoothed after they are drawn (lom_smooth_edges). In: the scene and its water, drawn with where
 * their triangles end. Out: the picture that clouds and drops go on with; the same of what water mirrors.
 *
 * Invariant: a crop is smoothed as the whole is: what is drawn is larger by as much as the filter looks at, and as the
 * rays look beyond it that liquids bend. */
#include "pipeline/device.h"
#include "render/frame.h"

enum { MARGIN = 2 }; /* pixels on each side */

int lom_grow_range(int *from, int *count, int size, int margin)
{
    const int before = *from < margin ? *from : margin, rest = size - *from - *count;
    *from -= before;
    *count += before + (rest < margin ? rest : margin);
    return before;
}

/* What is counted texel by texel is drawn without, so that only triangles of the scene count (lom/record.h). */
static bool is_tallied(const lom_renderer *r)
{
    return r->device->tallier != NULL;
}

void lom_begin_edges(struct frame *f)
{
    f->smooths = lom_smooths_edges(f->scene) && f->renderer->reference == NULL && !is_tallied(f->renderer);
    f->target = f->smooths ? LOM_TARGET_SHARP : LOM_TARGET_COLOR;
    f->asked = (lom_rect){ 0, 0, f->crop.width, f->crop.height };
    const bool bends = lom_count_fluids(f->scene) != 0 && f->renderer->reference == NULL;
    const int margin = (f->smooths ? MARGIN : 0) + (bends ? lom_fluid_reach(f->height) : 0);
    f->asked.x = lom_grow_range(&f->crop.x, &f->crop.width, f->width, margin);
    f->asked.y = lom_grow_range(&f->crop.y, &f->crop.height, f->height, margin);
}

static bool smooth(struct frame *f, const lom_edge_filter *filter, const lom_pass_desc *pass)
{
    lom_device *device = f->renderer->device;
    lom_begin_pass(device, pass);
    lom_smooth_edges(device, filter);
    return lom_end_pass(device);
}

static const char *reason_without(const struct frame *f)
{
    return f->scene->output.samples > 1 ? "output.samples smooths them"
                                        : "texels are tallied, which is of triangles without the filter";
}

bool lom_smooth_frame(struct frame *f, lom_error *error)
{
    (void)error;
    lom_texture *const *of = f->renderer->targets.of;
    if (f->scene->output.edges == LOM_EDGES_SHARP)
        return true;
    if (!f->smooths) {
        lom_add_step(f, "edges", false, "%s", reason_without(f));
        return true;
    }
    lom_step *step =
        lom_add_step(f, "edges", true, "pixels along edges mixed with what lies beyond, by where triangles end");
    step->width = f->crop.width;
    step->height = f->crop.height;
    const lom_edge_filter filter = { of[LOM_TARGET_SHARP], of[LOM_TARGET_EDGES], of[LOM_TARGET_DEPTH], f->crop.x,
                                     f->crop.y };
    lom_pass_desc pass = lom_frame_pass(f, of[LOM_TARGET_COLOR]);
    pass.depth = NULL;
    pass.label = "edges";
    f->target = LOM_TARGET_COLOR;
    return smooth(f, &filter, &pass);
}

void lom_begin_smooth_picture(struct frame *f, lom_pass_desc *pass)
{
    lom_texture *const *of = f->renderer->targets.of;
    pass->color[0] = of[LOM_TARGET_REFLECTION_SHARP];
    pass->edges = of[LOM_TARGET_REFLECTION_EDGES];
    lom_grow_range(&pass->scissor.x, &pass->scissor.width, lom_texture_width(pass->color[0]), MARGIN);
    lom_grow_range(&pass->scissor.y, &pass->scissor.height, lom_texture_height(pass->color[0]), MARGIN);
}

bool lom_smooth_picture(struct frame *f, lom_pass_desc *pass, lom_texture *color, lom_rect scissor)
{
    const lom_edge_filter filter = { pass->color[0], pass->edges, pass->depth, 0, 0 };
    lom_texture *const depth = pass->depth;
    pass->color[0] = color;
    pass->edges = pass->depth = NULL;
    pass->scissor = scissor;
    const bool done = smooth(f, &filter, pass);
    pass->depth = depth;
    return done;
}
