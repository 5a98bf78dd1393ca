/* Any frame alone is the frame of a run: whatever a renderer keeps from picture to picture (shadows, light, histories,
 * simulations), the picture of a time is that of a renderer that draws no other. Over the small scenes of every kind,
 * times forwards, backwards, and the same one twice. Plates of clouds are the one exception (lom/render.h). */
#include "change_bases.h"
#include "check.h"
#include "small_scene.h"

/* What stands still there and moves here. */
static const struct base changing[] = {
    { "evolving_shadows", "", VIEW TERRAIN CLOUD "[clouds]\nevolve = 3\n" },
    { "evolving_light", "",
      VIEW TERRAIN CLOUD CLOUD "[clouds]\nevolve = 1\nswell = 1\n[[light.key]]\ntime = 0\n"
                               "[[light.key]]\ntime = 9\nazimuth = 80\n" },
    { "evolving_original", "", VIEW CLOUD "[clouds]\nevolve = 3\n[quality]\nclouds = \"original\"\n" },
};

static const double times[] = { 0, 0.4, 1.3, 1.3, 0.4, 7, 0 };
enum { TIMES = sizeof times / sizeof *times };

static lom_renderer *open_renderer(const char *text, lom_scene **scene, lom_error *error)
{
    *scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), NULL, 0, error);
    return *scene != NULL ? lom_create_renderer(*scene, &(lom_device_desc){ .threads = 1, .lanes = 4 }, error) : NULL;
}

static uint64_t draw(lom_renderer *renderer, double time, lom_error *error)
{
    lom_frame frame = { .image = NULL };
    uint64_t hash = 0;
    if (renderer != NULL &&
        lom_render_frame(renderer, &(lom_frame_desc){ .has_time = true, .time = time }, &frame, error))
        hash = lom_hash_image(frame.image);
    lom_free_image(frame.image);
    return hash;
}

static uint64_t draw_alone(const char *text, double time, lom_error *error)
{
    lom_scene *scene;
    lom_renderer *renderer = open_renderer(text, &scene, error);
    uint64_t hash = draw(renderer, time, error);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return hash;
}

static void check_base(const struct base *base)
{
    char text[4096];
    snprintf(text, sizeof text, "%s%s", head, base->text);
    lom_error error = { .code = LOM_OK };
    lom_scene *scene;
    lom_renderer *renderer = open_renderer(text, &scene, &error);
    for (int i = 0; i < TIMES; i++) {
        uint64_t run = draw(renderer, times[i], &error), alone = draw_alone(text, times[i], &error);
        CHECK(run != 0 && run == alone, "%s: at %g s, picture %d of a run has %016llx, alone it has %016llx; %s",
              base->name, times[i], i, (unsigned long long)run, (unsigned long long)alone, error.text);
    }
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static void check_bases(const struct base *of, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strstr(of[i].name, "impostors") == NULL)
            check_base(&of[i]);
}

static void scenes_of_every_key(void)
{
    check_bases(bases, sizeof bases / sizeof *bases);
}

static void scenes_of_changes(void)
{
    check_bases(more_bases, sizeof more_bases / sizeof *more_bases);
}

static void shapes_that_change(void)
{
    check_bases(changing, sizeof changing / sizeof *changing);
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(scenes_of_every_key);
    RUN(scenes_of_changes);
    RUN(shapes_that_change);
    remove_small_scene();
    return check_result();
}
