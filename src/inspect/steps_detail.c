/* A few pixels, large. In: which triangle owns each pixel. Out: a picture of the place where most triangles meet: centres,
 * edges, and what each triangle covers. Invariant: what is filled was covered by the stages; edges are the snapped ones. */
#include "inspect/steps.h"

#include "base/numbers.h"

enum { COLUMNS = 32, ROWS = 18 };
static const struct ink ground = { { 0.055f, 0.065f, 0.085f }, 1 };
static const struct ink grid_ink = { { 0, 0, 0 }, 0.35f };
static const struct ink edge_ink = { { 1, 1, 1 }, 0.85f };
static const struct ink in_ink = { { 1, 1, 1 }, 0.9f };
static const struct ink out_ink = { { 0.5f, 0.55f, 0.6f }, 0.6f };

static uint64_t owner_at(const struct steps *s, int x, int y)
{
    return x < s->width && y < s->height ? s->owner[(size_t)y * (size_t)s->width + (size_t)x] : 0;
}

/* How many pixels differ from their neighbours: of draws, and of triangles. */
static void count_borders(const struct steps *s, int x, int y, int *draws, int *triangles)
{
    *draws = *triangles = 0;
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        int column = x + i % COLUMNS, row = y + i / COLUMNS;
        uint64_t own = owner_at(s, column, row), beside = owner_at(s, column + 1, row),
                 below = owner_at(s, column, row + 1);
        *draws += (own >> 32 != beside >> 32) + (own >> 32 != below >> 32);
        *triangles += (own != beside) + (own != below);
    }
}

/* Where things meet, and triangles are some pixels large. */
static void choose_place(const struct steps *s, int width, int height, int place[2])
{
    int best = -COLUMNS * ROWS;
    place[0] = place[1] = 0;
    for (int y = 0; y <= s->height - height; y += ROWS / 3)
        for (int x = 0; x <= s->width - width; x += COLUMNS / 4) {
            int draws, triangles;
            count_borders(s, x, y, &draws, &triangles);
            int worth = 2 * lom_smaller_int(draws, 60) - lom_magnitude_int(triangles - 420);
            if (worth > best) {
                best = worth;
                place[0] = x;
                place[1] = y;
            }
        }
}

struct detail {
    struct steps *steps;
    struct canvas canvas;
    int place[2], width, height, scale;
    uint64_t seen[COLUMNS * ROWS]; /* triangles whose edges are drawn */
    int count, partial;
};

static const lom_triangle_record *find_owner(const struct steps *s, const lom_pixel_record *pixel)
{
    const lom_triangle_record *owner = NULL;
    for (const lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->number == s->chosen.number ? pass->draws : NULL; draw != NULL;
             draw = draw->next)
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                if (lom_is_seen(s, t))
                    owner = t;
    return owner;
}

/* Whether an edge passes through the pixel's square: an edge function changes by half its extent to a corner. */
static bool is_partial(const lom_triangle_record *t)
{
    const lom_vertex_record *v = t->pieces > 0 ? t->cut : t->vertex;
    bool partial = !t->has_edges; /* a line */
    for (int i = 0; i < 3 && t->has_edges; i++) {
        const int32_t *a = v[t->order[(i + 1) % 3]].fixed, *b = v[t->order[(i + 2) % 3]].fixed;
        int64_t x = (int64_t)b[0] - a[0], y = (int64_t)b[1] - a[1];
        partial |= t->edge[i] < ((x < 0 ? -x : x) + (y < 0 ? -y : y)) * 128;
    }
    return partial;
}

static void draw_pixel(struct detail *d, const lom_triangle_record *t, int column, int row)
{
    int x = (column - d->place[0]) * d->scale, y = (row - d->place[1]) * d->scale;
    const double middle[2] = { x + d->scale * 0.5, y + d->scale * 0.5 };
    if (t != NULL) {
        bool partial = is_partial(t);
        d->partial += partial;
        uint64_t key = ((uint64_t)t->draw->number + 1) << 32 | (uint64_t)(t->number + 1);
        lom_fill_box(&d->canvas, x, y, d->scale, d->scale, lom_ink_of(key, partial ? 0.5f : 0.85f));
    }
    lom_draw_box(&d->canvas, x, y, d->scale, d->scale, grid_ink);
    lom_draw_dot(&d->canvas, middle, t != NULL ? 2 : 1.5, t != NULL ? in_ink : out_ink);
}

static void draw_edges(struct detail *d, const lom_triangle_record *t)
{
    const lom_vertex_record *v = t->pieces > 0 ? t->cut : t->vertex;
    const lom_pass_desc *pass = &d->steps->chosen.desc;
    const lom_rect *view = &t->draw->desc.viewport;
    uint64_t key = ((uint64_t)t->draw->number * 16 + (uint64_t)t->piece) << 32 | (uint64_t)t->number;
    for (int i = 0; i < d->count; i++)
        if (d->seen[i] == key)
            return;
    d->seen[d->count++] = key;
    double at[3][2];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 2; i++)
            at[k][i] =
                (v[k].fixed[i] / 256.0 + (i == 0 ? view->x - pass->origin_x : view->y - pass->origin_y) - d->place[i]) *
                d->scale;
    for (int k = 0; k < 3; k++)
        for (int twice = 0; twice < 2; twice++)
            lom_draw_line(&d->canvas, at[k], at[(k + 1) % 3], edge_ink);
    for (int k = 0; k < 3; k++)
        lom_draw_dot(&d->canvas, at[k], 3.5, edge_ink);
}

static void draw_detail(struct detail *d)
{
    lom_device *device = d->steps->device;
    for (int edges = 0; edges < 2; edges++)
        for (int i = 0; i < d->width * d->height; i++) {
            int x = d->place[0] + i % d->width, y = d->place[1] + i / d->width;
            const lom_triangle_record *t = find_owner(d->steps, lom_watched_pixel(device, 0, x, y));
            if (edges == 0)
                draw_pixel(d, t, x, y);
            else if (t != NULL)
                draw_edges(d, t);
        }
}

void lom_picture_detail(struct steps *s)
{
    struct detail d = { .steps = s,
                        .width = lom_smaller_int(COLUMNS, s->width),
                        .height = lom_smaller_int(ROWS, s->height) };
    d.scale = lom_larger_int(1, lom_smaller_int(s->width * s->zoom / d.width, s->height * s->zoom / d.height));
    choose_place(s, d.width, d.height, d.place);
    s->last = s->chosen.number;
    s->failed |= !lom_make_canvas(&d.canvas, d.width * d.scale, d.height * d.scale, ground, s->error) ||
                 !lom_watch_target(s, (lom_rect){ d.place[0], d.place[1], d.width, d.height }) ||
                 !lom_draw_chosen(s, NULL);
    if (!s->failed) {
        draw_detail(&d);
        lom_stage_picture *p = lom_add_picture(
            s, "Pixels", "coverage-detail", "Coverage, closely", "src/pipeline/raster.wide.c",
            lom_canvas_image(&d.canvas, s->error),
            "The pixels from %d,%d to %d,%d. A triangle covers a pixel when its centre (the dot) lies "
            "inside of all three "
            "edges; on an edge the top-left rule decides, so a pixel at a shared edge belongs to "
            "exactly one.%s Each "
            "has a colour of its own; %d pixels, the paler ones, are crossed by an edge of theirs.",
            d.place[0], d.place[1], d.place[0] + d.width - 1, d.place[1] + d.height - 1,
            s->primitives.of[1] == 0
                ? ""
                : " A line has the pixels whose diamonds it leaves, and as many beside each as it is wide.",
            d.partial);
        lom_add_legend(p, &edge_ink, "edges and vertices of what is seen here: %d", d.count);
    }
    lom_clear_canvas(&d.canvas);
}
