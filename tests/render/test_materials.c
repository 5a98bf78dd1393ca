/* Proves what materials add to light: light of their own, exactly, in a furnace too; back sides with their own material
 * and turned normals; maps of highlight and gloss; normal maps and heights, along the axes of the texture; from the scene
 * and from MTL; drawn and in the reference. */
#include "check.h"
#include "small_scene.h"

#include <math.h>

enum { SIDE = 33, PIXELS = SIDE * SIDE };

/* Looks straight down at a plane; right is +x, up is -z. Nothing shines. */
#define ROOM                                                                                                           \
    "[output]\nwidth = 33\nheight = 33\nformat = 'rgb32f'\n[camera]\nposition = [0, 10, 0]\ntarget = [0, 0, 0]\n"      \
    "up = [0, 0, -1]\nfield_of_view = 44.8\n[quality]\nfiltering = 'float'\n"
#define DARK  "[sky]\ncolor = [0, 0, 0]\n[light]\nintensity = 0\nambient = [0, 0, 0]\n"
#define FLOOR "[[entity]]\nmesh = 'floor.obj'\n"
/* From the right, from above in the picture, and at a slant. */
#define RIGHT "[sky]\ncolor = [0, 0, 0]\n[light]\ndirection = [-0.6, -0.8, 0]\nambient = [0, 0, 0]\n"
#define UPPER "[sky]\ncolor = [0, 0, 0]\n[light]\ndirection = [0, -0.8, 0.6]\nambient = [0, 0, 0]\n"

static const char floor_obj[] =
    "mtllib floor.mtl\nv -40 0 40\nv 40 0 40\nv 40 0 -40\nv -40 0 -40\nvt 0 0\nvt 8 0\nvt 8 8\nvt 0 8\n"
    "vn 0 1 0\nusemtl one\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";
static const char floor_mtl[] = "newmtl one\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nNs 10\n";
/* The same with u to the left. */
static const char turned_obj[] =
    "v -40 0 40\nv 40 0 40\nv 40 0 -40\nv -40 0 -40\nvt 8 0\nvt 0 0\nvt 0 8\nvt 8 8\nvn 0 1 0\n"
    "f 1/1/1 2/2/1 3/3/1 4/4/1\n";

static lom_image *draw_with(const char *text, bool traced)
{
    static const char *const set[] = { "quality.water=reference", "quality.reference.samples=1" };
    lom_error error = { 0 };
    lom_frame drawn = { .image = NULL };
    lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("materials.toml"), set, traced ? 2 : 0, &error);
    lom_renderer *renderer =
        scene == NULL ? NULL : lom_create_renderer(scene, &(lom_device_desc){ .threads = 1 }, &error);
    bool done = renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ 0 }, &drawn, &error);
    CHECK(done, "%s", error.text);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done ? drawn.image : NULL;
}

static double sample(const lom_image *image, int pixel, int channel)
{
    return (double)((const float *)(void *)image->pixels)[pixel * 3 + channel];
}

/* Every sample of every pixel is this, drawn and traced. */
static void check_all(const char *text, double red, double green, double blue, double off)
{
    const double want[3] = { red, green, blue };
    for (int traced = 0; traced < 2; traced++) {
        lom_image *image = draw_with(text, traced == 1);
        for (int i = 0; image != NULL && i < PIXELS * 3; i++)
            CHECK(fabs(sample(image, i / 3, i % 3) - want[i % 3]) <= off, "%s, sample %d: %.9g, not %.9g",
                  traced ? "traced" : "drawn", i, sample(image, i / 3, i % 3), want[i % 3]);
        lom_free_image(image);
    }
}

/* A picture of one colour. */
static bool put_color(const char *name, int red, int green, int blue)
{
    lom_error error = { 0 };
    lom_image *image = lom_create_image(4, 4, 1, LOM_FORMAT_RGB8, &error);
    for (int i = 0; i < 16; i++) {
        image->pixels[i * 3] = (uint8_t)red;
        image->pixels[i * 3 + 1] = (uint8_t)green;
        image->pixels[i * 3 + 2] = (uint8_t)blue;
    }
    bool put = lom_write_image(small_path(name), NULL, image, &error);
    lom_free_image(image);
    CHECK(put, "%s", error.text);
    return put;
}

/* ---- light of its own ---- */

/* From Ke and from the scene, times the picture (of which 255 is 1 and 0 is 0), beyond white too. */
static void emission_is_added_as_it_is(void)
{
    lom_error error = { 0 };
    check_all(ROOM DARK FLOOR "[entity.material]\nemissive = [2.5, 0.25, 0]\n", 2.5, 0.25, 0, 0);
    CHECK(put_color("red.png", 255, 0, 0), "picture");
    check_all(ROOM DARK FLOOR "[entity.material]\nemissive = [2, 3, 4]\nemissive_map = 'red.png'\n", 2, 0, 0, 0);
    CHECK(small_text("floor.mtl", "newmtl one\nKe 0.5 1 3\nmap_Ke red.png\n", &error), "%s", error.text);
    check_all(ROOM DARK FLOOR, 0.5, 0, 0, 0);
    check_all(ROOM DARK FLOOR "[entity.material]\nemissive = 0\n", 0, 0, 0, 0);
    CHECK(small_text("floor.mtl", floor_mtl, &error), "%s", error.text);
}

/* In a furnace of light 1 from everywhere, what reflects 2/5 and emits 3/5 cannot be told from what is around it. */
static void a_furnace_hides_what_emits_what_it_does_not_reflect(void)
{
    check_all(ROOM
              "[sky]\ncolor = [1, 1, 1]\n[light]\nintensity = 0\nambient = [1, 1, 1]\nground = [1, 1, 1]\n[[entity]]\n"
              "mesh = 'box.obj'\nscale = 2\ntwo_sided = true\n[entity.material]\nambient = 0.4\nemissive = 0.6\n"
              "texture = 'white.png'\n",
              1, 1, 1, 2e-7);
}

/* ---- back sides ---- */

/* A sheet that is seen from behind: its back is lit from the eye's side and not from the other. */
static void backs_have_their_material_and_turned_normals(void)
{
#define SHEET "[[entity]]\nmesh = 'floor.obj'\nrotation = [180, 0, 0]\n"
    check_all(ROOM RIGHT SHEET, 0, 0, 0, 0);
    check_all(ROOM RIGHT SHEET "two_sided = true\n", 0.8, 0.8, 0.8, 1e-6);
    check_all(ROOM RIGHT SHEET "[entity.material]\ndiffuse = [1, 0, 0]\n[entity.back]\ndiffuse = [0.25, 0.5, 1]\n", 0.2,
              0.4, 0.8, 1e-6);
    check_all(ROOM RIGHT FLOOR "[entity.material]\ndiffuse = [1, 0, 0]\n[entity.back]\ndiffuse = [0.25, 0.5, 1]\n", 0.8,
              0, 0, 1e-6);
    check_all(ROOM "[sky]\ncolor = [0, 0, 0]\n[light]\ndirection = [0, 1, 0]\nambient = [0, 0, 0]\n" SHEET
                   "two_sided = true\n",
              0, 0, 0, 0);
}

/* ---- maps ---- */

/* Black takes the highlight away, white leaves it, bit for bit. */
static void a_specular_map_multiplies_the_highlight(void)
{
#define SHINY "[entity.material]\ndiffuse = 0\nambient = 0\nspecular = 1\nshininess = 5\n"
    CHECK(put_color("black.png", 0, 0, 0), "picture");
    check_all(ROOM RIGHT FLOOR SHINY "specular_map = 'black.png'\n", 0, 0, 0, 0);
    lom_image *with = draw_with(ROOM RIGHT FLOOR SHINY "specular_map = 'white.png'\n", false);
    lom_image *without = draw_with(ROOM RIGHT FLOOR SHINY, false);
    CHECK(with != NULL && without != NULL && lom_hash_image(with) == lom_hash_image(without), "white changes it");
    CHECK(without != NULL && sample(without, PIXELS / 2, 0) > 0.1, "no highlight");
    lom_free_image(with);
    lom_free_image(without);
}

static void a_gloss_map_multiplies_the_exponent(void)
{
    CHECK(put_color("gloss.png", 51, 255, 255), "picture"); /* a fifth */
    for (int traced = 0; traced < 2; traced++) {
        lom_image *map = draw_with(ROOM RIGHT FLOOR "[entity.material]\ndiffuse = 0\nspecular = 1\nshininess = 30\n"
                                                    "gloss_map = 'gloss.png'\n",
                                   traced);
        lom_image *plain =
            draw_with(ROOM RIGHT FLOOR "[entity.material]\ndiffuse = 0\nspecular = 1\nshininess = 6\n", traced);
        for (int i = 0; map != NULL && plain != NULL && i < PIXELS; i++)
            CHECK(fabs(sample(map, i, 0) - sample(plain, i, 0)) < 3e-6, "traced %d, pixel %d: %g, not %g", traced, i,
                  sample(map, i, 0), sample(plain, i, 0));
        lom_free_image(map);
        lom_free_image(plain);
    }
}

static double code(int value)
{
    return value / 255.0 * 2 - 1;
}

/* The cosine that a normal of these codes has to a light at (x, y, z), right, up the picture and off it. */
static double cosine_of(const int codes[3], double x, double y, double z)
{
    const double n[3] = { code(codes[0]), code(codes[1]), code(codes[2]) };
    const double c = (n[0] * x + n[1] * y + n[2] * z) / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return c > 0 ? c : 0;
}

/* Red leans the normal along u and green up the picture, where u runs right, where it runs left, and on backs. */
static void normal_maps_lean_along_the_texture(void)
{
    static const int codes[][3] = { { 128, 128, 255 }, { 200, 128, 230 }, { 128, 210, 220 }, { 60, 190, 200 } };
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
        const int *c = codes[i], mirrored[3] = { 255 - c[0], c[1], c[2] };
        CHECK(put_color("lean.png", c[0], c[1], c[2]), "picture");
        const double right = cosine_of(c, 0.6, 0, 0.8), upper = cosine_of(c, 0, 0.6, 0.8);
        const double left = cosine_of(mirrored, 0.6, 0, 0.8);
#define LEAN "[entity.material]\nnormal_map = 'lean.png'\ndiffuse = 1\n"
        check_all(ROOM RIGHT FLOOR LEAN, right, right, right, 3e-6);
        check_all(ROOM UPPER FLOOR LEAN, upper, upper, upper, 3e-6);
        check_all(ROOM RIGHT "[[entity]]\nmesh = 'turned.obj'\n" LEAN, left, left, left, 3e-6);
        /* turned about x: u still runs right, the picture's upper side is below */
        const int below[3] = { c[0], 255 - c[1], c[2] };
        const double behind = cosine_of(below, 0, 0.6, 0.8);
        check_all(ROOM UPPER SHEET "two_sided = true\n" LEAN, behind, behind, behind, 3e-6);
    }
}

/* A ramp to the right that is `bump` 64ths of its width high; the seam where it repeats lies outside the view. */
static void heights_become_normals(void)
{
    lom_error error = { 0 };
    lom_image *ramp = lom_create_image(64, 8, 1, LOM_FORMAT_R16, &error);
    for (int i = 0; i < 64 * 8; i++)
        ((uint16_t *)(void *)ramp->pixels)[i] = (uint16_t)(i % 64 * 1000);
    CHECK(lom_write_image(small_path("ramp.png"), NULL, ramp, &error), "%s", error.text);
    lom_free_image(ramp);
    CHECK(small_text("floor.mtl", "newmtl one\nKa 1 1 1\nKd 1 1 1\nmap_Bump -bm 20 ramp.png\n", &error) &&
              small_text("wide.obj",
                         "mtllib floor.mtl\nv -40 0 40\nv 40 0 40\nv 40 0 -40\nv -40 0 -40\nvt 0.2 0\nvt 0.8 0\n"
                         "vt 0.8 1\nvt 0.2 1\nvn 0 1 0\nusemtl one\nf 1/1/1 2/2/1 3/3/1 4/4/1\n",
                         &error),
          "%s", error.text);
    const double slope = 1000 / 65535.0 * 64 * 20 / 64, want = (0.8 - 0.6 * slope) / sqrt(1 + slope * slope);
    check_all(ROOM RIGHT "[[entity]]\nmesh = 'wide.obj'\n", want, want, want, 3e-5);
    /* the scene's word before the mesh's */
    check_all(ROOM RIGHT "[[entity]]\nmesh = 'wide.obj'\n[entity.material]\nbump = 0\n", 0.8, 0.8, 0.8, 3e-5);
    CHECK(small_text("floor.mtl", floor_mtl, &error), "%s", error.text);
}

static void what_cannot_be_is_refused(void)
{
    static const struct {
        const char *keys, *sentence;
    } cases[] = {
        { "[entity.material]\nnormal_map = 'absent.png'", "absent.png" },
        { "[entity.back]\ngloss_map = 'absent.png'", "absent.png" },
        { "[entity.material]\nemissive = -1", "emissive" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1000];
        lom_error error = { 0 };
        snprintf(text, sizeof text, "%s%s\n", ROOM FLOOR, cases[i].keys);
        lom_scene *scene = lom_decode_scene(text, strlen(text), small_path("materials.toml"), NULL, 0, &error);
        CHECK(scene == NULL && error.code != LOM_OK && strstr(error.text, cases[i].sentence) != NULL, "%s: %s",
              cases[i].keys, error.text);
        lom_free_scene(scene);
    }
}

int main(int argc, char **argv)
{
    lom_error error = { 0 };
    if (!make_small_scene() || !small_text("floor.obj", floor_obj, &error) ||
        !small_text("floor.mtl", floor_mtl, &error) || !small_text("turned.obj", turned_obj, &error) ||
        !put_color("white.png", 255, 255, 255))
        return 1;
    RUN(emission_is_added_as_it_is);
    RUN(a_furnace_hides_what_emits_what_it_does_not_reflect);
    RUN(backs_have_their_material_and_turned_normals);
    RUN(a_specular_map_multiplies_the_highlight);
    RUN(a_gloss_map_multiplies_the_exponent);
    RUN(normal_maps_lean_along_the_texture);
    RUN(heights_become_normals);
    RUN(what_cannot_be_is_refused);
    remove_small_scene();
    return check_result();
}
