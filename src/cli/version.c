/* `lom version`. In: nothing. Out: what decides a picture (the versions, the float rules) and what decides only its
 * speed (the CPU). Invariant: the rules are probed in this very build, not quoted. */
#include "version.h"

#include "commands.h"
#include "json.h"
#include "options.h"

#include "lanes/variants.h"

#include <float.h>

struct values {
    bool json;
};

static const lom_option options[] = {
    { .name = "json", .kind = LOM_OPTION_FLAG, .field = offsetof(struct values, json), .help = "one JSON object" },
};

static const lom_command_line line = {
    .name = "version",
    .arguments = "",
    .summary = "Says which lom this is, what compiled it, and what it found in this machine",
    .details =
        "\"picture version\" changes whenever a release deliberately changes pixels: pictures of one scene by two\n"
        "builds with the same picture version are the same bytes.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
};

/* (1 + e)^2 - (1 + 2e) is e^2 exactly; rounding the product first loses it, so that only a fused operation gives it. */
static bool contracts(void)
{
    volatile double e = 0x1p-30;
    double x = 1 + e, y = 1 + 2 * e;
    double difference = x * x - y;
    return difference != 0;
}

static bool keeps_denormals(void)
{
    volatile float smallest = FLT_MIN;
    volatile float half = smallest * 0.5f;
    return half != 0;
}

static bool rounds_to_nearest(void)
{
    volatile double one = 1, tiny = 0x1p-60;
    volatile double up = one + tiny, down = one - tiny;
    return up == one && down == one;
}

static const char *width_support(int width, const lom_cpu *cpu)
{
    if (lom_find_variant(width, false) < 0)
        return "not built";
#if defined __x86_64__
    if (width == 8)
        return cpu->avx2 ? "AVX2" : "lowered";
    if (width == 16)
        return cpu->avx512 ? "AVX-512" : "lowered";
    return "SSE2";
#else
    (void)cpu;
    return width == 4 ? "native" : "lowered";
#endif
}

const char *lom_compiler_name(void)
{
#if defined __clang__
    return __VERSION__;
#else
    return "gcc " __VERSION__;
#endif
}

void lom_print_widths(FILE *out)
{
    lom_cpu cpu = lom_detect_cpu();
    fprintf(out, "4 (%s), 8 (%s), 16 (%s)", width_support(4, &cpu), width_support(8, &cpu), width_support(16, &cpu));
}

static void print_json(void)
{
    lom_cpu cpu = lom_detect_cpu();
    lom_json json = lom_json_begin(stdout);
    lom_json_text(&json, "version", LOM_VERSION);
    lom_json_integer(&json, "picture_version", LOM_PICTURE_VERSION);
    lom_json_text(&json, "compiler", __VERSION__);
    lom_json_text(&json, "lanes_4", width_support(4, &cpu));
    lom_json_text(&json, "lanes_8", width_support(8, &cpu));
    lom_json_text(&json, "lanes_16", width_support(16, &cpu));
    lom_json_integer(&json, "threads", lom_default_threads());
    lom_json_bool(&json, "contraction", contracts());
    lom_json_bool(&json, "denormals", keeps_denormals());
    lom_json_bool(&json, "round_to_nearest", rounds_to_nearest());
    lom_json_integer(&json, "flt_eval_method", __FLT_EVAL_METHOD__);
    lom_json_end(&json);
}

int lom_command_version(int argc, char **argv)
{
    struct values values = { .json = false };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    if (values.json) {
        print_json();
        return LOM_EXIT_DONE;
    }
    printf("lom %s\n", LOM_VERSION);
    printf("  picture version  %d\n", LOM_PICTURE_VERSION);
    printf("  compiler         %s\n", lom_compiler_name());
    printf("  lanes            ");
    lom_print_widths(stdout);
    putchar('\n');
    printf("  threads          %d by default\n", lom_default_threads());
    printf("  floats           contraction %s, denormals %s, %s, FLT_EVAL_METHOD %d\n", contracts() ? "ON" : "off",
           keeps_denormals() ? "kept" : "FLUSHED", rounds_to_nearest() ? "round to nearest" : "ANOTHER ROUNDING",
           __FLT_EVAL_METHOD__);
    return LOM_EXIT_DONE;
}
