/* Proves of tessellated draws: patches that share edges cover every pixel exactly once (a triangle that snapping turned
 * over takes away what its neighbour has twice), whatever their levels, domains and
 * spacings, which way round each edge runs, and however they are cut into chunks, tiles and threads (no cracks, no
 * overlaps); what is drawn is what feedback of the same draw gives to a draw of triangles, lines and points, bit for
 * bit; control and evaluation get what they should; a patch with a level or a position that is no number leaves its
 * neighbours as they are; patches of a held draw, by their place in the indices and by a base vertex, are those of one draw;
 * what is refused. */
#include <lom/stages.h>

#include "pipeline/draw_again.h"
#include "stage.h"

enum { SIZE = 128, GRID = 6, PATCHES = GRID * GRID * 2, MOST_POINTS = PATCHES * 4 };

/* Attribute 1: levels; point 0 has the outer ones, point 1 the inner ones. */
static void levels_of_points(lom_levels *out, const lom_patch *in, const void *uniforms)
{
    (void)uniforms;
    for (int i = 0; i < 4; i++)
        out->outer[i] = in->point[0].varying[i];
    for (int i = 0; i < 2; i++)
        out->inner[i] = in->point[1].varying[i];
}

static lom_float4 weigh(const lom_float *weight, const lom_patch *patch)
{
    lom_float4 sum = { { 0 }, { 0 }, { 0 }, { 0 } };
    for (int i = 0; i < patch->points; i++) {
        sum.x += weight[i] * patch->point[i].position.x;
        sum.y += weight[i] * patch->point[i].position.y;
        sum.z += weight[i] * patch->point[i].position.z;
        sum.w += weight[i] * patch->point[i].position.w;
    }
    return sum;
}

/* Of an edge two weights are left, and a sum of two terms is the same either way round. */
static void evaluate(lom_vertex *out, const lom_domain_point *in, const void *uniforms)
{
    (void)uniforms;
    lom_float a = 1.0f - in->u, b = 1.0f - in->v;
    const lom_float three[] = { in->u, in->v, in->w }, four[] = { a * b, in->u * b, in->u * in->v, a * in->v };
    out->position = weigh(in->patch.points == 4 ? four : three, &in->patch);
    out->varying[0] = in->u;
    out->varying[1] = in->v;
    out->varying[2] = in->w + lom_to_float(in->patch.number);
    out->varying[3] = in->levels.outer[0] + in->levels.inner[0];
    out->point_size = lom_splat(1.5f) + in->u;
}

/* The same without the patch's number. */
static void evaluate_moved(lom_vertex *out, const lom_domain_point *in, const void *uniforms)
{
    evaluate(out, in, uniforms);
    out->varying[2] = in->w;
}

static void count(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float one = lom_select(in->front, lom_splat(1), lom_splat(-1));
    out->color[0] = (lom_float4){ one, one, one, one };
}

LOM_SHADER(counter, place_values, count, .attributes = 2, .varyings = 4, .reads_position = true, .colors = 1)
LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

LOM_TESSELLATION(by_points, levels_of_points, evaluate, .domain = LOM_DOMAIN_QUADS)
LOM_TESSELLATION(by_moved_points, levels_of_points, evaluate_moved, .domain = LOM_DOMAIN_QUADS)

static lom_tessellation tessellation_of(lom_domain domain, lom_spacing spacing)
{
    lom_tessellation t = by_points;
    t.domain = domain;
    t.spacing = spacing;
    return t;
}

/* ---- a quilt of patches ---- */

static vertex corners[MOST_POINTS];

static float level_of(uint64_t edge, uint64_t seed)
{
    uint64_t bits = lom_random_bits(seed, edge);
    return 0.25f + (float)(bits >> 40) * 0x1p-24f * (bits & 1 ? 40.0f : 6.0f);
}

/* Corner number of the grid's knot, moved about; beyond the picture at its border. */
static void put_knot(vertex *v, int x, int y, uint64_t seed)
{
    uint64_t bits = lom_random_bits(seed, (uint64_t)(y * 100 + x));
    float step = 2.5f / GRID, off = 0.2f * step;
    bool inside = x > 0 && x < GRID && y > 0 && y < GRID;
    float w = 1 + (float)(bits >> 60) / 8;
    v->position[0] = (-1.25f + (float)x * step + (inside ? off * ((float)(bits & 255) / 128 - 1) : 0)) * w;
    v->position[1] = (-1.25f + (float)y * step + (inside ? off * ((float)(bits >> 8 & 255) / 128 - 1) : 0)) * w;
    v->position[2] = 0.5f * w;
    v->position[3] = w;
}

static uint64_t edge_of(int ax, int ay, int bx, int by)
{
    uint64_t a = (uint64_t)(ay * 100 + ax), b = (uint64_t)(by * 100 + bx);
    return a < b ? a << 32 | b : b << 32 | a;
}

/* Outer level k of a patch whose corners are knots[0..n): quads have u = 0 between corners 3 and 0, v = 0 between 0 and 1;
 * triangles edge k across from corner k. */
static void put_patch(vertex *v, const int (*knot)[2], int n, uint64_t seed)
{
    for (int i = 0; i < n; i++)
        put_knot(&v[i], knot[i][0], knot[i][1], seed);
    for (int k = 0; k < n; k++) {
        const int *a = knot[n == 4 ? (k + 3) % 4 : (k + 1) % 3], *b = knot[n == 4 ? k : (k + 2) % 3];
        v[0].value[k] = level_of(edge_of(a[0], a[1], b[0], b[1]), seed);
    }
    v[1].value[0] = level_of((uint64_t)knot[0][0] * 77 + (uint64_t)knot[0][1] + 1000000, seed);
    v[1].value[1] = level_of((uint64_t)knot[0][0] * 78 + (uint64_t)knot[0][1] + 2000000, seed);
}

static size_t make_quilt(int points, uint64_t seed)
{
    size_t count = 0;
    memset(corners, 0, sizeof corners);
    for (int y = 0; y < GRID; y++)
        for (int x = 0; x < GRID; x++) {
            const int square[4][2] = { { x, y }, { x + 1, y }, { x + 1, y + 1 }, { x, y + 1 } };
            uint64_t turn = lom_random_bits(seed, (uint64_t)(y * 100 + x) + 7000) & 3;
            for (int half = 0; half < (points == 4 ? 1 : 2); half++) {
                int knot[4][2];
                for (int i = 0; i < points; i++)
                    memcpy(knot[i], square[((uint64_t)i + turn + (uint64_t)(i > 0 && points == 3 ? half : 0)) & 3],
                           sizeof knot[i]);
                put_patch(corners + count, (const int(*)[2])knot, points, seed);
                count += (size_t)points;
            }
        }
    return count;
}

static lom_draw_desc quilt_of(const lom_shader *shader, const lom_tessellation *t, int points, uint64_t seed)
{
    lom_draw_desc draw = draw_of(shader, corners, make_quilt(points, seed));
    draw.topology = LOM_PATCHES;
    draw.patch_points = points;
    draw.tessellation = t;
    return draw;
}

static void patches_share_every_pixel(void)
{
    stage s = open_stage((lom_device_desc){ .tile = 32, .chunk = 64, .threads = 2 }, SIZE, SIZE, LOM_FORMAT_RGBA32F,
                         LOM_FORMAT_NONE);
    for (int i = 0; i < 24; i++) {
        int points = i % 2 ? 3 : 4;
        lom_tessellation t =
            tessellation_of(points == 4 ? LOM_DOMAIN_QUADS : LOM_DOMAIN_TRIANGLES, (lom_spacing)(i % 3));
        t.clockwise = i % 5 == 0;
        lom_draw_desc draw = quilt_of(&counter, &t, points, (uint64_t)i);
        draw.blend[0] = adding();
        begin(&s, (lom_pass_desc){ .samples = i % 4 == 3 ? 4 : 1 });
        lom_draw(s.device, &draw);
        finish(&s);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++)
                CHECK(floats_at(&s, x, y)[0] == (t.clockwise ? -1 : 1), "quilt %d: pixel %d,%d is hit %g times", i, x,
                      y, (double)floats_at(&s, x, y)[0]);
    }
    close_stage(&s);
}

/* ---- against feedback and plain draws ---- */

enum { MOST_CAPTURED = 1 << 19 };
static float captured[MOST_CAPTURED * 8];

static const lom_device_desc devices[] = { { .threads = 1 },
                                           { .threads = 3, .tile = 16, .chunk = 16, .batch = 2 },
                                           { .threads = 2, .tile = 32, .chunk = 4096, .batch = 1 } };

static lom_image *draw_quilt(const lom_device_desc *desc, lom_draw_desc draw, lom_feedback *feedback)
{
    stage s = open_stage(*desc, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    draw.feedback = feedback;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    finish(&s);
    lom_image *image = s.image;
    s.image = NULL;
    close_stage(&s);
    return image;
}

/* The first vertices of the buffer as attributes 0 and 1. */
static lom_draw_desc draw_captured(const lom_shader *shader, const lom_feedback *f, lom_topology topology)
{
    size_t stride = lom_feedback_stride(f);
    return (lom_draw_desc){ .shader = shader,
                            .attribute = { { f->data, f->size, stride, LOM_ATTRIBUTE_FLOAT4 },
                                           { f->data + 4, f->size - 16, stride, LOM_ATTRIBUTE_FLOAT4 } },
                            .count_from = f,
                            .topology = topology };
}

static void drawing_equals_drawing_what_was_fed_back(void)
{
    for (int i = 0; i < 12; i++) {
        const bool points = i % 4 == 3, lines = i % 4 == 2;
        int corners_of = i % 4 == 1 ? 3 : 4;
        lom_tessellation t = tessellation_of(lines             ? LOM_DOMAIN_ISOLINES
                                             : corners_of == 3 ? LOM_DOMAIN_TRIANGLES
                                                               : LOM_DOMAIN_QUADS,
                                             (lom_spacing)(i % 3));
        t.points = points;
        t.most = i < 6 ? 0 : 9;
        lom_feedback first = {
            .data = captured, .size = sizeof captured, .position = true, .varyings = LOM_VARYINGS(0, 4)
        };
        lom_draw_desc draw = quilt_of(&values, &t, corners_of, (uint64_t)i + 100);
        lom_image *image = draw_quilt(&devices[0], draw, &first);
        uint64_t hash = lom_hash_bytes(LOM_HASH_START, captured, first.written * lom_feedback_stride(&first));
        CHECK(first.written > 1000 && first.written == first.needed, "quilt %d: %zu of %zu", i, first.written,
              first.needed);
        for (size_t d = 0; d < 3; d++) {
            lom_feedback again = first;
            lom_image *same = draw_quilt(&devices[d], draw, &again), *alone = draw_quilt(&devices[d], draw, NULL);
            CHECK(same_images(image, same) && same_images(image, alone), "quilt %d differs on device %zu", i, d);
            CHECK(again.written == first.written &&
                      hash == lom_hash_bytes(LOM_HASH_START, captured, again.written * lom_feedback_stride(&again)),
                  "quilt %d is fed back otherwise on device %zu", i, d);
            lom_free_image(same);
            lom_free_image(alone);
        }
        if (!points) { /* their size is none of what is kept */
            lom_image *plain =
                draw_quilt(&devices[0], draw_captured(&values, &first, lines ? LOM_LINES : LOM_TRIANGLES), NULL);
            CHECK(same_images(image, plain), "quilt %d is not what was fed back", i);
            lom_free_image(plain);
        }
        lom_free_image(image);
    }
}

/* Each evaluated place against the scalar formula, from what was fed back: numbers of patches in order, levels. */
static void functions_get_their_patch(void)
{
    lom_tessellation t = tessellation_of(LOM_DOMAIN_QUADS, LOM_SPACING_EQUAL);
    lom_draw_desc draw = quilt_of(&values, &t, 4, 5);
    lom_feedback f = { .data = captured, .size = sizeof captured, .position = true, .varyings = LOM_VARYINGS(0, 4) };
    draw.count = 4 * (size_t)(PATCHES / 2) - 1; /* the last patch is not whole */
    lom_free_image(draw_quilt(&devices[1], draw, &f));
    float before = 0;
    for (size_t i = 0; i < f.written; i++) {
        const float *v = captured + 8 * i, u = v[4], w = v[5], number = v[6];
        const vertex *p = corners + 4 * (size_t)number;
        const float weight[4] = { (1 - u) * (1 - w), u * (1 - w), u * w, (1 - u) * w };
        CHECK(number >= before && number < PATCHES / 2 - 1 && v[7] == p[0].value[0] + p[1].value[0],
              "vertex %zu: patch %g", i, (double)number);
        for (int k = 0; k < 4; k++) {
            float sum = 0;
            for (int c = 0; c < 4; c++)
                sum += weight[c] * p[c].position[k];
            CHECK(sum == v[k], "vertex %zu: %a is not %a", i, (double)v[k], (double)sum);
        }
        before = number;
    }
    CHECK(before == PATCHES / 2 - 2, "the last patch is %g", (double)before);
}

/* ---- what is no number ---- */

static void bad_patches_leave_their_neighbours(void)
{
    lom_tessellation t = tessellation_of(LOM_DOMAIN_QUADS, LOM_SPACING_FRACTIONAL_ODD);
    const float bad[] = { 0, -1, __builtin_nanf(""), -__builtin_inff() };
    lom_feedback f = { .data = captured, .size = sizeof captured, .varyings = LOM_VARYINGS(2, 1) };
    for (size_t i = 0; i < 4; i++) {
        lom_draw_desc draw = quilt_of(&values, &t, 4, 9);
        lom_free_image(draw_quilt(&devices[0], draw, &f));
        size_t own = 0, all = f.written;
        for (size_t k = 0; k < all; k++)
            own += captured[k] == 7;
        corners[4 * 7].value[i] = bad[i];
        lom_free_image(draw_quilt(&devices[0], draw, &f));
        CHECK(own > 0 && f.written == all - own, "level %g: %zu of %zu vertices, %zu of them its own", (double)bad[i],
              f.written, all, own);
        for (size_t k = 0; k < f.written; k++)
            CHECK(captured[k] != 7, "vertex %zu is of the patch", k);
    }
    stage s = open_stage(devices[0], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    for (int i = 0; i < 3; i++) {
        lom_draw_desc draw = quilt_of(&counter, &t, 4, 9);
        draw.blend[0] = adding();
        corners[4 * 14].position[i] = i == 0 ? __builtin_nanf("") : i == 1 ? __builtin_inff() : 1e38f;
        begin(&s, (lom_pass_desc){ .samples = 1 });
        lom_draw(s.device, &draw);
        finish(&s);
        size_t missing = 0;
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                missing += floats_at(&s, x, y)[0] != 1;
            }
        CHECK(missing > 0 && missing < SIZE * SIZE / 12, "%zu pixels are missing", missing);
    }
    close_stage(&s);
}

/* Some patches at a time; where they move, every second time the first indices with a base vertex. */
static lom_image *draw_held_quilt(const lom_device_desc *desc, lom_draw_desc draw, bool they_move)
{
    static uint32_t indices[MOST_POINTS];
    const size_t all = draw.count, some = 5 * (size_t)draw.patch_points;
    stage s = open_stage(*desc, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    struct lom_held_draw held;
    for (size_t i = 0; i < all; i++)
        indices[i] = (uint32_t)i;
    draw.indices = indices;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    CHECK(lom_hold_draw(s.device, &draw, &held), "patches are not held");
    for (size_t first = 0; first < all; first += some) {
        const bool moves = they_move && first / some % 2 == 1;
        draw.first = moves ? 0 : first;
        draw.base_vertex = moves ? (int32_t)first : 0;
        draw.count = all - first < some ? all - first : some;
        lom_draw_held(s.device, &held, &draw);
    }
    finish(&s);
    lom_image *image = s.image;
    s.image = NULL;
    close_stage(&s);
    return image;
}

static void held_patches_are_those_of_one_draw(void)
{
    for (int i = 0; i < 12; i++) {
        const int points = i % 2 ? 3 : 4;
        lom_tessellation t =
            tessellation_of(points == 4 ? LOM_DOMAIN_QUADS : LOM_DOMAIN_TRIANGLES, (lom_spacing)(i % 3));
        const bool move = i % 4 >= 2;
        if (move)
            memcpy(t.evaluation, by_moved_points.evaluation, sizeof t.evaluation);
        const lom_draw_desc draw = quilt_of(&values, &t, points, (uint64_t)i);
        lom_image *whole = draw_quilt(&devices[i / 4], draw, NULL);
        lom_image *parts = draw_held_quilt(&devices[i / 4], draw, move);
        CHECK(same_images(whole, parts), "quilt %d differs", i);
        lom_free_image(whole);
        lom_free_image(parts);
    }
}

static void expect(lom_draw_desc draw, const char *words)
{
    stage s = open_stage(devices[0], 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    const char *text = lom_device_error(s.device)->text;
    CHECK(!lom_end_pass(s.device) && strstr(text, words) != NULL && text[strlen(text) - 1] == '.', "\"%s\", not \"%s\"",
          text, words);
    close_stage(&s);
}

static void what_makes_no_patches_is_refused(void)
{
    lom_tessellation t = by_points;
    const lom_draw_desc good = quilt_of(&values, &t, 4, 1);
    lom_draw_desc draw = good;
    draw.tessellation = NULL;
    expect(draw, "patches, but no tessellation");
    draw = good;
    draw.topology = LOM_TRIANGLES;
    expect(draw, "a tessellation, but no patches");
    for (int i = 0; i < 3; i++) {
        draw = good;
        draw.patch_points = (int[]){ 0, 33, -1 }[i];
        expect(draw, "1 to 32 vertices");
    }
    t.most = 65;
    expect(good, "but 64 is the most");
    t.most = -1;
    expect(good, "but 64 is the most");
    t.most = 0;
    t.domain = (lom_domain)3;
    expect(good, "domain or a spacing that is none");
    t = by_points;
    t.spacing = (lom_spacing)-1;
    expect(good, "domain or a spacing that is none");
    t = by_points;
    memset(t.evaluation, 0, sizeof t.evaluation);
    expect(good, "was built for no width");
}

int main(int argc, char **argv)
{
    RUN(patches_share_every_pixel);
    RUN(drawing_equals_drawing_what_was_fed_back);
    RUN(functions_get_their_patch);
    RUN(bad_patches_leave_their_neighbours);
    RUN(held_patches_are_those_of_one_draw);
    RUN(what_makes_no_patches_is_refused);
    return check_failed_tests != 0;
}
