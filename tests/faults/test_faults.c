/* Proves what failing memory, files and threads do. Every allocation, system call on a file and start of a thread is
 * made to fail in turn (the first, the second ... until none is left to fail), once and from there on. After each: an
 * error with a code and a sentence, or the same result as without the fault; nothing leaked; no file half written and
 * none left behind. The linker puts the functions __wrap_* in the place of the real ones (Makefile: FAULTS). */
#include "check.h"
#include "small_scene.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>

/* ---- faults ---- */

typedef enum { NOTHING, MEMORY, FILES, THREADS } fault_kind;

static struct {
    fault_kind kind;
    bool lasting;     /* all from there on, not that one alone */
    int at;           /* which call fails, from 0 */
    atomic_int calls; /* of the kind, so far */
    atomic_long held; /* allocations not yet released */
    int file_error;
} fault;

static bool fails(fault_kind kind)
{
    if (fault.kind != kind)
        return false;
    int call = atomic_fetch_add(&fault.calls, 1);
    return fault.lasting ? call >= fault.at : call == fault.at;
}

static bool file_fails(void)
{
    if (!fails(FILES))
        return false;
    errno = fault.file_error;
    return true;
}

void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_lom_release(void *memory);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument);
ssize_t __real_read(int descriptor, void *data, size_t size);
ssize_t __real_write(int descriptor, const void *data, size_t size);
int __real_openat(int folder, const char *path, int flags, ...);
int __real_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags);
int __real_fsync(int descriptor);
int __real_close(int descriptor);
int __real_renameat(int from_folder, const char *from, int to_folder, const char *to);

void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_lom_release(void *memory);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument);
ssize_t __wrap_read(int descriptor, void *data, size_t size);
ssize_t __wrap_write(int descriptor, const void *data, size_t size);
int __wrap_openat(int folder, const char *path, int flags, ...);
int __wrap_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags);
int __wrap_fsync(int descriptor);
int __wrap_close(int descriptor);
int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to);

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    if (fails(MEMORY))
        return NULL;
    void *memory = __real_aligned_alloc(alignment, size);
    atomic_fetch_add(&fault.held, memory != NULL);
    return memory;
}

void __wrap_lom_release(void *memory)
{
    atomic_fetch_sub(&fault.held, memory != NULL);
    __real_lom_release(memory);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument)
{
    return fails(THREADS) ? EAGAIN : __real_pthread_create(thread, attributes, run, argument);
}

ssize_t __wrap_read(int descriptor, void *data, size_t size)
{
    return file_fails() ? -1 : __real_read(descriptor, data, size);
}

ssize_t __wrap_write(int descriptor, const void *data, size_t size)
{
    return file_fails() ? -1 : __real_write(descriptor, data, size);
}

int __wrap_openat(int folder, const char *path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    return file_fails() ? -1 : __real_openat(folder, path, flags, mode);
}

int __wrap_linkat(int from_folder, const char *from, int to_folder, const char *to, int flags)
{
    return file_fails() ? -1 : __real_linkat(from_folder, from, to_folder, to, flags);
}

int __wrap_fsync(int descriptor)
{
    return file_fails() ? -1 : __real_fsync(descriptor);
}

int __wrap_close(int descriptor)
{
    int closed = __real_close(descriptor); /* a close that fails has closed all the same */
    return file_fails() ? -1 : closed;
}

int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to)
{
    return file_fails() ? -1 : __real_renameat(from_folder, from, to_folder, to);
}

/* ---- tasks ---- */

/* Does something and gives a hash of the result. False: the error says why. */
typedef bool task(const char *file, uint64_t *hash, lom_error *error);

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

/* ---- the loop ---- */

/* Lets the n-th call of the kind fail, for every n, until the task makes fewer calls. Returns how many there were. */
static int fail_each(task *run, const char *file, fault_kind kind, bool lasting, void (*check)(bool done))
{
    uint64_t whole = 0;
    lom_error none = { 0 };
    CHECK(run(file, &whole, &none), "%s without a fault: %s", file, none.text);
    for (int n = 0;; n++) {
        lom_error error = { 0 };
        uint64_t hash = 0;
        long before = atomic_load(&fault.held);
        atomic_store(&fault.calls, 0);
        fault.at = n;
        fault.lasting = lasting;
        fault.kind = kind;
        bool done = run(file, &hash, &error);
        fault.kind = NOTHING;
        CHECK(atomic_load(&fault.held) == before, "%s, fault %d: %ld allocations leaked", file, n,
              atomic_load(&fault.held) - before);
        size_t length = strlen(error.text);
        if (done)
            CHECK(hash == whole && error.code == LOM_OK, "%s, fault %d: another result, code %d", file, n, error.code);
        else
            CHECK(error.code != LOM_OK && length > 10 && error.text[length - 1] == '.', "%s, fault %d: code %d, \"%s\"",
                  file, n, error.code, error.text);
        CHECK(done || kind != MEMORY || error.code == LOM_ERROR_MEMORY, "%s, fault %d: code %d, \"%s\"", file, n,
              error.code, error.text);
        CHECK(count_small_files(".lom-") == 0, "%s, fault %d: a temporary file is left", file, n);
        if (check != NULL)
            check(done);
        if (atomic_load(&fault.calls) <= n)
            return n;
    }
}

/* Both loops see the same allocations, but for `slack` of them. */
static void fail_memory(task *run, const char *file, int least, int slack)
{
    int once = fail_each(run, file, MEMORY, false, NULL), lasting = fail_each(run, file, MEMORY, true, NULL);
    CHECK(once >= least && once - lasting <= slack && lasting - once <= slack, "%s: %d allocations, %d", file, once,
          lasting);
}

static void every_failing_allocation_is_an_error(void)
{
    static const char *const pictures[] = { "color.png", "gray.png", "p.ppm", "p.pgm", "p.pam", "p.pfm" };
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++)
        fail_memory(read_picture, pictures[i], 3, 0);
    fail_memory(make_mip_levels, "color.png", 6, 0);
    fail_memory(read_mesh, "box.obj", 8, 0);
    fail_memory(read_scene, "scene.toml", 3, 0);
    fail_memory(write_picture, "out.png", 3, 0);
    fail_memory(write_picture, "out.ppm", 1, 0);
    fail_memory(write_pieces, "out.txt", 3, 0);
}

/* A worker reserves its five arrays when it first gets a chunk; how many of the three do depends on the moment. */
enum { WORKERS_ARRAYS = 3 * 5 };

static void every_failing_allocation_of_a_frame_is_an_error(void)
{
    fail_memory(draw_scene, "scene.toml", 100, WORKERS_ARRAYS);
}

static void every_fault_of_reading_is_an_error(void)
{
    fault.file_error = EIO;
    CHECK(fail_each(read_picture, "color.png", FILES, false, NULL) >= 3, "few calls");
    CHECK(fail_each(read_mesh, "box.obj", FILES, false, NULL) >= 6, "few calls");
    CHECK(fail_each(read_scene, "scene.toml", FILES, true, NULL) >= 3, "few calls");
    CHECK(fail_each(draw_scene, "scene.toml", FILES, false, NULL) >= 30, "few calls");
}

/* Without workers the caller's thread does all the work. */
static void threads_that_do_not_start_change_nothing(void)
{
    CHECK(fail_each(draw_scene, "scene.toml", THREADS, false, NULL) == 2, "threads started");
    CHECK(fail_each(draw_scene, "scene.toml", THREADS, true, NULL) == 2, "threads started");
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
            CHECK(fail_each(write_picture, "out.png", FILES, lasting == 1, check_old_or_new) >= 5, "few calls");
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
    CHECK(fail_each(write_picture, "out.png", FILES, false, check_done) >= 8, "few calls");
    CHECK(fail_each(write_pieces, "out.png", FILES, false, check_done) >= 10, "few calls");
    CHECK(fail_each(read_picture, "color.png", FILES, false, check_done) >= 3, "few calls");
    CHECK(fail_each(read_scene, "scene.toml", FILES, false, check_done) >= 3, "few calls");
    CHECK(fail_each(draw_scene, "scene.toml", FILES, false, check_done) >= 30, "few calls");
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
