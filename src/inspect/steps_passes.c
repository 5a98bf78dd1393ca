/* Pictures of the passes. In: what each pass of the frame left in its attachment. Out: a picture of each, in the order in
 * which they ran, with what the plan says of it. Invariant: the picture is read when its pass has ended. */
#include "inspect/eyes.h"
#include "inspect/steps.h"

#include <stdio.h>

static const char *plan_text(const struct steps *s, const char *label)
{
    const lom_plan *plan = &s->out->plan;
    for (int i = 0; i < plan->count; i++)
        if (strcmp(plan->step[i].name, label) == 0)
            return plan->step[i].text;
    return plan->count > 0 ? "a part of another step of the plan" : "drawn by the program";
}

/* Frees it. */
static lom_image *show(struct steps *s, struct listed_pass *pass)
{
    lom_image *image = pass->image, *shown = NULL;
    const lom_format_info *format = lom_describe_format(image->format);
    pass->image = NULL;
    if (format->is_depth) {
        lom_image *floats = lom_convert_image(image, LOM_FORMAT_R32F, s->error);
        lom_image *gray = floats != NULL ? lom_depth_to_eyes(floats, s->error) : NULL;
        shown = gray != NULL ? lom_convert_image(gray, LOM_FORMAT_RGB8, s->error) : NULL;
        lom_free_image(gray);
    } else if (format->is_float || format->is_srgb) {
        shown = lom_convert_image(image, LOM_FORMAT_RGB8_SRGB, s->error);
    } else {
        shown = lom_convert_image(image, LOM_FORMAT_RGB8, s->error);
    }
    lom_free_image(image);
    if (shown != NULL)
        shown->format = LOM_FORMAT_RGB8_SRGB;
    return shown != NULL && shown->width == s->width ? lom_magnify(shown, s->zoom, s->error) : shown;
}

/* A scene that has none of it is no failure. */
bool lom_take_made(struct steps *s, const lom_frame_desc *frame)
{
    static const char *const names[MADE_PICTURES] = { "heights", "light-grid", "caustics" };
    for (size_t i = 0; i < MADE_PICTURES; i++) {
        lom_error error = { .code = LOM_OK };
        lom_image *gray = lom_show_to_eyes(lom_show_pass(s->renderer, frame, names[i], &error), names[i], &error);
        s->made[i] = (struct made_picture){ names[i], NULL };
        if (gray != NULL)
            s->made[i].image = lom_convert_image(gray, LOM_FORMAT_RGB8, &error);
        lom_free_image(gray);
        if (error.code == LOM_ERROR_MEMORY) {
            *s->error = error;
            return false;
        }
    }
    return true;
}

static void add_made(struct steps *s, struct made_picture *made)
{
    const lom_shown_pass *shown = NULL;
    for (size_t i = 0; (shown = lom_describe_shown_pass(i)) != NULL; i++)
        if (made->name != NULL && strcmp(shown->name, made->name) == 0)
            break;
    if (made->image == NULL || shown == NULL)
        return;
    made->image->format = LOM_FORMAT_RGB8_SRGB;
    lom_add_picture(s, "Passes", made->name, made->name, NULL, made->image,
                    "What the frame's stages make before they draw: %s. Brighter is more.", shown->text);
    made->image = NULL;
}

static bool is_several(const struct steps *s, size_t pass)
{
    size_t count = 0;
    for (size_t i = 0; i < s->pass_count; i++)
        count += strcmp(s->passes[i].label, s->passes[pass].label) == 0;
    return count > 1;
}

void lom_picture_passes(struct steps *s)
{
    for (size_t i = 0; i < MADE_PICTURES && !s->failed; i++)
        add_made(s, &s->made[i]);
    for (size_t i = 0; i < s->pass_count && !s->failed; i++) {
        struct listed_pass *pass = &s->passes[i];
        char name[64], title[96], times[64] = "";
        bool is_depth = lom_describe_format(pass->image->format)->is_depth;
        snprintf(name, sizeof name, "pass-%s", pass->label);
        bool several = is_several(s, i); /* of this name, into other targets */
        snprintf(title, sizeof title, several ? "Pass \"%s\" into the %s" : "Pass \"%s\"", pass->label, pass->target);
        if (pass->times > 1)
            snprintf(times, sizeof times, " The last of %zu of this name.", pass->times);
        lom_add_picture(s, "Passes", name, title, "src/pipeline/resolve.c", show(s, pass),
                        "What pass %llu leaves in its %s: %s. %zu draws.%s", (unsigned long long)pass->number,
                        is_depth ? "depth attachment (brighter is nearer)" : "colour attachment",
                        plan_text(s, pass->label), pass->draws, times);
    }
}
