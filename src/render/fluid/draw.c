/* Liquids over a picture. In: the frame whose opaque scene and waters are drawn, or a picture that water looks up. Out:
 * liquids over it, one after the other: what is behind each is copied, the lengths of rays through it are summed, then
 * it is drawn with depth.
 *
 * Invariant: a liquid that is out of view is not stepped for it, and changes no byte; a crop is a part of the whole,
 * since what is drawn is larger by as much as bent rays look beyond it (edges.c, water/picture.c). */
#include "render/fluid/mesh.h"
#include "render/fluid/shaders.h"
#include "render/frame.h"
#include "shading/square.h"

int lom_fluid_reach(int height)
{
    return height / 12 + 1;
}

bool lom_shows_fluids(const lom_renderer *renderer, const struct lom_culler *culler)
{
    const lom_scene *scene = renderer->scene;
    for (size_t i = 0; i < scene->fluid_count; i++) {
        const lom_box box = lom_fluid_box(&scene->fluids[i]);
        if (lom_shows_liquid(scene, i) && lom_is_visible(culler, &box))
            return true;
    }
    return false;
}

void lom_set_fluid_mesh(lom_draw_desc *draw, const lom_mesh *mesh)
{
    const uint8_t *data = (const uint8_t *)mesh->vertices;
    const size_t size = mesh->vertex_count * sizeof(lom_mesh_vertex), stride = sizeof(lom_mesh_vertex);
    draw->attribute[0] = (lom_attribute){ data, size, stride, LOM_ATTRIBUTE_FLOAT3 };
    draw->attribute[1] = (lom_attribute){ data + 12, size - 12, stride, LOM_ATTRIBUTE_FLOAT3 };
    draw->indices = mesh->indices;
    draw->count = mesh->index_count;
    draw->label = "fluid";
}

/* ---- a picture ---- */

/* What liquids are drawn over: a picture as a pass of it has it, of a view. */
struct picture {
    struct frame *f;
    const struct lom_scene_view *view;
    const lom_pass_desc *pass;
    lom_texture *behind, *length;
    int width, height; /* of the whole of it */
    lom_rect part;     /* pixels of it that are drawn */
    double around;     /* index of refraction of what is around liquids: air, or water */
};

/* Of a view that is cut off at a level of water. */
static double index_around(const struct frame *f, const struct lom_scene_view *view)
{
    return view->plane[1] < 0 ? f->scene->water.optics.index : 1;
}

static struct picture picture_of(struct frame *f, const struct lom_scene_view *view, const lom_pass_desc *pass,
                                 enum lom_target behind, enum lom_target length)
{
    lom_texture *const *of = f->renderer->targets.of;
    const int width = lom_texture_width(pass->color[0]), height = lom_texture_height(pass->color[0]);
    struct picture p = {
        f, view, pass, of[behind], of[length], width, height, { 0, 0, width, height }, index_around(f, view)
    };
    if (pass->scissor.width != 0)
        p.part = pass->scissor;
    if (pass->frame_width != 0) {
        p.width = pass->frame_width;
        p.height = pass->frame_height;
        p.part = (lom_rect){ pass->origin_x, pass->origin_y, width, height };
    }
    return p;
}

/* The mesh is in single precision: its places are less the basin's low corner. */
static struct lom_fluid_uniforms uniforms_of(const struct picture *it, const lom_fluid_params *p)
{
    const lom_renderer *r = it->f->renderer;
    const double eye[3] = { it->view->eye.x, it->view->eye.y, it->view->eye.z };
    const lom_rect *part = &it->part;
    struct lom_fluid_uniforms u = { .view = lom_view_uniform_of(r, it->view),
                                    .origin = { it->pass->origin_x, it->pass->origin_y },
                                    .first = { part->x, part->y },
                                    .last = { part->x + part->width - 1, part->y + part->height - 1 },
                                    .size = { (float)it->width, (float)it->height },
                                    .reach = (float)(lom_fluid_reach(it->height) - 1),
                                    .eta = (float)(it->around / p->index),
                                    .sky_is_behind = it->view->mirrored && !it->view->sky && !it->f->below,
                                    .color = it->pass->color[0],
                                    .depth = it->pass->depth,
                                    .scene = it->behind,
                                    .length = it->length };
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

/* A pass over as much of the picture, into a target that is cleared. */
static lom_pass_desc pass_into(const struct picture *it, lom_texture *target, const char *label)
{
    lom_pass_desc pass = *it->pass;
    pass.color[0] = target;
    pass.edges = NULL;
    pass.label = label;
    for (int i = 0; i < 4; i++)
        pass.clear_color[0][i] = 0;
    return pass;
}

static bool copy_scene(const struct picture *it, const struct lom_fluid_uniforms *u)
{
    const lom_blend none = { .enabled = false };
    lom_pass_desc pass = pass_into(it, it->behind, "behind the fluid");
    pass.depth = NULL;
    pass.samples = 0;
    lom_begin_pass(it->f->renderer->device, &pass);
    lom_draw_square(it->f->renderer->device, &lom_fluid_copy_shader, u, &none);
    return lom_end_pass(it->f->renderer->device);
}

static bool sum_lengths(const struct picture *it, const struct lom_fluid_uniforms *u, const lom_mesh *mesh)
{
    lom_pass_desc pass = pass_into(it, it->length, "lengths in the fluid");
    pass.depth_load = LOM_LOAD_KEEP;
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
        draws[i].front_clockwise = it->view->mirrored;
        draws[i].blend[0] = add;
        lom_set_fluid_mesh(&draws[i], mesh);
    }
    return lom_draw_pass(it->f->renderer->device, &pass, draws, 2);
}

static bool draw_surface(const struct picture *it, const struct lom_fluid_uniforms *u, const lom_mesh *mesh)
{
    lom_pass_desc pass = *it->pass;
    pass.color_load[0] = pass.depth_load = LOM_LOAD_KEEP;
    pass.label = "fluid";
    if (pass.edges != NULL)
        pass.edges_load = LOM_LOAD_KEEP;
    lom_draw_desc draw = { .shader = &lom_fluid_shader,
                           .uniforms = u,
                           .cull = LOM_CULL_BACK,
                           .front_clockwise = it->view->mirrored,
                           .object = LOM_OBJECT_FLUID };
    lom_set_fluid_mesh(&draw, mesh);
    return lom_draw_pass(it->f->renderer->device, &pass, &draw, 1);
}

static bool draw_fluid(const struct picture *it, size_t number, lom_error *error)
{
    struct frame *f = it->f;
    if (!lom_ready_fluid(f, number, error))
        return false;
    const lom_mesh *mesh = f->renderer->fluids.items[number].liquid.mesh;
    if (mesh->index_count == 0)
        return true;
    const struct lom_fluid_uniforms u = uniforms_of(it, &f->scene->fluids[number]);
    return copy_scene(it, &u) && sum_lengths(it, &u, mesh) && draw_surface(it, &u, mesh);
}

bool lom_draw_fluids_over(struct frame *f, const struct lom_scene_view *view, const lom_pass_desc *pass,
                          enum lom_target behind, enum lom_target length, lom_error *error)
{
    const struct lom_culler culler = lom_culler_of(view, NULL);
    const struct picture picture = picture_of(f, view, pass, behind, length);
    for (size_t i = 0; i < f->scene->fluid_count; i++) {
        const lom_box box = lom_fluid_box(&f->scene->fluids[i]);
        if (lom_shows_liquid(f->scene, i) && lom_is_visible(&culler, &box) && !draw_fluid(&picture, i, error))
            return false;
    }
    return true;
}

/* ---- the frame ---- */

/* What of a basin is on this side (1) of the water that is drawn first, or beyond it (-1): all of it, where it is not
 * over or under that water or does not come through its level; none; or a part. */
enum share { NONE, PART, ALL };

/* Or under it. */
static bool is_over_water(const struct frame *f, size_t number)
{
    const lom_fluid_params *p = &f->scene->fluids[number];
    const lom_water_params *w = lom_water_of(f->renderer->world->scene, f->divided_by);
    bool meets = f->shows_water;
    for (int i = 0; i < 2; i++)
        meets = meets && p->low[2 * i] < w->position[i] + w->size[i] / 2 &&
                p->high[2 * i] > w->position[i] - w->size[i] / 2;
    return meets;
}

static enum share share_of(const struct frame *f, size_t number, double side)
{
    const lom_fluid_params *p = &f->scene->fluids[number];
    const double up = f->view.eye.y < f->divided_at ? -side : side;
    if (!is_over_water(f, number))
        return side > 0 ? ALL : NONE;
    const bool above = p->high[1] > f->divided_at, below = p->low[1] < f->divided_at;
    return above && below ? PART : (up > 0) == above ? ALL : NONE;
}

static const char *name_of(const struct frame *f, size_t number)
{
    const char *name = f->scene->fluids[number].name;
    return name != NULL ? name : "a liquid";
}

static bool draw_in_frame(struct frame *f, size_t number, enum share share, double side, lom_error *error)
{
    lom_pass_desc pass = lom_frame_pass(f, f->renderer->targets.of[f->target]);
    pass.edges = f->smooths ? f->renderer->targets.of[LOM_TARGET_EDGES] : NULL;
    const struct lom_scene_view part = lom_view_of_side(f, side);
    struct picture picture =
        picture_of(f, share == ALL ? &f->view : &part, &pass, LOM_TARGET_FLUID_SCENE, LOM_TARGET_FLUID_LENGTH);
    const char *where = side < 0 ? " beyond the water" : share == PART ? " on this side of the water" : "";
    if (share == ALL && is_over_water(f, number))
        picture.around = index_around(f, &part);
    if (!lom_ready_fluid(f, number, error))
        return false;
    lom_step *step = lom_add_step(f, "fluid", true, "%s%s: what is behind it, lengths of rays through it, its surface",
                                  name_of(f, number), where);
    step->width = f->crop.width;
    step->height = f->crop.height;
    return draw_fluid(&picture, number, error);
}

static bool draw_side(struct frame *f, double side, lom_error *error)
{
    const lom_scene *scene = f->scene;
    const struct lom_culler culler = lom_culler_of(&f->view, NULL);
    for (size_t i = 0; i < scene->fluid_count; i++) {
        const lom_fluid_params *p = &scene->fluids[i];
        const lom_box box = lom_fluid_box(p);
        const enum share share = share_of(f, i, side);
        if (!p->visible || share == NONE)
            continue;
        if (lom_is_visible(&culler, &box) && !draw_in_frame(f, i, share, side, error))
            return false;
        if (!lom_is_visible(&culler, &box) && side > 0)
            lom_add_step(f, "fluid", false, "the basin of %s is out of view%s", name_of(f, i),
                         f->renderer->fluids.items[i].ready ? "" : ": no step of it is run");
    }
    return true;
}

bool lom_draw_fluids(struct frame *f, lom_error *error)
{
    if (f->scene->fluid_count == 0)
        return true;
    if (f->scene->quality.fluid)
        return draw_side(f, 1, error);
    lom_add_step(f, "fluid", false, "quality.fluid is off");
    return true;
}

bool lom_draw_fluids_beyond(struct frame *f, lom_error *error)
{
    return lom_count_fluids(f->scene) == 0 || draw_side(f, -1, error);
}
