#!/bin/sh
# Proves of scenes with several samples a pixel: an edge through the middle of a pixel, black before white, is the code of
# half the light; pixels without an edge are those of one sample; the picture is one for every width and number of threads, a
# crop is its cut-out, also beneath clouds and spray; what lies under water has as many as it is asked for, and no more than the
# picture; other numbers of samples end with 2 and a sentence, before a file is written.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/features/samples.toml
draw() { "$lom" render $scene --size 160x90 --quiet "$@"; }
one_hash samples_are_one_picture
crops samples_of_crops

printf 'v 0 -9 0\nv 0 9 0\nv -9 9 0\nv -9 -9 0\nf 1 2 3 4\n' >"$folder/half.obj"
cat >"$folder/half.toml" <<'END'
[output]
width = 33
height = 17
[camera]
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
END
why=
for samples in 2 4 8; do
    "$lom" render "$folder/half.toml" --set output.samples=$samples --quiet -o "$folder/half.ppm" || why='it is not drawn'
    # red of the pixels 15, 16 and 17 of the row 8, behind a header of 13 bytes
    row=$(tail -c +$((14 + (8 * 33 + 15) * 3)) "$folder/half.ppm" | head -c 9 | od -An -v -tu1 | awk '{ print $1, $4, $7 }')
    [ "$row" = '0 188 255' ] || why="$samples samples give $row"
done
verdict an_edge_through_a_pixel_is_half_the_light "$why"

# the sky is the same; of the whole picture, most
draw --set output.samples=1 -o "$folder/one.ppm"
draw -o "$folder/eight.ppm"
head -c $((14 + 8 * 160 * 3)) "$folder/one.ppm" >"$folder/one.sky"
head -c $((14 + 8 * 160 * 3)) "$folder/eight.ppm" >"$folder/eight.sky"
other=$("$lom" compare "$folder/one.ppm" "$folder/eight.ppm" | sed -n 's/^differing pixels *\([0-9]*\) .*/\1/p')
cmp -s "$folder/one.sky" "$folder/eight.sky" && [ "${other:-0}" -gt 500 ] && [ "$other" -lt 7200 ] && why= ||
    why="${other:-no} pixels differ, or the sky does"
verdict where_there_is_no_edge_samples_change_nothing "$why"

scene=assets/scenes/falls.toml
draw() { "$lom" render $scene --size 160x90 --quiet --set output.samples=4 "$@"; }
crops samples_of_crops_beneath_spray
scene=assets/scenes/cove.toml
one_hash samples_of_waves_are_one_picture

# hashes of samples of the picture and of the refraction
hash() { "$lom" render assets/scenes/lake.toml --size 160x90 --hash --set output.samples=$1 --set quality.refraction_samples=$2 | cut -c-16; }
plain=$(hash 1 1) one=$(hash 4 1) two=$(hash 4 2) four=$(hash 4 4) why=
[ "$(hash 1 16)" = "$plain" ] || why='a picture without samples has some'
[ "$(hash 4 16)" = "$four" ] || why='there are more than the picture has'
[ "$one" != "$two" ] && [ "$two" != "$four" ] && [ "$one" != "$four" ] || why="$one, $two and $four are not three pictures"
[ "$("$lom" render assets/scenes/lake.toml --size 160x90 --hash --set output.samples=4 | cut -c-16)" = "$one" ] || why='one is not what a scene has that does not say'
verdict what_lies_under_water_has_its_own_samples "$why"

why=
for samples in 0 3 5 17 -4 2.5 many; do
    said=$("$lom" render assets/scenes/lake.toml --size 16x9 --set "output.samples=$samples" -o "$folder/none.png" 2>&1 >/dev/null)
    [ $? -eq 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" -eq 1 ] && [ ! -e "$folder/none.png" ] || why="$samples: $said"
done
said=$("$lom" render assets/scenes/lake.toml --size 16x9 --set quality.refraction_samples=6 -o "$folder/none.png" 2>&1 >/dev/null)
[ $? -eq 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" -eq 1 ] && [ ! -e "$folder/none.png" ] || why="under water: $said"
verdict other_numbers_of_samples_are_refused "$why"
