/* Proves where fragments of several samples are shaded, a sentence of docs/samples.md at a time: the place is the centre or the
 * first sample that the triangle covers, before the depth test; position, z and w are those of that place, and so is the depth
 * of the target, that of sample 0 at the centre; in quads it is the centre always. And which samples alpha lets through. Each
 * for small triangles and for large ones, which other files draw. */
#include "sampled.h"

enum { FIRST = 39, LAST = 45 }; /* pixels that are looked at, along both axes */

/* ---- a triangle, and what must be found at a place ---- */

typedef struct triangle {
    vertex v[3];
    snapped corner[3];
    double slope; /* of depth, a pixel right */
    double over_w[3];
} triangle;

static double depth_at(double slope, double x, double y)
{
    return 0.4 + (x - 42) * slope - (y - 42) * slope / 2;
}

/* Some pixels large, or more than 64; its depth is level along one direction, its w are powers of two. */
static triangle make_triangle(bool large)
{
    const int64_t reach = large ? 256 * 90 : 256 * 3;
    triangle t = { .slope = large ? 0x1p-10 : 0x1p-6 };
    for (int k = 0; k < 3; k++) {
        t.corner[k] = (snapped){ 42 * 256 + random_whole(-reach, reach), 42 * 256 + random_whole(-reach, reach) };
        place_at(&t.v[k], t.corner[k].x, t.corner[k].y, SIZE);
        t.v[k].position[2] = (float)depth_at(t.slope, (double)t.corner[k].x / 256, (double)t.corner[k].y / 256);
        const float w = (float)(1 << random_whole(0, 2)) * 0.5f;
        for (int i = 0; i < 4; i++)
            t.v[k].position[i] *= w;
        t.over_w[k] = 1 / (double)w;
        for (int i = 0; i < 4; i++)
            t.v[k].value[i] = 1;
    }
    return t;
}

static double cross(double ax, double ay, double bx, double by)
{
    return ax * by - ay * bx;
}

static double w_at(const triangle *t, double x, double y)
{
    double sum = 0, area = 0;
    for (int i = 0; i < 3; i++) {
        const snapped *p = &t->corner[(i + 1) % 3], *q = &t->corner[(i + 2) % 3];
        const double e =
            cross((double)(q->x - p->x), (double)(q->y - p->y), x * 256 - (double)p->x, y * 256 - (double)p->y);
        area += e;
        sum += e * t->over_w[i];
    }
    return area / sum;
}

/* What a pixel has of a triangle. */
typedef struct seen {
    unsigned bits;
    int first; /* the sample where it is shaded, -1: the centre */
    double x, y;
} seen;

static seen see(const snapped corner[3], int samples, int px, int py, bool quads)
{
    seen s = { .bits = samples_of(corner, samples, px, py), .first = -1 };
    int at[2] = { 0, 0 };
    if (s.bits != 0 && !quads && !covers(corner, px, py)) {
        s.first = __builtin_ctz(s.bits);
        lom_sample_position(samples, s.first, at);
    }
    s.x = px + 0.5 + at[0] / 16.0;
    s.y = py + 0.5 + at[1] / 16.0;
    return s;
}

static bool is_near(double found, double wanted, double error)
{
    return found - wanted <= error && wanted - found <= error;
}

/* ---- the shaders ---- */

static void show_place(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->x, in->y, in->z, in->w };
}

static void show_target(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->target_depth, in->x, in->y, lom_splat(1) };
}

LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(placed, place_values, show_place, .attributes = 2, .varyings = 4, .reads_position = true, .colors = 1)
LOM_SHADER(in_quads, place_values, show_place, .attributes = 2, .varyings = 4, .reads_position = true, .quads = true,
           .colors = 1)
LOM_SHADER(behind, place_values, show_target, .attributes = 2, .varyings = 4, .reads_position = true,
           .reads_depth = true, .colors = 1)

/* Black, over the whole picture or left of x, at a depth that is level or steep. */
static void make_ground(vertex v[3], int64_t x, double slope)
{
    place_at(&v[0], x, -256 * SIZE, SIZE);
    place_at(&v[1], x, 256 * 3 * SIZE, SIZE);
    place_at(&v[2], x - 256 * 4 * SIZE, 256 * SIZE, SIZE);
    for (int k = 0; k < 3; k++) {
        const double px = (v[k].position[0] + 1.0) * SIZE / 2;
        v[k].position[2] = (float)(slope == 0 ? 0.9 : 0.5 + (px - 42) * slope);
        memset(v[k].value, 0, sizeof v[k].value);
    }
}

/* A picture of a triangle, over a ground if there is one. */
static stage draw_over(const vertex ground[3], const triangle *t, const lom_shader *shader, int samples,
                       lom_compare compare)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    lom_draw_desc draw = draw_of(shader, t->v, 3);
    draw.depth_compare = compare;
    draw.depth_write_off = compare == LOM_COMPARE_ALWAYS;
    begin(&s, (lom_pass_desc){ .samples = samples });
    if (ground != NULL) {
        lom_draw_desc under = draw_of(&values, ground, 3);
        lom_draw(s.device, &under);
    }
    lom_draw(s.device, &draw);
    finish(&s);
    return s;
}

#define EACH_PIXEL(x, y)                                                                                               \
    for (int y = FIRST; y < LAST; y++)                                                                                 \
        for (int x = FIRST; x < LAST; x++)

/* ---- what they must show ---- */

static void check_places(const lom_shader *shader, bool quads)
{
    for (int round = 0; round < 64; round++) {
        const int samples = counts[round & 3];
        const triangle t = make_triangle(round % 8 > 3);
        stage s = draw_over(NULL, &t, shader, samples, LOM_COMPARE_DEFAULT);
        EACH_PIXEL(x, y)
        {
            const seen at = see(t.corner, samples, x, y, quads);
            const double part = __builtin_popcount(at.bits) / (double)samples;
            const float *found = floats_at(&s, x, y);
            const bool outside = quads && !covers(t.corner, x, y); /* there z and w are clamped to the triangle's */
            CHECK(is_near(found[0], at.x * part, 1e-5) && is_near(found[1], at.y * part, 1e-5),
                  "round %d, pixel %d,%d: shaded at %g,%g, not %g,%g", round, x, y, found[0] / part, found[1] / part,
                  at.x, at.y);
            CHECK(outside || is_near(found[2], depth_at(t.slope, at.x, at.y) * part, 1e-5),
                  "round %d, pixel %d,%d: z %g, not %g", round, x, y, found[2] / part, depth_at(t.slope, at.x, at.y));
            CHECK(outside || is_near(found[3], w_at(&t, at.x, at.y) * part, 1e-4),
                  "round %d, pixel %d,%d: w %g, not %g", round, x, y, found[3] / part, w_at(&t, at.x, at.y));
        }
        close_stage(&s);
    }
}

static void position_z_and_w_are_those_of_the_place_of_shading(void)
{
    check_places(&placed, false);
}

static void quads_are_shaded_at_centres_always(void)
{
    check_places(&in_quads, true);
}

static void the_depth_of_the_target_is_that_of_the_place(void)
{
    for (int round = 0; round < 64; round++) {
        const int samples = counts[round & 3];
        const double slope = 0x1p-11;
        const triangle t = make_triangle(round % 8 > 3);
        vertex ground[3];
        make_ground(ground, 256 * 90, slope);
        stage s = draw_over(ground, &t, &behind, samples, LOM_COMPARE_ALWAYS);
        EACH_PIXEL(x, y)
        {
            const seen at = see(t.corner, samples, x, y, false);
            const double part = __builtin_popcount(at.bits) / (double)samples;
            int place[2];
            lom_sample_position(samples, at.first < 0 ? 0 : at.first, place);
            const double wanted = 0.5 + (x + 0.5 + place[0] / 16.0 - 42) * slope;
            CHECK(is_near(floats_at(&s, x, y)[0], wanted * part, 2e-6),
                  "round %d, pixel %d,%d of %d samples: the target's depth is %g, not %g at sample %d", round, x, y,
                  samples, floats_at(&s, x, y)[0] / part, wanted, at.first);
        }
        close_stage(&s);
    }
}

/* What lies nearer hides samples, and does not move the place. */
static void the_place_is_chosen_before_the_depth_test(void)
{
    for (int round = 0; round < 64; round++) {
        const int samples = counts[round & 3];
        const triangle t = make_triangle(round % 8 > 3);
        const int64_t edge = 256 * 41 + random_whole(0, 511);
        vertex ground[3];
        snapped corner[3] = { { edge, -256 * SIZE }, { edge, 256 * 3 * SIZE }, { edge - 256 * 4 * SIZE, 256 * SIZE } };
        make_ground(ground, edge, 0);
        stage s = draw_over(ground, &t, &placed, samples, LOM_COMPARE_DEFAULT);
        EACH_PIXEL(x, y)
        {
            const seen at = see(t.corner, samples, x, y, false);
            const double part = __builtin_popcount(at.bits & ~samples_of(corner, samples, x, y)) / (double)samples;
            const float *found = floats_at(&s, x, y);
            CHECK(is_near(found[0], at.x * part, 1e-5) && is_near(found[1], at.y * part, 1e-5),
                  "round %d, pixel %d,%d: shaded at %g,%g, not %g,%g", round, x, y, found[0] / part, found[1] / part,
                  at.x, at.y);
        }
        close_stage(&s);
    }
}

/* ---- alpha ---- */

/* Of a fragment of some samples those among the first floor(n a + 1/2) of the pixel. */
static void alpha_lets_the_first_samples_through(void)
{
    for (int round = 0; round < 64; round++) {
        const int samples = counts[round & 3], count = (int)random_whole(0, samples);
        triangle t = make_triangle(round % 8 > 3);
        for (int k = 0; k < 3; k++)
            t.v[k].value[3] = (float)count / (float)samples;
        stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
        lom_draw_desc draw = draw_of(&values, t.v, 3);
        draw.alpha_to_coverage = true;
        begin(&s, (lom_pass_desc){ .samples = samples });
        lom_draw(s.device, &draw);
        finish(&s);
        EACH_PIXEL(x, y)
        {
            const unsigned bits = samples_of(t.corner, samples, x, y) & ((1u << count) - 1);
            CHECK(floats_at(&s, x, y)[0] * (float)samples == (float)__builtin_popcount(bits),
                  "round %d, pixel %d,%d: %g of %d samples, not %d", round, x, y,
                  (double)floats_at(&s, x, y)[0] * samples, samples, __builtin_popcount(bits));
        }
        close_stage(&s);
    }
}

/* Two layers of one alpha: of the farther one nothing is seen. */
static void layers_of_one_alpha_hide_one_another(void)
{
    for (int k = 0; k < 4; k++)
        for (int count = 0; count <= counts[k]; count++) {
            stage s =
                open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
            begin(&s, (lom_pass_desc){ .samples = counts[k] });
            vertex corners[2][3]; /* of both, until the pass has ended */
            for (int layer = 0; layer < 2; layer++) {
                vertex *v = corners[layer];
                make_ground(v, 256 * 90, 0);
                for (int i = 0; i < 3; i++) {
                    v[i].position[2] = layer == 0 ? 0.25f : 0.5f;
                    v[i].value[layer] = 1;
                    v[i].value[3] = (float)count / (float)counts[k];
                }
                lom_draw_desc draw = draw_of(&values, v, 3);
                draw.alpha_to_coverage = true;
                lom_draw(s.device, &draw);
            }
            finish(&s);
            const float *found = floats_at(&s, 42, 42);
            CHECK(found[0] == 0 && found[1] == (float)count / (float)counts[k],
                  "%d of %d samples: %g of the farther layer, %g of the nearer", count, counts[k], (double)found[0],
                  (double)found[1]);
            close_stage(&s);
        }
}

int main(int argc, char **argv)
{
    RUN(position_z_and_w_are_those_of_the_place_of_shading);
    RUN(quads_are_shaded_at_centres_always);
    RUN(the_depth_of_the_target_is_that_of_the_place);
    RUN(the_place_is_chosen_before_the_depth_test);
    RUN(alpha_lets_the_first_samples_through);
    RUN(layers_of_one_alpha_hide_one_another);
    return check_result();
}
