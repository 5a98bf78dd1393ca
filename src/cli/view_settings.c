/* Settings. In: keys and values. Out: a list of overrides. Invariant: a key stands in it once. */
#include "view_settings.h"

#include <string.h>

static int find(const struct lom_settings *settings, const char *key)
{
    size_t length = strlen(key);
    for (int i = 0; i < settings->count; i++)
        if (strncmp(settings->text[i], key, length) == 0 && settings->text[i][length] == '=')
            return i;
    return -1;
}

bool lom_set_setting(struct lom_settings *settings, const char *key, const char *value)
{
    int at = find(settings, key);
    if (at < 0)
        at = settings->count;
    const size_t length = strlen(key), size = strlen(value) + 1;
    if (at == LOM_MAX_SETTINGS || length + 1 + size > LOM_MAX_SETTING)
        return false;
    memcpy(settings->text[at], key, length);
    settings->text[at][length] = '=';
    memcpy(settings->text[at] + length + 1, value, size);
    settings->count += at == settings->count;
    return true;
}

bool lom_set_numbers(struct lom_settings *settings, const char *key, const double *values, int count)
{
    char text[LOM_MAX_SETTING] = "", number[32];
    size_t used = 0;
    for (int i = 0; i < count && used + 40 < sizeof text; i++) {
        lom_print_double(number, values[i]);
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i > 0 ? ", " : count > 1 ? "[" : "", number);
    }
    if (count > 1)
        snprintf(text + used, sizeof text - used, "]");
    return lom_set_setting(settings, key, text);
}

bool lom_drop_setting(struct lom_settings *settings, const char *key)
{
    int at = find(settings, key);
    if (at < 0)
        return false;
    settings->count--;
    memmove(settings->text[at], settings->text[at + 1], (size_t)(settings->count - at) * LOM_MAX_SETTING);
    return true;
}

const char *lom_find_setting(const struct lom_settings *settings, const char *key)
{
    int at = find(settings, key);
    return at < 0 ? NULL : settings->text[at] + strlen(key) + 1;
}

void lom_list_settings(const struct lom_settings *settings, lom_option_list *list)
{
    for (int i = 0; i < settings->count && list->count < LOM_OPTION_LIST_MAX; i++)
        list->items[list->count++] = settings->text[i];
}
