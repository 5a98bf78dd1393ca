/* Proves: the water of which nothing is shaded twice that the first pass shows has the bytes of the one that draws its
 * ground three times, at every size and with several samples; and it shades less. */
#include "check.h"

#include "measure/measure.h"

/* The picture's hash, 0 on failure, and how many packets were shaded. */
static uint64_t draw(const char *name, lom_device *device, int width, int height, int samples, uint64_t *packets)
{
    lom_error error = { 0 };
    lom_image *picture = NULL;
    lom_workload *workload = lom_create_workload(name, width, height, LOM_FILTERING_FIXED, LOM_FILTERING_FIXED, &error);
    uint64_t before = lom_device_counters(device).packets;
    if (workload != NULL)
        lom_set_workload_samples(workload, samples);
    if (workload != NULL && lom_draw_workload(workload, device, &error))
        picture = lom_workload_picture(workload, device, &error);
    *packets = lom_device_counters(device).packets - before;
    CHECK(picture != NULL, "%s %dx%d: %s", name, width, height, error.text);
    uint64_t hash = picture != NULL ? lom_hash_image(picture) : 0;
    lom_free_image(picture);
    lom_free_workload(workload);
    return hash;
}

static void test_the_same_water_is_drawn_once(void)
{
    static const int sizes[][3] = { { 320, 180, 1 }, { 33, 71, 1 }, { 257, 40, 1 }, { 1, 1, 1 }, { 80, 45, 4 } };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        uint64_t packets[2];
        const int *s = sizes[i];
        uint64_t all = draw("water", device, s[0], s[1], s[2], &packets[0]);
        uint64_t once = draw("water-skip", device, s[0], s[1], s[2], &packets[1]);
        CHECK(all == once, "%dx%d, %d samples: another picture", s[0], s[1], s[2]);
        CHECK(i != 0 || packets[1] < packets[0], "%d packets, not less than %d", (int)packets[1], (int)packets[0]);
    }
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(test_the_same_water_is_drawn_once);
    return check_result();
}
