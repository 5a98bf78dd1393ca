#!/bin/bash
# Proves the recipes of docs/many-machines.md, as they stand there: GNU parallel and a Slurm array draw a run in shares,
# one worker is killed while it draws, the command is given again, and the parts join to the bytes of one run. Part of
# `make check-long`. Slurm is one of its own; the array's script is also run without, a process a task.
set -u
cd "$(dirname "$0")/../.." || exit 2
BUILD=${BUILD:-build}
case $BUILD in /*) ;; *) BUILD=$PWD/$BUILD ;; esac
page=$PWD/docs/many-machines.md
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
scenes=$PWD/assets/scenes
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

# A Slurm of this machine alone, on two ports that nobody else is likely to have.
start_slurm() {
    local host port=$((20000 + $$ % 20000))
    host=$(hostname -s)
    mkdir state spool
    cat >slurm.conf <<END
ClusterName=here
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
END
    export SLURM_CONF=$PWD/slurm.conf
    slurmctld -D >control.log 2>&1 &
    control=$!
    slurmd -D >node.log 2>&1 &
    node=$!
    trap 'kill $node $control; wait $node $control 2>/dev/null' EXIT
    for _ in $(seq 300); do
        sinfo 2>/dev/null | grep -q ' idle ' && return
        sleep 0.1
    done
    cat control.log node.log
    return 1
}

with_slurm() {
    mkdir "$folder/slurm" && cd "$folder/slurm" && start_slurm || return 1
    recipe "A Slurm array" >shard.sh
    sbatch --wait --array=1-"$N" --export=ALL shard.sh >/dev/null &
    array=$!
    kill_worker 2 || echo "no worker was killed"
    wait $array
    [ ! -e part-002 ] || { echo "the killed worker left a part"; return 1; }
    whole sbatch --wait --array=1-"$N" --export=ALL shard.sh
}

# What lom cost says of a run, within 15 % of the processor time that the run takes, loading aside: the median of three
# pairs, since other work on the machine costs both.
cost() {
    for scene in lake falls swell; do
        words="$scenes/$scene.toml --size 320x180 --frames 0:23"
        for _ in 1 2 3; do
            # shellcheck disable=SC2086
            said=$(lom cost $words --draw 6 --json) || return 1
            # shellcheck disable=SC2086
            took=$({ TIMEFORMAT='%U %S' && time lom render $words --threads 1 --quiet --hash >/dev/null; } 2>&1)
            echo "$said" | awk -v took="$took" '{
                split(took, t, " "); match($0, /"seconds": [0-9.e+-]*/); cost = substr($0, RSTART + 11, RLENGTH - 11)
                match($0, /"loading_seconds": [0-9.e+-]*/); loading = substr($0, RSTART + 19, RLENGTH - 19)
                print cost / (t[1] + t[2] - loading), t[1] + t[2] - loading, cost }'
        done | sort -g | sed -n 2p | awk -v scene="$scene" '{
            printf "  %s: %.3g s, said to be %.3g s (%+.1f %%)\n", scene, $2, $3, 100 * ($1 - 1)
            exit $1 > 1.15 || $1 < 0.85 }' || return 1
    done
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
if command -v sbatch >/dev/null && command -v slurmctld >/dev/null && command -v slurmd >/dev/null; then
    (with_slurm)
    verdict slurm_with_a_worker_killed $?
else
    echo "SKIP slurm_with_a_worker_killed: slurmctld, slurmd or sbatch is not installed"
fi
(cost)
verdict cost_of_a_run_within_15_percent $?
exit $failures
