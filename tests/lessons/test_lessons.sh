#!/bin/sh
# Proves that each lesson's program, docs/lessons/NAME/NAME.c, draws the picture that is beside it, small enough for a
# page; and that the pipeline in one file is what it says: under 500 lines of strict C that include libc and no header of
# the library below its public ones.
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build}
picture=$(mktemp) || exit 1
trap 'rm -f "$picture" "$picture.png"' EXIT

result() { # name, what is wrong or nothing
    [ -z "$2" ] && echo "PASS $1" || echo "FAIL $1: $2; repeat: tests/lessons/test_lessons.sh"
}

for source in docs/lessons/*/*.c; do
    name=$(basename "$source" .c) why=
    "$BUILD/${source%.c}" "$picture.png" || why="$BUILD/${source%.c} failed"
    [ -n "$why" ] || "$BUILD/lom" compare --quiet "${source%.c}.png" "$picture.png" || why="${source%.c}.png is another picture"
    [ "$(wc -c <"${source%.c}.png")" -lt 60000 ] || why="${source%.c}.png has 60 000 bytes or more"
    "$BUILD/${source%.c}" 2>/dev/null && why="$BUILD/${source%.c} without a file is no failure"
    result "the_lesson_${name}_draws_its_picture" "$why"
done

source=docs/lessons/pipeline/pipeline.c why=
[ "$(wc -l <$source)" -lt 500 ] || why="$(wc -l <$source) lines"
strange=$(grep '^#include' $source | grep -vE '<(math|stdio|stdlib|string|lom/(base|image|geometry))\.h>')
[ -z "$strange" ] || why="it has $strange"
lanes=$(grep -nE 'lom_(float|int|mask|texture|draw|begin|sample|lod|device)|vector_size|_mm|__builtin' $source | grep -v lom_int_of)
[ -z "$lanes" ] || why="it uses what it should show: $lanes"
${CC:-cc} -std=c11 -Wall -Wextra -Wpedantic -Wshadow -Werror -Iinclude -fsyntax-only $source || why='it is no strict C11'
result the_pipeline_in_one_file_is_plain "$why"
