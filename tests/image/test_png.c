/* PNG. Oracle: a small writer in this file that makes every kind of PNG there is from samples (its own chunks, filters
 * and passes, written from the specification), so that what must come out is known. Proves: all colour types, depths,
 * interlacing, palettes, transparency and filters are read; what we write is read back bit for bit; damage is an error
 * that names its place and never a large allocation. */
#include "check.h"

#include <lom/image.h>

#include "image/bytes.h"
#include "image/png.h"
#include "image/zip.h"

#include <sys/resource.h>

/* ---- the test's writer ---- */

typedef struct file {
    uint8_t *data;
    size_t size, capacity;
} file;

static void put(file *f, const void *data, size_t size)
{
    if (f->size + size > f->capacity) {
        f->capacity = (f->size + size) * 2;
        f->data = realloc(f->data, f->capacity);
    }
    if (size != 0)
        memcpy(f->data + f->size, data, size);
    f->size += size;
}

static void put_word(file *f, uint32_t word)
{
    put(f, (const uint8_t[4]){ (uint8_t)(word >> 24), (uint8_t)(word >> 16), (uint8_t)(word >> 8), (uint8_t)word }, 4);
}

static void put_chunk(file *f, const char *type, const void *data, size_t size)
{
    put_word(f, (uint32_t)size);
    put(f, type, 4);
    put(f, data, size);
    put_word(f, lom_crc32(0, f->data + f->size - size - 4, size + 4));
}

typedef struct kind {
    int type, depth, interlaced, samples;
} kind;

static const kind kinds[] = {
    { 0, 1, 0, 1 },  { 0, 2, 0, 1 },  { 0, 4, 0, 1 },  { 0, 8, 0, 1 },  { 0, 16, 0, 1 }, { 2, 8, 0, 3 },
    { 2, 16, 0, 3 }, { 3, 1, 0, 1 },  { 3, 2, 0, 1 },  { 3, 4, 0, 1 },  { 3, 8, 0, 1 },  { 4, 8, 0, 2 },
    { 4, 16, 0, 2 }, { 6, 8, 0, 4 },  { 6, 16, 0, 4 }, { 0, 1, 1, 1 },  { 0, 2, 1, 1 },  { 0, 4, 1, 1 },
    { 0, 8, 1, 1 },  { 0, 16, 1, 1 }, { 2, 8, 1, 3 },  { 2, 16, 1, 3 }, { 3, 1, 1, 1 },  { 3, 2, 1, 1 },
    { 3, 4, 1, 1 },  { 3, 8, 1, 1 },  { 4, 8, 1, 2 },  { 4, 16, 1, 2 }, { 6, 8, 1, 4 },  { 6, 16, 1, 4 },
};
enum { KINDS = sizeof kinds / sizeof *kinds, MOST = 40 };

typedef struct picture {
    kind k;
    int width, height;
    bool transparent;
    uint16_t sample[MOST * MOST * 4];
    uint8_t palette[256][4];
    uint64_t seed;
} picture;

static int paeth(int a, int b, int c)
{
    int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/* One pass: rows of the pixels (x0 + i dx, y0 + j dy), packed, filtered by a random filter each. */
static void put_pass(file *f, const picture *p, int x0, int y0, int dx, int dy)
{
    int width = (p->width - x0 + dx - 1) / dx, bits = p->k.depth * p->k.samples;
    size_t size = ((size_t)width * (size_t)bits + 7) / 8, step = bits < 8 ? 1 : (size_t)bits / 8;
    uint8_t row[MOST * 8] = { 0 }, above[MOST * 8] = { 0 }, out[MOST * 8 + 1];
    for (int y = y0; y < p->height && width > 0; y += dy) {
        memset(row, 0, sizeof row);
        size_t bit = 0;
        for (int x = x0; x < p->width; x += dx)
            for (int s = 0; s < p->k.samples; s++) {
                unsigned value = p->sample[(y * p->width + x) * p->k.samples + s];
                for (int b = p->k.depth - 1; b >= 0; b--, bit++)
                    row[bit / 8] |= (uint8_t)((value >> b & 1) << (7 - bit % 8));
            }
        out[0] = (uint8_t)(lom_random_bits(p->seed, (uint64_t)(y * 64 + x0)) % 5);
        for (size_t i = 0; i < size; i++) {
            int a = i >= step ? row[i - step] : 0, b = above[i], c = i >= step ? above[i - step] : 0;
            const int guesses[5] = { 0, a, b, (a + b) / 2, paeth(a, b, c) };
            out[i + 1] = (uint8_t)(row[i] - guesses[out[0]]);
        }
        put(f, out, size + 1);
        memcpy(above, row, sizeof above);
    }
}

static file write_png(const picture *p)
{
    static const int adam7[7][4] = { { 0, 0, 8, 8 }, { 4, 0, 8, 8 }, { 0, 4, 4, 8 }, { 2, 0, 4, 4 },
                                     { 0, 2, 2, 4 }, { 1, 0, 2, 2 }, { 0, 1, 1, 2 } };
    file rows = { 0 }, f = { 0 };
    if (p->k.interlaced)
        for (int i = 0; i < 7; i++)
            put_pass(&rows, p, adam7[i][0], adam7[i][1], adam7[i][2], adam7[i][3]);
    else
        put_pass(&rows, p, 0, 0, 1, 1);
    lom_bytes zlib = lom_deflate_zlib(rows.data, rows.size, 8, NULL);
    put(&f, "\x89PNG\r\n\x1a\n", 8);
    uint8_t header[13] = { 0,
                           0,
                           0,
                           (uint8_t)p->width,
                           0,
                           0,
                           0,
                           (uint8_t)p->height,
                           (uint8_t)p->k.depth,
                           (uint8_t)p->k.type,
                           0,
                           0,
                           (uint8_t)p->k.interlaced };
    put_chunk(&f, "IHDR", header, 13);
    put_chunk(&f, "tEXt", "Title\0nothing", 13);
    int colors = 1 << (p->k.depth < 8 ? p->k.depth : 8);
    uint8_t bytes[768];
    for (int i = 0; i < colors * 3; i++)
        bytes[i] = p->palette[i / 3][i % 3];
    if (p->k.type == 3)
        put_chunk(&f, "PLTE", bytes, (size_t)colors * 3);
    for (int i = 0; i < colors; i++)
        bytes[i] = p->palette[i][3];
    if (p->transparent && p->k.type == 3)
        put_chunk(&f, "tRNS", bytes, (size_t)colors);
    for (int i = 0; i < p->k.samples; i++) { /* the colour of pixel 0 is the transparent one */
        bytes[2 * i] = (uint8_t)(p->sample[i] >> 8);
        bytes[2 * i + 1] = (uint8_t)p->sample[i];
    }
    if (p->transparent && p->k.type != 3)
        put_chunk(&f, "tRNS", bytes, 2 * (size_t)p->k.samples);
    size_t cut = zlib.size / 3; /* data in several chunks, one of them empty */
    put_chunk(&f, "IDAT", zlib.data, cut);
    put_chunk(&f, "IDAT", NULL, 0);
    put_chunk(&f, "IDAT", zlib.data + cut, zlib.size - cut);
    put_chunk(&f, "tIME", "\7\xe8\1\1\0\0\0", 7);
    put_chunk(&f, "IEND", NULL, 0);
    lom_release(zlib.data);
    free(rows.data);
    return f;
}

static picture make_picture(kind k, int width, int height, bool transparent, uint64_t seed)
{
    picture p = { .k = k, .width = width, .height = height, .transparent = transparent, .seed = seed };
    for (int i = 0; i < width * height * k.samples; i++) /* smooth in part, so that filters matter */
        p.sample[i] =
            (uint16_t)((i % 5 ? (unsigned)i * 37 : lom_random_bits(seed, (uint64_t)i)) & ((1u << k.depth) - 1));
    for (int i = 0; i < 256 * 4; i++)
        p.palette[i / 4][i % 4] = (uint8_t)lom_random_bits(seed + 1, (uint64_t)i);
    return p;
}

/* What a pixel should be, in units of 1 / full. */
static void expected_pixel(const picture *p, int i, unsigned out[4])
{
    const uint16_t *s = p->sample + i * p->k.samples;
    unsigned full = p->k.depth == 16 ? 65535 : 255, most = (1u << p->k.depth) - 1;
    bool key = true;
    for (int c = 0; c < p->k.samples; c++) {
        out[c] = s[c] * (full / most);
        key = key && s[c] == p->sample[c];
    }
    out[p->k.samples] = key ? 0 : full;
    if (p->k.type == 3)
        for (int c = 0; c < 4; c++)
            out[c] = p->palette[s[0]][c];
}

static void check_picture(const picture *p, const char *what)
{
    file f = write_png(p);
    lom_error error = { 0 };
    lom_image *image = lom_decode_image(f.data, f.size, "test.png", &error);
    int channels = (p->k.type == 3 ? 3 : p->k.samples) + p->transparent, bytes = p->k.depth == 16 ? 2 : 1;
    lom_format format = (lom_format)((bytes == 2 ? LOM_FORMAT_R16 : LOM_FORMAT_R8) + channels - 1);
    CHECK(image != NULL && image->width == p->width && image->height == p->height && image->format == format,
          "%s, type %d, depth %d: %s", what, p->k.type, p->k.depth, error.text);
    for (int i = 0; image != NULL && i < p->width * p->height; i++) {
        unsigned expected[5];
        expected_pixel(p, i, expected);
        for (int c = 0; c < channels; c++) {
            uint16_t wide;
            memcpy(&wide, image->pixels + (i * channels + c) * bytes, (size_t)bytes);
            unsigned value = bytes == 2 ? wide : image->pixels[i * channels + c];
            CHECK(value == expected[c],
                  "%s, type %d, depth %d, interlaced %d, %d x %d: pixel %d, channel %d: %u, not %u", what, p->k.type,
                  p->k.depth, p->k.interlaced, p->width, p->height, i, c, value, expected[c]);
        }
    }
    lom_free_image(image);
    free(f.data);
}

/* ---- reading ---- */

static void every_kind(void)
{
    for (int i = 0; i < KINDS; i++)
        for (int transparent = 0; transparent <= (kinds[i].type < 4); transparent++) {
            picture p = make_picture(kinds[i], 37, 21, transparent, (uint64_t)i);
            check_picture(&p, "kind");
        }
}

static void every_small_size(void)
{
    for (int i = 0; i < KINDS; i++)
        for (int width = 1; width <= 10; width++)
            for (int height = 1; height <= 10; height++) {
                picture p = make_picture(kinds[i], width, height, false, (uint64_t)(width * 16 + height));
                check_picture(&p, "size");
            }
}

/* Section 9.2, byte after byte, without the code under test: x is this byte, a to the left, b above, c above a. */
static uint8_t plain_unfiltered(int filter, int x, int a, int b, int c)
{
    int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    const int guesses[] = { 0, a, b, (a + b) / 2, pa <= pb && pa <= pc ? a : pb <= pc ? b : c };
    return (uint8_t)(x + guesses[filter]);
}

/* Every filter, size of a pixel and length of a row, on noise and on the extremes 0 and 255. */
static void unfilters_as_defined(void)
{
    enum { MOST_BYTES = 67 };
    for (int filter = 0; filter < 5; filter++)
        for (size_t step = 1; step <= 8; step++)
            for (size_t size = step; size <= MOST_BYTES; size += step)
                for (uint64_t round = 0; round < 20; round++) {
                    uint8_t row[MOST_BYTES + 1], above[MOST_BYTES], expected[MOST_BYTES];
                    for (size_t i = 0; i < size; i++) {
                        uint64_t bits = lom_random_bits(round, i);
                        row[i] = (uint8_t)(round % 2 ? bits : 0 - (bits & 1));
                        above[i] = (uint8_t)(round % 2 ? bits >> 8 : 0 - (bits >> 1 & 1));
                        expected[i] = plain_unfiltered(filter, row[i], i < step ? 0 : expected[i - step], above[i],
                                                       i < step ? 0 : above[i - step]);
                    }
                    row[size] = 77; /* behind the row */
                    CHECK(lom_png_unfilter(row, above, size, step, filter), "filter %d", filter);
                    CHECK(memcmp(row, expected, size) == 0 && row[size] == 77, "filter %d, %zu bytes by %zu", filter,
                          size, step);
                }
    CHECK(!lom_png_unfilter((uint8_t[8]){ 0 }, (uint8_t[8]){ 0 }, 8, 4, 5), "there is no filter 5");
}

static void short_palettes(void)
{
    picture p = make_picture((kind){ 3, 8, 0, 1 }, 4, 4, true, 5);
    file f = write_png(&p);
    /* PLTE cut to 10 colours: the sample 250 is not one of them */
    uint8_t *plte = memmem(f.data, f.size, "PLTE", 4);
    CHECK(plte != NULL, "no palette");
    lom_error error = { 0 };
    file g = { 0 };
    put(&g, f.data, (size_t)(plte - f.data) - 4);
    put_chunk(&g, "PLTE", plte + 4, 30);
    uint8_t *idat = memmem(f.data, f.size, "IDAT", 4);
    put(&g, idat - 4, (size_t)(f.data + f.size - idat) + 4);
    CHECK(lom_decode_image(g.data, g.size, "t", &error) == NULL && error.code == LOM_ERROR_INPUT, "%s", error.text);
    free(f.data);
    free(g.data);
}

/* ---- writing ---- */

static void write_and_read(void)
{
    static const int sizes[][2] = { { 1, 1 }, { 1, 7 }, { 7, 1 }, { 33, 20 }, { 1000, 3 }, { 3, 1000 } };
    for (lom_format format = LOM_FORMAT_R8; format <= LOM_FORMAT_RGBA16; format++)
        for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
            for (uint64_t content = 0; content < 3; content++) {
                lom_error error = { 0 };
                lom_image *image = lom_create_image(sizes[s][0], sizes[s][1], 1, format, &error);
                size_t size = lom_image_size(image);
                for (size_t i = 0; i < size; i++)
                    image->pixels[i] = (uint8_t)(content == 0 ? 7 : content == 1 ? lom_random_bits(1, i) : i / 9);
                lom_bytes png = lom_encode_image("png", image, &error);
                lom_image *back = lom_decode_image(png.data, png.size, "t", &error);
                CHECK(back != NULL && memcmp(back->pixels, image->pixels, size) == 0, "format %d: %s", format,
                      error.text);
                CHECK(back != NULL && lom_format_size(back->format) == lom_format_size(format), "format %d", format);
                CHECK(back != NULL && lom_reinterpret_image(back, format, &error), "%s", error.text);
                CHECK(back != NULL && lom_hash_image(back) == lom_hash_image(image), "hash");
                lom_release(png.data);
                lom_free_image(back);
                lom_free_image(image);
            }
}

static void same_bytes_every_time(void)
{
    lom_image *image = lom_create_image(200, 100, 1, LOM_FORMAT_RGB8, NULL);
    for (size_t i = 0; i < lom_image_size(image); i++)
        image->pixels[i] = (uint8_t)(i / 300 + lom_random_bits(3, i) % 3);
    lom_bytes a = lom_encode_image("png", image, NULL), b = lom_encode_image("PNG", image, NULL);
    CHECK(a.size == b.size && memcmp(a.data, b.data, a.size) == 0, "two encodings differ");
    CHECK(a.size < lom_image_size(image) / 2, "%zu bytes", a.size);
    lom_release(a.data);
    lom_release(b.data);
    lom_free_image(image);
}

static void refuses(void)
{
    static const lom_format formats[] = { LOM_FORMAT_R16F, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH24,
                                          LOM_FORMAT_DEPTH32F };
    for (int i = 0; i < 4; i++) {
        lom_error error = { 0 };
        lom_image *image = lom_create_image(2, 2, 1, formats[i], NULL);
        CHECK(lom_encode_image("png", image, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
        lom_free_image(image);
    }
    lom_error error = { 0 };
    lom_image *image = lom_create_image(2, 2, 2, LOM_FORMAT_R8, NULL);
    CHECK(lom_encode_image("png", image, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
    lom_free_image(image);
}

/* ---- damage ---- */

static lom_image *decode_copy(const uint8_t *data, size_t size, lom_error *error)
{
    uint8_t *exact = lom_allocate(size, 1, NULL);
    memcpy(exact, data, size);
    lom_image *image = lom_decode_image(exact, size, "t.png", error);
    lom_release(exact);
    return image;
}

static void truncations(void)
{
    for (int i = 0; i < KINDS; i += 3) {
        picture p = make_picture(kinds[i], 9, 9, kinds[i].type < 4, 1);
        file f = write_png(&p);
        for (size_t size = 0; size < f.size; size++) {
            lom_error error = { 0 };
            CHECK(decode_copy(f.data, size, &error) == NULL && error.code == LOM_ERROR_INPUT, "%zu bytes: %d", size,
                  error.code);
            CHECK(strncmp(error.text, "t.png: byte ", 12) == 0, "%s", error.text);
        }
        free(f.data);
    }
}

/* A flip is found by a CRC, or lies in an ancillary chunk and changes nothing, or makes one of a needed chunk. */
static void bit_flips(void)
{
    for (int i = 0; i < KINDS; i++) {
        picture p = make_picture(kinds[i], 7, 5, false, 2);
        file f = write_png(&p);
        lom_image *whole = decode_copy(f.data, f.size, NULL);
        for (size_t bit = 0; bit < f.size * 8; bit++) {
            lom_error error = { 0 };
            f.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
            lom_image *image = decode_copy(f.data, f.size, &error);
            f.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
            CHECK(image != NULL || error.code == LOM_ERROR_INPUT, "bit %zu: code %d", bit, error.code);
            CHECK(image == NULL || lom_hash_image(image) == lom_hash_image(whole), "bit %zu changed the picture", bit);
            lom_free_image(image);
        }
        lom_free_image(whole);
        free(f.data);
    }
}

static void mend_crcs(uint8_t *data, size_t size)
{
    for (size_t at = 8; at + 12 <= size;) {
        size_t length = load_32_big(data + at);
        if (length > size - at - 12)
            return;
        store_32_big(data + at + 8 + length, lom_crc32(0, data + at + 4, length + 4));
        at += 12 + length;
    }
}

/* Bytes changed and the CRCs made right again, so that the damage reaches what is behind them. */
static void damage_behind_crc(void)
{
    for (int k = 0; k < 2 * KINDS; k++) {
        picture p = make_picture(kinds[k / 2], 12, 9, k % 2 && kinds[k / 2].type < 4, (uint64_t)k);
        file f = write_png(&p);
        uint8_t *damaged = malloc(f.size);
        for (uint64_t i = 0; i < 500; i++) {
            memcpy(damaged, f.data, f.size);
            for (uint64_t n = 0; n < 1 + i % 3; n++)
                damaged[8 + lom_random_bits(10 + n, i) % (f.size - 8)] = (uint8_t)lom_random_bits(20 + n, i);
            mend_crcs(damaged, f.size);
            lom_error error = { 0 };
            lom_image *image = decode_copy(damaged, f.size, &error);
            CHECK((image != NULL) == (error.code == LOM_OK), "%s", error.text);
            CHECK(image != NULL || error.code == LOM_ERROR_INPUT || error.code == LOM_ERROR_LIMIT, "code %d: %s",
                  error.code, error.text);
            lom_free_image(image);
        }
        free(damaged);
        free(f.data);
    }
}

static file declare(uint32_t width, uint32_t height, int depth, int type, const void *data, size_t size)
{
    file f = { 0 };
    uint8_t header[13] = { 0 };
    store_32_big(header, width);
    store_32_big(header + 4, height);
    header[8] = (uint8_t)depth;
    header[9] = (uint8_t)type;
    put(&f, "\x89PNG\r\n\x1a\n", 8);
    put_chunk(&f, "IHDR", header, 13);
    put_chunk(&f, "IDAT", data, size);
    put_chunk(&f, "IEND", NULL, 0);
    return f;
}

static long peak_kilobytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

static void huge_declarations(void)
{
    static const struct {
        uint32_t width, height;
        lom_code code;
    } cases[] = {
        { 0, 1, LOM_ERROR_INPUT },          { 1, 0, LOM_ERROR_INPUT },
        { 32768, 32768, LOM_ERROR_INPUT },  { 32769, 1, LOM_ERROR_LIMIT },
        { 1, 32769, LOM_ERROR_LIMIT },      { 0x7fffffff, 0x7fffffff, LOM_ERROR_LIMIT },
        { 0xffffffff, 1, LOM_ERROR_LIMIT }, { 0x80000000, 0x80000000, LOM_ERROR_LIMIT },
        { 20000, 20000, LOM_ERROR_INPUT },
    };
    long before = peak_kilobytes();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        file f = declare(cases[i].width, cases[i].height, 16, 6, "\x78\x9c\x03\0\0\0\0\1", 8);
        lom_error error = { 0 };
        CHECK(lom_decode_image(f.data, f.size, "t", &error) == NULL, "%u x %u", cases[i].width, cases[i].height);
        CHECK(error.code == cases[i].code, "%u x %u: code %d: %s", cases[i].width, cases[i].height, error.code,
              error.text);
        free(f.data);
    }
    CHECK(peak_kilobytes() - before < 10000, "%ld KiB were used", peak_kilobytes() - before);
}

/* 100 MB of compressed zeros behind a header of 10 x 10 pixels; a file in chunks of unknown kinds. */
static void bombs(void)
{
    enum { SIZE = 100 << 20 };
    uint8_t *zeros = lom_allocate(SIZE, 1, NULL);
    lom_bytes zlib = lom_deflate_zlib(zeros, SIZE, 1, NULL);
    lom_release(zeros);
    file f = declare(10, 10, 8, 6, zlib.data, zlib.size);
    lom_error error = { 0 };
    CHECK(lom_decode_image(f.data, f.size, "t", &error) == NULL && error.code == LOM_ERROR_LIMIT, "%s", error.text);
    lom_release(zlib.data);
    free(f.data);
    f = (file){ 0 };
    put(&f, "\x89PNG\r\n\x1a\n", 8);
    put_chunk(&f, "IHDR", "\0\0\0\1\0\0\0\1\10\0\0\0\0", 13);
    for (int i = 0; i < 200000; i++)
        put_chunk(&f, "zzzz", NULL, 0);
    error = (lom_error){ 0 };
    CHECK(lom_decode_image(f.data, f.size, "t", &error) == NULL && error.code == LOM_ERROR_INPUT, "%s", error.text);
    free(f.data);
}

/* Chunks out of order, repeated, missing. */
/* Filters are 0 to 4, in whichever row. */
static void unknown_filters(void)
{
    static const uint8_t size[] = { 0, 0, 0, 3, 0, 0, 0, 2, 8, 0, 0, 0, 0 };
    for (int row = 0; row < 2; row++)
        for (int filter = 0; filter < 256; filter++) {
            uint8_t rows[8] = { 0, 1, 2, 3, 0, 4, 5, 6 };
            rows[4 * row] = (uint8_t)filter;
            lom_bytes zlib = lom_deflate_zlib(rows, sizeof rows, 8, NULL);
            file f = { 0 };
            put(&f, "\x89PNG\r\n\x1a\n", 8);
            put_chunk(&f, "IHDR", size, 13);
            put_chunk(&f, "IDAT", zlib.data, zlib.size);
            put_chunk(&f, "IEND", NULL, 0);
            lom_error error = { 0 };
            char says[40];
            snprintf(says, sizeof says, "t: row %d has an unknown filter.", row);
            lom_image *image = lom_decode_image(f.data, f.size, "t", &error);
            CHECK((image != NULL) == (filter < 5) && (image != NULL || strcmp(error.text, says) == 0), "filter %d: %s",
                  filter, error.text);
            lom_free_image(image);
            lom_release(zlib.data);
            free(f.data);
        }
}

static void bad_structure(void)
{
    static const uint8_t gray[] = { 0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0 },
                         palette[] = { 0, 0, 0, 1, 0, 0, 0, 1, 8, 3, 0, 0, 0 };
    static const char *const orders[] = { "E",   "hE",    "dhE",   "hhdE", "hd",   "hdzdE", "hdtE", "httdE", "hpdE",
                                          "HdE", "HppdE", "HtpdE", "HdpE", "hUdE", "h1dE",  "HPdE", "HpTdE" };
    uint8_t row[2] = { 0, 0 };
    lom_bytes zlib = lom_deflate_zlib(row, 2, 8, NULL);
    for (size_t i = 0; i <= sizeof orders / sizeof *orders; i++) {
        const char *order = i < sizeof orders / sizeof *orders ? orders[i] : "HztpptE"; /* and nonsense */
        file f = { 0 };
        put(&f, "\x89PNG\r\n\x1a\n", 8);
        for (const char *c = order; *c != 0; c++) {
            switch (*c) {
            case 'h':
                put_chunk(&f, "IHDR", gray, 13);
                break;
            case 'H':
                put_chunk(&f, "IHDR", palette, 13);
                break;
            case 'd':
                put_chunk(&f, "IDAT", zlib.data, zlib.size);
                break;
            case 'p':
                put_chunk(&f, "PLTE", "abc", 3);
                break;
            case 'P':
                put_chunk(&f, "PLTE", "abcd", 4);
                break;
            case 't':
                put_chunk(&f, "tRNS", "\0\0", 2);
                break;
            case 'T':
                put_chunk(&f, "tRNS", "\0\0", 2);
                break;
            case 'z':
                put_chunk(&f, "zTXt", "x", 1);
                break;
            case 'U':
                put_chunk(&f, "UNKN", "x", 1);
                break;
            case '1':
                put_chunk(&f, "a1cd", "x", 1);
                break;
            default:
                put_chunk(&f, "IEND", NULL, 0);
                break;
            }
        }
        lom_error error = { 0 };
        lom_image *image = lom_decode_image(f.data, f.size, "t", &error);
        CHECK(image == NULL && error.code == LOM_ERROR_INPUT, "the chunks %s were read", order);
        lom_free_image(image);
        free(f.data);
    }
    lom_release(zlib.data);
}

int main(int argc, char **argv)
{
    RUN(every_kind);
    RUN(every_small_size);
    RUN(unfilters_as_defined);
    RUN(short_palettes);
    RUN(write_and_read);
    RUN(same_bytes_every_time);
    RUN(refuses);
    RUN(truncations);
    RUN(bit_flips);
    RUN(damage_behind_crc);
    RUN(huge_declarations);
    RUN(bombs);
    RUN(unknown_filters);
    RUN(bad_structure);
    return check_result();
}
