/* Recording a draw. In: a descriptor. Out: a checked copy of it, with the pass's defaults filled in, unless there is one
 * already that differs in what a call names (call.c). Invariant: nothing that is recorded can make a later stage read outside what the descriptor names. */
#include "lanes/variants.h"
#include "pipeline/check_device.h"
#include "pipeline/draw_again.h"
#include "pipeline/expand.h"

enum { LARGEST_LINE_WIDTH = 64 };

static size_t attribute_size(lom_attribute_kind kind)
{
    static const size_t sizes[] = { 0, 4, 8, 12, 16, 4 };
    return sizes[kind];
}

static size_t count_values(const lom_attribute *a)
{
    size_t size = attribute_size(a->kind);
    return a->data == NULL || a->size < size ? 0 : a->stride == 0 ? SIZE_MAX : (a->size - size) / a->stride + 1;
}

/* Vertices that all attributes together hold. */
static size_t count_vertices(const lom_draw_desc *desc)
{
    size_t count = UINT32_MAX - 1;
    for (int i = 0; i < desc->shader->attributes; i++) {
        const lom_attribute *a = &desc->attribute[i];
        if (a->kind == LOM_ATTRIBUTE_NONE || desc->divisor[i] != 0)
            continue;
        size_t held = count_values(a);
        count = held < count ? held : count;
    }
    return count;
}

static bool check_shader(lom_device *device, const lom_draw_desc *desc)
{
    const lom_shader *s = desc->shader;
    if (s == NULL)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A draw names no shader.");
    if (s->attributes < 0 || s->attributes > LOM_MAX_ATTRIBUTES || s->varyings < 0 || s->varyings > LOM_MAX_VARYINGS ||
        s->clip_distances < 0 || s->cull_distances < 0 || s->clip_distances + s->cull_distances > LOM_MAX_DISTANCES ||
        s->colors < 0 || s->colors > LOM_MAX_COLORS)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Shader %s declares more than a shader may have.", s->name);
    if ((s->differentiates & ~s->reads) != 0)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Shader %s differentiates a varying that it does not read.",
                        s->name);
    if ((s->differentiates & s->screen_linear) != 0)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "Shader %s differentiates a varying that is linear in the window.", s->name);
    if (s->uniforms_size != 0 && desc->uniforms == NULL)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "Shader %s takes %zu bytes of uniforms, but the draw has none.", s->name, s->uniforms_size);
    return true;
}

/* What sprites and their shaders must agree on, what lines, points and sprites have not, and what a shader that reads the
 * target's depth needs. */
static bool check_sprites(lom_device *device, const lom_draw_desc *desc)
{
    static const char *const names[] = { "triangles", "triangles", "triangles", "sprites", "points", "lines" };
    const lom_shader *s = desc->shader;
    const lom_topology drawn = lom_drawn_topology(desc);
    const char *name = names[drawn];
    bool sprites = desc->topology == LOM_SPRITES, depth = device->pass.depth != NULL;
    if (sprites != s->sprites)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Shader %s is %s, but its draw is of %s.", s->name,
                        s->sprites ? "for sprites" : "not for sprites", name);
    if (sprites && s->differentiates != 0)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "Shader %s differentiates a varying, but those of sprites are the same at every pixel.",
                        s->name);
    if (drawn != LOM_TRIANGLES && (desc->depth_bias != 0 || desc->depth_bias_slope != 0))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "A draw of %s has a depth bias (%s).", name, s->name);
    if (drawn == LOM_LINES && (desc->line_width < 0 || desc->line_width > LARGEST_LINE_WIDTH))
        return lom_fail(&device->error, LOM_ERROR_LIMIT, "Lines are 1 to %d pixels wide, not %d (a draw of %s).",
                        LARGEST_LINE_WIDTH, desc->line_width, s->name);
    if (s->reads_depth && (!depth || !(desc->depth_test_off || desc->depth_write_off) || s->writes_depth))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Shader %s reads the target's depth, %s.", s->name,
                        depth ? "which its draw would write" : "but the pass has none");
    return true;
}

/* Attributes with a divisor hold a value for every instance. */
static bool check_instances(lom_device *device, const lom_draw_desc *desc)
{
    const size_t instances = desc->instances == 0 ? 1 : (size_t)desc->instances;
    for (int i = 0; i < desc->shader->attributes; i++) {
        const int divisor = desc->divisor[i];
        if (divisor < 0)
            return lom_fail(&device->error, LOM_ERROR_USAGE, "Attribute %d of a draw of %s has the divisor %d.", i,
                            desc->shader->name, divisor);
        if (divisor == 0 || desc->attribute[i].kind == LOM_ATTRIBUTE_NONE)
            continue;
        size_t held = count_values(&desc->attribute[i]), needed = (instances - 1) / (size_t)divisor + 1;
        if (held < needed)
            return lom_fail(&device->error, LOM_ERROR_USAGE,
                            "Attribute %d of a draw of %s holds %zu values for its instances, which take %zu.", i,
                            desc->shader->name, held, needed);
    }
    return true;
}

static bool check_geometry(lom_device *device, const lom_draw_desc *desc)
{
    const char *name = desc->shader->name;
    if (desc->index_bits != 0 && desc->index_bits != 16 && desc->index_bits != 32)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Indices have 16 or 32 bits, not %d (a draw of %s).",
                        desc->index_bits, name);
    if (desc->instances < 0 || desc->topology < LOM_TRIANGLES || desc->topology > LOM_PATCHES ||
        desc->provoking < LOM_PROVOKING_LAST || desc->provoking > LOM_PROVOKING_FIRST)
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "A draw of %s has a topology, provoking vertex or instance count that is none.", name);
    if (desc->provoking == LOM_PROVOKING_FIRST &&
        (desc->tessellation != NULL || desc->geometry != NULL || desc->feedback != NULL))
        return lom_fail(&device->error, LOM_ERROR_USAGE,
                        "The first vertex is provoking in a draw of %s, which has stages of lom/stages.h.", name);
    if (!__builtin_isfinite(desc->depth_bias) || !__builtin_isfinite(desc->depth_bias_slope))
        return lom_fail(&device->error, LOM_ERROR_USAGE, "The depth bias of a draw of %s is not finite.", name);
    if (desc->count > UINT32_MAX || desc->first > UINT32_MAX)
        return lom_fail(&device->error, LOM_ERROR_LIMIT, "A draw of %s has more than 2^32 indices.", name);
    for (int i = 0; i < desc->shader->attributes; i++)
        if (desc->attribute[i].kind < LOM_ATTRIBUTE_NONE || desc->attribute[i].kind > LOM_ATTRIBUTE_UNORM8X4)
            return lom_fail(&device->error, LOM_ERROR_USAGE, "Attribute %d of a draw of %s has no kind.", i, name);
    return check_instances(device, desc);
}

/* Clusters must be those of the draw's indices. Chunks that are shorter than a cluster do without. */
static bool check_clusters(lom_device *device, const lom_draw_desc *desc)
{
    const lom_clusters *clusters = desc->culling.clusters;
    if (clusters == NULL || (desc->topology == LOM_TRIANGLES && desc->indices != NULL && desc->index_bits != 16 &&
                             desc->first == 0 && desc->base_vertex == 0 && !desc->restart && desc->instances <= 1 &&
                             desc->count == clusters->indices && clusters->largest < count_vertices(desc) &&
                             (desc->vertex_count == 0 || clusters->largest < desc->vertex_count)))
        return true;
    return lom_fail(
        &device->error, LOM_ERROR_USAGE,
        "The clusters of a draw of %s are not those of its indices, or it is more than a list of triangles.",
        desc->shader->name);
}

/* A draw without indices takes the vertices first .. first + count - 1, moved by base_vertex: all must be there. */
static bool check_vertices(lom_device *device, const lom_draw_desc *desc)
{
    size_t held = count_vertices(desc);
    held = desc->vertex_count != 0 && desc->vertex_count < held ? desc->vertex_count : held;
    int64_t from = (int64_t)desc->first + desc->base_vertex, to = from + (int64_t)desc->count - 1;
    if (desc->indices != NULL || desc->count == 0 || (from >= 0 && to < (int64_t)held))
        return true;
    return lom_fail(&device->error, LOM_ERROR_USAGE, "A draw of %s takes the vertices %lld to %lld, but there are %zu.",
                    desc->shader->name, (long long)from, (long long)to, held);
}

/* The shader's width nearest to the device's that it was built for: the bytes are the same at every width. Sprites and
 * points are not recorded, only counted. */
static int choose_shader_variant(const lom_device *device, const lom_draw_desc *desc)
{
    lom_topology drawn = lom_drawn_topology(desc);
    bool counted = drawn == LOM_SPRITES || drawn == LOM_POINTS;
    bool is_recorded = device->pass.is_recorded && (!counted || device->pass.tallier != NULL);
    if (is_recorded && lom_has_variant(desc, LOM_SLOT_4_recorded))
        return LOM_SLOT_4_recorded;
    if (lom_has_variant(desc, device->variant))
        return device->variant;
    for (int variant = 0; variant < LOM_VARIANTS; variant++)
        if (lom_has_variant(desc, variant) && lom_runs_variant(variant))
            return variant;
    return -1;
}

static size_t count_triangles(const lom_draw_desc *desc)
{
    switch (desc->topology) {
    case LOM_TRIANGLES:
        return desc->count / 3;
    case LOM_SPRITES:
    case LOM_POINTS:
        return desc->count;
    case LOM_LINES:
        return desc->count / 2;
    case LOM_LINE_STRIP:
        return desc->count < 2 ? 0 : desc->count - 1;
    case LOM_PATCHES:
        return desc->count / (size_t)desc->patch_points;
    default:
        return desc->count < 3 ? 0 : desc->count - 2;
    }
}

static void derive(struct lom_pass *pass, struct lom_draw *draw)
{
    lom_draw_desc *desc = &draw->desc;
    const lom_shader *shader = desc->shader;
    size_t held = count_vertices(desc);
    desc->vertex_count = desc->vertex_count == 0 || desc->vertex_count > held ? held : desc->vertex_count;
    desc->index_bits = desc->index_bits == 0 ? 32 : desc->index_bits;
    desc->instances = desc->instances == 0 ? 1 : desc->instances;
    for (int i = 0; i < shader->attributes; i++)
        draw->instanced |= desc->divisor[i] != 0;
    desc->provoking = shader->flat == 0 ? LOM_PROVOKING_LAST : desc->provoking;
    desc->line_width = desc->line_width == 0 ? 1 : desc->line_width;
    draw->triangles = count_triangles(desc);
    draw->distances = shader->clip_distances + shader->cull_distances;
    lom_derive_stages(pass, draw);
    draw->sprites = draw->drawn == LOM_SPRITES || draw->drawn == LOM_POINTS;
    draw->lines = draw->drawn == LOM_LINES;
    draw->clamps_points = draw->sprites && desc->depth_clamp;
    draw->distance_offset = ROW_HEADER + ((shader->varyings + 3) & ~3);
    draw->axis_offset = draw->distance_offset + ((draw->distances + 3) & ~3);
    draw->row_floats = draw->axis_offset + (draw->sprites ? 4 : 0);
    bool depth = pass->depth != NULL && !desc->depth_test_off;
    draw->compare = !depth                                       ? LOM_COMPARE_ALWAYS
                    : desc->depth_compare == LOM_COMPARE_DEFAULT ? LOM_COMPARE_GREATER
                                                                 : desc->depth_compare;
    draw->depth_write = depth && !desc->depth_write_off;
    draw->late_depth = shader->discards || shader->writes_depth || desc->alpha_to_coverage;
    draw->biased = pass->depth != NULL && (desc->depth_bias != 0 || desc->depth_bias_slope != 0);
    draw->marks_edges = pass->edges != 0 && draw->depth_write;
    lom_derive_output(pass, draw);
    lom_resolve_stencil_state(&desc->stencil);
    draw->full_tests = desc->stencil.enabled || desc->query != NULL;
    desc->per_sample = (desc->per_sample || pass->desc.per_sample) && pass->samples > 1;
    draw->sampled = pass->samples > 1 || desc->alpha_to_coverage || (draw->full_tests && draw->late_depth);
    draw->constant = !pass->is_recorded && pass->samples == 1 && shader->fragment[draw->variant] != NULL &&
                     shader->reads == 0 && !shader->reads_position && !draw->late_depth && !shader->quads &&
                     !draw->sprites && !shader->reads_depth && !draw->two_sources && !draw->full_tests &&
                     !draw->marks_edges;
    draw->packs = !draw->constant && !draw->biased && !shader->quads && !desc->per_sample && !draw->full_tests;
    draw->queues_depth = shader->reads_position || draw->late_depth || draw->full_tests;
    lom_derive_viewport(pass, draw);
    draw->rasterizes = !pass->desc.feedback_only && draw->scissor.width > 0 && draw->scissor.height > 0;
    draw->constant &= draw->rasterizes;
}

static bool check_draw(lom_device *device, const lom_draw_desc *desc)
{
    return check_shader(device, desc) && check_geometry(device, desc) && lom_check_draw_viewport(device, desc) &&
           lom_check_stages(device, desc) && check_sprites(device, desc) && check_vertices(device, desc) &&
           check_clusters(device, desc) && lom_check_output(device, desc) && lom_check_stencil(device, desc) &&
           lom_check_queries(device, desc);
}

static bool add_draw(lom_device *device, const lom_draw_desc *desc, size_t counter, struct lom_call *call)
{
    struct lom_pass *pass = &device->pass;
    if (!lom_reserve(&device->draws, &device->draw_capacity, pass->draw_count + 1, sizeof *device->draws, NULL))
        return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for another draw.");
    struct lom_draw *draw = &device->draws[pass->draw_count];
    *draw = (struct lom_draw){ .desc = *desc, .variant = choose_shader_variant(device, desc), .counter = counter };
    if (draw->variant < 0)
        return lom_fail(&device->error, LOM_ERROR_USAGE, "Shader %s was built for no width that this processor runs.",
                        desc->shader->name);
    derive(pass, draw);
    if (device->desc.chunk < CLUSTER_TRIANGLES || pass->recorder != NULL || /* records number all triangles */
        draw->desc.depth_clamp || draw->desc.provoking == LOM_PROVOKING_FIRST)
        draw->desc.culling.clusters = NULL;
    *call = (struct lom_call){ .draw = (uint32_t)pass->draw_count++,
                               .triangles = (uint32_t)draw->triangles,
                               .base_vertex = desc->base_vertex };
    lom_note_draw(device, desc);
    return true;
}

bool lom_hold_draw(lom_device *device, const lom_draw_desc *desc, struct lom_held_draw *held)
{
    struct lom_call call = { 0 };
    *held = (struct lom_held_draw){ .is_held = false };
    if (!lom_check_device(device, NULL) || !device->in_pass || !lom_may_be_shared(device, desc))
        return false;
    const bool found = lom_find_draw(device, desc, &call) && call.triangles <= device->draws[call.draw].triangles;
    if ((!found && (!check_draw(device, desc) || !add_draw(device, desc, 0, &call))) ||
        device->draws[call.draw].constant || !lom_copy_uniforms(device, desc, &call))
        return false;
    const int corners = desc->topology == LOM_PATCHES ? desc->patch_points : 3;
    *held = (struct lom_held_draw){ true, corners, call.draw, call.uniforms, device->draws[call.draw].desc.first };
    return true;
}

bool lom_record_draw(lom_device *device, const lom_draw_desc *desc)
{
    struct lom_call call;
    if (desc->count / 3 <= SMALL_DRAW && lom_find_draw(device, desc, &call))
        return lom_add_call(device, desc, &call);
    lom_draw_desc counted;
    if (desc->count_from != NULL) {
        counted = *desc;
        counted.count = desc->count_from->written;
        desc = &counted;
    }
    if (!check_draw(device, desc))
        return false;
    size_t counter = desc->query != NULL ? lom_name_query(device, desc->query) : 0; /* also of what is left out */
    return !lom_meets_condition(desc) || (add_draw(device, desc, counter, &call) && lom_add_call(device, desc, &call));
}
