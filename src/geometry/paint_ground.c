/* What covers the ground. In: a canvas; out: its colours: grass, the crowns of a forest seen from afar, rock, a pebble
 * shore, snow. Sizes are in parts of the picture, so that another size shows the same. */
#include "base/numbers.h"
#include "geometry/canvas.h"

/* fBm over the picture, `cells` lattice cells a side. */
static double cloudy(const lom_canvas *c, int x, int y, int cells, int count, double shift)
{
    lom_octaves octaves = { .count = count, .period = cells, .gain = 0.55 };
    return lom_fractal2(&c->noise, (double)x / c->size * cells + shift * cells, (double)y / c->size * cells, octaves);
}

static void put_height(lom_canvas *c, int x, int y, double height)
{
    c->height[lom_canvas_index(c, x, y)] = height;
}

/* ---- grass: thirty thousand blades over earth ---- */

void lom_paint_grass(lom_canvas *c)
{
    const lom_tint earth = lom_tint_of(62, 58, 36), moss = lom_tint_of(66, 76, 34);
    const lom_tint dark = lom_tint_of(70, 84, 34), fresh = lom_tint_of(112, 126, 56), dry = lom_tint_of(158, 146, 86);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++)
            lom_put_tint(c, x, y, lom_mix_tint(earth, moss, 0.5 + cloudy(c, x, y, 8, 5, 0.3)));
    double unit = c->size / 512.0;
    for (unsigned i = 0; i < 30000; i++) {
        double x = lom_canvas_random(c, 1, i) * c->size, y = lom_canvas_random(c, 2, i) * c->size;
        double angle = lom_two_pi * lom_canvas_random(c, 3, i), tone = lom_canvas_random(c, 4, i);
        double patch = cloudy(c, lom_int_of(x), lom_int_of(y), 4, 4, 0.7),
               age = cloudy(c, lom_int_of(x), lom_int_of(y), 6, 3, 0.1);
        lom_tint tip = lom_mix_tint(fresh, dry, 1.3 * age + 0.5 * tone - 0.05);
        lom_stroke blade = { .x = x,
                             .y = y,
                             .dx = lom_double_cos(angle),
                             .dy = lom_double_sin(angle),
                             .length = unit * (7 + 11 * lom_canvas_random(c, 5, i)),
                             .width = unit * 2.1,
                             .bend = lom_canvas_random(c, 6, i) - 0.5,
                             .foot = lom_scale_tint(dark, 0.7 + 0.5 * tone),
                             .tip = lom_scale_tint(tip, 0.86 + 0.3 * tone + 0.25 * patch) };
        lom_paint_stroke(c, &blade);
    }
}

/* ---- forest: crowns from above and aside, the ones in front over the ones behind ---- */

static void paint_crown(lom_canvas *c, double x, double y, double radius, double tone, unsigned which)
{
    const lom_tint shadow = lom_tint_of(20, 27, 18), spruce = lom_tint_of(62, 76, 42),
                   larch = lom_tint_of(100, 104, 54);
    lom_tint lit = lom_mix_tint(spruce, larch, tone * tone);
    int reach = lom_int_of(radius) + 2;
    double turn = lom_two_pi * lom_canvas_random(c, 9, which);
    for (int b = -reach; b <= reach; b++)
        for (int a = -reach; a <= reach; a++) {
            double distance = lom_double_sqrt((double)(a * a + b * b));
            double angle = distance > 0 ? lom_double_atan2(b, a) : 0;
            double jag = 0.16 * lom_double_sin(7 * angle + turn) + 0.10 * lom_double_sin(12 * angle + 3 * turn);
            double edge = radius * (0.86 + jag);
            double coverage = lom_clamp_double(edge - distance, 0, 1);
            if (coverage <= 0)
                continue;
            double speckle = lom_noise2(&c->noise, (x + a) * 0.37 + which, (y + b) * 0.37, 256);
            double height = 1 - distance / edge;
            double light = 0.52 + 0.5 * (-0.6 * a - 0.8 * b) / radius + 0.45 * height + 0.28 * speckle;
            lom_cover(c, lom_int_of(x) + a, lom_int_of(y) + b, lom_mix_tint(shadow, lit, light), coverage);
        }
}

void lom_paint_forest(lom_canvas *c)
{
    const lom_tint floor_dark = lom_tint_of(26, 31, 20), floor_light = lom_tint_of(58, 62, 36);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++)
            lom_put_tint(c, x, y, lom_mix_tint(floor_dark, floor_light, 0.4 + cloudy(c, x, y, 8, 5, 0.2)));
    const unsigned rows = 44, columns = 36;
    double unit = c->size / 512.0;
    for (unsigned row = 0; row < rows; row++)
        for (unsigned column = 0; column < columns; column++) {
            unsigned i = row * columns + column;
            double x = (column + lom_canvas_random(c, 1, i) + 0.5 * (row & 1)) * c->size / columns;
            double y = (row + lom_canvas_random(c, 2, i)) * c->size / rows;
            double clearing = cloudy(c, lom_int_of(x), lom_int_of(y), 4, 4, 0.6);
            if (clearing > 0.36)
                continue;
            double radius =
                unit * (7.5 + 7.5 * lom_canvas_random(c, 3, i)) * (1 - 0.4 * lom_smooth_step(0.1, 0.4, clearing));
            double tone = lom_clamp_double(
                lom_canvas_random(c, 4, i) * 0.75 + cloudy(c, lom_int_of(x), lom_int_of(y), 3, 3, 0.9), 0, 1);
            paint_crown(c, x, y, radius, tone, i);
        }
}

/* ---- rock ---- */

void lom_paint_rock(lom_canvas *c)
{
    const lom_tint dark = lom_tint_of(78, 79, 82), gray = lom_tint_of(126, 128, 131), warm = lom_tint_of(146, 139, 130);
    const lom_tint lichen = lom_tint_of(118, 120, 92);
    lom_octaves rough = { .count = 6, .period = 6, .gain = 0.6 };
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (double)x / c->size, v = (double)y / c->size;
            double bend = cloudy(c, x, y, 4, 4, 0.4);
            double ridge = lom_ridged2(&c->noise, u * 6 + 0.4 * bend, v * 6 + 0.3 * bend, rough);
            lom_cell slab =
                lom_cellular2(&c->noise, u * 5 + 0.55 * bend, v * 9 + 0.7 * cloudy(c, x, y, 8, 4, 0.8), 5, 9);
            double crack = lom_smooth_step(-0.12 + 0.5 * bend, 0.05 + 0.1 * bend, slab.second - slab.nearest);
            double grain = cloudy(c, x, y, 64, 3, 0.5);
            double step = (slab.identity & 255) / 255.0;
            double unit = c->size / 512.0;
            put_height(c, x, y, unit * (22 * ridge + 7 * crack + 9 * step * crack + 2.2 * grain + 10 * bend));
            lom_tint tint = lom_mix_tint(gray, warm, 0.45 + 1.2 * bend + 0.3 * (step - 0.5));
            tint = lom_mix_tint(tint, dark, 0.55 * (1 - crack) + 0.5 * lom_smooth_step(0.45, 0.1, ridge));
            tint = lom_mix_tint(tint, lichen, 0.5 * lom_smooth_step(0.12, 0.4, cloudy(c, x, y, 10, 5, 0.15)));
            lom_put_tint(c, x, y, lom_scale_tint(tint, 1 + 0.22 * grain));
        }
    lom_shade_relief(c, 0.42);
}

/* ---- shore: pebbles of three sizes in sand ---- */

typedef struct pebbles {
    int cells;
    double share, size; /* of the cells that hold one; of the cell */
} pebbles;

static lom_tint stone_of(unsigned identity)
{
    static const uint8_t colors[8][3] = { { 128, 122, 114 }, { 152, 145, 134 }, { 108, 102, 96 },  { 166, 156, 140 },
                                          { 136, 118, 100 }, { 120, 122, 124 }, { 178, 172, 160 }, { 98, 96, 94 } };
    const uint8_t *color = colors[identity & 7];
    return lom_tint_of(color[0], color[1], color[2]);
}

static void paint_pebbles(lom_canvas *c, pebbles p, double shift)
{
    double pixels = (double)c->size / p.cells;
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (double)x / c->size * p.cells, v = (double)y / c->size * p.cells;
            double bend = 0.16 * cloudy(c, x, y, p.cells * 2 < 128 ? p.cells * 2 : 128, 2, shift);
            lom_cell cell = lom_cellular2(&c->noise, u + shift + bend, v + shift - bend, p.cells, p.cells);
            double band = 0.8 * cloudy(c, x, y, 4, 3, shift);
            if ((cell.identity >> 8) / 256.0 > p.share + band)
                continue;
            double flat = 0.75 + 0.5 * ((cell.identity >> 4 & 15) / 15.0);
            double radius = lom_double_sqrt(cell.x * cell.x * flat + cell.y * cell.y / flat);
            double edge = p.size * (0.6 + 0.4 * ((cell.identity >> 3 & 31) / 31.0));
            double gap = 0.5 * (cell.second - cell.nearest); /* pebbles do not overlap */
            double inside = lom_clamp_double((edge - radius < gap ? edge - radius : gap) * pixels, 0, 1);
            if (inside <= 0)
                continue;
            double dome = 1 - radius * radius / (edge * edge);
            size_t i = lom_canvas_index(c, x, y);
            lom_tint tint = stone_of(cell.identity);
            tint = lom_scale_tint(tint, 0.9 + 0.16 * cloudy(c, x, y, 64, 2, 0.3));
            lom_cover(c, x, y, tint, inside);
            c->height[i] = lom_mix_double(
                c->height[i], c->height[i] + 0.30 * pixels * (dome > 0 ? lom_double_sqrt(dome) : 0), inside);
        }
}

void lom_paint_shore(lom_canvas *c)
{
    const lom_tint wet = lom_tint_of(120, 108, 88), sand = lom_tint_of(158, 145, 120);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double patch = cloudy(c, x, y, 4, 5, 0.1), grain = cloudy(c, x, y, 128, 2, 0.7);
            lom_put_tint(c, x, y, lom_scale_tint(lom_mix_tint(wet, sand, 0.5 + 1.1 * patch), 1 + 0.25 * grain));
            put_height(c, x, y, 0.6 * grain + 3 * patch);
        }
    paint_pebbles(c, (pebbles){ 64, 0.45, 0.42 }, 0.37);
    paint_pebbles(c, (pebbles){ 32, 0.34, 0.46 }, 0.61);
    paint_pebbles(c, (pebbles){ 14, 0.18, 0.46 }, 0.13);
    lom_shade_relief(c, 0.36);
}

/* ---- snow ---- */

void lom_paint_snow(lom_canvas *c)
{
    const lom_tint white = lom_tint_of(238, 241, 245), blue = lom_tint_of(206, 217, 232);
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double drift = cloudy(c, x, y, 4, 5, 0.3), ripple = cloudy(c, x + lom_int_of(40 * drift), y, 16, 4, 0.6);
            put_height(c, x, y, c->size / 512.0 * (26 * drift + 6 * ripple));
            lom_put_tint(c, x, y, lom_mix_tint(white, blue, 0.35 - 1.0 * drift - 0.35 * ripple));
        }
    lom_shade_relief(c, 0.10);
}
