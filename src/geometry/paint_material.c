/* What things are made of. In: a canvas; out: its colours: boards, painted boards, a log, shingles, bark, masonry,
 * needles, reed, a window. Grain runs along v (down the picture); boards lie side by side along u. */
#include "geometry/canvas.h"

static double wavy(const lom_canvas *c, double u, double v, int cells, int count, double shift)
{
    lom_octaves octaves = { .count = count, .period = cells, .gain = 0.55 };
    return lom_fractal2(&c->noise, u * cells + shift * cells, v * cells, octaves);
}

/* Fibres: noise drawn out along v, bent a little. -1..1 */
static double grain_at(const lom_canvas *c, double u, double v, double shift)
{
    double bend = 0.02 * wavy(c, u, v, 4, 2, shift);
    double fine = lom_noise2_grid(&c->noise, (u + bend) * 96 + shift * 7, v * 4, 96, 4);
    double middle = lom_noise2_grid(&c->noise, (u + bend) * 32 + shift * 5, v * 2 + 0.5, 32, 2);
    return 0.55 * fine + 0.45 * middle;
}

typedef struct board {
    double edge; /* distance to the nearer long edge, in parts of the board */
    double end;  /* distance to the nearer end, in parts of its length */
    unsigned which;
} board;

/* `count` boards side by side, two to a column, the joints at random heights. */
static board board_at(const lom_canvas *c, double u, double v, unsigned count, unsigned what)
{
    double place = u * count;
    unsigned column = (unsigned)lom_count_of(place, count);
    double across = place - column;
    double along = v + lom_canvas_random(c, what, column);
    along -= lom_double_floor(along);
    double half = along * 2;
    unsigned part = (unsigned)lom_count_of(half, 1);
    half -= part;
    return (board){ across < 0.5 ? across : 1 - across, half < 0.5 ? half : 1 - half, column * 2 + part };
}

typedef struct wood {
    lom_tint dark, light;
    unsigned boards;
    double weather, gap; /* how unequal the boards are; how dark the gaps */
} wood;

static void paint_boards(lom_canvas *c, const wood *w)
{
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            board b = board_at(c, u, v, w->boards, 11);
            double tone = lom_canvas_random(c, 12, b.which) - 0.5;
            double grain = grain_at(c, u, v, b.which * 0.37);
            double stain = wavy(c, u, v, 4, 4, 0.2);
            lom_tint tint = lom_mix_tint(w->dark, w->light, 0.5 + w->weather * tone + 0.42 * grain + 0.5 * stain);
            double gap = lom_smooth_step(0.0, 0.07, b.edge) * lom_smooth_step(0.0, 0.012, b.end);
            double round = 0.86 + 0.14 * lom_smooth_step(0, 0.25, b.edge);
            double nail_u = b.edge - 0.22, nail_v = (b.end - 0.035) * w->boards * 0.5;
            double nail = lom_smooth_step(0.075, 0.04, lom_double_sqrt(nail_u * nail_u + nail_v * nail_v));
            double light = round * lom_mix_double(1 - w->gap, 1, gap) * (1 - 0.55 * nail);
            lom_put_tint(c, x, y, lom_scale_tint(tint, light));
        }
}

void lom_paint_planks(lom_canvas *c)
{
    paint_boards(c, &(wood){ lom_tint_of(92, 80, 66), lom_tint_of(168, 152, 130), 6, 0.55, 0.72 });
}

/* Oil paint that has flaked at the edges of the boards. */
void lom_paint_paint(lom_canvas *c)
{
    paint_boards(c, &(wood){ lom_tint_of(116, 46, 38), lom_tint_of(160, 74, 58), 4, 0.18, 0.5 });
    const lom_tint bare = lom_tint_of(150, 130, 104);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            board b = board_at(c, u, v, 4, 11);
            double worn =
                0.75 * wavy(c, u, v, 8, 5, 0.6) + 0.2 * grain_at(c, u, v, 0.3) + 0.3 * lom_smooth_step(0.16, 0, b.edge);
            lom_cover(c, x, y, bare, 0.75 * lom_smooth_step(0.30, 0.42, worn));
        }
}

/* A barked log: v along it, u around it. */
void lom_paint_log(lom_canvas *c)
{
    const lom_tint dark = lom_tint_of(78, 56, 38), light = lom_tint_of(164, 126, 86), check = lom_tint_of(48, 34, 24);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            double grain = grain_at(c, u, v, 0.1), stain = wavy(c, u, v, 4, 5, 0.5);
            lom_tint tint = lom_mix_tint(dark, light, 0.55 + 0.55 * grain + 0.6 * stain);
            double split = lom_noise2_grid(&c->noise, u * 16 + 0.35 * wavy(c, u, v, 4, 2, 0.9), v * 2, 16, 2);
            double crack = 1 - (split < 0 ? -split : split) - 0.06 * lom_smooth_step(-0.2, 0.3, stain);
            lom_put_tint(c, x, y, lom_mix_tint(tint, check, 0.8 * lom_smooth_step(0.95, 0.99, crack)));
        }
}

/* Rows of split wood, each over the one below it. */
void lom_paint_shingles(lom_canvas *c)
{
    const lom_tint dark = lom_tint_of(70, 62, 56), light = lom_tint_of(146, 132, 116), moss = lom_tint_of(92, 100, 58);
    const unsigned rows = 8, columns = 10;
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            unsigned row = (unsigned)lom_count_of(v * rows, rows);
            double place = u * columns + (row & 1) * 0.5 + 0.22 * lom_canvas_random(c, 14, row);
            unsigned column = (unsigned)lom_count_of(place, 2 * columns) % columns;
            double across = place - lom_double_floor(place), along = v * rows - row;
            unsigned which = row * columns + column;
            double end = 0.9 + 0.1 * lom_canvas_random(c, 15, which);
            double tone = lom_canvas_random(c, 16, which) - 0.5, grain = grain_at(c, u, v, which * 0.21);
            lom_tint tint = lom_mix_tint(dark, light, 0.5 + 0.75 * tone + 0.45 * grain);
            tint = lom_mix_tint(tint, moss, 0.75 * lom_smooth_step(0.16, 0.5, wavy(c, u, v, 4, 5, 0.4)));
            double edge = across < 0.5 ? across : 1 - across;
            double light_here =
                (0.55 + 0.45 * lom_smooth_step(0, 0.45, along)) * (0.45 + 0.55 * lom_smooth_step(0, 0.07, edge));
            light_here *= along > end ? 0.45 : 1;
            lom_put_tint(c, x, y, lom_scale_tint(tint, light_here));
        }
}

void lom_paint_bark(lom_canvas *c)
{
    const lom_tint deep = lom_tint_of(58, 48, 42), plate = lom_tint_of(124, 110, 98), red = lom_tint_of(134, 108, 86);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            double bend = wavy(c, u, v, 4, 3, 0.3);
            double rough =
                lom_fractal2(&c->noise, u * 16, v * 8, (lom_octaves){ .count = 4, .period = 8, .gain = 0.6 });
            lom_cell scale = lom_cellular2(&c->noise, u * 11 + 1.6 * bend, v * 3 + 0.9 * rough, 11, 3);
            double plates = lom_smooth_step(-0.05, 0.5, scale.second - scale.nearest + 0.35 * rough);
            lom_tint tint = lom_mix_tint(plate, red, 0.4 + (scale.identity & 255) / 400.0 + rough);
            tint = lom_mix_tint(deep, tint, plates * (0.75 + 0.5 * rough));
            c->height[lom_canvas_index(c, x, y)] = 5 * plates + 3 * rough;
            lom_put_tint(c, x, y, tint);
        }
    lom_shade_relief(c, 0.3);
}

void lom_paint_masonry(lom_canvas *c)
{
    const lom_tint mortar = lom_tint_of(132, 124, 112);
    static const uint8_t colors[4][3] = { { 112, 108, 104 }, { 134, 126, 116 }, { 98, 96, 96 }, { 146, 134, 118 } };
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            double bend = 0.22 * wavy(c, u, v, 8, 3, 0.2), grain = wavy(c, u, v, 32, 3, 0.4);
            lom_cell cell = lom_cellular2(&c->noise, u * 5 + bend, v * 8 - bend, 5, 8);
            double gap = cell.second - cell.nearest;
            const uint8_t *color = colors[cell.identity & 3];
            lom_tint stone = lom_scale_tint(lom_tint_of(color[0], color[1], color[2]), 1 + 0.4 * grain);
            double inside = lom_smooth_step(0.08, 0.16, gap);
            c->height[lom_canvas_index(c, x, y)] = 5 * lom_smooth_step(0.06, 0.4, gap) + 1.5 * grain;
            lom_put_tint(c, x, y, lom_mix_tint(lom_scale_tint(mortar, 0.8 + 0.3 * grain), stone, inside));
        }
    lom_shade_relief(c, 0.35);
}

/* Twigs that point down the picture, from the shade of the stem into the light. */
void lom_paint_needles(lom_canvas *c)
{
    const lom_tint gloom = lom_tint_of(40, 50, 30), old = lom_tint_of(62, 80, 44), young = lom_tint_of(124, 138, 76);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++)
            lom_put_tint(c, x, y,
                         lom_scale_tint(gloom, 1 + 0.5 * wavy(c, (double)x / c->size, (double)y / c->size, 8, 4, 0.1)));
    double unit = c->size / 256.0;
    for (unsigned i = 0; i < 5200; i++) {
        double x = lom_canvas_random(c, 1, i) * c->size, y = lom_canvas_random(c, 2, i) * c->size;
        double angle = 1.5707963 + 1.9 * (lom_canvas_random(c, 3, i) - 0.5), tone = lom_canvas_random(c, 4, i);
        double depth = 0.35 + 0.65 * i / 5200.0; /* later ones lie on top, in the light */
        lom_stroke needle = { .x = x,
                              .y = y,
                              .dx = lom_double_cos(angle),
                              .dy = lom_double_sin(angle),
                              .length = unit * (8 + 8 * lom_canvas_random(c, 5, i)),
                              .width = unit * 2.2,
                              .bend = 0.6 * (lom_canvas_random(c, 6, i) - 0.5),
                              .foot = lom_scale_tint(old, depth * (0.7 + 0.5 * tone)),
                              .tip = lom_scale_tint(lom_mix_tint(old, young, 0.3 + 0.8 * tone), depth * 1.05) };
        lom_paint_stroke(c, &needle);
    }
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double *color = c->color[lom_canvas_index(c, x, y)];
            for (int k = 0; k < 3; k++)
                color[k] *= 0.62 + 0.5 * (y + 0.5) / c->size;
        }
}

/* Blades from green (top) to straw (bottom), with veins. */
void lom_paint_reed(lom_canvas *c)
{
    const lom_tint green = lom_tint_of(104, 116, 66), straw = lom_tint_of(172, 156, 106),
                   foot = lom_tint_of(92, 86, 50);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            double vein = grain_at(c, u, v, 0.2);
            lom_tint tint = lom_mix_tint(straw, green, lom_smooth_step(0.0, 0.35, v) + 0.4 * wavy(c, u, v, 4, 3, 0.4));
            tint = lom_mix_tint(tint, foot, lom_smooth_step(0.6, 1.0, v));
            lom_put_tint(c, x, y, lom_scale_tint(tint, 1 + 0.28 * vein));
        }
}

/* Four panes in a white frame; the sky's brightness in old glass. */
/* 1 on the four panes of a window, 0 on its frame. */
static double pane_at(double u, double v)
{
    double a = u < 0.5 ? u : 1 - u, b = v < 0.5 ? v : 1 - v;
    return lom_smooth_step(0.09, 0.11, a) * lom_smooth_step(0.48, 0.46, a) * lom_smooth_step(0.09, 0.11, b) *
           lom_smooth_step(0.48, 0.46, b);
}

void lom_paint_window(lom_canvas *c)
{
    const lom_tint frame = lom_tint_of(206, 198, 180), glass = lom_tint_of(44, 58, 68),
                   bright = lom_tint_of(138, 160, 172);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            double pane = pane_at(u, v);
            double gleam = lom_smooth_step(0.9, 0.2, v + 0.5 * (u - 0.5) + 0.25 * wavy(c, u, v, 4, 3, 0.1));
            double worn = 1 + 0.2 * grain_at(c, u, v, 0.4);
            lom_put_tint(c, x, y, lom_mix_tint(lom_scale_tint(frame, worn), lom_mix_tint(glass, bright, gleam), pane));
        }
}

/* The light in it: a lamp within, low in the middle, behind curtains at the sides. */
void lom_paint_lit_window(lom_canvas *c)
{
    const lom_tint dark = lom_tint_of(0, 0, 0), dim = lom_tint_of(176, 120, 62), bright = lom_tint_of(255, 226, 160);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size, side = u - 0.5, low = v - 0.62;
            double lamp = lom_smooth_step(0.62, 0.0, lom_double_sqrt(side * side + 0.7 * low * low));
            double curtain = lom_smooth_step(0.22, 0.34, side < 0 ? -side : side);
            double fold = 1 - 0.28 * curtain * (0.5 + 0.5 * lom_double_sin(78 * u + wavy(c, u, v, 2, 2, 0.6)));
            lom_tint light = lom_scale_tint(lom_mix_tint(dim, bright, lamp), (1 - 0.25 * curtain) * fold);
            lom_put_tint(c, x, y, lom_mix_tint(dark, light, pane_at(u, v)));
        }
}

/* A mesh of a net, white where its cords are: two that cross from corner to corner, and the knot where they meet. */
void lom_paint_net(lom_canvas *c)
{
    const double half = 0.055, knot = 0.095, soft = 1.5 / c->size; /* parts of the picture */
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            const double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size, s = lom_double_sqrt(0.5);
            double rising = u + v < 1 ? u + v : 2 - u - v, falling = u < v ? v - u : u - v;
            rising = (rising < 1 - rising ? rising : 1 - rising) * s;
            falling = (falling < 1 - falling ? falling : 1 - falling) * s;
            const double across = u - 0.5, along = v - 0.5, edge_u = u < 0.5 ? u : 1 - u, edge_v = v < 0.5 ? v : 1 - v;
            const double middle = lom_double_sqrt(across * across + along * along),
                         corner = lom_double_sqrt(edge_u * edge_u + edge_v * edge_v);
            const double cord = half - (rising < falling ? rising : falling);
            const double tied = knot - (middle < corner ? middle : corner);
            const double inside = cord > tied ? cord : tied;
            lom_put_tint(c, x, y,
                         lom_scale_tint(lom_tint_of(255, 255, 255), lom_clamp_double(0.5 + inside / soft, 0, 1)));
        }
}
