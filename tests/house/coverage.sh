#!/bin/sh
# What the tests executed, from the counts that a build with COVERAGE=1 keeps: a line for each file of src/ (of a .wide.c its
# widths together), the least covered first, then the sum. Fails when less than LEAST percent of the lines were executed.
cd "$(dirname "$0")/../.." || exit 1
BUILD=${BUILD:-build-coverage}
LEAST=${LEAST:-98}
objects=$(find "$BUILD/src" -name '*.gcno')
[ -n "$objects" ] || { echo "$BUILD/src has no counts; make coverage builds them"; exit 1; }
# One run for all objects, which adds up what several of them have of one file. Files that never ran count as well.
# shellcheck disable=SC2086
${GCOV:-gcov} -b -n $objects 2>"$BUILD/gcov.log" >"$BUILD/gcov.txt"
awk -v least="$LEAST" -F"[':%]" '
    function share(part, all) { return all > 0 ? 100 * part / all : 100 }
    /^File / { file = $2; sub(".*/src/", "src/", file); ours = file ~ /^src\//; next }
    !ours { next }
    /^No executable lines/ { ours = 0 }
    /^Lines executed/ && file in all { ours = 0; next } # of all files together, the last of their blocks
    /^Lines executed/ { split($0, word, " of "); all[file] = word[2]; ran[file] = int($2 * word[2] / 100 + 0.5) }
    /^Taken at least once/ { split($0, word, " of "); ways[file] = word[2]; taken[file] = int($2 * word[2] / 100 + 0.5) }
    END {
        order = "sort -k1,1nr -k2,2 | cut -f2-"
        for (file in all) {
            printf "%d\t%-40s %5d of %5d lines %6.2f %%   %5d of %5d branches %6.2f %%\n", all[file] - ran[file], file, ran[file],
                all[file], share(ran[file], all[file]), taken[file], ways[file], share(taken[file], ways[file]) | order
            lines += all[file]; executed += ran[file]; branches += ways[file]; followed += taken[file]
        }
        close(order)
        printf "%-40s %5d of %5d lines %6.2f %%   %5d of %5d branches %6.2f %%\n", "src", executed, lines, share(executed, lines),
            followed, branches, share(followed, branches)
        exit !(lines > 0 && share(executed, lines) >= least)
    }' "$BUILD/gcov.txt"
