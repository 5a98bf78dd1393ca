/* What an opaque surface sends back along a ray. In: a hit. Out: radiance of the light that comes there (reflect.c), the
 * terrain with its layers; the sky in a direction. */
#include "base/numbers.h"
#include "reference/reference.h"

static lom_vec3 mixed(lom_vec3 a, lom_vec3 b, double share)
{
    return along(a, difference(b, a), share);
}

/* ---- the point of a hit ---- */

struct point {
    lom_vec3 place, normal, color;
    double u, v;
    const uint32_t *corner;
    lom_vec3 along_u, along_v; /* tangents of the triangle, of any length; 0: the texture has no area there */
};

/* d place / d u and d place / d v, solved for from what both change by along two edges; times the area's magnitude. */
static void find_tangents(const lom_reference *reference, const uint32_t *index, struct point *p)
{
    const struct lom_ray_corner *c0 = &reference->corners[index[0]], *c1 = &reference->corners[index[1]],
                                *c2 = &reference->corners[index[2]];
    const lom_vec3 a = difference(reference->points[index[1]], reference->points[index[0]]);
    const lom_vec3 b = difference(reference->points[index[2]], reference->points[index[0]]);
    const double ua = c1->u - c0->u, va = c1->v - c0->v, ub = c2->u - c0->u, vb = c2->v - c0->v;
    const double area = ua * vb - va * ub, sign = area > 0 ? 1 : area < 0 ? -1 : 0;
    p->along_u = scaled(difference(scaled(a, vb), scaled(b, va)), sign);
    p->along_v = scaled(difference(scaled(b, ua), scaled(a, ub)), sign);
}

static struct point find_point(const lom_reference *reference, const struct lom_ray_hit *hit)
{
    const uint32_t *index = reference->triangles[hit->triangle].corner;
    const struct lom_ray_corner *c0 = &reference->corners[index[0]], *c1 = &reference->corners[index[1]],
                                *c2 = &reference->corners[index[2]];
    const double *b = hit->weight;
    return (struct point){ .place = blended(reference->points[index[0]], reference->points[index[1]],
                                            reference->points[index[2]], b),
                           .normal = unit(blended(c0->normal, c1->normal, c2->normal, b)),
                           .color = blended(c0->color, c1->color, c2->color, b),
                           .corner = index,
                           .u = c0->u * b[0] + c1->u * b[1] + c2->u * b[2],
                           .v = c0->v * b[0] + c1->v * b[1] + c2->v * b[2] };
}

/* ---- light ---- */

/* Light that has come through `depth` metres of water. The sun's beam is bent at the mean (level) surface; what enters
 * a horizontal area is kept, so across the beam it is light (1 - R) cos / cos', over the path depth / cos'. The ambient
 * light, from everywhere, loses 0.066 at the surface (C. Mobley, Light and Water, 1994, 4.2) and is followed straight
 * down. */
static struct lom_incident find_light(const lom_reference *reference, double depth)
{
    struct lom_incident in = { reference->to_light, reference->light, reference->ambient, reference->ground_light };
    if (!(depth > 0))
        return in;
    const lom_reference_water *water = &reference->water;
    const lom_vec3 up = { 0, 1, 0 };
    double cosine = in.to_light.y, beam = 0, beam_path = 0;
    lom_vec3 down;
    if (cosine > 0 && lom_reference_refract(scaled(in.to_light, -1), up, water->index, &down)) {
        in.to_light = scaled(down, -1);
        beam = (1 - lom_reference_fresnel(cosine, water->index)) * cosine / in.to_light.y;
        beam_path = depth / in.to_light.y;
    }
    in.light = scaled(product(in.light, lom_transmitted(water->absorption, beam_path)), beam);
    in.ambient = scaled(product(in.ambient, lom_transmitted(water->absorption, depth)), 1 - 0.066);
    in.ground = scaled(product(in.ground, lom_transmitted(water->absorption, depth)), 1 - 0.066);
    return in;
}

/* ---- terrain ---- */

static lom_vec3 sample_layer(const lom_reference *reference, const struct lom_ray_layer *layer, lom_vec3 place)
{
    return lom_sample_picture(&reference->pictures[layer->picture].picture, place.x * layer->scale[0],
                              place.z * layer->scale[1]);
}

/* From the three sides, mixed by the squares of the normal's components, of which those below a fifth count nothing; x
 * and y, and y and z, as a picture that stands upright. */
static lom_vec3 sample_sides(const lom_reference *reference, const struct lom_ray_layer *layer, lom_vec3 place,
                             lom_vec3 n)
{
    const struct lom_picture *picture = &reference->pictures[layer->picture].picture;
    const double share[3] = { lom_larger(n.x * n.x - 0.2, 0), lom_larger(n.y * n.y - 0.2, 0),
                              lom_larger(n.z * n.z - 0.2, 0) };
    const double s[3] = { place.z, place.x, place.x }, t[3] = { -place.y, place.z, -place.y };
    double whole = share[0] + share[1] + share[2];
    lom_vec3 color = { 0, 0, 0 };
    for (int side = 0; side < 3; side++)
        if (share[side] > 0)
            color = along(color, lom_sample_picture(picture, s[side] * layer->scale[0], t[side] * layer->scale[1]),
                          share[side] / whole);
    return color;
}

/* 1 inside [from, to], falling to 0 over `blend` outside it, linearly. */
static double range_weight(double x, double from, double to, double blend)
{
    blend = lom_larger(blend, 1e-3);
    return unit_interval(1 + (x - from) / blend) * unit_interval(1 + (to - x) / blend);
}

/* The sample at or before a coordinate of the ground, in -size / 2 .. size / 2, and how far the place is from it. */
static int find_sample(double place, double size, int samples, double *rest)
{
    double x = unit_interval(place / size + 0.5) * (samples - 1);
    int i = lom_int_of(x);
    i = i > samples - 2 ? samples - 2 : i;
    *rest = x - i;
    return i;
}

/* The normals of the four samples around a place, mixed over their square (docs/scene.md, [terrain]). */
static lom_vec3 ground_facing(const lom_reference *reference, lom_vec3 place)
{
    const lom_terrain *t = &reference->scene->terrain;
    double x, z;
    int column = find_sample(place.x, t->size[0], reference->ground_columns, &x);
    int row = find_sample(place.z, t->size[1], reference->ground_rows, &z);
    const struct lom_ray_corner *c = reference->corners + (size_t)row * (size_t)reference->ground_columns + column,
                                *d = c + reference->ground_columns;
    return unit(mixed(mixed(c[0].normal, c[1].normal, x), mixed(d[0].normal, d[1].normal, x), z));
}

static lom_vec3 ground_color(const lom_reference *reference, const struct point *s)
{
    const lom_terrain *t = &reference->scene->terrain;
    double up = s->normal.y, slope = lom_double_acos(up < -1 ? -1 : up > 1 ? 1 : up);
    lom_vec3 color = { 1, 1, 1 };
    if (reference->ground_texture.picture >= 0)
        color = sample_layer(reference, &reference->ground_texture, s->place);
    for (size_t i = 0; i < t->layer_count; i++) {
        const lom_terrain_layer *layer = &t->layers[i];
        double weight = range_weight(s->place.y, layer->from_height, layer->to_height, layer->blend) *
                        range_weight(slope, layer->from_slope, layer->to_slope, layer->slope_blend);
        double bright = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
        double gain = layer->grain * (1 - bright / reference->layers[i].below); /* docs/scene.md, [[terrain.layer]] */
        weight = unit_interval(weight + 4 * weight * (1 - weight) * gain);
        if (!(weight > 0))
            continue;
        lom_vec3 over = layer->mapping == LOM_MAPPING_TRIPLANAR
                            ? sample_sides(reference, &reference->layers[i], s->place, s->normal)
                            : sample_layer(reference, &reference->layers[i], s->place);
        color = mixed(color, over, weight);
    }
    if (reference->ground_detail.picture >= 0)
        color = scaled(product(color, sample_layer(reference, &reference->ground_detail, s->place)), 2);
    return color;
}

/* The normal map's z points up the surface, its x and y along the ground's x and z. */
static lom_vec3 ground_normal(const lom_reference *reference, const struct point *s)
{
    if (reference->ground_normals.picture < 0)
        return s->normal;
    lom_vec3 texel = sample_layer(reference, &reference->ground_normals, s->place);
    lom_vec3 bump = { texel.x * 2 - 1, 0, texel.y * 2 - 1 };
    return unit(along(bump, s->normal, texel.z * 2 - 1));
}

/* ---- entities ---- */

/* White where there is no map. */
static lom_vec3 look_up(const lom_reference *reference, int picture, const struct point *s)
{
    if (picture == LOM_NO_PICTURE)
        return (lom_vec3){ 1, 1, 1 };
    return lom_sample_picture(&reference->pictures[picture].picture, s->u, s->v);
}

/* The normal map's red points along u, its green against v, its blue along the normal. */
static lom_vec3 mapped_normal(const lom_reference *reference, const struct lom_ray_material *m, const struct point *s)
{
    if (m->normal_map == LOM_NO_PICTURE || dot(s->along_u, s->along_u) == 0)
        return s->normal;
    const lom_vec3 texel = look_up(reference, m->normal_map, s), n = s->normal;
    const lom_vec3 right = unit(along(s->along_u, n, -dot(n, s->along_u)));
    const lom_vec3 down = unit(along(s->along_v, n, -dot(n, s->along_v)));
    return unit(along(along(scaled(n, texel.z * 2 - 1), right, texel.x * 2 - 1), down, 1 - texel.y * 2));
}

/* ---- all of it ---- */

/* The light that comes to a place. */
static struct lom_incident find_incident(const lom_reference *reference, lom_vec3 place, double time, double *depth)
{
    const lom_reference *around = lom_reference_around(reference, place, time);
    *depth = lom_water_above(around, place, time);
    struct lom_incident in = find_light(around, *depth);
    if (dot(in.light, in.light) > 0 && !lom_sun_is_open(reference, place, *depth, in.to_light))
        in.light = (lom_vec3){ 0, 0, 0 };
    if (reference->liquids != NULL && reference->scene->quality.entity_shadows > 0)
        in.light = product(in.light, lom_liquids_leave(reference, place, in.to_light, 1e300));
    if (reference->cloud_count > 0)
        in.light = scaled(in.light, lom_cloud_shadow(reference, place, time));
    return in;
}

/* What an entity's material makes of it, all maps looked up; of `facing` all but the albedo and the normal are known. */
static lom_vec3 reflect(const lom_reference *reference, const struct lom_incident *in, const struct lom_ray_material *m,
                        struct point *s, struct lom_facing facing)
{
    find_tangents(reference, s->corner, s);
    facing.albedo = product(s->color, look_up(reference, m->picture, s));
    facing.normal = mapped_normal(reference, m, s);
    struct lom_ray_material here = *m;
    here.specular = product(m->specular, look_up(reference, m->specular_map, s));
    here.shininess = m->shininess * look_up(reference, m->gloss_map, s).x;
    return sum(lom_reflect_light(reference, in, &here, &facing),
               product(m->emissive, look_up(reference, m->emissive_map, s)));
}

static double presence_of(const lom_reference *reference, const struct lom_ray_material *m, const struct point *s)
{
    if (m->opacity_map == LOM_NO_PICTURE)
        return 1;
    const struct lom_picture *map = &reference->pictures[m->opacity_map].picture;
    return m->opacity_is_in_alpha ? lom_sample_picture_alpha(map, s->u, s->v) : lom_sample_picture(map, s->u, s->v).x;
}

/* The material of the side of a triangle that a ray along d meets. */
static const struct lom_ray_material *met_material(const lom_reference *reference, const struct lom_ray_triangle *t,
                                                   lom_vec3 d)
{
    const lom_vec3 *p = reference->points, corner = p[t->corner[0]];
    const lom_vec3 n = cross(difference(p[t->corner[1]], corner), difference(p[t->corner[2]], corner));
    const struct lom_ray_material *front = &reference->materials[t->material];
    return dot(n, d) > 0 ? &reference->materials[front->back] : front;
}

/* Ambient and diffuse light count by the opacity, the highlight and light of its own by how much of the surface there is,
 * which the map says. */
lom_vec3 lom_shade_transparent(const lom_reference *reference, const struct lom_ray *ray, const struct lom_ray_hit *hit,
                               double time, double *opacity)
{
    struct lom_ray_hit placed = *hit;
    placed.triangle += reference->opaque.count;
    struct point s = find_point(reference, &placed);
    const struct lom_ray_material *m = met_material(reference, &reference->triangles[placed.triangle], ray->direction);
    struct lom_ray_material rough = *m, polished = *m;
    double depth, presence = presence_of(reference, m, &s);
    struct lom_incident in = find_incident(reference, s.place, time, &depth);
    const lom_vec3 none = { 0, 0, 0 };
    if (dot(s.normal, ray->direction) > 0)
        s.normal = scaled(s.normal, -1);
    *opacity = presence * m->opacity;
    rough.specular = rough.emissive = none;
    polished.ambient = polished.diffuse = none;
    struct lom_facing facing = { s.place, s.normal, scaled(ray->direction, -1), { 1, 1, 1 }, depth };
    lom_vec3 light = reflect(reference, &in, &rough, &s, facing);
    lom_vec3 highlight = reflect(reference, &in, &polished, &s, facing);
    return sum(scaled(light, *opacity), scaled(highlight, presence));
}

lom_vec3 lom_shade_liquid(const lom_reference *reference, const struct lom_ray_material *material, lom_vec3 place,
                          lom_vec3 normal, lom_vec3 to_eye, double time, lom_vec3 *highlight)
{
    struct lom_ray_material rough = *material, polished = *material;
    double depth;
    const struct lom_incident in = find_incident(reference, place, time, &depth);
    const struct lom_facing facing = { place, normal, to_eye, { 1, 1, 1 }, depth };
    rough.specular = polished.ambient = polished.diffuse = (lom_vec3){ 0, 0, 0 };
    *highlight = lom_reflect_light(reference, &in, &polished, &facing);
    return lom_reflect_light(reference, &in, &rough, &facing);
}

lom_vec3 lom_shade_hit(const lom_reference *reference, const struct lom_ray *ray, const struct lom_ray_hit *hit,
                       double time)
{
    struct point s = find_point(reference, hit);
    double depth;
    struct lom_incident in = find_incident(reference, s.place, time, &depth);
    struct lom_facing facing = { s.place, s.normal, scaled(ray->direction, -1), { 1, 1, 1 }, depth };
    uint32_t material = reference->triangles[hit->triangle].material;
    if (material == LOM_TERRAIN_MATERIAL) {
        s.normal = ground_facing(reference, s.place);
        facing.normal = ground_normal(reference, &s);
        facing.albedo = ground_color(reference, &s);
        return lom_reflect_light(reference, &in, &reference->ground, &facing);
    }
    const struct lom_ray_material *m = &reference->materials[material];
    return reflect(reference, &in, m, &s, facing);
}

/* shading/gradient.h in double; d of unit length. */
static lom_vec3 gradient_light(const lom_sky_params *sky, lom_vec3 to_light, lom_vec3 d)
{
    double y = d.y > 0 ? d.y : 0, up = 1 - (1 - y) * (1 - y) * (1 - y);
    double low = 1 - y / sky->haze_height, c = dot(d, to_light), out[3];
    low = low > 0 ? low * low : 0;
    double c4 = c > 0 ? c * c * c * c : 0, c16 = c4 * c4 * c4 * c4;
    for (int i = 0; i < 3; i++) {
        double color = sky->horizon[i] + (sky->zenith[i] - sky->horizon[i]) * up;
        out[i] = color + (sky->haze[i] - color) * low + sky->glow[i] * (0.3 * c4 + 0.7 * c16 * c16);
    }
    return (lom_vec3){ out[0], out[1], out[2] };
}

lom_vec3 lom_sky_light(const lom_reference *reference, lom_vec3 d)
{
    const lom_sky_params *sky = &reference->scene->sky;
    if (reference->sky.image == NULL && sky->gradient)
        return scaled(gradient_light(sky, reference->to_light, d), sky->intensity);
    if (reference->sky.image == NULL)
        return scaled((lom_vec3){ sky->color[0], sky->color[1], sky->color[2] }, sky->intensity);
    lom_vec3 turned = { reference->sky_cosine * d.x + reference->sky_sine * d.z, d.y,
                        -reference->sky_sine * d.x + reference->sky_cosine * d.z };
    return scaled(lom_sample_cube_picture(&reference->sky, turned), sky->intensity);
}
