/* Time for scenes with poisoned files: pictures, height maps, voxels and meshes of infinities, denormals and huge numbers. A
 * frame does at most 2.5 times the declared work of a clean one and takes at most 2.5 times as long (the criterion of Embree's
 * tests), by processor time, clean and poisoned in turn, the least of each. */
#include "check.h"
#include "drawn_time.h"
#include "render/key_bases.h"
#include "sanitized.h"
#include "small_scene.h"

#include <float.h>

/* ---- files ---- */

/* What stands in a file, and a clean number instead: of heights and places one that makes much the same shape. */
static const struct poison {
    const char *name;
    float value, like;
} poisons[] = {
    { "infinity", INFINITY, 1 }, { "-infinity", -INFINITY, 0 }, { "denormals", 1e-41f, 0 },
    { "1e30", 1e30f, 1e4f },     { "-1e30", -1e30f, -1e4f },    { "FLT_MAX / 16", FLT_MAX / 16, 1e4f },
};
enum { POISONS = sizeof poisons / sizeof *poisons };

static bool write_floats(const char *name, int size, int depth, lom_format format, float value, int every)
{
    lom_image *image = lom_create_image(size, size, depth, format, NULL);
    float *at = (float *)(void *)image->pixels;
    const size_t count = lom_image_size(image) / sizeof *at;
    for (size_t i = 0; i < count; i++)
        at[i] = i % (size_t)every == 0 ? value : 0.2f + 0.6f * (float)lom_random_uniform(9, i);
    const bool done = lom_write_image(small_path(name), NULL, image, NULL);
    lom_free_image(image);
    return done;
}

static bool write_sky(float value, int every)
{
    static const char *const faces[] = { "right", "left", "top", "bottom", "front", "back" };
    bool done = true;
    for (int i = 0; i < 6; i++) {
        char name[40];
        snprintf(name, sizeof name, "float_%s.pfm", faces[i]);
        done = write_floats(name, 16, 1, LOM_FORMAT_RGB32F, value, every) && done;
    }
    return done;
}

static bool write_picture(float value, int every)
{
    return write_floats("float.pfm", 16, 1, LOM_FORMAT_RGB32F, value, every);
}

static bool write_heights(float value, int every)
{
    return write_floats("heights.pfm", 17, 1, LOM_FORMAT_R32F, value, every);
}

static bool write_voxels(float value, int every)
{
    return write_floats("voxels.nrrd", 16, 16, LOM_FORMAT_R32F, value, every);
}

/* A grid of 24 x 24 squares; one corner of `every` has the number for its x, its normal's and its u. */
static bool write_mesh(float value, int every)
{
    enum { SIDE = 24 };
    static char text[400000];
    int length = snprintf(text, sizeof text, "mtllib box.mtl\nusemtl skin\n"), count = 0;
    for (int y = 0; y <= SIDE; y++)
        for (int x = 0; x <= SIDE; x++, count++) {
            const double bad = (double)value, at = x / 6.0 - 2;
            const bool is_bad = count % every == 0;
            length += snprintf(text + length, sizeof text - (size_t)length, "v %.9g %.9g 0\nvn %.9g 0 1\nvt %.9g %g\n",
                               is_bad ? bad : at, y / 6.0, is_bad ? bad : 0, is_bad ? bad : x / 7.0, y / 7.0);
        }
    for (int y = 0; y < SIDE; y++)
        for (int x = 1; x <= SIDE; x++) {
            const int a = y * (SIDE + 1) + x, b = a + SIDE + 1;
            length += snprintf(text + length, sizeof text - (size_t)length, "f %d/%d/%d %d/%d/%d %d/%d/%d %d/%d/%d\n",
                               a, a, a, a + 1, a + 1, a + 1, b + 1, b + 1, b + 1, b, b, b);
        }
    return lom_write_file(small_path("grid.obj"), text, (size_t)length, NULL);
}

static const struct file {
    const char *what;
    bool (*write)(float value, int every);
    const char *scene;
} files[] = {
    { "a sky", write_sky, VIEW TERRAIN "[sky]\npattern = \"float_%s.pfm\"\n[water]\nlevel = 0\n" },
    { "a texture", write_picture,
      VIEW "[terrain]\nheight_map = \"height.png\"\nsize = 40\nheight = 6\nbase = -3\ntexture = \"float.pfm\"\n"
           "detail_map = \"float.pfm\"\n" },
    { "a normal map", write_picture,
      VIEW TERRAIN DISPLACED "normal_map = \"float.pfm\"\n[water.waves]\nkind = \"none\"\n" },
    { "a height map", write_heights,
      VIEW "[terrain]\nheight_map = \"heights.pfm\"\nsize = 40\nheight = 6\nbase = -3\ntexture = \"color.png\"\n"
           "[quality]\nterrain_shadows = true\nambient_occlusion = true\n" },
    { "voxels", write_voxels,
      VIEW TERRAIN "[[cloud]]\nfile = \"voxels.nrrd\"\nsize = [12, 6, 8]\nposition = [0, 2, -8]\n" },
    { "a mesh", write_mesh, VIEW "[[entity]]\nmesh = \"grid.obj\"\n[quality]\nentity_shadows = 64\n" },
};

/* A scene may be refused, by a sentence. */
static void try_file(const struct file *file, const struct poison *poison, int every)
{
    char text[4096];
    struct drawn d[3];
    snprintf(text, sizeof text, "%s%s", head, file->scene);
    CHECK(file->write(0.5f, every), "%s", file->what);
    CHECK(open_drawn(&d[0], text, NULL), "%s: %s", file->what, d[0].error.text);
    CHECK(file->write(poison->like, every), "%s", file->what);
    CHECK(open_drawn(&d[1], text, NULL), "%s: %s", file->what, d[1].error.text);
    CHECK(file->write(poison->value, every), "%s", file->what);
    if (!open_drawn(&d[2], text, NULL)) {
        CHECK(d[2].error.text[0] != 0, "%s in %s: no word", poison->name, file->what);
        printf("  %-12s in %-12s refused: %.90s\n", poison->name, file->what, d[2].error.text);
    } else {
        for (int i = 0; i < 9 * FRAMES; i++)
            draw_next(&d[i % 3]);
        const double ratio = d[2].least / fmax(d[0].least, d[1].least);
        const uint64_t work = d[0].work > d[1].work ? d[0].work : d[1].work;
        const double counted = (double)d[2].work / (double)work;
        CHECK(ratio <= most, "%s in %s: %g times as long", poison->name, file->what, ratio);
        CHECK(counted <= most, "%s in %s: %g times the work", poison->name, file->what, counted);
        check_denormals(&d[2], work, file->what, poison->name);
        printf("  %-12s in every %s%s of %-12s %.2f of the time, %.2f of the work, %llu denormals\n", poison->name,
               every == 1 ? "" : "5th ", "number", file->what, ratio, counted, (unsigned long long)d[2].denormals);
    }
    for (int i = 0; i < 3; i++)
        close_drawn(&d[i]);
}

static void files_of_wild_numbers(void)
{
    for (size_t f = 0; f < sizeof files / sizeof *files; f++)
        for (int p = 0; p < POISONS; p++) {
            try_file(&files[f], &poisons[p], 1);
            try_file(&files[f], &poisons[p], 5);
        }
}

int main(int argc, char **argv)
{
#ifdef SANITIZED
    printf("SKIP a sanitizer watches: time says nothing\n");
    return 0;
#endif
    if (!make_small_scene())
        return 1;
    RUN(files_of_wild_numbers);
    remove_small_scene();
    return check_result();
}
