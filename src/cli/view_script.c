/* Scripts of `lom view`. In: lines "FRAME COMMAND WORD...". Out: events, hashes, pictures. Invariant: a script gives the
 * same lines every time, since its clock counts frames. */
#include "view_script.h"

#include <string.h>

enum { MAX_LINES = 65536, MAX_WORDS = 6, MAX_SCRIPT = 1 << 22, FRAMES_PER_SECOND = 60 };

struct line;

struct command {
    const char *name, *words, *text;
    bool (*run)(struct lom_view *view, const struct line *line, lom_error *error);
    bool asks; /* after the frame has been drawn */
};

struct line {
    int frame;
    const struct command *command;
    const char *word; /* a key or a file */
    int number[4];
};

struct lom_script {
    size_t count, next; /* the line that is played next */
    int frame;          /* that is played next */
    struct line *lines;
    lom_bytes text; /* words point into it */
};

/* ---- events ---- */

static bool send(struct lom_view *view, enum lom_view_event_kind kind, int key, int x, int y)
{
    lom_take_view_event(view, &(struct lom_view_event){ kind, key, x, y });
    return true;
}

static bool press(struct lom_view *view, const struct line *line, lom_error *error)
{
    (void)error;
    return send(view, LOM_VIEW_PRESS, lom_find_view_key(line->word), 0, 0);
}

static bool let_go_of(struct lom_view *view, const struct line *line, lom_error *error)
{
    (void)error;
    return send(view, LOM_VIEW_RELEASE, lom_find_view_key(line->word), 0, 0);
}

static bool tap(struct lom_view *view, const struct line *line, lom_error *error)
{
    return press(view, line, error) && let_go_of(view, line, error);
}

static bool click(struct lom_view *view, const struct line *line, lom_error *error)
{
    (void)error;
    return send(view, LOM_VIEW_BUTTON, 0, line->number[0], line->number[1]) &&
           send(view, LOM_VIEW_LET_GO, 0, line->number[0], line->number[1]);
}

static bool drag(struct lom_view *view, const struct line *line, lom_error *error)
{
    (void)error;
    return send(view, LOM_VIEW_BUTTON, 0, line->number[0], line->number[1]) &&
           send(view, LOM_VIEW_POINT, 0, line->number[2], line->number[3]) &&
           send(view, LOM_VIEW_LET_GO, 0, line->number[2], line->number[3]);
}

static bool turn_wheel(struct lom_view *view, const struct line *line, lom_error *error)
{
    (void)error;
    return send(view, LOM_VIEW_WHEEL, 0, 0, line->number[0]);
}

static bool resize(struct lom_view *view, const struct line *line, lom_error *error)
{
    if (line->number[0] < 1 || line->number[1] < 1 || line->number[0] > 8192 || line->number[1] > 8192)
        return lom_fail(error, LOM_ERROR_INPUT, "a window has from 1x1 to 8192x8192 pixels, not %dx%d.",
                        line->number[0], line->number[1]);
    return send(view, LOM_VIEW_RESIZE, 0, line->number[0], line->number[1]);
}

static bool set_cost(struct lom_view *view, const struct line *line, lom_error *error)
{
    (void)error;
    view->cost = line->number[0];
    return true;
}

/* ---- questions ---- */

static bool tell_hash(struct lom_view *view, const struct line *line, lom_error *error)
{
    lom_image *image = lom_view_image(view, error);
    if (image == NULL)
        return false;
    printf("%016llx  frame %d %dx%d%s\n", (unsigned long long)lom_hash_image(image), line->frame, image->width,
           image->height, view->is_exact ? "" : " moving");
    lom_free_image(image);
    return true;
}

static bool tell_command(struct lom_view *view, const struct line *line, lom_error *error)
{
    (void)line;
    char *command = lom_view_command(view, error);
    if (command != NULL)
        printf("%s\n", command);
    lom_release(command);
    return command != NULL;
}

static bool tell_message(struct lom_view *view, const struct line *line, lom_error *error)
{
    (void)error;
    printf("frame %d: %s\n", line->frame, view->message);
    return true;
}

/* What the window shows, text and all. */
static bool write_window(struct lom_view *view, const struct line *line, lom_error *error)
{
    lom_image *image = lom_create_image(view->width, view->height, 1, LOM_FORMAT_RGB8, error);
    uint8_t *pixels = lom_allocate((size_t)view->width * (size_t)view->height, 4, error);
    int red = view->host.order == LOM_ORDER_BGRX ? 2 : 0;
    bool done = image != NULL && pixels != NULL;
    if (done)
        lom_paint_view(view, pixels, 4 * (size_t)view->width);
    for (size_t i = 0; done && i < (size_t)view->width * (size_t)view->height; i++)
        for (int c = 0; c < 3; c++)
            image->pixels[3 * i + (size_t)c] = pixels[4 * i + (size_t)(c == 1 ? 1 : c == 0 ? red : 2 - red)];
    done = done && lom_write_image(line->word, NULL, image, error);
    lom_release(pixels);
    lom_free_image(image);
    return done;
}

/* ---- lines ---- */

/* K: a key, F: a file, N: an integer. */
static const struct command commands[] = {
    { "press", "K", "a key goes down, and is held", press, false },
    { "release", "K", "it goes up", let_go_of, false },
    { "key", "K", "both", tap, false },
    { "click", "NN", "X Y: the mouse's button there", click, false },
    { "drag", "NNNN", "X Y X Y: from there to there with the button held", drag, false },
    { "wheel", "N", "notches, away from the user", turn_wheel, false },
    { "size", "NN", "W H: of the window", resize, false },
    { "cost", "N", "milliseconds that a whole picture is taken to need", set_cost, false },
    { "hash", "", "print the hash of the picture, its frame and size, and \"moving\" when it is not exact", tell_hash,
      true },
    { "command", "", "print the `lom render` that draws it", tell_command, true },
    { "message", "", "print the sentence on it", tell_message, true },
    { "window", "F", "write what the window shows, text and all", write_window, true },
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

void lom_print_script_help(FILE *out)
{
    fputs("\nlines of a script: FRAME (of 60 a second, from 0 on, never falling), one of these, its words:\n", out);
    for (size_t i = 0; i < COMMANDS; i++)
        fprintf(out, "  %-10s%s\n", commands[i].name, commands[i].text);
}

static bool read_number(const char *word, int *value)
{
    size_t length = strlen(word), digits = strspn(word + (word[0] == '-'), "0123456789");
    return digits > 0 && digits < 9 && length == digits + (word[0] == '-') && sscanf(word, "%d", value) == 1;
}

static const struct command *find_command(const char *name)
{
    for (size_t i = 0; i < COMMANDS; i++)
        if (strcmp(commands[i].name, name) == 0)
            return &commands[i];
    return NULL;
}

/* Cuts a line into words; how many. */
static int cut(char *text, char *words[MAX_WORDS])
{
    int count = 0;
    for (char *at = text; *at != '\0' && *at != '#' && count < MAX_WORDS;) {
        at += strspn(at, " \t\r");
        if (*at == '\0' || *at == '#')
            break;
        words[count++] = at;
        at += strcspn(at, " \t\r");
        if (*at != '\0')
            *at++ = '\0';
    }
    return count;
}

static bool read_words(char *const *words, int count, struct line *line, const char **what)
{
    line->command = count > 1 ? find_command(words[1]) : NULL;
    if (!read_number(words[0], &line->frame) || line->frame < 0)
        *what = "a line begins with the number of a frame";
    else if (line->command == NULL)
        *what = "there is no such command; `lom view --help` lists them";
    else if (count - 2 != (int)strlen(line->command->words))
        *what = "the command takes another number of words";
    for (int i = 0; *what == NULL && i < count - 2; i++) {
        const char kind = line->command->words[i];
        line->word = words[2];
        if (kind == 'N' && !read_number(words[2 + i], &line->number[i]))
            *what = "an integer is missing";
        else if (kind == 'K' && lom_find_view_key(words[2 + i]) == 0)
            *what = "there is no such key";
    }
    return *what == NULL;
}

static bool read_lines(struct lom_script *script, const char *path, lom_error *error)
{
    char *at = (char *)script->text.data, *words[MAX_WORDS];
    int before = 0;
    for (int number = 1; at != NULL && *at != '\0'; number++) {
        char *end = strchr(at, '\n');
        if (end != NULL)
            *end = '\0';
        int count = cut(at, words);
        at = end != NULL ? end + 1 : NULL;
        if (count == 0)
            continue;
        struct line line = { .frame = 0 };
        const char *what = script->count == MAX_LINES ? "a script has 65536 lines at most" : NULL;
        if (what == NULL && read_words(words, count, &line, &what) && line.frame < before)
            what = "its frame comes before that of the line before";
        if (what != NULL)
            return lom_fail(error, LOM_ERROR_INPUT, "%s:%d: %s.", path, number, what);
        before = line.frame;
        script->lines[script->count++] = line;
    }
    return true;
}

struct lom_script *lom_read_script(const char *path, lom_error *error)
{
    struct lom_script *script = lom_allocate(1, sizeof *script, error);
    if (script == NULL)
        return NULL;
    script->text = lom_read_file(path, MAX_SCRIPT, error);
    script->lines = script->text.data != NULL ? lom_allocate(MAX_LINES, sizeof *script->lines, error) : NULL;
    if (script->lines != NULL && read_lines(script, path, error))
        return script;
    lom_free_script(script);
    return NULL;
}

void lom_free_script(struct lom_script *script)
{
    if (script == NULL)
        return;
    lom_release(script->text.data);
    lom_release(script->lines);
    lom_release(script);
}

/* The lines of this frame that ask, or that do not. */
static bool run_lines(const struct lom_script *script, bool asks, struct lom_view *view, lom_error *error)
{
    for (size_t i = script->next; i < script->count && script->lines[i].frame == script->frame; i++)
        if (script->lines[i].command->asks == asks && !script->lines[i].command->run(view, &script->lines[i], error))
            return false;
    return true;
}

bool lom_play_script(struct lom_script *script, struct lom_view *view, lom_error *error)
{
    if (!run_lines(script, false, view, error))
        return false;
    lom_step_view(view, script->frame == 0 ? 0 : 1.0 / FRAMES_PER_SECOND);
    lom_draw_view(view);
    if (!run_lines(script, true, view, error))
        return false;
    fflush(stdout);
    while (script->next < script->count && script->lines[script->next].frame == script->frame)
        script->next++;
    script->frame++;
    view->ends = view->ends || script->next == script->count;
    return true;
}
