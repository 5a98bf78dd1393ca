/* The end of a pass, and of an update: what lies around and above level 0 of a texture. In: its texels, after a pass
 * most often with the apron's columns, which tiles fill (resolve.c). Out: the aprons, and the other levels where it has
 * them. Bands of rows are handed out by a counter, with a barrier from level to level.
 * Invariant: a texel is what lom_finish_texture makes it, whoever does. */
#include "pipeline/device.h"

enum {
    BAND = 32,         /* rows */
    SHARED = 256 * 128 /* texels of a level that are worth a barrier */
};

struct finish {
    lom_texture *texture;
    int level;
    atomic_int next; /* row */
};

static void finish_bands(void *context, int worker)
{
    struct finish *f = context;
    int height = f->texture->level[f->level].height;
    (void)worker;
    for (;;) {
        int first = atomic_fetch_add_explicit(&f->next, BAND, memory_order_relaxed);
        if (first >= height)
            return;
        int end = first + BAND < height ? first + BAND : height;
        if (f->level > 0 && f->texture->builds_mips)
            lom_shrink_rows(f->texture, f->level, 0, first, end);
        lom_fill_columns(f->texture, f->level, 0, first, end);
    }
}

/* Of a flat texture, from level `first` on. */
static void finish_levels(lom_device *device, lom_texture *texture, int first)
{
    for (int i = first; i < texture->level_count; i++) {
        struct finish finish = { .texture = texture, .level = i };
        const lom_level *l = &texture->level[i];
        if (i > 0 && (size_t)l->width * (size_t)l->height >= SHARED)
            lom_offer_work(device->pool, finish_bands, &finish);
        else
            finish_bands(&finish, 0);
        lom_fill_rows(texture, i, 0);
    }
}

void lom_finish_attachment(lom_device *device, lom_texture *texture)
{
    if (texture->kind != LOM_TEXTURE_2D || texture->decoded != NULL) /* made from pixels: no usual target */
        lom_finish_texture(texture);
    else
        finish_levels(device, texture, 0);
}

/* A level of a layer, and the levels that are made of it: in a cube their aprons are those of all faces. */
void lom_finish_slice(lom_device *device, lom_texture *texture, lom_slice slice)
{
    if (lom_fills_columns(texture, slice)) {
        lom_fill_rows(texture, 0, 0);
        finish_levels(device, texture, 1);
        return;
    }
    if (texture->decoded != NULL) {
        lom_finish_texture(texture);
        return;
    }
    const bool builds = slice.level == 0 && texture->builds_mips;
    for (int i = slice.level; i < (builds ? texture->level_count : slice.level + 1); i++) {
        if (i > slice.level)
            lom_shrink_rows(texture, i, slice.layer, 0, texture->level[i].height);
        if (texture->kind == LOM_TEXTURE_CUBE) {
            lom_fill_apron(texture, i);
            continue;
        }
        lom_fill_columns(texture, i, slice.layer, 0, texture->level[i].height);
        lom_fill_rows(texture, i, slice.layer);
    }
}
