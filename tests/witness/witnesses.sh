#!/bin/sh
# Builds and runs each witness whose library is installed, as part of `make check-long`; the others are skipped aloud.
# Alone: tests/witness/witnesses.sh [NAME]...
cd "$(dirname "$0")/../.." || exit 2
BUILD=${BUILD:-build}
CC=${CC:-gcc}
CXX=${CXX:-g++}
status=0

# witness NAME COMPILER HEADER PROGRAM PACKAGES
witness() {
    case " $names " in "  " | *" $1 "*) ;; *) return ;; esac
    if ! printf '#include <%s>\n' "$3" | $2 -E -o /dev/null - 2>/dev/null; then
        echo "SKIP $1: there is no $3 (Debian: $5)"
    elif ! ${MAKE:-make} -s BUILD="$BUILD" CC="$CC" CXX="$CXX" ${VARIANTS:+VARIANTS="$VARIANTS"} "$BUILD/tests/witness/$4"; then
        echo "FAIL $1: does not build; repeat: tests/witness/witnesses.sh $1"
        status=1
    else
        "$BUILD/tests/witness/$4" || status=1
    fi
}

names=$*
witness mathematics "$CC" mpfr.h witness_mathematics.w4 libmpfr-dev
witness transforms "$CC" fftw3.h witness_transforms libfftw3-dev
witness picture "$CC" GLES3/gl3.h witness_picture.w4 "libegl-dev libgles-dev libgl1-mesa-dri"
witness volume "$CXX -x c++" openvdb/openvdb.h witness_volume "libopenvdb-dev libtbb-dev libboost-dev libboost-iostreams-dev"
exit $status
