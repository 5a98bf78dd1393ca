/* How far a level of a block of terrain is off. In: heights. Out: the largest distance of a vertex of level 0 from the
 * plane of the triangle above or below it. Invariant: the largest of numbers is the same in any order, so that cells are
 * taken side by side where they are small, and the vertices of a row where they are large. Compiled for speed. */
#include "base/numbers.h"
#include "render/ground/ground.h"

enum { NARROW = 4, MOST_CELLS = LOM_GROUND_BLOCK / 2 };

/* A quad of the level, its corners named as lom_make_terrain does, and how many quads of level 0 it joins. */
struct cell {
    const float *heights; /* of its first vertex */
    size_t pitch;
    int width, height;
};

/* The cosine between up and the normal of a triangle that rises by these heights over the quad's width and length. */
static inline float cosine_of(float across, float down, double width, double length)
{
    const double s = (double)across / width, t = (double)down / length;
    return (float)(1 / __builtin_sqrt(1 + s * s + t * t));
}

/* Cells of a row, of the same size, side by side. */
struct cells {
    float a[MOST_CELLS], b[MOST_CELLS], c[MOST_CELLS], d[MOST_CELLS], upper[MOST_CELLS], lower[MOST_CELLS];
};

static void find_corners(const struct lom_ground_grid *grid, const struct cell *cell, int count, struct cells *out)
{
    const double width = cell->width * grid->spacing[0], length = cell->height * grid->spacing[1];
    const float *top = cell->heights, *bottom = top + (size_t)cell->height * cell->pitch;
    for (int k = 0; k < count; k++) {
        out->a[k] = top[k * cell->width];
        out->b[k] = top[(k + 1) * cell->width];
        out->c[k] = bottom[k * cell->width];
        out->d[k] = bottom[(k + 1) * cell->width];
    }
    for (int k = 0; k < count; k++) {
        out->upper[k] = cosine_of(out->b[k] - out->a[k], out->c[k] - out->a[k], width, length);
        out->lower[k] = cosine_of(out->d[k] - out->c[k], out->d[k] - out->b[k], width, length);
    }
}

static inline float off_by(float plane, float here, float cosine)
{
    const float off = (plane - here) * cosine;
    return off < 0 ? -off : off;
}

/* Column i and row j of all of the cells. */
static void compare_cells(const struct cells *cells, const struct cell *cell, int count, int i, int j, float *worst)
{
    const float s = (float)i / (float)cell->width, t = (float)j / (float)cell->height;
    const float *at = cell->heights + (size_t)j * cell->pitch + i;
    const float *a = cells->a, *b = cells->b, *c = cells->c, *d = cells->d;
    float here[MOST_CELLS];
    for (int k = 0; k < count; k++)
        here[k] = at[k * cell->width];
    if (s + t <= 1)
        for (int k = 0; k < count; k++) {
            const float off = off_by(a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]), here[k], cells->upper[k]);
            worst[k] = off > worst[k] ? off : worst[k];
        }
    else
        for (int k = 0; k < count; k++) {
            const float off =
                off_by(d[k] + (1 - s) * (c[k] - d[k]) + (1 - t) * (b[k] - d[k]), here[k], cells->lower[k]);
            worst[k] = off > worst[k] ? off : worst[k];
        }
}

static float largest_of(const float *values, int count)
{
    float largest = 0;
    for (int i = 0; i < count; i++)
        largest = values[i] > largest ? values[i] : largest;
    return largest;
}

static float error_of_cells(const struct lom_ground_grid *grid, const struct cell *cell, int count)
{
    struct cells cells;
    float worst[MOST_CELLS] = { 0 };
    find_corners(grid, cell, count, &cells);
    for (int j = 0; j <= cell->height; j++)
        for (int i = 0; i <= cell->width; i++)
            compare_cells(&cells, cell, count, i, j, worst);
    return largest_of(worst, count);
}

/* One cell, a row of its vertices at a time. */
static float error_of_cell(const struct lom_ground_grid *grid, const struct cell *cell)
{
    struct cells corner;
    float worst[LOM_GROUND_BLOCK + 1] = { 0 }, along[LOM_GROUND_BLOCK + 1];
    find_corners(grid, cell, 1, &corner);
    const float a = corner.a[0], b = corner.b[0], c = corner.c[0], d = corner.d[0];
    const float upper = corner.upper[0], lower = corner.lower[0];
    for (int i = 0; i <= cell->width; i++)
        along[i] = (float)i / (float)cell->width;
    for (int j = 0; j <= cell->height; j++) {
        const float t = (float)j / (float)cell->height, *here = cell->heights + (size_t)j * cell->pitch;
        for (int i = 0; i <= cell->width; i++) {
            const float s = along[i];
            const bool first = s + t <= 1;
            const float above = a + s * (b - a) + t * (c - a), below = d + (1 - s) * (c - d) + (1 - t) * (b - d);
            const float off = off_by(first ? above : below, here[i], first ? upper : lower);
            worst[i] = off > worst[i] ? off : worst[i];
        }
    }
    return largest_of(worst, cell->width + 1);
}

float lom_find_level_error(const struct lom_ground_grid *grid, int x, int y, const struct lom_ground_block *block,
                           int level)
{
    const int step = 1 << level, whole = step <= NARROW ? block->columns / step : 0;
    float worst = 0;
    for (int top = 0; top < block->rows; top += step) {
        struct cell cell = { .heights = grid->heights + (size_t)(y + top) * (size_t)grid->width + x,
                             .pitch = (size_t)grid->width,
                             .width = step,
                             .height = lom_smaller_int(step, block->rows - top) };
        float error = whole > 0 ? error_of_cells(grid, &cell, whole) : 0;
        worst = error > worst ? error : worst;
        cell.heights += whole * step;
        for (int left = whole * step; left < block->columns; left += step, cell.heights += step) {
            cell.width = lom_smaller_int(step, block->columns - left);
            error = error_of_cell(grid, &cell);
            worst = error > worst ? error : worst;
        }
    }
    return worst;
}
