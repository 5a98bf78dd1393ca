#!/bin/sh
# Proves that what is written is old or new and never half (killed at any moment, on a full disk, over a size limit), and
# that everything the program writes goes one road: special files are written and stay, links are followed, modes are
# kept, any name that the system takes is taken, a signal leaves nothing, and every refusal has its reason.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
cd "$folder/scene" || exit 1
hash_of() { "$lom" info "$1" | sed 's/.*hash //'; }
"$lom" render scene.toml --size 600x400 -o new.png
"$lom" render scene.toml --size 30x20 -o old.png
new=$(hash_of new.png) old=$(hash_of old.png)

a_kill_leaves_the_old_or_the_new_file() {
    killed=0
    for delay in 0 0.002 0.004 0.006 0.008 0.01 0.012 0.014 0.016 0.02 0.024 0.03 0.04 0.05; do
        cp old.png out.png
        "$lom" render scene.toml --size 600x400 -o out.png --quiet &
        job=$!
        sleep $delay
        kill -9 $job 2>/dev/null
        wait $job 2>/dev/null && status=0 || status=$?
        left=$(hash_of out.png)
        [ $status -ne 0 ] && killed=$((killed + 1))
        if [ "$left" != "$new" ] && { [ "$left" != "$old" ] || [ $status -eq 0 ]; }; then
            echo "after $delay s, status $status: $left is neither $old nor $new"
            return 1
        fi
    done
    rm -f .lom-*
    [ $killed -gt 0 ]
}

a_full_disk_is_an_error() {
    [ -e /dev/full ] || return 0
    exits 2 "$lom" render scene.toml -o /dev/full --format png && complains "/dev/full" &&
        exits 2 "$lom" convert old.png /dev/full --format ppm && complains "/dev/full" || return 1
    for command in "render scene.toml -o - --format png" "render scene.toml --hash" "render scene.toml --stats -" \
        "info old.png" "plan scene.toml" "selftest" "convert old.png - --format ppm"; do
        # shellcheck disable=SC2086
        "$lom" $command >/dev/full 2>"$folder/err"
        [ $? -eq 2 ] && [ -s "$folder/err" ] || { echo "lost: $command"; return 1; }
    done
    exits 2 "$lom" render scene.toml -o out.png --stats /dev/full && complains "/dev/full"
}

a_size_limit_keeps_the_old_file() {
    cp old.png out.png
    (ulimit -f 8 && exec "$lom" render scene.toml --size 600x400 -o out.png --quiet) 2>"$folder/err"
    [ $? -eq 2 ] && complains "out.png" && [ "$(hash_of out.png)" = "$old" ] && [ -z "$(find . -name '.lom-*')" ]
}

# Every kind of output: status | ending | arguments of lom, with OUT for the path. The same bytes each time, but for
# statistics.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >triangle.obj
"$lom" render scene.toml --size 30x20 --set water.level=-1 -o other.png
cat >outputs <<LINES
0|png|render scene.toml --quiet -o OUT
0|y4m|render scene.toml --quiet --frames 0:1 -o OUT
0|json|render scene.toml --quiet --stats OUT
0|ppm|convert old.png OUT
0|nrrd|convert old.png OUT
0|obj|convert triangle.obj OUT
0|png|make flow-map --size 128 -o OUT
0|nrrd|make cloud puffs --voxels 8x8x8 -o OUT
0|md|make scene-docs -o OUT
0|md|make dial-docs -o OUT
1|png|compare --quiet old.png other.png --diff OUT
0|png|bench fill --size 32x18 --frames 1 --warm-up 0 -o OUT
LINES

# output_to PATH: runs $arguments with PATH for OUT; its status is to be $1's.
output_to() {
    # shellcheck disable=SC2046,SC2086
    "$lom" $(echo "$arguments" | sed "s|OUT|$1|") >"$folder/out" 2>"$folder/err"
    output_status=$?
}

same_as_plain() {
    case $ending in json) [ -s "$1" ] ;; *) cmp plain "$1" ;; esac
}

# each_output TEST: calls TEST for every row, with $ending, $arguments and the file plain that OUT is to become.
each_output() {
    while IFS='|' read -r expected ending arguments; do
        rm -rf plain* try && mkdir try
        output_to "plain.$ending"
        mv "plain.$ending" plain
        if [ "$output_status" -ne "$expected" ] || ! "$1"; then
            echo "in: $arguments" && cat "$folder/err"
            return 1
        fi
        [ -z "$(find . -name '.lom-*')" ] || { echo "left: $(find . -name '.lom-*')"; return 1; }
    done <outputs
}

to_special_files() {
    mkfifo "try/fifo.$ending"
    cat "try/fifo.$ending" >try/got &
    reader=$!
    output_to "try/fifo.$ending"
    wait $reader
    [ "$output_status" -eq "$expected" ] && [ -p "try/fifo.$ending" ] && same_as_plain try/got || return 1
    if mknod "try/full.$ending" c 1 7 2>/dev/null && ! echo x 2>/dev/null >"try/full.$ending"; then
        output_to "try/full.$ending"
        [ "$output_status" -eq 2 ] && [ -c "try/full.$ending" ] && complains "could not write: No space left on device" || return 1
    fi
}

to_links() {
    mkdir try/art && ln -s art/o "try/link.$ending" && ln -s absent/o "try/lost.$ending"
    output_to "try/link.$ending"
    [ "$output_status" -eq "$expected" ] && [ -L "try/link.$ending" ] && same_as_plain try/art/o || return 1
    chmod 640 try/art/o
    output_to "try/link.$ending"
    [ "$output_status" -eq "$expected" ] && [ -L "try/link.$ending" ] && same_as_plain try/art/o || return 1
    [ "$(stat -c %a try/art/o)" = 640 ] || { echo "another mode"; return 1; }
    output_to "try/lost.$ending"
    [ "$output_status" -eq 2 ] && complains "No such file or directory"
}

to_strange_names() {
    long=$(printf 'c%.0s' $(seq $((254 - ${#ending}))))
    for name in '100%' "$long" 'a b' '%s%n' 'Fünf' '.'; do
        for place in try 'try/feature%2Fwater' 'try/a%04db%s' 'try/%%'; do
            mkdir -p "$place"
            case $name in *' '*) continue ;; esac # output_to splits at blanks
            output_to "$place/$name.$ending"
            [ "$output_status" -eq "$expected" ] && same_as_plain "$place/$name.$ending" ||
                { echo "name: $place/$name.$ending"; return 1; }
        done
    done
    output_to "try/c$long.$ending"
    [ "$output_status" -eq 2 ] && complains "File name too long"
}

frames_are_numbered_in_the_file_name_alone() {
    rm -rf try && mkdir -p 'try/f%02d'
    exits 0 "$lom" render scene.toml --frames 8:9 -o 'try/f%02d/100%%_%03d%s.png' && cd 'try/f%02d' || return 1
    [ "$(echo *)" = '100%_008%s.png 100%_009%s.png' ] || { ls; return 1; }
    cd ../..
    exits 2 "$lom" render scene.toml -o 'try/%d_%d.png' && complains "once" &&
        exits 2 "$lom" render scene.toml --frames 0:1 -o 'try/%%04d.png' && complains "several frames" &&
        exits 0 "$lom" make sky-box --size 8 -o 'try/f%02d/sky%d_%s.png' && [ -s 'try/f%02d/sky%d_front.png' ] &&
        exits 2 "$lom" make sky-box --size 8 -o 'try/%s_%s.png'
}

# Endings in capitals and names that are nothing else.
endings() {
    rm -rf try && mkdir try
    for name in UP.Y4M .y4m UP.PNG .png; do
        exits 0 "$lom" render scene.toml -o try/$name && [ -s try/$name ] || return 1
    done
    cmp try/UP.Y4M try/.y4m && [ "$(head -c 9 try/.y4m)" = YUV4MPEG2 ]
}

one_name_for_two_files() {
    exits 2 "$lom" convert box.obj out.mtl --format obj && complains "out.mtl" && [ ! -e out.mtl ] &&
        exits 2 "$lom" convert box.obj OUT.MTL --format obj && [ ! -e OUT.MTL ] &&
        exits 2 "$lom" render scene.toml -o both.png --stats both.png && [ ! -e both.png ] &&
        exits 2 "$lom" render scene.toml -o - --stats - && [ ! -s "$folder/out" ] &&
        exits 2 "$lom" render scene.toml -o - --hash && [ ! -s "$folder/out" ] &&
        exits 0 "$lom" render scene.toml -o /dev/null --format png --stats /dev/null || return 1
    exits 0 "$lom" convert box.obj try.obj && [ -s try.mtl ] && grep -q 'mtllib try.mtl' try.obj || return 1
    mkdir taken.obj && exits 2 "$lom" convert box.obj taken.obj && [ ! -e taken.mtl ]
}

# Standard output, whatever it is, takes what a file takes; a frame and the text around it come in order.
standard_output() {
    exits 0 "$lom" render scene.toml --frames 0:1 -o plain.y4m || return 1
    "$lom" render scene.toml --frames 0:1 -o - --format y4m | cmp plain.y4m || return 1
    "$lom" render scene.toml --frames 0:1 -o /dev/stdout --format y4m | cmp plain.y4m || return 1
    echo before >log
    "$lom" render scene.toml --frames 0:1 -o /dev/stdout --format y4m >>log
    [ "$(head -n 1 log)" = before ] && tail -c +8 log | cmp plain.y4m || return 1
    "$lom" render scene.toml --frames 0:1 -o /dev/fd/3 --format y4m 3>third && cmp third plain.y4m || return 1
    "$lom" render scene.toml --frames 0:1 --hash --stats - | cut -c 1-8 | tr -d '0-9a-f{"' | tr '\n' ' ' >order
    [ "$(cat order)" = ' rm  rm ' ] || { cat order; return 1; }
    "$lom" render - --hash <scene.toml >piped && "$lom" render scene.toml --hash | cmp piped
}

# A reader that goes away early is an error with a reason, not a silent end.
a_reader_that_goes_away() {
    (exits 2 "$lom" render scene.toml --size 600x400 --frames 0:9 -o - --format y4m; cp "$folder/err" "$folder/gone"; cat "$folder/out") | head -c 1 >/dev/null
    mkfifo gone 2>/dev/null
    (head -c 1 gone >/dev/null) &
    exits 2 "$lom" render scene.toml --size 600x400 --frames 0:9 -o gone --format y4m && complains "gone: could not write: Broken pipe"
}

kinds_are_told_before_drawing() {
    exits 2 "$lom" render scene.toml --frames all -o a.mp4 && complains "y4m" && complains "ffmpeg -i - a.mp4" &&
        exits 2 "$lom" render box.obj -o out.png && complains "a mesh, no scene" &&
        exits 2 "$lom" render scene.toml --size 32768x32768 -o out.png && complains "limit of 2^31 bytes" &&
        complains "--crop" && exits 2 "$lom" render scene.toml -o out.pfm && complains "out.pfm" || return 1
    printf '\037\213\010\000' >ch2.nii.gz
    exits 2 "$lom" info ch2.nii.gz && complains "NIfTI" && exits 2 "$lom" convert ch2.nii.gz out.nrrd && complains "NRRD"
}

all_frames_and_a_hint() {
    sed 's/^height.*/&\nframes = 3/' scene.toml >moving.toml
    rm -rf try && mkdir try
    exits 0 "$lom" render moving.toml --frames all -o try/%d.png && [ "$(ls try | tr '\n' ' ')" = '0.png 1.png 2.png ' ] &&
        exits 0 "$lom" render moving.toml -o try/0.png && complains "--frames all" &&
        exits 0 "$lom" render moving.toml -o try/0.png --quiet && [ ! -s "$folder/err" ] &&
        exits 0 "$lom" render moving.toml --frame 0 -o try/0.png && [ ! -s "$folder/err" ] &&
        exits 2 "$lom" render moving.toml --frames some -o try/%d.png && complains "A:B|all"
}

# Each signal at moments all over a run: the program ends by it, the old file stays, nothing else is there. What the
# caller ignores stays ignored.
signals_leave_nothing() {
    rm -rf try && mkdir try && cp plain.y4m try/v.y4m
    python3 - "$lom" <<'END'
import os, signal, subprocess, sys, time
old = open("try/v.y4m", "rb").read()
command = [sys.argv[1], "render", "scene.toml", "--size", "200x120", "--frames", "0:3000", "-q", "-o"]
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGUSR1):
    for delay in (0.03, 0.1, 0.2):
        for name in ("v.y4m", "%d.png"):
            run = subprocess.Popen(command + ["try/" + name])
            time.sleep(delay)
            run.send_signal(number)
            assert run.wait() == -number, (number, run.returncode)
            left = [f for f in os.listdir("try") if f[0] == "."]
            assert left == [], (number, delay, left)
            assert open("try/v.y4m", "rb").read() == old, "the old file is gone"
            for f in os.listdir("try"):
                if f.endswith(".png"):
                    assert open("try/" + f, "rb").read().endswith(b"IEND\xaeB`\x82"), f
                    os.remove("try/" + f)
run = subprocess.Popen(command[:6] + ["0:20", "-q", "-o", "try/v.y4m"], preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
for i in range(5):
    time.sleep(0.01)
    run.send_signal(signal.SIGHUP)
assert run.wait() == 0, run.returncode
END
}

check every_output_goes_to_special_files each_output to_special_files
check every_output_follows_links_and_keeps_modes each_output to_links
check every_output_takes_every_name each_output to_strange_names
check frames_are_numbered_in_the_file_name_alone frames_are_numbered_in_the_file_name_alone
check endings_in_capitals_and_alone endings
check one_name_for_two_files_is_refused one_name_for_two_files
check standard_output_takes_everything standard_output
check a_reader_that_goes_away_is_an_error a_reader_that_goes_away
check what_cannot_be_written_is_refused_before_drawing kinds_are_told_before_drawing
check all_frames_and_a_hint all_frames_and_a_hint
if command -v python3 >/dev/null; then
    check signals_leave_nothing signals_leave_nothing
else
    echo "SKIP signals_leave_nothing: needs python3"
fi
check a_kill_leaves_the_old_or_the_new_file a_kill_leaves_the_old_or_the_new_file
check a_full_disk_is_an_error a_full_disk_is_an_error
check a_size_limit_keeps_the_old_file a_size_limit_keeps_the_old_file
exit $failures
