/* The materials of a file by name, in order of first mention; and the reader of MTL. */
#ifndef LOM_GEOMETRY_MATERIALS_H
#define LOM_GEOMETRY_MATERIALS_H

#include <lom/geometry.h>

#include "text.h"

enum { LOM_MATERIAL_LIMIT = 65536 };

struct lom_material_entry {
    lom_material material;
    bool defined;                       /* by a material file; otherwise only used */
    uint32_t commented, last_commented; /* defined materials whose name before a comment is this one: how many, one */
};

struct lom_materials {
    struct lom_material_entry *entries;
    size_t count, capacity;
    uint32_t *slots; /* hash table of entry numbers + 1, open addressing */
    size_t slot_count;
};

/* The number of the material called name (1 to 63 bytes), added as lom_default_material when there is none. -1 on
 * failure. */
int lom_find_material(struct lom_materials *materials, const char *name, size_t length, lom_error *error);
/* The number of the material called name, -1 when there is none. */
int lom_known_material(const struct lom_materials *materials, const char *name, size_t length);
/* lom_find_material for a name in a file; the messages say where. */
int lom_text_material(struct lom_materials *materials, struct lom_text *text, struct lom_word name);
void lom_free_materials(struct lom_materials *materials);
/* Adds what an MTL file defines. folder goes in front of the paths of maps; name is for messages. */
bool lom_decode_mtl(struct lom_materials *materials, lom_bytes file, const char *name, const char *folder,
                    size_t folder_length, lom_warnings *warnings, lom_error *error);

#endif
