/* The sun's view. In: where the sun is, what casts. Out: whether its shadow may be seen; the texels of a map of it.
 *
 * Invariant: all follows from the whole frame; a map's texels keep their size and their places in the world while the
 * eye moves, as long as what the map has to hold is about as large. */
#include "render/sun_view.h"

#include "base/numbers.h"
#include "render/frame.h"

static const double margin = 4; /* texels around what casts, which stay clear */

lom_mat4 lom_sun_view(lom_vec3 to_light)
{
    lom_vec3 up = { to_light.y * to_light.y < 0.98 ? 0 : 1, to_light.y * to_light.y < 0.98 ? 1 : 0, 0 };
    lom_vec3 from = { 0, 0, 0 }, to = { -to_light.x, -to_light.y, -to_light.z };
    return lom_look_at(from, to, up);
}

lom_box lom_join_boxes(lom_box a, lom_box b)
{
    return (
        lom_box){ { lom_smaller(a.low.x, b.low.x), lom_smaller(a.low.y, b.low.y), lom_smaller(a.low.z, b.low.z) },
                  { lom_larger(a.high.x, b.high.x), lom_larger(a.high.y, b.high.y), lom_larger(a.high.z, b.high.z) } };
}

/* ---- where shadows fall ---- */

static const lom_box nothing = { { 1e300, 1e300, 1e300 }, { -1e300, -1e300, -1e300 } };

struct lom_sun_receivers lom_find_sun_receivers(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    lom_box all = nothing, surface;
    for (size_t i = 0; i < r->entities.count; i++)
        all = lom_join_boxes(all, r->entities.items[i].at->bounds);
    for (int i = 0; i < r->ground.across * r->ground.down; i++)
        all = lom_join_boxes(all, r->ground.blocks[i].bounds);
    for (size_t i = 0; i <= f->scene->other_water_count; i++)
        if (lom_water_shows_sun(f, i, &surface))
            all = lom_join_boxes(all, surface);
    for (size_t i = 0; i < r->fluids.count; i++)
        if (f->scene->fluids[i].visible)
            all = lom_join_boxes(all, lom_fluid_box(&f->scene->fluids[i]));
    return (struct lom_sun_receivers){ lom_find_seen(f), all, r->moment.to_light };
}

/* How far a range can move by `speed` a metre until it has left another: less than 0: it has. */
static double way_out(double low, double high, double speed, double from, double to)
{
    return speed == 0 ? 1e300 : speed < 0 ? (high - from) / -speed : (to - low) / speed;
}

/* All that is between a box and the last thing behind it that its shadow could fall on. */
static lom_box shadow_volume(lom_box box, lom_vec3 to_light, const lom_box *all)
{
    double length = way_out(box.low.x, box.high.x, -to_light.x, all->low.x, all->high.x);
    length = lom_smaller(length, way_out(box.low.y, box.high.y, -to_light.y, all->low.y, all->high.y));
    length = lom_larger(lom_smaller(length, way_out(box.low.z, box.high.z, -to_light.z, all->low.z, all->high.z)), 0);
    lom_vec3 low = { box.low.x - to_light.x * length, box.low.y - to_light.y * length,
                     box.low.z - to_light.z * length };
    lom_vec3 high = { box.high.x - to_light.x * length, box.high.y - to_light.y * length,
                      box.high.z - to_light.z * length };
    return lom_join_boxes(box, (lom_box){ low, high });
}

bool lom_may_show_sun_shadow(const struct lom_sun_receivers *receivers, lom_box box)
{
    return lom_may_show(&receivers->seen, shadow_volume(box, receivers->to_light, &receivers->all));
}

/* ---- maps ---- */

/* A size of texels, at least `least` above 0, from a scale of eighths of a length of the scene, so that it changes
 * seldom. */
static double texel_size(double least, double length)
{
    double size = length > 0 ? length : least;
    while (size < least)
        size *= 1.125;
    while (size / 1.125 >= least)
        size /= 1.125;
    return size;
}

struct lom_sun_map lom_project_sun_map(const lom_box *extent, const lom_mat4 *light, int size, lom_vec3 home,
                                       double length)
{
    double width = extent->high.x - extent->low.x, height = extent->high.y - extent->low.y;
    double least = lom_larger(lom_larger(width, height) / (size - 2 * margin), 1e-30);
    double texel = texel_size(least, length);
    double near = extent->high.z + margin * texel, far = extent->low.z - margin * texel;
    lom_box from = lom_transform_box(light, (lom_box){ home, home });
    double x = from.low.x + lom_double_floor((extent->low.x + width / 2 - from.low.x) / texel) * texel;
    double y = from.low.y + lom_double_floor((extent->low.y + height / 2 - from.low.y) / texel) * texel;
    double half = texel * size / 2;
    lom_mat4 square = { { { 1 / half, 0, 0, -x / half },
                          { 0, 1 / half, 0, -y / half },
                          { 0, 0, 1 / (near - far), -far / (near - far) },
                          { 0, 0, 0, 1 } } };
    return (struct lom_sun_map){ lom_multiply(&square, light), texel, near - far };
}

void lom_set_sun_map_rows(const struct lom_sun_map *map, lom_vec3 eye, float s[4], float t[4], float depth[4])
{
    double across[4], down[4];
    for (int i = 0; i < 4; i++) {
        across[i] = map->clip_from_world.m[0][i] / 2 + (i == 3 ? 0.5 : 0);
        down[i] = -map->clip_from_world.m[1][i] / 2 + (i == 3 ? 0.5 : 0);
    }
    lom_center_row(s, across, eye);
    lom_center_row(t, down, eye);
    lom_center_row(depth, map->clip_from_world.m[2], eye);
}
