/* Proves what is recorded of the tests of fragments: where several fragments of a packet lie at one pixel, each is
 * told what was there when its turn came, of tests before and behind the shader; who fails the stencil test is told
 * so, apart from who fails for depth, and `lom explain` has a sentence of it. */
#include <lom/inspect.h>

#include "../pipeline/stage.h"

enum { SIZE = 16, COLUMN = 9, ROW = 6, FRAGMENTS = 11 };

static void show_late(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
    out->discard = in->varying[3] < lom_splat(0.25f);
}

static void show_depth(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show_values(out, in, uniforms);
    out->depth = in->varying[2];
}

LOM_SHADER(early, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(late, place_values, show_late, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .discards = true,
           .colors = 1)
LOM_SHADER(deep, place_values, show_depth, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .writes_depth = true, .colors = 1)

static const lom_shader *const shaders[] = { &early, &late, &deep };
enum { SHADERS = sizeof shaders / sizeof shaders[0] };

/* Triangles that cover the one pixel alone, at these depths. */
static const float depths[FRAGMENTS] = {
    0.25f, 0.5f, 0.375f, 0.75f, 0.625f, 0.75f, 0.5f, 0.875f, 0.125f, 0.9375f, 0.5f
};
static vertex corners[3 * FRAGMENTS];

static void make_corners(void)
{
    static const int reach[3][2] = { { -100, -100 }, { -100, 140 }, { 140, -100 } };
    for (size_t i = 0; i < 3 * FRAGMENTS; i++) {
        vertex *v = &corners[i];
        place_at(v, COLUMN * 256 + 128 + reach[i % 3][0], ROW * 256 + 128 + reach[i % 3][1], SIZE);
        v->position[2] = depths[i / 3];
        v->value[0] = (float)(i / 3) / 255;
        v->value[2] = depths[i / 3];
        v->value[3] = i / 3 == 5 ? 0 : 1; /* the shader `late` drops it */
    }
}

static stage open_tests(void)
{
    stage s = { .device = open_device((lom_device_desc){ .threads = 1 }) };
    lom_texture_desc desc = { .width = SIZE, .height = SIZE, .format = LOM_FORMAT_RGBA32F };
    s.color = lom_make_texture(s.device, &desc);
    desc.format = LOM_FORMAT_DEPTH32F;
    desc.stencil = true;
    s.depth = lom_make_texture(s.device, &desc);
    return s;
}

static const lom_triangle_record *recorded(const stage *s, int draw)
{
    const lom_pixel_record *pixel = lom_watched_pixel(s->device, 0, COLUMN, ROW);
    const lom_draw_record *d = pixel != NULL && pixel->passes != NULL ? pixel->passes->draws : NULL;
    while (d != NULL && d->number != (size_t)draw)
        d = d->next;
    return d != NULL ? d->triangles : NULL;
}

/* One after the other: what is nearer is stored. */
static void check_turns(const stage *s, const lom_shader *shader, const char *how)
{
    float stored = 0;
    const lom_triangle_record *t = recorded(s, 0);
    for (int i = 0; i < FRAGMENTS; i++, t = t->next) {
        CHECK(t != NULL, "%s, %s: %d triangles", shader->name, how, i);
        if (t == NULL)
            return;
        const lom_fragment_record *f = &t->fragment;
        const bool dropped = shader == &late && i == 5, passes = !dropped && depths[i] > stored;
        CHECK(f->discarded == dropped && f->depth_tested == !dropped && (dropped || f->depth_passed == passes) &&
                  f->depth_written == passes && f->write[0].written == passes,
              "%s, %s, fragment %d: tested %d, passed %d, written %d", shader->name, how, i, f->depth_tested,
              f->depth_passed, f->write[0].written);
        CHECK(dropped || (f->depth == depths[i] && f->depth_before == stored), "%s, %s, fragment %d: %g before %g",
              shader->name, how, i, (double)f->depth, (double)f->depth_before);
        CHECK(t->fate == (dropped  ? LOM_FATE_DISCARDED
                          : passes ? (depths[i] == 0.9375f ? LOM_FATE_STORED : LOM_FATE_LOST)
                                   : LOM_FATE_DEPTH),
              "%s, %s, fragment %d: %s", shader->name, how, i, lom_fate_text(t->fate));
        stored = passes ? depths[i] : stored;
    }
    CHECK(t == NULL, "%s, %s: more triangles", shader->name, how);
}

static void fragments_at_one_pixel_are_told_their_turn(void)
{
    make_corners();
    for (int i = 0; i < SHADERS; i++)
        for (int counted = 0; counted < 2; counted++) { /* with a query the tests are those of samples */
            stage s = open_tests();
            lom_query *query = lom_make_query(s.device);
            lom_draw_desc draw = draw_of(shaders[i], corners, 3 * FRAGMENTS);
            draw.query = counted ? query : NULL;
            CHECK(lom_watch(s.device, &(lom_watch_desc){ .target = s.color, .x = COLUMN, .y = ROW }, 1));
            begin(&s, (lom_pass_desc){ .label = "turns" });
            lom_draw(s.device, &draw);
            finish(&s);
            check_turns(&s, shaders[i], counted ? "counted" : "plain");
            close_stage(&s);
        }
}

/* ---- stencil ---- */

/* Of a target that begins with the code 7: draw 0 replaces it by itself; 1 passes; 2 asks for another code; 3 asks
 * for it behind what is stored, and 4 asks for the right one there; 5 fails by the one bit that it reads. */
static const struct tried {
    uint8_t reference, read_off;
    float depth;
    lom_fate fate;
} tried[] = {
    { 7, 0, 0.25f, LOM_FATE_LOST },     { 7, 0, 0.5f, LOM_FATE_STORED },  { 6, 0, 0.75f, LOM_FATE_STENCIL },
    { 6, 0, 0.125f, LOM_FATE_STENCIL }, { 7, 0, 0.125f, LOM_FATE_DEPTH }, { 3, 0xfb, 0.75f, LOM_FATE_STENCIL }
};
enum { TRIED = sizeof tried / sizeof tried[0], ALL = (1 << TRIED) - 1, FAILING = 1 << 2 | 1 << 3 | 1 << 5 };

struct masked {
    stage s;
    const lom_shader *shader;
    unsigned which; /* a bit for each that is drawn */
    vertex corner[TRIED][3];
};

static lom_image *draw_masked(void *context, lom_error *error)
{
    static const float at[3][2] = { { -1, -1 }, { 3, -1 }, { -1, 3 } };
    struct masked *m = context;
    begin(&m->s, (lom_pass_desc){ .label = "masked", .clear_stencil = 7 });
    for (int i = 0; i < TRIED; i++) {
        for (int k = 0; k < 3; k++)
            m->corner[i][k] = (vertex){ .position = { at[k][0], at[k][1], tried[i].depth, 1 },
                                        .value = { 0.5f, 0.5f, tried[i].depth, 1 } };
        lom_draw_desc draw = draw_of(m->shader, m->corner[i], 3);
        draw.label = i == 1 ? "a plate" : "a thing";
        draw.stencil = (lom_stencil){ .enabled = true,
                                      .front = { .compare = LOM_COMPARE_EQUAL,
                                                 .pass = LOM_STENCIL_REPLACE,
                                                 .reference = tried[i].reference,
                                                 .read_off = tried[i].read_off } };
        if ((m->which >> i & 1) != 0)
            lom_draw(m->s.device, &draw);
    }
    finish(&m->s);
    return lom_read_texture(m->s.color, 0, 0, error);
}

static void failing_the_stencil_test_is_a_fate(void)
{
    for (int i = 0; i < SHADERS; i++) {
        struct masked m = { .s = open_tests(), .shader = shaders[i], .which = ALL };
        CHECK(lom_watch(m.s.device, &(lom_watch_desc){ .target = m.s.color, .x = COLUMN, .y = ROW }, 1));
        lom_free_image(draw_masked(&m, NULL));
        for (int d = 0; d < TRIED; d++) {
            const lom_triangle_record *t = recorded(&m.s, d);
            CHECK(t != NULL && t->next == NULL && t->fate == tried[d].fate, "%s, draw %d: %s", shaders[i]->name, d,
                  t != NULL ? lom_fate_text(t->fate) : "nothing");
            const bool failed = tried[d].fate == LOM_FATE_STENCIL;
            CHECK(t != NULL && t->fragment.stencil_failed == failed && t->fragment.depth_tested == !failed &&
                      t->fragment.shaded == (i != 0 || tried[d].fate < LOM_FATE_DEPTH),
                  "%s, draw %d", shaders[i]->name, d);
        }
        close_stage(&m.s);
    }
}

static void the_sentence_on_a_pixel_names_the_stencil_test(void)
{
    static const struct {
        unsigned which;
        const char *sentence;
    } said[] = { { FAILING, "All was rejected here (3 failed the stencil test): it keeps the clear value of pass "
                            "\"masked\"." },
                 { ALL,
                   "a plate (shader %s, triangle 0 of draw 1 in pass \"masked\") wrote this; what was stored is lost "
                   "to it: a thing (shader %s, triangle 0 of draw 0 in pass \"masked\"). Rejected: 1 failed the depth "
                   "test, 3 failed the stencil test." } };
    for (int i = 0; i < SHADERS; i++)
        for (size_t k = 0; k < sizeof said / sizeof said[0]; k++) {
            struct masked m = { .s = open_tests(), .shader = shaders[i], .which = said[k].which };
            const lom_drawing drawing = { .device = m.s.device, .context = &m, .draw = draw_masked };
            char expected[LOM_MAX_VERDICT];
            lom_error error = { .code = LOM_OK };
            lom_explanation *e = lom_explain_drawing(&drawing, m.s.color, COLUMN, ROW, 0, &error);
            snprintf(expected, sizeof expected, said[k].sentence, shaders[i]->name, shaders[i]->name);
            CHECK(e != NULL && strcmp(e->item[0].verdict, expected) == 0, "%s: %s", shaders[i]->name,
                  e != NULL ? e->item[0].verdict : error.text);
            lom_free_drawing_explanation(&drawing, e);
            close_stage(&m.s);
        }
}

int main(int argc, char **argv)
{
    RUN(fragments_at_one_pixel_are_told_their_turn);
    RUN(failing_the_stencil_test_is_a_fate);
    RUN(the_sentence_on_a_pixel_names_the_stencil_test);
    return check_result();
}
