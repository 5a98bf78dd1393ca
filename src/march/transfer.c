/* Transfer functions. In: control points. Out: the same with their ends at the values 0 and 1, and colours weighted by
 * extinction. Invariant: values never fall from point to point, and every number is finite. */
#include "base/numbers.h"
#include "base/own_float_state.h"

#include <lom/transfer.h>

static bool check_point(const lom_transfer_point *point, double least, lom_error *error)
{
    if (!(point->value >= least && point->value <= 1))
        return lom_fail(error, LOM_ERROR_USAGE,
                        "The values of a transfer function lie in 0 to 1 and do not fall: %g follows %g.", point->value,
                        least);
    if (!(point->extinction >= 0 && point->extinction <= 1))
        return lom_fail(error, LOM_ERROR_USAGE, "The extinction of a transfer function lies in 0 to 1: %g does not.",
                        point->extinction);
    for (int i = 0; i < 3; i++)
        if (!(point->color[i] >= 0 && point->color[i] <= 1e6))
            return lom_fail(error, LOM_ERROR_USAGE,
                            "The colours of a transfer function lie in 0 to a million: %g does not.", point->color[i]);
    return true;
}

static void add_point(lom_transfer_function *transfer, const lom_transfer_point *point, double value)
{
    int i = transfer->count++;
    transfer->value[i] = (float)value;
    for (int k = 0; k < 3; k++)
        transfer->channel[k][i] = (float)(point->color[k] * point->extinction);
    transfer->channel[3][i] = (float)point->extinction;
}

bool lom_make_transfer_function(const lom_transfer_point *points, size_t count, lom_transfer_function *transfer,
                                lom_error *error)
{
    LOM_OWN_FLOAT_STATE;
    *transfer = (lom_transfer_function){ .count = 0 };
    if (points == NULL || count < 1 || count > LOM_MAX_TRANSFER)
        return lom_fail(error, LOM_ERROR_USAGE, "A transfer function has 1 to %d points, not %zu.", LOM_MAX_TRANSFER,
                        points == NULL ? 0 : count);
    double least = 0;
    for (size_t i = 0; i < count; i++) {
        if (!check_point(&points[i], least, error))
            return false;
        least = points[i].value;
    }
    if (points[0].value > 0)
        add_point(transfer, &points[0], 0);
    size_t at_zero = 0;
    for (size_t i = 0; i < count; i++) {
        add_point(transfer, &points[i], points[i].value);
        if (points[i].value == 0)
            at_zero = i;
    }
    add_point(transfer, &points[count - 1], 1);
    transfer->empty_is_clear = points[at_zero].extinction == 0;
    return true;
}

float lom_transfer_at(const lom_transfer_function *transfer, float value, int k)
{
    const float *at = transfer->value, *c = transfer->channel[k];
    float cut = value > 0 ? value < 1 ? value : 1 : 0;
    int i = 0;
    while (i + 2 < transfer->count && at[i + 1] <= cut)
        i++;
    float width = at[i + 1] - at[i];
    return (cut - at[i]) * (width > 0 ? 1 / width : 0) * (c[i + 1] - c[i]) + c[i];
}
