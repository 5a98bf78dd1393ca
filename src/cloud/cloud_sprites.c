/* Clouds of billboards (N. Wang, Realistic and fast cloud rendering, 2004; M. Harris, A. Lastra, Real-time cloud
 * rendering, 2001). In: the density that the grid of light averaged. Out: billboards that hold equal shares of it, from
 * far to near. Invariant: what the pictures absorb together is what the density does, the integral of optical depth over
 * the area; a billboard's place is a function of the cloud's seed and its number. */
#include "cloud/cloud_sprites.h"

#include "base/counting_sort.h"
#include "base/numbers.h"

struct recipe {
    int model, count;
    double size; /* half a side, in parts of that of a cube of its share of the space that holds anything */
    bool turned; /* by any angle; else mirrored or not */
};
static const struct recipe recipes[] = { { LOM_CLOUDS_SPRITES, 400, 1.15, true },
                                         { LOM_CLOUDS_GROUPS, 24, 1.2, false } };

enum purpose { FOR_SHARE, FOR_X, FOR_Y, FOR_Z, FOR_TURN, FOR_SIZE, PURPOSES };

static const struct recipe *find_recipe(int model)
{
    for (size_t i = 0; i < sizeof recipes / sizeof *recipes; i++)
        if (recipes[i].model == model)
            return &recipes[i];
    return NULL;
}

bool lom_has_cloud_sprites(int model)
{
    return find_recipe(model) != NULL;
}

void lom_free_cloud_sprites(struct lom_cloud_sprites *sprites)
{
    if (sprites == NULL)
        return;
    lom_release(sprites->places);
    lom_release(sprites->drawn);
    lom_release(sprites->orders);
    lom_release(sprites);
}

static double draw(const lom_cloud *cloud, int number, enum purpose purpose)
{
    return lom_random_uniform(lom_random_bits((uint64_t)cloud->seed, (uint64_t)number), purpose);
}

static void place_sprite(const struct lom_placed_cloud *cloud, const struct recipe *recipe, int number,
                         const int voxel[3], double half, float *to)
{
    const lom_light_grid *g = cloud->light;
    const int size[3] = { g->width, g->height, g->depth };
    for (int i = 0; i < 3; i++) {
        double part = (voxel[i] + draw(cloud->cloud, number, FOR_X + (enum purpose)i)) / size[i];
        to[LOM_SPRITE_IN_BOX + i] = (float)part;
    }
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < 3; i++)
            sum += cloud->axes[i][k] * ((double)to[LOM_SPRITE_IN_BOX + i] - 0.5) * cloud->cloud->size[i];
        to[LOM_SPRITE_X + k] = (float)sum;
    }
    const double turn = draw(cloud->cloud, number, FOR_TURN), angle = lom_two_pi * turn;
    to[LOM_SPRITE_HALF] = (float)half;
    to[LOM_SPRITE_COSINE] = (float)(recipe->turned ? lom_double_cos(angle) : turn < 0.5 ? 1 : -1);
    to[LOM_SPRITE_SINE] = (float)(recipe->turned ? lom_double_sin(angle) : 0);
}

/* Billboard n lies in the voxel in which (n + random) / count of all density is reached. */
static void place_all(const struct lom_placed_cloud *cloud, const struct recipe *recipe, uint64_t total, double half,
                      struct lom_cloud_sprites *sprites)
{
    const lom_light_grid *g = cloud->light;
    uint64_t sum = 0;
    size_t at = 0;
    int number = 0;
    for (int z = 0; z < g->depth; z++)
        for (int y = 0; y < g->height; y++)
            for (int x = 0; x < g->width; x++) {
                sum += g->density[at++];
                for (; number < sprites->count; number++) {
                    double share = (number + draw(cloud->cloud, number, FOR_SHARE)) / sprites->count;
                    if ((double)sum <= share * (double)total)
                        break;
                    const int voxel[3] = { x, y, z };
                    place_sprite(cloud, recipe, number, voxel, half, sprites->places + LOM_SPRITE_FLOATS * number);
                }
            }
    sprites->count = number;
}

struct lom_cloud_sprites *lom_make_cloud_sprites(const struct lom_placed_cloud *cloud, int model, double mean_opacity,
                                                 lom_error *error)
{
    const struct recipe *recipe = find_recipe(model);
    const lom_light_grid *g = cloud->light;
    const size_t voxels = (size_t)g->width * (size_t)g->height * (size_t)g->depth, count = (size_t)recipe->count;
    struct lom_cloud_sprites *sprites = lom_allocate(1, sizeof *sprites, error);
    if (sprites == NULL)
        return NULL;
    *sprites = (struct lom_cloud_sprites){ .count = recipe->count,
                                           .places = lom_allocate(count, LOM_SPRITE_FLOATS * sizeof(float), error),
                                           .drawn = lom_allocate(count, LOM_SPRITE_FLOATS * sizeof(float), error),
                                           .orders = lom_allocate(count, 3 * sizeof(uint32_t), error) };
    if (sprites->places == NULL || sprites->drawn == NULL || sprites->orders == NULL) {
        lom_free_cloud_sprites(sprites);
        return NULL;
    }
    uint64_t total = 0, held = 0;
    for (size_t i = 0; i < voxels; i++) {
        total += g->density[i];
        held += g->density[i] > 0;
    }
    const double *size = cloud->cloud->size;
    double voxel = size[0] * size[1] * size[2] / (double)voxels;
    double half = recipe->size * lom_double_cbrt((double)held * voxel / recipe->count);
    double mass = (double)total / 65535 * voxel * cloud->cloud->extinction * cloud->cloud->density; /* m^2 */
    if (half > 0)
        sprites->depth = (float)(mass / recipe->count / (4 * half * half * mean_opacity));
    place_all(cloud, recipe, total, half, sprites);
    return sprites;
}

static uint32_t order_key(const void *keys, uint32_t number)
{
    return ((const uint32_t *)keys)[number];
}

void lom_sort_cloud_sprites(const struct lom_cloud_sprites *sprites, const struct lom_placed_cloud *cloud,
                            const struct lom_cloud_view *view)
{
    const size_t count = (size_t)sprites->count;
    uint32_t *keys = sprites->orders, *numbers = keys + count, *scratch = numbers + count;
    for (size_t i = 0; i < count; i++) {
        const float *at = sprites->places + LOM_SPRITE_FLOATS * i;
        keys[i] = lom_sorting_key(
            (float)lom_cloud_nearness((lom_vec3){ cloud->middle.x + (double)at[0], cloud->middle.y + (double)at[1],
                                                  cloud->middle.z + (double)at[2] },
                                      view));
        numbers[i] = (uint32_t)i;
    }
    lom_sort_by_key(order_key, keys, 4, count, numbers, scratch);
    for (size_t i = 0; i < count; i++)
        memcpy(sprites->drawn + LOM_SPRITE_FLOATS * i, sprites->places + LOM_SPRITE_FLOATS * numbers[i],
               LOM_SPRITE_FLOATS * sizeof(float));
}
