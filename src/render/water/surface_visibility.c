/* Where water with waves is seen. In: the frame whose opaque scene is drawn. Out: f->water, a rectangle outside of which
 * no pixel shows it; and all of the waves, when it is somewhere. Invariant: of a sea no more is made than that needs. */
#include "base/numbers.h"
#include "render/water/surface.h"

static lom_box slab(const struct surface *surface, bool flat)
{
    const struct lom_waves_uniform *waves = &surface->uniforms.waves;
    double low = surface->level + (flat ? 0 : (double)waves->lowest);
    double high = surface->level + (flat ? 0 : (double)waves->highest);
    double out = flat ? 0 : (double)waves->reach;
    return (lom_box){ { surface->quad[0] - out, low, surface->quad[1] - out },
                      { surface->quad[2] + out, high, surface->quad[3] + out } };
}

/* The faces of a box, into the frame's mask where nothing is before them. */
static bool draw_box(const struct surface *surface, struct frame *f, const lom_box *box)
{
    static const uint32_t faces[36] = { 0, 1, 2, 2, 1, 3, 4, 6, 5, 5, 6, 7, 0, 4, 1, 1, 4, 5,
                                        2, 3, 6, 6, 3, 7, 0, 2, 4, 4, 2, 6, 1, 5, 3, 3, 5, 7 };
    float corners[8][3];
    for (int i = 0; i < 8; i++) {
        corners[i][0] = (float)(i & 1 ? box->high.x : box->low.x);
        corners[i][1] = (float)(i & 4 ? box->high.y : box->low.y);
        corners[i][2] = (float)(i & 2 ? box->high.z : box->low.z);
    }
    lom_pass_desc pass = lom_frame_pass(f, f->renderer->targets.of[LOM_TARGET_MASK]);
    pass.depth_load = LOM_LOAD_KEEP;
    pass.label = "visibility";
    const lom_draw_desc draw = { .shader = &lom_surface_bounds_shader,
                                 .uniforms = &surface->uniforms,
                                 .attribute = { { corners, sizeof corners, 12, LOM_ATTRIBUTE_FLOAT3 } },
                                 .indices = faces,
                                 .count = 36,
                                 .depth_clamp = true, /* the near plane does not cut what lies before the water */
                                 .depth_write_off = true };
    return lom_draw_pass(f->renderer->device, &pass, &draw, 1);
}

/* A point of the surface that is seen lies in the slab of its waves, whose faces are before it: where no face passes
 * the depth test, no water is seen. An eye in the slab may see it anywhere. */
static bool draw_visibility(struct surface *surface, struct frame *f, bool flat)
{
    lom_box box = slab(surface, flat);
    double margin = 2.1 * f->camera.near_plane;
    if (f->parallel) { /* rays start anywhere on a plane */
        const float(*rows)[3] = surface->uniforms.ray;
        margin += lom_magnitude((double)rows[1][0]) + lom_magnitude((double)rows[1][1]);
    }
    if (!flat && box.low.y < margin && box.high.y > -margin) {
        lom_add_step(f, "visibility", false, "the eye is among the waves: they may be anywhere");
        f->water = f->crop;
        return true;
    }
    lom_step *step = lom_add_step(f, "visibility", true, "which pixels may show the water's surface%s",
                                  f->known != LOM_WAVES_BOUNDED ? "" : ", however high its waves");
    step->width = f->crop.width;
    step->height = f->crop.height;
    if (!draw_box(surface, f, &box))
        return false;
    lom_find_water(f);
    return true;
}

/* Where the water may be seen, f->water; why not, when it is nowhere. */
static bool find_seen(struct surface *surface, struct frame *f, const char **why)
{
    bool flat = lom_water_models[f->scene->quality.water].form == LOM_SURFACE_QUAD;
    lom_box box = slab(surface, flat);
    lom_frustum frustum = lom_view_frustum(&surface->clip_from_offset, false);
    f->water = (lom_rect){ 0, 0, 0, 0 };
    *why = "the water is outside the view";
    if (lom_box_visibility(&frustum, box) == LOM_OUTSIDE)
        return true;
    *why = "the scene hides all of the water";
    if (!draw_visibility(surface, f, flat))
        return false;
    if (f->water.width != 0)
        *why = NULL;
    return true;
}

/* First with the bounds of a sea that has no places: its slab holds that of the actual waves, so where no face of the
 * one is seen, none of the other is. */
static bool find_waves(struct surface *surface, struct frame *f, const char **why, lom_error *error)
{
    if (!find_seen(surface, f, why))
        return false;
    if (*why == NULL && f->known == LOM_WAVES_BOUNDED) {
        if (!lom_place_frame_waves(f, error))
            return false;
        surface->uniforms.waves = f->waves;
        if (!find_seen(surface, f, why))
            return false;
    }
    if (*why != NULL && f->known != LOM_WAVES_FILLED)
        lom_report_frame_waves(f, LOM_WAVES_AT_FILLING, *why);
    return *why != NULL || f->known == LOM_WAVES_FILLED || lom_fill_frame_waves(f, error);
}

bool lom_find_surface(struct frame *f, lom_error *error)
{
    struct surface surface;
    const char *why;
    if (!lom_has_waves(f))
        return true;
    lom_look_at_surface(&surface, f);
    if (!find_waves(&surface, f, &why, error))
        return false;
    lom_report_frame_waves(f, LOM_WAVES_AT_DRAWING, why);
    return why == NULL || lom_skip_water(f, why);
}
