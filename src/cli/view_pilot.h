/* Steering an entity as an aircraft. */
#ifndef LOM_CLI_VIEW_PILOT_H
#define LOM_CLI_VIEW_PILOT_H

#include "view.h"
#include "view_menu.h"

/* The rotation of a scene's entity (radians, Rz Ry Rx) that is Ry(yaw) Rx(pitch) Rz(roll). */
lom_vec3 lom_rotation_of_flight(double yaw, double pitch, double roll);
/* And back: pitch within +-90 degrees. */
void lom_flight_of_rotation(lom_vec3 rotation, double *yaw, double *pitch, double *roll);
/* Moves an aircraft on: it banks by `turning` (1: to the right), turns as its bank makes it, and rises. */
void lom_fly(struct lom_pilot *pilot, double seconds);

#endif
