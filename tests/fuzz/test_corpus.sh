#!/bin/sh
# Every fuzz target reads every file of its corpus once, without a crash. make fuzz looks for more.
for target in tests/fuzz/fuzz_*.c; do
    name=$(basename "$target" .c)
    corpus=tests/fuzz/corpus/$name
    if [ ! -d "$corpus" ]; then
        echo "FAIL corpus_$name: there is no $corpus"
        continue
    fi
    if "$BUILD/tests/fuzz/run_$name" "$corpus" >/dev/null 2>&1; then
        echo "PASS corpus_$name"
    else
        echo "FAIL corpus_$name: an input ended it; repeat: $BUILD/tests/fuzz/run_$name $corpus"
    fi
done
