#!/bin/sh
# Proves of waves that plunge, on their scene: one hash for every lane width and thread count; a crop is the cut-out of the
# whole; a frame alone is the frame of a run; what does not plunge is the picture of waves that spill, in every model of
# water; the plan says by which slopes they plunge.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/features/plunging.toml
draw() { "$lom" render $scene --size 96x54 "$@"; }
frame_alone plunging_alone_is_that_of_a_run
draw() { "$lom" render $scene --size 160x90 --frame 32 "$@"; }
one_hash plunging_has_one_hash
crops plunging_cropped_is_its_cut_out

why=
spilling=$(draw --hash --set surf.breaking=spilling)
[ "$(draw --hash --set surf.plunging=0)" = "$spilling" ] || why='plunging = 0 is not spilling'
[ "$(draw --hash)" != "$spilling" ] || why='nothing plunges'
for model in normal_map marched; do
    [ "$(draw --hash --set quality.water=$model)" = "$(draw --hash --set quality.water=$model --set surf.breaking=spilling)" ] ||
        why="$model overturns"
done
verdict what_does_not_plunge_spills "$why"

why=
case $("$lom" plan $scene) in *'*  surf'*'plunge at Iribarren numbers of 0.'*) ;; *) why='the plan does not say which waves plunge' ;; esac
verdict the_plan_says_which_waves_plunge "$why"
