/* Proves what a depth attachment holds at this width (Z1, Z3..Z6, T11, T12): depths rounded to the format, decals,
 * ranges, what shaders write, and the depth bias by its formula. Expected values come from double arithmetic on the
 * depths that the same triangles have without a bias. */
#include "stage.h"

enum { SIZE = 64 };

struct settings {
    float low, high; /* depths that the shader writes: from left to right */
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    out->varying[0] = in->attribute[1].x;
}

static void add_one(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    lom_float one = lom_splat(1.0f / 255.0f);
    out->color[0] = (lom_float4){ one, one, one, one };
}

static void write_depth(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct settings *settings = uniforms;
    lom_float one = lom_splat(1.0f / 255.0f);
    out->color[0] = (lom_float4){ one, one, one, one };
    out->depth = lom_splat(settings->low) + (settings->high - settings->low) * in->varying[0];
}

LOM_SHADER(counter, place, add_one, .attributes = 1, .colors = 1)
LOM_SHADER(writer, place, write_depth, .attributes = 2, .varyings = 1, .reads = 1u << 0, .writes_depth = true,
           .colors = 1, .uniforms_size = sizeof(struct settings))
LOM_SHADER(numbers, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_DEPTH_SHADER(depth_only, place, .attributes = 1)

static const lom_format formats[] = { LOM_FORMAT_DEPTH16, LOM_FORMAT_DEPTH24, LOM_FORMAT_DEPTH32F };
static const double steps[] = { 65535, 16777215, 0 };
enum { FORMATS = 3 };

static vertex vertices[12];

/* A vertex at window position (x, y), of depth z. */
static void put(size_t i, float x, float y, float z)
{
    vertices[i] = (vertex){ .position = { x / (SIZE / 2) - 1, 1 - y / (SIZE / 2), z, 1 } };
}

/* The whole window, depth from left to right and from top to bottom: z + dx x + dy y; cut by either diagonal. */
static void put_window(float z, float dx, float dy, bool other)
{
    static const float corner[2][6][2] = { { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 1, 0 } },
                                           { { 0, 0 }, { 0, 1 }, { 1, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 } } };
    for (size_t i = 0; i < 6; i++) {
        float x = corner[other][i][0] * SIZE, y = corner[other][i][1] * SIZE;
        put(i, x, y, z + dx * x + dy * y);
        vertices[i].value[0] = corner[other][i][0];
    }
}

static stage open_depth(int format)
{
    return open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, formats[format]);
}

/* The depth of a pixel in the attachment's units, or as it is. */
static double depth_at(const stage *s, int format, int x, int y)
{
    const void *texel = lom_image_pixel(s->depths, x, y, 0);
    if (format == 0)
        return *(const uint16_t *)texel;
    return format == 1 ? (double)*(const uint32_t *)texel : (double)*(const float *)texel;
}

static void draw_depths(stage *s, size_t count, lom_draw_desc bias)
{
    lom_draw_desc desc = draw_of(&depth_only, vertices, count);
    desc.depth_compare = LOM_COMPARE_ALWAYS;
    desc.depth_bias = bias.depth_bias;
    desc.depth_bias_slope = bias.depth_bias_slope;
    desc.depth_bias_clamp = bias.depth_bias_clamp;
    begin(s, (lom_pass_desc){ 0 });
    lom_draw(s->device, &desc);
    finish(s);
}

static double clamped(double x, double low, double high)
{
    return x < low ? low : x > high ? high : x;
}

/* ---- formats ---- */

/* Z3: depths next to the ends and to the half-way points are rounded to the nearest step, and 1 does not wrap. */
static void z3_depths_are_rounded_to_nearest(void)
{
    static const float depths[] = { 0,           0x1p-149f,   1e-30f, 0x1p-26f, 0.49999997f,     0.5f,
                                    0.50000006f, 0.99999994f, 1,      -0.0f,    0.5f / 16777215, 0.99999237f };
    for (int f = 0; f < FORMATS; f++) {
        stage s = open_depth(f);
        for (size_t i = 0; i < sizeof depths / sizeof depths[0]; i++) {
            put_window(depths[i], 0, 0, false);
            draw_depths(&s, 6, (lom_draw_desc){ 0 });
            double exact = (double)depths[i] * (f == 2 ? 1 : steps[f]), got = depth_at(&s, f, 9, 40);
            CHECK(f == 2 ? got == exact : got - exact <= 0.5 && exact - got <= 0.5, "format %d, depth %a: %.17g", f,
                  (double)depths[i], got);
        }
        close_stage(&s);
    }
}

/* Z1: the same vertices again: EQUAL and GREATER_EQUAL pass everywhere, GREATER nowhere. */
static void z1_a_decal_of_the_same_vertices_does_not_fight(void)
{
    static const struct {
        lom_compare compare;
        int hits;
    } table[] = { { LOM_COMPARE_EQUAL, 2 },   { LOM_COMPARE_GREATER_EQUAL, 2 }, { LOM_COMPARE_LESS_EQUAL, 2 },
                  { LOM_COMPARE_GREATER, 1 }, { LOM_COMPARE_LESS, 1 },          { LOM_COMPARE_NOT_EQUAL, 1 } };
    for (int f = 0; f < FORMATS; f++)
        for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
            stage s = open_depth(f);
            put_window(0.31f, 0.0071f, 0.0013f, false);
            lom_draw_desc desc = draw_of(&counter, vertices, 6);
            desc.blend[0] = adding();
            begin(&s, (lom_pass_desc){ 0 });
            lom_draw(s.device, &desc);
            desc.depth_compare = table[i].compare;
            lom_draw(s.device, &desc);
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++)
                CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == table[i].hits, "format %d, case %zu, pixel %d: %d", f, i,
                      p, bytes_at(&s, p % SIZE, p / SIZE)[0]);
            close_stage(&s);
        }
}

/* Z5: a shader's depth from -0.5 to 3 is clamped before it is tested and written. Z6: its NaN is 0. */
static void z5_written_depths_are_clamped_z6_nan_is_zero(void)
{
    float nan = __builtin_nanf("");
    for (int f = 0; f < FORMATS; f++) {
        stage s = open_depth(f);
        put_window(0.5f, 0, 0, false);
        lom_draw_desc desc = draw_of(&writer, vertices, 6);
        desc.uniforms = &(struct settings){ -0.5f, 3 };
        desc.depth_compare = LOM_COMPARE_GREATER_EQUAL;
        begin(&s, (lom_pass_desc){ 0 });
        lom_draw(s.device, &desc);
        finish(&s);
        for (int x = 0; x < SIZE; x++) {
            double z = clamped(-0.5 + 3.5 * (x + 0.5) / SIZE, 0, 1), step = f == 2 ? 1 : steps[f];
            double error = depth_at(&s, f, x, 7) / step - z;
            CHECK(error < 0.5 / 65535 && error > -0.5 / 65535 && bytes_at(&s, x, 7)[0] == 1, "format %d, %d: %.17g", f,
                  x, depth_at(&s, f, x, 7));
        }
        desc.uniforms = &(struct settings){ nan, nan };
        desc.depth_compare = LOM_COMPARE_ALWAYS;
        begin(&s, (lom_pass_desc){ .clear_depth = 0.25f });
        lom_draw(s.device, &desc);
        finish(&s);
        CHECK(depth_at(&s, f, 30, 30) == 0, "format %d: NaN became %.17g", f, depth_at(&s, f, 30, 30));
        close_stage(&s);
    }
}

/* T11: planes 1e-5 of their distance apart, from 1 to 1e6 near distances, in reversed depth with an infinite far plane
 * (z = near, w = distance): the nearer one wins, whichever is drawn first. */
static void t11_reversed_depth_keeps_planes_in_order(void)
{
    static vertex planes[2][6];
    stage s = open_depth(2);
    float distance = 1;
    for (int k = 0; k <= 6; k++, distance *= 10)
        for (int nearer = 0; nearer < 2; nearer++) { /* the plane that is nearer */
            begin(&s, (lom_pass_desc){ 0 });
            for (int i = 0; i < 2; i++) {
                float w = i == nearer ? distance : distance * 1.00001f;
                put_window(0.01f, 0, 0, false);
                for (int v = 0; v < 6; v++) {
                    planes[i][v] = vertices[v];
                    planes[i][v].position[0] *= w;
                    planes[i][v].position[1] *= w;
                    planes[i][v].position[3] = w;
                }
                lom_draw_desc desc = draw_of(&counter, planes[i], 6);
                desc.blend[0] = adding();
                lom_draw(s.device, &desc);
            }
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++)
                CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == 1 + nearer, "distance %g, plane %d nearer: %d hits",
                      (double)distance, nearer, bytes_at(&s, p % SIZE, p / SIZE)[0]);
        }
    close_stage(&s);
}

/* T12: a depth range that is inverted, and one of a single depth. */
static void t12_depth_ranges_may_be_inverted_or_empty(void)
{
    for (int f = 0; f < FORMATS; f++) {
        stage s = open_depth(f);
        static const float ranges[][2] = { { 0.75f, 0.25f }, { 0.5f, 0.5f }, { 1, 0 }, { 1, 1 } };
        for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
            put_window(0, 1.0f / SIZE, 0, false);
            lom_draw_desc desc = draw_of(&depth_only, vertices, 6);
            desc.depth_compare = LOM_COMPARE_ALWAYS;
            begin(&s, (lom_pass_desc){ .min_depth = ranges[i][0], .max_depth = ranges[i][1] });
            lom_draw(s.device, &desc);
            finish(&s);
            double first = ranges[i][0], span = (double)ranges[i][1] - first, unit = f == 2 ? 1 : steps[f];
            for (int x = 0; x < SIZE; x++) {
                double error = depth_at(&s, f, x, 11) / unit - (first + span * (x + 0.5) / SIZE);
                double bound = f == 2 ? 0x1p-23 : 0.5 / unit + 0x1p-23;
                CHECK(error <= bound && error >= -bound, "format %d, range %zu, %d: %g", f, i, x, error);
            }
        }
        close_stage(&s);
    }
}

/* T12: viewports, frames and ranges that cannot be are errors with a sentence; nothing is drawn. */
static void t12_impossible_passes_are_refused(void)
{
    static const lom_pass_desc bad[] = { { .viewport = { 0, 0, 8, 0 } },
                                         { .viewport = { 0, 0, -1, 8 } },
                                         { .viewport = { 0, 0, 32769, 8 } },
                                         { .viewport = { 40000, 0, 8, 8 } },
                                         { .frame_width = 8 },
                                         { .frame_width = 32769 },
                                         { .frame_height = -64 },
                                         { .origin_x = 1 },
                                         { .min_depth = -0.5f },
                                         { .max_depth = 1.5f },
                                         { .samples = 3 } };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        stage s = open_depth(0);
        begin(&s, bad[i]);
        CHECK(!lom_end_pass(s.device) && lom_device_error(s.device)->code == LOM_ERROR_USAGE &&
                  lom_device_error(s.device)->text[0] != 0,
              "case %zu is taken", i);
        close_stage(&s);
    }
    stage s = open_depth(0);
    lom_begin_pass(s.device, &(lom_pass_desc){ 0 });
    CHECK(!lom_end_pass(s.device), "a pass without attachments is taken");
    close_stage(&s);
}

/* ---- depth bias: OpenGL 4.6, 14.6.5 ---- */

/* The depth that a pixel gets, from the one it has without a bias: the sum is clamped and rounded once. */
static double biased(int format, float z, double offset)
{
    double sum = clamped(z + offset, 0, 1);
    if (format == 2)
        return (float)sum;
    double units = sum * steps[format], whole = (double)(int64_t)units, rest = units - whole;
    return rest > 0.5 || (rest == 0.5 && ((int64_t)whole & 1) != 0) ? whole + 1 : whole;
}

/* Constants are whole steps: exactly k + c on depth k, and held at both ends; for floats c 2^(e - 23). */
static void z4_constants_are_whole_steps(void)
{
    static const float constants[] = { 1, -1, 3, -7, 1000, 1e9f, -1e9f, 3e38f };
    static const int wholes[] = { 0, 1, 2, 77, 32767, 32768, 65534, 65535 };
    for (int f = 0; f < FORMATS; f++) {
        stage s = open_depth(f);
        for (size_t i = 0; i < sizeof wholes / sizeof wholes[0]; i++)
            for (size_t c = 0; c < sizeof constants / sizeof constants[0]; c++) {
                double top = f == 2 ? 1 : steps[f], k = f == 1 ? wholes[i] * 256.0 + i : wholes[i];
                k = f == 2 ? wholes[i] / 65535.0 : clamped(k, 0, top);
                float z = (float)(f == 2 ? k : k / top);
                int exponent;
                __builtin_frexpf(z, &exponent); /* z = m 2^exponent, m in [1/2, 1) */
                double r = f != 2 ? 1 : z == 0 ? 0x1p-149 : __builtin_ldexp(1, exponent - 24);
                put_window(z, 0, 0, false);
                draw_depths(&s, 6, (lom_draw_desc){ .depth_bias = constants[c] });
                double expected =
                    f == 2 ? (float)clamped(z + r * constants[c], 0, 1) : clamped(k + (double)constants[c], 0, top);
                double got = depth_at(&s, f, 5, 50);
                CHECK(got == expected, "format %d, depth %.17g, constant %g: %.17g, not %.17g", f, k,
                      (double)constants[c], got, expected);
            }
        close_stage(&s);
    }
}

/* The slope is max(|dz/dx|, |dz/dy|), a pixel; every depth is that without bias and the offset, rounded once. */
static void z4_slopes_are_the_steeper_of_two(void)
{
    static const struct {
        float z, dx, dy; /* exact in float, so that the slope is */
        float slope, constant, clamp;
        double offset; /* without the constant's part */
    } table[] = {
        { 0.25f, 0x1p-8f, 0x1p-9f, 1, 0, 0, 0x1p-8 },     { 0.75f, -0x1p-9f, -0x1p-8f, 2, 0, 0, 0x1p-7 },
        { 0.25f, 0x1p-8f, 0x1p-9f, -4, 0, 0, -0x1p-6 },   { 0.5f, 0, -0x1p-8f, 3.5f, 0, 0, 3.5 * 0x1p-8 },
        { 0.25f, 0x1p-8f, 0, 8, 0, 0x1p-6f, 0x1p-6 },     { 0.25f, 0x1p-8f, 0, 2, 0, 0x1p-6f, 0x1p-7 },
        { 0.25f, 0x1p-8f, 0, -8, 0, -0x1p-6f, -0x1p-6 },  { 0.25f, 0x1p-8f, 0, 8, 0, -0x1p-6f, 0x1p-5 },
        { 0.25f, 0x1p-8f, 0, 1e30f, 0, 0x1p-6f, 0x1p-6 }, { 0.25f, 0x1p-8f, 0, 1e30f, 0, 0, 1e30 },
        { 0.25f, 0x1p-8f, 0, -1e30f, 0, 0, -1e30 },
    };
    for (int f = 0; f < FORMATS; f++) {
        stage plain = open_depth(2), s = open_depth(f);
        for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
            put_window(table[i].z, table[i].dx, table[i].dy, false);
            draw_depths(&plain, 6, (lom_draw_desc){ 0 });
            draw_depths(&s, 6,
                        (lom_draw_desc){ .depth_bias_slope = table[i].slope, .depth_bias_clamp = table[i].clamp });
            for (int p = 0; p < SIZE * SIZE; p++) {
                int x = p % SIZE, y = p / SIZE;
                double expected = biased(f, (float)depth_at(&plain, 2, x, y), table[i].offset);
                CHECK(depth_at(&s, f, x, y) == expected, "format %d, case %zu, pixel %d,%d: %.17g, not %.17g", f, i, x,
                      y, depth_at(&s, f, x, y), expected);
            }
        }
        close_stage(&plain);
        close_stage(&s);
    }
}

/* A triangle of one depth has slope 0, which no factor changes. */
static void z4_no_slope_times_any_factor_is_nothing(void)
{
    for (int f = 0; f < FORMATS; f++) {
        stage plain = open_depth(f), s = open_depth(f);
        put_window(0.37f, 0, 0, false);
        draw_depths(&plain, 6, (lom_draw_desc){ 0 });
        draw_depths(&s, 6, (lom_draw_desc){ .depth_bias_slope = 1e30f });
        CHECK(same_images(plain.depths, s.depths), "format %d", f);
        draw_depths(&s, 6, (lom_draw_desc){ .depth_bias_slope = -3e38f, .depth_bias_clamp = __builtin_nanf("") });
        CHECK(same_images(plain.depths, s.depths), "format %d, negative", f);
        close_stage(&plain);
        close_stage(&s);
    }
}

/* Nearly edge-on: depth 0 to 1 across 1/128 of a pixel, so the slope is 128 and the offset of any factor beyond all
 * depths, unless it is limited. NaN limits nothing. */
static void z4_edge_on_slopes_are_limited(void)
{
    float nan = __builtin_nanf("");
    const struct {
        float slope, clamp;
        double offset;
    } table[] = { { 1e38f, 0.125f, 0.125 }, { -1e38f, -0.125f, -0.125 }, { 1e38f, nan, 1 },
                  { 1e38f, 0, 1 },          { 1e38f, -0.125f, 1 },       { -1e38f, nan, -1 } };
    for (int f = 0; f < FORMATS; f++)
        for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
            stage plain = open_depth(2), s = open_depth(f);
            put(0, 20.5f - 0x1p-8f, -64, 0); /* the centres of column 20 lie half-way */
            put(1, 20.5f + 0x1p-8f, -64, 1);
            put(2, 20.5f - 0x1p-8f, 128, 0);
            draw_depths(&plain, 3, (lom_draw_desc){ 0 });
            draw_depths(&s, 3,
                        (lom_draw_desc){ .depth_bias_slope = table[i].slope, .depth_bias_clamp = table[i].clamp });
            int hits = 0;
            for (int y = 0; y < SIZE; y++) {
                float z = (float)depth_at(&plain, 2, 20, y);
                double expected = biased(f, z, table[i].offset);
                hits += z != 0;
                CHECK(depth_at(&s, f, 20, y) == expected || z == 0, "format %d, case %zu, row %d: %.17g, not %.17g", f,
                      i, y, depth_at(&s, f, 20, y), expected);
            }
            CHECK(hits > 10, "%d pixels", hits);
            close_stage(&plain);
            close_stage(&s);
        }
}

/* What it is for: a plane cut along the other diagonal fights with itself; with a bias of what
 * interpolation may err by (8 steps), or of a hundredth of a pixel along the slope, it is above everywhere. */
static void z4_a_biased_decal_lies_above(void)
{
    for (int f = 0; f < FORMATS; f++)
        for (int biased_by = 0; biased_by < 2; biased_by++) {
            static vertex ground[6];
            stage s = open_depth(f);
            put_window(0.31f, 0.0073f, 0.0031f, false);
            memcpy(ground, vertices, sizeof ground);
            put_window(0.31f, 0.0073f, 0.0031f, true);
            begin(&s, (lom_pass_desc){ 0 });
            lom_draw_desc desc = draw_of(&counter, ground, 6);
            desc.blend[0] = adding();
            lom_draw(s.device, &desc);
            memcpy(desc.attribute, draw_of(&counter, vertices, 6).attribute, sizeof desc.attribute);
            desc.depth_bias = biased_by == 0 ? 8 : 0;
            desc.depth_bias_slope = biased_by == 0 ? 0 : 0.01f;
            lom_draw(s.device, &desc);
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++)
                CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == 2, "format %d, bias %d, pixel %d is below", f, biased_by,
                      p);
            close_stage(&s);
        }
}

/* Depths that a shader writes get no bias; factors that are no numbers are refused. */
static void z4_what_has_no_bias(void)
{
    stage s = open_depth(2);
    put_window(0.5f, 0.001f, 0, false);
    lom_draw_desc desc = draw_of(&writer, vertices, 6);
    desc.uniforms = &(struct settings){ 0.25f, 0.25f };
    desc.depth_bias = 1e6f;
    desc.depth_bias_slope = 5;
    begin(&s, (lom_pass_desc){ 0 });
    lom_draw(s.device, &desc);
    finish(&s);
    CHECK(depth_at(&s, 2, 8, 8) == 0.25, "%.17g", depth_at(&s, 2, 8, 8));
    close_stage(&s);
    float bad[] = { __builtin_nanf(""), __builtin_inff(), -__builtin_inff() };
    for (int i = 0; i < 6; i++) {
        s = open_depth(2);
        desc = draw_of(&depth_only, vertices, 6);
        *(i < 3 ? &desc.depth_bias : &desc.depth_bias_slope) = bad[i % 3];
        begin(&s, (lom_pass_desc){ 0 });
        lom_draw(s.device, &desc);
        CHECK(lom_device_error(s.device)->code == LOM_ERROR_USAGE, "bias %d is taken", i);
        close_stage(&s);
    }
}

/* Depths that a second pass keeps are those that the first one left: two passes of half the triangles each are one of
 * all. */
static void kept_depths_are_those_of_one_pass(void)
{
    static vertex triangles[60];
    for (int f = 0; f < FORMATS; f++) {
        lom_image *once[2] = { NULL, NULL };
        stage s = open_stage((lom_device_desc){ .threads = 1 }, 75, 43, LOM_FORMAT_R32F, formats[f]);
        for (int k = 0; k < 60; k++)
            triangles[k] =
                (vertex){ .position = { random_float(-1.5f, 1.5f), random_float(-1.5f, 1.5f), random_float(0, 1), 1 },
                          .value = { (float)(k / 3) } };
        for (int passes = 1; passes <= 2; passes++) {
            for (int p = 0; p < passes; p++) {
                const lom_load_action load = p > 0 ? LOM_LOAD_KEEP : LOM_LOAD_CLEAR;
                begin(&s, (lom_pass_desc){ .color_load = { load }, .depth_load = load });
                lom_draw_desc desc = draw_of(&numbers, triangles + 60 / passes * p, 60 / (size_t)passes);
                lom_draw(s.device, &desc);
                finish(&s);
            }
            if (passes == 1) {
                once[0] = s.image;
                once[1] = s.depths;
                s.image = s.depths = NULL;
            }
        }
        CHECK(same_images(once[0], s.image) && same_images(once[1], s.depths), "format %d", (int)formats[f]);
        lom_free_image(once[0]);
        lom_free_image(once[1]);
        close_stage(&s);
    }
}

int main(int argc, char **argv)
{
    RUN(z3_depths_are_rounded_to_nearest);
    RUN(z1_a_decal_of_the_same_vertices_does_not_fight);
    RUN(z5_written_depths_are_clamped_z6_nan_is_zero);
    RUN(t11_reversed_depth_keeps_planes_in_order);
    RUN(t12_depth_ranges_may_be_inverted_or_empty);
    RUN(t12_impossible_passes_are_refused);
    RUN(z4_constants_are_whole_steps);
    RUN(z4_slopes_are_the_steeper_of_two);
    RUN(z4_no_slope_times_any_factor_is_nothing);
    RUN(z4_edge_on_slopes_are_limited);
    RUN(z4_a_biased_decal_lies_above);
    RUN(z4_what_has_no_bias);
    RUN(kept_depths_are_those_of_one_pass);
    return check_result();
}
