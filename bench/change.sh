#!/bin/sh
# bench/change.sh: what a changed key of flight and lake costs. Into bench/results/change.md. BUILD names another folder than build.
cd "$(dirname "$0")/.." || exit 2
output=bench/results/change.md
rows=$("${BUILD:-build}/bench/change") || exit 2
{
    echo '# Changed keys, one thread'
    echo
    echo "$(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(cc --version | head -n 1); repeat: \`make bench-change\`."
    echo 'Processor time of `lom_change_scene`, the least of three, and of the first frame after it at 320×180, for which the'
    echo 'light of clouds is swept anew where it depends on the key.'
    echo
    echo "$rows"
} >"$output"
echo "$output"
