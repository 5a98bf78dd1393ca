/* Textures: made from a descriptor, freed. In: tightly packed pixels of any format; out: levels with aprons
 * in one of three storages. Invariant: every index that sample_lanes.h can form lies inside texels[]. */
#include "texture.h"

#include "base/cpu.h"

static const uint64_t most_texels = INT32_MAX, most_bytes = UINT64_C(1) << 33;
enum { CACHE_LINE = 64 }; /* bytes; memory from lom_allocate begins with one */

/* ---- what is asked for ---- */

static int full_level_count(int width, int height, int depth)
{
    int largest = width > height ? width : height, count = 1;
    for (largest = largest > depth ? largest : depth; largest > 1; largest >>= 1)
        count++;
    return count;
}

static bool is_row(lom_texture_kind kind)
{
    return kind == LOM_TEXTURE_1D || kind == LOM_TEXTURE_1D_ARRAY;
}

static bool is_array(lom_texture_kind kind)
{
    return kind == LOM_TEXTURE_2D_ARRAY || kind == LOM_TEXTURE_1D_ARRAY;
}

static bool check_sizes(const lom_texture_desc *desc, lom_error *error)
{
    bool deep = desc->kind == LOM_TEXTURE_3D || is_array(desc->kind);
    int depth = deep ? desc->depth : 1;
    if (desc->width < 1 || desc->height < 1 || depth < 1 || desc->width > LOM_MAX_SIZE || desc->height > LOM_MAX_SIZE ||
        depth > LOM_MAX_SIZE)
        return lom_fail(error, LOM_ERROR_USAGE, "A texture of %d x %d x %d texels is outside 1..%d.", desc->width,
                        desc->height, depth, LOM_MAX_SIZE);
    if (!deep && desc->depth != 0 && desc->depth != 1)
        return lom_fail(error, LOM_ERROR_USAGE, "A 1D, 2D or cube texture has no depth of %d.", desc->depth);
    if (is_row(desc->kind) && desc->height != 1)
        return lom_fail(error, LOM_ERROR_USAGE, "A 1D texture has no height of %d.", desc->height);
    if (desc->kind == LOM_TEXTURE_CUBE && desc->width != desc->height)
        return lom_fail(error, LOM_ERROR_USAGE, "The faces of a cube texture are square, not %d x %d.", desc->width,
                        desc->height);
    int full = full_level_count(desc->width, desc->height, desc->kind == LOM_TEXTURE_3D ? depth : 1);
    if (desc->mips == LOM_MIPS_SUPPLIED &&
        (desc->level_count < 1 || desc->level_count > full || (desc->level_count > 1 && desc->level_pixels == NULL)))
        return lom_fail(error, LOM_ERROR_USAGE, "A texture of this size has 1..%d levels, not %d.", full,
                        desc->level_count);
    return true;
}

static bool check_desc(const lom_texture_desc *desc, lom_error *error)
{
    const lom_sampler_desc *s = &desc->sampler;
    if ((unsigned)desc->kind >= LOM_TEXTURE_KIND_COUNT || (unsigned)desc->mips > LOM_MIPS_SUPPLIED)
        return lom_fail(error, LOM_ERROR_USAGE, "There is no texture of kind %d with mips %d.", (int)desc->kind,
                        (int)desc->mips);
    if (desc->format != LOM_FORMAT_NONE && lom_describe_format(desc->format) == NULL)
        return lom_fail(error, LOM_ERROR_USAGE, "There is no texture of format %d.", (int)desc->format);
    if ((unsigned)s->filtering >= LOM_FILTERING_COUNT)
        return lom_fail(error, LOM_ERROR_USAGE, "A sampler has no filtering %d.", (int)s->filtering);
    if ((unsigned)s->minify >= LOM_FILTER_COUNT || (unsigned)s->magnify > LOM_FILTER_LINEAR)
        return lom_fail(error, LOM_ERROR_USAGE, "A sampler cannot minify by filter %d and magnify by filter %d.",
                        (int)s->minify, (int)s->magnify);
    if ((unsigned)s->anisotropy > 16)
        return lom_fail(error, LOM_ERROR_USAGE, "A sampler's anisotropy is 0..16, not %d.", s->anisotropy);
    if ((unsigned)s->wrap_s >= LOM_WRAP_COUNT || (unsigned)s->wrap_t >= LOM_WRAP_COUNT ||
        (unsigned)s->wrap_r >= LOM_WRAP_COUNT)
        return lom_fail(error, LOM_ERROR_USAGE, "A sampler cannot wrap by modes %d, %d, %d.", (int)s->wrap_s,
                        (int)s->wrap_t, (int)s->wrap_r);
    if (s->lod_bias != s->lod_bias || s->lod_min != s->lod_min || s->lod_max != s->lod_max)
        return lom_fail(error, LOM_ERROR_USAGE, "A sampler's bias and bounds of the level of detail cannot be NaN.");
    if (desc->samples < 0 || desc->samples > 16 || (desc->samples & (desc->samples - 1)) != 0 ||
        (desc->samples > 1 && desc->kind != LOM_TEXTURE_2D))
        return lom_fail(error, LOM_ERROR_USAGE,
                        "A texture keeps 1, 2, 4, 8 or 16 samples a pixel, and only a 2D one more than 1; not %d.",
                        desc->samples);
    if (desc->stencil &&
        (desc->kind != LOM_TEXTURE_2D || (desc->format != LOM_FORMAT_DEPTH24 && desc->format != LOM_FORMAT_DEPTH32F)))
        return lom_fail(error, LOM_ERROR_USAGE, "Only a 2D texture of DEPTH24 or DEPTH32F has a stencil.");
    return check_sizes(desc, error);
}

static lom_storage storage_of(const lom_format_info *info)
{
    if (info->bits == 8)
        return LOM_STORAGE_RGBA8;
    return info->channels == 1 ? LOM_STORAGE_R32F : LOM_STORAGE_RGBA32F;
}

static float between(float x, float low, float high)
{
    return x > low ? (x < high ? x : high) : low;
}

static void set_sampler(lom_texture *texture, const lom_texture_desc *desc)
{
    lom_sampler_desc *s = &texture->sampler;
    *s = desc->sampler;
    if (s->magnify == LOM_FILTER_DEFAULT)
        s->magnify = LOM_FILTER_LINEAR;
    if (s->minify == LOM_FILTER_DEFAULT)
        s->minify = desc->mips == LOM_MIPS_NONE ? LOM_FILTER_LINEAR : LOM_FILTER_LINEAR_MIPMAP_LINEAR;
    texture->nearest_within[0] = s->magnify == LOM_FILTER_NEAREST;
    texture->nearest_within[1] = s->minify == LOM_FILTER_NEAREST || s->minify == LOM_FILTER_NEAREST_MIPMAP_NEAREST ||
                                 s->minify == LOM_FILTER_NEAREST_MIPMAP_LINEAR;
    texture->fixed = s->filtering == LOM_FILTERING_FIXED && texture->storage == LOM_STORAGE_RGBA8 &&
                     !(texture->nearest_within[0] && texture->nearest_within[1]);
    texture->nearest_between =
        s->minify == LOM_FILTER_NEAREST_MIPMAP_NEAREST || s->minify == LOM_FILTER_LINEAR_MIPMAP_NEAREST;
    texture->linear_between =
        s->minify == LOM_FILTER_NEAREST_MIPMAP_LINEAR || s->minify == LOM_FILTER_LINEAR_MIPMAP_LINEAR;
    texture->plain = texture->kind == LOM_TEXTURE_2D && (texture->fixed || texture->storage == LOM_STORAGE_RGBA32F) &&
                     !texture->nearest_within[0] && !texture->nearest_within[1] && s->wrap_s != LOM_WRAP_BORDER &&
                     s->wrap_t != LOM_WRAP_BORDER &&
                     (texture->linear_between || (texture->level_count == 1 && !texture->nearest_between));
    texture->gathers = lom_has_fast_gathers();
    bool bounded = s->lod_min != 0 || s->lod_max != 0;
    texture->lod_min = bounded ? between(s->lod_min, -1000, 1000) : -1000;
    texture->lod_max = bounded ? between(s->lod_max, -1000, 1000) : 1000;
    texture->level_min = between(texture->lod_min, 0, (float)(texture->level_count - 1));
    texture->level_max = between(texture->lod_max, 0, (float)(texture->level_count - 1));
    s->lod_bias = between(s->lod_bias, -1000, 1000);
}

/* ---- layout ---- */

/* Texels from a row to the next. Rows whose pitch is near a simple part or multiple of 4096 bytes lie in few sets of a
 * cache and throw one another out: those of a kilobyte and more have an odd number of cache lines. `begins_line`: rows
 * begin with a line anyway. */
static uint64_t pitch_of(int width, uint64_t texel, bool begins_line)
{
    const uint64_t line = CACHE_LINE / texel;
    uint64_t pitch = (uint64_t)width + 2, lines = (pitch + line - 1) / line;
    if (lines >= 16)
        return (lines | 1) * line;
    return begins_line ? lines * line : pitch;
}

/* Beyond the last level lie the texels that a sample at the far border reads with weight 0. */
static bool lay_out(lom_texture *texture, const lom_texture_desc *desc, lom_error *error)
{
    int depth = desc->kind == LOM_TEXTURE_3D ? desc->depth : 1;
    bool target = desc->kind == LOM_TEXTURE_2D && desc->pixels == NULL && desc->mips != LOM_MIPS_SUPPLIED;
    uint64_t line = target ? CACHE_LINE / lom_texel_size(texture) : 1;
    uint64_t next = line - 1, tail = 0; /* the first texel inside the apron begins a line */
    for (int i = 0; i < texture->level_count; i++) {
        lom_level *l = &texture->level[i];
        l->width = desc->width >> i > 1 ? desc->width >> i : 1;
        l->height = desc->height >> i > 1 ? desc->height >> i : 1;
        l->depth = depth >> i > 1 ? depth >> i : 1;
        uint64_t pitch = pitch_of(l->width, lom_texel_size(texture), target);
        uint64_t slice = pitch * ((uint64_t)l->height + 2); /* < 2^31 */
        bool deep = texture->kind == LOM_TEXTURE_3D;
        uint64_t slices = deep ? (uint64_t)l->depth + 2 : (uint64_t)lom_level_layers(texture, i);
        l->pitch = (size_t)pitch;
        l->slice = (size_t)slice;
        l->offset = (size_t)(next + (deep ? slice : 0) + pitch + 1);
        texture->row[i] = (lom_level_row){ (float)l->width, (float)l->height, (int32_t)pitch, (int32_t)next };
        if (i == 0)
            tail = (deep ? slice : 0) + pitch + 2;
        next += slice * slices; /* < 2^47, and the sum over at most 16 levels < 2^51 */
        if (next + tail > most_texels || (next + tail) * lom_texel_size(texture) > most_bytes)
            return lom_fail(error, LOM_ERROR_LIMIT, "A texture of %d x %d x %d texels is larger than the limit.",
                            desc->width, desc->height, depth);
    }
    texture->texel_count = (size_t)(next + tail);
    texture->texels = lom_allocate((size_t)(next + tail), lom_texel_size(texture), error);
    return texture->texels != NULL;
}

int lom_level_layers(const lom_texture *texture, int level)
{
    return texture->kind == LOM_TEXTURE_3D ? texture->level[level].depth : texture->layers;
}

size_t lom_texel_size(const lom_texture *texture)
{
    return texture->storage == LOM_STORAGE_RGBA32F ? 16 : 4;
}

void *lom_texel(const lom_texture *texture, int level, int x, int y, int layer)
{
    const lom_level *l = &texture->level[level];
    ptrdiff_t index = (ptrdiff_t)l->offset + (ptrdiff_t)l->slice * layer + (ptrdiff_t)l->pitch * y + x;
    return (uint8_t *)texture->texels + index * (ptrdiff_t)lom_texel_size(texture);
}

/* ---- what it holds ---- */

const void *lom_pixels_of_level(const lom_texture_desc *desc, int level)
{
    if (level == 0)
        return desc->pixels;
    return desc->mips == LOM_MIPS_SUPPLIED ? desc->level_pixels[level - 1] : NULL;
}

/* Room for decoded texels, which halve the time of a sample (bench/results/sampling.md): for textures made from pixels;
 * what a pass draws into would be decoded every frame. Without memory the samplers decode. */
static void prepare_decoded(lom_texture *texture, const lom_texture_desc *desc)
{
    static const size_t most_decoded = (size_t)1 << 23; /* texels: 128 MiB */
    if (texture->srgb && desc->pixels != NULL && texture->texel_count <= most_decoded)
        texture->decoded =
            lom_allocate(texture->texel_count, texture->fixed ? 2 * sizeof(uint32_t) : 4 * sizeof(float), NULL);
}

/* ---- public ---- */

lom_texture *lom_begin_texture(const lom_texture_desc *asked, lom_error *error)
{
    lom_texture_desc full = asked != NULL ? *asked : (lom_texture_desc){ .width = 0 }, *desc = &full;
    if (is_row(desc->kind) && desc->height == 0)
        desc->height = 1;
    if (!check_desc(desc, error))
        return NULL;
    lom_texture *texture = lom_allocate(1, sizeof *texture, error);
    if (texture == NULL)
        return NULL;
    texture->kind = desc->kind;
    texture->format = desc->format == LOM_FORMAT_NONE ? LOM_FORMAT_RGBA8 : desc->format;
    const lom_format_info *info = lom_describe_format(texture->format);
    texture->storage = storage_of(info);
    texture->srgb = info->is_srgb;
    texture->builds_mips = desc->mips == LOM_MIPS_ALL;
    int depth = desc->kind == LOM_TEXTURE_3D ? desc->depth : 1;
    texture->layers = desc->kind == LOM_TEXTURE_CUBE ? 6 : is_array(desc->kind) ? desc->depth : 1;
    texture->level_count = desc->mips == LOM_MIPS_NONE       ? 1
                           : desc->mips == LOM_MIPS_SUPPLIED ? desc->level_count
                                                             : full_level_count(desc->width, desc->height, depth);
    set_sampler(texture, desc);
    texture->label = desc->label;
    texture->samples = desc->samples > 1 ? desc->samples : 0;
    bool laid = lay_out(texture, desc, error);
    if (laid && desc->stencil)
        texture->stencil = lom_allocate((size_t)desc->width, (size_t)desc->height, error);
    if (!laid || (desc->stencil && texture->stencil == NULL)) {
        lom_free_texture(texture);
        return NULL;
    }
    prepare_decoded(texture, desc);
    return texture;
}

lom_texture *lom_create_texture(const lom_texture_desc *desc, lom_error *error)
{
    lom_float_state state;
    lom_enter_float_state(&state);
    lom_texture *texture = lom_begin_texture(desc, error);
    for (int i = 0; texture != NULL && i < texture->level_count; i++)
        if (lom_pixels_of_level(desc, i) != NULL)
            lom_store_level(texture, i, lom_pixels_of_level(desc, i));
    if (texture != NULL)
        lom_finish_texture(texture);
    lom_leave_float_state(&state);
    return texture;
}

int lom_list_levels(const lom_image *image, const void *pixels[LOM_MAX_LEVELS])
{
    int count = 1;
    while ((image = image->smaller) != NULL && count < LOM_MAX_LEVELS)
        pixels[count++ - 1] = image->pixels;
    return count;
}

lom_texture *lom_texture_of_image(const lom_image *image, bool srgb, lom_mips mips, lom_error *error)
{
    lom_format format = image->format;
    if (srgb && format >= LOM_FORMAT_R8 && format <= LOM_FORMAT_RGBA8)
        format = (lom_format)(format + (LOM_FORMAT_R8_SRGB - LOM_FORMAT_R8));
    static const lom_texture_kind kinds[] = { [LOM_SLICES_VOLUME] = LOM_TEXTURE_3D,
                                              [LOM_SLICES_CUBE] = LOM_TEXTURE_CUBE,
                                              [LOM_SLICES_LAYERS] = LOM_TEXTURE_2D_ARRAY };
    const void *smaller[LOM_MAX_LEVELS];
    int levels = lom_list_levels(image, smaller);
    lom_texture_desc desc = {
        .kind = image->slices == LOM_SLICES_VOLUME && image->depth == 1 ? LOM_TEXTURE_2D : kinds[image->slices],
        .width = image->width,
        .height = image->height,
        .depth = image->slices == LOM_SLICES_CUBE ? 1 : image->depth,
        .format = format,
        .pixels = image->pixels,
        .mips = mips != LOM_MIPS_NONE && levels > 1 ? LOM_MIPS_SUPPLIED : mips,
        .level_pixels = smaller,
        .level_count = levels,
    };
    return lom_create_texture(&desc, error);
}

void lom_free_texture(lom_texture *texture)
{
    if (texture == NULL)
        return;
    lom_release(texture->decoded);
    lom_release(texture->texels);
    lom_release(texture->kept.memory);
    lom_release(texture->kept.held);
    lom_release(texture->stencil);
    lom_release(texture);
}

int lom_texture_width(const lom_texture *texture)
{
    return texture->level[0].width;
}

int lom_texture_height(const lom_texture *texture)
{
    return texture->level[0].height;
}

int lom_texture_depth(const lom_texture *texture)
{
    return texture->level[0].depth;
}

int lom_texture_layers(const lom_texture *texture)
{
    return texture->layers;
}

int lom_texture_levels(const lom_texture *texture)
{
    return texture->level_count;
}

lom_format lom_texture_format(const lom_texture *texture)
{
    return texture->format;
}

const char *lom_texture_label(const lom_texture *texture)
{
    return texture->label;
}
