/* Proves that clusters which a draw leaves out have no pixel: a mesh seen from random places inside and around it, by
 * both ranges of depth, mirrored, cut by a clip distance, by scissors, viewports and crops, ends with the same bytes
 * with its clusters and without, whatever the order of its triangles; that a good part of it is left out; and that
 * clusters of something else are an error. */
#include "stage.h"

#include <lom/geometry.h>

enum { WIDTH = 160, HEIGHT = 100, QUADS = 48, CORNERS = 6 * QUADS * QUADS, POINTS = (QUADS + 1) * (QUADS + 1) };

typedef struct view {
    lom_matrix_uniform clip_from_position;
    float distance[4];
} view;

static void project(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const view *v = uniforms;
    lom_float3 p = { in->attribute[0].x, in->attribute[0].y, in->attribute[0].z };
    out->position = lom_transform4(&v->clip_from_position, p);
    out->varying[0] = p.x;
    out->varying[1] = p.z;
    out->distance[0] = lom_transform_row(v->distance, p);
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_fraction(in->varying[0]), lom_fraction(in->varying[1]), in->z, lom_splat(1) };
}

LOM_SHADER(cut, project, show, .attributes = 1, .varyings = 2, .clip_distances = 1, .reads = LOM_VARYINGS(0, 2),
           .reads_position = true, .colors = 1, .uniforms_size = sizeof(view))
LOM_SHADER(uncut, project, show, .attributes = 1, .varyings = 2, .reads = LOM_VARYINGS(0, 2), .reads_position = true,
           .colors = 1, .uniforms_size = sizeof(view))

static float points[POINTS][3];
static uint32_t indices[CORNERS];

static const lom_attribute positions = { points, sizeof points, sizeof points[0], LOM_ATTRIBUTE_FLOAT3 };

/* Hills of 20 x 20; shuffled: quads in any order, so that clusters lie all over it. */
static void make_hills(bool shuffled)
{
    for (int i = 0; i < POINTS; i++) {
        points[i][0] = (float)(i % (QUADS + 1)) * 20 / QUADS - 10;
        points[i][1] = random_float(0, 1);
        points[i][2] = (float)(i / (QUADS + 1)) * 20 / QUADS - 10;
    }
    for (uint32_t q = 0; q < QUADS * QUADS; q++) {
        uint32_t at = shuffled ? q * 1001 % (QUADS * QUADS) : q;
        uint32_t a = at / QUADS * (QUADS + 1) + at % QUADS, c = a + QUADS + 1;
        const uint32_t quad[6] = { a, c, a + 1, a + 1, c, c + 1 };
        memcpy(indices + 6 * q, quad, sizeof quad);
    }
}

/* From a place in or near the hills, in any direction. */
static view look_around(int kind)
{
    lom_vec3 eye = { random_float(-12, 12), random_float(-1, 4), random_float(-12, 12) };
    lom_vec3 target = { random_float(-12, 12), random_float(-2, 2), random_float(-12, 12) };
    double angle = (double)random_float(0.3f, 2);
    lom_mat4 from_world = lom_look_at(eye, target, (lom_vec3){ 0, 1, 0 });
    lom_mat4 projection =
        kind % 2 == 0 ? lom_perspective(angle, 1.6, 0.1) : lom_perspective_gl(angle, 1.6, 0.1, random_float(3, 30));
    if (kind % 3 == 2) {
        lom_mat4 mirror = lom_mirror((lom_vec3){ 0, 1, 0 }, 0.2);
        from_world = lom_multiply(&from_world, &mirror);
    }
    lom_mat4 all = lom_multiply(&projection, &from_world);
    view v = { .clip_from_position = lom_round_matrix(&all), .distance = { 0 } };
    if (kind % 4 == 1)
        v = (view){ v.clip_from_position, { random_float(-1, 1), random_float(-1, 1), random_float(-1, 1), 0.5f } };
    return v;
}

static lom_pass_desc pass_of(int kind)
{
    lom_pass_desc pass = { .clip_range = kind % 2 == 0 ? LOM_CLIP_ZERO_TO_W : LOM_CLIP_MINUS_W_TO_W,
                           .clear_depth = kind % 2 == 0 ? 0 : 1 };
    if (kind % 5 == 1 && kind % 2 == 0) /* else the draw has it */
        pass.viewport = (lom_rect){ 30, 20, 90, 50 };
    if (kind % 5 == 2)
        pass.scissor = (lom_rect){ 40, 10, 50, 70 };
    if (kind % 5 == 3) {
        pass.frame_width = 3 * WIDTH;
        pass.frame_height = 2 * HEIGHT;
        pass.origin_x = WIDTH + 7;
        pass.origin_y = 31;
    }
    return pass;
}

static uint64_t draw_hills(stage *s, int kind, const view *v, const lom_clusters *clusters)
{
    lom_counters before = lom_device_counters(s->device);
    lom_draw_desc draw = { .shader = kind % 4 == 1 ? &cut : &uncut,
                           .uniforms = v,
                           .attribute = { positions },
                           .indices = indices,
                           .count = CORNERS,
                           .depth_compare = kind % 2 == 0 ? LOM_COMPARE_GREATER : LOM_COMPARE_LESS,
                           .culling = { .clusters = clusters, .clip_from_position = v->clip_from_position } };
    if (kind % 5 == 1 && kind % 2 == 1)
        draw.viewport = (lom_rect){ 30, 20, 90, 50 };
    memcpy(draw.culling.distance, v->distance, sizeof v->distance);
    begin(s, pass_of(kind));
    lom_draw(s->device, &draw);
    finish(s);
    return lom_device_counters(s->device).triangles - before.triangles;
}

static void what_is_left_out_has_no_pixel(void)
{
    enum { KINDS = 120 };
    lom_device_desc desc = { .threads = 2, .chunk = 512, .batch = 4 };
    stage all = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    stage seen = open_stage(desc, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_DEPTH32F);
    for (int shuffled = 0; shuffled < 2; shuffled++) {
        make_hills(shuffled != 0);
        lom_error error = { 0 };
        lom_clusters *clusters = lom_create_clusters(&positions, indices, CORNERS, &error);
        CHECK(clusters != NULL, "%s", error.text);
        uint64_t drawn[2] = { 0, 0 };
        for (int kind = 0; kind < KINDS; kind++) {
            view v = look_around(kind);
            drawn[0] += draw_hills(&all, kind, &v, NULL);
            drawn[1] += draw_hills(&seen, kind, &v, clusters);
            CHECK(same_images(all.image, seen.image) && same_images(all.depths, seen.depths), "view %d, shuffled %d",
                  kind, shuffled);
        }
        CHECK(shuffled != 0 || drawn[1] * 4 < drawn[0] * 3, "%llu of %llu triangles", (unsigned long long)drawn[1],
              (unsigned long long)drawn[0]);
        lom_free_clusters(clusters);
    }
    close_stage(&all);
    close_stage(&seen);
}

static void clusters_of_something_else_are_an_error(void)
{
    lom_error error = { 0 };
    make_hills(false);
    lom_attribute few = positions;
    few.size -= 1;
    CHECK(lom_create_clusters(&few, indices, CORNERS, &error) == NULL && error.code == LOM_ERROR_USAGE);
    CHECK(lom_create_clusters(&positions, indices, CORNERS - 1, &error) == NULL);
    CHECK(lom_create_clusters(NULL, indices, CORNERS, &error) == NULL);
    lom_clusters *clusters = lom_create_clusters(&positions, indices, CORNERS, NULL);
    view v = look_around(0);
    for (int i = 0; i < 3; i++) {
        stage s = open_stage((lom_device_desc){ .threads = 1 }, WIDTH, HEIGHT, LOM_FORMAT_RGBA8, LOM_FORMAT_NONE);
        lom_draw_desc draw = { .shader = &uncut,
                               .uniforms = &v,
                               .attribute = { positions },
                               .indices = indices,
                               .count = i == 0 ? CORNERS - 3 : CORNERS,
                               .instances = i == 1 ? 2 : 1,
                               .vertex_count = i == 2 ? POINTS - 1 : 0,
                               .culling = { .clusters = clusters } };
        begin(&s, (lom_pass_desc){ .clear_depth = 0 });
        lom_draw(s.device, &draw);
        CHECK(!lom_end_pass(s.device) && lom_device_error(s.device)->code == LOM_ERROR_USAGE, "draw %d", i);
        close_stage(&s);
    }
    lom_free_clusters(clusters);
    lom_free_clusters(NULL);
}

int main(int argc, char **argv)
{
    RUN(what_is_left_out_has_no_pixel);
    RUN(clusters_of_something_else_are_an_error);
    return check_result();
}
