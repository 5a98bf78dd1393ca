/* The frames of the workloads. In: what workload.c made; out: passes and draws on a device. Invariant: states, clears
 * and uniforms are those of bench/peers/README.md, in its order. */
#include "workload.h"

#include "peer_shaders.h"

#include <string.h>

static lom_attribute attribute(const lom_peer_mesh *mesh, int index)
{
    static const struct {
        size_t offset;
        lom_attribute_kind kind;
    } members[] = { { offsetof(lom_peer_vertex, position), LOM_ATTRIBUTE_FLOAT3 },
                    { offsetof(lom_peer_vertex, normal), LOM_ATTRIBUTE_FLOAT3 },
                    { offsetof(lom_peer_vertex, uv), LOM_ATTRIBUTE_FLOAT2 } };
    return (lom_attribute){ .data = (const char *)mesh->vertices + members[index].offset,
                            .size = mesh->vertex_count * sizeof(lom_peer_vertex) - members[index].offset,
                            .stride = sizeof(lom_peer_vertex),
                            .kind = members[index].kind };
}

lom_draw_desc lom_workload_mesh_draw(const lom_shader *shader, const lom_peer_mesh *mesh, int attributes,
                                     const void *uniforms)
{
    lom_draw_desc draw = { .shader = shader,
                           .uniforms = uniforms,
                           .indices = mesh->indices,
                           .index_bits = 32,
                           .count = mesh->index_count,
                           .cull = LOM_CULL_BACK };
    for (int i = 0; i < attributes; i++)
        draw.attribute[i] = attribute(mesh, i);
    return draw;
}

void lom_begin_workload_pass(lom_workload *w, lom_device *device, int target, float r, float g, float b)
{
    lom_begin_pass(device, &(lom_pass_desc){ .color = { w->color[target] },
                                             .depth = w->depth[target],
                                             .samples = w->samples,
                                             .clip_range = LOM_CLIP_MINUS_W_TO_W,
                                             .clear_color = { { r, g, b, 1 } },
                                             .clear_depth = 1 });
}

void lom_draw_clear(lom_workload *w, lom_device *device)
{
    lom_begin_workload_pass(w, device, LOM_MAIN, 0.1f, 0.2f, 0.3f);
    lom_end_pass(device);
}

const lom_blend lom_straight_alpha = { .enabled = true,
                                       .source_color = LOM_FACTOR_SOURCE_ALPHA,
                                       .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                       .source_alpha = LOM_FACTOR_SOURCE_ALPHA,
                                       .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };
static const lom_blend multiplied_alpha = { .enabled = true,
                                            .source_color = LOM_FACTOR_ONE,
                                            .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                            .source_alpha = LOM_FACTOR_ONE,
                                            .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };

static void draw_layers(lom_workload *w, lom_device *device, lom_blend blend, float alpha)
{
    lom_begin_workload_pass(w, device, LOM_MAIN, 0.1f, 0.2f, 0.3f);
    for (int i = 0; i < 8; i++) {
        lom_peer_flat flat = { .z = -0.9f + 0.2f * (float)i,
                               .color = { (float)(i + 1) / 8.0f, 1 - (float)i / 8.0f, 0.5f, alpha } };
        lom_draw(device, &(lom_draw_desc){ .shader = &lom_peer_flat_shader,
                                           .uniforms = &flat,
                                           .count = 4,
                                           .vertex_count = 4,
                                           .topology = LOM_TRIANGLE_STRIP,
                                           .depth_test_off = true,
                                           .blend = { blend } });
    }
    lom_end_pass(device);
}

void lom_draw_fill(lom_workload *w, lom_device *device)
{
    draw_layers(w, device, (lom_blend){ .enabled = false }, 1);
}

void lom_draw_blend(lom_workload *w, lom_device *device)
{
    draw_layers(w, device, lom_straight_alpha, 0.25f);
}

void lom_draw_depth(lom_workload *w, lom_device *device)
{
    lom_peer_depth uniforms;
    memcpy(uniforms.to_clip, w->to_clip.m, sizeof uniforms.to_clip);
    lom_begin_pass(device, &(lom_pass_desc){ .depth = w->depth[LOM_MAIN],
                                             .samples = w->samples,
                                             .clip_range = LOM_CLIP_MINUS_W_TO_W,
                                             .clear_depth = 1 });
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_depth_shader, &w->torus, 1, &uniforms);
    draw.depth_compare = LOM_COMPARE_LESS;
    lom_draw(device, &draw);
    lom_end_pass(device);
}

void lom_show_depth(lom_workload *w, lom_device *device)
{
    lom_peer_show show = { .depth = w->depth[LOM_MAIN] };
    lom_begin_pass(device, &(lom_pass_desc){ .color = { w->color[LOM_MAIN] }, .clip_range = LOM_CLIP_MINUS_W_TO_W });
    lom_draw(device, &(lom_draw_desc){ .shader = &lom_peer_show_shader,
                                       .uniforms = &show,
                                       .count = 4,
                                       .vertex_count = 4,
                                       .topology = LOM_TRIANGLE_STRIP,
                                       .depth_test_off = true });
    lom_end_pass(device);
}

void lom_draw_mesh(lom_workload *w, lom_device *device)
{
    lom_peer_lit lit;
    memcpy(lit.to_clip, w->to_clip.m, sizeof lit.to_clip);
    memcpy(lit.eye, w->kind->view->eye, sizeof lit.eye);
    memcpy(lit.light, w->light, sizeof lit.light);
    lom_begin_workload_pass(w, device, LOM_MAIN, 0.1f, 0.1f, 0.15f);
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_lit_shader, &w->torus, 2, &lit);
    draw.depth_compare = LOM_COMPARE_LESS;
    lom_draw(device, &draw);
    lom_end_pass(device);
}

/* The terrain, cut where up * y + offset < 0; up = 0: all of it. */
static void draw_ground(lom_workload *w, lom_device *device, bool mirrored, float up, float offset, lom_compare compare)
{
    lom_peer_ground ground = { .albedo = w->albedo, .normals = w->normals, .clip = { 0, up, 0, offset } };
    const float *eye = w->kind->view->eye;
    memcpy(ground.to_clip, mirrored ? w->mirrored_to_clip.m : w->to_clip.m, sizeof ground.to_clip);
    memcpy(ground.eye, (float[3]){ eye[0], mirrored ? -eye[1] : eye[1], eye[2] }, sizeof ground.eye);
    memcpy(ground.light, w->light, sizeof ground.light);
    const lom_shader *shader = up != 0 ? &lom_peer_clipped_ground_shader : &lom_peer_ground_shader;
    lom_draw_desc draw = lom_workload_mesh_draw(shader, &w->terrain, 3, &ground);
    draw.depth_compare = compare;
    draw.front_clockwise = mirrored;
    draw.culling.clusters = w->terrain.clusters;
    for (int i = 0; i < 16; i++)
        draw.culling.clip_from_position.m[i % 4][i / 4] = ground.to_clip[i];
    memcpy(draw.culling.distance, ground.clip, sizeof draw.culling.distance);
    lom_draw(device, &draw);
}

/* The sky is seen from the inside of its cube. */
static void draw_sky(lom_workload *w, lom_device *device, bool mirrored)
{
    lom_peer_dome dome = { .cube = w->sky };
    memcpy(dome.to_clip, mirrored ? w->mirrored_to_clip.m : w->to_clip.m, sizeof dome.to_clip);
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_dome_shader, &w->cube, 1, &dome);
    draw.depth_compare = LOM_COMPARE_LESS_EQUAL;
    draw.cull = LOM_CULL_NONE;
    draw.depth_write_off = true;
    lom_draw(device, &draw);
}

void lom_draw_terrain(lom_workload *w, lom_device *device)
{
    lom_begin_workload_pass(w, device, LOM_MAIN, 0, 0, 0);
    draw_ground(w, device, false, 0, 0, LOM_COMPARE_LESS_EQUAL);
    draw_sky(w, device, false);
    lom_end_pass(device);
}

static void draw_lake(lom_workload *w, lom_device *device)
{
    lom_peer_lake lake = { .move = 0.06f,
                           .near_plane = w->kind->view->near_plane,
                           .far_plane = w->kind->view->far_plane,
                           .per_width = 1 / (float)w->width,
                           .per_height = 1 / (float)w->height,
                           .reflection = w->color[LOM_REFLECTION],
                           .refraction = w->color[LOM_REFRACTION],
                           .refraction_depth = w->depth[LOM_REFRACTION],
                           .dudv = w->dudv,
                           .normals = w->ripples };
    memcpy(lake.to_clip, w->to_clip.m, sizeof lake.to_clip);
    memcpy(lake.eye, w->kind->view->eye, sizeof lake.eye);
    memcpy(lake.light, w->light, sizeof lake.light);
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_lake_shader, &w->water, 1, &lake);
    draw.attribute[1] = attribute(&w->water, 2);
    draw.depth_compare = LOM_COMPARE_LESS_EQUAL;
    draw.blend[0] = lom_straight_alpha;
    lom_draw(device, &draw);
}

void lom_draw_water(lom_workload *w, lom_device *device)
{
    lom_begin_workload_pass(w, device, LOM_REFLECTION, 0, 0, 0);
    draw_ground(w, device, true, 1, 0.05f, LOM_COMPARE_LESS_EQUAL);
    draw_sky(w, device, true);
    lom_end_pass(device);
    lom_begin_workload_pass(w, device, LOM_REFRACTION, 0.02f, 0.10f, 0.18f);
    draw_ground(w, device, false, -1, 0.2f, LOM_COMPARE_LESS_EQUAL);
    lom_end_pass(device);
    lom_begin_workload_pass(w, device, LOM_MAIN, 0, 0, 0);
    draw_ground(w, device, false, 0, 0, LOM_COMPARE_LESS_EQUAL);
    draw_sky(w, device, false);
    draw_lake(w, device);
    lom_end_pass(device);
}

/* The rows below the far edge of the lake, and as far above it as look-ups are displaced; with their filter and more. */
static lom_rect lake_rows(const lom_workload *w)
{
    float top = -1;
    for (size_t i = 0; i < w->water.vertex_count; i++) {
        const float *p = w->water.vertices[i].position, *m = w->to_clip.m;
        float y = p[0] * m[1] + p[1] * m[5] + p[2] * m[9] + m[13],
              away = p[0] * m[3] + p[1] * m[7] + p[2] * m[11] + m[15];
        if (away > 0 && y / away > top)
            top = y / away;
    }
    float row = (0.5f - 0.5f * (top < 1 ? top : 1) - 0.02f) * (float)w->height - 3;
    int first = row > 0 ? lom_int_of(row) : 0;
    return (lom_rect){ 0, first, w->width, w->height - first };
}

static void begin_part(lom_workload *w, lom_device *device, int target, float r, float g, float b, lom_rect part)
{
    lom_begin_pass(device, &(lom_pass_desc){ .color = { w->color[target] },
                                             .depth = w->depth[target],
                                             .clip_range = LOM_CLIP_MINUS_W_TO_W,
                                             .scissor = part,
                                             .clear_color = { { r, g, b, 1 } },
                                             .clear_depth = 1 });
}

/* What the main picture shows below the refraction's plane, less 5 cm. The camera is upright: with f the direction that it
 * looks along, a pixel's ray rises by f.y + tan(30 degrees) (1 - 2 y / height) |(f.x, f.z)| a metre along f. */
static void copy_bed(lom_workload *w, lom_device *device)
{
    const lom_workload_view *view = w->kind->view;
    float d[3], tangent = 0.57735027f;
    for (int k = 0; k < 3; k++)
        d[k] = view->target[k] - view->eye[k];
    float flat = __builtin_sqrtf(d[0] * d[0] + d[2] * d[2]), length = __builtin_sqrtf(flat * flat + d[1] * d[1]);
    float up = tangent * flat / length;
    const lom_peer_copy copy = { .rise = { d[1] / length + up, -2 * up / (float)w->height },
                                 .eye_height = view->eye[1],
                                 .below = 0.2f - 0.05f,
                                 .near_plane = view->near_plane,
                                 .far_plane = view->far_plane,
                                 .color = w->color[LOM_MAIN],
                                 .depth = w->depth[LOM_MAIN] };
    lom_draw(device, &(lom_draw_desc){ .shader = &lom_peer_copy_shader,
                                       .uniforms = &copy,
                                       .count = 4,
                                       .vertex_count = 4,
                                       .topology = LOM_TRIANGLE_STRIP,
                                       .depth_compare = LOM_COMPARE_ALWAYS });
}

/* The bed begins as the main picture, so that what is as near is not shaded again; both pictures end at the last row that
 * the lake looks up. Pixels of several samples have no one place that could be copied. */
void lom_draw_water_once(lom_workload *w, lom_device *device)
{
    if (w->samples > 1) {
        lom_draw_water(w, device);
        return;
    }
    const lom_rect rows = lake_rows(w);
    lom_begin_workload_pass(w, device, LOM_MAIN, 0, 0, 0);
    draw_ground(w, device, false, 0, 0, LOM_COMPARE_LESS_EQUAL);
    draw_sky(w, device, false);
    lom_end_pass(device);
    begin_part(w, device, LOM_REFRACTION, 0.02f, 0.10f, 0.18f, rows);
    copy_bed(w, device);
    draw_ground(w, device, false, -1, 0.2f, LOM_COMPARE_LESS);
    lom_end_pass(device);
    begin_part(w, device, LOM_REFLECTION, 0, 0, 0, rows);
    draw_ground(w, device, true, 1, 0.05f, LOM_COMPARE_LESS_EQUAL);
    draw_sky(w, device, true);
    lom_end_pass(device);
    lom_begin_pass(device, &(lom_pass_desc){ .color = { w->color[LOM_MAIN] },
                                             .depth = w->depth[LOM_MAIN],
                                             .clip_range = LOM_CLIP_MINUS_W_TO_W,
                                             .color_load = { LOM_LOAD_KEEP },
                                             .depth_load = LOM_LOAD_KEEP });
    draw_lake(w, device);
    lom_end_pass(device);
}

void lom_draw_cloud(lom_workload *w, lom_device *device)
{
    lom_peer_puff puff = { .march = { .volume = w->cloud,
                                      .steps = 100,
                                      .absorption = 0.15f,
                                      .shade = 0.6f,
                                      .opaque = 0.9f,
                                      .walk = !w->kind->skip,
                                      .filtering = w->march } };
    memcpy(puff.to_clip, w->to_clip.m, sizeof puff.to_clip);
    for (int k = 0; k < 3; k++) {
        puff.eye[k] = w->kind->view->eye[k] + 0.5f;
        puff.march.light_offset[k] = w->light[k] * 0.08f;
    }
    lom_begin_workload_pass(w, device, LOM_MAIN, 0.25f, 0.45f, 0.75f);
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_puff_shader, &w->cube, 1, &puff);
    draw.depth_compare = LOM_COMPARE_LESS;
    draw.blend[0] = multiplied_alpha;
    lom_draw(device, &draw);
    lom_end_pass(device);
}
