#!/bin/sh
# Proves of several waters at their own levels: a sheet in two tables at one level is the sheet in one, in every model and
# in the reference; one [[water]] is [water]; the order of tables changes no byte; crops, widths, threads and the scissor
# change none; each has its mirror, only where it is seen, and its lines in the plan; an eye under one sees no other; what
# cannot be is said.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/features/waters.toml
draw() { "$lom" render $scene --size 160x90 -q "$@"; }

one_hash one_hash_for_lanes_and_threads
crops crop_is_the_cut_out
frame_alone a_frame_alone_is_the_frame_of_a_run
why=
for model in planar displaced normal_map; do
    [ "$(hash --set quality.water=$model)" = "$(hash --set quality.water=$model --set quality.scissor=false)" ] ||
        why="$why $model"
done
verdict the_scissor_changes_no_byte "$why"

# ---- partition: a pond in a bowl, and its two halves
pool_heights
pond() { # tables of water
    printf '[camera]\nposition = [0, 6, 14]\ntarget = [0, 0, -2]\n[light]\nazimuth = 20\nelevation = 25\n'
    printf '[terrain]\nheight_map = "height.pgm"\nsize = 40\nheight = 12\nbase = -3\n[sky]\ngradient = true\n'
    printf '%b' "$1"
}
maps="normal_map = \"$PWD/assets/water/normal.png\"\ntile = 5\n"
pond "[water]\nlevel = 0.4\nsize = [40, 40]\n$maps" >"$folder/one.toml"
pond "[[water]]\nlevel = 0.4\nsize = [40, 40]\n$maps" >"$folder/first.toml"
half="level = 0.4\nsize = [20, 40]\n$maps"
pond "[[water]]\n${half}position = [-10, 0]\n[[water]]\n${half}position = [10, 0]\n" >"$folder/two.toml"
why=
for model in tinted planar normal_map displaced marched reference; do
    for name in one first two; do
        "$lom" render "$folder/$name.toml" --size 160x90 --set quality.water=$model -q -o "$folder/$name.ppm" \
            --set quality.reference.samples=1
    done
    cmp -s "$folder/one.ppm" "$folder/first.ppm" || why="$why $model: [[water]] is not [water];"
    most=$("$lom" compare "$folder/one.ppm" "$folder/two.ppm" --json | sed 's/.*"max_delta": \([0-9]*\).*/\1/')
    [ "${most:-99}" -le 1 ] || why="$why $model: $most levels;"
done
verdict two_halves_are_the_whole "$why"

# ---- order: the tarn first
awk '/^\[\[water\]\]/ { n++ } /^\[quality\]/ { n = 9 } { part[n + 0] = part[n + 0] $0 "\n" }
    END { printf "%s%s%s%s", part[0], part[2], part[1], part[9] }' $scene |
    sed "s|\.\./\.\./|$PWD/assets/|" >"$folder/turned.toml"
[ "$("$lom" render "$folder/turned.toml" --size 160x90 --hash)" = "$("$lom" render $scene --size 160x90 --hash)" ] &&
    why= || why='the tarn first is another picture'
verdict the_order_of_tables_changes_no_byte "$why"

# ---- the plan
plan() { "$lom" plan $scene --size 160x90 "$@"; }
why=
for line in '*  reflection  sea: terrain' '*  reflection  tarn: terrain' '*  water       tarn: waves'; do
    plan | grep -qF -- "$line" || why="$why no line $line;"
done
plan --set camera.target=[33,17,-300] | grep -qF -- '-  reflection  left out: tarn: the water is outside the view' ||
    why="$why a tarn behind the eye is mirrored;"
plan --set camera.position=[29,9,-128] | grep -qF -- '-  water       left out: sea: the eye is under another water' ||
    why="$why the sea is drawn for an eye in the tarn;"
[ "$(hash --set water.tarn.level=9.5)" != "$(hash)" ] || why="$why the level of the tarn changes nothing;"
[ "$(hash --set water.level=1)" != "$(hash)" ] || why="$why water.level is not the first one's;"
[ "$(hash --set water.1.level=9.5)" = "$(hash --set water.tarn.level=9.5)" ] || why="$why water.1 is not water.tarn;"
verdict each_has_its_lines_in_the_plan "$why"

# ---- what cannot be
refused() { # text of the tables, what is said
    pond "$1" >"$folder/bad.toml"
    said=$("$lom" render "$folder/bad.toml" --size 16x9 -o "$folder/bad.ppm" 2>&1)
    status=$?
    [ $status -eq 2 ] && [ ! -e "$folder/bad.ppm" ] || why="$why $2: status $status;"
    case $said in *"$2"*) ;; *) why="$why not \"$2\" but \"$said\";" ;; esac
}
why=
eight='[[water]]\n[[water]]\n[[water]]\n[[water]]\n[[water]]\n[[water]]\n[[water]]\n[[water]]\n'
refused "$eight[[water]]\n" 'a scene has at most 8 waters.'
refused '[[water]]\nname = "a"\n[[water]]\nname = "a"\n' 'another water has this name already.'
refused '[[water]]\n[[water]]\nlevel = "high"\n' '"level" must be a number, not a string.'
verdict what_cannot_be_is_refused "$why"
