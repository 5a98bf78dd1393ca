#!/bin/sh
# Proves `lom make`: every committed asset is remade byte for byte by one command, no asset is left over that it does
# not make, and what cannot be made is refused in one sentence without a file.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
root=$PWD

remade() {
    exits 0 "$lom" make all -o "$folder/all" || return 1
    (cd assets && find terrain water sky entities textures -type f) | sort >"$folder/committed"
    (cd "$folder/all" && find . -type f | sed 's|^\./||') | sort >"$folder/made"
    cmp "$folder/committed" "$folder/made" || { diff "$folder/committed" "$folder/made"; return 1; }
    while read -r file; do
        cmp "assets/$file" "$folder/all/$file" || return 1
    done <"$folder/made"
}

single() {
    exits 0 "$lom" make normal-map -o "$folder/n.png" && cmp "$folder/n.png" assets/water/normal.png &&
        exits 0 "$lom" make albedo shore -o "$folder/s.png" && cmp "$folder/s.png" assets/terrain/shore.png
}

parameters() {
    exits 0 "$lom" make normal-map --size 128 --seed 5 --roughness 0.2 -o "$folder/a.png" &&
        exits 0 "$lom" make normal-map --size 128 --seed 6 --roughness 0.2 -o "$folder/b.png" &&
        ! cmp -s "$folder/a.png" "$folder/b.png" && exits 0 "$lom" info "$folder/a.png" && says "128 x 128"
}

# What `make list` names can be made: of each kind, its first.
listed() {
    exits 0 "$lom" make list && cp "$folder/out" "$folder/list" && [ "$(wc -l <"$folder/list")" -ge 30 ] || return 1
    grep -q '^cloud  *cumulus_humilis  *[A-Z]' "$folder/list" && grep -q 'terrain/height.png' "$folder/list" || return 1
    sed 's/ .*//' "$folder/list" | sort -u >"$folder/kinds"
    while read -r kind; do
        "$lom" make --help | grep -q "$kind" || { echo "make --help lacks $kind"; return 1; }
    done <"$folder/kinds"
}

standard_output() {
    "$lom" make flow-map --size 128 -o - >"$folder/piped.png" && exits 0 "$lom" make flow-map --size 128 -o "$folder/f.png" &&
        cmp "$folder/piped.png" "$folder/f.png"
}

refused() {
    mkdir "$folder/empty" && cd "$folder/empty" || return 1
    exits 2 "$lom" make hight-map -o a.png && complains "there is no hight-map" &&
        exits 2 "$lom" make albedo gras -o a.png && complains "there is no albedo gras" &&
        exits 2 "$lom" make normal-map && complains "-o OUT" &&
        exits 2 "$lom" make normal-map --size 130 -o a.png && complains "multiple of 4" &&
        exits 2 "$lom" make height-map --size 100 -o a.png && complains "not 100" &&
        exits 2 "$lom" make sky-box --size 16 -o a.png && complains "%s" &&
        exits 2 "$lom" make sky-box --size 16 -o '%s%s.png' && complains "one %s" &&
        exits 2 "$lom" make entity boat -o boat.png && complains ".obj" &&
        exits 2 "$lom" make flow-map --size 128 -o missing/a.png && complains "missing" || return 1
    echo >"$folder/file"
    exits 2 "$lom" make all -o "$folder/file" && complains "Not a directory" || return 1
    cd "$root" || return 1
    [ -z "$(ls -A "$folder/empty")" ] || { ls "$folder/empty"; return 1; }
}

check remade remade
check single single
check parameters parameters
check kinds_are_listed listed
check standard_output standard_output
check refused refused
exit $failures
