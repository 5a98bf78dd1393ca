/* The lamps of a frame. In: those of the moment. Out: their uniforms, as places less the eye of the frame, and their tiles.
 * Invariant: they follow from the whole frame; a view with another eye sees the same lamps. */
#include "render/lamps.h"

#include "base/numbers.h"
#include "base/reserve.h"
#include "render/frame.h"

#include <stdio.h>

/* As far as a float can be squared; nothing of a scene is. */
static const double endless = 0x1p60;

static struct lom_lamp_uniform lamp_uniform(const struct lom_placed_lamp *from, lom_vec3 eye)
{
    const lom_lamp *lamp = from->lamp;
    const lom_vec3 p = from->position, d = from->direction;
    struct lom_lamp_uniform u = { .infinite = lamp->kind == LOM_LAMP_INFINITE,
                                  .spot = lamp->kind == LOM_LAMP_SPOT,
                                  .exponent = (float)lamp->exponent };
    const double direction[3] = { d.x, d.y, d.z }, place[3] = { p.x - eye.x, p.y - eye.y, p.z - eye.z };
    for (int i = 0; i < 3; i++) {
        u.direction[i] = (float)direction[i];
        u.place[i] = u.infinite ? -u.direction[i] : (float)place[i];
    }
    lom_round_three(u.ambient, from->ambient);
    lom_round_three(u.diffuse, from->diffuse);
    lom_round_three(u.specular, from->specular);
    lom_round_three(u.attenuation, lamp->attenuation);
    u.reach = (float)(from->reach < endless ? from->reach : endless);
    u.square_reach = u.reach * u.reach;
    u.inverse_fade = 4 / u.reach;
    /* the edge is where the double's cosine is: rounded away from the middle, so that a cone of 0 has its middle */
    const double edge = lom_double_cos(lamp->cutoff), full = lom_double_cos(lamp->cutoff - lamp->softness);
    u.cosine_cutoff = (float)(edge - 0x1p-24);
    u.inverse_softness = lamp->softness == 0 ? 1e30f : (float)(1 / lom_larger(full - edge, 0x1p-22));
    return u;
}

/* As the keys of a scene name it. */
static void name_lamp(struct lom_lamp_uniform *u, const struct lom_placed_lamp *from, const lom_scene *scene)
{
    snprintf(u->number, sizeof u->number, "lamp.%d", (int)(from->lamp - scene->lamps));
    u->name = from->lamp->name != NULL ? from->lamp->name : u->number;
    snprintf(u->shadow_name, sizeof u->shadow_name, "%.48s.shadow", u->name);
}

/* The box of its light over x and z. */
static struct lom_lamp_extent extent_of(const struct lom_placed_lamp *lamp)
{
    const double r = lamp->reach;
    return (struct lom_lamp_extent){ { lamp->position.x - r, lamp->position.z - r },
                                     { lamp->position.x + r, lamp->position.z + r },
                                     !(r < endless) };
}

/* Whether its light may be in the view, or in what planar water mirrors of it. */
static bool reaches_view(const struct lom_placed_lamp *lamp, const lom_frustum *frustum)
{
    const double r = lamp->reach;
    const lom_vec3 p = lamp->position;
    if (!(r < endless))
        return true;
    return lom_box_visibility(frustum, (lom_box){ { p.x - r, p.y - r, p.z - r }, { p.x + r, p.y + r, p.z + r } }) !=
           LOM_OUTSIDE;
}

static size_t count_in_view(const struct frame *f)
{
    const struct lom_moment *moment = &f->renderer->moment;
    const lom_mat4 clip_from_world = lom_multiply(&f->view.projection, &f->view.view);
    const lom_frustum frustum = lom_view_frustum(&clip_from_world, false);
    size_t count = 0;
    for (size_t i = 0; i < moment->lamp_count; i++)
        count += reaches_view(&moment->lamps[i], &frustum);
    return count;
}

/* A place in float is off by 2^-24 of its distance from the eye and so is a lamp's: with what their difference and the
 * tile's number round, less than 2^-20 of the farthest of both. */
static double find_margin(const struct frame *f, const struct lom_lamp_extent *extents, size_t count)
{
    const double eye[2] = { f->view.eye.x, f->view.eye.z };
    double farthest = 0;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2 && !extents[i].everywhere; k++) {
            const double low = lom_magnitude(extents[i].low[k] - eye[k]);
            const double high = lom_magnitude(extents[i].high[k] - eye[k]);
            farthest = low > farthest ? low : farthest;
            farthest = high > farthest ? high : farthest;
        }
    return 0x1p-19 * farthest;
}

static struct lom_lamps_uniform lamps_uniform(const struct lom_drawn_lamps *lamps)
{
    const struct lom_lamp_tiles *t = &lamps->tiles;
    return (struct lom_lamps_uniform){ .lamps = lamps->items,
                                       .corner = { (float)(t->corner[0] - lamps->eye.x),
                                                   (float)(t->corner[1] - lamps->eye.z) },
                                       .inverse_side = (float)(1 / t->side),
                                       .columns = t->columns,
                                       .rows = t->rows,
                                       .first = t->first,
                                       .list = t->list };
}

/* The longest list of a tile. */
static unsigned count_most(const struct lom_lamp_tiles *t)
{
    uint32_t most = 0;
    for (int i = 0; i <= t->columns * t->rows; i++)
        most = t->first[i + 1] - t->first[i] > most ? t->first[i + 1] - t->first[i] : most;
    return most;
}

bool lom_prepare_lamps(struct frame *f, lom_error *error)
{
    struct lom_drawn_lamps *lamps = &f->renderer->lamps;
    const struct lom_moment *moment = &f->renderer->moment;
    lamps->count = moment->lamp_count;
    lamps->eye = f->view.eye;
    if (f->scene->lamp_count == 0)
        return true;
    if (lamps->count == 0) {
        lom_add_step(f, "lamps", false, "none of the %zu lamps shines", f->scene->lamp_count);
        return true;
    }
    if (!lom_reserve(&lamps->items, &lamps->capacity, lamps->count, sizeof *lamps->items, error) ||
        !lom_reserve(&lamps->extents, &lamps->extent_capacity, lamps->count, sizeof *lamps->extents, error))
        return false;
    for (size_t i = 0; i < lamps->count; i++) {
        lamps->items[i] = lamp_uniform(&moment->lamps[i], lamps->eye);
        name_lamp(&lamps->items[i], &moment->lamps[i], f->scene);
        lamps->extents[i] = extent_of(&moment->lamps[i]);
    }
    const double margin = find_margin(f, lamps->extents, lamps->count);
    if (!lom_fill_lamp_tiles(&lamps->tiles, lamps->extents, lamps->count, margin, !f->scene->quality.lamp_tiles, error))
        return false;
    lamps->uniform = lamps_uniform(lamps);
    lom_add_step(f, "lamps", true, "%zu of %zu reach the view; at most %u a tile of %.3g m", count_in_view(f),
                 f->scene->lamp_count, count_most(&lamps->tiles), lamps->tiles.side);
    return true;
}

void lom_set_lamps(struct lom_light_uniform *u, const lom_renderer *renderer, lom_vec3 eye)
{
    const struct lom_drawn_lamps *lamps = &renderer->lamps;
    if (lamps->count == 0)
        return;
    u->lamps = &lamps->uniform;
    u->lamp_shift[0] = (float)(eye.x - lamps->eye.x);
    u->lamp_shift[1] = (float)(eye.y - lamps->eye.y);
    u->lamp_shift[2] = (float)(eye.z - lamps->eye.z);
}

void lom_free_lamps(struct lom_drawn_lamps *lamps)
{
    lom_free_lamp_tiles(&lamps->tiles);
    lom_release(lamps->items);
    lom_release(lamps->extents);
    *lamps = (struct lom_drawn_lamps){ .items = NULL };
}
