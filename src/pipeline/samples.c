/* Passes of several samples a pixel: where samples lie, and the two ends of their memory. In: clear values, texels, or the
 * samples that a texture keeps from the pass before. Out: texels, and the samples for the pass after.
 *
 * The samples of a depth attachment lie side by side, those of a pixel in rows of four. A colour attachment has an image, its
 * samples (8-bit codes likewise; floats in an image for each sample), and a flag for each block of 2x2 pixels: where it is not
 * set, the block's samples are all those of the image. A texture that keeps samples has this memory for each tile of the grid,
 * and a pass works in it; what the pass has elsewhere lasts as long as its tile.
 *
 * Invariant: a tile's samples are those that were left, whichever passes, of whatever draws, lie between. */
#include "pipeline/device.h"
#include "pipeline/variants.h"
#include "pipeline/samples.h"

static const struct lom_sample_offset centre[] = { { 0, 0 } };
static const struct lom_sample_offset two[] = { { 4, 4 }, { -4, -4 } };
static const struct lom_sample_offset four[] = { { -2, -6 }, { 6, -2 }, { -6, 2 }, { 2, 6 } };
static const struct lom_sample_offset eight[] = { { 1, -3 }, { -1, 3 },  { 5, 1 }, { -3, -5 },
                                                  { -5, 5 }, { -7, -1 }, { 3, 7 }, { 7, -7 } };
static const struct lom_sample_offset sixteen[] = { { 1, 1 },  { -1, -3 }, { -3, 2 }, { 4, -1 }, { -5, -2 }, { 2, 5 },
                                                    { 5, 3 },  { 3, -5 },  { -2, 6 }, { 0, -7 }, { -4, -6 }, { -6, 4 },
                                                    { -8, 0 }, { 7, -4 },  { 6, 7 },  { -7, -8 } };

const struct lom_sample_offset *lom_sample_offsets(int samples)
{
    static const struct lom_sample_offset *const patterns[LOM_MAX_SAMPLES + 1] = {
        [1] = centre, [2] = two, [4] = four, [8] = eight, [16] = sixteen
    };
    return samples >= 1 && samples <= LOM_MAX_SAMPLES ? patterns[samples] : NULL;
}

bool lom_sample_position(int samples, int i, int position[2])
{
    const struct lom_sample_offset *offset = lom_sample_offsets(samples);
    bool exists = offset != NULL && i >= 0 && i < samples;
    position[0] = exists ? offset[i].x : 0;
    position[1] = exists ? offset[i].y : 0;
    return exists;
}

static size_t tile_pixels(const struct lom_pass *pass)
{
    return (size_t)pass->tile * (size_t)pass->tile;
}

static size_t depth_bytes(const struct lom_pass *pass)
{
    return tile_pixels(pass) * 4 * (size_t)pass->sample_pitch;
}

/* Of the depth attachment: its depths, then its stencil. */
static size_t depth_stencil_bytes(const struct lom_pass *pass)
{
    return pass->has_stencil ? 2 * depth_bytes(pass) : depth_bytes(pass);
}

/* Of the samples of colour attachment i. */
static size_t sample_bytes(const struct lom_pass *pass, int i)
{
    return pass->color[i].kind == COLOR_FLOAT ? lom_image_bytes(pass, i) * (size_t)pass->samples : depth_bytes(pass);
}

static size_t color_bytes(const struct lom_pass *pass, int i)
{
    return lom_image_bytes(pass, i) + sample_bytes(pass, i) + tile_pixels(pass) / 4;
}

size_t lom_scratch_bytes(const struct lom_pass *pass)
{
    size_t most = tile_pixels(pass) * 4;

    for (int i = 0; i < pass->colors; i++)
        most = lom_image_bytes(pass, i) > most ? lom_image_bytes(pass, i) : most;
    return most;
}

static bool keeps(const struct lom_pass *pass, const lom_texture *texture)
{
    return texture->samples == pass->samples;
}

/* What kept.held says of a tile: the samples are in memory, those of the stencil are. */
enum held { HELD = 1, HELD_STENCIL = 2 };

static void forget(lom_texture *texture, enum held part)
{
    for (size_t i = 0; i < texture->kept.held_capacity; i++)
        texture->kept.held[i] = (uint8_t)(texture->kept.held[i] & ~part);
}

void lom_forget_samples(lom_texture *texture)
{
    forget(texture, HELD);
}

void lom_forget_other_samples(const struct lom_pass *pass)
{
    const bool others = pass->depth != NULL && !keeps(pass, pass->depth);
    if (others && (pass->writes_depth || pass->desc.depth_load != LOM_LOAD_KEEP))
        forget(pass->depth, HELD);
    if (others && (pass->uses_stencil || pass->desc.stencil_load != LOM_LOAD_KEEP))
        forget(pass->depth, HELD_STENCIL);
    for (int i = 0; i < pass->colors; i++)
        if (!keeps(pass, pass->color[i].texture))
            forget(pass->color[i].texture, HELD);
}

/* Room for the tiles of the pass. What a texture holds for another grid is forgotten. */
static bool keep(lom_device *device, const struct lom_pass *pass, lom_texture *texture, size_t bytes)
{
    struct lom_kept_samples *kept = &texture->kept;
    size_t tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    int x0 = pass->tile_x0 - pass->desc.origin_x, y0 = pass->tile_y0 - pass->desc.origin_y;
    if (kept->edge != pass->tile || kept->x0 != x0 || kept->y0 != y0) {
        forget(texture, HELD);
        forget(texture, HELD_STENCIL);
    }
    kept->edge = pass->tile;
    kept->x0 = x0;
    kept->y0 = y0;
    if (lom_reserve(&kept->memory, &kept->capacity, tiles * bytes, 1, NULL) &&
        lom_reserve(&kept->held, &kept->held_capacity, tiles, 1, NULL))
        return true;
    return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for %d samples a pixel of %dx%d.",
                    pass->samples, pass->width, pass->height);
}

static bool lay_room(lom_device *device)
{
    const size_t workers = (size_t)device->desc.threads;
    if (device->sampled == NULL)
        device->sampled = lom_allocate(workers, sizeof *device->sampled, &device->error);
    for (size_t i = 0; i < workers && device->sampled != NULL; i++)
        device->worker_tiles[i].sampled = &device->sampled[i];
    return device->sampled != NULL;
}

bool lom_lay_samples(lom_device *device, struct lom_pass *pass)
{
    pass->tile_bytes = 0;
    if (!lay_room(device))
        return false;
    if (pass->depth != NULL && !keeps(pass, pass->depth))
        pass->tile_bytes += depth_stencil_bytes(pass);
    else if (pass->depth != NULL && !keep(device, pass, pass->depth, depth_stencil_bytes(pass)))
        return false;
    for (int i = 0; i < pass->colors; i++) {
        lom_texture *texture = pass->color[i].texture;
        if (!keeps(pass, texture))
            pass->tile_bytes += color_bytes(pass, i);
        else if (!keep(device, pass, texture, color_bytes(pass, i)))
            return false;
    }
    return true;
}

/* The tile's memory of an attachment: the texture's, or the next of the pass's. */
static uint8_t *place(const struct lom_pass *pass, const lom_texture *texture, int number, size_t bytes,
                      uint8_t **memory)
{
    uint8_t *here = *memory;
    if (keeps(pass, texture))
        return texture->kept.memory + (size_t)number * bytes;
    *memory += bytes;
    return here;
}

void lom_place_samples(struct lom_pass *pass, struct lom_tile *tile, uint8_t *memory)
{
    if (pass->depth != NULL) {
        uint8_t *depth = place(pass, pass->depth, tile->number, depth_stencil_bytes(pass), &memory);
        tile->depth = pass->uses_depth ? (float *)(void *)depth : NULL;
        tile->stencil = pass->uses_stencil ? (int32_t *)(void *)(depth + depth_bytes(pass)) : NULL;
    }
    for (int i = 0; i < pass->colors; i++) {
        uint8_t *image = place(pass, pass->color[i].texture, tile->number, color_bytes(pass, i), &memory);
        tile->color[i] = image;
        tile->sample_color[i] = image + lom_image_bytes(pass, i);
        tile->several[i] = image + lom_image_bytes(pass, i) + sample_bytes(pass, i);
    }
}

/* Whether memory has the tile's samples as the pass before left them. */
static bool holds(const struct lom_pass *pass, const lom_texture *texture, int number, enum held part)
{
    return keeps(pass, texture) && (texture->kept.held[number] & part) != 0;
}

/* A word for each pixel to all its samples. */
static void spread(const struct lom_pass *pass, const uint32_t *from, uint32_t *to)
{
    const size_t pitch = (size_t)pass->sample_pitch;
    for (size_t i = 0; i < tile_pixels(pass); i++)
        for (size_t s = 0; s < pitch; s++)
            to[i * pitch + s] = from[i];
}

/* Sample 0 of each pixel. */
static void take_first(const struct lom_pass *pass, const uint32_t *from, uint32_t *to)
{
    lom_stages_of(pass->device->variant)->take_first(from, pass->sample_pitch, tile_pixels(pass), to);
}

/* Every sample is the clear value. */
static void clear(const struct lom_pass *pass, void *memory, uint32_t word)
{
    lom_stages_of(pass->device->variant)->fill_words(memory, word, depth_bytes(pass) / 4);
}

static void begin_depth(const struct lom_pass *pass, struct lom_tile *tile)
{
    uint32_t bits;
    memcpy(&bits, &pass->clear_depth, sizeof bits);
    if (pass->desc.depth_load != LOM_LOAD_KEEP) {
        clear(pass, tile->depth, bits);
    } else if (!holds(pass, pass->depth, tile->number, HELD)) {
        lom_load_depth(pass, tile->number, (float *)(void *)tile->scratch);
        spread(pass, (const uint32_t *)(const void *)tile->scratch, (uint32_t *)(void *)tile->depth);
    }
}

static void begin_stencil(const struct lom_pass *pass, struct lom_tile *tile)
{
    if (pass->desc.stencil_load != LOM_LOAD_KEEP) {
        clear(pass, tile->stencil, pass->desc.clear_stencil);
    } else if (!holds(pass, pass->depth, tile->number, HELD_STENCIL)) {
        lom_load_stencil(pass, tile->number, (int32_t *)(void *)tile->scratch);
        spread(pass, (const uint32_t *)(const void *)tile->scratch, (uint32_t *)tile->stencil);
    }
}

void lom_begin_samples(struct lom_pass *pass, struct lom_tile *tile)
{
    if (tile->depth != NULL)
        begin_depth(pass, tile);
    if (tile->stencil != NULL)
        begin_stencil(pass, tile);
    for (int i = 0; i < pass->colors; i++) {
        if (pass->color[i].keep && holds(pass, pass->color[i].texture, tile->number, HELD))
            continue;
        lom_load_color(pass, i, tile->number, tile->color[i]);
        memset(tile->several[i], 0, tile_pixels(pass) / 4);
    }
}

/* Says whether a texture's memory holds the tile's samples from now on. */
static void note(const struct lom_pass *pass, lom_texture *texture, int number, enum held part, bool held)
{
    if (keeps(pass, texture))
        texture->kept.held[number] = (uint8_t)((texture->kept.held[number] & ~part) | (held ? part : 0));
}

static void end_depth(struct lom_pass *pass, struct lom_tile *tile)
{
    float *plane = (float *)(void *)tile->scratch;
    if (pass->writes_depth)
        take_first(pass, (const uint32_t *)(const void *)tile->depth, (uint32_t *)(void *)plane);
    lom_resolve_depth(pass, tile->number, pass->writes_depth ? plane : NULL);
    if (pass->writes_depth)
        note(pass, pass->depth, tile->number, HELD, true);
    else if (pass->desc.depth_load != LOM_LOAD_KEEP)
        note(pass, pass->depth, tile->number, HELD, false);
}

static void end_stencil(struct lom_pass *pass, struct lom_tile *tile)
{
    int32_t *plane = (int32_t *)(void *)tile->scratch;
    if (pass->uses_stencil)
        take_first(pass, (const uint32_t *)tile->stencil, (uint32_t *)plane);
    lom_resolve_stencil(pass, tile->number, pass->uses_stencil ? plane : NULL);
    if (pass->uses_stencil)
        note(pass, pass->depth, tile->number, HELD_STENCIL, true);
    else if (pass->desc.stencil_load != LOM_LOAD_KEEP)
        note(pass, pass->depth, tile->number, HELD_STENCIL, false);
}

/* Images of divided blocks are of no use to the samples, so the means may go there. */
static void end_color(struct lom_pass *pass, struct lom_tile *tile, int i)
{
    if (memchr(tile->several[i], 1, tile_pixels(pass) / 4) != NULL)
        lom_stages_of(pass->device->variant)->find_means(pass, tile, i);
    lom_resolve_color(pass, i, tile->number, tile->color[i]);
    note(pass, pass->color[i].texture, tile->number, HELD, true);
}

/* A tile that nothing came near: its texels are cleared or left, and so are its samples. */
static void end_untouched(struct lom_pass *pass, struct lom_tile *tile)
{
    lom_clear_tile(pass, tile->number);
    if (pass->depth != NULL && pass->desc.depth_load != LOM_LOAD_KEEP)
        note(pass, pass->depth, tile->number, HELD, false);
    if (pass->has_stencil && pass->desc.stencil_load != LOM_LOAD_KEEP)
        note(pass, pass->depth, tile->number, HELD_STENCIL, false);
    for (int i = 0; i < pass->colors; i++)
        if (!pass->color[i].keep)
            note(pass, pass->color[i].texture, tile->number, HELD, false);
}

void lom_end_samples(struct lom_pass *pass, struct lom_tile *tile, bool touched)
{
    if (!touched) {
        end_untouched(pass, tile);
        return;
    }
    if (pass->depth != NULL)
        end_depth(pass, tile);
    if (pass->has_stencil)
        end_stencil(pass, tile);
    for (int i = 0; i < pass->colors; i++)
        end_color(pass, tile, i);
}
