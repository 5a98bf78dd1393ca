#!/bin/sh
# Proves that `lom overlay` writes the colours with a legend below the picture, or the numbers alone, that the numbers are
# those of the frame that `lom render` draws, and that what cannot be shown is refused with one sentence.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
cd "$folder/scene" || exit 1

refuses() {
    refuses_text=$1
    shift
    rm -f out.png
    exits 2 "$lom" overlay "$@" && complains "$refuses_text" && [ ! -s "$folder/out" ] && [ ! -e out.png ] &&
        [ "$(wc -l <"$folder/err")" -eq 1 ]
}

bad_input() {
    refuses 'did you mean "overdraw"' overdrow scene.toml -o out.png &&
        refuses 'there are wireframe, depth' qqqqq scene.toml -o out.png &&
        refuses 'did you mean "reflection"' overdraw scene.toml --pass reflexion -o out.png &&
        refuses 'no pass "reflection"' overdraw scene.toml --set water.enabled=false --pass reflection -o out.png &&
        refuses 'needs -o' overdraw scene.toml && refuses 'no kind of picture' overdraw scene.toml -o out.qqq &&
        refuses 'both of --low and --high' overdraw scene.toml --low 1 -o out.png &&
        refuses 'to a greater one' overdraw scene.toml --low 2 --high 2 -o out.png &&
        refuses 'to a greater one' overdraw scene.toml --low 3 --high 2 -o out.png &&
        refuses 'above 0' triangle-size scene.toml --low 0 --high 2 -o out.png &&
        refuses 'has no scale' wireframe scene.toml --low 0 --high 2 -o out.png &&
        refuses 'at most --frame' overdraw scene.toml --frame 2 --run 3 -o out.png &&
        refuses 'missing.toml' overdraw missing.toml -o out.png
}

# Every kind, with and without its legend; what is drawn twice is the same, but for the clock's.
every_kind() {
    kinds=$("$lom" overlay --help | sed -n '/^KIND:/,/^$/s/^  \([a-z-]*\) .*/\1/p')
    [ "$(echo "$kinds" | wc -l)" -ge 15 ] || return 1
    for kind in $kinds; do
        "$lom" overlay "$kind" scene.toml --size 320x180 -o one.ppm --threads 1 &&
            "$lom" overlay "$kind" scene.toml --size 320x180 -o two.ppm --threads 3 --lanes 4 &&
            "$lom" overlay "$kind" scene.toml --size 320x180 -o bare.ppm --no-legend || return 1
        [ "$(head -c 3 bare.ppm | head -1)" = P6 ] && [ "$(wc -c <bare.ppm)" -eq $((320 * 180 * 3 + 15)) ] || return 1
        [ "$(wc -c <one.ppm)" -gt $((320 * 200 * 3)) ] || { echo "$kind: no legend"; return 1; }
        [ "$kind" = tile-time ] || cmp one.ppm two.ppm || { echo "$kind differs"; return 1; }
    done
}

# A crop's numbers are a cut-out of the whole's.
numbers() {
    for kind in overdraw triangle-size normals; do
        "$lom" overlay $kind scene.toml --size 64x48 -o whole.npy &&
            "$lom" overlay $kind scene.toml --size 64x48 --crop 10,7,20,30 -o part.npy || return 1
        python3 - <<'END' || return 1
import re, struct
def read(path):
    data = open(path, "rb").read()
    size = 10 + struct.unpack("<H", data[8:10])[0]
    shape = [int(x) for x in re.search(r"'shape': \(([0-9, ]*)\)", data[10:size].decode()).group(1).replace(",", " ").split()]
    return shape, data[size:]
(whole, a), (part, b) = read("whole.npy"), read("part.npy")
assert whole[:2] == [48, 64] and part[:2] == [30, 20]
pixel = 4 * (whole[2] if len(whole) > 2 else 1)
for y in range(30):
    assert a[((y + 7) * 64 + 10) * pixel:][:20 * pixel] == b[y * 20 * pixel:][:20 * pixel], y
END
    done
}

age_of_plates() {
    cat >clouds.toml <<'END'
[output]
width = 64
height = 36
[camera]
position = [0, 100, 0]
target = [0, 100, -100]
[quality]
impostors = "bounded"
[[cloud]]
kind = "cumulus_fractus"
voxels = [24, 16, 24]
size = [700, 350, 700]
position = [0, 100, -2000]
END
    "$lom" overlay impostor-age clouds.toml --frame 5 --run 5 -o run.pfm &&
        "$lom" overlay impostor-age clouds.toml --frame 5 -o alone.pfm || return 1
    python3 - <<'END'
import struct
def ages(path):
    data = open(path, "rb").read()
    values = struct.unpack("<%df" % (64 * 36), data[-64 * 36 * 4:])
    return {v for v in values if v == v}
assert ages("run.pfm") == {5.0}, ages("run.pfm")
assert ages("alone.pfm") == {0.0}, ages("alone.pfm")
END
}

# One lamp lights the ground before the eye, one at infinity all of it.
lists_of_lamps() {
    { cat scene.toml && printf '[[lamp]]\nposition = [0, 0.5, 1]\nreach = 1\n[[lamp]]\ndirection = [0, -1, 0]\n'; } >lamps.toml
    "$lom" overlay lamps lamps.toml --size 64x36 -o lamps.pfm && "$lom" overlay lamps scene.toml --size 64x36 -o dark.pfm || return 1
    python3 - <<'END'
import struct
def numbers(path):
    data = open(path, "rb").read()
    return {v for v in struct.unpack("<%df" % (64 * 36), data[-64 * 36 * 4:]) if v == v}
assert numbers("lamps.pfm") == {1.0, 2.0}, numbers("lamps.pfm")
assert numbers("dark.pfm") == set(), numbers("dark.pfm")
END
}

check bad_input_is_refused_with_a_sentence bad_input
check every_kind_has_a_legend_and_is_the_same_again every_kind
if command -v python3 >/dev/null; then
    check numbers_of_a_crop_are_a_cut_out numbers
    check lamps_are_counted_by_their_lists lists_of_lamps
    check plates_are_as_old_as_the_run age_of_plates
else
    echo "SKIP numbers_of_a_crop_are_a_cut_out: needs python3"
fi
exit $failures
