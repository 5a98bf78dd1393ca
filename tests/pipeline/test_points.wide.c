/* Proves of points: a pixel is covered exactly where its centre (a sample: where it) lies within half a size of the
 * snapped vertex, by whole numbers, for every kind of size, at ties, cut by tiles, scissor and the picture, in a crop; how
 * often each pixel is hit; s, t and what else the shader gets are the documented formulas, bit for bit; any shader draws
 * points of size 1, whose varyings have no derivatives; points are clipped by their centre; the restart index is none. */
#include "stage.h"

enum { SIZE = 64, POINTS = 40, LISTS = 12 };

/* Attribute 1: the size, and a value. */
static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    out->point_size = in->attribute[1].x;
    out->varying[0] = in->attribute[1].y;
}

static void count(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(1), in->varying[0], lom_splat(0), lom_splat(0) };
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->st[0], in->st[1], in->varying[0] + lom_dx(in, 0) + in->x, in->z + in->y };
}

LOM_SHADER(counted, place, count, .attributes = 2, .varyings = 1, .reads = LOM_VARYINGS(0, 1), .colors = 1)
LOM_SHADER(disc, place, count, .attributes = 2, .varyings = 1, .reads = LOM_VARYINGS(0, 1), .colors = 1, .round = true)
LOM_SHADER(shown, place, show, .attributes = 2, .varyings = 1, .reads = LOM_VARYINGS(0, 1),
           .differentiates = LOM_VARYINGS(0, 1), .reads_position = true, .colors = 1)
LOM_SHADER(plain, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

static lom_draw_desc points_of(const lom_shader *shader, const vertex *v, size_t n)
{
    lom_draw_desc draw = draw_of(shader, v, n);
    draw.topology = LOM_POINTS;
    return draw;
}

/* The size in 1/256 of a pixel. */
static int64_t units_of(float size)
{
    return size > 0 ? to_nearest_even((size < 32768 ? size : 32768) * 256) : 0;
}

/* Whether the place (x, y), in 1/256 of a pixel, is covered. */
static bool is_covered(snapped m, int64_t units, int64_t x, int64_t y)
{
    return 2 * (x - m.x) >= -units && 2 * (x - m.x) < units && 2 * (y - m.y) >= -units && 2 * (y - m.y) < units;
}

static vertex points[POINTS];
static snapped middles[POINTS];

/* Many middles and sizes lie so that edges go through centres. */
static void make_points(void)
{
    static const float special[] = { 0, -1, 0.001f, 0.0019f, 0.00196f, 1, 2, 3, 0.5f, 64, 4000, 1e30f };
    for (int i = 0; i < POINTS; i++) {
        int64_t step = random_whole(0, 1) == 0 ? 64 : 1;
        middles[i] = (snapped){ random_whole(-10, 80) * 256 / step * step, random_whole(-10, 80) * 256 / step * step };
        middles[i].x += random_whole(0, 3) * 64;
        middles[i].y += random_whole(0, 255) / step * step;
        int64_t size = random_whole(0, 2);
        points[i] = (vertex){ .value = { size == 0   ? special[random_whole(0, 11)]
                                         : size == 1 ? (float)random_whole(1, 40) * 0.25f
                                                     : random_float(0, 20),
                                         (float)(i + 1) } };
        if (random_whole(0, 30) == 0)
            points[i].value[0] = __builtin_nanf("");
        place_at(&points[i], middles[i].x, middles[i].y, SIZE);
    }
}

static void compare(const stage *s, const lom_rect *scissor, int samples, int list)
{
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            float hits = 0, sum = 0;
            bool inside = x >= scissor->x && x < scissor->x + scissor->width && y >= scissor->y &&
                          y < scissor->y + scissor->height;
            for (int i = 0; i < POINTS * samples && inside; i++) {
                int at[2];
                lom_sample_position(samples, i % samples, at);
                const vertex *v = &points[i / samples];
                bool in = v->position[0] >= -1e6f && is_covered(middles[i / samples], units_of(v->value[0]),
                                                                256 * x + 128 + 16 * at[0], 256 * y + 128 + 16 * at[1]);
                hits += in ? 1 : 0;
                sum += in ? v->value[1] : 0;
            }
            const float *is = floats_at(s, x, y), n = (float)samples;
            CHECK(is[0] * n == hits && is[1] * n == sum, "list %d, pixel %d, %d: %g points of sum %g, not %g of %g",
                  list, x, y, (double)(is[0] * n), (double)(is[1] * n), (double)hits, (double)sum);
        }
}

static void a_point_covers_its_square(void)
{
    static const lom_device_desc devices[] = { { .threads = 1 },
                                               { .threads = 3, .tile = 16, .chunk = 16, .batch = 2 } };
    static const int samples[] = { 1, 4, 8 };
    for (int kind = 0; kind < 6; kind++) {
        stage s = open_stage(devices[kind % 2], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
        for (int list = 0; list < LISTS; list++) {
            lom_rect scissor = { 0, 0, SIZE, SIZE };
            if (list % 3 == 0)
                scissor = (lom_rect){ (int)random_whole(0, 40), (int)random_whole(0, 40), 20, 17 };
            make_points();
            lom_draw_desc draw = points_of(&counted, points, POINTS);
            draw.blend[0] = adding();
            draw.scissor = scissor;
            begin(&s, (lom_pass_desc){ .samples = samples[kind / 2] });
            lom_draw(s.device, &draw);
            finish(&s);
            compare(&s, &scissor, samples[kind / 2], list);
        }
        close_stage(&s);
    }
}

/* One point a pass, so that a pixel shows what its shader got. */
static void a_shader_gets_the_place_on_the_point(void)
{
    stage s =
        open_stage((lom_device_desc){ .threads = 1, .tile = 32 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    for (int list = 0; list < 40; list++) {
        make_points();
        snapped m = middles[0];
        int64_t units = units_of(points[0].value[0]);
        lom_draw_desc draw = points_of(&shown, points, 1);
        begin(&s, (lom_pass_desc){ .clear_color = { { -7 } } });
        lom_draw(s.device, &draw);
        finish(&s);
        float half = (float)units / 512, step = units == 0 ? 0 : half / (half * half);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                float be[4] = { (float)(256 * x + 128 - m.x) / 256 * step, (float)(256 * y + 128 - m.y) / 256 * step,
                                1 + ((float)x + 0.5f), 0.5f + ((float)y + 0.5f) };
                const float none[4] = { -7, 0, 0, 0 }, *is = floats_at(&s, x, y);
                const float *want = is_covered(m, units, 256 * x + 128, 256 * y + 128) ? be : none;
                CHECK(is[0] == want[0] && is[1] == want[1] && is[2] == want[2] && is[3] == want[3],
                      "size %g, pixel %d, %d: %.9g %.9g %.9g %.9g, not %.9g %.9g %.9g %.9g", (double)half * 2, x, y,
                      (double)is[0], (double)is[1], (double)is[2], (double)is[3], (double)want[0], (double)want[1],
                      (double)want[2], (double)want[3]);
            }
    }
    close_stage(&s);
}

/* Of an even size about a corner of pixels: the four beside it are in, those of the square's corners are not. */
static void a_round_point_is_a_disc(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    vertex v = { .value = { 16, 1 } };
    place_at(&v, 32 * 256, 32 * 256, SIZE);
    lom_draw_desc draw = points_of(&disc, &v, 1);
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    finish(&s);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            int dx = 2 * x - 63, dy = 2 * y - 63; /* half pixels */
            CHECK((floats_at(&s, x, y)[0] != 0) == (dx * dx + dy * dy < 256), "pixel %d, %d", x, y);
        }
    close_stage(&s);
}

static uint64_t fragments_of(const lom_shader *shader, const vertex *v, const lom_draw_desc *like)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    lom_draw_desc draw = points_of(shader, v, like->count);
    draw.indices = like->indices;
    draw.index_bits = like->index_bits;
    draw.restart = like->restart;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    finish(&s);
    uint64_t fragments = lom_device_counters(s.device).fragments;
    close_stage(&s);
    return fragments;
}

static void points_are_clipped_by_their_centres(void)
{
    static const float w[] = { 1, -1 };
    const lom_draw_desc one = { .count = 1 };
    vertex inside = { .position = { 1.02f, 0, 0.5f, 1 }, .value = { 8, 1 } }; /* beside the viewport, within the band */
    CHECK(fragments_of(&counted, &inside, &one) != 0, "a point whose centre is beside the picture reaches into it");
    for (int i = 0; i < 4; i++) {
        vertex v = inside;
        v.position[2] = i == 0 ? 1.01f : i == 1 ? -0.01f : 0.5f;
        v.position[3] = w[i == 2];
        v.position[0] = i == 3 ? __builtin_nanf("") : 0;
        CHECK(fragments_of(&counted, &v, &one) == 0, "case %d", i);
    }
    vertex usual = { .position = { 0.01f, 0.01f, 0.5f, 1 } };
    CHECK(fragments_of(&plain, &usual, &one) == 1, "a shader that gives no size: 1");
}

static void indices_name_points(void)
{
    static const uint32_t wide[] = { 0, UINT32_MAX, 1, 7, 1 };
    static const uint16_t narrow[] = { 0, UINT16_MAX, 1, 7, 1 };
    vertex v[2] = { { .position = { 0.01f, 0.01f, 0.5f, 1 } }, { .position = { 0.5f, 0.5f, 0.5f, 1 } } };
    const lom_draw_desc a = { .count = 5, .indices = wide, .index_bits = 32, .restart = true },
                        b = { .count = 5, .indices = narrow, .index_bits = 16, .restart = true };
    lom_draw_desc two = { .count = 2 };
    CHECK(fragments_of(&plain, v, &two) == 2, "a list");
    CHECK(fragments_of(&plain, v, &a) == 3 && fragments_of(&plain, v, &b) == 3, "%llu and %llu points, not 3",
          (unsigned long long)fragments_of(&plain, v, &a), (unsigned long long)fragments_of(&plain, v, &b));
}

int main(int argc, char **argv)
{
    RUN(a_point_covers_its_square);
    RUN(a_shader_gets_the_place_on_the_point);
    RUN(a_round_point_is_a_disc);
    RUN(points_are_clipped_by_their_centres);
    RUN(indices_name_points);
    return check_result();
}
