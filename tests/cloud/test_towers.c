/* Proves: clouds that are higher than wide stand on their own towers: no disc at the base is wider than what it bears. */
#include "check.h"

#include <lom/cloud.h>

#include <string.h>

/* Columns that hold something between two heights, in parts of the volume's. */
static int covered(const lom_image *volume, double from, double to)
{
    int count = 0;
    for (int z = 0; z < volume->depth; z++)
        for (int x = 0; x < volume->width; x++) {
            bool any = false;
            for (int y = (int)(from * volume->height); y < (int)(to * volume->height); y++) {
                uint16_t density;
                memcpy(&density, lom_image_pixel(volume, x, y, z), sizeof density);
                any |= density > 6553;
            }
            count += any;
        }
    return count;
}

static void no_disc_is_below_a_tower(void)
{
    static const char *const kinds[] = { "cumulus_congestus", "cumulonimbus" };
    for (int k = 0; k < 2; k++)
        for (uint64_t seed = 1; seed <= 4; seed++) {
            lom_error error = { 0 };
            lom_image *volume = lom_make_cloud(&(lom_cloud_desc){ kinds[k], 64, 64, 64, seed }, &error);
            CHECK(volume != NULL, "%s", error.text);
            if (volume == NULL)
                continue;
            int foot = covered(volume, 0.03, 0.12), tower = covered(volume, 0.16, 0.4);
            CHECK(foot < 1.2 * tower, "%s, seed %d: %d columns at the foot, %d above", kinds[k], (int)seed, foot,
                  tower);
            lom_free_image(volume);
        }
}

int main(int argc, char **argv)
{
    RUN(no_disc_is_below_a_tower);
    return check_result();
}
