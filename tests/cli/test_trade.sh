#!/bin/sh
# Proves `lom trade`: it writes a line a setting, a table, a plot and one page that needs no other file, and keeps the
# reference, which a second run takes; a picture against itself has no error; dials of speed are equal; the plot is XML that
# a browser shows; and bad input is refused with one sentence and leaves nothing behind. And `--settings`: a file that is
# laid over a scene draws what --set draws, and names the place of what is wrong in it.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
cd "$folder/scene" || exit 1
small='--size 32x18 --pairs 1 --samples 1 --threads 1'

refuses() {
    refuses_text=$1
    shift
    rm -rf out
    exits 2 "$lom" trade "$@" && complains "$refuses_text" && [ ! -s "$folder/out" ] && [ ! -e out ] &&
        [ "$(wc -l <"$folder/err")" -eq 1 ]
}

bad_input() {
    sed '4s/.*/[camrea]/; /^position/d' scene.toml >bad.toml
    "$lom" render scene.toml --size 16x9 --quiet -o other.png
    refuses '-o DIR' scene.toml && refuses 'missing.toml' missing.toml -o out &&
        refuses 'bad.toml:4:2: unknown key' bad.toml -o out && refuses 'no standard input' - -o out &&
        refuses 'did you mean "terrain_error"' scene.toml -o out --dials terrain_eror &&
        refuses 'names no dial' scene.toml -o out --dials '' &&
        refuses 'no-such.png' scene.toml -o out --reference no-such.png &&
        refuses '16x9 pixels' scene.toml -o out --reference other.png &&
        refuses 'larger than the limit' scene.toml -o out --size 32768x32768 &&
        refuses 'no-such.toml' scene.toml -o out --settings no-such.toml && : >file &&
        exits 2 "$lom" trade scene.toml $small -o file/out --dials scissor && complains 'file/out'
}

# The numbers of a line of CSV: its field by number, of the settings that the line begins with.
field() { sed -n "s/^\"$1\",//p" out/trade.csv | head -n 1 | cut -d, -f"$2"; }

whole_result() {
    # shellcheck disable=SC2086 # the options are words
    exits 0 "$lom" trade scene.toml $small -o out --dials shading,scissor,threads && says 'against the tracer' || return 1
    for name in trade.csv trade.txt trade.svg trade.html; do [ -s "out/$name" ] || { echo "no $name"; return 1; }; done
    cmp "$folder/out" out/trade.txt && [ "$(find out -name 'reference-*.png' | wc -l)" -eq 1 ] || return 1
    [ "$(field shading=flat 8)" != '' ] && [ "$(field threads=2 8)" = 0.00000 ] && [ "$(field threads=2 10)" = 0 ] || return 1
    ! grep -q 'src="[^d]\|href=\|url(' out/trade.html && grep -q 'src="data:image/png;base64,' out/trade.html &&
        grep -q '</html>' out/trade.html && grep -q '</svg>' out/trade.svg
}

# The second run takes the kept reference: one that is changed is believed. Another size has another.
kept_reference() {
    kept=$(echo out/reference-*.png)
    "$lom" render scene.toml --size 32x18 --quiet -o "$kept"
    # shellcheck disable=SC2086
    exits 0 "$lom" trade scene.toml $small -o out --dials scissor --quiet && [ ! -s "$folder/out" ] || return 1
    [ "$(field default 8)" = 0.00000 ] && [ "$(field default 6)" = inf ] || { cat out/trade.csv; return 1; }
    exits 0 "$lom" trade scene.toml --pairs 1 --samples 1 --size 30x18 -o out --dials scissor &&
    [ "$(find out -name 'reference-*.png' | wc -l)" -eq 2 ]
}

own_reference() {
    "$lom" render scene.toml --size 32x18 --quiet --set quality.shading=flat -o mine.png
    # shellcheck disable=SC2086
    exits 0 "$lom" trade scene.toml $small -o out --reference mine.png --dials shading &&
        says 'against mine.png' && [ "$(field shading=flat 10)" = 0 ] &&
        exits 0 "$lom" trade scene.toml $small -o out --reference rendered --dials shading --cpu && says 'processor time' &&
        says 'against the finest settings'
}

settings_file() {
    printf '[quality]\nshading = "flat"\n[water]\nlevel = -1\n' >over.toml
    printf '# nothing\n\n[quality]\nshadin = "flat"\n' >wrong.toml
    "$lom" render scene.toml --size 32x18 --hash --set quality.shading=flat --set water.level=-1 >one || return 1
    exits 0 "$lom" render scene.toml --size 32x18 --hash --settings over.toml && cmp one "$folder/out" &&
        exits 0 "$lom" render scene.toml --size 32x18 --hash --settings - <over.toml && cmp one "$folder/out" &&
        exits 0 "$lom" render scene.toml --size 32x18 --hash --settings over.toml --set quality.shading=phong &&
        ! cmp -s one "$folder/out" &&
        exits 2 "$lom" render scene.toml --size 32x18 --hash --settings wrong.toml &&
        complains 'wrong.toml:4:1: unknown key "shadin" (did you mean "shading"?)' &&
        exits 0 "$lom" plan scene.toml --size 32x18 --settings over.toml && says 'shading              flat; by default phong'
}

check bad_input_leaves_nothing bad_input
check all_results_are_written whole_result
check the_reference_is_kept kept_reference
check references_of_ones_own own_reference
check settings_are_laid_over_a_scene settings_file
browser=$(command -v chromium || command -v chromium-browser)
if [ -z "$browser" ]; then
    echo "SKIP the page in a browser: chromium is not installed"
else
    shows() {
        timeout 300 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage \
            --user-data-dir="$folder/profile" --dump-dom "file://$PWD/out/trade.html" 2>/dev/null | grep -q 'polyline class="front"'
    }
    check a_browser_shows_the_page shows
fi
exit $failures
