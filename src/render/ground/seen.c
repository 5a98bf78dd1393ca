/* Which blocks of terrain a pass sees. In: what it can show of a box, and how far from its eye. Out: a flag for each block.
 *
 * Blocks are asked in squares of GROUP x GROUP: whose box is out of view has no block in view, since what is compared grows and
 * falls with the box's ends, rounded or not; whose box is within the view has all in view likewise. So only blocks about the
 * view's borders are asked. Compiled for speed. */
#include "base/numbers.h"
#include "render/ground/ground.h"
#include "render/seen.h"

enum { GROUP = 4 };

static int groups_along(int blocks)
{
    return (blocks + GROUP - 1) / GROUP;
}

static void widen(lom_box *box, const lom_box *other)
{
    box->low = (lom_vec3){ lom_smaller(box->low.x, other->low.x), lom_smaller(box->low.y, other->low.y),
                           lom_smaller(box->low.z, other->low.z) };
    box->high = (lom_vec3){ lom_larger(box->high.x, other->high.x), lom_larger(box->high.y, other->high.y),
                            lom_larger(box->high.z, other->high.z) };
}

bool lom_group_ground_blocks(struct lom_ground *ground, lom_error *error)
{
    const int across = groups_along(ground->across), down = groups_along(ground->down);
    ground->groups = lom_allocate((size_t)across * (size_t)down, sizeof *ground->groups, error);
    ground->seen = lom_allocate((size_t)ground->across * (size_t)ground->down, sizeof *ground->seen, error);
    if (ground->groups == NULL || ground->seen == NULL)
        return false;
    for (int y = 0; y < ground->down; y++)
        for (int x = 0; x < ground->across; x++) {
            const lom_box *bounds = &ground->blocks[y * ground->across + x].bounds;
            lom_box *group = &ground->groups[y / GROUP * across + x / GROUP];
            if (x % GROUP == 0 && y % GROUP == 0)
                *group = *bounds;
            widen(group, bounds);
        }
    return true;
}

/* How much of a box is seen; where the reach ends, what is inside may be out of it. */
static lom_visibility see(const struct lom_culler *culler, double reach, const lom_box *box)
{
    if (culler == NULL)
        return LOM_INSIDE;
    if (reach != LOM_EVERYWHERE && !(lom_distance_to_box(culler->eye, *box) < reach))
        return LOM_OUTSIDE;
    const lom_visibility visibility = lom_view_visibility(culler, box);
    return visibility == LOM_INSIDE && reach != LOM_EVERYWHERE ? LOM_CROSSING : visibility;
}

/* How many blocks are seen, `enough` at most. */
static int look(const struct lom_ground *ground, const struct lom_culler *culler, double reach, int enough)
{
    const int across = groups_along(ground->across), down = groups_along(ground->down);
    int count = 0;
    for (int group = 0; group < across * down; group++) {
        const lom_visibility all = see(culler, reach, &ground->groups[group]);
        const int x0 = group % across * GROUP, x1 = lom_smaller_int(x0 + GROUP, ground->across);
        const int y0 = group / across * GROUP, y1 = lom_smaller_int(y0 + GROUP, ground->down);
        for (int y = y0; y < y1; y++)
            for (int x = x0; x < x1; x++) {
                const int number = y * ground->across + x;
                ground->seen[number] =
                    all == LOM_INSIDE ||
                    (all == LOM_CROSSING && see(culler, reach, &ground->blocks[number].bounds) != LOM_OUTSIDE);
                count += ground->seen[number];
                if (count == enough)
                    return count;
            }
    }
    return count;
}

int lom_see_ground(const struct lom_ground *ground, const struct lom_culler *culler, double reach)
{
    return look(ground, culler, reach, INT32_MAX);
}

bool lom_shows_ground(const struct lom_ground *ground, const struct lom_culler *culler)
{
    return look(ground, culler, LOM_EVERYWHERE, 1) > 0;
}
