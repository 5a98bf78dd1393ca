/* Files written piece by piece. Proves: a path holds its old content until the output is closed, and after a failure;
 * links are followed as open(O_CREAT) does; whatever the system takes as a path is one; several writers are each whole;
 * special files and open descriptors are written where they stand, also when they do not block or their reader goes
 * away; files whose folder is closed, or that are mounted upon, are written in place; nothing that was left behind
 * blocks, what a signal ends leaves nothing, and an output too many harms no other. */
#include "check.h"
#include "file_calls.h"

#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

static bool put(const char *path, const char *text, lom_error *error)
{
    *error = (lom_error){ 0 };
    return lom_write_file(path, text, strlen(text), error);
}

static void pieces_appear_at_once(void)
{
    lom_error error = { 0 };
    CHECK(put(path_of("p"), "old", &error), "%s", error.text);
    lom_writer *w = lom_open_writer(path_of("p"), &error);
    CHECK(w != NULL && lom_append(w, "one ", 4, &error) && lom_append(w, NULL, 0, &error), "%s", error.text);
    CHECK(holds(path_of("p"), "old", 3), "changed before it was closed");
    CHECK(count_files() == 1 + (inject.named || inject.unnameable), "%d files", count_files());
    CHECK(lom_append(w, "two", 3, &error) && lom_close_writer(w, &error), "%s", error.text);
    CHECK(holds(path_of("p"), "one two", 7), "not what was appended");
    w = lom_open_writer(path_of("p"), &error);
    CHECK(lom_append(w, "x", 1, &error), "%s", error.text);
    lom_abandon_writer(w);
    CHECK(holds(path_of("p"), "one two", 7) && count_files() == 1, "an abandoned output left something");
    w = lom_open_writer(path_of("p"), &error);
    inject.write = true;
    CHECK(!lom_append(w, "x", 1, &error) && strstr(error.text, strerror(ENOSPC)) != NULL, "%s", error.text);
    inject.write = false;
    CHECK(!lom_append(w, "y", 1, NULL) && !lom_close_writer(w, NULL), "a failed output went on");
    error = (lom_error){ 0 };
    inject.takes_nothing = true;
    CHECK(!put(path_of("p"), "z", &error) && strstr(error.text, strerror(EIO)) != NULL, "%s", error.text);
    inject.takes_nothing = false;
    CHECK(holds(path_of("p"), "one two", 7) && count_files() == 1, "a failed output left something");
    lom_abandon_writer(NULL);
    unlink(path_of("p"));
}

static void links_stay_links(void)
{
    lom_error error = { 0 };
    struct stat status;
    mkdir(path_of("art"), 0777);
    CHECK(symlink("art/o", path_of("link")) == 0 && symlink("art/../link", path_of("chain")) == 0, "no links");
    CHECK(put(path_of("chain"), "first", &error) && holds(path_of("art/o"), "first", 5), "%s", error.text);
    CHECK(put(path_of("chain"), "second", &error) && holds(path_of("art/o"), "second", 6), "%s", error.text);
    CHECK(lstat(path_of("link"), &status) == 0 && S_ISLNK(status.st_mode), "the link was replaced");
    CHECK(lstat(path_of("chain"), &status) == 0 && S_ISLNK(status.st_mode), "the link was replaced");
    unlink(path_of("art/o"));
    unlink(path_of("link"));
    unlink(path_of("chain"));
    static const struct {
        const char *to;
        int reason;
    } bad[] = { { "absent/o", ENOENT }, { "bad", ELOOP },      { "art", EISDIR }, { "art/", EISDIR },
                { "new/", EISDIR },     { "art/o/o", ENOENT }, { "..", EISDIR },  { "/", EISDIR } };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        CHECK(symlink(bad[i].to, path_of("bad")) == 0, "no link");
        CHECK(!put(path_of("bad"), "x", &error) && error.code == LOM_ERROR_FILE, "a link to %s was written", bad[i].to);
        CHECK(strstr(error.text, strerror(bad[i].reason)) != NULL || bad[i].to[0] == 'n', "%s: %s", bad[i].to,
              error.text);
        unlink(path_of("bad"));
    }
    CHECK(!put("", "x", &error) && strstr(error.text, strerror(ENOENT)) != NULL, "%s", error.text);
    CHECK(!put(path_of("new/"), "x", &error), "a folder that is not there was written");
    CHECK(rmdir(path_of("art")) == 0 && count_files() == 0, "%d files", count_files());
}

/* A name of 255 bytes, a path of 4095; and one byte more of either has a reason, which a long path does not hide. */
static void long_names_and_paths(void)
{
    static char path[5000];
    lom_error error = { 0 };
    char part[257];
    memset(part, 'c', 256);
    part[256] = 0;
    snprintf(path, sizeof path, "%s/%s", folder, part + 1);
    CHECK(put(path, "x", &error) && holds(path, "x", 1), "%s", error.text);
    unlink(path);
    snprintf(path, sizeof path, "%s/%s", folder, part);
    CHECK(!put(path, "x", &error) && strstr(error.text, strerror(ENAMETOOLONG)) != NULL, "%s", error.text);
    size_t length = strlen(folder), depth = 0;
    strcpy(path, folder);
    for (; length + 202 < 4094 && depth < 30; depth++, length += 201) {
        snprintf(path + length, 202, "/%s", part + 56);
        CHECK(mkdir(path, 0777) == 0, "%zu deep: %s", depth, strerror(errno));
    }
    memset(path + length, 'd', 4095 - length);
    path[length] = '/';
    path[4095] = 0;
    CHECK(put(path, "deep", &error) && put(path, "deeper", &error) && holds(path, "deeper", 6), "%s", error.text);
    unlink(path);
    path[4095] = 'd';
    CHECK(!put(path, "x", &error) && strstr(error.text, strerror(ENAMETOOLONG)) != NULL, "%s", error.text);
    path[length] = 0;
    CHECK(!put(path, "x", &error) && strstr(error.text, strerror(EISDIR)) != NULL, "%s", error.text);
    for (; depth > 0; depth--) {
        CHECK(rmdir(path) == 0, "%s", strerror(errno));
        path[length -= 201] = 0;
    }
    CHECK(count_files() == 0, "%d files", count_files());
}

enum { WRITERS = 4, ROUNDS = 30, LENGTH = 5000 };

static void *write_often(void *letter)
{
    char text[LENGTH];
    memset(text, *(char *)letter, LENGTH);
    for (int i = 0; i < ROUNDS; i++)
        if (!lom_write_file(path_of("shared"), text, LENGTH, NULL))
            return letter;
    return NULL;
}

static void writers_are_each_whole(void)
{
    pthread_t threads[WRITERS];
    char letters[WRITERS] = "abcd";
    int torn = 0, failed = 0;
    CHECK(lom_write_file(path_of("shared"), "", 0, NULL), "not begun");
    for (int i = 0; i < WRITERS; i++)
        pthread_create(&threads[i], NULL, write_often, &letters[i]);
    for (int i = 0; i < ROUNDS; i++) {
        lom_bytes seen = lom_read_file(path_of("shared"), LENGTH, NULL);
        bool whole = seen.data != NULL && (seen.size == 0 || seen.size == LENGTH);
        for (size_t at = 1; whole && at < seen.size; at++)
            whole = seen.data[at] == seen.data[0];
        torn += !whole;
        lom_release(seen.data);
    }
    for (int i = 0; i < WRITERS; i++) {
        void *result;
        pthread_join(threads[i], &result);
        failed += result != NULL;
    }
    CHECK(torn == 0 && failed == 0 && count_files() == 1, "%d torn, %d failed, %d files", torn, failed, count_files());
    unlink(path_of("shared"));
}

static void *read_slowly(void *descriptor)
{
    static char text[300001];
    size_t size = 0;
    for (ssize_t got = 1; got > 0 && size < sizeof text; size += (size_t)(got > 0 ? got : 0)) {
        usleep(200);
        got = syscall(SYS_read, *(int *)descriptor, text + size, sizeof text - size < 9000 ? sizeof text - size : 9000);
    }
    for (size_t i = 0; i < size; i++)
        if (text[i] != (char)(i % 251))
            return NULL;
    return size == 300000 ? text : NULL;
}

/* A pipe that does not block gives EAGAIN when it is full. */
static void descriptors_are_written_where_they_stand(void)
{
    static char data[300000];
    lom_error error = { 0 };
    char name[32];
    int ends[2], pair[2] = { -1, -1 };
    pthread_t reader;
    void *whole = NULL;
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (char)(i % 251);
    CHECK(pipe(ends) == 0 && fcntl(ends[1], F_SETFL, O_NONBLOCK) == 0, "no pipe");
    pthread_create(&reader, NULL, read_slowly, &ends[0]);
    snprintf(name, sizeof name, "/dev/fd/%d", ends[1]);
    CHECK(lom_write_file(name, data, sizeof data, &error), "%s", error.text);
    close(ends[1]); /* was not closed before: the reader waits for this */
    pthread_join(reader, &whole);
    CHECK(whole != NULL, "the pipe carried something else");
    close(ends[0]);
    CHECK(pipe(ends) == 0 && close(ends[0]) == 0, "no pipe");
    snprintf(name, sizeof name, "/proc/self/fd/%d", ends[1]);
    CHECK(!put(name, "x", &error) && strstr(error.text, strerror(EPIPE)) != NULL, "%s", error.text); /* no SIGPIPE */
    close(ends[1]);
    CHECK(!put(name, "x", &error) && strstr(error.text, strerror(EBADF)) != NULL, "%s", error.text);
    pair[0] = open(path_of("log"), O_RDWR | O_CREAT | O_TRUNC, 0666);
    CHECK(syscall(SYS_write, pair[0], "before ", 7) == 7, "no file");
    snprintf(name, sizeof name, "/dev/fd/%d", pair[0]);
    CHECK(put(name, "after", &error) && holds(path_of("log"), "before after", 12), "%s", error.text);
    close(pair[0]);
    unlink(path_of("log"));
}

static void special_files_stay(void)
{
    lom_error error = { 0 };
    struct stat status;
    char text[8] = "";
    CHECK(mkfifo(path_of("fifo"), 0600) == 0 && symlink("fifo", path_of("link")) == 0, "no FIFO");
    int reader = open(path_of("fifo"), O_RDWR | O_NONBLOCK);
    CHECK(put(path_of("link"), "fifo", &error), "%s", error.text);
    CHECK(syscall(SYS_read, reader, text, 7) == 4 && strcmp(text, "fifo") == 0, "%s", text);
    CHECK(lstat(path_of("fifo"), &status) == 0 && S_ISFIFO(status.st_mode), "the FIFO was replaced");
    CHECK(count_files() == 2, "%d files", count_files());
    inject.fsync = true;
    CHECK(!put(path_of("fifo"), "lost", &error) && strstr(error.text, "flush") != NULL, "%s", error.text);
    inject.fsync = false;
    close(reader);
    unlink(path_of("fifo"));
    unlink(path_of("link"));
}

static void what_cannot_be_replaced_is_written_in_place(void)
{
    lom_error error = { 0 };
    struct stat before, after;
    CHECK(put(path_of("f"), "a longer old text", &error) && stat(path_of("f"), &before) == 0, "%s", error.text);
    inject.rename = EBUSY;
    CHECK(put(path_of("f"), "mounted", &error) && holds(path_of("f"), "mounted", 7), "%s", error.text);
    lom_writer *w = lom_open_writer(path_of("f"), &error);
    CHECK(w != NULL && lom_append(w, "too much", 8, &error), "%s", error.text);
    inject.write = true;
    CHECK(!lom_close_writer(w, &error) && strstr(error.text, "copy the finished file") != NULL &&
              strstr(error.text, strerror(ENOSPC)) != NULL,
          "%s", error.text);
    inject.write = false;
    inject.rename = 0;
    inject.create = EACCES;
    CHECK(put(path_of("f"), "closed", &error) && holds(path_of("f"), "closed", 6), "%s", error.text);
    CHECK(!put(path_of("g"), "x", &error) && strstr(error.text, strerror(EACCES)) != NULL, "%s", error.text);
    inject.create = ENOSPC;
    CHECK(!put(path_of("f"), "x", &error) && strstr(error.text, strerror(ENOSPC)) != NULL, "%s", error.text);
    CHECK(holds(path_of("f"), "closed", 6), "a full disk emptied the file");
    inject.create = 0;
    CHECK(stat(path_of("f"), &after) == 0 && after.st_ino == before.st_ino, "it is another file");
    CHECK(count_files() == 1, "%d files", count_files());
    unlink(path_of("f"));
}

/* As another user than root, whom no mode stops. */
static void modes_and_owners(void)
{
    lom_error error = { 0 };
    struct stat status;
    bool root = geteuid() == 0;
    CHECK(put(path_of("f"), "old", &error) && chmod(path_of("f"), 0444) == 0 && chmod(folder, 0777) == 0, "no file");
    if (root && (chown(path_of("f"), 65534, 65534) != 0 || setegid(65534) != 0 || seteuid(65534) != 0))
        return;
    CHECK(!put(path_of("f"), "new", &error) && strstr(error.text, strerror(EACCES)) != NULL, "%s", error.text);
    CHECK(chmod(path_of("f"), 0604) == 0 && put(path_of("f"), "new", &error) && holds(path_of("f"), "new", 3), "%s",
          error.text);
    if (root && (seteuid(0) != 0 || setegid(0) != 0))
        return;
    CHECK(put(path_of("f"), "newer", &error), "%s", error.text);
    CHECK(stat(path_of("f"), &status) == 0 && (status.st_mode & 07777) == 0604, "mode %o", status.st_mode);
    CHECK(!root || (status.st_uid == 65534 && status.st_gid == 65534), "owner %d", (int)status.st_uid);
    inject.chmod = true;
    CHECK(!put(path_of("f"), "lost", &error) && strstr(error.text, "keep its permissions") != NULL, "%s", error.text);
    inject.chmod = false;
    CHECK(holds(path_of("f"), "newer", 5) && count_files() == 1, "a mode that cannot be kept lost the file");
    unlink(path_of("f"));
}

/* Who may write to another user's program, but not own it, does not make one that runs as himself for everybody. */
static void rights_of_another_user_go(void)
{
    lom_error error = { 0 };
    struct stat status;
    if (geteuid() != 0)
        return;
    CHECK(put(path_of("f"), "old", &error) && chmod(path_of("f"), 06777) == 0 && chmod(folder, 0777) == 0, "no file");
    if (setegid(65534) != 0 || seteuid(65534) != 0)
        return;
    CHECK(put(path_of("f"), "new", &error) && holds(path_of("f"), "new", 3), "%s", error.text);
    CHECK(seteuid(0) == 0 && setegid(0) == 0, "not root again");
    CHECK(stat(path_of("f"), &status) == 0 && status.st_uid == 65534 && (status.st_mode & 07777) == 0777,
          "mode %o of %d", status.st_mode, (int)status.st_uid);
    unlink(path_of("f"));
}

/* As many outputs as can be open, and one more: it fails, and the others do not notice. */
static void one_output_too_many(void)
{
    enum { MANY = 600 };
    static lom_writer *writers[MANY];
    lom_error error = { 0 };
    struct rlimit before, more;
    char name[16];
    int count = 0;
    CHECK(getrlimit(RLIMIT_NOFILE, &before) == 0, "no limit");
    more = before;
    more.rlim_cur = before.rlim_max < 4 * MANY ? before.rlim_max : 4 * MANY;
    CHECK(setrlimit(RLIMIT_NOFILE, &more) == 0, "the limit stays");
    for (; count < MANY; count++) {
        snprintf(name, sizeof name, "many%d", count);
        writers[count] = lom_open_writer(path_of(name), &error);
        if (writers[count] == NULL)
            break;
    }
    CHECK(count < MANY && count > 100 && strstr(error.text, strerror(EMFILE)) != NULL, "%d, %s", count, error.text);
    CHECK(count_files() == count, "%d files of %d", count_files(), count);
    error = (lom_error){ 0 };
    CHECK(lom_append(writers[0], "first", 5, &error) && lom_close_writer(writers[0], &error), "%s", error.text);
    for (int i = 1; i < count; i++)
        lom_abandon_writer(writers[i]);
    CHECK(holds(path_of("many0"), "first", 5) && count_files() == 1, "%d files", count_files());
    unlink(path_of("many0"));
    CHECK(setrlimit(RLIMIT_NOFILE, &before) == 0, "the limit stays");
}

static void end_by_signal(int number)
{
    lom_remove_temporaries();
    signal(number, SIG_DFL);
    raise(number);
}

static void *write_on(void *name)
{
    for (;;)
        lom_write_file(name, "text", 4, NULL);
    return NULL;
}

/* A child with three outputs open and a thread that writes is ended; then its parent, which has one open itself,
 * finds its own file alone: a child removes what is its own. */
static void a_signal_leaves_nothing(void)
{
    lom_error error = { 0 };
    char busy[400];
    snprintf(busy, sizeof busy, "%s", path_of("busy"));
    lom_writer *own = lom_open_writer(path_of("own"), &error);
    CHECK(own != NULL && lom_append(own, "own", 3, &error), "%s", error.text);
    int before = count_files();
    for (int round = 0; round < 20; round++) {
        int ready[2], status = 0;
        char byte = 0;
        CHECK(pipe(ready) == 0, "no pipe");
        pid_t child = fork();
        if (child == 0) {
            pthread_t thread;
            signal(SIGTERM, end_by_signal);
            for (int i = 0; i < 3; i++)
                lom_append(lom_open_writer(path_of(i == 0 ? "a" : i == 1 ? "b" : "c"), NULL), "x", 1, NULL);
            pthread_create(&thread, NULL, write_on, busy);
            syscall(SYS_write, ready[1], "r", 1);
            for (;;)
                pause();
        }
        CHECK(syscall(SYS_read, ready[0], &byte, 1) == 1, "the child does not begin");
        usleep((useconds_t)(round * 300));
        kill(child, SIGTERM);
        waitpid(child, &status, 0);
        CHECK(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM, "status %x", status);
        close(ready[0]);
        close(ready[1]);
        unlink(busy);
        CHECK(count_files() == before, "round %d: %d files, and %d before", round, count_files(), before);
    }
    CHECK(lom_close_writer(own, &error) && holds(path_of("own"), "own", 3), "%s", error.text);
    unlink(path_of("own"));
}

/* A thousand files with the names that another process with the same number would have taken do not matter. */
static void nothing_left_behind_blocks(void)
{
    lom_error error = { 0 };
    char name[64];
    for (int i = 0; i < 1000; i++) {
        snprintf(name, sizeof name, ".lom-%ld-%d", (long)getpid(), i);
        close(open(path_of(name), O_WRONLY | O_CREAT, 0666));
    }
    CHECK(put(path_of("f"), "x", &error), "%s", error.text);
    for (int i = 0; i < 1000; i++) {
        snprintf(name, sizeof name, ".lom-%ld-%d", (long)getpid(), i);
        unlink(path_of(name));
    }
    unlink(path_of("f"));
    CHECK(count_files() == 0, "%d files", count_files());
}

int main(int argc, char **argv)
{
    if (!make_folder()) {
        printf("FAIL test_writer: no temporary folder\n");
        return 1;
    }
    for (int named = 0; named < 2; named++)
        for (int shorten = 0; shorten < 2; shorten++) {
            inject.named = named == 1;
            inject.shorten = shorten == 1;
            RUN(pieces_appear_at_once);
            RUN(links_stay_links);
            RUN(long_names_and_paths);
            RUN(writers_are_each_whole);
            RUN(special_files_stay);
            RUN(what_cannot_be_replaced_is_written_in_place);
            RUN(modes_and_owners);
            RUN(rights_of_another_user_go);
            RUN(nothing_left_behind_blocks);
        }
    inject.shorten = false;
    RUN(one_output_too_many);
    inject.named = false;
    inject.unnameable = true;
    RUN(pieces_appear_at_once);
    inject.unnameable = false;
    for (int named = 0; named < 2; named++) {
        inject.named = named == 1;
        RUN(a_signal_leaves_nothing);
    }
    RUN(descriptors_are_written_where_they_stand);
    rmdir(folder);
    return check_result();
}
