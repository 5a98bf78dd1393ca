/* Plain shapes for the scenes of features, without a material: a ball, an open bowl of one layer, a slab of few triangles.
 * In: nothing but the builder; out: surfaces with normals and uv. */
#include "base/numbers.h"
#include "geometry/model.h"

static void add(lom_mesh_builder *builder, lom_mesh *mesh, lom_vec3 place)
{
    const lom_mat4 move = lom_translation(place);
    lom_builder_transform(builder, &move);
    if (mesh != NULL)
        lom_builder_mesh(builder, mesh);
    lom_builder_transform(builder, NULL);
    lom_free_mesh(mesh);
}

/* 2 m high. */
void lom_build_ball(lom_mesh_builder *builder, uint64_t seed)
{
    (void)seed;
    add(builder, lom_make_sphere(1, 40, 20, NULL), (lom_vec3){ 0, 1, 0 });
}

/* 12 x 12 m at y = 0, of 6 x 6 squares. */
void lom_build_slab(lom_mesh_builder *builder, uint64_t seed)
{
    (void)seed;
    add(builder, lom_make_grid(12, 12, 6, 6, NULL), (lom_vec3){ 0, 0, 0 });
}

/* The lower half of a sphere of 1 m, seen from outside alone: its inside is a back. */
void lom_build_bowl(lom_mesh_builder *builder, uint64_t seed)
{
    enum { AROUND = 40, DOWN = 10 };
    uint32_t number[DOWN][AROUND + 1];
    const lom_vec3 below = { 0, -1, 0 };
    const uint32_t pole = lom_builder_vertex_normal(builder, (lom_vec3){ 0, 0, 0 }, below, 1, 1);
    (void)seed;
    for (int j = 0; j < DOWN; j++)
        for (int i = 0; i <= AROUND; i++) {
            const double down = lom_pi / 2 * j / DOWN, turn = lom_two_pi * i / AROUND, r = lom_double_cos(down);
            const lom_vec3 n = { r * lom_double_cos(turn), -lom_double_sin(down), r * lom_double_sin(turn) };
            number[j][i] = lom_builder_vertex_normal(builder, (lom_vec3){ n.x, 1 + n.y, n.z }, n, 2.0 * i / AROUND,
                                                     1.0 * j / DOWN);
        }
    for (int j = 0; j + 1 < DOWN; j++)
        for (int i = 0; i < AROUND; i++)
            lom_builder_quad(builder, number[j][i], number[j][i + 1], number[j + 1][i + 1], number[j + 1][i]);
    for (int i = 0; i < AROUND; i++)
        lom_builder_triangle(builder, number[DOWN - 1][i], number[DOWN - 1][i + 1], pole);
}
