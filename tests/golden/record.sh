#!/bin/sh
# Records goldens anew: their pictures, and their hashes in goldens.txt. Usage: tests/golden/record.sh NAME... Look at what
# it records.
cd "$(dirname "$0")/../.." || exit 2
lom=${BUILD:-build}/lom
list=tests/golden/goldens.txt
for name in "$@"; do
    arguments=$(sed -n "s/^$name [^ ]* //p" $list)
    [ -n "$arguments" ] || { echo "record.sh: $list has no line for $name" >&2; exit 2; }
    # shellcheck disable=SC2086
    "$lom" $arguments -o "tests/golden/$name.png" >/dev/null || exit 2
    hash=$("$lom" info "tests/golden/$name.png" | sed 's/.*hash //')
    sed -i "s/^$name [^ ]* /$name $hash /" $list
    echo "$hash  tests/golden/$name.png"
done
