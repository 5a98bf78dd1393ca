#!/bin/sh
# bench/fft.sh: complex Fourier transforms against FFTW's, in one run, into bench/results/fft.md. BUILD names another
# folder than build.
cd "$(dirname "$0")/.." || exit 2
output=bench/results/fft.md
rows=$("${BUILD:-build}/bench/fft") || exit 2
{
    echo '# Fourier transforms of squares, one thread'
    echo
    echo "$(uname -m), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(cc --version | head -n 1); repeat: \`make bench-fft\`."
    echo 'Complex numbers in float; the fastest of 300, 150 and 60 runs in turn, processor time. FFTW: `FFTW_MEASURE`, the faster of'
    echo 'in place and from one array into another. It is linked to this program alone. `lom bench fft256 fft512 fft1024 --threads 1`'
    echo 'times the same transforms.'
    echo
    echo "$rows"
} >"$output"
echo "$output"
