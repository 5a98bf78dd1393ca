/* lom/lom.h - the whole library. */
#ifndef LOM_H
#define LOM_H

#include <lom/base.h>
#include <lom/lanes.h>
#include <lom/lanes_mathematics.h>
#include <lom/image.h>
#include <lom/texture.h>
#include <lom/geometry.h>
#include <lom/march.h>
#include <lom/cloud.h>
#include <lom/pipeline.h>
#include <lom/scene.h>
#include <lom/sea.h>
#include <lom/particles.h>
#include <lom/shallow.h>
#include <lom/sky.h>
#include <lom/water.h>
#include <lom/waves.h>
#include <lom/reference.h>
#include <lom/render.h>

#endif
