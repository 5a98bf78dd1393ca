/* QOI. Oracles: files written by hand from the specification, operation by operation; random operations whose pixels
 * the test works out itself; PNG, for pictures of every sort. Proves: every operation is read as the page says, with
 * its bounds and its wrapping round; what is written comes back, is written by the shortest operation, and never relies
 * on what decoders do differently; damage and lies are refused. */
#include "check.h"

#include <lom/image.h>

static const char end[] = "\0\0\0\0\0\0\0\1";

/* A file of these operations, with its header and end marker; freed with free. */
static uint8_t *file_of(int width, int height, int channels, int space, const void *operations, size_t size)
{
    uint8_t *file = malloc(14 + size + 8);
    memcpy(file, "qoif", 4);
    for (int i = 0; i < 4; i++) {
        file[4 + i] = (uint8_t)(width >> 8 * (3 - i));
        file[8 + i] = (uint8_t)(height >> 8 * (3 - i));
    }
    file[12] = (uint8_t)channels;
    file[13] = (uint8_t)space;
    memcpy(file + 14, operations, size);
    memcpy(file + 14 + size, end, 8);
    return file;
}

static lom_image *decode_operations(int width, int height, int channels, const void *operations, size_t size,
                                    lom_error *error)
{
    uint8_t *file = file_of(width, height, channels, 0, operations, size);
    lom_image *image = lom_decode_image(file, 14 + size + 8, "t.qoi", error);
    free(file);
    return image;
}

static void expect(const char *name, int count, int channels, const void *operations, size_t size, const void *pixels)
{
    lom_error error = { 0 };
    lom_image *image = decode_operations(count, 1, channels, operations, size, &error);
    CHECK(image != NULL && image->format == (channels == 3 ? LOM_FORMAT_RGB8 : LOM_FORMAT_RGBA8), "%s: %s", name,
          error.text);
    CHECK(image == NULL || memcmp(image->pixels, pixels, (size_t)(count * channels)) == 0, "%s: other pixels", name);
    lom_free_image(image);
}

#define EXPECT(name, count, channels, operations, pixels)                                                              \
    expect(name, count, channels, operations, sizeof(operations) - 1, pixels)

static void operations_by_hand(void)
{
    EXPECT("a run of the pixel before the first", 2, 4, "\xc1", "\0\0\0\377\0\0\0\377");
    EXPECT("rgb keeps alpha", 1, 4, "\xfe\1\2\3", "\1\2\3\377");
    EXPECT("rgba", 2, 4, "\xff\1\2\3\4\xfe\5\6\7", "\1\2\3\4\5\6\7\4");
    EXPECT("difference, least and greatest", 3, 3, "\xfe\12\12\12\x40\x7f", "\12\12\12\10\10\10\11\11\11");
    EXPECT("difference of each channel", 2, 3, "\xfe\12\12\12\x6d", "\12\12\12\12\13\11");
    EXPECT("difference wraps round", 2, 3, "\x40\x7f", "\376\376\376\377\377\377");
    EXPECT("difference wraps round upwards", 2, 3, "\xfe\377\377\377\x7f", "\377\377\377\0\0\0");
    EXPECT("luma, least", 2, 3, "\xfe\144\144\144\x80\0", "\144\144\144\74\104\74");
    EXPECT("luma, greatest", 2, 3, "\xfe\144\144\144\xbf\xff", "\144\144\144\212\203\212");
    EXPECT("luma wraps round", 1, 3, "\x80\x8f", "\340\340\347");
    /* (3, 5, 7, 255) has the place (9 + 25 + 49 + 2805) % 64 = 8, (0, 0, 0, 0) the place 0 */
    EXPECT("index", 3, 3, "\xfe\3\5\7\xfe\1\1\1\x08", "\3\5\7\1\1\1\3\5\7");
    EXPECT("index of nothing seen", 2, 4, "\x05\x00", "\0\0\0\0\0\0\0\0");
    EXPECT("index of what a difference made", 4, 3, "\x6b\x6a\xfe\12\12\12\x3c", "\0\0\1\0\0\1\12\12\12\0\0\1");
    static const uint8_t black[62 * 3] = { 0 };
    EXPECT("the longest run", 62, 3, "\xfd", black);
    EXPECT("three channels from rgba", 2, 3, "\xff\1\2\3\4\xc0", "\1\2\3\1\2\3");
}

/* Random operations of every kind, whose pixels are worked out here from the page. */
static void random_operations(void)
{
    for (uint64_t k = 0; k < 400; k++) {
        static uint8_t operations[5 * 300], pixels[4 * 300 * 62];
        static uint8_t table[64][4];
        uint8_t now[4] = { 0, 0, 0, 255 };
        size_t size = 0, count = 0;
        uint64_t c = 0;
        memset(table, 0, sizeof table);
        while (size < 5 * 290 && count < 300 * 60) {
            uint8_t bytes[5];
            int length = 1, repeat = 1;
            for (int i = 0; i < 5; i++)
                bytes[i] = (uint8_t)(lom_random_bits(k, c++) >> 7);
            int kind = (int)(lom_random_bits(k, c++) % 6);
            if (kind == 0) { /* index */
                bytes[0] &= 63;
                memcpy(now, table[bytes[0]], 4);
            } else if (kind == 1) { /* difference: 2 bits each, 2 is none */
                bytes[0] = (uint8_t)(64 + bytes[0] % 64);
                for (int i = 0; i < 3; i++)
                    now[i] = (uint8_t)(now[i] + 254 + (bytes[0] >> (4 - 2 * i)) % 4);
            } else if (kind == 2) { /* luma: green 6 bits, 32 is none; red and blue more than green, 8 is none */
                length = 2;
                bytes[0] = (uint8_t)(128 + bytes[0] % 64);
                int green = bytes[0] % 64 - 32;
                now[0] = (uint8_t)(now[0] + green + bytes[1] / 16 - 8);
                now[1] = (uint8_t)(now[1] + green);
                now[2] = (uint8_t)(now[2] + green + bytes[1] % 16 - 8);
            } else if (kind == 3) { /* run */
                repeat = 1 + bytes[0] % 62;
                bytes[0] = (uint8_t)(192 + repeat - 1);
            } else { /* in full */
                length = kind;
                bytes[0] = (uint8_t)(250 + kind);
                length = kind == 4 ? 4 : 5;
                memcpy(now, bytes + 1, (size_t)length - 1);
            }
            memcpy(operations + size, bytes, (size_t)length);
            size += (size_t)length;
            memcpy(table[(now[0] * 3 + now[1] * 5 + now[2] * 7 + now[3] * 11) % 64], now, 4);
            for (int i = 0; i < repeat; i++)
                memcpy(pixels + 4 * count++, now, 4);
        }
        lom_error error = { 0 };
        lom_image *image = decode_operations((int)count, 1, 4, operations, size, &error);
        CHECK(image != NULL, "stream %d: %s", (int)k, error.text);
        CHECK(image == NULL || memcmp(image->pixels, pixels, 4 * count) == 0, "stream %d: other pixels", (int)k);
        lom_free_image(image);
    }
}

/* Pictures of every sort: noise, few colours, smooth, flat, thin, with any alpha. */
static lom_image *picture(lom_format format, int sort, int width, int height)
{
    lom_image *image = lom_create_image(width, height, 1, format, NULL);
    int channels = lom_describe_format(format)->channels;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < channels; c++) {
                uint64_t bits = lom_random_bits((uint64_t)sort, (uint64_t)((y * width + x) * 4 + c));
                uint64_t patch = lom_random_bits(77, (uint64_t)((y / 5 * 1000 + x / 9) % 7 * 4 + c));
                int smooth = x * 3 + y * 5 + c * 40, near = (int)(bits % 5);
                const int values[] = { (int)bits,
                                       (int)patch,
                                       smooth,
                                       smooth + near,
                                       0,
                                       255,
                                       (x + y) % 97 ? 9 : (int)bits,
                                       c == channels - 1 ? (int)(bits % 3) * 100 : (int)patch };
                *((uint8_t *)lom_image_pixel(image, x, y, 0) + c) = (uint8_t)values[sort];
            }
    return image;
}

/* Gray as three equal channels, as QOI holds it. */
static bool same_colors(const lom_image *image, const lom_image *back)
{
    int from = lom_describe_format(image->format)->channels, to = lom_describe_format(back->format)->channels;
    if (to != (from % 2 == 0 ? 4 : 3) || back->width != image->width || back->height != image->height)
        return false;
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++) {
            const uint8_t *a = lom_image_pixel(image, x, y, 0), *b = lom_image_pixel(back, x, y, 0);
            for (int c = 0; c < to; c++)
                if (b[c] != a[c == 3 ? from - 1 : from >= 3 ? c : 0])
                    return false;
        }
    return true;
}

/* No operation is longer than it need be, none is an index that repeats, and none relies on a run having put its pixel
 * among those seen: not all decoders do that. */
static void check_written(const lom_bytes *file, size_t count, int sort)
{
    uint8_t now[4] = { 0, 0, 0, 255 }, table[64][4] = { { 0 } };
    size_t at = 14, pixels = 0;
    int last = -1;
    while (pixels < count && at < file->size - 8) {
        const uint8_t *p = file->data + at;
        int kind = p[0] >= 254 ? p[0] : p[0] / 64, repeat = 1;
        uint8_t before[4];
        memcpy(before, now, 4);
        if (kind == 254 || kind == 255)
            memcpy(now, p + 1, kind == 255 ? 4 : 3);
        else if (kind == 0)
            memcpy(now, table[p[0]], 4);
        else if (kind == 1)
            for (int i = 0; i < 3; i++)
                now[i] = (uint8_t)(now[i] + 254 + (p[0] >> (4 - 2 * i)) % 4);
        else if (kind == 2)
            for (int i = 0; i < 3; i++)
                now[i] = (uint8_t)(now[i] + p[0] % 64 - 32 + (i == 0 ? p[1] / 16 - 8 : i == 2 ? p[1] % 16 - 8 : 0));
        else
            repeat = p[0] % 64 + 1;
        int slot = (now[0] * 3 + now[1] * 5 + now[2] * 7 + now[3] * 11) % 64;
        CHECK(kind == 3 || memcmp(now, before, 4) != 0, "sort %d: pixel %zu is no run", sort, pixels);
        CHECK(kind != 3 || last != 3 || file->data[at - 1] == 0xfd, "sort %d: a run was cut", sort);
        CHECK(kind == 0 || kind == 3 || memcmp(table[slot], now, 4) != 0, "sort %d: pixel %zu was seen", sort, pixels);
        CHECK(kind != 255 || before[3] != now[3], "sort %d: pixel %zu has the same alpha", sort, pixels);
        if (kind != 3)
            memcpy(table[slot], now, 4);
        last = kind;
        pixels += (size_t)repeat;
        at += kind == 255 ? 5 : kind == 254 ? 4 : kind == 2 ? 2 : 1;
    }
    CHECK(pixels == count && at == file->size - 8 && memcmp(file->data + at, end, 8) == 0, "sort %d: %zu of %zu", sort,
          pixels, count);
}

static void round_trips(void)
{
    static const lom_format formats[] = { LOM_FORMAT_R8,    LOM_FORMAT_RG8,       LOM_FORMAT_RGB8,
                                          LOM_FORMAT_RGBA8, LOM_FORMAT_RGB8_SRGB, LOM_FORMAT_RGBA8_SRGB };
    static const int sizes[][2] = { { 1, 1 }, { 1, 130 }, { 63, 1 }, { 62, 2 }, { 64, 33 }, { 211, 17 } };
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++)
        for (int sort = 0; sort < 8; sort++)
            for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
                lom_error error = { 0 };
                lom_image *image = picture(formats[f], sort, sizes[s][0], sizes[s][1]);
                lom_bytes qoi = lom_encode_image("qoi", image, &error), png = lom_encode_image("png", image, &error);
                lom_image *back = lom_decode_image(qoi.data, qoi.size, "t.qoi", &error);
                lom_image *other = lom_decode_image(png.data, png.size, "t.png", &error);
                CHECK(back != NULL && other != NULL && same_colors(image, back) && same_colors(other, back),
                      "format %d sort %d, %d x %d: %s", formats[f], sort, image->width, image->height, error.text);
                check_written(&qoi, (size_t)(image->width * image->height), sort);
                CHECK(qoi.data[12] == lom_describe_format(back->format)->channels && qoi.data[13] == 0, "flags");
                lom_bytes again = lom_encode_image("QOI", back, &error);
                CHECK(again.size == qoi.size && memcmp(again.data, qoi.data, qoi.size) == 0, "written differently");
                lom_release(again.data);
                lom_release(qoi.data);
                lom_release(png.data);
                lom_free_image(image);
                lom_free_image(back);
                lom_free_image(other);
            }
}

static void truncated_at_every_byte(void)
{
    for (int sort = 0; sort < 8; sort++) {
        lom_image *image = picture(LOM_FORMAT_RGBA8, sort, 9, 7);
        lom_bytes file = lom_encode_image("qoi", image, NULL);
        for (size_t size = 0; size < file.size; size++) {
            lom_error error = { 0 };
            uint8_t *exact = malloc(size + (size == 0));
            memcpy(exact, file.data, size);
            lom_image *cut = lom_decode_image(exact, size, "t", &error);
            CHECK(cut == NULL && error.code == LOM_ERROR_INPUT, "sort %d: %zu bytes were enough", sort, size);
            lom_free_image(cut);
            free(exact);
        }
        lom_release(file.data);
        lom_free_image(image);
    }
}

static void refusals(void)
{
    static const struct {
        int width, height, channels, space;
        const char *operations, *says;
    } cases[] = {
        { 2, 1, 3, 0, "\xc2", "a run goes beyond" },
        { 2, 1, 3, 0, "\xc0", "in the middle" },
        { 1, 1, 3, 0, "\xc0\xc0", "end marker" },
        { 1, 1, 2, 0, "\xc0", "3 or 4 channels" },
        { 1, 1, 5, 0, "\xc0", "3 or 4 channels" },
        { 1, 1, 4, 2, "\xc0", "colour spaces" },
        { 0, 1, 3, 0, "\xc0", "empty" },
        { 1, 0, 3, 0, "\xc0", "empty" },
        { 40000, 1, 3, 0, "\xc0", "pixels a side" },
        { 30000, 30000, 4, 0, "\xfd\xfd", "too short" },
        { 63, 1, 3, 0, "\xfd", "too short" },
        { 0x7fffffff, 0x7fffffff, 4, 0, "\xfd", "pixels a side" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        size_t size = strlen(cases[i].operations);
        uint8_t *file =
            file_of(cases[i].width, cases[i].height, cases[i].channels, cases[i].space, cases[i].operations, size);
        lom_image *image = lom_decode_image(file, 14 + size + 8, "t.qoi", &error);
        CHECK(image == NULL && strncmp(error.text, "t.qoi: ", 7) == 0 && strstr(error.text, cases[i].says) != NULL,
              "case %zu: %s", i, error.text);
        lom_free_image(image);
        free(file);
    }
    uint8_t *linear = file_of(1, 1, 3, 1, "\xc0", 1); /* what the samples mean changes none of them */
    lom_image *image = lom_decode_image(linear, 14 + 1 + 8, "t.qoi", NULL);
    CHECK(image != NULL && image->format == LOM_FORMAT_RGB8);
    lom_free_image(image);
    free(linear);
    static const lom_format others[] = { LOM_FORMAT_RGB16, LOM_FORMAT_RGB32F, LOM_FORMAT_DEPTH16 };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        lom_error error = { 0 };
        image = lom_create_image(1, 1, 1, others[i], NULL);
        CHECK(lom_encode_image("qoi", image, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
        lom_free_image(image);
    }
}

int main(int argc, char **argv)
{
    RUN(operations_by_hand);
    RUN(random_operations);
    RUN(round_trips);
    RUN(truncated_at_every_byte);
    RUN(refusals);
    return check_result();
}
