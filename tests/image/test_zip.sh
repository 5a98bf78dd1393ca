#!/bin/sh
# Our compression against python's zlib, both ways: what one wrote the other reads, for every kind of test data and level.
tool="$BUILD/tests/image/test_zip --tool"
repeat="repeat: BUILD=$BUILD tests/image/test_zip.sh"
if ! python3 -c 'import zlib' 2>/dev/null; then
    echo "SKIP test_zip.sh: there is no python3 with zlib"
    exit 0
fi
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$(dirname "$0")/../.." || exit 1
for kind in 0 1 2 3 4 5 6 7 8; do
    printf %s $kind | $tool make >"$folder/data" || echo "FAIL zip_make_$kind: no data; $repeat"
    $tool zlib <"$folder/data" >"$folder/zlib" && $tool gzip <"$folder/data" >"$folder/gzip"
    if python3 - "$folder" <<'PYTHON'
import gzip, sys, zlib
folder = sys.argv[1]
read = lambda name: open(folder + "/" + name, "rb").read()
assert zlib.decompress(read("zlib")) == read("data"), "zlib"
assert gzip.decompress(read("gzip")) == read("data"), "gzip"
members = b""
for level in (0, 1, 6, 9):
    for strategy in (zlib.Z_DEFAULT_STRATEGY, zlib.Z_FILTERED, zlib.Z_HUFFMAN_ONLY, zlib.Z_RLE, zlib.Z_FIXED):
        c = zlib.compressobj(level, zlib.DEFLATED, 31, 8, strategy)
        members += c.compress(read("data")[:30000]) + c.flush(zlib.Z_FULL_FLUSH) + c.flush()
open(folder + "/members", "wb").write(members)
open(folder + "/expected", "wb").write(read("data")[:30000] * 20)
PYTHON
    then echo "PASS zip_python_reads_$kind"; else echo "FAIL zip_python_reads_$kind: python reads other data; $repeat"; fi
    if $tool gunzip <"$folder/members" | cmp -s - "$folder/expected"; then
        echo "PASS zip_reads_python_$kind"
    else
        echo "FAIL zip_reads_python_$kind: 20 members of zlib give other data; $repeat"
    fi
done
