/* UTF-8 sequences: Unicode 15, table 3-7. */
#ifndef LOM_BASE_UTF8_H
#define LOM_BASE_UTF8_H

#include <stddef.h>

/* Bytes of the sequence at text, of which `left` may be read; 0 when it is malformed: overlong forms, surrogates and
 * what lies above U+10FFFF included. A zero byte is a sequence of its own and ends any other, so of a string that ends
 * in one `left` may be SIZE_MAX. */
size_t lom_utf8_length(const unsigned char *text, size_t left);

#endif
