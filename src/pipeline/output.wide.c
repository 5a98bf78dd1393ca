/* Stage 7 of 7: output. In: shaded colours and where they go. Out: tile memory, blended, masked, in the attachments'
 * formats. 8-bit unorm blends in exact integers: v = S F + D G, rounded once by t = v + 128, (t + (t >> 8)) >> 8, which
 * is round(v / 255) for every v up to 255^2; sRGB and float attachments blend in float. */
#include "pipeline/packet.h"

/* Two 8-bit channels of a pixel in 16 bits each: red and blue, or green and alpha. Products of two channels fit. */
typedef uint16_t pairs __attribute__((vector_size(LOM_LANES * 4)));

struct channels {
    pairs rb, ga;
};

struct equation {
    lom_factor source, target;
    lom_blend_operation operation;
};

static struct equation equation_of(const lom_blend *blend, int c)
{
    if (c == 3)
        return (struct equation){ blend->source_alpha, blend->target_alpha, blend->alpha_operation };
    return (struct equation){ blend->source_color, blend->target_color, blend->color_operation };
}

LOM_INLINE pairs splat_pairs(uint16_t value)
{
    return value - (pairs){ 0 };
}

LOM_INLINE struct channels split(lom_int packed)
{
    return (struct channels){ (pairs)(packed & 0xff00ff), (pairs)(packed >> 8 & 0xff00ff) };
}

LOM_INLINE lom_int join(struct channels c)
{
    return (lom_int)c.rb | (lom_int)c.ga << 8;
}

/* Alpha in both halves of each pixel. */
LOM_INLINE pairs alpha_of(struct channels c)
{
    lom_int alpha = (lom_int)((lom_uint)c.ga >> 16);
    return (pairs)(alpha | alpha << 16);
}

/* A factor in units of 1/255, for one half of the channels. */
LOM_INLINE pairs byte_factor(lom_factor factor, pairs source, pairs source_alpha, pairs target, pairs target_alpha)
{
    const pairs one = splat_pairs(255);
    switch (factor) {
    case LOM_FACTOR_ONE:
        return one;
    case LOM_FACTOR_SOURCE_COLOR:
        return source;
    case LOM_FACTOR_ONE_MINUS_SOURCE_COLOR:
        return one - source;
    case LOM_FACTOR_SOURCE_ALPHA:
        return source_alpha;
    case LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA:
        return one - source_alpha;
    case LOM_FACTOR_TARGET_COLOR:
        return target;
    case LOM_FACTOR_ONE_MINUS_TARGET_COLOR:
        return one - target;
    case LOM_FACTOR_TARGET_ALPHA:
        return target_alpha;
    case LOM_FACTOR_ONE_MINUS_TARGET_ALPHA:
        return one - target_alpha;
    default:
        return (pairs){ 0 };
    }
}

LOM_INLINE pairs select_pairs(pairs mask, pairs a, pairs b)
{
    return (mask & a) | (~mask & b);
}

/* round(v / 255), v at most 255^2. */
LOM_INLINE pairs divide_by_255(pairs v)
{
    pairs t = v + 128;
    return (t + (t >> 8)) >> 8;
}

/* s + d, s - d or d - s within 0..255^2; a sum that wraps is smaller than its terms. */
LOM_INLINE pairs combine(lom_blend_operation operation, pairs s, pairs d)
{
    const pairs largest = splat_pairs(255 * 255);
    if (operation == LOM_BLEND_SUBTRACT)
        return (s - d) & (pairs)(s > d);
    if (operation == LOM_BLEND_REVERSE_SUBTRACT)
        return (d - s) & (pairs)(d > s);
    pairs sum = s + d;
    return select_pairs((pairs)(sum < s) | (pairs)(sum > largest), largest, sum);
}

LOM_INLINE pairs blend_half(struct equation e, pairs source, pairs source_alpha, pairs target, pairs target_alpha)
{
    if (e.operation == LOM_BLEND_MIN)
        return select_pairs((pairs)(source < target), source, target);
    if (e.operation == LOM_BLEND_MAX)
        return select_pairs((pairs)(source > target), source, target);
    pairs s = source * byte_factor(e.source, source, source_alpha, target, target_alpha);
    pairs d = target * byte_factor(e.target, source, source_alpha, target, target_alpha);
    return divide_by_255(combine(e.operation, s, d));
}

static struct channels blend_bytes(const lom_blend *blend, struct channels source, struct channels target)
{
    struct equation color = equation_of(blend, 0), alpha = equation_of(blend, 3);
    pairs source_alpha = alpha_of(source), target_alpha = alpha_of(target);
    struct channels result = { blend_half(color, source.rb, source_alpha, target.rb, target_alpha),
                               blend_half(color, source.ga, source_alpha, target.ga, target_alpha) };
    if (color.source != alpha.source || color.target != alpha.target || color.operation != alpha.operation) {
        pairs upper = (pairs)lom_splat_int((int32_t)0xffff0000u);
        result.ga = select_pairs(upper, blend_half(alpha, source.ga, source_alpha, target.ga, target_alpha), result.ga);
    }
    return result;
}

/* The value of a blend factor. S and D: source and target, channel c; A of each their alphas. */
static lom_float float_factor(lom_factor factor, const lom_float *source, const lom_float *target, int c)
{
    const lom_float one = lom_splat(1.0f);
    switch (factor) {
    case LOM_FACTOR_ONE:
        return one;
    case LOM_FACTOR_SOURCE_COLOR:
        return source[c];
    case LOM_FACTOR_ONE_MINUS_SOURCE_COLOR:
        return one - source[c];
    case LOM_FACTOR_SOURCE_ALPHA:
        return source[3];
    case LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA:
        return one - source[3];
    case LOM_FACTOR_TARGET_COLOR:
        return target[c];
    case LOM_FACTOR_ONE_MINUS_TARGET_COLOR:
        return one - target[c];
    case LOM_FACTOR_TARGET_ALPHA:
        return target[3];
    case LOM_FACTOR_ONE_MINUS_TARGET_ALPHA:
        return one - target[3];
    default:
        return (lom_float){ 0 };
    }
}

static lom_float blend_floats(struct equation e, const lom_float *source, const lom_float *target, int c)
{
    if (e.operation == LOM_BLEND_MIN)
        return lom_min(source[c], target[c]);
    if (e.operation == LOM_BLEND_MAX)
        return lom_max(source[c], target[c]);
    lom_float s = source[c] * float_factor(e.source, source, target, c);
    lom_float d = target[c] * float_factor(e.target, source, target, c);
    return e.operation == LOM_BLEND_ADD ? s + d : e.operation == LOM_BLEND_SUBTRACT ? s - d : d - s;
}

LOM_INLINE lom_int pack(const lom_int *c)
{
    return c[0] | c[1] << 8 | c[2] << 16 | c[3] << 24;
}

LOM_INLINE void unpack(lom_int packed, lom_int *c)
{
    for (int i = 0; i < 4; i++)
        c[i] = packed >> 8 * i & 255;
}

/* The bits of the packed pixel that the colour mask keeps from the target. */
static int32_t kept_bits(uint8_t mask_off)
{
    uint32_t kept = 0;
    for (int i = 0; i < 4; i++)
        if (mask_off >> i & 1)
            kept |= UINT32_C(255) << 8 * i;
    return (int32_t)kept;
}

static void write_unorm8(struct lom_tile *tile, const struct lom_places *places, lom_mask mask, const lom_float *color,
                         int i)
{
    const lom_draw_desc *desc = &tile->draw->desc;
    int32_t *memory = tile->color[i];
    lom_int source[4];
    for (int c = 0; c < 4; c++)
        source[c] = lom_unorm_of_lanes(color[c], 255.0f);
    int32_t kept = kept_bits(desc->mask_off[i]);
    lom_int result = pack(source);
    if (!desc->blend[i].enabled && kept == 0) {
        lom_store_places(memory, tile, places, mask, result);
        return;
    }
    lom_int old = lom_load_places(memory, tile, places);
    if (desc->blend[i].enabled)
        result = join(blend_bytes(&desc->blend[i], split(result), split(old)));
    lom_store_places(memory, tile, places, mask, (result & ~kept) | (old & kept));
}

/* ---- whole windows of a constant colour ---- */

/* A constant source over any target, where that is target * factor + add and never above 255^2. */
struct constant_blend {
    struct channels factor, add; /* add holds the 128 of the rounding */
};

/* Whether blending a constant is of that form: a sum whose factors do not read the target. */
static bool reduce_blend(const lom_blend *blend, uint32_t bytes, struct constant_blend *reduced)
{
    struct channels source = split(lom_splat_int((int32_t)bytes)), zero = { { 0 }, { 0 } };
    pairs alpha = alpha_of(source), upper = (pairs)lom_splat_int((int32_t)0xffff0000u);
    pairs factor[2][2], sum[2][2]; /* of rb and ga, by the colour's and the alpha's equation */
    for (int k = 0; k < 2; k++) {
        struct equation e = equation_of(blend, k == 0 ? 0 : 3);
        if (e.operation != LOM_BLEND_ADD || e.source >= LOM_FACTOR_TARGET_COLOR || e.target >= LOM_FACTOR_TARGET_COLOR)
            return false;
        factor[0][k] = byte_factor(e.target, source.rb, alpha, zero.rb, zero.rb);
        factor[1][k] = byte_factor(e.target, source.ga, alpha, zero.rb, zero.rb);
        sum[0][k] = source.rb * byte_factor(e.source, source.rb, alpha, zero.rb, zero.rb);
        sum[1][k] = source.ga * byte_factor(e.source, source.ga, alpha, zero.rb, zero.rb);
    }
    reduced->factor = (struct channels){ factor[0][0], select_pairs(upper, factor[1][1], factor[1][0]) };
    reduced->add = (struct channels){ sum[0][0], select_pairs(upper, sum[1][1], sum[1][0]) };
    for (int i = 0; i < 2; i++)
        if (reduced->add.rb[i] + 255u * reduced->factor.rb[i] > 255u * 255u ||
            reduced->add.ga[i] + 255u * reduced->factor.ga[i] > 255u * 255u)
            return false;
    reduced->add.rb += 128;
    reduced->add.ga += 128;
    return true;
}

LOM_INLINE lom_int blend_constant(const struct constant_blend *b, lom_int old)
{
    struct channels target = split(old);
    pairs rb = target.rb * b->factor.rb + b->add.rb, ga = target.ga * b->factor.ga + b->add.ga;
    return join((struct channels){ (rb + (rb >> 8)) >> 8, (ga + (ga >> 8)) >> 8 });
}

bool LOM_WIDE(lom_can_fill)(const struct lom_tile *tile)
{
    const lom_draw_desc *desc = &tile->draw->desc;
    struct constant_blend reduced;
    return tile->pass->colors == 1 && tile->pass->color[0].kind == COLOR_UNORM8 && desc->shader->colors >= 1 &&
           desc->mask_off[0] == 0 &&
           (!desc->blend[0].enabled || reduce_blend(&desc->blend[0], tile->constant_bytes, &reduced));
}

/* A run of pixels, a whole number of packets or half a packet more. */
static void blend_run(const struct constant_blend *blend, int32_t *memory, int count)
{
    int i = 0;
    for (; i + LOM_LANES <= count; i += LOM_LANES)
        lom_store_int(memory + i, blend_constant(blend, lom_load_int(memory + i)));
    if (i < count) {
        lom_int rest = { 0 };
        memcpy(&rest, memory + i, (size_t)(count - i) * sizeof *memory);
        rest = blend_constant(blend, rest);
        memcpy(memory + i, &rest, (size_t)(count - i) * sizeof *memory);
    }
}

static void fill_run(int32_t *memory, int count, int32_t value)
{
    for (int i = 0; i < count; i++)
        memory[i] = value;
}

/* Each window is two runs of 8 pixels, two rows of blocks apart; side by side they make two long runs. */
void LOM_WIDE(lom_fill_windows)(struct lom_tile *tile, int base, int count)
{
    const lom_blend *blend = &tile->draw->desc.blend[0];
    int32_t *upper = (int32_t *)tile->color[0] + base, *lower = upper + 2 * tile->edge;
    struct constant_blend reduced;
    tile->fragments += (uint64_t)count * 16;
    if (blend->enabled && reduce_blend(blend, tile->constant_bytes, &reduced)) {
        blend_run(&reduced, upper, 8 * count);
        blend_run(&reduced, lower, 8 * count);
        return;
    }
    fill_run(upper, 8 * count, (int32_t)tile->constant_bytes);
    fill_run(lower, 8 * count, (int32_t)tile->constant_bytes);
}

static void write_srgb8(struct lom_tile *tile, const struct lom_places *places, lom_mask mask, const lom_float *color,
                        int i)
{
    const lom_draw_desc *desc = &tile->draw->desc;
    int32_t *memory = tile->color[i];
    lom_int code[4];
    lom_float source[4], target[4], result[4];
    lom_int old = { 0 };
    int32_t kept = kept_bits(desc->mask_off[i]);
    bool blends = desc->blend[i].enabled;
    for (int c = 0; c < 4; c++)
        result[c] = source[c] = lom_saturate(color[c]);
    if (blends || kept != 0)
        old = lom_load_places(memory, tile, places);
    if (blends) {
        unpack(old, code);
        for (int c = 0; c < 3; c++)
            target[c] = lom_float_of_srgb8_lanes(code[c]);
        target[3] = lom_float_of_unorm_lanes(code[3], 255.0f);
        for (int c = 0; c < 4; c++)
            result[c] = blend_floats(equation_of(&desc->blend[i], c), source, target, c);
    }
    for (int c = 0; c < 3; c++)
        code[c] = lom_srgb8_of_lanes(result[c]);
    code[3] = lom_unorm_of_lanes(result[3], 255.0f);
    lom_store_places(memory, tile, places, mask, (pack(code) & ~kept) | (old & kept));
}

/* A float as the attachment's format holds it; finite, as textures want it. */
static lom_float round_to_format(lom_format format, lom_float x)
{
    lom_float number = lom_select(x == x, x, (lom_float){ 0 }), bound = lom_splat(0x1p123f);
    const lom_format_info *info = lom_describe_format(format);
    if (info->bits == 16 && info->is_float)
        number = lom_float_of_half_lanes(lom_half_of_lanes(number));
    else if (info->bits == 16)
        number = lom_float_of_unorm_lanes(lom_unorm_of_lanes(number, 65535.0f), 65535.0f);
    return lom_clamp(number, -bound, bound);
}

static void write_float(struct lom_tile *tile, const struct lom_places *places, lom_mask mask, const lom_float *color,
                        int i)
{
    const lom_draw_desc *desc = &tile->draw->desc;
    size_t plane = (size_t)tile->edge * (size_t)tile->edge;
    float *memory = tile->color[i];
    lom_format format = tile->pass->color[i].format;
    lom_float target[4];
    bool blends = desc->blend[i].enabled;
    for (size_t c = 0; c < 4 && blends; c++)
        target[c] = lom_as_float(lom_load_places((const int32_t *)memory + c * plane, tile, places));
    for (int c = 0; c < 4; c++) {
        if (desc->mask_off[i] >> c & 1)
            continue;
        lom_float result = blends ? blend_floats(equation_of(&desc->blend[i], c), color, target, c) : color[c];
        lom_store_places((int32_t *)memory + (size_t)c * plane, tile, places, mask,
                         lom_as_int(round_to_format(format, result)));
    }
}

void LOM_WIDE(lom_write_packet)(struct lom_tile *tile, const struct lom_places *places, lom_mask *mask,
                                const lom_float4 *color)
{
    static void (*const write[])(struct lom_tile *, const struct lom_places *, lom_mask, const lom_float *, int) = {
        [COLOR_UNORM8] = write_unorm8, [COLOR_SRGB8] = write_srgb8, [COLOR_FLOAT] = write_float
    };
    int outputs = tile->draw->desc.shader->colors;
    for (int i = 0; i < tile->pass->colors && i < outputs; i++) {
        lom_float channels[4] = { color[i].x, color[i].y, color[i].z, color[i].w };
        write[tile->pass->color[i].kind](tile, places, *mask, channels, i);
    }
}
