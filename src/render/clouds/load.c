/* The scene's clouds as the pipeline draws them. In: the scene's tables and dials. Out: the renderer's set of clouds.
 */
#include "render/renderer.h"

static struct lom_cloud_quality quality_of(const lom_quality *q)
{
    return (struct lom_cloud_quality){ .model = q->clouds,
                                       .error = q->cloud_error,
                                       .stop = q->cloud_stop,
                                       .light_scale = q->cloud_light_scale,
                                       .octaves = q->cloud_octaves,
                                       .jitter = q->cloud_jitter,
                                       .filtering = q->filtering,
                                       .march = q->march };
}

bool lom_load_clouds(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    const struct lom_cloud_quality quality = quality_of(&scene->quality);
    const struct lom_cloud_set *before = renderer->before != NULL ? renderer->before->clouds.set : NULL;
    return lom_load_cloud_set(scene->cloud, scene->cloud_count, &scene->clouds, &quality, before, renderer->device,
                              &renderer->clouds.set, error);
}

void lom_free_clouds(lom_renderer *renderer)
{
    lom_free_impostors(renderer);
    lom_free_cloud_set(renderer->clouds.set);
    lom_release_texture(renderer->device, renderer->clouds.ground_shadow.texture);
}

void lom_drop_cloud_light(lom_renderer *renderer)
{
    struct lom_cloud_set *set = renderer->clouds.set;
    for (size_t i = 0; set != NULL && i < set->count; i++)
        set->clouds[i].lit_for = 0;
    renderer->clouds.ground_shadow.made_for = 0;
}

void lom_follow_clouds(lom_renderer *renderer, const lom_scene *before, const lom_scene *scene)
{
    struct lom_cloud_set *set = renderer->clouds.set;
    if (set == NULL)
        return;
    set->quality = quality_of(&scene->quality);
    for (size_t i = 0; i < set->count; i++)
        set->clouds[i].cloud = scene->cloud + (set->clouds[i].cloud - before->cloud);
    for (size_t i = 0; i < set->density_count; i++)
        set->densities[i].source = scene->cloud + (set->densities[i].source - before->cloud);
}
