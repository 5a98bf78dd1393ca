/* A share of a run. In: a scene, frames, I of N. Out: a part with the pieces that are this share's. Invariant: the pieces
 * and their pixels follow from the scene and the options alone, so parts of any machines, widths and threads fit together;
 * the part is there when it is whole, or not at all. */
#include "shard.h"

#include "frame_output.h"
#include "watch.h"

#include <string.h>

enum { MOST_FILE_BYTES = INT32_MAX };

/* ---- the job ---- */

static uint64_t hash_word(uint64_t hash, uint64_t word)
{
    uint8_t bytes[8];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (uint8_t)(word >> (8 * i));
    return lom_hash_bytes(hash, bytes, sizeof bytes);
}

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return lom_hash_bytes(hash, text, strlen(text) + 1);
}

/* What the files of the scene hold, wherever they lie here; one that is not there is an empty one. */
static uint64_t hash_files(uint64_t hash, const lom_scene *scene, const char *path)
{
    struct lom_watched *files = lom_allocate(1, sizeof *files, NULL);
    if (files == NULL)
        return hash;
    lom_watch_file(files, path);
    lom_watch_scene(files, scene);
    for (size_t i = 0; i < files->count; i++) {
        lom_bytes file = lom_read_file(files->path[i], MOST_FILE_BYTES, NULL);
        hash = lom_hash_bytes(hash_word(hash, file.size), file.data, file.size);
        lom_release(file.data);
    }
    lom_forget_watched(files);
    lom_release(files);
    return hash;
}

static uint64_t hash_job(const struct lom_shard *shard, const lom_scene *scene, const char *path,
                         const lom_part_head *head)
{
    const lom_option_integers *crop = &shard->options->crop;
    uint64_t hash = hash_word(LOM_HASH_START, LOM_PICTURE_VERSION);
    for (const uint64_t *word = &head->shards; word <= &head->rate; word++)
        hash = hash_word(hash, *word);
    hash = hash_word(hash, (uint64_t)scene->output.width << 32 | (uint32_t)scene->output.height);
    for (int i = 0; i < 4; i++)
        hash = hash_word(hash, crop->given ? (uint64_t)crop->value[i] : 0);
    for (int i = 0; i < 2; i++)
        hash = hash_word(hash, shard->options->size.given ? (uint64_t)shard->options->size.value[i] : 0);
    for (int i = 0; i < shard->options->set.count; i++)
        hash = hash_text(hash, shard->options->set.items[i]);
    return hash_files(hash, scene, path);
}

/* The rectangle of the frame that pictures show. */
static lom_rect find_area(const struct lom_shard *shard, const lom_scene *scene)
{
    lom_frame_desc desc = lom_frame_of_options(shard->options, shard->first);
    lom_rect area = { 0, 0, desc.width > 0 ? desc.width : scene->output.width,
                      desc.height > 0 ? desc.height : scene->output.height };
    return desc.crop.width > 0 ? desc.crop : area;
}

/* More shares than frames: each frame is cut into bands, so that there is a piece for every share. */
static lom_part_head find_head(const struct lom_shard *shard, const lom_scene *scene, const char *path)
{
    lom_rect area = find_area(shard, scene);
    uint64_t frames = (uint64_t)(shard->last - shard->first) + 1, shards = (uint64_t)shard->shards;
    uint64_t bands = (shards + frames - 1) / frames, height = (uint64_t)area.height;
    lom_part_head head = { .shard = (uint64_t)shard->shard,
                           .shards = shards,
                           .first = (uint64_t)shard->first,
                           .frames = frames,
                           .bands = bands < height ? bands : height,
                           .width = (uint64_t)area.width,
                           .height = height,
                           .format = (uint64_t)scene->output.format,
                           .transfer = (uint64_t)scene->output.transfer,
                           .rate = (uint64_t)lom_int_of(scene->output.fps * 1000 + 0.5) };
    head.job = hash_job(shard, scene, path, &head);
    return head;
}

/* What is drawn for a piece. */
static lom_frame_desc find_piece(const struct lom_shard *shard, const lom_scene *scene, const lom_part_head *head,
                                 uint64_t piece)
{
    lom_frame_desc desc = lom_frame_of_options(shard->options, shard->first + (int)(piece / head->bands));
    int begin, end;
    if (head->bands == 1)
        return desc;
    lom_find_band(head, piece % head->bands, &begin, &end);
    desc.crop = find_area(shard, scene);
    desc.crop.y += begin;
    desc.crop.height = end - begin;
    return desc;
}

/* ---- what can be refused ---- */

bool lom_check_shard(const struct lom_shard *shard, const lom_scene *scene, lom_error *error)
{
    if (shard->shard < 1 || shard->shard > shard->shards)
        return lom_fail(error, LOM_ERROR_USAGE, "--shard %d/%d: shares are numbered from 1 to %d.", shard->shard,
                        shard->shards, shard->shards);
    if (shard->last > shard->first && scene->quality.impostors != LOM_IMPOSTORS_OFF)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "--shard: with quality.impostors a frame depends on those before it, which another machine "
                        "draws; --set 'quality.impostors=\"off\"' draws each by itself.");
    if (shard->pattern == NULL || strcmp(shard->pattern, "-") == 0)
        return lom_fail(error, LOM_ERROR_USAGE, "--shard writes a part, so it needs -o FILE.");
    char *name = lom_name_frame(shard->pattern, shard->shard, error);
    lom_release(name);
    return name != NULL;
}

bool lom_find_part(const struct lom_shard *shard, const lom_scene *scene, const char *path, bool *done,
                   lom_error *error)
{
    *done = false;
    char *name = lom_name_frame(shard->pattern, shard->shard, error);
    lom_part part;
    if (name != NULL && shard->resume && lom_read_part(name, &part, NULL)) {
        lom_part_head head = find_head(shard, scene, path);
        *done = memcmp(&head, &part.head, sizeof head) == 0;
        lom_free_part(&part);
        if (*done && !shard->quiet)
            fprintf(stderr, "lom: %s is whole already.\n", name);
    }
    lom_release(name);
    return name != NULL;
}

/* ---- drawing ---- */

static bool draw_piece(const struct lom_shard *shard, const lom_scene *scene, const lom_part_head *head, uint64_t piece,
                       lom_renderer *renderer, lom_part_writer *part, lom_error *error)
{
    lom_frame_desc desc = find_piece(shard, scene, head, piece);
    lom_frame frame;
    if (!lom_render_frame(renderer, &desc, &frame, error))
        return false;
    bool done = lom_append_piece(part, frame.image, error);
    lom_free_image(frame.image);
    return done;
}

bool lom_draw_shard(const struct lom_shard *shard, const lom_scene *scene, const char *path, lom_renderer *renderer,
                    lom_error *error)
{
    lom_part_head head = find_head(shard, scene, path);
    uint64_t begin, end;
    lom_find_pieces(&head, &begin, &end);
    char *name = lom_name_frame(shard->pattern, shard->shard, error);
    lom_part_writer part;
    bool done = name != NULL && lom_open_part(&part, name, &head, error);
    lom_release(name);
    if (!done)
        return false;
    struct lom_progress bar = lom_begin_progress("lom render", (int)(end - begin), shard->quiet);
    for (uint64_t piece = begin; piece < end && done; piece++) {
        lom_show_progress(&bar, (double)(piece - begin), "pieces");
        done = draw_piece(shard, scene, &head, piece, renderer, &part, error);
    }
    lom_end_progress(&bar);
    return lom_end_part(&part, done, error) && done;
}
