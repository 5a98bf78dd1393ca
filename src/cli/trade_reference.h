/* The reference of `lom trade` and `lom tune`, and the scene as it has to be drawn to be compared with it. */
#ifndef LOM_CLI_TRADE_REFERENCE_H
#define LOM_CLI_TRADE_REFERENCE_H

#include "scene_options.h"

#include "measure/trial.h"

struct lom_trade_reference {
    lom_subject
        subject; /* what is compared with it: without what the tracer does not have, where that is the reference */
    lom_subject whole;  /* the scene as it is */
    lom_subject drawn;  /* what draws it; path NULL: a file */
    const char *name;   /* "the tracer", "the finest settings", or the file */
    int samples;        /* of the tracer; 0: it is none */
    char *cache;        /* its file; NULL: none */
    size_t folder;      /* letters of it that name the folder */
    lom_image *picture; /* RGB8; NULL until it is found */
    char **texts;       /* the overrides of all three */
    size_t text_count, text_capacity;
    const char **changes[3];
};

/* What both commands take beside a scene's options. */
struct lom_trade_options {
    const char *dials, *reference;
    lom_option_integers frame, samples, pairs;
};

/* Rows for an option table whose values struct has a `struct lom_trade_options common`. */
#define LOM_TRADE_OPTIONS(values)                                                                                      \
    { "dials",                                                                                                         \
      0,                                                                                                               \
      LOM_OPTION_TEXT,                                                                                                 \
      offsetof(values, common.dials),                                                                                  \
      "A,B",                                                                                                           \
      0,                                                                                                               \
      0,                                                                                                               \
      "these alone, as docs/dials.md names them; all that act when not given" },                                       \
        { "reference",                                                                                                 \
          0,                                                                                                           \
          LOM_OPTION_TEXT,                                                                                             \
          offsetof(values, common.reference),                                                                          \
          "KIND",                                                                                                      \
          0,                                                                                                           \
          0,                                                                                                           \
          "traced (when not given), rendered: every dial at its most exact, or a picture's file" },                    \
        { "samples",                                                                                                   \
          0,                                                                                                           \
          LOM_OPTION_INTEGER,                                                                                          \
          offsetof(values, common.samples),                                                                            \
          "N",                                                                                                         \
          1,                                                                                                           \
          65536,                                                                                                       \
          "rays a pixel of the traced reference, 64 when not given" },                                                 \
    {                                                                                                                  \
        "frame", 0, LOM_OPTION_INTEGER, offsetof(values, common.frame), "N", 0, 1e9, "the frame, 0 when not given"     \
    }

struct lom_chosen_dials {
    lom_dials all;
    const lom_dial *chosen[LOM_MAX_DIALS];
    size_t count;
};

/* The dials that the options name, and the reference of the subject, whose frame and device they say: what
 * lom_prepare_trade_reference does. */
bool lom_prepare_trade(struct lom_trade_reference *reference, struct lom_chosen_dials *dials,
                       const struct lom_trade_options *options, const struct lom_scene_options *scene,
                       lom_subject subject, const char *folder, lom_error *error);

/* Finds out what the reference is, and checks the scene. kind: "traced", "rendered", a file, NULL: traced. folder:
 * for the cache; NULL: none. False with a sentence, and nothing is written. Ended by lom_end_trade_reference in any
 * case. */
bool lom_prepare_trade_reference(struct lom_trade_reference *reference, const char *kind, const char *folder,
                                 const struct lom_scene_options *options, const lom_subject *subject, int samples,
                                 lom_error *error);
/* Makes `picture`: reads it, or draws it and keeps it in the folder, under a name that tells the scene, its files, the
 * settings and the version of the pictures. */
bool lom_find_trade_reference(struct lom_trade_reference *reference, lom_error *error);
void lom_end_trade_reference(struct lom_trade_reference *reference);

#endif
