/* Kinds of files that are known but not read. In: the content and the name of a file that no decoder takes. Out: words
 * that help. Each kind is a row. */
#include "foreign.h"

#include <string.h>

#define NIFTI                                                                                                          \
    "; it is NIfTI: save it as NRRD (3D Slicer and others do), or write its voxels alone to a file and give their "    \
    "size"
#define PHOTO  ": convert it to PNG first"
#define FLOATS ": convert it to PFM first"

static const struct {
    size_t at; /* where the signature stands */
    const char *signature;
    size_t length;
    const char *words;
} kinds[] = {
    { 344, "n+1", 4, NIFTI },
    { 344, "ni1", 4, NIFTI },
    { 4, "n+2", 4, NIFTI },
    { 4, "ni2", 4, NIFTI },
    { 0, "\xff\xd8\xff", 3, "; it is JPEG" PHOTO },
    { 0, "GIF8", 4, "; it is GIF" PHOTO },
    { 8, "WEBP", 4, "; it is WebP" PHOTO },
    { 0, "BM", 2, "; it may be BMP" PHOTO },
    { 0, "II*\0", 4, "; it is TIFF" PHOTO },
    { 0, "MM\0*", 4, "; it is TIFF" PHOTO },
    { 0, "v/1\1", 4, "; it is OpenEXR" FLOATS },
    { 0, "\xabKTX 20", 7, "; it is KTX of version 2: save it as version 1, or as DDS" },
    { 0, "#?RADIANCE", 10, "; it is Radiance HDR" FLOATS },
    { 0, "YUV4MPEG2", 9, "; it is y4m, a video: its frames are pictures once an encoder has unpacked them" },
};

/* Whether name ends so, in capitals or not. */
static bool ends_in(const char *name, const char *ending)
{
    size_t length = strlen(name), wanted = strlen(ending);
    if (length < wanted)
        return false;
    for (const char *p = name + length - wanted; *p != 0; p++, ending++)
        if ((*p >= 'A' && *p <= 'Z' ? *p - 'A' + 'a' : *p) != *ending)
            return false;
    return true;
}

const char *lom_foreign_kind(const uint8_t *data, size_t size, const char *name)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (size >= kinds[i].at + kinds[i].length &&
            memcmp(data + kinds[i].at, kinds[i].signature, kinds[i].length) == 0)
            return kinds[i].words;
    if (size < 2 || data[0] != 0x1f || data[1] != 0x8b)
        return "";
    return ends_in(name, ".nii.gz") ? NIFTI : "; it is compressed by gzip: unpack it first";
}
