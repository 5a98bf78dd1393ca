/* Dobashi's cellular automaton (Dobashi, Kaneda, Yamashita, Okita, Nishita: A simple, efficient method for realistic
 * animation of clouds, SIGGRAPH 2000, section 4, after Nagel and Raschke 1992). A cell has three bits: humidity,
 * activation (about to turn to cloud) and cloud. In: a seed. Out: densities, the share of cloud around each cell.
 *
 *   humidity' = humidity and not active      cloud' = cloud or active      active' = not active and humidity and f
 *   f = activation in any of the cells at +-1 along each axis, +-2 along x and along the depth, and 2 below
 *
 * (The paper's z is up; here y is.) Invariant: a generation is computed from the one before alone. */
#include "cloud/cloud_kinds.h"

enum { HUMID = 1, ACTIVE = 2, CLOUD = 4, GENERATIONS = 14, REACH = 3 };

/* Cells next to (x, y, z) whose activation spreads to it: outwards and upwards, since warm air rises. */
static const int8_t neighbours[11][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 },
                                          { 0, 0, 1 }, { 0, 0, -1 }, { 2, 0, 0 }, { -2, 0, 0 },
                                          { 0, 0, 2 }, { 0, 0, -2 }, { 0, -2, 0 } };

struct grid {
    int size[3];
    uint8_t *now, *next;
};

static size_t cell_at(const struct grid *g, int x, int y, int z)
{
    return ((size_t)z * (size_t)g->size[1] + (size_t)y) * (size_t)g->size[0] + (size_t)x;
}

static unsigned bits_at(const struct grid *g, int x, int y, int z)
{
    if (x < 0 || y < 0 || z < 0 || x >= g->size[0] || y >= g->size[1] || z >= g->size[2])
        return 0;
    return g->now[cell_at(g, x, y, z)];
}

/* Probabilities fall from the middle of an ellipsoid that fills the volume to its rim (the paper, section 4.4). */
static void seed_grid(struct grid *g, uint64_t seed)
{
    for (int z = 0; z < g->size[2]; z++)
        for (int y = 0; y < g->size[1]; y++)
            for (int x = 0; x < g->size[0]; x++) {
                const int at[3] = { x, y, z };
                double square = 0;
                for (int i = 0; i < 3; i++) {
                    double from_middle = (2 * at[i] + 1.0) / g->size[i] - 1;
                    if (i == 1) /* the ellipsoid's middle is at a third of the height: a flat base */
                        from_middle = from_middle < -0.34 ? (from_middle + 0.34) / 0.5 : (from_middle + 0.34) / 1.2;
                    square += from_middle * from_middle;
                }
                double inside = 1 - square;
                uint64_t cell = cell_at(g, x, y, z);
                unsigned bits = 0;
                if (lom_random_uniform(seed, 2 * cell) < 0.9 * inside)
                    bits |= HUMID;
                if (lom_random_uniform(seed, 2 * cell + 1) < 0.006 * inside)
                    bits |= ACTIVE;
                g->now[cell] = (uint8_t)bits;
            }
}

static void step(struct grid *g)
{
    for (int z = 0; z < g->size[2]; z++)
        for (int y = 0; y < g->size[1]; y++)
            for (int x = 0; x < g->size[0]; x++) {
                unsigned bits = bits_at(g, x, y, z), near = 0, next = bits & CLOUD;
                for (int i = 0; i < 11; i++)
                    near |= bits_at(g, x + neighbours[i][0], y + neighbours[i][1], z + neighbours[i][2]);
                if (bits & ACTIVE)
                    next |= CLOUD;
                else
                    next |= (bits & HUMID) | ((bits & HUMID) && (near & ACTIVE) ? ACTIVE : 0);
                g->next[cell_at(g, x, y, z)] = (uint8_t)next;
            }
    uint8_t *swapped = g->now;
    g->now = g->next;
    g->next = swapped;
}

/* The paper smooths the bits with a field function of metaballs; this is Wyvill's over 3 cells, normalised. */
static double smoothed(const struct grid *g, int x, int y, int z,
                       const double weight[2 * REACH + 1][2 * REACH + 1][2 * REACH + 1])
{
    double sum = 0;
    for (int k = -REACH; k <= REACH; k++)
        for (int j = -REACH; j <= REACH; j++)
            for (int i = -REACH; i <= REACH; i++)
                if (weight[k + REACH][j + REACH][i + REACH] != 0 && (bits_at(g, x + i, y + j, z + k) & CLOUD) != 0)
                    sum += weight[k + REACH][j + REACH][i + REACH];
    return sum;
}

static void store(const struct grid *g, lom_image *volume)
{
    double weight[2 * REACH + 1][2 * REACH + 1][2 * REACH + 1], total = 0;
    for (int k = -REACH; k <= REACH; k++)
        for (int j = -REACH; j <= REACH; j++)
            for (int i = -REACH; i <= REACH; i++) {
                double s = (i * i + j * j + k * k) / 12.25;
                double w = s < 1 ? ((-4 * s + 17) * s - 22) * s / 9 + 1 : 0;
                weight[k + REACH][j + REACH][i + REACH] = w;
                total += w;
            }
    for (int z = 0; z < g->size[2]; z++)
        for (int y = 0; y < g->size[1]; y++)
            for (int x = 0; x < g->size[0]; x++)
                lom_store_density(volume, x, y, z, smoothed(g, x, y, z, (const double(*)[7][7])weight) / total);
}

bool lom_make_automaton(lom_image *volume, int variety, uint64_t seed, lom_error *error)
{
    (void)variety;
    struct grid g = { .size = { volume->width, volume->height, volume->depth } };
    size_t cells = lom_image_size(volume) / sizeof(uint16_t);
    g.now = lom_allocate(cells, 1, error);
    g.next = lom_allocate(cells, 1, error);
    bool done = g.now != NULL && g.next != NULL;
    if (done) {
        seed_grid(&g, seed);
        for (int i = 0; i < GENERATIONS; i++)
            step(&g);
        store(&g, volume);
    }
    lom_release(g.now);
    lom_release(g.next);
    return done;
}
