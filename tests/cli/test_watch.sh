#!/bin/sh
# Proves that `lom render --watch` draws again when the scene, a mesh, its material file or its picture changes, also while
# it draws, goes on after an error in each of them, waits for a scene that is not there, and does without a picture of a
# mesh that cannot be read.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
cd "$folder/scene" || exit 1
: >"$folder/err"
"$lom" render scene.toml -o out.ppm --watch --quiet >"$folder/watch" 2>>"$folder/err" &
watcher=$!
other=
trap 'kill $watcher $other 2>/dev/null; rm -rf "$folder"' EXIT

drawn=0 # how many times so far
errors=0

# Waits until COUNT lines of stderr have TEXT.
waits() {
    tries=0
    while [ "$(grep -c "$1" "$folder/err")" -lt "$2" ]; do
        tries=$((tries + 1))
        [ $tries -lt 200 ] || { echo "no \"$1\" number $2:"; cat "$folder/err"; return 1; }
        sleep 0.05
    done
}

# draws_after COMMAND...: the command changes a file; the picture is drawn again and is another one.
draws_after() {
    cp out.ppm before.ppm
    sleep 0.06 # so that the change falls into a look of its own
    "$@"
    drawn=$((drawn + 1))
    waits 'lom: drawn' $drawn && ! cmp -s out.ppm before.ppm
}

fails_after() {
    cp out.ppm before.ppm
    sleep 0.06
    "$@"
    errors=$((errors + 1))
    waits "lom: [a-z]*[.][a-z]*:" $errors && cmp out.ppm before.ppm
}

put() { printf "$2" >"$1.new" && mv "$1.new" "$1"; }
change() { sed "$2" "$1" >"$1.new" && mv "$1.new" "$1"; }

first_picture() {
    drawn=1
    waits 'lom: drawn' 1 && [ -s out.ppm ]
}

# TEXT COMMAND...: after the command changes a file TEXT says what was loaded, and the picture is that of a new renderer.
loads_after() {
    text=$1
    shift
    before=$(grep -c "lom: $text" "$folder/err")
    draws_after "$@" && [ "$(grep -c "lom: $text" "$folder/err")" -gt "$before" ] || return 1
    "$lom" render scene.toml -o "$folder/right.ppm" --quiet && cmp out.ppm "$folder/right.ppm"
}

# A key that frames look up, one of a part, one that everything depends on; then a file, for which all is loaded anew.
loads_what_it_must() {
    cp scene.toml good
    loads_after 'nothing has to be loaded again' change scene.toml 's/0, 2, 5/1, 3, 5/' &&
        loads_after 'loaded again: entities' change scene.toml 's/^mesh = .*/&\nscale = 1.5/' &&
        loads_after 'everything is loaded again' put scene.toml "$(cat scene.toml)\n[quality]\nwater = \"reference\"\n" &&
        draws_after cp good scene.toml
}

# FILE, a sed command that changes the picture, and what makes the file a bad one.
changes_and_mistakes() {
    cp "$1" good
    draws_after change "$1" "$2" && fails_after put "$1" "$3" && draws_after cp good "$1"
}

# The same of a mesh's own picture: a bad one is left out, with a warning, and drawn again when it is good.
changes_and_is_left_out() {
    cp "$1" good
    draws_after change "$1" "$2" && draws_after put "$1" "$3" && draws_after cp good "$1"
}

# Changes that come faster than pictures: the last one is drawn, whether it fell into a drawing or not.
changes_while_it_draws() {
    cp scene.toml other.toml
    : >"$folder/err"
    "$lom" render other.toml -o large.ppm --size 960x540 --threads 1 --watch --quiet >"$folder/watch" 2>>"$folder/err" &
    other=$!
    waits 'lom: drawn' 1
    last=0
    for round in 1 2 3; do
        for change in 1 2 3 4 5 6 7; do
            put box.mtl "newmtl skin\nKd 0.$round$change 0.5 1\n"
            sleep 0.04
        done
        "$lom" render other.toml -o "$folder/right.ppm" --size 960x540 --quiet
        tries=0
        until cmp -s large.ppm "$folder/right.ppm"; do
            tries=$((tries + 1))
            [ $tries -lt 200 ] || { echo "round $round: the last change is not drawn"; last=1; break; }
            sleep 0.05
        done
    done
    kill $other
    return $last
}

waits_for_the_scene() {
    : >"$folder/err"
    "$lom" render later.toml -o later.ppm --watch --quiet >"$folder/watch" 2>>"$folder/err" &
    other=$!
    waits 'later.toml' 1 && cp scene.toml later.toml && waits 'lom: drawn' 1 && cmp -s later.ppm out.ppm
    same=$?
    kill $other
    return $same
}

check first_picture first_picture
check the_scene_and_its_mistakes changes_and_mistakes scene.toml 's/0, 2, 5/1, 2, 5/' '[camera\n'
check the_mesh_and_its_mistakes changes_and_mistakes box.obj 's/v 0 2 0/v 0 3 0/' 'mtllib box.mtl\nf 1 2 3\n'
check the_materials_and_their_mistakes changes_and_mistakes box.mtl 's/Kd 1 1 1/Kd 0.2 1 0.2/' 'newmtl skin\nKd x\n'
check a_picture_that_cannot_be_read_is_left_out changes_and_is_left_out skin.ppm 's/^P6 2 2/P6 1 4/' 'P6 1 1\n'
check loads_what_it_must loads_what_it_must
check changes_while_it_draws changes_while_it_draws
check waits_for_a_scene_that_is_not_there waits_for_the_scene
exit $failures
