/* Light through a volume by random paths. In: a volume, the light around it, a ray. Out: the mean radiance of many
 * paths with its standard error. Every random number is a function of the key, the path, the scattering and its place
 * among that scattering's numbers. */
#include "base/numbers.h"
#include "reference/volume.h"

struct numbers {
    uint64_t key, counter;
};

static double draw(struct numbers *numbers)
{
    return lom_random_uniform(numbers->key, numbers->counter++);
}

enum { TENTATIVE = 1 << 20 }; /* encounters before the path is given up: where steps are lost to rounding */
enum meeting { LEFT, MET, GIVEN_UP };

/* Delta tracking: encounters with a medium of the greatest extinction everywhere, of which those with the real one are
 * kept. LEFT when the ray comes to the volume's end, or to `far`, before. */
static enum meeting meet(const lom_reference_volume *v, lom_vec3 origin, lom_vec3 d, double far,
                         struct numbers *numbers, lom_vec3 *place)
{
    double t = 0, to = far;
    if (v->greatest == 0 || !lom_cross_volume(v, origin, d, &t, &to))
        return LEFT;
    for (int i = 0; i < TENTATIVE; i++) {
        t -= lom_double_log1p(-draw(numbers)) / v->greatest;
        if (!(t < to))
            return LEFT;
        *place = along(origin, d, t);
        if (draw(numbers) * v->greatest < lom_volume_extinction(v, *place))
            return MET;
    }
    return GIVEN_UP;
}

/* Turned by this cosine, and about d by a random angle. The axes across d: T. Duff and others, Building an Orthonormal
 * Basis, Revisited, JCGT 6(1), 2017. */
static lom_vec3 turn(lom_vec3 d, double cosine, double uniform)
{
    double sign = d.z < 0 ? -1 : 1, a = -1 / (sign + d.z), b = d.x * d.y * a;
    lom_vec3 x = { 1 + sign * d.x * d.x * a, sign * b, -sign * d.x }, y = { b, sign + d.y * d.y * a, -d.y };
    double sine = lom_double_sqrt(lom_larger((1 - cosine) * (1 + cosine), 0)), angle = lom_two_pi * uniform;
    lom_vec3 across = along(scaled(x, sine * lom_double_cos(angle)), y, sine * lom_double_sin(angle));
    return unit(along(across, d, cosine));
}

/* The share of the sun that comes to a place. */
static double sun_left(const lom_reference_volume *v, const lom_reference_light *light, lom_vec3 place)
{
    const double share = light->sun_share != NULL ? light->sun_share(light->context, place) : 1;
    return share > 0 ? share * lom_double_exp(-lom_volume_optical_depth(v, place, light->to_sun, 0, __builtin_inf()))
                     : 0;
}

/* The sun's light that is scattered at a place back along d. */
static lom_vec3 sunlight(const lom_reference_volume *v, const lom_reference_light *light, lom_vec3 place, lom_vec3 d)
{
    lom_vec3 sun = { light->sun[0], light->sun[1], light->sun[2] };
    if (sun.x == 0 && sun.y == 0 && sun.z == 0)
        return sun;
    return scaled(sun, lom_phase_density(&v->phase, dot(d, light->to_sun)) * sun_left(v, light, place));
}

/* What a surface at a place makes of the sun, and where it sends the path on: by Lambert, who sends irradiance / pi in
 * every direction, and by cosine about the normal n. */
static lom_vec3 surface_light(const lom_reference_volume *v, const lom_reference_light *light, lom_vec3 place,
                              lom_vec3 n)
{
    double cosine = dot(n, light->to_sun);
    lom_vec3 sun = { light->sun[0], light->sun[1], light->sun[2] };
    if (!(cosine > 0))
        return (lom_vec3){ 0, 0, 0 };
    return scaled(sun, cosine / lom_pi * sun_left(v, light, place));
}

/* The light that a path finds where it met something, and its new direction. */
static lom_vec3 scatter(const lom_reference_volume *v, const lom_reference_light *light, lom_vec3 place, lom_vec3 *d,
                        double uniform, double choice, double turned)
{
    lom_vec3 n = v->look == LOM_LOOK_SURFACE ? lom_volume_normal(v, place, *d) : (lom_vec3){ 0, 0, 0 };
    if (dot(n, n) > 0) {
        lom_vec3 found = surface_light(v, light, place, n);
        *d = turn(n, lom_double_sqrt(1 - uniform), turned);
        return found;
    }
    lom_vec3 found = sunlight(v, light, place, *d);
    *d = turn(*d, lom_phase_cosine(&v->phase, uniform, choice), turned);
    return found;
}

static double greatest_of(lom_vec3 a)
{
    return lom_larger(a.x, lom_larger(a.y, a.z));
}

static lom_vec3 follow(const lom_reference_volume *v, const lom_reference_light *light, const lom_volume_rays *rays,
                       lom_vec3 d, int path, bool *cut)
{
    struct numbers numbers = { .key = lom_random_bits(rays->key, (uint64_t)path) };
    lom_vec3 weight = { 1, 1, 1 }, total = { 0, 0, 0 }, place = rays->origin;
    double far = rays->far;
    for (int event = 0;; event++) {
        numbers.counter = (uint64_t)event << 32;
        enum meeting meeting = meet(v, place, d, far, &numbers, &place);
        if (meeting == LEFT) {
            if (event > 0 && light->surroundings != NULL)
                total = sum(total, product(weight, light->surroundings(light->context, d)));
            return total;
        }
        if (meeting == GIVEN_UP || event == rays->events) {
            *cut = true;
            return total;
        }
        lom_vec3 color =
            v->transfer_count > 0 ? lom_seen_color(v, lom_volume_density(v, place)) : (lom_vec3){ 1, 1, 1 };
        if (v->transfer_count > 0 && v->look == LOM_LOOK_GLOWING)
            return sum(total, product(weight, color));
        weight = product(weight, product(color, v->albedo));
        double kept = greatest_of(weight);
        const lom_vec3 before = weight;
        bool ends = false;
        if (kept < 0.1) {
            ends = !(draw(&numbers) < kept);
            weight = scaled(weight, 1 / kept);
        }
        double uniform = draw(&numbers), choice = draw(&numbers);
        total = sum(total, product(before, scatter(v, light, place, &d, uniform, choice, draw(&numbers))));
        if (ends)
            return total;
        far = __builtin_inf();
    }
}

static bool is_finite(lom_vec3 a)
{
    return a.x - a.x == 0 && a.y - a.y == 0 && a.z - a.z == 0;
}

bool lom_trace_volume(const lom_reference_volume *volume, const lom_reference_light *light, const lom_volume_rays *rays,
                      lom_volume_light *out, lom_error *error)
{
    lom_vec3 d = lom_vec3_normalize(rays->direction);
    if (!is_finite(rays->origin) || dot(d, d) == 0 || rays->far != rays->far || rays->paths < 1 ||
        rays->paths > 1 << 24 || rays->events < 0 || rays->events > 65536)
        return lom_fail(
            error, LOM_ERROR_USAGE,
            "A ray through a volume has a finite origin, a direction, 1 to 2^24 paths and 0 to 65536 events.");
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_vec3 total = { 0, 0, 0 }, squares = { 0, 0, 0 };
    *out = (lom_volume_light){ .cut = false };
    for (int path = 0; path < rays->paths; path++) {
        lom_vec3 found = follow(volume, light, rays, d, path, &out->cut);
        total = sum(total, found);
        squares = sum(squares, product(found, found));
    }
    const double sums[3] = { total.x, total.y, total.z }, square_sums[3] = { squares.x, squares.y, squares.z };
    for (int i = 0; i < 3; i++) {
        double mean = sums[i] / rays->paths;
        double variance = lom_larger(square_sums[i] / rays->paths - mean * mean, 0);
        out->scattered[i] = mean;
        out->error[i] = rays->paths > 1 ? lom_double_sqrt(variance / (rays->paths - 1)) : 0;
    }
    out->transmittance = lom_double_exp(-lom_volume_optical_depth(volume, rays->origin, d, 0, rays->far));
    lom_leave_float_state(&state);
    return true;
}
