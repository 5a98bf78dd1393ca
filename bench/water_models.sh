#!/bin/sh
# bench/water_models.sh [--size WxH] [--frames N] [--samples N] [--output FILE] [--pictures DIR] [SCENE]...
# Draws scenes of water with every model and with the reference (rays in double precision), and writes a Markdown table:
# the least milliseconds of N frames on one thread, and how far the first frame is from the reference; and the models
# side by side as docs/pictures/water-SCENE.png. Caustics, foam and drops are off: the reference lights the bed through a level
# surface and has no foam and no drops. With --pictures nothing is measured: DIR/water-SCENE.png alone are drawn. LOM names
# another program than build/lom.
cd "$(dirname "$0")/.." || exit 2
lom=${LOM:-${BUILD:-build}/lom} size=320x180 frames=8 samples=32 output=bench/results/water-models.md scenes='' pictures=''
usage() { echo "bench/water_models.sh: $1" >&2; sed -n 2p "$0" >&2; exit 2; }
while [ $# -gt 0 ]; do
    case $1 in
    --size) size=$2; shift 2 ;;
    --frames) frames=$2; shift 2 ;;
    --samples) samples=$2; shift 2 ;;
    --output) output=$2; shift 2 ;;
    --pictures) pictures=$2; shift 2 ;;
    -*) usage "there is no option $1." ;;
    *) scenes="$scenes $1"; shift ;;
    esac
done
[ -n "$scenes" ] || scenes='assets/scenes/lagoon.toml assets/scenes/swell.toml assets/scenes/gale.toml assets/scenes/cove.toml assets/scenes/reef.toml assets/scenes/surf.toml assets/scenes/wake.toml'
[ -x "$lom" ] || usage "there is no $lom; run make first."
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 2' INT TERM

field() { sed -n 's/.*"'"$1"'": *"\{0,1\}\([^",}]*\).*/\1/p'; }
draw() { # model, picture, other arguments: a line of statistics for each frame
    model=$1 picture=$2
    shift 2
    "$lom" render "$scene" --size "$size" --set "quality.water=\"$model\"" --set quality.filtering=float --set water.optics.caustics=0 \
        --set water.foam.amount=0 --set water.foam.shore_depth=0 --set quality.spray=false --quiet --stats - -o "$picture" "$@"
}
models='tinted planar normal_map displaced marched'
# The first frames of all models and of the reference (P6) in rows of three: the rows of pixels of each three are laid
# behind one another.
side_by_side() { # output
    joined=$1
    set --
    for model in $models reference; do set -- "$@" "$work/$model-0.ppm"; done
    width=${size%x*} height=${size#*x}
    printf 'P6\n%d %d\n255\n' $((3 * width)) $((height * $# / 3)) >"$work/joined.ppm"
    while [ $# -gt 0 ]; do
        mkdir "$work/rows"
        for column in 1 2 3; do
            tail -c $((3 * width * height)) "$1" | split -a 4 -b $((3 * width)) - "$work/rows/$column."
            shift
        done
        for row in "$work"/rows/1.*; do
            cat "$row" "$work/rows/2.${row##*.}" "$work/rows/3.${row##*.}"
        done >>"$work/joined.ppm"
        rm -r "$work/rows"
    done
    "$lom" convert "$work/joined.ppm" "$joined"
}
least() { field ms | sort -n | head -n 1 | awk '{ printf "%.1f", $1 }'; }

if [ -n "$pictures" ]; then
    for scene in $scenes; do
        for model in $models reference; do
            draw "$model" "$work/$model-0.ppm" --set "quality.reference.samples=$samples" >"$work/stats" || exit 2
        done
        side_by_side "$pictures/water-$(basename "$scene" .toml).png" || exit 2
    done
    exit 0
fi
{
    echo '# Water: every model against the reference'
    echo
    echo "$size, $(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), one thread (the reference: all); repeat:"
    echo "\`make bench-water-models\` or \`bench/water_models.sh --size $size --frames $frames --samples $samples\`. Milliseconds are the"
    echo "least of $frames frames; the reference has $samples rays a pixel. The errors are those of the whole picture, in which ground and sky"
    echo 'differ as well: the reference averages over a pixel, the models have one sample. The line `no water` says how much of each error'
    echo 'that is (the same scene without water, against its reference).'
} >"$work/table"
for scene in $scenes; do
    name=$(basename "$scene" .toml)
    printf '\n## %s\n\n| model | ms | PSNR, dB | SSIM | FLIP |\n|---|---|---|---|---|\n' "$name" >>"$work/table"
    for water in true false; do
        exact=$(draw reference "$work/reference-0.ppm" --set "quality.reference.samples=$samples" --set water.enabled=$water | least)
        [ $water = true ] && measured=$models || measured=planar
        for model in $measured; do
            draw "$model" "$work/$model-%d.ppm" --set water.enabled=$water --threads 1 --frames "0:$((frames - 1))" \
                >"$work/stats" || exit 2
            "$lom" compare "$work/reference-0.ppm" "$work/$model-0.ppm" --json --metrics >"$work/compared"
            for number in "$(least <"$work/stats")" "$(field psnr <"$work/compared")" "$(field ssim <"$work/compared")" \
                "$(field flip <"$work/compared")"; do echo "$number"; done |
                awk -v name="$([ $water = true ] && echo "$model" || echo 'no water')" 'NR == 1 { ms = $1 }
                    NR == 2 { psnr = $1 } NR == 3 { ssim = $1 }
                    NR == 4 { printf "| %s | %s | %.1f | %.3f | %.3f |\n", name, ms, psnr, ssim, $1 }' | tee -a "$work/table"
        done
        [ $water = true ] || continue
        echo "| reference | $exact | | | |" >>"$work/table"
        side_by_side "docs/pictures/water-$name.png" || exit 2
    done
done
cp "$work/table" "$output"
echo "$output"
