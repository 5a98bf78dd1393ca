#!/bin/sh
# Proves `lom verify`: a known hash passes and any other fails; each picture is that of `lom render` alone, whatever was
# drawn before it; --approve changes the fields of hashes and no other byte, and nothing after an error; one colour, wrong
# lines, --twice, --line, JUnit's XML.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
lake=$PWD/assets/scenes/lake.toml
cd "$folder/scene" || exit 1
: >empty.toml

# What `lom render` says of a picture.
hash_of() {
    "$lom" render "$@" --hash --quiet | cut -d' ' -f1
}

known_answers() {
    echo "cac75e24435e2f91 $lake --size 160x90" >right
    echo "cac75e24435e2f90 $lake --size 160x90" >wrong
    exits 0 "$lom" verify right --twice && says "right:1: $lake --size 160x90: ok" && says '1 picture: 1 ok' &&
        exits 0 "$lom" verify -q right && [ "$(cat "$folder/out")" = '1 picture: 1 ok' ] &&
        exits 1 "$lom" verify wrong && says 'differs: expected cac75e24435e2f90, got cac75e24435e2f91' &&
        says '1 picture: 1 different' && exits 0 "$lom" verify - <right
}

# Lines of one scene share a renderer, but where plates of clouds age from frame to frame.
as_alone() {
    cat >clouds.toml <<'END'
[output]
width = 64
height = 36
[camera]
position = [0, 100, 0]
target = [0, 100, -100]
[[clouds.wind]]
height = 0
speed = 40
[quality]
impostors = "bounded"
[[cloud]]
kind = "cumulus_fractus"
voxels = [24, 16, 24]
size = [700, 350, 700]
position = [0, 100, -2000]
END
    cat >lines <<'END'
scene.toml
scene.toml --set "camera.position = [1, 2, 5]"
scene.toml --size 64x48 --crop 10,7,20,30
scene.toml --size=64x48 --set water.enabled=false --frame 3
clouds.toml --frame 4
clouds.toml --frame 5
clouds.toml --frame 5 --set 'quality.impostors="off"'
scene.toml
END
    sed 's/^/- /' lines >all
    exits 1 "$lom" verify all && says '8 pictures: 8 not yet approved' &&
        exits 0 "$lom" verify all --approve --threads 1 && exits 0 "$lom" verify all --twice || return 1
    while read -r hash words; do
        expected=$(eval "hash_of $words")
        [ "$hash" = "$expected" ] || { echo "$words: $hash, but render says $expected"; return 1; }
    done <all
    [ "$(cut -d' ' -f1 all | sort -u | wc -l)" -ge 6 ] # they are not all one picture
}

approval() {
    good=$(hash_of scene.toml)
    other=$(hash_of scene.toml --size 20x20)
    manifest() { # HASH HASH
        printf '# "kept"\r\n\nlom 0.1.0 picture 5\n\t%s   scene.toml  # as it is\n%s scene.toml --size 20x20' "$1" "$2"
    }
    manifest "$good" - >some && chmod 640 some && manifest "$good" "$other" >expected &&
        exits 0 "$lom" verify some --approve && cmp some expected && [ "$(stat -c %a some)" = 640 ] || return 1
    manifest 0123456789abcdef 0123456789abcdef >some && manifest 0123456789abcdef "$other" >expected &&
        exits 0 "$lom" verify some --approve --line 5 && cmp some expected &&
        exits 1 "$lom" verify some && says 'some:4: scene.toml: differs' && cmp some expected &&
        exits 2 "$lom" verify some --line 2 && complains 'some:2: there is no picture' || return 1
    # nothing is written after an error, and the other pictures are drawn all the same
    manifest 0123456789abcdef - >some && printf '\n- missing.toml\n- scene.toml --set watr.level=1\n' >>some &&
        cp some expected && exits 2 "$lom" verify some --approve && cmp some expected &&
        complains 'left as it was' && says 'some:6: missing.toml: error: ' && says '2 approved, 2 not drawn' &&
        says 'watr' && exits 2 "$lom" verify - --approve <some
}

one_colour() {
    hash=$(hash_of empty.toml --size 16x16)
    echo "$hash empty.toml --size 16x16" >flat
    exits 1 "$lom" verify flat && says 'one colour, and the line does not say flat' && says '1 of one colour' &&
        exits 1 "$lom" verify flat --approve && echo "$hash empty.toml --size 16x16" | cmp - flat &&
        echo "$hash empty.toml flat --size 16x16" >flat && exits 0 "$lom" verify flat &&
        echo "0$hash" | cut -c 1-16 | sed 's/$/ empty.toml flat --size 16x16/' >flat && exits 1 "$lom" verify flat
}

# Each line: what stderr must say | the line of the manifest. Nothing is drawn, not even of the lines before it.
bad_lines() {
    while IFS='|' read -r text bad; do
        printf -- '- scene.toml\n%s\n' "$bad" >bad
        exits 2 "$lom" verify bad --approve && complains "$text" && [ ! -s "$folder/out" ] &&
            [ "$(wc -l <"$folder/err")" -eq 1 ] && printf -- '- scene.toml\n%s\n' "$bad" | cmp - bad || return 1
    done <<'LINES'
bad:2:1: a line begins with a hash|scene.toml
bad:2:1: a line begins with a hash|cac75e24435e2f9 scene.toml
bad:2:1: a line begins with a hash|cac75e24435e2f911 scene.toml
bad:2:1: a line begins with a hash|CAC75E24435E2F91 scene.toml
bad:2:1: a line begins with a hash|lom 0.1.0 picture 5
bad:2:3: behind the hash stands the file of a scene| -
bad:2:3: behind the hash stands the file of a scene|- # scene.toml
bad:2:3: the quote " is not closed|- "scene.toml
bad:2:21: --size takes WxH|- scene.toml --size 12
bad:2:21: --size 0x4: whole numbers must be from 1|- scene.toml --size 0x4
bad:2:28: --size is given twice|- scene.toml --size=4x4    --size=4x4
bad:2:20: --size needs a value|- scene.toml --size
bad:2:14: no word of a manifest: "--sise" (did you mean "--size"?)|- scene.toml --sise 4x4
bad:2:14: no word of a manifest: "--threads"|- scene.toml --threads 4
bad:2:14: no word of a manifest: "flt" (did you mean "flat"?)|- scene.toml flt
LINES
    echo ' lom 0.1.0 pictures 3' >bad && exits 2 "$lom" verify bad && complains 'bad:1:2: the header is "lom VERSION' &&
        printf '# nothing\n' >bad && exits 2 "$lom" verify bad && complains 'names no picture' &&
        printf -- '- scene.toml\n\0\n' >bad && exits 2 "$lom" verify bad && complains 'zero byte' &&
        exits 2 "$lom" verify missing && complains missing &&
        exits 2 "$lom" verify right --junit right && complains 'are both right' &&
        { echo 'lom 0.0.1 picture 1' && cat right; } >old && exits 0 "$lom" verify old &&
        complains 'old is of picture version 1'
}

reports() {
    printf -- '%s scene.toml\n- scene.toml --size 20x20\n- <&missing.toml --frame 1\n' "$(hash_of scene.toml)" >some
    exits 2 "$lom" verify some --junit out.xml --output new/pictures && [ "$(ls new/pictures)" = 2-scene.toml.png ] &&
        "$lom" render scene.toml --size 20x20 -q -o other.png && cmp other.png new/pictures/2-scene.toml.png &&
        python3 - <<'CODE'
import xml.etree.ElementTree as tree
suite, = tree.parse("out.xml").getroot()
assert (suite.get("name"), suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("some", "3", "1", "1")
right, new, error = suite
assert right.get("name") == "scene.toml" and len(right) == 0
assert new.get("name") == "scene.toml --size 20x20" and "not yet approved" in new.find("failure").get("message")
assert new.find("system-out").text == "[[ATTACHMENT|new/pictures/2-scene.toml.png]]"
assert error.get("name") == "<&missing.toml --frame 1" and "<&missing.toml" in error.find("error").get("message")
CODE
}

# What was right once lies in the cache under its hash, and is shown beside what differs; a file that has another
# picture than its name says is not believed, and made again.
cache() {
    old=$(hash_of scene.toml --size 20x20)
    echo "$old scene.toml --size 20x20" >some
    exits 0 "$lom" verify some --cache kept/here && [ "$(ls kept/here)" = "$old.png" ] &&
        "$lom" render scene.toml --size 20x20 -q -o was.png && cmp was.png "kept/here/$old.png" &&
        touch -d '2020-01-01' "kept/here/$old.png" && exits 0 "$lom" verify some --cache kept/here &&
        [ was.png -nt "kept/here/$old.png" ] || return 1
    echo "$old scene.toml --size 20x20 --frame 0 --set water.enabled=false" >some
    exits 1 "$lom" verify some --cache kept/here -o out && cmp was.png out/1-scene.toml.expected.png &&
        [ "$(ls out | wc -l)" -eq 2 ] && [ "$(ls kept/here)" = "$old.png" ] &&
        "$lom" render scene.toml --size 20x20 --set water.enabled=false -q -o "kept/here/$old.png" && rm -r out &&
        exits 1 "$lom" verify some --cache kept/here -o out && [ "$(ls out)" = 1-scene.toml.png ] &&
        echo "$old scene.toml --size 20x20" >some && exits 0 "$lom" verify some --cache kept/here &&
        cmp was.png "kept/here/$old.png"
}

check known_answers known_answers
check pictures_are_those_of_render_alone as_alone
check approval_changes_hashes_alone approval
check one_colour_must_be_declared one_colour
check wrong_lines_are_refused_where_they_are bad_lines
check pictures_that_were_right_are_kept cache
if command -v python3 >/dev/null; then
    check reports_and_pictures_of_what_fails reports
else
    echo "SKIP reports_and_pictures_of_what_fails: needs python3"
fi
exit $failures
