/* The curl of a plunging breaker: how far the water of a wave is from where a spilling one has it, as a function of
 * its place in the wave and of the time since the wave began to break.
 *
 * In the frame of the wave, x metres ahead of its crest: first the front is steepened, the crest runs ahead of the
 * wave at the speed v until the front, F long, is steep (time < 0). Then the crest is a lip in free fall, thrown ahead
 * at v: after s seconds it is v s ahead of where it left and has fallen g s^2 / 2; the upper side of the jet is the
 * parabola of the same fall, the lower side is thinner towards the lip, and the face below it is hollow. After t =
 * sqrt(2 h / g), h the height of the crest over the trough, the lip lands there. Then the hollow closes within t and a
 * bore goes on, which becomes the spilling wave in some more t.
 *
 * v = 0.7 of the speed of the wave: jets are as fast as about 1.7 waves over the ground (Peregrine, Cokelet, McIver
 * 1980). Invariant: continuous in place and time, 0 half a wave from the crest, before the front steepens and after
 * the bore. */
#ifndef LOM_WAVES_SURF_CURL_H
#define LOM_WAVES_SURF_CURL_H

static const float lom_curl_speed = 0.7f;      /* v, in speeds of the wave */
static const float lom_curl_steep = 0.85f;     /* of F: by how much the crest is ahead when the lip leaves */
static const float lom_curl_back = 1.4f;       /* radians behind the crest that are drawn out when it runs ahead */
static const float lom_curl_roof = 0.45f;      /* radians behind it that are drawn out to the jet's upper side */
static const float lom_curl_below = 0.5f;      /* of the front's phase: what becomes its lower side */
static const float lom_curl_hollow = 0.2f;     /* of v s: how far the face is hollowed out */
static const float lom_curl_thickness = 0.08f; /* of h: by how much the jet is thicker in its middle */
static const float lom_curl_foot = 0.4f;       /* of F: how far a bore runs ahead at its foot at least */
static const float lom_curl_bore = 10;         /* in t: the time in which it becomes a spilling wave */

/* A wave at a place: what the curl depends on. */
struct lom_curl_wave {
    double number, speed;     /* rad/m, m/s */
    double ahead;             /* radians from the crest, ahead positive, -pi .. pi */
    double span;              /* radians from the crest to the trough ahead */
    double height, top, drop; /* metres: of the spilling wave there; of the crest over the level, over the trough */
    double age;               /* seconds since the lip left, negative before */
};
/* Metres forwards and upwards from the spilling wave. */
void lom_surf_curl(const struct lom_curl_wave *wave, double shift[2]);

#endif
