/* Any bytes as METAR text: no crash; layers are within their ranges, and what is refused has a sentence. */
#include <lom/cloud.h>

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    lom_metar_layer layer[LOM_MAX_METAR_LAYERS];
    lom_error error = { 0 };
    char *text = calloc(size + 1, 1);
    if (size != 0)
        memcpy(text, data, size);
    int count = lom_parse_metar(text, layer, &error);
    if (count < -1 || count > LOM_MAX_METAR_LAYERS || (count < 0) != (error.code != LOM_OK) ||
        (count < 0 && error.text[0] == 0))
        abort();
    for (int i = 0; i < count; i++) {
        bool is_measured = layer[i].base >= 0 && layer[i].base <= 999 * 30.48;
        if (!(layer[i].oktas > 0 && layer[i].oktas <= 8) || !(is_measured || layer[i].base == -1) ||
            lom_find_cloud_kind(layer[i].kind, NULL) == NULL)
            abort();
    }
    free(text);
    return 0;
}
