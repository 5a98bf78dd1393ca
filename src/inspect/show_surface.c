/* What is seen at each pixel: its normal, which object it is, how far it has moved. In: a frame, drawn again while it is
 * tallied. Out: a picture of numbers. Invariant: a pixel shows the last triangle that is stored there and belongs to an
 * object: what was drawn, not what a second renderer would. */
#include "inspect/overlay.h"
#include "inspect/show.h"
#include "pipeline/check_device.h"
#include "render/frame.h"

#include <string.h>

/* What the pixels of a picture share. */
struct seen {
    const lom_renderer *renderer;
    const struct lom_moment *before; /* of the frame before */
    lom_mat4 clip_before;            /* clip space of the frame before, from the world */
    lom_vec3 eye;
    int width, height; /* of the frame */
    lom_rect crop;
};

typedef void telling(const struct seen *seen, const lom_tally *tally, int x, int y, float *value);

static void tell_normal(const struct seen *seen, const lom_tally *tally, int x, int y, float *value)
{
    (void)seen, (void)x, (void)y;
    if (tally->named_components == 3)
        memcpy(value, tally->named, 3 * sizeof *value);
}

static void tell_object(const struct seen *seen, const lom_tally *tally, int x, int y, float *value)
{
    (void)seen, (void)x, (void)y;
    *value = (float)tally->object;
}

/* A place of an object as it was in the frame before. */
static lom_vec3 place_before(const struct seen *seen, int object, lom_vec3 place)
{
    lom_mat4 model_from_world;
    if (object < LOM_OBJECT_ENTITY ||
        !lom_invert(&seen->renderer->moment.placements[object - LOM_OBJECT_ENTITY].world_from_model, &model_from_world))
        return place;
    return lom_transform_point(&seen->before->placements[object - LOM_OBJECT_ENTITY].world_from_model,
                               lom_transform_point(&model_from_world, place));
}

/* The first three varyings of the shaders of terrain, entities and water are the place less the eye. */
static void tell_motion(const struct seen *seen, const lom_tally *tally, int x, int y, float *value)
{
    const float *offset = tally->varying;
    if (tally->object == 0 || !tally->has_varyings)
        return;
    lom_vec3 place = { seen->eye.x + (double)offset[0], seen->eye.y + (double)offset[1],
                       seen->eye.z + (double)offset[2] };
    lom_vec3 p = place_before(seen, tally->object, place);
    double at[4];
    for (int i = 0; i < 4; i++) {
        const double *row = seen->clip_before.m[i];
        at[i] = row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
    }
    if (!(at[3] > 0))
        return;
    value[0] = (float)(x + 0.5 - (at[0] / at[3] + 1) / 2 * seen->width);
    value[1] = (float)(y + 0.5 - (1 - at[1] / at[3]) / 2 * seen->height);
}

static lom_image *show_tallied(struct seen *seen, lom_renderer *r, const lom_frame_desc *desc, const char *named,
                               lom_format format, telling *tell, lom_error *error)
{
    lom_frame frame = { .image = NULL };
    bool drawn = lom_draw_tallied(r, desc, (lom_tally_desc){ .named = named }, LOM_TARGET_COLOR, &frame, error);
    lom_image *image =
        drawn ? lom_create_image(r->targets.drawn_width, r->targets.drawn_height, 1, format, error) : NULL;
    seen->renderer = r;
    seen->eye = lom_camera_eye(&r->moment.camera); /* of the frame that was drawn */
    for (int y = 0; image != NULL && y < image->height; y++)
        for (int x = 0; x < image->width; x++)
            tell(seen, lom_tallied(r->device, x, y), seen->crop.x + x, seen->crop.y + y,
                 lom_image_pixel(image, x, y, 0));
    lom_tally_target(r->device, NULL);
    lom_free_image(frame.image);
    return image;
}

lom_image *lom_show_normals(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    return show_tallied(&(struct seen){ .before = NULL }, r, desc, "normal", LOM_FORMAT_RGB32F, tell_normal, error);
}

lom_image *lom_show_objects(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    return show_tallied(&(struct seen){ .before = NULL }, r, desc, NULL, LOM_FORMAT_R32F, tell_object, error);
}

lom_image *lom_show_motion(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    struct lom_moment before = { .time = 0 };
    struct frame f = { .renderer = r, .scene = r->scene, .desc = desc };
    int number = desc->frame > 0 ? desc->frame - 1 : 0;
    if (!lom_find_frame_sizes(&f, error) || !lom_world_at(r->world, number / r->scene->output.fps, &before, error))
        return NULL;
    if (f.shown != NULL)
        before.camera = lom_scene_view_camera_at(&before.scene, f.shown, number / r->scene->output.fps);
    struct seen seen = { .before = &before, .width = f.width, .height = f.height, .crop = f.crop };
    lom_mat4 projection = lom_camera_projection(&before.camera, (double)f.width / f.height);
    lom_mat4 view = lom_camera_look(&before.camera);
    seen.clip_before = lom_multiply(&projection, &view);
    lom_image *image = show_tallied(&seen, r, desc, NULL, LOM_FORMAT_RGB32F, tell_motion, error);
    lom_free_moment(&before);
    return image;
}
