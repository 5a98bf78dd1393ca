/* Stage 2 of 7: clip. In: a triangle or line with a vertex outside the near plane, the far plane, w > 0 or the guard
 * band. Out: the fan of triangles, or the line, that is left of it, its new vertices appended to the chunk's rows. User
 * clip distances are not cut here: the raster stage tests their sign at each pixel, which splits a triangle between d and
 * -d exactly.
 *
 * Invariant: an edge that two triangles share is cut at bitwise the same vertex, because every edge is cut from its
 * lexicographically smaller clip position, in double. Few triangles get here: one at a time, in order. */
#include "pipeline/project.h"
#include "pipeline/stages.h"

enum { PLANES = 7, MAX_POLYGON = 3 + PLANES };

struct plane { /* inside where x X + y Y + z Z + w W + constant >= 0 */
    double x, y, z, w, constant;
    unsigned code;
    int axis; /* the coordinate that is ratio W on the plane; 3: W itself is ratio */
    float ratio;
};

static void list_planes(const struct lom_pass *pass, const struct lom_draw *draw, struct plane planes[PLANES])
{
    struct lom_guard guard = lom_guard_of(&draw->desc.viewport);
    bool centred = pass->desc.clip_range == LOM_CLIP_MINUS_W_TO_W;
    struct plane list[PLANES] = {
        { 0, 0, 0, 1, -(double)LOM_SMALLEST_W, CODE_W, 3, LOM_SMALLEST_W },
        { 0, 0, centred ? 1 : -1, 1, 0, CODE_NEAR, 2, centred ? -1 : 1 },
        { 0, 0, centred ? -1 : 1, centred ? 1 : 0, 0, CODE_FAR, 2, centred ? 1 : 0 },
        { 1, 0, 0, guard.x, 0, CODE_GUARD, 0, -guard.x },
        { -1, 0, 0, guard.x, 0, CODE_GUARD, 0, guard.x },
        { 0, 1, 0, guard.y, 0, CODE_GUARD, 1, -guard.y },
        { 0, -1, 0, guard.y, 0, CODE_GUARD, 1, guard.y },
    };
    memcpy(planes, list, sizeof list);
}

static double distance_to(const struct plane *plane, const float *p)
{
    return plane->x * p[0] + plane->y * p[1] + plane->z * p[2] + plane->w * p[3] + plane->constant;
}

static bool is_smaller(const float *a, const float *b)
{
    for (int i = 0; i < 4; i++)
        if (a[i] != b[i])
            return a[i] < b[i];
    return false;
}

/* (q dA - p dB) / (dA - dB): what p + (q - p) t is for t = dA / (dA - dB), without its cancellation when the result is
 * far smaller than p, as it is next to w = 0. */
static float mix(float p, float q, double da, double db)
{
    return (float)((q * da - p * db) / (da - db));
}

/* Outcode of a row's distances, as the vertex stage has it. */
static uint16_t distance_code(const struct lom_draw *draw, const float *row)
{
    unsigned code = 0;
    for (int i = 0; i < draw->distances; i++)
        code |= (unsigned)(row[draw->distance_offset + i] < 0) << i;
    return (uint16_t)code;
}

/* Appends the point of edge (a, b) on the plane; returns its row number. */
static uint32_t cut_edge(const struct plane *plane, struct lom_chunk *chunk, uint32_t a, uint32_t b)
{
    if (is_smaller(chunk->assembly->clip + (size_t)b * 4, chunk->assembly->clip + (size_t)a * 4)) {
        uint32_t swap = a;
        a = b;
        b = swap;
    }
    size_t pitch = (size_t)chunk->draw->row_floats;
    uint32_t row = (uint32_t)chunk->row_count++;
    const float *p = chunk->assembly->clip + (size_t)a * 4, *q = chunk->assembly->clip + (size_t)b * 4;
    float *result = chunk->assembly->clip + (size_t)row * 4;
    double da = distance_to(plane, p), db = distance_to(plane, q);
    for (size_t i = 0; i < 4; i++)
        result[i] = mix(p[i], q[i], da, db);
    result[plane->axis] = plane->axis == 3 ? plane->ratio : plane->ratio * result[3]; /* exactly on the plane */
    const float *from = chunk->rows + a * pitch, *to = chunk->rows + b * pitch;
    for (size_t i = ROW_HEADER; i < pitch; i++)
        chunk->rows[row * pitch + i] = mix(from[i], to[i], da, db);
    chunk->assembly->codes[row] = distance_code(chunk->draw, chunk->rows + row * pitch);
    return row;
}

/* Sutherland-Hodgman: the part of the polygon inside one plane. */
static int cut_polygon(const struct plane *plane, struct lom_chunk *chunk, uint32_t *polygon, int count)
{
    uint32_t result[MAX_POLYGON];
    int length = 0;
    for (int i = 0; i < count; i++) {
        uint32_t a = polygon[i], b = polygon[i + 1 < count ? i + 1 : 0];
        bool a_inside = distance_to(plane, chunk->assembly->clip + (size_t)a * 4) >= 0;
        bool b_inside = distance_to(plane, chunk->assembly->clip + (size_t)b * 4) >= 0;
        if (a_inside)
            result[length++] = a;
        if (a_inside != b_inside)
            result[length++] = cut_edge(plane, chunk, a, b);
    }
    memcpy(polygon, result, (size_t)length * sizeof *polygon);
    return length;
}

static float clamp_ratio(float value, float w, float limit)
{
    float ratio = value / w;
    return ratio > limit ? limit : ratio < -limit ? -limit : ratio;
}

static int32_t snap(float units)
{
    return lom_int_of(__builtin_rintf(units));
}

/* The row's header, by the same steps as the vertex stage. A cut on the guard band is held to it: w times the band's
 * edge was rounded. What is exactly inside divides to no more than the edge, so that nothing holds it. */
static void project_row(const struct lom_pass *pass, struct lom_chunk *chunk, uint32_t number)
{
    struct lom_projection f = lom_projection_of(pass, chunk->draw);
    struct lom_guard guard = lom_guard_of(&chunk->draw->desc.viewport);
    float *row = chunk->rows + (size_t)number * (size_t)chunk->draw->row_floats;
    const float *p = chunk->assembly->clip + (size_t)number * 4;
    float w = p[3] < LOM_SMALLEST_W ? LOM_SMALLEST_W : p[3];
    int32_t x = snap(clamp_ratio(p[0], w, guard.x) * f.x_scale + f.x_offset);
    int32_t y = snap(clamp_ratio(p[1], w, guard.y) * f.y_scale + f.y_offset);
    float z = p[2] / w * f.z_scale + f.z_offset;
    memcpy(row, &x, sizeof x);
    memcpy(row + 1, &y, sizeof y);
    row[2] = z > f.z_low ? z < f.z_high ? z : f.z_high : f.z_low;
    row[3] = 1.0f / w;
}

static float bounded(double x)
{
    return x > (double)__FLT_MAX__ ? __FLT_MAX__ : x < -(double)__FLT_MAX__ ? -__FLT_MAX__ : (float)x;
}

static struct plane turn(const struct plane *p)
{
    return (struct plane){ -p->x, -p->y, -p->z, -p->w, -p->constant, p->code, p->axis, p->ratio };
}

enum { PIECES = 3 }; /* between near and far, before near, behind far */

/* The planes that bound a piece, of those whose codes a primitive has. With depth_clamp what near and far cut off is a
 * piece, too: its depths are clamped vertex by vertex, to one value. */
static int list_bounds(const struct lom_pass *pass, const struct lom_draw *draw, unsigned codes, int piece,
                       struct plane bounds[PLANES])
{
    static const unsigned outside[PIECES] = { 0, CODE_NEAR, CODE_FAR };
    struct plane planes[PLANES];
    int count = 0;
    list_planes(pass, draw, planes);
    for (int i = 0; i < PLANES; i++) {
        bool cuts = (codes & planes[i].code) != 0;
        if (cuts && planes[i].code == outside[piece])
            bounds[count++] = turn(&planes[i]);
        else if (cuts && (piece == 0 || (planes[i].code & (CODE_NEAR | CODE_FAR)) == 0))
            bounds[count++] = planes[i];
    }
    return count;
}

/* Whether a primitive with these codes has the piece. */
static bool has_piece(const struct lom_chunk *chunk, unsigned codes, int piece)
{
    return piece == 0 || (chunk->draw->desc.depth_clamp && (codes & (piece == 1 ? CODE_NEAR : CODE_FAR)) != 0);
}

/* ---- varyings that are linear in the window ----
 *
 * Of f = A x/w + B y/w + C, f w = A x + B y + C w is linear in clip space, also where w passes through 0: while a primitive
 * is cut, its rows are copies that hold f w. */

/* Corner k of the primitive becomes such a copy; there is room for it. */
static void hold_products(struct lom_chunk *chunk, uint32_t *corner)
{
    const lom_shader *shader = chunk->draw->desc.shader;
    const size_t pitch = (size_t)chunk->draw->row_floats;
    const uint32_t copy = (uint32_t)chunk->row_count++;
    float *clip = chunk->assembly->clip, *row = chunk->rows + copy * pitch;
    memcpy(row, chunk->rows + *corner * pitch, pitch * sizeof *row);
    memcpy(clip + (size_t)copy * 4, clip + (size_t)*corner * 4, 4 * sizeof *clip);
    chunk->assembly->codes[copy] = chunk->assembly->codes[*corner];
    for (int v = 0; v < shader->varyings; v++)
        if (shader->screen_linear >> v & 1)
            row[ROW_HEADER + v] *= clip[(size_t)copy * 4 + 3];
    *corner = copy;
}

/* The values of a row that is left: those of the corner that it was copied from, or the quotients. */
static void release_products(struct lom_chunk *chunk, uint32_t number, const uint32_t *copy, const uint32_t *corner,
                             int count)
{
    const lom_shader *shader = chunk->draw->desc.shader;
    const size_t pitch = (size_t)chunk->draw->row_floats;
    float *values = chunk->rows + number * pitch + ROW_HEADER;
    const float *source = NULL, w = chunk->assembly->clip[(size_t)number * 4 + 3];
    for (int k = 0; k < count; k++)
        if (copy[k] == number)
            source = chunk->rows + corner[k] * pitch + ROW_HEADER;
    for (int v = 0; v < shader->varyings; v++)
        if (shader->screen_linear >> v & 1)
            values[v] =
                source != NULL ? source[v] : bounded((double)values[v] / (w < LOM_SMALLEST_W ? LOM_SMALLEST_W : w));
}

/* The fan of a piece of a triangle; how many triangles it has. */
static int clip_piece(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t corner[3],
                      const struct plane *bounds, int bound_count, uint32_t (*fan)[3])
{
    const bool is_linear = chunk->draw->desc.shader->screen_linear != 0;
    uint32_t polygon[MAX_POLYGON] = { corner[0], corner[1], corner[2] };
    int count = 3;
    if (!lom_reserve_rows(chunk, chunk->row_count + 2 * PLANES + 3))
        return 0;
    for (int i = 0; i < 3 && is_linear; i++)
        hold_products(chunk, &polygon[i]);
    const uint32_t copy[3] = { polygon[0], polygon[1], polygon[2] };
    for (int i = 0; i < bound_count && count >= 3; i++)
        count = cut_polygon(&bounds[i], chunk, polygon, count);
    for (int i = 0; i < count; i++) {
        if (is_linear)
            release_products(chunk, polygon[i], copy, corner, 3);
        project_row(pass, chunk, polygon[i]);
    }
    for (int i = 0; i + 2 < count; i++) {
        fan[i][0] = polygon[0];
        fan[i][1] = polygon[i + 1];
        fan[i][2] = polygon[i + 2];
    }
    return count < 3 ? 0 : count - 2;
}

int lom_clip_triangle(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t corner[3], unsigned codes,
                      uint32_t fan[LOM_MAX_FAN][3])
{
    struct plane bounds[PLANES];
    int count = 0;
    for (int piece = 0; piece < PIECES; piece++)
        if (has_piece(chunk, codes, piece))
            count += clip_piece(pass, chunk, corner, bounds, list_bounds(pass, chunk->draw, codes, piece, bounds),
                                fan + count);
    chunk->triangles_clipped++;
    return count;
}

/* A line that is cut keeps its flat varyings: its provoking vertex' are written to the new one. */
static void keep_flat(struct lom_chunk *chunk, uint32_t provoking, uint32_t cut)
{
    size_t pitch = (size_t)chunk->draw->row_floats;
    const float *from = chunk->rows + provoking * pitch + ROW_HEADER;
    float *to = chunk->rows + cut * pitch + ROW_HEADER;
    for (int v = 0; cut != provoking && v < chunk->draw->desc.shader->varyings; v++)
        if (chunk->draw->desc.shader->flat >> v & 1)
            to[v] = from[v];
}

/* A piece of a line; false where there is none. */
static bool clip_line_piece(const struct lom_pass *pass, struct lom_chunk *chunk, const struct plane *bounds,
                            int bound_count, uint32_t end[2])
{
    const int provoking = chunk->draw->desc.provoking == LOM_PROVOKING_FIRST ? 0 : 1;
    const bool is_linear = chunk->draw->desc.shader->screen_linear != 0;
    const uint32_t corner[2] = { end[0], end[1] };
    if (!lom_reserve_rows(chunk, chunk->row_count + 2 * PLANES + 2))
        return false;
    for (int k = 0; k < 2 && is_linear; k++)
        hold_products(chunk, &end[k]);
    const uint32_t copy[2] = { end[0], end[1] };
    for (int i = 0; i < bound_count; i++) {
        bool inside[2];
        for (int k = 0; k < 2; k++)
            inside[k] = distance_to(&bounds[i], chunk->assembly->clip + (size_t)end[k] * 4) >= 0;
        if (!inside[0] && !inside[1])
            return false;
        if (inside[0] != inside[1])
            end[inside[0] ? 1 : 0] = cut_edge(&bounds[i], chunk, end[0], end[1]);
    }
    for (int k = 0; k < 2; k++) {
        if (is_linear)
            release_products(chunk, end[k], copy, corner, 2);
        project_row(pass, chunk, end[k]);
    }
    keep_flat(chunk, corner[provoking], end[provoking]);
    return true;
}

int lom_clip_line(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t end[2], unsigned codes,
                  uint32_t result[LOM_LINE_PIECES][2])
{
    struct plane bounds[PLANES];
    int count = 0;
    chunk->triangles_clipped++;
    for (int piece = 0; piece < PIECES; piece++) {
        if (!has_piece(chunk, codes, piece))
            continue;
        result[count][0] = end[0];
        result[count][1] = end[1];
        count +=
            clip_line_piece(pass, chunk, bounds, list_bounds(pass, chunk->draw, codes, piece, bounds), result[count]);
    }
    return count;
}
