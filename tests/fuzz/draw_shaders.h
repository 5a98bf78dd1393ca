/* The shaders of fuzz_draw and its stages behind the vertices: levels, places and numbers of vertices as wild as the
 * attributes. */
#ifndef LOM_TESTS_FUZZ_DRAW_SHADERS_H
#define LOM_TESTS_FUZZ_DRAW_SHADERS_H

#include <lom/stages.h>

struct uniforms {
    const lom_texture *texture;
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    out->point_size = in->attribute[1].x;
    const lom_float four[4] = { in->attribute[1].x, in->attribute[1].y, in->attribute[1].z, in->attribute[1].w };
    for (int i = 0; i < 4; i++) {
        out->varying[i] = four[i];
        out->distance[i] = four[i] - lom_splat(0.25f);
    }
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->varying[0], in->varying[1], in->varying[2], in->varying[3] };
}

static void two_sources(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    show(out, in, uniforms);
    out->color[1] = (lom_float4){ in->varying[3], in->varying[2] * 0.5f, in->varying[1], in->varying[0] };
}

static void lookup(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct uniforms *u = uniforms;
    lom_float lod = lom_lod(u->texture, in, 0, 1);
    out->color[0] = lom_sample(u->texture, in->varying[0], in->varying[1], lod);
    out->color[1] = lom_fetch(u->texture, lom_to_int(in->varying[2]), lom_to_int(in->varying[3]), 1);
}

static void everything(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    lom_float slope = lom_quad_dx(in->varying[0]) + lom_quad_dy(in->varying[1]);
    out->color[0] = (lom_float4){ in->x, in->y, in->w, slope };
    out->color[1] = (lom_float4){ in->z, lom_dx(in, 1), lom_dy(in, 1), in->varying[3] };
    out->depth = in->varying[2];
    out->discard = in->varying[3] > lom_splat(0.9f);
}

/* The axes are the varyings' numbers, so that they are as wild as the positions. */
static void place_sprite(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    place(out, in, uniforms);
    out->axis[0] = (lom_float4){ in->attribute[1].x, in->attribute[1].y, lom_splat(0), lom_splat(0) };
    out->axis[1] = (lom_float4){ in->attribute[1].z, in->attribute[1].w, in->attribute[0].z, in->attribute[0].w };
}

static void show_sprite(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->st[0], in->st[1], in->varying[2], in->x };
    out->discard = in->st[0] > lom_splat(0.75f);
}

static void show_depth_behind(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)uniforms;
    out->color[0] = (lom_float4){ in->target_depth, in->z, in->varying[1], in->varying[3] };
}

LOM_DEPTH_SHADER(fuzz_depth, place, .attributes = 2, .varyings = 4)
LOM_SHADER(fuzz_show, place, show, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .flat = 1u << 3,
           .colors = 1)
LOM_SHADER(fuzz_clipped, place, show, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .clip_distances = 2,
           .cull_distances = 2, .colors = 1)
LOM_SHADER(fuzz_lookup, place, lookup, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .differentiates = LOM_VARYINGS(0, 2), .colors = 2, .uniforms_size = sizeof(struct uniforms))
LOM_SHADER(fuzz_everything, place, everything, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .differentiates = 1u << 1, .reads_position = true, .discards = true, .writes_depth = true, .quads = true,
           .colors = 2)
/* Two colours: of two attachments, or the two sources of one. */
LOM_SHADER(fuzz_two, place, two_sources, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4), .colors = 2)
LOM_SHADER(fuzz_sprite, place_sprite, show_sprite, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .reads_position = true, .clip_distances = 1, .cull_distances = 1, .discards = true, .colors = 1,
           .sprites = true)
LOM_SHADER(fuzz_soft, place_sprite, show_depth_behind, .attributes = 2, .varyings = 4, .reads = LOM_VARYINGS(0, 4),
           .reads_position = true, .colors = 1, .sprites = true, .round = true, .reads_depth = true)

/* ---- stages behind the vertices ---- */

static void levels_of_points(lom_levels *out, const lom_patch *in, const void *uniforms)
{
    (void)uniforms;
    for (int i = 0; i < 4; i++)
        out->outer[i] = in->point[i % in->points].varying[i] * 9.0f;
    out->inner[0] = in->point[0].varying[1] * 9.0f;
    out->inner[1] = in->point[in->points - 1].position.x;
}

static void mix_points(lom_vertex *out, const lom_domain_point *in, const void *uniforms)
{
    (void)uniforms;
    const lom_vertex *a = &in->patch.point[0], *b = &in->patch.point[in->patch.points - 1];
    out->position = (lom_float4){ a->position.x + in->u * b->position.x, a->position.y + in->v * b->position.y,
                                  a->position.z + in->w, a->position.w };
    for (int i = 0; i < 4; i++) {
        out->varying[i] = a->varying[i] * in->u + in->levels.inner[0];
        out->distance[i] = in->v - lom_splat(0.25f);
    }
    out->point_size = b->varying[0];
}

static void scatter(lom_primitive_stream *out, const lom_geometry_input *in, const void *uniforms)
{
    (void)uniforms;
    for (int i = 0; i < 9; i++) {
        lom_vertex v = in->vertex[0];
        v.position.x += lom_splat((float)(i % 3) * 0.2f);
        v.position.y += lom_splat((float)(i / 3) * 0.2f);
        lom_emit_vertex(out, &v, v.varying[0] * 9.0f > (float)i);
        lom_end_strip(out, (in->number + i) % 4 == 0);
    }
}

LOM_TESSELLATION(fuzz_patches, levels_of_points, mix_points, .most = 9)
LOM_GEOMETRY(fuzz_scatter, scatter, .in = LOM_TRIANGLES, .out = LOM_TRIANGLE_STRIP, .vertices = 7)

struct behind {
    lom_tessellation tessellation;
    lom_geometry geometry;
    lom_feedback feedback;
};

static const lom_shader *const shaders[] = { &fuzz_show,   &fuzz_depth,      &fuzz_clipped,
                                             &fuzz_lookup, &fuzz_everything, &fuzz_two };
enum { SHADERS = sizeof shaders / sizeof *shaders };

#endif
