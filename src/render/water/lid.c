/* What water hides of the scene. In: a frame whose waves have bounds. Out: depth in the scene's pass, before the scene: a
 * level rectangle below the lowest wave, so that what lies under it, bed or sky, is not shaded where water covers it.
 *
 * An eye above all waves and over the water's quad sees a place below them through the surface: the ray to it enters the
 * slab of the waves and leaves it below, inside of the quad, and the surface is one sheet from edge to edge. Water with
 * waves is opaque, and what is seen through it is in a picture of its own (surface_pictures.c).
 *
 * Invariant: no pixel that the lid covers shows anything but water, which is nearer there by far more than depths are
 * rounded. */
#include "base/numbers.h"
#include "render/water/passes.h"
#include "water/lid.h"

/* The share of the eye's height over the lowest wave by which the lid is lower: along a ray it is farther away than water
 * by as much. */
static const double lower = 0.05;

/* From the eye to where lids end. A depth is near / w up to 2^-21 of the largest one of its triangle, which is cut at 1,
 * and up to what 1/256 of a pixel is of its slope near / (height pixels): both stay below a fourth of `lower`. So do the
 * heights of corners, of which floats hold 2^-22. */
static double range_of(const struct frame *f, double height)
{
    double range = 1.5e4 * f->camera.near_plane, pixels = f->view.projection.m[1][1] * f->height / 2;
    range = lom_smaller(range, 2 * height * pixels);
    return lom_smaller(range, 1e5 * lower * height);
}

/* Whether the picture of what is behind the surface may begin with what the frame shows there. */
static bool copies_bed(const struct frame *f)
{
    return !lom_water_models[f->scene->quality.water].bends && f->renderer->ground.blocks != NULL;
}

/* Whether the eye sees all of the waves from above, farther away than the near plane is at the corners of the view. */
static bool is_over(const struct frame *f, double over_highest)
{
    const double(*p)[4] = f->view.projection.m;
    double corner = lom_double_sqrt(1 + 1 / (p[0][0] * p[0][0]) + 1 / (p[1][1] * p[1][1]));
    return !f->below && over_highest > 2 * corner * f->camera.near_plane;
}

static bool find_lid(const struct frame *f, struct lom_lid_uniforms *lid)
{
    const lom_water_params *water = &f->scene->water;
    const bool flat = lom_water_models[f->scene->quality.water].form == LOM_SURFACE_QUAD;
    const double lowest = flat ? 0 : (double)f->waves.lowest, highest = flat ? 0 : (double)f->waves.highest;
    const double height = f->view.eye.y - water->level - lowest, eye[2] = { f->view.eye.x, f->view.eye.z };
    if (!is_over(f, f->view.eye.y - water->level - highest))
        return false;
    const double range = range_of(f, height), inner = (flat ? 0 : (double)f->waves.reach) + 0.001 * height;
    for (int i = 0; i < 2; i++) {
        double middle = water->position[i] - eye[i], half = water->size[i] / 2 * (1 - 1e-4) - inner;
        if (!(middle - half < 0) || !(middle + half > 0))
            return false;
        lid->low[i] = (float)lom_larger(middle - half, -range);
        lid->high[i] = (float)lom_smaller(middle + half, range);
    }
    lid->level = (float)-(height * (1 + lower));
    lom_mat4 clip = lom_clip_from_offset(&f->view.projection, &f->view.view);
    lid->clip_from_offset = lom_round_matrix(&clip);
    return true;
}

static bool has_lid(const struct frame *f, struct lom_lid_uniforms *lid)
{
    return lom_has_waves(f) && f->scene->quality.scissor && f->scene->output.samples <= 1 && !f->parallel &&
           !copies_bed(f) && find_lid(f, lid);
}

bool lom_hides_below(const struct frame *f)
{
    struct lom_lid_uniforms lid;
    return has_lid(f, &lid);
}

void lom_draw_lid(const struct frame *f)
{
    struct lom_lid_uniforms lid;
    if (!has_lid(f, &lid))
        return;
    lom_draw(f->renderer->device, &(lom_draw_desc){ .shader = &lom_lid_shader,
                                                    .uniforms = &lid,
                                                    .count = 4,
                                                    .vertex_count = 4,
                                                    .topology = LOM_TRIANGLE_STRIP,
                                                    .label = "below the water",
                                                    .object = LOM_OBJECT_WATER });
}
