/* Proves of drops that waves and rivers throw: they begin where waves meet steep ground that faces them and nowhere else,
 * not on a beach; when the front is there and not before; as fast as the height and the speed of the wave make them, no
 * higher than that carries; a river throws them where it is faster than its waves; and their bounds hold. */
#include "check.h"

#include "spray/hits.h"

enum { COLUMNS = 40, ROWS = 80, DROPS = 4000 };
static const double gravity = 9.80665;

static float heights[(COLUMNS + 1) * (ROWS + 1)];
static lom_water_waves waves = { .kind = LOM_WAVES_NONE };
static const lom_water_foam no_foam;
static lom_water_surf surf = { .height = 0.8, .period = 6, .direction = 1.5707963267948966 };
static const lom_shallow_water not_shallow;

/* 3 m of water, and from row 60 on a wall of 5 m or a beach. Waves come along +z. */
static struct lom_wave_site site_with(bool wall, bool rock)
{
    for (int row = 0; row <= ROWS; row++)
        for (int column = 0; column <= COLUMNS; column++) {
            const bool in_rock = rock && row >= 30 && row < 40 && column >= 15 && column < 25;
            const float beach = row > 30 ? 0.12f * (float)(row - 30) : 0;
            heights[row * (COLUMNS + 1) + column] = in_rock || (wall && row >= 60) ? 8 : wall ? 0 : beach;
        }
    return (struct lom_wave_site){ .waves = &waves,
                                   .foam = &no_foam,
                                   .surf = &surf,
                                   .shallow = &not_shallow,
                                   .size = { COLUMNS, ROWS },
                                   .tile = 1,
                                   .ripple_up = 1,
                                   .bed = { heights, COLUMNS, ROWS, { COLUMNS, ROWS }, -3 } };
}

static const lom_spray burst = {
    .source = LOM_SPRAY_SURF, .kick = 1, .count = DROPS, .from = { -100, 0, -100 }, .to = { 100, 0, 100 }, .life = 2
};

static struct lom_hits find(const struct lom_wave_site *site, const lom_spray *spray)
{
    struct lom_hits hits;
    lom_error error = { 0 };
    CHECK(lom_find_hits(&hits, spray, site, NULL, &error), "%s", error.text);
    return hits;
}

/* Row 59, z = 19, is the last one before the wall; of the rock the row before it, 29, and nothing of its lee. */
static void waves_hit_what_faces_them(void)
{
    struct lom_wave_site site = site_with(true, true);
    struct lom_hits hits = find(&site, &burst);
    int wall = 0, rock = 0;
    for (size_t i = 0; i < hits.count; i++) {
        const double *place = hits.places[i].place;
        const bool at_wall = place[1] == 19,
                   before_rock = place[1] < 0 && place[1] >= -11 && place[0] >= -6 && place[0] <= 6;
        CHECK(at_wall || before_rock, "a hit at %g %g", place[0], place[1]);
        wall += at_wall;
        rock += place[1] == -11;
    }
    CHECK(wall > 20 && rock >= 8, "%d places of the wall, %d of the rock", wall, rock);
    lom_free_hits(&hits);
    lom_spray part = burst;
    part.to[2] = 0; /* without the wall */
    hits = find(&site, &part);
    for (size_t i = 0; i < hits.count; i++)
        CHECK(hits.places[i].place[1] <= 0, "a hit at z = %g is outside", hits.places[i].place[1]);
    lom_free_hits(&hits);
    site = site_with(false, false);
    hits = find(&site, &burst);
    CHECK(hits.count == 0, "%zu places of a beach are hit", hits.count);
    lom_free_hits(&hits);
}

static void a_wave_throws_by_its_height_and_speed(void)
{
    const struct lom_wave_site site = site_with(true, false);
    struct lom_hits hits = find(&site, &burst);
    const double w = 6.283185307179586 / surf.period, k = lom_wave_number(w, 3), a = surf.height / 2;
    const double u = a * w / lom_double_tanh(k * 3), exact = lom_double_sqrt(u * u + 2 * gravity * a);
    CHECK(hits.count > 0, "nothing is hit");
    for (size_t i = 0; i < hits.count; i++) {
        const double speed = lom_hit_speed(&hits.places[i], 1), c = hits.places[i].speed;
        CHECK(speed > 0.85 * exact && speed < 1.15 * exact, "%g m/s, not %g", speed, exact);
        const double breaking = lom_hit_speed(&hits.places[i], 1e3), high = hits.places[i].amplitude * 1e3;
        CHECK(breaking * breaking < c * c + 2 * gravity * high + 1e-6, "the water is faster than its wave");
    }
    lom_free_hits(&hits);
}

/* All of the wall is met by a front at the same time, and a drop lives from there on, within jet_time. */
static void drops_wait_for_the_front(void)
{
    static lom_particle drops[DROPS];
    const struct lom_wave_site site = site_with(true, false);
    struct lom_hits hits = find(&site, &burst);
    const lom_emitter e = { .seed = 3, .count = DROPS, .life = 2, .jet_time = 0.5 };
    const double front = hits.places[0].arrival, late = 0.08;
    double highest = 0, low[3], high[3];
    lom_bound_hits(&hits, &e, 1, low, high);
    for (size_t i = 0; i < hits.count; i++) {
        double off = hits.places[i].arrival - front;
        off -= surf.period * lom_double_floor(off / surf.period + 0.5);
        CHECK(off < late && off > -late, "a front of a straight wave is %g s late", off);
    }
    for (int step = 0; step < 60; step++) {
        const double since = 0.1 * step, time = 60 + front + since;
        int alive = 0;
        lom_place_hits(&hits, &e, 1, time, 0, DROPS, drops);
        for (int i = 0; i < DROPS; i++) {
            if (!(drops[i].alpha > 0))
                continue;
            alive++;
            highest = drops[i].place[1] > highest ? drops[i].place[1] : highest;
            for (int k = 0; k < 3; k++)
                CHECK(drops[i].place[k] >= low[k] && drops[i].place[k] <= high[k], "drop %d leaves its bounds", i);
        }
        if (since > 2.5 + late && since < 6 - late)
            CHECK(alive == 0, "%d drops live %g s after the front", alive, since);
        if (since > 0.6 && since < 1.5)
            CHECK(alive > DROPS / 2, "%d drops of %d live %g s after the front", alive, DROPS, since);
    }
    const double most = hits.fastest * hits.fastest / (2 * gravity);
    CHECK(highest <= most && highest > 0.5 * most, "drops rise %g m, their speed carries %g", highest, most);
    lom_free_hits(&hits);
}

/* A channel that narrows, of a mean speed of `speed`. */
static void a_river_throws_where_it_is_fast(void)
{
    struct lom_wave_site site = site_with(true, false);
    for (int row = 0; row <= ROWS; row++)
        for (int column = 0; column <= COLUMNS; column++) {
            const bool narrow = row > 35 && row < 50;
            const int half = narrow ? 4 : 12;
            heights[row * (COLUMNS + 1) + column] = column < 20 - half || column > 20 + half ? 8 : 2;
        }
    waves = (lom_water_waves){ .kind = LOM_WAVES_FLOW, .direction = 1.5707963267948966, .speed = 2.5 };
    lom_spray spray = burst;
    spray.source = LOM_SPRAY_RIVER;
    struct lom_hits hits = find(&site, &spray);
    CHECK(hits.count > 20 && hits.period == 0, "%zu places", hits.count);
    for (size_t i = 0; i < hits.count; i++) {
        const struct lom_hit_place *at = &hits.places[i];
        CHECK(at->speed > lom_double_sqrt(gravity * 1), "%g m/s", at->speed);
        CHECK(at->place[1] > -14 && at->place[1] < 22, "the wide part throws at z = %g", at->place[1]);
    }
    lom_free_hits(&hits);
    waves.speed = 0.5;
    hits = find(&site, &spray);
    CHECK(hits.count == 0, "a slow river throws at %zu places", hits.count);
    lom_free_hits(&hits);
    waves = (lom_water_waves){ .kind = LOM_WAVES_NONE };
}

int main(int argc, char **argv)
{
    RUN(waves_hit_what_faces_them);
    RUN(a_wave_throws_by_its_height_and_speed);
    RUN(drops_wait_for_the_front);
    RUN(a_river_throws_where_it_is_fast);
    return check_result();
}
