#!/bin/sh
# bench/peers.sh [--size WxH] [--frames N] [--repeats N] [--samples N] [--output FILE] [WORKLOAD]...
# Draws the workloads of bench/peers/README.md with lom and with every renderer of bench/peers that is installed, in
# turn, and writes a Markdown table: medians of the repeats, ratios, how well the pictures agree, and what share of this
# machine's limit lom reaches (bench/peers/work.md); then a table of the first frame and of frames that are read back. A
# renderer that is not there is named with SKIP. LOM names another program than build/lom.
cd "$(dirname "$0")/.." || exit 2
lom=${LOM:-${BUILD:-build}/lom} size=1280x720 frames=15 repeats=3 samples=1 output='' workloads=''
usage() { echo "bench/peers.sh: $1" >&2; sed -n 2p "$0" >&2; exit 2; }
while [ $# -gt 0 ]; do
    case $1 in
    --size) size=$2; shift 2 ;;
    --frames) frames=$2; shift 2 ;;
    --repeats) repeats=$2; shift 2 ;;
    --samples) samples=$2; shift 2 ;;
    --output) output=$2; shift 2 ;;
    -*) usage "there is no option $1." ;;
    *) workloads="$workloads $1"; shift ;;
    esac
done
[ -n "$workloads" ] || workloads='clear fill blend depth mesh terrain water water-skip cloud cloud-skip sprites foliage gradients draws textured'
several='' asked=''
[ "$samples" -eq 1 ] || { several=-$samples-samples; asked=" --samples $samples"; }
[ -n "$output" ] || output=bench/results/peers-$size$several.md
[ -x "$lom" ] || usage "there is no $lom; run make first."
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 2' INT TERM

field() { sed -n 's/.*"'"$1"'": *"\{0,1\}\([^",}]*\).*/\1/p'; }
# The peers' cloud walks every step, and their water draws its ground three times: what cloud-skip and water-skip are
# compared with.
peer_workload() { echo "${1%-skip}"; }
# The frames of slow peers are bounded by time, 20 s a run.
run_peer() { bench/peers/run "$1" "$(peer_workload "$2")" "$size" "$frames" -t 20 -samples "$samples" -o "$work/$1.ppm" 2>"$work/log"; }
median() { sort -n "$1" | awk '{ v[NR] = $1 } END { if (NR) printf "%.2f", (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'; }

# The figures of a run: of frames, of the first one, of those that are read back.
keep() {
    echo "$2" | field median_ms >>"$work/$workload.$1"
    echo "$2" | field cold_ms >>"$work/$workload.$1.cold"
    echo "$2" | field read_ms >>"$work/$workload.$1.read"
}

# The shortest time, in milliseconds, in which this machine can do a workload's work: its counts, its row of work.md and
# the limits of all threads.
limit() {
    row=$(awk -F '|' -v name="$1" '{ gsub(/ /, "", $2) } $2 == name { print $3, $4, $5, $6, $7 }' bench/peers/work.md)
    echo "$row $(tr '\n' ' ' <"$work/$1.counts") ${size%x*} ${size#*x}" | awk -v arithmetic="$(of_limits arithmetic)" \
        -v look_up="$(of_limits look-up-near)" -v write="$(of_limits write-picture)" 'NF == 10 && arithmetic > 0 {
            t[1] = ($1 * $6 + $2 * $7 + $3 * $8) / arithmetic; t[2] = $4 * $8 / look_up; t[3] = $5 * $9 * $10 / write
            most = 0
            for (i = 1; i <= 3; i++) if (t[i] > most) most = t[i]
            printf "%.3f", most / 1e6 }'
}
of_limits() { awk -v name="$1" '$1 == name { print $3 }' "$work/limits"; }

folder=$(bench/peers/build.sh "${BUILD:-build}" 2>"$work/log") || folder=''
if [ -n "$folder" ]; then "$folder/limits" >"$work/limits"; else
    echo "SKIP limits: $(head -n 1 "$work/log")"
    : >"$work/limits"
fi
peers=''
for peer in llvmpipe mesa25 swiftshader; do
    if found=$(bench/peers/run $peer clear 64x64 1 2>"$work/log") && [ -n "$found" ]; then
        peers="$peers $peer"
        echo "$found" | sed -n 's/.*"renderer":"\([^"]*\)","version":"\([^"]*\)".*/\1, \2/p' >"$work/$peer.name"
    else
        echo "SKIP $peer: not installed (bench/peers/get_peers.sh installs it): $(head -n 1 "$work/log")"
        echo "not installed" >"$work/$peer.name"
    fi
done

repeat=1
while [ "$repeat" -le "$repeats" ]; do
    for workload in $workloads; do
        line=$("$lom" bench "$workload" --size "$size" --frames "$frames" --samples "$samples" --json -o "$work/lom.png") || exit 2
        keep lom "$line"
        for count in vertices triangles_binned fragments; do echo "$line" | field $count; done >"$work/$workload.counts"
        echo "$line" | field hash >"$work/$workload.hash"
        echo "$line" | sed -n 's/.*"threads":\([0-9]*\),"lanes":\([0-9]*\).*/\1 threads, \2 lanes/p' >"$work/device"
        printf '%s %s: lom %s ms' "$repeat" "$workload" "$(tail -n 1 "$work/$workload.lom")"
        for peer in $peers; do
            keep "$peer" "$(run_peer "$peer" "$workload")"
            printf ', %s %s ms' "$peer" "$(tail -n 1 "$work/$workload.$peer")"
            "$lom" compare "$work/lom.png" "$work/$peer.ppm" --json >"$work/compared" 2>/dev/null
            psnr=$(field psnr <"$work/compared")
            case $psnr in null) psnr=equal ;; '') psnr=- ;; *) psnr=$(printf '%.1f' "$psnr") ;; esac
            echo "$psnr" >"$work/$workload.$peer.psnr"
        done
        echo
    done
    repeat=$((repeat + 1))
done

ratio_of() { echo "$1 $2" | awk '{ if (NF == 2 && $2 > 0) printf "%.1f", $1 / $2; else printf "-" }'; }

# table SUFFIX: one row a workload: lom, then for each peer its time and the ratio. Of whole frames also the share of the
# machine's limit and the agreement of the pictures in dB.
table() {
    printf '| workload | lom |'
    [ -n "$1" ] || printf ' limit | share |'
    for peer in $peers; do printf ' %s | ratio |' "$peer"; [ -n "$1" ] || printf ' PSNR |'; done
    printf '\n|---|---|'
    [ -n "$1" ] || printf -- '---|---|'
    for peer in $peers; do printf -- '---|---|'; [ -n "$1" ] || printf -- '---|'; done
    echo
    for workload in $workloads; do
        ours=$(median "$work/$workload.lom$1")
        printf '| %s | %s |' "$workload" "$ours"
        if [ -z "$1" ]; then
            least=$(limit "$workload")
            share=$(echo "$least $ours" | awk '{ if (NF == 2 && $2 > 0) printf "%.0f %%", 100 * $1 / $2; else printf "-" }')
            printf ' %s | %s |' "${least:--}" "$share"
        fi
        for peer in $peers; do
            theirs=$(median "$work/$workload.$peer$1")
            printf ' %s | **%s×** |' "${theirs:--}" "$(ratio_of "$theirs" "$ours")"
            [ -n "$1" ] || printf ' %s |' "$(cat "$work/$workload.$peer.psnr")"
        done
        echo
    done
}

# The geometric mean of the ratios of some workloads to a peer.
mean() {
    peer=$1
    shift
    for workload in "$@"; do
        [ -f "$work/$workload.lom" ] && echo "$(median "$work/$workload.$peer") $(median "$work/$workload.lom")"
    done | awk 'NF == 2 && $1 > 0 && $2 > 0 { sum += log($1 / $2); n++ } END { if (n) printf "%.1f", exp(sum / n); else printf "-" }'
}

mkdir -p "$(dirname "$output")"
{
    echo "# lom and its peers at $size"
    echo
    echo "Milliseconds a frame (median of $repeats repeats, each the median of $frames frames, all in turn in one run);"
    echo "ratio: the peer's time over lom's; PSNR of the two pictures in dB. Definitions: \`bench/peers/README.md\`;"
    echo "limit: the shortest time in which this machine can do the work (\`bench/peers/work.md\`); share: limit over lom;"
    echo "\`cloud\` walks every step and \`water\` draws its ground three times, as the peers do; \`cloud-skip\` and"
    echo "\`water-skip\` draw the same bytes with less work."
    echo
    echo "- machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) CPUs"
    echo "- lom: $(cat "$work/device"), $("$lom" version | sed -n 's/^ *compiler *//p')"
    for peer in llvmpipe mesa25 swiftshader; do echo "- $peer: $(cat "$work/$peer.name")"; done
    echo "- command: \`make bench-peers\` (\`bench/peers.sh --size $size --frames $frames --repeats $repeats$asked\`)"
    echo
    table ''
    echo
    for peer in $peers; do
        printf 'Geometric mean of fill, blend, depth, mesh, terrain, water and cloud against %s: **%s×**; ' "$peer" \
            "$(mean "$peer" fill blend depth mesh terrain water cloud)"
        echo "of sprites, foliage, gradients, draws and textured: **$(mean "$peer" sprites foliage gradients draws textured)×**."
    done
    echo
    echo "## The first frame"
    echo
    table .cold
    echo
    echo "## With the picture read back"
    echo
    table .read
    echo
    echo "## The machine's limits (\`bench/limits.c\`: one thread, all threads)"
    echo
    sed 's/^/    /' "$work/limits"
} >"$work/table.md"
cat "$work/table.md"
mv "$work/table.md" "$output"
echo "written to $output"
