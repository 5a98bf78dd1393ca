/* Proves that what is recorded of a pixel is what was drawn: the bytes are those of a device that watches nothing, the
 * last write ends in them, coverage is the oracle's (pipeline/stage.h), weights are those of the exact edge functions,
 * taps add up to what the sampler gave, and each triangle's fate is the one that it was made for. */
#include "../pipeline/stage.h"

#include <lom/record.h>

enum { SIZE = 48, TRIANGLES = 40 };

struct look {
    const lom_texture *texture;
    float threshold;
};

static void texture_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    LOM_NAME_VALUE(in->attribute[1]);
}

static void texture_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct look *look = uniforms;
    lom_float twice = in->varying[0] * 2.0f;
    LOM_NAME_VALUE(twice);
    lom_float4 texel = lom_sample(look->texture, in->varying[0], in->varying[1], in->varying[2]);
    out->color[0] = texel;
    out->discard = in->varying[3] < look->threshold;
}

LOM_SHADER(shown, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(textured, texture_vertex, texture_fragment, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .discards = true, .colors = 1, .uniforms_size = sizeof(struct look))

/* Three lookups: a comparison, a gather, and a sample by gradients that takes several probes. */
static void reading_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct look *look = uniforms;
    lom_float s = in->varying[0], t = in->varying[1], zero = { 0 };
    lom_float share = lom_sample_compare(look->texture, s, t, lom_splat(0.5f), LOM_COMPARE_GREATER);
    lom_float4 four = lom_sample_gather(look->texture, s, t, 1);
    lom_float4 mean = lom_sample_gradient(look->texture, s, t, lom_splat(0.5f), zero, zero, lom_splat(0.125f));
    out->color[0] = (lom_float4){ share, four.x, four.z, mean.x };
}

LOM_SHADER(reading, place_values, reading_fragment, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .colors = 1, .uniforms_size = sizeof(struct look))

static void constant_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(0.25f), lom_splat(0.5f), lom_splat(0.75f), lom_splat(0.5f) };
}

LOM_SHADER(constant, place_values, constant_fragment, .attributes = 2, .varyings = 4, .colors = 1)

static void cut_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->distance[0] = in->attribute[3].x;
}

LOM_SHADER(cut, cut_vertex, show_values, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .clip_distances = 1, .colors = 1)

static const lom_triangle_record *first_of(const lom_pixel_record *pixel)
{
    return pixel->passes != NULL && pixel->passes->draws != NULL ? pixel->passes->draws->triangles : NULL;
}

/* ---- random triangles ---- */

static vertex soup[3 * TRIANGLES];

static void make_soup(void)
{
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        float reach = i / 3 % 5 == 0 ? 40.0f : i / 3 % 5 == 1 ? 0.1f : 1.2f;
        for (int k = 0; k < 2; k++)
            soup[i].position[k] = (i / 3 % 5 == 1 ? soup[i / 3 * 3].position[k] : 0) + random_float(-reach, reach);
        soup[i].position[2] = random_float(0.1f, 0.9f);
        soup[i].position[3] = i / 3 % 7 == 3 ? random_float(-0.5f, 2) : random_float(0.9f, 2);
        for (int k = 0; k < 4; k++)
            soup[i].value[k] = random_float(-0.1f, 1.1f);
    }
}

static void draw_soup(stage *s)
{
    lom_draw_desc draw = draw_of(&shown, soup, 3 * TRIANGLES);
    begin(s, (lom_pass_desc){ .clear_color = { { 0.1f, 0.2f, 0.3f, 1 } } });
    lom_draw(s->device, &draw);
    draw.shader = &constant;
    draw.count = 30;
    draw.first = 3;
    draw.blend[0] = (lom_blend){ .enabled = true,
                                 .source_color = LOM_FACTOR_SOURCE_ALPHA,
                                 .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                 .source_alpha = LOM_FACTOR_ONE };
    lom_draw(s->device, &draw);
    finish(s);
}

/* The attachment's numbers after the last write, or of the clear colour. */
static void last_numbers(const lom_pixel_record *pixel, float numbers[4])
{
    for (int c = 0; c < 4; c++)
        numbers[c] = 256;
    for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                if (t->covered && t->fragment.write[0].written)
                    memcpy(numbers, t->fragment.write[0].after, 4 * sizeof *numbers);
}

static void recorded_pixels_end_in_the_bytes_of_the_picture(void)
{
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB };
    for (int round = 0; round < 12; round++) {
        lom_device_desc desc = {
            .threads = 1 + round % 3, .tile = round % 2 ? 16 : 64, .chunk = 16, .batch = 1 + round % 4
        };
        stage plain =
            open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, formats[round % 2], LOM_FORMAT_DEPTH32F);
        stage watched = open_stage(desc, SIZE, SIZE, formats[round % 2], LOM_FORMAT_DEPTH32F);
        make_soup();
        draw_soup(&plain);
        CHECK(lom_watch(watched.device,
                        &(lom_watch_desc){ .target = watched.color, .x = 4, .y = 6, .width = 40, .height = 30 }, 1));
        draw_soup(&watched);
        CHECK(same_images(plain.image, watched.image), "round %d", round);
        for (int i = 0; i < 40 * 30; i++) {
            int x = 4 + i % 40, y = 6 + i / 40;
            const lom_pixel_record *pixel = lom_watched_pixel(watched.device, 0, x, y);
            const uint8_t *bytes = bytes_at(&plain, x, y);
            float numbers[4];
            last_numbers(pixel, numbers);
            for (int c = 0; c < 4; c++) {
                CHECK(pixel->passes->end[c] == bytes[c], "round %d, pixel %d,%d", round, x, y);
                CHECK(numbers[c] == 256 || numbers[c] == bytes[c], "round %d, pixel %d,%d", round, x, y);
            }
        }
        close_stage(&plain);
        close_stage(&watched);
    }
}

/* Lines of every width, some cut by near, far and w, in strips and lists: the record of a pixel names those that add to it,
 * by weights that add up to 1, and ends in its number. */
static void lines_are_recorded(void)
{
    int counted = 0;
    for (int round = 0; round < 12; round++) {
        stage s[2];
        for (int i = 0; i < 2; i++)
            s[i] = open_stage((lom_device_desc){ .threads = 1 + i, .tile = 16 << i, .chunk = 16 }, SIZE, SIZE,
                              LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
        make_soup();
        lom_draw_desc draw = draw_of(&constant, soup, 3 * TRIANGLES);
        draw.topology = round % 2 == 0 ? LOM_LINES : LOM_LINE_STRIP;
        draw.line_width = 1 + round / 2;
        draw.depth_clamp = round % 4 == 3;
        draw.blend[0] = adding();
        CHECK(lom_watch(s[1].device,
                        &(lom_watch_desc){ .target = s[1].color, .x = 0, .y = 0, .width = SIZE, .height = SIZE }, 1));
        for (int i = 0; i < 2; i++) {
            begin(&s[i], (lom_pass_desc){ .samples = 1 });
            lom_draw(s[i].device, &draw);
            finish(&s[i]);
        }
        CHECK(same_images(s[0].image, s[1].image), "round %d", round);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const lom_pixel_record *pixel = lom_watched_pixel(s[1].device, 0, p % SIZE, p / SIZE);
            float numbers[4];
            int lines = 0;
            last_numbers(pixel, numbers);
            for (const lom_triangle_record *t = first_of(pixel); t != NULL; t = t->next) {
                const lom_fragment_record *f = &t->fragment;
                lines += t->covered;
                CHECK(t->covered && !t->has_edges && f->l[2] == 0 && f->l[0] >= 0 && f->l[1] >= 0 &&
                          f->l[0] + f->l[1] > 1 - 1e-6f && f->l[0] + f->l[1] < 1 + 1e-6f,
                      "round %d, pixel %d: %g %g", round, p, (double)f->l[0], (double)f->l[1]);
                CHECK(t->vertex[0].index + 1 == t->vertex[1].index, "round %d, pixel %d", round, p);
            }
            CHECK((float)lines * 0.25f == floats_at(&s[0], p % SIZE, p / SIZE)[0], "round %d, pixel %d: %d", round, p,
                  lines);
            CHECK(lines == 0 || numbers[0] == floats_at(&s[0], p % SIZE, p / SIZE)[0], "round %d, pixel %d", round, p);
            counted += lines;
        }
        close_stage(&s[0]);
        close_stage(&s[1]);
    }
    CHECK(counted > 10000, "%d", counted);
}

/* ---- coverage and weights ---- */

/* Triangles whose corners lie within `reach` of each other, seen from some rows of the window. Returns how many times
 * one covered a pixel. */
static int compare_coverage(float reach, int top, int rows)
{
    stage s = open_stage((lom_device_desc){ .threads = 2 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        const float *near = soup[i / 3 * 3].position;
        float x = i % 3 == 0 ? random_float(-1, 1) : near[0] + random_float(-reach, reach);
        float y = i % 3 == 0 ? random_float(-1, 1) : near[1] + random_float(-reach, reach);
        soup[i] = (vertex){ .position = { x, y, 0.5f, 1 } };
        for (int k = 0; k < 4; k++)
            soup[i].value[k] = random_float(0, 1);
    }
    CHECK(lom_watch(s.device, &(lom_watch_desc){ .target = s.color, .x = 0, .y = top, .width = SIZE, .height = rows },
                    1));
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw_desc draw = draw_of(&shown, soup, 3 * TRIANGLES);
    lom_draw(s.device, &draw);
    finish(&s);
    int counted = 0;
    for (int p = top * SIZE; p < (top + rows) * SIZE; p++) {
        const lom_triangle_record *t = first_of(lom_watched_pixel(s.device, 0, p % SIZE, p / SIZE));
        for (size_t i = 0; i < TRIANGLES; i++) {
            snapped v[3];
            for (int k = 0; k < 3; k++)
                v[k] = snap(soup[3 * i + (size_t)k].position, SIZE, SIZE);
            bool is_there = t != NULL && t->number == i;
            CHECK(is_there == covers(v, p % SIZE, p / SIZE), "triangle %zu at %d,%d", i, p % SIZE, p / SIZE);
            if (!is_there)
                continue;
            CHECK(t->covered && t->vertex[0].index == 3 * i && t->vertex[1].fixed[0] == v[1].x &&
                  t->vertex[1].fixed[1] == v[1].y);
            float inverse = 1.0f / (float)t->area;
            for (int k = 0; k < 3; k++) {
                CHECK(t->fragment.l[k] == (float)t->edge[k] * inverse, "triangle %zu at %d,%d", i, p % SIZE, p / SIZE);
                CHECK(t->fragment.b[k] - t->fragment.l[k] < 1e-6f && t->fragment.l[k] - t->fragment.b[k] < 1e-6f);
                float mixed = 0;
                for (int m = 0; m < 3; m++)
                    mixed += t->fragment.b[m] * t->vertex[t->order[m]].attribute[1][k];
                CHECK(mixed - t->fragment.varying[k] < 1e-5f && t->fragment.varying[k] - mixed < 1e-5f);
            }
            counted++;
            t = t->next;
        }
        CHECK(t == NULL);
    }
    close_stage(&s);
    return counted;
}

static void what_covers_is_what_the_oracle_says(void)
{
    int counted = compare_coverage(2, 0, SIZE);
    CHECK(counted > 5000, "only %d", counted);
}

/* Triangles that come near a watched pixel lie among others that do not, in the same packets. */
static void what_covers_a_few_rows_is_what_the_oracle_says(void)
{
    int counted = 0;
    for (int top = 0; top + 3 <= SIZE; top += 3)
        counted += compare_coverage(0.6f, top, 3);
    CHECK(counted > 500, "only %d", counted);
}

/* ---- fates ---- */

/* A triangle over the whole window at a depth, w = 1. */
static void fill(vertex v[3], float depth, float red)
{
    static const float at[3][2] = { { -1, -1 }, { 3, -1 }, { -1, 3 } };
    for (int k = 0; k < 3; k++)
        v[k] = (vertex){ .position = { at[k][0], at[k][1], depth, 1 }, .value = { red, 0, 0, 1 }, .distance = { 1 } };
}

static void swap_two(vertex v[3])
{
    vertex first = v[0];
    v[0] = v[1];
    v[1] = first;
}

static void each_fate_is_told(void)
{
    enum { COUNT = 8 };
    static const lom_fate expected[COUNT] = {
        LOM_FATE_LOST,    LOM_FATE_STORED,   LOM_FATE_DEPTH,   LOM_FATE_FACING,
        LOM_FATE_SCISSOR, LOM_FATE_DISTANCE, LOM_FATE_CLIPPED, LOM_FATE_DISTANCE
    };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    static vertex v[COUNT][3];
    for (int i = 0; i < COUNT; i++)
        fill(v[i], i == 0 ? 0.25f : i == 2 ? 0.125f : i == 6 ? 1.5f : 0.5f, (float)i / 255.0f);
    swap_two(v[3]);
    for (int k = 0; k < 3; k++) {
        v[5][k].distance[0] = -1;
        v[7][k].distance[0] = v[7][k].position[0] - 0.9f; /* negative at the pixel, positive at one vertex */
    }
    CHECK(lom_watch(s.device, &(lom_watch_desc){ .target = s.color, .x = 10, .y = 20 }, 1));
    begin(&s, (lom_pass_desc){ .label = "fates" });
    for (int i = 0; i < COUNT; i++) {
        lom_draw_desc draw = draw_of(&cut, v[i], 3);
        draw.cull = LOM_CULL_BACK;
        draw.label = "a draw";
        if (i == 4)
            draw.scissor = (lom_rect){ 30, 30, 10, 10 };
        lom_draw(s.device, &draw);
    }
    finish(&s);
    const lom_pixel_record *pixel = lom_watched_pixel(s.device, 0, 10, 20);
    CHECK(strcmp(pixel->passes->label, "fates") == 0 && pixel->passes->next == NULL);
    int i = 0;
    for (const lom_draw_record *draw = pixel->passes->draws; draw != NULL; draw = draw->next, i++) {
        const lom_triangle_record *t = draw->triangles;
        CHECK(draw->number == (size_t)i && strcmp(draw->label, "a draw") == 0 && t != NULL && t->next == NULL);
        CHECK(t->fate == expected[i], "draw %d: %s", i, lom_fate_text(t->fate));
    }
    CHECK(i == COUNT, "%d draws", i);
    const lom_triangle_record *lost = pixel->passes->draws->triangles;
    CHECK(lost->lost_to == pixel->passes->draws->next->triangles);
    CHECK(lost->fragment.depth == 0.25f && lost->fragment.depth_before == 0 && lost->fragment.depth_passed);
    CHECK(lost->lost_to->fragment.depth_before == 0.25f && lost->lost_to->fragment.write[0].before[0] == 0 &&
          lost->lost_to->fragment.write[0].after[0] == 1);
    close_stage(&s);
}

/* ---- textures and names ---- */

static void taps_add_up_and_values_bear_their_names(void)
{
    enum { EDGE = 8 };
    static uint8_t texels[EDGE * EDGE * 4];
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (size_t i = 0; i < sizeof texels; i++)
        texels[i] = (uint8_t)random_whole(0, 255);
    lom_texture *texture = lom_make_texture(
        s.device,
        &(lom_texture_desc){ .width = EDGE, .height = EDGE, .pixels = texels, .mips = LOM_MIPS_ALL, .label = "noise" });
    struct look look = { texture, 0.25f };
    static vertex v[3];
    for (int round = 0; round < 200; round++) {
        fill(v, 0.5f, 0);
        const float at[3] = { random_float(-2, 2), random_float(-2, 2), round % 2 ? 0 : random_float(0, 3) };
        bool drops = round % 5 == 0;
        for (int k = 0; k < 3; k++) {
            memcpy(v[k].value, at, sizeof at);
            v[k].value[3] = drops ? 0 : 1;
        }
        CHECK(lom_watch(s.device, &(lom_watch_desc){ .target = s.color, .x = round % SIZE, .y = 7 }, 1));
        begin(&s, (lom_pass_desc){ .samples = 1 });
        lom_draw_desc draw = draw_of(&textured, v, 3);
        draw.uniforms = &look;
        lom_draw(s.device, &draw);
        finish(&s);
        const lom_triangle_record *t = first_of(lom_watched_pixel(s.device, 0, round % SIZE, 7));
        CHECK(t != NULL && t->fate == (drops ? LOM_FATE_DISCARDED : LOM_FATE_STORED));
        const lom_note_record *named = t->fragment.notes, *lookup = named->next;
        CHECK(strcmp(named->name, "twice") == 0 && named->components == 1 && named->value[0] == 2 * at[0]);
        CHECK(strcmp(t->vertex[2].notes->name, "in->attribute[1]") == 0 && t->vertex[2].notes->value[1] == at[1]);
        CHECK(lookup->kind == LOM_NOTE_LOOKUP && lookup->texture == texture && strcmp(lookup->name, "noise") == 0);
        CHECK(lookup->value[3] == at[2] && lookup->taps >= 1 && lookup->taps <= 8 && lookup->next == NULL);
        float weight = 0, sum[4] = { 0 };
        for (int i = 0; i < lookup->taps; i++) {
            const lom_tap *tap = &lookup->tap[i];
            int size = EDGE >> tap->level, x = (tap->x + size) % size, y = (tap->y + size) % size;
            CHECK(tap->level > 0 || tap->color[1] == (float)texels[(y * EDGE + x) * 4 + 1] / 255.0f);
            weight += tap->weight;
            for (int c = 0; c < 4; c++)
                sum[c] += tap->weight * tap->color[c];
        }
        CHECK(weight > 0.99999f && weight < 1.00001f, "%g", (double)weight);
        for (int c = 0; c < 4; c++)
            CHECK(sum[c] - lookup->result[c] < 1e-5f && lookup->result[c] - sum[c] < 1e-5f &&
                  lookup->result[c] == t->fragment.color[0][c]);
    }
    close_stage(&s);
}

/* The texel of a tap that lies at a corner of its four: k is 0 left, 1 right, plus 2 below. */
static float corner(const lom_note_record *lookup, int k, int channel)
{
    int x = lookup->tap[0].x, y = lookup->tap[0].y;
    for (int i = 0; i < lookup->taps; i++) {
        x = lookup->tap[i].x < x ? lookup->tap[i].x : x;
        y = lookup->tap[i].y < y ? lookup->tap[i].y : y;
    }
    for (int i = 0; i < lookup->taps; i++)
        if (lookup->tap[i].x - x == k % 2 && lookup->tap[i].y - y == k / 2)
            return lookup->tap[i].color[channel];
    return -1;
}

static void comparisons_gathers_and_probes_are_lookups(void)
{
    enum { EDGE = 8 };
    static uint8_t texels[EDGE * EDGE * 4];
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    for (size_t i = 0; i < sizeof texels; i++)
        texels[i] = (uint8_t)random_whole(0, 255);
    struct look look = { lom_make_texture(s.device, &(lom_texture_desc){ .width = EDGE,
                                                                         .height = EDGE,
                                                                         .pixels = texels,
                                                                         .mips = LOM_MIPS_ALL,
                                                                         .sampler = { .anisotropy = 4 } }),
                         0 };
    static vertex v[3];
    for (int round = 0; round < 50; round++) {
        fill(v, 0.5f, 0);
        for (int k = 0; k < 3; k++) { /* never at a centre: four taps */
            v[k].value[0] = v[0].value[0] = k > 0 ? v[0].value[0] : ((float)random_whole(0, 7) + 0.75f) / EDGE;
            v[k].value[1] = k > 0 ? v[0].value[1] : ((float)random_whole(0, 7) + 0.875f) / EDGE;
        }
        CHECK(lom_watch(s.device, &(lom_watch_desc){ .target = s.color, .x = 5, .y = 7 }, 1));
        begin(&s, (lom_pass_desc){ .samples = 1 });
        lom_draw_desc draw = draw_of(&reading, v, 3);
        draw.uniforms = &look;
        lom_draw(s.device, &draw);
        finish(&s);
        const lom_triangle_record *t = first_of(lom_watched_pixel(s.device, 0, 5, 7));
        const lom_note_record *compared = t->fragment.notes, *gathered = compared->next;
        CHECK(compared->kind == LOM_NOTE_LOOKUP && compared->taps == 4 && gathered->taps == 4);
        float share = 0, mean = 0;
        for (int i = 0; i < 4; i++)
            share += 0.5f > compared->tap[i].color[0] ? compared->tap[i].weight : 0;
        CHECK(share - compared->result[0] < 1e-6f && compared->result[0] - share < 1e-6f &&
                  compared->result[0] == t->fragment.color[0][0],
              "round %d: %g", round, (double)share);
        CHECK(gathered->result[0] == corner(gathered, 2, 1) && gathered->result[1] == corner(gathered, 3, 1) &&
                  gathered->result[2] == corner(gathered, 1, 1) && gathered->result[3] == corner(gathered, 0, 1),
              "round %d", round);
        int probes = 0;
        for (const lom_note_record *probe = gathered->next; probe != NULL; probe = probe->next, probes++)
            mean += probe->result[0] / 4;
        mean -= t->fragment.color[0][3];
        CHECK(probes == 4 && mean < 1e-5f && mean > -1e-5f, "round %d: %d probes, off by %g", round, probes,
              (double)mean);
    }
    close_stage(&s);
}

/* ---- passes ---- */

static void a_record_begins_with_the_pass_that_cleared(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    static vertex v[3];
    uint64_t pass;
    fill(v, 0.5f, 1);
    lom_draw_desc draw = draw_of(&shown, v, 3);
    const lom_watch_desc watches[2] = { { .target = s.color, .x = 1, .y = 1 }, { .target = s.color, .before = 3 } };
    CHECK(lom_watch(s.device, watches, 2));
    for (int i = 0; i < 4; i++) {
        begin(&s, (lom_pass_desc){ .color_load = { i == 2 || i == 3 ? LOM_LOAD_KEEP : LOM_LOAD_CLEAR } });
        lom_draw(s.device, &draw);
        finish(&s);
    }
    const lom_pass_record *all = lom_watched_pixel(s.device, 0, 1, 1)->passes;
    const lom_pass_record *some = lom_watched_pixel(s.device, 1, 0, 0)->passes;
    CHECK(all->number == 1 && all->next->number == 2 && all->next->next->number == 3 && all->next->next->next == NULL);
    CHECK(all->draws->triangles->fate == LOM_FATE_LOST && all->next->next->draws->triangles->fate == LOM_FATE_STORED);
    CHECK(some->number == 1 && some->next->number == 2 && some->next->next == NULL);
    CHECK(lom_find_drawn(s.device, s.color, 3, &pass) && pass == 2 && !lom_find_drawn(s.device, s.color, 0, &pass));
    CHECK(lom_watched_pixel(s.device, 0, 2, 1) == NULL && lom_count_watched_passes(s.device) == 4);
    CHECK(lom_watch(s.device, NULL, 0) && lom_watched_pixel(s.device, 0, 1, 1) == NULL);
    CHECK(!lom_watch(s.device, &(lom_watch_desc){ .target = s.color, .x = SIZE }, 1));
    CHECK(strstr(lom_device_error(s.device)->text, "do not lie in") != NULL);
    close_stage(&s);
}

int main(int argc, char **argv)
{
#ifndef LOM_RECORD
    printf("SKIP %s: it is of the variant 4_recorded\n", argv[0]);
    return argc < 1;
#endif
    RUN(recorded_pixels_end_in_the_bytes_of_the_picture);
    RUN(lines_are_recorded);
    RUN(what_covers_is_what_the_oracle_says);
    RUN(what_covers_a_few_rows_is_what_the_oracle_says);
    RUN(each_fate_is_told);
    RUN(taps_add_up_and_values_bear_their_names);
    RUN(comparisons_gathers_and_probes_are_lookups);
    RUN(a_record_begins_with_the_pass_that_cleared);
    return check_result();
}
