/* Files of parts. In: pictures of pieces. Out: "lom part", the head, for each piece its size and a PNG or PFM of it, a hash
 * of all that, every number in 8 bytes from the lowest on. Invariant: a file that was cut off, changed or never finished
 * is no part; nothing in it depends on the machine. */
#include "part.h"

#include "image/bytes.h"

#include <string.h>

enum { MAGIC_BYTES = 8, WORD_BYTES = 8, HEAD_WORDS = sizeof(lom_part_head) / sizeof(uint64_t) };
static const char magic[MAGIC_BYTES + 1] = "lom part";

#define MOST_FRAMES     UINT64_C(1000000001)
#define MOST_SHARDS     UINT64_C(1000000)
#define MOST_PART_BYTES (SIZE_MAX / 4)

/* The head's fields are its words, one after another. */
_Static_assert(sizeof(lom_part_head) == HEAD_WORDS * sizeof(uint64_t), "the head is words alone");

void lom_find_pieces(const lom_part_head *head, uint64_t *begin, uint64_t *end)
{
    uint64_t pieces = head->frames * head->bands; /* at most 2^30 * 2^15, times 2^20 shards below */
    *begin = pieces / head->shards * (head->shard - 1) + pieces % head->shards * (head->shard - 1) / head->shards;
    *end = pieces / head->shards * head->shard + pieces % head->shards * head->shard / head->shards;
}

void lom_find_band(const lom_part_head *head, uint64_t band, int *begin, int *end)
{
    *begin = (int)(head->height * band / head->bands);
    *end = (int)(head->height * (band + 1) / head->bands);
}

/* ---- writing ---- */

static bool append(lom_part_writer *part, const void *data, size_t size, lom_error *error)
{
    part->hash = lom_hash_bytes(part->hash, data, size);
    return lom_append(part->writer, data, size, error);
}

static bool append_word(lom_part_writer *part, uint64_t word, lom_error *error)
{
    uint8_t bytes[WORD_BYTES];
    store_64_little(bytes, word);
    return append(part, bytes, sizeof bytes, error);
}

bool lom_open_part(lom_part_writer *part, const char *path, const lom_part_head *head, lom_error *error)
{
    uint64_t words[HEAD_WORDS];
    *part = (lom_part_writer){ lom_open_writer(path, error), LOM_HASH_START };
    bool done = part->writer != NULL && append(part, magic, MAGIC_BYTES, error);
    memcpy(words, head, sizeof words);
    for (size_t i = 0; i < HEAD_WORDS && done; i++)
        done = append_word(part, words[i], error);
    if (!done)
        lom_end_part(part, false, error);
    return done;
}

bool lom_append_piece(lom_part_writer *part, const lom_image *image, lom_error *error)
{
    const char *kind = lom_describe_format(image->format)->is_float ? "pfm" : "png";
    lom_bytes bytes = lom_encode_image(kind, image, error);
    bool done =
        bytes.data != NULL && append_word(part, bytes.size, error) && append(part, bytes.data, bytes.size, error);
    lom_release(bytes.data);
    return done;
}

bool lom_end_part(lom_part_writer *part, bool keep, lom_error *error)
{
    bool done = keep && part->writer != NULL && append_word(part, part->hash, error);
    lom_writer *writer = part->writer;
    part->writer = NULL;
    if (done)
        return lom_close_writer(writer, error);
    lom_abandon_writer(writer);
    return !keep;
}

/* ---- reading ---- */

/* Numbers that somebody else may have written: what is computed from them below has room. */
static bool is_possible(const lom_part_head *head)
{
    return head->shard >= 1 && head->shard <= head->shards && head->shards <= MOST_SHARDS && head->frames >= 1 &&
           head->frames <= MOST_FRAMES && head->first < MOST_FRAMES && head->width >= 1 &&
           head->width <= LOM_MAX_SIZE && head->height >= 1 && head->height <= LOM_MAX_SIZE && head->bands >= 1 &&
           head->bands <= head->height && head->format <= 2 && head->transfer <= 1 && head->rate >= 1 &&
           head->rate <= UINT32_MAX / 2;
}

bool lom_read_part(const char *path, lom_part *part, lom_error *error)
{
    enum { LEAST = MAGIC_BYTES + (HEAD_WORDS + 1) * WORD_BYTES };
    uint64_t words[HEAD_WORDS];
    *part = (lom_part){ .file = lom_read_file(path, MOST_PART_BYTES, error) };
    if (part->file.data == NULL)
        return false;
    const uint8_t *data = part->file.data;
    size_t size = part->file.size;
    bool is_part = size >= MAGIC_BYTES && memcmp(data, magic, MAGIC_BYTES) == 0;
    if (!is_part || size < LEAST ||
        load_64_little(data + size - WORD_BYTES) != lom_hash_bytes(LOM_HASH_START, data, size - WORD_BYTES)) {
        lom_free_part(part);
        return lom_fail(error, LOM_ERROR_INPUT,
                        is_part ? "%s: this part is not whole; draw it again."
                                : "%s: this is no part of a run (lom render --shard I/N).",
                        path);
    }
    for (size_t i = 0; i < HEAD_WORDS; i++)
        words[i] = load_64_little(data + MAGIC_BYTES + i * WORD_BYTES);
    memcpy(&part->head, words, sizeof words);
    part->hash = load_64_little(data + size - WORD_BYTES);
    part->at = MAGIC_BYTES + HEAD_WORDS * WORD_BYTES;
    if (is_possible(&part->head))
        return true;
    lom_free_part(part);
    return lom_fail(error, LOM_ERROR_INPUT, "%s: this part is of a run that cannot be.", path);
}

lom_image *lom_read_piece(lom_part *part, const char *path, int rows, lom_error *error)
{
    size_t left = part->file.size - WORD_BYTES - part->at;
    uint64_t size = left >= WORD_BYTES ? load_64_little(part->file.data + part->at) : UINT64_MAX;
    if (size > left - WORD_BYTES || left < WORD_BYTES) {
        lom_fail(error, LOM_ERROR_INPUT, "%s: this part has fewer pieces than it says.", path);
        return NULL;
    }
    lom_image *image = lom_decode_image(part->file.data + part->at + WORD_BYTES, (size_t)size, path, error);
    part->at += WORD_BYTES + (size_t)size;
    if (image == NULL || (image->width == (int)part->head.width && image->height == rows && image->depth == 1))
        return image;
    lom_fail(error, LOM_ERROR_INPUT, "%s: a piece of this part is %d x %d pixels and should be %d x %d.", path,
             image->width, image->height, (int)part->head.width, rows);
    lom_free_image(image);
    return NULL;
}

void lom_free_part(lom_part *part)
{
    lom_release(part->file.data);
    *part = (lom_part){ .at = 0 };
}
