/* What a lesson's page asks its program: PROGRAM COMMAND OUT [NUMBER]... In: one of the commands below; PICTURE are the
 * numbers that `draw` says. Out: files beside the lesson's own output; exit status 0, or 2 with a sentence.
 *   draw OUT                    OUT.png, the lesson's picture, and OUT.json: its hash, its size, PICTURE
 *   steps OUT PICTURE           OUT.json: the steps, each with its text, the arguments and the file of its picture
 *   moment OUT N PICTURE        OUT.png: the picture after N triangles, or stores
 *   stages OUT PICTURE          OUT-NAME.png: what each stage made of the last pass; OUT.json: what they show
 *   explain OUT X Y PICTURE     OUT.txt: what happened to a pixel
 * Invariant: each of them runs the lesson from its beginning, so that what is shown is what it did. */
#include "web/lesson_page.h"
#include "cli/explain_output.h"
#include "cli/json.h"
#include "cli/page.h"
#include "cli/steps_page.h"

#include <stdlib.h>

int lom_lesson_main(int argc, char **argv);

enum { MOMENTS = 32, PICTURE_NUMBERS = 5, LONGEST_PATH = 256, FOLLOWED = 3 };

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

/* A file of text, when it is complete. */
static bool write_text(const lom_lesson_run *run, const char *ending, struct lom_page *text)
{
    char path[LONGEST_PATH];
    lom_error error = { .code = LOM_OK };
    lom_bytes bytes = lom_end_page(text, &error);
    bool done = bytes.data != NULL && lom_write_file(path_of(run, ending, path), bytes.data, bytes.size, &error);
    lom_release(bytes.data);
    if (!done)
        fprintf(stderr, "%s\n", error.text);
    return done;
}

/* ---- commands ---- */

static int draw(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    struct lom_page text = { .out = NULL };
    int status = lom_run_lesson(run, path_of(run, ".png", path));
    lom_image *picture = status == 0 ? lom_read_image(path, NULL) : NULL;
    if (picture != NULL)
        lom_begin_page(&text);
    if (text.out != NULL) {
        const struct lom_lesson_picture *s = &run->source;
        const int64_t numbers[] = { s->created, s->created > 0 ? 0 : (int64_t)s->address, s->width, s->height,
                                    (int64_t)s->format };
        lom_json json = lom_json_begin(text.out);
        lom_json_hash(&json, "hash", lom_hash_image(picture));
        lom_json_integer(&json, "width", picture->width);
        lom_json_integer(&json, "height", picture->height);
        lom_json_integers(&json, "picture", numbers, PICTURE_NUMBERS);
        lom_json_end(&json);
    }
    lom_free_image(picture);
    return text.out != NULL && write_text(run, ".json", &text) ? 0 : 2;
}

static void add_moment(lom_json *json, uint64_t moment, const char *title, const char *text)
{
    char file[64];
    snprintf(file, sizeof file, "-%llu.png", (unsigned long long)moment);
    lom_json_nest(json, NULL, '{');
    lom_json_text(json, "file", file);
    lom_json_text(json, "title", title);
    lom_json_text(json, "text", text);
    lom_json_integer(json, "moment", (int64_t)moment);
    lom_json_unnest(json, '}');
}

static void list_stores(lom_json *json, const lom_lesson_run *run)
{
    for (uint64_t i = 0; i < MOMENTS && run->stores >= MOMENTS; i++) {
        char text[128];
        uint64_t moment = run->stores * i / MOMENTS;
        snprintf(text, sizeof text, "After %llu of %llu stores into the picture.", (unsigned long long)moment,
                 (unsigned long long)run->stores);
        add_moment(json, moment, "The program computes its pixels", text);
    }
}

/* The end of every draw, and between them even shares of all triangles. */
static void list_triangles(lom_json *json, const lom_lesson_run *run)
{
    uint64_t share = run->triangles / MOMENTS + 1, before = 0;
    for (int i = 0; i < run->draws; i++) {
        const struct lom_lesson_draw *d = &run->draw[i];
        for (uint64_t within = 0; within < d->triangles;) {
            char title[64], text[256];
            within = within + share < d->triangles ? within + share : d->triangles;
            snprintf(title, sizeof title, "Triangles of the %s pass", lom_lesson_pass(d->pass));
            snprintf(text, sizeof text, "Draw %d by the shader %.100s: after %llu of %llu triangles. %d passes in all.",
                     d->number, d->shader, (unsigned long long)within, (unsigned long long)d->triangles, run->passes);
            add_moment(json, before + within, title, text);
        }
        before += d->triangles;
    }
}

static int list_steps(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    struct lom_page text = { .out = NULL };
    if (lom_run_lesson(run, path_of(run, ".png", path)) == 0)
        lom_begin_page(&text);
    if (text.out == NULL)
        return 2;
    lom_json json = lom_json_begin(text.out);
    lom_json_nest(&json, "steps", '[');
    (run->picture.width > 0 ? list_stores : list_triangles)(&json, run);
    lom_json_unnest(&json, ']');
    lom_json_end(&json);
    return write_text(run, ".json", &text) ? 0 : 2;
}

/* The lesson runs to the moment, which ends the program; behind all of them it is the whole picture. */
static int draw_moment(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    return lom_run_lesson(run, path_of(run, ".png", path));
}

/* ---- what a device draws: a drawing that is run again ---- */

static lom_image *draw_again(void *context, lom_error *error)
{
    lom_lesson_run *run = context;
    char path[LONGEST_PATH];
    if (lom_run_lesson(run, path_of(run, ".png", path)) == 0 && run->read != NULL)
        return __real_lom_read_texture(run->read, 0, 0, error);
    lom_fail(error, LOM_ERROR_USAGE, "The lesson %s drew nothing that was read from a texture.", run->name);
    return NULL;
}

/* Draws once, so that the device and its textures are there. */
static bool begin_drawing(lom_lesson_run *run, lom_drawing *drawing, lom_error *error)
{
    lom_image *image = draw_again(run, error);
    lom_free_image(image);
    *drawing = (lom_drawing){ run->device, run, draw_again };
    return image != NULL;
}

static int end_drawing(lom_lesson_run *run, bool done, const lom_error *error)
{
    if (error->code != LOM_OK)
        fprintf(stderr, "%s: %s\n", run->name, error->text);
    lom_close_device(run->device);
    return done && error->code == LOM_OK ? 0 : 2;
}

static bool write_stages(const lom_lesson_run *run, const lom_stage_pictures *pictures)
{
    struct lom_page text;
    bool done = true;
    lom_begin_page(&text);
    if (text.out == NULL)
        return false;
    lom_json json = lom_json_begin(text.out);
    lom_json_nest(&json, "steps", '[');
    for (size_t i = 0; i < pictures->count && done; i++) {
        char file[64], path[LONGEST_PATH];
        snprintf(file, sizeof file, "-%s.png", pictures->picture[i].name);
        lom_write_step(&json, file, &pictures->picture[i]);
        done = lom_write_lesson_picture(path_of(run, file, path), pictures->picture[i].image);
    }
    lom_json_unnest(&json, ']');
    lom_json_end(&json);
    return write_text(run, ".json", &text) && done;
}

/* Of the pass that ends the picture. */
static int picture_stages(lom_lesson_run *run)
{
    lom_error error = { .code = LOM_OK };
    lom_drawing drawing;
    lom_stage_pictures *pictures = NULL;
    if (begin_drawing(run, &drawing, &error))
        pictures = lom_picture_drawing(&drawing, lom_lesson_pass(run->passes - 1), &error);
    bool done = pictures != NULL && write_stages(run, pictures);
    lom_free_stage_pictures(pictures);
    return end_drawing(run, done, &error);
}

static int explain_texel(lom_lesson_run *run)
{
    lom_error error = { .code = LOM_OK };
    lom_drawing drawing;
    struct lom_page text = { .out = NULL };
    lom_explanation *explanation = NULL;
    if (begin_drawing(run, &drawing, &error))
        explanation = lom_explain_drawing(&drawing, run->read, run->x, run->y, FOLLOWED, &error);
    if (explanation != NULL)
        lom_begin_page(&text);
    if (text.out != NULL)
        lom_print_explanation(text.out, &(struct lom_explain_head){ run->name, 0, explanation });
    lom_free_drawing_explanation(&drawing, explanation);
    return end_drawing(run, text.out != NULL && write_text(run, ".txt", &text), &error);
}

/* ---- what the lesson stores ---- */

/* What the file holds where the lesson stored. */
static void print_codes(FILE *out, const char *path, int x, int y)
{
    lom_image *picture = lom_read_image(path, NULL);
    for (int c = 0; picture != NULL && c < lom_describe_format(picture->format)->channels; c++)
        fprintf(out, " %d", ((const uint8_t *)lom_image_pixel(picture, x, y, 0))[c]);
    lom_free_image(picture);
}

/* The file is written behind the run, so that its memory is where it is in every other. */
static int explain(lom_lesson_run *run)
{
    char path[LONGEST_PATH];
    struct lom_page text = { .out = NULL };
    if (run->picture.width == 0)
        return explain_texel(run);
    if (run->x >= run->picture.width || run->y >= run->picture.height) {
        fprintf(stderr, "%s: no pixel %d,%d.\n", run->name, run->x, run->y);
        return 2;
    }
    if (lom_run_lesson(run, path_of(run, ".png", path)) == 0)
        lom_begin_page(&text);
    if (text.out == NULL)
        return 2;
    fprintf(text.out, "pixel %d,%d of %s, %dx%d:", run->x, run->y, run->name, run->picture.width, run->picture.height);
    print_codes(text.out, path, run->x, run->y);
    fputs("\n", text.out);
    lom_tell_stores(run, text.out);
    return write_text(run, ".txt", &text) ? 0 : 2;
}

static const struct command {
    const char *name;
    int numbers; /* of its own, before the picture's */
    bool has_picture;
    int (*run)(lom_lesson_run *run);
} commands[] = { { "draw", 0, false, draw },
                 { "steps", 0, true, list_steps },
                 { "moment", 1, true, draw_moment },
                 { "stages", 0, true, picture_stages },
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
        lom_lesson_run run = { .name = name, .out = argv[2] };
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
            "usage: %s draw OUT | steps OUT PICTURE | moment OUT N PICTURE | stages OUT PICTURE | "
            "explain OUT X Y PICTURE; PICTURE: five numbers\n",
            name);
    return 2;
}
