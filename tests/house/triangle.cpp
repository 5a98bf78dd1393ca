// The picture of docs/examples/triangle.c from shaders in C++: members of the shader in another order than the struct's,
// a template over lanes (which C++ emits under one name at every width), a matrix times lanes.
#include <lom/lom.h>

#include <cstdio>
#include <initializer_list>

enum { RED, GREEN, BLUE, VARYINGS };

template <typename T> [[gnu::noinline]] T twice(T x)
{
    return x + x;
}

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    out->position = lom_multiply4(static_cast<const lom_matrix_uniform *>(uniforms), in->attribute[0]);
    out->varying[RED] = twice(in->attribute[1].x) * 0.5f;
    out->varying[GREEN] = in->attribute[1].y;
    out->varying[BLUE] = in->attribute[1].z;
}

// A struct of lanes has one name at every width: without care the linker would keep one copy of this for all.
struct paint {
    lom_float3 color;
    [[gnu::noinline]] lom_float4 opaque() const
    {
        return { color.x, color.y, color.z, lom_splat(1) };
    }
};

static void fill(lom_fragment *out, const lom_varyings *in, const void *)
{
    out->color[0] = paint{ { in->varying[RED], in->varying[GREEN], in->varying[BLUE] } }.opaque();
}

LOM_SHADER(triangle, place, fill, .colors = 1, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(RED, 3),
           .uniforms_size = sizeof(lom_matrix_uniform))

#if LOM_LANES == 4 // the rest of the file is compiled once

static const float corners[3][7] = {
    // clip x, y, z, w    red, green, blue
    { -0.8f, -0.7f, 0.5f, 1, 1, 0, 0 },
    { 0.8f, -0.7f, 0.5f, 1, 0, 1, 0 },
    { 0.0f, 0.8f, 0.5f, 1, 0, 0, 1 },
};

int main()
{
    for (int lanes : { 0, 4, 8, 16 })
        for (bool plain : { false, true }) {
            lom_error error = {};
            lom_device_desc device_desc = {};
            device_desc.lanes = lanes;
            device_desc.plain = plain;
            lom_device *device = lom_open_device(&device_desc);
            if (lom_device_error(device)->code != LOM_OK) { // this processor has no such vectors
                lom_close_device(device);
                continue;
            }
            lom_texture_desc size = {};
            size.width = 320;
            size.height = 240;
            size.format = LOM_FORMAT_RGBA8_SRGB;
            lom_texture *picture = lom_make_texture(device, &size);
            lom_pass_desc pass = {};
            pass.color[0] = picture;
            const float clear[4] = { 0.02f, 0.02f, 0.03f, 1 };
            for (int i = 0; i < 4; i++)
                pass.clear_color[0][i] = clear[i];
            lom_begin_pass(device, &pass);
            lom_mat4 same = lom_identity();
            lom_matrix_uniform uniforms = lom_round_matrix(&same);
            lom_draw_desc draw = {};
            draw.shader = &triangle;
            draw.attribute[0] = { corners, sizeof corners, 28, LOM_ATTRIBUTE_FLOAT4 };
            draw.attribute[1] = { &corners[0][4], sizeof corners - 16, 28, LOM_ATTRIBUTE_FLOAT3 };
            draw.count = 3;
            draw.uniforms = &uniforms;
            lom_draw(device, &draw);
            lom_image *image = lom_end_pass(device) ? lom_read_texture(picture, 0, 0, &error) : nullptr;
            if (image == nullptr) {
                std::fprintf(stderr, "%d lanes: %s %s\n", lanes, lom_device_error(device)->text, error.text);
                return 2;
            }
            std::printf("%016llx\n", static_cast<unsigned long long>(lom_hash_image(image)));
            lom_free_image(image);
            lom_close_device(device);
        }
    return 0;
}

#endif
