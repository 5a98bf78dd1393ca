/* Mesa's llvmpipe as the witness of pictures. In: random triangles on and off the pixels' centres; a textured torus in
 * perspective. Proves that both cover the same pixels by OpenGL's rule for shared edges (no pixel may differ: both have
 * 8 bits below a pixel), and that a mesh's depth test, perspective, levels of detail and filtering agree as far as 8-bit
 * filters and each renderer's choice of levels do. Only make check-long builds this. */
#include <lom/pipeline.h>

#include "check.h"
#include "mesa.h"

#include <math.h>

enum {
    SIZE = 256,
    UNITS = SIZE * 256,
    TRIANGLES = 250,
    KINDS = 6,
    PASSES = 8 * KINDS,
    BEYOND = 5,
    TEXELS = 256,
    RINGS = 96,
    SIDES = 48
};

typedef struct corner {
    float position[4], st[2];
} corner;

static corner corners[6 * RINGS * SIDES];
static uint8_t mesa[SIZE][SIZE][4], texels[TEXELS][TEXELS][4];

static void place(lom_vertex *out, const lom_attributes *in, const void *uniforms)
{
    (void)uniforms;
    out->position = in->attribute[0];
    out->varying[0] = in->attribute[1].x;
    out->varying[1] = in->attribute[1].y;
}

static void count(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    (void)in;
    (void)uniforms;
    lom_float one = lom_splat(1.0f / 255.0f);
    out->color[0] = (lom_float4){ one, one, one, one };
}

static void show(lom_fragment *out, const lom_varyings *in, const void *uniforms)
{
    const lom_texture *const *texture = uniforms;
    out->color[0] = lom_sample(*texture, in->varying[0], in->varying[1], lom_lod(*texture, in, 0, 1));
}

LOM_SHADER(counter, place, count, .attributes = 2, .varyings = 2, .colors = 1)
LOM_SHADER(textured, place, show, .attributes = 2, .varyings = 2, .reads = LOM_VARYINGS(0, 2),
           .differentiates = LOM_VARYINGS(0, 2), .colors = 1, .uniforms_size = sizeof(lom_texture *))

/* clang-format off */
static const char VERTEX[] = "#version 300 es\n"
    "layout(location=0) in vec4 at; layout(location=1) in vec2 st; out vec2 v; void main() { v = st; gl_Position = at; }";
static const char COUNT[] = "#version 300 es\n"
    "precision highp float; out vec4 color; void main() { color = vec4(1.0 / 255.0); }";
static const char SHOW[] = "#version 300 es\n"
    "precision highp float; in vec2 v; uniform sampler2D map; out vec4 color; void main() { color = texture(map, v); }";
/* clang-format on */

/* OpenGL's first row is the lowest, so it is given everything upside down: rows are then as lom's. */
static corner *turned(size_t corner_count)
{
    static corner copy[6 * RINGS * SIDES];
    for (size_t i = 0; i < corner_count; i++) {
        copy[i] = corners[i];
        copy[i].position[1] = -copy[i].position[1];
    }
    return copy;
}

static void read_mesa(void)
{
    glReadPixels(0, 0, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, mesa);
    const GLenum error = glGetError();
    CHECK(error == GL_NO_ERROR, "Mesa's error is %x", error);
}

static lom_draw_desc draw_of(const lom_shader *shader, size_t corner_count)
{
    size_t size = corner_count * sizeof *corners, stride = sizeof *corners;
    return (lom_draw_desc){ .shader = shader,
                            .attribute = { { corners, size, stride, LOM_ATTRIBUTE_FLOAT4 },
                                           { corners[0].st, size - 16, stride, LOM_ATTRIBUTE_FLOAT2 } },
                            .count = corner_count };
}

/* ---- coverage ---- */

static int64_t uniform(uint64_t i, int64_t low, int64_t high)
{
    return low + (int64_t)(lom_random_bits(5, i) % (uint64_t)(high - low + 1));
}

/* Each pass another kind: small, large, slivers, all corners on centres, edges along rows and columns of centres, and
 * beyond the frame. */
static void make_triangle(uint64_t kind, uint64_t key, int64_t at[3][2])
{
    static const int64_t reach[KINDS] = { 900, 30000, 9000, 20, 24, 60000 };
    for (uint64_t a = 0; a < 2; a++) {
        const int64_t middle = uniform(key + a, 0, UNITS);
        for (uint64_t k = 0; k < 3; k++)
            at[k][a] = uniform(key + 2 + 2 * k + a, -reach[kind], reach[kind]);
        if (kind == 2)
            at[2][a] = (at[0][a] + at[1][a]) / 2 + uniform(key + 9 + a, -3, 3);
        for (int k = 0; k < 3; k++) {
            at[k][a] = kind == 3 || kind == 4 ? (at[k][a] + middle / 256) * 256 + 128 : at[k][a] + middle;
            if (kind != BEYOND)
                at[k][a] = at[k][a] < 0 ? -at[k][a] : at[k][a] > UNITS ? 2 * UNITS - at[k][a] : at[k][a];
        }
    }
    if (kind == 4) {
        at[1][0] = at[0][0];
        at[2][1] = at[0][1];
    }
}

static void make_triangles(uint64_t pass)
{
    for (uint64_t t = 0; t < TRIANGLES; t++) {
        int64_t at[3][2];
        make_triangle(pass % KINDS, (pass * TRIANGLES + t) * 16, at);
        for (uint64_t k = 0; k < 3; k++) {
            const float x = (float)at[k][0] / (UNITS / 2) - 1, y = 1 - (float)at[k][1] / (UNITS / 2);
            corners[3 * t + k] = (corner){ { x, y, 0.5f, 1 }, { 0, 0 } };
        }
    }
}

static lom_image *count_ours(lom_device *device, lom_texture *target)
{
    lom_draw_desc draw = draw_of(&counter, 3 * TRIANGLES);
    draw.blend[0] = (lom_blend){ .enabled = true,
                                 .source_color = LOM_FACTOR_ONE,
                                 .target_color = LOM_FACTOR_ONE,
                                 .source_alpha = LOM_FACTOR_ONE,
                                 .target_alpha = LOM_FACTOR_ONE };
    lom_begin_pass(device, &(lom_pass_desc){ .color = { target } });
    lom_draw(device, &draw);
    CHECK(lom_end_pass(device), "%s", lom_device_error(device)->text);
    return lom_read_texture(target, 0, 0, NULL);
}

static void count_mesas(void)
{
    const size_t size = 3 * TRIANGLES * sizeof *corners;
    bool linked = mesa_program(VERTEX, COUNT, turned(3 * TRIANGLES), size, sizeof *corners);
    CHECK(linked, "Mesa refuses the program");
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    glDrawArrays(GL_TRIANGLES, 0, 3 * TRIANGLES);
    read_mesa();
}

/* Mesa cuts at the frame what lies beyond it and snaps the new corners, so there edges may move by a part of a pixel;
 * lom cuts at 32768 pixels, and is held to the exact answer by tests/pipeline/test_coverage. */
static void both_cover_the_same_pixels(void)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2, .lanes = LOM_LANES });
    lom_texture *target = lom_make_texture(device, &(lom_texture_desc){ .width = SIZE, .height = SIZE });
    long covered[KINDS] = { 0 }, differ[KINDS] = { 0 };
    for (uint64_t pass = 0; pass < PASSES; pass++) {
        make_triangles(pass);
        lom_image *image = count_ours(device, target);
        count_mesas();
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                const int hits = ((const uint8_t *)lom_image_pixel(image, x, y, 0))[0];
                covered[pass % KINDS] += hits;
                differ[pass % KINDS] += hits != mesa[y][x][0];
                CHECK(pass % KINDS == BEYOND || hits == mesa[y][x][0], "pass %d, pixel %d,%d: %d hits, Mesa has %d",
                      (int)pass, x, y, hits, mesa[y][x][0]);
            }
        lom_free_image(image);
    }
    lom_close_device(device);
    for (int kind = 0; kind < KINDS; kind++) {
        printf("  kind %d: %ld fragments, %ld pixels differ\n", kind, covered[kind], differ[kind]);
        CHECK(covered[kind] > 5000, "kind %d: %ld fragments", kind, covered[kind]);
        CHECK(differ[kind] * 5000 < covered[kind], "kind %d: %ld differ", kind, differ[kind]);
    }
}

/* ---- a textured mesh ---- */

/* A torus about the z axis, tilted, in perspective; depths as OpenGL has them, -w..w, are made from lom's 0..w below. */
static size_t make_torus(void)
{
    const double turn = 6.283185307179586;
    size_t n = 0;
    for (int ring = 0; ring < RINGS; ring++)
        for (int side = 0; side < SIDES; side++)
            for (int k = 0; k < 6; k++, n++) {
                const int i = ring + (k == 1 || k == 3 || k == 4), j = side + (k == 2 || k == 4 || k == 5);
                const double u = (double)i / RINGS, v = (double)j / SIDES, r = 1 + 0.45 * cos(turn * v);
                double x = r * cos(turn * u), y = r * sin(turn * u), z = 0.45 * sin(turn * v);
                const double c = cos(1.1), s = sin(1.1), up = c * y - s * z, far = 2.4 - (s * y + c * z), near = 0.1;
                corners[n] = (corner){ { (float)(1.6 * x), (float)(1.6 * up), (float)near, (float)far },
                                       { (float)(8 * u), (float)(4 * v) } };
            }
    return n;
}

static void make_texels(void)
{
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++) {
            const int square = ((x >> 5) + (y >> 5)) & 1;
            texels[y][x][0] = (uint8_t)(square ? 230 : 40);
            texels[y][x][1] = (uint8_t)(128 + 100 * sin(x * 0.196));
            texels[y][x][2] = (uint8_t)(128 + 100 * cos(y * 0.098));
            texels[y][x][3] = 255;
        }
}

static lom_image *draw_torus(size_t corner_count)
{
    lom_device *device = lom_open_device(&(lom_device_desc){ .threads = 2, .lanes = LOM_LANES });
    lom_texture *target = lom_make_texture(device, &(lom_texture_desc){ .width = SIZE, .height = SIZE });
    lom_texture *depth =
        lom_make_texture(device, &(lom_texture_desc){ .width = SIZE, .height = SIZE, .format = LOM_FORMAT_DEPTH32F });
    lom_texture *map = lom_make_texture(
        device, &(lom_texture_desc){ .width = TEXELS, .height = TEXELS, .pixels = texels, .mips = LOM_MIPS_ALL });
    lom_begin_pass(device, &(lom_pass_desc){ .color = { target }, .depth = depth, .clear_color = { { 0, 0, 0, 1 } } });
    lom_draw_desc draw = draw_of(&textured, corner_count);
    draw.uniforms = &map;
    lom_draw(device, &draw);
    CHECK(lom_end_pass(device), "%s", lom_device_error(device)->text);
    lom_image *image = lom_read_texture(target, 0, 0, NULL);
    lom_close_device(device);
    return image;
}

static void draw_mesa_torus(size_t corner_count)
{
    corner *turn = turned(corner_count);
    GLuint map;
    for (size_t i = 0; i < corner_count; i++) /* far is 0 of w here and 1 there */
        turn[i].position[2] = turn[i].position[3] - 2 * turn[i].position[2];
    bool linked = mesa_program(VERTEX, SHOW, turn, corner_count * sizeof *turn, sizeof *turn);
    CHECK(linked, "Mesa refuses the program");
    glGenTextures(1, &map);
    glBindTexture(GL_TEXTURE_2D, map);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, TEXELS, TEXELS, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClearColor(0, 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawArrays(GL_TRIANGLES, 0, (GLsizei)corner_count);
    read_mesa();
}

static void a_textured_mesh_agrees(void)
{
    make_texels();
    const size_t corner_count = make_torus();
    lom_image *image = draw_torus(corner_count);
    draw_mesa_torus(corner_count);
    double squares = 0;
    long shown = 0, outline = 0, beyond = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const uint8_t *ours = lom_image_pixel(image, x, y, 0), *theirs = mesa[y][x];
            int largest = 0;
            for (int c = 0; c < 3; c++) {
                const int d = abs(ours[c] - theirs[c]);
                largest = d > largest ? d : largest;
                squares += d * d;
            }
            shown += ours[2] > 0;
            outline += (ours[2] > 0) != (theirs[2] > 0);
            beyond += largest > 8;
        }
    const double psnr = 10 * log10(255.0 * 255.0 * 3 * (double)shown / squares); /* of the mesh alone */
    printf("  %ld pixels of the mesh, %ld of another outline, %ld differ by more than 8, PSNR %.1f dB\n", shown,
           outline, beyond, psnr);
    CHECK(shown > 15000, "%ld pixels", shown);
    CHECK(outline == 0, "%ld pixels belong to one mesh alone", outline);
    CHECK(beyond * 200 < shown, "%ld of %ld differ by more than 8", beyond, shown);
    CHECK(psnr > 40, "%g dB", psnr);
    lom_free_image(image);
}

int main(int argc, char **argv)
{
    if (!open_mesa(SIZE, SIZE))
        return 0;
    RUN(both_cover_the_same_pixels);
    RUN(a_textured_mesh_agrees);
    return check_result();
}
