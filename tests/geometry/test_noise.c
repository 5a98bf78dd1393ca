/* Noise is periodic, bounded and of mean 0, and the pictures made of it have no seam: at their borders neighbours
 * differ no more than inside. */
#include "check.h"

#include "geometry/noise.h"

#include <lom/geometry.h>

static double magnitude(double x)
{
    return x < 0 ? -x : x;
}

static void noise_repeats(void)
{
    lom_noise noise;
    lom_seed_noise(&noise, 5);
    for (int i = 0; i < 2000; i++) {
        double x = 40 * lom_random_uniform(1, (uint64_t)i) - 20, y = 40 * lom_random_uniform(2, (uint64_t)i) - 20;
        double z = 40 * lom_random_uniform(3, (uint64_t)i) - 20;
        double flat = lom_noise2(&noise, x, y, 7), solid = lom_noise3(&noise, x, y, z, 7);
        CHECK(magnitude(flat - lom_noise2(&noise, x + 7, y - 14, 7)) < 1e-9, "at %g %g", x, y);
        CHECK(magnitude(solid - lom_noise3(&noise, x - 7, y + 21, z + 7, 7)) < 1e-9, "at %g %g %g", x, y, z);
        CHECK(magnitude(lom_noise2_grid(&noise, x, y, 5, 3) - lom_noise2_grid(&noise, x + 5, y - 3, 5, 3)) < 1e-9,
              "at %g %g", x, y);
        lom_cell a = lom_cellular2(&noise, x, y, 6, 9), b = lom_cellular2(&noise, x - 6, y + 9, 6, 9);
        CHECK(magnitude(a.nearest - b.nearest) < 1e-9 && a.identity == b.identity, "at %g %g", x, y);
        CHECK(a.nearest <= a.second && a.second < 2.5, "distances %g %g", a.nearest, a.second);
    }
}

static void noise_is_bounded_and_centred(void)
{
    lom_noise noise;
    lom_seed_noise(&noise, 6);
    double sum[2] = { 0 };
    const int count = 40000;
    for (int i = 0; i < count; i++) {
        double x = 256 * lom_random_uniform(1, (uint64_t)i), y = 256 * lom_random_uniform(2, (uint64_t)i);
        double flat = lom_noise2(&noise, x, y, 256), solid = lom_noise3(&noise, x, y, x - y, 256);
        double ridge = lom_ridged2(&noise, x, y, (lom_octaves){ .count = 5, .period = 256, .gain = 0.5 });
        CHECK(magnitude(flat) <= 1 && magnitude(solid) <= 1.1, "noise %g %g", flat, solid);
        CHECK(ridge >= 0 && ridge <= 1, "ridge %g", ridge);
        sum[0] += flat;
        sum[1] += solid;
    }
    CHECK(magnitude(sum[0] / count) < 0.02 && magnitude(sum[1] / count) < 0.02, "means %g %g", sum[0] / count,
          sum[1] / count);
}

static void noise_vanishes_on_its_lattice(void)
{
    lom_noise noise;
    lom_seed_noise(&noise, 7);
    for (int i = -5; i < 300; i += 3)
        CHECK(lom_noise2(&noise, i, 2 * i, 256) == 0 && lom_noise3(&noise, i, 2 * i, -i, 256) == 0, "at %d", i);
}

/* The mean difference between columns (or rows) a and b of a picture. */
static double difference(const lom_image *m, int a, int b, bool rows)
{
    double sum = 0;
    for (int i = 0; i < m->width; i++) {
        const uint8_t *p = lom_image_pixel(m, rows ? i : a, rows ? a : i, 0);
        const uint8_t *q = lom_image_pixel(m, rows ? i : b, rows ? b : i, 0);
        for (int k = 0; k < 3; k++)
            sum += magnitude((double)p[k] - q[k]);
    }
    return sum / (3.0 * m->width);
}

/* Shingles, planks, paint and masonry change at the borders of their boards by design; reeds, needles and windows are
 * not repeated along v. */
static void textures_have_no_seam(void)
{
    static const char *const names[] = { "grass", "forest", "rock", "shore", "snow", "log", "bark", "masonry", "net" };
    for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
        lom_image *m = lom_make_albedo(&(lom_albedo_desc){ .name = names[n], .size = 256, .seed = 9 }, NULL);
        CHECK(m != NULL, "%s", names[n]);
        for (int rows = 0; m != NULL && rows < 2; rows++) {
            double most = 0;
            for (int i = 0; i + 1 < m->width; i++) {
                double inside = difference(m, i, i + 1, rows);
                most = inside > most ? inside : most;
            }
            double seam = difference(m, m->width - 1, 0, rows);
            CHECK(seam <= most * 1.05, "%s: %s differ by %g at the border, at most %g inside", names[n],
                  rows ? "rows" : "columns", seam, most);
        }
        lom_free_image(m);
    }
}

static void every_texture_and_entity_is_made(void)
{
    lom_error error = { 0 };
    for (size_t i = 0; lom_albedo_name(i) != NULL; i++) {
        lom_image *m = lom_make_albedo(&(lom_albedo_desc){ .name = lom_albedo_name(i), .size = 64, .seed = 2 }, &error);
        CHECK(m != NULL, "%s: %s", lom_albedo_name(i), error.text);
        lom_free_image(m);
    }
    for (size_t i = 0; lom_entity_name(i) != NULL; i++) {
        lom_mesh *mesh = lom_make_entity(lom_entity_name(i), 4, &error);
        CHECK(mesh != NULL && mesh->index_count > 30 && mesh->index_count < 40000, "%s: %s", lom_entity_name(i),
              error.text);
        for (size_t k = 0; mesh != NULL && k < mesh->vertex_count; k++) {
            const float *n = mesh->vertices[k].normal;
            double square = (double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2];
            CHECK(square > 0.97 && square < 1.03, "%s: the normal of vertex %zu is %g long", lom_entity_name(i), k,
                  square);
        }
        for (size_t k = 0; mesh != NULL && k < mesh->material_count; k++) {
            const lom_material *m = &mesh->materials[k];
            float light = m->diffuse[0] + m->diffuse[1] + m->diffuse[2] + m->emissive[0];
            CHECK(m->diffuse_map[0] != '\0' || light > 0, "%s: material %zu has neither texture nor colour",
                  lom_entity_name(i), k);
        }
        lom_free_mesh(mesh);
    }
    CHECK(lom_make_entity("castle", 1, &error) == NULL && error.code == LOM_ERROR_USAGE, "%s", error.text);
}

/* A lake in the middle, land around it, the summit white, the deepest bed black. */
static void height_map_is_a_lake_among_mountains(void)
{
    lom_image *m = lom_make_height_map(&(lom_height_map_desc){ .size = 256, .seed = 3 }, NULL);
    CHECK(m != NULL && m->format == LOM_FORMAT_R16, "no map");
    if (m == NULL)
        return;
    const uint16_t level = 4096; /* 1/16 */
    unsigned lowest = 65535, highest = 0, wet = 0, border = 0;
    for (int y = 0; y < 256; y++)
        for (int x = 0; x < 256; x++) {
            unsigned h = *(const uint16_t *)lom_image_pixel(m, x, y, 0);
            lowest = h < lowest ? h : lowest;
            highest = h > highest ? h : highest;
            wet += h < level;
            border += (x == 0 || y == 0 || x == 255 || y == 255) && h < level;
        }
    CHECK(lowest == 0 && highest == 65535, "from %u to %u", lowest, highest);
    CHECK(wet > 65536 / 20 && wet < 65536 / 2 && border == 0, "%u pixels of water, %u at the border", wet, border);
    CHECK(*(const uint16_t *)lom_image_pixel(m, 128, 140, 0) < level, "no lake in the middle");
    lom_free_image(m);
    lom_error error = { 0 };
    CHECK(lom_make_height_map(&(lom_height_map_desc){ .size = 100 }, &error) == NULL && error.code == LOM_ERROR_USAGE,
          "%s", error.text);
}

int main(int argc, char **argv)
{
    RUN(noise_repeats);
    RUN(noise_is_bounded_and_centred);
    RUN(noise_vanishes_on_its_lattice);
    RUN(textures_have_no_seam);
    RUN(every_texture_and_entity_is_made);
    RUN(height_map_is_a_lake_among_mountains);
    return check_result();
}
