/* Scenes out of numbers: the small scenes of key_bases.h with more parts, a mesh that gives no numbers among them, and any of
 * their keys at values near and far. Scene n is the same everywhere. */
#ifndef LOM_TESTS_NUMBERED_SCENE_H
#define LOM_TESTS_NUMBERED_SCENE_H

#include "change_bases.h"
#include "fuzz/key_values.h"
#include "key_walk.h"
#include "small_scene.h"

#include <lom/scene.h>

enum { MOST_KEYS = 4000, MOST_OVERRIDES = 8, MOST_TEXT = 300, DECISIONS = 512 };

/* What may come to a scene; what does not go with it is refused, and left out. */
static const char *const parts[] = {
    "[[entity]]\nname = \"wild\"\nmesh = \"wild.obj\"\nposition = [0, 1, 3]\n[entity.material]\nspecular = 0.5\n",
    "[[entity]]\nmesh = \"box.obj\"\nposition = [0, 1, 4]\n[entity.material]\nopacity = 0.5\nspecular = 0.5\n",
    "[[entity]]\nmesh = \"wild.obj\"\nposition = [1, 0, 4]\nscale = 1e-3\ntwo_sided = true\n",
    "[[lamp]]\nposition = [1, 4, 3]\nrange = 9\nshadow = true\n",
    "[haze]\ndensity = 0.02\nheight = 3\nglow = [0.4, 0.2, 0.1]\n",
    "[sky]\ngradient = true\nsun = true\n",
    "[[cloud]]\nkind = \"cumulus_mediocris\"\nvoxels = [8, 8, 8]\nsize = 9\nposition = [0, 4, -6]\n",
    "[[spray]]\ncount = 20\nfrom = [-1, 1, 0]\nto = [1, 1, 0]\nsize = 0.3\n",
    "[water]\nlevel = 0\nsize = 40\nnormal_map = \"normal.png\"\n",
};
static const char *const settings[] = {
    "output.edges='smooth'",
    "output.samples=4",
    "output.samples=2",
    "quality.reflection='toon'",
    "quality.shading='gouraud'",
    "quality.shading='flat'",
    "quality.filtering='fixed'",
    "quality.march='fixed'",
    "quality.entity_shadows=32",
    "output.format='rgb8'",
    "quality.water='displaced'",
    "quality.water='planar'",
    "quality.water='normal_map'",
    "quality.water='tinted'",
    "quality.water='marched'",
    "output.curve='reinhard'",
    "quality.impostors='bounded'",
    "quality.impostors='reference'",
    "quality.clouds='layers'",
    "quality.clouds='original'",
    "quality.clouds='sprites'",
    "quality.clouds='groups'",
    "quality.clouds='billboard'",
    "quality.clouds='forward'",
    "quality.clouds='single'",
    "quality.terrain_shadows=true",
    "quality.wireframe='visible'",
    "quality.normals=1",
    "quality.tessellation=true",
    "quality.anisotropy=4",
    "entity.0.point_size=3",
    "entity.0.material.opacity=0.5",
    "quality.ambient_occlusion=true",
};

/* Corners that coincide, lie in a line, far apart and nearer than floats tell; normals that are none. */
static const char wild_obj[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1e-30 1e-30 0\nv 3e30 1 0\nv -2e30 -3e30 1e30\nv 2 0 0\n"
    "v -1 1.5 0.5\nv 1 1.5 -0.5\nvn 0 0 0\nvn 0 0 1\nvn 1e-30 0 0\nvn 1e30 1e30 1e30\nvn 0 -1 0\n"
    "vt 0 0\nvt 1e30 -1e30\nvt 1 1\nf 1/1/1 2/2/2 3/3/2\nf 1/1/1 4/1/3 5/1/4\nf 1/1/2 2/2/2 8/3/1\n"
    "f 1/1/2 6/2/4 3/3/5\nf 7/1/2 6/2/1 3/3/2\nf 9/1/1 3/3/2 10/2/5\nf 9/1/3 10/2/2 2/1/2\n";

struct recipe {
    uint64_t number;
    const char *name;
    char text[8000], override[MOST_OVERRIDES + 1][MOST_TEXT];
    const char *items[MOST_OVERRIDES + 1];
    size_t count;
    int width, height, frame;
    uint64_t crops;
};

static lom_scene *decode(const struct recipe *r, lom_error *error)
{
    *error = (lom_error){ 0 };
    return lom_decode_scene(r->text, strlen(r->text), small_path("scene.toml"), r->items, r->count, error);
}

static bool decodes(const struct recipe *r)
{
    lom_error error;
    lom_scene *scene = decode(r, &error);
    lom_free_scene(scene);
    return scene != NULL;
}

static void add_part(struct recipe *r, const char *part)
{
    const size_t before = strlen(r->text);
    snprintf(r->text + before, sizeof r->text - before, "%s", part);
    if (!decodes(r))
        r->text[before] = 0;
}

/* The last override is what was just written; it stays if the scene is one. */
static void keep_override(struct recipe *r)
{
    r->items[r->count] = r->override[r->count];
    r->count++;
    if (!decodes(r))
        r->count--;
}

static void add_setting(struct recipe *r, size_t number)
{
    snprintf(r->override[r->count], MOST_TEXT, "%s", settings[number % (sizeof settings / sizeof *settings)]);
    keep_override(r);
}

struct listed_key {
    char path[LONGEST_PATH];
    const lom_key *key;
    const void *member;
};
struct key_list {
    struct listed_key key[MOST_KEYS];
    int count;
};

static void list_key(void *context, const char *path, const lom_key *key, const void *member)
{
    struct key_list *list = context;
    if (member == NULL || list->count == MOST_KEYS || is_left_alone(path))
        return;
    struct listed_key *next = &list->key[list->count++];
    snprintf(next->path, sizeof next->path, "%s", path);
    next->key = key;
    next->member = member;
}

/* Numbers about those that the scene has. */
static void take_near_numbers(fuzz_bytes *in, const struct listed_key *k, char *text, size_t room)
{
    double kept[4] = { 0 };
    const int count = k->key->count > 1 ? k->key->count : 1;
    memcpy(kept, k->member, (size_t)(count < 4 ? count : 4) * sizeof *kept);
    size_t used = (size_t)snprintf(text, room, k->key->count > 1 ? "[" : "");
    for (int i = 0; i < count; i++) {
        const double factor = take_byte(in) / 100.0, more = (take_byte(in) - 127.5) / 64;
        used += (size_t)snprintf(text + used, room - used, "%s%.9g", i > 0 ? ", " : "",
                                 kept[i < 4 ? i : 3] * factor + (take_bool(in) ? more : 0));
    }
    snprintf(text + used, room - used, k->key->count > 1 ? "]" : "");
}

static void take_override(fuzz_bytes *in, struct recipe *r)
{
    static struct key_list list;
    char path[LONGEST_PATH], *text = r->override[r->count];
    lom_error error;
    lom_scene *scene = decode(r, &error);
    if (scene == NULL)
        return;
    list.count = 0;
    walk_keys(&lom_scene_keys, path, 0, scene, list_key, &list);
    const struct listed_key *chosen = &list.key[(unsigned)(take_word(in) % (unsigned)list.count)];
    const size_t used = (size_t)snprintf(text, MOST_TEXT, "%s=", chosen->path);
    bool taken = true;
    if (chosen->key->type == LOM_KEY_NUMBER && take_choice(in, 3) != 0)
        take_near_numbers(in, chosen, text + used, MOST_TEXT - used);
    else
        taken = take_value(in, chosen->key, text + used, MOST_TEXT - used);
    lom_free_scene(scene);
    if (taken)
        keep_override(r);
}

enum { OWN_BASES = sizeof bases / sizeof *bases, ALL_BASES = OWN_BASES + sizeof more_bases / sizeof *more_bases };

static const struct base *numbered_base(size_t i)
{
    return i < OWN_BASES ? &bases[i] : &more_bases[i - OWN_BASES];
}

static void make_recipe(struct recipe *r, uint64_t number)
{
    static const int frames[] = { 0, 1, 3, 0 };
    uint8_t decisions[DECISIONS];
    fuzz_bytes in = { decisions, sizeof decisions };
    for (size_t i = 0; i < sizeof decisions; i++)
        decisions[i] = (uint8_t)lom_random_bits(number, i);
    const struct base *chosen = numbered_base((size_t)(number % ALL_BASES));
    memset(r, 0, sizeof *r);
    r->number = number;
    r->name = chosen->name;
    snprintf(r->text, sizeof r->text, "%s%s", head, chosen->text);
    r->width = 24 + take_choice(&in, 25);
    r->height = 16 + take_choice(&in, 17);
    r->frame = frames[take_choice(&in, 4)];
    r->crops = take_word(&in);
    for (int i = take_choice(&in, 4); i > 0; i--)
        add_part(r, parts[(size_t)take_choice(&in, (int)(sizeof parts / sizeof *parts))]);
    for (int i = take_choice(&in, 4); i > 0; i--)
        add_setting(r, take_byte(&in));
    for (int i = take_choice(&in, MOST_OVERRIDES + 2); i > 0 && r->count < MOST_OVERRIDES; i--)
        take_override(&in, r);
}

static void show(const struct recipe *r)
{
    printf("%s%s, %d x %d, frame %d\n", r->text, r->name, r->width, r->height, r->frame);
    for (size_t i = 0; i < r->count; i++)
        printf("--set '%s'\n", r->items[i]);
    fflush(stdout);
}

#endif
