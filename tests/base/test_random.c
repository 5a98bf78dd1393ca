/* Hashes and random numbers. Oracles: the published vectors of FNV-1a (RFC 9923) and of Philox 4x32-10 (Random123's
 * kat_vectors), and moments that are known. */
#include "check.h"

#include <lom/base.h>

#include "base/philox.h"

#include <math.h>

static void fnv_vectors(void)
{
    CHECK(lom_hash_bytes(LOM_HASH_START, "", 0) == UINT64_C(0xcbf29ce484222325), "empty");
    CHECK(lom_hash_bytes(LOM_HASH_START, "a", 1) == UINT64_C(0xaf63dc4c8601ec8c), "a");
    CHECK(lom_hash_bytes(LOM_HASH_START, "foobar", 6) == UINT64_C(0x85944171f73967e8), "foobar");
    uint64_t parts = lom_hash_bytes(lom_hash_bytes(LOM_HASH_START, "foo", 3), "bar", 3);
    CHECK(parts == UINT64_C(0x85944171f73967e8), "foo, bar");
}

static void philox_vectors(void)
{
    static const struct {
        uint32_t counter[4], key[2], out[4];
    } vectors[] = {
        { { 0, 0, 0, 0 }, { 0, 0 }, { 0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8 } },
        { { 0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff },
          { 0xffffffff, 0xffffffff },
          { 0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd } },
        { { 0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344 },
          { 0xa4093822, 0x299f31d0 },
          { 0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1 } },
    };
    for (size_t i = 0; i < 3; i++) {
        uint32_t out[4];
        philox_4x32(vectors[i].counter, vectors[i].key, out);
        CHECK(memcmp(out, vectors[i].out, sizeof out) == 0, "%08x %08x %08x %08x", out[0], out[1], out[2], out[3]);
    }
    CHECK(lom_random_bits(0, 0) == UINT64_C(0xe169c58d6627e8d5), "%llx", (unsigned long long)lom_random_bits(0, 0));
}

/* Every input bit flips every output bit about half of the time. */
static void avalanche(void)
{
    enum { TRIALS = 2000 };
    for (int in = 0; in < 128; in++) {
        int flips[64] = { 0 };
        for (uint64_t i = 0; i < TRIALS; i++) {
            uint64_t key = i * UINT64_C(0x9e3779b97f4a7c15), counter = i;
            uint64_t bit = UINT64_C(1) << in % 64;
            uint64_t changed = lom_random_bits(key, counter) ^
                               (in < 64 ? lom_random_bits(key ^ bit, counter) : lom_random_bits(key, counter ^ bit));
            for (int out = 0; out < 64; out++)
                flips[out] += (int)(changed >> out & 1);
        }
        for (int out = 0; out < 64; out++) /* 6 standard deviations of 22.4 */
            CHECK(abs(flips[out] - TRIALS / 2) < 134, "input bit %d, output bit %d: %d", in, out, flips[out]);
    }
}

static void uniform_moments(void)
{
    enum { N = 1000000, CELLS = 64 };
    double sum = 0, squares = 0, serial = 0, last = 0.5;
    static int cells[CELLS];
    for (uint64_t i = 0; i < N; i++) {
        double u = lom_random_uniform(42, i);
        CHECK(u >= 0 && u < 1, "%g", u);
        sum += u - 0.5;
        squares += (u - 0.5) * (u - 0.5);
        serial += (u - 0.5) * (last - 0.5);
        last = u;
        cells[(int)(u * CELLS)]++;
    }
    CHECK(fabs(sum / N) < 5 * 0.2887 / 1000, "mean %g", sum / N);
    CHECK(fabs(squares / N - 1.0 / 12) < 5 * 0.0745 / 1000, "variance %g", squares / N);
    CHECK(fabs(serial / N) < 5 * 0.0834 / 1000, "serial correlation %g", serial / N);
    double chi = 0, expected = (double)N / CELLS;
    for (int i = 0; i < CELLS; i++)
        chi += (cells[i] - expected) * (cells[i] - expected) / expected;
    CHECK(chi > 20 && chi < 120, "chi squared %g of 63", chi); /* beyond 1e-5 on both sides */
}

/* F13: the logarithm's argument is never 0, so every normal number is finite, the same for the same key wherever and
 * whenever it is drawn, and what the uniform numbers below it say: Box and Muller (1958). */
static void f13_normals_are_reproducible(void)
{
    uint64_t hash = 1469598103934665603u;
    double first[2], again[2];
    lom_random_normal(7, 123456789, first);
    for (uint64_t i = 0; i < 1000; i++) {
        double n[2];
        lom_random_normal(i * 0x9e3779b97f4a7c15u, ~i, n);
        uint64_t bits[2];
        memcpy(bits, n, sizeof bits);
        for (int k = 0; k < 2; k++) {
            CHECK(n[k] > -9 && n[k] < 9, "%g", n[k]);
            hash = (hash ^ bits[k]) * 1099511628211u;
        }
    }
    lom_random_normal(7, 123456789, again);
    CHECK(first[0] == again[0] && first[1] == again[1], "drawn twice");
    CHECK(hash == 0x0a0444025d90d31au, "%016llx", (unsigned long long)hash);
}

static void normal_moments(void)
{
    enum { N = 200000 };
    double sum[4] = { 0 }, cross = 0, largest = 0;
    for (uint64_t i = 0; i < N; i++) {
        double n[2];
        lom_random_normal(7, i, n);
        for (int k = 0; k < 2; k++) {
            double power = 1;
            for (int p = 0; p < 4; p++)
                sum[p] += power *= n[k];
            largest = fmax(largest, fabs(n[k]));
        }
        cross += n[0] * n[1];
    }
    double deviation = 1 / sqrt(2.0 * N);
    CHECK(fabs(sum[0] / (2 * N)) < 5 * deviation, "mean %g", sum[0] / (2 * N));
    CHECK(fabs(sum[1] / (2 * N) - 1) < 5 * 1.42 * deviation, "variance %g", sum[1] / (2 * N));
    CHECK(fabs(sum[2] / (2 * N)) < 5 * 3.88 * deviation, "skew %g", sum[2] / (2 * N));
    CHECK(fabs(sum[3] / (2 * N) - 3) < 5 * 9.8 * deviation, "kurtosis %g", sum[3] / (2 * N));
    CHECK(fabs(cross / N) < 5 / sqrt(N), "correlation %g", cross / N);
    CHECK(largest > 4 && largest < 8.6, "largest %g", largest);
}

int main(int argc, char **argv)
{
    RUN(fnv_vectors);
    RUN(philox_vectors);
    RUN(avalanche);
    RUN(uniform_moments);
    RUN(f13_normals_are_reproducible);
    RUN(normal_moments);
    return check_result();
}
