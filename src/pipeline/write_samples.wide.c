/* Stages 6 and 7 of 7 where pixels have several samples, as far as they differ. In: a packet whose varyings are found. Out:
 * its colours in the samples that it covers, and the means of samples.
 *
 * Invariant: each sample ends as if the packets were drawn into it alone. A block of 2x2 pixels keeps one image as long as
 * every fragment that comes to it covers all samples of its pixel; what is written then is the same in all. */
#include "pipeline/packet.h"

LOM_INLINE int count_samples(const struct lom_tile *tile)
{
    return tile->pass->samples;
}

LOM_INLINE int count_pixels(const struct lom_tile *tile)
{
    return tile->edge * tile->edge;
}

/* ---- the shader ---- */

/* The window position of the place of shading: that of the centre, and an exact sixteenth. */
static void move_position(const struct lom_tile *tile, lom_int place, lom_varyings *in)
{
    int32_t x[LOM_MAX_SAMPLES + 1] = { 0 }, y[LOM_MAX_SAMPLES + 1] = { 0 };
    for (int s = 0; s < count_samples(tile); s++) {
        x[s + 1] = tile->pass->offset[s].x;
        y[s + 1] = tile->pass->offset[s].y;
    }
    in->x += lom_to_float(lom_gather_int(x, place)) * (1.0f / 16);
    in->y += lom_to_float(lom_gather_int(y, place)) * (1.0f / 16);
}

/* The samples that a fragment of this alpha may be written to. */
static lom_int cover_by_alpha(const struct lom_tile *tile, lom_float alpha)
{
    const lom_float number = lom_select(alpha == alpha, alpha, (lom_float){ 0 });
    lom_int count = lom_bounded_to_int(lom_saturate(number) * (float)count_samples(tile) + 0.5f);
    return (lom_splat_int(1) << count) - 1;
}

void LOM_WIDE(lom_run_sampled)(struct lom_tile *tile, const struct lom_packet *packet, lom_varyings *in)
{
    const struct lom_draw *draw = tile->draw;
    const lom_shader *shader = draw->desc.shader;
    lom_fragment out;
    if (shader->reads_position && count_samples(tile) > 1)
        move_position(tile, packet->place, in);
    if (shader->reads_depth) {
        lom_int sample = count_samples(tile) > 1 ? lom_max_int(packet->place - 1, (lom_int){ 0 }) : (lom_int){ 0 };
        lom_int at = lom_load_int(packet->places.pixel) + sample * count_pixels(tile);
        in->target_depth = lom_depth_of_units(tile->pass, lom_gather(tile->depth, at));
    }
    in->covered = packet->covered;
    out.depth = packet->depth;
    out.discard = (lom_mask){ 0 };
    shader->fragment[draw->variant](&out, in, draw->uniforms);
    tile->packets++;
    lom_mask mask = shader->discards ? in->covered & ~out.discard : in->covered;
    if (count_samples(tile) > 1) {
        LOM_WIDE(lom_write_samples)(tile, packet, &mask, packet->triangles == 1, &out);
        return;
    }
    mask &= cover_by_alpha(tile, out.color[0].w) != 0;
    LOM_WIDE(lom_write_in_order)(tile, &packet->places, &mask, packet->triangles == 1, &out);
}

/* ---- samples ---- */

/* The depth test after the shader: the samples that pass. */
static lom_int test_late(struct lom_tile *tile, const struct lom_packet *packet, lom_int samples, lom_float depth)
{
    const struct lom_draw *draw = tile->draw;
    struct lom_places places = packet->places;
    int32_t *memory = (int32_t *)(void *)tile->depth;
    lom_int passed = { 0 };
    for (int s = 0; s < count_samples(tile); s++, memory += count_pixels(tile)) {
        lom_mask mask = (samples & 1 << s) != 0;
        if (!lom_any(mask))
            continue;
        lom_float z =
            draw->desc.shader->writes_depth ? depth : lom_load(packet->sample_depth + packet->depth_pitch * (size_t)s);
        z = lom_select(z == z, z, (lom_float){ 0 });
        lom_float units = lom_depth_units(tile->pass, lom_saturate(z));
        lom_float stored = lom_as_float(lom_load_places(memory, tile, &places));
        mask &= lom_compare_depth(draw->compare, units, stored);
        if (draw->depth_write)
            lom_store_places(memory, tile, &places, mask, lom_as_int(units));
        passed |= mask & 1 << s;
    }
    return passed;
}

/* A block's colour goes to all its images. */
static void divide_block(struct lom_tile *tile, int i, int32_t block)
{
    const size_t pixels = (size_t)count_pixels(tile), planes = tile->pass->color[i].kind == COLOR_FLOAT ? 4 : 1;
    uint32_t *first = (uint32_t *)tile->color[i] + 4 * (size_t)block;
    tile->several[i][block] = 1;
    for (size_t s = 1; s < (size_t)count_samples(tile); s++)
        for (size_t c = 0; c < planes; c++)
            memcpy(first + (s * planes + c) * pixels, first + c * pixels, 4 * sizeof *first);
}

/* The blocks of these lanes keep several images from now on, in every attachment. */
static void divide_blocks(struct lom_tile *tile, const int32_t *pixel, uint32_t lanes)
{
    for (; lanes != 0; lanes &= lanes - 1) {
        int32_t block = pixel[__builtin_ctz(lanes)] >> 2;
        for (int i = 0; i < tile->pass->colors; i++)
            if (!tile->several[i][block])
                divide_block(tile, i, block);
    }
}

/* Which lanes lie in blocks that keep one image in all attachments, after those that a lane covers in part are divided. */
static lom_mask find_whole(struct lom_tile *tile, const struct lom_packet *packet, lom_mask mask, lom_int samples)
{
    const int32_t *pixel = packet->places.pixel;
    uint32_t bits = lom_bits(mask), whole = bits;
    divide_blocks(tile, pixel, lom_bits(mask & (samples != (1 << count_samples(tile)) - 1)));
    for (int i = 0; i < tile->pass->colors; i++)
        for (uint32_t left = bits; left != 0; left &= left - 1) {
            int lane = __builtin_ctz(left);
            whole &= ~((uint32_t)tile->several[i][pixel[lane] >> 2] << lane);
        }
    if (tile->pass->colors > 1) /* a block may be whole in one attachment and not in another */
        divide_blocks(tile, pixel, bits & ~whole);
    return lom_mask_of_bits(whole);
}

/* Colours of lanes to samples: those of whole blocks once. */
static void write(struct lom_tile *tile, const struct lom_packet *packet, lom_int samples, const lom_float4 *color)
{
    lom_mask mask = samples != 0, whole = find_whole(tile, packet, mask, samples);
    void *images[LOM_MAX_COLORS];
    if (lom_any(whole))
        LOM_WIDE(lom_write_packet)(tile, &packet->places, &whole, color);
    samples &= ~whole;
    if (!lom_any(samples != 0))
        return;
    memcpy(images, tile->color, sizeof images);
    for (int s = 0; s < count_samples(tile); s++) {
        lom_mask covered = (samples & 1 << s) != 0;
        for (int i = 0; i < tile->pass->colors; i++)
            tile->color[i] = (uint8_t *)images[i] + lom_image_bytes(tile->pass, i) * (size_t)s;
        if (lom_any(covered))
            LOM_WIDE(lom_write_packet)(tile, &packet->places, &covered, color);
    }
    memcpy(tile->color, images, sizeof images);
}

void LOM_WIDE(lom_write_samples)(struct lom_tile *tile, const struct lom_packet *packet, const lom_mask *shaded,
                                 bool apart, const lom_fragment *out)
{
    const struct lom_draw *draw = tile->draw;
    bool late = draw->late_depth && tile->depth != NULL, rounds = (late || draw->blends) && !apart;
    lom_int samples = packet->samples & *shaded;
    if (draw->desc.alpha_to_coverage)
        samples &= cover_by_alpha(tile, out->color[0].w);
    lom_mask mask = samples != 0;
    while (lom_any(mask)) {
        lom_mask round = rounds ? lom_first_at_pixels(tile, packet->places.pixel, mask) : mask;
        lom_int now = samples & round;
        mask &= ~round;
        if (late)
            now = test_late(tile, packet, now, out->depth);
        if (lom_any(now != 0))
            write(tile, packet, now, out->color);
    }
}

/* ---- the mean ---- */

/* Of `count` values, a power of two, added in pairs; they are overwritten. */
LOM_INLINE lom_float mean(lom_float *x, int count)
{
    for (int left = count; left > 1; left /= 2)
        for (int i = 0; i < left / 2; i++)
            x[i] = x[2 * i] + x[2 * i + 1];
    return x[0] * (1.0f / (float)count);
}

static lom_int mean_of_codes(const lom_int *word, int count, bool srgb)
{
    lom_float light[LOM_MAX_SAMPLES];
    lom_int result = { 0 };
    for (int c = 0; c < 4; c++) {
        lom_int sum = lom_splat_int(count / 2);
        for (int s = 0; s < count; s++) {
            lom_int code = word[s] >> 8 * c & 255;
            if (srgb && c < 3)
                light[s] = lom_float_of_srgb8_lanes(code);
            sum += code;
        }
        sum = srgb && c < 3 ? lom_srgb8_of_lanes(mean(light, count)) : sum >> __builtin_ctz((unsigned)count);
        result |= sum << 8 * c;
    }
    return result;
}

/* A finite float as the attachment's format holds it. */
static lom_float round_to_format(lom_format format, lom_float x)
{
    const lom_format_info *info = lom_describe_format(format);
    if (info->bits == 16)
        return info->is_float ? lom_float_of_half_lanes(lom_half_of_lanes(x))
                              : lom_float_of_unorm_lanes(lom_unorm_of_lanes(x, 65535.0f), 65535.0f);
    return lom_make_finite(x);
}

/* The lanes, from pixel `at` on, whose blocks keep several images. */
LOM_INLINE lom_mask load_flags(const uint8_t *several, int at)
{
    lom_mask flags = { 0 };
    for (int i = 0; i < LOM_LANES; i++)
        flags[i] = -(int32_t)several[(at + i) >> 2];
    return flags;
}

static void average_codes(const struct lom_pass *pass, int i, const int32_t *images, const uint8_t *several,
                          int32_t *to)
{
    const int pixels = pass->tile * pass->tile;
    for (int at = 0; at < pixels; at += LOM_LANES) {
        lom_mask flags = load_flags(several, at);
        lom_int word[LOM_MAX_SAMPLES];
        word[0] = lom_load_int(images + at);
        for (int s = 1; s < pass->samples && lom_any(flags); s++)
            word[s] = lom_select_int(flags, lom_load_int(images + s * pixels + at), word[0]);
        if (lom_any(flags))
            word[0] = mean_of_codes(word, pass->samples, pass->color[i].kind == COLOR_SRGB8);
        lom_store_int(to + at, word[0]);
    }
}

static void average_floats(const struct lom_pass *pass, int i, const float *images, const uint8_t *several, float *to)
{
    const int pixels = pass->tile * pass->tile;
    for (int at = 0; at < 4 * pixels; at += LOM_LANES) {
        lom_mask flags = load_flags(several, at % pixels);
        lom_float x[LOM_MAX_SAMPLES];
        x[0] = lom_load(images + at);
        for (int s = 1; s < pass->samples && lom_any(flags); s++)
            x[s] = lom_select(flags, lom_load(images + s * 4 * pixels + at), x[0]);
        if (lom_any(flags))
            x[0] = round_to_format(pass->color[i].format, mean(x, pass->samples));
        lom_store(to + at, x[0]);
    }
}

void LOM_WIDE(lom_find_means)(const struct lom_pass *pass, int i, const void *images, const uint8_t *several, void *to)
{
    if (pass->color[i].kind == COLOR_FLOAT)
        average_floats(pass, i, images, several, to);
    else
        average_codes(pass, i, images, several, to);
}
