/* A frame by the reference. In: a frame whose scene asks for it. Out: the picture by rays in double precision; no pass
 * of the pipeline is run. */
#include "render/frame.h"

lom_image *lom_draw_reference(struct frame *f, lom_error *error)
{
    const lom_quality *quality = &f->scene->quality;
    lom_step *step = lom_add_step(f, "reference", true, "rays in double precision, %d a pixel, depth %d at water",
                                  quality->reference.samples, quality->reference.depth);
    step->width = f->width;
    step->height = f->height;
    if (f->crop.width != f->width || f->crop.height != f->height)
        step->scissor = f->crop;
    lom_reference_frame desc = { .width = f->width,
                                 .height = f->height,
                                 .crop = f->crop,
                                 .time = f->time,
                                 .camera = &f->camera,
                                 .samples = quality->reference.samples,
                                 .depth = quality->reference.depth,
                                 .threads = lom_describe_device(f->renderer->device).threads };
    return lom_trace_scene(f->renderer->reference, &desc, error);
}
