/* Proves of the curl of a plunging breaker: its lip is in free fall and lands in the trough ahead of it after sqrt(2 h / g);
 * it is continuous in place and time, 0 half a wave from the crest, before its front steepens and when its bore has
 * become the wave again; the jet does not cross itself before it lands; the face is hollow; it is finite for any wave. */
#include "check.h"
#include "waves/surf.h"
#include "waves/surf_curl.h"

static const double pi = 3.141592653589793, gravity = 9.80665;

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

/* A wave of this height whose front is a cosine from its crest to its trough, whose back falls evenly to the last one. */
static struct lom_curl_wave wave_at(double ahead, double age)
{
    struct lom_curl_wave w = { .number = 0.17, .speed = 5, .ahead = ahead, .span = 1.9, .drop = 2, .age = age };
    w.height = ahead < 0        ? 1.2 + 2 * ahead / (2 * pi - w.span)
               : ahead < w.span ? 0.2 + lom_double_cos(pi * ahead / w.span)
                                : -0.8 + 2 * (ahead - w.span) / (2 * pi - w.span);
    return w;
}

static void place_at(double ahead, double age, double place[2])
{
    struct lom_curl_wave w = wave_at(ahead, age);
    lom_surf_curl(&w, place);
    place[0] += ahead / w.number;
    place[1] += w.height;
}

static double flight(void)
{
    return lom_double_sqrt(2 * 2 / gravity);
}

static void the_lip_is_in_free_fall_and_lands_in_the_trough(void)
{
    double first[2], place[2];
    place_at(0, 0, first);
    CHECK(magnitude(first[1] - 1.2) < 1e-12, "leaves at %g m", first[1]);
    for (int i = 1; i <= 40; i++) {
        const double t = flight() * i / 40;
        place_at(0, t, place);
        CHECK(magnitude(place[0] - first[0] - (double)lom_curl_speed * 5 * t) < 1e-12, "%g s: %g m ahead", t, place[0]);
        CHECK(magnitude(place[1] - first[1] + gravity * t * t / 2) < 1e-12, "%g s: %g m high", t, place[1]);
    }
    CHECK(magnitude(place[1] + 0.8) < 1e-12, "lands at %g m", place[1]);
}

static void it_is_continuous_in_place_and_time(void)
{
    double most = 0, latest = 0;
    for (double age = -4; age < 10; age += 0.05)
        for (int i = -2000; i < 2000; i++) {
            double a[2], b[2], later[2];
            const double ahead = pi * i / 2000;
            place_at(ahead, age, a);
            place_at(ahead + pi / 2000, age, b);
            place_at(ahead, age + 1e-4, later);
            const double along = magnitude(b[0] - a[0]) + magnitude(b[1] - a[1]);
            const double by = magnitude(later[0] - a[0]) + magnitude(later[1] - a[1]);
            most = along > most ? along : most;
            latest = by > latest ? by : latest;
        }
    CHECK(most < 20 * pi / 2000 / 0.17, "%g m from place to place", most);
    CHECK(latest < 30e-4, "%g m in 0.1 ms", latest);
}

static void it_is_nothing_far_from_the_crest_before_and_after(void)
{
    double shift[2];
    for (double age = -20; age < 40; age += 0.1)
        for (int i = -8; i <= 8; i++) {
            const struct lom_curl_wave w = wave_at(pi * i / 8, age);
            lom_surf_curl(&w, shift);
            const bool out = i == -8 || i == 8 || age < -4 || age > 11 * flight() + 0.01;
            CHECK(!out || (shift[0] == 0 && shift[1] == 0), "%d at %g s: %g %g", i, age, shift[0], shift[1]);
        }
}

/* Whether the segments a b and c d cross. */
static bool cross(const double a[2], const double b[2], const double c[2], const double d[2])
{
    const double *p[4] = { a, b, c, d };
    double side[4];
    for (int i = 0; i < 4; i++) {
        const double *from = p[i < 2 ? 2 : 0], *to = p[i < 2 ? 3 : 1];
        side[i] = (to[0] - from[0]) * (p[i][1] - from[1]) - (to[1] - from[1]) * (p[i][0] - from[0]);
    }
    return side[0] * side[1] < -1e-18 && side[2] * side[3] < -1e-18;
}

enum { PLACES = 500 };

static void the_jet_does_not_cross_itself_before_it_lands(void)
{
    static double line[PLACES][2];
    for (int n = -20; n <= 19; n++) {
        const double age = flight() * n / 20;
        int crossings = 0;
        for (int i = 0; i < PLACES; i++)
            place_at(-1.5 + 4.5 * i / PLACES, age, line[i]);
        for (int i = 0; i + 1 < PLACES; i++)
            for (int k = i + 2; k + 1 < PLACES; k++)
                crossings += cross(line[i], line[i + 1], line[k], line[k + 1]);
        CHECK(crossings == 0, "%g s: crosses itself %d times", age, crossings);
    }
}

/* Some of the face is behind what is above it, and the lip is ahead of all of the face. */
static void the_face_is_hollow(void)
{
    double lip[2], place[2], back = 1e9;
    place_at(0, 0.9 * flight(), lip);
    for (double ahead = 0; ahead < 1.2; ahead += 0.01) {
        place_at(ahead, 0.9 * flight(), place);
        back = place[0] < back ? place[0] : back;
    }
    CHECK(lip[0] - back > 1.5, "hollow of %g m", lip[0] - back);
}

static void it_is_finite_for_any_wave(void)
{
    static const double numbers[] = { 1e-4, 0.2, 40 }, heights[] = { 0, 1e-9, 1, 60 }, spans[] = { 0.05, 1.5, 3.14 };
    for (int i = 0; i < 3 * 4 * 3; i++)
        for (double age = -1e6; age < 2e6; age = age < -1e-3 ? age / 10 : age < 1e-3 ? 1e-3 : age * 10)
            for (int k = -4; k <= 4; k++) {
                struct lom_curl_wave w = { .number = numbers[i % 3], .span = spans[i / 12], .age = age };
                double shift[2];
                w.speed = 3 / w.number;
                w.drop = heights[i / 3 % 4];
                w.height = w.drop / 2;
                w.ahead = pi * k / 4;
                lom_surf_curl(&w, shift);
                CHECK(magnitude(shift[0]) < 1e6 && magnitude(shift[1]) < 100, "%g m, %g s: %g %g", w.drop, age,
                      shift[0], shift[1]);
            }
}

int main(int argc, char **argv)
{
    RUN(the_lip_is_in_free_fall_and_lands_in_the_trough);
    RUN(it_is_continuous_in_place_and_time);
    RUN(it_is_nothing_far_from_the_crest_before_and_after);
    RUN(the_jet_does_not_cross_itself_before_it_lands);
    RUN(the_face_is_hollow);
    RUN(it_is_finite_for_any_wave);
    return check_result();
}
