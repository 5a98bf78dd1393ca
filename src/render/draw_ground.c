/* Terrain in a pass. In: how the pass looks at it and what the frame chose (ground.h). Out: a draw for each block in
 * view, near ones first, so that they hide the ones behind before these are shaded. */
#include "render/renderer.h"

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

void lom_ground_scale(const struct lom_ground *ground, const double size[2], float scale[2])
{
    double columns = ground->columns, rows = ground->rows;
    scale[0] = (float)(columns / (size[0] * (columns + 1)));
    scale[1] = (float)(rows / (size[1] * (rows + 1)));
}

static struct lom_terrain_uniforms terrain_uniforms(lom_renderer *renderer, const struct lom_view_uniform *view)
{
    const lom_terrain *t = &renderer->scene->terrain;
    struct lom_terrain_uniforms u = { .view = *view,
                                      .surface = renderer->ground.surface,
                                      .detail_map = find_texture(renderer, t->detail_map, false),
                                      .normal_map = find_texture(renderer, t->normal_map, false),
                                      .layer_count = (int)t->layer_count };
    lom_ground_scale(&renderer->ground, t->size, u.surface_scale);
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
        *layer = (struct lom_layer_uniform){ .map = find_texture(renderer, from->map, true),
                                             .from_height = (float)from->from_height,
                                             .to_height = (float)from->to_height,
                                             .from_slope = (float)from->from_slope,
                                             .to_slope = (float)from->to_slope,
                                             .blend = from->blend > 1e-3 ? (float)from->blend : 1e-3f,
                                             .slope_blend = from->slope_blend > 1e-3 ? (float)from->slope_blend : 1e-3f,
                                             .grain = (float)from->grain / renderer->brightness_below[i],
                                             .grain_offset = (float)from->grain,
                                             .triplanar = from->mapping == LOM_MAPPING_TRIPLANAR };
        set_scale(layer->scale, from->tile, t->size);
    }
    return u;
}

void lom_draw_ground(lom_renderer *renderer, const struct lom_culler *culler, const struct lom_view_uniform *view,
                     bool mirrored)
{
    const struct lom_ground *ground = &renderer->ground;
    if (ground->blocks == NULL)
        return;
    struct lom_terrain_uniforms uniforms = terrain_uniforms(renderer, view);
    lom_draw_desc draw = { .shader = lom_terrain_shader(renderer->scene->quality.shading),
                           .uniforms = &uniforms,
                           .cull = LOM_CULL_BACK,
                           .front_clockwise = mirrored };
    for (int i = 0; i < ground->across * ground->down; i++) {
        uint32_t number = ground->order[i];
        const struct lom_ground_block *block = &ground->blocks[number];
        const struct lom_ground_pattern *pattern = &ground->patterns[ground->pattern[number]];
        if (!lom_is_visible(culler, &block->bounds))
            continue;
        size_t first = block->first[ground->level[number]];
        size_t vertices = (size_t)(pattern->columns + 1) * (size_t)(pattern->rows + 1);
        draw.attribute[0] = (lom_attribute){ ground->position + first, vertices * sizeof *ground->position,
                                             sizeof *ground->position, LOM_ATTRIBUTE_FLOAT3 };
        draw.indices = pattern->indices;
        draw.count = pattern->count;
        lom_draw(renderer->device, &draw);
    }
}
