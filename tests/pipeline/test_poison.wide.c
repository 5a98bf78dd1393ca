/* Time for a poisoned input is at most 2.5 times that for a clean one (the criterion of Embree's tests): NaN, infinities,
 * denormals and huge numbers in positions, texture coordinates, colours, texels, uniforms and densities. Processor time
 * of this thread, clean and poisoned in turn, the least of each: what else the machine does makes both longer. */
#include "processor_time.h"
#include "stage.h"

#include <lom/lanes_components.h>

#include <float.h>
#include <math.h>

enum { SIZE = 256, QUADS = 64, VERTICES = 6 * QUADS * QUADS, ROUNDS = 7 };
static const double most = 2.5;

/* What stands in an input that is poisoned, and the clean number whose triangles have the same shape: none where they are
 * dropped. Nothing needs cutting 200 half viewports away. */
static const struct poison {
    const char *name;
    float value;
    bool has_shape;
    float like;
} poisons[] = {
    { "NaN", NAN, false, 0 },         { "infinity", INFINITY, false, 0 }, { "-infinity", -INFINITY, false, 0 },
    { "denormals", 1e-41f, true, 0 }, { "1e30", 1e30f, true, 200 },       { "FLT_MAX / 16", FLT_MAX / 16, true, 200 },
};
enum { POISONS = sizeof poisons / sizeof *poisons };

struct uniforms {
    const lom_texture *texture;
    float tint;
};

LOM_INLINE void textured(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float s = in->varying[0], t = in->varying[1];
    lom_float4 texel = lom_sample(u->texture, s, t, lom_lod(u->texture, in, 0, 1));
    out->color[0] = lom_scale4(texel, in->varying[2] * u->tint + in->varying[3]);
}

LOM_SHADER(poisoned, place_values, textured, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .differentiates = LOM_VARYINGS(0, 2), .colors = 1, .uniforms_size = sizeof(struct uniforms))

static vertex plain[VERTICES], clean[VERTICES], bad[VERTICES];

/* Squares of 4 pixels that cover the frame, two triangles each. */
static void make_plain(void)
{
    static const int corner[6][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 1, 0 } };
    for (int i = 0; i < VERTICES; i++) {
        const int quad = i / 6, x = quad % QUADS + corner[i % 6][0], y = quad / QUADS + corner[i % 6][1];
        place_at(&plain[i], x * 1024, y * 1024, SIZE);
        plain[i].value[0] = (float)x * 0.21f;
        plain[i].value[1] = (float)y * 0.17f;
        plain[i].value[2] = 0.5f;
        plain[i].value[3] = (float)(i % 7) / 7;
    }
}

struct scene {
    const vertex *vertices;
    struct uniforms uniforms;
};

static double draw_scene(stage *s, const struct scene *scene)
{
    lom_draw_desc desc = draw_of(&poisoned, scene->vertices, VERTICES);
    desc.uniforms = &scene->uniforms;
    const double start = processor_seconds();
    begin(s, (lom_pass_desc){ .clear_color = { { 0, 0, 0, 0 } } });
    lom_draw(s->device, &desc);
    CHECK(lom_end_pass(s->device), "%s", lom_device_error(s->device)->text);
    return processor_seconds() - start;
}

/* The ratio of least times, of the poisoned scene to the longer of the plain one and the one of the same shape. */
static void compare_scenes(stage *s, const struct scene *good, const struct scene *poisoned_scene, const char *what,
                           const char *name)
{
    const struct scene usual = { plain, good->uniforms }, *const drawn[3] = { &usual, good, poisoned_scene };
    double least[3] = { INFINITY, INFINITY, INFINITY };
    for (int i = 0; i < 3 * ROUNDS; i++) {
        const double taken = draw_scene(s, drawn[i % 3]);
        least[i % 3] = taken < least[i % 3] ? taken : least[i % 3];
    }
    const double ratio = least[2] / (least[0] > least[1] ? least[0] : least[1]);
    CHECK(ratio <= most, "%s in %s: %g times as long", name, what, ratio);
    printf("  %-12s in %-32s %.2f\n", name, what, ratio);
}

static stage open_poisoned(lom_format format)
{
    make_plain();
    memcpy(clean, plain, sizeof clean);
    return open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, format, LOM_FORMAT_DEPTH32F);
}

static lom_texture *make_texture(stage *s, float from, float step)
{
    static float texels[64 * 64][4];
    for (int i = 0; i < 64 * 64; i++)
        for (int k = 0; k < 4; k++)
            texels[i][k] = from + step * (float)((i * 7 + k) % 64);
    return lom_make_texture(
        s->device,
        &(lom_texture_desc){
            .width = 64, .height = 64, .format = LOM_FORMAT_RGBA32F, .pixels = texels, .mips = LOM_MIPS_ALL });
}

static void put(vertex *v, float value, int first, int count)
{
    for (int k = first; k < first + count; k++)
        (k < 4 ? v->position : v->value)[k % 4] = value;
}

/* One vertex of `every` has the poison in one component of its position, in all, or in its values; the clean one has
 * what makes the same shape. */
static void poison_vertices(const struct poison *poison, int every, int first, int count)
{
    memcpy(bad, plain, sizeof bad);
    memcpy(clean, plain, sizeof clean);
    for (int i = 0; i < VERTICES; i += every) {
        put(&bad[i], poison->value, first, count);
        if (poison->has_shape && first < 4)
            put(&clean[i], poison->like, first, count);
    }
}

static void positions(void)
{
    static const struct {
        const char *what;
        int every, first, count;
    } places[] = { { "x of every vertex", 1, 0, 1 },     { "y of every 7th vertex", 7, 1, 1 },
                   { "z of every vertex", 1, 2, 1 },     { "w of every vertex", 1, 3, 1 },
                   { "w of every 7th vertex", 7, 3, 1 }, { "the position of every 2nd vertex", 2, 0, 4 } };
    stage s = open_poisoned(LOM_FORMAT_RGBA8);
    struct uniforms u = { make_texture(&s, 0, 1.0f / 64), 1 };
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (int i = 0; i < POISONS; i++) {
            poison_vertices(&poisons[i], places[p].every, places[p].first, places[p].count);
            compare_scenes(&s, &(struct scene){ clean, u }, &(struct scene){ bad, u }, places[p].what, poisons[i].name);
        }
    close_stage(&s);
}

static void values(void)
{
    static const struct {
        const char *what;
        int every, first, count;
    } places[] = { { "s of every vertex", 1, 4, 1 },
                   { "s and t of every 5th vertex", 5, 4, 2 },
                   { "colours of every vertex", 1, 6, 2 } };
    stage s = open_poisoned(LOM_FORMAT_RGBA32F);
    struct uniforms u = { make_texture(&s, 0, 1.0f / 64), 1 };
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (int i = 0; i < POISONS; i++) {
            poison_vertices(&poisons[i], places[p].every, places[p].first, places[p].count);
            compare_scenes(&s, &(struct scene){ clean, u }, &(struct scene){ bad, u }, places[p].what, poisons[i].name);
        }
    close_stage(&s);
}

static void texels_and_uniforms(void)
{
    stage s = open_poisoned(LOM_FORMAT_RGBA32F);
    const struct scene good = { clean, { make_texture(&s, 0, 1.0f / 64), 1 } };
    for (int i = 0; i < POISONS; i++) {
        struct scene texels = good, tint = good;
        texels.uniforms.texture = make_texture(&s, poisons[i].value, 0);
        tint.uniforms.tint = poisons[i].value;
        compare_scenes(&s, &good, &texels, "every texel", poisons[i].name);
        compare_scenes(&s, &good, &tint, "a uniform", poisons[i].name);
    }
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(positions);
    RUN(values);
    RUN(texels_and_uniforms);
    return check_result();
}
