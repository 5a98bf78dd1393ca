/* Proves of the pictures of a world: deep ones stay deep, a flow map is made from the file of the normal map, the faces
 * of a sky are squares of one size, and a sky of one file is that of six. */
#include "../image/coded_files.h"
#include "world_case.h"

static void deep_pictures_stay_deep(void)
{
    if (!open_good(BOX))
        return;
    lom_error error = { 0 };
    const lom_image *deep = lom_world_picture(world, small_path("height.png"), &error);
    CHECK(deep != NULL && deep->format == LOM_FORMAT_RGBA16, "%s", error.text);
    close_world();
}

/* The normal map is asked for by the water too: it is decoded with the flow map. */
static void the_flow_map_is_made_from_the_file(void)
{
    if (!open_good("[water]\nnormal_map = 'normal.png'\n"))
        return;
    lom_error error = { 0 };
    lom_image *file = lom_read_image(small_path("normal.png"), &error);
    lom_image *flow = lom_make_flow_map(file, &error), *expected = lom_convert_image(flow, LOM_FORMAT_RGBA8, &error);
    const lom_image *made = lom_world_made_flow(world, scene->water.normal_map, &error);
    CHECK(made != NULL && expected != NULL && lom_hash_image(made) == lom_hash_image(expected), "%s", error.text);
    remove(small_path("normal.png"));
    CHECK(lom_world_made_flow(world, scene->water.normal_map, &error) == made &&
              lom_world_picture(world, small_path("normal.png"), &error) != NULL,
          "%s", error.text);
    lom_free_image(file);
    lom_free_image(flow);
    lom_free_image(expected);
    close_world();
    CHECK(small_picture("normal.png", 8, LOM_FORMAT_RGB8, NULL), "put back");
}

/* The last of six faces has this side; what is said of it. */
static lom_error read_sky(int side)
{
    lom_error error = { 0 };
    CHECK(small_picture("sky_back.png", side, LOM_FORMAT_RGB8, &error), "%s", error.text);
    if (open_world("[sky]\npattern = 'sky_%s.png'\n", &error)) {
        lom_image *faces = lom_read_sky_faces(&scene->sky, NULL, &error);
        CHECK((faces != NULL) == (error.code == LOM_OK), "%s", error.text);
        for (int i = 0; faces != NULL && i < 6; i++) {
            lom_image *file = lom_read_image(scene->sky.faces[i], &error);
            lom_image *face = lom_convert_image(file, LOM_FORMAT_RGBA8, &error);
            CHECK(faces->depth == 6 && memcmp(lom_image_pixel(faces, 0, 0, i), face->pixels, lom_image_size(face)) == 0,
                  "face %d", i);
            lom_free_image(file);
            lom_free_image(face);
        }
        lom_free_image(faces);
    }
    close_world();
    return error;
}

static void the_faces_of_a_sky_are_squares_of_one_size(void)
{
    lom_error error = read_sky(4);
    CHECK(error.code == LOM_OK, "%s", error.text);
    error = read_sky(5);
    CHECK(strstr(error.text, "squares of one size") != NULL && strstr(error.text, "5x5") != NULL, "%s", error.text);
    read_sky(4);
}

/* The same six pictures in one file, as a cube in DDS. */
static void a_sky_of_one_file_is_that_of_six(void)
{
    lom_error error = read_sky(4);
    coded_file file = begin_dds(&(dds_fields){
        .width = 4, .height = 4, .flags = 0x40, .bits = 24, .mask = { 0xff, 0xff00, 0xff0000 }, .caps = 0xfe00 });
    static const char *const names[6] = { "right", "left", "top", "bottom", "front", "back" };
    for (int i = 0; i < 6; i++) {
        char name[32];
        snprintf(name, sizeof name, "sky_%s.png", names[i]);
        lom_image *face = lom_read_image(small_path(name), &error);
        CHECK(face != NULL && face->format == LOM_FORMAT_RGB8 && face->width == 4, "%s", error.text);
        append_bytes(&file, face->pixels, 48);
        lom_free_image(face);
    }
    CHECK(lom_write_file(small_path("sky.dds"), file.data, file.size, &error), "%s", error.text);
    free(file.data);
    uint64_t hash[2] = { 0, 1 };
    for (int i = 0; i < 2; i++) {
        if (open_good(i == 0 ? "[sky]\npattern = 'sky_%s.png'\n" : "[sky]\ncube = 'sky.dds'\n")) {
            lom_image *faces = lom_read_sky_faces(&scene->sky, NULL, &error);
            CHECK(faces != NULL, "%s", error.text);
            hash[i] = faces != NULL ? lom_hash_image(faces) : 0;
            lom_free_image(faces);
        }
        close_world();
    }
    CHECK(hash[0] == hash[1], "another sky");
    if (open_good("[sky]\ncube = 'color.png'\n"))
        CHECK(lom_read_sky_faces(&scene->sky, NULL, &error) == NULL &&
                  strstr(error.text, "no cube of six faces") != NULL,
              "%s", error.text);
    close_world();
    error = (lom_error){ 0 };
    CHECK(!open_world("[sky]\ncube = 'sky.dds'\npattern = 'sky_%s.png'\n", &error) &&
              strstr(error.text, "a cube, a pattern or faces") != NULL,
          "%s", error.text);
    close_world();
}

int main(int argc, char **argv)
{
    if (!make_small_scene())
        return 1;
    RUN(deep_pictures_stay_deep);
    RUN(the_flow_map_is_made_from_the_file);
    RUN(the_faces_of_a_sky_are_squares_of_one_size);
    RUN(a_sky_of_one_file_is_that_of_six);
    remove_small_scene();
    return check_result();
}
