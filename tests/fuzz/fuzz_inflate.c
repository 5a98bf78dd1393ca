/* Any bytes as a DEFLATE stream and as a gzip file: no crash, and never more than the limit; and as data to compress:
 * the same data comes back. */
#include <lom/base.h>

#include "image/zip.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    enum { LIMIT = 1 << 20 };
    lom_inflated out = { .limit = LIMIT };
    size_t at = 0;
    lom_inflate("fuzz", data, size, &at, 0, &out, NULL);
    if (out.size > LIMIT || at > size)
        abort();
    lom_release(out.data);
    lom_bytes plain = lom_inflate_gzip("fuzz", data, size, LIMIT, NULL);
    lom_release(plain.data);
    if (size % 8 != 0) /* compressing takes longer than the rest */
        return 0;
    lom_bytes gzip = lom_deflate_gzip(data, size, 1 + (int)(size % 100), NULL);
    plain = lom_inflate_gzip("fuzz", gzip.data, gzip.size, size, NULL);
    if (plain.data == NULL || plain.size != size || (size != 0 && memcmp(plain.data, data, size) != 0))
        abort();
    lom_release(plain.data);
    lom_release(gzip.data);
    return 0;
}
