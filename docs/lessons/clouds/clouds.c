/* Lesson 13. Density, transmittance, scattering, impostor: clouds OUT.png
 * In: a volume of density. Out: a picture of four squares: the density that lies along each ray, the share of light that comes
 * through it, the sunlight that is scattered towards the eye, and that last picture again, drawn once with few texels and
 * shown as a flat plate. */
#include <lom/cloud.h>
#include <lom/texture.h>

#include <stdio.h>

enum { SIZE = 96, TEXELS = 20, STEPS = 48, SUN_STEPS = 12 };

static const double extinction = 14, step = 1.0 / STEPS; /* 1 / box, in boxes: the box has the side 1 */
static const float sun = 0.95f, sky = 0.1f;
static const double to_sun[3] = { 0.5, 0.75, 0.43 };

/* At a place of the unit box, between its voxels; 0 outside. */
static double density_at(const lom_image *volume, const double at[3])
{
    double sum = 0;
    int low[3], size[3] = { volume->width, volume->height, volume->depth };
    double weight[3];
    for (int i = 0; i < 3; i++) {
        double along = at[i] * size[i] - 0.5;
        if (!(at[i] >= 0 && at[i] <= 1))
            return 0;
        low[i] = along < 0 ? 0 : along >= size[i] - 1 ? size[i] - 2 : lom_int_of(along);
        weight[i] = along < 0 ? 0 : along >= size[i] - 1 ? 1 : along - low[i];
    }
    for (int corner = 0; corner < 8; corner++) {
        int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
        const uint16_t *voxel = lom_image_pixel(volume, low[0] + x, low[1] + y, low[2] + z);
        sum += *voxel * (x ? weight[0] : 1 - weight[0]) * (y ? weight[1] : 1 - weight[1]) *
               (z ? weight[2] : 1 - weight[2]);
    }
    return sum / 65535;
}

/* The optical depth from a place towards the sun: what lies on the way, added up. */
static double depth_to_sun(const lom_image *volume, const double from[3])
{
    double depth = 0, length = 0.5 / SUN_STEPS;
    for (int i = 0; i < SUN_STEPS; i++) {
        double at[3];
        for (int k = 0; k < 3; k++)
            at[k] = from[k] + (i + 0.5) * length * to_sun[k];
        depth += density_at(volume, at) * extinction * length;
    }
    return depth;
}

struct ray {
    double depth, transmittance;
    float light;
};

/* Straight through the box, from its front to its back: x to the right and y down the picture, 0..1. */
static struct ray march(const lom_image *volume, double x, double y)
{
    struct ray ray = { 0, 1, 0 };
    for (int i = 0; i < STEPS; i++) {
        double at[3] = { x, 1 - y, 1 - (i + 0.5) * step }, here = density_at(volume, at) * extinction * step;
        if (here == 0)
            continue;
        double through = lom_double_exp(-here), from_sun = lom_double_exp(-depth_to_sun(volume, at));
        ray.light += (float)(ray.transmittance * (1 - through)) * (sun * (float)from_sun + sky);
        ray.transmittance *= through;
        ray.depth += here;
    }
    return ray;
}

static void paint(lom_image *picture, int square, int x, int y, float light, double transmittance)
{
    static const float blue[3] = { 0.12f, 0.28f, 0.6f };
    for (int c = 0; c < 3; c++)
        ((float *)lom_image_pixel(picture, square * SIZE + x, y, 0))[c] = light + blue[c] * (float)transmittance;
}

static bool draw_clouds(lom_image *picture, lom_error *error)
{
    static float plate[TEXELS * TEXELS][4]; /* light and, as alpha, the transmittance */
    lom_image *volume = lom_make_cloud(
        &(lom_cloud_desc){ "cumulus_congestus", .width = 48, .height = 48, .depth = 48, .seed = 7 }, error);
    for (int i = 0; i < TEXELS * TEXELS && volume != NULL; i++) {
        struct ray ray = march(volume, (i % TEXELS + 0.5) / TEXELS, (i / TEXELS + 0.5) / TEXELS);
        plate[i][0] = ray.light;
        plate[i][3] = (float)ray.transmittance;
    }
    lom_texture *impostor = lom_create_texture(
        &(lom_texture_desc){ .width = TEXELS, .height = TEXELS, .format = LOM_FORMAT_RGBA32F, .pixels = plate }, error);
    for (int i = 0; i < SIZE * SIZE && volume != NULL && impostor != NULL; i++) {
        double x = (i % SIZE + 0.5) / SIZE, y = (i / SIZE + 0.5) / SIZE;
        struct ray ray = march(volume, x, y);
        lom_float4 texel = lom_sample(impostor, lom_splat((float)x), lom_splat((float)y), lom_splat(0));
        paint(picture, 0, i % SIZE, i / SIZE, (float)(ray.depth / 8), 0);
        paint(picture, 1, i % SIZE, i / SIZE, 0, ray.transmittance);
        paint(picture, 2, i % SIZE, i / SIZE, ray.light, ray.transmittance);
        paint(picture, 3, i % SIZE, i / SIZE, texel.x[0], (double)texel.w[0]);
    }
    bool done = volume != NULL && impostor != NULL;
    lom_free_image(volume);
    lom_free_texture(impostor);
    return done;
}

int main(int argc, char **argv)
{
    lom_error error = { .code = LOM_OK };
    lom_image *picture = lom_create_image(4 * SIZE, SIZE, 1, LOM_FORMAT_RGB32F, &error);
    bool drawn = picture != NULL && argc == 2 && draw_clouds(picture, &error);
    lom_image *bytes = drawn ? lom_convert_image(picture, LOM_FORMAT_RGB8_SRGB, &error) : NULL;
    bool done = bytes != NULL && lom_write_image(argv[1], NULL, bytes, &error);
    lom_free_image(picture);
    lom_free_image(bytes);
    if (!done)
        fprintf(stderr, "clouds: nothing was written; usage: clouds OUT.png. %s\n", error.text);
    return done ? 0 : 2;
}
