/* FNV-1a, 64 bits (Fowler, Noll, Vo; RFC 9923): in: bytes and the hash so far; out: the hash after them. Hashing two
 * pieces one after the other gives the hash of the whole. */
#include <lom/base.h>

static const uint64_t fnv_prime = UINT64_C(0x100000001b3);

uint64_t lom_hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const uint8_t *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * fnv_prime;
    return hash;
}
