#!/bin/sh
# Proves what was once wrong to the eye: a cloud smaller than its kind looks as its kind from as many times nearer, with
# no patch of mist; terrain throws no shadow where only sky is in view, and does where ground is.
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

no_shadow_of_terrain_without_ground() {
    "$lom" plan assets/scenes/lake.toml --size 64x36 --set camera.pitch=90 >"$folder/sky" &&
        grep -q '^- *terrain shadow left out: no ground is in view' "$folder/sky" &&
        "$lom" plan assets/scenes/lake.toml --size 64x36 >"$folder/ground" &&
        grep -q '^\* *terrain shadow' "$folder/ground"
}

check small_clouds_look_as_their_kind small_clouds_look_as_their_kind
check no_shadow_of_terrain_without_ground no_shadow_of_terrain_without_ground
exit $failures
