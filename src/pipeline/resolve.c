/* The two ends of tile memory. In: clear values or the attachments' texels. Out: after the pass, the attachments'
 * texels. Tile memory holds blocks of 2x2 pixels, rows of blocks from the top; attachments are rows of pixels. */
#include "pipeline/device.h"
#include "pipeline/variants.h"

/* What of a tile lies inside the attachments, in their pixels. */
struct part {
    int x, y;           /* attachment pixel of the tile's first pixel; may be negative */
    int x0, y0, x1, y1; /* tile pixels inside: first, and one past the last */
};

static struct part part_of(const struct lom_pass *pass, int number)
{
    int x = pass->tile_x0 + number % pass->tiles_x * pass->tile - pass->desc.origin_x;
    int y = pass->tile_y0 + number / pass->tiles_x * pass->tile - pass->desc.origin_y;
    struct part p = { x, y, 0, 0, pass->tile, pass->tile };
    if (x < 0)
        p.x0 = -x;
    if (y < 0)
        p.y0 = -y;
    if (x + pass->tile > pass->width)
        p.x1 = pass->width - x;
    if (y + pass->tile > pass->height)
        p.y1 = pass->height - y;
    return p;
}

/* Whether all of the tile lies inside. */
static bool is_whole(const struct lom_pass *pass, const struct part *p)
{
    return (p->x0 | p->y0) == 0 && p->x1 == pass->tile && p->y1 == pass->tile;
}

static size_t memory_index(int edge, int x, int y)
{
    return (size_t)((y >> 1) * (edge / 2) + (x >> 1)) * 4 + (size_t)((y & 1) * 2 + (x & 1));
}

static size_t tile_pixels(const struct lom_pass *pass)
{
    return (size_t)pass->tile * (size_t)pass->tile;
}

bool lom_fills_columns(const lom_texture *texture, lom_slice slice)
{
    return texture->kind == LOM_TEXTURE_2D && slice.level == 0 && texture->decoded == NULL;
}

static void fill_columns(const struct lom_pass *pass, const struct part *p, lom_texture *texture, lom_slice slice)
{
    if (!lom_fills_columns(texture, slice))
        return;
    if (p->x <= 0)
        lom_fill_column(texture, 0, 0, p->y + p->y0, p->y + p->y1, false);
    if (p->x + pass->tile >= pass->width)
        lom_fill_column(texture, 0, 0, p->y + p->y0, p->y + p->y1, true);
}

void lom_fill_tile_columns(const struct lom_pass *pass, int number)
{
    struct part p = part_of(pass, number);
    for (int i = 0; i < pass->colors; i++)
        fill_columns(pass, &p, pass->color[i].texture, pass->color[i].slice);
    if (pass->depth != NULL)
        fill_columns(pass, &p, pass->depth, pass->depth_slice);
}

size_t lom_image_bytes(const struct lom_pass *pass, int i)
{
    return tile_pixels(pass) * (pass->color[i].kind == COLOR_FLOAT ? 16 : 4);
}

static uint32_t bits_of(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static const struct lom_stages *stages_of(const struct lom_pass *pass)
{
    return lom_stages_of(pass->device->variant);
}

/* Pixel (p->x0, y) of the tile in an attachment. */
static void *row_of(lom_texture *texture, lom_slice slice, const struct part *p, int y)
{
    return lom_texel(texture, slice.level, p->x + p->x0, p->y + y, slice.layer);
}

/* The rectangle of an attachment that a part is, with words as they are. */
static struct lom_rectangle rectangle_of(const struct lom_pass *pass, lom_texture *texture, lom_slice slice,
                                         const struct part *p)
{
    struct lom_rectangle r = { .edge = pass->tile,
                               .x = p->x0,
                               .y = p->y0,
                               .width = p->x1 - p->x0,
                               .height = p->y1 - p->y0,
                               .texels = row_of(texture, slice, p, p->y0),
                               .pitch = texture->level[slice.level].pitch,
                               .keep = -1 };
    r.streams = pass->streams && ((uintptr_t)r.texels | r.pitch * sizeof *r.texels) % 64 == 0;
    return r;
}

static struct lom_rectangle depth_rectangle(const struct lom_pass *pass, const struct part *p)
{
    struct lom_rectangle r = rectangle_of(pass, pass->depth, pass->depth_slice, p);
    r.divisor = (float)pass->depth_scale;
    return r;
}

/* Channels that the format lacks read as 0, a missing alpha as 1. */
static struct lom_rectangle byte_rectangle(const struct lom_pass *pass, int i, const struct part *p)
{
    struct lom_rectangle r = rectangle_of(pass, pass->color[i].texture, pass->color[i].slice, p);
    int channels = lom_describe_format(pass->color[i].format)->channels;
    if (channels < 4) {
        r.keep = (1 << 8 * channels) - 1;
        r.set = (int32_t)0xff000000u;
    }
    return r;
}

/* Pixels first to end (one past the last) of a row of an attachment to a row of tile memory: two of each block. */
static void fill_row(uint32_t *restrict to, const uint32_t *restrict from, int first, int end)
{
    for (int x = first; x < end; x++)
        to[x * 2 - (x & 1)] = from[x - first];
}

/* Whether rows y and y + 1 begin with a block and are both wanted. */
static bool begins_blocks(const struct part *p, int y)
{
    return ((p->x0 | y) & 1) == 0 && y + 1 < p->y1;
}

static void load_words(const struct lom_pass *pass, lom_texture *texture, lom_slice slice, const struct part *p,
                       uint32_t *memory)
{
    for (int y = p->y0; y < p->y1; y++) {
        uint32_t *to = memory + memory_index(pass->tile, 0, y);
        const uint32_t *row = row_of(texture, slice, p, y);
        if (!begins_blocks(p, y)) {
            fill_row(to, row, p->x0, p->x1);
            continue;
        }
        size_t blocks = (size_t)(p->x1 - p->x0) / 2, words = blocks * 2;
        const uint32_t *lower = row_of(texture, slice, p, ++y);
        stages_of(pass)->join_rows(row, lower, blocks, to + p->x0 * 2);
        fill_row(to, row + words, p->x0 + (int)words, p->x1);
        fill_row(to + 2, lower + words, p->x0 + (int)words, p->x1);
    }
}

static bool is_single(const struct lom_color_target *target)
{
    return target->texture->storage == LOM_STORAGE_R32F;
}

/* The rectangle of an attachment whose texels are four floats. */
static struct lom_rectangle texel_rectangle(const struct lom_pass *pass, const struct lom_color_target *target,
                                            const struct part *p)
{
    struct lom_rectangle r = rectangle_of(pass, target->texture, target->slice, p);
    r.pitch *= 4;
    return r;
}

/* Float planes of a tile from texels of one or four channels; those that are not there are 0, 0 and 1. */
static void load_floats(const struct lom_pass *pass, const struct lom_color_target *target, const struct part *p,
                        float *memory)
{
    const struct lom_rectangle r = texel_rectangle(pass, target, p);
    if (!is_single(target)) {
        stages_of(pass)->load_texels(&r, memory);
        return;
    }
    load_words(pass, target->texture, target->slice, p, (uint32_t *)(void *)memory);
    for (size_t c = 1; c < 4; c++)
        stages_of(pass)->fill_words((uint32_t *)(void *)(memory + c * tile_pixels(pass)), bits_of(c == 3 ? 1.0f : 0.0f),
                                    tile_pixels(pass));
}

static void clear_color(const struct lom_pass *pass, int i, void *memory)
{
    const struct lom_color_target *target = &pass->color[i];
    if (target->kind != COLOR_FLOAT) {
        stages_of(pass)->fill_words(memory, target->clear_bytes, tile_pixels(pass));
        return;
    }
    for (size_t c = 0; c < 4; c++)
        stages_of(pass)->fill_words((uint32_t *)memory + c * tile_pixels(pass), bits_of(target->clear[c]),
                                    tile_pixels(pass));
}

static void load_depth_texels(const struct lom_pass *pass, const struct part *p, float *memory)
{
    load_words(pass, pass->depth, pass->depth_slice, p, (uint32_t *)(void *)memory);
    for (int y = p->y0; pass->depth_scale != 0 && y < p->y1; y++)
        for (int x = p->x0; x < p->x1; x++) {
            float *z = memory + memory_index(pass->tile, x, y);
            *z = (float)__builtin_rint(*z * pass->depth_scale);
        }
}

void lom_load_depth(const struct lom_pass *pass, int number, float *memory)
{
    struct part p = part_of(pass, number);
    const bool keeps = pass->desc.depth_load == LOM_LOAD_KEEP;
    if (!keeps || !is_whole(pass, &p))
        stages_of(pass)->fill_words((uint32_t *)(void *)memory, bits_of(pass->clear_depth), tile_pixels(pass));
    if (keeps)
        load_depth_texels(pass, &p, memory);
}

void lom_load_color(const struct lom_pass *pass, int i, int number, void *memory)
{
    struct part p = part_of(pass, number);
    if (!pass->color[i].keep || !is_whole(pass, &p))
        clear_color(pass, i, memory);
    if (pass->color[i].keep && pass->color[i].kind == COLOR_FLOAT)
        load_floats(pass, &pass->color[i], &p, memory);
    else if (pass->color[i].keep)
        load_words(pass, pass->color[i].texture, pass->color[i].slice, &p, memory);
}

void lom_load_tile(const struct lom_pass *pass, int number, uint8_t *memory)
{
    if (pass->uses_depth) {
        lom_load_depth(pass, number, (float *)(void *)memory);
        memory += tile_pixels(pass) * 4;
    }
    if (pass->uses_stencil) {
        lom_load_stencil(pass, number, (int32_t *)(void *)memory);
        memory += tile_pixels(pass) * 4;
    }
    for (int i = 0; i < pass->colors; i++) {
        lom_load_color(pass, i, number, memory);
        memory += lom_image_bytes(pass, i);
    }
}

static void resolve_floats(const struct lom_pass *pass, int i, const struct part *p, const float *memory)
{
    const struct lom_color_target *target = &pass->color[i];
    struct lom_rectangle r = rectangle_of(pass, target->texture, target->slice, p);
    if (is_single(target)) {
        stages_of(pass)->store_rectangle(&r, (const uint32_t *)(const void *)memory);
        return;
    }
    r = texel_rectangle(pass, target, p);
    stages_of(pass)->store_texels(&r, lom_describe_format(pass->color[i].format)->channels, memory);
}

static void clear_floats(const struct lom_pass *pass, int i, const struct part *p)
{
    const struct lom_color_target *target = &pass->color[i];
    const int channels = lom_describe_format(target->format)->channels;
    struct lom_rectangle r = rectangle_of(pass, target->texture, target->slice, p);
    float texel[4];
    if (is_single(target)) {
        stages_of(pass)->fill_rectangle(&r, bits_of(target->clear[0]));
        return;
    }
    r = texel_rectangle(pass, target, p);
    for (int c = 0; c < 4; c++)
        texel[c] = c < channels ? target->clear[c] : c == 3 ? 1.0f : 0.0f;
    stages_of(pass)->fill_texels(&r, texel);
}

/* A depth attachment that no draw of the pass writes ends as it began. */
static void resolve_depth(const struct lom_pass *pass, const struct part *p, const void *memory)
{
    struct lom_rectangle r = depth_rectangle(pass, p);
    if (memory != NULL)
        stages_of(pass)->store_rectangle(&r, memory);
    else if (pass->desc.depth_load != LOM_LOAD_KEEP)
        stages_of(pass)->fill_rectangle(&r, bits_of(pass->clear_depth));
}

void lom_resolve_depth(const struct lom_pass *pass, int number, const void *memory)
{
    struct part p = part_of(pass, number);
    resolve_depth(pass, &p, memory);
}

void lom_resolve_color(const struct lom_pass *pass, int i, int number, const void *memory)
{
    struct part p = part_of(pass, number);
    struct lom_rectangle r = byte_rectangle(pass, i, &p);
    if (pass->color[i].kind == COLOR_FLOAT)
        resolve_floats(pass, i, &p, memory);
    else
        stages_of(pass)->store_rectangle(&r, memory);
}

void lom_resolve_tile(const struct lom_pass *pass, int number, const uint8_t *memory)
{
    if (pass->depth != NULL)
        lom_resolve_depth(pass, number, pass->writes_depth ? memory : NULL);
    if (pass->uses_depth)
        memory += tile_pixels(pass) * 4;
    if (pass->has_stencil)
        lom_resolve_stencil(pass, number, pass->uses_stencil ? (const int32_t *)(const void *)memory : NULL);
    if (pass->uses_stencil)
        memory += tile_pixels(pass) * 4;
    for (int i = 0; i < pass->colors; i++) {
        lom_resolve_color(pass, i, number, memory);
        memory += lom_image_bytes(pass, i);
    }
}

void lom_load_whole_tile(struct lom_tile *tile)
{
    const struct lom_pass *pass = tile->pass;
    lom_load_tile(pass, tile->number, tile->memory);
    if (tile->whole != pass->color[0].clear_bytes)
        stages_of(pass)->fill_words(tile->color[0], tile->whole, tile_pixels(pass));
    tile->is_whole = false;
}

void lom_resolve_whole_tile(const struct lom_pass *pass, int number, uint32_t color)
{
    struct part p = part_of(pass, number);
    struct lom_rectangle r = byte_rectangle(pass, 0, &p);
    if (pass->depth != NULL)
        resolve_depth(pass, &p, NULL);
    if (pass->has_stencil)
        lom_resolve_stencil(pass, number, NULL);
    stages_of(pass)->fill_rectangle(&r, color);
}

void lom_clear_tile(const struct lom_pass *pass, int number)
{
    struct part p = part_of(pass, number);
    if (pass->depth != NULL)
        resolve_depth(pass, &p, NULL);
    if (pass->has_stencil)
        lom_resolve_stencil(pass, number, NULL);
    for (int i = 0; i < pass->colors; i++) {
        const struct lom_color_target *target = &pass->color[i];
        struct lom_rectangle r = byte_rectangle(pass, i, &p);
        if (target->keep)
            continue;
        if (target->kind == COLOR_FLOAT)
            clear_floats(pass, i, &p);
        else
            stages_of(pass)->fill_rectangle(&r, target->clear_bytes);
    }
}
