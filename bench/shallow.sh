#!/bin/sh
# bench/shallow.sh: steps of shallow water, into bench/results/shallow.md. BUILD names another folder than build.
cd "$(dirname "$0")/.." || exit 2
output=bench/results/shallow.md
rows=$("${BUILD:-build}/bench/shallow") || exit 2
{
    echo '# Shallow water, one thread'
    echo
    echo "$(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(cc --version | head -n 1); repeat: \`make bench-shallow\`."
    echo 'Processor time, the least of 60 steps, a dam that breaks over a rough bed: two sweeps of tridiagonal systems in double.'
    echo
    echo "$rows"
} >"$output"
echo "$output"
