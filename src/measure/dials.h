/* The dials: every approximation of the program, and what only makes it faster (docs/dials.md). A dial of a scene is a
 * key whose row says so (base/keys.h), one of the program is a row of dials.c. */
#ifndef LOM_MEASURE_DIALS_H
#define LOM_MEASURE_DIALS_H

#include "scene/scene_dials.h"

#include <lom/pipeline.h>

#include <stdio.h>

typedef struct lom_dial {
    char name[64]; /* "cloud_error", "impostor.bound", "output.samples": the key's path without "quality."; of the
                      program: "threads" */
    lom_key_dial row;
    lom_scene_key key; /* key.key NULL: it is one of the program's */
    /* Of the program's: puts a setting into how a frame is drawn. */
    void (*set)(lom_device_desc *device, int *parts, int setting);
} lom_dial;

enum { LOM_MAX_DIALS = 96 };
typedef struct lom_dials {
    size_t count;
    lom_dial dial[LOM_MAX_DIALS];
} lom_dials;

/* All of them, those of scenes first. */
void lom_list_dials(lom_dials *dials);
/* The dial of a name, with or without "quality."; NULL with the nearest names in error. */
const lom_dial *lom_find_dial(const lom_dials *dials, const char *name, lom_error *error);
/* The dials whose names stand in `names` with commas between them, NULL: all of them. chosen: LOM_MAX_DIALS. */
bool lom_choose_dials(const lom_dials *dials, const char *names, const lom_dial **chosen, size_t *count,
                      lom_error *error);
/* Setting i, from the cheapest to the most exact; false behind the last. */
bool lom_dial_setting(const lom_dial *dial, size_t i, char setting[LOM_SCENE_VALUE]);
/* "KEY=SETTING" of a dial of scenes, as an override of a scene. */
void lom_print_dial_override(char text[128], const lom_dial *dial, const char *setting);

/* docs/dials.md. */
void lom_print_dial_documentation(FILE *out);
/* For `lom plan`: each dial that acts in the scene with its setting, then why the others do nothing. */
void lom_print_scene_dials(FILE *out, const lom_scene *scene);

#endif
