/* LDR FLIP (Andersson et al., FLIP: A Difference Evaluator for Alternating Images, Proc. ACM CGIT 3(2), 2020). In: two
 * images of one size. Out: the mean of the error map. Invariant: every pixel depends on the 21x21 pixels around it
 * alone, computed in double in one fixed order; equal pictures give exactly 0, and the pictures may be swapped.
 *
 * The filters are Gaussians, their derivatives and sums of two Gaussians, all separable: a row of each picture is
 * turned into YCxCz and filtered along the row when it is first needed, kept in a ring of 21 rows, and the columns are
 * filtered for one row of the result at a time. So memory is some rows, and the time a pixel is that of 13 filters. */
#include "compare_flip.h"

#include <string.h>

enum { LUMINANCE, RED_GREEN, BLUE_YELLOW, BLUE_YELLOW_WIDE, SMOOTH, EDGE, POINT, ROW_FILTERS };

/* A row of one picture as the comparison wants it: Hunt-adjusted L*a*b*, and the strengths of edges and points. */
enum { LIGHTNESS, RED_GREEN_ADJUSTED, BLUE_YELLOW_ADJUSTED, EDGE_STRENGTH, POINT_STRENGTH, RESULTS };

enum { DIAMETER = 2 * LOM_FLIP_RADIUS + 1, COLUMN_SCRATCH = 4 };

struct picture {
    const lom_image *image;
    double *ring[DIAMETER][ROW_FILTERS]; /* row y in place y % DIAMETER */
    double *results[RESULTS];
    int next; /* the first row that is not yet in the ring */
};

struct work {
    const lom_common_format *common;
    const lom_flip_constants *constants;
    int width, height;
    double *samples;                /* a row in the common format */
    double *opponent[3];            /* YCxCz, with the borders repeated LOM_FLIP_RADIUS times */
    double *column[COLUMN_SCRATCH]; /* filtered columns */
    struct picture pictures[2];
};

/* ---- rows into the ring ---- */

static void load_opponent_row(struct work *work, const lom_image *image, int y, int z)
{
    lom_read_common_row(image, work->common, y, z, work->samples);
    const double *sample = work->samples;
    for (int x = 0; x < work->width; x++, sample += work->common->channels) {
        double rgb[3], opponent[3];
        for (int c = 0; c < work->common->colors; c++)
            rgb[c] = lom_flip_linear(work->constants, work->common, sample[c]);
        for (int c = work->common->colors; c < 3; c++)
            rgb[c] = rgb[0];
        lom_flip_opponent(work->constants, rgb, opponent);
        for (int c = 0; c < 3; c++)
            work->opponent[c][x + LOM_FLIP_RADIUS] = opponent[c];
    }
    for (int c = 0; c < 3; c++) {
        double *row = work->opponent[c];
        int end = work->width + LOM_FLIP_RADIUS;
        for (int x = 0; x < LOM_FLIP_RADIUS; x++) {
            row[x] = row[LOM_FLIP_RADIUS];
            row[end + x] = row[end - 1];
        }
    }
}

static void load_row(struct work *work, struct picture *picture, int z)
{
    const lom_flip_constants *constants = work->constants;
    const struct {
        int channel;
        const double *weight;
    } filters[ROW_FILTERS] = {
        [LUMINANCE] = { 0, constants->luminance },
        [RED_GREEN] = { 1, constants->red_green },
        [BLUE_YELLOW] = { 2, constants->blue_yellow[0] },
        [BLUE_YELLOW_WIDE] = { 2, constants->blue_yellow[1] },
        [SMOOTH] = { 0, constants->smooth },
        [EDGE] = { 0, constants->edge },
        [POINT] = { 0, constants->point },
    };
    load_opponent_row(work, picture->image, picture->next, z);
    for (int i = 0; i < ROW_FILTERS; i++)
        lom_filter_row(work->opponent[filters[i].channel], work->width, filters[i].weight, DIAMETER,
                       picture->ring[picture->next % DIAMETER][i]);
    picture->next++;
}

/* ---- columns out of the ring ---- */

static void filter_columns(const struct work *work, const struct picture *picture, int y, int filter,
                           const double *weight, double *out)
{
    const double *rows[DIAMETER];
    for (int k = 0; k < DIAMETER; k++) {
        int row = y + k - LOM_FLIP_RADIUS;
        row = row < 0 ? 0 : row >= work->height ? work->height - 1 : row;
        rows[k] = picture->ring[row % DIAMETER][filter];
    }
    lom_filter_column(rows, work->width, weight, DIAMETER, out);
}

static void find_colors(struct work *work, struct picture *picture, int y)
{
    const lom_flip_constants *constants = work->constants;
    double **column = work->column;
    filter_columns(work, picture, y, LUMINANCE, constants->luminance, column[0]);
    filter_columns(work, picture, y, RED_GREEN, constants->red_green, column[1]);
    filter_columns(work, picture, y, BLUE_YELLOW, constants->blue_yellow[0], column[2]);
    filter_columns(work, picture, y, BLUE_YELLOW_WIDE, constants->blue_yellow[1], column[3]);
    const double *share = constants->blue_yellow_share;
    for (int x = 0; x < work->width; x++) {
        const double opponent[3] = { column[0][x], column[1][x], share[0] * column[2][x] + share[1] * column[3][x] };
        double lab[3];
        lom_flip_perceived(constants, opponent, lab);
        for (int c = 0; c < 3; c++)
            picture->results[LIGHTNESS + c][x] = lab[c];
    }
}

/* Length of the vector of a derivative across and down. The luminance (Y + 16) / 116 of section 5.2 differs from Y by a
 * constant, which a derivative does not see, and by the factor. */
static void find_strengths(struct work *work, struct picture *picture, int y, int filter, const double *weight,
                           double *out)
{
    double *across = work->column[0], *down = work->column[1];
    filter_columns(work, picture, y, filter, work->constants->smooth, across);
    filter_columns(work, picture, y, SMOOTH, weight, down);
    for (int x = 0; x < work->width; x++)
        out[x] = __builtin_sqrt(across[x] * across[x] + down[x] * down[x]) / 116;
}

static void find_results(struct work *work, struct picture *picture, int y, int z)
{
    int last = y + LOM_FLIP_RADIUS < work->height ? y + LOM_FLIP_RADIUS : work->height - 1;
    while (picture->next <= last)
        load_row(work, picture, z);
    find_colors(work, picture, y);
    find_strengths(work, picture, y, EDGE, work->constants->edge, picture->results[EDGE_STRENGTH]);
    find_strengths(work, picture, y, POINT, work->constants->point, picture->results[POINT_STRENGTH]);
}

/* ---- the error map ---- */

static double row_error(const struct work *work)
{
    double *const *a = work->pictures[0].results, *const *b = work->pictures[1].results;
    double sum = 0;
    for (int x = 0; x < work->width; x++) {
        const double lab_a[3] = { a[0][x], a[1][x], a[2][x] }, lab_b[3] = { b[0][x], b[1][x], b[2][x] };
        double edge = __builtin_fabs(a[EDGE_STRENGTH][x] - b[EDGE_STRENGTH][x]);
        double point = __builtin_fabs(a[POINT_STRENGTH][x] - b[POINT_STRENGTH][x]);
        sum += lom_flip_pixel(work->constants, lab_a, lab_b, edge > point ? edge : point);
    }
    return sum;
}

static double slice_error(struct work *work, int z)
{
    double sum = 0;
    work->pictures[0].next = work->pictures[1].next = 0;
    for (int y = 0; y < work->height; y++) {
        find_results(work, &work->pictures[0], y, z);
        find_results(work, &work->pictures[1], y, z);
        sum += row_error(work);
    }
    return sum / ((double)work->width * work->height);
}

/* Points the rows of work into one block of memory. */
static double *allocate_rows(struct work *work, lom_error *error)
{
    size_t width = (size_t)work->width, padded = width + 2 * LOM_FLIP_RADIUS;
    size_t rows = 4 + COLUMN_SCRATCH + 2 * (DIAMETER * ROW_FILTERS + RESULTS);
    double *memory = lom_allocate(rows * width + 3 * padded, sizeof *memory, error), *next = memory;
    if (memory == NULL)
        return NULL;
    work->samples = next;
    next += 4 * width;
    for (int c = 0; c < 3; c++, next += padded)
        work->opponent[c] = next;
    for (int c = 0; c < COLUMN_SCRATCH; c++, next += width)
        work->column[c] = next;
    for (int p = 0; p < 2; p++) {
        for (int y = 0; y < DIAMETER; y++)
            for (int i = 0; i < ROW_FILTERS; i++, next += width)
                work->pictures[p].ring[y][i] = next;
        for (int i = 0; i < RESULTS; i++, next += width)
            work->pictures[p].results[i] = next;
    }
    return memory;
}

bool lom_compare_flip(const lom_image *a, const lom_image *b, double *flip, lom_error *error)
{
    lom_common_format common;
    if (!lom_find_common_format(a, b, &common, error) || !lom_require_same_size(a, b, error))
        return false;
    struct work work = { .common = &common, .width = a->width, .height = a->height };
    work.pictures[0].image = a;
    work.pictures[1].image = b;
    double *memory = allocate_rows(&work, error);
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_flip_constants *constants = memory != NULL ? lom_create_flip_constants(&common, error) : NULL;
    if (constants != NULL) {
        work.constants = constants;
        double sum = 0;
        for (int z = 0; z < a->depth; z++)
            sum += slice_error(&work, z);
        *flip = sum / a->depth;
    }
    lom_leave_float_state(&state);
    lom_release(memory);
    bool done = constants != NULL;
    lom_free_flip_constants(constants);
    return done;
}
