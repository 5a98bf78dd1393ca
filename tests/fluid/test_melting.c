/* Proves of liquids with viscosity and heat: between plates the flow is Poiseuille's; turning as a whole is not braked;
 * heat is conducted as erf says, none is lost, and a melting front goes as deep as erfc says, with heat of melting as
 * Stefan says, and what melts stays at its melting point; what is stiff stands until it has melted. */
#include "fluid_state.h"

/* ---- viscosity ---- */

/* Gravity along x between plates across y: u = g / (2 nu) y (H - y), after H^2 / (pi^2 nu) and more. The liquid's ends
 * are free and rub less, some percent of the whole; the walls across z let it slide. */
static void between_plates_the_flow_is_poiseuilles(void)
{
    enum { CELLS = 10 };
    const double height = 0.2, viscosity = 0.4, pull = 8;
    const lom_fluid_body block = { .low = { 0.1, 0, 0 }, .high = { 1.3, height, 1 } };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 1.6, height, 0.04 },
                                                     .spacing = height / CELLS / 2,
                                                     .step = 1.0 / 500,
                                                     .gravity = { pull, 0, 0 },
                                                     .viscosity = viscosity,
                                                     .slides = { true, false, true },
                                                     .blocks = &block,
                                                     .block_count = 1 });
    run_fluid(fluid, 40);
    double sum[2 * CELLS] = { 0 }, count[2 * CELLS] = { 0 };
    for (size_t i = 0; i < lom_view_fluid(fluid).particles; i++) {
        const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
        if (p.position[0] < 0.6 || p.position[0] > 0.8)
            continue;
        const int row = lom_int_of(p.position[1] / height * 2 * CELLS);
        sum[row] += p.velocity[0];
        count[row]++;
    }
    const double fastest = pull * height * height / (8 * viscosity);
    for (int i = 0; i < 2 * CELLS; i++) {
        const double y = (i + 0.5) / (2 * CELLS), right = 4 * fastest * y * (1 - y);
        CHECK(count[i] > 0 && magnitude(sum[i] / count[i] - right) < 0.05 * fastest, "at %g of the height: %g, not %g",
              y, sum[i] / count[i], right);
    }
    lom_free_fluid(fluid);
}

/* ---- heat ---- */

enum { BAR = 100 };

static lom_fluid *make_bar(const lom_fluid_body *blocks, size_t count, const lom_fluid_body *plate)
{
    return make_fluid(&(lom_fluid_desc){ .high = { 1, 0.02, 0.02 },
                                         .spacing = 0.5 / BAR,
                                         .step = 1.0 / 100,
                                         .conductivity = 0.01,
                                         .blocks = blocks,
                                         .block_count = count,
                                         .solids = plate,
                                         .solid_count = plate != NULL });
}

/* T = (1 + erf(x / (2 sqrt(D t)))) / 2 from two halves of 0 and 1. */
static void heat_is_conducted_as_erf_says(void)
{
    const lom_fluid_body halves[2] = { { .high = { 0.5, 1, 1 } },
                                       { .low = { 0.5, 0, 0 }, .high = { 1, 1, 1 }, .temperature = 1 } };
    lom_fluid *fluid = make_bar(halves, 2, NULL);
    for (int round = 0; round < 3; round++) {
        run_fluid(fluid, 33);
        const lom_fluid_view view = lom_view_fluid(fluid);
        const double time = (double)view.steps * view.step, length = 2 * lom_double_sqrt(0.01 * time);
        for (size_t i = 0; i < view.particles; i++) {
            const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
            const double right = (1 + lom_double_erf((p.position[0] - 0.5) / length)) / 2;
            CHECK(magnitude(p.temperature - right) < 0.03, "%g s, %g m: %g, not %g", time, p.position[0] - 0.5,
                  p.temperature, right);
        }
        CHECK(magnitude(sum_fluid(fluid).temperature - 0.5) < 1e-9, "%.12g", sum_fluid(fluid).temperature);
    }
    lom_free_fluid(fluid);
}

/* From a plate of 1 heat enters a bar of 0: T = erfc(x / (2 sqrt(D t))), so that 1/2 is at 0.9539 sqrt(D t). */
static void a_melting_front_goes_as_deep_as_erfc_says(void)
{
    const lom_fluid_body bar = { .low = { 0.1, 0, 0 }, .high = { 1, 1, 1 } };
    const lom_fluid_body plate = { .high = { 0.1, 1, 1 }, .temperature = 1, .heats = true };
    lom_fluid *fluid = make_bar(&bar, 1, &plate);
    for (int round = 0; round < 4; round++) {
        run_fluid(fluid, 50);
        const lom_fluid_view view = lom_view_fluid(fluid);
        double front = 0;
        for (size_t i = 0; i < view.particles; i++) {
            const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
            front = p.temperature >= 0.5 && p.position[0] - 0.1 > front ? p.position[0] - 0.1 : front;
        }
        const double right = 0.953872552 * lom_double_sqrt(0.01 * (double)view.steps * view.step);
        CHECK(magnitude(front - right) < view.cell, "round %d: %g m deep, not %g", round, front, right);
    }
    lom_free_fluid(fluid);
}

/* ---- melting ---- */

/* Stefan's problem of one phase: a bar at its melting point 0, a plate of 1, heat of melting L: the front is 2 l sqrt(D t)
 * deep with l exp(l^2) erf(l) = 1 / (L sqrt(pi)), and between plate and front T = 1 - erf(x / (2 sqrt(D t))) / erf(l). */
static double stefan_number(double latent)
{
    double low = 0, high = 3;
    for (int i = 0; i < 60; i++) {
        const double l = (low + high) / 2,
                     value = l * lom_double_exp(l * l) * lom_double_erf(l) * latent * 1.7724538509055160;
        *(value < 1 ? &low : &high) = l;
    }
    return low;
}

static void a_front_goes_as_deep_as_stefan_says(void)
{
    const double latents[] = { 0.5, 2, 8 };
    for (int k = 0; k < 3; k++) {
        const lom_fluid_body bar = { .low = { 0.1, 0, 0 }, .high = { 1, 1, 1 } };
        const lom_fluid_body plate = { .high = { 0.1, 1, 1 }, .temperature = 1, .heats = true };
        lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 1, 0.02, 0.02 },
                                                         .spacing = 0.5 / BAR,
                                                         .step = 1.0 / 100,
                                                         .conductivity = 0.01,
                                                         .latent_heat = latents[k],
                                                         .blocks = &bar,
                                                         .block_count = 1,
                                                         .solids = &plate,
                                                         .solid_count = 1 });
        const double number = stefan_number(latents[k]);
        for (int round = 0; round < 4; round++) {
            run_fluid(fluid, 50);
            const lom_fluid_view view = lom_view_fluid(fluid);
            const double root = 2 * lom_double_sqrt(0.01 * (double)view.steps * view.step), depth = number * root;
            double melted = 0;
            for (size_t i = 0; i < view.particles; i++) {
                const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
                /* Particles of a cell have its temperature. */
                const double x = view.cell * (lom_double_floor((p.position[0] - 0.1) / view.cell) + 0.5),
                             hot = 1 - lom_double_erf(x / root) / lom_double_erf(number), right = x < depth ? hot : 0;
                melted += p.melted * 0.9 / (double)view.particles;
                CHECK(magnitude(p.temperature - right) < 0.02 + 0.5 * view.cell / depth,
                      "L %g, round %d, %g m: %g, not %g", latents[k], round, x, p.temperature, right);
            }
            CHECK(magnitude(melted - depth) < view.cell, "L %g, round %d: %g m deep, not %g", latents[k], round, melted,
                  depth);
        }
        lom_free_fluid(fluid);
    }
}

/* Half of a bar is 30 above its melting point, half 10 below; melting takes 50: in the end 20 / 50 of the colder half has
 * melted, nothing is warmer or colder than the melting point, and no heat is lost on the way. */
static void what_melts_stays_at_its_melting_point(void)
{
    const lom_fluid_body halves[2] = { { .high = { 0.5, 1, 1 }, .temperature = 130 },
                                       { .low = { 0.5, 0, 0 }, .high = { 1, 1, 1 }, .temperature = 90 } };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 1, 0.1, 0.1 },
                                                     .spacing = 0.025,
                                                     .step = 1.0 / 20,
                                                     .melting = { 100, 100 },
                                                     .latent_heat = 50,
                                                     .conductivity = 0.2,
                                                     .blocks = halves,
                                                     .block_count = 2 });
    for (int round = 0; round < 10; round++) {
        run_fluid(fluid, 60);
        double heat = 0, melted = 0, coldest = 1e9, warmest = -1e9;
        const size_t count = lom_view_fluid(fluid).particles;
        for (size_t i = 0; i < count; i++) {
            const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
            heat += (p.temperature + 50 * p.melted) / (double)count;
            melted += p.melted / (double)count;
            coldest = p.temperature < coldest ? p.temperature : coldest;
            warmest = p.temperature > warmest ? p.temperature : warmest;
        }
        CHECK(magnitude(heat - 135) < 1e-9, "round %d: a mean heat of %.12g", round, heat);
        if (round == 9) {
            CHECK(coldest > 99.99 && warmest < 100.06, "from %g to %g degrees", coldest, warmest);
            CHECK(magnitude(melted - 0.7) < 0.002, "%g has melted", melted);
        }
    }
    lom_free_fluid(fluid);
}

static lom_fluid *make_wax(double temperature, double conductivity)
{
    const lom_fluid_body wax = { .low = { 0.3, 0.1, 0.3 }, .high = { 0.7, 0.5, 0.7 }, .temperature = temperature };
    const lom_fluid_body plate = { .high = { 1, 0.1, 1 }, .temperature = 200, .heats = true };
    return make_fluid(&(lom_fluid_desc){ .high = { 1, 0.7, 1 },
                                         .spacing = 0.025,
                                         .step = 1.0 / 100,
                                         .gravity = { 0, -earth, 0 },
                                         .viscosity = 1e-3,
                                         .solid_viscosity = 100,
                                         .melting = { 55, 65 },
                                         .conductivity = conductivity,
                                         .blocks = &wax,
                                         .block_count = 1,
                                         .solids = &plate,
                                         .solid_count = 1 });
}

static double height_after(double temperature, double conductivity, int steps)
{
    lom_fluid *fluid = make_wax(temperature, conductivity);
    run_fluid(fluid, steps);

    const double height = sum_fluid(fluid).position[1] - 0.1;
    lom_free_fluid(fluid);
    return height;
}

static void what_is_stiff_stands_until_it_has_melted(void)
{
    const double stiff = height_after(20, 0, 100), liquid = height_after(80, 0, 100);
    const double melted = height_after(20, 0.02, 300);
    CHECK(stiff > 0.19, "stiff: the middle is %g m high", stiff);
    CHECK(liquid < 0.07, "liquid: %g m", liquid);
    CHECK(melted < 0.1, "on the plate: %g m", melted);
}

int main(int argc, char **argv)
{
    RUN(between_plates_the_flow_is_poiseuilles);
    RUN(heat_is_conducted_as_erf_says);
    RUN(a_melting_front_goes_as_deep_as_erfc_says);
    RUN(a_front_goes_as_deep_as_stefan_says);
    RUN(what_melts_stays_at_its_melting_point);
    RUN(what_is_stiff_stands_until_it_has_melted);
    return check_result();
}
