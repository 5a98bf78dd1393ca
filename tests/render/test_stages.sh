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
refused edges_are_of_blocks 'either wireframe or tessellation' --set quality.tessellation=true --set quality.wireframe=visible
scene=assets/scenes/features/bounce.toml
refused a_share_is_at_most_1 bounce --set spray.left.bounce=1.5
refused drops_that_bounce_live_briefly '60 s' --set spray.left.life=61
sed "s|../../terrain|$PWD/assets/terrain|; /^life/d" $scene >"$folder/fall.toml"
scene=$folder/fall.toml
refused drops_that_bounce_have_a_life 'not a height' --set spray.left.height=3
