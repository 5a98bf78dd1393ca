/* What a scene has in the place of what its file says: a list of "key=value", as --set takes them. */
#ifndef LOM_CLI_VIEW_SETTINGS_H
#define LOM_CLI_VIEW_SETTINGS_H

#include "options.h"

enum { LOM_MAX_SETTINGS = 96, LOM_MAX_SETTING = 480 };

struct lom_settings {
    int count;
    char text[LOM_MAX_SETTINGS][LOM_MAX_SETTING]; /* in the order in which their keys were first set */
};

/* Gives a key a value, in the place of the one before; false when there is no room. */
bool lom_set_setting(struct lom_settings *settings, const char *key, const char *value);
/* The same with numbers: "[1, 2, 3]", or one without brackets. */
bool lom_set_numbers(struct lom_settings *settings, const char *key, const double *values, int count);
/* Takes the key out; false: it was not in. */
bool lom_drop_setting(struct lom_settings *settings, const char *key);
/* NULL: the key has none. */
const char *lom_find_setting(const struct lom_settings *settings, const char *key);
/* Those of the list and then these; the strings stay where they are. */
void lom_list_settings(const struct lom_settings *settings, lom_option_list *list);

#endif
