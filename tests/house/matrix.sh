#!/bin/bash
# Proves that bytes do not depend on the compiler, its optimisation level, the architecture or its byte order. Builds the
# program once for each row below, each into its own folder; compares the self-test, the lake at 160x90 at three widths,
# the float stages of the pipeline at three widths and, where that takes minutes, all scenes at 160x90. Prints a table and
# one hash; status 1 when a row differs from the first, 2 when a build fails. A compiler or an emulator that is not installed
# is a line with SKIP.
#
#   make matrix                                  every row
#   make matrix ROWS="gcc-0 aarch64-3"           these rows
#   make matrix ROWS="gcc-11-3 clang-19-2"       compilers by their names with a version
#   make matrix LAUNCHER=ccache                  compilers started through another program
set -u
cd "$(dirname "$0")/../.." || exit 2
rows=${ROWS:-gcc-0 gcc-1 gcc-2 gcc-3 gcc-11-3 clang-0 clang-1 clang-2 clang-3 clang-13-3 clang-19-2 aarch64-0 aarch64-3 s390x-0 s390x-3 wasm-3 wasm128-3}
root=${BUILD:-build}/matrix
jobs=${JOBS:-$(nproc 2>/dev/null || echo 1)}
mkdir -p "$root"
status=0

# WebAssembly, without and with its vectors, by the newest clang (docs/wasm.md).
wasm_clang=$(basename "$(ls /usr/bin/clang-[1-9][0-9] 2>/dev/null | sort | tail -1)")
wasm_clang=${wasm_clang:-clang} wasm_runner="node src/web/lom.mjs"

# compiler, archiver, linker flags and emulator of a row
set_row() {
    case $1 in
    aarch64-*) compiler=aarch64-linux-gnu-gcc archiver=aarch64-linux-gnu-ar flags=-static emulator=qemu-aarch64 ;;
    wasm-*) compiler="$wasm_clang --target=wasm32-wasi" archiver=llvm-ar flags= emulator=$wasm_runner ;;
    wasm128-*) compiler="$wasm_clang --target=wasm32-wasi -msimd128" archiver=llvm-ar flags= emulator=$wasm_runner ;;
    s390x-*) compiler=s390x-linux-gnu-gcc archiver=s390x-linux-gnu-ar flags=-static emulator=qemu-s390x ;;
    *) compiler=${1%-*} archiver=ar flags= emulator= ;;
    esac
    [ -z "$emulator" ] || command -v "${emulator%% *}" >/dev/null || emulator=$emulator-static
}

missing() {
    for tool in "${compiler%% *}" $archiver ${emulator%% *}; do
        command -v "$tool" >/dev/null || { echo "$tool"; return; }
    done
    case $compiler in *wasm32*)
        echo 'int main(void) { return 0; }' | $compiler -x c -o "$root/nothing.wasm" - 2>/dev/null || echo "wasi-libc for $compiler" ;;
    esac
}

# What a build answers, a word each: the self-test's hash, the lake's at 4, 8, 16 lanes, "same" for the float stages (-
# where they are not asked).
answers() {
    local folder=$1 program="$emulator $1/lom" floats=same
    $program selftest 2>>"$folder/log" | cut -d' ' -f1
    for lanes in 4 8 16; do
        $program render assets/scenes/lake.toml --size 160x90 --lanes $lanes --hash --quiet 2>>"$folder/log" | cut -d' ' -f1
    done
    case $compiler in *wasm32*) echo -; return ;; esac # the test wants threads and rounding modes
    for lanes in 4 8 16; do
        $emulator "$folder/tests/pipeline/test_invariance.w$lanes" float_stages_have_one_hash >>"$folder/log" 2>&1 ||
            floats=differ
    done
    echo $floats
}

# One hash of all scenes' pictures, - where they are not drawn.
scenes() {
    case $1 in gcc-3 | clang-3 | wasm*-3) ;; *) echo -; return ;; esac
    for scene in assets/scenes/*.toml; do
        $emulator "$2/lom" render "$scene" --size 160x90 --lanes 4 --hash --quiet 2>>"$2/log" | cut -d' ' -f1
    done | sha256sum | cut -c1-16
}

format='%-10s %-18s %-18s %-18s %-18s %-12s %s\n'
printf "$format" build selftest "lake, 4 lanes" "lake, 8 lanes" "lake, 16 lanes" "float stages" "all scenes"
first= first_scenes=-
for row in $rows; do
    set_row "$row"
    tool=$(missing)
    if [ -n "$tool" ]; then
        echo "SKIP $row: $tool is not installed"
        continue
    fi
    folder=$root/$row
    mkdir -p "$folder"
    targets="$folder/lom"
    case $compiler in *wasm32*) lanes_tested= ;; *) lanes_tested="4 8 16" ;; esac
    for lanes in $lanes_tested; do targets="$targets $folder/tests/pipeline/test_invariance.w$lanes"; done
    if ! make -j"$jobs" CC="${LAUNCHER:-} $compiler" AR=$archiver O="${row##*-}" BUILD="$folder" SAN= LDFLAGS=$flags \
        $targets >"$folder/log" 2>&1; then
        echo "$row: the build fails:"
        grep -E -m 5 "error|Error" "$folder/log"
        status=2
        continue
    fi
    result=$(answers "$folder" | tr '\n' ' ')
    [ -n "$first" ] || first=$result
    drawn=$(scenes "$row" "$folder")
    [ "$first_scenes" != - ] || first_scenes=$drawn
    mark=
    if { [ "$drawn" != - ] && [ "$drawn" != "$first_scenes" ]; } ||
        { [ "${result% - }" != "${first% same }" ] && [ "$result" != "$first" ]; } || [ "${result% differ }" != "$result" ]; then
        mark="  differs; see $folder/log"
        [ $status -ne 0 ] || status=1
    fi
    printf "$format" "$row" $result "$drawn" | sed "s|\$|$mark|"
done
echo "$first" | sha256sum | sed 's/^\(.\{16\}\).*/\1  matrix/'
exit $status
