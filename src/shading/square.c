/* A square over what is drawn. In: a shader and its uniforms. Out: one draw of four vertices, numbered 0 to 3 in a
 * strip, from which the shader's vertex function places them. */
#include "shading/square.h"

const lom_blend lom_blend_over = { .enabled = true,
                                   .source_color = LOM_FACTOR_ONE,
                                   .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                   .source_alpha = LOM_FACTOR_ONE,
                                   .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };

void lom_draw_square(lom_device *device, const lom_shader *shader, const void *uniforms, const lom_blend *blend)
{
    lom_draw(device, &(lom_draw_desc){ .shader = shader,
                                       .uniforms = uniforms,
                                       .count = 4,
                                       .vertex_count = 4,
                                       .topology = LOM_TRIANGLE_STRIP,
                                       .depth_test_off = true,
                                       .blend = { *blend } });
}
