/* Whole files. Proves: what was written is read; short and interrupted calls lose nothing; when any step of writing
 * fails (write, flush, close, rename, a full device, a size limit) the old content stays, no temporary file is left and
 * the error names the file; limits and special files. Twice: with temporary files that have no name, and where the
 * system has only such with names. */
#include "check.h"
#include "file_calls.h"

#include <signal.h>
#include <sys/resource.h>

static void round_trips(void)
{
    static uint8_t data[300000];
    static const size_t sizes[] = { 0, 1, 2, 4095, 4096, 65535, 65536, 65537, 300000 };
    lom_error error = { 0 };
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (uint8_t)lom_random_bits(1, i);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        CHECK(lom_write_file(path_of("a"), data, sizes[i], &error), "%s", error.text);
        CHECK(holds(path_of("a"), data, sizes[i]), "%zu bytes", sizes[i]);
    }
    inject.shorten = true;
    CHECK(lom_write_file(path_of("a"), data, 30000, &error), "%s", error.text);
    CHECK(holds(path_of("a"), data, 30000), "shortened");
    inject.shorten = false;
    CHECK(holds(path_of("a"), data, 30000), "shortened");
    CHECK(count_files() == 1, "%d files", count_files());
    CHECK(inject.fsyncs >= 2, "never flushed");
    unlink(path_of("a"));
}

static void keeps_mode_and_link(void)
{
    lom_error error = { 0 };
    struct stat status;
    lom_write_file(path_of("target"), "old", 3, &error);
    chmod(path_of("target"), 0640);
    CHECK(symlink("target", path_of("link")) == 0, "no link");
    CHECK(lom_write_file(path_of("link"), "new!", 4, &error), "%s", error.text);
    CHECK(lstat(path_of("link"), &status) == 0 && S_ISLNK(status.st_mode), "the link was replaced");
    CHECK(holds(path_of("target"), "new!", 4), "the target is not new");
    CHECK(stat(path_of("target"), &status) == 0 && (status.st_mode & 07777) == 0640, "mode %o", status.st_mode);
    unlink(path_of("link"));
    unlink(path_of("target"));
}

static void failures_keep_the_old(void)
{
    bool rename = false, *const faults[] = { &inject.write, &inject.fsync, &inject.close, &rename };
    lom_error error = { 0 };
    CHECK(lom_write_file(path_of("f"), "old content", 11, &error), "%s", error.text);
    for (int i = 0; i < 4; i++) {
        lom_error fault = { 0 };
        *faults[i] = true;
        inject.rename = rename ? EACCES : 0;
        bool written = lom_write_file(path_of("f"), "new", 3, &fault);
        *faults[i] = false;
        inject.rename = 0;
        CHECK(!written && fault.code == LOM_ERROR_FILE, "fault %d: code %d", i, fault.code);
        CHECK(strncmp(fault.text, path_of("f"), strlen(path_of("f"))) == 0, "%s", fault.text);
        CHECK(holds(path_of("f"), "old content", 11), "fault %d", i);
        CHECK(count_files() == 1, "fault %d: %d files", i, count_files());
    }
    unlink(path_of("f"));
}

static void size_limit_keeps_the_old(void)
{
    static uint8_t data[100000];
    lom_error error = { 0 };
    struct rlimit limit, before;
    CHECK(lom_write_file(path_of("l"), "old", 3, &error), "%s", error.text);
    getrlimit(RLIMIT_FSIZE, &before);
    limit = before;
    limit.rlim_cur = 50000;
    setrlimit(RLIMIT_FSIZE, &limit);
    bool written = lom_write_file(path_of("l"), data, sizeof data, &error); /* SIGXFSZ would end this program */
    setrlimit(RLIMIT_FSIZE, &before);
    CHECK(!written && error.code == LOM_ERROR_FILE, "code %d", error.code);
    CHECK(holds(path_of("l"), "old", 3), "the old content is gone");
    CHECK(count_files() == 1, "%d files", count_files());
    sigset_t pending, mask;
    sigpending(&pending);
    pthread_sigmask(SIG_SETMASK, NULL, &mask);
    CHECK(sigismember(&pending, SIGXFSZ) == 0 && sigismember(&mask, SIGXFSZ) == 0, "the signal's state changed");
    unlink(path_of("l"));
}

static void special_files(void)
{
    lom_error error = { 0 };
    CHECK(!lom_write_file("/dev/full", "x", 1, &error) && error.code == LOM_ERROR_FILE, "%s", error.text);
    CHECK(strstr(error.text, "/dev/full") != NULL, "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(lom_write_file("/dev/null", "x", 1, &error), "%s", error.text);
    CHECK(!lom_write_file("/nowhere/x", "x", 1, &error) && error.code == LOM_ERROR_FILE, "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(!lom_write_file(folder, "x", 1, &error) && error.code == LOM_ERROR_FILE, "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(lom_read_file(folder, 100, &error).data == NULL && error.code == LOM_ERROR_FILE, "%s", error.text);
    error = (lom_error){ 0 };
    CHECK(lom_read_file("/nowhere/x", 100, &error).data == NULL && error.code == LOM_ERROR_FILE, "%s", error.text);
    lom_bytes null = lom_read_file("/dev/null", 0, NULL);
    CHECK(null.data != NULL && null.size == 0, "an empty file");
    lom_release(null.data);
    lom_bytes status = lom_read_file("/proc/self/status", 1 << 20, NULL); /* says size 0 */
    CHECK(status.data != NULL && status.size > 100, "%zu bytes", status.size);
    lom_release(status.data);
    error = (lom_error){ 0 };
    CHECK(lom_read_file("/dev/zero", 200000, &error).data == NULL && error.code == LOM_ERROR_LIMIT, "%s", error.text);
    CHECK(count_files() == 0, "%d files", count_files());
}

static void limits(void)
{
    lom_error error = { 0 };
    CHECK(lom_write_file(path_of("n"), "12345", 5, &error), "%s", error.text);
    lom_bytes bytes = lom_read_file(path_of("n"), 5, &error);
    CHECK(bytes.size == 5 && error.code == LOM_OK, "%s", error.text);
    lom_release(bytes.data);
    bytes = lom_read_file(path_of("n"), 4, &error);
    CHECK(bytes.data == NULL && error.code == LOM_ERROR_LIMIT, "%s", error.text);
    bytes = lom_read_file(path_of("n"), SIZE_MAX, NULL);
    CHECK(bytes.size == 5, "%zu", bytes.size);
    lom_release(bytes.data);
    unlink(path_of("n"));
}

int main(int argc, char **argv)
{
    if (!make_folder()) {
        printf("FAIL test_file: no temporary folder\n");
        return 1;
    }
    for (int named = 0; named < 2; named++) {
        inject.named = named == 1;
        RUN(round_trips);
        RUN(keeps_mode_and_link);
        RUN(failures_keep_the_old);
        RUN(size_limit_keeps_the_old);
    }
    RUN(special_files);
    RUN(limits);
    rmdir(folder);
    return check_result();
}
