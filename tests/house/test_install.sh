#!/bin/sh
# Proves that a shader of a user's own builds against the installed library, as README.md says, at every width with lom-cc
# and at one width with plain cc, in C and in C++, with the static and the shared library, and draws the same bytes each
# time; that lom-cc says what it takes; that every public header stands alone; that the lessons are there; and that
# uninstall leaves nothing.
set -u
BUILD=${BUILD:-build}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAIL $1: $2; repeat: BUILD=$BUILD tests/house/test_install.sh"; exit 1; }

# The build folder's own compiler, level and widths: with others it would be built anew.
compiler=$(sed 's/ -D_GNU_SOURCE.*//' "$BUILD/flags")
level=$(grep -o -e ' -O[0-3s]' "$BUILD/flags" | head -1)
variants=$(grep -o 'X(name,[0-9a-z_]*)' "$BUILD/flags" | sed 's/.*,//; s/)//' | tr '\n' ' ')
make_target() { # install or uninstall
    make -s "$1" PREFIX="$folder/usr" BUILD="$BUILD" CC="$compiler" O="${level# -O}" SAN="${SAN:-}" \
        ${variants:+VARIANTS="${variants% }"} >"$folder/log" 2>&1 || { cat "$folder/log"; fail "$1" "make $1 does not work"; }
}
make_target install
prefix=$folder/usr
export PATH="$prefix/bin:$PATH" PKG_CONFIG_PATH="$prefix/lib/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}"
export CC="${CC:-$compiler}"
cp docs/examples/*.c tests/house/triangle.cpp "$folder/"
sed -n '/^lom-cc triangle/,/^```/p' README.md | grep -v '^```' >"$folder/readme.sh"
built=$(cd "$BUILD" && pwd)
root=$(pwd)
cd "$folder" || exit 1
sanitize=${SAN:+-fsanitize=$SAN}
[ -z "${COVERAGE:-}" ] || sanitize=--coverage
archive="$prefix/lib/liblom.a -lm -lpthread $sanitize"

lom-cc --help | grep -q '^usage: lom-cc' || fail lom_cc_says_what_it_takes "lom-cc --help"
lom-cc 2>message && fail lom_cc_says_what_it_takes "no file is taken"
grep -q 'no source file' message || fail lom_cc_says_what_it_takes "$(cat message)"
echo "PASS lom_cc_says_what_it_takes"

lom-cc -c triangle.c -o triangle.o || fail lom_cc_builds_all_widths "lom-cc fails"
$CC triangle.o $archive -o triangle || fail lom_cc_builds_all_widths "linking fails"
all=$(./triangle) || fail lom_cc_builds_all_widths "the program fails"
[ -s triangle.png ] || fail lom_cc_builds_all_widths "no picture is written"
for example in mirror viewports blocks affine panes; do
    lom-cc -c $example.c -o $example.o && $CC $example.o $archive -o $example || fail lom_cc_builds_all_widths "$example.c"
    ./$example >$example.all && [ -s $example.png ] || fail lom_cc_builds_all_widths "$example.c draws nothing"
done
echo "PASS lom_cc_builds_all_widths"

lom-cc -c fountain.c -o fountain.o || fail stages_are_built_at_all_widths "lom-cc fails"
$CC fountain.o $archive -o fountain || fail stages_are_built_at_all_widths "linking fails"
$CC -std=gnu11 -O2 -I"$prefix/include" -ffp-contract=off -Wno-psabi fountain.c $archive -o fountain1 ||
    fail stages_are_built_at_all_widths "cc fails"
[ "$(./fountain)" = "$(./fountain1)" ] && [ -s fountain.png ] || fail stages_are_built_at_all_widths "$(./fountain) is not $(./fountain1)"
echo "PASS stages_are_built_at_all_widths"

$CC -std=gnu11 -O2 -I"$prefix/include" -ffp-contract=off -Wno-psabi triangle.c $archive -o single ||
    fail one_width_is_enough "cc fails"
one=$(./single)
[ "$one" = "$all" ] || fail one_width_is_enough "$one is not $all"
for example in mirror viewports blocks affine panes; do
    $CC -std=gnu11 -O2 -I"$prefix/include" -ffp-contract=off -Wno-psabi $example.c $archive -o single ||
        fail one_width_is_enough "cc fails on $example.c"
    [ "$(./single)" = "$(cat $example.all)" ] || fail one_width_is_enough "$(./single) is not $(cat $example.all)"
done
echo "PASS one_width_is_enough"

if [ -n "$sanitize" ]; then
    echo "SKIP lines_of_the_readme_work: a library of the compiler's would have to be linked, too"
elif command -v pkg-config >/dev/null 2>&1; then
    [ "$(pkg-config --modversion lom)" = "$("$built/lom" version | sed -n '1s/^lom \([0-9.]*\).*/\1/p')" ] ||
        fail lines_of_the_readme_work "pkg-config's version is $(pkg-config --modversion lom)"
    [ "$(wc -l <readme.sh)" -ge 3 ] || fail lines_of_the_readme_work "README.md holds no such lines"
    while read -r line; do
        rm -f triangle.png
        (eval "$line") || fail lines_of_the_readme_work "$line"
        case $line in *' -c '*) continue ;; esac
        [ "$(env -u LD_LIBRARY_PATH ./triangle)" = "$all" ] || fail lines_of_the_readme_work "after $line: $(./triangle 2>&1)"
        rm triangle
    done <readme.sh
    echo "PASS lines_of_the_readme_work"
    echo '#include <lom/lom.h>' >one.c
    for lanes in 4 8 16; do
        [ -z "$($CC $(pkg-config --cflags lom) -DLOM_LANES=$lanes -Wall -Wextra -fsyntax-only one.c 2>&1)" ] ||
            fail flags_of_pkg_config_warn_of_nothing "$lanes lanes"
    done
    echo "PASS flags_of_pkg_config_warn_of_nothing"
else
    echo "SKIP lines_of_the_readme_work: no pkg-config here"
fi

# The C++ compiler that belongs to the C compiler.
cxx=$(echo "$CC" | sed 's/gcc/g++/; s/clang/clang++/; s/^cc$/c++/; s/ cc$/ c++/')
if ! $cxx --version >/dev/null 2>&1; then
    echo "SKIP shaders_can_be_cpp: $cxx does not run here"
else
    export CXX="$cxx"
    lom-cc -Wall -Wextra -Wpedantic -Werror -c triangle.cpp -o cpp.o || fail shaders_can_be_cpp "lom-cc fails"
    $cxx cpp.o $archive -o cpp || fail shaders_can_be_cpp "linking fails"
    [ "$(./cpp | sort -u)" = "$all" ] || fail shaders_can_be_cpp "at some width: $(./cpp | tr '\n' ' ') instead of $all"
    for level in 0 2; do
        $cxx -std=c++17 -O$level -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" -ffp-contract=off triangle.cpp $archive -o one ||
            fail shaders_can_be_cpp "$cxx at -O$level"
        [ "$(./one | sort -u)" = "$all" ] || fail shaders_can_be_cpp "$(./one | tr '\n' ' ') instead of $all at -O$level"
    done
    echo "PASS shaders_can_be_cpp"
fi

for header in "$prefix"/include/lom/*.h; do
    case $(basename "$header")$($CC -dumpmachine) in lanes_x86.hx86_64*) ;; lanes_x86.h* | lanes_wasm.h*) continue ;; esac
    echo "#include <lom/$(basename "$header")>" >one.c
    $CC -std=c11 -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" -fsyntax-only one.c || fail headers_stand_alone "$header"
    missing=$(cat "$prefix/include/lom/lom.h" "$prefix/include/lom/lanes.h" | grep -c "<lom/$(basename "$header")>")
    [ "$missing" -gt 0 ] || [ "$(basename "$header")" = lom.h ] || fail headers_stand_alone "lom.h lacks $header"
done
echo "PASS headers_stand_alone"

told=$("$prefix/bin/lom" lesson triangle | sed -n 's/^ *program *//p')
$CC -O2 -I"$prefix/include" -ffp-contract=off "$told" $archive -o lesson && ./lesson one.png && "$prefix/bin/lom" lesson triangle -o two.png >/dev/null && cmp -s one.png two.png ||
    fail lessons_are_installed "the program of a lesson, $told"
[ -s "$prefix/share/lom/lessons/triangle/README.md" ] || fail lessons_are_installed "their texts"
[ -n "${SAN:-}" ] || CC="$CC $sanitize" "$prefix/bin/lom" grade "$root/tests/lessons/students/right_march.c" >log 2>&1 || { cat log; fail lessons_are_installed "lom grade"; }
echo "PASS lessons_are_installed"

cd "$root" || exit 1
make_target uninstall
left=$(find "$prefix" ! -type d)
[ -z "$left" ] && [ ! -d "$prefix/include/lom" ] && [ ! -d "$prefix/share/lom" ] || fail uninstall_leaves_nothing "$left"
echo "PASS uninstall_leaves_nothing"
