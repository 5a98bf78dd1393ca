/* Proves of the ground under a liquid: no particle is ever below it; the liquid comes to rest level in a bowl, as deep as
 * its volume says, and in still water over a slope the pressure is that of the depth; a block on a slope without
 * friction gains g sin of its angle; a flat floor anywhere within a cell holds it as the basin's does; ground below the
 * basin changes no byte, nor do workers; and particles are not made within it. */
#include "fluid_state.h"

struct plane {
    double height, slope; /* at x = 0, and along x */
};

static double plane_height(const void *context, double x, double z)
{
    const struct plane *plane = context;
    (void)z;
    return plane->height + plane->slope * x;
}

/* c ((x - 1/2)^2 + (z - 1/2)^2) */
static double bowl_height(const void *context, double x, double z)
{
    const double *c = context;
    return *c * ((x - 0.5) * (x - 0.5) + (z - 0.5) * (z - 0.5));
}

/* The least height of a particle over the ground. */
static double find_lowest(const lom_fluid *fluid, double (*ground)(const void *context, double x, double z),
                          const void *context)
{
    double lowest = 1e9;
    for (size_t i = 0; i < lom_view_fluid(fluid).particles; i++) {
        const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
        const double over = p.position[1] - ground(context, p.position[0], p.position[2]);
        lowest = over < lowest ? over : lowest;
    }
    return lowest;
}

/* ---- a bowl ---- */

static void a_liquid_comes_to_rest_level_in_a_bowl(void)
{
    static const double c = 1.5, spacing = 0.02;
    const lom_fluid_body block = { .low = { 0.2, 0.45, 0.3 }, .high = { 0.5, 0.75, 0.6 } };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 1, 1, 1 },
                                                     .spacing = spacing,
                                                     .viscosity = 0.01,
                                                     .slides = { true, true, true },
                                                     .gravity = { 0, -earth, 0 },
                                                     .blocks = &block,
                                                     .block_count = 1,
                                                     .ground = bowl_height,
                                                     .ground_context = &c });
    const size_t particles = lom_view_fluid(fluid).particles;
    for (int i = 0; i < 40; i++) {
        run_fluid(fluid, 24);
        CHECK(find_lowest(fluid, bowl_height, &c) > 0, "%g m below the ground", -find_lowest(fluid, bowl_height, &c));
    }
    CHECK(lom_view_fluid(fluid).particles == particles);
    /* pi h^2 / (2 c) is the volume up to the height h */
    const double volume = (double)particles * spacing * spacing * spacing;
    const double level = lom_double_sqrt(2 * c * volume / 3.141592653589793);
    lom_error error = { 0 };
    lom_mesh *mesh = lom_make_fluid_mesh(fluid, (double[3]){ 0, 0, 0 }, NULL, &error);
    double low = 1e9, high = -1e9, sum = 0;
    int count = 0;
    for (size_t i = 0; mesh != NULL && i < mesh->vertex_count; i++) {
        const lom_mesh_vertex *v = &mesh->vertices[i];
        const double x = (double)v->position[0], y = (double)v->position[1], z = (double)v->position[2];
        if (!((double)v->normal[1] > 0.9) || bowl_height(&c, x, z) > level - 4 * spacing)
            continue;
        low = y < low ? y : low;
        high = y > high ? y : high;
        sum += y;
        count++;
    }
    /* The middle of no shape of that volume is lower than that of the level one, which is at 2 h / 3. */
    const struct fluid_sums s = sum_fluid(fluid);
    printf(
        "  level %.4f m, by its volume %.4f; from %.4f to %.4f in %d places; the middle at %.4f, of a level one %.4f\n",
        sum / count, level, low, high, count, s.position[1], 2 * level / 3);
    CHECK(magnitude(s.position[1] / (2 * level / 3) - 1) < 0.01 && s.kinetic < 5e-4);
    CHECK(count > 200 && high - low < 2 * spacing && magnitude(sum / count - level) < 0.75 * spacing);
    lom_free_mesh(mesh);
    lom_free_fluid(fluid);
}

/* ---- slopes ---- */

static void still_water_over_a_slope_has_the_pressure_of_its_depth(void)
{
    static const struct plane plane = { 0.03, 0.4 };
    const lom_fluid_body block = { .high = { 1, 0.5, 1 } };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 0.8, 0.8, 0.4 },
                                                     .spacing = 0.025,
                                                     .gravity = { 0, -earth, 0 },
                                                     .blocks = &block,
                                                     .block_count = 1,
                                                     .ground = plane_height,
                                                     .ground_context = &plane });
    run_fluid(fluid, 240);
    const struct fluid_sums s = sum_fluid(fluid);
    double worst = 0;
    for (int i = 0; i < 6; i++) {
        const double place[3] = { 0.125, 0.05 * i + 0.175, 0.175 }, depth = 0.5 - place[1];
        const double off = lom_fluid_pressure_at(fluid, place) - 1000 * earth * depth;
        worst = magnitude(off) > worst ? magnitude(off) : worst;
    }
    printf("  at most %.1f Pa off, %.4f m/s\n", worst, s.fastest);
    CHECK(worst < 0.002 * 1000 * earth * 0.5 && s.fastest < 0.005);
    lom_free_fluid(fluid);
}

/* However a block on a slope of this tangent spreads: nothing but gravity acts along the slope, as long as it meets no
 * wall. */
static void check_slide(double tangent)
{
    const struct plane plane = { 0.02 + 3 * tangent, -tangent };
    const double cosine = 1 / lom_double_sqrt(1 + tangent * tangent), time = 0.25;
    const lom_fluid_body block = { .low = { 1.2, 0, 0 }, .high = { 1.7, 0.25 + 1.8 * tangent, 1 } };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 3, 0.3 + 3 * tangent, 0.2 },
                                                     .spacing = 0.02,
                                                     .step = 1.0 / 240,
                                                     .gravity = { 0, -earth, 0 },
                                                     .blocks = &block,
                                                     .block_count = 1,
                                                     .ground = plane_height,
                                                     .ground_context = &plane });
    run_fluid(fluid, 60);
    const struct fluid_sums s = sum_fluid(fluid);
    const double along = cosine * (s.velocity[0] - tangent * s.velocity[1]);
    const double exact = earth * tangent * cosine * time;
    printf("  tangent %g: %.4f m/s down the slope, without friction %.4f\n", tangent, along, exact);
    CHECK(magnitude(along / exact - 1) < 0.03);
    CHECK(find_lowest(fluid, plane_height, &plane) > 0);
    lom_free_fluid(fluid);
}

static void liquid_runs_down_a_slope(void)
{
    check_slide(0.15);
    check_slide(0.5);
    check_slide(1);
}

/* ---- flat ground ---- */

static void a_flat_floor_may_lie_anywhere(void)
{
    for (int i = 0; i < 4; i++) {
        const struct plane plane = { 0.0125 * i + 0.003, 0 };
        const lom_fluid_body block = { .high = { 0.2, 0.4, 1 } };
        lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 0.4, 0.6, 0.2 },
                                                         .spacing = 0.025,
                                                         .viscosity = 0.02,
                                                         .slides = { true, true, true },
                                                         .gravity = { 0, -earth, 0 },
                                                         .blocks = &block,
                                                         .block_count = 1,
                                                         .ground = plane_height,
                                                         .ground_context = &plane });
        run_fluid(fluid, 360);
        const double volume = (double)lom_view_fluid(fluid).particles * 0.025 * 0.025 * 0.025;
        const double middle = sum_fluid(fluid).position[1] - plane.height, exact = volume / (0.4 * 0.2) / 2;
        printf("  at %.4f m: the middle is %.4f m over it, by the volume %.4f\n", plane.height, middle, exact);
        CHECK(magnitude(middle - exact) < 0.003);
        lom_free_fluid(fluid);
    }
}

/* ---- the same bytes ---- */

static uint64_t hash_run(const struct plane *plane, int threads)
{
    lom_error error = { 0 };
    const lom_fluid_body block = { .high = { 0.5, 0.6, 1 } };
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = threads });
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 1, 0.8, 0.4 },
                                                     .spacing = 0.025,
                                                     .viscosity = 0.001,
                                                     .conductivity = 0.001,
                                                     .gravity = { 0, -earth, 0 },
                                                     .blocks = &block,
                                                     .block_count = 1,
                                                     .ground = plane != NULL ? plane_height : NULL,
                                                     .ground_context = plane });
    uint64_t hash = LOM_HASH_START;
    for (int i = 0; i < 30; i++)
        CHECK(lom_step_fluid(fluid, device, &error), "%s", error.text);
    for (size_t i = 0; i < lom_view_fluid(fluid).particles; i++) {
        const lom_fluid_particle p = lom_fluid_particle_at(fluid, i);
        hash = lom_hash_bytes(hash, &p, sizeof p);
    }
    lom_free_fluid(fluid);
    lom_close_device(device);
    return hash;
}

static void neither_workers_nor_ground_that_is_too_deep_change_a_byte(void)
{
    static const struct plane slope = { 0.1, 0.3 }, deep = { -1, 0.9 };
    CHECK(hash_run(&slope, 1) == hash_run(&slope, 3));
    CHECK(hash_run(&deep, 1) == hash_run(NULL, 1) && hash_run(&slope, 1) != hash_run(NULL, 1));
}

static void ground_that_fills_the_block_leaves_no_particle(void)
{
    static const struct plane high = { 0.7, 0 };
    lom_error error = { 0 };
    const lom_fluid_body block = { .high = { 0.5, 0.6, 1 } };
    lom_fluid *fluid = lom_create_fluid(&(lom_fluid_desc){ .high = { 1, 0.8, 0.4 },
                                                           .spacing = 0.025,
                                                           .blocks = &block,
                                                           .block_count = 1,
                                                           .ground = plane_height,
                                                           .ground_context = &high },
                                        &error);
    CHECK(fluid == NULL && strstr(error.text, "0 particles") != NULL, "%s", error.text);
    lom_free_fluid(fluid);
}

int main(int argc, char **argv)
{
    RUN(a_liquid_comes_to_rest_level_in_a_bowl);
    RUN(still_water_over_a_slope_has_the_pressure_of_its_depth);
    RUN(liquid_runs_down_a_slope);
    RUN(a_flat_floor_may_lie_anywhere);
    RUN(neither_workers_nor_ground_that_is_too_deep_change_a_byte);
    RUN(ground_that_fills_the_block_leaves_no_particle);
    return check_result();
}
