/* The picture of a pass. In: a renderer that has drawn a frame, a name. Out: its numbers, or a picture for eyes. */
#include "show_pass.h"

#include "picture_kinds.h"

bool lom_shows_numbers(const char *output, const char *format)
{
    const lom_codec_info *codec = output != NULL ? lom_find_codec(output, format) : NULL;
    return codec != NULL && (codec->bits & 32) != 0;
}

bool lom_take_shown_pass(lom_renderer *renderer, const lom_frame_desc *desc, const char *name, bool numbers,
                         lom_image **image, lom_error *error)
{
    lom_free_image(*image);
    *image = lom_show_pass(renderer, desc, name, error);
    if (!numbers)
        *image = lom_show_to_eyes(*image, name, error);
    return *image != NULL;
}

void lom_print_shown_passes(FILE *out)
{
    const lom_shown_pass *pass;
    fputs("\nPASS of --show:\n", out);
    for (size_t i = 0; (pass = lom_describe_shown_pass(i)) != NULL; i++)
        fprintf(out, "  %-17s%s\n", pass->name, pass->text);
    lom_print_picture_kinds(out);
}
