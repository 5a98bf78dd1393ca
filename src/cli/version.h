/* What this build says of itself and its machine. */
#ifndef LOM_CLI_VERSION_H
#define LOM_CLI_VERSION_H

#include <stdio.h>

/* "gcc 12.2.0", "Debian Clang 14.0.6". */
const char *lom_compiler_name(void);
/* "4 (SSE2), 8 (AVX2), 16 (lowered)". */
void lom_print_widths(FILE *out);

#endif
