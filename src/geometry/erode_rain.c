/* Erosion by rain drops and by gravity. In: heights; out: heights with gullies, fans and screes. Invariant: drops run
 * one after the other, each a function of its number and of the ground that the ones before it left.
 * Compiled for speed. */
#include "geometry/erosion.h"

enum { BRUSH = 3, BRUSH_WIDTH = 2 * BRUSH + 1, LIFETIME = 48 };

typedef struct drop {
    double x, y;         /* in cells */
    double dx, dy;       /* unit direction */
    double speed, water; /* the drop starts with one unit of water */
    double soil;
} drop;

typedef struct slope {
    double height, dx, dy;
} slope;

/* Bilinear height and gradient; (x, y) lies at least a cell inside. */
static slope slope_at(const lom_field *field, double x, double y)
{
    int column = lom_int_of(x), row = lom_int_of(y);
    double u = x - column, v = y - row;
    const double *h = field->values + (size_t)row * (size_t)field->size + (size_t)column;
    double a = h[0], b = h[1], c = h[field->size], d = h[field->size + 1];
    return (slope){
        .height = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v,
        .dx = (b - a) * (1 - v) + (d - c) * v,
        .dy = (c - a) * (1 - u) + (d - b) * u,
    };
}

static void make_brush(double brush[BRUSH_WIDTH][BRUSH_WIDTH])
{
    double sum = 0;
    for (int j = 0; j < BRUSH_WIDTH; j++)
        for (int i = 0; i < BRUSH_WIDTH; i++) {
            double distance = lom_double_sqrt((double)((i - BRUSH) * (i - BRUSH) + (j - BRUSH) * (j - BRUSH)));
            brush[j][i] = distance < BRUSH ? BRUSH - distance : 0;
            sum += brush[j][i];
        }
    for (int j = 0; j < BRUSH_WIDTH; j++)
        for (int i = 0; i < BRUSH_WIDTH; i++)
            brush[j][i] /= sum;
}

/* Takes `amount` of height off the cells around (x, y); deposits go to the four corners, so that pits fill exactly. */
static void dig(lom_field *field, const double brush[BRUSH_WIDTH][BRUSH_WIDTH], int x, int y, double amount)
{
    for (int j = 0; j < BRUSH_WIDTH; j++)
        for (int i = 0; i < BRUSH_WIDTH; i++)
            field->values[(size_t)(y + j - BRUSH) * (size_t)field->size + (size_t)(x + i - BRUSH)] -=
                amount * brush[j][i];
}

static void deposit(lom_field *field, double x, double y, double amount)
{
    int column = lom_int_of(x), row = lom_int_of(y);
    double u = x - column, v = y - row;
    double *h = field->values + (size_t)row * (size_t)field->size + (size_t)column;
    h[0] += amount * (1 - u) * (1 - v);
    h[1] += amount * u * (1 - v);
    h[field->size] += amount * (1 - u) * v;
    h[field->size + 1] += amount * u * v;
}

static bool is_inside(const lom_field *field, const drop *d)
{
    double limit = field->size - BRUSH - 2;
    return d->x >= BRUSH + 1 && d->y >= BRUSH + 1 && d->x < limit && d->y < limit;
}

/* One cell's length downhill; false when the drop ends. */
static bool advance(lom_field *field, const double brush[BRUSH_WIDTH][BRUSH_WIDTH], drop *d, double water_level)
{
    const double inertia = 0.25, capacity_factor = 6.0, erosion = 0.22, deposition = 0.25, evaporation = 0.02;
    slope here = slope_at(field, d->x, d->y);
    d->dx = d->dx * inertia - here.dx / field->cell * (1 - inertia);
    d->dy = d->dy * inertia - here.dy / field->cell * (1 - inertia);
    double length = lom_double_sqrt(d->dx * d->dx + d->dy * d->dy);
    if (!(length > 1e-9) || here.height < water_level)
        return false;
    d->dx /= length;
    d->dy /= length;
    drop old = *d;
    d->x += d->dx;
    d->y += d->dy;
    if (!is_inside(field, d))
        return false;
    double fall = here.height - slope_at(field, d->x, d->y).height;
    double gradient = fall / field->cell > 0.01 ? fall / field->cell : 0.01;
    double capacity = gradient * d->speed * d->water * capacity_factor * 0.01 * field->cell;
    if (fall < 0 || d->soil > capacity) {
        double amount = fall < 0 ? (-fall < d->soil ? -fall : d->soil) : (d->soil - capacity) * deposition;
        d->soil -= amount;
        deposit(field, old.x, old.y, amount);
    } else {
        double amount = (capacity - d->soil) * erosion;
        if (amount > fall)
            amount = fall;
        d->soil += amount;
        dig(field, brush, lom_int_of(old.x), lom_int_of(old.y), amount);
    }
    double energy = d->speed * d->speed + fall / field->cell * 1.5;
    d->speed = lom_double_sqrt(energy > 0 ? energy : 0);
    if (d->speed > 5.0)
        d->speed = 5.0;
    d->water *= 1 - evaporation;
    return true;
}

void lom_erode_by_rain(lom_field *height, const lom_rain *rain)
{
    double brush[BRUSH_WIDTH][BRUSH_WIDTH];
    make_brush(brush);
    double span = height->size - 2 * BRUSH - 4;
    for (int i = 0; i < rain->drops; i++) {
        drop d = { .speed = 1, .water = 1 };
        d.x = BRUSH + 1 + span * lom_random_uniform(rain->seed, 2 * (uint64_t)i);
        d.y = BRUSH + 1 + span * lom_random_uniform(rain->seed, 2 * (uint64_t)i + 1);
        int steps = 0;
        while (steps < LIFETIME && advance(height, brush, &d, rain->water_level))
            steps++;
    }
}

/* Moves a quarter of what stands over the talus, from each cell to its lower neighbours, in place. */
void lom_erode_by_gravity(lom_field *height, double talus, int rounds)
{
    int size = height->size;
    double limit = talus * height->cell;
    for (int round = 0; round < rounds; round++)
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++) {
                double *here = height->values + (size_t)y * (size_t)size + (size_t)x;
                double *around[4] = { x > 0 ? here - 1 : here, x + 1 < size ? here + 1 : here,
                                      y > 0 ? here - size : here, y + 1 < size ? here + size : here };
                for (int k = 0; k < 4; k++) {
                    double excess = *here - *around[k] - limit;
                    if (excess > 0) {
                        *here -= excess * 0.25;
                        *around[k] += excess * 0.25;
                    }
                }
            }
}
