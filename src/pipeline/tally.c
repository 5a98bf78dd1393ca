/* Who keeps tallies. In: a target, passes that begin and end. Out: a tally for each of its texels, from the last pass on
 * that cleared it. */
#include "pipeline/tally.h"

#include "pipeline/check_device.h"
#include "pipeline/record.h"

#include <time.h>

void lom_free_tallier(struct lom_tallier *t)
{
    if (t == NULL)
        return;
    for (int i = 0; t->worker != NULL && i < t->workers; i++)
        lom_free_notes(&t->worker[i].notes);
    lom_release(t->worker);
    lom_release(t->texels);
    lom_release(t);
}

/* Kinds of notes that nobody asked for are not kept: they are most of what a tally would cost. */
static unsigned skipped_notes(const lom_tally_desc *desc)
{
    unsigned kept = 0;
    if (desc->lookups)
        kept |= 1u << LOM_NOTE_LOOKUP | 1u << LOM_NOTE_TEXEL;
    if (desc->steps)
        kept |= 1u << LOM_NOTE_STEP;
    if (desc->named != NULL)
        kept |= 1u << LOM_NOTE_VALUE;
    return ~kept;
}

static bool make_tallier(lom_device *device, const lom_tally_desc *desc)
{
    struct lom_tallier *t = device->tallier = lom_allocate(1, sizeof *t, &device->error);
    if (t == NULL)
        return false;
    t->desc = *desc;
    t->width = lom_texture_width(desc->target);
    t->height = lom_texture_height(desc->target);
    t->workers = device->desc.threads;
    t->worker = lom_allocate((size_t)t->workers, sizeof *t->worker, &device->error);
    t->texels = lom_allocate((size_t)t->width * (size_t)t->height, sizeof *t->texels, &device->error);
    for (int i = 0; t->worker != NULL && i < t->workers; i++)
        t->worker[i].notes.skipped = skipped_notes(desc);
    return t->worker != NULL && t->texels != NULL;
}

bool lom_tally_target(lom_device *device, const lom_tally_desc *desc)
{
    if (!lom_check_device(device, NULL))
        return false;
    if (device->in_pass)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A target is tallied from outside a pass.");
    if (desc != NULL && (desc->target == NULL || desc->target->owner != device ||
                         desc->target->kind != LOM_TEXTURE_2D || lom_describe_format(desc->target->format)->is_depth))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "What is tallied is a 2D texture of colours of the device.");
    lom_forget_records(device);
    return desc == NULL || (lom_has_recorded(device) && make_tallier(device, desc));
}

const lom_tally *lom_tallied(const lom_device *device, int x, int y)
{
    const struct lom_tallier *t = device != NULL ? device->tallier : NULL;
    if (t == NULL || x < 0 || y < 0 || x >= t->width || y >= t->height)
        return NULL;
    return &t->texels[(size_t)y * (size_t)t->width + (size_t)x];
}

/* ---- passes ---- */

void lom_tally_begin(lom_device *device)
{
    struct lom_tallier *t = device->tallier;
    struct lom_pass *pass = &device->pass;
    for (int i = 0; i < pass->colors; i++) {
        if (pass->color[i].texture != t->desc.target || !lom_is_first_slice(pass->color[i].slice))
            continue;
        pass->tallier = t;
        pass->is_recorded |= !t->desc.clock;
        pass->one_by_one |= !t->desc.clock;
        t->attachment = i;
        if (pass->desc.color_load[i] == LOM_LOAD_CLEAR)
            memset(t->texels, 0, (size_t)t->width * (size_t)t->height * sizeof *t->texels);
    }
}

bool lom_tally_end(lom_device *device)
{
    const struct lom_tallier *t = device->pass.tallier;
    bool failed = false;
    for (int i = 0; i < t->workers; i++)
        failed |= t->worker[i].notes.failed;
    return !failed || lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for what is tallied.");
}

lom_tally *lom_tally_at(const struct lom_pass *pass, int x, int y)
{
    const struct lom_tallier *t = pass->tallier;
    int column = x - pass->desc.origin_x, row = y - pass->desc.origin_y;
    if (column < 0 || row < 0 || column >= t->width || row >= t->height)
        return NULL;
    return &t->texels[(size_t)row * (size_t)t->width + (size_t)column];
}

/* ---- the clock ---- */

int64_t lom_tally_clock(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (int64_t)time.tv_sec * 1000000000 + time.tv_nsec;
}

void lom_tally_time(const struct lom_pass *pass, int number, int64_t since)
{
    double seconds = (double)(lom_tally_clock() - since) * 1e-9;
    int left = pass->tile_x0 + number % pass->tiles_x * pass->tile;
    int top = pass->tile_y0 + number / pass->tiles_x * pass->tile;
    for (int y = top; y < top + pass->tile; y++)
        for (int x = left; x < left + pass->tile; x++) {
            lom_tally *tally = lom_tally_at(pass, x, y);
            if (tally != NULL)
                tally->seconds += seconds;
        }
}
