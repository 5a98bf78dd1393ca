/* Another scene for a renderer. In: a renderer of one scene, and the next. Out: the same renderer as if it had been made
 * for that. What keys that differ are loaded for (key_parts.c) is loaded beside the old, which is freed when all of it is
 * there. Invariant: until then the old is only looked at, so a failure leaves the renderer as it was. */
#include "base/pass_error.h"
#include "pipeline/check_device.h"
#include "reference/reference.h"
#include "render/rooms.h"

#include <stdio.h>
#include <string.h>

/* The renderer while it changes, and what it was before. */
struct change {
    lom_renderer *renderer;
    lom_renderer before; /* its members; those of the parts are not the renderer's any more */
    const lom_scene *scene, *scene_before;
    unsigned parts;
    bool differ, ends_run, all;
};

static bool has_new_textures(const struct change *c)
{
    return (c->parts & LOM_PART_TEXTURES) != 0;
}

static bool has_new_world(const struct change *c)
{
    return (c->parts & (LOM_PART_HEIGHTS | LOM_PART_ENTITIES)) != 0;
}

/* Takes the parts out of the renderer. */
static void set_aside(struct change *c)
{
    c->before = *c->renderer;
    for (size_t i = 0; i < LOM_ROOMS; i++)
        if ((lom_rooms[i].part & c->parts) != 0)
            memset((char *)c->renderer + lom_rooms[i].offset, 0, lom_rooms[i].size);
    if (has_new_world(c))
        c->renderer->moment = (struct lom_moment){ .placements = NULL };
    if (has_new_textures(c))
        c->renderer->textures = (struct lom_texture_cache){ .count = 0 };
    c->renderer->before = c->all ? NULL : &c->before;
    if (!c->all)
        return;
    c->renderer->reference = NULL;
    lom_set_device_filtering(c->renderer->device, c->scene->quality.filtering);
}

static bool load(struct change *c, lom_error *error)
{
    lom_renderer *r = c->renderer;
    const struct lom_world *shared = c->all ? NULL : c->before.world;
    if (has_new_world(c))
        r->world = lom_create_world_after(c->scene, shared, (c->parts & LOM_PART_HEIGHTS) == 0, NULL, error);
    else
        lom_follow_scene(r->world, c->scene);
    bool done = lom_load_renderer(r, c->parts, error);
    r->before = NULL;
    return lom_check_device(r->device, error) && done;
}

/* Frees what one of two renderers, which share a device and perhaps textures, has of the parts. */
static void free_parts(struct change *c, lom_renderer *owner, lom_renderer *other)
{
    owner->water = owner->waters;
    if (!has_new_textures(c))
        owner->textures = c->renderer->textures;
    if ((c->parts & LOM_PART_CLOUDS) != 0)
        lom_part_cloud_sets(other->clouds.set, owner->clouds.set);
    lom_free_rooms(owner, c->parts);
    if (!has_new_textures(c))
        c->renderer->textures = c->before.textures = owner->textures;
    else
        lom_free_textures(owner);
    if (c->all)
        lom_free_reference(owner->reference);
    if (has_new_world(c)) {
        lom_part_worlds(other->world, owner->world);
        lom_free_moment(&owner->moment);
        lom_free_world(owner->world);
    }
}

static void go_back(struct change *c)
{
    lom_renderer *r = c->renderer;
    lom_forget_failure(r->device);
    free_parts(c, r, &c->before);
    *r = c->before;
    r->water = r->waters;
    lom_set_device_filtering(r->device, c->scene_before->quality.filtering);
    if (!has_new_world(c))
        lom_follow_scene(r->world, c->scene_before);
}

/* The names of the rooms that were loaded. */
static void list_rooms(lom_renderer *r, unsigned parts)
{
    size_t length = 0;
    r->loaded[0] = 0;
    for (size_t i = 0; i < LOM_ROOMS; i++)
        if ((lom_rooms[i].part & parts) != 0)
            length += (size_t)snprintf(r->loaded + length, sizeof r->loaded - length, "%s%s", length > 0 ? ", " : "",
                                       lom_rooms[i].name);
}

static void go_on(struct change *c)
{
    lom_renderer *r = c->renderer;
    free_parts(c, &c->before, r);
    if ((c->parts & LOM_PART_CLOUDS) == 0)
        lom_follow_clouds(r, c->scene_before, c->scene);
    lom_follow_water(r);
    lom_drop_made(r, c->parts);
    if (c->ends_run)
        lom_end_impostor_run(r);
    else if (c->differ)
        lom_interrupt_impostor_run(r);
    list_rooms(r, c->all ? 0 : c->parts);
}

bool lom_change_scene(lom_renderer *renderer, const lom_scene *scene, lom_change *change, lom_error *error)
{
    struct change c = { .renderer = renderer, .scene = scene, .scene_before = renderer->world->scene };
    struct lom_difference difference = lom_difference_between(c.scene_before, scene);
    c.parts = difference.parts;
    c.differ = difference.any;
    c.ends_run = difference.ends_run;
    c.all = c.parts == LOM_PARTS_ALL;
    lom_change done = c.all ? LOM_CHANGE_ALL : (c.parts & LOM_PARTS_LOADED) != 0 ? LOM_CHANGE_PART : LOM_CHANGE_FRAME;
    if (change != NULL)
        *change = LOM_CHANGE_NONE;
    lom_error failed = { 0 };
    if (!lom_check_device(renderer->device, &failed)) /* no frame will be drawn */
        return lom_pass_error(&failed, error);
    lom_float_state state;
    lom_enter_float_state(&state);
    set_aside(&c);
    bool loaded = load(&c, &failed);
    if (loaded)
        go_on(&c);
    else
        go_back(&c);
    lom_leave_float_state(&state);
    if (loaded && change != NULL && c.differ)
        *change = done;
    return lom_pass_error(&failed, error);
}

const char *lom_renderer_loaded(const lom_renderer *renderer)
{
    return renderer->loaded;
}
