/* Pictures of the stages. In: a renderer and a frame, or a program that draws by a device; the name of a pass. Out: a
 * picture of what each stage made of that pass and of what each pass made of the frame. Invariant: every drawing of the frame is the same one: what it leaves for the
 * next is forgotten before it, so passes keep their numbers from one to the next; it is left off behind the chosen pass. */
#include "base/own_float_state.h"
#include "inspect/forget.h"
#include "inspect/steps.h"
#include "base/reserve.h"
#include "pipeline/check_device.h"
#include "pipeline/device.h"

#include <stdarg.h>
#include <stdio.h>

enum { SLIDE = 960 }; /* pixels that a picture is wide at least */

/* ---- the list of pictures ---- */

static bool is_taken(const struct steps *s, const char *name)
{
    for (size_t i = 0; i < s->out->count; i++)
        if (strcmp(s->out->picture[i].name, name) == 0)
            return true;
    return false;
}

/* A name as a part of a file's. */
static void write_name(const struct steps *s, const char *text, char name[48])
{
    size_t length = 0;
    for (; *text != 0 && length < 40; text++) {
        char c = *text >= 'A' && *text <= 'Z' ? (char)(*text - 'A' + 'a') : *text;
        bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (plain)
            name[length++] = c;
        else if (length > 0 && name[length - 1] != '-')
            name[length++] = '-';
    }
    while (length > 0 && name[length - 1] == '-')
        length--;
    name[length] = 0;
    for (int i = 2; is_taken(s, name); i++)
        snprintf(name + length, 48 - length, "-%d", i);
}

lom_stage_picture *lom_add_picture(struct steps *s, const char *group, const char *name, const char *title,
                                   const char *source, lom_image *image, const char *format, ...)
{
    lom_stage_pictures *out = s->out;
    if (image == NULL || !lom_reserve(&out->picture, &s->capacity, out->count + 1, sizeof *out->picture, s->error)) {
        lom_free_image(image);
        s->failed = true;
        return NULL;
    }
    lom_stage_picture *picture = &out->picture[out->count];
    *picture = (lom_stage_picture){ .group = group, .source = source, .image = image };
    write_name(s, name, picture->name);
    snprintf(picture->title, sizeof picture->title, "%s", title);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(picture->text, sizeof picture->text, format, arguments);
    va_end(arguments);
    out->count++;
    return picture;
}

void lom_add_legend(lom_stage_picture *picture, const struct ink *ink, const char *format, ...)
{
    if (picture == NULL || picture->legend_count == LOM_MAX_LEGEND)
        return;
    lom_picture_legend *legend = &picture->legend[picture->legend_count++];
    for (int c = 0; c < 3; c++)
        legend->color[c] = (uint8_t)lom_int_of((double)ink->color[c] * 255 + 0.5);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(legend->text, sizeof legend->text, format, arguments);
    va_end(arguments);
}

void lom_add_scale(lom_stage_picture *picture, const uint8_t ramp[LOM_RAMP_COLORS][3], double low, double high,
                   bool is_logarithmic)
{
    if (picture == NULL)
        return;
    picture->has_scale = true;
    picture->is_logarithmic = is_logarithmic;
    picture->low = low;
    picture->high = high;
    memcpy(picture->color, ramp, sizeof picture->color);
}

void lom_free_stage_pictures(lom_stage_pictures *pictures)
{
    if (pictures == NULL)
        return;
    for (size_t i = 0; i < pictures->count; i++)
        lom_free_image(pictures->picture[i].image);
    lom_release(pictures->picture);
    lom_release(pictures);
}

/* ---- drawing ---- */

/* Left off when the last pass that is wanted has ended. */
static bool go_on(void *context, const char *pass, double done)
{
    const struct steps *s = context;
    (void)pass;
    (void)done;
    return lom_count_watched_passes(s->device) <= s->last;
}

static lom_frame_desc describe_frame(const struct steps *s)
{
    lom_frame_desc frame = s->desc->frame;
    frame.crop = (lom_rect){ 0, 0, 0, 0 };
    frame.pixels = NULL;
    frame.progress = NULL;
    frame.continues = false;
    frame.view = frame.view != NULL ? frame.view : LOM_MAIN_VIEW;
    return frame;
}

/* The frame of a renderer. */
static bool draw_frame(struct steps *s, bool whole, lom_image **image)
{
    lom_frame frame = { .image = NULL };
    lom_error error = { .code = LOM_OK };
    lom_frame_desc desc = describe_frame(s);
    if (!whole) {
        desc.progress = go_on;
        desc.progress_context = s;
    }
    lom_forget_frames(s->renderer);
    bool done = lom_render_frame(s->renderer, &desc, &frame, &error) || (!whole && error.code == LOM_ERROR_ABANDONED);
    *image = frame.image;
    if (whole)
        s->out->plan = frame.plan;
    if (!done)
        *s->error = error;
    return done && (!whole || lom_take_made(s, &desc));
}

/* What a program draws, all of it each time. */
static bool draw_program(struct steps *s, bool whole, lom_image **image)
{
    (void)whole;
    *image = s->drawing->draw(s->drawing->context, s->error);
    return *image != NULL || (s->error->code == LOM_OK && lom_check_device(s->device, s->error) &&
                              lom_fail(s->error, LOM_ERROR_USAGE, "The drawing gave no picture."));
}

bool lom_draw_chosen(struct steps *s, const lom_listener *listener)
{
    lom_image *image = NULL;
    if (listener != NULL && !lom_listen(s->device, listener))
        return lom_check_device(s->device, s->error);
    bool done = s->draw(s, false, &image);
    lom_free_image(image);
    return done && lom_tell_steps(s, 1);
}

bool lom_tell_steps(struct steps *s, int frames)
{
    s->drawn += frames;
    if (s->desc == NULL || s->desc->progress == NULL ||
        s->desc->progress(s->desc->progress_context, (double)s->drawn / s->frames))
        return true;
    return lom_fail(s->error, LOM_ERROR_ABANDONED, "The pictures of the stages were abandoned.");
}

bool lom_is_alive(const struct steps *s, const lom_texture *texture)
{
    const lom_device *device = s->device;
    bool found = s->drawing != NULL;
    for (size_t i = 0; i < device->texture_count; i++)
        found |= device->textures[i] == texture;
    return found;
}

bool lom_watch_target(struct steps *s, lom_rect at)
{
    const lom_watch_desc watch = {
        .target = s->target, .x = at.x, .y = at.y, .width = at.width, .height = at.height, .before = s->last + 1
    };
    if (!lom_is_alive(s, s->target))
        return lom_fail(s->error, LOM_ERROR_USAGE, "The target of pass \"%s\" is another one in each frame.",
                        s->out->pass);
    return lom_watch(s->device, &watch, 1) || lom_check_device(s->device, s->error);
}

bool lom_is_seen(const struct steps *s, const lom_triangle_record *t)
{
    return t->covered && (s->attachment < 0 ? t->fragment.depth_written : t->fragment.write[0].written);
}

/* ---- the passes ---- */

static const char *label_of(const lom_pass_desc *desc)
{
    return desc->label != NULL ? desc->label : "pass";
}

static const lom_texture *target_of(const lom_pass_desc *desc)
{
    return desc->color[0] != NULL ? desc->color[0] : desc->depth;
}

static const char *target_label(const lom_pass_desc *desc)
{
    const char *label = lom_texture_label(target_of(desc));
    return label != NULL ? label : "";
}

/* Passes of one label into targets of one label are one entry. */
static struct listed_pass *find_entry(struct steps *s, const lom_pass_desc *desc)
{
    for (size_t i = 0; i < s->pass_count; i++)
        if (strcmp(s->passes[i].label, label_of(desc)) == 0 && strcmp(s->passes[i].target, target_label(desc)) == 0)
            return &s->passes[i];
    if (!lom_reserve(&s->passes, &s->pass_capacity, s->pass_count + 1, sizeof *s->passes, s->error)) {
        s->failed = true;
        return NULL;
    }
    s->passes[s->pass_count] = (struct listed_pass){ .label = label_of(desc), .target = target_label(desc) };
    return &s->passes[s->pass_count++];
}

static void list_pass(void *context, uint64_t number, const lom_pass_desc *desc, size_t draws, bool blends)
{
    struct steps *s = context;
    struct listed_pass *pass = find_entry(s, desc);
    if (pass == NULL)
        return;
    lom_free_image(pass->image);
    pass->image = lom_read_texture(target_of(desc), 0, 0, s->error);
    s->failed |= pass->image == NULL;
    pass->number = number;
    pass->desc = *desc;
    pass->draws += draws;
    pass->blends |= blends;
    pass->times++;
}

/* The last of this label. */
static const struct listed_pass *find_pass(const struct steps *s, const char *label)
{
    const struct listed_pass *last = NULL;
    for (size_t i = 0; i < s->pass_count; i++)
        if (strcmp(s->passes[i].label, label) == 0 && (last == NULL || s->passes[i].number > last->number))
            last = &s->passes[i];
    return last;
}

/* The labels, each once, in the order of the frame. */
static void list_labels(const struct steps *s, char names[400])
{
    names[0] = 0;
    for (size_t i = 0; i < s->pass_count; i++) {
        bool is_first = true;
        for (size_t k = 0; k < i; k++)
            is_first &= strcmp(s->passes[k].label, s->passes[i].label) != 0;
        size_t length = strlen(names);
        if (is_first)
            snprintf(names + length, 400 - length, "%s%s", i > 0 ? ", " : "", s->passes[i].label);
    }
}

static bool choose_pass(struct steps *s)
{
    const char *name = s->pass;
    const struct listed_pass *pass = find_pass(s, name != NULL ? name : "scene");
    for (size_t i = 0; i < s->pass_count && name == NULL && pass == NULL; i++)
        if (s->passes[i].draws > 0)
            pass = &s->passes[i];
    if (pass == NULL) {
        char names[400];
        list_labels(s, names);
        return lom_fail(s->error, LOM_ERROR_USAGE, "This frame draws no pass \"%s\"; it draws %s.",
                        name != NULL ? name : "scene", names);
    }
    s->chosen = *pass;
    for (size_t i = 0; i < s->pass_count; i++) {
        const struct listed_pass *p = &s->passes[i];
        bool same = p->desc.color[0] != NULL && p->desc.color[0] == pass->desc.color[0];
        if (same && p->blends && p->number >= pass->number)
            s->blended = *p;
    }
    s->attachment = pass->desc.color[0] != NULL ? 0 : -1;
    s->target = target_of(&pass->desc);
    s->width = lom_texture_width(s->target);
    s->height = lom_texture_height(s->target);
    s->zoom = (SLIDE + s->width - 1) / s->width;
    s->frames = 4 + lom_count_bands(s); /* the whole one, twice the triangles, the detail */
    snprintf(s->out->pass, sizeof s->out->pass, "%s", pass->label);
    return lom_tell_steps(s, 1);
}

static bool draw_whole(struct steps *s, lom_image **picture)
{
    const lom_listener listener = { .context = s, .ended = list_pass };
    return (lom_listen(s->device, &listener) || lom_check_device(s->device, s->error)) && s->draw(s, true, picture) &&
           !s->failed;
}

/* Takes the picture. */
static void make_pictures(struct steps *s, lom_image *picture)
{
    static void (*const parts[])(struct steps * s) = { lom_picture_triangles, lom_record_planes, lom_picture_coverage,
                                                       lom_picture_planes, lom_picture_passes };
    for (size_t i = 0; i < sizeof parts / sizeof parts[0] && !s->failed; i++)
        parts[i](s);
    if (s->failed)
        lom_free_image(picture);
    else
        lom_add_picture(s, "Frame", "final", "The picture", s->renderer != NULL ? "src/render/output.c" : NULL, picture,
                        s->renderer != NULL ? "What `lom render` writes, byte for byte." : "What the program draws.");
}

static void clear(struct steps *s)
{
    for (size_t i = 0; i < s->pass_count; i++)
        lom_free_image(s->passes[i].image);
    for (size_t i = 0; i < s->plane_count; i++) {
        lom_release(s->planes[i].value);
        lom_release(s->planes[i].is_there);
    }
    for (size_t i = 0; i < s->level_count; i++)
        lom_release(s->levels[i].times);
    for (size_t i = 0; i < MADE_PICTURES; i++)
        lom_free_image(s->made[i].image);
    lom_release(s->passes);
    lom_release(s->planes);
    lom_release(s->levels);
    lom_release(s->owner);
    lom_watch(s->device, NULL, 0);
    if (s->renderer != NULL)
        lom_forget_frames(s->renderer);
}

/* Of what the steps say draws; what fails is in *s->error, and then in *error. */
static lom_stage_pictures *picture_steps(struct steps *s, lom_error *error)
{
    lom_image *picture = NULL;
    s->out = lom_allocate(1, sizeof *s->out, s->error);
    if (s->out != NULL && draw_whole(s, &picture) && choose_pass(s)) {
        s->out->width = picture->width;
        s->out->height = picture->height;
        make_pictures(s, picture);
        picture = NULL;
    }
    lom_free_image(picture);
    clear(s);
    if (s->error->code == LOM_OK)
        return s->out;
    lom_free_stage_pictures(s->out);
    if (error != NULL)
        *error = *s->error;
    return NULL;
}

lom_stage_pictures *lom_picture_stages(lom_renderer *renderer, const lom_stages_desc *desc, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    lom_error own = { .code = LOM_OK };
    struct steps s = { .device = renderer->device,
                       .draw = draw_frame,
                       .pass = desc->pass,
                       .renderer = renderer,
                       .desc = desc,
                       .error = &own };
    if (renderer->reference == NULL)
        return picture_steps(&s, error);
    lom_fail(error, LOM_ERROR_USAGE,
             "This scene's picture is traced by the reference, which has no stages: take "
             "another model, like --set quality.water=planar and --set quality.clouds=lit.");
    return NULL;
}

lom_stage_pictures *lom_picture_drawing(const lom_drawing *drawing, const char *pass, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    lom_error own = { .code = LOM_OK };
    struct steps s = {
        .device = drawing->device, .draw = draw_program, .pass = pass, .drawing = drawing, .error = &own
    };
    return picture_steps(&s, error);
}
