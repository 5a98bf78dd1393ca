/* Proves that every topology is clipped as the primitives of its list are, at this width: strips, fans and line strips, with
 * indices and restarts, of vertices that lie behind the eye, before near, beyond far and the guard band or outside of any
 * distance, draw the floats and depths of their triangles and lines one by one, which other tests hold to oracles; that d and
 * -d share the pixels of lines; and that points which lie side by side leave no pixel out and share none. */
#include "stage.h"

enum { SIZE = 96, VERTICES = 66, PLANES = 8 };

struct signs {
    float sign[PLANES];
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct signs *signs = uniforms;
    place_values(out, in, uniforms);
    for (int i = 0; i < PLANES; i++)
        out->distance[i] = (&in->attribute[3 + i / 4].x)[i % 4] * signs->sign[i];
    out->point_size = in->attribute[2].x;
}

static void count(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_float one = lom_splat(1);
    (void)in;
    (void)uniforms;
    out->color[0] = (lom_float4){ one, one, one, one };
}

LOM_SHADER(whole, place, show_values, .attributes = 5, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .flat = 1u << 3,
           .colors = 1, .uniforms_size = sizeof(struct signs))
LOM_SHADER(clipped, place, show_values, .attributes = 5, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .flat = 1u << 3,
           .clip_distances = PLANES, .colors = 1, .uniforms_size = sizeof(struct signs))
LOM_SHADER(culled, place, show_values, .attributes = 5, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .flat = 1u << 3,
           .cull_distances = PLANES, .colors = 1, .uniforms_size = sizeof(struct signs))
LOM_SHADER(counter, place, count, .attributes = 5, .varyings = 4, .colors = 1, .uniforms_size = sizeof(struct signs))
LOM_SHADER(cut_counter, place, count, .attributes = 5, .varyings = 4, .clip_distances = 1, .colors = 1,
           .uniforms_size = sizeof(struct signs))

static const struct signs plus = { { 1, 1, 1, 1, 1, 1, 1, 1 } };
static vertex vertices[VERTICES];

/* kind 0: within the clip volume; 1: before near, beyond far; 2: w of both signs; 3: beyond the guard band; 4: a few
 * that are no numbers. Distances cross everywhere. */
static void make_vertices(int kind)
{
    for (int i = 0; i < VERTICES; i++) {
        vertex *v = &vertices[i];
        const float reach = kind == 3 && i % 5 == 0 ? 3000 : 1.2f;
        float w = kind == 2 ? random_float(-1, 2) : random_float(0.5f, 2);
        for (int k = 0; k < 2; k++)
            v->position[k] = random_float(-reach, reach) * (w < 0 ? -w : w);
        v->position[2] = kind == 1 ? random_float(-0.5f, 1.5f) * w : random_float(0.1f, 0.9f) * w;
        v->position[3] = kind == 4 && i % 13 == 7 ? __builtin_nanf("") : w;
        for (int k = 0; k < 8; k++) {
            v->value[k] = random_float(-1, 1);
            v->distance[k] = random_float(-0.2f, 1);
        }
    }
}

/* ---- strips, fans ---- */

/* Places 0 .. VERTICES - 1 in the order of the buffer; NONE: a restart. */
enum { NONE = UINT16_MAX, MOST = 3 * 2 * VERTICES };

static size_t shuffle(uint16_t indices[VERTICES], bool restart)
{
    for (int i = 0; i < VERTICES; i++)
        indices[i] = restart && i % 11 == 10 ? NONE : (uint16_t)random_whole(0, VERTICES - 1);
    return VERTICES;
}

/* The list of a strip's or fan's primitives, whose last vertices are those of the topology's (lom_provoking):
 * triangle i of a strip has i, i + 1, i + 2, of which every second one changes the first two, so that all wind
 * alike. */
static size_t list_of(lom_topology topology, const uint16_t *indices, size_t count, uint16_t list[MOST])
{
    size_t made = 0, start = 0;
    const size_t corners = topology == LOM_LINE_STRIP ? 2 : 3;
    for (size_t i = 0; i < count; i++) {
        if (indices[i] == NONE) {
            start = i + 1;
            continue;
        }
        if (i - start + 1 < corners)
            continue;
        const bool odd = (i - start) % 2 == 1;
        const uint16_t strip[3] = { indices[odd ? i - 1 : i - 2 + (corners == 2)], indices[odd ? i - 2 : i - 1],
                                    indices[i] };
        const uint16_t fan[3] = { indices[start], indices[i - 1], indices[i] },
                       line[2] = { indices[i - 1], indices[i] };
        const uint16_t *from = topology == LOM_TRIANGLE_FAN ? fan : topology == LOM_LINE_STRIP ? line : strip;
        memcpy(list + made, from, corners * sizeof *list);
        made += corners;
    }
    return made;
}

static uint64_t draw_indexed(stage *s, lom_draw_desc draw, const uint16_t *indices, size_t count)
{
    draw.indices = indices;
    draw.index_bits = 16;
    draw.count = count;
    draw.restart = true;
    draw.vertex_count = VERTICES;
    begin(s, (lom_pass_desc){ .clear_color = { { 9, 9, 9, 9 } } });
    lom_draw(s->device, &draw);
    finish(s);
    return lom_hash_image(s->image) * 31 + lom_hash_image(s->depths);
}

static void strips_and_fans_are_clipped_as_their_lists_are(void)
{
    static const lom_shader *const shaders[] = { &whole, &clipped, &culled };
    static const lom_topology topologies[][2] = { { LOM_TRIANGLE_STRIP, LOM_TRIANGLES },
                                                  { LOM_TRIANGLE_FAN, LOM_TRIANGLES },
                                                  { LOM_LINE_STRIP, LOM_LINES } };
    stage s =
        open_stage((lom_device_desc){ .threads = 1, .chunk = 16 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    lom_draw_desc none = draw_of(&whole, vertices, 0);
    none.uniforms = &plus;
    const uint64_t nothing = draw_indexed(&s, none, NULL, 0);
    int drawn = 0;
    for (int round = 0; round < 3 * 3 * 5 * 2 * 3; round++) {
        const lom_topology *topology = topologies[round % 3];
        const int kind = round / 9 % 5;
        uint16_t indices[VERTICES], list[MOST];
        lom_draw_desc draw = { .shader = shaders[round / 3 % 3] };
        make_vertices(kind);
        draw = draw_of(draw.shader, vertices, VERTICES);
        draw.uniforms = &plus;
        draw.depth_clamp = round / 45 % 2 == 1;
        draw.cull = (lom_cull)(round / 90 % 3);
        draw.line_width = 1 + round % 4;
        const size_t count = shuffle(indices, round % 2 == 1), listed = list_of(topology[0], indices, count, list);
        draw.topology = topology[0];
        const uint64_t strip = draw_indexed(&s, draw, indices, count);
        draw.topology = topology[1];
        const uint64_t one_by_one = draw_indexed(&s, draw, list, listed);
        CHECK(strip == one_by_one, "round %d: topology %d, kind %d, shader %s", round, topology[0], kind,
              draw.shader->name);
        drawn += strip != nothing;
    }
    CHECK(drawn > 200, "only %d of 270 draw anything", drawn);
    close_stage(&s);
}

/* ---- lines, points ---- */

static int hits_at(const stage *s, int p)
{
    return (int)floats_at(s, p % SIZE, p / SIZE)[0];
}

static void draw_counting(stage *s, const lom_shader *shader, const struct signs *signs, lom_topology topology,
                          size_t number)
{
    lom_draw_desc draw = draw_of(shader, vertices, number);
    draw.uniforms = signs;
    draw.topology = topology;
    draw.blend[0] = adding();
    draw.depth_test_off = true;
    lom_draw(s->device, &draw);
}

/* T15 of lines: what d leaves of a line -d has, and no pixel of it is in both. */
static void distances_share_the_pixels_of_lines(void)
{
    static const struct signs minus = { { -1 } };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    stage all = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    int hit = 0;
    for (int round = 0; round < 20; round++) {
        make_vertices(round % 4);
        for (int i = 0; i < VERTICES; i++)
            vertices[i].distance[0] = random_float(-1, 1);
        const lom_topology topology = round % 2 == 0 ? LOM_LINES : LOM_LINE_STRIP;
        begin(&s, (lom_pass_desc){ .samples = 1 });
        draw_counting(&s, &cut_counter, &plus, topology, VERTICES);
        draw_counting(&s, &cut_counter, &minus, topology, VERTICES);
        finish(&s);
        begin(&all, (lom_pass_desc){ .samples = 1 });
        draw_counting(&all, &counter, &plus, topology, VERTICES);
        finish(&all);
        for (int p = 0; p < SIZE * SIZE; p++) {
            CHECK(hits_at(&s, p) == hits_at(&all, p), "round %d: pixel %d,%d has %d hits of %d", round, p % SIZE,
                  p / SIZE, hits_at(&s, p), hits_at(&all, p));
            hit += hits_at(&all, p);
        }
    }
    CHECK(hit > 5000, "only %d hits", hit);
    close_stage(&s);
    close_stage(&all);
}

/* Squares of any size in rows and columns, wherever they begin: each pixel belongs to one of them. */
static void points_side_by_side_share_every_pixel(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 64, 64, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    for (int round = 0; round < 60; round++) {
        const int64_t size = 2 * random_whole(1300, 4000), x0 = random_whole(-size / 2, 0),
                      y0 = random_whole(-size / 2, 0);
        size_t number = 0;
        for (int64_t y = y0; y - size / 2 < 64 * 256; y += size)
            for (int64_t x = x0; x - size / 2 < 64 * 256 && number < VERTICES; x += size) {
                place_at(&vertices[number], x, y, 64);
                vertices[number].value[4] = (float)size / 256;
                number++;
            }
        begin(&s, (lom_pass_desc){ .samples = 1 });
        draw_counting(&s, &counter, &plus, LOM_POINTS, number);
        finish(&s);
        for (int p = 0; p < 64 * 64; p++)
            CHECK(floats_at(&s, p % 64, p / 64)[0] == 1, "round %d, size %lld/256: pixel %d,%d has %g hits", round,
                  (long long)size, p % 64, p / 64, (double)floats_at(&s, p % 64, p / 64)[0]);
    }
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(strips_and_fans_are_clipped_as_their_lists_are);
    RUN(distances_share_the_pixels_of_lines);
    RUN(points_side_by_side_share_every_pixel);
    return check_result();
}
