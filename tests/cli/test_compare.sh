#!/bin/sh
# Proves `lom compare`: exit statuses, thresholds, what is printed, JSON, and the picture of the differences, on pictures
# whose differences are known by hand.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
cd "$folder" || exit 1

# 4x2 RGB: b differs in one pixel, green by 3; c is twice the size; w is b with 16 bits; n is far from a.
printf 'P3 4 2 255\n 10 20 30  40 50 60  70 80 90  0 0 0   1 2 3  4 5 6  7 8 9  255 255 255\n' >a.ppm
printf 'P3 4 2 255\n 10 20 30  40 50 60  70 83 90  0 0 0   1 2 3  4 5 6  7 8 9  255 255 255\n' >b.ppm
printf 'P3 2 4 255\n 10 20 30  40 50 60  70 80 90  0 0 0   1 2 3  4 5 6  7 8 9  255 255 255\n' >c.ppm
printf 'P3 4 2 255\n 200 0 0  0 200 0  0 0 200  99 0 99   99 99 0  9 9 9  0 99 99  0 0 0\n' >n.ppm

statuses() {
    exits 0 "$lom" compare a.ppm a.ppm && says identical &&
        exits 1 "$lom" compare a.ppm b.ppm && says "1 of 8" && says "2,0,1,1" && says "3 of 255 at 2,0 (green)" &&
        exits 1 "$lom" compare a.ppm c.ppm && complains "a.ppm is 4 x 2 and c.ppm is 2 x 4" &&
        exits 2 "$lom" compare a.ppm missing.ppm && complains "missing.ppm" && [ ! -s "$folder/out" ] &&
        exits 2 "$lom" compare cli.sh a.ppm && exits 1 "$lom" compare -q a.ppm b.ppm && [ ! -s out ] && [ ! -s err ]
}

# Each line: status | thresholds for a against b, whose PSNR is 20 log10(255 / sqrt(9 / 24)) = 52.39 dB.
thresholds() {
    while IFS='|' read -r status options; do
        # shellcheck disable=SC2086
        exits "$status" "$lom" compare a.ppm b.ppm $options || return 1
    done <<LINES
0|--max-diff-pixels 1
1|--max-diff-pixels 0
0|--max-delta 3
1|--max-delta 2.99
0|--min-psnr 52.39
1|--min-psnr 52.40
0|--max-flip 0.5
1|--max-flip 0.000001
1|--max-flip 0
0|--min-ssim 0.9
1|--min-ssim 1
1|--min-ssim 1 --quiet
0|--max-delta 3 --max-diff-pixels 1 --min-psnr 50 --max-flip 0.5
1|--max-delta 2 --max-diff-pixels 0 --min-psnr 50 --max-flip 0.5
0|--max-delta 2 --max-diff-pixels 1 --min-psnr 50 --max-flip 0.5
1|--max-delta 3 --max-diff-pixels 1 --min-psnr 53 --max-flip 0.5
0|--max-delta 3 --quiet
1|--max-flip 0 --quiet
LINES
    exits 0 "$lom" compare a.ppm a.ppm --max-delta 0 --max-diff-pixels 0 --min-psnr 1000 --max-flip 0 &&
        exits 1 "$lom" compare a.ppm n.ppm --max-flip 0.1 && exits 1 "$lom" compare a.ppm c.ppm --max-diff-pixels 999
}

# At most N pixels differ by more than D. Against 100 everywhere, of the pixels 100, 101 .. 107 there are 7 - D that differ
# by more than D; each line: D, N, status. Alpha counts, and so does the largest of a pixel's samples.
pixels_above_a_delta() {
    printf 'P2 8 1 255\n 100 100 100 100 100 100 100 100\n' >flat.pgm
    printf 'P2 8 1 255\n 100 101 102 103 104 105 106 107\n' >ramp.pgm
    while read -r delta pixels status; do
        exits "$status" "$lom" compare flat.pgm ramp.pgm --max-delta "$delta" --max-diff-pixels "$pixels" || return 1
    done <<LINES
0 7 0
0 6 1
3 4 0
3 3 1
3.5 4 0
6 1 0
6 0 1
7 0 0
LINES
    exits 1 "$lom" compare flat.pgm ramp.pgm --max-delta 3 --json && says '"pixels": 7, "pixels_above": 4' &&
        exits 1 "$lom" compare flat.pgm ramp.pgm --max-delta 3 && says "above 3          4" &&
        exits 1 "$lom" compare flat.pgm ramp.pgm --json && says '"pixels": 7, "pixels_above": 7'
}

# SSIM and FLIP cost more than all else: they are found when asked for, or limited, and not otherwise.
metrics() {
    exits 1 "$lom" compare a.ppm b.ppm && ! grep -q -e SSIM -e FLIP out &&
        exits 1 "$lom" compare a.ppm b.ppm --json && says '"ssim": null, "flip": null' &&
        exits 1 "$lom" compare a.ppm b.ppm --metrics && says SSIM && says FLIP &&
        exits 0 "$lom" compare a.ppm b.ppm --max-flip 0.5 && says FLIP && ! grep -q SSIM out &&
        exits 0 "$lom" compare a.ppm b.ppm --min-ssim 0.5 --json && says '"ssim": 0.9' && says '"flip": null' &&
        exits 1 "$lom" compare a.ppm b.ppm --metrics -q && [ ! -s out ]
}

# Python checks the line as JSON and the values by hand-made numbers.
json() {
    for pair in "a.ppm a.ppm 0" "a.ppm b.ppm 1" "a.ppm c.ppm 1"; do
        # shellcheck disable=SC2086
        set -- $pair
        exits "$3" "$lom" compare "$1" "$2" --json --metrics && [ "$(wc -l <out)" -eq 1 ] && cp out "$1.$2.json" || return 1
    done
    python3 - <<'CODE'
import json, math
same, differ, sizes = (json.load(open("a.ppm.%s.ppm.json" % n)) for n in "abc")
assert same["identical"] is True and same["pixels"] == 0 and same["max_delta"] == 0 and same["rmse"] == 0
assert same["psnr"] is None and same["ssim"] == 1 and same["flip"] == 0 and same["bbox"] is None
assert same["width"] == 4 and same["height"] == 2
assert differ["identical"] is False and differ["pixels"] == 1 and differ["max_delta"] == 3
assert differ["bbox"] == [2, 0, 1, 1] and differ["max_at"] == [2, 0, 1]
rmse = math.sqrt(9 / 24)
assert abs(differ["rmse"] - rmse) < 1e-12 and abs(differ["psnr"] - 20 * math.log10(255 / rmse)) < 1e-9
assert 0.9 < differ["ssim"] < 1 and 0 < differ["flip"] < 0.2
assert sizes["identical"] is False and sizes["same_size"] is False and sizes["pixels"] is None
assert sizes["ssim"] is None and sizes["size_a"] == [4, 2, 1] and sizes["size_b"] == [2, 4, 1]
CODE
}

# A file name that is no UTF-8 and has quotes is still valid JSON.
strange_names() {
    name=$(printf 'q"\\\001\377.ppm')
    cp a.ppm "$name" && exits 0 "$lom" compare "$name" a.ppm --json && python3 -m json.tool <out
}

picture() {
    exits 1 "$lom" compare a.ppm b.ppm --diff d.ppm && exits 1 "$lom" compare a.ppm b.ppm --diff d.png -q &&
        exits 0 "$lom" compare d.ppm d.png || return 1
    # green of the third pixel: 64 + 191 sqrt(3 / 255) = 84.7
    printf 'P3 4 2 255\n 0 0 0  0 0 0  0 85 0  0 0 0   0 0 0  0 0 0  0 0 0  0 0 0\n' >expected.ppm
    exits 0 "$lom" compare d.ppm expected.ppm &&
        exits 2 "$lom" compare a.ppm b.ppm --diff - && exits 1 "$lom" compare a.ppm b.ppm --diff - -q && cmp out d.png &&
        exits 2 "$lom" compare a.ppm b.ppm --diff no/such/folder.png && complains "folder.png"
}

# 4 x 2 and 2 x 4 laid upon one another: the 2 x 2 in common differ in red of one pixel (1 against 70), what only one has
# is 32, and so is the corner that none has.
picture_of_sizes() {
    printf 'P3 4 2 255\n 10 20 30  40 50 60  70 80 90  0 0 0   1 80 90  0 0 0  7 8 9  255 255 255\n' >left.ppm
    exits 1 "$lom" compare left.ppm c.ppm --diff d.ppm --json && says '"same_size": false' && complains "always differ" &&
        printf 'P3 4 4 255\n 0 0 0  0 0 0  32 32 32  32 32 32   163 0 0  0 0 0  32 32 32  32 32 32
            32 32 32  32 32 32  32 32 32  32 32 32   32 32 32  32 32 32  32 32 32  32 32 32\n' >expected.ppm &&
        exits 0 "$lom" compare d.ppm expected.ppm && exits 1 "$lom" compare left.ppm c.ppm --diff d.ppm -q &&
        [ ! -s out ] && [ ! -s err ]
}

standard_input() {
    "$lom" compare - a.ppm <a.ppm && "$lom" compare a.ppm - <a.ppm && exits 2 "$lom" compare - - && complains "be read once" &&
        exits 2 "$lom" compare - a.ppm b.ppm --any <a.ppm && complains "be read once"
}

# b differs from a at 2,0 alone, which a rectangle or a mask leaves out; the rest still counts. White is white in every
# format: 16 bits, alpha, floats of one and three channels.
left_out() {
    printf 'P2 4 2 255\n 1 255 0 1  7 7 7 7\n' >mask.pgm
    printf 'P2 4 2 255\n 1 255 1 0  7 7 7 7\n' >other.pgm
    "$lom" convert b.ppm wide.pam && "$lom" convert b.ppm float.pfm && printf 'P2 4 2 255\n 9 9 9 9 9 9 9 9\n' >gray.pgm &&
        "$lom" convert gray.pgm gray.pfm || return 1
    for options in "--ignore 2,0,1,1" "--ignore 0,0,1,1 --ignore 2,-5,9,6" "--mask mask.pgm" "--ignore 0,0,4,2 --metrics --min-ssim 1"; do
        # shellcheck disable=SC2086
        exits 0 "$lom" compare a.ppm b.ppm $options && says identical || return 1
    done
    exits 1 "$lom" compare a.ppm b.ppm --ignore 1,0,1,2 && says "1 of 8" && exits 1 "$lom" compare a.ppm b.ppm --mask other.pgm &&
        exits 0 "$lom" compare float.pfm gray.pfm --ignore 0,0,4,2 && exits 0 "$lom" compare wide.pam gray.pfm --ignore 0,0,9,9 &&
        exits 1 "$lom" compare float.pfm gray.pfm --ignore 0,0,3,2 && exits 1 "$lom" compare a.ppm c.ppm --ignore 0,0,1,1
}

left_out_wrongly() {
    exits 2 "$lom" compare a.ppm b.ppm --ignore 4,0,1,1 && complains "--ignore 4,0,1,1 has no pixel" &&
        exits 2 "$lom" compare a.ppm b.ppm --ignore 0,0,1 && complains 'not "0,0,1"' &&
        exits 2 "$lom" compare a.ppm b.ppm --ignore 0,0,0,5 && exits 2 "$lom" compare a.ppm b.ppm --ignore 0,0,1,1x &&
        exits 2 "$lom" compare a.ppm b.ppm --mask c.ppm && complains "mask c.ppm is 2 x 4 and the pictures are 4 x 2" &&
        exits 2 "$lom" compare a.ppm b.ppm --mask missing.pgm
}

# One of several is enough; told of is that, or the nearest.
any_of_them() {
    exits 0 "$lom" compare a.ppm c.ppm n.ppm a.ppm b.ppm --any && says "with    a.ppm" && says identical &&
        exits 1 "$lom" compare a.ppm c.ppm n.ppm b.ppm --any && says "with    b.ppm" && says "1 of 8" &&
        exits 0 "$lom" compare a.ppm n.ppm b.ppm --any --max-delta 3 && says "with    b.ppm" &&
        exits 2 "$lom" compare a.ppm b.ppm a.ppm && complains "by --any alone" &&
        exits 2 "$lom" compare a.ppm missing.ppm a.ppm --any
}

# Pairs by name, in the order of names; what one folder has alone is refused, what cannot be read is told, and all else is
# compared all the same.
folders() {
    mkdir -p one/in two/in && cp a.ppm one/1.ppm && cp a.ppm two/1.ppm && cp a.ppm one/in/2.ppm && cp b.ppm two/in/2.ppm || return 1
    echo text >one/notes.txt && echo P6 >one/.hidden.ppm
    exits 1 "$lom" compare one two && cat >expected <<'END' && cmp out expected || return 1
1.ppm: identical
in/2.ppm: differs: 1 of 8 pixels, largest delta 3, PSNR 52.390 dB
2 pictures: 1 identical, 1 different
END
    exits 0 "$lom" compare one/ two --max-delta 3 && says 'in/2.ppm: accepted: 1 of 8' && says '1 identical, 1 accepted' &&
        exits 0 "$lom" compare one two --ignore 2,0,1,1 && exits 1 "$lom" compare -q one two && [ ! -s out ] &&
        exits 1 "$lom" compare one two --diff d && [ "$(find d -type f)" = d/in/2.ppm.png ] &&
        exits 1 "$lom" compare a.ppm b.ppm --diff one.png && cmp one.png d/in/2.ppm.png &&
        exits 1 "$lom" compare one two --json && [ "$(grep -c '"accepted": false' out)" -eq 1 ] && [ "$(wc -l <out)" -eq 2 ] || return 1
    cp c.ppm two/3.ppm && cp c.ppm one/4.ppm && cp a.ppm one/5.ppm && cp c.ppm two/5.ppm &&
        exits 1 "$lom" compare one two --max-delta 3 --metrics && says '3.ppm: only in two' && says '4.ppm: only in one' &&
        says '5.ppm: differs: 4 x 2 and 2 x 4' && says '5 pictures: 1 identical, 1 accepted, 1 different, 1 only in one, 1 only in two' &&
        says 'SSIM' && exits 1 "$lom" compare one two --json && says '"b": null' && says '"a": null' || return 1
    echo P6 >one/6.ppm && cp a.ppm two/6.ppm && exits 2 "$lom" compare one two && complains 'one/6.ppm' && says '1 not compared' &&
        says '2.ppm: differs' && exits 2 "$lom" compare one a.ppm && complains 'a folder is compared with' &&
        exits 2 "$lom" compare one two one --any && mkdir empty nothing && exits 2 "$lom" compare empty nothing &&
        complains 'neither empty nor nothing holds a picture' && exits 1 "$lom" compare two empty
}

check compare_exit_statuses statuses
check compare_folders_by_names folders
check compare_leaves_out_rectangles_and_masks left_out
check compare_refuses_what_leaves_out_nothing left_out_wrongly
check compare_with_any_of_several any_of_them
check compare_thresholds thresholds
check compare_pixels_above_a_delta pixels_above_a_delta
check compare_metrics_when_asked_for metrics
if command -v python3 >/dev/null; then
    check compare_json json
    check compare_json_of_strange_names strange_names
else
    echo "SKIP compare_json: there is no python3"
fi
check compare_picture_of_differences picture
volumes_of_sizes() {
    for depth in 1 2; do
        printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1 %d\nencoding: raw\n\nabcd' $depth | head -c $((63 + 2 * depth)) >$depth.nrrd
    done
    exits 0 "$lom" compare 2.nrrd 2.nrrd && exits 1 "$lom" compare 1.nrrd 2.nrrd &&
        complains "1.nrrd is 2 x 1 x 1 and 2.nrrd is 2 x 1 x 2: pictures of different sizes always differ."
}
check compare_volumes_of_different_sizes volumes_of_sizes
check compare_picture_of_different_sizes picture_of_sizes
check compare_reads_standard_input standard_input
exit $failures
