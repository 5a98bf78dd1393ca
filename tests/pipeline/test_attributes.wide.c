/* Proves what varyings are at this width (A2..A6, A9): constants stay constants, wild values stay inside their hull, flat
 * ones are the last vertex's in every topology, far ends of long edges keep the bound, helpers outside stay finite,
 * derivatives are the oracle's; and what every kind of attribute reads. */
#include "stage.h"

#include "oracle/interpolation.h"

#include <math.h>

enum { SIZE = 64, UNITS = SIZE * 256 };

static lom_float is_finite(lom_float x)
{
    return lom_select(lom_abs(x) <= 0x1.fffffep127f, lom_splat(1), lom_splat(-1));
}

/* 1 where a value is finite, -1 where not: the varying, its difference in the quad, its analytic derivatives. */
static void examine(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float value = in->varying[0];
    out->color[0] = (lom_float4){ is_finite(value), is_finite(lom_quad_dx(value) + lom_quad_dy(value)),
                                  is_finite(lom_dx(in, 0)), is_finite(lom_dy(in, 0)) };
}

LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(flats, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .flat = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(helpers, place_values, examine, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .differentiates = 1u << 0, .quads = true, .colors = 1)

/* Two varyings' analytic derivatives. */
static void show_changes(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_dx(in, 0), lom_dy(in, 0), lom_dx(in, 1), lom_dy(in, 1) };
}

LOM_SHADER(changes, place_values, show_changes, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 2),
           .differentiates = LOM_VARYINGS(0, 2), .colors = 1)

static vertex vertices[64];

/* A random triangle with w between 1 and `ratio`; half of them are small. */
static void put_triangle(float ratio, bool small)
{
    int64_t x = random_whole(0, UNITS), y = random_whole(0, UNITS), reach = small ? 3 * 256 : UNITS;
    for (int k = 0; k < 3; k++) {
        place_at(&vertices[k], x + random_whole(-reach, reach), y + random_whole(-reach, reach), SIZE);
        float w = k == 0 ? 1 : k == 1 ? ratio : random_float(1, ratio);
        for (int i = 0; i < 4; i++)
            vertices[k].position[i] *= w;
    }
}

static void draw_values(stage *s, const lom_shader *shader, size_t count, lom_topology topology)
{
    lom_draw_desc desc = draw_of(shader, vertices, count);
    desc.topology = topology;
    begin(s, (lom_pass_desc){ .clear_color = { { -2, -2, -2, -2 } } });
    lom_draw(s->device, &desc);
    finish(s);
}

static stage open_floats(void)
{
    return open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
}

/* A2: an attribute that is the same at all vertices is exactly that in every pixel, whatever the perspective. */
static void a2_constants_stay_constant(void)
{
    static const float constants[4] = { 1.0f / 3, -1e30f, 1e-40f, 16777215 };
    stage s = open_floats();
    int pixels = 0;
    for (int round = 0; round < 400; round++) {
        static const float ratios[] = { 1, 1e2f, 1e4f, 1e6f };
        put_triangle(ratios[round % 4], round % 8 < 4);
        for (int k = 0; k < 3; k++)
            memcpy(vertices[k].value, constants, sizeof constants);
        draw_values(&s, &values, 3, LOM_TRIANGLES);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const float *value = floats_at(&s, p % SIZE, p / SIZE);
            pixels += value[0] != -2;
            CHECK(value[0] == -2 || memcmp(value, constants, sizeof constants) == 0, "round %d, pixel %d: %a", round, p,
                  (double)value[0]);
        }
    }
    CHECK(pixels > 10000, "%d pixels", pixels);
    close_stage(&s);
}

/* A3: 1e30 beside -1e30, and denormals, stay finite and between the least and the largest of the three. */
static void a3_wild_values_stay_inside_their_hull(void)
{
    static const float wild[] = { 1e30f, -1e30f, 1e-40f, -1e-40f, 0, 1, 0x1p122f, -0x1p122f };
    stage s = open_floats();
    for (int round = 0; round < 400; round++) {
        float low[4] = { 1e38f, 1e38f, 1e38f, 1e38f }, high[4] = { -1e38f, -1e38f, -1e38f, -1e38f };
        put_triangle(round % 2 == 0 ? 1 : 1e5f, round % 4 < 2);
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 4; i++) {
                float v = vertices[k].value[i] = wild[random_whole(0, 7)];
                low[i] = v < low[i] ? v : low[i];
                high[i] = v > high[i] ? v : high[i];
            }
        draw_values(&s, &values, 3, LOM_TRIANGLES);
        for (int p = 0; p < SIZE * SIZE; p++)
            for (int i = 0; i < 4; i++) {
                float value = floats_at(&s, p % SIZE, p / SIZE)[i];
                CHECK(value == -2 || (value >= low[i] && value <= high[i]), "round %d: %g outside %g..%g", round,
                      (double)value, (double)low[i], (double)high[i]);
            }
    }
    close_stage(&s);
}

/* A4: the last vertex of each triangle, in lists, strips and fans, of both windings. */
static void a4_flat_values_are_the_last_vertex_s(void)
{
    enum { COUNT = 12 };
    stage s = open_floats();
    for (int topology = LOM_TRIANGLES; topology <= LOM_TRIANGLE_FAN; topology++)
        for (int round = 0; round < 40; round++) {
            for (int v = 0; v < COUNT; v++) {
                place_at(&vertices[v], random_whole(0, UNITS), random_whole(0, UNITS), SIZE);
                for (int i = 0; i < 4; i++)
                    vertices[v].value[i] = (float)(v + 100 * i);
            }
            draw_values(&s, &flats, COUNT, (lom_topology)topology);
            for (int p = 0; p < SIZE * SIZE; p++) {
                int last = -2; /* of the last triangle that covers the pixel */
                for (int v = 2; v < COUNT; v += topology == LOM_TRIANGLES ? 3 : 1) {
                    int first = topology == LOM_TRIANGLE_FAN ? 0 : v - 2;
                    snapped corner[3] = { snap(vertices[first].position, SIZE, SIZE),
                                          snap(vertices[v - 1].position, SIZE, SIZE),
                                          snap(vertices[v].position, SIZE, SIZE) };
                    last = covers(corner, p % SIZE, p / SIZE) ? v : last;
                }
                const float *value = floats_at(&s, p % SIZE, p / SIZE);
                CHECK(value[0] == (float)last && (last == -2 || value[3] == (float)(last + 300)),
                      "topology %d, pixel %d: vertex %g, not %d", topology, p, (double)value[0], last);
            }
        }
    close_stage(&s);
}

/* A5: an edge 65 000 pixels long; the value is x, exact at every pixel within the bound, at both ends. */
static void a5_far_ends_of_long_edges_keep_the_bound(void)
{
    enum { FRAME = 32768 };
    static const int origins[] = { 0, FRAME / 2 - SIZE, FRAME - SIZE };
    const float left = -16300, right = FRAME + 16300;
    for (int o = 0; o < 3; o++) {
        stage s = open_floats();
        static const float y[3] = { -100, 200, 20 };
        for (int k = 0; k < 3; k++) {
            float x = k == 2 ? right : left;
            vertices[k] = (vertex){ .position = { x / (FRAME / 2) - 1, 1 - y[k] / (FRAME / 2), 0.5f, 1 },
                                    .value = { x, 0, 0, 0 } };
        }
        lom_draw_desc desc = draw_of(&values, vertices, 3);
        begin(&s, (lom_pass_desc){ .frame_width = FRAME, .frame_height = FRAME, .origin_x = origins[o] });
        lom_draw(s.device, &desc);
        finish(&s);
        int pixels = 0;
        for (int p = 0; p < SIZE * SIZE; p++) {
            float value = floats_at(&s, p % SIZE, p / SIZE)[0];
            double error = (double)value - (origins[o] + p % SIZE + 0.5);
            if (value == 0)
                continue;
            pixels++;
            CHECK(error <= 8 * 0x1p-24 * right && error >= -8 * 0x1p-24 * right, "pixel %d of %d: off by %g", p,
                  origins[o], error);
        }
        CHECK(pixels > 100, "%d pixels at %d", pixels, origins[o]);
        close_stage(&s);
    }
}

/* A6: quads reach outside of their triangle, where 1/w may pass through 0; nothing that a shader sees is infinite. */
static void a6_helpers_outside_the_triangle_stay_finite(void)
{
    stage s = open_floats();
    int pixels = 0;
    for (int round = 0; round < 600; round++) {
        static const float ratios[] = { 1, 1e2f, 1e4f, 1e6f };
        put_triangle(ratios[round % 4], round % 8 < 6);
        for (int k = 0; k < 3; k++)
            vertices[k].value[0] = random_float(-1000, 1000);
        draw_values(&s, &helpers, 3, LOM_TRIANGLES);
        for (int p = 0; p < SIZE * SIZE; p++)
            for (int i = 0; i < 4; i++) {
                float value = floats_at(&s, p % SIZE, p / SIZE)[i];
                pixels += value != -2;
                CHECK(value != -1, "round %d, pixel %d: value %d is not finite", round, p, i);
            }
    }
    CHECK(pixels > 10000, "%d values", pixels);
    close_stage(&s);
}

/* Every kind of attribute, by its definition: bytes are n / 255 rounded once, and what a kind lacks is 0, 0, 0, 1. */
static void kinds_are_their_numbers(void)
{
    static const float row[4] = { 0.25f, -3, 1e20f, 7 };
    stage s = open_floats();
    uint8_t bytes[3][4];
    for (int kind = LOM_ATTRIBUTE_NONE; kind <= LOM_ATTRIBUTE_UNORM8X4; kind++)
        for (int n = 0; n < (kind == LOM_ATTRIBUTE_UNORM8X4 ? 256 : 1); n++) {
            for (int k = 0; k < 3; k++) {
                place_at(&vertices[k], k == 1 ? 2 * UNITS : 0, k == 2 ? 2 * UNITS : 0, SIZE);
                memcpy(vertices[k].value, row, sizeof row);
                for (int c = 0; c < 4; c++)
                    bytes[k][c] = (uint8_t)(n + 85 * c);
            }
            lom_draw_desc desc = draw_of(&values, vertices, 3);
            desc.attribute[1].kind = (lom_attribute_kind)kind;
            if (kind == LOM_ATTRIBUTE_UNORM8X4)
                desc.attribute[1] = (lom_attribute){ bytes, sizeof bytes, 4, LOM_ATTRIBUTE_UNORM8X4 };
            begin(&s, (lom_pass_desc){ .clear_color = { { -2, -2, -2, -2 } } });
            lom_draw(s.device, &desc);
            finish(&s);
            for (int c = 0; c < 4; c++) {
                float expected = kind == LOM_ATTRIBUTE_UNORM8X4  ? (float)bytes[0][c] / 255.0f
                                 : c < kind - LOM_ATTRIBUTE_NONE ? row[c]
                                                                 : (float)(c == 3);
                CHECK(floats_at(&s, 9, 20)[c] == expected, "kind %d, channel %d: %g, not %g", kind, c,
                      (double)floats_at(&s, 9, 20)[c], (double)expected);
            }
        }
    close_stage(&s);
}

/* By how much the three parts of which a derivative is the sum could be off: units of 2^-24 of what they are before they
 * cancel. */
static double size_of_change(const snapped v[3], const double w[3], const double value[3], double x, double y, int axis)
{
    double weight[3], sum = 0, parts = 0, largest = 0;
    weights_at(v, w, x, y, weight);
    for (int i = 0; i < 3; i++) {
        const snapped *p = &v[(i + 1) % 3], *q = &v[(i + 2) % 3];
        sum += edge_value(p, q, x, y) / w[i];
        parts += 256 * fabs((double)(axis == 0 ? q->y - p->y : q->x - p->x)) / w[i];
        largest = fmax(largest, fabs(value[i]));
    }
    return 2 * parts * largest / fabs(sum);
}

/* A9: derivatives of varyings are those of the interpolation in double, wherever a triangle is covered. */
static void a9_derivatives_are_the_oracles(void)
{
    static const float ratios[] = { 1, 10, 1e3f, 1e5f };
    stage s = open_floats();
    double worst = 0;
    int pixels = 0;
    for (int round = 0; round < 400; round++) {
        snapped at[3];
        double w[3], value[2][3];
        put_triangle(ratios[round % 4], round % 8 < 4);
        for (int k = 0; k < 3; k++) {
            for (int i = 0; i < 2; i++)
                value[i][k] = (double)(vertices[k].value[i] = random_float(-9, 9));
            at[k] = snap(vertices[k].position, SIZE, SIZE);
            w[k] = (double)vertices[k].position[3];
        }
        draw_values(&s, &changes, 3, LOM_TRIANGLES);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const float *got = floats_at(&s, p % SIZE, p / SIZE);
            if (memcmp(got, (float[4]){ -2, -2, -2, -2 }, 16) == 0)
                continue;
            const double x = 256 * (p % SIZE) + 128, y = 256 * (p / SIZE) + 128;
            for (int i = 0; i < 4; i++) {
                double want[2];
                change_at(at, w, value[i / 2], x, y, want);
                const double units =
                    fabs((double)got[i] - want[i % 2]) * 0x1p24 / size_of_change(at, w, value[i / 2], x, y, i % 2);
                CHECK(units <= 8, "round %d, pixel %d: %g, not %g: %g units", round, p, (double)got[i], want[i % 2],
                      units);
                worst = fmax(worst, units);
            }
            pixels++;
        }
    }
    CHECK(pixels > 10000, "%d pixels", pixels);
    printf("  derivatives within %.1f units of 2^-24\n", worst);
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(a2_constants_stay_constant);
    RUN(a3_wild_values_stay_inside_their_hull);
    RUN(a4_flat_values_are_the_last_vertex_s);
    RUN(a5_far_ends_of_long_edges_keep_the_bound);
    RUN(a6_helpers_outside_the_triangle_stay_finite);
    RUN(a9_derivatives_are_the_oracles);
    RUN(kinds_are_their_numbers);
    return check_result();
}
