/* Proves of feedback: drawing equals drawing what the draw fed back, picture and depths, of every topology, indexed, with
 * restarts and instances; the buffer holds the vertices of whole primitives in order, those that the test lists itself; a
 * buffer that is too small holds the first whole primitives and nothing behind them, and says how many there were; draws of
 * a pass fill a buffer one after the other; a pass for feedback alone draws nothing and a step made of its own feedback
 * gives the same state on every device; what is refused. */
#include <lom/stages.h>

#include "stage.h"

enum { SIZE = 64, VERTICES = 240, MOST = 1 << 16 };

static vertex list[VERTICES];
static uint16_t indices[VERTICES];
static float captured[MOST], again[MOST];

/* The value of attribute 1 and which instance. */
static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->position.x += lom_to_float(in->instance) * 0.1f;
    out->varying[3] += lom_to_float(in->instance);
}

LOM_SHADER(values, place, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(plain, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

/* x' = 4 x (1 - x) in float: a step that forgets nothing. */
static void step(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    lom_float x = in->attribute[0].x;
    out->varying[0] = 3.9f * x * (1.0f - x);
    out->varying[1] = in->attribute[0].y + 1.0f;
}

LOM_DEPTH_SHADER(stepped, step, .attributes = 1, .varyings = 2)

static void make_list(void)
{
    for (size_t i = 0; i < VERTICES; i++) {
        float w = random_float(0.5f, 2);
        for (int k = 0; k < 3; k++)
            list[i].position[k] = (k < 2 ? random_float(-1.2f, 1.2f) : random_float(0, 1)) * w;
        list[i].position[3] = w;
        for (int k = 0; k < 4; k++)
            list[i].value[k] = (float)(8 * i) + (float)k;
        indices[i] = i % 19 == 18 ? UINT16_MAX : (uint16_t)(random_bits() % VERTICES);
    }
}

static const lom_device_desc devices[] = { { .threads = 1 },
                                           { .threads = 3, .tile = 16, .chunk = 16, .batch = 2 },
                                           { .threads = 2, .tile = 32, .chunk = 256, .batch = 1 } };

static stage draw_on(const lom_device_desc *desc, lom_draw_desc draw, lom_feedback *feedback)
{
    stage s = open_stage(*desc, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    draw.feedback = feedback;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    finish(&s);
    return s;
}

static lom_feedback all_of_it(float *data, size_t size)
{
    return (lom_feedback){ .data = data, .size = size, .position = true, .varyings = LOM_VARYINGS(0, 4) };
}

static lom_draw_desc draw_captured(const lom_feedback *f, lom_topology topology)
{
    return (lom_draw_desc){ .shader = &plain,
                            .attribute = { { f->data, f->size, 32, LOM_ATTRIBUTE_FLOAT4 },
                                           { f->data + 4, f->size - 16, 32, LOM_ATTRIBUTE_FLOAT4 } },
                            .count_from = f,
                            .topology = topology };
}

static const struct topology {
    lom_topology topology, list;
    int vertices;
} topologies[] = { { LOM_TRIANGLES, LOM_TRIANGLES, 3 },    { LOM_TRIANGLE_STRIP, LOM_TRIANGLES, 3 },
                   { LOM_TRIANGLE_FAN, LOM_TRIANGLES, 3 }, { LOM_LINES, LOM_LINES, 2 },
                   { LOM_LINE_STRIP, LOM_LINES, 2 },       { LOM_POINTS, LOM_POINTS, 1 } };
enum { TOPOLOGIES = sizeof topologies / sizeof *topologies };

static void drawing_equals_drawing_what_was_fed_back(void)
{
    make_list();
    for (size_t i = 0; i < 2 * TOPOLOGIES; i++) {
        const struct topology *t = &topologies[i / 2];
        lom_draw_desc draw = draw_of(&values, list, VERTICES);
        lom_feedback f = all_of_it(captured, sizeof captured);
        draw.topology = t->topology;
        draw.instances = 3;
        if (i % 2 == 1) {
            draw.indices = indices;
            draw.index_bits = 16;
            draw.restart = true;
        }
        stage alone = draw_on(&devices[0], draw, NULL), fed = draw_on(&devices[0], draw, &f);
        CHECK(f.written == f.needed && f.written % (size_t)t->vertices == 0 && f.written > 100, "%zu of %zu", f.written,
              f.needed);
        CHECK(same_images(alone.image, fed.image) && same_images(alone.depths, fed.depths), "case %zu: with feedback",
              i);
        for (size_t d = 0; d < 3; d++) {
            lom_feedback other = all_of_it(again, sizeof again);
            stage s = draw_on(&devices[d], draw, &other),
                  drawn = draw_on(&devices[d], draw_captured(&f, t->list), NULL);
            CHECK(other.written == f.written && memcmp(captured, again, f.written * 32) == 0, "case %zu, device %zu", i,
                  d);
            CHECK(same_images(alone.image, drawn.image) && same_images(alone.depths, drawn.depths),
                  "case %zu, device %zu", i, d);
            close_stage(&s);
            close_stage(&drawn);
        }
        close_stage(&alone);
        close_stage(&fed);
    }
}

/* Strips and fans without restart: vertex k of primitive p. */
static size_t corner_of(lom_topology topology, size_t p, size_t k)
{
    switch (topology) {
    case LOM_TRIANGLE_STRIP:
        return p + (k == 2 ? 2 : p % 2 == 0 ? k : 1 - k);
    case LOM_TRIANGLE_FAN:
        return k == 0 ? 0 : p + k;
    case LOM_LINE_STRIP:
        return p + k;
    default:
        return (topology == LOM_TRIANGLES ? 3 : topology == LOM_LINES ? 2 : 1) * p + k;
    }
}

static void the_buffer_holds_whole_primitives_in_order(void)
{
    make_list();
    for (size_t i = 0; i < TOPOLOGIES; i++)
        for (size_t room = 0; room < 40; room++) {
            const struct topology *t = &topologies[i];
            size_t n = (size_t)t->vertices, rest = room % 3; /* a part of a vertex more */
            lom_draw_desc draw = draw_of(&values, list, VERTICES);
            lom_feedback f = { .data = captured,
                               .size = room * 8 + rest * 2,
                               .varyings = LOM_VARYINGS(1, 1) | LOM_VARYINGS(3, 1) };
            draw.topology = t->topology;
            for (size_t k = 0; k < 96; k++)
                captured[k] = -1;
            stage s = draw_on(&devices[room % 3], draw, &f);
            size_t primitives = lom_device_counters(s.device).triangles;
            CHECK(lom_feedback_stride(&f) == 8 && f.needed == primitives * n && f.written == room / n * n,
                  "topology %zu, room for %zu: %zu of %zu", i, room, f.written, f.needed);
            for (size_t v = 0; v < f.written; v++) {
                float value = (float)(8 * corner_of(t->topology, v / n, v % n));
                CHECK(captured[2 * v] == value + 1 && captured[2 * v + 1] == value + 3,
                      "topology %zu, vertex %zu is %g", i, v, (double)captured[2 * v]);
            }
            for (size_t k = 2 * f.written; k < 96; k++)
                CHECK(captured[k] == -1, "topology %zu, room for %zu: word %zu was written", i, room, k);
            close_stage(&s);
        }
}

static void draws_of_a_pass_follow_one_another(void)
{
    make_list();
    lom_feedback f = { .data = captured, .size = 100 * 4, .varyings = LOM_VARYINGS(0, 1) };
    stage s = open_stage(devices[1], SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    for (int pass = 0; pass < 2; pass++) {
        begin(&s, (lom_pass_desc){ .samples = 1 });
        for (int i = 0; i < 3; i++) { /* 30 points, 31 lines of 62 vertices, 4 points: the lines fill 92, 4 more fit */
            lom_draw_desc draw = draw_of(&values, list, i == 0 ? 30 : i == 1 ? 62 : 4);
            draw.topology = i == 1 ? LOM_LINES : LOM_POINTS;
            draw.feedback = &f;
            draw.scissor = (lom_rect){ SIZE, SIZE, 1, 1 }; /* nothing is drawn */
            lom_draw(s.device, &draw);
        }
        finish(&s);
        CHECK(f.written == 96 && f.needed == 96, "pass %d: %zu of %zu", pass, f.written, f.needed);
        for (size_t i = 0; i < 96; i++)
            CHECK(captured[i] == (float)(8 * (i < 30   ? i
                                              : i < 92 ? i - 30
                                                       : i - 92)),
                  "vertex %zu is %g", i, (double)captured[i]);
    }
    CHECK(lom_device_counters(s.device).fragments == 0 && bytes_at(&s, 9, 9)[3] == 0, "something was drawn");
    f.size = 31 * 4; /* a line does not fit: the points after it are not written, either */
    begin(&s, (lom_pass_desc){ .samples = 1 });
    for (int i = 0; i < 3; i++) {
        lom_draw_desc draw = draw_of(&values, list, i == 0 ? 30 : i == 1 ? 2 : 1);
        draw.topology = i == 1 ? LOM_LINES : LOM_POINTS;
        draw.feedback = &f;
        lom_draw(s.device, &draw);
    }
    finish(&s);
    CHECK(f.written == 30 && f.needed == 33, "%zu of %zu", f.written, f.needed);
    close_stage(&s);
}

/* 200 steps of 1000 states to and fro between two buffers. */
static void a_state_is_stepped_by_feedback(void)
{
    enum { STATES = 1000, STEPS = 200 };
    for (size_t d = 0; d < 3; d++) {
        lom_device *device = open_device(devices[d]);
        float *from = captured, *to = again;
        for (size_t i = 0; i < STATES; i++) {
            from[2 * i] = (float)(i + 1) / (STATES + 2);
            from[2 * i + 1] = 0;
        }
        for (int n = 0; n < STEPS; n++) {
            lom_feedback f = { .data = to, .size = STATES * 8, .varyings = LOM_VARYINGS(0, 2) };
            lom_begin_pass(device, &(lom_pass_desc){ .feedback_only = true });
            lom_draw(device, &(lom_draw_desc){ .shader = &stepped,
                                               .attribute = { { from, STATES * 8, 8, LOM_ATTRIBUTE_FLOAT2 } },
                                               .count = STATES,
                                               .topology = LOM_POINTS,
                                               .feedback = &f });
            CHECK(lom_end_pass(device) && f.written == STATES, "%s", lom_device_error(device)->text);
            float *swap = from;
            from = to;
            to = swap;
        }
        for (size_t i = 0; i < STATES; i++) {
            float x = (float)(i + 1) / (STATES + 2);
            for (int n = 0; n < STEPS; n++)
                x = 3.9f * x * (1.0f - x);
            CHECK(from[2 * i] == x && from[2 * i + 1] == STEPS, "device %zu, state %zu: %a is not %a", d, i,
                  (double)from[2 * i], (double)x);
        }
        lom_counters c = lom_device_counters(device);
        CHECK(c.tiles == 0 && c.fragments == 0 && c.triangles_binned == 0 && c.vertices == STATES * STEPS, "it draws");
        lom_close_device(device);
    }
}

static void expect(lom_draw_desc first, lom_draw_desc second, const lom_pass_desc *pass, const char *words)
{
    stage s = open_stage(devices[0], 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    lom_pass_desc desc = *pass;
    if (!desc.feedback_only)
        desc.color[0] = s.color;
    lom_begin_pass(s.device, &desc);
    lom_draw(s.device, &first);
    lom_draw(s.device, &second);
    const char *text = lom_device_error(s.device)->text;
    CHECK(!lom_end_pass(s.device) && strstr(text, words) != NULL && text[strlen(text) - 1] == '.', "\"%s\", not \"%s\"",
          text, words);
    close_stage(&s);
}

static void what_cannot_be_fed_back_is_refused(void)
{
    lom_feedback f = all_of_it(captured, 3200), none = { .data = captured, .size = 64 }, other = f;
    const lom_draw_desc good = draw_of(&values, list, 6);
    const lom_pass_desc drawn = { .samples = 1 }, only = { .feedback_only = true };
    lom_draw_desc fed = good, bad = good;
    fed.feedback = &f;
    bad.feedback = &none;
    expect(good, bad, &drawn, "keeps nothing");
    other.varyings = LOM_VARYINGS(4, 1);
    bad.feedback = &other;
    expect(good, bad, &drawn, "varyings that the shader has not");
    other = f;
    other.data = NULL;
    expect(good, bad, &drawn, "has no memory");
    expect(fed, good, &only, "in a pass for feedback only");
    bad = draw_captured(&f, LOM_POINTS);
    expect(fed, bad, &drawn, "reads, or fills, feedback");
    expect(bad, fed, &drawn, "reads, or fills, feedback");
    bad.count_from = NULL; /* its memory alone */
    bad.count = 1;
    expect(fed, bad, &drawn, "reads, or fills, feedback");
    bad.feedback = &f;
    expect(good, bad, &drawn, "reads, or fills, feedback");
    stage s = open_stage(devices[0], 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    lom_begin_pass(s.device, &(lom_pass_desc){ .color = { s.color }, .feedback_only = true });
    CHECK(strstr(lom_device_error(s.device)->text, "has an attachment.") != NULL, "%s",
          lom_device_error(s.device)->text);
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(drawing_equals_drawing_what_was_fed_back);
    RUN(the_buffer_holds_whole_primitives_in_order);
    RUN(draws_of_a_pass_follow_one_another);
    RUN(a_state_is_stepped_by_feedback);
    RUN(what_cannot_be_fed_back_is_refused);
    return check_failed_tests != 0;
}
