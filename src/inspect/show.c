/* The pictures of passes. In: a renderer that has drawn a frame, a name. Out: what the pass left in its target, as floats.
 * The table below has a row a picture. Invariant: numbers are the targets' own, or those that the stages recorded. */
#include "base/own_float_state.h"
#include "inspect/eyes.h"
#include "inspect/show.h"
#include "pipeline/check_device.h"
#include "render/renderer.h"

#include <stdio.h>
#include <string.h>

typedef lom_image *show(lom_renderer *r, const lom_frame_desc *desc, lom_error *error);

static lom_image *missing(const char *what, lom_error *error)
{
    lom_fail(error, LOM_ERROR_USAGE, "This frame has no %s to show; `lom plan` says which passes it has, and why.",
             what);
    return NULL;
}

/* ---- targets ---- */

static lom_image *read_floats(const lom_texture *texture, lom_format format, const char *what, lom_error *error)
{
    lom_image *image = texture != NULL ? lom_read_texture(texture, 0, 0, error) : missing(what, error);
    lom_image *floats = image != NULL ? lom_convert_image(image, format, error) : NULL;
    lom_free_image(image);
    return floats;
}

/* Of a picture of the drawn part, which is freed, what was asked for. */
static lom_image *take_asked(const lom_renderer *r, lom_image *drawn, lom_error *error)
{
    const lom_rect *asked = &r->targets.asked;
    if (drawn == NULL || (drawn->width == asked->width && drawn->height == asked->height))
        return drawn;
    lom_image *image = lom_create_image(asked->width, asked->height, 1, drawn->format, error);
    const size_t bytes = (size_t)asked->width * lom_format_size(drawn->format);
    for (int y = 0; image != NULL && y < asked->height; y++)
        memcpy(lom_image_pixel(image, 0, y, 0), lom_image_pixel(drawn, asked->x, asked->y + y, 0), bytes);
    lom_free_image(drawn);
    return image;
}

static lom_image *show_picture(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    lom_image *drawn = read_floats(r->targets.of[LOM_TARGET_COLOR], LOM_FORMAT_RGB32F, "picture", error);
    return take_asked(r, drawn, error);
}

static lom_image *show_reflection(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return read_floats(r->targets.of[LOM_TARGET_REFLECTION], LOM_FORMAT_RGB32F, "reflection", error);
}

static lom_image *show_refraction(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return read_floats(r->targets.of[LOM_TARGET_REFRACTION], LOM_FORMAT_RGB32F, "refraction", error);
}

/* Metres along the view axis; a depth of 0 stays 0: nothing is there. */
static lom_image *read_distance(lom_renderer *r, enum lom_target target, const char *what, lom_error *error)
{
    lom_image *image = read_floats(r->targets.of[target], LOM_FORMAT_R32F, what, error);
    float *z = image != NULL ? (float *)(void *)image->pixels : NULL;
    for (size_t i = 0; image != NULL && i < lom_image_size(image) / sizeof *z; i++)
        z[i] = z[i] > 0 ? (float)lom_camera_distance(&r->moment.camera, (double)z[i]) : 0;
    return image;
}

static lom_image *show_depth(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return take_asked(r, read_distance(r, LOM_TARGET_DEPTH, "depth", error), error);
}

static lom_image *show_refraction_depth(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return read_distance(r, LOM_TARGET_REFRACTION_DEPTH, "depth of the refraction", error);
}

static lom_image *show_near_shadow(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return read_floats(r->entities.shadows[0].map, LOM_FORMAT_R32F, "near shadow map", error);
}

static lom_image *show_far_shadow(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return read_floats(r->entities.shadows[1].map, LOM_FORMAT_R32F, "far shadow map", error);
}

static lom_image *show_liquid_shadow(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return read_floats(r->fluids.shadow.map, LOM_FORMAT_RGB32F, "map of the liquids' shadow", error);
}

/* Copies a map of a lamp's face into the square at (column, row). */
static bool place_map(lom_image *image, const lom_texture *map, int column, int row, int size, lom_error *error)
{
    lom_image *face = read_floats(map, LOM_FORMAT_R32F, "shadow map", error);
    for (int y = 0; face != NULL && y < size; y++)
        memcpy(lom_image_pixel(image, column * size, row * size + y, 0), lom_image_pixel(face, 0, y, 0),
               (size_t)size * sizeof(float));
    const bool done = face != NULL;
    lom_free_image(face);
    return done;
}

/* A row of maps a lamp; a face before which nothing stands is black. */
static lom_image *show_lamp_shadows(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    const struct lom_drawn_lamps *lamps = &r->lamps;
    int rows = 0, columns = 0, size = 0;
    for (size_t i = 0; i < lamps->count; i++) {
        const struct lom_lamp_shadow_uniform *shadow = lamps->items[i].shadow;
        rows += shadow != NULL;
        columns = shadow != NULL && shadow->count > columns ? shadow->count : columns;
        for (int k = 0; shadow != NULL && k < shadow->count; k++)
            size = shadow->face[k].map != NULL ? lom_texture_width(shadow->face[k].map) : size;
    }
    if (size == 0)
        return missing("shadow map of a lamp", error);
    lom_image *image = lom_create_image(columns * size, rows * size, 1, LOM_FORMAT_R32F, error);
    bool done = image != NULL;
    for (size_t i = 0, row = 0; done && i < lamps->count; i++) {
        const struct lom_lamp_shadow_uniform *shadow = lamps->items[i].shadow;
        for (int k = 0; done && shadow != NULL && k < shadow->count; k++)
            if (shadow->face[k].map != NULL)
                done = place_map(image, shadow->face[k].map, k, (int)row, size, error);
        row += shadow != NULL;
    }
    if (done)
        return image;
    lom_free_image(image);
    return NULL;
}

static lom_image *show_cloud_shadow(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return read_floats(r->clouds.ground_shadow.texture, LOM_FORMAT_R32F, "cloud shadow", error);
}

static lom_image *show_caustics(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    return read_floats(r->water->caustics, LOM_FORMAT_R32F, "caustics", error);
}

/* ---- grids ---- */

static lom_image *show_heights(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    const struct lom_ground *g = &r->ground;
    if (g->heights == NULL)
        return missing("height field", error);
    lom_image *image = lom_create_image(g->columns + 1, g->rows + 1, 1, LOM_FORMAT_R32F, error);
    if (image != NULL)
        memcpy(image->pixels, g->heights, lom_image_size(image));
    return image;
}

/* The middle slice, seen from the front: x to the right, y up. */
static lom_image *show_light(lom_renderer *r, const lom_frame_desc *desc, lom_error *error)
{
    (void)desc;
    const struct lom_cloud_set *set = r->clouds.set;
    const lom_light_grid *grid = set != NULL && set->count != 0 ? set->clouds[0].light : NULL;
    if (grid == NULL)
        return missing("grid of light", error);
    lom_image *image = lom_create_image(grid->width, grid->height, 1, LOM_FORMAT_R32F, error);
    size_t pitch = (size_t)grid->width + 1, slice = pitch * ((size_t)grid->height + 1);
    for (int y = 0; image != NULL && y < grid->height; y++)
        for (int x = 0; x < grid->width; x++) {
            size_t row = (size_t)(grid->height - 1 - y);
            int32_t word = grid->light[(size_t)(grid->depth / 2) * slice + row * pitch + (size_t)x];
            *(float *)lom_image_pixel(image, x, y, 0) = (float)(word & 0xffff) / 65535.0f;
        }
    return image;
}

/* ---- the table ---- */

static const struct row {
    lom_shown_pass pass;
    show *show;
} rows[] = {
    { { "picture", "the picture, linear light", true }, show_picture },
    { { "reflection", "the mirror of the water, linear light", true }, show_reflection },
    { { "refraction", "what is below or behind the water, linear light", true }, show_refraction },
    { { "refraction-depth", "metres along the view to what is below the water; 0: nothing", false },
      show_refraction_depth },
    { { "depth", "metres along the view to what is seen; 0: nothing", false }, show_depth },
    { { "normals", "unit normals of what is seen, x right, y up, z to the south, in the world; 0: none", false },
      lom_show_normals },
    { { "objects", "1 terrain, 2 water, 3 liquids, 16 and more the entities in the scene's order; 0: none", false },
      lom_show_objects },
    { { "motion", "pixels that what is seen has moved since the frame before, right and down", false },
      lom_show_motion },
    { { "near-shadow", "depth of what casts shadows near the eye, as the sun sees it, 1 next to it", false },
      show_near_shadow },
    { { "far-shadow", "the same of what is farther than the middle", false }, show_far_shadow },
    { { "liquid-shadow", "optical depths of red, green and blue that the sun sees of liquids", false },
      show_liquid_shadow },
    { { "lamp-shadows", "a row of maps a lamp: how near to it something stands, as it sees it; 0: nothing", false },
      show_lamp_shadows },
    { { "cloud-shadow", "the share of the sun that clouds let through", false }, show_cloud_shadow },
    { { "caustics", "the sunlight that waves focus on the bed, in parts of the sun's", false }, show_caustics },
    { { "light-grid", "of the first cloud, exp(-optical depth towards the sun / 64), its middle slice", false },
      show_light },
    { { "heights", "the terrain's heights over its base, metres, one a vertex", false }, show_heights },
};
enum { ROWS = sizeof rows / sizeof rows[0] };

const lom_shown_pass *lom_describe_shown_pass(size_t index)
{
    return index < ROWS ? &rows[index].pass : NULL;
}

static const struct row *find_row(const char *name, lom_error *error)
{
    char names[400] = "";
    for (size_t i = 0; i < ROWS; i++) {
        size_t length = strlen(names);
        if (strcmp(rows[i].pass.name, name) == 0)
            return &rows[i];
        snprintf(names + length, sizeof names - length, "%s%s", i > 0 ? ", " : "", rows[i].pass.name);
    }
    lom_fail(error, LOM_ERROR_USAGE, "There is no pass \"%s\" to show; there are %s.", name, names);
    return NULL;
}

bool lom_check_shown_pass(const char *name, lom_error *error)
{
    return find_row(name, error) != NULL;
}

lom_image *lom_show_pass(lom_renderer *renderer, const lom_frame_desc *desc, const char *name, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    const struct row *row = find_row(name, error);
    if (row != NULL && renderer->reference != NULL)
        return missing("passes: the reference traces it", error);
    return row != NULL ? row->show(renderer, desc, error) : NULL;
}

/* ---- for eyes ---- */

/* -largest .. largest to 0 .. 1. */
static void halve(lom_image *image)
{
    float *value = (float *)(void *)image->pixels, largest = 0;
    size_t count = lom_image_size(image) / sizeof *value;
    for (size_t i = 0; i < count; i++)
        largest = __builtin_fabsf(value[i]) > largest ? __builtin_fabsf(value[i]) : largest;
    for (size_t i = 0; i < count; i++)
        value[i] = 0.5f + (largest > 0 ? value[i] / largest * 0.5f : 0);
}

/* Each number its own colour, 0 black. */
static lom_image *color_objects(const lom_image *image, lom_error *error)
{
    lom_image *colors = lom_create_image(image->width, image->height, 1, LOM_FORMAT_RGB32F, error);
    const float *number = (const float *)(const void *)image->pixels;
    float *to = colors != NULL ? (float *)(void *)colors->pixels : NULL;
    for (size_t i = 0; colors != NULL && i < (size_t)image->width * (size_t)image->height; i++, to += 3) {
        uint64_t hash = lom_hash_bytes(LOM_HASH_START, &number[i], sizeof number[i]);
        for (int c = 0; c < 3; c++)
            to[c] = number[i] == 0 ? 0 : 0.2f + (float)(hash >> (11 + 16 * c) & 255) / 320.0f;
    }
    return colors;
}

lom_image *lom_show_to_eyes(lom_image *raw, const char *name, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (raw == NULL || strstr(name, "depth") != NULL)
        return lom_depth_to_eyes(raw, error);
    bool is_color = false, is_objects = strcmp(name, "objects") == 0;
    for (size_t i = 0; i < ROWS; i++)
        is_color |= rows[i].pass.is_color && strcmp(rows[i].pass.name, name) == 0;
    lom_image *shown = NULL, *colors = is_objects ? color_objects(raw, error) : NULL;
    if (!is_objects && !is_color && raw->format == LOM_FORMAT_R32F)
        lom_stretch_numbers(raw);
    else if (!is_objects && !is_color)
        halve(raw);
    if (!is_objects || colors != NULL)
        shown = lom_convert_image(is_objects ? colors : raw,
                                  is_color                                        ? LOM_FORMAT_RGB8_SRGB
                                  : raw->format == LOM_FORMAT_R32F && !is_objects ? LOM_FORMAT_R16
                                                                                  : LOM_FORMAT_RGB8,
                                  error);
    lom_free_image(colors);
    lom_free_image(raw);
    return shown;
}
