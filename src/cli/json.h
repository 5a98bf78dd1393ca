/* JSON (RFC 8259), one object a line, written field by field. Numbers do not depend on the locale; what JSON has no
 * number for (infinity, NaN) is null; bytes that are no UTF-8 become U+FFFD. */
#ifndef LOM_CLI_JSON_H
#define LOM_CLI_JSON_H

#include <lom/geometry.h>

#include <stdio.h>

typedef struct lom_json {
    FILE *out;
    bool started; /* a field has been written */
} lom_json;

lom_json lom_json_begin(FILE *out);
void lom_json_end(lom_json *json); /* closes the object and the line */

void lom_json_text(lom_json *json, const char *name, const char *text); /* NULL text: null */
void lom_json_integer(lom_json *json, const char *name, int64_t value);
void lom_json_number(lom_json *json, const char *name, double value); /* the shortest that reads back the same */
void lom_json_bool(lom_json *json, const char *name, bool value);
void lom_json_null(lom_json *json, const char *name);
void lom_json_integers(lom_json *json, const char *name, const int64_t *values, size_t count); /* an array */
/* An array of arrays of x, y and z; at least one. */
void lom_json_points(lom_json *json, const char *name, const lom_vec3 *points, size_t count);
void lom_json_float(lom_json *json, const char *name, float value); /* the shortest that reads back as this float */
/* An array or object within: what is written until lom_json_unnest is its contents; in an array names are NULL. */
void lom_json_nest(lom_json *json, const char *name, char bracket);
void lom_json_unnest(lom_json *json, char bracket);
void lom_json_hash(lom_json *json, const char *name, uint64_t hash); /* text of 16 hexadecimal digits */

#endif
