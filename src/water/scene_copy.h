/* What the frame shows already of the scene behind a plane, into a picture of the scene with the same view. */
#ifndef LOM_WATER_SCENE_COPY_H
#define LOM_WATER_SCENE_COPY_H

#include "shading/eye.h"

struct lom_scene_copy_uniforms {
    float height[3];  /* of what is seen at a window position, over the eye, a metre along the view axis: x, y, 1; of
                         where parallel rays start */
    float side, over; /* copied where side height + over is above the margin */
    float margin;
    struct lom_eye_uniform eye;
    float origin[2];                  /* the frame's pixel that (0, 0) of the textures is */
    const lom_texture *color, *depth; /* reversed, infinite */
};

extern const lom_shader lom_scene_copy_shader;

#endif
