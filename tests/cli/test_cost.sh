#!/bin/sh
# Proves `lom cost`: declared work is the same by any widths and threads; frames are spread over the run; the run's seconds
# are the frames' work, linear between those drawn, times what a cycle took here.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh

work_of() {
    "$lom" cost "$@" --json | grep -o '"work": [0-9.e+]*'
}

same_work() {
    work_of "$scene" --frames 0:9 --threads 1 --lanes 4 >"$folder/one" && work_of "$scene" --frames 0:9 --threads 3 --lanes 16 >"$folder/two" &&
        cmp "$folder/one" "$folder/two" && [ "$(wc -l <"$folder/one")" -eq 5 ] &&
        work_of "$scene" --size 96x64 --frames 0:9 >"$folder/more" && ! cmp -s "$folder/one" "$folder/more" &&
        ! "$lom" cost "$scene" --frames 0:9 | grep -i nan
}

arithmetic() {
    "$lom" cost "$scene" --frames 3:20 --draw 4 --json >"$folder/four" && "$lom" cost "$scene" --frames 7:7 --json >"$folder/one" &&
        "$lom" cost assets/scenes/surf.toml --size 40x24 --frames 0:6 --draw 3 --json >"$folder/steps" && python3 - "$folder" <<'CODE'
import json, sys
four, one, steps = (json.load(open(sys.argv[1] + "/" + name)) for name in ("four", "one", "steps"))
assert [d["frame"] for d in four["drawn"]] == [3, 8, 14, 20] and four["frames"] == 18
assert [d["frame"] for d in one["drawn"]] == [7] and one["frames"] == 1
assert abs(one["seconds"] - one["drawn"][0]["seconds"]) < 1e-9
at = {d["frame"]: d["work"] for d in four["drawn"]}
total = 0
for frame in range(3, 21):
    low, high = max(f for f in at if f <= frame), min(f for f in at if f >= frame)
    total += at[low] if low == high else at[low] + (at[high] - at[low]) * (frame - low) / (high - low)
assert abs(total / four["work_per_second"] / four["seconds"] - 1) < 1e-9
assert abs(four["frames_per_core_hour"] * four["seconds"] / 3600 / 18 - 1) < 1e-9
work = [d["work"] for d in steps["drawn"]]
assert max(work) < 3 * min(work), work # a frame's own steps, not those of the frames between
CODE
}

refusals() {
    exits 2 "$lom" cost "$scene" --frames 3:1 && complains 'ends before it begins' && exits 2 "$lom" cost missing.toml &&
        exits 2 "$lom" cost "$scene" --draw 0
}

check declared_work_is_the_same_everywhere same_work
check what_cannot_be_estimated_is_refused refusals
if command -v python3 >/dev/null; then
    check a_run_costs_what_its_frames_weigh arithmetic
else
    echo "SKIP a_run_costs_what_its_frames_weigh: needs python3"
fi
exit $failures
