/* Marching at its finest against the reference's exact integral (R2 to R1): what a cloud of noise lets through along rays
 * from anywhere. The reference (src/reference/volume.c) integrates a cubic from voxel to voxel in double and is held to
 * closed forms by tests/reference/test_volume.c; nothing of it is marched. */
#include "march/media.h"
#include "check.h"
#include "reference/volume.h"

#include <math.h>

enum { SIZE = 20, PACKETS = 512 / LOM_LANES };

static lom_image *make_noise(void)
{
    lom_image *image = lom_create_image(SIZE, SIZE, SIZE, LOM_FORMAT_R16, NULL);
    for (int i = 0; i < SIZE * SIZE * SIZE; i++) {
        const double x = i % SIZE - 9.5, y = i / SIZE % SIZE - 9.5, z = i / SIZE / SIZE - 9.5;
        const double inside = 1 - (x * x + y * y + z * z) / 100;
        const double density = inside > 0 ? inside * (0.3 + 0.7 * lom_random_uniform(5, (uint64_t)i)) : 0;
        ((uint16_t *)image->pixels)[i] = (uint16_t)(65535 * density + 0.5);
    }
    return image;
}

static void transmittance_is_the_references(void)
{
    static const double extinctions[] = { 0.1, 1, 6, 30 };
    lom_image *noise = make_noise();
    lom_medium *medium = lom_create_medium(noise, NULL);
    for (int e = 0; e < 4; e++) {
        uint32_t state = 1;
        double squares = 0, total = 0, largest = 0;
        int met = 0;
        lom_reference_volume *volume = lom_create_reference_volume(
            &(lom_reference_volume_desc){
                .density = noise, .low = { 0, 0, 0 }, .high = { 1, 1, 1 }, .extinction = extinctions[e] },
            NULL);
        lom_medium_desc desc = plain(medium, extinctions[e], 1.0 / 1024);
        desc.filtering = LOM_FILTERING_FLOAT;
        for (int packet = 0; packet < PACKETS; packet++) {
            lom_medium_rays rays = random_rays(&state, 0.3);
            const lom_medium_result seen = march(&rays, &desc);
            for (int i = 0; i < LOM_LANES; i++) {
                const lom_vec3 origin = { (double)rays.start.x[i], (double)rays.start.y[i], (double)rays.start.z[i] };
                const lom_vec3 along = { (double)rays.along.x[i], (double)rays.along.y[i], (double)rays.along.z[i] };
                const double metre = sqrt(along.x * along.x + along.y * along.y + along.z * along.z);
                const double depth = lom_volume_optical_depth(volume, origin, along, 0, 1e6) / metre;
                const double through = exp(-depth), off = fabs((double)seen.transmittance[i] - through);
                squares += off * off;
                total += through * through;
                largest = off > largest ? off : largest;
                met += depth > 0;
            }
        }
        printf("  extinction %g: %d of %d rays meet it; relative error %.2e, at most %.2e\n", extinctions[e], met,
               PACKETS * LOM_LANES, sqrt(squares / total), largest);
        CHECK(met > PACKETS * LOM_LANES / 10, "%d rays", met);
        CHECK(sqrt(squares / total) <= 1e-5, "extinction %g: %g", extinctions[e], sqrt(squares / total));
        lom_free_reference_volume(volume);
    }
    lom_free_medium(medium);
    lom_free_image(noise);
}

int main(int argc, char **argv)
{
    RUN(transmittance_is_the_references);
    return check_result();
}
