#!/bin/sh
# Proves of water with waves what the eye saw wrong once, by numbers of pictures: a still surface is the same on the mesh
# as on two triangles, at the horizon and at its corners; no pixel of it is much darker than all that are beside it; what
# it mirrors has no teeth; the foam of a far shore is one line, and so is the shore behind an island; outside of Snell's window nothing is drawn out in streaks,
# and within it the shore is whole; behind a boat there is no patch; the ripples of still water show in every model; black of a flow map moves nothing; a
# boat stays in its picture.
. "$(dirname "$0")/render.sh"
scenes=assets/scenes
flat() { # SCENE and options: largest difference of the mesh and the two triangles, in levels
    for model in displaced normal_map; do
        "$lom" render "$scenes/$1" --size 320x180 --set quality.water=$model --set output.edges=sharp -o "$folder/$model.ppm" -q ${2:+$2 $3 $4 $5 $6 $7 $8 $9}
    done
    "$lom" compare "$folder/displaced.ppm" "$folder/normal_map.ppm" --json | sed 's/.*"max_delta": \([0-9]*\).*/\1/'
}
why=
for view in "gale.toml --set water.waves.wind_level=calm" "swell.toml --set water.waves.height=0 --set camera.yaw=0" \
    "swell.toml --set water.waves.height=0 --set camera.yaw=45 --set water.size=[300,300]"; do
    # shellcheck disable=SC2086
    most=$(flat $view)
    [ "${most:-99}" -le 4 ] || why="$view differ by $most"
done
verdict still_water_ends_where_its_quad_does "$why"

# Of a crop's gray: pixels that are $2 levels darker than their 8 neighbours, that are as far from both beside them to the
# same side, that are as the one above, and that are as much lighter than the one above and the one below.
count() { # dark|teeth|streaks|dashes LEVELS SCENE --size WxH --crop X,Y,W,H and options
    what=$1 levels=$2 scene=$3
    shift 3
    "$lom" render "$scenes/$scene" "$@" -q -o "$folder/crop.ppm" && "$lom" convert "$folder/crop.ppm" "$folder/crop.pgm" &&
        python3 - "$folder/crop.pgm" "$what" "$levels" <<'CODE'
import sys
data = open(sys.argv[1], "rb").read()
width, height = map(int, data.split(None, 4)[1:3])
rows = [data[len(data) - width * (height - y):][:width] for y in range(height)]
what, levels, found = sys.argv[2], int(sys.argv[3]), 0
for y in range(1, height - 1):
    for x in range(1, width - 1):
        c, beside = rows[y][x], (rows[y][x - 1], rows[y][x + 1])
        around = beside + tuple(rows[y + j][x + i] for j in (-1, 1) for i in (-1, 0, 1))
        found += {"dark": c <= min(around) - levels, "streaks": abs(c - rows[y - 1][x]) < levels,
                  "teeth": c <= min(beside) - levels or c >= max(beside) + levels,
                  "dashes": c >= max(rows[y - 1][x], rows[y + 1][x]) + levels}[what]
print(found)
CODE
}
few() { # name, how many at most, what count takes
    name=$1 most=$2
    shift 2
    found=$(count "$@")
    [ "${found:-999999}" -le "$most" ] && why= || why="$found, at most $most: $*"
    verdict "$name" "$why"
}
few what_a_rough_sea_mirrors_is_no_single_pixels 12 dark 8 sunset.toml --size 640x360 --crop 10,200,200,110
few crests_far_away_are_no_single_pixels 8 teeth 4 surf.toml --frame 60 --size 960x540 --crop 540,206,420,30
few the_mirror_behind_reeds_has_no_specks 10 dark 12 tarn.toml --size 960x540 --crop 740,340,160,30
few the_mirror_has_no_teeth 20 teeth 12 cove.toml --frame 30 --size 1280x720 --crop 850,370,300,100
few a_far_shore_is_no_dashes 35 dashes 40 surf.toml --frame 60 --size 960x540 --crop 205,225,60,40
few a_bed_that_an_island_hides_is_no_dashes 100 dashes 8 flight.toml --size 960x540 --crop 800,392,150,18
few outside_of_the_window_nothing_is_drawn_out 200 streaks 1 reef.toml --size 640x360 --crop 578,0,50,24

# What stands on the shore, at the rim of the window, where rays are bent the farthest: still water against the reference.
rim() { "$lom" render $scenes/reef.toml --size 960x540 --crop 820,0,60,22 -q --set water.waves.height=0 --set water.optics.roughness=0 \
    --set water.optics.caustics=0 "$@"; }
rim -o "$folder/rim.ppm" && rim --set quality.water=reference --set quality.reference.samples=4 -o "$folder/traced.ppm"
decibels=$("$lom" compare "$folder/traced.ppm" "$folder/rim.ppm" --json | sed 's/.*"psnr": \([0-9]*\)\..*/\1/')
[ "${decibels:-0}" -ge 30 ] && why= || why="$decibels dB, not 30"
verdict the_shore_in_the_window_is_whole "$why"

# Behind a boat the water is as without it: the mirror does not know what the boat hides of it.
beyond() { "$lom" render $scenes/cumulus.toml --size 960x540 --crop 550,388,70,40 -q "$@"; }
beyond -o "$folder/with.ppm" && beyond --set 'entity.boat.position=[500,-300,500]' -o "$folder/without.ppm"
decibels=$("$lom" compare "$folder/with.ppm" "$folder/without.ppm" --json | sed 's/.*"psnr": \([0-9]*\)\..*/\1/')
[ "${decibels:-0}" -ge 28 ] && why= || why="$decibels dB, not 28"
verdict the_water_behind_a_boat_has_no_patch "$why"

# The lake's ripples: near the eye a picture with them is nearer to the reference than one without.
near_reference() { # MODEL NORMALS: dB
    "$lom" render $scenes/lake.toml --size 1280x720 --crop 300,600,200,100 --set "quality.water=$1" -q \
        --set "water.normals=$2" -o "$folder/ripples.ppm"
    "$lom" compare "$folder/traced.ppm" "$folder/ripples.ppm" --json | sed 's/.*"psnr": \([0-9]*\)\.\([0-9]\).*/\1\2/'
}
"$lom" render $scenes/lake.toml --size 1280x720 --crop 300,600,200,100 --set quality.water=reference \
    --set quality.reference.samples=4 -q -o "$folder/traced.ppm"
why=
for model in normal_map displaced marched; do
    with=$(near_reference $model true) without=$(near_reference $model false)
    [ "${with:-0}" -ge $((${without:-999} + 10)) ] || why="$why $model: $with tenths of a decibel, $without without;"
done
verdict still_water_has_the_ripples_of_its_normal_map "$why"

printf 'P6 2 2 255 \000\000\000\000\000\000\000\000\000\000\000\000' >"$folder/black.ppm"
flow() { "$lom" render $scenes/lake.toml --size 160x90 --hash --set "water.flow_map=$folder/black.ppm" "$@"; }
[ "$(flow)" = "$(flow --set water.flow_strength=0)" ] && why= || why='lookups are moved'
still() { sed "s|\"\.\./|\"assets/|; /^flow_map/d" $scenes/lake.toml | "$lom" render - --size 160x90 --hash --set water.flow=false "$@"; }
for model in planar displaced; do
    [ "$(flow --set quality.water=$model)" = "$(still --set quality.water=$model)" ] || why="in $model a black map is not none"
done
verdict black_of_a_flow_map_moves_nothing "$why"

red() { # FRAME: pixels of the wake's boat
    "$lom" render $scenes/wake.toml --size 160x90 --frame "$1" -q -o "$folder/wake.ppm" && python3 - "$folder/wake.ppm" <<'CODE'
import sys
data = open(sys.argv[1], "rb").read()[-160 * 90 * 3:]
print(sum(data[i] > 90 and data[i] > 2 * data[i + 1] and data[i] > 2 * data[i + 2] for i in range(0, len(data), 3)))
CODE
}
why=
for frame in 0 60 120 239; do
    found=$(red $frame)
    [ "${found:-0}" -ge 4 ] || why="$why $found pixels in frame $frame;"
done
verdict the_boat_stays_in_the_picture_of_its_wake "$why"
