#!/bin/sh
# Proves that `lom steps` writes a numbered picture of each stage and a page of them, that its last picture is that of
# `lom render`, that the page shows every step in a browser from file:// without a network, and that bad input is refused
# with one sentence and leaves nothing behind.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
page=$PWD/tests/inspect/steps_page.js
. tests/cli/scene.sh
cd "$folder/scene" || exit 1

refuses() {
    refuses_text=$1
    shift
    rm -rf out
    exits 2 "$lom" steps "$@" && complains "$refuses_text" && [ ! -s "$folder/out" ] && [ ! -e out ] &&
        [ "$(wc -l <"$folder/err")" -eq 1 ]
}

bad_input() {
    sed '4s/.*/[camrea]/; /^position/d' scene.toml >bad.toml
    refuses '-o DIR' scene.toml && refuses 'missing.toml' missing.toml -o out &&
        refuses 'bad.toml:4:2: unknown key' bad.toml -o out && refuses 'no --crop' scene.toml -o out --crop 0,0,4,4 &&
        refuses 'draws no pass "mirror"' scene.toml -o out --pass mirror && complains 'reflection' &&
        refuses 'traced by the reference' scene.toml -o out --set quality.water=reference &&
        refuses 'larger than the limit' scene.toml -o out --size 32768x32768 && : >file &&
        exits 2 "$lom" steps scene.toml --size 16x9 -o file/out && complains 'file/out'
}

# Numbered without a gap, all pictures named by the page; the last one is what render writes.
whole_list() {
    exits 0 "$lom" steps scene.toml --size 96x64 -o out && says 'out/index.html' || return 1
    number=0
    for file in out/*.png; do
        number=$((number + 1))
        case $file in out/$(printf %02d $number)-*.png) ;; *) echo "$file is not number $number" && return 1 ;; esac
        grep -q "\"file\": \"${file#out/}\"" out/index.html || return 1
    done
    for name in mesh vertex window cull bins coverage coverage-detail depth shaded pass-scene final; do
        [ "$(find out -name "[0-9]*-$name.png" | wc -l)" -eq 1 ] || { echo "no $name" && return 1; }
    done
    "$lom" render scene.toml --size 96x64 -o final.png --quiet && cmp final.png out/*-final.png &&
        grep -q "^$number pictures" "$folder/out" && ! grep -qE 'https?://|<link|@import' out/index.html &&
        [ "$(grep -c '</script>' out/index.html)" -eq 2 ]
}

# With smooth edges too: the pass that smooths them is one of the frame's.
smooth_edges() {
    exits 0 "$lom" steps scene.toml --size 48x32 --set output.edges=smooth -o smooth && [ -e smooth/*-pass-edges.png ] &&
        "$lom" render scene.toml --size 48x32 --set output.edges=smooth -o smooth.png --quiet && cmp smooth.png smooth/*-final.png
}

other_passes() {
    exits 0 "$lom" steps scene.toml --size 48x32 --frame 2 --threads 2 --pass water -o water && says 'pass "water"' &&
        [ -e water/*-blend-after.png ] || return 1
    exits 0 "$lom" steps scene.toml --size 48x32 --pass reflection -o mirror && [ -e mirror/*-pass-reflection.png ]
}

in_a_browser() {
    for step in 1 4; do
        timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$folder/profile" \
            --host-resolver-rules='MAP * ~NOTFOUND' --virtual-time-budget=4000 --dump-dom \
            "file://$PWD/out/index.html#$step" >"$folder/dom" 2>"$folder/log"
        grep -q "<title>lom steps: $step / $number " "$folder/dom" || { tail -3 "$folder/log" && return 1; }
        [ "$(grep -o '<option' "$folder/dom" | wc -l)" -eq "$number" ] || return 1
        grep -q "id=\"picture\" alt=\"[^\"]*\" src=\"0$step-" "$folder/dom" && grep -q 'image-rendering' "$folder/dom" || return 1
    done
}

page_runs() {
    node "$page" out/index.html >"$folder/steps" && cat "$folder/steps" && grep -q "^steps: $number$" "$folder/steps"
}

check bad_input_is_refused_and_leaves_nothing bad_input
check pictures_are_numbered_and_end_with_that_of_render whole_list
check the_last_picture_with_smooth_edges_is_the_rendered_one smooth_edges
check other_passes_have_their_stages other_passes
number=$(find out -name '*.png' | wc -l)
if command -v node >/dev/null; then
    check every_step_of_the_page_can_be_taken page_runs
else
    echo "SKIP every_step_of_the_page_can_be_taken: needs node"
fi
browser=$(command -v chromium || command -v chromium-browser)
if [ -n "$browser" ]; then
    check a_browser_shows_the_steps_without_a_network in_a_browser
else
    echo "SKIP a_browser_shows_the_steps_without_a_network: chromium is not installed"
fi
exit $failures
