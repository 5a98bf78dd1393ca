/* Included before a lesson's own lines: its memset and memcpy are told as its other stores are; the headers' are not. */
#ifndef LOM_WEB_LESSON_TOLD_H
#define LOM_WEB_LESSON_TOLD_H

#include <lom/lom.h>

#include <string.h>

void *lom_told_memset(void *to, int value, size_t size);
void *lom_told_memcpy(void *to, const void *from, size_t size);

#define memset lom_told_memset
#define memcpy lom_told_memcpy

#endif
