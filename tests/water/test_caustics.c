/* Proves of the light gathered on the bed: still water gives 1 everywhere, nothing is lost inside the square, neither
 * the order of the photons nor that of the rows matters, and places that are no numbers are dropped. */
#include "check.h"

#include "image/texture.h"
#include "water/caustics.h"

enum { SIZE = 40 };

static float *photon_at(const lom_texture *photons, int i)
{
    return lom_texel(photons, 0, i % SIZE, i / SIZE, 0);
}

static lom_texture *photons(double shift, double spread)
{
    lom_texture *texture =
        lom_create_texture(&(lom_texture_desc){ .width = SIZE, .height = SIZE, .format = LOM_FORMAT_RGBA32F }, NULL);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            float *p = photon_at(texture, y * SIZE + x);
            uint64_t key = (uint64_t)(y * SIZE + x);
            p[0] = (float)(x + 0.5 + shift + spread * (lom_random_uniform(1, key) - 0.5));
            p[1] = (float)(y + 0.5 + shift + spread * (lom_random_uniform(2, key) - 0.5));
            p[2] = 1;
        }
    return texture;
}

static struct lom_gathered_light gather(const lom_texture *photons)
{
    struct lom_gathered_light light = { 0 };
    CHECK(lom_make_gathered_light(&light, SIZE, NULL), "no memory");
    lom_gather_photons(&light, photons, 0, SIZE);
    lom_gather_photons(&light, photons, 0, SIZE); /* what was there is gone */
    return light;
}

static double texel(const struct lom_gathered_light *light, int x, int y)
{
    return (double)light->texel[y * SIZE + x];
}

/* In an order that no row knows of. */
static void rows_can_be_gathered_by_any_worker(void)
{
    lom_texture *p = photons(0, 9);
    struct lom_gathered_light whole = gather(p), parts = { 0 };
    CHECK(lom_make_gathered_light(&parts, SIZE, NULL), "no memory");
    static const int ranges[][2] = { { 13, 14 }, { 0, 13 }, { 31, SIZE }, { 14, 31 } };
    for (int i = 0; i < 4; i++)
        lom_gather_photons(&parts, p, ranges[i][0], ranges[i][1]);
    CHECK(memcmp(whole.texel, parts.texel, SIZE * SIZE * sizeof(float)) == 0, "the ranges show");
    lom_free_texture(p);
    lom_free_gathered_light(&whole);
    lom_free_gathered_light(&parts);
}

static void still_water_gives_one(void)
{
    for (double shift = 0; shift < 1; shift += 0.17) {
        lom_texture *p = photons(shift, 0);
        struct lom_gathered_light light = gather(p);
        for (int y = 3; y < SIZE - 3; y++)
            for (int x = 3; x < SIZE - 3; x++)
                CHECK(texel(&light, x, y) > 0.9999 && texel(&light, x, y) < 1.0001, "%g at %d, %d", texel(&light, x, y),
                      x, y);
        lom_free_texture(p);
        lom_free_gathered_light(&light);
    }
}

static void light_is_kept_in_any_order(void)
{
    lom_texture *p = photons(0, 9), *turned = photons(0, 9);
    double landed = 0, sum = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        float *from = photon_at(p, i);
        int j = i * 997 % (SIZE * SIZE); /* another order: 997 is prime to the count */
        for (int k = 0; k < 2; k++)      /* all of them well inside */
            from[k] = 4 + from[k] * (SIZE - 8) / (SIZE + 9.0f) + 3;
        memcpy(photon_at(turned, j), from, 16);
        bool inside = from[0] > 1 && from[0] < SIZE - 1 && from[1] > 1 && from[1] < SIZE - 1;
        CHECK(inside, "photon %d is at %g, %g", i, from[0], from[1]);
        landed += 1;
    }
    struct lom_gathered_light one = gather(p), other = gather(turned);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            sum += texel(&one, x, y);
    CHECK(sum > landed * 0.9999 && sum < landed * 1.0001, "%g of %g landed", sum, landed);
    CHECK(memcmp(one.texel, other.texel, SIZE * SIZE * sizeof(float)) == 0, "the order of photons shows");
    lom_free_texture(p);
    lom_free_texture(turned);
    lom_free_gathered_light(&one);
    lom_free_gathered_light(&other);
}

static void what_is_no_place_is_dropped(void)
{
    static const float odd[] = { __builtin_nanf(""), __builtin_inff(), -1e30f, 1e30f, -5, SIZE + 5 };
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        lom_texture *p = photons(0, 0);
        for (int k = 0; k < SIZE * SIZE; k++)
            photon_at(p, k)[k & 1] = odd[i];
        struct lom_gathered_light light = gather(p);
        for (int k = 0; k < SIZE * SIZE; k++)
            CHECK(texel(&light, k % SIZE, k / SIZE) == 0, "%g lands", odd[i]);
        lom_free_texture(p);
        lom_free_gathered_light(&light);
    }
}

int main(int argc, char **argv)
{
    RUN(rows_can_be_gathered_by_any_worker);
    RUN(still_water_gives_one);
    RUN(light_is_kept_in_any_order);
    RUN(what_is_no_place_is_dropped);
    return check_result();
}
