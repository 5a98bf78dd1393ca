/* The smallest program with a shader of its own: a triangle with three colours, written to triangle.png.
 *
 *   lom-cc triangle.c -o triangle
 */
#include <lom/lom.h>

#include <stdio.h>

enum { RED, GREEN, BLUE, VARYINGS };

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    out->varying[RED] = in->attribute[1].x;
    out->varying[GREEN] = in->attribute[1].y;
    out->varying[BLUE] = in->attribute[1].z;
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[RED], in->varying[GREEN], in->varying[BLUE], lom_splat(1) };
}

LOM_SHADER(triangle, place, paint, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(RED, 3), .colors = 1)

#if LOM_LANES == 4 /* the rest of the file is compiled once */

static const float corners[3][7] = {
    /* clip x, y, z, w    red, green, blue */
    { -0.8f, -0.7f, 0.5f, 1, 1, 0, 0 },
    { 0.8f, -0.7f, 0.5f, 1, 0, 1, 0 },
    { 0.0f, 0.8f, 0.5f, 1, 0, 0, 1 },
};

int main(void)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_texture *picture =
        lom_make_texture(device, &(lom_texture_desc){ .width = 320, .height = 240, .format = LOM_FORMAT_RGBA8_SRGB });

    lom_begin_pass(device, &(lom_pass_desc){ .color = { picture }, .clear_color = { { 0.02f, 0.02f, 0.03f, 1 } } });
    lom_draw(device,
             &(lom_draw_desc){ .shader = &triangle,
                               .attribute = { { corners, sizeof corners, 28, LOM_ATTRIBUTE_FLOAT4 },
                                              { &corners[0][4], sizeof corners - 16, 28, LOM_ATTRIBUTE_FLOAT3 } },
                               .count = 3 });
    bool done = lom_end_pass(device);
    lom_image *image = done ? lom_read_texture(picture, 0, 0, &error) : NULL;
    done = image != NULL && lom_write_image("triangle.png", NULL, image, &error);
    if (done)
        printf("%016llx\n", (unsigned long long)lom_hash_image(image));
    else
        fprintf(stderr, "triangle: %s %s\n", lom_device_error(device)->text, error.text);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}

#endif
