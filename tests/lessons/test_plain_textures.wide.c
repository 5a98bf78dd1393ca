/* Proves that the pipeline in one file (docs/lessons/pipeline/pipeline.c) converts, makes levels of textures and samples
 * them as the library does: every code, both sides of every threshold, every texel of every level, coordinates and levels
 * of detail next to where something changes. */
#include "plain.h"

/* The smallest float with that code, by the lesson. */
static float find_threshold(int code)
{
    float low = 0, high = 1;
    while (nextafterf(low, high) < high) {
        float middle = (low + high) / 2;
        if (middle <= low || middle >= high)
            middle = nextafterf(low, high);
        *(encode(middle) >= code ? &high : &low) = middle;
    }
    return high;
}

/* Codes to light, all of them; light to codes on both sides of each threshold, so of all floats, since both increase. */
static void conversions_are_those_of_the_library(void)
{
    lom_image *codes = lom_create_image(256, 1, 1, LOM_FORMAT_R8_SRGB, NULL);
    lom_image *floats = lom_create_image(255 * 4, 1, 1, LOM_FORMAT_R32F, NULL);
    float *x = (float *)(void *)floats->pixels;
    for (int code = 0; code < 256; code++)
        codes->pixels[code] = (uint8_t)code;
    for (int code = 1; code < 256; code++, x += 4) {
        x[2] = find_threshold(code);
        x[1] = nextafterf(x[2], 0);
        x[0] = nextafterf(x[1], 0);
        x[3] = nextafterf(x[2], 1);
    }
    lom_image *decoded = lom_convert_image(codes, LOM_FORMAT_R32F, NULL);
    lom_image *encoded = lom_convert_image(floats, LOM_FORMAT_R8_SRGB, NULL);
    for (int code = 0; code < 256; code++)
        CHECK(decode(code) == ((const float *)(const void *)decoded->pixels)[code], "code %d", code);
    x = (float *)(void *)floats->pixels;
    for (int i = 0; i < 255 * 4; i++)
        CHECK(encode(x[i]) == encoded->pixels[i], "%.9g: %d, not %d", (double)x[i], encode(x[i]), encoded->pixels[i]);
    lom_free_image(codes);
    lom_free_image(floats);
    lom_free_image(decoded);
    lom_free_image(encoded);
}

static void levels_of_textures_are_those_of_the_library(void)
{
    static const int sizes[][2] = { { 64, 16 }, { 1, 32 }, { 128, 1 }, { 1, 1 }, { 256, 256 } };
    for (int i = 0; i < 5; i++) {
        struct skin skin = make_noise(sizes[i][0], sizes[i][1]);
        CHECK(skin.plain.levels == lom_texture_levels(skin.lanes), "%d levels", skin.plain.levels);
        for (int k = 0; k < skin.plain.levels; k++) {
            const struct level *level = &skin.plain.level[k];
            lom_image *image = lom_read_texture(skin.lanes, k, 0, NULL);
            CHECK(image->width == level->width && image->height == level->height, "level %d", k);
            for (int t = 0; t < 4 * level->width * level->height; t++) {
                float texel = level->texel[t / 4][t % 4], byte = image->pixels[t];
                CHECK(texel == (t % 4 < 3 ? decode(image->pixels[t]) : byte), "level %d, texel %d", k, t / 4);
            }
            lom_free_image(image);
        }
        free_skin(&skin);
    }
}

/* Coordinates next to where something changes, at every level and between. */
static void samples_are_those_of_the_library(void)
{
    static const float at[] = { 0,
                                -0.0f,
                                1,
                                -1,
                                0.5f,
                                0x1.fffffep-2f,
                                0x1.fffffep-1f,
                                0x1.fffffep-7f,
                                0x1.fffffcp-2f,
                                0x1.fffffcp-6f,
                                0x1.fffffcp-7f,
                                0x1.fffffcp-8f,
                                -0x1p-30f,
                                -0x1p-24f,
                                0x1p-24f,
                                0.25f,
                                0.3f,
                                -17.7f,
                                1e8f,
                                -1e8f,
                                0x1p23f,
                                3.1e-38f,
                                1e30f };
    static const float lods[] = { -2, -0.0f, 0x1p-30f, 0.5f, 0x1.fffffep-1f, 1, 2.7f, 0x1.fffffep+1f, 5, 9, 1000 };
    enum { PLACES = sizeof at / sizeof *at, LODS = sizeof lods / sizeof *lods };
    static const int sizes[][2] = { { 1, 32 }, { 64, 16 }, { 1, 1 } };
    for (int i = 0; i < 3; i++) {
        struct skin skin = make_noise(sizes[i][0], sizes[i][1]);
        for (int n = 0; n < PLACES * PLACES * LODS; n++) {
            struct fragment f = { .varying = { at[n % PLACES], at[n / PLACES % PLACES] },
                                  .lod = lods[n / PLACES / PLACES] };
            sample(&skin.plain, &f);
            lom_float4 texel =
                lom_sample(skin.lanes, lom_splat(f.varying[S]), lom_splat(f.varying[T]), lom_splat(f.lod));
            const float lanes[4] = { texel.x[0], texel.y[0], texel.z[0], texel.w[0] };
            CHECK(memcmp(lanes, f.texel, sizeof lanes) == 0, "(%a, %a) at level %a of %d x %d: %a plain, %a by lanes",
                  (double)f.varying[S], (double)f.varying[T], (double)f.lod, sizes[i][0], sizes[i][1],
                  (double)f.texel[0], (double)lanes[0]);
        }
        free_skin(&skin);
    }
}

int main(int argc, char **argv)
{
    RUN(conversions_are_those_of_the_library);
    RUN(levels_of_textures_are_those_of_the_library);
    RUN(samples_are_those_of_the_library);
    return check_result();
}
