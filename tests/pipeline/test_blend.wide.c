/* Proves blending at this width (B3, B6, B7): into 8-bit unorm every sum is the exact rational rounded once; many faint
 * layers follow the same rule layer by layer; NaN and colours above their alpha have stated results; every equation
 * of two factors and an operation is its definition, with a constant and a second source too; logical operations are
 * their tables; and each of several targets has the equation of its own. */
#include "pipeline/blend_bytes.h"

#include "image/convert.h"

#include "oracle/blending.h"
#include "stage.h"

enum { SIZE = 256 };

struct settings {
    float color[4]; /* where `table` is 0 */
    float table;    /* 1: red, green, blue are x / 255 and alpha is y / 255 of the pixel (x, y) */
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct settings *s = uniforms;
    lom_float x = (in->x - 0.5f) / 255.0f, y = (in->y - 0.5f) / 255.0f;
    if (s->table == 0) {
        x = lom_splat(s->color[0]);
        y = lom_splat(s->color[3]);
    }
    out->color[0] = (lom_float4){ x, x, x, y };
}

LOM_SHADER(source, place, show, .attributes = 1, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct settings))

static const vertex whole[3] = { { .position = { -1, 3, 0.5f, 1 } },
                                 { .position = { -1, -1, 0.5f, 1 } },
                                 { .position = { 3, -1, 0.5f, 1 } } };

static lom_blend with(lom_factor source_factor, lom_factor target_factor)
{
    return (
        lom_blend){ true, source_factor, target_factor, source_factor, target_factor, LOM_BLEND_ADD, LOM_BLEND_ADD };
}

/* `layers` times the source over a target cleared to `target` of 255. */
static void blend(stage *s, struct settings settings, int target, lom_blend how, int layers)
{
    float clear = (float)target / 255.0f;
    lom_draw_desc desc = draw_of(&source, whole, 3);
    desc.uniforms = &settings;
    desc.blend[0] = how;
    begin(s, (lom_pass_desc){ .clear_color = { { clear, clear, clear, clear } } });
    for (int i = 0; i < layers; i++)
        lom_draw(s->device, &desc);
    finish(s);
}

/* round(v / 255) of whole numbers, never a tie since 255 is odd; limited to 255. */
static int rounded(int v)
{
    int q = (2 * v + 255) / 510;
    return q > 255 ? 255 : q;
}

static const int targets[] = { 0, 1, 2, 77, 127, 128, 200, 254, 255 };
enum { TARGETS = sizeof targets / sizeof targets[0] };

/* B3: all sources and alphas over nine targets; alpha 0 leaves the target, 255 the source. */
static void b3_source_over_is_the_rounded_rational(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int t = 0; t < TARGETS; t++) {
        blend(&s, (struct settings){ .table = 1 }, targets[t],
              with(LOM_FACTOR_SOURCE_ALPHA, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA), 1);
        for (int a = 0; a < SIZE; a++)
            for (int x = 0; x < SIZE; x++) {
                const uint8_t *got = bytes_at(&s, x, a);
                int expected = rounded(x * a + targets[t] * (255 - a));
                CHECK(got[0] == expected && got[2] == expected && got[3] == rounded(a * a + targets[t] * (255 - a)),
                      "%d with alpha %d over %d: %d, not %d", x, a, targets[t], got[0], expected);
                CHECK((a != 0 || got[0] == targets[t]) && (a != 255 || got[0] == x), "alpha %d is no identity", a);
            }
    }
    close_stage(&s);
}

/* B3: 1000 layers of alpha 1/255. Each rounds by at most a half, and the next keeps 254/255 of the error: never further
 * from the exact sum than 1/2 / (1 - 254/255) = 127.5. In floats the drift is that of float arithmetic. */
static void b3_faint_layers_drift_within_their_bound(void)
{
    enum { LAYERS = 1000 };
    lom_blend over = with(LOM_FACTOR_SOURCE_ALPHA, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA);
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 4, 4, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    stage floats = open_stage((lom_device_desc){ .threads = 1 }, 4, 4, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    struct settings faint = { .color = { 1, 1, 1, 1.0f / 255 } };
    for (int t = 0; t < TARGETS; t++) {
        int step = targets[t];
        double exact = targets[t];
        for (int i = 0; i < LAYERS; i++) {
            step = rounded(255 + step * 254);
            exact = (255 + exact * 254) / 255;
        }
        blend(&s, faint, targets[t], over, LAYERS);
        blend(&floats, faint, targets[t], over, LAYERS);
        double drift = exact - bytes_at(&s, 1, 2)[0], small = exact - (double)floats_at(&floats, 1, 2)[0] * 255;
        CHECK(bytes_at(&s, 1, 2)[0] == step, "over %d: %d, not %d", targets[t], bytes_at(&s, 1, 2)[0], step);
        CHECK(drift <= 127.5 && drift >= -127.5, "over %d: off by %g", targets[t], drift);
        CHECK(small < 0.01 && small > -0.01, "over %d: floats off by %g", targets[t], small);
    }
    close_stage(&s);
    close_stage(&floats);
}

/* B6: a NaN source is 0 in unorm before it blends; in floats what comes out as NaN is stored as 0. */
static void b6_nan_is_never_stored(void)
{
    float nan = __builtin_nanf("");
    const struct settings cases[] = { { .color = { nan, nan, nan, 1 } }, { .color = { 1, 1, 1, nan } } };
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA32F };
    for (int f = 0; f < 3; f++)
        for (int c = 0; c < 4; c++) {
            stage s = open_stage((lom_device_desc){ .threads = 1 }, 4, 4, formats[f], LOM_FORMAT_NONE);
            lom_blend how = with(LOM_FACTOR_SOURCE_ALPHA, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA);
            how.enabled = c >= 2;
            blend(&s, cases[c % 2], 100, how, 1);
            for (int i = 0; i < 4; i++) {
                float value = f < 2 ? (float)bytes_at(&s, 1, 1)[i] : floats_at(&s, 1, 1)[i];
                CHECK(value == value && value >= 0 && value <= 255, "format %d, case %d, channel %d: %g", f, c, i,
                      (double)value);
                if (f == 0) {
                    int alpha = c % 2 == 0 ? 255 : 0, from = c % 2 == 0 && i < 3 ? 0 : i == 3 ? alpha : 255;
                    int expected = c >= 2 ? rounded(from * alpha + 100 * (255 - alpha)) : from;
                    CHECK((int)value == expected, "case %d, channel %d: %g, not %d", c, i, (double)value, expected);
                }
            }
            close_stage(&s);
        }
}

/* B7: premultiplied colours above their alpha saturate; nothing wraps. */
static void b7_colours_above_their_alpha_saturate(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int t = 0; t < TARGETS; t++) {
        blend(&s, (struct settings){ .table = 1 }, targets[t], with(LOM_FACTOR_ONE, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA),
              1);
        for (int p = 0; p < SIZE * SIZE; p++) {
            int x = p % SIZE, a = p / SIZE, got = bytes_at(&s, x, a)[0];
            int expected = rounded(x * 255 + targets[t] * (255 - a));
            CHECK(got == expected, "%d with alpha %d over %d: %d, not %d", x, a, targets[t], got, expected);
        }
    }
    close_stage(&s);
}

/* ---- every equation ---- */

enum { SMALL = 32, FACTORS = LOM_FACTOR_COUNT, OPERATIONS = LOM_BLEND_OPERATION_COUNT };

/* Whole steps of 1 / 255, 0 and 255 among them: x and y are 8 times a pixel's place. The second source is another one. */
static void show_steps(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float x = 8.0f * (in->x - 0.5f), y = 8.0f * (in->y - 0.5f), middle = 255.0f - 0.5f * (x + y);
    out->color[0] = (lom_float4){ x / 255.0f, (255.0f - x) / 255.0f, y / 255.0f, middle / 255.0f };
    out->color[1] = (lom_float4){ y / 255.0f, x / 255.0f, middle / 255.0f, (255.0f - y) / 255.0f };
}

LOM_SHADER(steps, place, show_steps, .attributes = 1, .reads_position = true, .colors = 2)

/* The source of a pixel, clamped to what the format holds (0..1, which it is already). */
static struct blend_terms terms_of(int p, const float clear[4], const float constant[4])
{
    double x = 8 * (p % SMALL) / 255.0, y = 8 * (p / SMALL) / 255.0, middle = 1 - 0.5 * (x + y);
    struct blend_terms t = { .source = { x, 1 - x, y, middle }, .second = { y, x, middle, 1 - y } };
    for (int c = 0; c < 4; c++) {
        t.target[c] = (double)clear[c];
        t.constant[c] = (double)constant[c];
    }
    return t;
}

static void check_equation(stage *s, const lom_blend *how, const float clear[4], const float constant[4])
{
    lom_draw_desc desc = draw_of(&steps, whole, 3);
    lom_pass_desc pass = { .clear_color = { { clear[0], clear[1], clear[2], clear[3] } } };
    lom_format format = lom_texture_format(s->color);
    desc.blend[0] = *how;
    memcpy(desc.blend_constant, constant, sizeof desc.blend_constant);
    begin(s, pass);
    lom_draw(s->device, &desc);
    finish(s);
    for (int p = 0; p < SMALL * SMALL; p++) {
        struct blend_terms t = terms_of(p, clear, constant);
        if (format == LOM_FORMAT_RGBA8_SRGB)
            for (int c = 0; c < 3; c++)
                t.target[c] = (double)lom_srgb_linear[lom_srgb8_of(clear[c])];
        for (int c = 0; c < 4; c++) {
            double exact = blend_equation(how, &t, c), bounded = exact < 0 ? 0 : exact > 1 ? 1 : exact;
            double got = format == LOM_FORMAT_RGBA32F ? (double)floats_at(s, p % SMALL, p / SMALL)[c]
                                                      : bytes_at(s, p % SMALL, p / SMALL)[c];
            bool right = got == (double)(int)(255 * bounded + 0.5);
            if (format == LOM_FORMAT_RGBA32F)
                right = got - exact < 4e-7 && exact - got < 4e-7;
            else if (format == LOM_FORMAT_RGBA8_SRGB && c < 3) /* the nearest code, of a sum that floats have rounded */
                right = got >= lom_srgb8_of((float)(bounded - 4e-7)) && got <= lom_srgb8_of((float)(bounded + 4e-7));
            CHECK(right, "format %d, color %d * %d op %d, alpha %d * %d op %d, pixel %d, channel %d: %g, not %g",
                  format, how->source_color, how->target_color, how->color_operation, how->source_alpha,
                  how->target_alpha, how->alpha_operation, p, c, got,
                  format == LOM_FORMAT_RGBA8 ? 255 * bounded : exact);
        }
    }
}

/* Every pair of factors with every operation, for colours and, others at the same time, for alpha: into 8 bits the exact
 * rational rounded once (never a tie, since 255^2 is odd), limited to 0..1; into floats the same within their rounding;
 * into sRGB, where targets are what their codes mean, the nearest code. */
static void every_equation_is_its_definition(void)
{
    enum { COUNT = FACTORS * FACTORS * OPERATIONS };
    static const float clears[2][4] = { { 1, 0, 77.0f / 255, 200.0f / 255 },
                                        { 3.0f / 255, 128.0f / 255, 1, 10.0f / 255 } };
    static const float constants[2][4] = { { 50.0f / 255, 1, 0, 99.0f / 255 }, { 0, 7.0f / 255, 250.0f / 255, 1 } };
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA32F };
    for (int f = 0; f < 3; f++) {
        stage s = open_stage((lom_device_desc){ .threads = 1 }, SMALL, SMALL, formats[f], LOM_FORMAT_NONE);
        for (int n = 0; n < COUNT; n++) {
            lom_blend how = { .enabled = true,
                              .source_color = (lom_factor)(n % FACTORS),
                              .target_color = (lom_factor)(n / FACTORS % FACTORS),
                              .color_operation = (lom_blend_operation)(n / (FACTORS * FACTORS)) };
            int alpha = n % 3 == 0 ? n : COUNT - 1 - n;
            how.source_alpha = (lom_factor)(alpha % FACTORS);
            how.target_alpha = (lom_factor)(alpha / FACTORS % FACTORS);
            how.alpha_operation = (lom_blend_operation)(alpha / (FACTORS * FACTORS));
            check_equation(&s, &how, clears[n % 2], constants[n / 2 % 2]);
        }
        close_stage(&s);
    }
}

/* Constants and second sources are rounded to 8 bits before they are factors, and clamped where the format is. */
static void constants_and_second_sources_are_rounded_to_the_format(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SMALL, SMALL, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    const lom_blend how = { .enabled = true,
                            .source_color = LOM_FACTOR_CONSTANT_COLOR,
                            .source_alpha = LOM_FACTOR_CONSTANT_ALPHA };
    for (int n = 0; n < 64; n++) {
        float asked = random_float(-0.5f, 1.5f), held = asked < 0 ? 0 : asked > 1 ? 1 : asked;
        int code = (int)((double)held * 255 + 0.5);
        lom_draw_desc desc = draw_of(&steps, whole, 3);
        desc.blend[0] = how;
        for (int c = 0; c < 4; c++)
            desc.blend_constant[c] = asked;
        begin(&s, (lom_pass_desc){ .clear_color = { { 0, 0, 0, 0 } } });
        lom_draw(s.device, &desc);
        finish(&s);
        for (int x = 0; x < SMALL; x++)
            CHECK(bytes_at(&s, x, 3)[0] == rounded(8 * x * code), "%g times %d of 255: %d", (double)asked, 8 * x,
                  bytes_at(&s, x, 3)[0]);
    }
    close_stage(&s);
}

/* ---- logical operations ---- */

/* One bit of source and target, by the table of OpenGL 4.6, 17.3.9: bit 2 s + d of `table` is the result. */
static const uint8_t logic_tables[LOM_LOGIC_COUNT] = {
    [LOM_LOGIC_CLEAR] = 0x0,         [LOM_LOGIC_AND] = 0x8,          [LOM_LOGIC_AND_REVERSE] = 0x4,
    [LOM_LOGIC_COPY] = 0xc,          [LOM_LOGIC_AND_INVERTED] = 0x2, [LOM_LOGIC_NOTHING] = 0xa,
    [LOM_LOGIC_XOR] = 0x6,           [LOM_LOGIC_OR] = 0xe,           [LOM_LOGIC_NOR] = 0x1,
    [LOM_LOGIC_EQUIVALENT] = 0x9,    [LOM_LOGIC_INVERT] = 0x5,       [LOM_LOGIC_OR_REVERSE] = 0xd,
    [LOM_LOGIC_COPY_INVERTED] = 0x3, [LOM_LOGIC_OR_INVERTED] = 0xb,  [LOM_LOGIC_NAND] = 0x7,
    [LOM_LOGIC_SET] = 0xf,
};

static int combine_by_table(lom_logic logic, int s, int d)
{
    int result = 0;
    for (int bit = 0; bit < 8; bit++)
        result |= (logic_tables[logic] >> ((s >> bit & 1) * 2 + (d >> bit & 1)) & 1) << bit;
    return result;
}

/* All 16 of all 256 sources over nine targets; the blend that the draw has besides is not done; the mask is kept. */
static void logical_operations_are_their_tables(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int logic = LOM_LOGIC_CLEAR; logic < LOM_LOGIC_COUNT; logic++)
        for (int t = 0; t < TARGETS; t++) {
            struct settings table = { .table = 1 };
            float clear = (float)targets[t] / 255.0f;
            lom_draw_desc desc = draw_of(&source, whole, 3);
            desc.uniforms = &table;
            desc.blend[0] = adding();
            desc.logic = (lom_logic)logic;
            desc.mask_off[0] = 4;
            begin(&s, (lom_pass_desc){ .clear_color = { { clear, clear, clear, clear } } });
            lom_draw(s.device, &desc);
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++) {
                const uint8_t *got = bytes_at(&s, p % SIZE, p / SIZE);
                int red = combine_by_table((lom_logic)logic, p % SIZE, targets[t]);
                int alpha = combine_by_table((lom_logic)logic, p / SIZE, targets[t]);
                CHECK(got[0] == red && got[1] == red && got[2] == targets[t] && got[3] == alpha,
                      "operation %d of %d, %d over %d: %d, %d", logic, p % SIZE, p / SIZE, targets[t], got[0], got[3]);
            }
        }
    close_stage(&s);
}

static void show_one(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(0.3f), lom_splat(0.6f), lom_splat(0.9f), lom_splat(0.7f) };
    out->color[1] = (lom_float4){ lom_splat(0.8f), lom_splat(0.2f), lom_splat(0.4f), lom_splat(0.1f) };
}

LOM_SHADER(one_color, place, show_one, .attributes = 1, .colors = 1)
LOM_SHADER(two_colors, place, show_one, .attributes = 1, .reads_position = true, .colors = 2)

/* A draw of one colour, which goes another way, has the same pixels as one of many. */
static void constant_draws_blend_and_combine_alike(void)
{
    static const lom_device_desc devices[] = { { .threads = 1 }, { .threads = 2, .tile = 16 } };
    for (int n = 0; n < FACTORS + LOM_LOGIC_COUNT; n++) {
        uint8_t pixel[2][4];
        for (int i = 0; i < 2; i++) {
            stage s = open_stage(devices[i], 64, 64, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
            bool second = n < FACTORS && (n >= LOM_FACTOR_SECOND_COLOR || FACTORS - 1 - n >= LOM_FACTOR_SECOND_COLOR);
            lom_draw_desc desc = draw_of(i == 0 && !second ? &one_color : &two_colors, whole, 3);
            if (n < FACTORS)
                desc.blend[0] = with((lom_factor)n, (lom_factor)(FACTORS - 1 - n));
            else
                desc.logic = (lom_logic)(n - FACTORS);
            const float constant[4] = { 0.25f, 0.5f, 0.75f, 0.125f };
            memcpy(desc.blend_constant, constant, sizeof constant);
            begin(&s, (lom_pass_desc){ .clear_color = { { 0.1f, 0.3f, 0.6f, 0.8f } } });
            lom_draw(s.device, &desc);
            lom_draw(s.device, &desc);
            finish(&s);
            memcpy(pixel[i], bytes_at(&s, 40, 21), 4);
            close_stage(&s);
        }
        CHECK(memcmp(pixel[0], pixel[1], 4) == 0, "case %d: %d %d %d %d and %d %d %d %d", n, pixel[0][0], pixel[0][1],
              pixel[0][2], pixel[0][3], pixel[1][0], pixel[1][1], pixel[1][2], pixel[1][3]);
    }
}

/* ---- several targets ---- */

static void show_three(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_steps(out, in, uniforms);
    out->color[2] = out->color[0];
}

LOM_SHADER(three, place, show_three, .attributes = 1, .reads_position = true, .colors = 3)

/* Each target has the equation and the mask of its own, and its own format; the one that the shader has no colour for
 * keeps its clear value. */
static void targets_blend_each_by_its_own_equation(void)
{
    static const lom_format formats[4] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA32F, LOM_FORMAT_RGBA8_SRGB,
                                           LOM_FORMAT_RGBA8 };
    const float clear[4] = { 0.25f, 0.5f, 0.75f, 1 };
    lom_device *device = open_device((lom_device_desc){ .threads = 2 });
    lom_pass_desc pass = { .label = NULL };
    lom_draw_desc desc = draw_of(&three, whole, 3);
    for (int i = 0; i < 4; i++) {
        pass.color[i] =
            lom_make_texture(device, &(lom_texture_desc){ .width = SMALL, .height = SMALL, .format = formats[i] });
        memcpy(pass.clear_color[i], clear, sizeof clear);
        desc.blend[i] = with(i == 1 ? LOM_FACTOR_SOURCE_ALPHA_SATURATE : LOM_FACTOR_TARGET_COLOR, LOM_FACTOR_ONE);
    }
    desc.blend[2].enabled = false;
    desc.mask_off[2] = 1;
    lom_begin_pass(device, &pass);
    lom_draw(device, &desc);
    CHECK(lom_end_pass(device), "%s", lom_device_error(device)->text);
    lom_image *image[4];
    for (int i = 0; i < 4; i++)
        image[i] = lom_read_texture(pass.color[i], 0, 0, NULL);
    for (int p = 0; p < SMALL * SMALL; p++) {
        const struct blend_terms t = terms_of(p, clear, clear);
        const uint8_t *a = lom_image_pixel(image[0], p % SMALL, p / SMALL, 0),
                      *b = lom_image_pixel(image[2], p % SMALL, p / SMALL, 0),
                      *d = lom_image_pixel(image[3], p % SMALL, p / SMALL, 0);
        const float *f = lom_image_pixel(image[1], p % SMALL, p / SMALL, 0);
        double sum = t.second[1] * least(t.second[3], 1 - 1) + 0.5;
        CHECK(a[0] == rounded(8 * (p % SMALL) * 64 + 64 * 255), "pixel %d: %d", p, a[0]);
        CHECK((double)f[1] == sum, "pixel %d: %g, not %g", p, (double)f[1], sum);
        CHECK(b[0] == lom_srgb8_of(0.25f) && b[1] == lom_srgb8_of((float)t.source[1]), "pixel %d: %d %d", p, b[0],
              b[1]);
        CHECK(d[0] == 64 && d[3] == 255, "pixel %d: %d", p, d[0]);
    }
    for (int i = 0; i < 4; i++)
        lom_free_image(image[i]);
    lom_close_device(device);
}

/* ---- what cannot be ---- */

static void refused(const char *what, lom_format format, const lom_shader *shader, lom_draw_desc desc)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 8, 8, format, LOM_FORMAT_NONE);
    lom_draw_desc made = draw_of(shader, whole, 3);
    memcpy(made.blend, desc.blend, sizeof made.blend);
    memcpy(made.blend_constant, desc.blend_constant, sizeof made.blend_constant);
    made.logic = desc.logic;
    lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color } });
    lom_draw(s.device, &made);
    CHECK(!lom_end_pass(s.device) && strstr(lom_device_error(s.device)->text, what) != NULL, "%s: \"%s\"", what,
          lom_device_error(s.device)->text);
    close_stage(&s);
}

static void what_cannot_be_is_refused(void)
{
    float nan = __builtin_nanf("");
    lom_blend worse = with(LOM_FACTOR_ONE, LOM_FACTOR_ONE);
    worse.alpha_operation = LOM_BLEND_OPERATION_COUNT;
    refused("a factor or an operation that is none", LOM_FORMAT_RGBA8, &steps,
            (lom_draw_desc){ .blend = { with(LOM_FACTOR_COUNT, LOM_FACTOR_ONE) } });
    refused("a factor or an operation that is none", LOM_FORMAT_RGBA8, &steps, (lom_draw_desc){ .blend = { worse } });
    refused("takes a shader of two colours", LOM_FORMAT_RGBA8, &one_color,
            (lom_draw_desc){ .blend = { with(LOM_FACTOR_ONE, LOM_FACTOR_SECOND_COLOR) } });
    refused("constant of a draw of steps is not finite", LOM_FORMAT_RGBA8, &steps,
            (lom_draw_desc){ .blend_constant = { 0, 0, nan, 0 } });
    refused("a logical operation 17 that is none", LOM_FORMAT_RGBA8, &steps,
            (lom_draw_desc){ .logic = LOM_LOGIC_COUNT });
    refused("colour attachment 0 is RGBA32F", LOM_FORMAT_RGBA32F, &steps, (lom_draw_desc){ .logic = LOM_LOGIC_XOR });
    refused("colour attachment 0 is RGBA8 sRGB", LOM_FORMAT_RGBA8_SRGB, &steps,
            (lom_draw_desc){ .logic = LOM_LOGIC_XOR });
}

/* The two equations that have code of their own, against the code of all: every source, target and alpha, in the two
 * channels of a half and in the alpha itself. */
static void equations_with_code_of_their_own_are_the_general_ones(void)
{
    const lom_blend straight = with(LOM_FACTOR_SOURCE_ALPHA, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA);
    const lom_blend multiplied = with(LOM_FACTOR_ONE, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA);
    const struct rare_sources rare = { { { 0 }, { 0 } }, { { 0 }, { 0 } } };
    for (int alpha = 0; alpha < 256; alpha++)
        for (int n = 0; n < 65536; n += LOM_LANES) {
            lom_int each = lom_lane_index() + n, from = each & 255, onto = each >> 8;
            struct channels from_pixel = narrow(from, from, 255 - from, lom_splat_int(alpha));
            struct channels onto_pixel = narrow(onto, 255 - onto, onto, onto);
            lom_int a = join(blend_straight(from_pixel, onto_pixel)),
                    b = join(blend_bytes(&straight, from_pixel, onto_pixel, &rare));
            lom_int c = join_bounded(blend_multiplied(from_pixel, onto_pixel)),
                    d = join(blend_bytes(&multiplied, from_pixel, onto_pixel, &rare));
            CHECK(lom_all(a == b) && lom_all(c == d), "alpha %d, sources and targets from %d on", alpha, n);
        }
}

int main(int argc, char **argv)
{
    RUN(b3_source_over_is_the_rounded_rational);
    RUN(b3_faint_layers_drift_within_their_bound);
    RUN(b6_nan_is_never_stored);
    RUN(b7_colours_above_their_alpha_saturate);
    RUN(every_equation_is_its_definition);
    RUN(constants_and_second_sources_are_rounded_to_the_format);
    RUN(equations_with_code_of_their_own_are_the_general_ones);
    RUN(logical_operations_are_their_tables);
    RUN(constant_draws_blend_and_combine_alike);
    RUN(targets_blend_each_by_its_own_equation);
    RUN(what_cannot_be_is_refused);
    return check_result();
}
