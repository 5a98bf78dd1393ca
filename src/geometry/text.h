/* Words and numbers of the line-oriented formats (OBJ, MTL). In: bytes in memory. Out: words that point into them.
 * A position never passes the end, so any bytes are safe; line counts physical lines from 1. */
#ifndef LOM_GEOMETRY_TEXT_H
#define LOM_GEOMETRY_TEXT_H

#include <lom/base.h>

struct lom_text {
    const char *at, *end;
    size_t line;
    const char *name; /* of the file, for messages */
    lom_error *error;
};

struct lom_word {
    const char *start;
    size_t length; /* 0: there is none */
};

/* Skips a byte order mark. False when the text holds a zero byte, which no text file does. */
bool lom_text_open(struct lom_text *text, const char *bytes, size_t size, const char *name, lom_error *error);
/* The next word of the statement; a backslash before the end of the line continues it; none at its end or at '#'. */
struct lom_word lom_text_word(struct lom_text *text);
/* Everything up to the end of the statement, without the blanks around it; may hold blanks, and '#'. */
struct lom_word lom_text_rest(struct lom_text *text);
/* The part of such a rest before what would be a comment if it were one: a '#' at its start or behind a blank. */
struct lom_word lom_before_comment(struct lom_word rest);
/* A file name out of such a rest, without what looks like a comment: what stands before '#' ends with an extension, and
 * a blank follows '#' or the whole ends with none. */
struct lom_word lom_file_name(struct lom_word rest);
/* Moves to the start of the next statement; false at the end of the text. */
bool lom_text_next(struct lom_text *text);
/* "name:line: " and the sentence. Always false. */
bool lom_text_fail(struct lom_text *text, lom_code code, const char *format, ...) __attribute__((format(printf, 3, 4)));

bool lom_word_is(struct lom_word word, const char *string);
/* At most this much of a word is quoted in a message. */
int lom_word_shown(struct lom_word word);
/* A finite number, the whole word; false and a message otherwise. */
bool lom_text_number(struct lom_text *text, struct lom_word word, double *value);
/* The next words of the statement as finite floats: as many as there are, at most limit. -1 and a message for a word
 * that is no number or one too many. */
int lom_text_floats(struct lom_text *text, float *values, int limit);

#endif
