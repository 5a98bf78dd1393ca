/* A mirror on the floor, written to mirror.png: where it is seen the stencil becomes 1, and there alone the mirrored things
 * are drawn, and are not drawn at all where a query says that it is seen nowhere.
 *
 *   lom-cc mirror.c -o mirror
 */
#include <lom/lom.h>

#include <stdio.h>

struct thing {
    float clip_from_world[4][4], color[3], alpha, light;
};

enum { X, Y, Z, LIT, VARYINGS };

static lom_float row(const float m[4], lom_float4 p)
{
    return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
}

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct thing *thing = uniforms;
    const float(*m)[4] = thing->clip_from_world;
    lom_float4 p = in->attribute[0], n = in->attribute[1];
    out->position = (lom_float4){ row(m[0], p), row(m[1], p), row(m[2], p), row(m[3], p) };
    out->varying[X] = p.x;
    out->varying[Y] = p.y;
    out->varying[Z] = p.z;
    out->varying[LIT] =
        lom_max(0.5f * n.x + 0.75f * n.y + 0.43f * n.z, lom_splat(0)) * thing->light + 1.0f - thing->light;
}

static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct thing *thing = uniforms;
    lom_float lit = in->varying[LIT];
    out->color[0] =
        (lom_float4){ lit * thing->color[0], lit * thing->color[1], lit * thing->color[2], lom_splat(thing->alpha) };
}

/* Squares of half a metre that pale with the distance. */
static void pave(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    lom_float x = lom_floor(in->varying[X] * 2.0f), z = lom_floor(in->varying[Z] * 2.0f), half = (x + z) * 0.5f;
    lom_float far = lom_saturate(0.12f - 0.06f * in->varying[Z]),
              tone = lom_select(half == lom_floor(half), lom_splat(0.34f), lom_splat(0.5f));
    tone = tone + (0.7f - tone) * far;
    out->color[0] = (lom_float4){ tone, tone * 0.97f, tone * 0.92f, lom_splat(1) };
    (void)uniforms;
}

LOM_SHADER(solid, place, paint, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(LIT, 1), .colors = 1,
           .uniforms_size = sizeof(struct thing))
LOM_SHADER(paving, place, pave, .attributes = 2, .varyings = VARYINGS, .reads = LOM_VARYINGS(X, 3), .colors = 1,
           .uniforms_size = sizeof(struct thing))

#if LOM_LANES == 4 /* the rest of the file is compiled once */

enum { WIDTH = 480, HEIGHT = 270, RIM = 64, THINGS = 4 };

struct corner {
    float at[3], normal[3];
};

static struct corner boxes[THINGS][36], disc[3 * RIM], ground[6];

static const struct {
    float low[3], high[3], color[3];
} things[THINGS] = { { { -0.95f, 0.04f, -0.8f }, { -0.35f, 1.0f, -0.2f }, { 0.80f, 0.16f, 0.10f } },
                     { { 0.05f, 0.04f, -1.1f }, { 0.6f, 1.5f, -0.6f }, { 0.10f, 0.30f, 0.65f } },
                     { { 0.35f, 0.04f, -0.3f }, { 0.8f, 0.45f, 0.2f }, { 0.85f, 0.60f, 0.10f } },
                     { { -2.1f, 0.04f, -1.6f }, { -1.7f, 0.9f, -1.2f }, { 0.15f, 0.45f, 0.20f } } };

/* Each side as two triangles, counter-clockwise from outside. */
static void make_boxes(void)
{
    static const int sides[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                     { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    static const int fan[6] = { 0, 1, 2, 0, 2, 3 };
    for (int b = 0; b < THINGS; b++)
        for (int i = 0; i < 36; i++) {
            int k = sides[i / 6][fan[i % 6]];
            for (int axis = 0; axis < 3; axis++) {
                boxes[b][i].at[axis] = k >> axis & 1 ? things[b].high[axis] : things[b].low[axis];
                boxes[b][i].normal[axis] = i / 12 == axis ? (i / 6 % 2 ? 1.0f : -1.0f) : 0;
            }
        }
}

static void make_floor(void)
{
    static const float ends[6][2] = { { -40, 6 }, { 40, 6 }, { 40, -40 }, { -40, 6 }, { 40, -40 }, { -40, -40 } };
    for (int i = 0; i < 6; i++)
        ground[i] = (struct corner){ { ends[i][0], 0, ends[i][1] }, { 0, 1, 0 } };
    for (int i = 0; i < RIM; i++)
        for (int k = 0; k < 3; k++) {
            double angle = 6.283185307179586 * (i + 1 - k) / RIM, radius = k == 2 ? 0 : 1.6;
            disc[3 * i + k] = (struct corner){ { (float)(radius * lom_double_cos(angle)), 0.0f,
                                                 (float)(0.15 + 0.9 * radius * lom_double_sin(angle)) },
                                               { 0, 1, 0 } };
        }
}

static struct thing seen_by(const lom_mat4 *clip_from_world, const float color[3], float light, float alpha)
{
    struct thing thing = { .color = { color[0], color[1], color[2] }, .alpha = alpha, .light = light };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            thing.clip_from_world[i][k] = (float)clip_from_world->m[i][k];
    return thing;
}

static lom_draw_desc draw_of(const lom_shader *shader, const struct thing *thing, const struct corner *corners,
                             size_t count)
{
    size_t size = count * sizeof *corners, stride = sizeof *corners;
    return (lom_draw_desc){ .shader = shader,
                            .uniforms = thing,
                            .count = count,
                            .cull = LOM_CULL_BACK,
                            .attribute = { { corners, size, stride, LOM_ATTRIBUTE_FLOAT3 },
                                           { corners->normal, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 } } };
}

static void draw_things(lom_device *device, const lom_mat4 *clip_from_world, const lom_draw_desc *how)
{
    for (int b = 0; b < THINGS; b++) {
        struct thing thing = seen_by(clip_from_world, things[b].color, 0.75f, 1);
        lom_draw_desc draw = draw_of(&solid, &thing, boxes[b], 36);
        draw.stencil = how->stencil;
        draw.condition = how->condition;
        draw.front_clockwise = how->front_clockwise;
        lom_draw(device, &draw);
    }
}

/* The first pass: things, and where the mirror is seen among them. */
static void draw_first(lom_device *device, lom_pass_desc *pass, const lom_mat4 *view, lom_query *seen)
{
    static const float any[3] = { 1, 1, 1 };
    struct thing thing = seen_by(view, any, 0, 1);
    lom_draw_desc mark = draw_of(&solid, &thing, disc, 3 * RIM);
    mark.mask_off[0] = 15;
    mark.depth_write_off = true;
    mark.stencil = (lom_stencil){ .enabled = true, .front = { .pass = LOM_STENCIL_REPLACE, .reference = 1 } };
    mark.query = seen;
    lom_begin_pass(device, pass);
    draw_things(device, view, &(lom_draw_desc){ .condition = NULL });
    lom_draw(device, &mark);
    lom_end_pass(device);
}

/* The second: the mirrored things within it, its own tint over them, and the floor around it. */
static bool draw_second(lom_device *device, lom_pass_desc *pass, const lom_mat4 *view, const lom_query *seen)
{
    static const float tint[3] = { 0.05f, 0.07f, 0.09f }, any[3] = { 1, 1, 1 };
    const lom_stencil within = { .enabled = true, .front = { .compare = LOM_COMPARE_EQUAL, .reference = 1 } };
    const lom_stencil around = { .enabled = true, .front = { .compare = LOM_COMPARE_NOT_EQUAL, .reference = 1 } };
    lom_mat4 mirror = lom_mirror((lom_vec3){ 0, 1, 0 }, 0), mirrored = lom_multiply(view, &mirror);
    struct thing glass = seen_by(view, tint, 0, 0.28f), paved = seen_by(view, any, 0, 1);
    lom_draw_desc surface = draw_of(&solid, &glass, disc, 3 * RIM), floor = draw_of(&paving, &paved, ground, 6);
    surface.stencil = within;
    surface.blend[0] = (lom_blend){ .enabled = true,
                                    .source_color = LOM_FACTOR_ONE,
                                    .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                    .target_alpha = LOM_FACTOR_ONE };
    surface.depth_test_off = true;
    floor.stencil = around;
    pass->color_load[0] = pass->depth_load = pass->stencil_load = LOM_LOAD_KEEP;
    lom_begin_pass(device, pass);
    draw_things(device, &mirrored, &(lom_draw_desc){ .stencil = within, .condition = seen, .front_clockwise = true });
    lom_draw(device, &surface);
    lom_draw(device, &floor);
    return lom_end_pass(device);
}

int main(void)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_texture_desc target = { .width = WIDTH, .height = HEIGHT, .format = LOM_FORMAT_RGBA8_SRGB, .samples = 4 };
    lom_pass_desc pass = { .samples = 4, .clear_color = { { 0.55f, 0.66f, 0.78f, 1 } } };
    pass.color[0] = lom_make_texture(device, &target);
    target.format = LOM_FORMAT_DEPTH32F;
    target.stencil = true;
    pass.depth = lom_make_texture(device, &target);
    lom_query *seen = lom_make_query(device);

    make_boxes();
    make_floor();
    lom_mat4 projection = lom_perspective(0.62, (double)WIDTH / HEIGHT, 0.1),
             look = lom_look_at((lom_vec3){ 0.4, 1.9, 5.2 }, (lom_vec3){ -0.1, 0.25, 0 }, (lom_vec3){ 0, 1, 0 }),
             view = lom_multiply(&projection, &look);
    draw_first(device, &pass, &view, seen);
    bool done = draw_second(device, &pass, &view, seen);

    uint64_t samples = 0;
    lom_query_result(seen, &samples);
    lom_image *image = done ? lom_read_texture(pass.color[0], 0, 0, &error) : NULL;
    done = image != NULL && lom_write_image("mirror.png", NULL, image, &error);
    if (done)
        printf("%016llx, %llu samples of mirror\n", (unsigned long long)lom_hash_image(image),
               (unsigned long long)samples);
    else
        fprintf(stderr, "mirror: %s %s\n", lom_device_error(device)->text, error.text);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}

#endif
