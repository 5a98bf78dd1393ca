#!/bin/sh
# Proves of exposure and curves in scenes: the defaults, said or not, are the same bytes; a stop more is twice each number of
# an rgb32f picture, of the reference too, and a curve there is the curve of those numbers; the picture is one for every width
# and number of threads, a crop its cut-out, beneath mirrors and clouds; light beyond 1 is told apart where clamp cuts it off;
# bad values end with 2 and a sentence, before a file is written.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/features/exposure.toml
draw() { "$lom" render $scene --size 160x90 --quiet "$@"; }
floats() { # the numbers of the PFM file, one a line, exactly enough to tell floats apart
    tail -n +4 "$1" | od -An -v -tf4 -w4
}
one_hash toned_pictures_are_one_picture
crops toned_crops

why=
for given in lake falls; do
    scene=assets/scenes/$given.toml
    plain=$(hash)
    said=$(hash --set output.exposure=0 --set output.curve=clamp --set output.white=3)
    [ -n "$plain" ] && [ "$plain" = "$said" ] || why="$given: $plain, and $said with the defaults said"
done
verdict the_defaults_change_nothing "$why"
scene=assets/scenes/features/exposure.toml

# a reference whose light is beyond 1
cat >"$folder/traced.toml" <<'END'
[output]
width = 12
height = 8
[sky]
gradient = true
horizon = [3, 0.7, 0.2]
zenith = [9, 0.4, 0.1]
[water]
level = 0
[quality]
water = "reference"
[quality.reference]
samples = 1
END

doubles() { # name
    why=
    draw --set output.format=rgb32f --set output.curve=clamp --set output.exposure=0 -o "$folder/one.pfm" &&
        draw --set output.format=rgb32f --set output.curve=clamp --set output.exposure=1 -o "$folder/two.pfm" &&
        draw --set output.format=rgb32f --set output.curve=reinhard --set output.exposure=1 --set output.white=4 \
            -o "$folder/curve.pfm" || why='it is not drawn'
    for name in one two curve; do floats "$folder/$name.pfm" >"$folder/$name"; done
    why=$why$(paste "$folder/one" "$folder/two" "$folder/curve" | awk '
        function far(a, b) { return (a > b ? a - b : b - a) > 3e-7 * (b > 1e-6 ? b : 1e-6) }
        { y = $2 >= 4 ? 1 : $2 * (1 + $2 / 16) / (1 + $2); n++; if ($2 > 1) bright++ }
        far($2, 2 * $1) && !said++ { printf "%s becomes %s", $1, $2 }
        far($3, y) && !said++ { printf "the curve of %s is %s, not %.9g", $2, $3, y }
        END { if (n < 100 || bright < 10) printf "%d numbers, %d above 1", n, bright }')
    verdict "$1" "$why"
}
encodes() { # name: 8 bits are the correctly rounded codes of the light after exposure and curve
    why='it is not the code of its light'
    draw --set output.exposure=-2 -o "$folder/drawn.ppm" &&
        draw --set output.exposure=-2 --set output.format=rgb32f -o "$folder/drawn.pfm" &&
        "$lom" convert --bits 8 --srgb "$folder/drawn.pfm" "$folder/encoded.ppm" &&
        cmp -s "$folder/drawn.ppm" "$folder/encoded.ppm" && why=
    verdict "$1" "$why"
}
doubles a_stop_is_twice_the_light
encodes pictures_are_encoded_after_the_curve
draw() { "$lom" render "$folder/traced.toml" --quiet "$@"; }
doubles a_stop_is_twice_the_light_of_the_reference
encodes the_reference_is_encoded_after_exposure
draw() { "$lom" render $scene --size 160x90 --quiet "$@"; }

white() { tail -c +15 "$1" | od -An -v -tu1 -w3 | grep -c '255 *255 *255'; }
draw -o "$folder/curve.ppm" && draw --set output.curve=clamp -o "$folder/cut.ppm"
cut=$(white "$folder/cut.ppm") bent=$(white "$folder/curve.ppm")
[ "${cut:-0}" -gt 50 ] && [ "$bent" -lt $((cut / 2)) ] && why= || why="$cut pixels are white when cut off, $bent with a curve"
verdict light_beyond_1_is_told_apart "$why"

why=
for value in exposure=10.5 exposure=-11 exposure=nan exposure=much curve=film curve=1 white=0.5 white=2e6 white=inf; do
    said=$("$lom" render assets/scenes/lake.toml --size 16x9 --set "output.$value" -o "$folder/none.png" 2>&1 >/dev/null)
    [ $? -eq 2 ] && [ "$(printf '%s\n' "$said" | wc -l)" -eq 1 ] && [ ! -e "$folder/none.png" ] || why="$value: $said"
done
verdict other_values_are_refused "$why"
