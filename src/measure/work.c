/* Declared work. In: a renderer. Out: what a frame did, and its weighted sum. Invariant: whole numbers alone, of a
 * device that is always the same, none of which depends on the machine or the clock. */
#include "measure/work.h"

#include "render/renderer.h"
#include "render/tallied.h"

/* In tenths (docs/trade.md says from what; bench/results/declared-work.md how near). */
static const struct {
    const char *name;
    uint64_t weight;
} kinds[LOM_WORK_KINDS] = {
    [LOM_WORK_PIXELS] = { "pixels of the frame in each pass", 5 },
    [LOM_WORK_VERTICES] = { "vertices", 280 },
    [LOM_WORK_TRIANGLES] = { "triangles that may cover a pixel", 1000 },
    [LOM_WORK_FRAGMENTS] = { "fragments", 150 },
    [LOM_WORK_LOOKUPS] = { "texture lookups", 400 },
    [LOM_WORK_STEPS] = { "steps of rays", 950 },
    [LOM_WORK_SAMPLES] = { "samples beyond the first of a pixel", 1000 },
    [LOM_WORK_TRANSFORMED] = { "N^2 log2 N of Fourier transforms", 8 },
    [LOM_WORK_SHALLOW] = { "cells of shallow water in each step", 300 },
    [LOM_WORK_PARTICLES] = { "particles of liquids in each step", 5000 },
};

const char *lom_describe_work(size_t kind, uint64_t *weight)
{
    if (kind >= LOM_WORK_KINDS)
        return NULL;
    *weight = kinds[kind].weight;
    return kinds[kind].name;
}

uint64_t lom_weigh_work(const lom_declared_work *work)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < LOM_WORK_KINDS; i++)
        sum += kinds[i].weight * work->count[i];
    return sum / 10;
}

lom_device_desc lom_counting_device(void)
{
    return (lom_device_desc){ .threads = 1, .lanes = 4, .tile = 64 };
}

/* ---- what a frame did ---- */

static uint64_t transformed(const lom_scene *scene, uint64_t transforms)
{
    uint64_t size = (uint64_t)scene->water.waves.size, logarithm = 0;
    while (size >> (logarithm + 1) != 0)
        logarithm++;
    return transforms * size * size * logarithm;
}

static uint64_t shallow_cells(const lom_shallow_water *shallow)
{
    const double x = shallow->size[0], z = shallow->size[1];
    const double narrow = x <= 0 || z <= 0 ? 1 : x < z ? x / z : z / x;
    return lom_count_of(narrow * shallow->cells * shallow->cells, (size_t)1 << 30);
}

/* Of a liquid, in the mean over all: what its blocks hold at the beginning. */
static uint64_t particles_of(const lom_scene *scene)
{
    double sum = 0;
    for (size_t i = 0; i < scene->fluid_count; i++) {
        const lom_fluid_params *fluid = &scene->fluids[i];
        for (size_t k = 0; k < fluid->block_count; k++) {
            double count = 1;
            for (int axis = 0; axis < 3; axis++)
                count *= (fluid->blocks[k].high[axis] - fluid->blocks[k].low[axis]) / fluid->spacing;
            sum += count;
        }
    }
    return scene->fluid_count > 0 ? lom_count_of(sum / (double)scene->fluid_count, (size_t)1 << 30) : 0;
}

static void count_frame(const lom_scene *scene, const lom_frame *frame, lom_declared_work *work)
{
    const lom_counters *c = &frame->counters;
    const uint64_t pixels = (uint64_t)frame->image->width * (uint64_t)frame->image->height;
    *work = (lom_declared_work){ .count = {
                                     [LOM_WORK_PIXELS] = pixels * c->passes,
                                     [LOM_WORK_VERTICES] = c->vertices,
                                     [LOM_WORK_TRIANGLES] = c->triangles_binned,
                                     [LOM_WORK_FRAGMENTS] = c->fragments,
                                     [LOM_WORK_SAMPLES] = pixels * (uint64_t)(scene->output.samples - 1),
                                     [LOM_WORK_TRANSFORMED] = transformed(scene, c->transforms),
                                     [LOM_WORK_SHALLOW] = frame->shallow_steps * shallow_cells(&scene->shallow),
                                     [LOM_WORK_PARTICLES] = frame->fluid_steps * particles_of(scene),
                                 } };
}

/* Sums over the picture's texels. */
static void add_tallied(const lom_device *device, const lom_image *picture, lom_declared_work *work)
{
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++) {
            const lom_tally *tally = lom_tallied(device, x, y);
            work->count[LOM_WORK_LOOKUPS] += tally != NULL ? tally->lookups : 0;
            work->count[LOM_WORK_STEPS] += tally != NULL ? tally->steps : 0;
        }
}

/* A frame whose picture is tallied has one sample a pixel: what its fragments did is scaled to those of the frame. */
static bool tally(lom_renderer *renderer, const lom_frame_desc *desc, lom_declared_work *work, lom_error *error)
{
    const lom_tally_desc wanted = { .lookups = true, .steps = true };
    lom_frame frame = { .image = NULL };
    const bool done = lom_draw_tallied(renderer, desc, wanted, LOM_TARGET_COLOR, &frame, error);
    if (done) {
        const uint64_t fragments = work->count[LOM_WORK_FRAGMENTS];
        const uint64_t tallied = frame.counters.fragments > 0 ? frame.counters.fragments : 1;
        add_tallied(renderer->device, frame.image, work);
        work->count[LOM_WORK_LOOKUPS] = work->count[LOM_WORK_LOOKUPS] * fragments / tallied;
        work->count[LOM_WORK_STEPS] = work->count[LOM_WORK_STEPS] * fragments / tallied;
    }
    lom_tally_target(renderer->device, NULL);
    lom_free_image(frame.image);
    return done;
}

bool lom_count_work(lom_renderer *renderer, const lom_scene *scene, const lom_frame_desc *desc, lom_declared_work *work,
                    lom_error *error)
{
    lom_frame frame = { .image = NULL };
    *work = (lom_declared_work){ .count = { 0 } };
    if (!lom_render_frame(renderer, desc, &frame, error))
        return false;
    count_frame(scene, &frame, work);
    lom_free_image(frame.image);
    return renderer->reference != NULL || tally(renderer, desc, work, error);
}
