#!/bin/sh
# bench/impostors.sh [--frames N] [--threads N] [--output FILE]
# The time of every stage of a flight past 30 clouds on impostors at 1280x720 (assets/scenes/clouds-30.toml): mean,
# median and longest of frames 1 to N - 1; frame 0 makes every plate and is given by itself. LOM names another program
# than build/lom.
cd "$(dirname "$0")/.." || exit 2
lom=${LOM:-${BUILD:-build}/lom} frames=300 threads=2 output=bench/results/impostors.md
while [ $# -gt 1 ]; do
    case $1 in
    --frames) frames=$2 ;;
    --threads) threads=$2 ;;
    --output) output=$2 ;;
    *) echo "bench/impostors.sh: there is no option $1." >&2; exit 2 ;;
    esac
    shift 2
done
[ -x "$lom" ] || { echo "bench/impostors.sh: there is no $lom; run make first." >&2; exit 2; }
statistics=$(mktemp) || exit 2
trap 'rm -f "$statistics"' EXIT
"$lom" render assets/scenes/clouds-30.toml --size 1280x720 --threads "$threads" --frames "0:$((frames - 1))" --quiet \
    --stats "$statistics" || exit 2

field() { # key: a line a frame
    sed -n 's/.*"'"$1"'": *\([^,}]*\).*/\1/p' "$statistics"
}
row() { # what, key
    first=$(field "$2" | head -n 1)
    field "$2" | tail -n +2 | sort -n | awk -v what="$1" -v first="$first" '
        { at[NR] = $1; sum += $1 }
        END { printf "| %s | %.1f | %.1f | %.1f | %.1f |\n", what, first, sum / NR, at[int((NR + 1) / 2)], at[NR] }'
}
{
    echo '# Thirty clouds on impostors, a moving camera'
    echo
    echo "$(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), threads: $threads; repeat: \`make bench-impostors\` or"
    echo "\`bench/impostors.sh --frames $frames --threads $threads\`. Milliseconds of a frame of assets/scenes/clouds-30.toml at 1280x720,"
    echo "\`quality.impostors = \"bounded\"\` (a plate is made anew when its error passes one pixel)."
    echo
    echo '| stage | frame 0 | mean | median | longest |'
    echo '|---|---|---|---|---|'
    row 'shadows of the clouds (`ms_cloud_light`)' ms_cloud_light
    row 'sky (`ms_scene`)' ms_scene
    row 'waves (`ms_waves`)' ms_waves
    row 'slopes of the sea (`ms_sea_waves`)' ms_sea_waves
    row 'the sea (`ms_sea`)' ms_sea
    row 'plates made anew, and all plates shown (`ms_clouds`)' ms_clouds
    row 'encoding (`ms_output`)' ms_output
    row '**the frame**' ms
    row 'plates shown (`impostors_shown`)' impostors_shown
    row 'plates made anew (`impostors_refreshed`)' impostors_refreshed
    echo
    echo "Frames a second: $(field ms | tail -n +2 | awk '{ sum += $1 } END { printf "%.1f", 1000 * NR / sum }') in the mean."
} >"$output"
echo "$output"
