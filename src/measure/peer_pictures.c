/* The peers' textures. In: nothing but the formulas of bench/peers/README.md; out: RGBA8 images. Invariant: float
 * arithmetic in the order of the peers' harness, so that both renderers sample the same bytes. */
#include "peer_pictures.h"

#include "peer_noise.h"

static float texel_centre(int i, int size)
{
    return ((float)i + 0.5f) / (float)size;
}

static void store(const lom_image *image, int x, int y, int z, const float color[3], uint8_t alpha)
{
    uint8_t *pixel = lom_image_pixel(image, x, y, z);
    for (int k = 0; k < 3; k++)
        pixel[k] = lom_peer_byte(color[k]);
    pixel[3] = alpha;
}

lom_image *lom_peer_albedo(lom_error *error)
{
    static const float grass[3] = { 70 / 255.f, 92 / 255.f, 38 / 255.f },
                       earth[3] = { 146 / 255.f, 122 / 255.f, 82 / 255.f };
    enum { SIZE = 1024 };
    lom_image *image = lom_create_image(SIZE, SIZE, 1, LOM_FORMAT_RGBA8, error);
    for (int y = 0; image != NULL && y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            float u = texel_centre(x, SIZE), v = texel_centre(y, SIZE), color[3];
            float kind = lom_peer_smoothstep(0.35f, 0.65f, lom_peer_fbm2(u, v, 8, 1));
            float shade = 0.7f + 0.6f * lom_peer_fbm2(u, v, 32, 11);
            for (int k = 0; k < 3; k++)
                color[k] = lom_peer_mix(grass[k], earth[k], kind) * shade;
            store(image, x, y, 0, color, 255);
        }
    return image;
}

static void store_normal(const lom_image *image, const float *height, int x, int y, float strength)
{
    int n = image->width;
    float dx = (height[y * n + (x + 1) % n] - height[y * n + (x + n - 1) % n]) * strength;
    float dy = (height[((y + 1) % n) * n + x] - height[((y + n - 1) % n) * n + x]) * strength;
    float inverse = 1.0f / __builtin_sqrtf(dx * dx + dy * dy + 1);
    float color[3] = { -dx * inverse * 0.5f + 0.5f, -dy * inverse * 0.5f + 0.5f, inverse * 0.5f + 0.5f };
    store(image, x, y, 0, color, 255);
}

lom_image *lom_peer_normals(int size, int period, int seed, float strength, lom_error *error)
{
    lom_image *image = lom_create_image(size, size, 1, LOM_FORMAT_RGBA8, error);
    float *height = image != NULL ? lom_allocate((size_t)size * (size_t)size, sizeof *height, error) : NULL;
    if (height == NULL) {
        lom_free_image(image);
        return NULL;
    }
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            height[y * size + x] = lom_peer_fbm2(texel_centre(x, size), texel_centre(y, size), period, seed);
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            store_normal(image, height, x, y, strength);
    lom_release(height);
    return image;
}

lom_image *lom_peer_dudv(lom_error *error)
{
    enum { SIZE = 512 };
    lom_image *image = lom_create_image(SIZE, SIZE, 1, LOM_FORMAT_RGBA8, error);
    for (int y = 0; image != NULL && y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            float u = texel_centre(x, SIZE), v = texel_centre(y, SIZE);
            float color[3] = { lom_peer_smoothstep(0.2f, 0.8f, lom_peer_fbm2(u, v, 8, 41)),
                               lom_peer_smoothstep(0.2f, 0.8f, lom_peer_fbm2(u, v, 8, 51)), 0 };
            store(image, x, y, 0, color, 255);
        }
    return image;
}

/* The direction of a texel: 1, a and b in the order and with the signs of OpenGL's table of cube faces. */
static void cube_direction(int face, float a, float b, float direction[3])
{
    static const struct {
        int major, along_a, along_b;
        float sign, a, b;
    } faces[6] = {
        { 0, 2, 1, 1, -1, -1 }, { 0, 2, 1, -1, 1, -1 }, { 1, 0, 2, 1, 1, 1 },
        { 1, 0, 2, -1, 1, -1 }, { 2, 0, 1, 1, 1, -1 },  { 2, 0, 1, -1, -1, -1 },
    };
    direction[faces[face].major] = faces[face].sign;
    direction[faces[face].along_a] = faces[face].a * a;
    direction[faces[face].along_b] = faces[face].b * b;
}

lom_image *lom_peer_sky(lom_error *error)
{
    static const float horizon[3] = { 0.75f, 0.85f, 0.95f }, zenith[3] = { 0.20f, 0.42f, 0.78f };
    enum { SIZE = 256 };
    lom_image *image = lom_create_image(SIZE, SIZE, 6, LOM_FORMAT_RGBA8, error);
    for (int i = 0; image != NULL && i < 6 * SIZE * SIZE; i++) {
        int x = i % SIZE, y = i / SIZE % SIZE, face = i / (SIZE * SIZE);
        float d[3], color[3];
        cube_direction(face, 2 * ((float)x + 0.5f) / SIZE - 1, 2 * ((float)y + 0.5f) / SIZE - 1, d);
        float inverse = 1.0f / __builtin_sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        for (int k = 0; k < 3; k++)
            d[k] *= inverse;
        float up = __builtin_sqrtf(d[1] > 0 ? d[1] : 0);
        float noise = lom_peer_fbm3(d[0] * 0.5f + 0.5f, d[1] * 0.5f + 0.5f, d[2] * 0.5f + 0.5f, 8);
        float cloud = lom_peer_smoothstep(0.5f, 0.75f, noise) * 0.8f * lom_peer_clamp01(d[1] * 4);
        for (int k = 0; k < 3; k++)
            color[k] = lom_peer_mix(lom_peer_mix(horizon[k], zenith[k], up), 1, cloud);
        store(image, x, y, face, color, 255);
    }
    return image;
}

lom_image *lom_peer_cloud(lom_error *error)
{
    enum { SIZE = 64 };
    lom_image *image = lom_create_image(SIZE, SIZE, SIZE, LOM_FORMAT_RGBA8, error);
    for (int i = 0; image != NULL && i < SIZE * SIZE * SIZE; i++) {
        int x = i % SIZE, y = i / SIZE % SIZE, z = i / (SIZE * SIZE);
        if (x == 0 || y == 0 || z == 0 || x == SIZE - 1 || y == SIZE - 1 || z == SIZE - 1)
            continue;
        float px = texel_centre(x, SIZE), py = texel_centre(y, SIZE), pz = texel_centre(z, SIZE);
        float qx = (px - 0.5f) / 0.48f, qy = (py - 0.12f) / 0.80f, qz = (pz - 0.5f) / 0.48f;
        float radius = __builtin_sqrtf(qx * qx + qy * qy + qz * qz);
        float density = lom_peer_clamp01((1 - radius) * 2.5f + (lom_peer_fbm3(px, py, pz, 4) - 0.5f) * 3.0f);
        if (qy < 0 || radius > 1)
            density = 0;
        float gray = 0.75f + 0.25f * py, color[3] = { gray, gray, 0.80f + 0.20f * py };
        store(image, x, y, z, color, lom_peer_byte(density));
    }
    return image;
}
