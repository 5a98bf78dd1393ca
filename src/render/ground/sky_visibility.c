/* How much of the sky the ground sees. In: heights of a grid. Out: for every vertex the share of the sky above its
 * horizon, weighted by the cosine to the vertical.
 *
 * Along one azimuth the horizon stands at the largest slope tan h = (height - own height) / distance. A ring of the
 * hemisphere from h to the zenith, weighted by the cosine, holds the share cos^2 h = 1 / (1 + tan^2 h) of the light of
 * a uniform sky; the mean over all azimuths is the visibility (Max, "Horizon mapping", The Visual Computer 4, 1988,
 * has the horizons). Every sum has one order, so the result does not depend on the machine. Compiled for speed. */
#include "pipeline/share_work.h"
#include "render/ground/ground.h"

enum { ROWS = 8 /* that a worker takes at a time */ };
enum { MOST_CELLS = 256, FARTHEST = 48, PAD = FARTHEST };

/* Sixteen azimuths as steps of the grid, and how many of these steps to look. */
static const struct {
    int x, y;
} azimuths[16] = { { 1, 0 },  { 2, 1 },   { 1, 1 },   { 1, 2 },   { 0, 1 },  { -1, 2 }, { -1, 1 }, { -2, 1 },
                   { -1, 0 }, { -2, -1 }, { -1, -1 }, { -1, -2 }, { 0, -1 }, { 1, -2 }, { 1, -1 }, { 2, -1 } };
static const int reaches[] = { 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48 }; /* cells along the longer axis */

struct grid {
    int width, height;              /* cells */
    size_t pitch;                   /* cells of a row with PAD of them on both sides, where the border goes on */
    float *heights;                 /* of the cells, padded */
    float *visible;                 /* of the cells */
    double cell_width, cell_length; /* metres */
};

/* Between which two cells the vertices of a column or row lie, and how far from the first. */
struct between {
    int first, second;
    float part;
};

/* All of it, for those who take rows. */
struct look {
    struct grid grid;
    const float *heights; /* of the vertices */
    int width, height;
    struct between *columns;
    float *share;
    size_t stride;
};

static int bound(int x, int limit)
{
    return x < 0 ? 0 : x >= limit ? limit - 1 : x;
}

static float *padded_row(const struct grid *grid, int row)
{
    return grid->heights + (size_t)bound(row, grid->height) * grid->pitch + PAD;
}

/* The mean height of the vertices that fall into each cell. */
static void shrink_rows(void *context, size_t first, size_t end)
{
    const struct look *look = context;
    const struct grid *grid = &look->grid;
    const int width = look->width, height = look->height;
    for (int y = (int)first; y < (int)end; y++) {
        float *row = padded_row(grid, y);
        int y0 = (int)((int64_t)y * height / grid->height), y1 = (int)((int64_t)(y + 1) * height / grid->height);
        for (int x = 0; x < grid->width; x++) {
            int x0 = (int)((int64_t)x * width / grid->width), x1 = (int)((int64_t)(x + 1) * width / grid->width);
            double sum = 0;
            for (int j = y0; j < y1; j++)
                for (int i = x0; i < x1; i++)
                    sum += (double)look->heights[(size_t)j * (size_t)width + (size_t)i];
            row[x] = (float)(sum / ((double)(x1 - x0) * (y1 - y0)));
        }
        for (int x = 1; x <= PAD; x++) {
            row[-x] = row[0];
            row[grid->width - 1 + x] = row[grid->width - 1];
        }
    }
}

/* The largest slopes from the cells of a row towards one azimuth. */
static void find_horizon(const struct grid *grid, int y, int azimuth, float *slope)
{
    int across = azimuths[azimuth].x, down = azimuths[azimuth].y;
    int longer = across == 2 || across == -2 || down == 2 || down == -2 ? 2 : 1;
    const float *here = padded_row(grid, y);
    for (int x = 0; x < grid->width; x++)
        slope[x] = 0;
    for (size_t i = 0; i < sizeof reaches / sizeof reaches[0]; i++) {
        int dx = across * reaches[i] / longer, dy = down * reaches[i] / longer;
        double metres_x = dx * grid->cell_width, metres_y = dy * grid->cell_length;
        float inverse = (float)(1 / lom_double_sqrt(metres_x * metres_x + metres_y * metres_y));
        const float *there = padded_row(grid, y + dy) + dx;
        for (int x = 0; x < grid->width; x++) {
            float s = (there[x] - here[x]) * inverse;
            slope[x] = s > slope[x] ? s : slope[x];
        }
    }
}

static void look_from_rows(void *context, size_t first, size_t end)
{
    const struct grid *grid = &((const struct look *)context)->grid;
    float slope[MOST_CELLS];
    for (int y = (int)first; y < (int)end; y++) {
        float *visible = grid->visible + (size_t)y * (size_t)grid->width;
        for (int x = 0; x < grid->width; x++)
            visible[x] = 0;
        for (int azimuth = 0; azimuth < 16; azimuth++) {
            find_horizon(grid, y, azimuth, slope);
            for (int x = 0; x < grid->width; x++)
                visible[x] += 1 / (16 + 16 * slope[x] * slope[x]);
        }
    }
}

/* Vertex i of n between the middles of m cells. */
static struct between find_between(int i, int n, int m)
{
    double x = (i + 0.5) * m / n - 0.5;
    int first = lom_int_of(lom_double_floor(x));
    return (struct between){ bound(first, m), bound(first + 1, m), (float)(x - first) };
}

/* Linear between the middles of the cells. */
static void spread_rows(void *context, size_t first, size_t end)
{
    const struct look *look = context;
    const struct grid *grid = &look->grid;
    for (int j = (int)first; j < (int)end; j++) {
        const struct between row = find_between(j, look->height, grid->height);
        const float *upper = grid->visible + (size_t)row.first * (size_t)grid->width;
        const float *lower = grid->visible + (size_t)row.second * (size_t)grid->width;
        float *share = look->share + (size_t)j * (size_t)look->width * look->stride;
        for (int i = 0; i < look->width; i++, share += look->stride) {
            const struct between *column = &look->columns[i];
            const int a = column->first, b = column->second;
            float above = upper[a] + column->part * (upper[b] - upper[a]);
            float below = lower[a] + column->part * (lower[b] - lower[a]);
            *share = above + row.part * (below - above);
        }
    }
}

bool lom_find_sky_visibility(lom_device *device, const float *heights, int width, int height, const double size[2],
                             float *share, size_t stride, lom_error *error)
{
    struct look look = { .grid = { .width = width < MOST_CELLS ? width : MOST_CELLS,
                                   .height = height < MOST_CELLS ? height : MOST_CELLS },
                         .heights = heights,
                         .width = width,
                         .height = height,
                         .share = share,
                         .stride = stride };
    struct grid *grid = &look.grid;
    const size_t rows = (size_t)grid->height;
    grid->pitch = (size_t)grid->width + 2 * PAD;
    grid->cell_width = size[0] / grid->width;
    grid->cell_length = size[1] / grid->height;
    grid->heights = lom_allocate(rows * grid->pitch, sizeof(float), error);
    grid->visible = lom_allocate(rows * (size_t)grid->width, sizeof(float), error);
    look.columns = lom_allocate((size_t)width, sizeof *look.columns, error);
    bool done = grid->heights != NULL && grid->visible != NULL && look.columns != NULL;
    if (done) {
        for (int i = 0; i < width; i++)
            look.columns[i] = find_between(i, width, grid->width);
        lom_share_work(device, rows, ROWS, shrink_rows, &look);
        lom_share_work(device, rows, ROWS, look_from_rows, &look);
        lom_share_work(device, (size_t)height, ROWS, spread_rows, &look);
    }
    lom_release(look.columns);
    lom_release(grid->visible);
    lom_release(grid->heights);
    return done;
}
