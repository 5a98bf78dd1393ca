/* Draws that are like one before them. In: a descriptor. Out: a call of 20 bytes, which names a draw of the pass, its
 * triangles and its uniforms. A descriptor has 792 bytes and what follows from it as many: where thousands of draws differ
 * in a matrix or a material, one of them is checked and kept, and of uniforms those that are not among the last ones.
 * Invariant: what a call names draws what its own descriptor would. */
#include "pipeline/check_device.h"
#include "pipeline/draw_again.h"
#include "pipeline/expand.h"

typedef uint64_t pair __attribute__((vector_size(16), aligned(1), may_alias)); /* wherever it lies */
enum { PAIRS = 4 };                                                            /* that are compared together */

/* A caller's structure may have padding that nobody set, and a sanitizer of memory need not hear of it: where that alone
 * differs, both draws have a copy and draw the same. From the end, since what structures of uniforms share stands in front. */
#ifdef __clang__
__attribute__((no_sanitize("memory")))
#endif
static bool
are_same(const void *one, const void *other, size_t size)
{
    const unsigned char *a = one, *b = other;
    uint64_t different = 0;
    for (; size >= PAIRS * sizeof(pair) && different == 0; size -= PAIRS * sizeof(pair)) {
        const pair *x = (const pair *)(const void *)(a + size) - PAIRS,
                   *y = (const pair *)(const void *)(b + size) - PAIRS;
        const pair all = (x[0] ^ y[0]) | (x[1] ^ y[1]) | (x[2] ^ y[2]) | (x[3] ^ y[3]);
        different = all[0] | all[1];
    }
    for (; size >= sizeof different && different == 0; size -= sizeof different) {
        uint64_t word[2];
        memcpy(&word[0], a + size - sizeof word[0], sizeof word[0]);
        memcpy(&word[1], b + size - sizeof word[1], sizeof word[1]);
        different = word[0] ^ word[1];
    }
    for (; size > 0 && different == 0; size--)
        different = a[size - 1] ^ (unsigned)b[size - 1];
    return different == 0;
}

/* All but uniforms, count, first and attributes that the shader has not; a is a draw that was checked. */
static bool are_alike(const lom_draw_desc *a, const lom_draw_desc *b)
{
    enum { FROM = offsetof(lom_draw_desc, indices), TO = offsetof(lom_draw_desc, count) };
    enum { REST = offsetof(lom_draw_desc, first) + sizeof(size_t) };
    _Static_assert(offsetof(lom_draw_desc, attribute) == 2 * sizeof(void *) &&
                       FROM == 2 * sizeof(void *) + sizeof a->attribute &&
                       offsetof(lom_draw_desc, first) == TO + sizeof(size_t),
                   "shader, uniforms, attributes, indices ..., count, first, the rest");
    const unsigned char *from[2] = { (const unsigned char *)a, (const unsigned char *)b };
    return a->shader == b->shader && are_same(from[0] + FROM, from[1] + FROM, TO - FROM) &&
           are_same(a->attribute, b->attribute, (size_t)a->shader->attributes * sizeof *a->attribute) &&
           are_same(from[0] + REST, from[1] + REST, sizeof *a - REST);
}

bool lom_find_draw(const lom_device *device, const lom_draw_desc *desc, struct lom_call *call)
{
    const struct lom_pass *pass = &device->pass;
    if (desc->count > UINT32_MAX || desc->first > UINT32_MAX || desc->shader == NULL ||
        (desc->uniforms == NULL && desc->shader->uniforms_size != 0))
        return false;
    for (size_t i = 0; i < KNOWN_DRAWS && i < pass->known_draws; i++) {
        const struct lom_known_draw *known = &device->known_draw[i];
        const size_t first = desc->first - known->desc.first;
        if (desc->first < known->desc.first || first % 3 != 0 || !are_alike(&known->desc, desc))
            continue;
        *call =
            (struct lom_call){ known->draw, (uint32_t)(first / 3), (uint32_t)(desc->count / 3), 0, desc->base_vertex };
        return true;
    }
    return false;
}

/* Lists of triangles or patches by indices. */
bool lom_may_be_shared(const lom_device *device, const lom_draw_desc *desc)
{
    return !device->pass.is_recorded && (desc->topology == LOM_TRIANGLES || desc->topology == LOM_PATCHES) &&
           desc->indices != NULL && desc->culling.clusters == NULL && desc->condition == NULL &&
           desc->count_from == NULL && desc->feedback == NULL;
}

/* Not where what a draw draws is found but once for it, or told of each. */
void lom_note_draw(lom_device *device, const lom_draw_desc *desc)
{
    struct lom_pass *pass = &device->pass;
    const struct lom_draw *draw = &device->draws[pass->draw_count - 1];
    if (draw->constant || draw->expands || !lom_may_be_shared(device, desc))
        return;
    device->known_draw[pass->known_draws++ % KNOWN_DRAWS] =
        (struct lom_known_draw){ *desc, (uint32_t)(pass->draw_count - 1) };
}

static bool find_uniforms(const lom_device *device, const void *uniforms, size_t size, uint32_t *place)
{
    for (size_t i = 0; i < KNOWN_DRAWS && i < device->pass.known_uniforms; i++) {
        const struct lom_known_uniforms *known = &device->known_uniforms[i];
        *place = known->place;
        if (known->size == size && are_same(device->uniforms + (size_t)known->place * UNIFORMS_UNIT, uniforms, size))
            return true;
    }
    return false;
}

bool lom_copy_uniforms(lom_device *device, const lom_draw_desc *desc, struct lom_call *call)
{
    const void *uniforms = desc->uniforms;
    const size_t size = desc->shader->uniforms_size;
    struct lom_pass *pass = &device->pass;
    if (size == 0 || find_uniforms(device, uniforms, size, &call->uniforms))
        return true;
    size_t place = (device->uniforms_size + UNIFORMS_UNIT - 1) / UNIFORMS_UNIT;
    if (place > UINT32_MAX ||
        !lom_reserve(&device->uniforms, &device->uniforms_capacity, place * UNIFORMS_UNIT + size, 1, NULL))
        return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for a draw's uniforms.");
    memcpy(device->uniforms + place * UNIFORMS_UNIT, uniforms, size);
    device->uniforms_size = place * UNIFORMS_UNIT + size;
    call->uniforms = (uint32_t)place;
    device->known_uniforms[pass->known_uniforms++ % KNOWN_DRAWS] = (struct lom_known_uniforms){ call->uniforms, size };
    return true;
}

static bool add_call(lom_device *device, const struct lom_call *call)
{
    struct lom_pass *pass = &device->pass;
    if (pass->call_count == device->call_capacity &&
        !lom_reserve(&device->calls, &device->call_capacity, pass->call_count + 1, sizeof *device->calls, NULL))
        return lom_fail(&device->error, LOM_ERROR_MEMORY, "The system gave no memory for another draw.");
    device->calls[pass->call_count++] = *call;
    device->counters.draws++;
    return true;
}

bool lom_add_call(lom_device *device, const lom_draw_desc *desc, struct lom_call *call)
{
    return lom_copy_uniforms(device, desc, call) && add_call(device, call);
}

/* Mostly triangles: by a product. */
static uint32_t count_primitives(size_t indices, int corners)
{
    return (uint32_t)(corners == 3 ? indices / 3 : indices / (size_t)corners);
}

void lom_draw_held(lom_device *device, const struct lom_held_draw *held, const lom_draw_desc *desc)
{
    if (!held->is_held) {
        lom_draw(device, desc);
        return;
    }
    const struct lom_call call = { held->draw, count_primitives(desc->first - held->first, held->corners),
                                   count_primitives(desc->count, held->corners), held->uniforms, desc->base_vertex };
    if (device->error.code == LOM_OK)
        add_call(device, &call);
}
