/* `lom render --show PASS`: the picture of a pass in place of the frame's. */
#ifndef LOM_CLI_SHOW_PASS_H
#define LOM_CLI_SHOW_PASS_H

#include <lom/inspect.h>

#include <stdio.h>

/* Whether a picture of this name or kind holds floats: it then gets the numbers, else what eyes see. */
bool lom_shows_numbers(const char *output, const char *format);
/* Frees *image and puts the pass's picture there. False: *image is NULL. */
bool lom_take_shown_pass(lom_renderer *renderer, const lom_frame_desc *desc, const char *name, bool numbers,
                         lom_image **image, lom_error *error);
/* The passes, and the kinds of pictures. */
void lom_print_shown_passes(FILE *out);

#endif
