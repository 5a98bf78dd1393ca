/* The picture of the ground from above: the base, all layers and the detail map composed, a few texels a quad of the
 * height map. In: the ground and its maps. Out: a texture with its levels of detail, from which distant ground is
 * shaded by one lookup. Invariant: it follows from the scene alone, not from a frame's camera. */
#include "base/numbers.h"
#include "pipeline/check_device.h"
#include "render/frame.h"
#include "render/ground/shaders.h"

enum { TEXELS_A_QUAD = 2, MOST_TEXELS = 2048 };

static int texels_along(int quads)
{
    return lom_smaller_int(quads, MOST_TEXELS / TEXELS_A_QUAD) * TEXELS_A_QUAD;
}

static lom_texture *make_target(lom_renderer *r)
{
    bool srgb = r->scene->output.transfer == LOM_TRANSFER_SRGB;
    lom_sampler_desc sampler = lom_scene_sampler(&r->scene->quality);
    sampler.wrap_s = sampler.wrap_t = LOM_WRAP_CLAMP;
    return lom_make_texture(r->device, &(lom_texture_desc){ .width = texels_along(r->ground.columns),
                                                            .height = texels_along(r->ground.rows),
                                                            .format = srgb ? LOM_FORMAT_RGBA8_SRGB : LOM_FORMAT_RGBA8,
                                                            .label = "terrain layers",
                                                            .mips = LOM_MIPS_ALL,
                                                            .sampler = sampler });
}

/* From above: x runs right and z down, all of the ground is the picture. */
static struct lom_view_uniform view_from_above(const double size[2])
{
    struct lom_view_uniform view = { .plane = { 0, 0, 0, 1 } };
    lom_mat4 clip = lom_identity();
    clip.m[0][0] = 2 / size[0];
    clip.m[1][1] = 0;
    clip.m[1][2] = -2 / size[1];
    clip.m[2][2] = 0;
    clip.m[2][3] = 0.5;
    view.clip_from_offset = lom_round_matrix(&clip);
    return view;
}

void lom_drop_composed_ground(lom_renderer *renderer)
{
    if (renderer->ground.composed != NULL)
        lom_release_texture(renderer->device, renderer->ground.composed);
    renderer->ground.composed = NULL;
}

static bool compose(struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    const lom_terrain *terrain = &f->scene->terrain;
    const struct lom_view_uniform view = view_from_above(terrain->size);
    const lom_vec3 middle = { 0, terrain->base, 0 };
    r->ground.composed = make_target(r);
    lom_step *step = lom_add_step(f, "terrain layers", true, "all layers from above, for ground that is far away");
    step->width = texels_along(r->ground.columns);
    step->height = texels_along(r->ground.rows);
    lom_begin_pass(r->device, &(lom_pass_desc){ .color = { r->ground.composed }, .label = "terrain layers" });
    lom_choose_ground(&r->ground, middle, 1, 0, false); /* all quads */
    struct lom_terrain_uniforms uniforms = lom_terrain_uniforms_of(r, &view, middle);
    uniforms.composed.map = NULL;
    lom_draw_ground_blocks(r, NULL, &(lom_draw_desc){ .shader = &lom_terrain_albedo, .uniforms = &uniforms });
    if (!lom_end_pass(r->device)) /* or abandoned: it is not composed */
        lom_drop_composed_ground(r);
    return lom_check_device(r->device, error);
}

bool lom_compose_ground(struct frame *f, lom_error *error)
{
    const lom_quality *quality = &f->scene->quality;
    if (!(quality->terrain_composite > 0) || f->scene->terrain.layer_count == 0)
        return true;
    if (!quality->mipmaps) {
        lom_add_step(f, "terrain layers", false, "quality.mipmaps is off: there is no coarser picture of the ground");
        return true;
    }
    if (f->renderer->ground.composed != NULL) {
        lom_add_step(f, "terrain layers", false, "they are composed already");
        return true;
    }
    return compose(f, error);
}
