/* Proves blending at this width (B3, B6, B7): into 8-bit unorm every sum is the exact rational rounded once; many faint
 * layers follow the same rule layer by layer; NaN and colours above their alpha have stated results; and every equation
 * of two factors and an operation is its definition. */
#include "pipeline/blend_bytes.h"

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

enum { SMALL = 32 };

/* Whole steps of 1 / 255, 0 and 255 among them: x and y are 8 times a pixel's place. */
static void show_steps(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float x = 8.0f * (in->x - 0.5f), y = 8.0f * (in->y - 0.5f);
    out->color[0] = (lom_float4){ x / 255.0f, (255.0f - x) / 255.0f, y / 255.0f, (255.0f - 0.5f * (x + y)) / 255.0f };
}

LOM_SHADER(steps, place, show_steps, .attributes = 1, .reads_position = true, .colors = 1)

static double factor_of(lom_factor factor, const double from[4], const double onto[4], int c)
{
    const double factors[] = { 0,           1,       from[c],     1 - from[c], from[3],
                               1 - from[3], onto[c], 1 - onto[c], onto[3],     1 - onto[3] };
    return factors[factor];
}

/* S F op D G of channel c. */
static double equation(const lom_blend *how, const double from[4], const double onto[4], int c)
{
    double s = from[c], d = onto[c];
    lom_blend_operation operation = c < 3 ? how->color_operation : how->alpha_operation;
    double f = factor_of(c < 3 ? how->source_color : how->source_alpha, from, onto, c);
    double g = factor_of(c < 3 ? how->target_color : how->target_alpha, from, onto, c);
    const double results[] = { s * f + d * g, s * f - d * g, d * g - s * f, s < d ? s : d, s > d ? s : d };
    return results[operation];
}

static void check_equation(stage *s, const lom_blend *how, const float clear[4])
{
    lom_draw_desc desc = draw_of(&steps, whole, 3);
    lom_pass_desc pass = { .clear_color = { { clear[0], clear[1], clear[2], clear[3] } } };
    bool bytes = s->color != NULL && lom_texture_format(s->color) == LOM_FORMAT_RGBA8;
    desc.blend[0] = *how;
    begin(s, pass);
    lom_draw(s->device, &desc);
    finish(s);
    for (int p = 0; p < SMALL * SMALL; p++) {
        double x = 8 * (p % SMALL), y = 8 * (p / SMALL);
        const double from[4] = { x / 255, 1 - x / 255, y / 255, 1 - 0.5 * (x + y) / 255 };
        const double onto[4] = { (double)clear[0], (double)clear[1], (double)clear[2], (double)clear[3] };
        for (int c = 0; c < 4; c++) {
            double exact = equation(how, from, onto, c), bounded = exact < 0 ? 0 : exact > 1 ? 1 : exact;
            double got = bytes ? bytes_at(s, p % SMALL, p / SMALL)[c] : (double)floats_at(s, p % SMALL, p / SMALL)[c];
            bool right = bytes ? got == (double)(int)(255 * bounded + 0.5) : got - exact < 4e-7 && exact - got < 4e-7;
            CHECK(right, "color %d * %d op %d, alpha %d * %d op %d, pixel %d, channel %d: %g, not %g",
                  how->source_color, how->target_color, how->color_operation, how->source_alpha, how->target_alpha,
                  how->alpha_operation, p, c, got, bytes ? 255 * bounded : exact);
        }
    }
}

/* Every pair of factors with every operation, for colours and, others at the same time, for alpha: into 8 bits the exact
 * rational rounded once (never a tie, since 255^2 is odd), limited to 0..1; into floats the same within their rounding. */
static void every_equation_is_its_definition(void)
{
    static const float clears[2][4] = { { 1, 0, 77.0f / 255, 200.0f / 255 },
                                        { 3.0f / 255, 128.0f / 255, 1, 10.0f / 255 } };
    static const lom_format formats[2] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA32F };
    for (int f = 0; f < 2; f++) {
        stage s = open_stage((lom_device_desc){ .threads = 1 }, SMALL, SMALL, formats[f], LOM_FORMAT_NONE);
        for (int n = 0; n < 10 * 10 * 5; n++) {
            lom_blend how = { .enabled = true,
                              .source_color = (lom_factor)(n % 10),
                              .target_color = (lom_factor)(n / 10 % 10),
                              .color_operation = (lom_blend_operation)(n / 100) };
            int alpha = n % 3 == 0 ? n : 499 - n;
            how.source_alpha = (lom_factor)(alpha % 10);
            how.target_alpha = (lom_factor)(alpha / 10 % 10);
            how.alpha_operation = (lom_blend_operation)(alpha / 100);
            check_equation(&s, &how, clears[n % 2]);
        }
        close_stage(&s);
    }
}

/* The two equations that have code of their own, against the code of all: every source, target and alpha, in the two
 * channels of a half and in the alpha itself. */
static void equations_with_code_of_their_own_are_the_general_ones(void)
{
    const lom_blend straight = with(LOM_FACTOR_SOURCE_ALPHA, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA);
    const lom_blend multiplied = with(LOM_FACTOR_ONE, LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA);
    for (int alpha = 0; alpha < 256; alpha++)
        for (int n = 0; n < 65536; n += LOM_LANES) {
            lom_int each = lom_lane_index() + n, from = each & 255, onto = each >> 8;
            struct channels from_pixel = { (pairs)(from | (255 - from) << 16), (pairs)(from | alpha << 16) };
            struct channels onto_pixel = { (pairs)(onto | onto << 16), (pairs)((255 - onto) | onto << 16) };
            lom_int a = join(blend_straight(from_pixel, onto_pixel)),
                    b = join(blend_bytes(&straight, from_pixel, onto_pixel));
            lom_int c = join(blend_multiplied(from_pixel, onto_pixel)),
                    d = join(blend_bytes(&multiplied, from_pixel, onto_pixel));
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
    RUN(equations_with_code_of_their_own_are_the_general_ones);
    return check_result();
}
