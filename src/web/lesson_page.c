/* What a lesson's page asks its program: PROGRAM COMMAND OUT [NUMBER]... In: one of the commands below; PICTURE are the
 * numbers that `draw` says. Out: files beside the lesson's own output; exit status 0, or 2 with a sentence.
 *   draw OUT                    OUT.png, the lesson's picture, and OUT.json: its hash, its size, PICTURE
 *   steps OUT PICTURE           OUT.json: the steps, each with its text, the arguments and the file of its picture
 *   moment OUT N PICTURE        OUT.png: the picture after N triangles, or stores
 *   views OUT PICTURE           OUT-STAGE.png: what the stages made of it
 *   explain OUT X Y PICTURE     OUT.txt: what happened to a pixel
 * Invariant: each of them runs the lesson from its beginning, so that what is shown is what it did. */
#include "web/lesson_page.h"
#include "cli/explain_output.h"
#include "cli/json.h"
#include "inspect/verdict.h"

#include <stdlib.h>

int lom_lesson_main(int argc, char **argv);

enum { MOMENTS = 32, PICTURE_NUMBERS = 5, LONGEST_PATH = 256 };

/* Calls and stores have no place for it: it is the one variable of this program. */
static lom_lesson_run *current;

lom_lesson_run *lom_current_lesson(void)
{
    return current;
}

int lom_run_lesson(lom_lesson_run *run, const char *path)
{
    char *arguments[] = { (char *)(uintptr_t)run->name, (char *)(uintptr_t)path, NULL };
    run->textures = run->passes = run->draws = 0;
    run->images = run->visits = 0;
    run->triangles = run->stores = 0;
    run->within = false;
    current = run;
    int status = lom_lesson_main(2, arguments);
    current = NULL;
    return status;
}

/* ---- files ---- */

static const char *path_of(const lom_lesson_run *run, const char *ending, char path[LONGEST_PATH])
{
    snprintf(path, LONGEST_PATH, "%.200s%s", run->out, ending);
    return path;
}

bool lom_write_lesson_picture(const char *path, const lom_image *picture)
{
    lom_error error = { .code = LOM_OK };
    lom_image *shown = __real_lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, &error);
    bool done = shown != NULL && __real_lom_write_image(path, NULL, shown, &error);
    lom_free_image(shown);
    if (!done)
        fprintf(stderr, "%s\n", error.text);
    return done;
}

void lom_end_lesson_with(const lom_lesson_run *run, const lom_image *picture)
{
    char path[LONGEST_PATH];
    current = NULL;
    exit(picture != NULL && lom_write_lesson_picture(path_of(run, ".png", path), picture) ? 0 : 2);
}

/* A file of text, written as a whole when it is complete. */
struct text {
    FILE *out;
    char *bytes;
    size_t size;
};

static bool begin_text(struct text *text)
{
    text->out = open_memstream(&text->bytes, &text->size);
    if (text->out == NULL)
        fputs("The system gave no memory for the text.\n", stderr);
    return text->out != NULL;
}

static bool end_text(const lom_lesson_run *run, const char *ending, struct text *text)
{
    char path[LONGEST_PATH];
    lom_error error = { .code = LOM_OK };
    bool done = fclose(text->out) == 0 && lom_write_file(path_of(run, ending, path), text->bytes, text->size, &error);
    free(text->bytes);
    if (!done)
        fprintf(stderr, "%s\n", error.text);
    return done;
}

/* ---- commands ---- */

static int draw(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    int status = lom_run_lesson(run, path_of(run, ".png", path));
    lom_image *picture = status == 0 ? lom_read_image(path, NULL) : NULL;
    struct text text;
    bool done = picture != NULL && begin_text(&text);
    if (done) {
        const struct lom_lesson_picture *s = &run->source;
        const int64_t numbers[] = { s->created, s->created > 0 ? 0 : (int64_t)s->address, s->width, s->height,
                                    (int64_t)s->format };
        lom_json json = lom_json_begin(text.out);
        lom_json_hash(&json, "hash", lom_hash_image(picture));
        lom_json_integer(&json, "width", picture->width);
        lom_json_integer(&json, "height", picture->height);
        lom_json_integers(&json, "picture", numbers, PICTURE_NUMBERS);
        lom_json_end(&json);
        done = end_text(run, ".json", &text);
    }
    lom_free_image(picture);
    return done ? 0 : 2;
}

static void add_step(lom_json *json, const char *command, const char *file, const char *text, uint64_t moment)
{
    lom_json_nest(json, NULL, '{');
    lom_json_text(json, "text", text);
    lom_json_text(json, "command", command);
    if (strcmp(command, "moment") == 0)
        lom_json_integer(json, "moment", (int64_t)moment);
    lom_json_text(json, "file", file);
    lom_json_unnest(json, '}');
}

static void add_moment(lom_json *json, uint64_t moment, const char *text)
{
    char file[64];
    snprintf(file, sizeof file, "-%llu", (unsigned long long)moment);
    add_step(json, "moment", file, text, moment);
}

static void list_stores(lom_json *json, const lom_lesson_run *run)
{
    for (uint64_t i = 0; i < MOMENTS && run->stores >= MOMENTS; i++) {
        char text[128];
        uint64_t moment = run->stores * i / MOMENTS;
        snprintf(text, sizeof text, "after %llu of %llu stores into the picture", (unsigned long long)moment,
                 (unsigned long long)run->stores);
        add_moment(json, moment, text);
    }
}

/* The end of every draw, and between them even shares of all triangles. */
static void list_triangles(lom_json *json, const lom_lesson_run *run)
{
    uint64_t share = run->triangles / MOMENTS + 1, before = 0;
    for (int i = 0; i < run->draws; i++) {
        const struct lom_lesson_draw *d = &run->draw[i];
        for (uint64_t within = 0; within < d->triangles;) {
            char text[256];
            within = within + share < d->triangles ? within + share : d->triangles;
            snprintf(text, sizeof text, "pass %d of %d, draw %d by the shader %.100s: %llu of %llu triangles",
                     d->pass + 1, run->passes, d->number, d->shader, (unsigned long long)within,
                     (unsigned long long)d->triangles);
            add_moment(json, before + within, text);
        }
        before += d->triangles;
    }
    const char *text, *name;
    for (int i = 0; (name = lom_lesson_view(i, &text)) != NULL; i++) {
        char file[64];
        snprintf(file, sizeof file, "-%s", name);
        add_step(json, "views", file, text, 0);
    }
}

static int list_steps(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    struct text text;
    if (lom_run_lesson(run, path_of(run, ".png", path)) != 0 || !begin_text(&text))
        return 2;
    lom_json json = lom_json_begin(text.out);
    lom_json_nest(&json, "steps", '[');
    if (run->picture.width > 0)
        list_stores(&json, run);
    else
        list_triangles(&json, run);
    add_step(&json, "draw", "", "the picture that is written", 0);
    lom_json_unnest(&json, ']');
    lom_json_end(&json);
    return end_text(run, ".json", &text) ? 0 : 2;
}

/* The lesson runs to the moment, which ends the program; behind all of them it is the whole picture. */
static int draw_moment(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    return lom_run_lesson(run, path_of(run, ".png", path));
}

/* Which texture the picture is, the n-th that is made, is known behind a first run. */
static bool find_picture(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    bool done = lom_run_lesson(run, path_of(run, ".png", path)) == 0 && run->read >= 0;
    run->watched = run->read;
    if (!done)
        fprintf(stderr, "%s: its picture was not read from a texture.\n", run->name);
    return done;
}

static int draw_views(lom_lesson_run *run)
{
    return find_picture(run) && lom_write_lesson_views(run, run->out) ? 0 : 2;
}

static void explain_texel(lom_lesson_run *run, const lom_image *picture)
{
    lom_error error = { .code = LOM_OK };
    lom_explanation *explanation = lom_allocate(1, sizeof *explanation, &error);
    struct text text;
    if (explanation != NULL && begin_text(&text)) {
        lom_image pixel = { 1, 1, 1, picture->format, lom_image_pixel(picture, run->x, run->y, 0) };
        explanation->frame.image = &pixel;
        explanation->width = picture->width;
        explanation->height = picture->height;
        explanation->count = 1;
        explanation->item[0] = (lom_explained){ .texture = run->texture[run->watched],
                                                .name = "picture",
                                                .x = run->x,
                                                .y = run->y,
                                                .record = lom_watched_pixel(run->device, 0, run->x, run->y) };
        lom_find_verdict(&explanation->item[0]);
        lom_print_explanation(text.out, &(struct lom_explain_head){ run->name, 0, explanation });
        end_text(run, ".txt", &text);
    }
    lom_release(explanation);
}

/* What the file holds where the lesson stored. */
static void print_codes(FILE *out, const char *path, int x, int y)
{
    lom_image *picture = lom_read_image(path, NULL);
    for (int c = 0; picture != NULL && c < lom_describe_format(picture->format)->channels; c++)
        fprintf(out, " %d", ((const uint8_t *)lom_image_pixel(picture, x, y, 0))[c]);
    lom_free_image(picture);
}

/* The file is written behind the run, so that its memory is where it is in every other. */
static int explain_stores(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    if (run->x >= run->picture.width || run->y >= run->picture.height) {
        fprintf(stderr, "%s: no pixel %d,%d.\n", run->name, run->x, run->y);
        return 2;
    }
    int status = lom_run_lesson(run, path_of(run, ".png", path));
    struct text text;
    if (status != 0 || !begin_text(&text))
        return 2;
    fprintf(text.out, "pixel %d,%d of %s, %dx%d:", run->x, run->y, run->name, run->picture.width, run->picture.height);
    print_codes(text.out, path, run->x, run->y);
    fputs("\n", text.out);
    lom_tell_stores(run, text.out);
    return end_text(run, ".txt", &text) ? 0 : 2;
}

static int explain(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    if (run->picture.width > 0)
        return explain_stores(run);
    if (!find_picture(run))
        return 2;
    run->watch = (lom_rect){ run->x, run->y, 1, 1 };
    run->look = explain_texel;
    return lom_run_lesson(run, path_of(run, ".png", path));
}

static const struct command {
    const char *name;
    int numbers; /* of its own, before the picture's */
    bool has_picture;
    int (*run)(lom_lesson_run *run);
} commands[] = { { "draw", 0, false, draw },
                 { "steps", 0, true, list_steps },
                 { "moment", 1, true, draw_moment },
                 { "views", 0, true, draw_views },
                 { "explain", 2, true, explain } };

static bool read_numbers(const char *const *texts, int count, uint64_t *numbers)
{
    for (int i = 0; i < count; i++) {
        char *end;
        numbers[i] = strtoull(texts[i], &end, 10);
        if (texts[i][0] < '0' || texts[i][0] > '9' || *end != '\0')
            return false;
    }
    return true;
}

int main(int argc, char **argv)
{
    uint64_t n[2 + PICTURE_NUMBERS] = { 0 };
    const char *slash = argc > 0 ? strrchr(argv[0], '/') : NULL, *name = slash != NULL ? slash + 1 : argv[0];
    for (size_t i = 0; i < sizeof commands / sizeof commands[0] && argc >= 3; i++) {
        const struct command *c = &commands[i];
        int count = c->numbers + (c->has_picture ? PICTURE_NUMBERS : 0);
        if (strcmp(argv[1], c->name) != 0 || argc != 3 + count ||
            !read_numbers((const char *const *)argv + 3, count, n))
            continue;
        const uint64_t *p = n + c->numbers;
        lom_lesson_run run = { .name = name, .out = argv[2], .watched = -1, .read = -1 };
        if (c->has_picture)
            run.picture = (struct lom_lesson_picture){ (int)p[0], p[1], (int)p[2], (int)p[3], (lom_format)p[4] };
        run.moment = c->run == draw_moment ? n[0] : UINT64_MAX;
        run.x = c->run == explain ? (int)n[0] : -1;
        run.y = c->run == explain ? (int)n[1] : 0;
        if (c->run == explain && (n[0] >= LOM_MAX_SIZE || n[1] >= LOM_MAX_SIZE))
            break;
        return c->run(&run);
    }
    fprintf(stderr,
            "usage: %s draw OUT | steps OUT PICTURE | moment OUT N PICTURE | views OUT PICTURE | "
            "explain OUT X Y PICTURE; PICTURE: five numbers\n",
            name);
    return 2;
}
