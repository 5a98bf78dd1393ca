/* Proves that whoever listens is told every triangle of a pass, in order, with how far it came: each of them was made to
 * end at one stage, clipping's new vertices are at the places of the closed form, the lists of the tiles hold what lies
 * in them, and the picture is that of a device to which nobody listens. */
#include "../pipeline/stage.h"

#include <lom/record.h>

enum { WIDTH = 128, HEIGHT = 64, MOST = 32 };

LOM_SHADER(shown, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

struct heard {
    lom_told_triangle triangle[MOST];
    lom_vertex_record vertex[3]; /* of the first triangle */
    size_t triangles, draws, ended;
    size_t bins[4]; /* of tiles of 32 pixels along x */
    uint64_t last;
    bool blends, wants;
};

static bool hear_pass(void *context, uint64_t number, const lom_pass_desc *pass)
{
    struct heard *h = context;
    CHECK(pass->color[0] != NULL);
    h->last = number;
    return h->wants;
}

static void hear_triangle(void *context, const lom_told_triangle *triangle)
{
    struct heard *h = context;
    if (h->triangles == 0)
        CHECK(lom_tell_vertices(triangle, h->vertex));
    if (h->triangles < MOST)
        h->triangle[h->triangles] = *triangle;
    h->triangles++;
}

static void hear_bin(void *context, const lom_rect *tile, size_t triangles)
{
    struct heard *h = context;
    CHECK(tile->width == 32 && tile->height == 32 && tile->x % 32 == 0 && tile->y % 32 == 0);
    h->bins[tile->x / 32] += triangles;
}

static void hear_end(void *context, uint64_t number, const lom_pass_desc *pass, size_t draws, bool blends)
{
    struct heard *h = context;
    lom_image *image = lom_read_texture(pass->color[0], 0, 0, NULL);
    CHECK(image != NULL && image->width == WIDTH && number == h->last);
    lom_free_image(image);
    h->draws = draws;
    h->blends = blends;
    h->ended++;
}

static lom_listener listener_of(struct heard *h)
{
    return (lom_listener){
        .context = h, .begins = hear_pass, .triangle = hear_triangle, .bin = hear_bin, .ended = hear_end
    };
}

/* A triangle for each end, by window positions in pixels: (x, y) at depth z, w 1. */
static const struct made {
    float corner[3][3];
    lom_reach reach;
} made[] = {
    { { { 2, 2, 0.5f }, { 2, 30, 0.5f }, { 30, 30, 0.5f } }, LOM_REACH_BINNED },      /* in the first tile */
    { { { 2, 2, 0.5f }, { 2, 30, 0.5f }, { 60, 30, 0.5f } }, LOM_REACH_BINNED },      /* in the first two */
    { { { 2, 2, 0.5f }, { 30, 30, 0.5f }, { 2, 30, 0.5f } }, LOM_REACH_FACING },      /* turned */
    { { { 200, 2, 0.5f }, { 200, 30, 0.5f }, { 230, 30, 0.5f } }, LOM_REACH_BESIDE }, /* to the right */
    { { { 70.6f, 9.6f, 0.5f }, { 70.6f, 9.9f, 0.5f }, { 70.9f, 9.9f, 0.5f } }, LOM_REACH_EMPTY },
    { { { 70, 9, 0.5f }, { 80, 9, 0.5f }, { 90, 9, 0.5f } }, LOM_REACH_EMPTY },   /* no area */
    { { { 2, 2, 1.5f }, { 2, 30, 1.5f }, { 30, 30, 1.5f } }, LOM_REACH_OUTSIDE }, /* before the near plane */
    { { { 64, 0, 0.5f }, { 64, 32, 0.5f }, { 96, 32, 2 } }, LOM_REACH_BINNED },   /* the last corner before it */
    { { { 64, 0, 2 }, { 64, 32, 2 }, { 96, 32, 0.5f } }, LOM_REACH_BINNED },      /* the first two before it */
};
enum { MADE = sizeof made / sizeof made[0] };

static void make_vertices(vertex v[3 * MADE])
{
    for (int i = 0; i < 3 * MADE; i++) {
        const float *at = made[i / 3].corner[i % 3];
        v[i] = (vertex){ .position = { 2 * at[0] / WIDTH - 1, 1 - 2 * at[1] / HEIGHT, at[2], 1 },
                         .value = { 0.2f, 0.4f, 0.6f, 1 } };
    }
}

static void draw_made(stage *s, const vertex v[3 * MADE])
{
    lom_draw_desc draw = draw_of(&shown, v, 3 * MADE);
    draw.cull = LOM_CULL_BACK;
    begin(s, (lom_pass_desc){ .clear_color = { { 0.1f, 0.2f, 0.3f, 1 } } });
    lom_draw(s->device, &draw);
    finish(s);
}

static void each_triangle_is_told_with_its_end(void)
{
    vertex v[3 * MADE];
    make_vertices(v);
    for (int round = 0; round < 6; round++) {
        lom_device_desc desc = { .threads = 1 + round % 3, .tile = 32, .chunk = 16, .batch = 1 + round % 2 };
        stage plain = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
        stage told = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
        static struct heard h;
        h = (struct heard){ .wants = true };
        lom_listener listener = listener_of(&h);
        CHECK(lom_listen(told.device, &listener));
        draw_made(&plain, v);
        draw_made(&told, v);
        CHECK(same_images(plain.image, told.image) && same_images(plain.depths, told.depths));
        CHECK(h.triangles == MADE && h.ended == 1 && h.draws == 1 && !h.blends && h.last == 0);
        for (int i = 0; i < MADE; i++) {
            const lom_told_triangle *t = &h.triangle[i];
            CHECK(t->reach == made[i].reach && t->number == (size_t)i, "%d: %s", i, lom_reach_text(t->reach));
            CHECK(memcmp(t->clip[1], v[3 * i + 1].position, sizeof t->clip[1]) == 0);
            CHECK(t->index[2] == (uint32_t)(3 * i + 2) && t->cut == (i >= 7) && (t->pieces == 0) == (i == 6));
        }
        CHECK(memcmp(h.vertex[2].clip, v[2].position, sizeof h.vertex[2].clip) == 0 && h.vertex[1].window[1] == 30);
        CHECK(h.triangle[1].piece[0].window[2][0] == 60 && h.triangle[1].piece[0].window[0][1] == 2);
        CHECK(lom_listen(told.device, NULL));
        draw_made(&told, v);
        CHECK(h.triangles == MADE && h.ended == 1 && same_images(plain.image, told.image));
        close_stage(&plain);
        close_stage(&told);
    }
}

/* t = dA / (dA - dB) of d = w - z: from 0.5 to -1 it is 1/3 of the way, from the depth 0.5 to 2. */
static void new_vertices_lie_where_the_plane_cuts(void)
{
    vertex v[3 * MADE];
    make_vertices(v);
    stage s =
        open_stage((lom_device_desc){ .threads = 1, .tile = 32 }, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    static struct heard h;
    h = (struct heard){ .wants = true };
    lom_listener listener = listener_of(&h);
    CHECK(lom_listen(s.device, &listener));
    draw_made(&s, v);
    const lom_told_triangle *quad = &h.triangle[7], *tip = &h.triangle[8];
    CHECK(quad->pieces == 2 && tip->pieces == 1);
    int own = 0, new_ones = 0;
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) {
            const float *at = quad->piece[i].window[k];
            bool first = at[1] < 16 + 5; /* on the edge from (64, 0): (64 + 32 / 3, 32 / 3), else (64 + 32 / 3, 32) */
            new_ones += quad->piece[i].made[k];
            own += !quad->piece[i].made[k];
            CHECK(quad->piece[i].made[k] == (at[0] != 64), "%g,%g", (double)at[0], (double)at[1]);
            if (quad->piece[i].made[k])
                CHECK(at[0] == 64 + 2731 / 256.0f && at[1] == (first ? 2731 / 256.0f : 32) && at[2] == 1);
        }
    CHECK(own == 3 && new_ones == 3);
    CHECK(tip->piece[0].made[0] + tip->piece[0].made[1] + tip->piece[0].made[2] == 2);
    for (int k = 0; k < 3; k++)
        CHECK(tip->piece[0].clip[k][2] <= tip->piece[0].clip[k][3]);
    close_stage(&s);
}

static void lists_hold_what_lies_in_their_tiles(void)
{
    vertex v[3 * MADE];
    make_vertices(v);
    stage s = open_stage((lom_device_desc){ .threads = 2, .tile = 32, .chunk = 16 }, WIDTH, HEIGHT, LOM_FORMAT_RGBA8,
                         LOM_FORMAT_DEPTH32F);
    static struct heard h;
    h = (struct heard){ .wants = true };
    lom_listener listener = listener_of(&h);
    CHECK(lom_listen(s.device, &listener));
    draw_made(&s, v);
    /* two in the first tile, one of them in the second too; two pieces and a tip in the third */
    CHECK(h.bins[0] == 2 && h.bins[1] == 1 && h.bins[2] == 3 && h.bins[3] == 0, "%zu %zu %zu %zu", h.bins[0], h.bins[1],
          h.bins[2], h.bins[3]);
    close_stage(&s);
}

static void a_pass_that_is_not_wanted_is_not_told(void)
{
    vertex v[3 * MADE];
    make_vertices(v);
    stage s = open_stage((lom_device_desc){ .threads = 1 }, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
    static struct heard h;
    h = (struct heard){ .wants = false };
    lom_listener listener = listener_of(&h);
    CHECK(lom_listen(s.device, &listener));
    draw_made(&s, v);
    lom_draw_desc draw = draw_of(&shown, v, 3);
    draw.blend[0] = adding();
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    lom_draw(s.device, &draw);
    finish(&s);
    CHECK(h.triangles == 0 && h.ended == 2 && h.last == 1 && h.draws == 2 && h.blends);
    begin(&s, (lom_pass_desc){ .samples = 1 });
    CHECK(!lom_listen(s.device, &listener) && strstr(lom_device_error(s.device)->text, "outside a pass") != NULL);
    CHECK(!lom_listen(s.device, NULL));
    CHECK(strcmp(lom_reach_text(LOM_REACHES), "unknown") == 0);
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(each_triangle_is_told_with_its_end);
    RUN(new_vertices_lie_where_the_plane_cuts);
    RUN(lists_hold_what_lies_in_their_tiles);
    RUN(a_pass_that_is_not_wanted_is_not_told);
    return check_result();
}
