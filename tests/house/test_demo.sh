#!/bin/sh
# Proves that make demo compiles a part of what make compiles, with the same flags and commands, so that neither makes the
# other compile anything again; that this part is enough to draw a scene; and that a command which it lacks says so.
cd "$(dirname "$0")/../.." || exit 1
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
build=${BUILD:-build}
status=0

report() { # a test's name and what is wrong
    if [ -z "$2" ]; then
        echo "PASS $1"
    else
        echo "FAIL $1: $2; repeat: $0"
        status=1
    fi
}

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
report the_demo_compiles_a_part_of_the_program "$why"

make -s CC="${CC:-gcc}" BUILD="$build" SAN="$SAN" "$build/demo/lom" >"$folder/link" 2>&1
scene="assets/scenes/lake.toml --size 64x36 --hash"
# shellcheck disable=SC2086 # words
ours=$("$build/demo/lom" render $scene 2>&1) && theirs=$("$build/lom" render $scene 2>&1)
why=
[ -n "$ours" ] && [ "$ours" = "$theirs" ] || why="the demo says '$ours', lom '$theirs' $(head -c 300 "$folder/link")"
report the_demo_draws_what_the_program_draws "$why"

"$build/demo/lom" explain >"$folder/out" 2>"$folder/errors"
code=$?
why=
[ $code -eq 2 ] && grep -q "make compiles all" "$folder/errors" || why="exit status $code, '$(head -c 200 "$folder/errors")'"
report a_command_that_the_demo_lacks_says_so "$why"
exit $status
