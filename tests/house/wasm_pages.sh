#!/bin/bash
# Called by test_wasm.sh, which has built the pages. Proves that each is one small file that needs no other, draws the hash
# of the native program under node and from the file system in a browser, and there shows the picture at a step and tells
# of a pixel what the native program does; and that the stores of a lesson are told as they happened.
set -u
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build} SAN=${SAN:-} LARGEST=${LARGEST:-1048576}
programs=$BUILD/test/wasm/docs/lessons pages=$BUILD/test/web
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
check() { # NAME, whether it is so, what is wrong
    if [ "$2" = yes ]; then echo "PASS $1"; else echo "FAIL $1: $3; repeat: BUILD=$BUILD tests/house/test_wasm.sh"; failures=1; fi
}
lessons=$(sed -n 's/^| \[\([a-z_]*\)\](.*README.*/\1/p' docs/lessons/README.md)
native_hash() { sed -n "s/.*\"$1\", 0, IS_PICTURE, 0x\([0-9a-f]*\),.*/\1/p" src/cli/lesson_answers.h; }
wasm() { node src/web/lom.mjs "$programs/$1/$1.page" "${@:2}"; }
numbers() { sed 's/.*"picture": \[\([^]]*\)\].*/\1/; s/,//g' "$folder/$1.json"; } # of a picture that was drawn

large='' foreign='' wrong=''
for name in $lessons; do
    page=$pages/$name.html
    [ -s "$page" ] && [ "$(stat -c %s "$page")" -le "$LARGEST" ] || large="$large $name"
    grep -oE '(src|href)="[^"]*"' "$page" | grep -vE '="(https?://[^"]*|[a-z_]*\.html(#[a-z]*)?|#[a-z]*)"|src="data:' >>"$folder/foreign"
    wasm "$name" draw "$folder/$name" >"$folder/log" 2>&1
    grep -q "\"hash\": \"$(native_hash "$name")\"" "$folder/$name.json" 2>/dev/null || wrong="$wrong $name"
done
check "each lesson is a page of at most a megabyte, or half more without vectors" "$([ -n "$lessons" ] && [ -z "$large" ] && echo yes)" "not:$large"
check "pages need no other file" "$([ ! -s "$folder/foreign" ] && echo yes)" "$(head -3 "$folder/foreign")"
check "the pages' programs draw the native pictures" "$([ -z "$wrong" ] && echo yes)" "not:$wrong"

# The same program built by the native compiler: what a device draws is recorded alike.
compiler="$(sed 's/ -D_GNU_SOURCE.*//' "$BUILD/flags") $(grep -o -e '--coverage' "$BUILD/flags" | head -1)"
flags="-std=gnu11 -O1 -Iinclude -Isrc -D_GNU_SOURCE -fwrapv -ffp-contract=off -fno-trapping-math -fno-math-errno -w ${SAN:+-fsanitize=$SAN}"
calls=$(sed -n 's/^PAGE_CALLS *= //p' Makefile | sed 's/[a-z_]*/-Wl,--wrap=lom_&/g')
for name in targets water; do
    $compiler $flags -c -DLOM_LANES=4 -DLOM_VARIANT=4_recorded -DLOM_RECORD -Dmain=lom_lesson_main -o "$folder/$name.o" \
        "docs/lessons/$name/$name.c" &&
        $compiler $flags $calls -o "$folder/lom" src/web/*.c src/cli/explain_text.c src/cli/explain_names.c src/cli/json.c src/cli/page.c src/cli/steps_page.c \
            "$folder/$name.o" "$BUILD/liblom.a" -lm -lpthread || { check "$name is built" no "$compiler fails"; continue; }
    different=
    for asked in "explain 160 90" "explain 150 140" "explain 5 5" "moment 12002" "moment 18434" stages; do
        set -- $asked
        mkdir "$folder/native" "$folder/wasm"
        "$folder/lom" "$1" "$folder/native/a" "${@:2}" 0 0 0 0 0 >"$folder/log" 2>&1
        wasm "$name" "$1" "$folder/wasm/a" "${@:2}" 0 0 0 0 0 >>"$folder/log" 2>&1
        [ -n "$(ls "$folder/native")" ] && diff -r "$folder/native" "$folder/wasm" >>"$folder/log" 2>&1 || different="$different, $asked"
        [ "$name $asked" != "targets explain 160 90" ] || cp "$folder/native/a.txt" "$folder/explained.txt"
        [ "$name $asked" != "targets moment 12002" ] || cp "$folder/native/a.png" "$folder/moment.png"
        rm -r "$folder/native" "$folder/wasm"
    done
    check "$name is explained, step by step, as natively" "$([ -z "$different" ] && echo yes)" "not$different; $(tail -n 2 "$folder/log")"
done

# A lesson without a device: red is (165 - 90.5) / 153, green less blue is 1 / 260, and all three are 1.
wasm triangle explain "$folder/stores" 160 90 $(numbers triangle)
check "stores into a pixel are told" \
    "$(grep -q '^pixel 160,90 of lom, 320x180: 185 139 138$' "$folder/stores.txt" && grep -q 'into it 1 time;' "$folder/stores.txt" &&
        grep -qE '^  1\. stores [0-9]+ to [0-9]+: light 0\.4869281 0\.25845903 0\.25461286$' "$folder/stores.txt" && echo yes)" "$(cat "$folder/stores.txt")"
last=$(sed -n 's/.* to \([0-9]*\): .*/\1/p' "$folder/stores.txt")
pixel_at() { # of the moment behind so many stores, in codes
    wasm triangle moment "$folder/moment-$1" "$1" $(numbers triangle) && "$BUILD/lom" convert "$folder/moment-$1.png" "$folder/$1.ppm" &&
        tail -c $((320 * 180 * 3)) "$folder/$1.ppm" | od -An -tu1 -j $(((90 * 320 + 160) * 3)) -N 3 | tr -s ' '
}
before=$(pixel_at $((last - 3))) behind=$(pixel_at "$last")
check "a moment is the picture between two stores" "$([ "$before" = " 0 0 0" ] && [ "$behind" = " 185 139 138" ] && echo yes)" "$before, $behind"

browser=$(command -v chromium || command -v chromium-browser)
if [ -z "$browser" ]; then
    echo "SKIP pages of lessons in a browser: chromium is not installed"
    exit $failures
fi
{
    for name in $lessons; do
        echo "go file://$(realpath "$pages")/$name.html"
        echo "/^lom: $name [0-9a-f]{16}\$/.test(document.title) && document.title.slice(-16)"
    done
    echo "go file://$(realpath "$pages")/targets.html"
    echo 'document.body?.dataset.done === "yes" && name === "targets" && steps.some(step => step.title === "Coverage")'
    echo 'slider.value = steps.findIndex(step => step.moment >= 12002), Object.assign(steps[slider.value], { moment: 12002, file: "/steps-12002.png" }), slider.oninput(), 1'
    echo '!busy && canvas.toDataURL("image/png").slice(22)'
    echo 'click element("picture").getBoundingClientRect().left+160.5*canvas.clientWidth/320 element("picture").getBoundingClientRect().top+90.5*canvas.clientHeight/180'
    echo '/wrote this/.test(element("story").textContent) && element("story").textContent'
} | timeout 600 node tests/house/browser.mjs "$browser" "$folder/profile" 1280x800 >"$folder/answers" 2>"$folder/log"
wrong='' line=0
for name in $lessons; do
    line=$((line + 1))
    [ "$(sed -n "${line}p" "$folder/answers")" = "\"$(native_hash "$name")\"" ] || wrong="$wrong $name"
done
check "in a browser each page's title ends with the native hash" "$([ -z "$wrong" ] && echo yes)" "not:$wrong; $(tail -n 1 "$folder/log")"
answer() { tail -n +$((line + $1)) "$folder/answers" | head -1 | node -e 'process.stdout.write(JSON.parse(require("fs").readFileSync(0, "utf8")))'; }
answer 3 2>/dev/null | base64 -d >"$folder/canvas.png"
"$BUILD/lom" convert "$folder/moment.png" "$folder/moment.ppm" && "$BUILD/lom" convert "$folder/canvas.png" "$folder/canvas.ppm"
check "in a browser the slider shows the native picture of a step" "$(cmp -s "$folder/moment.ppm" "$folder/canvas.ppm" && echo yes)" "other pixels"
answer 4 >"$folder/told.txt" 2>/dev/null
sed 's/ of lom, frame/ of targets, frame/' "$folder/explained.txt" | cmp -s - "$folder/told.txt"
check "in a browser a pixel that is clicked is explained as natively" "$([ $? -eq 0 ] && echo yes)" "$(head -2 "$folder/told.txt")"
exit $failures
