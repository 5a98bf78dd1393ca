/* Proves: a cloud of which no height is told stands within its genus's range, by the table of the genera, halfway up the
 * kind's own; what is told holds. */
#include "check.h"

#include <lom/scene.h>

#include <stdio.h>
#include <string.h>

static lom_scene *scene_of(const char *cloud, lom_error *error)
{
    char text[200];
    snprintf(text, sizeof text, "[[cloud]]\n%s\n", cloud);
    return lom_decode_scene(text, strlen(text), "-", NULL, 0, error);
}

static void check_place(const char *cloud, double x, double y, double z)
{
    lom_error error = { 0 };
    lom_scene *scene = scene_of(cloud, &error);
    CHECK(scene != NULL, "%s: %s", cloud, error.text);
    if (scene == NULL)
        return;
    const lom_vec3 at = scene->cloud[0].position;
    CHECK(at.x == x && at.y == y && at.z == z, "%s: at %g, %g, %g", cloud, at.x, at.y, at.z);
    lom_free_scene(scene);
}

static void bases_are_of_the_genus(void)
{
    static const struct {
        const char *kind;
        double low, high; /* of the genus, metres */
    } rows[] = { { "Ci", 8000, 13000 },  { "Cc", 5000, 13000 }, { "Cs", 5000, 13000 }, { "Ac", 1500, 7000 },
                 { "As", 2000, 7000 },   { "Sc", 100, 2000 },   { "St", 0, 2000 },     { "Ns", 2000, 7000 },
                 { "Cu fra", 0, 2000 },  { "Cu hum", 0, 2000 }, { "Cu med", 0, 2000 }, { "Cu con", 0, 2000 },
                 { "hemisphere", 0, 0 }, { "puffs", 0, 0 },     { "wyvill", 0, 0 } };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const lom_cloud_kind *kind = lom_find_cloud_kind(rows[i].kind, NULL);
        double base = lom_base_of_kind(kind);
        char text[80];
        CHECK(base >= rows[i].low && base <= rows[i].high && base == (kind->low + kind->high) / 2, "%s: %g",
              rows[i].kind, base);
        snprintf(text, sizeof text, "kind = '%s'", rows[i].kind);
        check_place(text, 0, base, 0);
        snprintf(text, sizeof text, "kind = '%s'\nmiddle = [30, -4]", rows[i].kind);
        check_place(text, 30, base, -4);
    }
}

static void what_is_told_holds(void)
{
    check_place("position = [1, 2, 3]", 1, 2, 3);
    check_place("position = [1, 2, 3]\nmiddle = [5, 6]", 5, 2, 6);
    check_place("kind = 'cirrus'\nposition = [0, 0, 0]", 0, 0, 0);
    check_place("file = 'LICENSE'", 0, 0, 0);
    check_place("file = 'LICENSE'\nmiddle = [5, 6]", 5, 0, 6);
}

int main(int argc, char **argv)
{
    RUN(bases_are_of_the_genus);
    RUN(what_is_told_holds);
    return check_result();
}
