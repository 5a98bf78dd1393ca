/* Kinds of files that are known but not read. */
#ifndef LOM_IMAGE_FOREIGN_H
#define LOM_IMAGE_FOREIGN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What the file is and what to do with it, as the end of a sentence: "; it is JPEG: ..."; "" when it is not known. Told
 * by its content, and what lies within gzip by its name. */
const char *lom_foreign_kind(const uint8_t *data, size_t size, const char *name);

#endif
