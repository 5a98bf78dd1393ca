/* Proves the rasterizer's exactness at this width against an oracle (tests/oracle): scalar, 128-bit, no tiles, no lanes.
 * Positions are chosen so that clip coordinates are exact and the snapped position is known without rounding: the frame
 * is 128 x 128, so a window unit (1/256 pixel) is 2^-14 of the clip volume. */
#include <lom/pipeline.h>

#include "check.h"
#include "oracle/interpolation.h"

enum { SIZE = 128, UNITS = SIZE * 256, MESH = 24 };

/* ---- shaders ---- */

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const float *sign = uniforms;
    out->position = in->attribute[0];
    out->varying[0] = in->attribute[1].x;
    out->varying[1] = in->attribute[1].y;
    for (int i = 0; i < 8; i++)
        out->distance[i] = (&in->attribute[2 + i / 4].x)[i % 4] * sign[i];
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
    out->color[0] = (lom_float4){ in->varying[0], in->varying[1], in->w, in->z };
}

LOM_SHADER(counter, place, count, .attributes = 2, .varyings = 2, .colors = 1, .uniforms_size = 32)
LOM_SHADER(clipped, place, count, .attributes = 4, .varyings = 2, .clip_distances = 8, .colors = 1, .uniforms_size = 32)
LOM_SHADER(values, place, show, .attributes = 2, .varyings = 2, .reads = LOM_VARYINGS(0, 2), .reads_position = true,
           .colors = 1, .uniforms_size = 32)

static const float plus[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };

/* ---- the scene of a test ---- */

typedef struct point {
    int64_t x, y; /* window units, y down */
    double w, f[2];
    float distance[8];
} point;

typedef struct stage {
    lom_device *device;
    lom_texture *color;
    lom_image *image;
} stage;

static stage open_stage(lom_device_desc desc, lom_format format)
{
    desc.lanes = LOM_LANES;
#ifdef LOM_LOWERED
    desc.plain = true;
#endif
    stage s = { lom_open_device(&desc), NULL, NULL };
    s.color = lom_make_texture(s.device, &(lom_texture_desc){ .width = SIZE, .height = SIZE, .format = format });
    return s;
}

static void close_stage(stage *s)
{
    lom_free_image(s->image);
    lom_close_device(s->device);
}

static float vertices[16384][18];

static void put_vertex(int i, const point *p)
{
    float *v = vertices[i];
    v[0] = (float)((double)p->x / (UNITS / 2) - 1) * (float)p->w;
    v[1] = (float)(1 - (double)p->y / (UNITS / 2)) * (float)p->w;
    v[2] = 0.5f * (float)p->w;
    v[3] = (float)p->w;
    v[4] = (float)p->f[0];
    v[5] = (float)p->f[1];
    memcpy(v + 6, p->distance, sizeof p->distance);
}

static void draw(stage *s, const lom_shader *shader, const float *signs, int triangles, bool add)
{
    size_t size = sizeof vertices, stride = sizeof vertices[0];
    lom_draw_desc desc = { .shader = shader,
                           .uniforms = signs,
                           .attribute = { { vertices, size, stride, LOM_ATTRIBUTE_FLOAT4 },
                                          { &vertices[0][4], size - 16, stride, LOM_ATTRIBUTE_FLOAT2 },
                                          { &vertices[0][6], size - 24, stride, LOM_ATTRIBUTE_FLOAT4 },
                                          { &vertices[0][10], size - 40, stride, LOM_ATTRIBUTE_FLOAT4 } },
                           .count = 3 * (size_t)triangles };
    if (add)
        desc.blend[0] = (lom_blend){ .enabled = true,
                                     .source_color = LOM_FACTOR_ONE,
                                     .target_color = LOM_FACTOR_ONE,
                                     .source_alpha = LOM_FACTOR_ONE,
                                     .target_alpha = LOM_FACTOR_ONE };
    lom_draw(s->device, &desc);
}

static void finish(stage *s)
{
    CHECK(lom_end_pass(s->device), "%s", lom_device_error(s->device)->text);
    lom_free_image(s->image);
    s->image = lom_read_texture(s->color, 0, 0, NULL);
}

static int hits_at(const stage *s, int x, int y)
{
    return ((const uint8_t *)lom_image_pixel(s->image, x, y, 0))[0];
}

static void snapped_of(const point p[3], snapped v[3])
{
    for (int k = 0; k < 3; k++)
        v[k] = (snapped){ p[k].x, p[k].y };
}

static uint64_t draws; /* counter of the random numbers */

static int64_t uniform(int64_t low, int64_t high)
{
    return low + (int64_t)(lom_random_bits(11, draws++) % (uint64_t)(high - low + 1));
}

/* Kinds of triangle: small, sliver, on centres, large, far beyond the frame. */
static void make_triangle(int kind, point p[3])
{
    static const int64_t reach[] = { 1200, 6000, 12, 40000, 2000000 };
    int64_t cx = uniform(-2000, UNITS + 2000), cy = uniform(-2000, UNITS + 2000);
    for (int k = 0; k < 3; k++) {
        p[k] = (point){ .w = 1 };
        int64_t dx = uniform(-reach[kind], reach[kind]), dy = uniform(-reach[kind], reach[kind]);
        p[k].x = kind == 2 ? (cx / 256 + dx) * 256 + 128 : cx + dx;
        p[k].y = kind == 2 ? (cy / 256 + dy) * 256 + 128 : cy + dy;
    }
    if (kind == 1) { /* all but collinear */
        p[2].x = (p[0].x + p[1].x) / 2 + uniform(-2, 2);
        p[2].y = (p[0].y + p[1].y) / 2 + uniform(-2, 2);
    }
}

static int64_t limit(int64_t pixel)
{
    return pixel < 0 ? 0 : pixel > SIZE ? SIZE : pixel;
}

static void add_hits(int hits[SIZE][SIZE], const point p[3])
{
    int64_t x0 = p[0].x, x1 = x0, y0 = p[0].y, y1 = y0;
    for (int k = 1; k < 3; k++) {
        x0 = p[k].x < x0 ? p[k].x : x0;
        x1 = p[k].x > x1 ? p[k].x : x1;
        y0 = p[k].y < y0 ? p[k].y : y0;
        y1 = p[k].y > y1 ? p[k].y : y1;
    }
    snapped v[3];
    snapped_of(p, v);
    for (int64_t y = limit(y0 / 256 - 1); y < limit(y1 / 256 + 2); y++)
        for (int64_t x = limit(x0 / 256 - 1); x < limit(x1 / 256 + 2); x++)
            hits[y][x] += covers(v, (int)x, (int)y);
}

static void coverage_equals_the_oracle(void)
{
    static int hits[SIZE][SIZE];
    static const int counts[] = { 200, 200, 200, 60, 30 }; /* triangles a pass: at most 255 hits a pixel */
    static const int passes[] = { 500, 300, 500, 20, 10 };
    stage s = open_stage((lom_device_desc){ .threads = 2, .tile = 32 }, LOM_FORMAT_RGBA8);
    for (int kind = 0; kind < 5; kind++)
        for (int pass = 0; pass < passes[kind]; pass++) {
            memset(hits, 0, sizeof hits);
            for (int t = 0; t < counts[kind]; t++) {
                point p[3];
                make_triangle(kind, p);
                for (int k = 0; k < 3; k++)
                    put_vertex(3 * t + k, &p[k]);
                add_hits(hits, p);
            }
            lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color } });
            draw(&s, &counter, plus, counts[kind], true);
            finish(&s);
            for (int y = 0; y < SIZE; y++)
                for (int x = 0; x < SIZE; x++)
                    CHECK(hits_at(&s, x, y) == hits[y][x], "kind %d, pass %d, pixel %d,%d: %d hits, not %d", kind, pass,
                          x, y, hits_at(&s, x, y), hits[y][x]);
        }
    close_stage(&s);
}

/* A mesh over the whole frame whose inner vertices are moved at random; its triangles share all their edges. */
static int make_mesh(void)
{
    static point grid[MESH + 1][MESH + 1];
    int n = 0;
    for (int j = 0; j <= MESH; j++)
        for (int i = 0; i <= MESH; i++) {
            int64_t step = (UNITS + 2048) / MESH,
                    wobble = i % MESH == 0 || j % MESH == 0 ? 0 : step / 5; /* too little to fold */
            grid[j][i] = (point){ i * step - 1024 + uniform(-wobble, wobble),
                                  j * step - 1024 + uniform(-wobble, wobble),
                                  1,
                                  { 0, 0 },
                                  { 0 } };
            for (int k = 0; k < 8; k++)
                grid[j][i].distance[k] = (float)uniform(-1000, 1000) * 0.37f;
        }
    for (int j = 0; j < MESH; j++)
        for (int i = 0; i < MESH; i++) {
            const point *quad[] = { &grid[j][i],     &grid[j + 1][i], &grid[j][i + 1],
                                    &grid[j][i + 1], &grid[j + 1][i], &grid[j + 1][i + 1] };
            for (int k = 0; k < 6; k++)
                put_vertex(n++, quad[k]);
        }
    return n / 3;
}

static void check_every_pixel_once(const stage *s, const char *what, int round)
{
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            CHECK(hits_at(s, x, y) == 1, "%s, round %d: pixel %d,%d has %d hits", what, round, x, y, hits_at(s, x, y));
}

static void shared_edges_are_hit_exactly_once(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 2 }, LOM_FORMAT_RGBA8);
    for (int round = 0; round < 40; round++) {
        int triangles = make_mesh();
        lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color } });
        draw(&s, &counter, plus, triangles, true);
        finish(&s);
        check_every_pixel_once(&s, "mesh", round);
    }
    close_stage(&s);
}

/* For 1 to 8 planes: every combination of signs keeps its own part, and the parts are the whole. */
static void clip_distances_are_complementary(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 2 }, LOM_FORMAT_RGBA8);
    for (int planes = 1; planes <= 4; planes++)
        for (int round = 0; round < 6; round++) {
            int triangles = make_mesh();
            for (int i = 0; i < 3 * triangles; i++)
                for (int k = planes; k < 8; k++)
                    vertices[i][6 + k] = 1;
            lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color } });
            for (int signs = 0; signs < 1 << planes; signs++) {
                float sign[8];
                for (int k = 0; k < 8; k++)
                    sign[k] = k < planes && (signs >> k & 1) ? -1.0f : 1.0f;
                draw(&s, &clipped, sign, triangles, true);
            }
            finish(&s);
            check_every_pixel_once(&s, "complement", planes * 100 + round);
        }
    close_stage(&s);
}

/* ---- interpolation ---- */

/* Within 8 units of 2^-24 of the largest value, for ratios of w up to 2^20, and inside the hull of the vertices. */
static void interpolation_keeps_its_bound(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, LOM_FORMAT_RGBA32F);
    double worst = 0;
    for (int round = 0; round < 300; round++) {
        point p[3];
        double low[2] = { 1e9, 1e9 }, high[2] = { -1e9, -1e9 };
        make_triangle(round % 3 == 0 ? 0 : 3, p);
        for (int k = 0; k < 3; k++) {
            p[k].w = (double)(UINT64_C(1) << uniform(0, 5 * (round % 5)));
            for (int f = 0; f < 2; f++) {
                p[k].f[f] = (double)(float)(uniform(-1000000, 1000000) * 1e-3);
                low[f] = p[k].f[f] < low[f] ? p[k].f[f] : low[f];
                high[f] = p[k].f[f] > high[f] ? p[k].f[f] : high[f];
            }
            put_vertex(k, &p[k]);
        }
        lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color } });
        draw(&s, &values, plus, 1, false);
        finish(&s);
        snapped v[3];
        snapped_of(p, v);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                if (!covers(v, x, y))
                    continue;
                double weight[3];
                weights_at(v, (double[3]){ p[0].w, p[1].w, p[2].w }, 256.0 * x + 128, 256.0 * y + 128, weight);
                const float *pixel = lom_image_pixel(s.image, x, y, 0);
                for (int f = 0; f < 2; f++) {
                    double scale = high[f] > -low[f] ? high[f] : -low[f];
                    double exact = weighted(weight, (double[3]){ p[0].f[f], p[1].f[f], p[2].f[f] });
                    double error = (pixel[f] > exact ? pixel[f] - exact : exact - pixel[f]) / scale * 0x1p24;
                    worst = error > worst ? error : worst;
                    CHECK(error <= 8, "round %d, pixel %d,%d: %.9g, not %.9g: %.2f units", round, x, y, pixel[f], exact,
                          error);
                    CHECK(pixel[f] >= low[f] && pixel[f] <= high[f], "round %d: outside the hull", round);
                }
            }
    }
    printf("  largest error %.2f units of 2^-24 of the largest value\n", worst);
    close_stage(&s);
}

/* Blended, overlapping triangles: their order is submission order whatever shares a packet, a tile or a worker. */
static void order_does_not_depend_on_the_machine(void)
{
    static const lom_device_desc desc[] = { { .threads = 1, .tile = 64 },
                                            { .threads = 3, .tile = 16, .chunk = 16, .batch = 1 },
                                            { .threads = 2, .tile = 32, .chunk = 100, .batch = 3 },
                                            { .threads = 5, .tile = 64, .chunk = 17, .batch = 32 } };
    uint64_t first = 0;
    for (int i = 0; i < 4; i++) {
        stage s = open_stage(desc[i], LOM_FORMAT_RGBA8);
        draws = 0;
        for (int t = 0; t < 3000; t++) {
            point p[3];
            make_triangle(t % 7 == 0 ? 3 : 0, p);
            for (int k = 0; k < 3; k++) {
                p[k].f[0] = (double)uniform(0, 255) / 255;
                p[k].f[1] = (double)uniform(0, 255) / 255;
                put_vertex(3 * t + k, &p[k]);
            }
        }
        lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color } });
        lom_draw(s.device,
                 &(lom_draw_desc){ .shader = &values,
                                   .uniforms = plus,
                                   .attribute = { { vertices, sizeof vertices, 72, LOM_ATTRIBUTE_FLOAT4 },
                                                  { &vertices[0][4], sizeof vertices - 16, 72, LOM_ATTRIBUTE_FLOAT2 } },
                                   .count = 9000,
                                   .blend = { { .enabled = true,
                                                .source_color = LOM_FACTOR_SOURCE_ALPHA,
                                                .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                                .source_alpha = LOM_FACTOR_ONE } } });
        finish(&s);
        uint64_t hash = lom_hash_image(s.image);
        first = i == 0 ? hash : first;
        CHECK(hash == first, "device %d: %016llx, not %016llx", i, (unsigned long long)hash, (unsigned long long)first);
        close_stage(&s);
    }
}

static void put_clip(int i, float x, float y, float z, float w)
{
    memset(vertices[i], 0, sizeof vertices[i]);
    vertices[i][0] = x;
    vertices[i][1] = y;
    vertices[i][2] = z;
    vertices[i][3] = w;
}

/* NaN and infinite positions drop their triangle and nothing else; huge and tiny finite ones stay defined. */
static void wild_positions_are_harmless(void)
{
    const float nan = __builtin_nanf(""), infinity = __builtin_inff(), huge = 0x1p124f;
    const float wild[][4] = { { nan, 0, 0.5f, 1 },    { 0, nan, 0.5f, 1 },    { 0, 0, nan, 1 },
                              { 0, 0, 0.5f, nan },    { infinity, 0, 0, 1 },  { 0, 0, 0.5f, infinity },
                              { 0, 0, 0.5f, 1e-38f }, { 1, 0, 0, 1e-45f },    { 1, 0, 0.5f, 0 },
                              { 0, 0, 0.5f, -1 },     { huge, huge, 0, huge } };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, LOM_FORMAT_RGBA8);
    for (size_t i = 0; i < sizeof wild / sizeof wild[0]; i++) {
        put_clip(0, wild[i][0], wild[i][1], wild[i][2], wild[i][3]);
        put_clip(1, 0.2f, 0.1f, 0.5f, 1);
        put_clip(2, -0.3f, 0.4f, 0.5f, 1);
        put_clip(3, -1, -1, 0.5f, 1);
        put_clip(4, 3, -1, 0.5f, 1);
        put_clip(5, -1, 3, 0.5f, 1);
        lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color } });
        draw(&s, &counter, plus, 2, true);
        finish(&s);
        int most = i < 6 ? 1 : 2;
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++)
                CHECK(hits_at(&s, x, y) >= 1 && hits_at(&s, x, y) <= most, "case %zu: pixel %d,%d has %d hits", i, x, y,
                      hits_at(&s, x, y));
    }
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(coverage_equals_the_oracle);
    RUN(shared_edges_are_hit_exactly_once);
    RUN(clip_distances_are_complementary);
    RUN(interpolation_keeps_its_bound);
    RUN(order_does_not_depend_on_the_machine);
    RUN(wild_positions_are_harmless);
    return check_result();
}
