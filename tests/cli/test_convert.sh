#!/bin/sh
# Proves `lom convert`: every kind of image into every other and back, depths and channels by hand-made values, meshes.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
cd "$folder" || exit 1

printf 'P3 2 2 255\n 10 20 30  40 50 60   70 80 90  255 0 128\n' >color.ppm
printf 'P2 3 1 255\n 0 100 255\n' >gray.pgm
printf 'P7\nWIDTH 2\nHEIGHT 1\nDEPTH 2\nMAXVAL 255\nTUPLTYPE GRAYSCALE_ALPHA\nENDHDR\n\144\377\310\001' >ga.pam

kinds() {
    for kind in png ppm pam pfm; do
        exits 0 "$lom" convert color.ppm x.$kind && exits 0 "$lom" compare color.ppm x.$kind || return 1
        for other in png ppm pam pfm; do
            exits 0 "$lom" convert x.$kind y.$other && exits 0 "$lom" compare color.ppm y.$other || return 1
        done
    done
    for kind in png pgm pam pfm; do
        exits 0 "$lom" convert gray.pgm g.$kind && exits 0 "$lom" compare gray.pgm g.$kind || return 1
    done
    cp color.ppm upper.PPM && exits 0 "$lom" convert upper.PPM upper.PNG && exits 0 "$lom" compare upper.PNG color.ppm
}

# 8 bits to 16 are n * 257, and back is exact; to 8 bits is round(n / 257).
depths() {
    exits 0 "$lom" convert color.ppm --bits 16 wide.png && exits 0 "$lom" compare color.ppm wide.png &&
        exits 0 "$lom" info wide.png && says "RGB16" && exits 0 "$lom" convert wide.png narrow.png --bits 8 &&
        exits 0 "$lom" info narrow.png && says "RGB8" && exits 0 "$lom" compare narrow.png color.ppm || return 1
    printf 'P2 6 1 65535\n 0 128 129 385 386 65535\n' >steps.pgm
    printf 'P2 6 1 255\n 0 0 1 1 2 255\n' >rounded.pgm
    exits 0 "$lom" convert steps.pgm eight.pgm --bits 8 && exits 0 "$lom" compare eight.pgm rounded.pgm &&
        exits 0 "$lom" convert steps.pgm steps.pfm && exits 0 "$lom" convert steps.pfm back.pgm --bits 16 &&
        exits 0 "$lom" compare back.pgm steps.pgm
}

# Two channels are gray and alpha.
channels() {
    printf 'P7\nWIDTH 2\nHEIGHT 1\nDEPTH 4\nMAXVAL 255\nTUPLTYPE RGB_ALPHA\nENDHDR\n\144\144\144\377\310\310\310\001' >rgba.pam
    printf 'P2 2 1 255\n 100 200\n' >plain.pgm
    exits 0 "$lom" convert ga.pam four.pam --channels 4 && cmp four.pam rgba.pam &&
        exits 0 "$lom" convert ga.pam two.png && exits 0 "$lom" compare two.png ga.pam &&
        exits 0 "$lom" info two.png && says "RG8" && exits 0 "$lom" convert ga.pam wide.png --bits 16 &&
        exits 0 "$lom" compare wide.png ga.pam && exits 0 "$lom" convert four.pam gray.png --channels 2 &&
        exits 0 "$lom" compare gray.png ga.pam && exits 0 "$lom" convert ga.pam no_alpha.pgm &&
        exits 0 "$lom" compare no_alpha.pgm plain.pgm && exits 0 "$lom" convert ga.pam no_alpha.ppm &&
        exits 0 "$lom" compare no_alpha.ppm plain.pgm && exits 0 "$lom" convert gray.pgm rgb.png --channels 3 &&
        exits 0 "$lom" info rgb.png && says "RGB8" && exits 0 "$lom" compare rgb.png gray.pgm &&
        exits 0 "$lom" convert plain.pgm with_alpha.png --channels 2 && exits 0 "$lom" compare with_alpha.png plain.pgm
}

# sRGB 188 is linear 0.5029; encoded again it is 188.
transfer() {
    printf 'P2 2 1 255\n 188 255\n' >encoded.pgm
    exits 0 "$lom" convert encoded.pgm linear.pfm --srgb && exits 0 "$lom" convert linear.pfm again.pgm --srgb &&
        exits 0 "$lom" compare again.pgm encoded.pgm && exits 0 "$lom" convert linear.pfm half.pgm || return 1
    printf 'P2 2 1 255\n 128 255\n' >half_expected.pgm
    exits 0 "$lom" compare half.pgm half_expected.pgm && exits 2 "$lom" convert linear.pfm x.png --bits 16 --srgb &&
        complains "8 bits"
}

streams() {
    "$lom" convert - - --format png <color.ppm >piped.png && exits 0 "$lom" compare piped.png color.ppm &&
        exits 2 "$lom" convert color.ppm - && complains "--format"
}

refusals() {
    exits 2 "$lom" convert color.ppm x.gif && complains "x.gif" && exits 2 "$lom" convert color.ppm x.obj &&
        complains "no mesh" && exits 2 "$lom" convert missing.ppm x.png && complains "missing.ppm" &&
        exits 2 "$lom" convert color.ppm x.pgm --channels 3 && complains "3 channels" &&
        exits 2 "$lom" convert color.ppm no.pfm --bits 16 && [ ! -e no.pfm ] && [ ! -e x.gif ]
}

# Written again, a mesh is itself, materials and all.
meshes() {
    printf 'newmtl red\nKd 1 0 0\n' >in.mtl
    {
        printf 'mtllib in.mtl\n'
        printf 'v %s\n' '0 0 0' '1 0 0' '1 1 0.25' '0 1 0'
        printf 'vt %s\n' '0 0' '1 0' '1 1' '0 1'
        printf 'usemtl red\nf 1/1 2/2 3/3 4/4\n'
    } >in.obj
    exits 0 "$lom" convert in.obj out.obj && [ -s out.mtl ] && exits 0 "$lom" info in.obj out.obj &&
        says "2 triangles, 1 materials" && [ "$(sed 's/.*, //' out | uniq | wc -l)" -eq 1 ] &&
        exits 2 "$lom" convert in.obj x.png && complains "is a mesh" &&
        exits 2 "$lom" convert in.obj x.obj --bits 8 && complains "for images"
}

check convert_between_all_kinds kinds
check convert_rounds_depths depths
check convert_channels channels
check convert_srgb transfer
check convert_streams streams
check convert_refuses refusals
check convert_meshes meshes
exit $failures
