/* Which lamps may reach what stands over each square of the ground. In: the extents of their light. Out: a list for each
 * square, in the order of the lamps, by counting. Invariant: a place that lies, within the margin, in a lamp's extent has
 * the lamp in its list. */
#include "render/lamp_tiles.h"

#include "base/numbers.h"
#include "base/reserve.h"

enum { MOST_ACROSS = 64, MOST_ENTRIES = 1 << 22 };

/* The square around all that is bounded, with the margin, `across` tiles a side. */
static void lay_tiles(struct lom_lamp_tiles *t, const struct lom_lamp_extent *extents, size_t count, double margin,
                      int across)
{
    double low[2] = { 1e300, 1e300 }, high[2] = { -1e300, -1e300 };
    t->columns = t->rows = 0;
    t->corner[0] = t->corner[1] = 0;
    t->side = 1;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2 && !extents[i].everywhere; k++) {
            low[k] = lom_smaller(low[k], extents[i].low[k] - margin);
            high[k] = lom_larger(high[k], extents[i].high[k] + margin);
        }
    const double size = lom_larger(high[0] - low[0], high[1] - low[1]);
    if (!(size > 0) || across == 0)
        return;
    t->columns = t->rows = across;
    t->side = size / across;
    t->corner[0] = low[0];
    t->corner[1] = low[1];
}

struct range {
    int low[2], high[2]; /* tiles, both included */
};

static int tile_at(double place, double corner, double side, int count)
{
    const double tile = lom_double_floor((place - corner) / side);
    return tile < 0 ? 0 : tile >= count ? count - 1 : lom_int_of(tile);
}

static struct range range_of(const struct lom_lamp_tiles *t, const struct lom_lamp_extent *e, double margin)
{
    struct range r = { { 0, 0 }, { t->columns - 1, t->rows - 1 } };
    for (int k = 0; k < 2 && !e->everywhere && t->columns > 0; k++) {
        r.low[k] = tile_at(e->low[k] - margin, t->corner[k], t->side, t->columns);
        r.high[k] = tile_at(e->high[k] + margin, t->corner[k], t->side, t->columns);
    }
    return r;
}

/* Counts the entries of each list, or where `list` is not NULL puts the lamp at the next place of each. */
static void put(struct lom_lamp_tiles *t, const struct lom_lamp_extent *e, double margin, size_t lamp, uint16_t *list)
{
    struct range r = range_of(t, e, margin);
    for (int row = r.low[1]; row <= r.high[1]; row++)
        for (int column = r.low[0]; column <= r.high[0]; column++) {
            uint32_t *next = &t->first[row * t->columns + column];
            if (list != NULL)
                list[*next] = (uint16_t)lamp;
            ++*next;
        }
    if (!e->everywhere && t->columns > 0)
        return;
    uint32_t *outside = &t->first[t->columns * t->rows];
    if (list != NULL)
        list[*outside] = (uint16_t)lamp;
    ++*outside;
}

static size_t count_entries(struct lom_lamp_tiles *t, const struct lom_lamp_extent *extents, size_t count,
                            double margin)
{
    size_t sum = 0, lists = (size_t)(t->columns * t->rows) + 1;
    for (size_t i = 0; i <= lists; i++)
        t->first[i] = 0;
    for (size_t i = 0; i < count; i++)
        put(t, &extents[i], margin, i, NULL);
    for (size_t i = 0; i < lists; i++)
        sum += t->first[i];
    return sum;
}

/* From the counts: where each list begins. */
static void add_up(struct lom_lamp_tiles *t)
{
    uint32_t at = 0;
    for (int i = 0; i <= t->columns * t->rows; i++) {
        const uint32_t size = t->first[i];
        t->first[i] = at;
        at += size;
    }
}

/* After the lists were filled each entry of first is the end of its list, which is the start of the next. */
static void go_back(struct lom_lamp_tiles *t)
{
    for (int i = t->columns * t->rows + 1; i > 0; i--)
        t->first[i] = t->first[i - 1];
    t->first[0] = 0;
}

bool lom_fill_lamp_tiles(struct lom_lamp_tiles *t, const struct lom_lamp_extent *extents, size_t count, double margin,
                         bool without_tiles, lom_error *error)
{
    size_t entries = 0;
    if (!lom_reserve(&t->first, &t->first_capacity, MOST_ACROSS * MOST_ACROSS + 2, sizeof *t->first, error))
        return false;
    for (int across = without_tiles ? 0 : MOST_ACROSS;; across /= 2) {
        lay_tiles(t, extents, count, margin, across);
        entries = count_entries(t, extents, count, margin);
        if (entries <= MOST_ENTRIES || across == 0)
            break;
    }
    /* What so many lamps can fill wherever they are: frames in which they move allocate nothing. */
    size_t each = without_tiles ? 1 : MOST_ACROSS * MOST_ACROSS + 1;
    size_t room = count < MOST_ENTRIES / each ? count * each : MOST_ENTRIES;
    if (!lom_reserve(&t->list, &t->list_capacity, room > entries ? room : entries + 1, sizeof *t->list, error))
        return false;
    add_up(t);
    for (size_t i = 0; i < count; i++)
        put(t, &extents[i], margin, i, t->list);
    go_back(t);
    return true;
}

void lom_free_lamp_tiles(struct lom_lamp_tiles *tiles)
{
    lom_release(tiles->first);
    lom_release(tiles->list);
    *tiles = (struct lom_lamp_tiles){ .first = NULL };
}
