/* The choice of a variant. In: lanes, or none. Out: a slot of the tables. Invariant: what is chosen is built and runs
 * here; the bytes of a picture do not depend on it. */
#include "lanes/variants.h"

#include <lom/base.h>

#ifdef __x86_64__
enum { NATIVE_IS_PLAIN = false }; /* native 8 and 16 lanes are of AVX2 and AVX-512 */
#else
enum { NATIVE_IS_PLAIN = true };
#endif

const struct lom_variant lom_variants[LOM_VARIANTS] = {
    [LOM_SLOT_4] = { 4, true },       [LOM_SLOT_8] = { 8, NATIVE_IS_PLAIN }, [LOM_SLOT_16] = { 16, NATIVE_IS_PLAIN },
    [LOM_SLOT_8_plain] = { 8, true }, [LOM_SLOT_16_plain] = { 16, true },    [LOM_SLOT_4_recorded] = { 4, true },
};

#define BUILT(name, variant) [LOM_SLOT_##variant] = true,
static const bool built[LOM_VARIANTS] = { LOM_EACH_VARIANT(BUILT, ) };

bool lom_runs_variant(int variant)
{
    lom_cpu cpu = lom_detect_cpu();
    const struct lom_variant *v = &lom_variants[variant];
    return built[variant] && (v->plain || (v->lanes == 8 ? cpu.avx2 : cpu.avx512));
}

int lom_find_variant(int lanes, bool plain)
{
    for (int variant = 0; variant < LOM_VARIANTS; variant++)
        if (lom_variants[variant].lanes == lanes && (lom_variants[variant].plain || !plain) &&
            lom_runs_variant(variant))
            return variant;
    return -1;
}

int lom_widest_variant(bool plain)
{
    int widest = LOM_SLOT_4;
    for (int variant = 0; variant < LOM_VARIANTS && !plain; variant++)
        if (!lom_variants[variant].plain && lom_variants[variant].lanes > lom_variants[widest].lanes &&
            lom_runs_variant(variant))
            widest = variant;
    return widest;
}
