#!/bin/sh
# Proves that docs/numerics.md names a test for every extreme case and every group of the conformance suites, and that every test it names exists and is run.
page=docs/numerics.md
missing= absent=
for case in G:9 K:5 C:25 T:21 R:12 A:9 S:11 Z:8 B:9 F:14 W:4 O:7 V:19 I:6 L:8 X:9 P:4 U:3 E:3 H:3 Y:1 N:6 J:2 Q:2 D:6 M:7; do
    number=1
    while [ $number -le "${case#*:}" ]; do
        id=${case%:*}$number
        grep -q "^| $id |" $page || missing="$missing $id"
        number=$((number + 1))
    done
done
if [ -z "$missing" ]; then echo "PASS every_case_has_a_test"; else
    echo "FAIL every_case_has_a_test: $page lacks$missing; repeat: tests/house/test_numerics.sh"; fi
rows=$(mktemp) || exit 1
trap 'rm -f "$rows"' EXIT
sed -n 's/^| [GKCTRASZBFWOVILXPUEHYNJQDM][0-9]* |[^|]*| \([^ |]*\) | \(.*\) |$/\1 \2/p' $page | tr -d '`,' >"$rows"
while read -r file names; do
    for name in $names; do
        grep -qE "RUN\($name\)|(check|verdict) $name( |\$)" "tests/$file" 2>/dev/null || absent="$absent $file:$name"
    done
done <"$rows"
[ "$(grep -c . "$rows")" -gt 150 ] || absent="$absent (rows of the table)"
if [ -z "$absent" ]; then echo "PASS every_named_test_exists"; else
    echo "FAIL every_named_test_exists: not found:$absent; repeat: tests/house/test_numerics.sh"; fi
