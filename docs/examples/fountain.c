/* Particles that are stepped by feedback and drawn by a geometry function: a fountain of sparks that bounce, after two
 * seconds, written to fountain.png.
 *
 *   lom-cc fountain.c -o fountain
 *
 * What a particle does next depends on what it did before (it has hit the ground or not), so there is no formula for its
 * place at a time: 120 passes for feedback only turn one buffer into the other. Then each point becomes a square that faces
 * the eye. */
#include <lom/lom.h>

#include <stdio.h>
#include <stdlib.h>

enum { PLACE, BORN = 3, VELOCITY, STATE = 7 }; /* floats of a particle: varyings of the step */
enum { CORNER, GLOW = 2, VARYINGS };           /* of the picture: -1..1 along the square, brightness */
enum { PARTICLES = 20000, STEPS = 120 };       /* of 1/60 s */

struct uniforms {
    lom_matrix_uniform clip_from_world;
    float time, step;
};

/* ---- the step: a vertex function whose varyings are kept ---- */

static void advance(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float4 place = in->attribute[0], velocity = in->attribute[1];
    lom_float born = place.w;
    lom_float step = lom_clamp(u->time + u->step - born, lom_splat(0), lom_splat(u->step)); /* the part it lives */
    velocity.y -= 9.80665f * step;
    lom_mask hits = (place.y + velocity.y * step < 0.0f) & (velocity.y < 0.0f);
    velocity.y = lom_select(hits, velocity.y * -0.55f, velocity.y); /* it keeps a part of its speed */
    out->varying[PLACE] = place.x + velocity.x * step;
    out->varying[PLACE + 1] = lom_max(place.y + velocity.y * step, lom_splat(0));
    out->varying[PLACE + 2] = place.z + velocity.z * step;
    out->varying[VELOCITY] = velocity.x;
    out->varying[VELOCITY + 1] = velocity.y;
    out->varying[VELOCITY + 2] = velocity.z;
    out->varying[BORN] = born;
}

LOM_DEPTH_SHADER(stepping, advance, .attributes = 2, .varyings = STATE, .uniforms_size = sizeof(struct uniforms))

/* ---- the picture: a point, a square about it, a round spot of light ---- */

static void see(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float4 place = in->attribute[0];
    out->position = lom_transform4(&u->clip_from_world, (lom_float3){ place.x, place.y, place.z });
    out->varying[GLOW] = lom_select(place.w <= u->time, lom_saturate(1.0f - 0.4f * (u->time - place.w)), lom_splat(0));
}

static void face_the_eye(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    lom_mask shines = in->vertex[0].varying[GLOW] > 0.0f; /* the others emit nothing */
    for (int i = 0; i < 4; i++) {
        lom_vertex corner = in->vertex[0];
        float s = i & 1 ? 1 : -1, t = i & 2 ? 1 : -1;
        corner.position.x += 0.024f * s; /* in clip space: smaller where w is larger, farther away */
        corner.position.y += 0.0427f * t;
        corner.varying[CORNER] = lom_splat(s);
        corner.varying[CORNER + 1] = lom_splat(t);
        lom_emit_vertex(out, &corner, shines);
    }
}

static void shine(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float s = in->varying[CORNER], t = in->varying[CORNER + 1], glow = in->varying[GLOW];
    lom_float light = lom_saturate(1.0f - s * s - t * t) * glow;
    out->color[0] = (lom_float4){ 0.50f * light, 0.22f * light * glow, 0.05f * light * glow * glow, lom_splat(1) };
}

LOM_SHADER(spark, see, shine, .attributes = 1, .varyings = VARYINGS, .reads = LOM_VARYINGS(CORNER, 3), .colors = 1,
           .uniforms_size = sizeof(struct uniforms))
LOM_GEOMETRY(squares, face_the_eye, .in = LOM_POINTS, .out = LOM_TRIANGLE_STRIP, .vertices = 4)

#if LOM_LANES == 4 /* the rest of the file is compiled once */

enum { STRIDE = STATE * sizeof(float), BYTES = PARTICLES * STRIDE };

static void set_attributes(lom_draw_desc *draw, const float *state)
{
    draw->attribute[0] = (lom_attribute){ state, BYTES, STRIDE, LOM_ATTRIBUTE_FLOAT4 };
    draw->attribute[1] = (lom_attribute){ state + VELOCITY, BYTES - 16, STRIDE, LOM_ATTRIBUTE_FLOAT3 };
}

/* Three jets that let particles out one after the other. */
static void start(float *state)
{
    for (uint64_t i = 0; i < PARTICLES; i++) {
        double place[2], push[2];
        float *p = state + i * STATE, jet = (float)(i % 3) - 1;
        lom_random_normal(1, 2 * i, place);
        lom_random_normal(1, 2 * i + 1, push);
        p[PLACE] = 1.4f * jet + 0.02f * (float)place[0];
        p[PLACE + 1] = 0.1f;
        p[PLACE + 2] = 0.02f * (float)place[1];
        p[BORN] = 2.0f * (float)i / PARTICLES;
        p[VELOCITY] = 0.30f * (float)push[0] - 0.5f * jet;
        p[VELOCITY + 1] = (jet == 0 ? 6.4f : 5.2f) + 0.15f * (float)push[1];
        p[VELOCITY + 2] = 0.30f * (float)push[1];
    }
}

/* The same draw again and again: from one buffer into the other. */
static bool step_all(lom_device *device, float *state[2], struct uniforms *u)
{
    for (int n = 0; n < STEPS; n++) {
        lom_feedback kept = { .data = state[1], .size = BYTES, .varyings = LOM_VARYINGS(PLACE, STATE) };
        lom_draw_desc draw = {
            .shader = &stepping, .uniforms = u, .count = PARTICLES, .topology = LOM_POINTS, .feedback = &kept
        };
        u->time = (float)n * u->step;
        set_attributes(&draw, state[0]);
        lom_begin_pass(device, &(lom_pass_desc){ .feedback_only = true });
        lom_draw(device, &draw);
        if (!lom_end_pass(device))
            return false;
        float *swap = state[0];
        state[0] = state[1];
        state[1] = swap;
    }
    return true;
}

int main(void)
{
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_texture *picture =
        lom_make_texture(device, &(lom_texture_desc){ .width = 640, .height = 360, .format = LOM_FORMAT_RGBA8_SRGB });
    float *state[2] = { malloc(BYTES), malloc(BYTES) };
    if (state[0] == NULL || state[1] == NULL)
        return 2;
    lom_mat4 view = lom_look_at((lom_vec3){ 0, 1.3, 6 }, (lom_vec3){ 0, 0.95, 0 }, (lom_vec3){ 0, 1, 0 });
    lom_mat4 projection = lom_perspective(0.6, 640.0 / 360.0, 0.1), clip = lom_multiply(&projection, &view);
    struct uniforms u = { .clip_from_world = lom_round_matrix(&clip), .step = 1.0f / 60.0f };
    start(state[0]);
    bool done = step_all(device, state, &u);

    lom_draw_desc draw = {
        .shader = &spark, .uniforms = &u, .count = PARTICLES, .topology = LOM_POINTS, .geometry = &squares
    };
    set_attributes(&draw, state[0]);
    draw.blend[0] = (lom_blend){ .enabled = true,
                                 .source_color = LOM_FACTOR_ONE,
                                 .target_color = LOM_FACTOR_ONE,
                                 .source_alpha = LOM_FACTOR_ONE,
                                 .target_alpha = LOM_FACTOR_ZERO };
    lom_begin_pass(device, &(lom_pass_desc){ .color = { picture }, .clear_color = { { 0.004f, 0.006f, 0.012f, 1 } } });
    lom_draw(device, &draw);
    done = lom_end_pass(device) && done;
    lom_image *image = done ? lom_read_texture(picture, 0, 0, &error) : NULL;
    done = image != NULL && lom_write_image("fountain.png", NULL, image, &error);
    if (done)
        printf("%016llx\n", (unsigned long long)lom_hash_image(image));
    else
        fprintf(stderr, "fountain: %s %s\n", lom_device_error(device)->text, error.text);
    lom_free_image(image);
    lom_close_device(device);
    free(state[0]);
    free(state[1]);
    return done ? 0 : 2;
}

#endif
