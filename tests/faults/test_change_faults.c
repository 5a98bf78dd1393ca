/* Proves what failing memory and missing files do to a change of the scene: whichever allocation fails, once or from there
 * on, the renderer draws the scene of before with the same bytes, and takes the next one when it is asked again. And what
 * a change costs: one that frames alone look up opens no file and takes a hundredth of the memory of loading, one cloud
 * that is moved takes none of the others'. */
#include "faults.h"

enum { TRIES = 8 };

static const char text[] =
    "[output]\nwidth = 16\nheight = 9\nfps = 4\n[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\n"
    "[light]\nazimuth = 130\nelevation = 35\n[sky]\npattern = 'sky_%s.png'\nsun = true\n"
    "[terrain]\nheight_map = 'height.png'\nsize = 40\nheight = 6\nbase = -3\ntexture = 'color.png'\n"
    "[[terrain.layer]]\nmap = 'layer.ppm'\nfrom_height = 0\n"
    "[[entity]]\nname = 'box'\nmesh = 'box.obj'\nposition = [0, 0.3, 2]\n"
    "[clouds]\nshadows = false\n"
    "[[cloud]]\nkind = 'cumulus_mediocris'\nsize = [30, 12, 20]\nposition = [-5, 10, -20]\nvoxels = [8, 6, 8]\n"
    "[[cloud]]\nkind = 'hemisphere'\nsize = [10, 10, 10]\nposition = [6, 12, -16]\nvoxels = [8, 8, 8]\n"
    "[[spray]]\ncount = 40\nfrom = [-3, 2, 4]\nto = [3, 2, 4]\nvelocity = [0, 2, 0]\nlife = 2\n"
    "[water]\nnormal_map = 'normal.png'\n[water.waves]\nkind = 'sea'\nsize = 16\ncascades = 2\npatch = 20\n"
    "[water.foam]\namount = 1\n[water.optics]\ncaustics = 1\ncaustics_texels = 16\n"
    "[quality]\nwater = 'displaced'\nimpostors = 'bounded'\ncloud_jitter = false\n[quality.impostor]\nlargest = 16\n";

static lom_scene *decode(const char *change)
{
    lom_error error = { 0 };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), &change, change != NULL, &error);
    CHECK(scene != NULL, "%s: %s", change, error.text);
    return scene;
}

/* The hashes of two frames of a run; 0 when one is not drawn. */
static uint64_t draw(lom_renderer *renderer)
{
    uint64_t hash = LOM_HASH_START;
    for (int i = 0; i < 2; i++) {
        lom_frame frame;
        if (!lom_render_frame(renderer, &(lom_frame_desc){ .frame = i }, &frame, NULL))
            return 0;
        uint64_t drawn = lom_hash_image(frame.image);
        hash = lom_hash_bytes(hash, &drawn, sizeof drawn);
        lom_free_image(frame.image);
    }
    return hash;
}

static lom_renderer *create(const lom_scene *scene)
{
    return lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, NULL);
}

static uint64_t draw_fresh(const char *change)
{
    lom_scene *scene = decode(change);
    lom_renderer *renderer = scene != NULL ? create(scene) : NULL;
    uint64_t hash = renderer != NULL ? draw(renderer) : 0;
    CHECK(hash != 0, "%s is not drawn", change);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return hash;
}

/* ---- faults ---- */

static struct {
    lom_renderer *renderer; /* of the scene as it is */
    lom_scene *scene, *next;
    uint64_t own, expected;
} c;

/* The change alone may fail. Afterwards the scene is again what it was. */
static bool change_scene(const char *name, uint64_t *hash, lom_error *error)
{
    lom_change done;
    bool changed = lom_change_scene(c.renderer, c.next, &done, error);
    fault_kind kind = fault.kind;
    fault.kind = NOTHING;
    *hash = changed ? done : 0;
    CHECK(changed || done == LOM_CHANGE_NONE, "%s, fault %d: not changed, and change %d", name, fault.at, (int)done);
    uint64_t drawn = draw(c.renderer);
    CHECK(drawn == (changed ? c.expected : c.own), "%s, fault %d: other frames after %s", name, fault.at,
          changed ? "the change" : "a failure");
    lom_error none = { 0 };
    if (!changed)
        CHECK(lom_change_scene(c.renderer, c.next, NULL, &none) && draw(c.renderer) == c.expected,
              "%s, fault %d: asked again: %s", name, fault.at, none.text);
    CHECK(lom_change_scene(c.renderer, c.scene, NULL, &none) && draw(c.renderer) == c.own, "%s, fault %d: back: %s",
          name, fault.at, none.text);
    fault.kind = kind;
    return changed;
}

static void every_failing_allocation_leaves_the_scene_of_before(void)
{
    static const struct {
        const char *change;
        int least; /* allocations */
    } cases[] = { { "cloud.0.extinction=0.09", 3 }, { "cloud.1.seed=7", 5 },   { "terrain.height=9", 40 },
                  { "entity.0.scale=2", 5 },        { "water.level=0.2", 10 }, { "sky.sun_rays=1", 3 },
                  { "quality.mipmaps=false", 40 },  { "spray.0.count=50", 5 }, { "quality.filtering='float'", 150 } };
    c.scene = decode(NULL);
    c.renderer = create(c.scene);
    c.own = draw(c.renderer);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        c.expected = draw_fresh(cases[i].change);
        c.next = decode(cases[i].change);
        change_scene(cases[i].change, &(uint64_t){ 0 }, NULL); /* so that what frames keep is there */
        fail_memory(change_scene, cases[i].change, cases[i].least, 0, TRIES);
        lom_free_scene(c.next);
    }
    lom_free_renderer(c.renderer);
    lom_free_scene(c.scene);
}

static void a_file_that_is_gone_leaves_the_scene_of_before(void)
{
    static const char *const changes[] = { "terrain.texture='gone.png'", "entity.0.mesh='gone.obj'",
                                           "terrain.height_map='gone.png'", "water.flow_map='gone.png'" };
    lom_scene *scene = decode(NULL);
    lom_renderer *renderer = create(scene);
    uint64_t own = draw(renderer);
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        const char *name = strchr(changes[i], '\'') + 1;
        char file[32] = "";
        memcpy(file, name, strlen(name) - 1);
        CHECK(small_text(file, "", NULL), "%s cannot be written", file);
        const char *const overrides[] = { changes[i], "output.fps=9", "output.width=20" };
        lom_scene *next = lom_decode_scene(text, strlen(text), small_path("scene.toml"), overrides, 3, NULL);
        unlink(small_path(file));
        lom_error error = { 0 };
        lom_change done = LOM_CHANGE_ALL;
        CHECK(next != NULL && !lom_change_scene(renderer, next, &done, &error) && done == LOM_CHANGE_NONE,
              "%s: changed", changes[i]);
        CHECK(error.code == LOM_ERROR_FILE && strstr(error.text, file) != NULL, "%s: %d, %s", changes[i],
              (int)error.code, error.text);
        lom_free_scene(next);
        CHECK(draw(renderer) == own, "%s: other frames after the failure", changes[i]);
    }
    lom_free_renderer(renderer);
    lom_free_scene(scene);
}

/* ---- costs ---- */

struct cost {
    long long bytes;
    int opened;
};

static struct cost cost_since(struct cost before)
{
    return (struct cost){ atomic_load(&fault.bytes) - before.bytes, atomic_load(&fault.opened) - before.opened };
}

static struct cost cost_of_change(lom_renderer *renderer, lom_scene **scene, const char *path, const char *override,
                                  lom_change expected)
{
    lom_error error = { 0 };
    lom_change done = LOM_CHANGE_NONE;
    lom_scene *next = lom_read_scene(path, &override, override != NULL, &error);
    CHECK(next != NULL, "%s", error.text);
    struct cost before = cost_since((struct cost){ 0, 0 });
    CHECK(next != NULL && lom_change_scene(renderer, next, &done, &error), "%s, %s: %s", path, override, error.text);
    struct cost cost = cost_since(before);
    CHECK(done == expected, "%s, %s: change %d (%s) instead of %d", path, override, (int)done,
          lom_renderer_loaded(renderer), (int)expected);
    lom_free_scene(*scene);
    *scene = next;
    return cost;
}

static void changes_of_the_demo_scenes_cost_what_they_must(void)
{
    static const struct {
        const char *path, *frame, *part;
    } cases[] = { { "assets/scenes/lake.toml", "light.azimuth=40", "entity.0.scale=1.1" },
                  { "assets/scenes/flight.toml", "clouds.brightness=1.5", "cloud.0.extinction=0.07" } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct cost before = cost_since((struct cost){ 0, 0 });
        lom_scene *scene = lom_read_scene(cases[i].path, NULL, 0, NULL);
        lom_renderer *renderer = scene != NULL ? create(scene) : NULL;
        struct cost all = cost_since(before);
        CHECK(renderer != NULL && all.opened > 5 && all.bytes > 1000000, "%s: %d files", cases[i].path, all.opened);
        if (renderer == NULL)
            return;
        struct cost none = cost_of_change(renderer, &scene, cases[i].path, NULL, LOM_CHANGE_NONE);
        struct cost frame = cost_of_change(renderer, &scene, cases[i].path, cases[i].frame, LOM_CHANGE_FRAME);
        cost_of_change(renderer, &scene, cases[i].path, NULL, LOM_CHANGE_FRAME);
        struct cost part = cost_of_change(renderer, &scene, cases[i].path, cases[i].part, LOM_CHANGE_PART);
        printf("  %s: loading %lld bytes, %d files; %s %lld, %d; %s %lld, %d\n", cases[i].path, all.bytes, all.opened,
               cases[i].frame, frame.bytes, frame.opened, cases[i].part, part.bytes, part.opened);
        CHECK(none.opened == 0 && none.bytes == 0, "nothing: %lld bytes, %d files", none.bytes, none.opened);
        CHECK(frame.opened == 0 && frame.bytes < all.bytes / 100, "%lld bytes, %d files", frame.bytes, frame.opened);
        CHECK(part.bytes < all.bytes / 4, "%lld bytes", part.bytes);
        lom_free_renderer(renderer);
        lom_free_scene(scene);
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(every_failing_allocation_leaves_the_scene_of_before);
    RUN(a_file_that_is_gone_leaves_the_scene_of_before);
    RUN(changes_of_the_demo_scenes_cost_what_they_must);
    remove_small_scene();
    return check_result();
}
