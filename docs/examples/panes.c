/* What a target makes of three discs, written to panes.png: coloured glass by two sources (a colour that is added, and one
 * that the light behind is multiplied by, each channel its own); the lesser of both; the greater; the bits of one exclusive
 * or those of the other (docs/output.md).
 *
 *   lom-cc panes.c -o panes */
#include <lom/lom.h>

#include <stdio.h>

enum { COLOR, VARYINGS = 3 };

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_float4 p = in->attribute[0], color = in->attribute[1];
    out->position = (lom_float4){ p.x, p.y, lom_splat(0), lom_splat(1) };
    out->varying[COLOR] = color.x;
    out->varying[COLOR + 1] = color.y;
    out->varying[COLOR + 2] = color.z;
    (void)uniforms;
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const float *c = uniforms; /* how much of the colour */
    out->color[0] = (lom_float4){ in->varying[COLOR] * c[0], in->varying[COLOR + 1] * c[0],
                                  in->varying[COLOR + 2] * c[0], lom_splat(1) };
}

/* A pane shines a little, and lets its colour through. */
static void stain(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_float4 through = { in->varying[COLOR], in->varying[COLOR + 1], in->varying[COLOR + 2], lom_splat(1) };
    out->color[0] = (lom_float4){ lom_splat(0.05f), lom_splat(0.05f), lom_splat(0.06f), lom_splat(0) };
    out->color[1] = through;
    (void)uniforms;
}

LOM_SHADER(painted, place, paint, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(COLOR, VARYINGS),
           .colors = 1, .uniforms_size = sizeof(float))
LOM_SHADER(stained, place, stain, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(COLOR, VARYINGS),
           .colors = 2, .uniforms_size = sizeof(float))

#if LOM_LANES == 4 /* the rest of the file is compiled once */

enum { WIDTH = 640, HEIGHT = 360, ACROSS = 16, DOWN = 9, DISCS = 3, RIM = 96 };

static const double TURN = 6.283185307179586, RADIUS = 0.667; /* of the half of a view's height */

struct vertex {
    float place[2], color[3];
};

static size_t make_tiles(struct vertex *v)
{
    size_t count = 0;
    for (int i = 0; i < ACROSS * DOWN; i++)
        for (int k = 0; k < 6; k++) {
            const int x = i % ACROSS + (k == 1 || k == 2 || k == 4), y = i / ACROSS + (k == 2 || k == 4 || k == 5);
            const float light = (i % ACROSS + i / ACROSS) % 2 == 0 ? 0.9f : 0.35f;
            v[count++] =
                (struct vertex){ { (float)x * 2 / ACROSS - 1, (float)y * 2 / DOWN - 1 }, { light, light, light } };
        }
    return count;
}

/* Points of the rims by turning: (c, s) is the step's cosine and sine, of 1 / RIM of a turn. */
static size_t make_discs(struct vertex *v)
{
    static const float middle[DISCS][2] = { { -0.24f, -0.2f }, { 0.24f, -0.2f }, { 0, 0.26f } };
    static const float color[DISCS][3] = { { 0.95f, 0.3f, 0.25f }, { 0.3f, 0.85f, 0.35f }, { 0.3f, 0.45f, 0.95f } };
    const double c = lom_double_cos(TURN / RIM), s = lom_double_sin(TURN / RIM);
    size_t count = 0;
    for (int d = 0; d < DISCS; d++) {
        double x = 1, y = 0;
        for (int i = 0; i < RIM; i++) {
            const double next = c * x - s * y, corner[3][2] = { { 0, 0 }, { x, y }, { next, s * x + c * y } };
            for (int k = 0; k < 3; k++) {
                struct vertex *at = &v[count++];
                at->place[0] = middle[d][0] + (float)(corner[k][0] * RADIUS * HEIGHT / WIDTH);
                at->place[1] = middle[d][1] + (float)(corner[k][1] * RADIUS);
                for (int n = 0; n < 3; n++)
                    at->color[n] = color[d][n];
            }
            x = corner[2][0];
            y = corner[2][1];
        }
    }
    return count;
}

static lom_draw_desc draw_of(const lom_shader *shader, const struct vertex *v, size_t count, const float *share)
{
    const size_t stride = sizeof *v, size = count * stride;
    lom_draw_desc draw = { .shader = shader, .uniforms = share, .count = count, .depth_test_off = true };
    draw.attribute[0] = (lom_attribute){ v->place, size, stride, LOM_ATTRIBUTE_FLOAT2 };
    draw.attribute[1] = (lom_attribute){ v->color, size - sizeof v->place, stride, LOM_ATTRIBUTE_FLOAT3 };
    return draw;
}

static bool draw(lom_device *device, lom_texture *picture)
{
    static const struct {
        const lom_shader *shader;
        lom_blend blend;
        lom_logic logic;
        float behind;
    } view[4] = { { &stained,
                    { .enabled = true, .source_color = LOM_FACTOR_ONE, .target_color = LOM_FACTOR_SECOND_COLOR },
                    LOM_LOGIC_OFF,
                    1 },
                  { &painted, { .enabled = true, .color_operation = LOM_BLEND_MIN }, LOM_LOGIC_OFF, 1 },
                  { &painted, { .enabled = true, .color_operation = LOM_BLEND_MAX }, LOM_LOGIC_OFF, 0.5f },
                  { &painted, { .enabled = false }, LOM_LOGIC_XOR, 0.5f } };
    static struct vertex tiles[6 * ACROSS * DOWN], discs[3 * RIM * DISCS];
    const size_t tile_count = make_tiles(tiles), disc_count = make_discs(discs);
    const float all = 1;
    lom_begin_pass(device, &(lom_pass_desc){ .color = { picture }, .samples = 8 });
    for (int i = 0; i < 4; i++) {
        const lom_rect part = { i % 2 * WIDTH / 2, i / 2 * HEIGHT / 2, WIDTH / 2, HEIGHT / 2 };
        lom_draw_desc floor = draw_of(&painted, tiles, tile_count, &view[i].behind),
                      panes = draw_of(view[i].shader, discs, disc_count, &all);
        floor.viewport = panes.viewport = part;
        panes.blend[0] = view[i].blend;
        panes.logic = view[i].logic;
        panes.mask_off[0] = 1 << 3; /* alpha stays */
        lom_draw(device, &floor);
        lom_draw(device, &panes);
    }
    return lom_end_pass(device);
}

int main(void)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_texture *picture =
        lom_make_texture(device, &(lom_texture_desc){ .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8 });
    lom_image *image = draw(device, picture) ? lom_read_texture(picture, 0, 0, &error) : NULL;
    const bool done = image != NULL && lom_write_image("panes.png", NULL, image, &error);
    if (done)
        printf("%016llx\n", (unsigned long long)lom_hash_image(image));
    else
        fprintf(stderr, "panes: %s %s\n", lom_device_error(device)->text, error.text);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}

#endif
