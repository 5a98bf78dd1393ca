/* Text and numbers into memory. In: text. Out: bytes in memory of lom_allocate. */
#include "array.h"

#include <string.h>

static void put_bytes(struct lom_output *output, const char *bytes, size_t size)
{
    for (size_t i = 0; i < size && !output->failed; i++) {
        uint8_t *data = lom_grow(output->bytes.data, &output->capacity, output->bytes.size, 1, output->error);
        output->failed = data == NULL;
        if (output->failed)
            return;
        output->bytes.data = data;
        data[output->bytes.size++] = (uint8_t)bytes[i];
    }
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
