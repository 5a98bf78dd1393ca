/* Well-formed UTF-8. In: bytes. Out: the length of the sequence that they begin with. */
#include "base/utf8.h"

size_t lom_utf8_length(const unsigned char *text, size_t left)
{
    static const struct {
        unsigned char first, last, low, high, length;
    } rows[] = { { 0x00, 0x7f, 0, 0, 1 },       { 0xc2, 0xdf, 0x80, 0xbf, 2 }, { 0xe0, 0xe0, 0xa0, 0xbf, 3 },
                 { 0xe1, 0xec, 0x80, 0xbf, 3 }, { 0xed, 0xed, 0x80, 0x9f, 3 }, { 0xee, 0xef, 0x80, 0xbf, 3 },
                 { 0xf0, 0xf0, 0x90, 0xbf, 4 }, { 0xf1, 0xf3, 0x80, 0xbf, 4 }, { 0xf4, 0xf4, 0x80, 0x8f, 4 } };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        if (text[0] < rows[r].first || text[0] > rows[r].last)
            continue;
        if (rows[r].length > left)
            return 0;
        for (size_t i = 1; i < rows[r].length; i++) {
            unsigned low = i == 1 ? rows[r].low : 0x80, high = i == 1 ? rows[r].high : 0xbf;
            if (text[i] < low || text[i] > high)
                return 0;
        }
        return rows[r].length;
    }
    return 0;
}
