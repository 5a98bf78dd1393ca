#!/bin/sh
# Proves of scenes whose edges are smoothed: an edge of known place has the light of the part of each pixel that it leaves;
# pixels away from edges are those of sharp ones; the picture is one for every width and number of threads, a crop is its cut-out,
# also of waves, beneath clouds and spray, beside views that are mirrored; it is nearer to that of 16 samples than the sharp
# one; several samples, and passes that are watched, are drawn without, and the plan says so.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/features/edges.toml
draw() { "$lom" render $scene --size 160x90 --quiet "$@"; }
one_hash smooth_edges_are_one_picture
crops smooth_edges_of_crops

printf 'v 0 -9 0\nv 0 9 0\nv -9 9 0\nv -9 -9 0\nf 1 2 3 4\n' >"$folder/half.obj"
cat >"$folder/half.toml" <<'END'
[output]
width = 33
height = 17
transfer = "naive"
edges = "smooth"
[camera]
projection = "orthographic"
height = 17
position = [0, 0, 5]
target = [0, 0, 0]
[light]
intensity = 0
ambient = [0, 0, 0]
[sky]
gradient = true
zenith = [1, 1, 1]
horizon = [1, 1, 1]
intensity = 9
[[entity]]
name = "half"
mesh = "half.obj"
position = [0, 0, 0]
END
# The edge lies at 16.5 + x in pixels: of 15, 16, 17 those before it are black, those behind it white, and the one that it
# cuts has the part behind it, in 255 steps, known to two of them.
why=
for row in '0 0 128 255' '0.25 0 64 255' '-0.25 0 191 255' '0.4 0 26 255' '-0.4 0 230 255' '0.6 0 0 230' '-0.75 64 255 255'; do
    set -- $row
    "$lom" render "$folder/half.toml" --set "entity.half.position=[$1, 0, 0]" --quiet -o "$folder/half.ppm" || why='it is not drawn'
    # red of the pixels 15, 16 and 17 of the row 8, behind a header of 13 bytes
    got=$(tail -c +$((14 + (8 * 33 + 15) * 3)) "$folder/half.ppm" | head -c 9 | od -An -v -tu1 | awk '{ print $1, $4, $7 }')
    echo "$got" | awk -v a="$2" -v b="$3" -v c="$4" '{ exit !(($1 - a) ^ 2 <= 4 && ($2 - b) ^ 2 <= 4 && ($3 - c) ^ 2 <= 4) }' ||
        why="$1 is $got, not $2 $3 $4"
done
verdict an_edge_leaves_the_light_of_the_parts_of_its_pixels "$why"

# The sky is the same; of the whole picture, most.
draw --set output.edges=sharp -o "$folder/sharp.ppm"
draw -o "$folder/smooth.ppm"
head -c $((14 + 8 * 160 * 3)) "$folder/sharp.ppm" >"$folder/sharp.sky"
head -c $((14 + 8 * 160 * 3)) "$folder/smooth.ppm" >"$folder/smooth.sky"
other=$("$lom" compare "$folder/sharp.ppm" "$folder/smooth.ppm" | sed -n 's/^differing pixels *\([0-9]*\) .*/\1/p')
cmp -s "$folder/sharp.sky" "$folder/smooth.sky" && [ "${other:-0}" -gt 300 ] && [ "$other" -lt 7200 ] && why= ||
    why="${other:-no} pixels differ, or the sky does"
verdict where_there_is_no_edge_nothing_changes "$why"

psnr() { "$lom" compare "$folder/many.ppm" "$folder/$1.ppm" --json | sed -n 's/.*"psnr": *\([0-9.]*\).*/\1/p'; }
draw --set output.samples=16 -o "$folder/many.ppm"
draw --set output.samples=16 --set output.edges=sharp -o "$folder/same.ppm"
awk -v a="$(psnr sharp)" -v b="$(psnr smooth)" 'BEGIN { exit !(b > a + 0.8) }' && why= || why="$(psnr smooth) dB, $(psnr sharp) without"
verdict smooth_edges_are_nearer_to_those_of_16_samples "$why"
cmp -s "$folder/many.ppm" "$folder/same.ppm" && why= || why='they are not those alone'
"$lom" plan $scene --set output.samples=4 | grep -q 'edges.*output.samples smooths them' || why='the plan does not say why'
"$lom" plan $scene | grep -q 'edges.*mixed with what lies beyond' || why='the plan does not tell of them'
"$lom" plan $scene --set output.edges=sharp | grep -q '^ *edges' && why='the plan tells of edges that are sharp'
verdict several_samples_do_without_and_the_plan_says_so "$why"

draw --crop 70,30,5,5 --hash --show picture >/dev/null 2>&1
"$lom" render $scene --size 160x90 --quiet --show depth -o "$folder/depth.pfm" &&
    "$lom" render $scene --size 160x90 --quiet --crop 70,30,5,4 --show depth -o "$folder/part.pfm" &&
    [ "$("$lom" info --json "$folder/part.pfm" | sed -n 's/.*"width": 5, "height": 4,.*/5x4/p')" = 5x4 ] && why= || why='not of 5x4 pixels'
verdict what_is_shown_of_a_crop_has_its_size "$why"

for scene in assets/scenes/falls.toml assets/scenes/features/views.toml assets/scenes/features/isometric.toml; do
    draw() { "$lom" render $scene --size 160x90 --quiet --set output.edges=smooth "$@"; }
    name=$(basename $scene .toml)
    crops "smooth_edges_of_crops_in_$name"
done
scene=assets/scenes/cove.toml
one_hash smooth_edges_of_waves_are_one_picture

for value in 1 smoother; do
    said=$("$lom" render assets/scenes/lake.toml --size 16x9 --set "output.edges=$value" -o "$folder/none.png" 2>&1 >/dev/null)
    [ $? -eq 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" -eq 1 ] && [ ! -e "$folder/none.png" ] && why= || why="$value: $said"
done
verdict other_edges_are_refused "$why"
