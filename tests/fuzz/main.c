/* Runs a fuzz target on files or folders given as arguments, for compilers without libFuzzer: every input once. */
#include <lom/base.h>

#include <dirent.h>
#include <stdio.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static int run_file(const char *path)
{
    lom_error error = { 0 };
    lom_bytes file = lom_read_file(path, 1 << 28, &error);
    if (file.data == NULL) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    uint8_t *exact = lom_allocate(file.size, 1, NULL);
    for (size_t i = 0; i < file.size; i++)
        exact[i] = file.data[i];
    LLVMFuzzerTestOneInput(exact, file.size);
    lom_release(exact);
    lom_release(file.data);
    return 0;
}

static int run_path(const char *path, int *count)
{
    struct stat status;
    if (stat(path, &status) != 0 || !S_ISDIR(status.st_mode)) {
        ++*count;
        return run_file(path);
    }
    DIR *folder = opendir(path);
    int failed = folder == NULL;
    for (struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;) {
        char name[4096];
        if (entry->d_name[0] == '.')
            continue;
        snprintf(name, sizeof name, "%s/%s", path, entry->d_name);
        failed |= run_path(name, count);
    }
    if (folder != NULL)
        closedir(folder);
    return failed;
}

int main(int argc, char **argv)
{
    int failed = 0, count = 0;
    for (int i = 1; i < argc; i++)
        failed |= run_path(argv[i], &count);
    printf("%d inputs\n", count);
    return failed;
}
