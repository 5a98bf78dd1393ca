/* Proves of liquids of particles: a filled basin is still and has the pressure of its depth; a broken dam runs as
 * measured, never faster than Ritter's, and loses energy alone; volume is kept; what flies keeps its momentum, also
 * with another that it meets, and what meets a wall keeps that along it; the bytes are the same whoever does the
 * work; and numbers out of range are refused. */
#include "fluid_state.h"

/* ---- at rest ---- */

static void a_filled_basin_is_still_and_has_the_pressure_of_its_depth(void)
{
    const lom_fluid_body block = { .high = { 1, 0.5, 1 } };
    const lom_fluid_body stone = { .low = { 0.4, 0, 0.4 }, .high = { 0.6, 0.2, 0.6 } };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 0.8, 0.8, 0.8 },
                                                     .spacing = 0.025,
                                                     .gravity = { 0, -earth, 0 },
                                                     .blocks = &block,
                                                     .block_count = 1,
                                                     .solids = &stone,
                                                     .solid_count = 1 });
    run_fluid(fluid, 100);
    const struct fluid_sums s = sum_fluid(fluid);
    CHECK(s.fastest < 2e-3, "%g m/s", s.fastest);
    for (int i = 0; i < 10; i++) {
        const double place[3] = { 0.125, 0.05 * i + 0.025, 0.375 }, depth = 0.5 - place[1];
        const double pressure = lom_fluid_pressure_at(fluid, place), right = 1000 * earth * depth;
        CHECK(magnitude(pressure - right) < 1e-3 * 5000, "%g m deep: %g Pa, not %g", depth, pressure, right);
    }
    CHECK(lom_fluid_pressure_at(fluid, (double[3]){ 0.1, 0.7, 0.1 }) == 0);
    CHECK(lom_fluid_pressure_at(fluid, (double[3]){ 0.5, 0.1, 0.5 }) == 0);
    lom_free_fluid(fluid);
}

/* ---- the broken dam ---- */

/* J. C. Martin, W. J. Moyce: An experimental study of the collapse of liquid columns on a rigid horizontal plane, Phil.
 * Trans. R. Soc. A 244, 1952, figure 3: a column a = 2.25 inches wide and twice as high. T = t sqrt(2 g / a), Z = x /
 * a. */
static const double measured[][2] = { { 1.219, 1.474 }, { 1.997, 2.292 }, { 2.547, 2.995 }, { 3.345, 4.134 },
                                      { 4.034, 4.944 }, { 4.418, 5.881 }, { 5.091, 6.980 } };
enum { MEASURED = sizeof measured / sizeof *measured };

/* Their membrane takes time to open, so both clocks are set at the first reading. */
static void a_broken_dam_runs_as_measured(void)
{
    enum { ACROSS = 16 };
    const double a = 0.05715, spacing = a / ACROSS, unit = lom_double_sqrt(2 * earth / a);
    const lom_fluid_body column = { .high = { a, 2 * a, 1 } };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 9 * a, 2.5 * a, 4 * spacing },
                                                     .spacing = spacing,
                                                     .step = 1.0 / 1200,
                                                     .gravity = { 0, -earth, 0 },
                                                     .blocks = &column,
                                                     .block_count = 1 });
    double start = 0, before = 1, energy = 1e9;
    for (int step = 1, next = 0; next < MEASURED && step < 1000; step++) {
        run_fluid(fluid, 1);
        const struct fluid_sums s = sum_fluid(fluid);
        const double time = step * unit / 1200, front = (s.high[0] + spacing / 2) / a;
        if (start == 0 && front >= measured[0][1])
            start = time;
        if (start > 0 && time - start >= measured[next][0] - measured[0][0]) {
            CHECK(magnitude(front / measured[next][1] - 1) < 0.1, "T %g: the front is at %g, measured %g",
                  measured[next][0], front, measured[next][1]);
            next++;
        }
        if (step % 24 == 0) {
            CHECK((front - before) / (24 * unit / 1200) < 2, "T %g: faster than Ritter's front", time);
            before = front;
            const double now = s.kinetic + s.height_energy;
            CHECK(now < energy * 1.003, "T %g: energy grows from %.9g to %.9g", time, energy, now);
            energy = now < energy ? now : energy;
        }
    }
    CHECK(start > 0.8 && start < measured[0][0], "%g", start);
    lom_free_fluid(fluid);
}

/* ---- volume and energy in a basin that sloshes ---- */

enum { SLOSH = 24 };

static lom_fluid *make_slosh(void)
{
    const lom_fluid_body blocks[2] = {
        { .high = { 0.3, 0.7, 1 } },
        { .shape = LOM_FLUID_ELLIPSOID, .low = { 0.6, 0.5, 0.1 }, .high = { 0.9, 0.8, 0.4 } }
    };
    const lom_fluid_body stone = { .shape = LOM_FLUID_ELLIPSOID, .low = { 0.5, -0.2, 0.1 }, .high = { 0.8, 0.2, 0.4 } };
    return make_fluid(&(lom_fluid_desc){ .high = { 1, 1, 0.5 },
                                         .spacing = 0.5 / SLOSH,
                                         .step = 1.0 / 120,
                                         .gravity = { 0, -earth, 0 },
                                         .blocks = blocks,
                                         .block_count = 2,
                                         .solids = &stone,
                                         .solid_count = 1 });
}

/* Particles of the cells that have liquid on all sides; and those of the fullest. */
static double mean_filling(const lom_fluid *fluid, int *most)
{
    enum { ROWS = SLOSH / 2, ALL = SLOSH * SLOSH * ROWS };
    static int count[ALL];
    memset(count, 0, sizeof count);
    const lom_fluid_view v = lom_view_fluid(fluid);
    for (size_t i = 0; i < v.particles; i++) {
        const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
        int at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = lom_int_of(p.position[axis] / v.cell);
        count[at[0] + SLOSH * (at[1] + SLOSH * at[2])]++;
    }
    double sum = 0, cells = 0;
    for (int k = 1; k < ROWS - 1; k++)
        for (int j = 1; j < SLOSH - 1; j++)
            for (int i = 1; i < SLOSH - 1; i++) {
                bool inside = true;
                for (int n = 0; n < 27; n++)
                    inside = inside && count[i + n % 3 - 1 + SLOSH * (j + n / 3 % 3 - 1 + SLOSH * (k + n / 9 - 1))] > 0;
                const int here = count[i + SLOSH * (j + SLOSH * k)];
                sum += inside ? here : 0;
                cells += inside;
                *most = here > *most ? here : *most;
            }
    return sum / cells;
}

static void volume_is_kept_and_energy_never_grows(void)
{
    lom_fluid *fluid = make_slosh();
    struct fluid_sums s = sum_fluid(fluid);
    const double first = s.kinetic + s.height_energy;
    double before = first;
    int most = 0;
    for (int i = 0; i < 240; i++) {
        run_fluid(fluid, 1);
        s = sum_fluid(fluid);
        const double energy = s.kinetic + s.height_energy;
        CHECK(energy < before + 2e-3 * first, "step %d: energy grows from %g to %g", i, before, energy);
        before = energy < before ? energy : before;
        if (i % 20 == 19) {
            most = 0;
            const double filling = mean_filling(fluid, &most);

            CHECK(filling > 8 * 0.96 && filling < 8 * 1.04, "step %d: %g particles a cell", i, filling);
        }
    }
    CHECK(before < 0.9 * first, "%g of %g", before, first);
    lom_free_fluid(fluid);
}

/* ---- momentum ---- */

static void what_flies_keeps_its_momentum(void)
{
    const lom_fluid_body blocks[2] = { { .shape = LOM_FLUID_ELLIPSOID,
                                         .low = { 0.5, 0.7, 0.6 },
                                         .high = { 0.9, 1.1, 1.0 },
                                         .velocity = { 1.5, 0.25, 0 } },
                                       { .shape = LOM_FLUID_ELLIPSOID,
                                         .low = { 1.1, 0.8, 0.65 },
                                         .high = { 1.5, 1.2, 1.05 },
                                         .velocity = { -1, 0, 0.25 } } };
    lom_fluid_desc desc = { .high = { 2, 2, 1.6 }, .spacing = 0.025, .blocks = blocks, .block_count = 1 };
    lom_fluid *fluid = make_fluid(&desc);
    run_fluid(fluid, 40);
    struct fluid_sums s = sum_fluid(fluid);
    for (int i = 0; i < 3; i++)
        CHECK(magnitude(s.velocity[i] - blocks[0].velocity[i]) < 1e-12, "alone, axis %d: %.17g", i, s.velocity[i]);
    lom_free_fluid(fluid);
    desc.block_count = 2;
    fluid = make_fluid(&desc);
    const struct fluid_sums first = sum_fluid(fluid);
    run_fluid(fluid, 40);
    s = sum_fluid(fluid);
    for (int i = 0; i < 3; i++)
        CHECK(magnitude(s.velocity[i] - first.velocity[i]) < 0.01, "two, axis %d: %g becomes %g", i, first.velocity[i],
              s.velocity[i]);
    for (int i = 0; i < 3; i++)

        CHECK(s.kinetic < 0.9 * first.kinetic, "they have met: %g of %g", s.kinetic, first.kinetic);
    lom_free_fluid(fluid);
}

static void what_meets_a_wall_keeps_its_momentum_along_it(void)
{
    const lom_fluid_body block = {
        .shape = LOM_FLUID_ELLIPSOID, .low = { 0.4, 0.05, 0.4 }, .high = { 0.8, 0.45, 0.8 }, .velocity = { 1, -2, 0.5 }
    };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){
        .high = { 2, 1, 1.6 }, .spacing = 0.025, .step = 1.0 / 240, .blocks = &block, .block_count = 1 });
    run_fluid(fluid, 40);
    const struct fluid_sums s = sum_fluid(fluid);
    CHECK(magnitude(s.velocity[0] - 1) < 0.01 && magnitude(s.velocity[2] - 0.5) < 0.01, "%g and %g along the wall",
          s.velocity[0], s.velocity[2]);

    CHECK(magnitude(s.velocity[1]) < 1, "%g across it", s.velocity[1]);
    lom_free_fluid(fluid);
}

/* ---- the same bytes ---- */

static uint64_t hash_of(const lom_fluid *fluid)
{
    uint64_t hash = LOM_HASH_START;
    for (size_t i = 0; i < lom_view_fluid(fluid).particles; i++) {
        const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
        hash = lom_hash_bytes(hash, p.position, sizeof p.position);
        hash = lom_hash_bytes(hash, p.velocity, sizeof p.velocity);
        hash = lom_hash_bytes(hash, &p.temperature, sizeof p.temperature);
    }
    return hash;
}

static void everyone_computes_the_same_bytes(void)
{
    uint64_t first = 0;
    for (int threads = 0; threads <= 5; threads++) {
        lom_device *device = threads > 0 ? lom_open_device(&(lom_device_desc){ .threads = threads }) : NULL;
        lom_fluid *fluid = make_slosh();
        for (int i = 0; i < 30; i++)
            CHECK(lom_step_fluid(fluid, device, NULL));
        first = threads == 0 ? hash_of(fluid) : first;
        CHECK(hash_of(fluid) == first, "%d threads: %016llx, not %016llx", threads, (unsigned long long)hash_of(fluid),
              (unsigned long long)first);
        CHECK(first == UINT64_C(0xa65b47ac9c776476), "%016llx", (unsigned long long)first);
        lom_free_fluid(fluid);
        lom_close_device(device);
    }
}

/* ---- what is refused ---- */

static void numbers_out_of_range_are_refused(void)
{
    const lom_fluid_body block = { .high = { 1, 1, 1 } }, flat = { .high = { 1, 0, 1 } },
                         nowhere = { .low = { 5, 5, 5 }, .high = { 6, 6, 6 } };
    const lom_fluid_desc good = { .high = { 1, 1, 1 }, .spacing = 0.05, .blocks = &block, .block_count = 1 };
    lom_fluid_desc bad[17];
    size_t count = 0;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        bad[i] = good;
    bad[count++].spacing = 0;
    bad[count++].spacing = __builtin_nan("");
    bad[count++].spacing = 0.0005;
    bad[count++].high[0] = -1;
    bad[count++].high[1] = __builtin_inf();
    bad[count++].step = 1;
    bad[count++].viscosity = -1;
    bad[count++].melting[0] = 1;
    bad[count++].latent_heat = -1;
    bad[count++].gravity[2] = 2000;
    bad[count++].block_count = 0;
    bad[count++].block_count = LOM_FLUID_BODIES + 1;
    bad[count++].blocks = &flat;
    bad[count++].blocks = &nowhere;
    bad[count++].blocks = NULL;
    bad[count++].solid_count = 1;
    bad[count].solids = &block;
    bad[count++].solid_count = 1; /* no room is left */
    for (size_t i = 0; i < count; i++) {
        lom_error error = { 0 };
        CHECK(lom_create_fluid(&bad[i], &error) == NULL &&
                  (error.code == LOM_ERROR_USAGE || error.code == LOM_ERROR_LIMIT),
              "row %d", (int)i);
        CHECK(error.text[0] != 0 && error.text[strlen(error.text) - 1] == '.', "row %d: %s", (int)i, error.text);
    }
    CHECK(lom_create_fluid(NULL, NULL) == NULL);
    const lom_fluid_body much = { .high = { 100, 100, 100 } };
    lom_fluid_desc many = { .high = { 51.2, 51.2, 51.2 }, .spacing = 0.2, .blocks = &much, .block_count = 1 };
    lom_error error = { 0 };
    CHECK(lom_create_fluid(&many, &error) == NULL && error.code == LOM_ERROR_LIMIT, "%s", error.text);
    lom_free_fluid(NULL);
}

int main(int argc, char **argv)
{
    RUN(a_filled_basin_is_still_and_has_the_pressure_of_its_depth);
    RUN(a_broken_dam_runs_as_measured);
    RUN(volume_is_kept_and_energy_never_grows);
    RUN(what_flies_keeps_its_momentum);
    RUN(what_meets_a_wall_keeps_its_momentum_along_it);
    RUN(everyone_computes_the_same_bytes);
    RUN(numbers_out_of_range_are_refused);
    return check_result();
}
