/* CRC-32 and Adler-32. In: bytes and the checksum so far; out: the checksum behind them. Compiled for speed. */
#include "zip.h"

#include "bytes.h"

/* CRC-32: the remainder of the message, as a polynomial over GF(2), by x^32 + x^26 + ... + 1, bits reflected. */
static const uint32_t polynomial = 0xedb88320u;

enum { SLICES = 8, WORTH_TABLES = 8192 };

/* table[s][b]: the remainder of byte b followed by s zero bytes, so that 8 bytes take 8 independent look-ups
 * (M. Kounavis, F. Berry: A systematic approach to building high performance software-based CRC generators, 2005). */
static void make_tables(uint32_t table[SLICES][256])
{
    for (uint32_t b = 0; b < 256; b++) {
        uint32_t r = b;
        for (int i = 0; i < 8; i++)
            r = (r >> 1) ^ (polynomial & (0u - (r & 1)));
        table[0][b] = r;
    }
    for (int s = 1; s < SLICES; s++)
        for (int b = 0; b < 256; b++)
            table[s][b] = (table[s - 1][b] >> 8) ^ table[0][table[s - 1][b] & 0xff];
}

static uint32_t crc_large(uint32_t r, const uint8_t **p, size_t size)
{
    uint32_t t[SLICES][256];
    make_tables(t);
    for (; size >= 8; size -= 8) {
        uint32_t low = r ^ load_32_little(*p), high = load_32_little(*p + 4);
        r = t[7][low & 0xff] ^ t[6][low >> 8 & 0xff] ^ t[5][low >> 16 & 0xff] ^ t[4][low >> 24] ^ t[3][high & 0xff] ^
            t[2][high >> 8 & 0xff] ^ t[1][high >> 16 & 0xff] ^ t[0][high >> 24];
        *p += 8;
    }
    return r;
}

/* table[0] above for the half-bytes */
static const uint32_t nibbles[16] = {
    0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac, 0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
    0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c, 0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c,
};

uint32_t lom_crc32(uint32_t crc, const void *data, size_t size)
{
    if (size == 0)
        return crc;
    const uint8_t *p = data, *end = p + size;
    uint32_t r = ~crc;
    if (size >= WORTH_TABLES)
        r = crc_large(r, &p, size);
    for (; p < end; p++) {
        r = (r >> 4) ^ nibbles[(r ^ *p) & 15];
        r = (r >> 4) ^ nibbles[(r ^ (*p >> 4)) & 15];
    }
    return ~r;
}

/* Two sums modulo 65521: a of the bytes, b of the a's. Over a block of n bytes from (a, b) they are
 * a + sum d[i] and b + n a + sum (n - i) d[i]; blocks of 5536 keep the second below 2^32 (RFC 1950, section 9). */
uint32_t lom_adler32(uint32_t adler, const void *data, size_t size)
{
    enum { MODULUS = 65521, LINE = 32, BLOCK = 173 * LINE };
    const uint8_t *p = data;
    uint32_t a = adler & 0xffff, b = adler >> 16;
    while (size != 0) {
        size_t block = size < BLOCK ? size : BLOCK, i = 0;
        for (; i + LINE <= block; i += LINE) {
            uint32_t plain = 0, weighted = 0;
            for (uint32_t j = 0; j < LINE; j++) {
                plain += p[i + j];
                weighted += (LINE - j) * p[i + j];
            }
            b += LINE * a + weighted;
            a += plain;
        }
        for (; i < block; i++) {
            a += p[i];
            b += a;
        }
        a %= MODULUS;
        b %= MODULUS;
        p += block;
        size -= block;
    }
    return b << 16 | a;
}
