/* The eye of `lom view`: where it is and looks, in the world or in the coordinates of an entity that it follows. */
#ifndef LOM_CLI_VIEW_EYE_H
#define LOM_CLI_VIEW_EYE_H

#include <lom/scene.h>

enum lom_eye_kind {
    LOM_EYE_SCENE, /* the scene's camera and its path */
    LOM_EYE_FREE,  /* in the world */
    LOM_EYE_THIRD, /* around the followed entity, turned by its heading */
    LOM_EYE_FIRST, /* in it */
    LOM_EYE_KINDS
};

struct lom_eye {
    enum lom_eye_kind kind;
    size_t followed;           /* 1 + index of the entity; 0: none */
    lom_vec3 position, target; /* in the coordinates of the followed entity, when there is one */
    double yaw, pitch; /* radians; free and first: of the line of sight; third: of both places around the entity */
    double distance;   /* third: the places are so many times as far away */
    double degrees;    /* vertical angle of view */
    double height;     /* metres of a parallel projection */
};

/* The scene's camera at a time as an eye of that kind (not LOM_EYE_SCENE): a third and a first person keep the place of
 * the file's camera where it follows the same entity so; else they have one that suits an aircraft. followed: 1 + the
 * entity's index. seen: the camera at that time. */
struct lom_eye lom_make_eye(enum lom_eye_kind kind, size_t followed, const lom_scene *scene, const lom_camera *camera,
                            const lom_camera_view *seen, double time);
/* The camera table that has this eye, without keys; its projection and its planes stay as they are. */
void lom_eye_camera(const struct lom_eye *eye, lom_camera *camera);
/* What it sees in a scene at a time. */
lom_camera_view lom_eye_view(const struct lom_eye *eye, const lom_scene *scene, double time);
/* The same camera as the value of the key "camera" in a scene file: "{ position = ... }". name: the followed entity's;
 * like: the camera whose projection and planes it has. The number of characters, at most room - 1. */
size_t lom_print_eye(char *text, size_t room, const struct lom_eye *eye, const char *name, const lom_scene *scene,
                     const lom_camera *like);

/* Turns it by radians to the left and upwards; a third person goes around. Never over the zenith. */
void lom_turn_eye(struct lom_eye *eye, double left, double up);
/* Moves it by metres along its own axes; a third person's metre is a hundredth of the distance: `ahead` nearer, `right` and
 * `up` around what is followed. */
void lom_move_eye(struct lom_eye *eye, double ahead, double right, double up);
/* Multiplies the angle of view, within 1..150 degrees, and the height of parallel projections. */
void lom_zoom_eye(struct lom_eye *eye, double factor);

#endif
