/* Proves of the light gathered on the bed: still water gives 1 everywhere, nothing is lost inside the square, the order
 * of the photons does not matter, and places that are no numbers are dropped. */
#include "check.h"

#include "water/caustics.h"

enum { SIZE = 40 };

static lom_image *photons(double shift, double spread)
{
    lom_image *image = lom_create_image(SIZE, SIZE, 1, LOM_FORMAT_RGBA32F, NULL);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            float *p = lom_image_pixel(image, x, y, 0);
            uint64_t key = (uint64_t)(y * SIZE + x);
            p[0] = (float)(x + 0.5 + shift + spread * (lom_random_uniform(1, key) - 0.5));
            p[1] = (float)(y + 0.5 + shift + spread * (lom_random_uniform(2, key) - 0.5));
            p[2] = 1;
        }
    return image;
}

static double texel(const lom_image *light, int x, int y)
{
    return *(const float *)lom_image_pixel((lom_image *)light, x, y, 0);
}

static void still_water_gives_one(void)
{
    for (double shift = 0; shift < 1; shift += 0.17) {
        lom_image *p = photons(shift, 0), *light = lom_gather_photons(p, NULL);
        for (int y = 3; y < SIZE - 3; y++)
            for (int x = 3; x < SIZE - 3; x++)
                CHECK(texel(light, x, y) > 0.9999 && texel(light, x, y) < 1.0001, "%g at %d, %d", texel(light, x, y), x,
                      y);
        lom_free_image(p);
        lom_free_image(light);
    }
}

static void light_is_kept_in_any_order(void)
{
    lom_image *p = photons(0, 9), *turned = photons(0, 9);
    double landed = 0, sum = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        float *from = lom_image_pixel(p, i % SIZE, i / SIZE, 0);
        int j = i * 997 % (SIZE * SIZE); /* another order: 997 is prime to the count */
        for (int k = 0; k < 2; k++)      /* all of them well inside */
            from[k] = 4 + from[k] * (SIZE - 8) / (SIZE + 9.0f) + 3;
        memcpy(lom_image_pixel(turned, j % SIZE, j / SIZE, 0), from, 16);
        bool inside = from[0] > 1 && from[0] < SIZE - 1 && from[1] > 1 && from[1] < SIZE - 1;
        CHECK(inside, "photon %d is at %g, %g", i, from[0], from[1]);
        landed += 1;
    }
    lom_image *one = lom_gather_photons(p, NULL), *other = lom_gather_photons(turned, NULL);
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++)
            sum += texel(one, x, y);
    CHECK(sum > landed * 0.9999 && sum < landed * 1.0001, "%g of %g landed", sum, landed);
    CHECK(memcmp(one->pixels, other->pixels, lom_image_size(one)) == 0, "the order of photons shows");
    lom_free_image(p);
    lom_free_image(turned);
    lom_free_image(one);
    lom_free_image(other);
}

static void what_is_no_place_is_dropped(void)
{
    static const float odd[] = { __builtin_nanf(""), __builtin_inff(), -1e30f, 1e30f, -5, SIZE + 5 };
    for (size_t i = 0; i < sizeof odd / sizeof odd[0]; i++) {
        lom_image *p = photons(0, 0);
        for (int k = 0; k < SIZE * SIZE; k++)
            ((float *)lom_image_pixel(p, k % SIZE, k / SIZE, 0))[k & 1] = odd[i];
        lom_image *light = lom_gather_photons(p, NULL);
        for (int k = 0; k < SIZE * SIZE; k++)
            CHECK(texel(light, k % SIZE, k / SIZE) == 0, "%g lands", odd[i]);
        lom_free_image(p);
        lom_free_image(light);
    }
}

int main(int argc, char **argv)
{
    RUN(still_water_gives_one);
    RUN(light_is_kept_in_any_order);
    RUN(what_is_no_place_is_dropped);
    return check_result();
}
