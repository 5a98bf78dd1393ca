/* Small scenes for the tests of the reference: files in a folder of their own, which is removed at the end. */
#ifndef LOM_TESTS_REFERENCE_SCENE_FILES_H
#define LOM_TESTS_REFERENCE_SCENE_FILES_H

#include <lom/reference.h>

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static char scene_folder[] = "/tmp/lom-reference-XXXXXX";

static inline const char *scene_path(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", scene_folder, name);
    return path;
}

static inline bool write_text(const char *name, const char *text)
{
    return lom_write_file(scene_path(name), text, strlen(text), NULL);
}

/* The texel (x, y) of the picture that write_files makes: codes that are all different. */
enum { TEXELS = 8 };
static inline uint8_t texel_code(int x, int y, int channel)
{
    return (uint8_t)(3 * (TEXELS * y + x) + 20 * channel + 10);
}

/* quad.obj: 2 x 2 m in the plane z = 0 around the origin, facing +z, with texels.png over it once; ground.obj: 200 x
 * 200 m at y = 0, facing +y; bare.obj: a triangle whose picture is not there; heights.png: a hill. */
static inline bool write_files(void)
{
    if (mkdtemp(scene_folder) == NULL)
        return false;
    lom_image *image = lom_create_image(TEXELS, TEXELS, 1, LOM_FORMAT_RGB8, NULL);
    lom_image *hill = lom_create_image(33, 33, 1, LOM_FORMAT_R8, NULL);
    for (int i = 0; i < TEXELS * TEXELS * 3; i++)
        image->pixels[i] = texel_code(i / 3 % TEXELS, i / 3 / TEXELS, i % 3);
    for (int i = 0; i < 33 * 33; i++) {
        int x = i % 33 - 16, z = i / 33 - 16;
        hill->pixels[i] = (uint8_t)(255 * 16 / (16 + x * x + z * z) + (x * z & 7));
    }
    bool done =
        lom_write_image(scene_path("texels.png"), NULL, image, NULL) &&
        lom_write_image(scene_path("heights.png"), NULL, hill, NULL) &&
        write_text("quad.mtl", "newmtl paint\nKa 1 1 1\nKd 1 1 1\nmap_Kd texels.png\n") &&
        write_text("quad.obj", "mtllib quad.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                               "vt 0 1\nvn 0 0 1\nusemtl paint\nf 1/1/1 2/2/1 3/3/1 4/4/1\n") &&
        write_text("bare.mtl", "newmtl bare\nmap_Kd absent.png\n") &&
        write_text("bare.obj", "mtllib bare.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl bare\nf 1 2 3\n") &&
        write_text("ground.obj", "v -100 0 100\nv 100 0 100\nv 100 0 -100\nv -100 0 -100\nvn 0 1 0\n"
                                 "f 1//1 2//1 3//1 4//1\n");
    lom_free_image(image);
    lom_free_image(hill);
    return done;
}

static inline void remove_files(void)
{
    static const char *const names[] = { "texels.png", "heights.png", "quad.mtl",  "quad.obj",
                                         "bare.mtl",   "bare.obj",    "ground.obj" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        remove(scene_path(names[i]));
    rmdir(scene_folder);
}

/* A scene from text, its files in the folder. */
static inline lom_scene *make_scene(const char *text)
{
    lom_error error = { .code = LOM_OK };
    lom_scene *scene = lom_decode_scene(text, strlen(text), scene_path("scene.toml"), NULL, 0, &error);
    if (scene == NULL)
        printf("  %s\n", error.text);
    return scene;
}

#endif
