/* What options and helps say of the kinds of picture files: all of it from the table of codecs. */
#ifndef LOM_CLI_PICTURE_KINDS_H
#define LOM_CLI_PICTURE_KINDS_H

#include <lom/image.h>

#include <stdio.h>

/* The names of the codecs that write pictures, from 0; NULL behind the last. */
const char *lom_picture_choice(size_t index);
/* The same, and videos. */
const char *lom_frame_choice(size_t index);
/* The same as lom_picture_choice, and obj. */
const char *lom_conversion_choice(size_t index);

/* A table of all kinds, a line each, with their endings, bits and channels; below a help. */
void lom_print_picture_kinds(FILE *out);
/* The page docs/formats.md. */
bool lom_write_format_documentation(const char *path, lom_error *error);

#endif
