/* The edges of a mesh's triangles, each once: what a wireframe draws. In: triangles. Out: pairs of vertices. Invariant: an
 * edge that two triangles share is there once, also where they name other vertices at its places; hash tables only find
 * what is equal, and the order is that of first mention. */
#include "edges.h"

#include <string.h>

/* A power of two, at least half again as large as count. */
static size_t table_size(size_t count)
{
    size_t size = 64;
    while (size < count + count / 2)
        size *= 2;
    return size;
}

/* The finalizer of splitmix64 (Steele, Lea and Flood 2014). */
static size_t mix_bits(uint64_t h)
{
    h = (h ^ h >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    h = (h ^ h >> 27) * UINT64_C(0x94d049bb133111eb);
    return (size_t)(h ^ h >> 31);
}

struct edge_table {
    uint32_t *edges; /* two a pair */
    size_t count;    /* pairs */
    uint32_t *slots; /* numbers of pairs + 1, open addressing */
    size_t slot_count;
};

static void add_edge(struct edge_table *t, uint32_t a, uint32_t b)
{
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    const size_t mask = t->slot_count - 1;
    size_t slot = mix_bits((uint64_t)low << 32 | high) & mask;
    if (a == b)
        return;
    for (; t->slots[slot] != 0; slot = (slot + 1) & mask) {
        const uint32_t *edge = t->edges + 2 * ((size_t)t->slots[slot] - 1);
        if (edge[0] == low && edge[1] == high)
            return;
    }
    t->edges[2 * t->count] = low;
    t->edges[2 * t->count + 1] = high;
    t->slots[slot] = (uint32_t)++t->count;
}

uint32_t *lom_list_edges(const uint32_t *indices, size_t count, const uint32_t *same, size_t *edge_count,
                         lom_error *error)
{
    struct edge_table t = { .slot_count = table_size(count) };
    t.edges = lom_allocate(2 * (count == 0 ? 1 : count), sizeof *t.edges, error);
    t.slots = t.edges == NULL ? NULL : lom_allocate(t.slot_count, sizeof *t.slots, error);
    if (t.slots == NULL) {
        lom_release(t.edges);
        return NULL;
    }
    for (size_t i = 0; i + 2 < count; i += 3)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t a = indices[i + k], b = indices[i + (k + 1) % 3];
            add_edge(&t, same != NULL ? same[a] : a, same != NULL ? same[b] : b);
        }
    lom_release(t.slots);
    *edge_count = 2 * t.count;
    return t.edges;
}

/* For each vertex the first one at its place. NULL on failure. */
static uint32_t *join_places(const lom_mesh *mesh, lom_error *error)
{
    const size_t slot_count = table_size(mesh->vertex_count), mask = slot_count - 1;
    uint32_t *same = lom_allocate(mesh->vertex_count, sizeof *same, error);
    uint32_t *slots = same == NULL ? NULL : lom_allocate(slot_count, sizeof *slots, error); /* vertices + 1 */
    for (size_t k = 0; slots != NULL && k < mesh->vertex_count; k++) {
        uint32_t word[3];
        const float *p = mesh->vertices[k].position;
        memcpy(word, p, sizeof word);
        size_t slot = mix_bits(word[0] * UINT64_C(0x9e3779b97f4a7c15) ^ ((uint64_t)word[1] << 32 | word[2])) & mask;
        while (slots[slot] != 0 && memcmp(mesh->vertices[slots[slot] - 1].position, p, sizeof word) != 0)
            slot = (slot + 1) & mask;
        if (slots[slot] == 0)
            slots[slot] = (uint32_t)k + 1;
        same[k] = slots[slot] - 1;
    }
    if (slots == NULL)
        lom_release(same);
    lom_release(slots);
    return slots == NULL ? NULL : same;
}

uint32_t *lom_mesh_edges(const lom_mesh *mesh, size_t *count, lom_error *error)
{
    uint32_t *same = join_places(mesh, error);
    uint32_t *edges = same == NULL ? NULL : lom_list_edges(mesh->indices, mesh->index_count, same, count, error);
    lom_release(same);
    return edges;
}
