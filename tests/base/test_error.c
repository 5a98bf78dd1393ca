/* Proves what an error keeps: the first failure alone; of a sentence that is too long the beginning and the end, cut
 * between characters and not within one, whatever lies there. */
#include "check.h"

#include <lom/base.h>

/* How many bytes of text are not a whole UTF-8 character: the first of a sequence says how long it is. */
static int broken_bytes(const char *text)
{
    int broken = 0;
    for (const unsigned char *p = (const unsigned char *)text; *p != 0;) {
        int length = *p < 0x80 ? 1 : *p >= 0xf0 ? 4 : *p >= 0xe0 ? 3 : *p >= 0xc0 ? 2 : 0, found = 1;
        while (found < length && (p[found] & 0xc0) == 0x80)
            found++;
        broken += found != length;
        p += found;
    }
    return broken;
}

/* Characters of 1 to 4 bytes, begun at every place: each cut falls on each of their bytes once. */
static void long_sentences_are_cut_between_characters(void)
{
    static const char *const characters[] = { "x", "\u00e9", "\u20ac", "\U0001f300" };
    char sentence[2000], begin[16], end[16];
    for (int i = 0; i < 4; i++)
        for (int before = 0; before < 4; before++)
            for (int after = 0; after < 4; after++) {
                size_t room = sizeof((lom_error *)0)->text, size;
                lom_error error = { 0 };
                snprintf(begin, sizeof begin, "lake:%.*s", before, "1234");
                snprintf(end, sizeof end, "%.*sends.", after, "1234");
                strcpy(sentence, begin);
                for (size = strlen(begin); size < 1500; size += strlen(characters[i]))
                    strcpy(sentence + size, characters[i]);
                strcpy(sentence + size, end);
                CHECK(!lom_fail(&error, LOM_ERROR_INPUT, "%s", sentence) && error.code == LOM_ERROR_INPUT, "no error");
                size = strlen(error.text);
                CHECK(size < room && size + 2 * 3 + 2 >= room, "%zu bytes of %zu", size, room);
                CHECK(broken_bytes(sentence) == 0 && broken_bytes(error.text) == 0, "%d broken characters in %s",
                      broken_bytes(error.text), error.text);
                CHECK(memcmp(error.text, begin, strlen(begin)) == 0 && strstr(error.text, " ... ") != NULL &&
                          strcmp(error.text + size - strlen(end), end) == 0,
                      "%s", error.text);
            }
}

static void the_first_failure_stays(void)
{
    lom_error first = { 0 }, none = { 0 };
    CHECK(!lom_fail(&first, LOM_ERROR_FILE, "one %d", 1) && !lom_fail(&first, LOM_ERROR_LIMIT, "two"),
          "it is a failure");
    CHECK(first.code == LOM_ERROR_FILE && strcmp(first.text, "one 1") == 0, "%s", first.text);
    CHECK(!lom_fail(NULL, LOM_ERROR_FILE, "nobody asks"), "it is a failure");
    CHECK(none.code == LOM_OK && none.text[0] == 0, "touched");
}

int main(int argc, char **argv)
{
    RUN(long_sentences_are_cut_between_characters);
    RUN(the_first_failure_stays);
    return check_result();
}
