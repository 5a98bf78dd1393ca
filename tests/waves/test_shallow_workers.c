/* Proves that shallow water is no function of who computes its lines: shared by the workers of a pool, or in a copy of such
 * a one, it has the bytes that it has by the caller alone, depths, discharges and what went over its edges; and that its
 * surface as shaders look it up is no function of who fills it. */
#include "waves/shallow_state.h"
#include "waves/shallow_surface.h"

#include "check.h"

enum { COLUMNS = 83, ROWS = 61 }; /* no multiples of the lines that are solved side by side */

static double bed[COLUMNS * ROWS];

/* Hills of up to 3 m under a level of 2 m, with a fall and an open edge. */
static lom_shallow_desc basin_desc(void)
{
    for (size_t i = 0; i < COLUMNS * ROWS; i++)
        bed[i] = 3 * (double)(lom_random_bits(77, i) >> 11) * 0x1p-53;
    return (lom_shallow_desc){ .columns = COLUMNS,
                               .rows = ROWS,
                               .cell = 0.25,
                               .bed = bed,
                               .level = 2,
                               .edge = { LOM_SHALLOW_FALL, LOM_SHALLOW_WALL, LOM_SHALLOW_WALL, LOM_SHALLOW_OPEN },
                               .edge_level = { 0, 0, 0, 1.8 } };
}

static bool same_doubles(const double *a, const double *b, size_t count)
{
    return memcmp(a, b, count * sizeof *a) == 0;
}

/* The surface, its bounds and wet cells, by workers and by the caller alone. */
static void check_surface(const lom_shallow_view *v, lom_pool *pool, int threads)
{
    static float surface[2][COLUMNS * ROWS][4], moments[2][COLUMNS * ROWS][4];
    float bounds[2][2];
    int wet[2];
    for (int i = 0; i < 2; i++)
        wet[i] = lom_fill_shallow_surface(v, i == 0 ? NULL : pool, 1, true, NULL, surface[i], moments[i], bounds[i]);
    CHECK(memcmp(surface[0], surface[1], sizeof surface[0]) == 0 &&
              memcmp(moments[0], moments[1], sizeof moments[0]) == 0 &&
              memcmp(bounds[0], bounds[1], sizeof bounds[0]) == 0 && wet[0] == wet[1],
          "%d workers: %d and %d wet cells, %g..%g and %g..%g m", threads, wet[0], wet[1], (double)bounds[0][0],
          (double)bounds[0][1], (double)bounds[1][0], (double)bounds[1][1]);
    CHECK(wet[0] > 100 && bounds[0][0] < bounds[0][1], "%d wet cells, %g..%g m", wet[0], (double)bounds[0][0],
          (double)bounds[0][1]);
}

/* A step's depths, discharges and what went over the edges, by workers and by the caller alone; and a copy's. */
static void workers_change_nothing(void)
{
    const lom_shallow_desc desc = basin_desc();
    const lom_shallow_source source = { 6, 7, 1.2, 0.8 };
    const lom_shallow_obstacle boat = { 12, 10, { 2, 0.8 }, 0.3, 0.6 };
    for (int threads = 1; threads <= 4; threads++) {
        lom_pool *pool = lom_create_pool(threads, NULL);
        lom_shallow *alone = lom_create_shallow(&desc, NULL), *shared = lom_create_shallow(&desc, NULL);
        CHECK(lom_share_shallow(shared, pool, NULL), "no memory for %d workers", threads);
        lom_shallow *copy = lom_copy_shallow(shared, NULL);
        lom_shallow *const all[] = { alone, shared, copy };
        for (int i = 0; i < 300; i++)
            for (int k = 0; k < 3; k++)
                lom_step_shallow(all[k], &source, 1, &boat, 1, NULL);
        const lom_shallow_view a = lom_view_shallow(alone);
        const size_t columns = (size_t)a.columns, rows = (size_t)a.rows;
        check_surface(&a, pool, threads);
        CHECK(a.gained > 0 && a.lost > 0, "%g m^3 came, %g went", a.gained, a.lost);
        for (int k = 1; k < 3; k++) {
            const lom_shallow_view b = lom_view_shallow(all[k]);
            CHECK(same_doubles(a.depth, b.depth, columns * rows) &&
                      same_doubles(a.flow_x, b.flow_x, (columns + 1) * rows) &&
                      same_doubles(a.flow_z, b.flow_z, columns * (rows + 1)) && a.gained == b.gained &&
                      a.lost == b.lost,
                  "%d workers, %s", threads, k == 1 ? "shared" : "a copy");
        }
        for (int k = 0; k < 3; k++)
            lom_free_shallow(all[k]);
        lom_free_pool(pool);
    }
}

int main(int argc, char **argv)
{
    RUN(workers_change_nothing);
    return check_result();
}
