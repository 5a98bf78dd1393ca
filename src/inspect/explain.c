/* Explaining a pixel of a frame. In: a renderer or a program that draws by a device, a pixel. Out: what was recorded of it, and of the texels of the frame's
 * own pictures that its shaders read, as deep as asked. Invariant: every drawing of the frame is the same one: what it
 * leaves for the next is forgotten before it, so passes keep their numbers from one to the next. */
#include "base/own_float_state.h"
#include "inspect/forget.h"
#include "inspect/verdict.h"
#include "pipeline/check_device.h"
#include "render/frame.h"
#include "water/water_models.h"

/* ---- what is looked up ---- */

const lom_tap *lom_main_tap(const lom_note_record *lookup)
{
    const lom_tap *heaviest = NULL;
    for (int i = 0; i < lookup->taps; i++)
        if (heaviest == NULL || lookup->tap[i].weight > heaviest->weight)
            heaviest = &lookup->tap[i];
    return heaviest;
}

static int within(int at, int size)
{
    return at < 0 ? 0 : at < size ? at : size - 1;
}

/* The texel of level 0 that a lookup read most of; false: it is no 2D texture. */
static bool find_texel(const lom_note_record *lookup, int *x, int *y)
{
    const lom_tap *tap = lookup->texture != NULL ? lom_main_tap(lookup) : NULL;
    if (tap == NULL || lom_texture_depth(lookup->texture) > 1)
        return false;
    *x = within(tap->x << tap->level, lom_texture_width(lookup->texture));
    *y = within(tap->y << tap->level, lom_texture_height(lookup->texture));
    return true;
}

const lom_explained *lom_followed(const lom_explanation *explanation, uint64_t pass, const lom_note_record *lookup)
{
    int x, y;
    if (!find_texel(lookup, &x, &y))
        return NULL;
    for (size_t i = 1; i < explanation->count; i++) {
        const lom_explained *e = &explanation->item[i];
        if (e->texture == lookup->texture && e->before == pass && e->x == x && e->y == y)
            return e;
    }
    return NULL;
}

/* Of the lookups of one texture by one fragment the middle one: that of 3 x 3 around a place. */
static const lom_note_record *middle_lookup(const lom_note_record *notes, const lom_texture *texture)
{
    int count = 0;
    const lom_note_record *middle = NULL;
    for (const lom_note_record *n = notes; n != NULL; n = n->next)
        count += n->texture == texture;
    count /= 2;
    for (const lom_note_record *n = notes; n != NULL && middle == NULL; n = n->next)
        if (n->texture == texture && count-- == 0)
            middle = n;
    return middle;
}

static bool is_first(const lom_note_record *notes, const lom_note_record *note)
{
    while (notes != note && notes->texture != note->texture)
        notes = notes->next;
    return notes == note;
}

/* Adds the texels that a fragment read of what the frame has drawn before this pass. */
static void follow_fragment(const lom_device *device, lom_explanation *explanation, int depth, uint64_t pass,
                            const lom_fragment_record *fragment)
{
    uint64_t drawn;
    int x, y;
    for (const lom_note_record *n = fragment->notes; n != NULL; n = n->next) {
        if (n->texture == NULL || explanation->count == LOM_MAX_WATCHES || !is_first(fragment->notes, n) ||
            !lom_find_drawn(device, n->texture, pass, &drawn))
            continue;
        const lom_note_record *lookup = middle_lookup(fragment->notes, n->texture);
        if (lom_followed(explanation, pass, lookup) != NULL || !find_texel(lookup, &x, &y))
            continue;
        explanation->item[explanation->count++] =
            (lom_explained){ .texture = n->texture, .x = x, .y = y, .before = pass, .depth = depth + 1 };
    }
}

static void follow(const lom_device *device, lom_explanation *explanation, const lom_explained *from)
{
    const int depth = from->depth;
    for (const lom_pass_record *pass = from->record->passes; pass != NULL; pass = pass->next)
        for (const lom_draw_record *draw = pass->filters ? NULL : pass->draws; draw != NULL; draw = draw->next)
            for (const lom_triangle_record *t = draw->triangles; t != NULL; t = t->next)
                if (t->fragment.shaded && (t->fate == LOM_FATE_STORED || t->fate == LOM_FATE_BLENDED_OVER))
                    follow_fragment(device, explanation, depth, pass->number, &t->fragment);
}

/* ---- drawing ---- */

void lom_forget_frames(lom_renderer *r)
{
    for (int i = 0; i < LOM_ENTITY_SHADOWS; i++)
        r->entities.shadows[i].made_for = 0;
    lom_forget_lamp_shadows(&r->lamps.shadows);
    r->clouds.ground_shadow.made_for = 0;
    r->clouds.impostors.width = r->clouds.impostors.height = 0;
}

struct explaining {
    lom_device *device;
    lom_explanation *explanation;
    lom_rect watched; /* of the picture's texture */
    int follow;
    bool (*draw)(struct explaining *e, lom_error *error); /* gives the explanation its frame */
    lom_renderer *renderer;                               /* of a frame, with its description */
    const lom_frame_desc *frame;
    const lom_drawing *drawing;
};

static bool draw_frame(struct explaining *e, lom_error *error)
{
    lom_forget_frames(e->renderer);
    return lom_render_frame(e->renderer, e->frame, &e->explanation->frame, error);
}

/* Of the picture the explained pixel is left. */
static bool draw_program(struct explaining *e, lom_error *error)
{
    const lom_rect *at = &e->watched;
    lom_explanation *x = e->explanation;
    lom_image *whole = e->drawing->draw(e->drawing->context, error);
    if (whole != NULL && (at->x >= whole->width || at->y >= whole->height))
        lom_fail(error, LOM_ERROR_USAGE, "The pixel %d,%d does not lie in the picture of %dx%d pixels.", at->x, at->y,
                 whole->width, whole->height);
    else if (whole != NULL && (x->frame.image = lom_create_image(1, 1, 1, whole->format, error)) != NULL) {
        x->width = whole->width;
        x->height = whole->height;
        memcpy(x->frame.image->pixels, lom_image_pixel(whole, at->x, at->y, 0), lom_format_size(whole->format));
    }
    lom_free_image(whole);
    return x->frame.image != NULL;
}

static bool draw(struct explaining *x, lom_error *error)
{
    lom_explanation *explanation = x->explanation;
    lom_watch_desc watches[LOM_MAX_WATCHES];
    for (size_t i = 0; i < explanation->count; i++) {
        const lom_explained *e = &explanation->item[i];
        watches[i] = (lom_watch_desc){
            .target = e->texture, .x = e->x, .y = e->y, .before = e->before, .filtered = e->filtered
        };
    }
    watches[0].x = x->watched.x;
    watches[0].y = x->watched.y;
    watches[0].width = x->watched.width;
    watches[0].height = x->watched.height;
    lom_free_image(explanation->frame.image);
    explanation->frame.image = NULL;
    if (!lom_watch(x->device, watches, explanation->count))
        return lom_check_device(x->device, error);
    if (!x->draw(x, error))
        return false;
    for (size_t i = 0; i < explanation->count; i++) {
        lom_explained *e = &explanation->item[i];
        e->record = lom_watched_pixel(x->device, i, watches[i].x, watches[i].y);
    }
    return true;
}

/* Whether a drawing told that what is watched is made of another texture, which is to be watched with it then. */
static bool find_filtered(const struct explaining *x)
{
    bool found = false;
    for (size_t i = 0; i < x->explanation->count; i++) {
        lom_explained *e = &x->explanation->item[i];
        const lom_texture *from = lom_find_filtered(x->device, e->texture, e->before != 0 ? e->before : UINT64_MAX);
        found |= from != e->filtered;
        e->filtered = from;
    }
    return found;
}

/* The pixel, then what it looked up, until nothing is new or it is deep enough. */
static bool draw_all(struct explaining *x, lom_error *error)
{
    lom_explanation *explanation = x->explanation;
    size_t followed = 0;
    for (int depth = 0;; depth++) {
        if (!draw(x, error))
            return false;
        if (find_filtered(x) && !draw(x, error))
            return false;
        size_t known = explanation->count;
        for (; followed < known && depth < x->follow && x->watched.width * x->watched.height <= 1; followed++)
            follow(x->device, explanation, &explanation->item[followed]);
        if (explanation->count == known)
            return true;
    }
}

/* The level of the water whose mirror has a pass: of those whose mirrors have begun, the last one. */
static double find_mirror(const lom_renderer *r, uint64_t pass)
{
    size_t found = 0;
    for (size_t i = 1; i <= r->world->scene->other_water_count; i++) {
        const uint64_t first = r->waters[i].mirrored, before = r->waters[found].mirrored;
        if (first <= pass && (before > pass || first > before))
            found = i;
    }
    return lom_water_of(r->world->scene, found)->level;
}

/* Where the eye of a picture's passes is. */
static lom_vec3 find_eye(const lom_renderer *r, const lom_explained *e)
{
    lom_vec3 eye = lom_camera_eye(&r->moment.camera);
    const lom_pass_record *p = e->record->passes;
    while (p != NULL && (p->label == NULL || strcmp(p->label, "reflection") != 0))
        p = p->next;
    if (p != NULL)
        eye.y = 2 * find_mirror(r, p->number) - eye.y;
    return lom_place_in_file(r->scene, eye);
}

static void describe(const lom_renderer *r, lom_explanation *explanation)
{
    for (size_t i = 0; i < explanation->count; i++) {
        lom_explained *e = &explanation->item[i];
        const char *label = lom_texture_label(e->texture);
        e->name = i == 0 ? "picture" : label != NULL ? label : "texture";
        if (r != NULL)
            e->eye = find_eye(r, e);
        lom_find_verdict(e);
    }
}

/* A pixel of a view is one of the view's own picture. */
static bool enter_view(const lom_scene *scene, lom_explain_desc *desc, lom_error *error)
{
    struct frame f = { .scene = scene, .desc = &desc->frame };
    if (desc->frame.view != NULL || scene->view_count == 0)
        return true;
    if (!lom_find_frame_sizes(&f, error))
        return false;
    const lom_picture_view *view = lom_view_at(scene, f.width, f.height, desc->x, desc->y);
    desc->frame.view = view != NULL ? view->name : LOM_MAIN_VIEW;
    if (view != NULL) {
        const lom_rect r = lom_view_rectangle(view, f.width, f.height);
        desc->x -= r.x;
        desc->y -= r.y;
    }
    return true;
}

/* The targets are there before the frame is drawn, so that they can be watched. */
static bool prepare(lom_renderer *r, lom_explanation *explanation, lom_explain_desc *desc, lom_rect *watched,
                    lom_error *error)
{
    if (r->reference != NULL)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "This scene's picture is traced by the reference, which has no passes: explain it with another "
                        "model, like --set quality.water=planar and --set quality.clouds=lit.");
    desc->width = desc->width != 0 ? desc->width : 1;
    desc->height = desc->height != 0 ? desc->height : 1;
    desc->frame.crop = (lom_rect){ 0, 0, 0, 0 };
    struct frame f = { .renderer = r, .scene = r->scene, .desc = &desc->frame };
    if (!enter_view(r->scene, desc, error) || !lom_find_frame_sizes(&f, error))
        return false;
    explanation->view = f.shown != NULL ? f.shown->name : NULL;
    if (desc->x < 0 || desc->y < 0 || desc->width < 1 || desc->height < 1 || desc->x > f.width - desc->width ||
        desc->y > f.height - desc->height)
        return lom_fail(error, LOM_ERROR_USAGE,
                        "The pixel %d,%d does not lie in the frame of %dx%d pixels (0,0 to %d,%d).", desc->x, desc->y,
                        f.width, f.height, f.width - 1, f.height - 1);
    desc->frame.crop = (lom_rect){ desc->x, desc->y, desc->width, desc->height };
    f.crop = desc->frame.crop;
    lom_begin_edges(&f);
    *watched = (lom_rect){ f.asked.x, f.asked.y, desc->width, desc->height };
    explanation->width = f.width;
    explanation->height = f.height;
    explanation->count = 1;
    if (!lom_make_targets(r, f.width, f.height, f.crop.width, f.crop.height, error))
        return false;
    explanation->item[0] = (lom_explained){ .texture = r->targets.of[LOM_TARGET_COLOR], .x = desc->x, .y = desc->y };
    return true;
}

lom_explanation *lom_explain(lom_renderer *renderer, const lom_explain_desc *asked, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    lom_explain_desc desc = *asked;
    lom_explanation *explanation = lom_allocate(1, sizeof *explanation, error);
    if (explanation == NULL)
        return NULL;
    lom_rect watched;
    if (prepare(renderer, explanation, &desc, &watched, error)) {
        struct explaining x = { .device = renderer->device,
                                .explanation = explanation,
                                .watched = watched,
                                .follow = desc.follow,
                                .draw = draw_frame,
                                .renderer = renderer,
                                .frame = &desc.frame };
        if (draw_all(&x, error)) {
            describe(renderer, explanation);
            return explanation;
        }
    }
    lom_free_explanation(renderer, explanation);
    return NULL;
}

lom_explanation *lom_explain_drawing(const lom_drawing *drawing, const lom_texture *picture, int x, int y, int depth,
                                     lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    lom_explanation *explanation = lom_allocate(1, sizeof *explanation, error);
    if (explanation == NULL)
        return NULL;
    struct explaining e = { .device = drawing->device,
                            .explanation = explanation,
                            .watched = { x, y, 1, 1 },
                            .follow = depth,
                            .draw = draw_program,
                            .drawing = drawing };
    explanation->count = 1;
    explanation->item[0] = (lom_explained){ .texture = picture, .x = x, .y = y };
    if (draw_all(&e, error)) {
        describe(NULL, explanation);
        return explanation;
    }
    lom_free_drawing_explanation(drawing, explanation);
    return NULL;
}

void lom_free_drawing_explanation(const lom_drawing *drawing, lom_explanation *explanation)
{
    if (explanation == NULL)
        return;
    lom_watch(drawing->device, NULL, 0);
    lom_free_image(explanation->frame.image);
    lom_release(explanation);
}

void lom_free_explanation(lom_renderer *renderer, lom_explanation *explanation)
{
    if (explanation == NULL)
        return;
    lom_watch(renderer->device, NULL, 0);
    lom_forget_frames(renderer);
    lom_free_image(explanation->frame.image);
    lom_release(explanation);
}
