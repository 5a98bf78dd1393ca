/* Proves clipping at this width (T1..T12, T17, T20): against near, far, w > 0 and the guard band. */
#include "clipping.h"

#include "base/reserve.h"
#include "pipeline/project.h"
#include "pipeline/variants.h"

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0], in->z, in->w, lom_splat(1.0f) };
}
LOM_SHADER(values, place, show, .attributes = 5, .varyings = 1, .reads = 1u << 0, .reads_position = true, .colors = 1,
           .uniforms_size = 32)

/* ---- the clip volume ---- */

/* T1..T4, T7, T8, T9: single triangles. */
static void extreme_triangles_are_clipped(void)
{
    static const float h = 0x1p124f; /* FLT_MAX / 16 */
    static const struct {
        const char *name;
        float p[3][4];
        int hits; /* -1: as the oracle says; else exactly so many */
    } table[] = {
        { "T1 w = 0", { { 0.2f, 0.3f, 0, 0 }, { -0.8f, -0.5f, 0.3f, 1 }, { 0.7f, -0.8f, 0.4f, 1 } }, -1 },
        { "T1 all but one w = 0", { { 0.2f, 1, 0, 0 }, { -1, -0.5f, 0, 0 }, { 0.1f, -0.2f, 0.4f, 1 } }, -1 },
        { "T1 the zero vector", { { 0, 0, 0, 0 }, { -1, -0.5f, 0.1f, 1 }, { 0.1f, 0.7f, 0.4f, 1 } }, 0 },
        { "T2 all w < 0", { { 0.2f, 0.3f, -0.5f, -1 }, { -0.8f, -0.5f, -0.3f, -1 }, { 0.7f, -0.8f, -0.1f, -2 } }, 0 },
        { "T3 w = 1e-38", { { 1, 0, 0, 1e-38f }, { -0.8f, -0.5f, 0.3f, 1 }, { 0.7f, -0.8f, 0.4f, 1 } }, -1 },
        { "T3 denormal w", { { 1, 0.5f, 0, 1e-45f }, { -0.8f, -0.5f, 0.3f, 1 }, { 0.7f, -0.8f, 0.4f, 1 } }, -1 },
        { "T4 one behind", { { 0.3f, 0.2f, -1, -1 }, { -0.8f, -0.5f, 0.3f, 1 }, { 0.7f, -0.8f, 0.4f, 1 } }, -1 },
        { "T4 two behind", { { 0.3f, 0.2f, -1, -1 }, { -0.8f, -0.5f, -3, -3 }, { 0.2f, -0.3f, 0.4f, 1 } }, -1 },
        { "T4 two behind, near only", { { 0.3f, 0.2f, 2, 1 }, { -0.8f, -0.5f, 3, 1 }, { 0.2f, -0.3f, 0, 1 } }, -1 },
        { "T7 1e30", { { 1e30f, 0, 0.5e30f, 1e30f }, { -1e30f, 1e30f, 0, 1e30f }, { 0, -1e30f, 1e29f, 1e30f } }, -1 },
        { "T7 1e30 over 1", { { 1e30f, 0, 0.5f, 1 }, { -1e30f, 1e30f, 0, 1 }, { 0, -1e30f, 0.1f, 1 } }, -1 },
        { "T7 the largest", { { h, h, h / 2, h }, { -h, h, h / 2, h }, { -h, -h, h / 2, h } }, -1 },
        { "T7 the largest, mixed", { { h, -h, h / 2, h }, { -h, h, 0, 1 }, { -h, -h, 0, h } }, -1 },
        { "T8 1e6 frames", { { 0.25f, 0.25f, 0.5f, 1 }, { 1e6f, 2e5f, 0.5f, 1 }, { -3e5f, 1e6f, 0.5f, 1 } }, -1 },
        { "T8 1e6 frames, all sides", { { -2e6f, -1e6f, 0, 1 }, { 2e6f, -1e6f, 0, 1 }, { 0.1f, 0.3f, 0.5f, 1 } }, -1 },
        { "T9 one point", { { 0.1f, 0.1f, 0.5f, 1 }, { 0.1f, 0.1f, 0.5f, 1 }, { 0.1f, 0.1f, 0.5f, 1 } }, 0 },
        { "T9 collinear", { { -0.5f, -0.5f, 0.5f, 1 }, { 0, 0, 0.5f, 1 }, { 0.5f, 0.5f, 0.5f, 1 } }, 0 },
        { "T9 collinear when snapped", { { -0.5f, 0, 0.5f, 1 }, { 0, 1e-6f, 0.5f, 1 }, { 0.5f, 0, 0.5f, 1 } }, 0 },
        { "T9 collinear and cut", { { -0.5f, 0, 2, 1 }, { 0, 0, 0.5f, 1 }, { 0.5f, 0, 0.2f, 1 } }, 0 },
    };
    stage s = open_counting();
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        for (size_t k = 0; k < 3; k++)
            put(k, table[i].p[k][0], table[i].p[k][1], table[i].p[k][2], table[i].p[k][3]);
        if (table[i].hits < 0) {
            int open = compare_triangle(&s, &counter, 0, table[i].name, 0);
            CHECK(open < SIZE * SIZE / 8, "%s: %d pixels left open", table[i].name, open);
            continue;
        }
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, &counter, plus, 1);
        finish(&s);
        for (int p = 0; p < SIZE * SIZE; p++)
            CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == 0, "%s: pixel %d,%d", table[i].name, p % SIZE, p / SIZE);
    }
    close_stage(&s);
}

/* Every combination of planes crossed: random clip positions, far out, behind, before near and beyond far. */
static void random_triangles_equal_the_homogeneous_oracle(void)
{
    static const float reach[] = { 1, 4, 100, 1e4f, 1e8f };
    stage s = open_counting();
    int64_t open = 0, rounds = 400;
    for (int round = 0; round < rounds; round++) {
        float r = reach[round % 5];
        for (size_t k = 0; k < 3; k++) {
            float w = random_float(-0.5f, 1.5f);
            put(k, random_float(-r, r) * 0.7f, random_float(-r, r) * 0.7f, random_float(-0.4f, 1.2f), w);
        }
        open += compare_triangle(&s, &counter, 0, "random", round);
    }
    CHECK(open < rounds * SIZE * SIZE / 50, "%lld pixels left open", (long long)open);
    close_stage(&s);
}

/* n floats further from 0. */
static float step_by(float x, int n)
{
    int32_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits += n;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* A vertex within a few roundings of the guard band's edge, between one inside and one far outside. */
static void put_at_the_guard_band(struct lom_guard guard)
{
    float w = random_float(0.5f, 1.0f) * step_by(1, (int)random_whole(-60, 60) << 23), z = 0.25f * w;
    float x = step_by(w * guard.x, (int)random_whole(-2, 2)), y = random_float(-1, 1) * w * guard.y;
    if (random_whole(0, 1) != 0) {
        x = random_float(-1, 1) * w * guard.x;
        y = step_by(w * guard.y, (int)random_whole(-2, 2));
    }
    put(0, random_whole(0, 1) ? x : -x, random_whole(0, 1) ? y : -y, z, w);
    put(1, 0, 0, z, w);
    put(2, -random_float(2, 9) * w * guard.x, random_float(-9, 9) * w * guard.y, z, w);
}

/* A triangle that is cut and its neighbour that is not share vertices: what needs no clipping by itself is neither cut
 * nor moved where a triangle is. */
static void clipping_leaves_vertices_inside_as_they_are(void)
{
    struct lom_draw draw = { .desc = draw_of(&counter, vertices, 3), .variant = LOM_WIDE(LOM_SLOT), .row_floats = 8 };
    struct lom_assembly assembly = { .clip = NULL };
    struct lom_chunk chunk = { .draw = &draw, .assembly = &assembly, .vertex_count = 3 };
    int inside = 0, outside = 0;
    chunk.uniforms = plus;
    for (int round = 0; round < 20000; round++) {
        const struct lom_pass pass = { .samples = 1 };
        draw.desc.viewport = (lom_rect){ 0, 0, (int)random_whole(1, 4000), (int)random_whole(1, 4000) };
        draw.desc.max_depth = 1;
        put_at_the_guard_band(lom_guard_of(&draw.desc.viewport));
        float before[3][8];
        uint32_t corner[3] = { 0, 1, 2 }, fan[LOM_MAX_FAN][3];
        chunk.row_count = chunk.vertex_count;
        if (!lom_reserve_rows(&chunk, chunk.row_count))
            break;
        memset(chunk.rows, 0, 24 * sizeof *chunk.rows);
        LOM_WIDE(lom_shade_vertices)(&pass, &chunk);
        memcpy(before, chunk.rows, sizeof before);
        const float *p = vertices[0].position;
        if (assembly.codes[0] != 0) {
            outside++;
            continue;
        }
        inside++;
        int pieces = lom_clip_triangle(&pass, &chunk, corner, CODE_GUARD, fan);
        bool kept = false;
        for (int i = 0; i < 3 * pieces; i++)
            kept |= fan[i / 3][i % 3] == 0;
        CHECK(kept && memcmp(before, chunk.rows, 2 * sizeof before[0]) == 0, "round %d: %a, %a, w %a in %d x %d: %s",
              round, (double)p[0], (double)p[1], (double)p[3], draw.desc.viewport.width, draw.desc.viewport.height,
              kept ? "moved" : "cut");
    }
    CHECK(inside > 5000 && outside > 5000, "%d inside, %d outside", inside, outside);
    lom_release(chunk.rows);
    lom_release(assembly.clip);
    lom_release(assembly.codes);
}

/* Depth and a varying of what clipping left lie between their exact values around the pixel. */
static void clipped_values_are_those_of_the_whole(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    int compared = 0;
    for (int round = 0; round < 150; round++) {
        for (size_t k = 0; k < 3; k++) {
            put(k, random_float(-2, 2), random_float(-2, 2), random_float(-0.3f, 1.0f), random_float(-0.2f, 1.5f));
            vertices[k].value[0] = random_float(-1, 1);
        }
        oracle o = solve(vertices, SIZE, SIZE, 0);
        lom_draw_desc desc = draw_of(&values, vertices, 3);
        desc.uniforms = plus;
        begin(&s, (lom_pass_desc){ 0 });
        lom_draw(s.device, &desc);
        finish(&s);
        long double f[2][3], one[3] = { 1, 1, 1 };
        for (int k = 0; k < 3; k++) {
            f[0][k] = vertices[k].value[0];
            f[1][k] = vertices[k].position[2];
        }
        linear over_w[2] = { combine(&o, f[0]), combine(&o, f[1]) }, one_over_w = combine(&o, one);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                if (visibility(&o, x + 0.5, y + 0.5, 2.0 / 256) != 1)
                    continue;
                for (int i = 0; i < 2; i++) {
                    long double low = 1e30L, high = -1e30L;
                    for (int at = 0; at < 9; at++) { /* within a position's error */
                        double px = x + 0.5 + (at % 3 - 1) * 1.5 / 256, py = y + 0.5 + (at / 3 - 1) * 1.5 / 256;
                        long double value = value_of(&over_w[i], px, py);
                        if (i == 0)
                            value /= value_of(&one_over_w, px, py);
                        low = value < low ? value : low;
                        high = value > high ? value : high;
                    }
                    long double got = floats_at(&s, x, y)[i];
                    compared++;
                    CHECK(got >= low - 0x1p-20L && got <= high + 0x1p-20L,
                          "round %d, pixel %d,%d, value %d: %.9Lg not in %.9Lg..%.9Lg", round, x, y, i, got, low, high);
                }
            }
    }
    CHECK(compared > 100000, "%d values", compared);
    close_stage(&s);
}

/* T10: a sliver 1/512 pixel wide and 30 000 pixels long; the oracle is the exact one, of snapped positions. */
static void long_slivers_hit_only_their_centres(void)
{
    stage s = open_counting();
    int total = 0;
    for (int round = 0; round < 40; round++) {
        float lean = random_float(-0.9f, 0.9f), width = 1.0f / 512 / (SIZE / 2);
        float far = 30000.0f / SIZE;
        put(0, -far, lean * -far, 0.5f, 1);
        put(1, far, lean * far + width, 0.5f, 1);
        put(2, far, lean * far + (float)(round % 3) * width * 100, 0.5f, 1);
        snapped v[3];
        for (int k = 0; k < 3; k++)
            v[k] = snap(vertices[k].position, SIZE, SIZE);
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, &counter, plus, 1);
        finish(&s);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                total += covers(v, x, y);
                CHECK(bytes_at(&s, x, y)[0] == covers(v, x, y), "round %d: pixel %d,%d", round, x, y);
            }
    }
    CHECK(total > 0, "the slivers cover nothing");
    close_stage(&s);
}

/* T5, T6: NaN and infinite positions drop their triangle; its neighbours in the draw stay as they are. */
static void wild_positions_drop_their_triangle_alone(void)
{
    static const float wild[] = { __builtin_nanf(""), -__builtin_nanf(""), __builtin_inff(), -__builtin_inff() };
    stage s = open_counting();
    for (size_t i = 0; i < 4; i++)
        for (size_t component = 0; component < 4; component++)
            for (size_t corner = 0; corner < 3; corner++) {
                for (size_t t = 0; t < 3; t++) {
                    put(3 * t, -1, -1, 0.5f, 1);
                    put(3 * t + 1, 3, -1, 0.5f, 1);
                    put(3 * t + 2, -1, 3, 0.5f, 1);
                }
                vertices[3 + corner].position[component] = wild[i];
                begin(&s, (lom_pass_desc){ 0 });
                draw_counting(&s, &counter, plus, 3);
                finish(&s);
                for (int p = 0; p < SIZE * SIZE; p++)
                    CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == 2, "%f in component %zu of corner %zu",
                          (double)wild[i], component, corner);
            }
    close_stage(&s);
}

/* T17, T20: a plane of many triangles in perspective, cut by near, far, the sides of the guard band and by w = 0: no
 * pixel twice, and none of the plane's missing; the camera above it, and exactly on it. */
static void a_plane_under_the_camera_is_whole(void)
{
    enum { N = 20 };
    stage s = open_counting();
    for (int round = 0; round < 30; round++) {
        float height = round % 10 == 9 ? 0.0f : random_float(0.001f, 2.0f), reach = round % 2 ? 1e5f : 20.0f;
        float pitch = random_float(-0.3f, 0.3f), sine = random_float(-1, 1), cosine = random_float(-1, 1);
        float near = 0.1f;
        size_t n = 0;
        vertex grid[N + 1][N + 1];
        for (int j = 0; j <= N; j++)
            for (int i = 0; i <= N; i++) {
                float a = (float)(2 * i - N) / N * reach, b = (float)(2 * j - N) / N * reach;
                float x = a * cosine - b * sine, z = a * sine + b * cosine, y = -height;
                float forward = z + pitch * y, up = y - pitch * z;
                put(0, x, up, near, forward); /* reversed, infinite far plane: depth near / w */
                grid[j][i] = vertices[0];
            }
        for (int j = 0; j < N; j++)
            for (int i = 0; i < N; i++) {
                const vertex *quad[] = { &grid[j][i],     &grid[j + 1][i], &grid[j][i + 1],
                                         &grid[j][i + 1], &grid[j + 1][i], &grid[j + 1][i + 1] };
                for (int k = 0; k < 6; k++)
                    vertices[n++] = *quad[k];
            }
        static int expected[SIZE][SIZE];
        memset(expected, 0, sizeof expected);
        for (size_t t = 0; t < n / 3; t++) {
            oracle o = solve(&vertices[3 * t], SIZE, SIZE, 0);
            for (int y = 0; y < SIZE; y++)
                for (int x = 0; x < SIZE; x++) { /* 256: open, unless another triangle surely has it */
                    int visible = visibility(&o, x + 0.5, y + 0.5, 2.0 / 256);
                    expected[y][x] += visible < 0 ? 256 : visible;
                }
        }
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, &counter, plus, n / 3);
        finish(&s);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                int hits = bytes_at(&s, x, y)[0];
                CHECK(height == 0 || hits <= 1, "round %d: pixel %d,%d has %d hits", round, x, y, hits);
                CHECK(height == 0 || expected[y][x] >= 256 || hits == expected[y][x],
                      "round %d: pixel %d,%d has %d hits, not %d", round, x, y, hits, expected[y][x]);
            }
    }
    close_stage(&s);
}

/* T12: frames of one pixel, one row, one column. */
static void narrow_frames(void)
{
    static const int sizes[][2] = { { 1, 1 }, { 32768, 1 }, { 1, 32768 } };
    for (int i = 0; i < 3; i++) {
        int width = sizes[i][0], height = sizes[i][1];
        stage s = open_stage((lom_device_desc){ .threads = 1 }, width, height, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
        for (int half = 0; half < 2; half++) { /* two triangles are a quad over everything: each pixel once */
            put((size_t)half * 3, -1.5f, -1.5f, 0.5f, 1);
            put((size_t)half * 3 + 1, 1.5f, 1.5f, 0.5f, 1);
            put((size_t)half * 3 + 2, half ? 1.5f : -1.5f, half ? -1.5f : 1.5f, 0.5f, 1);
        }
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, &counter, plus, 2);
        finish(&s);
        for (int p = 0; p < width * height; p++)
            CHECK(bytes_at(&s, p % width, p / width)[0] == 1, "%dx%d: pixel %d has %d hits", width, height, p,
                  bytes_at(&s, p % width, p / width)[0]);
        close_stage(&s);
    }
}

int main(int argc, char **argv)
{
    RUN(extreme_triangles_are_clipped);
    RUN(random_triangles_equal_the_homogeneous_oracle);
    RUN(clipping_leaves_vertices_inside_as_they_are);
    RUN(clipped_values_are_those_of_the_whole);
    RUN(long_slivers_hit_only_their_centres);
    RUN(wild_positions_drop_their_triangle_alone);
    RUN(a_plane_under_the_camera_is_whole);
    RUN(narrow_frames);
    return check_result();
}
