/* Proves terrain's levels of detail: at 0 pixels every quad is drawn; at any error each block is covered exactly once,
 * neighbours are at most one level apart and share the very vertices of their edge, so there is no crack; a level's
 * error is what its surface is really off; a plane is as coarse as can be. And the visibility of the sky, against its
 * closed forms. Which blocks a view sees. */
#include "check.h"

#include "geometry/terrain.h"
#include "render/ground/ground.h"
#include "render/seen.h"

enum { SIZE = 150 }; /* vertices: no whole number of blocks */

static lom_device *device;
static lom_image *map;
static float *map_heights;
static struct lom_ground ground;
static const lom_terrain terrain = { .size = { 300, 200 }, .height = 40, .base = -3 };

static uint16_t rough(int x, int y)
{
    return (uint16_t)(20000 + 9000 * lom_double_sin(x * 0.13) * lom_double_cos(y * 0.07) +
                      3000 * lom_random_uniform(7, (uint64_t)(y * SIZE + x)));
}

static uint16_t tilted(int x, int y)
{
    return (uint16_t)(100 * x + 200 * y);
}

static void load_by(int threads, uint16_t (*height)(int x, int y))
{
    lom_error error = { .code = LOM_OK };
    device = lom_open_device(&(lom_device_desc){ .threads = threads });
    map = lom_create_image(SIZE, SIZE, 1, LOM_FORMAT_R16, &error);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            *(uint16_t *)lom_image_pixel(map, x, y, 0) = height(x, y);
    map_heights = lom_allocate(SIZE * SIZE, sizeof *map_heights, &error);
    CHECK(lom_read_terrain_heights(map, terrain.size, terrain.height, map_heights, &error), "%s", error.text);
    CHECK(lom_make_ground_blocks(&ground, &terrain, map, map_heights,
                                 &(lom_quality){ .ambient_occlusion = true, .mipmaps = true }, device, &error),
          "%s", error.text);
}

static void load(uint16_t (*height)(int x, int y))
{
    load_by(1, height);
}

static void release(void)
{
    lom_free_ground_blocks(&ground);
    lom_release(map_heights);
    lom_free_image(map);
    lom_close_device(device);
}

static void choose(double pixels)
{
    lom_choose_ground(&ground, (lom_vec3){ -160, 30, -90 }, 900, pixels, false);
}

static const struct lom_ground_pattern *pattern_of(int block)
{
    return &ground.patterns[ground.pattern[block]];
}

/* Of a place in the pattern's indices. */
static const float *vertex_of(int block, size_t place)
{
    const uint32_t index = ground.indices[pattern_of(block)->first + place];
    return ground.position[ground.blocks[block].first[ground.level[block]] + index];
}

static void full_density_at_zero_pixels(void)
{
    size_t count = 0;
    load(rough);
    choose(0);
    for (int i = 0; i < ground.across * ground.down; i++)
        count += pattern_of(i)->count;
    CHECK(count == 6 * (SIZE - 1) * (SIZE - 1), "%zu indices", count);
    release();
}

static double random_between(uint64_t *draw, double low, double high)
{
    return low + (high - low) * (double)(lom_random_bits(11, ++*draw) >> 11) * 0x1p-53;
}

/* Squares of blocks leave out what each block's own box would, of any view, clip plane and reach. */
static void what_is_seen_is_each_block_that_is_visible(void)
{
    uint64_t draw = 0;
    int seen = 0, shown = 0;
    load(rough);
    const int count = ground.across * ground.down;
    for (int i = 0; i < 400; i++) {
        const lom_vec3 eye = { random_between(&draw, -300, 300), random_between(&draw, -50, 200),
                               random_between(&draw, -300, 300) };
        const lom_vec3 at = { random_between(&draw, -200, 200), random_between(&draw, -50, 50),
                              random_between(&draw, -200, 200) };
        const lom_mat4 look = lom_look_at(eye, at, (lom_vec3){ 0, 1, 0 });
        const lom_mat4 project = lom_perspective(random_between(&draw, 0.1, 2), 1.5, 0.1);
        const lom_mat4 all = lom_multiply(&project, &look);
        const double plane[4] = { 0, i % 3 - 1, 0, i % 3 == 1 ? 1 : random_between(&draw, -60, 60) };
        const double reach = i % 4 == 0 ? random_between(&draw, 1, 200) : LOM_EVERYWHERE;
        const struct lom_culler culler = { lom_view_frustum(&all, false), plane, eye };
        bool any = false;
        int left = lom_see_ground(&ground, &culler, reach);
        for (int k = 0; k < count; k++) {
            const lom_box *box = &ground.blocks[k].bounds;
            const bool visible = lom_is_visible(&culler, box);
            const bool is_seen = visible && lom_distance_to_box(eye, *box) < reach;
            CHECK(ground.seen[k] == is_seen, "view %d, block %d: %d", i, k, ground.seen[k]);
            any |= visible;
            seen += is_seen;
            left -= is_seen;
        }
        CHECK(left == 0, "view %d: %d more than are seen", i, left);
        shown += any;
        CHECK(lom_shows_ground(&ground, &culler) == any, "view %d", i);
    }
    CHECK(seen > count && seen < 300 * count && shown > 100 && shown < 400, "%d seen, %d shown", seen, shown);
    lom_see_ground(&ground, NULL, 1);
    for (int k = 0; k < count; k++)
        CHECK(ground.seen[k], "block %d", k);
    release();
}

static double plan_area(const float *a, const float *b, const float *c)
{
    return (((double)b[2] - (double)a[2]) * ((double)c[0] - (double)a[0]) -
            ((double)b[0] - (double)a[0]) * ((double)c[2] - (double)a[2])) /
           2;
}

/* No triangle faces down, and together they have the block's area: nothing is covered twice, nothing is left out. */
static void every_block_is_covered_once(void)
{
    load(rough);
    for (double pixels = 0.5; pixels < 300; pixels *= 3) {
        choose(pixels);
        for (int i = 0; i < ground.across * ground.down; i++) {
            const struct lom_ground_pattern *p = pattern_of(i);
            const lom_box *box = &ground.blocks[i].bounds;
            double sum = 0, whole = (box->high.x - box->low.x) * (box->high.z - box->low.z);
            for (size_t k = 0; k < p->count; k += 3) {
                double area = plan_area(vertex_of(i, k), vertex_of(i, k + 1), vertex_of(i, k + 2));
                CHECK(area > -1e-3, "block %d, triangle %zu: %g", i, k / 3, area);
                sum += area;
            }
            CHECK(sum > whole - 1e-2 && sum < whole + 1e-2, "block %d: %g of %g", i, sum, whole);
        }
    }
    release();
}

/* The vertices of a block on the line where coordinate `axis` is `at`, in order of the other one. */
static int edge_vertices(int block, int axis, double at, float (*found)[3])
{
    const struct lom_ground_pattern *p = pattern_of(block);
    int count = 0;
    for (size_t k = 0; k < p->count; k++) {
        const float *v = vertex_of(block, k);
        if ((double)v[axis] != at)
            continue;
        int place = 0;
        while (place < count && found[place][2 - axis] < v[2 - axis])
            place++;
        if (place < count && found[place][2 - axis] == v[2 - axis])
            continue;
        memmove(found + place + 1, found + place, (size_t)(count - place) * sizeof *found);
        memcpy(found[place], v, sizeof *found);
        count++;
    }
    return count;
}

static void check_edge(int a, int b, int axis, double at)
{
    float here[LOM_GROUND_BLOCK + 2][3], there[LOM_GROUND_BLOCK + 2][3];
    int n = edge_vertices(a, axis, at, here), m = edge_vertices(b, axis, at, there);
    int apart = ground.level[a] - ground.level[b];
    CHECK(apart >= -1 && apart <= 1, "blocks %d and %d: levels %d and %d", a, b, ground.level[a], ground.level[b]);
    CHECK(n >= 2 && n == m && memcmp(here, there, (size_t)n * sizeof here[0]) == 0, "blocks %d and %d: %d, %d", a, b, n,
          m);
}

static void neighbours_share_their_edge(void)
{
    int mixed = 0;
    load(rough);
    for (double pixels = 0.5; pixels < 300; pixels *= 2) {
        choose(pixels);
        for (int i = 0; i < ground.across * ground.down; i++) {
            if ((i + 1) % ground.across != 0)
                check_edge(i, i + 1, 0, ground.blocks[i].bounds.high.x);
            if (i + ground.across < ground.across * ground.down)
                check_edge(i, i + ground.across, 2, ground.blocks[i].bounds.high.z);
            mixed += ground.level[i] != ground.level[0];
        }
    }
    CHECK(mixed > 0, "all blocks always had one level");
    release();
}

/* One block whose middle vertex alone stands out by 1 m: every level but the finest is off by just that, less the
 * cosine of the (flat) plane that it is measured from. */
static uint16_t spike(int x, int y)
{
    return x == 16 && y == 16 ? 6554 : 4915; /* 3 m is 4915: y = 0 */
}

static void errors_are_what_a_level_is_off(void)
{
    load(spike);
    const float *error = ground.blocks[0].error;
    double high = 6554 / 65535. * 40 - 4915 / 65535. * 40;
    CHECK(error[0] == 0, "level 0 is off by %g", (double)error[0]);
    for (int level = 1; level < 5;
         level++) /* the vertex belongs to levels 1 to 4: their slopes differ from level 0's */
        CHECK(error[level] > 0 && (double)error[level] < high, "level %d: %g", level, (double)error[level]);
    CHECK((double)error[5] > high - 1e-4 && (double)error[5] < high + 1e-4, "level 5: %g, not %g", (double)error[5],
          high);
    release();
}

static void planes_are_coarse(void)
{
    load(tilted);
    choose(0.1);
    for (int i = 0; i < ground.across * ground.down; i++)
        CHECK(ground.level[i] == LOM_GROUND_LEVELS - 1, "block %d has level %d", i, ground.level[i]);
    release();
}

/* Flat ground sees all of the sky. At the foot of a wall so high that its horizon is upright half of it is hidden;
 * beside a long wall of 45 degrees' height, cos^2 h with tan h = cos(azimuth) over half of the azimuths: the mean is
 * 1/2 + 1/2 mean of 1 / (1 + cos^2) = 1/2 + 1 / (2 sqrt 2). */
static float share[64 * 64];

static float seen_beside(float wall, int distance)
{
    static float heights[64 * 64];
    for (int i = 0; i < 64 * 64; i++)
        heights[i] = i % 64 >= 32 ? wall : 0;
    device = lom_open_device(&(lom_device_desc){ .threads = 3 });
    CHECK(lom_find_sky_visibility(device, heights, 64, 64, (double[]){ 64, 64 }, share, 1, NULL), "no memory");
    lom_close_device(device);
    return share[32 * 64 + 32 - distance];
}

static void visibility_of_the_sky(void)
{
    CHECK(seen_beside(0, 1) == 1, "flat ground sees %g", (double)seen_beside(0, 1));
    CHECK(share[0] == 1 && share[63] == 1 && share[64 * 63] == 1, "the corners of flat ground");
    float half = seen_beside(1e6f, 1), expected = 0.5f + 0.35355339f;
    CHECK(half > 0.5f && half < 0.57f, "at the wall %g", (double)half); /* two of sixteen azimuths run along it */
    float beside = seen_beside(8, 8);
    CHECK(beside > expected - 0.03f && beside < expected + 0.03f, "beside the wall %g, not %g", (double)beside,
          (double)expected);
}

/* The bytes of what is made of a map: vertices, errors and boxes of the blocks, normals and the sky that is seen. */
static uint64_t hash_ground(void)
{
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, ground.position, ground.position_count * sizeof *ground.position);
    for (int i = 0; i < ground.across * ground.down; i++) {
        hash = lom_hash_bytes(hash, ground.blocks[i].error, sizeof ground.blocks[i].error);
        hash = lom_hash_bytes(hash, &ground.blocks[i].bounds, sizeof ground.blocks[i].bounds);
    }
    for (int level = 0; level < lom_texture_levels(ground.vertex_texture); level++) {
        lom_image *texels = lom_read_texture(ground.vertex_texture, level, 0, NULL);
        hash = lom_hash_bytes(hash, texels->pixels, lom_image_size(texels));
        lom_free_image(texels);
    }
    return hash;
}

static void workers_make_what_one_makes(void)
{
    load_by(1, rough);
    const uint64_t alone = hash_ground();
    release();
    for (int threads = 2; threads <= 5; threads += 3) {
        load_by(threads, rough);
        CHECK(hash_ground() == alone, "with %d workers the ground is another one", threads);
        release();
    }
}

/* Along rows, columns and diagonals of square cells rays pass through vertices only: the shadow's height is the largest
 * h - d tan e over the vertices towards the sun. */
static float hills[24 * 24], shadow[24 * 24];

static void find_shadow(int threads, const double to_light[3])
{
    device = lom_open_device(&(lom_device_desc){ .threads = threads });
    lom_find_ground_shadow(device, hills, 24, 24, (double[]){ 46, 46 }, to_light, shadow);
    lom_close_device(device);
}

static float brute_shadow(int x, int z, int dx, int dz, double sink)
{
    double highest = -1e30;
    for (int i = 1; x + i * dx >= 0 && x + i * dx < 24 && z + i * dz >= 0 && z + i * dz < 24; i++) {
        double h = (double)hills[(z + i * dz) * 24 + x + i * dx] - i * sink;
        highest = h > highest ? h : highest;
    }
    return (float)highest;
}

static void shadows_along_rows_and_diagonals(void)
{
    for (int i = 0; i < 24 * 24; i++)
        hills[i] = (float)(20 * lom_random_uniform(3, (uint64_t)i));
    for (int way = 0; way < 9; way++) {
        int dx = way % 3 - 1, dz = way / 3 - 1;
        if (way == 4)
            continue;
        double to_light[3] = { dx * 0.5, 0.4, dz * 0.5 }; /* over cells of 2 m: 1.6 m down a step, any length */
        find_shadow(1, to_light);
        for (int i = 0; i < 24 * 24; i++) {
            float expected = brute_shadow(i % 24, i / 24, dx, dz, 1.6);
            bool none = expected < -1e29f;
            CHECK(none ? shadow[i] < -1e29f : shadow[i] > expected - 1e-3f && shadow[i] < expected + 1e-3f,
                  "towards (%d, %d), vertex %d: %g, not %g", dx, dz, i, (double)shadow[i], (double)expected);
        }
    }
}

/* A plane that rises towards the sun by less than its elevation shadows itself nowhere, one that rises by more
 * everywhere but where nothing stands towards the sun; both to the bit of the step: the height at a step of the sweep,
 * less the ray's. */
static void shadows_of_planes(void)
{
    for (int way = 0; way < 16; way++) {
        double angle = 0.3 + way * 0.4, to_light[3] = { lom_double_cos(angle), 0.5, lom_double_sin(angle) };
        for (int steep = 0; steep < 2; steep++) {
            double rise = steep ? 0.8 : 0.3, longer; /* a metre towards the sun */
            for (int i = 0; i < 24 * 24; i++)
                hills[i] = (float)(rise * (to_light[0] * 2 * (i % 24) + to_light[2] * 2 * (i / 24)));
            find_shadow(1, to_light);
            longer = to_light[0] * to_light[0] > 0.5 ? to_light[0] : to_light[2];
            double step = 2 / (longer < 0 ? -longer : longer),
                   at = (double)shadow[12 * 24 + 12] - (double)hills[12 * 24 + 12];
            CHECK(steep ? at > 0.3 * step : at < -0.199 * step && at > -0.201 * step, "at %g rad: %g m above the plane",
                  angle, at);
        }
    }
}

static void shadows_of_extreme_suns(void)
{
    for (int i = 0; i < 24 * 24; i++)
        hills[i] = (float)(i % 5);
    find_shadow(1, (double[]){ 0.6, -0.1, 0.6 });
    CHECK(shadow[77] > 1e29f, "a sun below the horizon: %g", (double)shadow[77]);
    find_shadow(1, (double[]){ 0, 1, 0 });
    CHECK(shadow[77] < -1e29f, "a sun in the zenith: %g", (double)shadow[77]);
}

/* Of a map that several workers share, from all sides, and steeply and flatly: rays that leave it early and late. */
static void workers_shadow_as_one_does(void)
{
    enum { WIDTH = 700, HEIGHT = 500 };
    static float heights[WIDTH * HEIGHT], shadows[2][WIDTH * HEIGHT];
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        heights[i] = (float)(40 * lom_random_uniform(8, (uint64_t)i));
    for (int k = 0; k < 12; k++) {
        const double angle = 0.5 * k + 0.1, up = k % 3 == 0 ? 0.02 : 0.4;
        const double to_light[3] = { lom_double_cos(angle), up, lom_double_sin(angle) };
        for (int i = 0; i < 2; i++) {
            device = lom_open_device(&(lom_device_desc){ .threads = i == 0 ? 1 : 5 });
            lom_find_ground_shadow(device, heights, WIDTH, HEIGHT, (double[]){ 1400, 900 }, to_light, shadows[i]);
            lom_close_device(device);
        }
        CHECK(memcmp(shadows[0], shadows[1], sizeof shadows[0]) == 0, "the sun at %g, %g", angle, up);
    }
}

int main(int argc, char **argv)
{
    RUN(full_density_at_zero_pixels);
    RUN(what_is_seen_is_each_block_that_is_visible);
    RUN(every_block_is_covered_once);
    RUN(neighbours_share_their_edge);
    RUN(errors_are_what_a_level_is_off);
    RUN(planes_are_coarse);
    RUN(visibility_of_the_sky);
    RUN(workers_make_what_one_makes);
    RUN(shadows_along_rows_and_diagonals);
    RUN(shadows_of_planes);
    RUN(shadows_of_extreme_suns);
    RUN(workers_shadow_as_one_does);
    return check_result();
}
