/* What a frame took. In: a frame that was drawn. Out: a JSON line of its passes, work and time. Invariant: a line is
 * written whole or not at all. */
#include "frame_stats.h"

#include "json.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Each stage's milliseconds, then of all of them those in which at most one worker ran. */
static void print_times(lom_json *json, const lom_frame *frame)
{
    const lom_stage_time *stage = frame->stage;
    double alone = 0;
    char name[48];
    for (int i = 0; i < LOM_MAX_STAGES && stage[i].name != NULL; i++) {
        snprintf(name, sizeof name, "ms_%s", stage[i].name);
        lom_json_number(json, name, stage[i].milliseconds);
    }
    for (int i = 0; i < LOM_MAX_STAGES && stage[i].name != NULL; i++) {
        snprintf(name, sizeof name, "alone_%s", stage[i].name);
        lom_json_number(json, name, stage[i].alone);
        alone += stage[i].alone;
    }
    lom_json_number(json, "ms_alone", alone);
}

static void print_stats(FILE *out, const lom_renderer *renderer, const lom_frame *frame, int number, double elapsed)
{
    const lom_counters *c = &frame->counters;
    lom_device_desc device = lom_describe_device(lom_renderer_device(renderer));
    const struct {
        const char *name;
        uint64_t value;
    } facts[] = { { "threads", (uint64_t)device.threads },
                  { "lanes", (uint64_t)device.lanes },
                  { "passes", c->passes },
                  { "draws", c->draws },
                  { "vertices", c->vertices },
                  { "triangles", c->triangles },
                  { "triangles_clipped", c->triangles_clipped },
                  { "triangles_binned", c->triangles_binned },
                  { "fragments", c->fragments },
                  { "packets", c->packets },
                  { "tiles", c->tiles },
                  { "transforms", c->transforms },
                  { "impostors_shown", (uint64_t)frame->impostors.plates },
                  { "impostors_refreshed", (uint64_t)frame->impostors.refreshed },
                  { "impostors_reused", (uint64_t)frame->impostors.reused },
                  { "impostors_split", (uint64_t)frame->impostors.split },
                  { "impostors_skipped", (uint64_t)frame->impostors.skipped },
                  { "clouds_culled", (uint64_t)frame->impostors.culled },
                  { "shallow_steps", frame->shallow_steps },
                  { "fluid_steps", frame->fluid_steps },
                  { "drops_moved", frame->spray.moved },
                  { "drops_drawn", frame->spray.drawn } };
    char ran[LOM_MAX_STEPS * 25] = "";
    size_t length = 0;
    lom_json json = lom_json_begin(out);
    lom_json_integer(&json, "frame", number);
    lom_json_number(&json, "ms", elapsed * 1e3);
    for (size_t i = 0; i < sizeof facts / sizeof facts[0]; i++)
        lom_json_integer(&json, facts[i].name, (int64_t)facts[i].value);
    for (int i = 0; i < frame->plan.count; i++)
        if (frame->plan.step[i].runs)
            length += (size_t)snprintf(ran + length, sizeof ran - length, "%s%s", length > 0 ? " " : "",
                                       frame->plan.step[i].name);
    print_times(&json, frame);
    lom_json_text(&json, "ran", ran);
    lom_json_end(&json);
}

bool lom_append_stats(lom_writer *writer, const lom_renderer *renderer, const lom_frame *frame, int number,
                      double elapsed, lom_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    bool done = memory != NULL;
    if (done)
        print_stats(memory, renderer, frame, number, elapsed);
    if (!done || ferror(memory) + fclose(memory) != 0)
        done = lom_fail(error, LOM_ERROR_MEMORY, "The statistics of frame %d: %s.", number, strerror(ENOMEM));
    done = done && lom_append(writer, text, size, error);
    free(text);
    return done;
}
