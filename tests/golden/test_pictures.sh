#!/bin/sh
# Proves that pictures of the pages are what the commands under them draw: some that are quick (all of them in make
# check-long), that every picture of the gallery has a command, and that one which is not its command's is found.
cd "$(dirname "$0")/../.." || exit 2
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
trap 'exit 2' INT TERM
failures=0
verdict() { # NAME, whether it holds, what is wrong
    if [ "$2" = 0 ]; then echo "PASS $1"; else
        echo "FAIL $1: $3; repeat: BUILD=$BUILD sh tests/golden/test_pictures.sh"
        failures=1
    fi
}

docs/pictures.sh --check layers sprites lamps materials shading-toon normals shells >"$work/log" 2>&1
verdict pages_show_what_their_commands_draw $? "$(head -n 1 "$work/log")"

docs/pictures.sh --list | cut -f 1 >"$work/drawn"
sed -n 's/.*lom-cc docs\/examples\/\([a-z_]*\)\.c .*/\1/p' docs/gallery.md >>"$work/drawn"
sed -n 's/^!\[.*(pictures\/\(.*\)\.png)$/\1/p' docs/gallery.md | grep -vxF -f "$work/drawn" >"$work/missing"
[ "$(wc -l <"$work/drawn")" -gt 40 ] && [ ! -s "$work/missing" ]
verdict the_gallery_says_how $? "no command for $(tr '\n' ' ' <"$work/missing")"

mkdir -p "$work/copy/docs/pictures"
ln -s "$PWD/assets" "$work/copy/assets"
cp README.md "$work/copy"
cp docs/gallery.md docs/pictures.sh "$work/copy/docs"
cp docs/pictures/lamps.png "$work/copy/docs/pictures/normals.png"
(cd "$work/copy" && LOM="$OLDPWD/${BUILD:-build}/lom" docs/pictures.sh --check normals) >"$work/log" 2>&1
[ $? -eq 1 ] && grep -q 'normals.png is not what its command draws' "$work/log"
verdict another_picture_is_found $? "$(head -n 1 "$work/log")"
exit $failures
