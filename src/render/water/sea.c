/* Water with waves in a frame: normals on two triangles, a displaced mesh, or a ray a pixel. In: the frame whose opaque
 * scene is drawn. Out: the water over it, and for an eye below its surface the water in between.
 *
 *   visibility (where may it be?) -> reflection, refraction (only there) -> water -> underwater
 *
 * Invariant: a pass that is left out, or cut by a scissor, changes no byte of the picture. */
#include "render/water/passes.h"
#include "sky/sky_draw.h"
#include "water/underwater.h"

struct sea {
    struct lom_surface_uniforms uniforms;
    lom_mat4 clip_from_offset; /* places less the eye, as everything here */
    double level, quad[4];
};

/* World directions of (ndc x, ndc y, 1): the view's rotation of (x / p00, y / p11, -1). */
static void set_rays(float out[3][3], const struct lom_scene_view *view)
{
    double scale[3] = { 1 / view->projection.m[0][0], 1 / view->projection.m[1][1], -1 };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out[i][k] = (float)(view->view.m[k][i] * scale[k]);
}

/* The light that the water sends back is `scatter` of what a white surface would, seen from straight above: there the
 * way down and the way up are 1 + slant metres a metre. */
static void set_medium(struct lom_medium_uniform *medium, const lom_scene *scene)
{
    const lom_water_optics *optics = &scene->water.optics;
    double up = -scene->light.direction.y, flat = 1 - up * up;
    double refracted = 1 - flat / (optics->index * optics->index);
    double slant = up > 0 ? 1 / lom_double_sqrt(refracted) : 1;
    medium->slant = (float)slant;
    for (int i = 0; i < 3; i++) {
        double sun = scene->light.color[i] * scene->light.intensity * (up > 0 ? up : 0);
        medium->absorption[i] = (float)optics->absorption[i];
        medium->source[i] = (float)(optics->scatter[i] * (sun + scene->light.ambient[i]) * (1 + slant));
    }
}

static void set_sky(struct lom_sky_uniform *sky, const lom_renderer *renderer)
{
    const lom_sky_params *params = &renderer->scene->sky;
    sky->box = renderer->sky.box;
    sky->cosine = (float)lom_double_cos(-params->rotation);
    sky->sine = (float)lom_double_sin(-params->rotation);
    sky->size = renderer->sky.box != NULL ? (float)lom_texture_width(renderer->sky.box) : 0;
    sky->gradient = lom_sky_gradient_of(params, renderer->sky.box, lom_scene_light(renderer->scene).to_light);
    bool is_factor = renderer->sky.box != NULL || sky->gradient.on;
    for (int i = 0; i < 3; i++)
        sky->color[i] = (float)(params->intensity * (is_factor ? 1 : params->color[i]));
}

static void set_foam(struct lom_foam_uniform *foam, const struct frame *f)
{
    const lom_water_foam *params = &f->scene->water.foam;
    double move = f->time / 4;
    foam->pattern = f->renderer->water.foam;
    foam->amount = (float)params->amount;
    foam->shore_depth = (float)params->shore_depth;
    foam->inverse_tile = (float)(1 / params->tile);
    foam->move = (float)(move - lom_double_floor(move));
    const double *middle = f->scene->water.position;
    const double at[2] = { f->view.eye.x - middle[0], f->view.eye.z - middle[1] };
    for (int i = 0; i < 2; i++)
        foam->shift[i] = (float)(at[i] / params->tile - lom_double_floor(at[i] / params->tile));
}

static void set_optics(struct lom_surface_uniforms *u, const lom_scene *scene)
{
    const lom_water_optics *optics = &scene->water.optics;
    u->roughness = (float)optics->roughness;
    u->glitter = (float)optics->glitter;
    u->reach = (float)optics->reach;
    u->fresnel = optics->fresnel;
    u->steps = optics->steps;
    u->surface_steps = 96;
    u->bent = lom_water_models[scene->quality.water].bends;
    u->marched = lom_water_models[scene->quality.water].form == LOM_SURFACE_RAYS;
    set_medium(&u->medium, scene);
}

static double farther(double square, lom_vec3 eye, const lom_box *box)
{
    const double low[3] = { box->low.x - eye.x, box->low.y - eye.y, box->low.z - eye.z };
    const double high[3] = { box->high.x - eye.x, box->high.y - eye.y, box->high.z - eye.z };
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += low[i] * low[i] > high[i] * high[i] ? low[i] * low[i] : high[i] * high[i];
    return sum > square ? sum : square;
}

/* From the eye to the farthest corner of anything that a ray could meet. */
static double find_range(const struct frame *f)
{
    const lom_renderer *r = f->renderer;
    double farthest = 0;
    for (int i = 0; i < r->ground.across * r->ground.down; i++)
        farthest = farther(farthest, f->view.eye, &r->ground.blocks[i].bounds);
    for (size_t i = 0; i < r->entities.count; i++)
        farthest = farther(farthest, f->view.eye, &r->entities.items[i].bounds);
    return lom_double_sqrt(farthest);
}

static void look_at_sea(struct sea *sea, struct frame *f)
{
    struct lom_surface_uniforms *u = &sea->uniforms;
    const lom_water_params *water = &f->scene->water;
    sea->clip_from_offset = lom_clip_from_offset(&f->view.projection, &f->view.view);
    u->clip_from_offset = lom_round_matrix(&sea->clip_from_offset);
    set_optics(u, f->scene);
    u->light = lom_renderer_light(f->renderer, f->view.eye);
    set_sky(&u->sky, f->renderer);
    set_foam(&u->foam, f);
    set_rays(u->ray, &f->view);
    u->waves = f->waves;
    u->side = f->below ? -1 : 1;
    u->eta = (float)(f->below ? f->scene->water.optics.index : 1 / f->scene->water.optics.index);
    u->range = (float)find_range(f);
    u->pixel[0] = 1.0f / (float)f->width;
    u->pixel[1] = 1.0f / (float)f->height;
    u->near_plane = (float)f->camera.near_plane;
    u->pixel_angle = (float)(2 / f->view.projection.m[1][1] / f->height);
    sea->level = water->level - f->view.eye.y;
    for (int i = 0; i < 2; i++) {
        double middle = water->position[i] - (i == 0 ? f->view.eye.x : f->view.eye.z);
        sea->quad[i] = middle - water->size[i] / 2;
        sea->quad[2 + i] = middle + water->size[i] / 2;
    }
    for (int i = 0; i < 4; i++)
        u->quad[i] = (float)sea->quad[i];
}

/* ---- where it may be seen ---- */

static lom_box slab(const struct sea *sea, bool flat)
{
    const struct lom_waves_uniform *waves = &sea->uniforms.waves;
    double low = sea->level + (flat ? 0 : (double)waves->lowest);
    double high = sea->level + (flat ? 0 : (double)waves->highest);
    double out = flat ? 0 : (double)waves->reach;
    return (lom_box){ { sea->quad[0] - out, low, sea->quad[1] - out },
                      { sea->quad[2] + out, high, sea->quad[3] + out } };
}

static bool draw_bounds(struct sea *sea, lom_device *device, const lom_box *box)
{
    static const uint32_t faces[36] = { 0, 1, 2, 2, 1, 3, 4, 6, 5, 5, 6, 7, 0, 4, 1, 1, 4, 5,
                                        2, 3, 6, 6, 3, 7, 0, 2, 4, 4, 2, 6, 1, 5, 3, 3, 5, 7 };
    float corners[8][3];
    for (int i = 0; i < 8; i++) {
        corners[i][0] = (float)(i & 1 ? box->high.x : box->low.x);
        corners[i][1] = (float)(i & 4 ? box->high.y : box->low.y);
        corners[i][2] = (float)(i & 2 ? box->high.z : box->low.z);
    }
    /* The pass ends before the corners do. */
    lom_draw(device, &(lom_draw_desc){ .shader = &lom_surface_bounds_shader,
                                       .uniforms = &sea->uniforms,
                                       .attribute = { { corners, sizeof corners, 12, LOM_ATTRIBUTE_FLOAT3 } },
                                       .indices = faces,
                                       .count = 36,
                                       .depth_write_off = true });
    return lom_end_pass(device);
}

/* A point of the surface that is seen lies in the slab of its waves, whose faces are before it: where no face passes
 * the depth test, no water is seen. An eye in the slab may see it anywhere. */
static bool draw_visibility(struct sea *sea, struct frame *f, bool flat, lom_error *error)
{
    lom_renderer *r = f->renderer;
    lom_box box = slab(sea, flat);
    double margin = 2.1 * f->camera.near_plane;
    if (!flat && box.low.y < margin && box.high.y > -margin) {
        lom_add_step(f, "visibility", false, "the eye is among the waves: they may be anywhere");
        f->water = f->crop;
        return true;
    }
    lom_step *step = lom_add_step(f, "visibility", true, "which pixels may show the water's surface%s",
                                  f->known != LOM_WAVES_BOUNDED ? "" : ", however high its waves");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_pass_desc pass = lom_frame_pass(f, r->targets.mask);
    pass.depth_load = LOM_LOAD_KEEP;
    lom_begin_pass(r->device, &pass);
    return draw_bounds(sea, r->device, &box) && lom_find_water(f, error);
}

/* ---- pictures of the scene ---- */

static const float nothing[4] = { 0, 0, 0, 0 };

static lom_rect lookups(const struct frame *f, const struct lom_window *window, const lom_texture *picture)
{
    lom_rect r = lom_water_reach(f, window, f->scene->water.optics.reach, lom_texture_width(picture),
                                 lom_texture_height(picture));
    /* Levels of detail: a lookup reads texels up to two of the coarsest level away. */
    int more = 3 << LOM_BLUR_LEVELS, x1 = r.x + r.width + more, y1 = r.y + r.height + more;
    r.x = r.x > more ? r.x - more : 0;
    r.y = r.y > more ? r.y - more : 0;
    r.width = (x1 < lom_texture_width(picture) ? x1 : lom_texture_width(picture)) - r.x;
    r.height = (y1 < lom_texture_height(picture) ? y1 : lom_texture_height(picture)) - r.y;
    return r;
}

/* The picture's matrix, and where it has the frame's pixels. */
static void set_picture(struct lom_picture_uniform *out, const struct frame *f, const struct lom_window *window,
                        const lom_mat4 *clip_from_offset, lom_texture *color, lom_texture *depth)
{
    double width = window->high[0] - window->low[0], height = window->high[1] - window->low[1];
    out->clip_from_offset = lom_round_matrix(clip_from_offset);
    out->color = color;
    out->depth = depth;
    out->scale[0] = (float)(2 / (width * f->width));
    out->scale[1] = (float)(2 / (height * f->height));
    out->shift[0] = (float)((-1 - window->low[0]) / width);
    out->shift[1] = (float)((window->high[1] - 1) / height);
}

/* Clip coordinates in which the window is what -1..1 was. */
static lom_mat4 zoom_to(const struct lom_window *window, const lom_mat4 *projection)
{
    lom_mat4 zoom = lom_identity();
    for (int i = 0; i < 2; i++) {
        zoom.m[i][i] = 2 / (window->high[i] - window->low[i]);
        zoom.m[i][3] = -(window->high[i] + window->low[i]) / (window->high[i] - window->low[i]);
    }
    return lom_multiply(&zoom, projection);
}

/* The ray at (x, y) in normalised device coordinates, bent at still water: where the picture would have to show it.
 * False where it does not meet the surface, or does not pass. */
static bool bend_ray(const struct sea *sea, const struct frame *f, double x, double y, double out[2])
{
    const float(*r)[3] = sea->uniforms.ray;
    double d[3], side = f->below ? -1 : 1, eta = (double)sea->uniforms.eta;
    for (int i = 0; i < 3; i++)
        d[i] = (double)r[i][0] * x + (double)r[i][1] * y + (double)r[i][2];
    double size = lom_double_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), c = -side * d[1] / size;
    double square = 1 - eta * eta * (1 - c * c);
    if (c <= 0 || square <= 0)
        return false;
    double bent[3] = { eta * d[0] / size, -side * lom_double_sqrt(square), eta * d[2] / size }, view[3] = { 0, 0, 0 };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            view[i] += f->view.view.m[i][k] * bent[k];
    double w = -view[2] > 0.1 ? -view[2] : 0.1;
    out[0] = view[0] / w * f->view.projection.m[0][0];
    out[1] = view[1] / w * f->view.projection.m[1][1];
    return true;
}

/* What the picture behind the surface has to show: all that rays of the view, bent at still water, can see, and a
 * margin for waves; of the view itself what is not above the horizon. A function of the whole frame's camera. */
static struct lom_window bent_window(const struct sea *sea, const struct frame *f)
{
    struct lom_window window = lom_whole_view;
    double top = -1, bent[2];
    if (!sea->uniforms.bent && !f->below)
        return window;
    for (int i = 0; i <= 64; i++) {
        double x = i % 8 / 3.5 - 1, y = i / 8 / 4.0 - 1;
        if (!bend_ray(sea, f, x, y, bent))
            continue;
        top = y > top ? y : top;
        for (int k = 0; k < 2; k++) {
            double margin = 0.12 * (bent[k] < 0 ? -1 : 1), at = bent[k] + margin;
            at = at < -3 ? -3 : at > 3 ? 3 : at;
            window.low[k] = at < window.low[k] ? at : window.low[k];
            window.high[k] = at > window.high[k] ? at : window.high[k];
        }
    }
    if (!f->below && window.high[1] <= 1 && top + 0.5 < 1) /* rows of rays are a quarter apart */
        window.high[1] = top + 0.5;
    return window;
}

/* The scene on the eye's side (above: 1, below: -1), less the clip offset. */
static void clip_at(struct lom_scene_view *view, const struct frame *f, double side, double over)
{
    view->plane[0] = view->plane[2] = 0;
    view->plane[1] = side;
    view->plane[3] = -side * f->scene->water.level + over + f->scene->water.clip_offset;
    view->sky = false;
}

static bool draw_mirrored(struct sea *sea, struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    struct lom_scene_view view = f->view;
    lom_mat4 mirror = lom_mirror((lom_vec3){ 0, 1, 0 }, f->scene->water.level);
    view.view = lom_multiply(&f->view.view, &mirror);
    view.eye.y = 2 * f->scene->water.level - f->view.eye.y;
    view.mirrored = true;
    clip_at(&view, f, f->below ? -1 : 1, 0);
    if (!lom_shows_scene(r, &view)) {
        lom_add_step(f, "reflection", false, "nothing but %s is reflected", f->below ? "water" : "the sky");
        return true;
    }
    lom_step *step =
        lom_add_step(f, "reflection", true, "terrain and entities on the eye's side, mirrored in the level");
    lom_mat4 mirrored = lom_mirror((lom_vec3){ 0, 1, 0 }, sea->level),
             clip = lom_multiply(&sea->clip_from_offset, &mirrored);
    set_picture(&sea->uniforms.mirrored, f, &lom_whole_view, &clip, r->targets.reflection, r->targets.reflection_depth);
    return lom_draw_picture(f, step, r->targets.reflection, r->targets.reflection_depth, &view, nothing,
                            lookups(f, &lom_whole_view, r->targets.reflection), error);
}

static bool draw_behind(struct sea *sea, struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    struct lom_scene_view view = f->view;
    const struct lom_waves_uniform *waves = &sea->uniforms.waves;
    struct lom_window window = bent_window(sea, f);
    view.projection = zoom_to(&window, &f->view.projection);
    clip_at(&view, f, f->below ? 1 : -1, f->below ? -(double)waves->lowest : (double)waves->highest);
    if (!lom_shows_scene(r, &view)) {
        lom_add_step(f, "refraction", false, "nothing but %s is behind the surface", f->below ? "the sky" : "water");
        return true;
    }
    lom_step *step = lom_add_step(f, "refraction", true, "terrain and entities behind the surface, with their depth");
    lom_mat4 clip = lom_clip_from_offset(&view.projection, &view.view);
    set_picture(&sea->uniforms.behind, f, &window, &clip, r->targets.refraction, r->targets.refraction_depth);
    return lom_draw_picture(f, step, r->targets.refraction, r->targets.refraction_depth, &view, nothing,
                            lookups(f, &window, r->targets.refraction), error);
}

/* ---- the surface ---- */

static bool fill_mesh(struct sea *sea, struct frame *f, lom_error *error)
{
    struct lom_surface_uniforms *u = &sea->uniforms;
    struct lom_polar_mesh *mesh = &f->renderer->water.polar;
    struct lom_polar_mesh_desc desc = { .projection = f->view.projection,
                                        .view = f->view.view,
                                        .level = sea->level,
                                        .near_plane = f->camera.near_plane,
                                        .lowest = (double)u->waves.lowest,
                                        .highest = (double)u->waves.highest,
                                        .reach = (double)u->waves.reach,
                                        .quad = { sea->quad[0], sea->quad[1], sea->quad[2], sea->quad[3] },
                                        .cell = f->scene->water.waves.cell,
                                        .pixel_angle = (double)u->pixel_angle };
    if (!lom_fill_polar_mesh(mesh, &desc, error))
        return false;
    u->mesh =
        (struct lom_polar_mesh_uniform){ mesh->radius, mesh->spacing, mesh->cosine,
                                         mesh->sine,   mesh->columns, { (float)mesh->apex[0], (float)mesh->apex[1] } };
    return true;
}

static bool draw_surface(struct sea *sea, struct frame *f, lom_error *error)
{
    lom_renderer *r = f->renderer;
    const struct lom_water_model_row *model = &lom_water_models[f->scene->quality.water];
    lom_draw_desc draw = { .shader = model->shader, .uniforms = &sea->uniforms };
    switch (model->form) {
    case LOM_SURFACE_QUAD:
        draw.count = 4;
        draw.topology = LOM_TRIANGLE_STRIP;
        break;
    case LOM_SURFACE_MESH:
        if (!fill_mesh(sea, f, error))
            return false;
        draw.indices = r->water.polar.indices;
        draw.count = r->water.polar.index_count;
        draw.vertex_count = (size_t)r->water.polar.rings * (size_t)r->water.polar.columns;
        break;
    case LOM_SURFACE_RAYS:
        draw.count = 3;
        break;
    }
    lom_begin_water(f, model->text);
    lom_draw(r->device, &draw);
    return lom_end_pass(r->device);
}

/* ---- the water between the eye and everything ---- */

static bool draw_underwater(const struct sea *sea, struct frame *f)
{
    lom_renderer *r = f->renderer;
    const struct lom_surface_uniforms *u = &sea->uniforms;
    struct lom_underwater_uniforms under = { .medium = u->medium,
                                             .pixel = { u->pixel[0], u->pixel[1] },
                                             .near_plane = u->near_plane,
                                             .depth = r->targets.depth,
                                             .origin = { (float)f->crop.x, (float)f->crop.y },
                                             .crop_pixel = { 1.0f / (float)f->crop.width,
                                                             1.0f / (float)f->crop.height },
                                             .depth_of_eye = (float)sea->level,
                                             .highest = u->waves.highest,
                                             .multiplies = true };
    memcpy(under.ray, u->ray, sizeof under.ray);
    lom_step *step = lom_add_step(f, "underwater", true, "the water between the eye and all that is drawn");
    step->width = f->crop.width;
    step->height = f->crop.height;
    lom_pass_desc pass = lom_frame_pass(f, r->targets.color);
    pass.depth = NULL;
    pass.color_load[0] = LOM_LOAD_KEEP;
    lom_draw_desc draw = { .shader = &lom_underwater_shader, .uniforms = &under, .count = 3 };
    draw.blend[0] =
        (lom_blend){ .enabled = true, .target_color = LOM_FACTOR_SOURCE_COLOR, .target_alpha = LOM_FACTOR_ONE };
    lom_begin_pass(r->device, &pass);
    lom_draw(r->device, &draw);
    under.multiplies = false;
    draw.blend[0].source_color = draw.blend[0].target_color = LOM_FACTOR_ONE;
    lom_draw(r->device, &draw);
    return lom_end_pass(r->device);
}

/* Where the water may be seen, f->water; why not, when it is nowhere. */
static bool find_seen(struct sea *sea, struct frame *f, const char **why, lom_error *error)
{
    bool flat = lom_water_models[f->scene->quality.water].form == LOM_SURFACE_QUAD;
    lom_box box = slab(sea, flat);
    lom_frustum frustum = lom_view_frustum(&sea->clip_from_offset, false);
    f->water = (lom_rect){ 0, 0, 0, 0 };
    *why = "the water is outside the view";
    if (lom_box_visibility(&frustum, box) == LOM_OUTSIDE)
        return true;
    *why = "the scene hides all of the water";
    if (!draw_visibility(sea, f, flat, error))
        return false;
    if (f->water.width != 0)
        *why = NULL;
    return true;
}

/* First with the bounds of a sea that has no places: its slab holds that of the actual waves, so where no face of the
 * one is seen, none of the other is. */
static bool find_waves(struct sea *sea, struct frame *f, const char **why, lom_error *error)
{
    if (!find_seen(sea, f, why, error))
        return false;
    if (*why == NULL && f->known == LOM_WAVES_BOUNDED) {
        if (!lom_place_frame_waves(f, error))
            return false;
        sea->uniforms.waves = f->waves;
        if (!find_seen(sea, f, why, error))
            return false;
    }
    if (*why != NULL && f->known != LOM_WAVES_FILLED)
        lom_report_frame_waves(f, LOM_WAVES_AT_FILLING, *why);
    return *why != NULL || f->known == LOM_WAVES_FILLED || lom_fill_frame_waves(f, error);
}

bool lom_find_sea_stage(struct frame *f, lom_error *error)
{
    struct sea sea;
    const char *why;
    if (!lom_has_waves(f))
        return true;
    memset(&sea, 0, sizeof sea);
    look_at_sea(&sea, f);
    if (!find_waves(&sea, f, &why, error))
        return false;
    lom_report_frame_waves(f, LOM_WAVES_AT_DRAWING, why);
    return why == NULL || lom_skip_water(f, why);
}

static bool draw_seen(struct sea *sea, struct frame *f, lom_error *error)
{
    if (!f->below && !lom_draw_caustics(f, error))
        return false;
    return draw_mirrored(sea, f, error) && draw_behind(sea, f, error) && draw_surface(sea, f, error);
}

bool lom_draw_sea_stage(struct frame *f, lom_error *error)
{
    struct sea sea;
    if (!lom_has_waves(f))
        return true;
    memset(&sea, 0, sizeof sea);
    look_at_sea(&sea, f);
    if (f->water.width != 0 && !draw_seen(&sea, f, error))
        return false;
    return !f->below || draw_underwater(&sea, f);
}
