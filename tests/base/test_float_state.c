/* lom_enter_float_state gives the default environment whatever the caller left, and lom_leave_float_state gives the
 * caller's back: rounding upward, denormals flushed and traps on, all at once. */
#include <lom/base.h>

#include "check.h"

#include <fenv.h>
#include <math.h>

#if defined __x86_64__
#include <immintrin.h>
#define FLUSH_BITS 0x8040u /* FTZ and DAZ of MXCSR */
#endif

static volatile double one = 1, three = 3, smallest_normal = 0x1p-1022, half = 0.5, zero = 0;

static void set_hostile_state(void)
{
    fesetround(FE_UPWARD);
#if defined __x86_64__
    _mm_setcsr(_mm_getcsr() | FLUSH_BITS);
#endif
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
}

static void restore_default_state(void)
{
    fedisableexcept(FE_ALL_EXCEPT);
    fesetenv(FE_DFL_ENV);
}

static void default_state_inside_callers_state_after(void)
{
    lom_float_state state;
    set_hostile_state();
    double upward = one / three;
    lom_enter_float_state(&state);
    double nearest = one / three, denormal = smallest_normal * half, denormal_in = denormal + denormal;
    double infinite = one / zero, invalid = zero / zero; /* would trap in the caller's state */
    int rounding = fegetround();
    lom_leave_float_state(&state);
    double upward_after = one / three, flushed_after = smallest_normal * half;
    int rounding_after = fegetround(), traps_after = fegetexcept(), raised = fetestexcept(FE_DIVBYZERO | FE_INVALID);
    restore_default_state();

    CHECK(nearest == 0x1.5555555555555p-2, "%a", nearest);
    CHECK(denormal == 0x1p-1023 && denormal_in == 0x1p-1022, "%a %a", denormal, denormal_in);
    CHECK(isinf(infinite) && isnan(invalid));
    CHECK(rounding == FE_TONEAREST, "%d", rounding);
    CHECK(rounding_after == FE_UPWARD, "%d", rounding_after);
    CHECK(upward == 0x1.5555555555556p-2 && upward_after == upward, "%a %a", upward, upward_after);
    CHECK(raised == 0, "the caller sees flags it did not raise: %d", raised);
#if defined __x86_64__
    CHECK(flushed_after == 0, "%a", flushed_after);
    CHECK(traps_after == (FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), "%d", traps_after);
#else
    CHECK(flushed_after == 0x1p-1023, "%a", flushed_after); /* traps may not exist here */
    (void)traps_after;
#endif
}

static void mathematics_does_not_see_the_callers_state(void)
{
    double expected[] = { lom_double_sin(1e6), lom_double_exp(-744.5), lom_double_pow(1.1, 50.5), lom_double_log(0.3) };
    lom_float_state state;
    set_hostile_state();
    lom_enter_float_state(&state);
    double found[] = { lom_double_sin(1e6), lom_double_exp(-744.5), lom_double_pow(1.1, 50.5), lom_double_log(0.3) };
    lom_leave_float_state(&state);
    restore_default_state();
    CHECK(memcmp(expected, found, sizeof expected) == 0);
}

static void nested_entries_restore_in_order(void)
{
    lom_float_state outer, inner;
    fesetround(FE_DOWNWARD);
    lom_enter_float_state(&outer);
    lom_enter_float_state(&inner);
    lom_leave_float_state(&inner);
    int between = fegetround();
    lom_leave_float_state(&outer);
    int after = fegetround();
    restore_default_state();
    CHECK(between == FE_TONEAREST && after == FE_DOWNWARD, "%d %d", between, after);
}

int main(int argc, char **argv)
{
    RUN(default_state_inside_callers_state_after);
    RUN(mathematics_does_not_see_the_callers_state);
    RUN(nested_entries_restore_in_order);
    return check_result();
}
