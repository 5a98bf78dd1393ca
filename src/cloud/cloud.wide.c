/* The shader of a marched cloud. In: the back faces of its box, the depth of what is drawn. Out: the light it sends to
 * the eye and, as alpha, the share of what lies behind that it takes. Invariant: a pixel's ray depends on the pixel
 * alone; a ray that meets no density gives 0 and alpha 0, which leaves the picture as it is. */
#include "cloud/cloud_uniforms.h"
#include "cloud/cloud_phases.h"
#include "cloud/cloud_rays.h"

enum { SHADOW_X, SHADOW_Z, SHADOW_VARYINGS };

static lom_float jitter_of(const struct lom_cloud_uniforms *cloud, const lom_varyings *in)
{
    if (cloud->jitter == NULL)
        return lom_splat(1.0f);
    lom_int x = lom_to_int(in->x) & 63, y = lom_to_int(in->y) & 63;
    return lom_gather(cloud->jitter, y * 64 + x);
}

/* The rays of fragments, with where their first steps lie and what they scatter of the sun. */
static lom_medium_rays aim(const struct lom_cloud_uniforms *cloud, const lom_varyings *in)
{
    lom_float3 direction;
    lom_medium_rays rays = lom_cloud_rays(cloud, in, &direction);
    rays.shift = jitter_of(cloud, in);
    lom_set_cloud_phase(cloud, &rays, direction);
    return rays;
}

static void fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    const lom_medium_rays rays = aim(cloud, in);
    lom_medium_result seen;
    LOM_WIDE(lom_march_medium)(&seen, &rays, &cloud->march, NULL);
    lom_float alpha = 1.0f - seen.transmittance;
    lom_float3 color = lom_scale3(lom_uniform3(cloud->sun), seen.sun);
    color = lom_add3(color, lom_scale3(lom_uniform3(cloud->sky), seen.sky));
    color = lom_add3(color, lom_scale3(lom_uniform3(cloud->ground), seen.ground));
    LOM_NAME_AS(sun, seen.sun);
    LOM_NAME_AS(sky, seen.sky);
    LOM_NAME_AS(ground, seen.ground);
    LOM_NAME_AS(distance, seen.distance);
    color = lom_cloud_haze(cloud, color, alpha, seen.distance);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, alpha };
}

/* The same with colours by value. */
static void transfer_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cloud_uniforms *cloud = uniforms;
    const lom_medium_rays rays = aim(cloud, in);
    lom_transfer_result seen;
    LOM_WIDE(lom_march_transfer)(&seen, &rays, &cloud->march, &cloud->transfer, NULL);
    lom_float alpha = 1.0f - seen.transmittance;
    LOM_NAME_AS(distance, seen.distance);
    lom_float3 color = lom_cloud_haze(cloud, seen.color, alpha, seen.distance);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, alpha };
}

static void shadow_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_cloud_shadow_uniforms *shadow = uniforms;
    lom_float s = shadow->quad[0] + lom_to_float(in->vertex & 1) * shadow->quad[2];
    lom_float t = shadow->quad[1] + lom_to_float(in->vertex >> 1) * shadow->quad[3];
    out->position = (lom_float4){ 2.0f * s - 1.0f, 1.0f - 2.0f * t, { 0 }, lom_splat(1.0f) };
    out->varying[SHADOW_X] = s * shadow->plane[2];
    out->varying[SHADOW_Z] = t * shadow->plane[3];
}

/* What the cloud lets through of the light that meets the plane at x, z: exp(-optical depth). */
static void shadow_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_cloud_shadow_uniforms *shadow = uniforms;
    lom_float x = in->varying[SHADOW_X], z = in->varying[SHADOW_Z], depth;
    lom_medium_rays rays = { .start = { x * shadow->by_x[0] + z * shadow->by_z[0] + shadow->start[0],
                                        x * shadow->by_x[1] + z * shadow->by_z[1] + shadow->start[1],
                                        x * shadow->by_x[2] + z * shadow->by_z[2] + shadow->start[2] },
                             .along = lom_uniform3(shadow->along),
                             .active = in->covered };
    LOM_WIDE(lom_cross_box)(&rays);
    if (shadow->transfer != NULL)
        LOM_WIDE(lom_transfer_depth)(&depth, &rays, &shadow->march, shadow->transfer, shadow->steps);
    else
        LOM_WIDE(lom_medium_depth)(&depth, &rays, &shadow->march, shadow->steps);
    lom_float through = lom_fade(-depth);
    out->color[0] = (lom_float4){ through, through, through, lom_splat(1.0f) };
}

LOM_SHADER(lom_cloud_shadow_shader, shadow_vertex, shadow_fragment, .varyings = SHADOW_VARYINGS,
           .reads = LOM_VARYINGS(SHADOW_X, 2), .colors = 1, .uniforms_size = sizeof(struct lom_cloud_shadow_uniforms))
LOM_SHADER(lom_cloud_shader, lom_cloud_vertex, fragment, .varyings = RAY_VARYINGS, .reads = LOM_VARYINGS(OFFSET, 3),
           .reads_position = true, .colors = 1, .uniforms_size = sizeof(struct lom_cloud_uniforms))
LOM_SHADER(lom_cloud_transfer_shader, lom_cloud_vertex, transfer_fragment, .varyings = RAY_VARYINGS,
           .reads = LOM_VARYINGS(OFFSET, 3), .reads_position = true, .colors = 1,
           .uniforms_size = sizeof(struct lom_cloud_uniforms))
