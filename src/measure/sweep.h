/* Sweeps of dials: a scene drawn at each setting of each dial, and at combinations of the best few, measured against
 * its reference (docs/trade.md). What is found is printed by sweep_table.c, sweep_plot.c and sweep_page.c. */
#ifndef LOM_MEASURE_SWEEP_H
#define LOM_MEASURE_SWEEP_H

#include "measure/trial.h"

enum { LOM_LONGEST_TRIAL = 400 };

typedef struct lom_trial {
    lom_choices choices;
    const char
        *reference;     /* what it is measured against: reference_name; a dial's name: its finest setting; "default" */
    bool is_default;    /* the scene as it is */
    bool is_equal;      /* of a dial that changes no byte: measured against the default */
    bool is_mixed;      /* a combination */
    bool differs;       /* is_equal, and the picture is another: a bug */
    bool on_front;      /* no other of its reference is as cheap and as exact */
    bool beats_default; /* cheaper beyond the spread of its pairs, and not less exact */
    char failed[200];   /* why it was not drawn; empty: it was */
    lom_image *picture;
    lom_picture_error error;
    lom_pair_time time; /* against the default */
} lom_trial;

typedef bool lom_sweep_progress(void *context, double done, const char *doing);

typedef struct lom_sweep_desc {
    lom_subject subject;        /* with the changes that make it comparable with the reference */
    lom_subject whole;          /* as the scene is: for dials whose reference is their own finest setting */
    const lom_image *reference; /* RGB8, of the subject's frame */
    const char *reference_name; /* "tracer" */
    const lom_dial *const *dials;
    size_t dial_count;
    int pairs;
    int combined;                 /* dials that are combined at most: 0 none, 2 .. 4 */
    lom_sweep_progress *progress; /* may be NULL */
    void *context;
} lom_sweep_desc;

typedef struct lom_sweep {
    size_t count, capacity;
    lom_trial *trial; /* the default first; then dial by dial; then combinations */
    const lom_image *reference;
} lom_sweep;

/* False when it could not be done; what a setting makes impossible is told in its trial. Freed with lom_free_sweep,
 * also after a failure. */
bool lom_run_sweep(const lom_sweep_desc *desc, lom_sweep *sweep, lom_error *error);
void lom_free_sweep(lom_sweep *sweep);

/* "cloud_error=0.1 cloud_stop=0.03", or "default". */
const char *lom_print_trial(char text[LOM_LONGEST_TRIAL], const lom_trial *trial);
/* How many dials of speed changed the picture; the first of them. */
size_t lom_count_unequal(const lom_sweep *sweep, const lom_trial **first);
/* Milliseconds of a trial: its ratio times the default's, so that all are of one machine in one mood. */
double lom_trial_ms(const lom_sweep *sweep, const lom_trial *trial);

/* What heads each output. */
typedef struct lom_sweep_head {
    const char *scene, *command, *clock; /* "clock time" */
    int width, height, frame, threads, lanes;
} lom_sweep_head;

void lom_print_sweep_csv(FILE *out, const lom_sweep *sweep);
void lom_print_sweep_table(FILE *out, const lom_sweep *sweep, const lom_sweep_head *head);
void lom_print_sweep_plot(FILE *out, const lom_sweep *sweep, const lom_sweep_head *head);
/* One file with all pictures; false when memory runs out. */
bool lom_print_sweep_page(FILE *out, const lom_sweep *sweep, const lom_sweep_head *head, lom_error *error);

#endif
