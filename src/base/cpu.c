/* The machine. In: nothing but the system. Out: which vector extensions may be used and how many threads are worth
 * starting. Invariant: the answers choose speed only; no pixel depends on them. */
#include "cpu.h"

#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

lom_cpu lom_detect_cpu(void)
{
    lom_cpu cpu = { .avx2 = false, .avx512 = false };
#if defined __x86_64__
    /* These include the system's support: the state must be enabled in XCR0 (Intel SDM 1, 13.3). */
    __builtin_cpu_init();
    cpu.avx2 = __builtin_cpu_supports("avx2");
    cpu.avx512 = cpu.avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                 __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                 __builtin_cpu_supports("avx512cd");
#endif
    return cpu;
}

/* The first size - 1 bytes of a small file as text; false when it cannot be read. */
static bool read_text(const char *path, char *text, size_t size)
{
    int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return false;
    size_t used = 0;
    ssize_t got = 1;
    while (used + 1 < size && (got = read(file, text + used, size - 1 - used)) > 0)
        used += (size_t)got;
    close(file);
    text[used] = 0;
    return got >= 0;
}

/* Quota over period in CPUs, rounded up; 0 when there is no quota ("max", -1) or no sense in it. */
static int quota_cpus(const char *quota, const char *period)
{
    long long q = strtoll(quota, NULL, 10), p = strtoll(period, NULL, 10);
    if (q <= 0 || p <= 0)
        return 0;
    long long cpus = q / p + (q % p != 0);
    return cpus < 1 << 20 ? (int)cpus : 0;
}

/* One control group: cpu.max of version 2 ("max 100000", "150000 100000"), cpu.cfs_* of version 1. */
static int group_cpus(const char *folder, bool version2)
{
    char path[4352], quota[64], period[64];
    snprintf(path, sizeof path, "%s/%s", folder, version2 ? "cpu.max" : "cpu.cfs_quota_us");
    if (!read_text(path, quota, sizeof quota))
        return 0;
    if (version2) {
        const char *space = strchr(quota, ' ');
        return space != NULL ? quota_cpus(quota, space + 1) : 0;
    }
    snprintf(path, sizeof path, "%s/cpu.cfs_period_us", folder);
    return read_text(path, period, sizeof period) ? quota_cpus(quota, period) : 0;
}

/* The least quota of a group and of all above it, up to the root of its hierarchy: each level limits those below.
 * Levels that are not visible (a container sees its own subtree as the root) have no files and count as unlimited. */
static int hierarchy_cpus(const char *mount, const char *group, bool version2)
{
    char path[4224];
    int length = snprintf(path, sizeof path, "%s%s", mount, group);
    if (length < 0 || (size_t)length >= sizeof path)
        return 0;
    int least = 0;
    for (size_t end = (size_t)length, top = strlen(mount); end >= top; end--) {
        if (path[end] != '/' && path[end] != 0)
            continue;
        path[end] = 0;
        int cpus = group_cpus(path, version2);
        if (cpus > 0 && (least == 0 || cpus < least))
            least = cpus;
        if (end == 0)
            break;
    }
    return least;
}

/* Whether the comma separated list names the "cpu" controller. */
static bool names_cpu(const char *list, size_t length)
{
    for (size_t start = 0; start < length;) {
        size_t end = start;
        while (end < length && list[end] != ',')
            end++;
        if (end - start == 3 && memcmp(list + start, "cpu", 3) == 0)
            return true;
        start = end + 1;
    }
    return false;
}

/* Lines are "ID:CONTROLLERS:/GROUP"; version 2 is the line with ID 0 and no controllers (cgroups(7)). */
int lom_cgroup_cpus(const char *membership, const char *root)
{
    int least = 0;
    for (const char *line = membership; *line != 0;) {
        size_t length = strcspn(line, "\n");
        const char *list = memchr(line, ':', length);
        const char *group = list != NULL ? memchr(list + 1, ':', length - (size_t)(list + 1 - line)) : NULL;
        if (group != NULL && length < 4096) {
            size_t list_length = (size_t)(group - list - 1);
            bool version2 = list_length == 0;
            char mount[256], name[4096];
            snprintf(mount, sizeof mount, "%s%s", root, version2 ? "" : "/cpu");
            snprintf(name, sizeof name, "%.*s", (int)(length - (size_t)(group + 1 - line)), group + 1);
            int cpus = version2 || names_cpu(list + 1, list_length) ? hierarchy_cpus(mount, name, version2) : 0;
            if (cpus > 0 && (least == 0 || cpus < least))
                least = cpus;
        }
        line += length + (line[length] == '\n');
    }
    return least;
}

/* CPUs the scheduler may run this thread on. The set grows until the kernel's fits in it. */
static int affinity_cpus(void)
{
#if defined __linux__
    for (int capacity = 1024; capacity <= 1 << 20; capacity *= 2) {
        cpu_set_t *set = CPU_ALLOC((size_t)capacity);
        if (set == NULL)
            break;
        size_t size = CPU_ALLOC_SIZE((size_t)capacity);
        int count = sched_getaffinity(0, size, set) == 0 ? CPU_COUNT_S(size, set) : 0;
        CPU_FREE(set);
        if (count > 0)
            return count;
    }
#endif
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 && online < 1 << 20 ? (int)online : 1;
}

int lom_default_threads(void)
{
    int threads = affinity_cpus();
    char membership[16384];
    int quota = read_text("/proc/self/cgroup", membership, sizeof membership)
                    ? lom_cgroup_cpus(membership, "/sys/fs/cgroup")
                    : 0;
    return quota > 0 && quota < threads ? quota : threads;
}
