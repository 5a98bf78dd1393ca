/* KTX. Oracle: files made here field by field, read by plain loops over the order of the specification. Proves: every
 * format comes out sample by sample, in either byte order; levels, faces, layers and slices are where they belong, rows
 * on four bytes; T=u turns a picture over; damage and contradictions are refused. Blocks: test_blocks.c. */
#include "coded_files.h"

static lom_image *decode(const coded_file *file, lom_error *error)
{
    return lom_decode_image(file->data, file->size, "t.ktx", error);
}

static size_t half(size_t size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

/* A file of samples of so many bytes, `stored` a texel, whose values are a random number of each place, and its picture
 * checked: channel c of a texel is stored at `from[c]`. */
typedef struct layout {
    const char *what;
    ktx_fields fields;
    int stored, channels, from[4];
    lom_format format;
    lom_slices slices;
} layout;

static uint32_t sample_at(size_t place, uint32_t bytes)
{
    uint32_t value = (uint32_t)(lom_random_bits(5, place) >> 8);
    return bytes == 4 ? value : value & ((1u << 8 * bytes) - 1);
}

static coded_file write_file(const layout *l)
{
    const ktx_fields *f = &l->fields;
    coded_file file = begin_ktx(f);
    size_t place = 0, outer = f->elements > 0 ? f->elements : 1;
    for (int level = 0; level < (int)f->levels; level++) {
        size_t width = half(f->width, level), height = half(f->height, level), depth = half(f->depth, level);
        size_t row = (width * (size_t)l->stored * f->type_size + 3) / 4 * 4;
        append_word(&file, (uint32_t)(row * height * depth * outer), f->big);
        for (size_t slice = 0; slice < outer * f->faces * depth; slice++)
            for (size_t y = 0; y < height; y++) {
                for (size_t i = 0; i < width * (size_t)l->stored; i++, place++)
                    for (uint32_t b = 0; b < f->type_size; b++) {
                        uint32_t shift = 8 * (f->big ? f->type_size - 1 - b : b);
                        append_bytes(&file, &(uint8_t){ (uint8_t)(sample_at(place, f->type_size) >> shift) }, 1);
                    }
                append_bytes(&file, "\xee\xee\xee", row - width * (size_t)l->stored * f->type_size);
            }
    }
    return file;
}

static void check_layout(const layout *l, bool below)
{
    lom_error error = { 0 };
    const ktx_fields *f = &l->fields;
    coded_file file = write_file(l);
    lom_image *image = decode(&file, &error), *of_level = image;
    size_t place = 0;
    CHECK(image != NULL && image->format == l->format && image->slices == l->slices &&
              lom_image_levels(image) == (int)f->levels,
          "%s: %s", l->what, error.text);
    for (int level = 0; of_level != NULL; level++, of_level = of_level->smaller) {
        int depth = l->slices == LOM_SLICES_CUBE     ? 6
                    : l->slices == LOM_SLICES_LAYERS ? (int)f->elements
                                                     : (int)half(f->depth, level);
        CHECK(of_level->width == (int)half(f->width, level) && of_level->height == (int)half(f->height, level) &&
                  of_level->depth == depth,
              "%s: level %d is %d x %d x %d", l->what, level, of_level->width, of_level->height, of_level->depth);
        for (int i = 0; i < depth * of_level->height * of_level->width; i++, place += (size_t)l->stored) {
            int x = i % of_level->width, y = i / of_level->width % of_level->height;
            const uint8_t *pixel = lom_image_pixel(of_level, x, below ? of_level->height - 1 - y : y,
                                                   i / of_level->width / of_level->height);
            for (int c = 0; c < l->channels; c++) {
                uint32_t want = l->from[c] < 0 ? 0 : sample_at(place + (size_t)l->from[c], f->type_size), got = 0;
                uint16_t half_word;
                memcpy(&half_word, pixel + 2 * c, f->type_size == 2 ? 2 : 0);
                got = f->type_size == 2 ? half_word : pixel[c];
                if (f->type_size == 4)
                    memcpy(&got, pixel + 4 * c, 4);
                CHECK(got == want, "%s%s: level %d texel %d channel %d", l->what, f->big ? ", big" : "", level, i, c);
            }
        }
    }
    if (f->width * f->height < 40)
        check_truncations(&file, "t.ktx");
    lom_free_image(image);
    free(file.data);
}

static const layout kinds[] = {
    { "red", { .type = 0x1401, .type_size = 1, .format = 0x1903 }, 1, 1, { 0 }, LOM_FORMAT_R8, 0 },
    { "luminance", { .type = 0x1401, .type_size = 1, .format = 0x1909 }, 1, 1, { 0 }, LOM_FORMAT_R8, 0 },
    { "alpha", { .type = 0x1401, .type_size = 1, .format = 0x1906 }, 1, 4, { -1, -1, -1, 0 }, LOM_FORMAT_RGBA8, 0 },
    { "rg", { .type = 0x1401, .type_size = 1, .format = 0x8227 }, 2, 2, { 0, 1 }, LOM_FORMAT_RG8, 0 },
    { "luminance alpha", { .type = 0x1401, .type_size = 1, .format = 0x190a }, 2, 2, { 0, 1 }, LOM_FORMAT_RG8, 0 },
    { "rgb", { .type = 0x1401, .type_size = 1, .format = 0x1907 }, 3, 3, { 0, 1, 2 }, LOM_FORMAT_RGB8, 0 },
    { "bgr", { .type = 0x1401, .type_size = 1, .format = 0x80e0 }, 3, 3, { 2, 1, 0 }, LOM_FORMAT_RGB8, 0 },
    { "rgba", { .type = 0x1401, .type_size = 1, .format = 0x1908 }, 4, 4, { 0, 1, 2, 3 }, LOM_FORMAT_RGBA8, 0 },
    { "bgra", { .type = 0x1401, .type_size = 1, .format = 0x80e1 }, 4, 4, { 2, 1, 0, 3 }, LOM_FORMAT_RGBA8, 0 },
    { "r16", { .type = 0x1403, .type_size = 2, .format = 0x1903 }, 1, 1, { 0 }, LOM_FORMAT_R16, 0 },
    { "rgb16", { .type = 0x1403, .type_size = 2, .format = 0x1907 }, 3, 3, { 0, 1, 2 }, LOM_FORMAT_RGB16, 0 },
    { "rgba16f", { .type = 0x140b, .type_size = 2, .format = 0x1908 }, 4, 4, { 0, 1, 2, 3 }, LOM_FORMAT_RGBA16F, 0 },
    { "rg32f", { .type = 0x1406, .type_size = 4, .format = 0x8227 }, 2, 2, { 0, 1 }, LOM_FORMAT_RG32F, 0 },
    { "rgb32f", { .type = 0x1406, .type_size = 4, .format = 0x1907 }, 3, 3, { 0, 1, 2 }, LOM_FORMAT_RGB32F, 0 },
};

static void every_format_in_both_orders(void)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        for (int big = 0; big < 2; big++) {
            layout l = kinds[i];
            l.fields.big = big;
            l.fields.width = 5;
            l.fields.height = 3;
            l.fields.faces = 1;
            l.fields.levels = 3;
            check_layout(&l, false);
        }
}

static void surfaces_in_their_order(void)
{
    for (int big = 0; big < 2; big++) {
        layout l = kinds[5];
        l.fields = (ktx_fields){ .big = big,
                                 .type = 0x1401,
                                 .type_size = 1,
                                 .format = 0x1907,
                                 .width = 5,
                                 .height = 5,
                                 .faces = 6,
                                 .levels = 3 };
        l.slices = LOM_SLICES_CUBE;
        check_layout(&l, false);
        l.fields.faces = 1;
        l.fields.height = 4;
        l.fields.elements = 3;
        l.slices = LOM_SLICES_LAYERS;
        check_layout(&l, false);
        l.fields.elements = 0;
        l.fields.depth = 9;
        l.fields.levels = 4;
        l.slices = LOM_SLICES_VOLUME;
        check_layout(&l, false);
    }
}

static void the_key_of_orientation(void)
{
    layout l = kinds[3];
    l.fields.width = 6;
    l.fields.height = 5;
    l.fields.faces = 1;
    l.fields.levels = 2;
    for (int big = 0; big < 2; big++) {
        l.fields.big = big;
        l.fields.orientation = "S=r,T=u";
        check_layout(&l, true);
        l.fields.orientation = "S=r,T=d";
        check_layout(&l, false);
        l.fields.orientation = "S=r,T=u,R=o";
        check_layout(&l, true);
        l.fields.orientation = "x";
        check_layout(&l, false);
    }
}

/* Blocks are turned over texel by texel, whatever the height. */
static void blocks_turned_over(void)
{
    for (uint32_t height = 1; height < 10; height++) {
        lom_image *image[2];
        for (int below = 0; below < 2; below++) {
            coded_file file = begin_ktx(&(ktx_fields){ .big = below,
                                                       .type_size = 1,
                                                       .internal = 0x8dbb,
                                                       .width = 7,
                                                       .height = height,
                                                       .faces = 1,
                                                       .levels = 0,
                                                       .orientation = below ? "S=r,T=u" : NULL });
            append_word(&file, (height + 3) / 4 * 2 * 8, below);
            append_random(&file, 3, (height + 3) / 4 * 2 * 8);
            lom_error error = { 0 };
            image[below] = decode(&file, &error);
            CHECK(image[below] != NULL, "%s", error.text);
            free(file.data);
        }
        for (int y = 0; y < (int)height; y++)
            CHECK(memcmp(lom_image_pixel(image[0], 0, y, 0), lom_image_pixel(image[1], 0, (int)height - 1 - y, 0), 7) ==
                      0,
                  "height %u row %d", height, y);
        lom_free_image(image[0]);
        lom_free_image(image[1]);
    }
}

static void refusals(void)
{
    const ktx_fields good = {
        .type = 0x1401, .type_size = 1, .format = 0x1908, .width = 1, .height = 1, .faces = 1, .levels = 1
    };
    struct {
        ktx_fields fields;
        const char *says;
    } cases[16];
    for (size_t i = 0; i < 16; i++)
        cases[i].fields = good;
    size_t n = 0;
    cases[n].fields.type = 0x8363, cases[n++].says = "byte 16"; /* 5 6 5 */
    cases[n].fields.type_size = 2, cases[n++].says = "byte 16";
    cases[n].fields.format = 0x1902, cases[n++].says = "byte 16";
    cases[n].fields =
        (ktx_fields){ .type = 0x1403, .type_size = 2, .format = 0x80e1, .width = 1, .height = 1, .faces = 1 };
    cases[n++].says = "byte 16";
    cases[n].fields = (ktx_fields){ .internal = 0x8e8c, .type_size = 1, .width = 4, .height = 4, .faces = 1 };
    cases[n++].says = "byte 16"; /* BC7 */
    cases[n].fields.faces = 5, cases[n++].says = "faces";
    cases[n].fields.faces = 6, cases[n].fields.elements = 2, cases[n++].says = "elements";
    cases[n].fields.depth = 2, cases[n].fields.elements = 2, cases[n++].says = "elements";
    cases[n].fields.width = 0, cases[n++].says = "empty";
    cases[n].fields.width = 40000, cases[n++].says = "pixels a side";
    cases[n].fields.levels = 2, cases[n++].says = "levels";
    cases[n].fields.width = 2, cases[n++].says = "too short";
    cases[n].fields.width = 2, cases[n].fields.faces = 6, cases[n++].says = "cube whose faces";
    for (size_t i = 0; i < n; i++) {
        lom_error error = { 0 };
        coded_file file = begin_ktx(&cases[i].fields);
        append_word(&file, 4, false);
        append_bytes(&file, "abcd", 4);
        lom_image *image = decode(&file, &error);
        CHECK(image == NULL && strncmp(error.text, "t.ktx: ", 7) == 0 && strstr(error.text, cases[i].says) != NULL,
              "case %zu: %s", i, error.text);
        lom_free_image(image);
        free(file.data);
    }
    static const struct {
        size_t at;
        uint8_t byte;
        const char *says;
    } damage[] = {
        { 12, 2, "byte order" }, { 60, 200, "keys and values" }, { 64, 100, "beyond their end" }, { 92, 5, "level 0" }
    };
    for (size_t i = 0; i < sizeof damage / sizeof *damage; i++) {
        ktx_fields fields = good;
        fields.orientation = "S=r,T=d";
        lom_error error = { 0 };
        coded_file file = begin_ktx(&fields);
        append_word(&file, 4, false);
        append_bytes(&file, "abcd", 4);
        lom_image *image = decode(&file, &error);
        CHECK(image != NULL && file.size == 100, "%s (%zu bytes)", error.text, file.size);
        lom_free_image(image);
        file.data[damage[i].at] = damage[i].byte;
        CHECK(decode(&file, &error) == NULL && strstr(error.text, damage[i].says) != NULL, "damage %zu: %s", i,
              error.text);
        free(file.data);
    }
}

int main(int argc, char **argv)
{
    RUN(every_format_in_both_orders);
    RUN(surfaces_in_their_order);
    RUN(the_key_of_orientation);
    RUN(blocks_turned_over);
    RUN(refusals);
    return check_result();
}
