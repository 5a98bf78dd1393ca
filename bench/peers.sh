#!/bin/sh
# bench/peers.sh [--size WxH] [--frames N] [--repeats N] [--output FILE] [WORKLOAD]...
# Draws the workloads of bench/peers/README.md with lom and with every renderer of bench/peers that is installed, in
# turn, and writes a Markdown table: medians of the repeats, ratios, and how well the pictures agree. A renderer that is
# not there is named with SKIP. LOM names another program than build/lom.
cd "$(dirname "$0")/.." || exit 2
lom=${LOM:-${BUILD:-build}/lom} size=1280x720 frames=15 repeats=3 output='' workloads=''
usage() { echo "bench/peers.sh: $1" >&2; sed -n 2p "$0" >&2; exit 2; }
while [ $# -gt 0 ]; do
    case $1 in
    --size) size=$2; shift 2 ;;
    --frames) frames=$2; shift 2 ;;
    --repeats) repeats=$2; shift 2 ;;
    --output) output=$2; shift 2 ;;
    -*) usage "there is no option $1." ;;
    *) workloads="$workloads $1"; shift ;;
    esac
done
[ -n "$workloads" ] || workloads='clear fill blend depth mesh terrain water cloud cloud-skip'
[ -n "$output" ] || output=bench/results/peers-$size.md
[ -x "$lom" ] || usage "there is no $lom; run make first."
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 2' INT TERM

field() { sed -n 's/.*"'"$1"'": *"\{0,1\}\([^",}]*\).*/\1/p'; }
# The peers' cloud walks every step: it is what cloud-skip is compared with.
peer_workload() { case $1 in cloud-skip) echo cloud ;; *) echo "$1" ;; esac; }
# The frames of slow peers are bounded by time, 20 s a run.
run_peer() { bench/peers/run "$1" "$(peer_workload "$2")" "$size" "$frames" -t 20 -o "$work/$1.ppm" 2>"$work/log"; }
median() { sort -n "$1" | awk '{ v[NR] = $1 } END { if (NR) printf "%.2f", (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'; }

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
        line=$("$lom" bench "$workload" --size "$size" --frames "$frames" --json -o "$work/lom.png") || exit 2
        echo "$line" | field median_ms >>"$work/$workload.lom"
        echo "$line" | field hash >"$work/$workload.hash"
        echo "$line" | sed -n 's/.*"threads":\([0-9]*\),"lanes":\([0-9]*\).*/\1 threads, \2 lanes/p' >"$work/device"
        printf '%s %s: lom %s ms' "$repeat" "$workload" "$(tail -n 1 "$work/$workload.lom")"
        for peer in $peers; do
            run_peer "$peer" "$workload" | field median_ms >>"$work/$workload.$peer"
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

# One row a workload: lom, then for each peer its time, the ratio, and the agreement of the pictures in dB.
table() {
    printf '| workload | lom |'
    for peer in $peers; do printf ' %s | ratio | PSNR |' "$peer"; done
    printf '\n|---|---|'
    for peer in $peers; do printf -- '---|---|---|'; done
    echo
    for workload in $workloads; do
        ours=$(median "$work/$workload.lom")
        printf '| %s | %s |' "$workload" "$ours"
        for peer in $peers; do
            theirs=$(median "$work/$workload.$peer")
            ratio=$(echo "$theirs $ours" | awk '{ if (NF == 2 && $2 > 0) printf "%.1f", $1 / $2; else printf "-" }')
            printf ' %s | **%s×** | %s |' "${theirs:--}" "$ratio" "$(cat "$work/$workload.$peer.psnr")"
        done
        echo
    done
}

mkdir -p "$(dirname "$output")"
{
    echo "# lom and its peers at $size"
    echo
    echo "Milliseconds a frame (median of $repeats repeats, each the median of $frames frames, all in turn in one run);"
    echo "ratio: the peer's time over lom's; PSNR of the two pictures in dB. Definitions: \`bench/peers/README.md\`;"
    echo "\`cloud\` walks every step, as the peers do; \`cloud-skip\` draws the same bytes with less work."
    echo
    echo "- machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) CPUs"
    echo "- lom: $(cat "$work/device"), $("$lom" version | sed -n 's/^ *compiler *//p')"
    for peer in llvmpipe mesa25 swiftshader; do echo "- $peer: $(cat "$work/$peer.name")"; done
    echo "- command: \`make bench-peers\` (\`bench/peers.sh --size $size --frames $frames --repeats $repeats\`)"
    echo
    table
} >"$work/table.md"
cat "$work/table.md"
mv "$work/table.md" "$output"
echo "written to $output"
