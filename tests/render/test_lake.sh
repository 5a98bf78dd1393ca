#!/bin/sh
# Proves on the demo scene, small: one hash for every lane width and thread count; a crop is the cut-out of the whole; a
# frame alone is the frame of a run; water out of view costs no pass; cameras on the
# water's plane draw. That each step of the water shows is proved by tests/golden.
lom=${BUILD:-build}/lom
scene=assets/scenes/lake.toml
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
verdict() { # name, why (empty: passed)
    if [ -z "$2" ]; then echo "PASS $1"; else echo "FAIL $1: $2; repeat: tests/render/test_lake.sh"; fi
}
hash() { "$lom" render $scene --size 160x90 --hash "$@" | cut -d' ' -f1; }

whole=$(hash)
why=
for run in '4 1' '4 5' '8 2' '8 3' '16 1' '16 8'; do
    lanes=${run% *} threads=${run#* }
    other=$(hash --lanes "$lanes" --threads "$threads")
    [ "$other" = "$whole" ] || why="$lanes lanes on $threads threads give $other, not $whole"
done
[ -n "$whole" ] || why='no hash'
verdict one_hash_for_lanes_and_threads "$why"

"$lom" render $scene --size 160x90 -o "$folder/whole.ppm"
why=
for crop in '0,0,160,90' '33,41,70,49' '101,57,1,1' '7,60,151,30'; do
    "$lom" render $scene --size 160x90 --crop $crop -o "$folder/crop.ppm" || why="crop $crop fails"
    x=${crop%%,*} rest=${crop#*,}
    y=${rest%%,*} rest=${rest#*,}
    width=${rest%,*} height=${rest#*,}
    printf 'P6\n%d %d\n255\n' "$width" "$height" >"$folder/cut.ppm"
    row=0
    while [ $row -lt "$height" ]; do # the header of the whole is "P6\n160 90\n255\n": 14 bytes
        tail -c +$((15 + ((y + row) * 160 + x) * 3)) "$folder/whole.ppm" | head -c $((width * 3)) >>"$folder/cut.ppm"
        row=$((row + 1))
    done
    cmp -s "$folder/crop.ppm" "$folder/cut.ppm" || why="crop $crop is not the cut-out"
done
verdict crop_is_the_cut_out "$why"

alone=$(hash --frame 3)
run=$("$lom" render $scene --size 160x90 --frames 2:3 --hash | sed -n 's/  frame 3$//p')
[ "$alone" = "$run" ] && [ "$alone" != "$whole" ] && why= || why="$alone alone, $run in a run, $whole at first"
verdict a_frame_alone_is_the_frame_of_a_run "$why"

away=$("$lom" plan $scene --size 160x90 --set camera.pitch=60)
case $away in *'*  reflection'* | *'*  water'*) why=$away ;; *'reflection'*'left out'*) why= ;; *) why=$away ;; esac
verdict no_water_in_view_costs_no_pass "$why"

# T19, T20: where the plane is parallel to the line of sight, cuts the camera, or lies above it, and where the mirrored
# camera stands inside the terrain. --check refuses NaN and a picture of one colour.
why=
for camera in '[-14,0,458]|0' '[-14,1e-9,458]|-10' '[-14,-2,458]|10' '[-55,3,415]|-8'; do
    set -- --check --set "camera.position=${camera%|*}" --set "camera.pitch=${camera#*|}"
    narrow=$(hash --lanes 4 "$@" 2>&1) || why="$camera: $narrow"
    [ "$narrow" = "$(hash --lanes 16 --threads 3 "$@" 2>&1)" ] || why="$camera: two hashes"
    case $narrow in *lom*) why="$camera: $narrow" ;; esac
done
verdict cameras_on_the_plane_and_mirrored_into_the_ground "$why"
