/* Any bytes as a TOML document: accepted or refused with one line, never a wrong read. Build with clang
 * -fsanitize=fuzzer,address,undefined. */
#include "scene/toml/toml.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    lom_arena arena = { 0 };
    lom_error error = { 0 };
    lom_toml_source source = { .name = "fuzz", .text = (const char *)data, .size = size };
    lom_toml_value *root = lom_toml_parse(&arena, &source, &error);
    if ((root != NULL) != (error.code == LOM_OK) || strchr(error.text, '\n') != NULL)
        abort();
    lom_arena_release(&arena);
    return 0;
}
