#!/bin/sh
# Proves that `lom explain` ends with the colour of `lom render`, in text, JSON and on a page that needs no other file, and
# that what cannot be explained is refused with one sentence.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
page=$PWD/tests/inspect/page.js
. tests/cli/scene.sh
cd "$folder/scene" || exit 1

refuses() {
    refuses_text=$1
    shift
    rm -f out.html
    exits 2 "$lom" explain "$@" && complains "$refuses_text" && [ ! -s "$folder/out" ] && [ ! -e out.html ] &&
        [ "$(wc -l <"$folder/err")" -eq 1 ]
}

bad_input() {
    refuses 'does not lie in the frame' scene.toml 100000,0 && refuses 'not "12"' scene.toml 12 &&
        refuses 'not "1,2,3"' scene.toml 1,2,3 && refuses 'does not lie in the frame' scene.toml 0,-1 &&
        refuses 'no --crop' scene.toml 1,1 --crop 0,0,4,4 && refuses 'missing.toml' missing.toml 1,1 || return 1
    sed '4s/.*/[camrea]/; /^position/d' scene.toml >bad.toml
    refuses 'bad.toml:4:2: unknown key' bad.toml 1,1 -o out.html
}

verdict_first() {
    exits 0 "$lom" explain scene.toml 8,8 --size 32x24 && [ -s "$folder/out" ] || return 1
    head -1 "$folder/out" | grep -qE 'wrote this|blended over|Nothing drew here|All was rejected' &&
        sed -n 2p "$folder/out" | grep -q '^pixel 8,8 of scene.toml, frame 0, 32x24:'
}

# Each lamp's term has its name, or its number.
lamps_are_named() {
    { cat scene.toml && printf '[[lamp]]\nname = "torch"\ndirection = [0, -1, 0]\n[[lamp]]\ndirection = [0, -2, 1]\n'; } >lamps.toml
    exits 0 "$lom" explain lamps.toml 16,22 --size 32x24 || return 1
    grep -q '^ *torch = ' "$folder/out" && grep -q '^ *lamp\.1 = ' "$folder/out"
}

# A wall of the lamp's side: what is behind it has nothing of the lamp, what is before it all of it; its maps can be shown.
lamp_shadows_are_told() {
    printf 'v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3 4\n' >slab.obj
    printf 'v -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\nf 1 2 3 4\nf 4 3 2 1\n' >wall.obj
    printf '[camera]\nposition = [0, 9, 0.1]\ntarget = [0, 0, 0]\nfield_of_view = 60\n[[entity]]\nname = "slab"\nmesh = "slab.obj"\n[[entity]]\nname = "wall"\nmesh = "wall.obj"\n[[lamp]]\nname = "torch"\nposition = [0, 1, 3]\nreach = 20\nshadow = true\n' >torch.toml
    exits 0 "$lom" explain torch.toml 16,22 --size 32x32 && grep -q 'torch.shadow = 1$' "$folder/out" &&
        grep -q ' torch = ' "$folder/out" && exits 0 "$lom" explain torch.toml 16,8 --size 32x32 &&
        grep -q 'torch.shadow = 0$' "$folder/out" && ! grep -q ' torch = ' "$folder/out" &&
        exits 0 "$lom" render torch.toml --size 32x32 --set quality.lamp_shadows=64 --show lamp-shadows -o maps.pfm &&
        exits 0 "$lom" info --json maps.pfm && grep -q '"width": *384, *"height": *64' "$folder/out" &&
        exits 2 "$lom" render torch.toml --size 32x32 --set lamp.0.shadow=false --show lamp-shadows -o none.png &&
        complains 'no shadow map of a lamp' && [ ! -e none.png ]
}

# The same pixels by `lom render` as PPM, whose last bytes are the picture's.
pixels_of_render() {
    "$lom" render scene.toml --size 32x24 --frame 2 -o picture.ppm --quiet || return 1
    for at in 0,0 31,23 16,12 5,20; do
        "$lom" explain scene.toml $at --size 32x24 --frame 2 --json --threads 2 >explained.json || return 1
        python3 - $at <<'END' || return 1
import json, sys
x, y = map(int, sys.argv[1].split(","))
pixels = open("picture.ppm", "rb").read()[-32 * 24 * 3:]
one = json.loads(open("explained.json").read())
expected = list(pixels[(y * 32 + x) * 3:][:3])
assert one["pixel"] == expected, (one["pixel"], expected)
assert one["verdict"] and isinstance(one["draws"], list)
stored = [t for d in one["draws"] for t in d["triangles"] if t["fate"].startswith("stored")]
assert not stored or stored[-1]["writes"][-1]["after"][:3] == expected
assert all(len(t["vertices"]) == 3 for t in stored)
END
    done
}

page_alone() {
    exits 0 "$lom" explain scene.toml 16,20 --size 32x24 -o out.html && [ -s out.html ] || return 1
    ! grep -qE 'https?://|src="|href=' out.html && grep -q 'data:image/png;base64,iVBOR' out.html &&
        [ "$(grep -c '</script>' out.html)" -eq 3 ]
}

page_runs() {
    "$lom" explain scene.toml 16,20 --size 32x24 -o out.html >"$folder/verdict" &&
        node "$page" out.html >"$folder/steps" && cat "$folder/steps" && grep -q '^lom explain: [1-9][0-9]* steps' "$folder/steps"
}

# ---- lom render --show ----

unknown_pass() {
    rm -f out.png
    exits 2 "$lom" render scene.toml --show mirror -o out.png && complains 'There is no pass "mirror"' &&
        complains 'reflection' && [ ! -e out.png ] && exits 2 "$lom" render scene.toml --set water.enabled=false --show reflection -o out.png &&
        complains 'no reflection to show' && [ ! -e out.png ]
}

# What a row of pixels says: raw numbers of NumPy, read by hand.
shown_numbers() {
    for pass in depth objects normals motion picture; do
        "$lom" render scene.toml --size 32x24 --show $pass -o $pass.npy --quiet &&
            "$lom" render scene.toml --size 32x24 --show $pass -o $pass.pfm --quiet &&
            "$lom" render scene.toml --size 32x24 --show $pass -o $pass.png --quiet || return 1
    done
    "$lom" render scene.toml --size 32x24 --set 'camera.position=[0,2,6]' --show depth -o further.npy --quiet || return 1
    python3 - <<'END'
import ast, struct
def load(name):
    data = open(name + ".npy", "rb").read()
    assert data[:8] == b"\x93NUMPY\x01\x00" and (10 + data[8]) % 64 == 0
    head = ast.literal_eval(data[10:10 + data[8]].decode())
    assert head["descr"] == "<f4" and not head["fortran_order"] and head["shape"][:2] == (24, 32)
    return struct.unpack("<%df" % ((len(data) - 10 - data[8]) // 4), data[10 + data[8]:])
depth, objects, normals, motion = load("depth"), load("objects"), load("normals"), load("motion")
pfm = open("depth.pfm", "rb").read()[-24 * 32 * 4:]
assert struct.unpack("<%df" % (24 * 32), pfm)[-32:] == depth[:32]
seen = [i for i in range(24 * 32) if objects[i] != 0]
assert set(objects) == {0.0, 2.0, 16.0}, set(objects)
for i in range(24 * 32):
    n = normals[3 * i:3 * i + 3]
    length = sum(x * x for x in n) ** .5
    assert objects[i] != 16 or depth[i] > 0
    assert (abs(length - 1) < 1e-5 if i in seen else length == 0)
    assert all(abs(x) < 1e-2 for x in motion[3 * i:3 * i + 3]), motion[3 * i:3 * i + 3]
further = load("further")
assert min(x for x in further if x) > min(x for x in depth if x) + .5
END
}

check unknown_passes_are_refused_with_a_sentence unknown_pass
check bad_input_is_refused_with_a_sentence bad_input
check the_verdict_comes_first verdict_first
check each_lamp_is_named lamps_are_named
check shadows_of_lamps_are_told lamp_shadows_are_told
check a_page_needs_no_other_file page_alone
if command -v node >/dev/null; then
    check every_step_of_the_page_can_be_taken page_runs
else
    echo "SKIP every_step_of_the_page_can_be_taken: needs node"
fi
if command -v python3 >/dev/null; then
    check explained_pixels_are_those_of_render pixels_of_render
    check shown_numbers_are_those_of_the_scene shown_numbers
else
    echo "SKIP explained_pixels_are_those_of_render: needs python3"
fi
exit $failures
