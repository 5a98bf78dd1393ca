/* The waves of a scene's water. In: a site, a time. Out: what shaders evaluate. Invariant: the kinds are asked in the
 * order of the table, so sums of their bounds and heights have one order. A new kind is one row. */
#include "waves/wave_field.h"

static const struct lom_wave_kind *const kinds[] = { &lom_trochoid_waves, &lom_river_waves,   &lom_ripple_waves,
                                                     &lom_surf_waves,     &lom_shallow_waves, &lom_sea_waves,
                                                     &lom_wakes };
enum { KINDS = sizeof kinds / sizeof kinds[0] };

struct lom_wave_field {
    double level;
    void *state[KINDS]; /* NULL: the site has none of the kind */
};

struct lom_wave_field *lom_load_wave_field(const struct lom_wave_source *source, lom_error *error)
{
    struct lom_wave_field *field = lom_allocate(1, sizeof *field, error);
    bool done = field != NULL;
    if (done)
        field->level = source->site->level;
    for (int i = 0; done && i < KINDS; i++) {
        if (!kinds[i]->exists(source))
            continue;
        field->state[i] = lom_allocate(1, kinds[i]->size, error);
        done = field->state[i] != NULL && kinds[i]->load(field->state[i], source, error);
    }
    if (done)
        return field;
    lom_free_wave_field(field);
    return NULL;
}

void lom_free_wave_field(struct lom_wave_field *field)
{
    for (int i = 0; field != NULL && i < KINDS; i++) {
        if (field->state[i] != NULL && kinds[i]->free != NULL)
            kinds[i]->free(field->state[i]);
        lom_release(field->state[i]);
    }
    lom_release(field);
}

bool lom_waves_advance(const struct lom_wave_field *field)
{
    for (int i = 0; i < KINDS; i++)
        if (field->state[i] != NULL && kinds[i]->advances)
            return true;
    return false;
}

static void begin(const struct lom_wave_field *field, struct lom_waves_uniform *out, lom_vec3 origin)
{
    out->origin[0] = origin.x;
    out->origin[1] = origin.y;
    out->origin[2] = origin.z;
    out->level = (float)(field->level - origin.y);
    out->lowest = out->highest = out->reach = 0;
}

void lom_bound_waves(const struct lom_wave_field *field, struct lom_waves_uniform *out, lom_vec3 origin, double time)
{
    begin(field, out, origin);
    for (int i = 0; i < KINDS; i++)
        if (field->state[i] != NULL)
            kinds[i]->bound(field->state[i], out, time);
}

/* A kind without a function of its own is placed by its bounds: it is closed in time. */
bool lom_place_waves(struct lom_wave_field *field, struct lom_waves_uniform *out, lom_vec3 origin, double time,
                     lom_error *error)
{
    bool done = true;
    begin(field, out, origin);
    for (int i = 0; done && i < KINDS; i++) {
        if (field->state[i] == NULL)
            continue;
        if (kinds[i]->place == NULL)
            kinds[i]->bound(field->state[i], out, time);
        else
            done = kinds[i]->place(field->state[i], out, time, error);
    }
    return done;
}

bool lom_fill_waves(struct lom_wave_field *field, struct lom_waves_uniform *out, double time, lom_error *error)
{
    bool done = true;
    for (int i = 0; done && i < KINDS; i++)
        if (field->state[i] != NULL && kinds[i]->fill != NULL)
            done = kinds[i]->fill(field->state[i], out, time, error);
    return done;
}

double lom_wave_height(const struct lom_wave_field *field, const struct lom_waves_uniform *waves, double x, double z)
{
    double height = 0;
    for (int i = 0; i < KINDS; i++)
        if (field->state[i] != NULL && kinds[i]->height != NULL)
            height += kinds[i]->height(field->state[i], waves, x, z);
    return height;
}

uint64_t lom_wave_steps(const struct lom_wave_field *field)
{
    uint64_t steps = 0;
    for (int i = 0; i < KINDS; i++)
        if (field->state[i] != NULL && kinds[i]->steps != NULL)
            steps += kinds[i]->steps(field->state[i]);
    return steps;
}

bool lom_report_waves(const struct lom_wave_field *field, int kind, enum lom_wave_stage stage,
                      const struct lom_wave_moment *moment, const char **step, struct lom_wave_report *report)
{
    *report = (struct lom_wave_report){ .says = false };
    if (kind >= KINDS)
        return false;
    *step = kinds[kind]->step;
    if (field->state[kind] != NULL && kinds[kind]->report != NULL && kinds[kind]->stage == stage)
        kinds[kind]->report(field->state[kind], moment, report);
    return true;
}
