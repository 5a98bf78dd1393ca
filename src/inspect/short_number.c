/* Numbers for people. In: a value. Out: its three leading digits, rounded, as they are written on a scale. */
#include "inspect/short_number.h"

#include <lom/base.h>

#include <stdio.h>

void lom_print_short(char text[LOM_SHORT_NUMBER], double value)
{
    double size = value < 0 ? -value : value;
    int exponent = 0;
    if (!(size > 1e-30 && size < 1e30)) {
        snprintf(text, LOM_SHORT_NUMBER, "%s", size <= 1e-30 ? "0" : "far");
        return;
    }
    for (; size >= 999.5; exponent++)
        size /= 10;
    for (; size < 99.95; exponent--)
        size *= 10;
    int digits = lom_int_of(size + 0.5); /* 100..999: the value is digits * 10^exponent */
    int thousands = exponent + 2 >= 6 ? 6 : exponent + 2 >= 4 ? 3 : 0;
    bool is_plain = exponent + 2 >= -4 && exponent + 2 < 9;
    int after = is_plain ? thousands - exponent : 2; /* digits behind the point */
    for (; after > 0 && digits % 10 == 0; after--)
        digits /= 10;
    int power = 1;
    for (int i = 0; i < after; i++)
        power *= 10;
    char tail[12] = "";
    if (!is_plain)
        snprintf(tail, sizeof tail, "e%d", exponent + 2);
    else if (thousands != 0)
        snprintf(tail, sizeof tail, "%s", thousands == 6 ? "M" : "k");
    for (; after < 0; after++)
        digits *= 10;
    if (power > 1)
        snprintf(text, LOM_SHORT_NUMBER, "%s%d.%0*d%s", value < 0 ? "-" : "", digits / power, after, digits % power,
                 tail);
    else
        snprintf(text, LOM_SHORT_NUMBER, "%s%d%s", value < 0 ? "-" : "", digits, tail);
}
