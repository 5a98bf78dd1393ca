/* Materials by name. In: names. Out: numbers in order of first mention, whatever the hash. */
#include "materials.h"
#include "base/reserve.h"

#include <string.h>

lom_material lom_default_material(const char *name)
{
    lom_material material = {
        .ambient = { .2f, .2f, .2f }, .diffuse = { 1, 1, 1 }, .shininess = 1, .opacity = 1, .bump = 1
    };
    size_t length = strlen(name);
    memcpy(material.name, name, length < sizeof material.name ? length : sizeof material.name - 1);
    return material;
}

/* The slot that holds name, or the empty one where it belongs. */
static size_t find_slot(const struct lom_materials *materials, const char *name, size_t length)
{
    size_t mask = materials->slot_count - 1, slot = (size_t)lom_hash_bytes(LOM_HASH_START, name, length) & mask;
    for (; materials->slots[slot] != 0; slot = (slot + 1) & mask) {
        const char *other = materials->entries[materials->slots[slot] - 1].material.name;
        if (strlen(other) == length && memcmp(other, name, length) == 0)
            break;
    }
    return slot;
}

/* Keeps the table at most half full. */
static bool grow_slots(struct lom_materials *materials, lom_error *error)
{
    if (2 * (materials->count + 1) <= materials->slot_count)
        return true;
    size_t larger = materials->slot_count == 0 ? 64 : 2 * materials->slot_count;
    uint32_t *slots = lom_allocate(larger, sizeof *slots, error);
    if (slots == NULL)
        return false;
    lom_release(materials->slots);
    materials->slots = slots;
    materials->slot_count = larger;
    for (size_t i = 0; i < materials->count; i++) {
        const char *name = materials->entries[i].material.name;
        slots[find_slot(materials, name, strlen(name))] = (uint32_t)i + 1;
    }
    return true;
}

int lom_find_material(struct lom_materials *materials, const char *name, size_t length, lom_error *error)
{
    char terminated[sizeof((lom_material *)0)->name] = "";
    memcpy(terminated, name, length < sizeof terminated ? length : sizeof terminated - 1);
    if (!grow_slots(materials, error))
        return -1;
    size_t slot = find_slot(materials, terminated, strlen(terminated));
    if (materials->slots[slot] != 0)
        return (int)(materials->slots[slot] - 1);
    if (materials->count == LOM_MATERIAL_LIMIT) {
        lom_fail(error, LOM_ERROR_LIMIT, "More than %d materials.", LOM_MATERIAL_LIMIT);
        return -1;
    }
    if (!lom_reserve(&materials->entries, &materials->capacity, materials->count + 1, sizeof *materials->entries,
                     error))
        return -1;
    materials->entries[materials->count] = (struct lom_material_entry){ .material = lom_default_material(terminated) };
    materials->slots[slot] = (uint32_t)++materials->count;
    return (int)materials->count - 1;
}

int lom_known_material(const struct lom_materials *materials, const char *name, size_t length)
{
    return materials->slot_count == 0 ? -1 : (int)materials->slots[find_slot(materials, name, length)] - 1;
}

int lom_text_material(struct lom_materials *materials, struct lom_text *text, struct lom_word name)
{
    lom_error error = { 0 };
    if (name.length >= sizeof((lom_material *)0)->name) {
        lom_text_fail(text, LOM_ERROR_LIMIT, "The material's name is longer than %zu bytes.",
                      sizeof((lom_material *)0)->name - 1);
        return -1;
    }
    int number = lom_find_material(materials, name.start, name.length, &error);
    if (number < 0)
        lom_text_fail(text, error.code, "%s", error.text);
    return number;
}

void lom_free_materials(struct lom_materials *materials)
{
    lom_release(materials->entries);
    lom_release(materials->slots);
}
