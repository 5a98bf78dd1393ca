/* What concerns several tables of a scene at once. In: a lom_scene whose tables are filled and checked, and the tree it
 * came from. Out: what one table takes from another. Invariant: afterwards the scene contradicts itself nowhere. */
#include "cloud/cloud_keys.h"
#include "cloud/cloud_sky.h"
#include "scene/reader.h"

#include <lom/shallow.h>

#include <string.h>

/* ---- names ---- */

/* Things of an array that have names. */
struct named {
    const char *table, *sentence;
    const char *first; /* where the name of the first stands; NULL: there is none */
    size_t count, size;
};

static const char *name_of(const struct named *things, size_t i)
{
    const char *name;
    memcpy(&name, things->first + i * things->size, sizeof name);
    return name;
}

static bool check_names(const lom_key_check *root, const struct named *things)
{
    for (size_t i = 0; i < things->count; i++)
        for (size_t j = 0; j < i && name_of(things, i) != NULL; j++)
            if (name_of(things, j) != NULL && strcmp(name_of(things, i), name_of(things, j)) == 0) {
                const lom_key_check at = root->element(root, things->table, i);
                return at.fail(&at, "name", things->sentence);
            }
    return true;
}

#define NAMED(table, sentence, array, count)                                                                           \
    {                                                                                                                  \
        table, sentence, (const char *)(array) + offsetof(__typeof__(*(array)), name), count, sizeof *(array)          \
    }

static bool check_all_names(lom_scene *scene, const lom_key_check *root)
{
    const struct named things[] = {
        NAMED("view", "another view has this name already.", scene->views, scene->view_count),
        NAMED("entity", "another entity has this name already.", scene->entities, scene->entity_count),
        NAMED("lamp", "another lamp has this name already.", scene->lamps, scene->lamp_count),
        NAMED("cloud", "another cloud has this name already.", scene->cloud, scene->cloud_count),
        NAMED("fluid", "another liquid has this name already.", scene->fluids, scene->fluid_count),
        NAMED("spray", "another emitter has this name already.", scene->sprays, scene->spray_count),
    };
    for (size_t i = 0; i < sizeof things / sizeof *things; i++)
        if (!check_names(root, &things[i]))
            return false;
    return true;
}

/* The number of the entity of this name, plus one; 0 when there is none, and for no name. */
static size_t find_entity(const lom_scene *scene, const char *name)
{
    for (size_t i = 0; name != NULL && i < scene->entity_count; i++)
        if (scene->entities[i].name != NULL && strcmp(scene->entities[i].name, name) == 0)
            return i + 1;
    return 0;
}

/* ---- what stands on what ---- */

static bool check_ground(lom_scene *scene, const lom_key_check *root)
{
    const lom_key_check surf = lom_check_inside(root, "surf");
    if (scene->surf.height > 0 && !scene->terrain.present)
        return surf.fail(&surf, "height", "waves come in to a shore: there is no terrain.");
    for (size_t i = 0; i < scene->entity_count; i++)
        if (scene->entities[i].on_ground && !scene->terrain.present) {
            const lom_key_check at = root->element(root, "entity", i);
            return at.fail(&at, "on_ground", "there is no terrain to stand on.");
        }
    return true;
}

static bool check_waters(lom_scene *scene, const lom_key_check *root)
{
    const size_t count = scene->other_water_count;
    const lom_key_check first = lom_check_inside(root, "water");
    if (count > LOM_MAX_OTHER_WATERS) {
        const lom_key_check at = root->element(root, "water", LOM_MAX_OTHER_WATERS + 1);
        return at.fail(&at, "", "a scene has at most 8 waters.");
    }
    for (size_t i = 0; i <= count; i++) {
        lom_water_params *water = i == 0 ? &scene->water : &scene->other_waters[i - 1];
        const lom_key_check at = i == 0 ? first : root->element(root, "water", i);
        if (!at.is_given(&at, "size") && scene->terrain.present)
            memcpy(water->size, scene->terrain.size, sizeof water->size);
        for (size_t k = 0; k < i && water->name != NULL; k++) {
            const char *other = k == 0 ? scene->water.name : scene->other_waters[k - 1].name;
            if (other != NULL && strcmp(other, water->name) == 0)
                return at.fail(&at, "name", "another water has this name already.");
        }
    }
    return true;
}

static bool check_shallow(lom_scene *scene, const lom_key_check *root)
{
    lom_shallow_water *shallow = &scene->shallow;
    const lom_key_check table = lom_check_inside(root, "shallow");
    if (!shallow->present)
        return true;
    if (!scene->water.present)
        return table.fail(&table, "", "shallow water is the surface of [water], which there is not.");
    if (!table.is_given(&table, "position"))
        memcpy(shallow->position, scene->water.position, sizeof shallow->position);
    if (!table.is_given(&table, "size"))
        memcpy(shallow->size, scene->water.size, sizeof shallow->size);
    return true;
}

/* ---- who goes with whom ---- */

static bool check_followed(lom_scene *scene, const lom_key_check *root)
{
    lom_camera *camera = &scene->camera;
    camera->followed = find_entity(scene, camera->follow);
    if (camera->follow != NULL && camera->followed == 0) {
        const lom_key_check table = lom_check_inside(root, "camera");
        return table.fail(&table, "follow", "no entity has this name.");
    }
    for (size_t i = 0; i < scene->view_count; i++) {
        lom_camera *own = &scene->views[i].camera;
        own->followed = find_entity(scene, own->follow);
        if (own->follow != NULL && own->followed == 0) {
            const lom_key_check at = root->element(root, "view", i), table = lom_check_inside(&at, "camera");
            return table.fail(&table, "follow", "no entity has this name.");
        }
    }
    for (size_t i = 0; i < scene->lamp_count; i++) {
        lom_lamp *lamp = &scene->lamps[i];
        lamp->followed = find_entity(scene, lamp->follow);
        if (lamp->follow != NULL && lamp->followed == 0) {
            const lom_key_check at = root->element(root, "lamp", i);
            return at.fail(&at, "follow", "no entity has this name.");
        }
    }
    for (size_t i = 0; i < scene->spray_count; i++) {
        lom_spray *spray = &scene->sprays[i];
        spray->followed = find_entity(scene, spray->entity);
        if (spray->entity != NULL && spray->followed == 0) {
            const lom_key_check at = root->element(root, "spray", i);
            return at.fail(&at, "entity", "no entity has this name.");
        }
    }
    for (size_t i = 0; i < scene->shallow.body_count; i++) {
        lom_shallow_body *body = &scene->shallow.bodies[i];
        body->followed = find_entity(scene, body->entity);
        if (body->entity != NULL && body->followed == 0) {
            const lom_key_check table = lom_check_inside(root, "shallow"), at = table.element(&table, "body", i);
            return at.fail(&at, "entity", "no entity has this name.");
        }
    }
    return true;
}

static bool check_wakes(lom_scene *scene, const lom_key_check *root)
{
    for (size_t i = 0; i < scene->wake_count; i++) {
        lom_water_wake *wake = &scene->wakes[i];
        const lom_key_check at = root->element(root, "wake", i);
        wake->followed = find_entity(scene, wake->entity);
        if (!scene->water.present)
            return at.fail(&at, "", "a wake lies on [water], which there is not.");
        if (wake->followed == 0)
            return at.fail(&at, "entity", "no entity has this name.");
        if (i >= LOM_MAX_WAKES)
            return at.fail(&at, "", "there are at most 16 wakes.");
    }
    return true;
}

/* Each wave throws a drop's next life. */
static bool check_source(const lom_scene *scene, const lom_spray *spray, const lom_key_check *at)
{
    return spray->source != LOM_SPRAY_SURF || !(scene->surf.height > 0) ||
           spray->life + spray->jet_time <= scene->surf.period ||
           at->fail(at, "life",
                    "a drop's life and jet_time together end before the next wave, in surf.period seconds.");
}

static bool check_drops(lom_scene *scene, const lom_key_check *root)
{
    size_t drops = 0;
    for (size_t i = 0; i < scene->spray_count; i++) {
        const lom_key_check table = root->element(root, "spray", i);
        if (!check_source(scene, &scene->sprays[i], &table))
            return false;
        drops += (size_t)scene->sprays[i].count;
        if (drops > LOM_MAX_PARTICLES) {
            const lom_key_check at = root->element(root, "spray", i);
            return at.fail(&at, "count", "the drops of all emitters together are more than 1000000.");
        }
    }
    return true;
}

static bool check_views(const lom_scene *scene, const lom_key_check *root)
{
    if (scene->view_count <= LOM_MAX_VIEWS)
        return true;
    const lom_key_check at = root->element(root, "view", LOM_MAX_VIEWS);
    return at.fail(&at, "name", "a picture has at most 8 views.");
}

static bool check_fluids(const lom_scene *scene, const lom_key_check *root)
{
    if (scene->fluid_count <= LOM_MAX_FLUIDS)
        return true;
    const lom_key_check at = root->element(root, "fluid", LOM_MAX_FLUIDS);
    return at.fail(&at, "low", "a scene has at most 8 liquids.");
}

/* The sky of many that [clouds] asks for, behind the clouds of the file. */
static bool add_sky(lom_scene *scene, lom_reader *reader)
{
    if (!lom_has_sky(&scene->clouds))
        return true;
    lom_cloud pattern = { .present = false },
              *all = lom_allocate(scene->cloud_count + LOM_MAX_SKY, sizeof *all, reader->error);
    size_t count = scene->cloud_count;
    if (all == NULL || !lom_read_table(reader, &lom_cloud_keys, NULL, &pattern)) {
        lom_release(all);
        return false;
    }
    if (count > 0)
        memcpy(all, scene->cloud, count * sizeof *all);
    bool done = lom_place_sky(&scene->clouds, &pattern, all, &count, reader->error);
    lom_cloud *kept =
        done && count > 0 ? lom_arena_take(&scene->memory->arena, count, sizeof *kept, reader->error) : NULL;
    if (kept != NULL) {
        memcpy(kept, all, count * sizeof *kept);
        scene->cloud = kept;
        scene->cloud_count = count;
    }
    lom_release(all);
    return done && (count == 0 || kept != NULL);
}

bool lom_check_scene(lom_reader *reader, const lom_toml_value *root)
{
    const lom_key_check check = lom_check_of(reader, root);
    lom_measure_from_terrain(reader->scene, &check);
    return check_all_names(reader->scene, &check) && check_waters(reader->scene, &check) &&
           check_ground(reader->scene, &check) && check_shallow(reader->scene, &check) &&
           check_followed(reader->scene, &check) && check_wakes(reader->scene, &check) &&
           check_drops(reader->scene, &check) && check_views(reader->scene, &check) &&
           check_fluids(reader->scene, &check) && add_sky(reader->scene, reader);
}
