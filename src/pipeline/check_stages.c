/* Checks of draws that name stages between vertices and clipping (lom/stages.h), and what follows from them. In: a
 * descriptor whose shader is sound. Out: an error with a sentence, or the members of lom_draw that expand.c reads. */
#include "pipeline/expand.h"

#include <stdint.h>

bool lom_has_stages(const lom_draw_desc *desc)
{
    return desc->tessellation != NULL || desc->geometry != NULL || desc->feedback != NULL;
}

/* What goes into the geometry function, or to clipping: LOM_TRIANGLES, LOM_LINES, LOM_POINTS or LOM_SPRITES. */
static lom_topology assembled(const lom_draw_desc *desc)
{
    static const lom_topology of_vertices[] = { LOM_POINTS, LOM_LINES, LOM_TRIANGLES };
    switch (desc->topology) {
    case LOM_PATCHES:
        return of_vertices[lom_piece_vertices(desc->tessellation) - 1];
    case LOM_LINE_STRIP:
        return LOM_LINES;
    case LOM_TRIANGLE_STRIP:
    case LOM_TRIANGLE_FAN:
        return LOM_TRIANGLES;
    default:
        return desc->topology;
    }
}

static bool check_tessellation(lom_device *device, const lom_draw_desc *desc)
{
    const lom_tessellation *t = desc->tessellation;
    const char *name = desc->shader->name;
    if ((t != NULL) != (desc->topology == LOM_PATCHES))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A draw of %s has %s.", name,
                        t != NULL ? "a tessellation, but no patches" : "patches, but no tessellation");
    if (t == NULL)
        return true;
    if (desc->patch_points < 1 || desc->patch_points > LOM_MAX_PATCH_POINTS)
        return lom_fail(&device->error, LOM_ERROR_LIMIT, "A patch has 1 to %d vertices, not %d (a draw of %s).",
                        LOM_MAX_PATCH_POINTS, desc->patch_points, name);
    if (t->most < 0 || t->most > LOM_MAX_LEVEL)
        return lom_fail(&device->error, LOM_ERROR_LIMIT, "Tessellation %s has levels up to %d, but %d is the most.",
                        t->name, t->most, LOM_MAX_LEVEL);
    if ((unsigned)t->domain > LOM_DOMAIN_ISOLINES || (unsigned)t->spacing > LOM_SPACING_FRACTIONAL_ODD)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Tessellation %s has a domain or a spacing that is none.",
                        t->name);
    return true;
}

static bool check_geometry(lom_device *device, const lom_draw_desc *desc)
{
    static const char *const names[] = {
        [LOM_TRIANGLES] = "triangles", [LOM_POINTS] = "points", [LOM_LINES] = "lines"
    };
    const lom_geometry *g = desc->geometry;
    if (g == NULL)
        return true;
    if ((g->in != LOM_POINTS && g->in != LOM_LINES && g->in != LOM_TRIANGLES) ||
        (g->out != LOM_POINTS && g->out != LOM_LINE_STRIP && g->out != LOM_TRIANGLE_STRIP))
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "Geometry %s takes points, lines or triangles and makes points or strips, or it is none.",
                        g->name);
    if (g->vertices < 1 || g->vertices > LOM_MAX_EMITTED)
        return lom_fail(&device->error, LOM_ERROR_LIMIT, "Geometry %s emits 1 to %d vertices of a primitive, not %d.",
                        g->name, LOM_MAX_EMITTED, g->vertices);
    if (g->in != assembled(desc))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Geometry %s takes %s, but its draw is of %s.", g->name,
                        names[g->in], names[assembled(desc)]);
    return true;
}

static bool overlap(const void *a, size_t a_size, const void *b, size_t b_size)
{
    uintptr_t x = (uintptr_t)a, y = (uintptr_t)b;
    return a_size != 0 && b_size != 0 && (x < y ? y - x < a_size : x - y < b_size);
}

static bool reads(const lom_draw_desc *desc, const lom_feedback *feedback)
{
    bool any = desc->count_from == feedback;
    for (int i = 0; i < desc->shader->attributes; i++)
        any |= overlap(desc->attribute[i].data, desc->attribute[i].size, feedback->data, feedback->size);
    return any;
}

/* Whether one of two draws reads what the other one writes. */
static bool mixes(const lom_draw_desc *a, const lom_draw_desc *b)
{
    return (a->feedback != NULL && reads(b, a->feedback)) || (b->feedback != NULL && reads(a, b->feedback));
}

static bool check_feedback(lom_device *device, const lom_draw_desc *desc)
{
    const lom_feedback *f = desc->feedback;
    const char *name = desc->shader->name;
    int varyings = desc->shader->varyings;
    uint32_t declared = varyings == 0 ? 0 : LOM_VARYINGS(0, varyings);
    if (f == NULL && device->pass.desc.feedback_only)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A draw of %s has no feedback in a pass for feedback only.",
                        name);
    if (f != NULL && ((f->varyings & ~declared) != 0 || lom_feedback_stride(f) == 0))
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "The feedback of a draw of %s keeps nothing, or varyings that the shader has not.", name);
    if (f != NULL && f->data == NULL && f->size != 0)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "The feedback of a draw of %s has no memory.", name);
    bool mixed = mixes(desc, desc);
    for (size_t i = 0; i < device->pass.draw_count && (f != NULL || device->pass.feeds_back); i++)
        mixed |= mixes(desc, &device->draws[i].desc);
    if (mixed)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "A draw of %s reads, or fills, feedback that its pass fills, or reads.", name);
    return true;
}

bool lom_check_stages(lom_device *device, const lom_draw_desc *desc)
{
    if (!check_tessellation(device, desc))
        return false;
    if (lom_has_stages(desc) && (desc->topology == LOM_SPRITES || desc->culling.clusters != NULL))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A draw of %s has stages behind its vertices, but is of %s.",
                        desc->shader->name, desc->topology == LOM_SPRITES ? "sprites" : "clusters");
    return check_geometry(device, desc) && check_feedback(device, desc);
}

lom_topology lom_drawn_topology(const lom_draw_desc *desc)
{
    const lom_geometry *g = desc->geometry;
    if (g == NULL)
        return assembled(desc);
    return g->out == LOM_LINE_STRIP ? LOM_LINES : g->out == LOM_TRIANGLE_STRIP ? LOM_TRIANGLES : LOM_POINTS;
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Triangles of a chunk of a draw that has several: as many chunks as give two or four workers the same number, and none of
 * fewer than SHORT for that. Not how many workers there are: vertices at the ends of chunks are shaded for both, and
 * counters are the same on every machine. */
size_t lom_even_share(size_t triangles, size_t chunk)
{
    enum { WORKERS = 4, SHORT = 2048, GROUP = 16 };
    size_t chunks = triangles / chunk + (triangles % chunk != 0);
    size_t even = (chunks + WORKERS - 1) / WORKERS * WORKERS;
    if (chunks < 2 || triangles / even < SHORT)
        return chunk;
    size_t share = ((triangles + even - 1) / even + GROUP - 1) / GROUP * GROUP;
    return share < chunk ? share : chunk;
}

void lom_derive_stages(struct lom_pass *pass, struct lom_draw *draw)
{
    const lom_draw_desc *desc = &draw->desc;
    const lom_geometry *g = desc->geometry;
    size_t chunk = (size_t)pass->device->desc.chunk, growth = 1;
    draw->expands = lom_has_stages(desc);
    draw->drawn = lom_drawn_topology(desc);
    draw->unit = lom_even_share(draw->triangles, chunk);
    pass->feeds_back |= desc->feedback != NULL;
    if (!draw->expands)
        return;
    draw->stage_pitch = LOM_ROW_VARYINGS + ((desc->shader->varyings + 3) & ~3) + ((draw->distances + 3) & ~3);
    if (desc->tessellation != NULL)
        growth = lom_most_pieces(desc->tessellation);
    if (g != NULL)
        growth *= (size_t)g->vertices;
    draw->unit = larger(1, chunk / growth);
}

bool lom_has_variant(const lom_draw_desc *desc, int variant)
{
    const lom_tessellation *t = desc->tessellation;
    const lom_geometry *g = desc->geometry;
    return desc->shader->vertex[variant] != NULL &&
           (t == NULL || (t->control[variant] != NULL && t->evaluation[variant] != NULL)) &&
           (g == NULL || g->geometry[variant] != NULL);
}
