#!/bin/sh
# Proves what `lom verify` shows of pictures that differ, and `lom approve`: the expected picture is drawn again by the
# manifest's own lom and believed for its hash alone; reports do not depend on how many draw; a list approves what it names
# and nothing else; the page, in a browser, shows both pictures and makes that list.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
house=$PWD/tests/house
cd "$folder/scene" || exit 1

hash_of() {
    "$lom" render "$@" --hash --quiet | cut -d' ' -f1
}

# A lom of another time: its water is off. It notes that it was asked.
cat >lom-0.0.1 <<END
#!/bin/sh
echo "\$*" >>asked
exec "$lom" "\$@" --set water.enabled=false
END
chmod +x lom-0.0.1
old=$(hash_of scene.toml --size 20x20 --frame 2 --crop 1,2,12,10 --set water.level=0.1 --set water.enabled=false)
new=$(hash_of scene.toml --size 20x20 --frame 2 --crop 1,2,12,10 --set water.level=0.1)
words='scene.toml --size 20x20 --frame 2 --crop 1,2,12,10 --set water.level=0.1'

drawn_again() {
    "$lom" render scene.toml --size 20x20 --frame 2 --crop 1,2,12,10 --set water.level=0.1 --set water.enabled=false -q -o was.png
    for header in "lom 0.0.1 picture 5" "lom 9 picture 5 by lom-0.0.1" "lom 9 picture 5 by ./lom-0.0.1" "lom 9 picture 5 by $PWD/lom-0.0.1"; do
        rm -rf out kept asked
        printf '%s\n%s %s\n' "$header" "$old" "$words" >some
        PATH=$PWD:$PATH exits 1 "$lom" verify some -o out --cache kept && cmp was.png out/2-scene.toml.expected.png &&
            [ "$(ls kept)" = "$old.png" ] && [ "$(wc -l <asked)" -eq 1 ] || { echo "$header"; return 1; }
        PATH=$PWD:$PATH exits 1 "$lom" verify some -o out --cache kept && [ "$(wc -l <asked)" -eq 1 ] || return 1
    done
    # another picture than the expected one is none; nobody is asked for what nobody looks at
    printf 'lom 0.0.1 picture 5\n%s0 %s\n' "${old%?}" "$words" >some && rm -rf out asked
    [ "${old%?}0" != "$old" ] || printf 'lom 0.0.1 picture 5\n%s1 %s\n' "${old%?}" "$words" >some
    PATH=$PWD:$PATH exits 1 "$lom" verify some -o out && [ "$(ls out)" = 2-scene.toml.png ] && [ -e asked ] && rm asked &&
        PATH=$PWD:$PATH exits 1 "$lom" verify some && [ ! -e asked ] &&
        printf 'lom 0.0.1 picture 5 by\n- scene.toml\n' >some && exits 2 "$lom" verify some && complains 'behind by stands' &&
        printf 'lom 0.0.1 picture 5 of x\n- scene.toml\n' >some && exits 2 "$lom" verify some && complains 'by PROGRAM'
}

# Thirty pictures of four scenes, some wrong, some that cannot be drawn: the same words and the same XML by any number.
any_number_draws() {
    cp scene.toml other.toml && cp scene.toml third.toml
    for i in 1 2 3 4 5 6 7 8 9 10; do
        echo "- scene.toml --size 8x8 --frame $i"
        echo "$new other.toml --size 8x${i}"
        echo "- third.toml --size ${i}x8 --set water.level=$i"
    done >many && echo '- missing.toml' >>many && echo "$new $words" >>many
    exits 2 "$lom" verify many --threads 1 --junit one.xml && cp "$folder/out" one || return 1
    for threads in 2 3 7 64; do
        exits 2 "$lom" verify many --threads $threads --junit more.xml && cmp one "$folder/out" && cmp one.xml more.xml || return 1
    done
    [ "$(wc -l <one)" -eq 33 ] && grep -q '^32 pictures: 1 ok' one && exits 2 "$lom" verify many --threads 3 --approve &&
        exits 1 "$lom" verify many --line 5 --threads 4 && [ "$(wc -l <"$folder/out")" -eq 2 ]
}

lists() {
    printf 'lom 0.0.1 picture 5\n%s %s # kept\n- scene.toml --size 8x8\n' "$old" "$words" >some && cp some before
    printf '# looked at\n\nsome:2: %s %s\r\n' "$old" "$new" >list && exits 0 "$lom" approve - <list &&
        says 'some: 1 picture approved' && sed "s/^$old/$new/" before | cmp - some || return 1
    exits 2 "$lom" approve list && complains 'list:3: line 2 of some has another hash by now' && sed "s/^$old/$new/" before | cmp - some &&
        cp before some && mkdir -p 'a: b' && cp before 'a: b/some' &&
        printf 'a: b/some:3: - %s\na: b/some:2: %s %s\n' "$new" "$old" "$new" >list && exits 0 "$lom" approve list &&
        [ "$(cut -c 1-16 'a: b/some' | tail -n 2 | sort -u)" = "$new" ] && exits 0 "$lom" approve list --manifest some && cmp some 'a: b/some' || return 1
    cp before some
    while IFS='|' read -r text bad; do
        printf 'some:3: - %s\n%s\n' "$new" "$bad" >list
        exits 2 "$lom" approve list && complains "$text" && [ ! -s "$folder/out" ] && cmp before some || return 1
    done <<LINES
list:2: a line of the list is MANIFEST:LINE: OLD NEW|some:2 $old $new
list:2: a line of the list is|some:2: $new
list:2: a line of the list is|some:2: $old -
list:2: a line of the list is|some:2: $old ${new}0
list:2: a line of the list is|some:0: $old $new
list:2: a line of the list is|:2: $old $new
list:2: a line of the list is|$old $new
list:2: there is no picture on line 1 of some|some:1: $old $new
list:2: there is no picture on line 7 of some|some:7: - $new
list:2: line 2 of some has another hash|some:2: - $new
list:2: the list is of some, and this line of other|other:2: $old $new
LINES
    printf '# nothing\n' >list && exits 2 "$lom" approve list && complains 'approves no picture' &&
        printf -- '-:3: - %s\n' "$new" >list && exits 2 "$lom" approve list && complains '--manifest FILE' &&
        exits 0 "$lom" approve list --manifest some && [ "$(tail -n 1 some)" = "$new scene.toml --size 8x8" ]
}

# What a browser finds: the modes, what slides and flicks, the list that approves the two that can be.
page() {
    printf 'lom 0.0.1 picture 5\n%s %s --set "camera.position = [0, 2, 6]" # <&\n- scene.toml --size 8x8\n- </script>.toml\n%s scene.toml\n%s\n' \
        "$old" "$words" "$(hash_of scene.toml)" "0123456789abcdef scene.toml --size 9x9" >some
    old2=$(hash_of scene.toml --size 20x20 --frame 2 --crop 1,2,12,10 --set water.level=0.1 --set water.enabled=false --set "camera.position = [0, 2, 6]")
    sed -i "2s/^$old/$old2/" some
    PATH=$PWD:$PATH exits 2 "$lom" verify some --page page.html && [ -s page.html ] && ! grep -q 'https\?://' page.html || return 1
    cat <<STEPS >steps
go file://$PWD/page.html
document.readyState=='complete'&&all.length
all.map(p=>p.how).join()
id('under').naturalWidth+'x'+id('under').naturalHeight+' '+id('over').hidden
mode+' '+id('over').style.clipPath+' '+id('left').textContent+' '+id('right').textContent
click id('stage').getBoundingClientRect().left+id('stage').getBoundingClientRect().width/4 id('stage').getBoundingClientRect().top+5
id('bar').style.left
(choose('difference'),id('under').src!=picture(all[0],'actual')&&id('under').src.length>99)
(choose('flick'),id('under').src==picture(all[0],'expected'))
id('under').src==picture(all[0],'actual')
click 9+id('approve').getBoundingClientRect().left 9+id('approve').getBoundingClientRect().top
(show(1),approve(),modes.filter(b=>!b.disabled).map(b=>b.dataset.mode).join())
(show(3),approve(),show(2),approve(),id('approve').disabled)
(show(4),id('words').textContent.includes('not at hand'))
id('count').textContent
id('approved').value
STEPS
    timeout 100 node "$house/browser.mjs" "$browser" "$folder/profile" 1280x800 shot.png <steps >answers || return 1
    cat answers
    cat >expected <<'END'
5
"different,not yet approved,not drawn,ok,different"
"12x10 false"
"slide inset(0px 0px 0px 50%) expected drawn"
"25%"
true
true
true
"actual"
true
true
"2 of 3 approved"
END
    head -n 12 answers | cmp - expected && tail -n 1 answers | sed 's/^"//; s/\\n"$//; s/\\n/\n/g' >list && [ "$(wc -l <list)" -eq 2 ] &&
        exits 0 "$lom" approve - <list && says '2 pictures approved' && [ "$(sed -n 3p some)" = "$(hash_of scene.toml --size 8x8) scene.toml --size 8x8" ] &&
        exits 0 "$lom" verify some --line 2
}

check what_was_expected_is_drawn_again drawn_again
check reports_are_the_same_by_any_number_of_workers any_number_draws
check lists_approve_what_they_name lists
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [ -n "$browser" ] && command -v node >/dev/null; then
    check the_page_shows_and_approves page
else
    echo "SKIP the_page_shows_and_approves: needs chromium and node"
fi
exit $failures
