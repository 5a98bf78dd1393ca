/* `lom verify` and `lom approve`: the manifest of a project's golden pictures (verify_manifest.c), drawing them
 * (verify_draw.c), what is kept of them (verify_pictures.c), what became of them (verify_report.c, verify_page.c). */
#ifndef LOM_CLI_VERIFY_H
#define LOM_CLI_VERIFY_H

#include "json.h"
#include "page.h"
#include "report.h"
#include "scene_options.h"

#include <stdio.h>

/* ---- the manifest ---- */

struct lom_manifest {
    const char *path;
    int folder; /* letters of path before the file's name: scenes are named from there */
    lom_bytes file;
    int count;    /* pictures */
    char *pinned; /* the program that drew what is expected, as execvp takes it; NULL where the header names none */
};

/* Where a reader of the manifest is. */
struct lom_manifest_place {
    char *words; /* room for those of one line */
    size_t at;
    int number; /* of the line before it */
    bool begun; /* a line that says something has been read */
};

/* A line. Its texts lie in the reader's `words` until the next one is read. */
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
/* Begins to read at the first line; place->words is freed with lom_release. */
bool lom_begin_goldens(const struct lom_manifest *manifest, struct lom_manifest_place *place, lom_error *error);
/* The next picture; false at the end. */
bool lom_next_golden(const struct lom_manifest *manifest, struct lom_manifest_place *place, struct lom_golden *golden);

/* Sixteen digits 0-9a-f; false where the word is another. */
bool lom_read_golden_hash(const char *word, uint64_t *hash);

/* The manifest as it is to be, up to `copied` of the old one. */
struct lom_approval {
    struct lom_report report;
    size_t copied;
};
/* The hash of a line is another from now on; lines come in their order. */
void lom_approve_golden(struct lom_approval *approval, const struct lom_manifest *manifest,
                        const struct lom_golden *golden, uint64_t hash);
/* Writes the manifest; false, having said why. */
bool lom_write_approval(struct lom_approval *approval, const struct lom_manifest *manifest);

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

/* Pictures of the page. */
enum { LOM_SHOWN_ACTUAL, LOM_SHOWN_EXPECTED, LOM_SHOWN_DIFFERENCE, LOM_SHOWN_COUNT };

struct lom_outcome {
    lom_verified how;
    uint64_t expected, got, again;
    lom_error error;
    char *picture;                    /* the file of what was drawn, NULL when none was written */
    lom_bytes shown[LOM_SHOWN_COUNT]; /* PNG; of UNSTEADY the second picture stands for the expected one */
    char *warnings;                   /* of a scene that was loaded for it; NULL: none */
    size_t warning_count;
};
void lom_drop_outcome(struct lom_outcome *outcome);

/* ---- drawing ---- */

struct lom_verify_values {
    const char *junit, *output, *cache, *page;
    lom_option_integers threads, line;
    bool twice, approve, quiet;
};

/* What one worker has open while it draws: a scene, which its renderers look at. All zero but for what is given. */
struct lom_verifier {
    const struct lom_verify_values *values;
    const struct lom_manifest *manifest;
    int threads; /* of its device */
    lom_scene *scene;
    char *path;                /* of the scene */
    lom_renderer *renderer[2]; /* the second is --twice's */
};

/* Draws the picture of a line and judges it. */
void lom_verify_golden(struct lom_verifier *verifier, const struct lom_golden *golden, struct lom_outcome *outcome);
void lom_drop_verifier(struct lom_verifier *verifier);

/* Writes what --output and --cache ask for, and keeps what the page shows. again: the second picture of --twice, or NULL.
 */
bool lom_keep_pictures(const struct lom_verifier *verifier, const struct lom_golden *golden, const lom_image *image,
                       const lom_image *again, struct lom_outcome *outcome);

/* ---- reports ---- */

/* The word for it: "different". */
const char *lom_verified_name(lom_verified how);
/* One sentence. */
enum { LOM_OUTCOME_LETTERS = 640 };
void lom_describe_outcome(const struct lom_outcome *outcome, char text[LOM_OUTCOME_LETTERS]);
/* One line: where, which picture, what became of it. */
void lom_report_golden(FILE *out, const struct lom_manifest *manifest, const struct lom_golden *golden,
                       const struct lom_outcome *outcome);
/* JUnit's element of it. */
void lom_report_golden_junit(FILE *out, const struct lom_manifest *manifest, const struct lom_golden *golden,
                             const struct lom_outcome *outcome);
/* The beginning of JUnit's suite, and how many pictures came to what. */
void lom_begin_golden_junit(FILE *out, const struct lom_manifest *manifest, const int totals[LOM_VERIFIED_COUNT]);
void lom_report_totals(FILE *out, const int totals[LOM_VERIFIED_COUNT]);

/* The page of --page while it grows: its pictures, and what is said of them. */
struct lom_verify_page {
    const char *path; /* NULL: not asked for */
    struct lom_page pictures, json;
    lom_json list;
};
bool lom_begin_verify_page(struct lom_verify_page *page, const struct lom_manifest *manifest, lom_error *error);
void lom_add_to_verify_page(struct lom_verify_page *page, const struct lom_golden *golden,
                            const struct lom_outcome *outcome);
bool lom_write_verify_page(struct lom_verify_page *page, const int totals[LOM_VERIFIED_COUNT], lom_error *error);
void lom_drop_verify_page(struct lom_verify_page *page);

#endif
