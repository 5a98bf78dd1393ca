/* `lom explain`. In: a scene and a pixel. Out: who wrote the pixel and all that it went through, as text, as JSON or as a
 * page to click through. Invariant: the colour that it ends with is that of `lom render`. */
#include "commands.h"
#include "explain_output.h"
#include "scene_options.h"

#include <lom/inspect.h>

#include <string.h>

struct values {
    struct lom_scene_options scene;
    const char *output;
    lom_option_integers frame, follow;
    bool json;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "OUT.html", 0, 0,
      "write a page: the picture to zoom into, triangles over it, steps to click" },
    { "json", 0, LOM_OPTION_FLAG, offsetof(struct values, json), NULL, 0, 0, "print one JSON object instead of text" },
    { "follow", 0, LOM_OPTION_INTEGER, offsetof(struct values, follow), "N", 0, LOM_MAX_FOLLOW,
      "how many pictures deep lookups are followed, 3 when not given" },
    { "frame", 0, LOM_OPTION_INTEGER, offsetof(struct values, frame), "N", 0, 1e9, "the frame, 0 when not given" },
    LOM_SCENE_OPTIONS(struct values),
};

static const lom_command_line line = {
    .name = "explain",
    .arguments = "SCENE X,Y",
    .summary = "say what made a pixel: every triangle that touched it, every number on its way",
    .details =
        "X,Y is a pixel of the whole frame, 0,0 the one at the top left. The first line is the verdict; then every\n"
        "draw and triangle that touched the pixel, in order; then the same for the texels of mirrors, refractions,\n"
        "shadow maps and plates of clouds that its shaders read. docs/explain.md reads one with you.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 2,
    .maximum_arguments = 2,
};

/* "X,Y" */
static bool read_pixel(const char *text, int *x, int *y)
{
    char rest;
    return strspn(text, "0123456789,-") == strlen(text) && strlen(text) < 20 &&
           sscanf(text, "%d,%d%c", x, y, &rest) == 2;
}

static bool write_page(const char *path, const struct lom_explain_head *head, const lom_image *picture,
                       lom_error *error)
{
    lom_bytes page = lom_explanation_page(head, picture, error);
    bool done = page.data != NULL && lom_write_file(path, page.data, page.size, error);
    lom_release(page.data);
    return done;
}

/* The page shows the picture of the whole frame. */
static bool give_output(const struct values *v, const struct lom_explain_head *head, const lom_image *picture,
                        lom_error *error)
{
    if (v->output != NULL && !write_page(v->output, head, picture, error))
        return false;
    if (v->json)
        lom_write_explanation(stdout, head);
    else if (v->output == NULL)
        lom_print_explanation(stdout, head);
    else
        printf("%s\n", head->explanation->item[0].verdict);
    return true;
}

/* The view that shows the pixel is explained, and shown. */
static void choose_view(lom_explain_desc *desc, const lom_scene *scene)
{
    const int width = desc->frame.width != 0 ? desc->frame.width : scene->output.width;
    const int height = desc->frame.height != 0 ? desc->frame.height : scene->output.height;
    if (desc->frame.view != NULL || scene->view_count == 0)
        return;
    const lom_picture_view *view = lom_view_at(scene, width, height, desc->x, desc->y);
    desc->frame.view = view != NULL ? view->name : LOM_MAIN_VIEW;
    if (view != NULL) {
        const lom_rect r = lom_view_rectangle(view, width, height);
        desc->x -= r.x;
        desc->y -= r.y;
    }
}

static bool explain(const struct values *v, const char *path, const lom_scene *scene, int x, int y, lom_error *error)
{
    lom_device_desc device = lom_device_of_options(&v->scene);
    int number = (int)lom_given_or(&v->frame, 0);
    lom_explain_desc desc = { .frame = lom_frame_of_options(&v->scene, number),
                              .x = x,
                              .y = y,
                              .follow = v->follow.given ? (int)v->follow.value[0] : 3 };
    lom_frame whole = { .image = NULL };
    if (!lom_check_frame(scene, &desc.frame, error))
        return false;
    choose_view(&desc, scene);
    lom_renderer *renderer = lom_create_renderer(scene, &device, error);
    bool done = renderer != NULL && (v->output == NULL || lom_render_frame(renderer, &desc.frame, &whole, error));
    lom_explanation *explanation = done ? lom_explain(renderer, &desc, error) : NULL;
    done = explanation != NULL &&
           give_output(v, &(struct lom_explain_head){ path, number, explanation }, whole.image, error);
    lom_free_image(whole.image);
    if (renderer != NULL)
        lom_free_explanation(renderer, explanation);
    lom_free_renderer(renderer);
    return done;
}

int lom_command_explain(int argc, char **argv)
{
    struct values values = { .output = NULL };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status, x, y;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (!read_pixel(arguments.items[1], &x, &y))
        return lom_complain("explain takes a pixel as X,Y, like 320,180, not \"%s\".", arguments.items[1]);
    if (values.scene.crop.given)
        return lom_complain("explain takes one pixel of the whole frame, and no --crop.");
    lom_scene *scene = lom_open_scene(arguments.items[0], &values.scene, &error);
    bool done = scene != NULL && explain(&values, arguments.items[0], scene, x, y, &error);
    lom_free_scene(scene);
    return done ? LOM_EXIT_DONE : lom_complain_error(&error);
}
