/* Proves that the cells of a medium are what its voxels say: words, emptiness and bend, each found here voxel by voxel. */
#include "check.h"
#include "march/cells.h"

static lom_image *thin_image(int width, int height, int depth, lom_format format, uint64_t seed)
{
    lom_image *image = lom_create_image(width, height, depth, format, NULL);
    for (int i = 0; i < width * height * depth; i++) {
        const double value = lom_random_uniform(seed, (uint64_t)i), thin = value < 0.03 ? value * value * 1000 : 0;
        const double kept = lom_random_uniform(seed + 1, (uint64_t)i) < 0.2 ? lom_smaller(thin, 1) : thin / 9;
        if (format == LOM_FORMAT_R8)
            image->pixels[i] = (uint8_t)lom_count_of(kept * 255, 255);
        else if (format == LOM_FORMAT_R16)
            ((uint16_t *)(void *)image->pixels)[i] = (uint16_t)lom_count_of(kept * 65535, 65535);
        else
            ((float *)(void *)image->pixels)[i] = (float)kept;
    }
    return image;
}

/* Of a voxel, or of the last one of each axis. */
static int voxel_at(const lom_image *image, int x, int y, int z)
{
    x = x < 0 ? 0 : lom_smaller_int(x, image->width - 1);
    y = y < 0 ? 0 : lom_smaller_int(y, image->height - 1);
    z = z < 0 ? 0 : lom_smaller_int(z, image->depth - 1);
    const void *at = lom_image_pixel(image, x, y, z);
    if (image->format == LOM_FORMAT_R8)
        return 257 * *(const uint8_t *)at;
    if (image->format == LOM_FORMAT_R16)
        return *(const uint16_t *)at;
    return (int)lom_count_of(lom_smaller((double)*(const float *)at, 1) * 65535 + 0.5, 65535);
}

static int most_in(const lom_image *image, int x, int y, int z)
{
    int most = 0;
    for (int c = 0; c < 8; c++) {
        const int value = voxel_at(image, x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
        most = value > most ? value : most;
    }
    return most;
}

static int distance_of(const lom_image *image, const int at[3])
{
    int nearest = 240;
    for (int z = 0; z <= image->depth; z++)
        for (int y = 0; y <= image->height; y++)
            for (int x = 0; x <= image->width; x++) {
                if (most_in(image, x, y, z) == 0)
                    continue;
                int away = lom_magnitude_int(x - at[0]), along_y = lom_magnitude_int(y - at[1]);
                away = along_y > away ? along_y : away;
                away = lom_magnitude_int(z - at[2]) > away ? lom_magnitude_int(z - at[2]) : away;
                nearest = away < nearest ? away : nearest;
            }
    return nearest;
}

static void check_cell(const lom_image *image, const lom_medium *m, int x, int y, int z)
{
    const int at[3] = { x, y, z }, most = most_in(image, x, y, z);
    const size_t index = cell_index(m->width, m->height, x, y, z);
    const int emptiness = m->emptiness[index];
    if (most == 0)
        CHECK(emptiness - LOM_CELL_EMPTY + 1 == distance_of(image, at), "%d %d %d: %d", x, y, z, emptiness);
    else
        CHECK(emptiness < LOM_CELL_EMPTY && (emptiness == 0 ? most > 15 * 1024 : most <= (16 - emptiness) * 1024) &&
                  (emptiness == 0 || most > (15 - emptiness) * 1024),
              "%d %d %d: %d holds %d", x, y, z, emptiness, most);
    if (z == image->depth)
        return;
    const uint32_t word = (uint32_t)voxel_at(image, x, y, z) | (uint32_t)voxel_at(image, x, y, z + 1) << 16;
    CHECK((uint32_t)m->density[index] == word, "%d %d %d: %08x, not %08x", x, y, z, (uint32_t)m->density[index], word);
}

static float bend_of(const lom_image *image)
{
    int mixed = 0, along = 0;
    for (int z = 0; z < image->depth; z++)
        for (int y = 0; y < image->height; y++)
            for (int x = 0; x < image->width; x++)
                for (int a = 0; a < 3; a++) {
                    const int d[3] = { a == 0, a == 1, a == 2 }, e[3] = { a == 2, a == 0, a == 1 };
                    const int here = voxel_at(image, x, y, z), next = voxel_at(image, x + d[0], y + d[1], z + d[2]);
                    const int other = voxel_at(image, x + e[0], y + e[1], z + e[2]);
                    const int both = voxel_at(image, x + d[0] + e[0], y + d[1] + e[1], z + d[2] + e[2]);
                    const int second = voxel_at(image, x - d[0], y - d[1], z - d[2]) - 2 * here + next;
                    const int cross = here - next - other + both;
                    along = lom_magnitude_int(second) > along ? lom_magnitude_int(second) : along;
                    mixed = lom_magnitude_int(cross) > mixed ? lom_magnitude_int(cross) : mixed;
                }
    return (float)((along + 2.0 * mixed) / 65535.0);
}

static void cells_are_what_voxels_say(void)
{
    static const int sizes[][3] = { { 1, 1, 1 }, { 9, 5, 7 }, { 17, 12, 3 }, { 2, 14, 20 } };
    static const lom_format formats[] = { LOM_FORMAT_R8, LOM_FORMAT_R16, LOM_FORMAT_R32F };
    for (int f = 0; f < 3; f++)
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
            lom_image *image = thin_image(sizes[i][0], sizes[i][1], sizes[i][2], formats[f], 7 * i + (size_t)f);
            lom_medium *medium = lom_create_medium(image, NULL);
            for (int z = 0; z <= image->depth; z++)
                for (int y = 0; y <= image->height; y++)
                    for (int x = 0; x <= image->width; x++)
                        check_cell(image, medium, x, y, z);
            const size_t cells = cell_index(image->width, image->height, 0, 0, image->depth + 1);
            CHECK(medium->emptiness[cells] == 255, "behind the last cell: %d", medium->emptiness[cells]);
            CHECK(medium->bend == bend_of(image), "bend %g, not %g", (double)medium->bend, (double)bend_of(image));
            lom_free_medium(medium);
            lom_free_image(image);
        }
}

int main(int argc, char **argv)
{
    RUN(cells_are_what_voxels_say);
    return check_result();
}
