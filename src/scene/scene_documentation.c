/* docs/scene.md from the tables of keys. In: the root table. Out: Markdown. Invariant: what the page says of a key is
 * what the reader checks, because both read the same table. */
#include "base/reserve.h"
#include "scene/reader.h"
#include "scene/scene_keys.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char introduction[] =
    "# The scene file\n"
    "\n"
    "<!-- made by `lom make scene-docs -o docs/scene.md` from the tables that the reader uses; do not edit -->\n"
    "\n"
    "A scene is a [TOML 1.0](https://toml.io/en/v1.0.0) file. Every key may be left out unless it is *required*. "
    "Lengths\n"
    "are metres with y up, angles are degrees, colours are three numbers of linear light (red, green, blue), and file\n"
    "names are relative to the folder of the scene file; an empty name is none.\n"
    "\n"
    "```toml\n"
    "[camera]\n"
    "position = [0, 3, 12]\n"
    "target = [0, 1, 0]\n"
    "\n"
    "[terrain]\n"
    "height_map = \"heights.png\"\n"
    "\n"
    "[water]\n"
    "level = 4\n"
    "\n"
    "[[entity]]\n"
    "name = \"boat\"\n"
    "mesh = \"boat.obj\"\n"
    "position = [2, 4, -3]\n"
    "```\n"
    "\n"
    "Any key can be overridden without touching the file, tables of an array by their index or their name:\n"
    "\n"
    "```\n"
    "lom render lake.toml -o lake.png --set water.fresnel=false --set 'entity.boat.position=[1, 4, 0]'\n"
    "```\n"
    "\n"
    "What is wrong is named with its place: `lake.toml:12:5: unknown key \"watre\" (did you mean \"water\"?)`.\n";

typedef struct page {
    char *text;
    size_t length, capacity;
    lom_error *error;
    bool failed;
} page;

static void add(page *out, const char *text)
{
    size_t length = strlen(text);
    if (!lom_reserve(&out->text, &out->capacity, out->length + length + 1, 1, out->error)) {
        out->failed = true;
        return;
    }
    memcpy(out->text + out->length, text, length + 1);
    out->length += length;
}

static void __attribute__((format(printf, 2, 3))) add_format(page *out, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    add(out, text);
}

static void add_type(page *out, const lom_key *key)
{
    static const char *const one[] = { "true or false", "integer", "number", "number", "colour", "text", "file" };
    static const char *const many[] = { "", "", "numbers", "numbers", "", "texts", "files" };
    char range[160];
    if (key->type == LOM_KEY_CHOICE)
        add(out, lom_range_text(range, key));
    else if (key->count > 1 && key->type != LOM_KEY_COLOR)
        add_format(out, "%s%d %s", key->flags & LOM_KEY_SPREAD ? "one number or " : "", key->count, many[key->type]);
    else
        add_format(out, "%s%s", key->flags & LOM_KEY_SPREAD ? "one number or " : "", one[key->type]);
    if (key->type != LOM_KEY_CHOICE && lom_range_text(range, key)[0] != 0)
        add_format(out, " %s", range);
    if (key->unit != NULL)
        add_format(out, " %s", key->unit);
}

static void add_numbers(page *out, const lom_key *key)
{
    int count = key->count > 1 ? key->count : 1;
    bool equal = key->flags & LOM_KEY_SPREAD;
    for (int i = 1; i < count; i++)
        equal &= key->initial[i] == key->initial[0];
    count = equal ? 1 : count;
    for (int i = 0; i < count; i++) {
        char text[32];
        lom_print_double(text, key->initial[i]);
        add_format(out, "%s%s", i > 0 ? ", " : count > 1 ? "[" : "", text);
    }
    add(out, count > 1 ? "]" : "");
}

static void add_default(page *out, const lom_key *key)
{
    if (key->flags & LOM_KEY_REQUIRED)
        add(out, "*required*");
    else if (key->initial_text != NULL)
        add(out, key->initial_text);
    else if (key->type == LOM_KEY_BOOL)
        add(out, key->initial[0] != 0 ? "true" : "false");
    else if (key->type == LOM_KEY_CHOICE)
        add_format(out, "\"%s\"", key->choices[lom_int_of(key->initial[0])]);
    else if (key->type == LOM_KEY_STRING || key->type == LOM_KEY_FILE)
        add(out, "none");
    else
        add_numbers(out, key);
}

static bool is_table(const lom_key *key)
{
    return key->type == LOM_KEY_TABLE || key->type == LOM_KEY_TABLES;
}

static void add_rows(page *out, const lom_key_table *table)
{
    add(out, "\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n");
    for (int i = 0; i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        if (is_table(key))
            continue;
        add_format(out, "| `%s` | ", key->name);
        add_type(out, key);
        add(out, " | ");
        add_default(out, key);
        add_format(out, " | %s |\n", key->text);
    }
}

/* Title, text and rows of a table, then the tables inside it; path is its dotted name with a last dot, "" of the root.
 */
static void add_table(page *out, const lom_key_table *table, const char *path)
{
    add_format(out, "\n%s\n", table->text);
    add_rows(out, table);
    for (int i = 0; i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        if (!is_table(key))
            continue;
        char inner[128];
        const char *marks = key->type == LOM_KEY_TABLES ? "[]" : "";
        add_format(out, "\n## `%.1s[%s%s]%s`", marks, path, key->name, marks[0] != 0 ? marks + 1 : "");
        add_format(out, key->others_offset != 0 ? " or `[[%s%s]]`\n" : "\n", path, key->name);
        snprintf(inner, sizeof inner, "%s%s.", path, key->name);
        add_table(out, key->table, inner);
    }
}

lom_bytes lom_write_scene_documentation(lom_error *error)
{
    page out = { .error = error };
    add(&out, introduction);
    add(&out, "\n## The top of the file\n");
    add_table(&out, &lom_scene_keys, "");
    if (!out.failed)
        return (lom_bytes){ (uint8_t *)out.text, out.length };
    lom_release(out.text);
    return (lom_bytes){ 0 };
}
