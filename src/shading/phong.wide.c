/* The light on what is opaque in a scene. In: places, normals. Out: what is reflected of sun, sky and ground, in the shadow
 * of terrain, clouds and entities and through the waves above, and of lamps (phong.h). */
#include "shading/phong.h"

#include "shading/lamp.h"
#include "shading/reflection.h"

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
    lom_float away = view->eye.parallel ? one : lom_sqrt(lom_dot3(offset, offset)), texels = away * c->lod_scale;
    lom_float light = lom_sample(c->map, s, t, lom_log2(lom_max(texels, one))).x;
    return lom_max(lom_mix(one, light, share), (lom_float){ 0 });
}

/* A surface, and the eye that sees it. */
struct facet {
    const struct lom_material_uniform *m;
    const struct lom_reflection_uniform *reflection;
    const struct lom_reflection_model *model;
    lom_float3 offset, normal, to_eye; /* to_eye: where it shines alone */
    lom_float exponent;
    bool shines;
};

static bool is_black(const float color[3])
{
    return color[0] == 0 && color[1] == 0 && color[2] == 0;
}

/* What is reflected of a light that comes from a unit vector, in parts of its colours. */
struct reflected {
    lom_float diffuse, specular;
};

static struct reflected reflect_light(const struct facet *f, lom_float3 to_light, lom_float share)
{
    struct reflected r = { f->model->diffuse(f->reflection, lom_dot3(f->normal, to_light)) * share, { 0 } };
    if (f->shines)
        r.specular = f->model->highlight(f->normal, to_light, f->to_eye, f->exponent) * share;
    return r;
}

static lom_float3 product(const float light[3], const float material[3], lom_float share)
{
    return lom_scale3(lom_mul3(lom_uniform3(light), lom_uniform3(material)), share);
}

static void dim_by_liquids(const struct lom_lamp_shadow_uniform *shadow, const struct lom_lamp_walk *walk,
                           struct lom_lit *lit)
{
    lom_float3 through;
    LOM_WIDE(lom_liquid_lamp)(shadow, &walk->place, &walk->normal, &through);
    lit->textured = lom_mul3(lit->textured, through);
    lit->highlight = lom_mul3(lit->highlight, through);
}

/* Adds what lamps give, in their order. */
static void add_lamps(const struct lom_light_uniform *light, const struct facet *f, struct lom_lit *lit)
{
    struct lom_lamp_walk walk = lom_walk_lamps(light, f->offset, f->normal);
    lom_float lamps = lom_listed_lamps(&walk);
    LOM_NAME_VALUE(lamps);
    for (const struct lom_lamp_uniform *lamp = lom_next_lamp(&walk); lamp != NULL; lamp = lom_next_lamp(&walk)) {
        lom_float3 to_lamp;
        lom_float share;
        if (!lom_lamp_share(&walk, lamp, &to_lamp, &share))
            continue;
        struct reflected r = reflect_light(f, to_lamp, share);
        lom_float3 textured =
            lom_add3(product(lamp->ambient, f->m->ambient, share), product(lamp->diffuse, f->m->diffuse, r.diffuse));
        struct lom_lit added = { textured, lom_splat3(0, 0, 0) };
        if (f->shines)
            added.highlight = product(lamp->specular, f->m->specular, r.specular);
        if (lamp->shadow != NULL && lamp->shadow->has_liquid)
            dim_by_liquids(lamp->shadow, &walk, &added);
        LOM_NAME_BY(lamp->name, added.textured);
        lit->textured = lom_add3(lit->textured, added.textured);
        if (f->shines)
            lit->highlight = lom_add3(lit->highlight, added.highlight);
    }
}

static struct lom_lit phong_light(const struct lom_view_uniform *view, const struct facet *f, lom_float sky)
{
    const struct lom_light_uniform *light = &view->light;
    const struct lom_material_uniform *m = f->m;
    const lom_float3 normal = f->normal;
    lom_float share = lom_light_share(light, f->offset);
    const lom_float cosine = lom_dot3(normal, lom_uniform3(light->to_light));
    lom_float facing = f->model->diffuse(f->reflection, cosine);
    /* A surface that looks away has no highlight either; a tone of 0 may have one, so it is not `facing` that decides. */
    const lom_mask seen = (cosine > 0.0f) & (share > 0.0f);
    if (view->entity_shadow.count != 0 && lom_any(seen)) {
        lom_float open;
        LOM_WIDE(lom_entity_light)(&view->entity_shadow, &f->offset, &normal, &open);
        share = lom_select(seen, share * open, share);
    }
    lom_float lambert = facing * share * caustic_light(view, f->offset);
    LOM_NAME_VALUE(normal);
    LOM_NAME_VALUE(facing);
    LOM_NAME_VALUE(share);
    LOM_NAME_VALUE(lambert);
    struct lom_lit lit;
    lom_float3 around = lom_mix3(lom_uniform3(light->ground), lom_uniform3(light->ambient), 0.5f + 0.5f * normal.y);
    lom_float3 ambient = lom_mul3(lom_scale3(around, sky), lom_uniform3(m->ambient));
    lom_float3 diffuse = product(light->color, m->diffuse, lambert), liquid_light = lom_splat3(1, 1, 1);
    const bool has_liquid = view->entity_shadow.liquid.map != NULL;
    if (has_liquid) {
        LOM_WIDE(lom_liquid_light)(&view->entity_shadow.liquid, &f->offset, &normal, &liquid_light);
        LOM_NAME_VALUE(liquid_light);
        diffuse = lom_mul3(diffuse, liquid_light);
    }
    LOM_NAME_VALUE(ambient);
    LOM_NAME_VALUE(diffuse);
    lit.textured = lom_add3(ambient, diffuse);
    lit.highlight = lom_splat3(0, 0, 0);
    if (f->shines) {
        lom_float specular = f->model->highlight(normal, lom_uniform3(light->to_light), f->to_eye, f->exponent) * share;
        lit.highlight = product(light->color, m->specular, specular);
        if (has_liquid)
            lit.highlight = lom_mul3(lit.highlight, liquid_light);
    }
    if (light->lamps != NULL)
        add_lamps(light, f, &lit);
    return lit;
}

void LOM_WIDE(lom_phong_light_lanes)(const struct lom_view_uniform *view, const struct lom_material_uniform *m,
                                     const lom_float3 *offset, const lom_float3 *normal, const lom_float *sky,
                                     const lom_float *exponent, struct lom_lit *lit)
{
    struct facet f = { .m = m,
                       .reflection = &view->reflection,
                       .model = &lom_reflection_models[view->reflection.model],
                       .offset = *offset,
                       .normal = *normal,
                       .exponent = exponent != NULL ? *exponent : lom_splat(m->shininess),
                       .shines = !is_black(m->specular) };
    if (f.shines)
        f.to_eye = lom_to_eye(&view->eye, *offset);
    *lit = phong_light(view, &f, *sky);
}
