/* Lesson 15. The same bytes everywhere: determinism OUT.png
 * In: a hundred waves. Out: a picture in three squares: their sum at each pixel; white where the sum from the first wave to
 * the last is another float than from the last to the first; white where one product and sum rounded once (as a fused
 * multiply-add does) is another float than rounded twice. And the sum is computed over lanes of the library, too: the
 * program fails when one bit differs. */
#include <lom/geometry.h>
#include <lom/lanes_mathematics.h>

#include <stdio.h>

enum { SIZE = 106, WAVES = 100 };

struct wave {
    float x, y, phase, height;
};

static struct wave make_wave(int number)
{
    double angle = 6.2831853 * lom_random_uniform(1, (uint64_t)number),
           k = 0.05 + 0.3 * lom_random_uniform(2, (uint64_t)number);
    return (struct wave){ (float)(k * lom_double_cos(angle)), (float)(k * lom_double_sin(angle)),
                          (float)(6.2831853 * lom_random_uniform(3, (uint64_t)number)), (float)(0.02 / k) };
}

static float phase_of(const struct wave *w, float x, float y)
{
    float across = w->x * x, down = w->y * y; /* rounded each; a compiler may not fuse them (-ffp-contract=off) */
    return across + down + w->phase;
}

/* sin of a float, the same on every machine: libm's differs from version to version. */
static float height_of(const struct wave *w, float x, float y)
{
    return w->height * (float)lom_double_sin(phase_of(w, x, y));
}

static float sum_of(const struct wave *waves, float x, float y, bool backwards)
{
    float sum = 0;
    for (int i = 0; i < WAVES; i++)
        sum += height_of(&waves[backwards ? WAVES - 1 - i : i], x, y);
    return sum;
}

/* The product is exact in double, so the sum is rounded to double and then to float: what a fused operation gives, but for
 * rare ties. */
static bool is_changed_by_fusing(const struct wave *waves, float x, float y)
{
    float twice = 0, once = 0;
    for (int i = 0; i < WAVES; i++) {
        float wave = (float)lom_double_sin(phase_of(&waves[i], x, y));
        twice += waves[i].height * wave;
        once = (float)((double)waves[i].height * wave + once);
    }
    return twice != once;
}

/* LOM_LANES pixels at once, in the order of sum_of: one lane's operations are those of one pixel. */
static lom_float sum_of_lanes(const struct wave *waves, lom_float x, float y)
{
    lom_float sum = lom_splat(0);
    for (int i = 0; i < WAVES; i++) {
        lom_float phase = waves[i].x * x + waves[i].y * y + waves[i].phase, wave = phase;
        for (int lane = 0; lane < LOM_LANES; lane++)
            wave[lane] = (float)lom_double_sin((double)phase[lane]);
        sum += waves[i].height * wave;
    }
    return sum;
}

static void paint(lom_image *picture, int square, int x, int y, float light)
{
    for (int c = 0; c < 3; c++)
        ((float *)lom_image_pixel(picture, square * SIZE + x, y, 0))[c] = light;
}

/* How many floats the lanes give that are not those of one pixel after the other. */
static int draw_sums(lom_image *picture)
{
    struct wave waves[WAVES];
    int wrong = 0, order = 0, fused = 0;
    for (int i = 0; i < WAVES; i++)
        waves[i] = make_wave(i);
    for (int i = 0; i < SIZE * SIZE; i++) {
        int x = i % SIZE, y = i / SIZE;
        float sum = sum_of(waves, (float)x, (float)y, false);
        lom_float lanes = sum_of_lanes(waves, lom_to_float(lom_lane_index() + x), (float)y);
        bool differs = sum != sum_of(waves, (float)x, (float)y, true),
             changes = is_changed_by_fusing(waves, (float)x, (float)y);
        wrong += memcmp(&sum, &lanes, sizeof sum) != 0; /* lane 0 */
        order += differs;
        fused += changes;
        paint(picture, 0, x, y, 0.4f + 0.1f * sum);
        paint(picture, 1, x, y, differs ? 0.9f : 0.02f);
        paint(picture, 2, x, y, changes ? 0.9f : 0.02f);
    }
    printf("%d by their order, %d by fusing, %d by lanes, of %d\n", order, fused, wrong, SIZE * SIZE);
    return wrong;
}

int main(int argc, char **argv)
{
    lom_image *picture = lom_create_image(3 * SIZE, SIZE, 1, LOM_FORMAT_RGB32F, NULL);
    bool right = picture != NULL && draw_sums(picture) == 0;
    lom_image *bytes = right ? lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, NULL) : NULL;
    bool done = argc == 2 && bytes != NULL && lom_write_image(argv[1], NULL, bytes, NULL);
    lom_free_image(picture);
    lom_free_image(bytes);
    if (!done)
        fprintf(stderr, "determinism: nothing was written; usage: determinism OUT.png\n");
    return done ? 0 : 2;
}
