/* What a surface makes of the light that comes to it. In: sun, ambient light and lamps at a place, a material. Out: radiance
 * towards the eye: ambient m.ambient + light (m.diffuse N.L + m.specular (R.E)^s), the first two terms times albedo, by
 * Phong's model (1975), Blinn's (1977), or with tones (docs/lighting.md). The ambient light goes from the ground's to the
 * sky's with the cosine to up. */
#include "base/numbers.h"
#include "reference/reference.h"

lom_vec3 lom_transmitted(const double absorption[3], double path)
{
    return (lom_vec3){ lom_double_exp(-absorption[0] * path), lom_double_exp(-absorption[1] * path),
                       lom_double_exp(-absorption[2] * path) };
}

/* ---- models ---- */

static double diffuse_of(const lom_quality *quality, double cosine)
{
    if (quality->reflection != LOM_REFLECTION_TOON)
        return lom_larger(cosine, 0);
    double tone = 0;
    for (int i = 0; i < 3; i++)
        if (cosine > 0 && cosine >= quality->toon_thresholds[i])
            tone = quality->toon_tones[i];
    return tone;
}

static double highlight_of(const lom_quality *quality, const struct lom_facing *at, lom_vec3 to_light, double exponent)
{
    const bool halfway = quality->reflection == LOM_REFLECTION_BLINN_PHONG;
    double cosine = halfway ? dot(at->normal, unit(sum(to_light, at->to_eye)))
                            : dot(lom_reference_mirror(scaled(to_light, -1), at->normal), at->to_eye);
    if (!(dot(at->normal, to_light) > 0 && cosine > 0))
        return 0;
    double highlight = lom_double_pow(cosine, exponent);
    return quality->reflection == LOM_REFLECTION_TOON ? highlight >= 0.5 : highlight;
}

/* ---- light ---- */

/* A lamp's light in water comes straight: what enters at the level surface has lost the mirrored share, and all that goes
 * through water loses its part of each metre. */
static lom_vec3 through_water(const lom_reference *reference, const struct lom_facing *at, lom_vec3 to_lamp,
                              double distance)
{
    const lom_reference_water *water = &lom_reference_around(reference, at->place, reference->moment.time)->water;
    const double path = to_lamp.y > 0 ? at->depth / to_lamp.y : 1e300;
    if (!(at->depth > 0))
        return (lom_vec3){ 1, 1, 1 };
    if (path >= distance)
        return lom_transmitted(water->absorption, distance);
    return scaled(lom_transmitted(water->absorption, path), 1 - lom_reference_fresnel(to_lamp.y, water->index));
}

static lom_vec3 add_lamp(const lom_reference *reference, const struct lom_placed_lamp *lamp,
                         const struct lom_ray_material *m, const struct lom_facing *at, lom_vec3 light)
{
    const lom_quality *quality = &reference->scene->quality;
    lom_vec3 to_lamp;
    double distance, share = lom_lamp_share_at(lamp, at->place, &to_lamp, &distance);
    if (!(share > 0) || !lom_lamp_is_open(reference, lamp, at->place, to_lamp, distance))
        return light;
    lom_vec3 come = scaled(through_water(reference, at, to_lamp, distance), share);
    if (reference->liquids != NULL && lamp->lamp->shadow && quality->lamp_shadows > 0)
        come = product(come, lom_liquids_leave(reference, at->place, to_lamp, distance));
    const lom_vec3 textured =
        sum(product(vector(lamp->ambient), m->ambient),
            scaled(product(vector(lamp->diffuse), m->diffuse), diffuse_of(quality, dot(at->normal, to_lamp))));
    const lom_vec3 highlight =
        scaled(product(vector(lamp->specular), m->specular), highlight_of(quality, at, to_lamp, m->shininess));
    return sum(light, product(come, sum(product(textured, at->albedo), highlight)));
}

lom_vec3 lom_reflect_light(const lom_reference *reference, const struct lom_incident *in,
                           const struct lom_ray_material *m, const struct lom_facing *at)
{
    const lom_quality *quality = &reference->scene->quality;
    lom_vec3 ambient = along(in->ground, difference(in->ambient, in->ground), 0.5 + 0.5 * at->normal.y);
    lom_vec3 textured = sum(product(ambient, m->ambient),
                            scaled(product(in->light, m->diffuse), diffuse_of(quality, dot(at->normal, in->to_light))));
    lom_vec3 color = product(textured, at->albedo);
    color = sum(color, scaled(product(in->light, m->specular), highlight_of(quality, at, in->to_light, m->shininess)));
    for (size_t i = 0; i < reference->moment.lamp_count; i++)
        color = add_lamp(reference, &reference->moment.lamps[i], m, at, color);
    return color;
}
