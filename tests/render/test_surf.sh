#!/bin/sh
# Proves of waves that come in to a shore, on the scene of surf: one hash for every lane width and thread count; a crop is
# the cut-out of the whole; a frame alone is the frame of a run; what cannot be is refused at its place.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/surf.toml
draw() { "$lom" render $scene --size 160x90 "$@"; }

one_hash surf_has_one_hash
crops surf_cropped_is_its_cut_out
frame_alone surf_alone_is_that_of_a_run

why=
case $("$lom" plan $scene) in *'*  surf'*'waves of 1.3 m and 7.5 s rise to'*'break from'*) ;; *) why='the plan does not say where waves break' ;; esac
printf '[water]\nlevel = 0\n[surf]\nheight = 1\n' >"$folder/bad.toml"
case $("$lom" render "$folder/bad.toml" --hash 2>&1) in *'bad.toml:4:10: waves come in to a shore: there is no terrain.'*) ;; *) why='surf without a shore' ;; esac
case $("$lom" render $scene --hash --set surf.period=nan 2>&1) in *'"period" is nan'*) ;; *) why='a period that is no number' ;; esac
verdict surf_says_what_it_does_and_what_it_cannot "$why"
