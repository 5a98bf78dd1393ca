/* `lom view`. In: a scene. Out: a window that shows it, and takes keys and the mouse; or the answers of a script. */
#include "commands.h"
#include "view_window.h"

#include <string.h>

struct values {
    struct lom_scene_options scene;
    const char *script;
    bool no_window, times;
};

static const lom_option options[] = {
    { "script", 0, LOM_OPTION_TEXT, offsetof(struct values, script), "FILE", 0, 0,
      "events and questions from a file, by a clock that counts frames; - is stdin" },
    { "no-window", 0, LOM_OPTION_FLAG, offsetof(struct values, no_window), NULL, 0, 0,
      "play the script without a window" },
    { "times", 0, LOM_OPTION_FLAG, offsetof(struct values, times), NULL, 0, 0,
      "say at the end how long drawing and showing took" },
    LOM_SCENE_OPTIONS(struct values),
};

static void print_more(FILE *out)
{
    const char *keys, *text;
    fputs("\nkeys and mouse:\n", out);
    for (size_t i = 0; lom_describe_view_key(i, &keys, &text); i++)
        fprintf(out, "  %-14s%s\n", keys, text);
    lom_print_script_help(out);
}

static const lom_command_line line = {
    .name = "view",
    .arguments = "SCENE",
    .summary = "show a scene in a window, fly through it, change it",
    .details = "What is shown at rest is the picture of `lom render`; docs/view.md says more. The window is\n"
               "SDL2's, which is looked for when it opens; --no-window works without.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
    .print_more = print_more,
};

static bool play(struct lom_view *view, struct lom_script *script, lom_error *error)
{
    bool done = true;
    while (done && !view->ends)
        done = lom_play_script(script, view, error);
    return done;
}

static bool show(const struct values *v, const char *path, lom_error *error)
{
    if (!v->no_window && !lom_check_window(error))
        return false;
    struct lom_script *script = v->script != NULL ? lom_read_script(v->script, error) : NULL;
    if (v->script != NULL && script == NULL)
        return false;
    struct lom_view_host host = { .order = LOM_ORDER_BGRX, .is_patient = script != NULL };
    struct lom_view *view = lom_open_view(path, &v->scene, &host, error);
    bool done =
        view != NULL && (v->no_window ? play(view, script, error) : lom_show_window(view, script, v->times, error));
    lom_close_view(view);
    lom_free_script(script);
    return done;
}

int lom_command_view(int argc, char **argv)
{
    struct values values = { .script = NULL };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (values.scene.crop.given)
        return lom_complain("view shows the whole frame, and takes no --crop.");
    if (strcmp(arguments.items[0], "-") == 0)
        return lom_complain("view reads its scene again and again, which standard input does not allow.");
    if (values.no_window && values.script == NULL)
        return lom_complain("view without a window wants a --script.");
    return show(&values, arguments.items[0], &error) ? LOM_EXIT_DONE : lom_complain_error(&error);
}
