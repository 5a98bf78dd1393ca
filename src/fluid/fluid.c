/* Making a volume of liquid, and the order of a step. In: blocks of liquid in a basin with obstacles. Out: particles,
 * a step later. Invariant: a step is a function of the one before, whoever does its work. */
#include "fluid/fluid.h"

#include "base/numbers.h"
#include "base/own_float_state.h"
#include "base/range.h"
#include "pipeline/share_work.h"

#include <string.h>

/* ---- what is asked for ---- */

static bool check_three(const double value[3], double most, lom_error *error, const char *what)
{
    for (int i = 0; i < 3; i++)
        if (!lom_check_range(value[i], -most, most, error, "The %s of a fluid", what))
            return false;
    return true;
}

static bool resolve(double *value, double initial, double low, double high, const char *what, lom_error *error)
{
    if (*value == 0)
        *value = initial;
    return lom_check_range(*value, low, high, error, "The %s of a fluid", what);
}

static bool check_bodies(const lom_fluid_body *bodies, size_t count, size_t least, const char *what, lom_error *error)
{
    if (count < least || count > LOM_FLUID_BODIES || (bodies == NULL && count > 0))
        return lom_fail(error, LOM_ERROR_USAGE, "A fluid has %d to %d %ss, not %llu, or there is no list of them.",
                        (int)least, LOM_FLUID_BODIES, what, (unsigned long long)count);
    for (size_t i = 0; i < count; i++) {
        const lom_fluid_body *b = &bodies[i];
        if (!check_three(b->low, 1e6, error, what) || !check_three(b->high, 1e6, error, what) ||
            !check_three(b->velocity, 1000, error, "velocity of a block") ||
            !lom_check_range(b->temperature, -1e6, 1e6, error, "The temperature of a %s of a fluid", what))
            return false;
        if ((unsigned)b->shape > LOM_FLUID_ELLIPSOID)
            return lom_fail(error, LOM_ERROR_USAGE, "A %s of a fluid is no box and no ellipsoid.", what);
        for (int axis = 0; axis < 3; axis++)
            if (!(b->low[axis] < b->high[axis]))
                return lom_fail(error, LOM_ERROR_USAGE,
                                "A %s of a fluid has a low side that is not below its high one.", what);
    }
    return true;
}

static bool resolve_desc(lom_fluid_desc *d, int cells[3], lom_error *error)
{
    if (!check_three(d->low, 1e6, error, "basin's low corner") ||
        !check_three(d->high, 1e6, error, "basin's high corner") || !check_three(d->gravity, 1000, error, "gravity") ||
        !resolve(&d->spacing, 0, 1e-4, 1e3, "spacing in metres", error) ||
        !resolve(&d->step, 1.0 / 120, 1e-5, 0.1, "step in seconds", error) ||
        !resolve(&d->density, 1000, 1e-3, 1e6, "density in kg/m^3", error) ||
        !resolve(&d->viscosity, 0, 0, 1e4, "viscosity in m^2/s", error) ||
        !resolve(&d->solid_viscosity, d->viscosity, 0, 1e4, "solid viscosity in m^2/s", error) ||
        !resolve(&d->conductivity, 0, 0, 10, "conductivity in m^2/s", error) ||
        !resolve(&d->latent_heat, 0, 0, 1e6, "latent heat in degrees", error) ||
        !lom_check_range(d->melting[0], -1e6, 1e6, error, "The low end of a fluid's melting") ||
        !lom_check_range(d->melting[1], d->melting[0], 1e6, error, "The high end of a fluid's melting"))
        return false;
    int64_t all = 1;
    for (int i = 0; i < 3; i++) {
        cells[i] = lom_int_of((d->high[i] - d->low[i]) / (2 * d->spacing) + 0.5);
        if (cells[i] < 1 || cells[i] > LOM_FLUID_CELLS)
            return lom_fail(error, LOM_ERROR_LIMIT,
                            "The basin of a fluid is %d cells of two spacings from low to high; 1 to %d are possible.",
                            cells[i], LOM_FLUID_CELLS);
        d->high[i] = d->low[i] + cells[i] * 2 * d->spacing;
        all *= cells[i];
    }
    if (all > LOM_FLUID_ALL_CELLS)
        return lom_fail(error, LOM_ERROR_LIMIT,
                        "The basin of a fluid has %lld cells of two spacings from low to high; %d are possible.",
                        (long long)all, LOM_FLUID_ALL_CELLS);
    return check_bodies(d->blocks, d->block_count, 1, "block", error) &&
           check_bodies(d->solids, d->solid_count, 0, "solid", error);
}

static bool is_in(const lom_fluid_body *body, const double place[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const double half = (body->high[i] - body->low[i]) / 2, from = (place[i] - body->low[i]) / half - 1;
        if (!(from >= -1 && from < 1))
            return false;
        sum += from * from;
    }
    return body->shape == LOM_FLUID_BOX || sum <= 1;
}

static const lom_fluid_body *find_body(const lom_fluid_body *bodies, size_t count, const double place[3])
{
    for (size_t i = 0; i < count; i++)
        if (is_in(&bodies[i], place))
            return &bodies[i];
    return NULL;
}

/* ---- particles at first ---- */

static double corner_place(const int cell[3], int corner, int axis)
{
    return cell[axis] + (corner >> axis & 1 ? 0.75 : 0.25);
}

static bool is_below_floor(const struct lom_fluid *f, const int cell[3], int corner)
{
    return !(corner_place(cell, corner, 1) >
             lom_fluid_floor_at(f, corner_place(cell, corner, 0), corner_place(cell, corner, 2)));
}

/* Of a cell: two along each side, at a quarter and three quarters, where a block is and neither a solid nor the ground; counted, and put at
 * `out` unless it is NULL. */
static size_t fill_cell(const struct lom_fluid *f, const int cell[3], struct lom_fluid_point *out)
{
    size_t count = 0;
    double middle[3], place[3];
    for (int i = 0; i < 3; i++)
        middle[i] = f->desc.low[i] + (cell[i] + 0.5) * f->cell;
    const size_t at[3] = { (size_t)cell[0], (size_t)cell[1], (size_t)cell[2] };
    if (find_body(f->desc.solids, f->desc.solid_count, middle) != NULL || (f->floor != NULL && lom_floor_fills(f, at)))
        return 0;
    for (int corner = 0; corner < LOM_FLUID_REST; corner++) {
        for (int i = 0; i < 3; i++)
            place[i] = middle[i] + (corner >> i & 1 ? 0.25 : -0.25) * f->cell;
        const lom_fluid_body *block = find_body(f->desc.blocks, f->desc.block_count, place);
        if (block == NULL || (f->floor != NULL && is_below_floor(f, cell, corner)))
            continue;
        if (out != NULL) {
            struct lom_fluid_point *point = &out[count];
            point->heat = lom_fluid_heat(&f->desc, block->temperature);
            for (int i = 0; i < 3; i++) {
                point->at[i] = corner_place(cell, corner, i);
                point->velocity[i] = block->velocity[i] / f->cell;
            }
        }
        count++;
    }
    return count;
}

static size_t fill_blocks(const struct lom_fluid *f, struct lom_fluid_point *out)
{
    size_t count = 0;
    int cell[3];
    for (cell[2] = 0; cell[2] < f->cells[2]; cell[2]++)
        for (cell[1] = 0; cell[1] < f->cells[1]; cell[1]++)
            for (cell[0] = 0; cell[0] < f->cells[0]; cell[0]++)
                count += fill_cell(f, cell, out != NULL ? out + count : NULL);
    return count;
}

/* ---- the grid ---- */

/* Cells beyond the high sides are solid, too: their faces are the basin's. */
static void mark_solids(struct lom_fluid *f)
{
    for (size_t n = 0; n < f->count; n++) {
        const size_t at[3] = { n % f->stride[1], n / f->stride[1] % ((size_t)f->cells[1] + 1), n / f->stride[2] };
        bool inside = true;
        double middle[3];
        for (int i = 0; i < 3; i++) {
            inside = inside && at[i] < (size_t)f->cells[i];
            middle[i] = f->desc.low[i] + ((double)at[i] + 0.5) * f->cell;
        }
        const lom_fluid_body *body = inside ? find_body(f->desc.solids, f->desc.solid_count, middle) : NULL;
        const bool filled = inside && f->floor != NULL && lom_floor_fills(f, at);
        f->kind[n] = !inside || body != NULL || filled ? LOM_FLUID_SOLID : LOM_FLUID_AIR;
        if (f->solid_temperature != NULL)
            f->solid_temperature[n] = body != NULL && body->heats ? body->temperature : __builtin_nan("");
        for (int axis = 0; axis < 3; axis++)
            if (at[axis] > 0 && f->kind[n] == LOM_FLUID_AIR && f->kind[n - f->stride[axis]] == LOM_FLUID_AIR)
                f->open[n] |= (uint8_t)(1 << axis);
    }
}

static bool allocate_grid(struct lom_fluid *f, lom_error *error)
{
    bool heats = false;
    for (size_t i = 0; i < f->desc.solid_count; i++)
        heats = heats || (f->desc.solids[i].heats && f->desc.conductivity > 0);
    f->first = lom_allocate(f->count + 1, sizeof *f->first, error);
    for (int i = 0; i < 3; i++)
        f->face[i] = lom_allocate(f->count, sizeof *f->face[i], error);
    f->density = lom_allocate(f->count, sizeof *f->density, error);
    f->cell_heat = lom_allocate(f->count, sizeof *f->cell_heat, error);
    f->kind = lom_allocate(f->count, 1, error);
    f->open = lom_allocate(f->count, 1, error);
    f->unknown = lom_allocate(f->count, sizeof *f->unknown, error);
    f->pressure = lom_allocate(f->count, sizeof *f->pressure, error);
    f->push = lom_allocate(f->count, sizeof *f->push, error);
    if (heats)
        f->solid_temperature = lom_allocate(f->count, sizeof *f->solid_temperature, error);
    return f->first != NULL && f->face[0] != NULL && f->face[1] != NULL && f->face[2] != NULL && f->density != NULL &&
           f->cell_heat != NULL && f->kind != NULL && f->open != NULL && f->unknown != NULL && f->pressure != NULL &&
           f->push != NULL && (f->solid_temperature != NULL || !heats);
}

/* No more cells can be wet than there are cells, or particles. */
static bool allocate_system(struct lom_fluid *f, lom_error *error)
{
    struct lom_fluid_system *s = &f->system;
    const size_t most = f->point_count < f->count ? f->point_count : f->count;
    double **const arrays[] = { &s->diagonal, &s->right, &s->x, &s->residual, &s->way, &s->product };
    bool done = true;
    f->cell_of = lom_allocate(most, sizeof *f->cell_of, error);
    s->neighbour = lom_allocate(most, sizeof *s->neighbour, error);
    s->partial = lom_allocate(2 * (most / LOM_FLUID_PIECE + 1), sizeof *s->partial, error);
    s->done = lom_allocate(most / LOM_FLUID_PART + 1, sizeof *s->done, error);
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        *arrays[i] = lom_allocate(most + 1, sizeof **arrays[i], error);
        done = done && *arrays[i] != NULL;
    }
    if (f->floor != NULL && (s->share = lom_allocate(most, sizeof *s->share, error)) == NULL)
        return false;
    return done && f->cell_of != NULL && s->neighbour != NULL && s->partial != NULL && s->done != NULL;
}

static bool fill_fluid(struct lom_fluid *f, lom_error *error)
{
    f->points = lom_allocate(f->point_count, sizeof *f->points, error);
    f->sorted = lom_allocate(f->point_count, sizeof *f->sorted, error);
    f->place = lom_allocate(f->point_count, sizeof *f->place, error);
    f->solids = lom_allocate(f->desc.solid_count, sizeof *f->solids, error);
    if (f->points == NULL || f->sorted == NULL || f->place == NULL || f->solids == NULL || !allocate_grid(f, error) ||
        !allocate_system(f, error))
        return false;
    if (f->desc.solid_count > 0)
        memcpy(f->solids, f->desc.solids, f->desc.solid_count * sizeof *f->solids);
    f->desc.solids = f->solids;
    mark_solids(f);
    fill_blocks(f, f->points);
    f->desc.blocks = NULL;
    f->desc.ground = NULL;
    if (f->floor != NULL && !lom_cut_cells(f, error))
        return false;
    return (f->desc.viscosity == 0 && f->desc.solid_viscosity == 0) || lom_open_strain(f, error);
}

lom_fluid *lom_create_fluid(const lom_fluid_desc *desc, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    struct lom_fluid whole = { .desc = desc != NULL ? *desc : (lom_fluid_desc){ .spacing = 0 } };
    if (!resolve_desc(&whole.desc, whole.cells, error))
        return NULL;
    whole.cell = 2 * whole.desc.spacing;
    whole.stride[0] = 1;
    whole.stride[1] = (size_t)whole.cells[0] + 1;
    whole.stride[2] = whole.stride[1] * ((size_t)whole.cells[1] + 1);
    whole.count = whole.stride[2] * ((size_t)whole.cells[2] + 1);
    if (!lom_open_floor(&whole, error)) {
        lom_close_floor(&whole);
        return NULL;
    }
    whole.point_count = fill_blocks(&whole, NULL);
    if (whole.point_count == 0 || whole.point_count > LOM_FLUID_PARTICLES) {
        lom_fail(error, LOM_ERROR_LIMIT,
                 "The blocks of a fluid have %llu particles between low and high of the basin and over the ground "
                 "(in a scene the terrain, by its base and height), a "
                 "spacing apart; 1 to "
                 "%d are possible.",
                 (unsigned long long)whole.point_count, LOM_FLUID_PARTICLES);
        lom_close_floor(&whole);
        return NULL;
    }
    struct lom_fluid *f = lom_allocate(1, sizeof *f, error);
    if (f == NULL) {
        lom_close_floor(&whole);
        return NULL;
    }
    *f = whole;
    if (fill_fluid(f, error))
        return f;
    lom_free_fluid(f);
    return NULL;
}

void lom_free_fluid(lom_fluid *f)
{
    if (f == NULL)
        return;
    struct lom_fluid_system *s = &f->system;
    void *const arrays[] = { f->points,   f->sorted,  f->solids,    f->first,    f->face[0],   f->face[1],
                             f->face[2],  f->density, f->kind,      f->open,     f->unknown,   f->pressure,
                             f->push,     f->cell_of, s->neighbour, s->diagonal, s->right,     s->x,
                             s->residual, s->way,     s->product,   s->partial,  f->cell_heat, f->solid_temperature,
                             s->share,    f->place,   s->done };
    lom_close_strain(f);
    lom_close_floor(f);
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        lom_release(arrays[i]);
    lom_release(f);
}

/* ---- a step ---- */

void lom_share_fluid(const struct lom_fluid *f, size_t count, size_t piece, lom_range_work *work, void *context)
{
    if (f->device != NULL) {
        lom_share_work(f->device, count, piece, work, context);
        return;
    }
    for (size_t first = 0; first < count; first += piece)
        work(context, first, count - first < piece ? count : first + piece);
}

/* Along an axis gravity adds the same to every face that is open. */
static void pull(void *context, size_t first, size_t end)
{
    struct lom_fluid *f = context;
    for (int axis = 0; axis < 3; axis++) {
        const double gain = f->desc.gravity[axis] * f->desc.step / f->cell;
        for (size_t n = first; n < end; n++) {
            struct lom_fluid_face *face = &f->face[axis][n];
            face->velocity = face->mass > 0 ? face->velocity / face->mass + gain : 0;
        }
    }
}

bool lom_step_fluid(lom_fluid *f, lom_device *device, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    f->device = device;
    lom_sort_fluid(f);
    lom_gather_fluid(f);
    lom_find_wet_cells(f);
    lom_share_fluid(f, f->count, LOM_FLUID_PIECE, pull, f);
    const bool done = f->strain == NULL || lom_shear_fluid(f, error);
    if (done) {
        lom_project_fluid(f);
        lom_push_fluid(f);
        if (f->desc.conductivity > 0)
            lom_heat_fluid(f);
        lom_move_fluid(f);
        f->steps++;
    }
    f->device = NULL;
    return done;
}

/* ---- what can be seen of it ---- */

lom_fluid_view lom_view_fluid(const lom_fluid *f)
{
    lom_fluid_view view = {
        .cell = f->cell, .step = f->desc.step, .steps = f->steps, .particles = f->point_count, .wet = f->wet
    };
    memcpy(view.cells, f->cells, sizeof view.cells);
    memcpy(view.low, f->desc.low, sizeof view.low);
    memcpy(view.rounds, f->rounds, sizeof view.rounds);
    return view;
}

lom_fluid_particle lom_fluid_particle_at(const lom_fluid *f, size_t i)
{
    LOM_OWN_FLOAT_STATE;
    const struct lom_fluid_point *point = &f->points[i];
    lom_fluid_particle particle = { .temperature = lom_fluid_temperature(&f->desc, point->heat),
                                    .melted = lom_fluid_melted(&f->desc, point->heat) };
    for (int axis = 0; axis < 3; axis++) {
        particle.position[axis] = f->desc.low[axis] + point->at[axis] * f->cell;
        particle.velocity[axis] = point->velocity[axis] * f->cell;
    }
    return particle;
}

double lom_fluid_pressure_at(const lom_fluid *f, const double place[3])
{
    LOM_OWN_FLOAT_STATE;
    size_t n = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double at = (place[axis] - f->desc.low[axis]) / f->cell;
        if (!(at >= 0 && at < f->cells[axis]))
            return 0;
        n += lom_count_of(at, LOM_FLUID_CELLS) * f->stride[axis];
    }
    return f->pressure[n] * f->cell * f->cell / f->desc.step * f->desc.density;
}
