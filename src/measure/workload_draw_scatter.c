/* The frames of the workloads of many small things and of textured layers. In: what workload.c made; out: passes and
 * draws on a device. Invariant: states, clears and uniforms are those of bench/peers/README.md, in its order. */
#include "workload.h"

#include "peer_shaders.h"

#include <string.h>

void lom_draw_sprites(lom_workload *w, lom_device *device)
{
    lom_peer_card card = { .texture = w->card };
    lom_begin_workload_pass(w, device, LOM_MAIN, 0.1f, 0.2f, 0.3f);
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_sprite_shader, &w->scattered, 3, &card);
    draw.cull = LOM_CULL_NONE;
    draw.depth_test_off = true;
    draw.blend[0] = lom_straight_alpha;
    lom_draw(device, &draw);
    lom_end_pass(device);
}

void lom_draw_foliage(lom_workload *w, lom_device *device)
{
    lom_peer_card card = { .texture = w->card };
    memcpy(card.to_clip, w->to_clip.m, sizeof card.to_clip);
    lom_begin_workload_pass(w, device, LOM_MAIN, 0.6f, 0.7f, 0.8f);
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_card_shader, &w->scattered, 3, &card);
    draw.cull = LOM_CULL_NONE;
    draw.depth_compare = LOM_COMPARE_LESS;
    lom_draw(device, &draw);
    lom_end_pass(device);
}

void lom_draw_gradients(lom_workload *w, lom_device *device)
{
    lom_begin_workload_pass(w, device, LOM_MAIN, 0, 0, 0);
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_gradient_shader, &w->scattered, 2, NULL);
    draw.cull = LOM_CULL_NONE;
    draw.depth_compare = LOM_COMPARE_LESS;
    lom_draw(device, &draw);
    lom_end_pass(device);
}

void lom_draw_boxes(lom_workload *w, lom_device *device)
{
    lom_peer_colored_box uniforms;
    memcpy(uniforms.to_clip, w->to_clip.m, sizeof uniforms.to_clip);
    lom_begin_workload_pass(w, device, LOM_MAIN, 0.1f, 0.1f, 0.15f);
    lom_draw_desc draw = lom_workload_mesh_draw(&lom_peer_box_shader, &w->cube, 1, &uniforms);
    draw.depth_compare = LOM_COMPARE_LESS;
    for (int i = 0; i < LOM_PEER_BOXES; i++) {
        const lom_peer_box *box = &w->boxes[i];
        memcpy(uniforms.centre, box->centre, sizeof uniforms.centre);
        memcpy(uniforms.color, box->color, sizeof uniforms.color);
        uniforms.size = box->size;
        lom_draw(device, &draw);
    }
    lom_end_pass(device);
}

void lom_draw_textured(lom_workload *w, lom_device *device)
{
    static const float scales[8] = { 0.2f, 0.3f, 0.45f, 0.7f, 1.0f, 1.5f, 2.2f, 3.2f };
    lom_begin_workload_pass(w, device, LOM_MAIN, 0.1f, 0.2f, 0.3f);
    for (int i = 0; i < 8; i++) {
        double angle = (double)(0.2f * (float)i);
        lom_peer_layer layer = { .z = -0.9f + 0.2f * (float)i,
                                 .aspect = (float)w->width / (float)w->height,
                                 .along = { scales[i] * (float)lom_double_cos(angle),
                                            scales[i] * (float)lom_double_sin(angle) },
                                 .texture = w->albedo };
        lom_draw(device, &(lom_draw_desc){ .shader = &lom_peer_layer_shader,
                                           .uniforms = &layer,
                                           .count = 4,
                                           .vertex_count = 4,
                                           .topology = LOM_TRIANGLE_STRIP,
                                           .depth_test_off = true,
                                           .blend = { lom_straight_alpha } });
    }
    lom_end_pass(device);
}
