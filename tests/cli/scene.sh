# A scene of one box with a material and a picture, in $folder/scene: sourced after cli.sh.
mkdir "$folder/scene" || exit 1
printf 'P6 2 2 255\n\377\020\020\020\377\020\020\020\377\377\377\377' >"$folder/scene/skin.ppm"
printf 'newmtl skin\nKd 1 1 1\nmap_Kd skin.ppm\n' >"$folder/scene/box.mtl"
cat >"$folder/scene/box.obj" <<OBJ
mtllib box.mtl
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v 0 2 0
vt 0 0
vt 1 0
vt 0.5 1
usemtl skin
f 1/1 5/3 2/2
f 2/1 5/3 3/2
f 3/1 5/3 4/2
f 4/1 5/3 1/2
OBJ
cat >"$folder/scene/scene.toml" <<TOML
[output]
width = 48
height = 32
[camera]
position = [0, 2, 5]
target = [0, 1, 0]
[water]
size = [8, 8]
[[entity]]
name = "box"
mesh = "box.obj"
[quality]
water = "planar"
TOML
scene=$folder/scene/scene.toml
