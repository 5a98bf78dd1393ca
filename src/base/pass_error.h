/* The one way from an error to another. */
#ifndef LOM_BASE_PASS_ERROR_H
#define LOM_BASE_PASS_ERROR_H

#include <lom/base.h>

/* Passes a failure on: true where `from` holds none; else false, and `to` holds it unless it holds one already. */
bool lom_pass_error(const lom_error *from, lom_error *to);

#endif
