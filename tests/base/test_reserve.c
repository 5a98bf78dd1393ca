/* Proves of arrays that grow: what was in them stays, behind it are zeros, appending copies each element a bounded
 * number of times, and what cannot be had is an error that leaves the array as it was. */
#include "check.h"

#include "base/reserve.h"

static void elements_stay_and_zeros_follow(void)
{
    struct three {
        uint32_t part[3];
    } *array = NULL;
    size_t capacity = 0, changes = 0;
    lom_error error = { 0 };
    enum { COUNT = 10000 };
    for (uint32_t i = 0; i < COUNT; i++) {
        size_t before = capacity;
        CHECK(lom_reserve(&array, &capacity, i + 1, sizeof *array, &error) && capacity > i, "%s", error.text);
        changes += capacity != before;
        CHECK(capacity == before || capacity >= 2 * before, "%zu elements became %zu", before, capacity);
        CHECK(array[i].part[0] == 0 && array[i].part[2] == 0, "element %u is not zero", i);
        array[i] = (struct three){ { i, 2 * i, 3 * i } };
    }
    for (uint32_t i = 0; i < COUNT; i++)
        CHECK(array[i].part[0] == i && array[i].part[1] == 2 * i && array[i].part[2] == 3 * i, "element %u changed", i);
    CHECK(changes <= 12, "%zu copies for %d elements", changes, COUNT);
    lom_release(array);
}

static void what_is_there_is_not_moved(void)
{
    char *text = NULL;
    size_t capacity = 0;
    CHECK(lom_reserve(&text, &capacity, 0, 1, NULL) && text == NULL && capacity == 0, "room for nothing");
    CHECK(lom_reserve(&text, &capacity, 1000, 1, NULL) && capacity == 1000, "room for %zu, not 1000", capacity);
    const char *first = text;
    CHECK(lom_reserve(&text, &capacity, 1000, 1, NULL) && lom_reserve(&text, &capacity, 7, 1, NULL) && text == first,
          "it moved");
    lom_release(text);
}

static void what_is_renewed_is_zero_and_as_long_as_was_asked(void)
{
    char *text = NULL;
    size_t capacity = 0;
    CHECK(lom_renew(&text, &capacity, 100, 1, NULL) && capacity == 100, "room for %zu, not 100", capacity);
    memset(text, 'x', 100);
    CHECK(lom_renew(&text, &capacity, 100, 1, NULL) && text[99] == 'x', "an array that is long enough was renewed");
    CHECK(lom_renew(&text, &capacity, 101, 1, NULL) && capacity == 101, "room for %zu, not 101", capacity);
    for (int i = 0; i < 101; i++)
        CHECK(text[i] == 0, "element %d is not zero", i);
    lom_error error = { 0 };
    CHECK(!lom_renew(&text, &capacity, SIZE_MAX, 1, &error) && error.code == LOM_ERROR_MEMORY && error.text[0] != 0,
          "an array beyond memory");
    CHECK(text == NULL && capacity == 0, "the array that was given up is still there");
}

static void bare_arrays_are_as_long_as_was_asked(void)
{
    char *text = NULL;
    size_t capacity = 0;
    CHECK(lom_renew_bare(&text, &capacity, 100, 1, NULL) && capacity == 100, "room for %zu, not 100", capacity);
    CHECK((uintptr_t)text % 64 == 0, "the array is not on a cache line");
    memset(text, 'x', 100);
    CHECK(lom_renew_bare(&text, &capacity, 99, 1, NULL) && text[99] == 'x' && capacity == 100,
          "an array that is long enough was renewed");
    CHECK(lom_renew_bare(&text, &capacity, 1000, 1, NULL) && capacity == 1000, "room for %zu, not 1000", capacity);
    memset(text, 'y', 1000);
    lom_error error = { 0 };
    CHECK(!lom_renew_bare(&text, &capacity, SIZE_MAX, 2, &error) && error.code == LOM_ERROR_MEMORY &&
              error.text[0] != 0,
          "an array beyond memory");
    CHECK(text == NULL && capacity == 0, "the array that was given up is still there");
}

static void what_cannot_be_had_is_an_error(void)
{
    uint64_t *array = NULL;
    size_t capacity = 0;
    CHECK(lom_reserve(&array, &capacity, 3, sizeof *array, NULL), "no memory for 3 elements");
    array[2] = 9;
    const uint64_t *first = array;
    size_t before = capacity;
    const size_t sizes[] = { SIZE_MAX, SIZE_MAX / 8, SIZE_MAX / 8 + 2, SIZE_MAX / 16 + 1 };
    for (int i = 0; i < 4; i++) {
        lom_error error = { 0 };
        CHECK(!lom_reserve(&array, &capacity, sizes[i], sizeof *array, &error) && error.code == LOM_ERROR_MEMORY,
              "%zu elements", sizes[i]);
        CHECK(error.text[0] != 0 && array == first && array[2] == 9 && capacity == before, "the array changed");
    }
    lom_release(array);
}

int main(int argc, char **argv)
{
    RUN(elements_stay_and_zeros_follow);
    RUN(what_is_there_is_not_moved);
    RUN(what_is_renewed_is_zero_and_as_long_as_was_asked);
    RUN(bare_arrays_are_as_long_as_was_asked);
    RUN(what_cannot_be_had_is_an_error);
    return check_result();
}
