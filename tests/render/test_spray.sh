#!/bin/sh
# Proves of spray before and behind a boulder, over water: one hash for every lane width and thread count; a crop is the
# cut-out of the whole; a frame alone is the frame of a run; the scissor changes no byte; of one worker all times
# are such in which one worker ran; emitters that show nothing leave the frame bit for bit, and the plan says why.
. "$(dirname "$0")/render.sh"
scene=$folder/spray.toml
cat >"$folder/still.toml" <<END
[camera]
position = [0, 3, 14]
target = [0, 3, 0]
[light]
azimuth = 200
elevation = 30
[haze]
density = [0.002, 0.002, 0.002]
color = [0.5, 0.6, 0.7]
[sky]
color = [0.25, 0.4, 0.6]
[[entity]]
mesh = "$PWD/assets/entities/boulder.obj"
scale = 2
[water]
size = [60, 60]
waves.kind = "gerstner"
waves.height = 0.2
[quality]
water = "displaced"
END
{
    cat "$folder/still.toml"
    cat <<END
[[spray]]
name = "fall"
count = 3000
from = [-3, 7, -1]
to = [3, 7, 0]
velocity = [0, 0, 1]
spread = 0.2
drag = 0.4
height = 7
size = [0.05, 0.3]
stretch = 0.08
[[spray]]
name = "mist"
count = 300
from = [-3, 0, 2]
to = [3, 0, 9]
velocity = [0, 2, 0]
spread = 1
drag = 3
wind = [1, 0.5, 1]
life = 4
size = [0.2, 1.5]
opacity = 0.05
soft = 1
END
} >"$scene"
draw() { "$lom" render "$scene" --size 160x90 "$@"; }

one_hash one_hash_for_lanes_and_threads
crops crop_is_the_cut_out
frame_alone a_frame_alone_is_the_frame_of_a_run
[ "$(hash --set quality.scissor=false)" = "$whole" ] && why= || why='the scissor changes the picture'
verdict the_scissor_changes_no_byte "$why"

stats=$(draw --threads 1 --stats -)
value() { echo "$stats" | sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p"; }
why=
for stage in scene sea spray output; do
    [ -n "$(value alone_$stage)" ] && [ "$(value alone_$stage)" = "$(value ms_$stage)" ] ||
        why="$stage: $(value alone_$stage) ms alone of $(value ms_$stage)"
done
echo "$(value ms_alone) $(value ms)" | awk '{ exit !($1 > 0 && $1 <= $2) }' || why="$(value ms_alone) of $(value ms) ms are alone"
verdict one_worker_is_always_alone "$why"

still=$("$lom" render "$folder/still.toml" --size 160x90 --hash | cut -d' ' -f1)
[ "$still" != "$whole" ] && why= || why='nothing is drawn'
expect() { # reason, arguments: they show nothing
    reason=$1
    shift
    [ "$(hash "$@")" = "$still" ] || why="the picture differs: $reason"
    case $("$lom" plan "$scene" --size 160x90 "$@") in *'-  spray '*"$reason"*) ;; *) why="the plan does not say: $reason" ;; esac
}
expect 'quality.spray is off' --set quality.spray=false
expect 'no emitter that is visible has a drop' --set spray.fall.count=0 --set spray.mist.visible=false
expect 'no emitter is in view' --set 'spray.fall.from=[0,900,0]' --set 'spray.fall.to=[0,900,0]' --set 'spray.mist.from=[0,0,300]' --set 'spray.mist.to=[0,0,300]'
expect 'of 3300 drops is in view' --set spray.fall.opacity=0 --set spray.mist.opacity=0
scene=$folder/still.toml
expect 'the scene has no emitter'
verdict what_shows_nothing_changes_no_byte "$why"
