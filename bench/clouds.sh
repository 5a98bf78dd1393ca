#!/bin/sh
# bench/clouds.sh [--samples N] [models] [light] [real-time] [next-power] [frames]
# Repeats the experiments on clouds, all of them unless some are named: tables in bench/results/clouds-NAME.csv, plots in
# docs/pictures/clouds-NAME.svg, and the page docs/cloud-experiments.md from all tables that are there. LOM names another
# program than build/lom.
cd "$(dirname "$0")/.." || exit 2
lom=${LOM:-${BUILD:-build}/lom} samples=64 chosen=''
while [ $# -gt 0 ]; do
    case $1 in
    --samples) samples=$2; shift 2 ;;
    models | light | real-time | next-power | frames) chosen="$chosen $1"; shift ;;
    *) echo "bench/clouds.sh: there is no $1." >&2; sed -n 2p "$0" >&2; exit 2 ;;
    esac
done
[ -x "$lom" ] || { echo "bench/clouds.sh: there is no $lom; run make first." >&2; exit 2; }
results=bench/results pictures=docs/pictures
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 2' INT TERM

field() { sed -n 's/.*"'"$1"'": *\([^,}]*\).*/\1/p' "$work/stats"; }
least() { field "$1" | sort -n | awk 'NR == 1 { printf "%.2f", $1 }'; }
draw() { "$lom" render "$@" --set quality.filtering=float --set quality.march=float --quiet --stats "$work/stats" >/dev/null || exit 2; }
plot() { # name, kind, title, x, y
    grep -v '^reference' "$results/clouds-$1.csv" | awk -F, -v kind="$2" -v title="$3" -v x="$4" -v y="$5" -f bench/plot.awk \
        >"$pictures/clouds-$1.svg"
    echo "$results/clouds-$1.csv"
}
scene() { # count, row|random: equal clouds of the reference work's kind in a row, or cumulus anywhere around the path
    cat <<'END'
[camera]
position = [0, 900, 0]
target = [0, 1000, -3000]
field_of_view = 60
near = 1
[[camera.key]]
time = 0
[[camera.key]]
time = 10
position = [400, 950, -1200]
target = [-300, 1100, -4000]
[light]
azimuth = 100
elevation = 40
[sky]
gradient = true
END
    awk -v count="$1" -v random="$([ "$2" = random ] && echo 1 || echo 0)" '
        function uniform() { state = (state * 16807) % 2147483647; return state / 2147483647 }
        BEGIN {
            state = 1234567
            split("cumulus_humilis cumulus_mediocris cumulus_congestus", kind, " ")
            for (i = 0; i < count; i++) {
                a = 6.2831853 * uniform(); d = 1500 + 9000 * sqrt(uniform()); n = int(3 * uniform()); s = int(3 * uniform())
                print "[[cloud]]"
                if (random)
                    printf "kind = \"%s\"\nvoxels = [64, 48, 64]\nseed = %d\nyaw = %d\nposition = [%d, %d, %d]\n", kind[n + 1], s,
                        360 * uniform() - 180, d * cos(a), 700 + 600 * uniform(), d * sin(a)
                else
                    printf "kind = \"hemisphere\"\nvoxels = [32, 32, 32]\nsize = [50, 50, 50]\nposition = [%d, 900, -3000]\n",
                        55 * (i - (count - 1) / 2)
            }
        }'
}

run_models() {
    draw bench/cloud.toml --size 160x120 --set quality.clouds=reference --set "quality.reference.samples=$samples" -o "$work/reference.ppm"
    exact=$(least ms)
    draw bench/cloud.toml --size 160x120 --set quality.clouds=reference --set "quality.reference.samples=$((samples / 4))" -o "$work/quarter.ppm"
    "$lom" compare "$work/reference.ppm" "$work/quarter.ppm" --json --metrics >"$work/quarter.json"
    echo "model,ms,FLIP,PSNR dB,SSIM" >"$work/table"
    for model in octaves forward single 'original combined' 'original advance' 'original real_time' 'original none' billboard sprites groups layers; do
        light=${model#* }
        [ "$light" = "$model" ] && light=combined
        draw bench/cloud.toml --size 160x120 --threads 1 --frames 0:60 --set "quality.clouds=${model% *}" \
            --set "clouds.original_light=$light" -o "$work/model-%d.ppm"
        "$lom" compare "$work/reference.ppm" "$work/model-0.ppm" --json --metrics | awk -F'[:,}]' -v model="$model" -v ms="$(least ms_clouds)" '
            { for (i = 1; i < NF; i++) for (k = 1; k <= 3; k++) if (index($i, key[k])) at[k] = $(i + 1) }
            BEGIN { key[1] = "\"flip\""; key[2] = "\"psnr\""; key[3] = "\"ssim\"" }
            END { printf "%s,%s,%.3f,%.1f,%.3f\n", model, ms, at[1], at[2], at[3] }' >>"$work/table"
        mv "$work/model-0.ppm" "$work/$(echo "$model" | tr ' ' '-').ppm"
    done
    awk -F'[:,}]' -v ms="$exact" '{ for (i = 1; i < NF; i++) { if (index($i, "\"flip\"")) f = $(i + 1); if (index($i, "\"psnr\"")) p = $(i + 1); if (index($i, "\"ssim\"")) s = $(i + 1) } }
        END { printf "reference with a quarter of its paths,%.0f,%.3f,%.1f,%.3f\n", ms / 4, f, p, s }' "$work/quarter.json" >>"$work/table"
    cp "$work/table" $results/clouds-models.csv
    plot models points 'Models of clouds against random paths' 'ms of the clouds, one thread' FLIP
    rows_of_four $pictures/clouds-models.png octaves forward single reference sprites groups layers billboard
}

rows_of_four() { # output, names of pictures of 160x120
    joined=$1
    shift
    printf 'P6\n640 %d\n255\n' $((30 * $#)) >"$work/joined.ppm"
    while [ $# -gt 0 ]; do
        mkdir "$work/rows"
        for column in 1 2 3 4; do
            tail -c 57600 "$work/$1.ppm" | split -a 3 -b 480 - "$work/rows/$column."
            shift
        done
        for row in "$work"/rows/1.*; do
            for column in 1 2 3 4; do cat "$work/rows/$column.${row##*.}"; done
        done >>"$work/joined.ppm"
        rm -r "$work/rows"
    done
    "$lom" convert "$work/joined.ppm" "$joined"
}

counts='1 10 20 40 60 80 100'
first() { # the least time of a key in the first frame of three runs; arguments of render
    key=$1
    shift
    for _ in 1 2 3; do
        draw "$work/row.toml" --size 640x360 --threads 1 --hash "$@"
        field "$key"
    done | sort -n | awk 'NR == 1 { printf "%.2f", $1 }'
}
run_light() {
    echo "clouds,theirs: in advance ms,theirs: without ms,ours: light grids ms" >$results/clouds-light.csv
    for n in $counts; do
        scene "$n" row >"$work/row.toml"
        theirs=$(first ms_cloud_light --set quality.clouds=original --set clouds.original_light=advance)
        without=$(first ms_cloud_light --set quality.clouds=original --set clouds.original_light=none)
        echo "$n,$theirs,$without,$(first ms_cloud_light)" >>$results/clouds-light.csv
    done
    plot light lines 'Light in advance, equal clouds in a row' clouds ms
}
run_real_time() {
    echo "clouds,with real-time light ms,without ms" >$results/clouds-real-time.csv
    for n in $counts; do
        scene "$n" row >"$work/row.toml"
        echo "$n,$(first ms_clouds --set quality.clouds=original --set clouds.original_light=real_time),$(first ms_clouds \
            --set quality.clouds=original --set clouds.original_light=none)" >>$results/clouds-real-time.csv
    done
    plot real-time lines 'Light in real time, equal clouds in a row' clouds 'ms a frame'
}
run_next_power() {
    "${BUILD:-build}/bench/next_power.w4" >"$work/powers" || exit 2
    cp "$work/powers" $results/clouds-next-power.csv
    plot next-power lines 'The next power of two for the plates of a frame' clouds 'ns a frame'
}
rate() { # count, arguments of render: frames a second over a moving camera, the first frame (start-up) left out
    scene "$1" random >"$work/random.toml"
    shift
    draw "$work/random.toml" --size 1280x720 --frames 0:10 --hash "$@"
    field ms | awk 'NR > 1 { sum += $1; n++ } END { printf "%.1f", 1000 * n / sum }'
}
run_frames() {
    echo "way,fps 30 clouds,fps 100 clouds" >"$work/table"
    while read -r name arguments; do
        # shellcheck disable=SC2086 # the arguments are words
        echo "$(echo "$name" | tr _ ' '),$(rate 30 $arguments),$(rate 100 $arguments)" >>"$work/table"
    done <<END
theirs:_nothing --set quality.clouds=original --set quality.impostors=reference --set quality.impostor.lod=false --set quality.impostor.culling=false
theirs:_LOD --set quality.clouds=original --set quality.impostors=reference --set quality.impostor.culling=false
theirs:_LOD_and_culling --set quality.clouds=original --set quality.impostors=reference
ours:_marched,_nothing_culled --set quality.impostors=off --set quality.impostor.culling=false
ours:_marched --set quality.impostors=off
ours:_bounded_impostors --set quality.impostors=bounded
END
    sed 's/,_/ /; s/marched, nothing/marched; nothing/' "$work/table" >$results/clouds-frames.csv
    plot frames bars 'Random clouds at 1280x720, a moving camera' '' 'frames a second'
}

table() { # name: the CSV as Markdown
    awk -F, '{ for (i = 1; i <= NF; i++) printf "| %s ", $i; print "|" }
        NR == 1 { for (i = 1; i <= NF; i++) printf "|---"; print "|" }' "$results/clouds-$1.csv"
    printf '\n![%s](pictures/clouds-%s.svg) ([CSV](../%s/clouds-%s.csv))\n' "$1" "$1" "$results" "$1"
}
write_page() {
    machine="$(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores"
    sed "s/@MACHINE@/$machine/" bench/cloud-experiments.md | while IFS= read -r line; do
        case $line in
        @*@) line=${line#@} && line=${line%@} && if [ -f "$results/clouds-$line.csv" ]; then table "$line"; else echo "(Not measured yet: \`bench/clouds.sh $line\`.)"; fi ;;
        *) printf '%s\n' "$line" ;;
        esac
    done >docs/cloud-experiments.md
    echo docs/cloud-experiments.md
}

for experiment in ${chosen:-models light real-time next-power frames}; do
    case $experiment in
    models) run_models ;;
    light) run_light ;;
    real-time) run_real_time ;;
    next-power) run_next_power ;;
    frames) run_frames ;;
    esac
done
write_page
