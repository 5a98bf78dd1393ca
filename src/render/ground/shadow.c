/* The shadow that terrain throws on itself and on what stands on it. In: heights of a grid, the direction to the sun.
 * Out: for every vertex the height up to which a place there lies in the shadow of what stands towards the sun.
 *
 * A place at height y is dark when a height h at the distance d towards the sun rises above the ray: h - d tan e > y,
 * with e the sun's elevation. So the shadow's height is S = max (h - d tan e) over d > 0. The grid is swept away from
 * the sun, one line (a column, or a row where the sun stands more along the columns) after the other: parallel rays
 * carry their S, which takes in the line's heights and sinks by tan e times the way to the next one. A ray moves by
 * `shift` vertices along each line; it never moves to another ray, so nothing is smeared on the way, and workers take rays
 * of their own. Compiled for speed. */
#include "base/numbers.h"
#include "pipeline/share_work.h"
#include "render/ground/ground.h"

enum { RAYS = 128 /* that a worker takes at a time */ };

struct sweep {
    int lines, places;           /* lines, and vertices on each */
    ptrdiff_t line_step;         /* between vertices of neighbouring lines, away from the sun */
    ptrdiff_t place_step, first; /* between those of a line; of the first line */
    double shift;                /* vertices that a ray moves along the line from one to the next */
    float sink;                  /* metres */
};

/* Away from the sun along x when the sun stands more vertices along x than along z, else along z. */
static struct sweep lay_sweep(int width, int height, const double size[2], const double to_light[3])
{
    double spacing[2] = { size[0] / (width - 1), size[1] / (height - 1) };
    double across = to_light[0] / spacing[0], down = to_light[2] / spacing[1];
    bool along_x = lom_magnitude(across) >= lom_magnitude(down);
    double major = along_x ? across : down, minor = along_x ? down : across;
    struct sweep s = { .lines = along_x ? width : height,
                       .places = along_x ? height : width,
                       .line_step = along_x ? 1 : width,
                       .place_step = along_x ? width : 1,
                       .shift = -minor / lom_magnitude(major),
                       .sink = (float)(to_light[1] / lom_magnitude(major)) };
    if (major > 0) { /* the sun stands where the numbers of the lines are large */
        s.first = (ptrdiff_t)(s.lines - 1) * s.line_step;
        s.line_step = -s.line_step;
    }
    return s;
}

/* The height of a line between its vertices; outside it there is none. */
static float height_between(const float *line, const struct sweep *s, int place, float share)
{
    float a = place >= 0 && place < s->places ? line[place * s->place_step] : -1e30f;
    float b = place + 1 >= 0 && place + 1 < s->places ? line[(place + 1) * s->place_step] : -1e30f;
    return share == 0 ? a : a + share * (b - a);
}

/* Rays are numbered by the vertex at which they cross the first line, from `lowest` on; ray r crosses line i at
 * r + i shift. */
struct sweeping {
    struct sweep sweep;
    const float *heights;
    float *shadow;
    int lowest;
};

/* Rays first to end - 1, and what lies between each of them and the one before. */
static void sweep_rays(void *context, size_t first, size_t end)
{
    const struct sweeping *w = context;
    const struct sweep *s = &w->sweep;
    const int low = w->lowest + (int)first - 1, count = (int)(end - first) + 1;
    float ray[RAYS + 1];
    for (int r = 0; r < count; r++)
        ray[r] = -1e30f;
    for (int i = 0; i < s->lines; i++) {
        const double moved = i * s->shift;
        const int whole = lom_int_of(lom_double_floor(moved));
        const float share = (float)(moved - whole);
        const float *line = w->heights + s->first + i * s->line_step;
        float *out = w->shadow + s->first + i * s->line_step;
        const int from = lom_larger_int(0, low + whole + 1), to = lom_smaller_int(s->places, low + whole + count);
        for (int p = from; p < to; p++) { /* between ray p - moved - 1 + share and the next */
            const float *at = ray + (p - whole - low);
            out[p * s->place_step] = at[0] + share * (at[-1] - at[0]);
        }
        for (int r = 0; r < count; r++) {
            const float h = height_between(line, s, r + low + whole, share);
            ray[r] = (h > ray[r] ? h : ray[r]) - s->sink;
        }
    }
}

void lom_find_ground_shadow(lom_device *device, const float *heights, int width, int height, const double size[2],
                            const double to_light[3], float *shadow)
{
    size_t vertices = (size_t)width * (size_t)height;
    if (!(to_light[1] > 0) ||
        (to_light[0] == 0 && to_light[2] == 0)) { /* from below: all dark; from the zenith: none */
        for (size_t i = 0; i < vertices; i++)
            shadow[i] = to_light[1] > 0 ? -1e30f : 1e30f;
        return;
    }
    struct sweeping w = { lay_sweep(width, height, size, to_light), heights, shadow, 0 };
    double moved = (w.sweep.lines - 1) * w.sweep.shift;
    w.lowest = lom_int_of(lom_double_floor(moved > 0 ? -moved : 0)) - 2;
    int highest = w.sweep.places + 2 + lom_int_of(lom_double_floor(moved > 0 ? 0 : -moved));
    lom_share_work(device, (size_t)(highest - w.lowest + 1), RAYS, sweep_rays, &w);
}
