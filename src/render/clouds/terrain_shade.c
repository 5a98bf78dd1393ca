/* The shadow of terrain on clouds. In: heights up to which terrain keeps the sun off its own places (ground/shadow.c). Out: the
 * same over any place of the world, for the light of clouds. A shadow sinks by tan e a metre away from what throws it, e the
 * sun's elevation: beside the terrain it is the border's, less so much a metre of the way there. */
#include "base/numbers.h"
#include "render/frame.h"

static const double no_shadow = -1e30;

static double between(const struct lom_ground *g, const float *heights, double column, double row)
{
    const int x = lom_smaller_int(lom_int_of(column), g->columns - 1),
              y = lom_smaller_int(lom_int_of(row), g->rows - 1);
    const float *a = heights + (size_t)y * (size_t)(g->columns + 1) + x, *b = a + g->columns + 1;
    const double s = column - x, t = row - y;
    const double upper = (double)a[0] + s * ((double)a[1] - (double)a[0]);
    const double lower = (double)b[0] + s * ((double)b[1] - (double)b[0]);
    return upper + t * (lower - upper);
}

/* How far from a place the way towards the sun comes over the terrain, whose middle is 0: 0 where it is there; less than 0:
 * it does not. way: metres a metre. */
static double way_to_terrain(const double size[2], const double at[2], const double way[2])
{
    double from = 0, to = 1e300;
    for (int i = 0; i < 2; i++) {
        const double low = -size[i] / 2 - at[i], high = size[i] / 2 - at[i];
        if (way[i] == 0) {
            if (low > 0 || high < 0)
                return -1;
            continue;
        }
        const double a = low / way[i], b = high / way[i];
        from = lom_larger(from, a < b ? a : b);
        to = lom_smaller(to, a < b ? b : a);
    }
    return from <= to ? from : -1;
}

static double clamped(double x, double most)
{
    return x < 0 ? 0 : x < most ? x : most;
}

static double shadow_over(const void *context, double x, double z)
{
    const lom_renderer *r = context;
    const struct lom_ground *g = &r->ground;
    const lom_terrain *t = &r->scene->terrain;
    const lom_vec3 sun = r->moment.to_light;
    const double flat = lom_double_sqrt(sun.x * sun.x + sun.z * sun.z), at[2] = { x, z };
    if (!(flat > 0))
        return no_shadow;
    const double way[2] = { sun.x / flat, sun.z / flat }, beside = way_to_terrain(t->size, at, way);
    if (beside < 0)
        return no_shadow;
    const double column = clamped(((x + way[0] * beside) / t->size[0] + 0.5) * g->columns, g->columns);
    const double row = clamped(((z + way[1] * beside) / t->size[1] + 0.5) * g->rows, g->rows);
    double height = between(g, g->shadow_heights, column, row);
    if (beside > 0)
        height = lom_larger(height, between(g, g->heights, column, row)) - beside * sun.y / flat;
    return height + t->base;
}

/* Of the terrain's highest place. */
static double highest(const struct lom_ground *ground)
{
    double most = -1e300;
    for (int i = 0; i < ground->across * ground->down; i++)
        most = lom_larger(most, ground->blocks[i].bounds.high.y);
    return most;
}

bool lom_terrain_shades_clouds(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    const struct lom_cloud_set *set = r->clouds.set;
    if (r->ground.blocks == NULL || set == NULL || !f->scene->quality.terrain_shadows || !(r->moment.to_light.y > 0))
        return false;
    const double most = highest(&r->ground);
    for (size_t i = 0; i < set->count; i++)
        if (lom_cloud_bounds(&set->clouds[i]).low.y < most)
            return true;
    return false;
}

void lom_shade_clouds(struct frame *f)
{
    struct lom_drawn_clouds *clouds = &f->renderer->clouds;
    clouds->set->shade = NULL;
    clouds->set->shaded = 0;
    if (f->renderer->ground.shadow_heights == NULL || !lom_terrain_shades_clouds(f))
        return;
    clouds->shade = (struct lom_cloud_shade){ shadow_over, f->renderer, highest(&f->renderer->ground) };
    clouds->set->shade = &clouds->shade;
}
