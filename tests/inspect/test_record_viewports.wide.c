/* Proves that draws which share a pass and have viewports of their own are recorded, told and tallied as they are in
 * passes that have these viewports: edges, areas, places, fates. */
#include <lom/record.h>

#include "soup.h"

enum { SIZE = 64, TRIANGLES = 60, DRAWS = 3, LEFT = 24, TOP = 18, WATCHED = 6, MOST = DRAWS * TRIANGLES };

static const lom_rect views[DRAWS] = { { 5, 3, 40, 31 }, { -11, 9, 70, 29 }, { 23, 17, 64, 64 } };
static vertex soup[3 * TRIANGLES];

LOM_SHADER(shown, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)

static stage open_small(void)
{
    return open_stage((lom_device_desc){ .threads = 1 }, SIZE, SIZE, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
}

/* In one pass, or each in its own, of which the later ones go on with what the earlier left. */
static void draw_soup(stage *s, bool apart)
{
    lom_draw_desc draw = draw_of(&shown, soup, 3 * TRIANGLES);
    lom_pass_desc pass = { .samples = 1 };
    draw.cull = LOM_CULL_BACK;
    for (int i = 0; i < DRAWS; i++) {
        pass.viewport = apart ? views[i] : (lom_rect){ 0 };
        draw.viewport = apart ? (lom_rect){ 0 } : views[i];
        if (apart || i == 0)
            begin(s, pass);
        lom_draw(s->device, &draw);
        if (apart || i == DRAWS - 1)
            finish(s);
        pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    }
}

/* ---- records ---- */

static size_t list_triangles(const lom_pixel_record *pixel, const lom_triangle_record *list[MOST])
{
    size_t count = 0;
    for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
            for (const lom_triangle_record *t = draw->triangles; t != NULL && count < MOST; t = t->next)
                list[count++] = t;
    return count;
}

static void compare(const lom_triangle_record *a, const lom_triangle_record *b)
{
    CHECK(a->number == b->number && a->fate == b->fate && a->has_edges == b->has_edges && a->area == b->area &&
              a->piece == b->piece && a->pieces == b->pieces && a->covered == b->covered,
          "triangle %zu, %s; %zu, %s", a->number, lom_fate_text(a->fate), b->number, lom_fate_text(b->fate));
    CHECK(memcmp(a->edge, b->edge, sizeof a->edge) == 0, "triangle %zu: edges", a->number);
    CHECK(memcmp(a->fragment.l, b->fragment.l, sizeof a->fragment.l) == 0 && a->fragment.z == b->fragment.z,
          "triangle %zu: weights", a->number);
    for (int k = 0; k < 3; k++)
        CHECK(memcmp(a->vertex[k].fixed, b->vertex[k].fixed, sizeof a->vertex[k].fixed) == 0 &&
                  memcmp(a->vertex[k].window, b->vertex[k].window, sizeof a->vertex[k].window) == 0,
              "triangle %zu, vertex %d: places", a->number, k);
}

static void records_are_those_of_passes_with_the_viewports(void)
{
    size_t seen = 0;
    make_soup(soup, TRIANGLES);
    stage s[2] = { open_small(), open_small() }, plain = open_small();
    const lom_watch_desc watch = { .x = LEFT, .y = TOP, .width = WATCHED, .height = WATCHED };
    for (int apart = 0; apart < 2; apart++) {
        lom_watch_desc desc = watch;
        desc.target = s[apart].color;
        CHECK(lom_watch(s[apart].device, &desc, 1), "%s", lom_device_error(s[apart].device)->text);
        draw_soup(&s[apart], apart != 0);
    }
    draw_soup(&plain, false);
    CHECK(same_images(s[0].image, s[1].image) && same_images(s[0].image, plain.image), "the pictures differ");
    for (int i = 0; i < WATCHED * WATCHED; i++) {
        const lom_triangle_record *list[2][MOST];
        size_t count[2];
        for (int k = 0; k < 2; k++)
            count[k] =
                list_triangles(lom_watched_pixel(s[k].device, 0, LEFT + i % WATCHED, TOP + i / WATCHED), list[k]);
        CHECK(count[0] == count[1], "pixel %d: %zu triangles, %zu", i, count[0], count[1]);
        for (size_t t = 0; t < count[0] && t < count[1]; t++)
            compare(list[0][t], list[1][t]);
        seen += count[0];
    }
    CHECK(seen > 300, "%zu triangles are recorded", seen);
    close_stage(&s[0]);
    close_stage(&s[1]);
    close_stage(&plain);
}

/* ---- what is told ---- */

struct heard {
    lom_told_triangle told[MOST];
    size_t count;
};

static bool begins(void *context, uint64_t number, const lom_pass_desc *pass)
{
    (void)context;
    (void)number;
    return pass->color[0] != NULL;
}

static void hear(void *context, const lom_told_triangle *triangle)
{
    struct heard *h = context;
    if (h->count < MOST)
        h->told[h->count] = *triangle;
    h->count++;
}

static void triangles_are_told_as_in_passes_with_the_viewports(void)
{
    static struct heard heard[2];
    size_t reached[LOM_REACHES] = { 0 };
    make_soup(soup, TRIANGLES);
    for (int apart = 0; apart < 2; apart++) {
        stage s = open_small();
        heard[apart].count = 0;
        CHECK(lom_listen(s.device, &(lom_listener){ .context = &heard[apart], .begins = begins, .triangle = hear }));
        draw_soup(&s, apart != 0);
        close_stage(&s);
    }
    CHECK(heard[0].count == MOST && heard[1].count == MOST, "%zu and %zu triangles", heard[0].count, heard[1].count);
    for (size_t i = 0; i < MOST; i++) {
        const lom_told_triangle *a = &heard[0].told[i], *b = &heard[1].told[i];
        reached[a->reach]++;
        CHECK(a->pieces == b->pieces && a->reach == b->reach, "triangle %zu: %s, %s", i, lom_reach_text(a->reach),
              lom_reach_text(b->reach));
        for (int p = 0; p < a->pieces; p++)
            CHECK(memcmp(a->piece[p].window, b->piece[p].window, sizeof a->piece[p].window) == 0, "triangle %zu", i);
    }
    for (int reach = LOM_REACH_FACING; reach < LOM_REACHES; reach++)
        CHECK(reach == LOM_REACH_EMPTY || reached[reach] > 0, "nothing is %s", lom_reach_text((lom_reach)reach));
}

/* ---- tallies ---- */

static void tallies_are_those_of_passes_with_the_viewports(void)
{
    uint64_t fragments = 0, made = 0;
    make_soup(soup, TRIANGLES);
    stage s[2] = { open_small(), open_small() };
    for (int apart = 0; apart < 2; apart++) {
        CHECK(lom_tally_target(s[apart].device, &(lom_tally_desc){ .target = s[apart].color }));
        draw_soup(&s[apart], apart != 0);
    }
    for (int i = 0; i < SIZE * SIZE; i++) {
        const lom_tally *a = lom_tallied(s[0].device, i % SIZE, i / SIZE);
        const lom_tally *b = lom_tallied(s[1].device, i % SIZE, i / SIZE);
        CHECK(a->fragments == b->fragments && a->killed == b->killed && a->edge == b->edge && a->area == b->area &&
                  a->made == b->made && a->at_made == b->at_made && a->depth == b->depth,
              "pixel %d,%d", i % SIZE, i / SIZE);
        fragments += a->fragments;
        made += (uint64_t)a->made;
    }
    CHECK(fragments > 5000 && made > 50, "%llu fragments, %llu vertices of clipping", (unsigned long long)fragments,
          (unsigned long long)made);
    close_stage(&s[0]);
    close_stage(&s[1]);
}

int main(int argc, char **argv)
{
    RUN(records_are_those_of_passes_with_the_viewports);
    RUN(triangles_are_told_as_in_passes_with_the_viewports);
    RUN(tallies_are_those_of_passes_with_the_viewports);
    return check_result();
}
