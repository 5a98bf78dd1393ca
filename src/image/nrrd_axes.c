/* What the axes of an NRRD file mean (format.html, section 6, "kinds"). In: sizes, kinds and space directions; out: one
 * axis of channels, or none, before one to three axes of space. Invariant: an axis is what its kind says; without kinds
 * it is what its direction says, and without both the first of four axes holds channels. What no image holds (moments,
 * matrices, channels in planes) is refused. */
#include "nrrd_header.h"

#include "codec.h"

#include <string.h>

typedef enum axis_meaning { AXIS_UNKNOWN, AXIS_SPACE, AXIS_TIME, AXIS_CHANNELS, AXIS_SINGLE, AXIS_OTHER } axis_meaning;

/* Every kind that the format names, with teem's other spellings; size 0: any. */
static const struct {
    const char *names;
    axis_meaning meaning;
    unsigned size;
} kinds[] = {
    { "none|???|(unknown_kind)", AXIS_UNKNOWN, 0 },
    { "domain|space", AXIS_SPACE, 0 },
    { "time", AXIS_TIME, 0 },
    { "list|point|vector|contravariant-vector|covariant-vector|normal", AXIS_CHANNELS, 0 },
    { "stub|scalar", AXIS_SINGLE, 1 },
    { "2-vector", AXIS_CHANNELS, 2 },
    { "3-vector|3-gradient|3-normal|3-color|RGB-color|RGBcolor|RGB", AXIS_CHANNELS, 3 },
    { "4-vector|4-color|RGBA-color|RGBAcolor|RGBA", AXIS_CHANNELS, 4 },
    { "complex", AXIS_OTHER, 2 },
    { "HSV-color|HSVcolor|HSV|XYZ-color", AXIS_OTHER, 3 },
    { "quaternion", AXIS_OTHER, 4 },
    { "2D-symmetric-matrix|2D-sym-matrix|2D-symmetric-tensor|2D-sym-tensor", AXIS_OTHER, 3 },
    { "2D-masked-symmetric-matrix|2D-masked-sym-matrix|2D-masked-symmetric-tensor|2D-masked-sym-tensor", AXIS_OTHER,
      4 },
    { "2D-matrix|2D-tensor", AXIS_OTHER, 4 },
    { "2D-masked-matrix|2D-masked-tensor", AXIS_OTHER, 5 },
    { "3D-symmetric-matrix|3D-sym-matrix|3D-symmetric-tensor|3D-sym-tensor", AXIS_OTHER, 6 },
    { "3D-masked-symmetric-matrix|3D-masked-sym-matrix|3D-masked-symmetric-tensor|3D-masked-sym-tensor", AXIS_OTHER,
      7 },
    { "3D-matrix|3D-tensor", AXIS_OTHER, 9 },
    { "3D-masked-matrix|3D-masked-tensor", AXIS_OTHER, 10 },
};

typedef struct axes {
    const nrrd_header *header;
    axis_meaning meaning[NRRD_MOST_DIMENSIONS];
} axes;

static bool bad_axis(const axes *a, int axis, const char *what)
{
    return lom_fail(a->header->error, LOM_ERROR_INPUT, "%s: axis %d of the NRRD file, of size %llu, %s.",
                    a->header->name, axis + 1, (unsigned long long)a->header->sizes[axis], what);
}

/* The next word of a field's value, moved past; a direction in parentheses is one word, blanks and all. */
static nrrd_text next_word(nrrd_text *rest)
{
    size_t at = 0, end;
    while (at < rest->length && (rest->start[at] == ' ' || rest->start[at] == '\t'))
        at++;
    bool inside = at < rest->length && rest->start[at] == '(';
    for (end = at; end < rest->length; end++) {
        char c = rest->start[end];
        if (inside ? c == ')' : c == ' ' || c == '\t')
            break;
    }
    end += inside && end < rest->length;
    nrrd_text word = { rest->start + at, end - at };
    *rest = (nrrd_text){ rest->start + end, rest->length - end };
    return word;
}

/* An entry for each axis. */
static bool check_count(const nrrd_header *h, const char *field, nrrd_text rest)
{
    int count = 0;
    while (next_word(&rest).length > 0)
        count++;
    return count == h->dimensions || lom_fail(h->error, LOM_ERROR_INPUT, "%s: the NRRD header has %d %s for %d axes.",
                                              h->name, count, field, h->dimensions);
}

static bool read_kind(axes *a, int axis, nrrd_text word)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (!lom_is_word(word.start, word.length, kinds[i].names))
            continue;
        a->meaning[axis] = kinds[i].meaning;
        if (kinds[i].size != 0 && a->header->sizes[axis] != kinds[i].size)
            return bad_axis(a, axis, "has a kind that has another size");
        return kinds[i].meaning != AXIS_OTHER || bad_axis(a, axis, "is of a kind that no image holds");
    }
    return bad_axis(a, axis, "is of a kind that NRRD does not name");
}

static bool read_kinds(axes *a)
{
    nrrd_text rest = a->header->kinds;
    if (rest.length == 0)
        return true;
    if (!check_count(a->header, "kinds", rest))
        return false;
    for (int i = 0; i < a->header->dimensions; i++)
        if (!read_kind(a, i, next_word(&rest)))
            return false;
    return true;
}

/* An axis whose kind is not known is one of space when it has a direction in it, and holds channels when it has none.
 */
static bool read_directions(axes *a)
{
    nrrd_text rest = a->header->directions;
    bool decides = false;
    for (int i = 0; i < a->header->dimensions; i++)
        decides = decides || a->meaning[i] == AXIS_UNKNOWN;
    if (rest.length == 0 || !decides)
        return true;
    if (!check_count(a->header, "space directions", rest))
        return false;
    for (int i = 0; i < a->header->dimensions; i++) {
        nrrd_text word = next_word(&rest);
        bool is_none = lom_is_word(word.start, word.length, "none");
        if (!is_none && word.start[0] != '(')
            return bad_axis(a, i, "has a space direction that is neither none nor a vector");
        if (a->meaning[i] == AXIS_UNKNOWN)
            a->meaning[i] = is_none ? AXIS_CHANNELS : AXIS_SPACE;
    }
    return true;
}

/* What neither kinds nor directions tell: four unknown axes begin with channels, two or three are space; and one
 * unknown axis before known ones of space holds channels. */
static void guess_unknown(axes *a)
{
    int unknown = 0, space = 0, dimensions = a->header->dimensions;
    for (int i = 0; i < dimensions; i++) {
        unknown += a->meaning[i] == AXIS_UNKNOWN;
        space += a->meaning[i] == AXIS_SPACE;
    }
    bool channels_first = a->meaning[0] == AXIS_UNKNOWN &&
                          (unknown == dimensions ? dimensions == 4 : unknown == 1 && space == dimensions - 1);
    for (int i = 0; i < dimensions; i++)
        if (a->meaning[i] == AXIS_UNKNOWN && (unknown == dimensions || channels_first))
            a->meaning[i] = i == 0 && channels_first ? AXIS_CHANNELS : AXIS_SPACE;
}

bool lom_find_nrrd_layout(const nrrd_header *h, nrrd_layout *layout)
{
    axes a = { .header = h };
    uint64_t channels = 1, size[3] = { 1, 1, 1 };
    int count = 0;
    if (!read_kinds(&a) || !read_directions(&a))
        return false;
    guess_unknown(&a);
    for (int i = 0; i < h->dimensions; i++) {
        if (h->sizes[i] == 0)
            return lom_fail(h->error, LOM_ERROR_INPUT, "%s: the header declares an empty volume.", h->name);
        if (a.meaning[i] != AXIS_SPACE && h->sizes[i] == 1)
            continue; /* one sample along an axis: whatever it means, it is no axis of the image */
        if (a.meaning[i] == AXIS_UNKNOWN)
            return bad_axis(&a, i, "is of a kind that is not given");
        if (a.meaning[i] == AXIS_TIME)
            return bad_axis(&a, i, "is time, and an image is of one moment");
        if (a.meaning[i] == AXIS_CHANNELS && i > 0)
            return bad_axis(&a, i, "holds channels, and can be read only as the first axis");
        if (a.meaning[i] == AXIS_CHANNELS) {
            channels = h->sizes[i];
            continue;
        }
        if (count == 3)
            return bad_axis(&a, i, "is the fourth axis of space");
        if (h->sizes[i] > LOM_MAX_SIZE)
            return lom_fail(h->error, LOM_ERROR_LIMIT, "%s: the header declares more than %d voxels a side.", h->name,
                            LOM_MAX_SIZE);
        size[count++] = h->sizes[i];
    }
    if (channels > 4)
        return lom_fail(h->error, LOM_ERROR_INPUT, "%s: a volume has 1 to 4 channels.", h->name);
    *layout = (nrrd_layout){ (int)channels, (int)size[0], (int)size[1], (int)size[2] };
    return true;
}
