/* The page of `lom steps`. */
#ifndef LOM_CLI_STEPS_PAGE_H
#define LOM_CLI_STEPS_PAGE_H

#include "json.h"

#include <lom/inspect.h>

struct lom_steps_page {
    const char *scene; /* the name of its file */
    int frame;
    const lom_stage_pictures *pictures;
};

/* What is known of a picture that a file holds, as an object of an array. */
void lom_write_step(lom_json *json, const char *file, const lom_stage_picture *picture);
/* HTML that shows NN-name.png of its own folder, and needs no other file; data NULL on failure. */
lom_bytes lom_write_steps_page(const struct lom_steps_page *page, lom_error *error);

#endif
