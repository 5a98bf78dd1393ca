/* Primitives in the window. In: what is told of them. Out: the window with what lies beside the frame; what set-up
 * left out, and why; what is in the lists of tiles. Invariant: places are those that were snapped. */
#include "inspect/steps_triangles.h"

#include "base/numbers.h"

const struct ink lom_frame_ink = { { 1.0f, 0.76f, 0.28f }, 0.95f };
const struct ink lom_kept_ink = { { 0.35f, 0.86f, 0.6f }, 0.9f };
const struct ink lom_reach_inks[LOM_REACHES] = {
    [LOM_REACH_OUTSIDE] = { { 0.45f, 0.5f, 0.6f }, 0.8f },  [LOM_REACH_FACING] = { { 0.95f, 0.32f, 0.3f }, 0.9f },
    [LOM_REACH_BESIDE] = { { 0.36f, 0.48f, 0.66f }, 0.7f }, [LOM_REACH_EMPTY] = { { 0.78f, 0.5f, 1.0f }, 0.9f },
    [LOM_REACH_BINNED] = { { 0.35f, 0.86f, 0.6f }, 0.9f },
};

enum { ROOM = 3 }; /* the frame takes 1 / (1 + 2 / ROOM) of the picture's width: 60 of 100 */

void lom_place_window(const struct all_triangles *a, const float window[3], bool whole, double at[2])
{
    const struct steps *s = a->steps;
    const int origin[2] = { s->chosen.desc.origin_x, s->chosen.desc.origin_y }, size[2] = { s->width, s->height };
    for (int i = 0; i < 2; i++) {
        double pixel = (double)window[i] - origin[i];
        at[i] = whole ? (pixel + (double)size[i] / ROOM) * s->zoom * ROOM / (ROOM + 2) : pixel * s->zoom;
    }
}

/* Whether all places lie beyond one side of a picture. */
static bool is_off(const struct canvas *c, const double (*at)[2], int count)
{
    const double size[2] = { c->width, c->height };
    for (int i = 0; i < 2; i++) {
        bool before = true, behind = true;
        for (int k = 0; k < count; k++) {
            before &= at[k][i] < 0;
            behind &= at[k][i] > size[i];
        }
        if (before || behind)
            return true;
    }
    return false;
}

/* Brighter the nearer it is: by the fourth root of the reversed depth. */
static struct ink dim(struct ink ink, const lom_told_piece *piece)
{
    double depth = ((double)piece->window[0][2] + (double)piece->window[1][2] + (double)piece->window[2][2]) / 3;
    double bright = 0.3 + 1.7 * lom_double_sqrt(lom_double_sqrt(lom_larger(depth, 0)));
    for (int c = 0; c < 3; c++)
        ink.color[c] *= (float)lom_smaller(bright, 1);
    return ink;
}

/* Corners of its outline: of a point or sprite with the middle m and the half sides a, b they are m - a - b, m + a -
 * b ... */
static int find_outline(const lom_told_triangle *t, const lom_told_piece *piece, float corner[4][3])
{
    static const int signs[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    memcpy(corner, piece->window, sizeof piece->window);
    if (t->corners > 1)
        return t->corners;
    for (int k = 0; k < 4; k++) {
        memcpy(corner[k], piece->window[0], sizeof corner[k]);
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < 2; i++)
                corner[k][i] += (float)signs[k][side] * (piece->window[side + 1][i] - piece->window[0][i]);
    }
    return 4;
}

void lom_draw_window(struct all_triangles *a, const lom_told_triangle *t, const lom_told_piece *piece)
{
    double at[4][2], inside[4][2];
    float corner[4][3];
    int count = find_outline(t, piece, corner);
    for (int k = 0; k < count; k++) {
        lom_place_window(a, corner[k], true, at[k]);
        lom_place_window(a, corner[k], false, inside[k]);
    }
    const double least = t->corners < 3 ? 0.5 : 0; /* what is no triangle is not of a thick net */
    bool is_drawn = piece->reach == LOM_REACH_BINNED, off = is_off(&a->fates, (const double(*)[2])inside, count);
    lom_draw_outline(&a->window, (const double(*)[2])at, count,
                     dim(off ? lom_reach_inks[LOM_REACH_BESIDE] : lom_kept_ink, piece),
                     lom_larger(least, off ? 0.12 : 0.08));
    lom_draw_outline(&a->fates, (const double(*)[2])inside, count, lom_reach_inks[piece->reach],
                     lom_larger(least, is_drawn ? 0.12 : 0.2));
    if (is_drawn)
        lom_draw_outline(&a->bins, (const double(*)[2])inside, count, (struct ink){ { 0.75f, 0.8f, 0.85f }, 0.5f },
                         0.1);
}

void lom_add_window_pictures(struct all_triangles *a)
{
    struct steps *s = a->steps;
    char all[MAX_COUNTED], drawn[MAX_COUNTED];
    lom_stage_picture *p = lom_add_picture(
        s, "Triangles", "window", "Projected", "src/pipeline/project.h", lom_canvas_image(&a->window, s->error),
        "Divided by w, moved to the window and snapped to 1/256 pixel. The frame is the rectangle; "
        "triangles reach beyond it, for nothing is cut at its sides. Brighter is nearer.");
    lom_add_legend(p, &lom_frame_ink, "the frame, %d x %d pixels", s->width, s->height);
    p = lom_add_picture(
        s, "Triangles", "cull", "Culled", "src/pipeline/setup.wide.c", lom_canvas_image(&a->fates, s->error),
        "What set-up leaves out before a single pixel is touched, by its exact integers: of %s, %s are drawn.",
        lom_say_counted(&a->all, all), lom_say_counted(&a->reach[LOM_REACH_BINNED], drawn));
    for (int i = LOM_REACHES - 1; i >= 0; i--)
        lom_add_legend(p, &lom_reach_inks[i], "%s: %s%s", lom_reach_text((lom_reach)i),
                       lom_say_counted(&a->reach[i], all),
                       i == LOM_REACH_OUTSIDE || i == LOM_REACH_BESIDE ? " (not in this picture)" : "");
    lom_add_picture(s, "Triangles", "bins", "Tiles", "src/pipeline/bin.c", lom_canvas_image(&a->bins, s->error),
                    "Each tile of %d x %d pixels has the list of what may touch it, of %s; the numbers say how much. "
                    "From here on a tile is drawn by one worker, alone, in memory that fits its cache.",
                    a->tiles.edge, a->tiles.edge, lom_say_counted(&a->reach[LOM_REACH_BINNED], drawn));
}
