/* What a volume holds at the places of a packet, in fixed point (lom/fixed.h). In: places in whole parts of a voxel, and
 * in which cells they are; out: colour and density, mixed along z, then x, then y: 32640 stands for 1.
 *
 * Invariant: a lane's numbers are those of its own place, whichever way they are read: from one cell that all lanes are
 * in, from two beside one another, from rows that they share, or from a cell each. */
#ifndef LOM_MARCH_FIXED_VOLUME_H
#define LOM_MARCH_FIXED_VOLUME_H

#include "fixed_places.h"
#include "near_cells.h"

/* Two cells are told apart by a mask; without an instruction for it that costs what reading a cell each does. */
#if LOM_LANES > 4 && !defined LOM_LOWERED
enum { SHARES_TWO_CELLS = true };
#else
enum { SHARES_TWO_CELLS = false };
#endif

struct weights {
    lom_pairs x, y, z; /* of the upper corners, in [0, 2^15[ */
};

/* Of parts of a cell. */
LOM_INLINE struct weights weigh(const struct fixed_rays *f, const struct places *part)
{
    struct weights w = { lom_twice(part->x), lom_twice(part->y), lom_twice(part->z) };
    if (f->bits == 14)
        w = (struct weights){ w.x + w.x, w.y + w.y, w.z + w.z };
    return w;
}

/* Without the whole cells. */
LOM_INLINE void leave_cells(struct weights *w)
{
    *w = (struct weights){ w->x & 0x7fff, w->y & 0x7fff, w->z & 0x7fff };
}

/* lom_mix_pairs, of the difference. */
LOM_INLINE lom_pairs go(lom_pairs from, lom_pairs difference, lom_pairs weight)
{
    return from + lom_multiply_pairs(difference, weight);
}

/* A number of pairs that lie at a cell's four rows along z, lower and upper: (0, 0), (1, 0), (0, 1), (1, 1) of x and y. */
struct rows {
    lom_pairs even[4], odd[4]; /* red and blue, green and density */
};

LOM_INLINE lom_pairs mix_rows(const lom_pairs row[4], const struct weights *w)
{
    lom_pairs upper = go(row[0], row[1] - row[0], w->x), lower = go(row[2], row[3] - row[2], w->x);
    return go(upper, lower - upper, w->y);
}

/* The lower half of each lane, and the upper as the next y. */
LOM_INLINE lom_float mix_halves(lom_pairs left, lom_pairs right, const struct weights *w)
{
    lom_pairs both = go(left, right - left, w->x);
    return lom_lower_of_pairs(go(both, (lom_pairs)((lom_int)both >> 16) - both, w->y));
}

/* ---- a cell or two for all lanes ---- */

/* Four words in 128 bits, whatever the width of lanes. */
typedef int32_t four_words __attribute__((vector_size(16)));
typedef int16_t four_pairs __attribute__((vector_size(16)));

LOM_INLINE four_words even_of_four(four_words words)
{
    return (words & 0x00ff00ff) << 7;
}

LOM_INLINE four_words odd_of_four(four_words words)
{
    return words >> 1 & 0x7f807f80;
}

LOM_INLINE four_words differ(four_words from, four_words to)
{
    return (four_words)((four_pairs)to - (four_pairs)from);
}

/* The rows of a cell: even and odd bytes at the lower z, then what the upper has more. */
LOM_INLINE void read_cell(const lom_volume *v, int index, lom_int x[16])
{
    const int pitch = v->width + 1, slice = pitch * (v->height + 1);
    const int32_t *low = v->color + index, *high = low + slice;
    const four_words near = { low[0], low[1], low[pitch], low[pitch + 1] };
    const four_words far = { high[0], high[1], high[pitch], high[pitch + 1] };
    const four_words part[4] = { even_of_four(near), odd_of_four(near), differ(even_of_four(near), even_of_four(far)),
                                 differ(odd_of_four(near), odd_of_four(far)) };
    int32_t words[16];
    for (int i = 0; i < 4; i++)
        memcpy(words + 4 * i, &part[i], sizeof part[i]);
    lom_spread(words, 16, x);
}

/* The same of a cell's densities: bytes of x = 0 and of x = 1, each of both y. */
LOM_INLINE void read_density(const lom_volume *v, int index, lom_int x[4])
{
    const int32_t *word = v->density + 2 * (ptrdiff_t)index;
    const int32_t low = word[0], high = word[1];
    int32_t words[4] = { (low & 0x00ff00ff) << 7, low >> 1 & 0x7f807f80, (high & 0x00ff00ff) << 7,
                         high >> 1 & 0x7f807f80 };
    lom_spread(words, 4, x);
}

/* From one cell to the next along the only axis that is set. */
LOM_INLINE int next_cell(const lom_volume *v, int across)
{
    return across == 1 ? 1 : across == 2 ? v->width + 1 : (v->width + 1) * (v->height + 1);
}

/* The lanes that are in the upper of two cells; parts from the lower one's corner. */
LOM_INLINE lom_mask in_upper(const struct fixed_rays *f, const struct places *part)
{
    return (part->x | part->y | part->z) >= (1 << f->bits);
}

/* ---- what is there ---- */

LOM_INLINE struct places parts_from(const struct places *p, const struct cells_of_steps *cells, int k)
{
    return (struct places){ p->x - cells->corner[0][k], p->y - cells->corner[1][k], p->z - cells->corner[2][k] };
}

/* Places as near_cells.h has them; it reads no weights. */
LOM_INLINE void find_own_cells(const struct fixed_rays *f, const struct places *p, struct spot *spot)
{
    const lom_volume *v = f->volume;
    spot->x = (p->x - FIRST_PLACE) >> f->bits;
    spot->y = (p->y - FIRST_PLACE) >> f->bits;
    spot->z = (p->z - FIRST_PLACE) >> f->bits;
    spot->place.index = (spot->z * (v->height + 1) + spot->y) * (v->width + 1) + spot->x;
}

LOM_INLINE bool is_one_or_two(int across)
{
    return across == 0 || (SHARES_TWO_CELLS && (across == 1 || across == 2 || across == 4));
}

/* The density, 0 to 32640. */
LOM_INLINE lom_float density_there(const struct fixed_rays *f, const struct places *p,
                                   const struct cells_of_steps *cells, int k)
{
    const int across = cells->across[k];
    const struct places part = parts_from(p, cells, k);
    struct weights w = weigh(f, &part);
    lom_int c[4];
    if (is_one_or_two(across)) {
        read_density(f->volume, cells->index[k], c);
        if (across != 0) {
            lom_int next[4];
            leave_cells(&w);
            const lom_mask upper = in_upper(f, &part);
            read_density(f->volume, cells->index[k] + next_cell(f->volume, across), next);
            for (int i = 0; i < 4; i++)
                c[i] = lom_select_int(upper, next[i], c[i]);
        }
    } else {
        struct spot spot;
        lom_int low, high;
        leave_cells(&w);
        find_own_cells(f, p, &spot);
        load_densities(f->volume, &spot, &low, &high);
        c[0] = (lom_int)lom_even_bytes(low);
        c[1] = (lom_int)lom_odd_bytes(low);
        c[2] = (lom_int)lom_even_bytes(high);
        c[3] = (lom_int)lom_odd_bytes(high);
    }
    return mix_halves(go((lom_pairs)c[0], (lom_pairs)c[2] - (lom_pairs)c[0], w.z),
                      go((lom_pairs)c[1], (lom_pairs)c[3] - (lom_pairs)c[1], w.z), &w);
}

LOM_INLINE void mix_cell(const lom_int x[16], lom_pairs z, struct rows *rows)
{
    for (int i = 0; i < 4; i++) {
        rows->even[i] = go((lom_pairs)x[i], (lom_pairs)x[8 + i], z);
        rows->odd[i] = go((lom_pairs)x[4 + i], (lom_pairs)x[12 + i], z);
    }
}

/* Of one cell or two. */
LOM_INLINE void mix_shared_cells(const struct fixed_rays *f, const struct places *part, int index, int across,
                                 struct weights *w, struct rows *rows)
{
    lom_int x[16], next[16];
    read_cell(f->volume, index, x);
    if (across == 0) {
        mix_cell(x, w->z, rows);
        return;
    }
    const lom_mask upper = in_upper(f, part);
    leave_cells(w);
    read_cell(f->volume, index + next_cell(f->volume, across), next);
    for (int i = 0; i < 16; i++)
        x[i] = lom_select_int(upper, next[i], x[i]);
    mix_cell(x, w->z, rows);
}

static __attribute__((noinline)) void mix_own_cells(const struct fixed_rays *f, const struct places *p, lom_pairs z,
                                                    struct rows *rows)
{
    struct spot spot;
    lom_int corner[8];
    find_own_cells(f, p, &spot);
    load_corners(f->volume, &spot, corner);
    for (int i = 0; i < 4; i++) {
        lom_pairs even = lom_even_bytes(corner[i]), odd = lom_odd_bytes(corner[i]);
        rows->even[i] = go(even, lom_even_bytes(corner[4 + i]) - even, z);
        rows->odd[i] = go(odd, lom_odd_bytes(corner[4 + i]) - odd, z);
    }
}

/* Colour and density, 0 to 32640. */
LOM_INLINE lom_float4 all_there(const struct fixed_rays *f, const struct places *p, const struct cells_of_steps *cells,
                                int k)
{
    const struct places part = parts_from(p, cells, k);
    struct weights w = weigh(f, &part);
    struct rows rows;
    if (is_one_or_two(cells->across[k])) {
        mix_shared_cells(f, &part, cells->index[k], cells->across[k], &w, &rows);
    } else {
        leave_cells(&w);
        mix_own_cells(f, p, w.z, &rows);
    }
    const lom_pairs even = mix_rows(rows.even, &w), odd = mix_rows(rows.odd, &w);
    return (lom_float4){ lom_lower_of_pairs(even), lom_lower_of_pairs(odd), lom_upper_of_pairs(even),
                         lom_upper_of_pairs(odd) };
}

#endif
