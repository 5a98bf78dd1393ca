/* Proves of primitives at this width: whose vertex' flat varyings they have, by a table written from the specification,
 * in every topology, cut or not; varyings that are linear in the window, against the affine function through the snapped
 * corners, also along cuts and behind the eye; depth clamp, against the clamped plane, its coverage that of no planes;
 * attributes of instances, against a draw for each instance. */
#include "stage.h"

enum { SIZE = 64, UNITS = SIZE * 256 };

LOM_SHADER(flats, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .flat = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
/* 0 and 3 linear in the window, 1 flat whatever else it is said to be, 2 in space */
LOM_SHADER(linears, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .flat = LOM_VARYINGS(1, 1), .screen_linear = LOM_VARYINGS(0, 2) | LOM_VARYINGS(3, 1), .colors = 1)

static stage open_floats(int chunk, lom_format depth)
{
    return open_stage((lom_device_desc){ .threads = 1, .chunk = chunk }, SIZE, SIZE, LOM_FORMAT_RGBA32F, depth);
}

/* ---- the provoking vertex ---- */

/* OpenGL 4.6, table 13.2, and Vulkan 1.3, 27.5: of primitive i (from 0) the places of its vertices, which are its first
 * times `step`, and of the provoking ones. A fan's centre is place 0. */
static const struct row {
    lom_topology topology;
    int vertices, step;
    int first, last; /* place of primitive 0's provoking vertex; i steps on for primitive i */
} rows[] = {
    { LOM_POINTS, 1, 1, 0, 0 },    { LOM_LINES, 2, 2, 0, 1 },          { LOM_LINE_STRIP, 2, 1, 0, 1 },
    { LOM_TRIANGLES, 3, 3, 0, 2 }, { LOM_TRIANGLE_STRIP, 3, 1, 0, 2 }, { LOM_TRIANGLE_FAN, 3, 1, 1, 2 },
};

enum { PLACES = 12 };

/* Twelve places such that primitives of every topology have their centres to themselves: a zigzag, for a fan an arc. */
static void put_places(vertex v[PLACES], lom_topology topology, bool cut)
{
    static const int arc[PLACES][2] = { { 4, 60 },  { 60, 58 }, { 60, 48 }, { 59, 40 }, { 57, 32 }, { 53, 25 },
                                        { 48, 18 }, { 42, 12 }, { 35, 8 },  { 27, 5 },  { 18, 3 },  { 8, 2 } };
    for (int k = 0; k < PLACES; k++) {
        int x = topology == LOM_TRIANGLE_FAN ? arc[k][0] : 2 + 5 * k;
        int y = topology == LOM_TRIANGLE_FAN ? arc[k][1] : k % 2 == 0 ? 10 : 50;
        const int middle = topology == LOM_POINTS ? 128 : 0; /* of the pixel; a line's middle lies between two */
        place_at(&v[k], 256 * x + middle, 256 * y + middle, SIZE);
        v[k].position[2] = cut && k % 3 == 1 ? -0.05f : 0.5f; /* so far beyond the far plane that the centre stays */
        for (int c = 0; c < 4; c++)
            v[k].value[c] = (float)(1 + k);
    }
}

/* The pixel at the middle of primitive i. */
static int centre_of(const vertex v[PLACES], const struct row *row, int i)
{
    double x = 0, y = 0;
    for (int k = 0; k < row->vertices; k++) {
        const vertex *p = &v[row->topology == LOM_TRIANGLE_FAN && k == 0 ? 0 : i * row->step + k];
        x += (p->position[0] + 1) * SIZE / 2 / row->vertices;
        y += (1 - p->position[1]) * SIZE / 2 / row->vertices;
    }
    return (int)y * SIZE + (int)x;
}

static void flat_values_are_the_provoking_vertex_s(void)
{
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        for (int round = 0; round < 8; round++) {
            const struct row *row = &rows[r];
            const bool cut = (round & 1) != 0 && row->topology != LOM_POINTS, first = (round & 2) != 0;
            vertex v[PLACES];
            stage s = open_floats(round & 4 ? 16 : 0, LOM_FORMAT_NONE);
            put_places(v, row->topology, cut);
            lom_draw_desc desc = draw_of(&flats, v, PLACES);
            desc.topology = row->topology;
            desc.provoking = first ? LOM_PROVOKING_FIRST : LOM_PROVOKING_LAST;
            begin(&s, (lom_pass_desc){ .clear_depth = 0 });
            lom_draw(s.device, &desc);
            finish(&s);
            const int count = (PLACES - row->vertices) / row->step + 1;
            for (int i = 0; i < count; i++) {
                int p = centre_of(v, row, i);
                float expected = (float)(1 + (first ? row->first : row->last) + i * row->step);
                for (int c = 0; c < 4; c++)
                    CHECK(floats_at(&s, p % SIZE, p / SIZE)[c] == expected,
                          "topology %d, round %d, primitive %d: %g, not %g", (int)row->topology, round, i,
                          (double)floats_at(&s, p % SIZE, p / SIZE)[c], (double)expected);
            }
            close_stage(&s);
        }
}

/* Which vertex provokes changes no pixel's coverage, nor what is culled; with restarts each strip counts for itself. */
static void facing_does_not_depend_on_it(void)
{
    int drawn = 0;
    static const uint16_t indices[] = { 0, 1, 2, 3, 4, UINT16_MAX, 5, 6, 7, 8, UINT16_MAX, 9, 10, 11 };
    for (int round = 0; round < 2 * 3 * 3; round++) {
        static const lom_topology topologies[] = { LOM_TRIANGLES, LOM_TRIANGLE_STRIP, LOM_TRIANGLE_FAN };
        vertex v[PLACES];
        bool covered[2][SIZE * SIZE];
        int pixels = 0;
        lom_topology topology = topologies[round % 3];
        put_places(v, topology, round >= 9);
        for (int first = 0; first < 2; first++) {
            stage s = open_floats(16, LOM_FORMAT_NONE);
            lom_draw_desc desc = draw_of(&flats, v, sizeof indices / sizeof *indices);
            desc.topology = topology;
            desc.provoking = first ? LOM_PROVOKING_FIRST : LOM_PROVOKING_LAST;
            desc.cull = (lom_cull)(round / 3 % 3);
            desc.indices = indices;
            desc.index_bits = 16;
            desc.restart = true;
            begin(&s, (lom_pass_desc){ .clear_depth = 0 });
            lom_draw(s.device, &desc);
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++)
                covered[first][p] = floats_at(&s, p % SIZE, p / SIZE)[0] != 0;
            for (int p = 0; p < SIZE * SIZE; p++)
                pixels += covered[first][p];
            close_stage(&s);
        }
        CHECK(memcmp(covered[0], covered[1], sizeof covered[0]) == 0, "round %d", round);
        drawn += pixels;
    }
    CHECK(drawn > 2000, "%d pixels", drawn);
}

/* ---- linear in the window ---- */

static double edge(const double a[2], const double b[2], const double p[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

/* Within the guard band and near and far: the exact weights of the snapped triangle, bound as in numerics.md. */
static void whole_triangles_are_affine(void)
{
    stage s = open_floats(0, LOM_FORMAT_NONE);
    int pixels = 0;
    for (int round = 0; round < 400; round++) {
        vertex v[3];
        double at[3][2], most = 0;
        int64_t x = random_whole(0, UNITS), y = random_whole(0, UNITS), reach = round % 2 == 0 ? 4 * 256 : UNITS;
        for (int k = 0; k < 3; k++) {
            const int64_t px = x + random_whole(-reach, reach), py = y + random_whole(-reach, reach);
            place_at(&v[k], px, py, SIZE);
            at[k][0] = (double)px;
            at[k][1] = (double)py;
            const float w = (float)(1 << random_whole(0, 12)); /* exact, so that it snaps back */
            for (int i = 0; i < 4; i++)
                v[k].position[i] *= w;
            for (int i = 0; i < 4; i++)
                v[k].value[i] = random_float(-10, 10);
            most = most > __builtin_fabs((double)v[k].value[0]) ? most : __builtin_fabs((double)v[k].value[0]);
        }
        lom_draw_desc desc = draw_of(&linears, v, 3);
        begin(&s, (lom_pass_desc){ .clear_color = { { -99, -99, -99, -99 } } });
        lom_draw(s.device, &desc);
        finish(&s);
        const double area = edge(at[0], at[1], at[2]);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const float *value = floats_at(&s, p % SIZE, p / SIZE);
            const double here[2] = { 256 * (p % SIZE) + 128, 256 * (p / SIZE) + 128 };
            if (value[0] == -99)
                continue;
            double exact = (edge(at[1], at[2], here) * v[0].value[0] + edge(at[2], at[0], here) * v[1].value[0] +
                            edge(at[0], at[1], here) * v[2].value[0]) /
                           area;
            pixels++;
            CHECK(__builtin_fabs((double)value[0] - exact) <= 8 * 0x1p-24 * most, "round %d, pixel %d: %.9g, not %.9g",
                  round, p, (double)value[0], exact);
            CHECK(value[1] == v[2].value[1], "round %d, pixel %d: flat counts before", round, p);
        }
    }
    CHECK(pixels > 10000, "%d pixels", pixels);
    close_stage(&s);
}

/* f w = A x + B y + C w through three clip positions, whatever the signs of w: (A, B, C). */
static void find_plane(const vertex v[3], double plane[3])
{
    double m[3][3], f[3];
    for (int k = 0; k < 3; k++) {
        m[k][0] = v[k].position[0];
        m[k][1] = v[k].position[1];
        m[k][2] = v[k].position[3];
        f[k] = (double)v[k].value[0] * v[k].position[3];
    }
    double d = 0;
    for (int k = 0; k < 3; k++)
        d += m[0][k] * (m[1][(k + 1) % 3] * m[2][(k + 2) % 3] - m[1][(k + 2) % 3] * m[2][(k + 1) % 3]);
    for (int c = 0; c < 3; c++) {
        double n[3][3];
        memcpy(n, m, sizeof n);
        for (int k = 0; k < 3; k++)
            n[k][c] = f[k];
        plane[c] = 0;
        for (int k = 0; k < 3; k++)
            plane[c] += n[0][k] * (n[1][(k + 1) % 3] * n[2][(k + 2) % 3] - n[1][(k + 2) % 3] * n[2][(k + 1) % 3]) / d;
    }
}

/* Cut by near, far, the guard band, w = 0: what is left keeps the function of the whole plane. Snapping moves a corner by
 * half a unit, so values by as much of their slope as the corners' own moves can turn it: within two units' worth. */
static void cuts_change_no_value(void)
{
    stage s = open_floats(0, LOM_FORMAT_NONE);
    int pixels = 0, cut = 0;
    for (int round = 0; round < 600; round++) {
        vertex v[3];
        double plane[3];
        for (int k = 0; k < 3; k++) {
            const float w = round % 3 == 0 && k == round / 3 % 3 ? random_float(-2, -0.1f) : random_float(0.5f, 3);
            v[k].position[0] = random_float(-3, 3);
            v[k].position[1] = random_float(-3, 3);
            v[k].position[2] = random_float(-1, 3);
            v[k].position[3] = w;
            for (int i = 0; i < 4; i++)
                v[k].value[i] = random_float(-10, 10);
        }
        find_plane(v, plane);
        const double slope = (__builtin_fabs(plane[0]) + __builtin_fabs(plane[1])) * 2 / SIZE; /* a pixel */
        if (!(slope < 1)) /* a sliver, or seen nearly from the side */
            continue;
        lom_draw_desc desc = draw_of(&linears, v, 3);
        begin(&s, (lom_pass_desc){ .clear_color = { { -99, -99, -99, -99 } } });
        uint64_t before = lom_device_counters(s.device).triangles_clipped;
        lom_draw(s.device, &desc);
        finish(&s);
        cut += lom_device_counters(s.device).triangles_clipped != before;
        for (int p = 0; p < SIZE * SIZE; p++) {
            const float *value = floats_at(&s, p % SIZE, p / SIZE);
            if (value[0] == -99)
                continue;
            double exact =
                plane[0] * ((p % SIZE + 0.5) * 2 / SIZE - 1) + plane[1] * (1 - (p / SIZE + 0.5) * 2 / SIZE) + plane[2];
            pixels++;
            CHECK(__builtin_fabs((double)value[0] - exact) <= slope * 0.1 + 1e-4, "round %d, pixel %d: %.9g, not %.9g",
                  round, p, (double)value[0], exact);
        }
    }
    CHECK(pixels > 20000 && cut > 200, "%d pixels, %d cut", pixels, cut);
    close_stage(&s);
}

/* ---- depth clamp ---- */

static void draw_clamped(stage *s, const vertex *v, size_t count, lom_topology topology)
{
    lom_draw_desc desc = draw_of(&values, v, count);
    desc.topology = topology;
    desc.depth_clamp = true;
    desc.depth_compare = LOM_COMPARE_ALWAYS;
    begin(s, (lom_pass_desc){ .clear_depth = 0.25f, .clear_color = { { -99, -99, -99, -99 } } });
    lom_draw(s->device, &desc);
    finish(s);
}

static double clamp01(double x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* Triangles before, across and behind near and far, w = 1: they cover what the oracle says, where no cut runs within two
 * units of an edge; their depth is the plane's, clamped. */
static void depths_are_the_clamped_plane(void)
{
    stage s = open_floats(0, LOM_FORMAT_DEPTH32F);
    int clamped = 0, between = 0;
    for (int round = 0; round < 300; round++) {
        vertex v[3];
        snapped corner[3];
        double at[3][2], z[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = (snapped){ random_whole(0, UNITS), random_whole(0, UNITS) };
            place_at(&v[k], corner[k].x, corner[k].y, SIZE);
            at[k][0] = (double)corner[k].x;
            at[k][1] = (double)corner[k].y;
            v[k].position[2] = round % 3 == 0 ? random_float(1.5f, 3) : random_float(-2, 3);
            z[k] = v[k].position[2];
        }
        const double area = edge(at[0], at[1], at[2]);
        if (__builtin_fabs(area) < 256.0 * 256 * 40)
            continue;
        draw_clamped(&s, v, 3, LOM_TRIANGLES);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const double here[2] = { 256 * (p % SIZE) + 128, 256 * (p / SIZE) + 128 };
            double l[3], depth = 0, nearest = 1e9;
            for (int k = 0; k < 3; k++) {
                const double *a = at[(k + 1) % 3], *b = at[(k + 2) % 3];
                const double length = __builtin_sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]));
                l[k] = edge(a, b, here) / area;
                depth += l[k] * z[k];
                nearest = __builtin_fmin(nearest, __builtin_fabs(edge(a, b, here)) / length);
            }
            const bool is_covered = floats_at(&s, p % SIZE, p / SIZE)[0] != -99;
            const float stored = *(const float *)lom_image_pixel(s.depths, p % SIZE, p / SIZE, 0);
            if (round % 3 == 0 || nearest > 2)
                CHECK(is_covered == covers(corner, p % SIZE, p / SIZE), "round %d, pixel %d", round, p);
            if (!is_covered)
                continue;
            if (round % 3 == 0)
                CHECK(stored == 1, "round %d, pixel %d: %.9g before near", round, p, (double)stored);
            const double slope =
                (__builtin_fabs(z[1] - z[0]) + __builtin_fabs(z[2] - z[0])) * UNITS / __builtin_fabs(area);
            CHECK(__builtin_fabs((double)stored - clamp01(depth)) <= 1e-6 + 4 * slope,
                  "round %d, pixel %d: %.9g, not %.9g", round, p, (double)stored, clamp01(depth));
            clamped += stored == 0 || stored == 1;
            between += stored > 0 && stored < 1;
        }
    }
    CHECK(clamped > 5000 && between > 5000, "%d and %d pixels", clamped, between);
    close_stage(&s);
}

/* What has w <= 0 is cut all the same, and nothing is drawn of what has no other. */
static void w_is_cut(void)
{
    stage s = open_floats(0, LOM_FORMAT_DEPTH32F);
    vertex v[3];
    int pixels = 0;
    for (int round = 0; round < 100; round++) {
        for (int k = 0; k < 3; k++)
            v[k] = (vertex){ .position = { random_float(-2, 2), random_float(-2, 2), random_float(-2, 2),
                                           round % 2 == 0 || k == 0 ? random_float(-1, 0) : 1 } };
        draw_clamped(&s, v, 3, LOM_TRIANGLES);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const float depth = *(const float *)lom_image_pixel(s.depths, p % SIZE, p / SIZE, 0);
            const bool is_covered = floats_at(&s, p % SIZE, p / SIZE)[0] != -99;
            CHECK(depth >= 0 && depth <= 1 && (round % 2 != 0 || !is_covered), "round %d, pixel %d", round, p);
            pixels += is_covered;
        }
    }
    CHECK(pixels > 1000, "%d pixels", pixels);
    close_stage(&s);
}

/* A level line from before near to behind far has the pixels of one between them, each once, with the clamped depth;
 * points have the depth of the plane that they lie beyond. */
static void lines_and_points_are_clamped(void)
{
    stage s = open_floats(0, LOM_FORMAT_DEPTH32F);
    vertex v[2];
    place_at(&v[0], 256 * 4 + 128, 256 * 20 + 128, SIZE);
    place_at(&v[1], 256 * 60 + 128, 256 * 20 + 128, SIZE);
    v[0].position[2] = 3;
    v[1].position[2] = -4;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 4; i++)
            v[k].value[i] = (float)k;
    lom_draw_desc desc = draw_of(&values, v, 2);
    desc.topology = LOM_LINES;
    desc.depth_clamp = true;
    desc.depth_compare = LOM_COMPARE_ALWAYS;
    desc.blend[0] = adding();
    begin(&s, (lom_pass_desc){ .clear_color = { { 1, 0, 0, 0 } }, .clear_depth = 0.25f });
    lom_draw(s.device, &desc);
    finish(&s);
    for (int x = 0; x < SIZE; x++) {
        const double t = (x - 4) / 56.0, depth = clamp01(3 - 7 * t);
        const float stored = *(const float *)lom_image_pixel(s.depths, x, 20, 0);
        const bool on = x >= 4 && x < 60;
        CHECK(__builtin_fabs((double)floats_at(&s, x, 20)[0] - (on ? 1 + t : 1)) < 1e-2, "x %d: %g", x,
              (double)floats_at(&s, x, 20)[0]);
        CHECK(__builtin_fabs((double)stored - (on ? depth : 0.25)) < 1e-2, "x %d: depth %g", x, (double)stored);
        CHECK(floats_at(&s, x, 19)[0] == 1 && floats_at(&s, x, 21)[0] == 1);
    }
    draw_clamped(&s, v, 2, LOM_POINTS);
    CHECK(*(const float *)lom_image_pixel(s.depths, 4, 20, 0) == 1 &&
          *(const float *)lom_image_pixel(s.depths, 60, 20, 0) == 0);
    v[0].position[3] = -1;
    draw_clamped(&s, v, 2, LOM_POINTS);
    CHECK(*(const float *)lom_image_pixel(s.depths, 4, 20, 0) == 0.25f);
    close_stage(&s);
}

/* ---- instances ---- */

/* Attributes 0: a corner; 2: a place of the instance; 1: a colour. */
static void place_instance(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->position.x += in->attribute[2].x;
    out->position.y += in->attribute[2].y;
    out->varying[3] = lom_to_float(in->instance);
}

LOM_SHADER(placed, place_instance, show_values, .attributes = 3, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .colors = 1)

/* 7 instances: a place each, a colour for every two or three; bit for bit a draw for each, whose attributes are the same
 * for all vertices. */
static void instances_have_their_attributes(void)
{
    vertex v[3], of_instance[7];
    for (int k = 0; k < 3; k++)
        place_at(&v[k], 256 * (2 + 9 * (k == 1)), 256 * (2 + 9 * (k == 2)), SIZE);
    for (int i = 0; i < 7; i++)
        of_instance[i] =
            (vertex){ .position = { 0.25f * (float)i, -0.125f * (float)i }, .value = { (float)i + 1, 2, 3, 4 } };
    const size_t size = sizeof of_instance, stride = sizeof *of_instance;
    for (int divisor = 2; divisor <= 3; divisor++)
        for (int kind = LOM_ATTRIBUTE_FLOAT1; kind <= LOM_ATTRIBUTE_UNORM8X4; kind++) {
            stage s = open_floats(16, LOM_FORMAT_NONE), each = open_floats(16, LOM_FORMAT_NONE);
            lom_draw_desc desc = draw_of(&placed, v, 3);
            desc.attribute[2] = (lom_attribute){ of_instance[0].position, size, stride, LOM_ATTRIBUTE_FLOAT2 };
            desc.attribute[1] = (lom_attribute){ of_instance[0].value, size - 16, stride, (lom_attribute_kind)kind };
            desc.divisor[2] = 1;
            desc.divisor[1] = divisor;
            desc.instances = 7;
            begin(&s, (lom_pass_desc){ .clear_depth = 0 });
            lom_draw(s.device, &desc);
            finish(&s);
            begin(&each, (lom_pass_desc){ .clear_depth = 0 });
            for (int i = 0; i < 7; i++) {
                desc.attribute[2].data = of_instance[i].position;
                desc.attribute[1].data = of_instance[i / divisor].value;
                desc.attribute[1].size = desc.attribute[2].size = 32;
                desc.attribute[1].stride = desc.attribute[2].stride = 0;
                desc.divisor[1] = desc.divisor[2] = 0;
                desc.instances = 1;
                lom_draw(each.device, &desc);
            }
            finish(&each);
            int pixels = 0;
            for (int p = 0; p < SIZE * SIZE; p++) {
                const float *a = floats_at(&s, p % SIZE, p / SIZE), *b = floats_at(&each, p % SIZE, p / SIZE);
                CHECK(memcmp(a, b, 3 * sizeof *a) == 0, "divisor %d, kind %d, pixel %d: %g, not %g", divisor, kind, p,
                      (double)a[0], (double)b[0]);
                pixels += a[3] > 0;
            }
            CHECK(pixels > 100, "%d pixels of the later instances", pixels);
            close_stage(&s);
            close_stage(&each);
        }
}

int main(int argc, char **argv)
{
    RUN(flat_values_are_the_provoking_vertex_s);
    RUN(facing_does_not_depend_on_it);
    RUN(whole_triangles_are_affine);
    RUN(cuts_change_no_value);
    RUN(depths_are_the_clamped_plane);
    RUN(w_is_cut);
    RUN(lines_and_points_are_clamped);
    RUN(instances_have_their_attributes);
    return check_result();
}
