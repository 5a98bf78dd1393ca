/* The velocities of a river. In: depths on a grid. Out: a field of them. Method: successive over-relaxation (Young 1954)
 * in a fixed order and number of sweeps, so that the field is a function of the depths. */
#include "base/numbers.h"
#include "waves/river.h"

enum { SWEEPS = 600 };

struct field {
    int size;
    const double *depth;
    double *pressure;
    double direction[2];
};

static double depth_at(const struct field *f, int x, int y)
{
    bool inside = x >= 0 && y >= 0 && x < f->size && y < f->size;
    double depth = inside ? f->depth[y * f->size + x] : 0;
    return depth > 0 ? depth : 0;
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

/* The flux through the side between two cells goes as the smaller of their depths. */
static void relax(struct field *f, int x, int y, double factor)
{
    static const int side[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
    double here = depth_at(f, x, y), sum = 0, weight = 0;
    for (int k = 0; k < 4; k++) {
        int nx = x + side[k][0], ny = y + side[k][1];
        double there = depth_at(f, nx, ny), through = there < here ? there : here;
        if (!(through > 0))
            continue;
        sum += through * f->pressure[ny * f->size + nx];
        weight += through;
    }
    double *p = &f->pressure[y * f->size + x];
    if (weight > 0)
        *p += factor * (sum / weight - *p);
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
    struct field f = { .size = size,
                       .depth = depth,
                       .direction = { lom_double_cos(direction), lom_double_sin(direction) } };
    f.pressure = lom_allocate((size_t)size * (size_t)size, sizeof *f.pressure, error);
    lom_image *out = f.pressure != NULL ? lom_create_image(size, size, 1, LOM_FORMAT_RG32F, error) : NULL;
    for (int y = 0; out != NULL && y < size; y++)
        for (int x = 0; x < size; x++) {
            double middle = (size - 1) / 2.0;
            double along = ((x - middle) * f.direction[0] + (y - middle) * f.direction[1]) / size;
            f.pressure[y * size + x] = is_border(&f, x, y) ? border_pressure(&f, x, y) : 0.5 - along;
        }
    double factor = 2 / (1 + lom_two_pi / (2 * size)); /* the best of a square of that size */
    for (int sweep = 0; out != NULL && sweep < SWEEPS; sweep++)
        for (int y = 1; y < size - 1; y++)
            for (int x = 1; x < size - 1; x++)
                if (depth_at(&f, x, y) > 0)
                    relax(&f, x, y, factor);
    if (out != NULL)
        write_velocities(&f, out);
    lom_release(f.pressure);
    return out;
}
