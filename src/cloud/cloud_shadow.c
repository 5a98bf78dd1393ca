/* Shadows of clouds on a plane. In: a cloud and the way to the light. Out: a draw that multiplies what the cloud lets
 * through into a map. Invariant: a texel holds the product over all clouds, in whatever order they are drawn up to
 * rounding, and they are drawn in the order of the file. */
#include "shading/square.h"
#include "cloud/cloud_draw.h"
#include "cloud/cloud_uniforms.h"

enum { STEPS = 40 };

void lom_shadow_extent(lom_box box, double y, const double to_light[3], double extent[4])
{
    const double low[3] = { box.low.x, box.low.y, box.low.z }, high[3] = { box.high.x, box.high.y, box.high.z };
    for (int a = 0; a < 2; a++) {
        double slope = to_light[2 * a] / to_light[1];
        extent[2 * a] = 1e300;
        extent[2 * a + 1] = -1e300;
        for (int i = 0; i < 4; i++) {
            double at = (i & 1 ? high : low)[2 * a] - slope * ((i & 2 ? high : low)[1] - y);
            extent[2 * a] = at < extent[2 * a] ? at : extent[2 * a];
            extent[2 * a + 1] = at > extent[2 * a + 1] ? at : extent[2 * a + 1];
        }
    }
}

/* The part of the map between low and high along one axis, in parts of the map; false when it is none. */
static bool find_part(double low, double high, double corner, double extent, float *start, float *length)
{
    double from = (low - corner) / extent, to = (high - corner) / extent;
    from = from > 0 ? from : 0;
    to = to < 1 ? to : 1;
    *start = (float)from;
    *length = (float)(to - from);
    return from < to;
}

static void set_rays(struct lom_cloud_shadow_uniforms *u, const struct lom_placed_cloud *cloud, const double plane[4],
                     double y, const double to_light[3])
{
    const double corner[3] = { plane[0] - cloud->middle.x, y - cloud->middle.y, plane[1] - cloud->middle.z };
    for (int i = 0; i < 3; i++) {
        const double *axis = cloud->axes[i];
        double size = cloud->cloud->size[i];
        u->start[i] = (float)((axis[0] * corner[0] + axis[1] * corner[1] + axis[2] * corner[2]) / size + 0.5);
        u->by_x[i] = (float)(axis[0] / size);
        u->by_z[i] = (float)(axis[2] / size);
        u->along[i] = (float)((axis[0] * to_light[0] + axis[1] * to_light[1] + axis[2] * to_light[2]) / size);
    }
}

void lom_draw_cloud_shadow(lom_device *device, const struct lom_cloud_set *set, const struct lom_placed_cloud *cloud,
                           const double plane[4], double y, const double to_light[3])
{
    struct lom_cloud_shadow_uniforms u = { .steps = STEPS,
                                           .transfer = cloud->transfer.count > 0 ? &cloud->transfer : NULL };
    double extent[4];
    lom_shadow_extent(lom_cloud_bounds(cloud), y, to_light, extent);
    if (!find_part(extent[0], extent[1], plane[0], plane[2], &u.quad[0], &u.quad[2]) ||
        !find_part(extent[2], extent[3], plane[1], plane[3], &u.quad[1], &u.quad[3]))
        return;
    for (int i = 0; i < 4; i++)
        u.plane[i] = (float)plane[i];
    set_rays(&u, cloud, plane, y, to_light);
    u.march = (lom_medium_desc){ .medium = cloud->density->medium,
                                 .detail = cloud->cloud->detail > 0 ? set->detail : NULL,
                                 .detail_strength = (float)cloud->cloud->detail,
                                 .detail_far = 1,
                                 .extinction = (float)(cloud->cloud->extinction * cloud->cloud->density),
                                 .filtering = set->quality.march };
    static const lom_blend product = { .enabled = true,
                                       .source_color = LOM_FACTOR_ZERO,
                                       .target_color = LOM_FACTOR_SOURCE_COLOR,
                                       .source_alpha = LOM_FACTOR_ONE };
    lom_draw_square(device, &lom_cloud_shadow_shader, &u, &product);
}
