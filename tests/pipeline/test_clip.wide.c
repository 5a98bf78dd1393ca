/* Proves clipping at this width (T1..T17, T20): against near, far, w > 0 and the guard band, and by clip and cull
 * distances. The oracle clips nothing: the weights of a pixel are solved from the homogeneous positions (Olano and
 * Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997), so every condition of being visible is a
 * linear function of the window position. Pixels further than a pixel's 1/256 from every zero line must agree. */
#include "stage.h"

#include "base/reserve.h"
#include "pipeline/project.h"
#include "pipeline/variants.h"

enum { SIZE = 96, MAX_CONDITIONS = 13 };

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const float *sign = uniforms;
    out->position = in->attribute[0];
    out->varying[0] = in->attribute[1].x;
    for (int i = 0; i < 8; i++)
        out->distance[i] = (&in->attribute[3 + i / 4].x)[i % 4] * sign[i];
}

static void count(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    lom_float one = lom_splat(1.0f / 255.0f);
    out->color[0] = (lom_float4){ one, one, one, one };
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0], in->z, in->w, lom_splat(1.0f) };
}

LOM_SHADER(counter, place, count, .attributes = 5, .colors = 1, .uniforms_size = 32)
LOM_SHADER(clipped, place, count, .attributes = 5, .clip_distances = 8, .colors = 1, .uniforms_size = 32)
LOM_SHADER(culled, place, count, .attributes = 5, .cull_distances = 8, .colors = 1, .uniforms_size = 32)
LOM_SHADER(values, place, show, .attributes = 5, .varyings = 1, .reads = 1u << 0, .reads_position = true, .colors = 1,
           .uniforms_size = 32)

static const float plus[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };
static vertex vertices[16384];

static void draw_counting(stage *s, const lom_shader *shader, const float *signs, size_t triangles)
{
    lom_draw_desc desc = draw_of(shader, vertices, 3 * triangles);
    desc.uniforms = signs;
    desc.blend[0] = adding();
    lom_draw(s->device, &desc);
}

static void put(size_t i, float x, float y, float z, float w)
{
    vertices[i] = (vertex){ .position = { x, y, z, w }, .distance = { 1, 1, 1, 1, 1, 1, 1, 1 } };
}

/* ---- the oracle ---- */

typedef struct linear { /* x X + y Y + c of the pixel's window position; visible where >= 0 */
    long double x, y, c;
    long double noise; /* of float arithmetic on it */
} linear;

typedef struct oracle {
    linear condition[MAX_CONDITIONS];
    int conditions;
    linear weight[3]; /* of the vertices, so that their sum weighted by w is 1 */
    bool empty;       /* edge-on */
} oracle;

static linear combine(const oracle *o, const long double f[3])
{
    linear sum = { 0 };
    for (int k = 0; k < 3; k++) {
        sum.x += o->weight[k].x * f[k];
        sum.y += o->weight[k].y * f[k];
        sum.c += o->weight[k].c * f[k];
    }
    return sum;
}

static void add_condition(oracle *o, linear condition)
{
    o->condition[o->conditions++] = condition;
}

/* Rows of the inverse of the matrix of the three (x, y, w), with x and y in pixels; then near, far and distances. */
static oracle solve(const vertex *v, int width, int height, int distances)
{
    oracle o = { .empty = false };
    long double p[3][3];
    for (int k = 0; k < 3; k++) {
        long double w = v[k].position[3];
        p[k][0] = (v[k].position[0] + w) * width / 2;
        p[k][1] = (w - v[k].position[1]) * height / 2;
        p[k][2] = w;
    }
    long double cross[3][3], det = 0;
    for (int k = 0; k < 3; k++) {
        const long double *a = p[(k + 1) % 3], *b = p[(k + 2) % 3];
        for (int i = 0; i < 3; i++)
            cross[k][i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
    for (int i = 0; i < 3; i++)
        det += p[0][i] * cross[0][i];
    o.empty = det == 0;
    for (int k = 0; k < 3 && !o.empty; k++) {
        o.weight[k] = (linear){ cross[k][0] / det, cross[k][1] / det, cross[k][2] / det, 0 };
        add_condition(&o, o.weight[k]);
    }
    long double near[3], far[3];
    for (int k = 0; k < 3; k++) {
        near[k] = (long double)v[k].position[3] - v[k].position[2];
        far[k] = v[k].position[2];
    }
    add_condition(&o, combine(&o, near));
    add_condition(&o, combine(&o, far));
    for (int i = 0; i < distances; i++) {
        long double d[3], largest = 0;
        for (int k = 0; k < 3; k++) {
            d[k] = v[k].distance[i];
            long double size = __builtin_fabsl(d[k] / v[k].position[3]);
            largest = size > largest ? size : largest;
        }
        linear condition = combine(&o, d);
        condition.noise = largest * 0x1p-21L;
        add_condition(&o, condition);
    }
    return o;
}

static long double value_of(const linear *f, double x, double y)
{
    return f->x * x + f->y * y + f->c;
}

/* 1 visible, 0 not, -1 within `slack` pixels of a zero line that decides. */
static int visibility(const oracle *o, double x, double y, double slack)
{
    int result = 1;
    for (int i = 0; i < o->conditions; i++) {
        const linear *f = &o->condition[i];
        long double slope = __builtin_sqrtl(f->x * f->x + f->y * f->y);
        long double value = value_of(f, x, y), margin = slope * slack + f->noise;
        if (value < -margin)
            return 0;
        if (value <= margin)
            result = -1;
    }
    return o->empty ? 0 : result;
}

/* Draws the first triangle alone and compares; how many pixels the oracle left open. */
static int compare_triangle(stage *s, const lom_shader *shader, int distances, const char *what, int round)
{
    int open = 0;
    oracle o = solve(vertices, SIZE, SIZE, distances);
    begin(s, (lom_pass_desc){ 0 });
    draw_counting(s, shader, plus, 1);
    finish(s);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            int expected = visibility(&o, x + 0.5, y + 0.5, 1.5 / 256), hits = bytes_at(s, x, y)[0];
            open += expected < 0;
            CHECK(hits <= 1 && (expected < 0 || hits == expected), "%s %d: pixel %d,%d has %d hits, not %d", what,
                  round, x, y, hits, expected);
        }
    return open;
}

static stage open_counting(void)
{
    return open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
}

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
    draw.uniforms = plus;
    for (int round = 0; round < 20000; round++) {
        struct lom_pass pass = { .desc = { .max_depth = 1 } };
        pass.viewport = (lom_rect){ 0, 0, (int)random_whole(1, 4000), (int)random_whole(1, 4000) };
        put_at_the_guard_band(lom_guard_of(&pass));
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
              round, (double)p[0], (double)p[1], (double)p[3], pass.viewport.width, pass.viewport.height,
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

/* ---- clip and cull distances ---- */

/* T13: each of 1 to 8 distances crosses; coverage is the intersection of the half planes. */
static void distances_intersect(void)
{
    stage s = open_counting();
    int64_t open = 0;
    for (int round = 0; round < 300; round++) {
        int planes = round % 8 + 1;
        for (size_t k = 0; k < 3; k++) {
            float w = random_float(0.5f, 2.0f);
            put(k, random_float(-1.5f, 1.5f) * w, random_float(-1.5f, 1.5f) * w, 0.5f * w, w);
            for (int i = 0; i < planes; i++)
                vertices[k].distance[i] = random_float(-0.4f, 1.0f);
        }
        open += compare_triangle(&s, &clipped, 8, "distances", round);
    }
    CHECK(open < 300 * SIZE * SIZE / 50, "%lld pixels left open", (long long)open);
    close_stage(&s);
}

/* T13 with the clip volume: distances of triangles that near, far and the guard band cut as well. */
static void distances_intersect_the_clip_volume(void)
{
    stage s = open_counting();
    for (int round = 0; round < 200; round++) {
        float r = round % 2 ? 3.0f : 1000.0f;
        for (size_t k = 0; k < 3; k++) {
            put(k, random_float(-r, r), random_float(-r, r), random_float(-0.2f, 1.2f), random_float(0.2f, 1.5f));
            for (int i = 0; i < 3; i++)
                vertices[k].distance[i] = random_float(-0.4f, 1.0f);
        }
        compare_triangle(&s, &clipped, 8, "both", round);
    }
    close_stage(&s);
}

static size_t make_mesh(int n, int planes, int kind)
{
    vertex grid[17][17];
    size_t count = 0;
    for (int j = 0; j <= n; j++)
        for (int i = 0; i <= n; i++) {
            bool inner = i > 0 && j > 0 && i < n && j < n;
            float wobble = inner ? 0.25f : 0.0f, w = random_float(0.25f, 4.0f);
            float x = ((float)i + random_float(-wobble, wobble)) * 2.2f / (float)n - 1.1f;
            float y = ((float)j + random_float(-wobble, wobble)) * 2.2f / (float)n - 1.1f;
            put(0, x * w, y * w, 0.5f * w, w);
            for (int p = 0; p < planes; p++) {
                float d = random_float(-1, 1);
                if (kind == 1) /* T14: exactly on the plane at many vertices */
                    d = (float)random_whole(-1, 1);
                if (kind == 2) /* so small that the products with 1/w vanish */
                    d = (float)random_whole(-3, 3) * 0x1p-149f;
                if (kind == 3)
                    d = d * 0x1p120f;
                vertices[0].distance[p] = d;
            }
            grid[j][i] = vertices[0];
        }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const vertex *quad[] = { &grid[j][i],     &grid[j + 1][i], &grid[j][i + 1],
                                     &grid[j][i + 1], &grid[j + 1][i], &grid[j + 1][i + 1] };
            for (int k = 0; k < 6; k++)
                vertices[count++] = *quad[k];
        }
    return count / 3;
}

/* A triangle whose vertices all lie in a plane is kept by d and by -d (T14 exempts it): move it off the plane. */
static void leave_planes(size_t triangles, int planes)
{
    for (size_t t = 0; t < triangles; t++)
        for (int p = 0; p < planes; p++) {
            vertex *v = &vertices[3 * t];
            if (v[0].distance[p] == 0 && v[1].distance[p] == 0 && v[2].distance[p] == 0)
                v[0].distance[p] = v[1].distance[p] = v[2].distance[p] = 1;
        }
}

/* T15: for 1 to 8 planes, all combinations of signs share the pixels of a mesh exactly. */
static void all_signs_of_distances_share_every_pixel(void)
{
    stage s = open_counting();
    for (int kind = 0; kind < 4; kind++)
        for (int planes = 1; planes <= 8; planes++) {
            size_t triangles = make_mesh(6, planes, kind);
            leave_planes(triangles, planes);
            begin(&s, (lom_pass_desc){ 0 });
            for (int signs = 0; signs < 1 << planes; signs++) {
                float sign[8];
                for (int i = 0; i < 8; i++)
                    sign[i] = i < planes && (signs >> i & 1) ? -1.0f : 1.0f;
                draw_counting(&s, &clipped, sign, triangles);
            }
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++)
                CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == 1, "kind %d, %d planes: pixel %d,%d has %d hits", kind,
                      planes, p % SIZE, p / SIZE, bytes_at(&s, p % SIZE, p / SIZE)[0]);
        }
    close_stage(&s);
}

/* T14, T16: distances of 0 keep, of NaN drop the triangle, infinite ones clip like huge ones. */
static void special_distances(void)
{
    const float nan = __builtin_nanf(""), inf = __builtin_inff();
    static const int whole = -1;
    const struct {
        float d[3];
        int hits; /* of every pixel; -1: between none and all */
    } table[] = { { { 0, 0, 0 }, 1 },          { { -0.0f, -0.0f, -0.0f }, 1 }, { { 0, 0, 1 }, 1 },
                  { { 0, 1, 1 }, 1 },          { { nan, 1, 1 }, 0 },           { { 1, 1, -nan }, 0 },
                  { { inf, inf, inf }, 1 },    { { inf, 1, 0 }, 1 },           { { -inf, -inf, -1 }, 0 },
                  { { -inf, inf, 1 }, whole }, { { 1, -inf, 1 }, whole } };
    stage s = open_counting();
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        for (int rotation = 0; rotation < 3; rotation++) {
            int total = 0;
            put(0, -1, -1, 0.5f, 1);
            put(1, 3, -1, 0.5f, 1);
            put(2, -1, 3, 0.5f, 1);
            for (int k = 0; k < 3; k++)
                vertices[k].distance[rotation] = table[i].d[(k + rotation) % 3];
            begin(&s, (lom_pass_desc){ 0 });
            draw_counting(&s, &clipped, plus, 1);
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++) {
                int hits = bytes_at(&s, p % SIZE, p / SIZE)[0];
                total += hits;
                CHECK(table[i].hits < 0 || hits == table[i].hits, "case %zu: %d hits", i, hits);
            }
            CHECK(table[i].hits >= 0 || total < SIZE * SIZE, "case %zu: all pixels kept", i);
        }
    close_stage(&s);
}

/* A triangle goes when one cull distance is negative at all three vertices; otherwise all of it stays. */
static void cull_distances_drop_whole_triangles(void)
{
    stage s = open_counting();
    for (int round = 0; round < 64; round++) {
        size_t plane = (size_t)(round / 8);
        put(0, -1, -1, 0.5f, 1);
        put(1, 3, -1, 0.5f, 1);
        put(2, -1, 3, 0.5f, 1);
        for (int k = 0; k < 3; k++)
            vertices[k].distance[plane] = round >> k & 1 ? -0.5f : 0.0f;
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, &culled, plus, 1);
        finish(&s);
        for (int p = 0; p < SIZE * SIZE; p++)
            CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == (round % 8 != 7), "round %d", round);
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
    RUN(distances_intersect);
    RUN(distances_intersect_the_clip_volume);
    RUN(all_signs_of_distances_share_every_pixel);
    RUN(special_distances);
    RUN(cull_distances_drop_whole_triangles);
    RUN(narrow_frames);
    return check_result();
}
