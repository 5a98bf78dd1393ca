/* What `lom trade` and `lom tune` read and begin alike. In: a command line. Out: a scene, its dials and its reference.
 * Invariant: bad input is found before anything is drawn or written. */
#include "trade_options.h"

#include <string.h>

bool lom_read_trade(struct lom_trade *trade, const lom_command_line *line, const char *wanted, int argc, char **argv,
                    void *values, int *status)
{
    const struct lom_trade_values *v = values;
    lom_arguments arguments;
    if (!lom_parse_options(line, argc, argv, values, &arguments, status))
        return false;
    *trade = (struct lom_trade){ .path = arguments.items[0] };
    if (v->output == NULL || v->output[0] == '\0')
        *status = lom_complain("%s takes %s", line->name, wanted);
    else if (strcmp(trade->path, "-") == 0)
        *status = lom_complain("%s reads the scene again for each setting, and no standard input.", line->name);
    else
        return true;
    return false;
}

bool lom_prepare_trade(struct lom_trade *trade, const struct lom_trade_values *v, bool of_processors,
                       const char *folder, lom_error *error)
{
    const lom_subject subject = { .path = trade->path,
                                  .frame = lom_small_frame_of_options(&v->scene, (int)lom_given_or(&v->frame, 0)),
                                  .device = lom_device_of_options(&v->scene),
                                  .of_processors = of_processors };
    lom_list_dials(&trade->all);
    return lom_choose_dials(&trade->all, v->dials, trade->chosen, &trade->count, error) &&
           lom_prepare_trade_reference(&trade->reference, v->reference, folder, &v->scene, &subject,
                                       (int)lom_given_or(&v->samples, 64), error);
}

bool lom_show_trade(void *trade, double done, const char *doing)
{
    lom_show_progress(&((struct lom_trade *)trade)->bar, 100 * done, doing);
    return true;
}

bool lom_begin_trade(struct lom_trade *trade, const char *label, const struct lom_trade_values *v, lom_error *error)
{
    trade->bar = lom_begin_progress(label, 100, v->quiet);
    lom_show_trade(trade, 0, "reference");
    return lom_find_trade_reference(&trade->reference, error);
}
