/* Where notes go. In: notes of the thread that shades a watched packet. Out: a list of them. Samplers and shaders have no
 * argument that could lead to whoever watches, so the list is the thread's: the one thing that is. Invariant: a thread
 * that watches nothing writes nothing. */
#include "lanes/notes.h"

#include "base/reserve.h"

static _Thread_local struct lom_notes *watching;

void lom_open_notes(struct lom_notes *notes)
{
    watching = notes;
    if (notes != NULL)
        notes->count = notes->row_count = 0;
}

void lom_note(lom_note_kind kind, const char *name, const void *object, const void *rows, size_t count)
{
    struct lom_notes *n = watching;
    if (n == NULL || (n->skipped >> kind & 1) != 0)
        return;
    if (!lom_reserve(&n->items, &n->capacity, n->count + 1, sizeof *n->items, NULL) ||
        !lom_reserve(&n->rows, &n->row_capacity, n->row_count + count, sizeof *n->rows, NULL)) {
        n->failed = true;
        return;
    }
    n->items[n->count++] = (struct lom_note){ kind, name, object, n->row_count, count };
    if (count > 0) /* else there may be no rows yet */
        memcpy(n->rows + n->row_count, rows, count * sizeof *n->rows);
    n->row_count += count;
}

void lom_free_notes(struct lom_notes *notes)
{
    lom_release(notes->items);
    lom_release(notes->rows);
}
