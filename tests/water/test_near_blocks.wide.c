/* Proves that blocks of a picture know the nearest of all that is about a place, and that what a blur reads of a picture and
 * what a ray finds in it are with them, bit for bit, what they are without: for pictures that show little, things before and
 * behind the surface, colour without depth, places on, beyond and between texels, and lanes that hold no number. */
#include "chance.h"
#include "check.h"

#include "water/picture_rays.h"

enum { WIDTH = 333, HEIGHT = 271 };

static float texels[WIDTH * HEIGHT], colors[WIDTH * HEIGHT * 4];

/* Rectangles and single texels on nothing. */
static void paint(int count, bool with_depth)
{
    memset(texels, 0, sizeof texels);
    memset(colors, 0, sizeof colors);
    for (int n = 0; n < count; n++) {
        const int x0 = below(WIDTH), y0 = below(HEIGHT), width = 1 + below(n % 3 == 0 ? 1 : 20), height = 1 + below(9);
        const float depth = 0.1f / (1 + 200 * unit());
        for (int y = y0; y < y0 + height && y < HEIGHT; y++)
            for (int x = x0; x < x0 + width && x < WIDTH; x++) {
                texels[y * WIDTH + x] = with_depth ? depth : 0;
                for (int i = 0; i < 4; i++)
                    colors[4 * (y * WIDTH + x) + i] = i < 3 ? unit() : 1;
            }
    }
}

/* The picture as targets hold it, in bytes or in floats. */
static lom_texture *make_color(bool bytes)
{
    static uint8_t codes[WIDTH * HEIGHT * 4];
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        codes[i] = (uint8_t)(colors[i] * 255);
    lom_error error;
    return lom_create_texture(&(lom_texture_desc){ .width = WIDTH,
                                                   .height = HEIGHT,
                                                   .format = bytes ? LOM_FORMAT_RGBA8_SRGB : LOM_FORMAT_RGBA32F,
                                                   .pixels = bytes ? (const void *)codes : colors,
                                                   .mips = LOM_MIPS_ALL,
                                                   .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP } },
                              &error);
}

static lom_texture *make_depth(void)
{
    lom_error error;
    return lom_create_texture(&(lom_texture_desc){ .width = WIDTH,
                                                   .height = HEIGHT,
                                                   .format = LOM_FORMAT_DEPTH32F,
                                                   .pixels = texels,
                                                   .sampler = { .wrap_s = LOM_WRAP_CLAMP,
                                                                .wrap_t = LOM_WRAP_CLAMP,
                                                                .magnify = LOM_FILTER_NEAREST,
                                                                .minify = LOM_FILTER_NEAREST } },
                              &error);
}

struct picture {
    struct lom_surface_uniforms u;
    struct lom_near_blocks blocks;
    lom_texture *color, *depth;
};

static void make_picture(struct picture *p, lom_device *device, bool bytes)
{
    lom_error error;
    memset(p, 0, sizeof *p);
    p->color = make_color(bytes);
    p->depth = make_depth();
    CHECK(p->color != NULL && p->depth != NULL);
    CHECK(lom_fill_near_blocks(&p->blocks, device, p->color, p->depth, LOM_PICTURE_BLOCK, &error));
    p->u.side = 1;
    p->u.reach = 1;
    p->u.pixel[0] = 1.0f / WIDTH;
    p->u.pixel[1] = 1.0f / HEIGHT;
    p->u.eye = (struct lom_eye_uniform){ .near_plane = 0.1f, .pixel = 0.003f, .far_reach = 300, .depth_reach = 300 };
    p->u.mirrored = (struct lom_picture_uniform){ .color = p->color, .depth = p->depth };
    p->u.mirrored.scale[0] = p->u.pixel[0];
    p->u.mirrored.scale[1] = p->u.pixel[1];
}

static void free_picture(struct picture *p)
{
    lom_free_texture(p->color);
    lom_free_texture(p->depth);
    lom_free_near_blocks(&p->blocks);
}

static struct lom_near_uniform near_of(const struct picture *p)
{
    return (struct lom_near_uniform){ p->blocks.around, p->blocks.columns, p->blocks.rows };
}

static void blocks_know_the_nearest_about_a_place(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    for (int n = 0; n < 12; n++) {
        struct picture p;
        paint(4 + 3 * n, n % 3 != 0);
        make_picture(&p, device, n % 2 == 0);
        const struct lom_near_uniform near = near_of(&p);
        for (int k = 0; k < 400; k++) {
            const int x0 = below(WIDTH), y0 = below(HEIGHT);
            const float s = ((float)x0 + unit()) / WIDTH, t = ((float)y0 + unit()) / HEIGHT;
            const float nearest = lom_nearest_around(&near, lom_splat(s), lom_splat(t))[LOM_LANES - 1];
            float most = 0;
            bool colored = false;
            for (int y = y0 > 62 ? y0 - 62 : 0; y <= y0 + 62 && y < HEIGHT; y++)
                for (int x = x0 > 62 ? x0 - 62 : 0; x <= x0 + 62 && x < WIDTH; x++) {
                    most = texels[y * WIDTH + x] > most ? texels[y * WIDTH + x] : most;
                    colored |= colors[4 * (y * WIDTH + x) + 3] > 0;
                }
            CHECK(nearest >= most && (nearest > 0 || !colored), "picture %d at %d, %d: %g, not %g", n, x0, y0,
                  (double)nearest, (double)most);
        }
        free_picture(&p);
    }
    lom_close_device(device);
}

static float place(int kind)
{
    static const float odd[] = { 0, 1, -0.0f, -3, 7, 1e30f, -1e30f, 1e-40f, 0.99999994f };
    if (kind == 0)
        return unit() < 0.2f ? __builtin_nanf("") : unit() < 0.2f ? __builtin_inff() : odd[below(9)];
    return 1.2f * unit() - 0.1f;
}

static bool same(lom_float a, lom_float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* Lanes near one another, as those of a packet are, or anywhere. */
static void blurs_are_what_they_are_without_blocks(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    int differ = 0;
    for (int n = 0; n < 24; n++) {
        struct picture p;
        paint(1 + 2 * n, n % 4 != 1);
        make_picture(&p, device, n % 2 == 0);
        p.u.eye.parallel = n % 5 == 4;
        for (int k = 0; k < 300; k++) {
            struct lom_surface_point at = { .w = { 0 } };
            struct lom_hit hit = { .found = lom_splat_int(-1) };
            lom_float variance = { 0 };
            const float s = unit(), t = unit(), far = 1 + 60 * unit() * unit();
            for (int i = 0; i < LOM_LANES; i++) {
                const bool odd = k % 10 == 0 && i % 3 == 0, close = k % 4 != 0;
                hit.s[i] = odd ? place(0) : close ? s + 0.02f * unit() : place(1);
                hit.t[i] = odd ? place(0) : close ? t + 0.02f * unit() : place(1);
                hit.length[i] = odd ? place(0) : 30 * unit();
                at.x[i] = hit.s[i] * WIDTH + 4 * unit();
                at.y[i] = hit.t[i] * HEIGHT + 90 * unit();
                at.w[i] = odd ? place(0) : far + unit();
                variance[i] = odd && k % 20 == 0 ? place(0) : 0.02f * unit() * unit();
            }
            struct lom_picture_uniform *picture = &p.u.mirrored;
            picture->near = (struct lom_near_uniform){ .around = NULL };
            const lom_float4 plain = lom_texel_of_hit(&p.u, picture, &at, hit, true, variance);
            picture->near = near_of(&p);
            const lom_float4 quick = lom_texel_of_hit(&p.u, picture, &at, hit, true, variance);
            const struct lom_surroundings around = lom_surroundings_of(&p.u, picture, &at, hit);
            differ += around.open != around.empty;
            CHECK(same(plain.x, quick.x) && same(plain.y, quick.y) && same(plain.z, quick.z) && same(plain.w, quick.w),
                  "picture %d, packet %d", n, k);
        }
        free_picture(&p);
    }
    CHECK(differ > 100, "%d packets before something that is farther", differ);
    lom_close_device(device);
}

/* Rays from about a place before an eye that looks along -z, near one another or anywhere, through pictures that show little. */
static void rays_find_what_they_find_without_blocks(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    int skipped = 0, found = 0;
    for (int n = 0; n < 24; n++) {
        struct picture p;
        paint(n % 2 == 0 ? n / 2 : 6 * n, n % 4 != 0);
        make_picture(&p, device, n % 2 == 0);
        struct lom_picture_uniform *picture = n % 3 == 0 ? &p.u.behind : &p.u.mirrored;
        const float zoom = 0.7f + 2 * unit();
        p.u.behind = p.u.mirrored;
        p.u.steps = 4 + below(30);
        p.u.reach = n % 5 == 0 ? 0.3f : 1;
        picture->clip_from_offset = (lom_matrix_uniform){
            { { zoom, 0, 0.1f * unit(), 0 }, { 0, zoom, 0.1f * unit(), 0 }, { 0, 0, 0, 0.1f }, { 0, 0, -1, 0 } }
        };
        picture->rows_sum = zoom + 0.1f;
        for (int k = 0; k < 500; k++) {
            const float x = unit() - 0.5f, y = unit() - 0.5f, far = 1 + 40 * unit(), wide = k % 5 == 0 ? 1 : 0.02f;
            const float side = k % 3 == 0 ? 1 : 0.1f; /* many go away from the eye */
            const float to[3] = { x + side * (unit() - 0.5f), y + side * (unit() - 0.5f), -unit() };
            struct lom_surface_point at = { .w = { 0 } };
            lom_float3 d;
            lom_float range = lom_splat(0.1f + 300 * unit() * unit());
            for (int i = 0; i < LOM_LANES; i++) {
                const bool odd = k % 40 == 0 && i == k % LOM_LANES;
                at.w[i] = odd ? place(0) : far * (1 + wide * unit());
                at.offset.x[i] = (x + wide * unit()) * at.w[i];
                at.offset.y[i] = (y + wide * unit()) * at.w[i];
                at.offset.z[i] = -at.w[i];
                at.x[i] = (0.5f + 0.5f * zoom * at.offset.x[i] / at.w[i]) * WIDTH;
                at.y[i] = (0.5f - 0.5f * zoom * at.offset.y[i] / at.w[i]) * HEIGHT;
                d.x[i] = to[0] + wide * unit();
                d.y[i] = to[1] + wide * unit();
                d.z[i] = odd ? place(0) : to[2] + wide * unit();
            }
            picture->near = (struct lom_near_uniform){ .around = NULL };
            const struct lom_hit plain = lom_follow_ray(&p.u, picture, &at, d, range);
            picture->near = near_of(&p);
            const struct lom_hit quick = lom_follow_ray(&p.u, picture, &at, d, range);
            skipped += lom_shows_nothing_along(&p.u, picture, &at, d, range);
            found += lom_any(plain.found);
            CHECK(memcmp(&plain.found, &quick.found, sizeof plain.found) == 0 && same(plain.length, quick.length) &&
                      same(plain.s, quick.s) && same(plain.t, quick.t),
                  "picture %d, packet %d", n, k);
        }
        free_picture(&p);
    }
    CHECK(skipped > 500 && found > 40, "%d packets are spared, %d find something", skipped, found);
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(blocks_know_the_nearest_about_a_place);
    RUN(blurs_are_what_they_are_without_blocks);
    RUN(rays_find_what_they_find_without_blocks);
    return check_result();
}
