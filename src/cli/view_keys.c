/* What the keys do. In: a key that goes down. Out: what it changes. Invariant: the list that `lom view --help` and F1 show
 * is the table that is asked when a key goes down; keys that are held are looked at where they move something. */
#include "view.h"

#include "view_menu.h"

#include <lom/inspect.h>

#include <string.h>

/* ---- actions ---- */

static void toggle_time(struct lom_view *view)
{
    view->runs = !view->runs;
    view->is_unpainted = true;
}

static void go_to_start(struct lom_view *view)
{
    view->time = 0;
    lom_spoil_view(view);
}

static void go_faster(struct lom_view *view)
{
    view->speed = view->speed < 1e5 ? view->speed * 1.25 : view->speed;
    view->is_unpainted = true;
}

static void go_slower(struct lom_view *view)
{
    view->speed = view->speed > 0.01 ? view->speed / 1.25 : view->speed;
    view->is_unpainted = true;
}

static void toggle_sun(struct lom_view *view)
{
    view->sun.goes = !view->sun.goes;
    view->is_unpainted = true;
}

static void toggle_menu(struct lom_view *view)
{
    view->menu->is_open = !view->menu->is_open;
    view->is_unpainted = true;
}

/* The pictures of passes in turn, and the frame's; without the frame's as a pass of its own. */
static void next_pass(struct lom_view *view)
{
    view->overlay = -1;
    do
        view->pass = lom_describe_shown_pass((size_t)(view->pass + 1)) != NULL ? view->pass + 1 : -1;
    while (view->pass >= 0 && strcmp(lom_describe_shown_pass((size_t)view->pass)->name, "picture") == 0);
    lom_spoil_view(view);
}

static void next_overlay(struct lom_view *view)
{
    view->pass = -1;
    view->overlay = lom_describe_overlay((size_t)(view->overlay + 1)) != NULL ? view->overlay + 1 : -1;
    lom_spoil_view(view);
}

static void read_again(struct lom_view *view)
{
    view->needs_renderer = true;
    view->has_changed = true;
}

static void toggle_limit(struct lom_view *view)
{
    view->is_free = !view->is_free;
    view->is_unpainted = true;
}

static void toggle_adapting(struct lom_view *view)
{
    view->adapts = !view->adapts;
    view->is_unpainted = true;
}

static void toggle_status(struct lom_view *view)
{
    view->shows_status = !view->shows_status;
    view->is_unpainted = true;
}

static void toggle_keys(struct lom_view *view)
{
    view->shows_keys = !view->shows_keys;
    view->is_unpainted = true;
}

static void save(struct lom_view *view)
{
    view->saves = true;
}

/* The first of these that is there; then the end. */
static void leave(struct lom_view *view)
{
    bool *const open[] = { &view->shows_keys, &view->menu->is_open };
    view->is_unpainted = true;
    for (size_t i = 0; i < sizeof open / sizeof open[0]; i++)
        if (*open[i]) {
            *open[i] = false;
            return;
        }
    if (view->message[0] != '\0' || view->explained_x >= 0) {
        lom_tell_view(view, false, "%s", "");
        view->explained_x = -1;
    } else if (view->pass >= 0 || view->overlay >= 0) {
        view->pass = view->overlay = -1;
        lom_spoil_view(view);
    } else {
        view->ends = true;
    }
}

/* ---- the table ---- */

/* Rows without an action say what is held or done with the mouse. */
static const struct binding {
    int key;
    const char *keys, *text;
    void (*press)(struct lom_view *view);
} bindings[] = {
    { 0, "w s a d", "fly ahead, back, left, right", NULL },
    { 0, "e q", "up, down", NULL },
    { 0, "shift", "five times as fast", NULL },
    { 0, "drag", "look around; in third person, go around", NULL },
    { 0, "wheel", "angle of view", NULL },
    { '+', "+", "fly faster", go_faster },
    { '-', "-", "fly slower", go_slower },
    { 'c', "c", "camera: the scene's, free, third person, first person", lom_next_eye },
    { 'n', "n", "follow the next entity", lom_next_entity },
    { 0, "arrows", "steer the aircraft: bank, and raise or lower its nose", NULL },
    { 0, "page up/down", "the aircraft flies faster, slower", NULL },
    { LOM_VIEW_SPACE, "space", "time runs or stands", toggle_time },
    { '0', "0", "time 0", go_to_start },
    { 0, "j l i k", "sun to the left, to the right, up, down", NULL },
    { 'o', "o", "the sun goes on by itself, or stops", toggle_sun },
    { LOM_VIEW_BACKSPACE, "backspace", "camera, aircraft and sun as the file has them", lom_give_back },
    { 0, "click", "explain the pixel", NULL },
    { 'v', "v", "the picture of the next pass", next_pass },
    { 'b', "b", "the next overlay: what the stages did at each pixel", next_overlay },
    { 'm', "m", "menu: arrows choose and change, backspace: as the file has it", toggle_menu },
    { LOM_VIEW_TAB, "tab", "the same", toggle_menu },
    { 'p', "p", "write the picture into a new file, say the command that draws it", save },
    { 'g', "g", "record the camera's path; again: into a new scene file", lom_toggle_recording },
    { 'r', "r", "read the scene again (as whenever one of its files changes)", read_again },
    { 'f', "f", "60 pictures a second at most, or as many as there can be", toggle_limit },
    { 'z', "z", "smaller pictures while something moves, or whole ones", toggle_adapting },
    { 'h', "h", "show the line at the bottom, or hide it", toggle_status },
    { LOM_VIEW_F1, "f1", "these keys", toggle_keys },
    { LOM_VIEW_ESCAPE, "escape", "close what is open; then end", leave },
};
enum { BINDINGS = sizeof bindings / sizeof bindings[0] };

bool lom_describe_view_key(size_t i, const char **keys, const char **text)
{
    if (i >= BINDINGS)
        return false;
    *keys = bindings[i].keys;
    *text = bindings[i].text;
    return true;
}

static bool belongs_to_menu(int key)
{
    return (key >= LOM_VIEW_UP && key <= LOM_VIEW_PAGE_DOWN) || key == LOM_VIEW_ENTER || key == LOM_VIEW_BACKSPACE;
}

/* A mistake until it is mended, a verdict as long as its pixel is marked, all else until the next key, which is not one that
 * is only repeated. */
static bool message_stays(const struct lom_view *view, int key)
{
    return view->is_error || view->explained_x >= 0 || view->held[key] || key == LOM_VIEW_ESCAPE ||
           key == LOM_VIEW_SHIFT;
}

void lom_press_key(struct lom_view *view, int key)
{
    if (view->message[0] != '\0' && !message_stays(view, key))
        lom_tell_view(view, false, "%s", "");
    if (view->menu->is_open && belongs_to_menu(key)) {
        lom_press_menu(view, key);
        return;
    }
    for (size_t i = 0; i < BINDINGS && !view->held[key]; i++) /* once, however often it is repeated */
        if (bindings[i].key == key)
            bindings[i].press(view);
}

int lom_find_view_key(const char *name)
{
    static const struct {
        const char *name;
        int key;
    } names[] = {
        { "space", LOM_VIEW_SPACE },
        { "tab", LOM_VIEW_TAB },
        { "enter", LOM_VIEW_ENTER },
        { "escape", LOM_VIEW_ESCAPE },
        { "up", LOM_VIEW_UP },
        { "down", LOM_VIEW_DOWN },
        { "left", LOM_VIEW_LEFT },
        { "right", LOM_VIEW_RIGHT },
        { "page_up", LOM_VIEW_PAGE_UP },
        { "shift", LOM_VIEW_SHIFT },
        { "page_down", LOM_VIEW_PAGE_DOWN },
        { "f1", LOM_VIEW_F1 },
        { "backspace", LOM_VIEW_BACKSPACE },
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(names[i].name, name) == 0)
            return names[i].key;
    return name[0] > ' ' && name[0] < 127 && name[1] == '\0' ? name[0] : 0;
}
