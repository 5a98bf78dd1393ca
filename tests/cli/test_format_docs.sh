#!/bin/sh
# Proves that the documented command makes docs/formats.md again, byte for byte, and that every name it lists is taken
# by --format or, where nothing writes it, is not.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
docs=$PWD/docs/formats.md
printf 'P6 1 1 255\nabc' >"$folder/in.ppm"
printf '[output]\nwidth = 4\nheight = 4\n' >"$folder/s.toml"

page() {
    exits 0 "$lom" make format-docs -o - && cmp "$folder/out" "$docs"
}

# name format ending read write bits channels
rows() {
    sed -n '/^  name /,/^```/p' "$docs" | grep '^  [a-z0-9]* .*\.' | awk '{ print $1, $3, $4, $5, $NF }'
}

every_row() {
    rows | grep -c . >"$folder/count" && [ "$(cat "$folder/count")" -ge 8 ] || return 1
    rows | while read -r name ending reads writes last; do
        if [ "$last" = video ]; then
            exits 0 "$lom" render "$folder/s.toml" -o "$folder/a$ending" && exits 2 "$lom" convert "$folder/in.ppm" "$folder/a$ending"
        elif [ "$writes" = yes ]; then
            exits 0 "$lom" convert "$folder/in.ppm" "$folder/a$ending" && exits "$([ "$reads" = yes ] && echo 0 || echo 2)" "$lom" info "$folder/a$ending" &&
                exits 0 "$lom" convert "$folder/in.ppm" "$folder/b" --format "$name" && cmp "$folder/a$ending" "$folder/b" || exit 1
            case $last in 3 | 4) ;; *) continue ;; esac # colours, as a picture that is drawn has
            exits 0 "$lom" render "$folder/s.toml" -o "$folder/c$ending" --set "output.format=\"rgb$([ "$name" = pfm ] && echo 32f || echo 8)\""
        else
            exits 2 "$lom" convert "$folder/in.ppm" "$folder/a$ending"
        fi || exit 1
    done
}

helps() {
    for command in convert render info; do
        exits 0 "$lom" $command --help && sed -n '/^kinds of picture files/,$p' "$folder/out" >"$folder/help" &&
            sed -n '/^kinds of picture files/,/^```/p' "$docs" | grep -v '^```' | cmp - "$folder/help" || return 1
    done
}

check format_docs page
check format_docs_every_row every_row
check format_docs_in_helps helps
exit $failures
