/* Pages. In: lines, JSON. Out: bytes. Invariant: what is embedded in a page cannot end the element that it stands in. */
#include "page.h"

#include <stdlib.h>
#include <string.h>

void lom_begin_page(struct lom_page *page)
{
    *page = (struct lom_page){ .out = NULL };
    page->out = open_memstream(&page->text, &page->size);
}

lom_bytes lom_end_page(struct lom_page *page, lom_error *error)
{
    lom_bytes bytes = { NULL, 0 };
    bool done = page->out != NULL && fclose(page->out) == 0;
    if (done)
        bytes.data = lom_allocate(page->size, 1, error);
    if (bytes.data != NULL) {
        memcpy(bytes.data, page->text, page->size);
        bytes.size = page->size;
    } else {
        lom_fail(error, LOM_ERROR_MEMORY, "The system gave no memory for the page.");
    }
    free(page->text);
    *page = (struct lom_page){ .out = NULL };
    return bytes;
}

void lom_drop_page(struct lom_page *page)
{
    if (page->out != NULL)
        fclose(page->out);
    free(page->text);
    *page = (struct lom_page){ .out = NULL };
}

void lom_print_lines(FILE *out, const char *const *lines, size_t count)
{
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s\n", lines[i]);
}

void lom_print_embedded(FILE *out, lom_bytes json)
{
    for (size_t i = 0; i < json.size; i++)
        if (json.data[i] == '<')
            fputs("\\u003c", out);
        else
            fputc(json.data[i], out);
}
