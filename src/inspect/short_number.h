/* Numbers as a legend has them. */
#ifndef LOM_INSPECT_SHORT_NUMBER_H
#define LOM_INSPECT_SHORT_NUMBER_H

enum { LOM_SHORT_NUMBER = 48 };

/* Three digits without zeros behind the point: "0.00123", "12.5", "1230", "45.6k", "7.89M", "-1.2e-7"; "0" below 1e-30, "far"
 * from 1e30 on and of what is no number. */
void lom_print_short(char text[LOM_SHORT_NUMBER], double value);

#endif
