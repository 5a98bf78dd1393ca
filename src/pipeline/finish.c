/* The end of a pass, of an update, and of making a texture: what lies around and above level 0, and its texels decoded.
 * In: its texels, after a pass most often with the apron's columns, which tiles fill (resolve.c). Out: the aprons, the
 * other levels where it has them, what samplers read. Rows, faces and ranges are handed out, with a barrier
 * from level to level. Invariant: a texel is what lom_finish_texture makes it, whoever does. */
#include "pipeline/device.h"

enum {
    SHARED = 1 << 16, /* instructions that are worth a barrier */
    PIECE = 1 << 14,  /* texels that a worker decodes at a time */
    FACES = 6
};

/* About how many a texel of a level takes, of the one before: of an even size, or of three texels weighted along an axis. */
static size_t cost_of(const lom_texture *texture, int level)
{
    const lom_level *from = &texture->level[level > 0 ? level - 1 : 0];
    if (texture->kind != LOM_TEXTURE_3D && from->width % 2 == 0 && from->height % 2 == 0)
        return texture->srgb ? 256 : texture->storage == LOM_STORAGE_RGBA8 ? 16 : 32;
    return texture->srgb ? 1024 : texture->storage == LOM_STORAGE_RGBA8 ? 128 : 512;
}

/* A level and its slices from `layer` on. */
struct finish {
    lom_texture *texture;
    int level, layer;
    bool shrinks;
};

/* Rows counted through the slices: from the level before, with the apron's columns beside them. */
static void finish_rows(void *context, size_t first, size_t end)
{
    const struct finish *f = context;
    const size_t height = (size_t)f->texture->level[f->level].height;
    for (size_t row = first, next; row < end; row = next) {
        const size_t slice = row / height;
        next = (slice + 1) * height < end ? (slice + 1) * height : end;
        const int layer = f->layer + (int)slice, y = (int)(row - slice * height), y1 = (int)(next - slice * height);
        if (f->shrinks)
            lom_shrink_rows(f->texture, f->level, layer, y, y1);
        if (f->texture->kind != LOM_TEXTURE_CUBE)
            lom_fill_columns(f->texture, f->level, layer, y, y1);
    }
}

static void finish_faces(void *context, size_t first, size_t end)
{
    const struct finish *f = context;
    for (size_t face = first; face < end; face++)
        lom_fill_face(f->texture, f->level, (int)face);
}

/* `count` slices of a level; in a cube the aprons of all faces, since each looks over the edges of its neighbours. */
static void finish_level(lom_device *device, struct finish *f, int count)
{
    const lom_level *l = &f->texture->level[f->level];
    const size_t rows = (size_t)l->height * (size_t)count, row = (size_t)l->width * cost_of(f->texture, f->level);
    const bool is_cube = f->texture->kind == LOM_TEXTURE_CUBE;
    if (f->shrinks || !is_cube)
        lom_share_out(device->pool, rows, f->shrinks && rows * row >= SHARED ? SHARED / 4 / row + 1 : rows, finish_rows,
                      f);
    if (is_cube) {
        lom_share_out(device->pool, FACES, (size_t)l->width * FACES * 64 >= SHARED ? 1 : FACES, finish_faces, f);
        return;
    }
    for (int i = 0; i < count; i++)
        lom_fill_rows(f->texture, f->level, f->layer + i);
    if (f->texture->kind == LOM_TEXTURE_3D)
        lom_fill_slices(f->texture, f->level);
}

static void decode_texels(void *context, size_t first, size_t end)
{
    lom_decode_texels(context, first, end);
}

/* All slices, from level `first` on. */
static void finish_levels(lom_device *device, lom_texture *texture, int first)
{
    for (int i = first; i < texture->level_count; i++) {
        struct finish f = { .texture = texture, .level = i, .shrinks = i > 0 && texture->builds_mips };
        finish_level(device, &f, lom_level_layers(texture, i));
    }
}

void lom_finish_attachment(lom_device *device, lom_texture *texture)
{
    finish_levels(device, texture, 0);
    if (texture->decoded != NULL)
        lom_share_out(device->pool, texture->texel_count, PIECE, decode_texels, texture);
}

/* A level of a layer, and the levels that are made of it. */
void lom_finish_slice(lom_device *device, lom_texture *texture, lom_slice slice)
{
    const bool builds = slice.level == 0 && texture->builds_mips;
    if (lom_fills_columns(texture, slice)) {
        lom_fill_rows(texture, 0, 0);
        finish_levels(device, texture, 1);
        return;
    }
    if (texture->decoded != NULL) { /* of all */
        lom_finish_attachment(device, texture);
        return;
    }
    for (int i = slice.level; i < (builds ? texture->level_count : slice.level + 1); i++) {
        struct finish f = { .texture = texture, .level = i, .layer = slice.layer, .shrinks = i > slice.level };
        finish_level(device, &f, 1);
    }
}
