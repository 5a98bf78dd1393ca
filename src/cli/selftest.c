/* `lom selftest`. In: nothing. Out: one hash, the same on every machine; status 1 and the part that differs when this
 * build on this machine gives other bytes than were recorded. */
#include "commands.h"
#include "options.h"

#include <lom/measure.h>

struct values {
    bool parts;
};

static const lom_option options[] = {
    { .name = "parts",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, parts),
      .help = "the hash of each part as well" },
};

static const lom_command_line line = {
    .name = "selftest",
    .arguments = "",
    .summary = "Draws built-in content at every lane width and prints one hash, the same on every machine",
    .details = "Exit status 1 when the hash is not the recorded one: the part that differs is named.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
};

int lom_command_selftest(int argc, char **argv)
{
    struct values values = { .parts = false };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    lom_selftest result;
    lom_error error = { .code = LOM_OK };
    if (!lom_run_selftest(&result, &error))
        return lom_complain_error(&error);
    for (int i = 0; values.parts && i < LOM_SELFTEST_PARTS; i++)
        printf("%016llx  %s\n", (unsigned long long)result.part[i].hash, result.part[i].name);
    printf("%016llx  selftest\n", (unsigned long long)result.hash);
    if (result.difference[0] == 0)
        return LOM_EXIT_DONE;
    fprintf(stderr, "lom: selftest: %s\n", result.difference);
    return LOM_EXIT_DIFFERS;
}
