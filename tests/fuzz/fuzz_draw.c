/* Random descriptors through the public API: textures, passes, draws. Whatever is asked for, either the device holds an
 * error with a sentence, or the attachments hold numbers: no byte is read or written outside what the descriptors name
 * (under a sanitizer), no NaN is stored, and two devices of other threads and tiles draw the same bytes. */
#include "draw_output.h"
#include "draw_shaders.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { TEXTURES = 4, PASSES = 2, DRAWS = 3, MOST_TEXELS = 1 << 14 };

static void require(bool condition)
{
    if (!condition)
        abort();
}

/* ---- descriptors ---- */

/* Memory of exactly this size, so that a byte too many is seen; freed at the end. */
struct heap {
    void *blocks[64];
    int count;
};

static uint8_t *exact_memory(struct heap *heap, fuzz_bytes *in, size_t size)
{
    if (heap->count == sizeof heap->blocks / sizeof *heap->blocks)
        return NULL;
    uint8_t *memory = malloc(size != 0 ? size : 1);
    heap->blocks[heap->count++] = memory;
    uint8_t run[24];
    for (size_t i = 0; i < sizeof run; i++)
        run[i] = (uint8_t)take_byte(in);
    for (size_t i = 0; i < size; i++)
        memory[i] = run[i % sizeof run];
    return memory;
}

static lom_sampler_desc take_sampler(fuzz_bytes *in)
{
    lom_sampler_desc sampler = { .minify = (lom_filter)take_enum(in, LOM_FILTER_COUNT),
                                 .magnify = (lom_filter)take_enum(in, LOM_FILTER_LINEAR + 1),
                                 .wrap_s = (lom_wrap)take_enum(in, LOM_WRAP_COUNT),
                                 .wrap_t = (lom_wrap)take_enum(in, LOM_WRAP_COUNT) };
    take_floats(in, sampler.border, 4);
    sampler.lod_bias = take_float(in);
    sampler.lod_min = take_float(in);
    sampler.lod_max = take_float(in);
    return sampler;
}

/* Sides that are within the limits are small ones. */
static int take_side(fuzz_bytes *in)
{
    int side = take_int(in);
    return side > 64 && side <= LOM_MAX_SIZE ? 1 + side % 64 : side;
}

static lom_texture *take_texture(fuzz_bytes *in, struct heap *heap)
{
    lom_texture_desc desc = {
        .kind = (lom_texture_kind)(take_choice(in, 8) < 6 ? 0 : take_enum(in, LOM_TEXTURE_KIND_COUNT)),
        .format = (lom_format)take_enum(in, LOM_FORMAT_COUNT),
        .mips = (lom_mips)take_enum(in, LOM_MIPS_SUPPLIED)
    };
    desc.width = take_side(in);
    desc.height = take_bool(in) ? desc.width : take_side(in);
    desc.depth = take_choice(in, 4) == 3 ? take_side(in) : 0;
    if (take_bool(in))
        desc.sampler = take_sampler(in);
    int64_t layers = desc.kind == LOM_TEXTURE_CUBE ? 6 : desc.depth > 1 ? desc.depth : 1;
    bool small = desc.width > 0 && desc.height > 0 && (int64_t)desc.width * desc.height <= MOST_TEXELS &&
                 layers * desc.width * desc.height <= MOST_TEXELS;
    const lom_format_info *info = lom_describe_format(desc.format == LOM_FORMAT_NONE ? LOM_FORMAT_RGBA8 : desc.format);
    if (take_bool(in) && info != NULL && small)
        desc.pixels =
            exact_memory(heap, in,
                         (size_t)(layers * desc.width * desc.height) *
                             lom_format_size(desc.format == LOM_FORMAT_NONE ? LOM_FORMAT_RGBA8 : desc.format));
    else if (desc.width > 0 && desc.height > 0 && desc.width <= LOM_MAX_SIZE && desc.height <= LOM_MAX_SIZE && !small)
        desc.width = desc.height = 8;
    lom_error error = { 0 };
    lom_texture *texture = lom_create_texture(&desc, &error);
    require((texture != NULL) == (error.code == LOM_OK));
    return texture;
}

/* What a pass can draw into, so that most do: all of one size. */
static lom_texture *take_target(fuzz_bytes *in, bool depth)
{
    static const lom_format colors[] = { LOM_FORMAT_RGBA8,   LOM_FORMAT_RGBA8_SRGB, LOM_FORMAT_R8,  LOM_FORMAT_RGB16,
                                         LOM_FORMAT_RGBA16F, LOM_FORMAT_RGBA32F,    LOM_FORMAT_R32F };
    static const lom_format depths[] = { LOM_FORMAT_DEPTH32F, LOM_FORMAT_DEPTH24, LOM_FORMAT_DEPTH16 };
    lom_texture_desc desc = { .width = 37,
                              .height = 21,
                              .format = depth ? depths[take_choice(in, 3)] : colors[take_choice(in, 7)] };
    desc.mips = !depth && take_bool(in) ? LOM_MIPS_ALL : LOM_MIPS_NONE;
    desc.samples = take_choice(in, 4) == 3 ? 4 : 0;
    desc.stencil = depth && desc.format != LOM_FORMAT_DEPTH16 && take_choice(in, 4) != 3;
    return lom_create_texture(&desc, NULL);
}

static lom_pass_desc take_pass(fuzz_bytes *in, lom_texture *const textures[TEXTURES])
{
    lom_pass_desc pass = { .depth = take_bool(in) ? textures[take_choice(in, 8) / 7] : NULL,
                           .clip_range = (lom_clip_range)take_enum(in, 2),
                           .depth_load = (lom_load_action)take_enum(in, 2),
                           .clear_depth = take_float(in) };
    for (int i = take_choice(in, TEXTURES - 1); i >= 0; i--) {
        pass.color[i] = textures[take_choice(in, 16) == 15 ? 0 : 1 + i];
        pass.color_load[i] = (lom_load_action)take_enum(in, 2);
        take_floats(in, pass.clear_color[i], 4);
    }
    if (take_choice(in, 8) == 7) {
        pass.frame_width = take_int(in);
        pass.frame_height = take_int(in);
        pass.origin_x = take_int(in);
        pass.origin_y = take_int(in);
        pass.samples = take_choice(in, 8) == 7 ? take_int(in) : 0;
        pass.min_depth = take_float(in);
        pass.max_depth = take_bool(in) ? 1 - pass.min_depth : take_float(in);
    }
    pass.viewport = take_rect(in);
    if (pass.samples == 0 && take_choice(in, 4) == 3)
        pass.samples = 2 << take_choice(in, 2);
    pass.stencil_load = (lom_load_action)take_enum(in, 2);
    pass.clear_stencil = (uint8_t)take_byte(in);
    pass.scissor = take_rect(in);
    pass.feedback_only = take_choice(in, 32) == 31;
    return pass;
}

static lom_attribute take_attribute(fuzz_bytes *in, struct heap *heap)
{
    lom_attribute attribute = { .kind = (lom_attribute_kind)(take_bool(in) ? LOM_ATTRIBUTE_FLOAT4 : take_enum(in, 6)) };
    if (take_choice(in, 8) == 7)
        return attribute;
    size_t size = take_byte(in), stride = take_byte(in);
    attribute.stride = take_choice(in, 16) == 15 ? SIZE_MAX - stride : 4 * (stride % 9) + (stride > 250 ? 1 : 0);
    float *floats = (float *)(void *)exact_memory(heap, in, size);
    for (size_t i = 0; floats != NULL && i < size / 4 && take_bool(in); i++)
        floats[i] = take_float(in);
    attribute.data = floats;
    attribute.size = floats != NULL ? size : 0;
    return attribute;
}

static lom_draw_desc take_draw(fuzz_bytes *in, struct heap *heap, const struct uniforms *uniforms)
{
    lom_draw_desc draw = { .shader = take_choice(in, 32) == 31 ? NULL : shaders[take_choice(in, SHADERS)],
                           .uniforms = take_choice(in, 16) == 15 ? NULL : uniforms,
                           .topology = (lom_topology)take_enum(in, 3),
                           .cull = (lom_cull)take_enum(in, 3),
                           .front_clockwise = take_bool(in),
                           .depth_compare = (lom_compare)take_enum(in, 9) };
    draw.attribute[0] = take_attribute(in, heap);
    draw.attribute[1] = take_attribute(in, heap);
    draw.count = take_choice(in, 64) == 63 ? SIZE_MAX - take_byte(in) : take_byte(in);
    draw.first = take_choice(in, 4) == 3 ? take_byte(in) : 0;
    draw.index_bits = take_choice(in, 64) == 63 ? take_int(in) : take_bool(in) ? 16 : 32;
    draw.base_vertex = take_choice(in, 4) == 3 ? take_int(in) : 0;
    draw.vertex_count = take_choice(in, 4) == 3 ? (size_t)(int64_t)take_int(in) : 0;
    draw.instances = take_choice(in, 4) == 3 ? (take_int(in) & INT32_MIN) + take_choice(in, 4) : 0;
    draw.restart = take_bool(in);
    if (take_bool(in) && draw.count < 256)
        draw.indices = exact_memory(heap, in, (draw.first + draw.count) * (draw.index_bits == 16 ? 2 : 4));
    if (take_bool(in)) {
        draw.depth_test_off = take_bool(in);
        draw.depth_write_off = take_bool(in);
        draw.depth_bias = take_float(in);
        draw.depth_bias_slope = take_float(in);
        draw.depth_bias_clamp = take_float(in);
        for (int i = 0; i < 2; i++) {
            draw.blend[i] = take_blend(in);
            draw.mask_off[i] = (uint8_t)take_byte(in);
        }
    }
    draw.scissor = take_rect(in);
    if (take_choice(in, 4) == 3) {
        draw.topology = LOM_SPRITES;
        draw.shader = take_bool(in) ? &fuzz_sprite : &fuzz_soft;
    }
    if (take_choice(in, 4) == 3) {
        static const lom_topology others[] = { LOM_POINTS, LOM_LINES, LOM_LINE_STRIP };
        draw.topology = others[take_choice(in, 3)];
        draw.line_width = take_byte(in) - 1;
    }
    if (take_choice(in, 4) == 3) {
        draw.depth_clamp = take_bool(in);
        draw.provoking = (lom_provoking)take_enum(in, 2);
        draw.divisor[1] = take_int(in) % 4;
    }
    return draw;
}

/* Stages for a draw that has none yet; `behind` lives as long as the pass. */
static void take_stages(fuzz_bytes *in, struct heap *heap, struct behind *behind, lom_draw_desc *draw)
{
    *behind = (struct behind){ .tessellation = fuzz_patches, .geometry = fuzz_scatter };
    int which = take_choice(in, 8);
    if (which & 1) {
        behind->tessellation.domain = (lom_domain)take_enum(in, 3);
        behind->tessellation.spacing = (lom_spacing)take_enum(in, 3);
        behind->tessellation.points = take_bool(in);
        behind->tessellation.clockwise = take_bool(in);
        draw->tessellation = &behind->tessellation;
        draw->topology = LOM_PATCHES;
        draw->patch_points = take_choice(in, 16) == 15 ? take_int(in) : 1 + take_choice(in, 4);
    }
    if (which & 2) {
        static const lom_topology from[] = { LOM_TRIANGLES, LOM_LINES, LOM_POINTS, LOM_PATCHES };
        static const lom_topology to[] = { LOM_TRIANGLE_STRIP, LOM_LINE_STRIP, LOM_POINTS, LOM_LINES };
        behind->geometry.in = from[take_choice(in, 16) % 5 % 4];
        behind->geometry.out = to[take_choice(in, 16) % 5 % 4];
        behind->geometry.vertices = take_choice(in, 16) == 15 ? take_int(in) : 1 + take_choice(in, 9);
        draw->geometry = &behind->geometry;
    }
    if (which & 4) {
        behind->feedback.size = 4 * (size_t)take_byte(in);
        behind->feedback.data = (float *)(void *)exact_memory(heap, in, behind->feedback.size);
        behind->feedback.size = behind->feedback.data != NULL ? behind->feedback.size : 0;
        behind->feedback.position = take_bool(in);
        behind->feedback.varyings = (uint32_t)take_byte(in);
        draw->feedback = &behind->feedback;
    }
}

/* ---- edges ---- */

/* The last bytes of the input say where triangles end is kept, and smoothed: so what the bytes before them ask for stays what
 * it was when they were found. */
enum { EDGE_BYTES = 8 };

static fuzz_bytes take_end(const uint8_t *data, size_t size)
{
    const size_t count = size < EDGE_BYTES ? size : EDGE_BYTES;
    return (fuzz_bytes){ data + (size - count), count };
}

/* A texture for edges as most targets are large, or a wrong one. */
static void keep_edges(fuzz_bytes *in, lom_texture *edges, lom_texture *const textures[TEXTURES], lom_pass_desc *pass)
{
    if (!take_bool(in))
        return;
    const int wrong = take_choice(in, 16);
    pass->edges = wrong >= 14 ? textures[wrong & 3] : edges;
    pass->edges_load = (lom_load_action)(wrong & 1);
    if (wrong < 12) { /* as most passes with edges are: one colour, depth, one sample */
        pass->depth = textures[0];
        pass->color[1] = pass->color[2] = NULL;
        pass->samples = wrong < 10 ? 0 : pass->samples;
    }
}

/* A pass into `smoothed` from what the passes before have left, if it is asked for. */
static bool smooth(fuzz_bytes *in, lom_device *device, lom_texture *const textures[TEXTURES], const lom_texture *edges,
                   lom_texture *smoothed)
{
    const lom_edge_filter filter = { .color = textures[take_choice(in, 8) == 7 ? 0 : 1],
                                     .edges = edges,
                                     .depth = textures[0],
                                     .origin_x = (int)take_byte(in) - 8 };
    if (!take_bool(in))
        return true;
    lom_begin_pass(device, &(lom_pass_desc){ .color = { smoothed }, .samples = take_choice(in, 4) == 3 ? 4 : 0 });
    lom_smooth_edges(device, &filter);
    return lom_end_pass(device);
}

/* ---- one run ---- */

static void check_texture(const lom_texture *texture, uint64_t *hash)
{
    lom_image *image = texture != NULL ? lom_read_texture(texture, 0, -1, NULL) : NULL;
    if (image == NULL)
        return;
    *hash = *hash * 31 + lom_hash_image(image);
    const lom_format_info *info = lom_describe_format(image->format);
    for (size_t i = 0; info->is_float && info->bits == 32 && i < lom_image_size(image); i += 4) {
        float value;
        memcpy(&value, image->pixels + i, sizeof value);
        require(value - value == 0);
    }
    lom_free_image(image);
}

static void check_stencil(const lom_texture *texture, uint64_t *hash)
{
    lom_image *image = texture != NULL ? lom_read_stencil(texture, NULL) : NULL;
    if (image != NULL)
        *hash = *hash * 31 + lom_hash_image(image);
    lom_free_image(image);
}

/* A texture of the targets' size. */
static lom_texture *make_plain_target(lom_device *device)
{
    return lom_make_texture(device, &(lom_texture_desc){ .width = 37, .height = 21 });
}

/* A hash of all textures, or of the error. */
static uint64_t run(fuzz_bytes in, fuzz_bytes end, const lom_device_desc *desc)
{
    struct heap heap = { .count = 0 };
    lom_device *device = lom_open_device(desc);
    require(device != NULL && lom_device_error(device)->code == LOM_OK);
    lom_texture *textures[TEXTURES];
    for (int i = 0; i < TEXTURES; i++)
        textures[i] = take_choice(&in, 8) == 7 ? take_texture(&in, &heap) : take_target(&in, i == 0);
    static const uint8_t texels[4] = { 9, 99, 200, 255 };
    lom_texture *plain = lom_make_texture(device, &(lom_texture_desc){ .width = 1, .height = 1, .pixels = texels });
    const struct uniforms uniforms = { plain };
    lom_texture *edges = make_plain_target(device), *smoothed = make_plain_target(device);
    lom_query *queries[QUERIES];
    for (int i = 0; i < QUERIES; i++)
        queries[i] = lom_make_query(device);
    int passes = 1 + take_choice(&in, PASSES);
    bool done = true;
    uint64_t fed = LOM_HASH_START;
    for (int p = 0; p < passes; p++) {
        lom_pass_desc pass = take_pass(&in, textures);
        keep_edges(&end, edges, textures, &pass);
        struct behind behind[DRAWS + 1] = { { .feedback = { .size = 0 } } };
        if (take_choice(&in, 32) != 31)
            lom_begin_pass(device, &pass);
        for (int d = take_choice(&in, DRAWS + 1); d > 0; d--) {
            lom_draw_desc draw = take_draw(&in, &heap, &uniforms);
            if (take_bool(&in))
                take_output(&in, queries, &draw);
            if (take_choice(&in, 4) == 3)
                take_stages(&in, &heap, &behind[d], &draw);
            lom_draw(device, &draw);
        }
        done = lom_end_pass(device);
        for (int d = 0; done && d <= DRAWS; d++) {
            const lom_feedback *f = &behind[d].feedback;
            require(f->written <= f->needed);
            if (f->written != 0)
                fed = lom_hash_bytes(fed, f->data, f->written * lom_feedback_stride(f));
        }
    }
    done = done && smooth(&end, device, textures, edges, smoothed);
    const lom_error *error = lom_device_error(device);
    require(done == (error->code == LOM_OK) && (error->code == LOM_OK) == (error->text[0] == 0));
    uint64_t hash = (uint64_t)error->code + fed, samples = 0;
    for (int i = 0; done && i < QUERIES; i++)
        hash = hash * 31 + (lom_query_result(queries[i], &samples) ? samples : 1);
    for (int i = 0; done && i < TEXTURES; i++)
        check_texture(textures[i], &hash);
    for (int i = 0; done && i < 2; i++)
        check_texture(i == 0 ? edges : smoothed, &hash);
    check_stencil(textures[0], &hash);
    for (int i = 0; i < TEXTURES; i++)
        lom_free_texture(textures[i]);
    lom_close_device(device);
    for (int i = 0; i < heap.count; i++)
        free(heap.blocks[i]);
    return hash;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const fuzz_bytes in = { data, size }, end = take_end(data, size);
    uint64_t one = run(in, end, &(lom_device_desc){ .threads = 1, .lanes = 4, .tile = 64 });
    uint64_t other = run(in, end, &(lom_device_desc){ .threads = 2, .lanes = 4, .tile = 16, .chunk = 16, .batch = 1 });
    require(one == other);
    return 0;
}
