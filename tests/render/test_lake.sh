#!/bin/sh
# Proves on the demo scene, small: one hash for every lane width and thread count; a crop is the cut-out of the whole; a
# frame alone is the frame of a run; a crop leaves out what it does not show; water out of view costs no pass; cameras on the
# water's plane draw. That each step of the water shows is proved by tests/golden.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/lake.toml
draw() { "$lom" render $scene --size 160x90 "$@"; }

one_hash one_hash_for_lanes_and_threads
crops crop_is_the_cut_out
frame_alone a_frame_alone_is_the_frame_of_a_run

[ "$(hash --set quality.scissor=false)" = "$(hash)" ] && why= || why='the scissor changes the picture'
verdict the_scissor_changes_no_byte "$why"

triangles() { draw --stats - --hash "$@" | sed -n 's/.*"triangles": \([0-9]*\).*/\1/p'; }
all=$(triangles) part=$(triangles --crop 0,60,8,8)
[ "$part" -gt 0 ] && [ $((part * 2)) -lt "$all" ] && why= || why="$part triangles for 8x8 pixels, $all for the frame"
verdict a_crop_submits_what_it_shows "$why"

away=$("$lom" plan $scene --size 160x90 --set camera.pitch=60 | sed "/^dials/,\$d")
case $away in *'*  reflection'* | *'*  water'*) why=$away ;; *'reflection'*'left out'*) why= ;; *) why=$away ;; esac
verdict no_water_in_view_costs_no_pass "$why"

# T19, T20: where the plane is parallel to the line of sight, cuts the camera, or lies above it, and where the mirrored
# camera stands inside the terrain. --check refuses NaN and a picture of one colour.
why=
for camera in '[-14,0,458]|0' '[-14,1e-9,458]|-10' '[-14,-2,458]|10' '[-55,3,415]|-8'; do
    set -- --check --set "camera.position=${camera%|*}" --set "camera.pitch=${camera#*|}"
    narrow=$(hash --lanes 4 "$@" 2>&1) || why="$camera: $narrow"
    [ "$narrow" = "$(hash --lanes $widest --threads 3 "$@" 2>&1)" ] || why="$camera: two hashes"
    case $narrow in *lom*) why="$camera: $narrow" ;; esac
done
verdict cameras_on_the_plane_and_mirrored_into_the_ground "$why"

passes() { draw --stats - --hash "$@" | sed -n 's/.*"ran": "\([^"]*\)".*/\1/p'; }
why=
case $(passes) in *'near shadow far shadow scene'*) ;; *) why='the maps of what entities shadow are not made' ;; esac
case $(passes --frames 0:1 | tail -n 1) in *'near shadow'*) why='what has not moved is drawn again' ;; esac
case $(passes --set quality.entity_shadows=0) in *'near shadow'*) why='shadows that are off are drawn' ;; esac
[ "$(hash --set quality.entity_shadows=0)" != "$(hash)" ] || why='entities have no shadow'
[ "$(hash --frame 3)" = "$(hash --frames 2:3 | tail -n 1)" ] || why='a kept map gives another picture'
verdict entities_shadow_what_is_seen "$why"
