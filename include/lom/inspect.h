/* lom/inspect.h - why a pixel of a scene has its colour: what drew it, followed through what its shaders looked up.
 *
 * Steps of use, in order: lom_create_renderer (lom/render.h); lom_explain draws the frame while it watches the pixel, then
 * again while it watches also the texels of this frame's own pictures (mirror, refraction, shadow maps, plates of clouds)
 * that the pixel's shaders read, and so on; lom_free_explanation. Everything told is what the stages recorded
 * (lom/record.h); nothing is computed a second time beside them.
 */
#ifndef LOM_INSPECT_H
#define LOM_INSPECT_H

#include <lom/record.h>
#include <lom/render.h>

LOM_API_BEGIN

enum { LOM_MAX_VERDICT = 480, LOM_MAX_FOLLOW = 8 };

typedef struct lom_explain_desc {
    lom_frame_desc frame; /* its crop is not used */
    int x, y;             /* of the whole frame; of the view that the frame names */
    int width, height;    /* 0: 1; more than one pixel is not followed */
    int follow;           /* how many pictures deep, 0 .. LOM_MAX_FOLLOW */
} lom_explain_desc;

/* One texel that was watched. */
typedef struct lom_explained {
    const lom_texture *texture;
    const lom_texture *filtered; /* that it was made of by smoothing edges, recorded with it; NULL: none */
    const char *name;            /* "picture", or the texture's label */
    int x, y;                    /* texel; of the picture: the frame's pixel */
    uint64_t before;             /* the pass that read it; of the picture 0 */
    int depth;                   /* pictures between it and the pixel */
    const lom_pixel_record *record;
    const lom_triangle_record *owner; /* the last triangle that is stored there; NULL: none */
    lom_vec3 eye; /* of the picture's pass, as in the scene's file: places less the eye plus this are places */
    char verdict[LOM_MAX_VERDICT]; /* a sentence */
} lom_explained;

typedef struct lom_explanation {
    lom_frame frame;   /* its picture is the explained pixels alone */
    int width, height; /* of the whole frame; in a view of the view's picture, as are the pixels */
    const char *view;  /* the scene's name of the view that holds the pixel; NULL: none */
    size_t count;
    lom_explained item[LOM_MAX_WATCHES]; /* the pixel, then what it looked up, what that looked up ... */
} lom_explanation;

/* Explains a pixel; NULL on failure (outside the frame, a scene that is traced and has no passes). The explanation's
 * records are the device's: it is used and freed before the renderer draws again. */
lom_explanation *lom_explain(lom_renderer *renderer, const lom_explain_desc *desc, lom_error *error);
void lom_free_explanation(lom_renderer *renderer, lom_explanation *explanation); /* NULL is allowed */

/* What draws by a device without a renderer, as a function that is called again and again. Each time it draws the same
 * passes into the same textures, and looks up the same ones, which stay; each of its passes has a label of its own. */
typedef struct lom_drawing {
    lom_device *device;
    void *context;
    lom_image *(*draw)(void *context, lom_error *error); /* its picture, for the caller to free; NULL on failure */
} lom_drawing;

/* Explains a pixel of a texture that the drawing draws into, which is its picture, as lom_explain does. NULL on failure; used
 * and freed before the device draws again. */
lom_explanation *lom_explain_drawing(const lom_drawing *drawing, const lom_texture *picture, int x, int y, int depth,
                                     lom_error *error);
void lom_free_drawing_explanation(const lom_drawing *drawing, lom_explanation *explanation); /* NULL is allowed */

/* The lookup's texel that was followed, NULL: none. pass: the one that the lookup was made in. */
const lom_explained *lom_followed(const lom_explanation *explanation, uint64_t pass, const lom_note_record *lookup);
/* The heaviest texel of a lookup, within level 0; NULL: it read none. */
const lom_tap *lom_main_tap(const lom_note_record *lookup);
/* The shader's or the draw's own name of a draw. */
const char *lom_draw_name(const lom_draw_record *draw);
/* What its primitives are called: "triangle" or "line". */
const char *lom_primitive_name(const lom_draw_record *draw);
const char *lom_pass_name(const lom_pass_record *pass);

/* ---- the pictures of passes ---- */

/* A pass whose picture can be shown, of a table; NULL behind the last. */
typedef struct lom_shown_pass {
    const char *name; /* "reflection" */
    const char *text; /* what its numbers are */
    bool is_color;    /* three channels of linear light; else one of numbers, or three of a vector */
} lom_shown_pass;
const lom_shown_pass *lom_describe_shown_pass(size_t index);
/* Whether there is one of this name; false: the error lists them. */
bool lom_check_shown_pass(const char *name, lom_error *error);
/* What the pass of this name left in the frame that the renderer drew last: floats, one or three channels, top row first.
 * "normals" and "objects" draw that frame again while they tally it, "motion" in strips while it watches every pixel. NULL on failure: an
 * unknown name (the error lists them), a scene or frame without that pass. */
lom_image *lom_show_pass(lom_renderer *renderer, const lom_frame_desc *desc, const char *name, lom_error *error);
/* The same for eyes: 8-bit sRGB of three channels; numbers stretched from the lowest to the highest that is not 0, in 16
 * bits; vectors halved around middle gray; objects in colours of their own. The picture is freed. */
lom_image *lom_show_to_eyes(lom_image *raw, const char *name, lom_error *error);

/* ---- overlays: numbers over the picture, counted by the stages while they draw it ---- */

/* A kind of overlay, of a table; NULL behind the last. */
typedef struct lom_overlay_kind {
    const char *name;     /* "overdraw" */
    const char *text;     /* what its numbers are */
    double low, high;     /* the ends of its scale, unless others are asked for; both 0: it has none */
    bool is_logarithmic;  /* the scale */
    bool is_reproducible; /* false: by the clock, other numbers each time */
} lom_overlay_kind;
const lom_overlay_kind *lom_describe_overlay(size_t index);
/* The kind of this name; NULL: the error names one that is like it, and lists all. */
const lom_overlay_kind *lom_find_overlay(const char *name, lom_error *error);

/* Where the legend stands: what is shown, the scale, the least, mean and greatest number. */
typedef enum lom_legend {
    LOM_LEGEND_BELOW = 0, /* the picture, which is that much higher */
    LOM_LEGEND_INSIDE,    /* over its lowest rows */
    LOM_LEGEND_NONE
} lom_legend;

typedef struct lom_overlay_desc {
    lom_frame_desc frame; /* its `pixels` are not used */
    const lom_overlay_kind *kind;
    const char *pass; /* whose target is looked at: "picture" (or NULL), "reflection", "refraction", "spray" */
    double low, high; /* the ends of the scale, low < high; both 0: the kind's */
    lom_legend legend;
} lom_overlay_desc;

typedef struct lom_overlay {
    lom_frame frame;    /* as lom_render_frame gives it with one sample a pixel, to the same bytes */
    lom_image *numbers; /* R32F, of normals RGB32F, a number a pixel of the target; NaN: nothing is there to be told */
    lom_image *shown;   /* RGB8: the numbers in colours; where there is none, the picture in a dark gray; the legend */
} lom_overlay;

/* Draws a frame as lom_render_frame does, by the stages at 4 lanes that tally (lom/record.h; with one sample a pixel;
 * kinds by the clock: as ever), and shows the kind's numbers. Called for the frames of a run, it goes on with the run as lom_render_frame does.
 * False on failure (all of *overlay is NULL then): a scene or frame without that pass, a scale that is none. Freed with
 * lom_free_overlay, whatever it returned. */
bool lom_draw_overlay(lom_renderer *renderer, const lom_overlay_desc *desc, lom_overlay *overlay, lom_error *error);
void lom_free_overlay(lom_overlay *overlay);

/* ---- a picture of each stage ---- */

enum { LOM_MAX_CAPTION = 560, LOM_MAX_LEGEND = 8, LOM_SCALE_COLORS = 9 };

typedef struct lom_picture_legend {
    uint8_t color[3]; /* sRGB */
    char text[88];
} lom_picture_legend;

/* What a picture of the stages shows. */
typedef struct lom_stage_picture {
    char name[48]; /* of small letters, digits and '-', for a file; no two have the same */
    char title[96];
    char text[LOM_MAX_CAPTION]; /* what is seen, with its figures */
    const char *group;          /* which part of the way: "Triangles", "Pixels", "Varyings" ... */
    const char *source;         /* the file that does it, or NULL: "src/pipeline/clip.c" */
    lom_image *image;           /* of 8-bit sRGB; of the last one, "final", what lom_render_frame gives */
    int legend_count;
    lom_picture_legend legend[LOM_MAX_LEGEND];
    bool has_scale; /* its colours stand for numbers: color[0] for low ... color[8] for high */
    bool is_logarithmic;
    double low, high;
    uint8_t color[LOM_SCALE_COLORS][3];
} lom_stage_picture;

typedef struct lom_stages_desc {
    lom_frame_desc frame; /* its crop, progress and pixels are not used */
    const char *pass;     /* a pass by its label, the last of this name; NULL: "scene", or the last one that draws */
    bool (*progress)(void *context, double done); /* the share (0..1) that is done; false abandons it; NULL: none */
    void *progress_context;
} lom_stages_desc;

typedef struct lom_stage_pictures {
    size_t count;
    lom_stage_picture *picture; /* in the order of the stages */
    int width, height;          /* of the frame */
    char pass[64];
    lom_plan plan;
} lom_stage_pictures;

/* Draws the frame, and its pass again while it is listened to and watched, a band of rows at a time: a picture of what
 * each stage made. The frame's passes are drawn some dozen times. NULL on failure: no pass of that name (the error lists
 * them), a scene that is traced. Freed with lom_free_stage_pictures; it outlives the renderer. */
lom_stage_pictures *lom_picture_stages(lom_renderer *renderer, const lom_stages_desc *desc, lom_error *error);
void lom_free_stage_pictures(lom_stage_pictures *pictures); /* NULL is allowed */

/* The same pictures of a drawing, with an empty plan. pass: by its label; NULL: "scene", or the first one that draws. The
 * device watches nothing afterwards. NULL on failure. */
lom_stage_pictures *lom_picture_drawing(const lom_drawing *drawing, const char *pass, lom_error *error);

LOM_API_END

#endif
