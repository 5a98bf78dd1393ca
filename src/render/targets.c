/* The targets of a frame's passes. In: the scene, sizes. Out: textures by name. Two names share one texture where the
 * table says that the one has been read when the other is drawn. */
#include "pipeline/check_device.h"
#include "render/renderer.h"
#include "render/tone.h"
#include "water/water_models.h"

#include <string.h>

enum need { ALWAYS, FOR_WATER, FOR_SPRAY, FOR_WIRES, FOR_EDGES, FOR_MIRRORED_EDGES, FOR_FLUIDS, FOR_WET_FLUIDS };
enum size { DRAWN, REFLECTED, REFRACTED }; /* of the part that is drawn; of the frame, scaled as quality says */
enum kind { COLOR, DEPTH, MASK, LAYER, MARKS };

static int scaled(int size, double scale)
{
    int result = lom_int_of(size * scale + 0.5);
    return result < 1 ? 1 : result;
}

bool lom_has_float_targets(const lom_scene *scene)
{
    return scene->output.format != LOM_OUTPUT_RGB8 || lom_is_toned(&scene->output);
}

/* What the eye sees is 8-bit sRGB, unless the output asks for more. */
static lom_format color_format(const lom_scene *scene)
{
    if (lom_has_float_targets(scene))
        return LOM_FORMAT_RGBA32F;
    return scene->output.transfer == LOM_TRANSFER_SRGB ? LOM_FORMAT_RGBA8_SRGB : LOM_FORMAT_RGBA8;
}

static bool has_waves(const lom_scene *scene)
{
    return lom_water_models[scene->quality.water].has_waves;
}

/* The planar lake never looks up how far away what it mirrors is, and draws that picture first. */
static bool is_planar(const lom_scene *scene)
{
    return !has_waves(scene);
}

/* The mask is read, a byte a pixel, before that picture is drawn. */
static bool has_bytes(const lom_scene *scene)
{
    return !lom_has_float_targets(scene);
}

/* A liquid is drawn at once when it has been copied what is behind it, in each picture. */
static bool always(const lom_scene *scene)
{
    (void)scene;
    return true;
}

/* By lom_target. A target shares the texture of an earlier one of its size where the scene lets it: where what the one
 * holds has been read for the last time when the other is drawn. */
static const struct row {
    const char *label;
    enum need need;
    enum size size;
    enum kind kind;
    bool (*may_share)(const lom_scene *scene);
    enum lom_target with;
    bool keeps; /* its samples, for a pass that goes on with what the one before has drawn */
} rows[LOM_TARGETS] = {
    [LOM_TARGET_COLOR] = { "picture", ALWAYS, DRAWN, COLOR, .keeps = true },
    [LOM_TARGET_DEPTH] = { "depth", ALWAYS, DRAWN, DEPTH, .keeps = true },
    [LOM_TARGET_REFRACTION] = { "refraction", FOR_WATER, REFRACTED, COLOR, .keeps = false },
    [LOM_TARGET_REFRACTION_DEPTH] = { "refraction depth", FOR_WATER, REFRACTED, DEPTH, .keeps = false },
    [LOM_TARGET_REFLECTION] = { "reflection", FOR_WATER, REFLECTED, COLOR, .keeps = true },
    [LOM_TARGET_REFLECTION_DEPTH] = { "reflection depth", FOR_WATER, REFLECTED, DEPTH, is_planar,
                                      LOM_TARGET_REFRACTION_DEPTH, .keeps = false },
    [LOM_TARGET_MASK] = { "mask", FOR_WATER, DRAWN, MASK, has_bytes, LOM_TARGET_REFRACTION, .keeps = false },
    [LOM_TARGET_SPRAY] = { "spray", FOR_SPRAY, DRAWN, LAYER, .keeps = false },
    [LOM_TARGET_WIRE_DEPTH] = { "wireframe depth", FOR_WIRES, DRAWN, DEPTH, .keeps = false },
    [LOM_TARGET_SHARP] = { "sharp picture", FOR_EDGES, DRAWN, COLOR, .keeps = false },
    [LOM_TARGET_EDGES] = { "edges", FOR_EDGES, DRAWN, MARKS, .keeps = false },
    [LOM_TARGET_REFLECTION_SHARP] = { "sharp reflection", FOR_MIRRORED_EDGES, REFLECTED, COLOR, .keeps = false },
    [LOM_TARGET_REFLECTION_EDGES] = { "edges of the reflection", FOR_MIRRORED_EDGES, REFLECTED, MARKS, .keeps = false },
    [LOM_TARGET_FLUID_SCENE] = { "behind the fluid", FOR_FLUIDS, DRAWN, LAYER, .keeps = false },
    [LOM_TARGET_FLUID_LENGTH] = { "lengths in the fluid", FOR_FLUIDS, DRAWN, LAYER, .keeps = false },
    [LOM_TARGET_FLUID_REFLECTED] = { "behind the mirrored fluid", FOR_WET_FLUIDS, REFLECTED, LAYER, always,
                                     LOM_TARGET_FLUID_SCENE, .keeps = false },
    [LOM_TARGET_FLUID_REFLECTED_LENGTH] = { "lengths in the mirrored fluid", FOR_WET_FLUIDS, REFLECTED, LAYER, always,
                                            LOM_TARGET_FLUID_LENGTH, .keeps = false },
    [LOM_TARGET_FLUID_REFRACTED] = { "behind the sunken fluid", FOR_WET_FLUIDS, REFRACTED, LAYER, always,
                                     LOM_TARGET_FLUID_SCENE, .keeps = false },
    [LOM_TARGET_FLUID_REFRACTED_LENGTH] = { "lengths in the sunken fluid", FOR_WET_FLUIDS, REFRACTED, LAYER, always,
                                            LOM_TARGET_FLUID_LENGTH, .keeps = false },
};

bool lom_smooths_edges(const lom_scene *scene)
{
    return scene->output.edges == LOM_EDGES_SMOOTH && scene->output.samples <= 1;
}

/* What each target is to be for a frame of this size; width 0: the scene needs none. */
static void describe(const lom_scene *scene, const struct lom_targets *size, lom_texture_desc desc[LOM_TARGETS])
{
    const bool has_water = lom_has_water(scene), smooths = lom_smooths_edges(scene);
    const bool has_fluids = lom_count_fluids(scene) != 0;
    const bool needed[] = { [ALWAYS] = true,
                            [FOR_WATER] = has_water,
                            [FOR_EDGES] = smooths,
                            [FOR_MIRRORED_EDGES] = smooths && has_water,
                            [FOR_SPRAY] = lom_count_drops(scene) != 0,
                            [FOR_FLUIDS] = has_fluids,
                            [FOR_WET_FLUIDS] = has_fluids && has_water,
                            [FOR_WIRES] = scene->quality.wireframe == LOM_WIREFRAME_VISIBLE };
    const double scale[] = {
        [REFLECTED] = scene->quality.reflection_scale, [REFRACTED] = scene->quality.refraction_scale
    };
    const lom_format format[] = { [COLOR] = color_format(scene),
                                  [DEPTH] = LOM_FORMAT_DEPTH32F,
                                  [MASK] = LOM_FORMAT_R8,
                                  [LAYER] = LOM_FORMAT_RGBA32F,
                                  [MARKS] = LOM_FORMAT_RGBA8 };
    for (int i = 0; i < LOM_TARGETS; i++) {
        const struct row *row = &rows[i];
        desc[i] = (lom_texture_desc){ .label = row->label,
                                      .format = format[row->kind],
                                      .sampler = { .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP },
                                      .samples = row->keeps ? scene->output.samples : 0 };
        if (!needed[row->need])
            continue;
        desc[i].width = row->size == DRAWN ? size->drawn_width : scaled(size->width, scale[row->size]);
        desc[i].height = row->size == DRAWN ? size->drawn_height : scaled(size->height, scale[row->size]);
        if (row->kind == DEPTH)
            desc[i].sampler.magnify = desc[i].sampler.minify = LOM_FILTER_NEAREST;
    }
    if (has_waves(scene)) /* rough water mirrors a blurred picture */
        desc[LOM_TARGET_REFLECTION].mips = LOM_MIPS_ALL;
}

static bool shares(const lom_scene *scene, const lom_texture_desc desc[LOM_TARGETS], int i)
{
    const struct row *row = &rows[i];
    return row->may_share != NULL && row->may_share(scene) && desc[i].width == desc[row->with].width &&
           desc[i].height == desc[row->with].height;
}

static void release_targets(lom_device *device, struct lom_targets *targets)
{
    for (size_t i = 0; i < targets->made_count; i++)
        lom_release_texture(device, targets->made[i]);
    *targets = (struct lom_targets){ .made_count = 0 };
}

void lom_drop_targets(lom_renderer *renderer)
{
    release_targets(renderer->device, &renderer->targets);
    for (int i = 0; i <= LOM_MAX_VIEWS; i++)
        release_targets(renderer->device, &renderer->other_targets[i]);
}

static bool are_of(const struct lom_targets *t, int width, int height, int drawn_width, int drawn_height)
{
    return t->made_count != 0 && t->width == width && t->height == height && t->drawn_width == drawn_width &&
           t->drawn_height == drawn_height;
}

/* The targets of this frame become the first of the others; other number `with` is the frame's. */
static void exchange(lom_renderer *r, size_t with)
{
    const struct lom_targets kept = r->other_targets[with];
    memmove(&r->other_targets[1], &r->other_targets[0], with * sizeof kept);
    r->other_targets[0] = r->targets;
    r->targets = kept;
}

bool lom_make_targets(lom_renderer *r, int width, int height, int drawn_width, int drawn_height, lom_error *error)
{
    struct lom_targets *t = &r->targets;
    lom_texture_desc desc[LOM_TARGETS];
    if (are_of(t, width, height, drawn_width, drawn_height))
        return true;
    size_t other = 0;
    while (other < r->scene->view_count && !are_of(&r->other_targets[other], width, height, drawn_width, drawn_height))
        other++;
    exchange(r, other);
    if (are_of(t, width, height, drawn_width, drawn_height))
        return true;
    release_targets(r->device, t);
    *t = (struct lom_targets){
        .width = width, .height = height, .drawn_width = drawn_width, .drawn_height = drawn_height
    };
    describe(r->scene, t, desc);
    for (int i = 0; i < LOM_TARGETS; i++) {
        if (desc[i].width != 0 && shares(r->scene, desc, i))
            t->of[i] = t->of[rows[i].with];
        else if (desc[i].width != 0)
            t->of[i] = t->made[t->made_count++] = lom_make_texture(r->device, &desc[i]);
    }
    return lom_check_device(r->device, error);
}

uint64_t lom_target_bytes(const lom_scene *scene, int width, int height, int drawn_width, int drawn_height)
{
    const struct lom_targets size = {
        .width = width, .height = height, .drawn_width = drawn_width, .drawn_height = drawn_height
    };
    uint64_t bytes = (uint64_t)drawn_width * (uint64_t)drawn_height * lom_format_size(color_format(scene));
    lom_texture_desc desc[LOM_TARGETS];
    describe(scene, &size, desc);
    for (int i = 0; i < LOM_TARGETS; i++)
        if (!shares(scene, desc, i))
            bytes += (uint64_t)desc[i].width * (uint64_t)desc[i].height * lom_format_size(desc[i].format) *
                     (uint64_t)(desc[i].samples > 1 ? desc[i].samples + 1 : 1);
    return bytes;
}
