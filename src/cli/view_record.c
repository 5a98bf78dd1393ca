/* The camera's way, recorded. In: the eye while it moves. Out: a new scene file: the old one's text with this camera and
 * its key frames. Invariant: no file is overwritten; the new one has been read before it is written, and its camera is
 * where the eye was. */
#include "base/numbers.h"
#include "view.h"

#include "paths.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double seconds_between_keys = 0.25;

/* ---- the way ---- */

/* A place of the scene as its file has it; what follows an entity is in the entity's coordinates. */
static lom_vec3 place_in_file(const struct lom_view *view, const lom_scene *scene, lom_vec3 place)
{
    return view->eye.followed != 0 ? place : lom_place_in_file(scene, place);
}

static void add_key(struct lom_view *view)
{
    struct lom_recording *r = &view->recording;
    lom_camera camera = view->camera;
    if (r->count == r->room || view->eye.kind == LOM_EYE_SCENE)
        return;
    lom_eye_camera(&view->eye, &camera);
    double time = r->start + r->seconds;
    if (r->count == 0 || time > r->keys[r->count - 1].time)
        r->keys[r->count++] = (lom_camera_key){ true,
                                                time,
                                                place_in_file(view, view->scene, camera.position),
                                                place_in_file(view, view->scene, camera.target),
                                                view->eye.degrees,
                                                view->eye.height };
}

void lom_step_recording(struct lom_view *view, double seconds)
{
    struct lom_recording *r = &view->recording;
    if (!r->runs)
        return;
    r->seconds += seconds;
    view->is_unpainted = true;
    double last = r->count != 0 ? r->keys[r->count - 1].time - r->start : -1;
    if (r->seconds >= last + seconds_between_keys - 1e-9)
        add_key(view);
}

/* ---- the file ---- */

/* Whether a line of TOML begins a table that is taken out: [camera] and what is in it. */
static bool begins_camera(const char *line, size_t length)
{
    size_t i = strspn(line, " \t");
    size_t brackets = strspn(line + i, "[");
    i += brackets;
    i += strspn(line + i, " \t");
    if (i >= length || brackets == 0 || brackets > 2 || strncmp(line + i, "camera", 6) != 0)
        return false;
    return strchr(" \t].", line[i + 6]) != NULL;
}

/* Whether it begins any table: brackets around nothing but a dotted name. */
static bool begins_table(const char *line, size_t length)
{
    static const char name[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.\"' \t";
    size_t i = strspn(line, " \t");
    size_t brackets = strspn(line + i, "[");
    size_t inside = strspn(line + i + brackets, name), end = i + brackets + inside;
    return (brackets == 1 || brackets == 2) && inside > 0 && end < length && strspn(line + end, "]") == brackets;
}

static void copy_without_camera(FILE *out, const char *text)
{
    bool is_camera = false;
    while (*text != '\0') {
        size_t length = strcspn(text, "\n");
        length += text[length] == '\n';
        if (begins_table(text, length))
            is_camera = begins_camera(text, length);
        if (!is_camera)
            fwrite(text, 1, length, out);
        text += length;
    }
}

static void print_vector(FILE *out, const char *name, lom_vec3 v)
{
    char x[32], y[32], z[32];
    lom_print_double(x, v.x);
    lom_print_double(y, v.y);
    lom_print_double(z, v.z);
    fprintf(out, "%s = [%s, %s, %s]\n", name, x, y, z);
}

static void print_number(FILE *out, const char *name, double value)
{
    char text[32];
    lom_print_double(text, value);
    fprintf(out, "%s = %s\n", name, text);
}

static void print_projection(FILE *out, const lom_camera *camera, double height)
{
    if (camera->projection == LOM_PROJECTION_PERSPECTIVE)
        return;
    const bool is_oblique = camera->projection == LOM_PROJECTION_OBLIQUE;
    fprintf(out, "projection = \"%s\"\n", is_oblique ? "oblique" : "orthographic");
    print_number(out, "height", height);
    print_number(out, "far", camera->far_plane);
    if (!is_oblique)
        return;
    print_number(out, "foreshortening", camera->foreshortening);
    print_number(out, "receding_angle", camera->receding_angle / lom_radians_per_degree);
}

static void print_camera(FILE *out, const struct lom_view *view)
{
    const struct lom_recording *r = &view->recording;
    const lom_camera_key *first = &r->keys[0];
    fprintf(out, "\n[camera] # recorded by `lom view`\n");
    if (view->eye.followed != 0)
        fprintf(out, "follow = \"%s\"\nperson = \"%s\"\n", view->scene->entities[view->eye.followed - 1].name,
                view->eye.kind == LOM_EYE_FIRST ? "first" : "third");
    print_vector(out, "position", first->position);
    print_vector(out, "target", first->target);
    print_number(out, "field_of_view", first->field_of_view);
    print_number(out, "near", view->scene->camera.near_plane);
    print_projection(out, &view->scene->camera, first->height);
    fprintf(out, "interpolation = \"smooth\"\n");
    for (size_t i = 0; i < r->count; i++) {
        fprintf(out, "\n[[camera.key]]\n");
        print_number(out, "time", r->keys[i].time);
        print_vector(out, "position", r->keys[i].position);
        print_vector(out, "target", r->keys[i].target);
        print_number(out, "field_of_view", r->keys[i].field_of_view);
        if (view->scene->camera.projection != LOM_PROJECTION_PERSPECTIVE)
            print_number(out, "height", r->keys[i].height);
    }
}

/* The text of the new scene, from malloc; NULL on failure. */
static char *make_text(const struct lom_view *view, size_t *size, lom_error *error)
{
    char *text = NULL;
    lom_bytes old = lom_read_file(view->path, (size_t)1 << 26, error);
    if (old.data == NULL)
        return NULL;
    FILE *out = open_memstream(&text, size);
    if (out != NULL) {
        copy_without_camera(out, (const char *)old.data);
        print_camera(out, view);
        fclose(out);
    }
    lom_release(old.data);
    if (text == NULL)
        lom_fail(error, LOM_ERROR_MEMORY, "There is no memory for a scene.");
    return text;
}

/* Whether the text is a scene whose camera is at every key where the eye was. */
static bool check_text(const struct lom_view *view, const char *text, size_t size, const char *name, lom_error *error)
{
    const struct lom_recording *r = &view->recording;
    lom_scene *scene = lom_decode_scene(text, size, name, NULL, 0, error);
    bool same =
        scene != NULL && scene->camera.key_count == r->count && scene->entity_count == view->scene->entity_count;
    for (size_t i = 0; same && i < r->count; i++) {
        const lom_vec3 position = place_in_file(view, scene, scene->camera.keys[i].position);
        const lom_vec3 target = place_in_file(view, scene, scene->camera.keys[i].target);
        same = memcmp(&position, &r->keys[i].position, sizeof position) == 0 &&
               memcmp(&target, &r->keys[i].target, sizeof target) == 0;
    }
    if (scene != NULL && !same)
        lom_fail(error, LOM_ERROR_INPUT, "%s: its camera cannot be replaced: it is not in tables of its own.",
                 view->path);
    lom_free_scene(scene);
    return same;
}

/* Beside the scene, since its files are named from there. */
static void write_scene(struct lom_view *view)
{
    lom_error error = { .code = LOM_OK };
    size_t size = 0;
    const struct lom_recording *r = &view->recording;
    char *name = lom_new_name(view->path, "toml", &error);
    char *text = name != NULL ? make_text(view, &size, &error) : NULL;
    if (text != NULL && check_text(view, text, size, name, &error) && lom_write_file(name, text, size, &error)) {
        lom_tell_view(view, false, "written: %s, a camera with %zu key frames from %.2f to %.2f s", name, r->count,
                      r->keys[0].time, r->keys[r->count - 1].time);
        printf("%s: %zu key frames\n", name, r->count);
        fflush(stdout);
    } else {
        lom_tell_view(view, true, "%s", error.text);
    }
    free(text);
    lom_release(name);
}

void lom_toggle_recording(struct lom_view *view)
{
    enum { MOST = 16384 };
    struct lom_recording *r = &view->recording;
    lom_error error = { .code = LOM_OK };
    view->is_unpainted = true;
    if (r->runs) {
        add_key(view);
        r->runs = false;
        write_scene(view);
        return;
    }
    if (r->keys == NULL)
        r->keys = lom_allocate(MOST, sizeof *r->keys, &error);
    if (r->keys == NULL) {
        lom_tell_view(view, true, "%s", error.text);
        return;
    }
    lom_use_eye(view);
    *r = (struct lom_recording){ .runs = true, .start = view->time, .room = MOST, .keys = r->keys };
    add_key(view);
    lom_tell_view(view, false, "the camera's path is recorded; g again writes it.");
}

char *lom_new_name(const char *stem, const char *ending, lom_error *error)
{
    size_t length = strlen(stem), extension = strlen(lom_path_extension(stem));
    int whole = (int)(length - (extension > 0 ? extension + 1 : 0));
    for (int n = 1; n < 100000; n++) {
        char *name = lom_path_print(error, "%.*s-%d.%s", whole, stem, n, ending);
        if (name == NULL || access(name, F_OK) != 0)
            return name;
        lom_release(name);
    }
    lom_fail(error, LOM_ERROR_FILE, "%s: there is no new name of the kind STEM-N.%s left.", stem, ending);
    return NULL;
}
