/* Proves what failing memory, files and threads do to reading, writing and drawing, each at every call (faults.h). */
#include "../image/coded_files.h"
#include "faults.h"

/* ---- tasks ---- */

static bool read_picture(const char *file, uint64_t *hash, lom_error *error)
{
    lom_image *image = lom_read_image(small_path(file), error);
    *hash = image != NULL ? lom_hash_image(image) : 0;
    lom_free_image(image);
    return image != NULL;
}

static bool read_mesh(const char *file, uint64_t *hash, lom_error *error)
{
    lom_mesh *mesh = lom_read_obj(small_path(file), error);
    *hash =
        mesh != NULL ? lom_hash_bytes(LOM_HASH_START, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices) : 0;
    lom_free_mesh(mesh);
    return mesh != NULL;
}

static bool read_scene(const char *file, uint64_t *hash, lom_error *error)
{
    static const char *const overrides[] = { "water.level=0.5", "entity.box.position=[1, 2, 3]" };
    lom_scene *scene = lom_read_scene(small_path(file), overrides, 2, error);
    *hash = scene != NULL ? scene->entity_count + 1 : 0;
    lom_free_scene(scene);
    return scene != NULL;
}

static bool draw_scene(const char *file, uint64_t *hash, lom_error *error)
{
    (void)file;
    return draw_small_scene(&(lom_device_desc){ .threads = 3, .tile = 16, .chunk = 16 }, hash, error);
}

static bool make_mip_levels(const char *file, uint64_t *hash, lom_error *error)
{
    lom_image *image = lom_read_image(small_path(file), error);
    lom_texture *texture = image != NULL ? lom_texture_of_image(image, true, LOM_MIPS_ALL, error) : NULL;
    lom_image *level = texture != NULL ? lom_read_texture(texture, 1, 0, error) : NULL;
    *hash = level != NULL ? lom_hash_image(level) : 0;
    lom_free_image(level);
    lom_free_texture(texture);
    lom_free_image(image);
    return level != NULL;
}

static lom_image *result_picture; /* made before the faults begin */

static bool write_picture(const char *file, uint64_t *hash, lom_error *error)
{
    *hash = 1;
    return lom_write_image(small_path(file), NULL, result_picture, error);
}

static bool write_pieces(const char *file, uint64_t *hash, lom_error *error)
{
    *hash = 1;
    lom_writer *writer = lom_open_writer(small_path(file), error);
    if (writer == NULL)
        return false;
    lom_append(writer, "one", 3, error);
    lom_append(writer, "two", 3, error);
    return lom_close_writer(writer, error);
}

static void every_failing_allocation_is_an_error(void)
{
    static const char *const pictures[] = { "color.png", "gray.png", "p.ppm", "p.pgm", "p.pam", "p.pfm" };
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++)
        fail_memory(read_picture, pictures[i], 3, 0, 0);
    fail_memory(make_mip_levels, "color.png", 6, 0, 0);
    coded_file file = begin_dds(&(dds_fields){ .width = 9, .height = 6, .levels = 4, .code = "DXT1" });
    append_random(&file, 1, 80);
    CHECK(lom_write_file(small_path("levels.dds"), file.data, file.size, NULL), "a file with levels");
    free(file.data);
    fail_memory(read_picture, "levels.dds", 9, 0, 0); /* the file, four images and their pixels */
    fail_memory(make_mip_levels, "levels.dds", 12, 0, 0);
    fail_memory(read_mesh, "box.obj", 8, 0, 0);
    fail_memory(read_scene, "scene.toml", 3, 0, 0);
    fail_memory(write_picture, "out.png", 3, 0, 0);
    fail_memory(write_picture, "out.ppm", 1, 0, 0);
    fail_memory(write_pieces, "out.txt", 3, 0, 0);
}

/* A worker reserves its five arrays when it first gets a chunk; how many of the three do depends on the moment. */
enum { WORKERS_ARRAYS = 3 * 5 };

static void every_failing_allocation_of_a_frame_is_an_error(void)
{
    fail_memory(draw_scene, "scene.toml", 100, WORKERS_ARRAYS, 0);
}

static void every_fault_of_reading_is_an_error(void)
{
    fault.file_error = EIO;
    CHECK(fail_each(read_picture, "color.png", &(fault_plan){ .kind = FILES }) >= 3, "few calls");
    CHECK(fail_each(read_mesh, "box.obj", &(fault_plan){ .kind = FILES }) >= 6, "few calls");
    CHECK(fail_each(read_scene, "scene.toml", &(fault_plan){ .kind = FILES, .lasting = true }) >= 3, "few calls");
    CHECK(fail_each(draw_scene, "scene.toml", &(fault_plan){ .kind = FILES }) >= 30, "few calls");
}

/* Without workers the caller's thread does all the work. */
static void threads_that_do_not_start_change_nothing(void)
{
    CHECK(fail_each(draw_scene, "scene.toml", &(fault_plan){ .kind = THREADS }) == 2, "threads started");
    CHECK(fail_each(draw_scene, "scene.toml", &(fault_plan){ .kind = THREADS, .lasting = true }) == 2,
          "threads started");
}

static const char old_content[] = "what was there before";

/* The file is the old one or a whole new one; made old again for the next fault. */
static void check_old_or_new(bool done)
{
    lom_error error = { 0 };
    lom_bytes bytes = lom_read_file(small_path("out.png"), 1 << 20, &error);
    bool old = bytes.size == strlen(old_content) && memcmp(bytes.data, old_content, bytes.size) == 0;
    lom_image *image = old ? NULL : lom_decode_image(bytes.data, bytes.size, "out.png", &error);
    bool whole = image != NULL && lom_hash_image(image) == lom_hash_image(result_picture);
    CHECK(bytes.data != NULL && (old || whole) && (!done || whole), "the file has %zu bytes of neither", bytes.size);
    lom_free_image(image);
    lom_release(bytes.data);
    CHECK(small_text("out.png", old_content, &error), "%s", error.text);
}

static void every_fault_of_writing_keeps_the_old_file(void)
{
    static const int errors[] = { ENOSPC, EIO, EACCES, EROFS };
    for (int i = 0; i < 4; i++)
        for (int lasting = 0; lasting < 2; lasting++) {
            fault.file_error = errors[i];
            check_old_or_new(false);
            CHECK(fail_each(write_picture, "out.png",
                            &(fault_plan){ .kind = FILES, .lasting = lasting == 1, .check = check_old_or_new }) >= 5,
                  "few calls");
        }
}

static void check_done(bool done)
{
    CHECK(done, "an interrupted call was an error");
}

/* EINTR is no error: the call is made again. */
static void interrupted_calls_are_made_again(void)
{
    fault.file_error = EINTR;
    CHECK(fail_each(write_picture, "out.png", &(fault_plan){ .kind = FILES, .check = check_done }) >= 8, "few calls");
    CHECK(fail_each(write_pieces, "out.png", &(fault_plan){ .kind = FILES, .check = check_done }) >= 10, "few calls");
    CHECK(fail_each(read_picture, "color.png", &(fault_plan){ .kind = FILES, .check = check_done }) >= 3, "few calls");
    CHECK(fail_each(read_scene, "scene.toml", &(fault_plan){ .kind = FILES, .check = check_done }) >= 3, "few calls");
    CHECK(fail_each(draw_scene, "scene.toml", &(fault_plan){ .kind = FILES, .check = check_done }) >= 30, "few calls");
}

static bool make_pictures(void)
{
    lom_error error = { 0 };
    static const struct {
        const char *name;
        lom_format format;
    } pictures[] = { { "gray.png", LOM_FORMAT_R16 },
                     { "p.ppm", LOM_FORMAT_RGB8 },
                     { "p.pgm", LOM_FORMAT_R8 },
                     { "p.pam", LOM_FORMAT_RGBA16 } };
    bool made = make_small_scene();
    for (int i = 0; made && i < 4; i++)
        made = small_picture(pictures[i].name, 7, pictures[i].format, &error);
    result_picture = made ? lom_read_image(small_path("color.png"), &error) : NULL;
    lom_image *floats = result_picture != NULL ? lom_convert_image(result_picture, LOM_FORMAT_RGB32F, &error) : NULL;
    made = floats != NULL && lom_write_image(small_path("p.pfm"), NULL, floats, &error);
    lom_free_image(floats);
    return made;
}

int main(int argc, char **argv)
{
    if (!make_pictures())
        return 1;
    RUN(every_failing_allocation_is_an_error);
    RUN(every_failing_allocation_of_a_frame_is_an_error);
    RUN(every_fault_of_reading_is_an_error);
    RUN(threads_that_do_not_start_change_nothing);
    RUN(every_fault_of_writing_keeps_the_old_file);
    RUN(interrupted_calls_are_made_again);
    lom_free_image(result_picture);
    remove_small_scene();
    return check_result();
}
