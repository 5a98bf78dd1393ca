/* Many small things, scattered. In: formulas of bench/peers/README.md, "Scattered meshes"; out: interleaved vertices
 * whose normals hold colours, 32-bit indices, two textures. Invariant: every number is drawn by what it is for, so each
 * thing is the same whatever was made before it. */
#include "peer_scatter.h"

#include "peer_noise.h"

/* Random number `use` of thing `key`, in [0, 1). */
static float draw_number(uint32_t key, uint32_t use)
{
    return lom_peer_lattice(key, use, 91);
}

static bool allocate_quads(lom_peer_mesh *mesh, uint32_t quads, lom_error *error)
{
    if (!lom_peer_allocate_mesh(mesh, (size_t)4 * quads, (size_t)6 * quads, error))
        return false;
    static const uint8_t corners[6] = { 0, 1, 2, 2, 1, 3 };
    for (uint32_t i = 0; i < 6 * quads; i++)
        mesh->indices[i] = i / 6 * 4 + corners[i % 6];
    return true;
}

bool lom_peer_sprites(lom_peer_mesh *mesh, int width, int height, lom_error *error)
{
    enum { SPRITES = 2000, SIDE = 64 };
    if (!allocate_quads(mesh, SPRITES, error))
        return false;
    float w = (float)width, h = (float)height;
    for (uint32_t i = 0; i < 4 * SPRITES; i++) {
        uint32_t k = i / 4;
        float s = (float)(i & 1), t = (float)(i >> 1 & 1);
        float x = draw_number(k, 0) * w + SIDE * s - SIDE / 2, y = draw_number(k, 1) * h + SIDE * t - SIDE / 2;
        lom_peer_vertex *vertex = &mesh->vertices[i];
        *vertex = (lom_peer_vertex){ .position = { x * 2 / w - 1, y * 2 / h - 1, 0 }, .uv = { s, t } };
        for (uint32_t c = 0; c < 3; c++)
            vertex->normal[c] = 0.5f + 0.5f * draw_number(k, 2 + c);
    }
    return true;
}

bool lom_peer_cards(lom_peer_mesh *mesh, int width, int height, lom_error *error)
{
    enum { CARDS = 20000 };
    (void)width, (void)height;
    if (!allocate_quads(mesh, CARDS, error))
        return false;
    for (uint32_t k = 0; k < CARDS; k++) {
        float x = -50 + 100 * draw_number(k, 0), z = -50 + 100 * draw_number(k, 1);
        float y = lom_peer_terrain_height(x, z), angle = 6.28318530718f * draw_number(k, 2);
        float size = 0.4f + 0.4f * draw_number(k, 3);
        float along_x = (float)lom_double_cos((double)angle), along_z = (float)lom_double_sin((double)angle);
        for (uint32_t i = 0; i < 4; i++) {
            float s = (float)(i & 1), t = (float)(i >> 1), across = (s - 0.5f) * size;
            mesh->vertices[4 * k + i] = (lom_peer_vertex){
                .position = { x + along_x * across, y + t * 1.5f * size, z + along_z * across },
                .normal = { 0.5f + 0.5f * draw_number(k, 4), 0.7f + 0.3f * draw_number(k, 5),
                            0.4f + 0.2f * draw_number(k, 6) },
                .uv = { s, t },
            };
        }
    }
    return true;
}

/* A corner of the grid of a layer, moved by up to 4 pixels a side: neighbours share it. */
static void grid_corner(lom_peer_vertex *vertex, uint32_t layer, uint32_t column, uint32_t row, const float size[2])
{
    enum { CELL = 20 };
    uint32_t key = (layer * 4096 + row) * 4096 + column;
    float x = ((float)column - 1) * CELL + (draw_number(key, 0) - 0.5f) * 8;
    float y = ((float)row - 1) * CELL + (draw_number(key, 1) - 0.5f) * 8;
    vertex->position[0] = x * 2 / size[0] - 1;
    vertex->position[1] = y * 2 / size[1] - 1;
}

bool lom_peer_gradients(lom_peer_mesh *mesh, int width, int height, lom_error *error)
{
    enum { CELL = 20, LAYERS = 3 };
    uint32_t columns = (uint32_t)width / CELL + 2, rows = (uint32_t)height / CELL + 2;
    size_t count = (size_t)LAYERS * rows * columns * 6;
    if (!lom_peer_allocate_mesh(mesh, count, count, error))
        return false;
    static const uint8_t corners[6] = { 0, 1, 2, 2, 1, 3 };
    const float size[2] = { (float)width, (float)height };
    for (uint32_t i = 0; i < count; i++) {
        uint32_t cell = i / 6, corner = corners[i % 6];
        lom_peer_vertex *vertex = &mesh->vertices[i];
        grid_corner(vertex, cell / (rows * columns), cell % columns + (corner & 1),
                    cell / columns % rows + (corner >> 1), size);
        vertex->position[2] = draw_number(i, 2) * 1.8f - 0.9f;
        for (uint32_t c = 0; c < 3; c++)
            vertex->normal[c] = draw_number(i, 3 + c);
        mesh->indices[i] = i;
    }
    return true;
}

lom_peer_box lom_peer_box_at(int index)
{
    uint32_t k = (uint32_t)index;
    return (lom_peer_box){
        .centre = { -40 + 80 * draw_number(k, 0), -20 + 40 * draw_number(k, 1), -70 + 80 * draw_number(k, 2) },
        .size = 0.15f + 0.35f * draw_number(k, 3),
        .color = { 0.3f + 0.7f * draw_number(k, 4), 0.3f + 0.7f * draw_number(k, 5), 0.3f + 0.7f * draw_number(k, 6) },
    };
}

/* One texel from the noise there and the distance to the middle, 1 at the sides. */
typedef void texel_formula(float noise, float radius, float color[4]);

static void blob_texel(float noise, float radius, float color[4])
{
    color[0] = color[1] = color[2] = 0.6f + 0.4f * noise;
    color[3] = lom_peer_clamp01(1 - radius) * (0.25f + 0.75f * noise);
}

static void leaf_texel(float noise, float radius, float color[4])
{
    color[0] = lom_peer_mix(0.20f, 0.45f, noise);
    color[1] = lom_peer_mix(0.35f, 0.60f, noise);
    color[2] = lom_peer_mix(0.10f, 0.25f, noise);
    color[3] = (noise - 0.3f - 0.4f * radius * radius) * 16;
}

static lom_image *make_picture(int size, int period, int seed, texel_formula *formula, lom_error *error)
{
    lom_image *image = lom_create_image(size, size, 1, LOM_FORMAT_RGBA8, error);
    for (int i = 0; image != NULL && i < size * size; i++) {
        float u = ((float)(i % size) + 0.5f) / (float)size, v = ((float)(i / size) + 0.5f) / (float)size;
        float radius = 2 * __builtin_sqrtf((u - 0.5f) * (u - 0.5f) + (v - 0.5f) * (v - 0.5f)), color[4];
        formula(lom_peer_fbm2(u, v, period, seed), radius, color);
        for (int c = 0; c < 4; c++)
            image->pixels[4 * i + c] = lom_peer_byte(color[c]);
    }
    return image;
}

lom_image *lom_peer_blob(lom_error *error)
{
    return make_picture(64, 4, 61, blob_texel, error);
}

lom_image *lom_peer_leaf(lom_error *error)
{
    return make_picture(128, 8, 71, leaf_texel, error);
}
