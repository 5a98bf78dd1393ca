/* Proves of drops that water throws at an entity: they begin on its waterline, on the side that the water comes to and that
 * nothing of it stands before; when a crest is there and not between crests; as high as speed and height of the water carry
 * them by v^2 / 2g and no higher; at the bow of what moves; none in calm water. The waves that they meet are those of the
 * scene: trochoids and surf exactly, of a sea most of its variance. */
#include "check.h"

#include "base/numbers.h"
#include "spray/hits.h"
#include "waves/sea_desc.h"

enum { COLUMNS = 40, ROWS = 80, DROPS = 3000 };
static const double gravity = 9.80665;

static float heights[(COLUMNS + 1) * (ROWS + 1)];
static lom_water_waves waves;
static const lom_water_foam no_foam;
static lom_water_surf surf;
static const lom_shallow_water not_shallow;
static double motion[2]; /* of the entity, m/s */

static void follow(const void *scene, size_t followed, double time, double place[2], double *heading)
{
    CHECK(scene == &waves && followed == 1, "another entity is asked for");
    place[0] = 3 + motion[0] * time;
    place[1] = -2 + motion[1] * time;
    *heading = 0.25;
}

/* Water of 6 m over a level bed. */
static struct lom_wave_site make_site(void)
{
    for (int i = 0; i < (COLUMNS + 1) * (ROWS + 1); i++)
        heights[i] = 0;
    return (struct lom_wave_site){ .waves = &waves,
                                   .foam = &no_foam,
                                   .surf = &surf,
                                   .shallow = &not_shallow,
                                   .level = 1,
                                   .size = { 4 * COLUMNS, 4 * ROWS },
                                   .tile = 1,
                                   .ripple_up = 1,
                                   .bed = { heights, COLUMNS, ROWS, { 4 * COLUMNS, 4 * ROWS }, -5 },
                                   .follow = follow,
                                   .scene = &waves };
}

static const lom_spray splash = { .source = LOM_SPRAY_ENTITY, .kick = 1, .count = DROPS, .life = 1 };
static const lom_emitter emitter = { .seed = 4, .count = DROPS, .life = 1 };

/* A post of 2 x 3 metres that goes through the water where the entity is; with `twice` another one 4 m along +x. */
static struct lom_hits find(bool twice)
{
    struct lom_hits hits;
    lom_error error = { 0 };
    const struct lom_wave_site site = make_site();
    lom_mesh *post = lom_make_box((lom_vec3){ 2, 9, 3 }, &error);
    lom_mesh_builder *builder = lom_create_mesh_builder(&error);
    lom_builder_material(builder, NULL);
    for (int i = 0; i < (twice ? 2 : 1); i++) {
        const lom_mat4 at = lom_translation((lom_vec3){ 4.0 * i, 0, 0 });
        lom_builder_transform(builder, &at);
        lom_builder_mesh(builder, post);
    }
    lom_mesh *mesh = lom_finish_mesh(builder, 0, &error);
    const struct lom_hit_body body = { .mesh = mesh,
                                       .world_from_model = lom_translation((lom_vec3){ 3, 0.3, -2 }),
                                       .followed = 1,
                                       .moves = motion[0] != 0 || motion[1] != 0 };
    CHECK(mesh != NULL && lom_find_hits(&hits, &splash, &site, &body, &error), "%s", error.text);
    lom_free_mesh(mesh);
    lom_free_mesh(post);
    return hits;
}

static int side_of(double x, double z)
{
    for (int side = 0; side < LOM_HIT_SIDES; side++) {
        double way[2];
        lom_hit_way(side, way);
        if (way[0] * x + way[1] * z > 0.999)
            return side;
    }
    return -1;
}

static void the_waterline_is_the_outline(void)
{
    struct lom_hits hits = find(false);
    double length = 0;
    for (size_t i = 0; i < hits.count; i++) {
        const struct lom_hit_place *p = &hits.places[i];
        const double x = p->place[0] * p->way[0], z = p->place[1] * p->way[1];
        length += p->width;
        CHECK(p->level == 1 && (lom_larger(x - 1, 1 - x) < 1e-6 || lom_larger(z - 1.5, 1.5 - z) < 1e-6),
              "a piece at %g %g, normal %g %g", p->place[0], p->place[1], p->way[0], p->way[1]);
        const bool front = p->way[0] < -0.5;
        CHECK((p->met_from >> side_of(1, 0) & 1) == front, "water along +x meets the wrong side");
    }
    CHECK(length > 9.9999 && length < 10.0001, "%g m of outline", length);
    lom_free_hits(&hits);
}

static void one_stands_in_the_lee_of_the_other(void)
{
    struct lom_hits hits = find(true);
    int met[2] = { 0, 0 }, both = 0;
    for (size_t i = 0; i < hits.count; i++) {
        const struct lom_hit_place *p = &hits.places[i];
        if (p->way[0] > -0.5)
            continue;
        met[p->place[0] > 1] += (int)(p->met_from >> side_of(1, 0) & 1);
        both += p->place[0] > 1 && p->met_from != 0;
    }
    CHECK(met[0] > 0 && met[1] == 0 && both > 0, "%d pieces before, %d in the lee, %d met from aside", met[0], met[1],
          both);
    lom_free_hits(&hits);
}

/* All drops at many times: when they were born, how high they rise, and where. */
struct seen {
    double births[64]; /* by parts of the period */
    double highest, low[2], high[2];
    int count;
};

static struct seen watch(const struct lom_hits *hits, double period, double from, double to)
{
    static lom_particle drops[DROPS];
    struct seen seen = { .highest = -1e9, .low = { 1e9, 1e9 }, .high = { -1e9, -1e9 } };
    double low[3], high[3];
    lom_bound_hits(hits, &emitter, 1, low, high);
    for (double time = from; time < to; time += 1.0 / 16) {
        lom_place_hits(hits, &emitter, 1, time, 0, DROPS, drops);
        for (int i = 0; i < DROPS; i++) {
            const lom_particle *p = &drops[i];
            if (!(p->alpha > 0))
                continue;
            const double birth = (time - p->share) / period, part = birth - lom_double_floor(birth);
            seen.births[lom_int_of(part * 64)] += p->alpha;
            seen.highest = lom_larger(seen.highest, p->place[1]);
            seen.count++;
            for (int k = 0; k < 3; k++)
                CHECK(p->place[k] >= low[k] && p->place[k] <= high[k], "drop %d leaves its bounds", i);
            for (int k = 0; k < 2; k++) {
                seen.low[k] = lom_smaller(seen.low[k], p->place[2 * k]);
                seen.high[k] = lom_larger(seen.high[k], p->place[2 * k]);
            }
        }
    }
    return seen;
}

/* The time within the period about which births lie, and the share of them within a quarter of the period of it. */
static double middle_of(const struct seen *seen, double period, double *share)
{
    double c = 0, s = 0, all = 0, near = 0;
    for (int i = 0; i < 64; i++) {
        c += seen->births[i] * lom_double_cos(lom_two_pi * (i + 0.5) / 64);
        s += seen->births[i] * lom_double_sin(lom_two_pi * (i + 0.5) / 64);
        all += seen->births[i];
    }
    const double angle = lom_double_atan2(s, c);
    for (int i = 0; i < 64; i++)
        near += lom_double_cos(lom_two_pi * (i + 0.5) / 64 - angle) > 0 ? seen->births[i] : 0;
    *share = near / all;
    return period * angle / lom_two_pi;
}

/* A wave of one length along +x: its crest is at the front, x = 2, when its phase is 0 there. */
static void spray_comes_with_the_crest(void)
{
    waves = (lom_water_waves){
        .kind = LOM_WAVES_GERSTNER, .height = 3, .length = { 40, 40 }, .count = 1, .steepness = 0.5, .seed = 9
    };
    lom_trochoid made[LOM_MAX_WAVES];
    lom_error error = { 0 };
    CHECK(lom_make_trochoids(&waves, made, NULL, &error) == 1, "%s", error.text);
    const lom_trochoid wave = made[0];
    struct lom_hits hits = find(false);
    const double period = lom_two_pi / wave.rate, from = 100 * period;
    const struct seen seen = watch(&hits, period, from, from + 2 * period);
    const double crest = (wave.number * wave.direction[0] * 2 + lom_two_pi * wave.phase) / wave.rate;
    double share, late = (middle_of(&seen, period, &share) - crest) / period;
    late -= lom_double_floor(late + 0.5);
    CHECK(seen.count > 1000 && late * period > -0.15 && late * period < 0.15, "%d drops %g s after the crest",
          seen.count, late * period);
    CHECK(share == 1, "%g of the drops are born between crests", 1 - share);
    CHECK(seen.high[0] < 2.01, "the lee throws at x = %g", seen.high[0]);
    const double a = wave.amplitude, u = a * wave.rate, most = a + u * u / (2 * gravity);
    CHECK(seen.highest - 1 <= most && seen.highest - 1 > 0.7 * most, "drops rise %g m, by energy %g", seen.highest - 1,
          most);
    lom_free_hits(&hits);
}

static void surf_is_met_as_it_stands(void)
{
    waves = (lom_water_waves){ .kind = LOM_WAVES_NONE };
    surf = (lom_water_surf){ .height = 2, .period = 7, .direction = lom_pi / 2 };
    struct lom_hits hits = find(false);
    double best = -1, highest = -1e9, share;
    for (int i = 0; i < 700; i++) {
        const double h = lom_water_motion_at(&hits.trains, 3, -3.5, 0.01 * i).height;
        best = h > highest ? 0.01 * i : best;
        highest = lom_larger(highest, h);
    }
    CHECK(highest > 0.8 && highest < 1.5, "a crest of %g m", highest);
    const struct seen seen = watch(&hits, 7, 700, 714);
    double late = (middle_of(&seen, 7, &share) - best) / 7;
    late -= lom_double_floor(late + 0.5);
    CHECK(seen.count > 1000 && late > -0.05 && late < 0.05, "%d drops %g s after the crest", seen.count, 7 * late);
    CHECK(seen.high[1] < -3.4 && share > 0.99, "drops to z = %g, %g near the crest", seen.high[1], share);
    lom_free_hits(&hits);
    surf.height = 0;
}

static void a_river_is_met_at_all_times(void)
{
    waves = (lom_water_waves){ .kind = LOM_WAVES_FLOW, .speed = 4 };
    struct lom_hits hits = find(false);
    const struct lom_water_motion water = lom_water_motion_at(&hits.trains, 2, -2, 5);
    CHECK(water.velocity[0] > 3.8 && water.velocity[0] < 4.1 && water.height == 0, "%g m/s", water.velocity[0]);
    const struct seen seen = watch(&hits, 1, 50, 52);
    for (int i = 0; i < 64; i++)
        CHECK(seen.births[i] > 0, "no drop is born at %d / 64 s", i);
    const double most = water.velocity[0] * water.velocity[0] / (2 * gravity);
    CHECK(seen.high[0] < 2.01 && seen.highest - 1 < most && seen.highest - 1 > 0.7 * most, "%g m, by energy %g",
          seen.highest - 1, most);
    lom_free_hits(&hits);
}

static void calm_water_throws_at_what_moves_alone(void)
{
    waves = (lom_water_waves){ .kind = LOM_WAVES_NONE };
    struct lom_hits hits = find(false);
    CHECK(watch(&hits, 1, 10, 12).count == 0, "calm water throws drops");
    lom_free_hits(&hits);
    motion[1] = -5;
    hits = find(false);
    const struct seen seen = watch(&hits, 1, 0, 1);
    const double most = 25 / (2 * gravity);
    CHECK(seen.count > 1000 && seen.highest - 1 < most && seen.highest - 1 > 0.7 * most, "%d drops, %g m", seen.count,
          seen.highest - 1);
    CHECK(seen.low[0] >= 2 - 1e-9 && seen.high[0] <= 4 + 1e-9, "drops from x = %g to %g", seen.low[0], seen.high[0]);
    lom_free_hits(&hits);
    motion[1] = 0.5;
    hits = find(false);
    CHECK(watch(&hits, 1, 0, 1).count == 0, "a slow boat throws drops");
    lom_free_hits(&hits);
    motion[1] = 0;
}

/* Of what the transforms and the direct sum of all waves say the strongest ones are most: correlation and spread. */
static void a_sea_is_met_by_its_strongest_waves(void)
{
    lom_error error = { 0 };
    waves = (lom_water_waves){
        .kind = LOM_WAVES_SEA, .wind_speed = 14, .fetch = 2e5, .height_scale = 1, .cascades = 2, .size = 64, .seed = 3
    };
    const lom_sea_desc desc = lom_scene_sea(&waves);
    lom_device *device = lom_open_device(NULL);
    lom_sea *sea = lom_create_sea(&desc, device, &error);
    struct lom_hits hits = find(false);
    double both = 0, own = 0, all = 0;
    for (int t = 0; t < 8; t++) {
        lom_sea_moment *moment = lom_freeze_sea(sea, 7.3 * t, &error);
        for (int i = 0; i < 60; i++) {
            const double x = 13.7 * i, z = 29.1 * (i % 7);
            const double h = lom_evaluate_sea(moment, -1, x, z).h,
                         near = lom_water_motion_at(&hits.trains, x, z, 7.3 * t).height;
            both += h * near;
            own += near * near;
            all += h * h;
        }
        lom_free_sea_moment(moment);
    }
    const double alike = both / lom_double_sqrt(own * all);
    CHECK(alike > 0.9 && own < all && own > 0.8 * all, "correlation %g, %g of the variance", alike, own / all);
    lom_free_hits(&hits);
    lom_free_sea(sea);
    lom_close_device(device);
}

int main(int argc, char **argv)
{
    RUN(the_waterline_is_the_outline);
    RUN(one_stands_in_the_lee_of_the_other);
    RUN(spray_comes_with_the_crest);
    RUN(surf_is_met_as_it_stands);
    RUN(a_river_is_met_at_all_times);
    RUN(calm_water_throws_at_what_moves_alone);
    RUN(a_sea_is_met_by_its_strongest_waves);
    return check_result();
}
