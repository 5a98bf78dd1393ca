/* Proves that what shapes of clouds leave out changes no bit: cellular noise that passes over cells against all 27 of them,
 * gradient noise whose places share corners against each with its own, at random places, on and beside lattice lines, far from the origin, with lattices that repeat; and rows of heaps, whose far
 * bubbles and billows are left out, against every bubble and every billow. */
#include "check.h"
#include "cloud/cloud_noise.h"
#include "cloud/shape.h"

#include <lom/base.h>

static uint64_t drawn;

static float random_float(float low, float high)
{
    return low + (high - low) * (float)lom_random_uniform(7, drawn++);
}

/* ---- as they are defined ---- */

static lom_float plain_cellular(lom_float3 p, int32_t mask, uint32_t seed)
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

static lom_float plain_gradient(lom_float3 p, int32_t mask, uint32_t seed)
{
    const lom_float3 below = { lom_floor(p.x), lom_floor(p.y), lom_floor(p.z) }, f = lom_sub3(p, below);
    const lom_int x = lom_to_int(below.x), y = lom_to_int(below.y), z = lom_to_int(below.z);
    lom_float corner[8];
    for (int i = 0; i < 8; i++) {
        const int a = i & 1, b = i >> 1 & 1, c = i >> 2;
        const lom_uint h = lom_hash_cell((x + a) & mask, (y + b) & mask, (z + c) & mask, seed);
        corner[i] = lom_hash_signed(h) * (f.x - (float)a) + lom_hash_signed(h >> 10) * (f.y - (float)b) +
                    lom_hash_signed(h >> 20) * (f.z - (float)c);
    }
    const lom_float u = lom_fade(f.x), v = lom_fade(f.y), w = lom_fade(f.z);
    const lom_float near = lom_mix(lom_mix(corner[0], corner[1], u), lom_mix(corner[2], corner[3], u), v);
    const lom_float far = lom_mix(lom_mix(corner[4], corner[5], u), lom_mix(corner[6], corner[7], u), v);
    return lom_mix(near, far, w) * 1.3f;
}

static lom_float plain_billows(lom_float3 p, uint32_t seed)
{
    lom_float sum = { 0 };
    float amplitude = 1, total = 0, frequency = 1;
    for (uint32_t i = 0; i < 5; i++) {
        sum += (1.0f - plain_cellular(lom_scale3(p, lom_splat(frequency)), -1, seed + i)) * amplitude;
        total += amplitude;
        amplitude *= 0.5f;
        frequency *= 2;
    }
    return sum * (1 / total);
}

static lom_float plain_depth(const struct lom_cloud_body *body, lom_float3 p)
{
    lom_float depth = lom_splat(-1e9f);
    for (int i = 0; i < body->bubble_count; i++) {
        const struct lom_cloud_bubble *b = &body->bubble[i];
        lom_float dx = p.x - b->x, dy = (p.y - b->y) * b->flatness, dz = p.z - b->z;
        depth = lom_max(depth, (b->radius - lom_sqrt(dx * dx + dy * dy + dz * dz)) * (1 / b->flatness));
    }
    return depth;
}

static lom_float plain_heap(const struct lom_cloud_shape *shape, lom_float3 p)
{
    const struct lom_cloud_body *body = shape->body;
    const float reach = body->billow + body->softness + body->warp;
    lom_float depth = plain_depth(body, p);
    if (!lom_any((depth > -reach) & (p.y > body->base - body->base_depth)))
        return (lom_float){ 0 };
    if (lom_any(depth < reach)) {
        const lom_float3 slow = lom_scale3(p, lom_splat(1 / body->warp_size));
        const lom_float3 noise = { lom_gradient_octaves(slow, 2, -1, shape->seed),
                                   lom_gradient_octaves(slow, 2, -1, shape->seed + 101),
                                   lom_gradient_octaves(slow, 2, -1, shape->seed + 202) };
        const lom_float3 moved = lom_add3(p, lom_scale3(noise, lom_splat(body->warp)));
        const lom_float billow = plain_billows(lom_scale3(moved, lom_splat(1 / body->billow_size)), shape->seed + 7);
        depth = plain_depth(body, moved) + body->billow * (2.2f * (billow - 0.45f));
    }
    lom_float density = lom_smoothstep((lom_float){ 0 }, lom_splat(body->softness), depth);
    lom_float3 flat = { p.x, { 0 }, p.z };
    lom_float uneven =
        lom_gradient_octaves(lom_scale3(flat, lom_splat(1.6f / body->billow_size)), 3, -1, shape->seed + 31);
    lom_float above = p.y - body->base + uneven * (0.7f * body->base_depth);
    density = density * lom_smoothstep((lom_float){ 0 }, lom_splat(body->base_depth), above);
    lom_float height = lom_saturate((p.y - body->base) * (1 / (0.6f * shape->size[1])));
    return density * lom_mix(lom_splat(body->thin), lom_splat(1.0f), height);
}

/* Falls to 0 towards the faces of the box. */
static lom_float plain_border(lom_float at)
{
    return lom_smoothstep((lom_float){ 0 }, lom_splat(0.03f), 0.5f - lom_abs(at - 0.5f));
}

/* A voxel at a time: what lies in a packet beside it makes no difference. */
static void plain_row(uint16_t *row, const struct lom_cloud_shape *shape, int y, int z)
{
    const int *n = shape->voxels;
    const float inner_y = ((float)y + 0.5f) / (float)n[1], inner_z = ((float)z + 0.5f) / (float)n[2];
    const bool is_outermost = y == 0 || y == n[1] - 1 || z == 0 || z == n[2] - 1;
    for (int x = 0; x < n[0]; x++) {
        const lom_float inner_x = lom_splat(((float)x + 0.5f) / (float)n[0]);
        const lom_float3 p = { inner_x * shape->size[0], lom_splat(inner_y * shape->size[1]),
                               lom_splat(inner_z * shape->size[2]) };
        const lom_float edge = plain_border(inner_x) * plain_border(lom_splat(inner_z));
        const lom_float density = lom_max(plain_heap(shape, p), (lom_float){ 0 }) * edge;
        const lom_int words = lom_to_int(lom_saturate(density) * 65535.0f + 0.5f);
        row[x] = is_outermost || x == 0 || x == n[0] - 1 ? 0 : (uint16_t)words[0];
    }
}

/* ---- the tests ---- */

static float random_place(void)
{
    const float scale = lom_random_uniform(8, drawn) < 0.2 ? 0x1p22f : 50;
    float at = random_float(-scale, scale);
    switch (drawn % 5) {
    case 0:
        return __builtin_rintf(at);
    case 1:
        return __builtin_rintf(at) - 0x1p-20f;
    default:
        return at;
    }
}

static void cellular_noise_is_that_of_all_cells(void)
{
    for (int k = 0; k < 100000; k++) {
        const int32_t mask = k % 3 == 0 ? 3 : -1;
        const float spread = k % 2 == 0 ? 0.1f : 3;
        const float at[3] = { random_place(), random_place(), random_place() };
        lom_float3 p = { lom_splat(at[0]), lom_splat(at[1]), lom_splat(at[2]) };
        for (int i = 1; i < LOM_LANES; i++) {
            p.x[i] += random_float(-spread, spread);
            p.y[i] += random_float(-spread, spread);
            p.z[i] += random_float(-spread, spread);
        }
        const lom_float found = lom_cellular_noise(p, mask, (uint32_t)k),
                        expected = plain_cellular(p, mask, (uint32_t)k);
        CHECK(memcmp(&found, &expected, sizeof found) == 0, "packet %d near %g, %g, %g", k, (double)at[0],
              (double)at[1], (double)at[2]);
    }
}

/* Rows of places within a few cells of each other, which share their corners or just do not, and others. */
static void gradient_noise_is_that_of_all_corners(void)
{
    for (int k = 0; k < 100000; k++) {
        const int32_t mask = k % 3 == 0 ? 3 : -1;
        const float spread = k % 7 == 0 ? 9 : k % 2 == 0 ? 2.5f : 0.7f;
        lom_float3 p = { lom_splat(random_place()), lom_splat(random_place()), lom_splat(random_place()) };
        for (int i = 1; i < LOM_LANES; i++) {
            p.x[i] += random_float(k % 5 == 0 ? -spread : 0, spread);
            if (k % 11 == 0)
                p.y[i] += random_float(0, spread);
            if (k % 13 == 0)
                p.z[i] += random_float(0, spread);
        }
        const lom_float found = lom_gradient_noise(p, mask, (uint32_t)k),
                        expected = plain_gradient(p, mask, (uint32_t)k);
        CHECK(memcmp(&found, &expected, sizeof found) == 0, "packet %d near %g, %g, %g", k, (double)p.x[0],
              (double)p.y[0], (double)p.z[0]);
    }
}

/* Warped more than it is soft, and steep, noise carries places through all of the reach. */
static struct lom_cloud_body random_body(const float size[3], bool warped)
{
    struct lom_cloud_body body = { .bubble_count = 1 + (int)random_float(0, 60),
                                   .base = random_float(0, 0.3f) * size[1],
                                   .base_depth = random_float(10, 60),
                                   .billow = random_float(0, warped ? 3 : 120),
                                   .billow_size = random_float(60, 300),
                                   .warp = warped ? random_float(50, 200) : random_float(0, 120),
                                   .warp_size = warped ? random_float(400, 1500) : random_float(100, 500),
                                   .softness = warped ? random_float(1, 20) : random_float(10, 120),
                                   .thin = random_float(0.2f, 1) };
    for (int i = 0; i < body.bubble_count; i++)
        body.bubble[i] =
            (struct lom_cloud_bubble){ random_float(0, size[0]), random_float(0, size[1]), random_float(0, size[2]),
                                       random_float(5, 300), random_float(warped ? 0.3f : 0.5f, warped ? 0.6f : 3) };
    return body;
}

static void rows_are_those_of_all_bubbles_and_billows(void)
{
    enum { X = 83, Y = 20, Z = 24 };
    uint16_t found[X], expected[X];
    size_t full = 0, empty = 0;
    for (uint32_t k = 0; k < 40; k++) {
        struct lom_cloud_shape shape = { .voxels = { X, Y, Z },
                                         .size = { random_float(300, 2000), random_float(200, 900),
                                                   random_float(300, 2000) },
                                         .seed = k };
        const struct lom_cloud_body body = random_body(shape.size, k % 2 == 1);
        shape.body = &body;
        for (int y = 0; y < Y; y++)
            for (int z = (int)k % 3; z < Z; z += 3) {
                LOM_WIDE(lom_shape_row)(found, &shape, y, z);
                plain_row(expected, &shape, y, z);
                CHECK(memcmp(found, expected, sizeof found) == 0, "row %d, %d of body %u", y, z, k);
                for (int x = 0; x < X; x++) {
                    full += found[x] > 60000;
                    empty += found[x] == 0;
                }
            }
    }
    CHECK(full > 1000 && empty > 1000, "%zu voxels are full and %zu empty", full, empty);
}

int main(int argc, char **argv)
{
    RUN(cellular_noise_is_that_of_all_cells);
    RUN(gradient_noise_is_that_of_all_corners);
    RUN(rows_are_those_of_all_bubbles_and_billows);
    return check_result();
}
