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
    }
    return u;
}

struct lom_light_uniform lom_renderer_light(const lom_renderer *renderer)
{
    struct lom_light_uniform u = lom_scene_light(renderer->scene);
    const struct lom_ground_shadow *shadow = &renderer->ground_shadow;
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

static struct lom_matrix_uniform to_uniform(const lom_mat4 *m)
{
    struct lom_matrix_uniform u;
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            u.m[row][column] = (float)m->m[row][column];
    return u;
}

struct culler {
    lom_frustum frustum;
    const double *plane;
};

/* The highest value of the clip plane over the box; a margin covers rounding in float. */
static bool is_behind_plane(const double plane[4], const lom_box *box)
{
    double value = plane[3];
    value += plane[0] * (plane[0] > 0 ? box->high.x : box->low.x);
    value += plane[1] * (plane[1] > 0 ? box->high.y : box->low.y);
    value += plane[2] * (plane[2] > 0 ? box->high.z : box->low.z);
    return value < -1e-3;
}

static bool is_visible(const struct culler *culler, const lom_box *box)
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

static void set_scale(float scale[2], double tile, const double size[2])
{
    scale[0] = (float)(1 / (tile > 0 ? tile : size[0]));
    scale[1] = (float)(1 / (tile > 0 ? tile : size[1]));
}

/* Textures were loaded with the renderer: this only finds them. */
static const lom_texture *find_texture(lom_renderer *renderer, const char *path, bool color)
{
    return path == NULL ? NULL : lom_load_texture(renderer, path, color, NULL);
}

static struct lom_terrain_uniforms terrain_uniforms(lom_renderer *renderer, const struct lom_view_uniform *view)
{
    const lom_terrain *t = &renderer->scene->terrain;
    struct lom_terrain_uniforms u = { .view = *view,
                                      .detail_map = find_texture(renderer, t->detail_map, false),
                                      .normal_map = find_texture(renderer, t->normal_map, false),
                                      .layer_count = (int)t->layer_count };
    set_scale(u.scale, t->tile, t->size);
    set_scale(u.detail_scale, t->detail_tile, t->size);
    for (int i = 0; i < 3; i++) {
        u.material.ambient[i] = (float)t->material.ambient[i];
        u.material.diffuse[i] = (float)t->material.diffuse[i];
        u.material.specular[i] = (float)t->material.specular[i];
    }
    u.material.shininess = (float)t->material.shininess;
    u.material.texture = find_texture(renderer, t->texture, true);
    for (size_t i = 0; i < t->layer_count; i++) {
        const lom_terrain_layer *from = &t->layers[i];
        struct lom_layer_uniform *layer = &u.layer[i];
        *layer =
            (struct lom_layer_uniform){ .map = find_texture(renderer, from->map, true),
                                        .from_height = (float)from->from_height,
                                        .to_height = (float)from->to_height,
                                        .from_slope = (float)from->from_slope,
                                        .to_slope = (float)from->to_slope,
                                        .blend = from->blend > 1e-3 ? (float)from->blend : 1e-3f,
                                        .slope_blend = from->slope_blend > 1e-3 ? (float)from->slope_blend : 1e-3f };
        set_scale(layer->scale, from->tile, t->size);
    }
    return u;
}

static void draw_terrain(lom_renderer *renderer, const struct culler *culler, const struct lom_view_uniform *view,
                         bool mirrored)
{
    if (renderer->terrain == NULL)
        return;
    struct lom_terrain_uniforms uniforms = terrain_uniforms(renderer, view);
    lom_draw_desc draw = { .shader = lom_terrain_shader(renderer->scene->quality.shading),
                           .uniforms = &uniforms,
                           .cull = LOM_CULL_BACK,
                           .front_clockwise = mirrored };
    set_attributes(&draw, renderer->terrain);
    for (size_t i = 0; i < renderer->block_count; i++) {
        if (!is_visible(culler, &renderer->blocks[i].bounds))
            continue;
        draw.first = renderer->blocks[i].first;
        draw.count = renderer->blocks[i].count;
        lom_draw(renderer->device, &draw);
    }
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
                                            .world_from_model = to_uniform(&entity->world_from_model),
                                            .normal_from_model = to_uniform(&entity->normal_from_model) };
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

void lom_draw_scene(lom_renderer *renderer, const struct lom_scene_view *view)
{
    const lom_scene *scene = renderer->scene;
    lom_mat4 clip_from_world = lom_multiply(&view->projection, &view->view);
    struct lom_view_uniform uniform = { .clip_from_world = to_uniform(&clip_from_world),
                                        .light = lom_renderer_light(renderer),
                                        .eye = { (float)view->eye.x, (float)view->eye.y, (float)view->eye.z },
                                        .caustics = view->caustics };
    struct culler culler = { lom_view_frustum(&clip_from_world, false), view->plane };
    for (int i = 0; i < 4; i++)
        uniform.plane[i] = (float)view->plane[i];
    draw_terrain(renderer, &culler, &uniform, view->mirrored);
    for (size_t i = 0; i < renderer->entity_count; i++)
        if (is_visible(&culler, &renderer->entities[i].bounds))
            draw_entity(renderer, &renderer->entities[i], &uniform, view->mirrored);
    if (view->sky)
        lom_draw_sky(renderer->device, &scene->sky, renderer->sky, &view->projection, &view->view);
}

bool lom_shows_scene(const lom_renderer *renderer, const struct lom_scene_view *view)
{
    lom_mat4 clip_from_world = lom_multiply(&view->projection, &view->view);
    struct culler culler = { lom_view_frustum(&clip_from_world, false), view->plane };
    for (size_t i = 0; renderer->terrain != NULL && i < renderer->block_count; i++)
        if (is_visible(&culler, &renderer->blocks[i].bounds))
            return true;
    for (size_t i = 0; i < renderer->entity_count; i++)
        if (is_visible(&culler, &renderer->entities[i].bounds))
            return true;
    return false;
}
