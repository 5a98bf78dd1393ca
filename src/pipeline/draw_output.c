/* What a draw does to its targets, as it is recorded. In: a descriptor. Out: whether its blending can be, and which code
 * of the output stage it takes. */
#include "pipeline/device.h"

/* Of an enabled equation. */
struct factors {
    bool known, rare, second;
};

static struct factors find_factors(const lom_blend *b)
{
    const lom_factor factors[] = { b->source_color, b->target_color, b->source_alpha, b->target_alpha };
    struct factors found = { (unsigned)b->color_operation < LOM_BLEND_OPERATION_COUNT &&
                                 (unsigned)b->alpha_operation < LOM_BLEND_OPERATION_COUNT,
                             false, false };
    for (int i = 0; i < 4; i++) {
        found.known &= (unsigned)factors[i] < LOM_FACTOR_COUNT;
        found.second |= factors[i] >= LOM_FACTOR_SECOND_COLOR;
        found.rare |= factors[i] >= LOM_FACTOR_CONSTANT_COLOR;
    }
    return found;
}

static bool check_logic(lom_device *device, const lom_draw_desc *desc)
{
    const struct lom_pass *pass = &device->pass;
    if ((unsigned)desc->logic >= LOM_LOGIC_COUNT)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A draw of %s has a logical operation %d that is none.",
                        desc->shader->name, (int)desc->logic);
    for (int i = 0; i < pass->colors && desc->logic != LOM_LOGIC_OFF; i++)
        if (pass->color[i].kind != COLOR_UNORM8)
            return lom_fail(&device->error, LOM_ERROR_USAGE,
                            "A draw of %s has a logical operation, but colour attachment %d is %s, not 8-bit unorm.",
                            desc->shader->name, i, lom_describe_format(pass->color[i].format)->name);
    return true;
}

bool lom_check_output(lom_device *device, const lom_draw_desc *desc)
{
    const struct lom_pass *pass = &device->pass;
    const char *name = desc->shader->name;
    for (int c = 0; c < 4; c++)
        if (!__builtin_isfinite(desc->blend_constant[c]))
            return lom_fail(&device->error, LOM_ERROR_USAGE, "The blend constant of a draw of %s is not finite.", name);
    for (int i = 0; i < pass->colors; i++) {
        const struct factors found = find_factors(&desc->blend[i]);
        if (!desc->blend[i].enabled)
            continue;
        if (!found.known)
            return lom_fail(&device->error, LOM_ERROR_USAGE,
                            "A draw of %s blends by a factor or an operation that is none.", name);
        if (found.second && (pass->colors != 1 || desc->shader->colors < 2))
            return lom_fail(&device->error, LOM_ERROR_USAGE,
                            "A draw of %s blends by two sources, which takes a shader of two colours and a pass of one "
                            "colour attachment.",
                            name);
    }
    return check_logic(device, desc);
}

static lom_output_kind output_of(const struct lom_pass *pass, const lom_draw_desc *desc)
{
    const lom_blend *b = &desc->blend[0];
    const struct lom_color_target *target = &pass->color[0];
    bool bytes = target->kind == COLOR_UNORM8;
    bool floats = target->kind == COLOR_FLOAT && lom_describe_format(target->format)->bits == 32;
    if (pass->colors != 1 || desc->shader->colors < 1 || desc->mask_off[0] != 0 || (!bytes && !floats) ||
        desc->logic != LOM_LOGIC_OFF)
        return OUTPUT_GENERAL;
    if (!b->enabled)
        return bytes ? OUTPUT_BYTES : OUTPUT_GENERAL;
    if (b->color_operation != LOM_BLEND_ADD || b->alpha_operation != LOM_BLEND_ADD ||
        b->source_color != b->source_alpha || b->target_color != LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA ||
        b->target_alpha != LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA)
        return OUTPUT_GENERAL;
    if (b->source_color == LOM_FACTOR_ONE)
        return bytes ? OUTPUT_MULTIPLIED : OUTPUT_FLOATS_MULTIPLIED;
    return bytes && b->source_color == LOM_FACTOR_SOURCE_ALPHA ? OUTPUT_STRAIGHT : OUTPUT_GENERAL;
}

void lom_derive_output(const struct lom_pass *pass, struct lom_draw *draw)
{
    lom_draw_desc *desc = &draw->desc;
    draw->blends = desc->logic != LOM_LOGIC_OFF;
    for (int i = 0; i < pass->colors; i++) {
        const struct factors found = find_factors(&desc->blend[i]);
        desc->blend[i].enabled &= desc->logic == LOM_LOGIC_OFF;
        draw->blends |= desc->blend[i].enabled || desc->mask_off[i] != 0;
        draw->rare_factors |= desc->blend[i].enabled && found.rare;
        draw->two_sources |= desc->blend[i].enabled && found.second;
    }
    draw->output = output_of(pass, desc);
}
