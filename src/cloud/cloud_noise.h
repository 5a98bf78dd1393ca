/* Noise over lanes for clouds: gradient noise (Perlin 2002) and cellular noise (Worley 1996), of a hash by arithmetic,
 * so that any place of an endless lattice is as near as any other. `mask` wraps lattice lines: 2^n - 1 repeats after
 * 2^n cells, -1 never. Coordinates within +-2^22. */
#ifndef LOM_CLOUD_NOISE_H
#define LOM_CLOUD_NOISE_H

#include <lom/lanes.h>

/* Mixes three lattice lines and a seed; the finalizer is Ettinger's (three multiplications of full avalanche). */
LOM_INLINE lom_uint lom_hash_cell(lom_int x, lom_int y, lom_int z, uint32_t seed)
{
    lom_uint h = (lom_uint)x * 0x9e3779b1u ^ (lom_uint)y * 0x85ebca77u ^ (lom_uint)z * 0xc2b2ae3du ^ seed;
    h ^= h >> 16;
    h *= 0x21f0aaadu;
    h ^= h >> 15;
    h *= 0x735a2d97u;
    return h ^ h >> 15;
}

/* Ten bits as a number in [-1, 1]. */
LOM_INLINE lom_float lom_hash_signed(lom_uint h)
{
    return lom_to_float((lom_int)(h & 1023u)) * (2.0f / 1023.0f) - 1.0f;
}

LOM_INLINE lom_float lom_gradient_corner(lom_int x, lom_int y, lom_int z, uint32_t seed, lom_float3 from)
{
    lom_uint h = lom_hash_cell(x, y, z, seed);
    return lom_hash_signed(h) * from.x + lom_hash_signed(h >> 10) * from.y + lom_hash_signed(h >> 20) * from.z;
}

LOM_INLINE lom_float lom_fade(lom_float t)
{
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

/* Mean 0, within about [-1, 1]. */
LOM_INLINE lom_float lom_gradient_noise(lom_float3 p, int32_t mask, uint32_t seed)
{
    lom_float3 below = { lom_floor(p.x), lom_floor(p.y), lom_floor(p.z) };
    lom_int x = lom_to_int(below.x), y = lom_to_int(below.y), z = lom_to_int(below.z);
    lom_float3 f = lom_sub3(p, below);
    lom_float row[4];
    for (int i = 0; i < 4; i++) {
        lom_int j = (y + (i & 1)) & mask, k = (z + (i >> 1)) & mask;
        lom_float3 from = { f.x, f.y - (float)(i & 1), f.z - (float)(i >> 1) };
        lom_float low = lom_gradient_corner(x & mask, j, k, seed, from);
        from.x = f.x - 1.0f;
        row[i] = lom_mix(low, lom_gradient_corner((x + 1) & mask, j, k, seed, from), lom_fade(f.x));
    }
    lom_float v = lom_fade(f.y);
    return lom_mix(lom_mix(row[0], row[1], v), lom_mix(row[2], row[3], v), lom_fade(f.z)) * 1.3f;
}

/* Distance to the nearest of the lattice's points, one a cell, in cells. */
LOM_INLINE lom_float lom_cellular_noise(lom_float3 p, int32_t mask, uint32_t seed)
{
    lom_float3 below = { lom_floor(p.x), lom_floor(p.y), lom_floor(p.z) };
    lom_int x = lom_to_int(below.x), y = lom_to_int(below.y), z = lom_to_int(below.z);
    lom_float3 f = lom_sub3(p, below);
    lom_float nearest = lom_splat(9.0f);
    for (int i = 0; i < 27; i++) {
        int a = i % 3 - 1, b = i / 3 % 3 - 1, c = i / 9 - 1;
        lom_uint h = lom_hash_cell((x + a) & mask, (y + b) & mask, (z + c) & mask, seed);
        lom_float dx = lom_to_float((lom_int)(h & 1023u)) * (1 / 1023.0f) + ((float)a - f.x);
        lom_float dy = lom_to_float((lom_int)(h >> 10 & 1023u)) * (1 / 1023.0f) + ((float)b - f.y);
        lom_float dz = lom_to_float((lom_int)(h >> 20 & 1023u)) * (1 / 1023.0f) + ((float)c - f.z);
        nearest = lom_min(nearest, dx * dx + dy * dy + dz * dz);
    }
    return lom_sqrt(nearest);
}

/* Octaves of gradient noise, each of half the amplitude, divided by the sum of amplitudes. */
LOM_INLINE lom_float lom_gradient_octaves(lom_float3 p, int count, int32_t mask, uint32_t seed)
{
    lom_float sum = { 0 };
    float amplitude = 1, total = 0, frequency = 1;
    for (int i = 0; i < count; i++) {
        lom_float3 q = lom_scale3(p, lom_splat(frequency));
        sum += lom_gradient_noise(q, mask, seed + (uint32_t)i) * amplitude;
        total += amplitude;
        amplitude *= 0.5f;
        frequency *= 2;
        mask = mask == -1 ? -1 : mask * 2 + 1;
    }
    return sum * (1 / total);
}

/* Octaves of 1 - distance: round tops and sharp creases, mean about 0.45. */
LOM_INLINE lom_float lom_billow_octaves(lom_float3 p, int count, int32_t mask, uint32_t seed)
{
    lom_float sum = { 0 };
    float amplitude = 1, total = 0, frequency = 1;
    for (int i = 0; i < count; i++) {
        lom_float3 q = lom_scale3(p, lom_splat(frequency));
        sum += (1.0f - lom_cellular_noise(q, mask, seed + (uint32_t)i)) * amplitude;
        total += amplitude;
        amplitude *= 0.5f;
        frequency *= 2;
        mask = mask == -1 ? -1 : mask * 2 + 1;
    }
    return sum * (1 / total);
}

#endif
