#!/bin/sh
# Proves what `lom render` and its kin make of bad scenes, files and arguments: status 2, one sentence on stderr that names
# the file and the place, no output and no file, whatever is wrong.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
cd "$folder/scene" || exit 1

# refuses TEXT ARGUMENTS...: status 2, one line that begins with "lom: " and has TEXT, nothing written.
refuses() {
    refuses_text=$1
    shift
    rm -f out.png
    exits 2 "$lom" "$@" && complains "$refuses_text" && [ ! -s "$folder/out" ] && [ ! -e out.png ] || return 1
    if [ "$(wc -l <"$folder/err")" -ne 1 ] || ! grep -q '^lom: ' "$folder/err"; then
        echo "not one sentence:" && cat "$folder/err"
        return 1
    fi
    [ -z "$(find . -name '.lom-*')" ]
}

good_scene() {
    exits 0 "$lom" render scene.toml -o out.png && [ -s out.png ] && [ ! -s "$folder/err" ]
}

# Each line: the place and what is said | what goes where line 4 of the scene is.
wrong_scenes() {
    while IFS='|' read -r text line; do
        sed "4s/.*/$line/; /^position/d" scene.toml >bad.toml
        refuses "bad.toml:$text" render bad.toml -o out.png || return 1
    done <<LINES
4:2: unknown key "camrea" (did you mean "camera"?)|[camrea]
4:9: unknown key "extra"|[camera.extra]
4:8: "]" must close this header.|[camera
4:7: "=" must follow the key "camera".|camera]
5:12: |[camera]\\nposition = [0, 2]
5:12: |[camera]\\nposition = "here"
5:17: "field_of_view" is 180 but must be from 0.01 to 179|[camera]\\nfield_of_view = 180
5:17: "field_of_view" is nan but must be|[camera]\\nfield_of_view = nan
5:1: unknown key "positoin" (did you mean "position"?)|[camera]\\npositoin = [0, 2, 5]
6:1: the key "near" stands in this table already (line 5).|[camera]\\nnear = 0.1\\nnear = 0.2
5:8: "near" must be a number, not a date.|[camera]\\nnear = 1979-05-27
5:8: "0x" is not a value of TOML.|[camera]\\nnear = 0x
5:8: "near" must be a number, not a string.|[camera]\\nnear = "q"
LINES
}

damaged_scenes() {
    : >empty.toml
    head -c 40 /dev/zero >nul.toml
    printf 'title = "\377"\n' >utf8.toml
    refuses "nul.toml:1:1: " render nul.toml -o out.png && refuses "utf8.toml:1:1" render utf8.toml -o out.png &&
        exits 0 "$lom" render empty.toml --hash && refuses "absent.toml" render absent.toml -o out.png &&
        refuses "." render . -o out.png
}

# A file that the scene names and that is absent, empty or no such file: the file's name and the place in it.
wrong_files() {
    for what in absent empty garbage cut; do
        for file in box.obj skin.ppm box.mtl; do
            cp $file kept
            case $what in
            absent) rm $file ;;
            empty) : >$file ;;
            garbage) printf 'f 1 2 \001\000\377\n' >$file ;;
            cut) head -c 14 kept >$file ;;
            esac
            case $what$file in
            absentbox.mtl | emptybox.mtl) # lenient: the material is the default one, and a warning says so
                exits 0 "$lom" render scene.toml -o out.png && complains "warning: " && rm out.png || return 1 ;;
            *skin.ppm) # a mesh's own map: the material without it, and a warning that names it
                exits 0 "$lom" render scene.toml -o out.png && complains "warning: " && complains skin.ppm && rm out.png ||
                    return 1 ;;
            garbagebox.mtl) ;; # statements that are not known are passed over, but not a zero byte
            cutbox.mtl) ;;
            *) refuses "$file" render scene.toml -o out.png || { mv kept $file; return 1; } ;;
            esac
            mv kept $file
        done
    done
    printf 'newmtl skin\nKd x\n' >kept && cp box.mtl good && mv kept box.mtl
    refuses "box.mtl:2: " render scene.toml -o out.png || return 1
    mv good box.mtl
    sed 's/box.obj/bax.obj/' scene.toml >bad.toml
    refuses 'bad.toml:11:8: ' render bad.toml -o out.png
}

# As many warnings as there is room for are told, and how many more there are: here one a picture that is not there.
many_warnings() {
    : >many.mtl
    printf 'mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n' >many.obj
    for i in $(seq 1 60); do
        printf 'newmtl m%d\nmap_Kd a-picture-that-is-not-there-%d.png\n' "$i" "$i" >>many.mtl
        printf 'usemtl m%d\nf 1 2 3\n' "$i" >>many.obj
    done
    sed 's/box.obj/many.obj/' scene.toml >many.toml
    exits 0 "$lom" render many.toml --hash && complains "a-picture-that-is-not-there-1.png" || return 1
    told=$(grep -c 'that-is-not-there' "$folder/err")
    [ "$told" -gt 2 ] && [ "$told" -lt 60 ] && complains "warning: $((60 - told)) more warnings are not shown." &&
        exits 0 "$lom" render many.toml --hash --quiet && [ ! -s "$folder/err" ]
}

# Each line: what is said | arguments behind `lom`.
wrong_arguments() {
    while IFS='|' read -r text arguments; do
        # shellcheck disable=SC2086
        refuses "$text" $arguments || return 1
    done <<LINES
render needs -o OUT|render scene.toml
--frames 5:2 ends before it begins|render scene.toml -o out-%d.png --frames 5:2
exclude one another|render scene.toml -o out.png --frame 1 --frames 1:2
--size 0x5: whole numbers must be from 1 to 32768|render scene.toml -o out.png --size 0x5
--size 99999x5: whole numbers must be|render scene.toml -o out.png --size 99999x5
--size takes WxH|render scene.toml -o out.png --size 5
crop 0,0,49,32 does not lie inside the frame of 48x32|render scene.toml -o out.png --crop 0,0,49,32
--crop takes X,Y,W,H|render scene.toml -o out.png --crop 1,2,3
--lanes takes auto|render scene.toml -o out.png --lanes 5
--threads 0: whole numbers|render scene.toml -o out.png --threads 0
--format takes png|render scene.toml -o out.png --format gif
no picture kind "gif"|render scene.toml -o out.gif
--set watre.level=1: unknown key "watre" (did you mean|render scene.toml -o out.png --set watre.level=1
"scale" is 1e-310 but must be above 0|render scene.toml -o out.png --set entity.box.scale=1e-310
an override has the form KEY=VALUE|render scene.toml -o out.png --set water.level
--set water.level=nan: "level" is nan|render scene.toml -o out.png --set water.level=nan
nothing here is named "bax" (did you mean "box"?)|render scene.toml -o out.png --set entity.bax.visible=false
absent/out.png: could not create|render scene.toml -o absent/out.png
too few arguments|render -o out.png
too many arguments|render scene.toml scene.toml -o out.png
too few arguments|plan
absent.toml: could not open|plan absent.toml
no workload "clod" (did you mean "cloud"?)|bench clod -o out.png
LINES
}

# What is hidden by a NaN or a single colour is refused with status 1, when asked.
checks() {
    printf '[sky]\ncolor = [0.5, 0.5, 0.5]\n' >flat.toml
    exits 1 "$lom" render flat.toml --size 8x8 --check -o out.png && complains "one single colour" || return 1
    exits 0 "$lom" render scene.toml --check -o out.png &&
        exits 0 "$lom" render scene.toml --set output.format=rgb32f --check -o out.pfm
}

# Limits that show when a scene's files are read or its water moves: the sentence names the keys.
limits() {
    printf 'P2 3 3 255\n0 100 0 100 255 100 0 100 0\n' >heights.pgm
    ground='terrain={height_map="heights.pgm",size=[100,100]'
    layer='{map="skin.ppm"}'
    nine="$layer,$layer,$layer,$layer,$layer,$layer,$layer,$layer,$layer"
    refuses "at most 8 layers, and this one has 9" render scene.toml -o out.png --set "$ground,layer=[$nine]}" &&
        refuses "not within 1e9 seconds" render scene.toml -o out.png --frame 1000000000 --set output.fps=0.5 &&
        refuses "shallow.size over shallow.cells" render scene.toml -o out.png --set quality.water=displaced \
            --set 'shallow={size=0.001,cells=1024}' &&
        refuses "more than 10000000 steps (shallow.step)" render scene.toml -o out.png --set quality.water=displaced \
            --set 'shallow={start=-1000000,step=0.0005}' &&
        refuses "[shallow] at water.level over the terrain: Cell (0, 0)" render scene.toml -o out.png \
            --set quality.water=displaced --set 'terrain={height_map="heights.pgm",size=1e6,height=1e6}' \
            --set 'shallow={cells=8,size=1e5}' || return 1
    exits 0 "$lom" plan scene.toml --set quality.water=displaced --set "$ground,base=-60}" --set surf.height=0.5 &&
        says "none breaks" || return 1
    for sun in 40:'keeps the sun off' -1:'is not above the horizon'; do
        exits 0 "$lom" plan scene.toml --set "$ground}" --set quality.terrain_shadows=true --set light.elevation=${sun%%:*} &&
            says "${sun#*:}" || return 1
    done
}

# Frame N at F frames a second is the moment of frame 2 N at 2 F.
frames_a_second() {
    printf '[[entity.key]]\ntime = 0\nposition = [0, 0, 0]\n[[entity.key]]\ntime = 1\nposition = [1, 2, 0]\n' | cat scene.toml - >moving.toml
    for rate in 10 20; do
        exits 0 "$lom" render moving.toml --hash --fps $rate --frame $((rate / 5)) && cut -d' ' -f1 "$folder/out" >$rate || return 1
    done
    exits 0 "$lom" render moving.toml --hash --fps 10 --frame 4 && ! cut -d' ' -f1 "$folder/out" | cmp -s - 10 && cmp 10 20
}

# On a terminal a bar shows the frames and is wiped away; with --quiet there is none, and none in a file.
bar() {
    if ! script -qec true /dev/null >/dev/null 2>&1; then
        echo "script makes no terminal here"
        return 0
    fi
    script -qec "'$lom' render scene.toml -o out-%d.png --frames 0:2 --check" /dev/null >"$folder/terminal" </dev/null || return 1
    script -qec "'$lom' render scene.toml -o out-%d.png --frames 0:2 --hash --quiet" /dev/null >"$folder/quiet" </dev/null || return 1
    exits 0 "$lom" render scene.toml --frames 0:2 --hash && [ ! -s "$folder/err" ] || return 1
    tr '\r' '\n' <"$folder/terminal" | sed 's/.\[K//g' | grep '^lom render' >"$folder/bars"
    [ "$(tail -c 4 "$folder/terminal")" = "$(printf '\r\033[K')" ] || return 1
    grep -q '^lom render \[\.*\] 0/3 $' "$folder/bars" && grep -q '^lom render \[##########[#.]*\] 1/3 scene$' "$folder/bars" &&
        ! grep -vE '^lom render \[#*\.*\] [0-3]/3 ' "$folder/bars" && ! grep -q 'lom render' "$folder/quiet" &&
        awk '{ gsub(/[^#.]/, "", $3); if (length($3) != 30) { print; bad = 1 } } END { exit bad }' "$folder/bars"
}

check good_scene good_scene
check wrong_scenes wrong_scenes
check damaged_scenes damaged_scenes
check wrong_files wrong_files
check many_warnings_are_counted many_warnings
check wrong_arguments wrong_arguments
check check_refuses_one_colour checks
check limits_name_their_keys limits
check frames_a_second_are_moments frames_a_second
check a_bar_on_a_terminal bar
exit $failures
