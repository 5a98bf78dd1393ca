/* Volumes of density: made from voxels, met by rays, and integrated along them. In: an image, rays. Out: extinction and
 * optical depths. */
#include "base/numbers.h"
#include "reference/volume.h"

#include "base/own_float_state.h"

#include <string.h>

/* ---- making ---- */

static float read_voxel(const lom_image *image, size_t i)
{
    if (image->format == LOM_FORMAT_R8)
        return image->pixels[i] / 255.0f;
    if (image->format == LOM_FORMAT_R16) {
        uint16_t value;
        memcpy(&value, image->pixels + 2 * i, sizeof value);
        return value / 65535.0f;
    }
    float value;
    memcpy(&value, image->pixels + 4 * i, sizeof value);
    return value > 0 ? value : 0;
}

static bool check_volume(const lom_reference_volume_desc *d, lom_error *error)
{
    const lom_image *image = d != NULL ? d->density : NULL;
    if (image == NULL)
        return lom_fail(error, LOM_ERROR_USAGE, "A volume of the reference has a density.");
    double x = d->high.x - d->low.x, y = d->high.y - d->low.y, z = d->high.z - d->low.z;
    if (image->format != LOM_FORMAT_R8 && image->format != LOM_FORMAT_R16 && image->format != LOM_FORMAT_R32F)
        return lom_fail(error, LOM_ERROR_USAGE, "A volume's density is one channel of 8 or 16 bits or floats.");
    if (!(x > 0 && y > 0 && z > 0) || !(x + y + z < __builtin_inf()))
        return lom_fail(error, LOM_ERROR_USAGE, "A volume's box of %g x %g x %g m has no extent.", x, y, z);
    bool good = d->extinction >= 0 && d->extinction < __builtin_inf();
    const lom_image *n = d->detail;
    good = good && (n == NULL || (n->format == LOM_FORMAT_R8 && n->width == n->height && n->width == n->depth &&
                                  d->detail_size > 0 && d->detail_strength >= 0 && d->detail_strength < 1));
    for (int i = 0; i < 3; i++)
        good = good && d->albedo[i] >= 0 && d->albedo[i] <= 1;
    if (!good)
        return lom_fail(
            error, LOM_ERROR_USAGE,
            "A volume's extinction is finite and not negative, its albedo lies in 0 to 1, and its detail is an R8 "
            "cube of some size whose strength lies in 0 to 1.");
    return lom_check_transfer_points(d->transfer, d->transfer_count, error);
}

static bool copy_detail(lom_reference_volume *v, const lom_reference_volume_desc *d, lom_error *error)
{
    if (d->detail == NULL || d->detail_strength == 0)
        return true;
    const size_t count = lom_image_size(d->detail);
    v->detail = lom_allocate(count, sizeof *v->detail, error);
    for (size_t i = 0; v->detail != NULL && i < count; i++)
        v->detail[i] = read_voxel(d->detail, i);
    v->detail_side = d->detail->width;
    v->detail_strength = d->detail_strength;
    v->detail_size = d->detail_size;
    return v->detail != NULL;
}

lom_reference_volume *lom_create_reference_volume(const lom_reference_volume_desc *d, lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    if (!check_volume(d, error))
        return NULL;
    lom_reference_volume *v = lom_allocate(1, sizeof *v, error);
    size_t count = (size_t)d->density->width * (size_t)d->density->height * (size_t)d->density->depth;
    if (v != NULL)
        *v = (lom_reference_volume){ .size = { d->density->width, d->density->height, d->density->depth },
                                     .density = lom_allocate(count, sizeof *v->density, error),
                                     .low = { d->low.x, d->low.y, d->low.z },
                                     .high = { d->high.x, d->high.y, d->high.z },
                                     .extinction = d->extinction,
                                     .albedo = { d->albedo[0], d->albedo[1], d->albedo[2] },
                                     .phase = d->phase,
                                     .transfer_count = d->transfer_count,
                                     .look = d->look };
    if (v == NULL || v->density == NULL || !copy_detail(v, d, error)) {
        lom_free_reference_volume(v);
        return NULL;
    }
    double most = 0;
    for (size_t i = 0; i < count; i++) {
        v->density[i] = read_voxel(d->density, i);
        most = lom_larger(v->density[i], most);
    }
    for (size_t i = 0; i < d->transfer_count; i++) {
        v->transfer[i] = d->transfer[i];
        most = lom_larger(i > 0 ? most : 0, d->transfer[i].extinction);
    }
    v->greatest = most * d->extinction;
    for (int i = 0; i < 3; i++)
        v->voxels[i] = v->size[i] / (v->high[i] - v->low[i]);
    return v;
}

void lom_free_reference_volume(lom_reference_volume *volume)
{
    if (volume == NULL)
        return;
    lom_release(volume->density);
    lom_release(volume->detail);
    lom_release(volume);
}

/* ---- meeting it ---- */

bool lom_cross_volume(const lom_reference_volume *v, lom_vec3 origin, lom_vec3 d, double *from, double *to)
{
    const double o[3] = { origin.x, origin.y, origin.z }, direction[3] = { d.x, d.y, d.z };
    for (int i = 0; i < 3; i++) {
        if (direction[i] == 0) { /* 0 x infinity would be none */
            if (!(o[i] >= v->low[i] && o[i] < v->high[i]))
                return false;
            continue;
        }
        double a = (v->low[i] - o[i]) / direction[i], b = (v->high[i] - o[i]) / direction[i];
        *from = lom_larger(a < b ? a : b, *from);
        *to = lom_smaller(a < b ? b : a, *to);
    }
    return *from < *to;
}

/* The voxel below a place along an axis, in units of voxels from the first centre, and the weight of the next. */
static int find_voxel(double at, int size, double *weight)
{
    double place = lom_smaller(lom_larger(at, 0), size - 1);
    int voxel = lom_int_of(place);
    voxel = voxel < size - 1 ? voxel : size - 1;
    *weight = place - voxel;
    return voxel;
}

/* The noise at a place, in repetitions of it. */
static double detail_at(const lom_reference_volume *v, const double place[3])
{
    const size_t side = (size_t)v->detail_side;
    size_t voxel[3][2];
    double w[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        double part = (place[i] - lom_double_floor(place[i])) * v->detail_side;
        voxel[i][0] = (size_t)lom_count_of(part, 2 * (uint64_t)side);
        w[i] = part - (double)voxel[i][0];
        voxel[i][1] = (voxel[i][0] + 1) % side;
        voxel[i][0] %= side;
    }
    for (int corner = 0; corner < 8; corner++) {
        const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        double weight = (x ? w[0] : 1 - w[0]) * (y ? w[1] : 1 - w[1]) * (z ? w[2] : 1 - w[2]);
        sum += weight * (double)v->detail[(voxel[2][z] * side + voxel[1][y]) * side + voxel[0][x]];
    }
    return sum;
}

/* What the noise leaves of a density. */
static double eroded_at(const lom_reference_volume *v, const double at[3], double density)
{
    if (v->detail == NULL || density <= 0)
        return density;
    double place[3];
    for (int i = 0; i < 3; i++)
        place[i] = (at[i] + 0.5) / v->voxels[i] / v->detail_size;
    double eaten = v->detail_strength * detail_at(v, place);
    return lom_smaller(lom_larger((density - eaten) / (1 - eaten), 0), 1);
}

/* Density at a place in units of voxels from the first centre. */
static double density_at(const lom_reference_volume *v, const double at[3])
{
    double w[3];
    size_t x = (size_t)find_voxel(at[0], v->size[0], &w[0]), y = (size_t)find_voxel(at[1], v->size[1], &w[1]),
           z = (size_t)find_voxel(at[2], v->size[2], &w[2]);
    size_t width = (size_t)v->size[0], height = (size_t)v->size[1];
    size_t right = w[0] > 0, up = w[1] > 0 ? width : 0, back = w[2] > 0 ? width * height : 0;
    const float *d = v->density + (z * height + y) * width + x;
    double row[4];
    const size_t offset[4] = { 0, up, back, up + back };
    for (int i = 0; i < 4; i++) {
        double a = d[offset[i]], b = d[offset[i] + right];
        row[i] = a + (b - a) * w[0];
    }
    double front = row[0] + (row[1] - row[0]) * w[1], behind = row[2] + (row[3] - row[2]) * w[1];
    return eroded_at(v, at, front + (behind - front) * w[2]);
}

static void to_voxels(const lom_reference_volume *v, lom_vec3 p, double at[3])
{
    at[0] = (p.x - v->low[0]) * v->voxels[0] - 0.5;
    at[1] = (p.y - v->low[1]) * v->voxels[1] - 0.5;
    at[2] = (p.z - v->low[2]) * v->voxels[2] - 0.5;
}

double lom_volume_density(const lom_reference_volume *v, lom_vec3 place)
{
    double at[3];
    to_voxels(v, place, at);
    return density_at(v, at);
}

double lom_volume_extinction(const lom_reference_volume *v, lom_vec3 place)
{
    return v->extinction * lom_seen_extinction(v, lom_volume_density(v, place));
}

lom_vec3 lom_volume_normal(const lom_reference_volume *v, lom_vec3 place, lom_vec3 d)
{
    double at[3], rise[3];
    to_voxels(v, place, at);
    for (int i = 0; i < 3; i++) {
        double beside[3] = { at[0], at[1], at[2] };
        beside[i] = at[i] - 1;
        double before = density_at(v, beside);
        beside[i] = at[i] + 1;
        rise[i] = (before - density_at(v, beside)) * v->voxels[i];
    }
    lom_vec3 n = lom_vec3_normalize((lom_vec3){ rise[0], rise[1], rise[2] });
    return dot(n, d) > 0 ? scaled(n, -1) : n;
}

/* ---- integrating along it ---- */

/* A ray in units of voxels: place i is start[i] + t step[i]. */
struct walk {
    const lom_reference_volume *volume;
    double start[3], step[3];
    int next[3]; /* the plane of voxels that is crossed next along each axis, counted in the ray's own direction */
};

static double density_on(const struct walk *w, double t)
{
    double at[3];
    for (int i = 0; i < 3; i++)
        at[i] = w->start[i] + t * w->step[i];
    return density_at(w->volume, at);
}

/* Where plane number k (0 .. size - 1, from the side that the ray comes from) is crossed. */
static double crossing(const struct walk *w, int axis, int k)
{
    int plane = w->step[axis] > 0 ? k : w->volume->size[axis] - 1 - k;
    return (plane - w->start[axis]) / w->step[axis];
}

static struct walk begin_walk(const lom_reference_volume *v, lom_vec3 origin, lom_vec3 d, double from)
{
    struct walk w = { .volume = v, .step = { d.x * v->voxels[0], d.y * v->voxels[1], d.z * v->voxels[2] } };
    to_voxels(v, origin, w.start);
    for (int i = 0; i < 3; i++) {
        if (w.step[i] == 0) {
            w.next[i] = v->size[i];
            continue;
        }
        double at = w.start[i] + from * w.step[i], passed = w.step[i] > 0 ? at : v->size[i] - 1 - at;
        w.next[i] = lom_int_of(lom_smaller(lom_larger(passed, 0), v->size[i]));
        while (w.next[i] < v->size[i] && crossing(&w, i, w.next[i]) <= from)
            w.next[i]++;
    }
    return w;
}

/* The next plane that is crossed before `to`, and the step beyond it. */
static double advance(struct walk *w, double to)
{
    double nearest = to;
    int axis = -1;
    for (int i = 0; i < 3; i++)
        if (w->next[i] < w->volume->size[i] && crossing(w, i, w->next[i]) < nearest) {
            nearest = crossing(w, i, w->next[i]);
            axis = i;
        }
    if (axis >= 0)
        w->next[axis]++;
    return nearest;
}

/* Optical depth between two planes, in parts of the volume's extinction: a cubic, of which Simpson's rule is exact; or by
 * a transfer function over a straight line for each quarter of it; with detail Simpson's rule in each. */
static double part_of_depth(const struct walk *w, double from, double to, double first, double last)
{
    enum { PIECES = 4 };
    const bool plain = w->volume->transfer_count == 0, whole = plain && w->volume->detail == NULL;
    if (whole)
        return (to - from) * ((first + last) + 4 * density_on(w, from + (to - from) / 2)) / 6;
    double sum = 0;
    for (int i = 1; i <= PIECES; i++) {
        double next = i < PIECES ? density_on(w, from + (to - from) * i / PIECES) : last;
        sum += plain ? (first + next + 4 * density_on(w, from + (to - from) * (i - 0.5) / PIECES)) / 6
                     : lom_mean_extinction(w->volume, first, next);
        first = next;
    }
    return sum * (to - from) / PIECES;
}

/* The sum is compensated (A. Neumaier, ZAMM 54, 1974). */
double lom_volume_optical_depth(const lom_reference_volume *v, lom_vec3 origin, lom_vec3 direction, double from,
                                double to)
{
    lom_vec3 d = lom_vec3_normalize(direction);
    if (dot(d, d) == 0 || v->greatest == 0 || !lom_cross_volume(v, origin, d, &from, &to))
        return 0;
    struct walk w = begin_walk(v, origin, d, from);
    double total = 0, lost = 0, first = density_on(&w, from);
    while (from < to) {
        double next = advance(&w, to), last = density_on(&w, next);
        double part = part_of_depth(&w, from, next, first, last), longer = total + part;
        lost += total >= part ? (total - longer) + part : (part - longer) + total;
        total = longer;
        from = next;
        first = last;
    }
    return (total + lost) * v->extinction;
}
