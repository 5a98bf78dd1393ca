/* Slabs of slices across x of a grid of light. In: voxels in the order of the grid, x first; out: the same with y
 * first, and back, by blocks of 8 x 8. Invariant: values are moved, none is changed. */
#include "base/numbers.h"
#include "march/light_grid.h"

#include "base/shuffle.h"
#include "march/cells.h"

#include <string.h>

typedef uint16_t eight __attribute__((vector_size(16)));

enum { BLOCK = 8 };

/* Three perfect shuffles of the rows' elements rotate the 3 bits of a row's number and the 3 of a column's into each
 * other's place. */
static void transpose(eight row[BLOCK])
{
    eight next[BLOCK];
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < BLOCK / 2; i++) {
            next[2 * i] = LOM_SHUFFLE(row[i], row[i + BLOCK / 2], eight, 0, 8, 1, 9, 2, 10, 3, 11);
            next[2 * i + 1] = LOM_SHUFFLE(row[i], row[i + BLOCK / 2], eight, 4, 12, 5, 13, 6, 14, 7, 15);
        }
        memcpy(row, next, sizeof next);
    }
}

void lom_read_slab(const lom_light_grid *g, int first, int count, uint16_t *slab)
{
    size_t pitch = lom_slab_pitch(g->height), slice = pitch * (size_t)g->depth;
    for (int z = 0; z < g->depth; z++)
        for (int x = 0; x < count; x += BLOCK)
            for (int y = 0; y < g->height; y += BLOCK) {
                eight row[BLOCK];
                for (int i = 0; i < BLOCK; i++) {
                    size_t from = (size_t)z * (size_t)g->height + (size_t)lom_smaller_int(y + i, g->height - 1);
                    memcpy(&row[i], g->density + from * (size_t)g->width + (size_t)(first + x), sizeof row[i]);
                }
                transpose(row);
                for (int i = 0; i < lom_smaller_int(BLOCK, count - x); i++)
                    memcpy(slab + (size_t)(x + i) * slice + (size_t)z * pitch + (size_t)y, &row[i], sizeof row[i]);
            }
}

void lom_write_slab(lom_light_grid *g, int first, int count, const uint16_t *shares)
{
    size_t pitch = lom_slab_pitch(g->height), slice = pitch * (size_t)g->depth;
    for (int z = 0; z < g->depth; z++)
        for (int x = 0; x < count; x += BLOCK)
            for (int y = 0; y < g->height; y += BLOCK) {
                eight row[BLOCK];
                for (int i = 0; i < BLOCK; i++)
                    memcpy(&row[i], shares + (size_t)(x + i) * slice + (size_t)z * pitch + (size_t)y, sizeof row[i]);
                transpose(row);
                for (int i = 0; i < lom_smaller_int(BLOCK, g->height - y); i++) {
                    uint16_t share[BLOCK];
                    int32_t *light = g->light + cell_index(g->width, g->height, first + x, y + i, z);
                    memcpy(share, &row[i], sizeof share);
                    if (x + BLOCK <= count)
                        lom_write_shares(light, share, BLOCK);
                    else
                        lom_write_shares(light, share, count - x);
                }
            }
}
