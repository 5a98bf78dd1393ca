/* The peers' procedural textures as images (bench/peers/README.md, "Textures"): RGBA8, row 0 is v = 0. Each is freed
 * with lom_free_image; NULL when memory runs out. */
#ifndef LOM_MEASURE_PEER_PICTURES_H
#define LOM_MEASURE_PEER_PICTURES_H

#include <lom/image.h>

lom_image *lom_peer_albedo(lom_error *error); /* 1024 x 1024, grass and earth */
/* size x size, normals of 5-octave noise: xyz = rgb * 2 - 1, z outwards. */
lom_image *lom_peer_normals(int size, int period, int seed, float strength, lom_error *error);
lom_image *lom_peer_dudv(lom_error *error);  /* 512 x 512, two smooth noises in r and g */
lom_image *lom_peer_sky(lom_error *error);   /* 256 x 256, 6 slices: +x -x +y -y +z -z in OpenGL's face orientation */
lom_image *lom_peer_cloud(lom_error *error); /* 64 x 64 x 64, colour and density; border voxels 0 */

#endif
