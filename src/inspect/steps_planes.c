/* Pictures of planes. In: numbers of every pixel. Out: pictures in false colours with their scale, or in the colours that
 * they are. Invariant: a pixel of which nothing is known is dark. */
#include "inspect/steps.h"

#include "base/numbers.h"

#include <stdio.h>

static const uint8_t nothing[3] = { 14, 17, 22 };

struct extremes {
    double low, high;
    bool any;
};

static struct extremes find_extremes(const struct steps *s, const struct plane *p)
{
    struct extremes e = { 0, 0, false };
    size_t pixels = (size_t)s->width * (size_t)s->height, n = (size_t)p->components;
    for (size_t i = 0; i < pixels * n; i++) {
        double v = (double)p->value[i];
        if (!p->is_there[i / n] || !__builtin_isfinite(v))
            continue;
        e.low = !e.any || v < e.low ? v : e.low;
        e.high = !e.any || v > e.high ? v : e.high;
        e.any = true;
    }
    return e;
}

/* ---- numbers ---- */

static double share_of(double value, double low, double high, bool is_logarithmic)
{
    if (is_logarithmic)
        return high > low ? lom_double_log(value / low) / lom_double_log(high / low) : 1;
    return high > low ? (value - low) / (high - low) : 0.5;
}

/* Around 0 where a plane has both signs. */
static lom_image *color_numbers(const struct steps *s, const struct plane *p, const uint8_t ramp[LOM_RAMP_COLORS][3],
                                double low, double high, bool is_logarithmic)
{
    lom_image *image = lom_create_image(s->width, s->height, 1, LOM_FORMAT_RGB8_SRGB, s->error);
    for (size_t i = 0; image != NULL && i < (size_t)s->width * (size_t)s->height; i++) {
        double v = (double)p->value[i];
        if (!p->is_there[i] || !__builtin_isfinite(v) || (is_logarithmic && !(v > 0)))
            memcpy(image->pixels + 3 * i, nothing, 3);
        else
            lom_ramp_color(ramp, share_of(v, low, high, is_logarithmic), image->pixels + 3 * i);
    }
    return lom_magnify(image, s->zoom, s->error);
}

static lom_stage_picture *add_numbers(struct steps *s, const struct plane *p, const char *group, const char *name,
                                      const char *title, const char *source, const char *text)
{
    struct extremes e = find_extremes(s, p);
    bool both = e.low < -0.01 * e.high && e.high > -0.01 * e.low;
    double most = lom_larger(-e.low, e.high), low = both ? -most : e.low, high = both ? most : e.high;
    const uint8_t(*ramp)[3] = both ? lom_signed_ramp : lom_ramp;
    lom_stage_picture *picture =
        lom_add_picture(s, group, name, title, source, color_numbers(s, p, ramp, low, high, false),
                        "%s From %.4g to %.4g.", text, e.low, e.high);
    lom_add_scale(picture, ramp, low, high, false);
    return picture;
}

/* ---- colours ---- */

/* Linear light, or a vector: -1..1 as 0..1. */
static lom_image *color_vectors(const struct steps *s, const struct plane *p, bool is_vector)
{
    lom_image *floats = lom_create_image(s->width, s->height, 1, LOM_FORMAT_RGB32F, s->error);
    size_t count = floats != NULL ? lom_image_size(floats) / sizeof(float) : 0;
    float *to = floats != NULL ? (float *)(void *)floats->pixels : NULL;
    for (size_t i = 0; i < count; i++)
        to[i] = is_vector ? p->value[i] * 0.5f + 0.5f : p->value[i];
    lom_image *image =
        floats != NULL ? lom_convert_image(floats, is_vector ? LOM_FORMAT_RGB8 : LOM_FORMAT_RGB8_SRGB, s->error) : NULL;
    lom_free_image(floats);
    for (size_t i = 0; image != NULL && i < count / 3; i++)
        if (!p->is_there[i])
            memcpy(image->pixels + 3 * i, nothing, 3);
    if (image != NULL)
        image->format = LOM_FORMAT_RGB8_SRGB;
    return lom_magnify(image, s->zoom, s->error);
}

/* ---- coverage and depth ---- */

static uint64_t sum_of(const struct steps *s, const struct plane *p)
{
    double sum = 0;
    for (size_t i = 0; i < (size_t)s->width * (size_t)s->height; i++)
        sum += (double)p->value[i];
    return lom_count_of(sum, SIZE_MAX);
}

static void add_depth(struct steps *s, const struct plane *p)
{
    struct extremes e = { 0, 0, false };
    for (size_t i = 0; i < (size_t)s->width * (size_t)s->height; i++) {
        double v = (double)p->value[i];
        if (!p->is_there[i] || !(v > 0))
            continue;
        e.low = !e.any || v < e.low ? v : e.low;
        e.high = !e.any || v > e.high ? v : e.high;
        e.any = true;
    }
    if (!e.any)
        return;
    bool wide = e.high > 8 * e.low;
    lom_stage_picture *picture = lom_add_picture(
        s, "Pixels", "depth", "Depth", "src/pipeline/early.wide.c",
        color_numbers(s, p, lom_ramp, wide ? e.low : 0, wide ? e.high : 1, wide),
        "The depth of what is seen, as the attachment holds it, from %.4g to %.4g. It is reversed: 1 at the "
        "near plane, half of that twice as far, 0 infinitely far. Dark: nothing, or the sky.",
        e.low, e.high);
    lom_add_scale(picture, lom_ramp, wide ? e.low : 0, wide ? e.high : 1, wide);
}

static const struct plane *find_count(const struct steps *s, const char *name)
{
    for (size_t i = 0; i < s->plane_count; i++)
        if (s->planes[i].kind == PLANE_COUNT && strcmp(s->planes[i].name, name) == 0)
            return &s->planes[i];
    return NULL;
}

/* The format takes the sum, its mean and the most. */
static void add_count(struct steps *s, const char *plane, const char *name, const char *title, const char *source,
                      const char *text)
{
    const struct plane *p = find_count(s, plane);
    uint64_t sum = p != NULL ? sum_of(s, p) : 0;
    if (sum == 0 || s->failed)
        return;
    struct extremes e = find_extremes(s, p);
    double most = lom_larger(e.high, 2);
    lom_stage_picture *picture =
        lom_add_picture(s, "Pixels", name, title, source, color_numbers(s, p, lom_ramp, 1, most, true),
                        "%s %llu fragments, %.2f a pixel, at most %g. Dark: none.", text, (unsigned long long)sum,
                        (double)sum / s->width / s->height, e.high);
    lom_add_scale(picture, lom_ramp, 1, most, true);
}

void lom_picture_coverage(struct steps *s)
{
    const struct plane *depth = find_count(s, "depth");
    add_count(
        s, "covering", "coverage", "Coverage", "src/pipeline/raster.wide.c",
        s->primitives.of[1] == 0
            ? "How many triangles cover the centre of each pixel, those included that lie behind others."
            : "How many triangles cover the centre of each pixel and how many lines have it, those included that lie "
              "behind others.");
    if (!s->failed)
        lom_picture_detail(s);
    add_count(
        s, "hidden", "hidden", "Failed the depth test", "src/pipeline/early.wide.c",
        "How many of them were behind what was there already when they came, and were dropped, most of them before "
        "their shader ran.");
    if (depth != NULL && !s->failed)
        add_depth(s, depth);
}

/* ---- varyings, values, colours ---- */

/* Shaders of lom are called lom_..._shader. */
static const char *short_name(const lom_shader *shader)
{
    return strncmp(shader->name, "lom_", 4) == 0 ? shader->name + 4 : shader->name;
}

static void add_varying(struct steps *s, const struct plane *p)
{
    char name[80], title[96], text[200];
    snprintf(name, sizeof name, "varying-%d-%s", p->index, short_name(p->shader));
    snprintf(title, sizeof title, "%s of %s", p->title[0] != 0 ? p->title : "a varying", short_name(p->shader));
    snprintf(
        text, sizeof text,
        "Varying %d of %s, mixed from the three vertices by perspective-correct weights, where this shader is seen "
        "(%zu pixels).",
        p->index, p->shader->name, p->there);
    add_numbers(s, p, "Varyings", name, title, "src/pipeline/interpolate.wide.c", text);
}

static void add_value(struct steps *s, const struct plane *p)
{
    char text[200];
    snprintf(text, sizeof text, "What the shaders call \"%s\", at %zu pixels.", p->name, p->there);
    if (p->components == 1) {
        add_numbers(s, p, "Light", p->name, p->name, "src/pipeline/fragment.wide.c", text);
        return;
    }
    if (p->components != 3)
        return;
    struct extremes e = find_extremes(s, p);
    bool is_vector = e.low < -0.01 * lom_larger(e.high, 0.1) || strcmp(p->name, "normal") == 0;
    lom_add_picture(s, "Light", p->name, p->name, "src/pipeline/fragment.wide.c", color_vectors(s, p, is_vector),
                    is_vector
                        ? "%s A vector: red, green and blue are x, y and z, -1 black, 0 half, 1 full. From %.4g to "
                          "%.4g."
                        : "%s Linear light, shown as sRGB; what is brighter than 1 is white. From %.4g to %.4g.",
                    text, e.low, e.high);
}

static void add_level(struct steps *s, const struct plane *p)
{
    if (p->there * 200 < (size_t)s->width * (size_t)s->height) /* less than half a percent shows nothing */
        return;
    char text[300], name[64], title[96];
    const char *slash = strrchr(p->name, '/');
    snprintf(title, sizeof title, "Level of %s", slash != NULL ? slash + 1 : p->name);
    snprintf(name, sizeof name, "level-%s", slash != NULL ? slash + 1 : p->name);
    snprintf(
        text, sizeof text,
        "Which level of the texture each pixel reads (0 is the largest, each further one half as large): by the log2 "
        "of the texels that a pixel covers.");
    add_numbers(s, p, "Textures", name, title, "src/image/sample_2d.wide.c", text);
}

static const struct plane *find_blend(const struct steps *s, const char *name)
{
    for (size_t i = 0; i < s->plane_count; i++)
        if (s->planes[i].kind == PLANE_BLEND && strcmp(s->planes[i].name, name) == 0)
            return &s->planes[i];
    return NULL;
}

/* What an attachment holds, 0..255 in 8-bit formats, as floats of linear light or as codes. */
static lom_image *color_attachment(const struct steps *s, const struct plane *p, bool is_source)
{
    const lom_format_info *format = lom_describe_format(lom_texture_format(s->target));
    if (format->is_float || (is_source && format->is_srgb))
        return color_vectors(s, p, false);
    lom_image *image = lom_create_image(s->width, s->height, 1, LOM_FORMAT_RGB8_SRGB, s->error);
    for (size_t i = 0; image != NULL && i < lom_image_size(image); i++)
        image->pixels[i] = p->is_there[i / 3] ? (uint8_t)lom_int_of((double)p->value[i] + 0.5) : nothing[i % 3];
    return lom_magnify(image, s->zoom, s->error);
}

static void add_blended(struct steps *s)
{
    static const struct {
        const char *plane, *name, *title, *text;
    } rows[] = {
        { "before", "blend-before", "Before blending", "What is there before the first triangle that blends" },
        { "source", "blend-source", "What is blended", "The colour that the last of them gives" },
        { "after", "blend-after", "Blended", "What is there then: source and target, each times its factor" },
    };
    const struct plane *alpha = find_blend(s, "alpha");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0] && alpha != NULL; i++) {
        const struct plane *p = find_blend(s, rows[i].plane);
        lom_add_picture(s, "Output", rows[i].name, rows[i].title, "src/pipeline/output.wide.c",
                        color_attachment(s, p, i == 1), "%s, in pass \"%s\", at %zu pixels.", rows[i].text,
                        s->blended.label, p->there);
        if (i == 1)
            add_numbers(s, alpha, "Output", "blend-alpha", "Its alpha", "src/pipeline/output.wide.c",
                        "How much of what is there it hides, as it goes into the blend.");
    }
}

void lom_picture_planes(struct steps *s)
{
    for (size_t i = 0; i < s->plane_count && !s->failed; i++)
        if (s->planes[i].kind == PLANE_VARYING)
            add_varying(s, &s->planes[i]);
    for (size_t i = 0; i < s->plane_count && !s->failed; i++)
        if (s->planes[i].kind == PLANE_LEVEL)
            add_level(s, &s->planes[i]);
    if (!s->failed)
        lom_picture_textures(s);
    for (size_t i = 0; i < s->plane_count && !s->failed; i++)
        if (s->planes[i].kind == PLANE_VALUE)
            add_value(s, &s->planes[i]);
    for (size_t i = 0; i < s->plane_count && !s->failed; i++)
        if (s->planes[i].kind == PLANE_COLOR)
            lom_add_picture(
                s, "Output", "shaded", "What the shaders give", "src/pipeline/fragment.wide.c",
                color_vectors(s, &s->planes[i], false),
                "The colour of each fragment that is seen, in linear light, before it is blended and encoded: "
                "%zu pixels.",
                s->planes[i].there);
    if (!s->failed)
        add_blended(s);
}
