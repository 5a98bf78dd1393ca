/* The caller's floating-point environment, saved and replaced by the default one. In: the thread's state; out: round to
 * nearest even, denormals kept, nothing trapped, flags clear. Invariant: what lom_leave_float_state restores is bit for
 * bit what was there.
 *
 * x86-64: MXCSR and, because libc looks at its rounding mode, the x87 control word (Intel SDM 1, 10.2.3 and 8.1.5:
 * defaults 0x1f80 and 0x37f). AArch64: FPCR and FPSR (Arm ARM, C5.2.8; 0 is the default of both). Elsewhere C's fenv.h.
 * The two functions are never inlined, so that no arithmetic of the caller crosses them. */
#include <lom/base.h>

#if defined __x86_64__
#include <xmmintrin.h>

void lom_enter_float_state(lom_float_state *state)
{
    uint16_t control, standard = 0x37f;
    __asm__ volatile("fnstcw %0" : "=m"(control));
    *state = (lom_float_state){ .saved = { _mm_getcsr(), control } };
    _mm_setcsr(0x1f80);
    __asm__ volatile("fldcw %0" : : "m"(standard));
}

void lom_leave_float_state(const lom_float_state *state)
{
    uint16_t control = (uint16_t)state->saved[1];
    __asm__ volatile("fldcw %0" : : "m"(control));
    _mm_setcsr((unsigned)state->saved[0]);
}

#elif defined __aarch64__

void lom_enter_float_state(lom_float_state *state)
{
    uint64_t control, status;
    __asm__ volatile("mrs %0, fpcr" : "=r"(control));
    __asm__ volatile("mrs %0, fpsr" : "=r"(status));
    *state = (lom_float_state){ .saved = { control, status } };
    __asm__ volatile("msr fpcr, %0" : : "r"(UINT64_C(0)) : "memory");
    __asm__ volatile("msr fpsr, %0" : : "r"(UINT64_C(0)) : "memory");
}

void lom_leave_float_state(const lom_float_state *state)
{
    __asm__ volatile("msr fpcr, %0" : : "r"(state->saved[0]) : "memory");
    __asm__ volatile("msr fpsr, %0" : : "r"(state->saved[1]) : "memory");
}

#else
#include <fenv.h>
#include <string.h>

_Static_assert(sizeof(fenv_t) <= sizeof(lom_float_state), "lom_float_state is too small for this machine's fenv_t");

void lom_enter_float_state(lom_float_state *state)
{
    fenv_t environment;
    fegetenv(&environment);
    *state = (lom_float_state){ .saved = { 0 } };
    memcpy(state->saved, &environment, sizeof environment);
    fesetenv(FE_DFL_ENV);
}

void lom_leave_float_state(const lom_float_state *state)
{
    fenv_t environment;
    memcpy(&environment, state->saved, sizeof environment);
    fesetenv(&environment);
}

#endif
