/* More small scenes over which test_change.c changes keys. */
#ifndef LOM_TESTS_CHANGE_BASES_H
#define LOM_TESTS_CHANGE_BASES_H

#include "key_bases.h"

/* Where those of key_bases.h show too little of what a change must not forget. */
static const struct base more_bases[] = {
    { "forward", "clouds.albedo clouds.forward quality.march cloud.0.file cloud.0.visible",
      VIEW TERRAIN CLOUD CLOUD "[quality]\nclouds = \"forward\"\n" },
    { "seen", "entity.0.material entity.0.on_ground entity.0.visible entity.0.position quality.entity_shadows",
      VIEW TERRAIN "[[entity]]\nmesh = \"box.obj\"\nposition = [0, 1, 2]\nscale = 3\n[entity.material]\ndiffuse = 0.5\n"
                   "specular = 0.5\n[[entity]]\nmesh = \"box.obj\"\nposition = [3, 4, 2]\n[quality]\n"
                   "entity_shadows = 64\n" },
    { "follower", "entity.0.key entity.0.interpolation entity.0.visible shallow.body shallow.spring",
      VIEW TERRAIN DISPLACED
      "[shallow]\ncells = 16\nsize = 20\n[[shallow.spring]]\nposition = [1, 1]\nrate = 20\n"
      "[[shallow.body]]\nposition = [2, 2]\n[[shallow.body]]\nentity = \"box\"\nhalf = [2, 2]\n"
      "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\n[[entity.key]]\ntime = 0\nposition = [0, 0, 0]\n"
      "[[entity.key]]\ntime = 0.1\nposition = [2, 0, 0]\n[[entity.key]]\ntime = 0.3\nposition = [0, 0, 4]\n" },
    { "caustics", "water.optics water.foam terrain.size camera.position",
      VIEW TERRAIN DISPLACED "[water.waves]\nkind = \"gerstner\"\ncount = 4\n[water.optics]\ncaustics = 1\n"
                             "caustics_texels = 16\ncaustics_size = 20\ntype = \"pure\"\n" },
    { "mirror", "quality.reflection_scale quality.water water.enabled water.flow water.normal_map water.flow_map",
      VIEW "[sky]\npattern = \"sky_%s.png\"\n" LAKE "size = 40\n" },
    { "waters", "water.level water.size water.normal_map water.flow_speed water.waves water.foam quality.water",
      VIEW TERRAIN "[quality]\nwater = \"displaced\"\n[[water]]\nname = \"a\"\nsize = [20, 40]\nposition = [-10, 0]\n"
                   "[water.waves]\nkind = \"gerstner\"\ncount = 4\n[[water]]\nname = \"b\"\nlevel = 0.3\n"
                   "size = [20, 40]\nposition = [10, 0]\nnormal_map = \"normal.png\"\n" },
    { "carried", "water.foam.carried water.foam.window water.foam.amount surf.height",
      VIEW TERRAIN DISPLACED "[water.foam]\namount = 2\ncarried = true\nwindow = 0.5\n[surf]\nheight = 0.4\n"
                             "[shallow]\ncells = 16\nsize = 20\nstart = -1\n[[shallow.spring]]\n"
                             "position = [1, 1]\nrate = 40\n" },
    { "off", "quality.terrain_shadows quality.entity_shadows quality.ambient_occlusion clouds.shadows sky.pattern",
      "[camera]\nposition = [0, 40, 30]\ntarget = [0, 0, 0]\n[light]\nazimuth = 20\nelevation = 8\n" CLOUD
      "[terrain]\nheight_map = \"height.png\"\nsize = 40\nheight = 60\nbase = -30\n"
      "[[entity]]\nmesh = \"box.obj\"\nposition = [0, 3, 2]\n[clouds]\nshadows = false\n[sky]\n"
      "pattern = \"sky_%s.png\"\n" },
};

#endif
