/* Shaders of the self-test. In: strips made from vertex numbers, and a mesh; out: colours that use every group of lane
 * functions and every kind of texture. Invariant: finite input, so that nothing but defined values is stored. */
#include "measure/selftest.h"

enum { WORLD = 0, NORMAL = 3, UV = 6, COLOR = 8, SHADE = 11, VARYINGS = 12 };
enum { X, Y, STRIP_VARYINGS };

static void strip_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_selftest_uniforms *u = uniforms;
    lom_float x = lom_to_float((in->vertex & 1) * 2 - 1), y = lom_to_float((in->vertex >> 1) * 2 - 1);
    out->position = (lom_float4){ x, y, lom_splat(u->depth), lom_splat(1) };
    out->varying[X] = x;
    out->varying[Y] = y;
}

static void functions_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    lom_float a = (in->x - 32.0f) * 0.2371f + (in->y - 24.0f) * 0.031f, b = in->y * 0.173f - 3.1f;
    lom_float positive = lom_abs(a) + 0.001f, small = lom_fraction(a) * 2.0f - 1.0f;
    (void)uniforms;
    out->color[0] = (lom_float4){ lom_sin(a * 9.0f), lom_cos(a * 9.0f), lom_tan(a), lom_exp(a) };
    out->color[1] = (lom_float4){ lom_exp2(a), lom_log(positive), lom_log2(positive), lom_expm1(a) };
    out->color[2] = (lom_float4){ lom_tanh(a), lom_atan(a), lom_atan2(a, b), lom_pow(positive, b) };
    out->color[3] = (lom_float4){ lom_asin(small), lom_acos(small), lom_sqrt(positive), lom_round(a) / b };
}

static void textured_vertex(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    const struct lom_selftest_uniforms *u = uniforms;
    lom_float aside = lom_to_float(in->instance) * 1.7f;
    lom_float3 p = { in->attribute[0].x + aside, in->attribute[0].y, in->attribute[0].z - aside };
    out->position = lom_transform4(&u->clip_from_world, p);
    for (int i = 0; i < 2; i++)
        out->distance[i] = lom_transform_row(u->plane[i], p);
    out->varying[WORLD] = p.x;
    out->varying[WORLD + 1] = p.y;
    out->varying[WORLD + 2] = p.z;
    out->varying[NORMAL] = in->attribute[1].x;
    out->varying[NORMAL + 1] = in->attribute[1].y;
    out->varying[NORMAL + 2] = in->attribute[1].z;
    out->varying[UV] = in->attribute[2].x * 6.0f;
    out->varying[UV + 1] = in->attribute[2].y * 3.0f;
    out->varying[COLOR] = in->attribute[3].x;
    out->varying[COLOR + 1] = in->attribute[3].y;
    out->varying[COLOR + 2] = in->attribute[3].z;
    out->varying[SHADE] = lom_to_float(in->vertex & 7) * 0.125f;
}

static lom_float3 lit(const lom_varyings *in, const struct lom_selftest_uniforms *u)
{
    lom_float3 normal =
        lom_normalize3((lom_float3){ in->varying[NORMAL], in->varying[NORMAL + 1], in->varying[NORMAL + 2] });
    lom_float3 to_eye =
        lom_normalize3((lom_float3){ -in->varying[WORLD], -in->varying[WORLD + 1], -in->varying[WORLD + 2] });
    lom_float shine = lom_phong_specular(&u->light, normal, to_eye, 13.5f);
    lom_float4 texel =
        lom_sample(u->texture, in->varying[UV], in->varying[UV + 1], lom_lod(u->texture, in, UV, UV + 1));
    lom_float light = lom_lambert(&u->light, normal) + 0.2f;
    return (lom_float3){ texel.x * light * in->varying[COLOR] + shine, texel.y * light * in->varying[COLOR + 1] + shine,
                         texel.z * light * in->varying[COLOR + 2] + shine };
}

static void textured_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    lom_float3 color = lit(in, uniforms);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(1.0f) };
}

static void cut_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    lom_float3 color = lit(in, uniforms);
    lom_float alpha = lom_smoothstep(lom_splat(-1.0f), lom_splat(1.0f), in->varying[WORLD + 1]);
    out->discard = lom_fraction(in->varying[UV] + in->varying[UV + 1]) < 0.3f;
    out->color[0] = (lom_float4){ color.x, color.y, color.z, alpha };
    out->color[1] = (lom_float4){ in->varying[SHADE], lom_select(in->front, in->w, -in->w), in->z, alpha };
}

static void samples_fragment(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct lom_selftest_uniforms *u = uniforms;
    lom_float s = in->varying[X] * 1.7f, t = in->varying[Y] * 1.3f;
    lom_float swirl = lom_sin(s * 3.0f) * t;
    lom_float lod = lom_log2(lom_abs(lom_quad_dx(swirl)) + lom_abs(lom_quad_dy(swirl)) + 0.01f) + 5.0f;
    lom_float3 direction = { s, t, lom_cos(s + t) };
    out->color[0] = lom_sample_cube(u->cube, direction, lod - 2.0f);
    out->color[1] = lom_sample_3d(u->volume, s, t, swirl, lod - 3.0f);
    out->color[2] = lom_sample(u->texture, s, swirl, lod);
    out->depth = lom_saturate(0.5f + 0.5f * lom_sin(s + t));
}

LOM_SHADER(lom_selftest_functions, strip_vertex, functions_fragment, .varyings = STRIP_VARYINGS, .reads_position = true,
           .colors = 4, .uniforms_size = sizeof(struct lom_selftest_uniforms))
LOM_SHADER(lom_selftest_textured, textured_vertex, textured_fragment, .attributes = 4, .varyings = VARYINGS,
           .reads = LOM_VARYINGS(0, SHADE), .differentiates = LOM_VARYINGS(UV, 2), .colors = 1,
           .uniforms_size = sizeof(struct lom_selftest_uniforms))
LOM_SHADER(lom_selftest_cut, textured_vertex, cut_fragment, .attributes = 4, .varyings = VARYINGS, .clip_distances = 2,
           .reads = LOM_VARYINGS(0, VARYINGS), .differentiates = LOM_VARYINGS(UV, 2), .flat = 1u << SHADE,
           .reads_position = true, .discards = true, .colors = 2, .uniforms_size = sizeof(struct lom_selftest_uniforms))
LOM_SHADER(lom_selftest_samples, strip_vertex, samples_fragment, .varyings = STRIP_VARYINGS,
           .reads = LOM_VARYINGS(X, 2), .writes_depth = true, .quads = true, .colors = 3,
           .uniforms_size = sizeof(struct lom_selftest_uniforms))
