#!/bin/sh
# Proves what was once wrong to the eye: a cloud smaller than its kind looks as its kind from as many times nearer, with
# no patch of mist; an eye inside a cloud of the original model sees no edges; terrain throws no shadow where only sky is
# in view, and does where ground is.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh

# A world of one cumulus, all lengths times $1.
world() {
    awk -v s="$1" 'BEGIN {
        printf "[output]\nwidth = 96\nheight = 54\n[camera]\nnear = %g\nposition = [0, %g, %g]\ntarget = [0, %g, 0]\n", s, 180 * s, 1400 * s, 230 * s
        print "[sky]\ngradient = true\n[quality]\ncloud_jitter = false"
        printf "[[cloud]]\nkind = \"cumulus_humilis\"\nposition = [0, 0, 0]\nvoxels = [48, 24, 40]\nsize = [%g, %g, %g]\n", 1100 * s, 450 * s, 1000 * s
    }'
}

small_clouds_look_as_their_kind() {
    world 1 >"$folder/kind.toml"
    world 0.15 >"$folder/small.toml"
    for name in kind small; do
        "$lom" render "$folder/$name.toml" -o "$folder/$name.png" --quiet || return 1
    done
    "$lom" render "$folder/kind.toml" -o "$folder/clear.png" --set cloud.0.visible=false --quiet || return 1
    "$lom" compare "$folder/kind.png" "$folder/small.png" --min-psnr 45 &&
        ! "$lom" compare "$folder/kind.png" "$folder/clear.png" --min-psnr 42 >"$folder/out"
}

# Between pixels beside one another, in levels of 255 of green.
largest_step() { # PICTURE, 192x108
    python3 - "$1" <<'CODE'
import sys
width, height = 192, 108
green = open(sys.argv[1], "rb").read()[-width * height * 3:][1::3]
print(max(abs(green[y * width + x] - green[at]) for y in range(height - 1) for x in range(width - 1)
          for at in (y * width + x + 1, (y + 1) * width + x)))
CODE
}

no_edges_inside_a_cloud() {
    cat >"$folder/inside.toml" <<'END'
[output]
width = 192
height = 108
[camera]
near = 1
position = [0, 150, 120]
target = [0, 190, -100]
[light]
azimuth = 84
elevation = 31
[sky]
color = [0.3, 0.4, 0.6]
[quality]
clouds = "original"
[[cloud]]
kind = "cumulus_humilis"
position = [0, 0, 0]
voxels = [64, 32, 56]
seed = 2
END
    for light in combined advance real_time; do
        "$lom" render "$folder/inside.toml" -o "$folder/inside.ppm" --quiet --set clouds.original_light=$light || return 1
        step=$(largest_step "$folder/inside.ppm")
        [ "${step:-255}" -le 20 ] || { echo "$light: an edge of $step levels"; return 1; }
    done
}

no_shadow_of_terrain_without_ground() {
    "$lom" plan assets/scenes/lake.toml --size 64x36 --set camera.pitch=90 >"$folder/sky" &&
        grep -q '^- *terrain shadow left out: no ground is in view' "$folder/sky" &&
        "$lom" plan assets/scenes/lake.toml --size 64x36 >"$folder/ground" &&
        grep -q '^\* *terrain shadow' "$folder/ground"
}

check small_clouds_look_as_their_kind small_clouds_look_as_their_kind
check no_edges_inside_a_cloud no_edges_inside_a_cloud
check no_shadow_of_terrain_without_ground no_shadow_of_terrain_without_ground
exit $failures
