/* A table of blue noise by void and cluster (R. Ulichney: The void-and-cluster method for dither array generation,
 * 1993). In: a size and a seed. Out: every rank once. Invariant: an energy is the sum of a Gaussian of the distances to
 * all pixels that are set, wrapped around the borders, so that the table repeats without a seam. */
#include "cloud/cloud_draw.h"

enum { REACH = 7, STALE = -2 };  /* pixels; exp(-49 / (2 * 1.9^2)) is 1e-3 */
static const double width = 1.9; /* of the Gaussian, Ulichney's 1.5 to 1.9 */

struct pattern {
    int size;
    bool *set;
    double *energy;
    int *extreme[2]; /* find_in_row of each row, for pixels that are not and that are set; or STALE */
    double weight[2 * REACH + 1][2 * REACH + 1];
};

static void change(struct pattern *p, int pixel, bool set)
{
    int x = pixel % p->size, y = pixel / p->size;
    double sign = set ? 1 : -1;
    p->set[pixel] = set;
    for (int j = -REACH; j <= REACH; j++) {
        int at_y = (y + j + p->size) % p->size;
        for (int i = -REACH; i <= REACH; i++)
            p->energy[at_y * p->size + (x + i + p->size) % p->size] += sign * p->weight[j + REACH][i + REACH];
        p->extreme[0][at_y] = p->extreme[1][at_y] = STALE;
    }
}

/* The tightest cluster among a row's pixels that are set, or the largest void among those that are not; the first of
 * equals, -1 where there is none. */
static int find_in_row(const struct pattern *p, bool set, int y)
{
    double sign = set ? 1 : -1, most = 0;
    int best = -1;
    for (int i = y * p->size; i < (y + 1) * p->size; i++) {
        double energy = sign * p->energy[i];
        if (p->set[i] == set && (best < 0 || energy > most)) {
            most = energy;
            best = i;
        }
    }
    return best;
}

/* The same of all rows. Rows that no change has reached keep theirs. */
static int find_extreme(struct pattern *p, bool set)
{
    double sign = set ? 1 : -1;
    int best = -1, *row = p->extreme[set];
    for (int y = 0; y < p->size; y++) {
        if (row[y] == STALE)
            row[y] = find_in_row(p, set, y);
        if (row[y] >= 0 && (best < 0 || sign * p->energy[row[y]] > sign * p->energy[best]))
            best = row[y];
    }
    return best;
}

/* A tenth of the pixels, moved from clusters to voids until nothing moves. */
static int make_prototype(struct pattern *p, uint64_t seed)
{
    int pixels = p->size * p->size, wanted = pixels / 10, count = 0;
    for (uint64_t i = 0; count < wanted; i++) {
        int pixel = (int)(lom_random_bits(seed, i) % (uint64_t)pixels);
        if (!p->set[pixel]) {
            change(p, pixel, true);
            count++;
        }
    }
    for (int i = 0; i < pixels; i++) {
        int cluster = find_extreme(p, true);
        change(p, cluster, false);
        int empty = find_extreme(p, false);
        change(p, empty, true);
        if (empty == cluster)
            break;
    }
    return count;
}

/* Ranks below the prototype by taking away clusters, those above by filling voids. order[i] is the pixel of rank i. */
static void rank_pixels(struct pattern *p, int count, int *order)
{
    for (int i = count - 1; i >= 0; i--) {
        order[i] = find_extreme(p, true);
        change(p, order[i], false);
    }
    for (int i = 0; i < count; i++) /* the prototype again */
        change(p, order[i], true);
    for (int i = count; i < p->size * p->size; i++) {
        order[i] = find_extreme(p, false);
        change(p, order[i], true);
    }
}

float *lom_make_blue_noise(int size, uint64_t seed, lom_error *error)
{
    struct pattern p = { .size = size };
    size_t pixels = (size_t)size * (size_t)size;
    float *rank = lom_allocate(pixels, sizeof *rank, error);
    int *order = lom_allocate(pixels, sizeof *order, error);
    p.set = lom_allocate(pixels, sizeof *p.set, error);
    p.energy = lom_allocate(pixels, sizeof *p.energy, error);
    p.extreme[0] = lom_allocate((size_t)size, 2 * sizeof **p.extreme, error);
    p.extreme[1] = p.extreme[0] + (p.extreme[0] != NULL ? size : 0);
    bool done = rank != NULL && order != NULL && p.set != NULL && p.energy != NULL && p.extreme[0] != NULL;
    if (done) {
        for (int i = 0; i < 2 * size; i++)
            p.extreme[0][i] = STALE;
        for (int j = -REACH; j <= REACH; j++)
            for (int i = -REACH; i <= REACH; i++)
                p.weight[j + REACH][i + REACH] = lom_double_exp(-(i * i + j * j) / (2 * width * width));
        rank_pixels(&p, make_prototype(&p, seed), order);
        for (size_t i = 0; i < pixels; i++)
            rank[order[i]] = (float)(((double)i + 0.5) / (double)pixels);
    } else {
        lom_release(rank);
    }
    lom_release(order);
    lom_release(p.set);
    lom_release(p.energy);
    lom_release(p.extreme[0]);
    return done ? rank : NULL;
}
