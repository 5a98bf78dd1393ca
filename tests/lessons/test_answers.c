/* Proves that every exercise of a lesson has one right answer, which no rounding makes doubtful and no wrong one equals;
 * and computes them. `test_answers --rows` prints the rows of numbers for src/cli/lesson_answers.h, `--changes` the
 * changes of programs whose pictures are answers (sed's), `--right` each right number: tests/lessons/remake.sh asks. */
#include <lom/geometry.h>
#include <lom/image.h>

#include <math.h>

#include "check.h"

struct answer {
    const char *lesson;
    int exercise, decimals;
    double (*value)(void); /* NULL: the picture of the lesson's program after `change`, or after none */
    const char *change;
    bool right;
    const char *sentence;
};

/* ---- triangle ---- */

/* Row by row, what lies between the two sides. */
static double triangle_pixels(void)
{
    double count = 0;
    for (int y = 12; y < 165; y++) {
        double share = (y + 0.5 - 12) / 153, left = 160 - 130 * share, right = 160 + 130 * share;
        count += floor(right - 0.5) - ceil(left - 0.5) + 1;
    }
    return count;
}

static double triangle_weight(void)
{
    return (165 - 63.0) / 153;
}

static double triangle_other_weight(void)
{
    return (63 - 12.0) / 153;
}

/* ---- transforms ---- */

static lom_mat4 transform_parts[3]; /* T(2, 1), R(30 degrees), S(2) */

static double transform_x(int first, int second, int third)
{
    double radians = 3.14159265358979323846 / 6;
    transform_parts[0] = lom_translation((lom_vec3){ 2, 1, 0 });
    transform_parts[1] = lom_rotation((lom_vec3){ 0, 0, radians });
    transform_parts[2] = lom_scaling((lom_vec3){ 2, 2, 2 });
    lom_vec3 p = { 1, 0, 0 };
    p = lom_transform_point(&transform_parts[first], p);
    p = lom_transform_point(&transform_parts[second], p);
    return lom_transform_point(&transform_parts[third], p).x;
}

static double transforms_right(void)
{
    return transform_x(2, 1, 0);
}

static double transforms_backwards(void)
{
    return transform_x(0, 1, 2);
}

static double two(void)
{
    return 2;
}

static double zero(void)
{
    return 0;
}

/* ---- clip space ---- */

static double clip_space_y(void)
{
    return (1 - 2 / 4.0) / 2 * 180;
}

static double clip_space_y_up(void)
{
    return (1 + 2 / 4.0) / 2 * 180;
}

static double clip_space_post(void)
{
    return 180 / (2 * tan(0.45)) / 5;
}

static double clip_space_post_unhalved(void)
{
    return 180 / (2 * tan(0.9)) / 5;
}

static double clip_space_post_half_height(void)
{
    return 90 / (2 * tan(0.45)) / 5;
}

static double clip_space_cut(void)
{
    double da = 1 - 0.1, db = -0.5 - 0.1;
    return da / (da - db);
}

static double clip_space_cut_at_eye(void)
{
    return 1 / 1.5;
}

/* ---- rasterization ---- */

static const int raster_corner[2][3][2] = { { { 640, 384 }, { 2944, 384 }, { 640, 2688 } },
                                            { { 2944, 384 }, { 4480, 2688 }, { 640, 2688 } } };

static int raster_owners(int column, int row, bool takes_all)
{
    int owners = 0;
    for (int t = 0; t < 2; t++) {
        bool inside = true;
        for (int i = 0; i < 3; i++) {
            const int *a = raster_corner[t][i], *b = raster_corner[t][(i + 1) % 3];
            int x = column * 256 + 128 - a[0], y = row * 256 + 128 - a[1];
            /* A centre moved right by less than anything, and down by less than that, lies upon no edge. */
            int e = (b[0] - a[0]) * y - (b[1] - a[1]) * x, moved = -(b[1] - a[1]), down = b[0] - a[0];
            inside = inside && (e > 0 || (e == 0 && (takes_all || moved > 0 || (moved == 0 && down > 0))));
        }
        owners += inside;
    }
    return owners;
}

static double raster_pixels(bool takes_all, int owners)
{
    int count = 0;
    for (int i = 0; i < 20 * 11; i++)
        count += raster_owners(i % 20, i / 20, takes_all) >= owners;
    return count;
}

static double rasterization_pixels(void)
{
    return raster_pixels(false, 1);
}

static double rasterization_pixels_all(void)
{
    return raster_pixels(true, 1);
}

static double rasterization_twice(void)
{
    return raster_pixels(true, 2);
}

static double rasterization_snapped(void)
{
    return rint(10.3 * 256);
}

static double rasterization_cut(void)
{
    return floor(10.3 * 256);
}

static const struct answer answers[] = {
#define PICTURE(lesson, exercise, change, sentence)                                                                    \
    {                                                                                                                  \
        lesson, exercise, -1, NULL, change, true, sentence                                                             \
    }
    { "triangle", 1, 0, triangle_pixels, NULL, true, "As many as its area: each centre stands for one square pixel." },
    { "triangle", 2, 2, triangle_weight, NULL, true, "The weight of a corner falls evenly to 0 at the side opposite." },
    { "triangle", 2, 2, triangle_other_weight, NULL, false,
      "That is what is left for the other two corners together." },
    PICTURE("triangle", 3, "s/{ { 160, 12 }, { 290, 165 }, { 30, 165 } }/{ { 160, 165 }, { 30, 12 }, { 290, 12 } }/",
            "Clockwise on the screen again, so all three edge functions are positive inside."),
    { "transforms", 1, 0, two, NULL, true, "Turned, it is at (0, 1); then moved." },
    { "transforms", 1, 0, zero, NULL, false, "That is what comes when it is moved first: the move is turned, too." },
    { "transforms", 2, 2, transforms_right, NULL, true, "The matrix next to the point acts first: S, then R, then T." },
    { "transforms", 2, 2, transforms_backwards, NULL, false,
      "That is S R T: the matrix that stands next to the point acts first." },
    PICTURE(
        "transforms", 3,
        "s/lom_mat4 turned_then_moved.*/lom_mat4 away = lom_translation((lom_vec3){ -0.5, -0.9, 0 }), back = "
        "lom_translation((lom_vec3){ 0.5, 0.9, 0 }); lom_mat4 a = lom_multiply(\\&turn, \\&away), turned_then_moved = "
        "lom_multiply(\\&back, \\&a);/; /moved_then_turned, red/d",
        "To the origin, turn, and back: T(c) R T(-c) turns about c."),
    { "clip_space", 1, 0, clip_space_y, NULL, true, "y / w is 1/2, and window y points down." },
    { "clip_space", 1, 0, clip_space_y_up, NULL, false, "Window y points down: row 0 is the top one." },
    { "clip_space", 2, 1, clip_space_post, NULL, true, "Half the picture is tan(field of view / 2) at distance 1." },
    { "clip_space", 2, 1, clip_space_post_unhalved, NULL, false, "The angle is that of the whole picture: take half." },
    { "clip_space", 2, 1, clip_space_post_half_height, NULL, false, "That is half of it: y / w goes from -1 to 1." },
    { "clip_space", 3, 2, clip_space_cut, NULL, true, "t = dA / (dA - dB), with d = w - z." },
    { "clip_space", 3, 2, clip_space_cut_at_eye, NULL, false,
      "That is where w is 0, beside the eye; cut where w = z." },
    { "rasterization", 1, 0, rasterization_pixels, NULL, true, "Every one of them is drawn once." },
    { "rasterization", 1, 0, rasterization_pixels_all, NULL, false,
      "That counts centres on right and bottom edges, which belong to whoever lies beyond." },
    { "rasterization", 2, 0, rasterization_twice, NULL, true,
      "Each of the shared edge's centres: blended, they would show as a line." },
    { "rasterization", 3, 0, rasterization_snapped, NULL, true, "To the nearest 256th, so at most 1/512 pixel off." },
    { "rasterization", 3, 0, rasterization_cut, NULL, false, "That is cut off, not rounded to the nearest." },
};
enum { ANSWERS = sizeof answers / sizeof answers[0] };

static double scaled(const struct answer *a)
{
    return a->value() * pow(10, a->decimals);
}

/* What src/cli/lesson.c hashes. */
static uint64_t hash_number(const struct answer *a)
{
    char text[96];
    snprintf(text, sizeof text, "%.20s %d %lld", a->lesson, a->exercise,
             (long long)lom_int64_of(floor(scaled(a) + 0.5)));
    return lom_hash_bytes(LOM_HASH_START, text, strlen(text));
}

static void print(const char *what)
{
    for (const struct answer *a = answers; a < answers + ANSWERS; a++)
        if (strcmp(what, "--changes") == 0 && a->value == NULL)
            printf("%s|%d|%s|%s\n", a->lesson, a->exercise, a->sentence, a->change);
        else if (strcmp(what, "--rows") == 0 && a->value != NULL)
            printf("    { \"%s\", %d, %d, 0x%016llx, %s, \"%s\" },\n", a->lesson, a->exercise, a->decimals,
                   (unsigned long long)hash_number(a), a->right ? "true" : "false", a->sentence);
        else if (strcmp(what, "--right") == 0 && a->value != NULL && a->right)
            printf("%s %d %.*f\n", a->lesson, a->exercise, a->decimals, a->value());
}

/* ---- tests ---- */

static bool same_exercise(const struct answer *a, const struct answer *b)
{
    return strcmp(a->lesson, b->lesson) == 0 && a->exercise == b->exercise;
}

static void every_exercise_has_one_right_answer(void)
{
    for (const struct answer *a = answers; a < answers + ANSWERS; a++) {
        int right = 0;
        for (const struct answer *b = answers; b < answers + ANSWERS; b++)
            right += same_exercise(a, b) && b->right;
        CHECK(right == 1, "%s %d has %d", a->lesson, a->exercise, right);
        CHECK(a->sentence[strlen(a->sentence) - 1] == '.', "%s", a->sentence);
    }
}

static void rounding_leaves_no_doubt(void)
{
    for (const struct answer *a = answers; a < answers + ANSWERS; a++) {
        if (a->value == NULL)
            continue;
        double x = scaled(a), distance = fabs(x - floor(x) - 0.5);
        CHECK(distance > 0.02, "%s %d: %.9g lies between two roundings", a->lesson, a->exercise, a->value());
    }
}

static void no_wrong_answer_is_the_right_one(void)
{
    for (const struct answer *a = answers; a < answers + ANSWERS; a++)
        for (const struct answer *b = a + 1; b < answers + ANSWERS; b++)
            if (same_exercise(a, b) && a->value != NULL)
                CHECK(hash_number(a) != hash_number(b), "%s %d: %g", a->lesson, a->exercise, a->value());
}

int main(int argc, char **argv)
{
    if (argc == 2 && strncmp(argv[1], "--", 2) == 0) {
        print(argv[1]);
        return 0;
    }
    RUN(every_exercise_has_one_right_answer);
    RUN(rounding_leaves_no_doubt);
    RUN(no_wrong_answer_is_the_right_one);
    return check_result();
}
