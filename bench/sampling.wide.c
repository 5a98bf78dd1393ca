/* Nanoseconds a sample at one width: make bench-sampling. In: random textures, packets of 4 rows that walk over them in
 * steps of 1.3 texels, slightly turned; out: a line a case, the best of 40 walks in processor time. The figure holds
 * everything a shader pays: coordinates, level of detail where it says so, the call, and the use of four channels. */
#include <lom/texture.h>

#include <stdio.h>
#include <time.h>

enum { COLUMNS = 1024, ROWS = 64, PASSES = 40 };

typedef struct bench_case {
    const char *name;
    lom_texture_kind kind;
    int size;
    lom_format format;
    lom_mips mips;
    lom_filter filter;
    enum { LOD_NONE, LOD_PACKET, LOD_LANE } lod; /* computed by lom_lod_of, one a packet or one a lane */
} bench_case;

static const bench_case cases[] = {
    { "RGBA8 nearest", 0, 1024, LOM_FORMAT_RGBA8, 0, LOM_FILTER_NEAREST, LOD_NONE },
    { "RGBA8 bilinear", 0, 1024, LOM_FORMAT_RGBA8, 0, 0, LOD_NONE },
    { "RGBA8 trilinear, level by packet", 0, 1024, LOM_FORMAT_RGBA8, LOM_MIPS_ALL, 0, LOD_PACKET },
    { "RGBA8 trilinear, level by lane", 0, 1024, LOM_FORMAT_RGBA8, LOM_MIPS_ALL, 0, LOD_LANE },
    { "RGBA8 sRGB bilinear", 0, 1024, LOM_FORMAT_RGBA8_SRGB, 0, 0, LOD_NONE },
    { "RGBA8 sRGB trilinear, level by packet", 0, 1024, LOM_FORMAT_RGBA8_SRGB, LOM_MIPS_ALL, 0, LOD_PACKET },
    { "R32F bilinear", 0, 1024, LOM_FORMAT_R32F, 0, 0, LOD_NONE },
    { "RGBA32F bilinear", 0, 512, LOM_FORMAT_RGBA32F, 0, 0, LOD_NONE },
    { "RGBA8 3D 64^3, one level", LOM_TEXTURE_3D, 64, LOM_FORMAT_RGBA8, 0, 0, LOD_NONE },
    { "RGBA8 cube 256^2, one level", LOM_TEXTURE_CUBE, 256, LOM_FORMAT_RGBA8, 0, 0, LOD_NONE },
};

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static lom_texture *make_texture(const bench_case *c, lom_filtering filtering)
{
    lom_error error = { 0 };
    int depth = c->kind == LOM_TEXTURE_3D ? c->size : 1, layers = c->kind == LOM_TEXTURE_CUBE ? 6 : depth;
    size_t count = (size_t)c->size * (size_t)c->size * (size_t)layers * lom_format_size(c->format);
    uint8_t *pixels = lom_allocate(count, 1, &error);
    for (size_t i = 0; pixels != NULL && i < count; i++)
        pixels[i] = (uint8_t)lom_random_bits(1, i) & 0x3f; /* floats of any such bytes are small */
    lom_texture *texture = NULL;
    if (pixels != NULL)
        texture = lom_create_texture(
            &(lom_texture_desc){ .kind = c->kind,
                                 .width = c->size,
                                 .height = c->size,
                                 .depth = depth,
                                 .format = c->format,
                                 .pixels = pixels,
                                 .mips = c->mips,
                                 .sampler = { .minify = c->filter, .magnify = c->filter, .filtering = filtering } },
            &error);
    lom_release(pixels);
    if (texture == NULL)
        fprintf(stderr, "%s\n", error.text);
    return texture;
}

static lom_float4 one_packet(const bench_case *c, const lom_texture *texture, int x, int y)
{
    lom_int lane = lom_lane_index();
    lom_float fx = lom_to_float((lane >> 2) + x), fy = lom_to_float((lane & 3) + y), zero = { 0 };
    float step = 1.3f / (float)c->size, texel = 1.0f / (float)c->size;
    lom_float s = fx * step + fy * (step * 0.2f) + 0.1f, t = fy * step - fx * (step * 0.2f) + 0.2f, lod = zero;
    if (c->lod != LOD_NONE) {
        lom_float width = lom_splat(1.0f + (float)(x % 7) * 0.4f);
        if (c->lod == LOD_LANE)
            width = 1.0f + lom_to_float((lane * 5 + x) & 7) * 0.4f;
        lod = lom_lod_of(texture, width * texel, zero, zero, width * texel);
    }
    if (c->kind == LOM_TEXTURE_3D)
        return lom_sample_3d(texture, s, t, s * 0.7f, lod);
    if (c->kind == LOM_TEXTURE_CUBE)
        return lom_sample_cube(texture, (lom_float3){ s - 0.9f, t - 0.5f, lom_splat(0.6f) }, lod);
    return lom_sample(texture, s, t, lod);
}

static double walk(const bench_case *c, const lom_texture *texture, lom_float4 *sum)
{
    double start = seconds();
    for (int y = 0; y < ROWS; y += 4)
        for (int x = 0; x < COLUMNS; x += LOM_LANES / 4) {
            lom_float4 v = one_packet(c, texture, x, y);
            *sum = (lom_float4){ sum->x + v.x, sum->y + v.y, sum->z + v.z, sum->w + v.w };
        }
    return (seconds() - start) * 1e9 / (COLUMNS * ROWS);
}

/* The best time; below 0 when there is no texture. */
static double time_case(const bench_case *c, lom_filtering filtering)
{
    lom_texture *texture = make_texture(c, filtering);
    if (texture == NULL)
        return -1;
    double best = 1e9;
    lom_float4 sum = { 0 };
    for (int pass = 0; pass < PASSES; pass++) {
        double time = walk(c, texture, &sum);
        best = time < best ? time : best;
    }
    volatile float keep = sum.x[0] + sum.y[0] + sum.z[0] + sum.w[0];
    (void)keep;
    lom_free_texture(texture);
    return best;
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const bench_case *c = &cases[i];
        double in_float = time_case(c, LOM_FILTERING_FLOAT), fixed = time_case(c, LOM_FILTERING_FIXED);
        if (in_float < 0 || fixed < 0)
            return 2;
        printf("%2d lanes  %-40s float %6.2f ns  fixed %6.2f ns\n", LOM_LANES, c->name, in_float, fixed);
    }
    return 0;
}
