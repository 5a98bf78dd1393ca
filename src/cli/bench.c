/* `lom bench`. In: names of workloads and what to draw them with; out: a line for each with its time a frame and the
 * hash of its picture. Invariant: the hash depends on the workload and the size alone. */
#include "pipeline/check_device.h"
#include "commands.h"
#include "options.h"

#include "measure/measure.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

typedef struct bench_options {
    lom_option_integers size, frames, warm_up, threads, samples;
    const char *lanes, *filtering, *march, *output;
    bool plain, json, list;
} bench_options;

static const lom_option options[] = {
    { "size", 0, LOM_OPTION_INTEGER, offsetof(bench_options, size), "WxH", 1, 16384,
      "pixels of the picture (1280x720)" },
    { "frames", 0, LOM_OPTION_INTEGER, offsetof(bench_options, frames), "N", 1, 10000, "frames to time (20)" },
    { "warm-up", 0, LOM_OPTION_INTEGER, offsetof(bench_options, warm_up), "N", 0, 10000,
      "frames drawn before (2); the first frame of all is `cold`" },
    { "threads", 0, LOM_OPTION_INTEGER, offsetof(bench_options, threads), "N", 1, 256,
      "worker threads (as many as the machine has for us)" },
    { "lanes", 0, LOM_OPTION_CHOICE, offsetof(bench_options, lanes), "auto|4|8|16", 0, 0,
      "values side by side (the widest the processor has)" },
    { "plain", 0, LOM_OPTION_FLAG, offsetof(bench_options, plain), NULL, 0, 0,
      "lower the lanes to the processor's baseline instructions" },
    { "samples", 0, LOM_OPTION_INTEGER, offsetof(bench_options, samples), "N", 1, LOM_MAX_SAMPLES,
      "samples a pixel (1): 1, 2, 4, 8 or 16" },
    { "filtering", 0, LOM_OPTION_CHOICE, offsetof(bench_options, filtering), "float|fixed", 0, 0,
      "arithmetic in which textures are filtered (fixed)" },
    { "march", 0, LOM_OPTION_CHOICE, offsetof(bench_options, march), "float|fixed", 0, 0,
      "arithmetic of the march through the cloud (fixed)" },
    { "output", 'o', LOM_OPTION_TEXT, offsetof(bench_options, output), "OUT", 0, 0,
      "keep the last frame; with one workload only" },
    { "json", 0, LOM_OPTION_FLAG, offsetof(bench_options, json), NULL, 0, 0, "one JSON object a line" },
    { "list", 0, LOM_OPTION_FLAG, offsetof(bench_options, list), NULL, 0, 0, "say which workloads there are" },
};

static const lom_command_line line = {
    .name = "bench",
    .arguments = "[NAME]...",
    .summary = "Draws workloads again and again and says how long a frame takes",
    .details = "The workloads are those of bench/peers/README.md; without a NAME all of them run. `make bench-peers`\n"
               "compares with other renderers that draw the same, `make bench-fft` with FFTW.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 0,
    .maximum_arguments = -1,
};

/* Three decimals: finer is noise. */
static const char *milliseconds(char text[32], double ms)
{
    lom_print_double(text, lom_double_floor(ms * 1000 + 0.5) / 1000);
    return text;
}

static void report_json(const char *name, const lom_image *picture, const lom_timing *timing, lom_device_desc device)
{
    char median[32], least[32], cold[32], read[32];
    printf("{\"workload\":\"%s\",\"width\":%d,\"height\":%d,\"threads\":%d,\"lanes\":%d,\"frames\":%d,"
           "\"median_ms\":%s,\"min_ms\":%s,\"cold_ms\":%s,\"read_ms\":%s,\"vertices\":%" PRIu64
           ",\"triangles\":%" PRIu64 ",\"triangles_binned\":%" PRIu64 ",\"fragments\":%" PRIu64
           ",\"hash\":\"%016" PRIx64 "\"}\n",
           name, picture->width, picture->height, device.threads, device.lanes, timing->frames,
           milliseconds(median, timing->median_ms), milliseconds(least, timing->min_ms),
           milliseconds(cold, timing->cold_ms), milliseconds(read, timing->read_ms), timing->counters.vertices,
           timing->counters.triangles, timing->counters.triangles_binned, timing->counters.fragments,
           lom_hash_image(picture));
}

static void report(const bench_options *o, const char *name, const lom_image *picture, const lom_timing *timing,
                   const lom_device *device)
{
    lom_device_desc desc = lom_describe_device(device);
    char median[32], least[32], cold[32], read[32];
    if (o->json)
        report_json(name, picture, timing, desc);
    else
        printf("%-10s  %dx%d  %d threads  %2d lanes  %d frames  median %8s ms  min %8s ms  cold %8s ms  "
               "read back %8s ms  %016" PRIx64 "\n",
               name, picture->width, picture->height, desc.threads, desc.lanes, timing->frames,
               milliseconds(median, timing->median_ms), milliseconds(least, timing->min_ms),
               milliseconds(cold, timing->cold_ms), milliseconds(read, timing->read_ms), lom_hash_image(picture));
    fflush(stdout);
}

static lom_filtering filtering_of(const char *word, lom_filtering otherwise)
{
    if (word == NULL)
        return otherwise;
    return strcmp(word, "fixed") == 0 ? LOM_FILTERING_FIXED : LOM_FILTERING_FLOAT;
}

static bool run_one(const bench_options *o, const char *name, lom_device *device, lom_error *error)
{
    int width = o->size.given ? (int)o->size.value[0] : 1280, height = o->size.given ? (int)o->size.value[1] : 720;
    lom_timing timing;
    lom_workload *workload = lom_create_workload(name, width, height, filtering_of(o->filtering, LOM_FILTERING_FIXED),
                                                 filtering_of(o->march, LOM_FILTERING_FIXED), error);
    if (workload != NULL)
        lom_set_workload_samples(workload, (int)lom_given_or(&o->samples, 1));
    bool done = workload != NULL && lom_time_workload(workload, device, (int)lom_given_or(&o->warm_up, 2),
                                                      (int)lom_given_or(&o->frames, 20), &timing, error);
    lom_image *picture = done ? lom_workload_picture(workload, device, error) : NULL;
    done = picture != NULL && (o->output == NULL || lom_write_image(o->output, NULL, picture, error));
    if (done)
        report(o, name, picture, &timing, device);
    lom_free_image(picture);
    lom_free_workload(workload);
    return done;
}

static void list_workloads(void)
{
    for (int i = 0; i < lom_workload_count(); i++)
        printf("%-10s  %s\n", lom_workload_name(i), lom_workload_summary(i));
}

static lom_device *open_device(const bench_options *o, lom_error *error)
{
    static const struct {
        const char *word;
        int lanes;
    } widths[] = { { "4", 4 }, { "8", 8 }, { "16", 16 } };
    lom_device_desc desc = { .threads = (int)lom_given_or(&o->threads, 0), .plain = o->plain };
    for (int i = 0; i < 3; i++)
        if (o->lanes != NULL && strcmp(o->lanes, widths[i].word) == 0)
            desc.lanes = widths[i].lanes;
    lom_device *device = lom_open_device(&desc);
    lom_check_device(device, error);
    return device;
}

int lom_command_bench(int argc, char **argv)
{
    bench_options o = { 0 };
    lom_arguments names;
    int status;
    if (!lom_parse_options(&line, argc, argv, &o, &names, &status))
        return status;
    if (o.list) {
        list_workloads();
        return LOM_EXIT_DONE;
    }
    if (o.output != NULL && names.count != 1)
        return lom_complain("--output keeps the frame of one workload, but %d are named.", names.count);
    lom_error error = { 0 };
    lom_device *device = open_device(&o, &error);
    int count = names.count != 0 ? names.count : lom_workload_count();
    for (int i = 0; i < count && error.code == LOM_OK; i++)
        run_one(&o, names.count != 0 ? names.items[i] : lom_workload_name(i), device, &error);
    lom_close_device(device);
    return error.code == LOM_OK ? LOM_EXIT_DONE : lom_complain_error(&error);
}
