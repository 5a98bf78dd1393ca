/* What the tests of the pipeline in one file share: that file, and textures of both pipelines. */
#ifndef LOM_TESTS_PLAIN_H
#define LOM_TESTS_PLAIN_H

#include <lom/texture.h>

#include "check.h"

int draw_picture(int argc, char **argv);
#define main draw_picture /* the lesson is a program */
#include "../../docs/lessons/pipeline/pipeline.c"
#undef main

struct skin {
    struct texture plain; /* first: a draw names it */
    lom_texture *lanes;
    void *room;
};

static inline struct skin make_skin(int width, int height, const uint8_t *rgba)
{
    lom_texture_desc desc = { .width = width, .height = height, .format = LOM_FORMAT_RGBA8_SRGB };
    desc.pixels = rgba;
    desc.mips = LOM_MIPS_ALL;
    void *room = lom_allocate(2 * (size_t)width * (size_t)height, 4 * sizeof(float), NULL);
    return (struct skin){ make_texture(width, height, rgba, room), lom_create_texture(&desc, NULL), room };
}

static inline void free_skin(struct skin *skin)
{
    lom_release(skin->room);
    lom_free_texture(skin->lanes);
}

/* Noise with alpha, of any power of two. */
static inline struct skin make_noise(int width, int height)
{
    uint8_t *rgba = lom_allocate((size_t)width * (size_t)height, 4, NULL);
    for (size_t i = 0; i < (size_t)width * (size_t)height * 4; i++)
        rgba[i] = (uint8_t)(lom_random_bits(17, i) >> (i % 4 == 3 ? 57 : 56)) | (i % 4 == 3 ? 128 : 0);
    struct skin skin = make_skin(width, height, rgba);
    lom_release(rgba);
    return skin;
}

#endif
