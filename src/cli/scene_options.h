/* What `render`, `plan` and their kin have in common: opening a scene with its overrides and a device. */
#ifndef LOM_CLI_SCENE_OPTIONS_H
#define LOM_CLI_SCENE_OPTIONS_H

#include "options.h"

#include <lom/render.h>

struct lom_scene_options {
    lom_option_list set;
    lom_option_integers size, crop, threads;
    const char *lanes, *view, *settings;
    lom_option_number fps, memory;
};

/* Rows for an option table whose values struct has a `struct lom_scene_options scene`. */
#define LOM_SCENE_OPTIONS(values)                                                                                      \
    { "size", 0, LOM_OPTION_INTEGER, offsetof(values, scene.size),                                                     \
      "WxH",  1, LOM_MAX_SIZE,       "size of the whole frame in pixels; the scene's when not given" },                \
        { "crop",                                                                                                      \
          0,                                                                                                           \
          LOM_OPTION_INTEGER,                                                                                          \
          offsetof(values, scene.crop),                                                                                \
          "X,Y,W,H",                                                                                                   \
          0,                                                                                                           \
          LOM_MAX_SIZE,                                                                                                \
          "draw only this part of the frame; the same pixels as a cut-out of the whole" },                             \
        { "view",                                                                                                      \
          0,                                                                                                           \
          LOM_OPTION_TEXT,                                                                                             \
          offsetof(values, scene.view),                                                                                \
          "NAME",                                                                                                      \
          0,                                                                                                           \
          0,                                                                                                           \
          "this [[view]] alone, as large as its rectangle; main: none of them" },                                      \
        { "fps",                                                                                                       \
          0,                                                                                                           \
          LOM_OPTION_NUMBER,                                                                                           \
          offsetof(values, scene.fps),                                                                                 \
          "F",                                                                                                         \
          0.001,                                                                                                       \
          100000,                                                                                                      \
          "frames a second, instead of the scene's" },                                                                 \
        { "set",                                                                                                       \
          0,                                                                                                           \
          LOM_OPTION_LIST,                                                                                             \
          offsetof(values, scene.set),                                                                                 \
          "KEY=VALUE",                                                                                                 \
          0,                                                                                                           \
          0,                                                                                                           \
          "change a key of the scene, like water.level=12" },                                                          \
        { "settings",                                                                                                  \
          0,                                                                                                           \
          LOM_OPTION_TEXT,                                                                                             \
          offsetof(values, scene.settings),                                                                            \
          "FILE",                                                                                                      \
          0,                                                                                                           \
          0,                                                                                                           \
          "a scene file that is laid over the scene before --set, as `lom tune` writes them" },                        \
        { "memory", 0,     LOM_OPTION_NUMBER, offsetof(values, scene.memory),                                          \
          "GIB",    0.001, 1000000,           "what a frame's targets may take; the machine's when not given" },       \
        { "threads",                                                                                                   \
          0,                                                                                                           \
          LOM_OPTION_INTEGER,                                                                                          \
          offsetof(values, scene.threads),                                                                             \
          "N",                                                                                                         \
          1,                                                                                                           \
          256,                                                                                                         \
          "workers; as many as the machine allows when not given; changes no byte" },                                  \
    {                                                                                                                  \
        "lanes", 0, LOM_OPTION_CHOICE, offsetof(values, scene.lanes), "auto|4|8|16", 0, 0,                             \
            "values side by side; changes no byte"                                                                     \
    }

/* Reads the scene and applies the options; NULL after an error has been put into error. */
lom_scene *lom_open_scene(const char *path, const struct lom_scene_options *options, lom_error *error);
/* The device that the options ask for. */
lom_device_desc lom_device_of_options(const struct lom_scene_options *options);
/* The frame that the options ask for. */
lom_frame_desc lom_frame_of_options(const struct lom_scene_options *options, int frame);
/* The same, of 320x180 pixels where no size was asked for: what is drawn many times, or shown in many pictures. */
lom_frame_desc lom_small_frame_of_options(const struct lom_scene_options *options, int frame);

#endif
