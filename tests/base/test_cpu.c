/* Proves what is read from control groups: both versions, the least of all levels, of CPUs and of memory, fractions,
 * "max", and nonsense; that the machine this runs on gets an answer, and so does one that tells less. */
#include "check.h"

#include "base/cpu.h"

#include <limits.h>
#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

/* A hierarchy laid out in a temporary folder. */
static char root[64];

static void put(const char *path, const char *text)
{
    char full[512];
    snprintf(full, sizeof full, "%s/%s", root, path);
    for (char *slash = strchr(full + strlen(root) + 1, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        mkdir(full, 0700);
        *slash = '/';
    }
    FILE *file = fopen(full, "wb");
    CHECK(file != NULL, "%s", full);
    if (file != NULL) {
        fputs(text, file);
        fclose(file);
    }
}

static void make_root(void)
{
    snprintf(root, sizeof root, "/tmp/lom_cpu_XXXXXX");
    CHECK(mkdtemp(root) != NULL);
}

static void remove_root(void)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", root);
    CHECK(system(command) == 0);
}

static void version_2(void)
{
    make_root();
    put("cpu.max", "max 100000\n");
    put("a/cpu.max", "250000 100000\n");
    put("a/b/cpu.max", "800000 100000\n");
    put("half/cpu.max", "50000 100000\n");
    put("broken/cpu.max", "many\n");
    put("zero/cpu.max", "0 0\n");
    static const struct {
        const char *membership;
        int cpus;
    } cases[] = {
        { "0::/\n", 0 },        { "0::/a\n", 3 },
        { "0::/a/b\n", 3 },     { "0::/a/b/unseen/deep\n", 3 },
        { "0::/half\n", 1 },    { "0::/half", 1 },
        { "0::/broken\n", 0 },  { "0::/zero\n", 0 },
        { "0::/nowhere\n", 0 }, { "", 0 },
        { "\n\n", 0 },          { "nonsense\n0::/a\n", 3 },
        { ":::::\n", 0 },       { "12:cpuset:/a\n", 0 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        CHECK(lom_cgroup_cpus(cases[i].membership, root) == cases[i].cpus, "\"%s\": %d", cases[i].membership,
              lom_cgroup_cpus(cases[i].membership, root));
    remove_root();
}

static void version_1(void)
{
    make_root();
    put("cpu/cpu.cfs_quota_us", "-1\n");
    put("cpu/cpu.cfs_period_us", "100000\n");
    put("cpu/box/cpu.cfs_quota_us", "150000\n");
    put("cpu/box/cpu.cfs_period_us", "50000\n");
    put("cpuset.max", "100000 100000\n");
    CHECK(lom_cgroup_cpus("4:cpu,cpuacct:/\n", root) == 0);
    CHECK(lom_cgroup_cpus("4:cpu,cpuacct:/box\n", root) == 3);
    CHECK(lom_cgroup_cpus("4:cpuacct,cpu:/box/inner\n3:memory:/box\n", root) == 3);
    CHECK(lom_cgroup_cpus("4:cpuset:/box\n3:memory:/box\n", root) == 0);
    put("both/cpu.max", "200000 100000\n");
    CHECK(lom_cgroup_cpus("4:cpu:/box\n0::/both\n", root) == 2, "the least of both versions");
    remove_root();
}

static void memory(void)
{
    make_root();
    put("memory.max", "max\n");
    put("a/memory.max", "1073741824\n");
    put("a/b/memory.max", "max\n");
    put("a/c/memory.max", "1000\n");
    put("memory/memory.limit_in_bytes", "9223372036854771712\n");
    put("memory/box/memory.limit_in_bytes", "4096\n");
    static const struct {
        const char *membership;
        uint64_t bytes;
    } cases[] = {
        { "0::/\n", 0 },        { "0::/a/b\n", 1073741824 },        { "0::/a/c\n", 1000 },
        { "4:memory:/\n", 0 },  { "4:memory:/box/inner\n", 4096 },  { "4:cpu:/box\n", 0 },
        { "0::/nowhere\n", 0 }, { "4:memory:/box\n0::/a\n", 4096 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        CHECK(lom_cgroup_memory(cases[i].membership, root) == cases[i].bytes, "\"%s\": %llu", cases[i].membership,
              (unsigned long long)lom_cgroup_memory(cases[i].membership, root));
    remove_root();
}

static void this_machine(void)
{
    CHECK(lom_machine_memory() > 1 << 24, "%llu", (unsigned long long)lom_machine_memory());
    int threads = lom_default_threads();
    CHECK(threads >= 1 && threads <= 1 << 20, "%d", threads);
    lom_cpu cpu = lom_detect_cpu();
    CHECK(!cpu.avx512 || cpu.avx2);
    CHECK(!lom_has_fast_gathers() || cpu.avx512);
}

/* ---- another system: what it answers ---- */

static struct {
    bool other;
    long online, level2, level3;
} answer;

long __real_sysconf(int name);
long __wrap_sysconf(int name);
int __real_sched_getaffinity(pid_t process, size_t size, cpu_set_t *set);
int __wrap_sched_getaffinity(pid_t process, size_t size, cpu_set_t *set);

/* Called by a sanitizer of memory before it has begun. */
#ifdef __clang__
__attribute__((no_sanitize("memory")))
#endif
long __wrap_sysconf(int name)
{
    if (!answer.other)
        return __real_sysconf(name);
    return name == _SC_NPROCESSORS_ONLN    ? answer.online
           : name == _SC_LEVEL2_CACHE_SIZE ? answer.level2
           : name == _SC_LEVEL3_CACHE_SIZE ? answer.level3
                                           : -1;
}

int __wrap_sched_getaffinity(pid_t process, size_t size, cpu_set_t *set)
{
    return answer.other ? -1 : __real_sched_getaffinity(process, size, set);
}

/* Where the scheduler does not say which CPUs it gives, all that are online count, and one where nothing does. (A
 * control group of this machine can make them fewer.) */
static void what_the_system_does_not_tell(void)
{
    static const struct {
        long online, level2, level3;
        int threads;
        size_t cache;
    } cases[] = { { 1, 512, 4096, 1, 4096 }, { 6, 512, 0, 6, 512 },      { -1, 512, -1, 1, 512 },
                  { 0, 0, 0, 1, 0 },         { 1L << 30, -1, -1, 1, 0 }, { 3, -1, 7, 3, 7 } };
    int quota = lom_default_threads();
    answer.other = true;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        answer.online = cases[i].online;
        answer.level2 = cases[i].level2;
        answer.level3 = cases[i].level3;
        int threads = lom_default_threads();
        CHECK(threads == cases[i].threads || (threads < cases[i].threads && threads <= quota), "case %zu: %d threads",
              i, threads);
        CHECK(lom_cache_bytes() == cases[i].cache, "case %zu: %zu bytes", i, lom_cache_bytes());
    }
    answer.other = false;
}

static void nearest_names(void)
{
    static const char *const names[] = { "water", "cloud", "camera", "sky", "min-psnr", "max-flip" };
    static const struct {
        const char *word, *nearest;
    } cases[] = {
        { "watre", "water" },
        { "wate", "water" },
        { "waters", "water" },
        { "clod", "cloud" },
        { "skz", "sky" },
        { "max-flop", "max-flip" },
        { "minpsnr", "min-psnr" },
        { "zzzzz", NULL },
        { "", NULL },
        { "x", NULL },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *nearest = lom_nearest_name(cases[i].word, strlen(cases[i].word), names, 6);
        CHECK(nearest == cases[i].nearest ||
                  (nearest != NULL && cases[i].nearest != NULL && strcmp(nearest, cases[i].nearest) == 0),
              "%s: %s", cases[i].word, nearest != NULL ? nearest : "none");
    }
    char long_word[4000];
    memset(long_word, 'w', sizeof long_word);
    CHECK(lom_nearest_name(long_word, sizeof long_word, names, 6) == NULL);
}

int main(int argc, char **argv)
{
    RUN(version_2);
    RUN(version_1);
    RUN(memory);
    RUN(this_machine);
    RUN(what_the_system_does_not_tell);
    RUN(nearest_names);
    return check_result();
}
