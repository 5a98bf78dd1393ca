/* The velocities of a river. In: depths on a grid. Out: a field of them. Method: successive over-relaxation (Young 1954)
 * in a fixed order and number of sweeps, so that the field is a function of the depths. */
#include "base/numbers.h"
#include "waves/river.h"

enum { SWEEPS = 600, ROWS = 4 };

struct field {
    int size;
    double *depth, *pressure; /* 0 where there is no water */
    double direction[2];
};

static double depth_at(const struct field *f, int x, int y)
{
    bool inside = x >= 0 && y >= 0 && x < f->size && y < f->size;
    return inside ? f->depth[y * f->size + x] : 0;
}

/* On the border, upstream of the middle water enters, downstream it leaves; 0.5 elsewhere. */
static double border_pressure(const struct field *f, int x, int y)
{
    double middle = (f->size - 1) / 2.0, along = (x - middle) * f->direction[0] + (y - middle) * f->direction[1];
    return along < 0 ? 1 : 0;
}

static bool is_border(const struct field *f, int x, int y)
{
    return x == 0 || y == 0 || x == f->size - 1 || y == f->size - 1;
}

/* The flux through the side between two cells goes as the smaller of their depths: none where one of them is dry. */
static void relax(const struct field *f, int x, int y, double factor)
{
    size_t at = (size_t)y * (size_t)f->size + (size_t)x;
    const double *depth = f->depth + at;
    double *p = f->pressure + at, here = depth[0], sum = 0, weight = 0;
    const int side[4] = { 1, -1, f->size, -f->size };
    for (int k = 0; k < 4; k++) {
        double there = depth[side[k]], through = there < here ? there : here;
        sum += through * p[side[k]];
        weight += through;
    }
    if (weight > 0)
        *p += factor * (sum / weight - *p);
}

/* All cells inside the border, row after row. Several rows at a time, each a cell behind the one before: a cell finds
 * what it would in order, and a processor has several quotients under way. */
static void relax_all(const struct field *f, double factor)
{
    int last = f->size - 2;
    for (int y = 1; y <= last; y += ROWS) {
        int rows = last - y + 1 < ROWS ? last - y + 1 : ROWS;
        for (int step = 1; step < last + rows; step++)
            for (int row = step > last ? step - last : 0; row < rows && row < step; row++)
                relax(f, step - row, y + row, factor);
    }
}

/* The derivative across a cell of what both neighbours have, or the one that is water. */
static double slope(const struct field *f, int x, int y, int dx, int dy)
{
    bool after = depth_at(f, x + dx, y + dy) > 0, before = depth_at(f, x - dx, y - dy) > 0;
    const double *p = f->pressure + y * f->size + x;
    int step = dy * f->size + dx;
    if (after && before)
        return (p[step] - p[-step]) / 2;
    return after ? p[step] - p[0] : before ? p[0] - p[-step] : 0;
}

static void write_velocities(const struct field *f, lom_image *out)
{
    double sum = 0;
    size_t cells = 0;
    for (int y = 0; y < f->size; y++)
        for (int x = 0; x < f->size; x++) {
            float *v = lom_image_pixel(out, x, y, 0);
            if (!(depth_at(f, x, y) > 0))
                continue;
            double vx = -slope(f, x, y, 1, 0), vz = -slope(f, x, y, 0, 1);
            v[0] = (float)vx;
            v[1] = (float)vz;
            sum += lom_double_sqrt(vx * vx + vz * vz);
            cells++;
        }
    double scale = sum > 0 ? (double)cells / sum : 0;
    for (int y = 0; y < f->size; y++)
        for (int x = 0; x < f->size; x++) {
            float *v = lom_image_pixel(out, x, y, 0);
            for (int k = 0; k < 2; k++) /* narrows are fast, but no more than this */
                v[k] = (float)(v[k] * scale > 4 ? 4 : v[k] * scale < -4 ? -4 : v[k] * scale);
        }
}

lom_image *lom_make_river(const double *depth, int size, double direction, lom_error *error)
{
    struct field f = { .size = size, .direction = { lom_double_cos(direction), lom_double_sin(direction) } };
    size_t cells = (size_t)size * (size_t)size;
    f.pressure = lom_allocate(cells, sizeof *f.pressure, error);
    f.depth = f.pressure != NULL ? lom_allocate(cells, sizeof *f.depth, error) : NULL;
    lom_image *out = f.depth != NULL ? lom_create_image(size, size, 1, LOM_FORMAT_RG32F, error) : NULL;
    for (int y = 0; out != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            double middle = (size - 1) / 2.0, here = depth[y * size + x];
            double along = ((x - middle) * f.direction[0] + (y - middle) * f.direction[1]) / size;
            f.pressure[y * size + x] = is_border(&f, x, y) ? border_pressure(&f, x, y) : 0.5 - along;
            f.depth[y * size + x] = here > 0 ? here : 0;
        }
    double factor = 2 / (1 + lom_two_pi / (2 * size)); /* the best of a square of that size */
    for (int sweep = 0; out != NULL && sweep < SWEEPS; sweep++)
        relax_all(&f, factor);
    if (out != NULL)
        write_velocities(&f, out);
    lom_release(f.pressure);
    lom_release(f.depth);
    return out;
}
