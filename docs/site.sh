#!/bin/bash
# docs/site.sh FOLDER [WEB]: every page of the project as HTML there, to be read from the file system without a network:
# the Markdown files by cmark-gfm, with the pictures and files that they link, and a page a public header, whose comments
# are the reference; and of the folder WEB, where it is, the lessons that draw in the browser (make wasm). Then every link is followed; status 1 when one leads nowhere, each named with its page. Status 2
# without cmark-gfm.
set -u
cd "$(dirname "$0")/.." || exit 2
to=${1:?docs/site.sh FOLDER [WEB]} web=${2:-}
case $to in /*) ;; *) to=$PWD/$to ;; esac
command -v cmark-gfm >/dev/null || { echo "SKIP docs: cmark-gfm is not installed."; exit 2; }
mkdir -p "$to"
if [ -e "$web/index.html" ]; then mkdir -p "$to/web" && cp "$web"/*.html "$to/web"; fi
# bench/cloud-experiments.md is what docs/cloud-experiments.md is made of.
pages=$(find README.md CHANGELOG.md docs bench tests -name '*.md' ! -path bench/cloud-experiments.md | LC_ALL=C sort)

style='body{margin:2em auto;max-width:60em;padding:0 1em;font:16px/1.5 sans-serif;color:#222}
h1,h2,h3{line-height:1.2}pre,code{font:14px/1.4 monospace;background:#f4f4f2}pre{padding:.7em;overflow-x:auto}
table{border-collapse:collapse;display:block;overflow-x:auto}td,th{border:1px solid #ccc;padding:.2em .5em}
img{max-width:100%}a{color:#0a5a8a}nav{font-size:14px;margin-bottom:2em}'

# The way from a page's folder up to the site's.
up() { dirname "$1" | sed 's|^\.$||; s|[^/][^/]*|..|g; s|$|/|; s|^/$||'; }

# A whole page from its body: page PATH TITLE.
page() {
    printf '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">\n'
    printf '<title>%s</title><style>%s</style></head><body>\n<nav>' "$2" "$style"
    for entry in README:lom docs/architecture:Architecture docs/scene:Scenes docs/lessons/README:Lessons \
        docs/water:Water docs/clouds:Clouds docs/numerics:Numerics docs/limits:Limits include/index:Headers \
        CHANGELOG:Changes; do
        printf '<a href="%s%s.html">%s</a> ' "$(up "$1")" "${entry%%:*}" "${entry##*:}"
    done
    printf '</nav>\n'
    lesson=${1#docs/lessons/} lesson=${lesson%/README}
    [ "$1" != docs/lessons/README ] || lesson=index
    [ "$1" = "$lesson" ] || [ ! -e "$to/web/$lesson.html" ] ||
        printf '<p><a href="%sweb/%s.html">Drawn in the browser</a></p>\n' "$(up "$1")" "$lesson"
    cat
    printf '</body></html>\n'
}

# Headings get the names by which pages on the web call them; links to pages lead to their HTML.
anchors_and_links() {
    awk '{
        if (match($0, /^<h[1-6]>.*<\/h[1-6]>$/)) {
            level = substr($0, 3, 1); text = substr($0, 5, length($0) - 9); name = tolower(text)
            gsub(/<[^>]*>/, "", name); gsub(/&[a-z]+;/, "", name); gsub(/[^a-z0-9 _-]/, "", name); gsub(/ /, "-", name)
            if (seen[name]++) name = name "-" (seen[name] - 1)
            $0 = "<h" level " id=\"" name "\">" text "</h" level ">"
        }
        print
    }' | sed -E '/href="[a-z]+:/!s/href="([^"#]*)\.md(#[^"]*)?"/href="\1.html\2"/g'
}

for source in $pages; do
    out=$to/${source%.md}.html
    mkdir -p "$(dirname "$out")"
    title=$(sed -n '/^# /{s/^# //;s/[&<>]//g;p;q}' "$source")
    cmark-gfm --unsafe -e table -e strikethrough -e autolink "$source" | anchors_and_links |
        page "${source%.md}" "${title:-$source}" >"$out"
done

# A header as it stands, each function with a name to link to; and the list of all.
escape() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
functions() { grep -oE '\blom_[a-z0-9_]+\(' "$1" | tr -d '(' | LC_ALL=C sort -u; }
mkdir -p "$to/include"
for header in include/lom/*.h; do
    name=$(basename "$header" .h)
    {
        echo "<h1>lom/$name.h</h1><pre>"
        escape <"$header" | awk '{
            if (match($0, /^[A-Za-z].*[ *]lom_[a-z0-9_]+\(/) && match($0, /lom_[a-z0-9_]+\(/)) {
                function_name = substr($0, RSTART, RLENGTH - 1)
                if (!seen[function_name]++) printf "<span id=\"%s\"></span>", function_name
            }
            print
        }'
        echo '</pre>'
    } | page "include/$name" "lom/$name.h" >"$to/include/$name.html"
done
{
    echo '<h1>The headers</h1>'
    for header in include/lom/*.h; do
        name=$(basename "$header" .h)
        printf '<h2><a href="%s.html">lom/%s.h</a></h2>\n<p>' "$name" "$name"
        for function in $(functions "$header"); do
            grep -q "id=\"$function\"" "$to/include/$name.html" && printf '<a href="%s.html#%s">%s</a> ' "$name" "$function" "$function"
        done
        echo '</p>'
    done
} | page include/index 'The headers of lom' >"$to/include/index.html"
cp "$to/README.html" "$to/index.html"

# Every link: to a page (and its heading), or to a file of the project, which then comes along.
broken=0
complain() { echo "$1: the link $2 leads nowhere"; broken=$((broken + 1)); }
follow() {
    local from=$1 link=$2 file=${2%%#*} anchor='' target
    case $link in *:*) return ;; *\#*) anchor=${link#*#} ;; esac
    target=$(realpath -m --relative-to=. "$(dirname "$from")/$file")
    [ -n "$file" ] || target=$from
    if [ ! -e "$to/$target" ] && [ -e "$target" ]; then
        mkdir -p "$(dirname "$to/$target")"
        cp -r "$target" "$to/$target"
    fi
    [ -e "$to/$target" ] || { complain "$from" "$link"; return; }
    [ -z "$anchor" ] || grep -q "id=\"$anchor\"" "$to/$target" || complain "$from" "$link"
}
while IFS=: read -r from link; do
    follow "${from#"$to"/}" "$link"
done < <(cd "$to" && grep -oHE '(href|src)="[^"]+"' -r --include='*.html' . | sed -E 's|^\./||; s/(href|src)="([^"]*)"/\2/' | LC_ALL=C sort -u)
echo "$(find "$to" -name '*.html' | wc -l) pages in $to, $broken broken links"
[ "$broken" -eq 0 ]
