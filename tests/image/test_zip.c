/* Compression. Oracles: streams made by zlib (embedded), published checksums, the definition of a prefix code; and,
 * from test_zip.sh, python's zlib on many more. Proves: every kind of block is read; what we compress decompresses to
 * itself; damage of any byte or bit is an error or changes nothing, never a crash; limits hold; the size is close to
 * zlib's. With arguments "--tool NAME" it is the program that test_zip.sh drives: standard input to standard output. */
#include "check.h"

#include <lom/base.h>

#include "image/huffman.h"
#include "image/zip.h"

enum { EFFORT = 8 };

/* zlib.compress(b"hello hello hello hello, lom!") at level 9 (fixed codes), level 0 (stored); gzip of "a" with a name
 */
static const uint8_t fixed_stream[] = { 0x78, 0xda, 0xcb, 0x48, 0xcd, 0xc9, 0xc9, 0x57, 0xc8, 0x40, 0x27,
                                        0x75, 0x14, 0x72, 0xf2, 0x73, 0x15, 0x01, 0xa1, 0xc9, 0x0a, 0x66 };
static const char hello[] = "hello hello hello hello, lom!";

static void checksums(void)
{
    static uint8_t data[100000];
    CHECK(lom_crc32(0, "123456789", 9) == 0xcbf43926, "%08x", lom_crc32(0, "123456789", 9));
    CHECK(lom_adler32(1, "Wikipedia", 9) == 0x11e60398, "%08x", lom_adler32(1, "Wikipedia", 9));
    CHECK(lom_crc32(0, NULL, 0) == 0 && lom_adler32(1, NULL, 0) == 1, "empty");
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (uint8_t)lom_random_bits(1, i);
    memset(data + 50000, 255, 30000); /* the largest sums */
    uint32_t crc = 0, adler = 1, a = 1, b = 0;
    for (size_t i = 0; i < sizeof data; i++) { /* byte after byte: the small paths and the definition */
        crc = lom_crc32(crc, data + i, 1);
        adler = lom_adler32(adler, data + i, 1);
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    CHECK(crc == lom_crc32(0, data, sizeof data), "CRC of slices");
    CHECK(adler == (b << 16 | a) && adler == lom_adler32(1, data, sizeof data), "Adler of blocks");
    CHECK(crc == lom_crc32(lom_crc32(0, data, 33333), data + 33333, sizeof data - 33333), "in two parts");
}

static void known_streams(void)
{
    uint8_t out[64];
    lom_error error = { 0 };
    size_t length = sizeof hello - 1;
    CHECK(lom_inflate_zlib("t", fixed_stream, sizeof fixed_stream, out, length, &error), "%s", error.text);
    CHECK(memcmp(out, hello, length) == 0, "wrong text");
    CHECK(!lom_inflate_zlib("t", fixed_stream, sizeof fixed_stream, out, length + 1, &error), "one byte too few");
    error = (lom_error){ 0 };
    CHECK(!lom_inflate_zlib("t", fixed_stream, sizeof fixed_stream, out, length - 1, &error), "one byte too many");
    CHECK(error.code == LOM_ERROR_LIMIT, "code %d", error.code);
    static const uint8_t stored[] = { 0x78, 0x01, 0x01, 0x03, 0x00, 0xfc, 0xff, 'a', 'b', 'c', 0x02, 0x4d, 0x01, 0x27 };
    error = (lom_error){ 0 };
    CHECK(lom_inflate_zlib("t", stored, sizeof stored, out, 3, &error) && memcmp(out, "abc", 3) == 0, "%s", error.text);
    static const uint8_t empty[] = { 0x78, 0x9c, 0x03, 0x00, 0x00, 0x00, 0x00, 0x01 };
    CHECK(lom_inflate_zlib("t", empty, sizeof empty, out, 0, &error), "%s", error.text);
}

/* Test data by kind; what a picture's rows look like and what they do not. */
static size_t make_data(int kind, uint8_t *data, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        uint64_t r = lom_random_bits((uint64_t)kind, i);
        switch (kind) {
        case 0:
            data[i] = 0;
            break;
        case 1:
            data[i] = (uint8_t)r;
            break;
        case 2:
            data[i] = (uint8_t)(r % 4);
            break;
        case 3:
            data[i] = (uint8_t)(i % 251);
            break;
        case 4:
            data[i] = "the quick brown fox jumps over the lazy dog. "[i % 45 ^ (r % 64 == 0)];
            break;
        case 5:
            data[i] = i > 40000 ? data[i - 32768] : (uint8_t)r;
            break; /* the farthest distance */
        case 6:
            data[i] = i > 40000 ? data[i - 32769] : (uint8_t)r;
            break; /* one farther */
        case 7:
            data[i] = (uint8_t)(__builtin_ctzll(r | 1 << 20) * 3);
            break; /* geometric: long codes */
        default:
            data[i] = r % 300 < 299 && i >= 1000 ? data[i - 1 - (size_t)(i / 977 % 999)] : (uint8_t)r;
            break;
        }
    }
    return size;
}

static void round_trips(void)
{
    enum { MOST = 400000, KINDS = 9 };
    static uint8_t data[MOST], back[MOST];
    static const size_t sizes[] = { 0, 1, 2, 3, 4, 5, 258, 259, 65535, 65536, MOST };
    for (int kind = 0; kind < KINDS; kind++) {
        make_data(kind, data, MOST);
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            lom_error error = { 0 };
            size_t size = sizes[i];
            lom_bytes zlib = lom_deflate_zlib(data, size, kind % 2 ? EFFORT : 64, &error);
            memset(back, 0xaa, size);
            CHECK(zlib.data != NULL && lom_inflate_zlib("t", zlib.data, zlib.size, back, size, &error), "%s",
                  error.text);
            CHECK(memcmp(data, back, size) == 0, "kind %d, %zu bytes", kind, size);
            CHECK(zlib.size <= size + size / 10000 + 32, "kind %d, %zu bytes became %zu", kind, size, zlib.size);
            lom_bytes gzip = lom_deflate_gzip(data, size, 1, &error);
            lom_bytes plain = lom_inflate_gzip("t", gzip.data, gzip.size, size, &error);
            CHECK(plain.data != NULL && plain.size == size && memcmp(plain.data, data, size) == 0, "%s", error.text);
            lom_release(plain.data);
            lom_release(gzip.data);
            lom_release(zlib.data);
        }
    }
}

/* One stream through both loops: everything that comes out must be the same. */
static void check_loops(const uint8_t *data, size_t size, size_t room, size_t limit, const char *what, uint64_t place)
{
    lom_inflated out[2] = { { .limit = limit }, { .limit = limit, .plain = true } };
    lom_error error[2] = { { 0 }, { 0 } };
    size_t at[2] = { 0, 0 };
    bool good[2];
    for (int i = 0; i < 2; i++) {
        out[i].data = lom_allocate(room, 1, NULL);
        out[i].capacity = room;
        good[i] = lom_inflate("t", data, size, &at[i], 0, &out[i], &error[i]);
    }
    CHECK(good[0] == good[1] && at[0] == at[1] && strcmp(error[0].text, error[1].text) == 0, "%s %llu: \"%s\", \"%s\"",
          what, (unsigned long long)place, error[0].text, error[1].text);
    CHECK(out[0].size == out[1].size && memcmp(out[0].data, out[1].data, out[0].size) == 0, "%s %llu", what,
          (unsigned long long)place);
    lom_release(out[0].data);
    lom_release(out[1].data);
}

/* The fast loop against the plain one: whole streams with exact and with growing room, streams cut anywhere, limits
 * within them, and flipped bits. */
static void fast_is_plain(void)
{
    enum { MOST = 120000, PART = 4000 };
    static uint8_t data[MOST];
    for (int kind = 0; kind < 9; kind++) {
        make_data(kind, data, MOST);
        lom_bytes large = lom_deflate_zlib(data, MOST, 64, NULL), part = lom_deflate_zlib(data, PART, EFFORT, NULL);
        const uint8_t *stream = part.data + 2; /* behind zlib's header */
        check_loops(large.data + 2, large.size - 2, MOST, MOST, "whole", (uint64_t)kind);
        check_loops(large.data + 2, large.size - 2, 1, 2 * MOST, "growing", (uint64_t)kind);
        check_loops(large.data + 2, large.size - 2, 1, MOST - 1, "limited", (uint64_t)kind);
        for (size_t size = 0; size < part.size - 2; size += 1 + size / 300)
            check_loops(stream, size, PART, PART, "cut", size);
        for (size_t room = 1; room <= PART; room += 1 + room / 7)
            check_loops(stream, part.size - 2, room, room, "room", room);
        for (uint64_t i = 0; i < 500; i++) {
            size_t bit = (size_t)(lom_random_bits(123, i) % ((part.size - 2) * 8));
            part.data[2 + bit / 8] ^= (uint8_t)(1 << bit % 8);
            check_loops(stream, part.size - 2, PART, PART, "bit", bit);
            part.data[2 + bit / 8] ^= (uint8_t)(1 << bit % 8);
        }
        lom_release(part.data);
        lom_release(large.data);
    }
}

static void every_small_input(void)
{
    uint8_t data[12], back[12];
    for (uint64_t i = 0; i < 3000; i++) {
        size_t size = i % 12;
        for (size_t j = 0; j < size; j++)
            data[j] = (uint8_t)(lom_random_bits(9, i) >> (5 * j) & (i % 3));
        lom_error error = { 0 };
        lom_bytes zlib = lom_deflate_zlib(data, size, EFFORT, &error);
        CHECK(lom_inflate_zlib("t", zlib.data, zlib.size, back, size, &error) && memcmp(back, data, size) == 0, "%s",
              error.text);
        lom_release(zlib.data);
    }
}

static void huffman_codes(void)
{
    uint32_t counts[LOM_HUFFMAN_SYMBOLS] = { 0 }, fibonacci[2] = { 1, 1 };
    uint8_t lengths[LOM_HUFFMAN_SYMBOLS];
    for (int i = 0; i < 40; i++) { /* Fibonacci counts give the longest codes there are */
        counts[i] = fibonacci[0];
        uint32_t next = fibonacci[0] + fibonacci[1];
        fibonacci[0] = fibonacci[1];
        fibonacci[1] = next;
    }
    for (int limit = 7; limit <= 15; limit += 8) {
        lom_huffman_lengths(counts, LOM_HUFFMAN_SYMBOLS, limit, lengths);
        uint32_t kraft = 0;
        for (int i = 0; i < LOM_HUFFMAN_SYMBOLS; i++) {
            CHECK(lengths[i] <= limit && (lengths[i] != 0) == (counts[i] != 0), "symbol %d: %d bits", i, lengths[i]);
            kraft += lengths[i] != 0 ? 32768u >> lengths[i] : 0;
        }
        CHECK(kraft == 32768, "the code is not complete: %u", kraft);
    }
    memset(counts, 0, sizeof counts);
    counts[100] = 5;
    lom_huffman_lengths(counts, LOM_HUFFMAN_SYMBOLS, 15, lengths);
    CHECK(lengths[0] == 1 && lengths[100] == 1, "one used symbol gets a partner");
}

static void truncations(void)
{
    static uint8_t data[5000], back[5000];
    for (int kind = 0; kind < 9; kind++) {
        make_data(kind, data, sizeof data);
        lom_bytes zlib = lom_deflate_zlib(data, sizeof data, EFFORT, NULL);
        lom_bytes gzip = lom_deflate_gzip(data, sizeof data, EFFORT, NULL);
        for (size_t size = 0; size < zlib.size; size++) {
            lom_error error = { 0 };
            uint8_t *exact = lom_allocate(size, 1, NULL); /* so that a sanitizer sees reads behind the end */
            memcpy(exact, zlib.data, size);
            CHECK(!lom_inflate_zlib("t", exact, size, back, sizeof back, &error), "kind %d, %zu bytes", kind, size);
            CHECK(error.code == LOM_ERROR_INPUT, "code %d: %s", error.code, error.text);
            lom_release(exact);
        }
        for (size_t size = 0; size < gzip.size; size++) {
            lom_error error = { 0 };
            CHECK(lom_inflate_gzip("t", gzip.data, size, 1 << 20, &error).data == NULL, "%zu bytes", size);
            CHECK(error.code == LOM_ERROR_INPUT, "code %d: %s", error.code, error.text);
        }
        lom_release(zlib.data);
        lom_release(gzip.data);
    }
}

static void damage(void)
{
    static uint8_t data[3000];
    for (int kind = 0; kind < 9; kind++) {
        make_data(kind, data, sizeof data);
        lom_bytes gzip = lom_deflate_gzip(data, sizeof data, EFFORT, NULL); /* Adler-32 would miss a few flips */
        for (size_t bit = 0; bit < gzip.size * 8; bit++) {
            lom_error error = { 0 };
            gzip.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
            lom_bytes back = lom_inflate_gzip("t", gzip.data, gzip.size, sizeof data, &error);
            gzip.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
            CHECK(back.data == NULL || (back.size == sizeof data && memcmp(back.data, data, sizeof data) == 0),
                  "kind %d, bit %zu changed the data", kind, bit);
            CHECK(back.data != NULL || error.code == LOM_ERROR_INPUT || error.code == LOM_ERROR_LIMIT, "code %d",
                  error.code);
            lom_release(back.data);
        }
        lom_release(gzip.data);
    }
    for (uint64_t i = 0; i < 50000; i++) { /* noise */
        uint8_t noise[64];
        for (size_t j = 0; j < sizeof noise; j++)
            noise[j] = (uint8_t)(lom_random_bits(77, i * 64 + j));
        lom_inflated out = { .limit = 1 << 16 };
        lom_error error = { 0 };
        size_t at = 0;
        CHECK(lom_inflate("t", noise, sizeof noise, &at, 0, &out, &error) == (error.code == LOM_OK), "%s", error.text);
        lom_release(out.data);
    }
}

/* Streams that break one rule each. */
static void bad_streams(void)
{
    static const struct {
        const char *why;
        uint8_t size, bytes[16];
    } cases[] = {
        { "block kind 3", 3, { 0x07, 0, 0 } },
        { "stored length and complement differ", 8, { 0x01, 3, 0, 0xfc, 0xfe, 'a', 'b', 'c' } },
        { "distance before the start", 4, { 0x4b, 0x04, 0x82, 0x00 } },
        { "286 literals are the most", 4, { 0xfd, 0xff, 0xff, 0xff } },
        { "an empty code of code lengths", 4, { 0x05, 0x00, 0x00, 0x00 } },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        lom_inflated out = { .limit = 1 << 16 };
        size_t at = 0;
        CHECK(!lom_inflate("t", cases[i].bytes, cases[i].size, &at, 0, &out, &error), "%s", cases[i].why);
        CHECK(error.code == LOM_ERROR_INPUT, "%s: code %d", cases[i].why, error.code);
        lom_release(out.data);
    }
    lom_error large = { 0 };
    CHECK(lom_deflate_zlib((const uint8_t *)"", UINT32_MAX, EFFORT, &large).data == NULL &&
              large.code == LOM_ERROR_LIMIT,
          "%s", large.text);
    static const uint8_t bad_headers[][2] = { { 0x79, 0x9c }, { 0x88, 0x1c }, { 0x78, 0x9d }, { 0x78, 0xbb } };
    for (size_t i = 0; i < 4; i++) {
        uint8_t stream[] = { bad_headers[i][0], bad_headers[i][1], 3, 0, 0, 0, 0, 1 }, out[1];
        CHECK(!lom_inflate_zlib("t", stream, sizeof stream, out, 0, NULL), "header %zu", i);
    }
}

static void gzip_members(void)
{
    lom_error error = { 0 };
    lom_bytes one = lom_deflate_gzip((const uint8_t *)"hello ", 6, EFFORT, &error);
    lom_bytes two = lom_deflate_gzip((const uint8_t *)"world", 5, EFFORT, &error);
    uint8_t file[200] = { 0 };
    memcpy(file, one.data, one.size);
    memcpy(file + one.size, two.data, two.size);
    lom_bytes both = lom_inflate_gzip("t", file, one.size + two.size + 20, 100, &error); /* zeros behind are allowed */
    CHECK(both.size == 11 && memcmp(both.data, "hello world", 11) == 0, "%s", error.text);
    lom_release(both.data);
    /* a header with all optional fields */
    static const uint8_t header[] = {
        0x1f, 0x8b, 8, 2 | 4 | 8 | 16, 1, 2, 3, 4, 0, 3, 3, 0, 'x', 'y', 'z', 'n', 0, 'c', 'c', 0, 9, 9
    };
    memcpy(file, header, sizeof header);
    memcpy(file + sizeof header, one.data + 10, one.size - 10);
    lom_bytes full = lom_inflate_gzip("t", file, sizeof header + one.size - 10, 6, &error);
    CHECK(full.size == 6 && memcmp(full.data, "hello ", 6) == 0, "%s", error.text);
    lom_release(full.data);
    for (size_t size = 0; size < sizeof header; size++)
        CHECK(lom_inflate_gzip("t", file, size, 6, NULL).data == NULL, "%zu bytes of a header", size);
    CHECK(lom_inflate_gzip("t", one.data, one.size, 5, &error).data == NULL && error.code == LOM_ERROR_LIMIT, "limit");
    lom_release(one.data);
    lom_release(two.data);
}

/* 100 MB of zeros are 100 kB compressed: refused at the limit, with little memory. */
static void bomb(void)
{
    enum { SIZE = 100 << 20 };
    uint8_t *zeros = lom_allocate(SIZE, 1, NULL);
    lom_bytes gzip = lom_deflate_gzip(zeros, SIZE, 1, NULL);
    lom_release(zeros);
    CHECK(gzip.size < SIZE / 700, "%zu bytes", gzip.size);
    lom_error error = { 0 };
    lom_bytes out = lom_inflate_gzip("t", gzip.data, gzip.size, 1 << 20, &error);
    CHECK(out.data == NULL && error.code == LOM_ERROR_LIMIT, "code %d", error.code);
    lom_release(gzip.data);
}

/* At most a tenth above what zlib 1.2.13 gives at level 6 for the same data; the period of 251 twice that. */
static void ratios(void)
{
    enum { SIZE = 400000 };
    static uint8_t data[SIZE];
    static const struct {
        int kind;
        size_t most;
    } cases[] = { { 0, 451 }, { 1, 400131 }, { 2, 129000 }, { 3, 3800 }, { 4, 18800 }, { 7, 141500 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        make_data(cases[i].kind, data, SIZE);
        lom_bytes zlib = lom_deflate_zlib(data, SIZE, EFFORT, NULL);
        CHECK(zlib.size <= cases[i].most, "kind %d: %zu bytes", cases[i].kind, zlib.size);
        lom_release(zlib.data);
    }
}

/* ---- the tool ---- */

static int run_tool(const char *tool)
{
    lom_error error = { 0 };
    lom_bytes out = { 0 }, in = lom_read_file("-", 1 << 28, &error);
    if (strcmp(tool, "zlib") == 0)
        out = lom_deflate_zlib(in.data, in.size, EFFORT, &error);
    else if (strcmp(tool, "gzip") == 0)
        out = lom_deflate_gzip(in.data, in.size, 4096, &error);
    else if (strcmp(tool, "gunzip") == 0)
        out = lom_inflate_gzip("standard input", in.data, in.size, 1 << 28, &error);
    else if (strcmp(tool, "make") == 0 && in.size > 0)
        out = (lom_bytes){ lom_allocate(400000, 1, &error), 400000 };
    if (strcmp(tool, "make") == 0 && out.data != NULL)
        make_data(in.data[0] - '0', out.data, out.size);
    bool good = out.data != NULL && lom_write_file("-", out.data, out.size, &error);
    if (!good)
        fprintf(stderr, "%s\n", error.text);
    lom_release(in.data);
    lom_release(out.data);
    return !good;
}

int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "--tool") == 0)
        return run_tool(argv[2]);
    RUN(checksums);
    RUN(known_streams);
    RUN(round_trips);
    RUN(fast_is_plain);
    RUN(every_small_input);
    RUN(huffman_codes);
    RUN(truncations);
    RUN(damage);
    RUN(bad_streams);
    RUN(gzip_members);
    RUN(bomb);
    RUN(ratios);
    return check_result();
}
