/* Opening and closing a device, and what it owns. In: a descriptor. Out: a device whose first error stays with it. */
#include "pipeline/check_device.h"
#include "base/pass_error.h"
#include "pipeline/expand.h"
#include "pipeline/record.h"
#include "pipeline/renew_texture.h"
#include "pipeline/share_work.h"
#include "pipeline/samples.h"

#include "lanes/variants.h"

static bool check_desc(const lom_device_desc *desc, lom_error *error)
{
    if (desc->threads < 0 || desc->threads > 256)
        return lom_fail(error, LOM_ERROR_USAGE, "A device has 1 to 256 threads, not %d.", desc->threads);
    if (desc->lanes != 0 && desc->lanes != 4 && desc->lanes != 8 && desc->lanes != 16)
        return lom_fail(error, LOM_ERROR_USAGE, "A device has 4, 8 or 16 lanes, not %d.", desc->lanes);
    if (desc->tile != 0 && desc->tile != 16 && desc->tile != 32 && desc->tile != 64)
        return lom_fail(error, LOM_ERROR_USAGE, "A tile has an edge of 16, 32 or 64 pixels, not %d.", desc->tile);
    if (desc->chunk != 0 && (desc->chunk < 16 || desc->chunk > 65536))
        return lom_fail(error, LOM_ERROR_USAGE, "A chunk has 16 to 65536 triangles, not %d.", desc->chunk);
    if (desc->batch < 0 || desc->batch > 1024)
        return lom_fail(error, LOM_ERROR_USAGE, "A batch has 1 to 1024 chunks, not %d.", desc->batch);
    if ((unsigned)desc->filtering >= LOM_FILTERING_COUNT)
        return lom_fail(error, LOM_ERROR_USAGE, "A device has no filtering %d.", (int)desc->filtering);
    return true;
}

static bool resolve_desc(lom_device *device, const lom_device_desc *desc)
{
    device->variant = desc->lanes != 0 ? lom_find_variant(desc->lanes, desc->plain) : lom_widest_variant(desc->plain);
    if (device->variant < 0)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "This library was built without %d lanes%s.", desc->lanes,
                        desc->plain ? " of baseline instructions" : " that run on this processor");
    device->desc.lanes = lom_variants[device->variant].lanes;
    device->desc.plain = lom_variants[device->variant].plain;
    device->cache_bytes = lom_cache_bytes();
    device->desc.threads = desc->threads != 0 ? desc->threads : lom_default_threads();
    device->desc.tile = desc->tile != 0 ? desc->tile : 64;
    device->desc.chunk = desc->chunk != 0 ? desc->chunk : 8192;
    device->desc.batch = desc->batch != 0 ? desc->batch : 32;
    device->most_chunks = desc->batch != 0 ? (size_t)desc->batch : 256;
    device->desc.filtering = desc->filtering;
    return true;
}

lom_device *lom_open_device(const lom_device_desc *desc)
{
    static const lom_device_desc defaults = { .threads = 0 };
    desc = desc != NULL ? desc : &defaults;
    lom_device *device = lom_allocate(1, sizeof *device, NULL);
    if (device == NULL)
        return NULL;
    if (!check_desc(desc, &device->error) || !resolve_desc(device, desc))
        return device;
    device->pool = lom_create_pool(device->desc.threads, &device->error);
    device->worker_tiles = lom_allocate((size_t)device->desc.threads, sizeof(struct lom_tile), &device->error);
    device->assemblies = lom_allocate((size_t)device->desc.threads, sizeof(struct lom_assembly), &device->error);
    return device;
}

bool lom_lay_chunks(lom_device *device, size_t count)
{
    const size_t batch = (size_t)device->desc.batch, most = count > batch ? device->most_chunks : batch;
    lom_error *error = &device->error;
    if (!lom_reserve(&device->chunks, &device->chunk_capacity, most, sizeof *device->chunks, error))
        return false;
    device->pass.chunks = device->chunks;
    return true;
}

static void free_chunk(struct lom_chunk *chunk)
{
    lom_release(chunk->rows);
    lom_release(chunk->primitives);
    lom_release(chunk->tile_first);
    lom_release(chunk->tile_list);
    lom_release(chunk->captured);
}

static void free_assembly(struct lom_assembly *assembly)
{
    lom_release(assembly->corners);
    lom_release(assembly->vertex_list);
    lom_release(assembly->clip);
    lom_release(assembly->codes);
    lom_release(assembly->tile);
    lom_release(assembly->needed);
    lom_free_expansion(&assembly->expansion);
}

void lom_close_device(lom_device *device)
{
    if (device == NULL)
        return;
    lom_free_pool(device->pool);
    lom_forget_records(device);
    for (size_t i = 0; device->chunks != NULL && i < device->chunk_capacity; i++)
        free_chunk(&device->chunks[i]);
    for (int i = 0; device->assemblies != NULL && i < device->desc.threads; i++)
        free_assembly(&device->assemblies[i]);
    for (size_t i = 0; i < device->texture_count; i++)
        lom_free_texture(device->textures[i]);
    lom_release(device->textures);
    lom_release(device->chunks);
    lom_release(device->reached);
    lom_release(device->assemblies);
    lom_release(device->worker_tiles);
    lom_release(device->sampled);
    lom_release(device->tile_memory);
    lom_release(device->tile_touched);
    lom_release(device->draws);
    lom_release(device->calls);
    lom_release(device->parts);
    lom_release(device->uniforms);
    lom_release(device->runs);
    lom_free_queries(device);
    lom_release(device);
}

const lom_error *lom_device_error(const lom_device *device)
{
    static const lom_error missing = { LOM_ERROR_MEMORY, "The system gave no memory for a device." };
    return device != NULL ? &device->error : &missing;
}

bool lom_check_device(const lom_device *device, lom_error *error)
{
    return lom_pass_error(lom_device_error(device), error);
}

void lom_abandon_passes(lom_device *device)
{
    lom_fail(&device->error, LOM_ERROR_ABANDONED, "The frame was abandoned by who watched it.");
}

void lom_resume_passes(lom_device *device)
{
    if (device->error.code == LOM_ERROR_ABANDONED)
        device->error = (lom_error){ .code = LOM_OK };
}

void lom_forget_failure(lom_device *device)
{
    device->error = (lom_error){ .code = LOM_OK };
}

void lom_set_device_filtering(lom_device *device, lom_filtering filtering)
{
    device->desc.filtering = filtering;
}

lom_device_desc lom_describe_device(const lom_device *device)
{
    return device != NULL ? device->desc : (lom_device_desc){ .threads = 0 };
}

void lom_share_work(lom_device *device, size_t count, size_t piece, lom_range_work *work, void *context)
{
    lom_share_out(device->pool, count, piece, work, context);
}

double lom_device_shared_seconds(const lom_device *device)
{
    return device == NULL || device->pool == NULL ? 0 : (double)lom_pool_shared(device->pool) * 1e-9;
}

lom_counters lom_device_counters(const lom_device *device)
{
    return device != NULL ? device->counters : (lom_counters){ .passes = 0 };
}

enum { ROWS = 64 }; /* of a texture that a worker stores at a time */

struct update {
    lom_texture *texture;
    const void *pixels;
    int level;
};

static void store_rows(void *context, size_t first, size_t end)
{
    const struct update *u = context;
    lom_store_rows(u->texture, u->level, u->pixels, (int)first, (int)end);
}

static void store_level(lom_device *device, lom_texture *texture, int level, const void *pixels)
{
    struct update update = { texture, pixels, level };
    size_t rows = (size_t)texture->level[level].height * (size_t)lom_level_layers(texture, level);
    lom_share_work(device, rows, ROWS, store_rows, &update);
}

lom_texture *lom_make_texture(lom_device *device, const lom_texture_desc *desc)
{
    if (!lom_check_device(device, NULL))
        return NULL;
    if (!lom_reserve(&device->textures, &device->texture_capacity, device->texture_count + 1, sizeof *device->textures,
                     NULL)) {
        lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for another texture.");
        return NULL;
    }
    static const lom_texture_desc none = { .width = 0 };
    lom_texture_desc made = desc != NULL ? *desc : none;
    if (device->desc.filtering == LOM_FILTERING_FIXED)
        made.sampler.filtering = LOM_FILTERING_FIXED;
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_texture *texture = lom_begin_texture(&made, &device->error);
    for (int i = 0; texture != NULL && i < texture->level_count; i++)
        if (lom_pixels_of_level(&made, i) != NULL)
            store_level(device, texture, i, lom_pixels_of_level(&made, i));
    if (texture != NULL)
        lom_finish_attachment(device, texture);
    lom_leave_float_state(&state);
    if (texture == NULL)
        return NULL;
    texture->owner = device;
    device->textures[device->texture_count++] = texture;
    return texture;
}

bool lom_update_texture(lom_device *device, lom_texture *texture, const void *pixels, size_t size)
{
    if (!lom_check_device(device, NULL))
        return false;
    if (device->in_pass)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A texture cannot be updated within a pass.");
    if (texture != NULL && texture->owner != NULL && texture->owner != device)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A device was asked to update a texture of another device.");
    if (!lom_check_update(texture, pixels, size, &device->error))
        return false;
    lom_float_state state;
    lom_enter_float_state(&state);
    store_level(device, texture, 0, pixels);
    lom_forget_samples(texture);
    lom_finish_attachment(device, texture);
    lom_leave_float_state(&state);
    return true;
}

bool lom_renew_texture(lom_device *device, lom_texture **texture, const lom_texture_desc *desc)
{
    if (*texture == NULL) {
        *texture = lom_make_texture(device, desc);
        return *texture != NULL;
    }
    size_t layers = desc->kind == LOM_TEXTURE_CUBE ? 6 : desc->depth > 1 ? (size_t)desc->depth : 1;
    size_t texels = (size_t)desc->width * (size_t)desc->height * layers;
    return lom_update_texture(device, *texture, desc->pixels, texels * lom_format_size(desc->format));
}

void lom_release_texture(lom_device *device, lom_texture *texture)
{
    if (device == NULL || texture == NULL)
        return;
    for (size_t i = 0; i < device->texture_count; i++)
        if (device->textures[i] == texture) {
            device->textures[i] = device->textures[--device->texture_count];
            lom_free_texture(texture);
            return;
        }
    lom_fail(&device->error, LOM_ERROR_USAGE, "A device was asked to free a texture that is not one of its own.");
}
