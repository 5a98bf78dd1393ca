/* LDR FLIP (Andersson et al., FLIP: A Difference Evaluator for Alternating Images, Proc. ACM CGIT 3(2), 2020). In: two
 * images of one size. Out: the mean of the error map. Invariant: every pixel depends on the 21x21 pixels around it
 * alone, computed in double in one fixed order, and rows are summed from the top whoever did them; equal pictures give
 * exactly 0, and the pictures may be swapped.
 *
 * The filters are Gaussians, their derivatives and sums of two Gaussians, all separable: a row of each picture is
 * turned into YCxCz and filtered along the row when it is first needed, kept in a ring of 21 rows, and the columns are
 * filtered for one row of the result at a time. So memory is some rows, and the time a pixel is that of 13 filters.
 * Compiled for speed. */
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

struct errors {
    struct work *work; /* of each worker */
    double *sums;      /* of each row, slice after slice */
};

/* Whether the bytes of row y are the same in both pictures. */
static bool is_equal_row(const struct work *work, int y, int z)
{
    const lom_image *a = work->pictures[0].image, *b = work->pictures[1].image;
    return a->format == b->format && memcmp(lom_image_pixel(a, 0, y, z), lom_image_pixel(b, 0, y, z),
                                            (size_t)a->width * lom_format_size(a->format)) == 0;
}

/* The last row at or before `to` that differs, at least `from`; from - 1 when there is none. */
static int last_difference(const struct work *work, int from, int to, int z)
{
    while (to >= from && is_equal_row(work, to, z))
        to--;
    return to;
}

/* A row whose pixels all see equal rows alone has no error, and nothing is filtered for it. */
static void error_band(void *context, int worker, int z, int from, int to)
{
    struct errors *errors = context;
    struct work *work = &errors->work[worker];
    int seen = from - LOM_FLIP_RADIUS < 0 ? 0 : from - LOM_FLIP_RADIUS; /* rows below are known */
    int differing = seen - 1;                                           /* the last known row that differs */
    work->pictures[0].next = work->pictures[1].next = seen;
    for (int y = from; y < to; y++) {
        int first = y - LOM_FLIP_RADIUS < 0 ? 0 : y - LOM_FLIP_RADIUS;
        int end = work->height - y > LOM_FLIP_RADIUS ? y + LOM_FLIP_RADIUS + 1 : work->height;
        int last = last_difference(work, seen, end - 1, z);
        differing = last >= seen ? last : differing;
        seen = end;
        if (differing < first)
            continue;
        for (int p = 0; p < 2; p++)
            work->pictures[p].next = work->pictures[p].next < first ? first : work->pictures[p].next;
        find_results(work, &work->pictures[0], y, z);
        find_results(work, &work->pictures[1], y, z);
        errors->sums[(size_t)z * (size_t)work->height + (size_t)y] = row_error(work);
    }
}

/* Of the rows of each slice from the top, then of the slices. */
static double mean_error(const double *row, const lom_image *a)
{
    double sum = 0;
    for (int z = 0; z < a->depth; z++) {
        double total = 0;
        for (int y = 0; y < a->height; y++)
            total += *row++;
        sum += total / ((double)a->width * a->height);
    }
    return sum / a->depth;
}

/* Doubles of the rows of one worker. */
static size_t row_memory(size_t width)
{
    return (4 + COLUMN_SCRATCH + 2 * (DIAMETER * ROW_FILTERS + RESULTS)) * width + 3 * (width + 2 * LOM_FLIP_RADIUS);
}

/* Points the rows of work into memory. */
static void place_rows(struct work *work, double *next)
{
    size_t width = (size_t)work->width;
    work->samples = next;
    next += 4 * width;
    for (int c = 0; c < 3; c++, next += width + 2 * LOM_FLIP_RADIUS)
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
}

bool lom_compare_flip_on(lom_pool *pool, const lom_image *a, const lom_image *b, double *flip, lom_error *error)
{
    lom_common_format common;
    if (!lom_find_common_format(a, b, &common, error) || !lom_require_same_size(a, b, error))
        return false;
    size_t workers = (size_t)lom_pool_size(pool), memory_each = row_memory((size_t)a->width);
    lom_float_state state;
    lom_enter_float_state(&state);
    struct errors errors = { .work = lom_allocate(workers, sizeof *errors.work, error),
                             .sums = lom_allocate((size_t)a->height * (size_t)a->depth, sizeof *errors.sums, error) };
    double *memory = lom_allocate(workers * memory_each, sizeof *memory, error);
    size_t samples = (size_t)a->width * (size_t)a->height * (size_t)a->depth * (size_t)common.colors;
    lom_flip_constants *constants = lom_create_flip_constants(&common, samples, error);
    bool good = errors.work != NULL && errors.sums != NULL && memory != NULL && constants != NULL;
    for (size_t i = 0; good && i < workers; i++) {
        errors.work[i] = (struct work){ .common = &common,
                                        .constants = constants,
                                        .width = a->width,
                                        .height = a->height,
                                        .pictures = { { .image = a }, { .image = b } } };
        place_rows(&errors.work[i], memory + i * memory_each);
    }
    if (good) {
        lom_run_bands(pool, a->depth, a->height, error_band, &errors);
        *flip = mean_error(errors.sums, a);
    }
    lom_leave_float_state(&state);
    lom_free_flip_constants(constants);
    lom_release(memory);
    lom_release(errors.sums);
    lom_release(errors.work);
    return good;
}

bool lom_compare_flip(const lom_image *a, const lom_image *b, double *flip, lom_error *error)
{
    lom_pool *pool = lom_create_compare_pool(a, error);
    bool good = pool != NULL && lom_compare_flip_on(pool, a, b, flip, error);
    lom_free_pool(pool);
    return good;
}
