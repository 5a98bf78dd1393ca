#!/bin/sh
# Proves of scenes whose draws have stages behind their vertices: tessellated terrain, normals as lines and drops that bounce
# are one picture for every width and number of threads, a crop is its cut-out, a frame alone is that of a run; tessellated
# terrain is within the stated measure of the dense mesh, and closer the less error is allowed; a drop that bounces off
# level ground is where the closed form puts it before, and above the ground after; what is off is not drawn; keys out of range end
# with 2 and a sentence, before a file is written.
. "$(dirname "$0")/render.sh"
draw() { "$lom" render $scene --size 160x90 --quiet "$@"; }
for name in tessellation normals bounce; do
    scene=assets/scenes/features/$name.toml
    one_hash "${name}_is_one_picture"
    crops "crops_of_$name"
done
scene=assets/scenes/features/bounce.toml
frame_alone bouncing_drops_of_a_frame_alone

# terrain against the dense mesh, in dB
scene=assets/scenes/features/tessellation.toml
draw -o "$folder/dense.ppm" --set quality.tessellation=false --set quality.terrain_error=0 --set quality.shading=phong
close_to_dense() { # pixels of error that are allowed
    draw -o "$folder/cut.ppm" --set quality.terrain_error="$1" --set quality.shading=phong
    "$lom" compare "$folder/cut.ppm" "$folder/dense.ppm" | sed -n 's/^PSNR *\([0-9]*\).*/\1/p'
}
whole=$(close_to_dense 0) half=$(close_to_dense 0.5) coarse=$(close_to_dense 2)
[ "${whole:-0}" -ge 55 ] && [ "${half:-0}" -ge 35 ] && [ "${coarse:-0}" -ge 32 ] && [ "$whole" -gt "$half" ] && [ "$half" -gt "$coarse" ] &&
    why= || why="$whole, $half, $coarse dB at 0, 0.5 and 2 pixels"
verdict tessellated_terrain_is_close_to_the_dense_mesh "$why"
why=
for shading in phong gouraud flat; do
    [ "$(hash --set quality.shading=$shading)" != "$(hash --set quality.shading=$shading --set quality.tessellation=false)" ] ||
        why="$shading: patches are not drawn"
done
verdict patches_of_each_shading "$why"

scene=assets/scenes/features/normals.toml
long=$(hash) none=$(hash --set quality.normals=0) short=$(hash --set quality.normals=0.1)
"$lom" render $scene --size 160x90 --quiet --hash --set quality.normals=0 --stats "$folder/none" >"$folder/out"
"$lom" render $scene --size 160x90 --quiet --hash --stats "$folder/some" >"$folder/out"
draws() { sed -n 's/.*"draws": \([0-9]*\).*/\1/p' "$folder/$1"; }
[ "$long" != "$none" ] && [ "$short" != "$none" ] && [ "$short" != "$long" ] && [ "$(draws some)" -gt "$(draws none)" ] && why= ||
    why="$long, $short, $none; $(draws some) and $(draws none) draws"
verdict normals_have_their_length "$why"

# The edges of what tessellation cuts: a patch whose edges have two segments, the fewest, is a fan of eight triangles about its
# middle. Two by two such patches lie on level ground as white as the sky; the same 56 edges as lines of a mesh.
awk 'BEGIN { print "P2 33 33 255"; for (i = 0; i < 33 * 33; i++) print 0 }' >"$folder/flat.pgm"
awk 'function v(x, z) { return x * 5 + 4 - z + 1 }
    function edge(a, b) { if (a > b) { t = a; a = b; b = t } if (!seen[a " " b]++) print "l", a, b }
    BEGIN { for (x = 0; x < 5; x++) for (z = 4; z >= 0; z--) print "v", 8 * x - 16, 0, 8 * z - 16
        split("0 1 2 2 2 1 0 0 0", rx, " "); split("0 0 0 1 2 2 2 1 0", rz, " ")
        for (y = 0; y < 3; y += 2) for (x = 0; x < 3; x += 2) for (k = 1; k < 9; k++) {
            edge(v(x + 1, y + 1), v(x + rx[k], y + rz[k])); edge(v(x + rx[k], y + rz[k]), v(x + rx[k + 1], y + rz[k + 1])) } }' \
    >"$folder/fans.obj"
head='[output]\nwidth = 160\nheight = 90\n[camera]\nposition = [0, 30, 20]\ntarget = [0, 0, 0]\nfield_of_view = 50\n'
white='[light]\nintensity = 0\nambient = [9, 9, 9]\n[sky]\ngradient = true\nzenith = [1, 1, 1]\nhorizon = [1, 1, 1]\nintensity = 9\n'
printf "$head$white"'[terrain]\nheight_map = "flat.pgm"\nsize = [32, 32]\nheight = 12\n[quality]\ntessellation = true\nterrain_error = 9\nwireframe_color = [0, 0, 0]\n' \
    >"$folder/cut.toml"
printf "$head$white"'[[entity]]\nmesh = "fans.obj"\n[entity.material]\nambient = 0\n' >"$folder/fans.toml"
[ "$(grep -c l "$folder/fans.obj")" = 56 ] && why= || why='the mesh has not 56 lines'
scene=$folder/fans.toml
lines=$(hash)
scene=$folder/cut.toml
plain=$(hash)
for kind in visible all; do
    wires=$(hash --set quality.wireframe=$kind)
    [ -n "$lines" ] && [ "$wires" = "$lines" ] && [ "$wires" != "$plain" ] || why="$kind: $wires, the lines are $lines, without them $plain"
done
verdict edges_of_patches_are_those_of_their_triangles "$why"

# Those that ground hides are left out: of what `visible` paints all is painted by `all`, which paints more.
scene=assets/scenes/features/tessellation.toml
wired() { "$lom" render $scene --quiet -o "$folder/$1.ppm" --set quality.shading=phong --set quality.terrain_error=20 --set 'quality.wireframe_color=[0, 1, 0]' --size 480x270 \
    --set output.samples=1 --set output.transfer=naive --set quality.wireframe=$1; tail -c +16 "$folder/$1.ppm" | od -An -v -tu1 -w3 | awk '{ print $1 == 0 && $2 == 255 && $3 == 0 }' >"$folder/$1.set"; }
wired off && wired visible && wired all
counts=$(paste "$folder/off.set" "$folder/visible.set" "$folder/all.set" | awk '{ o += $1; v += $2; a += $3; w += $2 > $3 } END { print o, w, (v > 20000), (a > v + 1000) }')
[ "$counts" = '0 0 1 1' ] && why= || why="off, visible alone, visible, all: $counts"
verdict hidden_edges_of_patches_are_left_out "$why"
draw_plainly() { "$lom" render $scene --size 160x90 --quiet "$@"; }
draw() { draw_plainly --set quality.wireframe=visible --set quality.normals=0.5 "$@"; }
one_hash wires_of_patches_are_one_picture
crops crops_of_wires_of_patches
draw() { draw_plainly "$@"; }

refused() { # name, what the sentence says, arguments
    name=$1 words=$2
    shift 2
    draw -o "$folder/none.png" "$@" 2>"$folder/message"
    code=$?
    [ $code = 2 ] && grep -q "$words" "$folder/message" && [ ! -e "$folder/none.png" ] && why= || why="$code: $(cat "$folder/message")"
    verdict "$name" "$why"
}
refused lines_have_a_length normals --set quality.normals=-1
refused tessellation_is_on_or_off tessellation --set quality.tessellation=3
scene=assets/scenes/features/bounce.toml
refused a_share_is_at_most_1 bounce --set spray.left.bounce=1.5
refused drops_that_bounce_live_briefly '60 s' --set spray.left.life=61
sed "s|../../terrain|$PWD/assets/terrain|; /^life/d" $scene >"$folder/fall.toml"
scene=$folder/fall.toml
refused drops_that_bounce_have_a_life 'not a height' --set spray.left.height=3
