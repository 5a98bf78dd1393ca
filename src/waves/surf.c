/* Maps of surf. In: depths, a period, a height, a direction. Out: phases, wave vectors, heights, shapes. Invariant: a
 * function of the description alone: sweeps of a fixed order, until one changes nothing, and no more than a fixed number. */
#include "base/numbers.h"
#include "waves/surf_work.h"

static const double gravity = 9.80665;
static const double thinnest = 0.02; /* metres of a sheet that runs up; less where depths are closer than 10 m */
static const double stable_ratio = 0.4, decay = 0.15;
enum { ROUNDS = 6, NEWTON = 12 };

/* With y = w^2 d / g the equation is x tanh x = y for x = k d, whose left side is convex below 1.2 and nearly straight
 * above: Newton's method from y / sqrt(tanh y) (Eckart 1952), 5 % off at most, converges everywhere. */
double lom_wave_number(double frequency, double depth)
{
    const double y = frequency * frequency * depth / gravity;
    double x = y > 1e-12 ? y / lom_double_sqrt(lom_double_tanh(y)) : lom_double_sqrt(y);
    for (int i = 0; i < NEWTON; i++) {
        double t = lom_double_tanh(x), next = x - (x * t - y) / (t + x * (1 - t * t));
        if (!(lom_magnitude(next - x) > 1e-15 * x))
            break;
        x = next;
    }
    return x / depth;
}

/* Of a known wave number. */
static double group_velocity_of(double frequency, double k, double depth)
{
    double x = 2 * k * depth;
    double ratio = x > 600 ? 0 : x < 1e-8 ? 1 : x / lom_double_sinh(x);
    return frequency / k * (1 + ratio) / 2;
}

double lom_group_velocity(double frequency, double depth)
{
    return group_velocity_of(frequency, lom_wave_number(frequency, depth), depth);
}

/* ---- depths ---- */

void lom_smooth_surf(const struct surf *s, double *grid, double *scratch)
{
    const int w = s->width, h = s->height;
    for (int pass = 0; pass < 4; pass++) {
        int step = pass & 1 ? w : 1;
        for (int y = 0; y < h; y++)
            for (int x = 0; x < w; x++) {
                int i = y * w + x, at = pass & 1 ? y : x, last = (pass & 1 ? h : w) - 1;
                double before = grid[at > 0 ? i - step : i], after = grid[at < last ? i + step : i];
                scratch[i] = (before + 2 * grid[i] + after) / 4;
            }
        memcpy(grid, scratch, sizeof *grid * (size_t)w * (size_t)h);
    }
}

static void find_numbers(struct surf *s)
{
    for (int i = 0; i < s->width * s->height; i++) {
        double depth = lom_larger(s->depth[i], s->shallowest);
        s->number[i] = lom_wave_number(s->frequency, depth);
        s->speed[i] = group_velocity_of(s->frequency, s->number[i], depth);
    }
}

/* ---- where waves come in ---- */

static bool is_on_edge(const struct surf *s, int x, int y)
{
    const bool on[4] = { x == 0, x == s->width - 1, y == 0, y == s->height - 1 };
    return on[s->edge];
}

/* The edge that faces the waves. On it the phase runs along as in water of its mean depth, which Snell's law keeps
 * wherever the bed's contours are parallel to it; the rest of the way to k is across. */
static void start_waves(struct surf *s)
{
    const double way[2] = { lom_double_cos(s->desc->surf.direction), lom_double_sin(s->desc->surf.direction) };
    const double facing[4] = { way[0], -way[0], way[1], -way[1] };
    for (int i = 1; i < 4; i++)
        s->edge = facing[i] > facing[s->edge] ? i : s->edge;
    const bool across_x = s->edge < 2;
    const int count = across_x ? s->height : s->width, a = across_x ? 1 : 0;
    const int first = s->edge == 1 ? s->width - 1 : s->edge == 3 ? (s->height - 1) * s->width : 0;
    const int step = across_x ? s->width : 1;
    double mean = 0;
    for (int n = 0; n < count; n++)
        mean += lom_larger(s->depth[first + n * step], s->shallowest) / count;
    const double along = lom_wave_number(s->frequency, mean) * way[a];
    s->along = along;
    const double flux = s->desc->surf.height * s->desc->surf.height * lom_group_velocity(s->frequency, mean);
    for (int n = 0; n < count; n++) {
        int i = first + n * step;
        double part = along / s->number[i], rest = 1 - part * part;
        part = rest > 0.01 ? part : part < 0 ? -0.995 : 0.995;
        s->phase[i] = along * (n - (count - 1) / 2.0) * s->desc->spacing[a];
        s->normal[i][a] = part;
        s->normal[i][1 - a] = (s->edge & 1 ? -1 : 1) * lom_double_sqrt(1 - part * part);
        s->flux[i] = s->depth[i] > 0 ? flux : 0;
    }
}

/* ---- the eikonal: fast sweeping (Zhao 2005) ---- */

/* The smaller neighbour along an axis and which one it is. */
static double upwind(const struct surf *s, int at, int last, int i, int step, int8_t *side)
{
    double before = at > 0 ? s->phase[i - step] : 1e300, after = at < last ? s->phase[i + step] : 1e300;
    *side = before <= after ? -1 : 1;
    return before <= after ? before : after;
}

/* Whether a cell lies on the side from which oblique waves come across a border that is not their edge. */
static bool is_beside(const struct surf *s, int x, int y)
{
    const bool across_x = s->edge < 2;
    const int at = across_x ? y : x, last = (across_x ? s->height : s->width) - 1;
    return s->along > 0 ? at == 0 : s->along < 0 && at == last;
}

/* There the bed goes on outside as it is inside: the phase keeps its run along the edge (Snell's law), the rest of k is
 * across. */
static bool solve_beside(struct surf *s, int x, int y)
{
    const int i = y * s->width + x, main = s->edge < 2 ? 0 : 1;
    const int at = main == 0 ? x : y, last = (main == 0 ? s->width : s->height) - 1;
    int8_t side;
    double before = upwind(s, at, last, i, main == 0 ? 1 : s->width, &side), part = s->along / s->number[i];
    double rest = 1 - part * part, across = lom_double_sqrt(rest > 0.01 ? rest : 0.01);
    double t = before + across * s->number[i] * s->desc->spacing[main];
    if (!(t < s->phase[i]))
        return false;
    s->phase[i] = t;
    s->from[i][main] = side;
    s->from[i][1 - main] = 0;
    s->normal[i][main] = -side * across;
    s->normal[i][1 - main] = part;
    return true;
}

/* Godunov's scheme: ((t - a) / hx)^2 + ((t - b) / hz)^2 = k^2 where both differences are positive, else one of them. */
static bool solve_phase(struct surf *s, int x, int y)
{
    const double hx = s->desc->spacing[0], hz = s->desc->spacing[1];
    const int i = y * s->width + x;
    int8_t side[2];
    if (is_beside(s, x, y))
        return solve_beside(s, x, y);
    double a = upwind(s, x, s->width - 1, i, 1, &side[0]), b = upwind(s, y, s->height - 1, i, s->width, &side[1]);
    double k = s->number[i], t = a + k * hx < b + k * hz ? a + k * hx : b + k * hz;
    if (t > a && t > b) {
        double p = 1 / (hx * hx), q = 1 / (hz * hz), sum = p * a + q * b;
        double root = sum * sum - (p + q) * (p * a * a + q * b * b - k * k);
        if (root > 0)
            t = (sum + lom_double_sqrt(root)) / (p + q);
    }
    if (!(t < s->phase[i]))
        return false;
    s->phase[i] = t;
    double nx = t > a ? (t - a) / hx : 0, nz = t > b ? (t - b) / hz : 0;
    double length = lom_double_sqrt(nx * nx + nz * nz);
    s->from[i][0] = nx > 0 ? side[0] : 0;
    s->from[i][1] = nz > 0 ? side[1] : 0;
    s->normal[i][0] = -side[0] * nx / length;
    s->normal[i][1] = -side[1] * nz / length;
    return true;
}

/* ---- energy ---- */

struct lom_surf_inflow lom_surf_inflow_of(const struct surf *s, int i)
{
    struct lom_surf_inflow f = { .neighbour = { i + s->from[i][0], i + s->from[i][1] * s->width } };
    double most = 0;
    for (int a = 0; a < 2; a++) {
        double part = lom_magnitude(s->normal[i][a]) / s->desc->spacing[a];
        if (s->from[i][a] == 0)
            continue;
        f.in += s->flux[f.neighbour[a]] * lom_magnitude(s->normal[f.neighbour[a]][a]) / s->desc->spacing[a];
        f.out += part;
        f.part[a] = part;
        f.breaks = part > most ? s->breaks[f.neighbour[a]] : f.breaks;
        most = part > most ? part : most;
    }
    return f;
}

/* What flows in from the cells that the wave comes from flows out again, less what breaking takes. */
static bool solve_flux(struct surf *s, int x, int y)
{
    const int i = y * s->width + x;
    const bool breaks = s->breaks[i];
    const double before = s->flux[i];
    const struct lom_surf_inflow f = lom_surf_inflow_of(s, i);
    double depth = lom_larger(s->depth[i], s->shallowest), c = s->speed[i];
    double flux = f.out > 0 ? f.in / f.out : 0, stable = stable_ratio * depth, height = lom_double_sqrt(flux / c);
    s->breaks[i] = height > lom_breaking_ratio * depth || (f.breaks && height > stable);
    if (s->breaks[i] && f.out > 0)
        flux = (f.in + decay / depth * stable * stable * c) / (f.out + decay / depth);
    s->flux[i] = s->depth[i] > -2 * s->shallowest ? flux : 0;
    return s->breaks[i] != breaks || s->flux[i] != before;
}

/* One way over the grid; whether it changed anything. */
static bool sweep(struct surf *s, int round, bool (*solve)(struct surf *s, int x, int y))
{
    bool changed = false;
    for (int n = 0; n < s->height; n++) {
        int y = round & 2 ? s->height - 1 - n : n;
        for (int m = 0; m < s->width; m++) {
            int x = round & 1 ? s->width - 1 - m : m;
            if (!is_on_edge(s, x, y) && solve(s, x, y))
                changed = true;
        }
    }
    return changed;
}

void lom_sweep_surf(struct surf *s, bool (*solve)(struct surf *s, int x, int y))
{
    for (int round = 0; round < 4 * ROUNDS; round++)
        if (!sweep(s, round, solve))
            return;
}

/* ---- shapes ---- */

/* The shape of a wave from its Ursell number 3/4 (H/2) k / (k d)^3 (Ruessink, Ramaekers, van Rijn 2012, equations 9 to
 * 11): how far it departs from a sine, r, and between peaked crests (f = -pi/2) and a steep front (f = 0). */
static void set_shape(struct lom_surf_cell *cell, double height, double k, double depth)
{
    double x = k * depth, ursell = lom_larger(0.375 * height * k / (x * x * x), 1e-9), log10 = 0.4342944819032518;
    double total = 0.857 / (1 + lom_double_exp((-0.471 - lom_double_log(ursell) * log10) / 0.297));
    double lean = lom_two_pi / 4 * (lom_double_tanh(0.815 / lom_double_pow(ursell, 0.672)) - 1);
    double b = total * lom_double_sqrt(2 / (9 + 2 * total * total)), r = 2 * b / (1 + b * b),
           f = -lean - lom_two_pi / 4;
    cell->skew = (float)(r * lom_double_cos(f));
    cell->lean = (float)(r * lom_double_sin(f));
}

static void fill_cells(const struct surf *s, struct lom_surf_map *map, double *breaking, double *scratch)
{
    const int count = s->width * s->height;
    for (int i = 0; i < count; i++) {
        double depth = lom_larger(s->depth[i], s->shallowest), height = lom_double_sqrt(s->flux[i] / s->speed[i]);
        struct lom_surf_cell *cell = &map->cells[i];
        *cell = (struct lom_surf_cell){ .phase = (float)s->phase[i],
                                        .kx = (float)(s->normal[i][0] * s->number[i]),
                                        .kz = (float)(s->normal[i][1] * s->number[i]),
                                        .amplitude = (float)(height / 2) };
        set_shape(cell, height, s->number[i], depth);
        double over = (height / depth - stable_ratio) / (lom_breaking_ratio - stable_ratio);
        breaking[i] = s->breaks[i] ? 0.35 + 0.65 * (over < 0 ? 0 : over > 1 ? 1 : over) : 0;
        map->highest = lom_larger(map->highest, height);
        map->breaking_depth = s->breaks[i] ? lom_larger(map->breaking_depth, depth) : map->breaking_depth;
    }
    lom_smooth_surf(s, breaking, scratch);
    for (int i = 0; i < count; i++)
        map->cells[i].breaking = (float)breaking[i];
}

/* ---- all of it ---- */

static bool take_memory(struct surf *s, struct lom_surf_map *map, size_t count, lom_error *error)
{
    s->depth = lom_allocate(count, 5 * sizeof *s->depth, error);
    s->normal = lom_allocate(count, sizeof *s->normal, error);
    s->from = lom_allocate(count, sizeof *s->from, error);
    s->breaks = lom_allocate(count, sizeof *s->breaks, error);
    map->cells = lom_allocate(count, sizeof *map->cells, error);
    if (s->depth == NULL || s->normal == NULL || s->from == NULL || s->breaks == NULL || map->cells == NULL)
        return false;
    s->number = s->depth + count;
    s->phase = s->number + count;
    s->flux = s->phase + count;
    s->speed = s->flux + count;
    return true;
}

bool lom_make_surf_map(struct lom_surf_map *map, const struct lom_surf_desc *desc, lom_error *error)
{
    const size_t count = (size_t)desc->width * (size_t)desc->height;
    const double least = lom_smaller(desc->spacing[0], desc->spacing[1]);
    struct surf s = { .desc = desc,
                      .width = desc->width,
                      .height = desc->height,
                      .frequency = lom_two_pi / desc->surf.period,
                      .shallowest = lom_larger(0.1 * desc->surf.height, thinnest * lom_smaller(1, 0.1 * least)) };
    *map = (struct lom_surf_map){ .width = desc->width, .height = desc->height };
    memcpy(map->spacing, desc->spacing, sizeof map->spacing);
    bool done = take_memory(&s, map, count, error);
    if (done) {
        memcpy(s.depth, desc->depth, count * sizeof *s.depth);
        lom_smooth_surf(&s, s.depth, s.flux);
        find_numbers(&s);
        for (size_t i = 0; i < count; i++) {
            s.phase[i] = 1e300;
            s.flux[i] = 0;
        }
        start_waves(&s);
        lom_sweep_surf(&s, solve_phase);
        lom_sweep_surf(&s, solve_flux);
        done = !(desc->surf.breaking != LOM_SURF_SPILLING && desc->surf.plunging > 0) ||
               lom_fill_surf_curls(&s, map, error);
        fill_cells(&s, map, s.number, s.phase);
        if (map->curls != NULL)
            lom_shape_surf_curls(map, s.frequency);
        map->along[0] = -lom_double_sin(desc->surf.direction);
        map->along[1] = lom_double_cos(desc->surf.direction);
        map->length = gravity * desc->surf.period * desc->surf.period / lom_two_pi;
    }
    lom_release(s.depth);
    lom_release(s.normal);
    lom_release(s.from);
    lom_release(s.breaks);
    if (!done)
        lom_free_surf_map(map);
    return done;
}

void lom_free_surf_map(struct lom_surf_map *map)
{
    lom_release(map->cells);
    lom_release(map->curls);
    map->cells = NULL;
    map->curls = NULL;
}
