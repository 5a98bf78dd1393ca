/* The meshes of a pass. In: its triangles, told twice: to measure, then to draw. Out: the largest meshes, each in a cell of
 * one picture, in its own space, seen from above and aside. Invariant: places are the attributes that the vertex stage
 * reads; of a shader that makes them from the vertex's number, what it names "offset". */
#include "inspect/steps_mesh.h"

#include "base/numbers.h"
#include "base/reserve.h"

#include <stdio.h>

enum { PLACE = 3 };

static bool read_place(const lom_attribute *a, uint32_t index, double place[PLACE])
{
    int count = a->kind == LOM_ATTRIBUTE_FLOAT2 ? 2 : 3;
    size_t at = index * a->stride, size = (size_t)count * sizeof(float);
    float value[PLACE] = { 0, 0, 0 };
    if (at > a->size || a->size - at < size)
        return false;
    memcpy(value, (const char *)a->data + at, size);
    for (int i = 0; i < PLACE; i++)
        place[i] = (double)value[i];
    return true;
}

static bool find_offset(const lom_vertex_record *vertex, double place[PLACE])
{
    for (const lom_note_record *n = vertex->notes; n != NULL; n = n->next)
        if (n->kind == LOM_NOTE_VALUE && n->components == PLACE && strcmp(n->name, "offset") == 0) {
            for (int i = 0; i < PLACE; i++)
                place[i] = (double)n->value[i];
            return true;
        }
    return false;
}

static bool find_places(struct meshes *m, const lom_told_triangle *t, double place[3][PLACE])
{
    const lom_attribute *a = &t->desc->attribute[0];
    lom_vertex_record vertex[3];
    bool reads =
        t->desc->shader->attributes > 0 && a->data != NULL && a->stride != 0 &&
        (a->kind == LOM_ATTRIBUTE_FLOAT2 || a->kind == LOM_ATTRIBUTE_FLOAT3 || a->kind == LOM_ATTRIBUTE_FLOAT4);
    bool done = true;
    if (!reads && !lom_tell_vertices(t, vertex)) {
        m->failed = true;
        return false;
    }
    for (int k = 0; k < 3; k++)
        done = done && (reads ? read_place(a, t->index[k], place[k]) : find_offset(&vertex[k], place[k]));
    return done;
}

/* ---- which mesh ---- */

static int find_mesh(struct meshes *m, const lom_draw_desc *desc)
{
    const void *data = desc->attribute[0].data;
    for (int i = 0; i < m->count; i++)
        if (desc->label != NULL && m->mesh[i].label != NULL
                ? strcmp(m->mesh[i].label, desc->label) == 0
                : m->mesh[i].data == data && m->mesh[i].label == desc->label)
            return i;
    if (m->count == MOST_MESHES)
        return -1;
    m->mesh[m->count] = (struct seen_mesh){ .label = desc->label, .data = data, .cell = -1 };
    return m->count++;
}

static int choose_mesh(struct meshes *m, const lom_draw_desc *desc)
{
    for (size_t i = 0; i < m->draw_count; i++) {
        const struct seen_draw *d = &m->draws[i];
        if (d->data == desc->attribute[0].data && d->indices == desc->indices && d->first == desc->first &&
            d->count == desc->count)
            return -1;
    }
    return find_mesh(m, desc);
}

/* The mesh of a draw, which is added when its first triangle comes; NULL: seen before, or one too many. */
static struct seen_mesh *mesh_of(struct meshes *m, const lom_told_triangle *t)
{
    while (m->draw_count <= t->draw) {
        const lom_draw_desc *desc = t->desc;
        if (!lom_reserve(&m->draws, &m->draw_capacity, m->draw_count + 1, sizeof *m->draws, NULL)) {
            m->failed = true;
            return NULL;
        }
        bool own = m->draw_count == t->draw; /* those before have no triangles that were told */
        int mesh = own ? choose_mesh(m, desc) : -1;
        m->draws[m->draw_count++] =
            own ? (struct seen_draw){ desc->attribute[0].data, desc->indices, desc->first, desc->count, mesh }
                : (struct seen_draw){ .mesh = -1, .first = SIZE_MAX };
    }
    int mesh = t->instance == 0 ? m->draws[t->draw].mesh : -1;
    return mesh >= 0 ? &m->mesh[mesh] : NULL;
}

/* Every so many triangles one: when there is no more room, every second is dropped. */
static void take_sample(struct seen_mesh *mesh, const double place[PLACE])
{
    if (mesh->samples == MESH_SAMPLES) {
        for (int i = 0; i < MESH_SAMPLES; i++)
            for (int axis = 0; axis < PLACE; axis++)
                mesh->sample[axis][i / 2] = mesh->sample[axis][i];
        mesh->samples /= 2;
        mesh->skip = 2 * mesh->skip + 1;
    }
    if ((mesh->triangles & mesh->skip) == 0) {
        for (int axis = 0; axis < PLACE; axis++)
            mesh->sample[axis][mesh->samples] = place[axis];
        mesh->samples++;
    }
}

/* Of a mesh that reaches far with few triangles, like a sea to the horizon, the part that has nine tenths of them. */
static void trim(struct seen_mesh *mesh)
{
    for (int axis = 0; axis < PLACE && mesh->samples >= 40; axis++) {
        double *v = mesh->sample[axis];
        for (int i = 1; i < mesh->samples; i++) /* by insertion */
            for (int k = i; k > 0 && v[k] < v[k - 1]; k--) {
                double swap = v[k];
                v[k] = v[k - 1];
                v[k - 1] = swap;
            }
        double low = v[mesh->samples / 20], high = v[mesh->samples - 1 - mesh->samples / 20];
        if (mesh->high[axis] - mesh->low[axis] > 6 * (high - low)) {
            mesh->low[axis] = low;
            mesh->high[axis] = high;
        }
    }
}

void lom_measure_mesh(struct meshes *m, const lom_told_triangle *t)
{
    double place[3][PLACE];
    struct seen_mesh *mesh = t->made ? NULL : mesh_of(m, t);
    if (mesh == NULL || !find_places(m, t, place))
        return;
    m->primitives.of[t->corners - 1]++;
    take_sample(mesh, place[0]);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < PLACE; i++) {
            bool first = mesh->triangles == 0 && k == 0;
            mesh->low[i] = first || place[k][i] < mesh->low[i] ? place[k][i] : mesh->low[i];
            mesh->high[i] = first || place[k][i] > mesh->high[i] ? place[k][i] : mesh->high[i];
        }
    mesh->triangles++;
}

/* ---- cells ---- */

bool lom_lay_cells(struct meshes *m, const struct canvas *like, lom_error *error)
{
    static const struct ink ground = { { 0.055f, 0.065f, 0.085f }, 1 };
    for (m->cells = 0; m->cells < MOST_CELLS; m->cells++) {
        struct seen_mesh *most = NULL;
        for (int i = 0; i < m->count; i++)
            if (m->mesh[i].cell < 0 && m->mesh[i].triangles > 0 &&
                (most == NULL || m->mesh[i].triangles > most->triangles))
                most = &m->mesh[i];
        if (most == NULL)
            break;
        most->cell = m->cells;
        trim(most);
    }
    m->columns = m->cells > 4 ? 3 : m->cells > 1 ? 2 : 1;
    m->rows = m->cells > 2 ? 2 : 1;
    return lom_make_canvas(&m->canvas, like->width, like->height, ground, error);
}

/* Right, down and towards the eye, of a direction: turned by 35 degrees, seen from 28 degrees above. */
static void turn(const double p[PLACE], double seen[PLACE])
{
    const double cosine = 0.8191520442889918, sine = 0.573576436351046, cosine_up = 0.882947592858927,
                 sine_up = 0.4694715627858908;
    double forth = -p[0] * sine + p[2] * cosine;
    seen[0] = p[0] * cosine + p[2] * sine;
    seen[1] = -p[1] * cosine_up + forth * sine_up;
    seen[2] = p[1] * sine_up + forth * cosine_up;
}

struct cell {
    double scale, shift[2], area;
};

/* So that the box of the mesh fits. */
static struct cell find_cell(const struct meshes *m, const struct seen_mesh *mesh)
{
    double low[2] = { 0, 0 }, high[2] = { 0, 0 };
    const int size[2] = { m->canvas.width / m->columns, m->canvas.height / m->rows };
    const int at[2] = { mesh->cell % m->columns * size[0], mesh->cell / m->columns * size[1] };
    for (int i = 0; i < 8; i++) {
        const double corner[PLACE] = { i & 1 ? mesh->high[0] : mesh->low[0], i & 2 ? mesh->high[1] : mesh->low[1],
                                       i & 4 ? mesh->high[2] : mesh->low[2] };
        double seen[PLACE];
        turn(corner, seen);
        for (int k = 0; k < 2; k++) {
            low[k] = i == 0 || seen[k] < low[k] ? seen[k] : low[k];
            high[k] = i == 0 || seen[k] > high[k] ? seen[k] : high[k];
        }
    }
    double across = lom_larger(high[0] - low[0], 1e-9), down = lom_larger(high[1] - low[1], 1e-9);
    struct cell c = { .scale = 0.86 * lom_smaller(size[0] / across, size[1] / down) };
    for (int k = 0; k < 2; k++)
        c.shift[k] = at[k] + size[k] * 0.5 - (low[k] + high[k]) * 0.5 * c.scale;
    c.area = across * down * c.scale * c.scale;
    return c;
}

/* Bright where it faces the light, and dim where it is turned away from the eye, unless the mesh is a sheet that a shader
 * makes; of many small triangles each is faint. */
static struct ink ink_of(const double seen[3][PLACE], double area, const struct seen_mesh *mesh)
{
    double u[PLACE], v[PLACE];
    for (int i = 0; i < PLACE; i++) {
        u[i] = seen[1][i] - seen[0][i];
        v[i] = seen[2][i] - seen[0][i];
    }
    double n[PLACE] = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
    double length = lom_double_sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double light = length > 0 ? (-n[0] * 0.55 + n[1] * 0.65 - n[2] * 0.52) / length : 0;
    double each = lom_double_sqrt(area / (double)mesh->triangles), bright = 0.38 + 0.62 * lom_larger(light, 0);
    double turned = n[2] < 0 || mesh->data == NULL ? 1 : lom_smaller(0.2 + each / 200, 0.8);
    double cover = lom_smaller(0.16 + each / 14, 0.9) * turned;
    return (struct ink){ { (float)(0.62 * bright), (float)(0.88 * bright), (float)bright }, (float)cover };
}

void lom_draw_meshes(struct meshes *m, const lom_told_triangle *t)
{
    const struct seen_mesh *mesh = t->made ? NULL : mesh_of(m, t);
    double place[3][PLACE], seen[3][PLACE];
    if (mesh == NULL || mesh->cell < 0 || !find_places(m, t, place))
        return;
    struct cell cell = find_cell(m, mesh);
    for (int k = 0; k < 3; k++) {
        turn(place[k], seen[k]);
        for (int i = 0; i < 2; i++)
            seen[k][i] = seen[k][i] * cell.scale + cell.shift[i];
        seen[k][2] *= cell.scale;
    }
    struct ink ink = ink_of((const double(*)[PLACE])seen, cell.area, mesh);
    if (t->corners < 3)
        ink.cover = 0.8f;
    if (t->corners == 1)
        lom_draw_dot(&m->canvas, seen[0], 1.5, ink);
    for (int k = 0; k < (t->corners == 3 ? 3 : t->corners - 1); k++)
        lom_draw_line(&m->canvas, seen[k], seen[(k + 1) % 3], ink);
}

static const char *file_of(const char *label)
{
    const char *slash = label != NULL ? strrchr(label, '/') : NULL;
    return slash != NULL ? slash + 1 : label != NULL ? label : "a mesh without a name";
}

void lom_picture_mesh(struct steps *s, struct meshes *m)
{
    char names[300] = "", all[MAX_COUNTED];
    for (int cell = 0; cell < m->cells; cell++)
        for (int i = 0; i < m->count; i++) {
            size_t length = strlen(names);
            if (m->mesh[i].cell == cell)
                snprintf(names + length, sizeof names - length, "%s%s (%llu)", cell > 0 ? ", " : "",
                         file_of(m->mesh[i].label), (unsigned long long)m->mesh[i].triangles);
        }
    lom_add_picture(
        s, "Triangles", "mesh", "Meshes", "src/pipeline/chunk.c", lom_canvas_image(&m->canvas, s->error),
        "What the vertex stage reads: each mesh in its own space, with its primitives, row by row: %s. In all "
        "%d%s, with %s; nothing has a place in the picture yet.",
        names, m->count, m->count == MOST_MESHES ? " or more" : "", lom_say_counted(&m->primitives, all));
}

void lom_clear_meshes(struct meshes *m)
{
    lom_clear_canvas(&m->canvas);
    lom_release(m->draws);
}
