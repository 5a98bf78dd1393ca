/* Workloads: their table and what each needs. In: a name and a size; out: meshes, textures and targets, ready to be
 * drawn any number of times. Invariant: nothing here depends on a device, so that every device draws the same data. */
#include "pipeline/check_device.h"
#include "base/pass_error.h"
#include "workload.h"

#include "peer_pictures.h"

#include <string.h>

static const lom_workload_view torus_view = {
    .eye = { 0, 1.6f, 2.2f }, .light = { 0.5f, 0.7f, 0.3f }, .near_plane = 0.5f, .far_plane = 10
};
static const lom_workload_view lake_view = { .eye = { -30, 7, 35 },
                                             .target = { -20, 0, 10 },
                                             .light = { 0.35f, 0.5f, -0.6f },
                                             .near_plane = 0.5f,
                                             .far_plane = 200 };
static const lom_workload_view boxes_view = {
    .eye = { 0, 0, 50 }, .light = { 0, 1, 0 }, .near_plane = 0.5f, .far_plane = 200
};
static const lom_workload_view cloud_view = { .eye = { 0.25f, 0.15f, 1.05f },
                                              .target = { 0, 0.02f, 0 },
                                              .light = { 0.5f, 0.7f, 0.3f },
                                              .near_plane = 0.05f,
                                              .far_plane = 10 };

static const lom_workload_kind kinds[] = {
    { .name = "clear", .summary = "one colour and one depth", .draw = lom_draw_clear },
    { .name = "fill", .summary = "8 opaque layers over the whole window", .draw = lom_draw_fill },
    { .name = "blend", .summary = "8 translucent layers over the whole window", .draw = lom_draw_blend },
    { .name = "depth",
      .summary = "a torus of 200 000 triangles, depth only",
      .draw = lom_draw_depth,
      .view = &torus_view,
      .needs = LOM_NEEDS_TORUS,
      .show_depth = true },
    { .name = "mesh",
      .summary = "a torus of 200 000 triangles, lit at each pixel",
      .draw = lom_draw_mesh,
      .view = &torus_view,
      .needs = LOM_NEEDS_TORUS },
    { .name = "terrain",
      .summary = "522 242 triangles with colour and normal textures, and a sky",
      .draw = lom_draw_terrain,
      .view = &lake_view,
      .needs = LOM_NEEDS_GROUND | LOM_NEEDS_CUBE },
    { .name = "water",
      .summary = "the terrain three times, and a lake that reflects and refracts it",
      .draw = lom_draw_water,
      .view = &lake_view,
      .needs = LOM_NEEDS_GROUND | LOM_NEEDS_CUBE | LOM_NEEDS_LAKE },
    { .name = "water-skip",
      .summary = "the same picture, of which nothing is shaded twice that the first pass shows",
      .draw = lom_draw_water_once,
      .view = &lake_view,
      .needs = LOM_NEEDS_GROUND | LOM_NEEDS_CUBE | LOM_NEEDS_LAKE },
    { .name = "cloud",
      .summary = "100 steps through a volume, every one taken",
      .draw = lom_draw_cloud,
      .view = &cloud_view,
      .needs = LOM_NEEDS_CUBE | LOM_NEEDS_CLOUD },
    { .name = "cloud-skip",
      .summary = "the same picture with empty space skipped",
      .draw = lom_draw_cloud,
      .view = &cloud_view,
      .needs = LOM_NEEDS_CUBE | LOM_NEEDS_CLOUD,
      .skip = true },
    { .name = "sprites",
      .summary = "2000 textured, blended quads of 64 pixels a side, in random order",
      .draw = lom_draw_sprites,
      .scatter = lom_peer_sprites,
      .card = lom_peer_blob },
    { .name = "foliage",
      .summary = "20 000 textured cards with holes, tested by depth",
      .draw = lom_draw_foliage,
      .view = &lake_view,
      .scatter = lom_peer_cards,
      .card = lom_peer_leaf },
    { .name = "gradients",
      .summary = "three layers of triangles of some 200 pixels, colours and depths at random",
      .draw = lom_draw_gradients,
      .scatter = lom_peer_gradients },
    { .name = "draws",
      .summary = "5000 draws of 12 triangles",
      .draw = lom_draw_boxes,
      .view = &boxes_view,
      .needs = LOM_NEEDS_CUBE | LOM_NEEDS_BOXES },
    { .name = "textured",
      .summary = "8 translucent textured layers over the whole window, at eight scales",
      .draw = lom_draw_textured,
      .needs = LOM_NEEDS_ALBEDO },
    { .name = "fft256",
      .summary = "a complex Fourier transform of 256 x 256",
      .draw = lom_draw_fft,
      .task = &lom_fft_task,
      .size = 256 },
    { .name = "fft512",
      .summary = "a complex Fourier transform of 512 x 512",
      .draw = lom_draw_fft,
      .task = &lom_fft_task,
      .size = 512 },
    { .name = "fft1024",
      .summary = "a complex Fourier transform of 1024 x 1024",
      .draw = lom_draw_fft,
      .task = &lom_fft_task,
      .size = 1024 },
    { .name = "light-grid",
      .summary = "a grid of light of 128^3 swept from a sun in the east, on one thread",
      .draw = lom_draw_light,
      .task = &lom_light_task,
      .size = 128 },
};
enum { KIND_COUNT = sizeof kinds / sizeof kinds[0], MAX_SIZE = 16384 };

int lom_workload_count(void)
{
    return KIND_COUNT;
}

const char *lom_workload_name(int index)
{
    return index >= 0 && index < KIND_COUNT ? kinds[index].name : NULL;
}

const char *lom_workload_summary(int index)
{
    return index >= 0 && index < KIND_COUNT ? kinds[index].summary : NULL;
}

static const lom_workload_kind *find_kind(const char *name, lom_error *error)
{
    const char *names[KIND_COUNT];
    for (int i = 0; i < KIND_COUNT; i++) {
        names[i] = kinds[i].name;
        if (strcmp(name, kinds[i].name) == 0)
            return &kinds[i];
    }
    const char *near = lom_nearest_name(name, strlen(name), names, KIND_COUNT);
    if (near != NULL)
        lom_fail(error, LOM_ERROR_USAGE, "There is no workload \"%s\" (did you mean \"%s\"?).", name, near);
    else
        lom_fail(error, LOM_ERROR_USAGE, "There is no workload \"%s\".", name);
    return NULL;
}

/* A texture with all its levels, repeated; takes the image. */
static lom_texture *tile_texture(const lom_workload *w, lom_image *image, lom_error *error)
{
    if (image == NULL)
        return NULL;
    lom_texture_desc desc = { .width = image->width,
                              .height = image->height,
                              .format = image->format,
                              .pixels = image->pixels,
                              .mips = LOM_MIPS_ALL,
                              .sampler = { .filtering = w->filtering } };
    lom_texture *texture = lom_create_texture(&desc, error);
    lom_free_image(image);
    return texture;
}

static lom_texture *sky_texture(const lom_workload *w, lom_error *error)
{
    lom_image *image = lom_peer_sky(error);
    if (image == NULL)
        return NULL;
    lom_texture_desc desc = { .kind = LOM_TEXTURE_CUBE,
                              .width = image->width,
                              .height = image->height,
                              .format = LOM_FORMAT_RGBA8,
                              .pixels = image->pixels,
                              .sampler = { .filtering = w->filtering } };
    lom_texture *texture = lom_create_texture(&desc, error);
    lom_free_image(image);
    return texture;
}

static bool make_albedo(lom_workload *w, lom_error *error)
{
    w->albedo = tile_texture(w, lom_peer_albedo(error), error);
    return w->albedo != NULL;
}

static bool make_ground(lom_workload *w, lom_error *error)
{
    if (!make_albedo(w, error))
        return false;
    w->normals = tile_texture(w, lom_peer_normals(512, 16, 21, 12, error), error);
    w->sky = sky_texture(w, error);
    return w->normals != NULL && w->sky != NULL && lom_peer_terrain(&w->terrain, error);
}

static bool make_lake(lom_workload *w, lom_error *error)
{
    w->dudv = tile_texture(w, lom_peer_dudv(error), error);
    w->ripples = tile_texture(w, lom_peer_normals(512, 16, 31, 12, error), error);
    return w->dudv != NULL && w->ripples != NULL && lom_peer_water(&w->water, error);
}

static bool make_cloud(lom_workload *w, lom_error *error)
{
    lom_image *image = lom_peer_cloud(error);
    w->cloud = image != NULL ? lom_create_volume(image, error) : NULL;
    lom_free_image(image);
    return w->cloud != NULL;
}

static bool make_scattered(lom_workload *w, lom_error *error)
{
    if (w->kind->scatter != NULL && !w->kind->scatter(&w->scattered, w->width, w->height, error))
        return false;
    if (w->kind->card == NULL)
        return true;
    w->card = tile_texture(w, w->kind->card(error), error);
    return w->card != NULL;
}

static bool make_boxes(lom_workload *w, lom_error *error)
{
    w->boxes = lom_allocate(LOM_PEER_BOXES, sizeof *w->boxes, error);
    for (int i = 0; w->boxes != NULL && i < LOM_PEER_BOXES; i++)
        w->boxes[i] = lom_peer_box_at(i);
    return w->boxes != NULL;
}

static bool make_target(lom_workload *w, int target, lom_error *error)
{
    lom_texture_desc color = { .width = w->width,
                               .height = w->height,
                               .format = LOM_FORMAT_RGBA8,
                               .sampler = {
                                   .wrap_s = LOM_WRAP_CLAMP, .wrap_t = LOM_WRAP_CLAMP, .filtering = w->filtering } };
    lom_texture_desc depth = color;
    depth.format = LOM_FORMAT_DEPTH24;
    depth.sampler.minify = LOM_FILTER_NEAREST;
    depth.sampler.magnify = LOM_FILTER_NEAREST;
    w->color[target] = lom_create_texture(&color, error);
    w->depth[target] = w->color[target] != NULL ? lom_create_texture(&depth, error) : NULL;
    return w->depth[target] != NULL;
}

static bool make_torus(lom_workload *w, lom_error *error)
{
    return lom_peer_torus(&w->torus, error);
}

static bool make_cube(lom_workload *w, lom_error *error)
{
    return lom_peer_cube(&w->cube, error);
}

static bool make_all(lom_workload *w, lom_error *error)
{
    if (w->kind->task != NULL)
        return w->kind->task->make(w, error);
    unsigned needs = w->kind->needs;
    int targets = needs & LOM_NEEDS_LAKE ? LOM_TARGETS : 1;
    for (int i = 0; i < targets; i++)
        if (!make_target(w, i, error))
            return false;
    static const struct {
        unsigned need;
        bool (*make)(lom_workload *workload, lom_error *error);
    } makers[] = { { LOM_NEEDS_TORUS, make_torus },  { LOM_NEEDS_CUBE, make_cube },   { LOM_NEEDS_GROUND, make_ground },
                   { LOM_NEEDS_LAKE, make_lake },    { LOM_NEEDS_CLOUD, make_cloud }, { LOM_NEEDS_BOXES, make_boxes },
                   { LOM_NEEDS_ALBEDO, make_albedo } };
    for (size_t i = 0; i < sizeof makers / sizeof makers[0]; i++)
        if ((needs & makers[i].need) != 0 && !makers[i].make(w, error))
            return false;
    return make_scattered(w, error);
}

static void set_view(lom_workload *w)
{
    const lom_workload_view *view = w->kind->view;
    if (view == NULL)
        return;
    const float *l = view->light;
    float length = __builtin_sqrtf(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
    for (int k = 0; k < 3; k++)
        w->light[k] = l[k] / length;
    w->to_clip = lom_peer_view(view->eye, view->target, 60, (float)w->width / (float)w->height, view->near_plane,
                               view->far_plane);
    w->mirrored_to_clip = lom_peer_mirror(&w->to_clip);
}

lom_workload *lom_create_workload(const char *name, int width, int height, lom_filtering filtering, lom_filtering march,
                                  lom_error *error)
{
    const lom_workload_kind *kind = find_kind(name, error);
    if (kind == NULL)
        return NULL;
    if (width < 1 || height < 1 || width > MAX_SIZE || height > MAX_SIZE) {
        lom_fail(error, LOM_ERROR_USAGE, "A workload of %d x %d pixels is not within 1..%d a side.", width, height,
                 MAX_SIZE);
        return NULL;
    }
    lom_workload *w = lom_allocate(1, sizeof *w, error);
    if (w == NULL)
        return NULL;
    w->kind = kind;
    w->filtering = filtering;
    w->march = march;
    w->width = kind->task != NULL ? kind->size : width;
    w->height = kind->task != NULL ? kind->size : height;
    set_view(w);
    if (!make_all(w, error)) {
        lom_free_workload(w);
        return NULL;
    }
    return w;
}

void lom_free_workload(lom_workload *w)
{
    if (w == NULL)
        return;
    lom_texture *const textures[] = { w->albedo, w->normals, w->sky, w->dudv, w->ripples, w->card };
    for (size_t i = 0; i < sizeof textures / sizeof textures[0]; i++)
        lom_free_texture(textures[i]);
    for (int i = 0; i < LOM_TARGETS; i++) {
        lom_free_texture(w->color[i]);
        lom_free_texture(w->depth[i]);
    }
    lom_peer_free_mesh(&w->torus);
    lom_peer_free_mesh(&w->cube);
    lom_peer_free_mesh(&w->terrain);
    lom_peer_free_mesh(&w->water);
    lom_peer_free_mesh(&w->scattered);
    lom_release(w->boxes);
    lom_free_volume(w->cloud);
    lom_free_fft(w->fft);
    lom_free_light_grid(w->grid);
    for (int i = 0; i < 2; i++) {
        lom_release(w->numbers[i]);
        lom_release(w->plane[i]);
    }
    lom_release(w);
}

void lom_set_workload_samples(lom_workload *workload, int samples)
{
    workload->samples = samples;
}

bool lom_prepare_workload(lom_workload *workload, lom_device *device, lom_error *error)
{
    const lom_workload_task *task = workload->kind->task;
    return lom_check_device(device, error) &&
           (task == NULL || task->prepare == NULL || task->prepare(workload, device, error));
}

bool lom_draw_prepared(lom_workload *workload, lom_device *device, lom_error *error)
{
    workload->kind->draw(workload, device);
    return lom_pass_error(&workload->error, error) && lom_check_device(device, error);
}

bool lom_draw_workload(lom_workload *workload, lom_device *device, lom_error *error)
{
    return lom_prepare_workload(workload, device, error) && lom_draw_prepared(workload, device, error);
}

lom_image *lom_workload_picture(lom_workload *workload, lom_device *device, lom_error *error)
{
    if (workload->kind->task != NULL)
        return workload->kind->task->picture(workload, error);
    if (workload->kind->show_depth)
        lom_show_depth(workload, device);
    return lom_check_device(device, error) ? lom_read_texture(workload->color[LOM_MAIN], 0, 0, error) : NULL;
}
