/* Which blocks of terrain a pass sees. In: what it can show of a box, and how far from its eye. Out: a flag for each block.
 *
 * Blocks are asked in squares of GROUP x GROUP: whose box is out of view has no block in view, since what is compared grows and
 * falls with the box's ends, rounded or not; whose box is within the view has all in view likewise. So only blocks about the
 * view's borders are asked, and those of a square only for the borders that it crosses. Compiled for speed. */
#include "base/numbers.h"
#include "geometry/frustum.h"
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

/* What is to be asked of the blocks of a square: planes of the frustum, the clip plane, the way. */
struct question {
    lom_frustum frustum;
    bool may_be_behind, may_be_far;
};

static double distance_to_farthest(lom_vec3 p, const lom_box *box)
{
    const double x = lom_larger(box->high.x - p.x, p.x - box->low.x),
                 y = lom_larger(box->high.y - p.y, p.y - box->low.y),
                 z = lom_larger(box->high.z - p.z, p.z - box->low.z);
    return lom_double_sqrt(x * x + y * y + z * z);
}

/* How much of a square is seen, and what is left to be asked where it crosses. */
static lom_visibility ask_square(const struct lom_culler *culler, double reach, const lom_box *box,
                                 struct question *left)
{
    if (culler == NULL)
        return LOM_INSIDE;
    if (reach != LOM_EVERYWHERE && !(lom_distance_to_box(culler->eye, *box) < reach))
        return LOM_OUTSIDE;
    const lom_visibility in_frustum = lom_find_crossed(&culler->frustum, *box, &left->frustum);
    const lom_visibility before = in_frustum == LOM_OUTSIDE ? LOM_OUTSIDE : lom_plane_visibility(culler, box);
    left->may_be_behind = before == LOM_CROSSING;
    left->may_be_far = reach != LOM_EVERYWHERE && !(distance_to_farthest(culler->eye, box) < reach);
    return before == LOM_INSIDE && left->may_be_far ? LOM_CROSSING : before == LOM_INSIDE ? in_frustum : before;
}

static bool ask_block(const struct lom_culler *culler, double reach, const lom_box *box, const struct question *left)
{
    return (!left->may_be_far || lom_distance_to_box(culler->eye, *box) < reach) &&
           lom_box_visibility(&left->frustum, *box) != LOM_OUTSIDE &&
           (!left->may_be_behind || lom_plane_visibility(culler, box) != LOM_OUTSIDE);
}

/* How many blocks are seen, `enough` at most. */
static int look(const struct lom_ground *ground, const struct lom_culler *culler, double reach, int enough)
{
    const int across = groups_along(ground->across), down = groups_along(ground->down);
    int count = 0;
    for (int group = 0; group < across * down; group++) {
        struct question left;
        const lom_visibility all = ask_square(culler, reach, &ground->groups[group], &left);
        const int x0 = group % across * GROUP, x1 = lom_smaller_int(x0 + GROUP, ground->across);
        const int y0 = group / across * GROUP, y1 = lom_smaller_int(y0 + GROUP, ground->down);
        for (int y = y0; y < y1; y++)
            for (int x = x0; x < x1; x++) {
                const int number = y * ground->across + x;
                ground->seen[number] =
                    all == LOM_INSIDE ||
                    (all == LOM_CROSSING && ask_block(culler, reach, &ground->blocks[number].bounds, &left));
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
