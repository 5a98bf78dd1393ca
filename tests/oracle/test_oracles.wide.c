/* Proves the oracles themselves by closed forms (R0 to R1): whole squares and triangles counted, planes seen in perspective,
 * ramps and constants sampled, identities of blending, the cosine law and the mirrored ray. What is tested with them
 * afterwards shares no code with them. */
#include "oracle/blending.h"
#include "oracle/interpolation.h"
#include "oracle/lighting.h"
#include "oracle/sampling.h"

static int count_covered(const snapped v[3], int size)
{
    int count = 0;
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            count += covers(v, x, y);
    return count;
}

/* A square of n pixels is halved by a diagonal that goes through centres: they belong to the half of which it is a left
 * edge, that to the right of it, which has n (n + 1) / 2 pixels; the other has the rest. */
static void coverage_counts_squares_and_their_halves(void)
{
    for (int n = 1; n <= 40; n++) {
        const int64_t a = 256 * 3, b = a + 256 * n;
        const snapped corners[4] = { { a, a }, { b, a }, { b, b }, { a, b } };
        const snapped upper_right[3] = { corners[0], corners[1], corners[2] };
        const snapped lower_left[3] = { corners[0], corners[2], corners[3] };
        const snapped upper_left[3] = { corners[0], corners[1], corners[3] };
        const snapped lower_right[3] = { corners[1], corners[2], corners[3] };
        CHECK(count_covered(upper_right, 50) == n * (n + 1) / 2, "n = %d: %d", n, count_covered(upper_right, 50));
        CHECK(count_covered(lower_left, 50) == n * (n - 1) / 2, "n = %d: %d", n, count_covered(lower_left, 50));
        CHECK(count_covered(upper_left, 50) == n * (n - 1) / 2, "n = %d: %d", n, count_covered(upper_left, 50));
        CHECK(count_covered(lower_right, 50) == n * (n + 1) / 2, "n = %d: %d", n, count_covered(lower_right, 50));
    }
    const snapped wide[3] = { { -(INT64_C(1) << 40), -(INT64_C(1) << 40) },
                              { INT64_C(1) << 42, 0 },
                              { 0, INT64_C(1) << 42 } };
    CHECK(count_covered(wide, 50) == 2500, "far beyond 64 bits of area: %d", count_covered(wide, 50));
}

/* A floor one metre below the eye, with the horizon in row 0: the row y of the screen shows what is 1 / y away. */
static void interpolation_sees_a_plane(void)
{
    const double unit = 256 * 256; /* a distance of 1 is 256 pixels down */
    const snapped v[3] = { { 0, 65536 / 64 }, { 65536, 65536 / 64 }, { 0, 65536 } };
    const double w[3] = { 64, 64, 1 }, distance[3] = { 64, 64, 1 };
    for (int y = 20; y < 250; y += 7)
        for (int x = 1; x < 250 - y; x += 11) {
            const double px = 256.0 * x + 128, py = 256.0 * y + 128, exact = unit / py;
            double weight[3], change[2];
            weights_at(v, w, px, py, weight);
            change_at(v, w, distance, px, py, change);
            CHECK(fabs(weighted(weight, distance) / exact - 1) < 1e-13, "row %d: %g", y, weighted(weight, distance));
            CHECK(fabs(change[0]) < 1e-12 && fabs(change[1] / (-256 * unit / (py * py)) - 1) < 1e-11, "row %d: %g %g",
                  y, change[0], change[1]);
            weights_at(v, NULL, px, py, weight);
            const double places[3] = { 0, 65536, 0 };
            CHECK(fabs(weighted(weight, places) - px) < 1e-9, "column %d: %g", x, weighted(weight, places));
        }
}

/* A ramp is a ramp between its centres, a constant is one everywhere; between two constant levels the mean is linear. */
static void sampling_keeps_ramps_and_constants(void)
{
    uint8_t ramp[16 * 16 * 4], level[8 * 8 * 4];
    for (int i = 0; i < 16 * 16 * 4; i++)
        ramp[i] = (uint8_t)(i % 4 == 0 ? 16 * (i / 4 % 16) : i % 4 == 1 ? 8 * (i / 64) : 77);
    memset(level, 200, sizeof level);
    const void *levels[] = { level };
    plain_texture p = make_plain_of((lom_texture_desc){ .width = 16,
                                                        .height = 16,
                                                        .format = LOM_FORMAT_RGBA8,
                                                        .mips = LOM_MIPS_SUPPLIED,
                                                        .level_pixels = levels,
                                                        .level_count = 2,
                                                        .pixels = ramp,
                                                        .sampler = { .minify = LOM_FILTER_LINEAR_MIPMAP_LINEAR } });
    double out[4], bound = 0;
    bool shaky = false;
    for (int i = 0; i <= 100; i++) {
        const double s = (0.5 + 0.15 * i) / 16, at[3] = { s, 1 - s, 0 };
        sample_plain(&p, at, 0, out, &bound, &shaky);
        CHECK(fabs(out[0] - 16 * (16 * s - 0.5) / 255) < 1e-13 && fabs(out[1] - 8 * (16 * (1 - s) - 0.5) / 255) < 1e-13,
              "at %g: %g %g", s, out[0], out[1]);
        CHECK(fabs(out[2] - 77 / 255.0) < 1e-15, "a constant is %g", out[2]);
        const double lod = i / 100.0, mean = 77 + (200 - 77) * lod;
        sample_plain(&p, at, lod, out, &bound, &shaky);
        CHECK(fabs(out[2] - mean / 255) < 1e-14, "at level %g: %g", lod, out[2]);
        const double beyond[3] = { s + 3, 1 - s - 2, 0 };
        double again[4];
        sample_plain(&p, at, 0, out, &bound, &shaky);
        sample_plain(&p, beyond, 0, again, &bound, &shaky);
        CHECK(fabs(out[0] - again[0]) < 1e-12 && fabs(out[1] - again[1]) < 1e-12, "it does not repeat at %g", s);
    }
    free_plain(&p);
}

/* Over: alpha 0 is nothing, alpha 1 is all, and two layers are their combination (Porter and Duff 1984). */
static void blending_is_porter_and_duffs(void)
{
    const lom_blend over = { .source_color = LOM_FACTOR_SOURCE_ALPHA,
                             .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                             .source_alpha = LOM_FACTOR_ONE,
                             .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };
    for (int i = 0; i <= 10; i++)
        for (int k = 0; k <= 10; k++) {
            const double a = i / 10.0, b = k / 10.0, both = a + b - a * b;
            struct blend_terms first = { .source = { 0.2, 0.9, 0.4, a }, .target = { 0.7, 0.1, 0.5, 1 } },
                               second = first;
            double once = blend_equation(&over, &first, 0);
            CHECK((i > 0 || once == 0.7) && (i < 10 || once == 0.2), "alpha %g: %g", a, once);
            second.source[0] = 0.6;
            second.source[3] = b;
            second.target[0] = once;
            const double twice = blend_equation(&over, &second, 0);
            const double layers = 0.6 * b + 0.2 * a * (1 - b); /* premultiplied */
            CHECK(fabs(twice - (layers + 0.7 * (1 - both))) < 1e-15, "%g then %g: %g", a, b, twice);
            CHECK(fabs(blend_equation(&over, &first, 3) - 1) < 1e-15, "an opaque target stays so");
        }
}

static void lighting_is_lamberts_and_phongs(void)
{
    const double degree = 0.017453292519943295, white[3] = { 1, 1, 1 };
    lit_surface m = { .diffuse = { 1, 1, 1 }, .shininess = 20, .sun = { 2, 2, 2 } };
    for (int i = 0; i < 120; i += 5) {
        const double c = cos(i * degree), s = sin(i * degree), normal[3] = { 0, 1, 0 }, mirrored[3] = { -s, c, 0 };
        m.to_sun[0] = s;
        m.to_sun[1] = c;
        double out[3];
        light_surface(&m, normal, mirrored, white, out);
        CHECK(fabs(out[0] - (c > 0 ? 2 * c : 0)) < 1e-15, "%d degrees: %g", i, out[0]);
        for (int off = 0; off < 80; off += 9) { /* from the mirrored ray; Blinn's halfway vector turns half as far */
            const double turned = (i - off) * degree, eye[3] = { -sin(turned), cos(turned), 0 };
            m.blinn = false;
            CHECK(fabs(highlight(&m, normal, eye) - (c > 0 ? pow(cos(off * degree), 20) : 0)) < 1e-14, "%d and %d", i,
                  off);
            m.blinn = true;
            CHECK(fabs(highlight(&m, normal, eye) - (c > 0 ? pow(cos(off * degree / 2), 20) : 0)) < 1e-14, "%d and %d",
                  i, off);
        }
    }
    const lit_surface sky = {
        .ambient = { 1, 1, 1 }, .sky = { 1, 0.5, 1 }, .ground = { 1, 0, 1 }, .to_sun = { 0, -1, 0 }
    };
    for (int i = 0; i <= 180; i += 5) { /* a hemisphere seen from a facet: the mean of both by the cosine to up */
        const double normal[3] = { sin(i * degree), cos(i * degree), 0 };
        double out[3];
        light_surface(&sky, normal, normal, white, out);
        CHECK(fabs(out[0] - 1) < 1e-15 && fabs(out[1] - 0.25 * (1 + cos(i * degree))) < 1e-15, "%d degrees: %g", i,
              out[1]);
    }
}

int main(int argc, char **argv)
{
    RUN(coverage_counts_squares_and_their_halves);
    RUN(interpolation_sees_a_plane);
    RUN(sampling_keeps_ramps_and_constants);
    RUN(blending_is_porter_and_duffs);
    RUN(lighting_is_lamberts_and_phongs);
    return check_result();
}
