#!/bin/sh
# Proves the limits whose figures are in bench/results/limits.md: how large the stripped program is, how much memory the
# lake takes, that an empty scene is done at once (with room for a machine that is slower or busy), and that a small stack
# is enough. Sanitized or unoptimised builds have other limits and are not measured.
. "$(dirname "$0")/cli.sh"

# The peak of the resident memory of a command, in KiB; what it prints is lost.
peak() {
    python3 - "$@" <<'END'
import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)
END
}

below() { # NAME VALUE LIMIT
    echo "$1: $2, limit $3"
    [ "$2" -lt "$3" ]
}

# The least processor time of ten runs in milliseconds: what else the machine does only makes a run wait.
least() {
    python3 - "$@" <<'END'
import resource, subprocess, sys
spent = [0]
for _ in range(10):
    subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, check=True)
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent.append(usage.ru_utime + usage.ru_stime)
print(int(min(b - a for a, b in zip(spent, spent[1:])) * 1000 + 0.999))
END
}

small_program() {
    strip -o "$folder/stripped" "$lom" && below "bytes" "$(wc -c <"$folder/stripped")" 7340032
}

lake_in_memory() {
    below "KiB" "$(peak "$lom" render assets/scenes/lake.toml --size 1680x1050 --threads 2 --hash)" 262144
}

empty_scene_at_once() {
    echo '' >"$folder/empty.toml"
    below "ms" "$(least "$lom" render "$folder/empty.toml" --hash)" 60 &&
        below "ms" "$(least "$lom" render "$folder/empty.toml" --size 160x90 -o "$folder/empty.png")" 20
}

# Workers' stacks are as large as the first one's.
small_stack() {
    for scene in lake swell; do
        wanted=$("$lom" render assets/scenes/$scene.toml --size 160x90 --threads 4 --hash) || return 1
        got=$(ulimit -s 256 && "$lom" render assets/scenes/$scene.toml --size 160x90 --threads 4 --hash) || return 1
        [ "$got" = "$wanted" ] || { echo "$scene: $got, not $wanted" && return 1; }
    done
}

if ! command -v python3 >/dev/null || ! command -v strip >/dev/null; then
    echo "SKIP limits: needs python3 and strip"
    exit 0
fi
if ! grep -q -e '-O3' "$BUILD/flags" 2>/dev/null || [ -n "$SAN" ]; then
    echo "SKIP limits: they hold for an optimised build without sanitizers"
    exit 0
fi
check the_stripped_program_is_small small_program
check the_lake_fits_in_256_megabytes lake_in_memory
check an_empty_scene_is_done_at_once empty_scene_at_once
check a_stack_of_256_kilobytes_is_enough small_stack
exit $failures
