/* The order of what is transparent. In: places, and where a view's rays come from. Out: the farthest first, equally far
 * ones as they stood.
 *
 * Invariant: the order is a function of the view's eye and of where the entities are, in double, whoever sorts. Runs of RUN
 * are sorted by one worker each, then merged two by two; a worker finds where its part of a merged run begins by what must
 * have come before. Compiled for speed. */
#include "render/entities/order.h"

#include "pipeline/share_work.h"

enum { RUN = 2048, PIECE = 1024 };

struct lom_order lom_order_of(const struct lom_scene_view *view)
{
    const lom_view_rays rays = lom_find_view_rays(&view->projection, &view->view);
    return (struct lom_order){ view->eye, rays.ahead, rays.parallel };
}

double lom_distance_of(const struct lom_order *order, lom_vec3 place)
{
    lom_vec3 d = lom_vec3_subtract(place, order->eye), along = order->parallel ? order->ahead : d;
    return d.x * along.x + d.y * along.y + d.z * along.z;
}

/* ---- sorting ---- */

/* Two sorted runs, the second of which begins at `middle`. */
struct merging {
    const struct lom_distant *from;
    size_t middle, end;
};

/* How many of the first run are among the first `count` of both. */
static size_t find_part(const struct merging *m, size_t count)
{
    size_t low = count > m->end - m->middle ? count - (m->end - m->middle) : 0;
    size_t high = count < m->middle ? count : m->middle;
    while (low < high) {
        const size_t a = low + (high - low) / 2, b = m->middle + count - a;
        if (m->from[a].distance >= m->from[b - 1].distance)
            low = a + 1;
        else
            high = a;
    }
    return low;
}

/* Places first to end of what both make: of equally far things that of the first run comes first. */
static void merge(const struct merging *m, size_t first, size_t end, struct lom_distant *to)
{
    size_t a = find_part(m, first), b = m->middle + first - a;
    for (size_t i = first; i < end; i++) {
        bool is_first = b == m->end || (a < m->middle && m->from[a].distance >= m->from[b].distance);
        to[i] = m->from[is_first ? a++ : b++];
    }
}

/* Runs of `run` become runs of twice the length. */
struct sorting {
    const struct lom_distant *from;
    struct lom_distant *to;
    size_t count, run;
};

static void merge_places(void *context, size_t first, size_t end)
{
    const struct sorting *s = context;
    for (size_t i = first, next; i < end; i = next) {
        const size_t start = i / (2 * s->run) * (2 * s->run), left = s->count - start;
        const struct merging m = { s->from + start, s->run < left ? s->run : left,
                                   2 * s->run < left ? 2 * s->run : left };
        next = start + m.end < end ? start + m.end : end;
        merge(&m, i - start, next - start, s->to + start);
    }
}

static void exchange(struct sorting *s)
{
    struct lom_distant *sorted = s->to;
    s->to = (struct lom_distant *)s->from;
    s->from = sorted;
    s->run *= 2;
}

static void sort_runs(void *context, size_t first, size_t end)
{
    struct sorting s = *(const struct sorting *)context;
    while (s.run < RUN) {
        merge_places(&s, first, end);
        exchange(&s);
    }
}

struct lom_distant *lom_sort_distant(lom_device *device, struct lom_distant *list, size_t count)
{
    struct sorting s = { .from = list, .to = list + count, .count = count, .run = 1 };
    lom_share_work(device, count, RUN, sort_runs, &s);
    while (s.run < RUN) /* as each of the workers has done */
        exchange(&s);
    for (; s.run < count; exchange(&s))
        lom_share_work(device, count, PIECE, merge_places, &s);
    return (struct lom_distant *)s.from;
}

/* ---- triangles ---- */

/* The middle of a triangle in the world. */
static lom_vec3 find_middle(const struct lom_drawn_entity *entity, const uint32_t *index)
{
    const lom_mesh *mesh = entity->source->mesh;
    double sum[3] = { 0, 0, 0 };
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            sum[i] += (double)mesh->vertices[index[k]].position[i];
    return lom_transform_point(&entity->at->world_from_model, (lom_vec3){ sum[0] / 3, sum[1] / 3, sum[2] / 3 });
}

/* Whether a triangle of an entity that has materials of its own for backs turns its back. */
static bool shows_back(const struct lom_drawn_entity *entity, const uint32_t *index, const struct lom_order *order)
{
    lom_vec3 p[3];
    if (entity->backs == NULL)
        return false;
    for (int k = 0; k < 3; k++) {
        const float *at = entity->source->mesh->vertices[index[k]].position;
        p[k] = lom_transform_point(&entity->at->world_from_model, (lom_vec3){ at[0], at[1], at[2] });
    }
    const lom_vec3 n = lom_vec3_cross(lom_vec3_subtract(p[1], p[0]), lom_vec3_subtract(p[2], p[0]));
    const lom_vec3 away = order->parallel ? order->ahead : lom_vec3_subtract(p[0], order->eye);
    const bool behind = n.x * away.x + n.y * away.y + n.z * away.z > 0;
    return behind != lom_is_mirroring(&entity->at->world_from_model);
}

/* Triangles of an entity and where they are seen from. */
struct looking {
    const struct lom_drawn_entity *entity;
    const struct lom_order *order;
};

static void find_distances(void *context, size_t first, size_t end)
{
    const struct looking *l = context;
    const struct lom_transparent *t = &l->entity->transparent;
    const uint32_t backs = l->entity->backs != NULL ? (uint32_t)(l->entity->backs - l->entity->materials) : 0;
    for (size_t i = first; i < end; i++) {
        const struct lom_listed_triangle *listed = &t->listed[i];
        const uint32_t *index = l->entity->source->mesh->indices + listed->number;
        const uint32_t material = shows_back(l->entity, index, l->order) ? listed->part + backs : listed->part;
        t->triangles[i] =
            (struct lom_distant){ listed->number, material, lom_distance_of(l->order, find_middle(l->entity, index)) };
    }
}

static void take_indices(void *context, size_t first, size_t end)
{
    const struct looking *l = context;
    const struct lom_transparent *t = &l->entity->transparent;
    for (size_t i = first; i < end; i++)
        memcpy(t->indices + 3 * i, l->entity->source->mesh->indices + t->sorted[i].number, 3 * sizeof(uint32_t));
}

static bool are_same(lom_vec3 a, lom_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool is_ordered(const struct lom_transparent *t, const struct lom_order *order, const lom_mat4 *place)
{
    return t->sorted != NULL && t->seen_from.parallel == order->parallel && are_same(t->seen_from.eye, order->eye) &&
           (!order->parallel || are_same(t->seen_from.ahead, order->ahead)) &&
           memcmp(&t->place, place, sizeof *place) == 0;
}

const struct lom_distant *lom_order_triangles(lom_device *device, struct lom_drawn_entity *entity,
                                              const struct lom_order *order)
{
    struct lom_transparent *t = &entity->transparent;
    struct looking looking = { entity, order };
    if (is_ordered(t, order, &entity->at->world_from_model))
        return t->sorted;
    lom_share_work(device, t->count, PIECE, find_distances, &looking);
    t->sorted = lom_sort_distant(device, t->triangles, t->count);
    lom_share_work(device, t->count, PIECE, take_indices, &looking);
    t->seen_from = *order;
    t->place = entity->at->world_from_model;
    return t->sorted;
}
