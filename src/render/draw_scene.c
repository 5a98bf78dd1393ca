/* The scene itself in a pass. In: how the pass looks at it. Out: draws of terrain blocks, entities and sky; what lies
 * outside the view or wholly behind the clip plane is left out, which changes no pixel. */
#include "render/renderer.h"
#include "sky/sky_draw.h"

struct lom_light_uniform lom_scene_light(const lom_scene *scene)
{
    const lom_light *light = &scene->light;
    struct lom_light_uniform u = { .to_light = { (float)-light->direction.x, (float)-light->direction.y,
                                                 (float)-light->direction.z } };
    for (int i = 0; i < 3; i++) {
        u.color[i] = (float)(light->color[i] * light->intensity);
        u.ambient[i] = (float)light->ambient[i];
        u.ground[i] = (float)light->ground[i];
    }
    return u;
}

/* The antiderivative of the haze's profile (shading/haze.h). */
static double haze_integral(const lom_haze *haze, double y)
{
    double above = y > haze->base ? y - haze->base : 0;
    return y <= haze->base ? y - haze->base : -haze->height * lom_double_expm1(-above / haze->height);
}

struct lom_haze_uniform lom_scene_haze(const lom_scene *scene, double eye_height, bool mirrored)
{
    const lom_haze *haze = &scene->haze;
    struct lom_haze_uniform u = { .glow_exponent = (float)haze->glow_exponent, .base = (float)haze->base };
    if (haze->given == 0)
        return u;
    for (int i = 0; i < 3; i++) {
        u.density[i] = (float)haze->density[i];
        u.color[i] = (float)haze->color[i];
        u.glow[i] = (float)haze->glow[i];
        u.on |= u.density[i] > 0;
    }
    u.gray = u.density[0] == u.density[1] && u.density[1] == u.density[2];
    if (haze->height > 0) {
        double mirror = scene->water.level;
        u.height = (float)haze->height;
        u.inverse_height = (float)(1 / haze->height);
        u.start = (float)(mirrored ? 2 * haze_integral(haze, mirror) - haze_integral(haze, 2 * mirror - eye_height)
                                   : haze_integral(haze, eye_height));
    }
    return u;
}

struct lom_light_uniform lom_renderer_light(const lom_renderer *renderer)
{
    struct lom_light_uniform u = lom_scene_light(renderer->scene);
    const struct lom_ground_shadow *shadow = &renderer->ground_shadow;
    u.ground_shadow = renderer->ground.shadow;
    lom_ground_scale(&renderer->ground, renderer->scene->terrain.size, u.ground_scale);
    if (!shadow->falls)
        return u;
    u.shadow = shadow->texture;
    u.shadow_strength = (float)renderer->scene->clouds.shadow_strength;
    for (int i = 0; i < 4; i++) {
        u.shadow_s[i] = shadow->s[i];
        u.shadow_t[i] = shadow->t[i];
    }
    return u;
}

/* The highest value of the clip plane over the box; a margin covers rounding in float. */
static bool is_behind_plane(const double plane[4], const lom_box *box)
{
    double value = plane[3];
    value += plane[0] * (plane[0] > 0 ? box->high.x : box->low.x);
    value += plane[1] * (plane[1] > 0 ? box->high.y : box->low.y);
    value += plane[2] * (plane[2] > 0 ? box->high.z : box->low.z);
    return value < -1e-3;
}

bool lom_is_visible(const struct lom_culler *culler, const lom_box *box)
{
    return lom_box_visibility(&culler->frustum, *box) != LOM_OUTSIDE && !is_behind_plane(culler->plane, box);
}

static void set_attributes(lom_draw_desc *draw, const lom_mesh *mesh)
{
    const uint8_t *data = (const uint8_t *)mesh->vertices;
    size_t size = mesh->vertex_count * sizeof(lom_mesh_vertex), stride = sizeof(lom_mesh_vertex);
    draw->attribute[0] = (lom_attribute){ data, size, stride, LOM_ATTRIBUTE_FLOAT3 };
    draw->attribute[1] = (lom_attribute){ data + 12, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 };
    draw->attribute[2] = (lom_attribute){ data + 24, size - 24, stride, LOM_ATTRIBUTE_FLOAT2 };
    draw->attribute[3] = (lom_attribute){ data + 32, size - 32, stride, LOM_ATTRIBUTE_FLOAT4 };
    draw->indices = mesh->indices;
}

/* Whether a placed entity is turned inside out by a negative scale. */
static bool is_mirroring(const lom_mat4 *m)
{
    const double(*r)[4] = m->m;
    double determinant = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                         r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                         r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    return determinant < 0;
}

static void draw_entity(lom_renderer *renderer, const struct lom_loaded_entity *entity,
                        const struct lom_view_uniform *view, bool mirrored)
{
    struct lom_entity_uniforms uniforms = { .view = *view,
                                            .world_from_model = lom_round_matrix(&entity->world_from_model),
                                            .normal_from_model = lom_round_matrix(&entity->normal_from_model) };
    lom_draw_desc draw = { .shader = lom_entity_shader(renderer->scene->quality.shading),
                           .uniforms = &uniforms,
                           .cull = LOM_CULL_BACK,
                           .front_clockwise = mirrored != is_mirroring(&entity->world_from_model) };
    set_attributes(&draw, entity->drawn);
    for (size_t i = 0; i < entity->drawn->part_count; i++) {
        uniforms.material = entity->parts[i].material;
        draw.first = entity->parts[i].first;
        draw.count = entity->parts[i].count;
        lom_draw(renderer->device, &draw);
    }
}

void lom_draw_caster(lom_renderer *renderer, const struct lom_loaded_entity *entity, const lom_mat4 *clip_from_world)
{
    struct lom_caster_uniforms uniforms = { lom_round_matrix(clip_from_world),
                                            lom_round_matrix(&entity->world_from_model) };
    lom_draw_desc draw = { .shader = &lom_caster_shader, .uniforms = &uniforms, .count = entity->drawn->index_count };
    set_attributes(&draw, entity->drawn);
    lom_draw(renderer->device, &draw);
}

void lom_draw_scene(lom_renderer *renderer, const struct lom_scene_view *view)
{
    const lom_scene *scene = renderer->scene;
    lom_mat4 clip_from_world = lom_multiply(&view->projection, &view->view);
    struct lom_view_uniform uniform = { .clip_from_world = lom_round_matrix(&clip_from_world),
                                        .light = lom_renderer_light(renderer),
                                        .haze = lom_scene_haze(scene, view->eye.y, view->mirrored),
                                        .eye = { (float)view->eye.x, (float)view->eye.y, (float)view->eye.z },
                                        .caustics = view->caustics };
    struct lom_culler culler = { lom_view_frustum(&clip_from_world, false), view->plane };
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++)
        uniform.entity_shadow[i] = renderer->entity_shadows[i].uniform;
    for (int i = 0; i < 4; i++)
        uniform.plane[i] = (float)view->plane[i];
    lom_draw_ground(renderer, &culler, &uniform, view->mirrored);
    for (size_t i = 0; i < renderer->entity_count; i++)
        if (!renderer->entities[i].is_hidden && lom_is_visible(&culler, &renderer->entities[i].bounds))
            draw_entity(renderer, &renderer->entities[i], &uniform, view->mirrored);
    if (view->sky)
        lom_draw_sky(renderer->device, &scene->sky, renderer->sky, uniform.light.to_light, &view->projection,
                     &view->view);
    if (view->sky && renderer->sun != NULL)
        lom_draw_sun(renderer->device, &scene->sky, renderer->sun, &uniform.light, &view->projection, &view->view);
}

bool lom_shows_scene(const lom_renderer *renderer, const struct lom_scene_view *view)
{
    lom_mat4 clip_from_world = lom_multiply(&view->projection, &view->view);
    const struct lom_ground *ground = &renderer->ground;
    struct lom_culler culler = { lom_view_frustum(&clip_from_world, false), view->plane };
    for (int i = 0; i < ground->across * ground->down; i++)
        if (lom_is_visible(&culler, &ground->blocks[i].bounds))
            return true;
    for (size_t i = 0; i < renderer->entity_count; i++)
        if (!renderer->entities[i].is_hidden && lom_is_visible(&culler, &renderer->entities[i].bounds))
            return true;
    return false;
}
