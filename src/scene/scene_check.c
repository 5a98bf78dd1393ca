/* What concerns several keys of a scene at once. In: a filled lom_scene and the tree it came from. Out: directions,
 * file names and sizes worked out from what the file gives. Invariant: afterwards the scene contradicts itself nowhere.
 */
#include "scene/reader.h"
#include "sky/face_mark.h"
#include "waves/sea_desc.h"

#include <lom/shallow.h>

#include <stdio.h>
#include <string.h>

static const double right_angle_limit = 1e-6; /* least sine between a direction of view and up */
static const double least_interval = 1e-6;    /* seconds between key frames, so that slopes stay finite */

/* ---- places ---- */

static const lom_toml_value *child(const lom_toml_value *table, const char *key)
{
    return lom_toml_find(table, key, strlen(key));
}

/* Element i of the array of tables under key. */
static const lom_toml_value *element(const lom_toml_value *table, const char *key, size_t i)
{
    const lom_toml_value *list = child(table, key);
    return list != NULL && list->type == LOM_TOML_ARRAY && i < list->count ? list->items[i] : NULL;
}

/* Fails at the value of key in table, or where the table is, or at the start of the file. */
static bool fail_at(lom_reader *reader, const lom_toml_value *root, const lom_toml_value *table, const char *key,
                    const char *sentence)
{
    const lom_toml_value *value = child(table, key);
    value = value != NULL ? value : table != NULL ? table : root;
    return lom_toml_fail(value->source, value->offset, LOM_ERROR_INPUT, reader->error, "%s", sentence);
}

/* ---- vectors ---- */

static lom_vec3 combine(double a, lom_vec3 u, double b, lom_vec3 v)
{
    return (lom_vec3){ a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z };
}

static lom_vec3 cross(lom_vec3 u, lom_vec3 v)
{
    return (lom_vec3){ u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x };
}

/* The unit vector along v; false when v is 0. Scaled by the largest component first, so that no square overflows. */
static bool normalize(lom_vec3 *v)
{
    double x = __builtin_fabs(v->x), y = __builtin_fabs(v->y), z = __builtin_fabs(v->z);
    double largest = x > y ? x : y;
    largest = largest > z ? largest : z;
    if (!(largest > 0 && largest - largest == 0))
        return false;
    lom_vec3 scaled = { v->x / largest, v->y / largest, v->z / largest };
    double length = lom_double_sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
    *v = (lom_vec3){ scaled.x / length, scaled.y / length, scaled.z / length };
    return true;
}

/* ---- [camera] ---- */

/* Direction of view and up of a camera with M = Ry(yaw) Rx(pitch) Rz(roll), which looks along its -z. */
static void aim(lom_camera *camera)
{
    double sy = lom_double_sin(camera->yaw), cy = lom_double_cos(camera->yaw);
    double sp = lom_double_sin(camera->pitch), cp = lom_double_cos(camera->pitch);
    lom_vec3 forward = { -sy * cp, sp, -cy * cp };
    camera->target = combine(1, camera->position, 1, forward);
    camera->up = (lom_vec3){ sy * sp, cp, cy * sp };
}

/* True when a camera can look from position to target with this up. */
static bool can_look(lom_vec3 position, lom_vec3 target, lom_vec3 up)
{
    lom_vec3 forward = combine(1, target, -1, position);
    if (!normalize(&forward) || !normalize(&up))
        return false;
    lom_vec3 side = cross(forward, up);
    return side.x * side.x + side.y * side.y + side.z * side.z > right_angle_limit * right_angle_limit;
}

/* Turns up about the direction of view: column y of the camera's matrix times Rz(roll). */
static void roll(lom_camera *camera)
{
    lom_vec3 forward = combine(1, camera->target, -1, camera->position);
    normalize(&forward);
    lom_vec3 side = cross(forward, camera->up);
    normalize(&side);
    camera->up = combine(-lom_double_sin(camera->roll), side, lom_double_cos(camera->roll), cross(side, forward));
}

static bool check_time(lom_reader *reader, const lom_toml_value *root, const lom_toml_value *place, double before,
                       double time)
{
    return time - before >= least_interval ||
           fail_at(reader, root, place, "time", "the times of keys must rise, by a millionth of a second or more.");
}

static bool check_camera_keys(lom_reader *reader, const lom_toml_value *root)
{
    lom_camera *camera = &reader->scene->camera;
    for (size_t i = 0; i < camera->key_count; i++) {
        const lom_toml_value *place = element(child(root, "camera"), "key", i);
        lom_camera_key *key = &camera->keys[i];
        if (child(place, "position") == NULL)
            key->position = camera->position;
        if (child(place, "target") == NULL)
            key->target = camera->target;
        if (child(place, "field_of_view") == NULL)
            key->field_of_view = camera->field_of_view;
        if (i > 0 && !check_time(reader, root, place, camera->keys[i - 1].time, key->time))
            return false;
        if (!can_look(key->position, key->target, camera->up))
            return fail_at(reader, root, place, "target",
                           "the camera cannot look there: target is its position, or lies along up.");
    }
    return true;
}

static bool check_camera(lom_reader *reader, const lom_toml_value *root)
{
    lom_camera *camera = &reader->scene->camera;
    const lom_toml_value *table = child(root, "camera");
    bool turned = child(table, "yaw") != NULL || child(table, "pitch") != NULL;
    if (turned && child(table, "target") != NULL)
        return fail_at(reader, root, table, child(table, "yaw") != NULL ? "yaw" : "pitch",
                       "the camera has either a target or yaw and pitch, not both.");
    if (turned && child(table, "up") != NULL)
        return fail_at(reader, root, table, "up", "yaw and pitch say what is up; use roll to turn the picture.");
    if (turned)
        aim(camera);
    if (!can_look(camera->position, camera->target, camera->up))
        return fail_at(reader, root, table, child(table, "target") != NULL ? "target" : "position",
                       "the camera cannot look there: target is its position, or lies along up.");
    normalize(&camera->up);
    if (child(table, "roll") != NULL)
        roll(camera);
    return check_camera_keys(reader, root);
}

/* ---- [light] ---- */

static bool check_light_keys(lom_reader *reader, const lom_toml_value *root)
{
    const lom_light *light = &reader->scene->light;
    for (size_t i = 0; i < light->key_count; i++) {
        const lom_toml_value *place = element(child(root, "light"), "key", i);
        lom_light_key *key = &light->keys[i];
        if (child(place, "azimuth") == NULL)
            key->azimuth = light->azimuth;
        if (child(place, "elevation") == NULL)
            key->elevation = light->elevation;
        if (child(place, "color") == NULL)
            memcpy(key->color, light->color, sizeof key->color);
        if (child(place, "intensity") == NULL)
            key->intensity = light->intensity;
        if (i > 0 && !check_time(reader, root, place, light->keys[i - 1].time, key->time))
            return false;
    }
    return true;
}

static bool check_light(lom_reader *reader, const lom_toml_value *root)
{
    lom_light *light = &reader->scene->light;
    const lom_toml_value *table = child(root, "light");
    bool stands = child(table, "azimuth") != NULL || child(table, "elevation") != NULL;
    if (child(table, "ground") == NULL)
        memcpy(light->ground, light->ambient, sizeof light->ground);
    if (child(table, "direction") == NULL) {
        light->direction = lom_sunlight_direction(light->azimuth, light->elevation);
    } else if (stands) {
        return fail_at(reader, root, table, "direction",
                       "the light has either a direction or azimuth and elevation, not both.");
    }
    if (!normalize(&light->direction))
        return fail_at(reader, root, table, "direction", "the light's direction must not be zero.");
    return check_light_keys(reader, root);
}

/* ---- [sky] ---- */

/* The pattern with name in the place of its %s, as a path of the scene. */
static const char *face_path(lom_reader *reader, const lom_toml_value *value, const char *pattern, const char *name)
{
    const char *mark = lom_face_mark(pattern);
    size_t before = (size_t)(mark - pattern), length = strlen(pattern) - 2 + strlen(name);
    char *text = lom_arena_take(reader->tree, length + 1, 1, reader->error);
    if (text == NULL)
        return NULL;
    snprintf(text, length + 1, "%.*s%s%s", (int)before, pattern, name, mark + 2);
    return lom_read_path(reader, value, text, length);
}

static bool check_sky(lom_reader *reader, const lom_toml_value *root)
{
    static const char *const names[6] = { "right", "left", "top", "bottom", "front", "back" };
    lom_sky_params *sky = &reader->scene->sky;
    const lom_toml_value *table = child(root, "sky");
    bool has_faces = sky->faces[0] != NULL;
    for (int i = 1; i < 6; i++)
        if ((sky->faces[i] != NULL) != has_faces)
            return fail_at(reader, root, table, "faces", "\"faces\" must name all six pictures, or be left out.");
    if (sky->pattern == NULL)
        return true;
    if (has_faces)
        return fail_at(reader, root, table, "pattern", "the sky has either a pattern or faces, not both.");
    if (lom_face_mark(sky->pattern) == NULL)
        return fail_at(reader, root, table, "pattern", "\"pattern\" must have one %s, for right, left, top, ...");
    for (int i = 0; i < 6; i++) {
        sky->faces[i] = face_path(reader, child(table, "pattern"), sky->pattern, names[i]);
        if (sky->faces[i] == NULL)
            return false;
    }
    return true;
}

/* ---- [terrain], [water], [[entity]] ---- */

static bool check_terrain(lom_reader *reader, const lom_toml_value *root)
{
    const lom_terrain *terrain = &reader->scene->terrain;
    const lom_toml_value *table = child(root, "terrain");
    if (terrain->given != 0 && terrain->height_map == NULL)
        return fail_at(reader, root, table, "height_map", "the terrain needs a height map.");
    for (size_t i = 0; i < terrain->layer_count; i++) {
        const lom_terrain_layer *layer = &terrain->layers[i];
        const lom_toml_value *place = element(table, "layer", i);
        if (layer->map == NULL)
            return fail_at(reader, root, place, "map", "a layer needs a map.");
        if (layer->from_height > layer->to_height)
            return fail_at(reader, root, place, "from_height", "\"from_height\" must not be above \"to_height\".");
        if (layer->from_slope > layer->to_slope)
            return fail_at(reader, root, place, "from_slope", "\"from_slope\" must not be above \"to_slope\".");
    }
    return true;
}

/* A sea has to be one that can be made: what no key's range says is where its description fails. */
static bool check_waves(lom_reader *reader, const lom_toml_value *root, const lom_toml_value *table)
{
    const lom_water_waves *waves = &reader->scene->water.waves;
    if (waves->length[0] < waves->length[1])
        return fail_at(reader, root, table, "length", "the longest wave comes first, then the shortest.");
    if (reader->scene->surf.height > 0 && reader->scene->terrain.given == 0)
        return fail_at(reader, root, child(root, "surf"), "height", "waves come in to a shore: there is no terrain.");
    if (waves->kind != LOM_WAVES_SEA)
        return true;
    lom_error error = { 0 };
    lom_sea_desc desc = lom_scene_sea(waves), resolved;
    if (waves->wind_level != NULL && lom_find_wind_level(waves->wind_level, &error) == NULL)
        return fail_at(reader, root, table, "wind_level", error.text);
    if ((waves->size & (waves->size - 1)) != 0)
        return fail_at(reader, root, table, "size", "the samples a side of a patch are a power of two.");
    return lom_resolve_sea(&desc, &resolved, &error) || fail_at(reader, root, table, "patch", error.text);
}

static bool check_water(lom_reader *reader, const lom_toml_value *root)
{
    lom_scene *scene = reader->scene;
    if (child(child(root, "water"), "size") == NULL && scene->terrain.given != 0)
        memcpy(scene->water.size, scene->terrain.size, sizeof scene->water.size);
    lom_water_optics *optics = &scene->water.optics;
    const lom_toml_value *given = child(child(root, "water"), "optics");
    double absorption[3], scatter[3];
    lom_water_type_optics((lom_water_type)optics->type, absorption, scatter);
    if (child(given, "absorption") == NULL)
        memcpy(optics->absorption, absorption, sizeof absorption);
    if (child(given, "scatter") == NULL)
        memcpy(optics->scatter, scatter, sizeof scatter);
    return check_waves(reader, root, child(child(root, "water"), "waves"));
}

static bool check_entity_keys(lom_reader *reader, const lom_toml_value *root, const lom_toml_value *table,
                              lom_entity *entity)
{
    for (size_t i = 0; i < entity->key_count; i++) {
        const lom_toml_value *place = element(table, "key", i);
        lom_entity_key *key = &entity->keys[i];
        if (child(place, "position") == NULL)
            key->position = entity->position;
        if (child(place, "rotation") == NULL)
            key->rotation = entity->rotation;
        if (i > 0 && !check_time(reader, root, place, entity->keys[i - 1].time, key->time))
            return false;
    }
    if (entity->key_count != 0 && entity->on_ground)
        return fail_at(reader, root, table, "on_ground", "an entity with keys does not stand on the ground.");
    return true;
}

/* The number of the entity of this name, plus one; 0 when there is none. */
static size_t find_entity(const lom_scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->entity_count; i++)
        if (scene->entities[i].name != NULL && strcmp(scene->entities[i].name, name) == 0)
            return i + 1;
    return 0;
}

static bool check_bodies(lom_reader *reader, const lom_toml_value *root)
{
    lom_scene *scene = reader->scene;
    for (size_t i = 0; i < scene->shallow.body_count; i++) {
        lom_shallow_body *body = &scene->shallow.bodies[i];
        const lom_toml_value *place = element(child(root, "shallow"), "body", i);
        if (body->entity == NULL && child(place, "position") == NULL)
            return fail_at(reader, root, place, "entity", "a body needs a position or an entity.");
        body->followed = body->entity == NULL ? 0 : find_entity(scene, body->entity);
        if (body->entity != NULL && body->followed == 0)
            return fail_at(reader, root, place, "entity", "no entity has this name.");
        if (body->every > 0 && !(body->duration > 0 && body->duration <= body->every))
            return fail_at(reader, root, place, "every", "it dips in again after its duration, which is above 0.");
    }
    return true;
}

static bool check_shallow(lom_reader *reader, const lom_toml_value *root)
{
    lom_scene *scene = reader->scene;
    lom_shallow_water *shallow = &scene->shallow;
    const lom_toml_value *table = child(root, "shallow");
    if (shallow->given == 0)
        return true;
    if (scene->water.given == 0)
        return fail_at(reader, root, table, "", "shallow water is the surface of [water], which there is not.");
    if (child(table, "position") == NULL)
        memcpy(shallow->position, scene->water.position, sizeof shallow->position);
    if (child(table, "size") == NULL)
        memcpy(shallow->size, scene->water.size, sizeof shallow->size);
    if (shallow->spring_count > LOM_SHALLOW_SOURCES)
        return fail_at(reader, root, table, "spring", "there are at most 64 springs.");
    if (shallow->body_count > LOM_SHALLOW_OBSTACLES)
        return fail_at(reader, root, table, "body", "there are at most 64 bodies.");
    return check_bodies(reader, root);
}

static bool check_follow(lom_reader *reader, const lom_toml_value *root)
{
    lom_scene *scene = reader->scene;
    lom_camera *camera = &scene->camera;
    camera->followed = camera->follow == NULL ? 0 : find_entity(scene, camera->follow);
    if (camera->follow != NULL && camera->followed == 0)
        return fail_at(reader, root, child(root, "camera"), "follow", "no entity has this name.");
    return true;
}

static bool check_entities(lom_reader *reader, const lom_toml_value *root)
{
    const lom_scene *scene = reader->scene;
    for (size_t i = 0; i < scene->entity_count; i++) {
        const lom_entity *entity = &scene->entities[i];
        const lom_toml_value *place = element(root, "entity", i);
        if (entity->mesh == NULL)
            return fail_at(reader, root, place, "mesh", "an entity needs a mesh.");
        if (entity->on_ground && scene->terrain.given == 0)
            return fail_at(reader, root, place, "on_ground", "there is no terrain to stand on.");
        for (size_t j = 0; j < i && entity->name != NULL; j++)
            if (scene->entities[j].name != NULL && strcmp(scene->entities[j].name, entity->name) == 0)
                return fail_at(reader, root, place, "name", "another entity has this name already.");
        if (!check_entity_keys(reader, root, place, &scene->entities[i]))
            return false;
    }
    return check_follow(reader, root);
}

/* ---- [[cloud]] ---- */

/* What the file leaves to the kind. */
static bool fill_cloud(lom_reader *reader, const lom_toml_value *root, const lom_toml_value *place, lom_cloud *cloud)
{
    if (cloud->file != NULL && cloud->kind != NULL)
        return fail_at(reader, root, place, "file", "a cloud has either a kind or a file, not both.");
    if (cloud->file != NULL)
        return true;
    if (cloud->kind == NULL)
        cloud->kind = "cumulus_mediocris";
    lom_error unknown = { 0 };
    const lom_cloud_kind *kind = lom_find_cloud_kind(cloud->kind, &unknown);
    if (kind == NULL)
        return fail_at(reader, root, place, "kind", unknown.text);
    if (child(place, "size") == NULL)
        memcpy(cloud->size, kind->size, sizeof cloud->size);
    if (child(place, "extinction") == NULL)
        cloud->extinction = kind->extinction;
    for (int i = 0; i < 3; i++) {
        if (cloud->voxels[i] != lom_double_floor(cloud->voxels[i]))
            return fail_at(reader, root, place, "voxels", "\"voxels\" must be made of whole numbers.");
        if (cloud->voxels[i] == 0)
            cloud->voxels[i] = kind->voxels[i];
    }
    return true;
}

static bool check_clouds(lom_reader *reader, const lom_toml_value *root)
{
    const lom_scene *scene = reader->scene;
    for (size_t i = 1; i < scene->clouds.wind_count; i++)
        if (!(scene->clouds.winds[i].height > scene->clouds.winds[i - 1].height))
            return fail_at(reader, root, element(child(root, "clouds"), "wind", i), "height",
                           "the heights of winds must rise.");
    for (size_t i = 0; i < scene->cloud_count; i++) {
        lom_cloud *cloud = &scene->cloud[i];
        const lom_toml_value *place = element(root, "cloud", i);
        if (!fill_cloud(reader, root, place, cloud))
            return false;
        for (size_t j = 0; j < i && cloud->name != NULL; j++)
            if (scene->cloud[j].name != NULL && strcmp(scene->cloud[j].name, cloud->name) == 0)
                return fail_at(reader, root, place, "name", "another cloud has this name already.");
    }
    return true;
}

/* ---- [[spray]] ---- */

static bool check_spray(lom_reader *reader, const lom_toml_value *root, const lom_toml_value *place, lom_spray *spray)
{
    if (child(place, "to") == NULL)
        memcpy(spray->to, spray->from, sizeof spray->to);
    if (child(place, "height") == NULL)
        return true;
    if (child(place, "life") != NULL)
        return fail_at(reader, root, place, "height", "spray has either a life or a height, not both.");
    spray->life = lom_fall_time(spray->height, spray->drag);
    return (spray->life >= 0.001 && spray->life <= 3600) ||
           fail_at(reader, root, place, "height", "a fall through this height must take from 0.001 to 3600 s.");
}

static bool check_sprays(lom_reader *reader, const lom_toml_value *root)
{
    const lom_scene *scene = reader->scene;
    size_t drops = 0;
    for (size_t i = 0; i < scene->spray_count; i++) {
        const lom_toml_value *place = element(root, "spray", i);
        const char *name = scene->sprays[i].name;
        drops += (size_t)scene->sprays[i].count;
        if (drops > LOM_MAX_PARTICLES)
            return fail_at(reader, root, place, "count", "the drops of all emitters together are more than 1000000.");
        for (size_t j = 0; j < i && name != NULL; j++)
            if (scene->sprays[j].name != NULL && strcmp(scene->sprays[j].name, name) == 0)
                return fail_at(reader, root, place, "name", "another emitter has this name already.");
        if (!check_spray(reader, root, place, &scene->sprays[i]))
            return false;
    }
    return true;
}

bool lom_check_scene(lom_reader *reader, const lom_toml_value *root)
{
    static bool (*const checks[])(lom_reader *, const lom_toml_value *) = { check_camera,  check_light,  check_sky,
                                                                            check_terrain, check_water,  check_entities,
                                                                            check_shallow, check_clouds, check_sprays };
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++)
        if (!checks[i](reader, root))
            return false;
    return true;
}
