#!/bin/sh
# No floating value becomes an integer but by lom_int_of, lom_int64_of and lom_count_of (lom/base.h) or, in lanes, by
# lom_to_int and lom_bounded_to_int (lom/lanes.h) and to_narrowed (lanes/channels.h): C leaves the conversion undefined
# out of range, and processors disagree there. Reads the syntax trees of all of src/ and of what it includes, so casts,
# implicit conversions and compound assignments are found wherever they stand, also in macros and in constant
# expressions. First, every form is planted in a file, and must be found. Prints each conversion; fails when there is one.
BUILD=${BUILD:-build}
QUERY=${CLANG_QUERY:-clang-query}
command -v "$QUERY" >/dev/null 2>&1 || { echo "lint: $QUERY is not installed, so conversions to integers were not checked"; exit 0; }
casts='castExpr(hasCastKind("CK_FloatingToIntegral"), unless(isExpansionInSystemHeader()))'
assignments='binaryOperator(hasAnyOperatorName("+=", "-=", "*=", "/="), hasLHS(hasType(isInteger())), hasRHS(hasType(realFloatingPointType())), unless(isExpansionInSystemHeader()))'
flags='-std=gnu11 -D_GNU_SOURCE -Iinclude -Isrc -Wno-everything'

conversions() { # in these files: FILE:LINE:COLUMN each, or "query: ..." where a file was not read
    "$QUERY" -c "match $casts" -c "match $assignments" "$@" -- $flags 2>&1 |
        sed -n "s|^$PWD/||; s|: note: \"root\" binds here.*||p; s|^\(.*: error: .*\)|query: \1|p" | sort -u
}

planted=$BUILD/planted.c
cat >"$planted" <<'END'
#include <stdint.h>
#define HALF(x) ((int)((x) * 0.5f))
_Static_assert((int)2.5 == 2, "");
enum { constant = (unsigned)7.5 };
enum kind { KIND };
static const uint8_t table[] = { (uint8_t)300.0 };
int f(double x, float y)
{
    int64_t a = x;
    uint8_t b = (uint8_t)(y + 1);
    a += x;
    int c[3] = { (int)x }, d = HALF(y), e = x > 0 ? (int)(x) : 0;
    enum kind k = (enum kind)y;
    return c[(unsigned long)x] + b + d + e + (int)a + (int)k + table[0] + constant;
}
int g(float y)
{
    return y;
}
END
lines=$(conversions "$planted" | cut -d: -f2 | sort -n | tr '\n' ' ')
[ "$lines" = "3 4 6 9 10 11 12 12 12 13 14 18 " ] || { echo "lint: of conversions that were planted, those on lines $lines were found"; exit 1; }

files=$(ls src/*/*.c src/*/*/*.c)
half=$(($(echo "$files" | wc -l) / 2))
conversions $(echo "$files" | head -n $half) >"$BUILD/conversions.1" &
conversions $(echo "$files" | tail -n +$((half + 1))) >"$BUILD/conversions.2"
wait
own=$(grep -n '([a-z0-9_]*_t)x' include/lom/base.h | cut -d: -f1)
status=0
for found in $(sort -u "$BUILD/conversions.1" "$BUILD/conversions.2" | tr ' ' '_'); do
    place=${found%:*}
    case " $(echo $own | sed 's|[0-9][0-9]*|include/lom/base.h:&|g') " in *" $place "*) continue ;; esac
    echo "$found: a floating value becomes an integer unchecked: lom_int_of, lom_int64_of or lom_count_of of lom/base.h"
    status=1
done
elsewhere=$(grep -nE '__builtin_convertvector\(.*, *(lom_int|lom_uint|lom_long|lom_mask)\)|_cvtt?[ps][sd]_|\bl?l(rint|round)f?\(' \
    -r include src | grep -vE '^include/lom/lanes\.h:|^include/lom/lanes_(x86|wasm)\.h:|^src/lanes/channels\.h:|^include/lom/lanes_mathematics\.h:.*\(mask, ')
[ -z "$elsewhere" ] || { echo "$elsewhere"; echo "lint: lanes become integers outside lom/lanes.h"; status=1; }
exit $status
