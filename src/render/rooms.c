/* The rooms of a renderer, in order. In: the world of a scene. Out: what each room loads of it. Invariant: a room's
 * members are freed by the room alone, so that one can be loaded anew beside the others. */
#include "render/rooms.h"

static bool has_sky(const lom_scene *scene)
{
    return scene->sky.present;
}

static bool has_sun(const lom_scene *scene)
{
    return scene->sky.sun;
}

static bool has_terrain(const lom_scene *scene)
{
    return scene->terrain.present;
}

static bool has_entities(const lom_scene *scene)
{
    return scene->entity_count != 0;
}

static bool has_water(const lom_scene *scene)
{
    return scene->water.present;
}

static bool has_other_waters(const lom_scene *scene)
{
    return scene->other_water_count != 0;
}

static bool has_clouds(const lom_scene *scene)
{
    return scene->cloud_count != 0;
}

static bool has_drops(const lom_scene *scene)
{
    return lom_count_drops(scene) != 0;
}

static bool has_fluids(const lom_scene *scene)
{
    return lom_count_fluids(scene) != 0;
}

/* The members from the one to the other. */
#define MEMBERS(first, last)                                                                                           \
    offsetof(lom_renderer, first),                                                                                     \
        offsetof(lom_renderer, last) + sizeof((lom_renderer *)NULL)->last - offsetof(lom_renderer, first)

_Static_assert(offsetof(struct lom_drawn_water, photons) ==
                   offsetof(struct lom_drawn_water, far) + sizeof(struct lom_far_rows),
               "what is freed with the waves is moved with them: its members end where those begin that frames make");

/* The bed of the water is the ground's, and waves may carry the water's maps. */
const struct lom_room lom_rooms[LOM_ROOMS] = {
    { LOM_PART_SKY, "sky", MEMBERS(sky.box, sky.box), has_sky, lom_load_sky, lom_free_sky },
    { LOM_PART_SUN, "sun", MEMBERS(sky.sun, sky.sun), has_sun, lom_load_sun, lom_free_sun },
    { LOM_PART_GROUND, "ground", MEMBERS(ground, ground), has_terrain, lom_load_ground, lom_free_ground },
    { LOM_PART_GROUND_MAPS, "maps of the ground", MEMBERS(ground_maps, ground_maps), has_terrain, lom_load_ground_maps,
      lom_free_ground_maps },
    { LOM_PART_ENTITIES, "entities", MEMBERS(entities, entities), has_entities, lom_load_entities, lom_free_entities },
    { LOM_PART_WATER_MAPS, "maps of the water", MEMBERS(waters[0].normal_map, waters[0].flow_map), has_water,
      lom_load_water_maps, lom_free_water_maps },
    { LOM_PART_FOAM, "foam", MEMBERS(waters[0].foam, waters[0].foam), lom_shows_foam, lom_load_foam, lom_free_foam },
    { LOM_PART_BED, "bed of the water", MEMBERS(waters[0].bed, waters[0].bed), lom_shows_caustics, lom_load_bed,
      lom_free_bed },
    { LOM_PART_WAVES, "waves", MEMBERS(waters[0].site, waters[0].far), lom_shows_waves, lom_load_waves,
      lom_free_waves },
    { LOM_PART_OTHER_WATERS, "other waters", MEMBERS(waters[1], waters[LOM_MAX_OTHER_WATERS]), has_other_waters,
      lom_load_other_waters, lom_free_other_waters },
    { LOM_PART_CLOUDS, "clouds", MEMBERS(clouds, clouds), has_clouds, lom_load_clouds, lom_free_clouds },
    { LOM_PART_SPRAY, "spray", MEMBERS(spray, spray), has_drops, lom_load_spray, lom_free_spray },
    { LOM_PART_FLUIDS, "fluids", MEMBERS(fluids, fluids), has_fluids, lom_load_fluids, lom_free_fluids },
};

bool lom_load_rooms(lom_renderer *renderer, unsigned parts, lom_error *error)
{
    for (size_t i = 0; i < LOM_ROOMS; i++)
        if ((lom_rooms[i].part & parts) != 0 && !lom_rooms[i].load(renderer, error))
            return false;
    return true;
}

void lom_free_rooms(lom_renderer *renderer, unsigned parts)
{
    for (size_t i = 0; i < LOM_ROOMS; i++)
        if ((lom_rooms[i].part & parts) != 0)
            lom_rooms[i].free(renderer);
}

void lom_drop_made(lom_renderer *renderer, unsigned parts)
{
    static const struct {
        unsigned part;
        void (*drop)(lom_renderer *renderer);
    } rows[] = {
        { LOM_PART_GROUND_SHADOW, lom_drop_ground_shadow },   { LOM_PART_GROUND_LAYERS, lom_drop_composed_ground },
        { LOM_PART_ENTITY_SHADOWS, lom_drop_entity_shadows }, { LOM_PART_CAUSTICS, lom_drop_caustics },
        { LOM_PART_CLOUD_LIGHT, lom_drop_cloud_light },       { LOM_PART_TARGETS, lom_drop_targets },
        { LOM_PART_LAMP_SHADOWS, lom_drop_lamp_shadows },     { LOM_PART_ENTITY_SHADOWS, lom_drop_fluid_shadow }
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if ((rows[i].part & parts) != 0)
            rows[i].drop(renderer);
}
