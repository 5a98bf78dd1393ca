/* PBM, PGM and PPM (P1..P6, text and binary) and PAM (P7) files, read, after the netpbm manual pages. In: a whole file;
 * out: an image of 8 bits for a maximum below 256, else of 16, scaled so that the file's maximum is the format's. Only
 * the first picture of a file is read. */
#include "codec.h"

#include "bytes.h"
#include "text_reader.h"

#include <string.h>

typedef struct pnm {
    text_reader in;
    uint32_t width, height, channels, maximum;
    bool text, bits; /* samples as numbers; one bit a pixel, 1 is black */
} pnm;

enum { MOST_SIZE = 1000000000, MOST_MAXIMUM = 65535 };

/* value / maximum of the file as the nearest fraction of the format's maximum */
static inline uint32_t rescale(uint32_t value, uint32_t maximum, uint32_t full)
{
    return maximum == full ? value : (uint32_t)(((uint64_t)value * full + maximum / 2) / maximum);
}

static inline void put_sample(lom_image *image, size_t i, uint32_t value, uint32_t maximum)
{
    if (maximum > 255) {
        uint16_t wide = (uint16_t)rescale(value, maximum, 65535);
        memcpy(image->pixels + 2 * i, &wide, sizeof wide);
    } else {
        image->pixels[i] = (uint8_t)rescale(value, maximum, 255);
    }
}

/* ---- samples ---- */

static bool read_text_bit(text_reader *in, uint32_t *value)
{
    text_skip_space(in);
    if (in->at >= in->size || (in->data[in->at] | 1) != '1')
        return text_fail(in, "there should be 0 or 1");
    *value = in->data[in->at++] == '0';
    return true;
}

static bool read_text_samples(pnm *p, lom_image *image)
{
    size_t count = (size_t)p->width * p->height * p->channels;
    for (size_t i = 0; i < count; i++) {
        uint32_t value = 0;
        if (!(p->bits ? read_text_bit(&p->in, &value) : text_read_number(&p->in, p->maximum, &value)))
            return false;
        put_sample(image, i, value, p->maximum);
    }
    return true;
}

static bool read_bits(pnm *p, lom_image *image)
{
    size_t row = (p->width + 7) / 8;
    if ((p->in.size - p->in.at) / row < p->height)
        return text_fail(&p->in, "the file ends in the middle of the picture");
    for (uint32_t y = 0; y < p->height; y++)
        for (uint32_t x = 0; x < p->width; x++) {
            uint32_t bit = p->in.data[p->in.at + y * row + x / 8] >> (7 - x % 8) & 1;
            put_sample(image, (size_t)y * p->width + x, !bit, 1);
        }
    return true;
}

static bool read_samples(pnm *p, lom_image *image)
{
    size_t count = (size_t)p->width * p->height * p->channels, bytes = p->maximum > 255 ? 2 : 1;
    if ((p->in.size - p->in.at) / bytes < count)
        return text_fail(&p->in, "the file ends in the middle of the picture");
    const uint8_t *samples = p->in.data + p->in.at;
    if (p->maximum == 255) {
        memcpy(image->pixels, samples, count);
        return true;
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t value = bytes == 2 ? load_16_big(samples + 2 * i) : samples[i];
        if (value > p->maximum) {
            p->in.at += i * bytes;
            return text_fail(&p->in, "a sample is above the declared maximum");
        }
        put_sample(image, i, value, p->maximum);
    }
    return true;
}

static lom_image *read_picture(pnm *p)
{
    /* the least room of a sample in the file: a bit, a digit, or a digit and a space, or one or two bytes */
    uint64_t bits = p->bits && !p->text ? 1 : p->bits ? 8 : p->text || p->maximum > 255 ? 16 : 8;
    lom_format format = lom_unorm_format((int)p->channels, p->maximum > 255 ? 16 : 8);
    uint64_t available = p->in.size - p->in.at + p->text; /* the last number needs no space behind it */
    lom_image *image =
        lom_create_declared(p->in.name, p->width, p->height, format, bits * p->channels, 1, available, p->in.error);
    if (image == NULL)
        return NULL;
    if (!(p->text ? read_text_samples : p->bits ? read_bits : read_samples)(p, image)) {
        lom_free_image(image);
        return NULL;
    }
    return image;
}

/* ---- headers ---- */

/* The bytes of the samples behind the header, as far as they have a size of their own. */
static uint64_t raster_size(const pnm *p)
{
    uint64_t row = p->bits ? ((uint64_t)p->width + 7) / 8 : (uint64_t)p->width * p->channels;
    return p->text ? 0 : row * p->height * (p->maximum > 255 ? 2 : 1); /* below 2^30 * 2^2 * 2^30 * 2 */
}

lom_image *lom_decode_pnm(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    int kind = data[1] - '0';
    pnm p = { .in = { data, size, 2, name, error }, .text = kind <= 3, .bits = kind == 1 || kind == 4, .maximum = 1 };
    p.channels = kind == 3 || kind == 6 ? 3 : 1;
    if (!text_end_kind(&p.in) || !text_read_number(&p.in, MOST_SIZE, &p.width) ||
        !text_read_number(&p.in, MOST_SIZE, &p.height) ||
        (!p.bits && !text_read_number(&p.in, MOST_MAXIMUM, &p.maximum)) || !text_end_header(&p.in, raster_size(&p)))
        return NULL;
    if (p.maximum == 0) {
        text_fail(&p.in, "the maximum is 0");
        return NULL;
    }
    return read_picture(&p);
}

/* ---- PAM: a header of lines, each a word and its value (netpbm, pam(5)) ---- */

typedef struct pam_text {
    const char *start;
    size_t length;
} pam_text;

static bool text_is(pam_text text, const char *word)
{
    return strlen(word) == text.length && memcmp(text.start, word, text.length) == 0;
}

static pam_text trim(pam_text text)
{
    while (text.length > 0 && text_is_space((uint8_t)text.start[0]))
        text = (pam_text){ text.start + 1, text.length - 1 };
    while (text.length > 0 && text_is_space((uint8_t)text.start[text.length - 1]))
        text.length--;
    return text;
}

/* The next line without the white space around it; `at` moves behind its newline. */
static bool next_line(text_reader *in, pam_text *line)
{
    const uint8_t *start = in->data + in->at, *newline = memchr(start, '\n', in->size - in->at);
    if (newline == NULL)
        return text_fail(in, "the file ends in the header");
    *line = trim((pam_text){ (const char *)start, (size_t)(newline - start) });
    in->at = (size_t)(newline - in->data) + 1;
    return true;
}

typedef struct pam {
    pnm picture;
    uint32_t seen;      /* a bit for each of the fields with a number */
    pam_text type;      /* of the tuples; length 0: not given */
    bool ended, joined; /* after ENDHDR; a tuple type of several lines, which is none that is known */
} pam;

static bool read_pam_number(pam *p, const char *word, pam_text value, uint32_t most, uint32_t *number)
{
    text_reader in = { (const uint8_t *)value.start, value.length, 0, p->picture.in.name, NULL };
    if (value.length > 0 && text_is_digit((uint8_t)value.start[0]) && text_read_number(&in, most, number) &&
        in.at == in.size)
        return true;
    return lom_fail(p->picture.in.error, LOM_ERROR_INPUT, "%s: byte %zu: %s should be a whole number up to %u.",
                    p->picture.in.name, (size_t)((const uint8_t *)value.start - p->picture.in.data), word, most);
}

static bool read_pam_field(pam *p, pam_text word, pam_text value)
{
    pnm *picture = &p->picture;
    const struct {
        const char *word;
        uint32_t *value, most;
    } fields[] = {
        { "WIDTH", &picture->width, MOST_SIZE },
        { "HEIGHT", &picture->height, MOST_SIZE },
        { "DEPTH", &picture->channels, MOST_SIZE },
        { "MAXVAL", &picture->maximum, MOST_MAXIMUM },
    };
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        if (!text_is(word, fields[i].word))
            continue;
        if (p->seen >> i & 1)
            return text_fail(&picture->in, "the line before says again what an earlier one said");
        p->seen |= UINT32_C(1) << i;
        return read_pam_number(p, fields[i].word, value, fields[i].most, fields[i].value);
    }
    p->ended = text_is(word, "ENDHDR") && value.length == 0;
    if (p->ended)
        return true;
    if (!text_is(word, "TUPLTYPE"))
        return text_fail(&picture->in, "the line before is none of a PAM header");
    p->joined = p->joined || p->type.length > 0;
    p->type = value;
    return true;
}

static bool read_pam_line(pam *p)
{
    pam_text line;
    if (!next_line(&p->picture.in, &line))
        return false;
    if (line.length == 0 || line.start[0] == '#')
        return true;
    pam_text word = { line.start, 0 };
    while (word.length < line.length && !text_is_space((uint8_t)line.start[word.length]))
        word.length++;
    return read_pam_field(p, word, trim((pam_text){ line.start + word.length, line.length - word.length }));
}

/* The tuple types that pam(5) defines and their channels. Without one, the number of channels says enough; another one
 * (as CMYK) means colours that an image does not hold, unless it has a single channel. */
static bool check_pam_type(const pam *p)
{
    static const struct {
        const char *name;
        uint32_t channels;
    } types[] = {
        { "BLACKANDWHITE", 1 },   { "GRAYSCALE", 1 }, { "BLACKANDWHITE_ALPHA", 2 },
        { "GRAYSCALE_ALPHA", 2 }, { "RGB", 3 },       { "RGB_ALPHA", 4 },
    };
    uint32_t channels = p->picture.channels;
    bool known = p->type.length == 0 || channels == 1;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (text_is(p->type, types[i].name) && !p->joined) {
            known = true;
            channels = types[i].channels;
        }
    return (known && channels == p->picture.channels) ||
           lom_fail(p->picture.in.error, LOM_ERROR_INPUT,
                    "%s: the TUPLTYPE \"%.*s\" cannot be read with a DEPTH of %u.", p->picture.in.name,
                    p->type.length < 40 ? (int)p->type.length : 40, p->type.start, p->picture.channels);
}

lom_image *lom_decode_pam(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    pam p = { .picture.in = { data, size, 2, name, error } };
    pam_text rest;
    if (!next_line(&p.picture.in, &rest))
        return NULL;
    if (rest.length != 0) {
        p.picture.in.at = 2;
        text_fail(&p.picture.in, "the first line should be P7 alone");
        return NULL;
    }
    while (!p.ended)
        if (!read_pam_line(&p))
            return NULL;
    if (p.seen != 15 || p.picture.maximum == 0 || p.picture.channels == 0 || p.picture.channels > 4) {
        text_fail(&p.picture.in, "the header should give WIDTH, HEIGHT, a MAXVAL of at least 1 and a DEPTH of 1 to 4");
        return NULL;
    }
    return check_pam_type(&p) ? read_picture(&p.picture) : NULL;
}
