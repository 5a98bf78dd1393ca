/* What pages that need no other file are put together from. */
#ifndef LOM_CLI_PAGE_H
#define LOM_CLI_PAGE_H

#include <lom/base.h>

#include <stdio.h>

/* A stream into memory. */
struct lom_page {
    FILE *out; /* NULL: no memory */
    char *text;
    size_t size;
};

void lom_begin_page(struct lom_page *page);
/* What was written; data NULL on failure. */
lom_bytes lom_end_page(struct lom_page *page, lom_error *error);
/* Gives it up, whether it was begun or not. */
void lom_drop_page(struct lom_page *page);

void lom_print_lines(FILE *out, const char *const *lines, size_t count);
/* JSON whose strings hold no "<": it cannot end its element. */
void lom_print_embedded(FILE *out, lom_bytes json);

#endif
