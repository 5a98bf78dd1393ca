/* The scene itself in a pass. In: how the pass looks at it. Out: draws of terrain blocks, entities and sky; what lies
 * outside the view or wholly behind the clip plane is left out, which changes no pixel. Compiled for speed. */
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
    struct lom_haze_uniform u = { .glow_exponent = (float)haze->glow_exponent,
                                  .base = (float)(haze->base - eye_height) };
    if (!haze->present)
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

/* The row of a matrix for offsets that is `row` for places. */
static void center_row(float out[4], const double row[4], lom_vec3 eye)
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)row[i];
    out[3] = (float)(row[3] + row[0] * eye.x + row[1] * eye.y + row[2] * eye.z);
}

/* Terrain's shadows are as sharp as the vertices that throw them tell: the edge is as high as a part of the way between
 * two of them, half a metre where these are 1.6 m apart. */
static const double shadow_edge = 0.3125;

static void set_ground_light(struct lom_light_uniform *u, const lom_renderer *renderer, lom_vec3 eye)
{
    const lom_terrain *t = &renderer->scene->terrain;
    const struct lom_ground *ground = &renderer->ground;
    u->ground_shadow = ground->shadow;
    if (ground->shadow == NULL)
        return;
    double across = t->size[0] / ground->columns, down = t->size[1] / ground->rows;
    lom_map_ground(ground, t->size, eye, u->ground_scale, u->ground_shift);
    u->ground_height = (float)(eye.y - t->base);
    u->ground_sharpness = (float)(1 / (shadow_edge * (across < down ? across : down)));
}

struct lom_light_uniform lom_renderer_light(const lom_renderer *renderer, lom_vec3 eye)
{
    struct lom_light_uniform u = lom_scene_light(renderer->scene);
    const struct lom_ground_shadow *shadow = &renderer->ground_shadow;
    set_ground_light(&u, renderer, eye);
    if (!shadow->falls)
        return u;
    u.shadow = shadow->texture;
    u.shadow_strength = (float)renderer->scene->clouds.shadow_strength;
    center_row(u.shadow_s, shadow->s, eye);
    center_row(u.shadow_t, shadow->t, eye);
    return u;
}

lom_mat4 lom_clip_from_offset(const lom_mat4 *projection, const lom_mat4 *view)
{
    lom_mat4 turned = *view;
    for (int i = 0; i < 3; i++)
        turned.m[i][3] = 0;
    return lom_multiply(projection, &turned);
}

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

/* Whether the highest value of the clip plane over the box, seen from the eye, is below 0 by more than floats round. */
static bool is_behind_plane(const double plane[4], lom_vec3 eye, const lom_box *box)
{
    const double low[3] = { box->low.x, box->low.y, box->low.z }, high[3] = { box->high.x, box->high.y, box->high.z };
    const double from[3] = { eye.x, eye.y, eye.z };
    double value = plane[3], size = 0;
    for (int i = 0; i < 3; i++)
        value += plane[i] * from[i];
    size = magnitude(value);
    for (int i = 0; i < 3; i++) {
        double term = plane[i] * ((plane[i] > 0 ? high[i] : low[i]) - from[i]);
        value += term;
        size += magnitude(term);
    }
    return value < -0x1p-20 * size;
}

bool lom_is_visible(const struct lom_culler *culler, const lom_box *box)
{
    return lom_box_visibility(&culler->frustum, *box) != LOM_OUTSIDE &&
           !is_behind_plane(culler->plane, culler->eye, box);
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
                        const struct lom_view_uniform *uniform, const struct lom_scene_view *view)
{
    lom_mat4 clip_from_offset = lom_clip_from_offset(&view->projection, &view->view);
    lom_mat4 offset_from_model = entity->world_from_model;
    offset_from_model.m[0][3] -= view->eye.x;
    offset_from_model.m[1][3] -= view->eye.y;
    offset_from_model.m[2][3] -= view->eye.z;
    lom_mat4 clip_from_model = lom_multiply(&clip_from_offset, &offset_from_model);
    struct lom_entity_uniforms uniforms = { .view = *uniform,
                                            .clip_from_model = lom_round_matrix(&clip_from_model),
                                            .offset_from_model = lom_round_matrix(&offset_from_model),
                                            .normal_from_model = lom_round_matrix(&entity->normal_from_model) };
    lom_draw_desc draw = { .shader = lom_entity_shader(renderer->scene->quality.shading),
                           .uniforms = &uniforms,
                           .cull = LOM_CULL_BACK,
                           .front_clockwise = view->mirrored != is_mirroring(&entity->world_from_model) };
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
    lom_mat4 clip_from_model = lom_multiply(clip_from_world, &entity->world_from_model);
    struct lom_caster_uniforms uniforms = { lom_round_matrix(&clip_from_model) };
    lom_draw_desc draw = { .shader = &lom_caster_shader, .uniforms = &uniforms, .count = entity->drawn->index_count };
    set_attributes(&draw, entity->drawn);
    lom_draw(renderer->device, &draw);
}

static struct lom_shadow_map_uniform shadow_uniform(const struct lom_entity_shadow *shadow, lom_vec3 eye)
{
    if (!shadow->falls)
        return (struct lom_shadow_map_uniform){ .map = NULL };
    const float size = (float)lom_texture_width(shadow->map);
    struct lom_shadow_map_uniform u = {
        .map = shadow->map, .size = size, .texel = 1 / size, .offset = (float)(2.5 * shadow->texel)
    };
    double s[4], t[4];
    for (int i = 0; i < 4; i++) {
        s[i] = shadow->clip_from_world.m[0][i] / 2 + (i == 3 ? 0.5 : 0);
        t[i] = -shadow->clip_from_world.m[1][i] / 2 + (i == 3 ? 0.5 : 0);
    }
    center_row(u.s, s, eye);
    center_row(u.t, t, eye);
    center_row(u.depth, shadow->clip_from_world.m[2], eye);
    return u;
}

static struct lom_caustics_uniform caustics_uniform(const struct lom_caustics *caustics, lom_vec3 eye)
{
    if (caustics->map == NULL)
        return (struct lom_caustics_uniform){ .map = NULL };
    return (struct lom_caustics_uniform){ .map = caustics->map,
                                          .corner = { (float)(caustics->corner[0] - eye.x),
                                                      (float)(caustics->corner[1] - eye.z) },
                                          .scale = (float)(1 / caustics->size),
                                          .level = (float)(caustics->level - eye.y),
                                          .strength = (float)caustics->strength,
                                          .fade = (float)(1 / caustics->fade),
                                          .lod_scale = (float)caustics->lod_scale };
}

static struct lom_view_uniform view_uniform(const lom_renderer *renderer, const struct lom_scene_view *view)
{
    lom_mat4 clip_from_offset = lom_clip_from_offset(&view->projection, &view->view);
    struct lom_view_uniform u = { .clip_from_offset = lom_round_matrix(&clip_from_offset),
                                  .light = lom_renderer_light(renderer, view->eye),
                                  .haze = lom_scene_haze(renderer->scene, view->eye.y, view->mirrored),
                                  .caustics = caustics_uniform(&view->caustics, view->eye) };
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++)
        u.entity_shadow[i] = shadow_uniform(&renderer->entity_shadows[i], view->eye);
    center_row(u.plane, view->plane, view->eye);
    return u;
}

void lom_draw_scene(lom_renderer *renderer, const struct lom_scene_view *view)
{
    const lom_scene *scene = renderer->scene;
    lom_mat4 clip_from_world = lom_multiply(&view->projection, &view->view);
    struct lom_view_uniform uniform = view_uniform(renderer, view);
    struct lom_culler culler = { lom_view_frustum(&clip_from_world, false), view->plane, view->eye };
    lom_draw_ground(renderer, &culler, &uniform, view->eye, view->mirrored);
    for (size_t i = 0; i < renderer->entity_count; i++)
        if (!renderer->entities[i].is_hidden && lom_is_visible(&culler, &renderer->entities[i].bounds))
            draw_entity(renderer, &renderer->entities[i], &uniform, view);
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
    struct lom_culler culler = { lom_view_frustum(&clip_from_world, false), view->plane, view->eye };
    for (int i = 0; i < ground->across * ground->down; i++)
        if (lom_is_visible(&culler, &ground->blocks[i].bounds))
            return true;
    for (size_t i = 0; i < renderer->entity_count; i++)
        if (!renderer->entities[i].is_hidden && lom_is_visible(&culler, &renderer->entities[i].bounds))
            return true;
    return false;
}
