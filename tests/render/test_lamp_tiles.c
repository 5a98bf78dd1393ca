/* Proves the lists of lamps for squares of the ground: a place that a lamp reaches has it in its list, lists are in the
 * order of the lamps and short where reaches are, one at infinity is in each, and without squares there is one list. */
#include "check.h"
#include "render/lamp_tiles.h"

#include <math.h>

enum { LAMPS = 400, PLACES = 4000 };

static struct lom_lamp_extent extents[LAMPS];

/* Squares of 2 `reach` a side about random places of [-100, 100]. Every hundredth is everywhere. */
static void scatter(double reach)
{
    for (uint64_t i = 0; i < LAMPS; i++) {
        const double x = lom_random_uniform(1, 2 * i) * 200 - 100, z = lom_random_uniform(1, 2 * i + 1) * 200 - 100;
        extents[i] = (struct lom_lamp_extent){ { x - reach, z - reach }, { x + reach, z + reach }, i % 100 == 50 };
    }
}

/* The list of a place, as the shader finds it. */
static int list_at(const struct lom_lamp_tiles *t, double x, double z)
{
    const double column = floor((x - t->corner[0]) / t->side), row = floor((z - t->corner[1]) / t->side);
    if (!(column >= 0 && column < t->columns && row >= 0 && row < t->rows))
        return t->columns * t->rows;
    return (int)row * t->columns + (int)column;
}

static bool has(const struct lom_lamp_tiles *t, int list, int lamp)
{
    for (uint32_t i = t->first[list]; i < t->first[list + 1]; i++)
        if (t->list[i] == lamp)
            return true;
    return false;
}

/* The mean length of the lists of random places. */
static double check_places(const struct lom_lamp_tiles *t, double margin)
{
    double length = 0;
    for (uint64_t i = 0; i < PLACES; i++) {
        const double x = lom_random_uniform(2, 2 * i) * 300 - 150, z = lom_random_uniform(2, 2 * i + 1) * 300 - 150;
        const int list = list_at(t, x, z);
        for (int k = 0; k < LAMPS; k++) {
            const struct lom_lamp_extent *e = &extents[k];
            const bool reaches = e->everywhere || (x >= e->low[0] - margin && x <= e->high[0] + margin &&
                                                   z >= e->low[1] - margin && z <= e->high[1] + margin);
            CHECK(!reaches || has(t, list, k), "lamp %d is not at %g %g", k, x, z);
            CHECK(!e->everywhere || has(t, list, k), "lamp %d is not everywhere: %g %g", k, x, z);
        }
        for (uint32_t k = t->first[list] + 1; k < t->first[list + 1]; k++)
            CHECK(t->list[k] > t->list[k - 1], "list %d is out of order", list);
        length += (t->first[list + 1] - t->first[list]) / (double)PLACES;
    }
    return length;
}

static void lists_hold_what_reaches(void)
{
    struct lom_lamp_tiles tiles = { .first = NULL };
    lom_error error = { 0 };
    static const double reaches[] = { 1e-3, 4, 30, 1e7 };
    for (int i = 0; i < 4; i++) {
        scatter(reaches[i]);
        CHECK(lom_fill_lamp_tiles(&tiles, extents, LAMPS, 0.5, false, &error), "%s", error.text);
        const double length = check_places(&tiles, 0.4);
        const double least = LAMPS * (2 * reaches[i] + 1) * (2 * reaches[i] + 1) / (300.0 * 300.0);
        CHECK(i > 1 || length < 5 + 4 * least, "reach %g: %g lamps a list", reaches[i], length);
    }
    lom_free_lamp_tiles(&tiles);
}

static void without_squares_there_is_one_list(void)
{
    struct lom_lamp_tiles tiles = { .first = NULL };
    lom_error error = { 0 };
    scatter(4);
    CHECK(lom_fill_lamp_tiles(&tiles, extents, LAMPS, 0, true, &error), "%s", error.text);
    CHECK(tiles.columns * tiles.rows == 0 && tiles.first[0] == 0 && tiles.first[1] == LAMPS, "%u", tiles.first[1]);
    for (int i = 0; i < LAMPS; i++)
        CHECK(tiles.list[i] == i, "place %d holds %d", i, tiles.list[i]);
    lom_free_lamp_tiles(&tiles);
}

/* 16384 lamps over everything: fewer and larger squares, until the lists are no longer than 2^22. */
static void lists_are_bounded(void)
{
    enum { MANY = 16384 };
    static struct lom_lamp_extent many[MANY];
    struct lom_lamp_tiles tiles = { .first = NULL };
    lom_error error = { 0 };
    for (int i = 0; i < MANY; i++)
        many[i] = (struct lom_lamp_extent){ { -50 - i, -50 }, { 50 + i, 50 }, false };
    CHECK(lom_fill_lamp_tiles(&tiles, many, MANY, 0, false, &error), "%s", error.text);
    CHECK(tiles.first[tiles.columns * tiles.rows + 1] <= 1 << 22, "%u", tiles.first[tiles.columns * tiles.rows + 1]);
    lom_free_lamp_tiles(&tiles);
}

int main(int argc, char **argv)
{
    RUN(lists_hold_what_reaches);
    RUN(without_squares_there_is_one_list);
    RUN(lists_are_bounded);
    return check_result();
}
