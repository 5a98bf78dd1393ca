/* Writing a made sky. In: what it is like, a path. Out: a file of six faces, or six files. */
#include "make_sky.h"

#include "paths.h"
#include "sky/face_mark.h"

#include <lom/lom.h>

static bool write_cube(const lom_sky_box_desc *desc, const char *path, lom_error *error)
{
    lom_image *cube = lom_make_sky_cube(desc, error);
    bool written = cube != NULL && lom_write_image(path, NULL, cube, error);
    lom_free_image(cube);
    return written;
}

bool lom_write_sky_box(const lom_sky_box_desc *desc, const char *path, lom_error *error)
{
    static const char *const faces[6] = { "right", "left", "top", "bottom", "front", "back" };
    const char *mark = lom_face_mark(path);
    if (mark == NULL && lom_path_is(path, "dds"))
        return write_cube(desc, path, error);
    if (mark == NULL)
        return lom_fail(
            error, LOM_ERROR_USAGE,
            "%s: a sky box is one file that ends in .dds, or six, whose name needs one %%s for right, left, "
            "top, bottom, front and back.",
            path);
    lom_image *pictures[6];
    bool done = lom_make_sky_box(desc, pictures, error);
    for (int i = 0; i < 6; i++) {
        char *name = lom_path_print(error, "%.*s%s%s", (int)(mark - path), path, faces[i], mark + 2);
        done = done && name != NULL && lom_write_image(name, NULL, pictures[i], error);
        lom_free_image(pictures[i]);
        lom_release(name);
    }
    return done;
}
