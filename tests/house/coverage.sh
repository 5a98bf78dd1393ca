#!/bin/sh
# What the tests executed, from the counts that a build with COVERAGE=1 keeps: a line for each file of src/ (of a .wide.c its
# widths together), the least covered first, then one for each folder, then the sum. Fails when less than LEAST percent of
# the lines were executed. With names of files: their lines that were not executed.
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build-coverage}
LEAST=${LEAST:-98}
# Of a file that is no longer there, an older build may have left some.
objects=$(find "$BUILD/src" -name '*.gcno' | while read -r object; do
    source=$(echo "${object#"$BUILD"/}" | sed 's/\.w[0-9a-z_]*\.gcno$/.wide.c/; s/\.gcno$/.c/')
    [ ! -f "$source" ] || echo "$object"
done)
[ -n "$objects" ] || { echo "$BUILD/src has no counts; make coverage builds them"; exit 1; }
# One run for all objects, which adds up what several of them have of one file. Files that never ran count as well.
if [ $# -gt 0 ]; then
    # Of a line that several functions were made of, the first is their sum.
    # shellcheck disable=SC2086
    ${GCOV:-gcov} -t $objects 2>"$BUILD/gcov.log" | awk -v names=" $* " -F: '
        $2 ~ /^ *0$/ && $3 == "Source" { file = $4; sub(".*/src/", "src/", file); asked = index(names, " " file " ") > 0 }
        !asked || $2 !~ /^ *[1-9][0-9]*$/ || (file, $2 + 0) in seen { next }
        { seen[file, $2 + 0] = 1 }
        $1 ~ /#####/ { line = $0; sub(/^[^:]*:[^:]*:/, "", line); printf "%s:%d:%s\n", file, $2, line }'
    exit
fi
# shellcheck disable=SC2086
${GCOV:-gcov} -b -n $objects 2>"$BUILD/gcov.log" >"$BUILD/gcov.txt"
awk -v least="$LEAST" -F"[':%]" '
    function share(part, all) { return all > 0 ? 100 * part / all : 100 }
    function row(name, ran, all, taken, ways) {
        return sprintf("%-40s %5d of %5d lines %6.2f %%   %5d of %5d branches %6.2f %%", name, ran, all, share(ran, all),
            taken, ways, share(taken, ways))
    }
    /^File / { file = $2; sub(".*/src/", "src/", file); ours = file ~ /^src\//; next }
    !ours { next }
    /^No executable lines/ { ours = 0 }
    /^Lines executed/ && file in all { ours = 0; next } # of all files together, the last of their blocks
    /^Lines executed/ { split($0, word, " of "); all[file] = word[2]; ran[file] = int($2 * word[2] / 100 + 0.5) }
    /^Taken at least once/ { split($0, word, " of "); ways[file] = word[2]; taken[file] = int($2 * word[2] / 100 + 0.5) }
    END {
        for (file in all) {
            print all[file] - ran[file] "\t" row(file, ran[file], all[file], taken[file], ways[file]) | "sort -k1,1nr -k2,2 | cut -f2-"
            split(file, part, "/")
            n = part[1] "/" part[2] "/"
            for (i = 0; i < 2; i++) {
                lines[n] += all[file]; executed[n] += ran[file]; branches[n] += ways[file]; followed[n] += taken[file]
                n = "src"
            }
        }
        close("sort -k1,1nr -k2,2 | cut -f2-")
        for (n in lines)
            if (n != "src") print row(n, executed[n], lines[n], followed[n], branches[n]) | "sort"
        close("sort")
        print row("src", executed["src"], lines["src"], followed["src"], branches["src"])
        exit !(lines["src"] > 0 && share(executed["src"], lines["src"]) >= least)
    }' "$BUILD/gcov.txt"
