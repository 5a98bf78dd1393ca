/* The table of the scene file's [[view]] keys and its check. In: the members as the file gives them. Out: the same.
 * Invariant: afterwards a view's rectangle lies within the picture. */
#include "scene/scene_keys.h"

#include <lom/scene.h>

#define AT(type, member) offsetof(type, member)
#define COUNT(array)     ((int)(sizeof(array) / sizeof *(array)))

static bool check_view(void *members, const lom_key_check *check)
{
    const lom_picture_view *view = members;
    const double *r = view->rectangle;
    if (view->name == NULL || view->name[0] == '\0' || strcmp(view->name, LOM_MAIN_VIEW) == 0)
        return check->fail(check, "name",
                           "a view has a name, other than \"" LOM_MAIN_VIEW "\", which is the picture's.");
    if (!(r[2] > 0 && r[3] > 0 && r[0] + r[2] <= 1 && r[1] + r[3] <= 1))
        return check->fail(check, "rectangle",
                           "a view lies within the picture: x + width and y + height are at most 1, "
                           "width and height above 0.");
    if (view->camera.person == LOM_PERSON_FIRST)
        return check->fail(check, "camera", "a view's camera is no first person, which hides its entity in all views.");
    return true;
}

static const lom_key view[] = {
    { "name", LOM_KEY_STRING, AT(lom_picture_view, name), .flags = LOM_KEY_REQUIRED,
      .text = "For `--view`, `lom plan` and `lom explain`; unique." },
    { "rectangle", LOM_KEY_NUMBER, AT(lom_picture_view, rectangle), 4, .flags = LOM_KEY_REQUIRED, .minimum = 0,
      .maximum = 1,
      .text = "x, y, width and height in parts of the picture's, from its top left corner; rounded to whole pixels, "
              "one at least." },
    { "mirrored", LOM_KEY_BOOL, AT(lom_picture_view, mirrored),
      .text = "Left and right are exchanged, as in a mirror that one looks back with." },
    { "visible", LOM_KEY_BOOL, AT(lom_picture_view, visible), .initial = { 1 }, .text = "Draw it." },
    { "camera", LOM_KEY_TABLE, AT(lom_picture_view, camera), .table = &lom_camera_keys },
};
const lom_key_table lom_view_keys = {
    .size = sizeof(lom_picture_view),
    .keys = view,
    .key_count = COUNT(view),
    .check = check_view,
    .text = "Another look at the same scene, in a rectangle of the picture (docs/cameras.md). Views are drawn over the "
            "picture of `[camera]` and over one another, in their order."
};
