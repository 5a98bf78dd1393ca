#!/bin/sh
# Proves that the hashes in README.md are those of this build: every line "lom ...  # HASH ..." of it is run.
lom=${BUILD:-build}/lom
lines=$(mktemp) || exit 1
trap 'rm -f "$lines"' EXIT
grep -E '^lom .*# [0-9a-f]{16}' README.md >"$lines"
why=
[ "$(grep -c . "$lines")" -ge 2 ] || why='README.md names no hash'
while read -r line; do
    arguments=${line%%#*} expected=${line##*# }
    # shellcheck disable=SC2086
    drawn=$("$lom" ${arguments#lom } --quiet 2>&1)
    [ "$drawn" = "$expected" ] || why="$line: $drawn"
done <"$lines"
[ -z "$why" ] && echo "PASS hashes_of_the_readme_are_drawn" ||
    echo "FAIL hashes_of_the_readme_are_drawn: $why; repeat: tests/house/test_readme.sh"
