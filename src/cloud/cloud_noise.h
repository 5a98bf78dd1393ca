/* Noise over lanes for clouds: gradient noise (Perlin 2002) and cellular noise (Worley 1996), of a hash by arithmetic,
 * so that any place of an endless lattice is as near as any other. `mask` wraps lattice lines: 2^n - 1 repeats after
 * 2^n cells, -1 never. Coordinates within +-2^22. */
#ifndef LOM_CLOUD_NOISE_H
#define LOM_CLOUD_NOISE_H

#include <lom/lanes.h>

/* What a lattice line along each axis puts into the hash of a cell, and that of a cell whose lines and seed are put together
 * by exclusive or; the finalizer is Ettinger's (three multiplications of full avalanche). */
static const uint32_t lom_lattice[3] = { 0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du };

LOM_INLINE lom_uint lom_finish_hash(lom_uint h)
{
    h ^= h >> 16;
    h *= 0x21f0aaadu;
    h ^= h >> 15;
    h *= 0x735a2d97u;
    return h ^ h >> 15;
}

LOM_INLINE lom_uint lom_hash_cell(lom_int x, lom_int y, lom_int z, uint32_t seed)
{
    return lom_finish_hash((lom_uint)x * lom_lattice[0] ^ (lom_uint)y * lom_lattice[1] ^ (lom_uint)z * lom_lattice[2] ^
                           seed);
}

/* Ten bits as a number in [-1, 1]. */
LOM_INLINE lom_float lom_hash_signed(lom_uint h)
{
    return lom_to_float((lom_int)(h & 1023u)) * (2.0f / 1023.0f) - 1.0f;
}

/* The gradient of a corner of a cell. */
LOM_INLINE lom_float3 lom_gradient_of(lom_uint h)
{
    return (lom_float3){ lom_hash_signed(h), lom_hash_signed(h >> 10), lom_hash_signed(h >> 20) };
}

/* Rows of four corners of the lattice, y and z of each by its number (lom_gradient_noise): what places share that lie in
 * three cells along x and one along y and z. Only 16 lanes hold four rows, and have permutations of them. */
#if LOM_LANES == 16 && !defined LOM_LOWERED
enum { LOM_SHARES_GRADIENTS = true };
#else
enum { LOM_SHARES_GRADIENTS = false };
#endif

LOM_INLINE bool lom_share_gradients(lom_int x, lom_int y, lom_int z, int32_t mask, uint32_t seed, lom_float3 *shared)
{
    if (!LOM_SHARES_GRADIENTS)
        return false;
    const lom_int first[3] = { lom_splat_int(x[0]), lom_splat_int(y[0]), lom_splat_int(z[0]) };
    if (!lom_all(((lom_uint)(x - first[0]) < 3u) & (y == first[1]) & (z == first[2])))
        return false;
    const lom_int lane = lom_lane_index();
    *shared = lom_gradient_of(lom_hash_cell((first[0] + (lane & 3)) & mask, (first[1] + (lane >> 2 & 1)) & mask,
                                            (first[2] + (lane >> 3)) & mask, seed));
    return true;
}

LOM_INLINE lom_float3 lom_permute3(lom_float3 v, lom_int which)
{
    return (lom_float3){ lom_permute(v.x, which), lom_permute(v.y, which), lom_permute(v.z, which) };
}

LOM_INLINE lom_float lom_gradient_corner(lom_float3 gradient, lom_float3 from)
{
    return gradient.x * from.x + gradient.y * from.y + gradient.z * from.z;
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
    lom_float3 shared;
    const bool shares = lom_share_gradients(x, y, z, mask, seed, &shared);
    lom_float row[4];
    for (int i = 0; i < 4; i++) {
        lom_int j = (y + (i & 1)) & mask, k = (z + (i >> 1)) & mask;
        lom_float3 from = { f.x, f.y - (float)(i & 1), f.z - (float)(i >> 1) }, gradient[2];
        for (int a = 0; a < 2; a++)
            gradient[a] = shares ? lom_permute3(shared, x - x[0] + (4 * i + a))
                                 : lom_gradient_of(lom_hash_cell((x + a) & mask, j, k, seed));
        lom_float low = lom_gradient_corner(gradient[0], from);
        from.x = f.x - 1.0f;
        row[i] = lom_mix(low, lom_gradient_corner(gradient[1], from), lom_fade(f.x));
    }
    lom_float v = lom_fade(f.y);
    return lom_mix(lom_mix(row[0], row[1], v), lom_mix(row[2], row[3], v), lom_fade(f.z)) * 1.3f;
}

/* Along one axis, of the cell before that of a place, its own and the one after it: what their lines put into a hash, where
 * they begin as the place sees it, and how far apart a point of theirs is at least, squared. A point is at most `most` from
 * where its cell begins and every operation that finds its distance rounds monotonously, so no rounding undercuts that. */
struct lom_cell_lines {
    lom_uint line[3];
    lom_float begin[3], away[3];
};

LOM_INLINE struct lom_cell_lines lom_find_cell_lines(lom_float at, int32_t mask, uint32_t lattice)
{
    const float most = 1023.0f * (1 / 1023.0f);
    const lom_float below = lom_floor(at), inside = at - below;
    const lom_int cell = lom_to_int(below);
    struct lom_cell_lines l;
    for (int i = 0; i < 3; i++) {
        l.line[i] = (lom_uint)((cell + (i - 1)) & mask) * lattice;
        l.begin[i] = (float)(i - 1) - inside;
    }
    const lom_float before = lom_max(-(most + l.begin[0]), (lom_float){ 0 });
    const lom_float after = lom_max(l.begin[2], (lom_float){ 0 });
    l.away[0] = before * before;
    l.away[1] = (lom_float){ 0 };
    l.away[2] = after * after;
    return l;
}

/* Distance to the nearest of the lattice's points, one a cell, in cells. Of the 27 cells about a place those along x are
 * passed over where in no lane any of them can have a nearer point; rows that lie nearer come first. */
LOM_INLINE lom_float lom_cellular_noise(lom_float3 p, int32_t mask, uint32_t seed)
{
    static const uint8_t rows[9][2] = { { 1, 1 }, { 0, 1 }, { 2, 1 }, { 1, 0 }, { 1, 2 },
                                        { 0, 0 }, { 2, 0 }, { 0, 2 }, { 2, 2 } };
    const struct lom_cell_lines x = lom_find_cell_lines(p.x, mask, lom_lattice[0]);
    const struct lom_cell_lines y = lom_find_cell_lines(p.y, mask, lom_lattice[1]);
    const struct lom_cell_lines z = lom_find_cell_lines(p.z, mask, lom_lattice[2]);
    lom_float nearest = lom_splat(9.0f);
    for (int i = 0; i < 9; i++) {
        const int b = rows[i][0], c = rows[i][1];
        if (!lom_any(y.away[b] + z.away[c] < nearest))
            continue;
        const lom_uint lines = y.line[b] ^ z.line[c] ^ seed;
        for (int a = 0; a < 3; a++) {
            const lom_uint h = lom_finish_hash(x.line[a] ^ lines);
            lom_float dx = lom_to_float((lom_int)(h & 1023u)) * (1 / 1023.0f) + x.begin[a];
            lom_float dy = lom_to_float((lom_int)(h >> 10 & 1023u)) * (1 / 1023.0f) + y.begin[b];
            lom_float dz = lom_to_float((lom_int)(h >> 20 & 1023u)) * (1 / 1023.0f) + z.begin[c];
            nearest = lom_min(nearest, dx * dx + dy * dy + dz * dz);
        }
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
