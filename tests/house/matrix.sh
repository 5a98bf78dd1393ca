#!/bin/bash
# Proves that bytes do not depend on the compiler, its optimisation level, the architecture, its byte order, its
# vectors, the C library, the locale. Builds the program once for each row below, each into its own folder (rows that
# only run otherwise share one), and compares with the rows before it: the self-test, the lake at 160x90 at the row's
# widths, the float stages of the pipeline at these widths, and two frames of the scenes of assets/ at 160x90 at 4 lanes:
# all of them; of rows that are slow or like another one a part, so that such rows together draw all; where an emulator
# draws, a part of the light ones, another one for each row. Prints a table with seconds of processor time, and one hash;
# status 1 when a row differs, 2 when a build fails. A compiler or an emulator that is not installed is a line with SKIP.
#
#   make matrix                                  every row
#   make matrix ROWS="gcc-3 aarch64-3"           these rows
#   make matrix ROWS="gcc-11-3 clang-19-2"       compilers by their names with a version
#   make matrix LAUNCHER=ccache                  compilers started through another program
#   make matrix RECORD=1                         and the rows are those that `lom selftest` has been seen on
set -u
cd "$(dirname "$0")/../.." || exit 2
native="gcc-3 gcc-3-masked gcc-3-locale gcc-0 gcc-1 gcc-2 gcc-s gcc-1-native gcc-1-lto gcc-0-uchar gcc-11-3 musl-1
    clang-3 clang-0 clang-1 clang-2 clang-13-3 clang-19-1 i686-1"
foreign="aarch64-3 aarch64-0-schar armhf-1 riscv64-1 ppc64el-1 ppc64-1 s390x-3 s390x-0 wasm-1 wasm128-1 mingw-1"
rows=${ROWS:-$native $foreign}
root=${BUILD:-build}/matrix
jobs=${JOBS:-$(nproc 2>/dev/null || echo 1)}
every_width="4 8 16 8_plain 16_plain"
known=$root/known # what the rows so far gave: a line each of what, and its hash
mkdir -p "$root"
: >"$known"
status=0

# WebAssembly, without and with its vectors, by the newest clang (docs/wasm.md).
wasm_clang=$(basename "$(ls /usr/bin/clang-[1-9][0-9] 2>/dev/null | sort | tail -1)")
wasm_clang=${wasm_clang:-clang} node='node src/web/lom.mjs'

# Sets what a row is: compiler, archiver, linker flags, what runs its programs, its widths, the part of the scenes that
# it draws ("0/1" all, "2/9" of the light ones each ninth from the third on), the variable that it runs with, the row
# whose build it shares.
set_row() {
    archiver=ar flags='' emulator='' widths=4 part=0/1 variable=LC_ALL=C shared=$1
    case $1 in
    aarch64-*) cross aarch64-linux-gnu aarch64 0/9 ;;
    armhf-*) cross arm-linux-gnueabihf arm 1/9 ;;
    riscv64-*) cross riscv64-linux-gnu riscv64 2/9 ;;
    ppc64el-*) cross powerpc64le-linux-gnu ppc64le 3/9 ;;
    ppc64-*) cross powerpc64-linux-gnu ppc64 4/9 ;;
    s390x-*) cross s390x-linux-gnu s390x 5/9 ;;
    i686-*) cross i686-linux-gnu i386 1/2 && emulator='' compiler="$compiler -march=pentium4 -mfpmath=sse" ;;
    musl-*) compiler=musl-gcc flags=-static part=0/2 ;;
    mingw-*) compiler=x86_64-w64-mingw32-gcc archiver=x86_64-w64-mingw32-ar emulator=wine ;;
    wasm-*) compiler="$wasm_clang --target=wasm32-wasi" archiver=llvm-ar emulator=$node part=1/2 ;;
    wasm128-*) compiler="$wasm_clang --target=wasm32-wasi -msimd128" archiver=llvm-ar emulator=$node part=0/2 ;;
    gcc-1[0-9]-* | clang-1[0-9]-*) compiler=$(echo "$1" | cut -d- -f1,2) ;;
    *) compiler=${1%%-*} ;;
    esac
    level=$(echo "$1" | grep -o -- '-[0-3s]\(-[a-z]*\)\?$' | cut -c 2)
    case $1 in
    gcc-3 | clang-3) widths=$every_width ;;
    gcc-[12] | clang-1 | aarch64-3) widths="4 8" ;;
    s390x-0) widths="4 8" part=8/18 ;;
    gcc-0) widths="4 16" part=0/3 ;;
    clang-0) widths="4 16" part=1/3 ;;
    gcc-s | clang-2 | s390x-3) widths="4 16" ;;
    gcc-11-* | clang-13-*) part=0/2 ;;
    clang-19-*) part=1/2 ;;
    *-native) compiler="$compiler -march=native" widths="4 8" ;;
    *-lto) compiler="$compiler -flto=auto" archiver=gcc-ar part=1/2 ;;
    *-uchar) compiler="$compiler -funsigned-char" part=2/3 ;;
    *-schar) compiler="$compiler -fsigned-char" part=6/9 ;;
    *-masked) shared=gcc-3 emulator="qemu-x86_64 -cpu Nehalem" widths="4 8 16" part=7/9 ;; # neither FMA nor AVX2
    *-locale) shared=gcc-3 variable=LC_ALL=de_DE.UTF-8 widths="4 8 16" part=1/2 ;;
    esac
}

# The prefix of the tools, the emulator's name, the part of the scenes.
cross() {
    compiler=$1-gcc archiver=$1-ar flags=-static emulator=qemu-$2 part=$3
    command -v "$emulator" >/dev/null || emulator=$emulator-static
}

missing() {
    for tool in "${compiler%% *}" $archiver ${emulator%% *}; do
        command -v "$tool" >/dev/null || { echo "$tool is not installed"; return; }
    done
    case $1 in
    mingw-*) echo "lom's files, processes and signals are those of POSIX, which mingw-w64 has not"; return ;;
    *-locale)
        locale -a 2>/dev/null | grep -qi 'de_DE.utf' || { echo "the locale de_DE.UTF-8 is not installed"; return; } ;;
    esac
    echo 'int main(void) { return 0; }' | $compiler $flags -x c -o "$root/nothing" - 2>/dev/null ||
        echo "$compiler links no program"
}

# The test of the float stages wants threads and rounding modes, and its oracle integers of 128 bits.
has_float_test() {
    case $compiler in *wasm32* | i686-* | arm-*) return 1 ;; esac
}

# The programs of a row, in its folder.
build() {
    local folder=$1 targets="$1/lom" tested=$widths
    has_float_test || tested=''
    for lanes in $tested; do
        case $lanes in 4 | 8 | 16) targets="$targets $folder/tests/pipeline/test_invariance.w$lanes" ;; esac
    done
    make -s -j"$jobs" CC="${LAUNCHER:-} $compiler" AR=$archiver O="$level" BUILD="$folder" VARIANTS="$widths" \
        RECORDED= SAN= SDL= PIC=-g0 LDFLAGS="$flags" $targets >"$folder/log" 2>&1
}

# Sets `processor`: seconds of processor time of all that ended until now. (Another shell would have no children.)
look_at_clock() {
    times >"$root/times"
    processor=$(tail -n 1 "$root/times" | tr 'ms' '  ' | awk '{ printf "%d", 60 * $1 + $2 + 60 * $3 + $4 }')
}

# Compares a hash with what another row gave under that name: "same", or the name; an empty one is no hash.
meets() {
    local before
    before=$(awk -v name="$1" '$1 == name { print $2 }' "$known")
    [ -n "$before" ] || [ -z "$2" ] || echo "$1 $2" >>"$known"
    [ -n "$2" ] && [ "${before:-$2}" = "$2" ] || differences="$differences $1"
}

# The hashes of frames: draw FOLDER SCENE OPTIONS...
draw() {
    local log=$1/log
    shift
    $program render "$@" --size 160x90 --hash --quiet 2>>"$log" | cut -d' ' -f1
}

# Draws two frames of the scenes of the row's part; sets `drawn`.
scenes() {
    local number=0 frame hash
    drawn=0
    # An emulator takes some seventy times as long: scenes above a second are for this machine itself, and WebAssembly.
    heavy=' clouds-100 cumulus dusk falls flight foam hits layers mackerel plunging posts sky storm surf tarn tradewind valley_fog wake '
    case $part in */9 | */18) ;; *) heavy='' ;; esac
    for scene in assets/scenes/*.toml assets/scenes/features/*.toml; do
        case $heavy in *" $(basename "$scene" .toml) "*) continue ;; esac
        if [ $((number++ % ${part#*/})) -eq "${part%/*}" ]; then
            hashes=$(draw "$1" "$scene" --frames 0:1 --lanes 4)
            for frame in 0 1; do
                hash=$(echo "$hashes" | sed -n $((frame + 1))p)
                meets "$(basename "$scene" .toml):$frame" "$hash"
                drawn=$((drawn + 1))
            done
        fi
    done
}

# What a build answers; sets the columns of its row.
ask() {
    local folder=$1 lanes hash test
    lake=() floats=- differences=
    program="env $variable $emulator $folder/lom"
    selftest=$($program selftest 2>>"$folder/log" | sed -n 's/^\([0-9a-f]\{16\}\)  selftest$/\1/p')
    meets selftest "$selftest"
    for lanes in 4 8 16; do
        hash=-
        case " $widths " in *" $lanes "*)
            hash=$(draw "$folder" assets/scenes/lake.toml --lanes $lanes)
            meets lake "$hash"
            if has_float_test; then
                floats=same
                test=$folder/tests/pipeline/test_invariance.w$lanes
                $emulator "$test" float_stages_have_one_hash >>"$folder/log" 2>&1 ||
                    differences="$differences floats:$lanes"
            fi ;;
        esac
        lake+=("$hash")
    done
    case $differences in *floats*) floats=differ ;; esac
    scenes "$folder"
}

format='%-15s %-16s %-16s %-16s %-16s %-6s %6s %7s %6s  %s\n'
printf "$format" row selftest "lake, 4 lanes" "8 lanes" "16 lanes" floats scenes "build s" "run s" ''
seen=
for row in $rows; do
    set_row "$row"
    reason=$(missing "$row")
    if [ -n "$reason" ]; then
        echo "SKIP $row: $reason"
        continue
    fi
    folder=$root/$shared
    mkdir -p "$folder"
    look_at_clock
    start=$processor
    widths_asked=$widths
    [ "$shared" = "$row" ] || widths=$every_width
    if ! build "$folder"; then
        echo "$row: the build fails:"
        grep -E -m 5 "error|Error" "$folder/log"
        status=2
        continue
    fi
    look_at_clock
    widths=$widths_asked built=$((processor - start)) start=$processor
    ask "$folder"
    look_at_clock
    printf "$format" "$row" "$selftest" "${lake[@]}" $floats $drawn $built $((processor - start)) \
        "${differences:+differs:$differences; see $folder/log}"
    if [ -z "$differences" ]; then
        seen="$seen $row"
    elif [ $status -eq 0 ]; then
        status=1
    fi
done
echo "$(sort "$known" | sha256sum | cut -c 1-16)  matrix of $(echo "$seen" | wc -w) rows that agree, in" \
    "$((SECONDS / 60)) min $((SECONDS % 60)) s"

# The rows, as the program tells them.
if [ -n "${RECORD:-}" ] && [ $status -eq 0 ]; then
    hash=$(awk '$1 == "selftest" { print $2 }' "$known")
    sed "s/UINT64_C(0x[0-9a-f]*)/UINT64_C(0x$hash)/; /^    [\"N]/d; /^};/d" src/measure/selftest_rows.c >"$root/rows.c"
    { printf '    "%s",\n' $seen && printf '    NULL,\n};\n'; } >>"$root/rows.c"
    command -v clang-format >/dev/null && clang-format -i --style=file "$root/rows.c"
    cp "$root/rows.c" src/measure/selftest_rows.c
fi
exit $status
