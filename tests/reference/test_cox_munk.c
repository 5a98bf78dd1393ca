/* Proves the reference's far sea against the distribution of its slopes (tests/rough_water.h): at five winds of Cox and
 * Munk (1954) how much of an even sky it mirrors, from straight above to 5 degrees above the horizon, by the oracle's walk
 * of light from facet to facet, and how much of the sun and over how wide a glitter; and that rough water loses no light
 * and makes none. */
#include "check.h"
#include "rough_water.h"
#include "scene_files.h"

static const double degree = 0.017453292519943295, pi = 3.141592653589793;
static const double winds[] = { 2, 5, 8, 12, 15 };

static lom_scene *scene;
static lom_reference *reference;

static bool open_sea(const char *text)
{
    scene = make_scene(text);
    reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    CHECK(reference != NULL, "there is no reference");
    return reference != NULL;
}

static void close_sea(void)
{
    lom_free_reference(reference);
    lom_free_scene(scene);
}

static void set_slopes(const rough_water *w)
{
    lom_reference_water water = lom_get_reference_water(reference);
    water.roughness = w->up + w->cross;
    CHECK(lom_set_reference_water(reference, &water, NULL), "the roughness is refused");
}

/* What comes from the i-th of many places along the unit vector v. */
static lom_vec3 look(const double v[3], int i)
{
    const double x = 0.37 * i, z = 0.11 * i;
    return lom_trace_ray(reference, (lom_vec3){ x + 10 * v[0], 10 * v[1], z + 10 * v[2] },
                         (lom_vec3){ -v[0], -v[1], -v[2] }, 0, 0, 4);
}

static void the_sky_is_mirrored_as_the_slopes_say(void)
{
    static const int angles[] = { 0, 40, 60, 75, 85 };
    enum { RAYS = 40000, WALKS = 200000 };
    if (!open_sea("light.ambient = [0, 0, 0]\nlight.intensity = 0\nsky.color = [1, 1, 1]\n[water]\nsize = 1e6\n"
                  "[water.optics]\nindex = 1.34\nabsorption = [0.5, 0.5, 0]\nscatter = [0, 0, 0]\n"))
        return;
    double worst = 0;
    for (int k = 0; k < 25; k++) {
        const rough_water w = cox_munk_even(winds[k % 5]);
        const double v[3] = { sin(angles[k / 5] * degree), cos(angles[k / 5] * degree), 0 };
        double mirrored = 0;
        set_slopes(&w);
        for (int i = 0; i < RAYS; i++) {
            const lom_vec3 seen = look(v, i);
            mirrored += seen.x / RAYS;
            CHECK(fabs(seen.z - 1) < 1e-12, "%d degrees, wind %g: white light became %.17g", angles[k / 5],
                  winds[k % 5], seen.z);
        }
        const double off = mirrored / walked_sky(&w, v, WALKS) - 1;
        CHECK(fabs(off) < 0.01, "%d degrees, wind %g: %+.2f %%", angles[k / 5], winds[k % 5], 100 * off);
        worst = fabs(off) > worst ? fabs(off) : worst;
    }
    printf("  off by %.2f %% at most\n", 100 * worst);
    close_sea();
}

/* ---- the sun ---- */

enum { ACROSS = 24, DOWN = 18 };

/* Back along rays that go down by 30 to 90 degrees and up to 40 degrees to the side, the sun in the east. */
static void direction_of(int cell, double v[3])
{
    const double down = (30 + 60 * (cell / ACROSS + 0.5) / DOWN) * degree;
    const double side = (80 * (cell % ACROSS + 0.5) / ACROSS - 40) * degree;
    v[0] = -cos(down) * cos(side);
    v[1] = sin(down);
    v[2] = cos(down) * sin(side);
}

/* The sun is a disc of this radius: the mean over it, in rings of equal solid angle. */
static const double radius = 10, elevation = 60;

static double mirrored_disc(const rough_water *w, const double v[3])
{
    enum { RINGS = 8, TURNS = 24 };
    const double least = cos(radius * degree), s = sin(elevation * degree), c = cos(elevation * degree);
    double sum = 0;
    for (int i = 0; i < RINGS * TURNS; i++) {
        const double up = 1 - (1 - least) * (i / TURNS + 0.5) / RINGS, flat = sqrt(1 - up * up);
        const double a = flat * cos(2 * pi * i / TURNS), b = flat * sin(2 * pi * i / TURNS);
        const double l[3] = { c * up - s * a, s * up + c * a, b };
        sum += mirrored_light(w, v, l, true) / (RINGS * TURNS);
    }
    return sum * 2 * pi * (1 - least) / (sin(radius * degree) * sin(radius * degree));
}

/* Light, and the mean square of its slopes: of the facet that mirrors the middle of the sun. */
struct glitter {
    double light, slopes;
};

static void add_light(struct glitter *g, const double v[3], double light)
{
    const double h[3] = { v[0] + cos(elevation * degree), v[1] + sin(elevation * degree), v[2] };
    g->light += light;
    g->slopes += light * (h[0] * h[0] + h[2] * h[2]) / (h[1] * h[1]);
}

static void the_sun_glitters_as_the_slopes_say(void)
{
    enum { RAYS = 700 };
    if (!open_sea(
            "[light]\nazimuth = 90\nelevation = 60\ncolor = [1, 1, 1]\nintensity = 1\nambient = [0, 0, 0]\n[sky]\n"
            "color = [0, 0, 0]\n[water]\nsize = 1e6\n[water.optics]\nindex = 1.34\nabsorption = [1, 1, 1]\n"
            "scatter = [0, 0, 0]\n[quality]\nreference.sun = 10\n"))
        return;
    for (int k = 0; k < 5; k++) {
        const rough_water w = cox_munk_even(winds[k]);
        struct glitter want = { 0, 0 }, got = { 0, 0 };
        set_slopes(&w);
        for (int cell = 0; cell < ACROSS * DOWN; cell++) {
            double v[3], traced = 0;
            direction_of(cell, v);
            for (int i = 0; i < RAYS; i++)
                traced += look(v, cell * RAYS + i).x / RAYS;
            add_light(&got, v, traced);
            add_light(&want, v, mirrored_disc(&w, v));
        }
        const double light = got.light / want.light - 1;
        const double area = got.slopes / got.light / (want.slopes / want.light) - 1;
        CHECK(fabs(light) < 0.02, "wind %g: %+.2f %% of the light", winds[k], 100 * light);
        CHECK(fabs(area) < 0.02, "wind %g: %+.2f %% of the area", winds[k], 100 * area);
        printf("  wind %2g: light %+.2f %%, area %+.2f %%\n", winds[k], 100 * light, 100 * area);
    }
    close_sea();
}

int main(int argc, char **argv)
{
    if (!write_files())
        return 2;
    RUN(the_sky_is_mirrored_as_the_slopes_say);
    RUN(the_sun_glitters_as_the_slopes_say);
    remove_files();
    return check_result();
}
