#!/bin/sh
# Proves, by name (docs/numerics.md, V), what a frame makes of clouds at their extremes: clouds of nothing leave every bit of the
# picture, what cannot be is refused at its key, a step cap that breaks the bound is said, jitter is a function of the
# pixel alone.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
cat >"$folder/clear.toml" <<TOML
[output]
width = 96
height = 54
[camera]
near = 0.5
field_of_view = 60
position = [100, 600, 2200]
target = [0, 700, 0]
[water]
size = [9000, 9000]
[quality]
water = "planar"
TOML
cat "$folder/clear.toml" - >"$folder/cloud.toml" <<TOML
[[cloud]]
name = "c"
kind = "cumulus_humilis"
voxels = [48, 32, 48]
position = [0, 400, 0]
size = [1600, 700, 1500]
TOML
scene=$folder/cloud.toml
hash_of() { "$lom" render "$scene" --hash "$@"; }

# No density or no extinction, whatever the model: the picture is that without clouds.
nothing_leaves_every_bit() {
    "$lom" render "$folder/clear.toml" --hash >"$folder/clear" || return 1
    hash_of >"$folder/cloudy" && ! cmp -s "$folder/clear" "$folder/cloudy" || { echo "no cloud is seen"; return 1; }
    for model in octaves forward single; do
        for none in density extinction; do
            hash_of --set "quality.clouds=\"$model\"" --set "cloud.c.$none=0" >"$folder/none"
            cmp "$folder/clear" "$folder/none" || { echo "$model, no $none"; return 1; }
        done
    done
}

refused() {
    for wrong in clouds.albedo=1.0000001 clouds.albedo=-0.1 clouds.albedo=nan clouds.forward=1 clouds.backward=-1 \
        cloud.c.extinction=-1 cloud.c.extinction=inf cloud.c.density=-0.5 'cloud.c.size=[0, 700, 1500]' \
        'cloud.c.size=[1600, -700, 1500]' 'cloud.c.size=[1600, 700, nan]' 'cloud.c.voxels=[513, 8, 8]' \
        quality.cloud_error=0; do
        exits 2 "$lom" render "$scene" --hash --set "$wrong" && complains "${wrong%%=*}" || { echo "$wrong"; return 1; }
    done
}

# Black clouds of albedo 0 take light and send none: no channel is brighter than without them.
no_albedo_sends_nothing() {
    "$lom" render "$folder/clear.toml" -o "$folder/clear.pam" --quiet &&
        "$lom" render "$scene" -o "$folder/black.pam" --set clouds.albedo=0 --set clouds.shadows=false --quiet || return 1
    tail -c 20736 "$folder/clear.pam" | od -An -v -tu1 -w1 >"$folder/a"
    tail -c 20736 "$folder/black.pam" | od -An -v -tu1 -w1 >"$folder/b"
    paste "$folder/a" "$folder/b" |
        awk '$2 > $1 { brighter++ } $2 < $1 { darker++ } END { print brighter + 0, "brighter,", darker + 0, "darker"; exit !(brighter == 0 && darker > 300) }'
}

step_cap_is_said() {
    exits 0 "$lom" plan "$scene" && ! grep -q "to keep quality.cloud_error" "$folder/out" || { echo "said without need"; return 1; }
    exits 0 "$lom" plan "$scene" --set quality.cloud_error=1e-9 &&
        says "1 of all would take more than 4096 steps to keep quality.cloud_error: theirs are longer" || return 1
    exits 0 "$lom" plan "$scene" --set quality.cloud_error=1e-9 --set 'quality.clouds="original"' &&
        ! grep -q "to keep quality.cloud_error" "$folder/out"
}

# On or off, a picture is the same over lanes, threads and runs, and a crop is a cut-out: rows 7..46, columns 13..72.
jitter_belongs_to_the_pixel() {
    for jitter in true false; do
        hash_of --set "quality.cloud_jitter=$jitter" --threads 1 --lanes 4 >"$folder/$jitter" || return 1
        for other in "--threads 2 --lanes 8" "--threads 3 --lanes 16"; do
            hash_of --set "quality.cloud_jitter=$jitter" $other >"$folder/next" 2>"$folder/err" ||
                grep -q 'was built without' "$folder/err" && continue
            cmp "$folder/$jitter" "$folder/next" || { echo "$jitter $other"; return 1; }
        done
        "$lom" render "$scene" --set "quality.cloud_jitter=$jitter" -o "$folder/whole.ppm" --quiet &&
            "$lom" render "$scene" --set "quality.cloud_jitter=$jitter" --crop 13,7,60,40 -o "$folder/crop.ppm" --quiet || return 1
        tail -c 15552 "$folder/whole.ppm" | od -An -v -tx1 -w288 | sed -n 8,47p | cut -c "$((13 * 9 + 1))-$((73 * 9))" >"$folder/a"
        tail -c 7200 "$folder/crop.ppm" | od -An -v -tx1 -w180 >"$folder/b"
        cmp "$folder/a" "$folder/b" || { echo "crop, jitter $jitter"; return 1; }
    done
    ! cmp -s "$folder/true" "$folder/false"
}

check v5_clouds_of_nothing_leave_every_bit nothing_leaves_every_bit
check v4_v9_what_cannot_be_is_refused refused
check v4_no_albedo_sends_nothing no_albedo_sends_nothing
check v17_a_step_cap_is_said step_cap_is_said
check v18_jitter_belongs_to_the_pixel jitter_belongs_to_the_pixel
exit $failures
