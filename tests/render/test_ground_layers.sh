#!/bin/sh
# Proves of the layers of terrain, on a small pool among hills: whatever the packets, one hash, so what is not sampled
# because it does not show changes no byte; a layer that covers everything is the picture below it; and of
# quality.terrain_composite: one pixel where none is said, off at 0 and of ground without layers, one hash, a crop is the
# cut-out of the whole, a frame alone is that of a run, layers of one colour are exact, and what it is off grows with it.
. "$(dirname "$0")/render.sh"
scene=$folder/pool.toml
pool_heights
texture() { # NAME SEED: a rough texture
    awk -v seed="$2" 'BEGIN { print "P3 32 32 255"; for (i = 0; i < 1024; i++) print (i * 37 * seed) % 251, (i * 53) % (90 + seed), (i * seed) % 199 }' >"$folder/$1.ppm"
}
texture base 3
texture rock 7
texture snow 11
for name in red green; do
    awk -v red=$name 'BEGIN { print "P3 4 4 255"; for (i = 0; i < 16; i++) print (red == "red" ? "200 60 20" : "20 180 90") }' >"$folder/$name.ppm"
done
world() { # BASE: the scene without layers
    cat <<END
[quality]
terrain_composite = 0
[camera]
position = [-3, 4, 24]
yaw = 8
pitch = -12
[light]
elevation = 40
[sky]
color = [0.4, 0.6, 0.9]
[terrain]
height_map = "height.pgm"
size = [80, 80]
height = 14
base = -3
texture = "$1.ppm"
tile = 3
END
}
layer() { printf '[[terrain.layer]]\nmap = "%s.ppm"\n%s\n' "$1" "$2"; }
layers() { # of three pictures
    world "$1"
    layer "$2" "tile = 3
from_height = 1
blend = 2"
    layer "$3" 'mapping = "triplanar"
tile = 4
grain = 0.7
from_slope = 25
slope_blend = 15'
}
draw() { "$lom" render "$scene" --size 160x90 "$@"; }
difference() { "$lom" compare "$folder/a.ppm" "$folder/b.ppm" --json | sed "s/.*\"$1\": \([0-9.]*\).*/\1/"; }

widths() { # name: packets of 4 and of 8 fragments, taken in any order, give one hash
    whole=$(hash) why=
    for run in '4 1' '4 5' '8 1' '8 3'; do
        other=$(hash --lanes "${run% *}" --threads "${run#* }")
        [ "$other" = "$whole" ] || why="$run (lanes, threads) give $other, not $whole"
    done
    [ -n "$whole" ] || why='no hash'
    verdict "$1" "$why"
}

layers base rock snow >"$scene"
widths layers_have_one_hash
plain=$whole
sed '/^terrain_composite/d' "$scene" >"$folder/silent.toml"
said=$("$lom" render "$scene" --size 160x90 --hash --set quality.terrain_composite=1)
unsaid=$("$lom" render "$folder/silent.toml" --size 160x90 --hash)
[ "$said" = "$unsaid" ] && why= || why="$unsaid, and $said with one pixel"
verdict the_composite_begins_at_one_pixel_where_none_is_said "$why"
case $("$lom" plan "$scene") in *'*  terrain layers'*) why='it is composed' ;; *) why= ;; esac
verdict the_composite_is_off_at_0 "$why"
sed '/terrain.layer/,$d; /^terrain_composite/d' "$scene" >"$folder/bare.toml"
case $("$lom" plan "$folder/bare.toml") in *'*  terrain layers'*) why='it is composed' ;; *) why= ;; esac
[ "$("$lom" render "$folder/bare.toml" --size 160x90 --hash)" = "$("$lom" render "$folder/bare.toml" --size 160x90 --hash --set quality.terrain_composite=0)" ] ||
    why='it shows'
verdict ground_without_layers_has_no_composite "$why"

world rock >"$scene" && alone=$(hash)
{ world base && layer snow 'tile = 5
from_height = 1' && layer rock 'tile = 3'; } >"$scene"
[ "$(hash)" = "$alone" ] && why= || why='what lies below a layer that covers everything shows'
verdict what_is_covered_does_not_show "$why"

layers base rock snow >"$scene"
draw -q -o "$folder/a.ppm"
draw() { "$lom" render "$scene" --size 160x90 --set quality.terrain_composite=2 "$@"; }
widths the_composite_has_one_hash
[ "$whole" != "$plain" ] && why= || why='it changes nothing'
case $("$lom" plan "$scene" --set quality.terrain_composite=2) in *'*  terrain layers'*) ;; *) why='no pass composes the layers' ;; esac
verdict the_composite_is_used "$why"
crops a_crop_is_the_cut_out_with_a_composite
frame_alone() { # the scene stands still
    [ "$(hash --frame 3)" = "$(draw --frames 2:3 --hash | sed -n 's/  frame 3$//p')" ] && why= || why='another in a run'
    verdict "$1" "$why"
}
frame_alone a_frame_alone_has_its_composite

draw -q -o "$folder/b.ppm"
two=$(difference rmse)
draw -q --set quality.terrain_composite=16 -o "$folder/b.ppm"
sixteen=$(difference rmse)
why=$(awk -v two="$two" -v sixteen="$sixteen" 'BEGIN { if (!(two > 0 && two < 12 && sixteen > two)) print two " at 2 pixels, " sixteen " at 16" }')
verdict the_error_grows_with_the_pixels "$why"

layers red red red >"$scene"
draw -q --set quality.terrain_composite=0 -o "$folder/a.ppm"
draw -q --set quality.terrain_composite=16 -o "$folder/b.ppm"
most=$(difference max_delta)
[ "${most:-99}" -le 1 ] && why= || why="they differ by $most"
verdict layers_of_one_colour_are_that_colour "$why"
