/* Where the rays of a picture start and which way they go, for the shaders of every model layer: the one place that
 * knows whether they leave an eye or are parallel (lom_view_rays in lom/geometry.h, docs/cameras.md).
 *
 * The reach of a place is what tells the nearer one on a ray: in perspective the distance along the view axis (clip w),
 * of parallel rays the metres along them from the plane across the view axis through the eye. */
#ifndef LOM_SHADING_EYE_H
#define LOM_SHADING_EYE_H

#include "shading/matrix.h"

struct lom_eye_uniform {
    bool parallel;
    float along[3]; /* parallel: the direction of all rays, of unit length */
    float plane[3]; /* parallel: the reach of an offset is plane . offset */
    float near_plane;
    float far_reach, depth_reach; /* parallel: the reach of depth z is far_reach - depth_reach z */
    float pixel;                  /* what a pixel covers in the picture's middle: a tangent; parallel: metres */
};

/* The least depth that a float holds in full, less than that of any place: it stands for none. */
static const float nothing_there = 0x1p-100f;

/* Of pictures of projection * view, what a pixel covers in the middle as above. */
struct lom_eye_uniform lom_find_eye(const lom_mat4 *projection, const lom_mat4 *view, double pixel);

/* From where its ray starts to the place at an offset. */
LOM_INLINE lom_float3 lom_eye_path(const struct lom_eye_uniform *eye, lom_float3 offset)
{
    if (!eye->parallel)
        return offset;
    return lom_scale3(lom_uniform3(eye->along), lom_dot3(offset, lom_uniform3(eye->plane)));
}

/* The unit vector from a place at an offset to where its ray starts. */
LOM_INLINE lom_float3 lom_to_eye(const struct lom_eye_uniform *eye, lom_float3 offset)
{
    if (eye->parallel)
        return lom_scale3(lom_uniform3(eye->along), lom_splat(-1.0f));
    return lom_normalize3(lom_scale3(offset, lom_splat(-1.0f)));
}

/* The reach of what has this depth in a picture; huge where there is nothing. */
LOM_INLINE lom_float lom_depth_reach(const struct lom_eye_uniform *eye, lom_float depth)
{
    if (!eye->parallel)
        return eye->near_plane / lom_max(depth, lom_splat(nothing_there));
    return lom_select(depth > 0.0f, eye->far_reach - depth * eye->depth_reach, lom_splat(0x1p100f));
}

/* The depth of a reach: the inverse. */
LOM_INLINE lom_float lom_reach_depth(const struct lom_eye_uniform *eye, lom_float reach)
{
    return eye->parallel ? (eye->far_reach - reach) / eye->depth_reach : eye->near_plane / reach;
}

/* The reach of a place, whose clip w is known. */
LOM_INLINE lom_float lom_place_reach(const struct lom_eye_uniform *eye, lom_float3 offset, lom_float w)
{
    return eye->parallel ? lom_dot3(offset, lom_uniform3(eye->plane)) : w;
}

/* What a pixel covers across a ray, this far along it. */
LOM_INLINE lom_float lom_pixel_size(const struct lom_eye_uniform *eye, lom_float reach)
{
    return eye->parallel ? lom_splat(eye->pixel) : reach * eye->pixel;
}

#endif
