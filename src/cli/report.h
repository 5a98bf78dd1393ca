/* Reports that other programs read: a file that is made in memory and written as a whole, and what JUnit's XML needs. */
#ifndef LOM_CLI_REPORT_H
#define LOM_CLI_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct lom_report {
    const char *path; /* NULL: not asked for */
    FILE *out;        /* it is written here; NULL when it is not asked for */
    char *text;
    size_t size;
};

/* Begins it, if it is asked for; false, having said why. Ended by lom_drop_report. */
bool lom_open_report(struct lom_report *report);
/* Writes the file; false, having said why. */
bool lom_write_report(struct lom_report *report);
void lom_drop_report(struct lom_report *report);

/* What stands around JUnit's test suites. */
void lom_begin_junit(FILE *out);
void lom_end_junit(FILE *out);
/* As content or in an attribute of XML; what XML has no character for becomes U+FFFD. */
void lom_put_escaped(FILE *out, const char *text);

#endif
