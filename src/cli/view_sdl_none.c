/* The window of a program that was built without SDL2. In: what is wanted. Out: that it cannot be had. */
#include "view_window.h"

bool lom_check_window(lom_error *error)
{
    return lom_fail(error, LOM_ERROR_USAGE,
                    "this lom has no window: it was built without SDL2 (install libsdl2-dev and build it again); "
                    "`lom view SCENE --script FILE --no-window` works without.");
}

bool lom_show_window(struct lom_view *view, struct lom_script *script, bool times, lom_error *error)
{
    (void)view, (void)script, (void)times;
    return lom_check_window(error);
}
