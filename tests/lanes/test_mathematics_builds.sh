#!/bin/sh
# The hash of the lane mathematics and of the mathematics in double is the recorded one with gcc and clang, at -O0 and
# -O3, at 4 and 16 lanes, on x86-64, AArch64 and s390x (big-endian), as far as compilers and qemu are there.
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
flags="-std=gnu11 -D_GNU_SOURCE -Iinclude -Isrc -Itests -Wno-psabi
       -ffp-contract=off -fno-math-errno -fno-trapping-math"
base="src/base/double_*.c src/base/hash.c src/base/random.c"

# check NAME RUNNER COMPILER FLAGS...
check()
{
    name=$1 runner=$2 compiler=$3
    shift 3
    if ! command -v "$compiler" >/dev/null || { [ -n "$runner" ] && ! command -v "${runner%% *}" >/dev/null; }; then
        echo "SKIP $name: no $compiler or ${runner:-runner} here"
        return
    fi
    for test in tests/lanes/test_mathematics.wide.c tests/base/test_double.c; do
        # shellcheck disable=SC2086
        if ! "$compiler" $flags "$@" -o "$folder/test" "$test" $base -lm >"$folder/log" 2>&1; then
            why="does not compile: $(head -1 "$folder/log")"
        elif $runner "$folder/test" the_hash_is_the_recorded_one >"$folder/log" 2>&1; then
            continue
        else
            why="another hash: $(head -1 "$folder/log")"
        fi
        echo "FAIL $name: $test: $why; repeat: tests/lanes/test_mathematics_builds.sh"
        return
    done
    echo "PASS $name"
}

for compiler in gcc clang; do
    check mathematics_"$compiler"_O0_4_lanes "" "$compiler" -O0 -DLOM_LANES=4
    check mathematics_"$compiler"_O3_16_lanes "" "$compiler" -O3 -DLOM_LANES=16
done
check mathematics_gcc_O2_8_lanes_native "" gcc -O2 -march=native -DLOM_LANES=8
check mathematics_aarch64 "qemu-aarch64 -L /usr/aarch64-linux-gnu" aarch64-linux-gnu-gcc -O2 -DLOM_LANES=8
check mathematics_s390x "qemu-s390x -L /usr/s390x-linux-gnu" s390x-linux-gnu-gcc -O2 -DLOM_LANES=4
