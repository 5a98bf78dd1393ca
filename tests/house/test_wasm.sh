#!/bin/bash
# Proves that lom for WebAssembly, under node, draws the bytes of the native program and treats files as it does: whole
# or not at all, with the permissions and through the links they had, named as in the shell, refused with a sentence.
# Builds it (-O1, 4 lanes) where clang can, with vectors where that clang is right about them; else says what is missing.
# Then the same of the lessons' pages (wasm_pages.sh).
set -u
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build}
unset MAKEFLAGS MAKELEVEL COVERAGE # of the make that runs the tests: what it builds is not what is built here
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
result() { # NAME, whether it holds, what is wrong
    if [ "$2" -eq 0 ]; then echo "PASS $1"; else echo "FAIL $1: $3; repeat: BUILD=$BUILD tests/house/test_wasm.sh"; failures=1; fi
}
skip() { echo "SKIP wasm: $1"; exit 0; }

for tool in node llvm-ar; do command -v $tool >/dev/null || skip "needs $tool"; done
compiler=
for candidate in $(ls /usr/bin/clang-[1-9][0-9] 2>/dev/null | sort -r) clang; do
    echo 'int main(void) { return 0; }' | $candidate --target=wasm32-wasi -x c -o "$folder/nothing.wasm" - 2>/dev/null &&
        compiler=$candidate && break
done
[ -n "$compiler" ] || skip "no clang links for wasm32-wasi (Debian: clang-19 lld-19 wasi-libc libclang-rt-19-dev-wasm32)"
simd=-msimd128
[ "$(echo __clang_major__ | $compiler -E -P -x c -)" -ge 16 ] || simd=
pages=pages
command -v cmark-gfm >/dev/null || { pages=; echo "SKIP the lessons' pages: cmark-gfm is not installed"; }
if ! make -s wasm O=1 BUILD="$BUILD/test" WASM_CC="$compiler" SIMD="$simd" \
    WASM_GOALS="$BUILD/test/wasm/lom.wasm $BUILD/test/wasm/tests/lanes/test_operations.w4 $pages" >"$folder/log" 2>&1; then
    tail -20 "$folder/log"
    result wasm_is_built 1 "make wasm WASM_CC=$compiler SIMD=$simd fails"
    exit 1
fi
native() { "$BUILD/lom" "$@"; }
wasm() { node src/web/lom.mjs "$BUILD/test/wasm/lom.wasm" "$@"; }

# Every override of a lane operation (lom/lanes_wasm.h) against its definition.
node src/web/lom.mjs "$BUILD/test/wasm/tests/lanes/test_operations.w4" >"$folder/log" 2>&1
[ $? -eq 0 ] && grep -q '^PASS overrides_equal_definitions_on_random_bits' "$folder/log"
result wasm_lanes_give_what_is_defined $? "$(grep -v ^PASS "$folder/log" | head -3)"

expected=$(native selftest) drawn=$(wasm selftest 2>&1)
[ -n "$drawn" ] && [ "$drawn" = "$expected" ]
result wasm_gives_the_hash_of_the_selftest $? "$drawn instead of $expected"
for scene in lake clouds-30; do # cumulus would be the same march, but 20 seconds to make its cloud
    expected=$(native render assets/scenes/$scene.toml --size 64x36 --hash --quiet)
    drawn=$(wasm render assets/scenes/$scene.toml --size 64x36 --hash --quiet --threads 4 2>&1)
    [ -n "$drawn" ] && [ "$drawn" = "$expected" ]
    result wasm_draws_the_bytes_of_$scene $? "$drawn instead of $expected"
done

# A picture from a folder of its own over one that was there, through a link; then into a pipe.
native make normal-map -o "$folder/native.png" --size 128
mkdir "$folder/in"
native convert "$folder/native.png" "$folder/native.ppm"
echo old >"$folder/in/target.ppm"
chmod 600 "$folder/in/target.ppm"
ln -s target.ppm "$folder/in/link.ppm"
program=$(cd "$BUILD/test/wasm" && pwd)/lom.wasm runner=$PWD/src/web/lom.mjs
(cd "$folder/in" && node "$runner" "$program" convert ../native.png link.ppm) >"$folder/log" 2>&1
status=$?
cmp -s "$folder/native.ppm" "$folder/in/target.ppm" && [ $status -eq 0 ] && [ -L "$folder/in/link.ppm" ] &&
    [ "$(stat -c %a "$folder/in/target.ppm")" = 600 ] && [ "$(ls -A "$folder/in" | tr '\n' ' ')" = "link.ppm target.ppm " ]
result wasm_replaces_a_file_through_a_link_with_its_permissions $? "status $status; $(ls -lA "$folder/in"; cat "$folder/log")"
wasm convert - - --format ppm <"$folder/native.ppm" 2>"$folder/log" | cmp -s - "$folder/native.ppm"
result wasm_reads_and_writes_pipes $? "$(cat "$folder/log")"

wasm info "$folder/none.png" >"$folder/out" 2>&1
[ $? -eq 2 ] && grep -q 'none.png: could not open: No such file' "$folder/out"
result wasm_says_what_cannot_be_read $? "$(cat "$folder/out")"
wasm convert "$folder/native.png" "$folder/none/a.png" >"$folder/out" 2>&1
[ $? -eq 2 ] && grep -q 'none/a.png: could not' "$folder/out"
result wasm_says_what_cannot_be_written $? "$(cat "$folder/out")"

# Folders are read: a picture in both, one deeper in one of them alone.
mkdir -p "$folder/a/deep" "$folder/b"
cp "$folder/native.ppm" "$folder/a/deep/alone.ppm"
for side in a b; do cp "$folder/native.ppm" "$folder/$side/both.ppm"; done
native compare "$folder/a" "$folder/b" >"$folder/expected" 2>&1
expected=$?
wasm compare "$folder/a" "$folder/b" >"$folder/out" 2>&1
[ $? -eq $expected ] && grep -q alone.ppm "$folder/expected" && cmp -s "$folder/expected" "$folder/out"
result wasm_compares_folders $? "$(cat "$folder/expected" "$folder/out")"
# Without vectors of 128 bits each of their operations is four.
[ -z "$pages" ] || BUILD=$BUILD LARGEST=$([ -n "$simd" ] && echo 1048576 || echo 1572864) tests/house/wasm_pages.sh || failures=1
exit $failures
