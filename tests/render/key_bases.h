/* The small scenes over which test_key_ranges.c tries keys: each is drawn in milliseconds, and says which keys change its
 * picture. */
#ifndef LOM_TESTS_KEY_BASES_H
#define LOM_TESTS_KEY_BASES_H

/* After the head; the keys under these names (in a picture that they change) are tried in it. */
struct base {
    const char *name, *keys, *text;
};

static const char head[] = "[output]\nwidth = 16\nheight = 9\nformat = \"rgb32f\"\n";
#define VIEW    "[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\n[light]\nazimuth = 20\nelevation = 25\n"
#define TERRAIN "[terrain]\nheight_map = \"height.png\"\nsize = 40\nheight = 6\nbase = -3\ntexture = \"color.png\"\n"
#define KEYS                                                                                                           \
    "[[camera.key]]\ntime = 0\n[[camera.key]]\ntime = 1\nposition = [1, 4, 12]\n[[light.key]]\ntime = "                \
    "0\n[[light.key]]\ntime = 1\nazimuth = 40\n"
#define CLOUD     "[[cloud]]\nkind = \"cumulus_mediocris\"\nsize = [12, 6, 8]\nposition = [0, 2, -8]\nvoxels = [8, 6, 7]\n"
#define WIND      "[[clouds.wind]]\nheight = 3\nspeed = 11\ndirection = -35\n"
#define MANY      "area = [30, 20]\nmiddle = [0, -10]\nsizes = [0.004, 0.008]\nvoxels = 0.08\n"
#define SEA       "[water.waves]\nkind = \"sea\"\nsize = 16\ncascades = 1\n"
#define LAKE      "[quality]\nwater = \"planar\"\n[water]\nlevel = 0\nnormal_map = \"normal.png\"\n"
#define DISPLACED "[quality]\nwater = \"displaced\"\n[water]\nlevel = 0\nsize = 40\n"

static const struct base bases[] = {
    { "ground",
      "output camera.position camera.target camera.roll camera.up camera.field_of_view camera.near "
      "camera.interpolation "
      "camera.key camera.person light.azimuth light.elevation light.color light.intensity light.ambient light.ground "
      "light.key haze sky terrain entity quality.terrain_error quality.tessellation quality.normals "
      "quality.terrain_shadows "
      "quality.entity_shadows quality.shadow_cascades quality.ambient_occlusion quality.shading quality.texture_filter "
      "quality.anisotropy "
      "quality.mipmaps",
      VIEW KEYS TERRAIN
      "tile = 5\ndetail_map = \"color.png\"\nnormal_map = \"normal.png\"\n[terrain.material]\nspecular = 0.3\n"
      "[[terrain.layer]]\nmap = \"layer.ppm\"\nfrom_height = 0\nto_slope = 60\n[haze]\nheight = 50\nglow = [0.4, 0.2, "
      "0.1]\n"
      "[sky]\npattern = \"sky_%s.png\"\n[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n"
      "[entity.material]\nspecular = 0.5\n[[entity.key]]\ntime = 0\n[[entity.key]]\ntime = 1\nposition = [1, 1, "
      "1]\n[quality]\nterrain_shadows = true\nentity_shadows = 64\nambient_occlusion = true\n" },
    { "composite", "terrain quality.terrain_composite",
      VIEW TERRAIN
      "tile = 5\ndetail_map = \"color.png\"\nnormal_map = \"normal.png\"\n[terrain.material]\nspecular = 0.3\n"
      "[[terrain.layer]]\nmap = \"layer.ppm\"\nfrom_height = 0\nto_slope = 60\n"
      "[quality]\nterrain_composite = 16\n" },
    { "lamps",
      "lamp.0.name lamp.0.position lamp.0.direction lamp.0.ambient lamp.0.diffuse lamp.0.specular lamp.0.intensity "
      "lamp.0.attenuation "
      "lamp.0.reach lamp.0.cutoff lamp.0.softness lamp.0.exponent lamp.0.on lamp.0.follow lamp.0.interpolation "
      "lamp.0.key lamp.0.shadow "
      "quality.lamp_tiles quality.reflection quality.toon_thresholds quality.toon_tones",
      VIEW TERRAIN
      "[terrain.material]\nspecular = 0.5\n[quality]\nreflection = \"toon\"\n"
      "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n"
      "[[lamp]]\nname = \"a\"\nposition = [0, 4, 3]\ndirection = [0, -1, 0.1]\ncutoff = 60\nsoftness = 20\n"
      "exponent = 2\nattenuation = [1, 0.1, 0.05]\nreach = 30\n[[lamp.key]]\ntime = 0\n"
      "[[lamp.key]]\ntime = 1\nposition = [1, 4, 2]\n[[lamp]]\nname = \"b\"\nposition = [2, 3, 2]\n"
      "range = 7\n[[lamp]]\ndirection = [1, -1, 1]\ndiffuse = 0.1\n" },
    { "cascades", "quality.shadow_split camera.position quality.entity_shadows",
      VIEW TERRAIN "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n"
                   "[[entity]]\nmesh = \"box.obj\"\nposition = [3, 0.3, -9]\n"
                   "[quality]\nentity_shadows = 64\nshadow_cascades = 3\n" },
    { "lamp_shadows", "lamp.0.shadow lamp.0.shadow_from lamp.0.position quality.lamp_shadows quality.lamp_shadow_maps",
      VIEW TERRAIN "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n"
                   "[[lamp]]\nposition = [0, 4, 3]\nrange = 20\nshadow = true\n[quality]\nlamp_shadows = 32\n" },
    { "materials", "entity.0.material entity.0.two_sided entity.0.back light.elevation",
      VIEW
      "[[entity]]\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\nrotation = [200, 30, 0]\nscale = 2\n[entity.material]\n"
      "specular = 0.5\nemissive = 0.1\nemissive_map = \"color.png\"\nspecular_map = \"color.png\"\n"
      "gloss_map = \"color.png\"\nnormal_map = \"normal.png\"\n[entity.back]\nspecular = 0.5\nemissive = 0.1\n"
      "texture = \"color.png\"\n" },
    { "ranges", "lamp.0.range lamp.0.position", VIEW TERRAIN "[[lamp]]\nposition = [0, 4, 3]\nrange = 7\n" },
    { "orthographic", "camera.projection camera.height camera.far camera.position camera.near",
      "[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\nprojection = \"orthographic\"\nheight = 9\nfar = "
      "60\n" TERRAIN "[water]\nlevel = 0\n" },
    { "oblique", "camera.foreshortening camera.receding_angle camera.height camera.key.height camera.far",
      "[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\nprojection = \"oblique\"\nheight = 9\nfar = 60\n"
      "[[camera.key]]\ntime = 0\n[[camera.key]]\ntime = 1\nheight = 12\n" TERRAIN CLOUD },
    { "lines",
      "entity.0.line_width entity.0.point_size entity.0.alpha_to_coverage quality.wireframe quality.wireframe_color",
      VIEW TERRAIN "[[entity]]\nmesh = \"wires.obj\"\nposition = [0, 1, 2]\n[entity.material]\ntexture = "
                   "\"color.png\"\n[quality]\nwireframe = \"visible\"\n" },
    { "views",
      "view.0.name view.0.rectangle view.0.mirrored view.0.visible view.0.camera.position view.0.camera.target "
      "view.0.camera.roll view.0.camera.up view.0.camera.field_of_view view.0.camera.near view.0.camera.projection "
      "view.0.camera.height view.0.camera.far view.0.camera.foreshortening view.0.camera.receding_angle "
      "view.0.camera.interpolation view.0.camera.key view.0.camera.follow view.0.camera.person camera.position",
      VIEW KEYS TERRAIN "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n"
                        "[[view]]\nname = \"a\"\nrectangle = [0.5, 0, 0.5, 0.5]\nmirrored = true\n[view.camera]\n"
                        "position = [0, 20, 0]\ntarget = [0, 0, 0]\nup = [0, 0, -1]\nprojection = \"oblique\"\n"
                        "height = 20\nfar = 60\nfollow = \"box\"\n[[view.camera.key]]\ntime = 0\n"
                        "[[view.camera.key]]\ntime = 1\nheight = 10\n[[view]]\nname = \"b\"\n"
                        "rectangle = [0, 0.25, 0.25, 0.5]\n[view.camera]\nyaw = 10\nposition = [0, 3, 12]\n" },
    { "turned_views", "view.0.camera.yaw view.0.camera.pitch",
      VIEW TERRAIN "[[view]]\nname = \"a\"\nrectangle = [0, 0.25, 0.25, 0.5]\n[view.camera]\nyaw = 10\npitch = -9\n"
                   "position = [0, 3, 12]\n" },
    { "tone", "output.exposure output.curve output.white", "curve = \"reinhard\"\n" VIEW TERRAIN },
    { "sky", "sky camera.yaw camera.pitch camera.roll camera.near light.direction light.intensity",
      "[camera]\nyaw = 20\npitch = 3\n[light]\ndirection = [1, -1, 2]\n[sky]\ngradient = true\nsun = true\nglow = "
      "[0.5, 0.2, 0.1]\n" },
    { "lake",
      "water quality.filtering quality.reflection_scale quality.refraction_scale quality.scissor quality.water "
      "camera.position",
      VIEW TERRAIN LAKE },
    { "sampled_lake", "quality.refraction_samples", "samples = 4\n" VIEW TERRAIN LAKE },
    { "clouds",
      "cloud clouds camera.near camera.position camera.field_of_view light.elevation quality.march quality.cloud_error "
      "quality.cloud_stop quality.cloud_octaves quality.cloud_jitter quality.cloud_light_scale quality.clouds",
      VIEW TERRAIN CLOUD
      "[[cloud]]\nkind = \"stratus\"\nsize = [20, 3, 20]\nposition = [0, 5, -20]\nvoxels = [8, 4, 8]\n" WIND
      "[clouds]\nhaze_distance = 90\nshadows = false\n" MANY },
    { "many_clouds",
      "clouds.count clouds.seed clouds.shapes clouds.area clouds.middle clouds.sizes clouds.voxels clouds.base "
      "clouds.mix cloud.0.visible",
      VIEW CLOUD "[clouds]\ncount = 3\nbase = 2\nshadows = false\n" MANY
                 "[[clouds.mix]]\nkind = \"cumulus_fractus\"\n[[clouds.mix]]\nkind = \"puffs\"\nshare = 2\n" },
    { "cloud_shadows",
      "clouds.shadows clouds.shadow_strength cloud.0.size cloud.0.position cloud.0.yaw cloud.0.density "
      "cloud.0.extinction cloud.0.detail_size light.elevation terrain.size",
      VIEW TERRAIN CLOUD },
    { "original", "clouds.lighter clouds.dark_light clouds.original_light cloud.0.size cloud.0.density",
      VIEW CLOUD "[quality]\nclouds = \"original\"\n" },
    { "layers",
      "clouds.albedo clouds.phase clouds.forward clouds.silver quality.clouds cloud.0.size cloud.0.detail_size",
      "[camera]\nposition = [0, -3, -2]\ntarget = [0, 4, -8]\n[light]\nazimuth = 20\nelevation = 25\n" CLOUD
      "[quality]\nclouds = \"layers\"\n" },
    { "transfer", "cloud.0.transfer_function cloud.0.look cloud.0.detail quality.clouds",
      VIEW CLOUD "look = \"surface\"\ntransfer_function = [{ value = 0, extinction = 0 }, { value = 1 }]\n" },
    { "evolve", "clouds.evolve clouds.swell clouds.wind output.fps", VIEW CLOUD WIND "[clouds]\nevolve = 3\n" },
    { "impostors",
      "quality.impostor quality.impostors cloud.0.size cloud.0.position cloud.0.yaw camera.near "
      "camera.field_of_view",
      VIEW CLOUD "[quality]\nimpostors = \"bounded\"\n" },
    { "reference_impostors", "quality.impostor cloud.0.size cloud.0.position",
      VIEW CLOUD "[quality]\nimpostors = \"reference\"\n" },
    { "gerstner", "water quality.water camera.position",
      VIEW DISPLACED
      "[water.waves]\nkind = \"gerstner\"\ncount = 4\n[water.optics]\ncaustics = 1\ncaustics_texels = 16\n" },
    { "sea", "water.waves water.level output.fps", VIEW DISPLACED SEA },
    { "foam", "water.foam water.waves.choppiness output.fps",
      VIEW DISPLACED SEA "[water.foam]\namount = 1\nwindow = 0.2\n" },
    { "marched", "water.waves.height water.waves.length water.optics water.size camera.position",
      VIEW "[quality]\nwater = \"marched\"\n[water]\nlevel = 0\nsize = 40\n[water.waves]\nkind = \"gerstner\"\ncount = "
           "2\n" },
    { "flow", "water.waves.speed water.waves.direction water.tile water.position",
      VIEW DISPLACED "normal_map = \"normal.png\"\n[water.waves]\nkind = \"flow\"\n" },
    { "rapids", "water.foam.carried water.foam.window water.foam.tile",
      VIEW TERRAIN DISPLACED "normal_map = \"normal.png\"\n[water.waves]\nkind = \"flow\"\nspeed = 6\n"
                             "[water.foam]\namount = 1\ncarried = true\n" },
    { "surf", "surf terrain.size terrain.height terrain.base water.level water.size",
      VIEW TERRAIN DISPLACED "[surf]\nheight = 0.4\n" },
    { "plunging", "surf.breaking surf.plunging",
      VIEW TERRAIN DISPLACED "[surf]\nheight = 0.4\nperiod = 2\nbreaking = \"plunging\"\n" },
    { "shallow", "shallow terrain.size water.size water.level",
      VIEW TERRAIN DISPLACED "[shallow]\ncells = 16\nsize = 20\n[[shallow.spring]]\nposition = [1, 1]\nrate = 2\n"
                             "[[shallow.body]]\nposition = [2, 2]\nduration = 1\n" },
    { "wakes", "wake water.foam.window water.foam.carried water.foam.amount water.foam.tile entity.0.key",
      VIEW DISPLACED "[water.foam]\namount = 2\nwindow = 0.6\ncarried = true\ntile = 1.5\n[[wake]]\nentity = \"box\"\n"
                     "half = [1.5, 1]\n[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\n[[entity.key]]\n"
                     "time = -1\nposition = [-6, 0, 2]\n[[entity.key]]\ntime = 1\nposition = [8, 0, 3]\n" },
    { "spray", "spray quality.spray camera.near output.fps",
      VIEW
      "[[spray]]\ncount = 20\nfrom = [-1, 2, 0]\nto = [1, 2, 0]\njets = 2\nspread = 0.3\nspread_up = 0.2\ndrag = 0.3\n"
      "size = [0.3, 0.5]\nstretch = 0.1\n" },
    { "hits", "spray.0.source spray.0.kick spray.0.from spray.0.to spray.0.jet_time surf.variation surf.period",
      VIEW TERRAIN DISPLACED "[surf]\nheight = 0.4\n[[spray]]\nsource = \"surf\"\nfrom = [-20, 0, -20]\n"
                             "to = [20, 0, 20]\ncount = 40\nkick = 2\nsize = 0.4\nlife = 2\n" },
    { "entity_hits",
      "spray.0.source spray.0.entity spray.0.kick entity.0.name entity.0.position entity.0.key water.position "
      "water.waves.height water.waves.length water.waves.count water.waves.spread water.waves.steepness",
      VIEW TERRAIN DISPLACED "[water.waves]\nkind = \"gerstner\"\nheight = 1\nlength = [9, 5]\ncount = 3\n"
                             "[[spray]]\nsource = \"entity\"\nentity = \"post\"\ncount = 40\nkick = 2\n"
                             "size = 0.4\nlife = 2\n[[entity]]\nname = \"post\"\nmesh = \"box.obj\"\n[[entity.key]]\n"
                             "time = 0\nposition = [0, 0, 2]\n[[entity.key]]\ntime = 1\nposition = [1, 0, 2]\n" },
    { "far_fluid", "fluid.0.high fluid.0.spacing",
      VIEW "[[fluid]]\nlow = [998000, 998000, 998000]\nhigh = [1e6, 1e6, 1e6]\nspacing = 200\n"
           "[[fluid.block]]\nlow = [998000, 998000, 998000]\nhigh = [1e6, 1e6, 1e6]\n" },
    { "fluid",
      "fluid.0.visible fluid.0.low fluid.0.start fluid.0.step fluid.0.gravity fluid.0.viscosity "
      "fluid.0.solid_viscosity fluid.0.melting fluid.0.latent_heat fluid.0.conductivity fluid.0.block fluid.0.solid "
      "fluid.0.index "
      "fluid.0.absorption fluid.0.color fluid.0.highlight fluid.0.shininess fluid.0.ground quality.fluid terrain.base",
      VIEW TERRAIN "[[fluid]]\nlow = [-3, 0, -3]\nhigh = [3, 4, 3]\nspacing = 0.5\nviscosity = 0.1\n"
                   "solid_viscosity = 10\nmelting = [20, 80]\nconductivity = 0.1\nabsorption = 0.3\n"
                   "[[fluid.block]]\nlow = [-2, 1, -2]\nhigh = [1, 3, 2]\ntemperature = 50\n"
                   "[[fluid.solid]]\nlow = [-3, 0, -3]\nhigh = [3, 1, 3]\nheats = true\ntemperature = 500\n" },
    { "lit_fluid",
      "fluid.0.high fluid.0.absorption fluid.0.visible quality.entity_shadows quality.lamp_shadows lamp.0.shadow",
      VIEW "[[entity]]\nmesh = \"box.obj\"\nposition = [0, -1, 0]\nscale = [4, 0.4, 4]\n"
           "[water]\nlevel = 0\n[[lamp]]\nposition = [2, 6, 1]\nrange = 13\nshadow = true\n"
           "[[fluid]]\nlow = [-2, -1, -2]\nhigh = [2, 3, 2]\nspacing = 0.5\nabsorption = 0.3\n"
           "[[fluid.block]]\nlow = [-1, -1, -1]\nhigh = [1, 2, 1]\n"
           "[quality]\nwater = \"planar\"\nentity_shadows = 64\n" },
    { "falls", "spray.0.height spray.0.velocity",
      VIEW "[[spray]]\ncount = 20\nfrom = [-1, 2, 0]\nto = [1, 2, 0]\nspread = 0.3\nheight = 4\n" },
    { "reference", "quality.reference water.optics light.elevation",
      VIEW TERRAIN "[water]\nlevel = 0\n[quality]\nwater = \"reference\"\n"
                   "[quality.reference]\nsamples = 1\ndepth = 2\n" },
    { "reference_clouds", "cloud.0 clouds.albedo clouds.forward",
      VIEW CLOUD "[quality]\nclouds = \"reference\"\n[quality.reference]\nsamples = 1\n" },
};

#endif
