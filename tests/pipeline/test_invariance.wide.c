/* Proves that a picture is no function of how it was made, at this width: threads, tile size, chunk and batch, a second
 * device in another thread, and the float state the caller left behind; that counters of work are none of the threads,
 * also where a mesh is cut into chunks that share vertices; and that all widths give one picture: the
 * hashes of the float colours and depths are compared with one constant. The other tests hold the stages to oracles;
 * the constant only holds builds to one another, and a change of it is a change of LOM_PICTURE_VERSION. */
#include "hostile.h"
#include "stage.h"

#include <pthread.h>

enum { WIDTH = 200, HEIGHT = 150, TRIANGLES = 1500 };

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    for (int i = 0; i < 4; i++)
        out->varying[i] = (&in->attribute[1].x)[i];
    for (int i = 0; i < 4; i++)
        out->varying[4 + i] = (&in->attribute[2].x)[i];
    out->distance[0] = in->attribute[3].x;
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0], in->varying[1], in->varying[2], in->varying[3] };
}

/* Derivatives, position, flat and interpolated varyings, everything that a lane computes. */
static void show_all(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float hole = in->varying[0] * in->varying[1];
    out->discard = hole > 0.3f;
    out->color[0] =
        (lom_float4){ lom_dx(in, 0), lom_dy(in, 1) + in->varying[4],
                      in->w * 0.25f + in->z + lom_select(in->front, in->x, in->y) * 0x1p-8f, lom_abs(in->varying[3]) };
}

static void show_quads(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float f = in->varying[0] * in->varying[1];
    out->color[0] = (lom_float4){ lom_quad_dx(f), lom_quad_dy(f), f, lom_splat(0.5f) };
    out->depth = in->z * 0.5f + 0.25f;
}

static void constant(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(0.125f), lom_splat(0.25f), lom_splat(0.5f), lom_splat(0.75f) };
}

LOM_SHADER(opaque, place, show, .attributes = 4, .varyings = 8, .clip_distances = 1, .reads = LOM_VARYINGS(0, 4),
           .colors = 1)
LOM_SHADER(everything, place, show_all, .attributes = 4, .varyings = 8, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, 5), .differentiates = LOM_VARYINGS(0, 2), .flat = 1u << 4, .reads_position = true,
           .discards = true, .colors = 1)
LOM_SHADER(in_quads, place, show_quads, .attributes = 4, .varyings = 8, .reads = LOM_VARYINGS(0, 2), .quads = true,
           .reads_position = true, .writes_depth = true, .colors = 1)
LOM_SHADER(uniform_color, place, constant, .attributes = 4, .varyings = 8, .colors = 1)

static vertex vertices[3 * TRIANGLES];

/* Small and large, in front of and behind the camera, some cut by a distance; from fixed random numbers. */
static void make_scene(void)
{
    random_draws = 0;
    for (size_t t = 0; t < TRIANGLES; t++) {
        float reach = t % 40 == 0 ? 5.0f : t % 5 == 0 ? 0.4f : 0.06f, x = random_float(-1, 1), y = random_float(-1, 1);
        for (size_t k = 0; k < 3; k++) {
            vertex *v = &vertices[3 * t + k];
            float w = t % 40 == 0 ? random_float(-0.5f, 2.0f) : random_float(0.2f, 4.0f);
            v->position[0] = (x + random_float(-reach, reach)) * (w > 0.2f ? w : 0.2f);
            v->position[1] = (y + random_float(-reach, reach)) * (w > 0.2f ? w : 0.2f);
            v->position[2] = random_float(0, 1) * w;
            v->position[3] = w;
            for (int i = 0; i < 8; i++)
                v->value[i] = random_float(-1, 1);
            v->distance[0] = t % 3 == 0 ? random_float(-1, 1) : 1.0f;
        }
    }
}

static void draw_part(stage *s, const lom_shader *shader, size_t first, size_t count, lom_blend blend)
{
    lom_draw_desc desc = draw_of(shader, vertices, 3 * TRIANGLES);
    desc.attribute[3].kind = LOM_ATTRIBUTE_FLOAT1;
    desc.attribute[4].kind = LOM_ATTRIBUTE_NONE;
    desc.first = 3 * first;
    desc.count = 3 * count;
    desc.blend[0] = blend;
    lom_draw(s->device, &desc);
}

/* The whole mixture: opaque, discarding with derivatives, quads with depth output, constant, blended. */
static void draw_scene(stage *s)
{
    lom_blend over = { .enabled = true,
                       .source_color = LOM_FACTOR_SOURCE_ALPHA,
                       .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                       .source_alpha = LOM_FACTOR_ONE,
                       .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };
    begin(s, (lom_pass_desc){ .clear_color = { { 0.1f, 0.2f, 0.3f, 0.4f } } });
    draw_part(s, &opaque, 0, 500, (lom_blend){ 0 });
    draw_part(s, &everything, 500, 300, (lom_blend){ 0 });
    draw_part(s, &in_quads, 800, 100, (lom_blend){ 0 });
    draw_part(s, &uniform_color, 900, 100, (lom_blend){ 0 });
    draw_part(s, &opaque, 1000, 300, over);
    draw_part(s, &everything, 1300, 200, over);
    finish(s);
}

typedef struct hashes {
    uint64_t color, depth;
} hashes;

static hashes render(lom_device_desc desc, lom_format color, lom_format depth)
{
    stage s = open_stage(desc, WIDTH, HEIGHT, color, depth);
    draw_scene(&s);
    hashes h = { lom_hash_image(s.image), lom_hash_image(s.depths) };
    close_stage(&s);
    return h;
}

static void check_hashes(hashes a, hashes b, const char *what, int number)
{
    CHECK(a.color == b.color && a.depth == b.depth, "%s %d: colours %016llx and %016llx, depths %016llx and %016llx",
          what, number, (unsigned long long)a.color, (unsigned long long)b.color, (unsigned long long)a.depth,
          (unsigned long long)b.depth);
}

/* Every width, compiler, level and processor: these numbers. */
static void float_stages_have_one_hash(void)
{
    make_scene();
    hashes floats = render((lom_device_desc){ .threads = 1 }, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    hashes bytes = render((lom_device_desc){ .threads = 1 }, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH24);
    check_hashes(floats, (hashes){ UINT64_C(0xc980ae6df887aac7), UINT64_C(0x011e841d36d3eab5) }, "floats", LOM_LANES);
    check_hashes(bytes, (hashes){ UINT64_C(0xb5566cc9b78a4fc8), UINT64_C(0x795c907ab5f77895) }, "bytes", LOM_LANES);
}

static void schedules_change_nothing(void)
{
    static const int threads[] = { 1, 2, 3, 7 }, tiles[] = { 16, 32, 64 }, chunks[] = { 16, 100, 8192 },
                     batches[] = { 1, 3, 32 };
    static const lom_format formats[][2] = { { LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F },
                                             { LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH16 },
                                             { LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_DEPTH24 } };
    make_scene();
    for (int f = 0; f < 3; f++) {
        hashes first = render((lom_device_desc){ .threads = 1 }, formats[f][0], formats[f][1]);
        for (int i = 0; i < 4 * 27; i++) {
            lom_device_desc desc = { .threads = threads[i / 27],
                                     .tile = tiles[i % 3],
                                     .chunk = chunks[i / 3 % 3],
                                     .batch = batches[i / 9 % 3] };
            if (f != 0 && i % 5 != f) /* all for floats, some for each other format */
                continue;
            check_hashes(render(desc, formats[f][0], formats[f][1]), first, "schedule", f * 1000 + i);
        }
    }
}

/* Small draws share long batches, which larger ones end: a draw a triangle, every 600 of them one of all triangles. */
static hashes render_small_draws(lom_device_desc desc)
{
    static const lom_shader *shaders[] = { &opaque, &everything, &uniform_color };
    stage s = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH24);
    begin(&s, (lom_pass_desc){ .clear_color = { { 0.1f, 0.2f, 0.3f, 0.4f } } });
    for (size_t t = 0; t < TRIANGLES; t++) {
        draw_part(&s, shaders[t % 3], t, 1, t % 5 == 0 ? adding() : (lom_blend){ 0 });
        if (t % 600 == 500)
            draw_part(&s, &everything, 0, TRIANGLES, (lom_blend){ 0 });
    }
    finish(&s);
    hashes h = { lom_hash_image(s.image), lom_hash_image(s.depths) };
    close_stage(&s);
    return h;
}

static void batches_of_small_draws_change_nothing(void)
{
    static const int batches[] = { 2, 32, 100, 1024, 0 };
    make_scene();
    const hashes one = render_small_draws((lom_device_desc){ .threads = 1, .batch = 1 });
    for (int i = 0; i < 5; i++)
        for (int threads = 1; threads <= 3; threads += 2)
            check_hashes(render_small_draws((lom_device_desc){ .threads = threads, .batch = batches[i] }), one, "batch",
                         batches[i] * 10 + threads);
}

/* A sheet of triangles that share their vertices, large enough for several chunks. */
static lom_counters count_sheet(int threads)
{
    enum { EDGE = 101, QUADS = (EDGE - 1) * (EDGE - 1) };
    static vertex corners[EDGE * EDGE];
    static uint32_t indices[6 * QUADS];
    for (uint32_t i = 0; i < EDGE * EDGE; i++)
        corners[i] = (vertex){ .position = { (float)(i % EDGE) * 0.02f - 1, (float)(i / EDGE) * 0.02f - 1, 0.5f, 1 },
                               .distance = { 1 } };
    for (uint32_t q = 0; q < QUADS; q++) {
        uint32_t low = q / (EDGE - 1) * EDGE + q % (EDGE - 1), high = low + EDGE;
        memcpy(indices + 6 * q, (uint32_t[]){ low, low + 1, high, high, low + 1, high + 1 }, 6 * sizeof *indices);
    }
    stage s = open_stage((lom_device_desc){ .threads = threads }, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    lom_draw_desc desc = draw_of(&opaque, corners, EDGE * EDGE);
    desc.indices = indices;
    desc.count = 6 * QUADS;
    begin(&s, (lom_pass_desc){ 0 });
    lom_draw(s.device, &desc);
    finish(&s);
    lom_counters counters = lom_device_counters(s.device);
    close_stage(&s);
    return counters;
}

static void counters_are_no_function_of_threads(void)
{
    static const int threads[] = { 2, 3, 4, 5, 7 };
    const lom_counters one = count_sheet(1);
    CHECK(one.triangles == 20000 && one.vertices > 101 * 101, "%llu triangles, %llu vertices: no two chunks",
          (unsigned long long)one.triangles, (unsigned long long)one.vertices);
    for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
        const lom_counters some = count_sheet(threads[i]);
        CHECK(memcmp(&some, &one, sizeof one) == 0, "%d threads: %llu vertices and %llu packets, one: %llu and %llu",
              threads[i], (unsigned long long)some.vertices, (unsigned long long)some.packets,
              (unsigned long long)one.vertices, (unsigned long long)one.packets);
    }
}

/* A device renders many passes: what the one before left in its memory must not show. */
static void passes_do_not_see_one_another(void)
{
    make_scene();
    stage s = open_stage((lom_device_desc){ .threads = 2, .chunk = 100 }, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F,
                         LOM_FORMAT_DEPTH32F);
    hashes first = { 0, 0 };
    for (int i = 0; i < 8; i++) {
        draw_scene(&s);
        hashes h = { lom_hash_image(s.image), lom_hash_image(s.depths) };
        first = i == 0 ? h : first;
        check_hashes(h, first, "pass", i);
        begin(&s, (lom_pass_desc){ .clear_color = { { 9, 9, 9, 9 } }, .clear_depth = 0.5f });
        draw_part(&s, &everything, (size_t)i * 100, 500, adding());
        finish(&s);
    }
    close_stage(&s);
}

static void *render_in_thread(void *result)
{
    *(hashes *)result = render((lom_device_desc){ .threads = 2, .chunk = 64 }, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    return NULL;
}

static void two_devices_in_two_threads(void)
{
    make_scene();
    hashes first = render((lom_device_desc){ .threads = 1 }, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    for (int round = 0; round < 4; round++) {
        pthread_t thread[2];
        hashes result[2] = { { 0, 0 }, { 0, 0 } };
        for (int i = 0; i < 2; i++)
            if (pthread_create(&thread[i], NULL, render_in_thread, &result[i]) != 0)
                abort();
        for (int i = 0; i < 2; i++) {
            pthread_join(thread[i], NULL);
            check_hashes(result[i], first, "thread", i);
        }
    }
}

/* Rounding upward, denormals flushed, every exception a trap: the same bytes, and the caller's state is back. */
static void the_callers_float_state_is_left_alone(void)
{
    make_scene();
    hashes first = render((lom_device_desc){ .threads = 2 }, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    for (int i = 0; i < HOSTILE_MODES; i++) {
        stage s = open_stage((lom_device_desc){ .threads = 2 }, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
        hostile_state state = enter_hostile_state(hostile_modes[i]);
        draw_scene(&s);
        CHECK(leave_hostile_state(&state), "mode %d: the caller's state is another", i);
        check_hashes((hashes){ lom_hash_image(s.image), lom_hash_image(s.depths) }, first, "mode", i);
        close_stage(&s);
    }
}

/* Only the descriptor counts: attributes at odd addresses, other strides and as indices. */
static void layout_of_vertices_changes_nothing(void)
{
    make_scene();
    stage s = open_stage((lom_device_desc){ .threads = 1 }, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    uint64_t first = 0;
    for (int kind = 0; kind < 3; kind++) {
        lom_draw_desc desc = draw_of(&everything, vertices, 3 * TRIANGLES);
        static uint32_t indices[3 * TRIANGLES];
        for (size_t i = 0; i < 3 * TRIANGLES; i++)
            indices[i] = (uint32_t)i;
        if (kind == 1)
            desc.indices = indices;
        if (kind == 2)
            for (size_t a = 0; a < 4; a++) { /* one tight array an attribute, one byte off */
                static char arrays[4][3 * TRIANGLES * 16 + 1];
                for (size_t i = 0; i < 3 * TRIANGLES; i++)
                    memcpy(arrays[a] + 1 + 16 * i, (const char *)&vertices[i] + 16 * a, 16);
                desc.attribute[a] = (lom_attribute){ arrays[a] + 1, sizeof arrays[a] - 1, 16, LOM_ATTRIBUTE_FLOAT4 };
            }
        begin(&s, (lom_pass_desc){ 0 });
        lom_draw(s.device, &desc);
        finish(&s);
        first = kind == 0 ? lom_hash_image(s.image) : first;
        CHECK(lom_hash_image(s.image) == first, "layout %d", kind);
    }
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(float_stages_have_one_hash);
    RUN(schedules_change_nothing);
    RUN(batches_of_small_draws_change_nothing);
    RUN(counters_are_no_function_of_threads);
    RUN(passes_do_not_see_one_another);
    RUN(two_devices_in_two_threads);
    RUN(the_callers_float_state_is_left_alone);
    RUN(layout_of_vertices_changes_nothing);
    return check_result();
}
