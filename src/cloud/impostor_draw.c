/* Plates as draws. In: a cloud, a plate, textures. Out: the plate's picture; the plate in a frame. Invariant: a plate's
 * picture is a function of the plate and the cloud, whatever frame it is made in; where it is empty it changes nothing.
 */
#include "shading/square.h"
#include "cloud/impostor_draw.h"
#include "cloud/cloud_uniforms.h"

/* The off-axis perspective through the plate's window; reversed depth without end. */
static lom_mat4 plate_projection(const struct lom_plate *plate, double near_plane)
{
    double width = plate->high[0] - plate->low[0], height = plate->high[1] - plate->low[1];
    return (lom_mat4){ { { 2 / width, 0, (plate->high[0] + plate->low[0]) / width, 0 },
                         { 0, 2 / height, (plate->high[1] + plate->low[1]) / height, 0 },
                         { 0, 0, 0, near_plane },
                         { 0, 0, -1, 0 } } };
}

static lom_mat4 plate_view(const struct lom_plate *plate, lom_vec3 eye)
{
    lom_vec3 r = plate->right, u = plate->up, f = plate->forward;
    return (lom_mat4){ { { r.x, r.y, r.z, -lom_vec3_dot(r, eye) },
                         { u.x, u.y, u.z, -lom_vec3_dot(u, eye) },
                         { -f.x, -f.y, -f.z, lom_vec3_dot(f, eye) },
                         { 0, 0, 0, 1 } } };
}

bool lom_draw_plate(lom_device *device, const struct lom_cloud_set *set, const struct lom_placed_cloud *cloud,
                    const struct lom_cloud_view *view, const struct lom_plate *plate, lom_texture *texture)
{
    struct lom_cloud_view own = *view;
    own.eye = lom_vec3_add(cloud->middle, plate->eye);
    own.projection = plate_projection(plate, view->near_plane);
    own.view = plate_view(plate, own.eye);
    own.depth = NULL;
    own.origin_x = own.origin_y = 0;
    own.mirrored = lom_vec3_dot(lom_vec3_cross(plate->right, plate->up), plate->forward) > 0;
    lom_begin_pass(device, &(lom_pass_desc){ .color = { texture }, .label = "plate" });
    lom_draw_placed_cloud(device, set, cloud, &own);
    return lom_end_pass(device);
}

bool lom_magnify_plate(lom_device *device, const lom_texture *from, lom_texture *to)
{
    struct lom_impostor_uniforms u = { .plate = from };
    lom_begin_pass(device, &(lom_pass_desc){ .color = { to }, .label = "magnified plate" });
    lom_draw_square(device, &lom_magnify_shader, &u, &(lom_blend){ .enabled = false });
    return lom_end_pass(device);
}

void lom_show_plate(lom_device *device, const struct lom_placed_cloud *cloud, const struct lom_cloud_view *view,
                    const struct lom_plate *plate, const lom_texture *texture, double misting, int age)
{
    struct lom_impostor_uniforms u = { .plate = texture, .misting = (float)misting, .age = (float)age };
    lom_set_cloud_place(&u.cloud, cloud, view);
    lom_vec3 from_eye = lom_vec3_add(plate->eye, lom_vec3_subtract(cloud->middle, view->eye));
    for (int c = 0; c < 4; c++) {
        double x = plate->distance * (c & 1 ? plate->high[0] : plate->low[0]);
        double y = plate->distance * (c >> 1 ? plate->high[1] : plate->low[1]);
        lom_vec3 p = lom_vec3_add(from_eye, lom_vec3_scale(plate->forward, plate->distance));
        p = lom_vec3_add(p, lom_vec3_add(lom_vec3_scale(plate->right, x), lom_vec3_scale(plate->up, y)));
        u.corner[c][0] = (float)p.x;
        u.corner[c][1] = (float)p.y;
        u.corner[c][2] = (float)p.z;
    }
    lom_draw_square(device, &lom_impostor_shader, &u, &lom_blend_over);
}
