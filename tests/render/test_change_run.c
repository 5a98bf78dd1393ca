/* Runs of impostors across scenes: an entity, the camera and the sun that move by lom_change_scene from frame to frame give
 * the bytes of one scene in which they move by key frames, when the frames say that they continue, and show plates again;
 * without that word, or when anything else differs, the run begins anew. */
#include "check.h"
#include "small_scene.h"

enum { FRAMES = 5 };

static const char scene_text[] =
    "[output]\nwidth = 24\nheight = 14\n[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\n%s"
    "[light]\nazimuth = 20\nelevation = 25\n%s[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\n%s"
    "[[cloud]]\nkind = \"cumulus_mediocris\"\nsize = [12, 6, 8]\nposition = [0, 2, -8]\nvoxels = [8, 6, 7]\n"
    "[quality]\nimpostors = \"bounded\"\n[quality.impostor]\nbound = 20\nsun = 30\n";

/* Where all is at the time of a frame: exact, since key frames go straight between such numbers. */
static double part_of(int frame)
{
    return 0.25 * frame;
}

/* The scene whose key frames move what `moves` says ("camera", "sun", "entity"), as a path or as it is at a frame. */
static lom_scene *make_scene(const char *moves, int frame, const char *override)
{
    lom_error error = { .code = LOM_OK };
    static char text[4096];
    char camera[300] = "", sun[300] = "", entity[300] = "";
    const double at = part_of(frame);
    if (frame < 0) {
        snprintf(camera, sizeof camera, "[[camera.key]]\ntime = 0\n[[camera.key]]\ntime = 4\nposition = [4, 3, 12]\n");
        snprintf(sun, sizeof sun, "[[light.key]]\ntime = 0\n[[light.key]]\ntime = 4\nazimuth = 24\n");
        snprintf(entity, sizeof entity, "[[entity.key]]\ntime = 0\n[[entity.key]]\ntime = 4\nposition = [4, 2, 0]\n");
    } else {
        snprintf(camera, sizeof camera, "[[camera.key]]\ntime = 0\nposition = [%g, 3, 12]\n", at);
        snprintf(sun, sizeof sun, "[[light.key]]\ntime = 0\nazimuth = %g\n", 20 + at);
        snprintf(entity, sizeof entity, "[[entity.key]]\ntime = 0\nposition = [%g, %g, 0]\n", at, at / 2);
    }
    snprintf(text, sizeof text, scene_text, strcmp(moves, "camera") == 0 ? camera : "",
             strcmp(moves, "sun") == 0 ? sun : "", strcmp(moves, "entity") == 0 ? entity : "");
    lom_scene *scene =
        lom_decode_scene(text, strlen(text), small_path("run.toml"), &override, override != NULL, &error);
    CHECK(scene != NULL, "%s", error.text);
    return scene;
}

static uint64_t draw(lom_renderer *renderer, int frame, bool continues, int *reused)
{
    lom_error error = { .code = LOM_OK };
    lom_frame drawn = { .image = NULL };
    const lom_frame_desc desc = { .frame = frame, .has_time = true, .time = part_of(frame), .continues = continues };
    CHECK(lom_render_frame(renderer, &desc, &drawn, &error), "%s", error.text);
    uint64_t hash = drawn.image != NULL ? lom_hash_image(drawn.image) : 0;
    *reused = drawn.impostors.reused;
    lom_free_image(drawn.image);
    return hash;
}

/* A run with another scene before each frame but the first; `override` in the last of them. */
static void run_changed(const char *moves, bool continues, const char *override, uint64_t hashes[FRAMES],
                        int reused[FRAMES])
{
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = make_scene(moves, 0, NULL);
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, NULL, &error) : NULL;
    CHECK(renderer != NULL, "%s", error.text);
    for (int i = 0; renderer != NULL && i < FRAMES; i++) {
        lom_scene *next = make_scene(moves, i, i == FRAMES - 1 ? override : NULL);
        CHECK(next != NULL && lom_change_scene(renderer, next, NULL, &error), "%s", error.text);
        lom_free_scene(scene);
        scene = next;
        hashes[i] = draw(renderer, i, continues && i > 0, &reused[i]);
    }
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

static const char *const moving[] = { "camera", "sun", "entity" };

static void a_run_goes_on_over_what_moves(void)
{
    for (int m = 0; m < 3; m++) {
        lom_error error = { .code = LOM_OK };
        uint64_t hashes[FRAMES] = { 0 };
        int reused[FRAMES] = { 0 }, again;
        run_changed(moving[m], true, NULL, hashes, reused);
        lom_scene *whole = make_scene(moving[m], -1, NULL);
        lom_renderer *renderer = whole != NULL ? lom_create_renderer(whole, NULL, &error) : NULL;
        CHECK(renderer != NULL, "%s", error.text);
        for (int i = 0; renderer != NULL && i < FRAMES; i++) {
            uint64_t expected = draw(renderer, i, i > 0, &again);
            CHECK(hashes[i] == expected && reused[i] == again,
                  "%s, frame %d: %016llx and %d plates shown again, not %d", moving[m], i,
                  (unsigned long long)hashes[i], reused[i], again);
            CHECK(i == 0 || again > 0, "%s, frame %d: no plate is shown again", moving[m], i);
            CHECK(i == 0 || hashes[i] != hashes[i - 1], "%s, frame %d: nothing has moved", moving[m], i);
        }
        lom_free_renderer(renderer);
        lom_free_scene(whole);
    }
}

static void else_it_begins_anew(void)
{
    static const char *const others[] = { "light.intensity=0.5", "quality.cloud_octaves=2", "haze.height=9" };
    for (int m = 0; m < 3; m++) {
        uint64_t hashes[FRAMES] = { 0 };
        int reused[FRAMES] = { 0 };
        run_changed(moving[m], false, NULL, hashes, reused);
        for (int i = 0; i < FRAMES; i++)
            CHECK(reused[i] == 0, "%s, frame %d goes on without the word", moving[m], i);
        run_changed(moving[m], true, others[m], hashes, reused);
        CHECK(reused[FRAMES - 2] > 0 && reused[FRAMES - 1] == 0, "%s and %s: it goes on", moving[m], others[m]);
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(a_run_goes_on_over_what_moves);
    RUN(else_it_begins_anew);
    remove_small_scene();
    return check_result();
}
