#!/bin/sh
# Proves of textures in scenes: one probe is the default and changes no byte, more are one picture for every width, number of
# threads and crop; the mip levels of a DDS file are those that are drawn, their colours known to the code; a file that is cut,
# one of six faces and an anisotropy out of range end with 2 and a sentence, before a file is written.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/features/textures.toml
draw() { "$lom" render $scene --size 160x90 --quiet "$@"; }
why=
whole=$(hash)
for run in '4 1' '4 3' '8 2'; do
    other=$(hash --lanes "${run% *}" --threads "${run#* }")
    [ "$other" = "$whole" ] || why="$run lanes, threads give $other, not $whole"
done
[ -n "$whole" ] || why='no hash'
verdict probes_are_one_picture "$why"
crops probes_of_crops

why=
grep -v '^anisotropy' $scene | sed "s|floor.obj|$PWD/assets/scenes/features/floor.obj|" >"$folder/plain.toml"
plain=$("$lom" render "$folder/plain.toml" --size 160x90 --quiet --hash)
[ "$plain" = "$(draw --hash --set quality.anisotropy=1)" ] || why='one probe is not the default'
[ "$plain" != "$(draw --hash)" ] || why='16 probes change nothing'
verdict one_probe_is_the_default "$why"

# The planks, by the reference in double with its rays a pixel: probes come within 38 dB of them, one does not.
why=
planks="$scene --crop 248,130,232,140 --quiet"
"$lom" render $planks -o "$folder/rays.png" --set 'quality.water="reference"' --set quality.reference.samples=16
for row in '16 0' '1 1'; do
    "$lom" render $planks -o "$folder/probes.png" --set "quality.anisotropy=${row% *}" --set output.samples=16
    "$lom" compare "$folder/probes.png" "$folder/rays.png" --min-psnr 38 >/dev/null
    [ $? = "${row#* }" ] || why="${row% *} probes are on the other side of 38 dB"
done
verdict probes_are_near_the_reference "$why"

# A square of 20 m before an eye 5 m away: a pixel of 32 down is 0.3125 m, 2^k texels where 64 texels are laid 2^k times.
why=
for row in '4 82 255 82' '5 99 255 255' '6 82 85 255'; do
    level=${row%% *} want=${row#* } n=1
    i=0
    while [ $i -lt "$level" ]; do n=$((2 * n)) i=$((i + 1)); done
    printf 'v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nvt 0 0\nvt %d 0\nvt %d %d\nvt 0 %d\nf 1/1 2/2 3/3 4/4\n' $n $n $n $n >"$folder/square.obj"
    cat >"$folder/level.toml" <<END
[output]
width = 32
height = 32
transfer = "naive"
[camera]
position = [0, 0, 5]
target = [0, 0, 0]
field_of_view = 90
[light]
intensity = 0
ambient = [1, 1, 1]
ground = [1, 1, 1]
[[entity]]
mesh = "square.obj"
[entity.material]
ambient = [1, 1, 1]
texture = "$PWD/assets/textures/levels.dds"
END
    "$lom" render "$folder/level.toml" --quiet -o "$folder/level.ppm" || why="level $level is not drawn"
    got=$(tail -c +$((14 + (16 * 32 + 16) * 3)) "$folder/level.ppm" | head -c 3 | od -An -tu1 | tr -s ' ' | sed 's/^ //; s/ $//')
    [ "$got" = "$want" ] || why="level $level is ($got), not ($want)"
done
verdict levels_of_the_file_are_drawn "$why"

# The cube in one file, and its faces in six: the same texels, so the same picture; and a cube of other make is another.
why=
for name in 'sky_%s.png' sky.dds; do "$lom" make sky-box evening -o "$folder/$name" || why="$name is not made"; done
evening=assets/scenes/features/evening.toml
sed "s|\"../../|\"$PWD/assets/|; s|^cube = .*|pattern = \"sky_%s.png\"|" $evening >"$folder/six.toml"
one=$("$lom" render $evening --size 160x90 --quiet --hash)
[ -n "$one" ] && [ "$one" = "$("$lom" render "$folder/six.toml" --size 160x90 --quiet --hash)" ] || why='six files draw another picture'
cmp "$folder/sky.dds" assets/sky/evening.dds || why='the file is not the one of the assets'
for run in '4 1' '8 3'; do
    [ "$one" = "$("$lom" render $evening --size 160x90 --quiet --hash --lanes "${run% *}" --threads "${run#* }")" ] || why="$run differs"
done
"$lom" make sky-box evening --seed 8 -o "$folder/other.dds"
sed "s|\"../../sky/evening.dds|\"$folder/other.dds|; s|\"../../|\"$PWD/assets/|" $evening >"$folder/other.toml"
[ "$one" != "$("$lom" render "$folder/other.toml" --size 160x90 --quiet --hash)" ] || why='the cube is not looked at'
verdict a_sky_of_one_file_is_that_of_six "$why"

refused() { # the sentence, then the picture or, with --set, the setting
    words=$1
    shift
    picture=$1
    [ "$1" = --set ] && picture=$PWD/assets/textures/levels.dds || shift
    sed "s|^texture = .*|texture = \"$picture\"|" "$folder/level.toml" >"$folder/bad.toml"
    "$lom" render "$folder/bad.toml" --quiet -o "$folder/none.png" "$@" 2>"$folder/err"
    code=$?
    if [ $code != 2 ] || ! grep -q "$words" "$folder/err" || [ -e "$folder/none.png" ]; then
        why="$picture $* ends with $code: $(cat "$folder/err")"
    fi
}
why=
head -c 2000 assets/textures/levels.dds >"$folder/cut.dds"
refused anisotropy --set quality.anisotropy=17
refused anisotropy --set quality.anisotropy=0
refused 'too short' "$folder/cut.dds"
refused 'no single picture, but 6' "$PWD/tests/fuzz/corpus/fuzz_ktx/bc3_cube"
verdict bad_textures_are_refused "$why"
