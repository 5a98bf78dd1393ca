/* Proves that every exercise of a lesson has one right answer, which no rounding makes doubtful and no wrong one equals;
 * and computes them. `test_answers --rows` prints the rows of numbers for src/cli/lesson_answers.h, `--changes` the
 * changes of programs whose pictures are answers (sed's), `--right` each right number: tests/lessons/remake.sh asks. */
#include <lom/geometry.h>
#include <lom/image.h>
#include <lom/reference.h>
#include <lom/sea.h>

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

/* ---- interpolation ---- */

static double interpolation_half(void)
{
    return (0.5 / 3) / (0.5 / 1 + 0.5 / 3);
}

static double half(void)
{
    return 0.5;
}

static double interpolation_place(void)
{
    return 0.75;
}

static double quarter(void)
{
    return 0.25;
}

/* ---- depth ---- */

/* Metres between two codes of 24 bits at 1000 m: the distances of two depths that are one step apart. */
static double depth_step(void)
{
    double near = 0.1, far = 10000, depth = far / (far - near) * (1 - near / 1000), next = depth + 0x1p-24;
    return near / (1 - next * (far - near) / far) - 1000;
}

static double depth_even_step(void)
{
    return 10000 * 0x1p-24;
}

/* Millimetres between two floats at 1000 m, reversed. */
static double depth_reversed_step(void)
{
    float depth = 0.1f / 1000;
    return 1000 * (0.1 / (double)nextafterf(depth, 0) - 0.1 / (double)depth);
}

/* ---- textures ---- */

static double textures_level(void)
{
    return log2(256 * sqrt(0.01 * 0.01 + 0.02 * 0.02));
}

static double textures_level_of_area(void)
{
    return log2(256 * sqrt(sqrt(0.01 * 0.01 + 0.02 * 0.02) * 0.005));
}

static double textures_mean(void)
{
    lom_image *light = lom_create_image(1, 1, 1, LOM_FORMAT_R32F, NULL);
    *(float *)(void *)light->pixels = 0.5f;
    lom_image *code = lom_convert_image(light, LOM_FORMAT_R8_SRGB, NULL);
    double mean = code->pixels[0];
    lom_free_image(light);
    lom_free_image(code);
    return mean;
}

static double textures_mean_of_codes(void)
{
    return 128;
}

/* ---- normals ---- */

static lom_vec3 turn_normal(bool inverse_transpose)
{
    lom_mat4 m = lom_scaling((lom_vec3){ 2, 1, 1 }), normals = m;
    if (inverse_transpose)
        lom_normal_matrix(&m, &normals);
    return lom_vec3_normalize(lom_transform_direction(&normals, (lom_vec3){ 1, 1, 0 }));
}

static double normals_x(void)
{
    return turn_normal(true).x;
}

static double normals_wrong_x(void)
{
    return turn_normal(false).x;
}

static double normals_degrees(void)
{
    return acos(lom_vec3_dot(turn_normal(true), turn_normal(false))) * 180 / 3.14159265358979323846;
}

/* ---- lights ---- */

static double in_radians(double degrees)
{
    return degrees * 3.14159265358979323846 / 180;
}

static double lights_diffuse(void)
{
    return cos(in_radians(60));
}

static double lights_diffuse_by_sine(void)
{
    return sin(in_radians(60));
}

static double lights_specular(void)
{
    return pow(cos(in_radians(10)), 40);
}

/* ---- targets ---- */

static double targets_mirrored(void)
{
    return 6 * 1 / (1 + 2.0);
}

static double targets_from_lamp(void)
{
    return 6 - 6 * 1 / (1 + 2.0);
}

static double targets_distance(void)
{
    return 0 * 3 + 1 * 2 + 0 * 1 - 0.5;
}

static double targets_other_distance(void)
{
    return 2 + 0.5;
}

/* ---- water ---- */

static double water_fresnel(void)
{
    return lom_reference_fresnel(cos(in_radians(60)), 1.333);
}

static double water_angle(void)
{
    lom_vec3 down, from = { sin(in_radians(60)), -cos(in_radians(60)), 0 };
    lom_reference_refract(from, (lom_vec3){ 0, 1, 0 }, 1.333, &down);
    return acos(-down.y) * 180 / 3.14159265358979323846;
}

/* ---- waves ---- */

static const double wave_number = 2 * 3.14159265358979323846 / 100;

static double waves_period(void)
{
    return 2 * 3.14159265358979323846 / lom_dispersion(wave_number, INFINITY, 9.80665);
}

static double waves_group(void)
{
    return lom_group_speed(wave_number, INFINITY, 9.80665);
}

static double waves_phase(void)
{
    return lom_dispersion(wave_number, INFINITY, 9.80665) / wave_number;
}

/* ---- clouds ---- */

static double clouds_transmittance(void)
{
    return exp(-2);
}

static double clouds_second_slab(void)
{
    return 0.5 * (1 - 0.2);
}

static double clouds_second_slab_alone(void)
{
    return 1 - 0.2;
}

/* ---- lanes ---- */

static double lanes_share(void)
{
    return 10 * 5 / (ceil(10 * 5 / 16.0) * 16);
}

static double lanes_share_alone(void)
{
    return 5 / 16.0;
}

static double lanes_tiles(void)
{
    return ceil(320 / 32.0) * ceil(180 / 32.0);
}

static double lanes_whole_tiles(void)
{
    return floor(320 / 32.0) * floor(180 / 32.0);
}

/* ---- determinism ---- */

static double determinism_lost(void)
{
    volatile float large = 1e8f, sum = large + 1;
    return (double)(sum - large);
}

static double one(void)
{
    return 1;
}

static double determinism_largest(void)
{
    volatile float n = 1, next = 2;
    while (next != n) { /* the first power of two to which 1 adds nothing: below it, floats are closer than 1 */
        n *= 2;
        next = n + 1;
    }
    return (double)n;
}

/* ---- trade ---- */

/* The midpoint rule on x^2 over [0, 1]. */
static double midpoint_error(int steps)
{
    double sum = 0;
    for (int i = 0; i < steps; i++)
        sum += (i + 0.5) * (i + 0.5) / steps / steps / steps;
    return 1 / 3.0 - sum;
}

static double trade_order(void)
{
    return midpoint_error(64) / midpoint_error(32);
}

static double trade_decibels(void)
{
    return 20 * log10(255 / 2.0);
}

static double trade_power_decibels(void)
{
    return 10 * log10(255 / 2.0);
}

/* ---- stage ---- */

static double stage_fetches(void)
{
    return 5 + 4 + 1;
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
    { "interpolation", 1, 2, interpolation_half, NULL, true,
      "The nearer vertex counts for more: its 1 / w is larger." },
    { "interpolation", 1, 2, half, NULL, false, "That is the weight on the screen; divide by w first." },
    { "interpolation", 2, 2, interpolation_place, NULL, true, "Half of the surface, three quarters of its picture." },
    { "interpolation", 2, 2, quarter, NULL, false,
      "Count from the vertex with w = 1: the nearer half is the larger one." },
    PICTURE("interpolation", 3,
            "s/{ corner\\[0\\], corner\\[1 + i\\], corner\\[2 + i\\] }/{ corner[1 - half], corner[2 - half + i], "
            "corner[(3 - half + i) % 4] }/; s/half == 1)/true)/",
            "With the right weights it does not matter how a flat surface is cut into triangles."),
    { "depth", 1, 1, depth_step, NULL, true, "Steps grow with the square of the distance: at 100 m it is 6 mm." },
    { "depth", 1, 1, depth_even_step, NULL, false,
      "That would be even steps. The derivative of near / d is -near / d^2." },
    { "depth", 2, 2, depth_reversed_step, NULL, true, "Floats are densest near 0, and that is where far things are." },
    PICTURE("depth", 3, "s/near_plane = 0.5/near_plane = 5/",
            "The steps are ten times as fine: the near plane decides, the far one hardly."),
    { "textures", 1, 2, textures_level, NULL, true, "The longer of the two steps decides, in texels." },
    { "textures", 1, 2, textures_level_of_area, NULL, false,
      "That is by the area; the rule takes the longer of the two steps." },
    { "textures", 2, 0, textures_mean, NULL, true, "Half of the light, and its code." },
    { "textures", 2, 0, textures_mean_of_codes, NULL, false,
      "That is the mean of the codes, which have a curve in them: 21 % of the light." },
    PICTURE("textures", 3, "s/.minify = filter\\[i\\]/.minify = filter[i], .lod_bias = -1/",
            "One level finer: sharper, and it begins to shimmer."),
    { "normals", 1, 2, normals_x, NULL, true, "Along x the surface was drawn out, so its normal turns away from x." },
    { "normals", 1, 2, normals_wrong_x, NULL, false,
      "That is the model matrix itself; a normal takes its inverse transpose." },
    { "normals", 2, 1, normals_degrees, NULL, true, "Both are unit vectors: the arc cosine of their product." },
    PICTURE("normals", 3, "s/{ 1.5, 0.4, 1.5 }/{ 0.8, 0.8, 0.8 }/",
            "The same in all directions: the inverse transpose is the matrix times a number."),
    { "lights", 1, 2, lights_diffuse, NULL, true, "The same light on twice the area." },
    { "lights", 1, 2, lights_diffuse_by_sine, NULL, false,
      "That is the sine: the angle counts from the normal, not from the surface." },
    { "lights", 2, 2, lights_specular, NULL, true,
      "About half at 10 degrees: so wide is the highlight of exponent 40." },
    PICTURE("lights", 3,
            "s/.ambient = .*/.ambient = { 0.04f, 0.03f, 0.01f },/; s/.diffuse = .*/.diffuse = { 0.5f, 0.3f, 0.06f },/; "
            "s/.specular = .*/.specular = { 0.7f, 0.5f, 0.2f },/; s/.shininess = 40/.shininess = 20/",
            "A metal colours its highlight, too."),
    { "targets", 1, 2, targets_mirrored, NULL, true,
      "The mirrored lamp hangs 2 m below: a straight line to it meets the mirror there." },
    { "targets", 1, 2, targets_from_lamp, NULL, false, "That is how far it is from the lamp." },
    { "targets", 2, 1, targets_distance, NULL, true, "Above 0, so the point is drawn." },
    { "targets", 2, 1, targets_other_distance, NULL, false, "The plane's last number is added: minus the level." },
    PICTURE("targets", 3, "s/.plane = { 0, 1, 0, 0 }/.plane = { 0, 0, 0, 0 }/",
            "What lies under the mirror came into its picture, where nothing can be reflected from."),
    { "water", 1, 2, half, NULL, true, "1 - cos 60 degrees." },
    { "water", 2, 2, water_fresnel, NULL, true, "A twentieth: the cheap rule makes a lake into a mirror." },
    { "water", 2, 2, half, NULL, false, "That is the cheap rule once more; take Fresnel's equations." },
    { "water", 3, 1, water_angle, NULL, true, "sin 60 degrees / 1.333, and its arc sine." },
    PICTURE("water", 4, "s/lom_splat(0.8f)), lom_splat3(0.004f, 0.03f, 0.06f)/lom_splat(1.0f)), lom_splat3(0, 0, 0)/",
            "Clear water."),
    { "waves", 1, 1, waves_period, NULL, true, "2 pi / sqrt(g k)." },
    { "waves", 2, 1, waves_group, NULL, true,
      "Half of what its crests have: they run through the group and vanish at its front." },
    { "waves", 2, 1, waves_phase, NULL, false, "That is the speed of crests, w / k; a group has dw / dk." },
    PICTURE("waves", 3, "s/.wind_direction = 0.6/.wind_direction = 1.2/",
            "The same numbers, drawn for another wind: only directions changed."),
    { "clouds", 1, 2, clouds_transmittance, NULL, true, "exp(-2)." },
    { "clouds", 2, 2, clouds_second_slab, NULL, true, "What it scatters still has to come through the first one." },
    { "clouds", 2, 2, clouds_second_slab_alone, NULL, false, "So much of it would be seen without the first slab." },
    PICTURE("clouds", 3, "s/TEXELS = 20/TEXELS = 48/",
            "Half as many texels as pixels along each side: 1/4 of the rays, hardly to be seen."),
    { "lanes", 1, 2, lanes_share, NULL, true, "4 packets of 16 for 50 pixels." },
    { "lanes", 1, 2, lanes_share_alone, NULL, false, "That is a triangle at a time." },
    { "lanes", 2, 0, lanes_tiles, NULL, true, "The last row of tiles lies partly outside." },
    { "lanes", 2, 0, lanes_whole_tiles, NULL, false, "The last rows of pixels lie in tiles, too." },
    PICTURE("lanes", 3, "s/BOX = 8/BOX = 4/", "The smaller the triangles, the more a packet of their own wastes."),
    { "determinism", 1, 0, determinism_lost, NULL, true, "1e8 + 1 is no float: the nearest one is 1e8." },
    { "determinism", 1, 0, one, NULL, false, "So it is on paper; floats have 24 bits." },
    { "determinism", 2, 0, determinism_largest, NULL, true, "2^24: from there on floats lie 2 apart." },
    PICTURE("determinism", 3, "s/WAVES = 100/WAVES = 10/",
            "Ten additions are enough: most pixels differ all the same."),
    { "trade", 1, 2, trade_order, NULL, true, "Twice the work, a quarter of the error: the rule is of second order." },
    { "trade", 1, 2, half, NULL, false, "That would be a rule of first order." },
    { "trade", 2, 1, trade_decibels, NULL, true, "20 log10(255 / 2)." },
    { "trade", 2, 1, trade_power_decibels, NULL, false, "The ratio is one of amplitudes: 20 log10, not 10." },
    PICTURE("trade", 3, "s/settings\\[SETTINGS\\] = .*/settings[SETTINGS] = { 2, 4, 6, 8, 12 };/",
            "Where the picture begins to hold, a few steps more buy much."),
    { "stage", 1, 0, stage_fetches, NULL, true, "Five depths, four normals, one tone." },
    PICTURE("stage", 2,
            "s/lom_float4 tone = .*/lom_float4 tone = { lom_splat(1), lom_splat(1), lom_splat(1), lom_splat(1) };/",
            "Lines alone."),
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
