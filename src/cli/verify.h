/* `lom verify`: the manifest of a project's golden pictures (verify_manifest.c) and what became of them (verify_report.c). */
#ifndef LOM_CLI_VERIFY_H
#define LOM_CLI_VERIFY_H

#include "scene_options.h"

#include <stdio.h>

/* ---- the manifest ---- */

struct lom_manifest {
    const char *path;
    int folder; /* letters of path before the file's name: scenes are named from there */
    lom_bytes file;
    char *words; /* room for those of one line */
    int count;   /* pictures */
};

/* Where a reader of the manifest is; all zero at its beginning. */
struct lom_manifest_place {
    size_t at;
    int number;  /* of the line before it */
    bool begun;  /* a line that says something has been read */
    int picture; /* the version that the header names, 0 where there is none */
};

/* A line. Its texts lie in the manifest until the next one is read. */
struct lom_golden {
    int number;
    size_t hash_at, hash_size; /* where the hash, or "-", stands in the file */
    bool is_approved, may_be_flat;
    uint64_t expected;
    const char *scene; /* as the line says it */
    const char *text;  /* the line from the scene on, without what lies behind its last word */
    struct lom_scene_options options;
    lom_option_integers frame;
};

/* Reads the manifest and checks every line of it; false with file:line:column and a sentence. Ended by
 * lom_close_manifest, also after a failure. */
bool lom_open_manifest(const char *path, struct lom_manifest *manifest, lom_error *error);
void lom_close_manifest(struct lom_manifest *manifest);
/* The next picture; false at the end, and (with the error) where a line is wrong. */
bool lom_next_golden(const struct lom_manifest *manifest, struct lom_manifest_place *place, struct lom_golden *golden,
                     lom_error *error);

/* ---- what became of a picture ---- */

typedef enum lom_verified {
    LOM_VERIFIED_OK,
    LOM_VERIFIED_APPROVED, /* its hash is written into the manifest */
    LOM_VERIFIED_NEW,      /* nobody has approved it */
    LOM_VERIFIED_DIFFERS,
    LOM_VERIFIED_FLAT,     /* one single colour, which the line does not allow */
    LOM_VERIFIED_UNSTEADY, /* drawn twice it differs */
    LOM_VERIFIED_ERROR,
    LOM_VERIFIED_COUNT
} lom_verified;

struct lom_outcome {
    lom_verified how;
    uint64_t expected, got, again;
    lom_error error;
    char *picture; /* the file of what was drawn, NULL when none was written */
};

/* One line: where, which picture, what became of it. */
void lom_report_golden(FILE *out, const struct lom_manifest *manifest, const struct lom_golden *golden,
                       const struct lom_outcome *outcome);
/* JUnit's element of it. */
void lom_report_golden_junit(FILE *out, const struct lom_manifest *manifest, const struct lom_golden *golden,
                             const struct lom_outcome *outcome);
/* The beginning of JUnit's suite, and how many pictures came to what. */
void lom_begin_golden_junit(FILE *out, const struct lom_manifest *manifest, const int totals[LOM_VERIFIED_COUNT]);
void lom_report_totals(FILE *out, const int totals[LOM_VERIFIED_COUNT]);

#endif
