/* The sun's shadow over the whole view in cascades (Zhang, Sun, Xu, Lun, Parallel-split Shadow Maps, VRCIA 2006). In: what
 * casts, the view. Out: a map for each slice of the view's depth, near ones fine, and a last one that holds all that casts.
 *
 * Slice i of m from n to f ends at L n (f / n)^(i / m) + (1 - L) (n + (f - n) i / m), between the logarithmic scheme and the
 * uniform one. Its map is, of the square around the least sphere that holds the slice, what casters cover: turning the eye
 * moves no texel, and no map is wider than what it can show. Which map a place takes follows from where it lies (shading/shadow_map.wide.c), so that
 * what is mirrored or refracted is shaded as what is seen.
 *
 * Invariant: slices follow from the whole frame, not from a crop. */
#include "base/numbers.h"
#include "render/entities/sun_map.h"
#include "render/frame.h"
#include "render/seen.h"

static const char *const names[LOM_ENTITY_SHADOWS] = { "cascade 1", "cascade 2", "cascade 3", "cascade 4" };

struct range {
    double near, far;
};

/* From the nearest caster to the farthest end of one. */
static struct range find_range(const struct frame *f)
{
    const struct lom_drawn_entities *all = &f->renderer->entities;
    struct range r = { 1e300, 0 };
    for (size_t i = 0; i < all->count; i++) {
        const lom_box box = all->items[i].at->bounds;
        const lom_vec3 side = { box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z };
        const double distance = lom_distance_to_box(f->view.eye, box);
        if (all->items[i].shadow_maps == 0)
            continue;
        r.near = distance < r.near ? distance : r.near;
        r.far = lom_larger(r.far, distance + lom_double_sqrt(lom_vec3_dot(side, side)));
    }
    r.near = lom_larger(r.near, f->camera.near_plane);
    r.far = lom_larger(r.far, r.near);
    return r;
}

static double split(const struct frame *f, struct range all, int i)
{
    const double share = (double)i / f->scene->quality.shadow_cascades, mix = f->scene->quality.shadow_split;
    return mix * all.near * lom_double_pow(all.far / all.near, share) +
           (1 - mix) * (all.near + (all.far - all.near) * share);
}

/* The least sphere around the frustum from a to b, about a point of its axis: through the corners of both ends, or through
 * those of the far one where that is wider than deep. */
static double find_sphere(const struct frame *f, double a, double b, lom_vec3 *middle)
{
    const double x = 1 / f->view.projection.m[0][0], y = 1 / f->view.projection.m[1][1], k = x * x + y * y;
    const lom_vec3 along = lom_find_view_rays(&f->view.projection, &f->view.view).along;
    const double even = (a + b) / 2 * (1 + k), c = even < b ? even : b;
    *middle = lom_vec3_add(f->view.eye, lom_vec3_scale(along, c));
    return lom_double_sqrt((b - c) * (b - c) + k * b * b);
}

static bool overlaps(lom_box a, lom_box b)
{
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/* Of a square of the sun's view (NULL: all of it) as much as what casts into it covers; marks that. */
static struct lom_sun_casters find_casters(struct frame *f, int number, const lom_box *square, const lom_mat4 *light)
{
    struct lom_drawn_entities *all = &f->renderer->entities;
    struct lom_sun_casters casters = { .count = 0 };
    for (size_t i = 0; i < all->count; i++) {
        const lom_box box = lom_transform_box(light, all->items[i].at->bounds);
        if (all->items[i].shadow_maps == 0 || (square != NULL && !overlaps(box, *square)))
            continue;
        all->items[i].shadow_maps |= 1u << number;
        lom_add_sun_caster(&casters, box);
    }
    if (square != NULL) {
        lom_box *extent = &casters.extent;
        extent->low.x = lom_larger(extent->low.x, square->low.x);
        extent->low.y = lom_larger(extent->low.y, square->low.y);
        extent->high.x = lom_smaller(extent->high.x, square->high.x);
        extent->high.y = lom_smaller(extent->high.y, square->high.y);
    }
    return casters;
}

bool lom_draw_cascades(struct frame *f, const lom_mat4 *light, lom_error *error)
{
    const int count = f->scene->quality.shadow_cascades;
    const struct range all = find_range(f);
    for (int i = 0; i < count; i++) {
        lom_vec3 middle;
        const double radius = find_sphere(f, split(f, all, i), split(f, all, i + 1), &middle);
        lom_box square = lom_transform_box(light, (lom_box){ middle, middle });
        square.low.x -= radius;
        square.low.y -= radius;
        square.high.x += radius;
        square.high.y += radius;
        const struct lom_sun_casters casters = find_casters(f, i, i + 1 < count ? &square : NULL, light);
        if (casters.count == 0)
            lom_add_step(f, names[i], false, "nothing casts into it");
        else if (!lom_draw_sun_map(f, i, names[i], &casters, light, error))
            return false;
    }
    return true;
}
