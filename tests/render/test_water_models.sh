#!/bin/sh
# Proves of each model of water, on a small pool among hills: one hash for every lane width and thread count; a
# crop is the cut-out of the whole; a frame alone is the frame of a run; the scissor of the pictures that it looks up, and what
# they begin with, change no byte; and no pass runs that the picture cannot show. The models differ, from each other and from below.
. "$(dirname "$0")/render.sh"
scene=$folder/pool.toml
pool_heights
cat >"$scene" <<END
[camera]
position = [-3, 0.9, 14]
yaw = 8
pitch = -7
[light]
azimuth = 20
elevation = 20
[sky]
color = [0.4, 0.6, 0.9]
[terrain]
height_map = "height.pgm"
size = [80, 80]
height = 14
base = -3
[water]
clip_offset = 0.05
waves.kind = "gerstner"
waves.height = 0.3
foam.amount = 1
foam.shore_depth = 1
[[entity]]
mesh = "$PWD/assets/entities/boulder.obj"
position = [-2, -0.2, 8]
END
draw() { "$lom" render "$scene" --size 160x90 --set quality.water=$model "$@"; }
plan() { "$lom" plan "$scene" --size 160x90 --set quality.water=$model "$@" | sed '/^dials/,$d'; } # of the frame alone

seen=
for model in tinted planar normal_map displaced marched; do
    one_hash one_hash_for_lanes_and_threads_$model
    crops crop_is_the_cut_out_$model
    case " $seen " in *" $whole "*) why="$model draws what another model draws" ;; *) why= ;; esac
    verdict models_differ_$model "$why"
    seen="$seen $whole"
    [ "$(hash --set quality.scissor=false)" = "$whole" ] && why= || why='the scissor changes the picture'
    verdict the_scissor_changes_no_byte_$model "$why"
    why=$(plan --set camera.pitch=70 | grep -E '^\*  (reflection|refraction)')
    verdict no_water_in_view_costs_no_pass_$model "$why"
done

# Rays that are not bent see behind the surface what the frame shows there, unless the bed has a light of its own.
triangles() { draw --stats - --hash --set camera.pitch=-40 "$@" | sed -n 's/.*"triangles": \([0-9]*\),.*/\1/p'; }
model=normal_map why=
again='--set water.optics.caustics=1'
[ "$(hash $again)" = "$(hash $again --set quality.scissor=false)" ] || why='a bed in caustics is copied from one without'
copied=$(triangles) drawn=$(triangles $again)
[ $((copied - drawn)) = 1 ] || why="$copied triangles and $drawn: the copy is two of them, photons are one"
verdict what_the_frame_shows_behind_the_surface_is_copied "$why"

# The scene is not shaded where waves will cover it: whatever the eye sees of them, at every width, and less is shaded.
packets() { draw --stats - --hash "$@" | sed -n 's/.*"packets": \([0-9]*\),.*/\1/p'; }
for model in displaced marched; do
    why=
    for look in '--set camera.pitch=-40' '--set camera.pitch=-89' '--set camera.roll=35 --set camera.pitch=-15' \
        '--set camera.position=[0,0.45,9]' '--set camera.position=[0,300,0] --set camera.pitch=-75' \
        '--set water.size=[20,9] --set camera.pitch=-30' '--set water.size=[9,60] --set camera.position=[-3,2,9]' \
        '--set camera.field_of_view=140 --set camera.pitch=-20' '--set camera.near=0.001' '--set output.samples=4'; do
        for lanes in 4 8; do
            less=$(hash $look --lanes $lanes) all=$(hash $look --lanes $lanes --set quality.scissor=false)
            [ -n "$less" ] && [ "$less" = "$all" ] || why="$look: $less with $lanes lanes, not $all"
        done
    done
    case $(plan --set camera.pitch=-40) in *'below the waves'*) ;; *) why='the plan does not say what is left out' ;; esac
    case $(plan --set camera.position=[40.5,2,0]) in *'below the waves'*) why='an eye beside the water has a lid' ;; esac
    less=$(packets --set camera.pitch=-40) all=$(packets --set camera.pitch=-40 --set quality.scissor=false)
    [ "$less" -lt "$all" ] || why="$less packets, not less than $all"
    verdict what_waves_cover_is_not_shaded_$model "$why"
done

# Schlick's approximation is near the exact reflectance, the mix of the reference works is not, in each of them.
for model in normal_map displaced marched; do
    for fresnel in exact schlick dot; do draw --set water.optics.fresnel=$fresnel -o "$folder/$fresnel.ppm"; done
    error() { "$lom" compare "$folder/exact.ppm" "$folder/$1.ppm" --json | sed 's/.*"rmse": \([0-9.]*\).*/\1/'; }
    why=$(awk -v near="$(error schlick)" -v far="$(error dot)" 'BEGIN { if (!(near > 0 && near < 3 && far > 2 * near)) print near " and " far }')
    verdict reflectances_differ_as_they_should_$model "$why"
done

# What nothing focuses is no pass, and the plan says why.
model=displaced
optics='--set water.optics.caustics=1'
case $(plan $optics) in *'*  caustics'*) why= ;; *) why='no caustics under waves' ;; esac
case $(plan $optics --set water.waves.kind=none) in *'still water focuses no light'*) ;; *) why='caustics of still water' ;; esac
case $(plan $optics --set light.elevation=1) in *'the sun is too low'*) ;; *) why='caustics of a low sun' ;; esac
case $(plan --set water.optics.caustics=0) in *'water.optics.caustics is 0'*) ;; *) why='caustics of factor 0' ;; esac
verdict caustics_only_where_light_is_focused "$why"

for model in normal_map displaced marched; do
    frame_alone a_frame_alone_is_the_frame_of_a_run_$model
    below="--set camera.position=[-3,-1,14]"
    [ "$(hash $below --lanes 4 --threads 2)" = "$(hash $below --lanes $widest)" ] && why= || why='lanes change the picture'
    case $(plan $below) in *'*  underwater'*) ;; *) why='no water between the eye and the scene' ;; esac
    verdict seen_from_below_$model "$why"
done

model=displaced
sea='--set water.waves.kind=sea --set water.waves.size=64'
[ "$(hash $sea --lanes 4 --threads 1)" = "$(hash $sea --lanes $widest --threads 3)" ] && why= || why='lanes change the picture'
[ "$(hash $sea --frame 3)" = "$(draw $sea --frames 2:3 --hash | sed -n 's/  frame 3$//p')" ] || why='a frame is another in a run'
verdict the_sea_has_one_hash_and_any_frame_alone "$why"

# 8 fields a cascade, and 3 of them at each of 3 moments for foam; places are 3 of the 8.
transforms() { draw $sea --stats - -o "$folder/seen.ppm" "$@" | sed 's/.*"transforms": \([0-9]*\).*/\1/'; }
why=
up='--set camera.pitch=70 --set camera.position=[-3,9,14]' high='--set camera.pitch=70 --set camera.position=[-3,500,14]'
[ "$(transforms)" = 51 ] || why='three cascades and their foam are not 51 transforms'
[ "$(transforms --set water.foam.amount=0)" = 24 ] || why='three cascades are not 24 transforms'
[ "$(transforms --set water.waves.height_scale=0)" = 0 ] || why='a calm sea is transformed'
[ "$(transforms $up)" = 9 ] || why='an eye among what waves could be needs more than their places to see none'
[ "$(transforms $high)" = 0 ] || why='an eye above all waves that looks up transforms a sea'
case $(plan $sea $high) in *'-  waves '*'no cascade is advanced'*) ;; *) why='the plan does not say why' ;; esac
for look in "$up" "$high"; do
    [ "$(hash $sea $look)" = "$(hash $sea $look --set water.enabled=false)" ] || why='a sea that is not seen changes bytes'
done
verdict a_sea_that_is_not_seen_is_not_transformed "$why"

sed '/terrain/,/^base/d; /entity/,$d' "$scene" >"$folder/open.toml"
case $("$lom" plan "$folder/open.toml" --set quality.water=displaced | sed '/^dials/,$d') in
    *'*  reflection'* | *'*  refraction'*) why='a picture is drawn of nothing' ;;
    *'*  water'*) why= ;;
    *) why='no water is drawn' ;;
esac
verdict open_water_needs_no_picture_of_the_scene "$why"
