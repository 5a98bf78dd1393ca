/* Elements of two vectors in another order. In: vectors of one type; out: a vector of that type whose elements are
 * those that the indices name, the first vector's from 0 on, then the second's. Invariant: one instruction or a few, by
 * the built-in function that the compiler has: gcc 11 has only __builtin_shuffle, clang only the other. */
#ifndef LOM_BASE_SHUFFLE_H
#define LOM_BASE_SHUFFLE_H

#if defined __has_builtin
#if __has_builtin(__builtin_shufflevector)
#define LOM_HAS_SHUFFLEVECTOR
#endif
#endif

/* indices is the type of a vector of as many integers of the elements' size. */
#ifdef LOM_HAS_SHUFFLEVECTOR
#define LOM_SHUFFLE(a, b, indices, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
#define LOM_SHUFFLE(a, b, indices, ...) __builtin_shuffle(a, b, (indices){ __VA_ARGS__ })
#endif

#endif
