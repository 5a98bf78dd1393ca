/* Proves that the table of keys is sound (ranges hold the defaults, members lie inside their structs and apart, every
 * key is explained) and that docs/scene.md is what the table makes. */
#include "check.h"
#include "scene/scene_compare.h"
#include "scene/scene_keys.h"

#include <lom/scene.h>

static void check_default(const lom_key *key)
{
    bool number = key->type == LOM_KEY_INTEGER || key->type == LOM_KEY_NUMBER || key->type == LOM_KEY_ANGLE ||
                  key->type == LOM_KEY_COLOR;
    if (!number || (key->minimum == 0 && key->maximum == 0) || key->initial_text != NULL)
        return;
    for (int i = 0; i < (key->count > 1 ? key->count : 1); i++) {
        bool inside = key->initial[i] >= key->minimum && key->initial[i] <= key->maximum &&
                      !((key->flags & LOM_KEY_ABOVE) && key->initial[i] == key->minimum);
        CHECK(inside || (key->flags & LOM_KEY_REQUIRED), "%s: the default %g is outside its range", key->name,
              key->initial[i]);
    }
}

static void check_key(const lom_key_table *table, int index)
{
    const lom_key *key = &table->keys[index];
    size_t end = key->offset + lom_key_size(key);
    CHECK(key->offset >= sizeof(bool) && end <= table->size, "%s lies outside its struct", key->name);
    CHECK(key->minimum <= key->maximum, "%s", key->name);
    CHECK(key->type != LOM_KEY_COLOR || key->count == 3, "%s", key->name);
    CHECK(key->count <= 4 || key->type == LOM_KEY_FILE, "%s: no room for the defaults", key->name);
    CHECK((key->type == LOM_KEY_CHOICE) == (key->choices[0] != NULL), "%s", key->name);
    CHECK((key->type == LOM_KEY_TABLE || key->type == LOM_KEY_TABLES) == (key->table != NULL), "%s", key->name);
    CHECK(key->type == LOM_KEY_TABLE ||
              (key->text != NULL && strchr(key->text, '|') == NULL && key->text[strlen(key->text) - 1] == '.'),
          "%s has no sentence that explains it", key->name);
    CHECK(key->type != LOM_KEY_ANGLE || strcmp(key->unit, "degrees") == 0, "%s", key->name);
    check_default(key);
    for (int i = 0; i < index; i++) {
        const lom_key *other = &table->keys[i];
        CHECK(strcmp(other->name, key->name) != 0, "%s stands twice", key->name);
        CHECK(end <= other->offset || key->offset >= other->offset + lom_key_size(other), "%s and %s overlap",
              key->name, other->name);
    }
}

static void check_table(const lom_key_table *table)
{
    CHECK(table->key_count >= 1 && table->text != NULL && table->text[strlen(table->text) - 1] == '.');
    for (int i = 0; i < table->key_count; i++) {
        check_key(table, i);
        if (table->keys[i].table != NULL)
            check_table(table->keys[i].table);
    }
}

static void tables_are_sound(void)
{
    check_table(&lom_scene_keys);
}

static void documentation_is_current(void)
{
    lom_error error = { 0 };
    lom_bytes made = lom_write_scene_documentation(&error), kept = lom_read_file("docs/scene.md", 1 << 24, &error);
    CHECK(made.data != NULL && kept.data != NULL, "%s", error.text);
    bool same = made.data != NULL && kept.data != NULL && made.size == kept.size &&
                memcmp(made.data, kept.data, made.size) == 0;
    CHECK(same, "docs/scene.md is not what the table makes; run: lom make scene-docs -o docs/scene.md");
    lom_release(made.data);
    lom_release(kept.data);
}

int main(int argc, char **argv)
{
    RUN(tables_are_sound);
    RUN(documentation_is_current);
    return check_result();
}
