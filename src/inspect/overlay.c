/* An overlay of a frame. In: a renderer, a frame, a kind. Out: the frame, to the same bytes as ever, and a number for each
 * texel of its target or of a pass's. */
#include "base/own_float_state.h"
#include "inspect/overlay.h"
#include "pipeline/check_device.h"
#include "pipeline/device.h"
#include "render/frame.h"

#include <string.h>

/* The passes whose targets can be looked at, as --show names them. */
static const struct seen_pass {
    const char *name;
    enum lom_target target;
    bool is_of_frame; /* the target holds the drawn part of the frame, pixel by pixel */
} passes[] = {
    { "picture", LOM_TARGET_COLOR, true },
    { "reflection", LOM_TARGET_REFLECTION, false },
    { "refraction", LOM_TARGET_REFRACTION, false },
    { "spray", LOM_TARGET_SPRAY, true },
};
enum { PASSES = sizeof passes / sizeof passes[0] };

static const struct seen_pass *find_pass(const char *name, lom_error *error)
{
    const char *names[PASSES];
    for (size_t i = 0; i < PASSES; i++) {
        names[i] = passes[i].name;
        if (name == NULL || strcmp(name, names[i]) == 0)
            return &passes[i];
    }
    const char *near = lom_nearest_name(name, strlen(name), names, PASSES);
    lom_fail(error, LOM_ERROR_USAGE,
             "There is no pass \"%s\" to look at%s%s%s; there are picture, reflection, refraction, spray.", name,
             near != NULL ? " (did you mean \"" : "", near != NULL ? near : "", near != NULL ? "\"?)" : "");
    return NULL;
}

static bool find_scale(const lom_overlay_desc *desc, struct overlay_scale *scale, lom_error *error)
{
    const lom_overlay_kind *kind = desc->kind;
    if (lom_overlay_row(kind) == NULL)
        return lom_fail(error, LOM_ERROR_USAGE, "An overlay has a kind of lom_find_overlay or lom_describe_overlay.");
    *scale = lom_overlay_scale(kind->low, kind->high, kind->is_logarithmic);
    if (desc->low == 0 && desc->high == 0)
        return true;
    if (kind->low == 0 && kind->high == 0)
        return lom_fail(error, LOM_ERROR_USAGE, "The overlay %s has no scale.", kind->name);
    if (!(desc->low < desc->high && desc->high <= 1e30 && desc->low >= -1e30))
        return lom_fail(error, LOM_ERROR_USAGE, "A scale goes from a number to a greater one.");
    if (kind->is_logarithmic && !(desc->low >= 1e-30))
        return lom_fail(error, LOM_ERROR_USAGE, "The overlay %s has a logarithmic scale, which begins above 0.",
                        kind->name);
    *scale = lom_overlay_scale(desc->low, desc->high, kind->is_logarithmic);
    return true;
}

/* ---- drawing ---- */

static bool has_run(const lom_plan *plan, const char *name)
{
    for (int i = 0; i < plan->count; i++)
        if (strcmp(plan->step[i].name, name) == 0 && plan->step[i].runs)
            return true;
    return false;
}

static bool missing(const char *name, lom_error *error)
{
    return lom_fail(error, LOM_ERROR_USAGE,
                    "This frame has no pass \"%s\" to look at; `lom plan` says which passes it has, and why.", name);
}

/* The frame has drawn into the pass's target. */
static bool draw_frame(lom_renderer *r, const lom_overlay_desc *desc, const struct seen_pass *pass, lom_frame *frame,
                       lom_error *error)
{
    if (!lom_draw_tallied(r, &desc->frame, lom_overlay_row(desc->kind)->tally, pass->target, frame, error))
        return false;
    return pass->target == LOM_TARGET_COLOR || has_run(&frame->plan, pass->name) || missing(pass->name, error);
}

/* ---- numbers ---- */

/* The sums of tiles, which are aligned to the frame: tile (x + skip_x) / edge of a texel. */
struct tiles {
    int edge, skip_x, skip_y, columns, rows;
    uint64_t *work;
};

static uint64_t *tile_at(const struct tiles *tiles, int x, int y)
{
    int column = (x + tiles->skip_x) / tiles->edge, row = (y + tiles->skip_y) / tiles->edge;
    return &tiles->work[(size_t)row * (size_t)tiles->columns + (size_t)column];
}

static bool sum_tiles(const lom_device *device, lom_rect drawn, struct tiles *tiles, lom_error *error)
{
    int edge = tiles->edge = device->desc.tile;
    tiles->skip_x = drawn.x % edge;
    tiles->skip_y = drawn.y % edge;
    tiles->columns = (tiles->skip_x + drawn.width + edge - 1) / edge;
    tiles->rows = (tiles->skip_y + drawn.height + edge - 1) / edge;
    tiles->work = lom_allocate((size_t)tiles->columns * (size_t)tiles->rows, sizeof *tiles->work, error);
    for (int y = 0; tiles->work != NULL && y < drawn.height; y++)
        for (int x = 0; x < drawn.width; x++)
            *tile_at(tiles, x, y) += lom_tally_work(lom_tallied(device, x, y));
    return tiles->work != NULL;
}

static lom_image *take_numbers(const lom_renderer *r, const lom_overlay_desc *desc, const struct seen_pass *pass,
                               lom_error *error)
{
    const struct overlay_row *row = lom_overlay_row(desc->kind);
    const lom_texture *target = r->targets.of[pass->target];
    struct overlay_place at = { .camera = &r->moment.camera };
    struct tiles tiles = { .work = NULL };
    lom_rect drawn = { 0, 0, lom_texture_width(target), lom_texture_height(target) };
    if (pass->is_of_frame) {
        drawn.x = desc->frame.crop.width != 0 ? desc->frame.crop.x : 0;
        drawn.y = desc->frame.crop.width != 0 ? desc->frame.crop.y : 0;
    }
    lom_image *numbers = lom_create_image(drawn.width, drawn.height, 1,
                                          row->look == OVERLAY_VECTORS ? LOM_FORMAT_RGB32F : LOM_FORMAT_R32F, error);
    if (numbers != NULL && row->by_tile && !sum_tiles(r->device, drawn, &tiles, error)) {
        lom_free_image(numbers);
        numbers = NULL;
    }
    for (int y = 0; numbers != NULL && y < drawn.height; y++)
        for (int x = 0; x < drawn.width; x++) {
            at.tally = lom_tallied(r->device, x, y);
            at.tile = row->by_tile ? *tile_at(&tiles, x, y) : 0;
            row->value(&at, lom_image_pixel(numbers, x, y, 0));
        }
    lom_release(tiles.work);
    return numbers;
}

/* What lies below the numbers, for eyes: the frame, or what the pass left. */
static lom_image *take_picture(const lom_renderer *r, const struct seen_pass *pass, const lom_frame *frame,
                               lom_error *error)
{
    lom_image *left = pass->is_of_frame ? NULL : lom_read_texture(r->targets.of[pass->target], 0, 0, error);
    const lom_image *picture = pass->is_of_frame ? frame->image : left;
    if (picture == NULL)
        return NULL;
    const lom_format_info *info = lom_describe_format(picture->format);
    lom_image *shown =
        lom_convert_image(picture, info->is_float || info->is_srgb ? LOM_FORMAT_RGB8_SRGB : LOM_FORMAT_RGB8, error);
    lom_free_image(left);
    return shown;
}

bool lom_draw_overlay(lom_renderer *renderer, const lom_overlay_desc *desc, lom_overlay *overlay, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    struct overlay_scale scale;
    *overlay = (lom_overlay){ .numbers = NULL };
    const struct seen_pass *pass = find_pass(desc->pass, error);
    if (pass == NULL || !find_scale(desc, &scale, error))
        return false;
    bool drawn = draw_frame(renderer, desc, pass, &overlay->frame, error);
    lom_image *picture = drawn ? take_picture(renderer, pass, &overlay->frame, error) : NULL;
    if (picture != NULL)
        overlay->numbers = take_numbers(renderer, desc, pass, error);
    if (overlay->numbers != NULL)
        overlay->shown =
            lom_show_overlay(lom_overlay_row(desc->kind), &scale, desc->legend, overlay->numbers, picture, error);
    lom_free_image(picture);
    lom_tally_target(renderer->device, NULL);
    if (overlay->shown == NULL)
        lom_free_overlay(overlay);
    return overlay->shown != NULL;
}

void lom_free_overlay(lom_overlay *overlay)
{
    lom_free_image(overlay->frame.image);
    lom_free_image(overlay->numbers);
    lom_free_image(overlay->shown);
    overlay->frame.image = overlay->numbers = overlay->shown = NULL;
}
