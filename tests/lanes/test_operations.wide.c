/* Proves that every override of a lane operation gives, bit for bit, what its definition gives: on special values in
 * every pairing, and on random bit patterns. NaNs are compared as NaN: payloads are not defined. */
#include "lanes/decisions.h"
#include "lanes/fours.h"
#include "lanes/gathers.h"
#include "lanes/mix_bytes.h"
#include "lanes/pair_products.h"
#include "lanes/row_pairs.h"

#include "check.h"

static const uint32_t specials[] = {
    0x00000000, 0x80000000, 0x00000001, 0x80000001, 0x007fffff, 0x00800000, 0x33000000, 0xb3000000, 0x3effffff,
    0x3f000000, 0xbf000000, 0x3f000001, 0x3f7fffff, 0x3f800000, 0xbf800000, 0x3fc00000, 0x40200000, 0xc0200000,
    0x4affffff, 0x4b000000, 0x4b000001, 0xcb000000, 0x4effffff, 0x4f000000, 0xcf000000, 0xcf000001, 0x7149f2ca,
    0xf149f2ca, 0x7f7fffff, 0xff7fffff, 0x7f800000, 0xff800000, 0x7fc00000, 0xffc00000, 0x7fc12345
};
enum { SPECIALS = sizeof specials / sizeof specials[0] };

static lom_int pattern(uint64_t key, uint64_t counter)
{
    lom_int x;
    for (int i = 0; i < LOM_LANES; i++) {
        uint64_t h = (counter * LOM_LANES + (uint64_t)i + 1) * UINT64_C(0x9e3779b97f4a7c15) + key;
        h ^= h >> 31;
        h *= UINT64_C(0xbf58476d1ce4e5b9);
        h ^= h >> 29;
        x[i] = (h & 7) == 0 ? (int32_t)specials[(h >> 8) % SPECIALS] : (int32_t)(h >> 32);
    }
    return x;
}

static int same(lom_float a, lom_float b)
{
    lom_mask equal = ((lom_int)a == (lom_int)b) | ((a != a) & (b != b));
    return lom_defined_bits(equal) == (uint32_t)((UINT64_C(1) << LOM_LANES) - 1);
}

static int same_int(lom_int a, lom_int b)
{
    return lom_defined_bits(a == b) == (uint32_t)((UINT64_C(1) << LOM_LANES) - 1);
}

static void compare_all(lom_int p, lom_int q)
{
    lom_float a = lom_as_float(p), b = lom_as_float(q);
    lom_mask m = p > q;
    CHECK(same_int((lom_int)lom_select(m, a, b), (lom_int)lom_defined_select(m, a, b)), "select of %08x", p[0]);
    CHECK(same_int(lom_select_int(m, p, q), lom_defined_select_int(m, p, q)), "select_int of %08x", p[0]);
    CHECK(same_int(lom_min_int(p, q), lom_defined_select_int(p < q, p, q)), "min_int of %08x, %08x", p[0], q[0]);
    CHECK(same_int(lom_max_int(p, q), lom_defined_select_int(p > q, p, q)), "max_int of %08x, %08x", p[0], q[0]);
    CHECK(same(lom_min(a, b), lom_defined_min(a, b)), "min of %08x, %08x", p[0], q[0]);
    CHECK(same(lom_max(a, b), lom_defined_max(a, b)), "max of %08x, %08x", p[0], q[0]);
    CHECK(same(lom_sqrt(a), lom_defined_sqrt(a)), "sqrt of %08x", p[0]);
    CHECK(same(lom_floor(a), lom_defined_floor(a)), "floor of %08x", p[0]);
    CHECK(same(lom_round(a), lom_defined_round(a)), "round of %08x", p[0]);
    CHECK(same_int(lom_to_int(a), lom_defined_to_int(a)), "to_int of %08x", p[0]);
    lom_double wide = lom_to_double(p), defined = lom_defined_to_double(p);
    CHECK(memcmp(&wide, &defined, sizeof wide) == 0 && defined[0] == p[0], "to_double of %08x", p[0]);
    CHECK(lom_bits(m) == lom_defined_bits(m), "bits of %08x", m[0]);
    lom_pairs x = (lom_pairs)p, y = (lom_pairs)q;
    CHECK(same_int((lom_int)lom_multiply_pairs(x, y), (lom_int)lom_defined_multiply_pairs(x, y)),
          "multiply_pairs of %08x, %08x", p[0], q[0]);
    CHECK(same_int((lom_int)lom_mix_even_bytes(p, q, y), (lom_int)lom_defined_mix_even_bytes(p, q, y)) &&
              same_int((lom_int)lom_mix_odd_bytes(p, q, y), (lom_int)lom_defined_mix_odd_bytes(p, q, y)),
          "mix_bytes of %08x, %08x", p[0], q[0]);
    CHECK(same(lom_repeated(a), lom_defined_repeated(a)), "repeated of %08x", p[0]);
    CHECK(lom_any_positive(a) == lom_defined_any_positive(a), "any_positive of %08x", p[0]);
    lom_float one = -lom_abs(a);
    CHECK(!lom_any_positive(one), "any_positive of -|%08x|", p[0]);
    one[q[0] & (LOM_LANES - 1)] = b[0];
    CHECK(lom_any_positive(one) == (b[0] > 0), "any_positive of %08x alone", q[0]);
    CHECK(lom_all_equal(p, q[0]) == lom_defined_all_equal(p, q[0]), "all_equal of %08x, %08x", p[0], q[0]);
    CHECK(lom_all_equal(lom_splat_int(q[0]), q[0]), "all_equal of %08x", q[0]);
    CHECK(same_int((lom_int)lom_twice(p), (lom_int)lom_defined_twice(p)), "twice of %08x", p[0]);
}

static void overrides_equal_definitions_on_specials(void)
{
    for (int i = 0; i < SPECIALS; i++)
        for (int j = 0; j < SPECIALS; j++) {
            lom_int p = pattern(1, (uint64_t)(i * SPECIALS + j)), q = pattern(2, (uint64_t)(i * SPECIALS + j));
            p[0] = (int32_t)specials[i];
            q[0] = (int32_t)specials[j];
            p[LOM_LANES - 1] = (int32_t)specials[j];
            compare_all(p, q);
        }
}

static void overrides_equal_definitions_on_random_bits(void)
{
    for (uint64_t n = 0; n < 200000; n++)
        compare_all(pattern(3, n), pattern(4, n));
}

static void check_gathered_pairs(const int32_t *table, lom_int index)
{
    lom_int first[2], second[2];
    lom_defined_gather_pairs(table, index, &first[1], &second[1]);
    lom_gather_pairs(table, index, &first[0], &second[0]);
    CHECK(same_int(first[0], first[1]) && same_int(second[0], second[1]), "gather_pairs %d", index[0]);
    for (int by = 0; by < 2; by++) {
        lom_gather_pairs_by(by != 0, table, index, &first[0], &second[0]);
        CHECK(same_int(first[0], first[1]) && same_int(second[0], second[1]), "gather_pairs_by %d %d", by, index[0]);
    }
}

static void gathers_read_what_their_indices_name(void)
{
    float table[256];
    const float *rows[LOM_LANES];
    for (int i = 0; i < 256; i++)
        table[i] = (float)(i * 3 - 100);
    for (uint64_t n = 0; n < 1000; n++) {
        lom_int index = pattern(5, n) & 63;
        for (int i = 0; i < LOM_LANES; i++)
            rows[i] = table + index[i] * 3;
        CHECK(same(lom_gather(table, index), lom_defined_gather(table, index)), "gather %d", index[0]);
        CHECK(same_int(lom_gather_int((const int32_t *)table, index),
                       lom_defined_gather_int((const int32_t *)table, index)),
              "gather_int %d", index[0]);
        check_gathered_pairs((const int32_t *)table, index);
        lom_float4 a = lom_load_rows(rows, 1), b = lom_defined_load_rows(rows, 1);
        CHECK(same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.w, b.w), "load_rows %d", index[0]);
    }
}

static void fours_are_loaded_and_picked(void)
{
    int32_t table[256];
    for (int i = 0; i < 256; i++)
        table[i] = i * 3 - 100;
    for (uint64_t n = 0; n < 1000; n++) {
        lom_int index = pattern(14, n) & 127, which = pattern(15, n) & (2 * LOM_LANES - 1);
        const int32_t *from[LOM_LANES / 4];
        for (int i = 0; i < LOM_LANES / 4; i++)
            from[i] = table + index[i];
        lom_int low = lom_load_fours(from), high = lom_defined_load_fours(from);
        CHECK(same_int(low, high), "load_fours %d", index[0]);
        CHECK(low[LOM_LANES - 1] == from[LOM_LANES / 4 - 1][3], "the last is the fourth of the last place");
        lom_int spread[8], defined[8];
        lom_spread(table + index[1], 8, spread);
        lom_defined_spread(table + index[1], 8, defined);
        for (int i = 0; i < 8; i++)
            CHECK(same_int(spread[i], defined[i]) && spread[i][0] == table[index[1] + i], "spread %d", i);
        high = pattern(16, n);
        CHECK(same_int(lom_permute_two(low, high, which), lom_defined_permute_two(low, high, which)), "permute_two %d",
              which[0]);
    }
}

/* Indices of either sign, counted from the middle. */
static void what_lies_before_is_gathered(void)
{
    int32_t table[256];
    float numbers[256];
    for (int i = 0; i < 256; i++)
        numbers[i] = (float)(table[i] = i * 5 - 7);
    for (uint64_t n = 0; n < 1000; n++) {
        lom_int index = (pattern(17, n) & 127) - 64;
        CHECK(same(lom_gather(numbers + 128, index), lom_defined_gather(numbers + 128, index)), "gather %d", index[0]);
        CHECK(same_int(lom_gather_int(table + 128, index), lom_defined_gather_int(table + 128, index)), "gather_int %d",
              index[0]);
        check_gathered_pairs(table + 128, index);
    }
}

/* Rows that overlap are written in the order of the lanes: the last one stays. */
static void rows_are_gathered_and_scattered_in_lane_order(void)
{
    float table[256], written[2][256];
    for (int i = 0; i < 256; i++)
        table[i] = (float)(i * 3 - 100);
    for (uint64_t n = 0; n < 1000; n++) {
        lom_int index = pattern(7, n) & (n & 1 ? 127 : 7);
        lom_float4 a = lom_gather_rows(table, index), b = lom_defined_gather_rows(table, index);
        CHECK(same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.w, b.w), "gather_rows %d", index[0]);
        int count = 1 + (int)(n % LOM_LANES);
        int32_t row[LOM_LANES] = { 0 };
        for (int i = 0; i < count; i++)
            row[i] = index[i];
        lom_int which = (lom_int)((lom_uint)pattern(13, n) % (uint32_t)count);
        a = lom_pick_rows(table, row, count, which);
        b = lom_defined_pick_rows(table, row, which);
        CHECK(same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.w, b.w), "pick_rows of %d", count);
        a = (lom_float4){ lom_as_float(pattern(8, n)), lom_as_float(pattern(9, n)), lom_as_float(pattern(10, n)),
                          lom_as_float(pattern(11, n)) };
        memcpy(written[0], table, sizeof table);
        memcpy(written[1], table, sizeof table);
        lom_scatter_rows(written[0], index, a);
        lom_defined_scatter_rows(written[1], index, a);
        CHECK(memcmp(written[0], written[1], sizeof table) == 0, "scatter_rows %d", index[0]);
    }
}

static void rows_lie_side_by_side_until_they_are_columns(void)
{
    float table[256];
    for (int i = 0; i < 256; i++)
        table[i] = (float)(i * 3 - 100);
    for (uint64_t n = 0; n < 1000; n++) {
        lom_int index = pattern(18, n) & 127;
        int32_t at[LOM_LANES];
        lom_store_places(at, index);
        lom_float first[4], second[4], spread[4], defined[4], a, b;
        for (int i = 0; i < 4; i++) {
            lom_load_row_pairs(table, at, i, &first[i], &second[i]);
            lom_defined_load_row_pairs(table, at, i, &a, &b);
            CHECK(same(first[i], a) && same(second[i], b), "load_row_pairs %d", index[0]);
        }
        lom_spread_to_rows(lom_as_float(pattern(19, n)), spread);
        lom_defined_spread_to_rows(lom_as_float(pattern(19, n)), defined);
        for (int i = 0; i < 4; i++)
            CHECK(same(spread[i], defined[i]), "spread_to_rows %d", i);
        lom_float4 x = lom_columns_of_rows(first), y = lom_defined_columns_of_rows(first);
        CHECK(same(x.x, y.x) && same(x.y, y.y) && same(x.z, y.z) && same(x.w, y.w), "columns_of_rows %d", index[0]);
        y = lom_defined_gather_rows(table, index);
        CHECK(same(x.x, y.x) && same(x.y, y.y) && same(x.z, y.z) && same(x.w, y.w), "columns of rows %d", index[0]);
        x = lom_columns_of_rows(second), y = lom_defined_gather_rows(table + 4, index);
        CHECK(same(x.x, y.x) && same(x.y, y.y) && same(x.z, y.z) && same(x.w, y.w), "columns of next %d", index[0]);
        x = lom_columns_of_rows(spread);
        CHECK(same(x.x, x.w) && same(x.y, x.z) && same(x.x, lom_as_float(pattern(19, n))), "each is its lane's");
    }
}

static void halves_come_from_and_go_to_two_places(void)
{
    enum { HALF = LOM_LANES / 2 };
    int32_t low[HALF], high[HALF], written[2][HALF + 1];
    for (uint64_t n = 0; n < 1000; n++) {
        lom_int x = pattern(12, n);
        for (int i = 0; i < HALF; i++) {
            low[i] = x[i];
            high[i] = x[HALF + i];
        }
        CHECK(same_int(lom_load_halves(low, high), x) && same_int(lom_defined_load_halves(low, high), x), "%d", x[0]);
        written[0][HALF] = written[1][HALF] = 17;
        lom_store_halves(written[0], written[1], x);
        CHECK(memcmp(written[0], low, sizeof low) == 0 && memcmp(written[1], high, sizeof high) == 0, "%d", x[0]);
        CHECK(written[0][HALF] == 17 && written[1][HALF] == 17, "written past a half");
        lom_defined_store_halves(written[0], written[1], lom_splat_int(0));
        CHECK(written[0][0] == 0 && written[1][HALF - 1] == 0 && written[0][HALF] == 17, "definition");
    }
}

static void pairs_are_split(void)
{
    int32_t table[2 * LOM_LANES + 3];
    for (int i = 0; i < 2 * LOM_LANES + 3; i++)
        table[i] = i * 7 - 3;
    for (int first = 0; first < 4; first++) {
        lom_int even, odd, a, b;
        lom_split_pairs(table + first, &even, &odd);
        lom_defined_split_pairs(table + first, &a, &b);
        CHECK(same_int(even, a) && same_int(odd, b), "pairs from word %d", first);
        CHECK(a[1] == table[first + 1] && b[0] == table[first + 2] && a[2] == table[first + 4], "from word %d", first);
    }
}

static void streams_store_what_they_are_given(void)
{
    int32_t to[4 * LOM_LANES] __attribute__((aligned(64)));
    for (int i = 0; i < 4; i++)
        lom_stream_int(to + i * LOM_LANES, lom_lane_index() + i * LOM_LANES);
    lom_end_streams();
    for (int i = 0; i < 4 * LOM_LANES; i++)
        CHECK(to[i] == i, "word %d is %d", i, to[i]);
}

static void set_lanes_are_counted(void)
{
    for (uint32_t bits = 0; bits < 0x20000; bits++) {
        uint32_t count = 0;
        for (int i = 0; i < 16; i++)
            count += bits >> i & 1;
        CHECK(lom_count_bits(bits) == count, "bits %x", bits);
    }
    for (int i = 0; i < LOM_LANES; i++)
        CHECK(lom_count(lom_lane_index() > i) == (uint32_t)(LOM_LANES - 1 - i), "lanes above %d", i);
}

static void pairs_are_multiplied_and_added(void)
{
    for (uint64_t n = 0; n < 20000; n++) {
        lom_int a = pattern(8, n), b = pattern(9, n);
        CHECK(same_int(lom_dot_pairs(a, b), lom_defined_dot_pairs(a, b)), "%08x and %08x", a[0], b[0]);
        lom_int low = a >> 16, high = b >> 16;
        CHECK(same_int(lom_dot_pairs(lom_make_pair(low, high), lom_make_pair(high, low >> 1)),
                       low * high + high * (low >> 1)),
              "(%d, %d)", low[0], high[0]);
    }
}

static void compress_keeps_set_lanes_in_order(void)
{
    for (uint64_t n = 0; n < 70000; n++) {
        float a[LOM_LANES], b[LOM_LANES];
        lom_mask mask = lom_mask_of_bits((uint32_t)n);
        lom_compress(a, mask, lom_as_float(pattern(6, n)));
        lom_defined_compress(b, mask, lom_as_float(pattern(6, n)));
        CHECK(memcmp(a, b, sizeof(float) * (size_t)__builtin_popcount(lom_bits(mask))) == 0, "mask %x", lom_bits(mask));
    }
}

static void lanes_are_permuted_by_their_numbers(void)
{
    for (uint64_t n = 0; n < 2000; n++) {
        lom_float x = lom_as_float(pattern(10, n)), a, b;
        lom_int which = pattern(11, n) & (LOM_LANES - 1);
        a = lom_permute(x, which);
        b = lom_defined_permute(x, which);
        CHECK(same_int(lom_as_int(a), lom_as_int(b)), "pattern %d", (int)n);
        lom_int reversed = lom_as_int(lom_permute(x, LOM_LANES - 1 - lom_lane_index()));
        CHECK(reversed[0] == lom_as_int(x)[LOM_LANES - 1] && reversed[LOM_LANES - 1] == lom_as_int(x)[0]);
    }
}

static void definitions_have_their_stated_values(void)
{
    float nan = __builtin_nanf(""), infinity = __builtin_inff();
    CHECK(lom_defined_min(lom_splat(nan), lom_splat(3))[0] == 3 &&
          lom_defined_max(lom_splat(nan), lom_splat(3))[0] == 3);
    CHECK(lom_defined_min(lom_splat(3), lom_splat(nan))[0] != lom_defined_min(lom_splat(3), lom_splat(nan))[0]);
    CHECK(lom_defined_to_int(lom_splat(nan))[0] == 0 && lom_defined_to_int(lom_splat(infinity))[0] == 2147483520);
    CHECK(lom_defined_to_int(lom_splat(-infinity))[0] == INT32_MIN && lom_defined_to_int(lom_splat(-1.9f))[0] == -1);
    CHECK(lom_defined_floor(lom_splat(-0.5f))[0] == -1 && __builtin_signbit(lom_defined_floor(lom_splat(-0.0f))[0]));
    CHECK(lom_defined_round(lom_splat(2.5f))[0] == 2 && lom_defined_round(lom_splat(-3.5f))[0] == -4);
    CHECK(lom_fraction(lom_splat(-1e-10f))[0] == 0 && lom_fraction(lom_splat(-0.25f))[0] == 0.75f);
    CHECK(lom_clamp(lom_splat(nan), lom_splat(2), lom_splat(5))[0] == 2 && lom_saturate(lom_splat(infinity))[0] == 1);
    CHECK(lom_bits(lom_mask_of_bits(0xa5a5u)) == (0xa5a5u & ((1u << LOM_LANES) - 1)));
}

/* Lane by lane what the same operations give in floats, in their stated order; the fourth component counts. */
static void matrices_multiply_each_lane(void)
{
    lom_matrix_uniform m;
    float v[4][LOM_LANES];
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++)
            m.m[row][column] = (float)(lom_random_uniform(1, (uint64_t)(row * 4 + column)) * 20 - 10);
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < LOM_LANES; i++)
            v[k][i] = (float)(lom_random_uniform(2, (uint64_t)(k * LOM_LANES + i)) * 20 - 10);
    lom_float3 p = { lom_load(v[0]), lom_load(v[1]), lom_load(v[2]) };
    lom_float4 q = { p.x, p.y, p.z, lom_load(v[3]) };
    lom_float4 product = lom_multiply4(&m, q), place = lom_transform4(&m, p);
    lom_float3 affine = lom_transform3(&m, p), turned = lom_rotate3(&m, p);
    lom_float products[4] = { product.x, product.y, product.z, product.w };
    lom_float places[4] = { place.x, place.y, place.z, place.w };
    lom_float affines[3] = { affine.x, affine.y, affine.z }, turns[3] = { turned.x, turned.y, turned.z };
    for (int row = 0; row < 4; row++)
        for (int i = 0; i < LOM_LANES; i++) {
            const float *r = m.m[row];
            float sum = v[0][i] * r[0];
            sum = sum + v[1][i] * r[1];
            sum = sum + v[2][i] * r[2];
            float weighted = v[3][i] * r[3];
            CHECK(products[row][i] == sum + weighted && places[row][i] == sum + r[3], "row %d, lane %d", row, i);
            CHECK(row == 3 || (affines[row][i] == sum + r[3] && turns[row][i] == sum), "row %d, lane %d", row, i);
        }
}

int main(int argc, char **argv)
{
    RUN(definitions_have_their_stated_values);
    RUN(overrides_equal_definitions_on_specials);
    RUN(overrides_equal_definitions_on_random_bits);
    RUN(pairs_are_split);
    RUN(streams_store_what_they_are_given);
    RUN(set_lanes_are_counted);
    RUN(pairs_are_multiplied_and_added);
    RUN(compress_keeps_set_lanes_in_order);
    RUN(lanes_are_permuted_by_their_numbers);
    RUN(gathers_read_what_their_indices_name);
    RUN(what_lies_before_is_gathered);
    RUN(fours_are_loaded_and_picked);
    RUN(rows_are_gathered_and_scattered_in_lane_order);
    RUN(matrices_multiply_each_lane);
    RUN(rows_lie_side_by_side_until_they_are_columns);
    RUN(halves_come_from_and_go_to_two_places);
    return check_result();
}
