/* The oracle of sampling: textures decoded to double, each texel's index wrapped by itself, all filters by their weights. */
#ifndef LOM_TESTS_ORACLE_SAMPLING_H
#define LOM_TESTS_ORACLE_SAMPLING_H

#include "image/plain_texture.h"

/* The texel that index i of n means; -1 for the border. */
static inline int wrap_index(long i, int n, lom_wrap wrap)
{
    if (wrap == LOM_WRAP_REPEAT)
        return (int)(((i % n) + n) % n);
    if (wrap == LOM_WRAP_MIRROR) {
        long m = ((i % (2 * n)) + 2 * n) % (2 * n);
        return (int)(m < n ? m : 2 * n - 1 - m);
    }
    if (i >= 0 && i < n)
        return (int)i;
    return wrap == LOM_WRAP_BORDER ? -1 : i < 0 ? 0 : n - 1;
}

static inline const double *texel_at(const plain_texture *p, int level, const long i[3])
{
    int x = wrap_index(i[0], p->width[level], p->desc.sampler.wrap_s);
    int y = wrap_index(i[1], p->height[level], p->desc.sampler.wrap_t);
    int z = p->desc.kind == LOM_TEXTURE_3D ? wrap_index(i[2], p->depth[level], p->desc.sampler.wrap_r) : 0;
    if (x < 0 || y < 0 || z < 0)
        return p->border;
    return p->texel[level][((size_t)z * (size_t)p->height[level] + (size_t)y) * (size_t)p->width[level] + (size_t)x];
}

/* One level; bound is how far float coordinates may move the result, and shaky is set when they may choose another
 * nearest texel. */
static inline void sample_level(const plain_texture *p, int level, const double at[3], bool nearest, double out[4],
                                double *bound, bool *shaky)
{
    int size[3] = { p->width[level], p->height[level], p->depth[level] };
    int dimensions = p->desc.kind == LOM_TEXTURE_3D ? 3 : 2;
    long first[3] = { 0, 0, 0 };
    double weight[3] = { 0, 0, 0 };
    for (int d = 0; d < dimensions; d++) {
        double x = at[d] * size[d] - (nearest ? 0 : 0.5), error_of_x = (size[d] + 1) * 0x1p-22;
        x = x > 1e9 ? 1e9 : x < -1e9 ? -1e9 : x;
        first[d] = (long)floor(x);
        weight[d] = nearest ? 0 : x - floor(x);
        *bound += nearest ? 0 : error_of_x;
        if (nearest && fabs(x - round(x)) < error_of_x && (size[d] & (size[d] - 1)) != 0)
            *shaky = true;
    }
    for (int c = 0; c < 4; c++)
        out[c] = 0;
    for (int corner = 0; corner < 8; corner++) {
        double w = 1;
        long i[3];
        for (int d = 0; d < 3; d++) {
            w *= corner >> d & 1 ? weight[d] : 1 - weight[d];
            i[d] = first[d] + (corner >> d & 1);
        }
        const double *texel = w != 0 ? texel_at(p, level, i) : p->border;
        for (int c = 0; c < 4 && w != 0; c++)
            out[c] += w * texel[c];
    }
}

static inline void sample_plain(const plain_texture *p, const double at[3], double lod, double out[4], double *bound,
                                bool *shaky)
{
    static const lom_filter nearest_within[] = { LOM_FILTER_NEAREST, LOM_FILTER_NEAREST_MIPMAP_NEAREST,
                                                 LOM_FILTER_NEAREST_MIPMAP_LINEAR };
    const lom_sampler_desc *s = &p->desc.sampler;
    lom_filter filter = lod > 0 ? s->minify : s->magnify;
    bool nearest = false, between_linear = filter >= LOM_FILTER_NEAREST_MIPMAP_LINEAR;
    bool between_nearest = filter >= LOM_FILTER_NEAREST_MIPMAP_NEAREST && !between_linear;
    for (int i = 0; i < 3; i++)
        nearest |= filter == nearest_within[i];
    double level = 0, last = p->levels - 1;
    if (between_nearest)
        level = fmin(ceil(lod + 0.5) - 1, last);
    if (between_linear)
        level = fmin(lod, last);
    double near[4], far[4] = { 0 }, fraction = level - floor(level);
    sample_level(p, (int)level, at, nearest, near, bound, shaky);
    if (fraction > 0)
        sample_level(p, (int)level + 1, at, nearest, far, bound, shaky);
    for (int c = 0; c < 4; c++)
        out[c] = near[c] + (fraction > 0 ? (far[c] - near[c]) * fraction : 0);
}

#endif
