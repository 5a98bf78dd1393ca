/* Three glass floats of a fishing net, adrift at y = 0. In: a seed for how they lie. Out: hollow balls of coloured glass, each
 * a closed sphere, and about each a net of cords: a sphere of whose surface only the cords are there, by its opacity map. */
#include "base/numbers.h"
#include "geometry/model.h"

#include <string.h>

enum { SLICES = 32, STACKS = 18 };

struct ball {
    const char *glass;
    float tint[3];
    lom_vec3 center;
    double radius;
};

/* A sphere; its picture is repeated `times` around it, half as often from pole to pole. `tilt`: radians about z, then `turn`
 * about y. */
static void build_sphere(lom_mesh_builder *builder, lom_vec3 center, double radius, double tilt, double turn, int times)
{
    uint32_t last[SLICES + 1] = { 0 }, next[SLICES + 1];
    for (int k = 0; k <= STACKS; k++) {
        const double rise = lom_pi * k / STACKS;
        const double y = -lom_double_cos(rise), across = k == 0 || k == STACKS ? 0 : lom_double_sin(rise);
        for (int i = 0; i <= SLICES; i++) {
            const double angle = i == SLICES ? 0 : lom_two_pi * i / SLICES;
            const double x = across * lom_double_cos(angle), z = -across * lom_double_sin(angle);
            const double leans = x * lom_double_cos(tilt) - y * lom_double_sin(tilt);
            const lom_vec3 n = { leans * lom_double_cos(turn) + z * lom_double_sin(turn),
                                 x * lom_double_sin(tilt) + y * lom_double_cos(tilt),
                                 z * lom_double_cos(turn) - leans * lom_double_sin(turn) };
            next[i] = lom_builder_vertex_normal(builder, lom_vec3_add(center, lom_vec3_scale(n, radius)), n,
                                                (double)times * i / SLICES, 0.5 * times * k / STACKS);
        }
        for (int i = 0; i < SLICES && k > 1; i++)
            lom_builder_triangle(builder, last[i], last[i + 1], next[i + 1]);
        for (int i = 0; i < SLICES && k > 0 && k < STACKS; i++)
            lom_builder_triangle(builder, last[i], next[i + 1], next[i]);
        memcpy(last, next, sizeof last);
    }
}

static lom_material material_of(const char *name, const float color[3], double specular, double shininess)
{
    lom_material m = lom_default_material(name);
    for (int k = 0; k < 3; k++) {
        m.ambient[k] = m.diffuse[k] = color[k];
        m.specular[k] = (float)specular;
    }
    m.shininess = (float)shininess;
    return m;
}

void lom_build_floats(lom_mesh_builder *builder, uint64_t seed)
{
    static const struct ball balls[] = { { "green-glass", { 0.02f, 0.20f, 0.11f }, { 0, 0.075, 0 }, 0.17 },
                                         { "blue-glass", { 0.03f, 0.13f, 0.24f }, { 0.36, 0.055, 0.10 }, 0.135 },
                                         { "amber-glass", { 0.34f, 0.13f, 0.01f }, { 0.13, 0.045, 0.33 }, 0.11 } };
    static const float cord[3] = { 0.46f, 0.36f, 0.22f };
    for (unsigned i = 0; i < sizeof balls / sizeof *balls; i++) {
        const struct ball *ball = &balls[i];
        const double tilt = lom_model_random(seed, 2 * i, -0.7, 0.7), turn = lom_model_random(seed, 2 * i + 1, 0, 6);
        lom_material glass = material_of(ball->glass, ball->tint, 0.9, 160), net = material_of("net", cord, 0.05, 8);
        glass.opacity = 0.5f;
        memcpy(net.opacity_map, "net.png", sizeof "net.png");
        lom_builder_material(builder, &glass);
        build_sphere(builder, ball->center, ball->radius, tilt, turn, 1);
        lom_builder_material(builder, &net);
        build_sphere(builder, ball->center, ball->radius * 1.03, tilt, turn, 8);
    }
}
