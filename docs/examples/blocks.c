/* A town of 900 blocks, written to blocks.png, in three passes: what the sun sees; what the eye sees, as colours, normals and
 * depths in targets of their own; and the light on that.
 *
 *   lom-cc blocks.c -o blocks
 *
 * The blocks are one draw of one cube: place and size are attributes of each instance, the kind of wall is one of three
 * instances (divisor), and walls are layers of one array texture. What the sun sees reaches no farther than what the eye
 * sees: blocks before its near plane have the plane's own depth (depth_clamp) and throw their shadows all the same. The
 * last pass draws no triangle of the town: it looks the three targets up. */
#include <lom/lom.h>

#include <stdio.h>
#include <string.h>

enum { NORMAL, S = 3, T, LAYER, VARYINGS };
enum { LAYERS = 4, ACROSS = 30, BLOCKS = ACROSS * ACROSS + 1, KINDS = (BLOCKS + 2) / 3 };

struct camera {
    lom_matrix_uniform clip_from_world;
    const lom_texture *walls; /* one layer each kind */
};

struct light {
    lom_matrix_uniform world_from_clip, sun_from_world;
    const lom_texture *color, *normal, *depth, *shadow;
    float sun[3], width, height;
};

/* ---- the blocks: attributes 0 and 1 of the cube's vertices, 2 of instances, 3 of three instances ---- */

static lom_float3 place(const lom_attributes *in)
{
    const lom_float4 corner = in->attribute[0], block = in->attribute[2]; /* x, z, half its width, its height */
    return (lom_float3){ block.x + corner.x * block.z, (corner.y + 1.0f) * 0.5f * block.w,
                         block.y + corner.z * block.z };
}

static void see_from_the_sun(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct camera *u = uniforms;
    out->position = lom_transform4(&u->clip_from_world, place(in));
}

static void see(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct camera *u = uniforms;
    const lom_float4 corner = in->attribute[0], normal = in->attribute[1], block = in->attribute[2];
    const lom_mask is_roof = normal.y != 0.0f;
    const lom_float scale = block.z * (1.0f / 3), across = lom_select(normal.x != 0.0f, corner.z, corner.x);
    out->position = lom_transform4(&u->clip_from_world, place(in));
    out->varying[NORMAL] = normal.x;
    out->varying[NORMAL + 1] = normal.y;
    out->varying[NORMAL + 2] = normal.z;
    out->varying[S] = lom_select(is_roof, corner.x, across) * scale; /* a wall's picture is 3 m wide and high */
    out->varying[T] = lom_select(is_roof, corner.z * scale, (1.0f - corner.y) * block.w * (1.0f / 6));
    out->varying[LAYER] = lom_select(is_roof, lom_splat(0), in->attribute[3].x);
}

static void keep(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct camera *u = uniforms;
    const lom_float *v = in->varying;
    out->color[0] = lom_sample_array(u->walls, v[S], v[T], v[LAYER], lom_lod(u->walls, in, S, T));
    out->color[1] =
        (lom_float4){ v[NORMAL] * 0.5f + 0.5f, v[NORMAL + 1] * 0.5f + 0.5f, v[NORMAL + 2] * 0.5f + 0.5f, lom_splat(1) };
}

LOM_DEPTH_SHADER(shadow, see_from_the_sun, .attributes = 3, .uniforms_size = sizeof(struct camera))
LOM_SHADER(town, see, keep, .attributes = 4, .varyings = VARYINGS, .reads = LOM_VARYINGS(NORMAL, VARYINGS),
           .differentiates = LOM_VARYINGS(S, 2), .flat = LOM_VARYINGS(NORMAL, 3) | LOM_VARYINGS(LAYER, 1), .colors = 2,
           .uniforms_size = sizeof(struct camera))

/* ---- the light: a triangle over the whole picture ---- */

static void cover(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    const lom_float s = lom_to_float(in->vertex & 1), t = lom_to_float(in->vertex >> 1);
    out->position = (lom_float4){ 4.0f * s - 1.0f, 4.0f * t - 1.0f, { 0 }, lom_splat(1) };
}

/* Which part of the sunlight arrives: four comparisons around the place, each of four texels. */
static lom_float find_sunlight(const struct light *u, lom_float3 at)
{
    const lom_float4 p = lom_transform4(&u->sun_from_world, at); /* w is 1: the sun's rays are parallel */
    const lom_float s = p.x * 0.5f + 0.5f, t = 0.5f - p.y * 0.5f, step = lom_splat(0.75f / 2048);
    lom_float sum = { 0 };
    for (int i = 0; i < 4; i++)
        sum += lom_sample_compare(u->shadow, s + (i & 1 ? step : -step), t + (i & 2 ? step : -step), p.z + 0.0012f,
                                  LOM_COMPARE_GREATER_EQUAL);
    return sum * 0.25f;
}

/* How much nearer than the plane of the pixel its neighbourhood is: the depth, near / distance, is linear in the window
 * over a plane, so there the mean around a pixel is its own. Four lookups gather sixteen depths. */
static lom_float find_hollow(const struct light *u, lom_float s, lom_float t, lom_float depth)
{
    lom_float sum = { 0 };
    for (int i = 0; i < 4; i++) {
        const float right = (i & 1 ? 4.0f : -4.0f) / u->width, down = (i & 2 ? 4.0f : -4.0f) / u->height;
        const lom_float4 d = lom_sample_gather(u->depth, s + right, t + down, 0);
        const lom_float around[4] = { d.x, d.y, d.z, d.w };
        for (int k = 0; k < 4; k++)
            sum += lom_clamp(around[k] / depth - 1.0f, lom_splat(-0.02f), lom_splat(0.02f));
    }
    return lom_saturate(sum * (1 / (16 * 0.02f)));
}

static void shine(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct light *u = uniforms;
    const lom_int x = lom_to_int(in->x), y = lom_to_int(in->y);
    const lom_float s = in->x / u->width, t = in->y / u->height, depth = lom_fetch(u->depth, x, y, 0).x;
    const lom_mask is_sky = depth == 0.0f;
    const lom_float safe = lom_select(is_sky, lom_splat(1e-4f), depth);
    const lom_float4 color = lom_fetch(u->color, x, y, 0), code = lom_fetch(u->normal, x, y, 0);
    const lom_float3 ndc = { s * 2.0f - 1.0f, 1.0f - t * 2.0f, safe };
    const lom_float4 p = lom_transform4(&u->world_from_clip, ndc);
    const lom_float3 at = { p.x / p.w, p.y / p.w, p.z / p.w };
    const lom_float lambert =
        (code.x * 2.0f - 1.0f) * u->sun[0] + (code.y * 2.0f - 1.0f) * u->sun[1] + (code.z * 2.0f - 1.0f) * u->sun[2];
    const lom_float sun = lom_max(lambert, lom_splat(0)) * find_sunlight(u, at);
    const lom_float sky = (0.55f + 0.25f * (code.y * 2.0f - 1.0f)) * (1.0f - 0.9f * find_hollow(u, s, t, safe));
    const lom_float haze = lom_saturate(0.00024f / safe - 0.12f),
                    clear = 1.0f - haze; /* the depth is 0.1 m over the distance */
    const lom_float lit[3] = { color.x * (2.4f * sun + 0.30f * sky), color.y * (2.0f * sun + 0.40f * sky),
                               color.z * (1.5f * sun + 0.58f * sky) };
    const float air[3] = { 0.78f, 0.70f, 0.60f }, high[3] = { 0.30f, 0.47f, 0.72f };
    lom_float out3[3];
    for (int i = 0; i < 3; i++) {
        const lom_float above = lom_saturate(1.6f * (0.30f - t)), heaven = air[i] + (high[i] - air[i]) * above;
        out3[i] = lom_select(is_sky, heaven, lit[i] * clear + air[i] * haze);
    }
    out->color[0] = (lom_float4){ out3[0], out3[1], out3[2], lom_splat(1) };
}

LOM_SHADER(lighting, cover, shine, .reads_position = true, .colors = 1, .uniforms_size = sizeof(struct light))

#if LOM_LANES == 4 /* the rest of the file is compiled once */

enum { WIDTH = 640, HEIGHT = 360, MAP = 2048, WALL = 64 };

struct world {
    float corner[24][6]; /* of a cube: place, normal */
    uint32_t index[36];
    float block[BLOCKS][4], kind[KINDS];
    uint8_t wall[LAYERS][WALL][WALL][4];
};

static void make_cube(struct world *w)
{
    for (uint32_t face = 0; face < 6; face++) {
        const uint32_t axis = face / 2, first = face * 4;
        const float side = face % 2 == 0 ? 1 : -1;
        for (uint32_t i = 0; i < 4; i++) {
            float *corner = w->corner[first + i];
            corner[axis] = corner[3 + axis] = side;
            corner[(axis + 1) % 3] = i % 2 == 0 ? -side : side;
            corner[(axis + 2) % 3] = i < 2 ? -1 : 1;
        }
        const uint32_t order[6] = { 0, 1, 3, 0, 3, 2 };
        for (uint32_t i = 0; i < 6; i++)
            w->index[face * 6 + i] = first + order[i];
    }
}

/* The ground, a block without height, then rows of blocks that are higher in the middle of the town. */
static void make_town(struct world *w)
{
    const float ground[4] = { 0, 0, 2000, 0 };
    memcpy(w->block[0], ground, sizeof ground);
    for (int i = 1; i < BLOCKS; i++) {
        double number[2];
        lom_random_normal(7, (uint64_t)i, number);
        const float x = (float)((i - 1) % ACROSS - ACROSS / 2) * 13 + 6,
                    z = (float)((i - 1) / ACROSS - ACROSS / 2) * 13;
        const float away = (x * x + z * z) / 9000, tall = 24 / (1 + away) + 5, some = (float)number[0] * 0.35f + 0.8f;
        const float block[4] = { x, z, 3.6f + 0.5f * (float)number[1], tall * (some > 0.25f ? some : 0.25f) };
        memcpy(w->block[i], block, sizeof block);
    }
    for (int i = 0; i < KINDS; i++)
        w->kind[i] = (float)(1 + i * 7 % 3);
}

static void make_walls(struct world *w)
{
    static const float tone[LAYERS][3] = { { 120, 116, 110 }, { 168, 106, 82 }, { 214, 204, 182 }, { 150, 158, 168 } };
    for (int layer = 0; layer < LAYERS; layer++)
        for (int y = 0; y < WALL; y++)
            for (int x = 0; x < WALL; x++) {
                const int narrow = layer == 3 ? 2 : 18; /* of the third kind windows are ribbons */
                const bool is_window = layer != 0 && x >= narrow && x < WALL - narrow && y >= 16 && y < 46;
                const float grain = 1 + 0.10f * (float)((x * 7 + y * 13 + x * y * 3) % 11 - 5) / 5;
                for (int c = 0; c < 3; c++)
                    w->wall[layer][y][x][c] = is_window ? (uint8_t)(38 + 9 * c) : (uint8_t)(tone[layer][c] * grain);
                w->wall[layer][y][x][3] = 255;
            }
}

static lom_draw_desc draw_of(const struct world *w, const lom_shader *shader, const struct camera *camera)
{
    lom_draw_desc draw = { .shader = shader,
                           .uniforms = camera,
                           .indices = w->index,
                           .count = 36,
                           .instances = BLOCKS,
                           .divisor = { 0, 0, 1, 3 },
                           .cull = LOM_CULL_BACK };
    draw.attribute[0] = (lom_attribute){ w->corner[0], sizeof w->corner, 24, LOM_ATTRIBUTE_FLOAT3 };
    draw.attribute[1] = (lom_attribute){ w->corner[0] + 3, sizeof w->corner - 12, 24, LOM_ATTRIBUTE_FLOAT3 };
    draw.attribute[2] = (lom_attribute){ w->block, sizeof w->block, 16, LOM_ATTRIBUTE_FLOAT4 };
    draw.attribute[3] = (lom_attribute){ w->kind, sizeof w->kind, 4, LOM_ATTRIBUTE_FLOAT1 };
    return draw;
}

static lom_texture *make_target(lom_device *device, int width, int height, lom_format format)
{
    lom_texture_desc desc = { .width = width, .height = height, .format = format };
    desc.sampler.wrap_s = desc.sampler.wrap_t = LOM_WRAP_CLAMP;
    return lom_make_texture(device, &desc);
}

static bool draw(lom_device *device, const struct world *w, lom_texture *picture)
{
    const lom_vec3 sun = { -0.60, 0.44, 0.668 }, up = { 0, 1, 0 }, seen = { 0, 0, -20 };
    const lom_vec3 sun_eye = { seen.x + 400 * sun.x, seen.y + 400 * sun.y, seen.z + 400 * sun.z };
    lom_mat4 look = lom_look_at(sun_eye, seen, up), box = lom_orthographic(300, 300, 290, 560);
    const lom_mat4 from_sun = lom_multiply(&box, &look);
    look = lom_look_at((lom_vec3){ 52, 54, 96 }, (lom_vec3){ -6, 2, -14 }, up);
    box = lom_perspective(0.62, (double)WIDTH / HEIGHT, 0.1);
    const lom_mat4 from_eye = lom_multiply(&box, &look);
    lom_mat4 back;
    lom_invert(&from_eye, &back);

    const lom_texture_desc walls = { .kind = LOM_TEXTURE_2D_ARRAY,
                                     .width = WALL,
                                     .height = WALL,
                                     .depth = LAYERS,
                                     .format = LOM_FORMAT_RGBA8_SRGB,
                                     .pixels = w->wall,
                                     .mips = LOM_MIPS_ALL };
    lom_texture *map = make_target(device, MAP, MAP, LOM_FORMAT_DEPTH32F);
    lom_texture *color = make_target(device, WIDTH, HEIGHT, LOM_FORMAT_RGBA8_SRGB);
    lom_texture *normal = make_target(device, WIDTH, HEIGHT, LOM_FORMAT_RGBA8);
    lom_texture *depth = make_target(device, WIDTH, HEIGHT, LOM_FORMAT_DEPTH32F);
    struct camera camera = { lom_round_matrix(&from_sun), lom_make_texture(device, &walls) };

    lom_draw_desc blocks = draw_of(w, &shadow, &camera);
    blocks.depth_clamp = true;
    lom_begin_pass(device, &(lom_pass_desc){ .depth = map });
    lom_draw(device, &blocks);
    lom_end_pass(device);

    camera.clip_from_world = lom_round_matrix(&from_eye);
    blocks = draw_of(w, &town, &camera);
    lom_begin_pass(device, &(lom_pass_desc){ .color = { color, normal }, .depth = depth });
    lom_draw(device, &blocks);
    lom_end_pass(device);

    const struct light light = { lom_round_matrix(&back),
                                 lom_round_matrix(&from_sun),
                                 color,
                                 normal,
                                 depth,
                                 map,
                                 { (float)sun.x, (float)sun.y, (float)sun.z },
                                 WIDTH,
                                 HEIGHT };
    lom_begin_pass(device, &(lom_pass_desc){ .color = { picture } });
    lom_draw(device, &(lom_draw_desc){ .shader = &lighting, .uniforms = &light, .count = 3 });
    return lom_end_pass(device);
}

int main(void)
{
    static struct world world;
    lom_error error = { .code = LOM_OK };
    lom_device *device = lom_open_device(&(lom_device_desc){ 0 });
    lom_texture *picture = make_target(device, WIDTH, HEIGHT, LOM_FORMAT_RGBA8_SRGB);
    make_cube(&world);
    make_town(&world);
    make_walls(&world);
    lom_image *image = draw(device, &world, picture) ? lom_read_texture(picture, 0, 0, &error) : NULL;
    const bool done = image != NULL && lom_write_image("blocks.png", NULL, image, &error);
    if (done)
        printf("%016llx\n", (unsigned long long)lom_hash_image(image));
    else
        fprintf(stderr, "blocks: %s %s\n", lom_device_error(device)->text, error.text);
    lom_free_image(image);
    lom_close_device(device);
    return done ? 0 : 2;
}

#endif
