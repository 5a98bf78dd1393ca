/* The edges of terrain's triangles, for its wireframe. In: the patterns of blocks. Out: each pattern's edges, sorted by who
 * draws them. Invariant: of two neighbours one draws the edges of the border between them. */
#include "geometry/edges.h"
#include "render/ground/ground.h"

/* Whether an edge lies on the right or the lower border. */
static int kind_of(const struct lom_ground_pattern *p, const uint32_t end[2])
{
    const uint32_t across = (uint32_t)p->columns + 1, last = (uint32_t)p->rows * across;
    if (end[0] % across == across - 1 && end[1] % across == across - 1)
        return LOM_WIRES_RIGHT;
    return end[0] >= last && end[1] >= last ? LOM_WIRES_BOTTOM : LOM_WIRES_OWN;
}

static bool sort_edges(struct lom_ground_pattern *p, const uint32_t *edges, size_t count, lom_error *error)
{
    p->wires = lom_allocate(count, sizeof *p->wires, error);
    size_t next = 0;
    for (int kind = 0; p->wires != NULL && kind < LOM_WIRES; kind++) {
        const size_t first = next;
        for (size_t i = 0; i < count; i += 2)
            if (kind_of(p, edges + i) == kind) {
                p->wires[next++] = edges[i];
                p->wires[next++] = edges[i + 1];
            }
        p->wire_count[kind] = next - first;
    }
    return p->wires != NULL;
}

bool lom_make_ground_wires(struct lom_ground *ground, lom_error *error)
{
    for (size_t i = 0; i < ground->pattern_count; i++) {
        struct lom_ground_pattern *p = &ground->patterns[i];
        size_t count;
        uint32_t *edges = lom_list_edges(ground->indices + p->first, p->count, NULL, &count, error);
        bool done = edges != NULL && sort_edges(p, edges, count, error);
        lom_release(edges);
        if (!done)
            return false;
    }
    return true;
}
