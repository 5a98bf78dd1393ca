/* The lane conversions give what the scalar ones give, for floats of every bit pattern (strided; all 2^32 with
 * LOM_EXHAUSTIVE=1) and around every threshold. */
#include "check.h"

#include "image/narrowed_unorm.h"

/* Compares all conversions of LOM_LANES floats. */
static void check_floats(const uint32_t bits[LOM_LANES])
{
    float x[LOM_LANES];
    memcpy(x, bits, sizeof x);
    lom_float lanes = lom_load(x);
    lom_int unorm8 = lom_unorm_of_lanes(lanes, 255), unorm16 = lom_unorm_of_lanes(lanes, 65535);
    lom_int unorm24 = lom_unorm_of_lanes(lanes, 16777215);
    lom_int number = lom_narrowed_unorm8_of_lanes(lanes), byte = join(narrow(number, number, number, number)) & 255;
    lom_int srgb = lom_srgb8_of_lanes(lanes), half = lom_half_of_lanes(lanes);
    for (int i = 0; i < LOM_LANES; i++) {
        CHECK(unorm8[i] == (int32_t)lom_unorm_of(x[i], 255), "%08x to %d", bits[i], unorm8[i]);
        CHECK(byte[i] == unorm8[i], "%08x to %d and narrowed to %d", bits[i], unorm8[i], byte[i]);
        CHECK(unorm16[i] == (int32_t)lom_unorm_of(x[i], 65535), "%08x to %d", bits[i], unorm16[i]);
        CHECK(unorm24[i] == (int32_t)lom_unorm_of(x[i], 16777215), "%08x to %d", bits[i], unorm24[i]);
        CHECK(srgb[i] == lom_srgb8_of(x[i]), "%08x to %d", bits[i], srgb[i]);
        CHECK(half[i] == lom_half_of(x[i]), "%08x to %04x", bits[i], (unsigned)half[i]);
    }
}

static void every_float(void)
{
    uint64_t stride = getenv("LOM_EXHAUSTIVE") != NULL ? 1 : 1021;
    uint32_t bits[LOM_LANES];
    for (uint64_t start = 0; start <= UINT32_MAX; start += stride * LOM_LANES) {
        for (int i = 0; i < LOM_LANES; i++)
            bits[i] = (uint32_t)(start + stride * (uint64_t)i);
        check_floats(bits);
    }
}

/* Around (k - 1/2) / largest: where rounding decides. */
static void around_thresholds(void)
{
    const uint32_t largest[] = { 255, 65535, 16777215 };
    uint32_t bits[LOM_LANES];
    for (int f = 0; f < 3; f++)
        for (uint32_t k = 1; k <= largest[f]; k += f == 0 ? 1 : f == 1 ? 7 : 1777) {
            uint32_t near = lom_bits_of_float((float)((k - 0.5) / largest[f]));
            for (int i = 0; i < LOM_LANES; i++)
                bits[i] = near - LOM_LANES / 2 + (uint32_t)i;
            check_floats(bits);
        }
    for (uint32_t k = 1; k < 256; k++) { /* buckets of the sRGB table and its own thresholds */
        uint32_t low = lom_bits_of_float(lom_srgb_linear[k - 1]), high = lom_bits_of_float(lom_srgb_linear[k]);
        while (high - low > 1) { /* the place where the scalar code changes */
            uint32_t middle = low + (high - low) / 2;
            *(lom_srgb8_of(lom_float_of_bits(middle)) < k ? &low : &high) = middle;
        }
        for (int i = 0; i < LOM_LANES; i++)
            bits[i] = high - LOM_LANES / 2 + (uint32_t)i;
        check_floats(bits);
    }
}

static void special_floats(void)
{
    const uint32_t special[16] = { 0,          0x80000000, 0x7f800000, 0xff800000, 0x7fc00000, 0xffc00000,
                                   0x7f800001, 0xff800001, 1,          0x80000001, 0x007fffff, 0x3f800000,
                                   0x3f7fffff, 0x477fefff, 0x477ff000, 0x7f7fffff };
    uint32_t bits[LOM_LANES];
    for (int first = 0; first < 16; first += LOM_LANES) {
        memcpy(bits, special + first, sizeof bits);
        check_floats(bits);
    }
}

static void back_to_float(void)
{
    for (int32_t h = 0; h < 65536; h += LOM_LANES) {
        lom_float x = lom_float_of_half_lanes(lom_splat_int(h) + lom_lane_index());
        lom_float u = lom_float_of_unorm_lanes(lom_splat_int(h) + lom_lane_index(), 65535);
        for (int i = 0; i < LOM_LANES; i++) {
            float want = lom_float_of_half((uint16_t)(h + i));
            CHECK(lom_bits_of_float(x[i]) == lom_bits_of_float(want) || want != want, "half %04x", (unsigned)(h + i));
            CHECK(want == want || x[i] != x[i], "half %04x is NaN", (unsigned)(h + i));
            CHECK(u[i] == (float)((h + i) / 65535.0), "unorm %d", h + i);
        }
    }
    for (int32_t k = 0; k < 256; k += LOM_LANES) {
        lom_float s = lom_float_of_srgb8_lanes(lom_splat_int(k) + lom_lane_index());
        lom_float u = lom_float_of_unorm_lanes(lom_splat_int(k) + lom_lane_index(), 255);
        for (int i = 0; i < LOM_LANES; i++)
            CHECK(s[i] == lom_srgb_linear[k + i] && u[i] == (float)((k + i) / 255.0), "code %d", k + i);
    }
}

int main(int argc, char **argv)
{
    RUN(every_float);
    RUN(around_thresholds);
    RUN(special_floats);
    RUN(back_to_float);
    return check_result();
}
