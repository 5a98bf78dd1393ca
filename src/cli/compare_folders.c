/* `lom compare` of two folders. In: their names. Out: a line for each picture that one of them has, in the order of their
 * names, and the exit status. Invariant: a picture is compared with the one of the same name, as these two alone would be;
 * one that only one folder has is refused; what cannot be read keeps nothing else from being compared. */
#include "compare.h"

#include "json.h"
#include "paths.h"

#include "base/reserve.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* A picture of either folder. */
struct name {
    char *text; /* from its folder on */
    int folder; /* 0, 1 */
};

struct names {
    struct name *items;
    size_t count, capacity;
};

static void drop_names(struct names *names)
{
    for (size_t i = 0; i < names->count; i++)
        lom_release(names->items[i].text);
    lom_release(names->items);
}

bool lom_is_folder(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* ---- what there is ---- */

static bool is_picture(const char *name)
{
    const lom_codec_info *codec = lom_find_codec(name, NULL);
    return codec != NULL && codec->reads;
}

enum { DEEPEST = 32 }; /* folders within folders: one that leads to a folder around it has no end */

static bool add_folder(struct names *names, int folder, const char *root, const char *within, int depth,
                       lom_error *error);

/* An entry of a folder: a picture, a folder of more, or nothing that is compared. `text` becomes the list's. */
static bool add_entry(struct names *names, int folder, const char *root, char *text, int depth, lom_error *error)
{
    char *path = text != NULL ? lom_path_print(error, "%s/%s", root, text) : NULL;
    bool done = path != NULL, is_kept = false;
    if (done && lom_is_folder(path)) {
        done = depth < DEEPEST
                   ? add_folder(names, folder, root, text, depth + 1, error)
                   : lom_fail(error, LOM_ERROR_FILE, "%s: more than %d folders within one another.", path, DEEPEST);
    } else if (done && is_picture(text)) {
        done = is_kept = lom_reserve(&names->items, &names->capacity, names->count + 1, sizeof *names->items, error);
        if (is_kept)
            names->items[names->count++] = (struct name){ text, folder };
    }
    if (!is_kept)
        lom_release(text);
    lom_release(path);
    return done;
}

/* within: a folder of root, "" for root itself. Hidden files are none of ours. */
static bool add_folder(struct names *names, int folder, const char *root, const char *within, int depth,
                       lom_error *error)
{
    const char *slash = within[0] != '\0' ? "/" : "";
    char *path = lom_path_print(error, "%s%s%s", root, slash, within);
    DIR *list = path != NULL ? opendir(path) : NULL;
    bool done = list != NULL;
    if (path != NULL && list == NULL)
        lom_fail(error, LOM_ERROR_FILE, "%s: %s.", path, strerror(errno));
    for (struct dirent *entry = done ? readdir(list) : NULL; entry != NULL && done; entry = readdir(list))
        if (entry->d_name[0] != '.')
            done = add_entry(names, folder, root, lom_path_print(error, "%s%s%s", within, slash, entry->d_name), depth,
                             error);
    if (list != NULL)
        closedir(list);
    lom_release(path);
    return done;
}

/* By the bytes of the name, then by the folder: no two are equal. */
static int order_names(const void *first, const void *second)
{
    const struct name *a = first, *b = second;
    int order = strcmp(a->text, b->text);
    return order != 0 ? order : a->folder - b->folder;
}

/* ---- comparing ---- */

typedef enum outcome { IDENTICAL, ACCEPTED, DIFFERENT, ONLY_FIRST, ONLY_SECOND, UNREADABLE, OUTCOME_COUNT } outcome;

static void tell_lonely(const struct name *name, const char *const folders[2], const struct lom_compare_values *values)
{
    if (values->json) {
        lom_json json = lom_json_begin(stdout);
        char *path = lom_path_print(NULL, "%s/%s", folders[name->folder], name->text);
        lom_json_text(&json, "a", name->folder == 0 ? path : NULL);
        lom_json_text(&json, "b", name->folder == 1 ? path : NULL);
        lom_json_bool(&json, "identical", false);
        lom_json_bool(&json, "accepted", false);
        lom_json_end(&json);
        lom_release(path);
    } else if (!values->quiet) {
        printf("%s: only in %s\n", name->text, folders[name->folder]);
    }
}

/* --diff is a folder here, of the pictures that are not accepted. */
static bool write_difference(const char *name, const struct lom_measures *measures,
                             const struct lom_compare_values *values, lom_error *error)
{
    char *path = lom_path_print(error, "%s/%s.png", values->diff, name);
    bool done = path != NULL && lom_make_folders(path, 0, error) && lom_write_difference(path, measures, error);
    lom_release(path);
    return done;
}

static outcome compare_pair(const char *name, const char *const folders[2], const struct lom_compare_values *values)
{
    lom_error error = { .code = LOM_OK };
    struct lom_measures measures = { .paths = { lom_path_print(&error, "%s/%s", folders[0], name),
                                                lom_path_print(&error, "%s/%s", folders[1], name) } };
    outcome result = UNREADABLE;
    if (measures.paths[0] != NULL && measures.paths[1] != NULL && lom_measure_pictures(&measures, values, &error)) {
        bool accept = lom_accepts(&measures, values);
        result = measures.exact.identical ? IDENTICAL : accept ? ACCEPTED : DIFFERENT;
        if (values->json && !values->quiet)
            lom_print_compare_json(&measures, accept);
        if (!values->json && !values->quiet) {
            printf("%s: ", name);
            lom_print_compare_line(stdout, &measures, accept);
        }
        if (result == DIFFERENT && values->diff != NULL && !write_difference(name, &measures, values, &error))
            result = UNREADABLE;
    }
    if (result == UNREADABLE)
        lom_complain_error(&error);
    lom_drop_measures(&measures);
    lom_release(measures.paths[0]);
    lom_release(measures.paths[1]);
    return result;
}

static void tell_totals(const int totals[OUTCOME_COUNT], const char *const folders[2])
{
    static const char *const words[OUTCOME_COUNT] = { "identical", "accepted", "different",
                                                      "only in",   "only in",  "not compared" };
    int all = 0, told = 0;
    for (int i = 0; i < OUTCOME_COUNT; i++)
        all += totals[i];
    printf("%d picture%s:", all, all == 1 ? "" : "s");
    for (int i = 0; i < OUTCOME_COUNT; i++) {
        bool is_lonely = i == ONLY_FIRST || i == ONLY_SECOND;
        if (totals[i] > 0)
            printf("%s %d %s%s%s", told++ > 0 ? "," : "", totals[i], words[i], is_lonely ? " " : "",
                   is_lonely ? folders[i == ONLY_SECOND] : "");
    }
    putchar('\n');
}

int lom_compare_folders(const char *const folders[2], const struct lom_compare_values *values)
{
    lom_error error = { .code = LOM_OK };
    struct names names = { .items = NULL };
    int totals[OUTCOME_COUNT] = { 0 };
    bool listed = add_folder(&names, 0, folders[0], "", 0, &error) &&
                  add_folder(&names, 1, folders[1], "", 0, &error) &&
                  (names.count > 0 ||
                   lom_fail(&error, LOM_ERROR_INPUT, "neither %s nor %s holds a picture.", folders[0], folders[1]));
    if (!listed) {
        drop_names(&names);
        return lom_complain_error(&error);
    }
    qsort(names.items, names.count, sizeof *names.items, order_names);
    for (size_t i = 0; i < names.count; i++) {
        const struct name *name = &names.items[i];
        if (i + 1 < names.count && strcmp(name->text, name[1].text) == 0) {
            totals[compare_pair(name->text, folders, values)]++;
            i++;
        } else {
            tell_lonely(name, folders, values);
            totals[name->folder == 0 ? ONLY_FIRST : ONLY_SECOND]++;
        }
    }
    if (!values->quiet && !values->json)
        tell_totals(totals, folders);
    drop_names(&names);
    if (totals[UNREADABLE] > 0)
        return LOM_EXIT_FAILED;
    return totals[DIFFERENT] + totals[ONLY_FIRST] + totals[ONLY_SECOND] > 0 ? LOM_EXIT_DIFFERS : LOM_EXIT_DONE;
}
