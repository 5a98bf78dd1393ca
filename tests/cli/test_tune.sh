#!/bin/sh
# Proves `lom tune`: its settings are those of --settings and keep the limit that was asked for, by lom's own comparison;
# the file is the same for other threads and lanes; --clock says so; a limit that nothing keeps is exit status 1 and no
# file; and bad input is refused with one sentence and writes nothing.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
cd "$folder/scene" || exit 1
"$lom" render scene.toml --size 32x18 --quiet --set quality.shading=flat -o flat.png
common='--size 32x18 --reference flat.png --dials shading,texture_filter,output.samples'

refuses() {
    refuses_text=$1
    shift
    rm -f out.toml
    exits 2 "$lom" tune "$@" && complains "$refuses_text" && [ ! -s "$folder/out" ] && [ ! -e out.toml ] &&
        [ "$(wc -l <"$folder/err")" -eq 1 ]
}

bad_input() {
    refuses '-o OVERLAY.toml' scene.toml --max-flip 0.1 && refuses 'takes one limit' scene.toml -o out.toml &&
        refuses 'takes one limit' scene.toml -o out.toml --max-flip 0.1 --budget 5 &&
        refuses 'no standard input' - --max-flip 0.1 -o out.toml &&
        refuses 'missing.toml' missing.toml --max-flip 0.1 -o out.toml &&
        refuses 'did you mean "shading"' scene.toml --max-flip 0.1 -o out.toml --dials shadin &&
        refuses 'max-flip' scene.toml --max-flip 2 -o out.toml && : >file &&
        refuses 'file/out.toml' scene.toml --max-flip 1 --size 32x18 --samples 1 --dials shading -o file/out.toml
}

# shellcheck disable=SC2086 # the options are words
keeps_the_limit() {
    exits 0 "$lom" tune scene.toml $common --max-flip 0 --threads 1 --lanes 4 -o one.toml &&
        exits 0 "$lom" tune scene.toml $common --max-flip 0 --threads 2 --lanes auto --quiet -o two.toml &&
        cmp one.toml two.toml && grep -q '^quality.shading = "flat"$' one.toml && grep -q '^# these: .*FLIP 0.00000' one.toml &&
        exits 0 "$lom" render scene.toml --size 32x18 --quiet --settings one.toml -o tuned.png &&
        exits 0 "$lom" compare --max-flip 0 flat.png tuned.png &&
        exits 0 "$lom" tune scene.toml $common --max-flip 0 --threads 1 -o - && cmp one.toml "$folder/out"
}

# shellcheck disable=SC2086
says_by_the_clock() {
    exits 0 "$lom" tune scene.toml $common --min-psnr 20 --clock --pairs 1 -o clock.toml && says 'by the clock' &&
        grep -q '^# these: .* ms, FLIP' clock.toml
}

# shellcheck disable=SC2086
nothing_keeps_it() {
    exits 1 "$lom" tune scene.toml $common --budget 1 -o never.toml && complains 'none keeps the limit' && [ ! -e never.toml ]
}

check bad_input_writes_nothing bad_input
check settings_keep_the_limit keeps_the_limit
check times_are_said_to_be_times says_by_the_clock
check what_nothing_keeps_is_said nothing_keeps_it
exit $failures
