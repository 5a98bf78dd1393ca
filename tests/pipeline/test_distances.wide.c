/* Proves clip and cull distances at this width (T13..T17), by the oracle of clipping.h. */
#include "clipping.h"

/* T13: each of 1 to 8 distances crosses; coverage is the intersection of the half planes. */
static void distances_intersect(void)
{
    stage s = open_counting();
    int64_t open = 0;
    for (int round = 0; round < 300; round++) {
        int planes = round % 8 + 1;
        for (size_t k = 0; k < 3; k++) {
            float w = random_float(0.5f, 2.0f);
            put(k, random_float(-1.5f, 1.5f) * w, random_float(-1.5f, 1.5f) * w, 0.5f * w, w);
            for (int i = 0; i < planes; i++)
                vertices[k].distance[i] = random_float(-0.4f, 1.0f);
        }
        open += compare_triangle(&s, &clipped, 8, "distances", round);
    }
    CHECK(open < 300 * SIZE * SIZE / 50, "%lld pixels left open", (long long)open);
    close_stage(&s);
}

/* T13 with the clip volume: distances of triangles that near, far and the guard band cut as well. */
static void distances_intersect_the_clip_volume(void)
{
    stage s = open_counting();
    for (int round = 0; round < 200; round++) {
        float r = round % 2 ? 3.0f : 1000.0f;
        for (size_t k = 0; k < 3; k++) {
            put(k, random_float(-r, r), random_float(-r, r), random_float(-0.2f, 1.2f), random_float(0.2f, 1.5f));
            for (int i = 0; i < 3; i++)
                vertices[k].distance[i] = random_float(-0.4f, 1.0f);
        }
        compare_triangle(&s, &clipped, 8, "both", round);
    }
    close_stage(&s);
}

static size_t make_mesh(int n, int planes, int kind)
{
    vertex grid[17][17];
    size_t count = 0;
    for (int j = 0; j <= n; j++)
        for (int i = 0; i <= n; i++) {
            bool inner = i > 0 && j > 0 && i < n && j < n;
            float wobble = inner ? 0.25f : 0.0f, w = random_float(0.25f, 4.0f);
            float x = ((float)i + random_float(-wobble, wobble)) * 2.2f / (float)n - 1.1f;
            float y = ((float)j + random_float(-wobble, wobble)) * 2.2f / (float)n - 1.1f;
            put(0, x * w, y * w, 0.5f * w, w);
            for (int p = 0; p < planes; p++) {
                float d = random_float(-1, 1);
                if (kind == 1) /* T14: exactly on the plane at many vertices */
                    d = (float)random_whole(-1, 1);
                if (kind == 2) /* so small that the products with 1/w vanish */
                    d = (float)random_whole(-3, 3) * 0x1p-149f;
                if (kind == 3)
                    d = d * 0x1p120f;
                vertices[0].distance[p] = d;
            }
            grid[j][i] = vertices[0];
        }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const vertex *quad[] = { &grid[j][i],     &grid[j + 1][i], &grid[j][i + 1],
                                     &grid[j][i + 1], &grid[j + 1][i], &grid[j + 1][i + 1] };
            for (int k = 0; k < 6; k++)
                vertices[count++] = *quad[k];
        }
    return count / 3;
}

/* A triangle whose vertices all lie in a plane is kept by d and by -d (T14 exempts it): move it off the plane. */
static void leave_planes(size_t triangles, int planes)
{
    for (size_t t = 0; t < triangles; t++)
        for (int p = 0; p < planes; p++) {
            vertex *v = &vertices[3 * t];
            if (v[0].distance[p] == 0 && v[1].distance[p] == 0 && v[2].distance[p] == 0)
                v[0].distance[p] = v[1].distance[p] = v[2].distance[p] = 1;
        }
}

/* T15: for 1 to 8 planes, all combinations of signs share the pixels of a mesh exactly. */
static void all_signs_of_distances_share_every_pixel(void)
{
    stage s = open_counting();
    for (int kind = 0; kind < 4; kind++)
        for (int planes = 1; planes <= 8; planes++) {
            size_t triangles = make_mesh(6, planes, kind);
            leave_planes(triangles, planes);
            begin(&s, (lom_pass_desc){ 0 });
            for (int signs = 0; signs < 1 << planes; signs++) {
                float sign[8];
                for (int i = 0; i < 8; i++)
                    sign[i] = i < planes && (signs >> i & 1) ? -1.0f : 1.0f;
                draw_counting(&s, &clipped, sign, triangles);
            }
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++)
                CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == 1, "kind %d, %d planes: pixel %d,%d has %d hits", kind,
                      planes, p % SIZE, p / SIZE, bytes_at(&s, p % SIZE, p / SIZE)[0]);
        }
    close_stage(&s);
}

/* T14, T16: distances of 0 keep, of NaN drop the triangle, infinite ones clip like huge ones. */
static void special_distances(void)
{
    const float nan = __builtin_nanf(""), inf = __builtin_inff();
    static const int whole = -1;
    const struct {
        float d[3];
        int hits; /* of every pixel; -1: between none and all */
    } table[] = { { { 0, 0, 0 }, 1 },          { { -0.0f, -0.0f, -0.0f }, 1 }, { { 0, 0, 1 }, 1 },
                  { { 0, 1, 1 }, 1 },          { { nan, 1, 1 }, 0 },           { { 1, 1, -nan }, 0 },
                  { { inf, inf, inf }, 1 },    { { inf, 1, 0 }, 1 },           { { -inf, -inf, -1 }, 0 },
                  { { -inf, inf, 1 }, whole }, { { 1, -inf, 1 }, whole } };
    stage s = open_counting();
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        for (int rotation = 0; rotation < 3; rotation++) {
            int total = 0;
            put(0, -1, -1, 0.5f, 1);
            put(1, 3, -1, 0.5f, 1);
            put(2, -1, 3, 0.5f, 1);
            for (int k = 0; k < 3; k++)
                vertices[k].distance[rotation] = table[i].d[(k + rotation) % 3];
            begin(&s, (lom_pass_desc){ 0 });
            draw_counting(&s, &clipped, plus, 1);
            finish(&s);
            for (int p = 0; p < SIZE * SIZE; p++) {
                int hits = bytes_at(&s, p % SIZE, p / SIZE)[0];
                total += hits;
                CHECK(table[i].hits < 0 || hits == table[i].hits, "case %zu: %d hits", i, hits);
            }
            CHECK(table[i].hits >= 0 || total < SIZE * SIZE, "case %zu: all pixels kept", i);
        }
    close_stage(&s);
}

/* A triangle goes when one cull distance is negative at all three vertices; otherwise all of it stays. */
static void cull_distances_drop_whole_triangles(void)
{
    stage s = open_counting();
    for (int round = 0; round < 64; round++) {
        size_t plane = (size_t)(round / 8);
        put(0, -1, -1, 0.5f, 1);
        put(1, 3, -1, 0.5f, 1);
        put(2, -1, 3, 0.5f, 1);
        for (int k = 0; k < 3; k++)
            vertices[k].distance[plane] = round >> k & 1 ? -0.5f : 0.0f;
        begin(&s, (lom_pass_desc){ 0 });
        draw_counting(&s, &culled, plus, 1);
        finish(&s);
        for (int p = 0; p < SIZE * SIZE; p++)
            CHECK(bytes_at(&s, p % SIZE, p / SIZE)[0] == (round % 8 != 7), "round %d", round);
    }
    close_stage(&s);
}

int main(int argc, char **argv)
{
    RUN(distances_intersect);
    RUN(distances_intersect_the_clip_volume);
    RUN(all_signs_of_distances_share_every_pixel);
    RUN(special_distances);
    RUN(cull_distances_drop_whole_triangles);
    return check_result();
}
