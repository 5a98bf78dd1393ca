/* A tiny scene made of parts and of any keys at any values, drawn at 16 x 9. The first bytes choose the parts, the rest
 * sets keys of the table: to their ends, next to them, or somewhere between. A scene that is refused says why in a
 * line; one that is drawn holds no NaN, and a part of it drawn alone, by other threads and tiles, is the same part.
 *
 * Integers stay small and a few keys are left alone: they choose how much is computed, which is not what this looks
 * for. */
#include <lom/render.h>

#include "../small_scene.h"
#include "key_values.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerInitialize(int *argc, char ***argv);

enum { WIDTH = 16, HEIGHT = 9, MOST_OVERRIDES = 16, MOST_TEXT = 256 };

static const char start[] = "[output]\nwidth = 16\nheight = 9\n[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\n"
                            "[quality]\nentity_shadows = 16\ncloud_jitter = false\n";
/* TOML lets tables follow one another in any order, so any of these may be there. */
static const char *const parts[] = {
    "[terrain]\nheight_map = \"height.png\"\nsize = 40\nheight = 6\nbase = -3\ntexture = \"color.png\"\ntile = 5\n"
    "[[terrain.layer]]\nmap = \"layer.ppm\"\nfrom_height = 0\n",
    "[water]\nlevel = 0\nsize = 40\nnormal_map = \"normal.png\"\n[water.waves]\nsize = 16\ncascades = 1\ncount = 4\n"
    "[water.optics]\ncaustics_texels = 16\n",
    "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n[[entity.key]]\ntime = 1\n",
    "[sky]\npattern = \"sky_%s.png\"\n",
    "[[clouds.wind]]\nheight = 0\nspeed = 3\n[[cloud]]\nkind = \"cumulus_mediocris\"\n"
    "voxels = [8, 8, 8]\nsize = 20\nposition = [0, 5, -20]\n",
    "[[spray]]\ncount = 20\nfrom = [-1, 1, 0]\nto = [1, 1, 0]\nsize = 0.3\n",
    "[haze]\ndensity = 0.01\n",
};
static const char surf[] = "[surf]\nheight = 1\n";
static const char shallow[] = "[shallow]\ncells = 8\nstep = 0.02\n[[shallow.spring]]\nposition = [0, 0]\nrate = 1\n"
                              "[[shallow.body]]\nposition = [0, 0]\nhalf = 2\n";
enum { PARTS = sizeof parts / sizeof *parts };

/* "water.waves.height=0.5", by a walk from the root of the table. */
static bool take_override(fuzz_bytes *in, char text[MOST_TEXT])
{
    const lom_key_table *table = &lom_scene_keys;
    size_t used = 0;
    for (;;) {
        const lom_key *key = &table->keys[take_choice(in, table->key_count)];
        used += (size_t)snprintf(text + used, MOST_TEXT - used, "%s%s", used == 0 ? "" : ".", key->name);
        if (key->type == LOM_KEY_TABLE || key->type == LOM_KEY_TABLES) {
            table = key->table;
            used += (size_t)snprintf(text + used, MOST_TEXT - used, key->type == LOM_KEY_TABLES ? ".0" : "");
            continue;
        }
        if (is_left_alone(text))
            return false;
        used += (size_t)snprintf(text + used, MOST_TEXT - used, "=");
        return take_value(in, key, text + used, MOST_TEXT - used);
    }
}

static void require(bool condition)
{
    if (!condition)
        abort();
}

static lom_scene *take_scene(fuzz_bytes *in, bool *runs_on, lom_error *error)
{
    static char overrides[MOST_OVERRIDES][MOST_TEXT];
    const char *items[MOST_OVERRIDES];
    char text[4096];
    unsigned chosen = take_byte(in);
    *runs_on = take_choice(in, 4) == 1 && (chosen & 3) == 3;
    size_t used = (size_t)snprintf(text, sizeof text, "%s", start);
    for (int i = 0; i < PARTS; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s", chosen >> i & 1 ? parts[i] : "");
    used += (size_t)snprintf(text + used, sizeof text - used, "%s", *runs_on ? shallow : "");
    if ((chosen & 3) == 3) /* waves come in to a shore */
        used += (size_t)snprintf(text + used, sizeof text - used, "%s", surf);
    size_t count = 0;
    lom_scene *scene = lom_decode_scene(text, used, small_path("scene.toml"), NULL, 0, error);
    while (scene != NULL && in->size > 1 && count < MOST_OVERRIDES) {
        items[count] = overrides[count];
        if (!take_override(in, overrides[count]))
            continue;
        lom_error refusal = { 0 };
        lom_scene *next = lom_decode_scene(text, used, small_path("scene.toml"), items, count + 1, &refusal);
        require((next != NULL) == (refusal.code == LOM_OK) && strchr(refusal.text, '\n') == NULL);
        if (next == NULL) /* what does not go with the rest is left out */
            continue;
        lom_free_scene(scene);
        scene = next;
        count++;
    }
    if (getenv("LOM_FUZZ_SHOW") != NULL) {
        fwrite(text, 1, used, stderr);
        for (size_t i = 0; i < count; i++)
            fprintf(stderr, "--set '%s'\n", items[i]);
    }
    return scene;
}

/* One frame, whole or a part, by one of two devices. */
static lom_image *draw(const lom_scene *scene, int frame, lom_rect crop, lom_error *error)
{
    lom_device_desc device = { .threads = crop.width != 0 ? 2 : 1, .lanes = 4, .tile = crop.width != 0 ? 16 : 64 };
    lom_renderer *renderer = lom_create_renderer(scene, &device, error);
    lom_frame drawn = { .image = NULL };
    bool done =
        renderer != NULL &&
        lom_render_frame(renderer, &(lom_frame_desc){ .width = WIDTH, .height = HEIGHT, .frame = frame, .crop = crop },
                         &drawn, error);
    require(done == (drawn.image != NULL) && done == (error->code == LOM_OK) && done == (error->text[0] == 0));
    lom_free_renderer(renderer);
    return drawn.image;
}

static void check_pixels(const lom_image *image)
{
    const lom_format_info *info = lom_describe_format(image->format);
    for (size_t i = 0; info->is_float && i < lom_image_size(image); i += 4) {
        float value;
        memcpy(&value, image->pixels + i, sizeof value);
        require(value - value == 0);
    }
}

static void check_part(const lom_image *whole, const lom_image *part, lom_rect crop)
{
    size_t bytes = (size_t)crop.width * lom_format_size(whole->format);
    require(part->width == crop.width && part->height == crop.height);
    for (int y = 0; y < crop.height; y++)
        require(memcmp(lom_image_pixel(whole, crop.x, crop.y + y, 0), lom_image_pixel(part, 0, y, 0), bytes) == 0);
}

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc;
    (void)argv;
    if (!make_small_scene())
        exit(1);
    atexit(remove_small_scene);
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const int frames[] = { 0, 1, 7, 100000 };
    fuzz_bytes in = { data, size };
    lom_error error = { 0 };
    bool runs_on;
    if (small_folder[0] == 0) /* without libFuzzer nobody calls it */
        LLVMFuzzerInitialize(NULL, NULL);
    int frame = frames[take_choice(&in, 4)];
    lom_rect crop = { take_choice(&in, 9), take_choice(&in, 5), 0, 0 };
    crop.width = 1 + take_choice(&in, WIDTH - crop.x);
    crop.height = 1 + take_choice(&in, HEIGHT - crop.y);
    bool has_part = take_bool(&in);
    lom_scene *scene = take_scene(&in, &runs_on, &error);
    require((scene != NULL) == (error.code == LOM_OK) && strchr(error.text, '\n') == NULL);
    lom_image *whole = scene == NULL ? NULL : draw(scene, runs_on ? frame % 7 : frame, (lom_rect){ 0 }, &error);
    if (whole != NULL) {
        check_pixels(whole);
        lom_image *part = has_part ? draw(scene, runs_on ? frame % 7 : frame, crop, &error) : NULL;
        require(!has_part || part != NULL);
        if (part != NULL)
            check_part(whole, part, crop);
        lom_free_image(part);
    }
    lom_free_image(whole);
    lom_free_scene(scene);
    return 0;
}
