#!/bin/sh
# bench/filtering.sh [--size WxH] [--frames N] [--lanes "L..."] [--output FILE] [SCENE...]
# Error against time of quality.filtering and quality.march: every scene in float and in fixed point, the two drawn in
# turn. Errors are those of frame 0 to the picture in float; times the least of frames 0 to N - 1 of two turns with one
# thread, in float over fixed. LOM names another program than build/lom.
cd "$(dirname "$0")/.." || exit 2
lom=${LOM:-${BUILD:-build}/lom} size=640x360 frames=3 lanes='8 4' output=bench/results/filtering.md scenes=''
while [ $# -gt 0 ]; do
    case $1 in
    --size) size=$2; shift ;;
    --frames) frames=$2; shift ;;
    --lanes) lanes=$2; shift ;;
    --output) output=$2; shift ;;
    -*) echo "bench/filtering.sh: there is no option $1." >&2; exit 2 ;;
    *) scenes="$scenes $1" ;;
    esac
    shift
done
[ -x "$lom" ] || { echo "bench/filtering.sh: there is no $lom; run make first." >&2; exit 2; }
[ -n "$scenes" ] || scenes=$(cd assets/scenes && ls -- *.toml | sed 's/\.toml$//')
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 2' INT TERM

dials() { # name of a setting
    case $1 in
    float) echo "--set quality.filtering=float --set quality.march=float" ;;
    filtering) echo "--set quality.filtering=fixed --set quality.march=float" ;;
    march) echo "--set quality.filtering=float --set quality.march=fixed" ;;
    both) echo "--set quality.filtering=fixed --set quality.march=fixed" ;;
    esac
}
draw() { # scene, setting
    # shellcheck disable=SC2046
    "$lom" render "assets/scenes/$1.toml" --size "$size" $(dials "$2") -o "$work/$2.png" --quiet || exit 2
}
field() { sed -n 's/.*"'"$1"'": *\([^,}]*\).*/\1/p' "$2"; }
difference() { # setting: PSNR, FLIP, largest difference
    "$lom" compare "$work/float.png" "$work/$1.png" --metrics --json >"$work/json"
    if [ "$(field psnr "$work/json")" = null ]; then echo "same | | |"; else
        echo "$(field psnr "$work/json") $(field flip "$work/json") $(field max_delta "$work/json")" |
            awk '{ printf "%.1f | %.5f | %d |", $1, $2, $3 }'
    fi
}
run() { # scene, setting, lanes: appends the times of its frames
    # shellcheck disable=SC2046
    "$lom" render "assets/scenes/$1.toml" --size "$size" $(dials "$2") --threads 1 --lanes "$3" --frames "0:$((frames - 1))" \
        --quiet --stats "$work/stats" || exit 2
    field ms "$work/stats" >>"$work/times-$2"
}
measure() { # scene, lanes: milliseconds in float and in fixed point, and their ratio
    rm -f "$work"/times-*
    for turn in 1 2; do run "$1" float "$2"; run "$1" both "$2"; done
    echo "$(sort -n "$work/times-float" | head -n 1) $(sort -n "$work/times-both" | head -n 1)" |
        awk '{ printf " %.1f | %.1f | %.2f |", $1, $2, $1 / $2 }'
}
{
    echo '# Filtering and marching in fixed point: error against time'
    echo
    echo "$(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $("$lom" version | sed -n 's/^ *compiler *//p');"
    echo "repeat: \`bench/filtering.sh --size $size --frames $frames --lanes \"$lanes\"\`. PSNR in dB, ꟻLIP and the largest difference (of 255)"
    echo 'to the same frame in float; milliseconds a frame by one thread, least of the runs in turn, and float over fixed.'
    echo
    head='| scene | filtering: PSNR | ꟻLIP | largest | march: PSNR | ꟻLIP | largest | both: PSNR | ꟻLIP | largest |' rule='|---|---|---|---|---|---|---|---|---|---|'
    for l in $lanes; do head="$head $l lanes: float | fixed | ratio |" rule="$rule---|---|---|"; done
    echo "$head"
    echo "$rule"
    for scene in $scenes; do
        for setting in float filtering march both; do draw "$scene" $setting; done
        line="| $scene | $(difference filtering) $(difference march) $(difference both)"
        for l in $lanes; do line="$line$(measure "$scene" "$l")"; done
        echo "$line"
        echo "$line" >&2
    done
} >"$output"
echo "$output"
