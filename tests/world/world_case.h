/* A small scene's world, for the tests of this folder. */
#ifndef LOM_TESTS_WORLD_CASE_H
#define LOM_TESTS_WORLD_CASE_H

#include "check.h"
#include "small_scene.h"

#include "world/world.h"

static lom_scene *scene;
static struct lom_world *world;

/* The scene of a text, and its world; NULL: the error says why. */
static bool open_world(const char *text, lom_error *error)
{
    scene = lom_decode_scene(text, strlen(text), small_path("scene.toml"), NULL, 0, error);
    world = scene == NULL ? NULL : lom_create_world(scene, NULL, error);
    return world != NULL;
}

static void close_world(void)
{
    lom_free_world(world);
    lom_free_scene(scene);
    world = NULL;
    scene = NULL;
}

#define LAND "[terrain]\nheight_map = 'height.png'\nsize = [40, 30]\nheight = 6\nbase = -3\n"
#define BOX  "[[entity]]\nmesh = 'box.obj'\n"

static bool open_good(const char *text)
{
    lom_error error = { 0 };
    bool done = open_world(text, &error);
    CHECK(done, "%s", error.text);
    return done;
}

#endif
