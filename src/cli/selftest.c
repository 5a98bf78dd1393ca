/* `lom selftest`. In: nothing. Out: one hash, the same on every machine; status 1 and the part that differs when this
 * build on this machine gives other bytes than were recorded. */
#include "commands.h"
#include "options.h"

#include "measure/measure.h"

struct values {
    bool parts;
    const char *output;
};

static const lom_option options[] = {
    { .name = "parts",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, parts),
      .help = "the hash of each part as well" },
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
    .details = "Exit status 1 when the hash is not the recorded one: the part that differs is named.",
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
    printf("%016llx  selftest\n", (unsigned long long)result.hash);
    if (result.difference[0] == 0)
        return LOM_EXIT_DONE;
    fprintf(stderr, "lom: selftest: %s\n", result.difference);
    return LOM_EXIT_DIFFERS;
}
