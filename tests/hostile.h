/* A hostile float state, as a caller may leave it behind: rounding in some direction, denormals flushed to zero, every
 * exception a trap. */
#ifndef LOM_TESTS_HOSTILE_H
#define LOM_TESTS_HOSTILE_H

#include <fenv.h>
#include <stdbool.h>

#if defined __x86_64__
enum { HOSTILE_FLUSH = 0x8040 }; /* FTZ and DAZ */
static inline unsigned hostile_control(void)
{
    return __builtin_ia32_stmxcsr();
}
static inline void hostile_set_control(unsigned state)
{
    __builtin_ia32_ldmxcsr(state);
}
#else
enum { HOSTILE_FLUSH = 0 };
static inline unsigned hostile_control(void)
{
    return 0;
}
static inline void hostile_set_control(unsigned state)
{
    (void)state;
}
#endif

static const int hostile_modes[] = { FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO };
enum { HOSTILE_MODES = 4 };

typedef struct hostile_state {
    fenv_t environment;
    unsigned before, set;
    int mode;
} hostile_state;

static inline hostile_state enter_hostile_state(int mode)
{
    hostile_state state = { .mode = mode };
    feholdexcept(&state.environment);
    state.before = hostile_control();
    fesetround(mode);
    hostile_set_control(hostile_control() | HOSTILE_FLUSH);
#if defined __GLIBC__
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW | FE_UNDERFLOW | FE_INEXACT);
#endif
    state.set = hostile_control() & 0xffc0; /* all but the sticky flags */
    return state;
}

/* Back to what was before; whether the hostile state was still there. */
static inline bool leave_hostile_state(const hostile_state *state)
{
    bool kept = (hostile_control() & 0xffc0) == state->set && fegetround() == state->mode;
    hostile_set_control(state->before);
    fesetenv(&state->environment);
    return kept;
}

#endif
