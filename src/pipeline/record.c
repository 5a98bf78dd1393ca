/* Who keeps records. In: watches, passes that begin and end. Out: for each watched pixel the passes that drew into it,
 * from the last one on that cleared it. Invariant: a pixel's record is touched by the worker that owns its tile, and by
 * the caller between the two halves of a batch. */
#include "pipeline/record.h"

#include "pipeline/check_device.h"
#include "pipeline/tally.h"
#include "pipeline/variants.h"

static size_t count_pixels(const struct record_watch *watch)
{
    return (size_t)watch->desc.width * (size_t)watch->desc.height;
}

static void free_recorder(struct lom_recorder *r)
{
    if (r == NULL)
        return;
    for (size_t i = 0; i < r->watch_count; i++) {
        for (size_t k = 0; r->watch[i].pixels != NULL && k < count_pixels(&r->watch[i]); k++)
            lom_free_record_memory(&r->watch[i].pixels[k].memory);
        lom_release(r->watch[i].pixels);
    }
    for (size_t i = 0; r->chunks != NULL && i < r->chunk_count; i++) {
        lom_release(r->chunks[i].items);
        lom_release(r->chunks[i].pieces);
    }
    lom_free_record_memory(&r->told);
    for (int i = 0; r->worker != NULL && i < r->workers; i++)
        lom_free_notes(&r->worker[i].notes);
    lom_release(r->chunks);
    lom_release(r->worker);
    lom_release(r->written);
    lom_release(r);
}

/* ---- watching ---- */

static bool check_watch(lom_device *device, const lom_watch_desc *w)
{
    if (w->target == NULL || w->target->owner != device || w->target->kind != LOM_TEXTURE_2D)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "What is watched is a 2D texture of the device.");
    int width = w->width != 0 ? w->width : 1, height = w->height != 0 ? w->height : 1;
    if (w->x < 0 || w->y < 0 || width < 1 || height < 1 || w->x > lom_texture_width(w->target) - width ||
        w->y > lom_texture_height(w->target) - height)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "The pixels %d,%d to %d,%d do not lie in a texture of %dx%d.",
                        w->x, w->y, w->x + width - 1, w->y + height - 1, lom_texture_width(w->target),
                        lom_texture_height(w->target));
    return true;
}

static bool add_watch(lom_device *device, struct record_watch *watch, const lom_watch_desc *desc)
{
    watch->desc = *desc;
    watch->desc.width = desc->width != 0 ? desc->width : 1;
    watch->desc.height = desc->height != 0 ? desc->height : 1;
    device->recorder->watch_count++;
    watch->pixels = lom_allocate(count_pixels(watch), sizeof *watch->pixels, &device->error);
    for (int i = 0; watch->pixels != NULL && i < watch->desc.width * watch->desc.height; i++)
        watch->pixels[i].pixel = (lom_pixel_record){ desc->x + i % watch->desc.width, desc->y + i / watch->desc.width,
                                                     desc->target->format, NULL };
    return watch->pixels != NULL;
}

void lom_forget_records(lom_device *device)
{
    free_recorder(device->recorder);
    lom_free_tallier(device->tallier);
    device->recorder = NULL;
    device->tallier = NULL;
}

bool lom_has_recorded(lom_device *device)
{
    return lom_stages_of(LOM_SLOT_4_recorded) != NULL ||
           lom_fail(&device->error, LOM_ERROR_USAGE,
                    "This library was built without the variant that records, so no pixel can be watched.");
}

struct lom_recorder *lom_renew_recorder(lom_device *device)
{
    lom_forget_records(device);
    if (!lom_has_recorded(device))
        return NULL;
    struct lom_recorder *r = device->recorder = lom_allocate(1, sizeof *r, &device->error);
    if (r == NULL)
        return NULL;
    r->chunk_count = device->most_chunks; /* a batch of small draws has more than desc.batch */
    r->workers = device->desc.threads;
    r->chunks = lom_allocate(r->chunk_count, sizeof *r->chunks, &device->error);
    r->worker = lom_allocate((size_t)r->workers, sizeof *r->worker, &device->error);
    return r->chunks != NULL && r->worker != NULL ? r : NULL;
}

bool lom_watch(lom_device *device, const lom_watch_desc *watches, size_t count)
{
    if (!lom_check_device(device, NULL))
        return false;
    if (device->in_pass || count > LOM_MAX_WATCHES)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Up to %d rectangles are watched, from outside a pass.",
                        LOM_MAX_WATCHES);
    for (size_t i = 0; i < count; i++)
        if (!check_watch(device, &watches[i]))
            return false;
    if (count == 0) {
        lom_forget_records(device);
        return true;
    }
    struct lom_recorder *r = lom_renew_recorder(device);
    for (size_t i = 0; r != NULL && i < count && lom_check_device(device, NULL); i++)
        add_watch(device, &r->watch[i], &watches[i]);
    return lom_check_device(device, NULL);
}

const lom_pixel_record *lom_watched_pixel(const lom_device *device, size_t watch, int x, int y)
{
    const struct lom_recorder *r = device != NULL ? device->recorder : NULL;
    if (r == NULL || watch >= r->watch_count)
        return NULL;
    const lom_watch_desc *w = &r->watch[watch].desc;
    if (x < w->x || y < w->y || x >= w->x + w->width || y >= w->y + w->height)
        return NULL;
    return &r->watch[watch].pixels[(y - w->y) * w->width + (x - w->x)].pixel;
}

/* The last pass before another one that drew into a texture, or that filtered something into it; NULL: none. */
static const struct record_written *find_written(const struct lom_recorder *r, const lom_texture *texture,
                                                 uint64_t before, bool filtered)
{
    for (size_t i = r != NULL ? r->written_count : 0; i-- > 0;)
        if (r->written[i].texture == texture && r->written[i].pass < before &&
            (!filtered || r->written[i].filtered != NULL))
            return &r->written[i];
    return NULL;
}

bool lom_find_drawn(const lom_device *device, const lom_texture *texture, uint64_t before, uint64_t *pass)
{
    const struct record_written *found = device != NULL ? find_written(device->recorder, texture, before, false) : NULL;
    if (found != NULL)
        *pass = found->pass;
    return found != NULL;
}

const lom_texture *lom_find_filtered(const lom_device *device, const lom_texture *texture, uint64_t before)
{
    const struct record_written *found = device != NULL ? find_written(device->recorder, texture, before, true) : NULL;
    return found != NULL ? found->filtered : NULL;
}

uint64_t lom_count_watched_passes(const lom_device *device)
{
    return device != NULL && device->recorder != NULL ? device->recorder->passes : 0;
}

const char *lom_fate_text(lom_fate fate)
{
    static const char *const texts[LOM_FATES] = {
        [LOM_FATE_STORED] = "stored",
        [LOM_FATE_LOST] = "stored, then overwritten",
        [LOM_FATE_BLENDED_OVER] = "stored, then blended over",
        [LOM_FATE_DEPTH] = "failed the depth test",
        [LOM_FATE_DISCARDED] = "discarded by its shader",
        [LOM_FATE_DISTANCE] = "outside a clip distance",
        [LOM_FATE_FACING] = "culled by its facing",
        [LOM_FATE_SCISSOR] = "outside the scissor",
        [LOM_FATE_CLIPPED] = "outside the near or the far plane",
        [LOM_FATE_UNSHADED] = "drawn without writing here",
        [LOM_FATE_STENCIL] = "failed the stencil test",
    };
    return (unsigned)fate < LOM_FATES ? texts[fate] : "unknown";
}

/* ---- passes ---- */

static bool note_attachment(struct lom_recorder *r, const lom_texture *texture)
{
    if (!lom_reserve(&r->written, &r->written_capacity, r->written_count + 1, sizeof *r->written, NULL))
        return false;
    r->written[r->written_count++] = (struct record_written){ .texture = texture, .pass = r->passes };
    return true;
}

void lom_record_filter(lom_device *device, const lom_texture *filtered)
{
    struct lom_recorder *r = device->recorder;
    for (size_t i = 0; r != NULL && i < r->written_count; i++)
        if (r->written[i].pass + 1 == r->passes && r->written[i].texture == device->pass.color[0].texture)
            r->written[i].filtered = filtered;
}

static bool is_watched(const struct record_watch *watch, const lom_texture *texture)
{
    return texture != NULL && (texture == watch->desc.target || texture == watch->desc.filtered);
}

/* The attachment that a watch is of: a colour's number, -1 the depth; false: none. */
static bool find_attachment(const struct lom_pass *pass, struct record_watch *watch)
{
    for (int i = 0; i < pass->colors; i++)
        if (is_watched(watch, pass->color[i].texture) && lom_is_first_slice(pass->color[i].slice)) {
            watch->attachment = i;
            watch->texture = pass->color[i].texture;
            return true;
        }
    watch->attachment = -1;
    watch->texture = pass->depth;
    return is_watched(watch, pass->depth) && lom_is_first_slice(pass->depth_slice);
}

static void begin_pixel(const struct lom_pass *pass, struct record_watch *watch, struct record_pixel *pixel)
{
    lom_load_action load = watch->attachment < 0 ? pass->desc.depth_load : pass->desc.color_load[watch->attachment];
    if (load == LOM_LOAD_CLEAR && (watch->desc.filtered == NULL || watch->texture == watch->desc.filtered)) {
        lom_free_record_memory(&pixel->memory);
        pixel->pixel.passes = NULL;
    }
    pixel->raw = NULL;
    lom_pass_record *record = lom_record_allocate(&pixel->memory, sizeof *record);
    if (record == NULL)
        return;
    *record = (lom_pass_record){ .number = pass->recorder->passes,
                                 .label = pass->desc.label,
                                 .desc = pass->desc,
                                 .x = pixel->pixel.x + watch->origin_x,
                                 .y = pixel->pixel.y + watch->origin_y,
                                 .attachment = watch->attachment };
    lom_pass_record **last = &pixel->pixel.passes;
    while (*last != NULL)
        last = &(*last)->next;
    *last = record;
}

/* The bounds take in a watch's pixels. */
static void widen(struct lom_bounds *bounds, const struct record_watch *watch)
{
    int left = watch->desc.x + watch->origin_x, top = watch->desc.y + watch->origin_y;
    int right = left + watch->desc.width - 1, bottom = top + watch->desc.height - 1;
    bounds->left = left < bounds->left ? left : bounds->left;
    bounds->top = top < bounds->top ? top : bounds->top;
    bounds->right = right > bounds->right ? right : bounds->right;
    bounds->bottom = bottom > bounds->bottom ? bottom : bounds->bottom;
}

void lom_record_begin(lom_device *device)
{
    struct lom_recorder *r = device->recorder;
    struct lom_pass *pass = &device->pass;
    r->bounds = (struct lom_bounds){ INT32_MAX, INT32_MAX, -1, -1 };
    for (size_t i = 0; i < r->watch_count; i++) {
        struct record_watch *watch = &r->watch[i];
        watch->active = find_attachment(pass, watch) && (watch->desc.before == 0 || r->passes < watch->desc.before);
        if (!watch->active)
            continue;
        pass->recorder = r;
        pass->is_recorded = pass->one_by_one = true;
        watch->origin_x = pass->desc.origin_x;
        watch->origin_y = pass->desc.origin_y;
        widen(&r->bounds, watch);
        for (size_t k = 0; k < count_pixels(watch); k++)
            begin_pixel(pass, watch, &watch->pixels[k]);
    }
    r->tells = r->listener.begins != NULL && r->listener.begins(r->listener.context, r->passes, &pass->desc);
    if (r->tells) {
        pass->recorder = r;
        pass->is_recorded = pass->one_by_one = true;
    }
    for (int i = 0; i < pass->colors; i++)
        r->failed |= !note_attachment(r, pass->color[i].texture);
    if (pass->depth != NULL)
        r->failed |= !note_attachment(r, pass->depth);
    r->passes++;
}

struct record_pixel *lom_record_next(struct lom_recorder *r, int x, int y, size_t *next)
{
    if (x < r->bounds.left || y < r->bounds.top || x > r->bounds.right || y > r->bounds.bottom)
        return NULL;
    while (*next < r->watch_count) {
        struct record_watch *watch = &r->watch[(*next)++];
        int column = x - watch->origin_x - watch->desc.x, row = y - watch->origin_y - watch->desc.y;
        if (watch->active && column >= 0 && row >= 0 && column < watch->desc.width && row < watch->desc.height)
            return &watch->pixels[row * watch->desc.width + column];
    }
    return NULL;
}

/* ---- the end of a pass ---- */

static void read_texel(const lom_texture *texture, int x, int y, float value[4])
{
    const void *texel = lom_texel(texture, 0, x, y, 0);
    if (texture->storage == LOM_STORAGE_RGBA8)
        for (int c = 0; c < 4; c++)
            value[c] = (float)(*(const uint32_t *)texel >> 8 * c & 255);
    else
        memcpy(value, texel, texture->storage == LOM_STORAGE_R32F ? sizeof *value : 4 * sizeof *value);
}

/* Whether a triangle changed the watched attachment, and whether it left nothing of what was there. */
static bool has_stored(const lom_pass_record *pass, const lom_triangle_record *t, bool *whole)
{
    const lom_draw_desc *desc = &t->draw->desc;
    int a = pass->attachment;
    *whole = a < 0 || (!desc->blend[a].enabled && desc->mask_off[a] == 0);
    return t->covered && (a < 0 ? t->fragment.depth_written : t->fragment.write[a].written);
}

/* What was stored and is overwritten by t, or blended over. */
static void lose(lom_pixel_record *pixel, const lom_triangle_record *t, bool whole)
{
    for (lom_pass_record *pass = pixel->passes; pass != NULL; pass = pass->next)
        for (lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
            for (lom_triangle_record *u = draw->triangles; u != NULL; u = u->next) {
                if (u == t)
                    return;
                if (u->fate != LOM_FATE_STORED && u->fate != LOM_FATE_BLENDED_OVER)
                    continue;
                u->fate = whole ? LOM_FATE_LOST : LOM_FATE_BLENDED_OVER;
                u->lost_to = t;
            }
}

static void find_losses(lom_pixel_record *pixel, const lom_pass_record *pass)
{
    bool whole;
    for (lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
        for (lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
            if (t->fate == LOM_FATE_STORED && has_stored(pass, t, &whole))
                lose(pixel, t, whole);
}

/* The draws of the pass that the recorded variant could not draw. */
static void add_unrecorded(const lom_device *device, struct record_pixel *pixel, lom_pass_record *pass)
{
    for (size_t i = 0; i < device->pass.draw_count; i++) {
        if (device->draws[i].variant == LOM_SLOT_4_recorded)
            continue;
        lom_draw_record **last = &pass->draws, *draw = lom_record_allocate(&pixel->memory, sizeof *draw);
        if (draw == NULL)
            return;
        *draw = (lom_draw_record){
            .number = i, .label = device->draws[i].desc.label, .desc = device->draws[i].desc, .pass = pass
        };
        while (*last != NULL && (*last)->number < i)
            last = &(*last)->next;
        draw->next = *last;
        *last = draw;
    }
}

bool lom_record_end(lom_device *device)
{
    struct lom_recorder *r = device->recorder;
    for (size_t i = 0; i < r->watch_count; i++)
        for (size_t k = 0; r->watch[i].active && k < count_pixels(&r->watch[i]); k++) {
            struct record_pixel *pixel = &r->watch[i].pixels[k];
            lom_pass_record *last = pixel->pixel.passes;
            r->failed |= pixel->memory.failed;
            while (last != NULL && last->next != NULL)
                last = last->next;
            if (last == NULL)
                continue;
            read_texel(r->watch[i].texture, pixel->pixel.x, pixel->pixel.y, last->end);
            add_unrecorded(device, pixel, last);
            const struct record_written *w = find_written(r, r->watch[i].texture, last->number + 1, false);
            last->filters = w != NULL && w->filtered != NULL && w->filtered == r->watch[i].desc.filtered;
            if (!last->filters)
                find_losses(&pixel->pixel, last);
        }
    for (int i = 0; i < r->workers; i++)
        r->failed |= r->worker[i].notes.failed;
    return !r->failed || lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for what is recorded.");
}
