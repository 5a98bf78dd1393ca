/* A lesson's calls of the library, noted and handed on. In: the calls (-Wl,--wrap). Out: the same calls; at the moment
 * that is asked for, the picture so far. Invariant: until then the library is told what the lesson tells it, and
 * besides a label for each pass. */
#include "web/lesson_page.h"

lom_texture *__wrap_lom_make_texture(lom_device *device, const lom_texture_desc *desc);
void __wrap_lom_begin_pass(lom_device *device, const lom_pass_desc *desc);
void __wrap_lom_draw(lom_device *device, const lom_draw_desc *desc);
bool __wrap_lom_end_pass(lom_device *device);
lom_image *__wrap_lom_read_texture(const lom_texture *texture, int level, int layer, lom_error *error);
lom_image *__wrap_lom_create_image(int width, int height, int depth, lom_format format, lom_error *error);
lom_image *__wrap_lom_convert_image(const lom_image *image, lom_format format, lom_error *error);
bool __wrap_lom_write_image(const char *path, const char *kind, const lom_image *image, lom_error *error);

/* The texture that is watched is so from its making on. */
lom_texture *__wrap_lom_make_texture(lom_device *device, const lom_texture_desc *desc)
{
    lom_texture *texture = __real_lom_make_texture(device, desc);
    lom_lesson_run *run = lom_current_lesson();
    if (run == NULL || run->textures == LOM_LESSON_TEXTURES)
        return texture;
    run->device = device;
    const lom_rect *r = &run->watch;
    if (run->textures == run->watched)
        lom_watch(device, &(lom_watch_desc){ texture, r->x, r->y, r->width, r->height, 0 }, 1);
    run->texture[run->textures++] = texture;
    return texture;
}

void __wrap_lom_begin_pass(lom_device *device, const lom_pass_desc *desc)
{
    lom_lesson_run *run = lom_current_lesson();
    lom_pass_desc pass = *desc;
    if (run != NULL) {
        run->target = desc->color[0];
        run->pass_draws = 0;
        char *label = run->label[run->passes % LOM_LESSON_PASSES];
        snprintf(label, sizeof run->label[0], "the lesson's pass %d", run->passes + 1);
        pass.label = desc->label != NULL ? desc->label : label;
    }
    __real_lom_begin_pass(device, &pass);
}

static size_t count_triangles(const lom_draw_desc *desc)
{
    size_t count = desc->topology == LOM_TRIANGLES ? desc->count / 3
                   : desc->topology == LOM_SPRITES ? desc->count
                   : desc->count < 3               ? 0
                                                   : desc->count - 2;
    return count * (size_t)(desc->instances > 0 ? desc->instances : 1);
}

/* The first triangles alone, of one instance in a list; a draw of other kinds is a single step. */
static lom_draw_desc first_triangles(const lom_draw_desc *desc, uint64_t most)
{
    lom_draw_desc part = *desc;
    if (desc->topology == LOM_TRIANGLES && desc->instances <= 1)
        part.count = 3 * (size_t)most;
    part.culling.clusters = NULL;
    return part;
}

void __wrap_lom_draw(lom_device *device, const lom_draw_desc *desc)
{
    lom_lesson_run *run = lom_current_lesson();
    if (run == NULL) {
        __real_lom_draw(device, desc);
        return;
    }
    size_t triangles = count_triangles(desc);
    if (run->draws < LOM_LESSON_DRAWS)
        run->draw[run->draws++] =
            (struct lom_lesson_draw){ run->passes, run->pass_draws++, triangles, desc->shader->name };
    uint64_t left = run->moment - run->triangles;
    lom_draw_desc part = triangles <= left ? *desc : first_triangles(desc, left);
    run->triangles += triangles < left ? triangles : left;
    if (left > 0)
        __real_lom_draw(device, &part);
}

bool __wrap_lom_end_pass(lom_device *device)
{
    lom_lesson_run *run = lom_current_lesson();
    bool done = __real_lom_end_pass(device);
    if (run == NULL)
        return done;
    run->passes++;
    if (done && run->picture.width == 0 && run->triangles == run->moment)
        lom_end_lesson_with(run, __real_lom_read_texture(run->target, 0, 0, NULL));
    return done;
}

lom_image *__wrap_lom_read_texture(const lom_texture *texture, int level, int layer, lom_error *error)
{
    lom_lesson_run *run = lom_current_lesson();
    lom_image *image = __real_lom_read_texture(texture, level, layer, error);
    if (run == NULL || image == NULL)
        return image;
    run->read_image = image;
    run->width = image->width;
    run->height = image->height;
    run->read = -1;
    for (int i = 0; i < run->textures; i++)
        if (run->texture[i] == texture)
            run->read = i;
    if (run->look != NULL && run->read == run->watched)
        run->look(run, image);
    return image;
}

/* The library's own images are counted, too. */
lom_image *__wrap_lom_create_image(int width, int height, int depth, lom_format format, lom_error *error)
{
    lom_lesson_run *run = lom_current_lesson();
    lom_image *image = __real_lom_create_image(width, height, depth, format, error);
    if (run == NULL || image == NULL)
        return image;
    run->image[run->images++ % LOM_LESSON_IMAGES] = (uintptr_t)image->pixels;
    if (run->images == run->picture.created)
        run->picture.address = (uintptr_t)image->pixels;
    return image;
}

/* Of several images that had this memory the last one. */
static struct lom_lesson_picture picture_of(const lom_lesson_run *run, const lom_image *image)
{
    struct lom_lesson_picture p = { 0, (uintptr_t)image->pixels, image->width, image->height, image->format };
    for (int n = run->images; n > 0 && n > run->images - LOM_LESSON_IMAGES && p.created == 0; n--)
        p.created = run->image[(n - 1) % LOM_LESSON_IMAGES] == p.address ? n : 0;
    return p;
}

lom_image *__wrap_lom_convert_image(const lom_image *image, lom_format format, lom_error *error)
{
    lom_lesson_run *run = lom_current_lesson();
    lom_image *result = __real_lom_convert_image(image, format, error);
    if (run != NULL) {
        run->converted = result;
        run->source = picture_of(run, image);
    }
    return result;
}

/* What is written was read from a texture, or converted from what the lesson stored into, or is that itself. */
bool __wrap_lom_write_image(const char *path, const char *kind, const lom_image *image, lom_error *error)
{
    lom_lesson_run *run = lom_current_lesson();
    if (run != NULL) {
        lom_end_stores(run);
        if (image == run->read_image)
            run->source = (struct lom_lesson_picture){ .width = 0 };
        else if (image != run->converted)
            run->source = picture_of(run, image);
    }
    return __real_lom_write_image(path, kind, image, error);
}
