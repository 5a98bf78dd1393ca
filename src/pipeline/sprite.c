/* Chunks of sprites and points, which have one vertex each: the stages 1 to 3 of 7 as far as they differ from those of triangles.
 * In: a chunk's range; vertices with their half sides in pixels. Out: the vertices it needs; a record for each sprite
 * that may cover a pixel centre, in order.
 *
 * Invariant: a record is a function of its vertex alone, found by one source in single steps of float. */
#include "pipeline/record.h"

/* |D| in square pixels; pixels. The smallest point has sides of 1/256. */
static const float smallest_area = 0x1p-16f, smallest_point = 0x1p-18f, largest_side = 0x1p16f;

bool lom_find_vertex(const struct lom_chunk *chunk, size_t place, uint32_t *number)
{
    const lom_draw_desc *desc = &chunk->draw->desc;
    size_t at = desc->first + place;
    uint32_t index = desc->indices == NULL    ? (uint32_t)at
                     : desc->index_bits == 16 ? ((const uint16_t *)desc->indices)[at]
                                              : ((const uint32_t *)desc->indices)[at];
    bool none = desc->restart && desc->indices != NULL && index == (desc->index_bits == 16 ? UINT16_MAX : UINT32_MAX);
    int64_t vertex = (int64_t)index + chunk->base_vertex;
    *number = (uint32_t)vertex;
    return !none && vertex >= 0 && vertex < (int64_t)desc->vertex_count;
}

bool lom_choose_sprites(const struct lom_room *room, struct lom_chunk *chunk)
{
    struct lom_assembly *assembly = chunk->assembly;
    chunk->vertex_base = 0;
    chunk->vertex_count = 0;
    chunk->listed = true;
    size_t count = room->corners > chunk->count ? room->corners : chunk->count;
    if (!lom_renew(&assembly->vertex_list, &assembly->vertex_list_capacity, count, sizeof(uint32_t), NULL))
        return false;
    for (size_t i = 0; i < chunk->count; i++)
        chunk->vertex_count += lom_find_vertex(chunk, chunk->first + i, &assembly->vertex_list[chunk->vertex_count]);
    return true;
}

/* Along x or y: the pixels whose centres may be covered, and whether the scissor cuts them. */
struct extent {
    int low, high;
    bool cut;
};

/* Of a sprite that reaches so far from its middle. What is left out lies at least a pixel outside. */
static struct extent bound(int32_t middle, float reach, int origin, int first, int last)
{
    double at = (double)middle / SUBPIXELS - 0.5;
    int low = lom_int_of(lom_double_floor(at - (double)reach)) + origin;
    int high = origin - lom_int_of(lom_double_floor(-at - (double)reach));
    return (struct extent){ low > first ? low : first, high < last ? high : last, low < first || high > last };
}

static float size_of(float x)
{
    return x < 0 ? -x : x;
}

/* s and t have errors of a few roundings of their largest terms, up to (|a| + |b|) |a| |b| / |D| pixels: where those
 * are so large that a pixel beside the bounds might seem to be covered, the bounds are tested, too. */
static bool is_sliver(const float *a, const float *b, float area)
{
    float u = size_of(a[0]) + size_of(a[1]), v = size_of(b[0]) + size_of(b[1]);
    return u * v * (u + v) > size_of(area) * 0x1p18f;
}

/* The pixels of the sprite whose vertex has the row; false where it covers nothing. */
static bool set_up(const struct lom_pass *pass, const struct lom_draw *draw, const float *row, lom_primitive *p)
{
    const float *a = row + draw->axis_offset, *b = a + 2;
    const lom_rect *s = &draw->scissor;
    float area = a[0] * b[1] - a[1] * b[0];
    int32_t middle[2];
    for (int i = 0; i < 4; i++)
        if (!(size_of(a[i]) <= largest_side))
            return false;
    memcpy(middle, row, sizeof middle);
    const float more = pass->samples > 1 ? 0.5f : 0; /* samples lie so far from centres */
    struct extent x =
        bound(middle[0], size_of(a[0]) + size_of(b[0]) + more, draw->desc.viewport.x, s->x, s->x + s->width - 1);
    struct extent y =
        bound(middle[1], size_of(a[1]) + size_of(b[1]) + more, draw->desc.viewport.y, s->y, s->y + s->height - 1);
    if (!(size_of(area) >= (draw->drawn == LOM_POINTS ? smallest_point : smallest_area)) || x.low > x.high ||
        y.low > y.high)
        return false;
    p->first = (uint32_t)x.low | (uint32_t)y.low << 16;
    p->last = (uint32_t)x.high | (uint32_t)y.high << 16;
    p->state = TRIANGLE_NONE << TRIANGLE_KIND;
    if (x.cut || y.cut || is_sliver(a, b, area))
        p->state |= 1u << TRIANGLE_CUT;
    return true;
}

void lom_find_sprite(const struct lom_chunk *chunk, const lom_primitive *primitive, lom_triangle *t)
{
    const float *row = chunk->rows + primitive->row[0], *a = row + chunk->draw->axis_offset, *b = a + 2;
    float area = a[0] * b[1] - a[1] * b[0];
    *t = (lom_triangle){ .primitive = *primitive,
                         .step_x1 = b[1] / area,
                         .step_y1 = -b[0] / area,
                         .step_x2 = -a[1] / area,
                         .step_y2 = a[0] / area,
                         .depth = { row[2] } };
}

void lom_set_up_sprites(const struct lom_pass *pass, struct lom_chunk *chunk)
{
    const struct lom_draw *draw = chunk->draw;
    size_t pitch = (size_t)draw->row_floats;
    if (!lom_reserve_primitives(chunk, chunk->vertex_count))
        return;
    for (size_t i = 0; i < chunk->vertex_count; i++) {
        lom_primitive p = { .row = { (uint32_t)(i * pitch) } };
        const bool told = pass->recorder != NULL && lom_record_triangle(pass, chunk, i);
        const bool inside = chunk->assembly->codes[i] == 0;
        const bool drawn = inside && set_up(pass, draw, chunk->rows + i * pitch, &p);
        if (told) {
            const uint32_t end[2] = { (uint32_t)i, (uint32_t)i };
            if (inside)
                lom_record_line(chunk, end, drawn);
            lom_record_set_up(pass, chunk, chunk->triangle_count);
        }
        if (drawn)
            lom_add_primitive(pass, chunk, &p);
    }
}
