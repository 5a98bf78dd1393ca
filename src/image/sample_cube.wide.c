/* Samplers of cube textures: a direction chooses a face and a place on it (OpenGL 4.6, table 8.19); the faces' aprons
 * hold their neighbours' texels (apron.c), so filtering goes on across edges and corners. */
#include "sample_fixed.h"

/*        face  s = (sc / ma + 1) / 2   sc   tc   ma
 *        0  1  +X  -X                  -z +z  -y   |x|
 *        2  3  +Y  -Y                   x   +z -z  |y|
 *        4  5  +Z  -Z                  +x -x  -y   |z|   */
LOM_INLINE void choose_face(const lom_float3 *direction, sample_point *point)
{
    lom_float x = direction->x, y = direction->y, z = direction->z;
    lom_float ax = lom_abs(x), ay = lom_abs(y), az = lom_abs(z);
    lom_mask is_x = (ax >= ay) & (ax >= az);
    lom_mask is_y = ~is_x & (ay >= az);
    lom_float major = lom_select(is_x, x, lom_select(is_y, y, z));
    lom_mask negative = major < 0.0f;
    lom_float z_signed = lom_select(negative, z, -z); /* -z on +X, z on -X; z on +Y is its negative */
    lom_float x_signed = lom_select(negative, -x, x);
    lom_float sc = lom_select(is_x, z_signed, lom_select(is_y, x, x_signed));
    lom_float tc = lom_select(is_y, -z_signed, -y);
    lom_float ma = lom_abs(major);
    lom_float u = sc / ma, v = tc / ma;
    u = lom_select(lom_abs(u) <= 1.0f, u, (lom_float){ 0 });
    v = lom_select(lom_abs(v) <= 1.0f, v, (lom_float){ 0 });
    lom_int axis = lom_select_int(is_x, (lom_int){ 0 }, lom_select_int(is_y, lom_splat_int(2), lom_splat_int(4)));
    point->s = u * 0.5f + 0.5f;
    point->t = v * 0.5f + 0.5f;
    point->face = axis - negative;
}

LOM_INLINE lom_float4 sample_as(bool fixed, lom_storage storage, bool srgb, const lom_texture *texture,
                                const lom_float3 *at, lom_float lod)
{
    sample_point point;
    choose_face(at, &point);
    return sample_by(fixed, texture, LOM_TEXTURE_CUBE, storage, srgb, &point, lod);
}

SAMPLE_EVERY_STORAGE(void LOM_WIDE(lom_sample_cube_lanes), lom_float3, sample_as)
