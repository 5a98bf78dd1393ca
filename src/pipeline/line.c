/* Chunks of lines: the stages 2 and 3 of 7 as far as they differ from those of triangles. In: a chunk's corners, two
 * vertices a line (the second one twice); shaded vertices. Out: a record for each line that may cover a pixel, in order.
 *
 * A line from a to b is to the later stages a triangle a, b, b whose weight of vertex 2 is 0: that of vertex 1 is the
 * "edge function" E(p) = (p - a) (b - a) over the "area" |b - a|^2, which are whole numbers.
 *
 * Invariant: a record is a function of its two vertices alone. */
#include "pipeline/record.h"

/* Along x or y: the pixels that a line from a to b may cover, `width` of them for each that the line of width 1 has. The
 * ends are moved by less than a unit to the left and up. */
struct extent {
    int low, high;
};

static struct extent bound(int32_t a, int32_t b, int width, int origin, int first, int last)
{
    int32_t least = a < b ? a : b, most = a < b ? b : a, moved = (width - 1) * (SUBPIXELS / 2);
    int low = ((least - moved - 1) >> SUBPIXEL_BITS) + origin;
    int high = ((most - moved) >> SUBPIXEL_BITS) + origin + width - 1;
    return (struct extent){ low > first ? low : first, high < last ? high : last };
}

/* The pixels of a line; false where it covers nothing. */
static bool set_up(const struct lom_draw *draw, const float *from, const float *to, lom_primitive *p)
{
    const lom_rect *s = &draw->scissor;
    int32_t a[2], b[2];
    memcpy(a, from, sizeof a);
    memcpy(b, to, sizeof b);
    int64_t x = (int64_t)b[0] - a[0], y = (int64_t)b[1] - a[1];
    bool steep = (y < 0 ? -y : y) > (x < 0 ? -x : x);
    int width = draw->desc.line_width;
    struct extent across = bound(a[0], b[0], steep ? width : 1, draw->desc.viewport.x, s->x, s->x + s->width - 1);
    struct extent down = bound(a[1], b[1], steep ? 1 : width, draw->desc.viewport.y, s->y, s->y + s->height - 1);
    if ((x == 0 && y == 0) || across.low > across.high || down.low > down.high)
        return false;
    p->first = (uint32_t)across.low | (uint32_t)down.low << 16;
    p->last = (uint32_t)across.high | (uint32_t)down.high << 16;
    return true;
}

void lom_find_line(const struct lom_chunk *chunk, const lom_primitive *primitive, lom_triangle *t)
{
    const float *from = chunk->rows + primitive->row[0], *to = chunk->rows + primitive->row[1];
    int32_t a[2], b[2];
    memcpy(a, from, sizeof a);
    memcpy(b, to, sizeof b);
    int64_t x = (int64_t)b[0] - a[0], y = (int64_t)b[1] - a[1];
    float depth = to[2] - from[2];
    *t = (lom_triangle){ .primitive = *primitive,
                         .step_x1 = (float)(x * SUBPIXELS), /* below 2^32, of 24 bits: exact */
                         .step_y1 = (float)(y * SUBPIXELS),
                         .inverse_area = (float)(1.0 / (double)(x * x + y * y)),
                         .depth = { from[2], depth, depth } };
}

/* Appends the record of the line between two rows, unless it covers nothing. */
static void add_piece(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t end[2])
{
    struct lom_assembly *assembly = chunk->assembly;
    const struct lom_draw *draw = chunk->draw;
    const size_t pitch = (size_t)draw->row_floats;
    const unsigned distances = (1u << draw->desc.shader->clip_distances) - 1;
    const unsigned a = assembly->codes[end[0]] & distances, b = assembly->codes[end[1]] & distances;
    const uint32_t row[2] = { (uint32_t)(end[0] * pitch), (uint32_t)(end[1] * pitch) };
    const unsigned provoking = draw->desc.provoking == LOM_PROVOKING_FIRST ? 0 : 1;
    lom_primitive p = { .row = { row[0], row[1], row[1] },
                        .state = TRIANGLE_NONE << TRIANGLE_KIND | 1u << TRIANGLE_FRONT |
                                 provoking << TRIANGLE_PROVOKING | (a | b) << TRIANGLE_CLIP };
    const bool left = (a & b) == 0 && set_up(draw, chunk->rows + row[0], chunk->rows + row[1], &p);
    if (pass->recorder != NULL)
        lom_record_line(chunk, end, left);
    if (left)
        lom_add_primitive(pass, chunk, &p);
}

/* What is left of the line between two rows, unless it is outside. */
static void add(const struct lom_pass *pass, struct lom_chunk *chunk, const uint32_t corner[2])
{
    uint32_t piece[LOM_LINE_PIECES][2] = { { corner[0], corner[1] } };
    const unsigned a = chunk->assembly->codes[corner[0]], b = chunk->assembly->codes[corner[1]];
    if ((a & b & lom_reject_codes(chunk->draw)) != 0 || ((a | b) & CODE_INVALID) != 0)
        return;
    const int count = ((a | b) & CODE_CLIP) != 0 ? lom_clip_line(pass, chunk, corner, a | b, piece) : 1;
    for (int i = 0; i < count; i++)
        add_piece(pass, chunk, piece[i]);
}

void lom_set_up_lines(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    struct lom_assembly *assembly = chunk->assembly;
    if (!lom_reserve_primitives(chunk, chunk->count * (chunk->draw->desc.depth_clamp ? LOM_LINE_PIECES : 1)))
        return;
    for (size_t i = 0; i < chunk->count && !chunk->failed; i++) {
        const bool near = pass->recorder != NULL && lom_record_triangle(pass, chunk, i);
        const size_t before = chunk->triangle_count;
        if (assembly->corners[3 * i] != NO_VERTEX)
            add(pass, chunk, assembly->corners + 3 * i);
        if (near)
            lom_record_set_up(pass, chunk, before);
    }
}
