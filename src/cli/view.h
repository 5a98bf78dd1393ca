/* `lom view`: a scene that is looked at, moved through and changed, whoever shows its pixels and brings its events (a
 * window, a script, a test). What it shows is at any time the picture of `lom render` with some options: the scene's
 * file, the settings below, a time and a camera; lom_view_command says which. */
#ifndef LOM_CLI_VIEW_H
#define LOM_CLI_VIEW_H

#include "scene_options.h"
#include "view_eye.h"
#include "view_settings.h"
#include "watch.h"

#include <lom/render.h>

/* ---- what comes in ---- */

/* A key is the character on it, in small letters, or one of these. */
enum {
    LOM_VIEW_BACKSPACE = 8,
    LOM_VIEW_TAB = 9,
    LOM_VIEW_ENTER = 13,
    LOM_VIEW_ESCAPE = 27,
    LOM_VIEW_SPACE = 32,
    LOM_VIEW_UP = 128,
    LOM_VIEW_DOWN,
    LOM_VIEW_LEFT,
    LOM_VIEW_RIGHT,
    LOM_VIEW_PAGE_UP,
    LOM_VIEW_PAGE_DOWN,
    LOM_VIEW_SHIFT,
    LOM_VIEW_F1,
    LOM_VIEW_KEYS
};

enum lom_view_event_kind {
    LOM_VIEW_PRESS,   /* key; again while it is held, as often as the system repeats it */
    LOM_VIEW_RELEASE, /* key */
    LOM_VIEW_BUTTON,  /* the left button goes down at x, y */
    LOM_VIEW_LET_GO,  /* and up */
    LOM_VIEW_POINT,   /* the mouse is at x, y */
    LOM_VIEW_WHEEL,   /* y notches away from the user */
    LOM_VIEW_RESIZE   /* the pixels are x wide and y high */
};

struct lom_view_event {
    enum lom_view_event_kind kind;
    int key, x, y;
};

/* What a scene that is of another format has besides. */
#define LOM_VIEW_FORMAT "output.format=\"rgb8\""

/* Who shows it. */
struct lom_view_host {
    lom_pixel_order order;               /* of the pixels that lom_paint_view writes: RGBX or BGRX */
    double (*milliseconds)(void *clock); /* what drawing takes is measured by; NULL: it takes no time */
    bool (*interrupts)(void *context);   /* events wait, for which a picture at rest is abandoned; NULL: never */
    void *context;
    bool is_patient; /* a scene that is read is waited for, so that what follows is the same every time */
};

/* ---- the parts ---- */

/* Pixels as the host orders them. */
struct lom_view_picture {
    uint8_t *pixels;
    size_t room; /* bytes */
    int width, height;
    bool fills; /* the window, whatever its own size; else it keeps its proportions (pictures of passes) */
};

/* The steered entity. */
struct lom_pilot {
    bool flies;
    size_t entity;                  /* index */
    lom_vec3 position;              /* metres */
    double yaw, pitch, roll, speed; /* radians, as Ry(yaw) Rx(pitch) Rz(roll); metres a second along -z */
    double turning, rising;         /* -1..1, of the keys that are held */
};

/* The sun as it was moved, in degrees. */
struct lom_moved_sun {
    bool moved, goes;
    double azimuth, elevation;
};

/* The camera's way while it is recorded. */
struct lom_recording {
    bool runs;
    double seconds, start; /* since it began; the view's time then */
    size_t count, room;
    lom_camera_key *keys; /* in the coordinates of the eye, angles in degrees */
};

struct lom_view {
    const char *path;
    struct lom_scene_options options; /* of the command line */
    struct lom_view_host host;

    lom_scene *scene;
    lom_renderer *renderer;
    lom_camera camera;    /* the file's */
    bool is_other_format; /* than rgb8, in the file: it has LOM_VIEW_FORMAT besides */
    struct lom_watched *watched;
    double since_look;                  /* seconds since the files were looked at */
    struct lom_view_load *load;         /* a scene that is being read; NULL: none */
    struct lom_settings settings, good; /* what the scene has instead of its file; of the scene that is shown */
    bool has_changed;                   /* the settings or a file have: the scene is to be read again */
    bool is_file_new;                   /* since one of its files was written */
    bool needs_renderer;                /* by another renderer, since it is a file that the scene names */

    int width, height; /* of the window */
    double time;       /* of the scene, seconds */
    bool runs;         /* it goes on */
    struct lom_eye eye;
    double speed; /* of the eye, metres a second */
    struct lom_pilot pilot;
    struct lom_moved_sun sun;
    struct lom_recording recording;
    struct lom_menu *menu;

    bool held[LOM_VIEW_KEYS];
    bool is_pressed;    /* the left button */
    int x, y, wandered; /* the mouse; how far it went since the button was pressed */

    struct lom_view_picture shown, next; /* next: drawn into, and put in the place of shown when it is whole */
    int divisor;                         /* of the size of the picture that is shown */
    bool is_stale, is_exact;             /* it shows not what is to be seen; it is that of `lom render` */
    bool is_nudged, moves;               /* by an event since the last step; something did move in it */
    bool adapts, is_free;                /* smaller pictures while it moves; as many a second as there can be */
    double cost, took, rate;             /* milliseconds at full size, of the last picture; pictures a second */
    double drawn_at;                     /* by the host's clock */
    int pictures;                        /* drawn so far */
    int pass;                            /* the pass that is shown, of lom_describe_shown_pass; -1: none */
    int overlay;                         /* the overlay, of lom_describe_overlay; -1: none */
    bool explains;                       /* the pixel is to be explained */
    int explained_x, explained_y;        /* -1: none is marked */
    bool saves;                          /* the next exact picture is written */

    char message[1200];
    bool is_error;
    bool shows_status, shows_keys;
    bool is_unpainted; /* what lom_paint_view would write has changed */
    bool ends;
};

/* ---- what a host does, in this order again and again ---- */

/* Reads the scene and makes ready; NULL on failure. The strings of path and options outlive it. */
struct lom_view *lom_open_view(const char *path, const struct lom_scene_options *options,
                               const struct lom_view_host *host, lom_error *error);
void lom_close_view(struct lom_view *view); /* NULL is allowed */
void lom_take_view_event(struct lom_view *view, const struct lom_view_event *event);
/* Moves everything on by that many seconds. */
void lom_step_view(struct lom_view *view, double seconds);
/* Draws the picture when it is stale or, at rest, not yet exact; one call, one picture. */
void lom_draw_view(struct lom_view *view);
/* Whether the next step or draw would do something by itself. */
bool lom_view_rests(const struct lom_view *view);
/* The picture with all that is written on it, width x height of the host's pixels; the view is then painted. */
void lom_paint_view(struct lom_view *view, uint8_t *pixels, size_t pitch);
/* The picture that is shown as `lom render` has it; NULL on failure. */
lom_image *lom_view_image(const struct lom_view *view, lom_error *error);

/* ---- what the parts ask of one another ---- */

/* A sentence on the picture; an error also on standard error. An empty one removes it. */
void lom_tell_view(struct lom_view *view, bool is_error, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* What is to be seen has changed. */
void lom_spoil_view(struct lom_view *view);
/* The frame that is to be seen, at a part of its size; camera: room for its eye. */
lom_frame_desc lom_view_frame(const struct lom_view *view, int divisor, lom_camera_view *camera);
/* The command that draws it: "lom render ..."; NULL on failure, freed with lom_release. */
char *lom_view_command(const struct lom_view *view, lom_error *error);

/* view_load.c: reads the scene again on a thread of its own when settings or files have changed; shows it when that is
 * done. */
void lom_reload_view(struct lom_view *view);
/* Waits for what is being read and leaves it. */
void lom_stop_load(struct lom_view *view);

/* view_keys.c */
void lom_press_key(struct lom_view *view, int key);
/* The key of a name ("w", "space", "page_up"); 0: there is none. */
int lom_find_view_key(const char *name);
/* What the i-th line of the list of keys says: "w s  forward, back"; false behind the last. */
bool lom_describe_view_key(size_t i, const char **keys, const char **text);

/* view_move.c: what moves the eye. */
/* 1, -1 or 0 by two keys that are held or not. */
double lom_pull_of_keys(const struct lom_view *view, int more, int less);
/* An eye that can be moved, in the place of the scene's. */
void lom_use_eye(struct lom_view *view);
/* The next kind of eye; the next entity to follow. */
void lom_next_eye(struct lom_view *view);
void lom_next_entity(struct lom_view *view);
/* What is drawn: with the settings that it needs. followed: 1 + index of an entity, 0: none. */
void lom_choose_eye(struct lom_view *view, enum lom_eye_kind kind, size_t followed);

/* view_pilot.c: entities and the sun. */
/* Begins to steer the entity that is followed or moves; false: there is none, which is told. */
bool lom_take_controls(struct lom_view *view);
void lom_step_pilot(struct lom_view *view, double seconds);
void lom_step_sun(struct lom_view *view, double seconds);
/* Sun, entity and eye as the file has them. */
void lom_give_back(struct lom_view *view);

/* view_record.c */
void lom_toggle_recording(struct lom_view *view);
void lom_step_recording(struct lom_view *view, double seconds);

/* A name for a new file: STEM-N and the ending, N the first for which there is none; NULL on failure, freed with
 * lom_release. */
char *lom_new_name(const char *stem, const char *ending, lom_error *error);

#endif
