/* The menu of `lom view`: every switch and dial of the scene, from the tables of its keys. */
#ifndef LOM_CLI_VIEW_MENU_H
#define LOM_CLI_VIEW_MENU_H

#include "view.h"

#include "base/keys.h"

enum { LOM_MENU_PATH = 112, LOM_MENU_ROW = 160 };

struct lom_menu_item {
    char path[LOM_MENU_PATH]; /* "quality.scissor"; of a group "quality" */
    const lom_key *key;       /* NULL: a group, to which the items up to the next belong */
    const void *member;       /* its value in the scene */
    int component;            /* of a key that is several numbers; else 0 */
};

struct lom_menu {
    bool is_open;
    size_t count, room;
    struct lom_menu_item *items;
    char unfolded[LOM_MENU_PATH]; /* the group whose items are shown; "": none */
    size_t chosen;                /* index of an item that is shown */
};

struct lom_menu *lom_create_menu(lom_error *error);
void lom_free_menu(struct lom_menu *menu); /* NULL is allowed */
/* What the scene has, which lives until it is filled again. The chosen item stays where it is still there. */
bool lom_fill_menu(struct lom_menu *menu, const lom_scene *scene, lom_error *error);

/* A value one step higher or lower, in the file's unit, within the key's range; switches and choices go around. Numbers go
 * by a tenth of their power of ten, so that a press is some percent; fast: ten times as far, and so to 0. */
double lom_step_key(const lom_key *key, double value, int direction, bool fast);
/* The value of a member in the file's unit: 0 or 1, a choice's index, a number, degrees. */
double lom_key_value(const lom_key *key, const void *member);
/* As the scene file has it: "true", "\"planar\"", "0.5". */
void lom_print_key_value(char text[64], const lom_key *key, double value);
/* The same of all of an item's key, when the item is to have that value. */
void lom_print_item(char text[160], const struct lom_menu_item *item, double value);

/* Arrows, enter and backspace. */
void lom_press_menu(struct lom_view *view, int key);
/* Row n of what is shown, false behind the last; is_chosen may be NULL. */
bool lom_menu_row(const struct lom_view *view, size_t n, char text[LOM_MENU_ROW], bool *is_chosen);
/* What the chosen key is; "" for a group. */
const char *lom_menu_help(const struct lom_menu *menu);

#endif
