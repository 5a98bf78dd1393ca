#!/bin/sh
# Draws the lessons again: prints src/cli/lesson_answers.h, the one table of the hashes of their pictures and answers;
# with --write puts it and the pictures beside the programs in place (then build lom again), and makes the pictures and the
# table of the gallery of mistakes. The programs have to be
# built: make && make build/tests/lessons/test_answers and the lessons, or make check.
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build}
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
answers=$BUILD/tests/lessons/test_answers

row() { # LESSON EXERCISE PICTURE RIGHT SENTENCE
    hash=$("$BUILD/lom" info --json "$3" | sed 's/.*"hash": *"\([0-9a-f]*\)".*/\1/')
    printf '    { "%s", %d, IS_PICTURE, 0x%s, %s, "%s" },\n' "$1" "$2" "$hash" "$4" "$5"
}

compiler="$(sed 's/ -D_GNU_SOURCE.*//' "$BUILD/flags") $(grep -o -e '--coverage' "$BUILD/flags" | head -1)"
{
    echo "/* Hashes of the lessons' pictures (exercise 0) and of the answers to their exercises. Made by tests/lessons/remake.sh"
    echo ' * --write; the answers are in tests/lessons/test_answers.c. */'
    echo '/* clang-format off */'
    for source in docs/lessons/*/*.c; do
        name=$(basename "$source" .c)
        [ "$source" = "docs/lessons/$name/$name.c" ] || continue
        "$BUILD/${source%.c}" "$folder/$name.png" >&2 || exit 1
        row "$name" 0 "$folder/$name.png" false "That is the picture of the lesson's own program."
        [ "$1" != --write ] || cp "$folder/$name.png" "docs/lessons/$name/$name.png"
    done
    "$answers" --rows
    "$answers" --changes >"$folder/changes"
    while IFS='|' read -r name exercise sentence change; do
        sed "$change" "docs/lessons/$name/$name.c" >"$folder/changed.c"
        cmp -s "$folder/changed.c" "docs/lessons/$name/$name.c" && { echo "$name $exercise: the change changes nothing" >&2; exit 1; }
        $compiler -std=gnu11 -O1 -Iinclude -ffp-contract=off -Wno-psabi ${SAN:+-fsanitize=$SAN} "$folder/changed.c" \
            "$BUILD/liblom.a" -lm -lpthread -o "$folder/changed" && "$folder/changed" "$folder/changed.png" >&2 || exit 1
        row "$name" "$exercise" "$folder/changed.png" true "$sentence"
        [ -z "$KEEP" ] || cp "$folder/changed.png" "$KEEP/$name-$exercise.png"
    done <"$folder/changes"
} >"$folder/table" || exit 1
if [ "$1" = --write ]; then
    cp "$folder/table" src/cli/lesson_answers.h
    gallery=$BUILD/docs/lessons/mistakes/gallery text=docs/lessons/mistakes/README.md
    "$gallery" docs/lessons/mistakes >&2 && sed '/^| right | wrong |/,$d' $text >"$folder/text" && "$gallery" >>"$folder/text" || exit 1
    cp "$folder/text" $text
fi
cat "$folder/table"
