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
