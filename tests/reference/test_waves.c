/* Proves the surface with waves that rays meet: a sine's places and normals, no gaps below or above, the height at a
 * place, ripples of the stated slope. */
#include "check.h"
#include "rough_water.h"
#include "reference/wave_surface.h"
#include "scene_files.h"

static lom_scene *scene;
static lom_reference *reference;
static struct lom_wave_surface surface;
static const lom_vec3 eye = { 3, 4, 1 };

static bool open_waves(const char *text)
{
    scene = make_scene(text);
    reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    bool done = reference != NULL && lom_make_wave_surface(&surface, reference, eye, 2.5, NULL);
    CHECK(done && surface.triangles != NULL);
    return done;
}

static void close_waves(void)
{
    lom_free_wave_surface(&surface);
    lom_free_reference(reference);
    lom_free_scene(scene);
}

static lom_vec3 downwards(uint64_t i)
{
    return unit(
        (lom_vec3){ lom_random_uniform(1, i) - 0.5, -0.05 - lom_random_uniform(2, i), lom_random_uniform(3, i) - 0.5 });
}

/* One wave without horizontal displacement: y = level + a cos(k x + phase). Chords of a twelfth of its length are off
 * by at most a (1 - cos(pi / 12)); the normals are interpolated from nothing but the places at rest. */
static void a_sine_lies_where_it_should(void)
{
    if (!open_waves("[water]\nlevel = 0.5\nsize = 200\n[water.waves]\nkind = \"gerstner\"\ncount = 1\nsteepness = 0\n"
                    "spread = 0\ndirection = 30\nlength = [3, 3]\nheight = 0.6\n"))
        return;
    const struct lom_ray_wave *w = &surface.wave[0];
    CHECK(surface.count == 1 && w->across_x == 0);
    CHECK(__builtin_fabs(w->amplitude - 0.6 / 4 * lom_double_sqrt(2)) < 1e-6); /* 4 standard deviations are 0.6 m */
    for (uint64_t i = 0; i < 400; i++) {
        struct lom_ray ray = { eye, downwards(i) };
        struct lom_crossing c;
        bool hit = lom_hit_wave_surface(&surface, &ray, false, 0, 1e300, &c);
        CHECK(hit, "ray %d", (int)i);
        if (!hit)
            continue;
        double t = w->kx * c.place.x + w->kz * c.place.z + w->phase;
        CHECK(__builtin_fabs(c.place.y - 0.5 - w->amplitude * lom_double_cos(t)) < 0.035 * w->amplitude);
        double slope = -w->amplitude * lom_double_sin(t);
        lom_vec3 normal = unit((lom_vec3){ -slope * w->kx, 1, -slope * w->kz });
        CHECK(length(difference(normal, lom_wave_surface_normal(&surface, c.rest, 0))) < 1e-9 &&
              dot(c.facet, normal) > 0.98);
        CHECK(length(difference(along(eye, ray.direction, c.t), c.place)) < 1e-9);
    }
    close_waves();
}

/* Steep waves from many: every ray from above meets them first from above, from below first from below, and the height
 * at the place that is met is the place's own. */
static void steep_waves_have_no_gap(void)
{
    if (!open_waves("[water]\nsize = 300\n[water.waves]\nkind = \"gerstner\"\nheight = 0.5\nsteepness = 0.9\n"))
        return;
    for (uint64_t i = 0; i < 400; i++) {
        struct lom_ray down = { eye, downwards(i) }, up = { { 3, -4, 1 }, scaled(downwards(i), -1) };
        struct lom_crossing c;
        CHECK(lom_hit_wave_surface(&surface, &down, false, 0, 1e300, &c), "ray %d", (int)i);
        CHECK(lom_wave_surface_normal(&surface, c.rest, 0).y > 0 &&
              __builtin_fabs(lom_wave_surface_height(&surface, c.place.x, c.place.z) - c.place.y) < 0.01);
        CHECK(lom_hit_wave_surface(&surface, &up, true, 0, 1e300, &c) && c.facet.y > 0);
        CHECK(!lom_hit_wave_surface(&surface, &up, false, 0, c.t, &c));
    }
    close_waves();
}

/* A sea of one cascade: at its samples the surface is the direct sum of its waves, between them it is met by rays
 * from above and below without a gap, at its own height. */
static void a_sea_lies_where_its_waves_do(void)
{
    if (!open_waves("[water]\nsize = 200\n[water.waves]\nkind = \"sea\"\nwind_speed = 6\nsize = 64\ncascades = "
                    "1\npatch = 90\n"))
        return;
    lom_sea_moment *moment = lom_freeze_sea(surface.sea, 2.5, NULL);
    const lom_sea_cascade *c = &surface.cascade[0];
    CHECK(surface.cascade_count == 1 && c->size == 64 && moment != NULL);
    for (int i = 0; i < 300; i++) {
        double x = c->length * (i * 7 - 900) / c->size, z = c->length * (i * 11 - 1500) / c->size;
        struct lom_wave_place p = { .dx = 0 };
        lom_add_sea(&p, &surface, x, z);
        lom_sea_point q = lom_evaluate_sea(moment, 0, x, z);
        const double got[8] = { p.dx, p.dy, p.dz, p.sx, p.sz, p.xx, p.xz, p.zz };
        const double sum[8] = { q.dx, q.h, q.dz, q.sx, q.sz, q.xx, q.xz, q.zz };
        for (int k = 0; k < 8; k++)
            CHECK(__builtin_fabs(got[k] - sum[k]) < 2e-4, "sample %d, field %d: %g, not %g", i, k, got[k], sum[k]);
    }
    for (uint64_t i = 0; i < 400; i++) {
        struct lom_ray down = { eye, downwards(i) }, up = { { 3, -4, 1 }, scaled(downwards(i), -1) };
        struct lom_crossing at;
        CHECK(lom_hit_wave_surface(&surface, &down, false, 0, 1e300, &at), "ray %d", (int)i);
        double height = lom_wave_surface_height(&surface, at.place.x, at.place.z);
        CHECK(at.normal.y > 0 && __builtin_fabs(height - at.place.y) < 0.02, "ray %d: %g, not %g", (int)i, at.place.y,
              height);
        CHECK(lom_hit_wave_surface(&surface, &up, true, 0, 1e300, &at) && at.facet.y > 0);
    }
    lom_free_sea_moment(moment);
    close_waves();
}

/* Choppy waves at the border of their quad: no triangle hangs there like a curtain, all face up as they lie at rest. */
static void the_border_has_no_curtain(void)
{
    if (!open_waves("[water]\nsize = 60\n[water.waves]\nkind = \"sea\"\nwind_speed = 9\nsize = 64\nchoppiness = 1.5\n"))
        return;
    CHECK(surface.above.count > 1000);
    for (uint32_t i = 0; i < surface.above.count; i++) {
        const uint32_t *corner = surface.triangles[i].corner;
        const double *p = surface.rest[corner[0]], *q = surface.rest[corner[1]], *r = surface.rest[corner[2]];
        CHECK((q[0] - p[0]) * (r[1] - p[1]) != (q[1] - p[1]) * (r[0] - p[0]), "triangle %d has no area", (int)i);
    }
    close_waves();
}

/* Still water has no such surface, and neither has a scene without water. */
static void still_water_is_no_mesh(void)
{
    static const char *const texts[] = { "water.level = 1\n", "sky.color = [1, 1, 1]\n",
                                         "[water]\n[water.waves]\nkind = \"gerstner\"\nheight = 0\n",
                                         "[water]\n[water.waves]\nkind = \"sea\"\nwind_speed = 0\n" };
    for (int i = 0; i < 4; i++) {
        scene = make_scene(texts[i]);
        reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
        CHECK(reference != NULL && lom_make_wave_surface(&surface, reference, eye, 0, NULL) &&
              surface.triangles == NULL);
        close_waves();
    }
}

/* The mean square slope of the ripples' normals is the roughness, and a place has its own. */
static void ripples_have_their_slope(void)
{
    scene = make_scene("[water]\nsize = 1000\n[water.optics]\nroughness = 0.01\n");
    reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    double mean[2] = { 0, 0 }, square = 0;
    enum { RAYS = 20000 };
    for (uint64_t i = 0; reference != NULL && i < RAYS; i++) {
        struct lom_ray ray = { eye, downwards(i) };
        struct lom_crossing c, again;
        CHECK(lom_cross_water(reference, &ray, 0, false, 0, 1e300, &c) &&
              lom_cross_water(reference, &ray, 9, false, 0, 1e300, &again) && c.normal.x == again.normal.x);
        double x = -c.normal.x / c.normal.y, z = -c.normal.z / c.normal.y;
        mean[0] += x / RAYS;
        mean[1] += z / RAYS;
        square += (x * x + z * z) / RAYS;
    }
    CHECK(__builtin_fabs(square - 0.01) < 4e-4 && __builtin_fabs(mean[0]) < 2e-3 && __builtin_fabs(mean[1]) < 2e-3,
          "%g", square);
    lom_free_reference(reference);
    lom_free_scene(scene);
}

/* Of ripples a ray meets those that face it, each by the area that it shows: what they mirror is the mean over the slopes
 * that are seen from there (tests/rough_water.h), however flat the ray comes in. */
static void ripples_mirror_as_they_are_seen(void)
{
    static const double rises[] = { 1, 0.3, 0.1, 0.03, 0.01 };
    const rough_water water = { 0.01, 0.01, 1.34 };
    scene = make_scene("[water]\nsize = 1e6\n[water.optics]\nroughness = 0.02\n");
    reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    for (int k = 0; reference != NULL && k < 5; k++) {
        enum { RAYS = 20000 };
        double share = 0, want = 0;
        for (int i = 0; i < RAYS; i++) {
            const lom_vec3 d = unit((lom_vec3){ 1, -rises[k], 0 });
            struct lom_ray ray = { { 0.37 * i, 1, -0.19 * i }, d };
            struct lom_crossing c;
            CHECK(lom_cross_water(reference, &ray, 0, false, 0, 1e300, &c) && dot(c.normal, d) < 0);
            share += lom_reference_fresnel(-dot(c.normal, d), water.index) / RAYS;
            want = i == 0 ? mean_reflectance(&water, (double[3]){ -d.x, -d.y, 0 }) : want;
        }
        CHECK(__builtin_fabs(share / want - 1) < 0.02, "rise %g: %g, not %g", rises[k], share, want);
    }
    lom_free_reference(reference);
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    RUN(a_sine_lies_where_it_should);
    RUN(steep_waves_have_no_gap);
    RUN(a_sea_lies_where_its_waves_do);
    RUN(the_border_has_no_curtain);
    RUN(still_water_is_no_mesh);
    RUN(ripples_have_their_slope);
    RUN(ripples_mirror_as_they_are_seen);
    return check_result();
}
