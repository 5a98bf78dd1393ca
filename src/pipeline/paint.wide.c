/* The stages 6 and 7 for draws of one colour. In: a draw whose fragment shader reads nothing. Out: that colour, found
 * once a draw, and what it makes of windows, of parts of windows and of a whole tile.
 *
 * Invariant: a pixel gets what the output stage would store for it. */
#include "pipeline/blend_bytes.h"

/* A constant source over any target, where that is target * factor + add and never above 255^2. */
struct constant_blend {
    struct channels factor, add; /* add holds the 128 of the rounding */
};

/* Whether blending a constant is of that form: a sum whose factors do not read the target. */
static bool reduce_blend(const lom_blend *blend, uint32_t bytes, struct constant_blend *reduced)
{
    struct channels source = split(lom_splat_int((int32_t)bytes));
    pairs alpha = alpha_of(source), upper = second_channels();
    pairs factor[2][2], sum[2][2]; /* of rb and ga, by the colour's and the alpha's equation */
    for (int k = 0; k < 2; k++) {
        struct equation e = equation_of(blend, k == 0 ? 0 : 3);
        if (e.operation != LOM_BLEND_ADD || e.source >= LOM_FACTOR_TARGET_COLOR || e.target >= LOM_FACTOR_TARGET_COLOR)
            return false;
        const struct operands rb = { .source = source.rb, .source_alpha = alpha },
                              ga = { .source = source.ga, .source_alpha = alpha };
        factor[0][k] = byte_factor(e.target, &rb);
        factor[1][k] = byte_factor(e.target, &ga);
        sum[0][k] = source.rb * byte_factor(e.source, &rb);
        sum[1][k] = source.ga * byte_factor(e.source, &ga);
    }
    reduced->factor = (struct channels){ factor[0][0], select_pairs(upper, factor[1][1], factor[1][0]) };
    reduced->add = (struct channels){ sum[0][0], select_pairs(upper, sum[1][1], sum[1][0]) };
    for (int i = 0; i < 2 * LOM_LANES; i++)
        if (reduced->add.rb[i] + 255u * reduced->factor.rb[i] > 255u * 255u ||
            reduced->add.ga[i] + 255u * reduced->factor.ga[i] > 255u * 255u)
            return false;
    reduced->add.rb += 128;
    reduced->add.ga += 128;
    return true;
}

void LOM_WIDE(lom_find_paint)(const struct lom_pass *pass, struct lom_draw *draw, const void *uniforms)
{
    const lom_draw_desc *desc = &draw->desc;
    struct lom_paint *paint = &draw->paint;
    struct constant_blend reduced;
    lom_varyings in;
    lom_fragment out;
    memset(&in, 0, sizeof in);
    memset(&out, 0, sizeof out);
    desc->shader->fragment[draw->variant](&out, &in, uniforms);
    for (int i = 0; i < pass->colors; i++) {
        const float color[4] = { out.color[i].x[0], out.color[i].y[0], out.color[i].z[0], out.color[i].w[0] };
        memcpy(paint->color[i], color, sizeof color);
    }
    for (int c = 0; c < 4; c++)
        paint->bytes |= lom_unorm_of(paint->color[0][c], 255) << 8 * c;
    paint->blends = desc->blend[0].enabled;
    paint->fills = pass->colors == 1 && pass->color[0].kind == COLOR_UNORM8 && desc->shader->colors >= 1 &&
                   desc->mask_off[0] == 0 && desc->logic == LOM_LOGIC_OFF &&
                   (!paint->blends || reduce_blend(&desc->blend[0], paint->bytes, &reduced));
    if (paint->fills && paint->blends) {
        paint->factor[0] = first_pair(reduced.factor.rb);
        paint->factor[1] = first_pair(reduced.factor.ga);
        paint->add[0] = first_pair(reduced.add.rb);
        paint->add[1] = first_pair(reduced.add.ga);
    }
}

LOM_INLINE struct constant_blend blend_of(const struct lom_paint *paint)
{
    return (struct constant_blend){ { splat_pair(paint->factor[0]), splat_pair(paint->factor[1]) },
                                    { splat_pair(paint->add[0]), splat_pair(paint->add[1]) } };
}

LOM_INLINE lom_int blend_constant(const struct constant_blend *b, lom_int old)
{
    struct channels target = split(old);
    return join((struct channels){ divide_shifted_by_255(target.rb * b->factor.rb + b->add.rb),
                                   divide_shifted_by_255(target.ga * b->factor.ga + b->add.ga) });
}

/* A run of pixels, a whole number of packets or half a packet more. */
static void blend_run(const struct lom_paint *paint, int32_t *memory, int count)
{
    const struct constant_blend blend = blend_of(paint);
    int i = 0;
    for (; i + LOM_LANES <= count; i += LOM_LANES)
        lom_store_int(memory + i, blend_constant(&blend, lom_load_int(memory + i)));
    if (i < count) {
        lom_int rest = { 0 };
        memcpy(&rest, memory + i, (size_t)(count - i) * sizeof *memory);
        rest = blend_constant(&blend, rest);
        memcpy(memory + i, &rest, (size_t)(count - i) * sizeof *memory);
    }
}

static void fill_run(const struct lom_paint *paint, int32_t *memory, int count)
{
    for (int i = 0; i < count; i++)
        memory[i] = (int32_t)paint->bytes;
}

LOM_INLINE lom_int paint_over(const struct lom_paint *paint, lom_int old)
{
    const struct constant_blend blend = blend_of(paint);
    return paint->blends ? blend_constant(&blend, old) : lom_splat_int((int32_t)paint->bytes);
}

/* Each window is two runs of 8 pixels, two rows of blocks apart; side by side they make two long runs. */
void LOM_WIDE(lom_fill_windows)(struct lom_tile *tile, int base, int count)
{
    const struct lom_paint *paint = &tile->draw->paint;
    int32_t *upper = (int32_t *)tile->color[0] + base, *lower = upper + 2 * tile->edge;
    tile->fragments += (uint64_t)count * 16;
    (paint->blends ? blend_run : fill_run)(paint, upper, 8 * count);
    (paint->blends ? blend_run : fill_run)(paint, lower, 8 * count);
}

void LOM_WIDE(lom_fill_part)(struct lom_tile *tile, int place, const lom_mask *covered)
{
    int32_t *memory = (int32_t *)tile->color[0] + place;
    lom_int old = lom_load_block(memory, tile), value = paint_over(&tile->draw->paint, old);
    lom_store_block(memory, tile, lom_select_int(*covered, value, old));
    tile->fragments += lom_count(*covered);
}

void LOM_WIDE(lom_fill_tile)(struct lom_tile *tile, int pixels)
{
    tile->whole = (uint32_t)paint_over(&tile->draw->paint, lom_splat_int((int32_t)tile->whole))[0];
    tile->fragments += (uint64_t)pixels;
}
