#!/bin/sh
# bench/sea.sh [--frames N] [--threads N] [--output FILE]
# The time of every stage of a sea of four cascades of 512 x 512, stepped and drawn at 1280x720 (the gale's scene, with
# and without foam, which looks at three earlier moments): the median of N frames. LOM names another program than
# build/lom.
cd "$(dirname "$0")/.." || exit 2
lom=${LOM:-${BUILD:-build}/lom} frames=15 threads=1 output=bench/results/sea.md
while [ $# -gt 1 ]; do
    case $1 in
    --frames) frames=$2 ;;
    --threads) threads=$2 ;;
    --output) output=$2 ;;
    *) echo "bench/sea.sh: there is no option $1." >&2; exit 2 ;;
    esac
    shift 2
done
[ -x "$lom" ] || { echo "bench/sea.sh: there is no $lom; run make first." >&2; exit 2; }
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT

median() { # statistics, key
    sed -n 's/.*"'"$2"'": *\([^,}]*\).*/\1/p' "$1" | sort -n | awk '{ at[NR] = $1 } END { printf "%.1f", at[int((NR + 1) / 2)] }'
}
for foam in 1 0; do
    "$lom" render assets/scenes/gale.toml --size 1280x720 --threads "$threads" --frames "0:$((frames - 1))" --quiet \
        --set water.waves.cascades=4 --set water.waves.size=512 --set water.foam.amount=$foam --hash --stats "$work/$foam" >/dev/null || exit 2
done
row() { # what, key
    echo "| $1 | $(median "$work/1" "$2") | $(median "$work/0" "$2") |"
}
{
    echo '# A sea of 512 x 512 samples and four cascades at 1280x720'
    echo
    echo "$(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), threads: $threads; repeat: \`make bench-sea\` or"
    echo "\`bench/sea.sh --frames $frames --threads $threads\`. Median milliseconds of $frames frames (\`render --stats -\`) of assets/scenes/gale.toml."
    echo
    echo '| stage | with foam | without |'
    echo '|---|---|---|'
    row 'places of all waves: heights and displacements (`ms_waves`)' ms_waves
    row 'terrain, entities and sky (`ms_scene`)' ms_scene
    row 'where the sea is seen; slopes, Jacobian, foam of earlier moments, textures with levels (`ms_sea_waves`)' ms_sea_waves
    row 'pictures of the scene, and the surface as a mesh (`ms_sea`)' ms_sea
    row 'encoding (`ms_output`)' ms_output
    row '**the frame**' ms
    row 'transforms of 512 x 512 (`transforms`)' transforms
} >"$output"
echo "$output"
