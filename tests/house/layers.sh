#!/bin/sh
# Includes go down only: a folder of src/ (with those inside it) may include itself and what lies below it
# (docs/architecture.md), and system headers only of libc and pthreads; a room of src/render includes no other room. Prints
# each include that breaks this; fails when there is one.
below() {
    case $1 in
    base) echo base ;;
    lanes) echo lanes base ;;
    image) echo image "$(below lanes)" ;;
    geometry) echo geometry "$(below image)" ;;
    pipeline) echo pipeline "$(below image)" ;;
    shading) echo shading geometry "$(below pipeline)" ;;
    march) echo march "$(below image)" ;;
    waves) echo waves geometry "$(below shading)" ;;
    water | spray | fluid | cloud | sky) echo "$1 march $(below waves)" ;;
    scene) echo "scene water spray fluid cloud sky march $(below waves)" ;;
    world) echo "world $(below scene)" ;;
    reference) echo "reference $(below world)" ;;
    render) echo "render $(below reference)" ;;
    measure) echo "measure $(below render)" ;;
    inspect) echo "inspect $(below render)" ;;
    cli) echo "cli inspect $(below measure)" ;;
    web) echo "web $(below cli)" ;;
    esac
}
public() { # the public headers of each layer
    case $1 in
    base.h) echo base ;;
    fixed.h | lanes.h | lanes_mathematics.h | lanes_components.h | lanes_matrices.h | lanes_vectors.h | lanes_x86.h | lanes_wasm.h | notes.h) echo lanes ;;
    image.h | texture.h) echo image ;;
    record.h | stages.h) echo pipeline ;;
    sea.h | shallow.h) echo waves ;;
    particles.h) echo spray ;;
    transfer.h) echo march ;;
    lom.h) echo cli ;;
    *) basename "$1" .h ;;
    esac
}
system=' assert dirent errno fcntl fenv float inttypes limits math poll pthread sched signal stdarg stdatomic stdbool stddef stdint stdio stdlib string sys/resource sys/mman sys/stat sys/time sys/types sys/utsname sys/wait time unistd xmmintrin '
status=0
for folder in src/*/; do
    name=$(basename "$folder")
    allowed=" $(below "$name") "
    for file in $(find "$folder" -name '*.[ch]'); do
        [ -f "$file" ] || continue
        for word in $(sed -n 's/^#include *[<"]\([^>"]*\)[>"].*/\1/p' "$file"); do
            case $word in
            lom/*) layer=$(public "${word#lom/}") ;;
            */*.h) layer=${word%%/*}; [ -d "src/$layer" ] || layer= ;;
            *) layer= ;;
            esac
            case $file:$word in src/render/*/*:render/*/*) # a room of render/ knows the others by renderer.h alone
                [ "src/${word%/*}" = "${file%/*}" ] || { echo "$file includes $word of another room"; status=1; } ;;
            esac
            if [ -n "$layer" ]; then
                case $allowed in *" $layer "*) ;; *) echo "$file includes $word, which lies above or beside src/$name"; status=1 ;; esac
            elif [ "$file:$word" = src/cli/view_sdl.c:SDL.h ] || [ "$file:$word" = src/cli/view_sdl.c:dlfcn.h ]; then
                : # the window of lom view, and no other file (docs/view.md)
            elif [ ! -f "$(dirname "$file")/$word" ]; then
                case $system in *" ${word%.h} "*) ;; *) echo "$file includes <$word>, which is neither libc nor pthreads"; status=1 ;; esac
            fi
        done
    done
done
exit $status
