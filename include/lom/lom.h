/* lom/lom.h - the whole library.
 *
 * Descriptors: NULL is the zero descriptor wherever a function takes one; numbers that are NaN or out of the range that
 * a descriptor states are an error with a sentence. A NULL device is one that has failed.
 *
 * Threads: one thread at a time calls an object; different devices (and renderers) run at once. Workers ask for the
 * stack they need.
 *
 * Forks: a device outlives a fork that happens while no call of it runs. In the child it goes on with the one thread
 * there is, draws the same bytes, and can be closed. */
#ifndef LOM_H
#define LOM_H

#include <lom/base.h>
#include <lom/lanes.h>
#include <lom/lanes_vectors.h>
#include <lom/lanes_components.h>
#include <lom/lanes_matrices.h>
#include <lom/lanes_mathematics.h>
#include <lom/fixed.h>
#include <lom/notes.h>
#include <lom/image.h>
#include <lom/texture.h>
#include <lom/geometry.h>
#include <lom/march.h>
#include <lom/transfer.h>
#include <lom/cloud.h>
#include <lom/pipeline.h>
#include <lom/fluid.h>
#include <lom/record.h>
#include <lom/scene.h>
#include <lom/sea.h>
#include <lom/stages.h>
#include <lom/particles.h>
#include <lom/shallow.h>
#include <lom/sky.h>
#include <lom/water.h>
#include <lom/waves.h>
#include <lom/reference.h>
#include <lom/render.h>
#include <lom/inspect.h>

#endif
