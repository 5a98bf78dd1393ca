/* A street of two squares, written to affine.png: with the right interpolation, and with the one that early consoles had
 * (screen_linear). Beside them the same in sixteen pieces, whose error is a sixteenth's.
 *
 *   lom-cc affine.c -o affine
 *
 * A varying that is linear in space is not linear in the window: its quotient by w is, and 1 / w (docs/lessons/interpolation).
 * Linear in the window it bends where the triangles of a square meet, the more the more w changes over a triangle; cutting
 * squares hides that, and so games did. */
#include <lom/lom.h>

#include <stdio.h>

enum { S, T, VARYINGS };

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_matrix_uniform *clip_from_world = uniforms;
    const lom_float4 p = in->attribute[0];
    out->position = lom_transform4(clip_from_world, (lom_float3){ p.x, p.y, p.z });
    out->varying[S] = in->attribute[1].x;
    out->varying[T] = in->attribute[1].y;
}

/* Cobbles: eight rows of eight on a square, every second row moved by half a stone. */
static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_float row = in->varying[T] * 8.0f, odd = lom_floor(row) - 2.0f * lom_floor(row * 0.5f);
    const lom_float along = in->varying[S] * 8.0f + odd * 0.5f;
    const lom_float s = along - lom_floor(along) - 0.5f, t = row - lom_floor(row) - 0.5f;
    const lom_float rim = lom_max(lom_abs(s), lom_abs(t)), stone = lom_saturate((0.47f - rim) * 12.0f);
    const lom_float tone = (0.10f + 0.30f * stone) * (1.0f - 0.35f * odd);
    out->color[0] = (lom_float4){ tone * 1.1f, tone, tone * 0.82f, lom_splat(1) };
    (void)uniforms;
}

LOM_SHADER(correct, place, paint, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(S, VARYINGS),
           .colors = 1, .uniforms_size = sizeof(lom_matrix_uniform))
LOM_SHADER(affine, place, paint, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(S, VARYINGS),
           .screen_linear = LOM_VARYINGS(S, VARYINGS), .colors = 1, .uniforms_size = sizeof(lom_matrix_uniform))

#if LOM_LANES == 4 /* the rest of the file is compiled once */

enum { WIDTH = 640, HEIGHT = 360, MOST_CUTS = 4, LENGTH = 2, VIEWS = 4 };

struct vertex {
    float place[3], st[2];
};

/* The street, 4 m wide and a square after the other, each cut into `cuts` x `cuts` pieces; the number of indices. */
static size_t make_street(int cuts, struct vertex *vertex, uint32_t *index)
{
    const uint32_t across = (uint32_t)cuts, along = LENGTH * across;
    size_t count = 0;
    for (uint32_t k = 0; k <= along; k++)
        for (uint32_t i = 0; i <= across; i++) {
            const float s = (float)i / (float)across, t = (float)k / (float)across;
            *vertex++ = (struct vertex){ { 4 * s - 2, 0, -4 * t }, { s, t } };
        }
    for (uint32_t k = 0; k < along; k++)
        for (uint32_t i = 0; i < across; i++) {
            const uint32_t a = k * (across + 1) + i, b = a + across + 1, piece[6] = { a, a + 1, b + 1, a, b + 1, b };
            for (int n = 0; n < 6; n++)
                index[count++] = piece[n];
        }
    return count;
}

static bool draw(lom_device *device, lom_texture *picture)
{
    static const struct {
        const lom_shader *shader;
        int cuts, x, y;
    } view[VIEWS] = {
        { &correct, 1, 0, 0 }, { &affine, 1, 1, 0 }, { &correct, MOST_CUTS, 0, 1 }, { &affine, MOST_CUTS, 1, 1 }
    };
    const lom_mat4 look = lom_look_at((lom_vec3){ 0.9, 1.5, 1.0 }, (lom_vec3){ -0.2, -0.3, -4 }, (lom_vec3){ 0, 1, 0 });
    const lom_mat4 lens = lom_perspective(0.9, (double)WIDTH / HEIGHT, 0.1), both = lom_multiply(&lens, &look);
    const lom_matrix_uniform clip_from_world = lom_round_matrix(&both);
    struct vertex vertex[VIEWS][(MOST_CUTS + 1) * (LENGTH * MOST_CUTS + 1)];
    uint32_t index[VIEWS][6 * LENGTH * MOST_CUTS * MOST_CUTS];
    lom_begin_pass(
        device, &(lom_pass_desc){ .color = { picture }, .samples = 8, .clear_color = { { 0.45f, 0.6f, 0.75f, 1 } } });
    for (int i = 0; i < VIEWS; i++) {
        lom_draw_desc street = { .shader = view[i].shader,
                                 .uniforms = &clip_from_world,
                                 .indices = index[i],
                                 .count = make_street(view[i].cuts, vertex[i], index[i]),
                                 .depth_test_off = true };
        const size_t stride = sizeof(struct vertex), size = sizeof vertex[i];
        street.attribute[0] = (lom_attribute){ vertex[i][0].place, size, stride, LOM_ATTRIBUTE_FLOAT3 };
        street.attribute[1] = (lom_attribute){ vertex[i][0].st, size - 12, stride, LOM_ATTRIBUTE_FLOAT2 };
        street.viewport = (lom_rect){ view[i].x * WIDTH / 2, view[i].y * HEIGHT / 2, WIDTH / 2, HEIGHT / 2 };
        lom_draw(device, &street);
    }
    return lom_end_pass(device);
}

int main(void)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_texture *picture = lom_make_texture(
        device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB });
    lom_image *image = draw(device, picture) ? lom_read_texture(picture, 0, 0, &error) : NULL;
    const bool done = image != NULL && lom_write_image("affine.png", NULL, image, &error);
    if (done)
        printf("%016llx\n", (unsigned long long)lom_hash_image(image));
    else
        fprintf(stderr, "affine: %s %s\n", lom_device_error(device)->text, error.text);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}

#endif
