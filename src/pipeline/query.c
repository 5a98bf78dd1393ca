/* Occlusion queries: made, named by draws, counted by workers, read. Invariant: a count is a sum of whole numbers, so who
 * counted which part of it changes nothing. */
#include "pipeline/check_device.h"
#include "pipeline/device.h"

struct lom_query {
    const lom_device *owner;
    size_t place; /* among the device's */
    uint64_t samples;
    bool counted; /* a pass has */
};

enum { LINE_COUNTS = 8 }; /* numbers of a cache line */

static void put(lom_device *device, size_t place, lom_query *query)
{
    device->queries[place] = query;
    query->place = place;
}

lom_query *lom_make_query(lom_device *device)
{
    if (!lom_check_device(device, NULL))
        return NULL;
    lom_query *query = NULL;
    if (lom_reserve(&device->queries, &device->query_capacity, device->query_count + 1, sizeof(lom_query *), NULL))
        query = lom_allocate(1, sizeof *query, NULL);
    if (query == NULL) {
        lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for another query.");
        return NULL;
    }
    query->owner = device;
    put(device, device->query_count++, query);
    return query;
}

void lom_release_query(lom_device *device, lom_query *query)
{
    if (device == NULL || query == NULL)
        return;
    if (device->in_pass) {
        lom_fail(&device->error, LOM_ERROR_USAGE, "A query cannot be freed within a pass.");
        return;
    }
    if (query->owner != device) {
        lom_fail(&device->error, LOM_ERROR_USAGE, "A device was asked to free a query that is not one of its own.");
        return;
    }
    put(device, query->place, device->queries[--device->query_count]);
    lom_release(query);
}

bool lom_query_result(const lom_query *query, uint64_t *samples)
{
    *samples = query != NULL ? query->samples : 0;
    return query != NULL && query->counted;
}

void lom_free_queries(lom_device *device)
{
    for (size_t i = 0; i < device->query_count; i++)
        lom_release(device->queries[i]);
    lom_release(device->queries);
    lom_release(device->counted);
}

/* ---- draws ---- */

bool lom_check_queries(lom_device *device, const lom_draw_desc *desc)
{
    const lom_query *condition = desc->condition;
    if ((desc->query != NULL && desc->query->owner != device) || (condition != NULL && condition->owner != device))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A draw of %s names a query of another device.",
                        desc->shader->name);
    if (condition != NULL && !condition->counted)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "The condition of a draw of %s is a query that no pass has counted yet.", desc->shader->name);
    return true;
}

bool lom_meets_condition(const lom_draw_desc *desc)
{
    return desc->condition == NULL || (desc->condition->samples != 0) != desc->condition_inverted;
}

size_t lom_name_query(lom_device *device, lom_query *query)
{
    struct lom_pass *pass = &device->pass;
    if (query->place < pass->queries)
        return query->place;
    put(device, query->place, device->queries[pass->queries]);
    put(device, pass->queries, query);
    return pass->queries++;
}

/* ---- the pass ---- */

/* Numbers from a worker's row to the next one's: on cache lines of their own. */
static size_t pitch_of(const struct lom_pass *pass)
{
    return (pass->queries + LINE_COUNTS - 1) / LINE_COUNTS * LINE_COUNTS;
}

bool lom_begin_counting(lom_device *device)
{
    const struct lom_pass *pass = &device->pass;
    const size_t pitch = pitch_of(pass), threads = (size_t)device->desc.threads;
    if (pass->queries == 0)
        return true;
    if (!lom_renew(&device->counted, &device->counted_capacity, pitch * threads, sizeof *device->counted, NULL))
        return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for a pass's queries.");
    memset(device->counted, 0, pitch * threads * sizeof *device->counted);
    for (size_t i = 0; i < threads; i++)
        device->worker_tiles[i].counted = device->counted + i * pitch;
    return true;
}

void lom_end_counting(lom_device *device)
{
    const struct lom_pass *pass = &device->pass;
    const size_t pitch = pitch_of(pass);
    for (size_t i = 0; i < pass->queries; i++) {
        lom_query *query = device->queries[i];
        query->samples = 0;
        query->counted = true;
        for (size_t worker = 0; worker < (size_t)device->desc.threads; worker++)
            query->samples += device->counted[worker * pitch + i];
    }
}
