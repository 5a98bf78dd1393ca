/* Work on a thread of its own. In: a function. Out: its effects, later. Invariant: whoever was told that the work is done
 * sees all that it wrote. */
#include "background.h"

#include <pthread.h>
#include <time.h>

struct lom_background {
    void (*work)(void *context);
    void *context;
    pthread_t thread;
    bool has_thread, is_done;
    pthread_mutex_t lock;
    pthread_cond_t changed;
};

static void *run(void *argument)
{
    struct lom_background *background = argument;
    background->work(background->context);
    pthread_mutex_lock(&background->lock);
    background->is_done = true;
    pthread_cond_signal(&background->changed);
    pthread_mutex_unlock(&background->lock);
    return NULL;
}

struct lom_background *lom_begin_background(void (*work)(void *context), void *context, lom_error *error)
{
    struct lom_background *background = lom_allocate(1, sizeof *background, error);
    if (background == NULL)
        return NULL;
    background->work = work;
    background->context = context;
    pthread_mutex_init(&background->lock, NULL);
    pthread_cond_init(&background->changed, NULL);
    background->has_thread = pthread_create(&background->thread, NULL, run, background) == 0;
    if (!background->has_thread)
        run(background);
    return background;
}

bool lom_wait_background(struct lom_background *background, double seconds)
{
    struct timespec end;
    clock_gettime(CLOCK_REALTIME, &end);
    int64_t whole = lom_int_of(seconds), rest = lom_int_of((seconds - (double)whole) * 1e9) + end.tv_nsec;
    end.tv_sec += (time_t)(whole + rest / 1000000000);
    end.tv_nsec = (long)(rest % 1000000000);
    int late = 0;
    pthread_mutex_lock(&background->lock);
    while (!background->is_done && late == 0)
        late = pthread_cond_timedwait(&background->changed, &background->lock, &end);
    bool is_done = background->is_done;
    pthread_mutex_unlock(&background->lock);
    return is_done;
}

void lom_join_background(struct lom_background *background)
{
    if (background == NULL)
        return;
    if (background->has_thread)
        pthread_join(background->thread, NULL);
    pthread_cond_destroy(&background->changed);
    pthread_mutex_destroy(&background->lock);
    lom_release(background);
}
