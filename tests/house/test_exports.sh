#!/bin/sh
# Proves that the shared library shows what the public headers declare and nothing else, under a version of its own, and
# that the version is the number in its name.
set -u
BUILD=${BUILD:-build}
CC=${CC:-cc}
failures=0
fail() { echo "FAIL $1: $2; repeat: BUILD=$BUILD tests/house/test_exports.sh"; failures=1; }

if ! command -v nm >/dev/null || ! command -v objdump >/dev/null; then
    echo "SKIP exports: needs nm and objdump"
    exit 0
fi
library=$BUILD/liblom.so
[ -f "$library" ] || { fail library_is_built "$library does not exist"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Widths that this build folder holds: its own list, or all of the machine's.
variants=$(grep -o 'X(name,[0-9a-z_]*)' "$BUILD/flags" | sed 's/.*,//; s/)//' | sort -u)
[ -n "$variants" ] || variants=$(echo '#include <lom/lanes.h>
LOM_EACH_VARIANT(VARIANT, )' | $CC -E -P -Iinclude - | grep -o 'VARIANT(, [0-9a-z_]*)' | sed 's/.*, //; s/)//')

variants="$variants 4_recorded"

# Functions and tables at the outermost level of the preprocessed headers that are neither types nor static: what is
# within braces is taken away, and of each declaration its name, which stands before ( or [ or at the end.
for variant in $variants; do
    echo '#include <lom/lom.h>' | $CC -E -Iinclude -DLOM_LANES="${variant%%_*}" -DLOM_VARIANT="$variant" - |
        awk '/^# [0-9]+ "/ { ours = index($3, "include/lom/") > 0; next } ours && !/^#/' | tr '\n' ' ' |
        awk -v RS='' '{
            depth = 0
            for (i = 1; i <= length($0); i++) {
                c = substr($0, i, 1)
                if (c == "{") depth++
                if (depth == 0) printf "%s", c == ";" ? ";\n" : c
                if (c == "}") { depth--; if (depth == 0) printf " @ " }
            }
        }' | sed 's/__attribute__ *(([^;]*)) *;/;/; s/.*@ *\(static\|extern\|const\|[a-z]\)/\1/' |
        grep -v -E 'typedef|static|^ *(enum|struct) *@|^ *(enum|struct) [a-z_0-9]* *;' |
        sed -n 's/^[^(=[]*[ *]\(lom_[A-Za-z0-9_]*\) *[(;[].*/\1/p'
done | sort -u >"$folder/declared"
nm -D --defined-only "$library" | awk '$2 != "A" { print $NF }' >"$folder/versioned"
sed 's/@.*//' "$folder/versioned" | sort -u >"$folder/exported"

hidden=$(comm -23 "$folder/declared" "$folder/exported")
if [ -n "$hidden" ]; then
    fail what_is_declared_is_exported "$(echo $hidden)"
else
    echo "PASS what_is_declared_is_exported"
fi
if [ -n "${SAN:-}" ]; then
    extra=$(comm -13 "$folder/declared" "$folder/exported" | grep '^lom_') # a sanitizer has names of its own
else
    extra=$(comm -13 "$folder/declared" "$folder/exported")
fi
if [ -n "$extra" ]; then
    fail what_is_exported_is_declared "$(echo $extra)"
elif [ "$(wc -l <"$folder/exported")" -lt 200 ]; then
    fail what_is_exported_is_declared "only $(wc -l <"$folder/exported") names were found"
else
    echo "PASS what_is_exported_is_declared"
fi
number=$(objdump -p "$library" | sed -n 's/.*SONAME *liblom\.so\.\([0-9]*\)$/\1/p')
other=$(grep -v "@@LOM_$number\$" "$folder/versioned" | grep '^lom_' | head -3)
if [ -z "$number" ] || [ -n "$other" ]; then
    fail symbols_have_the_version_of_the_name "soname number \"$number\"; without its version: $(echo $other)"
else
    echo "PASS symbols_have_the_version_of_the_name"
fi
exit $failures
