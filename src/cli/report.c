/* Reports for machines. In: what a command found out. Out: a file of it. Invariant: a report's file holds what it held
 * before or the whole report; JUnit's XML is well formed whatever a text says. */
#include "report.h"

#include "options.h"

#include "base/utf8.h"

#include <stdlib.h>

bool lom_open_report(struct lom_report *report)
{
    report->out = report->path != NULL ? open_memstream(&report->text, &report->size) : NULL;
    return report->path == NULL || report->out != NULL || lom_complain("no memory is left.") == LOM_EXIT_DONE;
}

bool lom_write_report(struct lom_report *report)
{
    lom_error error = { .code = LOM_OK };
    if (report->out == NULL)
        return true;
    bool done = fclose(report->out) == 0;
    report->out = NULL;
    if (!done)
        lom_complain("no memory is left.");
    else if (!lom_write_file(report->path, report->text, report->size, &error))
        done = lom_complain_error(&error) == LOM_EXIT_DONE;
    return done;
}

void lom_drop_report(struct lom_report *report)
{
    if (report->out != NULL)
        fclose(report->out);
    free(report->text);
}

void lom_begin_junit(FILE *out)
{
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n", out);
}

void lom_end_junit(FILE *out)
{
    fputs("</testsuites>\n", out);
}

void lom_put_escaped(FILE *out, const char *text)
{
    for (const unsigned char *p = (const unsigned char *)text; *p != '\0';) {
        size_t length = lom_utf8_length(p, SIZE_MAX);
        if (*p == '&' || *p == '<' || *p == '>' || *p == '"' || *p == '\n' || *p == '\t')
            fprintf(out, "&#%d;", *p);
        else if (*p < 0x20 || length == 0 || (length == 3 && p[0] == 0xef && p[1] == 0xbf && p[2] >= 0xbe))
            fputs("&#65533;", out);
        else
            fwrite(p, 1, length, out);
        p += length != 0 ? length : 1;
    }
}
