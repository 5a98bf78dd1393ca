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

static inline bool text_is_digit(uint8_t c)
{
    return c >= '0' && c <= '9';
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
    if (!text_is_digit(in->data[in->at]))
        return text_fail(in, "there should be a number");
    uint64_t number = 0;
    for (; in->at < in->size && text_is_digit(in->data[in->at]); in->at++) {
        number = number * 10 + (in->data[in->at] - '0');
        if (number > most)
            return text_fail(in, "the number is too large");
    }
    *value = (uint32_t)number;
    return true;
}

/* A kind of two bytes is followed by white space (or a comment), else it is another kind. */
static inline bool text_end_kind(const text_reader *in)
{
    return (in->at < in->size && (text_is_space(in->data[in->at]) || in->data[in->at] == '#')) ||
           text_fail(in, "the kind should be followed by white space");
}

/* The one white space that ends a header, perhaps behind a comment. A carriage return and a newline are that one white
 * space of a file whose lines end that way, unless the `raster` bytes that follow the header fill the file without it:
 * then the newline is its first sample. */
static inline bool text_end_header(text_reader *in, uint64_t raster)
{
    if (in->at < in->size && in->data[in->at] == '#')
        while (in->at < in->size && in->data[in->at] != '\n' && in->data[in->at] != '\r')
            in->at++;
    if (in->at >= in->size || !text_is_space(in->data[in->at]))
        return text_fail(in, "the header should end with white space");
    in->at++;
    bool is_line = in->data[in->at - 1] == '\r' && in->at < in->size && in->data[in->at] == '\n';
    if (is_line && in->size - in->at > raster)
        in->at++;
    return true;
}

#endif
