/* Parts of a run that many machines share: what one of them drew, in one file. part.c; which pieces those are, and drawing
 * them: shard.c; putting all together: join.c. */
#ifndef LOM_CLI_PART_H
#define LOM_CLI_PART_H

#include <lom/image.h>

/* What the parts of one run have in common, and which one it is. Frames are cut into `bands` of rows; the pieces of a run
 * are the bands of the first frame from the top, then those of the next. Part `shard` has those from
 * pieces * (shard - 1) / shards on, up to pieces * shard / shards. */
typedef struct lom_part_head {
    uint64_t job;           /* a hash of all that decides the pictures: parts of others do not fit */
    uint64_t shard, shards; /* 1 .. shards */
    uint64_t first, frames; /* of the run */
    uint64_t bands;         /* of a frame, 1 .. height */
    uint64_t width, height; /* of a picture: the frame, or its crop */
    uint64_t format;        /* lom_output_format */
    uint64_t transfer;      /* lom_transfer */
    uint64_t rate;          /* frames in 1000 seconds */
} lom_part_head;

/* The pieces of a part: from *begin up to *end. */
void lom_find_pieces(const lom_part_head *head, uint64_t *begin, uint64_t *end);
/* The rows of a band: from *begin up to *end. */
void lom_find_band(const lom_part_head *head, uint64_t band, int *begin, int *end);

/* ---- writing: the file is there when it is whole, or not at all ---- */

typedef struct lom_part_writer {
    lom_writer *writer;
    uint64_t hash; /* of what was written */
} lom_part_writer;

bool lom_open_part(lom_part_writer *part, const char *path, const lom_part_head *head, lom_error *error);
/* The next piece of the part, a picture of its rows. */
bool lom_append_piece(lom_part_writer *part, const lom_image *image, lom_error *error);
/* keep: it is whole. */
bool lom_end_part(lom_part_writer *part, bool keep, lom_error *error);

/* ---- reading ---- */

typedef struct lom_part {
    lom_part_head head;
    uint64_t hash; /* of all of the file */
    lom_bytes file;
    size_t at; /* the next piece */
} lom_part;

/* Reads a part and looks whether every byte of it is there and right; false (and the part is empty) when it is not. */
bool lom_read_part(const char *path, lom_part *part, lom_error *error);
/* Its next piece: a picture of `rows` rows; NULL when it is another. Freed with lom_free_image. */
lom_image *lom_read_piece(lom_part *part, const char *path, int rows, lom_error *error);
void lom_free_part(lom_part *part);

#endif
