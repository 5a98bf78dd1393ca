/* The apron of a level: one texel on all sides that says what lies beyond the edge. In: the texels of a level; out: its
 * apron, by the wrap modes, or for a cube from the neighbouring faces. */
#include "texture.h"
#include "convert.h"

/* ---- flat levels ---- */

/* The border colour in the texture's storage, at most 16 bytes. */
static void make_border(const lom_texture *texture, void *texel)
{
    const float *border = texture->sampler.border;
    if (texture->storage == LOM_STORAGE_RGBA8) {
        uint32_t value = 0;
        for (int c = 0; c < 4; c++) {
            uint32_t byte = texture->srgb && c < 3 ? lom_srgb8_of(border[c]) : lom_unorm_of(border[c], 255);
            value |= byte << 8 * c;
        }
        memcpy(texel, &value, sizeof value);
        return;
    }
    float value[4];
    for (int c = 0; c < 4; c++) {
        float x = border[c] == border[c] ? border[c] : 0;
        value[c] = x > -0x1p123f ? (x < 0x1p123f ? x : 0x1p123f) : -0x1p123f;
    }
    memcpy(texel, value, lom_texel_size(texture));
}

/* `runs` runs of size bytes, each stride bytes after the other, at to: from from, or filled with one texel. */
typedef struct edge {
    lom_wrap wrap;
    const uint8_t *border;
    size_t texel;
} edge;

static void fill_run(const edge *e, uint8_t *to, const uint8_t *from, size_t size)
{
    if (e->wrap != LOM_WRAP_BORDER) {
        memcpy(to, from, size);
        return;
    }
    for (size_t i = 0; i < size; i += e->texel)
        memcpy(to + i, e->border, e->texel);
}

/* What is made of element 0 of an axis, or of its last one, n - 1: the element beyond it, or where the axis repeats beyond
 * the other one. Element 0 is at first; elements are size bytes, step bytes apart. */
static void fill_end(const edge *e, uint8_t *first, int n, size_t step, size_t size, bool of_last)
{
    uint8_t *last = first + (size_t)(n - 1) * step;
    bool above = of_last != (e->wrap == LOM_WRAP_REPEAT);
    fill_run(e, above ? last + step : first - step, of_last ? last : first, size);
}

static void fill_ends(const edge *e, uint8_t *first, int n, size_t step, size_t size)
{
    fill_end(e, first, n, step, size, false);
    fill_end(e, first, n, step, size, true);
}

void lom_fill_column(lom_texture *texture, int level, int layer, int first, int end, bool of_last)
{
    uint8_t border[16];
    size_t texel = lom_texel_size(texture);
    edge e = { texture->sampler.wrap_s, border, texel };
    make_border(texture, border);
    for (int y = first; y < end; y++)
        fill_end(&e, lom_texel(texture, level, 0, y, layer), texture->level[level].width, texel, texel, of_last);
}

/* Columns first, then whole rows with them, then whole slices, so that corners combine the modes of their axes. */
void lom_fill_columns(lom_texture *texture, int level, int layer, int first, int end)
{
    lom_fill_column(texture, level, layer, first, end, false);
    lom_fill_column(texture, level, layer, first, end, true);
}

void lom_fill_rows(lom_texture *texture, int level, int layer)
{
    const lom_level *l = &texture->level[level];
    uint8_t border[16];
    size_t texel = lom_texel_size(texture), row = l->pitch * texel;
    edge e = { texture->sampler.wrap_t, border, texel };
    make_border(texture, border);
    fill_ends(&e, lom_texel(texture, level, -1, 0, layer), l->height, row, row);
}

void lom_fill_slices(lom_texture *texture, int level)
{
    const lom_level *l = &texture->level[level];
    uint8_t border[16];
    size_t texel = lom_texel_size(texture), slice = l->slice * texel;
    edge e = { texture->sampler.wrap_r, border, texel };
    make_border(texture, border);
    fill_ends(&e, lom_texel(texture, level, -1, -1, 0), l->depth, slice, slice);
}

static void fill_flat(lom_texture *texture, int level)
{
    for (int z = 0; z < lom_level_layers(texture, level); z++) {
        lom_fill_columns(texture, level, z, 0, texture->level[level].height);
        lom_fill_rows(texture, level, z);
    }
    if (texture->kind == LOM_TEXTURE_3D)
        lom_fill_slices(texture, level);
}

/* ---- cubes ---- */

/* The axes of s and t on each face and their signs (OpenGL 4.6, table 8.19); the face's own axis is face / 2. */
static const struct {
    int s_axis, s_sign, t_axis, t_sign;
} faces[6] = { { 2, -1, 1, -1 }, { 2, 1, 1, -1 }, { 0, 1, 2, 1 }, { 0, 1, 2, -1 }, { 0, 1, 1, -1 }, { 0, -1, 1, -1 } };

/* The texel that meets (x, y) of a face, which is one outside in x or in y. With texel centres at odd (or even)
 * integers in -n < p < n and faces at distance n, one step across an edge trades the coordinate that would be n + 1 for
 * n, and the old face's n for n - 1. */
static void *texel_across(const lom_texture *texture, int level, int face, int x, int y)
{
    int n = texture->level[level].width, v[3] = { 0, 0, 0 };
    int s = 2 * x + 1 - n, t = 2 * y + 1 - n, sign = face & 1 ? -1 : 1;
    bool out_s = s < -n || s > n;
    int across = out_s ? (s > 0 ? n : -n) : (t > 0 ? n : -n);
    v[face / 2] = sign * (n - 1);
    v[faces[face].s_axis] = faces[face].s_sign * (out_s ? across : s);
    v[faces[face].t_axis] = faces[face].t_sign * (out_s ? t : across);
    int axis = out_s ? faces[face].s_axis : faces[face].t_axis;
    int to = 2 * axis + (v[axis] < 0);
    int to_s = v[faces[to].s_axis] * faces[to].s_sign, to_t = v[faces[to].t_axis] * faces[to].t_sign;
    return lom_texel(texture, level, (to_s + n - 1) / 2, (to_t + n - 1) / 2, to);
}

static uint32_t mean_of_codes(uint32_t a, uint32_t b, uint32_t c, bool srgb)
{
    uint32_t mean = 0;
    for (int shift = 0; shift < 32; shift += 8) {
        uint32_t x = a >> shift & 255, y = b >> shift & 255, z = c >> shift & 255;
        double light = (double)lom_srgb_linear[x] + lom_srgb_linear[y] + lom_srgb_linear[z];
        uint32_t code = srgb && shift < 24 ? lom_srgb8_of((float)(light / 3)) : (2 * (x + y + z) + 3) / 6;
        mean |= code << shift;
    }
    return mean;
}

/* Three faces meet at a corner: what lies beyond it is the mean of their three texels, in linear light. */
static void fill_corner(lom_texture *texture, int level, int face, int x, int y)
{
    int last = texture->level[level].width - 1;
    int inner_x = x < 0 ? 0 : last, inner_y = y < 0 ? 0 : last;
    void *to = lom_texel(texture, level, x, y, face);
    const void *from[3] = { lom_texel(texture, level, inner_x, inner_y, face),
                            lom_texel(texture, level, x, inner_y, face), lom_texel(texture, level, inner_x, y, face) };
    if (texture->storage == LOM_STORAGE_RGBA8) {
        uint32_t texel[3];
        for (int i = 0; i < 3; i++)
            memcpy(&texel[i], from[i], sizeof texel[i]);
        uint32_t mean = mean_of_codes(texel[0], texel[1], texel[2], texture->srgb);
        memcpy(to, &mean, sizeof mean);
        return;
    }
    float texel[3][4], mean[4];
    size_t size = lom_texel_size(texture);
    for (int i = 0; i < 3; i++)
        memcpy(texel[i], from[i], size);
    for (size_t c = 0; c < size / sizeof(float); c++)
        mean[c] = (float)(((double)texel[0][c] + texel[1][c] + texel[2][c]) / 3);
    memcpy(to, mean, size);
}

void lom_fill_face(lom_texture *texture, int level, int face)
{
    int n = texture->level[level].width;
    size_t size = lom_texel_size(texture);
    for (int i = 0; i < n; i++) {
        memcpy(lom_texel(texture, level, -1, i, face), texel_across(texture, level, face, -1, i), size);
        memcpy(lom_texel(texture, level, n, i, face), texel_across(texture, level, face, n, i), size);
        memcpy(lom_texel(texture, level, i, -1, face), texel_across(texture, level, face, i, -1), size);
        memcpy(lom_texel(texture, level, i, n, face), texel_across(texture, level, face, i, n), size);
    }
    fill_corner(texture, level, face, -1, -1);
    fill_corner(texture, level, face, n, -1);
    fill_corner(texture, level, face, -1, n);
    fill_corner(texture, level, face, n, n);
}

void lom_fill_apron(lom_texture *texture, int level)
{
    for (int face = 0; face < 6 && texture->kind == LOM_TEXTURE_CUBE; face++)
        lom_fill_face(texture, level, face);
    if (texture->kind != LOM_TEXTURE_CUBE)
        fill_flat(texture, level);
}
