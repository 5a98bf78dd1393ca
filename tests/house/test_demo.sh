#!/bin/sh
# Proves that make demo compiles a part of what make compiles, with the same flags and commands, so that neither makes the
# other compile anything again. Nothing is built.
cd "$(dirname "$0")/../.." || exit 1
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
commands() { # of a target of a fresh folder
    env -u MAKEFLAGS -u MAKELEVEL make -n V=1 CC="${CC:-gcc}" SAN= BUILD="$folder/build" "$1" 2>/dev/null |
        grep -e " -c -o " -e "$folder/build/flags" | grep -v "$folder/build/demo/" | sort
}
commands demo >"$folder/demo"
commands all >"$folder/all"
why=
grep -q "pipeline/raster.w4.o" "$folder/demo" || why="the demo compiles nothing"
other=$(comm -23 "$folder/demo" "$folder/all" | head -n 1)
[ -z "$other" ] || why="only the demo has: $other"
if [ -z "$why" ]; then
    echo "PASS the_demo_compiles_a_part_of_the_program"
else
    echo "FAIL the_demo_compiles_a_part_of_the_program: $why; repeat: $0"
    exit 1
fi
