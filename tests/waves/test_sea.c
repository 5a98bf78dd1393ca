/* The sea's spectra integrate to what they should, its waves sum to what the definition says, at any time and on every
 * device, and bad descriptions are refused with a sentence. */
#include "check.h"

#include "waves/sea_desc.h"

static const double pi = 3.141592653589793;

static double absolute(double x)
{
    return x < 0 ? -x : x;
}

static lom_wave_spectrum spectrum_of(lom_sea_desc desc)
{
    lom_sea_desc resolved = { 0 };
    CHECK(lom_resolve_sea(&desc, &resolved, NULL), "refused");
    return lom_sea_spectrum(&resolved);
}

/* Of S over k by the midpoint rule in log k. */
static double variance_up_to(const lom_wave_spectrum *s, double end)
{
    double sum = 0, step = 0.002, last = lom_double_log(end);
    for (double e = -12; e < last; e += step) {
        double k = lom_double_exp(e + step / 2);
        sum += lom_spectrum_at(s, k) * k * step;
    }
    return sum;
}

static double variance_of(const lom_wave_spectrum *s)
{
    return variance_up_to(s, 3000);
}

/* m0 = a g^2 / (5 wp^4) for Pierson and Moskowitz; a V^4 / (4 g^2) for Phillips, by integration. */
static void spectra_integrate_to_their_closed_forms(void)
{
    lom_wave_spectrum pm = spectrum_of((lom_sea_desc){ .spectrum = LOM_SPECTRUM_PIERSON_MOSKOWITZ, .wind_speed = 10 });
    double g = 9.80665, p4 = pm.peak * pm.peak * pm.peak * pm.peak, wanted = 0.0081 * g * g / (5 * p4);
    CHECK(absolute(variance_of(&pm) / wanted - 1) < 1e-3, "%g not %g", variance_of(&pm), wanted);
    lom_wave_spectrum ph = spectrum_of((lom_sea_desc){ .spectrum = LOM_SPECTRUM_PHILLIPS, .wind_speed = 10 });
    wanted = 0.0081 * 1e4 / (4 * g * g);
    CHECK(absolute(variance_of(&ph) / wanted - 1) < 1e-3, "%g not %g", variance_of(&ph), wanted);
}

static void spreadings_integrate_to_one(void)
{
    for (int kind = LOM_SPREADING_COSINE_SQUARED; kind <= LOM_SPREADING_DONELAN_BANNER; kind++) {
        lom_wave_spectrum s = spectrum_of((lom_sea_desc){ .spreading = (lom_spreading_kind)kind });
        for (double k = 1e-3; k < 100; k *= 3) {
            double sum = 0;
            for (int i = 0; i < 2000; i++)
                sum += lom_spreading_at(&s, k, -pi + (i + 0.5) * pi / 1000) * pi / 1000;
            CHECK(absolute(sum - 1) < 1e-3, "spreading %d at k = %g: %g", kind, k, sum);
        }
    }
}

static void f8_f9_degenerate_spectra_are_zero_or_finite(void)
{
    for (int kind = 0; kind <= LOM_SPECTRUM_PHILLIPS; kind++) {
        lom_wave_spectrum s = spectrum_of((lom_sea_desc){ .spectrum = (lom_spectrum_kind)kind, .depth = 5 });
        CHECK(lom_directional_spectrum(&s, 0, 0) == 0 && lom_directional_spectrum(&s, 1e-6, 0) == 0, "kind %d", kind);
        double far = lom_directional_spectrum(&s, 1e6, 1e6);
        CHECK(far >= 0 && far < 1e-20, "kind %d: %g", kind, far);
        s.depth = 0;
        CHECK(lom_directional_spectrum(&s, 0.1, 0.1) == 0, "kind %d without depth", kind);
        s = spectrum_of((lom_sea_desc){ .spectrum = (lom_spectrum_kind)kind, .calm = true });
        CHECK(lom_directional_spectrum(&s, 0.1, 0.1) == 0, "kind %d without wind", kind);
    }
    lom_wave_spectrum least = spectrum_of((lom_sea_desc){ .fetch = 1 });
    CHECK(variance_of(&least) > 0 && variance_of(&least) < 1e-4, "a metre of fetch makes %g", variance_of(&least));
}

static void f9_gamma_one_is_pierson_moskowitz(void)
{
    lom_wave_spectrum j = spectrum_of((lom_sea_desc){ .fetch = 1e8, .peak_enhancement = 1 });
    lom_wave_spectrum pm = spectrum_of((lom_sea_desc){ .spectrum = LOM_SPECTRUM_PIERSON_MOSKOWITZ });
    for (double k = 1e-3; k < 100; k *= 2)
        CHECK(lom_spectrum_at(&j, k) == lom_spectrum_at(&pm, k), "at %g", k);
}

/* tanh by exp in long steps: both sides in double; 2 ulp. */
/* JONSWAP's width changes at the peak, where its boost is gamma for both: no step. Far from it the boost is 1, and
 * nothing overflows on the way there. */
static void f14_jonswap_has_no_step_at_its_peak(void)
{
    lom_wave_spectrum s = spectrum_of((lom_sea_desc){ .peak_enhancement = 3.3 });
    lom_wave_spectrum one = spectrum_of((lom_sea_desc){ .peak_enhancement = 1 });
    double peak = s.peak * s.peak / s.gravity;
    double below = lom_spectrum_at(&s, peak * (1 - 1e-9)), above = lom_spectrum_at(&s, peak * (1 + 1e-9));
    CHECK(absolute(below / above - 1) < 1e-7, "%g and %g", below, above);
    CHECK(absolute(above / lom_spectrum_at(&one, peak) - 3.3) < 1e-6, "boost %g", above / lom_spectrum_at(&one, peak));
    for (double factor = 1e-4; factor < 1e300; factor *= 7) {
        double value = lom_spectrum_at(&s, peak * factor), plain = lom_spectrum_at(&one, peak * factor);
        CHECK(value >= plain && value <= 3.3 * plain, "%g and %g at %g of the peak", value, plain, factor);
        CHECK(factor < 4 || value == plain, "boost at %g of the peak", factor);
    }
}

static void f11_dispersion(void)
{
    for (double k = 1e-6; k < 1e5; k *= 3.7)
        for (double d = 1e-3; d < 1e7; d *= 9.1) {
            double w = lom_dispersion(k, d, 9.80665), e = lom_double_expm1(-2 * k * d), t = -e / (2 + e);
            double wanted = lom_double_sqrt(9.80665 * k * t);
            CHECK(absolute(w - wanted) <= 2 * 0x1p-52 * wanted, "k %g, d %g: %a not %a", k, d, w, wanted);
        }
    CHECK(lom_dispersion(0, 1, 9.8) == 0 && lom_dispersion(1, 0, 9.8) == 0, "rest");
    CHECK(lom_dispersion(2, __builtin_inf(), 8) == 4, "deep water");
}

static const lom_sea_desc small_sea = { .spreading = LOM_SPREADING_DONELAN_BANNER,
                                        .wind_direction = 0.7,
                                        .cascade_count = 2,
                                        .seed = 5,
                                        .cascade = { { .size = 64 }, { .size = 32 } } };

static void check_point(const lom_sea_cascade *v, const lom_sea_moment *moment, int c, int x, int y, double scale)
{
    lom_sea_point p = lom_evaluate_sea(moment, c, x * v->length / v->size, y * v->length / v->size);
    size_t i = (size_t)(y * v->size + x);
    const float *d = v->displacement + 4 * i, *s = v->derivatives + 4 * i;
    double slopes = 2e-6 * 2 * pi * v->size / v->length * scale;
    CHECK(absolute(d[1] - p.h) < 2e-6 * scale && absolute(d[0] - p.dx) < 2e-6 * scale &&
              absolute(d[2] - p.dz) < 2e-6 * scale,
          "cascade %d (%d, %d): %g %g %g not %g %g %g", c, x, y, d[0], d[1], d[2], p.dx, p.h, p.dz);
    CHECK(absolute(s[0] - p.sx) < slopes && absolute(s[1] - p.sz) < slopes && absolute(s[2] - p.xx) < slopes &&
              absolute(s[3] - p.zz) < slopes && absolute(d[3] - p.xz) < slopes &&
              absolute(v->jacobian[i] - p.jacobian) < 4 * slopes,
          "cascade %d (%d, %d): %g %g %g %g %g, not %g %g %g %g %g", c, x, y, s[0], s[1], s[2], s[3], d[3], p.sx, p.sz,
          p.xx, p.zz, p.xz);
}

/* |h| <= sum of |h0(k)| + |h0(-k)| at any time, and |dx|, |dz| at most choppiness times that. Not for nothing: the sum
 * is no more than that of amplitudes, sqrt(2 waves) standard deviations (Cauchy and Schwarz) and a margin for luck. */
static void no_wave_passes_its_bound(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    lom_sea *sea = lom_create_sea(&small_sea, device, NULL);
    CHECK(sea != NULL, "no sea");
    for (int t = 0; sea != NULL && t < 50; t++) {
        CHECK(lom_advance_sea(sea, device, 7.31 * t * t, NULL), "no step");
        for (int c = 0; c < 2; c++) {
            lom_sea_cascade v = lom_view_cascade(sea, c);
            double choppiness = lom_describe_sea(sea)->choppiness, high = (double)v.highest, low = (double)v.lowest;
            CHECK(high <= v.bound && -low <= v.bound && (double)v.reach <= choppiness * v.bound, "cascade %d: %g", c,
                  v.bound);
            CHECK(v.bound < 1.3 * lom_double_sqrt(2 * v.waves * v.height_variance), "cascade %d: %g", c, v.bound);
        }
    }
    lom_free_sea(sea);
    lom_close_device(device);
}

/* Places first and the rest after them: the bytes of one step. */
static void a_step_in_two_parts_is_one_step(void)
{
    const unsigned places = LOM_SEA_HEIGHT | LOM_SEA_DISPLACEMENT;
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    lom_sea *one = lom_create_sea(&small_sea, device, NULL), *two = lom_create_sea(&small_sea, device, NULL);
    CHECK(one != NULL && two != NULL, "no sea");
    for (int c = 0; one != NULL && two != NULL && c < 2; c++) {
        CHECK(lom_advance_cascade(one, device, c, LOM_SEA_ALL, 3, NULL) &&
                  lom_advance_cascade(two, device, c, places, 3, NULL) &&
                  lom_advance_cascade(two, device, c, LOM_SEA_JACOBIAN, 2, NULL) &&
                  lom_advance_cascade(two, device, c, LOM_SEA_ALL & ~places, 3, NULL),
              "no step");
        lom_sea_cascade a = lom_view_cascade(one, c), b = lom_view_cascade(two, c);
        size_t count = (size_t)a.size * (size_t)a.size * sizeof(float);
        CHECK(memcmp(a.displacement, b.displacement, 4 * count) == 0 &&
                  memcmp(a.derivatives, b.derivatives, 4 * count) == 0 && memcmp(a.jacobian, b.jacobian, count) == 0,
              "cascade %d", c);
        CHECK(a.lowest == b.lowest && a.highest == b.highest && a.reach == b.reach, "cascade %d", c);
    }
    lom_free_sea(one);
    lom_free_sea(two);
    lom_close_device(device);
}

/* Far times and times before 0 as well: phases are reduced in double (F10). */
static void f10_every_field_is_the_direct_sum_at_any_time(void)
{
    static const double times[] = { 0, 1.5, -77.25, 1e5, 1e7 };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    lom_sea *sea = lom_create_sea(&small_sea, device, NULL);
    CHECK(sea != NULL, "no sea");
    for (int t = 0; sea != NULL && t < 5; t++) {
        lom_sea_moment *moment = lom_freeze_sea(sea, times[t], NULL);
        CHECK(lom_advance_sea(sea, device, times[t], NULL), "no step");
        for (int c = 0; c < 2; c++) {
            lom_sea_cascade v = lom_view_cascade(sea, c);
            for (int i = 0; i < 12; i++)
                check_point(&v, moment, c, i * 7 % v.size, i * 13 % v.size, lom_significant_height(sea));
        }
        lom_free_sea_moment(moment);
    }
    lom_free_sea(sea);
    lom_close_device(device);
}

static uint64_t hash_view(const lom_sea_cascade *v)
{
    size_t n = (size_t)v->size * (size_t)v->size;
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, v->displacement, n * 16);
    return lom_hash_bytes(lom_hash_bytes(hash, v->derivatives, n * 16), v->jacobian, n * 4);
}

static uint64_t hash_on(int threads, int lanes, bool plain, const double *times, int count)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = threads, .lanes = lanes, .plain = plain });
    lom_sea *sea = lom_create_sea(&small_sea, device, NULL);
    uint64_t hash = 0;
    for (int i = 0; sea != NULL && i < count; i++)
        lom_advance_sea(sea, device, times[i], NULL);
    for (int c = 0; sea != NULL && c < 2; c++) {
        lom_sea_cascade v = lom_view_cascade(sea, c);
        hash = hash * 31 + hash_view(&v);
    }
    lom_free_sea(sea);
    lom_close_device(device);
    return hash;
}

static void one_hash_on_every_device_in_any_order(void)
{
    static const double alone[] = { 12.5 }, after[] = { 900, -3, 12.5 };
    uint64_t first = hash_on(1, 4, false, alone, 1);
    CHECK(hash_on(1, 4, false, after, 3) == first, "after other times");
    for (int threads = 1; threads <= 3; threads++)
        for (int lanes = 4; lanes <= 16; lanes *= 2)
            for (int plain = 0; plain < 2; plain++)
                CHECK(hash_on(threads, lanes, plain != 0, alone, 1) == first, "%d threads, %d lanes", threads, lanes);
}

/* A field made alone has the bytes that it has among all. */
static void a_field_alone_is_the_same(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea *all = lom_create_sea(&small_sea, device, NULL), *one = lom_create_sea(&small_sea, device, NULL);
    lom_advance_sea(all, device, 3, NULL);
    for (unsigned field = 1; field <= LOM_SEA_JACOBIAN; field *= 2)
        lom_advance_cascade(one, device, 0, field, 3, NULL);
    lom_sea_cascade a = lom_view_cascade(all, 0), b = lom_view_cascade(one, 0);
    CHECK(hash_view(&a) == hash_view(&b), "fields differ");
    CHECK(a.lowest == b.lowest && a.highest == b.highest && a.reach == b.reach, "bounds differ");
    lom_free_sea(all);
    lom_free_sea(one);
    lom_close_device(device);
}

static void f7_patches_repeat_and_far_points_are_exact(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea *sea = lom_create_sea(&small_sea, device, NULL);
    lom_sea_moment *moment = lom_freeze_sea(sea, 2, NULL);
    lom_sea_cascade v = lom_view_cascade(sea, 0);
    double far = v.length * 16384; /* an exact multiple */
    for (int i = 0; i < 20; i++) {
        lom_sea_point a = lom_evaluate_sea(moment, 0, i * 1.75, i * 0.5);
        lom_sea_point b = lom_evaluate_sea(moment, 0, i * 1.75 + far, i * 0.5 - far);
        CHECK(absolute(a.h - b.h) < 1e-6 && absolute(a.sx - b.sx) < 1e-6, "%g and %g", a.h, b.h);
    }
    lom_free_sea_moment(moment);
    lom_free_sea(sea);
    lom_close_device(device);
}

/* Slopes and stretch are the derivatives of what they belong to. */
static void derivatives_are_derivatives(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea *sea = lom_create_sea(&small_sea, device, NULL);
    lom_sea_moment *m = lom_freeze_sea(sea, 2, NULL);
    double d = 1e-4;
    for (int i = 0; i < 20; i++) {
        double x = i * 3.1, z = i * -1.7;
        lom_sea_point p = lom_evaluate_sea(m, -1, x, z), e = lom_evaluate_sea(m, -1, x + d, z),
                      w = lom_evaluate_sea(m, -1, x - d, z), n = lom_evaluate_sea(m, -1, x, z + d),
                      s = lom_evaluate_sea(m, -1, x, z - d);
        CHECK(absolute((e.h - w.h) / (2 * d) - p.sx) < 1e-5 && absolute((n.h - s.h) / (2 * d) - p.sz) < 1e-5, "slope");
        CHECK(absolute((e.dx - w.dx) / (2 * d) - p.xx) < 1e-5 && absolute((n.dz - s.dz) / (2 * d) - p.zz) < 1e-5 &&
                  absolute((n.dx - s.dx) / (2 * d) - p.xz) < 1e-5 && absolute((e.dz - w.dz) / (2 * d) - p.xz) < 1e-5,
              "stretch");
    }
    lom_free_sea_moment(m);
    lom_free_sea(sea);
    lom_close_device(device);
}

/* Waves travel with the wind: correlation with the surface a little later is best a little downwind. */
static void waves_go_where_the_wind_blows(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea_desc desc = { .cascade_count = 1, .cascade = { { .size = 64 } } };
    lom_sea *sea = lom_create_sea(&desc, device, NULL);
    lom_sea_moment *now = lom_freeze_sea(sea, 0, NULL), *later = lom_freeze_sea(sea, 0.5, NULL);
    double with = 0, against = 0;
    for (int i = 0; i < 400; i++) {
        double x = i % 20 * 17.0, z = i / 20 * 17.0, h = lom_evaluate_sea(later, 0, x, z).h;
        with += h * lom_evaluate_sea(now, 0, x - 4, z).h;
        against += h * lom_evaluate_sea(now, 0, x + 4, z).h;
    }
    CHECK(with > 1.2 * against, "%g with the wind, %g against it", with, against);
    lom_free_sea_moment(now);
    lom_free_sea_moment(later);
    lom_free_sea(sea);
    lom_close_device(device);
}

/* The sum over the grid is the integral; over 64 seeds the mean square has a standard error that the waves tell. */
static void f12_hs_is_four_standard_deviations_over_64_seeds(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    double mean = 0, square = 0, expected = 0;
    for (uint64_t seed = 1; seed <= 64; seed++) {
        lom_sea_desc desc = { .seed = seed, .cascade_count = 1, .cascade = { { .size = 64, .length = 600 } } };
        lom_sea *sea = lom_create_sea(&desc, device, NULL);
        lom_advance_cascade(sea, device, 0, LOM_SEA_HEIGHT, 100, NULL);
        lom_sea_cascade v = lom_view_cascade(sea, 0);
        double sum = 0;
        for (int i = 0; i < 64 * 64; i++)
            sum += (double)v.displacement[4 * i + 1] * v.displacement[4 * i + 1] / (64 * 64);
        mean += sum / 64;
        square += sum * sum / 64;
        expected = v.height_variance;
        lom_free_sea(sea);
    }
    double error = lom_double_sqrt((square - mean * mean) / 63);
    CHECK(absolute(mean - expected) < 3 * error && error < 0.1 * expected, "%g +- %g, not %g", mean, error, expected);
    lom_wave_spectrum s = spectrum_of((lom_sea_desc){ 0 });
    double whole = variance_up_to(&s, 2 * pi / (2 * 600.0 / 64));
    CHECK(absolute(expected / whole - 1) < 0.03, "the grid has %g of %g", expected, whole);
    lom_close_device(device);
}

static void a_finer_grid_changes_no_wave(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea_desc desc = { .cascade_count = 1, .cascade = { { .size = 32, .length = 300, .shortest = 20 } } };
    lom_sea *coarse = lom_create_sea(&desc, device, NULL);
    desc.cascade[0].size = 64;
    lom_sea *fine = lom_create_sea(&desc, device, NULL);
    lom_advance_sea(coarse, device, 9, NULL);
    lom_advance_sea(fine, device, 9, NULL);
    lom_sea_cascade a = lom_view_cascade(coarse, 0), b = lom_view_cascade(fine, 0);
    CHECK(a.waves == b.waves && a.waves > 0, "%d and %d waves", a.waves, b.waves);
    for (int y = 0; y < 32; y++)
        for (int x = 0; x < 32; x++)
            CHECK(absolute(a.displacement[4 * (y * 32 + x) + 1] - b.displacement[4 * (2 * y * 64 + 2 * x) + 1]) < 1e-5,
                  "(%d, %d)", x, y);
    lom_free_sea(coarse);
    lom_free_sea(fine);
    lom_close_device(device);
}

/* Heights alone are the heights of the same sea, and nothing moves sideways. */
static void heights_alone_are_the_same_heights(void)
{
    lom_sea_desc desc = small_sea;
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea *both = lom_create_sea(&desc, device, NULL);
    desc.heights_only = true;
    lom_sea *heights = lom_create_sea(&desc, device, NULL);
    lom_advance_sea(both, device, 3, NULL);
    lom_advance_sea(heights, device, 3, NULL);
    lom_sea_cascade a = lom_view_cascade(both, 0), b = lom_view_cascade(heights, 0);
    bool moved = false;
    for (int i = 0; i < a.size * a.size; i++) {
        moved |= a.displacement[4 * i] != 0;
        CHECK(b.displacement[4 * i] == 0 && b.displacement[4 * i + 2] == 0 && b.jacobian[i] == 1, "sample %d moves", i);
        CHECK(absolute((double)a.displacement[4 * i + 1] - b.displacement[4 * i + 1]) < 1e-5, "height %d", i);
    }
    CHECK(moved && b.reach == 0, "nothing moves in either");
    lom_free_sea(both);
    lom_free_sea(heights);
    lom_close_device(device);
}

/* In a scene 0 is none: no wind, no heights, no choppiness. */
static void nothing_in_a_scene_is_nothing(void)
{
    lom_water_waves waves = {
        .kind = LOM_WAVES_SEA, .wind_speed = 9, .fetch = 1e5, .height_scale = 1, .choppiness = 1
    };
    lom_sea_desc desc = lom_scene_sea(&waves);
    CHECK(!desc.calm && !desc.heights_only && desc.choppiness == 1, "a sea");
    waves.choppiness = 0;
    desc = lom_scene_sea(&waves);
    CHECK(!desc.calm && desc.heights_only, "without choppiness");
    waves.height_scale = 0;
    desc = lom_scene_sea(&waves);
    CHECK(desc.calm && lom_resolve_sea(&desc, &desc, NULL), "without heights");
    waves.height_scale = 1;
    waves.wind_speed = 1e-9;
    desc = lom_scene_sea(&waves);
    CHECK(desc.calm && lom_resolve_sea(&desc, &desc, NULL), "without wind");
}

/* W3: a storm at four times its choppiness folds over, and where it does is a number. */
static void w3_folds_have_a_negative_jacobian(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea_desc desc = small_sea;
    desc.wind_speed = 25;
    desc.choppiness = 4;
    lom_sea *sea = lom_create_sea(&desc, device, NULL);
    lom_advance_sea(sea, device, 3, NULL);
    lom_sea_cascade v = lom_view_cascade(sea, 0);
    int folded = 0;
    for (int i = 0; i < v.size * v.size; i++) {
        folded += v.jacobian[i] < 0;
        CHECK(v.jacobian[i] > -1000 && v.jacobian[i] < 1000, "Jacobian %g", v.jacobian[i]);
    }
    CHECK(folded > 0 && folded < v.size * v.size / 2, "%d of %d samples fold", folded, v.size * v.size);
    lom_free_sea(sea);
    lom_close_device(device);
}

static void a_calm_sea_is_flat(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea_desc desc = { .wind_level = "calm", .cascade_count = 1, .cascade = { { .size = 16 } } };
    lom_sea *sea = lom_create_sea(&desc, device, NULL);
    CHECK(sea != NULL && lom_advance_sea(sea, device, 5, NULL), "no calm sea");
    lom_sea_cascade v = lom_view_cascade(sea, 0);
    for (int i = 0; i < 16 * 16; i++)
        CHECK(v.displacement[4 * i + 1] == 0 && v.jacobian[i] == 1, "sample %d", i);
    CHECK(lom_significant_height(sea) == 0 && v.waves == 0, "waves in calm air");
    lom_free_sea(sea);
    lom_close_device(device);
}

/* Levels of Beaufort's scale: 0.836 B^(3/2) m/s, and found by their names. */
static void wind_levels_are_beauforts(void)
{
    CHECK(lom_wind_level_count() == 13, "%d", lom_wind_level_count());
    CHECK(lom_wind_level_at(-1) == NULL && lom_wind_level_at(13) == NULL, "outside");
    for (int i = 0; i < 13; i++) {
        const lom_wind_level *level = lom_wind_level_at(i);
        double speed = 0.836 * lom_double_pow(i, 1.5);
        CHECK(level->beaufort == i && absolute(level->speed - speed) < 1e-3, "%s: %g, not %g", level->name,
              level->speed, speed);
        CHECK(lom_find_wind_level(level->name, NULL) == level && strlen(level->effect) > 5, "%s", level->name);
    }
    lom_error error = { 0 };
    CHECK(lom_find_wind_level("hurricanne", &error) == NULL && strstr(error.text, "did you mean \"hurricane\"") != NULL,
          "%s", error.text);
}

/* Waves of length l and shorter ones are damped by exp(-(k l / (2 pi))^2), and nothing else of the spectrum changes. */
static void short_waves_are_damped(void)
{
    lom_wave_spectrum whole = spectrum_of((lom_sea_desc){ .wind_speed = 12 });
    lom_wave_spectrum damped = spectrum_of((lom_sea_desc){ .wind_speed = 12, .shortest_wave = 3 });
    for (double k = 0.01; k < 10; k *= 1.5) {
        double part = k * 3 / (2 * pi), expected = lom_spectrum_at(&whole, k) * lom_double_exp(-part * part);
        CHECK(absolute(lom_spectrum_at(&damped, k) - expected) <= 1e-12 * expected, "at k = %g", k);
    }
}

static void bad_descriptions_are_refused(void)
{
    double nan = __builtin_nan(""), infinite = __builtin_inf();
    const lom_sea_desc bad[] = { { .wind_speed = nan },
                                 { .wind_speed = -1 },
                                 { .wind_speed = 1e4 },
                                 { .fetch = infinite },
                                 { .depth = -1 },
                                 { .depth = nan },
                                 { .peak_enhancement = 0.5 },
                                 { .choppiness = nan },
                                 { .gravity = -9 },
                                 { .wind_level = "breezy" },
                                 { .spectrum = (lom_spectrum_kind)9 },
                                 { .spreading = (lom_spreading_kind)9 },
                                 { .spreading = (lom_spreading_kind)-1 },
                                 { .cascade_count = 9 },
                                 { .cascade = { { .size = 100 } } },
                                 { .cascade = { { .size = 1 << 20 } } },
                                 { .cascade = { { .length = -4 } } },
                                 { .cascade = { { .shortest = nan } } },
                                 { .cascade = { { .shortest = 5 }, { .longest = 7 } } } };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        lom_error error = { 0 };
        lom_sea_desc resolved;
        CHECK(!lom_resolve_sea(&bad[i], &resolved, &error) && strlen(error.text) > 20, "case %zu", i);
    }
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_sea *sea = lom_create_sea(&small_sea, device, NULL);
    CHECK(!lom_advance_sea(sea, device, nan, NULL) && !lom_advance_sea(sea, device, 1e10, NULL), "time");
    CHECK(!lom_advance_cascade(sea, device, 2, LOM_SEA_ALL, 0, NULL), "cascade 2 of 2");
    CHECK(lom_view_cascade(sea, 2).waves == 0 && lom_view_cascade(sea, -1).waves == 0, "a view of cascade 2 of 2");
    CHECK(!lom_advance_cascade(sea, device, 0, 0, 0, NULL) &&
              !lom_advance_cascade(sea, device, 0, LOM_SEA_ALL + 1, 0, NULL),
          "fields that are none");
    CHECK(lom_freeze_sea(sea, nan, NULL) == NULL, "frozen at no time");
    lom_free_sea(sea);
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(spectra_integrate_to_their_closed_forms);
    RUN(spreadings_integrate_to_one);
    RUN(f8_f9_degenerate_spectra_are_zero_or_finite);
    RUN(f9_gamma_one_is_pierson_moskowitz);
    RUN(f11_dispersion);
    RUN(f14_jonswap_has_no_step_at_its_peak);
    RUN(no_wave_passes_its_bound);
    RUN(a_step_in_two_parts_is_one_step);
    RUN(f10_every_field_is_the_direct_sum_at_any_time);
    RUN(one_hash_on_every_device_in_any_order);
    RUN(a_field_alone_is_the_same);
    RUN(f7_patches_repeat_and_far_points_are_exact);
    RUN(derivatives_are_derivatives);
    RUN(waves_go_where_the_wind_blows);
    RUN(f12_hs_is_four_standard_deviations_over_64_seeds);
    RUN(a_finer_grid_changes_no_wave);
    RUN(heights_alone_are_the_same_heights);
    RUN(nothing_in_a_scene_is_nothing);
    RUN(w3_folds_have_a_negative_jacobian);
    RUN(a_calm_sea_is_flat);
    RUN(wind_levels_are_beauforts);
    RUN(short_waves_are_damped);
    RUN(bad_descriptions_are_refused);
    return check_result();
}
