/* The menu of `lom view`. In: the tables of keys, arrows. Out: settings. Invariant: no key is named here, and no value
 * leaves its range. */
#include "view_menu.h"

#include "base/numbers.h"
#include "scene/scene_keys.h"

#include <string.h>

/* ---- values ---- */

/* The power of ten that is not above x, within 1e-6 .. 1e9. */
static double power_of_ten(double x)
{
    double power = 1e-6;
    while (power < 1e9 && power * 10 <= x * (1 + 1e-12))
        power *= 10;
    return power >= 1 ? lom_double_floor(power + 0.5) : power;
}

static bool is_bounded(const lom_key *key)
{
    return key->minimum != 0 || key->maximum != 0;
}

/* A tenth of the value's power of ten; of the default's when it is 0; else some parts of the range. */
static double find_step(const lom_key *key, double value)
{
    double of = lom_magnitude(value != 0 ? value : key->initial[0]);
    double span = is_bounded(key) ? lom_smaller(key->maximum - key->minimum, 100) : 100;
    double step = of != 0 ? power_of_ten(of) / 10 : power_of_ten(span / 200);
    return key->type == LOM_KEY_INTEGER ? lom_larger(lom_double_floor(step + 0.5), 1) : step;
}

/* The value next to one that is so many steps from 0: computed from whole numbers, so that it prints as people write it. */
static double step_number(const lom_key *key, double value, int direction, bool fast)
{
    double step = find_step(key, value);
    double steps = lom_double_floor(value / step + 0.5) + direction * (fast ? 10 : 1);
    double inverse = lom_double_floor(1 / step + 0.5);
    double result = step < 1 ? steps / inverse : steps * step;
    if (!is_bounded(key))
        return result;
    if (key->flags & LOM_KEY_ABOVE && result <= key->minimum)
        return value;
    return lom_smaller(lom_larger(result, key->minimum), key->maximum);
}

static int count_choices(const lom_key *key)
{
    int count = 0;
    while (count < (int)(sizeof key->choices / sizeof key->choices[0]) && key->choices[count] != NULL)
        count++;
    return count;
}

double lom_step_key(const lom_key *key, double value, int direction, bool fast)
{
    if (key->type != LOM_KEY_BOOL && key->type != LOM_KEY_CHOICE)
        return step_number(key, value, direction, fast);
    int count = key->type == LOM_KEY_BOOL ? 2 : count_choices(key);
    return (lom_int_of(value) + direction + count) % count;
}

double lom_key_value(const lom_key *key, const void *member)
{
    switch (key->type) {
    case LOM_KEY_BOOL:
        return *(const bool *)member ? 1 : 0;
    case LOM_KEY_INTEGER:
    case LOM_KEY_CHOICE:
        return *(const int *)member;
    case LOM_KEY_ANGLE: /* as the file's number was, but for the rounding of its conversion */
        return lom_double_floor(*(const double *)member / lom_radians_per_degree * 1e6 + 0.5) / 1e6;
    default:
        return *(const double *)member;
    }
}

void lom_print_key_value(char text[64], const lom_key *key, double value)
{
    char number[32];
    lom_print_double(number, value);
    if (key->type == LOM_KEY_BOOL)
        snprintf(text, 64, "%s", value != 0 ? "true" : "false");
    else if (key->type == LOM_KEY_CHOICE)
        snprintf(text, 64, "\"%s\"", key->choices[lom_int_of(value)]);
    else
        snprintf(text, 64, "%s", number);
}

/* False of the zeros of a table that is not in the file and must say more. */
static bool is_within(const lom_key *key, double value)
{
    return !is_bounded(key) ||
           (value <= key->maximum && (key->flags & LOM_KEY_ABOVE ? value > key->minimum : value >= key->minimum));
}

void lom_print_item(char text[160], const struct lom_menu_item *item, double value)
{
    char number[64];
    if (item->key->count <= 1) {
        lom_print_key_value(number, item->key, value);
        snprintf(text, 160, "%s", number);
        return;
    }
    const double *first = (const double *)item->member - item->component;
    size_t used = 0;
    for (int i = 0; i < item->key->count && used + 40 < 160; i++) {
        double old = lom_key_value(item->key, first + i);
        lom_print_key_value(number, item->key, i == item->component || !is_within(item->key, old) ? value : old);
        used += (size_t)snprintf(text + used, 160 - used, "%s%s", i == 0 ? "[" : ", ", number);
    }
    snprintf(text + used, 160 - used, "]");
}

/* ---- what there is ---- */

struct lom_menu *lom_create_menu(lom_error *error)
{
    return lom_allocate(1, sizeof(struct lom_menu), error);
}

void lom_free_menu(struct lom_menu *menu)
{
    if (menu == NULL)
        return;
    lom_release(menu->items);
    lom_release(menu);
}

static bool add_item(struct lom_menu *menu, const char *path, const lom_key *key, const void *member, int component,
                     lom_error *error)
{
    if (menu->count == menu->room) {
        size_t room = menu->room == 0 ? 256 : 2 * menu->room;
        struct lom_menu_item *items = lom_allocate(room, sizeof *items, error);
        if (items == NULL)
            return false;
        if (menu->count != 0)
            memcpy(items, menu->items, menu->count * sizeof *items);
        lom_release(menu->items);
        menu->items = items;
        menu->room = room;
    }
    struct lom_menu_item *item = &menu->items[menu->count++];
    snprintf(item->path, sizeof item->path, "%s", path);
    item->key = key;
    item->member = member;
    item->component = component;
    return true;
}

static bool is_dial(const lom_key *key)
{
    bool is_one = key->type == LOM_KEY_INTEGER || key->type == LOM_KEY_BOOL || key->type == LOM_KEY_CHOICE;
    bool is_some = key->type == LOM_KEY_NUMBER || key->type == LOM_KEY_ANGLE || key->type == LOM_KEY_COLOR;
    return is_some ? key->count <= 3 : is_one && key->count <= 1;
}

static bool join(char path[LOM_MENU_PATH], const char *before, const char *name)
{
    int length = snprintf(path, LOM_MENU_PATH, "%s%s%s", before, before[0] != '\0' ? "." : "", name);
    return length > 0 && length < LOM_MENU_PATH;
}

static bool add_table(struct lom_menu *menu, const char *path, const lom_key_table *table, const char *members,
                      lom_error *error);

/* An element's name, when it is a plain word; else its number. */
static void name_element(char text[64], const lom_key_table *table, const char *element, size_t number)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    snprintf(text, 64, "%zu", number);
    for (int i = 0; i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        if (key->type != LOM_KEY_STRING || strcmp(key->name, "name") != 0)
            continue;
        const char *name = *(const char *const *)(const void *)(element + key->offset);
        size_t length = name != NULL ? strlen(name) : 0;
        if (length > 0 && length < 64 && strspn(name, plain) == length && strspn(name, "0123456789") < length)
            memcpy(text, name, length + 1);
    }
}

static bool add_tables(struct lom_menu *menu, const char *path, const lom_key *key, const char *members,
                       lom_error *error)
{
    const char *array = *(const char *const *)(const void *)(members + key->offset);
    size_t count = *(const size_t *)(const void *)(members + key->length_offset);
    char at[LOM_MENU_PATH], name[64];
    bool done = true;
    for (size_t i = 0; done && i < count; i++) {
        const char *element = array + i * key->table->size;
        name_element(name, key->table, element, i);
        done = !join(at, path, name) || add_table(menu, at, key->table, element, error);
    }
    return done;
}

/* The dials of a table under its name, then the tables within it. Key frames are no dials. */
static bool add_table(struct lom_menu *menu, const char *path, const lom_key_table *table, const char *members,
                      lom_error *error)
{
    bool done = true, is_named = false;
    char at[LOM_MENU_PATH];
    for (int i = 0; done && i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        if (!is_dial(key) || !join(at, path, key->name))
            continue;
        done = is_named || add_item(menu, path, NULL, NULL, 0, error);
        is_named = true;
        for (int c = 0; done && c < lom_larger_int(key->count, 1); c++)
            done = add_item(menu, at, key, members + key->offset + (size_t)c * sizeof(double), c, error);
    }
    for (int i = 0; done && i < table->key_count; i++) {
        const lom_key *key = &table->keys[i];
        if (!join(at, path, key->name) || strcmp(key->name, "key") == 0)
            continue;
        if (key->type == LOM_KEY_TABLE)
            done = add_table(menu, at, key->table, members + key->offset, error);
        else if (key->type == LOM_KEY_TABLES)
            done = add_tables(menu, at, key, members, error);
    }
    return done;
}

bool lom_fill_menu(struct lom_menu *menu, const lom_scene *scene, lom_error *error)
{
    struct lom_menu_item chosen = { .path = "" };
    if (menu->count != 0)
        chosen = menu->items[menu->chosen];
    menu->count = menu->chosen = 0;
    bool done = add_table(menu, "", &lom_scene_keys, (const char *)scene, error);
    for (size_t i = 0; i < menu->count; i++)
        if (strcmp(menu->items[i].path, chosen.path) == 0 && menu->items[i].component == chosen.component)
            menu->chosen = i;
    return done;
}

/* ---- what is shown ---- */

/* Groups, and what is in the one that is unfolded. */
static bool is_shown(const struct lom_menu *menu, size_t i)
{
    const struct lom_menu_item *item = &menu->items[i];
    if (item->key == NULL)
        return true;
    size_t length = strlen(menu->unfolded);
    return length != 0 && strncmp(item->path, menu->unfolded, length) == 0 && item->path[length] == '.' &&
           strchr(item->path + length + 1, '.') == NULL;
}

/* The shown item n places after (before: negative) the chosen one, as far as there are some. */
static void move(struct lom_menu *menu, int n)
{
    const int step = n > 0 ? 1 : -1;
    for (size_t i = menu->chosen; n != 0;) {
        if (step < 0 ? i == 0 : i + 1 >= menu->count)
            return;
        i = step < 0 ? i - 1 : i + 1;
        if (is_shown(menu, i)) {
            menu->chosen = i;
            n -= step;
        }
    }
}

static void change(struct lom_view *view, const struct lom_menu_item *item, int direction)
{
    char text[160];
    double value = lom_key_value(item->key, item->member);
    double next = lom_step_key(item->key, value, direction, view->held[LOM_VIEW_SHIFT]);
    if (next == value) /* the end of its range */
        return;
    lom_print_item(text, item, next);
    if (!lom_set_setting(&view->settings, item->path, text))
        lom_tell_view(view, true, "no more than %d keys can be changed at a time.", LOM_MAX_SETTINGS);
    view->has_changed = true;
}

void lom_press_menu(struct lom_view *view, int key)
{
    enum { PAGE = 10 };
    struct lom_menu *menu = view->menu;
    if (menu->count == 0)
        return;
    const struct lom_menu_item *item = &menu->items[menu->chosen];
    int ahead = key == LOM_VIEW_RIGHT || key == LOM_VIEW_ENTER ? 1 : key == LOM_VIEW_LEFT ? -1 : 0;
    view->is_unpainted = true;
    if (key == LOM_VIEW_UP || key == LOM_VIEW_DOWN)
        move(menu, key == LOM_VIEW_UP ? -1 : 1);
    else if (key == LOM_VIEW_PAGE_UP || key == LOM_VIEW_PAGE_DOWN)
        move(menu, key == LOM_VIEW_PAGE_UP ? -PAGE : PAGE);
    else if (ahead != 0 && item->key == NULL)
        snprintf(menu->unfolded, sizeof menu->unfolded, "%s", ahead > 0 ? item->path : "");
    else if (ahead != 0 && view->load == NULL)
        change(view, item, ahead);
    else if (key == LOM_VIEW_BACKSPACE)
        view->has_changed = lom_drop_setting(&view->settings, item->path) || view->has_changed;
}

bool lom_menu_row(const struct lom_view *view, size_t n, char text[LOM_MENU_ROW], bool *is_chosen)
{
    const struct lom_menu *menu = view->menu;
    size_t i = 0;
    for (; i < menu->count; i++)
        if (is_shown(menu, i) && n-- == 0)
            break;
    if (i == menu->count)
        return false;
    const struct lom_menu_item *item = &menu->items[i];
    if (is_chosen != NULL)
        *is_chosen = i == menu->chosen;
    if (item->key == NULL) {
        snprintf(text, LOM_MENU_ROW, "%s %s", strcmp(item->path, menu->unfolded) == 0 ? "v" : ">",
                 item->path[0] != '\0' ? item->path : "scene");
        return true;
    }
    static const char *const letters[] = { "rgb", "01", "xyz" };
    char value[64], name[64];
    const char *letter = letters[item->key->type == LOM_KEY_COLOR ? 0 : item->key->count == 2 ? 1 : 2];
    snprintf(name, sizeof name, item->key->count > 1 ? "%s.%c" : "%s", item->key->name, letter[item->component]);
    bool is_set = lom_find_setting(&view->settings, item->path) != NULL;
    lom_print_key_value(value, item->key, lom_key_value(item->key, item->member));
    snprintf(text, LOM_MENU_ROW, "  %-19s %s%s%s%s", name, value, item->key->unit != NULL ? " " : "",
             item->key->unit != NULL ? item->key->unit : "", is_set ? " *" : "");
    return true;
}

const char *lom_menu_help(const struct lom_menu *menu)
{
    const lom_key *key = menu->count != 0 ? menu->items[menu->chosen].key : NULL;
    return key != NULL ? key->text : "";
}
