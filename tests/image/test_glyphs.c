/* Proves of text in pictures that a letter is the one of the sheet, that no two are alike, that a scale repeats pixels, that
 * an edge is around all ink and nowhere else, and that what is cut off is the picture of the part that is left. */
#include "check.h"

#include "image/glyphs.h"

enum { WIDTH = 160, HEIGHT = 40 };

static uint8_t canvas[HEIGHT][WIDTH][3];
static const uint8_t INK[3] = { 250, 240, 230 }, EDGE[3] = { 9, 8, 7 };

static struct lom_pixel_rows whole(void)
{
    memset(canvas, 0, sizeof canvas);
    return (struct lom_pixel_rows){ canvas[0][0], sizeof canvas[0], WIDTH, HEIGHT, 3 };
}

static bool is_ink(int x, int y)
{
    return memcmp(canvas[y][x], INK, 3) == 0;
}

static void letters_are_spelled(void)
{
    static const char *const expected[9] = { "#...#.......", "#...#.......", "#...#..####.",
                                             "#####.#...#.", "#...#.#...#.", "#...#.#...#.",
                                             "#...#..####.", "..........#.", ".......###.." };
    struct lom_pixel_rows rows = whole();
    lom_draw_text(&rows, 3, 2, 1, "Hg", INK, NULL);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            bool inside = x >= 3 && x < 15 && y >= 2 && y < 11;
            CHECK(is_ink(x, y) == (inside && expected[y - 2][x - 3] == '#'), "pixel %d,%d", x, y);
        }
    CHECK(lom_text_width("Hg", 1) == 11 && lom_text_width("", 3) == 0 && lom_text_width("a\nbcd\n", 2) == 34);
}

static void all_letters_differ(void)
{
    static uint8_t seen[96][9][5];
    for (int letter = ' '; letter <= 127; letter++) {
        const char text[2] = { (char)letter, '\0' };
        struct lom_pixel_rows rows = whole();
        lom_draw_text(&rows, 0, 0, 1, text, INK, NULL);
        int ink = 0;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                if (is_ink(x, y)) {
                    CHECK(x < LOM_GLYPH_WIDTH && y < LOM_GLYPH_HEIGHT, "letter %d leaves its cell", letter);
                    seen[letter - ' '][y % 9][x % 5] = 1;
                    ink++;
                }
        CHECK((ink == 0) == (letter == ' '), "letter %d", letter);
        for (int other = ' '; other < letter; other++)
            CHECK(memcmp(seen[letter - ' '], seen[other - ' '], sizeof seen[0]) != 0, "%c and %c", letter, other);
    }
}

static void what_is_not_ascii_is_one_box(void)
{
    static uint8_t expected[HEIGHT][WIDTH][3];
    struct lom_pixel_rows rows = whole();
    lom_draw_text(&rows, 0, 0, 1,
                  "a\x7f"
                  "b\x7f",
                  INK, NULL);
    memcpy(expected, canvas, sizeof canvas);
    rows = whole();
    lom_draw_text(&rows, 0, 0, 1,
                  "a\xc3\xa9"
                  "b\xe2\x82\xac",
                  INK, NULL);
    CHECK(memcmp(expected, canvas, sizeof canvas) == 0);
    CHECK(lom_text_width("a\xc3\xa9"
                         "b\xe2\x82\xac",
                         1) == lom_text_width("abcd", 1));
}

static void a_scale_repeats_pixels(void)
{
    static uint8_t once[HEIGHT][WIDTH][3];
    struct lom_pixel_rows rows = whole();
    lom_draw_text(&rows, 2, 2, 1, "Qy&\n~@", INK, EDGE);
    memcpy(once, canvas, sizeof canvas);
    rows = whole();
    lom_draw_text(&rows, 4, 4, 2, "Qy&\n~@", INK, EDGE);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            CHECK(memcmp(canvas[y][x], once[y / 2][x / 2], 3) == 0, "pixel %d,%d", x, y);
}

static void an_edge_is_around_all_ink(void)
{
    struct lom_pixel_rows rows = whole();
    lom_draw_text(&rows, 2, 2, 1, "Wide edge, 0.5", INK, EDGE);
    for (int y = 1; y < HEIGHT - 1; y++)
        for (int x = 1; x < WIDTH - 1; x++) {
            bool near = false;
            for (int k = 0; k < 9; k++)
                near |= is_ink(x + k % 3 - 1, y + k / 3 - 1);
            CHECK((memcmp(canvas[y][x], EDGE, 3) == 0) == (near && !is_ink(x, y)), "pixel %d,%d", x, y);
        }
}

/* Windows of a picture give what the whole has there, and bytes around them are left alone. */
static void what_lies_outside_is_cut_off(void)
{
    static uint8_t all[HEIGHT][WIDTH][3];
    struct lom_pixel_rows rows = whole();
    lom_draw_text(&rows, 5, 5, 2, "Cut me\noff", INK, EDGE);
    memcpy(all, canvas, sizeof canvas);
    for (int left = 0; left < 90; left += 7)
        for (int top = 0; top < 30; top += 3) {
            rows = whole();
            rows.pixels = canvas[top][left];
            rows.width = 13;
            rows.height = 6;
            lom_draw_text(&rows, 5 - left, 5 - top, 2, "Cut me\noff", INK, EDGE);
            for (int y = 0; y < HEIGHT; y++)
                for (int x = 0; x < WIDTH; x++) {
                    bool inside = x >= left && x < left + 13 && y >= top && y < top + 6;
                    static const uint8_t none[3];
                    CHECK(memcmp(canvas[y][x], inside ? all[y][x] : none, 3) == 0, "window %d,%d", left, top);
                }
        }
    rows = whole();
    lom_draw_text(&rows, INT32_MAX - 3, INT32_MIN, 1000000, "far\noff", INK, EDGE);
    lom_draw_text(&rows, INT32_MIN, INT32_MAX, 3, "far\noff", INK, EDGE);
    static const uint8_t blank[HEIGHT][WIDTH][3];
    CHECK(memcmp(canvas, blank, sizeof canvas) == 0);
}

static void a_fourth_byte_is_written_too(void)
{
    uint8_t pixels[9][5][4] = { { { 0 } } };
    const uint8_t ink[4] = { 1, 2, 3, 4 };
    struct lom_pixel_rows rows = { pixels[0][0], sizeof pixels[0], 5, 9, 4 };
    lom_draw_text(&rows, 0, 0, 1, "T", ink, NULL);
    CHECK(memcmp(pixels[0][4], ink, 4) == 0 && memcmp(pixels[6][2], ink, 4) == 0 && pixels[6][1][3] == 0);
}

int main(int argc, char **argv)
{
    RUN(letters_are_spelled);
    RUN(all_letters_differ);
    RUN(what_is_not_ascii_is_one_box);
    RUN(a_scale_repeats_pixels);
    RUN(an_edge_is_around_all_ink);
    RUN(what_lies_outside_is_cut_off);
    RUN(a_fourth_byte_is_written_too);
    return check_result();
}
