/* What is seen at each pixel: its normal, which object it is, how far it has moved. In: a frame, drawn again while it is
 * tallied; for motion in strips while every pixel of the strip is watched. Out: a picture of numbers. Invariant: a pixel
 * shows the last triangle that is stored there and belongs to an object: what was drawn, not what a second renderer
 * would. */
#include "inspect/overlay.h"
#include "inspect/show.h"
#include "pipeline/check_device.h"
#include "render/frame.h"

#include <string.h>

enum { STRIP = 8192 }; /* pixels that are watched at a time */

struct seen {
    lom_renderer *renderer;
    const struct lom_moment *before; /* of the frame before */
    const lom_triangle_record *triangle;
    lom_vec3 eye;
    int width, height, x, y; /* of the frame; the pixel */
};

typedef void telling(const struct seen *seen, float *value);

static const lom_triangle_record *find_object(const lom_pixel_record *pixel)
{
    const lom_triangle_record *last = NULL;
    for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                if (draw->desc.object != 0 && (t->fate == LOM_FATE_STORED || t->fate == LOM_FATE_BLENDED_OVER))
                    last = t;
    return last;
}

/* A place of an entity as it was in the frame before. */
static lom_vec3 place_before(const struct seen *seen, lom_vec3 place)
{
    int object = seen->triangle->draw->desc.object;
    lom_mat4 model_from_world;
    if (object < LOM_OBJECT_ENTITY ||
        !lom_invert(&seen->renderer->moment.placements[object - LOM_OBJECT_ENTITY].world_from_model, &model_from_world))
        return place;
    return lom_transform_point(&seen->before->placements[object - LOM_OBJECT_ENTITY].world_from_model,
                               lom_transform_point(&model_from_world, place));
}

/* The first three varyings of the shaders of terrain, entities and water are the place less the eye. */
static void tell_motion(const struct seen *seen, float *value)
{
    const lom_camera_view *camera = &seen->before->camera;
    const float *offset = seen->triangle->fragment.varying;
    if ((seen->triangle->draw->desc.shader->reads & 7) != 7)
        return;
    lom_vec3 place = { seen->eye.x + (double)offset[0], seen->eye.y + (double)offset[1],
                       seen->eye.z + (double)offset[2] };
    lom_vec3 p = place_before(seen, place);
    lom_mat4 projection =
        lom_perspective(camera->field_of_view, (double)seen->width / seen->height, camera->near_plane);
    lom_mat4 view = lom_look_at(camera->position, camera->target, camera->up);
    lom_mat4 clip = lom_multiply(&projection, &view);
    double at[4];
    for (int i = 0; i < 4; i++)
        at[i] = clip.m[i][0] * p.x + clip.m[i][1] * p.y + clip.m[i][2] * p.z + clip.m[i][3];
    if (!(at[3] > 0))
        return;
    value[0] = (float)(seen->x + 0.5 - (at[0] / at[3] + 1) / 2 * seen->width);
    value[1] = (float)(seen->y + 0.5 - (1 - at[1] / at[3]) / 2 * seen->height);
}

static bool fill_strip(struct seen *seen, const lom_explain_desc *desc, lom_rect crop, telling *tell, lom_image *image,
                       lom_error *error)
{
    lom_renderer *r = seen->renderer;
    lom_explanation *x = lom_explain(r, desc, error);
    for (int i = 0; x != NULL && i < desc->width * desc->height; i++) {
        seen->x = desc->x + i % desc->width;
        seen->y = desc->y + i / desc->width;
        seen->triangle = find_object(lom_watched_pixel(r->device, 0, i % desc->width, i / desc->width));
        seen->eye = x->item[0].eye;
        if (seen->triangle != NULL)
            tell(seen, lom_image_pixel(image, seen->x - crop.x, seen->y - crop.y, 0));
    }
    lom_free_explanation(r, x);
    return x != NULL;
}

static lom_image *fill(lom_renderer *r, const lom_frame_desc *desc, lom_format format, telling *tell, lom_error *error)
{
    struct lom_moment before = { .time = 0 };
    struct frame f = { .renderer = r, .scene = r->scene, .desc = desc };
    struct seen seen = { .renderer = r, .before = &before };
    bool done = lom_find_frame_sizes(&f, error);
    int number = desc->frame > 0 ? desc->frame - 1 : 0;
    seen.width = f.width;
    seen.height = f.height;
    done = done && lom_world_at(r->world, number / r->scene->output.fps, &before, error);
    lom_image *image = done ? lom_create_image(f.crop.width, f.crop.height, 1, format, error) : NULL;
    int rows = STRIP / (image != NULL ? f.crop.width : 1);
    rows = rows < 1 ? 1 : rows;
    for (int y = 0; image != NULL && y < f.crop.height; y += rows) {
        const lom_explain_desc strip = { .frame = *desc,
                                         .x = f.crop.x,
                                         .y = f.crop.y + y,
                                         .width = f.crop.width,
                                         .height = f.crop.height - y < rows ? f.crop.height - y : rows };
        if (!fill_strip(&seen, &strip, f.crop, tell, image, error)) {
            lom_free_image(image);
            image = NULL;
        }
    }
    lom_free_moment(&before);
    return image;
}

typedef void telling_tally(const lom_tally *tally, float *value);

static void tell_normal(const lom_tally *tally, float *value)
{
    if (tally->named_components == 3)
        memcpy(value, tally->named, 3 * sizeof *value);
}

static void tell_object(const lom_tally *tally, float *value)
{
    *value = (float)tally->object;
}

static lom_image *show_tallied(lom_renderer *r, const lom_frame_desc *desc, const char *named, lom_format format,
                               telling_tally *tell, lom_error *error)
{
    lom_frame frame = { .image = NULL };
    bool drawn = lom_draw_tallied(r, desc, (lom_tally_desc){ .named = named }, LOM_TARGET_COLOR, &frame, error);
    lom_image *image =
        drawn ? lom_create_image(r->targets.drawn_width, r->targets.drawn_height, 1, format, error) : NULL;
    for (int y = 0; image != NULL && y < image->height; y++)
        for (int x = 0; x < image->width; x++)
            tell(lom_tallied(r->device, x, y), lom_image_pixel(image, x, y, 0));
    lom_tally_target(r->device, NULL);
    lom_free_image(frame.image);
    return image;
}

lom_image *lom_show_normals(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    return show_tallied(r, desc, "normal", LOM_FORMAT_RGB32F, tell_normal, error);
}

lom_image *lom_show_objects(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    return show_tallied(r, desc, NULL, LOM_FORMAT_R32F, tell_object, error);
}

lom_image *lom_show_motion(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    return fill(r, desc, LOM_FORMAT_RGB32F, tell_motion, error);
}
