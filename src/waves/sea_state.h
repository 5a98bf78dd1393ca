/* What a sea holds. The half of the k plane that the transforms take: rows m in transform order (0 .. N/2 - 1, -N/2 ..
 * -1), columns n = 0 .. N/2 - 1. */
#ifndef LOM_WAVES_SEA_STATE_H
#define LOM_WAVES_SEA_STATE_H

#include "waves/fft.h"

#include <lom/sea.h>

/* A plane of the half spectrum has N rows of lom_fft_pitch(N / 2) values. With h0(k) = a + i b and h0(-k) = p + i q,
 *     H(k, t) = (a + p) c + (b + q) s + i ((b - q) c + (p - a) s),   c, s = cos, sin of w t. */
struct lom_cascade {
    struct lom_sea_cascade view;
    lom_fft *fft;
    double *turns;  /* w / 2 pi, turns a second */
    float *factors; /* planes a + p, b + q, b - q, p - a */
    float *memory;  /* what the view points at: displacement, derivatives, jacobian */
};

struct lom_sea {
    lom_sea_desc desc;
    lom_wave_spectrum spectrum;
    struct lom_cascade cascade[LOM_MAX_CASCADES];
    float *spectrum_planes; /* H, and a field's spectrum: 4 half planes of the largest cascade */
    float *fields;          /* 8 planes of the largest cascade */
    float *bounds;          /* 3 a row */
};

/* h0 of the wave (n, m) of a cascade in double: 0 outside its band. */
void lom_wave_amplitude(const lom_sea *sea, int cascade, int n, int m, double amplitude[2]);

/* Fields, in the order of their planes. */
enum {
    LOM_FIELD_DX,
    LOM_FIELD_H,
    LOM_FIELD_DZ,
    LOM_FIELD_XZ,
    LOM_FIELD_SX,
    LOM_FIELD_SZ,
    LOM_FIELD_XX,
    LOM_FIELD_ZZ,
    LOM_FIELDS
};

/* Rows of H at a time, and of the spectrum of a field of it; of the view from the planes of fields. */
struct lom_sea_rows {
    const double *turns;
    const float *factors;
    float *wave_re, *wave_im, *field_re, *field_im;
    const float *fields;
    float *displacement, *derivatives, *jacobian, *bounds;
    int size, field;
    unsigned asked;
    double time, choppiness;
    float wavenumber; /* 2 pi / L */
};

typedef void lom_sea_row(const struct lom_sea_rows *rows, int row);
#define LOM_DECLARE_SEA(name, variant)                                                                                 \
    lom_sea_row lom_sea_wave_row_##variant, lom_sea_field_row_##variant, lom_sea_view_row_##variant;
LOM_EACH_VARIANT(LOM_DECLARE_SEA, )

#endif
