#!/bin/sh
# Proves that a picture is old or new and never half: killed at any moment, on a full disk, over a size limit.
cd "$(dirname "$0")/../.." || exit 1
. tests/cli/cli.sh
. tests/cli/scene.sh
cd "$folder/scene" || exit 1
hash_of() { "$lom" info "$1" | sed 's/.*hash //'; }
"$lom" render scene.toml --size 600x400 -o new.png
"$lom" render scene.toml --size 30x20 -o old.png
new=$(hash_of new.png) old=$(hash_of old.png)

a_kill_leaves_the_old_or_the_new_file() {
    killed=0
    for delay in 0 0.002 0.004 0.006 0.008 0.01 0.012 0.014 0.016 0.02 0.024 0.03 0.04 0.05; do
        cp old.png out.png
        "$lom" render scene.toml --size 600x400 -o out.png --quiet &
        job=$!
        sleep $delay
        kill -9 $job 2>/dev/null
        wait $job 2>/dev/null && status=0 || status=$?
        left=$(hash_of out.png)
        [ $status -ne 0 ] && killed=$((killed + 1))
        if [ "$left" != "$new" ] && { [ "$left" != "$old" ] || [ $status -eq 0 ]; }; then
            echo "after $delay s, status $status: $left is neither $old nor $new"
            return 1
        fi
    done
    rm -f .lom-*
    [ $killed -gt 0 ]
}

a_full_disk_is_an_error() {
    [ -e /dev/full ] || return 0
    exits 2 "$lom" render scene.toml -o /dev/full --format png && complains "/dev/full" &&
        exits 2 "$lom" convert old.png /dev/full --format ppm && complains "/dev/full" || return 1
    for command in "render scene.toml -o - --format png" "render scene.toml --hash" "render scene.toml --stats -" \
        "info old.png" "plan scene.toml" "selftest" "convert old.png - --format ppm"; do
        # shellcheck disable=SC2086
        "$lom" $command >/dev/full 2>"$folder/err"
        [ $? -eq 2 ] && [ -s "$folder/err" ] || { echo "lost: $command"; return 1; }
    done
    exits 2 "$lom" render scene.toml -o out.png --stats /dev/full && complains "/dev/full"
}

a_size_limit_keeps_the_old_file() {
    cp old.png out.png
    (ulimit -f 8 && exec "$lom" render scene.toml --size 600x400 -o out.png --quiet) 2>"$folder/err"
    [ $? -eq 2 ] && complains "out.png" && [ "$(hash_of out.png)" = "$old" ] && [ -z "$(find . -name '.lom-*')" ]
}

check a_kill_leaves_the_old_or_the_new_file a_kill_leaves_the_old_or_the_new_file
check a_full_disk_is_an_error a_full_disk_is_an_error
check a_size_limit_keeps_the_old_file a_size_limit_keeps_the_old_file
exit $failures
