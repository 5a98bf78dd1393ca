/* The headers of PNM, PAM and PFM files: words and numbers between white space. In: bytes that need not end with a
 * zero; every function stays within them and moves `at`. */
#ifndef LOM_IMAGE_TEXT_READER_H
#define LOM_IMAGE_TEXT_READER_H

#include <lom/base.h>

typedef struct text_reader {
    const uint8_t *data;
    size_t size, at;
    const char *name;
    lom_error *error;
} text_reader;

static inline bool text_fail(const text_reader *in, const char *what)
{
    return lom_fail(in->error, LOM_ERROR_INPUT, "%s: byte %zu: %s.", in->name, in->at, what);
}

static inline bool text_is_space(uint8_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Skips white space and comments, which begin with # and end with the line. */
static inline void text_skip_space(text_reader *in)
{
    while (in->at < in->size && (text_is_space(in->data[in->at]) || in->data[in->at] == '#')) {
        if (in->data[in->at] == '#')
            while (in->at < in->size && in->data[in->at] != '\n' && in->data[in->at] != '\r')
                in->at++;
        else
            in->at++;
    }
}

/* A decimal number up to most, after white space. */
static inline bool text_read_number(text_reader *in, uint32_t most, uint32_t *value)
{
    text_skip_space(in);
    if (in->at >= in->size)
        return text_fail(in, "the file ends where a number should be");
    if (in->data[in->at] < '0' || in->data[in->at] > '9')
        return text_fail(in, "there should be a number");
    uint64_t number = 0;
    for (; in->at < in->size && in->data[in->at] >= '0' && in->data[in->at] <= '9'; in->at++) {
        number = number * 10 + (in->data[in->at] - '0');
        if (number > most)
            return text_fail(in, "the number is too large");
    }
    *value = (uint32_t)number;
    return true;
}

/* The one white space that ends a header. */
static inline bool text_end_header(text_reader *in)
{
    if (in->at >= in->size || !text_is_space(in->data[in->at]))
        return text_fail(in, "the header should end with white space");
    in->at++;
    return true;
}

#endif
