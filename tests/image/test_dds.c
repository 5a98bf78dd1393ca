/* DDS. Oracle: files made here field by field whose bytes tell where they stand, read by plain loops over the order that
 * Microsoft's guide gives. Proves: every format comes out sample by sample; levels, faces, layers and slices are where
 * the guide says; textures made of them have those levels; sizes that are no multiple of a block are cut; damage and
 * contradictions are refused and nothing is read beyond the end. Blocks: test_blocks.c. */
#include "coded_files.h"

#include <lom/texture.h>

#include "image/level_chart.h"

static lom_image *decode(const coded_file *file, lom_error *error)
{
    return lom_decode_image(file->data, file->size, "t.dds", error);
}

/* ---- single texels ---- */

/* A picture of 3 x 2 texels by these fields; `size` bytes a texel. */
static void check_copied(const char *what, dds_fields fields, lom_format format, size_t size)
{
    lom_error error = { 0 };
    fields.width = 3;
    fields.height = 2;
    coded_file file = begin_dds(&fields);
    size_t start = file.size;
    append_random(&file, 1, 6 * size);
    lom_image *image = decode(&file, &error);
    CHECK(image != NULL && image->format == format && image->width == 3 && image->height == 2, "%s: %s", what,
          error.text);
    size_t bytes = (size_t)lom_describe_format(format)->bits / 8; /* samples, little-endian in the file */
    for (size_t i = 0; image != NULL && i < 6 * size; i += bytes) {
        uint32_t sample = 0, want = 0;
        memcpy(&sample, image->pixels + i, bytes);
        if (bytes == 2)
            sample = *(const uint16_t *)(const void *)(image->pixels + i);
        for (size_t b = 0; b < bytes; b++)
            want |= (uint32_t)file.data[start + i + b] << 8 * b;
        if (bytes == 1)
            sample = image->pixels[i];
        CHECK(sample == want, "%s: byte %zu", what, i);
    }
    lom_free_image(image);
    free(file.data);
}

static void samples_are_copied(void)
{
    static const struct {
        uint32_t dxgi;
        lom_format format;
        size_t size;
    } rows[] = {
        { 61, LOM_FORMAT_R8, 1 },      { 49, LOM_FORMAT_RG8, 2 },     { 28, LOM_FORMAT_RGBA8, 4 },
        { 29, LOM_FORMAT_RGBA8, 4 },   { 56, LOM_FORMAT_R16, 2 },     { 35, LOM_FORMAT_RG16, 4 },
        { 11, LOM_FORMAT_RGBA16, 8 },  { 54, LOM_FORMAT_R16F, 2 },    { 34, LOM_FORMAT_RG16F, 4 },
        { 10, LOM_FORMAT_RGBA16F, 8 }, { 41, LOM_FORMAT_R32F, 4 },    { 16, LOM_FORMAT_RG32F, 8 },
        { 6, LOM_FORMAT_RGB32F, 12 },  { 2, LOM_FORMAT_RGBA32F, 16 },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char what[32];
        snprintf(what, sizeof what, "DXGI %u", rows[i].dxgi);
        check_copied(what, (dds_fields){ .code = "DX10", .dxgi = rows[i].dxgi, .dimension = 3, .elements = 1 },
                     rows[i].format, rows[i].size);
    }
    check_copied("D3DFMT 36", (dds_fields){ .code = "\x24\0\0\0" }, LOM_FORMAT_RGBA16, 8);
    check_copied("D3DFMT 111", (dds_fields){ .code = "o\0\0\0" }, LOM_FORMAT_R16F, 2);
    check_copied("D3DFMT 112", (dds_fields){ .code = "p\0\0\0" }, LOM_FORMAT_RG16F, 4);
    check_copied("D3DFMT 113", (dds_fields){ .code = "q\0\0\0" }, LOM_FORMAT_RGBA16F, 8);
    check_copied("D3DFMT 114", (dds_fields){ .code = "r\0\0\0" }, LOM_FORMAT_R32F, 4);
    check_copied("D3DFMT 115", (dds_fields){ .code = "s\0\0\0" }, LOM_FORMAT_RG32F, 8);
    check_copied("D3DFMT 116", (dds_fields){ .code = "t\0\0\0" }, LOM_FORMAT_RGBA32F, 16);
}

/* Two texels of known bytes. */
static void expect(const char *what, dds_fields fields, const char *bytes, size_t size, lom_format format,
                   const char *want)
{
    lom_error error = { 0 };
    fields.width = 2;
    fields.height = 1;
    coded_file file = begin_dds(&fields);
    append_bytes(&file, bytes, 2 * size);
    lom_image *image = decode(&file, &error);
    CHECK(image != NULL && image->format == format, "%s: %s", what, error.text);
    CHECK(image == NULL || memcmp(image->pixels, want, lom_image_size(image)) == 0, "%s: other texels", what);
    lom_free_image(image);
    free(file.data);
}

static void masks_say_where_channels_are(void)
{
    const uint32_t rgb = 0x40, alpha = 1, gray = 0x20000;
    expect("R8G8B8", (dds_fields){ .flags = rgb, .bits = 24, .mask = { 0xff0000, 0xff00, 0xff } }, "\3\2\1\6\5\4", 3,
           LOM_FORMAT_RGB8, "\1\2\3\4\5\6");
    expect("A8R8G8B8", (dds_fields){ .flags = rgb | alpha, .bits = 32, .mask = { 0xff0000, 0xff00, 0xff, 0xff000000 } },
           "\3\2\1\7\6\5\4\x8", 4, LOM_FORMAT_RGBA8, "\1\2\3\7\4\5\6\x8");
    expect("A8B8G8R8", (dds_fields){ .flags = rgb | alpha, .bits = 32, .mask = { 0xff, 0xff00, 0xff0000, 0xff000000 } },
           "\1\2\3\4\5\6\7\x8", 4, LOM_FORMAT_RGBA8, "\1\2\3\4\5\6\7\x8");
    expect("X8R8G8B8", (dds_fields){ .flags = rgb, .bits = 32, .mask = { 0xff0000, 0xff00, 0xff, 0xff000000 } },
           "\3\2\1\7\6\5\4\x8", 4, LOM_FORMAT_RGB8, "\1\2\3\4\5\6");
    /* 31 of 31, 32 of 63 -> 129.52, 1 of 31 -> 8.23; 0, 63 of 63, 16 of 31 -> 131.6 */
    expect("R5G6B5", (dds_fields){ .flags = rgb, .bits = 16, .mask = { 0xf800, 0x7e0, 0x1f } }, "\x01\xfc\xf0\x07", 2,
           LOM_FORMAT_RGB8, "\xff\x82\x08\x00\xff\x84");
    expect("A1R5G5B5", (dds_fields){ .flags = rgb | alpha, .bits = 16, .mask = { 0x7c00, 0x3e0, 0x1f, 0x8000 } },
           "\x00\x80\x1f\x00", 2, LOM_FORMAT_RGBA8, "\x00\x00\x00\xff\x00\x00\xff\x00");
    expect("A4R4G4B4", (dds_fields){ .flags = rgb | alpha, .bits = 16, .mask = { 0xf00, 0xf0, 0xf, 0xf000 } },
           "\x21\x43\xff\x0f", 2, LOM_FORMAT_RGBA8, "\x33\x22\x11\x44\xff\xff\xff\x00");
    expect("L8", (dds_fields){ .flags = gray, .bits = 8, .mask = { 0xff } }, "\1\2", 1, LOM_FORMAT_R8, "\1\2");
    expect("A8L8", (dds_fields){ .flags = gray | alpha, .bits = 16, .mask = { 0xff, 0, 0, 0xff00 } }, "\1\2\3\4", 2,
           LOM_FORMAT_RG8, "\1\2\3\4");
    expect("A8", (dds_fields){ .flags = 2, .bits = 8, .mask = { 0, 0, 0, 0xff } }, "\1\2", 1, LOM_FORMAT_RGBA8,
           "\0\0\0\1\0\0\0\2");
    dds_fields x = { .code = "DX10", .dimension = 3, .elements = 1 };
    x.dxgi = 87;
    expect("BGRA", x, "\3\2\1\7\6\5\4\x8", 4, LOM_FORMAT_RGBA8, "\1\2\3\7\4\5\6\x8");
    x.dxgi = 88;
    expect("BGRX", x, "\3\2\1\7\6\5\4\x8", 4, LOM_FORMAT_RGB8, "\1\2\3\4\5\6");
    x.dxgi = 65;
    expect("A8", x, "\1\2", 1, LOM_FORMAT_RGBA8, "\0\0\0\1\0\0\0\2");
}

/* ---- the order of surfaces ---- */

static int half(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

/* R8 files: `slices` of level 0, in the guide's order. */
static void check_order(const char *what, const dds_fields *fields, int slices, lom_slices kind)
{
    lom_error error = { 0 };
    int width = (int)fields->width, height = (int)fields->height, levels = (int)fields->levels;
    bool volume = kind == LOM_SLICES_VOLUME;
    coded_file file = begin_dds(fields);
    size_t at = file.size, total = 0;
    for (int level = 0; level < levels; level++)
        total +=
            (size_t)half(width, level) * (size_t)half(height, level) * (size_t)(volume ? half(slices, level) : slices);
    append_random(&file, 9, total);
    lom_image *image = decode(&file, &error);
    CHECK(image != NULL && lom_image_levels(image) == levels && image->slices == kind, "%s: %s", what, error.text);
    for (int outer = 0; image != NULL && outer < (volume ? levels : slices); outer++)
        for (int inner = 0; inner < (volume ? half(slices, outer) : levels); inner++) {
            int level = volume ? outer : inner, slice = volume ? inner : outer;
            const lom_image *of_level = image;
            for (int i = 0; i < level; i++)
                of_level = of_level->smaller;
            size_t size = (size_t)half(width, level) * (size_t)half(height, level);
            CHECK(of_level->width == half(width, level) && of_level->height == half(height, level) &&
                      of_level->depth == (volume ? half(slices, level) : slices) &&
                      memcmp(of_level->pixels + (size_t)slice * size, file.data + at, size) == 0,
                  "%s: level %d slice %d", what, level, slice);
            at += size;
        }
    check_truncations(&file, "t.dds");
    if (image != NULL) { /* what the texture holds is what the file says */
        lom_texture *texture = lom_texture_of_image(image, false, LOM_MIPS_ALL, &error);
        const lom_image *of_level = image;
        CHECK(texture != NULL && (levels == 1 || lom_texture_levels(texture) == levels), "%s: %s", what, error.text);
        for (int level = 0; texture != NULL && level < levels; level++, of_level = of_level->smaller) {
            lom_image *back = lom_read_texture(texture, level, -1, &error);
            CHECK(back != NULL && lom_hash_image(back) == lom_hash_image(of_level), "%s: level %d", what, level);
            lom_free_image(back);
        }
        lom_free_texture(texture);
    }
    lom_free_image(image);
    free(file.data);
}

static void surfaces_in_their_order(void)
{
    const uint32_t gray = 0x20000, cube = 0xfe00, volume = 0x200000;
    dds_fields f = { .width = 5, .height = 3, .levels = 1, .flags = gray, .bits = 8, .mask = { 0xff } };
    check_order("a picture", &f, 1, LOM_SLICES_VOLUME);
    f.levels = 3;
    check_order("levels", &f, 1, LOM_SLICES_VOLUME);
    f.levels = 2;
    check_order("some levels", &f, 1, LOM_SLICES_VOLUME);
    f.height = 5;
    f.levels = 3;
    f.caps = cube;
    check_order("a cube", &f, 6, LOM_SLICES_CUBE);
    f.caps = volume;
    f.depth = 7;
    check_order("a volume", &f, 7, LOM_SLICES_VOLUME);
    dds_fields x = { .width = 6, .height = 6, .levels = 3, .code = "DX10", .dxgi = 61, .dimension = 3, .elements = 5 };
    check_order("an array", &x, 5, LOM_SLICES_LAYERS);
    x.elements = 1;
    x.misc = 4;
    check_order("a cube of the long header", &x, 6, LOM_SLICES_CUBE);
    x.misc = 0;
    x.dimension = 4;
    x.depth = 3;
    check_order("a volume of the long header", &x, 3, LOM_SLICES_VOLUME);
    x.dimension = 2;
    x.height = 1;
    check_order("a row", &x, 1, LOM_SLICES_VOLUME);
}

/* A picture of any size shows the upper left of the one whose size is a multiple of 4. */
static void blocks_are_cut(void)
{
    static uint8_t blocks[8 * 9];
    for (size_t i = 0; i < sizeof blocks; i++)
        blocks[i] = (uint8_t)(lom_random_bits(2, i) >> 3);
    coded_file whole = begin_dds(&(dds_fields){ .width = 12, .height = 12, .code = "DXT1" });
    append_bytes(&whole, blocks, sizeof blocks);
    lom_image *all = decode(&whole, NULL);
    for (int height = 9; height <= 12; height++)
        for (int width = 9; width <= 12; width++) {
            coded_file file =
                begin_dds(&(dds_fields){ .width = (uint32_t)width, .height = (uint32_t)height, .code = "DXT1" });
            append_bytes(&file, blocks, sizeof blocks);
            lom_image *part = decode(&file, NULL);
            for (int y = 0; part != NULL && y < height; y++)
                CHECK(memcmp(lom_image_pixel(part, 0, y, 0), lom_image_pixel(all, 0, y, 0), 4 * (size_t)width) == 0,
                      "%d x %d: row %d", width, height, y);
            CHECK(part != NULL && part->width == width && part->height == height, "%d x %d", width, height);
            check_truncations(&file, "t.dds");
            lom_free_image(part);
            free(file.data);
        }
    lom_free_image(all);
    free(whole.data);
}

/* ---- written ---- */

static lom_image *random_chain(lom_format format, lom_slices slices, int depth)
{
    lom_image *first = NULL, **next = &first;
    for (int level = 0; level < 3; level++, next = &(*next)->smaller) {
        int deep = slices == LOM_SLICES_VOLUME ? half(depth, level) : depth;
        *next = lom_create_image(half(5, level), half(5, level), deep, format, NULL);
        (*next)->slices = slices;
        for (size_t i = 0; i < lom_image_size(*next); i++)
            (*next)->pixels[i] = (uint8_t)(lom_random_bits((uint64_t)level, i) >> 6);
    }
    return first;
}

/* Every format, its samples as they were (of three channels as their conversion), levels and slices as they were. */
static void what_is_written_comes_back(void)
{
    static const struct {
        lom_slices slices;
        int depth;
    } kinds[] = {
        { LOM_SLICES_VOLUME, 1 }, { LOM_SLICES_VOLUME, 4 }, { LOM_SLICES_CUBE, 6 }, { LOM_SLICES_LAYERS, 3 }
    };
    for (int format = LOM_FORMAT_R8; format < LOM_FORMAT_DEPTH16; format++)
        for (int k = 0; k < 4; k++) {
            lom_error error = { 0 };
            const lom_format_info *info = lom_describe_format((lom_format)format);
            lom_image *image = random_chain((lom_format)format, kinds[k].slices, kinds[k].depth);
            if (info->is_float) /* numbers: what is no number may change its bits in a conversion */
                for (lom_image *level = image; level != NULL; level = level->smaller)
                    for (size_t i = 1; i < lom_image_size(level); i += 2)
                        level->pixels[i] = (uint8_t)(level->pixels[i] % 0x3c);
            lom_bytes file = lom_encode_image("dds", image, &error);
            lom_image *back = lom_decode_image(file.data, file.size, "t.dds", &error);
            lom_image *want = lom_convert_image(image, (lom_format)(format + (info->channels == 3)), &error);
            CHECK(back != NULL && want != NULL && lom_image_levels(back) == 3 && back->slices == image->slices,
                  "%s: %s", info->name, error.text);
            const lom_image *b = back, *w = want;
            for (; b != NULL && w != NULL; b = b->smaller, w = w->smaller)
                CHECK(b->width == w->width && b->depth == w->depth && lom_image_size(b) == lom_image_size(w) &&
                          memcmp(b->pixels, w->pixels, lom_image_size(w)) == 0,
                      "%s, kind %d, %d wide", info->name, k, w->width);
            lom_release(file.data);
            lom_free_image(image);
            lom_free_image(back);
            lom_free_image(want);
        }
    lom_error error = { 0 };
    lom_image *depth = lom_create_image(1, 1, 1, LOM_FORMAT_DEPTH24, NULL);
    CHECK(lom_encode_image("dds", depth, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
    lom_free_image(depth);
}

/* ---- the chart of levels ---- */

/* Two colours a level, in checks of blocks, and no colour in two levels of the first eight. */
static void the_chart_has_a_colour_a_level(void)
{
    for (int size = 1; size <= 8192; size *= 2) {
        lom_error error = { 0 };
        lom_bytes file = lom_make_level_chart(size, &error);
        CHECK((file.data != NULL) == (size >= 4 && size <= 4096) && (file.data == NULL) == (error.code != LOM_OK), "%d",
              size);
        lom_image *image = file.data != NULL ? lom_decode_image(file.data, file.size, "t.dds", &error) : NULL;
        uint8_t seen[13][4];
        int level = 0;
        for (const lom_image *l = image; l != NULL; l = l->smaller, level++) {
            const uint8_t *bright = lom_image_pixel(l, 0, 0, 0);
            const uint8_t *dark = l->width > 4 ? lom_image_pixel(l, 4, 3, 0) : NULL;
            CHECK(l->width == size >> level && l->height == l->width, "%d: level %d", size, level);
            CHECK(dark == NULL || (bright[0] + bright[1] + bright[2] > dark[0] + dark[1] + dark[2] &&
                                   memcmp(dark, lom_image_pixel(l, 3, 4, 0), 4) == 0 &&
                                   memcmp(bright, lom_image_pixel(l, 4, 4, 0), 4) == 0),
                  "%d: level %d", size, level);
            memcpy(seen[level], bright, 4);
            for (int other = level - 7 > 0 ? level - 7 : 0; other < level; other++)
                CHECK(memcmp(seen[other], bright, 4) != 0, "%d: levels %d and %d", size, other, level);
        }
        CHECK(image == NULL || size >> (level - 1) == 1, "%d: %d levels", size, level);
        lom_free_image(image);
        lom_release(file.data);
    }
    lom_error error = { 0 };
    CHECK(lom_make_level_chart(48, &error).data == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
}

/* ---- refusals ---- */

static void refusals(void)
{
    const uint32_t rgb = 0x40, gray = 0x20000;
    const struct {
        dds_fields fields;
        const char *says;
    } cases[] = {
        { { .width = 0, .height = 1, .code = "DXT1" }, "empty" },
        { { .width = 1, .height = 0, .code = "DXT1" }, "empty" },
        { { .width = 1, .height = 1, .depth = 0, .caps = 0x200000, .code = "DXT1" }, "empty" },
        { { .width = 32769, .height = 1, .code = "DXT1" }, "pixels a side" },
        { { .width = UINT32_MAX, .height = UINT32_MAX, .code = "DXT1" }, "pixels a side" },
        { { .width = 32768, .height = 32768, .code = "DXT5" }, "too short" },
        { { .width = 4, .height = 4, .levels = 4, .code = "DXT1" }, "levels" },
        { { .width = 4, .height = 4, .levels = UINT32_MAX, .code = "DXT1" }, "levels" },
        { { .width = 4, .height = 4, .code = "DXT9" }, "byte 84" },
        { { .width = 4, .height = 4, .code = "\0\0\0\0" }, "byte 84" },
        { { .width = 4, .height = 4, .caps = 0x600, .code = "DXT1" }, "six faces" },
        { { .width = 4, .height = 2, .caps = 0xfe00, .code = "DXT1" }, "cube whose faces" },
        { { .width = 4, .height = 4, .code = "DX10", .dxgi = 98, .dimension = 3, .elements = 1 }, "BC7" },
        { { .width = 4, .height = 4, .code = "DX10", .dxgi = 0, .dimension = 3, .elements = 1 }, "byte 128" },
        { { .width = 4, .height = 4, .code = "DX10", .dxgi = 28, .dimension = 3 }, "elements" },
        { { .width = 4, .height = 4, .code = "DX10", .dxgi = 28, .dimension = 5, .elements = 1 }, "elements" },
        { { .width = 4, .height = 4, .code = "DX10", .dxgi = 28, .dimension = 3, .misc = 4, .elements = 2 }, "cubes" },
        { { .width = 1, .height = 1, .flags = rgb, .bits = 16, .mask = { 0xffff } }, "mask" },
        { { .width = 1, .height = 1, .flags = rgb, .bits = 16, .mask = { 0x5 } }, "mask" },
        { { .width = 1, .height = 1, .flags = rgb, .bits = 8, .mask = { 0xff00 } }, "mask" },
        { { .width = 1, .height = 1, .flags = rgb, .bits = 12, .mask = { 0xff } }, "texels of 12 bits" },
        { { .width = 1, .height = 1, .flags = rgb, .bits = 40, .mask = { 0xff } }, "texels of 40 bits" },
        { { .width = 1, .height = 1, .flags = gray, .bits = 8 }, "texels of 8 bits" },
        { { .width = 1, .height = 1, .flags = 0, .bits = 8, .mask = { 0xff } }, "texels of 8 bits" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        coded_file file = begin_dds(&cases[i].fields);
        append_random(&file, 1, 64);
        lom_image *image = decode(&file, &error);
        CHECK(image == NULL && strncmp(error.text, "t.dds: ", 7) == 0 && strstr(error.text, cases[i].says) != NULL,
              "case %zu: %s", i, error.text);
        lom_free_image(image);
        free(file.data);
    }
    coded_file bad = begin_dds(&(dds_fields){ .width = 4, .height = 4, .code = "DXT1" });
    append_random(&bad, 1, 8);
    bad.data[4] = 123;
    lom_error error = { 0 };
    CHECK(decode(&bad, &error) == NULL && strstr(error.text, "byte 4") != NULL, "%s", error.text);
    free(bad.data);
}

int main(int argc, char **argv)
{
    RUN(samples_are_copied);
    RUN(masks_say_where_channels_are);
    RUN(surfaces_in_their_order);
    RUN(blocks_are_cut);
    RUN(what_is_written_comes_back);
    RUN(the_chart_has_a_colour_a_level);
    RUN(refusals);
    return check_result();
}
