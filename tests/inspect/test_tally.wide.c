/* Proves that what is tallied at a texel is what the stages did there: each count and number here is known in closed form
 * or by the oracle of coverage (pipeline/stage.h); the bytes are those of a device that tallies nothing, and the numbers do
 * not depend on threads or chunks. */
#include "../march/media.h"
#include "../pipeline/stage.h"

#include <lom/record.h>
#include <lom/texture.h>

#include <math.h>

enum { SIZE = 64, TRIANGLES = 40 };

struct look {
    const lom_texture *texture;
    const lom_medium *medium;
};

LOM_SHADER(shown, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

static void constant_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_splat(0.25f), lom_splat(0.5f), lom_splat(0.75f), lom_splat(0.5f) };
}

LOM_SHADER(constant, place_values, constant_fragment, .attributes = 2, .varyings = 4, .colors = 1)

/* Infinite in the first four columns of pixels, no number in the next four, all else as it should be. */
static void broken_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float one = lom_splat(1.0f), zero = { 0 };
    lom_float value = lom_select(in->x < 4.0f, one / zero, lom_select(in->x < 8.0f, zero / zero, one));
    out->color[0] = (lom_float4){ one, value, one, one };
}

LOM_SHADER(broken, place_values, broken_fragment, .attributes = 2, .varyings = 4, .reads_position = true, .colors = 1)

static void broken_depth_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    constant_fragment(out, in, uniforms);
    lom_float zero = { 0 };
    out->depth = lom_select(in->y < 2.0f, zero / zero, lom_splat(0.5f));
}

LOM_SHADER(broken_depth, place_values, broken_depth_fragment, .attributes = 2, .varyings = 4, .reads_position = true,
           .writes_depth = true, .colors = 1)

static void textured_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct look *look = uniforms;
    out->color[0] = lom_sample(look->texture, in->varying[0], in->varying[1], lom_lod(look->texture, in, 0, 1));
    LOM_NAME_AS(place, in->varying[0]);
}

LOM_SHADER(textured, place_values, textured_fragment, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 2),
           .differentiates = LOM_VARYINGS(0, 2), .colors = 1, .uniforms_size = sizeof(struct look))

/* Names its column of pixels, from the 32nd on nothing. */
static void named_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    constant_fragment(out, in, uniforms);
    lom_float zero = { 0 };
    LOM_NAME_AS(place, lom_select(in->x < 32.0f, in->x, zero / zero));
}

LOM_SHADER(named, place_values, named_fragment, .attributes = 2, .varyings = 4, .reads_position = true, .colors = 1)

/* A slab that is an eighth of the medium thick in the first column, two eighths in the second, and so on. */
static void marched_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct look *look = uniforms;
    lom_medium_desc desc = plain(look->medium, 0.01, 0.125);
    lom_medium_rays rays = rays_along_x(0, 1);
    rays.leave = (in->x + 0.5f) * 0.125f;
    rays.active = in->y < 32.0f;
    lom_medium_result sum = march(&rays, &desc);
    out->color[0] = (lom_float4){ sum.transmittance, sum.transmittance, sum.transmittance, lom_splat(1.0f) };
}

LOM_SHADER(marched, place_values, marched_fragment, .attributes = 2, .varyings = 4, .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct look))

static void sprite_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    out->axis[0] = in->attribute[1];
    out->axis[1] = in->attribute[2];
}

LOM_SHADER(sprite, sprite_vertex, broken_fragment, .attributes = 3, .reads_position = true, .colors = 1,
           .sprites = true)

static void sized_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    out->point_size = lom_splat(4);
}

LOM_SHADER(sized, sized_vertex, broken_fragment, .attributes = 1, .reads_position = true, .colors = 1)

/* A triangle that holds all of the viewport, its depth z; value 0 and 1 run from 0 to `reach` along it. */
static void cover(vertex v[3], float z, float w, float reach)
{
    static const float corners[3][2] = { { -1, 1 }, { -1, -3 }, { 3, 1 } };
    for (int i = 0; i < 3; i++) {
        v[i] = (vertex){ .position = { corners[i][0] * w, corners[i][1] * w, z * w, w } };
        v[i].value[0] = (corners[i][0] + 1) / 2 * reach;
        v[i].value[1] = (1 - corners[i][1]) / 2 * reach;
    }
}

static stage open(int threads)
{
    return open_stage((lom_device_desc){ .threads = threads }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
}

static void tally_all(stage *s)
{
    lom_tally_desc desc = { .target = s->color, .lookups = true, .steps = true, .named = "place" };
    CHECK(lom_tally_target(s->device, &desc));
}

static void draw_one(stage *s, const lom_shader *shader, const vertex *v, size_t count, const struct look *look)
{
    lom_draw_desc draw = draw_of(shader, v, count);
    draw.uniforms = look;
    begin(s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s->device, &draw);
    finish(s);
}

/* ---- counts ---- */

/* Two triangles that cover all: the nearer one last, then first. */
static void overdraw_and_early_kills_follow_the_order(void)
{
    for (int order = 0; order < 2; order++)
        for (int flat = 0; flat < 2; flat++) {
            stage s = open(1 + order);
            vertex v[6];
            cover(v, order == 0 ? 0.25f : 0.5f, 1, 1);
            cover(v + 3, order == 0 ? 0.5f : 0.25f, 1, 1);
            tally_all(&s);
            draw_one(&s, flat ? &constant : &shown, v, 6, NULL);
            for (int p = 0; p < SIZE * SIZE; p++) {
                const lom_tally *t = lom_tallied(s.device, p % SIZE, p / SIZE);
                CHECK(t->fragments == (order == 0 ? 2u : 1u) && t->killed == (order == 0 ? 0u : 1u), "pixel %d", p);
                CHECK(t->is_stored && t->depth == 0.5f, "pixel %d: %g", p, t->depth);
            }
            close_stage(&s);
        }
}

/* Varyings run from 0 to 8 along the picture; a triangle of no object is blended over it. */
static void varyings_are_those_of_what_is_stored(void)
{
    for (int reads = 0; reads < 2; reads++) {
        stage s = open(1);
        vertex v[6];
        cover(v, 0.25f, 1, 8);
        cover(v + 3, 0.5f, 1, 1);
        tally_all(&s);
        lom_draw_desc draw = draw_of(reads ? &shown : &constant, v, 3), over = draw_of(&shown, v + 3, 3);
        over.blend[0] = adding();
        begin(&s, (lom_pass_desc){ .samples = 1 });
        lom_draw(s.device, &draw);
        lom_draw(s.device, &over);
        finish(&s);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const lom_tally *t = lom_tallied(s.device, p % SIZE, p / SIZE);
            double x = reads ? (p % SIZE + 0.5) / SIZE * 8 : 0, y = reads ? (p / SIZE + 0.5) / SIZE * 8 : 0;
            CHECK(t->has_varyings == (reads != 0) && fabs((double)t->varying[0] - x) <= 8 * 0x1p-21 &&
                      fabs((double)t->varying[1] - y) <= 8 * 0x1p-21,
                  "pixel %d: %d, %g %g", p, t->has_varyings, t->varying[0], t->varying[1]);
        }
        close_stage(&s);
    }
}

static void passes_add_up_until_one_clears(void)
{
    stage s = open(1);
    vertex v[3];
    cover(v, 0.5f, 1, 1);
    tally_all(&s);
    for (int pass = 0; pass < 6; pass++) {
        lom_draw_desc draw = draw_of(&shown, v, 3);
        draw.depth_test_off = true;
        draw.blend[0] = adding();
        begin(&s, (lom_pass_desc){ .color_load = { pass % 3 == 0 ? LOM_LOAD_CLEAR : LOM_LOAD_KEEP } });
        lom_draw(s.device, &draw);
        finish(&s);
        CHECK(lom_tallied(s.device, 5, 7)->fragments == (unsigned)(pass % 3 + 1), "pass %d", pass);
        CHECK(!lom_tallied(s.device, 5, 7)->is_stored); /* only blended */
    }
    lom_draw_desc draw = draw_of(&shown, v, 3);
    draw.blend[0] = adding();
    draw.object = 7;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    finish(&s);
    CHECK(lom_tallied(s.device, 5, 7)->is_stored && lom_tallied(s.device, 5, 7)->object == 7);
    close_stage(&s);
}

static void lanes_in_use_are_those_of_packets(void)
{
    stage s = open(1);
    vertex v[3];
    cover(v, 0.5f, 1, 1);
    tally_all(&s);
    draw_one(&s, &shown, v, 3, NULL);
    for (int p = 0; p < SIZE * SIZE; p++) {
        const lom_tally *t = lom_tallied(s.device, p % SIZE, p / SIZE);
        CHECK(t->packets == 1 && t->lanes == 4, "pixel %d: %u of %u", p, t->lanes, t->packets);
    }
    static const int64_t corners[3][2] = { { 20 * 256, 20 * 256 },
                                           { 20 * 256, 22 * 256 + 128 },
                                           { 22 * 256 + 128, 20 * 256 } };
    for (int i = 0; i < 3; i++) /* the centres of three pixels */
        place_at(&v[i], corners[i][0], corners[i][1], SIZE);
    draw_one(&s, &shown, v, 3, NULL);
    uint32_t packets = 0, lanes = 0;
    for (int p = 0; p < SIZE * SIZE; p++) {
        packets += lom_tallied(s.device, p % SIZE, p / SIZE)->packets;
        lanes += lom_tallied(s.device, p % SIZE, p / SIZE)->lanes;
    }
    CHECK(packets == 3 && lanes == 9, "%u, %u", packets, lanes);
    close_stage(&s);
}

static void broken_colors_are_those_pixels(void)
{
    stage s = open(2);
    vertex v[3];
    cover(v, 0.5f, 1, 1);
    tally_all(&s);
    draw_one(&s, &broken, v, 3, NULL);
    for (int p = 0; p < SIZE * SIZE; p++)
        CHECK(lom_tallied(s.device, p % SIZE, p / SIZE)->broken == (p % SIZE < 8), "pixel %d", p);
    draw_one(&s, &broken_depth, v, 3, NULL);
    for (int p = 0; p < SIZE * SIZE; p++)
        CHECK(lom_tallied(s.device, p % SIZE, p / SIZE)->broken == (p / SIZE < 2), "pixel %d", p);
    close_stage(&s);
}

/* A square of 16 x 16 pixels about (8, 32), behind a nearer triangle that covers all pixels below row 32. */
static void sprites_are_counted(void)
{
    stage s = open(2);
    vertex low[3], one = { .position = { -0.75f, 0, 0.25f, 1 }, .value = { 0.25f, 0, 0, 0, 0, 0.25f, 0, 0 } };
    cover(low, 0.5f, 1, 1);
    for (int i = 0; i < 3; i++)
        low[i].position[1] = i == 1 ? -4.0f : 0;
    low[2].position[0] = 40;
    lom_draw_desc nearer = draw_of(&shown, low, 3), draw = draw_of(&sprite, &one, 1);
    draw.topology = LOM_SPRITES;
    tally_all(&s);
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &nearer);
    lom_draw(s.device, &draw);
    finish(&s);
    for (int p = 0; p < SIZE * SIZE; p++) {
        const lom_tally *t = lom_tallied(s.device, p % SIZE, p / SIZE);
        int x = p % SIZE, y = p / SIZE, below = y >= 32;
        bool inside = x < 16 && y >= 24 && y < 40;
        CHECK(t->fragments == (unsigned)below + (inside && !below), "pixel %d: %u", p, t->fragments);
        CHECK(t->killed == (inside && below), "pixel %d: %u", p, t->killed);
        CHECK(t->broken == (inside && !below && x < 8), "pixel %d", p);
        CHECK(!inside || below || (t->packets == 1 && t->lanes == 4), "pixel %d", p);
    }
    close_stage(&s);
}

/* A point of size 4 about (8, 32), and a line from there to the right, are counted where they are; a watched or tallied pass
 * shows both as any other does. */
static void points_and_lines_are_counted(void)
{
    stage s[3] = { open(1), open(1), open(1) };
    const vertex ends[2] = { { .position = { -0.75f, 0, 0.5f, 1 } }, { .position = { 0.5f, 0.25f, 0.5f, 1 } } };
    tally_all(&s[1]);
    lom_watch(s[2].device, &(lom_watch_desc){ .target = s[2].color, .x = 8, .y = 30, .width = 8, .height = 4 }, 1);
    for (int i = 0; i < 3; i++) {
        lom_draw_desc point = draw_of(&sized, ends, 1), line = draw_of(&sized, ends, 2);
        point.topology = LOM_POINTS;
        line.topology = LOM_LINES;
        begin(&s[i], (lom_pass_desc){ .samples = 1 });
        lom_draw(s[i].device, &point);
        lom_draw(s[i].device, &line);
        finish(&s[i]);
        CHECK(same_images(s[i].image, s[0].image), "picture %d", i);
    }
    uint64_t counted = 0;
    for (int p = 0; p < SIZE * SIZE; p++) {
        int x = p % SIZE, y = p / SIZE;
        bool inside = x >= 6 && x < 10 && y >= 30 && y < 34;
        const lom_tally *tally = lom_tallied(s[1].device, x, y);
        counted += tally->fragments;
        CHECK(tally->fragments - inside <= (inside || x > 8) &&
                  (tally->fragments != 0) == (bytes_at(&s[0], x, y)[0] != 0),
              "pixel %d, %d: %u", x, y, tally->fragments);
        CHECK(tally->fragments == 0 || inside || (tally->is_stored && tally->edge == 0 && tally->depth == 0.5f),
              "pixel %d, %d: edge %g, depth %g", x, y, (double)tally->edge, (double)tally->depth);
    }
    CHECK(counted == lom_device_counters(s[0].device).fragments, "%llu", (unsigned long long)counted);
    CHECK(lom_device_counters(s[0].device).fragments > 16 + 30, "%llu fragments",
          (unsigned long long)lom_device_counters(s[0].device).fragments);
    for (int i = 0; i < 3; i++)
        close_stage(&s[i]);
}

static void steps_are_those_of_the_slab(void)
{
    stage s = open(2);
    vertex v[3];
    struct look look = { .medium = medium_along_x(8, one) };
    cover(v, 0.5f, 1, 1);
    tally_all(&s);
    draw_one(&s, &marched, v, 3, &look);
    for (int p = 0; p < SIZE * SIZE; p++) {
        uint32_t steps = lom_tallied(s.device, p % SIZE, p / SIZE)->steps;
        CHECK(steps == (p / SIZE < 32 ? (unsigned)(p % SIZE + 1) : 0), "pixel %d: %u", p, steps);
    }
    close_stage(&s);
    lom_free_medium((lom_medium *)(uintptr_t)look.medium);
}

/* ---- what is seen ---- */

/* A texture of 256 texels a side over a square that fills the viewport of 64, repeated r times: 4 r texels a pixel, so
 * level 2 + log2(r), at whatever distance w. */
static void levels_are_those_of_the_distance(void)
{
    stage s = open(1);
    vertex v[3];
    struct look look = { .texture = lom_make_texture(
                             s.device, &(lom_texture_desc){ .width = 256, .height = 256, .mips = LOM_MIPS_ALL }) };
    for (int k = -4; k <= 8; k++)
        for (int distance = 1; distance <= 4; distance *= 2) {
            float repeated = k < 0 ? 1.0f / (float)(1 << -k) : (float)(1 << k);
            cover(v, 0.5f, (float)distance, repeated);
            tally_all(&s);
            draw_one(&s, &textured, v, 3, &look);
            const lom_tally *t = lom_tallied(s.device, 30, 33);
            int level = k + 2 < 0 ? 0 : k + 2 > 8 ? 8 : k + 2;
            CHECK(t->is_mipped && t->asked == (float)(k + 2) && t->level == (float)level && t->lookups == 1,
                  "%d: asked %g, level %g", k, t->asked, t->level);
            CHECK(t->named_components == 1 && t->named[0] > 0.46f * repeated && t->named[0] < 0.49f * repeated, "%g",
                  t->named[0]);
        }
    close_stage(&s);
}

/* The last number stays through what is blended over it without one, and no further than what is stored. */
static void values_are_named_by_the_last_that_has_one(void)
{
    stage s = open(1);
    vertex v[3];
    struct look look = { .texture = lom_make_texture(s.device, &(lom_texture_desc){ .width = 4, .height = 4 }) };
    cover(v, 0.5f, 1, 1);
    tally_all(&s);
    lom_draw_desc below = draw_of(&textured, v, 3), over = draw_of(&named, v, 3);
    below.uniforms = &look;
    below.depth_test_off = over.depth_test_off = true;
    over.blend[0] = adding();
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &below);
    lom_draw(s.device, &over);
    finish(&s);
    for (int x = 0; x < SIZE; x++) {
        const lom_tally *t = lom_tallied(s.device, x, 9);
        float expected = (float)x + 0.5f;
        CHECK(t->named_components == 1 && t->named[0] == (x < 32 ? expected : expected / SIZE), "%d: %g", x,
              t->named[0]);
        CHECK(!t->is_mipped && t->lookups == 1); /* it has one level */
    }
    over.blend[0] = (lom_blend){ .enabled = false };
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &below);
    lom_draw(s.device, &over);
    finish(&s);
    for (int x = 0; x < SIZE; x++)
        CHECK(lom_tallied(s.device, x, 9)->named_components == (x < 32), "%d", x);
    close_stage(&s);
}

/* Right triangles with legs of whole 1/256 pixels, in each of the pipeline's kinds of triangles. */
static void areas_and_edges_are_those_of_the_triangle(void)
{
    static const int64_t legs[][2] = { { 700, 600 }, { 3000, 5000 }, { 10000, 16000 }, { 60000, 40000 } };
    for (size_t i = 0; i < sizeof legs / sizeof legs[0]; i++) {
        stage s = open(1);
        vertex v[3] = { { .value = { 0 } } };
        int64_t a = legs[i][0], b = legs[i][1];
        place_at(&v[0], 512, 512, SIZE);
        place_at(&v[1], 512, 512 + b, SIZE);
        place_at(&v[2], 512 + a, 512, SIZE);
        tally_all(&s);
        draw_one(&s, &shown, v, 3, NULL);
        int covered = 0;
        for (int p = 0; p < SIZE * SIZE; p++) {
            const lom_tally *t = lom_tallied(s.device, p % SIZE, p / SIZE);
            const snapped corners[3] = { { 512, 512 }, { 512, 512 + b }, { 512 + a, 512 } };
            bool inside = covers(corners, p % SIZE, p / SIZE);
            CHECK(t->fragments == inside && t->is_stored == inside, "legs %zu, pixel %d", i, p);
            if (!inside)
                continue;
            covered++;
            double area = (double)(a * b) / 2 / 65536, x = p % SIZE - 1.5, y = p / SIZE - 1.5;
            double pa = (double)a / 256, pb = (double)b / 256;
            double slanted = (pa * pb - pb * x - pa * y) / lom_double_sqrt(pa * pa + pb * pb);
            double least = x < y ? x : y;
            least = slanted < least ? slanted : least;
            CHECK(magnitude((double)t->area / area - 1) < 1e-6, "legs %zu: %g, not %g", i, t->area, area);
            CHECK(magnitude((double)t->edge - least) < 1e-4, "legs %zu, pixel %d: %g, not %g", i, p, t->edge, least);
            CHECK(t->made == 0 && !t->at_made && !t->is_mipped && t->named_components == 0);
        }
        CHECK(covered > 2, "legs %zu", i);
        close_stage(&s);
    }
}

/* A triangle with one vertex behind the eye: two new vertices where its edges meet the near plane, z = w. */
static void made_vertices_are_where_clipping_puts_them(void)
{
    stage s = open(1);
    vertex v[3] = { { .position = { -0.5f, -0.5f, 0.5f, 1 } },
                    { .position = { 0.5f, -0.5f, 0.5f, 1 } },
                    { .position = { 0, 1.5f, 1.5f, 1 } } };
    tally_all(&s);
    draw_one(&s, &shown, v, 3, NULL);
    /* cut halfway: (-0.25, 0.5) and (0.25, 0.5), pixels (24, 16) and (40, 16) */
    int seen = 0, near = 0;
    for (int p = 0; p < SIZE * SIZE; p++) {
        const lom_tally *t = lom_tallied(s.device, p % SIZE, p / SIZE);
        if (!t->is_stored)
            continue;
        double x = p % SIZE + 0.5, y = p / SIZE + 0.5;
        double left = (x - 24) * (x - 24) + (y - 16) * (y - 16), right = (x - 40) * (x - 40) + (y - 16) * (y - 16);
        CHECK(t->made == 1 || t->made == 2, "pixel %d: %d", p, t->made);
        CHECK(!t->at_made || left <= 6.25 || right <= 6.25, "pixel %d", p);
        CHECK(t->at_made || t->made < 2 || (left > 6.25 && right > 6.25), "pixel %d", p);
        seen++;
        near += t->at_made;
    }
    CHECK(seen > 300 && near > 5 && near < 30, "%d, %d", seen, near);
    close_stage(&s);
}

/* ---- the picture ---- */

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
    draw.blend[0] = adding();
    lom_draw(s->device, &draw);
    finish(s);
}

static bool same_tally(const lom_tally *a, const lom_tally *b)
{
    return a->fragments == b->fragments && a->killed == b->killed && a->broken == b->broken &&
           a->is_stored == b->is_stored && a->depth == b->depth && a->edge == b->edge && a->area == b->area &&
           a->made == b->made && a->at_made == b->at_made;
}

static void pictures_and_numbers_are_the_same_whatever_draws(void)
{
    for (int round = 0; round < 8; round++) {
        lom_device_desc desc = {
            .threads = 1 + round % 3, .tile = round % 2 ? 16 : 64, .chunk = 16, .batch = 1 + round % 4
        };
        stage once = open(1), tallied = open_stage(desc, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
        make_soup();
        draw_soup(&once);
        tally_all(&tallied);
        draw_soup(&tallied);
        CHECK(same_images(once.image, tallied.image) && same_images(once.depths, tallied.depths), "round %d", round);
        lom_image *plain = lom_convert_image(once.image, LOM_FORMAT_RGBA8, NULL);
        tally_all(&once);
        draw_soup(&once);
        CHECK(same_images(once.image, plain), "round %d", round);
        for (int p = 0; p < SIZE * SIZE; p++)
            CHECK(same_tally(lom_tallied(once.device, p % SIZE, p / SIZE),
                             lom_tallied(tallied.device, p % SIZE, p / SIZE)),
                  "round %d, pixel %d", round, p);
        lom_free_image(plain);
        close_stage(&once);
        close_stage(&tallied);
    }
}

static void time_is_that_of_tiles_alone(void)
{
    stage s = open_stage((lom_device_desc){ .threads = 2, .tile = 16 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    vertex v[3];
    cover(v, 0.5f, 1, 1);
    make_soup();
    for (int round = 0; round < 2; round++) { /* at several samples, too */
        lom_draw_desc draw = draw_of(&shown, soup, 3 * TRIANGLES);
        lom_image *before = s.image;
        s.image = NULL;
        CHECK(lom_tally_target(s.device, round == 0 ? NULL : &(lom_tally_desc){ .target = s.color, .clock = true }));
        begin(&s, (lom_pass_desc){ .samples = 4 });
        lom_draw(s.device, &draw);
        finish(&s);
        CHECK(round == 0 || same_images(before, s.image));
        lom_free_image(before);
    }
    CHECK(lom_tally_target(s.device, &(lom_tally_desc){ .target = s.color, .clock = true }));
    draw_one(&s, &shown, v, 3, NULL);
    for (int p = 0; p < SIZE * SIZE; p++) {
        const lom_tally *t = lom_tallied(s.device, p % SIZE, p / SIZE);
        CHECK(t->seconds > 0 && t->seconds == lom_tallied(s.device, p % SIZE & ~15, p / SIZE & ~15)->seconds);
        CHECK(t->fragments == 0 && !t->is_stored);
    }
    close_stage(&s);
}

static void what_cannot_be_tallied_is_an_error(void)
{
    stage s = open(1), other = open(1);
    CHECK(lom_tallied(s.device, 0, 0) == NULL && lom_tallied(NULL, 0, 0) == NULL);
    tally_all(&s);
    CHECK(lom_tallied(s.device, SIZE - 1, SIZE - 1) != NULL);
    CHECK(lom_tallied(s.device, SIZE, 0) == NULL && lom_tallied(s.device, 0, -1) == NULL);
    CHECK(lom_watch(s.device, NULL, 0) && lom_tallied(s.device, 0, 0) == NULL);
    tally_all(&s);
    CHECK(lom_tally_target(s.device, NULL) && lom_tallied(s.device, 0, 0) == NULL);
    CHECK(!lom_tally_target(s.device, &(lom_tally_desc){ .target = other.color }));
    CHECK(!lom_tally_target(other.device, &(lom_tally_desc){ .target = other.depth }));
    close_stage(&s);
    close_stage(&other);
    s = open(1);
    begin(&s, (lom_pass_desc){ .samples = 1 });
    CHECK(!lom_tally_target(s.device, &(lom_tally_desc){ .target = s.color }));
    close_stage(&s);
}

int main(int argc, char **argv)
{
#ifndef LOM_RECORD
    printf("SKIP %s: it is of the variant 4_recorded\n", argv[0]);
    return argc < 1;
#endif
    RUN(overdraw_and_early_kills_follow_the_order);
    RUN(varyings_are_those_of_what_is_stored);
    RUN(passes_add_up_until_one_clears);
    RUN(lanes_in_use_are_those_of_packets);
    RUN(broken_colors_are_those_pixels);
    RUN(sprites_are_counted);
    RUN(points_and_lines_are_counted);
    RUN(steps_are_those_of_the_slab);
    RUN(levels_are_those_of_the_distance);
    RUN(values_are_named_by_the_last_that_has_one);
    RUN(areas_and_edges_are_those_of_the_triangle);
    RUN(made_vertices_are_where_clipping_puts_them);
    RUN(pictures_and_numbers_are_the_same_whatever_draws);
    RUN(time_is_that_of_tiles_alone);
    RUN(what_cannot_be_tallied_is_an_error);
    return check_result();
}
