/* What `lom trade` and `lom tune` read and begin alike. */
#ifndef LOM_CLI_TRADE_OPTIONS_H
#define LOM_CLI_TRADE_OPTIONS_H

#include "progress.h"
#include "trade_reference.h"

/* What both take. The first member of their own values, so that its rows are theirs. */
struct lom_trade_values {
    struct lom_scene_options scene;
    const char *output, *dials, *reference;
    lom_option_integers frame, samples, pairs;
    bool quiet;
};

/* Rows for an option table; those of the scene are LOM_SCENE_OPTIONS(struct lom_trade_values). */
#define LOM_TRADE_OPTIONS                                                                                              \
    { "dials",                                                                                                         \
      0,                                                                                                               \
      LOM_OPTION_TEXT,                                                                                                 \
      offsetof(struct lom_trade_values, dials),                                                                        \
      "A,B",                                                                                                           \
      0,                                                                                                               \
      0,                                                                                                               \
      "these alone, as docs/dials.md names them; all that act when not given" },                                       \
        { "reference",                                                                                                 \
          0,                                                                                                           \
          LOM_OPTION_TEXT,                                                                                             \
          offsetof(struct lom_trade_values, reference),                                                                \
          "KIND",                                                                                                      \
          0,                                                                                                           \
          0,                                                                                                           \
          "traced (when not given), rendered: every dial at its most exact, or a picture's file" },                    \
        { "samples",                                                                                                   \
          0,                                                                                                           \
          LOM_OPTION_INTEGER,                                                                                          \
          offsetof(struct lom_trade_values, samples),                                                                  \
          "N",                                                                                                         \
          1,                                                                                                           \
          65536,                                                                                                       \
          "rays a pixel of the traced reference, 64 when not given" },                                                 \
    {                                                                                                                  \
        "frame", 0, LOM_OPTION_INTEGER, offsetof(struct lom_trade_values, frame), "N", 0, 1e9,                         \
            "the frame, 0 when not given"                                                                              \
    }

/* A scene whose dials are looked at. */
struct lom_trade {
    const char *path;
    const lom_dial *chosen[LOM_MAX_DIALS];
    size_t count;
    lom_dials all;
    struct lom_trade_reference reference;
    struct lom_progress bar;
};

/* Reads the command line into values, which begin with a lom_trade_values. False: *status is what to end with, and what
 * was wrong has been said; wanted: the sentence for a missing --output. */
bool lom_read_trade(struct lom_trade *trade, const lom_command_line *line, const char *wanted, int argc, char **argv,
                    void *values, int *status);

/* The dials that the options name, and the reference of the scene, whose frame and device they say. folder: for
 * the reference's cache; NULL: none. False with a sentence, and nothing is written. Ended by lom_end_trade_reference in
 * any case. */
bool lom_prepare_trade(struct lom_trade *trade, const struct lom_trade_values *values, bool of_processors,
                       const char *folder, lom_error *error);

/* Begins the bar and makes the reference's picture. The bar is ended by lom_end_progress in any case. */
bool lom_begin_trade(struct lom_trade *trade, const char *label, const struct lom_trade_values *values,
                     lom_error *error);
/* For sweeps and tuners, whose context is the lom_trade: moves the bar. */
bool lom_show_trade(void *trade, double done, const char *doing);

#endif
