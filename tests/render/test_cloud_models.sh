#!/bin/sh
# Proves the phase functions and the earlier models of clouds by what is known of them: no asymmetry is isotropic, no blend
# is one lobe, Rayleigh's light is 3/4 (1 + mu^2) of the isotropic; white clouds are the original's brightest; the flat
# cloud turns with the eye; each model has one hash for all lanes and threads.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
cat >"$folder/scene.toml" <<TOML
[output]
width = 48
height = 32
format = "rgb32f"
[camera]
near = 0.5
field_of_view = 4
position = [0, 750, 30000]
target = [0, 750, 0]
[light]
azimuth = 180
elevation = 0
intensity = 0.5
[sky]
color = [0, 0, 0]
[clouds]
silver = 0
sky = [0, 0, 0]
ground = [0, 0, 0]
[quality]
cloud_octaves = 1
[[cloud]]
name = "c"
kind = "cumulus_humilis"
voxels = [24, 16, 24]
position = [0, 400, 0]
size = [1600, 700, 1500]
TOML
picture() { # NAME OPTION...: the samples of a picture as text, a number a line
    name=$1
    shift
    "$lom" render "$folder/scene.toml" -o "$folder/$name.pfm" --quiet "$@" || return 1
    tail -c 18432 "$folder/$name.pfm" | od -An -v -tf4 -w4 >"$folder/$name"
}

limits_of_phases() {
    picture isotropic --set 'clouds.phase="isotropic"' && picture dual --set clouds.forward=0 --set clouds.backward=0 &&
        cmp "$folder/isotropic" "$folder/dual" || { echo "no asymmetry"; return 1; }
    picture lobe --set 'clouds.phase="henyey_greenstein"' && picture dual --set clouds.blend=0 &&
        cmp "$folder/lobe" "$folder/dual" && ! cmp -s "$folder/lobe" "$folder/isotropic"
}

# The sun behind the eye (azimuth 180 is +z), ahead of it, and from the side: mu is -1, 1 and 0 within the 4 degrees of the
# picture. Light that is scattered once is the isotropic one times 3/4 (1 + mu^2), at every place that sends any.
rayleigh() {
    for side in '180 1.5' '0 1.5' '90 0.75'; do
        azimuth=${side% *} factor=${side#* }
        picture one --set 'quality.clouds="single"' --set "light.azimuth=$azimuth" --set 'clouds.phase="isotropic"' &&
            picture other --set 'quality.clouds="single"' --set "light.azimuth=$azimuth" --set 'clouds.phase="rayleigh"' || return 1
        paste "$folder/one" "$folder/other" | awk -v factor="$factor" '
            $1 > 4e-5 { count++; error = $2 / $1 / factor - 1; if (error < 0) error = -error; if (error > worst) worst = error }
            END { print factor, count + 0, "samples, worst", worst; exit !(count > 200 && worst < 0.004) }' || return 1
    done
}

white_is_brightest() {
    for light in none advance real_time combined; do
        picture $light --set 'quality.clouds="original"' --set "clouds.original_light=\"$light\"" || return 1
    done
    for light in advance real_time combined; do
        paste "$folder/none" "$folder/$light" |
            awk -v light=$light '$2 > $1 + 1e-6 { brighter++ } $2 < $1 - 0.01 { darker++ }
                END { print light, brighter + 0, "brighter", darker + 0, "darker"; exit !(brighter == 0 && darker > 100) }' || return 1
    done
    # all of the sun's 0.5 where the march ends in the cloud, whatever its way there
    sort -g "$folder/none" | tail -1 | awk '{ print "largest", $1; exit !($1 > 0.44 && $1 <= 0.5001) }' &&
        ! cmp -s "$folder/advance" "$folder/real_time" && ! cmp -s "$folder/advance" "$folder/combined"
}

# The same place of a turned scene: the eye a quarter around the axis of a cloud that is as wide as long.
flat_turns_with_the_eye() {
    set -- --set 'quality.clouds="billboard"' --set 'cloud.c.size=[1500, 700, 1500]'
    picture front "$@" && picture side "$@" --set 'camera.position=[30000, 750, 0]' &&
        paste "$folder/front" "$folder/side" | awk '
            $1 > 0.01 { seen++ } { d = $1 - $2; if (d < 0) d = -d; if (d > worst) worst = d }
            END { print seen + 0, "seen, worst", worst; exit !(seen > 300 && worst < 0.004) }'
}

# Seen from straight above, of the white ground of a sky behind dark clouds a sheet without noise lets through what the
# marched cloud does: the picture is the transmittance.
sheet_takes_what_the_cloud_does() {
    set -- --set 'sky.color=[1, 1, 1]' --set light.intensity=0 --set cloud.c.detail=0 --set cloud.c.density=0.1 \
        --set quality.cloud_error=0.002 --set quality.cloud_light_scale=1 --set 'camera.position=[0, 30000, 1]' --set 'camera.target=[0, 400, 0]'
    picture marched "$@" --set 'quality.clouds="single"' && picture sheet "$@" --set 'quality.clouds="layers"' &&
        paste "$folder/marched" "$folder/sheet" | awk '
            $1 < 0.9 { dark++ } { d = $1 - $2; sum += d; if (d < 0) d = -d; all += d; n++; if (d > worst) worst = d }
            END { print dark + 0, "dark, off by", sum / n, "on average,", all / n, "each, worst", worst
                  exit !(dark > 300 && sum / n < 0.005 && sum / n > -0.005 && all / n < 0.01 && worst < 0.1) }'
}

one_hash_a_model() {
    for model in original billboard forward sprites groups layers; do
        "$lom" render "$folder/scene.toml" --hash --set "quality.clouds=\"$model\"" --lanes 4 --threads 1 >"$folder/one" || return 1
        for other in '--lanes auto --threads 2' '--lanes 4 --threads 5'; do
            # shellcheck disable=SC2086
            "$lom" render "$folder/scene.toml" --hash --set "quality.clouds=\"$model\"" $other >"$folder/other" || return 1
            cmp "$folder/one" "$folder/other" || { echo "$model $other"; return 1; }
        done
    done
}

check phases_have_their_limits limits_of_phases
check rayleigh_is_three_quarters_of_one_and_mu_squared rayleigh
check original_is_brightest_when_white white_is_brightest
check flat_cloud_turns_with_the_eye flat_turns_with_the_eye
check sheet_takes_what_the_cloud_does sheet_takes_what_the_cloud_does
check one_hash_a_model_of_clouds one_hash_a_model
exit $failures
