#!/bin/sh
# Proves that the documented command makes docs/scene.md again, byte for byte.
command="$BUILD/lom make scene-docs -o -"
if $command | cmp -s - docs/scene.md; then
    echo "PASS scene_docs"
else
    echo "FAIL scene_docs: docs/scene.md is not what the program makes; repeat: $command | cmp - docs/scene.md"
fi
