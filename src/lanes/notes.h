/* Notes of what a packet went through, while a pixel of it is watched. In the recorded variant (-DLOM_RECORD) each macro
 * adds one; in all others it is nothing, so the code that draws is the same with and without it. */
#ifndef LOM_LANES_NOTES_H
#define LOM_LANES_NOTES_H

#include <lom/notes.h>

struct lom_note {
    lom_note_kind kind;
    const char *name;
    const void *object;
    size_t first, count; /* rows */
};

struct lom_notes {
    struct lom_note *items;
    float (*rows)[4];
    size_t count, row_count, capacity, row_capacity;
    unsigned skipped; /* bit k: notes of kind k are not kept */
    bool failed;      /* memory ran out: notes are missing */
};

/* From here on this thread's notes go to these, which begin empty; NULL: nowhere. */
void lom_open_notes(struct lom_notes *notes);
void lom_free_notes(struct lom_notes *notes);

/* LOM_NOTE(kind, object, lom_float, ...) */
#ifdef LOM_RECORD
#define LOM_NOTE(kind, object, ...)                                                                                    \
    do {                                                                                                               \
        const lom_float lom_rows[] = { __VA_ARGS__ };                                                                  \
        lom_note(kind, NULL, object, lom_rows, sizeof lom_rows / sizeof lom_rows[0]);                                  \
    } while (0)
#else
#define LOM_NOTE(kind, object, ...) ((void)0)
#endif

#endif
