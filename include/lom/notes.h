/* lom/notes.h - values of a shader by name, for whoever watches a pixel (lom/record.h, lom explain).
 *
 * LOM_NAME_VALUE(x) gives the record of a watched fragment or vertex the value of x, a lom_float, lom_float2, lom_float3
 * or lom_float4, under its own name. It is code in the recorded variant alone, which watched passes are drawn with; in
 * every other variant it is nothing.
 */
#ifndef LOM_NOTES_H
#define LOM_NOTES_H

#include <lom/lanes.h>

LOM_API_BEGIN

/* What a note is about. In the order of its rows, each four lanes: */
typedef enum lom_note_kind {
    LOM_NOTE_VALUE,     /* a value of `name`: its components */
    LOM_NOTE_LOOKUP,    /* a texture is looked up: s, t, r, level of detail as asked, level as chosen, face (bits) */
    LOM_NOTE_FOOTPRINT, /* of the lookup before: index of the first texel (bits), weights of the second along s, t, r */
    LOM_NOTE_TEXEL,     /* one texel of a texture: column, row (bits), level */
    LOM_NOTE_RESULT,    /* of the lookup or texel before: red, green, blue, alpha */
    LOM_NOTE_RAY,       /* a ray is marched through a medium: where it enters and leaves, metres a step */
    LOM_NOTE_STEP,      /* of the ray before: distance, length, density, whether the ray is there (bits) */
    LOM_NOTE_LIGHT      /* of the step before: share of the pixel, transmittance behind it, light of sun, sky, ground */
} lom_note_kind;

/* Adds a note of `count` rows of four floats, copied, when this thread watches; else does nothing. name: not copied. */
void lom_note(lom_note_kind kind, const char *name, const void *object, const void *rows, size_t count);

/* LOM_NAME_AS(name, x): the same under another name. LOM_NAME_BY(text, x): under the name that a string holds, which must
 * last as long as the record; NULL: not at all. */
#ifdef LOM_RECORD
#define LOM_NAME_AS(name, x)                                                                                           \
    do {                                                                                                               \
        __typeof__(x) lom_named = (x);                                                                                 \
        lom_note(LOM_NOTE_VALUE, #name, NULL, &lom_named, sizeof lom_named / sizeof(lom_float));                       \
    } while (0)
#define LOM_NAME_BY(text, x)                                                                                           \
    do {                                                                                                               \
        const char *lom_name = (text);                                                                                 \
        __typeof__(x) lom_named = (x);                                                                                 \
        if (lom_name != NULL)                                                                                          \
            lom_note(LOM_NOTE_VALUE, lom_name, NULL, &lom_named, sizeof lom_named / sizeof(lom_float));                \
    } while (0)
#define LOM_NAME_VALUE(x) LOM_NAME_AS(x, x)
#else
#define LOM_NAME_AS(name, x) ((void)sizeof(x))
#define LOM_NAME_BY(text, x) ((void)sizeof(x))
#define LOM_NAME_VALUE(x)    ((void)sizeof(x))
#endif

LOM_API_END

#endif
