/* Proves of a liquid's surface: it is closed and faces outwards, holds the volume of the liquid, is flat where the
 * liquid is level, stands a spacing's half above the uppermost particles, and is the same for any number of workers. */
#include "fluid_state.h"

static lom_mesh *mesh_of(lom_fluid *fluid)
{
    lom_error error = { 0 };
    lom_mesh *mesh = lom_make_fluid_mesh(fluid, (double[3]){ 0, 0, 0 }, NULL, &error);
    if (mesh == NULL) {
        printf("  %s\n", error.text);
        exit(1);
    }
    return mesh;
}

/* Six times the volume is the sum of the determinants of the triangles' corners. */
static double volume_of(const lom_mesh *mesh)
{
    double sum = 0;
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        const float *p[3];
        for (int k = 0; k < 3; k++)
            p[k] = mesh->vertices[mesh->indices[i + (size_t)k]].position;
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            sum += (double)p[0][k] * ((double)p[1][l] * (double)p[2][m] - (double)p[1][m] * (double)p[2][l]);
        }
    }
    return sum / 6;
}

/* Each edge is passed as often one way as the other: the sum of mixed bits of its ends, signed by the way, is 0. */
static bool is_closed(const lom_mesh *mesh)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < mesh->index_count; i += 3)
        for (size_t k = 0; k < 3; k++) {
            const uint64_t a = mesh->indices[i + k], b = mesh->indices[i + (k + 1) % 3];
            const uint64_t bits = lom_random_bits(a < b ? a : b, a < b ? b : a);
            sum += a < b ? bits : 0 - bits;
        }
    return sum == 0 && mesh->index_count > 0;
}

static void check_volume(const lom_fluid_body *block, const double high[3], double volume, double bound)
{
    lom_fluid *fluid = make_fluid(
        &(lom_fluid_desc){ .high = { high[0], high[1], high[2] }, .spacing = 0.02, .blocks = block, .block_count = 1 });
    lom_mesh *mesh = mesh_of(fluid);
    CHECK(is_closed(mesh));
    CHECK(magnitude(volume_of(mesh) / volume - 1) < bound, "%g m^3, not %g", volume_of(mesh), volume);
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            CHECK((double)mesh->vertices[i].position[axis] >= 0 &&
                  (double)mesh->vertices[i].position[axis] <= high[axis]);
    lom_free_mesh(mesh);
    lom_free_fluid(fluid);
}

static void the_surface_holds_the_liquid(void)
{
    const double high[3] = { 0.8, 0.8, 0.8 };
    const lom_fluid_body pool = { .high = { 1, 0.4, 1 } };
    check_volume(&pool, high, 0.8 * 0.8 * 0.4, 0.02);
    const lom_fluid_body ball = { .shape = LOM_FLUID_ELLIPSOID, .low = { 0.2, 0.2, 0.2 }, .high = { 0.6, 0.6, 0.6 } };
    check_volume(&ball, high, 4.18879 * 0.008, 0.05);
}

static void a_level_liquid_is_flat(void)
{
    const lom_fluid_body pool = { .high = { 1, 0.4, 1 } };
    lom_fluid *fluid =
        make_fluid(&(lom_fluid_desc){ .high = { 0.8, 0.8, 0.8 }, .spacing = 0.02, .blocks = &pool, .block_count = 1 });
    lom_mesh *mesh = mesh_of(fluid);
    size_t count = 0;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const lom_mesh_vertex *v = &mesh->vertices[i];
        bool inner = (double)v->position[1] > 0.2;
        for (int axis = 0; axis < 3; axis += 2)
            inner = inner && (double)v->position[axis] > 0.06 && (double)v->position[axis] < 0.74;
        if (!inner)
            continue;
        count++;
        CHECK(magnitude((double)v->position[1] - 0.4) < 0.002, "%g m high", (double)v->position[1]);
        CHECK((double)v->normal[1] > 0.999, "%g", (double)v->normal[1]);
    }
    CHECK(count > 500, "%d vertices", (int)count);
    lom_free_mesh(mesh);
    lom_free_fluid(fluid);
}

static uint64_t hash_after(int threads, bool meshed, double *volume)
{
    const lom_fluid_body column = { .high = { 0.3, 0.6, 1 } };
    lom_fluid *fluid = make_fluid(&(lom_fluid_desc){ .high = { 0.8, 0.8, 0.4 },
                                                     .spacing = 0.025,
                                                     .gravity = { 0, -earth, 0 },
                                                     .blocks = &column,
                                                     .block_count = 1 });
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = threads });
    for (int i = 0; i < 40; i++) {
        CHECK(lom_step_fluid(fluid, device, NULL));
        if (meshed)
            lom_free_mesh(lom_make_fluid_mesh(fluid, (double[3]){ 1, 2, 3 }, device, NULL));
    }
    lom_mesh *mesh = lom_make_fluid_mesh(fluid, (double[3]){ 0, 0, 0 }, device, NULL);
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices);
    hash = lom_hash_bytes(hash, mesh->indices, mesh->index_count * sizeof *mesh->indices);
    CHECK(is_closed(mesh));
    *volume = volume_of(mesh);
    lom_free_mesh(mesh);
    lom_free_fluid(fluid);
    lom_close_device(device);
    return hash;
}

static void it_is_the_same_for_any_number_of_workers_and_changes_no_step(void)
{
    double volume;
    const uint64_t first = hash_after(1, false, &volume);
    CHECK(magnitude(volume / (0.3 * 0.6 * 0.4) - 1) < 0.15, "%g m^3 in a splash", volume);
    for (int threads = 2; threads <= 3; threads++)
        CHECK(hash_after(threads, true, &volume) == first, "%d threads", threads);
}

int main(int argc, char **argv)
{
    RUN(the_surface_holds_the_liquid);
    RUN(a_level_liquid_is_flat);
    RUN(it_is_the_same_for_any_number_of_workers_and_changes_no_step);
    return check_result();
}
