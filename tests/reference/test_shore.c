/* Proves surf and shallow water as rays meet them, and scenes that move: places and slopes are those of the maps and
 * the cells, no ray passes between, water at rest is level, and a frame of a moving scene is that of one standing
 * there. */
#include "base/numbers.h"
#include "check.h"
#include "reference/wave_surface.h"
#include "scene_files.h"

static lom_scene *scene;
static lom_reference *reference;
static struct lom_wave_surface surface;
static const lom_vec3 eye = { 1, 5, 2 };

/* A round hill of 6 m in the middle of 80 m of terrain, 2 m of water around it. */
#define HILL                                                                                                           \
    "[terrain]\nheight_map = \"heights.png\"\nsize = [80, 80]\nheight = 6\nbase = -2\n[water]\nlevel = 0.5\n"          \
    "size = 70\n"
#define SURF "[surf]\nheight = 0.6\nperiod = 5\ndirection = 30\nvariation = 0.3\n"
#define POOL                                                                                                           \
    "[shallow]\nposition = [20, 15]\nsize = [24, 18]\ncells = 48\n[[shallow.body]]\nposition = [20, 14]\nhalf = 2\n"   \
    "draft = 0.8\n"

static bool open_shore(const char *text, double time)
{
    scene = make_scene(text);
    reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    bool done = reference != NULL && lom_make_wave_surface(&surface, reference, eye, time, NULL);
    CHECK(done && surface.triangles != NULL);
    return done && surface.triangles != NULL;
}

static void close_shore(void)
{
    lom_free_wave_surface(&surface);
    lom_free_reference(reference);
    lom_free_scene(scene);
}

/* Every ray from above meets the surface first from above, from below first from below; the place that is met is the
 * surface's own to `within`, and the normal is that of the heights around it. */
static void check_rays(double within)
{
    const double step = 1e-3;
    double most = 0;
    for (uint64_t i = 0; i < 400; i++) {
        lom_vec3 down = unit((lom_vec3){ 2 * lom_random_uniform(1, i) - 1, -0.3 - lom_random_uniform(2, i),
                                         2 * lom_random_uniform(3, i) - 1 });
        struct lom_ray above = { eye, down }, below = { { 1, -9, 2 }, { down.x, -down.y, down.z } };
        struct lom_crossing c, again;
        bool hit = lom_hit_wave_surface(&surface, &above, false, 0, 1e300, &c);
        CHECK(hit && lom_hit_wave_surface(&surface, &below, true, 0, 1e300, &again), "ray %d", (int)i);
        if (!hit)
            continue;
        double x = c.place.x, z = c.place.z, y = lom_wave_surface_height(&surface, x, z);
        CHECK(__builtin_fabs(y - c.place.y) < within, "ray %d: %g, not %g", (int)i, c.place.y, y);
        most = lom_larger(__builtin_fabs(y - surface.level), most);
        double sx = (lom_wave_surface_height(&surface, x + step, z) - y) / step;
        double sz = (lom_wave_surface_height(&surface, x, z + step) - y) / step;
        const lom_vec3 normal = lom_wave_surface_normal(&surface, c.rest, 0);
        CHECK(length(difference(normal, unit((lom_vec3){ -sx, 1, -sz }))) < 0.12, "ray %d: normal", (int)i);
    }
    CHECK(most > 0.05, "the water moves: %g", most);
}

static void surf_lies_where_its_maps_say(void)
{
    if (!open_shore(HILL SURF, 7.3))
        return;
    CHECK(surface.surf.cells != NULL && surface.shallow.first == NULL);
    struct lom_surf_uniform moment = { .time = 0 };
    lom_fill_surf(&moment, &surface.surf, &scene->surf, (double[2]){ 0, 0 }, 7.3);
    for (int i = 0; i < 200; i++) {
        double x = 60 * lom_random_uniform(4, (uint64_t)i) - 30, z = 60 * lom_random_uniform(5, (uint64_t)i) - 30;
        double height = lom_wave_surface_height(&surface, x, z), expected = 0.5;
        expected += lom_surf_height(&surface.surf, &moment, x, z);
        CHECK(height == expected, "%g, not %g", height, expected);
    }
    check_rays(0.01);
    close_shore();
}

static void shallow_water_lies_where_its_cells_do(void)
{
    if (!open_shore(HILL POOL, 0.9))
        return;
    CHECK(surface.surf.cells == NULL && surface.shallow.first != NULL);
    lom_shallow_view view = lom_view_shallow(surface.shallow.now);
    CHECK(view.steps > 10 && view.columns == 48 && view.rows == 36);
    int moved = 0;
    for (int row = 8; row < 28; row++)
        for (int column = 8; column < 40; column++) {
            size_t cell = (size_t)row * 48 + (size_t)column;
            double x = surface.shallow.corner[0] + (column + 0.5) * view.cell;
            double z = surface.shallow.corner[1] + (row + 0.5) * view.cell;
            double height = lom_wave_surface_height(&surface, x, z);
            double level = 0.5 + view.bed[cell] + view.depth[cell];
            CHECK(!(view.depth[cell] > 0.01) || __builtin_fabs(height - level) < 1e-6, "%d, %d: %g, not %g", column,
                  row, height, level);
            moved += __builtin_fabs(height - 0.5) > 1e-3;
        }
    CHECK(moved > 50, "%d cells are off the level", moved);
    CHECK(lom_wave_surface_height(&surface, -20, -20) == 0.5); /* outside the region */
    close_shore();
    if (!open_shore(HILL POOL, 0))
        return;
    CHECK(__builtin_fabs(lom_wave_surface_height(&surface, 26, 21) - 0.5) < 1e-9); /* before anything has happened */
    close_shore();
}

/* The wake of a body in a pool without walls near it, among rays. */
static void no_ray_passes_between_cells(void)
{
    if (!open_shore("[water]\nlevel = 0.5\nsize = 70\n[shallow]\nsize = 60\ncells = 120\nedge = \"open\"\n"
                    "[[shallow.body]]\nposition = [1, 2]\nhalf = 4\ndraft = 2\ntime = 0\nduration = 1\n",
                    1.2))
        return;
    check_rays(0.01);
    close_shore();
}

static lom_image *trace(const char *text, double time)
{
    scene = make_scene(text);
    reference = scene == NULL ? NULL : lom_create_reference(scene, NULL);
    lom_reference_frame frame = { .width = 48, .height = 27, .time = time, .samples = 1, .depth = 2 };
    lom_image *image = reference == NULL ? NULL : lom_trace_scene(reference, &frame, NULL);
    lom_free_reference(reference);
    lom_free_scene(scene);
    CHECK(image != NULL);
    return image;
}

static void check_same(const char *moving, double time, const char *standing, bool same)
{
    lom_image *a = trace(moving, time), *b = trace(standing, time);
    if (a != NULL && b != NULL)
        CHECK((memcmp(a->pixels, b->pixels, sizeof(float) * 3 * 48 * 27) == 0) == same, "at %g s", time);
    lom_free_image(a);
    lom_free_image(b);
}

#define VIEW                                                                                                           \
    "[camera]\nposition = [0, 2, 8]\ntarget = [0, 0.5, 0]\n[sky]\ncolor = [0.2, 0.3, 0.5]\n[water]\nsize = 30\n"
#define QUAD "[[entity]]\nmesh = \"quad.obj\"\n"

static void a_moving_scene_is_that_of_its_time(void)
{
    const char *standing = VIEW QUAD "position = [1, 1, 0]\nrotation = [0, 20, 0]\n";
    const char *moving = VIEW QUAD "[[entity.key]]\ntime = 0\nposition = [-3, 1, 0]\nrotation = [0, 20, 0]\n"
                                   "[[entity.key]]\ntime = 2\nposition = [1, 1, 0]\nrotation = [0, 20, 0]\n";
    check_same(moving, 2, standing, true);
    check_same(moving, 1, standing, false);
    const char *noon = VIEW QUAD "[light]\nazimuth = 10\nelevation = 60\nintensity = 0.5\n";
    const char *day = VIEW QUAD "[light]\n[[light.key]]\ntime = 0\nazimuth = 10\nelevation = 10\nintensity = 0.2\n"
                                "[[light.key]]\ntime = 4\nazimuth = 10\nelevation = 60\nintensity = 0.5\n";
    check_same(day, 4, noon, true);
    check_same(day, 1, noon, false);
}

int main(int argc, char **argv)
{
    if (!write_files())
        return 1;
    RUN(surf_lies_where_its_maps_say);
    RUN(shallow_water_lies_where_its_cells_do);
    RUN(no_ray_passes_between_cells);
    RUN(a_moving_scene_is_that_of_its_time);
    remove_files();
    return check_result();
}
