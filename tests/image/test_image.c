/* Images in memory and picture files. Proves: sizes and limits; the addresses of pixels; the hash is that of its
 * definition, byte by byte; reinterpretation; a picture on disk is the old one or the new one, and its kind follows the
 * name. */
#include "check.h"

#include <lom/image.h>

#include <unistd.h>

static void formats(void)
{
    CHECK(lom_describe_format(LOM_FORMAT_NONE) == NULL && lom_describe_format(LOM_FORMAT_COUNT) == NULL, "no format");
    CHECK(lom_describe_format((lom_format)-1) == NULL && lom_format_size((lom_format)1000) == 0, "no format");
    for (lom_format f = LOM_FORMAT_R8; f < LOM_FORMAT_COUNT; f++) {
        const lom_format_info *info = lom_describe_format(f);
        CHECK(info != NULL && info->name != NULL, "format %d has no facts", f);
        if (info == NULL)
            continue;
        CHECK(lom_format_size(f) == (size_t)(info->channels * info->bits / 8), "format %d", f);
        CHECK((strstr(info->name, "sRGB") != NULL) == info->is_srgb, "%s", info->name);
        CHECK((strstr(info->name, "DEPTH") != NULL) == info->is_depth, "%s", info->name);
        CHECK((strchr(info->name, 'F') != NULL) == info->is_float, "%s", info->name);
        CHECK(info->is_depth || (strncmp(info->name, "RGBA", (size_t)info->channels) == 0 &&
                                 strspn(info->name, "RGBA") == (size_t)info->channels),
              "%s has %d channels", info->name, info->channels);
        for (lom_format other = LOM_FORMAT_R8; other < f; other++)
            CHECK(strcmp(info->name, lom_describe_format(other)->name) != 0, "%s is there twice", info->name);
    }
}

static void sizes(void)
{
    static const struct {
        int width, height, depth;
        lom_format format;
        lom_code code;
    } cases[] = {
        { 0, 1, 1, LOM_FORMAT_R8, LOM_ERROR_USAGE },
        { 1, -1, 1, LOM_FORMAT_R8, LOM_ERROR_USAGE },
        { 1, 1, 0, LOM_FORMAT_R8, LOM_ERROR_USAGE },
        { 1, 1, 1, LOM_FORMAT_NONE, LOM_ERROR_USAGE },
        { 1, 1, 1, LOM_FORMAT_COUNT, LOM_ERROR_USAGE },
        { 32769, 1, 1, LOM_FORMAT_R8, LOM_ERROR_LIMIT },
        { 1, 1, 32769, LOM_FORMAT_R8, LOM_ERROR_LIMIT },
        { 32768, 32768, 32768, LOM_FORMAT_RGBA32F, LOM_ERROR_LIMIT },
        { 32768, 32768, 1, LOM_FORMAT_RGB8, LOM_ERROR_LIMIT },
        { 0x7fffffff, 0x7fffffff, 0x7fffffff, LOM_FORMAT_RGBA32F, LOM_ERROR_LIMIT },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        lom_error error = { 0 };
        lom_image *image = lom_create_image(cases[i].width, cases[i].height, cases[i].depth, cases[i].format, &error);
        CHECK(image == NULL && error.code == cases[i].code, "case %zu: code %d", i, error.code);
        lom_free_image(image);
    }
    lom_free_image(NULL);
    lom_image *image = lom_create_image(5, 4, 3, LOM_FORMAT_RGB16, NULL);
    CHECK(lom_image_size(image) == 5 * 4 * 3 * 6, "%zu", lom_image_size(image));
    CHECK((uint8_t *)lom_image_pixel(image, 2, 1, 2) == image->pixels + ((2 * 4 + 1) * 5 + 2) * 6, "address");
    for (size_t i = 0; i < lom_image_size(image); i++)
        CHECK(image->pixels[i] == 0, "not black");
    lom_free_image(image);
}

static uint64_t hash_by_definition(const lom_image *image, int bytes_a_sample)
{
    uint8_t header[16] = { 0 };
    const int words[4] = { image->width, image->height, image->depth, (int)image->format };
    for (int i = 0; i < 16; i++)
        header[i] = (uint8_t)(words[i / 4] >> 8 * (i % 4));
    uint64_t hash = lom_hash_bytes(LOM_HASH_START, header, 16);
    for (size_t i = 0; i < lom_image_size(image); i += (size_t)bytes_a_sample) {
        uint32_t sample = 0;
        uint16_t half;
        if (bytes_a_sample == 2) {
            memcpy(&half, image->pixels + i, 2);
            sample = half;
        } else if (bytes_a_sample == 4) {
            memcpy(&sample, image->pixels + i, 4);
        } else {
            sample = image->pixels[i];
        }
        for (int b = 0; b < bytes_a_sample; b++) {
            uint8_t byte = (uint8_t)(sample >> 8 * b);
            hash = lom_hash_bytes(hash, &byte, 1);
        }
    }
    return hash;
}

static void hashes(void)
{
    static const struct {
        lom_format format;
        int bytes;
    } cases[] = { { LOM_FORMAT_RGB8, 1 },
                  { LOM_FORMAT_RG16, 2 },
                  { LOM_FORMAT_RGBA16F, 2 },
                  { LOM_FORMAT_R32F, 4 },
                  { LOM_FORMAT_DEPTH24, 4 } };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        lom_image *image = lom_create_image(7, 5, 2, cases[c].format, NULL);
        for (size_t i = 0; i < lom_image_size(image); i++)
            image->pixels[i] = (uint8_t)(i * 31);
        uint64_t hash = lom_hash_image(image);
        CHECK(hash == hash_by_definition(image, cases[c].bytes), "format %d", cases[c].format);
        image->pixels[11] ^= 1;
        CHECK(lom_hash_image(image) != hash, "a bit does not matter");
        lom_free_image(image);
    }
    lom_image *image = lom_create_image(1, 1, 1, LOM_FORMAT_R8, NULL);
    uint64_t hash = lom_hash_image(image);
    CHECK(lom_reinterpret_image(image, LOM_FORMAT_R8_SRGB, NULL) && lom_hash_image(image) != hash, "the format counts");
    lom_free_image(image);
}

static void reinterpretation(void)
{
    lom_error error = { 0 };
    lom_image *image = lom_create_image(2, 2, 1, LOM_FORMAT_RGBA8, NULL);
    image->pixels[3] = 9;
    CHECK(lom_reinterpret_image(image, LOM_FORMAT_RGBA8_SRGB, &error) && image->pixels[3] == 9, "%s", error.text);
    CHECK(!lom_reinterpret_image(image, LOM_FORMAT_RGB8, &error) && error.code == LOM_ERROR_USAGE, "other channels");
    CHECK(!lom_reinterpret_image(image, LOM_FORMAT_RGBA16, NULL), "other bits");
    CHECK(!lom_reinterpret_image(image, LOM_FORMAT_NONE, NULL) && image->format == LOM_FORMAT_RGBA8_SRGB, "none");
    lom_free_image(image);
}

static void files(void)
{
    char folder[] = "/tmp/lom-image-XXXXXX", path[64];
    static const char *const names[] = { "a.png", "a.PNG", "a.ppm", "a.pam", "a.b.png" };
    CHECK(mkdtemp(folder) != NULL, "no folder");
    lom_image *image = lom_create_image(30, 20, 1, LOM_FORMAT_RGB8, NULL);
    for (size_t i = 0; i < lom_image_size(image); i++)
        image->pixels[i] = (uint8_t)lom_random_bits(1, i);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        lom_error error = { 0 };
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        CHECK(lom_write_image(path, NULL, image, &error), "%s", error.text);
        lom_image *back = lom_read_image(path, &error);
        CHECK(back != NULL && lom_hash_image(back) == lom_hash_image(image), "%s: %s", path, error.text);
        lom_free_image(back);
        unlink(path);
    }
    lom_error error = { 0 };
    snprintf(path, sizeof path, "%s/a.gif", folder);
    CHECK(!lom_write_image(path, NULL, image, &error) && strncmp(error.text, path, strlen(path)) == 0, "%s",
          error.text);
    CHECK(lom_write_image(path, "png", image, NULL) && unlink(path) == 0, "the kind goes before the name");
    error = (lom_error){ 0 };
    CHECK(!lom_write_image("/dev/full", "png", image, &error) && error.code == LOM_ERROR_FILE, "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(lom_read_image(path, &error) == NULL && error.code == LOM_ERROR_FILE, "%s", error.text);
    lom_free_image(image);
    rmdir(folder);
}

int main(int argc, char **argv)
{
    RUN(formats);
    RUN(sizes);
    RUN(hashes);
    RUN(reinterpretation);
    RUN(files);
    return check_result();
}
