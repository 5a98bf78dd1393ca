/* The size of a frame. In: what is asked for, the scene. Out: the whole frame and the part of it that is drawn, where they
 * and the frame's time lie within the limits. */
#include "render/frame.h"

#include "base/cpu.h"
#include "base/numbers.h"

/* The picture is read back with alpha as one image, and those have a limit. */
static bool check_picture(const struct frame *f, lom_error *error)
{
    uint64_t pixel = lom_has_float_targets(f->scene) ? 16 : 4;
    return (uint64_t)f->crop.width * (uint64_t)f->crop.height * pixel <= LOM_MAX_IMAGE_BYTES ||
           lom_fail(error, LOM_ERROR_LIMIT,
                    "A picture of %d x %d pixels, %d bytes each while it is drawn, is larger than the limit of 2^31 "
                    "bytes an image: draw it in parts, each a crop (--crop X,Y,W,H) of the whole frame.",
                    f->crop.width, f->crop.height, (int)pixel);
}

/* Of 16 MiB or less the machine is not asked: it has them, and asking costs several files a frame. */
static bool check_memory(const struct frame *f, lom_error *error)
{
    static const double gib = 1024.0 * 1024 * 1024, unasked = 0x1p-6;
    double taken = (double)lom_target_bytes(f->scene, f->width, f->height, f->crop.width, f->crop.height) / gib;
    if (taken <= unasked && !(f->desc->memory > 0))
        return true;
    double limit = f->desc->memory > 0 ? f->desc->memory : (double)lom_machine_memory() / gib;
    return limit == 0 || taken <= limit ||
           lom_fail(
               error, LOM_ERROR_LIMIT,
               "The targets of a frame of %d x %d pixels take %.3g GiB at least, more than the limit of %.3g GiB (%s): "
               "draw it smaller or in parts (--crop), lower quality.reflection_scale and refraction_scale, or "
               "raise the limit (--memory GIB).",
               f->width, f->height, taken, limit, f->desc->memory > 0 ? "as asked for" : "this machine's memory");
}

/* Beyond it, doubles no longer hold a time to a ten-millionth of a second. */
static bool check_time(const struct frame *f, lom_error *error)
{
    static const double most = 1e9;
    double fps = f->scene->output.fps, time = f->desc->has_time ? f->desc->time : f->desc->frame / fps;
    if (f->desc->has_time && !(time >= -most && time <= most))
        return lom_fail(error, LOM_ERROR_LIMIT, "A time of %g seconds is not within 1e9 of the first frame.", time);
    return (time >= -most && time <= most) ||
           lom_fail(error, LOM_ERROR_LIMIT,
                    "Frame %d is not within 1e9 seconds of the first at %g a second (output.fps).", f->desc->frame,
                    fps);
}

size_t lom_pixel_bytes(const lom_scene *scene, lom_pixel_order order)
{
    static const size_t sample[] = { [LOM_OUTPUT_RGB8] = 1, [LOM_OUTPUT_RGB16] = 2, [LOM_OUTPUT_RGB32F] = 4 };
    return order == LOM_ORDER_OUTPUT ? 3 * sample[scene->output.format] : 4;
}

static bool check_pixels(const struct frame *f, lom_error *error)
{
    const lom_frame_desc *desc = f->desc;
    if (desc->pixels == NULL)
        return true;
    if (desc->order != LOM_ORDER_OUTPUT && f->scene->output.format != LOM_OUTPUT_RGB8)
        return lom_fail(error, LOM_ERROR_USAGE, "Pixels of 4 bytes are for output.format \"rgb8\" alone.");
    const size_t pixel = lom_pixel_bytes(f->scene, desc->order);
    return desc->pitch >= pixel * (size_t)f->crop.width ||
           lom_fail(error, LOM_ERROR_USAGE, "Rows %zu bytes apart do not hold %d pixels of %zu bytes.", desc->pitch,
                    f->crop.width, pixel);
}

/* What a scene's camera is checked for when it is read. */
static bool check_camera(const struct frame *f, lom_error *error)
{
    const lom_camera_view *c = f->desc->camera;
    if (c == NULL)
        return true;
    const lom_vec3 ahead = lom_vec3_subtract(c->target, c->position);
    const double most = 1e12, wide = lom_vec3_length(lom_vec3_cross(ahead, c->up));
    const double numbers[9] = { c->position.x, c->position.y, c->position.z, c->target.x, c->target.y,
                                c->target.z,   c->up.x,       c->up.y,       c->up.z };
    bool good = wide > 0 && c->near_plane > 0 && c->near_plane < most;
    if (c->projection == LOM_PROJECTION_PERSPECTIVE)
        good = good && c->field_of_view > 1e-6 && c->field_of_view < lom_pi;
    else
        good = good && c->height > 1e-6 && c->height < most && c->far_plane > c->near_plane && c->far_plane < most &&
               lom_magnitude(c->shear[0]) < 1e6 && lom_magnitude(c->shear[1]) < 1e6;
    for (int i = 0; i < 9; i++)
        good = good && numbers[i] > -most && numbers[i] < most;
    return good ||
           lom_fail(
               error, LOM_ERROR_USAGE,
               "A camera needs a target apart from its position, an up that is not along the line between "
               "them, an angle of view between 0 and 180 degrees or a height, and a near plane before it, which is "
               "before the far plane of a parallel projection.");
}

bool lom_find_frame_sizes(struct frame *f, lom_error *error)
{
    const lom_frame_desc *desc = f->desc;
    f->width = desc->width != 0 ? desc->width : f->scene->output.width;
    f->height = desc->height != 0 ? desc->height : f->scene->output.height;
    if (!lom_find_view(f->scene, desc->view, &f->shown, error))
        return false;
    if (f->shown != NULL && f->width > 0 && f->height > 0 && f->width <= LOM_MAX_SIZE && f->height <= LOM_MAX_SIZE) {
        const lom_rect rectangle = lom_view_rectangle(f->shown, f->width, f->height);
        f->width = rectangle.width;
        f->height = rectangle.height;
    }
    f->crop = desc->crop.width != 0 ? desc->crop : (lom_rect){ 0, 0, f->width, f->height };
    if (f->width < 1 || f->height < 1 || f->width > LOM_MAX_SIZE || f->height > LOM_MAX_SIZE || f->crop.x < 0 ||
        f->crop.y < 0 || f->crop.width < 1 || f->crop.height < 1 || f->crop.x > f->width - f->crop.width ||
        f->crop.y > f->height - f->crop.height)
        return lom_fail(error, LOM_ERROR_USAGE, "The crop %d,%d,%d,%d does not lie inside the frame of %dx%d pixels.",
                        f->crop.x, f->crop.y, f->crop.width, f->crop.height, f->width, f->height);
    if (f->shown != NULL && f->shown->mirrored) /* the part that is drawn before it is mirrored */
        f->crop.x = f->width - f->crop.x - f->crop.width;
    return check_time(f, error) && check_camera(f, error) && check_pixels(f, error) && check_picture(f, error) &&
           check_memory(f, error);
}
