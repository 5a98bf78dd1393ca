/* Layers by kind (docs/clouds.md, Making): what each is made of, in metres. In: a volume and a seed. Out: densities. */
#include "cloud/cloud_kinds.h"
#include "cloud/shape.h"

struct recipe {
    float size[3];
    struct lom_cloud_layer layer;
};

static const struct recipe recipes[] = {
    /* stratocumulus: pads a kilometre wide, hollows between them */
    { { 9000, 700, 9000 },
      { .coverage = 0.56f,
        .cell = { 1150, 900, 850 },
        .warp = 220,
        .warp_size = 1500,
        .billow_share = 0.75f,
        .patch = 0.22f,
        .patch_size = 4200,
        .contrast = 3.2f,
        .rise = 0.22f,
        .fall = 0.75f } },
    /* stratus */
    { { 9000, 500, 9000 },
      { .coverage = 0.95f,
        .cell = { 1800, 600, 1500 },
        .warp = 200,
        .warp_size = 1500,
        .billow_share = 0.1f,
        .patch = 0.2f,
        .patch_size = 5000,
        .contrast = 1.2f,
        .rise = 0.3f,
        .fall = 0.5f } },
    /* nimbostratus */
    { { 12000, 2500, 12000 },
      { .coverage = 1.1f,
        .cell = { 2500, 1500, 2200 },
        .warp = 500,
        .warp_size = 2500,
        .billow_share = 0.2f,
        .patch = 0.25f,
        .patch_size = 6000,
        .contrast = 1.4f,
        .rise = 0.12f,
        .fall = 0.4f } },
    /* altocumulus: pads of 300 m in waves */
    { { 12000, 500, 12000 },
      { .coverage = 0.46f,
        .cell = { 420, 500, 300 },
        .warp = 150,
        .warp_size = 1300,
        .billow_share = 0.85f,
        .patch = 0.42f,
        .patch_size = 4600,
        .contrast = 2.6f,
        .rise = 0.25f,
        .fall = 0.7f } },
    /* altostratus */
    { { 12000, 1500, 12000 },
      { .coverage = 1.0f,
        .cell = { 3500, 1200, 1800 },
        .warp = 400,
        .warp_size = 3000,
        .billow_share = 0,
        .patch = 0.25f,
        .patch_size = 7000,
        .contrast = 0.9f,
        .rise = 0.4f,
        .fall = 0.5f } },
    /* cirrus: fibres along x, drawn out by the wind below */
    { { 20000, 1500, 20000 },
      { .coverage = 0.32f,
        .cell = { 9000, 2400, 620 },
        .shear = 2.2f,
        .warp = 900,
        .warp_size = 4200,
        .billow_share = 0,
        .patch = 0.62f,
        .patch_size = 7000,
        .contrast = 1.5f,
        .rise = 0.45f,
        .fall = 0.45f,
        .streak = 0.55f } },
    /* cirrocumulus: grains of 150 m */
    { { 12000, 400, 12000 },
      { .coverage = 0.42f,
        .cell = { 190, 400, 150 },
        .warp = 90,
        .warp_size = 900,
        .billow_share = 0.8f,
        .patch = 0.5f,
        .patch_size = 4000,
        .contrast = 1.9f,
        .rise = 0.4f,
        .fall = 0.5f } },
    /* cirrostratus */
    { { 20000, 1200, 20000 },
      { .coverage = 0.95f,
        .cell = { 9000, 1500, 2500 },
        .shear = 1.5f,
        .warp = 900,
        .warp_size = 6000,
        .billow_share = 0,
        .patch = 0.3f,
        .patch_size = 9000,
        .contrast = 0.8f,
        .rise = 0.5f,
        .fall = 0.5f,
        .streak = 0.3f } },
};

bool lom_make_layer(lom_image *volume, int variety, uint64_t seed, lom_error *error)
{
    (void)error;
    const struct recipe *r = &recipes[variety];
    struct lom_cloud_shape shape = { .voxels = { volume->width, volume->height, volume->depth },
                                     .size = { r->size[0], r->size[1], r->size[2] },
                                     .seed = (uint32_t)lom_random_bits(seed, (uint64_t)variety),
                                     .layer = &r->layer };
    lom_fill_shape((uint16_t *)volume->pixels, &shape);
    return true;
}
