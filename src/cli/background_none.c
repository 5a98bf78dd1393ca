/* Work on a thread of its own, of a system that has none (WebAssembly). In: a function. Out: its effects, at once. */
#include "background.h"

struct lom_background {
    char none; /* a structure has a member */
};

struct lom_background *lom_begin_background(void (*work)(void *context), void *context, lom_error *error)
{
    struct lom_background *background = lom_allocate(1, sizeof *background, error);
    if (background == NULL)
        return NULL;
    work(context);
    return background;
}

bool lom_wait_background(struct lom_background *background, double seconds)
{
    (void)background, (void)seconds;
    return true;
}

void lom_join_background(struct lom_background *background)
{
    lom_release(background);
}
