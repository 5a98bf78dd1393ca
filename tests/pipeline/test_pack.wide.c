/* Proves that small triangles whose fragments are computed together, and larger ones whose values are found once for all
 * of their packets, end as those drawn one by one and packet by packet, bit for bit: random heaps of them, drawn by both
 * paths, with every comparison of depths, with and without writing them, in every depth
 * format, with one sample a pixel and with several, blended and opaque, shaders that read everything or nothing at all. */
#include "pipeline/device.h"
#include "stage.h"

enum { WIDTH = 150, HEIGHT = 90, TRIANGLES = 700 };

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place_values(out, in, uniforms);
    out->varying[4] = in->attribute[2].x;
    out->distance[0] = in->attribute[3].x;
}

static void show_all(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0] + lom_dx(in, 1), in->varying[1] * in->z,
                                  in->varying[4] + in->w * 0x1p-4f, lom_select(in->front, in->x, in->y) * 0x1p-8f };
    out->discard = in->varying[2] > 0.7f;
}

static void show_quads(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float x = lom_quad_dx(in->varying[0]), y = lom_quad_dy(in->varying[0]);
    out->color[0] = (lom_float4){ x + in->w * 0x1p-4f, y + in->varying[1], in->z, in->varying[4] };
}

/* Levels of more pairs of varyings than a triangle keeps, one twice, and of two textures. */
static void show_levels(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    lom_texture *const *texture = uniforms;
    lom_float sum = lom_lod(texture[0], in, 0, 1) + lom_lod(texture[1], in, 0, 1) + lom_lod(texture[0], in, 1, 0) +
                    lom_lod(texture[0], in, 2, 3) + lom_lod(texture[0], in, 0, 3) + lom_lod(texture[1], in, 3, 1);
    lom_float4 texel = lom_sample(texture[0], in->varying[0], in->varying[1], lom_lod(texture[0], in, 0, 1));
    out->color[0] = (lom_float4){ texel.x, sum * 0x1p-6f, lom_lod(texture[1], in, 3, 1) * 0x1p-3f, texel.w };
}

LOM_SHADER(levels, place_values, show_levels, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .differentiates = LOM_VARYINGS(0, 4), .colors = 1, .uniforms_size = 2 * sizeof(lom_texture *))
LOM_SHADER(values, place_values, show_values, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 1)
LOM_SHADER(everything, place, show_all, .attributes = 4, .varyings = 5, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, 5), .differentiates = 1u << 1, .flat = 1u << 4, .reads_position = true,
           .discards = true, .colors = 1)
LOM_SHADER(quads, place, show_quads, .attributes = 4, .varyings = 5, .clip_distances = 1,
           .reads = LOM_VARYINGS(0, 2) | 1u << 4, .flat = 1u << 4, .reads_position = true, .quads = true, .colors = 1)
LOM_SHADER(early, place, show_values, .attributes = 4, .varyings = 5, .clip_distances = 1, .reads = LOM_VARYINGS(0, 4),
           .colors = 1)
LOM_DEPTH_SHADER(depth_only, place_values, .attributes = 2, .varyings = 4)

static vertex vertices[3 * TRIANGLES];

/* Heaps of triangles of up to a dozen pixels, a few larger; depths of few values, so that many are equal. Of some triangles
 * w is 1, or values are the same at all vertices, one of them -0: what is found once for all packets differs by that. */
static void make_heap(void)
{
    for (size_t t = 0; t < TRIANGLES; t++) {
        float reach = t % 50 == 0 ? 1.5f : t % 7 == 0 ? 0.3f : 0.05f;
        float x = random_float(-0.6f, 0.6f), y = random_float(-0.6f, 0.6f), z = (float)random_whole(0, 7) / 8;
        for (size_t k = 0; k < 3; k++) {
            vertex *v = &vertices[3 * t + k];
            float w = t % 4 == 0 ? 1.0f : random_float(0.5f, 2);
            v->position[0] = (x + random_float(-reach, reach)) * w;
            v->position[1] = (y + random_float(-reach, reach)) * w;
            v->position[2] = (t % 3 == 0 ? random_float(0, 1) : z) * w;
            v->position[3] = w;
            for (int i = 0; i < 8; i++)
                v->value[i] = t % 3 == 0 && k > 0 ? vertices[3 * t].value[i] : random_float(0, 1);
            if (t % 3 == 0)
                v->value[t % 4] = -0.0f;
            v->distance[0] = t % 9 == 0 ? random_float(-1, 1) : 1.0f;
        }
    }
}

static uint64_t draw_heap(stage *s, const lom_draw_desc *draw, int samples)
{
    uint64_t before = lom_device_counters(s->device).fragments;
    begin(s, (lom_pass_desc){ .samples = samples, .clear_color = { { 0.1f, 0.2f, 0.3f, 0.4f } }, .clear_depth = 0.5f });
    lom_draw(s->device, draw);
    finish(s);
    return lom_device_counters(s->device).fragments - before;
}

static lom_texture *make_texture(int size)
{
    static uint8_t pixels[64 * 64 * 4];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)random_whole(0, 255);
    const lom_texture_desc desc = { .width = size,
                                    .height = size,
                                    .format = LOM_FORMAT_RGBA8,
                                    .pixels = pixels,
                                    .mips = LOM_MIPS_ALL,
                                    .sampler = { .filtering = LOM_FILTERING_FIXED } };
    return lom_create_texture(&desc, NULL);
}

static void heaps_in(lom_device_desc desc, lom_format color, lom_format depth, int samples)
{
    static const lom_shader *const shaders[] = { &values, &everything, &early, &depth_only, &quads, &levels };
    lom_texture *const textures[2] = { make_texture(64), make_texture(16) };
    stage alone = open_stage(desc, WIDTH, HEIGHT, color, depth), packed = open_stage(desc, WIDTH, HEIGHT, color, depth);
    alone.device->one_by_one = true;
    for (int compare = LOM_COMPARE_DEFAULT; compare <= LOM_COMPARE_ALWAYS; compare++)
        for (int kind = 0; kind < 12; kind++) {
            make_heap();
            lom_draw_desc draw = draw_of(shaders[kind % 6], vertices, 3 * TRIANGLES);
            draw.depth_compare = (lom_compare)compare;
            draw.uniforms = textures;
            draw.depth_write_off = compare % 3 == 0 && kind >= 6;
            draw.blend[0] = kind >= 6 ? adding() : (lom_blend){ .enabled = false };
            draw.cull = (lom_cull)(compare % 3);
            if (kind == 7)
                draw.scissor = (lom_rect){ 31, 17, 83, 54 };
            uint64_t fragments[2] = { draw_heap(&alone, &draw, samples), draw_heap(&packed, &draw, samples) };
            CHECK(same_images(alone.image, packed.image), "compare %d, kind %d, tile %d, format %d", compare, kind,
                  desc.tile, (int)color);
            CHECK(depth == LOM_FORMAT_NONE || same_images(alone.depths, packed.depths), "depths: compare %d, kind %d",
                  compare, kind);
            CHECK(fragments[0] == fragments[1], "compare %d, kind %d: %llu fragments alone, %llu packed", compare, kind,
                  (unsigned long long)fragments[0], (unsigned long long)fragments[1]);
        }
    close_stage(&alone);
    close_stage(&packed);
    lom_free_texture(textures[0]);
    lom_free_texture(textures[1]);
}

static void packed_triangles_end_as_those_drawn_one_by_one(void)
{
    heaps_in((lom_device_desc){ .tile = 64, .threads = 2 }, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F, 1);
    heaps_in((lom_device_desc){ .tile = 16, .threads = 1, .chunk = 100 }, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH16, 1);
    heaps_in((lom_device_desc){ .tile = 32, .threads = 1, .batch = 1 }, LOM_FORMAT_RGBA16F, LOM_FORMAT_DEPTH24, 1);
    heaps_in((lom_device_desc){ .threads = 1 }, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_NONE, 1);
}

static void packed_triangles_of_several_samples_end_likewise(void)
{
    heaps_in((lom_device_desc){ .tile = 64, .threads = 2 }, LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_DEPTH32F, 4);
    heaps_in((lom_device_desc){ .tile = 16, .threads = 1, .chunk = 100 }, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH16, 2);
    heaps_in((lom_device_desc){ .tile = 32, .threads = 1, .batch = 1 }, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH24, 8);
    heaps_in((lom_device_desc){ .tile = 32, .threads = 1 }, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH24, 4);
}

int main(int argc, char **argv)
{
    RUN(packed_triangles_end_as_those_drawn_one_by_one);
    RUN(packed_triangles_of_several_samples_end_likewise);
    return check_result();
}
