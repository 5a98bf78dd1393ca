/* What the shaders of clouds share: the box's vertices, a pixel's ray through it, and the air before it. */
#ifndef LOM_CLOUD_RAYS_H
#define LOM_CLOUD_RAYS_H

#include "cloud/cloud_uniforms.h"

/* Varyings: an offset from the eye; where there is a picture, its coordinates. */
enum { OFFSET = 0, RAY_VARYINGS = 3, S = 3, T, PICTURE_VARYINGS };

LOM_INLINE void lom_cloud_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    lom_float3 offset;
    lom_int first = (in->vertex & 7) * 3;
    offset.x = lom_gather(&cloud->corner[0][0], first);
    offset.y = lom_gather(&cloud->corner[0][0], first + 1);
    offset.z = lom_gather(&cloud->corner[0][0], first + 2);
    out->position = lom_transform4(&cloud->clip_from_offset, offset);
    out->varying[OFFSET] = offset.x;
    out->varying[OFFSET + 1] = offset.y;
    out->varying[OFFSET + 2] = offset.z;
}

/* A square: its middle is corner[0], its half sides are right and up. */
LOM_INLINE void lom_cloud_picture_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    lom_float s = lom_to_float(in->vertex & 1), t = lom_to_float(in->vertex >> 1);
    lom_float x = 2.0f * s - 1.0f, y = 1.0f - 2.0f * t;
    lom_float3 offset = { x * cloud->right[0] + y * cloud->up[0] + cloud->corner[0][0],
                          x * cloud->right[1] + y * cloud->up[1] + cloud->corner[0][1],
                          x * cloud->right[2] + y * cloud->up[2] + cloud->corner[0][2] };
    out->position = lom_transform4(&cloud->clip_from_offset, offset);
    out->varying[OFFSET] = offset.x;
    out->varying[OFFSET + 1] = offset.y;
    out->varying[OFFSET + 2] = offset.z;
    out->varying[S] = s;
    out->varying[T] = t;
}

/* Metres along the ray to what is drawn there; length: those to the fragment. */
LOM_INLINE lom_float lom_scene_distance(const struct lom_cloud_uniforms *cloud, const lom_varyings *in,
                                        lom_float length)
{
    lom_int x = lom_to_int(in->x - cloud->origin[0]), y = lom_to_int(in->y - cloud->origin[1]);
    lom_float depth = lom_fetch(cloud->depth, x, y, 0).x;
    lom_float reach = lom_depth_reach(&cloud->eye, depth);
    return lom_select(depth > 0.0f, cloud->eye.parallel ? reach : length * reach / in->w, lom_splat(3e38f));
}

/* Air between the eye and the cloud turns it to the haze's colour. */
LOM_INLINE lom_float3 lom_cloud_haze(const struct lom_cloud_uniforms *cloud, lom_float3 color, lom_float alpha,
                                     lom_float distance)
{
    if (cloud->haze_rate == 0)
        return color;
    lom_float air = -lom_expm1(-(distance * cloud->haze_rate));
    return lom_mix3(color, lom_scale3(lom_uniform3(cloud->haze_color), alpha), air);
}

/* The ray of each fragment, from where it enters the box to where it leaves it or meets what is drawn. */
LOM_INLINE lom_medium_rays lom_cloud_rays(const struct lom_cloud_uniforms *cloud, const lom_varyings *in,
                                          lom_float3 *direction)
{
    lom_float3 offset = { in->varying[OFFSET], in->varying[OFFSET + 1], in->varying[OFFSET + 2] };
    lom_float length = lom_sqrt(lom_dot3(offset, offset));
    *direction = lom_scale3(offset, 1.0f / lom_max(length, lom_splat(1e-20f)));
    lom_float3 start = lom_uniform3(cloud->eye_in_box);
    if (cloud->eye.parallel) { /* rays start beside the eye */
        lom_float3 beside = lom_sub3(offset, lom_eye_path(&cloud->eye, offset));
        *direction = lom_uniform3(cloud->eye.along);
        start.x += lom_dot3(beside, lom_uniform3(cloud->box_axis[0]));
        start.y += lom_dot3(beside, lom_uniform3(cloud->box_axis[1]));
        start.z += lom_dot3(beside, lom_uniform3(cloud->box_axis[2]));
    }
    lom_medium_rays rays = { .start = start,
                             .along = { lom_dot3(*direction, lom_uniform3(cloud->box_axis[0])),
                                        lom_dot3(*direction, lom_uniform3(cloud->box_axis[1])),
                                        lom_dot3(*direction, lom_uniform3(cloud->box_axis[2])) },
                             .active = in->covered };
    LOM_WIDE(lom_cross_box)(&rays);
    if (cloud->is_sliced) {
        lom_float along = 1.0f / lom_max(lom_dot3(*direction, lom_uniform3(cloud->slice_axis)), lom_splat(1e-6f));
        rays.enter = lom_max(rays.enter, along * cloud->slice_from);
        rays.leave = lom_min(rays.leave, along * cloud->slice_to);
    }
    if (cloud->depth != NULL)
        rays.leave = lom_min(rays.leave, lom_scene_distance(cloud, in, length));
    rays.active &= rays.enter < rays.leave;
    return rays;
}

#endif
