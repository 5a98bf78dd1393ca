#!/bin/sh
# Proves what `lom bench`, `lom selftest` and `lom version` say of this build: workloads are listed, and drawn in the order
# they are asked for, the hash of one is that of the picture which is kept and the same at every width, and lines of JSON
# hold what is stated; samples a pixel change edges alone.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh

# bench ARGUMENTS...: one small frame of each.
bench() { exits 0 "$lom" bench --size 32x18 --frames 1 --warm-up 0 "$@"; }

listed() {
    exits 0 "$lom" bench --list && cp "$folder/out" "$folder/list" || return 1
    [ "$(wc -l <"$folder/list")" -ge 7 ] && ! grep -vE '^[a-z0-9-]+ +[^ ]' "$folder/list" || { cat "$folder/list"; return 1; }
    bench blend clear fill || return 1
    for name in blend clear fill; do
        grep -q "^$name  *[a-z0-9]" "$folder/list" && sed -n 1p "$folder/out" | grep -q "^$name  *32x18 " || return 1
        sed -i 1d "$folder/out"
    done
    exits 2 "$lom" bench clod && complains 'did you mean "cloud"?'
}

kept() {
    bench blend -o "$folder/kept.png" && hash=$(sed 's/.* //' "$folder/out") && exits 0 "$lom" info "$folder/kept.png" &&
        says "32 x 18" && says "hash $hash" &&
        exits 2 "$lom" bench fill blend -o "$folder/two.png" && complains "2 are named" && [ ! -e "$folder/two.png" ] &&
        exits 2 "$lom" bench -o "$folder/two.png" && complains "0 are named"
}

# Of the widths that this build has for this processor: 4 is always one.
widths() {
    bench blend --threads 3 && hash=$(sed 's/.* //' "$folder/out") && says "32x18  3 threads" || return 1
    tried=0
    for lanes in auto 4 8 16; do
        for plain in '' --plain; do
            "$lom" bench blend --size 32x18 --frames 2 --threads 1 --lanes $lanes $plain >"$folder/out" 2>"$folder/err"
            case $?$(cat "$folder/err") in 0) ;; 2*"was built without"*) continue ;; *) cat "$folder/err"; return 1 ;; esac
            [ "$(sed 's/.* //' "$folder/out")" = "$hash" ] && says "1 threads" && says "2 frames" || return 1
            [ $lanes = auto ] || grep -qE " $lanes lanes " "$folder/out" || return 1
            tried=$((tried + 1))
        done
    done
    [ $tried -ge 3 ]
}

lines_of_json() {
    bench --json fill blend --threads 1 --lanes 4 || return 1
    number='[0-9][0-9.]*'
    for name in fill blend; do
        grep -cqE "^\{\"workload\":\"$name\",\"width\":32,\"height\":18,\"threads\":1,\"lanes\":4,\"frames\":1,\"median_ms\":$number,\"min_ms\":$number,.*\"hash\":\"[0-9a-f]{16}\"\}\$" "$folder/out" ||
            { cat "$folder/out"; return 1; }
    done
    exits 0 "$lom" version && threads=$(sed -n 's/^  threads *\([0-9]*\) by default/\1/p' "$folder/out")
    lanes=$(sed -n 's/^  lanes *4 (\(.*\)), 8 (\(.*\)), 16 (\(.*\))$/"lanes_4": "\1", "lanes_8": "\2", "lanes_16": "\3"/p' "$folder/out")
    exits 0 "$lom" version --json && says "\"threads\": $threads," && says "$lanes" && says '"contraction": false' &&
        says '"denormals": true' && says '"round_to_nearest": true' && says '"flt_eval_method": 0' &&
        [ "$(wc -l <"$folder/out")" -eq 1 ]
}

# The hash of all parts is told, and the builds of the matrix that gave it; the pictures are kept as one.
selftest() {
    rows=$(grep -o '"[a-z0-9-]*"' src/measure/selftest_rows.c | wc -l)
    exits 0 "$lom" selftest && head -n 1 "$folder/out" >"$folder/hash" && grep -qE '^[0-9a-f]{16}  selftest$' "$folder/hash" &&
        says "on $rows builds of the matrix:" &&
        [ "$(sed '1,2d' "$folder/out" | wc -w)" -eq "$rows" ] && says ppc64-1 &&
        exits 0 "$lom" selftest --badge && says "selftest $(cut -c 1-16 "$folder/hash") (as recorded; seen on" &&
        says "$(uname -m)" && [ "$(wc -l <"$folder/out")" -eq 1 ] &&
        exits 0 "$lom" selftest --parts -o "$folder/sheet.png" && grep -qxF "$(cat "$folder/hash")" "$folder/out" &&
        sed -i '/^on/,$d' "$folder/out" &&
        [ "$(wc -l <"$folder/out")" -gt 5 ] && ! grep -vE '^[0-9a-f]{16}  [a-z]' "$folder/out" &&
        [ "$(sort -u "$folder/out" | wc -l)" -eq "$(wc -l <"$folder/out")" ] && exits 0 "$lom" info "$folder/sheet.png" &&
        exits 2 "$lom" selftest -o "$folder/absent/sheet.png" && complains "could not create"
}

# More samples are another picture where there are edges, one where there are none; other numbers are refused.
samples() {
    bench mesh && one=$(sed 's/.* //' "$folder/out") && bench mesh --samples 1 && [ "$(sed 's/.* //' "$folder/out")" = "$one" ] &&
        bench mesh --samples 4 && [ "$(sed 's/.* //' "$folder/out")" != "$one" ] &&
        bench fill && one=$(sed 's/.* //' "$folder/out") && bench fill --samples 8 && [ "$(sed 's/.* //' "$folder/out")" = "$one" ] &&
        exits 2 "$lom" bench mesh --samples 3 && complains "1, 2, 4, 8 or 16" && exits 2 "$lom" bench mesh --samples 17
}

check workloads_are_listed_and_drawn_in_order listed
check the_hash_is_that_of_the_kept_picture kept
check every_width_has_one_hash widths
check lines_of_json_hold_what_is_stated lines_of_json
check samples_a_pixel samples
check selftest_of_parts selftest
exit $failures
