/* Proves what failing memory does to frames: whichever allocation fails, once or from there on, two frames of a run are
 * the same bytes as without the fault, or there is an error with a sentence; and a frame that is asked for again after
 * one that failed is the same bytes or an error. On tiny scenes that between them have every model of clouds,
 * impostors, waves and water, shallow water, surf, caustics, foam, shadows, key frames, spray, several samples a pixel, and the reference. */
#include "faults.h"

enum { FRAMES = 2, TRIES = 12 };

/* ---- scenes ---- */

static const char head[] = "[output]\nwidth = 16\nheight = 9\nfps = 4\n"
                           "[light]\nazimuth = 130\nelevation = 35\n[sky]\ngradient = true\nsun = true\n";
static const char camera[] = "[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\n";
static const char land[] = "[terrain]\nheight_map = 'height.png'\nsize = 40\nheight = 6\nbase = -3\n"
                           "[[entity]]\nname = 'box'\nmesh = 'box.obj'\nposition = [0, 0.3, 2]\n";
static const char clouds[] =
    "[clouds]\nshadows = true\nevolve = 1\nwind = [{ height = 30, speed = 5, direction = 10 }]\n"
    "[[cloud]]\nkind = 'cumulus_mediocris'\nsize = [30, 12, 20]\nposition = [-5, 10, -20]\nvoxels = [8, 6, 8]\n"
    "[[cloud]]\nkind = 'hemisphere'\nsize = [10, 10, 10]\nposition = [6, 12, -16]\nvoxels = [8, 8, 8]\n";
static const char spray[] =
    "[[spray]]\ncount = 40\nfrom = [-3, 2, 4]\nto = [3, 2, 4]\nvelocity = [0, 2, 0]\nlife = 2\n";
static const char keys[] = "[[camera.key]]\ntime = -1\nposition = [0, 3, 12]\n[[camera.key]]\ntime = 1\n"
                           "position = [1, 3, 12]\n[[light.key]]\ntime = 0\nazimuth = 10\n[[light.key]]\ntime = 1\n"
                           "azimuth = 50\n[[entity.key]]\ntime = 0\n[[entity.key]]\ntime = 1\nposition = [1, 1, 2]\n";
static const char gerstner[] = "[water.waves]\nkind = 'gerstner'\ncount = 4\nlength = [5, 1]\n";
static const char sea[] = "[water.waves]\nkind = 'sea'\nsize = 16\ncascades = 2\npatch = 20\n"
                          "[water.foam]\namount = 1\nthreshold = 1\nwindow = 1\n";
static const char surf[] = "[surf]\nheight = 0.3\nperiod = 2\n";
static const char shallow[] = "[shallow]\nsize = 16\ncells = 12\n[[shallow.spring]]\nposition = [0, 0]\nrate = 3\n"
                              "[[shallow.body]]\nposition = [-2, 2]\nhalf = [2, 1]\nheading = 30\n";

static const char lamps[] =
    "[[lamp]]\nposition = [0, 3, 2]\nrange = 7\n[[lamp.key]]\ntime = 0\n[[lamp.key]]\ntime = 1\n"
    "position = [2, 3, 2]\n[[lamp]]\ndirection = [0, -1, 1]\n[[lamp]]\nposition = [1, 4, 3]\nshadow = true\n";

static const struct frame_scene {
    const char *name;
    const char *tables[8];
    const char *rest;
    const char *format; /* an override, or NULL */
    int least;          /* allocations */
} scenes[] = {
    { "clouds over a lake",
      { camera, land, clouds },
      "[water]\nnormal_map = 'normal.png'\n[quality]\nwater = 'planar'\nterrain_shadows = true\nentity_shadows = 16\n",
      NULL,
      150 },
    { "bounded impostors over a sea",
      { camera, land, clouds, "[water]\nsize = 60\n", sea },
      "[quality]\nclouds = 'forward'\nimpostors = 'bounded'\nwater = 'displaced'\n[quality.impostor]\nlargest = 16\n",
      NULL,
      200 },
    { "impostors of the reference rule, key frames, spray",
      { camera, land, keys, clouds, spray },
      "[quality]\nclouds = 'original'\nimpostors = 'reference'\n"
      "[quality.impostor]\nlargest_reference = 16\nsmallest = 1\n",
      NULL,
      150 },
    { "billboards, one bounce, 16 bits",
      { camera, clouds, spray },
      "[quality]\nclouds = 'billboard'\n",
      "output.format='rgb16'",
      60 },
    { "sprites", { camera, clouds }, "[quality]\nclouds = 'sprites'\n", NULL, 60 },
    { "layers", { camera, clouds }, "[quality]\nclouds = 'layers'\n", "clouds.silver=0.5", 60 },
    { "a river by its normals",
      { camera, land, "[water]\nnormal_map = 'normal.png'\nflow_map = 'color.png'\n" },
      "[water.waves]\nkind = 'flow'\n[water.foam]\nshore_depth = 1\n[quality]\nwater = 'normal_map'\n",
      NULL,
      100 },
    { "surf and caustics",
      { camera, land, "[water]\n", gerstner, surf, spray },
      "[water.optics]\ncaustics = 1\ncaustics_size = 10\ncaustics_texels = 16\n[quality]\nwater = 'displaced'\n",
      NULL,
      100 },
    { "shallow water, marched",
      { camera, land, "[water]\n", shallow, gerstner, clouds },
      "[quality]\nwater = 'marched'\nclouds = 'single'\n",
      NULL,
      100 },
    { "under a sea",
      { "[camera]\nposition = [0, -1.5, 12]\ntarget = [0, -1, 0]\n", land, "[water]\nsize = 60\n", sea },
      "[water.optics]\ncaustics = 1\ncaustics_size = 10\ncaustics_texels = 16\n[quality]\nwater = 'marched'\n",
      NULL,
      100 },
    { "four samples a pixel of a lake, clouds and spray",
      { camera, land, clouds, spray },
      "[water]\nnormal_map = 'normal.png'\n[quality]\nwater = 'planar'\n",
      "output.samples=4",
      150 },
    { "smooth edges of a lake, clouds and spray",
      { camera, land, clouds, spray },
      "[water]\nnormal_map = 'normal.png'\n[quality]\nwater = 'planar'\n",
      "output.edges='smooth'",
      150 },
    { "lamps and maps of materials, heights too",
      { camera, land, lamps },
      "[[entity]]\nmesh = 'box.obj'\n[entity.material]\nemissive = 1\nemissive_map = 'color.png'\nspecular_map = "
      "'color.png'\ngloss_map = 'color.png'\nnormal_map = 'height.png'\n[entity.back]\nnormal_map = 'normal.png'\n",
      NULL,
      60 },
    { "the reference of lamps and maps of materials",
      { camera, land, lamps },
      "[[entity]]\nmesh = 'box.obj'\n[entity.material]\nnormal_map = 'height.png'\ngloss_map = "
      "'color.png'\n[entity.back]\n"
      "emissive_map = 'color.png'\n[quality]\nwater = 'reference'\n[quality.reference]\nsamples = 1\n",
      NULL,
      60 },
    { "a liquid of particles",
      { camera, land, clouds },
      "[[fluid]]\nlow = [-2, 0, -2]\nhigh = [2, 3, 2]\nspacing = 0.4\nviscosity = 0.1\nconductivity = 0.1\nstart = "
      "-0.05\n"
      "[[fluid.block]]\nlow = [-2, 0, -2]\nhigh = [0, 2, 2]\n[[fluid.solid]]\nlow = [1, 0, -1]\nhigh = [2, 1, 1]\n"
      "heats = true\n",
      NULL,
      100 },
    { "tinted water", { camera, land, "[water]\n" }, "[quality]\nwater = 'tinted'\n", "output.format='rgb32f'", 50 },
    { "the reference of a sea, surf, spray and clouds",
      { camera, land, clouds, "[water]\nsize = 60\n", sea, surf },
      "[quality]\nwater = 'reference'\nclouds = 'reference'\n[quality.reference]\nsamples = 1\ndepth = 2\n",
      NULL,
      100 },
    { "the reference of shallow water and a river",
      { camera, land, keys, "[water]\nnormal_map = 'normal.png'\n", shallow },
      "[water.waves]\nkind = 'flow'\n[quality]\nwater = 'reference'\n[quality.reference]\nsamples = 1\ndepth = 2\n",
      NULL,
      60 },
};

static bool write_scene(const struct frame_scene *scene)
{
    char text[4000];
    size_t length = (size_t)snprintf(text, sizeof text, "%s", head);
    for (int i = 0; i < 8 && scene->tables[i] != NULL; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%s", scene->tables[i]);
    snprintf(text + length, sizeof text - length, "%s", scene->rest);
    lom_error error = { 0 };
    bool written = small_text("frame.toml", text, &error);
    CHECK(written, "%s: %s", scene->name, error.text);
    return written;
}

/* ---- the task ---- */

static const struct frame_scene *drawn_scene;
static uint64_t whole_frames[FRAMES]; /* of the first time, without a fault; 0: not yet drawn */

/* After a frame that failed: the same frame again. */
static void ask_again(const char *name, lom_renderer *renderer, int frame)
{
    lom_error error = { 0 };
    lom_frame again;
    if (lom_render_frame(renderer, &(lom_frame_desc){ .frame = frame }, &again, &error))
        CHECK(lom_hash_image(again.image) == whole_frames[frame], "%s, fault %d: frame %d asked for again is another",
              name, fault.at, frame);
    else
        CHECK(error.code != LOM_OK && error.text[0] != 0, "%s, fault %d: asked for again: code %d", name, fault.at,
              error.code);
    lom_free_image(again.image);
}

static bool draw_frames(const char *name, uint64_t *hash, lom_error *error)
{
    lom_scene *scene =
        lom_read_scene(small_path("frame.toml"), &drawn_scene->format, drawn_scene->format != NULL, error);
    lom_renderer *renderer =
        scene != NULL ? lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, error) : NULL;
    bool done = renderer != NULL;
    *hash = LOM_HASH_START;
    for (int i = 0; done && i < FRAMES; i++) {
        lom_frame frame;
        done = lom_render_frame(renderer, &(lom_frame_desc){ .frame = i }, &frame, error);
        uint64_t drawn = done ? lom_hash_image(frame.image) : 0;
        *hash = lom_hash_bytes(*hash, &drawn, sizeof drawn);
        lom_free_image(frame.image);
        if (done && whole_frames[i] == 0)
            whole_frames[i] = drawn;
        if (!done)
            ask_again(name, renderer, i);
    }
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}

static void every_failing_allocation_of_every_scene_is_an_error(void)
{
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        const char *only = getenv("LOM_SCENE");
        if ((only != NULL && strcmp(only, scenes[i].name) != 0) || !write_scene(&scenes[i]))
            continue;
        drawn_scene = &scenes[i];
        memset(whole_frames, 0, sizeof whole_frames);
        fail_memory(draw_frames, scenes[i].name, scenes[i].least, 0, TRIES);
    }
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(every_failing_allocation_of_every_scene_is_an_error);
    remove_small_scene();
    return check_result();
}
