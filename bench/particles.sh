#!/bin/sh
# bench/particles.sh: 60 000 drops, from their numbers to the order of blending; and the frame of falls.toml, stage by
# stage. Into bench/results/particles.md. BUILD names another folder than build.
cd "$(dirname "$0")/.." || exit 2
output=bench/results/particles.md
build=${BUILD:-build}
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
rows=$("$build/bench/particles") || exit 2
"$build/lom" render assets/scenes/falls.toml --threads 1 --frames 60:64 --stats "$work/stats" -o "$work/%d.ppm" || exit 2
field() { # name: the least of the frames but the first, which loads caches
    sed -n '2,$s/.*"'"$1"'": \([0-9.]*\).*/\1/p' "$work/stats" | sort -n | head -n 1
}
{
    echo '# Particles, one thread'
    echo
    echo "$(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(cc --version | head -n 1); repeat: \`make bench-particles\`."
    echo 'Processor time, the least of 30 moments. Place: flight and lives; sprites: what the frame shows of them; order: two'
    echo 'counting sorts.'
    echo
    echo "$rows"
    echo
    echo 'assets/scenes/falls.toml at 1280×720, by the clock, the least of four frames:'
    echo
    echo '| stage | ms |'
    echo '|---|---|'
    for stage in terrain entity_shadow scene sea_waves sea spray output; do
        printf '| %s | %.1f |\n' $stage "$(field ms_$stage)"
    done
    printf '| the frame | %.1f |\n' "$(field ms)"
    echo
    echo "Drops drawn: $(field drops_drawn) of $(field drops_moved); fragments of all passes: $(field fragments)."
} >"$output"
echo "$output"
