/* JSON, field by field. In: names and values. Out: one object a line. Invariant: whatever the values are, the line is
 * valid JSON (RFC 8259) in UTF-8. */
#include "json.h"

#include "base/utf8.h"

#include <inttypes.h>

static void write_text(FILE *out, const char *text)
{
    fputc('"', out);
    for (const unsigned char *p = (const unsigned char *)text; *p != 0;) {
        size_t length = lom_utf8_length(p, SIZE_MAX);
        if (*p == '"' || *p == '\\')
            fprintf(out, "\\%c", *p);
        else if (*p < 0x20)
            fprintf(out, "\\u%04x", *p);
        else if (length == 0)
            fputs("\\ufffd", out);
        else
            fwrite(p, 1, length, out);
        p += length != 0 ? length : 1;
    }
    fputc('"', out);
}

static void write_name(lom_json *json, const char *name)
{
    if (json->started)
        fputs(", ", json->out);
    json->started = true;
    if (name == NULL)
        return;
    write_text(json->out, name);
    fputs(": ", json->out);
}

lom_json lom_json_begin(FILE *out)
{
    fputc('{', out);
    return (lom_json){ .out = out, .started = false };
}

void lom_json_end(lom_json *json)
{
    fputs("}\n", json->out);
}

void lom_json_text(lom_json *json, const char *name, const char *text)
{
    if (text == NULL) {
        lom_json_null(json, name);
        return;
    }
    write_name(json, name);
    write_text(json->out, text);
}

void lom_json_integer(lom_json *json, const char *name, int64_t value)
{
    write_name(json, name);
    fprintf(json->out, "%" PRId64, value);
}

void lom_json_number(lom_json *json, const char *name, double value)
{
    char text[32];
    if (!__builtin_isfinite(value)) {
        lom_json_null(json, name);
        return;
    }
    write_name(json, name);
    lom_print_double(text, value);
    fputs(text, json->out);
}

void lom_json_float(lom_json *json, const char *name, float value)
{
    char text[32];
    write_name(json, name);
    lom_print_float(text, value);
    fputs(__builtin_isfinite(value) ? text : "null", json->out);
}

void lom_json_nest(lom_json *json, const char *name, char bracket)
{
    write_name(json, name);
    fputc(bracket, json->out);
    json->started = false;
}

void lom_json_unnest(lom_json *json, char bracket)
{
    fputc(bracket, json->out);
    json->started = true;
}

void lom_json_bool(lom_json *json, const char *name, bool value)
{
    write_name(json, name);
    fputs(value ? "true" : "false", json->out);
}

void lom_json_null(lom_json *json, const char *name)
{
    write_name(json, name);
    fputs("null", json->out);
}

void lom_json_integers(lom_json *json, const char *name, const int64_t *values, size_t count)
{
    write_name(json, name);
    fputc('[', json->out);
    for (size_t i = 0; i < count; i++)
        fprintf(json->out, "%s%" PRId64, i > 0 ? ", " : "", values[i]);
    fputc(']', json->out);
}

void lom_json_points(lom_json *json, const char *name, const lom_vec3 *points, size_t count)
{
    char text[32];
    write_name(json, name);
    for (size_t i = 0; i < count; i++) {
        const double values[3] = { points[i].x, points[i].y, points[i].z };
        fputs(i > 0 ? ", " : "[", json->out);
        for (int k = 0; k < 3; k++) {
            lom_print_double(text, values[k]);
            fprintf(json->out, "%s%s", k > 0 ? ", " : "[", __builtin_isfinite(values[k]) ? text : "null");
        }
        fputc(']', json->out);
    }
    fputc(']', json->out);
}

void lom_json_hash(lom_json *json, const char *name, uint64_t hash)
{
    write_name(json, name);
    fprintf(json->out, "\"%016" PRIx64 "\"", hash);
}
