#!/bin/sh
# docs/pictures.sh [--check | --list] [NAME...]
# Draws the pictures of docs/pictures again, all or those named, by the commands on the pages: lines `lom render` or
# `lom overlay` that write NAME.png; by those below for the README, and for docs/water.md, whose models are side by side.
# What has changed is replaced, and told; with --check it is told alone, exit 1. LOM names another program than build/lom.
# Look at what it has drawn.
cd "$(dirname "$0")/.." || exit 2
lom=${LOM:-${BUILD:-build}/lom} mode=draw
case $1 in --check | --list) mode=${1#--}; shift ;; esac
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 2' INT TERM

commands() { # NAME, a tab, the command; the first of each name
    {
        for scene in flight lake dusk; do echo "lom render assets/scenes/$scene.toml --size 960x540 -o $scene.png"; done
        cat docs/gallery.md README.md docs/*.md | sed -e ':a' -e '/\\$/{N;s/\\\n *//;ba' -e '}'
    } | sed -n 's/^ *\(lom \(render\|overlay\) .*-o \(docs\/pictures\/\)\{0,1\}\([a-z_-]*\)\.png.*\)/\4\t\1/p' |
        awk -F'\t' '!seen[$1]++' | while IFS="$tab" read -r name command; do
        [ -f "docs/pictures/$name.png" ] && printf '%s\t%s\n' "$name" "$command"
    done
    printf 'gallery\tgallery\n'
    for scene in lagoon swell gale cove reef surf wake; do printf 'water-%s\tmodels %s\n' $scene $scene; done
}
tab=$(printf '\t')

# Twelve scenes in four rows, each with two white pixels around it.
gallery() {
    white() { head -c $(($1 * 3)) /dev/zero | tr '\0' '\377'; }
    mkdir "$work/cells" || return 2
    n=0
    while read -r scene frame; do
        "$lom" render "assets/scenes/$scene.toml" --size 320x180 --frame "$frame" --quiet -o "$work/cells/$n.ppm" || return 2
        tail -c 172800 "$work/cells/$n.ppm" | split -a 3 -b 960 - "$work/cells/$n."
        n=$((n + 1))
    done <<END
falls 60
mackerel 0
storm 0
reef 0
sunset 0
cumulus 0
surf 60
wake 90
gale 0
lagoon 0
river 0
tarn 0
END
    white 2 >"$work/gap"
    white 4 >"$work/space"
    white 972 >"$work/line"
    {
        printf 'P6\n972 736\n255\n'
        for first in 0 3 6 9; do
            cat "$work/line" "$work/line"
            for row in "$work/cells/$first".???; do
                row=${row##*.}
                [ "$row" = ppm ] && continue
                cat "$work/gap" "$work/cells/$first.$row" "$work/space" "$work/cells/$((first + 1)).$row" "$work/space" \
                    "$work/cells/$((first + 2)).$row" "$work/gap"
            done
            cat "$work/line" "$work/line"
        done
    } >"$work/gallery.ppm"
    "$lom" convert "$work/gallery.ppm" "$work/gallery.png"
}

draw() { # NAME COMMAND
    case $2 in
    gallery) gallery; return ;;
    models*) LOM=$lom bench/water_models.sh --pictures "$work" "assets/scenes/${2#models }.toml" >/dev/null 2>&1; return ;;
    esac
    eval "set -- $2"
    shift
    for word in "$@"; do # each is taken from the front and put at the end
        shift
        case $word in *.png) word=$work/${word##*/} ;; esac
        set -- "$@" "$word"
    done
    "$lom" "$@" >/dev/null 2>&1
}
hash_of() { "$lom" info "$1" | sed 's/.*hash //'; }

commands >"$work/commands"
[ "$mode" = list ] && { cat "$work/commands"; exit 0; }
for name in "$@"; do
    grep -q "^$name$tab" "$work/commands" || { echo "docs/pictures.sh: no page has a command for $name" >&2; exit 2; }
done
failed=0
while IFS="$tab" read -r name command <&3; do
    case " $* " in "  " | *" $name "*) ;; *) continue ;; esac
    draw "$name" "$command" || { echo "docs/pictures.sh: $command" >&2; exit 2; }
    [ "$(hash_of "$work/$name.png")" = "$(hash_of "docs/pictures/$name.png")" ] && continue
    if [ "$mode" = check ]; then
        echo "docs/pictures/$name.png is not what its command draws: $command"
        failed=1
    else
        mv "$work/$name.png" "docs/pictures/$name.png"
        echo "docs/pictures/$name.png"
    fi
done 3<"$work/commands"
exit $failed
