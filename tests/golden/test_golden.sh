#!/bin/sh
# Proves that the commands of goldens.txt draw the recorded bytes (README.md of this folder). Without arguments all of them;
# with arguments those named.
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build}
lom=$BUILD/lom
list=tests/golden/goldens.txt
new=$BUILD/golden
mkdir -p "$new" || exit 1

differ() { # name, why
    echo "  $1: $2"
    if [ -f "tests/golden/$1.png" ]; then
        "$lom" compare "tests/golden/$1.png" "$new/$1.png" --diff "$new/$1-difference.png" | sed 's/^/  /'
        echo "  the golden, the new picture, their difference: tests/golden/$1.png $new/$1.png $new/$1-difference.png"
    fi
    echo "  drawn by: $lom $3 -o $new/$1.png; if it is meant, look at it, then: tests/golden/record.sh $1"
    echo "FAIL golden_$1: $2; repeat: tests/golden/test_golden.sh $1"
}

draw() { # name, recorded hash, arguments
    # shellcheck disable=SC2086
    "$lom" $3 -o "$new/$1.png" >"$new/$1.log" 2>&1 || { differ "$1" "not drawn: $(head -n 1 "$new/$1.log")" "$3"; return; }
    hash=$("$lom" info "$new/$1.png" | sed 's/.*hash //')
    golden=$("$lom" info "tests/golden/$1.png" 2>/dev/null | sed 's/.*hash //')
    if [ -z "$golden" ]; then
        differ "$1" "there is no golden picture" "$3"
    elif [ "$golden" != "$2" ]; then
        differ "$1" "the golden picture has not the recorded hash $2" "$3"
    elif [ "$hash" != "$2" ]; then
        differ "$1" "$hash instead of $2" "$3"
    else
        echo "PASS golden_$1"
        rm -f "$new/$1.png" "$new/$1-difference.png" "$new/$1.log"
    fi
}

while read -r name hash arguments; do
    case " $* " in "  " | *" $name "*) draw "$name" "$hash" "$arguments" ;; esac
done <$list

# Every step of the water that is switched off shows: no two goldens of the lake are one picture.
[ $# -gt 0 ] || {
    same=$(grep '^lake' $list | cut -d' ' -f2 | sort | uniq -d)
    if [ -z "$same" ] && [ "$(grep -c '^lake-without-' $list)" -ge 9 ]; then echo "PASS every_step_of_the_water_shows"; else
        echo "FAIL every_step_of_the_water_shows: two lakes have the hash $same; repeat: tests/golden/test_golden.sh"; fi
}
