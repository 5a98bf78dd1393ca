/* The skin of an aircraft. In: a canvas; out: its colours. The upper half of the picture is the fuselage (u around it
 * from the keel, v from the nose to the tail), the third quarter a wing and the last a tail (u from root to tip, v from
 * the leading to the trailing edge). */
#include "geometry/canvas.h"

typedef struct skin {
    lom_tint white, gray, red, navy, glass, line;
} skin;

static double between(double x, double low, double high, double soft)
{
    return lom_smooth_step(low - soft, low + soft, x) * (1 - lom_smooth_step(high - soft, high + soft, x));
}

/* A line every `step`, `width` wide. */
static double lines(double x, double step, double width)
{
    double place = x / step + 0.5;
    place -= lom_double_floor(place);
    double away = (place < 0.5 ? 0.5 - place : place - 0.5) * step;
    return 1 - lom_smooth_step(width / 2, width, away);
}

static lom_tint fuselage(const skin *s, double u, double v)
{
    double side = u < 0.5 ? u : 1 - u, soft = 0.002; /* 0 at the keel, 0.5 at the top */
    lom_tint tint = lom_mix_tint(s->gray, s->white, lom_smooth_step(0.09, 0.11, side));
    tint = lom_mix_tint(tint, s->line, 0.3 * lines(v, 0.03125, 0.0012));
    double rise = 0.05 * lom_smooth_step(0.26, 0.42, v);
    tint = lom_mix_tint(tint, s->red, between(side, 0.215 + rise, 0.275 + rise, soft));
    tint = lom_mix_tint(tint, s->navy, between(side, 0.188 + rise, 0.202 + rise, soft));
    tint = lom_mix_tint(tint, s->red, 1 - lom_smooth_step(0.028, 0.031, v));
    tint = lom_mix_tint(tint, s->navy, between(v, 0.031, 0.037, 0.001));
    double side_window = between(side, 0.305, 0.395, soft) * between(v, 0.175, 0.292, 0.002);
    side_window *= 1 - between(v, 0.209, 0.217, 0.001) - between(v, 0.255, 0.263, 0.001);
    double wind_shield = between(side, 0.315, 0.51, soft) * between(v, 0.122, 0.164, 0.0015);
    wind_shield *= 1 - between(side, 0.494, 0.51, 0.001);
    double pane = side_window > wind_shield ? side_window : wind_shield;
    double frame = between(side, 0.298, 0.402, soft) * between(v, 0.171, 0.296, 0.002);
    tint = lom_mix_tint(tint, s->line, 0.5 * frame * (1 - pane));
    lom_tint glass = lom_mix_tint(s->glass, s->white, 0.35 * lom_smooth_step(0.36, 0.33, side + 0.6 * (v - 0.2)));
    return lom_mix_tint(tint, glass, pane);
}

static lom_tint wing(const skin *s, double u, double chord)
{
    lom_tint tint = s->white;
    tint = lom_mix_tint(tint, s->line, 0.3 * lines(u, 0.125, 0.0024));
    tint = lom_mix_tint(tint, s->line, 0.45 * between(chord, 0.742, 0.750, 0.003));
    tint = lom_mix_tint(tint, s->line, 0.45 * between(u, 0.548, 0.552, 0.001) * lom_smooth_step(0.74, 0.75, chord));
    tint = lom_mix_tint(tint, s->navy, 0.8 * between(u, 0.03, 0.10, 0.002) * between(chord, 0.25, 0.72, 0.01));
    tint = lom_mix_tint(tint, s->red, lom_smooth_step(0.86, 0.865, u));
    return lom_mix_tint(tint, s->navy, between(u, 0.835, 0.85, 0.003));
}

static lom_tint tail(const skin *s, double u, double chord)
{
    lom_tint tint = lom_mix_tint(s->red, s->white, between(u, 0.42, 0.58, 0.004));
    tint = lom_mix_tint(tint, s->navy, between(u, 0.61, 0.64, 0.004));
    return lom_mix_tint(tint, s->line, 0.5 * between(chord, 0.63, 0.645, 0.004));
}

void lom_paint_livery(lom_canvas *c)
{
    const skin s = { lom_tint_of(238, 237, 231), lom_tint_of(176, 180, 184), lom_tint_of(196, 34, 30),
                     lom_tint_of(28, 44, 82),    lom_tint_of(30, 40, 52),    lom_tint_of(90, 92, 96) };
    lom_octaves octaves = { .count = 4, .period = 16, .gain = 0.5 };
    for (int y = 0; y < c->size; y++)
        for (int x = 0; x < c->size; x++) {
            double u = (x + 0.5) / c->size, v = (y + 0.5) / c->size;
            lom_tint tint = v < 0.5    ? fuselage(&s, u, v)
                            : v < 0.75 ? wing(&s, u, (v - 0.5) * 4)
                                       : tail(&s, u, (v - 0.75) * 4);
            double worn = 1 + 0.03 * lom_fractal2(&c->noise, u * 16, v * 16, octaves);
            lom_put_tint(c, x, y, lom_scale_tint(tint, worn));
        }
}
