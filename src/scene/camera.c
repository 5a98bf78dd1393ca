/* The camera at a time. In: the scene's key frames and a time. Out: position, target, angle. Invariant: the result
 * depends on the time alone, so any frame can be made without the ones before it. */
#include <lom/scene.h>

static const double radians_per_degree = 0.017453292519943295;

typedef struct sample { /* what is interpolated: 0..2 position, 3..5 target, 6 field of view */
    double v[7];
} sample;

static sample key_sample(const lom_camera_key *key)
{
    return (sample){ { key->position.x, key->position.y, key->position.z, key->target.x, key->target.y, key->target.z,
                       key->field_of_view } };
}

static double interval(const lom_camera *camera, size_t i)
{
    return camera->keys[i + 1].time - camera->keys[i].time;
}

/* Slope of the straight line from key i to the next. */
static sample chord(const lom_camera *camera, size_t i)
{
    sample a = key_sample(&camera->keys[i]), b = key_sample(&camera->keys[i + 1]);
    for (int n = 0; n < 7; n++)
        a.v[n] = (b.v[n] - a.v[n]) / interval(camera, i);
    return a;
}

/* Slope at key i of the parabola through it and its neighbours: with intervals h0, h1 and chords d0, d1 on both sides
 * it is (h1 d0 + h0 d1) / (h0 + h1) in the middle (Newton's divided differences), and 2 d0 - that at an end. */
static sample slope(const lom_camera *camera, size_t i)
{
    size_t last = camera->key_count - 1;
    if (last == 1)
        return chord(camera, 0);
    size_t middle = i == 0 ? 1 : i == last ? last - 1 : i;
    sample d0 = chord(camera, middle - 1), d1 = chord(camera, middle);
    double h0 = interval(camera, middle - 1), h1 = interval(camera, middle);
    for (int n = 0; n < 7; n++) {
        double inner = (h1 * d0.v[n] + h0 * d1.v[n]) / (h0 + h1);
        double outer = i == 0 ? d0.v[n] : d1.v[n];
        d0.v[n] = i == middle ? inner : 2 * outer - inner;
    }
    return d0;
}

/* Cubic Hermite basis at s in 0..1 of an interval of length h. */
static sample smooth(const lom_camera *camera, size_t i, double s)
{
    sample a = key_sample(&camera->keys[i]), b = key_sample(&camera->keys[i + 1]);
    sample da = slope(camera, i), db = slope(camera, i + 1);
    double h = interval(camera, i), r = 1 - s;
    for (int n = 0; n < 7; n++)
        a.v[n] = r * r * (1 + 2 * s) * a.v[n] + s * s * (3 - 2 * s) * b.v[n] +
                 h * (s * r * r * da.v[n] - s * s * r * db.v[n]);
    return a;
}

static sample linear(const lom_camera *camera, size_t i, double s)
{
    sample a = key_sample(&camera->keys[i]), b = key_sample(&camera->keys[i + 1]);
    for (int n = 0; n < 7; n++)
        a.v[n] = (1 - s) * a.v[n] + s * b.v[n];
    return a;
}

/* The last of the keys that are not after time, by bisection; time is not before the first. */
static size_t find_interval(const lom_camera *camera, double time)
{
    size_t low = 0, high = camera->key_count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (camera->keys[middle].time <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static sample path_sample(const lom_camera *camera, double time)
{
    size_t last = camera->key_count - 1;
    if (!(time > camera->keys[0].time))
        return key_sample(&camera->keys[0]);
    if (time >= camera->keys[last].time)
        return key_sample(&camera->keys[last]);
    size_t i = find_interval(camera, time);
    double s = (time - camera->keys[i].time) / interval(camera, i);
    return camera->interpolation == LOM_INTERPOLATION_SMOOTH ? smooth(camera, i, s) : linear(camera, i, s);
}

lom_camera_view lom_scene_camera_at(const lom_scene *scene, double time)
{
    const lom_camera *camera = &scene->camera;
    lom_camera_view view = { camera->position, camera->target, camera->up, camera->field_of_view, camera->near_plane };
    if (camera->key_count == 0)
        return view;
    lom_float_state state;
    lom_enter_float_state(&state);
    sample at = path_sample(camera, time);
    lom_leave_float_state(&state);
    view.position = (lom_vec3){ at.v[0], at.v[1], at.v[2] };
    view.target = (lom_vec3){ at.v[3], at.v[4], at.v[5] };
    double least = 0.01 * radians_per_degree, greatest = 179 * radians_per_degree; /* a smooth curve may overshoot */
    view.field_of_view = at.v[6] < least ? least : at.v[6] > greatest ? greatest : at.v[6];
    return view;
}
