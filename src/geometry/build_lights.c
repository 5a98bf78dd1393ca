/* What gives light at the lake in the evening: a lantern, one on a post, a fire on the shore, the cabin with lit windows.
 * In: a seed for what is uneven; out: pieces whose materials have light of their own (Ke). The light that falls on other
 * things is a [[lamp]]'s, in the middle of the lantern's glass (0.17 m above its foot) or over the fire. */
#include "base/numbers.h"
#include "geometry/model.h"

#include <string.h>

/* A material without a texture. */
static void plain_material(lom_mesh_builder *builder, const char *name, const double diffuse[3],
                           const double emissive[3])
{
    lom_material material = lom_default_material(name);
    for (int i = 0; i < 3; i++) {
        material.ambient[i] = material.diffuse[i] = (float)diffuse[i];
        material.emissive[i] = (float)emissive[i];
        material.specular[i] = 0.1f;
    }
    material.shininess = 20;
    lom_builder_material(builder, &material);
}

static void use_iron(lom_mesh_builder *builder)
{
    plain_material(builder, "iron", (const double[3]){ 0.03, 0.03, 0.035 }, (const double[3]){ 0, 0, 0 });
}

static const lom_model_map no_map = { 0, 1, 0, 1 };

/* A low pyramid. */
static void build_cap(lom_mesh_builder *builder, double foot, double half, double height)
{
    const double x[4] = { -half, half, half, -half }, z[4] = { half, half, -half, -half };
    uint32_t corner[4], tip = lom_builder_vertex(builder, (lom_vec3){ 0, foot + height, 0 }, 0.5, 0);
    for (int i = 0; i < 4; i++)
        corner[i] = lom_builder_vertex(builder, (lom_vec3){ x[i], foot, z[i] }, i / 4.0, 1);
    for (int i = 0; i < 4; i++)
        lom_builder_triangle(builder, corner[i], corner[(i + 1) % 4], tip);
    lom_builder_quad(builder, corner[3], corner[2], corner[1], corner[0]);
}

/* 0.4 m high, on a foot at `foot`. */
static void build_lantern_at(lom_mesh_builder *builder, double foot)
{
    const double half = 0.1, bar = 0.012, low = foot + 0.04, high = foot + 0.3;
    use_iron(builder);
    lom_model_box(builder, (lom_vec3){ -half - 0.02, foot, -half - 0.02 }, (lom_vec3){ half + 0.02, low, half + 0.02 },
                  no_map);
    for (int i = 0; i < 4; i++) {
        const double x = i % 2 == 0 ? -half : half, z = i / 2 == 0 ? -half : half;
        lom_model_box(builder, (lom_vec3){ x - bar, low, z - bar }, (lom_vec3){ x + bar, high, z + bar }, no_map);
    }
    build_cap(builder, high, half + 0.035, 0.09);
    plain_material(builder, "lamp_glass", (const double[3]){ 0.3, 0.25, 0.2 }, (const double[3]){ 2.4, 1.1, 0.3 });
    lom_model_box(builder, (lom_vec3){ 0.012 - half, low, 0.012 - half },
                  (lom_vec3){ half - 0.012, high, half - 0.012 }, no_map);
}

void lom_build_lantern(lom_mesh_builder *builder, uint64_t seed)
{
    (void)seed;
    build_lantern_at(builder, 0);
}

void lom_build_lamp_post(lom_mesh_builder *builder, uint64_t seed)
{
    lom_model_material(builder, "log", 0.02, 8);
    lom_model_pole(builder, (lom_vec3){ lom_model_random(seed, 0, -0.03, 0.03), -0.8, 0 }, (lom_vec3){ 0, 1.5, 0 },
                   0.075, 0.06, 9, (lom_model_map){ 0, 1, 0, 1.3 });
    build_lantern_at(builder, 1.5);
}

/* ---- a fire of 1 m across ---- */

static void build_hearth(lom_mesh_builder *builder, uint64_t seed)
{
    enum { STONES = 11, LOGS = 6 };
    lom_model_material(builder, "stone", 0.02, 8);
    for (uint64_t i = 0; i < STONES; i++) {
        const double turn = lom_two_pi * (double)i / STONES, r = lom_model_random(seed, i * 4, 0.1, 0.17);
        lom_model_stone stone = {
            { 0.55 * lom_double_cos(turn), 0.4 * r, 0.55 * lom_double_sin(turn) }, { r * 1.2, r * 0.8, r }, seed + i, 1
        };
        lom_model_stone_at(builder, &stone);
    }
    lom_model_material(builder, "log", 0.02, 8);
    for (uint64_t i = 0; i < LOGS; i++) {
        const double turn = lom_two_pi * ((double)i + lom_model_random(seed, 100 + i, -0.2, 0.2)) / LOGS;
        const double c = lom_double_cos(turn), s = lom_double_sin(turn);
        lom_model_pole(builder, (lom_vec3){ 0.42 * c, 0.02, 0.42 * s }, (lom_vec3){ -0.07 * c, 0.4, -0.07 * s }, 0.05,
                       0.035, 7, (lom_model_map){ 0, 1, 0.3 * (double)i, 1.3 });
    }
}

/* Tongues around the middle: the inner ones are brighter and taller. */
static void build_tongues(lom_mesh_builder *builder, uint64_t seed, int count, double radius, double length)
{
    for (int i = 0; i < count; i++) {
        const uint64_t key = seed * 64 + (uint64_t)i * 8;
        const double turn = lom_two_pi * (i + lom_model_random(key, 0, -0.3, 0.3)) / count;
        const double c = lom_double_cos(turn), s = lom_double_sin(turn), lean = lom_model_random(key, 1, -0.25, 0.1);
        lom_model_leaf tongue = { .foot = { radius * c, 0.08, radius * s },
                                  .along = lom_vec3_normalize((lom_vec3){ lean * c, 1, lean * s }),
                                  .side = { -s, 0, c },
                                  .normal = { 0, 1, 0 },
                                  .length = length * lom_model_random(key, 2, 0.7, 1.15),
                                  .width = lom_model_random(key, 3, 0.16, 0.26),
                                  .droop = lom_model_random(key, 4, -0.05, 0.12),
                                  .segments = 5 };
        lom_model_leaf_at(builder, &tongue);
    }
}

void lom_build_fire(lom_mesh_builder *builder, uint64_t seed)
{
    static const double black[3] = { 0, 0, 0 };
    build_hearth(builder, seed);
    plain_material(builder, "flame", black, (const double[3]){ 3.6, 0.85, 0.08 });
    build_tongues(builder, seed + 1, 11, 0.24, 0.62);
    plain_material(builder, "flame_inside", black, (const double[3]){ 8, 3.0, 0.5 });
    build_tongues(builder, seed + 2, 8, 0.13, 0.78);
    plain_material(builder, "embers", black, (const double[3]){ 6, 1.2, 0.1 });
    lom_model_stone_at(builder, &(lom_model_stone){ { 0, 0.03, 0 }, { 0.3, 0.07, 0.3 }, seed, 2 });
}

/* ---- the cabin ---- */

/* The first material of a name is the one that the cabin's windows get. */
void lom_build_lit_cabin(lom_mesh_builder *builder, uint64_t seed)
{
    lom_material window = lom_default_material("window");
    const float light[3] = { 3.4f, 1.6f, 0.5f };
    memcpy(window.diffuse_map, "window.png", sizeof "window.png");
    memcpy(window.emissive_map, "lit_window.png", sizeof "lit_window.png");
    for (int i = 0; i < 3; i++) {
        window.ambient[i] = window.diffuse[i] = 1;
        window.specular[i] = 0.5f;
        window.emissive[i] = light[i];
    }
    window.shininess = 60;
    lom_builder_material(builder, &window);
    lom_build_cabin(builder, seed);
}
