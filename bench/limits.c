/* What this machine can do, on one thread and on all: writing and copying a picture, multiplying and adding floats,
 * looking values up. In: nothing; out: a line each, `name one-thread all-threads unit`. Invariant: each kernel does what
 * it counts and its result is used, so that no compiler leaves it out. Built with -march=native; bench/peers.sh divides
 * a workload's work by it. */
#define _GNU_SOURCE
#include <pthread.h>
#include <sched.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#if defined __AVX512F__
enum { LANES = 16 };
#elif defined __AVX__
enum { LANES = 8 };
#else
enum { LANES = 4 };
#endif
typedef float lanes __attribute__((vector_size(4 * LANES)));

enum { MAX_THREADS = 256, REPEATS = 5, PICTURE = 1280 * 720 * 4, LARGE = 64 << 20, TABLE = 4 << 20 };

/* One thread's memory and what it measured. */
typedef struct worker {
    uint8_t *from, *to; /* LARGE bytes each */
    uint64_t *table;    /* TABLE bytes */
    uint32_t *places;   /* 4096 of it */
    double done;        /* by the kernel */
    double begin, end;  /* seconds */
    uint64_t result;    /* used, so computed */
    pthread_barrier_t *start;
    double (*kernel)(struct worker *worker);
} worker;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static double write_bytes(worker *w, size_t size, int times)
{
    for (int i = 0; i < times; i++) {
        memset(w->to, i, size);
        w->result += w->to[size / 2];
    }
    return (double)size * times;
}

static double write_picture(worker *w)
{
    return write_bytes(w, PICTURE, 64);
}

static double write_large(worker *w)
{
    return write_bytes(w, LARGE, 4);
}

static double copy_large(worker *w)
{
    for (int i = 0; i < 4; i++) {
        memcpy(w->to, w->from, LARGE);
        w->result += w->to[LARGE / 2];
    }
    return 2.0 * LARGE * 4; /* read and written */
}

/* Twelve chains: more than the latency of a multiplication and an addition times the units that do them. */
static double multiply_and_add(worker *w)
{
    enum { CHAINS = 12, STEPS = 4000000 };
    lanes chain[CHAINS], factor = { 0 }, addend = { 0 };
    for (int i = 0; i < LANES; i++) {
        factor[i] = 0.9999f;
        addend[i] = 0.0001f;
    }
    for (int k = 0; k < CHAINS; k++)
        chain[k] = addend * (float)(k + 1);
    for (int step = 0; step < STEPS; step++)
#pragma GCC unroll 12
        for (int k = 0; k < CHAINS; k++)
            chain[k] = chain[k] * factor + addend;
    float sum = 0;
    for (int k = 0; k < CHAINS; k++)
        sum += chain[k][0];
    w->result += sum > 0;
    return 2.0 * CHAINS * LANES * STEPS;
}

/* Values of 8 bytes, two texels side by side, at places within `bytes` of the table. */
static double look_up(worker *w, uint32_t bytes)
{
    enum { PLACES = 4096, TIMES = 2000 };
    uint32_t state = 12345;
    for (int i = 0; i < PLACES; i++) {
        state = state * 1664525u + 1013904223u;
        w->places[i] = (state >> 8) % (bytes / 8);
    }
    uint64_t sum[4] = { 0 };
    for (int i = 0; i < TIMES; i++)
        for (int k = 0; k < PLACES; k += 4)
#pragma GCC unroll 4
            for (int j = 0; j < 4; j++)
                sum[j] += w->table[w->places[k + j]];
    w->result += sum[0] + sum[1] + sum[2] + sum[3];
    return (double)PLACES * TIMES;
}

static double look_up_near(worker *w)
{
    return look_up(w, 16 << 10);
}

static double look_up_far(worker *w)
{
    return look_up(w, TABLE);
}

static void *work(void *argument)
{
    worker *w = argument;
    pthread_barrier_wait(w->start);
    w->begin = now();
    w->done = w->kernel(w);
    w->end = now();
    return NULL;
}

/* What all threads do in a second, the best of some repeats. */
static double rate(worker *workers, int threads, double (*kernel)(worker *worker))
{
    double best = 0;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        pthread_t thread[MAX_THREADS];
        pthread_barrier_t start;
        pthread_barrier_init(&start, NULL, (unsigned)threads);
        for (int i = 0; i < threads; i++) {
            workers[i].start = &start;
            workers[i].kernel = kernel;
            if (pthread_create(&thread[i], NULL, work, &workers[i]) != 0)
                exit(2);
        }
        double begin = 1e300, end = 0, done = 0;
        for (int i = 0; i < threads; i++) {
            pthread_join(thread[i], NULL);
            begin = workers[i].begin < begin ? workers[i].begin : begin;
            end = workers[i].end > end ? workers[i].end : end;
            done += workers[i].done;
        }
        pthread_barrier_destroy(&start);
        best = done / (end - begin) > best ? done / (end - begin) : best;
    }
    return best;
}

static int processors(void)
{
    cpu_set_t set;
    int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return count < MAX_THREADS ? count : MAX_THREADS;
}

int main(void)
{
    static const struct {
        const char *name, *unit;
        double (*kernel)(worker *worker);
    } kernels[] = {
        { "write-picture", "GB/s, 3.7 MB again and again", write_picture },
        { "write", "GB/s, 64 MB", write_large },
        { "copy", "GB/s read and written, 64 MB", copy_large },
        { "arithmetic", "Gflop/s, multiplications and additions apart", multiply_and_add },
        { "look-up-near", "G/s of 8 bytes within 16 KiB", look_up_near },
        { "look-up-far", "G/s of 8 bytes within 4 MiB", look_up_far },
    };
    int threads = processors();
    worker *workers = calloc((size_t)threads, sizeof *workers);
    for (int i = 0; workers != NULL && i < threads; i++) {
        worker *w = &workers[i];
        w->from = malloc(LARGE);
        w->to = malloc(LARGE);
        w->table = malloc(TABLE);
        w->places = malloc(4096 * sizeof *w->places);
        if (w->from == NULL || w->to == NULL || w->table == NULL || w->places == NULL)
            return 2;
        memset(w->from, 1, LARGE);
        memset(w->to, 1, LARGE);
        memset(w->table, 1, TABLE);
    }
    if (workers == NULL)
        return 2;
    printf("lanes %d %d of float\n", LANES, LANES);
    for (size_t i = 0; i < sizeof kernels / sizeof kernels[0]; i++) {
        double one = rate(workers, 1, kernels[i].kernel), all = rate(workers, threads, kernels[i].kernel);
        printf("%s %.2f %.2f %s\n", kernels[i].name, one * 1e-9, all * 1e-9, kernels[i].unit);
        fflush(stdout);
    }
    uint64_t sum = 0;
    for (int i = 0; i < threads; i++)
        sum += workers[i].result;
    return sum == 0; /* never: what was computed is used */
}
