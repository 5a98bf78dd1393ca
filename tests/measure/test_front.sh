#!/bin/sh
# Proves of the scenes of bench/results/trade-SCENE.csv that every default lies on its front or is named: a setting of one
# dial that is cheaper by a twentieth and no less exact, or nearer by 0.005 of FLIP and no dearer, stands in the table of
# docs/trade.md with its scene and a reason, and none stands there that is not such a one.
cd "$(dirname "$0")/../.." || exit 2
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
failures=0
verdict() { # NAME, what is wrong (empty: nothing)
    if [ -z "$2" ]; then echo "PASS $1"; else
        echo "FAIL $1: $2; repeat: sh tests/measure/test_front.sh"
        failures=1
    fi
}

# Of a scene's sweep, the settings that beat the default: settings,reference,ms,ratio,low,high,psnr,ssim,flip,...
beating() {
    awk -F, '{ gsub(/"/, "", $1) }
        $2 != "the tracer" || $4 == "" || $1 ~ / / { next }
        $1 == "default" { low = $5; high = $6; flip = $9; next }
        ($4 <= 0.95 && $6 < low && $9 <= flip + 1e-5) || ($5 <= high && $9 <= flip - 0.005) { print $1 }' "$1" | sort
}
# Of docs/trade.md, the settings of rows "| SCENE | `SETTING`, `SETTING` | REASON |".
named() {
    sed -n '/^## What beats a default/,$p' docs/trade.md |
        sed -n "s/^| $1 | \(\`[^|]*\`\) | [^| ][^|]\{20,\} |\$/\1/p" | tr -d ' `' | tr ',' '\n' | sort
}

for scene in lake gale cumulus; do
    csv=bench/results/trade-$scene.csv why=
    [ "$(grep -c 'the tracer' $csv)" -gt 20 ] && grep -q '^"default",the tracer,' $csv || why="$csv is no sweep"
    beating $csv >"$folder/beating"
    named $scene >"$folder/named"
    why=$why$(comm -23 "$folder/beating" "$folder/named" | sed 's/$/ beats the default and is not named. /' | tr -d '\n')
    why=$why$(comm -13 "$folder/beating" "$folder/named" | sed 's/$/ is named and beats nothing. /' | tr -d '\n')
    verdict "defaults_of_${scene}_lie_on_its_front_or_are_named" "$why"
done

# The rule finds what it is to find: a cheaper setting, a nearer one, none that is dearer or less exact.
{
    echo 'settings,reference,ms,ratio,ratio_low,ratio_high,psnr,ssim,flip,max_delta,pixels,front,note'
    echo '"default",the tracer,1,1.00,0.98,1.02,20,0.5,0.20000,9,9,0,"default"'
    echo '"a=1",the tracer,1,0.90,0.88,0.92,20,0.5,0.20000,9,9,0,""'
    echo '"b=1",the tracer,1,1.00,0.99,1.03,20,0.5,0.19000,9,9,0,""'
    echo '"c=1",the tracer,1,0.50,0.40,0.60,20,0.5,0.20100,9,9,0,""'
    echo '"d=1",the tracer,1,1.20,1.10,1.30,20,0.5,0.10000,9,9,0,""'
    echo '"a=1 b=1",the tracer,1,0.50,0.40,0.60,20,0.5,0.10000,9,9,0,""'
    echo '"e=1",default,1,0.50,0.40,0.60,inf,1,0.00000,0,0,0,"the same bytes"'
} >"$folder/made.csv"
[ "$(beating "$folder/made.csv" | tr '\n' ' ')" = 'a=1 b=1 ' ] && why= || why="it finds $(beating "$folder/made.csv" | tr '\n' ' ')"
verdict the_rule_finds_what_beats "$why"
exit $failures
