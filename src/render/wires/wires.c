/* The edges of triangles over the picture of the scene. In: the frame, its entities and its ground at their levels of
 * detail. Out: a line an edge, each once. A line's pixels lie up to half a pixel beside it, where the surfaces on its sides
 * may be nearer than it is: hidden lines are found with a depth of their own, of surfaces that are moved away by as much as
 * they fall within two pixels (polygon offset).
 *
 * Invariant: what the picture's depth says does not change, so that water and clouds see the surfaces alone. */
#include "render/wires/wires.h"

#include "render/frame.h"
#include "render/wires/shaders.h"

static const float offset_slope = -2, offset_units = -4;

static lom_draw_desc surface_draw(const void *uniforms)
{
    return (lom_draw_desc){ .shader = &lom_wire_surface_shader,
                            .uniforms = uniforms,
                            .depth_bias = offset_units,
                            .depth_bias_slope = offset_slope };
}

static lom_draw_desc edge_draw(const struct frame *f, const void *uniforms)
{
    return (lom_draw_desc){ .shader = &lom_wire_shader,
                            .uniforms = uniforms,
                            .topology = LOM_LINES,
                            .depth_test_off = f->scene->quality.wireframe == LOM_WIREFRAME_ALL,
                            .depth_write_off = true,
                            .label = "wireframe" };
}

static void set_color(const struct frame *f, float color[3])
{
    for (int i = 0; i < 3; i++)
        color[i] = (float)f->scene->quality.wireframe_color[i];
}

/* Places of a model less the eye, in clip space. */
static struct lom_wire_uniforms uniforms_of(const struct frame *f, const lom_mat4 *world_from_model)
{
    lom_mat4 clip_from_offset = lom_clip_from_offset(&f->view.projection, &f->view.view), offset = *world_from_model;
    offset.m[0][3] -= f->view.eye.x;
    offset.m[1][3] -= f->view.eye.y;
    offset.m[2][3] -= f->view.eye.z;
    lom_mat4 clip_from_model = lom_multiply(&clip_from_offset, &offset);
    struct lom_wire_uniforms uniforms = { lom_round_matrix(&clip_from_model), { 0 } };
    set_color(f, uniforms.color);
    return uniforms;
}

static void draw_entities(struct frame *f, const struct lom_culler *culler, bool edges)
{
    const lom_renderer *r = f->renderer;
    for (size_t i = 0; i < r->entities.count; i++) {
        const struct lom_drawn_entity *entity = &r->entities.items[i];
        const lom_mesh *mesh = entity->source->mesh;
        if (!lom_shows_entity(entity, culler))
            continue;
        const struct lom_wire_uniforms wire = uniforms_of(f, &entity->at->world_from_model);
        lom_draw_desc draw = edges ? edge_draw(f, &wire) : surface_draw(&wire);
        draw.attribute[0] = (lom_attribute){ mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices,
                                             sizeof *mesh->vertices, LOM_ATTRIBUTE_FLOAT3 };
        draw.indices = edges ? entity->edges : mesh->indices;
        draw.count = edges ? entity->edge_count : mesh->index_count;
        lom_draw(f->renderer->device, &draw);
    }
}

/* A block's own edges and those of its left and upper border; the others are its neighbours', unless it has none. */
static void draw_block_edges(struct frame *f, lom_draw_desc *draw, uint32_t number,
                             const struct lom_ground_pattern *pattern)
{
    const struct lom_ground *ground = &f->renderer->ground;
    const bool last_column = (int)number % ground->across == ground->across - 1;
    const bool last_row = (int)number / ground->across == ground->down - 1;
    const bool drawn[LOM_WIRES] = { true, last_column, last_row };
    draw->indices = pattern->wires;
    draw->first = 0;
    for (int i = 0; i < LOM_WIRES; draw->first += pattern->wire_count[i++]) {
        draw->count = pattern->wire_count[i];
        if (drawn[i])
            lom_draw(f->renderer->device, draw);
    }
}

static void draw_ground(struct frame *f, const struct lom_culler *culler, bool edges)
{
    const struct lom_ground *ground = &f->renderer->ground;
    const lom_mat4 world_from_model = lom_translation((lom_vec3){ 0, f->scene->terrain.base, 0 });
    const struct lom_wire_uniforms wire = uniforms_of(f, &world_from_model);
    lom_draw_desc draw = edges ? edge_draw(f, &wire) : surface_draw(&wire);
    if (!edges) {
        lom_draw_ground_blocks(f->renderer, culler, &draw);
        return;
    }
    lom_take_ground(ground, &draw);
    lom_see_ground(ground, culler, LOM_EVERYWHERE);
    for (int i = 0; i < ground->across * ground->down; i++) {
        uint32_t number;
        const struct lom_ground_pattern *pattern = lom_find_ground_draw(ground, i, &draw, &number);
        if (pattern != NULL)
            draw_block_edges(f, &draw, number, pattern);
    }
}

static void draw_cut_ground(struct frame *f, const struct lom_culler *culler, bool edges)
{
    const lom_draw_desc draw = edges ? edge_draw(f, NULL) : surface_draw(NULL);
    float color[3];
    set_color(f, color);
    lom_draw_cut_wires(f->renderer, &f->view, culler, &draw, edges ? color : NULL);
}

static void draw_all(struct frame *f, const struct lom_culler *culler, bool edges)
{
    if (f->renderer->ground.blocks != NULL)
        (f->renderer->ground.knot != NULL ? draw_cut_ground : draw_ground)(f, culler, edges);
    draw_entities(f, culler, edges);
}

bool lom_draw_wires(struct frame *f)
{
    lom_renderer *r = f->renderer;
    const lom_wireframe kind = f->scene->quality.wireframe;
    if (kind == LOM_WIREFRAME_OFF)
        return true;
    lom_step *step = lom_add_step(f, "wireframe", true, "edges of terrain and entities, %s",
                                  kind == LOM_WIREFRAME_ALL ? "hidden or not" : "hidden ones left out");
    step->width = f->crop.width;
    step->height = f->crop.height;
    struct lom_culler culler = lom_culler_of(&f->view, NULL);
    lom_pass_desc pass = lom_frame_pass(f, r->targets.of[f->target]);
    pass.depth = kind == LOM_WIREFRAME_ALL ? NULL : r->targets.of[LOM_TARGET_WIRE_DEPTH];
    pass.color_load[0] = LOM_LOAD_KEEP;
    pass.label = "wireframe";
    lom_begin_pass(r->device, &pass);
    if (pass.depth != NULL)
        draw_all(f, &culler, false);
    draw_all(f, &culler, true);
    return lom_end_pass(r->device);
}
