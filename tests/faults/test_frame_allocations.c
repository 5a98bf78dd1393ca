/* Proves that frames allocate nothing once they are under way: from the third frame of a run on, of every scene of
 * assets/scenes, a frame asks for no memory but that of the picture that is handed out, which becomes the caller's. The
 * frame that goes back to the beginning is left out: there simulations begin anew. */
#include "faults.h"

enum { FRAMES = 6, WARM = 2, AGAIN = 2, WIDTH = 64, HEIGHT = 36 };

/* The struct of a picture and its pixels. */
static int allocations_of_a_picture(lom_format format)
{
    lom_error error = { 0 };
    atomic_store(&fault.calls, 0);
    lom_image *image = lom_create_image(WIDTH, HEIGHT, 1, format, &error);
    lom_free_image(image);
    return atomic_load(&fault.calls);
}

static void check_frames(const char *name, lom_renderer *renderer)
{
    for (int i = 0; i < FRAMES + AGAIN; i++) {
        lom_error error = { 0 };
        lom_frame frame;
        atomic_store(&fault.calls, 0);
        const lom_frame_desc desc = { .width = WIDTH, .height = HEIGHT, .frame = i % FRAMES };
        bool done = lom_render_frame(renderer, &desc, &frame, &error);
        int calls = atomic_load(&fault.calls);
        CHECK(done, "%s: frame %d: %s", name, i % FRAMES, error.text);
        if (!done)
            return;
        int own = allocations_of_a_picture(frame.image->format);
        CHECK(i < WARM || i == FRAMES || calls == own,
              "%s: frame %d, drawn the %s time, allocates %d times, its picture %d times", name, i % FRAMES,
              i < FRAMES ? "first" : "second", calls, own);
        lom_free_image(frame.image);
    }
}

static void check_scene(const char *path)
{
    lom_error error = { 0 };
    lom_scene *scene = lom_read_scene(path, NULL, 0, &error);
    lom_renderer *renderer =
        scene != NULL ? lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error) : NULL;
    CHECK(renderer != NULL, "%s: %s", path, error.text);
    if (renderer != NULL)
        check_frames(path, renderer);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static void frames_allocate_nothing_but_their_picture(void)
{
    const char *only = getenv("LOM_SCENE");
    DIR *folder = opendir("assets/scenes");
    CHECK(folder != NULL, "no assets/scenes: run it where they are");
    fault.at = INT_MAX;
    fault.kind = MEMORY;
    for (struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;) {
        char path[300];
        snprintf(path, sizeof path, "assets/scenes/%.200s", entry->d_name);
        size_t length = strlen(path);
        if (length > 5 && strcmp(path + length - 5, ".toml") == 0 && (only == NULL || strstr(path, only) != NULL))
            check_scene(path);
    }
    fault.kind = NOTHING;
    if (folder != NULL)
        closedir(folder);
}

int main(int argc, char **argv)
{
    RUN(frames_allocate_nothing_but_their_picture);
    return check_result();
}
