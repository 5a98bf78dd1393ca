/* Clouds as draws. In: a set whose light is made, and how a pass looks at it. Out: for each cloud in view the back
 * faces of its box, the farthest cloud first. Invariant: the order is a function of the places alone; ties keep the
 * file's order reversed, so that the first in the file is drawn last. */
#include "shading/square.h"
#include "cloud/cloud_draw.h"
#include "cloud/cloud_layers.h"
#include "cloud/cloud_sprites.h"
#include "cloud/cloud_uniforms.h"

#include "base/counting_sort.h"
#include "base/numbers.h"

/* Radiance of a place that sees all of the sun, in parts of the sun's colour. A surface lit straight on sends its
 * colour, so the sun's irradiance is pi times it, and what is scattered once pi / (4 pi) times the phase function. */
static const double single_share = 0.25;
/* Light that was scattered more than once, in octave k = 1, 2, ... goes everywhere alike, is attenuated by exp(-T / 4^k)
 * and weighs 0.4 / 2^k: fitted to random paths along 2940 rays through five kinds of clouds, thick and thin, at suns from
 * 10 to 75 degrees (docs/trade.md, bench/results/cloud-octaves.md). It has been scattered about 3^k times. */
static const double octave_share = 0.4;
/* What stands for all of it in the model `forward`: the lit side of a thick cumulus is about as bright as fresh snow. */
static const double forward_share = 0.62;
static const int most_steps = 4096;
static const double near_grains = 0.6, far_grains = 2.5; /* of a pixel, between which the finest noise fades */

lom_box lom_cloud_bounds(const struct lom_placed_cloud *cloud)
{
    const double *size = cloud->cloud->size;
    double half[3];
    for (int k = 0; k < 3; k++) {
        half[k] = 0;
        for (int i = 0; i < 3; i++)
            half[k] += (cloud->axes[i][k] < 0 ? -cloud->axes[i][k] : cloud->axes[i][k]) * size[i] / 2;
    }
    lom_vec3 m = cloud->middle;
    return (lom_box){ { m.x - half[0], m.y - half[1], m.z - half[2] },
                      { m.x + half[0], m.y + half[1], m.z + half[2] } };
}

void lom_cloud_corners(const struct lom_placed_cloud *cloud, lom_vec3 corner[8])
{
    for (int c = 0; c < 8; c++) {
        double at[3] = { 0, 0, 0 };
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                at[k] += cloud->axes[i][k] * ((c >> i & 1) - 0.5) * cloud->cloud->size[i];
        corner[c] = (lom_vec3){ at[0], at[1], at[2] };
    }
}

double lom_cloud_nearness(lom_vec3 place, const struct lom_cloud_view *view)
{
    const lom_vec3 away = lom_vec3_subtract(place, view->eye);
    if (view->projection.m[3][2] != 0)
        return away.x * away.x + away.y * away.y + away.z * away.z;
    const double *axis = view->view.m[2];
    return -(axis[0] * away.x + axis[1] * away.y + axis[2] * away.z);
}

static uint32_t order_key(const void *keys, uint32_t number)
{
    return ((const uint32_t *)keys)[number];
}

size_t lom_order_clouds(const struct lom_cloud_set *set, const struct lom_cloud_view *view, bool cull, size_t *order)
{
    lom_mat4 clip_from_world = lom_multiply(&view->projection, &view->view);
    lom_frustum frustum = lom_view_frustum(&clip_from_world, false);
    uint32_t *keys = set->sorting, *numbers = keys + set->count, *scratch = numbers + set->count;
    size_t count = 0;
    for (size_t n = set->count; n-- > 0;) {
        if (cull && lom_box_visibility(&frustum, lom_cloud_bounds(&set->clouds[n])) == LOM_OUTSIDE)
            continue;
        keys[n] = lom_sorting_key((float)lom_cloud_nearness(set->clouds[n].middle, view));
        numbers[count++] = (uint32_t)n;
    }
    lom_sort_by_key(order_key, keys, 4, count, numbers, scratch);
    for (size_t i = 0; i < count; i++)
        order[i] = numbers[i];
    return count;
}

static float step_of(const struct lom_cloud_set *set, const struct lom_placed_cloud *placed)
{
    const double *side = placed->cloud->size;
    const float size[3] = { (float)side[0], (float)side[1], (float)side[2] };
    return lom_medium_step(placed->density->medium, size, (float)set->quality.error);
}

size_t lom_count_capped_clouds(const struct lom_cloud_set *set, int *steps)
{
    size_t count = 0;
    *steps = most_steps;
    if (set->quality.model == LOM_CLOUDS_ORIGINAL || set->quality.model == LOM_CLOUDS_BILLBOARD ||
        set->quality.model == LOM_CLOUDS_LAYERS || lom_has_cloud_sprites(set->quality.model))
        return 0;
    for (size_t i = 0; i < set->count; i++) {
        const double *side = set->clouds[i].cloud->size;
        double diagonal = lom_double_sqrt(side[0] * side[0] + side[1] * side[1] + side[2] * side[2]);
        count += diagonal > (double)step_of(set, &set->clouds[i]) * most_steps;
    }
    return count;
}

/* A pixel of parallel rays covers as many grains at any distance: the fading is that between bounds so far apart that
 * distances make no difference. */
static void fade_detail(lom_medium_desc *march, double grains)
{
    const double far = 1e30, share = (grains - near_grains) / (far_grains - near_grains);
    const double faded = share < 0 ? 0 : share > 1 ? 1 : share;
    march->detail_near = (float)(-faded * far);
    march->detail_far = (float)((1 - faded) * far);
}

static bool has_octaves(int model)
{
    return model == LOM_CLOUDS_OCTAVES || lom_has_cloud_sprites(model);
}

double lom_octave_weight(double albedo, int octave)
{
    double left = albedo, weight = octave_share;
    for (int k = 0; k < octave; k++) {
        left = left * left * left;
        weight *= 0.5;
    }
    return left * (octave > 0 ? weight : single_share);
}

static void set_march(lom_medium_desc *march, const struct lom_cloud_set *set, const struct lom_placed_cloud *placed,
                      const struct lom_cloud_view *view)
{
    const lom_cloud *cloud = placed->cloud;
    const double grain = cloud->detail_size / set->detail->size;
    *march = (lom_medium_desc){ .medium = placed->density->medium,
                                .light = placed->light,
                                .detail = placed->detail > 0 ? set->detail : NULL,
                                .detail_strength = (float)placed->detail,
                                .detail_near = (float)(near_grains * grain / view->pixel_angle),
                                .detail_far = (float)(far_grains * grain / view->pixel_angle),
                                .extinction = (float)(cloud->extinction * cloud->density),
                                .step = step_of(set, placed),
                                .stop = (float)set->quality.stop,
                                .most_steps = most_steps,
                                .octaves = has_octaves(set->quality.model) ? set->quality.octaves : 1,
                                .filtering = set->quality.march };
    if (view->projection.m[3][2] == 0)
        fade_detail(march, view->pixel_angle / grain);
    for (int i = 0; i < 3; i++)
        march->detail_scale[i] = (float)(cloud->size[i] / cloud->detail_size);
    for (int k = 0; k < march->octaves; k++)
        march->weight[k] = (float)lom_octave_weight(set->params->albedo, k);
    if (set->quality.model == LOM_CLOUDS_FORWARD)
        march->weight[0] = (float)(forward_share * set->params->albedo);
}

static void set_light(struct lom_cloud_uniforms *u, const struct lom_cloud_set *set, const struct lom_cloud_view *view)
{
    const lom_clouds *p = set->params;
    const double cube = p->albedo * p->albedo * p->albedo, left = cube * cube; /* of light from all sides, fitted */
    for (int i = 0; i < 3; i++) {
        u->to_light[i] = view->light.to_light[i];
        u->sun[i] = (float)(view->light.color[i] * p->brightness);
        u->sky[i] = (float)(p->sky[i] * left);
        u->ground[i] = (float)(p->ground[i] * left);
        u->haze_color[i] = (float)p->haze_color[i];
    }
    u->phase = p->phase;
    u->forward = (float)p->forward;
    u->backward = (float)p->backward;
    u->blend = (float)p->blend;
    u->silver = (float)p->silver;
    u->silver_cosine = (float)(1 - p->silver_spread);
    u->haze_rate = p->haze_distance > 0 ? (float)(1 / p->haze_distance) : 0;
}

static void set_transfer(struct lom_cloud_uniforms *u, const struct lom_placed_cloud *placed)
{
    lom_transfer_desc *look = &u->transfer;
    *look = (lom_transfer_desc){ .transfer = &placed->transfer, .look = placed->cloud->look };
    for (int i = 0; i < 3; i++) {
        look->sun[i] = u->sun[i]; /* a surface that faces the sun sends all of its colour */
        look->sky[i] = u->sky[i];
        look->ground[i] = u->ground[i];
        look->size[i] = (float)placed->cloud->size[i];
        double along = 0;
        for (int k = 0; k < 3; k++)
            along += placed->axes[i][k] * (double)u->to_light[k];
        look->to_light[i] = (float)along;
    }
}

void lom_set_cloud_place(struct lom_cloud_uniforms *u, const struct lom_placed_cloud *placed,
                         const struct lom_cloud_view *view)
{
    u->eye = lom_find_eye(&view->projection, &view->view, 0);
    u->origin[0] = (float)view->origin_x;
    u->origin[1] = (float)view->origin_y;
    u->depth = view->depth;
    u->is_sliced = view->is_sliced;
    u->slice_from = (float)view->slice_from;
    u->slice_to = (float)view->slice_to;
    u->slice_axis[0] = (float)view->slice_axis.x;
    u->slice_axis[1] = (float)view->slice_axis.y;
    u->slice_axis[2] = (float)view->slice_axis.z;
    const lom_cloud *cloud = placed->cloud;
    const double from_eye[3] = { placed->middle.x - view->eye.x, placed->middle.y - view->eye.y,
                                 placed->middle.z - view->eye.z };
    lom_mat4 move = lom_translation(view->eye), clip = lom_multiply(&view->projection, &view->view);
    clip = lom_multiply(&clip, &move);
    for (int i = 0; i < 4 && u->eye.parallel; i++) /* no far plane cuts a cloud's back, whose depth nobody looks at */
        clip.m[2][i] = i == 3 ? 0.5 : 0;
    u->clip_from_offset = lom_round_matrix(&clip);
    lom_vec3 corner[8];
    lom_cloud_corners(placed, corner);
    for (int c = 0; c < 8; c++) {
        u->corner[c][0] = (float)(from_eye[0] + corner[c].x);
        u->corner[c][1] = (float)(from_eye[1] + corner[c].y);
        u->corner[c][2] = (float)(from_eye[2] + corner[c].z);
    }
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int k = 0; k < 3; k++) {
            sum += placed->axes[i][k] * from_eye[k];
            u->box_axis[i][k] = (float)(placed->axes[i][k] / cloud->size[i]);
        }
        u->eye_in_box[i] = (float)(0.5 - sum / cloud->size[i]);
    }
}

static void set_original(struct lom_cloud_uniforms *u, const struct lom_cloud_set *set,
                         const struct lom_placed_cloud *placed, const struct lom_cloud_view *view)
{
    const double *size = placed->cloud->size;
    double longest = size[0] > size[1] ? size[0] : size[1];
    longest = size[2] > longest ? size[2] : longest;
    u->original = placed->original;
    u->is_fixed = set->quality.march == LOM_FILTERING_FIXED;
    u->unit = (float)(100 / longest); /* the reference's clouds are about 100 of its units across */
    u->is_real_time =
        set->params->original_light == LOM_ORIGINAL_COMBINED || set->params->original_light == LOM_ORIGINAL_REAL_TIME;
    for (int i = 0; i < 3; i++) {
        double along = 0;
        for (int k = 0; k < 3; k++)
            along += placed->axes[i][k] * (double)view->light.to_light[k];
        u->light_in_box[i] = (float)(along / size[i]);
        u->sun[i] = view->light.color[i] < 1 ? view->light.color[i] : 1;
    }
}

/* A square as wide as the box, upright and turned to the eye; corner[0] becomes its middle. */
static void set_picture(struct lom_cloud_uniforms *u, const struct lom_cloud_set *set,
                        const struct lom_placed_cloud *placed, const struct lom_cloud_view *view)
{
    const double *size = placed->cloud->size;
    lom_vec3 away = lom_vec3_subtract(placed->middle, view->eye);
    const lom_view_rays rays = lom_find_view_rays(&view->projection, &view->view);
    const lom_vec3 ray = rays.parallel ? rays.along : away;
    lom_vec3 right = lom_vec3_normalize((lom_vec3){ -ray.z, 0, ray.x });
    double half = lom_double_sqrt(size[0] * size[0] + size[2] * size[2]) / 2.6;
    u->picture = set->picture;
    const double across[3] = { right.x * half, 0, right.z * half }, middle[3] = { away.x, away.y, away.z };
    for (int i = 0; i < 3; i++) {
        u->right[i] = (float)across[i];
        u->up[i] = i == 1 ? (float)(size[1] / 2) : 0;
        u->corner[0][i] = (float)middle[i];
        u->sun[i] = view->light.color[i] < 1 ? view->light.color[i] : 1;
    }
}

static void draw_sprites(lom_device *device, const struct lom_cloud_set *set, const struct lom_placed_cloud *cloud,
                         const struct lom_cloud_view *view, struct lom_cloud_uniforms *u)
{
    const lom_vec3 away = lom_vec3_subtract(cloud->middle, view->eye);
    const double middle[3] = { away.x, away.y, away.z };
    lom_sort_cloud_sprites(cloud->sprites, cloud, view);
    u->picture = set->picture;
    u->sprites = cloud->sprites->drawn;
    u->sprite_depth = cloud->sprites->depth;
    for (int i = 0; i < 3; i++) {
        u->corner[0][i] = (float)middle[i];
        u->right[i] = (float)view->view.m[0][i];
        u->up[i] = (float)view->view.m[1][i];
    }
    if (cloud->sprites->count > 0)
        lom_draw(device, &(lom_draw_desc){ .shader = &lom_cloud_sprite_shader,
                                           .uniforms = u,
                                           .count = 6 * cloud->sprites->count,
                                           .topology = LOM_TRIANGLES,
                                           .vertex_count = 6 * cloud->sprites->count,
                                           .cull = LOM_CULL_NONE,
                                           .depth_test_off = true,
                                           .blend = { lom_blend_over },
                                           .label = "cloud" });
}

/* A level sheet over the box's sides through the middle of the cloud's mass, and the way of the light through half of
 * it, which is longer the lower the sun. */
static void draw_sheet(lom_device *device, const struct lom_cloud_set *set, const struct lom_placed_cloud *placed,
                       const struct lom_cloud_view *view, struct lom_cloud_uniforms *u)
{
    static const double lowest = 0.1, clearest = 0.7; /* sine of the sun's height; detail that leaves holes */
    const lom_cloud *cloud = placed->cloud;
    const lom_vec3 away = lom_vec3_subtract(placed->middle, view->eye);
    const double middle[3] = { away.x, away.y + placed->sheet->height, away.z };
    const double up = lom_magnitude((double)view->light.to_light[1]);
    u->picture = set->picture;
    u->fine = set->fine;
    u->gradient = set->gradient;
    u->shape = placed->sheet->shape;
    u->deepest = placed->sheet->deepest;
    u->eaten = (float)lom_smaller(placed->detail / clearest, 1);
    u->noise_scale[0] = (float)(1 / set->mean_opacity);
    u->noise_scale[1] = (float)(1 / set->mean_fine);
    u->way_of_light = (float)(0.5 / lom_larger(up, lowest));
    for (int i = 0; i < 3; i++) {
        u->corner[0][i] = (float)middle[i];
        u->right[i] = (float)(placed->axes[0][i] * cloud->size[0] / 2);
        u->up[i] = (float)(-placed->axes[2][i] * cloud->size[2] / 2);
    }
    for (int i = 0; i < 2; i++)
        u->fine_repeats[i] = (float)(cloud->size[2 * i] / (2 * cloud->detail_size));
    lom_draw(device, &(lom_draw_desc){ .shader = &lom_cloud_sheet_shader,
                                       .uniforms = u,
                                       .count = 4,
                                       .topology = LOM_TRIANGLE_STRIP,
                                       .vertex_count = 4,
                                       .cull = LOM_CULL_NONE,
                                       .depth_test_off = true,
                                       .blend = { lom_blend_over },
                                       .label = "cloud" });
}

void lom_draw_placed_cloud(lom_device *device, const struct lom_cloud_set *set, const struct lom_placed_cloud *cloud,
                           const struct lom_cloud_view *view)
{
    /* corner c is at (c & 1, c >> 1 & 1, c >> 2); counter-clockwise from outside */
    static const uint16_t faces[36] = { 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6 };
    struct lom_cloud_uniforms u = { .jitter = set->jitter };
    lom_set_cloud_place(&u, cloud, view);
    set_light(&u, set, view);
    set_march(&u.march, set, cloud, view);
    bool is_flat = set->quality.model == LOM_CLOUDS_BILLBOARD, is_original = set->quality.model == LOM_CLOUDS_ORIGINAL;
    bool has_transfer = cloud->transfer.count > 0;
    if (cloud->sheet != NULL) {
        draw_sheet(device, set, cloud, view, &u);
        return;
    }
    if (cloud->sprites != NULL) {
        draw_sprites(device, set, cloud, view, &u);
        return;
    }
    if (has_transfer)
        set_transfer(&u, cloud);
    if (is_original)
        set_original(&u, set, cloud, view);
    if (is_flat)
        set_picture(&u, set, cloud, view);
    lom_draw(device, &(lom_draw_desc){ .shader = is_flat        ? &lom_cloud_picture_shader
                                                 : is_original  ? &lom_cloud_original_shader
                                                 : has_transfer ? &lom_cloud_transfer_shader
                                                                : &lom_cloud_shader,
                                       .uniforms = &u,
                                       .indices = is_flat ? NULL : faces,
                                       .index_bits = 16,
                                       .count = is_flat ? 4 : 36,
                                       .topology = is_flat ? LOM_TRIANGLE_STRIP : LOM_TRIANGLES,
                                       .vertex_count = is_flat ? 4 : 8,
                                       .cull = is_flat ? LOM_CULL_NONE : LOM_CULL_FRONT,
                                       .front_clockwise = view->mirrored,
                                       .depth_test_off = true,
                                       .blend = { lom_blend_over },
                                       .label = "cloud" });
}
