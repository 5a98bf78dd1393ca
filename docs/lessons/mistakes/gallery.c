/* The gallery of mistakes: gallery FOLDER [NAME...] writes right.png and, a mistake, NAME.png into a folder that is there;
 * gallery alone prints the table of README.md. In: the plain pipeline, each time with one wrong stage. Out: a scene as it draws it. */
#include "gallery.h"
#include "mistakes.h"

static bool write_scene(const char *folder, const char *name, const struct stages *stages)
{
    char path[4096];
    lom_error error = { .code = LOM_OK };
    lom_image *image = draw_gallery_image(stages, &error);
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    bool done = image != NULL && lom_write_image(path, NULL, image, &error);
    lom_free_image(image);
    if (!done)
        fprintf(stderr, "gallery: %s\n", error.text);
    return done;
}

static bool print_table(void)
{
    lom_image *right = draw_gallery_image(&right_stages, NULL);
    bool done = right != NULL;
    printf("| right | wrong | the rule that is broken |\n|---|---|---|\n");
    for (const struct mistake *m = mistakes; m < mistakes + MISTAKES && done; m++) {
        lom_comparison comparison;
        lom_image *wrong = draw_gallery_image(&m->wrong, NULL);
        done = wrong != NULL && lom_compare_images(right, wrong, &comparison, NULL);
        if (done)
            printf("| ![right](right.png) | ![%s](%s.png) | **%s** (`%s`): %s *%s.*<br>%s %zu pixels differ, by at "
                   "most %.0f. |\n",
                   m->name, m->name, m->name, m->stage, m->rule, m->source, m->looks, comparison.pixels,
                   comparison.max_delta);
        lom_free_image(wrong);
    }
    lom_free_image(right);
    return done;
}

/* Whether a mistake was asked for by its name; without names all are. */
static bool is_asked(const char *name, int count, char **names)
{
    for (int i = 0; i < count; i++)
        if (strcmp(names[i], name) == 0)
            return true;
    return count == 0;
}

int main(int argc, char **argv)
{
    if (argc == 1)
        return print_table() ? 0 : 2;
    int drawn = 0, asked = argc - 2;
    bool done = write_scene(argv[1], "right", &right_stages);
    for (int i = 0; i < MISTAKES && done; i++)
        if (is_asked(mistakes[i].name, asked, argv + 2)) {
            done = write_scene(argv[1], mistakes[i].name, &mistakes[i].wrong);
            drawn++;
        }
    if (done && drawn < asked)
        fprintf(stderr, "gallery: of %d names %d are no mistake's; gallery without arguments lists them.\n", asked,
                asked - drawn);
    return done && drawn >= asked ? 0 : 2;
}
