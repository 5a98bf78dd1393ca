/* Tuning: the cheapest settings of a scene's dials within an error, or the most exact ones within a cost. */
#ifndef LOM_MEASURE_TUNER_H
#define LOM_MEASURE_TUNER_H

#include "measure/trial.h"

typedef enum lom_goal {
    LOM_GOAL_FLIP,  /* the cheapest whose mean FLIP is at most `limit` */
    LOM_GOAL_PSNR,  /* the cheapest whose PSNR is at least `limit` decibels */
    LOM_GOAL_BUDGET /* the most exact (by FLIP) whose cost is at most `limit` */
} lom_goal;

/* A way to draw the scene, and what is known of it. */
typedef struct lom_tuned {
    lom_choices choices; /* of dials that act, where they differ from the scene */
    lom_picture_error error;
    double cost; /* declared work; milliseconds with by_clock */
} lom_tuned;

typedef struct lom_tuner_desc {
    lom_subject subject;
    const lom_image *reference;
    const lom_dial *const *dials;
    size_t dial_count;
    lom_goal goal;
    double limit;
    bool by_clock; /* the cost is time, by the subject's clock: another answer each time */
    int pairs;     /* of frames, then */
    bool (*progress)(void *context, double done, const char *doing); /* may be NULL */
    void *context;
} lom_tuner_desc;

typedef struct lom_tuning {
    lom_tuned standard, best; /* the scene as it is; what was found */
    bool met;                 /* best keeps the limit; else nothing was found that does, and it comes nearest */
    int tried;                /* ways that were drawn */
} lom_tuning;

/* From the scene as it is, or, where that does not keep the limit, from each dial's most exact (or cheapest)
 * setting, dial by dial: the best of its settings is taken, until a whole round changes nothing. So it is a way that
 * no change of a single dial improves. Without by_clock the answer is the same on every machine. False when it could
 * not be done. */
bool lom_tune(const lom_tuner_desc *desc, lom_tuning *tuning, lom_error *error);

#endif
