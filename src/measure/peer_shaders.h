/* The shaders of the peers' workloads and what each is given. Formulas: bench/peers/README.md, "Workloads". */
#ifndef LOM_MEASURE_PEER_SHADERS_H
#define LOM_MEASURE_PEER_SHADERS_H

#include <lom/march.h>
#include <lom/pipeline.h>

/* Window-filling strip of 4 vertices, without attributes. */
typedef struct lom_peer_flat {
    float z;
    float color[4];
} lom_peer_flat;

typedef struct lom_peer_show { /* the same strip at z = 0, showing a depth texture as 1 - (1 - z) * 4 */
    const lom_texture *depth;
} lom_peer_show;

typedef struct lom_peer_lit { /* attributes: position, normal */
    float to_clip[16];        /* [column * 4 + row] */
    float eye[3], light[3];   /* light: unit vector towards it */
} lom_peer_lit;

typedef struct lom_peer_depth { /* attributes: position */
    float to_clip[16];
} lom_peer_depth;

typedef struct lom_peer_ground { /* attributes: position, normal, uv */
    float to_clip[16];
    float eye[3], light[3];
    float clip[4]; /* keeps clip . (position, 1) >= 0 */
    const lom_texture *albedo, *normals;
} lom_peer_ground;

typedef struct lom_peer_dome { /* attributes: position */
    float to_clip[16];
    const lom_texture *cube;
} lom_peer_dome;

typedef struct lom_peer_lake { /* attributes: position, uv */
    float to_clip[16];
    float eye[3], light[3];
    float move;
    float near_plane, far_plane;
    float per_width, per_height; /* 1 / size of the window */
    const lom_texture *reflection, *refraction, *refraction_depth, *dudv, *normals;
} lom_peer_lake;

typedef struct lom_peer_copy { /* the window's strip */
    float rise[2];             /* height a metre along the view axis: rise[0] + y rise[1] */
    float eye_height, below;
    float near_plane, far_plane;
    const lom_texture *color, *depth;
} lom_peer_copy;

typedef struct lom_peer_puff { /* attributes: position */
    float to_clip[16];
    float eye[3]; /* in the volume's space */
    lom_march_desc march;
} lom_peer_puff;

typedef struct lom_peer_card { /* attributes: position, colour, uv; sprites: the position is in clip coordinates */
    float to_clip[16];
    const lom_texture *texture;
} lom_peer_card;

typedef struct lom_peer_colored_box { /* attributes: position, a corner of the cube of +-1 */
    float to_clip[16];
    float centre[3], size, color[3];
} lom_peer_colored_box;

typedef struct lom_peer_layer { /* the window's strip; uv = scale * (cos, -sin; sin, cos) (aspect * x, y) */
    float z, aspect;
    float along[2]; /* scale * cos, scale * sin */
    const lom_texture *texture;
} lom_peer_layer;

extern const lom_shader lom_peer_flat_shader, lom_peer_show_shader, lom_peer_lit_shader, lom_peer_depth_shader;
extern const lom_shader lom_peer_ground_shader, lom_peer_clipped_ground_shader, lom_peer_dome_shader;
extern const lom_shader lom_peer_lake_shader, lom_peer_copy_shader, lom_peer_puff_shader;
extern const lom_shader lom_peer_gradient_shader, lom_peer_sprite_shader, lom_peer_card_shader;
extern const lom_shader lom_peer_box_shader, lom_peer_layer_shader;

/* M (p, w) with w 0 or 1 */
LOM_INLINE lom_float4 lom_peer_transform(const float m[16], lom_float4 p, float w)
{
    lom_float row[4];
    for (int i = 0; i < 4; i++)
        row[i] = p.x * m[i] + p.y * m[4 + i] + p.z * m[8 + i] + m[12 + i] * w;
    return (lom_float4){ row[0], row[1], row[2], row[3] };
}

LOM_INLINE void lom_peer_write3(lom_float *varying, lom_float4 value)
{
    varying[0] = value.x;
    varying[1] = value.y;
    varying[2] = value.z;
}

LOM_INLINE lom_float3 lom_peer_read3(const lom_float *varying)
{
    return (lom_float3){ varying[0], varying[1], varying[2] };
}

LOM_INLINE lom_float3 lom_peer_vector(const float v[3])
{
    return lom_splat3(v[0], v[1], v[2]);
}

/* x to the power of 2^squarings */
LOM_INLINE lom_float lom_peer_square(lom_float x, int squarings)
{
    for (int i = 0; i < squarings; i++)
        x = x * x;
    return x;
}

/* Distance along the view axis of a depth in 0..1. */
LOM_INLINE lom_float lom_peer_linear_depth(float near_plane, float far_plane, lom_float z)
{
    return 2.0f * near_plane * far_plane / (far_plane + near_plane - (2.0f * z - 1.0f) * (far_plane - near_plane));
}

LOM_INLINE lom_float lom_peer_positive(lom_float x)
{
    return lom_max(x, (lom_float){ 0 });
}

#endif
