/* Proves: a workload's picture depends on nothing but its size (not on lanes, threads, tiles, chunks, batches or what
 * was drawn before), skipping empty space changes no byte, and the pictures are those that an independent
 * implementation of OpenGL drew from the same formulas (bench/peers/pictures): foliage least, since its holes are where
 * an alpha of 1/2 is passed and the peer's levels of detail are approximate. */
#include "check.h"

#include "measure/measure.h"

static const lom_device_desc devices[] = {
    { .threads = 1, .lanes = 4 },
    { .threads = 2, .lanes = 8, .tile = 32, .chunk = 1000, .batch = 3 },
    { .threads = 3, .lanes = 16, .tile = 16, .chunk = 65536, .batch = 1 },
    { .threads = 1, .lanes = 8, .plain = true, .tile = 16, .chunk = 4096, .batch = 1024 },
    { .threads = 2, .lanes = 16, .plain = true, .tile = 32 },
    { .threads = 3, .lanes = 4, .tile = 32, .chunk = 3000, .batch = 7 },
    { .threads = 2, .lanes = 16, .tile = 64, .chunk = 777, .batch = 16 },
    { .threads = 3, .lanes = 8, .tile = 64, .chunk = 8192, .batch = 2 },
};
enum { DEVICES = sizeof devices / sizeof devices[0], WIDTH = 160, HEIGHT = 90 };

/* The hash of a fresh frame; 0 on failure, which is reported. */
static uint64_t hash_of(lom_workload *workload, const lom_device_desc *desc, const char *name)
{
    lom_error error = { 0 };
    lom_device *device = lom_open_device(desc);
    lom_image *picture = NULL;
    if (lom_draw_workload(workload, device, &error))
        picture = lom_workload_picture(workload, device, &error);
    CHECK(picture != NULL, "%s: %s", name, error.text);
    uint64_t hash = picture != NULL ? lom_hash_image(picture) : 0;
    lom_free_image(picture);
    lom_close_device(device);
    return hash;
}

static void check_one_hash(const char *name)
{
    lom_error error = { 0 };
    lom_workload *workload = lom_create_workload(name, WIDTH, HEIGHT, LOM_FILTERING_FLOAT, LOM_FILTERING_FLOAT, &error);
    CHECK(workload != NULL, "%s", error.text);
    if (workload == NULL)
        return;
    uint64_t first = hash_of(workload, &devices[0], name);
    for (int i = 1; i < DEVICES; i++) {
        uint64_t hash = hash_of(workload, &devices[i], name);
        CHECK(hash == first,
              "%s: %016llx with %d threads, %d lanes%s, tile %d, chunk %d, batch %d, but %016llx at first", name,
              (unsigned long long)hash, devices[i].threads, devices[i].lanes, devices[i].plain ? " plain" : "",
              devices[i].tile, devices[i].chunk, devices[i].batch, (unsigned long long)first);
    }
    lom_free_workload(workload);
}

static void test_one_hash_for_every_device(void)
{
    for (int i = 0; i < lom_workload_count(); i++)
        check_one_hash(lom_workload_name(i));
}

static lom_image *draw(const char *name, lom_device *device, int width, int height, lom_error *error)
{
    lom_workload *workload = lom_create_workload(name, width, height, LOM_FILTERING_FLOAT, LOM_FILTERING_FLOAT, error);
    lom_image *picture = NULL;
    if (workload != NULL && lom_draw_workload(workload, device, error))
        picture = lom_workload_picture(workload, device, error);
    lom_free_workload(workload);
    return picture;
}

/* Peak signal-to-noise ratio of the colours as a ratio: 255^2 / mean squared difference. */
static double signal_to_noise(const lom_image *a, const lom_image *b)
{
    double sum = 0;
    size_t pixels = (size_t)a->width * (size_t)a->height;
    for (size_t i = 0; i < pixels; i++)
        for (size_t k = 0; k < 3; k++) {
            double d = (double)a->pixels[4 * i + k] - (double)b->pixels[4 * i + k];
            sum += d * d;
        }
    return sum == 0 ? 1e30 : 255.0 * 255.0 * 3 * (double)pixels / sum;
}

/* Drawn at the size of the peer's picture. */
static void check_against_peer(const char *name, lom_device *device, double least_db)
{
    char path[128];
    lom_error error = { 0 };
    snprintf(path, sizeof path, "bench/peers/pictures/%s.png", name);
    lom_image *file = lom_read_image(path, &error); /* gray where the picture is */
    lom_image *peer = file != NULL ? lom_convert_image(file, LOM_FORMAT_RGBA8, &error) : NULL;
    lom_image *picture = peer != NULL ? draw(name, device, peer->width, peer->height, &error) : NULL;
    CHECK(picture != NULL, "%s: %s", name, error.text);
    if (picture != NULL) {
        double db = 10 * lom_double_log(signal_to_noise(picture, peer)) / lom_double_log(10);
        CHECK(db >= least_db, "%s: %.2f dB against %s", name, db, path);
        printf("  %s: %.2f dB\n", name, db);
    }
    lom_free_image(file);
    lom_free_image(peer);
    lom_free_image(picture);
}

static void test_pictures_are_the_peers(void)
{
    static const struct {
        const char *name;
        double least_db;
    } peers[] = { { "fill", 60 },    { "blend", 45 },     { "depth", 35 }, { "mesh", 35 },
                  { "terrain", 35 }, { "water", 35 },     { "cloud", 35 }, { "sprites", 45 },
                  { "foliage", 33 }, { "gradients", 45 }, { "draws", 37 }, { "textured", 42 } };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 0 });
    for (size_t i = 0; i < sizeof peers / sizeof peers[0]; i++)
        check_against_peer(peers[i].name, device, peers[i].least_db);
    lom_close_device(device);
}

static void test_skipping_draws_the_same_cloud(void)
{
    static const int sizes[][2] = { { 320, 180 }, { 33, 71 }, { 1, 1 } };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    for (int i = 0; i < 3; i++) {
        lom_error error = { 0 };
        lom_image *walked = draw("cloud", device, sizes[i][0], sizes[i][1], &error);
        lom_image *skipped = draw("cloud-skip", device, sizes[i][0], sizes[i][1], &error);
        CHECK(walked != NULL && skipped != NULL, "%s", error.text);
        if (walked != NULL && skipped != NULL)
            CHECK(lom_hash_image(walked) == lom_hash_image(skipped), "%dx%d", sizes[i][0], sizes[i][1]);
        lom_free_image(walked);
        lom_free_image(skipped);
    }
    lom_close_device(device);
}

static void test_clear_is_the_colour(void)
{
    lom_error error = { 0 };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_image *picture = draw("clear", device, 67, 41, &error);
    CHECK(picture != NULL, "%s", error.text);
    for (int i = 0; picture != NULL && i < 67 * 41; i++)
        CHECK(memcmp(picture->pixels + 4 * i, (uint8_t[4]){ 26, 51, 77, 255 }, 4) == 0, "pixel %d", i);
    lom_free_image(picture);
    lom_close_device(device);
}

static void test_wrong_workloads_are_refused(void)
{
    lom_error error = { 0 };
    CHECK(lom_create_workload("terain", 8, 8, LOM_FILTERING_FLOAT, LOM_FILTERING_FLOAT, &error) == NULL &&
              strstr(error.text, "\"terrain\"") != NULL,
          "%s", error.text);
    error.code = LOM_OK;
    CHECK(lom_create_workload("fill", 0, 8, LOM_FILTERING_FLOAT, LOM_FILTERING_FLOAT, &error) == NULL &&
              error.code == LOM_ERROR_USAGE,
          "%s", error.text);
    error.code = LOM_OK;
    CHECK(lom_create_workload("fill", 8, 16385, LOM_FILTERING_FLOAT, LOM_FILTERING_FLOAT, &error) == NULL &&
              error.code == LOM_ERROR_USAGE,
          "%s", error.text);
    lom_free_workload(NULL);
}

static void test_timing(void)
{
    lom_error error = { 0 };
    lom_timing timing = { 0 };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 1 });
    lom_workload *workload = lom_create_workload("fill", 64, 64, LOM_FILTERING_FLOAT, LOM_FILTERING_FLOAT, &error);
    CHECK(lom_time_workload(workload, device, 1, 4, &timing, &error), "%s", error.text);
    CHECK(timing.frames == 4 && timing.min_ms > 0 && timing.min_ms <= timing.median_ms, "%d frames, %g, %g",
          timing.frames, timing.min_ms, timing.median_ms);
    CHECK(timing.cold_ms > 0 && timing.read_ms > 0, "%g, %g", timing.cold_ms, timing.read_ms);
    CHECK(timing.counters.triangles == 16 && timing.counters.vertices == 32, "%llu triangles, %llu vertices",
          (unsigned long long)timing.counters.triangles, (unsigned long long)timing.counters.vertices);
    /* one before, four timed, two read back */
    CHECK(lom_device_counters(device).passes == 7, "%llu passes",
          (unsigned long long)lom_device_counters(device).passes);
    CHECK(!lom_time_workload(workload, device, 0, 0, &timing, &error), "no frames were timed");
    lom_free_workload(workload);
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(test_clear_is_the_colour);
    RUN(test_one_hash_for_every_device);
    RUN(test_skipping_draws_the_same_cloud);
    RUN(test_pictures_are_the_peers);
    RUN(test_wrong_workloads_are_refused);
    RUN(test_timing);
    return check_result();
}
