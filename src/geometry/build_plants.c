/* Trees and reeds. In: a seed; out: a stem of bark and leaves of both sides. The normals of leaves point away from the
 * stem and up, so that a crown is shaded as one soft body. */
#include "base/numbers.h"
#include "geometry/model.h"

static lom_vec3 around(double angle, double height)
{
    return (lom_vec3){ lom_double_cos(angle), height, lom_double_sin(angle) };
}

static lom_vec3 leaf_normal(lom_vec3 out, double up)
{
    return lom_vec3_normalize((lom_vec3){ out.x, out.y + up, out.z });
}

/* A bough: one broad leaf along it, and twigs to both sides that make its outline ragged. */
static void build_bough(lom_mesh_builder *builder, uint64_t seed, lom_vec3 foot, double angle, double length,
                        double rise)
{
    lom_vec3 along = lom_vec3_normalize(around(angle, rise));
    lom_vec3 side = { -lom_double_sin(angle), 0, lom_double_cos(angle) };
    double droop = lom_model_random(seed, 1, 0.22, 0.36);
    lom_model_leaf leaf = { .foot = foot,
                            .along = along,
                            .side = side,
                            .normal = leaf_normal(around(angle, 0), 0.75),
                            .length = length,
                            .width = 0.24 + 0.20 * length,
                            .droop = droop,
                            .u = lom_model_random(seed, 2, 0, 1),
                            .segments = 3 };
    lom_model_leaf_at(builder, &leaf);
    int twigs = 2 + lom_int_of(length * 1.9);
    for (int i = 0; i < twigs; i++)
        for (int hand = -1; hand <= 1; hand += 2) {
            uint64_t which = 10 + 8 * (uint64_t)i + (hand > 0 ? 4 : 0);
            double t = (i + lom_model_random(seed, which, 0.25, 0.95)) / (twigs + 0.4);
            lom_vec3 start = lom_vec3_add(foot, lom_vec3_scale(along, length * t));
            start.y -= droop * length * t * t;
            double turn = angle + hand * lom_model_random(seed, which + 1, 0.55, 1.0);
            lom_model_leaf twig = {
                .foot = start,
                .along = lom_vec3_normalize(around(turn, rise * 0.5 - 0.16)),
                .side = lom_vec3_normalize((lom_vec3){ -lom_double_sin(turn), 0.5 * hand, lom_double_cos(turn) }),
                .normal = leaf_normal(around(turn, 0), 0.55),
                .length = (0.22 + 0.30 * length * (1 - t)) * lom_model_random(seed, which + 2, 0.8, 1.3),
                .width = 0.26 + 0.11 * length,
                .droop = 0.45,
                .u = lom_model_random(seed, which + 3, 0, 1),
                .segments = 2
            };
            lom_model_leaf_at(builder, &twig);
        }
}

/* A spruce of 11 m: whorls of drooping boughs from the ground to the top. */
void lom_build_spruce(lom_mesh_builder *builder, uint64_t seed)
{
    const double height = 11.0;
    lom_model_material(builder, "bark", 0, 1);
    lom_model_ring stem[4] = { { { 0, -0.4, 0 }, 0.24 },
                               { { 0.03, 2, 0.02 }, 0.17 },
                               { { -0.03, 6, 0.04 }, 0.10 },
                               { { 0, height - 0.2, 0 }, 0.02 } };
    lom_model_tube(builder, stem, 4, 7, (lom_model_map){ 0, 2, 0, 1.2 });
    lom_model_material(builder, "needles", 0, 1);
    const int whorls = 24;
    for (int i = 0; i < whorls; i++) {
        uint64_t key = seed * 1000 + (uint64_t)i * 16;
        double t = (i + lom_model_random(key, 900, -0.25, 0.25)) / whorls;
        double reach = 2.5 * (1 - t) * (1.12 - 0.3 * t) * (0.95 + 0.05 * lom_double_sin(23 * t + (double)seed)) + 0.25;
        int boughs = t < 0.75 ? 6 : 5;
        double turn = lom_two_pi * lom_model_random(key, 901, 0, 1);
        for (int k = 0; k < boughs; k++) {
            uint64_t bough = key + (uint64_t)k + 1;
            double angle = turn + lom_two_pi * (k + lom_model_random(bough, 902, -0.25, 0.25)) / boughs;
            double length = reach * lom_model_random(bough, 903, 0.72, 1.12);
            double y = 0.7 + (height - 1.0) * t + lom_model_random(bough, 904, -0.22, 0.22);
            build_bough(builder, bough, (lom_vec3){ 0, y, 0 }, angle, length, -0.12 + 0.75 * t * t);
        }
    }
    for (int k = 0; k < 3; k++) {
        double angle = lom_two_pi * k / 3;
        lom_model_leaf top = { .foot = { 0, height - 0.75, 0 },
                               .along = { 0, 1, 0 },
                               .side = { lom_double_cos(angle), 0, lom_double_sin(angle) },
                               .normal = leaf_normal(around(angle, 0), 1),
                               .length = 1.0,
                               .width = 0.16,
                               .segments = 2 };
        lom_model_leaf_at(builder, &top);
    }
}

/* Leaves from one place in all directions of a flattened sphere. */
static void build_tuft(lom_mesh_builder *builder, uint64_t seed, lom_vec3 center, double radius, int leaves)
{
    for (int i = 0; i < leaves; i++) {
        double height = 1 - 1.55 * (i + 0.5) / leaves; /* Fibonacci's spiral over the sphere, without its bottom */
        double flat = lom_double_sqrt(1 - height * height), angle = 2.399963 * i + (double)(seed % 628) * 0.01;
        lom_vec3 out = { flat * lom_double_cos(angle), 0.62 * height, flat * lom_double_sin(angle) };
        lom_vec3 along = lom_vec3_normalize(out);
        lom_vec3 across = lom_vec3_normalize(lom_vec3_cross(along, (lom_vec3){ 0.3, 1, 0.2 }));
        lom_model_leaf leaf = { .foot = lom_vec3_add(center, lom_vec3_scale(along, radius * 0.12)),
                                .along = along,
                                .side = across,
                                .normal = leaf_normal(along, 0.5),
                                .length =
                                    radius * lom_model_random(seed, (uint64_t)i * 2, 0.75, 1.1) * lom_vec3_length(out),
                                .width = radius * 0.26,
                                .droop = 0.15,
                                .u = lom_model_random(seed, (uint64_t)i * 2 + 1, 0, 1),
                                .segments = 1 };
        lom_model_leaf_at(builder, &leaf);
    }
}

/* A Scots pine of 12 m: a long bare stem, crooked limbs, tufts at their ends. */
void lom_build_pine(lom_mesh_builder *builder, uint64_t seed)
{
    enum { RINGS = 7, LIMBS = 19 };
    lom_model_ring stem[RINGS];
    for (int i = 0; i < RINGS; i++) {
        double t = (double)i / (RINGS - 1);
        uint64_t key = (uint64_t)i * 2;
        double bend = 0.35 * t;
        stem[i] = (lom_model_ring){ { bend * lom_model_random(seed, key, -1, 1), -0.4 + 11.2 * t,
                                      bend * lom_model_random(seed, key + 1, -1, 1) },
                                    0.21 * (1 - t) + 0.045 };
    }
    lom_model_material(builder, "bark", 0, 1);
    lom_model_tube(builder, stem, RINGS, 8, (lom_model_map){ 0, 2, 0, 1.5 });
    lom_vec3 end[LIMBS];
    for (int i = 0; i < LIMBS; i++) {
        uint64_t key = 100 + (uint64_t)i * 4;
        double t = 0.42 + 0.56 * i / (LIMBS - 1), place = t * (RINGS - 1);
        int below = (int)lom_count_of(place, RINGS - 2);
        lom_vec3 a = stem[below].center, b = stem[below + 1].center;
        lom_vec3 start = lom_vec3_add(a, lom_vec3_scale(lom_vec3_subtract(b, a), place - below));
        double angle = 2.399963 * i + lom_model_random(seed, key, -0.4, 0.4);
        double length = (0.7 + 2.1 * lom_double_sqrt(1.02 - t) * 1.25) * lom_model_random(seed, key + 1, 0.75, 1.15);
        lom_vec3 out = around(angle, lom_model_random(seed, key + 2, 0.15, 0.5));
        lom_vec3 knee = lom_vec3_add(start, lom_vec3_scale(out, 0.55 * length));
        end[i] = lom_vec3_add(start, lom_vec3_scale(around(angle + 0.3, 0.55), length));
        lom_model_ring limb[3] = { { start, 0.085 }, { knee, 0.055 }, { end[i], 0.02 } };
        lom_model_tube(builder, limb, 3, 5, (lom_model_map){ 0, 1, 0, 1.5 });
    }
    lom_model_material(builder, "needles", 0, 1);
    for (int i = 0; i < LIMBS; i++) {
        uint64_t key = seed * 100 + (uint64_t)i;
        double size = lom_model_random(key, 50, 0.85, 1.25) * (1 - 0.25 * i / LIMBS);
        build_tuft(builder, key, end[i], size, 60);
        for (uint64_t k = 0; k < 2; k++) {
            lom_vec3 beside = { lom_model_random(key, 60 + 3 * k, -0.8, 0.8),
                                lom_model_random(key, 61 + 3 * k, -0.1, 0.35),
                                lom_model_random(key, 62 + 3 * k, -0.8, 0.8) };
            build_tuft(builder, key + 7777 * (k + 1), lom_vec3_add(end[i], beside), size * 0.75, 40);
        }
    }
    build_tuft(builder, seed + 31, stem[RINGS - 1].center, 0.9, 84);
}

/* A clump of reeds in water half a metre deep: y = 0 is the surface. */
void lom_build_reeds(lom_mesh_builder *builder, uint64_t seed)
{
    for (uint64_t i = 0; i < 96; i++) {
        uint64_t key = i * 8;
        double distance = 0.95 * lom_double_sqrt(lom_model_random(seed, key, 0, 1)), angle = 2.399963 * (double)i;
        lom_vec3 foot = { distance * lom_double_cos(angle), -0.6, 0.7 * distance * lom_double_sin(angle) };
        double lean = angle + lom_model_random(seed, key + 1, -1.2, 1.2),
               tilt = lom_model_random(seed, key + 2, 0.04, 0.26);
        double length = lom_model_random(seed, key + 3, 1.3, 2.3) * (1.1 - 0.25 * distance);
        lom_vec3 along = lom_vec3_normalize((lom_vec3){ tilt * lom_double_cos(lean), 1, tilt * lom_double_sin(lean) });
        double face = lom_model_random(seed, key + 4, 0, lom_two_pi);
        lom_vec3 side = { lom_double_cos(face), 0, lom_double_sin(face) };
        lom_model_material(builder, "reed", 0.08, 20);
        lom_model_leaf leaf = { .foot = foot,
                                .along = along,
                                .side = side,
                                .normal = leaf_normal((lom_vec3){ -side.z, 0, side.x }, 0.8),
                                .length = length,
                                .width = lom_model_random(seed, key + 5, 0.03, 0.055),
                                .droop = lom_model_random(seed, key + 6, 0.1, 1.4) * tilt,
                                .u = lom_model_random(seed, key + 7, 0, 1),
                                .segments = 4 };
        lom_model_leaf_at(builder, &leaf);
        if (i % 9 != 4)
            continue;
        lom_vec3 head =
            lom_vec3_add(foot, lom_vec3_scale((lom_vec3){ 0.05 * side.x, 1, 0.05 * side.z }, length * 0.96));
        lom_vec3 top = { head.x, head.y + 0.17, head.z }, tip = { head.x, head.y + 0.30, head.z };
        lom_model_pole(builder, foot, head, 0.008, 0.006, 4, (lom_model_map){ 0, 0.2, 0.5, 8 });
        lom_model_pole(builder, top, tip, 0.005, 0.001, 4, (lom_model_map){ 0, 0.2, 0.1, 8 });
        lom_model_material(builder, "bark", 0, 1);
        lom_model_pole(builder, head, top, 0.022, 0.020, 6, (lom_model_map){ 0, 0.2, 0, 0.7 });
    }
}
