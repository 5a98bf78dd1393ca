/* Pixels of four bytes as two channels in 16 bits each, in which products of two channels fit. */
#ifndef LOM_LANES_CHANNELS_H
#define LOM_LANES_CHANNELS_H

#include <lom/lanes.h>

/* The first and the second channel of LOM_LANES pixels, in whatever order; with LOM_OVERRIDES_CHANNELS number i and number i + 4
 * where bit 4 of i is 0, else the low and the high half of a word, which order of bytes a machine may have. */
typedef uint16_t pairs __attribute__((vector_size(LOM_LANES * 4)));

/* Red and blue, green and alpha. */
struct channels {
    pairs rb, ga;
};

#if ((LOM_LANES == 8 && defined __AVX2__) || defined LOM_HAS_AVX512) && !defined LOM_NO_OVERRIDES
/* As the instructions have it that narrow two vectors to one: in 16 bytes four pixels, first channels, then second ones.
 * Bytes are four reds, blues, greens, alphas on the way. */
#define LOM_OVERRIDES_CHANNELS
#endif

LOM_INLINE pairs splat_pairs(uint16_t value)
{
    return value - (pairs){ 0 };
}

#ifndef LOM_OVERRIDES_CHANNELS

/* -1 in one of two channels. */
LOM_INLINE pairs second_channels(void)
{
    return (pairs)lom_splat_uint(0xffff0000);
}

/* first | second << 16 of the first pixel; and the same in all pixels. */
LOM_INLINE uint32_t first_pair(pairs x)
{
    return ((lom_uint)x)[0];
}

LOM_INLINE pairs splat_pair(uint32_t pair)
{
    return (pairs)lom_splat_uint(pair);
}

/* Of whole numbers up to 255, where one below 0 counts as 0 with LOM_OVERRIDES_CHANNELS, and is not given without. */
LOM_INLINE struct channels narrow(lom_int red, lom_int green, lom_int blue, lom_int alpha)
{
    return (struct channels){ (pairs)(red | blue << 16), (pairs)(green | alpha << 16) };
}

LOM_INLINE struct channels split(lom_int packed)
{
    return (struct channels){ (pairs)(packed & 0xff00ff), (pairs)(packed >> 8 & 0xff00ff) };
}

LOM_INLINE lom_int join(struct channels c)
{
    return (lom_int)c.rb | (lom_int)c.ga << 8;
}

/* Alpha in both channels. */
LOM_INLINE pairs alpha_of(struct channels c)
{
    lom_int alpha = (lom_int)((lom_uint)c.ga >> 16);
    return (pairs)(alpha | alpha << 16);
}

#else

enum { SECOND_CHANNEL = 4 };

LOM_INLINE pairs second_channels(void)
{
    pairs second = { 0 };
    for (int i = 0; i < 2 * LOM_LANES; i++)
        second[i] = (i & SECOND_CHANNEL) != 0 ? UINT16_MAX : 0;
    return second;
}

LOM_INLINE uint32_t first_pair(pairs x)
{
    return x[0] | (uint32_t)x[SECOND_CHANNEL] << 16;
}

LOM_INLINE pairs splat_pair(uint32_t pair)
{
    const pairs second = second_channels();
    return (second & (uint16_t)(pair >> 16)) | (~second & (uint16_t)pair);
}

#endif

#if defined LOM_OVERRIDES_CHANNELS && LOM_LANES == 16

/* Towards zero, of what is below 2^31; INT32_MIN of NaN and of what is no int. */
LOM_INLINE lom_int to_narrowed(lom_float x)
{
    return (lom_int)_mm512_cvttps_epi32((__m512)x);
}

LOM_INLINE struct channels narrow(lom_int red, lom_int green, lom_int blue, lom_int alpha)
{
    return (struct channels){ (pairs)_mm512_packus_epi32((__m512i)red, (__m512i)blue),
                              (pairs)_mm512_packus_epi32((__m512i)green, (__m512i)alpha) };
}

LOM_INLINE struct channels split(lom_int packed)
{
    const __m512i planes = _mm512_set4_epi32(0x0f0b0703, 0x0d090501, 0x0e0a0602, 0x0c080400), none = { 0 };
    __m512i x = _mm512_shuffle_epi8((__m512i)packed, planes);
    return (struct channels){ (pairs)_mm512_unpacklo_epi8(x, none), (pairs)_mm512_unpackhi_epi8(x, none) };
}

LOM_INLINE lom_int join(struct channels c)
{
    const __m512i pixels = _mm512_set4_epi32(0x0f070b03, 0x0e060a02, 0x0d050901, 0x0c040800);
    return (lom_int)_mm512_shuffle_epi8(_mm512_packus_epi16((__m512i)c.rb, (__m512i)c.ga), pixels);
}

LOM_INLINE pairs alpha_of(struct channels c)
{
    return (pairs)_mm512_unpackhi_epi64((__m512i)c.ga, (__m512i)c.ga);
}

#elif defined LOM_OVERRIDES_CHANNELS

LOM_INLINE lom_int to_narrowed(lom_float x)
{
    return (lom_int)_mm256_cvttps_epi32((__m256)x);
}

LOM_INLINE struct channels narrow(lom_int red, lom_int green, lom_int blue, lom_int alpha)
{
    return (struct channels){ (pairs)_mm256_packus_epi32((__m256i)red, (__m256i)blue),
                              (pairs)_mm256_packus_epi32((__m256i)green, (__m256i)alpha) };
}

LOM_INLINE struct channels split(lom_int packed)
{
    const __m256i planes = _mm256_setr_epi32(0x0c080400, 0x0e0a0602, 0x0d090501, 0x0f0b0703, 0x0c080400, 0x0e0a0602,
                                             0x0d090501, 0x0f0b0703),
                  none = { 0 };
    __m256i x = _mm256_shuffle_epi8((__m256i)packed, planes);
    return (struct channels){ (pairs)_mm256_unpacklo_epi8(x, none), (pairs)_mm256_unpackhi_epi8(x, none) };
}

LOM_INLINE lom_int join(struct channels c)
{
    const __m256i pixels = _mm256_setr_epi32(0x0c040800, 0x0d050901, 0x0e060a02, 0x0f070b03, 0x0c040800, 0x0d050901,
                                             0x0e060a02, 0x0f070b03);
    return (lom_int)_mm256_shuffle_epi8(_mm256_packus_epi16((__m256i)c.rb, (__m256i)c.ga), pixels);
}

LOM_INLINE pairs alpha_of(struct channels c)
{
    return (pairs)_mm256_unpackhi_epi64((__m256i)c.ga, (__m256i)c.ga);
}

#endif

/* Those that are above 255 as 255; none is above 510. */
LOM_INLINE lom_int join_bounded(struct channels c)
{
#ifdef LOM_OVERRIDES_CHANNELS
    return join(c); /* which narrows so */
#else
    pairs rb = (pairs)(c.rb > 255), ga = (pairs)(c.ga > 255);
    return join((struct channels){ (c.rb | rb) & 255, (c.ga | ga) & 255 });
#endif
}

/* round(v / 255) of t = v + 128, v at most 255^2: (t + (t >> 8)) >> 8, which is 257 t >> 16. */
LOM_INLINE pairs divide_shifted_by_255(pairs t)
{
#if !defined __x86_64__ || defined LOM_NO_OVERRIDES
    return (t + (t >> 8)) >> 8;
#elif LOM_LANES == 4
    return (pairs)_mm_mulhi_epu16((__m128i)t, _mm_set1_epi16(257));
#elif LOM_LANES == 8 && defined __AVX2__
    return (pairs)_mm256_mulhi_epu16((__m256i)t, _mm256_set1_epi16(257));
#elif defined LOM_HAS_AVX512
    return (pairs)_mm512_mulhi_epu16((__m512i)t, _mm512_set1_epi16(257));
#else
    return (t + (t >> 8)) >> 8;
#endif
}

/* round(v / 255), v at most 255^2. */
LOM_INLINE pairs divide_by_255(pairs v)
{
    return divide_shifted_by_255(v + 128);
}

#endif
