/* Proves what a frame tells of its progress: every pass that runs, by its name in the plan and in its order, then the
 * output; a share that never falls and stays below 1; and that telling changes no byte. */
#include "check.h"
#include "small_scene.h"

struct told {
    char pass[LOM_MAX_STEPS][24];
    int count;
    double done;
    bool fell;
};

static bool listen(void *context, const char *pass, double done)
{
    struct told *told = context;
    if (told->count < LOM_MAX_STEPS)
        snprintf(told->pass[told->count++], sizeof told->pass[0], "%s", pass);
    told->fell |= !(done >= told->done && done < 1);
    told->done = done;
    return true;
}

static struct told told;

static void every_pass_is_told_in_order(void)
{
    lom_error error = { .code = LOM_OK };
    lom_frame silent = { .image = NULL }, frame = { .image = NULL };
    lom_scene *scene = lom_read_scene(small_path("scene.toml"), NULL, 0, &error);
    lom_renderer *renderer = lom_create_renderer(scene, &(lom_device_desc){ .threads = 2 }, &error);
    CHECK(renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ .frame = 0 }, &silent, &error) &&
              lom_render_frame(renderer, &(lom_frame_desc){ .progress = listen, .progress_context = &told }, &frame,
                               &error),
          "%s", error.text);
    int at = 0;
    for (int i = 0; i < frame.plan.count; i++)
        if (frame.plan.step[i].runs) {
            CHECK(at < told.count && strcmp(told.pass[at], frame.plan.step[i].name) == 0, "%d: %s, not %s", at,
                  told.pass[at], frame.plan.step[i].name);
            at++;
        }
    CHECK(at > 3 && told.count == at + 1 && strcmp(told.pass[at], "output") == 0, "%d of %d passes", at, told.count);
    CHECK(!told.fell && told.done > 0.5, "the share fell, or ended at %g", told.done);
    CHECK(frame.image != NULL && silent.image != NULL && lom_hash_image(frame.image) == lom_hash_image(silent.image));
    lom_free_image(silent.image);
    lom_free_image(frame.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(every_pass_is_told_in_order);
    remove_small_scene();
    return check_result();
}
