/* Room for the drops of a scene. In: its emitters. Out: memory for the drops of all that are visible. */
#include "render/renderer.h"

static size_t count_of(const lom_spray *spray)
{
    return spray->visible ? (size_t)spray->count : 0;
}

size_t lom_count_drops(const lom_scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; scene->quality.spray && i < scene->spray_count; i++)
        count += count_of(&scene->sprays[i]);
    return count;
}

/* The body of an entity as it stands at the time 0; false where it is not in the world. */
static bool find_body(const lom_renderer *renderer, size_t followed, struct lom_hit_body *body)
{
    const struct lom_world *world = renderer->world;
    const lom_entity *entity = followed == 0 ? NULL : &renderer->scene->entities[followed - 1];
    for (size_t i = 0; i < world->entity_count; i++) {
        const struct lom_world_entity *at = &world->entities[i];
        if (at->entity != entity || at->mesh == NULL)
            continue;
        lom_entity_place place = { at->home, entity->rotation };
        if (entity->key_count != 0)
            place = lom_scene_entity_at(entity, 0);
        *body =
            (struct lom_hit_body){ .mesh = at->mesh,
                                   .world_from_model = lom_model_matrix(place.position, place.rotation, entity->scale),
                                   .followed = followed,
                                   .moves = entity->key_count != 0 };
        return true;
    }
    return false;
}

/* The places of emitters with a source. Their drops are those of the first water. */
static bool load_hits(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    struct lom_drawn_spray *m = &renderer->spray;
    const struct lom_wave_site site = lom_world_wave_site(renderer->world, 0);
    size_t sources = 0;
    for (size_t i = 0; i < scene->spray_count; i++)
        sources += scene->sprays[i].source != LOM_SPRAY_SEGMENT && count_of(&scene->sprays[i]) != 0;
    if (sources == 0)
        return true;
    m->hits = lom_allocate(scene->spray_count, sizeof *m->hits, error);
    m->hits_count = m->hits != NULL ? scene->spray_count : 0;
    bool done = m->hits != NULL;
    for (size_t i = 0; done && i < scene->spray_count; i++) {
        struct lom_hit_body body;
        const bool is_there = find_body(renderer, scene->sprays[i].followed, &body);
        if (count_of(&scene->sprays[i]) != 0)
            done = lom_find_hits(&m->hits[i], &scene->sprays[i], &site, is_there ? &body : NULL, error);
    }
    return done;
}

bool lom_load_spray(lom_renderer *renderer, lom_error *error)
{
    const lom_scene *scene = renderer->scene;
    struct lom_drawn_spray *m = &renderer->spray;
    size_t largest = 0, bouncing = 0;
    m->capacity = lom_count_drops(scene);
    if (m->capacity == 0)
        return true;
    for (size_t i = 0; i < scene->spray_count; i++)
        largest = count_of(&scene->sprays[i]) > largest ? count_of(&scene->sprays[i]) : largest;
    for (size_t i = 0; i < scene->spray_count; i++)
        if (scene->sprays[i].bounce > 0 && count_of(&scene->sprays[i]) > bouncing)
            bouncing = count_of(&scene->sprays[i]);
    m->reaches = lom_allocate(largest / LOM_DROPS_TOGETHER + 1, sizeof *m->reaches, error);
    m->sprites = lom_allocate(m->capacity, sizeof *m->sprites, error);
    m->depth = lom_allocate(m->capacity, sizeof *m->depth, error);
    for (int i = 0; i < 2 && bouncing != 0; i++)
        m->state[i] = lom_allocate(bouncing, LOM_BOUNCE_FLOATS * sizeof *m->state[i], error);
    m->order = lom_allocate(m->capacity, sizeof *m->order, error);
    m->scratch = lom_allocate(m->capacity, sizeof *m->scratch, error);
    return load_hits(renderer, error) && (bouncing == 0 || (m->state[0] != NULL && m->state[1] != NULL)) &&
           m->reaches != NULL && m->sprites != NULL && m->depth != NULL && m->order != NULL && m->scratch != NULL;
}

void lom_free_spray(lom_renderer *renderer)
{
    struct lom_drawn_spray *m = &renderer->spray;
    for (size_t i = 0; i < m->hits_count; i++)
        lom_free_hits(&m->hits[i]);
    lom_release(m->hits);
    lom_release(m->reaches);
    lom_release(m->sprites);
    lom_release(m->depth);
    lom_release(m->state[0]);
    lom_release(m->state[1]);
    lom_release(m->order);
    lom_release(m->scratch);
}
