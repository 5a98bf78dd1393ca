/* The pictures of a world. In: paths. Out: images of 8 or 16 bits, red, green, blue and alpha. Invariant: a file is
 * decoded once, unless it was released in between. */
#include "world/materials.h"

#include "base/pass_error.h"
#include "base/reserve.h"

#include <lom/water.h>

#include <stdio.h>
#include <string.h>

static struct lom_world_picture *find(const struct lom_world *world, const char *path)
{
    for (size_t i = 0; path != NULL && i < world->picture_count; i++)
        if (strcmp(world->pictures[i].path, path) == 0)
            return &world->pictures[i];
    return NULL;
}

/* An entry for this path, without its picture. */
static struct lom_world_picture *add(struct lom_world *world, const char *path, lom_error *error)
{
    if (!lom_reserve(&world->pictures, &world->picture_capacity, world->picture_count + 1, sizeof *world->pictures,
                     error))
        return NULL;
    size_t size = strlen(path) + 1;
    char *copy = lom_allocate(size, 1, error);
    if (copy == NULL)
        return NULL;
    world->pictures[world->picture_count] = (struct lom_world_picture){ .path = memcpy(copy, path, size) };
    return &world->pictures[world->picture_count++];
}

/* Keeps an image, converted, under a path; NULL is passed on. The image is freed. */
static struct lom_world_picture *keep(struct lom_world *world, const char *path, lom_image *file, lom_error *error)
{
    if (file != NULL && file->depth > 1) {
        lom_fail(error, LOM_ERROR_INPUT, "%s: this is no single picture, but %d.", path, file->depth);
        lom_free_image(file);
        return NULL;
    }
    bool deep = file != NULL && lom_describe_format(file->format)->bits > 8;
    lom_image *image =
        file == NULL ? NULL : lom_convert_image(file, deep ? LOM_FORMAT_RGBA16 : LOM_FORMAT_RGBA8, error);
    struct lom_world_picture *picture = image == NULL ? NULL : find(world, path);
    if (image != NULL && picture == NULL)
        picture = add(world, path, error);
    lom_free_image(file);
    if (picture == NULL || picture->image != NULL)
        lom_free_image(image);
    else
        picture->image = image;
    return picture;
}

/* The file of a path, or the normals that are made of one. */
static lom_image *read_picture(const struct lom_world *world, const struct lom_world_picture *picture, const char *path,
                               lom_error *error)
{
    if (picture == NULL || picture->heights == 0)
        return lom_take_image(world->files, path, error);
    char *file = lom_allocate(picture->heights + 1, 1, error);
    lom_image *heights = file != NULL ? lom_read_image(memcpy(file, path, picture->heights), error) : NULL;
    lom_image *normals = heights != NULL ? lom_normals_of_heights(heights, picture->bump, error) : NULL;
    lom_free_image(heights);
    lom_release(file);
    return normals;
}

const lom_image *lom_world_picture(struct lom_world *world, const char *path, lom_error *error)
{
    const struct lom_world_picture *picture = find(world, path);
    if (picture == NULL || picture->image == NULL)
        picture = keep(world, path, read_picture(world, picture, path, error), error);
    return picture == NULL ? NULL : picture->image;
}

/* Keeps the normals of a picture of heights under a path of their own. */
static const char *keep_heights(struct lom_world *world, const char *path, float bump, const lom_image *heights,
                                lom_error *error)
{
    const size_t length = strlen(path);
    char *made = lom_allocate(length + 64, 1, error);
    if (made == NULL)
        return NULL;
    snprintf(made, length + 64, "%s, normals of its heights times %.9g", path, (double)bump);
    struct lom_world_picture *picture = find(world, made);
    if (picture == NULL)
        picture = keep(world, made, lom_normals_of_heights(heights, bump, error), error);
    lom_release(made);
    if (picture == NULL)
        return NULL;
    picture->heights = length;
    picture->bump = bump;
    return picture->path;
}

bool lom_keep_world_normals(struct lom_world *world, const char *path, float bump, const char **kept, lom_error *error)
{
    lom_error failed = { .code = LOM_OK };
    lom_image *file = lom_take_image(world->files, path, error);
    if (file == NULL)
        return false;
    const bool grey = lom_is_grey(file, &failed);
    *kept = grey ? keep_heights(world, path, bump, file, error) : NULL;
    lom_free_image(file);
    if (failed.code != LOM_OK)
        return lom_pass_error(&failed, error);
    return grey ? *kept != NULL : lom_keep_world_picture(world, path, kept, error);
}

bool lom_keep_world_picture(struct lom_world *world, const char *path, const char **kept, lom_error *error)
{
    const struct lom_world_picture *picture = find(world, path);
    if (picture == NULL && world->before != NULL && find(world->before, path) != NULL)
        picture = add(world, path, error); /* it could be read before */
    else if (picture == NULL)
        picture = keep(world, path, lom_take_image(world->files, path, error), error);
    *kept = picture == NULL ? NULL : picture->path;
    return picture != NULL;
}

/* Made from the file: its samples may be finer than the picture's. Kept under a name that no file has. */
const lom_image *lom_world_made_flow(struct lom_world *world, const char *normal_map, lom_error *error)
{
    const size_t size = strlen(normal_map) + 32;
    char *name = lom_allocate(size, 1, error);
    if (name == NULL)
        return NULL;
    snprintf(name, size, "%s, its flow map", normal_map);
    const struct lom_world_picture *picture = find(world, name);
    if (picture == NULL || picture->image == NULL) {
        lom_image *normals = lom_take_image(world->files, normal_map, error);
        lom_image *flow = normals == NULL ? NULL : lom_make_flow_map(normals, error);
        bool done = keep(world, normal_map, normals, error) != NULL;
        picture = keep(world, name, flow, error);
        picture = done ? picture : NULL;
    }
    lom_release(name);
    return picture == NULL ? NULL : picture->image;
}

void lom_release_world_picture(struct lom_world *world, const char *path)
{
    struct lom_world_picture *picture = find(world, path);
    if (picture != NULL) {
        lom_free_image(picture->image);
        picture->image = NULL;
    }
}

/* ---- the sky ---- */

/* Face `face`; the first decides the size. */
static bool read_face(lom_image **faces, struct lom_files *files, const char *path, int face, lom_error *error)
{
    lom_image *file = lom_take_image(files, path, error);
    lom_image *image = file == NULL ? NULL : lom_convert_image(file, LOM_FORMAT_RGBA8, error);
    bool done = image != NULL;
    lom_free_image(file);
    if (done && (image->width != image->height || (face > 0 && image->width != (*faces)->width)))
        done = lom_fail(error, LOM_ERROR_INPUT,
                        "%s: the faces of a sky box are squares of one size, and this one is %dx%d.", path,
                        image->width, image->height);
    if (done && face == 0)
        *faces = lom_create_image(image->width, image->height, 6, LOM_FORMAT_RGBA8, error);
    done = done && *faces != NULL;
    if (done)
        memcpy(lom_image_pixel(*faces, 0, 0, face), image->pixels, lom_image_size(image));
    lom_free_image(image);
    return done;
}

static lom_image *read_cube(struct lom_files *files, const char *path, lom_error *error)
{
    lom_image *file = lom_take_image(files, path, error), *faces = NULL;
    if (file != NULL && file->slices != LOM_SLICES_CUBE)
        lom_fail(error, LOM_ERROR_INPUT, "%s: this file holds no cube of six faces.", path);
    else if (file != NULL)
        faces = lom_convert_image(file, LOM_FORMAT_RGBA8, error);
    lom_free_image(file);
    return faces;
}

lom_image *lom_read_sky_faces(const lom_sky_params *sky, struct lom_files *files, lom_error *error)
{
    if (sky->cube != NULL)
        return read_cube(files, sky->cube, error);
    lom_image *faces = NULL;
    bool done = true;
    for (int face = 0; done && face < 6; face++)
        done = read_face(&faces, files, sky->faces[face], face, error);
    if (done)
        return faces;
    lom_free_image(faces);
    return NULL;
}
