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

lom_image *lom_decode_pnm(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    int kind = data[1] - '0';
    pnm p = { .in = { data, size, 2, name, error }, .text = kind <= 3, .bits = kind == 1 || kind == 4, .maximum = 1 };
    p.channels = kind == 3 || kind == 6 ? 3 : 1;
    if (!text_read_number(&p.in, MOST_SIZE, &p.width) || !text_read_number(&p.in, MOST_SIZE, &p.height) ||
        (!p.bits && !text_read_number(&p.in, MOST_MAXIMUM, &p.maximum)) || !text_end_header(&p.in))
        return NULL;
    if (p.maximum == 0) {
        text_fail(&p.in, "the maximum is 0");
        return NULL;
    }
    return read_picture(&p);
}

static bool is_word(const text_reader *in, size_t length, const char *word)
{
    return strlen(word) == length && memcmp(in->data + in->at, word, length) == 0;
}

/* A line of PAM's header, a word and its value; *ended after the last one. */
static bool read_pam_line(pnm *p, bool *ended)
{
    const struct {
        const char *word;
        uint32_t *value, most;
    } fields[] = {
        { "WIDTH", &p->width, MOST_SIZE },
        { "HEIGHT", &p->height, MOST_SIZE },
        { "DEPTH", &p->channels, MOST_SIZE },
        { "MAXVAL", &p->maximum, MOST_MAXIMUM },
    };
    text_reader *in = &p->in;
    text_skip_space(in);
    size_t length = 0;
    while (in->at + length < in->size && !text_is_space(in->data[in->at + length]))
        length++;
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        if (is_word(in, length, fields[i].word)) {
            in->at += length;
            return text_read_number(in, fields[i].most, fields[i].value);
        }
    }
    *ended = is_word(in, length, "ENDHDR");
    if (*ended) {
        in->at += length;
        return text_end_header(in);
    }
    if (!is_word(in, length, "TUPLTYPE")) /* free text: the number of channels says enough */
        return text_fail(in, "there is no such word in a PAM header");
    while (in->at < in->size && in->data[in->at] != '\n')
        in->at++;
    return true;
}

lom_image *lom_decode_pam(const uint8_t *data, size_t size, const char *name, lom_error *error)
{
    pnm p = { .in = { data, size, 2, name, error } };
    for (bool ended = false; !ended;)
        if (!read_pam_line(&p, &ended))
            return NULL;
    if (p.maximum == 0 || p.channels == 0 || p.channels > 4) {
        text_fail(&p.in, "the header should give a MAXVAL of at least 1 and a DEPTH of 1 to 4");
        return NULL;
    }
    return read_picture(&p);
}
