/* The work that dials change. In: a drawer. Out: counters of a frame, and their weighted sum. Invariant: whole
 * numbers alone, none of which depends on threads, lanes, tiles or the clock. */
#include "measure/dial_work.h"

#include "render/renderer.h"
#include "render/tallied.h"

/* Weights in tenths, from the processor time of one thread of 8 lanes over settings of lake, gale and cumulus at 160x90
 * (docs/trade.md): within a third of each. */
enum kind { PIXEL, VERTEX, BINNED, FRAGMENT, LOOKUP, STEP, SAMPLE, TRANSFORMED, KINDS };
static const struct {
    const char *name;
    uint64_t weight;
} kinds[KINDS] = {
    [PIXEL] = { "pixels of the frame in each pass", 5 },
    [VERTEX] = { "vertices", 280 },
    [BINNED] = { "triangles that may cover a pixel", 1000 },
    [FRAGMENT] = { "fragments", 150 },
    [LOOKUP] = { "texture lookups", 400 },
    [STEP] = { "steps of rays", 950 },
    [SAMPLE] = { "samples beyond the first of a pixel", 1000 },
    [TRANSFORMED] = { "N^2 log2 N of Fourier transforms", 8 },
};

const char *lom_dial_work_kind(size_t i, uint64_t *weight)
{
    if (i >= KINDS)
        return NULL;
    *weight = kinds[i].weight;
    return kinds[i].name;
}

uint64_t lom_dial_work_count(const lom_dial_work *work, size_t i)
{
    const lom_counters *c = &work->counters;
    const uint64_t counts[KINDS] = { work->pixels,  c->vertices, c->triangles_binned, c->fragments,
                                     work->lookups, work->steps, work->samples,       work->transformed };
    return i < KINDS ? counts[i] : 0;
}

/* Sums over the picture's texels. */
static void add_tallied(const lom_renderer *renderer, const lom_image *picture, lom_dial_work *work)
{
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++) {
            const lom_tally *tally = lom_tallied(lom_renderer_device(renderer), x, y);
            work->lookups += tally != NULL ? tally->lookups : 0;
            work->steps += tally != NULL ? tally->steps : 0;
        }
}

/* A frame whose picture is tallied has one sample a pixel: what its fragments did is scaled to those of the frame. */
static bool tally(const lom_drawer *drawer, const lom_frame_desc *desc, lom_dial_work *work, lom_error *error)
{
    const lom_tally_desc wanted = { .lookups = true, .steps = true };
    lom_frame frame = { .image = NULL };
    const bool done = lom_draw_tallied(drawer->renderer, desc, wanted, LOM_TARGET_COLOR, &frame, error);
    if (done) {
        add_tallied(drawer->renderer, frame.image, work);
        const uint64_t tallied = frame.counters.fragments > 0 ? frame.counters.fragments : 1;
        work->lookups = work->lookups * work->counters.fragments / tallied;
        work->steps = work->steps * work->counters.fragments / tallied;
    }
    lom_tally_target(drawer->renderer->device, NULL);
    lom_free_image(frame.image);
    return done;
}

static uint64_t transformed(const lom_drawer *drawer, uint64_t transforms)
{
    uint64_t size = (uint64_t)drawer->scene->water.waves.size, logarithm = 0;
    while (size >> (logarithm + 1) != 0)
        logarithm++;
    return transforms * size * size * logarithm;
}

bool lom_measure_dial_work(const lom_drawer *drawer, const lom_subject *subject, lom_dial_work *work, lom_error *error)
{
    lom_frame_desc desc = subject->frame;
    lom_frame frame = { .image = NULL };
    desc.frame++;
    *work = (lom_dial_work){ .work = 0 };
    if (!lom_render_frame(drawer->renderer, &desc, &frame, error))
        return false;
    work->counters = frame.counters;
    work->transformed = transformed(drawer, frame.counters.transforms);
    work->samples =
        (uint64_t)(drawer->scene->output.samples - 1) * (uint64_t)frame.image->width * (uint64_t)frame.image->height;
    lom_free_image(frame.image);
    if (!tally(drawer, &desc, work, error))
        return false;
    for (size_t i = 0; i < KINDS; i++)
        work->work += kinds[i].weight * lom_dial_work_count(work, i);
    work->work /= 10;
    return true;
}
