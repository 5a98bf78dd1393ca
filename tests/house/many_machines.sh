#!/bin/bash
# Proves the recipes of docs/many-machines.md, as they stand there: GNU parallel and a Slurm array draw a run in shares,
# one worker is killed while it draws, the command is given again, and the parts join to the bytes of one run. Part of
# `make check-long`. Without Slurm the array's script is run as Slurm runs it, a process a task with its variables.
set -u
cd "$(dirname "$0")/../.." || exit 2
BUILD=${BUILD:-build}
case $BUILD in /*) ;; *) BUILD=$PWD/$BUILD ;; esac
page=$PWD/docs/many-machines.md
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
export PATH=$BUILD:$PATH SCENE=$PWD/assets/scenes/lake.toml FRAMES=0:11 N=6 OUT=joined.y4m
failures=0

# The block of commands of the page under a heading.
recipe() {
    awk -v heading="## $1" '$0 == heading { on = 1 } on && /^```sh/ { within = 1; next }
        within && /^```/ { exit } within' "$page"
}

# Waits until the part of a share is begun, and ends its process.
kill_worker() {
    local share=$1 process=
    for _ in $(seq 600); do
        process=$(pgrep -f -n -- "lom render .*--shard $share/$N .*-o part-%03d")
        [ -z "$process" ] || break
        sleep 0.05
    done
    [ -n "$process" ] && kill -KILL "$process"
}

verdict() {
    if [ "$2" -eq 0 ]; then
        echo "PASS $1"
    else
        echo "FAIL $1: see above; repeat: BUILD=$BUILD $PWD/tests/house/many_machines.sh"
        failures=1
    fi
}

# Joined before all is there: refused. Joined then: the bytes of one run.
whole() {
    if [ "$(ls part-* 2>/dev/null | wc -l)" -lt "$N" ] && lom join part-* -o early.y4m 2>early.log; then
        echo "parts were missing, and were joined"
        return 1
    fi
    "$@" || return 1
    lom join part-* -o joined.y4m && cmp joined.y4m ../whole.y4m
}

with_parallel() {
    mkdir "$folder/parallel" && cd "$folder/parallel" || return 1
    recipe "GNU parallel" | head -n 1 >draw.sh
    sh draw.sh 2>first.log &
    kill_worker 3 || echo "no worker was killed"
    wait $!
    [ ! -e part-003 ] || { echo "the killed worker left a part"; return 1; }
    whole sh draw.sh
}

# A task as Slurm starts it.
task() {
    SLURM_ARRAY_TASK_ID=$1 SLURM_ARRAY_TASK_COUNT=$N sh shard.sh
}

tasks() {
    for share in $(seq "$N"); do task "$share" || return 1; done
}

with_array() {
    mkdir "$folder/array" && cd "$folder/array" || return 1
    recipe "A Slurm array" >shard.sh
    for share in 5 1 2 6; do task $share & done
    kill_worker 2 || echo "no worker was killed"
    wait
    [ ! -e part-002 ] || { echo "the killed worker left a part"; return 1; }
    whole tasks
}

with_slurm() {
    mkdir "$folder/slurm" && cd "$folder/slurm" || return 1
    recipe "A Slurm array" >shard.sh
    sbatch --wait --array=1-"$N" --export=ALL shard.sh >/dev/null &
    kill_worker 2 || echo "no worker was killed"
    wait $!
    whole sbatch --wait --array=1-"$N" --export=ALL shard.sh
}

lom render "$SCENE" --frames "$FRAMES" -o "$folder/whole.y4m" --quiet || exit 2
if command -v parallel >/dev/null; then
    (with_parallel)
    verdict gnu_parallel_with_a_worker_killed $?
else
    echo "SKIP gnu_parallel_with_a_worker_killed: parallel is not installed"
fi
(with_array)
verdict tasks_of_an_array_with_a_worker_killed $?
if command -v sbatch >/dev/null && sinfo >/dev/null 2>&1; then
    (with_slurm)
    verdict slurm_with_a_worker_killed $?
else
    echo "SKIP slurm_with_a_worker_killed: there is no Slurm here"
fi
exit $failures
