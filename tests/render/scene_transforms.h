/* A scene moved, and a scene made larger or smaller, key by key, so that its picture stays the same.
 *
 * Raised: all heights (y) by so many metres; what follows an entity is in the entity's coordinates and stays, and so
 * does what stands on the ground. Scaled by f: a quantity of the dimension L^a T^b is multiplied by f^(a + b/2), for gravity does not scale:
 * a wave f times as long takes sqrt(f) times as long to pass (Froude's law), and so does everything else. The dimensions
 * are those of the units in the tables of keys; the table below has what has no unit there. */
#ifndef LOM_TESTS_SCENE_TRANSFORMS_H
#define LOM_TESTS_SCENE_TRANSFORMS_H

#include "scene/scene_compare.h"
#include "scene/scene_keys.h"

#include <lom/scene.h>

#include <math.h>
#include <string.h>

struct scene_transform {
    double raise; /* metres */
    double scale; /* of lengths */
};

/* Heights: those of a place, or the only number. Numbers in the path of a key are left out: "entity.key.position". */
static const char *const height_keys[] = {
    "camera.position",
    "camera.target",
    "camera.key.position",
    "camera.key.target",
    "view.camera.position",
    "view.camera.target",
    "view.camera.key.position",
    "view.camera.key.target",
    "lamp.position",
    "lamp.key.position",
    "haze.base",
    "terrain.base",
    "terrain.layer.from_height",
    "terrain.layer.to_height",
    "water.level",
    "entity.position",
    "entity.key.position",
    "cloud.position",
    "clouds.wind.height",
    "spray.from",
    "spray.to",
    "fluid.low",
    "fluid.high",
    "fluid.block.low",
    "fluid.block.high",
    "fluid.solid.low",
    "fluid.solid.high",
};

/* Powers of the length by which what has no unit of its own scales, a component each. */
static const struct power_key {
    const char *path;
    double power[3];
} power_keys[] = {
    { "lamp.attenuation", { 0, -1, -2 } },
    { "entity.scale", { 1, 1, 1 } },
    { "quality.normals", { 1 } },
};

static const struct unit_power {
    const char *unit;
    double power;
} unit_powers[] = {
    { "m", 1 }, { "1/m", -1 }, { "m/s", 0.5 }, { "s", 0.5 }, { "1/s", -0.5 }, { "m^2/s", 1.5 }, { "m^3/s", 2.5 },
};

/* Where the walk through the tables is. */
struct transform_walk {
    const struct scene_transform *transform;
    char path[LOM_LONGEST_KEY_PATH];
    bool stays; /* the places of this table are an entity's, or its heights are above the ground */
};

static double find_power(const struct transform_walk *walk, const lom_key *key, int component)
{
    for (size_t i = 0; i < sizeof power_keys / sizeof *power_keys; i++)
        if (strcmp(power_keys[i].path, walk->path) == 0)
            return power_keys[i].power[component];
    for (size_t i = 0; key->unit != NULL && i < sizeof unit_powers / sizeof *unit_powers; i++)
        if (strcmp(unit_powers[i].unit, key->unit) == 0)
            return unit_powers[i].power;
    return 0;
}

static bool is_height(const struct transform_walk *walk)
{
    for (size_t i = 0; !walk->stays && i < sizeof height_keys / sizeof *height_keys; i++)
        if (strcmp(height_keys[i], walk->path) == 0)
            return true;
    return false;
}

static void transform_numbers(const struct transform_walk *walk, const lom_key *key, double *number)
{
    const struct scene_transform *t = walk->transform;
    for (int i = 0; i < (key->count > 1 ? key->count : 1); i++) {
        double power = find_power(walk, key, i < 3 ? i : 2);
        number[i] *= power == 0 ? 1 : pow(t->scale, power);
    }
    if (is_height(walk))
        number[key->count == 3 ? 1 : 0] += t->raise;
}

static void transform_table(struct transform_walk *walk, size_t length, const lom_key_table *table, char *members);

static void transform_array(struct transform_walk *walk, size_t length, const lom_key *key, char *members,
                            size_t offset)
{
    char *first;
    size_t count;
    memcpy(&first, members + offset, sizeof first);
    memcpy(&count, members + key->length_offset, sizeof count);
    for (size_t i = 0; i < count; i++)
        transform_table(walk, length, key->table, first + i * key->table->size);
}

static void transform_key(struct transform_walk *walk, size_t length, const lom_key *key, char *members)
{
    int added = snprintf(walk->path + length, sizeof walk->path - length, "%s%s", length > 0 ? "." : "", key->name);
    size_t longer = length + (size_t)added;
    if (key->type == LOM_KEY_TABLES)
        transform_array(walk, longer, key, members, key->offset);
    else if (key->type == LOM_KEY_TABLE)
        transform_table(walk, longer, key->table, members + key->offset);
    else if (key->type == LOM_KEY_NUMBER)
        transform_numbers(walk, key, (double *)(void *)(members + key->offset));
    if (key->others_offset != 0)
        transform_array(walk, longer, key, members, key->others_offset);
    walk->path[length] = 0;
}

static void transform_table(struct transform_walk *walk, size_t length, const lom_key_table *table, char *members)
{
    const bool stays = walk->stays;
    const lom_camera *camera = (const void *)members;
    const lom_lamp *lamp = (const void *)members;
    const lom_entity *entity = (const void *)members;
    if (strcmp(walk->path, "camera") == 0 || strcmp(walk->path, "view.camera") == 0)
        walk->stays = camera->followed != 0;
    else if (strcmp(walk->path, "lamp") == 0)
        walk->stays = lamp->followed != 0;
    else if (strcmp(walk->path, "entity") == 0)
        walk->stays = entity->on_ground;
    for (int i = 0; i < table->key_count; i++)
        transform_key(walk, length, &table->keys[i], members);
    walk->stays = stays;
}

/* In place; what the reader derived from keys (a falling drop's life) is transformed as its key is. */
static inline void transform_scene(lom_scene *scene, const struct scene_transform *transform)
{
    struct transform_walk walk = { .transform = transform };
    transform_table(&walk, 0, &lom_scene_keys, (char *)scene);
}

#endif
