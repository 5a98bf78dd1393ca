/* PNM, PAM, PFM and Y4M. Oracles: files written by hand, whose pixels are known; the netpbm pages; the formulas of
 * BT.601 in double. Proves: all kinds are read, every maximum is scaled to the nearest; what is written is read back;
 * damage and large declarations are errors. */
#include "check.h"

#include <lom/image.h>

#include <math.h>
#include <sys/resource.h>

#define DECODE(literal, error) lom_decode_image((const uint8_t *)(literal), sizeof(literal) - 1, "t.pnm", error)

static void expect_8(const char *file, size_t size, lom_format format, int width, int height, const char *pixels)
{
    lom_error error = { 0 };
    lom_image *image = lom_decode_image((const uint8_t *)file, size, "t.pnm", &error);
    CHECK(image != NULL, "%.20s: %s", file, error.text);
    if (image == NULL)
        return;
    CHECK(image->format == format && image->width == width && image->height == height, "%.20s: format %d, %d x %d",
          file, image->format, image->width, image->height);
    CHECK(memcmp(image->pixels, pixels, lom_image_size(image)) == 0, "%.20s: other pixels", file);
    lom_free_image(image);
}

#define EXPECT_8(file, format, width, height, pixels) expect_8(file, sizeof(file) - 1, format, width, height, pixels)

static void by_hand(void)
{
    EXPECT_8("P1\n# a comment\n3 2\n1 0 1\n0 1 0\n", LOM_FORMAT_R8, 3, 2, "\0\377\0\377\0\377");
    EXPECT_8("P1 3 2 101010", LOM_FORMAT_R8, 3, 2, "\0\377\0\377\0\377");
    EXPECT_8("P2\n2 2\n255\n0 1\n254 255", LOM_FORMAT_R8, 2, 2, "\0\1\376\377");
    EXPECT_8("P2 2 1 15 # depth 4\n7 15\n", LOM_FORMAT_R8, 2, 1, "\167\377");
    EXPECT_8("P3\n1 2\n255\n1 2 3\n4 5 6\n", LOM_FORMAT_RGB8, 1, 2, "\1\2\3\4\5\6");
    EXPECT_8("P4\n10 2\n\xaa\x80\x55\x40", LOM_FORMAT_R8, 10, 2,
             "\0\377\0\377\0\377\0\377\0\377\377\0\377\0\377\0\377\0\377\0");
    EXPECT_8("P5 2 1 255\n\1\377", LOM_FORMAT_R8, 2, 1, "\1\377");
    EXPECT_8("P5 2 1 255\n\1\377and another picture", LOM_FORMAT_R8, 2, 1, "\1\377");
    EXPECT_8("P5 2 1 1\n\0\1", LOM_FORMAT_R8, 2, 1, "\0\377");
    EXPECT_8("P6\r\n1 1\r255\n#23", LOM_FORMAT_RGB8, 1, 1, "#23"); /* no comment behind the header */
    EXPECT_8("P7\nWIDTH 1\nHEIGHT 2\n# c\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\nabcdefgh", LOM_FORMAT_RGBA8,
             1, 2, "abcdefgh");
    EXPECT_8("P7\nDEPTH 2\nMAXVAL 255\nHEIGHT 1\nWIDTH 1\nENDHDR\nab", LOM_FORMAT_RG8, 1, 1, "ab");
}

/* netpbm's pages: white space or a comment behind the kind; one white space before the raster, whatever it is; a file
 * whose lines end with a carriage return and a newline has both there, which its size tells. PAM: lines, "P7" and
 * "ENDHDR" alone on theirs. */
static void header_forms(void)
{
    EXPECT_8("P5#comment\n2 1 255\nab", LOM_FORMAT_R8, 2, 1, "ab");
    EXPECT_8("P5 2 1 255# comment\nab", LOM_FORMAT_R8, 2, 1, "ab");
    EXPECT_8("P5 2#c\n 1 255\tab", LOM_FORMAT_R8, 2, 1, "ab");
    EXPECT_8("P5\r\n2 1\r\n255\r\nab", LOM_FORMAT_R8, 2, 1, "ab");
    EXPECT_8("P5\r\n2 1\r\n255\r\na", LOM_FORMAT_R8, 2, 1, "\na");
    EXPECT_8("P5\r2 1\r255\rab", LOM_FORMAT_R8, 2, 1, "ab");
    EXPECT_8("P5 2 1 255\n\na", LOM_FORMAT_R8, 2, 1, "\na");
    EXPECT_8("P6\r\n1 1\r\n255\r\nabc", LOM_FORMAT_RGB8, 1, 1, "abc");
    EXPECT_8("P4\r\n8 1\r\n\xf0", LOM_FORMAT_R8, 8, 1, "\0\0\0\0\377\377\377\377");
    EXPECT_8("P2\r\n2 1\r\n255\r\n1 2\r\n", LOM_FORMAT_R8, 2, 1, "\1\2");
    EXPECT_8("P7\r\nWIDTH 2\r\nHEIGHT 1\r\nDEPTH 1\r\nMAXVAL 255\r\nENDHDR\r\nab", LOM_FORMAT_R8, 2, 1, "ab");
    EXPECT_8("P7 \n\n \t\nWIDTH\t 2 \n  HEIGHT 1\n # WIDTH 3\nDEPTH 1\nMAXVAL 255\nENDHDR \t\nab", LOM_FORMAT_R8, 2, 1,
             "ab");
    EXPECT_8("P7\nWIDTH 2\nHEIGHT 1\nDEPTH 1\nMAXVAL 1\nTUPLTYPE BLACKANDWHITE\nENDHDR\n\0\1", LOM_FORMAT_R8, 2, 1,
             "\0\377");
    EXPECT_8("P7\nWIDTH 2\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\nTUPLTYPE height\nENDHDR\nab", LOM_FORMAT_R8, 2, 1, "ab");
    static const struct {
        const char *file, *says;
    } bad[] = {
#define PAM(fields) "P7\nWIDTH 1\nHEIGHT 1\n" fields "\nENDHDR\nabcd"
        { "P612 2 255 abcdefgh", "white space" },
        { "P5x2 1 255 ab", "white space" },
        { "P12 1 1 1", "white space" },
        { "PF4\n1 1\n-1\nabcdefghijklmnop", "white space" },
        { "Pf2\n1 1\n-1\nabcdefgh", "white space" },
        { "P7 332\n2 1 255\nab", "P7 alone" },
        { "P7#\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\nENDHDR\na", "P7 alone" },
        { "P72\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\nENDHDR\na", "P7 alone" },
        { PAM("DEPTH 4\nMAXVAL 255\nTUPLTYPE CMYK"), "CMYK" },
        { PAM("DEPTH 4\nMAXVAL 255\nTUPLTYPE RGB"), "RGB" },
        { PAM("DEPTH 3\nMAXVAL 255\nTUPLTYPE RGB_ALPHA"), "RGB_ALPHA" },
        { PAM("DEPTH 3\nMAXVAL 255\nTUPLTYPE RGB\nTUPLTYPE RGB"), "RGB" },
        { PAM("DEPTH 1\nMAXVAL 255 255"), "MAXVAL should" },
        { PAM("DEPTH 1 MAXVAL 255"), "DEPTH should" },
        { PAM("DEPTH\n1\nMAXVAL 255"), "DEPTH should" },
        { PAM("DEPTH 0x1\nMAXVAL 255"), "DEPTH should" },
        { PAM("DEPTH 1\nMAXVAL 255\nWIDTH 1"), "again" },
        { PAM("DEPTH 1\nMAXVAL 255\nENDHDR now"), "none of a PAM header" },
        { PAM("DEPTH 1\nMAXVAL 255\nendhdr"), "none of a PAM header" },
#undef PAM
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        lom_error error = { 0 };
        lom_image *image = lom_decode_image((const uint8_t *)bad[i].file, strlen(bad[i].file), "t.pnm", &error);
        CHECK(image == NULL && strstr(error.text, bad[i].says) != NULL, "%s: %s", bad[i].file, error.text);
        lom_free_image(image);
    }
    lom_image *image = DECODE("Pf\r\n1 1\r\n-1.0\r\n\0\0\200\77", NULL);
    CHECK(image != NULL && *(float *)(void *)image->pixels == 1, "PFM with carriage returns");
    lom_free_image(image);
}

static void every_maximum(void)
{
    uint8_t file[64];
    for (unsigned maximum = 1; maximum < 65536; maximum += maximum < 300 ? 1 : 97) {
        unsigned full = maximum < 256 ? 255 : 65535;
        for (int trial = 0; trial < 8; trial++) {
            unsigned value = trial == 0   ? 0
                             : trial == 1 ? maximum
                                          : (unsigned)(lom_random_bits(maximum, (uint64_t)trial) % (maximum + 1));
            int length = snprintf((char *)file, sizeof file, "P5 1 1 %u\n", maximum);
            if (maximum > 255)
                file[length++] = (uint8_t)(value >> 8);
            file[length++] = (uint8_t)value;
            lom_error error = { 0 };
            lom_image *image = lom_decode_image(file, (size_t)length, "t", &error);
            CHECK(image != NULL, "%s", error.text);
            if (image == NULL)
                continue;
            uint16_t wide;
            memcpy(&wide, image->pixels, full > 255 ? 2 : 1);
            double exact = (double)value * full / maximum, got = full > 255 ? wide : image->pixels[0];
            CHECK(fabs(got - exact) <= 0.5, "%u of %u is %g, not %g", value, maximum, got, exact);
            lom_free_image(image);
        }
    }
}

static lom_image *noise(int width, int height, lom_format format)
{
    lom_image *image = lom_create_image(width, height, 1, format, NULL);
    for (size_t i = 0; i < lom_image_size(image); i++)
        image->pixels[i] = (uint8_t)lom_random_bits((uint64_t)format, i);
    return image;
}

static void round_trips(void)
{
    static const struct {
        const char *kind;
        lom_format from, to;
    } cases[] = {
        { "pgm", LOM_FORMAT_R8, LOM_FORMAT_R8 },         { "pgm", LOM_FORMAT_R16, LOM_FORMAT_R16 },
        { "ppm", LOM_FORMAT_RGB8, LOM_FORMAT_RGB8 },     { "ppm", LOM_FORMAT_RGB16, LOM_FORMAT_RGB16 },
        { "pam", LOM_FORMAT_R8, LOM_FORMAT_R8 },         { "pam", LOM_FORMAT_RG8, LOM_FORMAT_RG8 },
        { "pam", LOM_FORMAT_RGB16, LOM_FORMAT_RGB16 },   { "pam", LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA8 },
        { "pam", LOM_FORMAT_RGBA16, LOM_FORMAT_RGBA16 }, { "pfm", LOM_FORMAT_R32F, LOM_FORMAT_R32F },
        { "pfm", LOM_FORMAT_RGB32F, LOM_FORMAT_RGB32F }, { "pfm", LOM_FORMAT_DEPTH32F, LOM_FORMAT_R32F },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        lom_image *image = noise(13, 7, cases[i].from);
        lom_bytes file = lom_encode_image(cases[i].kind, image, &error);
        lom_image *back = lom_decode_image(file.data, file.size, "t", &error);
        CHECK(back != NULL && back->format == cases[i].to, "case %zu: %s", i, error.text);
        CHECK(back != NULL && memcmp(back->pixels, image->pixels, lom_image_size(image)) == 0, "case %zu", i);
        for (size_t size = 0; size < file.size; size++) {
            lom_error cut = { 0 };
            uint8_t *exact = lom_allocate(size, 1, NULL);
            memcpy(exact, file.data, size);
            CHECK(lom_decode_image(exact, size, "t", &cut) == NULL && cut.code == LOM_ERROR_INPUT,
                  "case %zu, %zu bytes", i, size);
            lom_release(exact);
        }
        lom_release(file.data);
        lom_free_image(back);
        lom_free_image(image);
    }
}

static void dropped_and_replicated(void)
{
    static const struct {
        const char *kind;
        lom_format from;
        const char *file;
        size_t size;
    } cases[] = {
        { "ppm", LOM_FORMAT_RGBA8, "P6\n1 2\n255\n\1\2\3\5\6\7", 17 },
        { "ppm", LOM_FORMAT_R8, "P6\n1 2\n255\n\1\1\1\2\2\2", 17 },
        { "ppm", LOM_FORMAT_RG8, "P6\n1 2\n255\n\1\1\1\3\3\3", 17 },
        { "pgm", LOM_FORMAT_RG8, "P5\n1 2\n255\n\1\3", 13 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_image *image = lom_create_image(1, 2, 1, cases[i].from, NULL);
        for (size_t j = 0; j < lom_image_size(image); j++)
            image->pixels[j] = (uint8_t)(j + 1);
        lom_bytes file = lom_encode_image(cases[i].kind, image, NULL);
        CHECK(file.size == cases[i].size && memcmp(file.data, cases[i].file, file.size) == 0, "case %zu: %zu bytes", i,
              file.size);
        lom_release(file.data);
        lom_free_image(image);
    }
    lom_error error = { 0 };
    lom_image *image = noise(2, 2, LOM_FORMAT_RGB8);
    CHECK(lom_encode_image("pgm", image, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(lom_encode_image("pfm", image, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(lom_encode_image("gif", image, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(!lom_write_image("/nowhere/noextension", NULL, image, &error) && error.code == LOM_ERROR_USAGE, "%s",
          error.text);
    lom_free_image(image);
}

static void pfm_orders(void)
{
    static const char little[] = "Pf\n1 2\n-1.0\n\0\0\200\77\0\0\0\100", big[] = "Pf 1 2 1e0\n\77\200\0\0\100\0\0\0";
    const char *files[] = { little, big };
    const size_t sizes[] = { sizeof little - 1, sizeof big - 1 };
    for (int i = 0; i < 2; i++) {
        lom_error error = { 0 };
        lom_image *image = lom_decode_image((const uint8_t *)files[i], sizes[i], "t", &error);
        CHECK(image != NULL && image->format == LOM_FORMAT_R32F, "%s", error.text);
        if (image == NULL)
            continue;
        float rows[2];
        memcpy(rows, image->pixels, sizeof rows);
        CHECK(rows[0] == 2 && rows[1] == 1, "the bottom row is first in the file: %g %g", rows[0], rows[1]);
        lom_free_image(image);
    }
}

/* Files of every kind, cut after each byte and with each bit flipped: a picture, or an error with the name. A file of
 * raw samples that was cut is never a picture. */
static void damaged_anywhere(void)
{
    static const struct {
        const char *bytes;
        size_t size;
        bool raw;
    } files[] = {
#define FILE_OF(text, raw) { text, sizeof text - 1, raw }
        FILE_OF("P1 # c\n3 2\n1 0 1\n0 1 0\n", false),
        FILE_OF("P2 3 2 15\n1 2 3\n15 0 7\n", false),
        FILE_OF("P3 1 2 255\n1 2 3\n250 0 7\n", false),
        FILE_OF("P4 9 2\n\xaa\x80\x55\x00", true),
        FILE_OF("P5 3 2 255\nabcdef", true),
        FILE_OF("P5 2 1 4000\n\x01\x02\x03\x04", true),
        FILE_OF("P6 1 2 255\nabcdef", true),
        FILE_OF("P7\nWIDTH 2\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\nabcdefgh", true),
        FILE_OF("Pf 2 1 -1\nabcdefgh", true),
        FILE_OF("PF 1 1 1\nabcdefghijkl", true),
#undef FILE_OF
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        for (size_t k = 0; k < files[i].size * 9; k++) {
            lom_error error = { 0 };
            size_t size = k < files[i].size ? k : files[i].size;
            uint8_t *exact = lom_allocate(files[i].size, 1, NULL);
            memcpy(exact, files[i].bytes, files[i].size);
            if (k >= files[i].size)
                exact[(k - files[i].size) / 8] ^= (uint8_t)(1 << (k - files[i].size) % 8);
            uint8_t *cut = malloc(size + (size == 0)); /* a read behind the end is caught */
            memcpy(cut, exact, size);
            lom_image *image = lom_decode_image(cut, size, "t", &error);
            CHECK((image != NULL) == (error.code == LOM_OK), "file %zu, damage %zu: code %d", i, k, error.code);
            CHECK(image != NULL || strncmp(error.text, "t: ", 3) == 0, "file %zu: %s", i, error.text);
            CHECK(image == NULL || !files[i].raw || size == files[i].size, "file %zu, %zu bytes: taken", i, size);
            lom_free_image(image);
            lom_release(exact);
            free(cut);
        }
}

static void malformed(void)
{
    static const char *const files[] = {
        "",
        "P",
        "P1",
        "P0 1 1\n0",
        "P8 1 1\n0",
        "P5",
        "P5 ",
        "P5 1",
        "P5 1 1",
        "P5 1 1 255",
        "P5 x 1 255\n1",
        "P5 1 1 0\n1",
        "P5 1 1 65536\n11",
        "P5 -1 1 255\n1",
        "P5 0 1 255\n1",
        "P5 1 0 255\n1",
        "P5 99999999999999999999 1 255\n1",
        "P5 1 1 255x1",
        "P5 2 1 100\n\144\145",
        "P2 1 1 7\n8",
        "P2 2 1 255\n1",
        "P2 2 1 255\n1 x",
        "P1 2 1\n1 2",
        "P1 2 1\n1",
        "P3 1 1 255\n1 2",
        "P4 9 1\n1",
        "P4 8 2\n1",
        "P4 17 3\n12345678",
        "P6 1 1 255\n12",
        "P5 #",
        "P5 # comment without end",
        "P2 1 1 255 1#",
        "P7",
        "P7\nWIDTH 1\n",
        "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\n1",
        "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 5\nMAXVAL 255\nENDHDR\n12345",
        "P7\nWIDTH 1\nHEIGHT 1\nMAXVAL 255\nENDHDR\n1",
        "P7\nNONSENSE 1\nENDHDR\n",
        "P7\nENDHDR\n1",
        "P7\nENDHDR",
        "P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nENDHDR\n1",
        "PF",
        "Pf 1 1 0\n1234",
        "Pf 1 1 x\n1234",
        "Pf 1 1 -1\n123",
        "Pf 1 1 nan\n1234",
        "PF 1 1 -1\n12345678901",
        "Pf 1 1 -1",
        "\x89PNG\r\n\x1a",
        "\x89PNG\r\n\x1a\n",
        "GIF89a",
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        lom_error error = { 0 };
        size_t size = strlen(files[i]);
        uint8_t *exact = lom_allocate(size, 1, NULL);
        memcpy(exact, files[i], size);
        lom_image *image = lom_decode_image(exact, size, "t", &error);
        bool refused = image == NULL && error.code == LOM_ERROR_INPUT && strncmp(error.text, "t: ", 3) == 0;
        if (strcmp(files[i], "P2 1 1 255 1#") != 0)
            CHECK(refused, "%s: code %d: %s", files[i], error.code, error.text);
        lom_free_image(image);
        lom_release(exact);
    }
}

static void huge_declarations(void)
{
    static const struct {
        const char *file;
        lom_code code;
    } cases[] = {
        { "P6 32768 32768 65535\n", LOM_ERROR_INPUT },
        { "P6 32769 1 255\n", LOM_ERROR_LIMIT },
        { "P1 32768 32768\n1", LOM_ERROR_INPUT },
        { "P4 32768 32768\n1", LOM_ERROR_INPUT },
        { "P2 30000 30000 255\n1 2", LOM_ERROR_INPUT },
        { "PF 1000000000 1000000000 -1\n", LOM_ERROR_LIMIT },
        { "PF 32768 32768 -1\n", LOM_ERROR_INPUT },
        { "P7\nWIDTH 32768\nHEIGHT 32768\nDEPTH 4\nMAXVAL 65535\nENDHDR\n", LOM_ERROR_INPUT },
    };
    struct rusage before, after;
    getrusage(RUSAGE_SELF, &before);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        lom_image *image = lom_decode_image((const uint8_t *)cases[i].file, strlen(cases[i].file), "t", &error);
        CHECK(image == NULL && error.code == cases[i].code, "%s: code %d", cases[i].file, error.code);
        lom_free_image(image);
    }
    getrusage(RUSAGE_SELF, &after);
    CHECK(after.ru_maxrss - before.ru_maxrss < 10000, "%ld KiB were used", after.ru_maxrss - before.ru_maxrss);
}

/* Each kind holds 8 or 16 bits a sample and no floats, PGM no colours; what it does not hold is an error. */
static void what_does_not_fit_is_refused(void)
{
    static const char *const kinds[] = { "ppm", "pgm", "pam" };
    for (int i = 0; i < 3; i++)
        for (lom_format f = LOM_FORMAT_R8; f < LOM_FORMAT_COUNT; f++) {
            const lom_format_info *info = lom_describe_format(f);
            bool fits = !info->is_float && f != LOM_FORMAT_DEPTH24 && (i != 1 || info->channels < 3);
            lom_error error = { 0 };
            lom_image *image = lom_create_image(3, 2, 1, f, NULL);
            lom_bytes file = lom_encode_image(kinds[i], image, &error);
            CHECK((file.data != NULL) == fits, "%s of %s: %s", kinds[i], info->name, error.text);
            CHECK(fits || error.code == LOM_ERROR_USAGE, "%s of %s: code %d", kinds[i], info->name, error.code);
            lom_release(file.data);
            lom_free_image(image);
        }
}

static void y4m(void)
{
    lom_error error = { 0 };
    lom_bytes header = lom_encode_y4m_header(320, 240, 30, 1, &error);
    CHECK(header.size == 39 && memcmp(header.data, "YUV4MPEG2 W320 H240 F30:1 Ip A1:1 C444\n", 39) == 0, "%s",
          header.data);
    lom_release(header.data);
    lom_image *image = lom_create_image(256, 256, 1, LOM_FORMAT_RGB8, NULL);
    for (int slice = 0; slice < 256; slice += 5) {
        for (int i = 0; i < 65536; i++)
            memcpy(image->pixels + 3 * i, (uint8_t[3]){ (uint8_t)slice, (uint8_t)(i >> 8), (uint8_t)i }, 3);
        lom_bytes frame = lom_encode_y4m_frame(image, &error);
        CHECK(frame.size == 6 + 3 * 65536 && memcmp(frame.data, "FRAME\n", 6) == 0, "%s", error.text);
        for (int i = 0; i < 65536; i++) {
            double r = slice / 255.0, g = (i >> 8) / 255.0, b = (i & 255) / 255.0,
                   e = 0.299 * r + 0.587 * g + 0.114 * b;
            double exact[3] = { 16 + 219 * e, 128 + 224 * (b - e) / 1.772, 128 + 224 * (r - e) / 1.402 };
            for (int c = 0; c < 3; c++)
                CHECK(fabs(frame.data[6 + c * 65536 + i] - exact[c]) <= 0.5 + 1e-9, "%d %d: %d, not %g", slice, i,
                      frame.data[6 + c * 65536 + i], exact[c]);
        }
        lom_release(frame.data);
    }
    lom_free_image(image);
    image = noise(5, 3, LOM_FORMAT_R8); /* gray has no colour */
    lom_bytes frame = lom_encode_y4m_frame(image, &error);
    for (int i = 0; i < 30; i++)
        CHECK(frame.data[6 + 15 + i] == 128, "chroma %d", frame.data[6 + 15 + i]);
    lom_release(frame.data);
    lom_free_image(image);
    image = noise(5, 3, LOM_FORMAT_RGB16);
    CHECK(lom_encode_y4m_frame(image, &error).data == NULL && error.code == LOM_ERROR_USAGE, "16 bits");
    CHECK(lom_encode_y4m_header(0, 1, 30, 1, NULL).data == NULL && lom_encode_y4m_header(1, 1, 0, 1, NULL).data == NULL,
          "0");
    lom_free_image(image);
}

int main(int argc, char **argv)
{
    RUN(by_hand);
    RUN(header_forms);
    RUN(every_maximum);
    RUN(round_trips);
    RUN(dropped_and_replicated);
    RUN(pfm_orders);
    RUN(malformed);
    RUN(damaged_anywhere);
    RUN(huge_declarations);
    RUN(what_does_not_fit_is_refused);
    RUN(y4m);
    return check_result();
}
