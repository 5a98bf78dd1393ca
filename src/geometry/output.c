/* Text that is put together. In: words and numbers. Out: bytes. */
#include "output.h"
#include "base/reserve.h"

#include <string.h>

static void put_bytes(struct lom_output *output, const char *bytes, size_t size)
{
    if (output->failed ||
        !lom_reserve(&output->bytes.data, &output->capacity, output->bytes.size + size, 1, output->error)) {
        output->failed = true;
        return;
    }
    if (size > 0)
        memcpy(output->bytes.data + output->bytes.size, bytes, size);
    output->bytes.size += size;
}

void lom_put(struct lom_output *output, const char *string)
{
    put_bytes(output, string, strlen(string));
}

void lom_put_float(struct lom_output *output, float value)
{
    char text[32];
    size_t length = lom_print_float(text, value);
    put_bytes(output, text, length);
}

void lom_put_index(struct lom_output *output, uint32_t index)
{
    char digits[10];
    size_t first = sizeof digits;
    do {
        digits[--first] = (char)('0' + index % 10);
        index /= 10;
    } while (index > 0);
    put_bytes(output, digits + first, sizeof digits - first);
}
