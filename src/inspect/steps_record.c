/* What is recorded of all pixels of a pass, as planes. In: the chosen pass, watched a band of rows at a time. Out: for each
 * pixel how many triangles cover it, and of the fragment that is seen at the end of the pass its varyings, the values that
 * its shader names, its colour; of every fragment the texels that it read. Invariant: memory is that of one band's records
 * and of the planes. */
#include "inspect/steps.h"

#include "base/numbers.h"
#include "base/reserve.h"
#include "image/texture.h"

#include <stdio.h>

enum { LEAST_BAND = 1280, MOST_BAND = 4096, MOST_DEPTH_BAND = 16384, BANDS = 64, MOST_PLANES = 160, MOST_LEVELS = 600 };

/* ---- planes ---- */

static struct plane *find_plane(struct steps *s, enum plane_kind kind, const char *name, const lom_shader *shader,
                                int index, int components)
{
    size_t pixels = (size_t)s->width * (size_t)s->height;
    for (size_t i = 0; i < s->plane_count; i++) {
        struct plane *p = &s->planes[i];
        if (p->kind == kind && p->shader == shader && p->index == index && p->components == components &&
            (p->name == name || strcmp(p->name, name) == 0))
            return p;
    }
    if (s->plane_count == MOST_PLANES)
        return NULL;
    struct plane plane = { .kind = kind, .name = name, .shader = shader, .index = index, .components = components };
    if (!lom_reserve(&s->planes, &s->plane_capacity, s->plane_count + 1, sizeof plane, s->error)) {
        s->failed = true;
        return NULL;
    }
    plane.value = lom_allocate(pixels, (size_t)components * sizeof(float), s->error);
    plane.is_there = lom_allocate(pixels, sizeof(bool), s->error);
    s->failed |= plane.value == NULL || plane.is_there == NULL;
    s->planes[s->plane_count++] = plane;
    return s->failed ? NULL : &s->planes[s->plane_count - 1];
}

static void set(struct plane *plane, size_t pixel, const float *value)
{
    if (plane == NULL || plane->value == NULL || plane->is_there == NULL)
        return;
    memcpy(plane->value + pixel * (size_t)plane->components, value, (size_t)plane->components * sizeof *value);
    plane->there += !plane->is_there[pixel];
    plane->is_there[pixel] = true;
}

static void set_number(struct steps *s, enum plane_kind kind, const char *name, size_t pixel, float value)
{
    set(find_plane(s, kind, name, NULL, 0, 1), pixel, &value);
}

/* ---- what the vertex shader calls a varying ---- */

/* The value named at all three vertices that is this varying. */
static bool is_named(const lom_triangle_record *t, const char *name, int component, int varying)
{
    int same = 0;
    for (int k = 0; k < 3; k++)
        for (const lom_note_record *n = t->vertex[k].notes; n != NULL; n = n->next)
            same += n->kind == LOM_NOTE_VALUE && strcmp(n->name, name) == 0 && component < n->components &&
                    n->value[component] == t->vertex[k].varying[varying];
    return same == 3;
}

static void name_varying(const lom_triangle_record *t, struct plane *plane)
{
    for (const lom_note_record *n = t->vertex[0].notes; n != NULL && plane->title[0] == 0; n = n->next)
        for (int c = 0; n->kind == LOM_NOTE_VALUE && c < n->components && c < 4; c++)
            if (plane->title[0] == 0 && is_named(t, n->name, c, plane->index))
                snprintf(plane->title, sizeof plane->title, n->components > 1 ? "%s.%c" : "%s", n->name, "xyzw"[c]);
}

static void take_varyings(struct steps *s, const lom_triangle_record *t, size_t pixel)
{
    const lom_shader *shader = t->draw->desc.shader;
    for (int v = 0; v < shader->varyings; v++) {
        if ((shader->reads >> v & 1) == 0)
            continue;
        struct plane *plane = find_plane(s, PLANE_VARYING, "", shader, v, 1);
        if (plane != NULL && plane->title[0] == 0)
            name_varying(t, plane);
        set(plane, pixel, &t->fragment.varying[v]);
    }
}

/* ---- texels ---- */

static struct read_level *find_level(struct steps *s, const lom_texture *texture, int level, int layer)
{
    for (size_t i = 0; i < s->level_count; i++) {
        struct read_level *l = &s->levels[i];
        if (l->texture == texture && l->level == level && l->layer == layer &&
            l->width == texture->level[level].width && l->height == texture->level[level].height)
            return l;
    }
    struct read_level l = { texture, level, layer, texture->level[level].width, texture->level[level].height, NULL, 0 };
    if (s->level_count == MOST_LEVELS)
        return NULL;
    l.times = lom_allocate((size_t)l.width * (size_t)l.height, sizeof *l.times, s->error);
    if (l.times == NULL ||
        !lom_reserve(&s->levels, &s->level_capacity, s->level_count + 1, sizeof *s->levels, s->error)) {
        lom_release(l.times);
        s->failed = true;
        return NULL;
    }
    s->levels[s->level_count] = l;
    return &s->levels[s->level_count++];
}

/* Within the level: by repeating where it repeats, else at the edge. */
static int wrapped(int at, int size, lom_wrap wrap)
{
    if (at >= 0 && at < size)
        return at;
    return wrap == LOM_WRAP_REPEAT ? (at % size + size) % size : at < 0 ? 0 : size - 1;
}

static void take_lookups(struct steps *s, const lom_note_record *notes, size_t pixel, bool is_seen)
{
    for (const lom_note_record *n = notes; n != NULL; n = n->next) {
        const lom_texture *texture = n->texture;
        if (texture == NULL)
            continue;
        const char *label = lom_texture_label(texture);
        if (is_seen && n->kind == LOM_NOTE_LOOKUP && texture->level_count > 1)
            set_number(s, PLANE_LEVEL, label != NULL ? label : "texture", pixel, n->value[4]);
        for (int i = 0; i < n->taps; i++) {
            const lom_tap *tap = &n->tap[i];
            if (tap->layer < 0 || tap->layer >= lom_level_layers(texture, tap->level))
                continue;
            struct read_level *level = find_level(s, texture, tap->level, tap->layer);
            if (level == NULL)
                return;
            int x = wrapped(tap->x, level->width, texture->sampler.wrap_s);
            int y = wrapped(tap->y, level->height, texture->sampler.wrap_t);
            level->times[(size_t)y * (size_t)level->width + (size_t)x]++;
            level->reads++;
        }
    }
}

/* ---- a pixel ---- */

static void take_owner(struct steps *s, const lom_triangle_record *t, size_t pixel)
{
    const lom_fragment_record *f = &t->fragment;
    s->owner[pixel] = ((uint64_t)t->draw->number + 1) << 32 | (uint64_t)(t->number + 1);
    if (f->depth_tested || f->depth_written)
        set_number(s, PLANE_COUNT, "depth", pixel, f->depth);
    take_varyings(s, t, pixel);
    for (const lom_note_record *n = f->notes; n != NULL; n = n->next)
        if (n->kind == LOM_NOTE_VALUE && n->components >= 1 && n->components <= 4)
            set(find_plane(s, PLANE_VALUE, n->name, NULL, 0, n->components >= 3 ? 3 : n->components), pixel, n->value);
    if (f->shaded && s->attachment >= 0)
        set(find_plane(s, PLANE_COLOR, "color", NULL, 0, 3), pixel, f->color[0]);
}

static void take_chosen(struct steps *s, const lom_pass_record *pass, size_t pixel)
{
    const lom_triangle_record *owner = NULL;
    int covering = 0, hidden = 0;
    for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
        for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next) {
            covering += t->covered;
            hidden += t->covered && t->fate == LOM_FATE_DEPTH;
            owner = lom_is_seen(s, t) ? t : owner;
        }
    set_number(s, PLANE_COUNT, "covering", pixel, (float)covering);
    set_number(s, PLANE_COUNT, "hidden", pixel, (float)hidden);
    for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
        for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
            if (t->fragment.shaded)
                take_lookups(s, t->fragment.notes, pixel, t == owner);
    if (owner != NULL)
        take_owner(s, owner, pixel);
}

/* Before the first triangle that blends, and after the last. */
static void take_blended(struct steps *s, const lom_pass_record *pass, size_t pixel)
{
    const lom_write_record *first = NULL, *last = NULL;
    for (const lom_draw_record *draw = pass->draws; draw != NULL; draw = draw->next)
        for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
            if (draw->desc.blend[0].enabled && t->covered && t->fragment.write[0].written) {
                first = first != NULL ? first : &t->fragment.write[0];
                last = &t->fragment.write[0];
            }
    if (first == NULL)
        return;
    set(find_plane(s, PLANE_BLEND, "before", NULL, 0, 3), pixel, first->before);
    set(find_plane(s, PLANE_BLEND, "source", NULL, 0, 3), pixel, last->source);
    set_number(s, PLANE_BLEND, "alpha", pixel, last->source[3]);
    set(find_plane(s, PLANE_BLEND, "after", NULL, 0, 3), pixel, last->after);
}

static void take_pixel(struct steps *s, const lom_pixel_record *record, size_t pixel)
{
    for (const lom_pass_record *pass = record->passes; pass != NULL && !s->failed; pass = pass->next) {
        if (pass->number == s->chosen.number)
            take_chosen(s, pass, pixel);
        if (s->blended.label != NULL && pass->number == s->blended.number)
            take_blended(s, pass, pixel);
    }
}

/* Rows that are watched at a time: a pixel's records take some 100 KB where its shaders look much up, and less where there
 * is nothing but depth; each band is a frame. */
static int rows_of_band(const struct steps *s)
{
    int most = s->attachment < 0 ? MOST_DEPTH_BAND : MOST_BAND, share = s->width * s->height / BANDS;
    return lom_larger_int(1, lom_smaller_int(most, lom_larger_int(LEAST_BAND, share)) / s->width);
}

int lom_count_bands(const struct steps *s)
{
    int rows = rows_of_band(s);
    return (s->height + rows - 1) / rows;
}

void lom_record_planes(struct steps *s)
{
    int rows = rows_of_band(s);
    s->last = s->blended.label != NULL ? s->blended.number : s->chosen.number;
    s->owner = lom_allocate((size_t)s->width * (size_t)s->height, sizeof *s->owner, s->error);
    s->failed |= s->owner == NULL;
    for (int y = 0; y < s->height && !s->failed; y += rows) {
        const lom_rect band = { 0, y, s->width, lom_smaller_int(rows, s->height - y) };
        s->failed = !lom_watch_target(s, band) || !lom_draw_chosen(s, NULL);
        for (int i = 0; i < band.width * band.height && !s->failed; i++) {
            int x = i % band.width, row = y + i / band.width;
            take_pixel(s, lom_watched_pixel(s->device, 0, x, row), (size_t)row * (size_t)s->width + (size_t)x);
        }
    }
}
