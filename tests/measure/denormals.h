/* How many instructions meet a denormal number, or make one, on x86-64: each is counted by the exception that it would
 * raise, and then done. There are processors (not all) that take some 150 cycles for such an instruction. The program that includes
 * this has its own lom_enter_float_state, which the library's is not linked beside. */
#ifndef LOM_TESTS_DENORMALS_H
#define LOM_TESTS_DENORMALS_H

#if defined __x86_64__ && defined __linux__
#define LOM_COUNTS_DENORMALS 1

#include <lom/base.h>

#include <signal.h>
#include <stdbool.h>
#include <string.h>
#include <ucontext.h>
#include <xmmintrin.h>

enum { MASKED = 0x1f80, DENORMAL_OR_UNDERFLOW = 0x900, STEP = 0x100 };
static volatile uint64_t denormals_met;
static bool denormals_are_counted;

void lom_enter_float_state(lom_float_state *state)
{
    uint16_t control, standard = 0x37f;
    __asm__ volatile("fnstcw %0" : "=m"(control));
    *state = (lom_float_state){ .saved = { _mm_getcsr(), control } };
    _mm_setcsr(denormals_are_counted ? MASKED & ~DENORMAL_OR_UNDERFLOW : MASKED);
    __asm__ volatile("fldcw %0" : : "m"(standard));
}

void lom_leave_float_state(const lom_float_state *state)
{
    uint16_t control = (uint16_t)state->saved[1];
    __asm__ volatile("fldcw %0" : : "m"(control));
    _mm_setcsr((unsigned)state->saved[0]);
}

/* The instruction is done again with the exceptions masked, alone. */
static void meet_denormal(int number, siginfo_t *info, void *context)
{
    ucontext_t *at = context;
    (void)info;
    const bool met = number == SIGFPE;
    denormals_met += met;
    at->uc_mcontext.fpregs->mxcsr = met ? MASKED : MASKED & ~DENORMAL_OR_UNDERFLOW;
    if (met)
        at->uc_mcontext.gregs[REG_EFL] |= STEP;
    else
        at->uc_mcontext.gregs[REG_EFL] &= ~STEP;
}

static inline void count_denormals(bool on)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_sigaction = meet_denormal;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGFPE, &action, NULL);
    sigaction(SIGTRAP, &action, NULL);
    denormals_are_counted = on;
}
#endif

#endif
