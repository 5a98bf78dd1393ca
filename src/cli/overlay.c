/* `lom overlay`. In: a kind of overlay and a scene. Out: the numbers that the stages counted or held while they drew its
 * picture, in colours with a legend, or as floats. */
#include "commands.h"
#include "picture_kinds.h"
#include "scene_options.h"
#include "show_pass.h"

#include <lom/inspect.h>

#include <string.h>

struct values {
    struct lom_scene_options scene;
    const char *output, *format, *pass;
    lom_option_integers frame, run;
    lom_option_number low, high;
    bool no_legend;
};

static void print_kinds(FILE *out)
{
    const lom_overlay_kind *kind;
    fputs("\nKIND:\n", out);
    for (size_t i = 0; (kind = lom_describe_overlay(i)) != NULL; i++)
        fprintf(out, "  %-15s%s\n", kind->name, kind->text);
    lom_print_picture_kinds(out);
}

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "OUT", 0, 0, "the picture; required" },
    { "format", 0, LOM_OPTION_CHOICE, offsetof(struct values, format), NULL, 0, 0,
      "the kind of OUT, whatever the name ends in" },
    { "pass", 0, LOM_OPTION_TEXT, offsetof(struct values, pass), "PASS", 0, 0,
      "what is looked at: picture (when not given), reflection, refraction, spray" },
    { "low", 0, LOM_OPTION_NUMBER, offsetof(struct values, low), "X", -1e30, 1e30,
      "the lowest number of the scale; with --high" },
    { "high", 0, LOM_OPTION_NUMBER, offsetof(struct values, high), "X", -1e30, 1e30,
      "the highest number of the scale; with --low" },
    { "no-legend", 0, LOM_OPTION_FLAG, offsetof(struct values, no_legend), NULL, 0, 0,
      "the picture alone, without legend and scale" },
    { "frame", 0, LOM_OPTION_INTEGER, offsetof(struct values, frame), "N", 0, 1e9, "the frame, 0 when not given" },
    { "run", 0, LOM_OPTION_INTEGER, offsetof(struct values, run), "N", 0, 1e9,
      "draw so many frames before it, as in a run: plates of clouds age" },
    LOM_SCENE_OPTIONS(struct values),
};

static const lom_command_line line = {
    .name = "overlay",
    .arguments = "KIND SCENE -o OUT",
    .summary = "show what the stages did at each pixel: overdraw, mip levels, steps of rays",
    .choice = lom_picture_choice,
    .details = "A file of floats (npy, pfm, nrrd) gets the numbers, others the colours. docs/overlays.md shows them.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 2,
    .maximum_arguments = 2,
    .print_more = print_kinds,
};

/* What can be said before anything is drawn. */
static bool check(const struct values *v, const lom_overlay_kind *kind, lom_error *error)
{
    if (v->output == NULL)
        return lom_fail(error, LOM_ERROR_USAGE, "overlay needs -o OUT.");
    const lom_codec_info *codec = lom_find_codec(v->output, v->format);
    if (codec == NULL || !codec->writes || codec->is_video)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "%s: no kind of picture that can be written; `lom overlay --help` lists them.", v->output);
    if (v->low.given != v->high.given)
        return lom_fail(error, LOM_ERROR_USAGE, "A scale needs both of --low and --high.");
    if (v->low.given && v->low.value == v->high.value)
        return lom_fail(error, LOM_ERROR_USAGE, "A scale goes from a number to a greater one.");
    if (v->run.given && v->run.value[0] > lom_given_or(&v->frame, 0))
        return lom_fail(error, LOM_ERROR_USAGE,
                        "There are not so many frames before the frame: --run is at most --frame.");
    return kind != NULL;
}

/* The frames of the run before the one that is shown. */
static bool draw_run(lom_renderer *renderer, const struct values *v, int number, lom_error *error)
{
    int first = v->run.given ? number - (int)v->run.value[0] : number;
    for (int i = first; i < number; i++) {
        lom_frame_desc desc = lom_frame_of_options(&v->scene, i);
        lom_frame frame;
        if (!lom_render_frame(renderer, &desc, &frame, error))
            return false;
        lom_free_image(frame.image);
    }
    return true;
}

static bool draw(const lom_scene *scene, const struct values *v, const lom_overlay_kind *kind, lom_error *error)
{
    lom_device_desc device = lom_device_of_options(&v->scene);
    int number = (int)lom_given_or(&v->frame, 0);
    lom_overlay_desc desc = { .frame = lom_frame_of_options(&v->scene, number),
                              .kind = kind,
                              .pass = v->pass,
                              .low = v->low.value,
                              .high = v->high.value,
                              .legend = v->no_legend ? LOM_LEGEND_NONE : LOM_LEGEND_BELOW };
    lom_overlay overlay = { .numbers = NULL };
    if (!lom_check_frame(scene, &desc.frame, error))
        return false;
    lom_renderer *renderer = lom_create_renderer(scene, &device, error);
    bool done = renderer != NULL && draw_run(renderer, v, number, error) &&
                lom_draw_overlay(renderer, &desc, &overlay, error) &&
                lom_write_image(v->output, v->format,
                                lom_shows_numbers(v->output, v->format) ? overlay.numbers : overlay.shown, error);
    lom_free_overlay(&overlay);
    lom_free_renderer(renderer);
    return done;
}

int lom_command_overlay(int argc, char **argv)
{
    struct values values = { .output = NULL };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    const lom_overlay_kind *kind = lom_find_overlay(arguments.items[0], &error);
    if (kind == NULL || !check(&values, kind, &error))
        return lom_complain_error(&error);
    lom_scene *scene = lom_open_scene(arguments.items[1], &values.scene, &error);
    bool done = scene != NULL && draw(scene, &values, kind, &error);
    lom_free_scene(scene);
    return done ? LOM_EXIT_DONE : lom_complain_error(&error);
}
