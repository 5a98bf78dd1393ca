#!/bin/sh
# Proves that a scene is the same picture, within 2 of 255, wherever in the world it lies and whatever its scale: scenes
# of every kind are moved by 2^10 .. 2^27 m along each axis together with their camera, and drawn a thousand times
# smaller and larger with it. A picture of one colour, or equal to that of an empty scene, would prove nothing and fails.
# Gravity is 9.81 m/s^2 at every scale, so what moves by it is scaled as Froude did: times and speeds go with the root of
# lengths. The sea's wind has a range, 0.1 to 100 m/s, which leaves it a hundred times smaller and larger.
. "$(dirname "$0")/render.sh"
scene=$folder/places.toml
pool_heights

# A scene is written with places {p X Y Z}, of which {y Y} and {xz X Z} are parts, lengths {l A B ...}, what is per
# length {per A}, times and speeds {t A B ...}: at the move (metres an axis) and the scale these become numbers.
at_move_and_scale() {
    awk -v s="$scale" -v m="$move" 'BEGIN { split(m, by, " ") }
    function number(x) { return sprintf("%.15g", x) }
    function numbers(word, kind, n, a, i, text) {
        n = split(word, a, " "); kind = a[1]
        if (kind == "p") return "[" number(a[2] * s + by[1]) ", " number(a[3] * s + by[2]) ", " number(a[4] * s + by[3]) "]"
        if (kind == "xz") return "[" number(a[2] * s + by[1]) ", " number(a[3] * s + by[3]) "]"
        if (kind == "y") return number(a[2] * s + by[2])
        if (kind == "per") return number(a[2] / s)
        for (i = 2; i <= n; i++) text = text (i > 2 ? ", " : "") number(a[i] * (kind == "t" ? sqrt(s) : s))
        return text
    }
    { while (match($0, /[{][^}]*[}]/))
          $0 = substr($0, 1, RSTART - 1) numbers(substr($0, RSTART + 1, RLENGTH - 2)) substr($0, RSTART + RLENGTH)
      print }'
}

entity() { # name, mesh, place, turn
    printf '[[entity]]\nname = "%s"\nmesh = "%s/assets/entities/%s.obj"\nposition = %s\nrotation = [0, %s, 0]\nscale = [%s]\n' \
        "$1" "$PWD" "$2" "$3" "$4" "{l 1 1 1}"
}
camera() { # place, yaw, pitch
    printf '[output]\nwidth = 64\nheight = 40\n[camera]\nposition = %s\nyaw = %s\npitch = %s\nnear = %s\n' \
        "$1" "$2" "$3" "{l 0.1}"
}
sky() { printf '[light]\nelevation = %s\nazimuth = 60\n[sky]\ngradient = true\n' "$1"; }
haze() { printf '[haze]\ndensity = %s\nbase = %s\nheight = %s\n' "{per 0.01}" "{y 0}" "{l 5}"; }
houses() {
    entity house cabin "{p 0 0 0}" 30
    entity stone boulder "{p 4 0 1}" 10
    entity wall cabin "{p -6 -0.5 -7}" 80
}
water() { # model, waves
    printf '[water]\nlevel = %s\nposition = %s\nsize = [%s]\ntile = %s\nshore_depth = %s\n' \
        "{y 0.3}" "{xz 0 0}" "{l 60 60}" "{l 3}" "{l 1}"
    printf 'waves.kind = "%s"\nwaves.height = %s\nwaves.length = [%s]\nwaves.count = 6\nwaves.patch = %s\n' \
        "$2" "{l 0.05}" "{l 4 1}" "{l 16}"
    printf 'waves.size = 64\nwaves.cascades = 2\nwaves.wind_speed = %s\nwaves.fetch = %s\nwaves.speed = %s\n' \
        "{t 3}" "{l 100000}" "{t 0.6}"
    printf 'optics.absorption = [%s, %s, %s]\nfoam.amount = 1\nfoam.tile = %s\nfoam.shore_depth = %s\nfoam.window = %s\n' \
        "{per 0.4}" "{per 0.1}" "{per 0.08}" "{l 2}" "{l 0.09}" "{t 1}"
    printf '[quality]\nwater = "%s"\nentity_shadows = 256\n' "$1"
}

write_entities() { camera "{p 1 3 12}" 3 -12; sky 35; haze; houses; printf '[quality]\nentity_shadows = 256\n'; }
write_flat() { write_entities; echo 'shading = "flat"'; }
write_gouraud() { write_entities; echo 'shading = "gouraud"'; }
write_follow() {
    camera "[{l 2 3 11}]" 5 -12
    printf 'follow = "house"\nperson = "third"\n'
    sky 35
    houses
}
ground() { # the terrain's middle is at x = z = 0: it moves up and down
    camera "{p -3 2.2 14}" 8 -9
    sky 20
    printf '[terrain]\nheight_map = "height.pgm"\nsize = [%s]\nheight = %s\nbase = %s\n' "{l 80 80}" "{l 14}" "{y -3}"
    printf 'tile = %s\n[[terrain.layer]]\nmap = "%s/assets/terrain/rock.png"\nmapping = "triplanar"\ntile = %s\n' \
        "{l 7}" "$PWD" "{l 6}"
    printf 'from_height = %s\nblend = %s\n' "{y 0}" "{l 1}"
    entity stone boulder "{p -4 0.4 5}" 20
}
write_terrain() { ground; printf '[quality]\nterrain_shadows = true\nentity_shadows = 256\n'; }
write_pool() { ground; water "$model" gerstner; echo 'terrain_shadows = true'; }
write_water() { camera "{p 1 3 12}" 3 -12; sky 35; houses; water "$model" "$waves"; }
write_clouds() {
    camera "{p 1 30 120}" 3 2
    sky 50
    printf '[[cloud]]\nposition = %s\nsize = [%s]\nseed = 3\nextinction = %s\ndetail_size = %s\n' \
        "{p 0 60 -60}" "{l 100 40 90}" "{per 0.2}" "{l 80}"
    water tinted gerstner
    printf 'impostors = "%s"\n' "$impostors"
}
write_spray() {
    camera "{p 0 2 9}" 0 -5
    sky 35
    printf '[[spray]]\nname = "drops"\ncount = 300\nfrom = %s\nto = %s\nvelocity = [%s]\nspread = %s\n' \
        "{p -1 0 0}" "{p 1 0 0}" "{t 0 4 0}" "{t 1}"
    printf 'life = %s\nsize = [%s]\nsoft = %s\nstretch = %s\nopacity = 0.8\n' "{t 2}" "{l 0.1 0.3}" "{l 0.3}" "{t 0.02}"
}

draw() { # picture
    "write_$kind" | at_move_and_scale >"$scene"
    "$lom" render "$scene" -o "$1" --threads 1 --quiet >"$folder/log" 2>&1
}

same() { # name: the picture at this move and scale is that of the scene as it is
    if ! draw "$folder/there.png"; then
        why="it is not drawn: $(head -n 1 "$folder/log")"
    elif ! "$lom" compare "$folder/here.png" "$folder/there.png" --max-delta 2 --max-diff-pixels "$spared" >"$folder/log"; then
        why="$(grep largest "$folder/log"), $(grep differing "$folder/log")"
    else
        why=
    fi
    verdict "$1" "$why"
}

moves() { # name, axes that it moves along (0 or 1 each)
    spared=0
    for power in 10 17 20 27; do
        scale=1 move=$(awk -v p=$power "BEGIN { split(\"$2\", a, \" \"); m = 2 ^ p; print m * a[1], m * a[2], -m * a[3] }")
        same "$1_moved_by_2_to_the_$power"
    done
}
scales() { # name, scales
    spared=2 # edges that fall through a pixel's centre
    for by in $2; do
        scale=$by move='0 0 0'
        same "$1_at_scale_$by"
    done
}
try() { # name, axes, scales
    scale=1 move='0 0 0'
    draw "$folder/here.png" || { verdict "$1" "it is not drawn: $(head -n 1 "$folder/log")"; return; }
    "$lom" render "$scene" -o "$folder/checked.png" --check --threads 1 --quiet >"$folder/log" 2>&1 ||
        verdict "$1" "$(head -n 1 "$folder/log")"
    moves "$1" "$2"
    scales "$1" "$3"
}

all='1e-3 0.1 10 1e3'
for kind in entities flat gouraud follow; do
    try $kind '1 1 1' "$all"
done
kind=terrain
try terrain '0 1 0' "$all"
kind=pool
for model in planar marched; do
    try "pool_$model" '0 1 0' "$all"
done
kind=water waves=gerstner
for model in tinted planar normal_map displaced marched; do
    try "water_$model" '1 1 1' "$all"
done
model=displaced waves=flow
try water_flow '1 1 1' "$all"
waves=sea
try water_sea '1 1 1' '1e-2 0.1 10 100'
kind=clouds
for impostors in off reference bounded; do
    try "clouds_impostors_$impostors" '1 1 1' "$all"
done
kind=spray
try spray '1 1 1' "$all"

# Planar water over no bed has no shore to fade at, however near the near plane is.
for near in 1 1e-2 1e-5; do
    cat >"$scene" <<END
[output]
width = 64
height = 40
[camera]
position = [0, 3000, 0]
pitch = -3
near = $near
[sky]
color = [1, 0, 0]
[water]
size = 1000000
[quality]
water = "planar"
END
    why=
    "$lom" render "$scene" -o "$folder/soft.png" --threads 1 --quiet &&
        "$lom" render "$scene" -o "$folder/hard.png" --threads 1 --quiet --set water.soft_shore=false || why='not drawn'
    cmp -s "$folder/soft.png" "$folder/hard.png" || why="${why:-water far away fades out}"
    verdict "water_to_the_horizon_with_near_$near" "$why"
done

# Terrain's shadow is seen at every scale.
kind=terrain move='0 0 0'
for scale in 1e-3 1 1e3; do
    why=
    draw "$folder/on.png" && "$lom" render "$scene" -o "$folder/off.png" --threads 1 --quiet \
        --set quality.terrain_shadows=false || why='not drawn'
    "$lom" compare "$folder/on.png" "$folder/off.png" --max-delta 40 >"$folder/log" && why="${why:-it changes nothing}"
    verdict "terrain_shadow_at_scale_$scale" "$why"
done
