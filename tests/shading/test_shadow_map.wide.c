/* Proves that the nine texels of a depth map about a place are those of nine lookups, and that the sun's shadow is with blocks of
 * its maps what it is without, bit for bit: for maps that show little, of even and odd sizes, with and without a border, places
 * on, beyond and between texels, lanes together and apart, and lanes that hold no number. */
#include "chance.h"
#include "check.h"

#include "shading/depth_square.h"
#include "shading/sun_shadow.h"

enum { WIDTH = 203, HEIGHT = 128 };

/* Rectangles on nothing. */
static lom_texture *make_map(int width, int height, int count, lom_wrap wrap)
{
    static float texels[WIDTH * HEIGHT];
    lom_error error;
    memset(texels, 0, sizeof texels);
    for (int n = 0; n < count; n++) {
        const int x0 = below(width), y0 = below(height), x1 = x0 + 1 + below(9), y1 = y0 + 1 + below(9);
        const float depth = unit();
        for (int y = y0; y < y1 && y < height; y++)
            for (int x = x0; x < x1 && x < width; x++)
                texels[y * width + x] = depth;
    }
    return lom_create_texture(&(lom_texture_desc){ .width = width,
                                                   .height = height,
                                                   .format = LOM_FORMAT_DEPTH32F,
                                                   .pixels = texels,
                                                   .sampler = { .wrap_s = wrap,
                                                                .wrap_t = wrap,
                                                                .magnify = LOM_FILTER_NEAREST,
                                                                .minify = LOM_FILTER_NEAREST } },
                              &error);
}

static float odd_place(void)
{
    static const float odd[] = { 0, 1, -0.0f, -3, 7, 1e30f, -1e30f, 1e-40f, 0.99999994f };
    const float kind = unit();
    return kind < 0.2f ? __builtin_nanf("") : kind < 0.4f ? __builtin_inff() : odd[below(9)];
}

static bool same(lom_float a, lom_float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static void squares_are_nine_lookups(void)
{
    static const lom_wrap wraps[] = { LOM_WRAP_CLAMP, LOM_WRAP_BORDER, LOM_WRAP_REPEAT };
    for (int n = 0; n < 9; n++) {
        const int width = n % 2 == 0 ? WIDTH : 64, height = n % 4 < 2 ? HEIGHT : 33;
        lom_texture *map = make_map(width, height, 90, wraps[n % 3]);
        CHECK(map != NULL);
        for (int k = 0; k < 3000; k++) {
            lom_float s[3], t[3];
            for (int i = 0; i < LOM_LANES; i++) {
                const float x = k % 3 == 0 ? 1.2f * unit() - 0.1f : unit(), y = 1.2f * unit() - 0.1f;
                const float step = k % 5 == 0 ? 2 * unit() : 1;
                for (int j = 0; j < 3; j++) {
                    s[j][i] = k % 7 == 0 && i == k % LOM_LANES ? odd_place() : x + (float)j * step / (float)width;
                    t[j][i] = k % 7 == 1 && i == k % LOM_LANES ? odd_place() : y + (float)j / (float)height;
                }
            }
            const struct lom_depth_square plain = lom_defined_depth_square(map, s, t);
            const struct lom_depth_square quick = lom_find_depth_square(map, s, t);
            for (int j = 0; j < 9; j++)
                CHECK(same(plain.at[j / 3][j % 3], quick.at[j / 3][j % 3]) &&
                          same(plain.at[j / 3][j % 3], lom_find_depth(map, s[j % 3], t[j / 3])),
                      "map %d, places %d, texel %d", n, k, j);
        }
        lom_free_texture(map);
    }
}

static struct lom_sun_shadow_uniform make_sun(lom_texture *const map[2], const struct lom_near_blocks near[2],
                                              bool cascaded)
{
    struct lom_sun_shadow_uniform sun = { .count = 2, .cascaded = cascaded };
    for (int i = 0; i < 2; i++) {
        const float scale = i == 0 ? 1 : 0.4f;
        sun.map[i] = (struct lom_shadow_map_uniform){ .map = map[i],
                                                      .near = { near[i].around, near[i].columns, near[i].rows },
                                                      .s = { scale, 0, 0, 0.5f - scale / 2 },
                                                      .t = { 0, 0, scale, 0.5f - scale / 2 },
                                                      .depth = { 0, 1, 0, 0 },
                                                      .size = HEIGHT,
                                                      .texel = 1.0f / HEIGHT,
                                                      .offset = 0.01f };
    }
    return sun;
}

static void find_share(const struct lom_sun_shadow_uniform *sun, const lom_float3 *at, const lom_float3 *normal,
                       lom_float *share)
{
    LOM_WIDE(lom_entity_light)(sun, at, normal, share);
}

static void shadows_are_what_they_are_without_blocks(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    int dark = 0, open = 0;
    for (int n = 0; n < 16; n++) {
        lom_texture *map[2] = { make_map(HEIGHT, HEIGHT, 1 + n, LOM_WRAP_BORDER),
                                make_map(HEIGHT, HEIGHT, 2 * n, LOM_WRAP_BORDER) };
        struct lom_near_blocks near[2] = { { .columns = 0 }, { .columns = 0 } };
        lom_error error;
        for (int i = 0; i < 2; i++)
            CHECK(map[i] != NULL && lom_fill_near_blocks(&near[i], device, NULL, map[i], LOM_SHADOW_BLOCK, &error));
        const struct lom_sun_shadow_uniform sun = make_sun(map, near, n % 2 == 0);
        struct lom_sun_shadow_uniform plain = sun;
        for (int i = 0; i < 2; i++)
            plain.map[i].near.around = NULL;
        for (int k = 0; k < 2000; k++) {
            const float x = 1.2f * unit() - 0.1f, z = 1.2f * unit() - 0.1f, wide = k % 4 == 0 ? 1 : 0.03f;
            lom_float3 at, normal;
            for (int i = 0; i < LOM_LANES; i++) {
                const bool odd = k % 9 == 0 && i == k % LOM_LANES;
                at.x[i] = odd ? odd_place() : x + wide * unit();
                at.y[i] = odd ? odd_place() : unit();
                at.z[i] = odd ? odd_place() : z + wide * unit();
                normal.x[i] = 0.6f;
                normal.y[i] = 0.8f;
                normal.z[i] = 0;
            }
            lom_float with, without;
            find_share(&sun, &at, &normal, &with);
            find_share(&plain, &at, &normal, &without);
            dark += lom_any(without < 1.0f);
            open += lom_all(without == 1.0f);
            CHECK(same(with, without), "maps %d, places %d", n, k);
        }
        for (int i = 0; i < 2; i++) {
            lom_free_texture(map[i]);
            lom_free_near_blocks(&near[i]);
        }
    }
    CHECK(dark > 1000 && open > 1000, "%d packets with shadow, %d without", dark, open);
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(squares_are_nine_lookups);
    RUN(shadows_are_what_they_are_without_blocks);
    return check_result();
}
