/* `lom steps`. In: a scene and a folder. Out: in the folder a numbered picture of every stage of a pass and of every pass
 * of the frame, and a page that shows them one after the other. Invariant: the last picture is that of `lom render`; bad
 * input is found before anything is written. */
#include "commands.h"
#include "paths.h"
#include "progress.h"
#include "scene_options.h"
#include "steps_page.h"

#include <string.h>

struct values {
    struct lom_scene_options scene;
    const char *output, *pass;
    lom_option_integers frame;
    bool quiet;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "DIR", 0, 0,
      "the folder for the pictures and index.html; made when it is not there" },
    { "pass", 0, LOM_OPTION_TEXT, offsetof(struct values, pass), "NAME", 0, 0,
      "the pass whose stages are shown, \"scene\" when not given; another name's error lists them" },
    { "frame", 0, LOM_OPTION_INTEGER, offsetof(struct values, frame), "N", 0, 1e9, "the frame, 0 when not given" },
    { "quiet", 'q', LOM_OPTION_FLAG, offsetof(struct values, quiet), NULL, 0, 0, "no progress bar" },
    LOM_SCENE_OPTIONS(struct values),
};

static const lom_command_line line = {
    .name = "steps",
    .arguments = "SCENE",
    .summary = "draw a scene stage by stage: a numbered picture each, and a page with a slider",
    .details = "The frame has 320x180 pixels when --size is not given. Pictures are made of what the stages that draw\n"
               "record, so none shows what a second renderer would do. DIR/index.html needs no network and no other\n"
               "program: open it in a browser. docs/steps.md says what each picture shows.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

/* Pictures in files have 8 or 16 bits. */
static bool write_picture(const char *path, const lom_image *image, lom_error *error)
{
    if (!lom_describe_format(image->format)->is_float)
        return lom_write_image(path, "png", image, error);
    lom_image *shown = lom_convert_image(image, LOM_FORMAT_RGB8_SRGB, error);
    bool done = shown != NULL && lom_write_image(path, "png", shown, error);
    lom_free_image(shown);
    return done;
}

static bool write_all(const struct lom_steps_page *page, const char *folder, lom_error *error)
{
    bool done = true;
    for (size_t i = 0; done && i < page->pictures->count; i++) {
        char *path = lom_path_print(error, "%s/%02zu-%s.png", folder, i + 1, page->pictures->picture[i].name);
        done = path != NULL && lom_make_folders(path, strlen(folder), error) &&
               write_picture(path, page->pictures->picture[i].image, error);
        lom_release(path);
    }
    lom_bytes text = done ? lom_write_steps_page(page, error) : (lom_bytes){ NULL, 0 };
    char *path = text.data != NULL ? lom_path_print(error, "%s/index.html", folder) : NULL;
    done = path != NULL && lom_write_file(path, text.data, text.size, error);
    if (done)
        printf("%zu pictures of pass \"%s\" and of the frame: %s\n", page->pictures->count, page->pictures->pass, path);
    lom_release(text.data);
    lom_release(path);
    return done;
}

static bool move_bar(void *context, double done)
{
    lom_show_progress(context, 100 * done, "");
    return true;
}

static bool draw_steps(const struct values *v, const char *path, const lom_scene *scene, lom_error *error)
{
    lom_device_desc device = lom_device_of_options(&v->scene);
    int number = (int)lom_given_or(&v->frame, 0);
    lom_stages_desc desc = { .frame = lom_small_frame_of_options(&v->scene, number), .pass = v->pass };
    if (!lom_check_frame(scene, &desc.frame, error))
        return false;
    lom_renderer *renderer = lom_create_renderer(scene, &device, error);
    struct lom_progress bar = lom_begin_progress("lom steps", 100, v->quiet);
    desc.progress = move_bar;
    desc.progress_context = &bar;
    lom_stage_pictures *pictures = renderer != NULL ? lom_picture_stages(renderer, &desc, error) : NULL;
    lom_end_progress(&bar);
    lom_free_renderer(renderer);
    const struct lom_steps_page page = { .scene = lom_path_file(path), .frame = number, .pictures = pictures };
    bool done = pictures != NULL && write_all(&page, v->output, error);
    lom_free_stage_pictures(pictures);
    return done;
}

int lom_command_steps(int argc, char **argv)
{
    struct values values = { .output = NULL };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (values.output == NULL || values.output[0] == '\0')
        return lom_complain("steps takes the folder for its pictures: -o DIR.");
    if (values.scene.crop.given)
        return lom_complain("steps takes the whole frame, and no --crop.");
    lom_scene *scene = lom_open_scene(arguments.items[0], &values.scene, &error);
    bool done = scene != NULL && draw_steps(&values, arguments.items[0], scene, &error);
    lom_free_scene(scene);
    return done ? LOM_EXIT_DONE : lom_complain_error(&error);
}
