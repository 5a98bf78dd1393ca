/* What options, helps and docs say of the kinds of picture files. In: the table of codecs. Out: words and lines.
 * Invariant: no kind of picture is named here. */
#include "picture_kinds.h"

#include <stdlib.h>
#include <string.h>

/* The index-th codec that writes, of those that are no video unless `videos`. */
static const char *written(size_t index, bool videos)
{
    const lom_codec_info *info;
    for (size_t i = 0; (info = lom_describe_codec(i)) != NULL; i++)
        if (info->writes && (videos || !info->is_video) && index-- == 0)
            return info->name;
    return NULL;
}

const char *lom_picture_choice(size_t index)
{
    return written(index, false);
}

const char *lom_frame_choice(size_t index)
{
    return written(index, true);
}

const char *lom_conversion_choice(size_t index)
{
    const char *name = written(index, false);
    bool is_next = name == NULL && (index == 0 || written(index - 1, false) != NULL);
    return is_next ? "obj" : name;
}

/* "8, 16, float" and "1, 3": what a file holds, in small numbers. */
static void list_samples(const lom_codec_info *info, char *bits, char *channels, size_t room)
{
    size_t used = 0, length = 0;
    for (unsigned b = 8; b <= 32; b *= 2)
        if (info->bits & b) {
            const char *name = b == 8 ? "8" : b == 16 ? "16" : "float";
            used += (size_t)snprintf(bits + used, room - used, "%s%s", used > 0 ? ", " : "", name);
        }
    for (int n = 1; n <= 4; n++)
        if (info->channels[n] == n)
            length += (size_t)snprintf(channels + length, room - length, "%s%d", length > 0 ? ", " : "", n);
}

static void print_kind(FILE *out, const lom_codec_info *info)
{
    char bits[32] = "", channels[32] = "", endings[64] = "";
    list_samples(info, bits, channels, sizeof bits);
    for (const char *at = info->endings; *at != 0;) {
        size_t length = strcspn(at, "|"), used = strlen(endings);
        snprintf(endings + used, sizeof endings - used, "%s.%.*s", used > 0 ? " " : "", (int)length, at);
        at += length + (at[length] != 0);
    }
    const char *note = info->is_video ? "video" : info->holds_slices ? "volumes" : "";
    fprintf(out, "  %-6s%-11s%-8s%-6s%-7s%-15s%-*s%s\n", info->name, info->title, endings, info->reads ? "yes" : "no",
            info->writes ? "yes" : "no", bits, note[0] != 0 ? 12 : 0, channels, note);
}

void lom_print_picture_kinds(FILE *out)
{
    fprintf(out, "\nkinds of picture files:\n  %-6s%-11s%-8s%-6s%-7s%-15s%s\n", "name", "format", "ending", "read",
            "write", "bits", "channels");
    for (size_t i = 0; lom_describe_codec(i) != NULL; i++)
        print_kind(out, lom_describe_codec(i));
}

bool lom_write_format_documentation(const char *path, lom_error *error)
{
    char *page = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&page, &size);
    if (out == NULL)
        return lom_fail(error, LOM_ERROR_MEMORY, "There is no memory for the page.");
    fputs("# Picture files\n\n<!-- made by `lom make format-docs -o docs/formats.md` from the table of codecs; do not "
          "edit "
          "-->\n\nA file is read by its content, whatever its name, and written by `--format` or the ending of its "
          "name.\n"
          "Channels are 1 gray, 2 gray and alpha, 3 RGB, 4 RGB and alpha; `float` are 32-bit floats.\n\n```\n",
          out);
    lom_print_picture_kinds(out);
    fputs("```\n", out);
    bool whole = fclose(out) == 0;
    bool written_all = whole && lom_write_file(path, page, size, error);
    free(page);
    return written_all || lom_fail(error, LOM_ERROR_MEMORY, "There is no memory for the page.");
}
