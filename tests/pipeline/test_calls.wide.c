/* Proves that draws which share a checked descriptor and copies of uniforms, since they differ in little or come back
 * (call.c), and chunks (join.c), leave what the same draws leave each in a pass of its own, where nothing is shared; at
 * this width. The descriptors of hundreds of draws come from a few states and fixed random numbers: which triangles of the
 * indices (also earlier ones, and places that are no multiple of three), which uniforms, shader, cull, blend, scissor,
 * depth test. The triangles are small and large, near one another and scattered, inside and clipped. And that what is wrong
 * in a draw that is like one before is an error as ever. Draws that are held (draw_again.h) likewise, with vertices
 * that are moved, also to where there are none. */
#include "pipeline/device.h"
#include "pipeline/draw_again.h"
#include "stage.h"

enum { WIDTH = 160, HEIGHT = 96, TRIANGLES = 60, DRAWS = 600, STATES = 9, TINTS = 7 };

struct tint {
    float matrix[16]; /* what all share, in front */
    float color[4];
    char tail; /* no whole number of words */
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct tint *tint = uniforms;
    out->position = in->attribute[0];
    out->position.x = out->position.x * tint->matrix[0] + tint->matrix[12];
    out->varying[0] = in->attribute[1].x;
    out->varying[1] = in->attribute[1].y;
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct tint *tint = uniforms;
    lom_float low = lom_splat(tint->color[2] + (float)tint->tail * 0.0625f);
    out->color[0] = (lom_float4){ in->varying[0] * tint->color[0], in->varying[1] + tint->color[1], low, low * 0.5f };
}

/* A colour alone: found once a draw (paint.wide.c), so never shared. */
static void paint(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct tint *tint = uniforms;
    (void)in;
    out->color[0] = (lom_float4){ lom_splat(tint->color[0]), lom_splat(tint->color[1]), lom_splat(tint->color[2]),
                                  lom_splat(0.25f) };
}

LOM_SHADER(varied, place, show, .attributes = 2, .varyings = 2, .reads = LOM_VARYINGS(0, 2), .colors = 1,
           .uniforms_size = sizeof(struct tint))
LOM_SHADER(painted, place, paint, .attributes = 2, .varyings = 2, .colors = 1, .uniforms_size = sizeof(struct tint))

static vertex vertices[3 * TRIANGLES];
static uint32_t indices[3 * TRIANGLES];

/* Of each third of the vertices most triangles are of neighbours, some of any; every second heap of 18 is small, and in the
 * last third some vertices are before near. */
static void make_scene(void)
{
    random_draws = 0;
    float x = 0, y = 0;
    for (size_t i = 0; i < 3 * TRIANGLES; i++) {
        vertex *v = &vertices[i];
        const float w = random_float(0.5f, 2), reach = i / 18 % 2 == 0 ? 0.15f : 1;
        if (i % 18 == 0) {
            x = reach < 1 ? random_float(-0.8f, 0.8f) : 0;
            y = reach < 1 ? random_float(-0.8f, 0.8f) : 0;
        }
        v->position[0] = (x + random_float(-reach, reach)) * w;
        v->position[1] = (y + random_float(-reach, reach)) * w;
        v->position[2] = random_float(0, i > 2 * TRIANGLES && i % 4 == 0 ? 1.5f : 1) * w;
        v->position[3] = w;
        for (int k = 0; k < 8; k++)
            v->value[k] = random_float(0, 1);
        const size_t near = i + (size_t)random_whole(0, 5);
        const bool scattered = i % TRIANGLES > TRIANGLES - 15 || near >= 3 * TRIANGLES;
        indices[i] = scattered ? (uint32_t)random_whole(0, 3 * TRIANGLES - 1) : (uint32_t)near;
    }
}

static lom_draw_desc state(int number)
{
    lom_draw_desc desc = draw_of(number == 3 ? &painted : &varied, vertices, 3 * TRIANGLES);
    desc.indices = indices;
    desc.cull = number == 1 ? LOM_CULL_NONE : LOM_CULL_BACK;
    desc.front_clockwise = number == 2;
    desc.depth_write_off = number == 4;
    desc.blend[0] = number == 4 || number == 3 ? adding() : (lom_blend){ 0 };
    desc.scissor = number == 5 ? (lom_rect){ 20, 10, 70, 60 } : (lom_rect){ 0 };
    desc.instances = number == 6 ? 2 : 0;
    desc.topology = number == 7 ? LOM_TRIANGLE_STRIP : LOM_TRIANGLES;
    desc.indices = number == 8 ? NULL : desc.indices;
    return desc;
}

/* Draw i of the scene; states and tints often follow one another, and come back. */
static void draw(stage *s, size_t i)
{
    struct tint tint;
    lom_draw_desc desc;
    random_draws = 10000 + 16 * i;
    const bool comes_back = i % 9 == 0;
    desc = state(comes_back ? (int)random_whole(0, STATES - 1) : (int)(i / 100));
    const int number = (int)random_whole(0, TINTS - 1);
    memset(&tint, 0, sizeof tint);
    tint.matrix[0] = number % 2 == 0 ? 1 : -1;
    tint.matrix[12] = 0.0625f * (float)(number % 3);
    for (int k = 0; k < 4; k++)
        tint.color[k] = 0.125f * (float)((number + k) % TINTS);
    tint.tail = (char)(number == 6);
    desc.uniforms = &tint;
    desc.first = (size_t)random_whole(0, 3 * TRIANGLES - 30);
    desc.first -= i % 5 != 0 ? desc.first % 3 : 0;
    desc.count = (size_t)random_whole(0, 30);
    desc.attribute[2] = (lom_attribute){ .stride = i }; /* which no shader has: as good as the same */
    lom_draw(s->device, &desc);
    memset(&tint, 0x55, sizeof tint); /* lom_draw has copied it */
}

static lom_pass_desc kept(bool keeps)
{
    const lom_load_action load = keeps ? LOM_LOAD_KEEP : LOM_LOAD_CLEAR;
    return (lom_pass_desc){ .color_load = { load }, .depth_load = load };
}

/* Calls that share a chunk with the one before. */
static size_t count_joined(const stage *s)
{
    const struct lom_pass *pass = &s->device->pass;
    size_t joined = 0;
    for (size_t i = 0; i < pass->call_count; i += lom_joined_calls(pass, i))
        joined += lom_joined_calls(pass, i) - 1;
    return joined;
}

static void draw_together_and_apart(lom_device_desc desc, size_t least_joined)
{
    stage together = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    stage apart = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    begin(&together, kept(false));
    for (size_t i = 0; i < DRAWS; i++)
        draw(&together, i);
    finish(&together);
    CHECK(count_joined(&together) >= least_joined, "%zu calls joined", count_joined(&together));
    for (size_t i = 0; i < DRAWS; i++) {
        begin(&apart, kept(i > 0));
        draw(&apart, i);
        CHECK(lom_end_pass(apart.device), "%s", lom_device_error(apart.device)->text);
    }
    begin(&apart, kept(true));
    finish(&apart);
    CHECK(same_images(together.image, apart.image), "colours differ");
    CHECK(same_images(together.depths, apart.depths), "depths differ");
    const lom_counters a = lom_device_counters(together.device), b = lom_device_counters(apart.device);
    CHECK(a.draws == DRAWS && b.draws == DRAWS, "%llu and %llu draws", (unsigned long long)a.draws,
          (unsigned long long)b.draws);
    CHECK(a.triangles == b.triangles && a.vertices == b.vertices && a.fragments == b.fragments,
          "%llu and %llu triangles, %llu and %llu vertices, %llu and %llu fragments", (unsigned long long)a.triangles,
          (unsigned long long)b.triangles, (unsigned long long)a.vertices, (unsigned long long)b.vertices,
          (unsigned long long)a.fragments, (unsigned long long)b.fragments);
    CHECK(a.fragments > 30000, "only %llu fragments", (unsigned long long)a.fragments);
    close_stage(&together);
    close_stage(&apart);
}

static void shared_draws_are_those_of_their_own_passes(void)
{
    draw_together_and_apart((lom_device_desc){ .threads = 2, .chunk = 16, .batch = 3 }, 50);
    draw_together_and_apart((lom_device_desc){ .threads = 2, .chunk = 100, .tile = 16 }, 100);
    draw_together_and_apart((lom_device_desc){ .threads = 1 }, 100);
}

/* Samples are not kept from pass to pass here: the other path is that of one triangle after the other. */
static void shared_draws_of_several_samples_are_those_one_by_one(void)
{
    lom_device_desc desc = { .threads = 2, .chunk = 200 };
    stage together = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH24);
    stage apart = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH24);
    apart.device->one_by_one = true;
    stage *const both[] = { &together, &apart };
    for (int i = 0; i < 2; i++) {
        begin(both[i], (lom_pass_desc){ .samples = 4 });
        for (size_t k = 0; k < DRAWS; k++)
            draw(both[i], k);
        finish(both[i]);
    }
    CHECK(count_joined(&together) > 100, "%zu calls joined", count_joined(&together));
    CHECK(count_joined(&apart) == 0, "%zu calls joined one by one", count_joined(&apart));
    CHECK(same_images(together.image, apart.image), "colours differ");
    CHECK(same_images(together.depths, apart.depths), "depths differ");
    close_stage(&together);
    close_stage(&apart);
}

/* The same vertices without a base vertex above 0. */
static lom_draw_desc move_vertices(const lom_draw_desc *desc)
{
    lom_draw_desc moved = *desc;
    for (int i = 0; i < 2 && desc->base_vertex > 0; i++) {
        lom_attribute *a = &moved.attribute[i];
        a->data = (const char *)a->data + (size_t)desc->base_vertex * a->stride;
        a->size -= (size_t)desc->base_vertex * a->stride;
        moved.base_vertex = 0;
    }
    return moved;
}

/* Of each state a draw of all triangles, held; then parts of them in an order of their own. What cannot be held is drawn. */
static void draw_parts(stage *s, bool holds)
{
    static const struct tint tint = { .matrix = { [0] = 1 }, .color = { 0.5f, 0.25f, 0.125f, 1 } };
    struct lom_held_draw held[STATES];
    lom_draw_desc descs[STATES];
    int held_count = 0;
    begin(s, kept(false));
    for (int i = 0; i < STATES; i++) {
        descs[i] = state(i);
        descs[i].uniforms = &tint;
        descs[i].count = 3 * TRIANGLES;
        held_count += holds && lom_hold_draw(s->device, &descs[i], &held[i]);
    }
    CHECK(held_count == (holds ? 6 : 0), "%d states are held", held_count);
    random_draws = 4;
    for (int i = 0, number = 0; i < DRAWS; i++) {
        if (i % 4 == 0) /* others are the same triangles of other vertices */
            number = (int)random_whole(0, STATES - 1);
        const size_t first = 3 * (size_t)random_whole(0, TRIANGLES - 10), count = 3 * (size_t)random_whole(0, 10);
        if (i % 4 == 0) {
            descs[number].first = first;
            descs[number].count = count;
        }
        if (descs[number].indices != NULL)
            descs[number].base_vertex = (int32_t)random_whole(-20, 20);
        const lom_draw_desc moved = move_vertices(&descs[number]);
        if (holds)
            lom_draw_held(s->device, &held[number], &descs[number]);
        else
            lom_draw(s->device, &moved);
    }
    finish(s);
}

/* Held draws that differ in their tints are one, and their parts in turn share chunks, as those of lom_draw do. */
static size_t draw_tints(stage *s, bool holds)
{
    struct tint tint[3];
    struct lom_held_draw held[3];
    lom_draw_desc desc = state(1);
    desc.count = 3 * TRIANGLES;
    begin(s, kept(false));
    for (int i = 0; i < 3; i++) {
        tint[i] = (struct tint){ .matrix = { [0] = 1 }, .color = { 0.25f * (float)i, 0.5f, 0.125f, 1 } };
        desc.uniforms = &tint[i];
        CHECK(!holds || (lom_hold_draw(s->device, &desc, &held[i]) && held[i].draw == held[0].draw), "tint %d", i);
    }
    desc.count = 3;
    for (int i = 0; i < TRIANGLES; i++) {
        desc.uniforms = &tint[i % 3];
        desc.first = 3 * (size_t)(i * 7 % TRIANGLES);
        if (holds)
            lom_draw_held(s->device, &held[i % 3], &desc);
        else
            lom_draw(s->device, &desc);
    }
    finish(s);
    return count_joined(s);
}

static void held_draws_of_several_uniforms_share_chunks(void)
{
    lom_device_desc desc = { .threads = 2 };
    stage one = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    stage other = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    other.device->one_by_one = true;
    const size_t joined = draw_tints(&one, true), apart = draw_tints(&other, false);
    CHECK(joined == TRIANGLES - 1 && apart == 0, "%zu and %zu calls joined", joined, apart);
    CHECK(same_images(one.image, other.image), "colours differ");
    CHECK(same_images(one.depths, other.depths), "depths differ");
    close_stage(&one);
    close_stage(&other);
}

static void held_draws_are_those_of_descriptors(void)
{
    lom_device_desc desc = { .threads = 2, .chunk = 16, .batch = 3 };
    stage one = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    stage other = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    draw_parts(&one, true);
    draw_parts(&other, false);
    CHECK(same_images(one.image, other.image), "colours differ");
    CHECK(same_images(one.depths, other.depths), "depths differ");
    const lom_counters a = lom_device_counters(one.device), b = lom_device_counters(other.device);
    CHECK(a.draws == b.draws && a.triangles == b.triangles && a.vertices == b.vertices && a.fragments == b.fragments,
          "%llu and %llu draws, %llu and %llu triangles", (unsigned long long)a.draws, (unsigned long long)b.draws,
          (unsigned long long)a.triangles, (unsigned long long)b.triangles);
    close_stage(&one);
    close_stage(&other);
}

/* What the first draw did right does not hide what the second does wrong. */
static void errors_stay_errors(void)
{
    static const struct tint tint = { .color = { 1, 1, 1, 1 } };
    static const char *const texts[] = { "uniforms", "finite", "indices" };
    for (int i = 0; i < 3; i++) {
        stage s = open_stage((lom_device_desc){ .threads = 1 }, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH24);
        lom_draw_desc desc = state(0);
        desc.uniforms = &tint;
        begin(&s, kept(false));
        lom_draw(s.device, &desc);
        CHECK(lom_device_error(s.device)->code == LOM_OK, "%s", lom_device_error(s.device)->text);
        if (i == 0)
            desc.uniforms = NULL;
        else if (i == 1)
            desc.depth_bias = __builtin_inff();
        else
            desc.first = (size_t)UINT32_MAX + 3;
        lom_draw(s.device, &desc);
        CHECK(lom_device_error(s.device)->code != LOM_OK && strstr(lom_device_error(s.device)->text, texts[i]) != NULL,
              "draw %d: %s", i, lom_device_error(s.device)->text);
        lom_end_pass(s.device);
        close_stage(&s);
    }
}

int main(int argc, char **argv)
{
    make_scene();
    RUN(shared_draws_are_those_of_their_own_passes);
    RUN(shared_draws_of_several_samples_are_those_one_by_one);
    RUN(held_draws_of_several_uniforms_share_chunks);
    RUN(held_draws_are_those_of_descriptors);
    RUN(errors_stay_errors);
    return check_result();
}
