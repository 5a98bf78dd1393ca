#!/bin/sh
# Proves `lom grade` on students' files (tests/lessons/students: each is named for the mistake that it makes in words of its
# own, right_* for none): that right ones pass, that 95 % of the mistakes are named, what crashes, endless loops and files
# that do not compile give, and that its reports are JSON and XML; that it writes nothing else, and leaves no folder behind.
cd "$(dirname "$0")/../.." || exit 1
compiler=${CC:-cc}
if [ -n "$SAN" ]; then
    echo "SKIP lom grade: a library with sanitizers takes more memory than a student's program may have"
    exit 0
fi
printf 'int main(void) { return 0; }' >"${TMPDIR:-/tmp}/lom-grade-$$.c"
$compiler "${TMPDIR:-/tmp}/lom-grade-$$.c" -o "${TMPDIR:-/tmp}/lom-grade-$$" 2>/dev/null
there=$?
rm -f "${TMPDIR:-/tmp}/lom-grade-$$.c" "${TMPDIR:-/tmp}/lom-grade-$$"
if [ $there -ne 0 ]; then
    echo "SKIP lom grade: there is no compiler \"$compiler\""
    exit 0
fi
. tests/cli/cli.sh
students=$PWD/tests/lessons/students
cd "$folder" || exit 1
mkdir temporary
TMPDIR=$folder/temporary CC=$compiler
[ -z "$COVERAGE" ] && ! nm "$(dirname "$lom")/liblom.a" 2>/dev/null | grep -q __gcov_init || CC="$compiler --coverage"
export TMPDIR CC

student() { # NAME STAGE-SIGNATURE BODY
    printf '#include "student.h"\n#include <stdio.h>\n#include <stdlib.h>\n#include <unistd.h>\n%s\n{\n%s\n}\n' "$2" "$3" >"$1.c"
}
nearer='bool student_is_nearer(float depth, float before)'
student crash "$nearer" 'static int n; if (n++ == 17) *(volatile int *)(size_t)before = 1; return depth > before;'
student loop "$nearer" 'static int n; for (n++; n > 30;) {} return depth > before;'
student sleeper "$nearer" 'static int n; if (n++ > 3) pause(); return depth > before;'
student quits "$nearer" 'static int n; if (n++ > 3) exit(0); return depth > before;'
student speaks "$nearer" 'printf("right, believe me\n"); FILE *f = fopen("/dev/full", "w"); if (f) fclose(f); return depth > before;'
student forger "$nearer" 'for (int i = 0; i < 100; i++) (void)!write(3, "\377\377\377\377\377\377\377\377", 8); return depth > before;'
student deep "$nearer" 'volatile char room[65536]; room[(int)depth & 1] = 0; return student_is_nearer(depth, before) || room[1];'
student two "$nearer" 'return depth > before;} void student_march(float depth, float light, float ray[2]) { ray[0] = depth; ray[1] = light;'
student syntax "$nearer" 'return depth >'
student signature 'bool student_is_nearer(int depth)' 'return depth;'
student copies "$nearer" 'return is_nearer(depth, before);'
student unknown 'static int student_is_best(void)' 'return 1;'
student misnamed 'bool student_is_neerer(float depth, float before)' 'return depth > before;'
student unnamed 'bool is_nearer (float depth, float before)' 'return depth > before;'
student tries "$nearer" 'return depth > before;} int main(void) { return student_is_nearer(1, 0) ? 0 : abort(), 1;'
student unlinked "float helper(float); $nearer" 'return helper(depth) > before;'
printf 'bool student_is_nearer(float depth, float before)\n{\n return depth > before;\n}\n' >bare.c
printf 'int student_is_nearer(double depth, double before)\n{\n return depth > before;\n}\n' >doubles.c
student '-dash' "$nearer" 'return depth > before;'

right_ones_pass() {
    exits 0 "$lom" grade "$students"/right_*.c -- -dash.c && [ "$(grep -c ' right .*12288/12288' out)" -eq 5 ] &&
        exits 0 "$lom" grade "$students/right_covers.c" && says 'right in all 12288 cases, bit for bit'
}

# A class is one command: its table and its reports.
mistakes_are_named() {
    exits 1 "$lom" grade --json class.json --junit class.xml "$students"/[!r]*.c "$students/rounding.c" &&
        [ "$(grep -c 'not right' out)" -ge 25 ] && python3 - <<'CODE'
import json, re, os, xml.etree.ElementTree as tree
named = wrong = 0
for line in open("class.json"):
    result = json.loads(line)
    file = os.path.basename(result["output"].split(".c was graded")[0])
    output = "".join(test["output"] for test in result["tests"])
    found = re.search(r"probably broken: .*\n  (\w+) \(", output)
    named += found is not None and found.group(1) == file
    wrong += 1
    assert result["score"] == sum(test["score"] for test in result["tests"]) < 10, result
    assert len(result["tests"]) == 2 and all(test["max_score"] == 5 and test["name"] for test in result["tests"])
    if found is None or found.group(1) != file:
        print(file, "is taken for", found and found.group(1))
suites = tree.parse("class.xml").getroot()
assert suites.tag == "testsuites" and len(suites) == wrong
assert all(len(suite) == 2 == int(suite.get("tests")) and suite.findall("testcase/failure") for suite in suites)
print(named, "of", wrong)
assert wrong >= 25 and named >= 0.95 * wrong
CODE
}

a_difference_is_told_and_drawn() {
    exits 1 "$lom" grade "$students/all_edges.c" -o drawn.png && says 'first difference in case ' && says 'covered is 1, right is 0' &&
        says 'asked: vertices in 1/256 pixel' && says 'top-left rule' && says 'Direct3D 11.3' && says 'where they differ: 65 pixels' &&
        exits 0 "$lom" info drawn.png && says '784 x 160'
}

what_ends_badly_is_a_verdict() {
    exits 1 "$lom" grade crash.c && says 'crashed with SIGSEGV' && says 'in case 17: depth' && says 'right in 17 of' &&
        exits 1 "$lom" grade --seconds 1 loop.c --json loop.json && says 'did not end within 1 s in case 30: ' &&
        exits 1 "$lom" grade quits.c && says 'ended the program with status 0 in case 4' &&
        exits 1 "$lom" grade deep.c && says 'crashed with SIGSEGV' && exits 1 "$lom" grade forger.c && says 'not right' &&
        exits 0 "$lom" grade speaks.c && ! grep -q believe out err && python3 -c 'import json; r = json.load(open("loop.json"))
assert r["score"] == 0 and "did not end" in r["tests"][1]["output"]' &&
        exits 1 "$lom" grade --seconds 1 sleeper.c && says 'did not end within 1 s in case 4' &&
        exits 1 "$lom" grade two.c && says 'two.c: is_nearer: right' && says 'two.c: march: not right'
}

what_cannot_be_graded_is_refused() {
    exits 2 "$lom" grade syntax.c --json no.json --junit no.xml && complains 'syntax.c does not compile:' && complains 'syntax.c:8:' &&
        python3 -c 'import json, xml.etree.ElementTree as tree; r = json.load(open("no.json"))
assert r["score"] == 0 and "does not compile" in r["output"]
assert tree.parse("no.xml").getroot()[0].get("errors") == "1"' &&
        exits 2 "$lom" grade signature.c && complains 'does not compile' &&
        exits 2 "$lom" grade copies.c && complains 'is_nearer_is_for_you_to_write' &&
        exits 2 "$lom" grade unknown.c && complains 'no function whose stage is known' &&
        exits 2 "$lom" grade none.c && complains 'none.c cannot be read' &&
        exits 2 "$lom" grade && exits 2 "$lom" grade two.c crash.c -o both.png && complains 'one student' && [ ! -e both.png ] &&
        exits 2 env CC=no-such-compiler "$lom" grade two.c && complains 'there is no compiler "no-such-compiler"' &&
        exits 2 "$lom" grade unknown.c speaks.c && says 'ungraded' && grep -q '^speaks.c .* right ' out
}

# What students stumble over: a row says what to do, and a main or a forgotten include harms nothing.
a_row_says_what_is_wrong() {
    exits 2 "$lom" grade tries.c bare.c misnamed.c unnamed.c crash.c syntax.c unlinked.c doubles.c unknown.c --json row.json &&
        grep -q '^tries.c .* right ' out && grep -q '^bare.c .* right ' out &&
        says 'is known: call student_is_neerer student_is_nearer' && says 'is known: call is_nearer student_is_nearer' &&
        grep -q '^crash.c .*crashed .*SIGSEGV.* in case 17: depth' out && grep -q '^syntax.c .*does not compile: 8:' out &&
        grep -q "^unlinked.c .*undefined reference to .helper" out && grep -q '^doubles.c .*does not compile: 1:5: error' out &&
        grep -q '^unknown.c .*name it student_covers' out && says '9 files: 2 right, 1 wrong, 6 could not be graded' &&
        python3 -c 'import json; r = [json.loads(line) for line in open("row.json")]
assert [s["extra_data"]["file"] for s in r][:3] == ["tries.c", "bare.c", "misnamed.c"] and len(r) == 9'
}

# Ended by any signal, even by SIGKILL, it leaves no folder in TMPDIR.
no_folder_is_left() {
    for number in TERM KILL; do
        "$lom" grade --seconds 60 loop.c >/dev/null 2>&1 &
        process=$!
        for wait in 1 2 3 4 5 6 7 8 9 10; do
            ls temporary/lom-*/student >/dev/null 2>&1 && break
            sleep 1
        done
        kill -$number $process
        wait $process 2>/dev/null
        sleep 1
    done
    ls -A temporary
    [ -z "$(ls -A temporary)" ]
}

nothing_else_is_written() {
    mkdir clean && cd clean && exits 0 "$lom" grade ../speaks.c && cd .. && [ -z "$(ls -A clean)" ]
}

check right_ones_pass right_ones_pass
check mistakes_are_named mistakes_are_named
check a_difference_is_told_and_drawn a_difference_is_told_and_drawn
check what_ends_badly_is_a_verdict what_ends_badly_is_a_verdict
check what_cannot_be_graded_is_refused what_cannot_be_graded_is_refused
check a_row_says_what_is_wrong a_row_says_what_is_wrong
check no_folder_is_left no_folder_is_left
check nothing_else_is_written nothing_else_is_written
exit $failures
