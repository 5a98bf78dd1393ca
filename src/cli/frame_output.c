/* Where the frames of a run go. In: OUT, and pictures one after another. Out: numbered files, or a video that grows
 * beside its name until the run ends. Invariant: what cannot be written is refused before anything is drawn. */
#include "frame_output.h"

#include "paths.h"

#include <stdio.h>
#include <string.h>

/* ---- names ---- */

/* The length of a %d or %04d that text begins with, 0 for none; *digits is how wide the number is at least. */
static size_t mark_length(const char *text, int *digits)
{
    const char *end = text + 1;
    *digits = 0;
    while (*text == '%' && *end >= '0' && *end <= '9' && *digits <= 20)
        *digits = *digits * 10 + (*end++ - '0');
    return *text == '%' && *end == 'd' && *digits <= 20 ? (size_t)(end + 1 - text) : 0;
}

static int count_marks(const char *pattern)
{
    int count = 0, digits;
    for (const char *p = lom_path_file(pattern); *p != 0; p++) {
        count += mark_length(p, &digits) != 0;
        p += p[0] == '%' && p[1] == '%';
    }
    return count;
}

char *lom_name_frame(const char *pattern, int frame, lom_error *error)
{
    enum { LONGEST_NUMBER = 32 };
    const char *p = lom_path_file(pattern);
    size_t length = (size_t)(p - pattern), room = strlen(pattern) + LONGEST_NUMBER;
    if (count_marks(pattern) > 1) {
        lom_fail(error, LOM_ERROR_USAGE, "%s: the frame's number is written as %%d or %%04d, once.", pattern);
        return NULL;
    }
    char *name = lom_allocate(room, 1, error);
    if (name == NULL)
        return NULL;
    memcpy(name, pattern, length);
    while (*p != 0) {
        int digits;
        size_t mark = mark_length(p, &digits);
        if (mark != 0)
            length += (size_t)snprintf(name + length, room - length, "%0*d", digits, frame);
        else
            name[length++] = *p;
        p += mark != 0 ? mark : p[0] == '%' && p[1] == '%' ? 2 : 1;
    }
    return name;
}

/* ---- kinds ---- */

static bool is_video(const struct lom_frame_output *o)
{
    const lom_codec_info *codec = lom_find_codec(o->pattern, o->format);
    return codec != NULL && codec->is_video;
}

static const char *kind_of(const struct lom_frame_output *o)
{
    return o->format != NULL ? o->format : strcmp(o->pattern, "-") == 0 ? "png" : lom_path_extension(o->pattern);
}

/* Videos that others write from y4m. */
static bool refuse_encoded_video(const struct lom_frame_output *o, lom_error *error)
{
    static const char *const endings[] = { "mp4", "m4v",  "mkv", "webm", "mov", "avi",
                                           "mpg", "mpeg", "ogv", "wmv",  "flv", "ts" };
    for (size_t i = 0; o->format == NULL && i < sizeof endings / sizeof endings[0]; i++)
        if (lom_path_is(o->pattern, endings[i]))
            return !lom_fail(error, LOM_ERROR_USAGE,
                             "%s: a video is written as y4m, which encoders read: lom render SCENE --frames all -o - "
                             "--format y4m | ffmpeg -i - %s",
                             o->pattern, lom_path_file(o->pattern));
    return false;
}

/* One pixel of the format is encoded: what that cannot do, no frame can. */
static bool check_kind(const struct lom_frame_output *o, lom_output_format format, lom_error *error)
{
    static const lom_format formats[] = { [LOM_OUTPUT_RGB8] = LOM_FORMAT_RGB8,
                                          [LOM_OUTPUT_RGB16] = LOM_FORMAT_RGB16,
                                          [LOM_OUTPUT_RGB32F] = LOM_FORMAT_RGB32F };
    lom_error encoding = { .code = LOM_OK };
    lom_image *pixel = lom_create_image(1, 1, 1, formats[format], error);
    if (pixel == NULL)
        return false;
    lom_bytes bytes =
        is_video(o) ? lom_encode_y4m_frame(pixel, &encoding) : lom_encode_image(kind_of(o), pixel, &encoding);
    bool done = bytes.data != NULL;
    lom_release(bytes.data);
    lom_free_image(pixel);
    return done || lom_fail(error, encoding.code, "%s: %s", o->pattern, encoding.text);
}

bool lom_check_frame_output(const struct lom_frame_output *o, lom_output_format format, int frames, lom_error *error)
{
    if (o->pattern == NULL)
        return true;
    if (refuse_encoded_video(o, error) || !check_kind(o, format, error))
        return false;
    if (frames > 1 && !is_video(o) && count_marks(o->pattern) == 0)
        return lom_fail(error, LOM_ERROR_USAGE, "%s: several frames need a %%04d in the file's name, or y4m.",
                        o->pattern);
    char *name = lom_name_frame(o->pattern, 0, error);
    lom_release(name);
    return name != NULL;
}

/* ---- writing ---- */

static bool append_to_video(struct lom_frame_output *o, lom_bytes part, lom_error *error)
{
    bool done = part.data != NULL && lom_append(o->video, part.data, part.size, error);
    lom_release(part.data);
    return done;
}

static bool open_video(struct lom_frame_output *o, const lom_image *image, lom_error *error)
{
    char *name = lom_name_frame(o->pattern, 0, error);
    o->video = name != NULL ? lom_open_writer(name, error) : NULL;
    lom_release(name);
    int rate = lom_int_of(o->fps * 1000 + 0.5);
    return o->video != NULL &&
           append_to_video(o, lom_encode_y4m_header(image->width, image->height, rate, 1000, error), error);
}

bool lom_write_frame(struct lom_frame_output *o, const lom_image *image, int frame, lom_error *error)
{
    if (o->pattern == NULL)
        return true;
    if (is_video(o))
        return (o->video != NULL || open_video(o, image, error)) &&
               append_to_video(o, lom_encode_y4m_frame(image, error), error);
    char *name = lom_name_frame(o->pattern, frame, error);
    bool done = name != NULL && lom_write_image(name, kind_of(o), image, error);
    lom_release(name);
    return done;
}

bool lom_end_frame_output(struct lom_frame_output *o, bool keep, lom_error *error)
{
    lom_writer *video = o->video;
    o->video = NULL;
    if (video == NULL || !keep) {
        lom_abandon_writer(video);
        return true;
    }
    return lom_close_writer(video, error);
}
