/* Where a mesh is cut by the level of the water. In: its triangles, placed. Out: pieces of the cut with the normals that
 * point out of the mesh, and from which sides what else is of the mesh keeps the water off each. Invariant: a function of
 * the mesh and its place, in the order of its triangles. */
#include "base/numbers.h"
#include "base/reserve.h"
#include "spray/hits.h"

enum { MOST_PIECES = 1024 }; /* of more, equally many are left out between each two */

static double side_of(const lom_mat4 *matrix)
{
    const double(*m)[4] = matrix->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* The cut of a triangle; false where there is none. A corner in the level counts as above it. */
static bool cut(const lom_vec3 corner[3], double level, double turned, struct lom_hit_place *out)
{
    double end[2][2];
    int ends = 0;
    for (int i = 0; i < 3; i++) {
        lom_vec3 low = corner[i], high = corner[(i + 1) % 3];
        if ((low.y < level) == (high.y < level))
            continue;
        if (high.y < low.y) { /* the same crossing for both triangles of an edge */
            const lom_vec3 swap = low;
            low = high;
            high = swap;
        }
        const double part = (level - low.y) / (high.y - low.y);
        end[ends][0] = low.x + part * (high.x - low.x);
        end[ends++][1] = low.z + part * (high.z - low.z);
    }
    if (ends != 2)
        return false;
    const lom_vec3 n = lom_vec3_cross(lom_vec3_subtract(corner[1], corner[0]), lom_vec3_subtract(corner[2], corner[0]));
    const double flat = lom_double_sqrt(n.x * n.x + n.z * n.z) * turned,
                 across[2] = { end[1][0] - end[0][0], end[1][1] - end[0][1] },
                 width = lom_double_sqrt(across[0] * across[0] + across[1] * across[1]);
    if (flat == 0 || !(width > 0))
        return false;
    *out = (struct lom_hit_place){ .place = { (end[0][0] + end[1][0]) / 2, (end[0][1] + end[1][1]) / 2 },
                                   .level = level,
                                   .way = { n.x / flat, n.z / flat },
                                   .width = width };
    return true;
}

/* Whether a ray from a place, against the way, meets a piece, which is straight across its normal. */
static bool stands_before(const struct lom_hit_place *piece, const double from[2], const double way[2])
{
    const double facing = piece->way[0] * way[0] + piece->way[1] * way[1];
    const double off[2] = { piece->place[0] - from[0], piece->place[1] - from[1] };
    if (facing == 0)
        return false;
    const double distance = -(piece->way[0] * off[0] + piece->way[1] * off[1]) / facing;
    const double along = piece->way[0] * (off[1] + distance * way[1]) - piece->way[1] * (off[0] + distance * way[0]);
    return distance > 1e-6 * piece->width && lom_larger(along, -along) <= piece->width / 2;
}

void lom_hit_way(int side, double way[2])
{
    const double angle = lom_two_pi * side / LOM_HIT_SIDES;
    way[0] = lom_double_cos(angle);
    way[1] = lom_double_sin(angle);
}

static void find_lee(struct lom_hit_place *pieces, size_t count)
{
    for (int side = 0; side < LOM_HIT_SIDES; side++) {
        double way[2];
        lom_hit_way(side, way);
        for (size_t i = 0; i < count; i++) {
            bool is_met = pieces[i].way[0] * way[0] + pieces[i].way[1] * way[1] < 0;
            for (size_t k = 0; is_met && k < count; k++)
                is_met = k == i || !stands_before(&pieces[k], pieces[i].place, way);
            pieces[i].met_from |= (uint32_t)is_met << side;
        }
    }
}

bool lom_find_waterline(struct lom_hits *hits, const struct lom_hit_body *body, double level, lom_error *error)
{
    const lom_mesh *mesh = body->mesh;
    const double turned = side_of(&body->world_from_model) < 0 ? -1 : 1;
    for (size_t i = 0; i + 2 < mesh->index_count; i += 3) {
        lom_vec3 corner[3];
        for (int k = 0; k < 3; k++) {
            const float *p = mesh->vertices[mesh->indices[i + (size_t)k]].position;
            const lom_vec3 at = { (double)p[0], (double)p[1], (double)p[2] };
            corner[k] = lom_transform_point(&body->world_from_model, at);
        }
        struct lom_hit_place piece;
        if (!cut(corner, level, turned, &piece))
            continue;
        if (!lom_reserve(&hits->places, &hits->capacity, hits->count + 1, sizeof *hits->places, error))
            return false;
        hits->places[hits->count++] = piece;
    }
    const size_t stride = (hits->count + MOST_PIECES - 1) / MOST_PIECES;
    for (size_t i = 0; stride > 1 && i * stride < hits->count; i++) {
        hits->places[i] = hits->places[i * stride];
        hits->places[i].width *= (double)stride;
    }
    if (stride > 1)
        hits->count = (hits->count + stride - 1) / stride;
    find_lee(hits->places, hits->count);
    return true;
}
