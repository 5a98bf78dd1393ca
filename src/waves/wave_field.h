/* The waves of a scene's water, of every kind together. A kind is one row of a table (wave_field.c) and one file: what
 * it needs is loaded once, bounded at any time, placed at a time (heights and displacements, and the bounds of those),
 * and filled (what else shaders look up), no more than a picture needs.
 *
 * Bounds and heights of all kinds add up, in the order of the table. */
#ifndef LOM_WAVES_WAVE_FIELD_H
#define LOM_WAVES_WAVE_FIELD_H

#include "waves/wave_lanes.h"
#include "waves/wave_site.h"

/* How much of the waves at a time there is. */
enum lom_waves_known { LOM_WAVES_BOUNDED, LOM_WAVES_PLACED, LOM_WAVES_FILLED };

/* What a kind of waves is to be made from. */
struct lom_wave_source {
    const struct lom_wave_site *site;
    const lom_texture *ripples; /* the water's normal map, which a flow carries or still water shows; or NULL */
    const lom_texture *flow;    /* its flow map, or NULL */
    lom_device *device;
};

/* What a frame has to say of a kind. */
struct lom_wave_moment {
    enum lom_waves_known known;
    uint64_t steps_before; /* lom_wave_steps before the frame */
    const char *why;       /* why no water is drawn, or NULL */
};
enum { LOM_MAX_WAVE_TEXT = 240 };
struct lom_wave_report {
    bool says, runs;
    char text[LOM_MAX_WAVE_TEXT];
};

/* When a report is due: before the scene is drawn, when the waves are filled or will not be, or when it is known where
 * water is seen. */
enum lom_wave_stage { LOM_WAVES_AT_FIRST, LOM_WAVES_AT_FILLING, LOM_WAVES_AT_DRAWING };

/* A kind of waves. Its state is `size` bytes, zeros before load, which is called where `exists` says so; free is called
 * after load whether it was successful or not. Functions that are NULL have nothing to do. They are given the origin of
 * places in `out`; height is over a place of the world. */
struct lom_wave_kind {
    const char *step; /* of the plan */
    size_t size;
    bool advances; /* placing it at a time is work: bounds are enough where no water is seen */
    bool (*exists)(const struct lom_wave_source *source);
    bool (*load)(void *state, const struct lom_wave_source *source, lom_error *error);
    void (*free)(void *state);
    void (*bound)(const void *state, struct lom_waves_uniform *out, double time);
    bool (*place)(void *state, struct lom_waves_uniform *out, double time, lom_error *error);
    bool (*fill)(void *state, struct lom_waves_uniform *out, double time, lom_error *error);
    double (*height)(const void *state, const struct lom_waves_uniform *waves, double x, double z);
    uint64_t (*steps)(const void *state); /* run since it was loaded */
    enum lom_wave_stage stage;
    void (*report)(const void *state, const struct lom_wave_moment *moment, struct lom_wave_report *report);
};
extern const struct lom_wave_kind lom_trochoid_waves, lom_river_waves, lom_ripple_waves, lom_surf_waves,
    lom_shallow_waves, lom_sea_waves, lom_wakes;

struct lom_wave_field;

/* The waves of a site and of a device, which live as long as they do; NULL on failure. Freed with
 * lom_free_wave_field. */
struct lom_wave_field *lom_load_wave_field(const struct lom_wave_source *source, lom_error *error);
void lom_free_wave_field(struct lom_wave_field *field); /* NULL is allowed */
/* Whether placing them at a time is work. */
bool lom_waves_advance(const struct lom_wave_field *field);
/* The waves with bounds that hold at any time; placed at a time; the rest, after placing at the same time. Places are
 * counted from origin. */
void lom_bound_waves(const struct lom_wave_field *field, struct lom_waves_uniform *out, lom_vec3 origin, double time);
bool lom_place_waves(struct lom_wave_field *field, struct lom_waves_uniform *out, lom_vec3 origin, double time,
                     lom_error *error);
bool lom_fill_waves(struct lom_wave_field *field, struct lom_waves_uniform *out, double time, lom_error *error);
/* Over a point of the world, where they were placed last: metres from the level. */
double lom_wave_height(const struct lom_wave_field *field, const struct lom_waves_uniform *waves, double x, double z);
/* Steps of time that have been run since the field was loaded. */
uint64_t lom_wave_steps(const struct lom_wave_field *field);
/* What kind number `kind` says at a stage, for the plan; false behind the last kind. */
bool lom_report_waves(const struct lom_wave_field *field, int kind, enum lom_wave_stage stage,
                      const struct lom_wave_moment *moment, const char **step, struct lom_wave_report *report);

#endif
