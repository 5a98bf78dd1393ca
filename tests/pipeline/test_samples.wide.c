/* Proves of several samples a pixel: they lie where lom_sample_position says; the samples that a triangle covers are those of
 * an oracle in 128 bits, and a mesh covers each once; what a pass of n samples draws, shaded for each, is the mean of n
 * pictures of one sample whose vertices are moved by the samples' places, bit for bit, whatever is tested, blended, cut,
 * biased or thrown away, and the same with one shade a fragment where that is one colour. */
#include "sampled.h"

/* ---- where they lie ---- */

static void samples_lie_where_they_are_said_to(void)
{
    int at[2] = { 5, 5 };
    CHECK(lom_sample_position(1, 0, at) && at[0] == 0 && at[1] == 0, "one sample lies at %d,%d", at[0], at[1]);
    for (int k = 0; k < 4; k++) {
        unsigned columns = 0, rows = 0;
        for (int i = 0; i < counts[k]; i++) {
            CHECK(lom_sample_position(counts[k], i, at), "sample %d of %d is missing", i, counts[k]);
            CHECK(at[0] >= -8 && at[0] < 8 && at[1] >= -8 && at[1] < 8, "sample %d lies outside of its pixel", i);
            columns |= 1u << (at[0] + 8);
            rows |= 1u << (at[1] + 8);
        }
        CHECK(__builtin_popcount(columns) == counts[k] && __builtin_popcount(rows) == counts[k],
              "two of %d samples share a column or a row", counts[k]);
    }
    CHECK(!lom_sample_position(4, 4, at) && !lom_sample_position(4, -1, at) && !lom_sample_position(3, 0, at) &&
              !lom_sample_position(32, 0, at) && at[0] == 0 && at[1] == 0,
          "a sample that is none has a place");
}

/* ---- which are covered ---- */

/* Two to the number of the sample that lies where the shader runs. */
typedef struct places {
    float x[16], y[16];
    int32_t count;
} places;

static places places_of(int samples)
{
    places p = { .count = samples };
    for (int i = 0; i < samples; i++) {
        int at[2];
        lom_sample_position(samples, i, at);
        p.x[i] = (float)(at[0] + 8) / 16;
        p.y[i] = (float)(at[1] + 8) / 16;
    }
    return p;
}

static void name_sample(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const places *p = uniforms;
    lom_float x = in->x - lom_floor(in->x), y = in->y - lom_floor(in->y), value = { 0 };
    for (int i = 0; i < p->count; i++)
        value = lom_select((x == p->x[i]) & (y == p->y[i]), lom_splat((float)(1 << i)), value);
    out->color[0] = (lom_float4){ value, value, value, value };
}

LOM_SHADER(named, place_values, name_sample, .attributes = 1, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(places))

static void draw_named(stage *s, const vertex *v, size_t count, int samples)
{
    places p = places_of(samples);
    lom_draw_desc draw = draw_of(&named, v, count);
    draw.uniforms = &p;
    draw.per_sample = true;
    draw.blend[0] = adding();
    begin(s, (lom_pass_desc){ .samples = samples });
    lom_draw(s->device, &draw);
    finish(s);
}

static void samples_are_covered_as_the_oracle_says(void)
{
    vertex v[3];
    for (int round = 0; round < 48; round++) {
        const int samples = counts[round & 3];
        const int64_t reach = round % 3 == 0   ? 600
                              : round % 3 == 1 ? 6000
                                               : 60000; /* units: small, and above 64 pixels */
        stage s = open_stage((lom_device_desc){ .threads = 1, .tile = 16 << round % 3 }, SIZE, SIZE, LOM_FORMAT_R32F,
                             LOM_FORMAT_NONE);
        snapped corner[3];
        int64_t x = random_whole(0, 256 * SIZE), y = random_whole(0, 256 * SIZE), step = round % 5 == 0 ? 16 : 1;
        for (int k = 0; k < 3; k++) {
            corner[k] = (snapped){ (x + random_whole(-reach, reach)) / step * step,
                                   (y + random_whole(-reach, reach)) / step * step };
            place_at(&v[k], corner[k].x, corner[k].y, SIZE);
        }
        draw_named(&s, v, 3, samples);
        for (int py = 0; py < SIZE; py++)
            for (int px = 0; px < SIZE; px++) {
                float sum = *floats_at(&s, px, py) * (float)samples;
                unsigned bits = samples_of(corner, samples, px, py);
                CHECK(sum == (float)bits, "round %d, %d samples: pixel %d,%d has %g, not %u", round, samples, px, py,
                      (double)sum, bits);
            }
        close_stage(&s);
    }
}

/* A grid of quads with moved corners, some on samples, in two triangles each. */
static void a_mesh_covers_each_sample_once(void)
{
    enum { CELLS = 24 };
    static snapped corner[CELLS + 1][CELLS + 1];
    static vertex v[CELLS * CELLS * 6];
    for (int k = 0; k < 4; k++) {
        stage s = open_stage((lom_device_desc){ .threads = 2 }, SIZE, SIZE, LOM_FORMAT_R32F, LOM_FORMAT_NONE);
        size_t count = 0;
        for (int y = 0; y <= CELLS; y++)
            for (int x = 0; x <= CELLS; x++) {
                int64_t cell = 256 * SIZE / CELLS, moves = x > 0 && x < CELLS && y > 0 && y < CELLS ? cell / 5 : 0;
                corner[y][x] = (snapped){ (x * 256 * SIZE / CELLS + random_whole(-moves, moves)) / 16 * 16,
                                          (y * 256 * SIZE / CELLS + random_whole(-moves, moves)) / 16 * 16 };
            }
        for (int y = 0; y < CELLS; y++)
            for (int x = 0; x < CELLS; x++) {
                static const int order[2][6] = { { 0, 1, 2, 2, 1, 3 }, { 0, 1, 3, 0, 3, 2 } };
                for (int i = 0; i < 6; i++) {
                    int c = order[(x ^ y) & 1][i];
                    place_at(&v[count++], corner[y + (c >> 1)][x + (c & 1)].x, corner[y + (c >> 1)][x + (c & 1)].y,
                             SIZE);
                }
            }
        draw_named(&s, v, count, counts[k]);
        for (int py = 0; py < SIZE; py++)
            for (int px = 0; px < SIZE; px++)
                CHECK(*floats_at(&s, px, py) * (float)counts[k] == (float)((1 << counts[k]) - 1),
                      "%d samples: those of pixel %d,%d are not covered once each", counts[k], px, py);
        close_stage(&s);
    }
}

/* ---- the same as so many pictures ---- */

static void place_all(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    for (int i = 0; i < 4; i++)
        out->varying[4 + i] = (&in->attribute[2].x)[i];
    out->distance[0] = in->attribute[3].x;
    out->axis[0] = in->attribute[1];
    out->axis[1] = in->attribute[2];
    out->axis[0].w = out->axis[1].w = lom_splat(0); /* else it would matter where the middle is */
}

static void show_some(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0] + lom_dx(in, 1) * 0x1p-3f, in->varying[1] * in->z,
                                  in->varying[2] + in->w * 0x1p-6f, in->varying[3] };
    out->discard = in->varying[0] > 0.7f;
}

static void show_deep(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
    out->depth = in->varying[2];
}

static void show_flat(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[4], in->varying[5], in->varying[6], in->varying[7] };
}

static void show_flat_some(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_flat(out, in, uniforms);
    out->discard = in->varying[4] > 0.7f;
}

static void show_sprite(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->st[0] * 0.5f, in->st[1], in->z, lom_splat(0.5f) };
}

static void show_soft(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->st[0] * 0.5f, in->target_depth, in->z, lom_splat(0.5f) };
}

LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(cut, place_all, show_values, .attributes = 4, .varyings = 8, .reads = LOM_VARYINGS(0, 4),
           .clip_distances = 1, .colors = 1)
LOM_SHADER(some, place_all, show_some, .attributes = 4, .varyings = 8, .reads = LOM_VARYINGS(0, 4),
           .differentiates = 1u << 1, .reads_position = true, .discards = true, .colors = 1)
LOM_SHADER(deep, place_values, show_deep, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .writes_depth = true, .colors = 1)
LOM_SHADER(flat, place_all, show_flat, .attributes = 4, .varyings = 8, .reads = LOM_VARYINGS(4, 4),
           .flat = LOM_VARYINGS(4, 4), .colors = 1)
LOM_SHADER(flat_some, place_all, show_flat_some, .attributes = 4, .varyings = 8, .reads = LOM_VARYINGS(4, 4),
           .flat = LOM_VARYINGS(4, 4), .discards = true, .colors = 1)
LOM_SHADER(sprites, place_all, show_sprite, .attributes = 4, .varyings = 8, .reads_position = true, .colors = 1,
           .sprites = true)
LOM_SHADER(discs, place_all, show_soft, .attributes = 4, .varyings = 8, .reads_position = true, .colors = 1,
           .sprites = true, .round = true, .reads_depth = true)
LOM_DEPTH_SHADER(depth_only, place_values, .attributes = 2, .varyings = 4)

static vertex moved[3 * TRIANGLES];

/* The heap drawn with the state of `round`. */
struct state {
    const char *name;
    const lom_shader *shader;
    lom_compare compare;
    lom_format depth;
    bool blends, writes_off, biased, whole; /* whole: a fragment is one colour, shaded once */
};

static const struct state states[] = {
    { "plain", &values, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, false, false, false, false },
    { "without depth", &values, LOM_COMPARE_DEFAULT, LOM_FORMAT_NONE, true, false, false, false },
    { "less, 16 bits", &values, LOM_COMPARE_LESS_EQUAL, LOM_FORMAT_DEPTH16, false, false, false, false },
    { "blended", &values, LOM_COMPARE_GREATER_EQUAL, LOM_FORMAT_DEPTH24, true, true, false, false },
    { "cut", &cut, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, false, false, false, false },
    { "biased", &values, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH24, false, false, true, false },
    { "thrown away", &some, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, true, false, false, false },
    { "depths of shaders", &deep, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, false, false, false, false },
    { "depth alone", &depth_only, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, false, false, false, false },
    { "one colour", &flat, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, false, false, false, true },
    { "one colour, blended", &flat, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, true, true, false, true },
    { "one colour, thrown away", &flat_some, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH16, true, false, true, true },
    { "sprites", &sprites, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, true, false, false, false },
    { "discs", &discs, LOM_COMPARE_DEFAULT, LOM_FORMAT_DEPTH32F, true, true, false, false },
};

static void draw_state(stage *s, const struct state *state, const vertex *v, lom_pass_desc pass, bool per_sample)
{
    lom_draw_desc ground = draw_of(&values, v, 3 * 8), draw = draw_of(state->shader, v, 3 * TRIANGLES);
    draw.depth_compare = state->compare;
    draw.depth_write_off = state->writes_off;
    draw.depth_bias = state->biased ? 3 : 0;
    draw.depth_bias_slope = state->biased ? 0.5f : 0;
    draw.per_sample = ground.per_sample = per_sample;
    draw.topology = state->shader->sprites ? LOM_SPRITES : LOM_TRIANGLES;
    if (state->blends)
        draw.blend[0] = (lom_blend){ .enabled = true,
                                     .source_color = LOM_FACTOR_SOURCE_ALPHA,
                                     .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                     .source_alpha = LOM_FACTOR_ONE,
                                     .target_alpha = LOM_FACTOR_ONE };
    pass.clear_color[0][1] = 0.25f;
    pass.clear_depth = state->compare == LOM_COMPARE_LESS_EQUAL ? 0.8f : 0.1f;
    begin(s, pass);
    if (!state->whole)
        lom_draw(s->device, &ground);
    lom_draw(s->device, &draw);
    finish(s);
}

/* Added in pairs, as documented. */
static float mean(float *x, int count)
{
    for (int left = count; left > 1; left /= 2)
        for (int i = 0; i < left / 2; i++)
            x[i] = x[2 * i] + x[2 * i + 1];
    return x[0] / (float)count;
}

static void move_heap(int samples, int i)
{
    int at[2];
    lom_sample_position(samples, i, at);
    memcpy(moved, heap, sizeof moved);
    for (size_t k = 0; k < 3 * TRIANGLES; k++) {
        moved[k].position[0] -= (float)at[0] / (8 * SIZE) * moved[k].position[3];
        moved[k].position[1] += (float)at[1] / (8 * SIZE) * moved[k].position[3];
    }
}

static void compare_with_pictures(const struct state *state, int samples, lom_device_desc desc)
{
    static float colors[16][SIZE * SIZE * 4];
    stage several = open_stage(desc, SIZE, SIZE, LOM_FORMAT_RGBA32F, state->depth);
    stage one = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, state->depth);
    draw_state(&several, state, heap, (lom_pass_desc){ .samples = samples }, !state->whole);
    for (int i = samples - 1; i >= 0; i--) {
        move_heap(samples, i);
        draw_state(&one, state, moved, (lom_pass_desc){ .samples = 1 }, false);
        memcpy(colors[i], one.image->pixels, sizeof colors[i]);
    }
    int wrong = 0;
    for (size_t k = 0; k < SIZE * SIZE * 4; k++) {
        float x[16];
        for (int i = 0; i < samples; i++)
            x[i] = colors[i][k];
        wrong += mean(x, samples) != ((const float *)several.image->pixels)[k];
    }
    CHECK(wrong == 0, "%s, %d samples: %d numbers are not the mean of the pictures", state->name, samples, wrong);
    CHECK(several.depths == NULL || same_images(several.depths, one.depths),
          "%s, %d samples: the depth is not that of sample 0", state->name, samples);
    close_stage(&several);
    close_stage(&one);
}

static void samples_are_pictures_of_their_own(void)
{
    make_heap();
    for (size_t i = 0; i < sizeof states / sizeof states[0]; i++)
        for (int k = 0; k < 4; k++)
            compare_with_pictures(&states[i], counts[k],
                                  (lom_device_desc){ .threads = 1 + k % 2,
                                                     .tile = 16 << (i + (size_t)k) % 3,
                                                     .chunk = k == 1 ? 16 : 0,
                                                     .batch = k == 1 ? 2 : 0 });
}

int main(int argc, char **argv)
{
    RUN(samples_lie_where_they_are_said_to);
    RUN(samples_are_covered_as_the_oracle_says);
    RUN(a_mesh_covers_each_sample_once);
    RUN(samples_are_pictures_of_their_own);
    return check_result();
}
