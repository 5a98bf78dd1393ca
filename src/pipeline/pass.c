/* A pass from begin to end. In: attachments and draws. Out: the attachments' texels. Draws are cut into chunks, chunks
 * run in batches: every chunk to its bins, then every tile through the batch's bins; at the end every tile is resolved.
 */
#include "pipeline/check_device.h"
#include "image/convert.h"
#include "pipeline/device.h"
#include "pipeline/record.h"
#include "pipeline/tally.h"
#include "pipeline/samples.h"

static lom_rect or_whole(lom_rect rect, lom_rect whole)
{
    return rect.width == 0 ? whole : rect;
}

/* Whether a pass can draw there: a texture of the kind has it, and no samples are kept beside another level. */
static bool check_slice(lom_device *device, const lom_texture *texture, lom_slice slice)
{
    if (slice.level < 0 || slice.level >= texture->level_count || slice.layer < 0 || slice.layer >= texture->layers)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "A pass's attachment is level %d of layer %d of a texture that has %d levels and %d layers.",
                        slice.level, slice.layer, texture->level_count, texture->layers);
    return slice.level == 0 || (texture->samples <= 1 && texture->stencil == NULL) ||
           lom_fail(&device->error, LOM_ERROR_USAGE,
                    "A texture that keeps samples, or has a stencil, is drawn into at level 0 alone, not at %d.",
                    slice.level);
}

static bool is_target_kind(const lom_texture *texture)
{
    return texture->kind == LOM_TEXTURE_2D || texture->kind == LOM_TEXTURE_2D_ARRAY ||
           texture->kind == LOM_TEXTURE_CUBE;
}

static bool check_attachment(lom_device *device, const lom_texture *texture, lom_slice slice, bool depth)
{
    struct lom_pass *pass = &device->pass;
    if (texture->owner != NULL && texture->owner != device)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A pass's %s attachment is a texture of another device.",
                        depth ? "depth" : "colour");
    if (!is_target_kind(texture) || lom_describe_format(texture->format)->is_depth != depth)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "A pass's %s attachment is not a 2D texture, an array or a cube of a %s format.",
                        depth ? "depth" : "colour", depth ? "depth" : "colour");
    if (!check_slice(device, texture, slice))
        return false;
    const lom_level *level = &texture->level[slice.level];
    if (pass->width == 0) {
        pass->width = level->width;
        pass->height = level->height;
    }
    if (pass->width != level->width || pass->height != level->height)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A pass's attachments have different sizes: %dx%d and %dx%d.",
                        pass->width, pass->height, level->width, level->height);
    return true;
}

/* A clear value as the format holds it: finite, and rounded to 16 bits where it has those. */
static float round_to_format(lom_format format, float x)
{
    const lom_format_info *info = lom_describe_format(format);
    float bound = 0x1p123f;
    float value = x == x ? x : 0;
    if (info->bits == 16)
        value = info->is_float ? lom_float_of_half(lom_half_of(value)) : (float)(lom_unorm_of(value, 65535) / 65535.0);
    return value > bound ? bound : value < -bound ? -bound : value;
}

static uint32_t pack_clear(const struct lom_color_target *target)
{
    uint32_t packed = 0;
    for (int c = 0; c < 4; c++) {
        bool srgb = target->kind == COLOR_SRGB8 && c < 3;
        uint32_t code = srgb ? lom_srgb8_of(target->clear[c]) : lom_unorm_of(target->clear[c], 255);
        packed |= code << 8 * c;
    }
    return packed;
}

static bool add_color(lom_device *device, lom_texture *texture, lom_slice slice, lom_load_action load,
                      const float clear[4])
{
    struct lom_pass *pass = &device->pass;
    struct lom_color_target *target = &pass->color[pass->colors];
    if (!check_attachment(device, texture, slice, false))
        return false;
    *target = (struct lom_color_target){
        .texture = texture, .slice = slice, .format = texture->format, .keep = load == LOM_LOAD_KEEP
    };
    target->kind = texture->storage != LOM_STORAGE_RGBA8 ? COLOR_FLOAT : texture->srgb ? COLOR_SRGB8 : COLOR_UNORM8;
    for (int c = 0; c < 4; c++)
        target->clear[c] = round_to_format(texture->format, clear[c]);
    target->clear_bytes = target->kind == COLOR_FLOAT ? 0 : pack_clear(target);
    pass->colors++;
    return true;
}

/* Where triangles end is one more colour attachment, which no shader knows of. */
static bool add_edges(lom_device *device, lom_texture *texture)
{
    static const float nothing[4] = { 1, 1, 1, 1 };
    struct lom_pass *pass = &device->pass;
    if (pass->colors == 0 || pass->colors == LOM_MAX_COLORS || pass->samples > 1)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "A pass that keeps edges has 1 to %d colour attachments and one sample a pixel, not %d and %d.",
                        LOM_MAX_COLORS - 1, pass->colors, pass->samples);
    pass->edges = pass->colors;
    if (!add_color(device, texture, (lom_slice){ 0, 0 }, pass->desc.edges_load, nothing))
        return false;
    return (texture->format == LOM_FORMAT_RGBA8 && texture->kind == LOM_TEXTURE_2D) ||
           lom_fail(&device->error, LOM_ERROR_USAGE, "The edges of a pass are kept in a 2D texture of %s, not of %s.",
                    lom_describe_format(LOM_FORMAT_RGBA8)->name, lom_describe_format(texture->format)->name);
}

static void add_depth(struct lom_pass *pass)
{
    static const double scales[] = { [LOM_FORMAT_DEPTH16] = 65535, [LOM_FORMAT_DEPTH24] = 16777215 };
    pass->depth = pass->desc.depth;
    pass->has_stencil = pass->depth->stencil != NULL;
    pass->depth_slice = pass->desc.depth_slice;
    lom_format format = pass->depth->format;
    pass->depth_scale = format == LOM_FORMAT_DEPTH32F ? 0 : scales[format];
    float clear = pass->desc.clear_depth > 0 ? pass->desc.clear_depth < 1 ? pass->desc.clear_depth : 1 : 0;
    pass->clear_depth = pass->depth_scale == 0
                            ? clear
                            : (float)lom_unorm_of((double)clear, (uint32_t)lom_count_of(pass->depth_scale, 16777215));
}

static bool resolve_rects(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    pass->frame_width = pass->desc.frame_width != 0 ? pass->desc.frame_width : pass->width;
    pass->frame_height = pass->desc.frame_height != 0 ? pass->desc.frame_height : pass->height;
    lom_rect frame = { 0, 0, pass->frame_width, pass->frame_height };
    lom_rect here = { pass->desc.origin_x, pass->desc.origin_y, pass->width, pass->height };
    pass->desc.viewport = or_whole(pass->desc.viewport, frame);
    if (pass->desc.origin_x < 0 || pass->desc.origin_y < 0 || pass->frame_width < 1 || pass->frame_height < 1 ||
        pass->frame_width > LOM_MAX_SIZE || pass->frame_height > LOM_MAX_SIZE ||
        pass->desc.origin_x > pass->frame_width - pass->width ||
        pass->desc.origin_y > pass->frame_height - pass->height)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "A pass's attachments (%dx%d at %d,%d) do not lie inside its frame of %dx%d.", pass->width,
                        pass->height, pass->desc.origin_x, pass->desc.origin_y, pass->frame_width, pass->frame_height);
    pass->scissor = lom_intersect_rects(lom_intersect_rects(or_whole(pass->desc.scissor, frame), frame), here);
    return lom_check_viewport(device, &pass->desc.viewport, pass->desc.min_depth, pass->desc.max_depth);
}

/* The tile grid is aligned to the frame, so that a crop sees the same 2x2 quads. */
static bool lay_tiles(lom_device *device)
{
    struct lom_pass *pass = &device->pass;
    int edge = pass->tile = device->desc.tile;
    pass->tile_x0 = pass->desc.origin_x / edge * edge;
    pass->tile_y0 = pass->desc.origin_y / edge * edge;
    pass->tiles_x = (pass->desc.origin_x + pass->width - pass->tile_x0 + edge - 1) / edge;
    pass->tiles_y = (pass->desc.origin_y + pass->height - pass->tile_y0 + edge - 1) / edge;
    pass->tile_bytes = pass->depth != NULL ? pass->has_stencil ? 8 : 4 : 0;
    for (int i = 0; i < pass->colors; i++)
        pass->tile_bytes += pass->color[i].kind == COLOR_FLOAT ? 16 : 4;
    pass->tile_bytes *= (size_t)edge * (size_t)edge;
    if (pass->samples > 1 && !lom_lay_samples(device, pass))
        return false;
    size_t tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    pass->reached_words = (device->most_chunks + CHUNKS_WORD - 1) / CHUNKS_WORD;
    if (!lom_reserve(&device->tile_touched, &device->tile_touched_capacity, tiles, 1, NULL) ||
        !lom_reserve(&device->reached, &device->reached_capacity, tiles * pass->reached_words, sizeof(uint64_t), NULL))
        return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for the tiles of a %dx%d pass.",
                        pass->width, pass->height);
    pass->tile_touched = device->tile_touched;
    memset(pass->tile_touched, 0, tiles);
    return true;
}

/* What is larger than the caches leaves them before anybody reads it: then it is stored past them. */
static bool exceeds_caches(const struct lom_pass *pass)
{
    uint64_t bytes = pass->depth != NULL ? 4 : 0;
    for (int i = 0; i < pass->colors; i++)
        bytes += lom_texel_size(pass->color[i].texture);
    size_t cache = pass->device->cache_bytes;
    return cache != 0 && bytes * (uint64_t)pass->width * (uint64_t)pass->height > cache;
}

static bool choose_samples(lom_device *device, struct lom_pass *pass)
{
    pass->samples = pass->desc.samples != 0 ? pass->desc.samples : 1;
    bool is_number = lom_sample_offsets(pass->samples) != NULL;
    bool counts = device->tallier != NULL && !device->tallier->desc.clock;
    if (is_number && (device->recorder != NULL || counts))
        pass->samples = 1; /* lom/record.h */
    pass->offset = lom_sample_offsets(pass->samples);
    pass->sample_pitch = pass->samples < 4 ? 4 : pass->samples;
    if (!is_number)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A pass has 1, 2, 4, 8 or 16 samples a pixel, not %d.",
                        pass->samples);
    for (int i = 0; i < pass->samples; i++) {
        const struct lom_sample_offset *at = &pass->offset[i];
        pass->offset_pair[i + 1] = (int32_t)((uint32_t)(at->x & 0xffff) | (uint32_t)at->y << 16);
        const int low = at->x < at->y ? at->x : at->y, high = at->x > at->y ? at->x : at->y;
        pass->reach_low = low * (SUBPIXELS / 16) < pass->reach_low ? low * (SUBPIXELS / 16) : pass->reach_low;
        pass->reach_high = high * (SUBPIXELS / 16) > pass->reach_high ? high * (SUBPIXELS / 16) : pass->reach_high;
    }
    for (int i = 0; i < 4 * pass->sample_pitch; i++) {
        const int pixel = i / pass->sample_pitch, sample = i % pass->sample_pitch % pass->samples;
        const struct lom_sample_offset *at = &pass->offset[sample];
        const int x = (2 * (pixel & 1) + 1) * SUBPIXELS / 2 + at->x * (SUBPIXELS / 16),
                  y = (2 * (pixel >> 1) + 1) * SUBPIXELS / 2 + at->y * (SUBPIXELS / 16);
        pass->strip_pair[i] = x | y << 16;
    }
    return true;
}

static bool prepare_pass(lom_device *device, const lom_pass_desc *desc)
{
    struct lom_pass *pass = &device->pass;
    *pass = (struct lom_pass){ .device = device, .desc = *desc };
    if (!choose_samples(device, pass))
        return false;
    for (int i = 0; i < LOM_MAX_COLORS && desc->color[i] != NULL; i++)
        if (!add_color(device, desc->color[i], desc->color_slice[i], desc->color_load[i], desc->clear_color[i]))
            return false;
    if (desc->edges != NULL && !add_edges(device, desc->edges))
        return false;
    if (desc->depth != NULL) {
        if (!check_attachment(device, desc->depth, desc->depth_slice, true))
            return false;
        add_depth(pass);
    }
    if (desc->feedback_only ? pass->width != 0 : pass->width == 0)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A pass %s.",
                        desc->feedback_only ? "for feedback only has an attachment" : "has no attachment");
    if (desc->feedback_only)
        pass->width = pass->height = 1;
    if (desc->min_depth == 0 && desc->max_depth == 0)
        pass->desc.max_depth = 1;
    pass->one_by_one = device->one_by_one;
    pass->streams = exceeds_caches(pass);
    return resolve_rects(device) && lay_tiles(device);
}

void lom_begin_pass(lom_device *device, const lom_pass_desc *desc)
{
    static const lom_pass_desc none = { .samples = 0 };
    desc = desc != NULL ? desc : &none;
    if (!lom_check_device(device, NULL))
        return;
    if (device->in_pass) {
        lom_fail(&device->error, LOM_ERROR_USAGE, "A pass was begun inside another one.");
        return;
    }
    lom_float_state state;
    lom_enter_float_state(&state);
    device->uniforms_size = 0;
    device->in_pass = prepare_pass(device, desc);
    if (device->in_pass && device->recorder != NULL && !desc->feedback_only)
        lom_record_begin(device);
    if (device->in_pass && device->tallier != NULL)
        lom_tally_begin(device);
    lom_leave_float_state(&state);
    device->counters.passes += device->in_pass;
}

void lom_draw(lom_device *device, const lom_draw_desc *desc)
{
    static const lom_draw_desc none = { .shader = NULL };
    desc = desc != NULL ? desc : &none;
    if (!lom_check_device(device, NULL))
        return;
    if (!device->in_pass)
        lom_fail(&device->error, LOM_ERROR_USAGE, "A draw was made outside a pass.");
    else
        lom_record_draw(device, desc);
}

bool lom_end_pass(lom_device *device)
{
    if (device == NULL)
        return false;
    if (device->error.code == LOM_OK && !device->in_pass)
        lom_fail(&device->error, LOM_ERROR_USAGE, "A pass was ended that had not begun.");
    device->in_pass = false;
    if (device->error.code != LOM_OK)
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    bool done = lom_run_pass(device);
    if (done && device->recorder != NULL && !device->pass.desc.feedback_only)
        lom_record_ended(device);
    lom_leave_float_state(&state);
    return done;
}
