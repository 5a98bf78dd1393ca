/* Proves of sprites: pixels, depths and the count of fragments are those of the documented definition, evaluated one
 * sprite and one pixel after the other by scalars that know no tiles, windows or lanes, bit for bit: for every size of
 * tiles and chunks, cut by the edges of the picture and by the scissor, part of a larger frame, partly behind what
 * stands there, writing depth or reading it, round or not, in the order of their indices; what two triangles with the
 * same corners cover is what a sprite covers; what lies outside the clip volume or has no area is not drawn; what does
 * not fit together is refused. */
#include "stage.h"

enum { SPRITES = 60, LISTS = 12, WIDTH = 150, HEIGHT = 90 };

/* Attributes as draw_of says: position, the axes, and four values. */
static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    const lom_float4 *value = &in->attribute[3];
    out->position = in->attribute[0];
    out->axis[0] = in->attribute[1];
    out->axis[1] = in->attribute[2];
    out->varying[0] = value->x;
    out->varying[1] = value->y;
    out->varying[2] = value->z;
    out->varying[3] = value->w;
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float s = in->st[0], t = in->st[1];
    out->color[0] = (lom_float4){ in->varying[0] * s + in->dx[0], in->varying[1] * t + in->dy[1],
                                  in->varying[2] * in->x + in->y, in->varying[3] + in->w };
}

static void show_behind(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float s = in->st[0], t = in->st[1], share = in->target_depth - in->z;
    out->color[0] =
        (lom_float4){ in->varying[0] * s, in->varying[1] * t, in->varying[2] * share, in->varying[3] * (s * t) };
}

static void show_some(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show(out, in, uniforms);
    out->discard = in->st[0] * in->st[1] > 0.25f;
}

LOM_SHADER(sprite, place, show, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .reads_position = true,
           .colors = 1, .sprites = true)
LOM_SHADER(disc, place, show, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .reads_position = true,
           .colors = 1, .sprites = true, .round = true)
LOM_SHADER(holed, place, show_some, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .reads_position = true,
           .colors = 1, .sprites = true, .discards = true)
LOM_SHADER(soft, place, show_behind, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .reads_position = true, .colors = 1, .sprites = true, .reads_depth = true)
LOM_SHADER(ground, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(wrong, place, show, .attributes = 4, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .differentiates = 1u << 0,
           .colors = 1, .sprites = true)

static vertex sprites[SPRITES];
static uint32_t order[SPRITES];

/* Most are of some pixels; some are slivers, of no area, very large, or outside. */
static void make_sprites(void)
{
    for (int i = 0; i < SPRITES; i++) {
        float w = random_float(0.5f, 4), size = random_whole(0, 9) == 0 ? 3 : random_float(0.01f, 0.4f);
        vertex *v = &sprites[i];
        *v = (vertex){ .position = { random_float(-1.2f, 1.2f) * w, random_float(-1.2f, 1.2f) * w,
                                     random_float(-0.05f, 1.05f) * w, w } };
        for (int k = 0; k < 8; k++)
            v->value[k] = (k & 3) == 2 ? 0 : size * w * random_float(-1, 1);
        if (random_whole(0, 5) == 0)
            for (int k = 0; k < 4; k++)
                v->value[4 + k] = v->value[k] * (random_whole(0, 1) == 0 ? 1 : 1.00001f);
        for (int k = 0; k < 4; k++)
            v->distance[k] = random_float(0, 1);
        order[i] = (uint32_t)random_whole(0, SPRITES + 2); /* some name no vertex */
    }
}

/* ---- the definition ---- */

typedef struct plain {
    float color[HEIGHT][WIDTH][4], depth[HEIGHT][WIDTH]; /* depth in the attachment's units */
    uint64_t fragments;
} plain;

typedef struct given {
    const lom_shader *shader;
    lom_rect scissor, frame; /* frame: width and height, and where the attachments lie in it */
    double depth_scale;
    bool write_off;
} given;

static float units(const given *g, float z)
{
    return g->depth_scale == 0 ? z : (float)(int64_t)((double)z * g->depth_scale + 0.5);
}

static void draw_pixel(plain *p, const given *g, const vertex *v, const float st[2], const float d[4], float z, int x,
                       int y)
{
    int column = x - g->frame.x, row = y - g->frame.y;
    float *target = p->color[row][column], *stored = &p->depth[row][column], color[4],
          w = 1.0f / (1.0f / v->position[3]);
    const float *value = v->distance;
    bool passes = units(g, z) > *stored;
    p->fragments += passes || g->shader->discards; /* a shader that discards comes before the test */
    if (!passes)
        return;
    float behind = g->depth_scale == 0 ? *stored : *stored / (float)g->depth_scale;
    if (g->shader == &soft) {
        color[0] = value[0] * st[0];
        color[1] = value[1] * st[1];
        color[2] = value[2] * (behind - z);
        color[3] = value[3] * (st[0] * st[1]);
    } else {
        color[0] = value[0] * st[0] + d[0];
        color[1] = value[1] * st[1] + d[3];
        color[2] = value[2] * ((float)x + 0.5f) + ((float)y + 0.5f);
        color[3] = value[3] + w;
    }
    if (g->shader == &holed && st[0] * st[1] > 0.25f)
        return;
    for (int c = 0; c < 4; c++)
        target[c] = color[c] + target[c] * (1.0f - color[3]);
    if (!g->write_off)
        *stored = units(g, z);
}

static bool is_inside(const vertex *v)
{
    const float *p = v->position;
    return p[2] >= 0 && p[2] <= p[3];
}

/* Whether centre x lies in the pixels that the bounds touch: low to high are whole numbers. */
static bool is_near(int x, int64_t middle, float reach)
{
    double at = (double)middle / 256 - 0.5, low = at - (double)reach, high = at + (double)reach;
    return x > low - 1 && x < high + 1;
}

static void draw_plain(plain *p, const given *g, const vertex *v)
{
    int width = g->frame.width, height = g->frame.height;
    snapped middle = snap(v->position, width, height);
    float half[2] = { (float)width * 0.5f, (float)height * -0.5f }, side[2][2], w = v->position[3];
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++)
            side[i][k] = (v->value[4 * i + k] - v->position[k] / w * v->value[4 * i + 3]) / w * half[k];
    float reach[2] = { __builtin_fabsf(side[0][0]) + __builtin_fabsf(side[1][0]),
                       __builtin_fabsf(side[0][1]) + __builtin_fabsf(side[1][1]) };
    float area = side[0][0] * side[1][1] - side[0][1] * side[1][0];
    if (!is_inside(v) || !(__builtin_fabsf(area) >= 0x1p-16f))
        return;
    float d[4] = { side[1][1] / area, -side[1][0] / area, -side[0][1] / area, side[0][0] / area };
    for (int y = g->scissor.y; y < g->scissor.y + g->scissor.height; y++)
        for (int x = g->scissor.x; x < g->scissor.x + g->scissor.width; x++) {
            float dx = (float)(256 * x + 128 - middle.x) / 256, dy = (float)(256 * y + 128 - middle.y) / 256;
            float st[2] = { dx * d[0] + dy * d[1], dx * d[2] + dy * d[3] };
            bool covered = g->shader == &disc ? st[0] * st[0] + st[1] * st[1] < 1
                                              : st[0] >= -1 && st[0] < 1 && st[1] >= -1 && st[1] < 1;
            if (covered && is_near(x, middle.x, reach[0]) && is_near(y, middle.y, reach[1]))
                draw_pixel(p, g, v, st, d, v->position[2] / w, x, y);
        }
}

/* ---- the pipeline against it ---- */

static const lom_blend over = { .enabled = true,
                                .source_color = LOM_FACTOR_ONE,
                                .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                .source_alpha = LOM_FACTOR_ONE,
                                .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };

/* Something to be behind: a triangle that slopes, over part of the picture. */
static void draw_ground(stage *s, lom_pass_desc pass)
{
    static const vertex v[3] = { { .position = { -1, -3, 0.1f, 1 }, .value = { 0.2f, 0.3f, 0.4f, 1 } },
                                 { .position = { 3, -1, 0.9f, 1 }, .value = { 0.5f, 0.1f, 0.2f, 1 } },
                                 { .position = { -1, 1, 0.6f, 1 }, .value = { 0.1f, 0.6f, 0.3f, 1 } } };
    lom_draw_desc draw = draw_of(&ground, v, 3);
    begin(s, pass);
    lom_draw(s->device, &draw);
    finish(s);
}

/* Depth in the attachment's units. */
static float stored_at(const stage *s, const given *g, int x, int y)
{
    const void *at = lom_image_pixel(s->depths, x, y, 0);
    return g->depth_scale == 0 ? *(const float *)at : *(const uint16_t *)at;
}

static void take(plain *p, const stage *s, const given *g)
{
    p->fragments = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            memcpy(p->color[y][x], floats_at(s, x, y), sizeof p->color[y][x]);
            p->depth[y][x] = stored_at(s, g, x, y);
        }
}

static void compare(const plain *p, const stage *s, const given *g, int list)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const float *is = floats_at(s, x, y), *be = p->color[y][x];
            float z = stored_at(s, g, x, y), depth = p->depth[y][x];
            CHECK(
                memcmp(is, be, 16) == 0 && z == depth,
                "%s, list %d, pixel %d, %d: %.9g %.9g %.9g %.9g, depth %.9g instead of %.9g %.9g %.9g %.9g, depth %.9g",
                g->shader->name, list, x, y, (double)is[0], (double)is[1], (double)is[2], (double)is[3], (double)z,
                (double)be[0], (double)be[1], (double)be[2], (double)be[3], (double)depth);
        }
}

static void lists_are_the_definition(lom_device_desc desc, const lom_shader *shader, lom_format depth, int origin)
{
    static plain p;
    given g = { .shader = shader,
                .depth_scale = depth == LOM_FORMAT_DEPTH16 ? 65535 : 0,
                .frame = { origin, origin / 2, WIDTH + 2 * origin, HEIGHT + origin } };
    lom_pass_desc pass = {
        .frame_width = g.frame.width, .frame_height = g.frame.height, .origin_x = g.frame.x, .origin_y = g.frame.y
    };
    stage s = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA32F, depth);
    for (int list = 0; list < LISTS; list++) {
        make_sprites();
        draw_ground(&s, pass);
        g.scissor = list % 3 != 0 ? (lom_rect){ g.frame.x, g.frame.y, WIDTH, HEIGHT }
                                  : (lom_rect){ g.frame.x + (int)random_whole(0, WIDTH / 2),
                                                g.frame.y + (int)random_whole(0, HEIGHT / 2), WIDTH / 2, HEIGHT / 2 };
        g.write_off = shader == &soft || list % 2 != 0;
        take(&p, &s, &g);
        for (int i = 0; i < SPRITES; i++)
            if (order[i] < SPRITES)
                draw_plain(&p, &g, &sprites[order[i]]);
        lom_draw_desc draw = draw_of(shader, sprites, SPRITES);
        draw.topology = LOM_SPRITES;
        draw.indices = order;
        draw.blend[0] = over;
        draw.scissor = g.scissor;
        draw.depth_write_off = g.write_off;
        uint64_t before = lom_device_counters(s.device).fragments;
        lom_pass_desc second = pass;
        second.color_load[0] = second.depth_load = LOM_LOAD_KEEP;
        begin(&s, second);
        lom_draw(s.device, &draw);
        finish(&s);
        compare(&p, &s, &g, list);
        CHECK(lom_device_counters(s.device).fragments - before == p.fragments, "%s: %llu fragments, not %llu",
              shader->name, (unsigned long long)(lom_device_counters(s.device).fragments - before),
              (unsigned long long)p.fragments);
    }
    close_stage(&s);
}

static void sprites_are_what_is_written(void)
{
    static const lom_shader *const shaders[] = { &sprite, &disc, &holed, &soft };
    for (int i = 0; i < 4; i++) {
        lists_are_the_definition((lom_device_desc){ .threads = 1 }, shaders[i], LOM_FORMAT_DEPTH32F, 0);
        lists_are_the_definition((lom_device_desc){ .threads = 3, .tile = 16, .chunk = 16, .batch = 2 }, shaders[i],
                                 LOM_FORMAT_DEPTH16, 0);
        lists_are_the_definition((lom_device_desc){ .threads = 2, .tile = 32 }, shaders[i], LOM_FORMAT_DEPTH32F, 37);
    }
}

/* Formats, masks and blends that do not take the short way. */
static void a_draw_is_its_sprites_in_order(lom_format format, const lom_blend *blend, uint8_t mask_off)
{
    lom_device_desc desc = { .threads = 1 };
    stage a = open_stage(desc, WIDTH, HEIGHT, format, LOM_FORMAT_DEPTH32F),
          b = open_stage(desc, WIDTH, HEIGHT, format, LOM_FORMAT_DEPTH32F);
    make_sprites();
    lom_draw_desc draw = draw_of(&sprite, sprites, SPRITES);
    draw.topology = LOM_SPRITES;
    draw.blend[0] = *blend;
    draw.mask_off[0] = mask_off;
    begin(&a, (lom_pass_desc){ .clear_color = { { 0.1f, 0.2f, 0.3f, 0.4f } } });
    lom_draw(a.device, &draw);
    finish(&a);
    begin(&b, (lom_pass_desc){ .clear_color = { { 0.1f, 0.2f, 0.3f, 0.4f } } });
    draw.count = 1;
    for (; draw.first < SPRITES; draw.first++)
        lom_draw(b.device, &draw);
    finish(&b);
    CHECK(same_images(a.image, b.image) && same_images(a.depths, b.depths), "format %d, mask %d", (int)format,
          mask_off);
    close_stage(&a);
    close_stage(&b);
}

static void order_is_submission_order(void)
{
    static const lom_blend none = { .enabled = false };
    static const lom_format formats[] = { LOM_FORMAT_RGBA8, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_RGBA16F,
                                          LOM_FORMAT_RGBA32F };
    for (int i = 0; i < 4; i++) {
        a_draw_is_its_sprites_in_order(formats[i], &none, 0);
        a_draw_is_its_sprites_in_order(formats[i], &over, 0);
        a_draw_is_its_sprites_in_order(formats[i], &over, 5);
    }
}

/* Corners in units of 1/256 pixel; where no pixel centre is so near to an edge that rounding might decide. */
static bool is_clear_of_centres(const snapped *middle, const snapped *a, const snapped *b, int size)
{
    double area = (double)(a->x * b->y - a->y * b->x);
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            double dx = 256 * x + 128 - (double)middle->x, dy = 256 * y + 128 - (double)middle->y;
            double s = (dx * (double)b->y - dy * (double)b->x) / area,
                   t = (dy * (double)a->x - dx * (double)a->y) / area;
            double u = s < 0 ? 1 + s : 1 - s, v = t < 0 ? 1 + t : 1 - t;
            if ((u < 1e-4 && u > -1e-4) || (v < 1e-4 && v > -1e-4))
                return false;
        }
    return area > 256 * 256 || area < -256 * 256;
}

static bool is_drawn(const stage *s, int x, int y)
{
    return floats_at(s, x, y)[3] != 0;
}

static void covers_what_its_two_triangles_cover(void)
{
    enum { SIZE = 64, TRIES = 300 };
    stage s =
        open_stage((lom_device_desc){ .threads = 1, .tile = 16 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    int tried = 0;
    for (int i = 0; i < TRIES; i++) {
        snapped m = { random_whole(-2000, 18000), random_whole(-2000, 18000) }, a, b;
        a = (snapped){ random_whole(-4000, 4000), random_whole(-4000, 4000) };
        b = (snapped){ random_whole(-4000, 4000), random_whole(-4000, 4000) };
        if (!is_clear_of_centres(&m, &a, &b, SIZE))
            continue;
        tried++;
        vertex v = { .distance = { 0, 0, 0, 1 } };
        place_at(&v, m.x, m.y, SIZE);
        v.value[0] = (float)a.x / (SIZE * 128);
        v.value[1] = (float)-a.y / (SIZE * 128);
        v.value[4] = (float)b.x / (SIZE * 128);
        v.value[5] = (float)-b.y / (SIZE * 128);
        lom_draw_desc draw = draw_of(&sprite, &v, 1);
        draw.topology = LOM_SPRITES;
        begin(&s, (lom_pass_desc){ .samples = 1 });
        lom_draw(s.device, &draw);
        finish(&s);
        snapped corner[4];
        for (int k = 0; k < 4; k++)
            corner[k] = (snapped){ m.x + (k & 1 ? a.x : -a.x) + (k & 2 ? b.x : -b.x),
                                   m.y + (k & 1 ? a.y : -a.y) + (k & 2 ? b.y : -b.y) };
        const snapped other[3] = { corner[1], corner[3], corner[2] };
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++)
                CHECK(is_drawn(&s, x, y) == (covers(corner, x, y) || covers(other, x, y)), "try %d: pixel %d, %d", i, x,
                      y);
    }
    CHECK(tried > TRIES / 4, "only %d of %d were clear of pixel centres", tried, TRIES);
    close_stage(&s);
}

static uint64_t fragments_of(const vertex *v)
{
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 32, 32, LOM_FORMAT_RGBA32F, LOM_FORMAT_NONE);
    lom_draw_desc draw = draw_of(&sprite, v, 1);
    draw.topology = LOM_SPRITES;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    finish(&s);
    uint64_t fragments = lom_device_counters(s.device).fragments;
    close_stage(&s);
    return fragments;
}

static void what_cannot_be_seen_is_not_drawn(void)
{
    const vertex good = { .position = { 0, 0, 0.5f, 1 }, .value = { 0.25f, 0, 0, 0, 0, 0.25f } };
    CHECK(fragments_of(&good) == 64, "8 by 8 pixels have %llu fragments", (unsigned long long)fragments_of(&good));
    static const struct {
        const char *what;
        int member;
        float value;
    } cases[] = { { "before the near plane", 2, 1.01f },
                  { "behind the far plane", 2, -0.01f },
                  { "w below 0", 3, -1 },
                  { "a position that is no number", 0, 0.0f / 0.0f },
                  { "beside the guard band", 0, 1e6f },
                  { "an axis of nothing", 4, 0 },
                  { "an axis that is no number", 5, 0.0f / 0.0f },
                  { "an infinite axis", 4, 1.0f / 0.0f } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        vertex v = good;
        *(cases[i].member < 4 ? &v.position[cases[i].member] : &v.value[cases[i].member - 4]) = cases[i].value;
        CHECK(fragments_of(&v) == 0, "%s: %llu fragments", cases[i].what, (unsigned long long)fragments_of(&v));
    }
}

static void refused(const char *because, const lom_shader *shader, lom_topology topology, lom_format depth, float bias)
{
    static const vertex v[3] = { { .position = { 0, 0, 0.5f, 1 } } };
    stage s = open_stage((lom_device_desc){ .threads = 1 }, 8, 8, LOM_FORMAT_RGBA32F, depth);
    lom_draw_desc draw = draw_of(shader, v, 3);
    draw.topology = topology;
    draw.depth_bias = bias;
    begin(&s, (lom_pass_desc){ .samples = 1 });
    lom_draw(s.device, &draw);
    CHECK(!lom_end_pass(s.device) && strstr(lom_device_error(s.device)->text, because) != NULL, "\"%s\" instead of: %s",
          lom_device_error(s.device)->text, because);
    close_stage(&s);
}

static void what_does_not_fit_together_is_refused(void)
{
    refused("for sprites, but its draw is of triangles", &sprite, LOM_TRIANGLES, LOM_FORMAT_NONE, 0);
    refused("not for sprites, but its draw is of sprites", &ground, LOM_SPRITES, LOM_FORMAT_NONE, 0);
    refused("differentiates a varying", &wrong, LOM_SPRITES, LOM_FORMAT_NONE, 0);
    refused("a depth bias", &sprite, LOM_SPRITES, LOM_FORMAT_DEPTH32F, 1);
    refused("but the pass has none", &soft, LOM_SPRITES, LOM_FORMAT_NONE, 0);
    refused("which its draw would write", &soft, LOM_SPRITES, LOM_FORMAT_DEPTH32F, 0);
}

int main(int argc, char **argv)
{
    RUN(sprites_are_what_is_written);
    RUN(order_is_submission_order);
    RUN(covers_what_its_two_triangles_cover);
    RUN(what_cannot_be_seen_is_not_drawn);
    RUN(what_does_not_fit_together_is_refused);
    return check_result();
}
