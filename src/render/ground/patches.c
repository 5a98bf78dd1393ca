/* Terrain as patches that tessellation cuts (quality.tessellation). In: heights. Out: knots, every LOM_GROUND_PATCH quads and
 * at the borders, and the patches between them, block after block. A knot holds how far the surfaces that are put through the
 * corners of the patches around it are off the map: what the two ends of an edge hold, and how far it lies from the eye, says
 * how finely it is cut, from both of its sides. Compiled for speed. */
#include "base/numbers.h"
#include "render/ground/ground.h"

struct knots {
    struct lom_ground *ground;
    int across, down; /* patches */
};

static float height_at(const struct lom_ground *ground, int column, int row)
{
    return ground->heights[(size_t)row * (size_t)(ground->columns + 1) + (size_t)column];
}

static int column_of(const struct knots *k, int x)
{
    return lom_smaller_int(x * LOM_GROUND_PATCH, k->ground->columns);
}

static int row_of(const struct knots *k, int y)
{
    return lom_smaller_int(y * LOM_GROUND_PATCH, k->ground->rows);
}

/* How far the bilinear surface through the corners of a patch is off the map's vertices, upright. */
static float error_of(const struct knots *k, int x, int y)
{
    const struct lom_ground *g = k->ground;
    int x0 = column_of(k, x), x1 = column_of(k, x + 1), y0 = row_of(k, y), y1 = row_of(k, y + 1);
    float a = height_at(g, x0, y0), b = height_at(g, x1, y0), c = height_at(g, x0, y1), d = height_at(g, x1, y1);
    float worst = 0;
    for (int j = y0; j <= y1; j++)
        for (int i = x0; i <= x1; i++) {
            float s = (float)(i - x0) / (float)(x1 - x0), t = (float)(j - y0) / (float)(y1 - y0);
            float upper = a + s * (b - a), lower = c + s * (d - c);
            float off = upper + t * (lower - upper) - height_at(g, i, j);
            off = off < 0 ? -off : off;
            worst = off > worst ? off : worst;
        }
    return worst;
}

/* Raises the four corners of a patch to its error. */
static void raise_corners(const struct knots *k, int x, int y, float error)
{
    for (int i = 0; i < 4; i++) {
        float *knot = k->ground->knot[(size_t)(y + i / 2) * (size_t)(k->across + 1) + (size_t)(x + i % 2)];
        knot[3] = error > knot[3] ? error : knot[3];
    }
}

/* Rows run towards the viewer of the map: v runs back, so that patches face up. */
static void add_patch(const struct knots *k, int x, int y, uint32_t *corner)
{
    uint32_t pitch = (uint32_t)(k->across + 1), a = (uint32_t)y * pitch + (uint32_t)x;
    corner[0] = a + pitch;
    corner[1] = a + pitch + 1;
    corner[2] = a + 1;
    corner[3] = a;
}

static void add_block(const struct knots *k, int block, size_t *count)
{
    enum { ALONG = LOM_GROUND_BLOCK / LOM_GROUND_PATCH };
    struct lom_ground *g = k->ground;
    int x0 = block % g->across * ALONG, y0 = block / g->across * ALONG;
    g->blocks[block].first_corner = *count;
    for (int y = y0; y < lom_smaller_int(y0 + ALONG, k->down); y++)
        for (int x = x0; x < lom_smaller_int(x0 + ALONG, k->across); x++) {
            raise_corners(k, x, y, error_of(k, x, y));
            add_patch(k, x, y, g->patch_corner + *count);
            *count += 4;
        }
    g->blocks[block].corners = *count - g->blocks[block].first_corner;
}

bool lom_make_ground_patches(struct lom_ground *ground, lom_error *error)
{
    struct knots k = { .ground = ground,
                       .across = (ground->columns + LOM_GROUND_PATCH - 1) / LOM_GROUND_PATCH,
                       .down = (ground->rows + LOM_GROUND_PATCH - 1) / LOM_GROUND_PATCH };
    size_t patches = (size_t)k.across * (size_t)k.down;
    ground->knot_count = (size_t)(k.across + 1) * (size_t)(k.down + 1);
    ground->knot = lom_allocate(ground->knot_count, sizeof *ground->knot, error);
    ground->patch_corner = lom_allocate(patches, 4 * sizeof *ground->patch_corner, error);
    if (ground->knot == NULL || ground->patch_corner == NULL)
        return false;
    for (int y = 0; y <= k.down; y++)
        for (int x = 0; x <= k.across; x++) {
            float *knot = ground->knot[(size_t)y * (size_t)(k.across + 1) + (size_t)x];
            knot[0] = (float)column_of(&k, x);
            knot[1] = (float)row_of(&k, y);
            knot[2] = height_at(ground, column_of(&k, x), row_of(&k, y));
        }
    for (int i = 0; i < ground->across * ground->down; i++)
        add_block(&k, i, &ground->patch_corner_count);
    return true;
}
