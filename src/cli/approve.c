/* `lom approve`. In: a list of pictures that somebody has looked at, as the page of `lom verify` makes it. Out: their
 * hashes in the manifest. Invariant: a line of the manifest changes only from the hash that the list says it has; after an
 * error the manifest is as it was, and so is every other byte of it. */
#include "commands.h"
#include "verify.h"

#include <string.h>

enum { MOST_BYTES = 16 << 20 };

struct values {
    const char *manifest;
};

static const lom_option options[] = {
    { "manifest", 0, LOM_OPTION_TEXT, offsetof(struct values, manifest), "FILE", 0, 0,
      "the manifest, whatever the list calls it" },
};

static const lom_command_line line = {
    .name = "approve",
    .arguments = "LIST",
    .summary = "write the hashes of a list of approved pictures into their manifest",
    .details =
        "A line of LIST, which the page of lom verify --page makes: MANIFEST:LINE: OLD NEW, hashes of 16 digits;\n"
        "OLD is - where nobody had approved the picture. All lines are of one manifest. A line whose hash in\n"
        "the manifest is not OLD any more is refused, and nothing is written then. See docs/golden-tests.md.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = 1,
};

/* A line of the list. */
struct approved {
    int number; /* of the list's own line */
    int64_t line;
    bool was_approved, is_found; /* the manifest has such a line */
    uint64_t before, after;
};

struct list {
    const char *path;
    lom_bytes file;
    const char *manifest; /* as its first line says it */
    struct approved *items;
    int count;
};

/* Ends the last word of text, which is letters without a blank, and gives it; NULL where there is none. */
static char *take_last_word(char *text)
{
    char *end = text + strlen(text);
    while (end > text && strchr(" \t\r", end[-1]) != NULL)
        *--end = '\0';
    while (end > text && strchr(" \t", end[-1]) == NULL)
        end--;
    if (end == text)
        return NULL;
    end[-1] = '\0';
    return end;
}

/* "MANIFEST:LINE:" OLD NEW; the manifest's name may hold blanks and colons. */
static bool read_line(struct list *list, char *text, struct approved *item, lom_error *error)
{
    int64_t number[4];
    char *after = take_last_word(text), *before = after != NULL ? take_last_word(text) : NULL;
    size_t length = before != NULL ? strlen(text) : 0;
    while (length > 0 && strchr(" \t", text[length - 1]) != NULL)
        length--;
    bool is_whole = length > 0 && text[length - 1] == ':';
    if (is_whole)
        text[length - 1] = '\0';
    char *colon = is_whole ? strrchr(text, ':') : NULL;
    if (colon == NULL || colon == text || lom_match_integers("N", colon + 1, number) == 0 || number[0] < 1 ||
        !lom_read_golden_hash(after, &item->after) ||
        (strcmp(before, "-") != 0 && !lom_read_golden_hash(before, &item->before)))
        return lom_fail(error, LOM_ERROR_INPUT, "%s:%d: a line of the list is MANIFEST:LINE: OLD NEW.", list->path,
                        item->number);
    item->was_approved = strcmp(before, "-") != 0;
    item->line = number[0];
    *colon = '\0';
    if (list->manifest == NULL)
        list->manifest = text;
    return strcmp(list->manifest, text) == 0 ||
           lom_fail(error, LOM_ERROR_INPUT, "%s:%d: the list is of %s, and this line of %s; one at a time.", list->path,
                    item->number, list->manifest, text);
}

static bool read_list(struct list *list, lom_error *error)
{
    list->file = lom_read_file(list->path, MOST_BYTES, error);
    char *text = (char *)list->file.data;
    if (text == NULL)
        return false;
    if (strlen(text) != list->file.size)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: a list is text, and this holds a zero byte.", list->path);
    size_t most = 1;
    for (const char *p = text; (p = strchr(p, '\n')) != NULL; p++)
        most++;
    list->items = lom_allocate(most, sizeof *list->items, error);
    if (list->items == NULL)
        return false;
    for (int number = 1; text != NULL; number++) {
        char *end = strchr(text, '\n');
        if (end != NULL)
            *end = '\0';
        struct approved *item = &list->items[list->count];
        *item = (struct approved){ .number = number };
        bool says_something = text[strspn(text, " \t\r")] != '\0' && text[strspn(text, " \t")] != '#';
        if (says_something && !read_line(list, text, item, error))
            return false;
        list->count += says_something;
        text = end != NULL ? end + 1 : NULL;
    }
    return list->count > 0 || lom_fail(error, LOM_ERROR_INPUT, "%s: it approves no picture.", list->path);
}

/* The line of the list for a line of the manifest; of two the last one counts. */
static struct approved *find_approved(struct list *list, int line_number)
{
    struct approved *found = NULL;
    for (int i = 0; i < list->count; i++)
        if (list->items[i].line == line_number) {
            found = &list->items[i];
            found->is_found = true;
        }
    return found;
}

static bool approve_golden(const struct list *list, const struct approved *item, const struct lom_manifest *manifest,
                           const struct lom_golden *golden, struct lom_approval *approval, lom_error *error)
{
    if (golden->is_approved != item->was_approved || golden->expected != item->before)
        return lom_fail(error, LOM_ERROR_INPUT, "%s:%d: line %d of %s has another hash by now; verify it again.",
                        list->path, item->number, golden->number, manifest->path);
    lom_approve_golden(approval, manifest, golden, item->after);
    return true;
}

/* Every line of the list must have had its line of the manifest. */
static bool check_found(const struct list *list, const struct lom_manifest *manifest, lom_error *error)
{
    for (int i = 0; i < list->count; i++)
        if (!list->items[i].is_found)
            return lom_fail(error, LOM_ERROR_INPUT, "%s:%d: there is no picture on line %lld of %s.", list->path,
                            list->items[i].number, (long long)list->items[i].line, manifest->path);
    return true;
}

/* The manifest as the list wants it. */
static bool apply_list(struct list *list, const struct lom_manifest *manifest, struct lom_approval *approval,
                       int *count, lom_error *error)
{
    struct lom_manifest_place place;
    struct lom_golden golden;
    bool done = lom_begin_goldens(manifest, &place, error);
    while (done && lom_next_golden(manifest, &place, &golden)) {
        const struct approved *item = find_approved(list, golden.number);
        done = item == NULL || approve_golden(list, item, manifest, &golden, approval, error);
        *count += item != NULL;
    }
    lom_release(place.words);
    return done && check_found(list, manifest, error);
}

static int approve(struct list *list, const struct lom_manifest *manifest)
{
    lom_error error = { .code = LOM_OK };
    struct lom_approval approval = { .report = { .path = manifest->path } };
    int count = 0;
    bool done = lom_open_report(&approval.report);
    if (done && !apply_list(list, manifest, &approval, &count, &error))
        done = lom_complain_error(&error) == LOM_EXIT_DONE;
    done = done && lom_write_approval(&approval, manifest);
    lom_drop_report(&approval.report);
    if (done)
        printf("%s: %d picture%s approved\n", manifest->path, count, count == 1 ? "" : "s");
    return done ? LOM_EXIT_DONE : LOM_EXIT_FAILED;
}

int lom_command_approve(int argc, char **argv)
{
    struct values values = { .manifest = NULL };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    struct list list = { .path = arguments.items[0] };
    struct lom_manifest manifest = { .path = NULL };
    const char *path = NULL;
    bool done = read_list(&list, &error);
    if (done) {
        path = values.manifest != NULL ? values.manifest : list.manifest;
        done = strcmp(path, "-") != 0 ||
               lom_fail(&error, LOM_ERROR_USAGE, "approve: the manifest came from standard input: --manifest FILE.");
        done = done && lom_open_manifest(path, &manifest, &error);
    }
    status = done ? approve(&list, &manifest) : lom_complain_error(&error);
    lom_close_manifest(&manifest);
    lom_release(list.items);
    lom_release(list.file.data);
    return status;
}
