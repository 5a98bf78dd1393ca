/* The text of a scene whose places are so many metres further along x and z. In: text as of key_bases.h: a key a line,
 * tables with headers of their own. Out: the same with other numbers, and with the places that were left to defaults. */
#ifndef LOM_TESTS_MOVED_TEXT_H
#define LOM_TESTS_MOVED_TEXT_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inline bool starts_with(const char *text, const char *start)
{
    return strncmp(text, start, strlen(start)) == 0;
}

/* Whether a key begins a line of the table whose header begins here: before the next header, but for its keys. */
static inline bool table_has(const char *header, const char *key)
{
    for (const char *line = strchr(header, '\n'); line != NULL && line[1] != 0; line = strchr(line + 1, '\n')) {
        if (line[1] == '[')
            return false;
        if (starts_with(line + 1, key))
            return true;
    }
    return false;
}

/* A header and the place that its table lacks. */
static inline const char *missing_place(const char *header)
{
    static const struct {
        const char *header, *key;
    } tables[] = { { "[terrain]\n", "position" },
                   { "[water]\n", "position" },
                   { "[[water]]\n", "position" },
                   { "[[entity]]\n", "position" } };
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        if (starts_with(header, tables[i].header) && !table_has(header, tables[i].key))
            return starts_with(header, "[[entity]]") ? "position = [%.17g, 0, %.17g]\n" : "position = [%.17g, %.17g]\n";
    return NULL;
}

/* A line "key = [x, z]" or "key = [x, y, z]", moved. */
static inline int move_line(char *out, size_t room, const char *line, double x, double z)
{
    const char *open = strchr(line, '[');
    double n[3] = { 0, 0, 0 };
    int count = 0, length = (int)(open - line);
    for (char *at = (char *)open + 1; count < 3; at++) {
        n[count++] = strtod(at, &at);
        if (*at != ',')
            break;
    }
    return count == 2 ? snprintf(out, room, "%.*s[%.17g, %.17g]\n", length, line, n[0] + x, n[1] + z)
                      : snprintf(out, room, "%.*s[%.17g, %.17g, %.17g]\n", length, line, n[0] + x, n[1], n[2] + z);
}

static inline void move_text(char *out, size_t room, const char *text, double x, double z)
{
    static const char *const keys[] = { "position = ", "target = ", "from = [", "to = [",
                                        "middle = ",   "low = [",   "high = [" };
    bool follows = false;
    size_t used = 0;
    for (const char *line = text, *end; *line != 0; line = end + 1) {
        bool moves = false;
        const char *place = line[0] == '[' ? missing_place(line) : NULL;
        end = strchr(line, '\n');
        if (line[0] == '[' && strstr(line, "key]]") != strchr(line, '\n') - 5)
            follows = table_has(line, "follow = ");
        for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
            moves = moves || (!follows && starts_with(line, keys[i]));
        used += (size_t)(moves ? move_line(out + used, room - used, line, x, z)
                               : snprintf(out + used, room - used, "%.*s\n", (int)(end - line), line));
        if (place != NULL)
            used += (size_t)snprintf(out + used, room - used, place, x, z);
    }
}

#endif
