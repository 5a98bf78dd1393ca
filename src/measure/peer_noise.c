/* Value noise of the peers' workloads. In: coordinates; out: the float that bench/peers/README.md defines, operation by
 * operation, so that textures are the peers' to the byte. Invariant: nothing but float + - * / and floor. */
#include "peer_noise.h"

#include <lom/base.h>

float lom_peer_clamp01(float x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

float lom_peer_mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

static float smooth(float t)
{
    return t * t * (3 - 2 * t);
}

float lom_peer_smoothstep(float low, float high, float x)
{
    return smooth(lom_peer_clamp01((x - low) / (high - low)));
}

uint8_t lom_peer_byte(float x)
{
    return (uint8_t)lom_count_of(lom_peer_clamp01(x) * 255.0f + 0.5f, 255);
}

float lom_peer_lattice(uint32_t x, uint32_t y, uint32_t z)
{
    uint32_t h = (x * 0x8da6b343u) ^ (y * 0xd8163841u) ^ (z * 0xcb1ab31fu);
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    h ^= h >> 15;
    return (float)(h >> 8) * (1.0f / 16777216.0f);
}

/* Where a coordinate lies between two lattice points of a periodic axis. */
typedef struct cell {
    uint32_t point[2];
    float weight;
} cell;

static cell find_cell(float x, int period)
{
    float whole = __builtin_floorf(x);
    int first = ((lom_int_of(whole) % period) + period) % period;
    return (cell){ { (uint32_t)first, (uint32_t)((first + 1) % period) }, smooth(x - whole) };
}

static float noise2(float x, float y, int period, uint32_t seed)
{
    cell cx = find_cell(x, period), cy = find_cell(y, period);
    float row[2];
    for (int j = 0; j < 2; j++)
        row[j] = lom_peer_mix(lom_peer_lattice(cx.point[0], cy.point[j], seed),
                              lom_peer_lattice(cx.point[1], cy.point[j], seed), cx.weight);
    return lom_peer_mix(row[0], row[1], cy.weight);
}

static float noise3(float x, float y, float z, int period)
{
    cell cx = find_cell(x, period), cy = find_cell(y, period), cz = find_cell(z, period);
    float slice[2];
    for (int k = 0; k < 2; k++) {
        float row[2];
        for (int j = 0; j < 2; j++)
            row[j] = lom_peer_mix(lom_peer_lattice(cx.point[0], cy.point[j], cz.point[k]),
                                  lom_peer_lattice(cx.point[1], cy.point[j], cz.point[k]), cx.weight);
        slice[k] = lom_peer_mix(row[0], row[1], cy.weight);
    }
    return lom_peer_mix(slice[0], slice[1], cz.weight);
}

float lom_peer_fbm2(float u, float v, int period, int seed)
{
    float sum = 0, amplitude = 0.5f;
    for (int octave = 0; octave < 5; octave++) {
        float scale = (float)period;
        sum += amplitude * noise2(u * scale, v * scale, period, (uint32_t)(seed + octave));
        amplitude *= 0.5f;
        period *= 2;
    }
    return sum / 0.96875f;
}

float lom_peer_fbm3(float x, float y, float z, int period)
{
    float sum = 0, amplitude = 0.5f;
    for (int octave = 0; octave < 4; octave++) {
        float scale = (float)period;
        sum += amplitude * noise3(x * scale, y * scale, z * scale, period);
        amplitude *= 0.5f;
        period *= 2;
    }
    return sum / 0.9375f;
}
