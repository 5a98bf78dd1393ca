/* Terrain in a pass. In: how the pass looks at it and what the frame chose (ground.h). Out: a draw for each block in
 * view, near ones first, so that they hide the ones behind before these are shaded. Compiled for speed. */
#include "pipeline/draw_again.h"
#include "render/ground/shaders.h"
#include "render/renderer.h"

static double fraction(double x)
{
    return x - lom_double_floor(x);
}

/* A map that is laid from the middle of the terrain's base on, `tile` metres a repetition (0: once over it all). */
static struct lom_laid_uniform lay(const lom_texture *map, double tile, const double size[2], const double eye[3])
{
    static const int axis[LOM_SIDES][2] = { { 2, 1 }, { 0, 2 }, { 0, 1 } };
    struct lom_laid_uniform laid = { .map = map };
    for (int side = 0; side < LOM_SIDES; side++)
        for (int k = 0; k < 2; k++) {
            double scale = (axis[side][k] == 1 ? -1 : 1) / (tile > 0 ? tile : size[k]);
            laid.scale[side][k] = (float)scale;
            laid.shift[side][k] = (float)fraction(eye[axis[side][k]] * scale);
        }
    return laid;
}

void lom_map_ground(const struct lom_ground *ground, const double size[2], lom_vec3 eye, float scale[2], float shift[2])
{
    const double quads[2] = { ground->columns, ground->rows }, at[2] = { eye.x, eye.z };
    for (int i = 0; i < 2; i++) {
        double exact = quads[i] / (size[i] * (quads[i] + 1));
        scale[i] = (float)exact;
        shift[i] = (float)(0.5 + at[i] * exact);
    }
}

/* A bound that lies so little beyond a height that this is a step: 1 / it is a float. */
static const double least_blend = 1e-30;

static struct lom_layer_uniform layer_uniform(const lom_renderer *renderer, size_t number, const double eye[3])
{
    const lom_terrain *t = &renderer->scene->terrain;
    const lom_terrain_layer *from = &t->layers[number];
    const double height = t->base + eye[1];
    return (struct lom_layer_uniform){ .laid = lay(renderer->ground_maps.layer[number], from->tile, t->size, eye),
                                       .from_height = (float)(from->from_height - height),
                                       .to_height = (float)(from->to_height - height),
                                       .from_slope = (float)from->from_slope,
                                       .to_slope = (float)from->to_slope,
                                       .blend = (float)(from->blend > least_blend ? from->blend : least_blend),
                                       .slope_blend = from->slope_blend > 1e-3 ? (float)from->slope_blend : 1e-3f,
                                       .grain = (float)from->grain / renderer->ground_maps.brightness_below[number],
                                       .grain_offset = (float)from->grain,
                                       .triplanar = from->mapping == LOM_MAPPING_TRIPLANAR };
}

/* The picture of all layers lies once over the terrain; a texel that is `pixels` wide is 2^-level of them. */
static void set_composed(struct lom_terrain_uniforms *u, const lom_renderer *renderer, const double eye[3])
{
    const double pixels = renderer->scene->quality.terrain_composite, *size = renderer->scene->terrain.size;
    if (renderer->ground.composed == NULL || !(pixels > 0))
        return;
    u->composed.map = renderer->ground.composed;
    u->composed_level = (float)(-lom_double_log(pixels) / lom_double_log(2));
    for (int k = 0; k < 2; k++) {
        u->composed.scale[LOM_SIDE_ABOVE][k] = (float)(1 / size[k]);
        u->composed.shift[LOM_SIDE_ABOVE][k] = (float)(0.5 + eye[2 * k] / size[k]);
    }
}

static struct lom_cut_uniform cut_uniform(const struct lom_ground *ground, const lom_terrain *t)
{
    return (struct lom_cut_uniform){
        .heights = ground->heights,
        .columns = ground->columns,
        .rows = ground->rows,
        .step = { (float)(t->size[0] / ground->columns), (float)(t->size[1] / ground->rows) },
        .corner = { (float)(-t->size[0] / 2), (float)(-t->size[1] / 2) },
        .eye = { (float)ground->eye.x, (float)(ground->eye.y - t->base), (float)ground->eye.z },
        .parallel = ground->parallel,
        .scale = (float)(ground->errors_allowed < 1e30 ? ground->errors_allowed : 1e30)
    };
}

struct lom_terrain_uniforms lom_terrain_uniforms_of(const lom_renderer *renderer, const struct lom_view_uniform *view,
                                                    lom_vec3 place)
{
    const lom_terrain *t = &renderer->scene->terrain;
    const double eye[3] = { place.x, place.y - t->base, place.z };
    struct lom_terrain_uniforms u = { .view = *view,
                                      .vertex_texture = renderer->ground.vertex_texture,
                                      .base = lay(renderer->ground_maps.base, t->tile, t->size, eye),
                                      .detail = lay(renderer->ground_maps.detail, t->detail_tile, t->size, eye),
                                      .normals = lay(renderer->ground_maps.normals, t->detail_tile, t->size, eye),
                                      .layer_count = (int)t->layer_count };
    lom_map_ground(&renderer->ground, t->size, place, u.vertex_scale, u.vertex_shift);
    for (int i = 0; i < 3; i++) {
        u.eye[i] = (float)eye[i];
        u.eye_rest[i] = (float)(eye[i] - (double)u.eye[i]);
        u.material.ambient[i] = (float)t->material.ambient[i];
        u.material.diffuse[i] = (float)t->material.diffuse[i];
        u.material.specular[i] = (float)t->material.specular[i];
    }
    u.material.shininess = (float)t->material.shininess;
    for (size_t i = 0; i < t->layer_count; i++)
        u.layer[i] = layer_uniform(renderer, i, eye);
    set_composed(&u, renderer, eye);
    if (renderer->ground.knot != NULL)
        u.cut = cut_uniform(&renderer->ground, t);
    return u;
}

static const lom_shader *const shaders[] = { [LOM_SHADING_PHONG] = &lom_terrain_phong,
                                             [LOM_SHADING_GOURAUD] = &lom_terrain_gouraud,
                                             [LOM_SHADING_FLAT] = &lom_terrain_flat };

void lom_take_ground(const struct lom_ground *ground, lom_draw_desc *draw)
{
    draw->attribute[0] = (lom_attribute){ ground->position, ground->position_count * sizeof *ground->position,
                                          sizeof *ground->position, LOM_ATTRIBUTE_FLOAT3 };
    draw->indices = ground->indices;
    draw->count = ground->index_count;
}

const struct lom_ground_pattern *lom_find_ground_draw(const struct lom_ground *ground, int i, lom_draw_desc *draw,
                                                      uint32_t *number)
{
    *number = ground->order[i];
    const struct lom_ground_block *block = &ground->blocks[*number];
    const struct lom_ground_pattern *pattern = &ground->patterns[ground->pattern[*number]];
    if (!ground->seen[*number])
        return NULL;
    draw->base_vertex = (int32_t)block->first[ground->level[*number]];
    draw->first = pattern->first;
    draw->count = pattern->count;
    return pattern;
}

static const lom_shader *const cut_shaders[] = { [LOM_SHADING_PHONG] = &lom_terrain_cut_phong,
                                                 [LOM_SHADING_GOURAUD] = &lom_terrain_cut_gouraud,
                                                 [LOM_SHADING_FLAT] = &lom_terrain_cut_flat };

/* All patches in place of triangles. */
static void take_patches(const struct lom_ground *ground, lom_draw_desc *draw)
{
    draw->attribute[0] = (lom_attribute){ ground->knot, ground->knot_count * sizeof *ground->knot, sizeof *ground->knot,
                                          LOM_ATTRIBUTE_FLOAT4 };
    draw->indices = ground->patch_corner;
    draw->count = ground->patch_corner_count;
    draw->topology = LOM_PATCHES;
    draw->patch_points = 4;
}

void lom_draw_ground_blocks(const lom_renderer *renderer, const struct lom_culler *culler, const lom_draw_desc *desc)
{
    const struct lom_ground *ground = &renderer->ground;
    const bool cut = desc->tessellation != NULL;
    lom_draw_desc draw = *desc;
    struct lom_held_draw held;
    (cut ? take_patches : lom_take_ground)(ground, &draw);
    lom_hold_draw(renderer->device, &draw, &held);
    for (int i = 0, left = lom_see_ground(ground, culler, LOM_EVERYWHERE); left > 0; i++) {
        uint32_t number;
        if (lom_find_ground_draw(ground, i, &draw, &number) == NULL)
            continue;
        left--;
        if (cut) {
            draw.first = ground->blocks[number].first_corner;
            draw.count = ground->blocks[number].corners;
            draw.base_vertex = 0;
        }
        lom_draw_held(renderer->device, &held, &draw);
    }
}

void lom_draw_ground(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_culler *culler,
                     const struct lom_view_uniform *uniform)
{
    if (renderer->ground.blocks == NULL)
        return;
    struct lom_terrain_uniforms uniforms = lom_terrain_uniforms_of(renderer, uniform, view->eye);
    const lom_shading shading = renderer->scene->quality.shading;
    const bool cut = renderer->ground.knot != NULL;
    const lom_tessellation *patches = shading == LOM_SHADING_GOURAUD ? &lom_terrain_lit_patches : &lom_terrain_patches;
    lom_draw_ground_blocks(renderer, culler,
                           &(lom_draw_desc){ .shader = cut ? cut_shaders[shading] : shaders[shading],
                                             .tessellation = cut ? patches : NULL,
                                             .uniforms = &uniforms,
                                             .cull = LOM_CULL_BACK,
                                             .label = "terrain",
                                             .object = LOM_OBJECT_TERRAIN,
                                             .front_clockwise = view->mirrored });
}

void lom_draw_cut_wires(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_culler *culler,
                        const lom_draw_desc *how, const float color[3])
{
    const lom_mat4 clip_from_offset = lom_clip_from_offset(&view->projection, &view->view);
    const struct lom_view_uniform places = { .clip_from_offset = lom_round_matrix(&clip_from_offset) };
    struct lom_cut_wire_uniforms wire = { .terrain = lom_terrain_uniforms_of(renderer, &places, view->eye) };
    lom_draw_desc draw = *how;
    if (color != NULL)
        memcpy(wire.color, color, sizeof wire.color);
    draw.uniforms = &wire;
    draw.shader = color != NULL ? &lom_cut_wire_shader : &lom_cut_wire_surface_shader;
    draw.tessellation = &lom_terrain_patches;
    draw.geometry = color != NULL ? &lom_triangle_edges : NULL;
    lom_draw_ground_blocks(renderer, culler, &draw);
}

/* Terrain's shadows are as sharp as the vertices that throw them tell: the edge is as high as a part of the way between
 * two of them, half a metre where these are 1.6 m apart. */
static const double shadow_edge = 0.3125;

void lom_set_ground_light(struct lom_light_uniform *u, const lom_renderer *renderer, lom_vec3 eye)
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
