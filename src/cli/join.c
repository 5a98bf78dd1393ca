/* `lom join`. In: the parts of a run, from any machines. Out: its pictures, or its video, as `lom render` alone writes
 * them. Invariant: nothing is written unless every part is there, whole, and of one job; parts of one share must be the
 * same bytes, wherever they were drawn. */
#include "commands.h"
#include "frame_output.h"
#include "options.h"
#include "part.h"
#include "picture_kinds.h"

#include "render/targets.h"

#include <string.h>

struct values {
    const char *output, *format;
    bool hash;
};

static const lom_option options[] = {
    { "output", 'o', LOM_OPTION_TEXT, offsetof(struct values, output), "OUT", 0, 0,
      "the picture; %04d in its name is the frame's number, %% one %; - is stdout" },
    { "format", 0, LOM_OPTION_CHOICE, offsetof(struct values, format), NULL, 0, 0,
      "the kind of picture, whatever the name ends in" },
    { "hash", 0, LOM_OPTION_FLAG, offsetof(struct values, hash), NULL, 0, 0, "print \"HASH  frame N\" for each frame" },
};

static const lom_command_line line = {
    .name = "join",
    .arguments = "PART...",
    .choice = lom_frame_choice,
    .summary = "put the parts together that lom render --shard I/N drew, on whatever machines",
    .details =
        "Writes what lom render SCENE -o OUT alone would have written, byte for byte. -o may be left out with\n"
        "--hash. Parts may come in any order, and more than once where they are the same. Exit status 1 when two\n"
        "parts of one share differ, 2 when a part is missing, not whole or of another run. See docs/many-machines.md.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 1,
    .maximum_arguments = -1,
};

/* The parts of a run: a path for each share. */
struct run {
    lom_part_head head; /* of the first; its shard is no matter */
    const char **paths; /* share 1 first; NULL: missing */
    uint64_t *hashes;
    bool differs;
};

/* ---- what there is ---- */

static bool begin_run(struct run *run, const lom_part_head *head, lom_error *error)
{
    run->head = *head;
    run->paths = lom_allocate((size_t)head->shards, sizeof *run->paths, error);
    run->hashes = lom_allocate((size_t)head->shards, sizeof *run->hashes, error);
    return run->paths != NULL && run->hashes != NULL;
}

static bool is_of_run(const struct run *run, lom_part_head head)
{
    head.shard = run->head.shard;
    return memcmp(&head, &run->head, sizeof head) == 0;
}

static bool add_part(struct run *run, const char *path, lom_error *error)
{
    lom_part part;
    if (!lom_read_part(path, &part, error))
        return false;
    lom_part_head head = part.head;
    uint64_t hash = part.hash;
    lom_free_part(&part);
    if (run->paths == NULL && !begin_run(run, &head, error))
        return false;
    if (!is_of_run(run, head))
        return lom_fail(error, LOM_ERROR_INPUT,
                        "%s is of another run than the parts before it: scene, its files, options, picture version "
                        "and N of --shard I/N must be the same.",
                        path);
    size_t share = (size_t)head.shard - 1;
    if (run->paths[share] != NULL && run->hashes[share] != hash) {
        run->differs = true;
        return lom_fail(error, LOM_ERROR_INPUT, "%s and %s are both share %zu and differ: one machine drew it wrongly.",
                        run->paths[share], path, share + 1);
    }
    run->paths[share] = path;
    run->hashes[share] = hash;
    return true;
}

/* Names the first shares that nobody drew. */
static bool check_complete(const struct run *run, lom_error *error)
{
    enum { NAMED = 20, LETTERS = 160 };
    char text[LETTERS] = "";
    size_t missing = 0, length = 0;
    for (size_t i = 0; i < run->head.shards; i++)
        if (run->paths[i] == NULL && missing++ < NAMED)
            length += (size_t)snprintf(text + length, LETTERS - length, "%s%zu", length > 0 ? ", " : "", i + 1);
    return missing == 0 || lom_fail(error, LOM_ERROR_INPUT, "of %llu shares %zu %s missing: %s%s.",
                                    (unsigned long long)run->head.shards, missing, missing == 1 ? "is" : "are", text,
                                    missing > NAMED ? " ..." : "");
}

/* ---- putting together ---- */

struct joining {
    const struct run *run;
    const struct values *values;
    struct lom_frame_output output;
    lom_image *frame; /* until its last band */
};

static bool end_frame(struct joining *joining, int number, lom_error *error)
{
    bool done = lom_write_frame(&joining->output, joining->frame, number, error);
    if (done && joining->values->hash)
        printf("%016llx  frame %d\n", (unsigned long long)lom_hash_image(joining->frame), number);
    lom_free_image(joining->frame);
    joining->frame = NULL;
    return done;
}

/* What lom_render_frame gives; files do not say whether their numbers are encoded. */
static lom_format format_of(const lom_part_head *head)
{
    const lom_output output = { .format = (lom_output_format)head->format, .transfer = (lom_transfer)head->transfer };
    return lom_format_of_output(&output);
}

/* Lays a piece into its frame. */
static bool add_piece(struct joining *joining, uint64_t piece, lom_part *part, const char *path, lom_error *error)
{
    const lom_part_head *head = &joining->run->head;
    lom_format format = format_of(head);
    int begin, end;
    lom_find_band(head, piece % head->bands, &begin, &end);
    lom_image *image = lom_read_piece(part, path, end - begin, error);
    if (image == NULL)
        return false;
    bool done = lom_reinterpret_image(image, format, error);
    if (done && joining->frame == NULL) {
        joining->frame = lom_create_image((int)head->width, (int)head->height, 1, format, error);
        done = joining->frame != NULL;
    }
    if (done)
        memcpy(lom_image_pixel(joining->frame, 0, begin, 0), image->pixels, lom_image_size(image));
    lom_free_image(image);
    return done && (piece % head->bands != head->bands - 1 ||
                    end_frame(joining, (int)(head->first + piece / head->bands), error));
}

/* The pieces of a share; the file may have changed since it was looked at. */
static bool join_share(struct joining *joining, size_t share, lom_error *error)
{
    const char *path = joining->run->paths[share];
    uint64_t begin, end;
    lom_part part;
    if (!lom_read_part(path, &part, error))
        return false;
    bool done = part.hash == joining->run->hashes[share] ||
                lom_fail(error, LOM_ERROR_INPUT, "%s has changed while it was read.", path);
    lom_find_pieces(&part.head, &begin, &end);
    for (uint64_t piece = begin; piece < end && done; piece++)
        done = add_piece(joining, piece, &part, path, error);
    lom_free_part(&part);
    return done;
}

static bool join(const struct run *run, const struct values *values, lom_error *error)
{
    const lom_part_head *head = &run->head;
    struct joining joining = { .run = run,
                               .values = values,
                               .output = { values->output, values->format, (double)head->rate / 1000, NULL } };
    if (!lom_check_frame_output(&joining.output, (lom_output_format)head->format, lom_int_of((double)head->frames),
                                error))
        return false;
    bool done = true;
    for (size_t share = 0; share < head->shards && done; share++)
        done = join_share(&joining, share, error);
    lom_free_image(joining.frame);
    return lom_end_frame_output(&joining.output, done, error) && done;
}

int lom_command_join(int argc, char **argv)
{
    struct values values = { .output = NULL };
    lom_arguments arguments;
    lom_error error = { .code = LOM_OK };
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (values.output == NULL && !values.hash)
        return lom_complain("join needs -o OUT or --hash.");
    if (values.hash && values.output != NULL && strcmp(values.output, "-") == 0)
        return lom_complain("join: -o - writes to standard output, and --hash does too.");
    struct run run = { .paths = NULL };
    bool done = true;
    for (int i = 0; i < arguments.count && done; i++)
        done = add_part(&run, arguments.items[i], &error);
    done = done && check_complete(&run, &error) && join(&run, &values, &error);
    lom_release(run.paths);
    lom_release(run.hashes);
    if (done)
        return LOM_EXIT_DONE;
    lom_complain_error(&error);
    return run.differs ? LOM_EXIT_DIFFERS : LOM_EXIT_FAILED;
}
