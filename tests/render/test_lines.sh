#!/bin/sh
# Proves of the lines and points of a mesh in a scene (OBJ's l and p) and of wireframes: exactly the pixels of the rules of
# lom/pipeline.h, of the width and size that the entity names; an edge of two triangles is one line, hidden ones are left out
# or not; the picture is one for every width and number of threads, a crop is its cut-out; a pixel of a line is explained.
. "$(dirname "$0")/render.sh"
scene=assets/scenes/features/lines.toml
draw() { "$lom" render $scene --size 160x90 --quiet "$@"; }
whole=$(hash)
why=
for run in '4 1' '4 5' '8 2' '8 3'; do
    other=$(hash --lanes "${run% *}" --threads "${run#* }")
    [ "$other" = "$whole" ] || why="$run lanes, threads give $other, not $whole"
done
[ -n "$whole" ] || why='no hash'
verdict lines_are_one_hash "$why"
crops lines_of_crops

# Black before white, 33x17 pixels: x and y of the world are pixels from the middle of pixel 16, 8 at the distance 17 / 2 / tan 30.
printf 'v -5 0 0\nv 5 0 0\nl 1 2\n' >"$folder/level.obj"
printf 'v 0 0 0\np 1\n' >"$folder/point.obj"
printf 'v -4 -3 0\nv 4 -3 0\nv 4 3 0\nv -4 3 0\nf 1 2 3\nf 1 3 4\n' >"$folder/square.obj"
cat >"$folder/head.toml" <<'END'
[output]
width = 33
height = 17
[camera]
position = [0, 0, 14.722431864335457]
target = [0, 0, 0]
field_of_view = 60
[light]
intensity = 0
ambient = [0, 0, 0]
[sky]
gradient = true
zenith = [1, 1, 1]
horizon = [1, 1, 1]
intensity = 9
END
# name, lines of the scene, the codes of red as a picture of . (white) and # (anything else), rows that have any alone
shows() {
    { cat "$folder/head.toml"; printf '%b' "$2"; } >"$folder/scene.toml"
    "$lom" render "$folder/scene.toml" --quiet -o "$folder/out.ppm" || { verdict "$1" 'it is not drawn'; return; }
    seen=$(tail -c +14 "$folder/out.ppm" | od -An -v -tu1 -w99 | awk '{ row = ""; for (i = 1; i <= 97; i += 3) row = row ($i == 255 ? "." : "#"); if (row ~ /#/) { sub(/^\.+/, "", row); sub(/\.+$/, "", row); print NR - 1, row } }' | tr '\n' ' ')
    [ "$seen" = "$3" ] && why= || why="it shows \"$seen\", not \"$3\""
    verdict "$1" "$why"
}
level='[[entity]]\nmesh = "level.obj"\n' point='[[entity]]\nmesh = "point.obj"\n' square='[[entity]]\nmesh = "square.obj"\n'
# a line from the middle of pixel 11 to that of pixel 21 ends in the diamond of the latter
shows a_line_has_the_pixels_of_the_diamond_rule "$level" '8 ########## '
shows wide_lines_are_columns "${level}line_width = 3\n" '7 ########## 8 ########## 9 ########## '
shows a_point_is_a_pixel "$point" '8 # '
shows small_points_are_squares "${point}point_size = 1.5\n" '8 # '
shows large_points_are_discs "${point}point_size = 5\n" '6 ### 7 ##### 8 ##### 9 ##### 10 ### '

wires='[quality]\nwireframe_color = [0, 0, 0]\nwireframe = '
white='[entity.material]\nambient = 1\n'
# the square is as bright as the sky: its wires alone are seen, the diagonal of its two triangles once
sed -i 's/ambient = \[0, 0, 0\]/ambient = [9, 9, 9]/' "$folder/head.toml"
shows without_wires_nothing_is_seen "$square$white${wires}\"off\"\n" ''
"$lom" render "$folder/scene.toml" --quiet -o "$folder/off.ppm"
edges='5 ######## 6 #.....### 7 #....#..# 8 #...#...# 9 #.##....# 10 ##......# 11 ######### '
shows edges_are_lines_once "$square$white${wires}\"visible\"\n" "$edges"
# a larger square before it hides them; of its own the diagonal is in the picture
diagonal='0 ## 1 # 2 # 3 ## 4 # 5 # 6 ## 7 # 8 # 9 # 10 ## 11 # 12 # 13 ## 14 # 15 # 16 ## '
both='0 ## 1 # 2 # 3 ## 4 # 5 ######## 6 #.....### 7 #....#..# 8 #...#...# 9 #.##....# 10 ###.....# 11 ######### 12 # 13 ## 14 # 15 # 16 ## '
front='[[entity]]\nmesh = "square.obj"\nposition = [0, 0, 2]\nscale = 9\n[entity.material]\nambient = 1\n'
shows hidden_edges_are_left_out "$square$white$front${wires}\"visible\"\n" "$diagonal"
shows hidden_edges_are_shown_when_all_are "$square$white$front${wires}\"all\"\n" "$both"

# a pixel of the line, and beside it
{ cat "$folder/head.toml"; printf '%b' "$level"; } >"$folder/scene.toml"
"$lom" explain "$folder/scene.toml" 14,8 >"$folder/explained" 2>&1
grep -q 'line 0: stored' "$folder/explained" && [ "$(sed -n '/line 0/,/weights/s/.* \(vertex [0-9]\) (index.*/\1/p' "$folder/explained" | tr '\n' ' ')" = 'vertex 0 vertex 1 ' ] && why= ||
    why="it says $(head -3 "$folder/explained")"
verdict a_line_is_explained "$why"
"$lom" explain "$folder/scene.toml" 14,7 >"$folder/explained" 2>&1
grep -q 'line 0: stored' "$folder/explained" && why='beside the line it is named' || why=
verdict beside_a_line_it_is_not "$why"
for arguments in 'entity.0.line_width=0' 'entity.0.line_width=65' 'entity.0.point_size=0.1' 'quality.wireframe=some'; do
    "$lom" render "$folder/scene.toml" --set "$arguments" -o "$folder/none.ppm" >"$folder/said" 2>&1
    [ $? = 2 ] && [ ! -e "$folder/none.ppm" ] && [ "$(wc -l <"$folder/said")" = 1 ] && why= || why="$arguments: $(cat "$folder/said")"
    verdict "bad_input_$arguments" "$why"
done
