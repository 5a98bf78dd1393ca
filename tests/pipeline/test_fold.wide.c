/* Proves that a tile that is one colour, and stays so while draws of one colour cover all of it, ends as the plain path
 * leaves it: each list of draws is drawn twice, by a shader that reads nothing and by one that only says that it reads
 * the position, so that its fragments are shaded one by one. Pixels and the count of fragments are the same. */
#include "stage.h"

enum { DRAWS = 12, LISTS = 150 };

typedef struct layer {
    float color[4];
} layer;

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const layer *l = uniforms;
    (void)in;
    out->color[0] =
        (lom_float4){ lom_splat(l->color[0]), lom_splat(l->color[1]), lom_splat(l->color[2]), lom_splat(l->color[3]) };
}

LOM_SHADER(folded, place, paint, .attributes = 1, .colors = 1, .uniforms_size = sizeof(layer))
LOM_SHADER(plain, place, paint, .attributes = 1, .colors = 1, .reads_position = true, .uniforms_size = sizeof(layer))

static vertex corners[DRAWS][4];
static lom_draw_desc draws[DRAWS];
static layer layers[DRAWS];

/* A strip of two triangles: the window, a rectangle whose edges pass through pixels, or any four points. */
static void make_corners(vertex v[4])
{
    int64_t kind = random_whole(0, 5);
    float left = -1, right = 1, top = 1, bottom = -1;
    if (kind == 1 || kind == 2) {
        left = random_float(-2, 0.5f);
        right = left + random_float(0.1f, 3);
        bottom = random_float(-2, 0.5f);
        top = bottom + random_float(0.1f, 3);
    }
    for (int k = 0; k < 4; k++) {
        v[k] = (vertex){ .position = { k & 1 ? right : left, k & 2 ? top : bottom, 0.5f, 1 } };
        for (int i = 0; i < 2 && kind == 3; i++)
            v[k].position[i] += random_float(-0.7f, 0.7f);
        for (int i = 0; i < 2 && kind == 4; i++)
            v[k].position[i] *= 40;
    }
}

static lom_blend make_blend(void)
{
    static const lom_factor factors[] = { LOM_FACTOR_ZERO,         LOM_FACTOR_ONE,
                                          LOM_FACTOR_SOURCE_ALPHA, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                          LOM_FACTOR_SOURCE_COLOR, LOM_FACTOR_TARGET_COLOR };
    return (lom_blend){ .enabled = random_whole(0, 2) != 0,
                        .source_color = factors[random_whole(0, 5)],
                        .target_color = factors[random_whole(0, 5)],
                        .source_alpha = factors[random_whole(0, 4)],
                        .target_alpha = factors[random_whole(0, 4)],
                        .color_operation = random_whole(0, 5) == 0 ? LOM_BLEND_MAX : LOM_BLEND_ADD };
}

static void make_list(int width, int height)
{
    for (int i = 0; i < DRAWS; i++) {
        make_corners(corners[i]);
        for (int c = 0; c < 4; c++)
            layers[i].color[c] = random_float(-0.1f, 1.1f);
        draws[i] = draw_of(&folded, corners[i], 4);
        draws[i].topology = LOM_TRIANGLE_STRIP;
        draws[i].uniforms = &layers[i];
        draws[i].blend[0] = make_blend();
        draws[i].mask_off[0] = random_whole(0, 9) == 0 ? 5 : 0;
        draws[i].depth_test_off = random_whole(0, 7) != 0;
        if (random_whole(0, 4) == 0)
            draws[i].scissor = (lom_rect){ (int)random_whole(0, width / 2), (int)random_whole(0, height / 2),
                                           (int)random_whole(1, width), (int)random_whole(1, height) };
    }
}

static uint64_t draw_list(stage *s, const lom_shader *shader, int count, int origin)
{
    uint64_t before = lom_device_counters(s->device).fragments;
    lom_pass_desc desc = { .clear_color = { { 0.2f, 0.4f, 0.6f, 0.8f } }, .clear_depth = 0.25f };
    if (origin != 0) {
        desc.origin_x = origin;
        desc.origin_y = origin / 2;
        desc.frame_width = lom_texture_width(s->color) + 2 * origin;
        desc.frame_height = lom_texture_height(s->color) + 2 * origin;
    }
    begin(s, desc);
    for (int i = 0; i < count; i++) {
        lom_draw_desc draw = draws[i];
        draw.shader = shader;
        lom_draw(s->device, &draw);
    }
    finish(s);
    return lom_device_counters(s->device).fragments - before;
}

static void lists_in(lom_device_desc desc, int width, int height, lom_format color, lom_format depth, int origin)
{
    stage a = open_stage(desc, width, height, color, depth), b = open_stage(desc, width, height, color, depth);
    for (int list = 0; list < LISTS; list++) {
        int count = (int)random_whole(0, DRAWS);
        make_list(width + 2 * origin, height + 2 * origin);
        uint64_t fragments[2] = { draw_list(&a, &folded, count, origin), draw_list(&b, &plain, count, origin) };
        CHECK(same_images(a.image, b.image), "list %d of %d draws, tile %d, %dx%d at %d, format %d", list, count,
              desc.tile, width, height, origin, (int)color);
        CHECK(depth == LOM_FORMAT_NONE || same_images(a.depths, b.depths), "depths of list %d", list);
        CHECK(fragments[0] == fragments[1], "list %d: %llu and %llu fragments", list, (unsigned long long)fragments[0],
              (unsigned long long)fragments[1]);
    }
    close_stage(&a);
    close_stage(&b);
}

static void a_tile_of_one_colour_ends_as_the_plain_path_leaves_it(void)
{
    lists_in((lom_device_desc){ .tile = 64, .threads = 2 }, 150, 70, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F, 0);
    lists_in((lom_device_desc){ .tile = 16, .threads = 1 }, 97, 45, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH16, 21);
    lists_in((lom_device_desc){ .tile = 32, .threads = 1 }, 97, 45, LOM_FORMAT_RG8, LOM_FORMAT_NONE, 0);
    lists_in((lom_device_desc){ .tile = 32, .threads = 1 }, 64, 64, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_NONE, 6);
    lists_in((lom_device_desc){ .tile = 64, .threads = 1, .batch = 2 }, 100, 60, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE, 0);
}

/* Full layers leave no fragment stage to run: one packet a draw, for its colour. */
static void full_layers_shade_one_packet_a_draw(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 200, 150, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    make_list(200, 150);
    for (int i = 0; i < DRAWS; i++)
        for (int k = 0; k < 4; k++)
            corners[i][k] = (vertex){ .position = { k & 1 ? 1.0f : -1.0f, k & 2 ? 1.0f : -1.0f, 0.5f, 1 } };
    draw_list(&s, &folded, DRAWS, 0);
    CHECK(lom_device_counters(s.device).packets == DRAWS, "%llu packets for %d draws",
          (unsigned long long)lom_device_counters(s.device).packets, DRAWS);
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(a_tile_of_one_colour_ends_as_the_plain_path_leaves_it);
    RUN(full_layers_shade_one_packet_a_draw);
    return check_result();
}
