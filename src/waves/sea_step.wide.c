/* Rows of a step of the sea, over lanes. In: amplitudes, a time; out: the spectrum at that time, that of a field, the
 * pixels of the view. Invariant: the phase is reduced in double, in turns, so that it is exact to 1e-6 radians even at
 * 1e7 s (float would be off by half a radian). */
#include "waves/sea_state.h"

#include <lom/lanes_mathematics.h>

LOM_INLINE lom_double load_doubles(const double *from)
{
    lom_double x;
    memcpy(&x, from, sizeof x);
    return x;
}

void LOM_WIDE(lom_sea_wave_row)(const struct lom_sea_rows *r, int row)
{
    size_t pitch = lom_fft_pitch(r->size / 2), plane = pitch * (size_t)r->size, start = (size_t)row * pitch;
    for (size_t n = 0; n < (size_t)r->size / 2; n += LOM_LANES) {
        lom_double turns = load_doubles(r->turns + start + n) * r->time;
        lom_double part = turns - ((turns + LOM_NEAREST) - LOM_NEAREST);
        lom_float angle = lom_narrow(part * 0x1.921fb54442d18p+2);
        lom_float c = lom_cos(angle), s = lom_sin(angle);
        const float *factors = r->factors + start + n;
        lom_store(r->wave_re + start + n, lom_load(factors) * c + lom_load(factors + plane) * s);
        lom_store(r->wave_im + start + n, lom_load(factors + 2 * plane) * c + lom_load(factors + 3 * plane) * s);
    }
}

/* The field's spectrum is H times a real number, or times i and a real number. */
struct factor {
    bool turned;
    lom_float size;
};

LOM_INLINE struct factor factor_of(int field, lom_float kx, lom_float kz, float choppiness)
{
    lom_float square = kx * kx + kz * kz;
    lom_float inverse = lom_select(square > 0.0f, choppiness / lom_sqrt(square), (lom_float){ 0 });
    if (field == LOM_FIELD_SX)
        return (struct factor){ true, kx };
    if (field == LOM_FIELD_SZ)
        return (struct factor){ true, kz };
    if (field == LOM_FIELD_DX)
        return (struct factor){ true, kx * inverse };
    if (field == LOM_FIELD_DZ)
        return (struct factor){ true, kz * inverse };
    if (field == LOM_FIELD_XX)
        return (struct factor){ false, -(kx * kx) * inverse };
    if (field == LOM_FIELD_ZZ)
        return (struct factor){ false, -(kz * kz) * inverse };
    return (struct factor){ false, -(kx * kz) * inverse };
}

void LOM_WIDE(lom_sea_field_row)(const struct lom_sea_rows *r, int row)
{
    int m = row < r->size / 2 ? row : row - r->size;
    size_t start = (size_t)row * lom_fft_pitch(r->size / 2);
    lom_float kz = lom_splat((float)m * r->wavenumber);
    for (int n = 0; n < r->size / 2; n += LOM_LANES) {
        size_t at = start + (size_t)n;
        lom_float re = lom_load(r->wave_re + at), im = lom_load(r->wave_im + at);
        if (r->field != LOM_FIELD_H) {
            lom_float kx = lom_to_float(lom_lane_index() + n) * r->wavenumber;
            struct factor f = factor_of(r->field, kx, kz, (float)r->choppiness);
            lom_float re_now = f.turned ? -im : re;
            im = (f.turned ? re : im) * f.size;
            re = re_now * f.size;
        }
        lom_store(r->field_re + at, re);
        lom_store(r->field_im + at, im);
    }
}

/* ---- pixels ---- */

LOM_INLINE const float *field_at(const struct lom_sea_rows *r, int field, int row)
{
    size_t pitch = lom_fft_pitch(r->size), plane = lom_fft_rows(r->size) * pitch;
    return r->fields + (size_t)field * plane + (size_t)row * pitch;
}

LOM_INLINE void write_channel(const struct lom_sea_rows *r, float *pixels, int channel, int field, int row)
{
    const float *from = field_at(r, field, row);
    float *to = pixels + (size_t)row * (size_t)r->size * 4 + channel;
    for (int i = 0; i < r->size; i++)
        to[4 * i] = from[i];
}

/* All four channels at once: 16 bytes a pixel. */
LOM_INLINE void write_pixels(const struct lom_sea_rows *r, float *pixels, const int field[4], int row)
{
    const float *a = field_at(r, field[0], row), *b = field_at(r, field[1], row);
    const float *c = field_at(r, field[2], row), *d = field_at(r, field[3], row);
    float *to = pixels + (size_t)row * (size_t)r->size * 4;
    for (int i = 0; i < r->size; i++) {
        to[4 * i] = a[i];
        to[4 * i + 1] = b[i];
        to[4 * i + 2] = c[i];
        to[4 * i + 3] = d[i];
    }
}

/* Least and largest values of all lanes: exact, so their order does not matter. */
LOM_INLINE float largest(lom_float x)
{
    float most = x[0];
    for (int i = 1; i < LOM_LANES; i++)
        most = x[i] > most ? x[i] : most;
    return most;
}

LOM_INLINE void find_bounds(const struct lom_sea_rows *r, int row)
{
    const float *h = field_at(r, LOM_FIELD_H, row), *dx = field_at(r, LOM_FIELD_DX, row);
    const float *dz = field_at(r, LOM_FIELD_DZ, row);
    lom_float low = lom_splat(3e38f), high = -low, reach = { 0 };
    for (int i = 0; i < r->size; i += LOM_LANES) {
        low = lom_min(low, lom_load(h + i));
        high = lom_max(high, lom_load(h + i));
        reach = lom_max(reach, lom_max(lom_abs(lom_load(dx + i)), lom_abs(lom_load(dz + i))));
    }
    r->bounds[3 * row] = -largest(-low);
    r->bounds[3 * row + 1] = largest(high);
    r->bounds[3 * row + 2] = largest(reach);
}

LOM_INLINE void write_jacobian(const struct lom_sea_rows *r, int row)
{
    const float *xx = field_at(r, LOM_FIELD_XX, row), *zz = field_at(r, LOM_FIELD_ZZ, row);
    const float *xz = field_at(r, LOM_FIELD_XZ, row);
    float *to = r->jacobian + (size_t)row * (size_t)r->size;
    for (int i = 0; i < r->size; i += LOM_LANES) {
        lom_float cross = lom_load(xz + i);
        lom_store(to + i, (1.0f + lom_load(xx + i)) * (1.0f + lom_load(zz + i)) - cross * cross);
    }
}

LOM_INLINE bool is_asked(const struct lom_sea_rows *r, unsigned fields)
{
    return (r->asked & fields) != 0;
}

void LOM_WIDE(lom_sea_view_row)(const struct lom_sea_rows *r, int row)
{
    static const int place[LOM_FIELDS] = { LOM_FIELD_DX, LOM_FIELD_H,  LOM_FIELD_DZ, LOM_FIELD_XZ,
                                           LOM_FIELD_SX, LOM_FIELD_SZ, LOM_FIELD_XX, LOM_FIELD_ZZ };
    static const unsigned needs[LOM_FIELDS] = { LOM_SEA_DISPLACEMENT, LOM_SEA_HEIGHT,  LOM_SEA_DISPLACEMENT,
                                                LOM_SEA_JACOBIAN,     LOM_SEA_SLOPES,  LOM_SEA_SLOPES,
                                                LOM_SEA_JACOBIAN,     LOM_SEA_JACOBIAN };
    for (int half = 0; half < 8; half += 4) {
        float *pixels = half == 0 ? r->displacement : r->derivatives;
        if (is_asked(r, needs[half]) && is_asked(r, needs[half + 1]) && is_asked(r, needs[half + 3])) {
            write_pixels(r, pixels, place + half, row);
            continue;
        }
        for (int i = half; i < half + 4; i++)
            if (is_asked(r, needs[i]))
                write_channel(r, pixels, i - half, place[i], row);
    }
    if (r->asked & LOM_SEA_JACOBIAN)
        write_jacobian(r, row);
    find_bounds(r, row);
}
