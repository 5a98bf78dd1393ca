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

# Waits until a command succeeds, at most ten seconds; then it says what did not happen.
until_done() {
    what=$1
    shift
    tries=0
    until "$@"; do
        tries=$((tries + 1))
        [ $tries -lt 200 ] || { echo "$what:"; cat "$folder/err"; return 1; }
        sleep 0.05
    done
}

count() { grep -c "$1" "$folder/err"; }
is_said() { [ "$(count "$1")" -gt "$2" ]; }
differ() { ! cmp -s "$1" "$2"; }

# Waits until stderr has the text.
waits() { until_done "no \"$1\"" is_said "$1" 0; }

# draws_after COMMAND...: the command changes a file; the picture is drawn again and is another one. (It may be drawn more
# than once, where a look falls between two steps of the command.)
draws_after() {
    cp out.ppm before.ppm
    sleep 0.06 # so that the change falls into a look of its own
    "$@"
    until_done "no other picture" differ out.ppm before.ppm
}

fails_after() {
    cp out.ppm before.ppm
    sleep 0.06
    errors=$(count "lom: [a-z]*[.][a-z]*:")
    "$@"
    until_done "no error" is_said "lom: [a-z]*[.][a-z]*:" "$errors" && cmp out.ppm before.ppm
}

put() { printf "$2" >"$1.new" && mv "$1.new" "$1"; }
change() { sed "$2" "$1" >"$1.new" && mv "$1.new" "$1"; }

first_picture() {
    waits 'lom: drawn' && [ -s out.ppm ]
}

# TEXT COMMAND...: after the command changes a file TEXT says what was loaded, and the picture is that of a new renderer.
loads_after() {
    text=$1
    shift
    before=$(count "lom: $text")
    draws_after "$@" && until_done "no \"$text\"" is_said "lom: $text" "$before" || return 1
    "$lom" render scene.toml -o "$folder/right.ppm" --quiet && until_done "not that picture" cmp -s out.ppm "$folder/right.ppm"
}

# A key that frames look up, one of a part, one that everything depends on; then a file, for which all is loaded anew.
loads_what_it_must() {
    cp scene.toml good
    loads_after 'nothing has to be loaded again' change scene.toml 's/0, 2, 5/1, 3, 5/' &&
        loads_after 'loaded again: entities' change scene.toml 's/^mesh = .*/&\nscale = 1.5/' &&
        loads_after 'everything is loaded again' put scene.toml "$(sed 's/^water = .*/water = "reference"/' scene.toml)\n" &&
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
    waits 'lom: drawn'
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
    waits 'later.toml' && cp scene.toml later.toml && waits 'lom: drawn' && cmp -s later.ppm out.ppm
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
