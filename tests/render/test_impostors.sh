#!/bin/sh
# Proves what a run of frames makes of clouds on plates: frame N of a run is the same bytes over lanes, threads, tiles and
# runs, a crop is a cut-out of it, a frame alone draws every cloud afresh and says so, plates are shown again inside the
# bound, and without impostors any frame alone is that of a run.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
cat >"$folder/clouds.toml" <<TOML
[output]
width = 128
height = 72
fps = 10
[camera]
near = 0.5
field_of_view = 60
[[camera.key]]
time = 0
position = [0, 600, 4200]
target = [0, 700, 0]
[[camera.key]]
time = 2
position = [900, 620, 2300]
target = [0, 700, 0]
[water]
size = [9000, 9000]
[quality]
water = "planar"
impostors = "bounded"
impostor.bound = 0.5
TOML
for i in 0 1 2 3 4; do
    cat >>"$folder/clouds.toml" <<TOML
[[cloud]]
kind = "hemisphere"
voxels = [20, 20, 20]
position = [$((i * 1700 - 3400)), $((500 + i % 2 * 100)), $((i % 3 * 1500 - 3000))]
seed = $i
TOML
done
scene=$folder/clouds.toml
run() { "$lom" render "$scene" --frames 0:12 --hash "$@"; }
# facts KEY: its value in each line of statistics
facts() { sed "s/.*\"$1\": \([0-9]*\).*/\1/" "$folder/stats"; }

same_everywhere() {
    run --threads 1 --lanes 4 >"$folder/first" || return 1
    for other in "--threads 2 --lanes 8" "--threads 3 --lanes 16" "--threads 5 --lanes 4"; do
        run $other >"$folder/next" && cmp "$folder/first" "$folder/next" || { echo "$other"; return 1; }
    done
}

crops() {
    "$lom" render "$scene" --frames 0:6 -o "$folder/whole%d.png" --quiet &&
        "$lom" render "$scene" --frames 0:6 --crop 30,10,60,40 -o "$folder/crop%d.png" --quiet || return 1
    for n in 0 3 6; do
        "$lom" convert "$folder/whole$n.png" "$folder/whole.ppm" && "$lom" convert "$folder/crop$n.png" "$folder/crop.ppm"
        tail -c 27648 "$folder/whole.ppm" | awk_cut >"$folder/a" && tail -c 7200 "$folder/crop.ppm" >"$folder/b"
        cmp "$folder/a" "$folder/b" || { echo "frame $n"; return 1; }
    done
}
# rows 10..49, columns 30..89 of 128 x 72 pixels of three bytes
awk_cut() { cat >"$folder/raw"; for y in $(seq 10 49); do dd if="$folder/raw" bs=1 skip=$(((y * 128 + 30) * 3)) count=180 2>/dev/null; done; }

alone_is_afresh() {
    exits 0 "$lom" plan "$scene" --frame 9 && says "no frame of a run before this one: each is drawn afresh" || return 1
    "$lom" render "$scene" --frame 9 --stats "$folder/stats" && [ "$(facts impostors_reused)" = 0 ] &&
        [ "$(facts impostors_refreshed)" -gt 0 ] || { cat "$folder/stats"; return 1; }
    run | sed -n 's/  frame 9$//p' >"$folder/run"
    "$lom" render "$scene" --frame 9 --hash | sed 's/  frame 9$//' >"$folder/alone"
    ! cmp -s "$folder/run" "$folder/alone" || { echo "nothing was reused in the run"; return 1; }
}

reuse() {
    run --stats "$folder/stats" >/dev/null
    shown=$(facts impostors_shown | awk '{ n += $1 } END { print n }')
    fresh=$(facts impostors_refreshed | awk '{ n += $1 } END { print n }')
    again=$(facts impostors_reused | awk '{ n += $1 } END { print n }')
    echo "$shown shown, $fresh made anew, $again shown again"
    [ "$((fresh + again))" -eq "$shown" ] && [ "$again" -gt "$fresh" ] && [ "$fresh" -gt 10 ]
}

still_camera() {
    sed '/camera.key/,/^target/d; s/^near = .*/near = 0.5\nposition = [0, 600, 4200]\ntarget = [0, 700, 0]/' "$scene" >"$folder/still.toml"
    "$lom" render "$folder/still.toml" --frames 0:3 --hash --stats "$folder/stats" >"$folder/still" || return 1
    [ "$(facts impostors_refreshed | tail -n 3 | sort -u)" = 0 ] && [ "$(sed 's/ .*//' "$folder/still" | sort -u | wc -l)" -eq 1 ]
}

off_is_any_frame_alone() {
    "$lom" render "$scene" --frames 6:7 --hash --set 'quality.impostors="off"' | tail -n 1 >"$folder/run"
    "$lom" render "$scene" --frame 7 --hash --set 'quality.impostors="off"' >"$folder/alone"
    cmp "$folder/run" "$folder/alone"
}

# A bound near 0 makes every plate anew: the run is then the frames alone.
no_tolerance() {
    "$lom" render "$scene" --frames 3:5 --hash --set quality.impostor.bound=1e-9 | tail -n 1 >"$folder/run"
    "$lom" render "$scene" --frame 5 --hash --set quality.impostor.bound=1e-9 >"$folder/alone"
    cmp "$folder/run" "$folder/alone"
}

near_the_marched() {
    "$lom" render "$scene" --frames 0:12 -o "$folder/plate%d.png" --quiet
    "$lom" render "$scene" --frame 12 -o "$folder/marched.png" --set 'quality.impostors="off"' --quiet
    exits 0 "$lom" compare "$folder/marched.png" "$folder/plate12.png" --min-psnr 36
}

# The rule of the reference work: clouds whose plates are small are left out, unless plates are always the largest; and
# what a still camera sees is kept.
rule_of_the_reference() {
    for dials in 'lod=true --set quality.impostor.smallest=0' 'lod=true --set quality.impostor.smallest=40' \
        'lod=false --set quality.impostor.smallest=40'; do
        # shellcheck disable=SC2086
        "$lom" render "$scene" --frames 0:1 --hash --stats "$folder/stats" --set quality.impostors=reference \
            --set quality.impostor.largest_reference=48 --set quality.impostor.$dials >"$folder/hash" || return 1
        [ "$(($(facts impostors_shown | head -n 1) + $(facts impostors_skipped | head -n 1)))" -eq 10 ] || return 1
        echo "$(facts impostors_skipped | head -n 1) $(head -n 1 "$folder/hash" | cut -d' ' -f1)"
    done >"$folder/rule"
    cat "$folder/rule"
    [ "$(cut -d' ' -f2 "$folder/rule" | sort -u | wc -l)" -eq 3 ] &&
        awk 'NR == 2 ? $1 == 0 : $1 != 0 { bad = 1 } END { exit bad }' "$folder/rule" || return 1
    "$lom" render "$folder/still.toml" --frames 0:3 --hash --stats "$folder/stats" --set quality.impostors=reference >"$folder/still" &&
        [ "$(facts impostors_refreshed | tail -n 3 | sort -u)" = 0 ] && [ "$(sed 's/ .*//' "$folder/still" | sort -u | wc -l)" -eq 1 ]
}

check impostors_same_over_lanes_threads_and_runs same_everywhere
check impostors_crop_is_a_cut_out crops
check impostors_alone_are_afresh alone_is_afresh
check impostors_are_reused_inside_the_bound reuse
check impostors_of_a_still_camera_are_kept still_camera
check impostors_by_the_rule_of_the_reference rule_of_the_reference
check impostors_off_is_any_frame_alone off_is_any_frame_alone
check impostors_without_tolerance_are_marched no_tolerance
check impostors_are_near_what_is_marched near_the_marched
exit $failures
