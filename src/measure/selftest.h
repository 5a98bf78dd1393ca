/* The parts of the self-test: each makes its content from formulas and hashes what comes out. */
#ifndef LOM_MEASURE_SELFTEST_H
#define LOM_MEASURE_SELFTEST_H

#include "shading/light.h"

#include "measure/measure.h"

struct lom_selftest_uniforms {
    struct lom_matrix_uniform clip_from_world;
    struct lom_light_uniform light;
    float plane[2][4]; /* clip distances of the cut mesh: plane . (position, 1) */
    float depth;       /* of the window-filling strip */
    const lom_texture *texture, *cube, *volume;
};

/* lom_selftest_functions: 16 lane functions of the window position, in four colours.
 * lom_selftest_textured: attributes position, normal, uv, colour; textured, lit.
 * lom_selftest_cut: the same, cut by two planes and by discarding; two colours, one of them flat.
 * lom_selftest_samples: quads; a cube, a volume and a mirrored texture; depth from the shader. */
extern const lom_shader lom_selftest_functions, lom_selftest_textured, lom_selftest_cut, lom_selftest_samples;

/* A part without a device. False after an error. */
typedef bool lom_selftest_plain(uint64_t *hash, lom_error *error);
/* What a drawn part adds its pictures to: a hash, and, where it is not NULL, a sheet that shows them in cells. */
struct lom_selftest_sum {
    uint64_t hash;
    lom_image *sheet; /* RGB8 */
    int shown;
};
enum { LOM_CELL_WIDTH = 72, LOM_CELL_HEIGHT = 48, LOM_CELL_COLUMNS = 6, LOM_CELL_ROWS = 5 };
/* A part that draws; device descriptors are passed so that a part may open its own. */
typedef bool lom_selftest_drawn(struct lom_selftest_sum *sum, const lom_device_desc *device, lom_error *error);

lom_selftest_plain lom_selftest_numbers, lom_selftest_random, lom_selftest_mathematics, lom_selftest_pictures;
lom_selftest_drawn lom_selftest_draw_functions, lom_selftest_draw_textured, lom_selftest_draw_cut,
    lom_selftest_draw_samples, lom_selftest_draw_lake;

/* hash with a 64-bit number, little-endian. */
uint64_t lom_selftest_add(uint64_t hash, uint64_t value);

#endif
