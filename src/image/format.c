/* The facts of every pixel format, as one table. */
#include <lom/image.h>

static const lom_format_info formats[LOM_FORMAT_COUNT] = {
    [LOM_FORMAT_R8] = { "R8", 1, 8, false, false, false },
    [LOM_FORMAT_RG8] = { "RG8", 2, 8, false, false, false },
    [LOM_FORMAT_RGB8] = { "RGB8", 3, 8, false, false, false },
    [LOM_FORMAT_RGBA8] = { "RGBA8", 4, 8, false, false, false },
    [LOM_FORMAT_R8_SRGB] = { "R8 sRGB", 1, 8, false, true, false },
    [LOM_FORMAT_RG8_SRGB] = { "RG8 sRGB", 2, 8, false, true, false },
    [LOM_FORMAT_RGB8_SRGB] = { "RGB8 sRGB", 3, 8, false, true, false },
    [LOM_FORMAT_RGBA8_SRGB] = { "RGBA8 sRGB", 4, 8, false, true, false },
    [LOM_FORMAT_R16] = { "R16", 1, 16, false, false, false },
    [LOM_FORMAT_RG16] = { "RG16", 2, 16, false, false, false },
    [LOM_FORMAT_RGB16] = { "RGB16", 3, 16, false, false, false },
    [LOM_FORMAT_RGBA16] = { "RGBA16", 4, 16, false, false, false },
    [LOM_FORMAT_R16F] = { "R16F", 1, 16, true, false, false },
    [LOM_FORMAT_RG16F] = { "RG16F", 2, 16, true, false, false },
    [LOM_FORMAT_RGB16F] = { "RGB16F", 3, 16, true, false, false },
    [LOM_FORMAT_RGBA16F] = { "RGBA16F", 4, 16, true, false, false },
    [LOM_FORMAT_R32F] = { "R32F", 1, 32, true, false, false },
    [LOM_FORMAT_RG32F] = { "RG32F", 2, 32, true, false, false },
    [LOM_FORMAT_RGB32F] = { "RGB32F", 3, 32, true, false, false },
    [LOM_FORMAT_RGBA32F] = { "RGBA32F", 4, 32, true, false, false },
    [LOM_FORMAT_DEPTH16] = { "DEPTH16", 1, 16, false, false, true },
    [LOM_FORMAT_DEPTH24] = { "DEPTH24", 1, 32, false, false, true },
    [LOM_FORMAT_DEPTH32F] = { "DEPTH32F", 1, 32, true, false, true },
};

const lom_format_info *lom_describe_format(lom_format format)
{
    return (unsigned)format < LOM_FORMAT_COUNT && format != LOM_FORMAT_NONE ? &formats[format] : NULL;
}

size_t lom_format_size(lom_format format)
{
    const lom_format_info *info = lom_describe_format(format);
    return info != NULL ? (size_t)info->channels * (size_t)info->bits / 8 : 0;
}
