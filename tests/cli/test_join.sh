#!/bin/sh
# Proves `lom render --shard` and `lom join`: parts drawn by any widths and threads, in any order, join to the bytes that
# `lom render` alone writes, whether frames or bands of one frame are shared out; what is cut off, changed, missing, of
# another run or drawn otherwise is refused; --resume draws what is not whole, and nothing else.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
cd "$folder/scene" || exit 1
cat >>scene.toml <<'END'
[[entity.key]]
time = 0
position = [0, 0, 0]
[[entity.key]]
time = 0.2
position = [1, 0, 0]
END

# shares N OPTIONS...: the parts 1 .. N, at widths and threads in turn.
shares() {
    count=$1
    shift
    rm -f part-*
    for share in $(seq "$count"); do
        lanes=$((share % 2 * 4 + 4))
        exits 0 "$lom" render scene.toml --shard "$share/$count" "$@" -o part-%02d --lanes $lanes --threads $((share % 3 + 1)) -q || return 1
    done
    [ "$(ls part-* | wc -l)" -eq "$count" ]
}

frames() {
    "$lom" render scene.toml --frames 2:8 -o whole-%d.png -q --hash >hashes && "$lom" render scene.toml --frames 2:8 -o whole.y4m -q &&
        [ "$(cut -c 1-16 hashes | sort -u | wc -l)" -gt 4 ] || return 1
    for count in 1 3 7; do
        shares $count --frames 2:8 && exits 0 "$lom" join $(ls -r part-*) -o joined-%d.png --hash && cmp hashes "$folder/out" || return 1
        for frame in 2 3 4 5 6 7 8; do cmp whole-$frame.png joined-$frame.png || return 1; done
    done
    exits 0 "$lom" join part-* -o joined.y4m && cmp whole.y4m joined.y4m && exits 0 "$lom" join part-* -o - --format y4m &&
        cmp whole.y4m "$folder/out" && exits 2 "$lom" join part-* -o one.png && complains '%04d' && exits 2 "$lom" join part-* &&
        exits 0 "$lom" join part-* part-01 --hash && ! "$lom" join part-* -o - --hash
}

# More shares than frames: bands of rows, also of a crop, of two frames, and one pixel high; more shares than rows.
bands() {
    for options in "--frame 3" "--frame 3 --crop 5,4,20,9" "--frames 3:4 --size 40x30" "--frame 1 --set output.format=\"rgb16\"" "--frame 1 --size 9x3" "--frame 1 --set output.transfer=\"naive\""; do
        for count in 2 5 32; do
            # shellcheck disable=SC2086
            shares $count $options && "$lom" render scene.toml $options -q --hash >hashes && exits 0 "$lom" join part-* --hash &&
                cmp hashes "$folder/out" || { echo "$options in $count"; return 1; }
        done
    done
    shares 4 --frame 3 --set 'output.format="rgb32f"' && "$lom" render scene.toml --frame 3 --set 'output.format="rgb32f"' -q -o whole.pfm &&
        exits 0 "$lom" join part-* -o joined.pfm && cmp whole.pfm joined.pfm
}

refused() {
    shares 4 --frames 0:5 && cp part-03 good || return 1
    for bytes in 0 7 50 96 200 $(($(wc -c <good) - 1)); do
        head -c "$bytes" good >part-03
        exits 2 "$lom" join part-* -o no-%d.png && complains part-03 || { echo "$bytes bytes"; return 1; }
    done
    for at in 3 20 90 150 $(($(wc -c <good) - 4)); do
        { head -c "$at" good && printf '\377' && tail -c +$((at + 2)) good; } >part-03
        exits 2 "$lom" join part-* -o no-%d.png && complains part-03 || { echo "byte $at"; return 1; }
    done
    rm part-03 && exits 2 "$lom" join part-* -o no-%d.png && complains 'of 4 shares 1 is missing: 3.' && ! ls no-* 2>/dev/null || return 1
    # what else a part of another run can be
    for options in "--frames 0:6" "--frames 0:5 --size 20x20" "--frames 0:5 --set camera.position=[0,2,6]" "--frames 0:5 --crop 0,0,48,32" "--frames 0:5 --fps 12"; do
        # shellcheck disable=SC2086
        exits 0 "$lom" render scene.toml --shard 3/4 $options -o part-03 -q && exits 2 "$lom" join part-* -o no-%d.png &&
            complains 'of another run' || { echo "$options"; return 1; }
    done
    cp skin.ppm kept && printf 'P6 2 2 255\n\377\020\020\020\377\020\020\020\377\000\000\000' >skin.ppm &&
        exits 0 "$lom" render scene.toml --shard 3/4 --frames 0:5 -o part-03 -q && exits 2 "$lom" join part-* -o no-%d.png &&
        complains 'of another run' && cp kept skin.ppm && ! ls no-* 2>/dev/null
}

# Two of one share are one, when they are the same; drawn otherwise, one of them is wrong: here it is made so.
drawn_otherwise() {
    shares 2 --frames 0:1 && cp part-02 again && exits 0 "$lom" join part-01 again part-02 --hash &&
        python3 - <<'CODE' && exits 1 "$lom" join part-01 part-02 other --hash && complains 'part-02 and other are both share 2 and differ'
import struct
data = open("part-02", "rb").read()
first = open("part-01", "rb").read()
head = 8 + 11 * 8
body = data[:head] + first[head:-8]
hash = 0xcbf29ce484222325
for byte in body:
    hash = (hash ^ byte) * 0x100000001b3 & (1 << 64) - 1
open("other", "wb").write(body + struct.pack("<Q", hash))
CODE
}

resumed() {
    shares 3 --frames 0:5 && touch -d 2020-01-01 part-* || return 1
    head -c 300 part-02 >half && cp half part-02
    for share in 1 2 3; do
        exits 0 "$lom" render scene.toml --shard $share/3 --frames 0:5 -o part-%02d --resume || return 1
        [ $share -eq 2 ] || complains "part-0$share is whole already" || return 1
    done
    [ "$(find . -name 'part-*' -newermt 2021-01-01)" = ./part-02 ] && exits 0 "$lom" join part-* --hash &&
        exits 0 "$lom" render scene.toml --shard 1/3 --frames 0:4 -o part-%02d --resume -q && exits 2 "$lom" join part-* --hash
}

options() {
    while IFS='|' read -r text words; do
        # shellcheck disable=SC2086
        exits 2 "$lom" render scene.toml $words && complains "$text" && ! ls part-* 2>/dev/null || return 1
    done <<'LINES'
numbered from 1 to 2|--shard 3/2 -o part-1
from 1 to|--shard 0/2 -o part-1
needs -o FILE|--shard 1/2 -o -
excludes --hash|--shard 1/2 -o part-1 --hash
excludes --show|--shard 1/2 -o part-1 --show depth
excludes --view|--shard 1/2 -o part-1 --view main
--resume is of --shard|-o part-1.png --resume
depends on those before it|--shard 1/2 -o part-1 --frames 0:3 --set quality.impostors="bounded"
LINES
    exits 2 "$lom" join scene.toml --hash && complains 'no part of a run' && exits 2 "$lom" join missing --hash
}

check options_of_shares_are_refused options
check shared_frames_join_to_the_bytes_of_one_run frames
check shared_bands_join_to_the_bytes_of_one_run bands
check what_is_no_whole_part_is_refused refused
check resuming_draws_what_is_not_whole resumed
if command -v python3 >/dev/null; then
    check two_of_one_share_must_be_the_same drawn_otherwise
else
    echo "SKIP two_of_one_share_must_be_the_same: needs python3"
fi
exit $failures
