#!/bin/sh
# Proves the frame of the program: help of every command, messages and exit statuses of wrong command lines, and that
# output that cannot be delivered is an error.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh

overview() {
    exits 0 "$lom" --help && says "usage: lom COMMAND" && cp "$folder/out" "$folder/help" &&
        exits 0 "$lom" help && cmp "$folder/out" "$folder/help" &&
        exits 2 "$lom" && complains "usage: lom COMMAND" && [ ! -s "$folder/out" ]
}

commands() {
    "$lom" --help | sed -n '/^commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'
}

# --help of a command and `help COMMAND` are one text on stdout, with the usage and every option.
help_of_each() {
    [ "$(commands | wc -l)" -ge 4 ] || return 1
    for name in $(commands); do
        exits 0 "$lom" "$name" --help && says "usage: lom $name" && says "--help" && [ ! -s "$folder/err" ] || return 1
        cp "$folder/out" "$folder/help"
        exits 0 "$lom" help "$name" && cmp "$folder/out" "$folder/help" || return 1
        awk -v n="$name" 'length($0) > 120 { print n ": a line of " length($0) " letters"; bad = 1 } END { exit bad }' \
            "$folder/help" || return 1
    done
}

unknown_names() {
    exits 2 "$lom" comprae && complains 'did you mean "compare"' && [ ! -s "$folder/out" ] &&
        exits 2 "$lom" help versoin && complains 'did you mean "version"' &&
        exits 2 "$lom" qqqqqqqq && complains "lom --help" &&
        exits 2 "$lom" compare a b --max-flop 1 && complains 'did you mean "--max-flip"' &&
        exits 2 "$lom" compare a b --max-flop=1 && complains 'did you mean "--max-flip"' &&
        exits 2 "$lom" compare a b -x && complains 'unknown option "-x"' &&
        exits 2 "$lom" version --jsn && complains 'did you mean "--json"'
}

# Each line: what stderr must say | arguments.
wrong_values() {
    while IFS='|' read -r text arguments; do
        # shellcheck disable=SC2086
        exits 2 "$lom" $arguments && complains "$text" && [ ! -s "$folder/out" ] || return 1
        [ "$(wc -l <"$folder/err")" -eq 1 ] && grep -q '^lom: ' "$folder/err" || return 1
    done <<LINES
--max-flip takes a number|compare a b --max-flip no
--max-flip takes a number|compare a b --max-flip=
--max-flip takes a number|compare a b --max-flip 0.1x
--max-flip takes a number|compare a b --max-flip nan
--max-flip takes a number|compare a b --max-flip 0,5
from 0 to 1|compare a b --max-flip 1.5
from 0 to 1|compare a b --max-flip -0.5
whole numbers|compare a b --max-diff-pixels 1.5
whole numbers|compare a b --max-diff-pixels 99999999999999999999
must be from 0|compare a b --max-diff-pixels -1
needs a value|compare a b --max-flip
needs a value|compare a b --max-flip --json
needs a value|render a.toml --stats --hash
given twice|compare a b --max-flip 1 --max-flip 1
takes no value|compare a b --json=yes
too few arguments|compare a
by --any alone|compare a b c
too few arguments|compare
too few arguments|info
too many arguments|version now
--format takes png|convert a b --format gif
--bits takes 8|convert a b.png --bits 9
from 1 to 4|convert a b.png --channels 5
LINES
}

# Options may stand before and after the arguments; behind "--" there are none.
order_of_words() {
    printf 'P5 1 1 255\n7' >"$folder/--json"
    printf 'P5 1 1 255\n7' >"$folder/b.pgm"
    (cd "$folder" && "$lom" compare --max-flip=0.5 b.pgm --max-delta 2 b.pgm --quiet && "$lom" compare -q -- --json b.pgm)
}

# What stdout does not take is not delivered.
lost_output() {
    if [ -e /dev/full ]; then
        "$lom" --help >/dev/full 2>"$folder/err"
        [ $? -eq 2 ] && complains "standard output" || return 1
    fi
    "$lom" version >&- 2>"$folder/err"
    [ $? -eq 2 ] && complains "standard output"
}

# A reader that is gone before anything is written.
broken_pipe() {
    mkfifo "$folder/pipe" || return 1
    (
        exec 3<"$folder/pipe"
        exec 3<&-
        touch "$folder/closed"
    ) &
    (
        exec 4>"$folder/pipe"
        until [ -e "$folder/closed" ]; do sleep 0.01; done
        "$lom" version >&4 2>"$folder/err"
        echo $? >"$folder/status"
    )
    wait
    [ "$(cat "$folder/status")" -eq 2 ] && complains "standard output"
}

version() {
    exits 0 "$lom" version && says "picture version" && says "contraction off" && says "denormals kept" &&
        exits 0 "$lom" --version && says "lom $(sed -n 's/^#define LOM_VERSION *"\(.*\)"/\1/p' include/lom/base.h)"
}

check overview overview
check help_of_each_command help_of_each
check unknown_names_get_suggestions unknown_names
check wrong_values_are_refused wrong_values
check options_anywhere_before_dashes order_of_words
check lost_output_is_an_error lost_output
check broken_pipe_is_an_error broken_pipe
# More --set than there is room for.
too_many_values() {
    values=
    for i in $(seq 1 257); do values="$values --set water.level=$i"; done
    # shellcheck disable=SC2086
    exits 2 "$lom" render a.toml --hash $values && complains "more than 256 times --set"
}

check version_and_float_rules version
check lists_of_values_are_bounded too_many_values
exit $failures
