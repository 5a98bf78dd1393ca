/* Proves of records of triangles that a stage behind the vertices made: a draw whose geometry function hands its triangles on is
 * recorded as the draw without it is - fate, edges, weights, clip positions, varyings - but that its vertices have no
 * index; of a tessellated patch the number is the patch's; the bytes are those of a device that watches nothing. */
#include <lom/record.h>

#include "soup.h"

enum { SIZE = 48, TRIANGLES = 40, WATCHED = 16 };

static vertex soup[3 * TRIANGLES];

static void levels(lom_levels *out, const lom_patch *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    for (int i = 0; i < 3; i++)
        out->outer[i] = lom_splat(3);
    out->inner[0] = lom_splat(2);
}

LOM_SHADER(shown, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_GEOMETRY(handed_on, hand_on, .in = LOM_TRIANGLES, .out = LOM_TRIANGLE_STRIP, .vertices = 3)
LOM_TESSELLATION(thirds, levels, mix_corners, .domain = LOM_DOMAIN_TRIANGLES)

/* The soup, with 4 x 4 pixels watched from (20, 20) on; image: what the target holds then. */
static stage draw_watched(const lom_geometry *geometry, const lom_tessellation *t, bool watch)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    lom_draw_desc draw = draw_of(&shown, soup, 3 * TRIANGLES);
    draw.geometry = geometry;
    draw.tessellation = t;
    if (t != NULL) {
        draw.topology = LOM_PATCHES;
        draw.patch_points = 3;
    }
    if (watch)
        CHECK(lom_watch(s.device, &(lom_watch_desc){ .target = s.color, .x = 20, .y = 20, .width = 4, .height = 4 }, 1),
              "%s", lom_device_error(s.device)->text);
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    finish(&s);
    return s;
}

static const lom_triangle_record *first_of(const lom_pixel_record *pixel)
{
    return pixel != NULL && pixel->passes != NULL && pixel->passes->draws != NULL ? pixel->passes->draws->triangles
                                                                                  : NULL;
}

static void compare_triangles(const lom_triangle_record *a, const lom_triangle_record *b, int pixel)
{
    CHECK(a->number == b->number && a->fate == b->fate && a->has_edges == b->has_edges && a->area == b->area &&
              a->front == b->front && a->piece == b->piece && a->pieces == b->pieces && a->covered == b->covered,
          "pixel %d: triangle %zu, %d and %zu, %d", pixel, a->number, a->fate, b->number, b->fate);
    CHECK(memcmp(a->edge, b->edge, sizeof a->edge) == 0 && memcmp(a->order, b->order, sizeof a->order) == 0,
          "pixel %d: edges", pixel);
    for (int k = 0; k < 3; k++) {
        const lom_vertex_record *v = &a->vertex[k], *w = &b->vertex[k];
        CHECK(v->index == 3 * a->number + (size_t)k && w->index == UINT32_MAX, "pixel %d: index %u, %u", pixel,
              v->index, w->index);
        CHECK(memcmp(v->clip, w->clip, sizeof v->clip) == 0 && memcmp(v->fixed, w->fixed, sizeof v->fixed) == 0 &&
                  memcmp(v->varying, w->varying, sizeof v->varying) == 0 && v->code == w->code && v->depth == w->depth,
              "pixel %d: vertex %d", pixel, k);
    }
}

static void triangles_that_are_handed_on_are_recorded_as_others(void)
{
    size_t seen = 0;
    make_soup(soup, TRIANGLES);
    stage plain = draw_watched(NULL, NULL, true), made = draw_watched(&handed_on, NULL, true);
    stage unwatched = draw_watched(&handed_on, NULL, false);
    CHECK(same_images(plain.image, made.image) && same_images(made.image, unwatched.image), "the bytes differ");
    for (int i = 0; i < WATCHED; i++) {
        const lom_triangle_record *a = first_of(lom_watched_pixel(plain.device, 0, 20 + i % 4, 20 + i / 4));
        const lom_triangle_record *b = first_of(lom_watched_pixel(made.device, 0, 20 + i % 4, 20 + i / 4));
        for (; a != NULL && b != NULL; a = a->next, b = b->next, seen++)
            compare_triangles(a, b, i);
        CHECK(a == NULL && b == NULL, "pixel %d: one has more triangles", i);
    }
    CHECK(seen > 50, "%zu triangles are recorded", seen);
    close_stage(&plain);
    close_stage(&made);
    close_stage(&unwatched);
}

static void patches_give_their_number(void)
{
    size_t stored = 0;
    make_soup(soup, TRIANGLES);
    stage made = draw_watched(NULL, &thirds, true), unwatched = draw_watched(NULL, &thirds, false);
    CHECK(same_images(made.image, unwatched.image), "the bytes differ");
    for (int i = 0; i < WATCHED; i++) {
        const lom_triangle_record *t = first_of(lom_watched_pixel(made.device, 0, 20 + i % 4, 20 + i / 4));
        for (; t != NULL; t = t->next) {
            const vertex *patch = &soup[3 * t->number];
            stored += t->fate == LOM_FATE_STORED;
            CHECK(t->number < TRIANGLES, "number %zu", t->number);
            for (int k = 0; k < 3 && t->number < TRIANGLES; k++)
                CHECK(memcmp(t->vertex[k].varying, patch->value, sizeof patch->value) == 0 &&
                          t->vertex[k].index == UINT32_MAX,
                      "pixel %d: patch %zu, vertex %d", i, t->number, k);
        }
    }
    CHECK(stored > 0, "nothing was stored");
    close_stage(&made);
    close_stage(&unwatched);
}

int main(int argc, char **argv)
{
    if (LOM_LANES != 4) {
        puts("SKIP what records has 4 lanes");
        return 0;
    }
    RUN(triangles_that_are_handed_on_are_recorded_as_others);
    RUN(patches_give_their_number);
    return check_failed_tests != 0;
}
