/* `lom selftest`. In: nothing. Out: one hash, the same on every machine; status 1 and the part that differs when this
 * build on this machine gives other bytes than were recorded. */
#include "commands.h"
#include "options.h"
#include "version.h"

#include "measure/measure.h"

#include <string.h>
#include <sys/utsname.h>

struct values {
    bool parts, badge;
    const char *output;
};

static const lom_option options[] = {
    { .name = "parts",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, parts),
      .help = "the hash of each part as well" },
    { .name = "badge",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, badge),
      .help = "one line for a report instead: hash, versions, machine, how many builds agree" },
    { .name = "output",
      .letter = 'o',
      .kind = LOM_OPTION_TEXT,
      .field = offsetof(struct values, output),
      .value = "OUT",
      .help = "keep the pictures that the parts draw, side by side" },
};

static const lom_command_line line = {
    .name = "selftest",
    .arguments = "",
    .summary = "Draws built-in content at every lane width and prints one hash, the same on every machine",
    .details =
        "Below the hash stand the builds of the matrix (bench/results/matrix.md) that have been seen to print it.\n"
        "Exit status 1 when the hash is not the recorded one: the part that differs is named.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
};

static bool write_pictures(const char *path, lom_error *error)
{
    lom_image *sheet = lom_draw_selftest(error);
    bool written = sheet != NULL && lom_write_image(path, NULL, sheet, error);
    lom_free_image(sheet);
    return written;
}

/* The rows of the matrix that gave this hash. */
static int count_rows(uint64_t hash)
{
    int count = 0;
    while (hash == lom_selftest_seen && lom_selftest_rows[count] != NULL)
        count++;
    return count;
}

/* Words on lines of 96 letters. */
static void tell_rows(uint64_t hash)
{
    enum { WIDTH = 96, INDENT = 4 };
    int count = count_rows(hash), at = WIDTH;
    if (count == 0)
        printf("on no build of the matrix yet\n");
    else
        printf("on %d builds of the matrix:", count);
    for (int i = 0; i < count; i++) {
        int length = (int)strlen(lom_selftest_rows[i]) + 1;
        if (at + length > WIDTH)
            at = printf("\n%*s", INDENT - 1, "") - 1;
        at += length;
        printf(" %s", lom_selftest_rows[i]);
    }
    if (count > 0)
        putchar('\n');
}

/* One line to paste. */
static void print_badge(const lom_selftest *result)
{
    struct utsname machine = { .sysname = "?", .machine = "?" };
    uname(&machine);
    printf("lom %s picture %d, selftest %016llx (%s; seen on %d builds), %s %s, lanes ", LOM_VERSION,
           LOM_PICTURE_VERSION, (unsigned long long)result->hash,
           result->difference[0] == 0 ? "as recorded" : "NOT as recorded", count_rows(result->hash), machine.sysname,
           machine.machine);
    lom_print_widths(stdout);
    printf(", %s\n", lom_compiler_name());
}

int lom_command_selftest(int argc, char **argv)
{
    struct values values = { .parts = false };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    lom_selftest result;
    lom_error error = { .code = LOM_OK };
    if (!lom_run_selftest(&result, &error) || (values.output != NULL && !write_pictures(values.output, &error)))
        return lom_complain_error(&error);
    for (int i = 0; values.parts && i < LOM_SELFTEST_PARTS; i++)
        printf("%016llx  %s\n", (unsigned long long)result.part[i].hash, result.part[i].name);
    if (values.badge) {
        print_badge(&result);
    } else {
        printf("%016llx  selftest\n", (unsigned long long)result.hash);
        tell_rows(result.hash);
    }
    if (result.difference[0] == 0)
        return LOM_EXIT_DONE;
    fprintf(stderr, "lom: selftest: %s\n", result.difference);
    return LOM_EXIT_DIFFERS;
}
