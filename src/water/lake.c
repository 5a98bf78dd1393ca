/* The lake as a draw. In: its parameters and the camera. Out: one draw of a quad, which is placed by a translation and
 * a scale of (1,0,0) (0,0,0) (1,0,1) (0,0,1). */
#include "water/lake.h"

/* Lookups are displaced, and highlights seen, in full from this many depths of the soft shore on. */
static const double clear_share = 10. / 3;

static void set_vector(float out[3], const double in[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (float)in[i];
}

static struct lom_lake_uniforms find_uniforms(const lom_water_params *water, const lom_lake_view *view)
{
    double moved = view->time * water->flow_speed;
    double x = (view->eye.x - water->position[0]) / water->tile, z = (view->eye.z - water->position[1]) / water->tile;

    struct lom_lake_uniforms u = { .light = view->light,
                                   .entity_shadow = view->entity_shadow,
                                   .clip_from_offset = view->clip_from_offset,
                                   .level = (float)(water->level - view->eye.y),
                                   .pixel = { 1.0f / (float)view->frame_width, 1.0f / (float)view->frame_height },
                                   .tile = (float)(1 / water->tile),
                                   .shift = { (float)(x - lom_double_floor(x)), (float)(z - lom_double_floor(z)) },
                                   .move = (float)(moved - lom_double_floor(moved)),
                                   .eye = view->rays,
                                   .flow_strength = (float)water->flow_strength,
                                   .normal_up = (float)water->normal_up,
                                   .reflectivity = (float)water->reflectivity,
                                   .fresnel_power = (float)water->fresnel_power,
                                   .shininess = (float)water->shininess,
                                   .specular_strength = (float)water->specular_strength,
                                   .tint_amount = (float)water->tint_amount,
                                   .shore_depth = (float)water->shore_depth,
                                   .inverse_clear = (float)(1 / (clear_share * water->shore_depth)),
                                   .opacity = (float)water->optics.opacity,
                                   .quad = { (float)(water->position[0] - water->size[0] / 2 - view->eye.x),
                                             (float)(water->position[1] - water->size[1] / 2 - view->eye.z),
                                             (float)water->size[0], (float)water->size[1] },
                                   .reflection = view->reflection,
                                   .refraction = view->refraction,
                                   .refraction_depth = view->refraction_depth,
                                   .normal_map = view->normal_map,
                                   .flow_map = view->flow_map,
                                   .has_reflection = view->reflection != NULL,
                                   .has_refraction = water->refraction && view->refraction != NULL,
                                   .has_projection = water->projection,
                                   .has_flow = water->flow && view->flow_map != NULL,
                                   .has_normals = water->normals && view->normal_map != NULL,
                                   .has_fresnel = water->fresnel,
                                   .has_specular = water->specular,
                                   .has_tint = water->tint,
                                   .has_soft_shore = water->soft_shore && view->refraction_depth != NULL };
    set_vector(u.color, water->color);
    set_vector(u.tint_color, water->tint_color);
    return u;
}

lom_draw_desc lom_lake_draw(const lom_shader *shader, const lom_water_params *water, const lom_lake_view *view,
                            struct lom_lake_uniforms *uniforms)
{
    *uniforms = find_uniforms(water, view);
    lom_blend over = { .enabled = true,
                       .source_color = LOM_FACTOR_SOURCE_ALPHA,
                       .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                       .target_alpha = LOM_FACTOR_ONE };
    lom_draw_desc draw = {
        .shader = shader, .uniforms = uniforms, .count = 4, .topology = LOM_TRIANGLE_STRIP, .depth_write_off = true
    };
    if (shader != &lom_lake_mask_shader)
        draw.blend[0] = over;
    return draw;
}
