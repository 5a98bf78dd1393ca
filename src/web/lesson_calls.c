/* A lesson's calls of the library, noted and handed on. In: the calls (-Wl,--wrap). Out: the same calls; at the moment
 * that is asked for, the picture so far. Invariant: until then the library draws what the lesson tells it. Passes
 * are named, and a lesson that is run again draws by the device and into the textures of the run before. */
#include "web/lesson_page.h"

lom_device *__wrap_lom_open_device(const lom_device_desc *desc);
void __wrap_lom_close_device(lom_device *device);
lom_texture *__wrap_lom_make_texture(lom_device *device, const lom_texture_desc *desc);
lom_texture *__wrap_lom_texture_of_image(const lom_image *image, bool srgb, lom_mips mips, lom_error *error);
void __wrap_lom_free_texture(lom_texture *texture);
void __wrap_lom_begin_pass(lom_device *device, const lom_pass_desc *desc);
void __wrap_lom_draw(lom_device *device, const lom_draw_desc *desc);
bool __wrap_lom_end_pass(lom_device *device);
lom_image *__wrap_lom_read_texture(const lom_texture *texture, int level, int layer, lom_error *error);
lom_image *__wrap_lom_create_image(int width, int height, int depth, lom_format format, lom_error *error);
lom_image *__wrap_lom_convert_image(const lom_image *image, lom_format format, lom_error *error);
bool __wrap_lom_write_image(const char *path, const char *kind, const lom_image *image, lom_error *error);

/* ---- what stays from run to run: the device and its textures, so that they can be watched ---- */

lom_device *__wrap_lom_open_device(const lom_device_desc *desc)
{
    lom_lesson_run *run = lom_current_lesson();
    lom_device *device = run != NULL && run->device != NULL ? run->device : __real_lom_open_device(desc);
    if (run != NULL)
        run->device = device;
    return device;
}

void __wrap_lom_close_device(lom_device *device)
{
    if (lom_current_lesson() == NULL)
        __real_lom_close_device(device);
}

/* The n-th texture of a run: that of the run before; NULL: it has to be made. */
static lom_texture **next_texture(lom_lesson_run *run)
{
    static lom_texture *none;
    none = NULL;
    return run == NULL || run->textures == LOM_LESSON_TEXTURES ? &none : &run->texture[run->textures++];
}

lom_texture *__wrap_lom_make_texture(lom_device *device, const lom_texture_desc *desc)
{
    lom_texture **kept = next_texture(lom_current_lesson());
    if (*kept == NULL)
        *kept = __real_lom_make_texture(device, desc);
    return *kept;
}

lom_texture *__wrap_lom_texture_of_image(const lom_image *image, bool srgb, lom_mips mips, lom_error *error)
{
    lom_texture **kept = next_texture(lom_current_lesson());
    if (*kept == NULL)
        *kept = __real_lom_texture_of_image(image, srgb, mips, error);
    return *kept;
}

void __wrap_lom_free_texture(lom_texture *texture)
{
    if (lom_current_lesson() == NULL)
        __real_lom_free_texture(texture);
}

/* ---- passes and draws ---- */

/* Passes get names, in the order in which they are drawn. */
void __wrap_lom_begin_pass(lom_device *device, const lom_pass_desc *desc)
{
    lom_lesson_run *run = lom_current_lesson();
    lom_pass_desc pass = *desc;
    if (run != NULL) {
        run->target = desc->color[0];
        run->pass_draws = 0;
        pass.label = lom_lesson_pass(run->passes);
    }
    __real_lom_begin_pass(device, &pass);
}

const char *lom_lesson_pass(int number)
{
    static const char *const names[] = { "first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth" };
    return number < (int)(sizeof names / sizeof names[0]) ? names[number] : "later";
}

static size_t count_triangles(const lom_draw_desc *desc)
{
    bool one = desc->topology == LOM_SPRITES || desc->topology == LOM_POINTS;
    size_t count = desc->topology == LOM_TRIANGLES ? desc->count / 3
                   : desc->topology == LOM_LINES   ? desc->count / 2
                   : one                           ? desc->count
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
    run->read = NULL;
    for (int i = 0; i < run->textures; i++)
        run->read = run->texture[i] == texture ? run->texture[i] : run->read;
    return image;
}

/* ---- images ---- */

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
