#!/bin/bash
# Proves: `make docs` makes a page of every Markdown file and of every public header, no link in them leads nowhere, a
# link that does is found, and a browser shows the pages from the file system. What is not installed is a SKIP.
cd "$(dirname "$0")/../.." || exit 2
failed=0
check() { if [ "$2" = yes ]; then echo "PASS $1"; else echo "FAIL $1: $3; repeat: bash tests/house/test_docs.sh"; failed=1; fi; }
command -v cmark-gfm >/dev/null || { echo "SKIP docs: cmark-gfm is not installed"; exit 0; }
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT INT TERM

if docs/site.sh "$work/site" >"$work/log" 2>&1; then good=yes; else good=no; fi
check "every link of the pages leads somewhere" $good "$(head -n 5 "$work/log")"
missing=
for header in include/lom/*.h; do [ -s "$work/site/include/$(basename "$header" .h).html" ] || missing="$missing $header"; done
for page in README.md docs/*.md docs/lessons/*/README.md; do [ -s "$work/site/${page%.md}.html" ] || missing="$missing $page"; done
check "every page and header is there" "$([ -z "$missing" ] && echo yes)" "missing:$missing"
check "a function has a name to link to" \
    "$(grep -q 'id="lom_render_frame"' "$work/site/include/render.html" && grep -q 'render.html#lom_render_frame' "$work/site/include/index.html" && echo yes)" \
    "lom_render_frame has none"

# a link that leads nowhere is found: a copy of what the script reads, with one page more
mkdir "$work/copy"
cp -r README.md CHANGELOG.md docs bench tests include assets Makefile LICENSE src "$work/copy" 2>/dev/null
printf '# Wrong\n\n[nowhere](nowhere.md) and [no heading](water.md#no-such-heading)\n' >"$work/copy/docs/wrong.md"
"$work/copy/docs/site.sh" "$work/wrong" >"$work/log" 2>&1
check "links that lead nowhere are found" \
    "$([ $? -eq 1 ] && grep -q 'docs/wrong.html: the link nowhere.html' "$work/log" && grep -q 'no-such-heading' "$work/log" && echo yes)" \
    "$(tail -n 3 "$work/log")"

browser=$(command -v chromium || command -v chromium-browser)
if [ -z "$browser" ]; then
    echo "SKIP pages in a browser: chromium is not installed"
else
    for page in index docs/scene docs/lessons/triangle/README include/render; do
        timeout 300 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage \
            --user-data-dir="$work/profile" --dump-dom "file://$work/site/$page.html" >"$work/dom" 2>"$work/log"
        check "a browser shows $page" "$(grep -q '<title>..*</title>' "$work/dom" && echo yes)" "no title; $(tail -n 1 "$work/log")"
    done
fi
exit $failed
