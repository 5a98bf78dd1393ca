/* A touring aircraft of 8.1 m with a span of 10.4 m, its nose towards -z, its middle at the origin. In: nothing; out:
 * fuselage, wings and tail with the skin that lom_paint_livery paints, wheels in spats, a propeller that stands still.
 */
#include "base/numbers.h"
#include "geometry/model.h"

enum { STATIONS = 26, SLICES = 18, FOIL = 6, SPANS = 3 };

/* Sections across the fuselage: z, half the width, the lowest and the highest point. */
static const double hull[][4] = {
    { -3.70, 0.20, -0.20, 0.18 }, { -3.55, 0.40, -0.42, 0.34 }, { -3.00, 0.51, -0.54, 0.44 },
    { -2.30, 0.56, -0.60, 0.50 }, { -1.75, 0.58, -0.62, 0.58 }, { -1.05, 0.60, -0.62, 1.04 },
    { -0.10, 0.60, -0.60, 1.14 }, { 0.90, 0.56, -0.54, 1.02 },  { 1.90, 0.42, -0.36, 0.74 },
    { 2.90, 0.26, -0.12, 0.54 },  { 3.80, 0.12, 0.10, 0.42 },   { 4.30, 0.03, 0.22, 0.34 },
};
enum { SECTIONS = sizeof hull / sizeof hull[0] };

/* Catmull and Rom's curve through the sections, t from 0 to SECTIONS - 1. */
static void section_at(double t, double section[4])
{
    int i = t < SECTIONS - 2 ? lom_int_of(t) : SECTIONS - 2;
    double s = t - i;
    const double *p0 = hull[i > 0 ? i - 1 : 0], *p1 = hull[i], *p2 = hull[i + 1];
    const double *p3 = hull[i + 2 < SECTIONS ? i + 2 : SECTIONS - 1];
    for (int k = 0; k < 4; k++)
        section[k] =
            p1[k] + 0.5 * s *
                        (p2[k] - p0[k] +
                         s * (2 * p0[k] - 5 * p1[k] + 4 * p2[k] - p3[k] + s * (3 * p1[k] - 3 * p2[k] + p3[k] - p0[k])));
}

/* A superellipse of exponent 2.5. */
static double bulge(double x)
{
    double size = x < 0 ? -x : x;
    double power = size > 0 ? lom_double_pow(size, 0.8) : 0;
    return x < 0 ? -power : power;
}

static void build_fuselage(lom_mesh_builder *builder)
{
    uint32_t last[SLICES + 1] = { 0 }, next[SLICES + 1];
    for (int k = 0; k <= STATIONS; k++) {
        double section[4];
        section_at((double)k / STATIONS * (SECTIONS - 1), section);
        double middle = (section[3] + section[2]) / 2, tall = (section[3] - section[2]) / 2;
        double v = 0.5 * (section[0] - hull[0][0]) / (hull[SECTIONS - 1][0] - hull[0][0]);
        for (int i = 0; i <= SLICES; i++) {
            double angle = lom_two_pi * i / SLICES;
            lom_vec3 p = { section[1] * bulge(lom_double_sin(angle)), middle - tall * bulge(lom_double_cos(angle)),
                           section[0] };
            next[i] = lom_builder_vertex(builder, p, (double)i / SLICES, 0.002 + v * 0.99);
        }
        for (int i = 0; k > 0 && i < SLICES; i++)
            lom_builder_quad(builder, last[i], last[i + 1], next[i + 1], next[i]);
        for (int i = 0; i <= SLICES; i++)
            last[i] = next[i];
    }
    for (int i = 1; i + 1 < SLICES; i++) /* the tail's end */
        lom_builder_triangle(builder, last[0], last[i], last[i + 1]);
}

/* A wing or a fin from root to tip, chords along z. */
struct wing {
    lom_vec3 root, tip;     /* leading edges */
    double chord[2], thick; /* at root and tip; of the chord */
    double v;               /* of its leading edge in the texture */
};

/* Half the thickness of a NACA 00xx section at x of the chord, for a thickness of 1 (Abbott, von Doenhoff 1959). */
static double half_thickness(double x)
{
    return 5 * (0.2969 * lom_double_sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1036))));
}

static void build_wing(lom_mesh_builder *builder, const struct wing *s)
{
    lom_vec3 span = lom_vec3_subtract(s->tip, s->root);
    bool is_mirrored = span.x < 0;
    lom_vec3 up = lom_vec3_normalize(lom_vec3_cross(span, (lom_vec3){ 0, 0, is_mirrored ? 1 : -1 }));
    enum { POINTS = 2 * FOIL + 1 };
    uint32_t last[POINTS] = { 0 }, next[POINTS];
    for (int k = 0; k <= SPANS + 1; k++) { /* the last one closes a rounded tip */
        double t = k <= SPANS ? (double)k / SPANS : 1.015;
        double chord = s->chord[0] + (s->chord[1] - s->chord[0]) * t, thick = k <= SPANS ? s->thick : 0.02;
        lom_vec3 edge = lom_vec3_add(s->root, lom_vec3_scale(span, t));
        for (int i = 0; i < POINTS; i++) {
            double x = (double)(i < FOIL ? FOIL - i : i - FOIL) / FOIL;
            x *= x;
            double out = (i < FOIL ? 1 : -0.8) * half_thickness(x) * thick * chord;
            lom_vec3 p = lom_vec3_add(edge, lom_vec3_scale(up, out));
            p.z += x * chord;
            next[i] = lom_builder_vertex(builder, p, 0.01 + 0.97 * t, s->v + 0.005 + 0.24 * x);
        }
        for (int i = 0; k > 0 && i + 1 < POINTS; i++)
            if (is_mirrored)
                lom_builder_quad(builder, last[i], last[i + 1], next[i + 1], next[i]);
            else
                lom_builder_quad(builder, last[i], next[i], next[i + 1], last[i + 1]);
        for (int i = 0; i < POINTS; i++)
            last[i] = next[i];
    }
}

static void build_wings(lom_mesh_builder *builder)
{
    for (int hand = -1; hand <= 1; hand += 2) {
        build_wing(
            builder,
            &(struct wing){ { hand * 0.35, -0.42, -1.15 }, { hand * 5.20, 0.12, -0.75 }, { 1.75, 1.15 }, 0.14, 0.5 });
        build_wing(builder, &(struct wing){
                                { hand * 0.06, 0.34, 3.15 }, { hand * 1.75, 0.38, 3.45 }, { 1.00, 0.65 }, 0.10, 0.75 });
    }
    build_wing(builder, &(struct wing){ { 0, 0.34, 2.75 }, { 0, 1.85, 3.75 }, { 1.50, 0.70 }, 0.10, 0.75 });
}

/* The gray of the keel: u = 0 of the fuselage. */
static void build_gear(lom_mesh_builder *builder)
{
    static const double wheels[3][3] = { { -1.25, -1.30, -0.35 }, { 1.25, -1.30, -0.35 }, { 0, -1.30, -2.75 } };
    for (int i = 0; i < 3; i++) {
        double x = wheels[i][0], y = wheels[i][1], z = wheels[i][2];
        const lom_model_ring spat[5] = { { { x, y + 0.03, z - 0.52 }, 0.03 },
                                         { { x, y + 0.03, z - 0.30 }, 0.17 },
                                         { { x, y + 0.04, z }, 0.20 },
                                         { { x, y + 0.06, z + 0.35 }, 0.13 },
                                         { { x, y + 0.10, z + 0.75 }, 0.02 } };
        lom_model_material(builder, "livery", 0.3, 60);
        lom_model_tube(builder, spat, 5, 8, (lom_model_map){ 0.12, 0.18, 0.1, 20 });
        lom_model_pole(builder, (lom_vec3){ x, y + 0.1, z }, (lom_vec3){ x * 0.85, -0.38, z + (i < 2 ? 0.15 : 0) },
                       0.055, 0.075, 6, (lom_model_map){ 0.01, 0.08, 0.1, 20 });
        lom_model_pole(builder, (lom_vec3){ x - 0.07, y - 0.06, z }, (lom_vec3){ x + 0.07, y - 0.06, z }, 0.2, 0.2, 10,
                       (lom_model_map){ 0.34, 0.36, 0.14, 20 });
    }
}

/* A blade: thin, twisted, along the angle. */
static void build_blade(lom_mesh_builder *builder, double angle)
{
    double s = lom_double_sin(angle), c = lom_double_cos(angle);
    uint32_t last[4] = { 0 }, next[4];
    for (int k = 0; k <= 5; k++) {
        double t = k / 5.0, r = 0.12 + 0.83 * t, half = 0.5 * (0.09 + 0.16 * t * (1.25 - t)), twist = 1.0 - 0.75 * t;
        double across = half * lom_double_cos(twist), ahead = half * lom_double_sin(twist);
        for (int i = 0; i < 4; i++) {
            double side = i == 0 ? -1 : i == 2 ? 1 : 0, thick = i == 1 ? 0.016 : i == 3 ? -0.016 : 0;
            lom_vec3 p = { c * r - s * side * across, s * r + c * side * across, -3.82 - side * ahead + thick };
            next[i] = lom_builder_vertex(builder, p, t > 0.85 ? 0.23 : 0.345, t > 0.85 ? 0.01 : 0.14);
        }
        for (int i = 0; k > 0 && i < 4; i++)
            lom_builder_quad(builder, last[i], next[i], next[(i + 1) % 4], last[(i + 1) % 4]);
        for (int i = 0; i < 4; i++)
            last[i] = next[i];
    }
    lom_builder_quad(builder, last[0], last[1], last[2], last[3]);
}

static void build_propeller(lom_mesh_builder *builder)
{
    const lom_model_ring spinner[4] = { { { 0, -0.01, -4.06 }, 0.02 },
                                        { { 0, -0.01, -3.98 }, 0.11 },
                                        { { 0, -0.01, -3.84 }, 0.18 },
                                        { { 0, -0.01, -3.68 }, 0.21 } };
    lom_model_tube(builder, spinner, 4, 14, (lom_model_map){ 0.23, 0.26, 0.01, 100 });
    for (int i = 0; i < 3; i++)
        build_blade(builder, 0.5 + lom_two_pi * i / 3);
}

void lom_build_aircraft(lom_mesh_builder *builder, uint64_t seed)
{
    (void)seed;
    lom_model_material(builder, "livery", 0.3, 60);
    build_fuselage(builder);
    build_wings(builder);
    build_gear(builder);
    build_propeller(builder);
}
