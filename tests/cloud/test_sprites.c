/* Proves: the billboards of a cloud absorb together what its density does, lie where it is, are turned by unit vectors,
 * follow its seed, and are drawn from far to near, each once. */
#include "check.h"
#include "cloud/cloud_sprites.h"

#include "base/numbers.h"

#include <string.h>

static const int models[] = { LOM_CLOUDS_SPRITES, LOM_CLOUDS_GROUPS };

/* A box of 200 x 100 x 50 m, of one density where x is at least `from` of it. */
struct box {
    lom_cloud cloud;
    struct lom_placed_cloud placed;
};

static void fill_box(struct box *box, double from, int seed)
{
    float same[256];
    for (int i = 0; i < 256; i++)
        same[i] = i / 255.0f;
    lom_image *image = lom_create_image(10, 6, 4, LOM_FORMAT_R16, NULL);
    for (int i = 0; i < 240; i++)
        ((uint16_t *)image->pixels)[i] = (i % 10 + 0.5) / 10 >= from ? 65535 : 0;
    *box = (struct box){ .cloud = { .size = { 200, 100, 50 }, .density = 0.5, .extinction = 0.04, .seed = seed } };
    box->placed = (struct lom_placed_cloud){ .cloud = &box->cloud,
                                             .middle = { 10, 20, 30 },
                                             .axes = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
                                             .light = lom_create_light_grid(image, 1, same, NULL) };
    lom_free_image(image);
}

static void free_box(struct box *box)
{
    lom_free_light_grid(box->placed.light);
}

static void they_absorb_what_the_density_does(void)
{
    for (int i = 0; i < 12; i++) {
        struct box box;
        double from = 0.1 * (i / 2), opacity = 0.2 + 0.05 * i, sum = 0;
        fill_box(&box, from, 1);
        struct lom_cloud_sprites *s = lom_make_cloud_sprites(&box.placed, models[i % 2], opacity, NULL);
        for (int k = 0; k < s->count; k++) {
            double side = 2 * (double)s->places[LOM_SPRITE_FLOATS * k + LOM_SPRITE_HALF];
            sum += side * side * opacity * (double)s->depth;
        }
        double want = 0.02 * 200 * 100 * 50 * (1 - from); /* extinction times volume */
        CHECK(lom_magnitude(sum / want - 1) < 1e-5, "from %g: %g m2, not %g", from, sum, want);
        lom_free_cloud_sprites(s);
        free_box(&box);
    }
}

static void they_lie_where_it_is(void)
{
    for (int m = 0; m < 2; m++) {
        struct box box;
        fill_box(&box, 0.5, 7);
        struct lom_cloud_sprites *s = lom_make_cloud_sprites(&box.placed, models[m], 0.3, NULL);
        double mean[3] = { 0 };
        for (int k = 0; k < s->count; k++) {
            const float *at = s->places + LOM_SPRITE_FLOATS * k;
            double c = (double)at[LOM_SPRITE_COSINE], d = (double)at[LOM_SPRITE_SINE];
            CHECK(at[LOM_SPRITE_IN_BOX] >= 0.5f && at[LOM_SPRITE_IN_BOX] <= 1 && at[LOM_SPRITE_IN_BOX + 1] >= 0 &&
                      at[LOM_SPRITE_IN_BOX + 1] <= 1,
                  "%d, %d: in the half that is empty", m, k);
            CHECK(lom_magnitude(c * c + d * d - 1) < 1e-6, "%d, %d: turned by %g, %g", m, k, c, d);
            for (int i = 0; i < 3; i++) {
                double metres = ((double)at[LOM_SPRITE_IN_BOX + i] - 0.5) * box.cloud.size[i];
                CHECK(lom_magnitude(metres - (double)at[LOM_SPRITE_X + i]) < 1e-4, "%d, %d: both places are one", m, k);
                mean[i] += (double)at[LOM_SPRITE_IN_BOX + i] / s->count;
            }
        }
        double bound = 3 * 0.3 / lom_double_sqrt(s->count); /* three times the deviation of a mean of even numbers */
        CHECK(s->count == (m == 0 ? 400 : 24) && lom_magnitude(mean[0] - 0.75) < bound / 2 &&
                  lom_magnitude(mean[1] - 0.5) < bound && lom_magnitude(mean[2] - 0.5) < bound,
              "%d: about %g, %g, %g", m, mean[0], mean[1], mean[2]);
        lom_free_cloud_sprites(s);
        free_box(&box);
    }
}

static void they_follow_the_seed(void)
{
    struct box a, b;
    fill_box(&a, 0.2, 1);
    fill_box(&b, 0.2, 2);
    struct lom_cloud_sprites *one = lom_make_cloud_sprites(&a.placed, LOM_CLOUDS_SPRITES, 0.3, NULL);
    struct lom_cloud_sprites *again = lom_make_cloud_sprites(&a.placed, LOM_CLOUDS_SPRITES, 0.3, NULL);
    struct lom_cloud_sprites *other = lom_make_cloud_sprites(&b.placed, LOM_CLOUDS_SPRITES, 0.3, NULL);
    const size_t size = 400 * LOM_SPRITE_FLOATS * sizeof(float);
    CHECK(memcmp(one->places, again->places, size) == 0 && memcmp(one->places, other->places, size) != 0, "by seed");
    lom_free_cloud_sprites(one);
    lom_free_cloud_sprites(again);
    lom_free_cloud_sprites(other);
    free_box(&a);
    free_box(&b);
}

static void they_are_drawn_from_far_to_near(void)
{
    for (int i = 0; i < 20; i++) {
        struct box box;
        fill_box(&box, 0, 3);
        struct lom_cloud_sprites *s = lom_make_cloud_sprites(&box.placed, models[i % 2], 0.3, NULL);
        struct lom_cloud_view view = { .eye = { 37.0 * i - 300, 20 + 11.0 * i, 500 - 60.0 * i } };
        view.projection.m[3][2] = -1;
        lom_sort_cloud_sprites(s, &box.placed, &view);
        double before = 1e30, sums[2] = { 0, 0 };
        for (int k = 0; k < s->count; k++) {
            const float *at = s->drawn + LOM_SPRITE_FLOATS * k;
            double x = 10 + (double)at[0] - view.eye.x, y = 20 + (double)at[1] - view.eye.y,
                   z = 30 + (double)at[2] - view.eye.z, square = x * x + y * y + z * z;
            CHECK(square <= before * (1 + 1e-6), "%d: %d is farther than the one before", i, k);
            before = square;
            sums[0] += (double)at[0] * (double)at[7];
            sums[1] += (double)s->places[LOM_SPRITE_FLOATS * k] * (double)s->places[LOM_SPRITE_FLOATS * k + 7];
        }
        CHECK(lom_magnitude(sums[0] - sums[1]) < 1e-6, "%d: each once", i);
        lom_free_cloud_sprites(s);
        free_box(&box);
    }
}

static void nothing_makes_none(void)
{
    struct box box;
    fill_box(&box, 2, 1);
    struct lom_cloud_sprites *s = lom_make_cloud_sprites(&box.placed, LOM_CLOUDS_SPRITES, 0.3, NULL);
    CHECK(s != NULL && s->count == 0 && s->depth == 0, "an empty volume");
    lom_free_cloud_sprites(s);
    free_box(&box);
}

static void a_puff_is_round(void)
{
    lom_image *puff = lom_make_cloud_puff(64, 1, NULL);
    const uint8_t *pixels = puff->pixels, *middle = pixels + 4 * (64 * 32 + 32);
    for (int i = 0; i < 64; i++)
        CHECK(pixels[4 * i + 3] == 0 && pixels[4 * 64 * i + 3] == 0, "clear border");
    CHECK(middle[3] > 100 && middle[0] == 255, "white, thick: %d, %d", middle[0], middle[3]);
    CHECK(lom_make_cloud_puff(7, 1, NULL) == NULL && lom_make_cloud_puff(1025, 1, NULL) == NULL, "8 to 1024");
    lom_free_image(puff);
}

int main(int argc, char **argv)
{
    RUN(they_absorb_what_the_density_does);
    RUN(they_lie_where_it_is);
    RUN(they_follow_the_seed);
    RUN(they_are_drawn_from_far_to_near);
    RUN(nothing_makes_none);
    RUN(a_puff_is_round);
    return check_result();
}
