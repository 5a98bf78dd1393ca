/* The window of `lom view`, by SDL2; no other file names it. In: the window's events. Out: the view's pixels in the
 * window's surface. Invariant: when nothing changes nothing is drawn, painted or shown, and the program sleeps. */
#include "view_window.h"

#include "base/numbers.h"

#include <SDL.h>

static const double turn_time = 1000.0 / 60; /* milliseconds */

struct window {
    SDL_Window *window;
    struct lom_view *view;
    double drawing, painting, showing; /* milliseconds in all */
    int shown;
};

static bool fail(const char *what, lom_error *error)
{
    return lom_fail(error, LOM_ERROR_FILE, "%s: %s.", what, SDL_GetError());
}

static double milliseconds(void *context)
{
    (void)context;
    return 1e3 * (double)SDL_GetPerformanceCounter() / (double)SDL_GetPerformanceFrequency();
}

/* What somebody did who waits for an answer. */
static bool interrupts(void *context)
{
    static const Uint32 kinds[] = { SDL_KEYDOWN, SDL_MOUSEBUTTONDOWN, SDL_MOUSEWHEEL, SDL_QUIT };
    (void)context;
    SDL_PumpEvents();
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (SDL_HasEvent(kinds[i]))
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

static bool convert(struct lom_view *view, SDL_Surface *surface, lom_error *error)
{
    size_t pitch = 4 * (size_t)view->width;
    uint8_t *pixels = lom_allocate((size_t)view->height, pitch, error);
    if (pixels == NULL)
        return false;
    lom_paint_view(view, pixels, pitch);
    bool done = SDL_ConvertPixels(view->width, view->height, SDL_PIXELFORMAT_BGRA32, pixels, (int)pitch,
                                  surface->format->format, surface->pixels, surface->pitch) == 0;
    lom_release(pixels);
    return done || fail("the window's pixels", error);
}

static bool paint(struct window *w, lom_error *error)
{
    struct lom_view *view = w->view;
    SDL_Surface *surface = SDL_GetWindowSurface(w->window);
    if (surface == NULL)
        return fail("the window's surface", error);
    if (surface->w != view->width || surface->h != view->height) { /* the event of that is on its way */
        view->is_unpainted = true;
        return true;
    }
    double start = milliseconds(NULL);
    if (!is_bgrx(surface) || SDL_MUSTLOCK(surface)) {
        if (!convert(view, surface, error))
            return false;
    } else {
        lom_paint_view(view, surface->pixels, (size_t)surface->pitch);
    }
    double painted = milliseconds(NULL);
    if (SDL_UpdateWindowSurface(w->window) != 0)
        return fail("the window's surface", error);
    w->painting += painted - start;
    w->showing += milliseconds(NULL) - painted;
    w->shown++;
    return true;
}

static bool open_window(struct window *w, lom_error *error)
{
    const struct lom_view *view = w->view;
    const char *title = view->scene->title != NULL ? view->scene->title : view->path;
    SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0"); /* else the window is replaced by one with a renderer */
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");       /* signals.c has them */
    if (SDL_Init(SDL_INIT_VIDEO) != 0)
        return fail("no window can be opened", error);
    SDL_EnableScreenSaver();
    SDL_StopTextInput();
    w->window = SDL_CreateWindow(title, SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, view->width, view->height,
                                 SDL_WINDOW_RESIZABLE);
    return w->window != NULL || fail("no window can be opened", error);
}

/* ---- the loop ---- */

static void take_events(struct window *w)
{
    SDL_Event event;
    while (SDL_PollEvent(&event))
        take_event(w->view, &event);
}

/* The seconds since the last turn, a quarter at most. At rest that long is waited for an event, since files may change; else
 * a turn takes a sixtieth, unless as many are wanted as there can be. */
static double wait_for_turn(const struct window *w, double *before, bool rests)
{
    double passed = milliseconds(NULL) - *before;
    if (rests)
        SDL_WaitEventTimeout(NULL, 250);
    else if (!w->view->is_free && passed < turn_time)
        SDL_Delay((Uint32)lom_count_of(turn_time - passed, 16));
    double now = milliseconds(NULL);
    passed = now - *before;
    *before = now;
    return lom_smaller(passed, 250) / 1000;
}

static void draw(struct window *w)
{
    const int before = w->view->pictures;
    double start = milliseconds(NULL);
    lom_draw_view(w->view);
    if (w->view->pictures != before)
        w->drawing += milliseconds(NULL) - start;
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
    while (SDL_PollEvent(&event))
        w->view->ends = w->view->ends || event.type == SDL_QUIT;
    const int before = w->view->pictures;
    double start = milliseconds(NULL);
    if (!lom_play_script(script, w->view, error))
        return false;
    if (w->view->pictures != before)
        w->drawing += milliseconds(NULL) - start;
    SDL_SetWindowSize(w->window, w->view->width, w->view->height);
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
    (void)error;
    return true;
}

bool lom_show_window(struct lom_view *view, struct lom_script *script, bool times, lom_error *error)
{
    struct window w = { .view = view };
    bool done = open_window(&w, error);
    double before = done ? milliseconds(NULL) : 0;
    if (script == NULL) {
        view->host.milliseconds = milliseconds;
        view->host.interrupts = interrupts;
    }
    while (done && !view->ends)
        done = script != NULL ? play(&w, script, error) : turn(&w, &before, error);
    if (times)
        tell_times(&w);
    if (w.window != NULL)
        SDL_DestroyWindow(w.window);
    SDL_Quit();
    return done;
}
