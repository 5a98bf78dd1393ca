/* Whole windows of large triangles, which are shaded together, against the plain way (device->one_by_one), in which every
 * part of one is a packet by itself and finds its values alone: the same bytes with and without perspective, for varyings
 * that are flat, linear in the window, the same at all vertices and differentiated (with a texture whose level follows from
 * it), for shaders that want quads and that discard, and for every way of writing. Many triangles of all sizes overlap, so
 * that the number of windows left over for the last time is everything it can be. */
#include "pipeline/device.h"

#include "stage.h"

enum { SIZE = 160, TRIANGLES = 60, VARYINGS = 8, TEXELS = 64 };

struct settings {
    const lom_texture *texture;
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    for (int a = 0; a < 2; a++) {
        lom_float4 value = in->attribute[1 + a];
        out->varying[4 * a] = value.x;
        out->varying[4 * a + 1] = value.y;
        out->varying[4 * a + 2] = value.z;
        out->varying[4 * a + 3] = value.w;
    }
}

/* 0 to 3: colour; 4 and 5: coordinates of the texture, and of a second look with the derivatives of colours. */
static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct settings *s = uniforms;
    const lom_float *v = in->varying;
    lom_float4 texel = lom_sample(s->texture, v[4], v[5], lom_lod(s->texture, in, 4, 5));
    lom_float4 other = lom_sample(s->texture, v[0], v[1], lom_lod(s->texture, in, 0, 1));
    out->color[0] = (lom_float4){ v[0] * texel.x, v[1] * texel.y + v[6] * 0.1f, v[2] * other.z + v[7] * 0.1f, v[3] };
    out->discard = v[2] < 0.3f;
}

enum { READS = (1 << VARYINGS) - 1, SLOPES = 1 << 0 | 1 << 1 | 1 << 4 | 1 << 5 };
enum { FLAT = 1 << 1 | 1 << 6, LINEAR = 1 << 2 | 1 << 7 };
LOM_SHADER(plain, place, show, .attributes = 3, .varyings = VARYINGS, .reads = READS, .differentiates = SLOPES,
           .colors = 1, .uniforms_size = sizeof(struct settings))
LOM_SHADER(flat, place, show, .attributes = 3, .varyings = VARYINGS, .reads = READS, .differentiates = SLOPES,
           .flat = FLAT, .screen_linear = LINEAR, .colors = 1, .uniforms_size = sizeof(struct settings))
LOM_SHADER(holed, place, show, .attributes = 3, .varyings = VARYINGS, .reads = READS, .differentiates = SLOPES,
           .discards = true, .colors = 1, .uniforms_size = sizeof(struct settings))
LOM_SHADER(in_quads, place, show, .attributes = 3, .varyings = VARYINGS, .reads = READS, .differentiates = SLOPES,
           .quads = true, .colors = 1, .uniforms_size = sizeof(struct settings))

static const lom_blend straight = { .enabled = true,
                                    .source_color = LOM_FACTOR_SOURCE_ALPHA,
                                    .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                    .source_alpha = LOM_FACTOR_SOURCE_ALPHA,
                                    .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };
static const lom_blend multiplied = { .enabled = true,
                                      .source_color = LOM_FACTOR_ONE,
                                      .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                      .source_alpha = LOM_FACTOR_ONE,
                                      .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };
static const lom_blend other = { .enabled = true,
                                 .source_color = LOM_FACTOR_ONE,
                                 .target_color = LOM_FACTOR_SOURCE_COLOR,
                                 .source_alpha = LOM_FACTOR_ONE,
                                 .target_alpha = LOM_FACTOR_ONE,
                                 .color_operation = LOM_BLEND_REVERSE_SUBTRACT };

/* Corners anywhere around the window; every third triangle has w = 1, every fourth one a value that is the same. */
static void scatter(vertex *v)
{
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        float w = i / 3 % 3 == 0 ? 1.0f : random_float(0.5f, 2.0f), size = i / 3 % 2 == 0 ? 0.4f : 1.5f;
        const float at[2] = { random_float(-size, size), random_float(-size, size) };
        const float middle[2] = { (float)(i / 3 % 5) * 0.25f - 0.5f, (float)(i / 3 % 7) * 0.2f - 0.5f };
        v[i] = (vertex){ .position = { (at[0] + middle[0]) * w, (at[1] + middle[1]) * w, 0.5f * w, w } };
        for (int k = 0; k < VARYINGS; k++)
            v[i].value[k] = random_float(0, k == 4 || k == 5 ? 3.0f : 1.0f);
        if (i / 3 % 4 == 1)
            v[i].value[0] = 0.75f;
        if (i / 3 % 8 == 1)
            v[i].value[2] = -0.0f;
    }
}

static lom_texture *checkers(lom_device *device)
{
    uint8_t texels[TEXELS * TEXELS][4];
    for (int i = 0; i < TEXELS * TEXELS; i++)
        for (int c = 0; c < 4; c++)
            texels[i][c] = (uint8_t)(((i / TEXELS ^ i) & 4) != 0 ? 255 - 3 * c : i * (c + 1));
    return lom_make_texture(
        device, &(lom_texture_desc){ .width = TEXELS, .height = TEXELS, .pixels = texels, .mips = LOM_MIPS_ALL });
}

static void draw(stage *s, const lom_shader *shader, const vertex *v, lom_blend how, bool one_by_one)
{
    lom_texture *texture = checkers(s->device);
    const struct settings settings = { texture };
    lom_draw_desc desc = draw_of(shader, v, 3 * TRIANGLES);
    desc.uniforms = &settings;
    desc.blend[0] = how;
    s->device->one_by_one = one_by_one;
    begin(s, (lom_pass_desc){ .clear_color = { { 0.25f, 0.5f, 0.75f, 0.5f } } });
    lom_draw(s->device, &desc);
    finish(s);
    lom_release_texture(s->device, texture);
}

static void compare(const char *name, const lom_shader *shader, lom_blend how, lom_format format)
{
    vertex v[3 * TRIANGLES];
    stage s[2];
    scatter(v);
    for (int k = 0; k < 2; k++) {
        s[k] = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, format, LOM_FORMAT_NONE);
        draw(&s[k], shader, v, how, k == 1);
    }
    CHECK(same_images(s[0].image, s[1].image), "%s: windows together differ from windows alone", name);
    for (int k = 0; k < 2; k++)
        close_stage(&s[k]);
}

static void shaders(void)
{
    compare("plain", &plain, (lom_blend){ .enabled = false }, LOM_FORMAT_RGBA8);
    compare("flat and linear", &flat, (lom_blend){ .enabled = false }, LOM_FORMAT_RGBA8);
    compare("holed", &holed, (lom_blend){ .enabled = false }, LOM_FORMAT_RGBA8);
    compare("in quads", &in_quads, (lom_blend){ .enabled = false }, LOM_FORMAT_RGBA8);
}

static void outputs(void)
{
    compare("straight", &plain, straight, LOM_FORMAT_RGBA8);
    compare("multiplied", &flat, multiplied, LOM_FORMAT_RGBA8);
    compare("another equation", &plain, other, LOM_FORMAT_RGBA8);
    compare("holed and straight", &holed, straight, LOM_FORMAT_RGBA8);
    compare("sRGB", &plain, straight, LOM_FORMAT_RGBA8_SRGB);
    compare("floats", &plain, multiplied, LOM_FORMAT_RGBA32F);
}

int main(int argc, char **argv)
{
    RUN(shaders);
    RUN(outputs);
    return check_result();
}
