/* The liquids of a frame. In: the frame whose opaque scene and waters are drawn. Out: liquids over it, one after the
 * other: what is behind each is copied, the lengths of rays through it are summed, then it is drawn with depth.
 *
 * Invariant: a liquid that is out of view is not stepped, and changes no byte; a crop is a part of the whole, since
 * what is drawn is larger by as much as bent rays look beyond it (edges.c). */
#include "render/fluid/advance.h"
#include "render/fluid/shaders.h"
#include "shading/square.h"

int lom_fluid_reach(int height)
{
    return height / 12 + 1;
}

static lom_box box_of(const lom_fluid_params *p)
{
    return (lom_box){ { p->low[0], p->low[1], p->low[2] }, { p->high[0], p->high[1], p->high[2] } };
}

/* The mesh is in single precision: its places are less the basin's low corner. */
static struct lom_fluid_uniforms uniforms_of(const struct frame *f, const lom_fluid_params *p)
{
    const lom_renderer *r = f->renderer;
    const double eye[3] = { f->view.eye.x, f->view.eye.y, f->view.eye.z };
    struct lom_fluid_uniforms u = { .view = lom_view_uniform_of(r, &f->view),
                                    .first = { f->crop.x, f->crop.y },
                                    .last = { f->crop.x + f->crop.width - 1, f->crop.y + f->crop.height - 1 },
                                    .size = { (float)f->width, (float)f->height },
                                    .reach = (float)(lom_fluid_reach(f->height) - 1),
                                    .eta = (float)(1 / p->index),
                                    .color = r->targets.of[f->target],
                                    .depth = r->targets.of[LOM_TARGET_DEPTH],
                                    .scene = r->targets.of[LOM_TARGET_FLUID_SCENE],
                                    .length = r->targets.of[LOM_TARGET_FLUID_LENGTH] };
    lom_set_sky(&u.sky, r);
    for (int i = 0; i < 3; i++) {
        u.shift[i] = (float)(p->low[i] - eye[i]);
        u.absorption[i] = (float)p->absorption[i];
        u.body.ambient[i] = u.body.diffuse[i] = (float)p->color[i];
        u.body.specular[i] = (float)p->highlight;
    }
    u.body.shininess = (float)p->shininess;
    u.body.opacity = 1;
    return u;
}

static void set_mesh(lom_draw_desc *draw, const lom_mesh *mesh)
{
    const uint8_t *data = (const uint8_t *)mesh->vertices;
    const size_t size = mesh->vertex_count * sizeof(lom_mesh_vertex), stride = sizeof(lom_mesh_vertex);
    draw->attribute[0] = (lom_attribute){ data, size, stride, LOM_ATTRIBUTE_FLOAT3 };
    draw->attribute[1] = (lom_attribute){ data + 12, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 };
    draw->indices = mesh->indices;
    draw->count = mesh->index_count;
    draw->label = "fluid";
}

static bool copy_scene(struct frame *f, const struct lom_fluid_uniforms *u)
{
    const lom_blend none = { .enabled = false };
    lom_pass_desc pass = lom_frame_pass(f, f->renderer->targets.of[LOM_TARGET_FLUID_SCENE]);
    pass.depth = NULL;
    pass.samples = 0;
    pass.label = "behind the fluid";
    lom_begin_pass(f->renderer->device, &pass);
    lom_draw_square(f->renderer->device, &lom_fluid_copy_shader, u, &none);
    return lom_end_pass(f->renderer->device);
}

static bool sum_lengths(struct frame *f, const struct lom_fluid_uniforms *u, const lom_mesh *mesh)
{
    lom_pass_desc pass = lom_frame_pass(f, f->renderer->targets.of[LOM_TARGET_FLUID_LENGTH]);
    pass.depth_load = LOM_LOAD_KEEP;
    pass.label = "lengths in the fluid";
    struct lom_fluid_uniforms backs = *u, fronts = *u;
    backs.side = 1;
    fronts.side = -1;
    const lom_blend add = {
        .enabled = true, .source_color = LOM_FACTOR_ONE, .target_color = LOM_FACTOR_ONE, .target_alpha = LOM_FACTOR_ONE
    };
    lom_draw_desc draws[2] = { { .uniforms = &backs, .cull = LOM_CULL_FRONT },
                               { .uniforms = &fronts, .cull = LOM_CULL_BACK } };
    for (int i = 0; i < 2; i++) {
        draws[i].shader = &lom_fluid_length_shader;
        draws[i].depth_compare = LOM_COMPARE_ALWAYS;
        draws[i].depth_write_off = true;
        draws[i].blend[0] = add;
        set_mesh(&draws[i], mesh);
    }
    return lom_draw_pass(f->renderer->device, &pass, draws, 2);
}

static bool draw_surface(struct frame *f, const struct lom_fluid_uniforms *u, const lom_mesh *mesh)
{
    lom_pass_desc pass = lom_frame_pass(f, f->renderer->targets.of[f->target]);
    pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    pass.label = "fluid";
    if (f->smooths) {
        pass.edges = f->renderer->targets.of[LOM_TARGET_EDGES];
        pass.edges_load = LOM_LOAD_KEEP;
    }
    lom_draw_desc draw = {
        .shader = &lom_fluid_shader, .uniforms = u, .cull = LOM_CULL_BACK, .object = LOM_OBJECT_FLUID
    };
    set_mesh(&draw, mesh);
    return lom_draw_pass(f->renderer->device, &pass, &draw, 1);
}

static bool draw_fluid(struct frame *f, size_t number, lom_error *error)
{
    const lom_fluid_params *p = &f->scene->fluids[number];
    const struct lom_drawn_fluids *all = &f->renderer->fluids;
    const uint64_t before = all->run;
    if (!lom_advance_fluid(f, number, error))
        return false;
    const lom_fluid_view view = lom_view_fluid(all->items[number].fluid);
    const lom_mesh *mesh = all->items[number].mesh;
    lom_step *step = lom_add_step(f, "fluid", true,
                                  "%lld steps from the beginning, %llu of them for this frame; %zu "
                                  "particles, %zu triangles, over what is behind them",
                                  (long long)view.steps, (unsigned long long)(all->run - before), view.particles,
                                  mesh->index_count / 3);
    step->width = f->crop.width;
    step->height = f->crop.height;
    if (mesh->index_count == 0)
        return true;
    const struct lom_fluid_uniforms u = uniforms_of(f, p);
    return copy_scene(f, &u) && sum_lengths(f, &u, mesh) && draw_surface(f, &u, mesh);
}

bool lom_draw_fluids(struct frame *f, lom_error *error)
{
    const lom_scene *scene = f->scene;
    const struct lom_culler culler = lom_culler_of(&f->view, NULL);
    if (scene->fluid_count == 0)
        return true;
    if (!scene->quality.fluid) {
        lom_add_step(f, "fluid", false, "quality.fluid is off");
        return true;
    }
    for (size_t i = 0; i < scene->fluid_count; i++) {
        const lom_box box = box_of(&scene->fluids[i]);
        if (!scene->fluids[i].visible)
            continue;
        if (!lom_is_visible(&culler, &box))
            lom_add_step(f, "fluid", false, "the basin of %s is out of view: no step of it is run",
                         scene->fluids[i].name != NULL ? scene->fluids[i].name : "a liquid");
        else if (!draw_fluid(f, i, error))
            return false;
    }
    return true;
}
