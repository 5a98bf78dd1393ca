/* Drops what crosses near or far. */
#include "student.h"

int student_clip(const struct picture *p, unsigned codes, struct vertex polygon[10])
{
    bool crosses = (codes & (OUT_NEAR | OUT_FAR | OUT_W)) != 0;
    for (int k = 0; k < 3 && !crosses; k++)
        crosses = polygon[k].value[CLIP + 3] <= 0 && p->width > 0;
    return crosses ? 0 : 3;
}
