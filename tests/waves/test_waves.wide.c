/* Proves of the surface of trochoids at every width: slopes are the derivatives of the displacement, crests never loop,
 * both are the same found together or apart, what a filter takes from the slopes it adds to their variance, phases stay
 * exact after years, and bounds hold. */
#include "check.h"

#include "water/surface.h"

static lom_water_params parameters(double height, double steepness, int count)
{
    lom_water_params water = { .level = 2 };
    water.waves = (lom_water_waves){ .kind = LOM_WAVES_GERSTNER,
                                     .seed = 7,
                                     .direction = 0.4,
                                     .height = height,
                                     .length = { 20, 0.7 },
                                     .count = count,
                                     .steepness = steepness,
                                     .spread = 0.5 };
    return water;
}

static struct lom_waves_uniform waves_at(double height, double steepness, int count, double time)
{
    struct lom_waves_uniform waves;
    lom_water_params water = parameters(height, steepness, count);
    memset(&waves, 0, sizeof waves);
    lom_fill_trochoids(&waves, &water.waves, &water.foam, (double[2]){ 0, 0 }, time);
    return waves;
}

static const struct lom_footprint point; /* no size: nothing is filtered */

static struct lom_wave_shift shift_at(const struct lom_waves_uniform *waves, double x, double z)
{
    return lom_displace(waves, lom_splat((float)x), lom_splat((float)z), &point);
}

static double difference(lom_float after, lom_float before, double step)
{
    return ((double)after[0] - before[0]) / (2 * step);
}

static bool near(double a, double b, double bound)
{
    return a - b < bound && b - a < bound;
}

static void slopes_are_derivatives_of_the_displacement(void)
{
    struct lom_waves_uniform waves = waves_at(0.8, 0.7, 12, 3.5);
    double step = 1.0 / 64;
    for (int i = 0; i < 200; i++) {
        double x = 0.37 * i - 20, z = 11 - 0.21 * i;
        struct lom_wave_slopes s = lom_find_slopes(&waves, lom_splat((float)x), lom_splat((float)z), &point);
        struct lom_wave_shift e = shift_at(&waves, x + step, z), w = shift_at(&waves, x - step, z);
        struct lom_wave_shift n = shift_at(&waves, x, z + step), b = shift_at(&waves, x, z - step);
        CHECK(near(difference(e.h, w.h, step), s.sx[0], 2e-3), "sx %g", s.sx[0]);
        CHECK(near(difference(n.h, b.h, step), s.sz[0], 2e-3), "sz %g", s.sz[0]);
        CHECK(near(difference(e.dx, w.dx, step), s.xx[0], 2e-3), "xx %g", s.xx[0]);
        CHECK(near(difference(n.dz, b.dz, step), s.zz[0], 2e-3), "zz %g", s.zz[0]);
        CHECK(near(difference(n.dx, b.dx, step), s.xz[0], 2e-3), "xz %g", s.xz[0]);
        CHECK(near(difference(e.dz, w.dz, step), s.xz[0], 2e-3), "zx %g", s.xz[0]);
        lom_float3 normal = lom_wave_normal(&s);
        CHECK(near(lom_dot3(normal, normal)[0], 1, 1e-6) && normal.y[0] > 0, "normal %g", normal.y[0]);
    }
}

/* Footprints of nothing, of single waves and of all of them, which leave some of the waves. */
static void found_together_or_apart_waves_are_the_same(void)
{
    struct lom_waves_uniform waves = waves_at(0.8, 0.7, 12, 3.5);
    waves.foam_threshold = 0.9f;
    waves.foam_window = 2;
    for (int i = 0; i < 400; i++) {
        lom_float x = lom_splat(0.37f * (float)i - 20), z = lom_splat(11 - 0.21f * (float)i);
        lom_float size = lom_splat(0.05f * (float)(i % 200)), zero = { 0 };
        struct lom_footprint f = { size, zero, zero, size };
        struct lom_wave_shift p = lom_displace(&waves, x, z, &f), q;
        struct lom_wave_slopes s = lom_find_slopes(&waves, x, z, &f), w;
        LOM_WIDE(lom_find_waves_lanes)(&waves, &x, &z, &f, &q, &w);
        CHECK(memcmp(&p, &q, sizeof p) == 0, "another place of %d", i);
        CHECK(memcmp(&s, &w, sizeof s) == 0, "other slopes of %d", i);
    }
}

/* W1: absurd heights; the Jacobian may touch 0 and no more. */
static void w1_crests_never_loop(void)
{
    static const double heights[] = { 0.1, 1, 10, 100 };
    for (size_t k = 0; k < sizeof heights / sizeof heights[0]; k++)
        for (int count = 1; count <= LOM_MAX_WAVES; count += 21) {
            struct lom_waves_uniform waves = waves_at(heights[k], 1, count, 1);
            for (int i = 0; i < 2000; i++) {
                struct lom_wave_slopes s =
                    lom_find_slopes(&waves, lom_splat(0.05f * (float)i), lom_splat(0.031f * (float)i), &point);
                double jacobian = (1.0 + s.xx[0]) * (1.0 + s.zz[0]) - (double)s.xz[0] * s.xz[0];
                CHECK(jacobian > -1e-5, "height %g: a loop, Jacobian %g", heights[k], jacobian);
                lom_float3 normal = lom_wave_normal(&s);
                CHECK(near(lom_dot3(normal, normal)[0], 1, 1e-6), "a normal of length %g", lom_dot3(normal, normal)[0]);
            }
        }
}

/* W3: foam is a share at any steepness, none where no crest breaks, and some where they do. */
static void w3_foam_is_a_share(void)
{
    for (int k = 0; k < 2; k++) {
        struct lom_waves_uniform waves;
        lom_water_params water = parameters(k == 0 ? 0.05 : 100, k == 0 ? 0.1 : 1, 21);
        memset(&waves, 0, sizeof waves);
        water.foam = (lom_water_foam){ .amount = 1, .threshold = 0.7, .window = 2 };
        lom_fill_trochoids(&waves, &water.waves, &water.foam, (double[2]){ 0, 0 }, 1);
        int foaming = 0;
        for (int i = 0; i < 2000; i++) {
            float foam =
                lom_find_slopes(&waves, lom_splat(0.05f * (float)i), lom_splat(0.031f * (float)i), &point).foam[0];
            CHECK(foam >= 0 && foam <= 1, "foam %g", foam);
            foaming += foam > 0;
        }
        CHECK(k == 0 ? foaming == 0 : foaming > 0, "%d points of %s waves foam", foaming, k == 0 ? "gentle" : "steep");
    }
}

/* Where the sum of their steepnesses keeps the Jacobian over the threshold no trochoid is asked, and none would have broken. */
static void what_cannot_break_is_not_asked(void)
{
    int asked = 0, spared = 0;
    for (int k = 0; k < 40; k++) {
        lom_water_params water = parameters(0.02 + 0.4 * (k % 8), 0.1 + 0.9 * (k % 5) / 4, 1 + k);
        struct lom_waves_uniform waves;
        memset(&waves, 0, sizeof waves);
        water.foam = (lom_water_foam){ .amount = 1, .threshold = 0.05 + 0.023 * k, .window = 2 };
        lom_fill_trochoids(&waves, &water.waves, &water.foam, (double[2]){ 0, 0 }, 1);
        asked += waves.foam_threshold > 0;
        if (waves.foam_threshold > 0)
            continue;
        spared++;
        waves.foam_threshold = (float)water.foam.threshold;
        for (int i = 0; i < 2000; i++) {
            lom_float x = 0.05f * (float)i + 0.3f * lom_to_float(lom_lane_index());
            lom_float foam = lom_find_slopes(&waves, x, lom_splat(0.031f * (float)i), &point).foam, none = { 0 };
            CHECK(memcmp(&foam, &none, sizeof foam) == 0, "waves %d foam at %d", k, i);
        }
    }
    CHECK(asked > 5 && spared > 5, "%d waves may break, %d cannot", asked, spared);
}

/* Foam is what broke at the moments of its window: the Jacobians of the same trochoids in double, at those times. */
static void foam_is_that_of_its_moments(void)
{
    lom_water_params water = parameters(3, 1, 21);
    lom_trochoid trochoids[LOM_MAX_WAVES];
    lom_error error = { 0 };
    struct lom_waves_uniform waves;
    const double time = 12.25, threshold = 0.9, window = 2.5;
    double largest = 0;
    memset(&waves, 0, sizeof waves);
    water.foam = (lom_water_foam){ .amount = 1, .threshold = threshold, .window = window };
    lom_fill_trochoids(&waves, &water.waves, &water.foam, (double[2]){ 0, 0 }, time);
    int count = lom_make_trochoids(&water.waves, trochoids, NULL, &error);
    for (int i = 0; i < 500; i++) {
        double x = 0.05 * i - 11, z = 7 - 0.031 * i, exact = 0;
        for (int m = 0; m < LOM_FOAM_MOMENTS; m++) {
            double j = lom_trochoids_at(trochoids, count, x, z, time - window * m / LOM_FOAM_MOMENTS).jacobian;
            double below = (threshold - j) * 4, share = below < 0 ? 0 : below > 1 ? 1 : below;
            double faded = share * (1 - (double)m / LOM_FOAM_MOMENTS);
            exact = faded > exact ? faded : exact;
        }
        float foam = lom_find_slopes(&waves, lom_splat((float)x), lom_splat((float)z), &point).foam[LOM_LANES - 1];
        double off = foam > exact ? foam - exact : exact - foam;
        largest = exact > largest ? exact : largest;
        CHECK(off < 1e-4, "at %g %g: %g, not %g", x, z, foam, exact);
    }
    CHECK(largest > 0.5, "nothing breaks: %g", largest);
}

static void w2_no_height_is_flat(void)
{
    struct lom_waves_uniform waves = waves_at(0, 1, 8, 5);
    struct lom_wave_shift s = shift_at(&waves, 3, 4);
    CHECK(waves.trochoid_count == 0 && s.h[0] == 0 && s.dx[0] == 0, "%d waves of no height", waves.trochoid_count);
    CHECK(waves.highest == 0 && waves.reach == 0, "bounds of nothing");
}

/* The mean square slope of the surface, seen or filtered away, is the same from every distance. */
static void filtered_slopes_become_variance(void)
{
    struct lom_waves_uniform waves = waves_at(0.5, 0, 10, 0);
    double all = 0;
    for (int i = 0; i < waves.trochoid_count; i++) {
        double k = waves.trochoid[i].kx, m = waves.trochoid[i].kz, a = waves.trochoid[i].amplitude;
        all += (k * k + m * m) * a * a / 2;
    }
    for (double size = 0.01; size < 100; size *= 1.7) {
        struct lom_footprint f = { lom_splat((float)size), { 0 }, { 0 }, lom_splat((float)size) };
        double seen = 0, hidden = 0;
        enum { SAMPLES = 6000 };
        for (int i = 0; i < SAMPLES; i++) {
            float x = (float)(4000 * lom_random_uniform(1, 2 * (uint64_t)i));
            float z = (float)(4000 * lom_random_uniform(1, 2 * (uint64_t)i + 1));
            struct lom_wave_slopes s = lom_find_slopes(&waves, lom_splat(x), lom_splat(z), &f);
            seen += ((double)s.sx[0] * s.sx[0] + (double)s.sz[0] * s.sz[0]) / SAMPLES;
            hidden = (double)s.vxx[0] + s.vzz[0];
        }
        CHECK(near(seen + hidden, all, 0.05 * all), "size %g: %g seen + %g hidden, not %g", size, seen, hidden, all);
        CHECK(size < 30 || near(hidden, all, 1e-5), "from far away %g of %g is hidden", hidden, all);
    }
}

/* After 10^7 seconds the phase is that of double arithmetic, and time runs: a wave travels along its direction. */
static void phases_are_exact_after_years(void)
{
    struct lom_waves_uniform late = waves_at(0.5, 0.5, 6, 1e7), start = waves_at(0.5, 0.5, 6, 0);
    for (int i = 0; i < 6; i++) {
        const struct lom_trochoid_uniform *t = &late.trochoid[i];
        double k = lom_double_sqrt((double)t->kx * t->kx + (double)t->kz * t->kz);
        CHECK(t->phase >= -3.1415930f && t->phase <= 3.1415930f, "phase %g", t->phase);
        struct lom_waves_uniform next = waves_at(0.5, 0.5, 6, 0.01);
        double moved = (double)next.trochoid[i].phase - start.trochoid[i].phase;
        moved -= 6.283185307179586 * lom_double_floor(moved / 6.283185307179586 + 0.5);
        CHECK(near(moved, -0.01 * lom_double_sqrt(9.80665 * k), 1e-5), "moved by %g", moved);
    }
}

static void bounds_and_height_hold(void)
{
    struct lom_waves_uniform waves = waves_at(2, 1, 16, 40);
    for (int i = 0; i < 3000; i++) {
        struct lom_wave_shift s = shift_at(&waves, 0.31 * i, -0.17 * i);
        CHECK(s.h[0] <= waves.highest && s.h[0] >= waves.lowest, "height %g", s.h[0]);
        CHECK(s.dx[0] * s.dx[0] + s.dz[0] * s.dz[0] <= waves.reach * waves.reach, "shift %g %g", s.dx[0], s.dz[0]);
    }
    struct lom_waves_uniform gentle = waves_at(0.3, 0.5, 8, 4);
    struct lom_wave_shift s = shift_at(&gentle, 5, 6);
    double over = lom_trochoid_height(&gentle, 5.0 + (double)s.dx[0], 6.0 + (double)s.dz[0]);
    CHECK(near(over, s.h[0], 1e-4), "over the point %g, at rest %g", over, s.h[0]);
}

/* The mesh of a view: rings go outwards to the far corner, a full circle closes on itself, and it is a function of the
 * camera that asks for no more than its limits. */
static void the_mesh_closes_and_reaches_the_corners(void)
{
    static const double pitches[] = { 0, -0.5, -1.5, 1.2 };
    struct lom_polar_mesh mesh = { .rings = 0 };
    for (size_t i = 0; i < sizeof pitches / sizeof pitches[0]; i++) {
        lom_vec3 eye = { 10, 3, -20 };
        lom_vec3 target = { 10 + lom_double_cos(pitches[i]), 3 + lom_double_sin(pitches[i]), -20 };
        struct lom_polar_mesh_desc desc = { .projection = lom_perspective(0.8, 1.6, 0.1),
                                            .view = lom_look_at(eye, target, (lom_vec3){ 0, 1, 0 }),
                                            .level = -eye.y,
                                            .near_plane = 0.1,
                                            .lowest = -1,
                                            .highest = 1,
                                            .reach = 0.8,
                                            .quad = { -5000, -5000, 5000, 5000 },
                                            .cell = 6,
                                            .pixel_angle = 0.001 };
        lom_error error = { 0 };
        CHECK(lom_fill_polar_mesh(&mesh, &desc, &error), "%s", error.text);
        CHECK(mesh.radius[0] == 0 && mesh.radius[mesh.rings - 1] > 7000, "from %g to %g", mesh.radius[0],
              mesh.radius[mesh.rings - 1]);
        for (int r = 1; r < mesh.rings; r++)
            CHECK(mesh.radius[r] > mesh.radius[r - 1], "ring %d is not outside the one before", r);
        int last = mesh.columns - 1;
        bool whole = pitches[i] < -1 || pitches[i] > 1;
        CHECK(whole == (mesh.cosine[0] == mesh.cosine[last] && mesh.sine[0] == mesh.sine[last]), "pitch %g: the seam",
              pitches[i]);
        CHECK(mesh.index_count == (size_t)(mesh.rings - 1) * (size_t)last * 6, "%zu indices", mesh.index_count);
        for (size_t k = 0; k < mesh.index_count; k += 997)
            CHECK(mesh.indices[k] < (uint32_t)(mesh.rings * mesh.columns), "index %u", mesh.indices[k]);
    }
    lom_free_polar_mesh(&mesh);
}

static bool is_on_edge(const double quad[4], double x, double z)
{
    bool inside = x >= quad[0] - 0.01 && x <= quad[2] + 0.01 && z >= quad[1] - 0.01 && z <= quad[3] + 0.01;
    return inside &&
           (near(x, quad[0], 0.01) || near(x, quad[2], 0.01) || near(z, quad[1], 0.01) || near(z, quad[3], 0.01));
}

static void find_end(const struct lom_polar_mesh *mesh, int column, float radius, double out[2])
{
    out[0] = mesh->apex[0] + (double)radius * mesh->cosine[column];
    out[1] = mesh->apex[1] + (double)radius * mesh->sine[column];
}

/* Rings of calm water are kilometres apart. The outermost one is the edge of the quad all the same, corners and all:
 * also halfway between two columns. So is the innermost one where the eye is outside of the quad. */
static void the_outline_is_that_of_the_quad(void)
{
    static const double quads[][4] = {
        { -3000, -3000, 3000, 3000 }, { -40, -2000, 2500, 35 }, { 200, -150, 500, 100 }, { 50, 300, 350, 2000 }
    };
    struct lom_polar_mesh mesh = { .rings = 0 };
    for (size_t i = 0; i < sizeof quads / sizeof quads[0]; i++) {
        struct lom_polar_mesh_desc desc = { .projection = lom_perspective(1.2, 1.6, 0.1),
                                            .view = lom_look_at((lom_vec3){ 0, 3, 0 }, (lom_vec3){ 1, 3, 0.3 },
                                                                (lom_vec3){ 0, 1, 0 }),
                                            .level = -3,
                                            .near_plane = 0.1,
                                            .cell = 6,
                                            .pixel_angle = 0.001 };
        lom_error error = { 0 };
        memcpy(desc.quad, quads[i], sizeof desc.quad);
        CHECK(lom_fill_polar_mesh(&mesh, &desc, &error), "%s", error.text);
        int seen = 0;
        for (int c = 0; c + 1 < mesh.columns; c++) {
            double a[2], b[2];
            find_end(&mesh, c, mesh.farthest[c], a);
            find_end(&mesh, c + 1, mesh.farthest[c + 1], b);
            if (!(mesh.nearest[c] < mesh.farthest[c]) || !(mesh.nearest[c + 1] < mesh.farthest[c + 1]))
                continue; /* beside the quad */
            seen++;
            CHECK(mesh.farthest[c] <= mesh.radius[mesh.rings - 1], "quad %zu: no ring is at the end of column %d", i,
                  c);
            CHECK(is_on_edge(desc.quad, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2), "quad %zu: column %d cuts a corner", i,
                  c);
            find_end(&mesh, c, mesh.nearest[c], a);
            CHECK(mesh.nearest[c] == 0 || is_on_edge(desc.quad, a[0], a[1]), "quad %zu: column %d begins within", i, c);
        }
        CHECK(seen > 30, "quad %zu: %d columns are in it", i, seen);
    }
    lom_free_polar_mesh(&mesh);
}

/* Rings that are not submitted: no point of theirs, at any height and shift of the waves, is in the view; many are left
 * out of a view of the horizon, none of one that sees what is below the eye. */
static void rings_that_are_left_out_are_not_seen(void)
{
    static const double pitches[] = { 0.1, 0, -0.2, -0.6, -1.5 };
    struct lom_polar_mesh mesh = { .rings = 0 };
    for (size_t i = 0; i < sizeof pitches / sizeof pitches[0]; i++) {
        const lom_vec3 eye = { 0, 0, 0 }, up = { 0, 1, 0 },
                       to = { lom_double_cos(pitches[i]), lom_double_sin(pitches[i]), 0.4 };
        struct lom_polar_mesh_desc desc = { .projection = lom_perspective(0.8, 1.6, 0.1),
                                            .view = lom_look_at(eye, to, up),
                                            .level = -6,
                                            .near_plane = 0.1,
                                            .lowest = -1,
                                            .highest = 1.5,
                                            .reach = 0.8,
                                            .quad = { -900, -900, 900, 900 },
                                            .cell = 6,
                                            .pixel_angle = 0.001 };
        lom_error error = { 0 };
        lom_mat4 clip = lom_multiply(&desc.projection, &desc.view);
        lom_frustum frustum = lom_view_frustum(&clip, false);
        CHECK(lom_fill_polar_mesh(&mesh, &desc, &error), "%s", error.text);
        int first = lom_first_seen_ring(&mesh, &desc, &frustum);
        for (int k = 0; k < 20000 && first > 0; k++) {
            double r = (double)mesh.radius[first] * lom_random_uniform(3, (uint64_t)k), turn = 6.2831853 * k / 20000;
            double x = mesh.apex[0] + r * lom_double_cos(turn), z = mesh.apex[1] + r * lom_double_sin(turn);
            double y = desc.level + (k % 2 != 0 ? desc.highest : desc.lowest);
            lom_vec3 low = { x - 0.5, y, z - 0.5 }, high = { x + 0.5, y, z + 0.5 };
            CHECK(lom_box_visibility(&frustum, (lom_box){ low, high }) == LOM_OUTSIDE,
                  "pitch %g: %g %g %g is seen, ring %d is the first", pitches[i], x, y, z, first);
        }
        CHECK(pitches[i] < -1 ? first == 0 : pitches[i] < -0.5 || first > mesh.rings / 20,
              "pitch %g: the first of %d is %d", pitches[i], mesh.rings, first);
    }
    lom_free_polar_mesh(&mesh);
}

/* Waves grow and fall, and cells change: what is kept of the mesh of the frame before shows nowhere. */
static void a_mesh_is_that_of_its_frame_alone(void)
{
    static const double heights[] = { 1, 0.2, 3, 3.1, 0.2, 2, 2 }, cells[] = { 6, 6, 6, 6, 9, 9, 6 };
    const lom_vec3 eye = { 0, 3, 0 }, target = { 1, 3, 0 };
    struct lom_polar_mesh kept = { .rings = 0 };
    for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++) {
        struct lom_polar_mesh_desc desc = { .projection = lom_perspective(0.8, 1.6, 0.1),
                                            .view = lom_look_at(eye, target, (lom_vec3){ 0, 1, 0 }),
                                            .level = -eye.y,
                                            .near_plane = 0.1,
                                            .lowest = -heights[i],
                                            .highest = heights[i],
                                            .quad = { -500, -500, 500, 500 },
                                            .cell = cells[i],
                                            .pixel_angle = 0.001 };
        struct lom_polar_mesh alone = { .rings = 0 };
        lom_error error = { 0 };
        CHECK(lom_fill_polar_mesh(&kept, &desc, &error) && lom_fill_polar_mesh(&alone, &desc, &error), "%s",
              error.text);
        size_t indices = alone.index_count * sizeof *alone.indices;
        CHECK(kept.index_count == alone.index_count && memcmp(kept.indices, alone.indices, indices) == 0 &&
                  memcmp(kept.radius, alone.radius, (size_t)alone.rings * sizeof *alone.radius) == 0,
              "mesh %zu: %d rings of %d after others, %d of %d alone", i, kept.rings, kept.columns, alone.rings,
              alone.columns);
        lom_free_polar_mesh(&alone);
    }
    lom_free_polar_mesh(&kept);
}

int main(int argc, char **argv)
{
    RUN(slopes_are_derivatives_of_the_displacement);
    RUN(found_together_or_apart_waves_are_the_same);
    RUN(w1_crests_never_loop);
    RUN(w3_foam_is_a_share);
    RUN(what_cannot_break_is_not_asked);
    RUN(foam_is_that_of_its_moments);
    RUN(w2_no_height_is_flat);
    RUN(filtered_slopes_become_variance);
    RUN(phases_are_exact_after_years);
    RUN(bounds_and_height_hold);
    RUN(the_mesh_closes_and_reaches_the_corners);
    RUN(the_outline_is_that_of_the_quad);
    RUN(rings_that_are_left_out_are_not_seen);
    RUN(a_mesh_is_that_of_its_frame_alone);
    return check_result();
}
