/* The densities of Perlin-Worley shapes, a row of voxels at a time. In: a shape. Out: 16-bit densities.
 *
 * A body is where s = max over its bubbles of (radius - distance) is above 0, displaced by billows: octaves of inverted
 * cellular noise (Worley 1996; Schneider and Vos 2015 for clouds), which swell round and crease sharply. A layer is
 * where noise exceeds a threshold set by the coverage, times a profile over its height.
 *
 * Invariant: the density is 0 in the outermost voxels, so that no cloud ends in a wall. */
#include "cloud/shape.h"
#include "cloud/cloud_noise.h"

/* A vector of slow noise. */
static lom_float3 slow_noise(lom_float3 p, float size, uint32_t seed)
{
    lom_float3 q = lom_scale3(p, lom_splat(1 / size));
    return (lom_float3){ lom_gradient_octaves(q, 2, -1, seed), lom_gradient_octaves(q, 2, -1, seed + 101),
                         lom_gradient_octaves(q, 2, -1, seed + 202) };
}

/* Bubbles of a body: those that a row of voxels comes near, and all. */
struct bubbles {
    int near_count, count;
    const struct lom_cloud_bubble *near[LOM_MAX_BUBBLES], *all[LOM_MAX_BUBBLES];
};

/* How far from the surface of its bubbles, to both sides, warp, billows and softness are felt; beyond it there is nothing, or all of
 * a body. */
static float reach_of(const struct lom_cloud_body *body)
{
    return body->billow + body->softness + body->warp;
}

/* The square of a distance, as a bubble has it, from which on its surface is more than `outside` away: a thousandth is more
 * than what is rounded. */
static float square_of_reach(const struct lom_cloud_bubble *b, float outside)
{
    const float reach = 1.001f * (b->radius + outside * b->flatness);
    return reach * reach;
}

static void find_bubbles(const struct lom_cloud_body *body, float y, float z, struct bubbles *found)
{
    const float reach = reach_of(body);
    found->near_count = 0;
    found->count = body->bubble_count;
    for (int i = 0; i < body->bubble_count; i++) {
        const struct lom_cloud_bubble *b = found->all[i] = &body->bubble[i];
        const float dy = (y - b->y) * b->flatness, dz = z - b->z;
        if (dy * dy + dz * dz < square_of_reach(b, reach))
            found->near[found->near_count++] = b;
    }
}

/* Metres inside the union of the bubbles; negative outside. Where it would be less than -outside it may be any number that
 * is. */
static lom_float depth_inside(const struct lom_cloud_bubble *const *bubbles, int count, lom_float3 p, float outside)
{
    lom_float depth = lom_splat(-1e9f);
    for (int i = 0; i < count; i++) {
        const struct lom_cloud_bubble *b = bubbles[i];
        lom_float dx = p.x - b->x, dy = (p.y - b->y) * b->flatness, dz = p.z - b->z;
        lom_float square = dx * dx + dy * dy + dz * dz;
        if (!lom_any(square < square_of_reach(b, outside)))
            continue;
        depth = lom_max(depth, (b->radius - lom_sqrt(square)) * (1 / b->flatness));
    }
    return depth;
}

/* The plate is a fifth of `thickness` thick at its rim and all of it at the tower, which widens into it. Fibres along
 * the wind fray its rim, and it thins out towards it; low billows hang from it. */
static lom_float anvil_density(const struct lom_cloud_shape *shape, lom_float3 p)
{
    const struct lom_cloud_anvil *a = &shape->body->anvil;
    float billow_size = 0.6f * a->thickness, soft = 0.13f * a->thickness;
    if (a->radius == 0 || !lom_any((p.y > a->height - 1.5f * a->thickness) & (p.y < a->height + soft)))
        return (lom_float){ 0 };
    lom_float3 moved =
        lom_add3(p, lom_scale3(slow_noise(p, 0.8f * a->radius, shape->seed + 40), lom_splat(0.1f * a->radius)));
    lom_float dx = (moved.x - a->x) * (1 / (a->radius * a->drawn)), dz = (moved.z - a->z) * (1 / a->radius);
    lom_float r = lom_sqrt(dx * dx + dz * dz);
    lom_float3 along = { moved.x * (1.1f / a->radius), moved.y * (1.5f / a->radius), moved.z * (9.0f / a->radius) };
    lom_float rim = 1.0f - r + 0.55f * lom_gradient_octaves(along, 4, -1, shape->seed + 50);
    if (!lom_any(rim > 0.0f))
        return (lom_float){ 0 };
    lom_float inner = lom_max(1.0f - r, (lom_float){ 0 }), core = lom_max(1.0f - 1.35f * r, (lom_float){ 0 });
    lom_float lower = a->height - a->thickness * (0.18f + 0.1f * inner + 0.72f * core * core);
    lom_float billow = lom_billow_octaves(lom_scale3(moved, lom_splat(1 / billow_size)), 4, -1, shape->seed + 60);
    lom_float depth = lom_min(a->height - moved.y, moved.y - lower) + 0.35f * a->thickness * (billow - 0.45f) * inner;
    return lom_smoothstep((lom_float){ 0 }, lom_splat(soft), depth) *
           lom_smoothstep((lom_float){ 0 }, lom_splat(0.5f), rim) * (0.45f + 0.55f * inner);
}

/* How far billows swell, in parts of `billow`: their noise is at most 1 and at least 1 - sqrt 3, so this is between -2.61 and
 * 1.22. What lies further outside than that is empty, and further inside than that and the soft edge full. */
static lom_float swell(const struct lom_cloud_body *body, lom_float3 p, uint32_t seed)
{
    return 2.2f * (lom_billow_octaves(lom_scale3(p, lom_splat(1 / body->billow_size)), 5, -1, seed) - 0.45f);
}

/* The depth of the place that slow noise moves p to, and what billows add to it; where that is no body any number below 0,
 * where it is full any that is as deep. */
static lom_float displaced_depth(const struct lom_cloud_shape *shape, const struct bubbles *bubbles, lom_float3 p)
{
    const struct lom_cloud_body *body = shape->body;
    const lom_float3 moved =
        lom_add3(p, lom_scale3(slow_noise(p, body->warp_size, shape->seed), lom_splat(body->warp)));
    const lom_float depth = depth_inside(bubbles->all, bubbles->count, moved, 1.25f * body->billow);
    if (!lom_any(depth > -1.25f * body->billow))
        return lom_splat(-1e9f);
    if (!lom_any(depth < body->softness + 2.7f * body->billow))
        return depth;
    return depth + body->billow * swell(body, moved, shape->seed + 7);
}

/* The tower alone. Noise may move a place further than `warp`, so beyond the reach it is a lane's own depth that decides, whatever
 * its neighbours need. */
static lom_float heap_density(const struct lom_cloud_shape *shape, const struct bubbles *bubbles, lom_float3 p)
{
    const struct lom_cloud_body *body = shape->body;
    float reach = reach_of(body);
    lom_float depth = depth_inside(bubbles->near, bubbles->near_count, p, reach);
    const lom_mask near = (depth > -reach) & (p.y > body->base - body->base_depth);
    if (!lom_any(near))
        return (lom_float){ 0 };
    if (lom_any(near & (depth < reach)))
        depth = lom_select(depth < reach, displaced_depth(shape, bubbles, p), depth);
    depth = lom_select(near, depth, lom_splat(-1e9f));
    lom_float density = lom_smoothstep((lom_float){ 0 }, lom_splat(body->softness), depth);
    lom_float3 flat = { p.x, { 0 }, p.z };
    lom_float uneven =
        lom_gradient_octaves(lom_scale3(flat, lom_splat(1.6f / body->billow_size)), 3, -1, shape->seed + 31);
    lom_float above = p.y - body->base + uneven * (0.7f * body->base_depth);
    density = density * lom_smoothstep((lom_float){ 0 }, lom_splat(body->base_depth), above);
    lom_float height = lom_saturate((p.y - body->base) * (1 / (0.6f * shape->size[1])));
    return density * lom_mix(lom_splat(body->thin), lom_splat(1.0f), height);
}

static lom_float body_density(const struct lom_cloud_shape *shape, const struct bubbles *bubbles, lom_float3 p)
{
    return lom_max(heap_density(shape, bubbles, p), anvil_density(shape, p));
}

static lom_float layer_density(const struct lom_cloud_shape *shape, lom_float3 p)
{
    const struct lom_cloud_layer *layer = shape->layer;
    lom_float height = p.y * (1 / shape->size[1]);
    lom_float profile = lom_smoothstep((lom_float){ 0 }, lom_splat(layer->rise), height) *
                        (1.0f - lom_smoothstep(lom_splat(1.0f - layer->fall), lom_splat(1.0f), height));
    if (!lom_any(profile > 0.0f))
        return (lom_float){ 0 };
    lom_float3 moved = lom_add3(p, lom_scale3(slow_noise(p, layer->warp_size, shape->seed), lom_splat(layer->warp)));
    moved.x = moved.x + layer->shear * p.y;
    lom_float3 q = { moved.x * (1 / layer->cell[0]), moved.y * (1 / layer->cell[1]), moved.z * (1 / layer->cell[2]) };
    lom_float noise = lom_gradient_octaves(q, 5, -1, shape->seed + 3);
    noise = lom_mix(0.5f + 0.9f * noise, 1.0f - 2.4f * lom_abs(noise), lom_splat(layer->streak));
    if (layer->billow_share > 0) {
        lom_float billow = 1.7f * lom_billow_octaves(q, 3, -1, shape->seed + 7) - 0.28f;
        noise = lom_mix(noise, billow, lom_splat(layer->billow_share));
    }
    lom_float3 wide = { p.x * (1 / layer->patch_size), { 0 }, p.z * (1 / layer->patch_size) };
    lom_float patch = lom_gradient_octaves(wide, 3, -1, shape->seed + 57);
    lom_float threshold = 1.0f - layer->coverage - layer->patch * patch;
    /* where the layer is thin (low profile) more noise is needed: domes above, a flat base below */
    lom_float excess = (noise - threshold - 0.35f * (1.0f - profile)) * layer->contrast;
    return lom_saturate(excess) * lom_saturate(profile * 3.0f);
}

/* Falls to 0 towards the faces of the box, over `share` of the side. */
static lom_float border(lom_float at, float share)
{
    lom_float from_face = 0.5f - lom_abs(at - 0.5f);
    return lom_smoothstep((lom_float){ 0 }, lom_splat(share), from_face);
}

void LOM_WIDE(lom_shape_row)(uint16_t *row, const struct lom_cloud_shape *shape, int y, int z)
{
    const int *n = shape->voxels;
    float share = shape->layer != NULL ? 0.14f : 0.03f;
    float inner_y = ((float)y + 0.5f) / (float)n[1], inner_z = ((float)z + 0.5f) / (float)n[2];
    bool outermost = (y == 0 || y == n[1] - 1 || z == 0 || z == n[2] - 1) && n[1] > 2 && n[2] > 2;
    struct bubbles bubbles;
    if (shape->body != NULL)
        find_bubbles(shape->body, inner_y * shape->size[1], inner_z * shape->size[2], &bubbles);
    for (int x = 0; x < n[0]; x += LOM_LANES) {
        lom_int voxel = lom_lane_index() + x;
        lom_float inner_x = (lom_to_float(voxel) + 0.5f) / (float)n[0];
        lom_float density = { 0 };
        if (!outermost) {
            lom_float3 p = { inner_x * shape->size[0], lom_splat(inner_y * shape->size[1]),
                             lom_splat(inner_z * shape->size[2]) };
            density = shape->body != NULL ? body_density(shape, &bubbles, p) : layer_density(shape, p);
            density = density * (border(inner_x, share) * border(lom_splat(inner_z), share));
            density = lom_select((voxel == 0) | (voxel == n[0] - 1), (lom_float){ 0 }, density);
        }
        int32_t words[LOM_LANES];
        lom_store_int(words, lom_to_int(lom_saturate(density) * 65535.0f + 0.5f));
        for (int i = 0; i < LOM_LANES && x + i < n[0]; i++)
            row[x + i] = (uint16_t)words[i];
    }
}
