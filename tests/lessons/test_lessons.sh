#!/bin/sh
# Proves that each lesson's program, docs/lessons/NAME/NAME.c, draws the picture that is beside it, small enough for a
# page, in at most 120 lines of public headers; that making the table of hashes again gives the same table; that `lom
# lesson` knows every lesson, draws the same pictures and tells right answers from wrong ones; and that the pipeline in one
# file is what it says: under 500 lines of strict C that include libc and no header of the library below its public ones.
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build}
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
picture=$folder/picture.png lom=$BUILD/lom

result() { # name, what is wrong or nothing
    [ -z "$2" ] && echo "PASS $1" || echo "FAIL $1: $2; repeat: tests/lessons/test_lessons.sh"
}

"$lom" lesson >"$folder/list"
for text in docs/lessons/*/README.md; do
    name=$(basename "$(dirname "$text")") why=
    source=docs/lessons/$name/$name.c
    [ -f "$source" ] || continue
    "$BUILD/${source%.c}" "$picture" || why="$BUILD/${source%.c} failed"
    [ -n "$why" ] || "$lom" compare --quiet "${source%.c}.png" "$picture" || why="${source%.c}.png is another picture"
    [ "$(wc -c <"${source%.c}.png")" -lt 60000 ] || why="${source%.c}.png has 60 000 bytes or more"
    "$BUILD/${source%.c}" 2>/dev/null && why="$BUILD/${source%.c} without a file is no failure"
    [ "$name" = pipeline ] || [ "$(wc -l <"$source")" -le 120 ] || why="$source has more than 120 lines"
    strange=$(grep '^#include' "$source" | grep -vE '<(math|stdio|stdlib|string|lom/[a-z_]*)\.h>')
    [ -z "$strange" ] || why="$source has $strange"
    grep -q "!\[.*\]($name.png)" "$text" || why="$text does not show $name.png"
    [ "$name" = pipeline ] || grep -q '^## Exercises' "$text" || why="$text has no exercises"
    grep -q "($name/README.md)" docs/lessons/README.md || why="docs/lessons/README.md lacks $name"
    grep -q "^  $name " "$folder/list" || why="lom lesson does not list $name"
    "$lom" lesson "$name" -o "$folder/own.png" >"$folder/hash" && cmp -s "$folder/own.png" "$picture" || why="lom lesson $name -o draws another picture"
    "$lom" lesson "$name" | grep -q "docs/lessons/$name/README.md" || why="lom lesson $name does not say where it is"
    result "the_lesson_${name}_draws_its_picture" "$why"
done

why=
mkdir "$folder/changed"
KEEP=$folder/changed tests/lessons/remake.sh >"$folder/table" || why="tests/lessons/remake.sh failed"
cmp -s "$folder/table" src/cli/lesson_answers.h || why="the table is another one: $(diff "$folder/table" src/cli/lesson_answers.h | head -n 3 | tr '\n' ' ')"
result the_table_of_lessons_is_remade_alike "$why"

why=
mkdir "$folder/gallery"
"$BUILD/docs/lessons/mistakes/gallery" "$folder/gallery" || why="the gallery cannot be drawn"
for drawn in "$folder"/gallery/*.png; do
    cmp -s "$drawn" "docs/lessons/mistakes/$(basename "$drawn")" || why="docs/lessons/mistakes/$(basename "$drawn") is another picture"
done
[ "$(ls "$folder"/gallery/*.png | wc -l)" -eq "$(ls docs/lessons/mistakes/*.png | wc -l)" ] || why="there are pictures of no mistake"
"$BUILD/docs/lessons/mistakes/gallery" >"$folder/rows"
sed -n '/^| right | wrong |/,$p' docs/lessons/mistakes/README.md | cmp -s - "$folder/rows" || why="docs/lessons/mistakes/README.md has another table"
"$BUILD/docs/lessons/mistakes/gallery" no/such/folder 2>"$folder/err" && why="a folder that is not there is no failure"
mkdir "$folder/two"
"$BUILD/docs/lessons/mistakes/gallery" "$folder/two" gamma near_clip && [ "$(ls "$folder/two" | wc -l)" -eq 3 ] || why="two mistakes are not drawn alone"
"$BUILD/docs/lessons/mistakes/gallery" "$folder/two" gama 2>"$folder/err" && why="a mistake that is none is no failure"
result the_gallery_of_mistakes_is_drawn "$why"

why=
"$BUILD/tests/lessons/test_answers" --right >"$folder/right"
[ "$(wc -l <"$folder/right")" -ge 10 ] || why='there are few answers'
while read -r name exercise answer; do
    "$lom" lesson "$name" "$exercise" "$answer" | grep -q '^Right' || why="$name $exercise is not $answer"
    "$lom" lesson "$name" "$exercise" "1$answer" >"$folder/out"
    [ $? -eq 1 ] || why="$name $exercise takes 1$answer"
    grep -q "^$exercise\. " "docs/lessons/$name/README.md" || why="docs/lessons/$name/README.md has no exercise $exercise"
done <"$folder/right"
for changed in "$folder"/changed/*.png; do
    pair=$(basename "$changed" .png)
    "$lom" lesson "${pair%-*}" "${pair##*-}" "$changed" | grep -q '^Right' || why="$pair is not right"
    "$lom" lesson "${pair%-*}" "${pair##*-}" "docs/lessons/${pair%-*}/${pair%-*}.png" >"$folder/out" && why="$pair takes the unchanged picture"
    grep -q "own program" "$folder/out" || why="$pair is not told from the lesson's own picture"
done
result answers_are_told_from_wrong_ones "$why"

why=
refuses() { # TEXT ARGUMENT...
    text=$1
    shift
    "$lom" lesson "$@" >"$folder/out" 2>"$folder/err"
    [ $? -eq 2 ] && grep -qF "$text" "$folder/err" && [ ! -s "$folder/out" ] || why="lom lesson $*: $(cat "$folder/out" "$folder/err")"
}
refuses 'did you mean "triangle"' traingle
refuses 'has no exercise 99' triangle 99 1
refuses 'needs an answer' triangle 1
refuses 'is no number' triangle 1 one
refuses 'no/such.png' triangle 3 no/such.png
refuses 'name of a lesson' -o "$folder/none.png"
refuses 'nothing was written' triangle -o "$folder/none/none.png"
refuses 'is a whole one' triangle 1 2,5
refuses 'like 12.35' triangle 2 2/3
refuses 'file of a picture: 0.5: ' triangle 3 0.5
result lom_lesson_refuses_what_is_none "$why"

# The lines that are printed are run as they are, in a folder of their own.
why=
"$lom" lesson triangle | sed -n 's/^  copy *//p; s/^  compile *//p; s/^  run *//p' >"$folder/lines"
[ "$(wc -l <"$folder/lines")" -eq 3 ] || why='three lines are not told'
if [ -z "$SAN$COVERAGE" ]; then
    (cd "$folder" && sh -e ./lines) && "$lom" lesson triangle 3 "$folder/mine.png" | grep -q 'own program' ||
        why='the printed lines do not draw the picture'
fi
result what_lom_lesson_prints_compiles "$why"

source=docs/lessons/pipeline/pipeline.c why=
[ "$(wc -l <$source)" -lt 500 ] || why="$(wc -l <$source) lines"
strange=$(grep '^#include' $source | grep -vE '<(math|stdio|stdlib|string|lom/(base|image|geometry))\.h>')
[ -z "$strange" ] || why="it has $strange"
lanes=$(grep -nE 'lom_(float|int|mask|texture|draw|begin|sample|lod|device)|vector_size|_mm|__builtin' $source | grep -v lom_int_of)
[ -z "$lanes" ] || why="it uses what it should show: $lanes"
${CC:-cc} -std=c11 -Wall -Wextra -Wpedantic -Wshadow -Werror -Iinclude -fsyntax-only $source || why='it is no strict C11'
result the_pipeline_in_one_file_is_plain "$why"
