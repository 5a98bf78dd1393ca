/* One function on a thread of its own. */
#ifndef LOM_CLI_BACKGROUND_H
#define LOM_CLI_BACKGROUND_H

#include <lom/base.h>

struct lom_background;

/* Begins work(context) on another thread; where the system gives none it is done at once. NULL when memory runs out:
 * then nothing was begun. Ended by lom_join_background. */
struct lom_background *lom_begin_background(void (*work)(void *context), void *context, lom_error *error);
/* Waits until the work is done, for that many seconds at most; whether it is. */
bool lom_wait_background(struct lom_background *background, double seconds);
/* Waits for the end and frees it; what the work wrote is visible. NULL is allowed. */
void lom_join_background(struct lom_background *background);

#endif
