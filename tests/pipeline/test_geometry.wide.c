/* Proves of geometry functions: a function that hands its primitive on draws what a draw without it does, bit for bit, of
 * every topology, with depth, distances and clipping; what each primitive emits - none to 64 vertices in strips, by a
 * random number of its own - is drawn in the order of the primitives and of each one's vertices, which the same list made
 * by the test shows, whatever chunks, tiles and threads; points become squares and lines points of the given sizes;
 * vertices beyond the declared ones are dropped; what is refused. */
#include <lom/stages.h>

#include "stage.h"

enum { SIZE = 96, TRIANGLES = 300, VERTICES = 3 * TRIANGLES };

static vertex list[VERTICES];

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->distance[0] = in->attribute[3].x;
    out->point_size = in->attribute[3].y;
}

static void hand_on(lom_primitive_stream *out, const lom_geometry_input *in, int vertices)
{
    for (int i = 0; i < vertices; i++)
        lom_emit_vertex(out, &in->vertex[i], lom_splat_int(-1));
}

static void hand_on_points(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    hand_on(out, in, 1);
}

static void hand_on_lines(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    hand_on(out, in, 2);
}

static void hand_on_triangles(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    hand_on(out, in, 3);
}

LOM_SHADER(values, place, show_values, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1,
           .flat = LOM_VARYINGS(1, 1), .clip_distances = 1)
LOM_GEOMETRY(same_points, hand_on_points, .in = LOM_POINTS, .out = LOM_POINTS, .vertices = 1)
LOM_GEOMETRY(same_lines, hand_on_lines, .in = LOM_LINES, .out = LOM_LINE_STRIP, .vertices = 2)
LOM_GEOMETRY(same_triangles, hand_on_triangles, .in = LOM_TRIANGLES, .out = LOM_TRIANGLE_STRIP, .vertices = 3)

/* Vertices that primitive `number` emits. */
LOM_INLINE lom_int emitted_by(lom_int number)
{
    return number * 37 % 67 - 2;
}

/* Strips of 1 to 7 vertices about the first corner, the value of each what number it has. */
static void burst(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    lom_int count = emitted_by(in->number);
    for (int i = 0; i < 66; i++) {
        lom_vertex v = in->vertex[i % 3];
        v.position.x += v.position.w * (0.03f * (float)(i % 5));
        v.position.y += v.position.w * (0.04f * (float)(i % 7));
        v.varying[0] = lom_to_float(in->number * 100 + i);
        lom_emit_vertex(out, &v, count > i);
        lom_end_strip(out, (in->number + i) % 7 == 0);
    }
}

LOM_GEOMETRY(bursts, burst, .in = LOM_TRIANGLES, .out = LOM_TRIANGLE_STRIP, .vertices = 64)

/* A square about a point, and a point at either end of a line. */
static void square(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    for (int i = 0; i < 4; i++) {
        lom_vertex v = in->vertex[0];
        v.position.x += (i & 1 ? 0.125f : -0.125f) * v.position.w;
        v.position.y += (i & 2 ? 0.125f : -0.125f) * v.position.w;
        lom_emit_vertex(out, &v, lom_splat_int(-1));
    }
}

LOM_GEOMETRY(squares, square, .in = LOM_POINTS, .out = LOM_TRIANGLE_STRIP, .vertices = 4)
LOM_GEOMETRY(ends, hand_on_lines, .in = LOM_LINES, .out = LOM_POINTS, .vertices = 2)

static void make_list(void)
{
    for (size_t i = 0; i < VERTICES; i++) {
        vertex *v = &list[i];
        float w = i % 50 == 0 ? -0.5f : random_float(0.5f, 2);
        for (int k = 0; k < 2; k++)
            v->position[k] = random_float(-1.3f, 1.3f) * w;
        v->position[2] = random_float(-0.1f, 1.05f) * w;
        v->position[3] = w;
        for (int k = 0; k < 4; k++)
            v->value[k] = random_float(0, 1);
        v->distance[0] = random_float(-0.3f, 1);
        v->distance[1] = random_float(0, 9);
    }
}

static const lom_device_desc devices[] = { { .threads = 1 },
                                           { .threads = 3, .tile = 16, .chunk = 16, .batch = 2 },
                                           { .threads = 2, .tile = 32, .chunk = 256, .batch = 1 } };

static stage draw_on(const lom_device_desc *desc, lom_draw_desc draw)
{
    stage s = open_stage(*desc, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    finish(&s);
    return s;
}

static void compare_draws(lom_draw_desc a, lom_draw_desc b, const char *what)
{
    stage first = draw_on(&devices[0], a);
    for (size_t d = 0; d < 3; d++) {
        stage second = draw_on(&devices[d], b);
        CHECK(same_images(first.image, second.image) && same_images(first.depths, second.depths), "%s, device %zu",
              what, d);
        CHECK(lom_device_counters(first.device).triangles == lom_device_counters(second.device).triangles,
              "%s, device %zu: %llu", what, d, (unsigned long long)lom_device_counters(second.device).triangles);
        close_stage(&second);
    }
    close_stage(&first);
}

static void primitives_that_are_handed_on_stay_what_they_are(void)
{
    static const struct {
        const char *name;
        lom_topology topology;
        const lom_geometry *geometry;
    } cases[] = {
        { "triangles", LOM_TRIANGLES, &same_triangles }, { "strip", LOM_TRIANGLE_STRIP, &same_triangles },
        { "fan", LOM_TRIANGLE_FAN, &same_triangles },    { "lines", LOM_LINES, &same_lines },
        { "line strip", LOM_LINE_STRIP, &same_lines },   { "points", LOM_POINTS, &same_points },
    };
    uint16_t index[VERTICES];
    make_list();
    for (size_t i = 0; i < VERTICES; i++)
        index[i] = i % 17 == 16 ? UINT16_MAX : (uint16_t)(random_bits() % (VERTICES + 3));
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        lom_draw_desc draw = draw_of(&values, list, VERTICES), same;
        draw.topology = cases[i / 2].topology;
        if (i % 2 == 1) {
            draw.indices = index;
            draw.index_bits = 16;
            draw.restart = draw.topology != LOM_TRIANGLES && draw.topology != LOM_LINES;
        }
        same = draw;
        same.geometry = cases[i / 2].geometry;
        if (i % 2 == 0)
            compare_draws(draw, same, cases[i / 2].name);
        else { /* a draw counts what its indices leave out, too */
            stage a = draw_on(&devices[0], draw), b = draw_on(&devices[1], same);
            CHECK(same_images(a.image, b.image) && same_images(a.depths, b.depths), "%s with indices",
                  cases[i / 2].name);
            close_stage(&a);
            close_stage(&b);
        }
    }
}

/* What bursts emits, as a list of triangles. */
static vertex made[TRIANGLES * 62 * 3];

static vertex emitted(size_t number, int i)
{
    vertex v = list[3 * number + (size_t)i % 3];
    v.position[0] += v.position[3] * (0.03f * (float)(i % 5));
    v.position[1] += v.position[3] * (0.04f * (float)(i % 7));
    v.value[0] = (float)((int)number * 100 + i);
    return v;
}

static size_t list_bursts(void)
{
    size_t count = 0;
    for (size_t t = 0; t < TRIANGLES; t++) {
        int most = (int)(t * 37 % 67) - 2, start = 0;
        for (int i = 0; i < most && i < 64; i++) {
            if (i - start >= 2) {
                int turned = (i - start) % 2;
                made[count++] = emitted(t, i - 2 + turned);
                made[count++] = emitted(t, i - 1 - turned);
                made[count++] = emitted(t, i);
            }
            if (((int)t + i) % 7 == 0)
                start = i + 1;
        }
    }
    return count;
}

static void what_is_emitted_is_drawn_in_order(void)
{
    make_list();
    lom_draw_desc list_draw = draw_of(&values, made, list_bursts()), draw = draw_of(&values, list, VERTICES);
    draw.geometry = &bursts;
    draw.depth_test_off = list_draw.depth_test_off = true; /* the last one stays */
    CHECK(list_draw.count > 10000, "%zu vertices", list_draw.count);
    compare_draws(list_draw, draw, "bursts");
    draw.depth_test_off = list_draw.depth_test_off = false;
    compare_draws(list_draw, draw, "bursts with depth");
}

static void points_become_squares_and_lines_points(void)
{
    make_list();
    for (size_t i = 0; i < VERTICES; i++)
        for (int k = 0; k < 6; k++) { /* triangles 0, 1, 2 and 2, 1, 3 */
            int corner = (const int[]){ 0, 1, 2, 2, 1, 3 }[k];
            vertex *v = &made[6 * i + (size_t)k];
            *v = list[i];
            v->position[0] += (corner & 1 ? 0.125f : -0.125f) * v->position[3];
            v->position[1] += (corner & 2 ? 0.125f : -0.125f) * v->position[3];
        }
    lom_draw_desc plain = draw_of(&values, made, 6 * VERTICES), draw = draw_of(&values, list, VERTICES);
    draw.topology = LOM_POINTS;
    draw.geometry = &squares;
    compare_draws(plain, draw, "squares");
    plain = draw = draw_of(&values, list, VERTICES);
    plain.topology = LOM_POINTS;
    draw.topology = LOM_LINES;
    draw.geometry = &ends;
    compare_draws(plain, draw, "points");
}

/* The strip of the first `vertices` that are declared. */
static void vertices_beyond_the_declared_are_dropped(void)
{
    lom_geometry few = same_triangles;
    make_list();
    few.vertices = 2;
    lom_draw_desc draw = draw_of(&values, list, VERTICES);
    draw.geometry = &few;
    stage s = draw_on(&devices[1], draw);
    CHECK(lom_device_counters(s.device).triangles == 0 && lom_device_counters(s.device).vertices == VERTICES,
          "%llu triangles", (unsigned long long)lom_device_counters(s.device).triangles);
    close_stage(&s);
    few = same_lines;
    few.out = LOM_POINTS;
    few.vertices = 1;
    draw.topology = LOM_LINES;
    s = draw_on(&devices[1], draw);
    CHECK(lom_device_counters(s.device).triangles == VERTICES / 2, "%llu points",
          (unsigned long long)lom_device_counters(s.device).triangles);
    close_stage(&s);
}

static void expect(lom_geometry geometry, lom_topology topology, const char *words)
{
    stage s = open_stage(devices[0], 8, 8, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    lom_draw_desc draw = draw_of(&values, list, 6);
    draw.topology = topology;
    draw.geometry = &geometry;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    const char *text = lom_device_error(s.device)->text;
    CHECK(!lom_end_pass(s.device) && strstr(text, words) != NULL && text[strlen(text) - 1] == '.', "\"%s\", not \"%s\"",
          text, words);
    close_stage(&s);
}

static void what_makes_no_primitives_is_refused(void)
{
    lom_geometry g = same_triangles;
    expect(g, LOM_LINES, "takes triangles, but its draw is of lines");
    expect(same_points, LOM_TRIANGLE_FAN, "takes points, but its draw is of triangles");
    expect(g, LOM_SPRITES, "is of sprites");
    for (int i = 0; i < 2; i++) {
        g.vertices = i ? 65 : 0;
        expect(g, LOM_TRIANGLES, "1 to 64 vertices");
    }
    g = same_triangles;
    g.in = LOM_TRIANGLE_STRIP;
    expect(g, LOM_TRIANGLES, "or it is none");
    g = same_triangles;
    g.out = LOM_LINES;
    expect(g, LOM_TRIANGLES, "or it is none");
    g = same_triangles;
    memset(g.geometry, 0, sizeof g.geometry);
    expect(g, LOM_TRIANGLES, "was built for no width");
}

int main(int argc, char **argv)
{
    RUN(primitives_that_are_handed_on_stay_what_they_are);
    RUN(what_is_emitted_is_drawn_in_order);
    RUN(points_become_squares_and_lines_points);
    RUN(vertices_beyond_the_declared_are_dropped);
    RUN(what_makes_no_primitives_is_refused);
    return check_failed_tests != 0;
}
