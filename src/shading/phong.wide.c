/* The light on what is opaque in a scene. In: places, normals. Out: what is reflected of sun, sky and ground, in the shadow
 * of terrain, clouds and entities and through the waves above (phong.h). */
#include "shading/phong.h"

/* The sunlight at a point in parts of the sun's: what the waves above it focus, fading in below the level and out at
 * the borders of the map. */
static lom_float caustic_light(const struct lom_view_uniform *view, lom_float3 offset)
{
    const struct lom_caustics_uniform *c = &view->caustics;
    lom_float one = lom_splat(1.0f);
    if (c->map == NULL || !lom_any(offset.y < c->level))
        return one;
    lom_float s = (offset.x - c->corner[0]) * c->scale, t = (offset.z - c->corner[1]) * c->scale;
    lom_float border = lom_min(lom_min(s, one - s), lom_min(t, one - t));
    lom_float share = lom_saturate(border * 10.0f) * lom_saturate((c->level - offset.y) * c->fade) * c->strength;
    lom_float texels = lom_sqrt(lom_dot3(offset, offset)) * c->lod_scale;
    lom_float light = lom_sample(c->map, s, t, lom_log2(lom_max(texels, one))).x;
    return lom_max(lom_mix(one, light, share), (lom_float){ 0 });
}

static struct lom_lit phong_light(const struct lom_view_uniform *view, const struct lom_material_uniform *m,
                                  lom_float3 offset, lom_float3 normal, lom_float sky)
{
    const struct lom_light_uniform *light = &view->light;
    lom_float share = lom_light_share(light, offset), facing = lom_lambert(light, normal);
    if (view->entity_shadow[0].map != NULL && /* the far one is only there with it */
        lom_any(facing * share > 0.0f)) {
        lom_float open;
        LOM_WIDE(lom_entity_light)(view, &offset, &normal, &open);
        share = share * open;
    }
    lom_float lambert = facing * share * caustic_light(view, offset);
    LOM_NAME_VALUE(normal);
    LOM_NAME_VALUE(facing);
    LOM_NAME_VALUE(share);
    LOM_NAME_VALUE(lambert);
    struct lom_lit lit;
    lom_float3 around = lom_mix3(lom_uniform3(light->ground), lom_uniform3(light->ambient), 0.5f + 0.5f * normal.y);
    lom_float3 ambient = lom_mul3(lom_scale3(around, sky), lom_uniform3(m->ambient));
    lom_float3 diffuse = lom_scale3(lom_mul3(lom_uniform3(light->color), lom_uniform3(m->diffuse)), lambert);
    LOM_NAME_VALUE(ambient);
    LOM_NAME_VALUE(diffuse);
    lit.textured = lom_add3(ambient, diffuse);
    lit.highlight = lom_splat3(0, 0, 0);
    if (m->specular[0] != 0 || m->specular[1] != 0 || m->specular[2] != 0) {
        lom_float3 to_eye = lom_normalize3(lom_scale3(offset, lom_splat(-1.0f)));
        lom_float specular = lom_phong_specular(light, normal, to_eye, m->shininess) * share;
        lit.highlight = lom_scale3(lom_mul3(lom_uniform3(light->color), lom_uniform3(m->specular)), specular);
    }
    return lit;
}

void LOM_WIDE(lom_phong_light_lanes)(const struct lom_view_uniform *view, const struct lom_material_uniform *m,
                                     const lom_float3 *offset, const lom_float3 *normal, const lom_float *sky,
                                     struct lom_lit *lit)
{
    *lit = phong_light(view, m, *offset, *normal, *sky);
}
