/* Particles: 60 000 drops of one fall, one thread: placed at a moment, made into sprites, put in the order of blending,
 * over 30 moments: make bench-particles. Out: a table of the least processor time, of drops that begin anywhere and of
 * drops in jets. */
#include "spray/spray.h"

#include <stdio.h>
#include <time.h>

enum { COUNT = 60000, MOMENTS = 30, STEPS = 3 };

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

struct room {
    lom_particle *particles;
    struct lom_sprite *sprites;
    float *depth;
    uint32_t *order, *scratch;
};

static void run_moment(const lom_spray *spray, const struct lom_spray_view *view, double time, struct room *room,
                       double least[STEPS])
{
    lom_emitter emitter = lom_spray_emitter(spray);
    double at[STEPS + 1];
    at[0] = now_ms();
    lom_place_particles(&emitter, time, room->particles, NULL);
    at[1] = now_ms();
    lom_make_sprites(spray, view, room->particles, emitter.count, room->sprites, room->depth);
    at[2] = now_ms();
    lom_order_particles(room->depth, emitter.count, room->order, room->scratch);
    at[3] = now_ms();
    for (int i = 0; i < STEPS; i++)
        least[i] = at[i + 1] - at[i] < least[i] ? at[i + 1] - at[i] : least[i];
}

int main(void)
{
    struct room room = { .particles = lom_allocate(COUNT, sizeof(lom_particle), NULL),
                         .sprites = lom_allocate(COUNT, sizeof(struct lom_sprite), NULL),
                         .depth = lom_allocate(COUNT, sizeof(float), NULL),
                         .order = lom_allocate(COUNT, sizeof(uint32_t), NULL),
                         .scratch = lom_allocate(COUNT, sizeof(uint32_t), NULL) };
    if (room.particles == NULL || room.sprites == NULL || room.depth == NULL || room.order == NULL ||
        room.scratch == NULL)
        return 2;
    lom_spray spray = { .count = COUNT,
                        .from = { -3, 18, 0 },
                        .to = { 3, 18, 0 },
                        .velocity = { 0, 0, 2.5 },
                        .spread = 0.3,
                        .drag = 0.3,
                        .life = lom_fall_time(18, 0.3),
                        .size = { 0.06, 0.2 },
                        .stretch = 0.06,
                        .color = { 1, 1, 1 },
                        .opacity = 0.3,
                        .soft = 0.4,
                        .jet_time = 0.4,
                        .jet_width = 0.4 };
    lom_vec3 eye = { 10, 2, 40 }, target = { 0, 9, 0 }, up = { 0, 1, 0 };
    struct lom_spray_view view = { .projection = lom_perspective(0.8, 16.0 / 9, 0.1),
                                   .view = lom_look_at(eye, target, up),
                                   .eye = eye,
                                   .near_plane = 0.1,
                                   .width = 1280,
                                   .height = 720,
                                   .to_light = { 0.6, 0.8, 0 } };
    printf("| 60 000 drops | place, ms | sprites, ms | order, ms |\n|---|---|---|---|\n");
    for (int jets = 0; jets <= 24; jets += 24) {
        double least[STEPS] = { 1e30, 1e30, 1e30 };
        spray.jets = jets;
        for (int moment = 0; moment < MOMENTS; moment++)
            run_moment(&spray, &view, 10 + moment / 30.0, &room, least);
        printf("| %s | %.2f | %.2f | %.2f |\n", jets == 0 ? "anywhere on the lip" : "in 24 jets", least[0], least[1],
               least[2]);
    }
    lom_release(room.particles);
    lom_release(room.sprites);
    lom_release(room.depth);
    lom_release(room.order);
    lom_release(room.scratch);
    return 0;
}
