/* Changed keys: flight and lake, one thread: a renderer is created, then given the scene with another value of one key and
 * the scene again, three times: make bench-change. Out: a table of the least processor time, and of the first frame after
 * the change, at 320x180. */
#include <lom/lom.h>

#include <stdio.h>
#include <time.h>

enum { ROUNDS = 3 };

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static double draw(lom_renderer *renderer, lom_error *error)
{
    lom_frame frame;
    double start = now_ms();
    lom_render_frame(renderer, &(lom_frame_desc){ .width = 320, .height = 180 }, &frame, error);
    lom_free_image(frame.image);
    return now_ms() - start;
}

/* A renderer and its scene. */
struct run {
    const char *path;
    lom_renderer *renderer;
    lom_scene *scene;
};

/* Milliseconds of the change; below 0: it failed. */
static double change(struct run *run, const char *override, lom_change *what, lom_error *error)
{
    lom_scene *next = lom_read_scene(run->path, &override, override != NULL, error);
    if (next == NULL)
        return -1;
    double start = now_ms();
    bool done = lom_change_scene(run->renderer, next, what, error);
    double ms = now_ms() - start;
    lom_free_scene(done ? run->scene : next);
    run->scene = done ? next : run->scene;
    return done ? ms : -1;
}

static bool print_row(struct run *run, const char *override, lom_error *error)
{
    static const char *const kinds[] = { "none", "frame", "part", "all" };
    double least = 1e300, frame = 1e300;
    char loaded[160] = "";
    lom_change what = LOM_CHANGE_NONE, back;
    for (int i = 0; i < ROUNDS; i++) {
        double ms = change(run, override, &what, error), drawn = draw(run->renderer, error);
        if (ms < 0)
            return false;
        snprintf(loaded, sizeof loaded, "%s", lom_renderer_loaded(run->renderer));
        least = ms < least ? ms : least;
        frame = drawn < frame ? drawn : frame;
        if (change(run, NULL, &back, error) < 0)
            return false;
        draw(run->renderer, error);
    }
    printf("| `%s` | %s | %s | %.*f | %.0f |\n", override != NULL ? override : "", kinds[what],
           what == LOM_CHANGE_ALL ? "everything" : loaded, least < 10 ? 2 : 0, least, frame);
    fflush(stdout);
    return true;
}

static bool print_scene(const char *path, const char *const *overrides, lom_error *error)
{
    struct run run = { .path = path, .scene = lom_read_scene(path, NULL, 0, error) };
    double start = now_ms();
    run.renderer = run.scene != NULL ? lom_create_renderer(run.scene, &(lom_device_desc){ .threads = 1 }, error) : NULL;
    double created = now_ms() - start;
    bool done = run.renderer != NULL;
    if (done)
        printf("%s: a renderer is created in %.0f ms, and its first frame takes %.0f ms.\n\n"
               "| key | change | loaded | ms | first frame, ms |\n|---|---|---|---|---|\n",
               path, created, draw(run.renderer, error));
    for (int i = 0; done && overrides[i] != NULL; i++)
        done = print_row(&run, overrides[i], error);
    printf("\n");
    lom_free_renderer(run.renderer);
    lom_free_scene(run.scene);
    return done;
}

int main(void)
{
    static const char *const flight[] = { "camera.field_of_view=40",
                                          "light.azimuth=33",
                                          "clouds.brightness=1.5",
                                          "quality.cloud_error=0.1",
                                          "cloud.0.position=[100, 900, 100]",
                                          "cloud.0.extinction=0.07",
                                          "cloud.0.seed=99",
                                          "quality.cloud_light_scale=0.4",
                                          "terrain.height=500",
                                          "quality.mipmaps=false",
                                          "quality.filtering=\"float\"",
                                          NULL };
    static const char *const lake[] = { "camera.field_of_view=40",
                                        "light.azimuth=33",
                                        "water.level=1",
                                        "water.flow=false",
                                        "sky.sun=true",
                                        "entity.0.scale=1.2",
                                        "entity.0.position=[1, 0, 2]",
                                        "terrain.texture=\"\"",
                                        "terrain.height=150",
                                        "quality.ambient_occlusion=false",
                                        "quality.mipmaps=false",
                                        "quality.filtering=\"float\"",
                                        NULL };
    lom_error error = { .code = LOM_OK };
    if (print_scene("assets/scenes/flight.toml", flight, &error) &&
        print_scene("assets/scenes/lake.toml", lake, &error))
        return 0;
    fprintf(stderr, "%s\n", error.text);
    return 2;
}
