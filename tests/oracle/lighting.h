/* The oracle of lighting: what a surface sends back of a directional light and of a hemisphere of sky and ground, by the
 * formulas of docs/lighting.md, in double. */
#ifndef LOM_TESTS_ORACLE_LIGHTING_H
#define LOM_TESTS_ORACLE_LIGHTING_H

#include <math.h>
#include <stdbool.h>

typedef struct lit_surface {
    double ambient[3], diffuse[3], specular[3], shininess; /* of the material */
    double sky[3], ground[3], sun[3], to_sun[3];           /* light on what faces up and down; the sun's, unit length */
    bool blinn;                                            /* the highlight by the vector halfway, else by the mirror */
} lit_surface;

static inline double dot_of(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void normalize(double a[3])
{
    const double length = sqrt(dot_of(a, a));
    for (int k = 0; k < 3; k++)
        a[k] /= length;
}

/* (R.E)^s of Phong (1975), R the light mirrored at the normal, or (N.H)^s of Blinn (1977); 0 for light from behind. */
static inline double highlight(const lit_surface *m, const double normal[3], const double to_eye[3])
{
    const double facing = dot_of(normal, m->to_sun);
    double other[3];
    for (int k = 0; k < 3; k++)
        other[k] = m->blinn ? m->to_sun[k] + to_eye[k] : 2 * facing * normal[k] - m->to_sun[k];
    if (m->blinn)
        normalize(other);
    const double cosine = dot_of(other, m->blinn ? normal : to_eye);
    return facing > 0 && cosine > 0 ? pow(cosine, m->shininess) : 0;
}

/* albedo: of the texture, which the highlight does not take part in. normal and to_eye: unit length. */
static inline void light_surface(const lit_surface *m, const double normal[3], const double to_eye[3],
                                 const double albedo[3], double out[3])
{
    const double up = 0.5 + 0.5 * normal[1], shine = highlight(m, normal, to_eye);
    double facing = dot_of(normal, m->to_sun);
    facing = facing > 0 ? facing : 0;
    for (int k = 0; k < 3; k++) {
        const double around = m->ground[k] + (m->sky[k] - m->ground[k]) * up;
        out[k] = albedo[k] * (around * m->ambient[k] + m->sun[k] * m->diffuse[k] * facing) +
                 m->sun[k] * m->specular[k] * shine;
    }
}

#endif
