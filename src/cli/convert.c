/* `lom convert`. In: an image, a volume or a mesh. Out: the same in another kind of file. Invariant: what both kinds
 * can hold is kept exactly; samples that change their depth are rounded correctly; OUT is complete or untouched. */
#include "commands.h"
#include "options.h"
#include "paths.h"
#include "picture_kinds.h"

#include <lom/geometry.h>

#include <string.h>
#include <sys/stat.h>

struct values {
    const char *format, *bits;
    lom_option_integers channels, voxels;
    bool srgb;
};

static const lom_option options[] = {
    { .name = "format",
      .kind = LOM_OPTION_CHOICE,
      .field = offsetof(struct values, format),
      .help = "the kind of OUT, whatever it is called" },
    { .name = "bits",
      .kind = LOM_OPTION_CHOICE,
      .field = offsetof(struct values, bits),
      .value = "8|16|32",
      .help = "bits a sample; as in IN by default, 8 from floats but in nrrd; 32 are floats" },
    { .name = "channels",
      .kind = LOM_OPTION_INTEGER,
      .field = offsetof(struct values, channels),
      .value = "N",
      .minimum = 1,
      .maximum = 4,
      .help = "1 gray, 2 gray and alpha, 3 RGB, 4 RGB and alpha" },
    { .name = "voxels",
      .kind = LOM_OPTION_INTEGER,
      .field = offsetof(struct values, voxels),
      .value = "WxHxD",
      .minimum = 1,
      .maximum = LOM_MAX_SIZE,
      .help = "IN is raw: voxels along x, y, z, of 8 or 16 bits or floats, little-endian" },
    { .name = "srgb",
      .kind = LOM_OPTION_FLAG,
      .field = offsetof(struct values, srgb),
      .help = "8-bit samples are sRGB-encoded: decode them to pfm, encode them from pfm" },
};

static const lom_command_line line = {
    .name = "convert",
    .arguments = "IN OUT",
    .summary = "Writes an image, a volume or a mesh in another form",
    .choice = lom_conversion_choice,
    .details =
        "The kind of OUT is its ending or --format. IN is told by its content. Samples keep their value in 0..1, "
        "correctly\n"
        "rounded; without --srgb no transfer function is applied. Gray of colours is Rec. 709 luminance of the samples "
        "as\n"
        "they are.\n"
        "An obj is written with its normals, one triangle a face; its materials go to OUT with the extension mtl.",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum_arguments = 2,
    .maximum_arguments = 2,
    .print_more = lom_print_picture_kinds,
};

static lom_format file_format(int channels, int bits, bool is_srgb)
{
    static const lom_format formats[4][4] = {
        { LOM_FORMAT_R8, LOM_FORMAT_RG8, LOM_FORMAT_RGB8, LOM_FORMAT_RGBA8 },
        { LOM_FORMAT_R8_SRGB, LOM_FORMAT_RG8_SRGB, LOM_FORMAT_RGB8_SRGB, LOM_FORMAT_RGBA8_SRGB },
        { LOM_FORMAT_R16, LOM_FORMAT_RG16, LOM_FORMAT_RGB16, LOM_FORMAT_RGBA16 },
        { LOM_FORMAT_R32F, LOM_FORMAT_RG32F, LOM_FORMAT_RGB32F, LOM_FORMAT_RGBA32F },
    };
    return formats[bits == 32 ? 3 : bits == 16 ? 2 : is_srgb][channels - 1];
}

/* In files two channels are gray and alpha, to lom_convert_image red and green. So they pass through four channels:
 * this spreads 2 (gray, alpha) to 4 (gray, gray, gray, alpha), or gathers 4 to 2. */
static lom_image *regroup(const lom_image *image, bool is_srgb, int to, lom_error *error)
{
    const lom_format_info *info = lom_describe_format(image->format);
    lom_image *result =
        lom_create_image(image->width, image->height, image->depth, file_format(to, info->bits, is_srgb), error);
    if (result == NULL)
        return NULL;
    static const int source[5][4] = { [2] = { 0, 3 }, [4] = { 0, 0, 0, 1 } };
    size_t bytes = (size_t)info->bits / 8, in = lom_format_size(image->format), out = lom_format_size(result->format);
    size_t pixels = lom_image_size(image) / in;
    for (size_t i = 0; i < pixels; i++)
        for (int c = 0; c < to; c++)
            memcpy(result->pixels + i * out + (size_t)c * bytes, image->pixels + i * in + (size_t)source[to][c] * bytes,
                   bytes);
    return result;
}

/* Replaces *image by result unless that failed. */
static bool replace(lom_image **image, lom_image *result)
{
    if (result == NULL)
        return false;
    lom_free_image(*image);
    *image = result;
    return true;
}

static bool convert_to_format(lom_image **image, lom_format format, lom_error *error)
{
    return (*image)->format == format || replace(image, lom_convert_image(*image, format, error));
}

/* Gray of colours is made by conversion to one channel, which has no alpha; so the gray is put beside the alpha of the
 * four channels. */
static bool convert_to_gray_alpha(lom_image **image, int bits, bool is_srgb, lom_error *error)
{
    if (!convert_to_format(image, file_format(4, bits, is_srgb), error))
        return false;
    lom_image *gray = lom_convert_image(*image, file_format(1, bits, is_srgb), error);
    if (gray == NULL)
        return false;
    size_t bytes = (size_t)bits / 8, pixels = lom_image_size(gray) / bytes;
    for (size_t i = 0; i < pixels; i++)
        memcpy((*image)->pixels + 4 * i * bytes, gray->pixels + i * bytes, bytes);
    lom_free_image(gray);
    return replace(image, regroup(*image, is_srgb, 2, error));
}

/* The bits of the samples that are written: those that were asked for, else those that are there or the nearest that
 * the codec holds. 0 after a failure. */
static int choose_bits(const lom_codec_info *codec, int from, const char *asked, lom_error *error)
{
    int bits = asked == NULL ? from : strcmp(asked, "8") == 0 ? 8 : strcmp(asked, "16") == 0 ? 16 : 32;
    if (codec->bits & (unsigned)bits)
        return bits;
    if (asked == NULL)
        return codec->bits & 8 ? 8 : codec->bits & 16 ? 16 : 32;
    lom_fail(error, LOM_ERROR_USAGE, "A %s file cannot hold %s.", codec->name,
             bits == 32   ? "floats"
             : bits == 16 ? "16 bits a sample"
                          : "8 bits a sample");
    return 0;
}

static bool reshape(lom_image **image, const lom_codec_info *codec, const struct values *values, lom_error *error)
{
    const lom_format_info *from = lom_describe_format((*image)->format);
    int channels = values->channels.given ? (int)values->channels.value[0] : codec->channels[from->channels];
    if (codec->channels[channels] != channels)
        return lom_fail(error, LOM_ERROR_USAGE, "A %s file cannot hold %d channels.", codec->name, channels);
    int bits = choose_bits(codec, from->bits, values->bits, error);
    if (bits == 0)
        return false;
    bool srgb = values->srgb && from->is_float != (bits == 32);
    if (srgb && (from->is_float ? bits : from->bits) != 8)
        return lom_fail(error, LOM_ERROR_USAGE, "--srgb is for samples of 8 bits.");
    bool srgb_in = srgb && !from->is_float, srgb_out = srgb && from->is_float;
    if (srgb_in && !lom_reinterpret_image(*image, file_format(from->channels, 8, true), error))
        return false;
    if (channels == 2 && from->channels == 2) /* sample by sample */
        return convert_to_format(image, file_format(2, bits, srgb_out), error);
    if (from->channels == 2 && !replace(image, regroup(*image, srgb_in, 4, error)))
        return false;
    if (channels == 2)
        return convert_to_gray_alpha(image, bits, srgb_out, error);
    return convert_to_format(image, file_format(channels, bits, srgb_out), error);
}

static bool convert_image(const char *in, const char *out, const struct values *values, lom_error *error)
{
    const lom_codec_info *codec = lom_find_codec(out, values->format);
    if (codec == NULL || !codec->writes || codec->is_video) {
        char names[200] = "";
        for (size_t i = 0; lom_picture_choice(i) != NULL; i++)
            snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i > 0 ? ", " : "",
                     lom_picture_choice(i));
        return lom_fail(error, LOM_ERROR_USAGE, "%s: its extension is none of %s; --format can say what it is to be.",
                        out, names);
    }
    const int size[3] = { (int)values->voxels.value[0], (int)values->voxels.value[1], (int)values->voxels.value[2] };
    lom_image *image = values->voxels.given ? lom_read_volume(in, size, error) : lom_read_image(in, error);
    bool done =
        image != NULL && reshape(&image, codec, values, error) && lom_write_image(out, codec->name, image, error);
    lom_free_image(image);
    return done;
}

/* The path of OUT's material file: its extension is mtl. */
static char *name_materials(const char *out, lom_error *error)
{
    const char *extension = lom_path_extension(out);
    size_t stem = strlen(out) - (*extension != 0 ? strlen(extension) + 1 : 0);
    char *path = lom_allocate(stem + sizeof ".mtl", 1, error);
    if (path == NULL)
        return NULL;
    memcpy(path, out, stem);
    memcpy(path + stem, ".mtl", sizeof ".mtl");
    return path;
}

static lom_writer *write_text(const char *path, lom_bytes text, lom_error *error)
{
    lom_writer *writer = text.data != NULL ? lom_open_writer(path, error) : NULL;
    if (writer != NULL && !lom_append(writer, text.data, text.size, error)) {
        lom_abandon_writer(writer);
        writer = NULL;
    }
    lom_release(text.data);
    return writer;
}

/* The mesh and its materials (path NULL: without): both files are written before either takes its place. */
static bool write_mesh(const lom_mesh *mesh, const char *out, const char *path, lom_error *error)
{
    lom_writer *materials = path != NULL ? write_text(path, lom_encode_mtl(mesh, error), error) : NULL;
    if (path != NULL && materials == NULL)
        return false;
    const char *name = path != NULL ? lom_path_file(path) : NULL;
    lom_writer *writer = write_text(out, lom_encode_obj(mesh, name, error), error);
    if (writer == NULL) {
        lom_abandon_writer(materials);
        return false;
    }
    bool done = materials == NULL || lom_close_writer(materials, error);
    if (done)
        return lom_close_writer(writer, error);
    lom_abandon_writer(writer);
    return false;
}

static bool convert_mesh(const char *in, const char *out, lom_error *error)
{
    if (lom_path_is(out, "mtl"))
        return lom_fail(
            error, LOM_ERROR_USAGE,
            "%s: an obj's materials go to its name with the extension mtl, which this is: give OUT another.", out);
    lom_mesh *mesh = lom_read_obj(in, error);
    if (mesh == NULL)
        return false;
    lom_tell_warnings(mesh->warnings.text, mesh->warnings.count);
    struct stat status; /* a device has no place beside it */
    bool special = strcmp(out, "-") == 0 || (stat(out, &status) == 0 && !S_ISREG(status.st_mode));
    bool alone = special || mesh->material_count == 0;
    char *path = alone ? NULL : name_materials(out, error);
    bool done = (alone || path != NULL) && write_mesh(mesh, out, path, error);
    lom_release(path);
    lom_free_mesh(mesh);
    return done;
}

int lom_command_convert(int argc, char **argv)
{
    struct values values = { .format = NULL };
    lom_arguments arguments;
    int status;
    if (!lom_parse_options(&line, argc, argv, &values, &arguments, &status))
        return status;
    const char *in = arguments.items[0], *out = arguments.items[1];
    bool to_mesh = values.format != NULL ? strcmp(values.format, "obj") == 0 : lom_path_is(out, "obj");
    bool from_mesh = lom_path_is(in, "obj");
    if (from_mesh && !to_mesh)
        return lom_complain("%s is a mesh: it can be converted to obj only, not to %s.", in, out);
    if (to_mesh && !from_mesh && strcmp(in, "-") != 0)
        return lom_complain("%s is no mesh: %s can be made of an obj file only.", in, out);
    if (to_mesh && (values.bits != NULL || values.channels.given || values.srgb))
        return lom_complain("%s is a mesh: --bits, --channels and --srgb are for images.", in);
    lom_error error = { .code = LOM_OK };
    bool done = to_mesh ? convert_mesh(in, out, &error) : convert_image(in, out, &values, &error);
    return done ? LOM_EXIT_DONE : lom_complain_error(&error);
}
