/* Shallow water: milliseconds a step of squares of cells, one thread, while a dam breaks over a rough bed: make
 * bench-shallow. Out: a table of the least processor time of a step, after the water has spread. */
#include <lom/shallow.h>

#include <stdio.h>
#include <time.h>

enum { LARGEST = 512, WARM_UP = 100, STEPS = 60 };

static double bed[LARGEST * LARGEST], depth[LARGEST * LARGEST];

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static lom_shallow *make(int size)
{
    for (int i = 0; i < size * size; i++) {
        int x = i % size - size / 2, z = i / size - size / 2;
        bed[i] = 0.5 * lom_random_uniform(1, (uint64_t)i) + (i % 17 == 0);
        depth[i] = x * x + z * z < size * size / 9 ? 3 : 0.2;
    }
    lom_shallow_desc desc = {
        .columns = size, .rows = size, .cell = 0.5, .bed = bed, .depth = depth, .friction = 0.01
    };
    return lom_create_shallow(&desc, NULL);
}

int main(void)
{
    printf("| cells | ms a step | ns a cell |\n|---|---|---|\n");
    for (int size = 128; size <= LARGEST; size *= 2) {
        lom_shallow *shallow = make(size);
        double least = 1e9;
        for (int i = 0; shallow != NULL && i < WARM_UP + STEPS; i++) {
            double start = now_ms();
            lom_step_shallow(shallow, NULL, 0, NULL, 0, NULL);
            double took = now_ms() - start;
            least = i >= WARM_UP && took < least ? took : least;
        }
        lom_free_shallow(shallow);
        printf("| %d² | %.2f | %.1f |\n", size, least, least * 1e6 / ((double)size * size));
    }
    return 0;
}
