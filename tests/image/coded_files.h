/* Files of DDS and KTX, made in memory by the tests: headers from their fields, and the bytes that follow. */
#ifndef LOM_TESTS_CODED_FILES_H
#define LOM_TESTS_CODED_FILES_H

#include "check.h"

#include <lom/image.h>

typedef struct coded_file {
    uint8_t *data;
    size_t size;
} coded_file;

static inline void put_word(uint8_t *to, uint32_t word, bool big)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(word >> 8 * (big ? 3 - i : i));
}

static inline void append_bytes(coded_file *file, const void *bytes, size_t size)
{
    file->data = realloc(file->data, file->size + size + 1);
    if (size > 0)
        memcpy(file->data + file->size, bytes, size);
    file->size += size;
}

static inline void append_word(coded_file *file, uint32_t word, bool big)
{
    uint8_t bytes[4];
    put_word(bytes, word, big);
    append_bytes(file, bytes, 4);
}

/* Bytes that tell where they stand. */
static inline void append_random(coded_file *file, uint64_t key, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        uint8_t byte = (uint8_t)(lom_random_bits(key, i) >> 9);
        append_bytes(file, &byte, 1);
    }
}

typedef struct dds_fields {
    uint32_t width, height, depth, levels;
    const char *code; /* of a coded format, NULL: masks */
    uint32_t flags, bits, mask[4], caps;
    uint32_t dxgi, dimension, misc, elements; /* where code is DX10 */
} dds_fields;

static inline coded_file begin_dds(const dds_fields *f)
{
    coded_file file = { 0 };
    uint8_t header[148] = "DDS ";
    put_word(header + 4, 124, false);
    put_word(header + 8, 0x1007, false);
    put_word(header + 12, f->height, false);
    put_word(header + 16, f->width, false);
    put_word(header + 24, f->depth, false);
    put_word(header + 28, f->levels, false);
    put_word(header + 76, 32, false);
    put_word(header + 80, f->code != NULL ? 4 : f->flags, false);
    if (f->code != NULL)
        memcpy(header + 84, f->code, 4);
    put_word(header + 88, f->bits, false);
    for (int i = 0; i < 4; i++)
        put_word(header + 92 + 4 * i, f->mask[i], false);
    put_word(header + 108, 0x1000, false);
    put_word(header + 112, f->caps, false);
    put_word(header + 128, f->dxgi, false);
    put_word(header + 132, f->dimension, false);
    put_word(header + 136, f->misc, false);
    put_word(header + 140, f->elements, false);
    append_bytes(&file, header, f->code != NULL && memcmp(f->code, "DX10", 4) == 0 ? 148 : 128);
    return file;
}

typedef struct ktx_fields {
    bool big;
    uint32_t type, type_size, format, internal, base, width, height, depth, elements, faces, levels;
    const char *orientation; /* NULL: no pairs */
} ktx_fields;

static inline coded_file begin_ktx(const ktx_fields *f)
{
    coded_file file = { 0 };
    const uint32_t words[] = { 0x04030201, f->type,   f->type_size, f->format,   f->internal, f->base,
                               f->width,   f->height, f->depth,     f->elements, f->faces,    f->levels };
    append_bytes(&file, "\xabKTX 11\xbb\r\n\x1a\n", 12);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        append_word(&file, words[i], f->big);
    size_t text = f->orientation != NULL ? strlen(f->orientation) + 1 : 0;
    append_word(&file, text > 0 ? (uint32_t)(4 + (15 + text + 3) / 4 * 4) : 0, f->big);
    if (text > 0) {
        append_word(&file, (uint32_t)(15 + text), f->big);
        append_bytes(&file, "KTXorientation", 15);
        append_bytes(&file, f->orientation, text);
        append_bytes(&file, "\0\0\0", (4 - (15 + text) % 4) % 4);
    }
    return file;
}

/* Every shorter file is refused as input, with a sentence. */
static inline void check_truncations(const coded_file *file, const char *name)
{
    for (size_t size = 0; size < file->size; size++) {
        lom_error error = { 0 };
        uint8_t *exact = malloc(size + (size == 0));
        memcpy(exact, file->data, size);
        lom_image *cut = lom_decode_image(exact, size, name, &error);
        CHECK(cut == NULL && error.code == LOM_ERROR_INPUT && strncmp(error.text, name, strlen(name)) == 0,
              "%s: %zu bytes of %zu were enough: %s", name, size, file->size, error.text);
        lom_free_image(cut);
        free(exact);
    }
}

#endif
