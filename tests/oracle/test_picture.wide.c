/* The pipeline at its most exact against the oracles, a whole picture at once (R2 to R1): a textured torus under Phong's or
 * Blinn's light in perspective, with a depth test, and a pane blended over it, drawn triangle by triangle and pixel by
 * pixel in double. Coverage has to be equal, colours within a relative root mean square error of 1e-5. */
#include "oracle/blending.h"
#include "oracle/interpolation.h"
#include "oracle/lighting.h"
#include "oracle/sampling.h"
#include "pipeline/stage.h"
#include "shading/phong.h"

enum { SIZE = 192, RINGS = 40, SIDES = 24, CORNERS = 6 * RINGS * SIDES };

/* Attributes: clip position; offset from the eye and s; normal and t. */
static vertex corners[CORNERS + 6];

struct look {
    struct lom_view_uniform view;
    struct lom_material_uniform material;
    float opacity;
};

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    const lom_float4 offset = in->attribute[1], normal = in->attribute[2];
    const lom_float varying[8] = { offset.x, offset.y, offset.z, offset.w, normal.x, normal.y, normal.z, normal.w };
    for (int i = 0; i < 8; i++)
        out->varying[i] = varying[i];
}

static void shade(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const struct look *look = uniforms;
    const lom_float *v = in->varying;
    const lom_texture *texture = look->material.texture;
    lom_float3 offset = { v[0], v[1], v[2] }, normal = lom_normalize3((lom_float3){ v[4], v[5], v[6] });
    struct lom_lit lit = lom_phong_light(&look->view, &look->material, offset, normal, lom_splat(1.0f));
    lom_float4 texel = lom_sample(texture, v[3], v[7], lom_lod(texture, in, 3, 7));
    lom_float3 color = lom_add3(lom_mul3(lit.textured, (lom_float3){ texel.x, texel.y, texel.z }), lit.highlight);
    out->color[0] = (lom_float4){ color.x, color.y, color.z, lom_splat(look->opacity) };
}

LOM_SHADER(lit, place, shade, .attributes = 3, .varyings = 8, .reads = LOM_VARYINGS(0, 8),
           .differentiates = LOM_VARYINGS(3, 1) | LOM_VARYINGS(7, 1), .colors = 1, .uniforms_size = sizeof(struct look))

/* ---- what is drawn ---- */

static const double turn = 6.283185307179586;

/* A corner of the torus or the pane: its offset from the eye, which looks along -z, and what follows from it. */
static void put(vertex *v, const double offset[3], const double normal[3], double s, double t)
{
    const float clip[4] = { (float)(1.5 * offset[0]), (float)(1.5 * offset[1]), 0.1f, (float)-offset[2] };
    memcpy(v->position, clip, sizeof clip);
    for (int k = 0; k < 3; k++) {
        v->value[k] = (float)offset[k];
        v->value[4 + k] = (float)normal[k];
    }
    v->value[3] = (float)s;
    v->value[7] = (float)t;
}

static void make_corners(void)
{
    static const int step[6][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    const double c = cos(1.0), s = sin(1.0), up[3] = { 0, 0, 1 };
    for (int n = 0; n < CORNERS; n++) {
        const double u = (double)(n / 6 / SIDES + step[n % 6][0]) / RINGS,
                     v = (double)(n / 6 % SIDES + step[n % 6][1]) / SIDES;
        const double out[3] = { cos(turn * v) * cos(turn * u), cos(turn * v) * sin(turn * u), sin(turn * v) };
        const double at[3] = { cos(turn * u) + 0.4 * out[0], sin(turn * u) + 0.4 * out[1], 0.4 * out[2] };
        const double offset[3] = { at[0], c * at[1] - s * at[2], s * at[1] + c * at[2] - 2.7 };
        const double normal[3] = { out[0], c * out[1] - s * out[2], s * out[1] + c * out[2] };
        put(&corners[n], offset, normal, 6 * u, 3 * v);
    }
    for (int n = 0; n < 6; n++) {
        const double x = step[n][0], y = step[n][1], offset[3] = { 1.1 * x - 0.9, 1.2 * y - 0.7, -1.1 - 0.15 * x };
        put(&corners[CORNERS + n], offset, up, 2 * x, 2 * y);
    }
}

static struct look make_look(const lom_texture *texture, int model)
{
    struct look look = { .opacity = 1 };
    look.view.light = (struct lom_light_uniform){ .to_light = { 0.48f, 0.6f, 0.64f },
                                                  .color = { 0.9f, 0.8f, 0.7f },
                                                  .ambient = { 0.2f, 0.3f, 0.4f },
                                                  .ground = { 0.1f, 0.05f, 0.02f } };
    look.view.reflection.model = model;
    look.material = (struct lom_material_uniform){ .ambient = { 0.9f, 0.9f, 1 },
                                                   .diffuse = { 0.8f, 0.9f, 0.7f },
                                                   .specular = { 0.5f, 0.4f, 0.3f },
                                                   .shininess = 24,
                                                   .texture = texture };
    return look;
}

/* ---- the oracle's picture ---- */

static double picture[SIZE][SIZE][4], depths[SIZE][SIZE];

static lit_surface surface_of(const struct look *look)
{
    const struct lom_light_uniform *light = &look->view.light;
    lit_surface m = { .shininess = (double)look->material.shininess,
                      .blinn = look->view.reflection.model == LOM_MODEL_BLINN_PHONG };
    for (int k = 0; k < 3; k++) {
        m.ambient[k] = (double)look->material.ambient[k];
        m.diffuse[k] = (double)look->material.diffuse[k];
        m.specular[k] = (double)look->material.specular[k];
        m.sky[k] = (double)light->ambient[k];
        m.ground[k] = (double)light->ground[k];
        m.sun[k] = (double)light->color[k];
        m.to_sun[k] = (double)light->to_light[k];
    }
    return m;
}

/* Level of detail: log2 of the longer of the steps to the right and down, in texels of level 0. */
static double level_of(const snapped at[3], const double w[3], const vertex *v, double x, double y, int size)
{
    double s[2], t[2];
    change_at(at, w, (double[3]){ v[0].value[3], v[1].value[3], v[2].value[3] }, x, y, s);
    change_at(at, w, (double[3]){ v[0].value[7], v[1].value[7], v[2].value[7] }, x, y, t);
    const double right = s[0] * s[0] + t[0] * t[0], down = s[1] * s[1] + t[1] * t[1];
    return 0.5 * log2((right > down ? right : down) * size * size);
}

static void shade_pixel(const struct look *look, const plain_texture *texture, const snapped at[3], const vertex *v,
                        int x, int y, double color[4])
{
    const double px = 256.0 * x + 128, py = 256.0 * y + 128;
    const double w[3] = { v[0].position[3], v[1].position[3], v[2].position[3] };
    double weight[3], value[8], texel[4], bound = 0;
    bool shaky = false;
    weights_at(at, w, px, py, weight);
    for (int i = 0; i < 8; i++)
        value[i] = weighted(weight, (double[3]){ v[0].value[i], v[1].value[i], v[2].value[i] });
    double to_eye[3] = { -value[0], -value[1], -value[2] }, normal[3] = { value[4], value[5], value[6] };
    normalize(to_eye);
    normalize(normal);
    const lit_surface m = surface_of(look);
    sample_plain(texture, (double[3]){ value[3], value[7], 0 }, level_of(at, w, v, px, py, texture->width[0]), texel,
                 &bound, &shaky);
    light_surface(&m, normal, to_eye, texel, color);
    color[3] = (double)look->opacity;
}

static const lom_blend over = { .enabled = true,
                                .source_color = LOM_FACTOR_SOURCE_ALPHA,
                                .target_color = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA,
                                .source_alpha = LOM_FACTOR_ONE,
                                .target_alpha = LOM_FACTOR_ONE_MINUS_SOURCE_ALPHA };

static void draw_plainly(const struct look *look, const plain_texture *texture, const vertex *v, int count)
{
    for (; count > 0; count -= 3, v += 3) {
        snapped at[3];
        for (int k = 0; k < 3; k++)
            at[k] = snap(v[k].position, SIZE, SIZE);
        if ((at[1].x - at[0].x) * (at[2].y - at[0].y) - (at[1].y - at[0].y) * (at[2].x - at[0].x) >= 0)
            continue; /* a back face: clockwise with y down */
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                if (!covers(at, x, y))
                    continue;
                double weight[3], *pixel = picture[y][x];
                weights_at(at, NULL, 256.0 * x + 128, 256.0 * y + 128, weight);
                const double depth = weighted(weight, (double[3]){ v[0].position[2] / (double)v[0].position[3],
                                                                   v[1].position[2] / (double)v[1].position[3],
                                                                   v[2].position[2] / (double)v[2].position[3] });
                if (depth <= depths[y][x])
                    continue;
                struct blend_terms terms = { { 0 }, { pixel[0], pixel[1], pixel[2], pixel[3] }, { 0 }, { 0 } };
                shade_pixel(look, texture, at, v, x, y, terms.source);
                for (int c = 0; c < 4; c++)
                    pixel[c] = look->opacity < 1 ? blend_equation(&over, &terms, c) : terms.source[c];
                depths[y][x] = depth;
            }
    }
}

/* ---- both ---- */

static lom_image *draw(stage *s, struct look look)
{
    begin(s, (lom_pass_desc){ .clear_color = { { 0 } } });
    lom_draw_desc first = draw_of(&lit, corners, CORNERS), second = draw_of(&lit, corners + CORNERS, 6);
    first.uniforms = second.uniforms = &look;
    first.cull = second.cull = LOM_CULL_BACK;
    lom_draw(s->device, &first);
    look.opacity = 0.35f;
    second.blend[0] = over;
    lom_draw(s->device, &second);
    finish(s);
    return s->image;
}

static void compare(const lom_image *image, const char *what)
{
    double squares = 0, total = 0, largest = 0;
    int covered = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const float *got = lom_image_pixel(image, x, y, 0);
            CHECK((got[3] > 0) == (picture[y][x][3] > 0), "pixel %d,%d is covered by one alone", x, y);
            covered += got[3] > 0;
            for (int c = 0; c < 4; c++) {
                const double off = fabs((double)got[c] - picture[y][x][c]);
                squares += off * off;
                total += picture[y][x][c] * picture[y][x][c];
                largest = off > largest ? off : largest;
            }
        }
    const double relative = sqrt(squares / total);
    printf("  %s: %d pixels, relative error %.2e, at most %.2e\n", what, covered, relative, largest);
    CHECK(relative <= 1e-5, "%s: %g", what, relative);
    CHECK(covered > SIZE * SIZE / 3, "%s: %d pixels", what, covered);
}

static void a_picture_is_the_oracles(void)
{
    static const int models[] = { LOM_MODEL_PHONG, LOM_MODEL_BLINN_PHONG };
    plain_texture texture = make_plain(
        (lom_texture_desc){ .width = 64,
                            .height = 64,
                            .format = LOM_FORMAT_RGBA8_SRGB,
                            .mips = LOM_MIPS_ALL,
                            .sampler = { .minify = LOM_FILTER_LINEAR_MIPMAP_LINEAR, .magnify = LOM_FILTER_LINEAR } });
    make_corners();
    stage s = open_stage((lom_device_desc){ .threads = 2 }, SIZE, SIZE, LOM_FORMAT_RGBA32F, LOM_FORMAT_DEPTH32F);
    for (int i = 0; i < 2; i++) {
        struct look look = make_look(texture.texture, models[i]);
        const lom_image *image = draw(&s, look);
        memset(picture, 0, sizeof picture);
        memset(depths, 0, sizeof depths);
        draw_plainly(&look, &texture, corners, CORNERS);
        look.opacity = 0.35f;
        draw_plainly(&look, &texture, corners + CORNERS, 6);
        compare(image, i == 0 ? "Phong" : "Blinn");
    }
    close_stage(&s);
    free_plain(&texture);
}

int main(int argc, char **argv)
{
    RUN(a_picture_is_the_oracles);
    return check_result();
}
