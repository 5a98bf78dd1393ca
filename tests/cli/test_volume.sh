#!/bin/sh
# Proves that the program makes, names, converts and refuses volumes: NRRD and raw, 8 and 16 bits and floats, non-cubic.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
cd "$folder" || exit 1

made() {
    for bits in 8 16 32; do
        exits 0 "$lom" make cloud cumulus_humilis --voxels 24x11x17 --bits $bits -o $bits.nrrd || return 1
    done
    exits 0 "$lom" info 8.nrrd 16.nrrd 32.nrrd && says "8.nrrd: volume, 24 x 11 x 17, R8," &&
        says "16.nrrd: volume, 24 x 11 x 17, R16," && says "32.nrrd: volume, 24 x 11 x 17, R32F,"
}

converted() {
    exits 0 "$lom" convert 16.nrrd back.nrrd --bits 8 && cmp back.nrrd 8.nrrd &&
        printf '\001\002\003\004\005\006' >six.raw && exits 0 "$lom" convert six.raw six.nrrd --voxels 3x2x1 &&
        exits 0 "$lom" info six.nrrd && says "3 x 2, R8" &&
        exits 0 "$lom" convert six.raw wide.nrrd --voxels 3x1x1 && exits 0 "$lom" info wide.nrrd && says "3 x 1, R16"
}

refused() {
    exits 2 "$lom" convert six.raw x.nrrd --voxels 4x1x1 && complains "the file has 6" &&
        exits 2 "$lom" convert 16.nrrd x.png && complains "slice" &&
        head -c 200 16.nrrd >cut.nrrd && exits 2 "$lom" info cut.nrrd && complains "cut.nrrd" &&
        printf 'NRRD0004\ntype: float\ndimension: 3\nsizes: 10000 10000 10000\nendian: little\nencoding: raw\n\n' >huge.nrrd &&
        exits 2 "$lom" info huge.nrrd && complains "limit" &&
        exits 2 "$lom" make cloud cumulus_humillis -o x.nrrd && complains 'did you mean "cumulus_humilis"?' &&
        exits 2 "$lom" make cloud cirrus --voxels 9999x1x1 -o x.nrrd && [ ! -e x.nrrd ]
}

in_scenes() {
    printf '[output]\nwidth = 32\nheight = 18\n[camera]\nposition = [0, 300, 2000]\n[[cloud]]\nfile = "%s"\n' 16.nrrd >a.toml
    printf '[output]\nwidth = 32\nheight = 18\n[camera]\nposition = [0, 300, 2000]\n[[cloud]]\nfile = "%s"\nvoxels = [9, 9, 9]\n' six.raw >b.toml
    printf '[[cloud]]\nkind = "cirus"\n' >c.toml
    printf '[[cloud]]\nkind = "cirrus"\nfile = "16.nrrd"\n' >d.toml
    exits 0 "$lom" render a.toml --hash && exits 2 "$lom" render b.toml --hash && complains "six.raw" &&
        exits 2 "$lom" render c.toml --hash && complains 'c.toml:2:8: There is no kind of cloud "cirus" (did you mean "cirrus"?)' &&
        exits 2 "$lom" render d.toml --hash && complains "either a kind or a file"
}

check volumes_made made
check volumes_converted converted
check volumes_refused refused
check volumes_in_scenes in_scenes
exit $failures
