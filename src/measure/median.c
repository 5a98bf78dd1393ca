/* The median. In: numbers. Out: the middle one. Invariant: the numbers are sorted afterwards. */
#include "measure/median.h"

static void sort(double *numbers, int count)
{
    for (int i = 1; i < count; i++) {
        double number = numbers[i];
        int j = i;
        for (; j > 0 && numbers[j - 1] > number; j--)
            numbers[j] = numbers[j - 1];
        numbers[j] = number;
    }
}

double lom_median(double *numbers, int count)
{
    sort(numbers, count);
    return (numbers[(count - 1) / 2] + numbers[count / 2]) / 2;
}
