/* A clinker-built rowing boat of 4.2 m, its bow towards +x, afloat at y = 0. In: a seed for the oars; out: a hull of
 * six strakes with an inside, a sole above the water's surface (so that no lake shows in the boat), thwarts, ribs,
 * oars. */
#include "base/numbers.h"
#include "geometry/model.h"

static const double boat_length = 4.2;
enum { STATIONS = 20, STRAKES = 6 };

/* A section across the boat: a quarter of an ellipse to each side, from the keel to the sheer. */
typedef struct section {
    double x, half_width, keel, sheer;
} section;

static section section_at(double t)
{
    double ahead = t > 0.42 ? (t - 0.42) / 0.58 : 0, behind = t < 0.42 ? (0.42 - t) / 0.42 : 0;
    double rise = t > 0.55 ? (t - 0.55) / 0.45 : 0, lift = t - 0.35;
    return (section){
        .x = (t - 0.5) * boat_length + 0.12 * rise * rise,
        .half_width = 0.74 * (1 - ahead * ahead * lom_double_sqrt(ahead)) * (1 - 0.26 * behind * behind) + 0.012,
        .keel = -0.16 + 0.32 * rise * rise * rise,
        .sheer = 0.36 + 0.52 * lift * lift,
    };
}

/* A point of the section: q from 0 (keel) to 1 (sheer), hand -1 or 1, `out` metres outside the surface. */
static lom_vec3 hull_point(section s, double q, int hand, double out)
{
    double angle = lom_pi / 2 * q;
    double c = lom_double_cos(angle), n = lom_double_sin(angle);
    return (lom_vec3){ s.x, s.sheer - (s.sheer - s.keel) * c - out * c, hand * (s.half_width * n + out * n) };
}

/* A strip along the boat between two lines of it, facing out (hand * side > 0) or in. */
static void strip(lom_mesh_builder *builder, const double q[2], const double out[2], int hand, int side, double u)
{
    uint32_t last[2] = { 0 }, next[2];
    for (int i = 0; i <= STATIONS; i++) {
        double t = (double)i / STATIONS;
        for (int k = 0; k < 2; k++)
            next[k] = lom_builder_vertex(builder, hull_point(section_at(t), q[k], hand, out[k]), u + 0.25 * k, t * 2.5);
        if (i > 0 && hand * side > 0)
            lom_builder_quad(builder, last[0], next[0], next[1], last[1]);
        else if (i > 0)
            lom_builder_quad(builder, last[0], last[1], next[1], next[0]);
        last[0] = next[0];
        last[1] = next[1];
    }
}

static void build_hull(lom_mesh_builder *builder)
{
    const double lap = 0.018, thick = -0.022;
    for (int hand = -1; hand <= 1; hand += 2) {
        lom_model_material(builder, "paint", 0.10, 24);
        for (int i = 0; i < STRAKES; i++) {
            double low = (double)i / STRAKES, high = (double)(i + 1) / STRAKES;
            strip(builder, (double[2]){ low, high }, (double[2]){ lap, 0 }, hand, 1, 0.25 * i);
            if (i > 0)
                strip(builder, (double[2]){ low, low }, (double[2]){ 0, lap }, hand, 1, 0.25 * i);
        }
        lom_model_material(builder, "planks", 0.03, 10);
        for (int i = 0; i < STRAKES; i++)
            strip(builder, (double[2]){ (double)i / STRAKES, (double)(i + 1) / STRAKES }, (double[2]){ thick, thick },
                  hand, -1, 0.166667 * i);
    }
}

static void build_transom(lom_mesh_builder *builder)
{
    section s = section_at(0);
    for (int side = -1; side <= 1; side += 2) {
        lom_model_material(builder, side < 0 ? "paint" : "planks", 0.06, 16);
        section plate = s;
        plate.x += side < 0 ? 0 : 0.04;
        uint32_t middle = lom_builder_vertex(builder, (lom_vec3){ plate.x, s.sheer, 0 }, 0.5, 0);
        uint32_t last = 0;
        for (int i = -8; i <= 8; i++) {
            double q = (i < 0 ? -i : i) / 8.0;
            lom_vec3 p = hull_point(plate, q, i < 0 ? -1 : 1, 0.018);
            uint32_t next = lom_builder_vertex(builder, p, 0.5 + 0.6 * p.z, (s.sheer - p.y) * 0.8);
            if (i > -8 && side < 0)
                lom_builder_triangle(builder, middle, last, next);
            else if (i > -8)
                lom_builder_triangle(builder, middle, next, last);
            last = next;
        }
    }
}

/* Half the inner width at height y. */
static double inner_width(section s, double y)
{
    double c = (s.sheer - y) / (s.sheer - s.keel);
    return c >= 1 ? 0 : s.half_width * lom_double_sqrt(1 - c * c) - 0.01;
}

static void build_inside(lom_mesh_builder *builder)
{
    const double sole = 0.05;
    lom_model_material(builder, "planks", 0.03, 10);
    uint32_t last[2] = { 0 };
    for (int i = 0; i <= STATIONS; i++) {
        double t = 0.005 + 0.9 * i / STATIONS;
        section s = section_at(t);
        double half = inner_width(s, sole);
        half = half > 0 ? half : 0;
        uint32_t next[2] = { lom_builder_vertex(builder, (lom_vec3){ s.x, sole, -half }, -half * 0.9, s.x * 0.6),
                             lom_builder_vertex(builder, (lom_vec3){ s.x, sole, half }, half * 0.9, s.x * 0.6) };
        if (i > 0)
            lom_builder_quad(builder, last[0], last[1], next[1], next[0]);
        last[0] = next[0];
        last[1] = next[1];
    }
    static const double thwarts[3] = { 0.1, 0.42, 0.72 };
    for (int i = 0; i < 3; i++) {
        section s = section_at(thwarts[i]);
        double y = 0.22 + 0.02 * i, half = inner_width(s, y), deep = i == 0 ? 0.2 : 0.12;
        lom_model_box(builder, (lom_vec3){ s.x - deep, y, -half }, (lom_vec3){ s.x + deep, y + 0.03, half },
                      (lom_model_map){ 0.0, 0.3333, 0.1 * i, 1.4 });
    }
    lom_model_material(builder, "log", 0.03, 10);
    for (int i = 1; i < 9; i++)
        for (int hand = -1; hand <= 1; hand += 2) {
            section s = section_at(0.06 + 0.1 * i);
            lom_model_ring rib[5];
            for (int k = 0; k < 5; k++)
                rib[k] = (lom_model_ring){ hull_point(s, 0.5 + 0.122 * k, hand, -0.03), 0.016 };
            lom_model_tube(builder, rib, 5, 4, (lom_model_map){ 0, 0.2, 0, 1 });
        }
}

static void build_rails(lom_mesh_builder *builder)
{
    lom_model_material(builder, "log", 0.06, 16);
    for (int hand = -1; hand <= 1; hand += 2) {
        lom_model_ring rail[STATIONS + 1];
        for (int i = 0; i <= STATIONS; i++)
            rail[i] = (lom_model_ring){ hull_point(section_at((double)i / STATIONS), 1, hand, 0.0), 0.032 };
        lom_model_tube(builder, rail, STATIONS + 1, 6, (lom_model_map){ 0, 0.3, 0, 1 });
    }
    lom_model_ring stem[7];
    for (int i = 0; i < 7; i++) {
        double t = 0.8 + 0.2 * (i < 4 ? i / 4.0 : 1), q = i < 4 ? 0 : (i - 4) / 2.0;
        section s = section_at(t);
        stem[i] =
            (lom_model_ring){ { s.x + 0.02, s.sheer - (s.sheer - s.keel) * (1 - q) + (i == 6 ? 0.07 : 0), 0 }, 0.034 };
    }
    lom_model_tube(builder, stem, 7, 6, (lom_model_map){ 0, 0.3, 0, 1 });
}

/* Two oars lie on the thwarts. */
static void build_oars(lom_mesh_builder *builder, uint64_t seed)
{
    for (int i = 0; i < 2; i++) {
        double z = i == 0 ? -0.16 : 0.14, skew = lom_model_random(seed, (uint64_t)i, -0.1, 0.1);
        lom_vec3 handle = { 1.35, 0.33, z + skew }, neck = { -0.75, 0.285, z - skew },
                 end = { -1.45, 0.275, z - 1.3 * skew };
        lom_model_material(builder, "log", 0.05, 16);
        lom_model_pole(builder, neck, handle, 0.024, 0.019, 6, (lom_model_map){ 0, 0.25, 0, 1 });
        lom_model_material(builder, "paint", 0.1, 24);
        lom_model_box(builder, (lom_vec3){ end.x, end.y - 0.012, end.z - 0.075 },
                      (lom_vec3){ neck.x + 0.05, end.y + 0.012, end.z + 0.075 }, (lom_model_map){ 0.02, 0.23, 0.2, 2 });
    }
}

void lom_build_boat(lom_mesh_builder *builder, uint64_t seed)
{
    build_hull(builder);
    build_transom(builder);
    build_inside(builder);
    build_rails(builder);
    build_oars(builder, seed);
}
