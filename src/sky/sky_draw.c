/* The sky as a draw. In: the sky's parameters and the camera. Out: one draw, after everything opaque. */
#include "pipeline/check_device.h"
#include "sky/sky_draw.h"
#include "sky/sky_uniforms.h"

#include <string.h>

lom_texture *lom_make_sky_texture(lom_device *device, const lom_image *faces, bool srgb)
{
    return lom_make_texture(device, &(lom_texture_desc){ .kind = LOM_TEXTURE_CUBE,
                                                         .width = faces->width,
                                                         .height = faces->height,
                                                         .format = srgb ? LOM_FORMAT_RGBA8_SRGB : LOM_FORMAT_RGBA8,
                                                         .pixels = faces->pixels,
                                                         .label = "sky box",
                                                         .mips = LOM_MIPS_ALL });
}

/* The rays' directions, which the sky's own rotation about y turns back; parallel ones all see the same place of it. */
static void find_direction(const lom_sky_params *sky, const lom_mat4 *projection, const lom_mat4 *view, float out[3][3])
{
    const lom_view_rays rays = lom_find_view_rays(projection, view);
    double world[3][3] = { { 0, 0, rays.along.x }, { 0, 0, rays.along.y }, { 0, 0, rays.along.z } };
    for (int i = 0; i < 3 && !rays.parallel; i++)
        for (int k = 0; k < 3; k++)
            world[i][k] = rays.row[i][k];
    double s = lom_double_sin(-sky->rotation), c = lom_double_cos(-sky->rotation);
    for (int k = 0; k < 3; k++) {
        out[0][k] = (float)(c * world[0][k] + s * world[2][k]);
        out[1][k] = (float)world[1][k];
        out[2][k] = (float)(-s * world[0][k] + c * world[2][k]);
    }
}

struct lom_gradient_uniform lom_sky_gradient_of(const lom_sky_params *sky, const lom_texture *box,
                                                const float to_light[3])
{
    struct lom_gradient_uniform u = { .on = sky->gradient && box == NULL,
                                      .inverse_haze = (float)(1 / (sky->haze_height > 0 ? sky->haze_height : 1)) };
    for (int i = 0; i < 3; i++) {
        u.zenith[i] = (float)sky->zenith[i];
        u.horizon[i] = (float)sky->horizon[i];
        u.haze[i] = (float)sky->haze[i];
        u.glow[i] = (float)sky->glow[i];
        u.to_light[i] = to_light[i];
    }
    return u;
}

void lom_draw_sky_box(lom_device *device, const lom_sky_params *sky, const lom_texture *box, const float to_light[3],
                      const lom_mat4 *projection, const lom_mat4 *view)
{
    static const float corners[3][2] = { { -1, -1 }, { 3, -1 }, { -1, 3 } };
    struct lom_sky_uniforms uniforms = { .box = box, .gradient = lom_sky_gradient_of(sky, box, to_light) };
    find_direction(sky, projection, view, uniforms.direction);
    for (int i = 0; i < 3; i++)
        uniforms.color[i] = (float)(sky->intensity * (box != NULL || uniforms.gradient.on ? 1 : sky->color[i]));
    lom_draw(device, &(lom_draw_desc){ .shader = box != NULL            ? &lom_sky_box_shader
                                                 : uniforms.gradient.on ? &lom_sky_gradient_shader
                                                                        : &lom_sky_color_shader,
                                       .uniforms = &uniforms,
                                       .attribute = { { corners, sizeof corners, 8, LOM_ATTRIBUTE_FLOAT2 } },
                                       .count = 3,
                                       .depth_compare = LOM_COMPARE_EQUAL,
                                       .depth_write_off = true });
}

void lom_draw_sun(lom_device *device, const lom_sky_params *sky, const lom_texture *picture,
                  const struct lom_light_uniform *light, const lom_mat4 *projection, const lom_mat4 *view)
{
    struct lom_sun_uniforms u = { .picture = picture };
    lom_mat4 clip = lom_multiply(projection, view);
    lom_vec3 to = { (double)light->to_light[0], (double)light->to_light[1], (double)light->to_light[2] };
    lom_mat4 look = lom_look_at((lom_vec3){ 0, 0, 0 }, to, (lom_vec3){ 0, 1, 0 });
    double half = lom_double_sin(sky->sun_size / 2) / lom_double_cos(sky->sun_size / 2);
    u.clip_from_direction = lom_round_matrix(&clip);
    for (int c = 0; c < 4; c++)
        for (int k = 0; k < 3; k++)
            u.corner[c][k] =
                (float)((c & 1 ? half : -half) * look.m[0][k] + (c >> 1 ? half : -half) * look.m[1][k] - look.m[2][k]);
    for (int i = 0; i < 3; i++)
        u.color[i] = light->color[i];
    lom_draw(device, &(lom_draw_desc){ .shader = &lom_sun_shader,
                                       .uniforms = &u,
                                       .count = 4,
                                       .vertex_count = 4,
                                       .topology = LOM_TRIANGLE_STRIP,
                                       .depth_compare = LOM_COMPARE_EQUAL,
                                       .depth_write_off = true,
                                       .blend = { { .enabled = true,
                                                    .source_color = LOM_FACTOR_ONE,
                                                    .target_color = LOM_FACTOR_ONE,
                                                    .source_alpha = LOM_FACTOR_ZERO,
                                                    .target_alpha = LOM_FACTOR_ONE } } });
}
