/* Proves: the grid of light agrees with plain integration in double along the ray from each voxel to the sun, within a
 * bound that follows from how the density bends, for suns all around and boxes of any shape; it is exact where the
 * density is uniform; its bytes do not depend on lanes or on the slabs that slices are swept in. */
#include "check.h"

#include "march/light_grid.h"

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static lom_light_grid *grid_of(lom_image *image)
{
    float same[256];
    for (int i = 0; i < 256; i++)
        same[i] = (float)i / 255;
    lom_light_grid *grid = lom_create_light_grid(image, 1, same, NULL);
    lom_free_image(image);
    return grid;
}

static lom_light_grid *uniform_grid(const int size[3], float density)
{
    lom_image *image = lom_create_image(size[0], size[1], size[2], LOM_FORMAT_R32F, NULL);
    for (int i = 0; i < size[0] * size[1] * size[2]; i++)
        ((float *)image->pixels)[i] = density;
    return grid_of(image);
}

/* A smooth heap of waves that is 0 in the outermost voxels. */
static lom_light_grid *smooth_grid(const int size[3], uint32_t seed)
{
    lom_image *image = lom_create_image(size[0], size[1], size[2], LOM_FORMAT_R32F, NULL);
    for (int z = 0; z < size[2]; z++)
        for (int y = 0; y < size[1]; y++)
            for (int x = 0; x < size[0]; x++) {
                const int voxel[3] = { x, y, z };
                double product = 1;
                for (int k = 0; k < 3; k++) {
                    double wave = lom_double_sin(3.14159265358979 * voxel[k] / (size[k] - 1));
                    double phase = 6 * lom_random_uniform(seed, (uint64_t)k);
                    product *= wave * wave * (0.7 + 0.3 * lom_double_sin(phase + 7.0 * voxel[(k + 1) % 3] / 20));
                }
                *(float *)lom_image_pixel(image, x, y, z) = (float)product;
            }
    return grid_of(image);
}

static lom_light_grid *noisy_grid(const int size[3], uint32_t seed)
{
    lom_image *image = lom_create_image(size[0], size[1], size[2], LOM_FORMAT_R16, NULL);
    for (int i = 0; i < size[0] * size[1] * size[2]; i++)
        ((uint16_t *)image->pixels)[i] = (uint16_t)(lom_random_bits(seed, (uint64_t)i) % 65536);
    return grid_of(image);
}

static size_t words_of(const lom_light_grid *g)
{
    return (size_t)(g->width + 1) * (size_t)(g->height + 1) * (size_t)(g->depth + 1);
}

/* exp(-depth / 64) of the light's way to a voxel. */
static double share_at(const lom_light_grid *g, int x, int y, int z)
{
    size_t at = ((size_t)z * (size_t)(g->height + 1) + (size_t)y) * (size_t)(g->width + 1) + (size_t)x;
    return (g->light[at] & 0xffff) / 65535.0;
}

static double density_at(const lom_light_grid *g, int x, int y, int z)
{
    if (x < 0 || y < 0 || z < 0 || x >= g->width || y >= g->height || z >= g->depth)
        return 0;
    return g->density[((size_t)z * (size_t)g->height + (size_t)y) * (size_t)g->width + (size_t)x] / 65535.0;
}

/* Trilinear between the centres; p in voxels. */
static double interpolate(const lom_light_grid *g, const double p[3])
{
    int cell[3];
    double weight[3], sum = 0;
    for (int k = 0; k < 3; k++) {
        cell[k] = (int)lom_double_floor(p[k]);
        weight[k] = p[k] - cell[k];
    }
    for (int i = 0; i < 8; i++) {
        double w = 1;
        for (int k = 0; k < 3; k++)
            w *= i >> k & 1 ? weight[k] : 1 - weight[k];
        sum += w * density_at(g, cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2));
    }
    return sum;
}

/* The oracle: the integral of the density from a voxel's centre towards the light, by the midpoint rule with steps of a
 * sixteenth of a voxel. way: voxels a slice, of which there are `slices` to the light's side. */
static double integrate(const lom_light_grid *g, const int voxel[3], const double way[3], int slices)
{
    enum { FINE = 16 };
    double sum = 0;
    for (int i = 0; i < FINE * slices; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = voxel[k] + way[k] * (i + 0.5) / FINE;
        sum += interpolate(g, p);
    }
    return sum / FINE;
}

/* The largest second difference along an axis, and the largest mixed one. */
static void find_bends(const lom_light_grid *g, double *straight, double *mixed)
{
    *straight = *mixed = 0;
    for (int z = -1; z <= g->depth; z++)
        for (int y = -1; y <= g->height; y++)
            for (int x = -1; x <= g->width; x++)
                for (int i = 0; i < 3; i++) {
                    const int a[3] = { i == 0, i == 1, i == 2 }, b[3] = { i == 2, i == 0, i == 1 };
                    double here = density_at(g, x, y, z), next = density_at(g, x + a[0], y + a[1], z + a[2]);
                    double before = density_at(g, x - a[0], y - a[1], z - a[2]);
                    double side = density_at(g, x + b[0], y + b[1], z + b[2]);
                    double both = density_at(g, x + a[0] + b[0], y + a[1] + b[1], z + a[2] + b[2]);
                    *straight = larger(*straight, magnitude(next - 2 * here + before));
                    *mixed = larger(*mixed, magnitude(both - next - side + here));
                }
}

static lom_light_desc sun(const double way[3])
{
    double length = lom_double_sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
    lom_light_desc desc = { .size = { 900, 500, 700 }, .extinction = 0.03f };
    for (int k = 0; k < 3; k++)
        desc.to_light[k] = (float)(way[k] / length);
    return desc;
}

/* Voxels towards the light as the slices go by, and the metres of a slice; the axis they lie across. */
static int find_slices(const lom_light_grid *g, const lom_light_desc *desc, double way[3], double *thickness)
{
    const int size[3] = { g->width, g->height, g->depth };
    int axis = 0;
    for (int k = 0; k < 3; k++) {
        way[k] = (double)desc->to_light[k] * size[k] / (double)desc->size[k];
        axis = magnitude(way[k]) > magnitude(way[axis]) ? k : axis;
    }
    *thickness = 1 / magnitude(way[axis]);
    for (int k = 0; k < 3; k++)
        way[k] *= *thickness;
    return axis;
}

/* What the sweep does to a voxel's ray that passes n slices. Along it the trapezoid rule, with a node a slice: off by
 * at most 1/8 of the total variation of the density's slope (in densities a slice). A ray goes at most a voxel sideways
 * a slice, so within cells the slope changes by at most 6 mixed differences a slice, and by at most 3 straight ones
 * where it crosses from cell to cell. And between four rays the depth is interpolated, of which each slice is off by at
 * most a quarter of a straight difference along either axis. */
static double bound_of(int n, double straight, double mixed)
{
    return n * ((6 * mixed + 3 * straight) / 8 + straight / 2);
}

static void check_sun(lom_light_grid *g, const double to_sun[3])
{
    lom_light_desc desc = sun(to_sun);
    double way[3], thickness, straight, mixed, darkest = 0, bias = 0;
    int count = 0;
    int axis = find_slices(g, &desc, way, &thickness);
    const int size[3] = { g->width, g->height, g->depth };
    CHECK(lom_sweep_sun_by(LOM_WIDE(lom_sweep_slice), g, &desc, NULL), "swept");
    find_bends(g, &straight, &mixed);
    double scale = (double)desc.extinction * thickness;
    for (int z = 0; z < g->depth; z++)
        for (int y = 0; y < g->height; y++)
            for (int x = (y * 7 + z * 3) % 5; x < g->width; x += 5) {
                const int voxel[3] = { x, y, z };
                int slices = 1 + (way[axis] > 0 ? size[axis] - 1 - voxel[axis] : voxel[axis]);
                double depth = scale * integrate(g, voxel, way, slices), got = share_at(g, x, y, z);
                double bound = scale * bound_of(slices, straight, mixed);
                double want = lom_double_exp(-depth / LOM_LIGHT_DEPTH);
                CHECK(magnitude(got - want) <= want * lom_double_expm1(bound / LOM_LIGHT_DEPTH) + 1.0 / 65535,
                      "sun at %g %g %g, voxel %d %d %d: %.6f for %.6f", to_sun[0], to_sun[1], to_sun[2], x, y, z, got,
                      want);
                darkest = larger(darkest, 1 - want);
                bias += got - want;
                count++;
            }
    CHECK(darkest > 0.0125, "no shade to compare, %g", darkest);
    CHECK(magnitude(bias) < 5e-5 * count, "sun at %g %g %g: %g too bright on average", to_sun[0], to_sun[1], to_sun[2],
          bias / count);
}

/* Along the axes, along diagonals of faces and of the box, steep, grazing, from below. */
static void test_depths_agree_with_integration_along_rays(void)
{
    static const int sizes[][3] = { { 20, 20, 20 }, { 33, 14, 19 }, { 13, 36, 17 }, { 18, 16, 40 } };
    static const double ways[][3] = { { 8, 4, 3 },    { -7, 5, 5 },  { 3, 9, 2 },
                                      { -5, -7, -4 }, { 2, 0.3, 9 }, { 1, 0.001, 0 } };
    for (uint32_t i = 0; i < 4; i++) {
        lom_light_grid *g = smooth_grid(sizes[i], i);
        for (int k = 0; k < 27; k++) {
            const double way[3] = { k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1 };
            if (k != 13)
                check_sun(g, way);
        }
        for (size_t k = 0; k < sizeof ways / sizeof *ways; k++)
            check_sun(g, ways[k]);
        lom_free_light_grid(g);
    }
}

/* With Harris's forward scattering f a slice of depth d counts as -log(exp(-d) + f d), but never brightens. */
static double forward_depth(double d, double forward)
{
    return larger(-lom_double_log(lom_double_exp(-d) + forward * d), 0);
}

/* Along an axis through uniform density the depth is the way to the face; so it is with forward scattering, slice by
 * slice and for the half slice at the end. */
static void test_uniform_density_is_exact(void)
{
    static const int size[3] = { 21, 6, 19 };
    lom_light_grid *g = uniform_grid(size, 1);
    for (int k = 0; k < 12; k++) {
        double way[3] = { 0, 0, 0 }, forward = k < 6 ? 0 : 0.4;
        int axis = k % 3, up = k / 3 % 2;
        way[axis] = up ? 1 : -1;
        lom_light_desc desc = sun(way);
        desc.forward = (float)forward;
        lom_sweep_sun_by(LOM_WIDE(lom_sweep_slice), g, &desc, NULL);
        double d = (double)desc.extinction * (double)desc.size[axis] / size[axis];
        double whole = forward_depth(d, forward), half = forward_depth(d / 2, forward);
        for (int at = 0; at < size[axis]; at++) {
            int voxel[3] = { 3, 2, 4 };
            voxel[axis] = at;
            double depth = (up ? size[axis] - 1 - at : at) * whole + half;
            double got = share_at(g, voxel[0], voxel[1], voxel[2]), want = lom_double_exp(-depth / LOM_LIGHT_DEPTH);
            CHECK(magnitude(got - want) < 1.0 / 65535, "axis %d, voxel %d: %.7f for %.7f", axis, at, got, want);
        }
    }
    lom_free_light_grid(g);
}

static float two(void *context, const float exit[3])
{
    for (int k = 0; k < 3; k++)
        *(int *)context += exit[k] < 0 || exit[k] > 1;
    return 2;
}

/* What lies between the box and the light is added to every voxel, asked for at places on the box. */
static void test_depth_beyond_the_box_is_added(void)
{
    static const int size[3] = { 7, 9, 8 };
    lom_light_grid *g = uniform_grid(size, 0);
    for (int k = 0; k < 6; k++) {
        double way[3] = { 0, 0, 0 };
        int outside = 0;
        way[k % 3] = k < 3 ? 1 : -1;
        lom_light_desc desc = sun(way);
        desc.beyond = two;
        desc.context = &outside;
        lom_sweep_sun_by(LOM_WIDE(lom_sweep_slice), g, &desc, NULL);
        CHECK(outside == 0, "%d places outside", outside);
        for (int i = 0; i < 7 * 9 * 8; i++)
            CHECK(magnitude(share_at(g, i % 7, i / 7 % 9, i / 63) - lom_double_exp(-2.0 / LOM_LIGHT_DEPTH)) <
                      1.0 / 65535,
                  "voxel %d", i);
    }
    lom_free_light_grid(g);
}

/* The lanes beyond a row, the last block of a slab and the borders: every size up to two slabs and a bit. */
static void test_bytes_do_not_depend_on_lanes(void)
{
    static const double ways[][3] = { { 1, 0, 0 }, { -9, 4, 3 }, { 5, -4, 3 }, { 2, 9, -1 }, { 1, -3, -9 } };
    for (int n = 1; n <= 37; n++) {
        const int size[3] = { n, (n * 5 + 3) % 36 + 1, (n * 11) % 30 + 1 };
        lom_light_grid *a = noisy_grid(size, (uint32_t)n), *b = noisy_grid(size, (uint32_t)n);
        for (int k = 0; k < 5; k++) {
            lom_light_desc desc = sun(ways[k]);
            desc.forward = k % 2 != 0 ? 0.3f : 0;
            lom_sweep_sun(a, &desc, NULL);
            lom_sweep_sun_by(LOM_WIDE(lom_sweep_slice), b, &desc, NULL);
            CHECK(memcmp(a->light, b->light, words_of(a) * sizeof *a->light) == 0, "%d x %d x %d, way %d", size[0],
                  size[1], size[2], k);
        }
        lom_free_light_grid(a);
        lom_free_light_grid(b);
    }
}

/* Slabs are transposed copies: what is swept across x equals what is swept across z of the volume with x and z
 * exchanged. */
static void test_axes_are_alike(void)
{
    static const int sizes[][3] = { { 16, 8, 8 }, { 37, 13, 21 }, { 5, 30, 9 }, { 1, 4, 3 } };
    for (uint32_t i = 0; i < 4; i++) {
        const int *n = sizes[i], turned[3] = { n[2], n[1], n[0] };
        lom_light_grid *a = noisy_grid(n, i), *b = noisy_grid(turned, 0);
        for (int z = 0; z < n[2]; z++)
            for (int y = 0; y < n[1]; y++)
                for (int x = 0; x < n[0]; x++)
                    b->density[(x * n[1] + y) * n[2] + z] = a->density[(z * n[1] + y) * n[0] + x];
        for (int side = -1; side <= 1; side += 2) {
            lom_light_desc desc = { .size = { 10, 10, 10 }, .extinction = 0.3f, .to_light = { (float)side, 0, 0 } };
            lom_sweep_sun_by(LOM_WIDE(lom_sweep_slice), a, &desc, NULL);
            desc.to_light[0] = 0;
            desc.to_light[2] = (float)side;
            lom_sweep_sun_by(LOM_WIDE(lom_sweep_slice), b, &desc, NULL);
            for (int z = 0; z <= n[2]; z++)
                for (int y = 0; y <= n[1]; y++)
                    for (int x = 0; x <= n[0]; x++)
                        CHECK(share_at(a, x, y, z) == share_at(b, z, y, x), "%d %d %d of volume %u", x, y, z, i);
        }
        lom_free_light_grid(a);
        lom_free_light_grid(b);
    }
}

/* The sun's share is swept without a bit of the sky's and the ground's, and these are 1 / (1 + 0.1125 t). */
static void test_sky_and_ground_are_two_stream(void)
{
    static const int size[3] = { 3, 10, 2 };
    lom_light_grid *g = uniform_grid(size, 1);
    const float metres[3] = { 30, 200, 10 };
    lom_sweep_sky(g, metres, 0.1f);
    lom_light_desc desc = sun((const double[3]){ 1, 2, 3 });
    lom_sweep_sun_by(LOM_WIDE(lom_sweep_slice), g, &desc, NULL);
    for (int y = 0; y < 10; y++) {
        uint32_t word = (uint32_t)g->light[((size_t)(size[1] + 1) + (size_t)y) * (size_t)(size[0] + 1) + 2];
        double up = (9.5 - y) * 2, down = (y + 0.5) * 2;
        CHECK(magnitude((word >> 16 & 255) - 255 / (1 + 0.1125 * up)) <= 0.51, "sky at %d: %u", y, word >> 16 & 255);
        CHECK(magnitude((word >> 24) - 255 / (1 + 0.1125 * down)) <= 0.51, "ground at %d: %u", y, word >> 24);
    }
    lom_free_light_grid(g);
}

int main(int argc, char **argv)
{
    RUN(test_depths_agree_with_integration_along_rays);
    RUN(test_uniform_density_is_exact);
    RUN(test_depth_beyond_the_box_is_added);
    RUN(test_bytes_do_not_depend_on_lanes);
    RUN(test_axes_are_alike);
    RUN(test_sky_and_ground_are_two_stream);
    return check_result();
}
