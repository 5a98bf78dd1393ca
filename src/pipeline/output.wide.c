/* Stage 7 of 7: output. In: shaded colours and where they go. Out: tile memory, blended, masked, in the attachments'
 * formats. 8-bit unorm blends in exact integers; sRGB and float attachments blend in float. */
#include "pipeline/blend_bytes.h"
#include "pipeline/window.h"

/* What float factors are made of: channels, of which the second source and the constant only where the draw blends by
 * them. */
struct float_operands {
    const lom_float *source, *target;
    lom_float second[4], constant[4];
};

static lom_float rare_float_factor(lom_factor factor, const struct float_operands *o, int c)
{
    const lom_float one = lom_splat(1.0f);
    switch (factor) {
    case LOM_FACTOR_CONSTANT_COLOR:
        return o->constant[c];
    case LOM_FACTOR_ONE_MINUS_CONSTANT_COLOR:
        return one - o->constant[c];
    case LOM_FACTOR_CONSTANT_ALPHA:
        return o->constant[3];
    case LOM_FACTOR_ONE_MINUS_CONSTANT_ALPHA:
        return one - o->constant[3];
    case LOM_FACTOR_SOURCE_ALPHA_SATURATE:
        return c == 3 ? one : lom_min(o->source[3], one - o->target[3]);
    case LOM_FACTOR_SECOND_COLOR:
        return o->second[c];
    case LOM_FACTOR_ONE_MINUS_SECOND_COLOR:
        return one - o->second[c];
    case LOM_FACTOR_SECOND_ALPHA:
        return o->second[3];
    case LOM_FACTOR_ONE_MINUS_SECOND_ALPHA:
        return one - o->second[3];
    default:
        return (lom_float){ 0 };
    }
}

/* The value of a blend factor in channel c. */
static lom_float float_factor(lom_factor factor, const struct float_operands *o, int c)
{
    const lom_float one = lom_splat(1.0f);
    switch (factor) {
    case LOM_FACTOR_ZERO:
        return (lom_float){ 0 };
    case LOM_FACTOR_ONE:
        return one;
    case LOM_FACTOR_SOURCE_COLOR:
        return o->source[c];
    case LOM_FACTOR_ONE_MINUS_SOURCE_COLOR:
        return one - o->source[c];
    case LOM_FACTOR_SOURCE_ALPHA:
        return o->source[3];
    case LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA:
        return one - o->source[3];
    case LOM_FACTOR_TARGET_COLOR:
        return o->target[c];
    case LOM_FACTOR_ONE_MINUS_TARGET_COLOR:
        return one - o->target[c];
    case LOM_FACTOR_TARGET_ALPHA:
        return o->target[3];
    case LOM_FACTOR_ONE_MINUS_TARGET_ALPHA:
        return one - o->target[3];
    default:
        return rare_float_factor(factor, o, c);
    }
}

static lom_float blend_floats(struct equation e, const struct float_operands *o, int c)
{
    if (e.operation == LOM_BLEND_MIN)
        return lom_min(o->source[c], o->target[c]);
    if (e.operation == LOM_BLEND_MAX)
        return lom_max(o->source[c], o->target[c]);
    lom_float s = o->source[c] * float_factor(e.source, o, c);
    lom_float d = o->target[c] * float_factor(e.target, o, c);
    return e.operation == LOM_BLEND_ADD ? s + d : e.operation == LOM_BLEND_SUBTRACT ? s - d : d - s;
}

/* The second source and the constant, `from` being the first source; clamped where the attachment's format is. */
static void find_rare_operands(const struct lom_draw *draw, const lom_float4 *from, bool clamps,
                               struct float_operands *o)
{
    const lom_float4 *two = &from[draw->two_sources];
    const lom_float second[4] = { two->x, two->y, two->z, two->w };
    for (int c = 0; c < 4; c++) {
        const lom_float constant = lom_splat(draw->desc.blend_constant[c]);
        o->second[c] = clamps ? lom_saturate(second[c]) : second[c];
        o->constant[c] = clamps ? lom_saturate(constant) : constant;
    }
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

/* The bits of source s and target d by a logical operation. */
static lom_int combine_bits(lom_logic logic, lom_int s, lom_int d)
{
    switch (logic) {
    case LOM_LOGIC_AND:
        return s & d;
    case LOM_LOGIC_AND_REVERSE:
        return s & ~d;
    case LOM_LOGIC_COPY:
        return s;
    case LOM_LOGIC_AND_INVERTED:
        return ~s & d;
    case LOM_LOGIC_NOTHING:
        return d;
    case LOM_LOGIC_XOR:
        return s ^ d;
    case LOM_LOGIC_OR:
        return s | d;
    case LOM_LOGIC_NOR:
        return ~(s | d);
    case LOM_LOGIC_EQUIVALENT:
        return ~(s ^ d);
    case LOM_LOGIC_INVERT:
        return ~d;
    case LOM_LOGIC_OR_REVERSE:
        return s | ~d;
    case LOM_LOGIC_COPY_INVERTED:
        return ~s;
    case LOM_LOGIC_OR_INVERTED:
        return ~s | d;
    case LOM_LOGIC_NAND:
        return ~(s & d);
    case LOM_LOGIC_SET:
        return lom_splat_int(-1);
    default: /* CLEAR */
        return (lom_int){ 0 };
    }
}

/* `source` blended over, or combined with, what the target holds; from[1] is the second source. */
static lom_int mix_bytes(const struct lom_draw *draw, int i, struct channels source, lom_int old,
                         const lom_float4 *from)
{
    const float *k = draw->desc.blend_constant;
    struct rare_sources rare = { { { 0 }, { 0 } }, { { 0 }, { 0 } } };
    if (draw->desc.logic != LOM_LOGIC_OFF)
        return combine_bits(draw->desc.logic, join(source), old);
    if (draw->rare_factors) {
        const lom_float4 constant = { lom_splat(k[0]), lom_splat(k[1]), lom_splat(k[2]), lom_splat(k[3]) };
        rare.second = quantise(&from[draw->two_sources]);
        rare.constant = quantise(&constant);
    }
    return join(blend_bytes(&draw->desc.blend[i], source, split(old), &rare));
}

static void write_unorm8(struct lom_tile *tile, const struct lom_places *places, lom_mask mask, const lom_float4 *color,
                         int i)
{
    const lom_draw_desc *desc = &tile->draw->desc;
    int32_t *memory = tile->color[i];
    struct channels source = quantise(color);
    int32_t kept = kept_bits(desc->mask_off[i]);
    bool mixes = desc->blend[i].enabled || desc->logic != LOM_LOGIC_OFF;
    if (!mixes && kept == 0) {
        lom_store_places(memory, tile, places, mask, join(source));
        return;
    }
    lom_int old = lom_load_places(memory, tile, places);
    lom_int result = mixes ? mix_bytes(tile->draw, i, source, old, color) : join(source);
    lom_store_places(memory, tile, places, mask, (result & ~kept) | (old & kept));
}

static void write_srgb8(struct lom_tile *tile, const struct lom_places *places, lom_mask mask, const lom_float4 *from,
                        int i)
{
    const lom_draw_desc *desc = &tile->draw->desc;
    int32_t *memory = tile->color[i];
    lom_int code[4];
    const lom_float color[4] = { from->x, from->y, from->z, from->w };
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
        struct float_operands o = { .source = source, .target = target };
        if (tile->draw->rare_factors)
            find_rare_operands(tile->draw, from, true, &o);
        for (int c = 0; c < 4; c++)
            result[c] = blend_floats(equation_of(&desc->blend[i], c), &o, c);
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

static void write_float(struct lom_tile *tile, const struct lom_places *places, lom_mask mask, const lom_float4 *from,
                        int i)
{
    const lom_draw_desc *desc = &tile->draw->desc;
    size_t plane = (size_t)tile->edge * (size_t)tile->edge;
    float *memory = tile->color[i];
    lom_format format = tile->pass->color[i].format;
    const lom_float color[4] = { from->x, from->y, from->z, from->w };
    lom_float target[4];
    bool blends = desc->blend[i].enabled;
    struct float_operands o = { .source = color, .target = target };
    if (blends && tile->draw->rare_factors)
        find_rare_operands(tile->draw, from, false, &o);
    for (size_t c = 0; c < 4 && blends; c++)
        target[c] = lom_as_float(lom_load_places((const int32_t *)memory + c * plane, tile, places));
    for (int c = 0; c < 4; c++) {
        if (desc->mask_off[i] >> c & 1)
            continue;
        lom_float result = blends ? blend_floats(equation_of(&desc->blend[i], c), &o, c) : color[c];
        lom_store_places((int32_t *)memory + (size_t)c * plane, tile, places, mask,
                         lom_as_int(round_to_format(format, result)));
    }
}

void LOM_WIDE(lom_write_color)(struct lom_tile *tile, const struct lom_places *places, const lom_mask *mask,
                               const lom_float4 *color, int i)
{
    switch (tile->pass->color[i].kind) {
    case COLOR_UNORM8:
        write_unorm8(tile, places, *mask, color, i);
        break;
    case COLOR_SRGB8:
        write_srgb8(tile, places, *mask, color, i);
        break;
    case COLOR_FLOAT:
        write_float(tile, places, *mask, color, i);
        break;
    }
}

static void write_edges(struct lom_tile *tile, const struct lom_places *places, lom_mask mask)
{
    const lom_float4 reach = { lom_load(tile->reach[0]), lom_load(tile->reach[1]), lom_load(tile->reach[2]),
                               lom_load(tile->reach[3]) };
    lom_store_places(tile->color[tile->pass->edges], tile, places, mask, join(quantise(&reach)));
}

static __attribute__((noinline)) void write_all(struct lom_tile *tile, const struct lom_places *places,
                                                const lom_mask *mask, const lom_float4 *color)
{
    const struct lom_pass *pass = tile->pass;
    int outputs = tile->draw->desc.shader->colors, targets = pass->edges != 0 ? pass->edges : pass->colors;
    for (int i = 0; i < targets && i < outputs; i++)
        LOM_WIDE(lom_write_color)(tile, places, mask, &color[i], i);
    if (tile->draw->marks_edges)
        write_edges(tile, places, *mask);
}

void LOM_WIDE(lom_write_packet)(struct lom_tile *tile, const struct lom_places *places, lom_mask *mask,
                                const lom_float4 *color)
{
    int32_t *memory = tile->color[0];
    struct channels source;
    switch (tile->draw->output) {
    case OUTPUT_GENERAL:
        write_all(tile, places, mask, color);
        return;
    case OUTPUT_FLOATS_MULTIPLIED:
        lom_lay_over(tile, places, *mask, color);
        return;
    case OUTPUT_BYTES:
        source = quantise(color);
        break;
    case OUTPUT_STRAIGHT:
        source = blend_straight(quantise(color), split(lom_load_places(memory, tile, places)));
        break;
    case OUTPUT_MULTIPLIED:
        source = blend_multiplied(quantise(color), split(lom_load_places(memory, tile, places)));
        break;
    }
    lom_store_places(memory, tile, places, *mask, join_bounded(source));
}

/* The outputs of bytes in whole windows. */
LOM_INLINE void write_window_bytes(struct lom_tile *tile, lom_output_kind output, const struct lom_windows *windows)
{
    for (int i = 0; i < windows->count; i++) {
        int32_t *memory = (int32_t *)tile->color[0] + windows->base[i];
        struct channels source = quantise(fragment_in(&tile->together, i)->color);
        if (output == OUTPUT_STRAIGHT)
            source = blend_straight(source, split(lom_load_block(memory, tile)));
        if (output == OUTPUT_MULTIPLIED)
            source = blend_multiplied(source, split(lom_load_block(memory, tile)));
        lom_store_block(memory, tile, join_bounded(source));
    }
}

void LOM_WIDE(lom_write_windows)(struct lom_tile *tile, const struct lom_windows *windows)
{
    const struct lom_draw *draw = tile->draw;
    const bool discards = draw->desc.shader->discards;
    if (!discards && draw->output == OUTPUT_BYTES) {
        write_window_bytes(tile, OUTPUT_BYTES, windows);
    } else if (!discards && draw->output == OUTPUT_STRAIGHT) {
        write_window_bytes(tile, OUTPUT_STRAIGHT, windows);
    } else if (!discards && draw->output == OUTPUT_MULTIPLIED) {
        write_window_bytes(tile, OUTPUT_MULTIPLIED, windows);
    } else {
        for (int i = 0; i < windows->count; i++) {
            const struct lom_places places = { .pixel = { windows->base[i] }, .block = true };
            const lom_fragment *out = fragment_in(&tile->together, i);
            lom_mask mask = discards ? ~out->discard : lom_splat_int(-1);
            LOM_WIDE(lom_write_packet)(tile, &places, &mask, out->color);
        }
    }
}
