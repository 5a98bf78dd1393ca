/* Proves: the self-test agrees with its record on this machine, from whatever float state it is called in. */
#include "check.h"

#include "measure/measure.h"

#include <fenv.h>

static void test_the_recorded_hash(void)
{
    lom_selftest result;
    lom_error error = { 0 };
    CHECK(lom_run_selftest(&result, &error), "%s", error.text);
    CHECK(result.difference[0] == 0, "%s", result.difference);
    CHECK(result.hash == result.expected, "%016llx, not %016llx", (unsigned long long)result.hash,
          (unsigned long long)result.expected);
    for (int i = 0; i < LOM_SELFTEST_PARTS; i++)
        CHECK(result.part[i].hash != LOM_HASH_START && result.part[i].name != NULL, "part %d hashed nothing", i);
}

static void test_another_rounding_gives_the_same_hash(void)
{
    lom_selftest result;
    lom_error error = { 0 };
    fesetround(FE_UPWARD);
    bool done = lom_run_selftest(&result, &error);
    bool kept = fegetround() == FE_UPWARD;
    fesetround(FE_TONEAREST);
    CHECK(done, "%s", error.text);
    CHECK(kept, "the caller's rounding was not given back");
    CHECK(result.difference[0] == 0, "%s", result.difference);
}

int main(int argc, char **argv)
{
    RUN(test_the_recorded_hash);
    RUN(test_another_rounding_gives_the_same_hash);
    return check_result();
}
