/* The mesh of a displaced surface. In: the whole frame's camera, the bounds of the waves, a quad. Out: radii,
 * directions and triangles. A function of the whole frame alone, never of a crop.
 *
 * With h the eye's height and d the distance to a ring, vertices a cell apart on the screen are cell d apart on the
 * ring. Between rings they are as far, times 1 + (d / flattened)^2: at that distance waves are a pixel high, and
 * beyond it only their shading shows.
 *
 * The quad is covered exactly: a column is the part of its ray that lies in the quad, whose rings beyond its ends are
 * at them, and one column goes through each corner, so an edge of the quad is one of the mesh, however far apart rings
 * are. */
#include "base/numbers.h"
#include "water/surface.h"

enum { MAX_RINGS = 4096, MAX_COLUMNS = 8192, MAX_VERTICES = 3000000, CORNERS = 4 };

/* The directions of the view's corners in the plane, as angles about the middle one; whether the view reaches straight
 * up or down, where every direction is seen. */
struct sector {
    bool whole;
    double middle, half;
    double forward[2];
};

static struct sector find_sector(const struct lom_polar_mesh_desc *desc)
{
    static const double corners[4][2] = { { -1, -1 }, { 1, -1 }, { -1, 1 }, { 1, 1 } };
    const double(*v)[4] = desc->view.m;
    struct sector s = { .forward = { -v[2][0], -v[2][2] } };
    double flat = lom_double_sqrt(s.forward[0] * s.forward[0] + s.forward[1] * s.forward[1]);
    s.middle = lom_double_atan2(s.forward[1], s.forward[0]);
    s.whole = flat < 0.2;
    for (int i = 0; i < 4 && !s.whole; i++) {
        double ray[3] = { corners[i][0] / desc->projection.m[0][0], corners[i][1] / desc->projection.m[1][1], -1 };
        double x = v[0][0] * ray[0] + v[1][0] * ray[1] + v[2][0] * ray[2];
        double z = v[0][2] * ray[0] + v[1][2] * ray[1] + v[2][2] * ray[2];
        double along = (x * s.forward[0] + z * s.forward[1]) / flat;
        double across = (z * s.forward[0] - x * s.forward[1]) / flat;
        double angle = lom_double_atan2(across, along);
        s.half = lom_larger(s.half, angle < 0 ? -angle : angle);
    }
    s.half += 0.02;
    s.whole |= s.half > 1.4;
    s.forward[0] /= lom_larger(flat, 1e-9);
    s.forward[1] /= lom_larger(flat, 1e-9);
    return s;
}

/* The rectangle of the plane that holds all of the slab of the waves which parallel rays of the picture see, within the
 * quad. Where a ray enters the slab is linear over the picture until it is cut to where rays are: the rays of the
 * corners and, when one is cut, their ends hold it. */
static void find_footprint(const struct lom_polar_mesh_desc *desc, const lom_view_rays *rays, double low[2],
                           double high[2])
{
    const double(*p)[4] = desc->projection.m, far = p[2][3] / p[2][2];
    const lom_vec3 d = rays->along;
    bool is_cut = false;
    for (int a = 0; a < 2; a++) {
        low[a] = 1e300;
        high[a] = -1e300;
    }
    for (int i = 0; i < 16; i++) {
        const double x = i & 1 ? 1 : -1, y = i & 2 ? 1 : -1;
        const double from[3] = { rays->row[0][0] * x + rays->row[0][1] * y + rays->row[0][2],
                                 rays->row[1][0] * x + rays->row[1][1] * y + rays->row[1][2],
                                 rays->row[2][0] * x + rays->row[2][1] * y + rays->row[2][2] };
        double t = i & 4 ? far : 0;
        if (i < 8) {
            const double to = desc->level + (i & 4 ? desc->highest : desc->lowest) - from[1];
            t = lom_magnitude(d.y) > 1e-9 ? to / d.y : far;
            is_cut = is_cut || t < 0 || t >= far;
            t = t < 0 ? 0 : t < far ? t : far;
        } else if (!is_cut) {
            break;
        }
        const double at[2] = { from[0] + d.x * t, from[2] + d.z * t };
        for (int a = 0; a < 2; a++) {
            low[a] = at[a] < low[a] ? at[a] : low[a];
            high[a] = at[a] > high[a] ? at[a] : high[a];
        }
    }
    for (int a = 0; a < 2; a++) {
        low[a] = lom_larger(low[a] - desc->reach, desc->quad[a]);
        high[a] = lom_smaller(high[a] + desc->reach, desc->quad[2 + a]);
    }
}

struct spacing {
    double cell, height, flattened, back, far;
    double round; /* radius at which columns are a cell apart */
};

static double step_at(const struct spacing *s, double radius)
{
    double beyond = radius > s->back ? radius - s->back : 0;
    double d = lom_double_sqrt(beyond * beyond + s->height * s->height);
    double share = d / s->flattened;
    return s->cell * d * (1 + share * share);
}

static int count_rings(const struct spacing *s)
{
    double radius = 0;
    int rings = 1;
    while (radius < s->far && rings <= MAX_RINGS) {
        radius += step_at(s, radius);
        rings++;
    }
    return rings;
}

/* The distance from the apex to the far corner of the quad. */
static double far_corner(const double apex[2], const double quad[4])
{
    double x = lom_larger(quad[2] - apex[0], apex[0] - quad[0]), z = lom_larger(quad[3] - apex[1], apex[1] - quad[1]);
    return lom_double_sqrt(x * x + z * z);
}

/* The triangles of a strip between two rings depend on the number of columns alone: those that are there stay. */
static bool index_mesh(struct lom_polar_mesh *mesh, lom_error *error)
{
    size_t needed = (size_t)(mesh->rings - 1) * (size_t)(mesh->columns - 1) * 6;
    if (mesh->indexed_columns != mesh->columns)
        mesh->indexed_rings = 0;
    if (needed > mesh->index_capacity) {
        size_t capacity = needed + needed / 16; /* waves of another moment may need some more */
        lom_release(mesh->indices);
        mesh->index_capacity = 0;
        mesh->indexed_rings = 0;
        mesh->indices = lom_allocate(capacity, sizeof *mesh->indices, error);
        if (mesh->indices == NULL)
            return false;
        mesh->index_capacity = capacity;
    }
    int first = mesh->indexed_rings > 0 ? mesh->indexed_rings - 1 : 0;
    uint32_t *to = mesh->indices + (size_t)first * (size_t)(mesh->columns - 1) * 6;
    for (int r = first; r + 1 < mesh->rings; r++)
        for (int c = 0; c + 1 < mesh->columns; c++, to += 6) {
            uint32_t a = (uint32_t)(r * mesh->columns + c), b = a + 1, d = a + (uint32_t)mesh->columns, e = d + 1;
            const uint32_t quad[6] = { a, d, b, b, d, e };
            memcpy(to, quad, sizeof quad);
        }
    mesh->index_count = needed;
    mesh->indexed_rings = mesh->rings > mesh->indexed_rings ? mesh->rings : mesh->indexed_rings;
    mesh->indexed_columns = mesh->columns;
    return true;
}

static bool reserve(struct lom_polar_mesh *mesh, lom_error *error)
{
    size_t needed = 2 * (size_t)mesh->rings + 4 * (size_t)mesh->columns;
    if (needed > mesh->memory_capacity) {
        lom_release(mesh->memory);
        mesh->memory_capacity = 0;
        mesh->memory = lom_allocate(needed, sizeof *mesh->memory, error);
        if (mesh->memory == NULL)
            return false;
        mesh->memory_capacity = needed;
    }
    mesh->radius = mesh->memory;
    mesh->spacing = mesh->radius + mesh->rings;
    mesh->cosine = mesh->spacing + mesh->rings;
    mesh->sine = mesh->cosine + mesh->columns;
    mesh->nearest = mesh->sine + mesh->columns;
    mesh->farthest = mesh->nearest + mesh->columns;
    return true;
}

/* A circle about the footprint, its rings as far apart as the vertices of the outermost one. False: rays are not
 * parallel. */
static bool surround_footprint(struct lom_polar_mesh *mesh, const struct lom_polar_mesh_desc *desc,
                               struct spacing *space)
{
    const lom_view_rays rays = lom_find_view_rays(&desc->projection, &desc->view);
    double low[2], high[2];
    if (!rays.parallel)
        return false;
    find_footprint(desc, &rays, low, high);
    mesh->apex[0] = (low[0] + high[0]) / 2;
    mesh->apex[1] = (low[1] + high[1]) / 2;
    const double x = lom_larger(high[0] - low[0], 0) / 2, z = lom_larger(high[1] - low[1], 0) / 2;
    *space = (struct spacing){ .cell = desc->cell * desc->pixel_angle, .height = 1, .flattened = 1e300, .back = 1e300 };
    space->round = space->far = lom_larger(lom_double_sqrt(x * x + z * z) + desc->reach, 2 * space->cell);
    return true;
}

/* Rings about a point behind the eye by so much that the sector holds everything that waves can move into the view. */
static void surround_eye(struct lom_polar_mesh *mesh, const struct lom_polar_mesh_desc *desc, const struct sector *s,
                         struct spacing *space)
{
    double wave = lom_larger(desc->highest, -desc->lowest), height = -desc->level, near = desc->near_plane;
    *space = (struct spacing){ .cell = desc->cell * desc->pixel_angle,
                               .height = lom_larger(lom_larger(height < 0 ? -height : height, 0.3 * wave), 2 * near),
                               .flattened = lom_larger(wave, 0.01 * near) / desc->pixel_angle,
                               .round = 1 };
    space->back = s->whole ? 0 : (desc->reach + wave + 5 * near) / lom_double_sin(s->half);
    mesh->apex[0] = -space->back * s->forward[0];
    mesh->apex[1] = -space->back * s->forward[1];
    space->far = far_corner(mesh->apex, desc->quad);
}

/* Angles of the quad's corners about the middle direction, ascending; those outside the sector are at its ends. */
static void find_corners(double out[CORNERS], const struct lom_polar_mesh *mesh, const struct lom_polar_mesh_desc *desc,
                         double middle, double sector)
{
    for (int i = 0; i < CORNERS; i++) {
        double x = desc->quad[i & 1 ? 2 : 0] - mesh->apex[0], z = desc->quad[i & 2 ? 3 : 1] - mesh->apex[1];
        double turns = (lom_double_atan2(z, x) - middle) / lom_two_pi;
        double angle = (turns - lom_double_floor(turns + 0.5)) * lom_two_pi;
        angle = angle < -sector / 2 ? -sector / 2 : angle > sector / 2 ? sector / 2 : angle;
        int at = i;
        for (; at > 0 && out[at - 1] > angle; at--)
            out[at] = out[at - 1];
        out[at] = angle;
    }
}

/* The part of the ray from the apex along (cosine, sine) that lies in the quad; one point of a ray that misses it. */
static void cut_column(struct lom_polar_mesh *mesh, const double quad[4], int column, double cosine, double sine)
{
    const double along[2] = { cosine, sine };
    double from = 0, to = 1e30;
    for (int i = 0; i < 2; i++) {
        double low = quad[i] - mesh->apex[i], high = quad[2 + i] - mesh->apex[i], d = along[i];
        if (!(d > 1e-12 || d < -1e-12))
            continue;
        from = lom_larger(from, d > 0 ? low / d : high / d);
        double end = d > 0 ? high / d : low / d;
        to = end < to ? end : to;
    }
    if (from > to)
        from = to = lom_larger(0, (from + to) / 2);
    mesh->nearest[column] = (float)from;
    mesh->farthest[column] = (float)to;
}

/* `steps` + 1 columns evenly through the sector, and between them one for each corner. */
static void fill_columns(struct lom_polar_mesh *mesh, const struct lom_polar_mesh_desc *desc, const struct sector *s,
                         int steps)
{
    double sector = s->whole ? lom_two_pi : 2 * s->half, corners[CORNERS];
    find_corners(corners, mesh, desc, s->middle, sector);
    for (int c = 0, even = 0, corner = 0; c < mesh->columns; c++) {
        double angle = sector * ((double)even / steps - 0.5);
        if (corner < CORNERS && (even > steps || corners[corner] < angle))
            angle = corners[corner++];
        else
            even++;
        double cosine = lom_double_cos(s->middle + angle), sine = lom_double_sin(s->middle + angle);
        bool seam = s->whole && c == mesh->columns - 1; /* the last column of a full circle is the first */
        mesh->cosine[c] = seam ? mesh->cosine[0] : (float)cosine;
        mesh->sine[c] = seam ? mesh->sine[0] : (float)sine;
        cut_column(mesh, desc->quad, c, cosine, sine);
        mesh->nearest[c] = seam ? mesh->nearest[0] : mesh->nearest[c];
        mesh->farthest[c] = seam ? mesh->farthest[0] : mesh->farthest[c];
    }
}

bool lom_fill_polar_mesh(struct lom_polar_mesh *mesh, const struct lom_polar_mesh_desc *desc, lom_error *error)
{
    struct sector s = find_sector(desc);
    struct spacing space;
    if (surround_footprint(mesh, desc, &space))
        s.whole = true;
    else
        surround_eye(mesh, desc, &s, &space);
    double sector = s.whole ? lom_two_pi : 2 * s.half;
    int steps;
    for (;; space.cell *= 1.25) {
        mesh->rings = count_rings(&space);
        double columns = sector * space.round / space.cell;
        steps = 1 + lom_int_of(columns < MAX_COLUMNS ? columns : MAX_COLUMNS);
        mesh->columns = steps + 1 + CORNERS;
        if (mesh->rings <= MAX_RINGS && mesh->columns <= MAX_COLUMNS && mesh->rings * mesh->columns <= MAX_VERTICES)
            break;
    }
    if (!reserve(mesh, error) || !index_mesh(mesh, error))
        return false;
    double radius = 0;
    for (int r = 0; r < mesh->rings; r++) {
        double step = step_at(&space, radius);
        mesh->radius[r] = (float)radius;
        mesh->spacing[r] = (float)step;
        radius += step;
    }
    fill_columns(mesh, desc, &s, steps);
    return true;
}

/* The points of a disc about the apex, moved by waves as far as they can, lie on the outer side of a plane where the
 * farthest of them does, by more than floats round (lom_box_visibility). */
static bool is_outside(const lom_frustum *frustum, int plane, const struct lom_polar_mesh *mesh,
                       const struct lom_polar_mesh_desc *desc, double radius)
{
    const double *p = frustum->plane[plane], *rounds = frustum->reach[plane];
    const double low = desc->level + desc->lowest, high = desc->level + desc->highest;
    double flat = lom_double_sqrt(p[0] * p[0] + p[2] * p[2]);
    double farthest = p[3] + p[0] * mesh->apex[0] + p[2] * mesh->apex[1] + lom_larger(p[1] * low, p[1] * high);
    double size = rounds[3] + rounds[1] * lom_larger(lom_magnitude(low), lom_magnitude(high));
    for (int i = 0; i < 2; i++)
        size += rounds[2 * i] * (lom_magnitude(mesh->apex[i]) + radius + desc->reach);
    return farthest + flat * (radius + desc->reach) < -0x1p-20 * size;
}

int lom_first_seen_ring(const struct lom_polar_mesh *mesh, const struct lom_polar_mesh_desc *desc,
                        const lom_frustum *frustum)
{
    int first = 0;
    for (int c = 0; c < mesh->columns; c++)
        if (mesh->nearest[c] > 0)
            return 0; /* vertices of inner rings stand at the edge of the quad */
    for (int plane = 0; plane < frustum->count; plane++)
        while (first + 1 < mesh->rings && is_outside(frustum, plane, mesh, desc, (double)mesh->radius[first + 1]))
            first++;
    return first;
}

void lom_free_polar_mesh(struct lom_polar_mesh *mesh)
{
    lom_release(mesh->memory);
    lom_release(mesh->indices);
    *mesh = (struct lom_polar_mesh){ .rings = 0 };
}
