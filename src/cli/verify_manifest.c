/* Manifests of golden pictures (docs/golden-tests.md). In: a text file. Out: its lines, one at a time, or an error with
 * file, line and column (bytes, from 1). Invariant: opening has read every line, so that a wrong one is found before
 * anything is drawn; the words of a line never need more room than the line. */
#include "verify.h"

#include "paths.h"

#include <stdarg.h>
#include <string.h>

enum { MOST_BYTES = 16 << 20 };

/* A line while it is read. */
struct reader {
    const struct lom_manifest *manifest;
    size_t begin, at; /* of the line, of the next byte */
    size_t word;      /* where the last word began */
    int number;
    char *out; /* the next word goes here */
    lom_error *error;
};

static bool refuse(const struct reader *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool refuse(const struct reader *r, const char *format, ...)
{
    char text[320];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return lom_fail(r->error, LOM_ERROR_INPUT, "%s:%d:%zu: %s", r->manifest->path, r->number, r->word - r->begin + 1,
                    text);
}

static bool is_blank(char letter)
{
    return letter == ' ' || letter == '\t' || letter == '\r';
}

/* The next word of the line, without the quotes that hold blanks and # in it; *word is NULL behind the last. */
static bool take_word(struct reader *r, const char **word)
{
    const char *text = (const char *)r->manifest->file.data;
    *word = NULL;
    while (is_blank(text[r->at]))
        r->at++;
    r->word = r->at;
    if (text[r->at] == '\0' || text[r->at] == '\n' || text[r->at] == '#')
        return true;
    *word = r->out;
    char quote = '\0';
    for (; text[r->at] != '\0' && text[r->at] != '\n' && (quote != '\0' || !is_blank(text[r->at])); r->at++) {
        char letter = text[r->at];
        if (quote == '\0' ? letter == '"' || letter == '\'' : letter == quote)
            quote = quote == '\0' ? letter : '\0';
        else
            *r->out++ = letter;
    }
    *r->out++ = '\0';
    return quote == '\0' || refuse(r, "the quote %c is not closed on its line.", quote);
}

/* ---- the words of a line ---- */

/* Options of `lom render` that say which picture it is; without a pattern: any word, may be repeated. */
static const struct {
    const char *name, *pattern;
    size_t field;
    int64_t minimum, maximum;
} options[] = {
    { "--size", "WxH", offsetof(struct lom_golden, options.size), 1, LOM_MAX_SIZE },
    { "--frame", "N", offsetof(struct lom_golden, frame), 0, 1000000000 },
    { "--crop", "X,Y,W,H", offsetof(struct lom_golden, options.crop), 0, LOM_MAX_SIZE },
    { "--set", NULL, offsetof(struct lom_golden, options.set), 0, 0 },
};
enum { OPTION_COUNT = sizeof options / sizeof options[0] };

static bool store(const struct reader *r, size_t option, const char *value, struct lom_golden *golden)
{
    const char *name = options[option].name, *pattern = options[option].pattern;
    void *field = (char *)golden + options[option].field;
    if (pattern == NULL) {
        lom_option_list *list = field;
        if (list->count == LOM_OPTION_LIST_MAX)
            return refuse(r, "more than %d times %s.", LOM_OPTION_LIST_MAX, name);
        list->items[list->count++] = value;
        return true;
    }
    lom_option_integers *integers = field;
    if (integers->given)
        return refuse(r, "%s is given twice.", name);
    int count = lom_match_integers(pattern, value, integers->value);
    if (count == 0)
        return refuse(r, "%s takes %s in whole numbers, not \"%s\".", name, pattern, value);
    for (int i = 0; i < count; i++)
        if (integers->value[i] < options[option].minimum || integers->value[i] > options[option].maximum)
            return refuse(r, "%s %s: whole numbers must be from %lld to %lld.", name, value,
                          (long long)options[option].minimum, (long long)options[option].maximum);
    integers->given = true;
    return true;
}

static bool refuse_option(const struct reader *r, const char *word)
{
    const char *names[OPTION_COUNT + 1] = { "flat" };
    for (size_t i = 0; i < OPTION_COUNT; i++)
        names[i + 1] = options[i].name;
    const char *near = lom_nearest_name(word, strcspn(word, "="), names, OPTION_COUNT + 1);
    if (near != NULL)
        return refuse(r, "no word of a manifest: \"%s\" (did you mean \"%s\"?).", word, near);
    return refuse(r, "no word of a manifest: \"%s\"; there are --size, --frame, --crop, --set and flat.", word);
}

static bool read_option(struct reader *r, const char *word, struct lom_golden *golden)
{
    size_t length = strcspn(word, "=");
    const char *value = word[length] == '=' ? word + length + 1 : NULL;
    if (strcmp(word, "flat") == 0) {
        golden->may_be_flat = true;
        return true;
    }
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        if (strlen(options[i].name) != length || memcmp(options[i].name, word, length) != 0)
            continue;
        if (value == NULL && !take_word(r, &value))
            return false;
        return value != NULL ? store(r, i, value, golden) : refuse(r, "%s needs a value.", options[i].name);
    }
    return refuse_option(r, word);
}

bool lom_read_golden_hash(const char *word, uint64_t *hash)
{
    static const char digits[] = "0123456789abcdef";
    *hash = 0;
    for (size_t i = 0; i < 16; i++) {
        const char *digit = word[i] != '\0' ? strchr(digits, word[i]) : NULL;
        if (digit == NULL)
            return false;
        *hash = *hash << 4 | (uint64_t)(digit - digits);
    }
    return word[16] == '\0';
}

static bool read_hash(const struct reader *r, const char *word, struct lom_golden *golden)
{
    golden->hash_at = r->word;
    golden->hash_size = r->at - r->word;
    golden->is_approved = strcmp(word, "-") != 0 || golden->hash_size != 1;
    return !golden->is_approved || (golden->hash_size == 16 && lom_read_golden_hash(word, &golden->expected)) ||
           refuse(r, "a line begins with a hash of 16 digits 0-9a-f, or - for none yet, not \"%s\".", word);
}

static bool read_golden(struct reader *r, const char *word, struct lom_golden *golden)
{
    *golden = (struct lom_golden){ .number = r->number };
    if (!read_hash(r, word, golden) || !take_word(r, &golden->scene))
        return false;
    if (golden->scene == NULL || golden->scene[0] == '\0')
        return refuse(r, "behind the hash stands the file of a scene.");
    size_t begin = r->word, end = r->at;
    for (;;) {
        if (!take_word(r, &word))
            return false;
        if (word == NULL)
            break;
        if (!read_option(r, word, golden))
            return false;
        end = r->at;
    }
    memcpy(r->out, r->manifest->file.data + begin, end - begin);
    r->out[end - begin] = '\0';
    golden->text = r->out;
    return true;
}

/* What the header says. */
struct header {
    int picture;
    char *pinned; /* a program: of the name that is found on PATH, or of a path */
};

/* The program that drew what is expected: a name without a slash is found on PATH, any other one from the manifest's
 * folder; where none is named it is lom-VERSION. */
static char *name_pinned(const struct lom_manifest *manifest, const char *version, const char *program,
                         lom_error *error)
{
    if (program == NULL)
        return lom_path_print(error, "lom-%s", version);
    if (strchr(program, '/') == NULL || program[0] == '/')
        return lom_path_print(error, "%s", program);
    return lom_path_print(error, "%s%.*s%s", manifest->folder == 0 ? "./" : "", manifest->folder, manifest->path,
                          program);
}

/* "by PROGRAM" or nothing, to the end of the header. */
static bool read_program(struct reader *r, const char **program)
{
    const char *by = NULL, *more = NULL;
    if (!take_word(r, &by))
        return false;
    if (by == NULL)
        return true;
    if (strcmp(by, "by") != 0)
        return refuse(r, "behind its number a header has nothing, or by PROGRAM.");
    if (!take_word(r, program))
        return false;
    if (*program == NULL || (*program)[0] == '\0')
        return refuse(r, "behind by stands the program that drew what is expected.");
    return take_word(r, &more) && (more == NULL || refuse(r, "the header ends behind its program."));
}

/* "lom VERSION picture N by PROGRAM", of which the first word has been read; header: NULL when it is known already. */
static bool read_header(struct reader *r, struct header *header)
{
    const char *version = NULL, *word = NULL, *number = NULL, *program = NULL;
    int64_t value[4];
    size_t begin = r->word;
    if (!take_word(r, &version) || !take_word(r, &word) || !take_word(r, &number))
        return false;
    if (number == NULL || strcmp(word, "picture") != 0 || lom_match_integers("N", number, value) == 0 || value[0] < 1 ||
        value[0] > 1000000) {
        r->word = begin;
        return refuse(r, "the header is \"lom VERSION picture N\", as in \"lom %s picture %d\".", LOM_VERSION,
                      LOM_PICTURE_VERSION);
    }
    if (!read_program(r, &program))
        return false;
    if (header == NULL)
        return true;
    header->picture = (int)value[0];
    header->pinned = name_pinned(r->manifest, version, program, r->error);
    return header->pinned != NULL;
}

/* ---- the file ---- */

/* The next line that names a picture; false at the end, and (with the error) where a line is wrong. */
static bool read_next(const struct lom_manifest *manifest, struct lom_manifest_place *place, struct lom_golden *golden,
                      struct header *header, lom_error *error)
{
    const char *text = (const char *)manifest->file.data;
    while (place->at < manifest->file.size) {
        struct reader r = { manifest, place->at, place->at, place->at, ++place->number, place->words, error };
        const char *word;
        if (!take_word(&r, &word))
            return false;
        bool is_header = word != NULL && !place->begun && strcmp(word, "lom") == 0;
        if (is_header && !read_header(&r, header))
            return false;
        if (word != NULL && !is_header && !read_golden(&r, word, golden))
            return false;
        place->begun = place->begun || word != NULL;
        place->at = r.at + strcspn(text + r.at, "\n");
        place->at += text[place->at] == '\n';
        if (word != NULL && !is_header)
            return true;
    }
    return false;
}

bool lom_begin_goldens(const struct lom_manifest *manifest, struct lom_manifest_place *place, lom_error *error)
{
    *place = (struct lom_manifest_place){ .words = lom_allocate(2 * manifest->file.size + 2, 1, error) };
    return place->words != NULL;
}

bool lom_next_golden(const struct lom_manifest *manifest, struct lom_manifest_place *place, struct lom_golden *golden)
{
    return read_next(manifest, place, golden, NULL, NULL);
}

/* Every line is read once, and counted. */
static bool read_all(struct lom_manifest *manifest, lom_error *error)
{
    struct lom_golden golden;
    struct lom_manifest_place place;
    struct header header = { .picture = 0 };
    lom_error found = { .code = LOM_OK };
    if (!lom_begin_goldens(manifest, &place, error))
        return false;
    while (read_next(manifest, &place, &golden, &header, &found))
        manifest->count++;
    lom_release(place.words);
    manifest->pinned = header.pinned;
    if (found.code != LOM_OK)
        return lom_fail(error, found.code, "%s", found.text);
    if (header.picture != 0 && header.picture != LOM_PICTURE_VERSION)
        fprintf(stderr, "lom: warning: %s is of picture version %d, this lom draws version %d: pictures may differ.\n",
                manifest->path, header.picture, LOM_PICTURE_VERSION);
    return true;
}

bool lom_open_manifest(const char *path, struct lom_manifest *manifest, lom_error *error)
{
    *manifest = (struct lom_manifest){ .path = path, .folder = (int)(lom_path_file(path) - path) };
    manifest->file = lom_read_file(path, MOST_BYTES, error);
    if (manifest->file.data == NULL)
        return false;
    if (strlen((const char *)manifest->file.data) != manifest->file.size)
        return lom_fail(error, LOM_ERROR_INPUT, "%s: a manifest is text, and this holds a zero byte.", path);
    return read_all(manifest, error) &&
           (manifest->count > 0 || lom_fail(error, LOM_ERROR_INPUT, "%s: it names no picture.", path));
}

void lom_close_manifest(struct lom_manifest *manifest)
{
    lom_release(manifest->pinned);
    lom_release(manifest->file.data);
}

/* ---- other hashes ---- */

static void copy_manifest(struct lom_approval *approval, const struct lom_manifest *manifest, size_t end)
{
    fwrite(manifest->file.data + approval->copied, 1, end - approval->copied, approval->report.out);
    approval->copied = end;
}

void lom_approve_golden(struct lom_approval *approval, const struct lom_manifest *manifest,
                        const struct lom_golden *golden, uint64_t hash)
{
    copy_manifest(approval, manifest, golden->hash_at);
    fprintf(approval->report.out, "%016llx", (unsigned long long)hash);
    approval->copied += golden->hash_size;
}

bool lom_write_approval(struct lom_approval *approval, const struct lom_manifest *manifest)
{
    copy_manifest(approval, manifest, manifest->file.size);
    return lom_write_report(&approval->report);
}
