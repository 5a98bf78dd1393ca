/* Proves of lines: each pixel is hit as often as the diamond-exit rule says, evaluated for one pixel after the other with
 * ends that are moved by a symbolic e: random lines, and such whose ends lie on corners, edges and
 * centres of diamonds, in all octants, of every width, cut by tiles, scissor and the picture; strips are their lines, with
 * restarts, and have the pixel of each joint once; a picture moves with its lines by whole pixels; depth and varyings lie
 * within the stated bound of the exact line, flat ones are the last vertex'; clip distances, near and far cut where they
 * say; the depth test, several samples, crops, what is refused. */
#include "stage.h"

#include <stdlib.h>

enum { SIZE = 64, LINES = 24, LISTS = 25 };

/* Attributes 1: values; 3: distances. */
static void place_cut(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->distance[0] = in->attribute[3].x;
}

static void show_all(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0], in->varying[1], in->w, lom_dx(in, 0) };
}

LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(cut, place_cut, show_values, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1,
           .clip_distances = 1)
LOM_SHADER(whole, place_values, show_all, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 2),
           .differentiates = LOM_VARYINGS(0, 1), .flat = LOM_VARYINGS(1, 1), .reads_position = true, .colors = 1)

static void show_some(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_all(out, in, uniforms);
    out->discard = in->varying[0] > 0.0f;
}

LOM_SHADER(holed, place_values, show_some, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 2),
           .differentiates = LOM_VARYINGS(0, 1), .flat = LOM_VARYINGS(1, 1), .reads_position = true, .colors = 1,
           .discards = true)

/* ---- the rule ---- */

/* c[0] + c[1] e + c[2] e^2 for an e smaller than all that is compared. */
typedef struct number {
    int64_t c[3];
} number;

static int sign_of(number a)
{
    for (int i = 0; i < 3; i++)
        if (a.c[i] != 0)
            return a.c[i] < 0 ? -1 : 1;
    return 0;
}

/* Of a / m - b / n; m, n > 0. */
static int compare_fractions(number a, int64_t m, number b, int64_t n)
{
    number d;
    for (int i = 0; i < 3; i++)
        d.c[i] = a.c[i] * n - b.c[i] * m;
    return sign_of(d);
}

/* At p moved by (-e, -e^2): one of the four functions +-x +-y - 128 that are below 0 inside the diamond about c. */
static number side_of(snapped p, snapped c, int k)
{
    int64_t sx = k & 1 ? 1 : -1, sy = k & 2 ? 1 : -1;
    return (number){ { sx * (p.x - c.x) + sy * (p.y - c.y) - 128, -sx, -sy } };
}

static bool lies_in(snapped p, snapped c)
{
    bool in = true;
    for (int k = 0; k < 4; k++)
        in &= sign_of(side_of(p, c, k)) < 0;
    return in;
}

/* Whether there is a t in 0..1 for which a + t (b - a) lies inside. */
static bool meets(snapped a, snapped b, snapped c)
{
    number low = { { -1 } }, high = { { 2 } }; /* low / l < t < high / h */
    int64_t l = 1, h = 1;
    for (int k = 0; k < 4; k++) {
        number at = side_of(a, c, k), minus = { { -at.c[0], -at.c[1], -at.c[2] } };
        int64_t slope = side_of(b, c, k).c[0] - at.c[0];
        if (slope == 0 && sign_of(at) >= 0)
            return false;
        if (slope > 0 && compare_fractions(minus, slope, high, h) < 0) {
            high = minus;
            h = slope;
        }
        if (slope < 0 && compare_fractions(at, -slope, low, l) > 0) {
            low = at;
            l = -slope;
        }
    }
    return compare_fractions(low, l, high, h) < 0 && compare_fractions(low, l, (number){ { 1 } }, 1) < 0 &&
           sign_of(high) > 0;
}

static bool is_steep(snapped a, snapped b)
{
    return llabs(b.y - a.y) > llabs(b.x - a.x);
}

/* Whether a line of that width covers pixel (x, y): one of the pixels before it in the minor direction is the moved line's. */
static bool covers_pixel(snapped a, snapped b, int width, int x, int y)
{
    bool steep = is_steep(a, b);
    int64_t moved = 128 * (width - 1);
    *(steep ? &a.x : &a.y) -= moved;
    *(steep ? &b.x : &b.y) -= moved;
    for (int k = 0; k < width; k++) {
        snapped c = { 256 * (int64_t)(x - (steep ? k : 0)) + 128, 256 * (int64_t)(y - (steep ? 0 : k)) + 128 };
        if (meets(a, b, c) && !lies_in(b, c))
            return true;
    }
    return false;
}

/* ---- the pipeline against it ---- */

typedef struct line {
    snapped a, b;
} line;

static vertex ends[2 * LINES];
static line lines[LINES];

static snapped random_end(int64_t step)
{
    return (snapped){ random_whole(-12 * 256, 76 * 256) / step * step,
                      random_whole(-12 * 256, 76 * 256) / step * step };
}

/* step: what coordinates are multiples of; 128: corners and centres. */
static void make_lines(int64_t step)
{
    for (int i = 0; i < LINES; i++) {
        snapped a = random_end(step), b = random_end(step);
        switch (random_whole(0, 5)) {
        case 0: /* short */
            b = (snapped){ a.x + random_whole(-4, 4) * step, a.y + random_whole(-4, 4) * step };
            break;
        case 1: /* diagonal */
            b.y = a.y + (random_whole(0, 1) == 0 ? b.x - a.x : a.x - b.x);
            break;
        case 2: /* along an axis */
            *(random_whole(0, 1) == 0 ? &b.x : &b.y) = 0;
            b = b.x == 0 ? (snapped){ a.x, b.y } : (snapped){ b.x, a.y };
            break;
        }
        lines[i] = (line){ a, b };
        for (int k = 0; k < 2; k++) {
            ends[2 * i + k] = (vertex){ .value = { 1, (float)(i + 1), 0, 0 } };
            place_at(&ends[2 * i + k], k == 0 ? a.x : b.x, k == 0 ? a.y : b.y, SIZE);
        }
    }
}

static void compare(const stage *s, const line *l, int count, int width, const lom_rect *scissor)
{
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            float hits = 0, sum = 0;
            bool inside = x >= scissor->x && x < scissor->x + scissor->width && y >= scissor->y &&
                          y < scissor->y + scissor->height;
            for (int i = 0; i < count && inside; i++)
                if (covers_pixel(l[i].a, l[i].b, width, x, y)) {
                    hits++;
                    sum += (float)(i + 1);
                }
            const float *is = floats_at(s, x, y);
            CHECK(is[0] == hits && is[1] == sum, "width %d, pixel %d, %d: %g lines, sum %g; not %g, sum %g", width, x,
                  y, (double)is[0], (double)is[1], (double)hits, (double)sum);
        }
}

static void draw_added(stage *s, lom_draw_desc draw, lom_topology topology, int width, lom_pass_desc pass)
{
    draw.topology = topology;
    draw.line_width = width;
    draw.blend[0] = adding();
    begin(s, pass);
    lom_draw(s->device, &draw);
    finish(s);
}

static const lom_device_desc devices[] = { { .threads = 1 },
                                           { .threads = 3, .tile = 16, .chunk = 16, .batch = 2 },
                                           { .threads = 2, .tile = 32 } };

static void a_pixel_is_hit_by_the_rule(void)
{
    static const int64_t steps[] = { 1, 128, 64, 32, 256 };
    for (int d = 0; d < 3; d++) {
        stage s = open_stage(devices[d], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
        for (int list = 0; list < LISTS; list++) {
            int width = list % 2 == 0 ? 1 : (int)random_whole(2, 9);
            lom_rect scissor = { 0, 0, SIZE, SIZE };
            if (list % 4 == 3)
                scissor = (lom_rect){ (int)random_whole(0, 40), (int)random_whole(0, 40), 19, 22 };
            make_lines(steps[list % 5]);
            lom_draw_desc draw = draw_of(&values, ends, 2 * LINES);
            draw.scissor = scissor;
            draw_added(&s, draw, LOM_LINES, width, (lom_pass_desc){ .samples = list % 5 == 4 ? 4 : 1 });
            compare(&s, lines, LINES, width, &scissor);
        }
        close_stage(&s);
    }
}

/* Strips of 12 vertices, with a restart index between some; joints lie on ties, too. */
static void strips_are_their_lines(void)
{
    for (int d = 0; d < 3; d++) {
        stage s = open_stage(devices[d], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
        for (int list = 0; list < LISTS; list++) {
            enum { COUNT = 40 };
            uint32_t indices[COUNT];
            static line joined[COUNT];
            int count = 0;
            make_lines(list % 2 == 0 ? 128 : 1);
            for (int i = 0; i < 2 * LINES; i++)
                ends[i].value[1] = 0;
            for (int i = 0; i < COUNT; i++)
                indices[i] = random_whole(0, 6) == 0 ? UINT32_MAX : (uint32_t)random_whole(0, 2 * LINES - 1);
            for (int i = 0; i + 1 < COUNT; i++)
                if (indices[i] != UINT32_MAX && indices[i + 1] != UINT32_MAX) {
                    uint32_t p = indices[i], q = indices[i + 1];
                    joined[count++] = (line){ p % 2 == 0 ? lines[p / 2].a : lines[p / 2].b,
                                              q % 2 == 0 ? lines[q / 2].a : lines[q / 2].b };
                }
            lom_draw_desc draw = draw_of(&values, ends, 2 * LINES);
            draw.count = COUNT;
            draw.indices = indices;
            draw.restart = true;
            draw_added(&s, draw, LOM_LINE_STRIP, 1, (lom_pass_desc){ .samples = 1 });
            for (int y = 0; y < SIZE; y++)
                for (int x = 0; x < SIZE; x++) {
                    float hits = 0;
                    for (int i = 0; i < count; i++)
                        hits += covers_pixel(joined[i].a, joined[i].b, 1, x, y) ? 1 : 0;
                    CHECK(floats_at(&s, x, y)[0] == hits, "strip %d, pixel %d, %d: %g, not %g", list, x, y,
                          (double)floats_at(&s, x, y)[0], (double)hits);
                }
        }
        close_stage(&s);
    }
}

/* A path that goes on to the right, and one that closes a convex ring: no pixel twice, columns of the first without a gap. */
static void no_joint_is_hit_twice(void)
{
    enum { COUNT = 9 };
    stage s = open_stage(devices[0], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    for (int list = 0; list < 60; list++) {
        vertex path[COUNT];
        int64_t step = list % 3 == 0   ? 128
                       : list % 3 == 1 ? 64
                                       : 1,
                x = random_whole(1, 8) * step, y = 32 * 256, from = x;
        for (int i = 0; i < COUNT; i++) {
            path[i] = (vertex){ .value = { 1 } };
            place_at(&path[i], x, y, SIZE);
            if (i + 1 == COUNT)
                break;
            int64_t run = random_whole(1, 1500 / step) * step;
            x += run;
            y += random_whole(-run / step, run / step) * step;
            y = y < 512 ? 512 : y > 62 * 256 ? 62 * 256 : y;
        }
        draw_added(&s, draw_of(&values, path, COUNT), LOM_LINE_STRIP, 1, (lom_pass_desc){ .samples = 1 });
        for (int column = 0; column < SIZE; column++) {
            float hits = 0;
            for (int row = 0; row < SIZE; row++) {
                CHECK(floats_at(&s, column, row)[0] <= 1, "path %d: pixel %d, %d has %g", list, column, row,
                      (double)floats_at(&s, column, row)[0]);
                hits += floats_at(&s, column, row)[0];
            }
            CHECK(column * 256 < from || column * 256 + 256 >= x || hits >= 1, "path %d: nothing in column %d", list,
                  column);
        }
    }
    close_stage(&s);
}

/* By whole pixels, in either direction, one list and the moved one. */
static void pictures_move_with_their_lines(void)
{
    stage s = open_stage(devices[1], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE),
          t = open_stage(devices[0], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    for (int list = 0; list < LISTS; list++) {
        int dx = (int)random_whole(-20, 20), dy = (int)random_whole(-20, 20), width = (int)random_whole(1, 4);
        make_lines(list % 2 == 0 ? 64 : 1);
        draw_added(&s, draw_of(&values, ends, 2 * LINES), LOM_LINES, width, (lom_pass_desc){ .samples = 1 });
        for (int i = 0; i < 2 * LINES; i++) {
            const snapped *p = i % 2 == 0 ? &lines[i / 2].a : &lines[i / 2].b;
            place_at(&ends[i], p->x + 256 * dx, p->y + 256 * dy, SIZE);
        }
        draw_added(&t, draw_of(&values, ends, 2 * LINES), LOM_LINES, width, (lom_pass_desc){ .samples = 1 });
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++)
                if (x + dx >= 0 && x + dx < SIZE && y + dy >= 0 && y + dy < SIZE)
                    CHECK(memcmp(floats_at(&s, x, y), floats_at(&t, x + dx, y + dy), 16) == 0, "list %d, %d, %d", list,
                          x, y);
    }
    close_stage(&s);
    close_stage(&t);
}

/* ---- depth and varyings ---- */

static double clamped(double t)
{
    return t < 0 ? 0 : t > 1 ? 1 : t;
}

static bool is_close(double a, double b, double size)
{
    return a - b <= size * 1e-6 && b - a <= size * 1e-6;
}

static void varyings_lie_on_the_line(void)
{
    static const float powers[] = { 0.5f, 1, 2, 4 };
    stage s = open_stage(devices[1], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    for (int list = 0; list < 200; list++) {
        int width = list % 3 == 0 ? 3 : 1;
        make_lines(1);
        line l = lines[0];
        float w[2] = { powers[random_whole(0, 3)], powers[random_whole(0, 3)] }, z[2], f[2];
        for (int k = 0; k < 2; k++) {
            z[k] = random_float(0.1f, 0.9f);
            f[k] = ends[k].value[0] = random_float(-3, 3);
            ends[k].value[1] = (float)(k + 5);
            ends[k].position[2] = z[k];
            for (int i = 0; i < 4; i++)
                ends[k].position[i] *= w[k];
        }
        lom_draw_desc draw = draw_of(&whole, ends, 2);
        draw.topology = LOM_LINES;
        draw.line_width = width;
        begin(&s, (lom_pass_desc){ .clear_color = { { -9 } } });
        lom_draw(s.device, &draw);
        finish(&s);
        double x = (double)(l.b.x - l.a.x), y = (double)(l.b.y - l.a.y), area = x * x + y * y;
        for (int py = 0; py < SIZE; py++)
            for (int px = 0; px < SIZE; px++) {
                const float *is = floats_at(&s, px, py);
                double t = ((256.0 * px + 128 - (double)l.a.x) * x + (256.0 * py + 128 - (double)l.a.y) * y) / area;
                float depth = *(const float *)lom_image_pixel(s.depths, px, py, 0);
                if (!covers_pixel(l.a, l.b, width, px, py))
                    continue;
                double a = (1 - clamped(t)) / (double)w[0], b = clamped(t) / (double)w[1], c = b / (a + b);
                double slope = 256 * x / area, over = 1 / (double)w[1], under = 1 / (double)w[0];
                double df = ((double)f[1] - (double)f[0]) * slope * over * under / ((a + b) * (a + b));
                CHECK(is_close((double)depth, (double)z[0] + clamped(t) * ((double)z[1] - (double)z[0]), 1) &&
                          is_close((double)is[0], (double)f[0] + c * ((double)f[1] - (double)f[0]), 6) && is[1] == 6 &&
                          is_close((double)is[2], 1 / (a + b), 4) &&
                          (t <= 0 || t >= 1 || is_close((double)is[3], df, 40 * (slope < 0 ? -slope : slope) + 1e-4)),
                      "line %d, pixel %d, %d, t %.9g: %.9g, %g, w %.9g, slope %.9g, depth %.9g", list, px, py, t,
                      (double)is[0], (double)is[1], (double)is[2], (double)is[3], (double)depth);
            }
    }
    close_stage(&s);
}

/* ---- clipping ---- */

static void clip_distances_cut_at_pixels(void)
{
    stage s = open_stage(devices[2], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE),
          t = open_stage(devices[2], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE),
          both = open_stage(devices[2], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    int seen = 0;
    for (int list = 0; list < LISTS; list++) {
        make_lines(1);
        vertex other[2 * LINES];
        for (int i = 0; i < 2 * LINES; i++) {
            ends[i].distance[0] = random_float(-1, 1);
            other[i] = ends[i];
            other[i].distance[0] = -ends[i].distance[0];
        }
        draw_added(&s, draw_of(&cut, ends, 2 * LINES), LOM_LINES, 2, (lom_pass_desc){ .samples = 1 });
        draw_added(&t, draw_of(&cut, other, 2 * LINES), LOM_LINES, 2, (lom_pass_desc){ .samples = 1 });
        draw_added(&both, draw_of(&values, ends, 2 * LINES), LOM_LINES, 2, (lom_pass_desc){ .samples = 1 });
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                float sum = 0;
                for (int i = 0; i < LINES; i++) {
                    line l = lines[i];
                    double dx = (double)(l.b.x - l.a.x), dy = (double)(l.b.y - l.a.y);
                    double c =
                        clamped(((256.0 * x + 128 - (double)l.a.x) * dx + (256.0 * y + 128 - (double)l.a.y) * dy) /
                                (dx * dx + dy * dy));
                    double d = (double)ends[2 * i].distance[0] * (1 - c) + (double)ends[2 * i + 1].distance[0] * c;
                    sum += covers_pixel(l.a, l.b, 2, x, y) && d > 0 ? 1 : 0;
                }
                seen += sum != 0;
                CHECK(floats_at(&s, x, y)[0] == sum, "pixel %d, %d: %g, not %g", x, y, (double)floats_at(&s, x, y)[0],
                      (double)sum);
                CHECK(floats_at(&s, x, y)[0] + floats_at(&t, x, y)[0] == floats_at(&both, x, y)[0], "halves, %d, %d", x,
                      y);
            }
    }
    CHECK(seen > 1000, "%d pixels", seen);
    close_stage(&s);
    close_stage(&t);
    close_stage(&both);
}

/* A part of a line lies behind far, before near, behind the eye, or outside the guard band; where it is cut is exact. */
static void planes_cut_lines(void)
{
    static const struct {
        float outer[4], share; /* of the line, that lies inside */
    } cases[] = { { { 0.5f, 0.25f, -0.5f, 1 }, 0.5f },
                  { { 0.5f, 0.25f, 1.5f, 1 }, 0.5f },
                  { { 1.5f, 0.25f, 0.5f, -1 }, 0.25f },
                  { { 2048, -0.25f, 0.5f, 1 }, 0.5f } };
    for (int i = 0; i < 8; i++) {
        vertex v[2] = { { .position = { -0.5f, -0.25f, 0.5f, 1 }, .value = { 1, 7, 0, 0 } },
                        { .value = { 3, 9, 0, 0 } } };
        memcpy(v[1].position, cases[i / 2].outer, sizeof v[1].position);
        vertex inner[2] = { v[0], v[1] };
        float share = cases[i / 2].share;
        for (int k = 0; k < 4; k++) {
            inner[1].position[k] = v[0].position[k] + share * (v[1].position[k] - v[0].position[k]);
            inner[1].value[k] = k == 1 ? 9 : v[0].value[k] + share * (v[1].value[k] - v[0].value[k]);
        }
        if (i % 2 == 1) { /* from outside in; the flat value stays the last vertex' */
            vertex swap = v[0];
            v[0] = v[1];
            v[1] = swap;
            swap = inner[0];
            inner[0] = inner[1];
            inner[1] = swap;
        }
        stage s = open_stage(devices[0], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE),
              t = open_stage(devices[0], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
        draw_added(&s, draw_of(&whole, v, 2), LOM_LINES, 1, (lom_pass_desc){ .samples = 1 });
        draw_added(&t, draw_of(&whole, inner, 2), LOM_LINES, 1, (lom_pass_desc){ .samples = 1 });
        CHECK(same_images(s.image, t.image), "plane %d", i);
        CHECK(lom_device_counters(s.device).triangles_clipped == 1 && lom_device_counters(t.device).fragments > 4,
              "plane %d: %llu fragments", i, (unsigned long long)lom_device_counters(t.device).fragments);
        close_stage(&s);
        close_stage(&t);
    }
}

/* ---- passes ---- */

/* What is seen through is what lies in front; a crop is a part of the whole; depth 16 and late tests, too. */
static void crops_are_parts_of_the_whole(void)
{
    enum { WIDE = 2 * SIZE };
    stage s = open_stage(devices[1], WIDE, WIDE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F),
          t = open_stage(devices[0], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    for (int list = 0; list < LISTS; list++) {
        lom_pass_desc crop = { .frame_width = WIDE, .frame_height = WIDE, .origin_x = 37, .origin_y = 21 };
        make_lines(1);
        for (int i = 0; i < 2 * LINES; i++)
            ends[i].position[2] = random_float(0, 1);
        lom_draw_desc draw = draw_of(&whole, ends, 2 * LINES);
        draw.topology = LOM_LINE_STRIP;
        draw.line_width = 1 + list % 3;
        begin(&s, (lom_pass_desc){ .samples = 1 });
        lom_draw(s.device, &draw);
        finish(&s);
        begin(&t, crop);
        lom_draw(t.device, &draw);
        finish(&t);
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++)
                CHECK(memcmp(floats_at(&t, x, y), floats_at(&s, x + 37, y + 21), 16) == 0 &&
                          memcmp(lom_image_pixel(t.depths, x, y, 0), lom_image_pixel(s.depths, x + 37, y + 21, 0), 4) ==
                              0,
                      "list %d, pixel %d, %d", list, x, y);
    }
    close_stage(&s);
    close_stage(&t);
}

/* Before or after the shader, in depth, however often it is asked for. */
static void all_samples_have_what_the_centre_has(void)
{
    static const int samples[] = { 1, 2, 4, 8, 16 };
    stage s[5];
    for (int i = 0; i < 5; i++)
        s[i] = open_stage(devices[i % 3], SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    for (int list = 0; list < LISTS; list++) {
        make_lines(1);
        for (int i = 0; i < 2 * LINES; i++) {
            ends[i].position[2] = random_float(0, 1);
            ends[i].value[0] = random_float(-1, 1);
        }
        lom_draw_desc draw = draw_of(list % 2 == 0 ? &whole : &holed, ends, 2 * LINES);
        draw.topology = LOM_LINE_STRIP;
        draw.line_width = 1 + list % 4;
        draw.per_sample = list % 3 == 0;
        for (int i = 0; i < 5; i++) {
            begin(&s[i], (lom_pass_desc){ .samples = samples[i] });
            lom_draw(s[i].device, &draw);
            finish(&s[i]);
            CHECK(same_images(s[i].image, s[0].image) && same_images(s[i].depths, s[0].depths), "list %d, %d samples",
                  list, samples[i]);
        }
    }
    for (int i = 0; i < 5; i++)
        close_stage(&s[i]);
}

static void refused(const char *because, int width, float bias)
{
    static const vertex v[2] = { { .position = { 0, 0, 0.5f, 1 } } };
    stage s = open_stage(devices[0], 8, 8, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    lom_draw_desc draw = draw_of(&values, v, 2);
    draw.topology = LOM_LINES;
    draw.line_width = width;
    draw.depth_bias = bias;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    CHECK(!lom_end_pass(s.device) && strstr(lom_device_error(s.device)->text, because) != NULL, "\"%s\" instead of: %s",
          lom_device_error(s.device)->text, because);
    close_stage(&s);
}

static void what_lines_have_not_is_refused(void)
{
    refused("1 to 64 pixels wide, not 65", 65, 0);
    refused("1 to 64 pixels wide, not -1", -1, 0);
    refused("A draw of lines has a depth bias", 1, 1);
}

int main(int argc, char **argv)
{
    RUN(a_pixel_is_hit_by_the_rule);
    RUN(strips_are_their_lines);
    RUN(no_joint_is_hit_twice);
    RUN(pictures_move_with_their_lines);
    RUN(varyings_lie_on_the_line);
    RUN(clip_distances_cut_at_pixels);
    RUN(planes_cut_lines);
    RUN(crops_are_parts_of_the_whole);
    RUN(all_samples_have_what_the_centre_has);
    RUN(what_lines_have_not_is_refused);
    return check_result();
}
