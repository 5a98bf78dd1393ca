#!/bin/sh
# Proves of shallow water in a scene, on a small pool with a spring, a boat and a drop: one hash for every lane width and
# thread count and for each model that shows it; a crop is the cut-out of the whole; a frame alone is the frame of a run,
# which goes on from the frame before; water out of view runs no step; and what cannot be is refused at its place.
. "$(dirname "$0")/render.sh"
scene=$folder/pool.toml
pool_heights
cat >"$scene" <<END
[output]
fps = 8
[camera]
position = [-3, 2.2, 14]
yaw = 8
pitch = -10
[light]
azimuth = 20
elevation = 20
[sky]
color = [0.4, 0.6, 0.9]
[terrain]
height_map = "height.pgm"
size = [80, 80]
height = 14
base = -3
[water]
size = [60, 60]
[shallow]
size = [40, 32]
cells = 40
[[shallow.spring]]
position = [2, -4]
rate = 3
[[shallow.body]]
position = [-2, 4]
half = [2, 1]
heading = 30
draft = 0.5
[[shallow.body]]
position = [3, 3]
half = 1
draft = 0.6
time = 0.1
duration = 0.3
every = 1
[quality]
water = "displaced"
END
draw() { "$lom" render "$scene" --size 160x90 "$@"; }
facts() { sed -n 's/.*"shallow_steps": \([0-9]*\).*/\1/p'; }

one_hash shallow_water_has_one_hash
crops shallow_water_cropped_is_its_cut_out
frame_alone shallow_water_alone_is_that_of_a_run

why=
for model in normal_map marched; do
    first=$(hash --frame 4 --set "quality.water=\"$model\"")
    [ -n "$first" ] && [ "$first" = "$(hash --frame 4 --lanes 4 --threads 3 --set "quality.water=\"$model\"")" ] || why="$model: two hashes"
    [ "$first" != "$(hash --frame 0 --set "quality.water=\"$model\"")" ] || why="$model shows nothing of it"
done
verdict shallow_water_shows_in_every_model_with_waves "$why"

# A body that is an entity's is one where the entity stands, its nose (-z) turned with it; one that moves is another.
stone='name="stone",mesh="'$PWD'/assets/entities/boulder.obj",position=[-2,0.2,4],rotation=[0,25,0]'
body='half=[2,1],draft=0.5}]'
its=$(hash --frame 4 --set "entity=[{$stone}]" --set "shallow.body=[{entity=\"stone\",$body")
there=$(hash --frame 4 --set "entity=[{$stone}]" --set "shallow.body=[{position=[-2,4],heading=-115,$body")
turned=$(hash --frame 4 --set "entity=[{$stone}]" --set "shallow.body=[{position=[-2,4],heading=-25,$body")
[ -n "$its" ] && [ "$its" = "$there" ] && [ "$its" != "$turned" ] && why= || why="$its, there $there, turned $turned"
keys='key=[{time=0,position=[-2,0.2,4]},{time=0.5,position=[3,0.2,0]}]'
moving=$(hash --frame 4 --set "entity=[{$stone,$keys}]" --set "shallow.body=[{entity=\"stone\",$body")
held=$(hash --frame 4 --set "entity=[{$stone,$keys}]" --set "shallow.body=[{position=[-2,4],heading=-115,$body")
[ -n "$moving" ] && [ "$moving" != "$held" ] || why="it moves no water: $moving"
verdict a_body_of_an_entity_goes_with_it "$why"

steps=$(draw --frames 3:5 --hash --stats - | facts | tr '\n' ' ')
[ "$steps" = '22 8 7 ' ] && why= || why="steps of frames 3, 4, 5: $steps"
away='--set camera.position=[0,2,90] --set camera.yaw=170 --set camera.pitch=0'
[ "$(draw --frame 5 --hash --stats - $away | facts)" = 0 ] || why='steps are run for what is not seen'
case $("$lom" plan "$scene" --frame 5 $away) in *'-  shallow'*'no step of it is run'*) ;; *) why='the plan does not say why' ;; esac
case $("$lom" plan "$scene" --frame 5) in *'*  shallow'*'37 steps from the beginning'*) ;; *) why='the plan does not say what was run' ;; esac
verdict shallow_water_is_run_when_it_is_seen "$why"

refused() { # line to add, what the message says
    printf '%s\n' "$1" | cat "$scene" - >"$folder/bad.toml"
    said=$("$lom" render "$folder/bad.toml" --hash 2>&1)
    [ $? -eq 2 ] || why="$1 is taken"
    case $said in *"bad.toml:$2"*) ;; *) why="$1: $said" ;; esac
}
why=
line=$(($(wc -l <"$scene") + 2))
refused '[[shallow.body]]
draft = 1' "$((line - 1)):11: a body needs a position or an entity."
refused '[[shallow.body]]
entity = "ghost"' "$line:10: no entity has this name."
refused '[[shallow.spring]]
rate = nan
position = [0, 0]' "$line:8: \"rate\" is nan"
refused '[[shallow.body]]
every = 3
position = [0, 0]' "$line:9: it dips in again after its duration"
verdict shallow_water_that_cannot_be_is_refused "$why"
