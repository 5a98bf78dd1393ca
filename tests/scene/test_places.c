/* Places of a scene whose terrain is elsewhere: measured from its middle, exactly, what follows an entity untouched,
 * what the file gives no place where the terrain is; and back in the file's coordinates. */
#include "check.h"

#include <lom/scene.h>

static bool is_place(lom_vec3 v, double x, double y, double z)
{
    return v.x == x && v.y == y && v.z == z;
}

static lom_scene *decode(const char *text)
{
    static const char map[] = "P5 2 2 255\nabcd";
    lom_error error = { .code = LOM_OK };
    char path[64] = "/tmp/lom-places-XXXXXX", whole[4096];
    int file = mkstemp(path);
    FILE *out = file >= 0 ? fdopen(file, "wb") : NULL;
    lom_scene *scene = NULL;
    if (out != NULL) {
        fwrite(map, 1, sizeof map - 1, out);
        fclose(out);
        snprintf(whole, sizeof whole, text, path, path);
        scene = lom_decode_scene(whole, strlen(whole), "scene.toml", NULL, 0, &error);
        remove(path);
    }
    CHECK(scene != NULL, "%s", error.text);
    return scene;
}

static const char far_away[] =
    "[camera]\nposition = [134217730.25, 3, -500.5]\ntarget = [134217728, 1, -501]\n"
    "[[camera.key]]\ntime = 0\n[[camera.key]]\ntime = 1\nposition = [134217732, 4, -500]\n"
    "[terrain]\nheight_map = '%s'\nposition = [134217728, -500]\nsize = 40\n[water]\nlevel = 1\n"
    "[shallow]\n[[shallow.spring]]\nposition = [134217729, -499]\nrate = 1\n"
    "[[shallow.body]]\nposition = [134217727, -501]\n"
    "[[entity]]\nname = 'boat'\nmesh = '%s'\nposition = [134217720, 2, -500]\n"
    "[[entity.key]]\ntime = 0\nposition = [134217721, 2, -500]\n"
    "[[lamp]]\nfollow = 'boat'\nposition = [0, 1, 2]\n[[lamp]]\nposition = [134217728.5, 9, -499.5]\n"
    "[[spray]]\nfrom = [134217726, 1, -500]\nto = [134217730, 1, -498]\n"
    "[[view]]\nname = 'behind'\nrectangle = [0, 0, 0.5, 0.5]\n[view.camera]\nfollow = 'boat'\nposition = [0, 4, 9]\n"
    "[[cloud]]\nposition = [134217738, 100, -490]\n";

static void places_are_measured_from_the_terrain(void)
{
    lom_scene *s = decode(far_away);
    if (s == NULL)
        return;
    CHECK(is_place(s->camera.position, 2.25, 3, -0.5) && is_place(s->camera.target, 0, 1, -1));
    CHECK(is_place(s->camera.keys[0].position, 2.25, 3, -0.5) && is_place(s->camera.keys[1].position, 4, 4, 0));
    CHECK(is_place(s->entities[0].position, -8, 2, 0) && is_place(s->entities[0].keys[0].position, -7, 2, 0));
    CHECK(is_place(s->lamps[0].position, 0, 1, 2) && is_place(s->lamps[1].position, 0.5, 9, 0.5));
    CHECK(is_place(s->views[0].camera.position, 0, 4, 9) && is_place(s->cloud[0].position, 10, 100, 10));
    CHECK(s->sprays[0].from[0] == -2 && s->sprays[0].to[0] == 2 && s->sprays[0].to[1] == 1 && s->sprays[0].to[2] == 2);
    CHECK(s->shallow.springs[0].position[0] == 1 && s->shallow.springs[0].position[1] == 1);
    CHECK(s->shallow.bodies[0].position[0] == -1 && s->shallow.bodies[0].position[1] == -1);
    CHECK(is_place(lom_place_in_file(s, s->camera.position), 134217730.25, 3, -500.5));
    lom_free_scene(s);
}

static void what_has_no_place_is_where_the_terrain_is(void)
{
    lom_scene *s = decode(far_away);
    if (s == NULL)
        return;
    CHECK(s->water.position[0] == 0 && s->water.position[1] == 0 && s->water.size[0] == 40);
    CHECK(s->shallow.position[0] == 0 && s->shallow.position[1] == 0 && s->clouds.middle[0] == 0);
    lom_free_scene(s);
    s = decode("[camera]\nposition = [100, 2, 9]\ntarget = [100, 2, 0]\n"
               "[terrain]\nheight_map = '%s'\nposition = [100, 0]\n"
               "[[water]]\nposition = [100, 5]\n[[water]]\nlevel = 2\nposition = [110, 0]\n[[water]]\nlevel = 3\n");
    if (s == NULL)
        return;
    CHECK(s->water.position[0] == 0 && s->water.position[1] == 5 && s->other_waters[0].position[0] == 10 &&
          s->other_waters[1].position[0] == 0);
    lom_free_scene(s);
}

int main(int argc, char **argv)
{
    RUN(places_are_measured_from_the_terrain);
    RUN(what_has_no_place_is_where_the_terrain_is);
    return check_result();
}
