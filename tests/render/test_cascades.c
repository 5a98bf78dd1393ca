/* Proves the cascades of the sun's shadow: that a wall along the view is dark and the floor beside it lit, bit for bit, from the
 * first cascade to the last, so that no seam is seen; that turning the eye moves no texel; that lanes and crops change no
 * byte; and that parallel rays and scenes without a caster have none. */
#include "check.h"
#include "drawn_scene.h"
#include "small_scene.h"

#include <math.h>

enum { WIDTH = 160, HEIGHT = 90 };

/* The sun stands at 45 degrees over -x; a wall of 10 m at x = 0 goes from near the eye to 300 m away. */
#define SCENE                                                                                                          \
    "[output]\nwidth = 160\nheight = 90\nformat = 'rgb32f'\n[camera]\nposition = [6, 12, 30]\ntarget = [6, 0, -30]\n"  \
    "field_of_view = 60\n[sky]\ncolor = [0, 0, 0]\n[light]\ndirection = [1, -1, 0]\nambient = [0, 0, 0]\n"             \
    "ground = [0, 0, 0]\n[quality]\nentity_shadows = 1024\n"
#define FLOOR "[[entity]]\nmesh = 'floor.obj'\n[entity.material]\nspecular = 0\n"
#define WALL  "[[entity]]\nmesh = 'wall.obj'\n[entity.material]\nspecular = 0\n"
static const char floor_obj[] = "v -90 0 40\nv 90 0 40\nv 90 0 -400\nv -90 0 -400\nvn 0 1 0\nf 1//1 2//1 3//1 4//1\n";
static const char wall_obj[] = "v 0 0 20\nv 0 0 -300\nv 0 10 -300\nv 0 10 20\nvn 1 0 0\nf 1//1 2//1 3//1 4//1\n";

static lom_image *draw_with(const char *text, const char *set)
{
    return draw(text, &set, 1, 0, (lom_rect){ 0 }, NULL);
}

static double red(const lom_image *image, int x, int y)
{
    return (double)*(const float *)lom_image_pixel(image, x, y, 0);
}

/* Where the middle of a pixel of the scene's camera meets the floor; false: nowhere before z = -290. */
static bool find_place(int x, int y, double place[2])
{
    const double length = sqrt(12 * 12 + 60 * 60), down = 12 / length, ahead = 60 / length, k = tan(M_PI / 6);
    const double u = (2 * (x + 0.5) / WIDTH - 1) * k * WIDTH / HEIGHT, v = (1 - 2 * (y + 0.5) / HEIGHT) * k;
    const double fall = down - v * ahead, t = 12 / fall;
    place[0] = 6 + u * t;
    place[1] = 30 - (ahead + v * down) * t;
    return fall > 0 && place[1] > -290 && place[1] < 15;
}

/* ---- seams ---- */

/* What a step of the plan says of the texels' size, 0 when it is left out. */
static double texel_of(const lom_plan *plan, const char *name)
{
    double texel = 0;
    for (int i = 0; i < plan->count; i++)
        if (strcmp(plan->step[i].name, name) == 0 && plan->step[i].runs)
            sscanf(strstr(plan->step[i].text, "them, "), "them, %lf m", &texel);
    return texel;
}

/* The shadow is 0 < x < 10. A place is moved by 2.5 texels and filtered over 1.5, of the coarsest map that it may take. */
static void no_seam_is_seen(void)
{
    static const char *const counts[] = { "quality.shadow_cascades=2", "quality.shadow_cascades=3",
                                          "quality.shadow_cascades=4" };
    lom_image *lit = draw_with(SCENE FLOOR WALL, "quality.entity_shadows=0");
    for (int c = 0; c < 3; c++) {
        lom_plan plan;
        lom_image *is = draw(SCENE FLOOR WALL, &counts[c], 1, 0, (lom_rect){ 0 }, &plan);
        char last[16];
        snprintf(last, sizeof last, "cascade %d", c + 2);
        const double near = 4 * texel_of(&plan, "cascade 1"), far = 4 * texel_of(&plan, last);
        CHECK(near > 0 && far > near, "%s: texels of %g and %g m", counts[c], near / 4, far / 4);
        int seen[2] = { 0, 0 };
        for (int i = 0; is != NULL && lit != NULL && i < WIDTH * HEIGHT; i++) {
            double place[2];
            const int x = i % WIDTH, y = i / WIDTH;
            if (!find_place(x, y, place) || fabs(place[0]) < far || fabs(place[0] - 10) < far)
                continue;
            const bool dark = place[0] > 0 && place[0] < 10;
            if (place[0] < 0 && place[0] > -12) /* may be behind the wall */
                continue;
            seen[dark]++;
            CHECK(red(is, x, y) == (dark ? 0 : red(lit, x, y)), "%s: %.9g at %d,%d (%g, %g)", counts[c], red(is, x, y),
                  x, y, place[0], place[1]);
        }
        CHECK(seen[0] > 900 && seen[1] > 200, "%d lit and %d dark places are seen", seen[0], seen[1]);
        lom_free_image(is);
    }
    lom_free_image(lit);
}

/* The near edge is as sharp as the first cascade's texels: within 4 of them it goes from light to dark. */
static void near_edges_are_sharp(void)
{
    lom_plan plan;
    const char *const four[] = { "quality.shadow_cascades=4" };
    lom_image *lit = draw_with(SCENE FLOOR WALL, "quality.entity_shadows=0");
    lom_image *is = draw(SCENE FLOOR WALL, four, 1, 0, (lom_rect){ 0 }, &plan);
    const double near = 4 * texel_of(&plan, "cascade 1");
    CHECK(near < 1, "texels of %g m", near / 4);
    for (int x = 0; is != NULL && lit != NULL && x < WIDTH; x++) {
        double place[2];
        if (!find_place(x, HEIGHT - 8, place) || place[0] < near || fabs(place[0] - 10) < near)
            continue;
        CHECK(red(is, x, HEIGHT - 8) == (place[0] < 10 ? 0 : red(lit, x, HEIGHT - 8)), "%d: %g at x = %g", x,
              red(is, x, HEIGHT - 8), place[0]);
    }
    lom_free_image(lit);
    lom_free_image(is);
}

/* ---- what changes nothing ---- */

static void lanes_and_crops_change_no_byte(void)
{
    const char *const four[] = { "quality.shadow_cascades=4" };
    const lom_rect crop = { 37, 30, 60, 41 };
    lom_image *a = draw(SCENE FLOOR WALL, four, 1, 4, (lom_rect){ 0 }, NULL);
    lom_image *b = draw(SCENE FLOOR WALL, four, 1, 8, (lom_rect){ 0 }, NULL);
    lom_image *part = draw(SCENE FLOOR WALL, four, 1, 8, crop, NULL);
    CHECK(a != NULL && b != NULL && lom_hash_image(a) == lom_hash_image(b), "4 and 8 lanes differ");
    for (int y = 0; a != NULL && part != NULL && y < crop.height; y++)
        for (int x = 0; x < crop.width; x++)
            CHECK(red(part, x, y) == red(a, x + crop.x, y + crop.y), "%d,%d of the crop", x, y);
    lom_free_image(a);
    lom_free_image(b);
    lom_free_image(part);
}

/* Seen from above, the picture is turned with the eye: a quarter turn takes pixel (x, y) to (y, side - 1 - x). */
static void turning_the_eye_moves_no_texel(void)
{
    static const char *const ups[2][5] = {
        { "camera.up=[0,0,-1]", "output.width=90", "camera.position=[6,40,10]", "camera.target=[6,0,10]",
          "quality.shadow_cascades=3" },
        { "camera.up=[1,0,0]", "output.width=90", "camera.position=[6,40,10]", "camera.target=[6,0,10]",
          "quality.shadow_cascades=3" },
    };
    lom_image *a = draw(SCENE FLOOR WALL, ups[0], 5, 0, (lom_rect){ 0 }, NULL);
    lom_image *b = draw(SCENE FLOOR WALL, ups[1], 5, 0, (lom_rect){ 0 }, NULL);
    int off = 0, partly = 0;
    for (int i = 0; a != NULL && b != NULL && i < 90 * 90; i++) {
        const double is = red(a, i % 90, i / 90), other = red(b, i / 90, 89 - i % 90);
        off += fabs(is - other) > 2e-3;
        partly += is > 0.1 && is < 0.5;
    }
    CHECK(partly > 10, "%d pixels lie in the edge", partly);
    CHECK(off < 4, "%d pixels differ", off);
    lom_free_image(a);
    lom_free_image(b);
}

/* Parallel rays keep the two maps; where nothing casts no map is drawn and no bit differs. */
static void what_needs_no_cascade_has_none(void)
{
    static const char *const parallel[] = { "camera.projection=orthographic", "camera.height=30",
                                            "quality.shadow_cascades=4" };
    lom_plan plan;
    lom_image *a = draw(SCENE FLOOR WALL, parallel, 2, 0, (lom_rect){ 0 }, NULL);
    lom_image *b = draw(SCENE FLOOR WALL, parallel, 3, 0, (lom_rect){ 0 }, &plan);
    CHECK(a != NULL && b != NULL && lom_hash_image(a) == lom_hash_image(b), "parallel rays have cascades");
    CHECK(texel_of(&plan, "cascade 1") == 0 && texel_of(&plan, "near shadow") > 0, "the plan has cascades");
    lom_free_image(a);
    lom_free_image(b);
    a = draw_with(SCENE FLOOR, "quality.entity_shadows=0");
    b = draw_with(SCENE FLOOR, "quality.shadow_cascades=4");
    CHECK(a != NULL && b != NULL && lom_hash_image(a) == lom_hash_image(b), "a floor shades itself");
    lom_free_image(a);
    lom_free_image(b);
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() || !small_text("floor.obj", floor_obj, &error) || !small_text("wall.obj", wall_obj, &error))
        return 1;
    RUN(no_seam_is_seen);
    RUN(near_edges_are_sharp);
    RUN(lanes_and_crops_change_no_byte);
    RUN(turning_the_eye_moves_no_texel);
    RUN(what_needs_no_cascade_has_none);
    remove_small_scene();
    return check_result();
}
