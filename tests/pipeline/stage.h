/* What the tests of the pipeline share: a device of this width with its targets, vertices and random numbers. */
#ifndef LOM_TESTS_STAGE_H
#define LOM_TESTS_STAGE_H

#include <lom/pipeline.h>

#include "check.h"
#include "oracle/coverage.h"

/* ---- a device and what it draws into ---- */

typedef struct stage {
    lom_device *device;
    lom_texture *color, *depth; /* depth may be NULL */
    lom_image *image, *depths;  /* as the last pass left them */
} stage;

static inline lom_device *open_device(lom_device_desc desc)
{
    desc.lanes = LOM_LANES;
#ifdef LOM_LOWERED
    desc.plain = true;
#endif
    return lom_open_device(&desc);
}

/* depth LOM_FORMAT_NONE: no depth attachment. */
static inline stage open_stage(lom_device_desc desc, int width, int height, lom_format color, lom_format depth)
{
    stage s = { .device = open_device(desc) };
    s.color = lom_make_texture(s.device, &(lom_texture_desc){ .width = width, .height = height, .format = color });
    if (depth != LOM_FORMAT_NONE)
        s.depth = lom_make_texture(s.device, &(lom_texture_desc){ .width = width, .height = height, .format = depth });
    return s;
}

static inline void close_stage(stage *s)
{
    lom_free_image(s->image);
    lom_free_image(s->depths);
    lom_close_device(s->device);
}

static inline void begin(stage *s, lom_pass_desc desc)
{
    desc.color[0] = s->color;
    desc.depth = s->depth;
    lom_begin_pass(s->device, &desc);
}

static inline void finish(stage *s)
{
    CHECK(lom_end_pass(s->device), "%s", lom_device_error(s->device)->text);
    lom_free_image(s->image);
    lom_free_image(s->depths);
    s->image = lom_read_texture(s->color, 0, 0, NULL);
    s->depths = s->depth == NULL ? NULL : lom_read_texture(s->depth, 0, 0, NULL);
}

static inline const uint8_t *bytes_at(const stage *s, int x, int y)
{
    return lom_image_pixel(s->image, x, y, 0);
}

static inline const float *floats_at(const stage *s, int x, int y)
{
    return lom_image_pixel(s->image, x, y, 0);
}

static inline bool same_images(const lom_image *a, const lom_image *b)
{
    return lom_image_size(a) == lom_image_size(b) && memcmp(a->pixels, b->pixels, lom_image_size(a)) == 0;
}

/* ---- vertices ---- */

typedef struct vertex {
    float position[4], value[8], distance[8];
} vertex;

/* Attributes 0: position; 1, 2: value; 3, 4: distance. */
static inline lom_draw_desc draw_of(const lom_shader *shader, const vertex *v, size_t count)
{
    size_t size = count * sizeof *v, stride = sizeof *v;
    lom_draw_desc desc = { .shader = shader, .count = count };
    for (size_t a = 0; a < 5; a++)
        desc.attribute[a] = (lom_attribute){ (const char *)v + 16 * a, size - 16 * a, stride, LOM_ATTRIBUTE_FLOAT4 };
    return desc;
}

/* Stages of shaders that show the four values of attribute 1 as they are. */
LOM_INLINE void place_values(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    out->varying[0] = in->attribute[1].x;
    out->varying[1] = in->attribute[1].y;
    out->varying[2] = in->attribute[1].z;
    out->varying[3] = in->attribute[1].w;
}

LOM_INLINE void show_values(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0], in->varying[1], in->varying[2], in->varying[3] };
}

/* source + target */
static inline lom_blend adding(void)
{
    return (lom_blend){ .enabled = true,
                        .source_color = LOM_FACTOR_ONE,
                        .target_color = LOM_FACTOR_ONE,
                        .source_alpha = LOM_FACTOR_ONE,
                        .target_alpha = LOM_FACTOR_ONE };
}

/* ---- random numbers ---- */

static uint64_t random_draws;

static inline uint64_t random_bits(void)
{
    return lom_random_bits(1907, random_draws++);
}

/* Whole number in low..high. */
static inline int64_t random_whole(int64_t low, int64_t high)
{
    return low + (int64_t)(random_bits() % (uint64_t)(high - low + 1));
}

static inline float random_float(float low, float high)
{
    return low + (high - low) * (float)(random_bits() >> 40) * 0x1p-24f;
}

/* The clip position, w = 1, of a snapped one in a square viewport of a power of two: exact, so it snaps back. */
static inline void place_at(vertex *v, int64_t x, int64_t y, int size)
{
    float half = (float)size * 128.0f;
    v->position[0] = (float)x / half - 1.0f;
    v->position[1] = 1.0f - (float)y / half;
    v->position[2] = 0.5f;
    v->position[3] = 1.0f;
}

#endif
