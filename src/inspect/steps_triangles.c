/* Pictures of all triangles of a pass. In: its triangles, told twice: to measure, then to draw. Out: the meshes; clip space;
 * what clipping cut; the window; what was culled; the tiles. Invariant: places are those that the stages computed. */
#include "inspect/steps_triangles.h"

#include "base/numbers.h"
#include "pipeline/stages.h"

#include <stdio.h>

static const struct ink ground = { { 0.055f, 0.065f, 0.085f }, 1 };
static const struct ink new_ink = { { 1.0f, 0.86f, 0.2f }, 1 };
static const struct ink lost_ink = { { 0.95f, 0.32f, 0.3f }, 0.9f };
static const struct ink own_ink = { { 1, 1, 1 }, 0.95f };
static const struct ink near_ink = { { 0.45f, 0.8f, 1 }, 0.95f };
static const struct ink guard_ink = { { 0.7f, 0.55f, 1.0f }, 0.9f };

/* ---- measuring ---- */

static void widen(struct range *r, double x, double y)
{
    const double at[2] = { x, y };
    for (int i = 0; i < 2; i++) {
        r->low[i] = !r->any || at[i] < r->low[i] ? at[i] : r->low[i];
        r->high[i] = !r->any || at[i] > r->high[i] ? at[i] : r->high[i];
    }
    r->any = true;
}

static void measure(struct all_triangles *a, const lom_told_triangle *t)
{
    a->all.of[t->corners - 1]++;
    a->reach[t->reach].of[t->corners - 1]++;
    a->cut.of[t->corners - 1] += t->cut;
    a->made += t->made;
    a->pieces += t->cut ? (uint64_t)t->pieces : 0;
    for (int k = 0; k < 3; k++) {
        double w = (double)t->clip[k][3], z = (double)t->clip[k][2];
        a->is_flat &= w == 1;
        a->has_near &= !a->any || z == a->near || z == 0; /* a sky lies at 0 */
        if (z != 0) {
            a->near = z;
            a->any = true;
        }
        if (t->reach == LOM_REACH_BINNED && z != 0)
            a->most_w = lom_larger(a->most_w, w);
        if (t->cut && (t->code[k] & LOM_OUT_GUARD) != 0)
            a->guard_width = t->desc->viewport.width;
        if (t->cut)
            widen(&a->range, (double)t->clip[k][0], w);
    }
    for (int i = 0; i < t->pieces && t->cut; i++)
        for (int k = 0; k < t->corners; k++)
            a->new_corners += t->piece[i].made[k];
    lom_measure_mesh(&a->meshes, t);
}

/* ---- clip space from above ---- */

static void place_above(const struct all_triangles *a, const float clip[4], double at[2])
{
    const struct canvas *c = &a->clip_space;
    double v = a->is_flat ? (double)clip[2] : (double)clip[3], most = a->is_flat ? 1 : a->most_w;
    double scale = c->height * 0.82 / most, across = a->is_flat ? c->height * 0.41 : scale;
    at[0] = c->width * 0.5 + (double)clip[0] * across;
    at[1] = c->height * 0.92 - v * scale;
}

/* As bright as it is large: what is less than a pixel is a haze. */
static struct ink fade(struct ink ink, const double a[2], const double b[2], double least)
{
    double size = lom_larger(lom_magnitude(a[0] - b[0]), lom_magnitude(a[1] - b[1]));
    ink.cover *= (float)lom_smaller(least + size / 30, 1);
    return ink;
}

void lom_draw_outline(struct canvas *canvas, const double (*at)[2], int corners, struct ink ink, double least)
{
    for (int k = 0; k < (corners == 2 ? 1 : corners); k++)
        lom_draw_line(canvas, at[k], at[(k + 1) % corners], fade(ink, at[k], at[(k + 1) % corners], least));
}

static void draw_clip_space(struct all_triangles *a, const lom_told_triangle *t)
{
    double at[3][2];
    for (int k = 0; k < 3; k++)
        place_above(a, t->clip[k], at[k]);
    struct ink ink = t->reach == LOM_REACH_BINNED ? lom_kept_ink : lom_reach_inks[LOM_REACH_BESIDE];
    if (t->corners == 1)
        lom_draw_dot(&a->clip_space, at[0], 1, ink);
    else
        lom_draw_outline(&a->clip_space, (const double(*)[2])at, t->corners, ink,
                         t->reach == LOM_REACH_BINNED ? 0.16 : 0.07);
}

static void draw_frustum(struct all_triangles *a)
{
    const float most = (float)a->most_w;
    const float perspective[4][4] = { { 0, 0, 0, 0 }, { -most, 0, 0, most }, { most, 0, 0, most }, { 0, 0, 0, 0 } };
    static const float box[4][4] = { { -1, 0, 0, 1 }, { -1, 0, 1, 1 }, { 1, 0, 1, 1 }, { 1, 0, 0, 1 } };
    double at[4][2];
    for (int i = 0; i < 4; i++)
        place_above(a, a->is_flat ? box[i] : perspective[i], at[i]);
    for (int i = 0; i < 4; i++)
        for (int twice = 0; twice < 2; twice++)
            lom_draw_line(&a->clip_space, at[i], at[(i + 1) % 4], lom_frame_ink);
    if (!a->is_flat)
        lom_draw_dot(&a->clip_space, at[0], 5, lom_frame_ink);
}

/* ---- what is cut ---- */

static void place_cut(const struct all_triangles *a, const float clip[4], double at[2])
{
    const struct canvas *c = &a->cut_canvas;
    const double size[2] = { c->width, c->height }, value[2] = { (double)clip[0], (double)clip[3] };
    for (int i = 0; i < 2; i++) {
        double way = lom_larger(a->range.high[i] - a->range.low[i], 1e-30);
        double share = (value[i] - a->range.low[i]) / way;
        at[i] = size[i] * (0.06 + 0.88 * (i == 0 ? share : 1 - share));
    }
}

static void draw_cut(struct all_triangles *a, const lom_told_triangle *t)
{
    struct canvas *c = &a->cut_canvas;
    double at[3][2];
    for (int k = 0; k < 3; k++)
        place_cut(a, t->clip[k], at[k]);
    for (int k = 0; k < 3; k++)
        lom_draw_line(c, at[k], at[(k + 1) % 3], lost_ink);
    for (int i = 0; i < t->pieces; i++) {
        for (int k = 0; k < 3; k++)
            place_cut(a, t->piece[i].clip[k], at[k]);
        for (int k = 0; k < 3; k++)
            lom_draw_line(c, at[k], at[(k + 1) % 3], lom_kept_ink);
        for (int k = 0; k < 3; k++)
            lom_draw_dot(c, at[k], t->piece[i].made[k] ? 4 : 2.5, t->piece[i].made[k] ? new_ink : own_ink);
    }
}

/* |x| = g w, GUARD_PIXELS from the middle of the view. */
static void draw_guard(struct all_triangles *a)
{
    for (int side = -1; side <= 1 && a->guard_width != 0; side += 2) {
        float reach = (float)a->range.high[1] * 2 * GUARD_PIXELS / (float)a->guard_width;
        const float from[4] = { 0, 0, 0, 0 }, to[4] = { (float)side * reach, 0, 0, (float)a->range.high[1] };
        double at[2][2];
        place_cut(a, from, at[0]);
        place_cut(a, to, at[1]);
        lom_draw_line(&a->cut_canvas, at[0], at[1], guard_ink);
    }
}

static void draw_near(struct all_triangles *a)
{
    const float plane[4] = { 0, 0, 0, (float)a->near };
    double at[2], from[2] = { 0, 0 }, to[2] = { a->cut_canvas.width, 0 };
    if (!a->has_near || !a->range.any)
        return;
    place_cut(a, plane, at);
    from[1] = to[1] = at[1];
    lom_draw_line(&a->cut_canvas, from, to, near_ink);
}

/* ---- what is told ---- */

static bool is_chosen(void *context, uint64_t number, const lom_pass_desc *pass)
{
    const struct all_triangles *a = context;
    (void)pass;
    return number == a->steps->chosen.number;
}

static void take_triangle(void *context, const lom_told_triangle *t)
{
    struct all_triangles *a = context;
    if (!a->draws) {
        measure(a, t);
        return;
    }
    lom_draw_meshes(&a->meshes, t);
    draw_clip_space(a, t);
    if (t->cut)
        draw_cut(a, t);
    for (int i = 0; i < t->pieces; i++)
        lom_draw_window(a, t, &t->piece[i]);
}

static void take_bin(void *context, const lom_rect *tile, size_t triangles)
{
    struct all_triangles *a = context;
    if (!a->draws)
        lom_count_bin(a->steps, &a->tiles, tile, triangles);
}

/* ---- pictures ---- */

static void add_clip_pictures(struct all_triangles *a)
{
    struct steps *s = a->steps;
    char all[MAX_COUNTED], drawn[MAX_COUNTED], cut[MAX_COUNTED], made[120] = "";
    if (a->made > 0)
        snprintf(made, sizeof made, " Stages behind the vertices made %llu of them.", (unsigned long long)a->made);
    lom_stage_picture *p = lom_add_picture(s, "Triangles", "vertex", "After the vertex shader",
                                           "src/pipeline/vertex.wide.c", lom_canvas_image(&a->clip_space, s->error),
                                           "Clip space from above: x to the right, %s. Each vertex of %s "
                                           "has been multiplied by its matrices; what "
                                           "lies within the lines (|x| <= w) can be seen.%s",
                                           a->is_flat ? "z upwards (1 is near); w is 1, there is no perspective"
                                                      : "w, the distance, upwards from the eye",
                                           lom_say_counted(&a->all, all), made);
    lom_add_legend(p, &lom_kept_ink, "what will be drawn: %s", lom_say_counted(&a->reach[LOM_REACH_BINNED], drawn));
    lom_add_legend(p, &lom_reach_inks[LOM_REACH_BESIDE], "what will not");
    lom_add_legend(p, &lom_frame_ink, a->is_flat ? "what the picture holds" : "the eye, and what it sees");
    if (!a->range.any)
        return;
    p = lom_add_picture(s, "Triangles", "clip", "Clipped", "src/pipeline/clip.c",
                        lom_canvas_image(&a->cut_canvas, s->error),
                        "What crosses a plane: %s, from above as before, near the eye. It is cut there; pieces left: "
                        "%llu. Both triangles at an edge get the same new vertex, so no gap opens.",
                        lom_say_counted(&a->cut, cut), (unsigned long long)a->pieces);
    lom_add_legend(p, &new_ink, "new vertices, made by clipping: %llu corners", (unsigned long long)a->new_corners);
    lom_add_legend(p, &own_ink, "vertices of the mesh");
    lom_add_legend(p, &lom_kept_ink, "what is left");
    lom_add_legend(p, &lost_ink, "what is cut off");
    if (a->guard_width != 0)
        lom_add_legend(p, &guard_ink, "the guard band, %d pixels beside the middle: what is further off is cut too",
                       GUARD_PIXELS);
    if (a->has_near)
        lom_add_legend(p, &near_ink, "the near plane, %g before the eye", a->near);
}

static bool make_canvases(struct all_triangles *a)
{
    struct steps *s = a->steps;
    struct canvas *const all[] = { &a->clip_space, &a->cut_canvas, &a->window, &a->fates, &a->bins };
    bool done = true;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        done = done && lom_make_canvas(all[i], s->width * s->zoom, s->height * s->zoom, ground, s->error);
    return done && lom_lay_cells(&a->meshes, &a->bins, s->error);
}

static void clear(struct all_triangles *a)
{
    struct canvas *const all[] = { &a->clip_space, &a->cut_canvas, &a->window, &a->fates, &a->bins };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        lom_clear_canvas(all[i]);
    lom_clear_meshes(&a->meshes);
    lom_release(a->tiles.count);
}

static void draw_lines_of_the_view(struct all_triangles *a)
{
    const struct steps *s = a->steps;
    const lom_pass_desc *pass = &s->chosen.desc;
    const float corner[2][3] = { { (float)pass->origin_x, (float)pass->origin_y, 0 },
                                 { (float)(pass->origin_x + s->width), (float)(pass->origin_y + s->height), 0 } };
    double from[2], to[2];
    lom_place_window(a, corner[0], true, from);
    lom_place_window(a, corner[1], true, to);
    for (int twice = 0; twice < 2; twice++)
        lom_draw_box(&a->window, from[0], from[1], to[0] - from[0], to[1] - from[1], lom_frame_ink);
    draw_frustum(a);
    lom_draw_tiles(s, &a->tiles, &a->bins);
}

/* Once to measure, once to draw. */
static void hear_twice(struct all_triangles *a)
{
    struct steps *s = a->steps;
    const lom_listener listener = { .context = a, .begins = is_chosen, .triangle = take_triangle, .bin = take_bin };
    s->last = s->chosen.number;
    s->failed |= !lom_draw_chosen(s, &listener) || !make_canvases(a);
    a->draws = true;
    a->most_w = a->most_w == 0 ? 1 : a->most_w;
    if (!s->failed) {
        draw_near(a);
        draw_guard(a);
        s->failed = !lom_draw_chosen(s, &listener);
    }
    if (a->meshes.failed)
        lom_fail(s->error, LOM_ERROR_MEMORY, "The system gave no memory for the list of a pass's draws.");
    s->failed |= s->error->code != LOM_OK;
}

void lom_picture_triangles(struct steps *s)
{
    struct all_triangles *a = lom_allocate(1, sizeof *a, s->error);
    if (a == NULL) {
        s->failed = true;
        return;
    }
    a->steps = s;
    a->is_flat = a->has_near = true;
    hear_twice(a);
    s->primitives = a->all;
    if (!s->failed && lom_any_counted(&a->all)) {
        draw_lines_of_the_view(a);
        if (a->meshes.cells > 0)
            lom_picture_mesh(s, &a->meshes);
        add_clip_pictures(a);
        lom_add_window_pictures(a);
    }
    clear(a);
    lom_release(a);
}
