/* Stencil: what draws say of it, and the two ends of its memory. In: a draw's descriptor; clear values or the attachment's
 * codes. Out: whether the draw can be; after the pass, the attachment's codes. Tile memory holds a word for each pixel, in
 * blocks of 2x2 as that of depth; the attachment a byte. */
#include "pipeline/device.h"
#include "pipeline/variants.h"

static bool is_known(const lom_stencil_face *face)
{
    return (unsigned)face->compare <= LOM_COMPARE_ALWAYS && (unsigned)face->fail < LOM_STENCIL_OPERATION_COUNT &&
           (unsigned)face->depth_fail < LOM_STENCIL_OPERATION_COUNT &&
           (unsigned)face->pass < LOM_STENCIL_OPERATION_COUNT;
}

bool lom_check_stencil(lom_device *device, const lom_draw_desc *desc)
{
    const lom_stencil *stencil = &desc->stencil;
    if (!stencil->enabled)
        return true;
    if (!device->pass.has_stencil)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "A draw of %s tests a stencil, but the pass has no depth attachment with one.",
                        desc->shader->name);
    if (!is_known(&stencil->front) || (stencil->two_sided && !is_known(&stencil->back)))
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "The stencil of a draw of %s has a comparison or an operation that is none.",
                        desc->shader->name);
    return true;
}

void lom_resolve_stencil_state(lom_stencil *stencil)
{
    if (stencil->front.compare == LOM_COMPARE_DEFAULT)
        stencil->front.compare = LOM_COMPARE_ALWAYS;
    if (stencil->back.compare == LOM_COMPARE_DEFAULT)
        stencil->back.compare = LOM_COMPARE_ALWAYS;
    if (!stencil->two_sided)
        stencil->back = stencil->front;
}

/* ---- memory ---- */

/* The pixels of a tile that lie in the attachment: first, and one past the last. */
struct inside {
    int x, y; /* the attachment's pixel that the tile's first one is */
    int x0, y0, x1, y1;
};

static struct inside find_inside(const struct lom_pass *pass, int number)
{
    const int edge = pass->tile;
    struct inside p = { .x = pass->tile_x0 + number % pass->tiles_x * edge - pass->desc.origin_x,
                        .y = pass->tile_y0 + number / pass->tiles_x * edge - pass->desc.origin_y };
    p.x0 = p.x < 0 ? -p.x : 0;
    p.y0 = p.y < 0 ? -p.y : 0;
    p.x1 = p.x + edge > pass->width ? pass->width - p.x : edge;
    p.y1 = p.y + edge > pass->height ? pass->height - p.y : edge;
    return p;
}

static size_t memory_index(int edge, int x, int y)
{
    return (size_t)((y >> 1) * (edge / 2) + (x >> 1)) * 4 + (size_t)((y & 1) * 2 + (x & 1));
}

/* The code of the tile's pixel (0, y), which may lie beside the attachment. */
static uint8_t *row_of(const struct lom_pass *pass, const struct inside *p, int y)
{
    return pass->depth->stencil + (ptrdiff_t)(p->y + y) * pass->width + p->x;
}

void lom_load_stencil(const struct lom_pass *pass, int number, int32_t *memory)
{
    const struct inside p = find_inside(pass, number);
    const size_t pixels = (size_t)pass->tile * (size_t)pass->tile;
    lom_stages_of(pass->device->variant)->fill_words((uint32_t *)memory, pass->desc.clear_stencil, pixels);
    for (int y = p.y0; pass->desc.stencil_load == LOM_LOAD_KEEP && y < p.y1; y++)
        for (int x = p.x0; x < p.x1; x++)
            memory[memory_index(pass->tile, x, y)] = row_of(pass, &p, y)[x];
}

void lom_resolve_stencil(const struct lom_pass *pass, int number, const int32_t *memory)
{
    const struct inside p = find_inside(pass, number);
    for (int y = p.y0; y < p.y1; y++) {
        uint8_t *row = row_of(pass, &p, y);
        if (memory != NULL)
            for (int x = p.x0; x < p.x1; x++)
                row[x] = (uint8_t)memory[memory_index(pass->tile, x, y)];
        else if (pass->desc.stencil_load != LOM_LOAD_KEEP)
            memset(row + p.x0, pass->desc.clear_stencil, (size_t)(p.x1 - p.x0));
    }
}
