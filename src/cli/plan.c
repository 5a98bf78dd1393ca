/* `lom plan`. In: a scene; out: the passes of one frame, why each is there, and what was left out. */
#include "commands.h"
#include "scene_options.h"

#include "measure/dials.h"

struct values {
    struct lom_scene_options scene;
    lom_option_integers frame;
};

static const lom_option options[] = {
    { "frame", 0, LOM_OPTION_INTEGER, offsetof(struct values, frame), "N", 0, 1e9, "the frame, 0 when not given" },
    LOM_SCENE_OPTIONS(struct values),
};

static const lom_command_line line = {
    .name = "plan",
    .arguments = "SCENE",
    .summary = "say which passes a scene needs, why, and what was left out",
    .details = "The frame is drawn to find out what is in view; nothing is written. Below the passes stand the dials: "
               "those that\n"
               "act in this scene with their settings, and why the others do nothing (docs/dials.md).",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

/* The steps of a view stand under its name. */
static void print_view(const lom_scene *scene, const lom_plan *plan, int i)
{
    const int view = plan->step[i].view;
    if (view != (i > 0 ? plan->step[i - 1].view : 0))
        printf("view \"%s\"%s\n", scene->views[view - 1].name, scene->views[view - 1].mirrored ? ", mirrored" : "");
}

static void print_plan(const lom_scene *scene, const lom_frame *frame)
{
    for (int i = 0; i < frame->plan.count; i++) {
        const lom_step *step = &frame->plan.step[i];
        print_view(scene, &frame->plan, i);
        if (!step->runs) {
            printf("-  %-11s left out: %s\n", step->name, step->text);
            continue;
        }
        printf("*  %-11s %s", step->name, step->text);
        if (step->width != 0)
            printf("; %dx%d", step->width, step->height);
        if (step->scissor.width != 0)
            printf(", of which %dx%d at %d,%d", step->scissor.width, step->scissor.height, step->scissor.x,
                   step->scissor.y);
        printf("\n");
    }
}

int lom_command_plan(int argc, char **argv)
{
    struct values values = { .frame = { .given = false } };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    lom_device_desc device = lom_device_of_options(&values.scene);
    lom_frame_desc desc = lom_frame_of_options(&values.scene, (int)lom_given_or(&values.frame, 0));
    lom_frame frame = { .image = NULL };
    lom_scene *scene = lom_open_scene(arguments.items[0], &values.scene, &error);
    bool drawable = scene != NULL && lom_check_frame(scene, &desc, &error);
    lom_renderer *renderer = drawable ? lom_create_renderer(scene, &device, &error) : NULL;
    bool done = renderer != NULL && lom_render_frame(renderer, &desc, &frame, &error);
    if (done) {
        print_plan(scene, &frame);
        lom_print_scene_dials(stdout, scene);
    }
    lom_free_image(frame.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done ? LOM_EXIT_DONE : lom_complain_error(&error);
}
