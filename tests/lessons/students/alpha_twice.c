/* Multiplies by alpha what is multiplied already. */
#include "student.h"

void student_write_pixel(const float color[4], bool blends, uint8_t pixel[4])
{
    float a = clamp(color[3], 0, 1), alpha = blends ? a + (float)pixel[3] / 255 * (1 - a) : a;
    for (int i = 0; i < 3; i++) {
        float c = clamp(color[i], 0, 1);
        pixel[i] = encode(!blends ? c : c * a * a + decode(pixel[i]) * (1 - a));
    }
    pixel[3] = (uint8_t)lom_count_of(clamp(alpha, 0, 1) * 255.0 + 0.5, 255);
}
