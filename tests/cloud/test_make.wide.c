/* Proves: every kind of cloud is made at any size, alone by its seed, with nothing on the faces that a shape's ray
 * enters by; the models of the literature are what their formulas say; shapes are the same at every width. */
#include "check.h"
#include "cloud/shape.h"

#include <lom/cloud.h>

static const uint16_t *voxels(const lom_image *volume)
{
    return (const uint16_t *)volume->pixels;
}

static lom_image *make(const char *kind, int width, int height, int depth, uint64_t seed)
{
    return lom_make_cloud(&(lom_cloud_desc){ kind, width, height, depth, seed }, NULL);
}

static void test_every_kind_by_seed(void)
{
    for (size_t i = 0; lom_cloud_kind_at(i) != NULL; i++) {
        const lom_cloud_kind *kind = lom_cloud_kind_at(i);
        lom_image *a = make(kind->name, 40, 22, 33, 5), *b = make(kind->name, 40, 22, 33, 5);
        lom_image *other = make(kind->name, 40, 22, 33, 6);
        CHECK(a != NULL && a->width == 40 && a->height == 22 && a->depth == 33, "%s", kind->name);
        CHECK(memcmp(a->pixels, b->pixels, lom_image_size(a)) == 0, "%s differs from itself", kind->name);
        bool by_formula = strcmp(kind->name, "ball") == 0 || strcmp(kind->name, "ripples") == 0;
        CHECK((memcmp(a->pixels, other->pixels, lom_image_size(a)) == 0) == by_formula, "%s and its seed", kind->name);
        size_t full = 0, count = lom_image_size(a) / 2;
        for (size_t v = 0; v < count; v++)
            full += voxels(a)[v] != 0;
        CHECK(full > count / 100 && (full < count || by_formula), "%s: %zu of %zu voxels", kind->name, full, count);
        CHECK(kind->low <= kind->high && kind->extinction > 0, "%s", kind->name);
        lom_free_image(a);
        lom_free_image(b);
        lom_free_image(other);
    }
}

enum { BODY = 64, BODY_CELLS = BODY * BODY * BODY };

/* The mass of the largest part whose voxels of more than a twentieth of full density touch by faces, in parts of all.
 */
static double largest_part(const uint16_t *volume)
{
    static int32_t stack[BODY_CELLS];
    static uint8_t seen[BODY_CELLS];
    static const int steps[3] = { 1, BODY, BODY * BODY };
    double largest = 0, all = 0;
    memset(seen, 0, sizeof seen);
    for (int first = 0; first < BODY_CELLS; first++) {
        int count = 0;
        double mass = 0;
        all += volume[first];
        if (volume[first] > 3276 && !seen[first]) {
            stack[count++] = first;
            seen[first] = 1;
        }
        while (count > 0) {
            int at = stack[--count];
            mass += volume[at];
            for (int k = 0; k < 6; k++) {
                int axis = k / 2, along = at / steps[axis] % BODY, to = at + (k & 1 ? steps[axis] : -steps[axis]);
                if ((k & 1 ? along == BODY - 1 : along == 0) || volume[to] <= 3276 || seen[to])
                    continue;
                seen[to] = 1;
                stack[count++] = to;
            }
        }
        largest = mass > largest ? mass : largest;
    }
    return largest / all;
}

/* Heaps hang together: nothing of weight floats beside them. */
static void test_heaps_are_one_piece(void)
{
    static const char *const kinds[] = { "cumulus_humilis", "cumulus_mediocris", "cumulus_congestus", "cumulonimbus" };
    for (int i = 0; i < 4; i++)
        for (uint64_t seed = 1; seed < 4; seed++) {
            lom_image *volume = make(kinds[i], BODY, BODY, BODY, seed);
            double share = largest_part(voxels(volume));
            CHECK(share > 0.95, "%s %llu: its largest part has %.3f of it", kinds[i], (unsigned long long)seed, share);
            lom_free_image(volume);
        }
}

/* Columns that have cloud in a slice of the height, in parts of all. */
static double cover(const lom_image *volume, double height)
{
    int y = (int)(height * volume->height), columns = 0;
    for (int z = 0; z < volume->depth; z++)
        for (int x = 0; x < volume->width; x++)
            columns += voxels(volume)[(z * volume->height + y) * volume->width + x] > 3276;
    return (double)columns / (volume->width * volume->depth);
}

/* A thunderstorm's anvil is wider than the tower below it, and there is nothing above it. */
static void test_an_anvil_spreads_over_its_tower(void)
{
    for (uint64_t seed = 1; seed < 4; seed++) {
        lom_image *volume = make("cumulonimbus", BODY, BODY, BODY, seed);
        double anvil = cover(volume, 0.87), neck = cover(volume, 0.55), top = cover(volume, 0.97);
        CHECK(anvil > 1.8 * neck && neck > 0.02 && top == 0, "seed %llu: %.3f over %.3f, %.3f above",
              (unsigned long long)seed, anvil, neck, top);
        lom_free_image(volume);
    }
}

static void test_names(void)
{
    lom_error error = { 0 };
    CHECK(lom_find_cloud_kind("Cb", NULL) == lom_find_cloud_kind("cumulonimbus", NULL), "Cb");
    CHECK(lom_find_cloud_kind("stratus", NULL) != lom_find_cloud_kind("stratocumulus", NULL), "stratus");
    CHECK(lom_find_cloud_kind("cumulus_humillis", &error) == NULL && strstr(error.text, "cumulus_humilis") != NULL,
          "%s", error.text);
    CHECK(lom_find_cloud_kind("", NULL) == NULL, "the empty name");
    error.code = LOM_OK;
    CHECK(lom_make_cloud(&(lom_cloud_desc){ "cirrus", 513, 2, 2, 1 }, &error) == NULL && error.code == LOM_ERROR_USAGE,
          "%s", error.text);
}

/* Inside and outside of the noisy ball and base, whatever the noise (docs/clouds.md, Making). */
static void test_hemisphere_keeps_its_formula(void)
{
    enum { N = 50 };
    lom_image *volume = make("hemisphere", N, N, N, 3);
    for (int z = 0; z < N; z++)
        for (int y = 0; y < N; y++)
            for (int x = 0; x < N; x++) {
                double px = (x + 0.5) / N - 0.5, py = (y + 0.5) / N, pz = (z + 0.5) / N - 0.5;
                double square = px * px + (py - 0.5) * (py - 0.5) + pz * pz;
                int value = *(uint16_t *)lom_image_pixel(volume, x, y, z);
                CHECK(value == 0 || value == 65535, "%d", value);
                CHECK(value == 65535 || !(square < 0.16 - 0.1 && py > 0.4), "a hole at %d %d %d", x, y, z);
                CHECK(value == 0 || (square < 0.16 && py > 0.36), "too far out at %d %d %d", x, y, z);
            }
    lom_free_image(volume);
}

static void test_tiny_and_flat_volumes(void)
{
    static const int sizes[][3] = { { 1, 1, 1 }, { 1, 7, 1 }, { 64, 1, 2 }, { 3, 2, 64 }, { 17, 5, 3 } };
    for (size_t i = 0; lom_cloud_kind_at(i) != NULL; i++)
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
            lom_image *volume = make(lom_cloud_kind_at(i)->name, sizes[s][0], sizes[s][1], sizes[s][2], 1);
            CHECK(volume != NULL, "%s %d", lom_cloud_kind_at(i)->name, (int)s);
            lom_free_image(volume);
        }
}

static void test_rows_are_the_same_at_every_width(void)
{
    struct lom_cloud_body body = { .bubble_count = 2,
                                   .bubble = { { 300, 150, 300, 140, 1 }, { 420, 200, 280, 110, 1.4f } },
                                   .base = 60,
                                   .base_depth = 40,
                                   .billow = 50,
                                   .billow_size = 160,
                                   .warp = 40,
                                   .warp_size = 300,
                                   .softness = 90,
                                   .thin = 0.5f };
    struct lom_cloud_shape shape = { .voxels = { 61, 40, 61 }, .size = { 700, 400, 600 }, .seed = 9, .body = &body };
    uint64_t hash = LOM_HASH_START;
    uint16_t row[61];
    for (int y = 0; y < 40; y += 3)
        for (int z = 0; z < 61; z += 5) {
            LOM_WIDE(lom_shape_row)(row, &shape, y, z);
            hash = lom_hash_bytes(hash, row, sizeof row);
        }
    CHECK(hash == UINT64_C(0x7748184f31e0b93e), "%016llx", (unsigned long long)hash);
}

int main(int argc, char **argv)
{
    RUN(test_every_kind_by_seed);
    RUN(test_heaps_are_one_piece);
    RUN(test_an_anvil_spreads_over_its_tower);
    RUN(test_names);
    RUN(test_hemisphere_keeps_its_formula);
    RUN(test_tiny_and_flat_volumes);
    RUN(test_rows_are_the_same_at_every_width);
    return check_result();
}
