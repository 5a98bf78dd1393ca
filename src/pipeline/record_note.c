/* Notes of a packet as a record keeps them. In: notes over four lanes. Out: a list of one lane's, in their order; a
 * lookup with the texels that it read, taken from its footprints. Invariant: weights are the samplers' own, and each texel
 * is read where they read it. */
#include "image/convert_lanes.h"
#include "pipeline/record.h"

static float lane_value(const struct lom_notes *notes, const struct lom_note *note, size_t row, int lane)
{
    return row < note->count ? notes->rows[note->first + row][lane] : 0;
}

static int32_t lane_bits(const struct lom_notes *notes, const struct lom_note *note, size_t row, int lane)
{
    int32_t bits;
    memcpy(&bits, &notes->rows[note->first + row][lane], sizeof bits);
    return bits;
}

static void read_color(const lom_texture *texture, const lom_tap *tap, float color[4])
{
    const void *texel = lom_texel(texture, tap->level, tap->x, tap->y, tap->layer);
    if (texture->storage != LOM_STORAGE_RGBA8) {
        memcpy(color, texel, (texture->storage == LOM_STORAGE_R32F ? 1 : 4) * sizeof *color);
        return;
    }
    for (int c = 0; c < 4; c++) {
        int code = (int)(*(const uint32_t *)texel >> 8 * c & 255);
        color[c] = texture->srgb && c < 3 ? lom_float_of_srgb8_lanes(lom_splat_int(code))[0] : (float)code / 255.0f;
    }
}

static void add_tap(lom_note_record *to, lom_tap tap)
{
    if (tap.weight == 0 || to->taps == LOM_MAX_TAPS)
        return;
    read_color(to->texture, &tap, tap.color);
    to->tap[to->taps++] = tap;
}

/* The texels of one level, whose share of the lookup is `share`. row.offset is that of texel (-1, -1). */
static void add_footprint(lom_note_record *to, const struct lom_notes *notes, const struct lom_note *note, int lane,
                          int level, float share)
{
    const lom_texture *texture = to->texture;
    const lom_level *l = &texture->level[level];
    int64_t at = (int64_t)(uint32_t)lane_bits(notes, note, 0, lane) - texture->row[level].offset;
    int64_t slice = texture->kind == LOM_TEXTURE_2D ? 0 : at / (int64_t)l->slice;
    at -= slice * (int64_t)l->slice;
    int x = (int)(at % (int64_t)l->pitch) - 1, y = (int)(at / (int64_t)l->pitch) - 1;
    int layer = (int)slice - (texture->kind == LOM_TEXTURE_3D ? 1 : 0);
    for (int k = 0; k < 8; k++) {
        float weight = share;
        for (size_t axis = 0; axis < 3; axis++) {
            float second = lane_value(notes, note, 1 + axis, lane);
            weight *= k >> axis & 1 ? second : 1 - second;
        }
        add_tap(to, (lom_tap){ level, x + (k & 1), y + (k >> 1 & 1), layer + (k >> 2), weight, { 0 } });
    }
}

static void copy_values(lom_note_record *to, const struct lom_notes *notes, const struct lom_note *note, int lane,
                        size_t first)
{
    for (size_t i = 0; i < note->count && first + i < 8; i++)
        to->value[first + i] = lane_value(notes, note, i, lane);
}

/* A note that begins a record; those that follow add to it. */
static lom_note_record *begin(struct record_memory *memory, const struct lom_notes *notes, const struct lom_note *note,
                              int lane)
{
    lom_note_record *to = lom_record_allocate(memory, sizeof *to);
    if (to == NULL)
        return NULL;
    bool samples = note->kind == LOM_NOTE_LOOKUP || note->kind == LOM_NOTE_TEXEL;
    *to = (lom_note_record){ .kind = note->kind,
                             .name = samples ? lom_texture_label(note->object) : note->name,
                             .components = (int)note->count,
                             .texture = samples ? note->object : NULL };
    if (note->kind == LOM_NOTE_TEXEL) {
        add_tap(to, (lom_tap){ lom_int_of(lane_value(notes, note, 2, lane)),
                               lane_bits(notes, note, 0, lane),
                               lane_bits(notes, note, 1, lane),
                               0,
                               1,
                               { 0 } });
        return to;
    }
    copy_values(to, notes, note, lane, 0);
    if (note->kind == LOM_NOTE_LOOKUP)
        to->face = lane_bits(notes, note, 5, lane);
    return to;
}

static void add(lom_note_record *to, const struct lom_notes *notes, const struct lom_note *note, int lane)
{
    if (to == NULL)
        return;
    if (note->kind == LOM_NOTE_RESULT && to->texture != NULL)
        for (size_t c = 0; c < 4; c++)
            to->result[c] = lane_value(notes, note, c, lane);
    if (note->kind == LOM_NOTE_LIGHT && to->kind == LOM_NOTE_STEP)
        copy_values(to, notes, note, lane, 3);
    if (note->kind != LOM_NOTE_FOOTPRINT || to->kind != LOM_NOTE_LOOKUP)
        return;
    int level = lom_int_of(to->value[4]), last = to->texture->level_count - 1;
    float fraction = to->value[4] - (float)level;
    bool first = to->components == 6; /* of the note; counted down by the footprints */
    to->components--;
    if (first)
        add_footprint(to, notes, note, lane, level, 1 - fraction);
    else if (fraction > 0)
        add_footprint(to, notes, note, lane, level < last ? level + 1 : last, fraction);
}

lom_note_record *lom_record_notes(struct record_memory *memory, const struct lom_notes *notes, int lane)
{
    lom_note_record *first = NULL, **last = &first, *current = NULL;
    for (size_t i = 0; i < notes->count; i++) {
        const struct lom_note *note = &notes->items[i];
        if (note->kind == LOM_NOTE_FOOTPRINT || note->kind == LOM_NOTE_RESULT || note->kind == LOM_NOTE_LIGHT) {
            add(current, notes, note, lane);
            continue;
        }
        if (note->name == lom_attributes_note)
            continue;
        if (note->kind == LOM_NOTE_STEP && lane_bits(notes, note, 3, lane) == 0) { /* the ray has ended */
            current = NULL;
            continue;
        }
        current = begin(memory, notes, note, lane);
        if (current == NULL)
            break;
        if (note->kind == LOM_NOTE_STEP)
            current->value[3] = 0;
        *last = current;
        last = &current->next;
    }
    return first;
}
