/* The sky in a pass. In: the scene's sky. Out: its box and the sun's picture as textures, drawn where a pass shows
 * nothing else. */
#include "pipeline/check_device.h"
#include "render/renderer.h"
#include "sky/sky_draw.h"
#include "water/surface.h"

bool lom_load_sun(lom_renderer *renderer, lom_error *error)
{
    enum { SIZE = 256 };
    if (!renderer->scene->sky.sun)
        return true;
    lom_image *picture = lom_make_sun_picture(SIZE, renderer->scene->sky.sun_rays, error);
    if (picture != NULL)
        renderer->sky.sun = lom_make_texture(
            renderer->device, &(lom_texture_desc){ .width = SIZE,
                                                   .height = SIZE,
                                                   .format = LOM_FORMAT_R32F,
                                                   .pixels = picture->pixels,
                                                   .label = "sun",
                                                   .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } });
    lom_free_image(picture);
    return renderer->sky.sun != NULL;
}

bool lom_load_sky(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    if (!scene->sky.present || scene->sky.faces[0] == NULL)
        return true;
    lom_image *faces = lom_read_sky_faces(&scene->sky, renderer->world->files, error);
    if (faces != NULL)
        renderer->sky.box = lom_make_sky_texture(renderer->device, faces, scene->output.transfer == LOM_TRANSFER_SRGB);
    lom_free_image(faces);
    return renderer->sky.box != NULL && lom_check_device(renderer->device, error);
}

void lom_free_sky(lom_renderer *renderer)
{
    lom_release_texture(renderer->device, renderer->sky.box);
}

void lom_free_sun(lom_renderer *renderer)
{
    lom_release_texture(renderer->device, renderer->sky.sun);
}

void lom_draw_sky(lom_renderer *renderer, const struct lom_scene_view *view, const struct lom_light_uniform *light)
{
    const lom_sky_params *sky = &renderer->scene->sky;
    lom_draw_sky_box(renderer->device, sky, renderer->sky.box, light->to_light, &view->projection, &view->view);
    if (renderer->sky.sun != NULL && view->projection.m[3][2] != 0) /* parallel rays all see one place of the sky */
        lom_draw_sun(renderer->device, sky, renderer->sky.sun, light, &view->projection, &view->view);
}

void lom_set_sky(struct lom_sky_uniform *sky, const lom_renderer *renderer)
{
    const lom_sky_params *params = &renderer->scene->sky;
    sky->box = renderer->sky.box;
    sky->cosine = (float)lom_double_cos(-params->rotation);
    sky->sine = (float)lom_double_sin(-params->rotation);
    sky->size = renderer->sky.box != NULL ? (float)lom_texture_width(renderer->sky.box) : 0;
    sky->gradient = lom_sky_gradient_of(params, renderer->sky.box, lom_scene_light(renderer->scene).to_light);
    bool is_factor = renderer->sky.box != NULL || sky->gradient.on;
    for (int i = 0; i < 3; i++)
        sky->color[i] = (float)(params->intensity * (is_factor ? 1 : params->color[i]));
}
