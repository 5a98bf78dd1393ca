/* Transfer functions in double, by their definition. In: points, densities. Out: extinctions and colours. */
#include "base/numbers.h"
#include "reference/volume.h"

bool lom_check_transfer_points(const lom_transfer_point *points, size_t count, lom_error *error)
{
    lom_transfer_function made;
    return count == 0 || lom_make_transfer_function(points, count, &made, error);
}

/* The last point whose value is not above the density, and how far the density is towards the next. */
static size_t find_point(const lom_reference_volume *v, double density, double *part)
{
    const lom_transfer_point *p = v->transfer;
    size_t above = 0;
    while (above < v->transfer_count && p[above].value <= density)
        above++;
    *part = 0;
    if (above == 0 || above == v->transfer_count)
        return above == 0 ? 0 : above - 1;
    *part = (density - p[above - 1].value) / (p[above].value - p[above - 1].value);
    return above - 1;
}

double lom_seen_extinction(const lom_reference_volume *v, double density)
{
    if (v->transfer_count == 0)
        return density;
    double part;
    size_t i = find_point(v, density, &part);
    double from = v->transfer[i].extinction;
    return part > 0 ? from + part * (v->transfer[i + 1].extinction - from) : from;
}

lom_vec3 lom_seen_color(const lom_reference_volume *v, double density)
{
    if (v->transfer_count == 0)
        return (lom_vec3){ 1, 1, 1 };
    double part, extinction = lom_seen_extinction(v, density);
    size_t i = find_point(v, density, &part);
    const lom_transfer_point *a = &v->transfer[i], *b = part > 0 ? a + 1 : a;
    double first = (1 - part) * a->extinction, second = part * b->extinction;
    if (!(extinction > 0))
        return (lom_vec3){ 0, 0, 0 };
    return (lom_vec3){ (first * a->color[0] + second * b->color[0]) / extinction,
                       (first * a->color[1] + second * b->color[1]) / extinction,
                       (first * a->color[2] + second * b->color[2]) / extinction };
}

/* The integral of the extinction over densities from 0 to x. */
static double integral_to(const lom_reference_volume *v, double x)
{
    const lom_transfer_point *p = v->transfer;
    double sum = lom_smaller(x, p[0].value) * p[0].extinction;
    for (size_t i = 0; i < v->transfer_count && p[i].value < x; i++) {
        double to = i + 1 < v->transfer_count ? lom_smaller(p[i + 1].value, x) : x;
        double width = i + 1 < v->transfer_count ? p[i + 1].value - p[i].value : 1;
        double rise = i + 1 < v->transfer_count ? p[i + 1].extinction - p[i].extinction : 0;
        double share = (to - p[i].value) / (width > 0 ? width : 1);
        sum += (to - p[i].value) * (p[i].extinction + rise * share / 2);
    }
    return sum;
}

double lom_mean_extinction(const lom_reference_volume *v, double a, double b)
{
    if (v->transfer_count == 0)
        return (a + b) / 2;
    if (lom_magnitude(b - a) < 1e-9)
        return lom_seen_extinction(v, (a + b) / 2);
    return (integral_to(v, b) - integral_to(v, a)) / (b - a);
}
