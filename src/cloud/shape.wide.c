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

/* Bubbles side by side, so that LOM_LANES of them are looked at together. */
struct bubbles {
    int count;
    float x[LOM_MAX_BUBBLES], y[LOM_MAX_BUBBLES], z[LOM_MAX_BUBBLES], radius[LOM_MAX_BUBBLES],
        flatness[LOM_MAX_BUBBLES];
};

/* Of a body: those that a row of voxels comes near, and all. */
struct heap {
    struct bubbles near, all;
};

/* How far from the surface of its bubbles, to both sides, warp, billows and softness are felt; beyond it there is nothing, or all of
 * a body. */
static float reach_of(const struct lom_cloud_body *body)
{
    return body->billow + body->softness + body->warp;
}

/* How far from its middle, as a bubble has it, its surface is more than `outside` away: a thousandth is more than what is
 * rounded. */
LOM_INLINE lom_float far_from(lom_float radius, lom_float flatness, float outside)
{
    return 1.001f * (radius + outside * flatness);
}

static void add_bubble(struct bubbles *to, const struct lom_cloud_bubble *b)
{
    to->x[to->count] = b->x;
    to->y[to->count] = b->y;
    to->z[to->count] = b->z;
    to->radius[to->count] = b->radius;
    to->flatness[to->count++] = b->flatness;
}

static void find_bubbles(const struct lom_cloud_body *body, float y, float z, struct heap *found)
{
    const float outside = reach_of(body);
    found->near.count = found->all.count = 0;
    for (int i = 0; i < body->bubble_count; i++) {
        const struct lom_cloud_bubble *b = &body->bubble[i];
        const float dy = (y - b->y) * b->flatness, dz = z - b->z, reach = 1.001f * (b->radius + outside * b->flatness);
        add_bubble(&found->all, b);
        if (dy * dy + dz * dz < reach * reach)
            add_bubble(&found->near, b);
    }
}

/* The box about a packet's places. */
struct box {
    float low[3], high[3];
};

static struct box box_about(lom_float3 p)
{
    struct box box;
    float at[3][LOM_LANES];
    lom_store(at[0], p.x);
    lom_store(at[1], p.y);
    lom_store(at[2], p.z);
    for (int k = 0; k < 3; k++) {
        box.low[k] = box.high[k] = at[k][0];
        for (int i = 1; i < LOM_LANES; i++) {
            box.low[k] = at[k][i] < box.low[k] ? at[k][i] : box.low[k];
            box.high[k] = at[k][i] > box.high[k] ? at[k][i] : box.high[k];
        }
    }
    return box;
}

LOM_INLINE lom_float beside(const struct box *box, int axis, lom_float middle)
{
    return lom_max(lom_max(box->low[axis] - middle, middle - box->high[axis]), (lom_float){ 0 });
}

/* Those of LOM_LANES bubbles from `first` on that reach into a box from `outside`, a bit each. No place in the box is nearer than the
 * box, whatever is rounded: each operation is monotonous, and they are those of depth_inside. */
static uint32_t reaching_in(const struct bubbles *b, int first, const struct box *box, float outside)
{
    const lom_float dx = beside(box, 0, lom_load(b->x + first)), dz = beside(box, 2, lom_load(b->z + first));
    const lom_float flatness = lom_load(b->flatness + first);
    const lom_float dy = beside(box, 1, lom_load(b->y + first)) * flatness;
    const lom_float reach = far_from(lom_load(b->radius + first), flatness, outside);
    const lom_mask there = lom_lane_index() < b->count - first;
    return lom_bits((dx * dx + dy * dy + dz * dz < reach * reach) & there);
}

/* Metres inside the union of the bubbles; negative outside. Where it would be less than -outside it may be any number that
 * is. */
static lom_float depth_inside(const struct bubbles *b, lom_float3 p, float outside)
{
    const struct box box = box_about(p);
    lom_float depth = lom_splat(-1e9f);
    for (int first = 0; first < b->count; first += LOM_LANES)
        for (uint32_t bits = reaching_in(b, first, &box, outside); bits != 0; bits &= bits - 1) {
            const int i = first + __builtin_ctz(bits);
            const lom_float dx = p.x - b->x[i], dy = (p.y - b->y[i]) * b->flatness[i], dz = p.z - b->z[i];
            const lom_float square = dx * dx + dy * dy + dz * dz;
            depth = lom_max(depth, (b->radius[i] - lom_sqrt(square)) * (1 / b->flatness[i]));
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

/* How far billows swell, in parts of `billow`, of the sum of their octaves of noise. */
LOM_INLINE lom_float swell(lom_float sum, float total)
{
    return 2.2f * (sum * (1 / total) - 0.45f);
}

/* The depth with what five octaves of billows add to it. Their noise is at most 1 and at least 1 - sqrt 3, so they swell between
 * -2.61 and 1.22, and the octaves that are left lie between that much of them: where it is settled for all lanes that a place is
 * empty, or that it is full, its depth is any that is so too. */
static lom_float billowed_depth(const struct lom_cloud_body *body, lom_float3 p, lom_float depth, uint32_t seed)
{
    const lom_float3 q = lom_scale3(p, lom_splat(1 / body->billow_size));
    const float all = 1.9375f, unsure = 1e-3f * (body->billow + body->softness);
    lom_float sum = { 0 };
    float amplitude = 1, left = all, frequency = 1;
    for (uint32_t i = 0; i < 5; i++) {
        sum += (1.0f - lom_cellular_noise(lom_scale3(q, lom_splat(frequency)), -1, seed + i)) * amplitude;
        left -= amplitude;
        amplitude *= 0.5f;
        frequency *= 2;
        const lom_float highest = depth + body->billow * swell(sum + left, all);
        const lom_float lowest = depth + body->billow * swell(sum - 0.74f * left, all);
        if (i < 4 && lom_all((highest < -unsure) | (lowest > body->softness + unsure)))
            return lom_select(highest < 0.0f, highest, lowest);
    }
    return depth + body->billow * swell(sum, all);
}

/* The depth of the place that slow noise moves p to, and what billows add to it; where that is no body any number below 0,
 * where it is full any that is as deep. */
static lom_float displaced_depth(const struct lom_cloud_shape *shape, const struct heap *heap, lom_float3 p)
{
    const struct lom_cloud_body *body = shape->body;
    const lom_float3 moved =
        lom_add3(p, lom_scale3(slow_noise(p, body->warp_size, shape->seed), lom_splat(body->warp)));
    const lom_float depth = depth_inside(&heap->all, moved, 1.25f * body->billow);
    if (!lom_any(depth > -1.25f * body->billow))
        return lom_splat(-1e9f);
    if (!lom_any(depth < body->softness + 2.7f * body->billow))
        return depth;
    return billowed_depth(body, moved, depth, shape->seed + 7);
}

/* The tower alone. Noise may move a place further than `warp`, so beyond the reach it is a lane's own depth that decides, whatever
 * its neighbours need. */
static lom_float heap_density(const struct lom_cloud_shape *shape, const struct heap *heap, lom_float3 p)
{
    const struct lom_cloud_body *body = shape->body;
    float reach = reach_of(body);
    lom_float depth = depth_inside(&heap->near, p, reach);
    const lom_mask near = (depth > -reach) & (p.y > body->base - body->base_depth);
    if (!lom_any(near))
        return (lom_float){ 0 };
    if (lom_any(near & (depth < reach)))
        depth = lom_select(depth < reach, displaced_depth(shape, heap, p), depth);
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

static lom_float body_density(const struct lom_cloud_shape *shape, const struct heap *heap, lom_float3 p)
{
    return lom_max(heap_density(shape, heap, p), anvil_density(shape, p));
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
    struct heap heap;
    if (shape->body != NULL)
        find_bubbles(shape->body, inner_y * shape->size[1], inner_z * shape->size[2], &heap);
    for (int x = 0; x < n[0]; x += LOM_LANES) {
        lom_int voxel = lom_lane_index() + x;
        lom_float inner_x = (lom_to_float(voxel) + 0.5f) / (float)n[0];
        lom_float density = { 0 };
        if (!outermost) {
            lom_float3 p = { inner_x * shape->size[0], lom_splat(inner_y * shape->size[1]),
                             lom_splat(inner_z * shape->size[2]) };
            density = shape->body != NULL ? body_density(shape, &heap, p) : layer_density(shape, p);
            density = density * (border(inner_x, share) * border(lom_splat(inner_z), share));
            density = lom_select((voxel == 0) | (voxel == n[0] - 1), (lom_float){ 0 }, density);
        }
        int32_t words[LOM_LANES];
        lom_store_int(words, lom_to_int(lom_saturate(density) * 65535.0f + 0.5f));
        for (int i = 0; i < LOM_LANES && x + i < n[0]; i++)
            row[x + i] = (uint16_t)words[i];
    }
}
