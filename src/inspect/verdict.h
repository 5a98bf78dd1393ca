/* What became of an explained pixel, in a sentence. */
#ifndef LOM_INSPECT_VERDICT_H
#define LOM_INSPECT_VERDICT_H

#include <lom/inspect.h>

/* Sets the owner and the verdict of what was recorded. */
void lom_find_verdict(lom_explained *explained);

#endif
