/* Proves of shaders, where a scene seldom leads them, that what they give a fragment does not depend on the others of its
 * packet: plates of impostors with colour and no opacity, edges beside infinities, blurs of denormals, ground without a
 * normal, places beside the maps of shadows. Each fails with what decides for a whole packet alone. */
#include "neighbours.h"

#include "cloud/cloud_uniforms.h"
#include "image/texture.h"
#include "lanes/variants.h"
#include "render/ground/shaders.h"
#include "shading/smooth_edges.h"
#include "shading/sun_shadow.h"
#include "water/picture_rays.h"

enum { SIDE = 16, PACKETS = 400 };

static lom_error error;

/* A texture of floats that are taken from the list at random, whatever floats they are. */
static lom_texture *random_texture(lom_format format, const float *list, size_t count, uint64_t key)
{
    lom_texture *texture = lom_create_texture(
        &(lom_texture_desc){
            .width = SIDE,
            .height = SIDE,
            .format = format,
            .sampler = { .minify = LOM_FILTER_NEAREST, .magnify = LOM_FILTER_NEAREST, .wrap_s = LOM_WRAP_CLAMP } },
        &error);
    CHECK(texture != NULL, "%s", error.text);
    for (size_t i = 0; texture != NULL && i < texture->texel_count * lom_texel_size(texture) / 4; i++)
        ((float *)texture->texels)[i] = list[lom_random_bits(key, i) % count];
    return texture;
}

static void run_shader(const lom_shader *shader, const lom_varyings *in, const void *uniforms, lom_float *out)
{
    lom_fragment fragment;
    memset(&fragment, 0, sizeof fragment);
    shader->fragment[lom_find_variant(LOM_LANES, false)](&fragment, in, uniforms);
    memcpy(out, &fragment.color[0], sizeof fragment.color[0]);
}

/* Pixel centres of the textures, and more inputs from 0 to `most`. */
static void try_function(const char *name, lane_function *function, const void *context, int inputs, float most)
{
    const struct lane_case c = { name, function, context, inputs, 4 };
    for (uint64_t n = 0; n < PACKETS; n++) {
        lom_float in[MOST_LANE_INPUTS];
        for (int k = 0; k < inputs; k++)
            for (int i = 0; i < LOM_LANES; i++) {
                const double unit = lom_random_uniform(n, (uint64_t)(k * LOM_LANES + i));
                in[k][i] = k < 2 ? (float)(int)(unit * SIDE) + 0.5f : (float)unit * most;
                if (k >= 2 && unit < 0.5)
                    in[k][i] = 0;
            }
        expect_lanes_alone(&c, in, n);
    }
}

/* ---- impostors ---- */

static void call_impostor(const void *context, const lom_float *in, lom_float *out)
{
    lom_varyings v;
    memset(&v, 0, sizeof v);
    v.x = in[0];
    v.y = in[1];
    v.w = lom_splat(1);
    v.covered = lom_splat_int(-1);
    v.varying[2] = lom_splat(-1); /* the offset from the eye */
    v.varying[3] = in[0] / (float)SIDE;
    v.varying[4] = in[1] / (float)SIDE;
    run_shader(&lom_impostor_shader, &v, context, out);
}

static void plates_with_colour_and_no_opacity(void)
{
    static const float texels[] = { 0, 0.5f, 0, 0.25f, 1 }, depths[] = { 0, 0.5f, 2 };
    struct lom_impostor_uniforms u;
    memset(&u, 0, sizeof u);
    lom_texture *plate = random_texture(LOM_FORMAT_RGBA32F, texels, 5, 1);
    lom_texture *depth = random_texture(LOM_FORMAT_R32F, depths, 3, 2);
    u.plate = plate;
    u.cloud.depth = depth;
    u.cloud.eye = (struct lom_eye_uniform){ .near_plane = 1, .pixel = 0.01f, .far_reach = 100, .depth_reach = 100 };
    u.misting = 0.75f;
    if (plate != NULL && depth != NULL)
        try_function("an impostor", call_impostor, &u, 2, 0);
    lom_free_texture(plate);
    lom_free_texture(depth);
}

/* ---- smooth edges ---- */

static void call_smooth(const void *context, const lom_float *in, lom_float *out)
{
    lom_varyings v;
    memset(&v, 0, sizeof v);
    v.x = in[0];
    v.y = in[1];
    v.covered = lom_splat_int(-1);
    run_shader(&lom_smooth_shader, &v, context, out);
}

static void edges_beside_infinities(void)
{
    static const float colors[] = { 1, 0.5f, 1 / 0.0f, -0.0f, -1 / 0.0f, 3e38f, 0.1f },
                       depths[] = { 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.1f }, ends[] = { 0.2f, 0.4f, 1 };
    lom_texture *color = random_texture(LOM_FORMAT_RGBA32F, colors, 7, 3);
    lom_texture *depth = random_texture(LOM_FORMAT_R32F, depths, 9, 4);
    lom_texture *edges = random_texture(LOM_FORMAT_RGBA32F, ends, 3, 5);
    const struct lom_smooth_uniforms u = { .color = color, .edges = edges, .depth = depth };
    if (color != NULL && depth != NULL && edges != NULL)
        try_function("smooth edges", call_smooth, &u, 2, 0);
    lom_free_texture(color);
    lom_free_texture(depth);
    lom_free_texture(edges);
}

/* ---- blurs ---- */

static void call_blurred(const void *context, const lom_float *in, lom_float *out)
{
    const struct lom_surface_uniforms *u = context;
    const struct lom_hit hit = { .s = in[0] / (float)SIDE, .t = in[1] / (float)SIDE };
    const struct lom_blur blur = { .width = lom_splat(1), .apart = in[2] };
    const lom_float4 color = lom_blurred(u, &u->mirrored, hit, blur);
    memcpy(out, &color, sizeof color);
}

static void blurs_of_denormals(void)
{
    static const float colors[] = { 0x1p-149f, 0x1p-148f, 0x1.8p-147f, 1, -0x1p-149f };
    static struct lom_surface_uniforms u;
    lom_texture *color = random_texture(LOM_FORMAT_RGBA32F, colors, 5, 6);
    u.pixel[0] = u.pixel[1] = 1.0f / SIDE;
    u.mirrored.color = color;
    if (color != NULL)
        try_function("a blur", call_blurred, &u, 3, 2);
    lom_free_texture(color);
}

/* ---- ground ---- */

static void call_ground(const void *context, const lom_float *in, lom_float *out)
{
    lom_varyings v;
    memset(&v, 0, sizeof v);
    v.covered = lom_splat_int(-1);
    v.varying[0] = in[0] / (float)SIDE;
    v.varying[2] = in[1] / (float)SIDE;
    run_shader(&lom_terrain_albedo, &v, context, out);
}

static void ground_without_a_normal(void)
{
    static const float normals[] = { 0, 0, 1, -1 }, colors[] = { 1, 0.5f, 0.25f };
    static struct lom_terrain_uniforms u;
    lom_texture *normal = random_texture(LOM_FORMAT_RGBA32F, normals, 4, 7);
    lom_texture *color = random_texture(LOM_FORMAT_RGBA32F, colors, 3, 8);
    u.vertex_texture = normal;
    u.vertex_scale[0] = u.vertex_scale[1] = 1;
    u.layer_count = 1;
    u.layer[0] = (struct lom_layer_uniform){ .laid.map = color,
                                             .triplanar = true,
                                             .from_height = -1,
                                             .to_height = 1,
                                             .blend = 1,
                                             .from_slope = -1,
                                             .to_slope = 4,
                                             .slope_blend = 1 };
    for (int side = 0; side < LOM_SIDES; side++)
        u.layer[0].laid.scale[side][0] = u.layer[0].laid.scale[side][1] = 1;
    if (normal != NULL && color != NULL)
        try_function("ground", call_ground, &u, 2, 0);
    lom_free_texture(normal);
    lom_free_texture(color);
}

/* ---- shadows ---- */

static void call_shadow(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float3 offset = { in[0] * (1.5f / SIDE) - 0.25f, in[1] * (1.5f / SIDE) - 0.25f, in[2] };
    const lom_float3 normal = { { 0 }, { 0 }, { 0 } };
    memset(out, 0, 4 * sizeof *out);
    LOM_WIDE(lom_entity_light)(context, &offset, &normal, out);
}

/* Casters reach over the border of the map, as of the last cascade, and places lie on either side of it. */
static void places_beside_a_shadow_map(void)
{
    static const float depths[] = { 0, 0.9f, 0.3f };
    static struct lom_sun_shadow_uniform sun;
    lom_texture *map = random_texture(LOM_FORMAT_R32F, depths, 3, 9);
    if (map == NULL)
        return;
    map->sampler.wrap_s = map->sampler.wrap_t = LOM_WRAP_BORDER;
    for (int i = 0; i < 2; i++) {
        const float scale = i == 0 ? 3 : 1;
        sun.map[i] = (struct lom_shadow_map_uniform){ .map = map, .size = SIDE, .texel = 1.0f / SIDE };
        sun.map[i].s[0] = sun.map[i].t[1] = scale;
        sun.map[i].s[3] = sun.map[i].t[3] = 0.5f * (1 - scale) + 0.003f;
        sun.map[i].depth[2] = 1;
    }
    for (sun.count = 1; sun.count <= 2; sun.count++) {
        sun.cascaded = false;
        try_function("shadows", call_shadow, &sun, 3, 1);
        sun.cascaded = true;
        try_function("cascades", call_shadow, &sun, 3, 1);
    }
    lom_free_texture(map);
}

static void call_liquid(const void *context, const lom_float *in, lom_float *out)
{
    const lom_float3 offset = { in[0] * (1.5f / SIDE) - 0.25f, in[1] * (1.5f / SIDE) - 0.25f, in[2] };
    const lom_float3 normal = { { 0 }, { 0 }, { 0 } };
    lom_float3 share;
    memset(out, 0, 4 * sizeof *out);
    LOM_WIDE(lom_liquid_light)(context, &offset, &normal, &share);
    memcpy(out, &share, sizeof share);
}

static void places_beside_the_shadow_of_a_liquid(void)
{
    static const float texels[] = { 0, 0.9f, 0.3f, 2 };
    static struct lom_liquid_map_uniform liquid;
    lom_texture *map = random_texture(LOM_FORMAT_RGBA32F, texels, 4, 10);
    liquid.map = map;
    liquid.size = SIDE;
    liquid.s[0] = liquid.t[1] = liquid.depth[2] = 1;
    if (map != NULL)
        try_function("the shadow of a liquid", call_liquid, &liquid, 3, 2);
    lom_free_texture(map);
}

int main(int argc, char **argv)
{
    RUN(plates_with_colour_and_no_opacity);
    RUN(edges_beside_infinities);
    RUN(blurs_of_denormals);
    RUN(ground_without_a_normal);
    RUN(places_beside_a_shadow_map);
    RUN(places_beside_the_shadow_of_a_liquid);
    return check_result();
}
