/* The float state of an API entry that has more than one way out. In: the caller's state; out: the library's until the
 * block ends, however it ends, and the caller's again behind it. */
#ifndef LOM_BASE_OWN_FLOAT_STATE_H
#define LOM_BASE_OWN_FLOAT_STATE_H

#include <lom/base.h>

static inline lom_float_state lom_entered_float_state(void)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    return state;
}

/* A declaration: the first of a function, before anything is computed or compared. */
#define LOM_OWN_FLOAT_STATE                                                                                            \
    __attribute__((cleanup(lom_leave_float_state), unused)) const lom_float_state own_float_state =                    \
        lom_entered_float_state()

#endif
