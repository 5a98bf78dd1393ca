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
bool lom_is_mirroring(const lom_mat4 *m)
{
    const double(*r)[4] = m->m;
    double determinant = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                         r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                         r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    return determinant < 0;
}

/* A line along the normal of each vertex. */
static void draw_normals(lom_renderer *renderer, const struct lom_drawn_entity *entity,
                         const struct lom_scene_view *view, const struct lom_entity_uniforms *drawn)
{
    lom_mat4 clip_from_offset = lom_clip_from_offset(&view->projection, &view->view);
    struct lom_normal_uniforms uniforms = { .clip_from_offset = lom_round_matrix(&clip_from_offset),
                                            .offset_from_model = drawn->offset_from_model,
                                            .normal_from_model = drawn->normal_from_model,
                                            .length = (float)renderer->scene->quality.normals };
    memcpy(uniforms.plane, drawn->view.plane, sizeof uniforms.plane);
    lom_draw_desc draw = { .shader = &lom_normal_shader,
                           .uniforms = &uniforms,
                           .count = entity->source->mesh->vertex_count,
                           .topology = LOM_POINTS,
                           .geometry = &lom_normal_lines,
                           .label = "normals" };
    set_attributes(&draw, entity->source->mesh);
    draw.indices = NULL;
    lom_draw(renderer->device, &draw);
}

static const lom_shader *const shaders[] = { [LOM_SHADING_PHONG] = &lom_entity_phong,
                                             [LOM_SHADING_GOURAUD] = &lom_entity_gouraud,
                                             [LOM_SHADING_FLAT] = &lom_entity_flat };

static const lom_shader *shader_of(const lom_renderer *renderer, const struct lom_material_uniform *material)
{
    const lom_shading shading = renderer->scene->quality.shading;
    return shading == LOM_SHADING_PHONG && material->normal_map != NULL ? &lom_entity_bumped : shaders[shading];
}

struct parts {
    lom_renderer *renderer;
    const struct lom_drawn_entity *entity;
    struct lom_entity_uniforms *uniforms;
};

/* The parts from `first` on, of the draw's topology; the shader of triangles is their materials'. */
static void draw_parts(const struct parts *p, const struct lom_material_uniform *materials, lom_draw_desc *draw,
                       size_t first, size_t count)
{
    for (size_t i = first; i < first + count; i++) {
        if (draw->topology == LOM_TRIANGLES &&
            lom_is_transparent(&p->entity->source->parts[i], p->entity->source->entity))
            continue;
        p->uniforms->material = materials[i];
        if (draw->topology == LOM_TRIANGLES)
            draw->shader = shader_of(p->renderer, &materials[i]);
        draw->first = p->entity->source->parts[i].first;
        draw->count = p->entity->source->parts[i].count;
        lom_draw(p->renderer->device, draw);
    }
}

/* A face alone has a flat normal. pixels: of the pass, a pixel of the picture. */
static void draw_lines_and_points(const struct parts *p, lom_draw_desc draw, double pixels)
{
    const lom_entity *entity = p->entity->source->entity;
    const lom_mesh *mesh = p->entity->source->mesh;
    const lom_shading shading = p->renderer->scene->quality.shading;
    const double size = entity->point_size * pixels;
    const int width = lom_int_of(entity->line_width * pixels + 0.5);
    draw.topology = LOM_LINES;
    draw.line_width = width < 1 ? 1 : width;
    draw.shader = shading == LOM_SHADING_FLAT ? &lom_entity_phong : shaders[shading];
    draw_parts(p, p->entity->materials, &draw, mesh->part_count, mesh->line_part_count);
    draw.topology = LOM_POINTS;
    draw.shader = size < 2 ? &lom_entity_point : &lom_entity_disc;
    p->uniforms->point_size = (float)size;
    draw_parts(p, p->entity->materials, &draw, mesh->part_count + mesh->line_part_count, mesh->point_part_count);
}

/* A back has the front's normals, the other way. */
static void turn_normals(struct lom_matrix_uniform *normal_from_model)
{
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            normal_from_model->m[i][k] = -normal_from_model->m[i][k];
}

lom_draw_desc lom_begin_entity(const lom_renderer *renderer, const struct lom_drawn_entity *entity,
                               const struct lom_scene_view *view, const struct lom_view_uniform *uniform,
                               struct lom_entity_uniforms *uniforms)
{
    lom_mat4 clip_from_offset = lom_clip_from_offset(&view->projection, &view->view);
    lom_mat4 offset_from_model = entity->at->world_from_model;
    offset_from_model.m[0][3] -= view->eye.x;
    offset_from_model.m[1][3] -= view->eye.y;
    offset_from_model.m[2][3] -= view->eye.z;
    lom_mat4 clip_from_model = lom_multiply(&clip_from_offset, &offset_from_model);
    *uniforms = (struct lom_entity_uniforms){ .view = *uniform,
                                              .clip_from_model = lom_round_matrix(&clip_from_model),
                                              .offset_from_model = lom_round_matrix(&offset_from_model),
                                              .normal_from_model = lom_round_matrix(&entity->at->normal_from_model) };
    lom_draw_desc draw = { .uniforms = uniforms,
                           .cull = LOM_CULL_BACK,
                           .label = entity->source->entity->mesh,
                           .object = LOM_OBJECT_ENTITY + (int)(entity - renderer->entities.items),
                           .front_clockwise = view->mirrored != lom_is_mirroring(&entity->at->world_from_model) };
    set_attributes(&draw, entity->source->mesh);
    return draw;
}

static void draw_entity(lom_renderer *renderer, const struct lom_drawn_entity *entity,
                        const struct lom_scene_view *view, const struct lom_view_uniform *uniform)
{
    struct lom_entity_uniforms uniforms;
    lom_draw_desc draw = lom_begin_entity(renderer, entity, view, uniform, &uniforms);
    uniforms.cuts = draw.alpha_to_coverage = entity->source->entity->alpha_to_coverage;
    const struct parts p = { renderer, entity, &uniforms };
    const lom_mesh *mesh = entity->source->mesh;
    draw_parts(&p, entity->materials, &draw, 0, mesh->part_count);
    if (mesh->line_part_count != 0 || mesh->point_part_count != 0)
        draw_lines_and_points(&p, draw, view->pixels);
    if (renderer->scene->quality.normals > 0)
        draw_normals(renderer, entity, view, &uniforms);
    if (entity->backs == NULL)
        return;
    draw.cull = LOM_CULL_FRONT;
    turn_normals(&uniforms.normal_from_model);
    draw_parts(&p, entity->backs, &draw, 0, mesh->part_count);
}

/* The caster where its textures say that it is. */
static void draw_cut_caster(lom_renderer *renderer, const struct lom_drawn_entity *entity,
                            const lom_mat4 *clip_from_model)
{
    const lom_mesh *mesh = entity->source->mesh;
    const struct lom_caster_uniforms whole = { lom_round_matrix(clip_from_model) };
    for (size_t i = 0; i < mesh->part_count; i++) {
        if (lom_is_transparent(&entity->source->parts[i], entity->source->entity))
            continue;
        const struct lom_cut_caster_uniforms cut = { whole.clip_from_model, entity->materials[i].texture };
        lom_draw_desc draw = { .shader = cut.texture != NULL ? &lom_cut_caster_shader : &lom_caster_shader,
                               .uniforms = cut.texture != NULL ? (const void *)&cut : &whole,
                               .first = entity->source->parts[i].first,
                               .count = entity->source->parts[i].count,
                               .label = entity->source->entity->mesh };
        set_attributes(&draw, mesh);
        lom_draw(renderer->device, &draw);
    }
}

void lom_draw_caster(lom_renderer *renderer, const struct lom_drawn_entity *entity, const lom_mat4 *clip_from_world)
{
    lom_mat4 clip_from_model = lom_multiply(clip_from_world, &entity->at->world_from_model);
    if (entity->source->entity->alpha_to_coverage) {
        draw_cut_caster(renderer, entity, &clip_from_model);
        return;
    }
    struct lom_caster_uniforms uniforms = { lom_round_matrix(&clip_from_model) };
    lom_draw_desc draw = { .shader = &lom_caster_shader,
                           .uniforms = &uniforms,
                           .count = entity->source->mesh->index_count,
                           .label = entity->source->entity->mesh };
    set_attributes(&draw, entity->source->mesh);
    if (entity->transparent.count == 0)
        lom_draw(renderer->device, &draw);
    for (size_t i = 0; entity->transparent.count != 0 && i < entity->source->mesh->part_count; i++) {
        draw.first = entity->source->parts[i].first;
        draw.count = entity->source->parts[i].count;
        if (!lom_is_transparent(&entity->source->parts[i], entity->source->entity))
            lom_draw(renderer->device, &draw);
    }
}

static struct lom_shadow_map_uniform map_uniform(const struct lom_entity_shadow *shadow, lom_vec3 eye)
{
    const float size = (float)lom_texture_width(shadow->map);
    struct lom_shadow_map_uniform u = { .map = shadow->map,
                                        .near = { shadow->near.around, shadow->near.columns, shadow->near.rows },
                                        .size = size,
                                        .texel = 1 / size,
                                        .offset = (float)(2.5 * shadow->at.texel) };
    lom_set_sun_map_rows(&shadow->at, eye, u.s, u.t, u.depth);
    return u;
}

struct lom_sun_shadow_uniform lom_entity_shadow_uniform(const struct lom_drawn_entities *entities, lom_vec3 eye)
{
    struct lom_sun_shadow_uniform u = { .count = 0 };
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++)
        if (entities->shadows[i].falls)
            u.map[u.count++] = map_uniform(&entities->shadows[i], eye);
    u.cascaded = entities->cascaded;
    return u;
}

/* Wide lines and points reach out of the bounds of their vertices. */
bool lom_shows_entity(const struct lom_drawn_entity *entity, const struct lom_culler *culler)
{
    const lom_mesh *mesh = entity->source->mesh;
    const bool is_wide = mesh->line_part_count != 0 || mesh->point_part_count != 0;
    return !entity->source->is_hidden && (is_wide || lom_is_visible(culler, &entity->at->bounds));
}

void lom_draw_entities(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_culler *culler,
                       const struct lom_view_uniform *uniform)
{
    for (size_t i = 0; i < renderer->entities.count; i++)
        if (lom_shows_entity(&renderer->entities.items[i], culler))
            draw_entity(renderer, &renderer->entities.items[i], view, uniform);
}

bool lom_shows_entities(const lom_renderer *renderer, const struct lom_culler *culler)
{
    for (size_t i = 0; i < renderer->entities.count; i++)
        if (lom_shows_entity(&renderer->entities.items[i], culler))
            return true;
    return false;
}
