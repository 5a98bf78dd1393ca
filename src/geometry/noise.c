/* Coherent noise. In: a seed and a place; out: a number that is a pure function of both. Invariant: f(x + period) =
 * f(x) up to rounding, and no operation beyond + - * / and square root is used. Compiled for speed. */
#include "geometry/noise.h"

void lom_seed_noise(lom_noise *noise, uint64_t seed)
{
    for (int i = 0; i < 256; i++)
        noise->order[i] = (uint8_t)i;
    for (int i = 255; i > 0; i--) { /* Fisher and Yates */
        int j = (int)(lom_random_bits(seed, (uint64_t)i) % (uint64_t)(i + 1));
        uint8_t swapped = noise->order[i];
        noise->order[i] = noise->order[j];
        noise->order[j] = swapped;
    }
    for (int i = 0; i < 256; i++)
        noise->order[256 + i] = noise->order[i];
}

static double fade(double t)
{
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

/* The lattice line below x, in [0, period), and the one after it. */
static double split(double x, int period, int line[2])
{
    double below = lom_double_floor(x);
    double cycle = below - lom_double_floor(below / period) * period;
    line[0] = lom_int_of(cycle) % period; /* cycle = period after a quotient that was rounded up */
    line[1] = line[0] + 1 == period ? 0 : line[0] + 1;
    return x - below;
}

/* 16 directions at odd multiples of pi/16: none along an axis, where lattice lines would show. */
static double gradient2(unsigned corner, double x, double y)
{
    static const double direction[16][2] = {
        { 0.98078528040323044, 0.19509032201612827 },   { 0.83146961230254524, 0.55557023301960222 },
        { 0.55557023301960222, 0.83146961230254524 },   { 0.19509032201612827, 0.98078528040323044 },
        { -0.19509032201612827, 0.98078528040323044 },  { -0.55557023301960222, 0.83146961230254524 },
        { -0.83146961230254524, 0.55557023301960222 },  { -0.98078528040323044, 0.19509032201612827 },
        { -0.98078528040323044, -0.19509032201612827 }, { -0.83146961230254524, -0.55557023301960222 },
        { -0.55557023301960222, -0.83146961230254524 }, { -0.19509032201612827, -0.98078528040323044 },
        { 0.19509032201612827, -0.98078528040323044 },  { 0.55557023301960222, -0.83146961230254524 },
        { 0.83146961230254524, -0.55557023301960222 },  { 0.98078528040323044, -0.19509032201612827 },
    };
    const double *g = direction[corner & 15];
    return g[0] * x + g[1] * y;
}

/* The twelve edges of a cube, four of them twice (Perlin 2002). */
static double gradient3(unsigned corner, double x, double y, double z)
{
    static const int8_t direction[16][3] = {
        { 1, 1, 0 }, { -1, 1, 0 }, { 1, -1, 0 }, { -1, -1, 0 }, { 1, 0, 1 }, { -1, 0, 1 }, { 1, 0, -1 }, { -1, 0, -1 },
        { 0, 1, 1 }, { 0, -1, 1 }, { 0, 1, -1 }, { 0, -1, -1 }, { 1, 1, 0 }, { 0, -1, 1 }, { -1, 1, 0 }, { 0, -1, -1 },
    };
    const int8_t *g = direction[corner & 15];
    return g[0] * x + g[1] * y + g[2] * z;
}

double lom_noise2_grid(const lom_noise *noise, double x, double y, int columns, int rows)
{
    const uint8_t *order = noise->order;
    int i[2], j[2];
    double u = split(x, columns, i);
    double v = split(y, rows, j);
    double corner[2][2];
    for (int b = 0; b < 2; b++)
        for (int a = 0; a < 2; a++)
            corner[b][a] = gradient2(order[order[i[a]] + j[b]], u - a, v - b);
    double s = fade(u);
    double low = corner[0][0] + (corner[0][1] - corner[0][0]) * s;
    double high = corner[1][0] + (corner[1][1] - corner[1][0]) * s;
    return 1.4142135623730951 * (low + (high - low) * fade(v)); /* |sum| <= sqrt(1/2) */
}

double lom_noise2(const lom_noise *noise, double x, double y, int period)
{
    return lom_noise2_grid(noise, x, y, period, period);
}

double lom_noise3(const lom_noise *noise, double x, double y, double z, int period)
{
    const uint8_t *order = noise->order;
    int i[2], j[2], k[2];
    double u = split(x, period, i);
    double v = split(y, period, j);
    double w = split(z, period, k);
    double s = fade(u);
    double t = fade(v);
    double plane[2];
    for (int c = 0; c < 2; c++) {
        double line[2];
        for (int b = 0; b < 2; b++) {
            double near_corner = gradient3(order[order[order[i[0]] + j[b]] + k[c]], u, v - b, w - c);
            double far_corner = gradient3(order[order[order[i[1]] + j[b]] + k[c]], u - 1.0, v - b, w - c);
            line[b] = near_corner + (far_corner - near_corner) * s;
        }
        plane[c] = line[0] + (line[1] - line[0]) * t;
    }
    return plane[0] + (plane[1] - plane[0]) * fade(w);
}

/* The period of an octave: doubled as long as the table of 256 allows it. */
static int next_period(int period)
{
    return period <= 128 ? period * 2 : 256;
}

/* Octaves are shifted by whole numbers and a fraction, so that their lattice points do not coincide at the origin. */
static const double octave_offset[2] = { 17.371, 31.739 };

double lom_fractal2(const lom_noise *noise, double x, double y, lom_octaves octaves)
{
    double sum = 0, total = 0, amplitude = 1, frequency = 1;
    int period = octaves.period;
    for (int i = 0; i < octaves.count; i++) {
        sum += amplitude *
               lom_noise2(noise, x * frequency + i * octave_offset[0], y * frequency + i * octave_offset[1], period);
        total += amplitude;
        amplitude *= octaves.gain;
        frequency *= 2;
        period = next_period(period);
    }
    return sum / total;
}

double lom_fractal3(const lom_noise *noise, double x, double y, double z, lom_octaves octaves)
{
    double sum = 0, total = 0, amplitude = 1, frequency = 1;
    int period = octaves.period;
    for (int i = 0; i < octaves.count; i++) {
        sum += amplitude * lom_noise3(noise, x * frequency + i * octave_offset[0], y * frequency + i * octave_offset[1],
                                      z * frequency, period);
        total += amplitude;
        amplitude *= octaves.gain;
        frequency *= 2;
        period = next_period(period);
    }
    return sum / total;
}

typedef struct ridges {
    double sum, total, amplitude, weight;
} ridges;

static void add_ridge(ridges *r, double value, double gain)
{
    double ridge = 1.0 - (value < 0 ? -value : value);
    ridge = lom_clamp_double(ridge, 0, 1);
    ridge *= ridge;
    ridge *= r->weight;
    r->sum += r->amplitude * ridge;
    r->total += r->amplitude;
    r->amplitude *= gain;
    r->weight = lom_clamp_double(ridge * 2.0, 0, 1);
}

double lom_ridged2(const lom_noise *noise, double x, double y, lom_octaves octaves)
{
    ridges r = { .amplitude = 1, .weight = 1 };
    double frequency = 1;
    int period = octaves.period;
    for (int i = 0; i < octaves.count; i++) {
        double value =
            lom_noise2(noise, x * frequency + i * octave_offset[0], y * frequency + i * octave_offset[1], period);
        add_ridge(&r, value, octaves.gain);
        frequency *= 2;
        period = next_period(period);
    }
    return r.sum / r.total;
}

/* The point of a cell lies 0.1 .. 0.9 within it, so that the 3x3 cells around (x, y) hold the two nearest. */
lom_cell lom_cellular2(const lom_noise *noise, double x, double y, int columns, int rows)
{
    const uint8_t *order = noise->order;
    int column[2], row[2];
    double u = split(x, columns, column);
    double v = split(y, rows, row);
    lom_cell cell = { .nearest = 1e9, .second = 1e9 };
    for (int b = -1; b <= 1; b++)
        for (int a = -1; a <= 1; a++) {
            int i = (column[0] + a + columns) % columns;
            int j = (row[0] + b + rows) % rows;
            unsigned first = order[order[i] + j];
            unsigned other = order[first + 57];
            double dx = u - (a + 0.1 + 0.8 / 255.0 * first);
            double dy = v - (b + 0.1 + 0.8 / 255.0 * other);
            double distance = lom_double_sqrt(dx * dx + dy * dy);
            if (distance < cell.nearest) {
                cell.second = cell.nearest;
                cell = (lom_cell){ distance, cell.second, dx, dy, order[other + 101] << 8 | order[first + 13] };
            } else if (distance < cell.second) {
                cell.second = distance;
            }
        }
    return cell;
}

double lom_mix_double(double a, double b, double t)
{
    return a + (b - a) * t;
}

double lom_clamp_double(double x, double low, double high)
{
    double above = x > low ? x : low;
    return above < high ? above : high;
}

double lom_smooth_step(double low, double high, double x)
{
    double t = lom_clamp_double((x - low) / (high - low), 0, 1);
    return t * t * (3.0 - 2.0 * t);
}

uint8_t lom_unorm8_of_double(double x)
{
    return (uint8_t)lom_count_of(lom_clamp_double(x, 0, 1) * 255.0 + 0.5, 255);
}
