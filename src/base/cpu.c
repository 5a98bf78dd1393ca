/* The machine. In: nothing but the system. Out: which vector extensions may be used, how many threads are worth
 * starting, how large the caches are, how much memory there is. Invariant: the answers choose speed, and what is
 * refused; no pixel depends on them. */
#include "cpu.h"

#include "base/system.h"

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
    int file = lom_open_again(AT_FDCWD, path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return false;
    size_t used = 0;
    ssize_t got = 1;
    while (used + 1 < size && got != 0) {
        got = read(file, text + used, size - 1 - used);
        if (got < 0 && !lom_call_again(file, POLLIN))
            break;
        used += got > 0 ? (size_t)got : 0;
    }
    close(file);
    text[used] = 0;
    return got >= 0;
}

bool lom_has_fast_gathers(void)
{
#if defined __x86_64__
    char text[64];
    __builtin_cpu_init();
    return __builtin_cpu_is("intel") && lom_detect_cpu().avx512 &&
           read_text("/sys/devices/system/cpu/vulnerabilities/gather_data_sampling", text, sizeof text) &&
           strcmp(text, "Not affected\n") == 0;
#else
    return false;
#endif
}

/* Quota over period in CPUs, rounded up; 0 when there is no quota ("max", -1) or no sense in it. */
static int64_t quota_cpus(const char *quota, const char *period)
{
    long long q = strtoll(quota, NULL, 10), p = strtoll(period, NULL, 10);
    if (q <= 0 || p <= 0)
        return 0;
    long long cpus = q / p + (q % p != 0);
    return cpus < 1 << 20 ? cpus : 0;
}

/* One control group: cpu.max of version 2 ("max 100000", "150000 100000"), cpu.cfs_* of version 1. */
static int64_t group_cpus(const char *folder, bool version2)
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

/* The same of memory, in bytes: memory.max ("max", "1073741824"), memory.limit_in_bytes, which is near 2^63 for none.
 */
static int64_t group_memory(const char *folder, bool version2)
{
    char path[4352], limit[64];
    snprintf(path, sizeof path, "%s/%s", folder, version2 ? "memory.max" : "memory.limit_in_bytes");
    long long bytes = read_text(path, limit, sizeof limit) ? strtoll(limit, NULL, 10) : 0;
    return bytes > 0 && bytes < INT64_C(1) << 60 ? bytes : 0;
}

/* What a control group limits. */
struct controller {
    const char *name;
    int64_t (*limit)(const char *folder, bool version2); /* of one group; 0: none */
};
static const struct controller cpu_controller = { "cpu", group_cpus }, memory_controller = { "memory", group_memory };

/* The least limit of a group and of all above it, up to the root of its hierarchy: each level limits those below.
 * Levels that are not visible (a container sees its own subtree as the root) have no files and count as unlimited. */
static int64_t hierarchy_limit(const struct controller *controller, const char *mount, const char *group, bool version2)
{
    char path[4224];
    int length = snprintf(path, sizeof path, "%s%s", mount, group);
    if (length < 0 || (size_t)length >= sizeof path)
        return 0;
    int64_t least = 0;
    for (size_t end = (size_t)length, top = strlen(mount); end >= top; end--) {
        if (path[end] != '/' && path[end] != 0)
            continue;
        path[end] = 0;
        int64_t limit = controller->limit(path, version2);
        if (limit > 0 && (least == 0 || limit < least))
            least = limit;
        if (end == 0)
            break;
    }
    return least;
}

/* Whether the comma separated list has the name. */
static bool has_name(const char *list, size_t length, const char *name)
{
    for (size_t start = 0; start < length;) {
        size_t end = start;
        while (end < length && list[end] != ',')
            end++;
        if (end - start == strlen(name) && memcmp(list + start, name, end - start) == 0)
            return true;
        start = end + 1;
    }
    return false;
}

/* Lines are "ID:CONTROLLERS:/GROUP"; version 2 is the line with ID 0 and no controllers (cgroups(7)). */
static int64_t least_limit(const struct controller *controller, const char *membership, const char *root)
{
    int64_t least = 0;
    for (const char *line = membership; *line != 0;) {
        size_t length = strcspn(line, "\n");
        const char *list = memchr(line, ':', length);
        const char *group = list != NULL ? memchr(list + 1, ':', length - (size_t)(list + 1 - line)) : NULL;
        if (group != NULL && length < 4096) {
            size_t list_length = (size_t)(group - list - 1);
            bool version2 = list_length == 0;
            char mount[256], name[4096];
            snprintf(mount, sizeof mount, "%s%s%s", root, version2 ? "" : "/", version2 ? "" : controller->name);
            snprintf(name, sizeof name, "%.*s", (int)(length - (size_t)(group + 1 - line)), group + 1);
            bool holds = version2 || has_name(list + 1, list_length, controller->name);
            int64_t limit = holds ? hierarchy_limit(controller, mount, name, version2) : 0;
            if (limit > 0 && (least == 0 || limit < least))
                least = limit;
        }
        line += length + (line[length] == '\n');
    }
    return least;
}

int lom_cgroup_cpus(const char *membership, const char *root)
{
    return (int)least_limit(&cpu_controller, membership, root); /* below 2^20 */
}

uint64_t lom_cgroup_memory(const char *membership, const char *root)
{
    return (uint64_t)least_limit(&memory_controller, membership, root);
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

uint64_t lom_machine_memory(void)
{
    char membership[16384];
    long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    uint64_t memory = pages > 0 && page > 0 ? (uint64_t)pages * (uint64_t)page : 0;
    uint64_t limit = read_text("/proc/self/cgroup", membership, sizeof membership)
                         ? lom_cgroup_memory(membership, "/sys/fs/cgroup")
                         : 0;
    return limit > 0 && (memory == 0 || limit < memory) ? limit : memory;
}

size_t lom_cache_bytes(void)
{
    long bytes = 0;
#if defined _SC_LEVEL3_CACHE_SIZE && defined _SC_LEVEL2_CACHE_SIZE
    bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
    if (bytes <= 0)
        bytes = sysconf(_SC_LEVEL2_CACHE_SIZE);
#endif
    return bytes > 0 ? (size_t)bytes : 0;
}
