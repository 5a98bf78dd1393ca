/* The window of `lom view`, by SDL2; no other file names it. In: the window's events. Out: the view's pixels in the
 * window's surface. Invariants: when nothing changes nothing is drawn, painted or shown, and the program sleeps; SDL2's
 * library is opened when a window is wanted and not before, so that no other start of the program pays for it. */
#include "view_window.h"

#include "base/numbers.h"

#define SDL_DISABLE_IMMINTRIN_H /* a header of intrinsics, which takes two thirds of the time that this file compiles in */
#include <SDL.h>
#include <dlfcn.h>
#include <string.h>

static const double turn_time = 1000.0 / 60; /* milliseconds */

/* All that is called of SDL2, by its names without their SDL_. */
#define EACH_FUNCTION(X)                                                                                               \
    X(ConvertPixels)                                                                                                   \
    X(CreateWindow)                                                                                                    \
    X(Delay)                                                                                                           \
    X(DestroyWindow)                                                                                                   \
    X(EnableScreenSaver)                                                                                               \
    X(GetError)                                                                                                        \
    X(GetPerformanceCounter)                                                                                           \
    X(GetPerformanceFrequency)                                                                                         \
    X(GetWindowSurface)                                                                                                \
    X(HasEvent)                                                                                                        \
    X(Init)                                                                                                            \
    X(PollEvent)                                                                                                       \
    X(PumpEvents)                                                                                                      \
    X(Quit)                                                                                                            \
    X(SetHint)                                                                                                         \
    X(SetWindowSize)                                                                                                   \
    X(StopTextInput)                                                                                                   \
    X(UpdateWindowSurface)                                                                                             \
    X(WaitEventTimeout)
#define POINTER(name)        __typeof__(SDL_##name) *name;
#define NAME_AND_PLACE(name) { "SDL_" #name, offsetof(struct sdl, name) },

struct sdl {
    EACH_FUNCTION(POINTER)
};

struct window {
    struct sdl sdl;
    SDL_Window *window;
    struct lom_view *view;
    double drawing, painting, showing; /* milliseconds in all */
    int shown;
};

/* ---- the library ---- */

/* By the names under which systems have it: the one of its binary interface, and the one that links are made with. */
static void *open_library(lom_error *error)
{
#ifdef __APPLE__
    static const char *const names[] = { "libSDL2-2.0.0.dylib", "libSDL2.dylib" };
#else
    static const char *const names[] = { "libSDL2-2.0.so.0", "libSDL2.so" };
#endif
    lom_error first = { .code = LOM_OK };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        void *library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
        if (library != NULL)
            return library;
        const char *reason = dlerror();
        lom_fail(&first, LOM_ERROR_FILE,
                 "a window is opened by the library SDL2 (Debian: libsdl2-2.0-0), and `lom view SCENE --script FILE "
                 "--no-window` works without it; the loader says: %s.",
                 reason != NULL ? reason : names[i]);
    }
    lom_fail(error, first.code, "%s", first.text);
    return NULL;
}

/* The library stays open until the program ends, since threads of its own may run in it: to open it again is to look its
 * functions up again. POSIX lets a function's address be copied out of a void pointer. */
static bool load(struct sdl *sdl, lom_error *error)
{
    static const struct {
        const char *name;
        size_t place;
    } functions[] = { EACH_FUNCTION(NAME_AND_PLACE) };
    void *library = open_library(error);
    for (size_t i = 0; library != NULL && i < sizeof functions / sizeof functions[0]; i++) {
        void *function = dlsym(library, functions[i].name);
        if (function == NULL)
            return lom_fail(error, LOM_ERROR_FILE, "the library SDL2 of this system has no %s.", functions[i].name);
        memcpy((char *)sdl + functions[i].place, &function, sizeof function);
    }
    return library != NULL;
}

static bool fail(const struct window *w, const char *what, lom_error *error)
{
    return lom_fail(error, LOM_ERROR_FILE, "%s: %s.", what, w->sdl.GetError());
}

static double milliseconds(void *window)
{
    const struct sdl *sdl = &((const struct window *)window)->sdl;
    return 1e3 * (double)sdl->GetPerformanceCounter() / (double)sdl->GetPerformanceFrequency();
}

/* What somebody did who waits for an answer. */
static bool interrupts(void *window)
{
    const struct sdl *sdl = &((const struct window *)window)->sdl;
    static const Uint32 kinds[] = { SDL_KEYDOWN, SDL_MOUSEBUTTONDOWN, SDL_MOUSEWHEEL, SDL_QUIT };
    sdl->PumpEvents();
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (sdl->HasEvent(kinds[i]))
            return true;
    return false;
}

/* ---- events ---- */

/* 0: a key that means nothing here. */
static int find_key(SDL_Keycode code)
{
    static const struct {
        SDL_Keycode code;
        int key;
    } keys[] = {
        { SDLK_UP, LOM_VIEW_UP },
        { SDLK_DOWN, LOM_VIEW_DOWN },
        { SDLK_LEFT, LOM_VIEW_LEFT },
        { SDLK_RIGHT, LOM_VIEW_RIGHT },
        { SDLK_PAGEUP, LOM_VIEW_PAGE_UP },
        { SDLK_PAGEDOWN, LOM_VIEW_PAGE_DOWN },
        { SDLK_LSHIFT, LOM_VIEW_SHIFT },
        { SDLK_RSHIFT, LOM_VIEW_SHIFT },
        { SDLK_F1, LOM_VIEW_F1 },
        { SDLK_KP_PLUS, '+' },
        { SDLK_KP_MINUS, '-' },
        { SDLK_KP_ENTER, LOM_VIEW_ENTER },
        { SDLK_RETURN, LOM_VIEW_ENTER },
        { SDLK_BACKSPACE, LOM_VIEW_BACKSPACE },
        { SDLK_EQUALS, '+' },
        { SDLK_DELETE, LOM_VIEW_BACKSPACE },
    };
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (keys[i].code == code)
            return keys[i].key;
    return code > 0 && code < 127 ? (int)code : 0;
}

static void take_mouse(struct lom_view *view, const SDL_Event *event)
{
    struct lom_view_event to = { LOM_VIEW_POINT, 0, event->motion.x, event->motion.y };
    if (event->type != SDL_MOUSEMOTION) {
        if (event->button.button != SDL_BUTTON_LEFT)
            return;
        to.kind = event->type == SDL_MOUSEBUTTONDOWN ? LOM_VIEW_BUTTON : LOM_VIEW_LET_GO;
        to.x = event->button.x;
        to.y = event->button.y;
    }
    lom_take_view_event(view, &to);
}

static void take_window(struct lom_view *view, const SDL_WindowEvent *event)
{
    if (event->event == SDL_WINDOWEVENT_SIZE_CHANGED)
        lom_take_view_event(view, &(struct lom_view_event){ LOM_VIEW_RESIZE, 0, lom_larger_int(event->data1, 1),
                                                            lom_larger_int(event->data2, 1) });
    view->is_unpainted = true; /* it may have been covered */
}

static void take_event(struct lom_view *view, const SDL_Event *event)
{
    switch (event->type) {
    case SDL_QUIT:
        view->ends = true;
        break;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
        lom_take_view_event(view,
                            &(struct lom_view_event){ event->type == SDL_KEYDOWN ? LOM_VIEW_PRESS : LOM_VIEW_RELEASE,
                                                      find_key(event->key.keysym.sym), 0, 0 });
        break;
    case SDL_MOUSEMOTION:
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
        take_mouse(view, event);
        break;
    case SDL_MOUSEWHEEL:
        if (event->wheel.y != 0)
            lom_take_view_event(view, &(struct lom_view_event){ LOM_VIEW_WHEEL, 0, 0, event->wheel.y });
        break;
    case SDL_WINDOWEVENT:
        take_window(view, &event->window);
        break;
    }
}

/* ---- pixels ---- */

/* Whether the surface's pixels are those that the view paints: blue, green, red and one that nobody looks at. */
static bool is_bgrx(const SDL_Surface *surface)
{
    SDL_PixelFormat format = *surface->format;
    Uint32 bgrx[3] = { 0xff0000, 0xff00, 0xff };
    if (SDL_BYTEORDER == SDL_BIG_ENDIAN)
        for (int i = 0; i < 3; i++)
            bgrx[i] = (Uint32)0xff00 << (8 * i);
    return format.BytesPerPixel == 4 && format.Rmask == bgrx[0] && format.Gmask == bgrx[1] && format.Bmask == bgrx[2];
}

static bool convert(const struct window *w, SDL_Surface *surface, lom_error *error)
{
    struct lom_view *view = w->view;
    size_t pitch = 4 * (size_t)view->width;
    uint8_t *pixels = lom_allocate((size_t)view->height, pitch, error);
    if (pixels == NULL)
        return false;
    lom_paint_view(view, pixels, pitch);
    bool done = w->sdl.ConvertPixels(view->width, view->height, SDL_PIXELFORMAT_BGRA32, pixels, (int)pitch,
                                     surface->format->format, surface->pixels, surface->pitch) == 0;
    lom_release(pixels);
    return done || fail(w, "the window's pixels", error);
}

static bool paint(struct window *w, lom_error *error)
{
    struct lom_view *view = w->view;
    SDL_Surface *surface = w->sdl.GetWindowSurface(w->window);
    if (surface == NULL)
        return fail(w, "the window's surface", error);
    if (surface->w != view->width || surface->h != view->height) { /* the event of that is on its way */
        view->is_unpainted = true;
        return true;
    }
    double start = milliseconds(w);
    if (!is_bgrx(surface) || SDL_MUSTLOCK(surface)) {
        if (!convert(w, surface, error))
            return false;
    } else {
        lom_paint_view(view, surface->pixels, (size_t)surface->pitch);
    }
    double painted = milliseconds(w);
    if (w->sdl.UpdateWindowSurface(w->window) != 0)
        return fail(w, "the window's surface", error);
    w->painting += painted - start;
    w->showing += milliseconds(w) - painted;
    w->shown++;
    return true;
}

static bool open_window(struct window *w, lom_error *error)
{
    const struct lom_view *view = w->view;
    const char *title = view->scene->title != NULL ? view->scene->title : view->path;
    w->sdl.SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0"); /* else the window is replaced by one with a renderer */
    w->sdl.SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");       /* signals.c has them */
    if (w->sdl.Init(SDL_INIT_VIDEO) != 0)
        return fail(w, "no window can be opened", error);
    w->sdl.EnableScreenSaver();
    w->sdl.StopTextInput();
    w->window = w->sdl.CreateWindow(title, SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, view->width, view->height,
                                    SDL_WINDOW_RESIZABLE);
    return w->window != NULL || fail(w, "no window can be opened", error);
}

/* ---- the loop ---- */

static void take_events(struct window *w)
{
    SDL_Event event;
    while (w->sdl.PollEvent(&event))
        take_event(w->view, &event);
}

/* The seconds since the last turn, a quarter at most. At rest that long is waited for an event, since files may change; else
 * a turn takes a sixtieth, unless as many are wanted as there can be. */
static double wait_for_turn(struct window *w, double *before, bool rests)
{
    double passed = milliseconds(w) - *before;
    if (rests)
        w->sdl.WaitEventTimeout(NULL, 250);
    else if (!w->view->is_free && passed < turn_time)
        w->sdl.Delay((Uint32)lom_count_of(turn_time - passed, 16));
    double now = milliseconds(w);
    passed = now - *before;
    *before = now;
    return lom_smaller(passed, 250) / 1000;
}

static void draw(struct window *w)
{
    const int before = w->view->pictures;
    double start = milliseconds(w);
    lom_draw_view(w->view);
    if (w->view->pictures != before)
        w->drawing += milliseconds(w) - start;
}

static bool is_held(const struct lom_view *view)
{
    for (int i = 0; i < LOM_VIEW_KEYS; i++)
        if (view->held[i])
            return true;
    return false;
}

/* What passed at rest moved nothing: it does not count for what begins to move now. */
static bool turn(struct window *w, double *before, lom_error *error)
{
    bool rests = lom_view_rests(w->view) && !w->view->is_unpainted && !is_held(w->view);
    double seconds = wait_for_turn(w, before, rests);
    if (rests) {
        lom_step_view(w->view, seconds);
        seconds = turn_time / 1000;
    }
    take_events(w);
    lom_step_view(w->view, seconds);
    draw(w);
    return !w->view->is_unpainted || paint(w, error);
}

static bool play(struct window *w, struct lom_script *script, lom_error *error)
{
    SDL_Event event;
    while (w->sdl.PollEvent(&event))
        w->view->ends = w->view->ends || event.type == SDL_QUIT;
    const int before = w->view->pictures;
    double start = milliseconds(w);
    if (!lom_play_script(script, w->view, error))
        return false;
    if (w->view->pictures != before)
        w->drawing += milliseconds(w) - start;
    w->sdl.SetWindowSize(w->window, w->view->width, w->view->height);
    return !w->view->is_unpainted || paint(w, error);
}

static void tell_times(const struct window *w)
{
    double pictures = lom_larger_int(w->view->pictures, 1), shown = lom_larger_int(w->shown, 1);
    fprintf(stderr, "lom: %d pictures drawn in %.2f ms each; %d shown: painting %.2f ms, showing %.2f ms each\n",
            w->view->pictures, w->drawing / pictures, w->shown, w->painting / shown, w->showing / shown);
}

bool lom_check_window(lom_error *error)
{
    struct sdl sdl;
    return load(&sdl, error);
}

static bool show(struct window *w, struct lom_script *script, lom_error *error)
{
    bool done = open_window(w, error);
    double before = milliseconds(w);
    while (done && !w->view->ends)
        done = script != NULL ? play(w, script, error) : turn(w, &before, error);
    if (w->window != NULL)
        w->sdl.DestroyWindow(w->window);
    w->sdl.Quit();
    return done;
}

bool lom_show_window(struct lom_view *view, struct lom_script *script, bool times, lom_error *error)
{
    struct window w = { .view = view };
    const struct lom_view_host host = view->host;
    if (!load(&w.sdl, error))
        return false;
    if (script == NULL) {
        view->host.milliseconds = milliseconds;
        view->host.interrupts = interrupts;
        view->host.context = &w;
    }
    bool done = show(&w, script, error);
    view->host = host;
    if (times)
        tell_times(&w);
    return done;
}
