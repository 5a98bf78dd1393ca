/* Entities in a pass. In: how the pass looks at them. Out: a draw for each part of those in view; their depth as the
 * sun sees them. Compiled for speed. */
#include "render/entities/shaders.h"
#include "render/renderer.h"

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

static const lom_shader *const shaders[] = { [LOM_SHADING_PHONG] = &lom_entity_phong,
                                             [LOM_SHADING_GOURAUD] = &lom_entity_gouraud,
                                             [LOM_SHADING_FLAT] = &lom_entity_flat };

static const lom_shader *shader_of(const lom_renderer *renderer, const struct lom_material_uniform *material)
{
    const lom_shading shading = renderer->scene->quality.shading;
    return shading == LOM_SHADING_PHONG && material->normal_map != NULL ? &lom_entity_bumped : shaders[shading];
}

static void draw_parts(lom_renderer *renderer, const struct lom_drawn_entity *entity,
                       const struct lom_material_uniform *materials, lom_draw_desc *draw,
                       struct lom_entity_uniforms *uniforms)
{
    for (size_t i = 0; i < entity->source->mesh->part_count; i++) {
        uniforms->material = materials[i];
        draw->shader = shader_of(renderer, &materials[i]);
        draw->first = entity->source->parts[i].first;
        draw->count = entity->source->parts[i].count;
        lom_draw(renderer->device, draw);
    }
}

/* A back has the front's normals, the other way. */
static void turn_normals(struct lom_matrix_uniform *normal_from_model)
{
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            normal_from_model->m[i][k] = -normal_from_model->m[i][k];
}

static void draw_entity(lom_renderer *renderer, const struct lom_drawn_entity *entity,
                        const struct lom_scene_view *view, const struct lom_view_uniform *uniform)
{
    lom_mat4 clip_from_offset = lom_clip_from_offset(&view->projection, &view->view);
    lom_mat4 offset_from_model = entity->at->world_from_model;
    offset_from_model.m[0][3] -= view->eye.x;
    offset_from_model.m[1][3] -= view->eye.y;
    offset_from_model.m[2][3] -= view->eye.z;
    lom_mat4 clip_from_model = lom_multiply(&clip_from_offset, &offset_from_model);
    struct lom_entity_uniforms uniforms = { .view = *uniform,
                                            .clip_from_model = lom_round_matrix(&clip_from_model),
                                            .offset_from_model = lom_round_matrix(&offset_from_model),
                                            .normal_from_model = lom_round_matrix(&entity->at->normal_from_model) };
    lom_draw_desc draw = { .uniforms = &uniforms,
                           .cull = LOM_CULL_BACK,
                           .label = entity->source->entity->mesh,
                           .object = LOM_OBJECT_ENTITY + (int)(entity - renderer->entities.items),
                           .front_clockwise = view->mirrored != is_mirroring(&entity->at->world_from_model) };
    set_attributes(&draw, entity->source->mesh);
    draw_parts(renderer, entity, entity->materials, &draw, &uniforms);
    if (entity->backs == NULL)
        return;
    draw.cull = LOM_CULL_FRONT;
    turn_normals(&uniforms.normal_from_model);
    draw_parts(renderer, entity, entity->backs, &draw, &uniforms);
}

void lom_draw_caster(lom_renderer *renderer, const struct lom_drawn_entity *entity, const lom_mat4 *clip_from_world)
{
    lom_mat4 clip_from_model = lom_multiply(clip_from_world, &entity->at->world_from_model);
    struct lom_caster_uniforms uniforms = { lom_round_matrix(&clip_from_model) };
    lom_draw_desc draw = { .shader = &lom_caster_shader,
                           .uniforms = &uniforms,
                           .count = entity->source->mesh->index_count,
                           .label = entity->source->entity->mesh };
    set_attributes(&draw, entity->source->mesh);
    lom_draw(renderer->device, &draw);
}

struct lom_shadow_map_uniform lom_entity_shadow_uniform(const struct lom_entity_shadow *shadow, lom_vec3 eye)
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
    lom_center_row(u.s, s, eye);
    lom_center_row(u.t, t, eye);
    lom_center_row(u.depth, shadow->clip_from_world.m[2], eye);
    return u;
}

static bool is_shown(const struct lom_drawn_entity *entity, const struct lom_culler *culler)
{
    return !entity->source->is_hidden && lom_is_visible(culler, &entity->at->bounds);
}

void lom_draw_entities(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_culler *culler,
                       const struct lom_view_uniform *uniform)
{
    for (size_t i = 0; i < renderer->entities.count; i++)
        if (is_shown(&renderer->entities.items[i], culler))
            draw_entity(renderer, &renderer->entities.items[i], view, uniform);
}

bool lom_shows_entities(const lom_renderer *renderer, const struct lom_culler *culler)
{
    for (size_t i = 0; i < renderer->entities.count; i++)
        if (is_shown(&renderer->entities.items[i], culler))
            return true;
    return false;
}
