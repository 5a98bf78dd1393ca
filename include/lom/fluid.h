/* lom/fluid.h - a volume of liquid that moves freely: particles that carry it, a grid that makes it incompressible.
 *
 * Particles carry mass, velocity, the velocity's gradient and heat (C. Jiang, C. Schroeder, A. Selle, J. Teran, A.
 * Stomakhin: The affine particle-in-cell method, SIGGRAPH 2015). In each step they are summed into the faces of a grid
 * of cells twice as wide as they are apart (F. Harlow, J. Welch: Numerical calculation of time-dependent viscous
 * incompressible flow, Physics of Fluids 8, 1965; Y. Zhu, R. Bridson: Animating sand as a fluid, SIGGRAPH 2005). There
 * gravity acts, viscosity (docs/fluid.md), and a pressure that leaves no divergence and is 0 at the surface, whose
 * place within a cell follows from the density (F. Gibou and others: A second-order-accurate symmetric discretization
 * of the Poisson equation on irregular domains, J. Comput. Phys. 176, 2002). Then the particles take the motion back
 * and go with it, and a second solution pushes apart those that are too dense, so that the volume stays (T.
 * Kugelstadt, A. Longva, N. Thuerey, J. Bender: Implicit density projection for volume conserving liquids, IEEE TVCG
 * 27, 2021).
 *
 * Everything is double and summed in a fixed order: the same calls give the same bytes on every machine and with any
 * number of workers. Conventions: y up; metres, seconds; temperatures in degrees of any scale. */
#ifndef LOM_FLUID_H
#define LOM_FLUID_H

#include <lom/geometry.h>
#include <lom/pipeline.h>

LOM_API_BEGIN

enum {
    LOM_FLUID_CELLS = 512,         /* of the basin along an axis at most */
    LOM_FLUID_ALL_CELLS = 1 << 22, /* together */
    LOM_FLUID_PARTICLES = 1000000, /* at most */
    LOM_FLUID_BODIES = 64          /* blocks, or solids */
};

typedef enum lom_fluid_shape { LOM_FLUID_BOX, LOM_FLUID_ELLIPSOID } lom_fluid_shape;

/* A box, or the ellipsoid that touches its six sides from within. */
typedef struct lom_fluid_body {
    bool present; /* in a scene file */
    lom_fluid_shape shape;
    double low[3], high[3]; /* metres, |x| <= 1e6, low < high; what lies outside of the basin is not there */
    double velocity[3];     /* m/s, |v| <= 1000: of liquid at the beginning */
    double temperature;     /* |t| <= 1e6: of liquid at the beginning, of a solid that heats always */
    bool heats;             /* of solids: it passes heat to the liquid, or takes it; else it keeps heat off */
} lom_fluid_body;

/* Its zero value, with a basin, a spacing and a block, is water. */
typedef struct lom_fluid_desc {
    double low[3], high[3]; /* the basin, closed on all sides; high is moved to whole cells */
    double spacing;         /* metres between particles, 1e-4..1e3; a cell has twice that and eight of them */
    double step;            /* seconds, 1e-5..0.1; 0: 1/120. Nothing may go farther in it than some cells */
    double gravity[3];      /* m/s^2, |g| <= 1000 */
    double density;         /* kg/m^3, 1e-3..1e6; 0: 1000. Pressures alone depend on it */
    double viscosity;       /* m^2/s, kinematic, 0..1e4: water 1e-6, oil 1e-4, honey 1e-2; 0: none, and walls do
                                     not hold it */
    double solid_viscosity; /* m^2/s, 0..1e4: below `melting`; 0: the same everywhere */
    double melting[2];      /* temperatures, rising: between them one viscosity goes over into the other */
    double latent_heat;  /* degrees that the heat of melting would warm the liquid by, 0..1e6: water 80, iron 550. What
                                     melts stays within `melting`, of at least a thousandth of this, until it has it */
    double conductivity; /* m^2/s, of temperature, 0..10; 0: heat stays where it is */
    bool slides[3];      /* walls across x, y, z do not hold it, although it has viscosity */
    const lom_fluid_body *blocks; /* of liquid at the beginning; where two overlap the first one counts */
    size_t block_count;           /* 1..LOM_FLUID_BODIES */
    const lom_fluid_body *solids; /* obstacles: cells whose middles lie in them */
    size_t solid_count;           /* 0..LOM_FLUID_BODIES */
    double (*ground)(const void *context, double x, double z); /* the height (y) of the ground under x and z, metres: a
                                                                   floor that cuts cells; NULL: none. Asked for at the
                                                                   corners of cells, while the fluid is created */
    const void *ground_context;
} lom_fluid_desc;

/* ---- [[fluid]] ---- */

enum { LOM_MAX_FLUIDS = 8 };

typedef struct lom_fluid_params {
    bool present;
    const char *name; /* NULL when it has none; unique in the scene */
    bool visible;
    double start; /* seconds: until then it stands still */
    double low[3], high[3], spacing, step, gravity[3], viscosity, solid_viscosity, melting[2], latent_heat,
        conductivity; /* as of lom_fluid_desc */
    lom_fluid_body *blocks, *solids;
    size_t block_count, solid_count;
    bool ground;          /* the terrain is a floor */
    double index;         /* of refraction */
    double absorption[3]; /* 1/m of red, green and blue */
    double color[3];      /* linear: what its matter sends back of the light where none comes through */
    double highlight, shininess;
} lom_fluid_params;

/* ---- the solver ---- */

typedef struct lom_fluid lom_fluid;

/* NULL when a number is out of its range or none, when no block has a particle, or there would be too many particles or
 * cells, with a sentence; nothing is allocated then. What the description points to is copied. */
lom_fluid *lom_create_fluid(const lom_fluid_desc *desc, lom_error *error);
void lom_free_fluid(lom_fluid *fluid); /* NULL is allowed */

/* One step, on the device's workers, outside of its passes; NULL: by the caller alone, with the same result. False
 * when memory runs out: then it can only be freed. */
bool lom_step_fluid(lom_fluid *fluid, lom_device *device, lom_error *error);

typedef struct lom_fluid_view {
    int cells[3];        /* of the basin */
    double low[3], cell; /* metres: its corner, and a cell's side */
    double step;         /* seconds */
    int64_t steps;       /* since the beginning */
    size_t particles;
    size_t wet;    /* cells with liquid in the last step, 0 before */
    int rounds[4]; /* of conjugate gradients in the last step: pressure, density, viscosity, heat */
} lom_fluid_view;
lom_fluid_view lom_view_fluid(const lom_fluid *fluid);

/* Particles are in an order that is always the same, and which a step may change. */
typedef struct lom_fluid_particle {
    double position[3], velocity[3];
    double temperature, melted; /* melted: 0 solid .. 1 liquid, by `melting` and `latent_heat` */
} lom_fluid_particle;
/* Number i, below the count of the view. */
lom_fluid_particle lom_fluid_particle_at(const lom_fluid *fluid, size_t i);

/* Pascal at the cell that holds a place, of the last step; 0 where there is no liquid. */
double lom_fluid_pressure_at(const lom_fluid *fluid, const double place[3]);

/* The surface of the liquid as closed triangles with normals, one part without a material, places less `origin`
 * (metres): for what is drawn, compared or written (lom_encode_obj). A field of distances from the mean of the
 * particles around a node (Zhu and Bridson 2005), nodes a spacing apart, is cut at 0 by surface nets (S. Gibson:
 * Constrained elastic surface nets, MICCAI 1998). The walls of the basin cut it off flat. On the device's workers, or
 * NULL. NULL when memory runs out. The particles may be in another order afterwards; what steps compute does not
 * change. */
lom_mesh *lom_make_fluid_mesh(lom_fluid *fluid, const double origin[3], lom_device *device, lom_error *error);

LOM_API_END

#endif
