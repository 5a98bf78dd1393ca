/* Pictures of the stages of one pass: what its parts share. In the order of their turns: steps.c draws the frame and lists
 * its passes; steps_triangles.c draws what it is told of all triangles; steps_record.c takes what is recorded of all
 * pixels into planes; steps_planes.c, steps_textures.c and steps_passes.c make pictures of them. */
#ifndef LOM_INSPECT_STEPS_H
#define LOM_INSPECT_STEPS_H

#include "inspect/canvas.h"
#include "render/renderer.h"

/* A pass of the frame, as it ended. */
struct listed_pass {
    uint64_t number;
    const char *label, *target; /* target: the label of its texture */
    lom_pass_desc desc;
    size_t draws, times; /* times: as many of this name and target */
    bool blends;
    lom_image *image; /* of its first colour or its depth, as it stands there */
};

/* A number (or three) of every pixel. */
enum plane_kind { PLANE_COUNT, PLANE_VARYING, PLANE_VALUE, PLANE_LEVEL, PLANE_COLOR, PLANE_BLEND };
struct plane {
    enum plane_kind kind;
    const char *name; /* of a count, value, level, blend */
    char title[64];   /* of a varying: the names that its shader gives it */
    const lom_shader *shader;
    int index, components;
    float *value;   /* components a pixel */
    bool *is_there; /* of each pixel */
    size_t there;
};

/* The texels of a texture's level that were read. */
struct read_level {
    const lom_texture *texture;
    int level, layer;
    int width, height;
    uint32_t *times; /* of each texel */
    uint64_t reads;
};

/* What a frame's stages make that is no pass: pictures of lom_show_pass. */
enum { MADE_PICTURES = 3 };
struct made_picture {
    const char *name;
    lom_image *image; /* NULL: the scene has none */
};

/* Primitives by their corners: [0] points and sprites, [1] lines, [2] triangles. */
enum { CORNER_KINDS = 3, MAX_COUNTED = 96 };
struct counted {
    uint64_t of[CORNER_KINDS];
};

struct steps {
    lom_device *device;
    const char *pass; /* that is asked for; NULL: none */
    /* Draws all of it, or, not whole, what goes up to the pass `last`; whole: *image is its picture. */
    bool (*draw)(struct steps *s, bool whole, lom_image **image);
    lom_renderer *renderer; /* of a frame, with its description; NULL: of a drawing */
    const lom_stages_desc *desc;
    const lom_drawing *drawing;
    lom_stage_pictures *out;
    lom_error *error;
    bool failed; /* the error says why */
    size_t capacity;

    struct listed_pass *passes;
    size_t pass_count, pass_capacity;
    struct listed_pass chosen, blended; /* blended: label NULL: none */
    uint64_t last;                      /* the pass behind which a frame is left off */
    const lom_texture *target;          /* of the chosen one */
    int attachment;
    int width, height, zoom; /* of the target; pixels of a picture for one of its */
    int drawn, frames;       /* of all that are to be drawn */

    struct made_picture made[MADE_PICTURES];
    struct plane *planes;
    size_t plane_count, plane_capacity;
    struct read_level *levels;
    size_t level_count, level_capacity;
    uint64_t *owner;           /* of each pixel: which triangle of which draw; 0: none */
    struct counted primitives; /* of the chosen pass, as they were told */
};

/* Takes the image into the list, with a title and a text; NULL without memory, or when the image is NULL. */
lom_stage_picture *lom_add_picture(struct steps *s, const char *group, const char *name, const char *title,
                                   const char *source, lom_image *image, const char *format, ...)
    __attribute__((format(printf, 7, 8)));
void lom_add_legend(lom_stage_picture *picture, const struct ink *ink, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void lom_add_scale(lom_stage_picture *picture, const uint8_t ramp[LOM_RAMP_COLORS][3], double low, double high,
                   bool is_logarithmic);
/* Draws what goes up to the pass s->last once more, to a listener or, NULL, as it is watched. */
bool lom_draw_chosen(struct steps *s, const lom_listener *listener);
/* So many frames more have been drawn: tells whoever waits; false: it is abandoned. */
bool lom_tell_steps(struct steps *s, int frames);
/* Whether a texture that a frame had is there still: plates come and go. */
bool lom_is_alive(const struct steps *s, const lom_texture *texture);
/* Watches a part of the chosen pass's target, up to the pass s->last. */
bool lom_watch_target(struct steps *s, lom_rect at);
/* Whether a triangle wrote what the chosen pass's target held then. */
bool lom_is_seen(const struct steps *s, const lom_triangle_record *t);
/* Frames that lom_record_planes draws. */
int lom_count_bands(const struct steps *s);

/* "12 triangles, 5 lines and 1 point": what there is of them; "0 triangles" where nothing is. */
bool lom_any_counted(const struct counted *counted);
const char *lom_say_counted(const struct counted *counted, char text[MAX_COUNTED]);

void lom_picture_triangles(struct steps *s);
void lom_record_planes(struct steps *s);
void lom_picture_coverage(struct steps *s);
void lom_picture_detail(struct steps *s); /* steps_detail.c: a few pixels, large */
void lom_picture_planes(struct steps *s);
void lom_picture_textures(struct steps *s);
/* What the frame that was drawn last has made, while it is there; then the pictures of it and of the passes. */
bool lom_take_made(struct steps *s, const lom_frame_desc *frame);
void lom_picture_passes(struct steps *s);

#endif
