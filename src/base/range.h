/* Numbers of the public functions: what is not within its range is a failure with a sentence. */
#ifndef LOM_BASE_RANGE_H
#define LOM_BASE_RANGE_H

#include <lom/base.h>

/* Whether least <= value <= most; NaN is not. Else LOM_ERROR_USAGE: "<what> is <value>, which is not within
 * <least>..<most>." */
bool lom_check_range(double value, double least, double most, lom_error *error, const char *what, ...)
    __attribute__((format(printf, 5, 6)));

#endif
