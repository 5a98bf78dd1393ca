/* Proves that rows of a picture know the farthest of all that is from a place down, and that a ray which is not followed on where
 * they say that it meets nothing more finds what it finds without them, bit for bit: on beds that rise, fall and end, for rays
 * that go down, up and away, near one another and anywhere, and lanes that hold no number. */
#include "chance.h"
#include "check.h"

#include "water/picture_rays.h"

enum { WIDTH = 217, HEIGHT = 203 };

static float texels[WIDTH * HEIGHT];

/* A level bed under an eye that looks along it, with steps across and along, and places where there is none. */
static void paint(int holes, int steps, float rough)
{
    const float depth = 1 + 8 * unit(), rise = 0.5f * unit();
    float down[HEIGHT], across[WIDTH];
    for (int y = 0; y < HEIGHT; y++)
        down[y] = y > 0 && below(HEIGHT) >= steps ? down[y - 1] : 1 + rise * unit();
    for (int x = 0; x < WIDTH; x++)
        across[x] = x > 0 && below(WIDTH) >= steps ? across[x - 1] : 1 + rise * unit();
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const float reach = depth * down[y] * across[x] * (1 + rough * unit()) / (0.03f + 2 * (float)y / HEIGHT);
            texels[y * WIDTH + x] = 0.1f / reach;
        }
    for (int i = 0; i < holes; i++)
        texels[below(WIDTH * HEIGHT)] = 0;
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

static void rows_know_the_farthest_from_a_place_down(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    struct lom_far_rows rows = { .rows = 0 };
    lom_error error;
    for (int n = 0; n < 12; n++) {
        paint(n % 3, 20, 0.1f);
        lom_texture *depth = make_depth();
        const int edge = n == 11 ? HEIGHT + 1 : 5 + n;
        CHECK(lom_fill_far_rows(&rows, device, depth, edge, &error));
        const struct lom_far_uniform far = { rows.below, rows.rows };
        for (int y0 = 0; y0 < HEIGHT; y0++) {
            const float t = ((float)y0 + unit()) / HEIGHT;
            const float farthest = lom_farthest_below(&far, lom_splat(t))[LOM_LANES - 1];
            float least = 1;
            for (int i = (y0 > edge ? y0 - edge + 1 : 0) * WIDTH; i < WIDTH * HEIGHT; i++)
                least = texels[i] < least ? texels[i] : least;
            CHECK(farthest <= least, "picture %d at %d: %g, not %g", n, y0, (double)farthest, (double)least);
        }
        CHECK(n == 11 || n % 3 != 0 || lom_farthest_below(&far, lom_splat(0.9f))[0] > 0);
        lom_free_texture(depth);
    }
    lom_free_far_rows(&rows);
    lom_close_device(device);
}

struct packet {
    struct lom_surface_point at;
    lom_float3 d;
    lom_float range;
};

/* From a level surface one metre below the eye, which looks along -z. */
static struct packet make_packet(int k, float zoom)
{
    const float x = 1.6f * unit() - 0.8f, wide = k % 5 == 0 ? 1 : 0.02f, far = 1 + 40 * unit() * unit();
    const float to[3] = { unit() - 0.5f, -unit(), k % 4 == 0 ? unit() - 0.8f : -unit() };
    struct packet p = { .range = lom_splat(1 + 300 * unit() * unit()) };
    for (int i = 0; i < LOM_LANES; i++) {
        const bool odd = k % 40 == 0 && i == k % LOM_LANES;
        const float w = odd ? __builtin_nanf("") : far * (1 + wide * unit());
        p.at.w[i] = w;
        p.at.offset.x[i] = (x + wide * unit()) * w;
        p.at.offset.y[i] = k % 7 == 0 ? wide * w : -1;
        p.at.offset.z[i] = -w;
        p.at.x[i] = (0.5f + 0.5f * zoom * p.at.offset.x[i] / w) * WIDTH;
        p.at.y[i] = (0.5f - 0.5f * zoom * p.at.offset.y[i] / w) * HEIGHT;
        p.d.x[i] = to[0] + wide * unit();
        p.d.y[i] = to[1] + wide * unit();
        p.d.z[i] = to[2] + wide * unit();
    }
    return p;
}

static bool same(lom_float a, lom_float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static int count_ends(const struct lom_surface_uniforms *u, const struct packet *p)
{
    int ends = 0;
    for (int i = 1; i < u->steps; i++) {
        const lom_float length = lom_length_of_step(u, p->range, i);
        const lom_float3 place = lom_add3(p->at.offset, lom_scale3(p->d, length));
        ends += lom_meets_no_more(u, &u->behind, &p->at, p->d, p->range, i, lom_project_point(u, &u->behind, place),
                                  lom_splat_int(-1));
    }
    return ends;
}

static void rays_find_what_they_find_without_rows(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2 });
    struct lom_far_rows rows = { .rows = 0 };
    int ends = 0, found = 0;
    for (int n = 0; n < 40; n++) {
        lom_error error;
        paint(n % 4 == 0 ? 3 : 0, n % 3 * 10, n % 2 == 0 ? 0 : 0.3f);
        const float zoom = 0.7f + unit();
        struct lom_surface_uniforms u = { .side = 1, .reach = n % 5 == 0 ? 0.3f : 1, .steps = 4 + below(30) };
        u.pixel[0] = 1.0f / WIDTH;
        u.pixel[1] = 1.0f / HEIGHT;
        u.eye = (struct lom_eye_uniform){ .near_plane = 0.1f, .pixel = 0.003f };
        u.behind = (struct lom_picture_uniform){ .depth = make_depth(), .rows_sum = zoom + 0.1f };
        u.behind.scale[0] = u.pixel[0];
        u.behind.scale[1] = u.pixel[1];
        u.behind.clip_from_offset = (lom_matrix_uniform){
            { { zoom, 0, 0.1f * unit(), 0 }, { 0, zoom, 0.1f * unit(), 0 }, { 0, 0, 0, 0.1f }, { 0, 0, -1, 0 } }
        };
        CHECK(lom_fill_far_rows(&rows, device, u.behind.depth, LOM_PICTURE_ROW, &error));
        for (int k = 0; k < 500; k++) {
            const struct packet p = make_packet(k, zoom);
            u.behind.far = (struct lom_far_uniform){ .below = NULL };
            const struct lom_hit plain = lom_follow_ray(&u, &u.behind, &p.at, p.d, p.range);
            u.behind.far = (struct lom_far_uniform){ rows.below, rows.rows };
            const struct lom_hit quick = lom_follow_ray(&u, &u.behind, &p.at, p.d, p.range);
            ends += count_ends(&u, &p) > 0;
            found += lom_any(plain.found);
            CHECK(memcmp(&plain.found, &quick.found, sizeof plain.found) == 0 && same(plain.length, quick.length) &&
                      same(plain.s, quick.s) && same(plain.t, quick.t),
                  "picture %d, packet %d", n, k);
        }
        lom_free_texture((lom_texture *)u.behind.depth);
    }
    CHECK(ends > 1000 && found > 1000, "%d packets end early, %d find something", ends, found);
    lom_free_far_rows(&rows);
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(rows_know_the_farthest_from_a_place_down);
    RUN(rays_find_what_they_find_without_rows);
    return check_result();
}
