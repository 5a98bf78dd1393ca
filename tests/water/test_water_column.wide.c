/* Proves that light through water is, bit for bit, what the formula gives that finds every exponential: for ways of all
 * lengths, without end among them, and for numbers that no scene has. */
#include "check.h"

#include "water/water_column.h"

/* What comes out of `length` metres along a ray when `beyond` went in. */
static lom_float plainly(float a, float source, float slant, lom_float beyond, lom_float length, lom_float depth,
                         lom_float down)
{
    lom_float sun = lom_fade(-a * slant * depth), rate = 1.0f + slant * down, exponent = a * length * rate;
    lom_float inner = lom_select(lom_abs(exponent) > 1e-4f, -lom_expm1(-exponent) / rate, a * length);
    lom_float bed = lom_max(depth + down * length, (lom_float){ 0 });
    return beyond * lom_fade(-a * (length + slant * bed)) + source * sun * inner;
}

static bool same(lom_float a, lom_float b)
{
    for (int i = 0; i < LOM_LANES; i++)
        if (memcmp((const char *)&a + 4 * i, (const char *)&b + 4 * i, 4) != 0 && (a[i] == a[i] || b[i] == b[i]))
            return false;
    return true;
}

/* Lengths, depths and directions as scenes have them, as no scene has them, and of every kind of bits. */
static float number(uint32_t *state, int kind)
{
    static const float odd[] = { 0, -0.0f, 1e-45f, -1e-40f, 0x1p100f, -0x1p100f, 3e38f, -3e38f, 1e-7f, 105, 87 };
    const float unit = (float)(*state = *state * 1664525u + 1013904223u) * 0x1p-32f;
    if (kind == 0)
        return 40 * unit;
    if (kind == 1)
        return 2 * unit - 1;
    if (kind == 2)
        return unit < 0.1f ? __builtin_nanf("") : unit < 0.2f ? __builtin_inff() : odd[(int)(unit * 11)];
    return 0x1p100f;
}

static lom_float numbers(uint32_t *state, int kind)
{
    lom_float x = { 0 };
    for (int i = 0; i < LOM_LANES; i++)
        x[i] = number(state, kind);
    return x;
}

static void water_is_what_all_its_exponentials_give(void)
{
    static const float absorption[] = { 0, 1e-30f, 0.03f, 0.16f, 5, 1e6f };
    uint32_t state = 7;
    for (int n = 0; n < 60000; n++) {
        const float a = absorption[n % 6], source = 0.3f * (float)(n % 5), slant = 1 + 0.1f * (float)(n % 7);
        lom_float length = numbers(&state, n % 4), down = numbers(&state, n / 4 % 3),
                  depth = numbers(&state, n / 12 % 3);
        lom_float beyond = numbers(&state, n / 36 % 2);
        const lom_float sun = lom_fade(-a * slant * depth);
        const struct lom_crossed c = lom_through_water(a, source, slant, sun, length, depth, down);
        for (int light = 0; light < 3; light++) {
            lom_float in = light < 2 ? lom_splat((float)light) : beyond;
            CHECK(same(in * c.left + c.added, plainly(a, source, slant, in, length, depth, down)), "case %d, light %d",
                  n, light);
        }
    }
}

static void at_the_surface_is_all_of_the_sun(void)
{
    const struct lom_medium_uniform m = { { 0.16f, 0, 4 }, { 0.02f, 0.3f, 1 }, 1.2f };
    uint32_t state = 3;
    for (int n = 0; n < 20000; n++) {
        lom_float length = numbers(&state, n % 4), down = numbers(&state, n / 4 % 3),
                  most = lom_min(length, lom_splat(endless));
        lom_float3 beyond = { numbers(&state, 0), numbers(&state, 1), numbers(&state, n % 2) };
        const lom_float3 light = lom_cross_water(&m, beyond, length, down);
        const lom_float in[3] = { beyond.x, beyond.y, beyond.z }, out[3] = { light.x, light.y, light.z };
        for (int i = 0; i < 3; i++)
            CHECK(same(out[i], plainly(m.absorption[i], m.source[i], m.slant, in[i], most, (lom_float){ 0 }, down)),
                  "case %d, colour %d", n, i);
    }
}

int main(int argc, char **argv)
{
    RUN(water_is_what_all_its_exponentials_give);
    RUN(at_the_surface_is_all_of_the_sun);
    return check_result();
}
