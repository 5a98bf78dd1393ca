/* Proves what a drop is on the screen: a sprite that faces the eye, drawn out along its way, upright where it flies at
 * the eye, with the light of what is thinner than a pixel; and that none is made of a drop that is not in view. */
#include "check.h"
#include "spray/spray.h"

#include <math.h>

enum { HEIGHT = 100 };

static const lom_spray spray = { .size = { 0.5, 0.5 }, .opacity = 0.8, .stretch = 0.5 };

/* The sprite of a drop at a place, with a velocity, seen from (0, 0, 10) towards -z; false: there is none. */
static bool sprite_of(const double place[3], const double velocity[3], struct lom_sprite *sprite)
{
    const lom_vec3 eye = { 0, 0, 10 }, target = { 0, 0, 0 }, up = { 0, 1, 0 };
    const struct lom_spray_view view = { .projection = lom_perspective(1, 1.5, 0.1),
                                         .view = lom_look_at(eye, target, up),
                                         .eye = eye,
                                         .near_plane = 0.1,
                                         .width = 150,
                                         .height = HEIGHT,
                                         .to_light = { 0, 1, 0 } };
    const lom_particle drop = { .place = { place[0], place[1], place[2] },
                                .velocity = { velocity[0], velocity[1], velocity[2] },
                                .share = 0.5,
                                .alpha = 1 };
    float depth[1];
    struct lom_sprite_reach reach = lom_make_sprites(&spray, &view, &drop, 1, sprite, depth);
    CHECK((reach.seen == 1) == (depth[0] > 0), "%zu are seen, the depth is %g", reach.seen, (double)depth[0]);
    return reach.seen == 1;
}

static bool is_vector(const float v[3], double x, double y, double z)
{
    return fabs((double)v[0] - x) < 1e-5 && fabs((double)v[1] - y) < 1e-5 && fabs((double)v[2] - z) < 1e-5;
}

/* In the middle of the view: half its length is its radius and a half of stretch times its speed across the view, and as
 * much less opaque it is. */
static void drops_are_drawn_out_along_their_way(void)
{
    static const double middle[3] = { 0, 0, 0 };
    static const double ways[][3] = { { 4, 0, 0 }, { 0, -2, 0 }, { 3, 4, 0 }, { 4, 0, 7 }, { 0, 0, 5 }, { 0, 0, 0 } };
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        struct lom_sprite s;
        const double *v = ways[i];
        double speed = hypot(v[0], v[1]), x = speed > 0 ? v[0] / speed : 0, y = speed > 0 ? v[1] / speed : 1;
        double half = 0.5 + speed * 0.5 / 2;
        CHECK(sprite_of(middle, v, &s), "way %zu is not in view", i);
        CHECK(is_vector(s.middle, 0, 0, -10), "way %zu lies at %g %g %g", i, (double)s.middle[0], (double)s.middle[1],
              (double)s.middle[2]);
        CHECK(is_vector(s.along, x * half, y * half, 0), "way %zu: %g %g %g", i, (double)s.along[0], (double)s.along[1],
              (double)s.along[2]);
        double across = s.across[0] * x + s.across[1] * y, length = hypot(s.across[0], s.across[1]);
        CHECK(fabs(across) < 1e-6 && fabs(length - 0.5) < 1e-6, "way %zu: %g across by %g", i, length, across);
        CHECK(fabs(s.opacity - 0.8 * 0.5 / half) < 1e-6, "way %zu: opacity %g", i, (double)s.opacity);
    }
}

/* Anywhere: both axes lie across the line to the eye. */
static void sprites_face_the_eye(void)
{
    for (uint64_t i = 0; i < 200; i++) {
        double place[3], velocity[3];
        struct lom_sprite s;
        for (uint64_t k = 0; k < 3; k++) {
            place[k] = 6 * lom_random_uniform(1, 3 * i + k) - 3;
            velocity[k] = 6 * lom_random_uniform(2, 3 * i + k) - 3;
        }
        if (i % 5 == 0) /* straight at the eye, or away from it */
            for (int k = 0; k < 3; k++)
                velocity[k] = ((k == 2 ? 10 : 0) - place[k]) * (i % 2 == 0 ? 0.3 : -0.2);
        CHECK(sprite_of(place, velocity, &s), "drop %d is not in view", (int)i);
        double along = 0, across = 0, both = 0;
        for (int k = 0; k < 3; k++) {
            along += (double)s.along[k] * (double)s.middle[k];
            across += (double)s.across[k] * (double)s.middle[k];
            both += (double)s.along[k] * (double)s.across[k];
        }
        CHECK(fabs(along) < 1e-4 && fabs(across) < 1e-4 && fabs(both) < 1e-5, "drop %d: %g %g %g", (int)i, along,
              across, both);
        CHECK(i % 5 != 0 || s.along[1] > 0, "drop %d hangs head down", (int)i);
    }
}

static void what_is_not_in_view_is_no_sprite(void)
{
    static const double still[3] = { 0, 0, 0 };
    static const double places[][3] = { { 0, 0, 12 },  { 0, 0, 11.2 }, { 20, 0, 0 },
                                        { -20, 0, 0 }, { 0, 9, 0 },    { 0, -9, 0 } };
    struct lom_sprite s;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++)
        CHECK(!sprite_of(places[i], still, &s), "place %zu", i);
    CHECK(sprite_of((double[3]){ 0, 0, 9.7 }, still, &s), "it reaches beyond the near plane");
}

/* Far away it is a pixel wide, and as much of its light is left as a pixel is of it. */
static void thin_drops_keep_their_light(void)
{
    static const double still[3] = { 0, 0, 0 };
    struct lom_sprite s;
    for (double z = -100; z > -500; z *= 2) {
        double pixel = 2 * (10 - z) * tan(0.5) / HEIGHT;
        CHECK(sprite_of((double[3]){ 0, 0, z }, still, &s), "at %g", z);
        double wide = pixel > 0.5 ? pixel : 0.5;
        CHECK(fabs(hypot(s.across[0], s.across[1]) / wide - 1) < 1e-5, "at %g: %g, not %g", z,
              hypot(s.across[0], s.across[1]), wide);
        CHECK(fabs(s.opacity * wide * wide / (0.8 * 0.25) - 1) < 1e-5, "at %g: opacity %g", z, (double)s.opacity);
    }
}

int main(int argc, char **argv)
{
    RUN(drops_are_drawn_out_along_their_way);
    RUN(sprites_face_the_eye);
    RUN(what_is_not_in_view_is_no_sprite);
    RUN(thin_drops_keep_their_light);
    return check_result();
}
