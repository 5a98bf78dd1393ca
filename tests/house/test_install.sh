#!/bin/sh
# Proves that a shader of a user's own builds against the installed library, at every width with lom-cc and at one width
# with plain cc, with the static and the shared library, and draws the same bytes each time.
set -u
BUILD=${BUILD:-build}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAIL $1: $2; repeat: tests/house/test_install.sh"; exit 1; }

make -s install PREFIX="$folder/usr" BUILD="$BUILD" CC="${CC:-cc}" SAN="${SAN:-}" >"$folder/log" 2>&1 || {
    cat "$folder/log"; fail install "make install does not work"; }
prefix=$folder/usr
cp docs/examples/triangle.c "$folder/"
built=$(cd "$BUILD" && pwd)
cd "$folder" || exit 1
libs="-L$prefix/lib -llom -lm -lpthread"
[ -n "${SAN:-}" ] && libs="$libs -fsanitize=$SAN"
if command -v pkg-config >/dev/null 2>&1; then
    PKG_CONFIG_PATH=$prefix/lib/pkgconfig
    export PKG_CONFIG_PATH
    [ "$(pkg-config --modversion lom)" = "$("$built/lom" version | sed -n '1s/^lom \([0-9.]*\).*/\1/p')" ] ||
        fail pkg_config_names_the_version "$(pkg-config --modversion lom)"
    libs=$(pkg-config --libs --static lom)
    [ -n "${SAN:-}" ] && libs="$libs -fsanitize=$SAN"
    echo "PASS pkg_config_names_the_version"
else
    echo "SKIP pkg_config_names_the_version: no pkg-config here"
fi
CC="${CC:-cc}" "$prefix/bin/lom-cc" -c triangle.c -o triangle.o || fail lom_cc_builds_all_widths "lom-cc fails"
${CC:-cc} triangle.o $libs -o triangle || fail lom_cc_builds_all_widths "linking fails"
all=$(LD_LIBRARY_PATH=$prefix/lib ./triangle) || fail lom_cc_builds_all_widths "the program fails"
[ -s triangle.png ] && echo "PASS lom_cc_builds_all_widths"
${CC:-cc} -std=gnu11 -O2 -I"$prefix/include" -ffp-contract=off -Wno-psabi triangle.c $libs -o single ||
    fail one_width_is_enough "cc fails"
one=$(LD_LIBRARY_PATH=$prefix/lib ./single)
[ "$one" = "$all" ] || fail one_width_is_enough "$one is not $all"
echo "PASS one_width_is_enough"
for header in "$prefix"/include/lom/*.h; do
    echo "#include <lom/$(basename "$header")>" >one.c
    ${CC:-cc} -std=gnu11 -Wall -Wextra -Werror -Wno-psabi -I"$prefix/include" -fsyntax-only one.c ||
        fail headers_stand_alone "$header"
done
echo "PASS headers_stand_alone"
