/* A small scene with one of everything (terrain with a layer, sky box, a mesh with materials and a texture, a lake),
 * written to a folder of its own: every file is made from formulas. */
#ifndef LOM_TESTS_SMALL_SCENE_H
#define LOM_TESTS_SMALL_SCENE_H

#include <lom/render.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char small_folder[96];

/* The path of a file of the folder; valid until the next call but three of the thread. */
static inline const char *small_path(const char *name)
{
    static _Thread_local char path[4][400];
    static _Thread_local int next;
    next = (next + 1) % 4;
    snprintf(path[next], sizeof path[next], "%s/%s", small_folder, name);
    return path[next];
}

/* A face, lines and points. */
static const char small_wires[] =
    "mtllib box.mtl\nv -2 0 0\nv 2 0 0\nv 2 2 0\nv -2 2 1\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\nl 1/1 4 3\np 2 4\n";

static const char small_obj[] =
    "mtllib box.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 2 0\nvt 0 0\nvt 1 0\nvt .5 1\n"
    "usemtl skin\nf 1/1 5/3 2/2\nf 2/1 5/3 3/2\nusemtl plain\nf 3/1 5/3 4/2\nf 4/1 5/3 1/2\n";
static const char small_mtl[] =
    "newmtl skin\nKd 1 .9 .8\nmap_Kd color.png\nnewmtl plain\nKd .2 .5 .3\nKs 1 1 1\nNs 20\n";
static const char small_scene[] =
    "[output]\nwidth = 32\nheight = 18\n[camera]\nposition = [0, 3, 12]\ntarget = [0, 1, 0]\n"
    "[light]\nazimuth = 20\nelevation = 25\n[sky]\npattern = \"sky_%s.png\"\n"
    "[terrain]\nheight_map = \"height.png\"\nsize = 40\nheight = 6\nbase = -3\ntexture = \"color.png\"\ntile = 5\n"
    "[[terrain.layer]]\nmap = \"layer.ppm\"\nfrom_height = 0\n"
    "[water]\nlevel = 0\nnormal_map = \"normal.png\"\n"
    "[[entity]]\nname = \"box\"\nmesh = \"box.obj\"\nposition = [0, 0.3, 2]\n";

/* Writes a picture of a formula. */
static inline bool small_picture(const char *name, int size, lom_format format, lom_error *error)
{
    lom_image *image = lom_create_image(size, size, 1, format, error);
    if (image == NULL)
        return false;
    int samples = lom_describe_format(format)->channels, bits = lom_describe_format(format)->bits;
    for (int i = 0; i < size * size * samples; i++) {
        unsigned value = (unsigned)(lom_random_bits(4, (uint64_t)i) & 63) + (unsigned)(i % (size * samples)) * 2 + 60;
        if (bits == 8)
            image->pixels[i] = (uint8_t)value;
        else
            ((uint16_t *)(void *)image->pixels)[i] = (uint16_t)(value * 257);
    }
    bool written = lom_write_image(small_path(name), NULL, image, error);
    lom_free_image(image);
    return written;
}

static inline bool small_text(const char *name, const char *text, lom_error *error)
{
    return lom_write_file(small_path(name), text, strlen(text), error);
}

/* Makes the folder and its files; false after a message. */
static inline bool make_small_scene(void)
{
    static const char *const faces[] = { "right", "left", "top", "bottom", "front", "back" };
    lom_error error = { 0 };
    const char *base = getenv("TMPDIR");
    snprintf(small_folder, sizeof small_folder, "%.60s/lom-scene-XXXXXX", base != NULL ? base : "/tmp");
    bool made = mkdtemp(small_folder) != NULL && small_picture("height.png", 6, LOM_FORMAT_R16, &error) &&
                small_picture("color.png", 8, LOM_FORMAT_RGB8, &error) &&
                small_picture("layer.ppm", 4, LOM_FORMAT_RGB8, &error) &&
                small_picture("normal.png", 8, LOM_FORMAT_RGB8, &error) && small_text("box.obj", small_obj, &error) &&
                small_text("box.mtl", small_mtl, &error) && small_text("wires.obj", small_wires, &error) &&
                small_text("scene.toml", small_scene, &error);
    for (int i = 0; made && i < 6; i++) {
        char name[32];
        snprintf(name, sizeof name, "sky_%s.png", faces[i]);
        made = small_picture(name, 4, LOM_FORMAT_RGB8, &error);
    }
    if (!made)
        printf("FAIL small_scene: %s\n", error.text);
    return made;
}

/* Entries of the folder whose name contains the text. */
static inline int count_small_files(const char *text)
{
    DIR *folder = opendir(small_folder);
    int count = 0;
    for (struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;)
        count += entry->d_name[0] != 0 && strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0 &&
                 strstr(entry->d_name, text) != NULL;
    if (folder != NULL)
        closedir(folder);
    return count;
}

static inline void remove_small_scene(void)
{
    DIR *folder = opendir(small_folder);
    for (struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;)
        unlink(small_path(entry->d_name));
    if (folder != NULL)
        closedir(folder);
    rmdir(small_folder);
}

/* The hash of the first frame of the scene, read, loaded and drawn; false: the error says why. */
static inline bool draw_small_scene(const lom_device_desc *device, uint64_t *hash, lom_error *error)
{
    lom_frame frame = { .image = NULL };
    lom_scene *scene = lom_read_scene(small_path("scene.toml"), NULL, 0, error);
    lom_renderer *renderer = scene != NULL ? lom_create_renderer(scene, device, error) : NULL;
    bool done = renderer != NULL && lom_render_frame(renderer, &(lom_frame_desc){ 0 }, &frame, error);
    *hash = done ? lom_hash_image(frame.image) : 0;
    lom_free_image(frame.image);
    lom_free_renderer(renderer);
    lom_free_scene(scene);
    return done;
}

#endif
