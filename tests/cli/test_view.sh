#!/bin/sh
# Proves `lom view` from outside: a script gives the hash of `lom render` at the start and of the command that it prints
# after moves, without a window and in one of SDL's dummy driver; what a screenshot writes are the bytes of its command; bad
# scripts and options are refused; a program without SDL2, or whose library does not open, says so, and no other start looks
# for that library; docs/view.md has the keys and the script's lines as `--help` has them. Under Xvfb real keys and a real
# mouse move it. What is not installed is a SKIP.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
page=$PWD/docs/view.md
cd "$folder/scene" || exit 1

# Why there is no window; empty where there is one.
reason=$("$lom" view scene.toml --script none 2>&1 | grep -o 'built without SDL2\|opened by the library SDL2.*')

cat >"$folder/moves" <<END
0 hash
1 press w          # a sixtieth of a second later
7 release w
9 hash
9 command
10 drag 10 10 30 14
12 hash
12 command
13 size 37 23
14 key space
20 key space
22 hash
22 command
END

# The hashes that the commands of a script's answers draw are those that it told before them.
answers_are_drawn() { # FILE
    sed -n 's/^lom render/render/p' "$1" >"$folder/commands"
    grep -c . "$folder/commands" | grep -qx 3 || { echo "no three commands"; cat "$1"; return 1; }
    sed -n 's/  frame.*//p' "$1" | tail -n +2 >"$folder/told"
    while read -r command; do
        eval "\"\$lom\" $command --hash --quiet" | cut -d' ' -f1
    done <"$folder/commands" >"$folder/drawn"
    cmp "$folder/told" "$folder/drawn" || { paste "$folder/told" "$folder/drawn"; return 1; }
    [ "$(sort -u "$folder/drawn" | grep -c .)" -eq 3 ] || { echo "the moves change nothing"; return 1; }
    [ "$(head -n 1 "$1" | cut -d' ' -f1)" = "$("$lom" render scene.toml --hash --quiet | cut -d' ' -f1)" ]
}

without_a_window() {
    exits 0 "$lom" view scene.toml --script "$folder/moves" --no-window && cp "$folder/out" "$folder/headless" &&
        answers_are_drawn "$folder/headless" && cp scene.toml "it's a scene.toml" &&
        exits 0 "$lom" view "it's a scene.toml" --script "$folder/moves" --no-window && answers_are_drawn "$folder/out"
}

in_a_dummy_window() {
    exits 0 env SDL_VIDEODRIVER=dummy "$lom" view scene.toml --script "$folder/moves" --times &&
        cmp "$folder/out" "$folder/headless" && complains "pictures drawn in" &&
        (export SDL_VIDEODRIVER=dummy && recorded --times)
}

recorded() {
    printf '0 press e\n30 release e\n40 hash\n' >"$folder/up"
    exits 0 "$lom" view scene.toml --script "$folder/up" ${1:---no-window} && says "a54799e5ee149d83"
}

screenshot() {
    printf '3 key p\n4 key c\n5 key p\n5 message\n' | exits 0 "$lom" view scene.toml --script - --no-window || return 1
    [ "$(grep -c '^lom render' "$folder/out")" -eq 2 ] && says "written: scene-2.png" || { cat "$folder/out"; return 1; }
    for n in 1 2; do
        cp scene-$n.png shot.png
        command=$(sed -n "s/^lom \(render .*scene-$n.png\)$/\1/p" "$folder/out")
        eval "\"\$lom\" $command --quiet" && cmp shot.png scene-$n.png || return 1
    done
}

# Of a scene with deep pixels 8 bits are shown, and its command says so.
deep_screenshot() {
    sed 's/^width = 48/format = "rgb16"\nwidth = 48/' scene.toml >deep.toml
    printf '1 key p\n1 message\n' | exits 0 "$lom" view deep.toml --script - --no-window && says 'deep-1.png' || return 1
    cp deep-1.png shot.png
    command=$(sed -n 's/^lom \(render .*deep-1.png\)$/\1/p' "$folder/out")
    eval "\"\$lom\" $command --quiet" && cmp shot.png deep-1.png
}

refuses() { # TEXT COMMAND...: exit 2 with that text and nothing written
    text=$1
    shift
    exits 2 "$@" && complains "$text" && [ ! -s "$folder/out" ]
}

script_is() { # TEXT COMPLAINT
    printf '%b' "$1" >"$folder/bad"
    refuses "bad:$2" "$lom" view scene.toml --no-window --script "$folder/bad"
}

# Without text the window is the picture; what is clicked is explained; a slow picture that moves is smaller.
what_a_window_shows() {
    printf '0 key h\n0 window shown.png\n1 wheel 2\n3 key v\n3 window pass.png\n4 key escape\n5 click 24 16\n5 message\n6 cost 100\n6 press a\n8 hash\n8 window moving.png\n' >"$folder/show"
    exits 0 "$lom" view scene.toml --script "$folder/show" --no-window || return 1
    says '24,16: ' && says '24x16 moving' && says 'wrote this' || return 1
    "$lom" render scene.toml -o right.png --quiet && "$lom" compare shown.png right.png && [ -s pass.png ] &&
        [ -s moving.png ] && ! "$lom" compare shown.png moving.png
}

bad_scripts() {
    script_is '0 hash\nhash 1\n' '2: a line begins' && script_is '0 jump\n' '1: there is no such command' &&
        script_is '3 hash\n2 hash\n' '2: its frame comes before' && script_is '0 press ctrl\n' '1: there is no such key' &&
        script_is '0 click 3\n' '1: the command takes another' && script_is '0 size 3 x\n' '1: an integer is missing' &&
        script_is '# nothing\n\n0 hash\n0 hash and\n' '4: the command takes another' &&
        script_is '-1 hash\n' '1: a line begins'
}

bad_options() {
    printf '0 hash\n1 size 0 5\n' >"$folder/size_script"
    exits 2 "$lom" view scene.toml --no-window --script "$folder/size_script" && complains 'from 1x1' &&
    refuses 'wants a --script' "$lom" view scene.toml --no-window && refuses 'no --crop' "$lom" view scene.toml --crop 0,0,8,8 &&
        refuses 'standard input' "$lom" view - --no-window --script "$folder/moves" &&
        refuses 'none.toml' "$lom" view none.toml --no-window --script "$folder/moves"
}

says_that_it_has_no_window() {
    refuses 'built without SDL2' "$lom" view scene.toml
}

# A program that is linked with a library does not start where that is an empty file.
library_is_opened_for_a_window() {
    mkdir -p "$folder/empty" && touch "$folder/empty/libSDL2-2.0.so.0" "$folder/empty/libSDL2.so" || return 1
    ! ldd "$lom" 2>&1 | grep -i sdl || return 1
    (LD_LIBRARY_PATH=$folder/empty
    export LD_LIBRARY_PATH
    exits 0 "$lom" version && recorded && refuses 'opened by the library SDL2' "$lom" view scene.toml &&
        complains "$folder/empty/libSDL2-2.0.so.0" && complains '`lom view SCENE --script FILE --no-window` works')
}

# What --help lists stands in the page, row by row.
page_has_the_keys() {
    "$lom" view --help | sed -n '/^keys and mouse:/,$p' | grep '^  ' | sed 's/^  //; s/   */|/' >"$folder/rows"
    [ "$(grep -c . "$folder/rows")" -gt 35 ] || { echo "no rows"; return 1; }
    while IFS='|' read -r name text; do
        name=${name%% } # a name that fills its column
        grep -qF -- "| $name | $text |" "$page" || { echo "docs/view.md lacks: | $name | $text |"; return 1; }
    done <"$folder/rows"
}

# ---- a real window ----

# Waits until what the server shows has another checksum than $1, and stays so for a while; prints it.
picture_other_than() {
    tries=0 same=0 last=
    while [ $tries -lt 100 ]; do
        sleep 0.1
        now=$(import -window root ppm:- 2>/dev/null | cksum)
        if [ "$now" = "$last" ] && [ "$now" != "$1" ]; then same=$((same + 1)); else same=0; fi
        [ $same -ge 3 ] && { echo "$now"; return 0; }
        last=$now tries=$((tries + 1))
    done
    echo "no other picture" >&2
    return 1
}

real_window() {
    "$lom" view scene.toml --size 320x200 --times >"$folder/view.out" 2>"$folder/view.err" &
    viewer=$!
    start=$(picture_other_than "$black") || return 1
    xdotool keydown w && sleep 0.4 && xdotool keyup w || return 1
    ahead=$(picture_other_than "$start") || return 1
    xdotool mousemove 200 150 mousedown 1 mousemove 230 150 mousemove 260 160 mouseup 1 || return 1
    turned=$(picture_other_than "$ahead") || return 1
    xdotool mousemove 160 120 click 1 || return 1
    explained=$(picture_other_than "$turned") || return 1
    grep -q 'wrote this' "$folder/view.out" || { echo "no explanation"; return 1; }
    xdotool key m Down Right Down || return 1
    menu=$(picture_other_than "$explained") || return 1
    sed 's/0, 2, 5/0, 2, 6/' scene.toml >new.toml && mv new.toml scene.toml
    xdotool key Escape Escape BackSpace || return 1
    again=$(picture_other_than "$menu") || return 1
    [ "$again" != "$start" ] || { echo "the file's change is not shown"; return 1; }
    xdotool windowsize "$(xdotool search --onlyvisible --name scene.toml)" 240 210 || return 1
    picture_other_than "$again" >"$folder/size" || return 1
    xdotool key Escape || return 1
    wait $viewer && grep -q 'pictures drawn in' "$folder/view.err"
}

check without_a_window without_a_window
check a_recorded_flight recorded
check a_screenshot_is_the_picture_of_its_command screenshot
check a_screenshot_of_deep_pixels deep_screenshot
check what_a_window_shows what_a_window_shows
check bad_scripts_are_refused bad_scripts
check bad_options_are_refused bad_options
check the_page_has_the_keys page_has_the_keys
no_display() {
    refuses 'no window can be opened' env -u DISPLAY SDL_VIDEODRIVER=x11 "$lom" view scene.toml
}

case $reason in
built*) check says_that_it_has_no_window says_that_it_has_no_window ;;
*) check the_library_is_opened_for_a_window library_is_opened_for_a_window ;;
esac
if [ -n "$reason" ]; then
    echo "SKIP view in a window: $reason"
    exit $failures
fi
check no_display_is_said no_display
check in_a_dummy_window in_a_dummy_window
if ! command -v Xvfb >/dev/null || ! command -v xdotool >/dev/null || ! command -v import >/dev/null; then
    echo "SKIP view under Xvfb: wants Xvfb, xdotool and ImageMagick's import"
    exit $failures
fi
# Pixels of two bytes are converted.
shallow_window() {
    "$lom" view scene.toml --size 200x120 >"$folder/view.out" 2>"$folder/view.err" &
    viewer=$!
    picture_other_than "$black" >"$folder/start" && xdotool click 4 && picture_other_than "$(cat "$folder/start")" &&
        xdotool key Escape && wait $viewer
}

server=
viewer=
trap 'kill $server $viewer 2>/dev/null; rm -rf "$folder"' EXIT

# on_a_screen BITS CHECK: in a server with so many bits a pixel.
on_a_screen() {
    : >"$folder/display"
    Xvfb -displayfd 3 -screen 0 "400x300x$1" 3>"$folder/display" 2>"$folder/xvfb.log" &
    server=$!
    tries=0
    while [ ! -s "$folder/display" ] && [ $tries -lt 50 ]; do sleep 0.1; tries=$((tries + 1)); done
    [ -s "$folder/display" ] || { echo "SKIP $2: no X server starts here"; return; }
    DISPLAY=:$(cat "$folder/display")
    export DISPLAY
    black=$(import -window root ppm:- | cksum)
    check "$2" "$2"
    kill "$server"
    wait "$server" 2>/dev/null
}

on_a_screen 24 real_window
on_a_screen 16 shallow_window
exit $failures
