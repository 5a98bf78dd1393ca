/* Proves that pictures within pages are the bytes of a PNG: the vectors of RFC 4648, section 10, and what is encoded reads
 * back as the picture that is shown. */
#include "check.h"

#include "image/data_uri.h"

static char *uri_of(const char *bytes, size_t size)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    lom_print_data_uri(out, (lom_bytes){ (uint8_t *)(uintptr_t)bytes, size });
    fclose(out);
    return text;
}

static void vectors(void)
{
    static const char *const pairs[][2] = { { "", "" },
                                            { "f", "Zg==" },
                                            { "fo", "Zm8=" },
                                            { "foo", "Zm9v" },
                                            { "foob", "Zm9vYg==" },
                                            { "fooba", "Zm9vYmE=" },
                                            { "foobar", "Zm9vYmFy" },
                                            { "\xff\xef\xbe\xfb", "/+++"
                                                                  "+w==" } };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        char *text = uri_of(pairs[i][0], strlen(pairs[i][0]));
        CHECK(strncmp(text, "data:image/png;base64,", 22) == 0 && strcmp(text + 22, pairs[i][1]) == 0, "%s", text);
        free(text);
    }
}

/* Floats are linear light: 0.5 is 188 of 255 in sRGB (IEC 61966-2-1). */
static void floats_are_shown(void)
{
    lom_image *image = lom_create_image(1, 1, 1, LOM_FORMAT_RGB32F, NULL);
    float *samples = lom_image_pixel(image, 0, 0, 0);
    samples[0] = 0.5f;
    samples[1] = 1;
    samples[2] = 0;
    lom_bytes png = lom_encode_shown_image(image, NULL);
    lom_image *shown = lom_decode_image(png.data, png.size, "shown.png", NULL);
    CHECK(shown != NULL && shown->format == LOM_FORMAT_RGB8 && shown->pixels[0] == 188 && shown->pixels[1] == 255 &&
          shown->pixels[2] == 0);
    lom_free_image(shown);
    lom_release(png.data);
    lom_free_image(image);
}

int main(int argc, char **argv)
{
    RUN(vectors);
    RUN(floats_are_shown);
    return check_result();
}
