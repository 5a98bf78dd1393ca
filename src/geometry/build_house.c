/* What people built at the lake: a jetty and a log cabin. In: a seed for what is uneven; out: closed pieces of wood and
 * stone. */
#include "base/numbers.h"
#include "geometry/model.h"

/* ---- the jetty: 13 m from the land at the origin towards +x, its deck 0.55 m above the water ---- */

static const double deck = 0.55, jetty_length = 13.0, half_width = 0.85;

static void build_deck(lom_mesh_builder *builder, uint64_t seed)
{
    const int planks = 62;
    lom_model_material(builder, "planks", 0.03, 10);
    for (int i = 0; i < planks; i++) {
        uint64_t key = (uint64_t)i * 8;
        double x = jetty_length * i / planks, width = jetty_length / planks - lom_model_random(seed, key, 0.008, 0.02);
        double over = half_width + lom_model_random(seed, key + 1, 0.0, 0.09);
        lom_mat4 turn =
            lom_model_matrix((lom_vec3){ x + 0.5 * width, deck + lom_model_random(seed, key + 2, -0.008, 0.008), 0 },
                             (lom_vec3){ lom_model_random(seed, key + 3, -0.006, 0.006),
                                         lom_model_random(seed, key + 4, -0.012, 0.012), 0 },
                             (lom_vec3){ 1, 1, 1 });
        double column = (double)lom_int_of(lom_model_random(seed, key + 5, 0, 5.99)) / 6.0;
        lom_builder_transform(builder, &turn);
        lom_model_box(builder, (lom_vec3){ -0.5 * width, -0.04, -over },
                      (lom_vec3){ 0.5 * width, 0, lom_model_random(seed, key + 6, 0.0, 0.09) + half_width },
                      (lom_model_map){ column + 0.012, column + 0.155, lom_model_random(seed, key + 7, 0, 1), 3.1 });
    }
    lom_builder_transform(builder, NULL);
}

void lom_build_jetty(lom_mesh_builder *builder, uint64_t seed)
{
    build_deck(builder, seed);
    lom_model_material(builder, "log", 0.02, 8);
    for (int hand = -1; hand <= 1; hand += 2) {
        double z = hand * (half_width - 0.14);
        lom_model_box(builder, (lom_vec3){ 0.05, deck - 0.2, z - 0.06 },
                      (lom_vec3){ jetty_length - 0.05, deck - 0.04, z + 0.06 }, (lom_model_map){ 0, 0.4, 0, 2 });
        for (int i = 0; i < 6; i++) {
            uint64_t key = 1000 + (uint64_t)(i * 2 + (hand > 0)) * 4;
            double x = 0.35 + (jetty_length - 0.7) * i / 5.0, lean = lom_model_random(seed, key, -0.05, 0.05);
            double top = i == 5 ? deck + 0.62 : i % 2 == 1 ? deck + 0.16 : deck - 0.05;
            double radius = lom_model_random(seed, key + 1, 0.085, 0.11);
            lom_vec3 foot = { x + lean, -3.6, z + hand * 0.15 },
                     head = { x, top + lom_model_random(seed, key + 2, -0.04, 0.08), z + hand * 0.14 };
            lom_model_pole(builder, foot, head, radius * 1.1, radius, 9, (lom_model_map){ 0, 1, 0.2 * i, 1.3 });
        }
    }
    for (int i = 0; i < 6; i++) {
        double x = 0.35 + (jetty_length - 0.7) * i / 5.0;
        lom_model_box(builder, (lom_vec3){ x - 0.07, deck - 0.34, -half_width - 0.05 },
                      (lom_vec3){ x + 0.07, deck - 0.2, half_width + 0.05 }, (lom_model_map){ 0, 0.4, 0.1 * i, 2 });
    }
}

/* ---- the cabin: 6 x 4.4 m, the ridge along x, the door towards +z ---- */

static const double half_x = 3.0, half_z = 2.2, wall = 2.42, ridge = 4.25, floor_height = 0.35, log_radius = 0.125;

static void build_walls(lom_mesh_builder *builder, uint64_t seed)
{
    lom_model_material(builder, "log", 0.02, 8);
    int rows = lom_int_of((wall - floor_height) / (log_radius * 1.78)) - 1;
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < 4; k++) {
            uint64_t key = (uint64_t)(i * 4 + k) * 4;
            bool along_x = k < 2;
            double side = k % 2 == 0 ? 1 : -1, y = floor_height + log_radius * 1.78 * (i + (along_x ? 0.5 : 1.0));
            double radius = log_radius * lom_model_random(seed, key, 0.95, 1.06);
            double over = 0.27 + lom_model_random(seed, key + 1, -0.05, 0.06);
            lom_vec3 a = { half_x + over, y, side * half_z }, b = { -half_x - over, y, side * half_z };
            if (!along_x) {
                a = (lom_vec3){ side * half_x, y, half_z + over };
                b = (lom_vec3){ side * half_x, y, -half_z - over };
            }
            double v = lom_model_random(seed, key + 2, 0, 1);
            lom_model_pole(builder, a, b, radius, radius * 0.95, 9, (lom_model_map){ v, v + 0.6, v, 2.2 });
        }
}

/* Boards in the two gables, a triangle each of some thickness. */
static void build_gables(lom_mesh_builder *builder)
{
    lom_model_material(builder, "planks", 0.02, 8);
    for (int side = -1; side <= 1; side += 2) {
        double x = side * (half_x + 0.02), inner = side * (half_x - 0.06);
        for (int face = 0; face < 2; face++) {
            double at = face == 0 ? x : inner;
            uint32_t a = lom_builder_vertex(builder, (lom_vec3){ at, wall - 0.1, half_z }, 0, 0);
            uint32_t b = lom_builder_vertex(builder, (lom_vec3){ at, wall - 0.1, -half_z }, 2.4, 0);
            uint32_t c = lom_builder_vertex(builder, (lom_vec3){ at, ridge - 0.06, 0 }, 1.2, 0.9);
            if ((side > 0) == (face == 0))
                lom_builder_triangle(builder, a, b, c);
            else
                lom_builder_triangle(builder, b, a, c);
        }
    }
}

static void build_roof(lom_mesh_builder *builder)
{
    const double over_x = 0.65, over_z = 0.75, thick = 0.12;
    double slope = (ridge - wall) / half_z;
    double run = half_z + over_z, eaves = ridge - slope * run;
    double length = lom_double_sqrt(run * run + (ridge - eaves) * (ridge - eaves));
    for (int side = -1; side <= 1; side += 2) {
        double z = side * run, x = side * (half_x + over_x); /* x turns with the side, so that the winding stays */
        const lom_vec3 top[4] = {
            { -x, eaves + thick, z }, { x, eaves + thick, z }, { x, ridge + thick, 0 }, { -x, ridge + thick, 0 }
        };
        uint32_t upper[4], under[4];
        lom_model_material(builder, "shingles", 0.02, 8);
        for (int i = 0; i < 4; i++)
            upper[i] = lom_builder_vertex(builder, top[i], (i == 1 || i == 2) ? 3.4 : 0, i < 2 ? length * 0.55 : 0);
        lom_builder_quad(builder, upper[0], upper[1], upper[2], upper[3]);
        lom_model_material(builder, "planks", 0.02, 8);
        for (int i = 0; i < 4; i++)
            under[i] = lom_builder_vertex(builder, (lom_vec3){ top[i].x, top[i].y - thick, top[i].z },
                                          (i == 1 || i == 2) ? 3.4 : 0, i < 2 ? 1.2 : 0);
        lom_builder_quad(builder, under[3], under[2], under[1], under[0]);
        for (int i = 0; i < 4; i++) {
            int k = (i + 1) % 4;
            if (i != 2)
                lom_builder_quad(builder, under[i], under[k], upper[k], upper[i]);
        }
    }
    lom_model_material(builder, "log", 0.02, 8);
    lom_model_pole(builder, (lom_vec3){ -half_x - over_x - 0.1, ridge + thick, 0 },
                   (lom_vec3){ half_x + over_x + 0.1, ridge + thick, 0 }, 0.09, 0.085, 8,
                   (lom_model_map){ 0, 0.6, 0, 2 });
}

static void build_chimney(lom_mesh_builder *builder)
{
    lom_model_material(builder, "masonry", 0.02, 8);
    lom_model_box(builder, (lom_vec3){ -2.1, 1.0, -1.15 }, (lom_vec3){ -1.3, 5.0, -0.45 },
                  (lom_model_map){ 0, 0.55, 0, 1.5 });
    lom_model_box(builder, (lom_vec3){ -2.18, 5.0, -1.23 }, (lom_vec3){ -1.22, 5.12, -0.37 },
                  (lom_model_map){ 0, 0.6, 0.3, 1.5 });
    lom_model_box(builder, (lom_vec3){ -half_x - 0.1, -1.2, -half_z - 0.1 },
                  (lom_vec3){ half_x + 0.1, floor_height, half_z + 0.1 }, (lom_model_map){ 0, 1.0, 0.2, 1.5 });
}

/* A window in the wall at x, z, facing +z or, turned, +x. */
static void build_window(lom_mesh_builder *builder, lom_vec3 place, double turn, double width, double height)
{
    lom_mat4 to = lom_model_matrix(place, (lom_vec3){ 0, turn, 0 }, (lom_vec3){ 1, 1, 1 });
    lom_builder_transform(builder, &to);
    lom_model_material(builder, "planks", 0.03, 10);
    lom_model_box(builder, (lom_vec3){ -width / 2 - 0.09, -height / 2 - 0.09, -0.1 },
                  (lom_vec3){ width / 2 + 0.09, height / 2 + 0.09, 0.16 }, (lom_model_map){ 0.01, 0.15, 0, 3 });
    lom_model_material(builder, "window", 0.5, 60);
    const double u[4] = { 0, 1, 1, 0 }, v[4] = { 1, 1, 0, 0 };
    uint32_t corner[4];
    for (int i = 0; i < 4; i++)
        corner[i] =
            lom_builder_vertex(builder, (lom_vec3){ (u[i] - 0.5) * width, (0.5 - v[i]) * height, 0.175 }, u[i], v[i]);
    lom_builder_quad(builder, corner[0], corner[1], corner[2], corner[3]);
    lom_builder_transform(builder, NULL);
}

static void build_porch(lom_mesh_builder *builder)
{
    const double front = half_z + 1.35;
    lom_model_material(builder, "planks", 0.03, 10);
    lom_model_box(builder, (lom_vec3){ -half_x, 0.16, half_z }, (lom_vec3){ half_x, 0.3, front },
                  (lom_model_map){ 0, 1, 0, 3 });
    lom_model_box(builder, (lom_vec3){ -0.65, -0.3, front }, (lom_vec3){ 0.65, 0.12, front + 0.35 },
                  (lom_model_map){ 0, 0.3333, 0, 3 });
    lom_model_box(builder, (lom_vec3){ -0.48, floor_height, half_z + 0.06 },
                  (lom_vec3){ 0.48, floor_height + 1.95, half_z + 0.17 }, (lom_model_map){ 0, 0.6667, 0.5, 2.3 });
    lom_model_material(builder, "log", 0.02, 8);
    for (int i = 0; i < 4; i++) {
        double x = -half_x + 0.12 + (2 * half_x - 0.24) * i / 3.0;
        lom_model_pole(builder, (lom_vec3){ x, -0.8, front - 0.12 }, (lom_vec3){ x, 0.98, front - 0.12 }, 0.07, 0.065,
                       7, (lom_model_map){ 0, 0.5, 0.2 * i, 1.5 });
        if (i != 1)
            for (int rail = 0; rail < 2; rail++)
                lom_model_pole(
                    builder, (lom_vec3){ x - (i == 0 ? 0 : 0.12), 0.62 + 0.34 * rail, front - 0.12 },
                    (lom_vec3){ i == 3 ? x : x + (2 * half_x - 0.24) / 3.0, 0.62 + 0.34 * rail, front - 0.12 }, 0.04,
                    0.038, 6, (lom_model_map){ 0, 0.3, 0, 1.5 });
    }
}

void lom_build_cabin(lom_mesh_builder *builder, uint64_t seed)
{
    build_walls(builder, seed);
    build_gables(builder);
    build_roof(builder);
    build_chimney(builder);
    build_porch(builder);
    const double quarter = lom_pi / 2;
    build_window(builder, (lom_vec3){ -1.65, 1.55, half_z }, 0, 0.95, 0.85);
    build_window(builder, (lom_vec3){ 1.65, 1.55, half_z }, 0, 0.95, 0.85);
    build_window(builder, (lom_vec3){ half_x, 1.55, 0 }, quarter, 0.95, 0.85);
    build_window(builder, (lom_vec3){ -half_x, 1.55, 0.7 }, -quarter, 0.95, 0.85);
    build_window(builder, (lom_vec3){ half_x - 0.1, 3.1, 0 }, quarter, 0.6, 0.55);
}
