#!/bin/sh
# Proves on the demo scene (lake, clouds, sun and aircraft), small: one hash for lane widths and thread counts; a crop is
# the cut-out of the whole; a run through a cloud has the same bytes everywhere, with the cloud's picture cut in two
# around the aircraft while it is inside; without impostors any frame alone is the frame of a run.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/flight.toml
draw() { "$lom" render $scene --size 96x54 "$@"; }

whole=$(hash) why=
for run in '4 2' '8 3' '16 1'; do
    other=$(hash --lanes "${run% *}" --threads "${run#* }")
    [ -n "$whole" ] && [ "$other" = "$whole" ] || why="$run (lanes, threads) gives $other, not $whole"
done
verdict the_flight_has_one_hash "$why"

draw -o "$folder/whole.ppm"
draw --crop 31,12,40,30 -o "$folder/crop.ppm"
row=0
printf 'P6\n40 30\n255\n' >"$folder/cut.ppm"
while [ $row -lt 30 ]; do # the header of the whole is "P6\n96 54\n255\n": 13 bytes
    tail -c +$((14 + ((12 + row) * 96 + 31) * 3)) "$folder/whole.ppm" | head -c 120 >>"$folder/cut.ppm"
    row=$((row + 1))
done
cmp -s "$folder/crop.ppm" "$folder/cut.ppm" && why= || why='the crop is not the cut-out'
verdict the_flight_cropped_is_its_cut_out "$why"

# Frames 143 to 152: into the cloud.
why=
draw --frames 143:152 --hash --stats "$folder/stats" --lanes 16 --threads 1 >"$folder/run"
draw --frames 143:152 --hash --lanes 4 --threads 3 >"$folder/other"
cmp -s "$folder/run" "$folder/other" || why='the run differs by lanes and threads'
grep -q '"impostors_split": 0,' "$folder/stats" || why='the aircraft is in the cloud from the beginning'
grep -q '"impostors_split": 1,' "$folder/stats" || why='the cloud is never cut in two'
case $("$lom" plan $scene --frame 190) in *'afresh on its plate; one is cut in two'*) ;; *) why='the plan does not say so' ;; esac
verdict the_cloud_is_cut_in_two_around_the_aircraft "$why"

run=$(draw --frames 189:190 --hash --set 'quality.impostors="off"' | sed -n 's/  frame 190$//p')
[ "$run" = "$(hash --frame 190 --set 'quality.impostors="off"')" ] && why= || why="not $run"
verdict without_impostors_a_frame_alone_is_the_frame_of_a_run "$why"
