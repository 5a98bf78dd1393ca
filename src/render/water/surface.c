/* Water with waves in a frame: normals on two triangles, a displaced mesh, or a ray a pixel. In: the frame whose opaque
 * scene is drawn. Out: the water over it, and for an eye below its surface the water in between.
 *
 *   visibility (where may it be?) -> reflection, refraction (only there) -> water -> underwater
 *
 * Invariant: a pass that is left out, or cut by a scissor, changes no byte of the picture. */
#include "render/water/surface.h"
#include "water/underwater.h"

/* Fills the mesh and the draw's triangles, those that may be seen. */
static bool fill_mesh(struct surface *surface, struct frame *f, lom_draw_desc *draw, lom_error *error)
{
    struct lom_surface_uniforms *u = &surface->uniforms;
    struct lom_polar_mesh *mesh = &f->renderer->water->polar;
    struct lom_polar_mesh_desc desc = { .projection = f->view.projection,
                                        .view = f->view.view,
                                        .level = surface->level,
                                        .near_plane = f->camera.near_plane,
                                        .lowest = (double)u->waves.lowest,
                                        .highest = (double)u->waves.highest,
                                        .reach = (double)u->waves.reach,
                                        .quad = { surface->quad[0], surface->quad[1], surface->quad[2],
                                                  surface->quad[3] },
                                        .cell = f->scene->water.waves.cell,
                                        .pixel_angle = (double)u->eye.pixel };
    if (!lom_fill_polar_mesh(mesh, &desc, error))
        return false;
    u->mesh = (struct lom_polar_mesh_uniform){ .radius = mesh->radius,
                                               .spacing = mesh->spacing,
                                               .cosine = mesh->cosine,
                                               .sine = mesh->sine,
                                               .nearest = mesh->nearest,
                                               .farthest = mesh->farthest,
                                               .columns = mesh->columns,
                                               .apex = { (float)mesh->apex[0], (float)mesh->apex[1] } };
    const lom_frustum frustum = lom_view_frustum(&surface->clip_from_offset, false);
    const size_t before = (size_t)lom_first_seen_ring(mesh, &desc, &frustum) * (size_t)(mesh->columns - 1) * 6;
    draw->indices = mesh->indices + before;
    draw->count = mesh->index_count - before;
    draw->vertex_count = (size_t)mesh->rings * (size_t)mesh->columns;
    return true;
}

static bool draw_surface(struct surface *surface, struct frame *f, lom_error *error)
{
    const struct lom_water_model_row *model = &lom_water_models[f->scene->quality.water];
    lom_draw_desc draw = { .shader = model->shader, .uniforms = &surface->uniforms };
    switch (model->form) {
    case LOM_SURFACE_QUAD:
        draw.count = 4;
        draw.topology = LOM_TRIANGLE_STRIP;
        break;
    case LOM_SURFACE_MESH:
        if (!fill_mesh(surface, f, &draw, error))
            return false;
        break;
    case LOM_SURFACE_RAYS:
        draw.count = 3;
        break;
    }
    return lom_draw_over_scene(f, model->text, &draw, error);
}

/* ---- the water between the eye and everything ---- */

static bool draw_underwater(const struct surface *surface, struct frame *f)
{
    lom_renderer *r = f->renderer;
    const struct lom_surface_uniforms *u = &surface->uniforms;
    struct lom_underwater_uniforms under = { .medium = u->medium,
                                             .pixel = { u->pixel[0], u->pixel[1] },
                                             .eye = u->eye,
                                             .depth = r->targets.of[LOM_TARGET_DEPTH],
                                             .origin = { (float)f->crop.x, (float)f->crop.y },
                                             .crop_pixel = { 1.0f / (float)f->crop.width,
                                                             1.0f / (float)f->crop.height },
                                             .depth_of_eye = (float)surface->level,
                                             .highest = u->waves.highest,
                                             .multiplies = true };
    memcpy(under.ray, u->ray, sizeof under.ray);
    lom_step *step = lom_add_step(f, "underwater", true, "the water between the eye and all that is drawn");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_pass_desc pass = lom_frame_pass(f, r->targets.of[f->target]);
    pass.depth = NULL;
    pass.color_load[0] = LOM_LOAD_KEEP;
    pass.label = "underwater";
    struct lom_underwater_uniforms light = under;
    light.multiplies = false;
    const lom_blend multiply = { .enabled = true,
                                 .target_color = LOM_FACTOR_SOURCE_COLOR,
                                 .target_alpha = LOM_FACTOR_ONE };
    const lom_blend add = {
        .enabled = true, .source_color = LOM_FACTOR_ONE, .target_color = LOM_FACTOR_ONE, .target_alpha = LOM_FACTOR_ONE
    };
    const lom_draw_desc draws[] = {
        { .shader = &lom_underwater_shader, .uniforms = &under, .count = 3, .blend = { multiply } },
        { .shader = &lom_underwater_shader, .uniforms = &light, .count = 3, .blend = { add } }
    };
    return lom_draw_pass(r->device, &pass, draws, 2);
}

static bool draw_seen(struct surface *surface, struct frame *f, lom_error *error)
{
    if (!f->below && !lom_draw_caustics(f, error))
        return false;
    return lom_draw_surface_pictures(surface, f, error) && draw_surface(surface, f, error);
}

bool lom_draw_surface(struct frame *f, lom_error *error)
{
    struct surface surface;
    if (!lom_has_waves(f))
        return true;
    lom_look_at_surface(&surface, f);
    if (f->water.width != 0 && !draw_seen(&surface, f, error))
        return false;
    return !f->below || draw_underwater(&surface, f);
}
