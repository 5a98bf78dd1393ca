/* Liquids for rays. In: the scene's [[fluid]] tables, a time. Out: where rays go in and out, and what light loses that
 * goes straight through them. Invariant: the surface is the one that is drawn, so that an error against the reference is
 * that of its light. */
#include "reference/liquids.h"

#include "base/numbers.h"
#include "world/liquid.h"

/* ---- making ---- */

static struct lom_ray_material material_of(const lom_fluid_params *p)
{
    const lom_vec3 highlight = { p->highlight, p->highlight, p->highlight };
    return (struct lom_ray_material){ .ambient = vector(p->color),
                                      .diffuse = vector(p->color),
                                      .specular = highlight,
                                      .shininess = p->shininess,
                                      .picture = LOM_NO_PICTURE,
                                      .emissive_map = LOM_NO_PICTURE,
                                      .specular_map = LOM_NO_PICTURE,
                                      .gloss_map = LOM_NO_PICTURE,
                                      .normal_map = LOM_NO_PICTURE,
                                      .opacity = 1 };
}

static bool add_surface(struct lom_ray_liquid *it, const lom_mesh *mesh, lom_error *error)
{
    const double *low = it->params->low;
    const size_t count = mesh->index_count / 3;
    it->points = lom_allocate(mesh->vertex_count, sizeof *it->points, error);
    it->normals = lom_allocate(mesh->vertex_count, sizeof *it->normals, error);
    it->triangles = lom_allocate(count, sizeof *it->triangles, error);
    if (it->points == NULL || it->normals == NULL || it->triangles == NULL)
        return false;
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        const float *p = mesh->vertices[i].position, *n = mesh->vertices[i].normal;
        it->points[i] = (lom_vec3){ (double)p[0] + low[0], (double)p[1] + low[1], (double)p[2] + low[2] };
        it->normals[i] = (lom_vec3){ (double)n[0], (double)n[1], (double)n[2] };
    }
    for (size_t i = 0; i < count; i++)
        for (int corner = 0; corner < 3; corner++)
            it->triangles[i].corner[corner] = mesh->indices[3 * i + (size_t)corner];
    it->front =
        (struct lom_ray_triangles){ .points = it->points, .triangles = it->triangles, .count = (uint32_t)count };
    if (count > 0 && !lom_build_ray_triangles(&it->front, error))
        return false;
    it->back = it->front;
    it->back.inside_out = true;
    return true;
}

static bool add_liquid(struct lom_ray_liquids *liquids, const lom_reference *reference, size_t number, double time,
                       lom_device *device, lom_error *error)
{
    struct lom_liquid state = { .fluid = NULL };
    struct lom_ray_liquid *it = &liquids->items[liquids->count++];
    it->params = &reference->world->scene->fluids[number];
    it->material = material_of(it->params);
    it->gap = it->params->spacing;
    const bool done =
        lom_run_liquid(&state, reference->world, number, device, time, error) && add_surface(it, state.mesh, error);
    lom_free_liquid(&state);
    return done;
}

bool lom_make_ray_liquids(struct lom_ray_liquids *liquids, const lom_reference *reference, double time, int threads,
                          lom_error *error)
{
    const lom_scene *scene = reference->world->scene;
    *liquids = (struct lom_ray_liquids){ .count = 0 };
    if (!scene->quality.fluid || scene->fluid_count == 0)
        return true;
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = threads });
    if (device == NULL)
        return lom_fail(error, LOM_ERROR_MEMORY, "There is no memory for the reference's liquids.");
    bool done = true;
    for (size_t i = 0; done && i < scene->fluid_count; i++)
        done = !lom_shows_liquid(scene, i) || add_liquid(liquids, reference, i, time, device, error);
    lom_close_device(device);
    return done;
}

void lom_free_ray_liquids(struct lom_ray_liquids *liquids)
{
    for (size_t i = 0; i < liquids->count; i++) {
        struct lom_ray_liquid *it = &liquids->items[i];
        lom_free_ray_triangles(&it->front);
        lom_release(it->points);
        lom_release(it->normals);
        lom_release(it->triangles);
    }
}

/* ---- rays ---- */

static bool hit(const struct lom_ray_triangles *set, const struct lom_ray *ray, double low, struct lom_ray_hit *found)
{
    return set->count > 0 && lom_hit_triangles(set, ray, low, found);
}

/* A normal that is turned away from the side that is seen is bent until that is seen edge-on. */
static lom_vec3 seen_normal(lom_vec3 normal, lom_vec3 to_eye)
{
    const double seen = dot(normal, to_eye), least = 1e-3;
    return seen >= least ? normal : unit(along(normal, to_eye, least - seen));
}

const struct lom_ray_liquid *lom_cross_liquid(const struct lom_ray_liquids *liquids, const struct lom_ray *ray,
                                              const struct lom_ray_liquid *inside, double low, double high,
                                              struct lom_liquid_crossing *crossing)
{
    const struct lom_ray_liquid *met = NULL;
    struct lom_ray_hit found = { .t = high };
    for (size_t i = 0; liquids != NULL && i < liquids->count; i++) {
        const struct lom_ray_liquid *it = &liquids->items[i];
        if ((inside == NULL || inside == it) && hit(inside != NULL ? &it->back : &it->front, ray, low, &found))
            met = it;
    }
    if (met == NULL)
        return NULL;
    const uint32_t *corner = met->triangles[found.triangle].corner;
    const lom_vec3 *p = met->points, *n = met->normals;
    const lom_vec3 a = difference(p[corner[1]], p[corner[0]]), b = difference(p[corner[2]], p[corner[0]]);
    const double side = inside != NULL ? -1 : 1;
    const lom_vec3 smooth = unit(blended(n[corner[0]], n[corner[1]], n[corner[2]], found.weight));
    crossing->t = found.t;
    crossing->place = along(ray->origin, ray->direction, found.t);
    crossing->facet = unit(cross(a, b));
    crossing->normal = scaled(seen_normal(scaled(smooth, side), scaled(ray->direction, -1)), side);
    return met;
}

/* From surface to surface: metres within one liquid up to `far`. */
static double way_through(const struct lom_ray_liquid *it, const struct lom_ray *ray, double far)
{
    double way = 0, entered = 0, low = 0;
    bool inside = true; /* until a surface that faces the place is met first */
    for (bool first = true;; first = false) {
        struct lom_ray_hit found = { .t = far };
        const bool front = hit(&it->front, ray, low, &found), back = hit(&it->back, ray, low, &found);
        if (!front && !back)
            return way + (inside && !first && far < 1e299 ? far - entered : 0);
        if (back && inside)
            way += found.t - entered;
        if (!back)
            entered = found.t;
        inside = !back;
        low = found.t;
    }
}

lom_vec3 lom_liquids_leave(const lom_reference *reference, lom_vec3 place, lom_vec3 direction, double far)
{
    const struct lom_ray ray = { place, direction };
    lom_vec3 left = { 1, 1, 1 };
    for (size_t i = 0; reference->liquids != NULL && i < reference->liquids->count; i++) {
        const struct lom_ray_liquid *it = &reference->liquids->items[i];
        left = product(left, lom_transmitted(it->params->absorption, way_through(it, &ray, far)));
    }
    return left;
}
