/* Medians of times, which come nearly in any order, and of which there are few. */
#ifndef LOM_MEASURE_MEDIAN_H
#define LOM_MEASURE_MEDIAN_H

/* The middle of count > 0 numbers, the mean of two middle ones; sorts them, the least first. */
double lom_median(double *numbers, int count);

#endif
