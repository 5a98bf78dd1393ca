/* Cumulus and cumulonimbus: heaps of bubbles (turrets that rise and narrow, a broad base) and an anvil, in metres. In:
 * a volume and a seed. Out: densities. Invariant: bubbles lie inside the box, with room for billows. */
#include "base/numbers.h"
#include "cloud/cloud_kinds.h"
#include "cloud/shape.h"

struct recipe {
    float size[3];
    int turrets, rise;              /* bubbles of the base ring come on top: 2 a turret */
    double spread;                  /* of the turrets, in parts of the half width */
    double low_radius, high_radius; /* of a turret's bubbles at its foot and its head */
    double height;                  /* of the highest turret, in parts of the room above the base */
    double foot;                    /* how far the bubbles around a turret's foot are from it, in low radii */
    struct lom_cloud_body body;     /* all but the bubbles; the anvil from the middle of the box */
};

static const struct recipe recipes[] = {
    /* fractus */
    { { 700, 350, 600 },
      6,
      2,
      0.6,
      92,
      70,
      0.66,
      1.1,
      { .base = 40,
        .base_depth = 70,
        .billow = 105,
        .billow_size = 150,
        .warp = 80,
        .warp_size = 240,
        .softness = 120,
        .thin = 0.7f } },
    /* humilis */
    { { 1100, 450, 1000 },
      9,
      2,
      0.66,
      165,
      115,
      0.7,
      1.1,
      { .base = 35,
        .base_depth = 45,
        .billow = 85,
        .billow_size = 190,
        .warp = 60,
        .warp_size = 380,
        .softness = 75,
        .thin = 0.55f } },
    /* mediocris */
    { { 1600, 1000, 1500 },
      11,
      4,
      0.6,
      265,
      175,
      0.84,
      1.1,
      { .base = 50,
        .base_depth = 50,
        .billow = 125,
        .billow_size = 270,
        .warp = 95,
        .warp_size = 520,
        .softness = 80,
        .thin = 0.5f } },
    /* congestus */
    { { 2600, 3000, 2500 },
      10,
      9,
      0.52,
      520,
      310,
      0.9,
      0.2,
      { .base = 90,
        .base_depth = 75,
        .billow = 215,
        .billow_size = 430,
        .warp = 170,
        .warp_size = 900,
        .softness = 105,
        .thin = 0.5f } },
    /* cumulonimbus */
    { { 12000, 9000, 11000 },
      10,
      9,
      0.36,
      1650,
      1200,
      0.86,
      0.2,
      { .base = 300,
        .base_depth = 260,
        .billow = 700,
        .billow_size = 1400,
        .warp = 560,
        .warp_size = 2900,
        .softness = 400,
        .thin = 0.6f,
        .anvil = { .x = 500, .height = 8200, .radius = 4500, .thickness = 3600, .drawn = 1.15f } } },
};

static void add_bubble(struct lom_cloud_body *body, const struct recipe *r, double x, double y, double z, double radius,
                       double flatness)
{
    double room = radius + r->body.billow * 0.6;
    double reach_x = r->size[0] / 2 - room, reach_z = r->size[2] / 2 - room;
    double square = x * x / (reach_x * reach_x) + z * z / (reach_z * reach_z);
    if (square > 1) { /* back inside the ellipse that fits the box */
        double scale = 1 / lom_double_sqrt(square);
        x *= scale;
        z *= scale;
    }
    double highest = r->size[1] - radius / flatness - r->body.billow * 0.7;
    y = y < highest ? y : highest;
    if (body->bubble_count < LOM_MAX_BUBBLES)
        body->bubble[body->bubble_count++] =
            (struct lom_cloud_bubble){ (float)(x + r->size[0] / 2), (float)y, (float)(z + r->size[2] / 2),
                                       (float)radius, (float)flatness };
}

static double uniform(uint64_t seed, uint64_t *counter)
{
    return lom_random_uniform(seed, (*counter)++);
}

/* A turret from the base up; the middle ones are higher. */
static void add_turret(struct lom_cloud_body *body, const struct recipe *r, int index, uint64_t seed, uint64_t *counter)
{
    double angle = 2.399963229728653 * index + lom_two_pi * uniform(seed, counter); /* about the golden angle */
    double along = lom_double_sqrt((index + 0.5 * uniform(seed, counter)) / r->turrets);
    double x = along * r->spread * r->size[0] / 2 * lom_double_cos(angle);
    double z = along * r->spread * r->size[2] / 2 * lom_double_sin(angle);
    double height =
        (r->size[1] - r->body.base) * r->height * (1 - 0.62 * along * along) * (0.78 + 0.22 * uniform(seed, counter));
    double lean_x = 0.5 * uniform(seed, counter) - 0.25, lean_z = 0.5 * uniform(seed, counter) - 0.25;
    for (int k = 0; k < r->rise; k++) {
        double f = r->rise > 1 ? (double)k / (r->rise - 1) : 0;
        double radius = (r->low_radius + (r->high_radius - r->low_radius) * f) * (0.75 + 0.4 * uniform(seed, counter)) *
                        (1 - 0.25 * along);
        double turn = lom_two_pi * uniform(seed, counter), off = 0.55 * radius * uniform(seed, counter);
        double y = r->body.base + 0.15 * radius + (height - radius) * f;
        add_bubble(body, r, x + lean_x * height * f * 0.5 + off * lom_double_cos(turn), y,
                   z + lean_z * height * f * 0.5 + off * lom_double_sin(turn), radius, 1);
    }
    for (int k = 0; k < 2; k++) { /* around its foot: of what is higher than wide within the tower, or a disc shows */
        double radius = 0.62 * r->low_radius * (0.7 + 0.6 * uniform(seed, counter));
        double turn = lom_two_pi * uniform(seed, counter);
        add_bubble(body, r, x + r->foot * r->low_radius * lom_double_cos(turn), r->body.base + 0.1 * radius,
                   z + r->foot * r->low_radius * lom_double_sin(turn), radius, 1.15);
    }
}

bool lom_make_body(lom_image *volume, int variety, uint64_t seed, lom_error *error)
{
    (void)error;
    const struct recipe *r = &recipes[variety];
    struct lom_cloud_body body = r->body;
    uint64_t key = lom_random_bits(seed, (uint64_t)variety + 100), counter = 0;
    for (int i = 0; i < r->turrets; i++)
        add_turret(&body, r, i, key, &counter);
    body.anvil.x += r->size[0] / 2;
    body.anvil.z += r->size[2] / 2;
    struct lom_cloud_shape shape = { .voxels = { volume->width, volume->height, volume->depth },
                                     .size = { r->size[0], r->size[1], r->size[2] },
                                     .seed = (uint32_t)key,
                                     .body = &body };
    lom_fill_shape((uint16_t *)volume->pixels, &shape);
    return true;
}
