#!/bin/sh
# Proves `lom info`: the facts of files made here by hand, as text and as JSON.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
cd "$folder" || exit 1

printf 'P5 3 2 255\n\001\002\003\004\005\006' >gray.pgm
printf 'Pf\n2 1\n-1.0\n\000\000\200\077\000\000\000\100' >two.pfm
# a triangle, a quad and a pentagon: 1 + 2 + 3 triangles, two materials
printf 'newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n' >shapes.mtl
{
    echo 'mtllib shapes.mtl'
    printf 'v %s\n' '0 0 0' '1 0 0' '0 1 0' '1 1 0' '2 1 0' '3 2 0'
    printf 'usemtl red\nf 1 2 3\nf 1 2 4 3\nusemtl blue\nf 1 2 5 6 3\n'
} >shapes.obj

printf 'title = "nothing"\n[output]\nwidth = 32\nheight = 20\nformat = "rgb16"\n' >bare.toml

text() {
    exits 0 "$lom" info gray.pgm two.pfm shapes.obj && says "gray.pgm: image, 3 x 2, R8, hash " &&
        says "two.pfm: image, 2 x 1, R32F, hash " && says "shapes.obj: mesh, " && says "6 triangles, 2 materials, hash "
}

json() {
    exits 0 "$lom" info --json gray.pgm two.pfm shapes.obj && python3 - <<'CODE'
import json
gray, pfm, mesh = (json.loads(line) for line in open("out"))
fields = "file kind width height depth channels bits vertices triangles materials hash".split()
for facts in gray, pfm, mesh:
    assert all(name in facts for name in fields), facts
    assert len(facts["hash"]) == 16 and int(facts["hash"], 16) > 0
assert gray["file"] == "gray.pgm" and gray["kind"] == "image" and gray["triangles"] is None
assert [gray[n] for n in ("width", "height", "depth", "channels", "bits")] == [3, 2, 1, 1, 8]
assert [pfm[n] for n in ("width", "height", "depth", "channels", "bits")] == [2, 1, 1, 1, 32]
assert mesh["kind"] == "mesh" and mesh["triangles"] == 6 and mesh["materials"] == 2 and mesh["width"] is None
assert mesh["vertices"] >= 6

# the hash by the definition: FNV-1a of width, height, depth, format as 32-bit little-endian, then the samples
def fnv(data):
    h = 0xcbf29ce484222325
    for byte in data:
        h = (h ^ byte) * 0x100000001b3 % 2**64
    return "%016x" % h
assert gray["hash"] == fnv(b"".join(n.to_bytes(4, "little") for n in (3, 2, 1, 1)) + bytes([1, 2, 3, 4, 5, 6]))
CODE
}

# A scene has the size of its picture; its hash is that of its files.
scene() {
    exits 0 "$lom" info bare.toml && says "bare.toml: scene, 32 x 20, hash " && cp out first && echo '# more' >>bare.toml &&
        exits 0 "$lom" info bare.toml && ! cmp -s out first && echo 'outptu = 1' >wrong.toml &&
        exits 2 "$lom" info wrong.toml && complains 'wrong.toml:1:1' && complains 'did you mean "output"'
}

# One bad file: status 2, the others are shown.
bad_files() {
    head -c 9 gray.pgm >short.pgm
    exits 2 "$lom" info short.pgm gray.pgm none.obj && says "gray.pgm: image" && complains "short.pgm" && complains "none.obj"
}

# What other readers take with a warning: a mesh, its bounds, and how many warnings there are.
lenient_meshes() {
    printf 'v 0 -1 0\nv 1 2 3.5\nl 1 2 1\np 1\ncurv 0 1 1 2\n' >lines.obj
    printf 'mtllib odd.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1/1/1 2/2/2 3/3/3\n' >lacking.obj
    printf 'newmtl\nKd 1 0 0\nnewmtl red\nmap_Kd photo.jpg\n' >odd.mtl
    printf 'Material #1\n' >photo.jpg
    exits 0 "$lom" info lines.obj && says "lines.obj: mesh, from 0 -1 0 to 1 2 3.5, 2 vertices, 0 triangles, 2 lines, 1 points, 0 materials" &&
        complains "lom: warning: lines.obj:5: a curve or surface is passed over" &&
        exits 0 "$lom" info --json lacking.obj lines.obj && says '"warnings": 2, "bounds": [[0, 0, 0], [1, 1, 0]]' &&
        says '"warnings": 1, "bounds": [[0, -1, 0], [1, 2, 3.5]]' && says '"lines": 2, "points": 1,' && complains "odd.mtl:1: newmtl without a name" &&
        complains "lacking.obj:6: a face names normals or texture coordinates that the file lacks" &&
        exits 0 "$lom" convert lacking.obj again.obj && complains "lacking.obj:6: a face names normals" &&
        exits 0 "$lom" convert again.obj twice.obj && exits 0 "$lom" convert lines.obj points.obj &&
        exits 0 "$lom" convert points.obj back.obj && cmp points.obj back.obj && grep -q '^l 1 2 1$' back.obj &&
        exits 0 "$lom" info points.obj lines.obj || return 1
    [ "$(sed 's/.*hash //' out | sort -u | wc -l)" = 1 ] || return 1
    sed 's/twice.mtl/again.mtl/' twice.obj | cmp - again.obj || return 1
    printf '[output]\nwidth = 32\nheight = 18\n[camera]\nposition = [0, 0, 3]\n' >odd.toml
    printf '[[entity]]\nmesh = "lacking.obj"\n[[entity]]\nmesh = "lines.obj"\n' >>odd.toml
    exits 0 "$lom" render odd.toml -o odd.png && complains "photo.jpg" && complains "lines.obj:5: a curve" &&
        exits 0 "$lom" render odd.toml -o odd.png --quiet && [ ! -s err ] &&
        exits 0 "$lom" render odd.toml -o odd.png --set 'quality.water="reference"' && complains "photo.jpg"
}

# Files that hold more than a picture: levels, faces, layers.
containers() {
    corpus=$OLDPWD/tests/fuzz/corpus
    exits 0 "$lom" info "$corpus/fuzz_dds/bc1_levels" "$corpus/fuzz_ktx/bc3_cube" "$corpus/fuzz_dds/array_bc5" "$corpus/fuzz_dds/volume" &&
        says "bc1_levels: image, 9 x 6, RGBA8, 4 levels, hash " && says "bc3_cube: cube, 4 x 4 x 6, RGBA8, 3 levels, hash " &&
        says "array_bc5: array, 8 x 4 x 2, RG8, 2 levels, hash " && says "volume: volume, 4 x 2 x 3, R8, 3 levels, hash " &&
        exits 0 "$lom" info --json "$corpus/fuzz_ktx/bc3_cube" && says '"kind": "cube"' && says '"levels": 3' &&
        exits 0 "$lom" info --json gray.pgm && says '"levels": 1' || return 1
    exits 0 "$lom" convert "$corpus/fuzz_dds/bc1_levels" first.png && exits 0 "$lom" info first.png && says "9 x 6, RGBA8, hash" &&
        exits 2 "$lom" convert "$corpus/fuzz_ktx/bc3_cube" none.png && complains "one slice, not 6" && [ ! -e none.png ] &&
        exits 2 "$lom" convert "$corpus/fuzz_dds/short" none.png && complains "too short for" && [ ! -e none.png ] &&
        exits 0 "$lom" convert "$corpus/fuzz_ktx/bc3_cube" cube.dds && exits 0 "$lom" info cube.dds &&
        says "cube.dds: cube, 4 x 4 x 6, RGBA8, 3 levels, hash " && exits 2 "$lom" convert first.png none.ktx && [ ! -e none.ktx ]
}

check info_text text
check info_of_levels_and_slices containers
check info_lenient_meshes lenient_meshes
if command -v python3 >/dev/null; then
    check info_json json
else
    echo "SKIP info_json: there is no python3"
fi
check info_scene scene
# Names are bytes: what is no UTF-8 in them is replaced, a byte at a time, and the rest stays.
broken_names() {
    command -v iconv >/dev/null || { echo "no iconv here"; return 0; }
    for bytes in '\377' '\303(' '\342\202(' '\360\237\230(' '\355\240\200' '\300\200' '\364\220\200\200' '\342\202\254' '"\\'; do
        name=$(printf "a${bytes}z.pgm")
        printf 'P5 1 1 255\n7' >"$name" || return 1
        exits 0 "$lom" info --json "$name" && iconv -f UTF-8 -t UTF-8 "$folder/out" >/dev/null && says 'z.pgm"' && says '"a' || return 1
        rm "$name"
    done
}
check info_json_is_utf8_whatever_the_name broken_names
check info_goes_on_after_a_bad_file bad_files
exit $failures
