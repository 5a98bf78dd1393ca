/* Proves: a sheet's shape absorbs from above what the density does and lies at the middle of its mass; both noises have the
 * mean that they are divided by and no seam; the gradient is the phase function times what is left of the light, whose
 * closed forms are known, and is made anew when what it follows changes. */
#include "check.h"
#include "cloud/cloud_layers.h"

#include "base/numbers.h"
#include "image/texture.h"

#include <string.h>

/* A box of 200 x 100 x 50 m, of one density where x, y are at least parts of it. */
static struct lom_placed_cloud make_box(const lom_cloud *cloud, double from_x, double from_y)
{
    float same[256];
    for (int i = 0; i < 256; i++)
        same[i] = i / 255.0f;
    lom_image *image = lom_create_image(10, 6, 4, LOM_FORMAT_R16, NULL);
    for (int i = 0; i < 240; i++)
        ((uint16_t *)image->pixels)[i] = (i % 10 + 0.5) / 10 >= from_x && (i / 10 % 6 + 0.5) / 6 >= from_y ? 65535 : 0;
    struct lom_placed_cloud placed = { .cloud = cloud, .light = lom_create_light_grid(image, 1, same, NULL) };
    lom_free_image(image);
    return placed;
}

static void it_absorbs_what_the_density_does(void)
{
    const lom_cloud cloud = { .size = { 200, 100, 50 }, .density = 0.5, .extinction = 0.04 };
    for (int i = 0; i < 30; i++) {
        const double from_x = 0.1 * (i % 10), from_y = i / 10 / 3.0;
        struct lom_placed_cloud box = make_box(&cloud, from_x, from_y);
        struct lom_cloud_sheet *sheet = lom_make_cloud_sheet(&box, NULL);
        double depth = 0.02 * 100 * (1 - from_y), height = 100 * from_y / 2;
        CHECK(lom_magnitude((double)sheet->deepest - depth) < 1e-5, "%g, not %g", (double)sheet->deepest, depth);
        CHECK(lom_magnitude(sheet->height - height) < 1e-9, "at %g m, not %g", sheet->height, height);
        for (int x = 0; x < 10; x++) {
            const float *value = lom_texel(sheet->shape, 0, x, 1, 0);
            bool holds = (x + 0.5) / 10 >= from_x;
            CHECK(*value == (holds ? 1.0f : 0.0f), "column %d from %g: %g", x, from_x, (double)*value);
        }
        lom_free_cloud_sheet(sheet);
        lom_free_light_grid(box.light);
    }
}

static void nothing_absorbs_nothing(void)
{
    const lom_cloud cloud = { .size = { 200, 100, 50 }, .density = 0.5, .extinction = 0.04 };
    struct lom_placed_cloud box = make_box(&cloud, 2, 0);
    struct lom_cloud_sheet *sheet = lom_make_cloud_sheet(&box, NULL);
    CHECK(sheet != NULL && sheet->deepest == 0 && sheet->height == 0, "an empty volume");
    lom_free_cloud_sheet(sheet);
    lom_free_light_grid(box.light);
}

static void noise_has_no_seam(void)
{
    for (uint64_t seed = 1; seed <= 2; seed++) {
        lom_image *noise = lom_make_cloud_noise(256, seed, NULL);
        const uint8_t *at = noise->pixels;
        double mean = 0;
        int inner = 0, seam = 0;
        for (int i = 0; i < 256 * 256; i++)
            mean += at[i] / (255.0 * 65536);
        for (int i = 0; i < 256; i++) {
            for (int k = 0; k < 255; k++) {
                int step = lom_magnitude_int(at[256 * i + k + 1] - at[256 * i + k]);
                inner = step > inner ? step : inner;
            }
            int across = lom_magnitude_int(at[256 * i] - at[256 * i + 255]);
            int along = lom_magnitude_int(at[i] - at[256 * 255 + i]);
            seam = across > seam ? across : seam;
            seam = along > seam ? along : seam;
        }
        CHECK(lom_magnitude(mean - 0.4) < 0.03, "a mean of %g", mean);
        CHECK(inner > 5 && seam <= inner, "steps of %d at the seam, %d within", seam, inner);
        lom_free_image(noise);
    }
    CHECK(lom_make_cloud_noise(7, 1, NULL) == NULL && lom_make_cloud_noise(1025, 1, NULL) == NULL, "8 to 1024");
}

/* The gradient at texel x, y: what its angle and its depth are, and its three shares. */
static void look_up(const lom_image *image, int x, int y, double *mu, double *depth, double share[3])
{
    const double s = (x + 0.5) / LOM_GRADIENT_WIDTH, t = (y + 0.5) / LOM_GRADIENT_HEIGHT;
    float texel[3];
    memcpy(texel, lom_image_pixel(image, x, y, 0), sizeof texel);
    *mu = 1 - 2 * s * s; /* cos 2a = 1 - 2 sin^2 a */
    *depth = 4 * t / (1 - t);
    for (int i = 0; i < 3; i++)
        share[i] = (double)texel[i];
}

static void the_gradient_is_the_phase_function_dimmed(void)
{
    const lom_clouds rayleigh = { .albedo = 0.9, .phase = LOM_PHASE_RAYLEIGH };
    const lom_clouds lobe = { .albedo = 1, .phase = LOM_PHASE_HENYEY_GREENSTEIN, .forward = 0.5 };
    const lom_clouds even = { .albedo = 1, .phase = LOM_PHASE_ISOTROPIC };
    lom_image *one = lom_make_cloud_gradient(&rayleigh, 1, NULL), *other = lom_make_cloud_gradient(&lobe, 1, NULL);
    lom_image *two = lom_make_cloud_gradient(&even, 2, NULL);
    for (int y = 0; y < LOM_GRADIENT_HEIGHT; y++)
        for (int x = 0; x < LOM_GRADIENT_WIDTH; x++) {
            double mu, depth, share[3];
            look_up(one, x, y, &mu, &depth, share);
            double left = lom_double_exp(-depth), want = 0.25 * 0.9 * 0.75 * (1 + mu * mu) * left;
            CHECK(lom_magnitude(share[0] - want) < 1e-6, "%d, %d: %g, not %g", x, y, share[0], want);
            CHECK(lom_magnitude(share[1] + share[2] - 1) < 1e-6 &&
                      lom_magnitude(0.5 / share[1] - 1 - 0.75 * 0.15 * depth) < 1e-5 * (1 + depth),
                  "%d, %d: %g of the sky", x, y, share[1]);
            look_up(other, x, y, &mu, &depth, share);
            double apart = 1.25 - mu;
            want = 0.25 * 0.75 / (apart * lom_double_sqrt(apart)) * left;
            CHECK(lom_magnitude(share[0] - want) < 1e-5, "%d, %d: %g, not %g", x, y, share[0], want);
            look_up(two, x, y, &mu, &depth, share);
            want = 0.25 * left + 0.2 * lom_double_sqrt(lom_double_sqrt(left));
            CHECK(lom_magnitude(share[0] - want) < 1e-6, "%d, %d: %g, not %g", x, y, share[0], want);
        }
    lom_free_image(one);
    lom_free_image(other);
    lom_free_image(two);
}

static void it_is_made_when_its_light_changes(void)
{
    lom_clouds params = { .albedo = 1, .phase = LOM_PHASE_ISOTROPIC };
    struct lom_cloud_set set = { .params = &params, .quality = { .octaves = 1 } };
    CHECK(lom_update_cloud_gradient(&set, NULL) && set.gradient != NULL, "the first");
    const lom_texture *first = set.gradient;
    const float before = *(const float *)lom_texel(set.gradient, 0, 5, 0, 0);
    CHECK(lom_update_cloud_gradient(&set, NULL) && set.gradient == first, "the same is kept");
    params.albedo = 0.5;
    CHECK(lom_update_cloud_gradient(&set, NULL), "another");
    const float after = *(const float *)lom_texel(set.gradient, 0, 5, 0, 0);
    CHECK(lom_magnitude((double)after - 0.5 * (double)before) < 1e-6, "half the light: %g of %g", (double)after,
          (double)before);
    lom_free_texture(set.gradient);
}

int main(int argc, char **argv)
{
    RUN(it_absorbs_what_the_density_does);
    RUN(nothing_absorbs_nothing);
    RUN(noise_has_no_seam);
    RUN(the_gradient_is_the_phase_function_dimmed);
    RUN(it_is_made_when_its_light_changes);
    return check_result();
}
