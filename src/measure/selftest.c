/* The self-test. In: nothing but the build and the processor. Out: one hash, the same on every machine, and the first
 * part that differs from what was recorded, or from itself at another width or number of threads. */
#include "measure/selftest.h"

#include "lanes/variants.h"

#include <stdio.h>

static const struct {
    const char *name;
    lom_selftest_plain *plain;
    lom_selftest_drawn *drawn;
    uint64_t expected; /* for LOM_PICTURE_VERSION */
} parts[LOM_SELFTEST_PARTS] = {
    { "numbers as text", lom_selftest_numbers, NULL, UINT64_C(0xd41f5567db0810e2) },
    { "random numbers", lom_selftest_random, NULL, UINT64_C(0x40a5933a9b32014a) },
    { "mathematics in double", lom_selftest_mathematics, NULL, UINT64_C(0x87cf371a80adb72b) },
    { "pictures and their files", lom_selftest_pictures, NULL, UINT64_C(0xd10f7eb556e53057) },
    { "lane mathematics", NULL, lom_selftest_draw_functions, UINT64_C(0x4d98c67283ec74f4) },
    { "textured surfaces", NULL, lom_selftest_draw_textured, UINT64_C(0xf631b38f26c6be2c) },
    { "clipping, discarding, blending", NULL, lom_selftest_draw_cut, UINT64_C(0xfe41c2be833b60fa) },
    { "cubes, volumes, depth formats", NULL, lom_selftest_draw_samples, UINT64_C(0x43433f091ad22038) },
    { "a scene with water", NULL, lom_selftest_draw_lake, UINT64_C(0xfb950f3e75517735) },
};

static const lom_device_desc devices[] = {
    { .threads = 1, .lanes = 4 },
    { .threads = 2, .lanes = 4, .tile = 16, .chunk = 100, .batch = 2 },
    { .threads = 1, .lanes = 8, .tile = 32 },
    { .threads = 3, .lanes = 8, .tile = 16, .chunk = 64, .batch = 3 },
    { .threads = 1, .lanes = 16 },
    { .threads = 2, .lanes = 16, .tile = 32, .chunk = 16, .batch = 1 },
    { .threads = 2, .lanes = 8, .plain = true },
    { .threads = 3, .lanes = 16, .plain = true, .tile = 16, .chunk = 333 },
};
enum { DEVICES = sizeof devices / sizeof devices[0] };

/* Whether nothing new is to be learned of that descriptor: the width is not built, or an earlier row draws by the same
 * variant where that is the plain one. */
static bool is_known(const lom_device_desc *desc)
{
    int variant = lom_find_variant(desc->lanes, desc->plain);
    return variant < 0 || (desc->plain && variant == lom_find_variant(desc->lanes, false));
}

static void differ(lom_selftest *result, const char *name, const lom_device_desc *device)
{
    if (result->difference[0] != 0)
        return;
    if (device == NULL)
        snprintf(result->difference, sizeof result->difference, "\"%s\" is not what picture version %d has.", name,
                 LOM_PICTURE_VERSION);
    else
        snprintf(result->difference, sizeof result->difference,
                 "\"%s\" depends on the device: %d lanes%s, %d threads, tiles of %d give something else.", name,
                 device->lanes, device->plain ? " without wide instructions" : "", device->threads,
                 device->tile != 0 ? device->tile : 64);
}

static bool run_part(lom_selftest *result, int index, lom_error *error)
{
    lom_selftest_part *part = &result->part[index];
    part->name = parts[index].name;
    part->expected = parts[index].expected;
    part->hash = LOM_HASH_START;
    if (parts[index].plain != NULL && !parts[index].plain(&part->hash, error))
        return false;
    for (int i = 0; parts[index].drawn != NULL && i < DEVICES; i++) {
        struct lom_selftest_sum sum = { .hash = LOM_HASH_START };
        if (i > 0 && is_known(&devices[i]))
            continue;
        if (!parts[index].drawn(&sum, &devices[i], error))
            return false;
        if (i == 0)
            part->hash = sum.hash;
        else if (sum.hash != part->hash)
            differ(result, part->name, &devices[i]);
    }
    if (part->hash != part->expected)
        differ(result, part->name, NULL);
    return true;
}

bool lom_run_selftest(lom_selftest *result, lom_error *error)
{
    lom_float_state state;
    bool done = true;
    *result = (lom_selftest){ .hash = LOM_HASH_START, .expected = LOM_HASH_START };
    lom_enter_float_state(&state);
    for (int i = 0; done && i < LOM_SELFTEST_PARTS; i++) {
        done = run_part(result, i, error);
        result->hash = lom_selftest_add(result->hash, result->part[i].hash);
        result->expected = lom_selftest_add(result->expected, parts[i].expected);
    }
    lom_leave_float_state(&state);
    return done;
}

lom_image *lom_draw_selftest(lom_error *error)
{
    lom_float_state state;
    struct lom_selftest_sum sum = { .sheet =
                                        lom_create_image(LOM_CELL_COLUMNS * LOM_CELL_WIDTH,
                                                         LOM_CELL_ROWS * LOM_CELL_HEIGHT, 1, LOM_FORMAT_RGB8, error) };
    bool done = sum.sheet != NULL;
    lom_enter_float_state(&state);
    for (int i = 0; done && i < LOM_SELFTEST_PARTS; i++)
        done = parts[i].drawn == NULL || parts[i].drawn(&sum, &(lom_device_desc){ 0 }, error);
    lom_leave_float_state(&state);
    if (done)
        return sum.sheet;
    lom_free_image(sum.sheet);
    return NULL;
}
