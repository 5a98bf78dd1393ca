#!/bin/sh
# What the house asks of the source, apart from what it does: run by `make lint`. Names every finding; fails when there is
# one. A tool that is not installed is named and passed over.
BUILD=${BUILD:-build}
CC=${CC:-cc}
status=0
found() { echo "lint: $1"; status=1; }
have() { command -v "$1" >/dev/null 2>&1 || { echo "lint: $1 is not installed, so $2 was not checked"; return 1; }; }

tests/house/layers.sh || status=1
BUILD=$BUILD tests/house/conversions.sh || status=1

sources=$(ls include/lom/*.h src/*/*.[ch] src/*/*/*.[ch] tests/*.h tests/*/*.[ch] docs/lessons/*/*.[ch])
if have clang-format "the format"; then
    clang-format --dry-run -Werror $sources 2>"$BUILD/format.log" || {
        grep -o '^[^:]*' "$BUILD/format.log" | sort -u | grep '^[a-z]*/' | sed 's/$/: not formatted; run make format/'; status=1; }
fi
foreign=$(nm -g --defined-only "$BUILD/liblom.a" 2>/dev/null | awk 'NF == 3 && $3 !~ /^lom_/ { print $3 }')
[ -z "$foreign" ] || found "exported without lom_: $(echo $foreign)"
transcendental=$(nm -u "$BUILD/liblom.a" 2>/dev/null | awk 'NF == 2 { print $2 }' |
    grep -E '^(sinf?|cosf?|tanf?|asinf?|acosf?|atanf?|atan2f?|expf?|exp2f?|logf?|log2f?|log10f?|powf?|fmaf?|sinhf?|coshf?|tanhf?|cbrtf?|hypotf?|qsort|rand)$' | sort -u)
[ -z "$transcendental" ] || found "libm or an unstable call is used: $(echo $transcendental)"
if have objdump "the instructions"; then
    fused=$(objdump -d --no-show-raw-insn "$BUILD/liblom.a" 2>/dev/null |
        grep -cE 'v?f(n?m)(add|sub|addsub|subadd)[0-9]*[ps][sd]|[[:space:]]v?rcp[0-9]*[ps]s|[[:space:]]v?rsqrt[0-9]*[ps]s')
    [ "$fused" -eq 0 ] || found "$fused fused or approximate instructions in $BUILD/liblom.a"
fi
# Processors that have a part of the vectors (haswell AVX2, knl AVX-512 without BW): each lane function on its own, as it
# is for them, so that none takes an instruction that is not there.
case $($CC -dumpmachine) in x86_64*)
    lane_headers='lanes/fours.h lanes/gathers.h lanes/mix_bytes.h lanes/pair_products.h lanes/row_pairs.h image/convert_lanes.h'
    for processor in x86-64 haswell knl skylake-avx512; do
        for lanes in 8 16; do
            asked="-std=gnu11 -march=$processor -DLOM_ALL_LANES -DLOM_LANES=$lanes -DLOM_VARIANT=${lanes}_plain"
            for header in $lane_headers; do echo "#include \"$header\""; done |
                $CC -E -P $asked -Iinclude -Isrc -x c - | sed 's/^static inline/__attribute__((used)) &/' >"$BUILD/processor.i"
            $CC -w -Wno-psabi -O1 -march=$processor -S -o "$BUILD/processor.s" "$BUILD/processor.i" || found "$lanes lanes for $processor"
        done
    done ;;
esac
headers=$(ls include/lom/*.h | grep -v _wasm)
case $($CC -dumpmachine) in x86_64*) ;; *) headers=$(echo "$headers" | grep -v _x86) ;; esac
for header in $headers; do
    $CC -std=c11 -Wall -Wextra -Wpedantic -Werror -Iinclude -fsyntax-only -x c "$header" || found "$header alone in C"
done
if have g++ "the headers in C++"; then
    for header in $headers; do
        g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror -Iinclude -fsyntax-only -x c++ "$header" ||
            found "$header alone in C++"
    done
fi
if have cppcheck "what cppcheck sees"; then
    cppcheck --quiet --std=c11 --language=c --enable=warning,performance,portability --inline-suppr -j 2 \
        --suppress=missingIncludeSystem --suppress=uninitvar --suppress=internalAstError --suppress=syntaxError \
        --suppress=invalidPointerCast:src/pipeline/packet.h --suppress=integerOverflow:src/image/convert_lanes.h \
        --error-exitcode=1 -Iinclude -Isrc $(ls src/*/*.c src/*/*/*.c | grep -v '\.wide\.c') || status=1
fi
# What is written goes through lom_open_writer. (main.c opens /dev/null for a stream that the caller
# closed, processes.c for those of another program.)
roads=$(grep -nE '\b(fopen|freopen|creat|rename|renameat|link|linkat|mkstemp|tmpfile|O_WRONLY|O_RDWR|O_CREAT)\b' $(ls src/*/*.c src/*/*/*.c) |
    grep -vE '^src/base/(writer|system)\.c:|^src/cli/(main|processes)\.c:.*/dev/null|^[^:]*:[0-9]*: *(/\*|\*)|"[^"]*\b(link|rename)\b')
[ -z "$roads" ] || found "a file is opened for writing beside lom_open_writer: $roads"
# Masks of varyings are made of names and of LOM_VARYINGS, not of numbers that repeat an enum.
numbers=$(grep -rnE '\.(reads|differentiates|flat) = ' include src tests docs --include='*.[ch]' --include='*.cpp' |
    sed -E 's/LOM_VARYINGS\([^)]*\)//g; s/1u << (\([^)]*\)|[A-Za-z_0-9]+)//g' | grep -E '\.(reads|differentiates|flat) = [ |]*[0-9(]')
[ -z "$numbers" ] || found "a mask of varyings is a number: $numbers"
# A file of src/ has at most 400 lines, but for tables of numbers; a function 60, from the line of its name to its brace.
number_tables='src/image/srgb_tables.c'
long=$(wc -l src/*/*.[ch] src/*/*/*.[ch] | awk -v tables=" $number_tables " '
    $2 != "total" && $1 > 400 && !index(tables, " " $2 " ") { print $2 " (" $1 " lines)" }')
[ -z "$long" ] || found "more than 400 lines: $long"
long=$(awk 'FNR == 1 { head = body = 0 }
    /^[A-Za-z_].*\(/ && !/;[ \t]*$/ { head = FNR; name = $0 }
    /^{$/ { body = head }
    /^}/ { if (body && FNR - body + 1 > 60) print FILENAME ": " name " (" FNR - body + 1 " lines)"; head = body = 0 }' \
    src/*/*.[ch] src/*/*/*.[ch])
[ -z "$long" ] || found "more than 60 lines: $long"
long=$(wc -l include/lom/*.h tests/*.h tests/*/*.[ch] | awk '$2 != "total" && $1 > 700 { print $2 " (" $1 " lines)" }')
[ -z "$long" ] || found "more than 700 lines: $long"
[ $status -eq 0 ] && echo "lint: clean"
exit $status
