/* Proves what light reaches clouds: one shadows another by Beer and Lambert's law, along every axis and never beside its
 * box, again only when something moved, whoever makes it; a file's density is read once; and the lighting in advance of the original model
 * is its formula, the same for 8 and 16 bits and floats. */
#include "check.h"
#include "cloud/cloud_draw.h"

#include <lom/cloud.h>

#include <math.h>
#include <unistd.h>

enum { SIDE = 8, VOXELS = SIDE * SIDE * SIDE };

static char solid[2][96]; /* two files of full density */

static bool make_files(void)
{
    const char *base = getenv("TMPDIR");
    lom_image *image = lom_create_image(SIDE, SIDE, SIDE, LOM_FORMAT_R8, NULL);
    lom_error error = { 0 };
    bool made = true;
    memset(image->pixels, 255, VOXELS);
    for (int i = 0; i < 2; i++) {
        snprintf(solid[i], sizeof solid[i], "%.60s/lom-solid-%ld-%d.nrrd", base != NULL ? base : "/tmp", (long)getpid(),
                 i);
        made = made && lom_write_image(solid[i], NULL, image, &error);
    }
    lom_free_image(image);
    if (!made)
        printf("FAIL test_light: %s\n", error.text);
    return made;
}

static const lom_clouds params = { .shadows = true };
static const struct lom_cloud_quality quality = { .error = 0.05, .stop = 0.004, .light_scale = 1, .octaves = 4 };

static lom_cloud cloud_at(double x, double y, double z)
{
    return (lom_cloud){ .file = solid[0],
                        .voxels = { SIDE, SIDE, SIDE },
                        .size = { 100, 100, 100 },
                        .position = { x, y, z },
                        .density = 1,
                        .extinction = 0.05,
                        .visible = true };
}

/* exp(-depth / 64) in the middle voxel of a cloud. */
static double share(const struct lom_cloud_set *set, size_t cloud)
{
    const lom_light_grid *g = set->clouds[cloud].light;
    size_t at = ((size_t)(SIDE / 2) * (SIDE + 1) + SIDE / 2) * (SIDE + 1) + SIDE / 2;
    return ((uint32_t)g->light[at] & 0xffff) / 65535.0;
}

/* The first cloud, another 500 m behind it towards the light, and one beside it that lies near enough for their spheres
 * to overlap along the light, but not for their boxes. */
static void clouds_shadow_what_lies_behind_them(void)
{
    for (int axis = 0; axis < 3; axis++) {
        lom_error error = { 0 };
        double light[3] = { 0 }, behind[3] = { 0 }, beside[3] = { 0 };
        struct lom_cloud_set *set;
        int swept;
        light[axis] = 1;
        behind[axis] = 500;
        beside[(axis + 1) % 3] = 130;
        lom_cloud clouds[3] = { cloud_at(0, 0, 0), cloud_at(behind[0], behind[1], behind[2]),
                                cloud_at(beside[0], beside[1], beside[2]) };
        CHECK(lom_load_cloud_set(clouds, 3, &params, &quality, NULL, NULL, &set, &error) && set->count == 3, "%s",
              error.text);
        CHECK(lom_light_clouds(set, light, NULL, &swept, &error) && swept == 3, "%d were swept: %s", swept, error.text);
        double shadowed = share(set, 0) / share(set, 1), depth = 0.05 * 100;
        CHECK(fabs(shadowed - exp(-depth / 64)) < 1e-4, "axis %d: %g, not %g", axis, shadowed, exp(-depth / 64));
        CHECK(share(set, 2) == share(set, 1), "axis %d: %g beside, %g alone", axis, share(set, 2), share(set, 1));
        CHECK(lom_light_clouds(set, light, NULL, &swept, &error) && swept == 0, "%d were swept again", swept);
        set->clouds[1].middle.x += 1000;
        set->clouds[1].middle.y += 1000;
        set->clouds[1].middle.z += 1000;
        CHECK(lom_light_clouds(set, light, NULL, &swept, &error) && swept == 2, "%d were swept after a move", swept);
        CHECK(share(set, 0) == share(set, 1), "axis %d: the shadow stays", axis);
        lom_free_cloud_set(set);
    }
}

/* Clouds in each other's shadows, by the caller and by three workers. */
static void workers_light_what_one_does(void)
{
    enum { CLOUDS = 9 };
    const double light[3] = { 0.6, 0, 0.8 };
    lom_cloud clouds[CLOUDS];
    struct lom_cloud_set *set[2];
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 3 });
    for (int i = 0; i < CLOUDS; i++)
        clouds[i] = cloud_at(70 * i, 20 * (i % 3), 90 * i);
    for (int k = 0; k < 2; k++) {
        int swept;
        CHECK(lom_load_cloud_set(clouds, CLOUDS, &params, &quality, NULL, NULL, &set[k], NULL), "no set");
        CHECK(lom_light_clouds(set[k], light, k == 0 ? NULL : device, &swept, NULL) && swept == CLOUDS, "%d", swept);
    }
    for (int i = 0; i < CLOUDS; i++) {
        const size_t bytes = (SIDE + 1) * (SIDE + 1) * (SIDE + 1) * sizeof *set[0]->clouds[i].light->light;
        CHECK(memcmp(set[0]->clouds[i].light->light, set[1]->clouds[i].light->light, bytes) == 0, "cloud %d", i);
        CHECK(i == CLOUDS - 1 || share(set[0], (size_t)i) < share(set[0], CLOUDS - 1), "cloud %d has no shadow", i);
    }
    lom_free_cloud_set(set[0]);
    lom_free_cloud_set(set[1]);
    lom_close_device(device);
}

static void files_are_read_once(void)
{
    lom_error error = { 0 };
    struct lom_cloud_set *set;
    lom_cloud clouds[4] = { cloud_at(0, 0, 0), cloud_at(200, 0, 0), cloud_at(400, 0, 0), cloud_at(600, 0, 0) };
    clouds[2].file = solid[1];
    clouds[3].file = NULL;
    clouds[3].kind = "cumulus_humilis";
    CHECK(lom_load_cloud_set(clouds, 4, &params, &quality, NULL, NULL, &set, &error) && set->count == 4, "%s",
          error.text);
    CHECK(set->density_count == 3 && set->clouds[0].density == set->clouds[1].density &&
              set->clouds[0].density != set->clouds[2].density && set->clouds[0].density != set->clouds[3].density,
          "%zu densities", set->density_count);
    lom_free_cloud_set(set);
}

/* A box of one density, lit along x: from voxel x there are n = 7 - x voxels towards the light. */
static void light_in_advance_is_its_formula(void)
{
    static const lom_format formats[3] = { LOM_FORMAT_R8, LOM_FORMAT_R16, LOM_FORMAT_R32F };
    static const double light[3] = { 2, 0, 0 };
    for (int code = 0; code < 256; code += 15)
        for (int f = 0; f < 3; f++) {
            lom_image *density = lom_create_image(SIDE, 2, 2, formats[f], NULL);
            for (int i = 0; i < SIDE * 4; i++)
                switch (f) {
                case 0:
                    density->pixels[i] = (uint8_t)code;
                    break;
                case 1:
                    ((uint16_t *)(void *)density->pixels)[i] = (uint16_t)(257 * code);
                    break;
                default:
                    ((float *)(void *)density->pixels)[i] = (float)code / 255;
                }
            lom_image *lit = lom_light_cloud_in_advance(density, light, 0.7, 1.2, NULL);
            for (int x = 0; x < SIDE; x++) {
                const uint8_t *got = lom_image_pixel(lit, x, 1, 0);
                double sum = 0, gray = 255;
                int n = 0;
                while (n < SIDE - 1 - x && sum <= 250) {
                    sum += 0.7 * code;
                    n++;
                }
                double mean = n == 0 ? 0 : sum > 250 ? sum / (n * 1.2) : sum / n;
                if (code != 0 && mean >= 100)
                    gray = mean < 255 ? 255 - mean : 0;
                CHECK(got[3] == code && fabs(got[0] - gray) <= 0.5 && got[1] == got[0] && got[2] == got[0],
                      "density %d in format %d, voxel %d: %d, not %g", code, f, x, got[0], gray);
            }
            lom_free_image(lit);
            lom_free_image(density);
        }
}

int main(int argc, char **argv)
{
    if (!make_files())
        return 1;
    RUN(clouds_shadow_what_lies_behind_them);
    RUN(workers_light_what_one_does);
    RUN(files_are_read_once);
    RUN(light_in_advance_is_its_formula);
    unlink(solid[0]);
    unlink(solid[1]);
    return check_result();
}
