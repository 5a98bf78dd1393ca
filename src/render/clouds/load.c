/* The scene's clouds as the pipeline draws them. In: the scene's tables and dials. Out: the renderer's set of clouds.
 */
#include "render/renderer.h"

bool lom_load_clouds(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    const lom_quality *q = &scene->quality;
    struct lom_cloud_quality quality = { .model = q->clouds,
                                         .error = q->cloud_error,
                                         .stop = q->cloud_stop,
                                         .light_scale = q->cloud_light_scale,
                                         .octaves = q->cloud_octaves,
                                         .jitter = q->cloud_jitter,
                                         .filtering = q->filtering,
                                         .march = q->march };
    return lom_load_cloud_set(scene->cloud, scene->cloud_count, &scene->clouds, &quality, &renderer->clouds.set, error);
}

void lom_free_clouds(lom_renderer *renderer)
{
    lom_free_impostors(renderer);
    lom_free_cloud_set(renderer->clouds.set);
}
