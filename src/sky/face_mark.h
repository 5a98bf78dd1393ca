/* The six pictures of a sky box by one pattern. */
#ifndef LOM_SKY_FACE_MARK_H
#define LOM_SKY_FACE_MARK_H

/* Where the one %s of a pattern of paths stands: in the file's name, or in a folder's when the file's has none. NULL
 * for none, or for two in a name; points into pattern. Any other % is a letter like others. */
const char *lom_face_mark(const char *pattern);

#endif
