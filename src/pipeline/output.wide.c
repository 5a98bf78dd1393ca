/* Stage 7 of 7: output. In: shaded colours and where they go. Out: tile memory, blended, masked, in the attachments'
 * formats. 8-bit unorm blends in exact integers; sRGB and float attachments blend in float. */
#include "pipeline/blend_bytes.h"

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

/* A finite float as the attachment's format holds it. */
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
    if (tile->draw->lays_over) {
        lom_lay_over(tile, places, *mask, color);
        return;
    }
    static void (*const write[])(struct lom_tile *, const struct lom_places *, lom_mask, const lom_float *, int) = {
        [COLOR_UNORM8] = write_unorm8, [COLOR_SRGB8] = write_srgb8, [COLOR_FLOAT] = write_float
    };
    int outputs = tile->draw->desc.shader->colors;
    for (int i = 0; i < tile->pass->colors && i < outputs; i++) {
        lom_float channels[4] = { color[i].x, color[i].y, color[i].z, color[i].w };
        write[tile->pass->color[i].kind](tile, places, *mask, channels, i);
    }
}
