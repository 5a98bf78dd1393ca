/* Drawing golden pictures. In: lines of a manifest, one after another. Out: what became of each. Invariant: a picture is
 * that of `lom render` with the line's options, whatever was drawn before it and whoever draws at the same time: a
 * verifier shares nothing with another but the manifest, which is only read. */
#include "verify.h"

#include "one_colour.h"
#include "paths.h"

#include "lanes/variants.h"

#include <string.h>

void lom_drop_verifier(struct lom_verifier *verifier)
{
    for (int i = 0; i < 2; i++) {
        lom_free_renderer(verifier->renderer[i]);
        verifier->renderer[i] = NULL;
    }
    lom_free_scene(verifier->scene);
    lom_release(verifier->path);
    verifier->scene = NULL;
    verifier->path = NULL;
}

/* The devices must have nothing in common: another number of threads, another width where two are built. */
static lom_device_desc other_device(const lom_renderer *renderer)
{
    lom_device_desc first = lom_describe_device(lom_renderer_device(renderer));
    lom_device_desc other = { .threads = first.threads == 1 ? 3 : 1, .lanes = first.lanes };
    for (int lanes = 4; lanes <= 16; lanes *= 2)
        if (lanes != first.lanes && lom_find_variant(lanes, false) >= 0)
            other.lanes = lanes;
    return other;
}

/* Renderers for verifier->scene. */
static bool create_renderers(struct lom_verifier *verifier, lom_error *error)
{
    lom_device_desc device = { .threads = verifier->threads };
    verifier->renderer[0] = lom_create_renderer(verifier->scene, &device, error);
    if (verifier->renderer[0] == NULL)
        return false;
    device = other_device(verifier->renderer[0]);
    verifier->renderer[1] = verifier->values->twice ? lom_create_renderer(verifier->scene, &device, error) : NULL;
    return !verifier->values->twice || verifier->renderer[1] != NULL;
}

/* The renderers go on with another scene from the same file; not where plates of clouds depend on frames before. */
static bool change_renderers(struct lom_verifier *verifier, lom_scene *scene, lom_error *error)
{
    bool done = true;
    for (int i = 0; i < 2 && done; i++)
        done = verifier->renderer[i] == NULL || lom_change_scene(verifier->renderer[i], scene, NULL, error);
    if (!done) {
        lom_drop_verifier(verifier);
        lom_free_scene(scene);
        return false;
    }
    lom_free_scene(verifier->scene);
    verifier->scene = scene;
    return true;
}

/* What was passed over while loading. */
static bool take_warnings(const struct lom_verifier *verifier, struct lom_outcome *o)
{
    o->warning_count = lom_renderer_warning_count(verifier->renderer[0]);
    o->warnings =
        o->warning_count > 0 ? lom_path_print(&o->error, "%s", lom_renderer_warning(verifier->renderer[0])) : NULL;
    return o->warning_count == 0 || o->warnings != NULL;
}

static bool provide_scene(struct lom_verifier *verifier, const struct lom_golden *golden, const lom_frame_desc *desc,
                          struct lom_outcome *o)
{
    lom_error *error = &o->error;
    bool is_absolute = golden->scene[0] == '/';
    char *path = lom_path_print(error, "%.*s%s", is_absolute ? 0 : verifier->manifest->folder, verifier->manifest->path,
                                golden->scene);
    lom_scene *scene = path != NULL ? lom_open_scene(path, &golden->options, error) : NULL;
    if (scene == NULL || !lom_check_frame(scene, desc, error)) {
        lom_free_scene(scene);
        lom_release(path);
        return false;
    }
    if (verifier->path != NULL && strcmp(verifier->path, path) == 0 &&
        verifier->scene->quality.impostors == LOM_IMPOSTORS_OFF && scene->quality.impostors == LOM_IMPOSTORS_OFF) {
        lom_release(path);
        return change_renderers(verifier, scene, error);
    }
    lom_drop_verifier(verifier);
    verifier->scene = scene;
    verifier->path = path;
    bool done = create_renderers(verifier, error) && take_warnings(verifier, o);
    if (!done)
        lom_drop_verifier(verifier);
    return done;
}

/* ---- one picture ---- */

static lom_verified judge(const struct lom_verifier *verifier, const struct lom_golden *golden, const lom_image *image,
                          const struct lom_outcome *o)
{
    if (verifier->values->twice && o->again != o->got)
        return LOM_VERIFIED_UNSTEADY;
    if (lom_is_one_colour(image) && !golden->may_be_flat)
        return LOM_VERIFIED_FLAT;
    if (golden->is_approved && o->got == o->expected)
        return LOM_VERIFIED_OK;
    if (verifier->values->approve)
        return LOM_VERIFIED_APPROVED;
    return golden->is_approved ? LOM_VERIFIED_DIFFERS : LOM_VERIFIED_NEW;
}

static bool verify_picture(struct lom_verifier *verifier, const struct lom_golden *golden, struct lom_outcome *o)
{
    int number = (int)lom_given_or(&golden->frame, 0);
    lom_frame_desc desc = lom_frame_of_options(&golden->options, number);
    lom_frame frames[2] = { { .image = NULL }, { .image = NULL } };
    bool done = provide_scene(verifier, golden, &desc, o);
    for (int i = 0; i < 2 && done; i++)
        done = verifier->renderer[i] == NULL || lom_render_frame(verifier->renderer[i], &desc, &frames[i], &o->error);
    if (done) {
        o->got = lom_hash_image(frames[0].image);
        o->again = frames[1].image != NULL ? lom_hash_image(frames[1].image) : 0;
        o->how = judge(verifier, golden, frames[0].image, o);
        done = lom_keep_pictures(verifier, golden, frames[0].image, frames[1].image, o);
    }
    lom_free_image(frames[0].image);
    lom_free_image(frames[1].image);
    return done;
}

void lom_verify_golden(struct lom_verifier *verifier, const struct lom_golden *golden, struct lom_outcome *outcome)
{
    *outcome = (struct lom_outcome){ .expected = golden->expected };
    if (!verify_picture(verifier, golden, outcome))
        outcome->how = LOM_VERIFIED_ERROR;
}
