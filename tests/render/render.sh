# What the scripts of this folder share; sourced. $lom is the program, $folder a scratch folder, and `draw ARGUMENTS`
# renders the scene under test, small (160x90).
lom=${BUILD:-build}/lom
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
# The widest lanes that this build has.
widest=16
"$lom" render assets/scenes/lake.toml --size 1x1 --lanes 16 --hash >/dev/null 2>&1 || widest=8
pool_heights() { # a bowl with bumps, as a height map
    awk 'BEGIN { print "P2 33 33 255"; for (j = 0; j < 33; j++) for (i = 0; i < 33; i++)
        print int(255 * ((i - 16) ^ 2 + (j - 16) ^ 2 + 40 * (i * j % 5)) / 700) }' >"$folder/height.pgm"
}
verdict() { # name, why (empty: passed)
    if [ -z "$2" ]; then echo "PASS $1"; else echo "FAIL $1: $2; repeat: $0"; fi
}
hash() { draw --hash "$@" | cut -d' ' -f1; }

one_hash() { # name: every lane width that is built and every thread count gives the same bytes
    whole=$(hash)
    why=
    for run in '4 1' '4 5' '8 2' '8 3' '16 1' '16 8'; do
        lanes=${run% *} threads=${run#* }
        other=$(hash --lanes "$lanes" --threads "$threads" 2>"$folder/error")
        grep -q 'was built without' "$folder/error" && continue
        [ "$other" = "$whole" ] || why="$lanes lanes on $threads threads give $other, not $whole"
    done
    [ -n "$whole" ] || why='no hash'
    verdict "$1" "$why"
}

crops() { # name: a crop is the cut-out of the whole
    draw -o "$folder/whole.ppm"
    why=
    for crop in '0,0,160,90' '33,41,70,49' '101,57,1,1' '7,60,151,30'; do
        draw --crop $crop -o "$folder/crop.ppm" || why="crop $crop fails"
        x=${crop%%,*} rest=${crop#*,}
        y=${rest%%,*} rest=${rest#*,}
        width=${rest%,*} height=${rest#*,}
        printf 'P6\n%d %d\n255\n' "$width" "$height" >"$folder/cut.ppm"
        row=0
        while [ $row -lt "$height" ]; do # the header of the whole is "P6\n160 90\n255\n": 14 bytes
            tail -c +$((15 + ((y + row) * 160 + x) * 3)) "$folder/whole.ppm" | head -c $((width * 3)) >>"$folder/cut.ppm"
            row=$((row + 1))
        done
        cmp -s "$folder/crop.ppm" "$folder/cut.ppm" || why="crop $crop is not the cut-out"
    done
    verdict "$1" "$why"
}

frame_alone() { # name: a frame alone is the frame of a run, and not the first
    first=$(hash) alone=$(hash --frame 3)
    run=$(draw --frames 2:3 --hash | sed -n 's/  frame 3$//p')
    [ "$alone" = "$run" ] && [ "$alone" != "$first" ] && why= || why="$alone alone, $run in a run, $first at first"
    verdict "$1" "$why"
}
