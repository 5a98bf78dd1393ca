# What the scripts of this folder share: sourced, not run. A test is `check NAME COMMAND...`: it passes when COMMAND
# (often a function of the script) succeeds; what it prints explains a failure.
BUILD=${BUILD:-build}
lom=$PWD/$BUILD/lom
case $BUILD in /*) lom=$BUILD/lom ;; esac
script=$0
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
failures=0

check() {
    check_name=$1
    shift
    if "$@" >"$folder/check.log" 2>&1; then
        echo "PASS $check_name"
    else
        sed 's/^/  /' "$folder/check.log" | head -n 20
        echo "FAIL $check_name: $* failed; repeat: BUILD=$BUILD sh $script"
        failures=1
    fi
}

# exits STATUS COMMAND...: COMMAND ends with STATUS. Its output is kept in $folder/out and $folder/err.
exits() {
    exits_expected=$1
    shift
    "$@" >"$folder/out" 2>"$folder/err"
    exits_status=$?
    [ "$exits_status" -eq "$exits_expected" ] && return
    echo "status $exits_status instead of $exits_expected: $*"
    cat "$folder/out" "$folder/err"
    return 1
}

# says TEXT, complains TEXT: the last command printed TEXT on stdout, on stderr.
says() {
    grep -qF -- "$1" "$folder/out" && return
    echo "stdout lacks: $1"
    cat "$folder/out"
    return 1
}

complains() {
    grep -qF -- "$1" "$folder/err" && return
    echo "stderr lacks: $1"
    cat "$folder/err"
    return 1
}
