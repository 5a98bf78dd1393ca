/* Clouds as they are drawn: their set, the shadow that they throw, and their pictures between frames. */
#ifndef LOM_RENDER_CLOUDS_CLOUDS_H
#define LOM_RENDER_CLOUDS_CLOUDS_H

#include "cloud/cloud_draw.h"
#include "cloud/impostor.h"
#include "render/scene_view.h"

struct frame;

/* What clouds let through of the sun, over a plane: the shadows that fall on the ground and the water. */
struct lom_ground_shadow {
    lom_texture *texture;
    bool falls;        /* on something, in this frame */
    double s[4], t[4]; /* texture coordinates of a place (x, y, z, 1) */
    uint64_t made_for;
};

/* A cloud's picture between frames: in one part, or in a far and a near one (the aircraft is between them). */
struct lom_impostor {
    struct lom_plate plate;
    bool is_made, is_small, is_around; /* small: not drawn; around: the cloud is about the eye */
    int parts;
    uint64_t made_in;                       /* lom_impostors.frames when it was made */
    double cut;                             /* of two parts: metres along the plate's axis from its eye */
    double sun[3], phase;                   /* of the light and of the shapes when it was made */
    lom_texture *marched[2], *magnified[2]; /* magnified: NULL when the marched picture is shown as it is */
    struct lom_plate wanted;                /* what the frame would make; whether it is to */
    int wanted_parts;
    double wanted_cut;
    bool is_due;
};

/* The light a cloud's plates were last made for. */
struct lom_cloud_sun {
    double to_light[3], color[3];
    double allowance; /* radians the sun may move from there */
};

/* The impostors of the frame's eye and of its mirror image in the water, one a cloud; a function of the frames drawn
 * since the run began. */
struct lom_impostors {
    struct lom_impostor *of_eye[2]; /* NULL until needed */
    struct lom_cloud_sun *suns;
    uint64_t frames;          /* begun so far */
    int swept;                /* grids of light, in this frame */
    bool continues;           /* this frame follows the one before in a run */
    int frame, width, height; /* of the last frame */
};

struct lom_drawn_clouds {
    struct lom_cloud_set *set; /* NULL: none */
    struct lom_cloud_shade shade;
    struct lom_ground_shadow ground_shadow;
    struct lom_impostors impostors;
};

bool lom_load_clouds(lom_renderer *renderer, lom_error *error);
/* Makes their light and their shadow before anything is drawn. */
bool lom_prepare_clouds(struct frame *f, lom_error *error);
/* Draws the clouds that this view sees over a picture that is finished, in a pass like `pass`; depth is the picture's.
 * The renderer has clouds. *count: how many are in view. */
bool lom_draw_clouds_over(struct frame *f, const struct lom_scene_view *view, lom_pass_desc pass, lom_texture *depth,
                          size_t *count, lom_error *error);
/* The frame's clouds over all that it holds, a step of the plan. */
bool lom_draw_clouds(struct frame *f, lom_error *error);
void lom_free_clouds(lom_renderer *renderer);
/* Their light and the shadow that they throw are made anew by the next frame. */
void lom_drop_cloud_light(lom_renderer *renderer);
/* The clouds of another scene, which differ from those of the scene before in what is looked up in each frame alone. */
void lom_follow_clouds(lom_renderer *renderer, const lom_scene *before, const lom_scene *scene);

/* terrain_shade.c: whether a cloud is so low that terrain may keep the sun off it; tells the set of that shadow, once the
 * terrain's is made and the clouds are where they are in the frame. */
bool lom_terrain_shades_clouds(const struct frame *f);
void lom_shade_clouds(struct frame *f);

/* shadow.c: the map of what they let through of the sun, a step of the plan; the same for places less the eye. */
bool lom_draw_cloud_shadows(struct frame *f, const double to_light[3]);
void lom_set_cloud_light(struct lom_light_uniform *light, const lom_renderer *renderer, lom_vec3 eye);

/* impostors.c: whether this frame goes on with the run's impostors; then lom_draw_clouds_over by them. */
bool lom_begin_impostors(struct frame *f, lom_error *error);
/* Whether clouds are drawn by them: plates are what the eye of a run of frames sees, and clouds are
 * marched for parallel rays and in views. */
bool lom_has_plates(const struct frame *f);
bool lom_draw_impostors(struct frame *f, const struct lom_scene_view *view, const struct lom_cloud_view *seen,
                        const lom_pass_desc *pass, size_t *count, lom_error *error);
void lom_free_impostors(lom_renderer *renderer);
/* The next frame begins a run. */
void lom_end_impostor_run(lom_renderer *renderer);
/* So it does, unless it says that it continues. */
void lom_interrupt_impostor_run(lom_renderer *renderer);

#endif
