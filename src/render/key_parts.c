/* What each key of a scene is loaded for. In: the paths of keys. Out: parts of a renderer. The table below is where a new
 * key is classified; a key that it does not name loads everything, and tests/render/test_change.c fails.
 *
 * Invariant: a key that a row of `each_frame` names is looked up through the scene while a frame is drawn, whatever
 * frames have left behind before. */
#include "render/rooms.h"
#include "scene/scene_compare.h"

#include <string.h>

enum { each_frame = 0 };

const struct lom_key_row lom_key_rows[] = {
    { each_frame, "title output output.width output.height output.frames output.fps output.sample_shading output.white "
                  "camera.* view.* light.* lamp.* haze.*" },
    { LOM_PART_TARGETS, "output.format output.samples output.edges output.exposure output.curve" },
    { LOM_PART_TEXTURES | LOM_PART_TARGETS, "output.transfer" },

    { LOM_PART_SKY, "sky sky.pattern sky.faces sky.cube" },
    { LOM_PART_SUN, "sky.sun sky.sun_rays" },
    { each_frame, "sky.rotation sky.intensity sky.color sky.gradient sky.zenith sky.horizon sky.haze sky.haze_height "
                  "sky.glow sky.sun_size" },

    { LOM_PART_HEIGHTS | LOM_PART_GROUND_MAPS, "terrain" },
    { LOM_PART_HEIGHTS, "terrain.height_map terrain.size terrain.height terrain.base" },
    { LOM_PART_GROUND_MAPS, "terrain.texture terrain.detail_map terrain.normal_map terrain.layer terrain.layer.map "
                            "terrain.layer.grain" },
    { each_frame, "terrain.material.* terrain.position" },
    { LOM_PART_GROUND_LAYERS, "terrain.tile terrain.detail_tile terrain.layer.tile terrain.layer.from_height "
                              "terrain.layer.to_height terrain.layer.from_slope terrain.layer.to_slope "
                              "terrain.layer.blend terrain.layer.slope_blend terrain.layer.mapping" },

    { LOM_PART_WATER_MAPS | LOM_PART_FOAM | LOM_PART_BED | LOM_PART_WAVES | LOM_PART_TARGETS, "water" },
    { LOM_PART_WATER_MAPS, "water.normal_map water.flow_map water.flow" },
    { LOM_PART_TARGETS, "water.enabled" },
    { LOM_PART_WAVES, "water.level" },
    { LOM_PART_SPRAY, "water.position" },
    { each_frame, "water.name water.size water.tile water.normal_up water.reflection water.refraction "
                  "water.projection water.normals water.fresnel water.specular "
                  "water.tint water.soft_shore water.flow_strength water.flow_speed water.reflectivity "
                  "water.fresnel_power water.shininess water.specular_strength water.color water.tint_color "
                  "water.tint_amount water.shore_depth water.clip_offset" },
    { LOM_PART_WAVES, "water.waves water.waves.kind water.waves.direction water.waves.seed water.waves.spectrum "
                      "water.waves.wind_level water.waves.wind_speed water.waves.fetch water.waves.depth "
                      "water.waves.height_scale water.waves.choppiness water.waves.cascades water.waves.size "
                      "water.waves.patch" },
    { LOM_PART_SPRAY, "water.waves.height water.waves.length water.waves.count water.waves.steepness "
                      "water.waves.spread water.waves.speed" },
    { each_frame, "water.waves.cell" },
    { LOM_PART_BED, "water.optics.caustics" },
    { LOM_PART_CAUSTICS, "water.optics.caustics_texels" },
    { each_frame, "water.optics water.optics.index water.optics.fresnel water.optics.type water.optics.absorption "
                  "water.optics.scatter water.optics.roughness water.optics.glitter water.optics.reach "
                  "water.optics.steps water.optics.caustics_size water.optics.opacity" },
    { LOM_PART_FOAM, "water.foam water.foam.amount water.foam.shore_depth" },
    { LOM_PART_WAVES, "water.foam.carried water.foam.window" },
    { each_frame, "water.foam.threshold water.foam.tile" },
    { LOM_PART_WAVES, "surf surf.height surf.period surf.direction surf.breaking surf.plunging shallow.* "
                      "wake wake.*" },
    { LOM_PART_SPRAY, "surf.variation" },

    { LOM_PART_ENTITIES,
      "entity entity.mesh entity.position entity.rotation entity.scale entity.material.* entity.two_sided "
      "entity.back entity.back.* "
      "entity.on_ground entity.visible entity.key entity.line_width entity.point_size "
      "entity.alpha_to_coverage" },
    { LOM_PART_FOLLOWED, "entity.interpolation entity.key.time entity.key.position entity.key.rotation" },
    { LOM_PART_SPRAY, "entity.name" },

    { LOM_PART_CLOUDS,
      "cloud cloud.kind cloud.file cloud.voxels cloud.seed cloud.position cloud.middle cloud.size cloud.yaw "
      "cloud.density cloud.extinction cloud.detail cloud.visible cloud.transfer_function cloud.transfer_function.* "
      "clouds.evolve clouds.wind "
      "clouds.count clouds.oktas clouds.metar clouds.seed clouds.shapes clouds.area clouds.middle "
      "clouds.sizes clouds.voxels clouds.base clouds.mix clouds.mix.kind clouds.mix.share" },
    { LOM_PART_CLOUD_LIGHT, "clouds.albedo clouds.forward clouds.original_light clouds.lighter clouds.dark_light" },
    { each_frame,
      "cloud.name cloud.detail_size cloud.look clouds clouds.phase clouds.backward clouds.blend clouds.silver "
      "clouds.silver_spread clouds.brightness clouds.sky clouds.ground clouds.haze_color "
      "clouds.haze_distance clouds.shadows clouds.shadow_strength clouds.wind.height clouds.wind.speed "
      "clouds.wind.direction clouds.wind.gust clouds.wind.gust_period clouds.swell" },

    { LOM_PART_SPRAY | LOM_PART_TARGETS, "spray spray.count spray.visible spray.bounce spray.source "
                                         "spray.entity spray.from spray.to" },
    { each_frame, "spray.name spray.seed spray.kick spray.velocity spray.spread spray.spread_up spray.wind "
                  "spray.drag spray.jets spray.jet_time spray.jet_width spray.life spray.height spray.size "
                  "spray.stretch spray.color spray.opacity spray.soft spray.forward" },

    { LOM_PART_FLUIDS | LOM_PART_TARGETS, "fluid fluid.visible quality.fluid" },
    { LOM_PART_FLUIDS,
      "fluid.low fluid.high fluid.spacing fluid.step fluid.gravity fluid.viscosity "
      "fluid.solid_viscosity fluid.melting fluid.latent_heat fluid.conductivity fluid.block fluid.block.* fluid.solid "
      "fluid.solid.* fluid.ground" },
    { each_frame, "fluid.name fluid.start fluid.index fluid.absorption fluid.color fluid.highlight "
                  "fluid.shininess" },

    { LOM_PART_FOAM | LOM_PART_BED | LOM_PART_WAVES | LOM_PART_TARGETS, "quality.water" },
    { LOM_PART_CLOUDS, "quality.clouds quality.cloud_jitter quality.cloud_light_scale" },
    { LOM_PART_CLOUD_LIGHT, "quality.march" },
    { LOM_PART_SPRAY | LOM_PART_TARGETS, "quality.spray" },
    { LOM_PARTS_ALL, "quality.filtering" },
    { LOM_PART_TEXTURES, "quality.texture_filter quality.anisotropy" },
    { LOM_PART_TEXTURES | LOM_PART_GROUND, "quality.mipmaps" },
    { LOM_PART_TARGETS, "quality.reflection_scale quality.refraction_scale" },
    { each_frame, "quality.refraction_samples" },
    { LOM_PART_GROUND_SHADOW, "quality.terrain_shadows" },
    { LOM_PART_ENTITY_SHADOWS, "quality.entity_shadows quality.shadow_cascades" },
    { LOM_PART_LAMP_SHADOWS, "quality.lamp_shadows" },
    { LOM_PART_GROUND, "quality.ambient_occlusion quality.tessellation" },
    { LOM_PART_GROUND | LOM_PART_ENTITIES | LOM_PART_TARGETS, "quality.wireframe" },
    { each_frame, "quality quality.cloud_error quality.cloud_stop quality.cloud_octaves quality.impostors "
                  "quality.impostor.* quality.shading quality.reflection quality.toon_thresholds "
                  "quality.toon_tones quality.lamp_tiles quality.lamp_shadow_maps quality.shadow_split quality.normals "
                  "quality.scissor "
                  "quality.reference.* "
                  "quality.terrain_error quality.wireframe_color quality.terrain_composite" },
};
const size_t lom_key_row_count = sizeof lom_key_rows / sizeof *lom_key_rows;

/* Whether a name of a row is this path, or stands for it. */
static bool names(const char *name, size_t length, const char *path)
{
    const bool all = length > 2 && memcmp(name + length - 2, ".*", 2) == 0;
    length -= all ? 2 : 0;
    return strncmp(name, path, length) == 0 && (path[length] == 0 || (all && path[length] == '.'));
}

/* What may differ within a run of impostors, since the rule of plates looks at it in each frame. */
static const char run_keys[] = "camera.* view.* entity.key.* light light.azimuth light.elevation light.key.*";

static bool is_named(const char *names_of_keys, const char *path)
{
    for (const char *name = names_of_keys; *name != 0;) {
        size_t length = strcspn(name, " ");
        if (names(name, length, path))
            return true;
        name += length + (name[length] == ' ');
    }
    return false;
}

int lom_find_key_parts(const char *path, unsigned *parts)
{
    int found = 0;
    *parts = LOM_PARTS_ALL;
    for (size_t i = lom_key_row_count; i-- > 0;)
        if (is_named(lom_key_rows[i].names, path)) {
            *parts = lom_key_rows[i].parts;
            found++;
        }
    return found;
}

/* ---- between scenes ---- */

static void add_key(void *context, const char *path)
{
    struct lom_difference *d = context;
    unsigned parts;
    lom_find_key_parts(path, &parts);
    d->any = true;
    d->ends_run = d->ends_run || !is_named(run_keys, path);
    d->parts |= parts;
}

/* What is made from a part is made anew with it. */
static unsigned add_made_from(unsigned parts)
{
    static const struct {
        unsigned part, makes;
    } chain[] = {
        { LOM_PART_HEIGHTS, LOM_PART_GROUND | LOM_PART_ENTITIES | LOM_PART_BED | LOM_PART_WAVES | LOM_PART_FLUIDS },
        { LOM_PART_WAVES, LOM_PART_SPRAY },
        { LOM_PART_TEXTURES, LOM_PART_SKY | LOM_PART_GROUND_MAPS | LOM_PART_ENTITIES | LOM_PART_WATER_MAPS },
        { LOM_PART_GROUND_MAPS, LOM_PART_GROUND_LAYERS },
        { LOM_PART_GROUND, LOM_PART_LAMP_SHADOWS | LOM_PART_CLOUD_LIGHT },
        { LOM_PART_GROUND_SHADOW, LOM_PART_CLOUD_LIGHT },
        { LOM_PART_ENTITIES, LOM_PART_FOLLOWED | LOM_PART_LAMP_SHADOWS },
        { LOM_PART_FOLLOWED, LOM_PART_SPRAY },
        { LOM_PART_WATER_MAPS, LOM_PART_WAVES },
        { LOM_PART_WATER_MAPS | LOM_PART_FOAM | LOM_PART_BED | LOM_PART_WAVES, LOM_PART_OTHER_WATERS },
    };
    for (size_t i = 0; i < sizeof chain / sizeof *chain; i++)
        if ((parts & chain[i].part) != 0)
            parts |= chain[i].makes;
    return parts;
}

static bool has_followers(const lom_scene *scene)
{
    return lom_shows_waves(scene) && scene->shallow.present && scene->shallow.body_count != 0;
}

static unsigned parts_between(const lom_scene *before, const lom_scene *after, struct lom_difference d)
{
    if (d.any && (lom_is_traced(before) || lom_is_traced(after)))
        return LOM_PARTS_ALL;
    if (d.parts == LOM_PARTS_ALL)
        return d.parts;
    unsigned parts = add_made_from(d.parts);
    if ((parts & LOM_PART_FOLLOWED) != 0 && (has_followers(before) || has_followers(after)))
        parts |= LOM_PART_WAVES;
    parts &= ~(unsigned)LOM_PART_FOLLOWED;
    if (!before->terrain.present && !after->terrain.present)
        parts &= ~(unsigned)LOM_PART_HEIGHTS;
    for (size_t i = 0; i < LOM_ROOMS; i++)
        if (!lom_rooms[i].exists(before) && !lom_rooms[i].exists(after))
            parts &= ~lom_rooms[i].part;
    return parts;
}

struct lom_difference lom_difference_between(const lom_scene *before, const lom_scene *after)
{
    struct lom_difference d = { .any = false };
    lom_compare_scenes(before, after, add_key, &d);
    d.parts = parts_between(before, after, d);
    return d;
}
