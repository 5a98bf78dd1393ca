/* Proves that whoever listens is told of lines, points and sprites, and of what tessellation and geometry functions
 * made, as of triangles: how far each came, where it lies, of what it was made; and that the captions of `lom steps`
 * count each by its name. */
#include <lom/inspect.h>

#include "soup.h"
#include "inspect/steps.h"

enum { SIZE = 64, TRIANGLES = 40, MOST = 256 };

/* The first value is the size of a point; a sprite's half sides are (2, 0) and (0, 3) pixels. */
static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const lom_float zero = { 0 };
    place_values(out, in, uniforms);
    out->point_size = in->attribute[1].x;
    out->axis[0] = (lom_float4){ lom_splat(4.0f / SIZE), zero, zero, zero };
    out->axis[1] = (lom_float4){ zero, lom_splat(6.0f / SIZE), zero, zero };
}

static void place_triangles(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->point_size = in->attribute[1].x;
}

static void levels(lom_levels *out, const lom_patch *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    for (int i = 0; i < 3; i++)
        out->outer[i] = lom_splat(1);
    out->inner[0] = lom_splat(1);
}

LOM_SHADER(shown, place_triangles, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .colors = 1)
LOM_SHADER(plate, place, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1,
           .sprites = true)
LOM_GEOMETRY(handed_on, hand_on, .in = LOM_TRIANGLES, .out = LOM_TRIANGLE_STRIP, .vertices = 3)
LOM_TESSELLATION(uncut, levels, mix_corners, .domain = LOM_DOMAIN_TRIANGLES)

struct heard {
    lom_told_triangle told[MOST];
    lom_vertex_record vertex[MOST][3];
    size_t count, bins;
};

static bool begins(void *context, uint64_t number, const lom_pass_desc *pass)
{
    (void)context;
    (void)number;
    return pass->color[0] != NULL;
}

static void hear(void *context, const lom_told_triangle *told)
{
    struct heard *h = context;
    if (h->count < MOST) {
        h->told[h->count] = *told;
        CHECK(lom_tell_vertices(told, h->vertex[h->count]), "no memory");
    }
    h->count++;
}

static void hear_bin(void *context, const lom_rect *tile, size_t count)
{
    ((struct heard *)context)->bins += tile->width > 0 ? count : 0;
}

static void listen(const lom_draw_desc *draw, lom_device_desc how, struct heard *h)
{
    stage told = open_stage(how, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    stage plain = open_stage(how, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    h->count = h->bins = 0;
    CHECK(
        lom_listen(told.device, &(lom_listener){ .context = h, .begins = begins, .triangle = hear, .bin = hear_bin }));
    for (int i = 0; i < 2; i++) {
        stage *s = i == 0 ? &told : &plain;
        begin(s, (lom_pass_desc){ .samples = 1 });
        lom_draw(s->device, draw);
        finish(s);
    }
    CHECK(same_images(told.image, plain.image), "the picture is another where it is told");
    close_stage(&told);
    close_stage(&plain);
}

/* ---- what stages make ---- */

static vertex soup[3 * TRIANGLES];

/* Each triangle as it is, by a geometry function or as a patch that is not cut. */
static void what_stages_make_is_told_as_triangles_are(void)
{
    static struct heard plain, made;
    make_soup(soup, TRIANGLES);
    lom_draw_desc draw = draw_of(&shown, soup, 3 * TRIANGLES);
    listen(&draw, (lom_device_desc){ .threads = 1, .chunk = 16 }, &plain);
    CHECK(plain.count == TRIANGLES, "%zu triangles", plain.count);
    for (int kind = 0; kind < 2; kind++) {
        draw.geometry = kind == 0 ? &handed_on : NULL;
        draw.tessellation = kind == 0 ? NULL : &uncut;
        draw.topology = kind == 0 ? LOM_TRIANGLES : LOM_PATCHES;
        draw.patch_points = 3;
        listen(&draw, (lom_device_desc){ .threads = 2, .chunk = 32 }, &made);
        CHECK(made.count == TRIANGLES && made.bins == plain.bins, "kind %d: %zu triangles, %zu in lists", kind,
              made.count, made.bins);
        for (size_t i = 0; i < TRIANGLES; i++) {
            const lom_told_triangle *a = &plain.told[i], *b = &made.told[i];
            CHECK(!a->made && b->made && a->corners == 3 && b->corners == 3 && a->number == i && b->number == i &&
                      a->reach == b->reach && a->pieces == b->pieces && a->cut == b->cut,
                  "kind %d, triangle %zu: %s, %s", kind, i, lom_reach_text(a->reach), lom_reach_text(b->reach));
            for (int k = 0; k < 3; k++) {
                bool known = false;
                for (int other = 0; other < 3; other++)
                    known |= memcmp(plain.vertex[i][other].clip, made.vertex[i][k].clip, 16) == 0;
                CHECK(b->index[k] == UINT32_MAX && made.vertex[i][k].index == UINT32_MAX && known,
                      "kind %d, triangle %zu: vertex %d", kind, i, k);
            }
        }
    }
}

/* ---- points, sprites, lines ---- */

/* By window position in pixels, depth, size. */
static const struct dot {
    float x, y, depth, size;
    lom_reach of_point, of_sprite;
} dots[] = { { 10, 20, 0.5f, 4, LOM_REACH_BINNED, LOM_REACH_BINNED },
             { 40, 30, 0.5f, 1, LOM_REACH_BINNED, LOM_REACH_BINNED },
             { 50, 30, 0.5f, 0, LOM_REACH_EMPTY, LOM_REACH_BINNED },
             { 90, 30, 0.5f, 4, LOM_REACH_BESIDE, LOM_REACH_BESIDE },
             { 20, 20, 1.5f, 4, LOM_REACH_OUTSIDE, LOM_REACH_OUTSIDE } };
enum { DOTS = sizeof dots / sizeof dots[0] };

static void put(vertex *v, float x, float y, float depth, float size)
{
    *v = (vertex){ .position = { 2 * x / SIZE - 1, 1 - 2 * y / SIZE, depth, 1 }, .value = { size, 0.5f, 0.5f, 1 } };
}

static void points_and_sprites_are_told(void)
{
    static struct heard h;
    static const uint16_t indices[] = { 0, 1, UINT16_MAX, 2, 3, 999, 4 }; /* two are no vertices */
    static const size_t number[DOTS] = { 0, 1, 3, 4, 6 };
    vertex v[DOTS];
    for (int i = 0; i < DOTS; i++)
        put(&v[i], dots[i].x, dots[i].y, dots[i].depth, dots[i].size);
    for (int sprites = 0; sprites < 2; sprites++)
        for (int chunk = 16; chunk <= 64; chunk *= 4) {
            lom_draw_desc draw = draw_of(sprites ? &plate : &shown, v, 7);
            draw.vertex_count = DOTS;
            for (int a = 0; a < 5; a++)
                draw.attribute[a].size = sizeof v - 16 * (size_t)a;
            draw.indices = indices;
            draw.index_bits = 16;
            draw.restart = true;
            draw.topology = sprites ? LOM_SPRITES : LOM_POINTS;
            listen(&draw, (lom_device_desc){ .threads = 1, .chunk = chunk }, &h);
            CHECK(h.count == DOTS && h.bins == (sprites ? 3 : 2), "%zu, %zu in lists", h.count, h.bins);
            for (int i = 0; i < DOTS; i++) {
                const lom_told_triangle *t = &h.told[i];
                const lom_reach reach = sprites ? dots[i].of_sprite : dots[i].of_point;
                const float half[2] = { sprites ? 2 : dots[i].size / 2, sprites ? 3 : dots[i].size / 2 };
                CHECK(t->corners == 1 && !t->made && !t->cut && t->number == number[i] && t->index[0] == (uint32_t)i &&
                          t->reach == reach && t->pieces == (reach != LOM_REACH_OUTSIDE),
                      "%d, dot %d: number %zu, %s", sprites, i, t->number, lom_reach_text(t->reach));
                const float(*w)[3] = t->piece[0].window;
                CHECK(t->pieces == 0 ||
                          (w[0][0] == dots[i].x && w[0][1] == dots[i].y && w[0][2] == 0.5f &&
                           w[1][0] == dots[i].x + half[0] && w[1][1] == dots[i].y && w[2][0] == dots[i].x &&
                           (w[2][1] == dots[i].y + half[1] || w[2][1] == dots[i].y - half[1])),
                      "%d, dot %d: %g,%g to %g,%g and %g,%g", sprites, i, (double)w[0][0], (double)w[0][1],
                      (double)w[1][0], (double)w[1][1], (double)w[2][0], (double)w[2][1]);
                CHECK(h.vertex[i][0].index == (uint32_t)i && memcmp(h.vertex[i][0].clip, v[i].position, 16) == 0,
                      "%d, dot %d: its vertex", sprites, i);
            }
        }
}

/* Lines that are drawn, lie beside, cover nothing, are cut by the near plane, and lie before it. */
static void lines_are_told(void)
{
    static const float ends[][2][3] = { { { 4, 4, 0.5f }, { 30, 10, 0.5f } },
                                        { { 90, 4, 0.5f }, { 99, 10, 0.5f } },
                                        { { 4, 4, 0.5f }, { 4, 4, 0.5f } },
                                        { { 4, 40, 0.5f }, { 28, 40, 2 } },
                                        { { 4, 50, 2 }, { 28, 50, 2 } } };
    static const lom_reach reach[] = { LOM_REACH_BINNED, LOM_REACH_BESIDE, LOM_REACH_EMPTY, LOM_REACH_BINNED,
                                       LOM_REACH_OUTSIDE };
    enum { LINES = sizeof ends / sizeof ends[0] };
    static struct heard h;
    vertex v[2 * LINES];
    for (int i = 0; i < 2 * LINES; i++)
        put(&v[i], ends[i / 2][i % 2][0], ends[i / 2][i % 2][1], ends[i / 2][i % 2][2], 1);
    lom_draw_desc draw = draw_of(&shown, v, 2 * LINES);
    draw.topology = LOM_LINES;
    listen(&draw, (lom_device_desc){ .threads = 1 }, &h);
    CHECK(h.count == LINES, "%zu lines", h.count);
    for (int i = 0; i < LINES; i++) {
        const lom_told_triangle *t = &h.told[i];
        CHECK(t->corners == 2 && t->reach == reach[i] && t->cut == (i == 3) && t->number == (size_t)i &&
                  t->index[1] == (uint32_t)(2 * i + 1),
              "line %d: %s", i, lom_reach_text(t->reach));
    }
    /* a third of the way from 0.5 to 2 lies the near plane, z = w */
    CHECK(h.told[3].piece[0].window[1][0] == 12 && h.told[3].piece[0].made[1] && !h.told[3].piece[0].made[0]);
}

/* ---- captions ---- */

static void counts_are_said_by_their_names(void)
{
    static const struct {
        struct counted counted;
        const char *text;
    } said[] = { { { { 0, 0, 0 } }, "0 triangles" },
                 { { { 0, 0, 12 } }, "12 triangles" },
                 { { { 1, 0, 0 } }, "1 point" },
                 { { { 0, 1, 1 } }, "1 triangle and 1 line" },
                 { { { 3, 2, 1 } }, "1 triangle, 2 lines and 3 points" } };
    for (size_t i = 0; i < sizeof said / sizeof said[0]; i++) {
        char text[MAX_COUNTED];
        CHECK(strcmp(lom_say_counted(&said[i].counted, text), said[i].text) == 0, "%s", text);
    }
}

struct program {
    stage s;
    vertex v[3 + 4 + 5];
};

static lom_image *draw_program(void *context, lom_error *error)
{
    struct program *p = context;
    static const lom_topology topologies[] = { LOM_TRIANGLES, LOM_LINES, LOM_POINTS };
    static const size_t counts[] = { 3, 4, 5 };
    begin(&p->s, (lom_pass_desc){ .label = "kinds" });
    for (size_t i = 0, first = 0; i < 3; first += counts[i++]) {
        lom_draw_desc draw = draw_of(&shown, p->v + first, counts[i]);
        draw.topology = topologies[i];
        lom_draw(p->s.device, &draw);
    }
    finish(&p->s);
    return lom_read_texture(p->s.color, 0, 0, error);
}

static const char *text_of(const lom_stage_pictures *pictures, const char *name)
{
    for (size_t i = 0; i < pictures->count; i++)
        if (strcmp(pictures->picture[i].name, name) == 0)
            return pictures->picture[i].text;
    return "";
}

static void captions_count_each_kind(void)
{
    static const char *const names[] = { "mesh", "vertex", "cull", "bins" };
    struct program p = { .s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8,
                                         LOM_FORMAT_DEPTH32F) };
    const lom_drawing drawing = { .device = p.s.device, .context = &p, .draw = draw_program };
    lom_error error = { .code = LOM_OK };
    for (int i = 0; i < 12; i++)
        put(&p.v[i], (float)(5 * i), (float)(7 * i * i % 60), 0.5f, 3);
    lom_stage_pictures *pictures = lom_picture_drawing(&drawing, NULL, &error);
    CHECK(pictures != NULL, "%s", error.text);
    for (size_t i = 0; pictures != NULL && i < sizeof names / sizeof names[0]; i++)
        CHECK(strstr(text_of(pictures, names[i]), "1 triangle, 2 lines and 5 points") != NULL, "%s: %s", names[i],
              text_of(pictures, names[i]));
    lom_free_stage_pictures(pictures);
    close_stage(&p.s);
}

int main(int argc, char **argv)
{
    RUN(what_stages_make_is_told_as_triangles_are);
    RUN(points_and_sprites_are_told);
    RUN(lines_are_told);
    RUN(counts_are_said_by_their_names);
    RUN(captions_count_each_kind);
    return check_result();
}
