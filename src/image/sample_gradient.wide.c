/* Anisotropic sampling (lom/texture.h: lom_sample_gradient), and the level of detail of 3D textures. In: coordinates and
 * how they change from a pixel to the next; out: the mean of probes along the longer change, each a sample as any.
 * Invariant: a lane depends on no other; those that have fewer probes keep their mean. */
#include "level_of_detail.h"

/* What the footprint of a lane comes to. */
typedef struct footprint {
    lom_float s, t;    /* the longer change */
    lom_float lod;     /* of the probes */
    lom_float count;   /* of them */
    lom_float segment; /* from the first to the last, in parts of the longer change */
} footprint;

static footprint measure(const lom_texture *texture, const lom_float derivative[4])
{
    float most = (float)texture->sampler.anisotropy;
    lom_float along_x, along_y;
    sample_squares(texture, derivative, &along_x, &along_y);
    lom_mask x_is_longer = along_x >= along_y;
    lom_float longer = lom_max(along_x, along_y), shorter = lom_min(along_x, along_y);
    lom_float least = longer / (most * most); /* at most FLT_MAX, where a product could be infinite */
    lom_float square = lom_max(shorter, sample_bounded(least)), width = lom_max(square, lom_splat(1.0f));
    footprint print;
    print.s = lom_select(x_is_longer, derivative[0], derivative[2]);
    print.t = lom_select(x_is_longer, derivative[1], derivative[3]);
    print.lod = sample_half_log2(square);
    print.count = lom_clamp(lom_ceil(lom_sqrt(longer / width)), lom_splat(1.0f), lom_splat(most));
    print.segment = lom_max(1.0f - lom_sqrt(width / longer), (lom_float){ 0 });
    return print;
}

static void mix_into(lom_float4 *mean, const lom_float4 *value, lom_float weight, lom_mask where)
{
    mean->x = lom_select(where, lom_mix(mean->x, value->x, weight), mean->x);
    mean->y = lom_select(where, lom_mix(mean->y, value->y, weight), mean->y);
    mean->z = lom_select(where, lom_mix(mean->z, value->z, weight), mean->z);
    mean->w = lom_select(where, lom_mix(mean->w, value->w, weight), mean->w);
}

/* Probe k of each lane; of one that has one alone, the place itself. */
static void probe(const lom_texture *texture, const lom_float2 *at, const footprint *print, int k, lom_float4 *out)
{
    lom_mask several = print->count > 1.0f;
    lom_float part = lom_splat((float)k) / (print->count - 1.0f) - 0.5f;
    lom_float offset = lom_select(several, part * print->segment, (lom_float){ 0 });
    lom_float2 place = { lom_select(several, at->x + print->s * offset, at->x),
                         lom_select(several, at->y + print->t * offset, at->y) };
    LOM_WIDE(lom_sample_lanes)(texture, &place, &print->lod, out);
}

void LOM_WIDE(lom_sample_gradient_lanes)(const lom_texture *texture, const lom_float2 *at,
                                         const lom_float derivative[4], lom_float4 *out)
{
    if (texture->sampler.anisotropy <= 1) {
        lom_float lod;
        LOM_WIDE(lom_lod_lanes)(texture, derivative, &lod);
        LOM_WIDE(lom_sample_lanes)(texture, at, &lod, out);
        return;
    }
    footprint print = measure(texture, derivative);
    *out = (lom_float4){ { 0 }, { 0 }, { 0 }, { 0 } };
    for (int k = 0; k < texture->sampler.anisotropy; k++) {
        lom_mask more = print.count > (float)k;
        if (!lom_any(more))
            return;
        lom_float4 value;
        probe(texture, at, &print, k, &value);
        if (k == 0)
            *out = value;
        else
            mix_into(out, &value, lom_splat(1.0f / (float)(k + 1)), more);
    }
}

void LOM_WIDE(lom_lod_3d_lanes)(const lom_texture *texture, const lom_float3 *dx, const lom_float3 *dy, lom_float *lod)
{
    const lom_level *l = &texture->level[0];
    float width = (float)l->width, height = (float)l->height, depth = (float)l->depth;
    lom_float3 x = { dx->x * width, dx->y * height, dx->z * depth };
    lom_float3 y = { dy->x * width, dy->y * height, dy->z * depth };
    lom_float along_x = sample_bounded(lom_dot3(x, x)), along_y = sample_bounded(lom_dot3(y, y));
    *lod = sample_half_log2(lom_max(along_x, along_y));
}
